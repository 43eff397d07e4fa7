(* Coq's binary integers as Zarith's. Each function is that of Coq for all arguments, those without a meaning included:
   a quotient by 0 is 0, the remainder the dividend; a negative shift goes the other way; a power with a negative exponent is 0. *)

module Z = Z
type t = Z.t
type comparison = Eq | Lt | Gt

let zero = Z.zero
let one = Z.one
let equal = Z.equal
let leq = Z.leq
let lt = Z.lt
let add = Z.add
let sub = Z.sub
let mul = Z.mul
let neg = Z.neg
let abs = Z.abs
let succ = Z.succ
let pred = Z.pred
let max = Z.max
let min = Z.min
let is_odd = Z.is_odd
let is_even = Z.is_even
let signum n = Z.of_int (Z.sign n)
let compared a b = let c = Z.compare a b in if c < 0 then Lt else if c > 0 then Gt else Eq

(* Constructors and cases: xI, xO, xH; 0, Zpos, Zneg. *)
let double p = Z.shift_left p 1
let double_plus_one p = Z.succ (double p)
let match_positive odd even one p =
  if Z.equal p Z.one then one () else if Z.is_odd p then odd (Z.shift_right p 1) else even (Z.shift_right p 1)
let match_integer zero positive negative n =
  let s = Z.sign n in if s = 0 then zero () else if s > 0 then positive n else negative (Z.neg n)
let match_natural zero positive n = if Z.sign n = 0 then zero () else positive n

(* Subtraction of positive numbers: 1 where the difference is none. *)
let to_positive n = if Z.sign n > 0 then n else Z.one
let sub_positive a b = to_positive (Z.sub a b)
let pred_positive a = to_positive (Z.pred a)

(* Shifts and quotients round down. *)
let rec shiftl n k = if Z.sign k >= 0 then Z.shift_left n (Z.to_int k) else shiftr n (Z.neg k)
and shiftr n k =
  if Z.sign k < 0 then shiftl n (Z.neg k)
  else if Z.fits_int k then Z.shift_right n (Z.to_int k)
  else if Z.sign n < 0 then Z.minus_one else Z.zero
let div2 n = Z.shift_right n 1
let log2 n = if Z.sign n > 0 then Z.of_int (Z.numbits n - 1) else Z.zero
let div_eucl a b =
  if Z.sign b = 0 then (Z.zero, a)
  else let q = Z.fdiv a b in (q, Z.sub a (Z.mul q b))
let div a b = fst (div_eucl a b)
let modulo a b = snd (div_eucl a b)
let pow a k = if Z.sign k < 0 then Z.zero else Z.pow a (Z.to_int k)
let sqrtrem n = if Z.sign n > 0 then Z.sqrt_rem n else (Z.zero, Z.zero)
