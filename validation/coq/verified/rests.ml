(* Hints for documents of orbits from the scene's start: flights from the start or a release on, the rests that they end with, and releases.
   Nothing here is proved, nor need be. *)

open Checker
open Flights
module Z = Integers.Z
type float = Stdlib.Float.t

(* Bits beyond those of the last box, and of the computation beyond these. *)
let spare_bits = 16
let working_spare = 64
(* The factor by which bounds of the contact force are wider than they need be, and the tolerance of a root. *)
let slack = 1e-13
let wide = 1.0 +. 1e-12
(* A rest at once is shown to last so long at most, in phase, and the contact force to decrease by this from a release on. *)
let longest = 1e-3
let falls_for = 0.5
(* Bits to begin with after a release. *)
let bits_of_release = 128

(* The waves as doubles, each with its phase. *)
let waves_at s th =
  let float = Fixed.to_float s.bits in
  List.map (fun { share; ratio; lag } ->
    let sine, cosine = Fixed.sin_cos s.bits (Z.add (Fixed.mul s.bits ratio th) lag) in
    (float share, float ratio, Float.atan2 (float sine) (float cosine))) s.waves

(* Bounds of the contact force, from a phase on for some length, harmonic by harmonic as the checker has them. *)
let press s th length w =
  let pi = Float.pi in
  let turns_between a b x = Float.floor ((b -. x) /. (2.0 *. pi)) > Float.floor ((a -. x) /. (2.0 *. pi)) in
  List.fold_left (fun (low, high) (share, ratio, a) ->
    let factor = share *. ratio *. ratio *. float_of_int (side w) and b = a +. ratio *. length in
    let least = if turns_between a b (-.pi /. 2.0) then -1.0 else min (sin a) (sin b) in
    let most = if turns_between a b (pi /. 2.0) then 1.0 else max (sin a) (sin b) in
    let x = factor *. least and y = factor *. most in
    let off = abs_float factor *. 1e-16 in
    (low +. min x y -. off -. slack *. abs_float (min x y), high +. max x y +. off +. slack *. abs_float (max x y))) (0.0, 0.0) (waves_at s th)
let total s n = List.fold_left (fun sum { share; ratio; _ } ->
  sum +. abs_float (Fixed.to_float s.bits share) *. (Fixed.to_float s.bits ratio ** n)) 0.0 s.waves

let phase_of s q = Z.add (Fixed.mul s.bits s.w (Fixed.of_q s.bits q)) s.tau
(* A radius of a box, and its left end at the bits of its centre. *)
let radius (box : Hints.box) r = Float.ldexp r (-box.scale)
let left_end s th (box : Hints.box) = Z.sub th (Hints.of_float s.bits (radius box (box.rt +. 2.0)))
let size th s = Z.numbits (Z.abs (Z.shift_right th s.bits)) + 1

(* After the last impact, or the start: phases from the left end of its box on, and what is left of the listed bounds; of a chatter
   with the factor by which velocities prolong it. *)
let chatter s th v (box : Hints.box) w upper =
  let from = left_end s th box in
  let length = Fixed.to_float s.bits (Z.sub (phase_of s upper) from) in
  let low, high = press s from length w in
  let e = Fixed.to_float s.bits s.e in
  let root = if low > 0.0 then sqrt (high /. low) *. wide else infinity in
  let factor = 2.0 *. e /. (low *. (1.0 -. e *. root)) in
  (length, low, high, root, factor, Fixed.to_float s.bits (Z.sub (phase_of s upper) th) -. factor *. abs_float (Fixed.to_float s.bits v))

(* Bits that are wanting for a rest within its bounds. *)
let wanting_of_rest w lower upper bounces s _ (s1, th, v, (box : Hints.box)) =
  let float = Fixed.to_float s1.bits in
  let before = float (Z.sub th (phase_of s1 lower)) in
  let room, needed =
    if bounces then
      let _, _, _, _, factor, room = chatter s1 th v box w upper in
      (min room (2.0 *. before), radius box (box.rt +. factor *. box.rv +. 4.0))
    else (min before (float (Z.sub (phase_of s1 upper) th)), radius box (box.rt +. 4.0)) in
  if not (Float.is_finite needed) || room <= 0.0 then 0
  else max 0 (int_of_float (Float.ceil (Float.log2 (4.0 *. needed /. room))))

let rest (s, th, v, (box : Hints.box)) w upper bounces =
  let q = box.scale + spare_bits in
  let p = q + working_spare + size th s in
  let grid = Hints.floor_at ~bits:s.bits ~scale:q and number x = Hints.of_float q x in
  let common = { rest_bits = Z.of_int p; rest_scale = Z.of_int q; ends = Z.zero; low = Z.zero; high = Z.zero; ratio = Z.zero } in
  if bounces then
    let _, low, high, root, _, _ = chatter s th v box w upper in
    { common with ends = Z.succ (grid (phase_of s upper)); low = number low; high = Z.succ (number high); ratio = (if Float.is_finite root then number root else Z.zero) }
  else
    let bend, _ = pressing s th in
    let length = min longest (0.25 *. abs_float (Fixed.to_float s.bits bend) /. total s 3.0) in
    { common with ends = Z.add (grid th) (number (length +. radius box (box.rt +. 4.0))) }

(* A release from a rest whose phases begin at `held`, given to `fine` bits; s, th and scale are those of the flights that follow. *)
let release s (first : start) held =
  let q = Z.to_int first.start_scale in
  let th = Z.shift_left first.start_t (s.bits - q) in
  let _, jerk = pressing s th in
  let falls = min falls_for (0.4 *. abs_float (Fixed.to_float s.bits jerk) /. total s 4.0) in
  let held_from = Z.sub (Hints.floor_at ~bits:fine ~scale:q held) (Z.of_int 2) in
  (* Not from before the rest. *)
  let falls = Z.min (Hints.of_float q falls) (Z.shift_right (Z.sub first.start_t held_from) 1) in
  { release_bits = Z.of_int (q + working_spare + size th s); release_scale = first.start_scale; held_from; ceases = first.start_t;
    ceases_by = first.start_rt; falls_by = Z.max first.start_rt falls }

(* Bits that are wanting for a release within its bounds; none where these are one number. *)
let bits_of_bounds = 2048
let off_centre = 20 (* bits: it may be near one of them *)
let wanting_of_release lower upper s _ =
  let width = Fixed.to_float bits_of_bounds (Z.sub (Fixed.of_q bits_of_bounds upper) (Fixed.of_q bits_of_bounds lower)) *. Fixed.to_float s.bits s.w in
  if width <= 0.0 then 0 else max 0 (int_of_float (Float.ceil (-.Float.log2 width)) + off_centre - (s.bits - Hints.working_spare))

let middle_phase s lower upper = Z.shift_right (Z.add (phase_of s lower) (phase_of s upper)) 1

(* Impacts up to a rest or the end, the rest of the list. *)
let rec impacts_of found = function
  | Impact_at event :: rest -> impacts_of (event.shown :: found) rest
  | rest -> (List.rev found, rest)

(* The next release, for an outcome `time-reached` that finds the ball at rest: where the contact force vanishes after a phase, by steps. *)
let step = 1e-3
let most_steps = 1_000_000
let next_release s w held =
  let presses x = Fixed.to_float s.bits (fst (pressing s x)) *. float_of_int (side w) > 0.0 in
  let by = Hints.of_float s.bits (step /. total s 0.0 *. abs_float (Fixed.to_float s.bits (List.hd s.waves).share)) in
  let rec look x n = if n = 0 then None else if presses (Z.add x by) then look (Z.add x by) (n - 1) else Some x in
  Option.map (fun x -> ceasing s x most_tries) (look held most_steps)
let release_after data w held =
  let s = setting fine data in
  let bounds th =
    let time = Fixed.div fine (Z.sub th s.tau) s.w and half = Z.shift_left Z.one (fine - 40) in
    let q n = { qnum = Z.shift_right n (fine - 64); qden = Z.shift_left Z.one 64 } in
    Release_at (w, q (Z.sub time half), q (Z.add time half)) in
  Option.map bounds (next_release s w held)

exception No_next

(* The steps from the start or a release on; `held` is the phase at which a release's rest begins. *)
let rec steps data from ~first_at ~bounds occurrences until n =
  let impacts, others = impacts_of [] occurrences in
  let at_end, impacts, next = match others, until with
    | [], Some until ->
      (match Hints.next_bounds data from impacts until with
       | None -> raise No_next
       | Some next -> (true, impacts @ [ next ], Some (Impact_at { index = Z.zero; mapped = None; shown = next })))
    | _ -> (others = [], impacts, None) in
  let of_release = match bounds with None -> (fun _ _ -> 0) | Some (lower, upper) -> wanting_of_release lower upper in
  let more s th last = match others with
    | Rest_at (w, lower, upper, bounces) :: _ -> max (of_release s th) (wanting_of_rest w lower upper bounces s th last)
    | _ -> of_release s th in
  let flown = try Hints.of_impacts data from impacts ~more with Lost k -> raise (Lost (n + k)) in
  let legs = List.map (fun leg -> Flight leg) flown.legs and n = n + List.length impacts in
  let here = first_at flown.first in
  if at_end then (flown.first, here @ legs, next)
  else match others with
    | Rest_at (w, _, upper, bounces) :: others ->
      let s, th, _, box = flown.last in
      let held = Fixed.move ~from:s.bits ~into:fine (left_end s th box) in
      let resting = Rest (rest flown.last w upper bounces) in
      let go_on w lower upper others until =
        let near = middle_phase (setting fine data) lower upper in
        let first_at first =
          let s = setting (Z.to_int first.start_scale + Hints.working_spare) data in [ Release (release s first held) ] in
        let _, after, next = steps data (Released (w, near)) ~first_at ~bounds:(Some (lower, upper)) others until (n + 2) in
        (flown.first, here @ legs @ (resting :: after), next) in
      (match others, until with
       | Release_at (w, lower, upper) :: others, _ -> go_on w lower upper others until
       | [], Some _ ->
         (match release_after data w held with
          | Some (Release_at (w, lower, upper) as next) -> let first, steps, _ = go_on w lower upper [] None in (first, steps, Some next)
          | _ -> raise No_next)
       | [], _ -> (flown.first, here @ legs @ [ resting ], None)
       | _ -> raise (Lost n))
    | _ -> raise (Lost n)

(* The number of events up to the first release that recurs after the claimed number of forcing periods, and from there up to its recurrence. *)
let same_phase = 1e-9
let rounds data cycles occurrences =
  let s = setting fine data in
  let turn = 2.0 *. Float.pi in
  let is_whole x = abs_float (x -. Float.round x) < same_phase in
  let releases = List.concat (List.mapi (fun n o -> match o with
    | Release_at (w, lower, upper) -> [ (n + 1, w, Fixed.to_float fine (middle_phase s lower upper)) ]
    | _ -> []) occurrences) in
  let ratios = List.map (fun { ratio; _ } -> Fixed.to_float fine ratio) s.waves in
  let comes_again (_, w, a) (_, w', b) = w = w' && b > a && is_whole ((b -. a) /. turn)
    && List.for_all (fun ratio -> is_whole (Float.round ((b -. a) /. turn) *. ratio)) ratios in
  let is_claimed (_, _, a) (_, _, b) = Float.round ((b -. a) /. turn) = Z.to_float cycles in
  let rec first before = function
    | [] -> (0, 0)
    | ((b, _, _) as release) :: later ->
      match List.find_opt (fun earlier -> comes_again earlier release && is_claimed earlier release) before with
      | Some (a, _, _) -> (a, b - a)
      | None -> first (release :: before) later in
  first [] releases

let rec nat n = if n = 0 then O else S (nat (n - 1))

(* All that helps to verify a document; `None` where the next event is not found. *)
let of_document ({ scene_data; begun; events; ended } : document) =
  let until, (before, round) = match ended with
    | Impacts_reached _ -> (None, (0, 0))
    | Time_reached (_, until) -> (Some until, (0, 0))
    | Repeats (_, until, cycles, _) -> (until, rounds scene_data cycles events) in
  match steps scene_data (Begun begun) ~first_at:(fun _ -> []) ~bounds:None events until 0 with
  | exception No_next -> None
  | origin, steps, next_one -> Some { origin; steps; next_one; rounds = (nat before, nat round) }
