(* One flight from a launch to its first contact: when conditions on a few pieces of the flight hold, the ball reaches
   the named wall, first, within the named phases.

   Units of this file, of the reference harmonic: phase th = W t + tau for time, A for lengths, A W for velocities. Then (12)
   and (11) read
     place + rise th0 u th,   rate th0 u th,
   with u the velocity at launch. Of the parameters only d/A is left, and of each further harmonic its companion. *)
From Coq Require Import Reals Lra List.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model.
Open Scope R_scope.

(* A harmonic share * sin (ratio th + lag): its amplitude and frequency over those of the reference. *)
Record companion := { share : R; ratio : R; lag : R }.
Definition companion_phase (o : companion) (th : R) : R := ratio o * th + lag o.

Lemma increasing f f' a b : a < b -> (forall c, derivable_pt_lim f c (f' c)) -> (forall c, a < c < b -> 0 < f' c) -> f a < f b.
Proof.
  intros h D p. destruct (MVT_cor2 f f' a b h (fun c _ => D c)) as (c & eq & hc). specialize (p c hc). nra.
Qed.

Section Companions.
Variable os : list companion.

(* The box: E, E' and -E'', in the units of this file. *)
Definition box_at (th : R) : R := sum (sin th) (fun o => share o * sin (companion_phase o th)) os.
Definition box_rate (th : R) : R := sum (cos th) (fun o => share o * ratio o * cos (companion_phase o th)) os.
Definition box_bend (th : R) : R := sum (sin th) (fun o => share o * ratio o * ratio o * sin (companion_phase o th)) os.

Definition rise (th0 u th : R) : R := box_at th0 - box_at th + (u + box_rate th0) * (th - th0).
Definition rate (th0 u th : R) : R := u + box_rate th0 - box_rate th.

Lemma box_at_derivative th : is_derive box_at th (box_rate th).
Proof.
  apply (sum_derivative sin _ (fun o th => share o * sin (companion_phase o th)) (fun o th => share o * ratio o * cos (companion_phase o th)));
    intros; unfold companion_phase; auto_derive; try exact I; ring.
Qed.
Lemma box_rate_derivative th : is_derive box_rate th (- box_bend th).
Proof.
  replace (- box_bend th) with (sum (- sin th) (fun o => - (share o * ratio o * ratio o * sin (companion_phase o th))) os).
  - apply (sum_derivative cos _ (fun o th => share o * ratio o * cos (companion_phase o th))
      (fun o th => - (share o * ratio o * ratio o * sin (companion_phase o th)))); intros; unfold companion_phase; auto_derive; try exact I; ring.
  - unfold box_bend, sum. induction os as [|o rest IH]; cbn; [|rewrite IH]; ring.
Qed.
(* -E'' of the box. *)
Definition box_jerk (th : R) : R := sum (cos th) (fun o => share o * ratio o * ratio o * ratio o * cos (companion_phase o th)) os.
Lemma box_bend_derivative th : is_derive box_bend th (box_jerk th).
Proof.
  apply (sum_derivative sin _ (fun o th => share o * ratio o * ratio o * sin (companion_phase o th))
    (fun o th => share o * ratio o * ratio o * ratio o * cos (companion_phase o th)));
    intros; unfold companion_phase; auto_derive; try exact I; ring.
Qed.
Ltac derive_box := intros; match goal with |- is_derive _ ?th _ => 
  assert (D := box_at_derivative th); assert (D' := box_rate_derivative th) end;
  auto_derive; [repeat split; eexists; eassumption|];
  repeat match goal with |- context [Derive (fun x => box_at x) ?th] =>
    replace (Derive (fun x => box_at x) th) with (box_rate th) by (symmetry; apply is_derive_unique, box_at_derivative) end;
  repeat match goal with |- context [Derive (fun x => box_rate x) ?th] =>
    replace (Derive (fun x => box_rate x) th) with (- box_bend th) by (symmetry; apply is_derive_unique, box_rate_derivative) end.
Lemma rise_derivative th0 u th : derivable_pt_lim (rise th0 u) th (rate th0 u th).
Proof. apply is_derive_Reals. unfold rise, rate. derive_box. ring. Qed.
Lemma rate_derivative th0 u th : derivable_pt_lim (rate th0 u) th (box_bend th).
Proof. apply is_derive_Reals. unfold rate. derive_box. ring. Qed.
(* The same when the launch is later: the first entries of (A.7), the one of the time times the velocity of arrival. *)
Lemma rise_derivative_launch th0 u th : derivable_pt_lim (fun x => rise x u th) th0 (- box_bend th0 * (th - th0) - u).
Proof. apply is_derive_Reals. unfold rise. derive_box. ring. Qed.
Lemma rate_derivative_launch th0 u th : derivable_pt_lim (fun x => rate x u th) th0 (- box_bend th0).
Proof. apply is_derive_Reals. unfold rate. derive_box. ring. Qed.

(* The ball leaves the wall w: its velocity points inwards, or it is not outwards and the acceleration is inwards. *)
Definition leaves (w : wall) (th0 u ta : R) : Prop :=
  (forall th, th0 < th < ta -> 0 < - side w * rate th0 u th) \/
  (0 <= - side w * u /\ forall th, th0 < th < ta -> 0 < - side w * box_bend th).

Lemma leaves_inwards w th0 u ta : leaves w th0 u ta -> forall th, th0 < th < ta -> 0 < - side w * rate th0 u th.
Proof.
  intros [h|[h a]] th r; [exact (h th r)|].
  assert (- side w * rate th0 u th0 < - side w * rate th0 u th).
  { apply (increasing (fun x => - side w * rate th0 u x) (fun x => - side w * box_bend x)); [lra| |].
    - intros c. apply (derivable_pt_lim_scal (rate th0 u)). apply rate_derivative.
    - intros c hc. apply a. lra. }
  unfold rate at 1 in H. replace (u + box_rate th0 - box_rate th0) with u in H by ring. lra.
Qed.

(* Departure on [th0, ta], middle on [ta, tb], arrival at w1 between lo and hi. *)
Theorem crossing (y half th0 u ta tb lo hi : R) (w1 : wall) :
  th0 <= ta <= tb -> tb <= lo <= hi -> th0 < lo ->
  (ta = th0 \/ exists w0, y = side w0 * half /\ leaves w0 th0 u ta) ->
  (forall th, ta <= th <= tb -> Rabs (y + rise th0 u th) < half) ->
  (forall th, tb <= th <= hi -> 0 < side w1 * rate th0 u th) ->
  side w1 * (y + rise th0 u lo) < half -> half <= side w1 * (y + rise th0 u hi) ->
  exists th1, lo <= th1 <= hi /\ y + rise th0 u th1 = side w1 * half /\
    forall th, th0 < th < th1 -> Rabs (y + rise th0 u th) < half.
Proof.
  intros o1 o2 o3 departure middle arrival low high.
  set (f := fun th => side w1 * (y + rise th0 u th)).
  assert (D : forall c, derivable_pt_lim f c (side w1 * rate th0 u c)).
  { intros c. apply (derivable_pt_lim_scal (fun th => y + rise th0 u th)).
    replace (rate th0 u c) with (0 + rate th0 u c) by ring.
    apply (derivable_pt_lim_plus (fun _ => y)); [apply derivable_pt_lim_const|apply rise_derivative]. }
  assert (side2 : side w1 * side w1 = 1) by (destruct w1; cbn; ring).
  destruct (IVT_gen f lo hi half) as (th1 & b & eq).
  { intros c. apply derivable_continuous_pt. exists (side w1 * rate th0 u c). apply D. }
  { rewrite Rmin_left, Rmax_right by (unfold f; lra). split; unfold f; lra. }
  rewrite Rmin_left, Rmax_right in b by lra.
  exists th1. split; [exact b|]. split.
  { unfold f in eq. rewrite <- eq. rewrite <- Rmult_assoc, side2. ring. }
  intros th r. destruct (Rle_lt_dec th ta) as [c|c].
  - destruct (Req_dec th ta) as [->|n]; [apply middle; lra|].
    destruct departure as [->|(w0 & on & out)]; [lra|].
    assert (v := leaves_inwards _ _ _ _ out).
    set (g := fun x => - side w0 * (y + rise th0 u x)).
    assert (G : forall c, derivable_pt_lim g c (- side w0 * rate th0 u c)).
    { intros x. apply (derivable_pt_lim_scal (fun th => y + rise th0 u th)).
      replace (rate th0 u x) with (0 + rate th0 u x) by ring.
      apply (derivable_pt_lim_plus (fun _ => y)); [apply derivable_pt_lim_const|apply rise_derivative]. }
    assert (g th0 < g th) by (apply (increasing g _ _ _ (proj1 r) G); intros x hx; apply v; lra).
    assert (g th < g ta) by (apply (increasing g _ th ta ltac:(lra) G); intros x hx; apply v; lra).
    assert (m := middle ta ltac:(lra)). apply Rabs_def2 in m. unfold g in *.
    replace (rise th0 u th0) with 0 in H by (unfold rise; ring).
    destruct w0; cbn in *; apply Rabs_def1; lra.
  - destruct (Rle_lt_dec th tb) as [c'|c']; [apply middle; lra|].
    assert (f tb < f th) by (apply (increasing f _ tb th c' D); intros x hx; apply arrival; lra).
    assert (f th < f th1) by (apply (increasing f _ th th1 (proj2 r) D); intros x hx; apply arrival; lra).
    assert (m := middle tb ltac:(lra)). apply Rabs_def2 in m. unfold f in *.
    destruct w1; cbn in *; apply Rabs_def1; lra.
Qed.

End Companions.

(* The same in the units of the scene. *)
Section Scene.
Variable s : scene.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.

Definition unit_speed (v : R) : R := v / (A s * W s).

(* Another harmonic in the units of the reference. *)
Definition companion_of (h : harmonic) : companion :=
  {| share := A h / A s; ratio := W h / W s; lag := tau h - W h / W s * tau s |}.
Definition companions : list companion := map companion_of (others s).

Lemma companion_phase_of h t : companion_phase (companion_of h) (phase s t) = phase h t.
Proof. unfold companion_phase, companion_of, phase. cbn. field. lra. Qed.
Lemma position_in_units t : box_position s t = A s * box_at companions (phase s t).
Proof.
  unfold box_position, box_at, companions, sum, swing. induction (others s) as [|h hs IH]; cbn [map fold_right]; [reflexivity|].
  rewrite IH, companion_phase_of. cbn [companion_of share]. field. lra.
Qed.
Lemma velocity_in_units t : box_velocity s t = A s * W s * box_rate companions (phase s t).
Proof.
  unfold box_velocity, box_rate, companions, sum, pace. induction (others s) as [|h hs IH]; cbn [map fold_right]; [reflexivity|].
  rewrite IH, companion_phase_of. cbn [companion_of share ratio]. field. lra.
Qed.
Lemma push_in_units t : box_push s t = A s * (W s)^2 * box_bend companions (phase s t).
Proof.
  unfold box_push, box_bend, companions, sum, push. induction (others s) as [|h hs IH]; cbn [map fold_right]; [reflexivity|].
  rewrite IH, companion_phase_of. cbn [companion_of share ratio]. field. lra.
Qed.
Lemma position_in_phases l t :
  free_position s l t = A s * (place l / A s + rise companions (phase s (since l)) (unit_speed (speed l)) (phase s t)).
Proof.
  unfold free_position, rise, unit_speed. rewrite !position_in_units, velocity_in_units.
  replace (phase s t - phase s (since l)) with (W s * (t - since l)) by (unfold phase; ring). field. lra.
Qed.
Lemma velocity_in_phases l t :
  free_velocity s l t = A s * W s * rate companions (phase s (since l)) (unit_speed (speed l)) (phase s t).
Proof. unfold free_velocity, rate, unit_speed. rewrite !velocity_in_units. field. lra. Qed.

Lemma phase_increasing a b : a < b <-> phase s a < phase s b.
Proof. unfold phase. split; nra. Qed.

Theorem flight l w1 ta tb lo hi : let th0 := phase s (since l) in let u := unit_speed (speed l) in
  let y := place l / A s in let half := d s / A s / 2 in
  th0 <= ta <= tb -> tb <= lo <= hi -> th0 < lo ->
  (ta = th0 \/ exists w0, y = side w0 * half /\ leaves companions w0 th0 u ta) ->
  (forall th, ta <= th <= tb -> Rabs (y + rise companions th0 u th) < half) ->
  (forall th, tb <= th <= hi -> 0 < side w1 * rate companions th0 u th) ->
  side w1 * (y + rise companions th0 u lo) < half -> half <= side w1 * (y + rise companions th0 u hi) ->
  exists i, reaches s l i /\ wall_of i = w1 /\ lo <= phase s (time i) <= hi /\
    y + rise companions th0 u (phase s (time i)) = side w1 * half /\
    unit_speed (velocity i) = rate companions th0 u (phase s (time i)).
Proof.
  intros th0 u y half o1 o2 o3 departure middle arrival low high.
  destruct (crossing companions y half th0 u ta tb lo hi w1 o1 o2 o3 departure middle arrival low high) as (th1 & b & on & inside).
  set (t1 := (th1 - tau s) / W s).
  assert (eq : phase s t1 = th1) by (unfold phase, t1; field; lra).
  assert (scaled : forall t, free_position s l t = A s * (y + rise companions th0 u (phase s t))) by apply position_in_phases.
  assert (halves : d s / 2 = A s * half) by (unfold half; field; lra).
  assert (positive : 0 < half). { assert (m := middle ta ltac:(lra)). assert (p := Rabs_pos (y + rise companions th0 u ta)). lra. }
  exists {| wall_of := w1; time := t1; velocity := free_velocity s l t1 |}. cbn. rewrite eq.
  repeat split; try assumption; try lra; cbn.
  - apply phase_increasing. fold th0. lra.
  - rewrite scaled, eq, on, halves, Rabs_mult, Rabs_mult, (Rabs_pos_eq (A s)), (Rabs_pos_eq half) by lra.
    destruct w1; cbn; [rewrite Rabs_left by lra|rewrite Rabs_right by lra]; ring.
  - intros t [r r']. rewrite scaled, halves, Rabs_mult, (Rabs_pos_eq (A s)) by lra.
    apply Rmult_lt_compat_l; [exact A_positive|]. apply inside. apply phase_increasing in r. apply phase_increasing in r'.
    rewrite eq in r'. fold th0 in r. lra.
  - rewrite scaled, eq, on. unfold plane. rewrite halves. ring.
  - rewrite velocity_in_phases, eq. fold th0 u. unfold unit_speed. field. lra.
Qed.
End Scene.
