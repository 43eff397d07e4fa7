(* Trapping regions: from JSON to the claim of Region.v, and back; and documents of `impact-pair trap`. *)

open Checker
open Reading
module Z = Integers.Z

let schema = "impact-pair/trap/1"

type claim = { data : data; start : beginning; region : region; properties : properties }

(* Keys that claim nothing. *)
let no_claims = [ "program" ]

(* From JSON. *)

let read_run (place, value) = match items place value with
  | [ (p, column); (q, first); (r, last) ] -> (integer p column, (integer q first, integer r last))
  | _ -> wrong place value "a column, a first row and a last one"
let positive place value =
  let n = integer place value in
  if Z.sign n = 0 then wrong place value "an integer from 1 on" else n

let document value =
  let head = members "the document" value in
  let at read key = read key (get "" head key) in
  let is_true key = if not (at bool key) then not_covered "%s is false: covered is true" key in
  is_true "certified";
  is_true "no_rest";
  if at items "region" = [] then not_covered "region is empty: covered is one box or more";
  if List.mem_assoc "words" head then not_covered "words: how many words of walls there are is not covered by the theorem";
  let data, start = read_scene (get "" head "scene") in
  one_harmonic "regions" data;
  only "" ([ "schema"; "certified"; "scene"; "boxes"; "entered_at_impact"; "no_rest"; "longest_flight"; "speed"; "columns"; "rows"; "flight"; "flight_time"; "speed_before"; "region" ]
    @ no_claims) head;
  let entered = match get "" head "entered_at_impact" with Json.Null -> None | value -> Some (integer "entered_at_impact" value) in
  let number place value = Expression.bound place (string place value) in
  { data; start;
    region = { columns = at positive "columns"; rows = at positive "rows"; runs = List.map read_run (at items "region") };
    properties = { box_count = at integer "boxes"; flight_periods = at bounds "flight"; longest_flight = at number "longest_flight"; flight_times = at bounds "flight_time";
      impact_speeds = at bounds "speed"; impact_velocities = at bounds "speed_before"; entered } }

(* To JSON. *)

let json { data; start; region = { columns; rows; runs }; properties = f } =
  let number n = Json.Number (Z.to_string n) and both (a, b) = pair a b in
  Json.Object [
    ("schema", String schema); ("certified", Bool true); ("scene", json_of_scene data start); ("boxes", number f.box_count);
    ("entered_at_impact", match f.entered with None -> Null | Some n -> number n); ("no_rest", Bool true);
    ("longest_flight", String (Expression.spell f.longest_flight)); ("speed", both f.impact_speeds); ("columns", number columns); ("rows", number rows);
    ("flight", both f.flight_periods); ("flight_time", both f.flight_times); ("speed_before", both f.impact_velocities);
    ("region", List (List.map (fun (column, (first, last)) -> Json.List [ number column; number first; number last ]) runs)) ]

(* The claims of a document. *)
let read value = claimed ~no_claims ~document ~json value

(* The claim in one line, in the words of the theorem. *)
let claim { region = { columns; rows; _ }; properties = f; _ } =
  let text = Z.to_string and spell = Expression.spell in
  let bounds (lower, upper) unit = Printf.sprintf "%s to %s%s" (spell lower) (spell upper) unit in
  let comes_in = match f.entered with
    | None -> ""
    | Some n when Z.sign n = 0 -> "; and every start that the scene allows is in it"
    | Some n -> Printf.sprintf "; and from every start that the scene allows impact %s is in it, each impact up to it the first contact after the one before" (text n) in
  Printf.sprintf "for all parameters that the scene allows, after an impact in the region of %s boxes, of which %s make a forcing period and %s a speed of A W, impacts \
    of the right wall taken as their mirror images, there are infinitely many impacts, each the first contact after the one before; all of them are in the region, whether at \
    a graze the ball hits the wall without velocity or passes it; neither a rest nor infinitely many impacts before some time ever happen; the flights from impact to impact last %s or %s, \
    not more than %s forcing periods; speeds before impacts are %s or %s%s"
    (text f.box_count) (text columns) (text rows) (bounds f.flight_periods " forcing periods") (bounds f.flight_times " in time") (spell f.longest_flight)
    (bounds f.impact_speeds " A W") (bounds f.impact_velocities " in length per time") comes_in
