(* The axioms of the theorems of the extracted checker. *)
From ImpactPair Require Import Carrier.
Print Assumptions Carrier.Shifting.pieces_verified.
Print Assumptions Carrier.Shadowing.shadow_verified.
Print Assumptions Carrier.Drawing.cycles_verified.
Print Assumptions Carrier.attracted_verified.
Print Assumptions Carrier.region_verified.
Print Assumptions Carrier.chaos_verified.
