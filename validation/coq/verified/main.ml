(* impact-pair-verified DOCUMENT: prints the claims of a document, and `verified` where the checker extracted from Coq accepts it. *)

open Checker
module Z = Integers.Z

let usage = "usage: impact-pair-verified DOCUMENT\n\n\
  Verifies a document of `impact-pair run`, `periodic`, `trap` or `chaos`, in JSON, (- for standard input) by a checker extracted from its proof in Coq.\n\
  Prints the claim, the scene and the SHA-256 of the document, and `verified` (exit 0), `not verified: REASON` (1) or `unreadable: REASON` (2).\n\n\
  impact-pair-verified --part KEY DOCUMENT verifies the document at a key of a description: proof or region.\n\
  impact-pair-verified --coq [--part KEY] DOCUMENT prints a file in which Coq itself runs the checker on the same input, and concludes the claims.\n\
  impact-pair-verified --version\n"

type verdict = Verified | Not_verified of string | Unreadable of string

let contents path =
  let all channel =
    let out = Buffer.create 65536 in
    (try while true do Buffer.add_channel out channel 1 done with End_of_file -> ());
    Buffer.contents out in
  if path = "-" then all stdin
  else
    let channel = open_in_bin path in
    Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

let of_pieces document accepted = match Search.pieces document with
  | Refused reason -> Not_verified reason
  | Pieces pieces when Shifting.verify_document document pieces -> accepted pieces
  | Pieces (Whole hint) -> Not_verified (Reason.why document hint)
  | Pieces _ -> Not_verified "the pieces do not make up the whole"

let judged_orbit = function
  | Orbit.Exact document -> of_pieces document (fun _ -> Verified)
  | Attracted (document, from, cycle) ->
    of_pieces document (fun pieces ->
      match Ellipses.around document.scene_data document.begun cycle ~plain:true with
      | exception Flights.Lost _ -> Not_verified "outcome.orbit: no ellipse around it is found that the flights contract"
      | around when not (Drawing.Cyc.check_cycle document.scene_data cycle around) -> Not_verified (Reason.why_no_cycle "outcome.orbit" document.scene_data cycle around)
      | around ->
        match Ellipses.approach document from around.wide_disc with
        | Some approach when verify_attracted document pieces from cycle around approach -> Verified
        | _ -> Not_verified "outcome.from: the motion is not proved to follow the word from there on, into an ellipse that the flights contract")
  | Shadowed (document, near) ->
    (match Chains.of_document document near with
     | exception Flights.Lost n -> Not_verified (Printf.sprintf "events[%d]: no orbit is found near the middles of the bounds" n)
     | None -> Not_verified Search.no_next
     | Some chain when Shadowing.verify_shadow document near chain -> Verified
     | Some chain -> Not_verified (Reason.why_not_shadowed document near chain))

let judged_cycles ({ data; start; orbits; _ } : Periodic.claim) =
  match Ellipses.around_all data start orbits with
  | Error n -> Not_verified (Printf.sprintf "orbits[%d]: no ellipse around it is found with exactly one orbit" n)
  | Ok around when Drawing.verify_cycles data start orbits around -> Verified
  | Ok around -> Not_verified (Reason.why_no_cycles data start orbits around)

let judged_region (claim : Trap.claim) = match Reason.wrong_data (Z.of_int 256) claim.data claim.start [] with
  | Some reason -> Not_verified reason
  | None ->
    match Plans.coming claim with
    | Error reason -> Not_verified reason
    | Ok (entry, pieces) ->
      let holds plan = verify_region claim.data claim.start claim.region claim.properties plan entry pieces in
      let plans = List.map (Plans.plan claim) Plans.attempts in
      if List.exists holds plans then Verified else Not_verified (Reason.why_no_region claim (List.hd (List.rev plans)) entry)

let judged_chaos (claim : Words.claim) = match Reason.wrong_data (Z.of_int 256) claim.data claim.start [] with
  | Some reason -> Not_verified reason
  | None ->
    let outline = Rates.outline claim in
    match Reason.why_no_chaos claim outline with
    | Some reason -> Not_verified reason
    | None ->
      match Rates.with_strips claim outline with
      | Error n -> Not_verified (Printf.sprintf "words[%d]: no stretch of its first h-set is found that it leads across the second one" n)
      | Ok hint when verify_chaos claim.data claim.start claim.chaos hint -> Verified
      | Ok _ -> Not_verified "words: the stretches of two of them touch, or one is not proved"

type claim = Orbit of Orbit.claim | Cycles of Periodic.claim | Region of Trap.claim | Words of Words.claim
let description = "impact-pair/description/1"

let read ?part source =
  let whole = Json.read source in
  let value = match part with None -> whole | Some key -> Reading.get "" (Reading.members "the document" whole) key in
  match Reading.schema_of value with
  | is when is = Orbit.schema -> Orbit (Orbit.read value)
  | is when is = Periodic.schema -> Cycles (Periodic.read value)
  | is when is = Trap.schema -> Region (Trap.read value)
  | is when is = Words.schema -> Words (Words.read value)
  | is when is = description ->
    let parts = List.filter (fun key -> List.mem_assoc key (Reading.members "the document" value)) [ "proof"; "region" ] in
    let parts = List.filter (fun key -> Reading.get "" (Reading.members "the document" value) key <> Json.Null) parts in
    if parts = [] then Reading.not_covered "the description has neither a proof nor a region"
    else Reading.not_covered "covered of a description are the documents in it: impact-pair-verified --part %s" (String.concat ", or --part " parts)
  | is -> Reading.not_covered "schema is %S: covered are %S, %S, %S and %S" (Reading.shortened is) Orbit.schema Periodic.schema Trap.schema Words.schema
let scene_of = function
  | Orbit claim -> Orbit.scene_of claim
  | Cycles { data; start; _ } -> (data, start)
  | Region { data; start; _ } -> (data, start)
  | Words { data; start; _ } -> (data, start)
let said = function Orbit claim -> Orbit.claim claim | Cycles claim -> Periodic.claim claim | Region claim -> Trap.claim claim | Words claim -> Words.claim claim
let judged = function Orbit claim -> judged_orbit claim | Cycles claim -> judged_cycles claim | Region claim -> judged_region claim | Words claim -> judged_chaos claim

let verdict ?part source =
  match read ?part source with
  | exception Json.Unreadable reason -> Unreadable reason
  | exception Reading.Not_covered reason -> Not_verified reason
  | claim ->
    let data, start = scene_of claim in
    print_endline ("claim: " ^ said claim);
    print_endline ("scene: " ^ Reading.scene_in_words data start);
    print_endline ("document: SHA-256 " ^ Sha256.of_text source);
    (* Numbers so large or so close that no check is computed. *)
    try judged claim with Z.Overflow | Invalid_argument _ | Failure _ | Stack_overflow | Out_of_memory | Not_found | Division_by_zero ->
      Not_verified "the numbers are beyond what the checker computes with"

(* The same input for Coq, with this program's answer. *)
let no_input reason = prerr_endline ("no input for the checker: " ^ reason); exit 1
let pieces_of document = match Search.pieces document with Search.Pieces pieces -> pieces | Refused reason -> no_input reason
let coq ?part path =
  match read ?part (contents path) with
  | Orbit (Exact document) ->
    let pieces = pieces_of document in
    print_string (Term.file document pieces (Shifting.verify_document document pieces))
  | Orbit (Attracted (document, from, cycle)) ->
    let pieces = pieces_of document and around = Ellipses.around document.scene_data document.begun cycle ~plain:true in
    (match Ellipses.approach document from around.wide_disc with
     | Some approach -> print_string (Term.file_of_attracted document pieces from cycle around approach (verify_attracted document pieces from cycle around approach))
     | None -> no_input "no way into an ellipse is found")
  | Orbit (Shadowed (document, near)) ->
    (match Chains.of_document document near with
     | Some chain -> print_string (Term.file_of_shadow document near chain (Shadowing.verify_shadow document near chain))
     | None -> no_input Search.no_next)
  | Cycles { data; start; orbits; _ } ->
    (match Ellipses.around_all data start orbits with
     | Ok around -> print_string (Term.file_of_cycles data start orbits around (Drawing.verify_cycles data start orbits around))
     | Error n -> no_input (Printf.sprintf "orbits[%d] is not found" n))
  | Region ({ data; start; region; properties; _ } as claim) ->
    (match Plans.coming claim with
     | Error reason -> no_input reason
     | Ok (entry, pieces) ->
       let plan = Plans.plan claim (List.hd Plans.attempts) in
       print_string (Term.file_of_region data start region properties plan entry pieces (verify_region data start region properties plan entry pieces)))
  | Words ({ data; start; chaos; _ } as claim) ->
    (match Rates.with_strips claim (Rates.outline claim) with
     | Ok hint -> print_string (Term.file_of_chaos data start chaos hint (verify_chaos data start chaos hint))
     | Error n -> no_input (Printf.sprintf "no strip of words[%d] is found" n))

let judge ?part path =
  match (try verdict ?part (contents path) with Sys_error reason -> Unreadable reason) with
  | Verified -> print_endline "verified"
  | Not_verified reason -> print_endline ("not verified: " ^ reason); exit 1
  | Unreadable reason -> print_endline ("unreadable: " ^ reason); exit 2
let is_file path = path = "-" || path = "" || path.[0] <> '-'

let () =
  match Array.to_list Sys.argv with
  | [ _; ("-h" | "--help") ] -> print_string usage
  | [ _; ("-V" | "--version") ] -> print_endline ("impact-pair-verified " ^ Version.version)
  | [ _; "--coq"; path ] -> coq path
  | [ _; "--coq"; "--part"; (("proof" | "region") as part); path ] -> coq ~part path
  | [ _; "--part"; (("proof" | "region") as part); path ] when is_file path -> judge ~part path
  | [ _; path ] when is_file path -> judge path
  | _ -> prerr_string usage; exit 2
