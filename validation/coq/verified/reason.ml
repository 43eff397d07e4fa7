(* Why a document is not verified: the first part that the checker refuses. It only words the answer. *)

open Checker
module Z = Integers.Z
module Each = Shifting.Each
module Check = Each.Check

let first_wrong_name { begun; events; _ } =
  let rec look previous n = function
    | [] -> None
    | event :: rest ->
      if numbered previous (Z.of_int n) [ event ] then look (Some event.shown.on) (n + 1) rest else Some (n - 1) in
  look (first_wall begun) 1 events

let first_wrong_leg { scene_data; begun; events; _ } { origin; legs; next_impact } =
  let printed = List.map (fun event -> event.shown) events @ Option.to_list next_impact in
  let rec look box n legs printed = match legs, printed with
    | leg :: legs, bounds :: printed ->
      if Check.check_leg scene_data box leg bounds then
        let e = Check.enclose_range leg.bits scene_data.restitution in
        look (Check.landing leg.bits e leg.hits leg.scale0 leg.t leg.rt leg.v leg.rv) (n + 1) legs printed
      else Some n
    | _ -> None in
  look (Check.start_box scene_data begun origin) 0 legs printed

(* What is asked of every document. *)
let wrong_data bits document =
  if not (Each.check_data bits document.scene_data) then
    Some "scene: not proved to be an impact pair (no amplitude negative, frequencies and gap positive, 0 <= restitution <= 1)"
  else if not (Each.check_beginning bits document.scene_data document.begun) then
    Some "scene.start: not proved to be on its wall, from inside, or inside the gap"
  else Option.map (Printf.sprintf "events[%d]: index or mapping is not that of its place in the list") (first_wrong_name document)

let why document hint =
  let bits = hint.origin.start_bits in
  match wrong_data bits document with
  | Some reason -> reason
  | None ->
    if not (Each.check_outcome bits document.ended document.events hint.next_impact) then
      "outcome: the impacts are not those listed, or not all of them proved to be up to `until` and the next one after it"
    else if not (Check.check_start document.scene_data document.begun hint.origin) then "scene.start: not enclosed"
    else match first_wrong_leg document hint with
    | Some n when n = List.length document.events -> "outcome.until: the next impact is not proved to be after it"
    | Some n -> Printf.sprintf "events[%d]: not proved to be the next contact, on its wall, within its bounds" n
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
  match wrong_data chain.chain_bits document with
  | Some reason -> reason
  | None ->
    match first_wrong_link document near chain with
    | Some reason -> reason
    | None when not (Shadowing.check_fastest chain.chain_bits document.scene_data) ->
      "scene.excitation.frequency: no harmonic is proved to be the fastest, in whose periods `outcome.epsilon` is"
    | None -> "outcome: not proved are its number of impacts, `until`, its bounds of the start, or that half of the impacts are within `median`"
