(* Exact numbers as scenes have them: text to the checker's expressions, and back. *)

open Checker
module Z = Integers.Z

let unreadable = Json.unreadable

let ten_to n = Z.pow (Z.of_int 10) n
let largest_exponent = 10_000
let largest_power = 64
let largest_size = 4096
let deepest = 64
let longest = 16384

(* Digits, perhaps a point and digits; the fraction has a power of ten below. *)
let decimal ~whole ~part = { qnum = Z.of_string (whole ^ part); qden = ten_to (String.length part) }
let scaled q exponent =
  if exponent >= 0 then
    let power = ten_to exponent in
    let common = Z.gcd power q.qden in
    { qnum = Z.mul q.qnum (Z.divexact power common); qden = Z.divexact q.qden common }
  else { q with qden = Z.mul q.qden (ten_to (-exponent)) }

(* A fraction over a power of ten. *)
let spell { qnum; qden } =
  let places = String.length (Z.to_string qden) - 1 in
  let digits = Z.to_string (Z.abs qnum) in
  let digits = String.make (max 0 (places + 1 - String.length digits)) '0' ^ digits in
  let whole = String.length digits - places in
  (if Z.sign qnum < 0 then "-" else "") ^ String.sub digits 0 whole
  ^ if places = 0 then "" else "." ^ String.sub digits whole places

let zero = Rational { qnum = Z.zero; qden = Z.one }

(* Decides whether an expression has at most n parts. *)
let is_small most value =
  let rec left most = function
    | Rational _ | Pi -> most - 1
    | Plus (a, b) | Minus (a, b) | Times (a, b) | Over (a, b) -> if most < 0 then most else left (left (most - 1) a) b
    | Root a | Sine a | Cosine a -> if most < 0 then most else left (most - 1) a in
  left most value >= 0

let parse place source =
  let length = String.length source and at = ref 0 in
  if length > longest then unreadable "%s: %d bytes, but accepted are %d" place length longest;
  let peek () = if !at < length then source.[!at] else '\000' in
  let blanks () = while !at < length && peek () = ' ' do incr at done in
  let refuse what = unreadable "%s: %S, but accepted at column %d is %s" place source (!at + 1) what in
  let take c = if peek () = c then (incr at; true) else false in
  let digits () =
    let start = !at in
    while peek () >= '0' && peek () <= '9' do incr at done;
    if !at = start then refuse "a digit";
    String.sub source start (!at - start) in
  let small what limit =
    let text = digits () in
    match int_of_string_opt text with Some n when n <= limit && String.length text < 9 -> n | _ -> refuse what in
  let literal () =
    let whole = digits () in
    let part = if take '.' then digits () else "" in
    let q = decimal ~whole ~part in
    if take 'e' || take 'E' then
      let negative = take '-' in
      if not negative then ignore (take '+');
      let exponent = small "an exponent up to 10000" largest_exponent in
      scaled q (if negative then -exponent else exponent)
    else q in
  let rec sum depth =
    if depth > deepest then refuse "no deeper nesting";
    let rec more value =
      blanks ();
      if take '+' then more (Plus (value, unsigned depth))
      else if take '-' then more (Minus (value, unsigned depth))
      else value in
    more (product depth)
  and unsigned depth =
    blanks ();
    if peek () = '-' then refuse "no sign after a sign";
    product depth
  and product depth =
    let rec more value =
      blanks ();
      if take '*' then more (Times (value, operand depth))
      else if take '/' then more (Over (value, operand depth))
      else value in
    more (operand depth)
  and operand depth =
    blanks ();
    let negative = take '-' in
    match powered (atom depth) with
    | Rational q when negative -> Rational { q with qnum = Z.neg q.qnum }
    | value -> if negative then Minus (zero, value) else value
  and atom depth =
    match peek () with
    | '0' .. '9' -> Rational (literal ())
    | '(' -> enclosed depth
    | 'a' .. 'z' ->
      let start = !at in
      while peek () >= 'a' && peek () <= 'z' do incr at done;
      (match String.sub source start (!at - start) with
       | "pi" -> Pi
       | "sqrt" -> Root (enclosed depth)
       | "sin" -> Sine (enclosed depth)
       | "cos" -> Cosine (enclosed depth)
       | _ -> at := start; refuse "`pi`, `sqrt(`, `sin(` or `cos(`")
    | _ -> refuse "a number, `pi`, `sqrt(`, `sin(`, `cos(`, `(` or `-`"
  and enclosed depth =
    if not (take '(') then refuse "`(`";
    let value = sum (depth + 1) in
    blanks ();
    if not (take ')') then refuse "`)`";
    value
  and powered value =
    blanks ();
    if not (take '^') then value
    else begin
      let n = small "a power from 2 to 64" largest_power in
      if n < 2 then refuse "a power from 2 to 64";
      if not (is_small (largest_size / n) value) then refuse "the power of a shorter expression";
      let rec times n = if n = 1 then value else Times (value, times (n - 1)) in
      times n
    end in
  let range =
    blanks ();
    if take '[' then begin
      let least = sum 0 in
      blanks ();
      if not (take ',') then refuse "`,`";
      let most = sum 0 in
      blanks ();
      if not (take ']') then refuse "`]`";
      { least; most }
    end else let value = sum 0 in { least = value; most = value } in
  blanks ();
  if !at < length then refuse "the end";
  range

(* A number that is one value. *)
let number place source =
  let { least; most } = parse place source in
  if least <> most then unreadable "%s: %S, but accepted is one value" place source;
  least

(* A decimal, as bounds are. *)
let bound place source =
  match number place source with
  | Rational q when not (String.contains source ' ') -> q
  | _ -> unreadable "%s: %S, but accepted is a decimal" place source

(* The precedence of a spelling. *)
type binding = Sum | Product | Power | Atom

(* x^n is the product x (x (x ...)). *)
let rec exponent x = function
  | Times (a, rest) when a = x -> Option.map succ (exponent x rest)
  | y when y = x -> Some 1
  | _ -> None

let rec print least value =
  let text, binding = match value with
    | Rational q -> (spell q, if Z.sign q.qnum < 0 then Sum else Atom)
    | Pi -> ("pi", Atom)
    | Minus (z, a) when z = zero -> ("-" ^ print Power a, Sum)
    | Plus (a, b) -> (print Sum a ^ "+" ^ print Product b, Sum)
    | Minus (a, b) -> (print Sum a ^ "-" ^ print Product b, Sum)
    | Times (a, rest) when exponent a rest <> None ->
      (print Atom a ^ "^" ^ string_of_int (1 + Option.get (exponent a rest)), Power)
    | Times (a, b) -> (leading a ^ "*" ^ print Power b, Product)
    | Over (a, b) -> (leading a ^ "/" ^ print Power b, Product)
    | Root a -> ("sqrt(" ^ print Sum a ^ ")", Atom)
    | Sine a -> ("sin(" ^ print Sum a ^ ")", Atom)
    | Cosine a -> ("cos(" ^ print Sum a ^ ")", Atom) in
  if binding >= least then text else "(" ^ text ^ ")"

(* A factor that comes first may have a sign. *)
and leading = function
  | Rational q -> spell q
  | Minus (z, _) as a when z = zero -> print Sum a
  | a -> print Product a

let text { least; most } =
  if least = most then print Sum least else "[" ^ print Sum least ^ "," ^ print Sum most ^ "]"

(* The canonical form of a text: no blanks, decimals without exponents, no parentheses around one number or around the first factors of a product, the square of a
   number as a power, no sign of 0. *)
let plain_decimal source =
  let group n = try Str.matched_group n source with Not_found -> "" in
  let whole = group 1 and part = group 2 in
  match int_of_string_opt (group 3) with
  | Some exponent when abs exponent <= largest_exponent ->
    let part = if part = "" then "" else String.sub part 1 (String.length part - 1) in
    let digits = whole ^ part and places = String.length part - exponent in
    if places <= 0 then digits ^ String.make (-places) '0'
    else
      let digits = String.make (max 0 (places + 1 - String.length digits)) '0' ^ digits in
      let n = String.length digits - places in
      String.sub digits 0 n ^ "." ^ String.sub digits n places
  | _ -> Str.matched_string source

let with_exponent = Str.regexp "\\([0-9]+\\)\\(\\.[0-9]+\\)?[eE]\\([-+]?[0-9]+\\)"
let in_parentheses = Str.regexp "\\(^\\|[^a-z]\\)(\\([0-9.]+\\|pi\\))"
let minus_zero = Str.regexp "\\(^\\|[[,]\\)-\\(0\\(\\.0*\\)?\\($\\|[],]\\)\\)"

let without_exponents source = Str.global_substitute with_exponent plain_decimal source

let first_factors = Str.regexp "\\(^\\|[[(,+]\\|[0-9a-z.)]-\\)(\\([0-9a-z.]+\\([*/][0-9a-z.]+\\)+\\))\\($\\|[])*/,+-]\\)"
let square = Str.regexp "\\(^\\|[[(,+]\\|[0-9a-z.)]-\\)\\([0-9.]+\\|pi\\)\\*\\2\\($\\|[])*/,+-]\\)"
let rec repeatedly change source =
  let changed = change source in
  if changed = source then source else repeatedly change changed

let canonical source =
  let source = without_exponents (String.concat "" (String.split_on_char ' ' source)) in
  let source = Str.global_replace in_parentheses "\\1\\2" source in
  let source = repeatedly (Str.global_replace first_factors "\\1\\2\\4") source in
  let source = repeatedly (Str.global_replace square "\\1\\2^2\\3") source in
  Str.global_replace minus_zero "\\1\\2" source
