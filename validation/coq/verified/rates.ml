(* How fast the number of words grows: hints for the lower bounds of the entropy (Entropies.v), a factor that is at least exp h, and values of the h-sets, of which the words
   from each make at least as much. Nothing here is proved, nor need be. *)

open Checker
module Z = Integers.Z

(* Bits of the factor and of the values; the factor exceeds exp h by a few units of a double. *)
let bits = 60
let above = 1.0 +. Float.ldexp 1.0 (-48)
(* Steps of the iteration, and what is no part of the vector. *)
let steps = 20_000
let nothing = 1e-13

let growth words sets weight h =
  let factor = exp (Fixed.to_float 128 (Fixed.of_q 128 h)) *. above in
  let edge word = (Words.number word.word_from, Words.number word.word_into, factor ** -.Z.to_float (weight word)) in
  let edges = List.map edge words in
  let rec iterated n v =
    if n = 0 then v
    else begin
      let next = Array.copy v in
      List.iter (fun (b, into, part) -> next.(b) <- next.(b) +. part *. v.(into)) edges;
      let most = Array.fold_left Float.max 0.0 next in
      iterated (n - 1) (Array.map (fun x -> x /. most) next)
    end in
  let value x = if x < nothing then Z.zero else Z.of_float (Float.ldexp x bits) in
  { growth_by = { qnum = Z.of_float (Float.ldexp factor bits); qden = Fixed.one bits }; growth_values = List.map value (Array.to_list (iterated steps (Array.make sets 1.0))) }

let impacts word = Z.of_int (List.length word.word_flights)
let half { qnum; qden } = { qnum; qden = Z.shift_left qden 1 }

(* Strips of all words with both growths; or the number of a word of which no strip is found. *)
let hint ({ data; chaos = { h_sets; words; per_impact; per_cycle; _ }; _ } : Words.claim) =
  let shapes = Array.of_list (List.map Stretches.shape_of h_sets) in
  let entry word strip_of = { from_set = word.word_from; into_set = word.word_into; strides = Stretches.strides_of word; strip_of } in
  Result.map (fun strips ->
    let sets = List.length h_sets in
    { found_words = { word_bits = Z.of_int Stretches.strip_bits; grid_bits = Z.of_int Stretches.grid;
                      sets = List.map Stretches.chart (Array.to_list shapes); entries = List.map2 entry words strips };
      by_impacts = growth words sets impacts per_impact; by_half_cycles = growth words sets (fun word -> word.half_cycles) (half per_cycle) })
    (Stretches.found_strips data shapes words)
