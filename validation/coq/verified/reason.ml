(* The reason why a document is not verified: the first part that the checker refuses. It determines the message alone. *)

open Checker
module Z = Integers.Z
module Steps = Shifting.Each
module Each = Steps.Each
module Check = Each.Check

let first_wrong_name begun events =
  let rec look previous n number = function
    | [] -> None
    | event :: rest ->
      if not (check_named previous number [ event ]) then Some n
      else match event with
        | Impact_at { shown; _ } -> look (Some shown.on) (n + 1) (Z.succ number) rest
        | Rest_at (w, _, _, _) | Release_at (w, _, _) -> look (Some w) (n + 1) number rest in
  look (first_wall begun) 0 Z.one events

(* The first event that is refused after those before it. *)
let first_wrong_step { scene_data = data; begun; events; _ } { origin; steps; next_one; _ } =
  let after place step event = match place, step, event with
    | Steps.In_flight (b, _), Rest r, Rest_at (w, _, _, bounces) -> Steps.On_wall (w, Steps.rest_phase data r.rest_bits r.rest_scale b w bounces r)
    | On_wall (w, _), Release r, _ -> Steps.away data r.release_bits r.release_scale w r
    | _, Flight leg, _ -> In_flight (Check.landed data leg, None)
    | _ -> place in
  let rec look place n steps listed = match steps, listed with
    | step :: steps, event :: listed ->
      if Steps.check_steps data place [ step ] [ event ] then look (after place step event) (n + 1) steps listed else Some (n, event)
    | _ -> None in
  look (In_flight (Check.start_box data begun origin, None)) 0 steps (events @ Option.to_list next_one)

(* The conditions on every document. *)
let wrong_data bits data begun events =
  if not (Each.check_data bits data) then
    Some "scene: not proved to be an impact pair (no amplitude negative, frequencies and gap positive, 0 <= restitution <= 1)"
  else if not (Each.check_beginning bits data begun) then
    Some "scene.start: not proved to be on its wall, from inside, or inside the gap"
  else Option.map (Printf.sprintf "events[%d]: index or mapping is not that of its place in the list") (first_wrong_name begun events)

let why ({ scene_data; begun; events; ended } as document) hint =
  let bits = hint.origin.start_bits in
  match wrong_data bits scene_data begun events with
  | Some reason -> reason
  | None ->
    if not (Steps.check_end bits scene_data ended events hint) then
      "outcome: the impacts are not those listed, or not all events proved to be up to `until` and the next one after it"
      ^ (match ended with Repeats _ -> ", or not to repeat as is said" | _ -> "")
    else if not (Check.check_start scene_data begun hint.origin) then "scene.start: not enclosed"
    else match first_wrong_step document hint with
    | Some (n, _) when n = List.length events -> "outcome.until: the next event is not proved to be after it"
    | Some (n, Impact_at _) -> Printf.sprintf "events[%d]: not proved to be the next contact, on its wall, within its bounds" n
    | Some (n, Rest_at _) -> Printf.sprintf "events[%d]: the ball is not proved to come to rest, on its wall, within its bounds" n
    | Some (n, Release_at _) -> Printf.sprintf "events[%d]: not proved to be the end of the rest, within its bounds" n
    | None -> "the certificate is not accepted"

(* The first impact whose parallelogram the one before does not cover, or that is not within its bounds. *)
let first_wrong_link { scene_data; begun; events; _ } near { chain_bits = p; chain_scale = q; first_chart; links; _ } =
  let rec look n from hops events links = match hops, events, links with
    | hop :: hops, event :: events, (link, into) :: links ->
      if not (Shadowing.Cover.check_link p q scene_data hop from into link) then
        Some (Printf.sprintf "events[%d]: no orbit is proved to go on to it from the impact before" n)
      else if not (Shadowing.check_node p q scene_data near event into) then
        Some (Printf.sprintf "events[%d]: no orbit is proved to be within its bounds, as near to their middle as `outcome.epsilon` says" n)
      else look (n + 1) into hops events links
    | _ -> None in
  look 0 first_chart (flights (Option.get (first_wall begun)) events) events links

let why_not_shadowed document near chain =
  match wrong_data chain.chain_bits document.scene_data document.begun (List.map (fun event -> Impact_at event) document.events) with
  | Some reason -> reason
  | None ->
    match first_wrong_link document near chain with
    | Some reason -> reason
    | None when not (Each.check_fastest chain.chain_bits document.scene_data) ->
      "scene.excitation.frequency: no harmonic is proved to be the fastest, in whose periods `outcome.epsilon` is"
    | None -> "outcome: not proved are its number of impacts, `until`, its bounds of the start, or that half of the impacts are within `median`"

(* The first part of a periodic orbit that is refused. *)
let why_no_cycle place data ({ spots; word; cycles; _ } as cycle) ({ wide_disc; narrow_disc; _ } as around) =
  let module Cyc = Drawing.Cyc in
  let walls = List.map (fun { onto; _ } -> onto) narrow_disc.way in
  let w = (List.hd spots).spot_wall in
  let pn = narrow_disc.disc_bits and pw = narrow_disc.disc_scale in
  let cells = Cyc.Disc.all_starts narrow_disc :: List.map (fun { image_of_all; _ } -> image_of_all) narrow_disc.way in
  let trace = Cyc.Disc.trace_in data w narrow_disc in
  let refused =
    if not (same_names word (List.rev (mappings w walls))) then "the word is not that of the listed walls"
    else if not (Cyc.Disc.check_disc data w cycles wide_disc && Cyc.Disc.check_disc data w cycles narrow_disc) then
      "not proved to come back after `cycles` forcing periods, by first contacts, as the only orbit near"
    else if not (Cyc.check_spots data pn pw (match around.spot_turns with k :: _ -> k | [] -> Z.zero) spots cells around.spot_turns) then "an impact is not within its bounds, or not in its `cycle`, or its phase not in [0, 2 pi), or has bounds 2 pi apart"
    else if not (List.for_all (Cyc.apart_spots (List.hd spots)) (List.tl spots)) then "it is not proved to be no shorter orbit several times"
    else if not (Cyc.check_spots data pn pw (match around.spot_turns with k :: _ -> k | [] -> Z.zero) [ as_first (List.hd spots) ] cells around.spot_turns) then "the `cycle` of the first impact is not 0"
    else if not (Cyc.check_mirroring w cycle wide_disc narrow_disc around.mirroring_of) then "`symmetric` is not proved"
    else if not (Cyc.Disc.Round.Each.Check.is_within pn cycle.trace_bounds trace) then "the trace is not within its bounds"
    else if not (Cyc.check_determinant data pn cycle.determinant_bounds (Rests.nat (2 * List.length walls))) then "the determinant is not within its bounds"
    else "eigenvalues, `stability`, or that it is the only orbit within the bounds of the first impact, are not proved" in
  place ^ ": " ^ refused
let why_no_cycles data start orbits arounds =
  match wrong_data (Z.of_int 256) data start [] with
  | Some reason -> reason
  | None ->
    let rec look n = function
      | (cycle, around) :: rest when Drawing.Cyc.check_cycle data cycle around -> look (n + 1) rest
      | (cycle, around) :: _ -> why_no_cycle (Printf.sprintf "orbits[%d]" n) data cycle around
      | [] -> "orbits: two are not proved to be different ones, or the scene not to have one harmonic with a positive amplitude" in
    look 0 (List.combine orbits arounds)

(* The first part of a region that is refused. *)
let why_no_region ({ data; start; region; properties; _ } : Trap.claim) plan entry =
  let module March = Trapping.Marching in
  let units = Trapping.units_in data region plan in
  let rec first n holds = function [] -> None | run :: runs -> if holds run then first (n + 1) holds runs else Some n in
  match wrong_data (Z.of_int 256) data start [] with
  | Some reason -> reason
  | None ->
    if not (check_count region properties.box_count) then "boxes: the runs of `region` are not in order, not in the grid, or have another number of boxes"
    else if not (Trapping.check_flights data region properties plan) then "flight, longest_flight and flight_time: there is no time between these bounds"
    else match first 0 (Trapping.check_speeds data region properties) region.runs with
    | Some n -> Printf.sprintf "region[%d]: its rows are not proved to be within `speed` and `speed_before`" n
    | None ->
      match first 0 (March.check_run region plan units) region.runs with
      | Some n -> Printf.sprintf "region[%d]: not all flights from its boxes are proved to come to boxes of the region, within the bounds of flights" n
      | None when not (match properties.entered with None -> true | Some n -> Trapping.check_entry data start region plan entry n) ->
        "entered_at_impact: this impact, counted along the motion without rests, is not proved to be in the region"
      | None -> "the impacts up to `entered_at_impact` are not proved, or the scene not to have a positive amplitude"

(* The fault of a horseshoe, its strips aside. *)
let why_no_chaos ({ chaos; _ } : Words.claim) { found_words = { word_bits; grid_bits; sets; _ } as found; by_impacts; by_half_cycles } =
  let entropy key weight h growth () = if Growing.check_entropy word_bits chaos weight h growth then None else Some (key ^ ": it does not follow from the words") in
  List.find_map (fun reason -> reason ()) [
    (fun () -> if agrees chaos found then None else Some "words: their half cycles are not those of their flights");
    (fun () -> if check_blocks chaos then None else Some "horseshoe: the two blocks are not words that may follow one another in any order, or not those with the fewest impacts");
    (fun () -> if Setting.check_h_sets word_bits grid_bits chaos.h_sets sets then None
      else Some "bases: h-sets overlap, or phase, speed, expanding and contracting are not those of the corners");
    entropy "entropy.per_impact" Rates.impacts chaos.per_impact by_impacts;
    entropy "entropy.per_cycle" (fun word -> word.half_cycles) (Rates.half chaos.per_cycle) by_half_cycles ]
