(* A region that all flights from its boxes come back to, in the units of Step.v, satisfies the claims of a document, in the scene's
   (`region_kept`). *)
From Coq Require Import Reals Lra List Sorted ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model Step Certificate Document Motion Orbit Cycle Region.
Open Scope R_scope.
Import ListNotations.

Section Kept.
Variable s : scene.
Variable r : region.
Variables least most : R.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.
Hypothesis one : one_harmonic s.
Let D := d s / A s.
Hypothesis all_kept : forall th w, in_boxes r th w -> kept D r least most th (e s * w).

Definition launch_seen (i : impact) : R := e s * speed_seen s i.
Definition phase_from (i : impact) (t : R) : R := phase s t + seen (wall_of i).
Definition far_from (i j : impact) : bool := match wall_of i, wall_of j with left, left | right, right => false | _, _ => true end.

Lemma D_positive : 0 < D.
Proof. unfold D. apply Rdiv_lt_0_compat; assumption. Qed.
Lemma position_seen i t : free_position s (rebound s i) t = side (wall_of i) * (d s / 2 - A s * height_at (phase_seen s i) (launch_seen i) (phase_from i t)).
Proof.
  rewrite one_position by exact one. rewrite height_is. unfold phase_seen, phase_from, launch_seen, speed_seen, unit_speed. cbn [rebound since speed place].
  replace (phase s t + seen (wall_of i) - (phase s (time i) + seen (wall_of i))) with (W s * (t - time i)) by (unfold phase; ring).
  unfold plane, side. destruct (wall_of i); cbn [seen]; rewrite ?Rplus_0_r, ?neg_sin, ?neg_cos; field; lra.
Qed.
Lemma velocity_seen i t : free_velocity s (rebound s i) t = - side (wall_of i) * (A s * W s * rate_at (phase_seen s i) (launch_seen i) (phase_from i t)).
Proof.
  rewrite one_velocity by exact one. rewrite rate_is. unfold phase_seen, phase_from, launch_seen, speed_seen, unit_speed. cbn [rebound since speed place].
  unfold side. destruct (wall_of i); cbn [seen]; rewrite ?Rplus_0_r, ?neg_cos; field; lra.
Qed.
Lemma inside_seen i t : Rabs (free_position s (rebound s i) t) <= d s / 2 <-> 0 <= height_at (phase_seen s i) (launch_seen i) (phase_from i t) <= D.
Proof.
  rewrite position_seen. set (h := height_at _ _ _). assert (eq : d s = A s * D) by (unfold D; field; lra).
  assert (flip : forall x, Rabs (side (wall_of i) * x) = Rabs x) by (intros x; destruct (wall_of i); cbn; [replace (-1 * x) with (- x) by ring; apply Rabs_Ropp|f_equal; ring]).
  rewrite flip. split; intros k.
  - apply Rabs_le_between in k. split; apply (Rmult_le_reg_l (A s)); lra.
  - apply Rabs_le_between. assert (0 <= A s * h) by (apply Rmult_le_pos; lra). assert (A s * h <= A s * D) by (apply Rmult_le_compat_l; lra). lra.
Qed.
Lemma strictly_inside_seen i t : 0 < height_at (phase_seen s i) (launch_seen i) (phase_from i t) < D -> Rabs (free_position s (rebound s i) t) < d s / 2.
Proof.
  rewrite position_seen. set (h := height_at _ _ _). assert (eq : d s = A s * D) by (unfold D; field; lra). intros k.
  assert (0 < A s * h) by (apply Rmult_lt_0_compat; lra). assert (A s * h < A s * D) by (apply Rmult_lt_compat_l; lra).
  destruct (wall_of i); cbn; apply Rabs_def1; lra.
Qed.
Lemma from_increasing i t t' : phase_from i t < phase_from i t' <-> t < t'.
Proof. unfold phase_from, phase. split; nra. Qed.
Lemma from_start i : phase_from i (time i) = phase_seen s i.
Proof. reflexivity. Qed.
Lemma on_wall_seen i j : free_position s (rebound s i) (time j) = plane s (wall_of j) <->
  height_at (phase_seen s i) (launch_seen i) (phase_from i (time j)) = level D (far_from i j).
Proof.
  rewrite position_seen. set (h := height_at _ _ _). assert (eq : d s = A s * D) by (unfold D; field; lra).
  assert (zero : A s * h = 0 <-> h = 0) by (split; [intros k; apply Rmult_integral in k; lra|intros ->; ring]).
  assert (full : A s * h = A s * D <-> h = D) by (split; [intros k; apply (Rmult_eq_reg_l (A s)); lra|intros ->; reflexivity]).
  unfold plane, far_from, level. destruct (wall_of i), (wall_of j); cbn; rewrite <- ?zero, <- ?full; lra.
Qed.
Lemma comes_seen i j : comes_to s (rebound s i) j -> comes D (phase_seen s i) (launch_seen i) (phase_from i (time j)) (far_from i j).
Proof.
  intros (o & inside & on & _). cbn [rebound since] in *. split; [apply from_increasing, o|]. split; [|apply on_wall_seen, on].
  intros th h. set (t := (th - seen (wall_of i) - tau s) / W s). assert (eq : phase_from i t = th) by (unfold phase_from, phase, t; field; lra).
  rewrite <- eq in h |- *. apply inside_seen, inside. rewrite <- from_start in h. destruct h as [h h']. apply from_increasing in h, h'. lra.
Qed.
(* Statements about a landing in the units of Step.v hold of the impact. *)
Lemma in_region_seen i j : velocity j = free_velocity s (rebound s i) (time j) ->
  in_boxes r (phase_from i (time j) + (if far_from i j then PI else 0)) (towards (far_from i j) * rate_at (phase_seen s i) (launch_seen i) (phase_from i (time j))) ->
  in_region s r j.
Proof.
  intros v. set (w := rate_at _ _ _). unfold in_region, speed_seen, phase_seen. rewrite v, velocity_seen. fold w. unfold phase_from, far_from, unit_speed, side, towards.
  assert (same : forall th th' u u', in_boxes r th u -> th = th' -> u = u' -> in_boxes r th' u') by (intros; subst; assumption).
  destruct (wall_of i), (wall_of j); cbn [seen]; intros h;
    [|  |apply (in_boxes_turned r (-1))| ]; apply (same _ _ _ _ h); (ring || (field; lra)).
Qed.

Lemma kept_comes i j : in_region s r i -> comes_to s (rebound s i) j -> in_region s r j /\ least <= W s * (time j - time i) <= most.
Proof.
  intros inr c. destruct (all_kept _ _ inr) as (_ & _ & all). destruct (all _ _ (comes_seen i j c)) as [lasts boxed].
  split; [apply (in_region_seen i j); [apply c|exact boxed]|]. unfold phase_from, phase_seen, phase in lasts. lra.
Qed.
Lemma kept_reaches i : in_region s r i -> exists j, reaches s (rebound s i) j.
Proof.
  intros inr. destruct (all_kept _ _ inr) as (dep & out & _). destruct (first_comes D D_positive _ _ dep out) as (th1 & far & o & inside & on).
  fold (launch_seen i) in *. set (t := (th1 - seen (wall_of i) - tau s) / W s). assert (eq : phase_from i t = th1) by (unfold phase_from, phase, t; field; lra).
  set (w := if far then opposite (wall_of i) else wall_of i).
  set (j := {| wall_of := w; time := t; velocity := free_velocity s (rebound s i) t |}).
  assert (far_is : far_from i j = far) by (unfold far_from; cbn; unfold w; destruct far, (wall_of i); reflexivity).
  assert (place_is : free_position s (rebound s i) t = plane s w) by (apply (on_wall_seen i j); cbn [time j]; rewrite far_is, eq; exact on).
  exists j. split; [split; [|split]|split; [exact place_is|reflexivity]].
  - cbn. apply (from_increasing i). rewrite eq, from_start. exact o.
  - cbn [time j]. rewrite place_is. unfold plane. destruct w; cbn; [rewrite Rabs_left by lra|rewrite Rabs_right by lra]; lra.
  - intros x [h h']. cbn in h, h'. apply strictly_inside_seen, inside. apply (from_increasing i) in h, h'. rewrite eq in h'. rewrite from_start in h. lra.
Qed.

(* No rest at once: the contact force would have the wrong sign. *)
Lemma no_rest_at_once i w t : in_region s r i -> ~ happens s (Flying (rebound s i)) (Rests w t false).
Proof.
  intros inr (on & still & -> & (later & l & press)). destruct (kept_reaches i inr) as (j & ((o & _ & inside) & _)). cbn [rebound since place] in *.
  set (m := Rmin later (time j)). assert (m <= later) by apply Rmin_l. assert (m <= time j) by apply Rmin_r. assert (time i < m) by (apply Rmin_glb_lt; lra).
  assert (scaled : forall g g' x, derivable_pt_lim g x g' -> derivable_pt_lim (fun x => side w * g x) x (side w * g')) by (intros g g' x; apply derivable_pt_lim_scal).
  assert (dv : forall x, derivable_pt_lim (fun x => side w * free_velocity s (rebound s i) x) x (side w * box_push s x)) by (intros x; apply scaled, is_derive_Reals, velocity_derivative).
  assert (dy : forall x, derivable_pt_lim (fun x => side w * free_position s (rebound s i) x) x (side w * free_velocity s (rebound s i) x)) by (intros x; apply scaled, is_derive_Reals, position_derivative).
  assert (v0 := velocity_start s (rebound s i)). assert (y0 := position_start s (rebound s i)). cbn [rebound since place speed] in v0, y0. cbn [rebound speed] in still.
  set (x := (time i + m) / 2).
  assert (speeds_up : forall y, time i < y < m -> 0 < side w * free_velocity s (rebound s i) y).
  { intros y hy. assert (more : side w * free_velocity s (rebound s i) (time i) < side w * free_velocity s (rebound s i) y); [|rewrite v0, still in more; lra].
    apply (increasing _ _ _ _ (proj1 hy) dv). intros c hc. apply press. lra. }
  assert (out : side w * free_position s (rebound s i) (time i) < side w * free_position s (rebound s i) x).
  { assert (hx : time i < x) by (unfold x; lra). apply (increasing _ _ _ _ hx dy). intros c hc. apply speeds_up. unfold x in hc. lra. }
  specialize (inside x ltac:(unfold x; lra)). rewrite y0, on in out. unfold plane in out. apply Rabs_def2 in inside. destruct w; cbn in *; lra.
Qed.
Hypothesis least_positive : 0 < least.
Lemma no_accumulation i w t : in_region s r i -> ~ accumulates s (rebound s i) w t.
Proof.
  intros inr (f & first & each & _). assert (go : forall n, in_region s r (f n) /\ W s * time i + INR n * least <= W s * time (f n)).
  { induction n as [|n [inr' IH]].
    - destruct (kept_comes i (f O) inr (reaches_comes _ _ _ first)) as [a b]. split; [exact a|]. cbn [INR]. lra.
    - destruct (each n) as (nx & _). destruct (kept_comes _ _ inr' (reaches_comes _ _ _ nx)) as [a b]. split; [exact a|]. rewrite S_INR. lra. }
  assert (later : time i < t) by (destruct (each O) as (_ & _ & b); destruct (kept_comes i (f O) inr (reaches_comes _ _ _ first)); cbn in *; nra).
  destruct (nfloor_ex (W s * (t - time i) / least)) as (k & _ & big); [apply Rdiv_le_0_compat; [apply Rmult_le_pos; lra|exact least_positive]|].
  rewrite <- S_INR in big. set (n := S k) in *. apply (Rmult_lt_compat_r least) in big; [|exact least_positive].
  replace (W s * (t - time i) / least * least) with (W s * (t - time i)) in big by (field; lra).
  destruct (go n) as [_ late]. destruct (each n) as (_ & _ & before). apply (Rmult_lt_compat_l (W s)) in before; [|exact W_positive]. lra.
Qed.

Theorem region_kept f i : (forall j, in_region s r j -> is_as_fast s f j) ->
  (forall a b, least <= W s * (time b - time a) <= most -> flight_lasts s f a b) -> in_region s r i -> stays s r f i.
Proof.
  intros fast lasts inr. split; [|split].
  - intros n. revert i inr. induction n as [|n IH]; intros i inr; [exists []; split; [reflexivity|exact I]|].
    destruct (kept_reaches i inr) as (j & rj). destruct (kept_comes i j inr (reaches_comes _ _ _ rj)) as [inr' _].
    destruct (IH j inr') as (orbit & len & fol). exists (j :: orbit). split; [cbn; rewrite len; reflexivity|split; assumption].
  - intros orbit. revert i inr. induction orbit as [|j orbit IH]; intros i inr; cbn [comes_along flights_last]; [split; [constructor|exact I]|].
    intros [c more]. destruct (kept_comes i j inr c) as [inr' time']. destruct (IH j inr' more) as [all times].
    split; [constructor; [split; [exact inr'|exact (fast j inr')]|exact all]|]. split; [exact (lasts _ _ time')|exact times].
  - intros [j|w t [|]|w t] h.
    + exists j. reflexivity.
    + destruct h as [acc _]. destruct (no_accumulation _ _ _ inr acc).
    + destruct (no_rest_at_once _ _ _ inr h).
    + destruct h.
Qed.
End Kept.
