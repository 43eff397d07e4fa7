(* A document and its hint as terms of Coq: a file in which Coq's own evaluator runs the same `verify` on the same input. *)

open Checker
module Z = Integers.Z

let integer n = let digits = Z.format "%#x" n in if Z.sign n < 0 then "(" ^ digits ^ ")" else digits
let fraction { qnum; qden } = Printf.sprintf "(Qmake %s %s)" (integer qnum) (integer qden)
let list term items = "[" ^ String.concat "; " (List.map term items) ^ "]"
let option term = function None -> "None" | Some x -> "(Some " ^ term x ^ ")"

let rec number = function
  | Rational q -> Printf.sprintf "(Rational %s)" (fraction q)
  | Pi -> "Pi"
  | Plus (a, b) -> Printf.sprintf "(Plus %s %s)" (number a) (number b)
  | Minus (a, b) -> Printf.sprintf "(Minus %s %s)" (number a) (number b)
  | Times (a, b) -> Printf.sprintf "(Times %s %s)" (number a) (number b)
  | Over (a, b) -> Printf.sprintf "(Over %s %s)" (number a) (number b)
  | Root a -> Printf.sprintf "(Root %s)" (number a)
  | Sine a -> Printf.sprintf "(Sine %s)" (number a)
  | Cosine a -> Printf.sprintf "(Cosine %s)" (number a)

let range { least; most } = Printf.sprintf "(Between %s %s)" (number least) (number most)
let tone { amplitude; frequency; shift } = Printf.sprintf "(Build_tone %s %s %s)" (range amplitude) (range frequency) (range shift)
let data { leading; further; gap; restitution } =
  Printf.sprintf "(Build_data %s %s %s %s)" (tone leading) (list tone further) (range gap) (range restitution)
let wall = Reading.wall_name
let beginning = function
  | Struck (w, t, v) -> Printf.sprintf "(Struck %s %s %s)" (wall w) (range t) (range v)
  | Inside (t, y, v) -> Printf.sprintf "(Inside %s %s %s)" (range t) (range y) (range v)
let bounds { on; time_lower; time_upper; velocity_lower; velocity_upper } =
  Printf.sprintf "(Impact %s %s)" (wall on) (String.concat " " (List.map fraction [ time_lower; time_upper; velocity_lower; velocity_upper ]))
let event { index; mapped; shown } = Printf.sprintf "(Event %s %s %s)" (integer index) (option Reading.mapping_name mapped) (bounds shown)
let occurrence = function
  | Impact_at x -> Printf.sprintf "(Impact_at %s)" (event x)
  | Rest_at (w, lower, upper, bounces) -> Printf.sprintf "(Rest_at %s %s %s %b)" (wall w) (fraction lower) (fraction upper) bounces
  | Release_at (w, lower, upper) -> Printf.sprintf "(Release_at %s %s %s)" (wall w) (fraction lower) (fraction upper)
let outcome = function
  | Impacts_reached n -> Printf.sprintf "(Impacts_reached %s)" (integer n)
  | Time_reached (n, until) -> Printf.sprintf "(Time_reached %s %s)" (integer n) (number until)
  | Repeats (n, until, cycles, each) -> Printf.sprintf "(Repeats %s %s %s %s)" (integer n) (option number until) (integer cycles) (integer each)

let integers items = String.concat " " (List.map integer items)
let leg { bits; coarse; scale0; hits; t; rt; v; rv; depart; approach; tilt } =
  Printf.sprintf "(Leg %s %s %s)" (integers [ bits; coarse; scale0 ]) (wall hits) (integers [ t; rt; v; rv; depart; approach; tilt ])
let start { start_bits; start_scale; start_t; start_rt; start_v; start_rv } =
  Printf.sprintf "(Start %s)" (integers [ start_bits; start_scale; start_t; start_rt; start_v; start_rv ])

let resting { rest_bits; rest_scale; ends; low; high; ratio } =
  Printf.sprintf "(At_rest %s)" (integers [ rest_bits; rest_scale; ends; low; high; ratio ])
let releasing { release_bits; release_scale; held_from; ceases; ceases_by; falls_by } =
  Printf.sprintf "(At_release %s)" (integers [ release_bits; release_scale; held_from; ceases; ceases_by; falls_by ])
let step = function
  | Flight l -> Printf.sprintf "(Flight %s)" (leg l)
  | Rest r -> Printf.sprintf "(Rest %s)" (resting r)
  | Release r -> Printf.sprintf "(Release %s)" (releasing r)
let rec natural = function O -> "O" | S n -> Printf.sprintf "(S %s)" (natural n)
let hint { origin; steps; next_one; rounds = (before, round) } =
  Printf.sprintf "(Hint %s %s %s (%s, %s))" (start origin) (list step steps) (option occurrence next_one) (natural before) (natural round)
let datum = function
  | Amplitude n -> "(Pieces.Amplitude " ^ natural n ^ ")"
  | Frequency n -> "(Pieces.Frequency " ^ natural n ^ ")"
  | Phase n -> "(Pieces.Phase " ^ natural n ^ ")"
  | Gap -> "Pieces.Gap"
  | Restitution -> "Pieces.Restitution"
  | Start_time -> "Pieces.Start_time"
  | Start_place -> "Pieces.Start_place"
  | Start_velocity -> "Pieces.Start_velocity"
let rec pieces = function
  | Whole h -> Printf.sprintf "(Pieces.Whole %s)" (hint h)
  | Cut (d, q, lower, upper) -> Printf.sprintf "(Pieces.Cut %s %s %s %s)" (datum d) (fraction q) (pieces lower) (pieces upper)

let pair (a, b) = Printf.sprintf "(%s, %s)" (fraction a) (fraction b)
let nearness { start_times; start_velocities; half_within; all_within } =
  Printf.sprintf "(Nearness %s %s %s %s)" (pair start_times) (pair start_velocities) (fraction half_within) (fraction all_within)
let chart { cu; cv; lu; lv; wu; wv } = Printf.sprintf "(Chart %s)" (integers [ cu; cv; lu; lv; wu; wv ])
let link { stretch_from; stretch_to; wide_at; wide_by; near_at; near_by; leave; arrive; tilt_along; tilt_across; turned_over } =
  Printf.sprintf "(Link %s %b)"
    (integers [ stretch_from; stretch_to; wide_at; wide_by; near_at; near_by; leave; arrive; tilt_along; tilt_across ]) turned_over
let chain { chain_bits; chain_scale; first_chart; links; afterwards } =
  let step (l, into) = Printf.sprintf "(%s, %s)" (link l) (chart into) in
  Printf.sprintf "(Chain %s %s %s %s)" (integers [ chain_bits; chain_scale ]) (chart first_chart) (list step links) (option bounds afterwards)

let document (kind, listed) { scene_data; begun; events; ended } =
  Printf.sprintf "(Document %s %s %s %s : document_of %s)" (data scene_data) (beginning begun) (list listed events) (outcome ended) kind

(* Periodic orbits, and ellipses around them. *)
let spot { spot_wall; spot_phase; spot_velocity; spot_period } =
  Printf.sprintf "(Spot %s %s %s %s)" (wall spot_wall) (pair spot_phase) (pair spot_velocity) (option integer spot_period)
let cycle { word; cycles; spots; is_symmetric; trace_bounds; determinant_bounds; first_eigenvalue = (a, b); second_eigenvalue = (c, d); is_stable } =
  Printf.sprintf "(Cycle.Cycle %s %s %s %b %s %s (%s, %s) (%s, %s) %b)" (list Reading.mapping_name word) (integer cycles) (list spot spots) is_symmetric
    (pair trace_bounds) (pair determinant_bounds) (pair a) (pair b) (pair c) (pair d) is_stable
let cell { at_t; by_t; at_v; by_v } = Printf.sprintf "(Rounds.Cell %s)" (integers [ at_t; by_t; at_v; by_v ])
let passage { onto; arrives_at; arrives_by; departed; approached; centre_tilt; centre_image; image_of_all } =
  Printf.sprintf "(Rounds.Passage %s %s %s %s)" (wall onto) (integers [ arrives_at; arrives_by; departed; approached; centre_tilt ]) (cell centre_image) (cell image_of_all)
let disc { disc_bits; disc_scale; disc_chart; factor; newton = { m11; m12; m21; m22 }; way } =
  Printf.sprintf "(Discs.Disc %s %s %s (Jacobian.Matrix %s) %s)" (integers [ disc_bits; disc_scale ]) (chart disc_chart) (integer factor)
    (integers [ m11; m12; m21; m22 ]) (list passage way)
let mirroring = function
  | Mirror_of (n, k) -> Printf.sprintf "(Cycles.Mirror_of %s %s)" (natural n) (integer k)
  | No_mirror turns -> Printf.sprintf "(Cycles.No_mirror %s)" (list integer turns)
let surroundings { wide_disc; narrow_disc; spot_turns; first_turns; mirroring_of } =
  Printf.sprintf "(Cycles.Surroundings %s %s %s %s %s)" (disc wide_disc) (disc narrow_disc) (list integer spot_turns) (integer first_turns) (mirroring mirroring_of)
let approach { listed_before; listed_until; rounds_until; last_listed; flights_on; turns_until } =
  Printf.sprintf "(Drawn.Approach %s %s %s %s)" (String.concat " " (List.map natural [ listed_before; listed_until; rounds_until ])) (cell last_listed)
    (list passage flights_on) (integer turns_until)

(* Regions. *)
let run (column, (first, last)) = Printf.sprintf "(%s, (%s, %s))" (integer column) (integer first) (integer last)
let region { columns; rows; runs } = Printf.sprintf "(Region.Region %s %s)" (integers [ columns; rows ]) (list run runs)
let properties { box_count; flight_periods; longest_flight; flight_times; impact_speeds; impact_velocities; entered } =
  Printf.sprintf "(Region.Properties %s %s %s %s %s %s %s)" (integer box_count) (pair flight_periods) (fraction longest_flight) (pair flight_times)
    (pair impact_speeds) (pair impact_velocities) (option integer entered)
let plan { plan_bits; fine; shortest; longest; parts; halvings } =
  Printf.sprintf "(Columns.Plan %s %s)" (integers [ plan_bits; fine; shortest; longest; parts ]) (natural halvings)
let entry { from_column; until_column; impacts_before } =
  Printf.sprintf "(Trap.Entry %s %s)" (integers [ from_column; until_column ]) (list event impacts_before)

(* Horseshoes. *)
let h_set { left_bottom; left_top; right_bottom; right_top; set_middle; set_expanding; set_contracting } =
  Printf.sprintf "(Chaos.H_set %s)" (String.concat " " (List.map pair [ left_bottom; left_top; right_bottom; right_top; set_middle; set_expanding; set_contracting ]))
let word { word_from; word_into; word_flights; half_cycles } =
  Printf.sprintf "(Chaos.Word %s %s %s %s)" (natural word_from) (natural word_into) (list string_of_bool word_flights) (integer half_cycles)
let chaos { h_sets; words; per_impact; per_cycle; blocks } =
  let both (a, b) = Printf.sprintf "(%s, %s)" (natural a) (natural b) in
  Printf.sprintf "(Chaos.Chaos %s %s %s %s %s)" (list h_set h_sets) (list word words) (fraction per_impact) (fraction per_cycle) (option both blocks)
let transit { wide_mid; wide_rad; near_mid; near_rad; go; come; lean_along; lean_across } =
  Printf.sprintf "(Covering.Transit %s)" (integers [ wide_mid; wide_rad; near_mid; near_rad; go; come; lean_along; lean_across ])
let rec cells = function
  | Final (c, passes) -> Printf.sprintf "(Strips.Final %s %s)" (chart c) (transit passes)
  | Further (c, passes, image, rest) -> Printf.sprintf "(Strips.Further %s %s %s %s)" (chart c) (transit passes) (chart image) (cells rest)
  | Cut_along (cut, before, after) -> Printf.sprintf "(Strips.Cut_along %s %s %s)" (integer cut) (cells before) (cells after)
  | Cut_across (cut, below, above) -> Printf.sprintf "(Strips.Cut_across %s %s %s)" (integer cut) (cells below) (cells above)
let strip { begins_at; ends_at; backwards; opens_until; closes_from; opening; inner; closing } =
  Printf.sprintf "(Strips.Strip %s %b %s %s)" (integers [ begins_at; ends_at ]) backwards (integers [ opens_until; closes_from ])
    (String.concat " " (List.map cells [ opening; inner; closing ]))
let entry_of_word { from_set; into_set; strides; strip_of } =
  let stride { far; turns_taken } = Printf.sprintf "(Reduced.Stride %b %s)" far (integer turns_taken) in
  Printf.sprintf "(Words.Word %s %s %s %s)" (natural from_set) (natural into_set) (list stride strides) (strip strip_of)
let growth { growth_by; growth_values } = Printf.sprintf "(Entropies.Growth_hint %s %s)" (fraction growth_by) (list integer growth_values)
let chaos_hint { found_words = { word_bits; grid_bits; sets; entries }; by_impacts; by_half_cycles } =
  Printf.sprintf "(Carrier.Chaos_hint (Words.Words %s %s %s) %s %s)" (integers [ word_bits; grid_bits ]) (list chart sets) (list entry_of_word entries)
    (growth by_impacts) (growth by_half_cycles)

(* A file of definitions, of Coq's evaluator on them, which must answer as the extracted program does, and where it accepts of the theorem: the claims of
   the document, with the axioms that they rest on. *)
let axioms = "(* Expected are the axioms of Coq's real numbers, and no other: ClassicalDedekindReals.sig_not_dec, ClassicalDedekindReals.sig_forall_dec,\n   \
  FunctionalExtensionality.functional_extensionality_dep, Classical_Prop.classic. *)\n"
let answered definitions (checker, claims, by) answer =
  let names = List.map fst definitions in
  let given = List.map (fun (name, term) -> Printf.sprintf "Definition %s := %s.\n" name term) definitions in
  let theorem = if not answer then "" else
    Printf.sprintf "\nTheorem document_claims : %s.\nProof. exact (Carrier.%s %s answer). Qed.\n%sPrint Assumptions document_claims.\n"
      claims by (String.concat " " (List.map (fun _ -> "_") names)) axioms in
  Printf.sprintf "(* Compile it with: coqc -q -R target/coq ImpactPair FILE, after validation/coq/library has compiled target/coq. *)\n\
    From Coq Require Import ZArith QArith List.\nFrom ImpactPair Require Import Model Data Certificate Covering Document Orbit Resting Rests Shadow Cycle.\n\
    From ImpactPair Require Pieces Jacobian Rounds Discs Cycles Drawn Region Columns March Trap Chaos Reduced Strips Words Entropies Carrier.\nImport ListNotations.\nOpen Scope Z_scope.\n\
    %sLemma answer : Carrier.%s %s = %b.\nProof. vm_cast_no_check (eq_refl %b). Qed.\n%s"
    (String.concat "" given) checker (String.concat " " names) answer answer theorem

let file x found =
  answered [ ("document", document ("occurrence", occurrence) x); ("pieces", pieces found) ]
    ("Shifting.verify_document", "Orbit.claims document", "Shifting.pieces_verified")
let file_of_shadow x near found =
  answered [ ("document", document ("event", event) x); ("near", nearness near); ("chain", chain found) ]
    ("Shadowing.verify_shadow", "Shadow.claims_shadow document near", "Shadowing.shadow_verified")
let file_of_cycles param start orbits around =
  answered [ ("param", data param); ("start", beginning start); ("orbits", list cycle orbits); ("around", list surroundings around) ]
    ("Drawing.verify_cycles", "Cycle.claims_cycles param start orbits", "Drawing.cycles_verified")
let file_of_attracted x found from c around way =
  answered [ ("document", document ("occurrence", occurrence) x); ("pieces", pieces found); ("from", integer from); ("orbit", cycle c); ("around", surroundings around);
             ("approach", approach way) ]
    ("verify_attracted", "Cycle.claims_attracted document from orbit", "attracted_verified")
let file_of_region param start r f h x found =
  answered [ ("param", data param); ("start", beginning start); ("region", region r); ("said", properties f); ("plan", plan h); ("entry", entry x); ("pieces", pieces found) ]
    ("verify_region", "Region.claims_region param start region said", "region_verified")
let file_of_chaos param start c h =
  answered [ ("param", data param); ("start", beginning start); ("horseshoe", chaos c); ("hint", chaos_hint h) ]
    ("verify_chaos", "Chaos.claims_chaos param start horseshoe", "chaos_verified")
