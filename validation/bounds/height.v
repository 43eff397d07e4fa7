(* Lemmas C1 and C2: `height_above` and `velocity_at` of src/flight.rs against the flight, within the bounds of src/contact/bounds.rs.
   A template: validation/bounds/prove fills in what stands between @ signs, from the source text. *)
From Coq Require Import Reals Lra Lia.
From Interval Require Import Tactic.
Require Import rounding tools.
Open Scope R_scope.

Section Height.
(* Doubles: parameters, start, arrival; `c` is the drift. Truths: parameters, start of the height, sines and cosine. *)
Variables a b w s0 c0 s1 u0 u1 N z0 target al be z0t S0 C0 S1 : R.
Variables alpha_m beta_m r_alpha r_beta r_u r_w r_z T spare : R.
@HEIGHT@
Hypotheses (Ha : Rabs a <= alpha_m) (Hal : Rabs (al - a) <= r_alpha) (Hb : Rabs b <= beta_m) (Hbe : Rabs (be - b) <= r_beta).
Hypotheses (Hs0 : Rabs (s0 - S0) <= k) (Hc0 : Rabs (c0 - C0) <= k) (Hs1 : Rabs (s1 - S1) <= k).
Hypotheses (LS0 : Rabs S0 <= 1) (LC0 : Rabs C0 <= 1) (LS1 : Rabs S1 <= 1).
Hypotheses (Ht : Rabs (N + (u1 - u0)) <= (1 + 6 * u) * T) (T0 : 0 <= T).
(* Underflow: from a wall T is at least an eighth, from inside r_z has room. *)
Hypotheses (Hunder : 16 * eta <= tiny * T + spare) (Hspare : 0 <= spare).

Definition centre := z0 + (w + be * C0) * (N + (u1 - u0)) - al * (S1 - S0) - target.
Definition rounding_part := u * (Rabs c * (2 * T + 2 * Rabs N) + alpha_m * Rabs s1_s0 + 3 * Rabs z).
Definition drift_part := u * binade c + eta + beta_m * k + r_beta.

Theorem height_at_the_centre : Rabs (z - centre - (z0_target - (z0 - target))) <= (1 + 16 * u) * (rounding_part + drift_part * T + 2 *
  alpha_m * k + 2 * r_alpha) + 8 * eta.
Proof.
  destruct (added_size _ _ Hu1_u0) as [F _]. destruct Hc as [Ec _]. apply split_abs in Ec.
  weak Hs1_s0. weak Hu1_u0. weak Hwave. weak Hrest. weak Hz.
  assert (Sizes : Rabs u1_u0 <= (1 + 2 * u) * (T * (1 + 6 * u) + Rabs N)).
  { assert (V : Rabs (u1 - u0) <= Rabs (N + (u1 - u0)) + Rabs N).
    { replace (u1 - u0) with (N + (u1 - u0) + - N) at 1 by ring. rewrite <- (Rabs_Ropp N). apply Rabs_triang. }
    assert (Q := Rabs_pos N). unfold u in *. lra. }
  assert (E2 : Rabs (u1_u0 - (u1 - u0)) <= u * ((1 + 2 * u) * (T * (1 + 6 * u) + Rabs N))) by (apply Rabs_le; unfold u in *; lra).
  assert (Es : Rabs (s1_s0 - (S1 - S0)) <= 2 * k + u * Rabs s1_s0) by (apply split_abs in Hs0, Hs1; apply Rabs_le; lra).
  assert (Ed : Rabs (S1 - S0) <= 2) by (apply split_abs in LS0, LS1; apply Rabs_le; lra).
  product Ha Es. product Hal Ed. product Hb Hc0. product Hbe LC0.
  assert (Dc : Rabs (c - (w + be * C0)) <= drift_part) by (unfold drift_part; apply Rabs_le; lra).
  product Dc Ht. product (Rle_refl (Rabs c)) Ht. product (Rle_refl (Rabs c)) E2. product (Rle_refl (Rabs c)) (Rle_refl (Rabs N)).
  assert (Z := abs_self z). assert (W := abs_self wave). assert (V := abs_self rest).
  assert (c00 := Rabs_pos c). assert (N00 := Rabs_pos N). assert (z00 := Rabs_pos z). assert (s00 := Rabs_pos s1_s0).
    assert (e00 := eta_positive).
  positive (Rabs c) T. positive (Rabs c) (Rabs N). assert (am : 0 <= alpha_m) by (generalize (Rabs_pos a); lra).
    positive alpha_m (Rabs s1_s0).
  assert (d0 : 0 <= drift_part) by (generalize (Rabs_pos (c - (w + be * C0))); lra). positive drift_part T.
  assert (ra0 : 0 <= r_alpha) by (generalize (Rabs_pos (al - a)); lra).
  (* The sizes of what the first two operations give. *)
  assert (R1 : Rabs rest <= (1 + u) * Rabs z + eta + Rabs c * Rabs N) by (apply Rabs_le; lra).
  assert (R2 : Rabs wave <= (1 + u) * Rabs z + 2 * eta + u * Rabs rest + Rabs c * ((1 + 6 * u) * T) + Rabs c * (u * ((1 + 2 * u) * (T * (1
    + 6 * u) + Rabs N)))).
  { apply Rabs_le. lra. }
  apply Rabs_le. unfold centre, rounding_part. unfold k, u in *. lra.
Qed.
(* Now for every start within the radii, against the bound of the source text. *)
Variables sigma x w1 : R.
Hypotheses (sg : sign sigma) (eb : be = 2 * PI * al) (ES0 : S0 = sine sigma u0) (EC0 : C0 = cosine sigma u0).
Hypotheses (Hx : Rabs (x - u0) <= r_u) (Hw : Rabs (w1 - w) <= r_w) (Hbm : Rabs be <= beta_m).
Hypothesis Hstart : Rabs (z0t - z0) + Rabs (z0_target - (z0 - target)) + spare <= r_z.
Definition flight_height := z0t + (w1 + be * cosine sigma x) * (N + (u1 - x)) - al * (S1 - sine sigma x) - target.

Notation acceleration := (acceleration_of beta_m).
Notation drift_error := (drift_error_of beta_m r_beta c).
Notation tilt := (tilt_of beta_m r_u s0).
Notation waves := (waves_of alpha_m r_alpha).
Definition height_bound_wide := @HEIGHT_WIDE@.
Definition height_bound_narrow := @HEIGHT_NARROW@.
Definition model_error := drift_error * (T + r_u) + waves + (r_z + r_w * (T + r_u) + r_u * (Rabs w + r_w + tilt * (T + r_u))).

Lemma tilt_holds : 2 * PI * Rabs be * (Rabs (sine sigma u0) + 2 * PI * r_u) <= tilt.
Proof.
  rewrite <- ES0. assert (ru0 : 0 <= r_u) by (generalize (Rabs_pos (x - u0)); lra). assert (TA := TAU_above). assert (P := PI_above).
  assert (S : Rabs S0 <= Rabs s0 + k) by (apply split_abs in Hs0; apply Rabs_le; generalize (abs_self s0); lra).
  assert (b0 := Rabs_pos be). assert (z00 := Rabs_pos S0). unfold tilt_of, acceleration_of.
  apply Rmult_le_compat.
  - apply Rmult_le_pos; lra.
  - apply Rplus_le_le_0_compat; [lra|apply Rmult_le_pos; lra].
  - apply Rmult_le_compat; try lra. unfold SLACK, u. lra.
  - assert (2 * PI * r_u <= TAU * r_u) by (apply Rmult_le_compat_r; lra). unfold k in *. lra.
Qed.

Lemma spread : Rabs (flight_height - centre - (z0t - z0)) <= r_w * ((1 + 6 * u) * (T + r_u)) + r_u * (Rabs w + tilt * ((1 + 6 * u) * (T +
  r_u))).
Proof.
  assert (ru0 : 0 <= r_u) by (generalize (Rabs_pos (x - u0)); lra).
  assert (H := spread_of_starts sigma al be S1 (N + u1) u0 x w w1 r_u r_w ((1 + 6 * u) * (T + r_u)) tilt sg eb Hx Hw).
  replace (flight_height - centre - (z0t - z0)) with ((w1 + be * cosine sigma x) * (N + u1 - x) - al * (S1 - sine sigma x) - ((w + be *
    cosine sigma u0) * (N + u1 - u0) - al * (S1 - sine sigma u0)))
    by (unfold flight_height, centre; rewrite ES0, EC0; ring).
  apply H; [|exact tilt_holds]. replace (N + u1 - u0) with (N + (u1 - u0)) by ring. unfold u in *. lra.
Qed.

Lemma signs : 0 <= r_u /\ 0 <= r_w /\ 0 <= tilt /\ 0 <= r_beta /\ 0 <= beta_m /\ 0 <= drift_part /\ drift_part + tiny / 2 <= drift_error.
Proof.
  assert (ru0 : 0 <= r_u) by (generalize (Rabs_pos (x - u0)); lra). assert (rw0 : 0 <= r_w) by (generalize (Rabs_pos (w1 - w)); lra).
  assert (H := tilt_holds). assert (b0 := Rabs_pos be). assert (z00 := Rabs_pos (sine sigma u0)). assert (P := PI_above).
  assert (rb0 : 0 <= r_beta) by (generalize (Rabs_pos (be - b)); lra). assert (bm0 : 0 <= beta_m) by lra. assert (B := binade_le c).
  assert (0 <= tilt). { apply Rle_trans with (2 := H). apply Rmult_le_pos; [apply Rmult_le_pos; lra|]. apply Rplus_le_le_0_compat;
    [lra|apply Rmult_le_pos; lra]. }
  assert (e0 := eta_positive). unfold drift_part, drift_error_of, drift_margin. rewrite tiny_eta. unfold k, SLACK, u in *.
  repeat split; lra.
Qed.

Theorem C1 : Rabs (z - flight_height) + 7 * u * Rabs z <= (1 + 32 * u) * height_bound_wide.
Proof.
  assert (H := height_at_the_centre). assert (G := spread). destruct signs as (ru0 & rw0 & t0 & rb0 & bm0 & d0 & dd).
  destruct (added_size _ _ Hs1_s0) as [F _]. assert (am : 0 <= alpha_m) by (generalize (Rabs_pos a); lra).
  assert (ra0 : 0 <= r_alpha) by (generalize (Rabs_pos (al - a)); lra). apply (Rmult_le_compat_l alpha_m _ _ am) in F.
  assert (P1 : 0 <= r_w * (T + r_u)) by (apply Rmult_le_pos; lra). assert (P2 : 0 <= tilt * (T + r_u)) by (apply Rmult_le_pos; lra).
  assert (P3 : 0 <= r_u * (tilt * (T + r_u))) by (apply Rmult_le_pos; lra). assert (P4 : 0 <= r_u * Rabs w) by (apply Rmult_le_pos;
    auto using Rabs_pos).
  assert (P5 : 0 <= r_u * r_w) by (apply Rmult_le_pos; lra).
  assert (P6 := Rmult_le_compat_r T _ _ T0 dd). assert (P7 : 0 <= drift_error * r_u) by (apply Rmult_le_pos; [generalize eta_positive;
    rewrite tiny_eta in dd|]; lra).
  assert (P8 : 0 <= drift_part * T) by (apply Rmult_le_pos; lra).
  assert (c00 := Rabs_pos c). assert (N00 := Rabs_pos N). assert (z00 := Rabs_pos z). assert (e00 := eta_positive).
  positive (Rabs c) T. positive (Rabs c) (Rabs N). positive alpha_m (Rabs (s1 - s0)). positive alpha_m (Rabs s1_s0).
  assert (A1 := Rabs_pos (z0t - z0)). assert (A2 := Rabs_pos (z0_target - (z0 - target))).
  assert (B1' := abs_self (z0t - z0)). assert (B2 := abs_self (z0_target - (z0 - target))).
  apply split_abs in H, G.
  assert (R : Rabs (z - flight_height) <= (1 + 32 * u) * height_bound_wide - 7 * u * Rabs z).
  { apply Rabs_le. unfold height_bound_wide, rounding_part, waves_of in *. set (tl := tilt) in *. set (de := drift_error) in *.
    set (dp := drift_part) in *.
    unfold k, SLACK, u in *. lra. }
  lra.
Qed.
Theorem C1_narrow : r_u = 0 -> height_bound_narrow = height_bound_wide.
Proof. intros e. unfold height_bound_narrow, height_bound_wide. rewrite e. ring. Qed.

(* Lemma C2. *)
Variables c1 C1' : R.
Hypothesis Hc1 : Rabs (c1 - C1') <= k.
Hypothesis LC1 : Rabs C1' <= 1.
@VELOCITY@
Definition flight_velocity := w1 + be * cosine sigma x - be * C1'.
Notation velocity_margin := (velocity_margin beta_m r_beta).
Definition velocity_bound_wide := @VELOCITY_WIDE@.
Definition velocity_bound_narrow := @VELOCITY_NARROW@.
Theorem C2 : Rabs (v - flight_velocity) <= (1 + 4 * u) * velocity_bound_wide.
Proof.
  destruct signs as (ru0 & rw0 & t0 & rb0 & bm0 & d0 & dd). destruct Hc as [Ec _]. destruct Hv as [Ev _]. apply split_abs in Ec, Ev.
  assert (Th := tilt_holds). assert (Cn := cosine_near sigma u0 x sg). assert (S00 := Rabs_pos (sine sigma u0)). assert (P := PI_above).
    assert (be0 := Rabs_pos be).
  assert (X : Rabs (be * (cosine sigma x - cosine sigma u0)) <= tilt * r_u).
  { rewrite Rabs_mult. apply Rle_trans with (Rabs be * (2 * PI * (Rabs (sine sigma u0) + 2 * PI * r_u) * r_u)).
    - apply Rmult_le_compat_l; [lra|]. apply Rle_trans with (1 := Cn). apply Rmult_le_compat; auto using Rabs_pos.
      + apply Rmult_le_pos; [lra|]. apply Rplus_le_le_0_compat; [lra|]. apply Rmult_le_pos; [lra|apply Rabs_pos].
      + apply Rmult_le_compat_l; [lra|]. apply Rplus_le_compat_l. apply Rmult_le_compat_l; lra.
    - replace (Rabs be * (2 * PI * (Rabs (sine sigma u0) + 2 * PI * r_u) * r_u)) with (2 * PI * Rabs be * (Rabs (sine sigma u0) + 2 * PI *
      r_u) * r_u) by ring.
      apply Rmult_le_compat_r; lra. }
  product Hb Hc0. product Hbe LC0. product Hb Hc1. product Hbe LC1. apply split_abs in X. apply split_abs in Hw.
  assert (t1 : 0 <= tilt * r_u) by (apply Rmult_le_pos; lra). assert (B := binade_le c). assert (B' := binade_le v).
    assert (e0 := eta_positive).
  assert (rwu : 0 <= r_w) by lra. rewrite EC0 in *. apply Rabs_le. unfold velocity_bound_wide, flight_velocity, tools.velocity_margin.
    rewrite tiny_eta.
  set (tl := tilt) in *. unfold k, SLACK, u in *. lra.
Qed.
Theorem C2_narrow : r_u = 0 -> velocity_bound_narrow = velocity_bound_wide.
Proof. intros e. unfold velocity_bound_narrow, velocity_bound_wide. rewrite e. ring. Qed.

(* C1 at an extremum: the flight of the computed parameters against the true one, at the same phase. *)
Definition computed_flight := z0 + c * (N + (u1 - u0)) - a * (S1 - s0) - target.
(* One of the two sines is exact here: `k` of the bound is left. *)
Theorem C1_model : Rabs (computed_flight - flight_height) <= (1 + 32 * u) * model_error - alpha_m * k.
Proof.
  assert (G := spread). destruct signs as (ru0 & rw0 & t0 & rb0 & bm0 & d0 & dd). destruct Hc as [Ec _]. apply split_abs in Ec.
  assert (am : 0 <= alpha_m) by (generalize (Rabs_pos a); lra). assert (ra0 : 0 <= r_alpha) by (generalize (Rabs_pos (al - a)); lra).
  assert (Ed : Rabs (S1 - S0) <= 2) by (apply split_abs in LS0, LS1; apply Rabs_le; lra).
  product Hb Hc0. product Hbe LC0. product Ha Hs0. product Hal Ed.
  assert (Dc : Rabs (c - (w + be * C0)) <= drift_part) by (unfold drift_part; apply Rabs_le; lra). product Dc Ht.
  assert (O1 : 0 <= r_w * (T + r_u)) by (apply Rmult_le_pos; lra). assert (O2 : 0 <= tilt * (T + r_u)) by (apply Rmult_le_pos; lra).
  assert (O3 : 0 <= r_u * (tilt * (T + r_u))) by (apply Rmult_le_pos; lra). assert (O4' : 0 <= r_u * Rabs w) by (apply Rmult_le_pos;
    auto using Rabs_pos).
  assert (O5 : 0 <= r_u * r_w) by (apply Rmult_le_pos; lra). assert (O6 := Rmult_le_compat_r T _ _ T0 dd).
  assert (O7 : 0 <= drift_error * r_u) by (apply Rmult_le_pos; [generalize eta_positive; rewrite tiny_eta in dd|]; lra).
  assert (O8 : 0 <= drift_part * T) by (apply Rmult_le_pos; lra). assert (e00 := eta_positive).
    assert (O9 : 0 <= tiny / 2 * T) by (apply Rmult_le_pos; [rewrite tiny_eta|]; lra).
  assert (A1 := abs_self (z0t - z0)). assert (A2 := Rabs_pos (z0_target - (z0 - target))). assert (A3 := Rabs_pos (z0t - z0)).
  apply split_abs in G. apply Rabs_le. unfold model_error, computed_flight, centre, waves_of in *.
  set (tl := tilt) in *. set (de := drift_error) in *. set (dp := drift_part) in *. unfold k, SLACK, u in *. lra.
Qed.
End Height.
