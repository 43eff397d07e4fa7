(* An orbit document: from JSON to the claim of Document.v, and back. What is read is written again and compared, byte for
   byte, with the canonical form of the document, so that nothing else is verified than what it says. *)

open Checker
open Reading
module Z = Integers.Z

let schema = "impact-pair/orbit/1"
let exact_start = "exact start"
let shadowed = "shadowed"
let periodic = "periodic"
let attracted = "attracted"

(* The claim of a document: of the orbit from the scene's start, or of one that starts near; of the first that from an impact on it tends to a
   periodic orbit. *)
type claim = Exact of document | Attracted of document * Z.t * cycle | Shadowed of event document_of * nearness
let scene_of = function
  | Exact { scene_data; begun; _ } | Attracted ({ scene_data; begun; _ }, _, _) -> (scene_data, begun)
  | Shadowed ({ scene_data; begun; _ }, _) -> (scene_data, begun)
let outcome_of = function Exact { ended; _ } | Attracted ({ ended; _ }, _, _) -> ended | Shadowed ({ ended; _ }, _) -> ended
let occurrences = function
  | Exact { events; _ } | Attracted ({ events; _ }, _, _) -> events
  | Shadowed ({ events; _ }, _) -> List.map (fun event -> Impact_at event) events

(* Keys that claim nothing. *)
let no_claims = [ "program"; "arithmetic" ]

(* Forcing periods are those of the fastest harmonic, and the theorems on shadowed orbits and on periods are about documents of which it is the first: so it is put
   there, in all lists alike, before anything is read. A sum has no order; that no other one is faster is proved. *)
let rec change path by value = match path, value with
  | [], _ -> by value
  | key :: path, Json.Object members -> Json.Object (List.map (fun (k, v) -> (k, if k = key then change path by v else v)) members)
  | _ -> value
let with_fastest_first value =
  let at key = function Json.Object members -> List.assoc_opt key members | _ -> None in
  let frequencies = List.fold_left (fun value key -> Option.bind value (at key)) (Some value) [ "scene"; "excitation"; "frequency" ] in
  let has_periods = at "claim" value = Some (Json.String shadowed)
    || Option.bind (at "outcome" value) (at "kind") = Some (Json.String periodic) in
  match frequencies with
  | Some (Json.List (_ :: _ :: _ as frequencies)) when has_periods ->
    let sizes = List.map (fun frequency -> Fixed.middle 256 (range "scene.excitation.frequency" frequency)) frequencies in
    let is_slower x y = Z.sign (Z.sub y x) > 0 in
    let later best (i, x) = if is_slower (snd best) x then (i, x) else best in
    let number = fst (List.fold_left later (0, List.hd sizes) (List.mapi (fun i x -> (i, x)) sizes)) in
    let fronted = function
      | Json.List items when List.length items > number -> Json.List (List.nth items number :: List.filteri (fun i _ -> i <> number) items)
      | value -> value in
    let all_lists = function Json.Object members -> Json.Object (List.map (fun (k, v) -> (k, fronted v)) members) | value -> value in
    change [ "scene"; "excitation" ] all_lists value
  | _ -> value

(* From JSON. *)

let read_event (place, value) =
  let event = members place value in
  let value read key = read (inside place key) (get place event key) in
  let known keys = only place ("event" :: "wall" :: "time" :: keys) event in
  match string (inside place "event") (get place event "event") with
  | "impact" ->
    known [ "index"; "mapping"; "velocity" ];
    let time_lower, time_upper = value bounds "time" and velocity_lower, velocity_upper = value bounds "velocity" in
    Impact_at { index = value integer "index"; mapped = value mapping "mapping";
                shown = { on = value wall "wall"; time_lower; time_upper; velocity_lower; velocity_upper } }
  | "rest" ->
    known [ "skipped" ];
    let lower, upper = value bounds "time" in
    let bounces = match List.assoc_opt "skipped" event with
      | None -> false
      | Some (Json.String "infinite") -> true
      | Some other -> wrong (inside place "skipped") other "\"infinite\", or no such key" in
    Rest_at (value wall "wall", lower, upper, bounces)
  | "release" ->
    known [];
    let lower, upper = value bounds "time" in
    Release_at (value wall "wall", lower, upper)
  | "graze" -> not_covered "%s is a graze: covered are impacts, rests and releases" place
  | _ -> wrong (inside place "event") (get place event "event") "\"impact\", \"graze\", \"rest\" or \"release\""

(* Of shadowed orbits impacts alone are covered. *)
let impact_only n = function
  | Impact_at event -> event
  | Rest_at _ -> not_covered "events[%d] is a rest: covered of shadowed orbits are impacts" n
  | Release_at _ -> not_covered "events[%d] is a release: covered of shadowed orbits are impacts" n

(* The bounds of a shadowed orbit's start, and how far its impacts are from the middles of theirs. *)
let read_nearness outcome =
  let inside_of key =
    let place = inside "outcome" key in
    match List.assoc_opt key outcome with
    | Some value -> (place, members place value)
    | None -> not_covered "%s is missing: covered of shadowed orbits are those with impacts" place in
  let start_at, start = inside_of "start" and epsilon_at, epsilon = inside_of "epsilon" in
  only start_at [ "time"; "velocity" ] start;
  only epsilon_at [ "median"; "maximum" ] epsilon;
  let start key = bounds (inside start_at key) (get start_at start key) in
  let epsilon key = let place = inside epsilon_at key in Expression.bound place (string place (get epsilon_at epsilon key)) in
  { start_times = start "time"; start_velocities = start "velocity"; half_within = epsilon "median"; all_within = epsilon "maximum" }

let read_outcome ~is_shadowed outcome =
  let place = "outcome" in
  let unknown = only in
  let only place known members = only place (if is_shadowed then "start" :: "epsilon" :: known else known) members in
  let impacts () = integer "outcome.impacts" (get place outcome "impacts") in
  match string "outcome.kind" (get place outcome "kind") with
  | "impacts-reached" ->
    only place [ "kind"; "message"; "impacts" ] outcome;
    Impacts_reached (impacts ())
  | "time-reached" ->
    only place [ "kind"; "message"; "impacts"; "until" ] outcome;
    let until = "outcome.until" in
    Time_reached (impacts (), Expression.number until (string until (get place outcome "until")))
  | kind when kind = periodic && not is_shadowed ->
    only place [ "kind"; "message"; "impacts"; "until"; "period" ] outcome;
    let place = "outcome.period" in
    let period = members place (get "outcome" outcome "period") in
    let count key = integer (inside place key) (get place period key) in
    unknown place [ "cycles"; "impacts" ] period;
    let until = Option.map (fun value -> Expression.number "outcome.until" (string "outcome.until" value)) (List.assoc_opt "until" outcome) in
    Repeats (impacts (), until, count "cycles", count "impacts")
  | other when is_shadowed -> not_covered "outcome.kind is %S: covered of shadowed orbits are \"impacts-reached\" and \"time-reached\"" (shortened other)
  | other -> not_covered "outcome.kind is %S: covered are \"impacts-reached\", \"time-reached\", \"periodic\" and \"attracted\"" (shortened other)

(* The periodic orbit of an outcome `attracted`, from which impact on, and what else the outcome says. *)
let read_attractor outcome =
  only "outcome" [ "kind"; "message"; "impacts"; "until"; "word"; "cycles"; "from"; "orbit" ] outcome;
  let value key = get "outcome" outcome key in
  let word = Periodic.read_word "outcome.word" (value "word") and cycles = integer "outcome.cycles" (value "cycles") in
  let impacts = integer "outcome.impacts" (value "impacts") in
  let ended = match List.assoc_opt "until" outcome with
    | None -> Impacts_reached impacts
    | Some until -> Time_reached (impacts, Expression.number "outcome.until" (string "outcome.until" until)) in
  (Periodic.read_orbit ~word ~cycles "outcome.orbit" (value "orbit"), integer "outcome.from" (value "from"), ended)

(* A document without events claims something where it says that none comes before a time after the start, or what becomes of the motion. *)
let claims_something begun events ended ~draws =
  let start = match begun with Struck (_, time, _) | Inside (time, _, _) -> time in
  let is_later until = Z.sign (Z.sub (Fixed.middle 256 { least = until; most = until }) (Fixed.middle 256 start)) > 0 in
  let is_something = match ended with
    | Impacts_reached _ -> false
    | Time_reached (_, until) -> is_later until
    | Repeats _ -> true in
  if events = [] && not draws && not is_something then
    not_covered "events is empty: the document claims nothing"

let document value =
  let head = members "the document" value in
  if not (bool "certified" (get "" head "certified")) then not_covered "certified is false: the document claims nothing";
  let is_shadowed = match List.assoc_opt "claim" head with
    | None -> false
    | Some claim when string "claim" claim = exact_start -> false
    | Some claim when string "claim" claim = shadowed -> true
    | Some claim -> not_covered "claim is %s: covered are %S and %S" (shortened (kind claim)) exact_start shadowed in
  let outcome = members "outcome" (get "" head "outcome") in
  let is_attracted = not is_shadowed && string "outcome.kind" (get "outcome" outcome "kind") = attracted in
  let attractor = if is_attracted then Some (read_attractor outcome) else None in
  let ended = match attractor with Some (_, _, ended) -> ended | None -> read_outcome ~is_shadowed outcome in
  let events = List.map read_event (items "events" (get "" head "events")) in
  let scene_data, begun = read_scene (get "" head "scene") in
  only "" ([ "schema"; "certified"; "claim"; "scene"; "outcome"; "events" ] @ no_claims) head;
  claims_something begun events ended ~draws:(attractor <> None);
  match attractor with
  | Some (cycle, from, _) -> one_harmonic "periodic orbits" scene_data; Attracted ({ scene_data; begun; events; ended }, from, cycle)
  | None ->
  if not is_shadowed then Exact { scene_data; begun; events; ended }
  else match begun with
    | Inside _ -> not_covered "scene.start is inside the gap: covered of shadowed orbits are starts on a wall"
    | Struck _ -> Shadowed ({ scene_data; begun; events = List.mapi impact_only events; ended }, read_nearness outcome)

(* To JSON. *)

let words claim =
  let cycles_text n = if Z.equal n Z.one then "cycle" else Z.to_string n ^ " cycles" in
  let near = match claim with
    | Exact _ | Attracted _ -> ""
    | Shadowed (_, { half_within; all_within; _ }) ->
      Printf.sprintf " of one true orbit that starts near (shadowed), half of them within %s forcing periods, all within %s"
        (Expression.spell half_within) (Expression.spell all_within) in
  match outcome_of claim, claim with
  | (Impacts_reached n | Time_reached (n, _)), Attracted (_, from, { word; cycles; _ }) ->
    let each = Z.of_int (List.length word) in
    Printf.sprintf "%s impact%s; proved to converge to a stable orbit of %s impact%s every %s (%s), from impact %s on" (Z.to_string n) (plural n)
      (Z.to_string each) (plural each) (cycles_text cycles) (Periodic.word_text word) (Z.to_string from)
  | Impacts_reached n, _ -> Printf.sprintf "%s impact%s%s" (Z.to_string n) (plural n) near
  | Time_reached (n, _), _ -> Printf.sprintf "%s impact%s listed%s; no other event up to the requested time" (Z.to_string n) (plural n) near
  | Repeats (n, _, cycles, each), _ ->
    Printf.sprintf "%s impact%s; proved to repeat exactly for ever, %s listed impact%s every %s" (Z.to_string n) (plural n) (Z.to_string each) (plural each)
      (cycles_text cycles)

let json_of_event = function
  | Impact_at { index; mapped; shown } ->
    Json.Object [
      ("event", String "impact"); ("index", Number (Z.to_string index));
      ("mapping", match mapped with None -> Null | Some m -> String (mapping_name m));
      ("wall", String (wall_name shown.on)); ("time", pair shown.time_lower shown.time_upper);
      ("velocity", pair shown.velocity_lower shown.velocity_upper) ]
  | Rest_at (w, lower, upper, bounces) ->
    Object ([ ("event", Json.String "rest"); ("wall", String (wall_name w)); ("time", pair lower upper) ]
      @ if bounces then [ ("skipped", Json.String "infinite") ] else [])
  | Release_at (w, lower, upper) ->
    Object [ ("event", String "release"); ("wall", String (wall_name w)); ("time", pair lower upper) ]

let json_of_nearness { start_times = (a, b); start_velocities = (c, d); half_within; all_within } =
  let number x = Json.String (Expression.spell x) in
  [ ("start", Json.Object [ ("time", pair a b); ("velocity", pair c d) ]);
    ("epsilon", Object [ ("median", number half_within); ("maximum", number all_within) ]) ]

let json_of_outcome claim =
  let common kind impacts = [ ("kind", Json.String kind); ("message", Json.String (words claim)); ("impacts", Json.Number (Z.to_string impacts)) ] in
  let near = match claim with Exact _ | Attracted _ -> [] | Shadowed (_, near) -> json_of_nearness near in
  let number x = Json.String (Expression.text { least = x; most = x }) in
  let attractor from ({ word; cycles; _ } as cycle) =
    [ ("word", Json.String (Periodic.word_text word)); ("cycles", Number (Z.to_string cycles)); ("from", Number (Z.to_string from)); ("orbit", Periodic.json_of_orbit cycle) ] in
  Json.Object (near @ match outcome_of claim, claim with
    | Impacts_reached n, Attracted (_, from, cycle) -> common attracted n @ attractor from cycle
    | Time_reached (n, until), Attracted (_, from, cycle) -> common attracted n @ [ ("until", number until) ] @ attractor from cycle
    | Impacts_reached n, _ -> common "impacts-reached" n
    | Time_reached (n, until), _ ->
      common "time-reached" n @ [ ("until", number until) ]
    | Repeats (n, until, cycles, each), _ ->
      common periodic n @ List.map (fun until -> ("until", number until)) (Option.to_list until)
      @ [ ("period", Object [ ("cycles", Number (Z.to_string cycles)); ("impacts", Number (Z.to_string each)) ]) ])

let json claim =
  let scene, beginning = scene_of claim in
  Json.Object [
    ("schema", String schema); ("certified", Bool true); ("claim", String (match claim with Exact _ | Attracted _ -> exact_start | Shadowed _ -> shadowed));
    ("scene", json_of_scene scene beginning); ("outcome", json_of_outcome claim);
    ("events", List (List.rev (List.rev_map json_of_event (occurrences claim)))) ]

(* The canonical form of a document: with the defaults that older documents leave out, and with numbers in one spelling. *)
let canonical claim head =
  let default key value members = if List.mem_assoc key members then members else (key, value) :: members in
  let outcome = function
    | Json.Object members ->
      let members = List.filter (fun member -> member <> ("message", Json.String "")) members in
      Json.Object (default "message" (Json.String (words claim)) members)
    | value -> value in
  let head = default "claim" (Json.String exact_start) (members "the document" head) in
  spelled "" (Object (List.map (fun (key, value) -> (key, if key = "outcome" then outcome value else value)) head))

(* The claims of a document. *)
let read value = claimed ~canonical ~no_claims ~document ~json (with_fastest_first value)

(* The claim in one line, in the words of the theorem. *)
let claim claimed =
  let count kind name = match List.length (List.filter kind (occurrences claimed)) with 1 -> "1 " ^ name | n -> Printf.sprintf "%d %ss" n name in
  let rests = count (function Rest_at _ -> true | _ -> false) "rest" and releases = count (function Release_at _ -> true | _ -> false) "release" in
  let listed = "with the listed indices, mappings, walls, and bounds of time and velocity" in
  let impacts n = Printf.sprintf "%s impact%s" (Z.to_string n) (plural n) in
  let contacts = "each the first contact after the one before" in
  let sequence n = match claimed with
    | (Exact _ | Attracted _) when rests = "0 rests" && releases = "0 releases" ->
      Printf.sprintf "from every start that the scene allows there is exactly one sequence of %s, %s, %s" (impacts n) contacts listed
    | Exact _ | Attracted _ ->
      Printf.sprintf "from every start that the scene allows there is exactly one motion with this sequence of %s, %s and %s: each impact is the first \
        contact after what is listed before it; a rest with `skipped` comes after infinitely many impacts on its wall, each the first contact after the one \
        before, whose times tend to that of the rest and whose velocities tend to 0, any other one at once; from a rest to its release the contact force is \
        positive, and not after it; %s" (impacts n) rests releases listed
    | Shadowed (_, { start_times; start_velocities; half_within; all_within }) ->
      let spell = Expression.spell in
      let bounds (lower, upper) = Printf.sprintf "from %s to %s" (spell lower) (spell upper) in
      Printf.sprintf "a start on the scene's wall, at a time %s with a velocity %s, one of them the scene's, has a sequence of %s, %s, %s; these bounds of the \
        start hold the scene's and are no more than a thousandth of a forcing period and of A W apart; half of the impacts are within %s forcing \
        periods of the middles of the bounds of their times, all within %s"
        (bounds start_times) (bounds start_velocities) (impacts n) contacts listed (spell half_within) (spell all_within) in
  let up_to until = "; all are up to the time " ^ Expression.text { least = until; most = until } ^ ", and the next one is after it" in
  let tends = match claimed with
    | Attracted (_, from, { word; cycles; _ }) ->
      let each = Z.of_int (List.length word) in
      Printf.sprintf "; from impact %s on the motion has impacts in the order of the word for ever, and every %s%s of them tends, whole forcing periods apart, \
        to the first impact of a periodic orbit of %s in %s forcing period%s: %s" (Z.to_string from) (Z.to_string each) (ordinal each) (impacts each)
        (Z.to_string cycles) (plural cycles) Periodic.of_orbit
    | Exact _ | Shadowed _ -> "" in
  (fun said -> said ^ tends) @@ match outcome_of claimed with
  | Impacts_reached n -> sequence n
  | Time_reached (n, until) -> sequence n ^ up_to until
  | Repeats (n, until, cycles, each) ->
    let text = Z.to_string in
    Printf.sprintf "%s%s; a part of the list with %s, from after a release up to the next one from the same wall, happens again and again, each time \
      %s forcing period%s later, for ever, and is listed with as many impacts wherever it is listed again" (sequence n) (Option.fold ~none:"" ~some:up_to until) (impacts each) (text cycles) (plural cycles)
