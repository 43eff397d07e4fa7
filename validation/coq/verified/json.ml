(* Strict JSON (RFC 8259). Strings and numbers are kept as they are written; a key that is there twice, and nesting deeper than
   accepted, are refused. `text` writes a value without blanks: what is read is compared with it (`read`). *)

type t =
  | Null
  | Bool of bool
  | Number of string
  | String of string
  | List of t list
  | Object of (string * t) list

exception Unreadable of string

let unreadable format = Printf.ksprintf (fun message -> raise (Unreadable message)) format

let deepest = 64

let rec write out = function
  | Null -> Buffer.add_string out "null"
  | Bool b -> Buffer.add_string out (string_of_bool b)
  | Number n -> Buffer.add_string out n
  | String s -> write_string out s
  | List items -> write_all out '[' (write out) items ']'
  | Object members ->
    write_all out '{' (fun (key, value) -> write_string out key; Buffer.add_char out ':'; write out value) members '}'

and write_string out s =
  Buffer.add_char out '"';
  Buffer.add_string out s;
  Buffer.add_char out '"'

and write_all : 'a. Buffer.t -> char -> ('a -> unit) -> 'a list -> char -> unit = fun out first each items last ->
  Buffer.add_char out first;
  List.iteri (fun i item -> if i > 0 then Buffer.add_char out ','; each item) items;
  Buffer.add_char out last

let text value =
  let out = Buffer.create 4096 in
  write out value;
  Buffer.contents out

(* Members in the order of their keys. *)
let rec sorted = function
  | List items -> List (List.rev (List.rev_map sorted items))
  | Object members ->
    let members = List.map (fun (key, value) -> (key, sorted value)) members in
    Object (List.sort (fun (a, _) (b, _) -> compare a b) members)
  | value -> value

let is_blank c = c = ' ' || c = '\t' || c = '\n' || c = '\r'

(* A text without the blanks outside its strings. *)
let stripped text =
  let out = Buffer.create (String.length text) in
  let quoted = ref false and escaped = ref false in
  String.iter (fun c ->
    if !quoted then begin
      Buffer.add_char out c;
      if !escaped then escaped := false else if c = '\\' then escaped := true else if c = '"' then quoted := false
    end else if not (is_blank c) then begin
      Buffer.add_char out c;
      if c = '"' then quoted := true
    end) text;
  Buffer.contents out

let parse source =
  let length = String.length source and at = ref 0 in
  let peek () = if !at < length then source.[!at] else '\000' in
  let next () = incr at in
  let line () =
    let lines = ref 1 in
    String.iteri (fun i c -> if i < !at && c = '\n' then incr lines) source;
    !lines in
  let refuse what =
    let found = if !at >= length then "the end" else Printf.sprintf "%C" (peek ()) in
    unreadable "line %d: %s where %s is accepted" (line ()) found what in
  let rec blanks () = if !at < length && is_blank (peek ()) then (next (); blanks ()) in
  let expect c what = if !at < length && peek () = c then next () else refuse what in
  let digits () =
    let is_digit () = peek () >= '0' && peek () <= '9' in
    if not (is_digit ()) then refuse "a digit";
    while is_digit () do next () done in
  let number () =
    let start = !at in
    if peek () = '-' then next ();
    if peek () = '0' then next () else digits ();
    if peek () = '.' then (next (); digits ());
    if peek () = 'e' || peek () = 'E' then begin
      next ();
      if peek () = '+' || peek () = '-' then next ();
      digits ()
    end;
    Number (String.sub source start (!at - start)) in
  let hexadecimal () = match peek () with
    | '0' .. '9' | 'a' .. 'f' | 'A' .. 'F' -> next ()
    | _ -> refuse "a hexadecimal digit" in
  let string () =
    expect '"' "a string";
    let start = !at in
    while !at < length && peek () <> '"' do
      if peek () < ' ' then refuse "no control character inside a string";
      if peek () = '\\' then begin
        next ();
        match peek () with
        | '"' | '\\' | '/' | 'b' | 'f' | 'n' | 'r' | 't' -> next ()
        | 'u' -> next (); for _ = 1 to 4 do hexadecimal () done
        | _ -> refuse "an escape of JSON"
      end else next ()
    done;
    let content = String.sub source start (!at - start) in
    expect '"' "the end of a string";
    content in
  let word text value =
    String.iter (fun c -> expect c "a JSON value") text;
    value in
  let rec value depth =
    if depth > deepest then unreadable "line %d: nesting deeper than the %d levels accepted" (line ()) deepest;
    blanks ();
    match peek () with
    | '{' -> next (); Object (members depth)
    | '[' -> next (); List (items depth)
    | '"' -> String (string ())
    | '-' | '0' .. '9' -> number ()
    | 't' -> word "true" (Bool true)
    | 'f' -> word "false" (Bool false)
    | 'n' -> word "null" Null
    | _ -> refuse "a JSON value"
  and items depth =
    blanks ();
    if peek () = ']' then (next (); []) else
    let rec more found =
      let found = value (depth + 1) :: found in
      blanks ();
      if peek () = ',' then (next (); more found) else (expect ']' "`,` or `]`"; List.rev found) in
    more []
  and members depth =
    blanks ();
    if peek () = '}' then (next (); []) else
    let seen = Hashtbl.create 8 in
    let rec more found =
      blanks ();
      let key = string () in
      if Hashtbl.mem seen key then unreadable "line %d: the key %S twice" (line ()) key;
      Hashtbl.add seen key ();
      blanks ();
      expect ':' "`:`";
      let found = (key, value (depth + 1)) :: found in
      blanks ();
      if peek () = ',' then (next (); more found) else (expect '}' "`,` or `}`"; List.rev found) in
    more [] in
  let whole = value 0 in
  blanks ();
  if !at < length then refuse "the end of the document";
  whole

(* The value of a text; written again it must be the text, blanks apart. *)
let read source =
  let value = parse source in
  if text value <> stripped source then unreadable "what is read is not what is written";
  value
