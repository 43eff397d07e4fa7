(* impact-pair-verified DOCUMENT: prints what an orbit document claims, and `verified` where the checker that is extracted from
   Coq says so. *)

open Checker
module Z = Integers.Z

let usage = "usage: impact-pair-verified DOCUMENT\n\n\
  Verifies an orbit document of `impact-pair run --format json` (- for standard input) by a checker extracted from its proof in Coq.\n\
  Prints the claim, and `verified` (exit 0), `not verified: REASON` (1) or `unreadable: REASON` (2).\n\n\
  impact-pair-verified --coq DOCUMENT prints a file in which Coq itself runs the checker on the same input.\n"

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

let judged = function
  | Orbit.Exact document ->
    (match Search.pieces document with
     | Refused reason -> Not_verified reason
     | Pieces pieces when Shifting.verify_document document pieces -> Verified
     | Pieces (Whole hint) -> Not_verified (Reason.why document hint)
     | Pieces _ -> Not_verified "the pieces do not make up the whole")
  | Shadowed (document, near) ->
    (match Chains.of_document document near with
     | exception Flights.Lost n -> Not_verified (Printf.sprintf "events[%d]: no orbit is found near the middles of the bounds" n)
     | None -> Not_verified Search.no_next
     | Some chain when Shadowing.verify_shadow document near chain -> Verified
     | Some chain -> Not_verified (Reason.why_not_shadowed document near chain))

let verdict source =
  match Orbit.read source with
  | exception Json.Unreadable reason -> Unreadable reason
  | exception Orbit.Not_covered reason -> Not_verified reason
  | claim ->
    print_endline ("claim: " ^ Orbit.claim claim);
    (* Numbers so large or so close that no check is computed. *)
    try judged claim with Z.Overflow | Invalid_argument _ | Failure _ | Stack_overflow | Out_of_memory | Not_found | Division_by_zero ->
      Not_verified "the numbers are beyond what the checker computes with"

(* The same input for Coq, with this program's answer. *)
let coq path =
  match Orbit.read (contents path) with
  | Exact document ->
    (match Search.pieces document with
     | Pieces pieces -> print_string (Term.file document pieces (Shifting.verify_document document pieces))
     | Refused reason -> prerr_endline ("no input for the checker: " ^ reason); exit 1)
  | Shadowed (document, near) ->
    (match Chains.of_document document near with
     | Some chain -> print_string (Term.file_of_shadow document near chain (Shadowing.verify_shadow document near chain))
     | None -> prerr_endline ("no input for the checker: " ^ Search.no_next); exit 1)

let () =
  match Array.to_list Sys.argv with
  | [ _; ("-h" | "--help") ] -> print_string usage
  | [ _; "--coq"; path ] -> coq path
  | [ _; path ] when path = "-" || path = "" || path.[0] <> '-' ->
    (match (try verdict (contents path) with Sys_error reason -> Unreadable reason) with
     | Verified -> print_endline "verified"
     | Not_verified reason -> print_endline ("not verified: " ^ reason); exit 1
     | Unreadable reason -> print_endline ("unreadable: " ^ reason); exit 2)
  | _ -> prerr_string usage; exit 2
