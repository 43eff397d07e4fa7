(* States between two phases, with enclosures of their speeds: that they are in boxes of a region (`in_columns`), with the proof. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Data Certificate Document Region.
Open Scope R_scope.
Import ListNotations.

(* Bits; points of the grid; the shortest and the longest flight, in its units; a part of the march is a box's width over `parts` at least; how often a box is halved. *)
Record plan := Plan { plan_bits : positive; fine : positive; shortest : Z; longest : Z; parts : Z; halvings : nat }.

Module Columns (F : FloatOps with Definition sensible_format := true).
Module Import Ver := Verifier F.
Import Ver.Check.
Local Opaque add sub mul quotient whole hull.

Section Region.
Variables (r : region) (h : plan).
Let p := plan_bits h.

(* Speeds, in rows, in a run of boxes: two enclosures of one speed, which is not negative. *)
Definition in_run (V V' : I.type) (first last : Z) : bool :=
  let over X := is_not_negative (sub p X (whole p first)) in let under X := is_not_negative (sub p (whole p (last + 1)) X) in
  (if (first =? 0)%Z then true else if over V then true else over V') &? (if under V then true else under V').
Definition in_column (V V' : I.type) (column : Z) : bool :=
  let c := (column mod Zpos (columns r))%Z in
  existsb (fun run : Z * (Z * Z) => let (at_, rows) := run in (at_ =? c)%Z &? in_run V V' (fst rows) (snd rows)) (runs r).
Fixpoint in_columns (n : nat) (V V' : I.type) (column until : Z) : bool :=
  in_column V V' column &? (if (until <=? (column + 1) * Zpos (2 * fine h))%Z then true else match n with O => false | S n => in_columns n V V' (column + 1) until end).
Definition most_columns : nat := 64.

Lemma in_run_sound V V' x first last : in_run V V' first last = true -> 0 <= x -> holds V x -> holds V' x -> IZR first <= x <= IZR last + 1.
Proof.
  unfold in_run. intros c pos hV hV'.
  assert (over : forall X, holds X x -> is_not_negative (sub p X (whole p first)) = true -> IZR first <= x).
  { intros X hX k. assert (0 <= x - IZR first) by (apply (is_not_negative_sound _ _ k); enclose). lra. }
  assert (under : forall X, holds X x -> is_not_negative (sub p (whole p (last + 1)) X) = true -> x <= IZR last + 1).
  { intros X hX k. assert (0 <= IZR (last + 1) - x) by (apply (is_not_negative_sound _ _ k); enclose). rewrite plus_IZR in H. lra. }
  split_checks. split.
  - destruct (first =? 0)%Z eqn:zero; [apply Z.eqb_eq in zero; subst; exact pos|].
    destruct (is_not_negative (sub p V (whole p first))) eqn:o; [exact (over V hV o)|exact (over V' hV' k)].
  - destruct (is_not_negative (sub p (whole p (last + 1)) V)) eqn:o; [exact (under V hV o)|exact (under V' hV' c)].
Qed.
Lemma in_column_sound V V' column th v : in_column V V' column = true -> 0 <= v -> holds V (v * IZR (Zpos (rows r))) -> holds V' (v * IZR (Zpos (rows r))) ->
  IZR column <= th / (2 * PI) * IZR (Zpos (columns r)) <= IZR column + 1 -> in_boxes r th v.
Proof.
  unfold in_column. intros c pos hV hV' o. apply existsb_exists in c as ((at_ & first & last) & member & c). cbn [fst snd] in c. split_checks. apply Z.eqb_eq in k.
  exists at_, first, last, (column / Zpos (columns r))%Z. split; [exact member|]. split.
  - assert (e := Z.div_mod column (Zpos (columns r)) ltac:(lia)). rewrite <- k in e. rewrite e in o. rewrite plus_IZR, mult_IZR in o. lra.
  - apply (in_run_sound V V'); try assumption. apply Rmult_le_pos; [exact pos|apply IZR_le; lia].
Qed.
Lemma in_columns_sound n V V' until y : forall column, in_columns n V V' column until = true -> IZR column <= y -> y * IZR (Zpos (2 * fine h)) <= IZR until ->
  exists c, in_column V V' c = true /\ IZR c <= y <= IZR c + 1.
Proof.
  induction n as [|n IH]; intros column c o o'; cbn [in_columns] in c; split_checks.
  all: destruct (until <=? (column + 1) * Zpos (2 * fine h))%Z eqn:ends; [|try discriminate].
  1, 2: exists column; split; [exact k|split; [exact o|]]; apply Z.leb_le, IZR_le in ends; rewrite mult_IZR, plus_IZR in ends;
    apply (Rmult_le_reg_r (IZR (Zpos (2 * fine h)))); [apply IZR_lt; lia|lra].
  destruct (Rle_lt_dec y (IZR column + 1)) as [l|g]; [exists column; repeat split; assumption|].
  apply (IH _ c); [rewrite plus_IZR; lra|exact o'].
Qed.
End Region.
End Columns.
