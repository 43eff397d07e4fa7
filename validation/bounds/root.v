(* Lemma C3: one root and where it is: `root` of src/contact/certify.rs.
   A template: validation/bounds/prove fills in what stands between @ signs, from the source text.
   Underflow is left out here: `added` of every operation. *)
From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
Require Import rounding tools.
Open Scope R_scope.

(* `1/(1 - x) <= 1 + 2.1 x`, as `tail` has it. *)
Theorem C3_factor x : 0 <= x <= @DOUBT@ -> / (1 - x) <= @FACTOR@.
Proof.
  intros H. apply Rmult_le_reg_r with (1 - x); [lra|]. rewrite Rinv_l by lra. nra.
Qed.

(* One root: `f` is z - target on a flight, known at `at_` within E and E_w. *)
Section One.
Variables (f f' : R -> R) (at_ r w E E_w K reach x : R).
Hypothesis Hf : forall y, is_derive f y (f' y).
Hypotheses (Hr : Rabs (f at_ - r) <= E) (Hw : Rabs (f' at_ - w) <= E_w) (w0 : 0 < Rabs w) (K0 : 0 <= K) (x0 : 0 <= x <= @DOUBT@).
Hypothesis Hbend : forall y, Rabs (y - at_) <= reach -> Rabs (f' y - f' at_) <= K * Rabs (y - at_).
(* `reach` as computed, up to its rounding errors; `doubt`. *)
Hypotheses (Hreach : (1 - 16 * u) * (@REACH@) <= reach) (Hreach0 : 0 < reach) (Hdoubt : (E_w + K * reach) / Rabs w <= x).
Lemma slope y : Rabs (y - at_) <= reach -> Rabs (f' y - w) <= x * Rabs w.
Proof.
  intros H. assert (B := Hbend y H). assert (KR : K * Rabs (y - at_) <= K * reach) by (apply Rmult_le_compat_l; assumption).
  assert (X : E_w + K * reach <= x * Rabs w). { apply Rmult_le_reg_r with (/ Rabs w); [apply Rinv_0_lt_compat; exact w0|].
    rewrite Rmult_assoc, Rinv_r by lra. lra. }
  apply split_abs in B, Hw. apply Rabs_le. lra.
Qed.
Lemma far y z : Rabs (y - at_) <= reach -> Rabs (z - at_) <= reach -> (1 - x) * Rabs w * Rabs (z - y) <= Rabs (f z - f y).
Proof.
  intros Y Z. destruct (MVT_abs f f' y z) as (c & e & b). { intros t _. apply is_derive_Reals, Hf. }
  rewrite e. apply Rmult_le_compat_r; [apply Rabs_pos|].
  assert (C : Rabs (c - at_) <= reach). { apply split_abs in Y, Z. apply Rabs_le. unfold Rmin, Rmax in b. destruct (Rle_dec y z); lra. }
  assert (S := slope c C). apply split_abs in S. unfold Rabs in *. destruct (Rcase_abs w), (Rcase_abs (f' c)); lra.
Qed.
(* No two roots within reach; the root is near the end of the step; at the ends f is beyond 0 on opposite sides (one root). *)
Theorem C3_at_most_one y z : Rabs (y - at_) <= reach -> Rabs (z - at_) <= reach -> f y = 0 -> f z = 0 -> y = z.
Proof.
  intros Y Z fy fz. assert (F := far y z Y Z). rewrite fy, fz, Rminus_0_r, Rabs_R0 in F. assert (P := Rabs_pos (z - y)).
  assert (0 < (1 - x) * Rabs w) by (apply Rmult_lt_0_compat; lra). assert (N : Rabs (z - y) = 0) by nra. unfold Rabs in N.
    destruct (Rcase_abs (z - y)); lra.
Qed.
Theorem C3_location s y : Rabs s <= reach -> Rabs (y - at_) <= reach -> f y = 0 -> Rabs (y - (at_ - s)) <= Rabs (f (at_ - s)) * / Rabs w *
  @FACTOR@.
Proof.
  intros S Y fy. assert (Z : Rabs (at_ - s - at_) <= reach) by (replace (at_ - s - at_) with (- s) by ring; rewrite Rabs_Ropp; exact S).
  assert (F := far (at_ - s) y Z Y). rewrite fy in F. replace (Rabs (0 - f (at_ - s))) with (Rabs (f (at_ - s))) in F by (rewrite <-
    Rabs_Ropp; f_equal; ring).
  assert (x1 : 0 < 1 - x) by lra. assert (Fac := C3_factor x x0).
  apply Rle_trans with (Rabs (f (at_ - s)) * / Rabs w * / (1 - x)).
  - apply Rmult_le_reg_r with ((1 - x) * Rabs w); [apply Rmult_lt_0_compat; lra|].
    replace (Rabs (f (at_ - s)) * / Rabs w * / (1 - x) * ((1 - x) * Rabs w)) with (Rabs (f (at_ - s))) by (field; lra). lra.
  - apply Rmult_le_compat_l; [|exact Fac]. apply Rmult_le_pos; [apply Rabs_pos|left; apply Rinv_0_lt_compat; exact w0].
Qed.
Theorem C3_exists : exists y, Rabs (y - at_) <= reach /\ f y = 0.
Proof.
  assert (m : (1 - 16 * u) * (2 * (Rabs r + E)) <= reach * Rabs w). { apply (Rmult_le_compat_r (Rabs w)) in Hreach; [|lra].
    apply Rle_trans with (2 := Hreach). right. unfold u. field. lra. }
  assert (r0 := Rabs_pos r). assert (E0 : 0 <= E) by (generalize (Rabs_pos (f at_ - r)); lra).
  assert (a0 : Rabs (at_ - at_) <= reach) by (rewrite Rminus_diag_eq, Rabs_R0; lra).
  assert (fa : Rabs (f at_) <= Rabs r + E) by (apply split_abs in Hr; apply Rabs_le; generalize (abs_self r); lra).
  assert (big : Rabs (f at_) <= (1 - x) * Rabs w * reach). { apply Rle_trans with (1 := fa).
    assert (0 <= reach * Rabs w) by (apply Rmult_le_pos; lra).
    apply Rle_trans with (0.51 * (reach * Rabs w)); [unfold u in m; lra|].
      assert (0.51 * (reach * Rabs w) <= (1 - x) * (reach * Rabs w)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (cont : forall y, continuity_pt f y) by (intros y; apply derivable_continuous_pt; exists (f' y); apply is_derive_Reals, Hf).
  (* f grows or falls by at least (1 - x)|w| a unit on both sides. *)
  assert (side : forall t, 0 <= t <= reach -> (0 < w -> f at_ + (1 - x) * Rabs w * t <= f (at_ + t) /\ f (at_ - t) <= f at_ - (1 - x) *
    Rabs w * t) /\
                                              (w < 0 -> f (at_ + t) <= f at_ - (1 - x) * Rabs w * t /\ f at_ + (1 - x) * Rabs w * t <= f
                                              (at_ - t))).
  { intros t T. destruct (Req_dec t 0) as [e|n]; [rewrite e, Rplus_0_r, Rminus_0_r; lra|].
    destruct (MVT_cor2 f f' at_ (at_ + t)) as (c & e1 & r1); [lra|intros; apply is_derive_Reals, Hf|].
    destruct (MVT_cor2 f f' (at_ - t) at_) as (d & e2 & r2); [lra|intros; apply is_derive_Reals, Hf|].
    assert (S1 := slope c). assert (S2 := slope d). rewrite Rabs_pos_eq in S1 by lra. rewrite Rabs_left in S2 by lra.
    assert (S1' := split_abs _ _ (S1 ltac:(lra))). assert (S2' := split_abs _ _ (S2 ltac:(lra))).
    replace (at_ + t - at_) with t in e1 by ring. replace (at_ - (at_ - t)) with t in e2 by ring.
    assert (scaled : forall p q, p <= q -> p * t <= q * t) by (intros p q o; apply Rmult_le_compat_r; lra).
    split; intros sw; [rewrite (Rabs_pos_eq w) in * by lra|rewrite (Rabs_left w) in * by lra].
    - assert (Lc := scaled ((1 - x) * w) (f' c)). assert (Ld := scaled ((1 - x) * w) (f' d)). clear scaled. split; lra.
    - assert (Lc := scaled (f' c) ((1 - x) * w)). assert (Ld := scaled (f' d) ((1 - x) * w)). clear scaled. split; lra. }
  destruct (side reach) as [P M]; [lra|]. assert (A := abs_self (f at_)).
  assert (bound : forall y, at_ - reach <= y <= at_ + reach -> Rabs (y - at_) <= reach) by (intros; apply Rabs_le; lra).
  destruct (Rlt_le_dec 0 w) as [p|n].
  - destruct (P p). destruct (IVT_cor f (at_ - reach) (at_ + reach)) as (y & b & z); [intros y; apply cont|lra|nra|]. exists y. auto.
  - assert (w < 0) as q by (destruct n as [|e]; [assumption|rewrite e, Rabs_R0 in w0; lra]). destruct (M q).
    destruct (IVT_cor f (at_ - reach) (at_ + reach)) as (y & b & z); [intros y; apply cont|lra|nra|]. exists y. auto.
Qed.
End One.

(* The numerator: f at the end of the step. `b2` is the computed second derivative, W and B are the true derivatives, J is at
   least half of the third one. *)
Section Numerator.
Variables F Z W B r w s b2 E E_w E_b J K : R.
@LEFT@
Hypothesis HZ : Rabs (Z - r) + 7 * u * Rabs r <= (1 + 32 * u) * E.
Hypotheses (HW : Rabs (W - w) <= (1 + 4 * u) * E_w) (HB : Rabs (B - b2) <= E_b) (Hb2 : Rabs b2 <= (1 + 4 * u) * K).
Hypothesis HF : Rabs (F - (Z - W * s + B * (s * s) / 2)) <= J * (Rabs s * Rabs s * Rabs s).
(* The tests, and `reach`, up to their roundings. *)
Hypotheses (w0 : 0 < Rabs w) (Hs : Rabs s * Rabs w <= (1 + 8 * u) * (2 * (Rabs r + E))) (Hx : Rabs s * K <= (1 + 8 * u) * (@DOUBT@ * Rabs
  w)).
Hypothesis J0 : 0 <= J.
Definition taylor := @TAYLOR@.
Theorem C3_numerator : Rabs F <= (1 + 48 * u) * (Rabs left + taylor + E).
Proof.
  assert (s0 := Rabs_pos s). assert (r0 := Rabs_pos r). assert (E0 : 0 <= E) by (generalize (Rabs_pos (Z - r)); unfold u in *; lra).
  assert (Ew0 : 0 <= E_w) by (generalize (Rabs_pos (W - w)); unfold u in *; lra).
    assert (Eb0 : 0 <= E_b) by (generalize (Rabs_pos (B - b2)); lra).
  assert (K0 : 0 <= K) by (generalize (Rabs_pos b2); unfold u in *; lra).
  assert (Rss : Rabs (s * s) <= Rabs s * Rabs s) by (rewrite Rabs_mult; lra). assert (Rs : Rabs s <= Rabs s) by lra.
  (* |w s| and |b2 s^2| / 2 against |r| + E. *)
  assert (ws : Rabs (- w * s) <= (1 + 8 * u) * (2 * (Rabs r + E))) by (rewrite Rabs_mult, Rabs_Ropp; lra).
  assert (bs : Rabs (b2 * s * s) <= (1 + 32 * u) * (0.98 * (Rabs r + E))).
  { rewrite !Rabs_mult. apply Rle_trans with ((1 + 4 * u) * (Rabs s * K) * Rabs s).
    - replace ((1 + 4 * u) * (Rabs s * K) * Rabs s) with ((1 + 4 * u) * K * Rabs s * Rabs s) by ring. do 2 (apply Rmult_le_compat_r;
      [lra|]). exact Hb2.
    - apply Rle_trans with ((1 + 4 * u) * ((1 + 8 * u) * (@DOUBT@ * (Rabs s * Rabs w)))).
      + rewrite Rmult_assoc. apply Rmult_le_compat_l; [unfold u; lra|]. apply Rle_trans with ((1 + 8 * u) * (@DOUBT@ * Rabs w) * Rabs s);
        [|lra]. apply Rmult_le_compat_r; assumption.
      + unfold u in *. lra. }
  (* The rounded steps. *)
  destruct Hbent as [_ [_ F2]]. destruct Hline as [_ [_ F3]]. destruct Hleft as [_ [_ F4]].
  set (q := 1 / 2 * b2 * s).
  assert (qs : q * s = b2 * s * s / 2) by (unfold q; field).
  assert (q2 : Rabs q * Rabs s = Rabs (b2 * s * s) / 2) by (rewrite <- Rabs_mult, qs; unfold Rdiv; rewrite Rabs_mult, (Rabs_pos_eq (/ 2));
    lra).
  assert (G2 : Rabs (bent - q) <= u * Rabs q) by (unfold q; rewrite Hhalf; exact F2).
  assert (G3 : Rabs (bent * s - q * s) <= u * (Rabs (b2 * s * s) / 2)).
  { replace (bent * s - q * s) with ((bent - q) * s) by ring. rewrite <- q2, Rabs_mult, <- Rmult_assoc. apply Rmult_le_compat_r;
    assumption. }
  assert (L1 : Rabs (- w * s + r) <= (1 + 8 * u) * (3 * Rabs r + 2 * E)) by (apply split_abs in ws; apply Rabs_le; generalize (abs_self r);
    unfold u in *; lra).
  assert (F3' : Rabs (line - (- w * s + r)) <= u * ((1 + 8 * u) * (3 * Rabs r + 2 * E))) by (unfold u in *; lra).
  assert (G3' : Rabs (bent * s - q * s) <= u * (0.491 * (Rabs r + E))) by (unfold u in *; lra).
  apply split_abs in bs, F3', L1, G3'. rewrite qs in *.
  assert (L2 : Rabs (bent * s + line) <= (1 + 64 * u) * (3.491 * Rabs r + 2.491 * E)) by (apply Rabs_le; unfold u in *; lra).
  assert (F4' : Rabs (left - (bent * s + line)) <= u * ((1 + 64 * u) * (3.491 * Rabs r + 2.491 * E))) by (unfold u in *; lra).
  product HW Rs. product HB Rss.
  assert (HZ2 : Rabs (Z - r) <= (1 + 32 * u) * E - 7 * u * Rabs r) by lra. clear HZ.
  assert (s20 : 0 <= Rabs s * Rabs s) by (apply Rmult_le_pos; lra).
  assert (T1 : 0 <= E_w * Rabs s) by (apply Rmult_le_pos; lra). assert (T2 : 0 <= E_b * (Rabs s * Rabs s)) by (apply Rmult_le_pos; lra).
  assert (T3 : 0 <= J * (Rabs s * Rabs s * Rabs s)) by (repeat apply Rmult_le_pos; lra).
  apply split_abs in HF, F4', HZ2. assert (l0 := Rabs_pos left). apply Rabs_le. unfold taylor. generalize (abs_self left). unfold u in *.
    lra.
Qed.
End Numerator.
