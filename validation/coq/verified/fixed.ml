(* Fixed-point numbers: an integer n at `bits` stands for n 2^-bits. Nothing here is proved, nor need be: it computes hints that
   the checker checks. *)

open Checker
module Z = Integers.Z

let one bits = Z.shift_left Z.one bits
let mul bits a b = Z.shift_right (Z.mul a b) bits
let div bits a b = if Z.sign b = 0 then Z.zero else Z.fdiv (Z.shift_left a bits) b
let of_int bits n = Z.shift_left (Z.of_int n) bits
let of_q bits { qnum; qden } = Z.fdiv (Z.shift_left qnum bits) qden

(* The same number at other bits. *)
let move ~from ~into a = if into >= from then Z.shift_left a (into - from) else Z.shift_right a (from - into)

(* As a double times a power of two: a 2^-bits. *)
let to_float bits a =
  let excess = Z.numbits a - 64 in
  if excess > 0 then Float.ldexp (Z.to_float (Z.shift_right a excess)) (excess - bits) else Float.ldexp (Z.to_float a) (-bits)

(* The nearest integer at a coarser scale. *)
let round ~bits ~scale a =
  if scale >= bits then Z.shift_left a (scale - bits)
  else Z.shift_right (Z.succ (Z.shift_right a (bits - scale - 1))) 1

(* arctan (1/n), by its series. *)
let arctan_inverse bits n =
  let square = Z.of_int (n * n) in
  let rec sum term k total =
    if Z.sign term = 0 then total
    else
      let part = Z.div term (Z.of_int k) in
      sum (Z.div term square) (k + 2) (if k land 2 = 0 then Z.add total part else Z.sub total part) in
  let first = Z.div (one bits) (Z.of_int n) in
  sum first 1 Z.zero

let known_pi = ref (0, Z.zero)

let pi bits =
  let from, value = !known_pi in
  if from >= bits then move ~from ~into:bits value
  else begin
    let from = bits + 256 in
    let spare = from + 32 in
    let a = Z.mul (Z.of_int 16) (arctan_inverse spare 5) and b = Z.mul (Z.of_int 4) (arctan_inverse spare 239) in
    known_pi := (from, move ~from:spare ~into:from (Z.sub a b));
    move ~from ~into:bits (snd !known_pi)
  end

(* Sine and cosine near 0: Taylor's series of an angle halved k times, and the double angle k times. *)
let small bits x =
  let halvings = 4 + int_of_float (sqrt (float_of_int bits)) / 2 in
  (* Of a small angle the versine is that much smaller. *)
  let bits' = bits + 2 * halvings + 16 + max 0 (bits - Z.numbits x) in
  let y = Z.shift_right (move ~from:bits ~into:bits' x) halvings in
  let square = mul bits' y y in
  (* 1 - cos y, and sin y. *)
  let rec series term k total =
    if Z.sign term = 0 then total
    else
      let next = Z.neg (Z.div (mul bits' term square) (Z.of_int (k * (k + 1)))) in
      series next (k + 2) (Z.add total term) in
  let versine = series (Z.shift_right square 1) 3 Z.zero in
  let rec doubled k v = if k = 0 then v else doubled (k - 1) (Z.shift_left (Z.sub (Z.shift_left v 1) (mul bits' v v)) 1) in
  let versine = doubled halvings versine in
  let cosine = Z.sub (one bits') versine in
  (* sin^2 = v (2 - v). *)
  let sine = Z.sqrt (Z.mul versine (Z.sub (Z.shift_left (one bits') 1) versine)) in
  let sine = if Z.sign x < 0 then Z.neg sine else sine in
  (move ~from:bits' ~into:bits sine, move ~from:bits' ~into:bits cosine)

let sin_cos bits x =
  let spare = bits + 16 + max 0 (Z.numbits x - bits) in
  let y = move ~from:bits ~into:spare x and quarter = Z.shift_right (pi spare) 1 in
  let turns = Z.fdiv (Z.add y (Z.shift_right quarter 1)) quarter in
  let rest = Z.sub y (Z.mul turns quarter) in
  let s, c = small bits (move ~from:spare ~into:bits rest) in
  match Z.to_int (Z.logand turns (Z.of_int 3)) with
  | 0 -> (s, c) | 1 -> (c, Z.neg s) | 2 -> (Z.neg s, Z.neg c) | _ -> (Z.neg c, s)

let sin bits x = fst (sin_cos bits x)
let cos bits x = snd (sin_cos bits x)

let rec value bits = function
  | Rational q -> of_q bits q
  | Pi -> pi bits
  | Plus (a, b) -> Z.add (value bits a) (value bits b)
  | Minus (a, b) -> Z.sub (value bits a) (value bits b)
  | Times (a, b) -> mul bits (value bits a) (value bits b)
  | Over (a, b) -> div bits (value bits a) (value bits b)
  | Root a -> let x = value bits a in if Z.sign x <= 0 then Z.zero else Z.sqrt (Z.shift_left x bits)
  | Sine a -> sin bits (value bits a)
  | Cosine a -> cos bits (value bits a)

(* The middle of a range, and half its width. *)
let middle bits { least; most } = Z.shift_right (Z.add (value bits least) (value bits most)) 1
let half_width { least; most } =
  let bits = 256 in
  if least = most then 0.0 else abs_float (to_float bits (Z.sub (value bits most) (value bits least))) /. 2.0
