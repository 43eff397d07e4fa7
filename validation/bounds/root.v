(* Lemma C3: `root` of src/contact/certify.rs and `arrive`, `acceleration_at` of src/flight.rs.
   A template: validation/bounds/prove fills in what stands between @ signs, from the source text.
   Underflow is left out here: `added` of every operation. *)
From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
Require Import rounding tools.
Open Scope R_scope.

(* |g'| <= h' from 0 on, both 0 at 0: then |g| <= h. *)
Lemma grows g g' h h' t : 0 <= t -> (forall x, is_derive g x (g' x)) -> (forall x, is_derive h x (h' x)) -> (forall x, 0 <= x <= t -> Rabs (g' x) <= h' x) -> g 0 = 0 -> h 0 = 0 -> Rabs (g t) <= h t.
Proof.
  intros t0 G H B g0 h0. destruct (Req_dec t 0) as [e|n]; [rewrite e, g0, h0, Rabs_R0; lra|].
  assert (up' : forall f f', (forall x, is_derive f x (f' x)) -> (forall x, 0 <= x <= t -> 0 <= f' x) -> f 0 = 0 -> 0 <= f t).
  { intros f f' F P z. destruct (MVT_cor2 f f' 0 t) as (c & e & r); [lra|intros x _; apply is_derive_Reals, F|].
    rewrite z in e. assert (0 <= f' c) by (apply P; lra). nra. }
  apply Rabs_le. split.
  - cut (0 <= h t + g t); [lra|]. apply (up' (fun x => h x + g x) (fun x => h' x + g' x)); [|intros x X; apply B, split_abs in X; lra|lra].
    intros x. apply (is_derive_plus h g); auto.
  - cut (0 <= h t - g t); [lra|]. apply (up' (fun x => h x - g x) (fun x => h' x - g' x)); [|intros x X; apply B, split_abs in X; lra|lra].
    intros x. apply (is_derive_minus h g); auto.
Qed.
(* Taylor's formula for sine and cosine, a step t back; first for t >= 0. *)
Lemma sine_1st y t : 0 <= t -> Rabs (sin (y - t) - sin y) <= t.
Proof.
  intros H. apply (grows (fun t => sin (y - t) - sin y) (fun t => - cos (y - t)) (fun t => t) (fun _ => 1)); auto.
  - intros x. auto_derive; [auto|ring]. - intros x. auto_derive; [auto|ring].
  - intros x _. rewrite Rabs_Ropp. apply Rabs_le, COS_bound. - rewrite Rminus_0_r. ring.
Qed.
Lemma cosine_2nd y t : 0 <= t -> Rabs (cos (y - t) - cos y - t * sin y) <= t * t / 2.
Proof.
  intros H. apply (grows (fun t => cos (y - t) - cos y - t * sin y) (fun t => sin (y - t) - sin y) (fun t => t * t / 2) (fun t => t)); auto; try lra.
  - intros x. auto_derive; [auto|ring]. - intros x. auto_derive; [auto|field].
  - intros x X. apply sine_1st. lra. - rewrite Rminus_0_r. ring.
Qed.
Lemma cosine_1st y t : 0 <= t -> Rabs (cos (y - t) - cos y) <= t.
Proof.
  intros H. apply (grows (fun t => cos (y - t) - cos y) (fun t => sin (y - t)) (fun t => t) (fun _ => 1)); auto.
  - intros x. auto_derive; [auto|ring]. - intros x. auto_derive; [auto|ring].
  - intros x _. apply Rabs_le, SIN_bound. - rewrite Rminus_0_r. ring.
Qed.
Lemma sine_2nd y t : 0 <= t -> Rabs (sin (y - t) - (sin y - t * cos y)) <= t * t / 2.
Proof.
  intros H. apply (grows (fun t => sin (y - t) - (sin y - t * cos y)) (fun t => - (cos (y - t) - cos y)) (fun t => t * t / 2) (fun t => t)); auto; try lra.
  - intros x. auto_derive; [auto|ring]. - intros x. auto_derive; [auto|field].
  - intros x X. rewrite Rabs_Ropp. apply cosine_1st. lra. - rewrite Rminus_0_r. ring.
Qed.
Lemma cosine_3rd y t : 0 <= t -> Rabs (cos (y - t) - (cos y + t * sin y - t * t / 2 * cos y)) <= t * t * t / 6.
Proof.
  intros H. apply (grows (fun t => cos (y - t) - (cos y + t * sin y - t * t / 2 * cos y)) (fun t => sin (y - t) - (sin y - t * cos y)) (fun t => t * t * t / 6) (fun t => t * t / 2)); auto; try lra.
  - intros x. auto_derive; [auto|field]. - intros x. auto_derive; [auto|field].
  - intros x X. apply sine_2nd. lra. - rewrite Rminus_0_r. field.
Qed.
Lemma sine_3rd y t : 0 <= t -> Rabs (sin (y - t) - (sin y - t * cos y - t * t / 2 * sin y)) <= t * t * t / 6.
Proof.
  intros H. apply (grows (fun t => sin (y - t) - (sin y - t * cos y - t * t / 2 * sin y)) (fun t => - (cos (y - t) - cos y - t * sin y)) (fun t => t * t * t / 6) (fun t => t * t / 2)); auto; try lra.
  - intros x. auto_derive; [auto|field]. - intros x. auto_derive; [auto|field].
  - intros x X. rewrite Rabs_Ropp. apply cosine_2nd. lra. - rewrite Rminus_0_r. field.
Qed.
(* And for any t and either wall. *)
Theorem cosine_taylor y t : Rabs (cos (y - t) - (cos y + t * sin y - t * t / 2 * cos y)) <= Rabs t * Rabs t * Rabs t / 6.
Proof.
  destruct (Rle_lt_dec 0 t) as [p|n]; [rewrite (Rabs_pos_eq t p); apply cosine_3rd; exact p|]. rewrite (Rabs_left t n).
  assert (H := cosine_3rd (- y) (- t)). rewrite cos_neg, sin_neg in H. replace (- y - - t) with (- (y - t)) in H by ring. rewrite cos_neg in H.
  replace (cos y + t * sin y - t * t / 2 * cos y) with (cos y + - t * - sin y - - t * - t / 2 * cos y) by field. apply H. lra.
Qed.
Theorem sine_taylor y t : Rabs (sin (y - t) - (sin y - t * cos y)) <= Rabs t * Rabs t / 2.
Proof.
  destruct (Rle_lt_dec 0 t) as [p|n]; [rewrite (Rabs_pos_eq t p); apply sine_2nd; exact p|]. rewrite (Rabs_left t n).
  assert (H := sine_2nd (- y) (- t)). rewrite cos_neg, sin_neg in H. replace (- y - - t) with (- (y - t)) in H by ring. rewrite sin_neg in H.
  replace (sin (y - t) - (sin y - t * cos y)) with (- (- sin (y - t) - (- sin y - - t * cos y))) by ring. rewrite Rabs_Ropp. apply H. lra.
Qed.
Theorem sine_taylor_3 y t : Rabs (sin (y - t) - (sin y - t * cos y - t * t / 2 * sin y)) <= Rabs t * Rabs t * Rabs t / 6.
Proof.
  destruct (Rle_lt_dec 0 t) as [p|n]; [rewrite (Rabs_pos_eq t p); apply sine_3rd; exact p|]. rewrite (Rabs_left t n).
  assert (H := sine_3rd (- y) (- t)). rewrite cos_neg, sin_neg in H. replace (- y - - t) with (- (y - t)) in H by ring. rewrite sin_neg in H.
  replace (sin (y - t) - (sin y - t * cos y - t * t / 2 * sin y)) with (- (- sin (y - t) - (- sin y - - t * cos y - - t * - t / 2 * - sin y))) by field.
  rewrite Rabs_Ropp. apply H. lra.
Qed.

(* `1/(1 - x) <= 1 + 2.1 x`, as `tail` has it. *)
Theorem C3_factor doubt : 0 <= doubt <= @DOUBT@ -> / (1 - doubt) <= @FACTOR@.
Proof.
  intros H. apply Rmult_le_reg_r with (1 - doubt); [lra|]. rewrite Rinv_l by lra. nra.
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
  assert (X : E_w + K * reach <= x * Rabs w). { apply Rmult_le_reg_r with (/ Rabs w); [apply Rinv_0_lt_compat; exact w0|]. rewrite Rmult_assoc, Rinv_r by lra. lra. }
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
  assert (0 < (1 - x) * Rabs w) by (apply Rmult_lt_0_compat; lra). assert (N : Rabs (z - y) = 0) by nra. unfold Rabs in N. destruct (Rcase_abs (z - y)); lra.
Qed.
Theorem C3_location s y : Rabs s <= reach -> Rabs (y - at_) <= reach -> f y = 0 -> Rabs (y - (at_ - s)) <= Rabs (f (at_ - s)) * / Rabs w * (1 + 2.1 * x).
Proof.
  intros S Y fy. assert (Z : Rabs (at_ - s - at_) <= reach) by (replace (at_ - s - at_) with (- s) by ring; rewrite Rabs_Ropp; exact S).
  assert (F := far (at_ - s) y Z Y). rewrite fy in F. replace (Rabs (0 - f (at_ - s))) with (Rabs (f (at_ - s))) in F by (rewrite <- Rabs_Ropp; f_equal; ring).
  assert (x1 : 0 < 1 - x) by lra. assert (Fac : / (1 - x) <= 1 + 2.1 * x). { apply Rmult_le_reg_r with (1 - x); [lra|]. rewrite Rinv_l by lra. nra. }
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
  assert (big : Rabs (f at_) <= (1 - x) * Rabs w * reach). { apply Rle_trans with (1 := fa). assert (0 <= reach * Rabs w) by (apply Rmult_le_pos; lra).
    apply Rle_trans with (0.51 * (reach * Rabs w)); [unfold u in m; lra|]. assert (0.51 * (reach * Rabs w) <= (1 - x) * (reach * Rabs w)) by (apply Rmult_le_compat_r; lra). lra. }
  assert (cont : forall y, continuity_pt f y) by (intros y; apply derivable_continuous_pt; exists (f' y); apply is_derive_Reals, Hf).
  (* f grows or falls by at least (1 - x)|w| a unit on both sides. *)
  assert (side : forall t, 0 <= t <= reach -> (0 < w -> f at_ + (1 - x) * Rabs w * t <= f (at_ + t) /\ f (at_ - t) <= f at_ - (1 - x) * Rabs w * t) /\
                                              (w < 0 -> f (at_ + t) <= f at_ - (1 - x) * Rabs w * t /\ f at_ + (1 - x) * Rabs w * t <= f (at_ - t))).
  { intros t T. destruct (Req_dec t 0) as [e|n]; [rewrite e, Rplus_0_r, Rminus_0_r; lra|].
    destruct (MVT_cor2 f f' at_ (at_ + t)) as (c & e1 & r1); [lra|intros; apply is_derive_Reals, Hf|].
    destruct (MVT_cor2 f f' (at_ - t) at_) as (d & e2 & r2); [lra|intros; apply is_derive_Reals, Hf|].
    assert (S1 := slope c). assert (S2 := slope d). rewrite Rabs_pos_eq in S1 by lra. rewrite Rabs_left in S2 by lra.
    assert (S1' := split_abs _ _ (S1 ltac:(lra))). assert (S2' := split_abs _ _ (S2 ltac:(lra))).
    replace (at_ + t - at_) with t in e1 by ring. replace (at_ - (at_ - t)) with t in e2 by ring.
    split; intros sw; [rewrite (Rabs_pos_eq w) in * by lra|rewrite (Rabs_left w) in * by lra]; split; nra. }
  destruct (side reach) as [P M]; [lra|]. assert (A := abs_self (f at_)).
  assert (bound : forall y, at_ - reach <= y <= at_ + reach -> Rabs (y - at_) <= reach) by (intros; apply Rabs_le; lra).
  destruct (Rlt_le_dec 0 w) as [p|n].
  - destruct (P p). destruct (IVT_cor f (at_ - reach) (at_ + reach)) as (y & b & z); [intros y; apply cont|lra|nra|]. exists y. auto.
  - assert (w < 0) as q by (destruct n as [|e]; [assumption|rewrite e, Rabs_R0 in w0; lra]). destruct (M q).
    destruct (IVT_cor f (at_ - reach) (at_ + reach)) as (y & b & z); [intros y; apply cont|lra|nra|]. exists y. auto.
Qed.
End One.
