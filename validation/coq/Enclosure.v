(* Enclosures of numbers: exact data, numbers of the grid n 2^-scale, and the arithmetic of Coq Interval on floats F of
   any size, with sine and cosine after quarter periods. `holds X x`: the interval X contains x. *)
From Coq Require Import Reals Lra ZArith QArith Qreals Bool Lia.
From Interval Require Import Real.Xreal Interval.Interval Interval.Float_full Float.Basic Float.Sig.
From Flocq Require Zaux.
From ImpactPair Require Import Model.
Open Scope R_scope.

(* Exact data: expressions in rationals and pi, as a scene may have them. *)
Inductive number :=
  | Rational (q : Q) | Pi | Plus (a b : number) | Minus (a b : number) | Times (a b : number) | Over (a b : number)
  | Root (a : number) | Sine (a : number) | Cosine (a : number).
Fixpoint value (n : number) : R :=
  match n with
  | Rational q => Q2R q | Pi => PI | Plus a b => value a + value b | Minus a b => value a - value b
  | Times a b => value a * value b | Over a b => value a / value b
  | Root a => sqrt (value a) | Sine a => sin (value a) | Cosine a => cos (value a)
  end.
(* One value, or an interval of values. *)
Record range := Between { least : number; most : number }.
Definition Exactly (n : number) : range := Between n n.
Definition among (r : range) (x : R) : Prop := value (least r) <= x <= value (most r).

Definition grid (q : positive) (n : Z) : R := / IZR (2 ^ Zpos q) * IZR n.

Lemma grid_step q : 0 < / IZR (2 ^ Zpos q).
Proof. apply Rinv_0_lt_compat, IZR_lt. apply Z.pow_pos_nonneg; lia. Qed.
Lemma grid_le q a b : (a <= b)%Z -> grid q a <= grid q b.
Proof. intros h. apply IZR_le in h. apply Rmult_le_compat_l; [left; apply grid_step|exact h]. Qed.

(* Some whole number of quarter periods near n units of the grid; any would do. *)
Definition turns (q : positive) (n : Z) : Z := ((n * 452 + 355 * 2 ^ Zpos q) / (710 * 2 ^ Zpos q))%Z.

Module Enclosure (F : FloatOps with Definition sensible_format := true).
Module I := FloatIntervalFull F.

Definition holds (X : I.type) (x : R) : Prop := contains (I.convert X) (Xreal x).

Section Arithmetic.
Variable p : positive.
Let prec := F.PtoP p.

Definition add := I.add prec.
Definition sub := I.sub prec.
Definition mul := I.mul prec.
Definition quotient := I.div prec.
Definition whole := I.fromZ prec.
Definition hull (X Y : I.type) : I.type := I.join X Y.

Lemma holds_add X Y x y : holds X x -> holds Y y -> holds (add X Y) (x + y).
Proof. exact (I.add_correct prec X Y (Xreal x) (Xreal y)). Qed.
Lemma holds_sub X Y x y : holds X x -> holds Y y -> holds (sub X Y) (x - y).
Proof. exact (I.sub_correct prec X Y (Xreal x) (Xreal y)). Qed.
Lemma holds_mul X Y x y : holds X x -> holds Y y -> holds (mul X Y) (x * y).
Proof. exact (I.mul_correct prec X Y (Xreal x) (Xreal y)). Qed.
Lemma holds_neg X x : holds X x -> holds (I.neg X) (- x).
Proof. exact (I.neg_correct X (Xreal x)). Qed.
Lemma holds_whole n : holds (whole n) (IZR n).
Proof. apply I.fromZ_correct. Qed.
Lemma nowhere X x : contains (I.convert X) Xnan -> holds X x.
Proof. unfold holds. destruct (I.convert X); cbn; [intros _; exact I|intros []]. Qed.
Lemma holds_quotient X Y x y : holds X x -> holds Y y -> holds (quotient X Y) (x / y).
Proof.
  intros hx hy. assert (h := I.div_correct prec X Y (Xreal x) (Xreal y) hx hy). cbn in h. unfold Xdiv' in h.
  destruct (is_zero y); [apply nowhere|]; exact h.
Qed.
Lemma holds_hull X Y a b x : holds X a -> holds Y b -> a <= x <= b -> holds (hull X Y) x.
Proof.
  intros ha hb r. refine (contains_connected (I.convert (hull X Y)) a b _ _ x r); apply I.join_correct; [left|right]; assumption.
Qed.
Lemma holds_between X a b c : holds X a -> holds X b -> Rmin a b <= c <= Rmax a b -> holds X c.
Proof.
  intros ha hb r. destruct (Rle_lt_dec a b).
  - rewrite Rmin_left, Rmax_right in r by lra. exact (contains_connected (I.convert X) a b ha hb c r).
  - rewrite Rmin_right, Rmax_left in r by lra. exact (contains_connected (I.convert X) b a hb ha c r).
Qed.

(* Sine and cosine after k quarter periods are taken off: near 0, Interval's own lose no digits. *)
Definition half_pi := quotient (I.pi prec) (whole 2).
Definition reduced (k : Z) (X : I.type) := sub X (mul (whole k) half_pi).
Definition quarters (k : Z) (X : I.type) : I.type :=
  match (k mod 4)%Z with 0%Z => I.sin prec X | 1%Z => I.cos prec X | 2%Z => I.neg (I.sin prec X) | _ => I.neg (I.cos prec X) end.
Definition sine (k : Z) (X : I.type) : I.type := quarters k (reduced k X).
Definition cosine (k : Z) (X : I.type) : I.type := quarters (k + 1) (reduced k X).
(* The same near the middle of an interval. *)
Definition turns_in (X : I.type) : Z :=
  match F.toF (I.midpoint (quotient X half_pi)) with
  | Float negative m e =>
    let twice := if (e <? 0)%Z then (2 * Zpos m / Zaux.radix_val F.radix ^ (- e))%Z else (2 * Zpos m * Zaux.radix_val F.radix ^ e)%Z in
    let near := Z.div2 (twice + 1) in if negative then (- near)%Z else near
  | _ => 0%Z
  end.
Lemma holds_reduced k X x : holds X x -> holds (reduced k X) (x - IZR k * (PI / 2)).
Proof.
  intros h. apply holds_sub; [exact h|]. apply holds_mul; [apply holds_whole|].
  apply holds_quotient; [apply I.pi_correct|apply holds_whole].
Qed.
Lemma holds_quarters k X r : holds X r -> holds (quarters k X) (sin (r + IZR k * (PI / 2))).
Proof.
  intros h. unfold quarters.
  assert (hs : holds (I.sin prec X) (sin r)) by exact (I.sin_correct prec _ (Xreal _) h).
  assert (hc : holds (I.cos prec X) (cos r)) by exact (I.cos_correct prec _ (Xreal _) h).
  assert (hns := holds_neg _ _ hs). assert (hnc := holds_neg _ _ hc).
  assert (part := Z.div_mod k 4 ltac:(lia)). assert (bound := Z.mod_pos_bound k 4 ltac:(lia)).
  set (m := (k / 4)%Z) in *. set (j := (k mod 4)%Z) in *. rewrite <- (sin_turns _ m).
  replace (r + IZR k * (PI / 2) - IZR m * (2 * PI)) with (r + IZR j * (PI / 2)) by (rewrite part, plus_IZR, mult_IZR; field).
  assert (cases : j = 0%Z \/ j = 1%Z \/ j = 2%Z \/ j = 3%Z) by lia.
  destruct cases as [c|[c|[c|c]]]; rewrite c in *.
  - replace (r + 0 * (PI / 2)) with r by ring. exact hs.
  - replace (r + 1 * (PI / 2)) with (PI / 2 + r) by ring. rewrite <- cos_sin. exact hc.
  - replace (r + 2 * (PI / 2)) with (r + PI) by field. rewrite neg_sin. exact hns.
  - replace (r + 3 * (PI / 2)) with ((PI / 2 + r) + PI) by field. rewrite neg_sin, <- cos_sin. exact hnc.
Qed.
Lemma holds_sine k X x : holds X x -> holds (sine k X) (sin x).
Proof.
  intros h. replace x with (x - IZR k * (PI / 2) + IZR k * (PI / 2)) at 1 by ring. apply holds_quarters, holds_reduced, h.
Qed.
Lemma holds_cosine k X x : holds X x -> holds (cosine k X) (cos x).
Proof.
  intros h. rewrite cos_sin. replace (PI / 2 + x) with (x - IZR k * (PI / 2) + IZR (k + 1) * (PI / 2)) by (rewrite plus_IZR; ring).
  apply holds_quarters, holds_reduced, h.
Qed.

Definition is_positive (X : I.type) : bool := match I.sign_strict X with Xgt => true | _ => false end.
Definition is_not_negative (X : I.type) : bool := match I.sign_large X with Xgt | Xeq => true | _ => false end.
Lemma is_positive_sound X x : is_positive X = true -> holds X x -> 0 < x.
Proof.
  unfold is_positive. assert (h := I.sign_strict_correct X). destruct (I.sign_strict X); try discriminate.
  intros _ c. exact (proj2 (h _ c)).
Qed.
Lemma is_not_negative_sound X x : is_not_negative X = true -> holds X x -> 0 <= x.
Proof.
  unfold is_not_negative. assert (h := I.sign_large_correct X). destruct (I.sign_large X); try discriminate; intros _ c.
  - specialize (h _ c). injection h as ->. lra.
  - exact (proj2 (h _ c)).
Qed.
(* side w * x, without a rounding. *)
Definition sided (w : wall) (X : I.type) : I.type := match w with left => I.neg X | right => X end.
Lemma holds_sided w X x : holds X x -> holds (sided w X) (side w * x).
Proof.
  destruct w; cbn; intros h; [replace (-1 * x) with (- x) by ring; apply holds_neg, h|].
  replace (1 * x) with x by ring. exact h.
Qed.

(* Numbers and stretches of the grid. *)
Section Grid.
Variable q : positive.
Definition unit_step := quotient (whole 1) (whole (2 ^ Zpos q)).
Variable step : I.type.
Hypothesis step_holds : holds step (/ IZR (2 ^ Zpos q)).
Definition point (n : Z) := mul step (whole n).
Definition stretch (a b : Z) := hull (point a) (point b).
Lemma holds_point n : holds (point n) (grid q n).
Proof. apply holds_mul; [exact step_holds|apply holds_whole]. Qed.
Lemma holds_stretch a b x : grid q a <= x <= grid q b -> holds (stretch a b) x.
Proof. apply holds_hull; apply holds_point. Qed.
End Grid.
Lemma unit_step_holds q : holds (unit_step q) (/ IZR (2 ^ Zpos q)).
Proof. replace (/ IZR (2 ^ Zpos q)) with (1 / IZR (2 ^ Zpos q)) by (unfold Rdiv; ring). apply holds_quotient; apply holds_whole. Qed.

Fixpoint enclose (n : number) : I.type :=
  match n with
  | Rational r => quotient (whole (Qnum r)) (whole (Zpos (Qden r)))
  | Pi => I.pi prec
  | Plus a b => add (enclose a) (enclose b)
  | Minus a b => sub (enclose a) (enclose b)
  | Times a b => mul (enclose a) (enclose b)
  | Over a b => quotient (enclose a) (enclose b)
  | Root a => I.sqrt prec (enclose a)
  | Sine a => I.sin prec (enclose a)
  | Cosine a => I.cos prec (enclose a)
  end.
Lemma holds_enclose n : holds (enclose n) (value n).
Proof.
  induction n as [r| |a IHa b IHb|a IHa b IHb|a IHa b IHb|a IHa b IHb|a IHa|a IHa|a IHa]; cbn [enclose value].
  - apply holds_quotient; apply holds_whole.
  - apply I.pi_correct.
  - apply holds_add; assumption.
  - apply holds_sub; assumption.
  - apply holds_mul; assumption.
  - apply holds_quotient; assumption.
  - exact (I.sqrt_correct prec (enclose a) (Xreal (value a)) IHa).
  - exact (I.sin_correct prec _ (Xreal _) IHa).
  - exact (I.cos_correct prec _ (Xreal _) IHa).
Qed.
Definition enclose_range (r : range) : I.type := hull (enclose (least r)) (enclose (most r)).
Lemma holds_range r x : among r x -> holds (enclose_range r) x.
Proof. apply holds_hull; apply holds_enclose. Qed.
(* Rational numbers, and what is between two. *)
Definition known_number (r : Q) : I.type := enclose (Rational r).
Lemma holds_number r : holds (known_number r) (Q2R r).
Proof. exact (holds_enclose (Rational r)). Qed.
Definition spanned (b : Q * Q) : I.type := hull (known_number (fst b)) (known_number (snd b)).
Lemma holds_spanned b x : Q2R (fst b) <= x <= Q2R (snd b) -> holds (spanned b) x.
Proof. apply holds_hull; apply holds_number. Qed.
End Arithmetic.

Ltac enclose := solve [intros; cbv zeta; repeat first [assumption | apply holds_whole | apply holds_point; assumption | match goal with
  | |- holds (add _ _ _) (_ + _) => apply holds_add
  | |- holds (sub _ _ _) (_ - _) => apply holds_sub
  | |- holds (mul _ _ _) (_ * _) => apply holds_mul
  | |- holds (quotient _ _ _) (_ / _) => apply holds_quotient
  | |- holds (I.neg _) (- _) => apply holds_neg
  | |- holds (sided _ _) (side _ * _) => apply holds_sided
  | |- holds (sine _ _ _) (sin _) => apply holds_sine
  | |- holds (cosine _ _ _) (cos _) => apply holds_cosine end]].

End Enclosure.
