(* Constants of the source text, and what the proofs about flights share. A template: validation/bounds/prove fills in what
   stands between @ signs. *)
From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Tactic.
Require Import rounding.
Open Scope R_scope.

Definition SLACK := @SLACK@.
Definition TAU := @TAU@.
Definition TURN := @TURN@.
Definition k := @SIN_COS_ERROR@.
Definition D := @DEPARTURE_ERROR@.

Lemma TAU_above : 2 * PI <= TAU. Proof. unfold TAU. interval with (i_prec 80). Qed.
Lemma PI_above : 3 < PI < 4. Proof. split; interval. Qed.

(* Absolute values as two inequalities each, for lra. *)
Lemma split_abs x y : Rabs x <= y -> - y <= x <= y. Proof. unfold Rabs. destruct (Rcase_abs x); lra. Qed.
Lemma abs_product a b x y : Rabs a <= x -> Rabs b <= y -> - (x * y) <= a * b <= x * y.
Proof. intros X Y. apply split_abs. rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos. Qed.
Lemma abs_self x : - Rabs x <= x <= Rabs x. Proof. unfold Rabs. destruct (Rcase_abs x); lra. Qed.
Lemma fused_weak x m : fused x m -> Rabs (m - x) <= u * Rabs m + eta. Proof. unfold fused. tauto. Qed.
Lemma added_weak x m : added x m -> Rabs (m - x) <= u * Rabs m. Proof. unfold added. tauto. Qed.
(* |m| <= (1 + u) |x| + eta and the other way round. *)
Lemma fused_size x m : fused x m -> Rabs m <= (1 + u) * Rabs x + eta /\ Rabs x <= (1 + u) * Rabs m + eta.
Proof. intros [_ [F G]]. apply split_abs in F, G. unfold Rabs, u in *. destruct (Rcase_abs x), (Rcase_abs m); lra. Qed.
Lemma added_size x m : added x m -> Rabs m <= (1 + u) * Rabs x /\ Rabs x <= (1 + u) * Rabs m.
Proof. intros [F G]. apply split_abs in F, G. unfold Rabs, u in *. destruct (Rcase_abs x), (Rcase_abs m); lra. Qed.
Ltac product H K := let P := fresh "P" in assert (P := abs_product _ _ _ _ H K).

Ltac weak H := first [apply fused_weak in H | apply added_weak in H]; apply split_abs in H.
(* Products of variables that are not negative, for lra. *)
Ltac positive a b := assert (0 <= a * b) by (apply Rmult_le_pos; auto using Rabs_pos, Rlt_le, eta_positive).

(* Sine and cosine of a phase in periods, with the sign of the wall. *)
Definition sine sigma x := sigma * sin (2 * PI * x).
Definition cosine sigma x := sigma * cos (2 * PI * x).
Definition sign sigma := sigma = 1 \/ sigma = -1.
Lemma sine_1 sigma x : sign sigma -> Rabs (sine sigma x) <= 1.
Proof. intros [e|e]; unfold sine; rewrite e; generalize (SIN_bound (2 * PI * x)); intros; apply Rabs_le; lra. Qed.
Lemma cosine_1 sigma x : sign sigma -> Rabs (cosine sigma x) <= 1.
Proof. intros [e|e]; unfold cosine; rewrite e; generalize (COS_bound (2 * PI * x)); intros; apply Rabs_le; lra. Qed.
(* Mean value: functions whose derivative is bounded between two points. *)
Lemma mean_value (f f' : R -> R) (a b m : R) : (forall x, is_derive f x (f' x)) -> (forall x, Rmin a b <= x <= Rmax a b -> Rabs (f' x) <=
  m) -> Rabs (f b - f a) <= m * Rabs (b - a).
Proof.
  intros E H. destruct (MVT_abs f f' a b) as (c & e & r). { intros x _. apply is_derive_Reals, E. }
  rewrite e. apply Rmult_le_compat_r; [apply Rabs_pos|apply H; exact r].
Qed.
Lemma between a b x : Rmin a b <= x <= Rmax a b -> Rabs (x - a) <= Rabs (b - a).
Proof. unfold Rmin, Rmax. destruct (Rle_dec a b); intros H; unfold Rabs; destruct (Rcase_abs (x - a)), (Rcase_abs (b - a)); lra. Qed.
Lemma sine_lipschitz sigma x y : sign sigma -> Rabs (sine sigma y - sine sigma x) <= 2 * PI * Rabs (y - x).
Proof.
  intros s. apply mean_value with (fun x => 2 * PI * cosine sigma x).
  - intros z. unfold sine, cosine. auto_derive; [auto|ring].
  - intros z _. rewrite Rabs_mult, Rabs_pos_eq by (generalize PI_above; lra). generalize (cosine_1 sigma z s) PI_above. nra.
Qed.
Lemma cosine_lipschitz sigma x y : sign sigma -> Rabs (cosine sigma y - cosine sigma x) <= 2 * PI * Rabs (y - x).
Proof.
  intros s. apply mean_value with (fun x => - (2 * PI * sine sigma x)).
  - intros z. unfold sine, cosine. auto_derive; [auto|ring].
  - intros z _. rewrite Rabs_Ropp, Rabs_mult, Rabs_pos_eq by (generalize PI_above; lra). generalize (sine_1 sigma z s) PI_above. nra.
Qed.
Lemma sine_near sigma x y : sign sigma -> Rabs (sine sigma y) <= Rabs (sine sigma x) + 2 * PI * Rabs (y - x).
Proof.
  intros s. assert (M := sine_lipschitz sigma x y s). generalize (Rabs_triang (sine sigma x) (sine sigma y - sine sigma x)).
  replace (sine sigma x + (sine sigma y - sine sigma x)) with (sine sigma y) by ring. lra.
Qed.
Lemma cosine_near sigma x y : sign sigma -> Rabs (cosine sigma y - cosine sigma x) <= 2 * PI * (Rabs (sine sigma x) + 2 * PI * Rabs (y -
  x)) * Rabs (y - x).
Proof.
  intros s. apply mean_value with (fun x => - (2 * PI * sine sigma x)).
  - intros z. unfold sine, cosine. auto_derive; [auto|ring].
  - intros z H. rewrite Rabs_Ropp, Rabs_mult, (Rabs_pos_eq (2 * PI)) by (generalize PI_above; lra).
    apply Rmult_le_compat_l; [generalize PI_above; lra|]. eapply Rle_trans; [apply sine_near with (x := x); exact s|].
    apply between in H. generalize PI_above. nra.
Qed.

(* How long a flight has lasted: `elapsed` of `bracket`. *)
Section Elapsed.
Variables N u1 u0 : R.
@ELAPSED@
Theorem elapsed_holds : / 2 ^ 800 <= elapsed -> Rabs (N + (u1 - u0)) <= (1 + 6 * u) * elapsed.
Proof.
  intros H. assert (G := eta_small). assert (e : eta <= u * (/ 2 ^ 800)) by (apply Rle_trans with (1 := G); unfold u; interval).
  destruct (added_size _ _ Hu1_u0) as [S1 _]. destruct (added_size _ _ HN_u1_u0) as [S2 _].
  destruct Hu1_u0 as [E1 _]. destruct HN_u1_u0 as [E2 _]. destruct Helapsed as [_ [E3 _]]. assert (L : 0 < / 2 ^ 800) by interval.
  assert (A := abs_self N). assert (B := abs_self N_u1_u0). assert (P := Rabs_pos N). assert (Q := Rabs_pos N_u1_u0).
  rewrite (Rabs_pos_eq elapsed) in E3 by lra. apply split_abs in E1, E2, E3. apply Rabs_le.
  assert (S3 : Rabs u1_u0 <= (1 + u) * Rabs N_u1_u0 + Rabs N).
  { apply Rabs_le. assert (C := abs_self (N + u1_u0)). unfold u in *. lra. }
  assert (C := abs_self (N + u1_u0)). unfold u in *. lra.
Qed.
End Elapsed.

(* What the spread of the starts adds (ii): `x` and `w1` are the phase and the velocity of another start. *)
Lemma spread_of_starts sigma al be S1 U u0 x w w1 r_u r_w span tilt : sign sigma -> be = 2 * PI * al ->
  Rabs (x - u0) <= r_u -> Rabs (w1 - w) <= r_w -> Rabs (U - u0) + r_u <= span ->
  2 * PI * Rabs be * (Rabs (sine sigma u0) + 2 * PI * r_u) <= tilt ->
  Rabs ((w1 + be * cosine sigma x) * (U - x) - al * (S1 - sine sigma x) - ((w + be * cosine sigma u0) * (U - u0) - al * (S1 - sine sigma
    u0)))
    <= r_w * span + r_u * (Rabs w + tilt * span).
Proof.
  intros s eb Hx Hw Hs Ht. set (f := fun w x => (w + be * cosine sigma x) * (U - x) - al * (S1 - sine sigma x)).
  assert (ru0 : 0 <= r_u) by (generalize (Rabs_pos (x - u0)); lra). assert (U0 := Rabs_pos (U - u0)).
  assert (A : Rabs (f w x - f w u0) <= (Rabs w + tilt * span) * Rabs (x - u0)).
  { apply mean_value with (fun x => - w - 2 * PI * be * sine sigma x * (U - x)).
    - intros y. unfold f, sine, cosine. auto_derive; [auto|]. rewrite eb. ring.
    - intros y H. apply between in H. assert (N := sine_near sigma u0 y s).
      assert (Y : Rabs (U - y) <= span). { generalize (Rabs_triang (U - u0) (- (y - u0))). rewrite Rabs_Ropp.
        replace (U - u0 + - (y - u0)) with (U - y) by ring. lra. }
      assert (Q : Rabs (2 * PI * be * sine sigma y) <= tilt).
      { rewrite !Rabs_mult, (Rabs_pos_eq 2), (Rabs_pos_eq PI) by (generalize PI_above; lra). apply Rle_trans with (2 := Ht).
        apply Rmult_le_compat_l. { generalize (Rabs_pos be) PI_above. nra. }
        apply Rle_trans with (1 := N). apply Rplus_le_compat_l. apply Rmult_le_compat_l; [generalize PI_above|]; lra. }
      assert (P := abs_product _ _ _ _ Q Y). generalize (abs_self w). intros. apply Rabs_le. lra. }
  assert (B : Rabs (f w1 x - f w x) <= r_w * span).
  { replace (f w1 x - f w x) with ((w1 - w) * (U - x)) by (unfold f; ring). rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos.
    generalize (Rabs_triang (U - u0) (- (x - u0))). rewrite Rabs_Ropp. replace (U - u0 + - (x - u0)) with (U - x) by ring. lra. }
  assert (G : 0 <= tilt * span). { apply Rmult_le_pos; [|lra]. apply Rle_trans with (2 := Ht).
    generalize (Rabs_pos be) (Rabs_pos (sine sigma u0)) PI_above. intros.
    apply Rmult_le_pos; [apply Rmult_le_pos; lra|]. apply Rplus_le_le_0_compat; [lra|]. apply Rmult_le_pos; lra. }
  assert (W := Rabs_pos w).
  assert (C : (Rabs w + tilt * span) * Rabs (x - u0) <= r_u * (Rabs w + tilt * span)) by (rewrite (Rmult_comm r_u);
    apply Rmult_le_compat_l; lra).
  change (Rabs (f w1 x - f w u0) <= r_w * span + r_u * (Rabs w + tilt * span)).
  replace (f w1 x - f w u0) with ((f w1 x - f w x) + (f w x - f w u0)) by ring. eapply Rle_trans; [apply Rabs_triang|]. lra.
Qed.

(* `Margins` and `Bounds` of src/contact/bounds.rs. *)
Definition acceleration_of beta_m := @MARGIN_acceleration@.
Definition waves_of alpha_m r_alpha := @MARGIN_waves@.
Definition drift_margin beta_m r_beta := @MARGIN_drift@.
Definition velocity_margin beta_m r_beta := @MARGIN_velocity@.
Definition hop_height_margin alpha_m r_alpha := @MARGIN_hop_height@.
Definition hop_velocity_margin beta_m r_beta := @MARGIN_hop_velocity@.
Definition drift_error_of beta_m r_beta c := @DRIFT_ERROR@.
Definition tilt_of beta_m r_u s0 := @TILT@.
