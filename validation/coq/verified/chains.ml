(* Hints for the checker of shadowed orbits (Shadow.v): parallelograms around the impacts, and the links between them. The middles of the
   listed bounds are made an orbit but for tiny jumps, by Newton's method on all impacts at once, in the directions that expand and
   contract; the parallelograms are far smaller than the bounds. Nothing here is proved, nor need be. *)

open Checker
open Flights
module Z = Integers.Z
type float = Stdlib.Float.t

(* Steps of Newton's method. *)
let steps = 4
(* Bits by which parallelograms are narrower than the narrowest bounds, bits that they are given to, and bits of the check beyond those. *)
let narrower = 36
let vector_bits = 44
let spare_bits = 48
(* The factor by which a parallelogram covers more than the next one needs. *)
let margin = 1.02

(* By phase and velocity. *)
type vector = float * float
let cross (a, b) (c, d) = a *. d -. b *. c
let size (a, b) = Float.hypot a b
let times x (a, b) = (x *. a, x *. b)

(* The derivative of a flight, before an impact to before the next one: (A.7), by its columns. *)
let derivative f =
  let by_phase = (f.bend0 *. f.h +. f.u) /. f.rate and by_velocity = f.e *. f.h /. f.rate in
  ((by_phase, f.bend1 *. by_phase -. f.bend0), (by_velocity, f.bend1 *. by_velocity -. f.e))
let image ((a, b), (c, d)) (x, y) = (a *. x +. c *. y, b *. x +. d *. y)
let preimage ((a, b), (c, d)) (x, y) =
  let det = a *. d -. b *. c in
  ((d *. x -. c *. y) /. det, (a *. y -. b *. x) /. det)

(* Coordinates of a vector along two others. *)
let coordinates u s x = let area = cross u s in (cross x s /. area, cross u x /. area)

(* The states: wall, phase and velocity at the start and before each impact. *)
type state = { wall : wall; th : Z.t; v : Z.t }
let launch s { wall; th; v } = (On wall, th, v, Z.neg (Fixed.mul s.bits s.e v))
let flights_of s states =
  along s (launch s states.(0)) (List.map (fun { wall; th; v } -> (wall, th, v)) (List.tl (Array.to_list states)))

(* The directions at all states that expand, forward from that in which starts vary, and those that contract, backward; with the factors. *)
let directions start derivatives =
  let n = Array.length derivatives in
  let u = Array.make (n + 1) start and s = Array.make (n + 1) (let x, y = start in (-.y, x)) in
  let a = Array.make n 1.0 and b = Array.make n 1.0 in
  for k = 0 to n - 1 do
    let x = image derivatives.(k) u.(k) in
    a.(k) <- size x;
    u.(k + 1) <- times (1.0 /. a.(k)) x
  done;
  if n > 0 then s.(n) <- (let x, y = u.(n) in (-.y, x));
  for k = n - 1 downto 1 do
    let x = preimage derivatives.(k) s.(k + 1) in
    let factor = 1.0 /. size x in
    s.(k) <- times factor x;
    b.(k) <- factor
  done;
  (* Areas are positive, so factors may be negative. *)
  for k = 1 to n do
    if cross u.(k) s.(k) < 0.0 then begin
      s.(k) <- times (-1.0) s.(k);
      b.(k - 1) <- -.b.(k - 1);
      if k < n then b.(k) <- -.b.(k)
    end
  done;
  (u, s, a, b)

(* The states are moved so that each is nearer to the image of the one before. *)
let improved s start states =
  let n = Array.length states - 1 in
  let derivatives = Array.of_list (List.map derivative (flights_of s states)) in
  let u, contracting, a, b = directions start derivatives in
  let float = Fixed.to_float s.bits in
  let jump k =
    let place, th, _, v = launch s states.(k) and next = states.(k + 1) in
    match landing s (place, th, v) next.wall next.th with
    | None -> raise (Lost k)
    | Some (th, v) -> coordinates u.(k + 1) contracting.(k + 1) (float (Z.sub next.th th), float (Z.sub next.v v)) in
  let jumps = Array.init n jump in
  let along = Array.make (n + 1) 0.0 and across = Array.make (n + 1) 0.0 in
  for k = n - 1 downto 0 do along.(k) <- (along.(k + 1) +. fst jumps.(k)) /. a.(k) done;
  for k = 0 to n - 1 do across.(k + 1) <- (if k = 0 then 0.0 else b.(k) *. across.(k)) -. snd jumps.(k) done;
  Array.mapi (fun k state ->
    let (x, y), (z, w) = (times along.(k) u.(k), times across.(k) contracting.(k)) in
    let moved at by = Z.add at (Hints.of_float s.bits by) in
    { state with th = moved state.th (x +. z); v = moved state.v (y +. w) }) states

(* Half sides along and across: from the end backward what the next one needs, and forward what comes from the one before. *)
let sides least derivatives (u, s, a, b) =
  let n = Array.length a in
  let along = Array.make (n + 1) least and across = Array.make (n + 1) least in
  let first, beside = if n = 0 then (0.0, 0.0) else coordinates u.(1) s.(1) (image derivatives.(0) s.(0)) in
  for k = 0 to n - 1 do
    across.(k + 1) <- max least (margin *. ((if k = 0 then abs_float beside else abs_float b.(k)) *. across.(k) +. least))
  done;
  for k = n - 1 downto 0 do
    let beside = if k = 0 then abs_float first *. across.(0) else 0.0 in
    along.(k) <- max least (margin *. (along.(k + 1) +. least +. beside) /. a.(k))
  done;
  (along, across)

(* Half of the narrowest bounds, in the units of Step.v. *)
let narrowest s ~is_of_times { start_times; start_velocities; _ } events =
  let float = Fixed.to_float s.bits in
  let half (lower, upper) = float (Z.sub (Fixed.of_q s.bits upper) (Fixed.of_q s.bits lower)) /. 2.0 in
  let of_event { shown = { time_lower; time_upper; velocity_lower; velocity_upper; _ }; _ } =
    min (half (time_lower, time_upper) *. float s.w) (half (velocity_lower, velocity_upper) /. float s.aw) in
  let of_start = if is_of_times then half start_times *. float s.w else half start_velocities /. float s.aw in
  List.fold_left (fun least event -> min least (of_event event)) of_start events

let chart_of q { th; v; _ } ~bits (along, across) (u, s) =
  let grid = Fixed.round ~bits ~scale:q and vector x = Hints.of_float q x in
  let (lu, lv), (wu, wv) = (times along u, times across s) in
  { cu = grid th; cv = grid v; lu = vector lu; lv = vector lv; wu = vector wu; wv = vector wv }

(* The link from one parallelogram to the next; f is the flight between their middles. *)
let link_of q f d from into =
  let radius (x, y) = abs_float x +. abs_float y in
  let number n = Fixed.to_float 0 n in
  let (by_phase, _), (by_velocity, _) = d in
  let arrival (x, y) = by_phase *. x +. by_velocity *. y in
  let long = (number from.lu, number from.lv) and wide = (number from.wu, number from.wv) in
  let near = abs_float (arrival long) +. abs_float (arrival wide) in
  let far = abs_float by_phase *. (radius (fst long, fst wide)) +. abs_float by_velocity *. (radius (snd long, snd wide)) in
  let bracket x = Z.of_float (Float.ceil (1.05 *. x +. 16.0)) in
  let tilt n1 n2 = Z.of_float ((number n1 +. number n2 *. f.bend1) /. f.rate) in
  let cut x = Z.add from.cu (Hints.of_float q x) in
  let all = Z.pow (Z.of_int 2) q in
  { stretch_from = Z.neg all; stretch_to = all; wide_at = into.cu; wide_by = bracket (Float.max near far); near_at = into.cu; near_by = bracket near;
    leave = cut f.depart; arrive = cut f.approach; tilt_along = tilt into.wv (Z.neg into.wu); tilt_across = tilt (Z.neg into.lv) into.lu;
    turned_over = false }

(* `None` where the next impact, after the time of an outcome `time-reached`, is not found. *)
let of_document { scene_data; begun; events; ended } near =
  let wall, t, v = match begun with Struck (w, t, v) -> (w, t, v) | Inside _ -> invalid_arg "a start inside the gap" in
  (* Starts differ by their velocities, or by their times where velocities do not matter. *)
  let is_of_times = fst near.start_velocities = snd near.start_velocities in
  let direction = if is_of_times then (1.0, 0.0) else (0.0, 1.0) in
  let least = Float.log2 (narrowest (setting fine scene_data) ~is_of_times near events) in
  if not (Float.is_finite least) then raise (Lost 0);
  let least = narrower - int_of_float (Float.floor least) in
  let q = least + vector_bits in
  let s = setting (max fine (2 * q)) scene_data in
  let start = match start_of s (Begun (Struck (wall, t, v))) with _, th, v, _ -> { wall; th; v } in
  let shown = List.map (fun event -> event.shown) events in
  let found afterwards =
    let states = List.map (fun shown -> let th, v = middle_of s shown in { wall = shown.on; th; v }) (shown @ Option.to_list afterwards) in
    let rec better n states = if n = 0 then states else better (n - 1) (improved s direction states) in
    let states = better steps (Array.of_list (start :: states)) in
    let flights = Array.of_list (flights_of s states) in
    let derivatives = Array.map derivative flights in
    let (u, contracting, _, _) as all = directions direction derivatives in
    let along, across = sides (Float.ldexp 1.0 (-least)) derivatives all in
    let charts = Array.mapi (fun k state -> chart_of q state ~bits:s.bits (along.(k), across.(k)) (u.(k), contracting.(k))) states in
    let links = List.init (Array.length flights) (fun k -> (link_of q flights.(k) derivatives.(k) charts.(k) charts.(k + 1), charts.(k + 1))) in
    (* A velocity of 0 is an end of those of its parallelogram: the others are towards the wall as well. *)
    let inward ({ cv; wv; _ } as chart) =
      let half = Z.shift_right (Z.abs wv) 1 in
      { chart with cv = Z.add cv (Z.mul (Z.of_int (side wall)) half); wv = Z.mul (Z.of_int (Z.sign wv)) half } in
    let first_chart = if is_of_times then inward charts.(0) else charts.(0) in
    let last = states.(Array.length states - 1).th in
    { chain_bits = Z.of_int (q + spare_bits + Z.numbits (Z.shift_right (Z.abs last) s.bits)); chain_scale = Z.of_int q; first_chart; links; afterwards } in
  match ended with
  | Impacts_reached _ | Repeats _ -> Some (found None)
  | Time_reached (_, until) -> Option.map (fun next -> found (Some next)) (Hints.next_bounds scene_data (Begun begun) shown until)
