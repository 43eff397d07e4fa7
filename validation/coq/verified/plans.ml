(* Plans of the march from the boxes of a region, and the impacts with which the scene's motion comes in. Nothing here is proved, nor need be: the
   checker follows all flights. *)

open Checker
module Z = Integers.Z

let fine = Z.shift_left Z.one 15
(* Bits, parts and halvings of the plans that are tried. *)
let attempts = [ (40, 2, 8); (64, 4, 14) ]

let ceiling a b = Z.neg (Z.fdiv (Z.neg a) b)
let at_least x y = if Z.leq x y then y else x
let at_most x y = if Z.leq x y then x else y

(* The shortest flight and the longest one that the bounds allow, in points of the grid. *)
let flights ({ data; region; properties = f; _ } : Trap.claim) =
  let bits = Flights.fine and points = Z.mul (Z.shift_left region.columns 1) fine in
  let turn = Z.shift_left (Fixed.pi bits) 1 in
  let { least; most } = data.leading.frequency in
  (* Of a time, with the frequency. *)
  let of_time w t = Z.fdiv (Z.mul points (Fixed.mul bits (Fixed.of_q bits t) (Fixed.value bits w))) turn in
  let of_periods { qnum; qden } rounded = rounded (Z.mul points qnum) qden in
  let (p, p') = f.flight_periods and (t, t') = f.flight_times in
  let shortest = at_least (of_periods p ceiling) (Z.add (of_time most t) (Z.of_int 2)) in
  let longest = at_most (at_most (of_periods p' Z.fdiv) (of_periods f.longest_flight Z.fdiv)) (Z.sub (of_time least t') Z.one) in
  (shortest, longest)

let nat = Rests.nat
let plan claim (bits, parts, halvings) =
  let shortest, longest = flights claim in
  { plan_bits = Z.of_int bits; fine; shortest; longest; parts = Z.of_int parts; halvings = nat halvings }

(* Bounds of an impact are 2^-N wide, in radians and A W; where the data are intervals wider ones are tried first. The motion is followed with more bits, several for each impact. *)
let narrow = 24
let wider = [ 7; 10; 14 ]
let bits_of_impact = 16
let most_impacts = 10_000

(* An impact as an event; and the columns around it. *)
let event ~narrow s n from (w, th, v) =
  let around x unit =
    let radius = Z.shift_right unit narrow in
    let bound x = { qnum = x; qden = Z.shift_left Z.one s.Flights.bits } in
    (bound (Z.sub x radius), bound (Z.add x radius)) in
  let time_lower, time_upper = around (Fixed.div s.bits (Z.sub th s.tau) s.w) (Fixed.div s.bits (Fixed.one s.bits) s.w) in
  let velocity_lower, velocity_upper = around (Fixed.mul s.bits v s.aw) s.aw in
  { index = Z.of_int n; mapped = Option.map (fun from -> mapping_between from w) from;
    shown = { on = w; time_lower; time_upper; velocity_lower; velocity_upper } }

let columns_around ~narrow s columns (w, th) =
  let turn = Z.shift_left (Fixed.pi s.Flights.bits) 1 in
  let seen = match w with Left -> th | Right -> Z.add th (Z.shift_right turn 1) in
  let radius = Z.shift_right (Fixed.one s.bits) (narrow - 2) in
  (Z.fdiv (Z.mul columns (Z.sub seen radius)) turn, ceiling (Z.mul columns (Z.add seen radius)) turn)

let entry ~narrow ({ data; start; region; properties; _ } : Trap.claim) = match properties.entered with
  | None -> Some { from_column = Z.zero; until_column = Z.zero; impacts_before = [] }
  | Some n when Z.gt n (Z.of_int most_impacts) -> None
  | Some n ->
    let n = Z.to_int n in
    let s = Flights.setting (Flights.fine + bits_of_impact * n) data in
    let place, th, _, u = Flights.start_of s (Begun start) in
    let wall = match place with Flights.On w -> Some w | At _ -> None in
    let rec go k place from th u events =
      if k > n then Some (List.rev events, from, th)
      else match Flights.next_contact s (place, th, u) with
        | None -> None
        | Some (near, w) ->
          match Flights.landing s (place, th, u) w near with
          | None -> None
          | Some (th, v) -> go (k + 1) (Flights.On w) (Some w) th (Z.neg (Fixed.mul s.bits s.e v)) (event ~narrow s k from (w, th, v) :: events) in
    match go 1 place wall th u [] with
    | Some (impacts_before, Some w, th) ->
      let from_column, until_column = columns_around ~narrow s region.columns (w, th) in
      Some { from_column; until_column; impacts_before }
    | _ -> None

(* The pieces of these impacts; none where none are needed. *)
let no_pieces =
  let z = Z.zero in
  Whole { origin = { start_bits = Z.one; start_scale = Z.one; start_t = z; start_rt = z; start_v = z; start_rv = z }; steps = []; next_one = None; rounds = (nat 0, nat 0) }
let pieces ({ data; start; properties; _ } : Trap.claim) entry = match properties.entered with
  | Some n when Z.sign n > 0 -> Search.pieces (first_impacts data start entry n)
  | _ -> Search.Pieces no_pieces

(* The impacts with which the motion comes in, and their pieces; or why there are none. *)
let coming ({ data; start; region; properties; _ } as claim : Trap.claim) =
  let is_in entry = match properties.entered with
    | None -> true
    | Some n -> Trapping.check_entry data start region (plan claim (List.hd attempts)) entry n in
  let rec attempt = function
    | [] -> Error "entered_at_impact: the scene's motion is not followed up to it"
    | narrow :: more ->
      match entry ~narrow claim with
      | None -> attempt []
      | Some entry ->
        match pieces claim entry with
        | Pieces pieces when more = [] || is_in entry -> Ok (entry, pieces)
        | Refused reason when more = [] -> Error ("entered_at_impact: of the impacts up to it, " ^ reason)
        | _ -> attempt more in
  let intervals = Search.intervals { scene_data = data; begun = start; events = []; ended = Impacts_reached Z.zero } in
  attempt (if intervals = [] then [ narrow ] else wider @ [ narrow ])
