(* The growth rate of the number of words: hints for the lower bounds of the entropy (Entropies.v), a factor that is at least exp h, and values of
   the h-sets, of which the words from each make at least as much. Nothing here is proved, nor need be. *)

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

(* All but the strips: what is checked of them takes no time. *)
let outline ({ chaos = { h_sets; words; per_impact; per_cycle; _ }; _ } : Words.claim) =
  let sets = List.length h_sets in
  let entry word = { from_set = word.word_from; into_set = word.word_into; strides = Stretches.strides_of word; strip_of = no_strip } in
  { found_words = { word_bits = Z.of_int Stretches.strip_bits; grid_bits = Z.of_int Stretches.grid;
                    sets = List.map (fun h_set -> Stretches.chart (Stretches.shape_of h_set)) h_sets; entries = List.map entry words };
    by_impacts = growth words sets impacts per_impact; by_half_cycles = growth words sets (fun word -> word.half_cycles) (half per_cycle) }

(* With strips of all words; or the number of a word of which no strip is found. *)
let with_strips ({ data; chaos = { h_sets; words; _ }; _ } : Words.claim) ({ found_words; _ } as outline) =
  let with_strip entry strip_of = { entry with strip_of } in
  let all strips = { outline with found_words = { found_words with entries = List.map2 with_strip found_words.entries strips } } in
  Result.map all (Stretches.found_strips data (Array.of_list (List.map Stretches.shape_of h_sets)) words)
