(* Prints a file in which Coq computes each function of integers.ml on a table of arguments, and must get the same. *)

module I = Integers

let large = [ Z.of_string "4611686018427387904"; Z.add (Z.pow (Z.of_int 7) 30) Z.one ]
let positives = List.map Z.of_int [ 1; 2; 3; 7; 8; 63 ] @ large
let all = (Z.zero :: positives) @ List.map Z.neg positives
let small = List.map Z.of_int [ -64; -3; -1; 0; 1; 2; 63; 64; 65 ]

(* Coq reads hexadecimal numbers faster. *)
let integer n = "(" ^ Z.format "%#x" n ^ ")"
let boolean = string_of_bool
let comparison = function I.Eq -> "Eq" | I.Lt -> "Lt" | I.Gt -> "Gt"
let pair (a, b) = Printf.sprintf "(%s, %s)" (integer a) (integer b)
let pairs xs ys = List.concat_map (fun x -> List.map (fun y -> (x, y)) ys) xs
let list term items = "[" ^ String.concat "; " (List.map term items) ^ "]"

(* The function of Coq has these values on these arguments; scope is that of both. *)
let table ~scope name arguments results =
  Printf.printf "Goal map %s (%s)%%%s = (%s)%%%s. Proof. vm_compute. reflexivity. Qed.\n" name arguments scope results scope
let unary ?(scope = "Z") name f term xs = table ~scope name (list integer xs) (list (fun x -> term (f x)) xs)
let binary ?(scope = "Z") name f term xys =
  table ~scope (Printf.sprintf "(fun p => %s (fst p) (snd p))" name) (list pair xys) (list (fun (x, y) -> term (f x y)) xys)

let () =
  print_string "From Coq Require Import ZArith List.\nFrom Flocq Require Zaux.\nImport ListNotations.\n";
  let any = pairs all all and shifts = pairs all small and two = pairs positives positives in
  let positive = "positive" in
  List.iter (fun (name, f) -> binary name f integer any)
    [ ("Z.add", I.add); ("Z.sub", I.sub); ("Z.mul", I.mul); ("Z.max", I.max); ("Z.min", I.min); ("Z.div", I.div); ("Z.modulo", I.modulo) ];
  List.iter (fun (name, f) -> binary name f boolean any) [ ("Z.eqb", I.equal); ("Z.leb", I.leq); ("Z.ltb", I.lt) ];
  List.iter (fun (name, f) -> binary name f pair any) [ ("Z.div_eucl", I.div_eucl); ("Zaux.Zfast_div_eucl", I.div_eucl) ];
  List.iter (fun (name, f) -> binary name f integer shifts) [ ("Z.shiftl", I.shiftl); ("Z.shiftr", I.shiftr); ("Z.pow", I.pow) ];
  binary "Z.compare" I.compared comparison any;
  List.iter (fun (name, f) -> unary name f integer all)
    [ ("Z.opp", I.neg); ("Z.succ", I.succ); ("Z.pred", I.pred); ("Z.abs", I.abs); ("Z.div2", I.div2); ("Z.log2", I.log2); ("Z.sgn", I.signum);
      ("(fun n => Zpos (Z.to_pos n))", I.to_positive);
      ("(fun n => match n with Z0 => 5 | Zpos p => Zpos p + 1 | Zneg p => Zpos p + 2 end)%Z",
       I.match_integer (fun () -> Z.of_int 5) Z.succ (fun p -> Z.add p (Z.of_int 2))) ];
  List.iter (fun (name, f) -> unary name f boolean all) [ ("Z.even", I.is_even); ("Z.odd", I.is_odd) ];
  unary "Z.sqrtrem" I.sqrtrem pair all;
  List.iter (fun (name, f) -> binary ~scope:positive name f integer two)
    [ ("Pos.add", I.add); ("Pos.mul", I.mul); ("Pos.sub", I.sub_positive) ];
  List.iter (fun (name, f) -> binary ~scope:positive name f boolean two) [ ("Pos.eqb", I.equal); ("Pos.leb", I.leq); ("Pos.ltb", I.lt) ];
  binary ~scope:positive "Pos.compare" I.compared comparison two;
  List.iter (fun (name, f) -> unary ~scope:positive name f integer positives)
    [ ("Pos.succ", I.succ); ("Pos.pred", I.pred_positive); ("xO", I.double); ("xI", I.double_plus_one);
      ("(fun n => match n with xH => 5 | xO p => p + 1 | xI p => p + 2 end)%positive",
       I.match_positive (fun p -> Z.add p (Z.of_int 2)) Z.succ (fun () -> Z.of_int 5)) ]
