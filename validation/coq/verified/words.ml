(* Horseshoes: from JSON to the claim of Chaos.v, and back; and documents of `impact-pair chaos`. *)

open Checker
open Reading
module Z = Integers.Z

let schema = "impact-pair/chaos/1"

type claim = { data : data; start : beginning; chaos : chaos }

(* Keys that claim nothing of the pair: how words were searched for, and an exponent that is seen. *)
let no_claims = [ "program"; "depth"; "boxes"; "exponent_seen"; "witness" ]
let read_no_claims head words =
  let depth = integer "depth" (get "" head "depth") in
  if List.exists (fun { word_flights; _ } -> Z.lt depth (Z.of_int (List.length word_flights))) words then
    wrong "depth" (get "" head "depth") "a number of impacts that no word exceeds";
  ignore (integer "boxes" (get "" head "boxes"));
  let curve place strip key =
    let place = inside place key in
    List.iter (fun (place, part) -> ignore (Expression.bound place (string place part))) (items place (get "" strip key)) in
  let curves place sides = List.iter (curve place sides) [ "left"; "right" ] in
  let moved (place, value) =
    let sides = members place value in
    only place [ "by"; "left"; "right" ] sides;
    List.iter (fun (place, power) -> ignore (integer place power)) (items (inside place "by") (get place sides "by"));
    curves place sides in
  let strip (place, value) =
    let sides = members place value in
    only place [ "left"; "right"; "moved" ] sides;
    Option.iter (fun all -> List.iter moved (items (inside place "moved") all)) (List.assoc_opt "moved" sides);
    curves place sides in
  let cone_word (place, value) =
    let word = members place value in
    only place [ "left"; "right"; "rises"; "counts" ] word;
    curves place word in
  let cones value =
    let place = "witness.cones" in
    let cones = members place value in
    only place [ "words"; "letters"; "unstable" ] cones;
    let each key read = List.iter read (items (inside place key) (get place cones key)) in
    each "words" cone_word;
    each "letters" (fun (place, letters) -> ignore (integer place letters));
    curve place cones "unstable" in
  (match List.assoc_opt "witness" head with
  | None | Some Json.Null -> ()
  | Some value ->
    let witness = members "witness" value in
    only "witness" [ "strips"; "cones" ] witness;
    List.iter strip (items "witness.strips" (get "witness" witness "strips"));
    Option.iter cones (List.assoc_opt "cones" witness));
  match get "" head "exponent_seen" with
  | Json.Null | Number _ -> ()
  | value -> wrong "exponent_seen" value "a number or null"

(* Naturals of the checker. *)
let nat = Rests.nat
let rec number = function O -> 0 | S n -> 1 + number n

(* From JSON. *)

let decimal place = function Json.Number n -> Expression.bound place n | value -> wrong place value "a number"
let two read place value = match items place value with
  | [ (p, a); (q, b) ] -> (read p a, read q b)
  | _ -> wrong place value "a list of two numbers"
let written place value = Expression.bound place (string place value)

let read_set (place, value) =
  let h_set = members place value in
  only place [ "phase"; "speed"; "expanding"; "contracting"; "corners" ] h_set;
  let at key read = read (inside place key) (get place h_set key) in
  let corners = at "corners" members in
  let place = inside place "corners" in
  only place [ "left"; "right" ] corners;
  let side key = two (two decimal) (inside place key) (get place corners key) in
  let (left_bottom, left_top), (right_bottom, right_top) = (side "left", side "right") in
  { left_bottom; left_top; right_bottom; right_top; set_middle = (at "phase" written, at "speed" written);
    set_expanding = at "expanding" (two written); set_contracting = at "contracting" (two written) }

let read_word sets (place, value) =
  let word = members place value in
  only place [ "from"; "to"; "impacts"; "half_cycles"; "flights" ] word;
  let at key read = read (inside place key) (get place word key) in
  let set place value =
    let n = integer place value in
    if Z.lt n (Z.of_int sets) then nat (Z.to_int n) else wrong place value "the number of an h-set" in
  let flights place value = match string place value with
    | "" -> wrong place value "F and N, one a flight"
    | names -> List.map (function 'F' -> true | 'N' -> false | _ -> wrong place value "F and N, one a flight") (List.of_seq (String.to_seq names)) in
  let word_flights = at "flights" flights in
  if not (Z.equal (at "impacts" integer) (Z.of_int (List.length word_flights))) then
    unreadable "%s.impacts: as many as flights are accepted" place;
  { word_from = at "from" set; word_into = at "to" set; word_flights; half_cycles = at "half_cycles" integer }

(* The mappings of a word that begins on the left wall, the first one right-most, and its half cycles. *)
let block { word_flights; half_cycles; _ } =
  let _, names = List.fold_left (fun (from, names) is_far ->
    let into = if not is_far then from else if from = Left then Right else Left in
    let mapping = match from, into with Right, Left -> P1 | Left, Right -> P2 | Right, Right -> P3 | Left, Left -> P4 in
    (into, mapping_name mapping :: names)) (Left, []) word_flights in
  Printf.sprintf "%s (%s half cycle%s)" (String.concat " " names) (Z.to_string half_cycles) (plural half_cycles)
let horseshoe a b =
  Printf.sprintf "each block is %s or %s, in any order in the map mirrored to one wall: each is written as it starts on the left wall, and mirrored where it starts on the right one"
    (block a) (block b)

(* The words that a sentence on a horseshoe names. *)
let read_blocks words = function
  | Json.Null -> not_covered "horseshoe: covered is a sentence on two blocks"
  | value ->
    let said = string "horseshoe" value in
    let numbered = List.mapi (fun i word -> (i, word)) words in
    let named = List.concat_map (fun (i, a) -> List.filter_map (fun (j, b) -> if horseshoe a b = said then Some (nat i, nat j) else None) numbered) numbered in
    match named with
    | first :: _ -> Some first
    | [] -> wrong "horseshoe" value "a sentence on two blocks, each of which is one of the words"

(* Keys that the program leaves out where there is nothing to say. *)
let nothing_said = function
  | Json.Null | Bool false | List [] -> true
  | Object members -> List.for_all (fun (_, value) -> value = Json.Null) members
  | _ -> false
let optional = [ "scene_orbit"; "interrupted"; "hyperbolic"; "left_out" ]

let document value =
  let head = members "the document" value in
  if not (bool "certified" (get "" head "certified")) then not_covered "certified is false: covered is true";
  List.iter (fun key -> match List.assoc_opt key head with
    | Some value when not (nothing_said value) -> not_covered "%s is not covered by the theorem%s" key
        (if key = "scene_orbit" then ": `impact-pair chaos --no-orbit` leaves it out" else "")
    | _ -> ()) optional;
  let data, start = read_scene (get "" head "scene") in
  one_harmonic "horseshoes" data;
  only "" ([ "schema"; "certified"; "scene"; "entropy"; "horseshoe"; "bases"; "words" ] @ optional @ no_claims) head;
  let entropy = members "entropy" (get "" head "entropy") in
  only "entropy" [ "per_impact"; "per_cycle" ] entropy;
  let rate key = written (inside "entropy" key) (get "entropy" entropy key) in
  List.iter (fun key -> if Z.sign (rate key).qnum < 0 then unreadable "entropy.%s: accepted is a decimal that is not negative" key) [ "per_impact"; "per_cycle" ];
  if Z.sign (rate "per_impact").qnum <= 0 && Z.sign (rate "per_cycle").qnum <= 0 then not_covered "entropy: covered is a positive lower bound, which `certified` says that there is";
  let h_sets = List.map read_set (items "bases" (get "" head "bases")) in
  let words = List.map (read_word (List.length h_sets)) (items "words" (get "" head "words")) in
  read_no_claims head words;
  { data; start; chaos = { h_sets; words; per_impact = rate "per_impact"; per_cycle = rate "per_cycle"; blocks = read_blocks words (get "" head "horseshoe") } }

(* To JSON. *)

let spell q = Json.String (Expression.spell q)
let json_of_set { left_bottom; left_top; right_bottom; right_top; set_middle = (phase, speed); set_expanding = (a, b); set_contracting = (c, d) } =
  let corner (u, w) = Json.List [ Number (Expression.spell u); Number (Expression.spell w) ] in
  Json.Object [
    ("phase", spell phase); ("speed", spell speed); ("expanding", pair a b); ("contracting", pair c d);
    ("corners", Object [ ("left", List [ corner left_bottom; corner left_top ]); ("right", List [ corner right_bottom; corner right_top ]) ]) ]
let json_of_word { word_from; word_into; word_flights; half_cycles } =
  let count n = Json.Number (string_of_int n) in
  Json.Object [
    ("from", count (number word_from)); ("to", count (number word_into)); ("impacts", count (List.length word_flights));
    ("half_cycles", Number (Z.to_string half_cycles)); ("flights", String (String.concat "" (List.map (fun far -> if far then "F" else "N") word_flights))) ]
let json { data; start; chaos = { h_sets; words; per_impact; per_cycle; blocks } } =
  let sentence (a, b) = Json.String (horseshoe (List.nth words (number a)) (List.nth words (number b))) in
  Json.Object [
    ("schema", String schema); ("certified", Bool true); ("scene", json_of_scene data start);
    ("entropy", Object [ ("per_impact", spell per_impact); ("per_cycle", spell per_cycle) ]);
    ("horseshoe", Option.fold ~none:Json.Null ~some:sentence blocks);
    ("bases", List (List.map json_of_set h_sets)); ("words", List (List.map json_of_word words)) ]

(* The claims of a document; numbers of corners in one spelling. *)
let rec with_corners key = function
  | Json.Number n when key = "corners" -> Json.Number (Expression.canonical n)
  | List items -> List (List.map (with_corners key) items)
  | Object members -> Object (List.map (fun (name, value) -> (name, with_corners (if key = "corners" then key else name) value)) members)
  | value -> value
let read value = claimed ~canonical:(fun _ head -> with_corners "" (spelled "" head)) ~no_claims:(no_claims @ optional) ~document ~json value

(* The claim in one line, in the words of the theorem. *)
let claim { chaos = { h_sets; words; per_impact; per_cycle; blocks }; _ } =
  let spell = Expression.spell in
  let order = match blocks with
    | None -> ""
    | Some (a, b) -> Printf.sprintf "; no two other blocks with fewer impacts are free in the same way; %s" (horseshoe (List.nth words (number a)) (List.nth words (number b))) in
  Printf.sprintf "for all parameters that the scene allows and for every sequence of the %d words that fit together, one-sided or two-sided, there is a motion from either wall that follows it: each impact is the \
    first contact after the one before, on the wall that the word says, and each word begins and ends in its h-sets, of which there are %d, and takes its half cycles and the difference of phases; no \
    state is in two of them, or in one with two phases; a periodic sequence has a motion whose impacts are there again after its half cycles, as mirror images if their number is odd; the topological entropy, by motions that are \
    apart within n impacts or n forcing periods, is at least %s per impact and %s per forcing period%s"
    (List.length words) (List.length h_sets) (spell per_impact) (spell per_cycle) order
