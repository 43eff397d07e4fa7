(* Periodic orbits: from JSON to the claim of Cycle.v, and back; and documents of `impact-pair periodic`. *)

open Checker
open Reading
module Z = Integers.Z

let schema = "impact-pair/periodic/1"

(* Of all orbits of a document the word and the cycles are one. *)
type claim = { data : data; start : beginning; named : mapping list; periods : Z.t; orbits : cycle list }

(* Keys that claim nothing. *)
let no_claims = [ "program"; "witness" ]

(* From JSON. *)

let read_word place value = match String.split_on_char ' ' (string place value) with
  | [ "" ] -> wrong place value "mappings as in \"P1 P2\""
  | names -> List.map (fun name -> match mapping place (Json.String name) with Some m -> m | None -> wrong place value "mappings as in \"P1 P2\"") names

let read_spot (place, value) =
  let impact = members place value in
  only place [ "wall"; "phase"; "velocity"; "cycle" ] impact;
  let bounds_of key = bounds (inside place key) (get place impact key) in
  { spot_wall = wall (inside place "wall") (get place impact "wall"); spot_phase = bounds_of "phase"; spot_velocity = bounds_of "velocity";
    spot_period = Option.map (signed (inside place "cycle")) (List.assoc_opt "cycle" impact) }

let read_orbit ~word ~cycles place value =
  let orbit = members place value in
  if List.mem_assoc "times" orbit then not_covered "%s is a shorter orbit several times: covered are orbits of their least period" place;
  only place [ "impacts"; "unique"; "physical"; "symmetric"; "trace"; "determinant"; "eigenvalues"; "stability" ] orbit;
  let at key = inside place key and value key = get place orbit key in
  let is_true key = match value key with
    | Json.Bool true -> ()
    | other -> not_covered "%s is %s: covered is true" (at key) (shortened (kind other)) in
  is_true "unique";
  is_true "physical";
  let is_symmetric = match value "symmetric" with
    | Json.Null -> not_covered "%s is null: covered are true and false" (at "symmetric")
    | other -> bool (at "symmetric") other in
  let eigenvalue (place, value) =
    let parts = members place value in
    only place [ "re"; "im" ] parts;
    let part key = bounds (inside place key) (get place parts key) in
    (part "re", part "im") in
  let first_eigenvalue, second_eigenvalue = match items (at "eigenvalues") (value "eigenvalues") with
    | [ first; second ] -> (eigenvalue first, eigenvalue second)
    | _ -> wrong (at "eigenvalues") (value "eigenvalues") "a list of two eigenvalues" in
  let is_stable = match string (at "stability") (value "stability") with
    | "stable" -> true
    | "unstable" -> false
    | other -> not_covered "%s is %S: covered are \"stable\" and \"unstable\"" (at "stability") (shortened other) in
  let spots = List.map read_spot (items (at "impacts") (value "impacts")) in
  { word; cycles; spots; is_symmetric; trace_bounds = bounds (at "trace") (value "trace");
    determinant_bounds = bounds (at "determinant") (value "determinant"); first_eigenvalue; second_eigenvalue; is_stable }

let document value =
  let head = members "the document" value in
  if not (bool "certified" (get "" head "certified")) then not_covered "certified is false: the document leaves something undecided";
  if bool "exhaustive" (get "" head "exhaustive") then not_covered "exhaustive is true: that there are no other orbits is not covered by the theorem; without `periodic --all` a document does not claim it";
  let named = read_word "word" (get "" head "word") and periods = integer "cycles" (get "" head "cycles") in
  let orbits = List.map (fun (place, value) -> read_orbit ~word:named ~cycles:periods place value) (items "orbits" (get "" head "orbits")) in
  if orbits = [] then not_covered "orbits is empty: covered is one orbit or more";
  let data, start = read_scene (get "" head "scene") in
  only "" ([ "schema"; "certified"; "exhaustive"; "scene"; "word"; "cycles"; "orbits" ] @ no_claims) head;
  one_harmonic "periodic orbits" data;
  { data; start; named; periods; orbits }

(* To JSON. *)

let word_text word = String.concat " " (List.map mapping_name word)
let json_of_spot { spot_wall; spot_phase = (a, b); spot_velocity = (c, d); spot_period } =
  Json.Object ([ ("wall", Json.String (wall_name spot_wall)); ("phase", pair a b); ("velocity", pair c d) ]
    @ List.map (fun n -> ("cycle", Json.Number (Z.to_string n))) (Option.to_list spot_period))
let json_of_orbit { spots; is_symmetric; trace_bounds; determinant_bounds; first_eigenvalue; second_eigenvalue; is_stable; _ } =
  let both (a, b) = pair a b in
  let eigenvalue (re, im) = Json.Object [ ("re", both re); ("im", both im) ] in
  Json.Object [
    ("impacts", List (List.map json_of_spot spots)); ("unique", Bool true); ("physical", Bool true); ("symmetric", Bool is_symmetric);
    ("trace", both trace_bounds); ("determinant", both determinant_bounds);
    ("eigenvalues", List [ eigenvalue first_eigenvalue; eigenvalue second_eigenvalue ]);
    ("stability", String (if is_stable then "stable" else "unstable")) ]

let json { data; start; named; periods; orbits } =
  Json.Object [
    ("schema", String schema); ("certified", Bool true); ("exhaustive", Bool false); ("scene", json_of_scene data start);
    ("word", String (word_text named)); ("cycles", Number (Z.to_string periods)); ("orbits", List (List.map json_of_orbit orbits)) ]

(* The claims of a document. *)
let read value = claimed ~no_claims ~document ~json value

(* The claim in one line, in the words of the theorem. *)
let of_orbit = "impacts, each the first contact after the one before, within the listed bounds of phase, modulo 2 pi, and velocity, and in the listed forcing periods, counted from that of the first impact, on the listed walls, in the order \
  of the word, for ever; no impact but the first is the first one again, whole forcing periods later; no other such orbit has its first impact in these bounds; it is its own mirror image, half a forcing period or an odd number of them later, as \
  `symmetric` says; trace, determinant and eigenvalues of the product of the matrices (A.7) at its impacts are within the listed bounds, and both eigenvalues \
  inside the unit circle if it is stable, one outside if it is unstable"
let claim { periods; orbits; named; _ } =
  Printf.sprintf "for all parameters that the scene allows there are at least %d different periodic orbits, each of %d impacts in %s forcing period%s: %s"
    (List.length orbits) (List.length named) (Z.to_string periods) (plural periods) of_orbit
