(* Lemmas C1 and C2 for hops: `hop_height`, `hop_velocity` and `turned` of src/flight.rs within the bounds of src/contact/bounds.rs.
   A template: validation/bounds/prove fills in what stands between @ signs, from the source text. *)
From Coq Require Import Reals Lra Lia.
From Interval Require Import Tactic.
Require Import rounding tools.
Open Scope R_scope.

(* A hop: `p` and `q` are two of versine, excess and sine of its time, each with the relative error D. *)
Lemma wave_error c0 C0 s0 S0 p P q Q sq wave : Rabs (c0 - C0) <= k -> Rabs (s0 - S0) <= k -> Rabs C0 <= 1 -> Rabs S0 <= 1 ->
  0 <= P -> / 2 ^ 700 <= Q -> Rabs (p - P) <= D * P -> Rabs (q - Q) <= D * Q ->
  fused (s0 * q) sq -> fused (c0 * p + sq) wave ->
  Rabs (wave - (C0 * P + S0 * Q)) <= (k + D + 2 * u + 64 * u * u) * (P + Q) /\ Rabs (C0 * P + S0 * Q) <= P + Q /\ eta <= u * u * u * (P +
    Q).
Proof.
  intros Hc Hs LC LS P0 Q0 Hp Hq [_ [_ F1]] [_ [_ F2]]. assert (g := eta_small). assert (small : 0 < / 2 ^ 700) by interval.
  assert (e1 : eta <= u * u * u * (/ 2 ^ 700)) by (apply Rle_trans with (1 := g); unfold u; interval). assert (e0 := eta_positive).
  assert (Lc : Rabs c0 <= 1 + k) by (apply split_abs in Hc, LC; apply Rabs_le; lra).
    assert (Ls : Rabs s0 <= 1 + k) by (apply split_abs in Hs, LS; apply Rabs_le; lra).
  assert (RP : Rabs P <= P) by (rewrite Rabs_pos_eq; lra). assert (RQ : Rabs Q <= Q) by (rewrite Rabs_pos_eq; lra).
  product Hc RP. product Hs RQ. product Lc Hp. product Ls Hq. product LC RP. product LS RQ.
  assert (X1 : Rabs (s0 * q) <= (1 + k) * ((1 + D) * Q)) by (rewrite Rabs_mult; apply Rmult_le_compat; auto using Rabs_pos;
    apply split_abs in Hq; apply Rabs_le; unfold D, u in *; lra).
  assert (F1' : Rabs (sq - s0 * q) <= u * ((1 + k) * ((1 + D) * Q)) + eta) by (unfold u in *; lra). apply split_abs in F1'.
  assert (X2 : Rabs (c0 * p) <= (1 + k) * ((1 + D) * P)) by (rewrite Rabs_mult; apply Rmult_le_compat; auto using Rabs_pos;
    apply split_abs in Hp; apply Rabs_le; unfold D, u in *; lra).
  apply split_abs in X1, X2.
  assert (X3 : Rabs (c0 * p + sq) <= (1 + 16 * u) * (P + Q)) by (apply Rabs_le; unfold k, D, u in *; lra).
  assert (F2' : Rabs (wave - (c0 * p + sq)) <= u * ((1 + 16 * u) * (P + Q)) + eta) by (unfold u in *; lra). apply split_abs in F2'.
  split; [|split]; [apply Rabs_le; unfold k, D, u in *; lra|apply Rabs_le; lra|unfold u in *; lra].
Qed.
(* Another phase of the start. *)
Lemma wave_spread sigma u0 x P Q r_u : sign sigma -> 0 <= P -> 0 <= Q -> Rabs (x - u0) <= r_u ->
  Rabs (cosine sigma x * P + sine sigma x * Q - (cosine sigma u0 * P + sine sigma u0 * Q)) <= 2 * PI * r_u * (P + Q).
Proof.
  intros s P0 Q0 H. assert (L := sine_lipschitz sigma u0 x s). assert (M := cosine_lipschitz sigma u0 x s). assert (R := PI_above).
  assert (B : 2 * PI * Rabs (x - u0) <= 2 * PI * r_u) by (apply Rmult_le_compat_l; lra).
  assert (RP : Rabs P <= P) by (rewrite Rabs_pos_eq; lra). assert (RQ : Rabs Q <= Q) by (rewrite Rabs_pos_eq; lra).
  assert (L' := Rle_trans _ _ _ L B). assert (M' := Rle_trans _ _ _ M B). product L' RQ. product M' RP. apply Rabs_le. lra.
Qed.

Section Hop.
Variables a b w s0 c0 h target al be sigma x u0 w1 alpha_m beta_m r_alpha r_beta r_u r_w V E versine excess sin_h Sn : R.
Hypotheses (Ha : Rabs a <= alpha_m) (Hal : Rabs (al - a) <= r_alpha) (Hb : Rabs b <= beta_m) (Hbe : Rabs (be - b) <= r_beta) (Hbm : Rabs be
  <= beta_m).
Hypotheses (eb : be = 2 * PI * al) (sg : sign sigma) (Hs0 : Rabs (s0 - sine sigma u0) <= k) (Hc0 : Rabs (c0 - cosine sigma u0) <= k).
Hypotheses (Hx : Rabs (x - u0) <= r_u) (Hw : Rabs (w1 - w) <= r_w) (h0 : 0 <= h).
(* Versine, excess and sine of h (Lemma K2, h >= 2^-300). *)
Hypotheses (V0 : / 2 ^ 700 <= V) (E0 : 0 <= E) (S0' : / 2 ^ 700 <= Sn).
Hypotheses (HV : Rabs (versine - V) <= D * V) (HE : Rabs (excess - E) <= D * E) (HS : Rabs (sin_h - Sn) <= D * Sn).
Notation acceleration := (acceleration_of beta_m).
Notation hop_height_margin := (hop_height_margin alpha_m r_alpha).
Notation hop_velocity_margin := (hop_velocity_margin beta_m r_beta).

Section Height.
@HOP_HEIGHT@
Definition hop_truth := w1 * h + al * (cosine sigma x * E + sine sigma x * V) - target.
Definition hop_height_bound := @HOP_HEIGHT_BOUND@.
Theorem C1_hop : Rabs (r - hop_truth) + 7 * u * Rabs r <= (1 - 60 * u) * hop_height_bound.
Proof.
  destruct (wave_error _ _ _ _ _ _ _ _ _ _ Hc0 Hs0 (cosine_1 _ _ sg) (sine_1 _ _ sg) E0 V0 HE HV Hs0_versine Hwave) as (We & Ws & We0).
  assert (V00 : 0 <= V) by (assert (0 < / 2 ^ 700) by interval; lra). assert (Wx := wave_spread _ _ _ _ _ _ sg E0 V00 Hx).
  set (X := cosine sigma u0 * E + sine sigma u0 * V) in *. set (Y := cosine sigma x * E + sine sigma x * V) in *. set (P := E + V) in *.
  assert (P0 : 0 <= P) by (unfold P; lra). assert (am : 0 <= alpha_m) by (generalize (Rabs_pos a); lra).
    assert (ra0 : 0 <= r_alpha) by (generalize (Rabs_pos (al - a)); lra).
  assert (ru0 : 0 <= r_u) by (generalize (Rabs_pos (x - u0)); lra). assert (rw0 : 0 <= r_w) by (generalize (Rabs_pos (w1 - w)); lra).
  assert (bm0 : 0 <= beta_m) by (generalize (Rabs_pos b); lra). assert (e0 := eta_positive).
  positive alpha_m P. positive r_alpha P. assert (bP : 0 <= beta_m * r_u * P) by (apply Rmult_le_pos; [apply Rmult_le_pos|]; lra).
    positive r_w h.
  assert (wh0 : 0 <= Rabs w * h) by (apply Rmult_le_pos; [apply Rabs_pos|lra]). assert (Rh : Rabs h <= h) by (rewrite Rabs_pos_eq; lra).
  (* terms *)
  assert (Tm : P <= (1 + 7 * u) * terms). { destruct Hterms as [F _]. apply split_abs in F, HV, HE. unfold P, D, u in *. unfold Rabs in F.
    destruct (Rcase_abs terms); lra. }
  assert (T0 : 0 <= terms) by (unfold u in *; lra).
  assert (sp : Rabs (al * (Y - X)) <= beta_m * r_u * P).
  { rewrite Rabs_mult. apply Rle_trans with (Rabs al * (2 * PI * r_u * P)); [apply Rmult_le_compat_l; [apply Rabs_pos|exact Wx]|].
    replace (Rabs al * (2 * PI * r_u * P)) with (Rabs be * r_u * P).
      2: { rewrite eb, Rabs_mult, (Rabs_pos_eq (2 * PI)) by (generalize PI_above; lra). ring. }
    repeat apply Rmult_le_compat_r; assumption. }
  product Ha We. product Ha Ws. product Hal Ws. product Hw Rh. product (Rle_refl (Rabs w)) Rh. apply split_abs in sp.
  assert (ae : alpha_m * eta <= u * u * u * (alpha_m * P)) by (apply (Rmult_le_compat_l alpha_m) in We0; [|lra]; lra).
  assert (aX : Rabs (a * wave) <= (1 + 16 * u) * (alpha_m * P)) by (apply Rabs_le; unfold k, D, u in *; lra).
  destruct Ha_wave as [_ [_ F1]]. assert (F1' : Rabs (a_wave - a * wave) <= u * ((1 + 16 * u) * (alpha_m * P)) + eta) by (unfold u in *;
    lra). apply split_abs in F1', aX.
  assert (zX : Rabs (w * h + a_wave) <= Rabs w * h + (1 + 18 * u) * (alpha_m * P) + eta) by (apply Rabs_le; unfold u in *; lra).
  destruct Hz as [_ [_ F2]]. assert (F2' : Rabs (z - (w * h + a_wave)) <= u * (Rabs w * h + (1 + 18 * u) * (alpha_m * P) + eta) + eta) by
    (unfold u in *; lra). apply split_abs in F2'.
  destruct Hr as [F3 _]. apply split_abs in F3. assert (r0 := Rabs_pos r).
  apply (Rmult_le_compat_l alpha_m) in Tm as T1; [|lra]. apply (Rmult_le_compat_l r_alpha) in Tm as T2; [|lra].
  assert (br : 0 <= beta_m * r_u) by (apply Rmult_le_pos; lra). apply (Rmult_le_compat_l (beta_m * r_u)) in Tm as T3; [|lra].
  positive alpha_m terms. positive r_alpha terms. assert (bT : 0 <= beta_m * r_u * terms) by (apply Rmult_le_pos; lra).
  assert (G : Rabs (r - hop_truth) <= (1 - 60 * u) * hop_height_bound - 7 * u * Rabs r).
  { apply Rabs_le. unfold hop_height_bound, hop_truth. fold Y. unfold tools.hop_height_margin. rewrite tiny_eta.
    unfold SLACK, k, D, u in *. lra. }
  lra.
Qed.
End Height.

Section Velocity.
@HOP_VELOCITY@
(* Underflow: the velocity is no subnormal number (the test of C3 refuses those: K reach / |w| would exceed 0.49). *)
Hypothesis Hnormal : tiny <= Rabs v.
Definition hop_velocity_truth := w1 + be * (cosine sigma x * V + sine sigma x * Sn).
Definition hop_velocity_bound := @HOP_VELOCITY_BOUND@.
Theorem C2_hop : Rabs (v - hop_velocity_truth) <= (1 - 60 * u) * hop_velocity_bound.
Proof.
  assert (V00 : 0 <= V) by (assert (0 < / 2 ^ 700) by interval; lra). assert (S00 : 0 <= Sn) by (assert (0 < / 2 ^ 700) by interval; lra).
  destruct (wave_error _ _ _ _ _ _ _ _ _ _ Hc0 Hs0 (cosine_1 _ _ sg) (sine_1 _ _ sg) V00 S0' HV HS Hs0_sin_h Hwave) as (We & Ws & We0).
  assert (Wx := wave_spread _ _ _ _ _ _ sg V00 S00 Hx).
  set (X := cosine sigma u0 * V + sine sigma u0 * Sn) in *. set (Y := cosine sigma x * V + sine sigma x * Sn) in *. set (P := V + Sn) in *.
  assert (P0 : 0 <= P) by (unfold P; lra). assert (bm0 : 0 <= beta_m) by (generalize (Rabs_pos b); lra).
    assert (rb0 : 0 <= r_beta) by (generalize (Rabs_pos (be - b)); lra).
  assert (ru0 : 0 <= r_u) by (generalize (Rabs_pos (x - u0)); lra). assert (rw0 : 0 <= r_w) by (generalize (Rabs_pos (w1 - w)); lra).
    assert (e0 := eta_positive).
  positive beta_m P. positive r_beta P. assert (w0 := Rabs_pos w). assert (v0 := Rabs_pos v).
  assert (Tm : P <= (1 + 7 * u) * terms). { destruct Hterms as [F _]. apply split_abs in F, HV, HS. unfold P, D, u in *. unfold Rabs in F.
    destruct (Rcase_abs terms); lra. }
  assert (T0 : 0 <= terms) by (unfold u in *; lra).
  assert (beta_m0 : 0 <= beta_m) by (apply Rle_trans with (2 := Hb), Rabs_pos).
  assert (sw : beta_m * (2 * PI) <= acceleration). { assert (turn_above := TAU_above). assert (pi_above := PI_above).
    assert (0 <= beta_m * (2 * PI)) by (apply Rmult_le_pos; lra). assert (beta_m * (2 * PI) <= beta_m * TAU) by (apply Rmult_le_compat_l; lra).
    unfold acceleration_of, SLACK, u. lra. }
  assert (sp : Rabs (be * (Y - X)) <= acceleration * r_u * P).
  { rewrite Rabs_mult. apply Rle_trans with (Rabs be * (2 * PI * r_u * P)); [apply Rmult_le_compat_l; [apply Rabs_pos|exact Wx]|].
    replace (Rabs be * (2 * PI * r_u * P)) with (Rabs be * (2 * PI) * r_u * P) by ring. repeat apply Rmult_le_compat_r; try assumption.
    apply Rle_trans with (2 := sw). apply Rmult_le_compat_r; [generalize PI_above; lra|exact Hbm]. }
  product Hb We. product Hb Ws. product Hbe Ws. apply split_abs in sp, Hw.
  destruct Hv as [_ [F _]]. apply split_abs in F. rewrite tiny_eta in Hnormal.
  apply (Rmult_le_compat_l beta_m) in Tm as T1; [|lra]. apply (Rmult_le_compat_l r_beta) in Tm as T2; [|lra].
  assert (sr : 0 <= acceleration * r_u) by (apply Rmult_le_pos; [apply Rle_trans with (2 := sw), Rmult_le_pos; generalize PI_above|]; lra).
    apply (Rmult_le_compat_l (acceleration * r_u)) in Tm as T3; [|lra].
  positive beta_m terms. positive r_beta terms. assert (bT : 0 <= acceleration * r_u * terms) by (apply Rmult_le_pos; lra).
  apply Rabs_le. unfold hop_velocity_bound, hop_velocity_truth. fold Y. unfold tools.hop_velocity_margin.
  set (sw' := acceleration) in *. unfold SLACK, k, D, u in *. lra.
Qed.
End Velocity.
(* Sine and cosine on arrival, by the addition theorems; one u is left for the rounding of `arrive` (root.v). *)
Section Turned.
@TURNED@
(* An eighth of a period at most. *)
Hypotheses (V1 : V <= 0.2929) (S1' : Sn <= 0.7072).
Lemma turned_error p q P Q base out : Rabs (p - P) <= k -> Rabs (q - Q) <= k -> Rabs P <= 1 -> Rabs Q <= 1 ->
  fused ((- p) * versine + p) base -> fused (q * sin_h + base) out -> Rabs (out - (P * (1 - V) + Q * Sn)) <= @HOP_SINE_ERROR@ - u.
Proof.
  intros Hp Hq LP LQ [_ [_ F]] [_ [_ G]]. assert (g := eta_small). assert (e1 : eta <= u * u) by (apply Rle_trans with (1 := g); unfold u;
    interval).
  assert (small : 0 < / 2 ^ 700) by interval. assert (V00 : 0 <= V) by lra. assert (Sn0 : 0 <= Sn) by lra.
    clear g small V0 S0' Ha Hal Hb Hbe Hbm Hs0 Hc0 E0 HE.
  assert (Lp : Rabs p <= 1 + k) by (apply split_abs in Hp, LP; apply Rabs_le; lra).
    assert (Lq : Rabs q <= 1 + k) by (apply split_abs in Hq, LQ; apply Rabs_le; lra).
  assert (R1 : Rabs (1 - V) <= 1 - V) by (rewrite Rabs_pos_eq; lra). assert (R2 : Rabs Sn <= Sn) by (rewrite Rabs_pos_eq; lra).
  product Hp R1. product Lp HV. product Hq R2. product Lq HS. product LP R1. product LQ R2.
  assert (X : Rabs (- p * versine + p) <= (1 + 8 * u) * (1 - V) + 8 * u) by (apply Rabs_le; unfold k, D, u in *; lra).
  assert (F' : Rabs (base - (- p * versine + p)) <= u * ((1 + 8 * u) * (1 - V) + 8 * u) + u * u) by (unfold u in *; lra).
    apply split_abs in F', X.
  assert (Y : Rabs (q * sin_h + base) <= 1 - V + Sn + 32 * u) by (apply Rabs_le; unfold k, D, u in *; lra).
  assert (G' : Rabs (out - (q * sin_h + base)) <= u * (1 - V + Sn + 32 * u) + u * u) by (unfold u in *; lra). apply split_abs in G'.
  apply Rabs_le. unfold k, D, u in *. lra.
Qed.
Theorem hop_sine : Rabs (sin1 - (sine sigma u0 * (1 - V) + cosine sigma u0 * Sn)) <= @HOP_SINE_ERROR@ - u.
Proof. apply turned_error with s0 c0 sin_base; auto using sine_1, cosine_1. Qed.
Theorem hop_cosine : Rabs (cos1 - (cosine sigma u0 * (1 - V) - sine sigma u0 * Sn)) <= @HOP_SINE_ERROR@ - u.
Proof.
  replace (cosine sigma u0 * (1 - V) - sine sigma u0 * Sn) with (cosine sigma u0 * (1 - V) + - sine sigma u0 * Sn) by ring.
  apply turned_error with c0 (- s0) cos_base; auto using cosine_1.
  - replace (- s0 - - sine sigma u0) with (- (s0 - sine sigma u0)) by ring. rewrite Rabs_Ropp. exact Hs0.
  - rewrite Rabs_Ropp. apply sine_1. exact sg.
Qed.
End Turned.
End Hop.
