(* Values of a document with the places where they stand, and its scene: from JSON, and back. What no theorem covers is `Not_covered`, what is no document
   `Json.Unreadable`. *)

open Checker
module Z = Integers.Z

exception Not_covered of string

let not_covered format = Printf.ksprintf (fun message -> raise (Not_covered message)) format
let unreadable = Json.unreadable

(* Values with the places where they stand. *)

let kind = function
  | Json.Null -> "null"
  | Bool b -> string_of_bool b
  | Number n -> n
  | String s -> Printf.sprintf "\"%s\"" s
  | List _ -> "a list"
  | Object _ -> "an object"

let shortened text = if String.length text > 60 then String.sub text 0 60 ^ ".." else text
let wrong place value what = unreadable "%s: %s, but accepted is %s" place (shortened (kind value)) what

let members place = function Json.Object members -> members | value -> wrong place value "an object"
let items place = function
  | Json.List items -> List.mapi (fun i item -> (Printf.sprintf "%s[%d]" place i, item)) items
  | value -> wrong place value "a list"
let inside place key = if place = "" then key else place ^ "." ^ key
let get place members key =
  match List.assoc_opt key members with
  | Some value -> value
  | None -> unreadable "%s is missing" (inside place key)
let string place = function Json.String s -> s | value -> wrong place value "a string"
let bool place = function Json.Bool b -> b | value -> wrong place value "true or false"
let integer place = function
  | Json.Number n when String.length n < 19 && String.for_all (fun c -> c >= '0' && c <= '9') n -> Z.of_string n
  | value -> wrong place value "an integer from 0 on"
let signed place = function
  | Json.Number n when String.length n > 1 && n.[0] = '-' -> Z.neg (integer place (Json.Number (String.sub n 1 (String.length n - 1))))
  | value -> integer place value
let range place value = Expression.parse place (string place value)
let wall place value = match string place value with
  | "left" -> Left
  | "right" -> Right
  | _ -> wrong place value "\"left\" or \"right\""
let mapping place = function
  | Json.Null -> None
  | String "P1" -> Some P1
  | String "P2" -> Some P2
  | String "P3" -> Some P3
  | String "P4" -> Some P4
  | value -> wrong place value "\"P1\", \"P2\", \"P3\", \"P4\" or null"
let bounds place value = match items place value with
  | [ (p, lower); (q, upper) ] ->
    let lower = Expression.bound p (string p lower) and upper = Expression.bound q (string q upper) in
    if Z.sign (Z.sub (Z.mul lower.qnum upper.qden) (Z.mul upper.qnum lower.qden)) > 0 then
      unreadable "%s: the lower bound is above the upper one" place;
    (lower, upper)
  | _ -> wrong place value "a list of two bounds"

(* Keys that documents have, and no theorem is about. *)
let not_about = [ "amplitude"; "cycles"; "distance"; "epsilon"; "excludes"; "from"; "gap"; "hyperbolic"; "index"; "interrupted"; "left_out"; "mapping"; "may_be_later";
  "orbit"; "over"; "period"; "reason"; "scene_orbit"; "sine"; "skipped"; "solved_for"; "spacing"; "speed"; "start"; "time"; "times"; "turn"; "undecided"; "until";
  "velocity"; "wall"; "word"; "words" ]

(* No other keys than these. *)
let only place known members =
  List.iter (fun (key, _) ->
    if not (List.mem key known) then
      if List.mem key not_about then not_covered "%s is not covered by the theorem" (inside place key)
      else unreadable "%s is no key of such a document" (inside place key)) members

let schema_of value = string "schema" (get "" (members "the document" value) "schema")

let read_scene value =
  let place = "scene" in
  let scene = members place value in
  only place [ "excitation"; "gap"; "restitution"; "start" ] scene;
  let excitation = inside place "excitation" in
  let terms = members excitation (get place scene "excitation") in
  only excitation [ "amplitude"; "frequency"; "phase" ] terms;
  let list key = let place = inside excitation key in
    List.map (fun (place, value) -> range place value) (items place (get excitation terms key)) in
  let amplitudes = list "amplitude" and frequencies = list "frequency" and phases = list "phase" in
  if List.compare_lengths amplitudes frequencies <> 0 || List.compare_lengths amplitudes phases <> 0 then
    unreadable "%s: as many frequencies and phases as amplitudes are accepted" excitation;
  let tones = List.map2 (fun (amplitude, frequency) shift -> { amplitude; frequency; shift })
    (List.combine amplitudes frequencies) phases in
  match tones with
  | [] -> unreadable "%s.amplitude: an empty list, but accepted is one amplitude or more" excitation
  | leading :: further ->
    let value key = range (inside place key) (get place scene key) in
    let data = { leading; further; gap = value "gap"; restitution = value "restitution" } in
    let place = inside place "start" in
    let start = members place (get "scene" scene "start") in
    only place [ "time"; "wall"; "position"; "velocity" ] start;
    let value key = range (inside place key) (get place start key) in
    let beginning = match List.mem_assoc "wall" start, List.mem_assoc "position" start with
      | true, false -> Struck (wall (inside place "wall") (get place start "wall"), value "time", value "velocity")
      | false, true -> Inside (value "time", value "position", value "velocity")
      | _ -> unreadable "%s: accepted is a wall or a position" place in
    (data, beginning)
let one_harmonic what data = if data.further <> [] then not_covered "scene.excitation: covered are %s of one harmonic" what

(* To JSON. *)

let plural n = if Z.equal n Z.one then "" else "s"
let ordinal n = match Z.to_int (Z.rem n (Z.of_int 100)) with
  | 11 | 12 | 13 -> "th"
  | n -> (match n mod 10 with 1 -> "st" | 2 -> "nd" | 3 -> "rd" | _ -> "th")

let wall_name = function Left -> "left" | Right -> "right"
let mapping_name = function P1 -> "P1" | P2 -> "P2" | P3 -> "P3" | P4 -> "P4"

let json_of_scene data beginning =
  let text r = Json.String (Expression.text r) in
  let list field = Json.List (List.map (fun tone -> text (field tone)) (data.leading :: data.further)) in
  let start = match beginning with
    | Struck (w, t, v) -> [ ("time", text t); ("wall", Json.String (wall_name w)); ("velocity", text v) ]
    | Inside (t, y, v) -> [ ("time", text t); ("position", text y); ("velocity", text v) ] in
  Json.Object [
    ("excitation", Object [ ("amplitude", list (fun x -> x.amplitude)); ("frequency", list (fun x -> x.frequency));
                            ("phase", list (fun x -> x.shift)) ]);
    ("gap", text data.gap); ("restitution", text data.restitution); ("start", Object start) ]

(* The scene in words, as `impact-pair check` prints it. *)
let scene_in_words data start =
  let listed field = match List.map (fun tone -> Expression.text (field tone)) (data.leading :: data.further) with
    | [ one ] -> one
    | several -> "(" ^ String.concat ", " several ^ ")" in
  let begun = match start with
    | Struck (w, t, v) -> Printf.sprintf "t = %s, %s wall, v = %s" (Expression.text t) (wall_name w) (Expression.text v)
    | Inside (t, y, v) -> Printf.sprintf "t = %s, y = %s, y' = %s" (Expression.text t) (Expression.text y) (Expression.text v) in
  Printf.sprintf "A = %s, W = %s, tau = %s, d = %s, e = %s; start: %s" (listed (fun x -> x.amplitude)) (listed (fun x -> x.frequency))
    (listed (fun x -> x.shift)) (Expression.text data.gap) (Expression.text data.restitution) begun

let pair lower upper = Json.List [ String (Expression.spell lower); String (Expression.spell upper) ]

(* The first place where two texts differ. *)
let difference a b =
  let n = min (String.length a) (String.length b) in
  let rec first i = if i < n && a.[i] = b.[i] then first (i + 1) else i in
  let i = first 0 in
  let part s = String.sub s (max 0 (i - 20)) (min (String.length s) (i + 20) - max 0 (i - 20)) in
  (part a, part b)

(* Numbers in one spelling. *)
let numbers = [ "gap"; "restitution"; "amplitude"; "frequency"; "phase"; "time"; "position"; "velocity"; "until"; "median"; "maximum"; "trace"; "determinant"; "re"; "im"; "longest_flight"; "speed"; "flight"; "flight_time"; "speed_before" ]
let rec spelled key = function
  | Json.String s when List.mem key numbers -> Json.String (Expression.canonical s)
  | String s when key = "message" -> String (Expression.without_exponents s)
  | List items -> List (List.rev (List.rev_map (spelled key) items))
  | Object members -> Object (List.map (fun (key, value) -> (key, spelled key value)) members)
  | value -> value

(* The claims of a document. `json` writes again what `document` reads of it, and this is compared, byte for byte, with the canonical form of the
   document, without the keys that claim nothing. *)
let claimed ?(canonical = fun _ head -> spelled "" head) ~no_claims ~document ~json value =
  let claim = document value in
  (* What claims nothing has no place for a claim. *)
  let is_plain (key, value) = match key, value with
    | _ when not (List.mem key no_claims) -> ()
    | "arithmetic", Json.Object own -> only key [ "kind"; "bits"; "max_bits" ] own
    | "witness", Json.Object _ -> ()
    | _, (Json.List (_ :: _) | Object (_ :: _)) -> wrong key value "a plain value"
    | _ -> () in
  List.iter is_plain (members "the document" value);
  let head = List.filter (fun (key, _) -> not (List.mem key no_claims)) (members "the document" value) in
  let written = Json.text (Json.sorted (canonical claim (Json.Object head))) and understood = Json.text (Json.sorted (json claim)) in
  if written <> understood then begin
    let a, b = difference written understood in
    not_covered "written is `..%s..`, and covered is the spelling `..%s..`" a b
  end;
  claim
