(* What the extracted checker's theorem rests on. *)
From ImpactPair Require Import Carrier.
Print Assumptions Carrier.Shifting.pieces_verified.
