(* The model of the horizontal impact pair, in physical units: eqs (10)-(15) with one harmonic (9).

   A ball moves freely in a gap of width d inside a box displaced by A sin (W t + tau); y is its displacement relative to
   the box's middle. Between impacts (11), (12); an impact when |y| = d/2 (14); then v+ = -e v- (15). Velocities of
   impacts are those BEFORE the impact, with their sign (left wall: <= 0, right wall: >= 0). *)
From Coq Require Import Reals Lra List.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(* A, W, tau, d, e of the paper. *)
Record scene := { A : R; W : R; tau : R; d : R; e : R }.

Inductive wall := left | right.
(* -1 on the left wall, 1 on the right one. *)
Definition side (w : wall) : R := match w with left => -1 | right => 1 end.
(* The place of a wall (14). *)
Definition plane (s : scene) (w : wall) : R := side w * (d s / 2).

(* A free flight begins at a time, a place and a velocity. *)
Record launch := { since : R; place : R; speed : R }.
Record impact := { wall_of : wall; time : R; velocity : R }.

Section Motion.
Variable s : scene.

Definition phase (t : R) : R := W s * t + tau s.

(* y (12) and y' (11), with c = speed + A W cos (W since + tau). *)
Definition free_position (l : launch) (t : R) : R :=
  - A s * sin (phase t) + (speed l + A s * W s * cos (phase (since l))) * (t - since l)
  + A s * sin (phase (since l)) + place l.
Definition free_velocity (l : launch) (t : R) : R :=
  - A s * W s * cos (phase t) + (speed l + A s * W s * cos (phase (since l))).

(* y' is the derivative of y, y'' = A W^2 sin (W t + tau) (10), and the flight begins where and as it should. *)
Lemma position_derivative l t : is_derive (free_position l) t (free_velocity l t).
Proof. unfold free_position, free_velocity, phase. auto_derive; [exact I|ring]. Qed.
Lemma velocity_derivative l t : is_derive (free_velocity l) t (A s * (W s)^2 * sin (phase t)).
Proof. unfold free_velocity, phase. auto_derive; [exact I|ring]. Qed.
Lemma position_start l : free_position l (since l) = place l.
Proof. unfold free_position. ring. Qed.
Lemma velocity_start l : free_velocity l (since l) = speed l.
Proof. unfold free_velocity. ring. Qed.

(* How the ball leaves an impact: from the wall, with -e times its velocity (15). *)
Definition rebound (i : impact) : launch :=
  {| since := time i; place := plane s (wall_of i); speed := - e s * velocity i |}.

(* t1 is the first time after t0 at which y touches a wall; before, the ball is strictly inside the gap. *)
Definition first_contact (y : R -> R) (t0 t1 : R) : Prop :=
  t0 < t1 /\ Rabs (y t1) = d s / 2 /\ forall t, t0 < t < t1 -> Rabs (y t) < d s / 2.

(* The flight that begins with l ends in impact i: its first contact. *)
Definition reaches (l : launch) (i : impact) : Prop :=
  first_contact (free_position l) (since l) (time i) /\
  free_position l (time i) = plane s (wall_of i) /\ velocity i = free_velocity l (time i).

(* One impact after another: P1-P4 (24)-(27) are this relation between the walls. *)
Definition next (i j : impact) : Prop := reaches (rebound i) j.

(* The impacts of `list` follow the launch, one by one. *)
Fixpoint follows (l : launch) (list : list impact) : Prop :=
  match list with nil => True | i :: rest => reaches l i /\ follows (rebound i) rest end.

Lemma first_contact_unique y t0 t1 t2 : first_contact y t0 t1 -> first_contact y t0 t2 -> t1 = t2.
Proof.
  intros (a & b & c) (a' & b' & c'). destruct (Rtotal_order t1 t2) as [h|[h|h]]; [|exact h|].
  - specialize (c' t1 (conj a h)). lra.
  - specialize (c t2 (conj a' h)). lra.
Qed.

(* With a gap, an orbit is a function of its beginning. *)
Hypothesis gap : 0 < d s.

Theorem reaches_unique l i j : reaches l i -> reaches l j -> i = j.
Proof.
  intros (c & p & v) (c' & p' & v'). destruct i as [w t u], j as [w' t' u']. cbn in *.
  assert (t = t') as <- by exact (first_contact_unique _ _ _ _ c c').
  subst u u'. rewrite p in p'. f_equal. unfold plane, side in p'. destruct w, w'; try reflexivity; lra.
Qed.

Theorem follows_unique a : forall l b, follows l a -> follows l b -> length a = length b -> a = b.
Proof.
  induction a as [|i a IH]; intros l [|j b]; cbn; try discriminate; [reflexivity|].
  intros [r f] [r' f'] h. assert (i = j) as <- by exact (reaches_unique l i j r r').
  f_equal. injection h as h. exact (IH _ _ f f' h).
Qed.

(* The model is periodic in time: a motion shifted by a period of the box is a motion. *)
Hypothesis shaking : W s <> 0.
Definition period : R := 2 * PI / W s.
Definition later (i : impact) : impact := {| wall_of := wall_of i; time := time i + period; velocity := velocity i |}.
Definition launch_later (l : launch) : launch := {| since := since l + period; place := place l; speed := speed l |}.

Lemma phase_later t : phase (t + period) = phase t + 2 * PI.
Proof. unfold phase, period. field. exact shaking. Qed.
Lemma position_later l t : free_position (launch_later l) (t + period) = free_position l t.
Proof. unfold free_position. cbn. rewrite !phase_later, !sin_plus, !cos_plus, sin_2PI, cos_2PI. ring. Qed.
Lemma velocity_later l t : free_velocity (launch_later l) (t + period) = free_velocity l t.
Proof. unfold free_velocity. cbn. rewrite !phase_later, !cos_plus, sin_2PI, cos_2PI. ring. Qed.

Theorem reaches_later l i : reaches l i -> reaches (launch_later l) (later i).
Proof.
  intros ((a & b & c) & p & v). unfold reaches, first_contact, later. cbn [wall_of time velocity].
  rewrite position_later, velocity_later. repeat split; try assumption; [cbn; lra|].
  intros t h. cbn in h. replace t with ((t - period) + period) by ring. rewrite position_later. apply c. lra.
Qed.
Theorem next_later i j : next i j -> next (later i) (later j).
Proof. intros h. exact (reaches_later _ _ h). Qed.
End Motion.
