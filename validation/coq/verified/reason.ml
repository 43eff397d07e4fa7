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

let why document hint =
  let bits = hint.origin.start_bits in
  if not (Each.check_data bits document.scene_data) then
    "scene: not proved to be an impact pair (no amplitude negative, frequencies and gap positive, 0 <= restitution <= 1)"
  else if not (Each.check_beginning bits document.scene_data document.begun) then
    "scene.start: not proved to be on its wall, from inside, or inside the gap"
  else match first_wrong_name document with
  | Some n -> Printf.sprintf "events[%d]: index or mapping is not that of its place in the list" n
  | None ->
    if not (Each.check_outcome bits document.ended document.events hint.next_impact) then
      "outcome: the impacts are not those listed, or not all of them proved to be up to `until` and the next one after it"
    else if not (Check.check_start document.scene_data document.begun hint.origin) then "scene.start: not enclosed"
    else match first_wrong_leg document hint with
    | Some n when n = List.length document.events -> "outcome.until: the next impact is not proved to be after it"
    | Some n -> Printf.sprintf "events[%d]: not proved to be the next contact, on its wall, within its bounds" n
    | None -> "the certificate is not accepted"
