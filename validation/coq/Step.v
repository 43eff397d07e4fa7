(* One flight from a launch to its first contact: when conditions on a few pieces of the flight hold, the ball reaches
   the named wall, first, within the named phases.

   Units of this file: phase th = W t + tau for time, A for lengths, A W for velocities. Then (12) and (11) read
     place + rise th0 u th,   rate th0 u th,
   with u the velocity at launch, and only d/A is left of the parameters. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model.
Open Scope R_scope.

Definition rise (th0 u th : R) : R := sin th0 - sin th + (u + cos th0) * (th - th0).
Definition rate (th0 u th : R) : R := u + cos th0 - cos th.

Lemma rise_derivative th0 u th : derivable_pt_lim (rise th0 u) th (rate th0 u th).
Proof. apply is_derive_Reals. unfold rise, rate. auto_derive; [exact I|ring]. Qed.
Lemma rate_derivative th0 u th : derivable_pt_lim (rate th0 u) th (sin th).
Proof. apply is_derive_Reals. unfold rate. auto_derive; [exact I|ring]. Qed.
(* The same displacement when the launch is later: the first entry of (A.7), times the velocity of arrival. *)
Lemma rise_derivative_launch th0 u th : derivable_pt_lim (fun x => rise x u th) th0 (- sin th0 * (th - th0) - u).
Proof. apply is_derive_Reals. unfold rise. auto_derive; [exact I|ring]. Qed.

Lemma increasing f f' a b : a < b -> (forall c, derivable_pt_lim f c (f' c)) -> (forall c, a < c < b -> 0 < f' c) -> f a < f b.
Proof.
  intros h D p. destruct (MVT_cor2 f f' a b h (fun c _ => D c)) as (c & eq & hc). specialize (p c hc). nra.
Qed.

(* The ball leaves the wall w: its velocity points inwards, or it is not outwards and the acceleration is inwards. *)
Definition leaves (w : wall) (th0 u ta : R) : Prop :=
  (forall th, th0 < th < ta -> 0 < - side w * rate th0 u th) \/
  (0 <= - side w * u /\ forall th, th0 < th < ta -> 0 < - side w * sin th).

Lemma leaves_inwards w th0 u ta : leaves w th0 u ta -> forall th, th0 < th < ta -> 0 < - side w * rate th0 u th.
Proof.
  intros [h|[h a]] th r; [exact (h th r)|].
  assert (- side w * rate th0 u th0 < - side w * rate th0 u th).
  { apply (increasing (fun x => - side w * rate th0 u x) (fun x => - side w * sin x)); [lra| |].
    - intros c. apply (derivable_pt_lim_scal (rate th0 u)). apply rate_derivative.
    - intros c hc. apply a. lra. }
  unfold rate at 1 in H. replace (u + cos th0 - cos th0) with u in H by ring. lra.
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

(* The same in the units of the scene. *)
Section Scene.
Variable s : scene.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.

Definition unit_speed (v : R) : R := v / (A s * W s).

Lemma position_in_phases l t :
  free_position s l t = A s * (place l / A s + rise (phase s (since l)) (unit_speed (speed l)) (phase s t)).
Proof. unfold free_position, rise, unit_speed, phase. field. lra. Qed.
Lemma velocity_in_phases l t : free_velocity s l t = A s * W s * rate (phase s (since l)) (unit_speed (speed l)) (phase s t).
Proof. unfold free_velocity, rate, unit_speed, phase. field. lra. Qed.

Lemma phase_increasing a b : a < b <-> phase s a < phase s b.
Proof. unfold phase. split; nra. Qed.

Theorem flight l w1 ta tb lo hi : let th0 := phase s (since l) in let u := unit_speed (speed l) in
  let y := place l / A s in let half := d s / A s / 2 in
  th0 <= ta <= tb -> tb <= lo <= hi -> th0 < lo ->
  (ta = th0 \/ exists w0, y = side w0 * half /\ leaves w0 th0 u ta) ->
  (forall th, ta <= th <= tb -> Rabs (y + rise th0 u th) < half) ->
  (forall th, tb <= th <= hi -> 0 < side w1 * rate th0 u th) ->
  side w1 * (y + rise th0 u lo) < half -> half <= side w1 * (y + rise th0 u hi) ->
  exists i, reaches s l i /\ wall_of i = w1 /\ lo <= phase s (time i) <= hi /\
    y + rise th0 u (phase s (time i)) = side w1 * half /\
    unit_speed (velocity i) = rate th0 u (phase s (time i)).
Proof.
  intros th0 u y half o1 o2 o3 departure middle arrival low high.
  destruct (crossing y half th0 u ta tb lo hi w1 o1 o2 o3 departure middle arrival low high) as (th1 & b & on & inside).
  set (t1 := (th1 - tau s) / W s).
  assert (eq : phase s t1 = th1) by (unfold phase, t1; field; lra).
  assert (scaled : forall t, free_position s l t = A s * (y + rise th0 u (phase s t))) by apply position_in_phases.
  assert (halves : d s / 2 = A s * half) by (unfold half; field; lra).
  assert (positive : 0 < half). { assert (m := middle ta ltac:(lra)). assert (p := Rabs_pos (y + rise th0 u ta)). lra. }
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
