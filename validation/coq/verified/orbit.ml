(* An orbit document: from JSON to the claim of Document.v, and back. What is read is written again and compared, byte for
   byte, with the canonical form of the document, so that nothing else is verified than what it says. *)

open Checker
module Z = Integers.Z

exception Not_covered of string

let not_covered format = Printf.ksprintf (fun message -> raise (Not_covered message)) format
let unreadable = Json.unreadable

let schema = "impact-pair/orbit/1"
let exact_start = "exact start"
let shadowed = "shadowed"
let periodic = "periodic"

(* What a document claims: of the orbit from the scene's start, or of one that starts near. *)
type claim = Exact of document | Shadowed of event document_of * nearness
let scene_of = function Exact { scene_data; begun; _ } -> (scene_data, begun) | Shadowed ({ scene_data; begun; _ }, _) -> (scene_data, begun)
let outcome_of = function Exact { ended; _ } -> ended | Shadowed ({ ended; _ }, _) -> ended
let occurrences = function Exact { events; _ } -> events | Shadowed ({ events; _ }, _) -> List.map (fun event -> Impact_at event) events

(* Keys that claim nothing. *)
let no_claims = [ "program"; "arithmetic" ]

(* Values with the places where they stand. *)

let kind = function
  | Json.Null -> "null"
  | Bool b -> string_of_bool b
  | Number n -> n
  | String s -> Printf.sprintf "\"%s\"" s
  | List _ -> "a list"
  | Object _ -> "an object"

let shortened text = if String.length text > 60 then String.sub text 0 60 ^ ".." else text
let wrong place value what = unreadable "%s: %s, but accepted is %s" place (shortened (kind value)) what

let members place = function Json.Object members -> members | value -> wrong place value "an object"
let items place = function
  | Json.List items -> List.mapi (fun i item -> (Printf.sprintf "%s[%d]" place i, item)) items
  | value -> wrong place value "a list"
let inside place key = if place = "" then key else place ^ "." ^ key
let get place members key =
  match List.assoc_opt key members with
  | Some value -> value
  | None -> unreadable "%s is missing" (inside place key)
let string place = function Json.String s -> s | value -> wrong place value "a string"
let bool place = function Json.Bool b -> b | value -> wrong place value "true or false"
let integer place = function
  | Json.Number n when String.length n < 19 && String.for_all (fun c -> c >= '0' && c <= '9') n -> Z.of_string n
  | value -> wrong place value "an integer from 0 on"
let range place value = Expression.parse place (string place value)
let wall place value = match string place value with
  | "left" -> Left
  | "right" -> Right
  | _ -> wrong place value "\"left\" or \"right\""
let mapping place = function
  | Json.Null -> None
  | String "P1" -> Some P1
  | String "P2" -> Some P2
  | String "P3" -> Some P3
  | String "P4" -> Some P4
  | value -> wrong place value "\"P1\", \"P2\", \"P3\", \"P4\" or null"
let bounds place value = match items place value with
  | [ (p, lower); (q, upper) ] -> (Expression.bound p (string p lower), Expression.bound q (string q upper))
  | _ -> wrong place value "a list of two bounds"

(* No other keys than these. *)
let only place known members =
  List.iter (fun (key, _) ->
    if not (List.mem key known) then not_covered "%s is not covered by the theorem" (inside place key)) members

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

let read_scene value =
  let place = "scene" in
  let scene = members place value in
  only place [ "excitation"; "gap"; "restitution"; "start" ] scene;
  let excitation = inside place "excitation" in
  let terms = members excitation (get place scene "excitation") in
  only excitation [ "amplitude"; "frequency"; "phase" ] terms;
  let list key = let place = inside excitation key in
    List.map (fun (place, value) -> range place value) (items place (get excitation terms key)) in
  let amplitudes = list "amplitude" and frequencies = list "frequency" and phases = list "phase" in
  if List.compare_lengths amplitudes frequencies <> 0 || List.compare_lengths amplitudes phases <> 0 then
    unreadable "%s: as many frequencies and phases as amplitudes are accepted" excitation;
  let tones = List.map2 (fun (amplitude, frequency) shift -> { amplitude; frequency; shift })
    (List.combine amplitudes frequencies) phases in
  match tones with
  | [] -> unreadable "%s.amplitude: an empty list, but accepted is one amplitude or more" excitation
  | leading :: further ->
    let value key = range (inside place key) (get place scene key) in
    let data = { leading; further; gap = value "gap"; restitution = value "restitution" } in
    let place = inside place "start" in
    let start = members place (get "scene" scene "start") in
    only place [ "time"; "wall"; "position"; "velocity" ] start;
    let value key = range (inside place key) (get place start key) in
    let beginning = match List.mem_assoc "wall" start, List.mem_assoc "position" start with
      | true, false -> Struck (wall (inside place "wall") (get place start "wall"), value "time", value "velocity")
      | false, true -> Inside (value "time", value "position", value "velocity")
      | _ -> unreadable "%s: accepted is a wall or a position" place in
    (data, beginning)

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
  | other -> not_covered "outcome.kind is %S: covered are \"impacts-reached\", \"time-reached\" and \"periodic\"" (shortened other)

let document value =
  let head = members "the document" value in
  let is = string "schema" (get "" head "schema") in
  if is <> schema then not_covered "schema is %S: covered is %S" (shortened is) schema;
  if not (bool "certified" (get "" head "certified")) then not_covered "certified is false: the document claims nothing";
  let is_shadowed = match List.assoc_opt "claim" head with
    | None -> false
    | Some claim when string "claim" claim = exact_start -> false
    | Some claim when string "claim" claim = shadowed -> true
    | Some claim -> not_covered "claim is %s: covered are %S and %S" (shortened (kind claim)) exact_start shadowed in
  let outcome = members "outcome" (get "" head "outcome") in
  let ended = read_outcome ~is_shadowed outcome in
  let events = List.map read_event (items "events" (get "" head "events")) in
  let scene_data, begun = read_scene (get "" head "scene") in
  only "" ([ "schema"; "certified"; "claim"; "scene"; "outcome"; "events" ] @ no_claims) head;
  if not is_shadowed then Exact { scene_data; begun; events; ended }
  else match begun with
    | Inside _ -> not_covered "scene.start is inside the gap: covered of shadowed orbits are starts on a wall"
    | Struck _ -> Shadowed ({ scene_data; begun; events = List.mapi impact_only events; ended }, read_nearness outcome)

(* To JSON. *)

let plural n = if Z.equal n Z.one then "" else "s"
let words claim =
  let near = match claim with
    | Exact _ -> ""
    | Shadowed (_, { half_within; all_within; _ }) ->
      Printf.sprintf " of one true orbit that starts near (shadowed), half of them within %s forcing periods, all within %s"
        (Expression.spell half_within) (Expression.spell all_within) in
  match outcome_of claim with
  | Impacts_reached n -> Printf.sprintf "%s impact%s%s" (Z.to_string n) (plural n) near
  | Time_reached (n, _) -> Printf.sprintf "%s impact%s listed%s; no other event up to the requested time" (Z.to_string n) (plural n) near
  | Repeats (n, _, cycles, each) ->
    Printf.sprintf "%s impact%s; proved to repeat exactly for ever, %s listed impact%s every %s" (Z.to_string n) (plural n) (Z.to_string each) (plural each)
      (if Z.equal cycles Z.one then "cycle" else Z.to_string cycles ^ " cycles")

let wall_name = function Left -> "left" | Right -> "right"
let mapping_name = function P1 -> "P1" | P2 -> "P2" | P3 -> "P3" | P4 -> "P4"

let json_of_scene data beginning =
  let text r = Json.String (Expression.text r) in
  let list field = Json.List (List.map (fun tone -> text (field tone)) (data.leading :: data.further)) in
  let start = match beginning with
    | Struck (w, t, v) -> [ ("time", text t); ("wall", Json.String (wall_name w)); ("velocity", text v) ]
    | Inside (t, y, v) -> [ ("time", text t); ("position", text y); ("velocity", text v) ] in
  Json.Object [
    ("excitation", Object [ ("amplitude", list (fun x -> x.amplitude)); ("frequency", list (fun x -> x.frequency));
                            ("phase", list (fun x -> x.shift)) ]);
    ("gap", text data.gap); ("restitution", text data.restitution); ("start", Object start) ]

let pair lower upper = Json.List [ String (Expression.spell lower); String (Expression.spell upper) ]

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
  let near = match claim with Exact _ -> [] | Shadowed (_, near) -> json_of_nearness near in
  let number x = Json.String (Expression.text { least = x; most = x }) in
  Json.Object (near @ match outcome_of claim with
    | Impacts_reached n -> common "impacts-reached" n
    | Time_reached (n, until) ->
      common "time-reached" n @ [ ("until", number until) ]
    | Repeats (n, until, cycles, each) ->
      common periodic n @ List.map (fun until -> ("until", number until)) (Option.to_list until)
      @ [ ("period", Object [ ("cycles", Number (Z.to_string cycles)); ("impacts", Number (Z.to_string each)) ]) ])

let json claim =
  let scene, beginning = scene_of claim in
  Json.Object [
    ("schema", String schema); ("certified", Bool true); ("claim", String (match claim with Exact _ -> exact_start | Shadowed _ -> shadowed));
    ("scene", json_of_scene scene beginning); ("outcome", json_of_outcome claim);
    ("events", List (List.rev (List.rev_map json_of_event (occurrences claim)))) ]

(* The canonical form of a document: without what claims nothing, with the defaults that older documents leave out, and with
   numbers in one spelling. *)
let canonical claim document =
  let numbers = [ "gap"; "restitution"; "amplitude"; "frequency"; "phase"; "time"; "position"; "velocity"; "until"; "median"; "maximum" ] in
  let rec spelled key = function
    | Json.String s when List.mem key numbers -> Json.String (Expression.canonical s)
    | String s when key = "message" -> String (Expression.without_exponents s)
    | List items -> List (List.rev (List.rev_map (spelled key) items))
    | Object members -> Object (List.map (fun (key, value) -> (key, spelled key value)) members)
    | value -> value in
  let default key value members = if List.mem_assoc key members then members else (key, value) :: members in
  let outcome = function
    | Json.Object members ->
      let members = List.filter (fun member -> member <> ("message", Json.String "")) members in
      Json.Object (default "message" (Json.String (words claim)) members)
    | value -> value in
  let head = members "the document" document in
  let head = List.filter (fun (key, _) -> not (List.mem key no_claims)) head in
  let head = default "claim" (Json.String exact_start) head in
  spelled "" (Object (List.map (fun (key, value) -> (key, if key = "outcome" then outcome value else value)) head))

(* The first place where two texts differ. *)
let difference a b =
  let n = min (String.length a) (String.length b) in
  let rec first i = if i < n && a.[i] = b.[i] then first (i + 1) else i in
  let i = first 0 in
  let part s = String.sub s (max 0 (i - 20)) (min (String.length s) (i + 20) - max 0 (i - 20)) in
  (part a, part b)

(* What a document claims. *)
let read source =
  let value = with_fastest_first (Json.read source) in
  let claim = document value in
  let written = Json.text (Json.sorted (canonical claim value)) and understood = Json.text (Json.sorted (json claim)) in
  if written <> understood then begin
    let a, b = difference written understood in
    unreadable "written is `..%s..`, and accepted is the spelling `..%s..`" a b
  end;
  claim

(* The claim in one line, in the words of the theorem. *)
let claim claimed =
  let count kind name = match List.length (List.filter kind (occurrences claimed)) with 1 -> "1 " ^ name | n -> Printf.sprintf "%d %ss" n name in
  let rests = count (function Rest_at _ -> true | _ -> false) "rest" and releases = count (function Release_at _ -> true | _ -> false) "release" in
  let listed = "with the listed indices, mappings, walls, and bounds of time and velocity" in
  let impacts n = Printf.sprintf "%s impact%s" (Z.to_string n) (plural n) in
  let contacts = "each the first contact after the one before" in
  let sequence n = match claimed with
    | Exact _ when rests = "0 rests" && releases = "0 releases" ->
      Printf.sprintf "from every start that the scene allows there is exactly one sequence of %s, %s, %s" (impacts n) contacts listed
    | Exact _ ->
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
  match outcome_of claimed with
  | Impacts_reached n -> sequence n
  | Time_reached (n, until) -> sequence n ^ up_to until
  | Repeats (n, until, cycles, each) ->
    let text = Z.to_string in
    Printf.sprintf "%s%s; a part of the list with %s, from after a release up to the next one from the same wall, happens again and again, each time \
      %s forcing period%s later, for ever" (sequence n) (Option.fold ~none:"" ~some:up_to until) (impacts each) (text cycles) (plural cycles)
