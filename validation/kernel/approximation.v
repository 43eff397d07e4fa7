(* Approximation error of the formulas of kernel.rs, in real numbers: Lemmas K1, K2, K3.
   A template: validation/kernel/prove fills in what stands between @ signs, from kernel.rs. *)
From Coq Require Import Reals Lra Lia ZArith Factorial.
From Interval Require Import Tactic.
Open Scope R_scope.

Definition TAU_HI := @TAU_HI@.
Definition TAU_LO := @TAU_LO@.
Definition P_0 := @P_0@.
Definition Q_0 := @Q_0@.
Definition P x := @P@.
Definition Q x := @Q@.
Definition A z := @A@.
Definition model_sine r := r * (TAU_HI + TAU_LO - r * r * P (r * r)).
Definition model_excess r := r * (r * r) * P (r * r).
Definition model_versine r := r * r * Q (r * r).

(* These are what the Rust code evaluates, operation by operation, were its arithmetic exact. *)
Lemma code_sine r : (@CODE_SINE@) = model_sine r.
Proof. cbv zeta. unfold model_sine, P. field; lra. Qed.
Lemma code_excess r : (@CODE_EXCESS@) = model_excess r.
Proof. cbv zeta. unfold model_excess, P. field; lra. Qed.
Lemma code_versine r : (@CODE_VERSINE@) = model_versine r.
Proof. cbv zeta. unfold model_versine, Q. field; lra. Qed.
Lemma code_angle q : (@CODE_ANGLE@) = sqrt (1 - q) * A (1 - q).
Proof. cbv zeta. unfold A. replace (1.0 - q) with (1 - q) by lra. field; lra. Qed.

Fixpoint factorial (n : nat) : Z := match n with O => 1%Z | S m => (Z.of_nat n * factorial m)%Z end.
Lemma factorial_spec n : INR (fact n) = IZR (factorial n).
Proof.
  induction n as [|n IH]; [reflexivity|].
  rewrite fact_simpl, mult_INR, IH, INR_IZR_INZ, <- mult_IZR. reflexivity.
Qed.
Ltac numbers := repeat match goal with |- context [factorial ?n] =>
  let z := eval vm_compute in (factorial n) in change (factorial n) with z end.

(* Taylor sums of (a - sin a) / a^3 and (1 - cos a) / a^2 in y = a^2, one above and one below (Coq's sin_bound,
   cos_bound). *)
@TAYLOR@
Lemma range r : 0 <= r <= 1/8 -> 0 <= 2 * PI * r <= 1.
Proof. intros H. split; interval with (i_prec 30). Qed.

Definition turn r := 2 * PI * r.
Lemma enclose r : 0 <= r <= 1/8 -> let a := turn r in let y := 4 * PI * PI * (r * r) in
  a * (1 - y * excess_above y) <= sin a <= a * (1 - y * excess_below y) /\
  y * versine_below y <= 1 - cos a <= y * versine_above y.
Proof.
  intros H a y. assert (R := range r H). fold (turn r) in R. fold a in R.
  assert (Ey : a * a = y) by (unfold a, y, turn; ring).
  assert (HP : 3 < PI) by interval with (i_prec 30).
  destruct (sin_bound a 4) as [s1 s2]; [lra|lra|].
  destruct (cos_bound a 4) as [c1 c2]; [lra|lra|].
  change (2 * 4 + 1)%nat with 9%nat in *. change (2 * (4 + 1))%nat with 10%nat in *.
  rewrite sin_sum_above in s1. rewrite sin_sum_below in s2. rewrite cos_sum_above in c1. rewrite cos_sum_below in c2.
  rewrite Ey in *. lra.
Qed.

Ltac polynomials := unfold model_sine, model_excess, model_versine, turn, P, Q, P_0, Q_0, TAU_HI, TAU_LO, excess_above, excess_below, versine_above, versine_below.
Ltac by_taylor v := polynomials; interval with (i_taylor v, i_bisect v, i_prec 90, i_degree 12).

Lemma K1_half r : 0 <= r <= 1/8 -> Rabs (model_sine r - sin (turn r)) <= @EPS_K1@ /\ Rabs (1 - model_versine r - cos (turn r)) <= @EPS_K1@.
Proof.
  intros H. destruct (enclose r H) as [[s1 s2] [c1 c2]]. set (y := 4 * PI * PI * (r * r)) in *.
  assert (model_sine r - turn r * (1 - y * excess_above y) <= @EPS_K1@) by (unfold y; by_taylor r).
  assert (- (@EPS_K1@) <= model_sine r - turn r * (1 - y * excess_below y)) by (unfold y; by_taylor r).
  assert (model_versine r - y * versine_below y <= @EPS_K1@) by (unfold y; by_taylor r).
  assert (- (@EPS_K1@) <= model_versine r - y * versine_above y) by (unfold y; by_taylor r).
  split; apply Rabs_le; lra.
Qed.
Theorem K1 r : -1/8 <= r <= 1/8 -> Rabs (model_sine r - sin (2 * PI * r)) <= @EPS_K1@ /\ Rabs (1 - model_versine r - cos (2 * PI * r)) <= @EPS_K1@.
Proof.
  intros H. fold (turn r). destruct (Rle_lt_dec 0 r) as [p|n]; [apply K1_half; lra|].
  destruct (K1_half (- r)) as [s c]; [lra|]. revert s c.
  replace (turn (- r)) with (- turn r) by (unfold turn; ring). rewrite sin_neg, cos_neg.
  replace (model_sine (- r)) with (- model_sine r) by (unfold model_sine; replace (- r * - r) with (r * r) by ring; ring).
  replace (model_versine (- r)) with (model_versine r) by (unfold model_versine; replace (- r * - r) with (r * r) by ring; ring).
  replace (- model_sine r - - sin (turn r)) with (- (model_sine r - sin (turn r))) by ring. rewrite Rabs_Ropp. auto.
Qed.

Lemma K2_polynomials x : 0 <= x <= 1/64 -> let y := 4 * PI * PI * x in
  (TAU_HI + TAU_LO - x * P x <= (1 + @EPS_SINE@) * (2 * PI * (1 - y * excess_above y)) /\
   (1 - @EPS_SINE@) * (2 * PI * (1 - y * excess_below y)) <= TAU_HI + TAU_LO - x * P x) /\
  (Q x <= (1 + @EPS_VERSINE@) * (4 * PI * PI * versine_below y) /\ (1 - @EPS_VERSINE@) * (4 * PI * PI * versine_above y) <= Q x) /\
  (P x <= (1 + @EPS_EXCESS@) * (8 * (PI * PI * PI) * excess_below y) /\ (1 - @EPS_EXCESS@) * (8 * (PI * PI * PI) * excess_above y) <= P x).
Proof. intros H y. unfold y. repeat split; apply Rminus_le; by_taylor x. Qed.

Lemma relative m t e : (1 - e) * t <= m <= (1 + e) * t -> Rabs (m - t) <= e * t.
Proof. intros H. apply Rabs_le. lra. Qed.

Theorem K2 r : 0 <= r <= 1/8 -> Rabs (model_sine r - sin (2 * PI * r)) <= @EPS_SINE@ * sin (2 * PI * r) /\
  Rabs (model_versine r - (1 - cos (2 * PI * r))) <= @EPS_VERSINE@ * (1 - cos (2 * PI * r)) /\
  Rabs (model_excess r - (2 * PI * r - sin (2 * PI * r))) <= @EPS_EXCESS@ * (2 * PI * r - sin (2 * PI * r)).
Proof.
  intros H. fold (turn r). destruct (enclose r H) as [[s1 s2] [v1 v2]].
  set (y := 4 * PI * PI * (r * r)) in *. set (x := r * r). assert (Hx : 0 <= x <= 1/64) by (unfold x; nra).
  destruct (K2_polynomials x Hx) as [[a1 a2] [[b1 b2] [c1 c2]]]. change (4 * PI * PI * x) with y in *.
  assert (Ey : y = 4 * PI * PI * x) by reflexivity.
  assert (x0 : 0 <= x) by apply Hx. assert (r0 : 0 <= r) by apply H. assert (rx : 0 <= r * x) by (apply Rmult_le_pos; auto).
  repeat split; apply relative; unfold model_sine, model_versine, model_excess; fold x.
  - apply (Rmult_le_compat_l r _ _ r0) in a1. apply (Rmult_le_compat_l r _ _ r0) in a2. unfold turn in *. lra.
  - apply (Rmult_le_compat_l x _ _ x0) in b1. apply (Rmult_le_compat_l x _ _ x0) in b2.
    replace (x * ((1 + @EPS_VERSINE@) * (4 * PI * PI * versine_below y))) with ((1 + @EPS_VERSINE@) * (y * versine_below y)) in b1 by (rewrite Ey; ring).
    replace (x * ((1 - @EPS_VERSINE@) * (4 * PI * PI * versine_above y))) with ((1 - @EPS_VERSINE@) * (y * versine_above y)) in b2 by (rewrite Ey; ring).
    lra.
  - apply (Rmult_le_compat_l (r * x) _ _ rx) in c1. apply (Rmult_le_compat_l (r * x) _ _ rx) in c2.
    replace (r * x * ((1 + @EPS_EXCESS@) * (8 * (PI * PI * PI) * excess_below y))) with ((1 + @EPS_EXCESS@) * (turn r * (y * excess_below y))) in c1 by (rewrite Ey; unfold turn, x; ring).
    replace (r * x * ((1 - @EPS_EXCESS@) * (8 * (PI * PI * PI) * excess_above y))) with ((1 - @EPS_EXCESS@) * (turn r * (y * excess_above y))) in c2 by (rewrite Ey; unfold turn, x; ring).
    replace (turn r * (1 - y * excess_above y)) with (turn r - turn r * (y * excess_above y)) in s1 by ring.
    replace (turn r * (1 - y * excess_below y)) with (turn r - turn r * (y * excess_below y)) in s2 by ring.
    lra.
Qed.

Lemma K3_polynomial s : 0 <= s <= 1 -> Rabs (s * A (s * s) - atan (s / sqrt (2 - s * s)) / PI) <= @EPS_K3@.
Proof. intros H. unfold A. interval with (i_taylor s, i_bisect s, i_prec 45, i_degree 8). Qed.

(* acos (1 - s^2) = 2 atan (s / sqrt (2 - s^2)): both are in [0, PI], where the cosine is one-to-one. *)
Lemma half_angle s : 0 <= s <= 1 -> acos (1 - s * s) = 2 * atan (s / sqrt (2 - s * s)).
Proof.
  intros H. assert (Hr : 0 < sqrt (2 - s * s)) by (apply sqrt_lt_R0; nra).
  assert (Hq : sqrt (2 - s * s) * sqrt (2 - s * s) = 2 - s * s) by (apply sqrt_sqrt; nra).
  set (u := s / sqrt (2 - s * s)). assert (Hu : 0 <= u) by (apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat; lra]).
  assert (Eu : u * u = s * s / (2 - s * s)) by (unfold u; set (w := sqrt (2 - s * s)) in *; rewrite <- Hq; field; lra).
  assert (B := atan_bound u). assert (Ha : 0 <= atan u).
  { destruct (Req_dec u 0) as [e|e]; [rewrite e, atan_0; lra|]. left. rewrite <- atan_0. apply atan_increasing. lra. }
  rewrite <- (acos_cos (2 * atan u)) by lra. f_equal.
  rewrite cos_2a_cos, cos_atan. unfold Rsqr.
  assert (Hs : sqrt (1 + u * u) * sqrt (1 + u * u) = 1 + u * u) by (apply sqrt_sqrt; nra).
  assert (0 < sqrt (1 + u * u)) by (apply sqrt_lt_R0; nra).
  replace (2 * (1 / sqrt (1 + u * u)) * (1 / sqrt (1 + u * u))) with (2 / (1 + u * u)) by (set (w := sqrt (1 + u * u)) in *; rewrite <- Hs; field; lra).
  rewrite Eu. field. nra.
Qed.

Theorem K3 q : 0 <= q <= 1 -> Rabs (sqrt (1 - q) * A (1 - q) - acos q / (2 * PI)) <= @EPS_K3@ /\
  acos (- q) / (2 * PI) = 1/2 - acos q / (2 * PI).
Proof.
  intros H. split.
  - set (s := sqrt (1 - q)). assert (Es : s * s = 1 - q) by (apply sqrt_sqrt; lra).
    assert (Hs : 0 <= s <= 1). { split; [apply sqrt_pos|]. rewrite <- sqrt_1. apply sqrt_le_1_alt. lra. }
    rewrite <- Es. replace (acos q) with (2 * atan (s / sqrt (2 - s * s))).
    2:{ rewrite <- half_angle by exact Hs. f_equal. lra. }
    replace (2 * atan (s / sqrt (2 - s * s)) / (2 * PI)) with (atan (s / sqrt (2 - s * s)) / PI) by (field; apply PI_neq0).
    apply K3_polynomial; exact Hs.
  - rewrite acos_opp. field. apply PI_neq0.
Qed.

(* `prove` looks through this list: no hardware floating point may be trusted. *)
Definition all := (K1, K2, K3).
Print Assumptions all.
