(* Separated sets: where words from h-sets have a vector v with v b <= the sum of v (into) / q ^ weight over the words from b, there are c q^n states of which
   any two part after words of a total weight less than n. *)
From Coq Require Import Reals Lra Lia List Arith.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Horseshoe Covers Shift.
Import ListNotations.
Open Scope R_scope.

(* The sum of f over a list; the weight of the first n letters of a sequence. *)
Definition sum_over (f : nat -> R) (l : list nat) : R := fold_right (fun i r => f i + r) 0 l.
Fixpoint spent (weight : nat -> nat) (s : nat -> nat) (n : nat) : nat := match n with O => O | S n => (spent weight s n + weight (s n))%nat end.

Section Count.
Variables (base : nat -> frame) (words : list step_of).
Variables (weight : nat -> nat) (live : nat -> bool) (q : R) (v : nat -> R).
(* The words from an h-set. *)
Definition words_from (b : nat) : list nat := filter (fun i => (from_set (word_of words i) =? b)%nat) (seq 0 (length words)).
Record growth : Prop := {
  growth_weight : forall i, (i < length words)%nat -> (1 <= weight i)%nat;
  growth_factor : 1 <= q;
  growth_live : forall b, live b = true -> 0 < v b;
  growth_dead : forall b, live b = false -> v b = 0;
  growth_sum : forall b, live b = true -> v b <= sum_over (fun i => v (into_set (word_of words i)) / q ^ weight i) (words_from b) }.

(* Sequences: c q^n of them from b, any two of which part after j words, of a weight less than n. *)
Theorem many_sequences b : growth -> live b = true -> exists c, 0 < c /\ forall n, exists (m : nat) (s : nat -> nat -> nat), c * q ^ n <= INR m /\
  (forall i, (i < m)%nat -> fits words (s i) /\ from_set (word_of words (s i 0%nat)) = b) /\
  (forall i i', (i < m)%nat -> (i' < m)%nat -> i <> i' -> exists j, (forall k, (k < j)%nat -> s i k = s i' k) /\ s i j <> s i' j /\ (spent weight (s i) j < n)%nat).
Admitted.

(* Two states that obey sequences of words which part after j words of weight less than n, at a distance then. *)
Definition separated (delta eps : R) (n : nat) (x y : state) : Prop := exists s t j,
  fits words s /\ fits words t /\ obeys base words s x /\ obeys base words t y /\
  (forall k, (k < j)%nat -> s k = t k) /\ s j <> t j /\ (spent weight s j < n)%nat /\
  let N := base (from_set (word_of words (s j))) in from_set (word_of words (s j)) = from_set (word_of words (t j)) /\
    in_frame N (after words s j x) /\ in_frame N (after words t j y) /\
    delta <= Rabs (along N (after words s j x) - along N (after words t j y)) /\
    (eps <= Rabs (fst (after words s j x) - fst (after words t j y)) \/ eps <= Rabs (snd (after words s j x) - snd (after words t j y))).

End Count.

(* How far they are apart then depends on the words only, not on how they are weighed. *)
Theorem many_states base words : words_cover base words -> words_apart words -> exists delta eps, 0 < delta /\ 0 < eps /\
  forall weight live q v b, growth words weight live q v -> live b = true -> exists c, 0 < c /\ forall n, exists L : list state, c * q ^ n <= INR (length L) /\
    (forall x, In x L -> in_frame (base b) x /\ exists s, fits words s /\ from_set (word_of words (s 0%nat)) = b /\ obeys base words s x) /\
    (forall i i', (i < length L)%nat -> (i' < length L)%nat -> i <> i' -> separated base words weight delta eps n (nth i L (0, 0)) (nth i' L (0, 0))).
Admitted.
