(* Finitely many words between h-sets, each of whose maps carries its slice across the h-set it leads into: every sequence of words that fit together
   is followed by a state, and states that follow two sequences are a distance apart where these part. *)
From Coq Require Import Reals Lra Lia List Arith.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Horseshoe Covers.
Import ListNotations.
Open Scope R_scope.

(* A word leads from an h-set to another, both given by their numbers; its map is defined on the slice from lower to upper of the first one. *)
Record step_of := Step { from_set : nat; into_set : nat; lower : R; upper : R; over : R; move : state -> state }.
Definition nowhere : step_of := Step 0 0 0 0 1 (fun x => x).

Section Words.
Variables (base : nat -> frame) (words : list step_of).

(* Letters are positions in the list of words. *)
Definition word_of (i : nat) : step_of := nth i words nowhere.
Definition in_slice (i : nat) : state -> Prop := slice (base (from_set (word_of i))) (lower (word_of i)) (upper (word_of i)).
(* Words that fit together; where they take a state; and the states that follow them. *)
Definition fits (s : nat -> nat) : Prop := forall n, (s n < length words)%nat /\ into_set (word_of (s n)) = from_set (word_of (s (S n))).
Definition after (s : nat -> nat) (n : nat) (x : state) : state := visit (fun k => move (word_of (s k))) n x.
Definition obeys (s : nat -> nat) (x : state) : Prop :=
  forall n, in_slice (s n) (after s n x) /\ in_frame (base (into_set (word_of (s n)))) (after s (S n) x).

(* What has to be known of the words; and that different words from an h-set have disjoint slices. *)
Record words_cover : Prop := {
  words_area : forall w, In w words -> area (base (from_set w)) <> 0;
  words_covers : forall w, In w words -> covers (base (from_set w)) (base (into_set w)) (lower w) (upper w) (over w) (move w) }.
Definition words_apart : Prop := forall i j, (i < length words)%nat -> (j < length words)%nat -> i <> j -> from_set (word_of i) = from_set (word_of j) ->
  upper (word_of i) < lower (word_of j) \/ upper (word_of j) < lower (word_of i).

Hypothesis cover : words_cover.

Theorem every_sequence_obeyed s : fits s -> exists x, obeys s x.
Admitted.

(* Two sequences that part after j words, and two states that obey them. *)
Theorem told_apart : words_apart -> exists delta eps, 0 < delta /\ 0 < eps /\ forall s t j x y, fits s -> fits t -> obeys s x -> obeys t y ->
  from_set (word_of (s 0%nat)) = from_set (word_of (t 0%nat)) -> (forall k, (k < j)%nat -> s k = t k) -> s j <> t j ->
  let N := base (from_set (word_of (s j))) in from_set (word_of (s j)) = from_set (word_of (t j)) /\ in_frame N (after s j x) /\ in_frame N (after t j y) /\
    delta <= Rabs (along N (after s j x) - along N (after t j y)) /\
    (eps <= Rabs (fst (after s j x) - fst (after t j y)) \/ eps <= Rabs (snd (after s j x) - snd (after t j y))).
Admitted.

(* Blocks: h-sets from each of which a word of each of two letters leads to one of them. Every sequence of letters is that of a sequence of words, found by search. *)
Section Block.
Variables (block : nat -> bool) (letter : nat -> bool).
Definition spelled (b : nat) (a : bool) : nat :=
  hd 0%nat (filter (fun i => (from_set (word_of i) =? b)%nat && block (into_set (word_of i)) && Bool.eqb (letter i) a) (seq 0 (length words))).
Fixpoint place (b : nat) (letters : nat -> bool) (n : nat) : nat :=
  match n with O => b | S n => into_set (word_of (spelled (place b letters n) (letters n))) end.
Definition spelling (b : nat) (letters : nat -> bool) (n : nat) : nat := spelled (place b letters n) (letters n).
Hypothesis both_letters : forall b a, block b = true -> exists i, (i < length words)%nat /\ from_set (word_of i) = b /\ block (into_set (word_of i)) = true /\ letter i = a.
Theorem every_spelling b letters : block b = true -> fits (spelling b letters) /\ from_set (word_of (spelling b letters 0)) = b /\
  forall n, letter (spelling b letters n) = letters n /\ block (from_set (word_of (spelling b letters n))) = true.
Admitted.
End Block.
End Words.
