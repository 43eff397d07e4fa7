(* The flights of a claimed orbit, in the units of Step.v (phases of the reference harmonic, lengths over A, velocities over
   A W): as doubles, from the middles of the listed bounds, and their ends to many bits. Nothing here is proved, nor need be. *)

open Checker
module Z = Integers.Z
type float = Stdlib.Float.t

(* The data to `bits`: d/A, e, A W, and the harmonics as companions, the reference first. *)
type wave = { share : Z.t; ratio : Z.t; lag : Z.t }
type setting = { bits : int; gamma : Z.t; e : Z.t; w : Z.t; tau : Z.t; aw : Z.t; waves : wave list }

let setting bits data =
  let value = Fixed.middle bits in
  let a = value data.leading.amplitude and w = value data.leading.frequency and tau = value data.leading.shift in
  let wave tone =
    let ratio = Fixed.div bits (value tone.frequency) w in
    { share = Fixed.div bits (value tone.amplitude) a; ratio; lag = Z.sub (value tone.shift) (Fixed.mul bits ratio tau) } in
  let unit = { share = Fixed.one bits; ratio = Fixed.one bits; lag = Z.zero } in
  { bits; gamma = Fixed.div bits (value data.gap) a; e = value data.restitution; w; tau; aw = Fixed.mul bits a w;
    waves = unit :: List.map wave data.further }

(* The data at fewer bits. *)
let coarser bits s =
  let f = Fixed.move ~from:s.bits ~into:bits in
  let wave { share; ratio; lag } = { share = f share; ratio = f ratio; lag = f lag } in
  { bits; gamma = f s.gamma; e = f s.e; w = f s.w; tau = f s.tau; aw = f s.aw; waves = List.map wave s.waves }

(* E, E' and -E'' of the box. *)
let shaking { bits; waves; _ } th =
  let mul = Fixed.mul bits in
  List.fold_left (fun (at, rate, bend) { share; ratio; lag } ->
    let s, c = Fixed.sin_cos bits (Z.add (mul ratio th) lag) in
    let shaken = mul share s in
    (Z.add at shaken, Z.add rate (mul (mul share ratio) c), Z.add bend (mul (mul ratio ratio) shaken)))
    (Z.zero, Z.zero, Z.zero) waves

let side = function Left -> -1 | Right -> 1

(* A place of departure: a wall, or a height. *)
type place = On of wall | At of Z.t
let offset s place w = match place with
  | On from -> Z.shift_right (Z.mul (Z.of_int (side from - side w)) s.gamma) 1
  | At y -> Z.sub y (Z.shift_right (Z.mul (Z.of_int (side w)) s.gamma) 1)

(* The origin of a flight: the start of a document, or a release near a phase, given to `fine` bits. *)
type origin = Begun of beginning | Released of wall * Z.t

(* Bits for phases and velocities of which doubles are made. *)
let fine = 256

(* -E'' and -E''' of the box. *)
let pressing { bits; waves; _ } th =
  let mul = Fixed.mul bits in
  List.fold_left (fun (bend, jerk) { share; ratio; lag } ->
    let s, c = Fixed.sin_cos bits (Z.add (mul ratio th) lag) in
    let square = mul share (mul ratio ratio) in
    (Z.add bend (mul square s), Z.add jerk (mul (mul square ratio) c))) (Z.zero, Z.zero) waves

(* The phase at which the box has no acceleration, by Newton's method from one near it. *)
let rec ceasing s th tries =
  let bend, jerk = pressing s th in
  let change = Fixed.div s.bits bend jerk in
  if tries = 0 || Z.numbits change < 4 then Z.sub th change else ceasing s (Z.sub th change) (tries - 1)
let most_tries = 40

let start_of s = function
  | Begun (Struck (w, t, v)) ->
    let v = Fixed.div s.bits (Fixed.middle s.bits v) s.aw in
    (On w, Z.add (Fixed.mul s.bits s.w (Fixed.middle s.bits t)) s.tau, v, Z.neg (Fixed.mul s.bits s.e v))
  | Begun (Inside (t, y, v)) ->
    let v = Fixed.div s.bits (Fixed.middle s.bits v) s.aw in
    let a = Fixed.div s.bits s.aw s.w in
    (At (Fixed.div s.bits (Fixed.middle s.bits y) a), Z.add (Fixed.mul s.bits s.w (Fixed.middle s.bits t)) s.tau, v, v)
  | Released (w, near) -> (On w, ceasing s (Fixed.move ~from:fine ~into:s.bits near) most_tries, Z.zero, Z.zero)

(* The phase and the velocity at which a flight meets a wall, by Newton's method from a phase near it, with ever more bits;
   `None` if it does not settle. *)
let first_bits = 192
let most_steps = 60

let landing s (place, th0, u) w near =
  let rec step bits th tries =
    let s' = coarser bits s and f = Fixed.move ~from:s.bits ~into:bits in
    let th0 = f th0 and u = f u and place = (match place with At y -> At (f y) | on -> on) in
    let at0, rate0, _ = shaking s' th0 and at, rate, _ = shaking s' th in
    let total = Z.add u rate0 in
    let velocity = Z.sub total rate in
    let height = Z.add (offset s' place w) (Z.add (Z.sub at0 at) (Fixed.mul bits total (Z.sub th th0))) in
    let change = Fixed.div bits height velocity in
    let th1 = Z.sub th change in
    let is_near = Z.numbits change < bits / 2 - 20 in
    if tries = 0 || Z.numbits th1 > bits + 64 then None
    else if bits = s.bits && is_near then
      let _, rate, _ = shaking s' th1 in Some (th1, Z.sub total rate)
    else
      let next = if is_near then min s.bits (2 * bits - 48) else bits in
      step next (Fixed.move ~from:bits ~into:next th1) (tries - 1) in
  let bits = min s.bits first_bits in
  step bits (Fixed.move ~from:s.bits ~into:bits near) most_steps

(* A flight as doubles, from the middles of what is listed. *)
type flight = {
  from : wall option; wall : wall;
  before : float; u : float; e : float; (* velocity before and after the departure; e, or 1 from inside the gap *)
  h : float; bend0 : float; bend1 : float; rate : float;
  depart : float; approach : float; (* cuts, from the launch on *)
  nearness : int; (* bits that extrema near a wall take *)
  reach : float;
}

let bisected f a b =
  let positive = f a > 0.0 in
  let rec halve a b n =
    let m = (a +. b) /. 2.0 in
    if n = 0 then m else if (f m > 0.0) = positive then halve m b (n - 1) else halve a m (n - 1) in
  halve a b 60

(* The zeros of f inside (0, h), in order, where |f'| <= first and |f''| <= second: parts without a zero are left out, parts on
   which f is monotone have one at most, others are halved. *)
let narrow = 1e-10
let most_work = 1e6

let zeros f f' (first, second) h =
  let rec look a b found =
    let m = (a +. b) /. 2.0 and r = (b -. a) /. 2.0 in
    if abs_float (f m) > first *. r then found
    else if r < narrow *. h then m :: found
    else if abs_float (f' m) > second *. r then
      if (f a > 0.0) <> (f b > 0.0) then bisected f a b :: found else found
    else look m b (look a m found) in
  let is_reasonable = h > 0.0 && first *. h < most_work && second *. h < most_work in
  if is_reasonable then List.rev (look (1e-9 *. h) ((1.0 -. 1e-9) *. h) []) else []

let short = 1e-3

(* `phases` are those of the harmonics at launch, with shares and ratios; y0 is the height of the launch. *)
let cuts ~waves ~u ~y0 ~half_gap ~h =
  let rate x = List.fold_left (fun sum (share, ratio, phase) ->
    sum +. 2.0 *. share *. ratio *. sin (phase +. ratio *. x /. 2.0) *. sin (ratio *. x /. 2.0)) u waves in
  let height x = List.fold_left (fun sum (share, ratio, phase) ->
    sum +. share *. (sin phase -. sin (phase +. ratio *. x) +. ratio *. x *. cos phase)) (y0 +. u *. x) waves in
  let bend x = List.fold_left (fun sum (share, ratio, phase) -> sum +. share *. ratio *. ratio *. sin (phase +. ratio *. x)) 0.0 waves in
  let jerk x = List.fold_left (fun sum (share, ratio, phase) -> sum +. share *. (ratio ** 3.0) *. cos (phase +. ratio *. x)) 0.0 waves in
  let most n = List.fold_left (fun sum (share, ratio, _) -> sum +. abs_float share *. (ratio ** n)) 0.0 waves in
  let extrema = zeros rate bend (most 2.0, most 3.0) h in
  let depart = match extrema with first :: _ -> 0.75 *. first | [] -> h /. 2.0 in
  let approach = match List.rev extrema with last :: _ -> h -. 0.75 *. (h -. last) | [] -> h /. 2.0 in
  let depart = if u <> 0.0 then depart else match zeros bend jerk (most 3.0, most 4.0) h with first :: _ -> min depart (0.75 *. first) | [] -> depart in
  let nearest = List.fold_left (fun least x -> min least (abs_float (half_gap -. abs_float (height x)))) 1.0 extrema in
  let nearness = if h < short then 0 else if nearest < 1e-9 then max_int / 4 else int_of_float (Float.ceil (-2.0 *. Float.log2 nearest)) in
  (depart, max depart approach, nearness)

let middle_of s { time_lower; time_upper; velocity_lower; velocity_upper; _ } =
  let mid a b = Z.shift_right (Z.add (Fixed.of_q s.bits a) (Fixed.of_q s.bits b)) 1 in
  (Z.add (Fixed.mul s.bits s.w (mid time_lower time_upper)) s.tau, Fixed.div s.bits (mid velocity_lower velocity_upper) s.aw)

(* The impacts of the orbit from the middle of the data, where they are found. *)
exception Lost of int

let followed s origin impacts =
  let rec all n launch = function
    | [] -> []
    | i :: rest ->
      match landing s launch i.on (fst (middle_of s i)) with
      | None -> raise (Lost n)
      | Some (th, v) -> (i.on, th, v) :: all (n + 1) (On i.on, th, Z.neg (Fixed.mul s.bits s.e v)) rest in
  let place, th, _, u = start_of s origin in
  all 0 (place, th, u) impacts

let middles s impacts = List.map (fun i -> let th, v = middle_of s i in (i.on, th, v)) impacts

(* The flights from a launch along a list of impacts, each from the one before as it is listed. *)
let along s launch impacts =
  let float = Fixed.to_float s.bits in
  let e = float s.e and half_gap = float s.gamma /. 2.0 in
  let waves_at th = List.map (fun { share; ratio; lag } ->
    let phase = Z.add (Fixed.mul s.bits ratio th) lag in
    let sine, cosine = Fixed.sin_cos s.bits phase in
    (float share, float ratio, Float.atan2 (float sine) (float cosine))) s.waves in
  let bend waves x = List.fold_left (fun sum (share, ratio, phase) -> sum +. share *. ratio *. ratio *. sin (phase +. ratio *. x)) 0.0 waves in
  let flight (place, th0, before, u) (on, th1, v) =
    let h = float (Z.sub th1 th0) and u = float u in
    let waves = waves_at th0 in
    let y0, from = match place with On w -> (float_of_int (side w) *. half_gap, Some w) | At y -> (float y, None) in
    let depart, approach, nearness = cuts ~waves ~u ~y0 ~half_gap ~h in
    let reach = List.fold_left (fun sum (share, ratio, _) -> sum +. share *. max 1.0 ratio) 0.0 waves in
    let next = (On on, th1, v, Z.neg (Fixed.mul s.bits s.e v)) in
    ({ from; wall = on; before = float before; u; e = (if from = None then 1.0 else e); h; bend0 = bend waves 0.0; bend1 = bend waves h;
       rate = float v; depart; approach; nearness; reach }, next) in
  let rec all launch = function
    | [] -> []
    | i :: rest -> let found, next = flight launch i in found :: all next rest in
  all launch impacts

(* All flights of a list of impacts: from the middles of their bounds, or, where the data are intervals and bounds may be wide, from
   the middle of the data. *)
let listed ~is_point data origin impacts =
  let s = setting fine data in
  along s (start_of s origin) (if is_point then middles s impacts else followed s origin impacts)

(* Approximate phase at which a flight first meets a wall, and that wall: by steps that grow from the launch on, up to `steps_per_radian`
   steps in each radian of the fastest harmonic. *)
let steps_per_radian = 200.0
let most_steps_of_flight = 2_000_000
let first_step = 1e-9
let growth = 0.05

let next_contact ?(from = 0.0) s (place, th0, u) =
  let float = Fixed.to_float s.bits in
  let at0, rate0, _ = shaking s th0 and half_gap = float s.gamma /. 2.0 in
  let slope = float (Z.add u rate0) in
  let y0 = match place with On w -> float_of_int (side w) *. half_gap | At y -> float y in
  let waves = List.map (fun { share; ratio; lag } ->
    let sine, cosine = Fixed.sin_cos s.bits (Z.add (Fixed.mul s.bits ratio th0) lag) in
    (float share, float ratio, Float.atan2 (float sine) (float cosine))) s.waves in
  let height x = List.fold_left (fun sum (share, ratio, phase) -> sum -. share *. sin (phase +. ratio *. x)) (y0 +. float at0 +. slope *. x) waves in
  let beyond x = abs_float (height x) -. half_gap in
  let fastest = List.fold_left (fun most (_, ratio, _) -> max most ratio) 1.0 waves in
  let longest = 1.0 /. (steps_per_radian *. fastest) in
  let rec look from steps =
    let x = from +. min longest (max first_step (growth *. from)) in
    if steps = 0 then None
    else if beyond x > 0.0 && from > 0.0 then
      let x = bisected beyond from x in
      Some (Z.add th0 (Z.shift_left (Z.of_float (Float.ldexp x 60)) (s.bits - 60)), if height x > 0.0 then Right else Left)
    else look x (steps - 1) in
  look from most_steps_of_flight
