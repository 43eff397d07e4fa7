(* Two-sided sequences: every sequence of words that fit together, from minus infinity to infinity, is that of an orbit. *)
From Coq Require Import Reals Lra Lia List ZArith.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Horseshoe Covers Shift.
Open Scope R_scope.

Section Both_ways.
Variables (base : nat -> frame) (words : list step_of).
Definition fits_both_ways (s : Z -> nat) : Prop := forall n, (s n < length words)%nat /\ into_set (word_of words (s n)) = from_set (word_of words (s (n + 1)%Z)).
Theorem every_orbit s : words_cover base words -> fits_both_ways s ->
  exists x : Z -> state, forall n, in_slice base words (s n) (x n) /\ x (n + 1)%Z = move (word_of words (s n)) (x n).
Admitted.
End Both_ways.
