(* Documents of words: h-sets, and words from one to another with their strips; a program `check_words` that checks them, and the proof that it is right. *)
From Coq Require Import Reals Lra List ZArith Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Horseshoe Return Certificate Covering Covers Cycle Reduced Strips.
Open Scope R_scope.
Import ListNotations.

(* A word: the h-sets that it leads from and into, by their numbers in the list, from 0 on; its flights; and its strip. *)
Record word_entry := Word { from_set : nat; into_set : nat; strides : list stride; strip_of : strip }.
(* The bits of the arithmetic, and the grid 2^-grid_bits. *)
Record words_document := Words { word_bits : positive; grid_bits : positive; sets : list chart; entries : list word_entry }.

(* Strips from one h-set do not touch. *)
Definition strips_apart (v w : word_entry) : bool :=
  if (from_set v =? from_set w)%nat then ((ends_at (strip_of v) <? begins_at (strip_of w)) || (ends_at (strip_of w) <? begins_at (strip_of v)))%Z else true.
Fixpoint all_apart (words : list word_entry) : bool :=
  match words with [] => true | v :: words => forallb (strips_apart v) words && all_apart words end.
(* An h-set is a parallelogram, turned so that its area is positive, and its phases differ by less than half a forcing period. *)
Definition check_set (q : positive) (N : chart) : bool :=
  ((0 <? chart_area N) && (2 * (Z.abs (lu N) + Z.abs (wu N)) <=? 3 * 2 ^ Zpos q))%Z.

(* The statement of the document about a scene. *)
Definition set_number (x : words_document) (n : nat) (N : chart) : Prop := nth_error (sets x) n = Some N.
Definition is_set (q : positive) (N : chart) : Prop := 0 < area (frame_of q N) /\
  forall y z, in_frame (frame_of q N) y -> in_frame (frame_of q N) z -> Rabs (fst y - fst z) <= 3.
(* The starts of a word in its first h-set. *)
Definition starts_of (q : positive) (N : chart) (w : word_entry) : state -> Prop :=
  slice (frame_of q N) (grid q (begins_at (strip_of w))) (grid q (ends_at (strip_of w))).
Definition sign_of (w : word_entry) : R := if backwards (strip_of w) then -1 else 1.
Definition word_covers (s : scene) (x : words_document) (w : word_entry) : Prop :=
  exists N M, let q := grid_bits x in set_number x (from_set w) N /\ set_number x (into_set w) M /\
    covers (frame_of q N) (frame_of q M) (grid q (begins_at (strip_of w))) (grid q (ends_at (strip_of w))) (sign_of w) (walk s (strides w)) /\
    strides w <> [] /\ forall y, starts_of q N w y -> walks s (strides w) y.
Record words_hold (s : scene) (x : words_document) : Prop := {
  words_positive : 0 < A s /\ 0 < W s /\ 0 < d s;
  words_one : one_harmonic s;
  words_sets : forall n N, set_number x n N -> is_set (grid_bits x) N;
  words_cover : forall w, In w (entries x) -> word_covers s x w;
  words_apart : forall i j v w, nth_error (entries x) i = Some v -> nth_error (entries x) j = Some w -> i <> j -> from_set v = from_set w ->
    forall N y, ~ (starts_of (grid_bits x) N v y /\ starts_of (grid_bits x) N w y) }.

Lemma strips_apart_sound q v w N y : strips_apart v w = true -> from_set v = from_set w -> ~ (starts_of q N v y /\ starts_of q N w y).
Proof.
  unfold strips_apart, starts_of, slice. intros h e [[h1 _] [h2 _]]. apply Nat.eqb_eq in e. rewrite e in h.
  assert (less : forall m n, (m < n)%Z -> grid q m < grid q n) by (intros m n o; apply Rmult_lt_compat_l; [apply grid_step|apply IZR_lt, o]).
  apply orb_prop in h as [h|h]; apply Z.ltb_lt, less in h; lra.
Qed.
Lemma all_apart_sound q (ws : list word_entry) : all_apart ws = true -> forall i j v w, (i < j)%nat -> nth_error ws i = Some v -> nth_error ws j = Some w ->
  from_set v = from_set w -> forall N y, ~ (starts_of q N v y /\ starts_of q N w y).
Proof.
  induction ws as [|u ws IH]; intros h i j v w o; [destruct i; discriminate|]. cbn [all_apart] in h. apply andb_prop in h as [first rest].
  destruct j as [|j]; [lia|]. destruct i as [|i]; cbn [nth_error].
  - intros [= <-] hj e N y. rewrite forallb_forall in first. exact (strips_apart_sound q _ _ N y (first w (nth_error_In _ _ hj)) e).
  - apply (IH rest); lia.
Qed.
Lemma check_set_sound q N : check_set q N = true -> is_set q N.
Proof.
  unfold check_set. intros h. apply andb_prop in h as [h w]. apply Z.ltb_lt in h. apply Z.leb_le in w.
  split; [exact (chart_area_positive q N h)|]. intros y z hy hz.
  destruct (chart_bounds q N y h hy) as [by_ _]. destruct (chart_bounds q N z h hz) as [bz _].
  apply grid_at_most in w. replace (fst y - fst z) with ((fst y - grid q (cu N)) - (fst z - grid q (cu N))) by ring.
  apply Rabs_le_between in by_, bz. apply Rabs_le. lra.
Qed.

Module Documents (F : FloatOps with Definition sensible_format := true).
Module Import Each := Strips F.

(* Amplitude, frequency and gap are positive. *)
Definition check_scene (p : positive) (param : data) : bool :=
  match further param with [] => true | _ => false end &&
  is_positive (enclose_range p (amplitude param)) && is_positive (enclose_range p (frequency param)) && is_positive (enclose_range p (gap param)).
Definition check_word (p q : positive) (param : data) (sets : list chart) (w : word_entry) : bool :=
  match nth_error sets (from_set w), nth_error sets (into_set w) with
  | Some N, Some M => check_strip p q param (strides w) N M (strip_of w)
  | _, _ => false
  end.
Definition check_words (param : data) (x : words_document) : bool :=
  check_scene (word_bits x) param && forallb (check_set (grid_bits x)) (sets x) && all_apart (entries x) &&
  forallb (check_word (word_bits x) (grid_bits x) param (sets x)) (entries x).

Theorem words_verified param x : check_words param x = true -> forall s, describes param s -> words_hold s x.
Proof.
  unfold check_words, check_scene. intros h s described. set (p := word_bits x) in *. set (q := grid_bits x) in *.
  apply andb_prop in h as [h covering]. apply andb_prop in h as [h distinct]. apply andb_prop in h as [h parallelograms].
  apply andb_prop in h as [h gap_]. apply andb_prop in h as [h frequency_]. apply andb_prop in h as [one_ amplitude_].
  pose proof described as ((hA & hW & _) & rest & hd & _).
  assert (A_positive : 0 < A s) by exact (is_positive_sound _ _ amplitude_ (holds_range p _ _ hA)).
  assert (W_positive : 0 < W s) by exact (is_positive_sound _ _ frequency_ (holds_range p _ _ hW)).
  assert (gap_positive : 0 < d s) by exact (is_positive_sound _ _ gap_ (holds_range p _ _ hd)).
  rewrite forallb_forall in parallelograms, covering. split.
  - auto.
  - unfold one_harmonic. destruct (further param); [inversion rest; reflexivity|discriminate].
  - intros n N at_n. apply check_set_sound, parallelograms. exact (nth_error_In _ _ at_n).
  - intros w listed. specialize (covering w listed). unfold check_word in covering.
    destruct (nth_error (sets x) (from_set w)) as [N|] eqn:eN; [|discriminate]. destruct (nth_error (sets x) (into_set w)) as [M|] eqn:eM; [|discriminate].
    exists N, M. cbv zeta. split; [exact eN|]. split; [exact eM|].
    destruct (strip_sound p q param s described A_positive W_positive gap_positive _ _ _ _ covering) as [carried flying].
    split; [exact carried|]. split; [|exact flying]. intros none. rewrite none in covering. exact (no_flights p q param N M (strip_of w) covering).
  - intros i j v w hi hj ne e N y. assert (o : (i < j \/ j < i)%nat) by lia. destruct o as [o|o].
    + exact (all_apart_sound q _ distinct i j v w o hi hj e N y).
    + intros [a b]. exact (all_apart_sound q _ distinct j i w v o hj hi (eq_sym e) N y (conj b a)).
Qed.
End Documents.

Module PlainDocuments := Documents PlainFloats.
