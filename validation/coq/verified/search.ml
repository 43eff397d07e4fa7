(* The pieces of a document with intervals among the data: an interval is halved until each part is verified. Nothing here is
   proved, nor need be: the checker verifies that the parts make up the whole. *)

open Checker
module Z = Integers.Z
type float = Stdlib.Float.t

(* Halvings of one part, and attempts in all. *)
let deepest = 20
let most_attempts = 4096

let nat = Rests.nat

(* The intervals of a document, each with what half its width makes in the units of Step.v, about. *)
let intervals ({ scene_data = p; begun; events; _ } : document) =
  let bits = Flights.fine in
  let value r = Fixed.to_float bits (Fixed.middle bits r) and half = Fixed.half_width in
  let a = value p.leading.amplitude and w = value p.leading.frequency in
  let t, v = match begun with Struck (_, t, v) | Inside (t, _, v) -> (t, v) in
  let last = match List.rev events with x :: _ -> Fixed.to_float bits (Fixed.of_q bits (Shifting.Each.latest x)) | [] -> value t in
  let span = 1.0 +. abs_float last +. abs_float (value t) in
  let of_tone n tone = [
    (Amplitude (nat n), tone.amplitude, half tone.amplitude /. a);
    (Frequency (nat n), tone.frequency, half tone.frequency *. span);
    (Phase (nat n), tone.shift, half tone.shift) ] in
  let place = match begun with Inside (_, y, _) -> [ (Start_place, y, half y /. a) ] | Struck _ -> [] in
  let all = List.concat (List.mapi of_tone (p.leading :: p.further)) @ place @ [
    (Gap, p.gap, half p.gap /. a); (Restitution, p.restitution, half p.restitution);
    (Start_time, t, half t *. w); (Start_velocity, v, half v /. (a *. w)) ] in
  List.filter (fun (_, _, effect) -> effect > 0.0) all

(* A fraction near the middle of a range. *)
let middle range =
  let width = Fixed.half_width range in
  let bits = 32 + max 0 (int_of_float (Float.ceil (-.Float.log2 width))) in
  { qnum = Z.shift_right (Fixed.middle (bits + 64) range) 64; qden = Z.shift_left Z.one bits }

(* The interval that is bisected: the one with the largest effect. *)
let widest document =
  List.fold_left (fun found (datum, range, effect) -> match found with
    | Some (_, _, most) when most >= effect -> found
    | _ -> Some (datum, range, effect)) None (intervals document)

type found = Pieces of pieces | Refused of string

let no_next = "outcome.until: the next event is not found"

let attempt document =
  match Rests.of_document document with
  | exception Flights.Lost n -> Refused (Printf.sprintf "events[%d]: no such event is found there" n)
  (* A radius that is not finite. *)
  | exception Z.Overflow -> Refused "the data are intervals too wide for boxes around the impacts"
  | None -> Refused no_next
  | Some hint -> Pieces (Whole hint)

let pieces document =
  let attempts = ref 0 in
  let rec look depth document =
    incr attempts;
    match attempt document with
    | Pieces (Whole hint) as found when Shifting.Each.verify document hint -> found
    | found ->
      match widest document with
      | Some (datum, range, _) when depth > 0 && !attempts < most_attempts ->
        let q = middle range in
        (match look (depth - 1) (part datum (below q) document) with
         | Refused _ as refused -> refused
         | Pieces lower ->
           match look (depth - 1) (part datum (above q) document) with
           | Refused _ as refused -> refused
           | Pieces upper -> Pieces (Cut (datum, q, lower, upper)))
      | _ -> match found with Pieces (Whole hint) -> Refused (Reason.why document hint) | _ -> found in
  if widest document = None then attempt document else look deepest document
