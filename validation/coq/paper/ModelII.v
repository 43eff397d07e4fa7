(* Model II, P3 alone with one impact per N cycles, (25), (36): such an orbit has no velocity at impact. So v > 0 is
   impossible, whatever A, W, d, N and 0 <= e; and the same on the other wall (P4). *)
From Coq Require Import Reals Lra List.
From ImpactPair Require Import Model.
Open Scope R_scope.
Import ListNotations.

Theorem model_II s (i : impact) (N : nat) : others s = [] -> 0 < W s -> 0 <= e s ->
  next s i {| wall_of := wall_of i; time := time i + INR N * period s; velocity := velocity i |} -> velocity i = 0.
Proof.
  intros one w b (_ & _ & v). rewrite one_velocity in v by exact one. cbn [rebound speed since time velocity] in v.
  replace (phase s (time i + INR N * period s)) with (phase s (time i) + 2 * INR N * PI) in v.
  2:{ unfold phase, period. field. lra. }
  rewrite cos_period in v. nra.
Qed.
