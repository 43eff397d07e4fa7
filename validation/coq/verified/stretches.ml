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
let first_step = 0.05
let most_steps = 8_000
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

(* A flight to a wall: where it arrives, before half a forcing period is added; and the state, mirrored where the wall is the far one. *)
let arrival pair ((th, v) as x) far =
  match first_contact pair x with
  | Some (h, to_far) when to_far = far -> Some (th +. h, -.pair.e *. v +. cos th -. cos (th +. h))
  | _ -> None
let seen_from_left far (th, v) = if far then (th +. Float.pi, -.v) else (th, v)
let leap pair x far = Option.map (seen_from_left far) (arrival pair x far)
let rec walk pair x = function
  | [] -> Some x
  | far :: flights -> Option.bind (leap pair x far) (fun x -> walk pair x flights)
(* A state and, on request, those after it: whether the next flight is to the far wall, and where it ends. *)
type course = { here : state; next : (bool * course) option Lazy.t }
let rec course_of pair ((th, v) as x) =
  let next = lazy (Option.map (fun (h, far) -> (far, course_of pair (seen_from_left far (th +. h, -.pair.e *. v +. cos th -. cos (th +. h))))) (first_contact pair x)) in
  { here = x; next }
let rec walked { here; next } = function
  | [] -> Some here
  | far :: flights -> match Lazy.force next with Some (is_far, course) when is_far = far -> walked course flights | _ -> None

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

(* Whole forcing periods that are taken off after each flight of a word from one parallelogram into another: all of them after the last one. *)
let strides_of { word_flights; half_cycles; _ } =
  let far_flights = List.length (List.filter Fun.id word_flights) in
  let all = Z.shift_right (Z.add half_cycles (Z.of_int far_flights)) 1 in
  let rec with_turns = function
    | [] -> []
    | [ far ] -> [ { far; turns_taken = all } ]
    | far :: rest -> { far; turns_taken = Z.zero } :: with_turns rest in
  with_turns word_flights

(* Until when a flight departs, and from when it arrives: from its launch on it is as fast as a part of the greatest velocity so far, and the same backward from its end. *)
let parts = 64
let as_fast = 0.3
let cuts { e; _ } far (th, v) h =
  let rate k = -.e *. v +. cos th -. cos (th +. h *. float_of_int k /. float_of_int parts) in
  let rec fast rate most k = if k < parts && rate k > as_fast *. most then fast rate (Float.max most (rate k)) (k + 1) else k - 1 in
  let depart = min (parts / 2) (fast rate 0.0 0) in
  let towards k = if far then rate (parts - k) else -.rate (parts - k) in
  let approach = max depart (parts - fast towards 0.0 0) in
  let at k = h *. float_of_int k /. float_of_int parts in
  (at depart, at approach)

(* The margin of brackets and parallelograms; the corners of a shape, and the middles of its sides. *)
let spare = 1e-11
let offsets = [ (-1.0, -1.0); (-1.0, 0.0); (-1.0, 1.0); (0.0, -1.0); (0.0, 1.0); (1.0, -1.0); (1.0, 0.0); (1.0, 1.0) ]
exception Lost

(* The transit of all states of a shape to a wall, as it is seen in the next parallelogram. *)
let passing (pair, others) far shape (next : chart) =
  let found = function Some x -> x | None -> raise Lost in
  let (th, _) as x = shape.at in
  let (th1, rate) as there = found (arrival pair x far) in
  let corners = List.map (fun (a, b) -> put shape a b) offsets in
  let near = List.fold_left (fun most pair -> List.fold_left (fun most x ->
    Float.max most (abs_float (fst (found (arrival pair x far)) -. th1))) most (x :: corners)) 0.0 (pair :: others) in
  let (by_phase, _), (by_velocity, _) = derivative pair false x there in
  let radius f = abs_float (f shape.long) +. abs_float (f shape.wide) in
  let wide = Float.max near (abs_float by_phase *. radius fst +. abs_float by_velocity *. radius snd) in
  let depart, approach = cuts pair far x (th1 -. th) in
  let number = Fixed.to_float 0 in
  let lean n1 n2 = Z.of_float ((number n1 +. number n2 *. sin th1) /. rate) in
  let mirrored n = if far then Z.neg n else n in
  { wide_mid = on_grid th1; wide_rad = on_grid (1.5 *. wide +. spare); near_mid = on_grid th1; near_rad = on_grid (1.1 *. near +. spare);
    go = on_grid (th +. depart); come = on_grid (th +. approach);
    lean_along = lean next.wv (mirrored (Z.neg next.wu)); lean_across = lean (Z.neg next.lv) (mirrored next.lu) }

(* Directions that contract, backward from the one across the last parallelogram. *)
let contracting derivatives last =
  List.fold_right (fun d found -> match found with
    | next :: _ -> let x = Chains.preimage d next in Chains.times (1.0 /. Chains.size x) x :: found
    | [] -> found) derivatives [ last ]

(* The greatest absolute value of an interval of the checker. *)
let magnitude interval =
  let value bound = match ShiftFloats.toF bound with
    | Float (_, m, e) -> Float.ldexp (Fixed.to_float 0 m) (Z.to_int e)
    | Fzero -> 0.0
    | Fnan -> raise Lost in
  match interval with Ibnd0 (lower, upper) -> Float.max (value lower) (value upper) | Inan0 -> raise Lost

(* That all states of a chart arrive is not proved. *)
exception Not_landed
(* The tightest parallelogram that the checker finds around the image of a chart, along the image of its long vector and a direction that contracts. *)
let around data pairs stride c shape at derivative direction =
  let unit x = Chains.times (1.0 /. Chains.size x) x in
  let long = unit (Chains.image derivative shape.long) in
  let frame = { at; long; wide = (if Chains.cross long direction > 0.0 then unit direction else Chains.times (-1.0) (unit direction)) } in
  let m = chart frame and p = Z.of_int strip_bits and q = Z.of_int grid in
  match Striding.Each.bounds p q data stride c m (passing pairs stride.far shape m) with
  | None -> raise Not_landed
  | Some (along, across) ->
    let area = magnitude (Striding.Each.area_over p q m) in
    let by interval = Chains.times (magnitude interval /. area *. (1.0 +. 1e-6) +. spare) in
    { frame with long = by along frame.long; wide = by across frame.wide }

(* A patch of a shape: from one coordinate along to another, and from one across to another; and the smallest chart that contains it. *)
type patch = { from : float; until : float; below : float; above : float }
let whole = { from = -1.0; until = 1.0; below = -1.0; above = 1.0 }
let patch_of shape { from; until; below; above } =
  { at = put shape ((from +. until) /. 2.0) ((below +. above) /. 2.0);
    long = Chains.times ((until -. from) /. 2.0) shape.long; wide = Chains.times ((above -. below) /. 2.0) shape.wide }
let rounding = Float.ldexp 1.0 (3 - grid)
let chart_around ({ long; wide; _ } as shape) =
  let more = rounding /. Chains.cross long wide in
  chart { shape with long = Chains.times (1.0 +. more *. Chains.size wide) long; wide = Chains.times (1.0 +. more *. Chains.size long) wide }

(* The states that a state visits along a word, with the derivatives of its flights. *)
let rec orbit pair x = function
  | [] -> []
  | { far; _ } :: rest ->
    match arrival pair x far with
    | None -> raise Lost
    | Some there -> let seen = seen_from_left far there in (seen, derivative pair far x there) :: orbit pair seen rest

(* Decides whether the flights carry the states of a shape between the edges of another one, and to the claimed place along it. *)
let fits (pair, _) shape into strides extent =
  let taken = List.fold_left (fun sum { turns_taken; _ } -> sum +. turn *. Z.to_float turns_taken) 0.0 strides in
  let flights = List.map (fun { far; _ } -> far) strides in
  let inside x = match extent with Short -> x <= -1.0 | Past -> x >= 1.0 | Contained -> abs_float x <= 1.0 | Anywhere -> true in
  List.for_all (fun (a, b) -> match walk pair (put shape a b) flights with
    | Some (th, v) -> let x, y = coordinates_in into (th -. taken, v) in abs_float y <= 1.0 && inside x
    | None -> false) offsets

(* Decides whether a patch makes phases of arrival of the next flight differ more along than across, as phase and velocity do each by itself. *)
let lands_longer_along (pair, _) { at; long; wide } { far; _ } =
  match arrival pair at far with
  | None -> Chains.size long >= Chains.size wide
  | Some there ->
    let (by_phase, _), (by_velocity, _) = derivative pair false at there in
    let differ (phase, velocity) = abs_float (by_phase *. phase) +. abs_float (by_velocity *. velocity) in
    differ long >= differ wide
(* Decides whether a patch is longer along than across, at its longest image. *)
let is_longer_along (pair, _) { at; long; wide } strides =
  let rec longest x = function
    | [] -> Chains.size x
    | (_, derivative) :: rest -> Float.max (Chains.size x) (longest (Chains.image derivative x) rest) in
  match orbit pair at strides with
  | exception Lost -> Chains.size long >= Chains.size wide
  | states -> longest long states >= longest wide states

(* Cells of a patch: of a shape of a chart, with the flights from there on. It is halved, along or across, where it is not verified, or where what the image's parallelogram
   holds besides images would be too much of the half width across the last one. Halvings at the start of a word, and later; and how many patches are tried. *)
let too_much = 0.05
let halvings, halvings_later = (24, 8)
let most_patches = 3_000
let units x = Z.of_float (Float.round (Float.ldexp x grid))
let cells data ((pair, _) as pairs) into extent =
  let p = Z.of_int strip_bits and q = Z.of_int grid in
  let tried = ref 0 in
  let rec all halvings c shape ({ from; until; below; above } as patch) strides =
    let start = patch_of shape patch in
    incr tried;
    match whole_cell (if patch = whole then c else chart_around start) start strides with
    | found -> found
    | exception ((Lost | Not_landed) as why) ->
      if halvings = 0 || !tried > most_patches then raise Lost;
      let cells patch = all (halvings - 1) c shape patch strides in
      if (if why = Not_landed then lands_longer_along pairs start (List.hd strides) else is_longer_along pairs start strides) then
        let cut = (from +. until) /. 2.0 in
        let before = cells { patch with until = cut } in
        Cut_along (units cut, before, cells { patch with from = cut })
      else
        let cut = (below +. above) /. 2.0 in
        let lower = cells { patch with above = cut } in
        Cut_across (units cut, lower, cells { patch with below = cut })
  and whole_cell c start strides =
    match strides, orbit pair start.at strides with
    | [ stride ], _ ->
      let m = chart into in
      let transit = passing pairs stride.far start m in
      if Striding.Each.check_tread p q data stride c m transit extent then Final (c, transit) else raise Lost
    | stride :: strides, ((image, derivative) :: states as all_states) ->
      let direction = List.nth (contracting (List.map snd all_states) into.wide) 1 in
      let next = around data pairs stride c start image derivative direction in
      let carried = List.fold_left (fun x (_, derivative) -> Chains.image derivative x) next.wide states in
      let _, needed = Chains.coordinates next.long next.wide (Chains.image derivative start.wide) and _, part = Chains.coordinates into.long into.wide carried in
      if (1.0 -. abs_float needed) *. abs_float part > too_much || not (fits pairs next into strides extent) then raise Lost;
      let m = chart next in
      Further (c, passing pairs stride.far start m, m, all halvings_later m next whole strides)
    | _ -> raise Lost in
  all halvings

(* The courses of states from one end of a shape to the other, in its middle. *)
let samples = 1 lsl 13
let at k = 2.0 *. float_of_int k /. float_of_int samples -. 1.0
let courses (pair, _) shape = Array.init (samples + 1) (fun k -> course_of pair (put shape (at k) 0.0))

(* The part of a parallelogram that a word maps across another one: its two bounds, and whether the orientation is reversed. The ends are this far
   beyond those of the other one, and the parts at the ends five times as long: less where the image leaves the other one's edges there. *)
let beyond_ends = [ 0.004; 0.0005; 0.00006 ]
(* Parts of the way from one state to the next where an image between the ends is near flights to other walls. *)
let finer = 32
(* States of a stretch, along and across, whose images are looked at. *)
let looks_along = 64
let looks_across = [ -1.0; 0.0; 1.0 ]

type stretch = { ends : float * float; middle : float * float; is_backwards : bool }
let stretches (pair, _) courses shape into word more =
  let taken = List.fold_left (fun sum { turns_taken; _ } -> sum +. turn *. Z.to_float turns_taken) 0.0 (strides_of word) in
  let seen (th, v) = coordinates_in into (th -. taken, v) in
  let image along across = Option.map seen (walk pair (put shape along across) word.word_flights) in
  let images = Array.map (fun course -> Option.map seen (walked course word.word_flights)) courses in
  let is_between = function Some (x, _) -> abs_float x < 1.0 | None -> false in
  let between k =
    let place j = at k +. (at (k + 1) -. at k) *. float_of_int j /. float_of_int finer in
    match images.(k), images.(k + 1) with
    | (None, x | x, None) when is_between x -> List.init (finer - 1) (fun j -> let place = place (j + 1) in (place, image place 0.0))
    | _ -> [] in
  let points = Array.of_list (List.concat (List.init (samples + 1) (fun k -> (at k, images.(k)) :: (if k < samples then between k else [])))) in
  let last = Array.length points - 1 in
  let at k = fst points.(k) in
  let along x across = match image x across with Some (x, _) -> x | None -> raise Lost in
  (* The least distance of images beyond an end, over the states across. *)
  let beyond sign x = List.fold_left (fun least across -> Float.min least (sign *. along x across)) infinity looks_across in
  (* From point k on, in steps of one or of minus one, the first place at which images are so far beyond. *)
  let rec place step sign bound k =
    if k < 0 || k > last then raise Lost
    else if beyond sign (at k) >= bound then Flights.bisected (fun x -> sign *. (beyond sign x -. bound)) (at k) (at (k - step))
    else place step sign bound (k + step) in
  let end_at step k sign = (place step sign (1.0 +. more) k, place step sign (1.0 +. 6.0 *. more) k) in
  (* Decides whether images of the stretch are between the edges, and those of its ends beyond the ends. *)
  let is_one { ends = (a, b); middle = (from, until); is_backwards } =
    let sign = if is_backwards then -1.0 else 1.0 in
    let place k = a +. (b -. a) *. float_of_int k /. float_of_int looks_along in
    let holds inside x across = match image x across with Some (x, y) -> abs_float y <= 1.0 && inside (sign *. x) | None -> false in
    let all inside x = List.for_all (holds inside x) looks_across in
    from < until && List.for_all (all (fun x -> x <= -1.0)) [ a; from ] && List.for_all (all (fun x -> x >= 1.0)) [ until; b ]
      && List.for_all (fun k -> all (fun _ -> true) (place k)) (List.init looks_along Fun.id) in
  let stretch i j sign = match end_at (-1) i sign, end_at 1 j (-.sign) with
    | (from, start), (until, finish) -> List.filter is_one [ { ends = (start, finish); middle = (from, until); is_backwards = sign > 0.0 } ]
    | exception Lost -> [] in
  let rec look k since found =
    if k > last then List.rev found
    else match snd points.(k) with
      | Some (x, _) when abs_float x < 1.0 -> look (k + 1) since found
      | Some (x, _) ->
        let sign = Float.copy_sign 1.0 x in
        let crossed = match since with Some (i, before) when before <> sign -> stretch i k before | _ -> [] in
        look (k + 1) (Some (k, sign)) (crossed @ found)
      | None -> look (k + 1) None found in
  look 0 None []

let strip_of data pairs shape into word { ends = (start, finish); middle = (from, until); is_backwards } =
  let before, after = if is_backwards then (Past, Short) else (Short, Past) in
  let cells extent from until = cells data pairs into extent (chart shape) shape { whole with from; until } (strides_of word) in
  let opening = cells before start from in
  let closing = cells after until finish in
  { begins_at = units start; ends_at = units finish; backwards = is_backwards; opens_until = units from; closes_from = units until;
    opening; inner = cells Anywhere from until; closing }

(* A strip for each word, apart from those of other words from the same h-set: shorter words first. *)
let found_strips data shapes words =
  let pairs = pairs_of data in
  let starts = Array.map (courses pairs) shapes in
  let numbered = List.mapi (fun i word -> (i, word)) words in
  let shorter (i, v) (j, w) = compare (List.length v.word_flights, i) (List.length w.word_flights, j) in
  let apart taken { ends = (a, b); _ } = List.for_all (fun (c, d) -> b < c || d < a) taken in
  let strip taken (i, word) =
    let from = Words.number word.word_from in
    let shape = shapes.(from) and into = shapes.(Words.number word.word_into) in
    let rec first = function
      | [] -> Error i
      | stretch :: rest when apart taken.(from) stretch ->
        (match strip_of data pairs shape into word stretch with
         | exception Lost -> first rest
         | strip -> taken.(from) <- stretch.ends :: taken.(from); Ok (i, strip))
      | _ :: rest -> first rest in
    let rec within = function
      | [] -> Error i
      | more :: rest -> (match first (stretches pairs starts.(from) shape into word more) with Error _ -> within rest | found -> found) in
    within beyond_ends in
  let taken = Array.make (Array.length shapes) [] in
  List.fold_left (fun found word -> Result.bind found (fun found -> Result.map (fun strip -> strip :: found) (strip taken word))) (Ok []) (List.sort shorter numbered)
  |> Result.map (fun found -> List.map snd (List.sort compare found))
