(* Lemma C3: velocity and sine at the root: `root` of src/contact/certify.rs, `arrive` and `acceleration_at` of src/flight.rs.
   A template: validation/bounds/prove fills in what stands between @ signs, from the source text.
   Underflow is left out here: `added` of every operation. *)
From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
Require Import rounding tools.
Open Scope R_scope.

(* |g'| <= h' from 0 on, both 0 at 0: then |g| <= h. *)
Lemma grows (g g' h h' : R -> R) (t : R) : 0 <= t -> (forall x, is_derive g x (g' x)) -> (forall x, is_derive h x (h' x)) -> (forall x, 0
  <= x <= t -> Rabs (g' x) <= h' x) -> g 0 = 0 -> h 0 = 0 -> Rabs (g t) <= h t.
Proof.
  intros t0 G H B g0 h0. destruct (Req_dec t 0) as [e|n]; [rewrite e, g0, h0, Rabs_R0; lra|].
  assert (up' : forall f f' : R -> R, (forall x, is_derive f x (f' x)) -> (forall x, 0 <= x <= t -> 0 <= f' x) -> f 0 = 0 -> 0 <= f t).
  { intros f f' F P z. destruct (MVT_cor2 f f' 0 t) as (c & e & r); [lra|intros x _; apply is_derive_Reals, F|].
    rewrite z in e. assert (0 <= f' c) by (apply P; lra). nra. }
  apply Rabs_le. split.
  - cut (0 <= h t + g t); [lra|]. apply (up' (fun x => h x + g x) (fun x => h' x + g' x)); [|intros x X; apply B, split_abs in X; lra|lra].
    intros x. apply (is_derive_plus h g); auto.
  - cut (0 <= h t - g t); [lra|]. apply (up' (fun x => h x - g x) (fun x => h' x - g' x)); [|intros x X; apply B, split_abs in X; lra|lra].
    intros x. apply (is_derive_minus h g); auto.
Qed.
(* Taylor's formula for sine and cosine, a step t back; first for t >= 0. *)
Ltac derive := match goal with |- is_derive (fun t => @?f t) ?x _ => auto_derive; [auto|unfold Rminus; field] end.
Ltac zero := rewrite Rminus_0_r; field.
Lemma sine_1st y t : 0 <= t -> Rabs (sin (y - t) - sin y) <= t.
Proof.
  intros H. apply (grows (fun t => sin (y - t) - sin y) (fun t => - cos (y - t)) (fun t => t) (fun _ => 1)); auto.
  - intros x. derive. - intros x. derive.
  - intros x _. rewrite Rabs_Ropp. apply Rabs_le, COS_bound. - zero.
Qed.
Lemma cosine_2nd y t : 0 <= t -> Rabs (cos (y - t) - cos y - t * sin y) <= t * t / 2.
Proof.
  intros H. apply (grows (fun t => cos (y - t) - cos y - t * sin y) (fun t => sin (y - t) - sin y) (fun t => t * t / 2) (fun t => t));
    auto; try lra.
  - intros x. derive. - intros x. derive.
  - intros x X. apply sine_1st. lra. - zero.
Qed.
Lemma cosine_1st y t : 0 <= t -> Rabs (cos (y - t) - cos y) <= t.
Proof.
  intros H. apply (grows (fun t => cos (y - t) - cos y) (fun t => sin (y - t)) (fun t => t) (fun _ => 1)); auto.
  - intros x. derive. - intros x. derive.
  - intros x _. apply Rabs_le, SIN_bound. - zero.
Qed.
Lemma sine_2nd y t : 0 <= t -> Rabs (sin (y - t) - (sin y - t * cos y)) <= t * t / 2.
Proof.
  intros H. apply (grows (fun t => sin (y - t) - (sin y - t * cos y)) (fun t => - (cos (y - t) - cos y)) (fun t => t * t / 2) (fun t =>
    t)); auto; try lra.
  - intros x. derive. - intros x. derive.
  - intros x X. rewrite Rabs_Ropp. apply cosine_1st. lra. - zero.
Qed.
Lemma cosine_3rd y t : 0 <= t -> Rabs (cos (y - t) - (cos y + t * sin y - t * t / 2 * cos y)) <= t * t * t / 6.
Proof.
  intros H. apply (grows (fun t => cos (y - t) - (cos y + t * sin y - t * t / 2 * cos y)) (fun t => sin (y - t) - (sin y - t * cos y)) (fun
    t => t * t * t / 6) (fun t => t * t / 2)); auto; try lra.
  - intros x. derive. - intros x. derive.
  - intros x X. apply sine_2nd. lra. - zero.
Qed.
(* And for any t and either wall. *)
Theorem cosine_taylor y t : Rabs (cos (y - t) - (cos y + t * sin y - t * t / 2 * cos y)) <= Rabs t * Rabs t * Rabs t / 6.
Proof.
  destruct (Rle_lt_dec 0 t) as [p|n]; [rewrite (Rabs_pos_eq t p); apply cosine_3rd; exact p|]. rewrite (Rabs_left t n).
  assert (H := cosine_3rd (- y) (- t)). rewrite cos_neg, sin_neg in H. replace (- y - - t) with (- (y - t)) in H by ring.
    rewrite cos_neg in H.
  replace (cos y + t * sin y - t * t / 2 * cos y) with (cos y + - t * - sin y - - t * - t / 2 * cos y) by field. apply H. lra.
Qed.
Theorem sine_taylor y t : Rabs (sin (y - t) - (sin y - t * cos y)) <= Rabs t * Rabs t / 2.
Proof.
  destruct (Rle_lt_dec 0 t) as [p|n]; [rewrite (Rabs_pos_eq t p); apply sine_2nd; exact p|]. rewrite (Rabs_left t n).
  assert (H := sine_2nd (- y) (- t)). rewrite cos_neg, sin_neg in H. replace (- y - - t) with (- (y - t)) in H by ring.
    rewrite sin_neg in H.
  replace (sin (y - t) - (sin y - t * cos y)) with (- (- sin (y - t) - (- sin y - - t * cos y))) by ring. rewrite Rabs_Ropp. apply H. lra.
Qed.
(* Velocity and sine at the root, `s + delta` before the iterate, from what is known there; `e` is the error of sine and cosine. *)
Section Arrival.
Variables sigma ua s_ c_ e be b beta_m r_beta w W s delta rho dist K E_w E_b e_s : R.
Notation S := (sine sigma ua).
Notation C := (cosine sigma ua).
@ARRIVE@
Hypotheses (sg : sign sigma) (e0 : 0 <= e <= 1 / 2) (HS : Rabs (s_ - S) <= e) (HC : Rabs (c_ - C) <= e).
Hypotheses (Hb : Rabs b <= beta_m) (Hbe : Rabs (be - b) <= r_beta) (Hbm : Rabs be <= beta_m).
Hypotheses (Hdelta : Rabs delta <= rho) (Hdist : Rabs s + rho <= (1 + 2 * u) * dist).
Notation d := ((1 + 2 * u) * dist).
Notation Y := (2 * PI * d).

Lemma turn_near : Rabs (TURN - 2 * PI) <= 2.5e-16. Proof. unfold TURN. interval with (i_prec 90). Qed.
Lemma lengths : Rabs s <= d /\ Rabs (s + delta) <= d /\ 0 <= rho /\ 0 <= d /\ 0 <= Y /\ 0 <= dist.
Proof.
  assert (T := Rabs_triang s delta). assert (A := Rabs_pos s). assert (B := Rabs_pos delta). assert (P := PI_above).
  assert (D0 : 0 <= d) by lra. repeat split; try lra; unfold u in *; try nra.
Qed.
Lemma turned_near : Rabs (turned - 2 * PI * s) <= 1.4 * u * Y /\ Rabs (2 * PI * s) <= Y.
Proof.
  destruct lengths as (L & _ & _ & D0 & Y0 & _). destruct Hturned as [_ [_ F]]. assert (T := turn_near). assert (P := PI_above).
    assert (Ps : PI < 3.1416) by interval. assert (Pb : 3.1415 < PI) by interval.
  assert (Q : Rabs (2 * PI * s) <= Y) by (rewrite Rabs_mult, (Rabs_pos_eq (2 * PI)) by lra; apply Rmult_le_compat_l; lra). split;
    [|exact Q].
  assert (Z : Rabs ((TURN - 2 * PI) * s) <= 2.5e-16 * d) by (rewrite Rabs_mult; apply Rmult_le_compat; auto using Rabs_pos).
  assert (Yd : 6.283 * d <= Y) by (apply Rmult_le_compat_r; lra). set (y := Y) in *. clearbody y.
  assert (G : Rabs (TURN * s) <= y + 2.5e-16 * d) by (replace (TURN * s) with ((TURN - 2 * PI) * s + 2 * PI * s) by ring; eapply Rle_trans;
    [apply Rabs_triang|lra]).
  assert (F' : Rabs (turned - TURN * s) <= u * (y + 2.5e-16 * d)) by (unfold u in *; lra).
  apply split_abs in Z, F'. apply Rabs_le. unfold u in *. lra.
Qed.
(* The wave: half a period's parabola. *)
Lemma wave_near : Rabs (turned * mean - 2 * PI * s * (S - PI * s * C)) <= Y * (e * (1 + 0.502 * Y) + u * (3.7 + 2.3 * Y)) /\ Rabs (turned *
  mean) <= Y * (1.51 + 0.77 * Y).
Proof.
  destruct turned_near as [N Q]. destruct lengths as (_ & _ & _ & _ & Y0 & _). destruct Hmean as [_ [_ F]]. rewrite <- Hhalf_turned in F.
  assert (LS := sine_1 sigma ua sg). assert (LC := cosine_1 sigma ua sg). set (S' := S) in *. set (C' := C) in *.
    set (g := 2 * PI * s) in *.
  replace (PI * s * C') with (g / 2 * C') by (unfold g; field). set (y := Y) in *. clearbody y g S' C'.
  assert (t1 : Rabs turned <= (1 + 1.4 * u) * y) by (apply split_abs in N, Q; apply Rabs_le; lra).
  assert (Lc : Rabs c_ <= 1.5) by (apply split_abs in HC, LC; apply Rabs_le; lra).
    assert (Ls : Rabs s_ <= 1.5) by (apply split_abs in HS, LS; apply Rabs_le; lra).
  product t1 HC. product N LC. product Q LC. product t1 Lc.
  assert (X : Rabs (-1 / 2 * turned * c_ + s_) <= 1.5 + 0.751 * y) by (apply Rabs_le; apply split_abs in Ls; unfold u in *; lra).

  assert (F' : Rabs (mean - (-1 / 2 * turned * c_ + s_)) <= u * (1.5 + 0.751 * y)) by (unfold u in *; lra).
  assert (ey : 0 <= e * y) by (apply Rmult_le_pos; lra).
  assert (M : Rabs (mean - (S' - g / 2 * C')) <= e * (1 + 0.501 * y) + u * (1.5 + 1.46 * y)).
  { apply split_abs in F', HS. apply Rabs_le. unfold u in *. lra. }
  assert (m0 : Rabs (S' - g / 2 * C') <= 1 + y / 2) by (apply split_abs in LS; apply Rabs_le; lra).
  product t1 M. product N m0. product Q m0.
  assert (yy : 0 <= y * y) by (apply Rmult_le_pos; lra). assert (eyy : 0 <= e * y * y) by (apply Rmult_le_pos; lra).
    assert (e2 : e * y <= / 2 * y) by (apply Rmult_le_compat_r; lra). assert (e3 := Rmult_le_compat_r y _ _ Y0 e2).
  split; apply Rabs_le; unfold u in *; lra.
Qed.

(* `bend`: the error of the computed second derivative, for an error `e_s` of the sine. *)
Definition bend_of := @MARGIN_bend@.
Definition jerk_of := @MARGIN_jerk@.
Lemma jerk_holds : 2 * PI * PI * beta_m <= jerk_of.
Proof.
  assert (B : 0 <= beta_m) by (generalize (Rabs_pos b); lra). replace jerk_of with (SLACK * TAU * TAU / 2 * beta_m) by (unfold jerk_of;
    field). apply Rmult_le_compat_r; [exact B|].
  unfold SLACK, TAU, u. interval with (i_prec 90).
Qed.
Hypothesis Hes : e <= e_s.
Section Acceleration.
@ACCELERATION@
Theorem C1_bend : Rabs (2 * PI * be * S - b2) <= bend_of.
Proof.
  assert (B := turn_near). assert (P := PI_above). assert (Ps : 3.1415 < PI < 3.1416) by (split; interval).
    assert (LS := sine_1 sigma ua sg). set (S' := S) in *.
  assert (bm : 0 <= beta_m) by (generalize (Rabs_pos b); lra). assert (rb : 0 <= r_beta) by (generalize (Rabs_pos (be - b)); lra).
  destruct Hturn_b as [_ [_ F]]. destruct Hb2 as [_ [_ G]].
  assert (T : Rabs (turn_b - 2 * PI * b) <= 1.4 * u * (2 * PI) * beta_m).
  { assert (Z : Rabs ((TURN - 2 * PI) * b) <= 2.5e-16 * beta_m) by (rewrite Rabs_mult; apply Rmult_le_compat; auto using Rabs_pos).
    assert (H : Rabs (TURN * b) <= 6.2833 * beta_m) by (rewrite Rabs_mult; apply Rmult_le_compat; auto using Rabs_pos;
      apply split_abs in B; apply Rabs_le; lra).
    apply split_abs in Z. assert (F' : Rabs (turn_b - TURN * b) <= u * (6.2833 * beta_m)) by (unfold u in *; lra). apply split_abs in F'.
    apply Rle_trans with (1.4 * u * 6.283 * beta_m); [apply Rabs_le; unfold u in *; lra|]. apply Rmult_le_compat_r; [exact bm|unfold u;
      lra]. }
  assert (Ls : Rabs s_ <= 1.5) by (apply split_abs in HS, LS; apply Rabs_le; lra).
    assert (p2 : Rabs (2 * PI) <= 2 * PI) by (rewrite Rabs_pos_eq; lra).
  assert (t1 : Rabs turn_b <= 6.3 * beta_m). { assert (Rabs (2 * PI * b) <= 6.2832 * beta_m) by (rewrite Rabs_mult; apply Rmult_le_compat;
    auto using Rabs_pos; lra).
    assert (T' : Rabs (turn_b - 2 * PI * b) <= 0.001 * beta_m). { apply Rle_trans with (1 := T). apply Rmult_le_compat_r; [exact bm|].
      unfold u. lra. } apply split_abs in T'. apply Rabs_le. generalize (split_abs _ _ H). lra. }
  assert (G' : Rabs (b2 - turn_b * s_) <= u * (6.3 * beta_m * 1.5)).
  { apply Rle_trans with (1 := G). apply Rmult_le_compat_l; [unfold u; lra|]. rewrite Rabs_mult. apply Rmult_le_compat;
    auto using Rabs_pos. }
  assert (A1 := abs_product _ _ _ _ T Ls). assert (A2 : Rabs (2 * PI * b * (s_ - S')) <= 2 * PI * (beta_m * e)).
  { rewrite Rabs_mult, Rabs_mult, (Rabs_pos_eq (2 * PI)), Rmult_assoc by lra. apply Rmult_le_compat_l; [lra|]. apply Rmult_le_compat;
    auto using Rabs_pos. }
  assert (A3 : Rabs (2 * PI * (be - b) * S') <= 2 * PI * r_beta).
  { rewrite Rabs_mult, Rabs_mult, (Rabs_pos_eq (2 * PI)), Rmult_assoc by lra. apply Rmult_le_compat_l; [lra|].
    rewrite <- (Rmult_1_r r_beta). apply Rmult_le_compat; auto using Rabs_pos. }
  apply split_abs in A2, A3, G'. assert (be' : beta_m * e <= beta_m * e_s) by (apply Rmult_le_compat_l; assumption).
    assert (bs : 0 <= beta_m * e_s) by (apply Rmult_le_pos; lra).
  assert (R : Rabs (2 * PI * be * S' - b2) <= 2 * PI * (beta_m * (e_s + 6 * u) + r_beta)).
  { assert (h1 : 2 * PI * (beta_m * e) <= 2 * PI * (beta_m * e_s)) by (apply Rmult_le_compat_l; lra).
    assert (h2 : 6.283 * beta_m <= 2 * PI * beta_m) by (apply Rmult_le_compat_r; lra).
    apply Rabs_le. unfold u in *. lra. }
  apply Rle_trans with (1 := R). replace bend_of with (SLACK * TAU * (beta_m * (e_s + 8 * u) + r_beta)) by (unfold bend_of, u; field).
  assert (T0 := TAU_above). apply Rmult_le_compat; [lra| |unfold SLACK, TAU in *; lra|unfold u in *; lra]. apply Rplus_le_le_0_compat;
    [|exact rb]. apply Rmult_le_pos; [exact bm|unfold u; lra].
Qed.
End Acceleration.

Ltac pos := repeat first [lra | apply Rabs_pos | apply Rmult_le_pos].
Variable J : R.
Hypotheses (HJ : 2 * PI * PI * Rabs be <= J) (HK : Rabs (2 * PI * be * S) <= K) (HE : TAU * (beta_m * (e + 8 * u) + r_beta) <= E_b).
Hypothesis HW : Rabs (W - w) <= (1 + 4 * u) * E_w.
Definition cubic := @CUBIC@.
Definition rest := @REST@.
Definition slope_ := @SLOPE@.
Notation t := (2 * PI * (s + delta)).
Theorem C3_velocity : Rabs (W + be * (C - cosine sigma (ua - (s + delta))) - v1) <= (1 + 32 * u) * (@VELOCITY_RADIUS@).
Proof.
  destruct lengths as (_ & L & r0 & D0 & Y0 & d0). destruct wave_near as [N M]. destruct turned_near as [_ Q]. assert (P := PI_above).
  assert (Ps : 3.14159 < PI < 3.1416) by (split; interval). assert (LS := sine_1 sigma ua sg). assert (LC := cosine_1 sigma ua sg).
    assert (be0 := Rabs_pos be).
  assert (bm : 0 <= beta_m) by (generalize (Rabs_pos b); lra). assert (rb : 0 <= r_beta) by (generalize (Rabs_pos (be - b)); lra).
  assert (Tt : Rabs t <= Y) by (rewrite Rabs_mult, (Rabs_pos_eq (2 * PI)) by lra; apply Rmult_le_compat_l; lra).
  (* The remainder. *)
  assert (R3 : Rabs (cosine sigma (ua - (s + delta)) - (C + t * S - t * t / 2 * C)) <= Y * Y * Y / 6).
  { apply Rle_trans with (Rabs t * Rabs t * Rabs t / 6).
    - assert (X := cosine_taylor (2 * PI * ua) t). unfold cosine, sine.
      replace (2 * PI * (ua - (s + delta))) with (2 * PI * ua - t) by ring.
      match goal with |- Rabs ?g <= _ => replace g with (sigma * (cos (2 * PI * ua - t) - (cos (2 * PI * ua) + t * sin (2 * PI * ua) - t *
        t / 2 * cos (2 * PI * ua)))) by ring end.
      rewrite Rabs_mult. replace (Rabs sigma) with 1; [lra|]. destruct sg as [e1|e1]; rewrite e1; [rewrite Rabs_R1|rewrite Rabs_left]; lra.
    - assert (t0 := Rabs_pos t). assert (Rabs t * Rabs t <= Y * Y) by (apply Rmult_le_compat; lra).
      assert (0 <= Rabs t * Rabs t) by (apply Rmult_le_pos; lra).
      assert (Rabs t * Rabs t * Rabs t <= Y * Y * Y) by (apply Rmult_le_compat; lra). lra. }
  assert (ddd : 0 <= d * d * d) by (pos). assert (J0 : 0 <= J) by (assert (0 <= 2 * PI * PI * Rabs be) by (pos); lra).
  assert (H1 : Rabs (be * (cosine sigma (ua - (s + delta)) - (C + t * S - t * t / 2 * C))) <= 2.0945 * (J * (d * d * d))).
  { rewrite Rabs_mult. apply Rle_trans with (Rabs be * (Y * Y * Y / 6)); [apply Rmult_le_compat_l; assumption|].
    replace (Rabs be * (Y * Y * Y / 6)) with ((2 * PI / 3) * ((2 * PI * PI * Rabs be) * (d * d * d))) by field.
    apply Rmult_le_compat; [lra| |interval|apply Rmult_le_compat_r; assumption]. apply Rmult_le_pos; [|exact ddd]. pos. }
  (* From the end of the step to the root. *)
  assert (H2 : Rabs (be * (t * S - t * t / 2 * C - 2 * PI * s * (S - PI * s * C))) <= rho * K + rho * (2 * (J * d))).
  { replace (be * (t * S - t * t / 2 * C - 2 * PI * s * (S - PI * s * C))) with (delta * (2 * PI * be * S) - delta * (2 * PI * be * ((t + 2
    * PI * s) / 2) * C)) by field.
    assert (A1 := abs_product _ _ _ _ Hdelta HK).
    assert (A2 : Rabs (2 * PI * be * ((t + 2 * PI * s) / 2) * C) <= 2 * (J * d)).
    { assert (Z : Rabs ((t + 2 * PI * s) / 2) <= Y) by (apply split_abs in Tt, Q; apply Rabs_le; lra).
      rewrite Rabs_mult, Rabs_mult, Rabs_mult, (Rabs_pos_eq (2 * PI)) by lra. apply Rle_trans with (2 * PI * Rabs be * Y * 1).
      - apply Rmult_le_compat; auto using Rabs_pos; [pos|]. apply Rmult_le_compat_l; [pos|exact Z].
      - replace (2 * PI * Rabs be * Y * 1) with (2 * ((2 * PI * PI * Rabs be) * d)) by ring. apply Rmult_le_compat_l; [lra|].
        apply Rmult_le_compat_r; assumption. }
    assert (A3 := abs_product _ _ _ _ Hdelta A2). apply Rabs_le. lra. }
  (* The computed step. *)
  set (m0 := 2 * PI * s * (S - PI * s * C)) in *. set (wave := turned * mean) in *.
  assert (m0' : Rabs m0 <= Y * (1 + Y / 2)).
  { unfold m0. replace (2 * PI * s * (S - PI * s * C)) with (2 * PI * s * (S - (2 * PI * s) / 2 * C)) by field. rewrite Rabs_mult.
    apply Rmult_le_compat; auto using Rabs_pos.
    assert (X := abs_product _ _ _ _ Q LC). apply split_abs in LS. apply Rabs_le. lra. }
  assert (A4 := abs_product _ _ _ _ Hbe m0'). assert (A5 := abs_product _ _ _ _ Hb N).
  assert (A6 : Rabs (b_turned * mean + b * wave) <= u * (beta_m * (Y * (1.51 + 0.77 * Y)))).
  { destruct Hb_turned as [_ [_ F]]. replace (b_turned * mean + b * wave) with ((b_turned - - b * turned) * mean) by (unfold wave; ring).
    rewrite Rabs_mult.
    apply Rle_trans with (u * Rabs (- b * turned) * Rabs mean); [apply Rmult_le_compat_r; [apply Rabs_pos|exact F]|].
    rewrite Rmult_assoc, <- Rabs_mult. replace (- b * turned * mean) with (- b * wave) by (unfold wave; ring). rewrite Rabs_mult, Rabs_Ropp.
    apply Rmult_le_compat_l; [unfold u; lra|]. apply Rmult_le_compat; auto using Rabs_pos. }
  set (y := Y) in *. assert (yd : y <= 6.2832 * d) by (apply Rmult_le_compat_r; lra).
  set (q := beta_m * (e + 8 * u) + r_beta) in *. assert (q0 : 0 <= q) by (unfold q; apply Rplus_le_le_0_compat; [apply Rmult_le_pos;
    [|unfold u]; lra|exact rb]).
  assert (H3 : Rabs (be * m0 - b * wave) + u * (beta_m * (y * (1.51 + 0.77 * y))) <= y * q * (1 + 0.63 * y)).
  { assert (bY : 0 <= beta_m * y) by (apply Rmult_le_pos; lra). assert (bYY : 0 <= beta_m * y * y) by (apply Rmult_le_pos; lra).
    assert (beYY : 0 <= beta_m * y * y * e) by (apply Rmult_le_pos; lra).
    assert (rY : 0 <= r_beta * y * y) by (pos).
    assert (X : Rabs (be * m0 - b * wave) <= y * q * (1 + 0.63 * y) - u * (beta_m * (y * (1.51 + 0.77 * y)))); [|lra].
    apply split_abs in A6. apply Rabs_le. unfold q, u in *. lra. }
  assert (E0 : 0 <= E_b) by (apply Rle_trans with (2 := HE); apply Rmult_le_pos; [unfold TAU|]; lra).
  assert (H4 : y * q * (1 + 0.63 * y) <= E_b * d * (1 + 3.96 * d)).
  { assert (yq : y * q <= E_b * d). { apply Rle_trans with (TAU * q * d); [|apply Rmult_le_compat_r; assumption]. unfold y.
    generalize TAU_above. intros.
      replace (TAU * q * d) with (TAU * d * q) by ring. apply Rmult_le_compat_r; [exact q0|]. apply Rmult_le_compat_r; assumption. }
    apply Rmult_le_compat; [apply Rmult_le_pos; assumption|lra|exact yq|lra]. }
  destruct Hv1 as [F _]. assert (Ed : 0 <= E_b * dist) by (apply Rmult_le_pos; lra).
    assert (Edd : 0 <= E_b * dist * dist) by (apply Rmult_le_pos; lra).
  assert (Jr : 0 <= J * rho * dist) by (pos). assert (Jd : 0 <= J * dist * dist * dist) by (pos).
  assert (K0 : 0 <= K) by (generalize (Rabs_pos (2 * PI * be * S)); lra). assert (Kr : 0 <= K * rho) by (apply Rmult_le_pos; lra).
  assert (Ew : 0 <= E_w) by (generalize (Rabs_pos (W - w)); unfold u in *; lra). assert (B := binade_le v1).
  clearbody y q. set (cc := cosine sigma (ua - (s + delta))) in *. set (SS := S) in *. set (CC := C) in *.
  assert (H5 : Rabs (be * m0 - b * wave + (b_turned * mean + b * wave)) <= E_b * d * (1 + 3.96 * d)) by (eapply Rle_trans;
    [apply Rabs_triang|lra]).
  replace (W + be * (CC - cc) - v1) with ((W - w) - be * (cc - (CC + t * SS - t * t / 2 * CC)) - be * (t * SS - t * t / 2 * CC - m0) - (be
    * m0 - b * wave + (b_turned * mean + b * wave)) - (v1 - (b_turned * mean + w))) by ring.
  assert (V : Rabs ((W - w) - be * (cc - (CC + t * SS - t * t / 2 * CC)) - be * (t * SS - t * t / 2 * CC - m0) - (be * m0 - b * wave +
    (b_turned * mean + b * wave)) - (v1 - (b_turned * mean + w)))
    <= (1 + 4 * u) * E_w + 2.0945 * (J * (d * d * d)) + (rho * K + rho * (2 * (J * d))) + E_b * d * (1 + 3.96 * d) + u * binade v1).
  { apply split_abs in HW, H1, H2, H5, F. apply Rabs_le. lra. }
  apply Rle_trans with (1 := V). unfold rest, cubic, slope_. clear - Ed Edd Jr Jd K0 Kr Ew B. unfold SLACK, u in *. lra.
Qed.

(* The sine; `e_s` holds one u for the rounding of its own last operation. *)
Hypothesis Hroom : e + u <= e_s.
Theorem C3_sine : Rabs (sine sigma (ua - (s + delta)) - sin1) <= (1 - 24 * u) * @SINE_RADIUS@.
Proof.
  destruct lengths as (_ & L & r0 & D0 & Y0 & d0). destruct turned_near as [N Q]. assert (P := PI_above).
    assert (Ps : 3.14159 < PI < 3.1416) by (split; interval).
  assert (LS := sine_1 sigma ua sg). assert (LC := cosine_1 sigma ua sg).
  assert (Tt : Rabs t <= Y) by (rewrite Rabs_mult, (Rabs_pos_eq (2 * PI)) by lra; apply Rmult_le_compat_l; lra).
  assert (R2 : Rabs (sine sigma (ua - (s + delta)) - (S - t * C)) <= 19.74 * (d * d)).
  { apply Rle_trans with (Rabs t * Rabs t / 2).
    - assert (X := sine_taylor (2 * PI * ua) t). unfold cosine, sine. replace (2 * PI * (ua - (s + delta))) with (2 * PI * ua - t) by ring.
      match goal with |- Rabs ?g <= _ => replace g with (sigma * (sin (2 * PI * ua - t) - (sin (2 * PI * ua) - t * cos (2 * PI * ua)))) by
        ring end.
      rewrite Rabs_mult. replace (Rabs sigma) with 1; [lra|]. destruct sg as [e1|e1]; rewrite e1; [rewrite Rabs_R1|rewrite Rabs_left]; lra.
    - assert (t0 := Rabs_pos t). assert (Rabs t * Rabs t <= Y * Y) by (apply Rmult_le_compat; lra).
      assert (Y * Y = 4 * PI * PI * (d * d)) by ring. assert (4 * PI * PI <= 39.479) by interval.
        assert (0 <= d * d) by (apply Rmult_le_pos; lra). nra. }
  assert (step : Rabs (2 * PI * delta * C) <= TAU * rho).
  { rewrite Rabs_mult, Rabs_mult, (Rabs_pos_eq (2 * PI)) by lra. rewrite <- (Rmult_1_r (TAU * rho)). apply Rmult_le_compat;
    auto using Rabs_pos; [apply Rmult_le_pos; [lra|apply Rabs_pos]|].
    generalize TAU_above. intros. apply Rmult_le_compat; auto using Rabs_pos; lra. }
  assert (t1 : Rabs turned <= (1 + 1.4 * u) * Y) by (apply split_abs in N, Q; apply Rabs_le; lra).
  assert (A1 := abs_product _ _ _ _ t1 HC). assert (A2 := abs_product _ _ _ _ N LC). assert (A3 := abs_product _ _ _ _ Q LC).
    destruct Hsin1 as [_ [_ F]].
  assert (yd : Y <= 6.2832 * d) by (apply Rmult_le_compat_r; lra). set (y := Y) in *. set (SS := S) in *. set (CC := C) in *.
    set (sn := sine sigma (ua - (s + delta))) in *.
  assert (ey : 0 <= e * y) by (apply Rmult_le_pos; lra). assert (ed : e * y <= e * (6.2832 * d)) by (apply Rmult_le_compat_l; lra).
  assert (X : Rabs (- turned * c_ + s_) <= 1 + e + 1.01 * (y + e * y)) by (apply split_abs in LS, HS; apply Rabs_le; unfold u in *; lra).
  assert (F' : Rabs (sin1 - (- turned * c_ + s_)) <= u * (1 + e + 1.01 * (y + e * y))) by (unfold u in *; lra).
  assert (V : Rabs (sn - sin1) <= 19.74 * (d * d) + TAU * rho + (1 + 1.4 * u) * (e * y) + 1.4 * u * y + e + u * (1 + e + 1.01 * (y + e *
    y))).
  { replace (t * CC) with (2 * PI * s * CC + 2 * PI * delta * CC) in R2 by ring. apply split_abs in R2, step, F', HS. apply Rabs_le. lra. }
  apply Rle_trans with (1 := V). assert (sq := Rle_0_sqr (dist - 16 * u)). unfold Rsqr in sq.
    assert (dd : 0 <= dist * dist) by (apply Rmult_le_pos; lra).
  assert (tr : 0 <= TAU * rho) by (apply Rmult_le_pos; [unfold TAU|]; lra). assert (edist : 0 <= e * dist) by (apply Rmult_le_pos; lra).
  assert (es7 : (e + u) * (1 + 7 * dist) <= e_s * (1 + 7 * dist)) by (apply Rmult_le_compat_r; lra).
  apply Rle_trans with ((1 - 24 * u) * (SLACK * ((e + u) * (1 + 7 * dist) + TAU * rho + 20 * (dist * dist)))).
  - clear - sq dd tr edist yd ed ey d0 e0. unfold SLACK, u in *. lra.
  - apply Rmult_le_compat_l; [unfold u; lra|]. match goal with |- _ <= ?r => replace r with (SLACK * (e_s * (1 + 7 * dist) + TAU * rho + 20
    * (dist * dist))) by (field || ring) end.
    apply Rmult_le_compat_l; [unfold SLACK, u; lra|]. lra.
Qed.
End Arrival.

(* What `bracket` and `hop_bracket` give as `sine_error`. *)
Theorem C3_sine_error : k + u <= @SINE_ERROR@.
Proof. unfold k, u. lra. Qed.
