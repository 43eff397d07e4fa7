(* The single-variable constants: critical phases (0.354), stationarity (20 ACOS_ERROR^2), flights whose extrema may not exist (28 <= 60),
   C6's product. A template: validation/bounds/prove fills in what stands between @ signs, from the source text. *)
From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
Require Import rounding tools.
Open Scope R_scope.

(* Jordan's inequality on [0, PI / 2]. *)
Lemma jordan t : 0 <= t <= PI / 2 -> 2 * t / PI <= sin t.
Proof.
  intros H. assert (P : 3.1415 < PI < 3.1416) by (split; interval).
  assert (i : / PI < 0.3184) by interval. assert (i0 : 0 < / PI) by (apply Rinv_0_lt_compat; lra).
    assert (ii : PI * / PI = 1) by (apply Rinv_r; lra).
  destruct (Rle_lt_dec t 1) as [a|b].
  - assert (L : t - t * t * t / 6 <= sin t). { destruct (pre_sin_bound t 0) as [L _]; [lra|lra|]. unfold sin_approx, sin_term in L.
    cbn in L. lra. }
    unfold Rdiv. assert (0 <= t * (1 - t * t)) by nra. nra.
  - set (v := PI / 2 - t). assert (E : sin t = cos v) by (unfold v; rewrite <- sin_shift; f_equal; ring). rewrite E.
    assert (V : 0 <= v <= 0.571) by (unfold v; lra). assert (L : 1 - v * v / 2 <= cos v). { destruct (pre_cos_bound v 0) as [L _];
      [lra|lra|]. unfold cos_approx, cos_term in L. cbn in L. lra. }
    replace (2 * t / PI) with (1 - 2 * v / PI) by (unfold v; field; lra). assert (v * v / 2 <= 2 * v / PI); [|lra]. unfold Rdiv. nra.
Qed.
Lemma hoelder_ordered a b : 0 <= a <= b -> b <= PI -> 2 * ((b - a) / PI) ^ 2 <= cos a - cos b.
Proof.
  intros H K. assert (P := PI_above). set (m := (b + a) / 2). set (h := (b - a) / 2).
  replace (cos a - cos b) with (2 * sin m * sin h).
  2: { replace a with (m - h) by (unfold m, h; field). replace b with (m + h) by (unfold m, h; field). rewrite cos_minus, cos_plus. ring. }
  assert (J : (b - a) / PI <= sin h) by (replace ((b - a) / PI) with (2 * h / PI) by (unfold h; field; lra); apply jordan; unfold h; lra).
  assert (h0 : 0 <= (b - a) / PI) by (apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat; lra]).
  assert (M : sin h <= sin m).
  { destruct (Rle_lt_dec m (PI / 2)) as [l|g]; [apply sin_incr_1; unfold m, h in *; lra|].
    rewrite <- (sin_PI_x m). apply sin_incr_1; unfold m, h in *; lra. }
  nra.
Qed.
Lemma hoelder a b : 0 <= a <= PI -> 0 <= b <= PI -> 2 * ((b - a) / PI) ^ 2 <= Rabs (cos a - cos b).
Proof.
  intros A B. destruct (Rle_lt_dec a b).
  - apply Rle_trans with (2 := Rle_abs _). apply hoelder_ordered; lra.
  - rewrite Rabs_minus_sym. apply Rle_trans with (2 := Rle_abs _). replace (((b - a) / PI) ^ 2) with (((a - b) / PI) ^ 2) by (field;
    generalize PI_above; lra). apply hoelder_ordered; lra.
Qed.
(* In periods. *)
Lemma hoelder_turns p q ratio : 0 <= p <= 1 / 2 -> 0 <= q <= 1 / 2 -> Rabs (cos (2 * PI * p) - cos (2 * PI * q)) <= ratio -> 8 * (q - p) ^
  2 <= ratio.
Proof.
  intros P Q H. assert (R := PI_above). assert (X := hoelder (2 * PI * p) (2 * PI * q)).
    replace ((2 * PI * q - 2 * PI * p) / PI) with (2 * (q - p)) in X by (field; lra).
  assert (8 * (q - p) ^ 2 = 2 * (2 * (q - p)) ^ 2) by ring. assert (2 * (2 * (q - p)) ^ 2 <= Rabs (cos (2 * PI * p) - cos (2 * PI * q))) by
    (apply X; split; nra). lra.
Qed.
Theorem C4_hoelder p q ratio : 0 <= p <= 1 / 2 -> 0 <= q <= 1 / 2 -> Rabs (cos (2 * PI * p) - cos (2 * PI * q)) <= ratio -> Rabs (q - p) <=
  (1 - 64 * u) * (@HOELDER@).
Proof.
  intros P Q H. assert (X := hoelder_turns p q ratio P Q H). assert (r0 : 0 <= ratio) by (generalize (Rabs_pos (cos (2 * PI * p) - cos (2 *
    PI * q))); lra).
  assert (s := sqrt_sqrt ratio r0). assert (s0 := sqrt_pos ratio). apply Rabs_le. unfold u. split; apply Rnot_lt_le; intros n; nra.
Qed.
(* The quotient q = c/beta: all doubles rounded within delta and r_beta of c and beta. *)
Theorem C4_ratio c c_ b b_ q slope r_beta least_beta : 0 < least_beta <= b -> Rabs (c - c_) <= slope -> Rabs (b - b_) <= r_beta -> 0 < b_
  -> Rabs c_ <= b_ -> normal (c_ / b_) q ->
  Rabs (c / b - q) <= (1 + 8 * u) * (@RATIO@).
Proof.
  intros L Hc Hb b0 c1 [_ [_ F]]. assert (Q : Rabs (c_ / b_) <= 1). { unfold Rdiv. rewrite Rabs_mult, (Rabs_pos_eq (/ b_)) by (left;
    apply Rinv_0_lt_compat; lra). apply Rmult_le_reg_r with b_; [lra|]. rewrite Rmult_assoc, Rinv_l by lra. lra. }
  assert (E : Rabs (c / b - c_ / b_) <= (slope + r_beta) / least_beta).
  { replace (c / b - c_ / b_) with (((c - c_) - (b - b_) * (c_ / b_)) / b) by (field; lra). unfold Rdiv.
    rewrite Rabs_mult, (Rabs_pos_eq (/ b)) by (left; apply Rinv_0_lt_compat; lra).
    apply Rmult_le_compat; [apply Rabs_pos|left; apply Rinv_0_lt_compat; lra| |apply Rinv_le_contravar; lra].
    assert (P := abs_product _ _ _ _ Hb Q). fold (c_ / b_). apply split_abs in Hc. apply Rabs_le. lra. }
  assert (r0 : 0 <= (slope + r_beta) / least_beta) by (generalize (Rabs_pos (c / b - c_ / b_)); lra).
  assert (F' : Rabs (q - c_ / b_) <= u) by (unfold u in *; lra). apply split_abs in E, F'. apply Rabs_le. unfold u in *. lra.
Qed.

(* E2: f is the height of an extremum over its phase. `p0` belongs to the true ratio, `p1` to the computed one, `p` is what is used. *)
Lemma tangent x y : 0 <= x <= PI -> 0 <= y <= PI -> sin x <= sin y + cos y * (x - y).
Proof.
  intros X Y. destruct (MVT_abs (fun x => sin x - cos y * x) (fun x => cos x - cos y) y x) as (c & _ & _). { intros z _.
    apply is_derive_Reals. auto_derive; [auto|ring]. }
  destruct (Rtotal_order x y) as [l|[e|g]]; [|rewrite e; lra|].
  - destruct (MVT_cor2 sin cos x y) as (z & e & b); [lra|intros; apply derivable_pt_lim_sin|].
    assert (cos y <= cos z) by (apply cos_decr_1; lra). nra.
  - destruct (MVT_cor2 sin cos y x) as (z & e & b); [lra|intros; apply derivable_pt_lim_sin|].
    assert (cos z <= cos y) by (apply cos_decr_1; lra). nra.
Qed.
Lemma parabola x y : sin y + cos y * (x - y) - (x - y) ^ 2 / 2 <= sin x.
Proof.
  (* The slope of sin x - cos y * x is |cos x - cos y| <= |x - y| away from y. *)
  destruct (Rtotal_order x y) as [l|[e|g]]; [|rewrite e; lra|].
  - destruct (MVT_cor2 (fun x => sin x - cos y * x + (x - y) ^ 2 / 2) (fun x => cos x - cos y + (x - y)) x y) as (z & e & b); [lra|intros;
    apply is_derive_Reals; auto_derive; [auto|field]|].
    assert (cos z - cos y <= y - z). { destruct (MVT_cor2 cos (fun x => - sin x) z y) as (w & f & _); [lra|intros;
      apply derivable_pt_lim_cos|]. generalize (SIN_bound w). nra. } nra.
  - destruct (MVT_cor2 (fun x => sin x - cos y * x + (x - y) ^ 2 / 2) (fun x => cos x - cos y + (x - y)) y x) as (z & e & b); [lra|intros;
    apply is_derive_Reals; auto_derive; [auto|field]|].
    assert (y - z <= cos z - cos y). { destruct (MVT_cor2 cos (fun x => - sin x) y z) as (w & f & _); [lra|intros;
      apply derivable_pt_lim_cos|]. generalize (SIN_bound w). nra. } nra.
Qed.
Definition f q p := sin (2 * PI * p) - q * (2 * PI * p).
Section Stationary.
Variables q q1 p0 p1 p : R.
Notation A := @ACOS_ERROR@.
Hypotheses (R0 : 0 <= p0 <= 1 / 2) (R1 : 0 <= p1 <= 1 / 2) (R : 0 <= p <= 1 / 2).
Hypotheses (Hq : cos (2 * PI * p0) = q) (Hq1 : cos (2 * PI * p1) = q1) (Hp : Rabs (p - p1) <= A) (Hqq : Rabs (q1 - q) <= u).
Lemma phases_near : Rabs (p0 - p1) <= / 2 ^ 27.
Proof.
  assert (H := hoelder_turns p1 p0 u R1 R0). rewrite Hq, Hq1 in H. specialize (H Hqq). apply Rabs_le. unfold u in H. split;
    apply Rnot_lt_le; intros n; nra.
Qed.
(* Taken at the phase of the computed ratio exactly: what the coarse sine loses. *)
Theorem lost : f q p0 - f q p1 <= u / 1000.
Proof.
  assert (P := PI_above). assert (T := tangent (2 * PI * p0) (2 * PI * p1)). rewrite Hq1 in T. assert (N := phases_near).
  assert (X := abs_product _ _ _ _ Hqq N). unfold f. assert (T' : sin (2 * PI * p0) <= sin (2 * PI * p1) + q1 * (2 * PI * p0 - 2 * PI *
    p1)) by (apply T; split; nra).
  set (D := (q1 - q) * (p0 - p1)) in *. assert (2 * PI * D <= 8 * (u * / 2 ^ 27)) by (unfold u in *; nra). 
  replace (sin (2 * PI * p0) - q * (2 * PI * p0) - (sin (2 * PI * p1) - q * (2 * PI * p1))) with (sin (2 * PI * p0) - sin (2 * PI * p1) -
    q1 * (2 * PI * p0 - 2 * PI * p1) + 2 * PI * D) by (unfold D; ring).
  unfold u in *. lra.
Qed.
Theorem E2_refined : f q p0 - f q p <= 20 * A * A.
Proof.
  assert (P := PI_above). assert (T := tangent (2 * PI * p0) (2 * PI * p1)). rewrite Hq1 in T. assert (N := phases_near).
  assert (T' : sin (2 * PI * p0) <= sin (2 * PI * p1) + q1 * (2 * PI * p0 - 2 * PI * p1)) by (apply T; split; nra). clear T.
  assert (B := parabola (2 * PI * p) (2 * PI * p1)). rewrite Hq1 in B.
  assert (M : Rabs (p0 - p) <= / 2 ^ 26) by (apply split_abs in N, Hp; apply Rabs_le; lra).
  assert (X := abs_product _ _ _ _ Hqq M). set (D := (q1 - q) * (p0 - p)) in *.
    assert (DD : 2 * PI * D <= 8 * (u * / 2 ^ 26)) by (unfold u in *; nra).
  assert (S : (2 * PI * p - 2 * PI * p1) ^ 2 / 2 <= 19.75 * (A * A)).
  { replace ((2 * PI * p - 2 * PI * p1) ^ 2 / 2) with (2 * PI * PI * ((p - p1) * (p - p1))) by field.
    assert (Y := abs_product _ _ _ _ Hp Hp).
    assert (2 * PI * PI <= 19.75) by interval. assert (0 <= (p - p1) * (p - p1)) by apply Rle_0_sqr. apply Rmult_le_compat; try nra. }
  unfold f. replace (sin (2 * PI * p0) - q * (2 * PI * p0) - (sin (2 * PI * p) - q * (2 * PI * p))) with
    (sin (2 * PI * p0) - q1 * (2 * PI * p0) - (sin (2 * PI * p) - q1 * (2 * PI * p)) + 2 * PI * D) by (unfold D; ring).
  assert (K : 8 * (u * / 2 ^ 26) <= 0.25 * (A * A)) by (unfold u; lra). lra.
Qed.
End Stationary.

(* Extrema that may not exist: within `shift` of the clamped phase the computed velocity is at most 28 beta shift^2. *)
Theorem C4_clamped q s shift beta : 0 <= beta -> Rabs s <= shift -> Rabs (1 - q) <= 8 * shift ^ 2 -> beta * Rabs (q - cos (2 * PI * s)) *
  shift <= (1 - 64 * u) * (@CLAMPED@).
Proof.
  intros b0 S Q. assert (s0 := Rabs_pos s). assert (P := PI_above).
  assert (C : 0 <= 1 - cos (2 * PI * s) <= 20 * shift ^ 2).
  { split; [generalize (COS_bound (2 * PI * s)); lra|]. assert (B : cos (2 * PI * s) = 1 - 2 * sin (PI * s) * sin (PI * s)) by (replace (2
    * PI * s) with (2 * (PI * s)) by ring; apply cos_2a_sin).
    assert (L : Rabs (sin (PI * s)) <= PI * Rabs s). { assert (M := sine_lipschitz 1 0 (s / 2)). unfold sine, sign in M.
      rewrite Rmult_0_r, sin_0 in M. replace (2 * PI * (s / 2)) with (PI * s) in M by field.
      replace (1 * sin (PI * s) - 1 * 0) with (sin (PI * s)) in M by ring. rewrite Rminus_0_r in M. unfold Rdiv in M.
        rewrite (Rabs_mult s), (Rabs_pos_eq (/ 2)) in M by lra. assert (T : 1 = 1 \/ 1 = -1) by auto. specialize (M T). lra. }
    assert (sq : sin (PI * s) * sin (PI * s) <= (PI * shift) * (PI * shift)).
      { replace (sin (PI * s) * sin (PI * s)) with (Rabs (sin (PI * s)) * Rabs (sin (PI * s))) by (rewrite <- Rabs_mult;
        apply Rabs_pos_eq, Rle_0_sqr).
      assert (PI * Rabs s <= PI * shift) by (apply Rmult_le_compat_l; lra). apply Rmult_le_compat; auto using Rabs_pos; lra. }
    assert (p2 : 2 * PI * PI <= 20) by interval. assert (0 <= shift ^ 2) by nra. rewrite B. nra. }
  assert (D : Rabs (q - cos (2 * PI * s)) <= 28 * shift ^ 2) by (apply split_abs in Q; apply Rabs_le; lra).
  assert (0 <= shift) by lra. assert (0 <= shift ^ 3) by (apply pow_le; lra). assert (0 <= beta * shift ^ 3) by (apply Rmult_le_pos; lra).
  apply Rle_trans with (beta * (28 * shift ^ 2) * shift). { apply Rmult_le_compat_r; [lra|]. apply Rmult_le_compat_l; assumption.
    } unfold u. nra.
Qed.
(* The clamp backwards: 1 - q is at most the ratio of C4, which is at most 8 shift^2. *)
Theorem C4_backwards ratio shift : 0 <= ratio -> @HOELDER@ <= shift -> ratio <= 8 * shift ^ 2.
Proof. intros r0 H. assert (s := sqrt_sqrt ratio r0). assert (s0 := sqrt_pos ratio). nra. Qed.
(* `is_narrow`: 0.354 sqrt(ratio) and the rest are below NARROW. *)
Theorem C4_narrow slope beta_m_least : 0 < beta_m_least -> 0 <= slope -> slope <= / 2 ^ 26 * beta_m_least ->
  let ratio := (slope + slope) / beta_m_least + u in @CRITICAL@ <= @NARROW@.
Proof.
  intros b0 s0 H ratio. assert (r : 0 <= ratio <= / 2 ^ 25 + u).
  { unfold ratio, Rdiv. assert (i := Rinv_0_lt_compat _ b0). apply (Rmult_le_compat_r (/ beta_m_least)) in H; [|lra].
    rewrite Rmult_assoc, Rinv_r in H by lra. assert (0 <= slope * / beta_m_least) by (apply Rmult_le_pos; lra). unfold u. lra. }
  generalize dependent ratio. intros ratio r. unfold SLACK, u in *. interval with (i_prec 80).
Qed.

(* C6: a product that `up` finds below 1 is below 1. *)
Theorem C6_product x y : 0 <= x -> 0 <= y -> let radius := rnd (x * y) in @UP@ < 1 -> x * y < 1.
Proof.
  intros x0 y0 radius H. apply Rnot_le_lt. intros n. assert (radius_1 : 1 <= radius). { unfold radius. apply rnd_le in n.
    rewrite (rnd_id 1) in n; [exact n|]. apply (double_power 0). lia. }
  assert (O : rnd 1 = 1) by (apply rnd_id; apply (double_power 0); lia).
    match type of H with (?r < 1) => assert (1 <= r) by (rewrite <- O at 1; apply rnd_le; lra) end. lra.
Qed.
