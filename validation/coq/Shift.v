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

(* The conditions on the words; and that different words from an h-set have disjoint slices. *)
Record words_cover : Prop := {
  words_area : forall w, In w words -> area (base (from_set w)) <> 0;
  words_covers : forall w, In w words -> covers (base (from_set w)) (base (into_set w)) (lower w) (upper w) (over w) (move w) }.
Definition words_apart : Prop := forall i j, (i < length words)%nat -> (j < length words)%nat -> i <> j -> from_set (word_of i) = from_set (word_of j) ->
  upper (word_of i) < lower (word_of j) \/ upper (word_of j) < lower (word_of i).

Hypothesis cover : words_cover.

Lemma word_in i : (i < length words)%nat -> In (word_of i) words.
Proof. apply nth_In. Qed.
Lemma carried_word i : (i < length words)%nat -> carries (base (from_set (word_of i))) (base (into_set (word_of i)))
  (fun x => in_slice i x /\ in_frame (base (into_set (word_of i))) (move (word_of i) x)) (move (word_of i)).
Proof. intros h. apply covers_carries with (over (word_of i)). apply (words_covers cover), word_in, h. Qed.
Lemma slice_in_frame i x : (i < length words)%nat -> in_slice i x -> in_frame (base (from_set (word_of i))) x.
Proof. intros h [a b]. destruct (words_covers cover _ (word_in i h)) as [l _ u _ _ _ _ _]. split; [lra|exact b]. Qed.

(* Sequences. *)
Theorem every_sequence_obeyed s : fits s -> exists x, obeys s x.
Proof.
  intros h. set (N := fun n => base (from_set (word_of (s n)))).
  set (S := fun n x => in_slice (s n) x /\ in_frame (N (Datatypes.S n)) (move (word_of (s n)) x)).
  assert (carried : forall n, carries (N n) (N (Datatypes.S n)) (S n) (move (word_of (s n)))).
  { intros n. destruct (h n) as [i e]. unfold S, N. rewrite <- e. exact (carried_word _ i). }
  assert (path : crosses (N O) (fun t => put (N O) t 0) (-1) 1).
  { apply crosses_at; [|lra]. apply (words_area cover), word_in, h. }
  destruct (followed N S _ carried _ _ _ path) as (t & _ & f). exists (put (N O) t 0). intros n. destruct (f n) as [a b].
  split; [exact a|]. destruct (h n) as [_ ->]. exact b.
Qed.

(* The same words lead to the same states. *)
Lemma after_same s t n x : (forall k, (k < n)%nat -> s k = t k) -> after s n x = after t n x.
Proof.
  unfold after. induction n as [|n IH]; intros same; [reflexivity|]. cbn [visit]. rewrite IH by (intros k hk; apply same; lia). rewrite same by lia. reflexivity.
Qed.

(* A positive number small enough for finitely many. *)
Lemma small_enough (P : nat -> R -> Prop) n : (forall i d e, P i d -> e <= d -> P i e) -> (forall i, (i < n)%nat -> exists d, 0 < d /\ P i d) ->
  exists d, 0 < d /\ forall i, (i < n)%nat -> P i d.
Proof.
  intros smaller. induction n as [|n IH]; intros each; [exists 1; split; [lra|lia]|].
  destruct IH as (d & d0 & all); [intros i hi; apply each; lia|]. destruct (each n) as (e & e0 & last); [lia|].
  exists (Rmin d e). split; [apply Rmin_glb_lt; assumption|]. intros i hi. destruct (Nat.eq_dec i n) as [->|ne].
  - apply smaller with (1 := last), Rmin_r.
  - apply smaller with (1 := all i ltac:(lia)), Rmin_l.
Qed.
(* States apart along an h-set are so in the plane. *)
Lemma apart_in_plane N delta : area N <> 0 -> 0 < delta -> exists eps, 0 < eps /\ forall x y, delta <= Rabs (along N x - along N y) ->
  eps <= Rabs (fst x - fst y) \/ eps <= Rabs (snd x - snd y).
Proof.
  intros h d0. set (a := Rabs (snd (wide N) / area N)). set (b := Rabs (fst (wide N) / area N)).
  assert (a0 : 0 <= a) by apply Rabs_pos. assert (b0 : 0 <= b) by apply Rabs_pos.
  assert (e0 : 0 < delta / (a + b + 1)) by (apply Rdiv_lt_0_compat; lra). exists (delta / (a + b + 1)). split; [exact e0|]. intros x y far.
  set (eps := delta / (a + b + 1)) in *. assert (e : eps * (a + b + 1) = delta) by (unfold eps; field; lra).
  destruct (Rle_lt_dec eps (Rabs (fst x - fst y))) as [l|near]; [left; exact l|right]. apply Rnot_lt_le. intros near'.
  replace (along N x - along N y) with (snd (wide N) / area N * (fst x - fst y) - fst (wide N) / area N * (snd x - snd y)) in far
    by (unfold along, along_area; field; exact h).
  assert (t := Rabs_triang (snd (wide N) / area N * (fst x - fst y)) (- (fst (wide N) / area N * (snd x - snd y)))).
  rewrite Rabs_Ropp, !Rabs_mult in t. fold a b in t. unfold Rminus at 1 in far.
  assert (a * Rabs (fst x - fst y) <= a * eps) by (apply Rmult_le_compat_l; lra).
  assert (b * Rabs (snd x - snd y) <= b * eps) by (apply Rmult_le_compat_l; lra). lra.
Qed.

(* Two sequences that part after j words, and two states that obey them. *)
Theorem told_apart : words_apart -> exists delta eps, 0 < delta /\ 0 < eps /\ forall s t j x y, fits s -> fits t -> obeys s x -> obeys t y ->
  from_set (word_of (s 0%nat)) = from_set (word_of (t 0%nat)) -> (forall k, (k < j)%nat -> s k = t k) -> s j <> t j ->
  let N := base (from_set (word_of (s j))) in from_set (word_of (s j)) = from_set (word_of (t j)) /\ in_frame N (after s j x) /\ in_frame N (after t j y) /\
    delta <= Rabs (along N (after s j x) - along N (after t j y)) /\
    (eps <= Rabs (fst (after s j x) - fst (after t j y)) \/ eps <= Rabs (snd (after s j x) - snd (after t j y))).
Proof.
  intros disjoint.
  destruct (small_enough (fun i d => forall j, (j < length words)%nat -> i <> j -> from_set (word_of i) = from_set (word_of j) ->
    d <= lower (word_of j) - upper (word_of i) \/ d <= lower (word_of i) - upper (word_of j)) (length words)) as (delta & d0 & gap).
  { intros i d e h le j hj n same. destruct (h j hj n same); lra. }
  { intros i hi. destruct (small_enough (fun j d => i <> j -> from_set (word_of i) = from_set (word_of j) ->
      d <= lower (word_of j) - upper (word_of i) \/ d <= lower (word_of i) - upper (word_of j)) (length words)) as (d & d0 & h).
    - intros j d e h le n same. destruct (h n same); lra.
    - intros j hj. destruct (Rlt_le_dec (upper (word_of i)) (lower (word_of j))) as [l|l]; [exists (lower (word_of j) - upper (word_of i)); split; [lra|auto with real]|].
      destruct (Rlt_le_dec (upper (word_of j)) (lower (word_of i))) as [l'|l']; [exists (lower (word_of i) - upper (word_of j)); split; [lra|auto with real]|].
      exists 1. split; [lra|]. intros n same. destruct (disjoint i j hi hj n same); lra.
    - exists d. split; [exact d0|]. intros j hj. exact (h j hj). }
  destruct (small_enough (fun i e => forall x y, let N := base (from_set (word_of i)) in delta <= Rabs (along N x - along N y) ->
    e <= Rabs (fst x - fst y) \/ e <= Rabs (snd x - snd y)) (length words)) as (eps & e0 & far).
  { intros i d e h le x y N a. destruct (h x y a); [left|right]; lra. }
  { intros i hi. apply apart_in_plane; [apply (words_area cover), word_in, hi|exact d0]. }
  exists delta, eps. split; [exact d0|]. split; [exact e0|]. intros s t j x y fs ft ox oy start same part N.
  assert (at_j : from_set (word_of (s j)) = from_set (word_of (t j))).
  { destruct j as [|j]; [exact start|]. rewrite <- (proj2 (fs j)), <- (proj2 (ft j)), same by lia. reflexivity. }
  assert (sx := proj1 (ox j)). assert (sy := proj1 (oy j)). split; [exact at_j|].
  split; [apply slice_in_frame with (2 := sx), fs|]. split; [unfold N; rewrite at_j; apply slice_in_frame with (2 := sy), ft|].
  assert (d : delta <= Rabs (along N (after s j x) - along N (after t j y))).
  { destruct sx as [sx _], sy as [sy _]. rewrite <- at_j in sy. fold N in sx, sy.
    destruct (gap _ (proj1 (fs j)) (t j) (proj1 (ft j)) part at_j) as [g|g]; [rewrite Rabs_minus_sym|]; apply Rle_trans with (2 := Rle_abs _); lra. }
  split; [exact d|]. exact (far _ (proj1 (fs j)) _ _ d).
Qed.

End Words.
