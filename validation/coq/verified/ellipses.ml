(* Hints for the checker of periodic orbits (Cycles.v, Drawn.v): ellipses of states around the first impact, the flights from there, and how a motion comes into one.
   The orbit is found from the listed bounds by Newton's method. Nothing here is proved, nor need be. *)

open Checker
open Flights
module Z = Integers.Z
module Check = Drawing.Cyc.Disc
type float = Stdlib.Float.t

let nat = Rests.nat
let column x y = { m11 = x; m12 = 0.0; m21 = y; m22 = 0.0 }
let identity = { m11 = 1.0; m12 = 0.0; m21 = 0.0; m22 = 1.0 }
let times a b = {
  m11 = a.m11 *. b.m11 +. a.m12 *. b.m21; m12 = a.m11 *. b.m12 +. a.m12 *. b.m22;
  m21 = a.m21 *. b.m11 +. a.m22 *. b.m21; m22 = a.m21 *. b.m12 +. a.m22 *. b.m22 }
let scaled x a = { m11 = x *. a.m11; m12 = x *. a.m12; m21 = x *. a.m21; m22 = x *. a.m22 }
let plus a b = { m11 = a.m11 +. b.m11; m12 = a.m12 +. b.m12; m21 = a.m21 +. b.m21; m22 = a.m22 +. b.m22 }
let transposed a = { a with m12 = a.m21; m21 = a.m12 }
let det a = a.m11 *. a.m22 -. a.m12 *. a.m21
let inverse a = let d = det a in { m11 = a.m22 /. d; m12 = -.a.m12 /. d; m21 = -.a.m21 /. d; m22 = a.m11 /. d }
let largest a = List.fold_left (fun most x -> Float.max most (abs_float x)) 0.0 [ a.m11; a.m12; a.m21; a.m22 ]
(* The Euclidean norm of a matrix, and the largest modulus of its eigenvalues. *)
let norm a =
  let s = times (transposed a) a in
  let half = (s.m11 +. s.m22) /. 2.0 in
  sqrt (half +. sqrt (Float.max 0.0 (half *. half -. det s)))
let radius a =
  let half = (a.m11 +. a.m22) /. 2.0 in
  let disc = half *. half -. det a in
  if disc >= 0.0 then abs_float half +. sqrt disc else sqrt (abs_float (det a))

(* A round: walls, the first and the last of which are one, forcing periods, and states at some bits, phases not taken modulo 2 pi. *)
type state = wall * Z.t * Z.t
type round = { s : setting; cycles : Z.t; states : state list; flights : flight list; slopes : float matrix list }

let two_pi bits = Z.shift_left (Fixed.pi bits) 1
let nearest bits a b = Fixed.round ~bits ~scale:0 (Fixed.div bits a b)
let slope f = let (a, c), (b, d) = Chains.derivative f in { m11 = a; m12 = b; m21 = c; m22 = d }
let launch s (w, th, v) = (On w, th, Z.neg (Fixed.mul s.bits s.e v))

(* The states from one on, near phases. *)
let follow s start near =
  let rec all n from = function
    | [] -> []
    | (w, th, _) :: rest ->
      match landing s (launch s from) w th with
      | None -> raise (Lost n)
      | Some (th, v) -> let state = (w, th, v) in state :: all (n + 1) state rest in
  start :: all 0 start (List.tl near)

let round_of s cycles states =
  let (_, _, v) as start = List.hd states in
  let place, th0, u = launch s start in
  let flights = along s (place, th0, v, u) (List.tl states) in
  { s; cycles; states; flights; slopes = List.map slope flights }
let total round = List.fold_left (fun product a -> times a product) identity round.slopes

(* Middles of the listed bounds. *)
let middle s { spot_phase = (a, b); spot_velocity = (c, d); _ } =
  let mid a b = Z.shift_right (Z.add (Fixed.of_q s.bits a) (Fixed.of_q s.bits b)) 1 in
  (mid a b, Fixed.div s.bits (mid c d) s.aw)
let listed s spots =
  let turn = two_pi s.bits in
  let first = List.hd spots in
  let start = (first.spot_wall, fst (middle s first), snd (middle s first)) in
  let rec all n from = function
    | [] -> []
    | spot :: rest ->
      match next_contact s (launch s from) with
      | Some (near, w) when w = spot.spot_wall ->
        let th, v = middle s spot in
        let state = (w, Z.add th (Z.mul turn (nearest s.bits (Z.sub near th) turn)), v) in
        state :: all (n + 1) state rest
      | _ -> raise (Lost n) in
  start :: all 0 start (List.tl spots @ [ first ])

(* The orbit, by Newton's method. *)
let most_steps = 40
let closed s cycles states =
  let rec better states tries =
    let states = follow s (List.hd states) states in
    let round = round_of s cycles states in
    let (w, th, v) = List.hd states and (_, th1, v1) = List.nth states (List.length states - 1) in
    let dt = Z.sub (Z.sub th1 th) (Z.mul cycles (two_pi s.bits)) and dv = Z.sub v1 v in
    if max (Z.numbits dt) (Z.numbits dv) < 24 || tries = 0 then round
    else
      let float = Fixed.to_float s.bits in
      let change = times (inverse (plus (total round) (scaled (-1.0) identity))) (column (float dt) (float dv)) in
      let moved at x = Z.sub at (Hints.of_float s.bits x) in
      better ((w, moved th change.m11, moved v change.m21) :: List.tl states) (tries - 1) in
  better states most_steps

let at_bits bits data round =
  let s = setting bits data in
  let move = Fixed.move ~from:round.s.bits ~into:bits in
  closed s round.cycles (List.map (fun (w, th, v) -> (w, move th, move v)) round.states)

(* Boxes of the centre's images in units of the grid, from radius 0. *)
let centre_radii spread round q =
  List.rev (snd (List.fold_left (fun ((rt, rv), found) f ->
    let box = Hints.radii spread f { Hints.scale = q; rt; rv } q in (box, box :: found)) ((0.0, 0.0), []) round.flights))

let widening = 1.1
let spare_bits = 48
let integer x = Z.of_float (Float.ceil x)

(* An ellipse around the orbit with half vectors that are the columns of a matrix; Newton's matrix is -1 if it is to be plain. *)
let disc data spread round ~plain vectors =
  let bits_of x = int_of_float (Float.ceil (Float.log2 x)) in
  let narrow = 1.0 /. largest (inverse vectors) in
  let growth = List.fold_left (fun most (a, b) -> Float.max most (Float.max a b)) 1.0 (centre_radii spread round 64) in
  let q = max 64 (bits_of growth - bits_of narrow + spare_bits) in
  let round = at_bits (q + 64) data round in
  let s = round.s in
  let grid = Fixed.round ~bits:s.bits ~scale:q in
  let w, th, v = List.hd round.states in
  let cu = grid th and cv = grid v in
  let exact n = Z.shift_left n (s.bits - q) in
  let round = round_of s round.cycles (follow s (w, exact cu, exact cv) round.states) in
  let unit x = Float.ldexp x q in
  let reach a = (unit (abs_float a.m11 +. abs_float a.m12), unit (abs_float a.m21 +. abs_float a.m22)) in
  let passage ((vectors, (bt, bv), th0, found) : float matrix * (float * float) * Z.t * passage list) (f, (w, th, v), (ct, cv)) =
    let vectors = times (slope f) vectors in
    let wide, _ = Hints.radii spread f { Hints.scale = q; rt = bt; rv = bv } q in
    let rt, rv = reach vectors in
    let bt = Float.ceil (widening *. rt +. ct) +. 8.0 and bv = Float.ceil (widening *. rv +. cv) +. 8.0 in
    let cut x = Z.add (grid th0) (Hints.of_float q x) in
    let cell rt rv = { at_t = grid th; by_t = integer rt; at_v = grid v; by_v = integer rv } in
    let passage = { onto = w; arrives_at = grid th; arrives_by = integer (widening *. wide +. 16.0); departed = cut f.depart; approached = cut f.approach;
                    centre_tilt = Hints.of_float q (f.bend1 /. f.rate); centre_image = cell ct cv; image_of_all = cell bt bv } in
    (vectors, (bt, bv), th, passage :: found) in
  let rec zip a b c = match a, b, c with x :: a, y :: b, z :: c -> (x, y, z) :: zip a b c | _ -> [] in
  let _, _, _, passages = List.fold_left passage (vectors, reach vectors, th, [])
    (zip round.flights (List.tl round.states) (centre_radii spread round q)) in
  let of_matrix a = { m11 = Hints.of_float q a.m11; m12 = Hints.of_float q a.m12; m21 = Hints.of_float q a.m21; m22 = Hints.of_float q a.m22 } in
  let in_coordinates = times (inverse vectors) (times (total round) vectors) in
  let one = Z.shift_left Z.one q in
  let newton, factor =
    if plain then ({ m11 = Z.neg one; m12 = Z.zero; m21 = Z.zero; m22 = Z.neg one }, Hints.of_float q ((1.0 +. Float.min 1.0 (norm in_coordinates)) /. 2.0))
    else (of_matrix (inverse (plus in_coordinates (scaled (-1.0) identity))), Z.shift_right one 1) in
  let { m11 = lu; m12 = wu; m21 = lv; m22 = wv } = of_matrix vectors in
  let _, last, _ = List.nth round.states (List.length round.states - 1) in
  { disc_bits = Z.of_int (q + 64 + Z.numbits (Z.shift_right last s.bits)); disc_scale = Z.of_int q; disc_chart = { cu; cv; lu; lv; wu; wv }; factor; newton;
    way = List.rev passages }

(* Half vectors in whose coordinates the round is a contraction: X = 1 + B^T X B with B a bit larger than the round's derivative, and X = T^-T T^-1. *)
let doublings = 60
let contracting a =
  let rho = radius a in
  if not (rho < 1.0) then raise (Lost 0);
  let rec sum x b n = if n = 0 then x else sum (plus x (times (transposed b) (times x b))) (times b b) (n - 1) in
  let x = sum identity (scaled (2.0 /. (1.0 +. rho)) a) doublings in
  let r11 = sqrt x.m11 in
  let r12 = x.m12 /. r11 in
  inverse { m11 = r11; m12 = r12; m21 = 0.0; m22 = sqrt (Float.max 1e-300 (x.m22 -. r12 *. r12)) }

(* The largest ellipse of some shape, about, that is accepted. After many flights it may have to be small: the product of their derivatives is small, those of
   its factors are not. *)
let smallest = -400
let rec largest_disc data w spread round vectors exponent =
  if exponent < smallest then raise (Lost 0);
  match disc data spread round ~plain:true (scaled (Float.ldexp 1.0 exponent) vectors) with
  | found when Check.check_disc data w round.cycles found -> found
  | _ | exception Lost _ -> largest_disc data w spread round vectors (if exponent > -60 then exponent - 3 else exponent - 20)

(* Half the widths of bounds, in the units of Step.v. *)
let half_widths s { spot_phase = (a, b); spot_velocity = (c, d); _ } =
  let half a b = Fixed.to_float s.bits (Z.sub (Fixed.of_q s.bits b) (Fixed.of_q s.bits a)) /. 2.0 in
  (half a b, half c d /. Fixed.to_float s.bits s.aw)

(* The impact whose mirror image is the first one, and the half periods between them; or that none is. *)
let mirroring s states ~is_symmetric =
  let states = List.rev (List.tl (List.rev states)) in
  let w0, th0, v0 = List.hd states in
  let pi = Fixed.pi s.bits in
  let halves (_, th, _) = Z.fdiv (Z.sub (Z.sub th th0) pi) (Z.shift_left pi 1) in
  if not is_symmetric then No_mirror (List.map halves states)
  else
    let float = Fixed.to_float s.bits in
    let off (w, th, v) = if w = w0 then infinity
      else abs_float (float (Z.add v v0)) +. abs_float (sin ((float (Z.sub th th0) -. float pi) /. 2.0)) in
    let rec best n (found, least) = function
      | [] -> found
      | state :: rest -> let x = off state in best (n + 1) (if x < least then (n, x) else (found, least)) rest in
    let n = best 0 (0, infinity) states in
    let _, th, _ = List.nth states n in
    (* th + (2 k + 1) pi is th0. *)
    Mirror_of (nat n, nearest s.bits (Z.sub (Z.sub th0 th) pi) (Z.shift_left pi 1))

let first_bits = 256
let narrower = 20
let finer = 40

let no_start data begun = { (Hints.spread data (Begun begun)) with Hints.of_phase = 0.0; of_velocity = 0.0 }

(* Ellipses around an orbit: a plain one, as large as can be, or one that holds the bounds of its first impact. *)
let around data begun ({ cycles; spots; is_symmetric; trace_bounds = (a, b); _ } as c) ~plain =
  if spots = [] then raise (Lost 0);
  let spread = no_start data begun in
  let s = setting first_bits data in
  let round = closed s cycles (listed s spots) in
  let w = (List.hd spots).spot_wall in
  let half_t, half_v = half_widths s (List.hd spots) in
  let wide_disc =
    if plain then largest_disc data w spread round (contracting (total round)) 0
    else disc data spread round ~plain:false { m11 = 4.0 *. half_t; m12 = 0.0; m21 = 0.0; m22 = 4.0 *. half_v } in
  let half_trace = Fixed.to_float s.bits (Z.sub (Fixed.of_q s.bits b) (Fixed.of_q s.bits a)) /. 2.0 in
  let _, most, least = List.fold_left2 (fun (product, most, least) slope spot ->
    let rt, rv = half_widths s spot in
    let least = Float.min least (Float.min (rt /. (abs_float product.m11 +. abs_float product.m12)) (rv /. (abs_float product.m21 +. abs_float product.m22))) in
    let product = times slope product in
    (product, Float.max most (largest product), least)) (identity, 1.0, half_trace) round.slopes spots in
  if not (least > 0.0) then raise (Lost 0);
  let turn = two_pi s.bits in
  let spot_turns = List.map2 (fun (_, th, _) spot -> nearest s.bits (Z.sub th (fst (middle s spot))) turn) (List.filteri (fun i _ -> i < List.length spots) round.states) spots in
  let rec attempt exponent tries =
    let narrow_disc = disc data spread round ~plain:false (scaled (Float.ldexp (least /. (most *. most)) (-exponent)) identity) in
    let found = { wide_disc; narrow_disc; spot_turns; first_turns = List.hd spot_turns; mirroring_of = mirroring s round.states ~is_symmetric } in
    if tries = 0 || Drawing.Cyc.check_cycle data c found then found else attempt (exponent + finer) (tries - 1) in
  attempt narrower 2

(* Of several orbits; or which one is not found. *)
let around_all data begun orbits =
  let rec all n found = function
    | [] -> Ok (List.rev found)
    | cycle :: rest ->
      match around data begun cycle ~plain:false with
      | exception Lost _ -> Error n
      | around -> all (n + 1) (around :: found) rest in
  all 0 [] orbits

(* The passage of a motion into the ellipse: the last listed impact after whole rounds that is in it; or flights on from there. *)
let most_rounds = 200

let coordinates { disc_scale; disc_chart = { cu; cv; lu; lv; wu; wv }; _ } (th, v) =
  let q = Z.to_int disc_scale in
  let f = Fixed.to_float q in
  let a = f lu and b = f lv and c = f wu and d = f wv in
  let x = f (Z.sub th cu) and y = f (Z.sub v cv) and area = a *. d -. b *. c in
  ((d *. x -. c *. y) /. area, (a *. y -. b *. x) /. area)

(* A box of all that an impact's bounds allow, on the grid of an ellipse: its radii, and the middle. *)
let box_of data q b =
  let s = setting (q + 64) data in
  let t0, t1, v0, v1 = Hints.printed_at s q b in
  let mid a b = Z.shift_right (Z.add a b) 1 and half a b = Z.add (Z.shift_right (Z.sub b a) 1) (Z.of_int 4) in
  { at_t = mid t0 t1; by_t = half t0 t1; at_v = mid v0 v1; by_v = half v0 v1 }

let turns_at { disc_scale; disc_chart; _ } th =
  let q = Z.to_int disc_scale in
  nearest q (Z.sub th disc_chart.cu) (two_pi q)
let is_inside disc { at_t; at_v; _ } =
  let turn = two_pi (Z.to_int disc.disc_scale) in
  let x, y = coordinates disc (Z.sub at_t (Z.mul (turns_at disc at_t) turn), at_v) in
  x *. x +. y *. y < 0.8

(* Flights on from a box, around the word, until whole rounds have come into the ellipse. *)
let flights_on data begun disc walls on box ~done_ =
  let q = Z.to_int disc.disc_scale in
  let spread = no_start data begun in
  let bits = q + 64 in
  let s = setting bits data in
  let each = List.length walls in
  let exact n = Z.shift_left n (bits - q) in
  let rec fly n (w, th, v) box found =
    if n mod each = 0 && n > 0 && is_inside disc box then Some (n / each, List.rev found)
    else if n > each * most_rounds then None
    else
      let wall = List.nth walls (n mod each) in
      match next_contact s (launch s (w, th, v)) with
      | Some (near, w') when w' = wall ->
        (match landing s (launch s (w, th, v)) wall near with
         | None -> None
         | Some (th1, v1) ->
           let place, th0, u = launch s (w, th, v) in
           let f = List.hd (along s (place, th0, v, u) [ (wall, th1, v1) ]) in
           let r = Hints.radii spread f { Hints.scale = q; rt = Z.to_float box.by_t; rv = Z.to_float box.by_v } q in
           let grid = Fixed.round ~bits ~scale:q in
           let image = { at_t = grid th1; by_t = integer (fst r +. 4.0); at_v = grid v1; by_v = integer (snd r +. 4.0) } in
           let cut x = Z.add (grid th) (Hints.of_float q x) in
           let passage = { onto = wall; arrives_at = image.at_t; arrives_by = image.by_t; departed = cut f.depart; approached = cut f.approach;
                           centre_tilt = Hints.of_float q (f.bend1 /. f.rate); centre_image = image; image_of_all = image } in
           (* The next flight is that of the box's centre. *)
           fly (n + 1) (wall, exact image.at_t, exact image.at_v) image (passage :: found))
      | _ -> None in
  fly done_ (on, exact box.at_t, exact box.at_v) box []

(* The number of listed events up to impact n of the list. *)
let events_up_to n events =
  let rec look k n = function
    | _ when n = 0 -> Some k
    | [] -> None
    | event :: rest -> look (k + 1) (if is_impact event then n - 1 else n) rest in
  look 0 n events

let approach ({ scene_data = data; begun; events; _ } as x) from disc =
  let walls = List.map (fun passage -> passage.onto) disc.way in
  let each = List.length walls and q = Z.to_int disc.disc_scale in
  let events_before = match Z.to_int from with n -> events_up_to n events | exception Z.Overflow -> None in
  Option.bind events_before (fun before ->
    let after = List.filteri (fun i _ -> i >= before) events in
    let last_rounds = List.length after / each in
    let w = List.nth walls (each - 1) in
    let attempt until rounds_until last_listed flights_on =
      let last = match List.rev flights_on with passage :: _ -> passage.centre_image | [] -> last_listed in
      let found = { listed_before = nat before; listed_until = nat until; rounds_until = nat rounds_until; last_listed; flights_on; turns_until = turns_at disc last.at_t } in
      if Drawing.check_approach data (first_events (nat until) x) from w disc found then Some found else None in
    let bounds_at until = match if until = 0 then None else Some (List.nth events (until - 1)) with Some (Impact_at { shown; _ }) -> Some shown | _ -> None in
    (* The latest listed impacts are the nearest. *)
    let rec listed rounds =
      if rounds = 0 then None
      else
        let until = before + rounds * each in
        let found = Option.bind (bounds_at until) (fun b ->
          let box = box_of data q b in
          if is_inside disc box then attempt until rounds box [] else None) in
        if found <> None then found else listed (rounds - 1) in
    let beyond () =
      let until = before + last_rounds * each in
      Option.bind (bounds_at until) (fun b ->
        let box = box_of data q b in
        Option.bind (flights_on data begun disc walls b.on box ~done_:0) (fun (rounds, passages) -> attempt until (last_rounds + rounds) box passages)) in
    match listed last_rounds with Some found -> Some found | None -> beyond ())
