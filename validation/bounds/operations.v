(* How much the error bounds lose to their own roundings: every bound is made of sums, products and quotients of what is not
   negative, so each operation loses a factor 1 + u at most. Underflow in here is left out.
   A template: validation/bounds/prove fills in what stands between @ signs, from the source text. *)
From Coq Require Import Reals Lra Lia Arith.
From Interval Require Import Tactic.
Require Import rounding tools.
Open Scope R_scope.

Inductive expr := Leaf (x : R) | Add (a b : expr) | Mul (a b : expr) | Fma (a b c : expr) | Min (a b : expr) | Div (a : expr) (y : R) |
  Diff (x y : R).
Fixpoint value e := match e with
  | Leaf x => x | Add a b => value a + value b | Mul a b => value a * value b | Fma a b c => value a * value b + value c
  | Min a b => Rmin (value a) (value b) | Div a y => value a / y | Diff x y => Rabs (x - y) end.
Fixpoint count e := match e with
  | Leaf _ => 0 | Add a b => S (max (count a) (count b)) | Mul a b => S (count a + count b) | Fma a b c => S (max (count a + count b)
    (count c))
  | Min a b => max (count a) (count b) | Div a _ => S (count a) | Diff _ _ => 1 end%nat.
(* `m` is what the doubles make of `e`; `low` is what `normal` and `added` say of it (for the absolute value of a difference too). *)
Definition low x m := x <= (1 + u) * m.
Inductive computed : expr -> R -> Prop :=
  | leaf x : 0 <= x -> computed (Leaf x) x
  | add a b x y m : computed a x -> computed b y -> low (x + y) m -> computed (Add a b) m
  | mul a b x y m : computed a x -> computed b y -> low (x * y) m -> computed (Mul a b) m
  | fma a b c x y z m : computed a x -> computed b y -> computed c z -> low (x * y + z) m -> computed (Fma a b c) m
  | least a b x y : computed a x -> computed b y -> computed (Min a b) (Rmin x y)
  | div a x y m : 0 < y -> computed a x -> low (x / y) m -> computed (Div a y) m
  | diff x y m : low (Rabs (x - y)) m -> computed (Diff x y) m.
Lemma normal_low x m : 0 <= x -> normal x m \/ added x m -> low x m.
Proof. intros H [[_ [F _]]|[F _]]; apply split_abs in F; unfold low, Rabs, u in *; destruct (Rcase_abs m); lra. Qed.

Notation p := (1 + u).
Lemma p1 n : 1 <= p ^ n. Proof. apply pow_R1_Rle. unfold u. lra. Qed.
Lemma grow n k x : 0 <= x -> (n <= k)%nat -> p ^ n * x <= p ^ k * x.
Proof. intros H L. apply Rmult_le_compat_r; [exact H|]. apply Rle_pow; [unfold u; lra|exact L]. Qed.
Lemma low_positive x m : 0 <= x -> low x m -> 0 <= m. Proof. unfold low, u. intros. lra. Qed.
Theorem own_roundings e m : computed e m -> 0 <= value e <= p ^ count e * m /\ 0 <= m.
Proof.
  intros C. induction C as [x H|a b x y m _ [A xa] _ [B yb] L|a b x y m _ [A xa] _ [B yb] L|a b c x y z m _ [A xa] _ [B yb] _ [D zc]
    L|a b x y _ [A xa] _ [B yb]|a x y m P _ [A xa] L|x y m L]; cbn [value count].
  - simpl. lra.
  - assert (m0 : 0 <= m) by (apply (low_positive (x + y)); [lra|exact L]). split; [|exact m0]. split; [lra|].
    assert (G := grow (count a) (max (count a) (count b)) x xa ltac:(lia)).
      assert (G' := grow (count b) (max (count a) (count b)) y yb ltac:(lia)).
    simpl. rewrite (Rmult_comm p), Rmult_assoc. apply Rle_trans with (p ^ max (count a) (count b) * (x + y)); [lra|].
      apply Rmult_le_compat_l; [generalize (p1 (max (count a) (count b))); lra|exact L].
  - assert (m0 : 0 <= m) by (apply (low_positive (x * y)); [apply Rmult_le_pos; assumption|exact L]). split; [|exact m0]. split;
    [apply Rmult_le_pos; lra|].
    simpl. rewrite (Rmult_comm p), Rmult_assoc, pow_add. apply Rle_trans with ((p ^ count a * p ^ count b) * (x * y)).
    + replace ((p ^ count a * p ^ count b) * (x * y)) with ((p ^ count a * x) * (p ^ count b * y)) by ring. apply Rmult_le_compat; lra.
    + apply Rmult_le_compat_l; [generalize (p1 (count a)) (p1 (count b)); intros; apply Rmult_le_pos; lra|exact L].
  - assert (xy : 0 <= x * y) by (apply Rmult_le_pos; assumption). assert (m0 : 0 <= m) by (apply (low_positive (x * y + z));
    [lra|exact L]). split; [|exact m0].
    split; [apply Rplus_le_le_0_compat; [apply Rmult_le_pos|]; lra|]. set (n := max (count a + count b) (count c)).
    assert (G := grow (count a + count b) n (x * y) xy ltac:(unfold n; lia)). assert (G' := grow (count c) n z zc ltac:(unfold n; lia)).
      rewrite pow_add in G.
    assert (V : value a * value b <= (p ^ count a * x) * (p ^ count b * y)) by (apply Rmult_le_compat; lra).
    simpl. rewrite (Rmult_comm p), Rmult_assoc. apply Rle_trans with (p ^ n * (x * y + z)); [lra|]. apply Rmult_le_compat_l;
      [generalize (p1 n); lra|exact L].
  - assert (G := grow (count a) (max (count a) (count b)) x xa ltac:(lia)).
    assert (G' := grow (count b) (max (count a) (count b)) y yb ltac:(lia)).
    unfold Rmin. destruct (Rle_dec (value a) (value b)), (Rle_dec x y); lra.
  - assert (i := Rinv_0_lt_compat y P). assert (xy : 0 <= x / y) by (apply Rmult_le_pos; lra).
    assert (m0 : 0 <= m) by (apply (low_positive (x / y)); assumption). split; [|exact m0].
    split; [apply Rmult_le_pos; lra|]. simpl. rewrite (Rmult_comm p), Rmult_assoc. apply Rle_trans with (p ^ count a * (x / y)).
    + unfold Rdiv. rewrite <- Rmult_assoc. apply Rmult_le_compat_r; lra.
    + apply Rmult_le_compat_l; [generalize (p1 (count a)); lra|exact L].
  - assert (m0 := low_positive _ _ (Rabs_pos _) L). unfold low in L. split; [|exact m0]. split; [apply Rabs_pos|]. simpl.
    rewrite Rmult_1_r. exact L.
Qed.

(* The bounds, spelled out down to the doubles that enter. *)
Section Counts.
@LEAVES@
@SHAPES@
(* 1 + 48u are the second-order terms and the 5 u E of C3; one more rounding is that of the product with SLACK. *)
Theorem slack_covers : (1 + 48 * u) * p ^ 61 <= SLACK.
Proof. unfold SLACK, u. interval with (i_prec 200). Qed.
Theorem counts : @COUNTS@.
Proof. repeat split; apply Nat.leb_le; reflexivity. Qed.
End Counts.
