(* Hints for the checker of words (Strips.v): parallelograms inside the listed h-sets; the stretches of each from which a word leads across another one; and cells of the stretches, with
   parallelograms that contain their images. Flights are followed in doubles, from the left wall (Reduced.v). Nothing here is proved, nor need be. *)

open Checker
module Z = Integers.Z
type float = Stdlib.Float.t

(* Bits of the checker, and of its grid. *)
let strip_bits = 80
let grid = 48
let turn = 2.0 *. Float.pi

(* d/A and e of a pair: the middle of the data, and the corners where these are intervals. *)
type pair = { gap : float; e : float }
let pairs_of data =
  let bits = Flights.fine in
  let of_ends { least; most } = List.sort_uniq compare [ Fixed.value bits least; Fixed.value bits most ] in
  let float = Fixed.to_float bits in
  let s = Flights.setting bits data in
  let gaps = List.concat_map (fun d -> List.map (fun a -> float (Fixed.div bits d a)) (of_ends data.leading.amplitude)) (of_ends data.gap) in
  let corners = List.concat_map (fun gap -> List.map (fun e -> { gap; e = float e }) (of_ends data.restitution)) gaps in
  ({ gap = float s.gamma; e = float s.e }, if List.length corners = 1 then [] else corners)

(* States: phase, and velocity before an impact on the left wall over A W. Parallelograms: centre and half vectors, in doubles. *)
type state = Chains.vector
type shape = { at : state; long : state; wide : state }
let plus (a, b) (c, d) = (a +. c, b +. d)
let minus (a, b) (c, d) = (a -. c, b -. d)
let put shape along across = plus shape.at (plus (Chains.times along shape.long) (Chains.times across shape.wide))
let coordinates_in shape x = Chains.coordinates shape.long shape.wide (minus x shape.at)

(* The first contact of a flight from the left wall: how long it takes, and whether it is with the far wall. *)
let first_step = 0.02
let most_steps = 20_000
let first_contact { gap; e } (th, v) =
  let u = -.e *. v in
  let height h = sin th -. sin (th +. h) +. (u +. cos th) *. h in
  let rec look h steps =
    let next = h +. first_step in
    let y = height next in
    if steps = 0 then None
    else if y < 0.0 then Some (Flights.bisected height (Float.max h 1e-9) next, false)
    else if y > gap then Some (Flights.bisected (fun h -> height h -. gap) h next, true)
    else look next (steps - 1) in
  if u > 0.0 then look 0.0 most_steps else None

(* A flight to a wall: where it arrives, before half a turn is added; and the state, mirrored where the wall is the far one. *)
let arrival pair ((th, v) as x) far =
  match first_contact pair x with
  | Some (h, to_far) when to_far = far -> Some (th +. h, -.pair.e *. v +. cos th -. cos (th +. h))
  | _ -> None
let seen_from_left far (th, v) = if far then (th +. Float.pi, -.v) else (th, v)
let leap pair x far = Option.map (seen_from_left far) (arrival pair x far)
let rec walk pair x = function
  | [] -> Some x
  | far :: flights -> Option.bind (leap pair x far) (fun x -> walk pair x flights)

(* The derivative of a flight to a wall, (A.7), of the state as it is seen. *)
let derivative { e; _ } far (th, v) (th1, rate) =
  let bend0 = sin th and bend1 = sin th1 in
  let f = { Flights.from = None; wall = Left; before = v; u = -.e *. v; e; h = th1 -. th; bend0; bend1; rate; depart = 0.0; approach = 0.0; nearness = 0; reach = 0.0 } in
  let (a, b), (c, d) = Chains.derivative f in
  if far then ((a, -.b), (c, -.d)) else ((a, b), (c, d))

(* To the grid. *)
let on_grid x = Z.of_float (Float.round (Float.ldexp x grid))
let chart { at = (cu, cv); long = (lu, lv); wide = (wu, wv) } =
  { cu = on_grid cu; cv = on_grid cv; lu = on_grid lu; lv = on_grid lv; wu = on_grid wu; wv = on_grid wv }

(* A parallelogram inside a listed h-set; velocities are the opposite of speeds, and so is the direction across. *)
let inside_by = 1.0 -. 1e-9
let shape_of { left_bottom; left_top; right_bottom; right_top; _ } =
  let number q = Fixed.to_float 128 (Fixed.of_q 128 q) in
  let state (u, w) = (turn *. number u, -.number w) in
  let lb, lt, rb, rt = (state left_bottom, state left_top, state right_bottom, state right_top) in
  let quarter = Chains.times 0.25 and shrunk = Chains.times (0.25 *. inside_by) in
  { at = quarter (plus (plus lb lt) (plus rb rt)); long = shrunk (minus (plus rb rt) (plus lb lt)); wide = shrunk (minus (plus lb rb) (plus lt rt)) }

(* Whole turns that are taken off after each flight of a word from one parallelogram into another: all of them after the last one. *)
let strides_of { word_flights; half_cycles; _ } =
  let far_flights = List.length (List.filter Fun.id word_flights) in
  let all = Z.div2 (Z.add half_cycles (Z.of_int far_flights)) in
  let rec with_turns = function
    | [] -> []
    | [ far ] -> [ { far; turns_taken = all } ]
    | far :: rest -> { far; turns_taken = Z.zero } :: with_turns rest in
  with_turns word_flights

(* The passage of all states of a shape, or of a slice of it, whose corners are given. *)
let spare = 1e-11
let offsets = [ (-1.0, -1.0); (-1.0, 0.0); (-1.0, 1.0); (0.0, -1.0); (0.0, 1.0); (1.0, -1.0); (1.0, 0.0); (1.0, 1.0) ]
exception Lost

type flown = { passage : passage; image : state; slopes : Chains.vector * Chains.vector; linear : state * state; bend : state }

(* How a shape flies to a wall. *)
let passing (pair, others) far shape (next : chart) =
  let found = function Some x -> x | None -> raise Lost in
  let (th, v) as x = shape.at in
  let (th1, rate) as there = found (arrival pair x far) in
  let corners = List.map (fun (a, b) -> put shape a b) offsets in
  let near = List.fold_left (fun most pair -> List.fold_left (fun most x ->
    Float.max most (abs_float (fst (found (arrival pair x far)) -. th1))) most (x :: corners)) 0.0 (pair :: others) in
  let (by_phase, _), (by_velocity, _) = derivative pair false x there in
  let radius f = abs_float (f shape.long) +. abs_float (f shape.wide) in
  let wide = Float.max near (abs_float by_phase *. radius fst +. abs_float by_velocity *. radius snd) in
  let depart, approach, _ = Flights.cuts ~waves:[ (1.0, 1.0, th) ] ~u:(-.pair.e *. v) ~y0:(-.pair.gap /. 2.0) ~half_gap:(pair.gap /. 2.0) ~h:(th1 -. th) in
  let number = Fixed.to_float 0 in
  let lean n1 n2 = Z.of_float ((number n1 +. number n2 *. sin th1) /. rate) in
  let mirrored n = if far then Z.neg n else n in
  { wide_mid = on_grid th1; wide_rad = on_grid (1.05 *. wide +. spare); near_mid = on_grid th1; near_rad = on_grid (1.05 *. near +. spare);
    go = on_grid (th +. depart); come = on_grid (th +. approach);
    lean_along = lean next.wv (mirrored (Z.neg next.wu)); lean_across = lean (Z.neg next.lv) (mirrored next.lu) }

(* Directions that contract, backward from the one across the last parallelogram. *)
let contracting derivatives last =
  List.fold_right (fun d found -> match found with
    | next :: _ -> let x = Chains.preimage d next in Chains.times (1.0 /. Chains.size x) x :: found
    | [] -> found) derivatives [ last ]

(* A parallelogram around the image of a shape, along the image of its long vector and in a contracting direction. *)
let around (pair, others) far shape (image : state) long wide =
  let found = function Some x -> x | None -> raise Lost in
  let long = Chains.times (1.0 /. Chains.size long) long in
  let wide = if Chains.cross long wide > 0.0 then wide else Chains.times (-1.0) wide in
  let frame = { at = image; long; wide } in
  let corner (along, across) pair (a, b) =
    let x, y = coordinates_in frame (found (leap pair (put shape a b) far)) in
    (Float.max along (abs_float x), Float.max across (abs_float y)) in
  let along, across = List.fold_left (fun most pair -> List.fold_left (fun most offset -> corner most pair offset) most ((0.0, 0.0) :: offsets)) (0.0, 0.0) (pair :: others) in
  (along, across, frame)

let wider = 1.06
let image_of pairs far shape image long wide =
  let along, across, frame = around pairs far shape image long wide in
  { frame with long = Chains.times (wider *. along +. spare) frame.long; wide = Chains.times (wider *. across +. spare) frame.wide }
