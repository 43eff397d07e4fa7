(* Lemma C1 at extrema: `evaluate` of src/contact/extrema.rs within `extremum` of src/contact/bounds.rs.
   A template: validation/bounds/prove fills in what stands between @ signs, from the source text. *)
From Coq Require Import Reals Lra Lia.
From Interval Require Import Tactic.
Require Import rounding tools.
Open Scope R_scope.

(* The rounding of `Extrema::evaluate`, and of the turn in `are_inside`: against the flight of the computed parameters. *)
Section Extremum.
Variables a c s0 z0 t peak n at_ St T e_t e_s alpha_m : R.
(* `t` is the computed time of the first extremum, `at_` the true one of its phase, `peak` the sine, `n` the periods. *)
Hypotheses (Ha : Rabs a <= alpha_m) (Hs0 : Rabs s0 <= 1) (Hz0 : 0 <= z0 <= 1) (Hpeak : Rabs peak <= 1).
Hypotheses (Ht : Rabs (t - at_) <= 4 * u + e_t) (Hs : Rabs (peak - St) <= e_s) (Hspan : Rabs t <= (1 + 2 * u) * T) (T0 : 0 <= T).
@EXTREMUM@
(* What passes the tests of `are_inside` lies in the gap: above the minimum before or after it, below the maximum. *)
Hypotheses (in_gap_max : Rabs high <= 1) (in_gap_min : Rabs low <= 1).
Variables drift_error waves r_u r_w r_z w tilt : R.
Definition extremum_bound_wide := @EXTREMUM_WIDE@.
Definition extremum_bound_narrow := @EXTREMUM_NARROW@.
Definition extremum_rounding := u * (Rabs c * (2 * T + 4) + 5 * alpha_m + 4).
Theorem extremum_is : extremum_bound_wide = extremum_rounding + (drift_error * (T + r_u) + waves + (r_z + r_w * (T + r_u) + r_u * (Rabs w +
  r_w + tilt * (T + r_u)))).
Proof. unfold extremum_bound_wide, extremum_rounding, u. field. Qed.
Theorem extremum_narrow : r_u = 0 -> extremum_bound_narrow = extremum_bound_wide.
Proof. intros e. unfold extremum_bound_narrow, extremum_bound_wide. rewrite e. ring. Qed.
(* `mx`, the height of the first extremum, and the number `top` of it after `n` periods. *)
Lemma evaluated sign' arc mx top : sign' = 1 \/ sign' = -1 -> fused (c * t + base) arc -> fused (sign' * a * peak + arc) mx -> fused (n * c
  + mx) top ->
  Rabs top <= 1 ->
  Rabs (top - (z0 + a * s0 + c * (at_ + n) + sign' * a * St)) <= (1 + 8 * u) * (extremum_rounding - u * alpha_m) + alpha_m * e_s + Rabs c *
    e_t.
Proof.
  intros sg [_ [_ Er]] [_ [_ Em]] [_ [Eh _]] I. destruct Hbase as [_ [_ Eb]].
  assert (g := eta_small). assert (e1 : eta <= u * u) by (apply Rle_trans with (1 := g); unfold u; interval).
  assert (e0 := eta_positive). assert (c00 := Rabs_pos c). assert (a00 := Rabs_pos a).
    assert (cT : 0 <= Rabs c * T) by (apply Rmult_le_pos; lra).
  assert (Ha' : Rabs (sign' * a) <= alpha_m) by (rewrite Rabs_mult; destruct sg as [e|e]; rewrite e;
    [rewrite Rabs_R1|rewrite Rabs_left by lra]; lra).
  product Ha Hs0. product Ha' Hpeak. product Ha' Hs. product (Rle_refl (Rabs c)) Ht. product (Rle_refl (Rabs c)) Hspan.
  assert (Xb : Rabs (a * s0 + z0) <= alpha_m + 1) by (apply Rabs_le; lra).
  assert (Fb : Rabs (base - (a * s0 + z0)) <= u * (alpha_m + 1) + u * u) by (unfold u in *; lra). apply split_abs in Fb, Xb.
  assert (Xr : Rabs (c * t + base) <= Rabs c * ((1 + 2 * u) * T) + (1 + 2 * u) * (alpha_m + 1)) by (apply Rabs_le; unfold u in *; lra).
  assert (Fr : Rabs (arc - (c * t + base)) <= u * (Rabs c * ((1 + 2 * u) * T) + (1 + 2 * u) * (alpha_m + 1)) + u * u) by (unfold u in *;
    lra). apply split_abs in Fr, Xr.
  assert (Xm : Rabs (sign' * a * peak + arc) <= (1 + 2 * u) * (Rabs c * ((1 + 2 * u) * T) + 2 * alpha_m + 1) + 4 * u) by (apply Rabs_le;
    unfold u in *; lra).
  assert (Fm : Rabs (mx - (sign' * a * peak + arc)) <= u * ((1 + 2 * u) * (Rabs c * ((1 + 2 * u) * T) + 2 * alpha_m + 1) + 4 * u) + u * u)
    by (unfold u in *; lra).
  apply split_abs in Fm, Eh. apply Rabs_le. unfold extremum_rounding, u in *. lra.
Qed.
Theorem C1_maximum : Rabs (high - (z0 + a * s0 + c * (at_ + n) + a * St)) <= (1 + 8 * u) * (extremum_rounding - u * alpha_m) + alpha_m *
  e_s + Rabs c * e_t.
Proof. replace (a * St) with (1 * a * St) by ring. apply (evaluated 1 rise max); auto. rewrite Rmult_1_l. exact Hmax. Qed.
Theorem C1_minimum : Rabs (low - (z0 + a * s0 + c * (at_ + n) - a * St)) <= (1 + 8 * u) * (extremum_rounding - u * alpha_m) + alpha_m * e_s
  + Rabs c * e_t.
Proof.
  replace (z0 + a * s0 + c * (at_ + n) - a * St) with (z0 + a * s0 + c * (at_ + n) + -1 * a * St) by ring.
  apply (evaluated (-1) fall min); auto. replace (-1 * a) with (- a) by ring. exact Hmin.
Qed.
End Extremum.

(* The coarse sine, of a critical phase with cosine `q` exactly: not off by more than 1.6u. *)
Section Coarse.
Variable q : R.
Hypothesis Hq : Rabs q <= 1.
(* No underflow: 1 - q^2 is 0 or at least u. *)
@COARSE_SINE@
Theorem coarse_sine : Rabs (sine - sqrt (1 - q * q)) <= 1.6 * u.
Proof.
  destruct Hsquare as [_ [_ F]]. destruct Hsine as [_ [_ G]]. replace ((- q) * q + 1) with (1 - q * q) in F by ring.
    set (x := 1 - q * q) in *.
  assert (x0 : 0 <= x <= 1). { apply split_abs in Hq. unfold x. nra. }
  rewrite (Rabs_pos_eq x) in F by lra. assert (s0 := sqrt_pos x). assert (s1 : sqrt x <= 1) by (rewrite <- sqrt_1; apply sqrt_le_1_alt;
    lra).
  assert (E : Rabs (sqrt square - sqrt x) <= 0.51 * u).
  { destruct (Req_dec x 0) as [e|n]. { rewrite e in *. apply split_abs in F. replace square with 0 by lra.
    rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. unfold u. lra. }
    set (d := (square - x) / x). assert (D0 : Rabs d <= u). { unfold d, Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ x)) by (left;
      apply Rinv_0_lt_compat; lra).
      apply Rmult_le_reg_r with x; [lra|]. rewrite Rmult_assoc, Rinv_l by lra. lra. }
    replace square with (x * (1 + d)) by (unfold d; field; exact n). apply split_abs in D0. rewrite sqrt_mult by (unfold u in *; lra).
    replace (sqrt x * sqrt (1 + d) - sqrt x) with (sqrt x * (sqrt (1 + d) - 1)) by ring. rewrite Rabs_mult, (Rabs_pos_eq _ s0).
    assert (Q : Rabs (sqrt (1 + d) - 1) <= 0.51 * u). { unfold u in *. interval with (i_taylor d, i_prec 120). }
    generalize (Rabs_pos (sqrt (1 + d) - 1)). nra. }
  assert (r0 := sqrt_pos square). rewrite (Rabs_pos_eq _ r0) in G. apply split_abs in E, G. apply Rabs_le. unfold u in *. lra.
Qed.
End Coarse.

(* Both ways of evaluating an extremum, with the errors of phase and sine; `lost` is what stationarity leaves (pieces.v). *)
Section Decided.
Variables alpha_m c error rounding_ model A : R.
Hypotheses (am : 0 <= alpha_m) (HA : A = @ACOS_ERROR@) (m0 : 0 <= model) (r0 : u * alpha_m <= rounding_) (He : error = rounding_ + model).
Definition coarse := @COARSE@.
Definition refined := @REFINED@.
(* 1.6u of the sine, less than u/1000 lost: within the u alpha that `extremum` has to spare and the `k` that C1_model leaves. *)
Theorem coarse_holds : (1 + 32 * u) * model - alpha_m * k + ((1 + 8 * u) * (rounding_ - u * alpha_m) + alpha_m * (1.6 * u) + Rabs c * A) +
  alpha_m * (u / 1000) <= (1 - 60 * u) * coarse.
Proof. rewrite HA. unfold coarse. rewrite He. generalize (Rabs_pos c). unfold SLACK, k, u in *. intros. nra. Qed.
(* No use is made of what is to spare, so that the constant is seen. *)
Theorem refined_holds : (1 + 32 * u) * model + ((1 + 8 * u) * rounding_ + alpha_m * k) + alpha_m * (20 * A * A) <= (1 - 60 * u) * refined.
Proof. rewrite HA. unfold refined. rewrite He. unfold SLACK, k, u in *. nra. Qed.
End Decided.
