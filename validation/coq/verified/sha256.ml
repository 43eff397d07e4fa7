(* SHA-256 (FIPS 180-4) of a text, in hexadecimal: the name of a document, the same that `sha256sum` gives its file. *)

let mask = 0xffffffff
let rotated x n = ((x lsr n) lor (x lsl (32 - n))) land mask

(* The first 32 bits of the fractional parts of the square roots (or cube roots) of the first primes are the constants of the standard. *)
let rec root_digits power target low high = (* The greatest x with x^power <= target. *)
  if Integers.Z.leq high (Integers.Z.add low Integers.Z.one) then low
  else
    let middle = Integers.Z.shift_right (Integers.Z.add low high) 1 in
    if Integers.Z.leq (Integers.Z.pow middle power) target then root_digits power target middle high else root_digits power target low middle
let fraction power prime =
  let target = Integers.Z.shift_left (Integers.Z.of_int prime) (32 * power) in
  Integers.Z.to_int (root_digits power target Integers.Z.zero target) land mask
let primes count =
  let rec next found n =
    if List.length found = count then List.rev found
    else next (if List.exists (fun p -> n mod p = 0) found then found else n :: found) (n + 1) in
  next [] 2
let initial = lazy (Array.of_list (List.map (fraction 2) (primes 8)))
let constants = lazy (Array.of_list (List.map (fraction 3) (primes 64)))

let padded text =
  let length = String.length text in
  let zeros = (119 - length mod 64) mod 64 in
  let tail = Bytes.make (zeros + 9) '\000' in
  Bytes.set tail 0 '\x80';
  Bytes.set_int64_be tail (zeros + 1) (Int64.of_int (8 * length));
  text ^ Bytes.to_string tail

let block state text at =
  let k = Lazy.force constants and w = Array.make 64 0 in
  for i = 0 to 15 do w.(i) <- Int32.to_int (String.get_int32_be text (at + 4 * i)) land mask done;
  for i = 16 to 63 do
    let x = w.(i - 15) and y = w.(i - 2) in
    let s0 = rotated x 7 lxor rotated x 18 lxor (x lsr 3) and s1 = rotated y 17 lxor rotated y 19 lxor (y lsr 10) in
    w.(i) <- (w.(i - 16) + s0 + w.(i - 7) + s1) land mask
  done;
  let v = Array.copy state in
  for i = 0 to 63 do
    let a = v.(0) and e = v.(4) in
    let s1 = rotated e 6 lxor rotated e 11 lxor rotated e 25 and choice = (e land v.(5)) lxor (lnot e land mask land v.(6)) in
    let t1 = v.(7) + s1 + choice + k.(i) + w.(i) in
    let s0 = rotated a 2 lxor rotated a 13 lxor rotated a 22 and majority = (a land v.(1)) lxor (a land v.(2)) lxor (v.(1) land v.(2)) in
    Array.blit v 0 v 1 7;
    v.(4) <- (v.(4) + t1) land mask;
    v.(0) <- (t1 + s0 + majority) land mask
  done;
  Array.iteri (fun i x -> state.(i) <- (state.(i) + x) land mask) v

let of_text text =
  let state = Array.copy (Lazy.force initial) and text = padded text in
  for i = 0 to String.length text / 64 - 1 do block state text (64 * i) done;
  String.concat "" (Array.to_list (Array.map (Printf.sprintf "%08x") state))
