(* Hints for the checker: boxes around the impacts on grids of powers of two, and where the flights between them are cut
   (validation/coq/README.md has the formulas). Nothing here is proved, nor need be. *)

open Checker
module Z = Integers.Z
type float = Stdlib.Float.t
open Flights

type box = { scale : int; rt : float; rv : float }

let wide = 4096.0
let few_bits = 10.0
let spare_bits = 20
let margin = 1.01
(* Of data that are intervals boxes must be narrow: no more than their own second order. *)
let least_margin = 1e-5
(* Bits of the first scale beyond those for the listed bounds, and of the computation beyond the scale. *)
let first_spare = 12
let working_spare = 96

let coarser scale radius = if radius > wide then max 1 (scale - int_of_float (Float.log2 radius -. few_bits)) else scale
let exp2 n = Float.ldexp 1.0 n
let scaled scale x = if x > 0.0 then Float.ldexp x scale else 0.0

(* Half the widths of what is an interval: e, d/A, phase and velocity of the start; and how far the other harmonics are unknown. *)
type spread = { of_e : float; of_gap : float; of_phase : float; of_velocity : float; of_time : float }

let spread data origin =
  let value r = Fixed.to_float fine (Fixed.middle fine r) and half = Fixed.half_width in
  let relative r = let x = half r in if x = 0.0 then 0.0 else x /. abs_float (value r) in
  let { amplitude = a; frequency = w; shift = tau } = data.leading in
  let unit = value a *. value w in
  let pair = { of_e = half data.restitution; of_gap = value data.gap /. value a *. (relative data.gap +. relative a); of_phase = 0.0;
               of_velocity = 0.0; of_time = relative w } in
  let started t v = { pair with of_phase = abs_float (value t) *. half w +. value w *. half t +. half tau;
    of_velocity = half v /. unit +. abs_float (value v /. unit) *. (relative a +. relative w) } in
  match origin with
  | Begun (Struck (_, t, v)) -> started t v
  | Begun (Inside (t, y, v)) -> { (started t v) with of_gap = pair.of_gap +. 2.0 *. half y /. value a }
  | Released _ -> pair

let is_point s = s.of_e +. s.of_gap +. s.of_phase +. s.of_velocity +. s.of_time = 0.0

(* Radii of the box of arrival in units of 2^-scale, by (A.7). *)
let radii spread f from scale =
  let tilt = f.bend1 /. f.rate in
  let turned = f.bend0 *. f.h +. f.u in
  let by_phase = (abs_float (turned /. f.rate), abs_float (tilt *. turned -. f.bend0)) in
  let by_speed = (abs_float (f.e *. f.h /. f.rate), abs_float (f.e *. (1.0 -. tilt *. f.h))) in
  let shrunk = exp2 (scale - from.scale) in
  let rt = (from.rt +. 1.0) *. shrunk and rv = (from.rv +. 1.0) *. shrunk in
  let of_e = scaled scale spread.of_e and off = scaled scale spread.of_gap in
  let data_t = (of_e *. abs_float f.before *. f.h +. off) /. abs_float f.rate in
  let data_v = of_e *. abs_float (f.before *. (1.0 -. tilt *. f.h)) +. off *. abs_float tilt in
  let slack = 16.0 *. exp2 (-spare_bits) in
  let curved = 8.0 *. (rt +. rv) *. exp2 (-scale) *. (1.0 +. abs_float tilt) /. abs_float f.rate in
  let margin = if is_point spread then margin else 1.0 +. max least_margin (min 0.01 curved) in
  let total (p, s, d, g) = Float.ceil (margin *. (p *. rt +. s *. rv +. d) +. 4.0 +. g) in
  (total (fst by_phase, fst by_speed, data_t, slack /. abs_float f.rate), total (snd by_phase, snd by_speed, data_v, slack *. abs_float tilt))

let arrival spread from f =
  let rt, rv = radii spread f from from.scale in
  let scale = coarser from.scale (max rt rv) in
  let rt, rv = radii spread f from scale in
  { scale; rt; rv }

let chain spread origin flights =
  List.rev (fst (List.fold_left (fun (boxes, from) f -> let box = arrival spread from f in (box :: boxes, box)) ([], origin) flights))

(* The precision of the check, and that of its parts with bits to spare. *)
let precisions f th1 scale =
  let size = max (float_of_int (Z.numbits (Z.abs th1) + 1)) (max (Float.log2 (abs_float (f.u *. f.h) +. 1e-300)) 1.0) in
  let size = int_of_float (Float.ceil (size +. max 0.0 (Float.log2 f.reach))) in
  let bits = scale + spare_bits + size in
  let steep = int_of_float (Float.ceil (6.0 *. max 0.0 (-. Float.log2 (abs_float f.rate)))) in
  (bits, min bits (40 + size + steep + f.nearness))

(* By how many bits a box is too wide: for the listed bounds around its centre, or for terms of second order. *)
let excess f box (t, v) (lower_t, upper_t, lower_v, upper_v) =
  let wanting lower centre upper radius =
    let room = Z.to_float (Z.min (Z.sub centre (Z.succ lower)) (Z.sub upper centre)) -. 2.0 in
    if room >= radius then 0 else if room = neg_infinity then 64
    else max 1 (int_of_float (Float.ceil (Float.log2 (radius /. max 1.0 room)))) in
  let curved = Float.log2 (2.0 *. box.rt *. (1.0 +. abs_float (f.bend1 /. f.rate)) /. abs_float f.rate) in
  let curved = int_of_float (Float.ceil (curved +. 8.0)) - box.scale in
  max (max 0 curved) (max (wanting lower_t t upper_t box.rt) (wanting lower_v v upper_v box.rv))

let floor_at ~bits ~scale x = if scale >= bits then Z.shift_left x (scale - bits) else Z.shift_right x (bits - scale)

(* A double as an integer of a grid. *)
let of_float scale x = let m, e = Float.frexp x in
  let n = Z.of_float (Float.ldexp m 60) and shift = e - 60 + scale in
  if shift >= 0 then Z.shift_left n shift else Z.shift_right n (-shift)

(* The box of the start, of radius 0 where it is 0, or of a release. Enclosures of other numbers of the grid may be wider than one number. *)
let origin_box spread s from scale =
  let _, th, v, _ = start_of s from in
  let radius x spread = if spread = 0.0 && Z.sign x = 0 then 0.0 else Float.ceil (scaled scale spread) +. 2.0 in
  let rt = match from with Released _ -> 2.0 | Begun _ -> radius th spread.of_phase in
  (th, v, { scale; rt; rv = radius v spread.of_velocity })

let printed_at s scale b =
  let phase q = floor_at ~bits:s.bits ~scale (Z.add (Fixed.mul s.bits s.w (Fixed.of_q s.bits q)) s.tau) in
  let speed q = floor_at ~bits:s.bits ~scale (Fixed.div s.bits (Fixed.of_q s.bits q) s.aw) in
  (phase b.time_lower, phase b.time_upper, speed b.velocity_lower, speed b.velocity_upper)

(* The centres of the impacts, each to enough bits for its box: phase, velocity, bits. *)
let centres s from flights boxes impacts =
  let rec all n s (place, th0, u) = function
    | [] -> []
    | (f, box, i) :: rest ->
      let near, _ = middle_of s i in
      (match landing s (place, th0, u) f.wall near with
       | None -> raise (Lost n)
       | Some (th1, v) ->
         let bits = min s.bits (box.scale + working_spare) in
         let move = Fixed.move ~from:s.bits ~into:bits in
         let s' = if bits < s.bits then Flights.coarser bits s else s in
         let th1 = move th1 and v = move v in
         (s', th1, v) :: all (n + 1) s' (On f.wall, th1, Z.neg (Fixed.mul bits s'.e v)) rest) in
  let place, th, _, u = start_of s from in
  let rec zip fs bs is = match fs, bs, is with f :: fs, b :: bs, i :: is -> (f, b, i) :: zip fs bs is | _ -> [] in
  all 0 s (place, th, u) (zip flights boxes impacts)

let leg (f, box, (s, th1, v)) th0 (from : box) =
  let grid = Fixed.round ~bits:s.bits ~scale:box.scale in
  let bits, coarse = precisions f (Z.shift_right th1 s.bits) box.scale in
  let cut x = Z.add (Fixed.round ~bits:fine ~scale:box.scale th0) (of_float box.scale x) in
  let radius = Z.of_float (Float.ceil (from.rt *. exp2 (box.scale - from.scale)) +. 2.0) in
  { bits = Z.of_int bits; coarse = Z.of_int coarse; scale0 = Z.of_int box.scale; hits = f.wall; t = grid th1; rt = Z.of_float box.rt;
    v = grid v; rv = Z.of_float box.rv; depart = (if f.from = None then Z.sub (cut 0.0) radius else cut f.depart);
    approach = cut f.approach; tilt = of_float box.scale (f.bend1 /. f.rate) }

(* Flights from the start or a release on: the box there, and the legs; and the last box with its centre, before the impact. *)
type flown = { first : start; legs : leg list; last : setting * Z.t * Z.t * box }

(* Hints for these impacts, with a first scale of n bits or more; what comes after them may want more bits as well. *)
let rec from_scale data from impacts flights spread ~more least tries =
  let s = setting (least + working_spare) data in
  let th, v, origin = origin_box spread s from least in
  let origin = { origin with scale = coarser least (max origin.rt origin.rv) } in
  let th, v, origin = if origin.scale = least then (th, v, origin) else origin_box spread s from origin.scale in
  let boxes = chain spread origin flights in
  let centres = centres s from flights boxes impacts in
  let last = List.fold_left2 (fun _ box (s, th, v) -> (s, th, v, box)) (s, th, v, origin) boxes centres in
  let wanting = List.fold_left2 (fun most (f, box) ((s, th1, v), i) ->
    let grid = Fixed.round ~bits:s.bits ~scale:box.scale in
    max most (excess f box (grid th1, grid v) (printed_at s box.scale i)))
    (more s th last) (List.combine flights boxes) (List.combine centres impacts) in
  if wanting > 0 && tries > 0 && is_point spread then
    from_scale data from impacts flights spread ~more (least + wanting + 1) (tries - 1)
  else begin
    let grid = Fixed.round ~bits:s.bits ~scale:origin.scale in
    let th0 = Fixed.move ~from:s.bits ~into:fine th in
    let legs, _, _ = List.fold_left (fun (legs, th0, from) (f, box, ((s, th1, _) as centre)) ->
      (leg (f, box, centre) th0 from :: legs, Fixed.move ~from:s.bits ~into:fine th1, box)) ([], th0, origin)
      (List.map2 (fun (f, box) centre -> (f, box, centre)) (List.combine flights boxes) centres) in
    let legs = List.rev legs in
    let bits = List.fold_left (fun most (leg : leg) -> Z.max most leg.bits) (Z.of_int (origin.scale + 64)) legs in
    { first = { start_bits = bits; start_scale = Z.of_int origin.scale; start_t = grid th; start_rt = Z.of_float origin.rt;
                start_v = grid v; start_rv = Z.of_float origin.rv }; legs; last }
  end

(* The first scale at which the boxes fit into the listed bounds, about. *)
let first_scale spread flights data impacts =
  let s = setting fine data in
  let rec raise_to scale tries =
    let boxes = chain spread { scale; rt = 2.0; rv = 2.0 } flights in
    let wanting = List.fold_left2 (fun most (f, box) i ->
      let half lower upper unit = Fixed.to_float fine (Z.sub (Fixed.of_q fine upper) (Fixed.of_q fine lower)) *. unit /. 2.0 in
      let w = Fixed.to_float fine s.w and aw = Fixed.to_float fine s.aw in
      let bits radius half = if half <= 0.0 then 64 else int_of_float (Float.ceil (Float.log2 radius -. Float.log2 half)) - box.scale in
      let curved = Float.log2 (2.0 *. box.rt *. (1.0 +. abs_float (f.bend1 /. f.rate)) /. abs_float f.rate) in
      let curved = int_of_float (Float.ceil (curved +. 8.0)) - box.scale in
      List.fold_left max most [ curved; bits box.rt (half i.time_lower i.time_upper w); bits box.rv (half i.velocity_lower i.velocity_upper (1.0 /. aw)) ])
      (-first_spare) (List.combine flights boxes) impacts in
    if wanting > -first_spare && tries > 0 && scale < 1 lsl 16 then raise_to (scale + wanting + first_spare + 1) (tries - 1) else scale in
  raise_to 64 40

(* Bounds that hold nothing are not worth an attempt. *)
let compare_q a b = Z.compare (Z.mul a.qnum b.qden) (Z.mul b.qnum a.qden)
let is_empty b = compare_q b.time_lower b.time_upper >= 0 || compare_q b.velocity_lower b.velocity_upper >= 0

let of_impacts data from impacts ~more =
  List.iteri (fun n b -> if is_empty b then raise (Lost n)) impacts;
  let spread = spread data from in
  let flights = listed ~is_point:(is_point spread) data from impacts in
  from_scale data from impacts flights spread ~more (first_scale spread flights data impacts) 4

(* Bounds of the next impact, which comes after `until`: wide ones will do. *)
let widest = 1e-3
(* A ball that leaves a wall without velocity is there, for a double, for some time. *)
let without_velocity = 1e-3

let next_bounds data from impacts until =
  let s = setting fine data in
  let launch = match List.rev impacts with
    | [] -> let place, th, _, u = start_of s from in (place, th, u)
    | i :: _ -> let th, v = middle_of s i in (On i.on, th, Z.neg (Fixed.mul fine s.e v)) in
  let first = match launch with _, _, u when Z.sign u = 0 -> Some without_velocity | _ -> None in
  let bounds near w = match landing s launch w near with
    | None -> None
    | Some (th, v) ->
      let time = Fixed.div fine (Z.sub th s.tau) s.w and velocity = Fixed.mul fine v s.aw in
      let after = Fixed.to_float fine (Z.sub time (Fixed.value fine until)) in
      if after <= 0.0 then None else
      let around x half = let half = of_float fine half in (* to 64 bits *)
        let q n = { qnum = Z.shift_right n (fine - 64); qden = Z.shift_left Z.one 64 } in
        (q (Z.sub x half), q (Z.add x half)) in
      let time_lower, time_upper = around time (min widest (after /. 2.0)) in
      let velocity_lower, velocity_upper = around velocity (widest *. abs_float (Fixed.to_float fine velocity)) in
      Some { on = w; time_lower; time_upper; velocity_lower; velocity_upper } in
  match next_contact ?from:first s launch with None -> None | Some (near, w) -> bounds near w
