(* The model of the horizontal impact pair, in physical units: eqs (10)-(15) with any number of harmonics (1).

   A ball moves freely in a gap of width d inside a box displaced by E(t), a sum of A sin (W t + tau); y is its displacement
   relative to the box's middle. Between impacts (11), (12); an impact when |y| = d/2 (14); then v+ = -e v- (15). Velocities
   of impacts are those BEFORE the impact, with their sign (left wall: <= 0, right wall: >= 0). *)
From Coq Require Import Reals Lra Lia List ZArith.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.
Import ListNotations.

(* A, W, tau of the paper; a scene has one harmonic, which is the reference, or also others; and d, e of the paper. A scene stands for its
   reference where a harmonic is required. *)
Record harmonic := { A : R; W : R; tau : R }.
Record scene := { reference :> harmonic; others : list harmonic; d : R; e : R }.

Inductive wall := left | right.
(* -1 on the left wall, 1 on the right one. *)
Definition side (w : wall) : R := match w with left => -1 | right => 1 end.
(* The other wall. *)
Definition opposite (w : wall) : wall := match w with left => right | right => left end.
Lemma side_opposite w : side (opposite w) = - side w.
Proof. destruct w; cbn; ring. Qed.
(* The place of a wall (14). *)
Definition plane (s : scene) (w : wall) : R := side w * (d s / 2).

(* A free flight begins at a time, a place and a velocity. *)
Record launch := { since : R; place : R; speed : R }.
Record impact := { wall_of : wall; time : R; velocity : R }.

Definition phase (h : harmonic) (t : R) : R := W h * t + tau h.

(* A sum over items, after a first number. *)
Definition sum {item : Type} (first : R) (term : item -> R) (items : list item) : R :=
  fold_right (fun x rest => rest + term x) first items.
Lemma sum_derivative {item : Type} first first' (term term' : item -> R -> R) items t : is_derive first t first' ->
  (forall x, is_derive (term x) t (term' x t)) ->
  is_derive (fun t => sum (first t) (fun x => term x t) items) t (sum first' (fun x => term' x t) items).
Proof.
  intros f D. induction items as [|x items IH]; cbn; [exact f|].
  exact (is_derive_plus (V := R_NormedModule) _ _ _ _ _ IH (D x)).
Qed.

Section Motion.
Variable s : scene.

(* The box: E (1), E' and -E''. *)
Definition swing (h : harmonic) (t : R) : R := A h * sin (phase h t).
Definition pace (h : harmonic) (t : R) : R := A h * W h * cos (phase h t).
Definition push (h : harmonic) (t : R) : R := A h * (W h)^2 * sin (phase h t).
Definition box_position (t : R) : R := sum (swing s t) (fun h => swing h t) (others s).
Definition box_velocity (t : R) : R := sum (pace s t) (fun h => pace h t) (others s).
Definition box_push (t : R) : R := sum (push s t) (fun h => push h t) (others s).

(* y (12) and y' (11), with c = speed + E' (since). *)
Definition free_position (l : launch) (t : R) : R :=
  - box_position t + (speed l + box_velocity (since l)) * (t - since l) + box_position (since l) + place l.
Definition free_velocity (l : launch) (t : R) : R := - box_velocity t + (speed l + box_velocity (since l)).

Lemma box_position_derivative t : is_derive box_position t (box_velocity t).
Proof. apply (sum_derivative (swing s) _ swing pace); intros; unfold swing, pace, phase; auto_derive; try exact I; ring. Qed.
Lemma box_velocity_derivative t : is_derive box_velocity t (- box_push t).
Proof.
  replace (- box_push t) with (sum (- push s t) (fun h => - push h t) (others s)).
  - apply (sum_derivative (pace s) _ pace (fun h t => - push h t)); intros; unfold pace, push, phase; auto_derive; try exact I; ring.
  - unfold box_push, sum. induction (others s) as [|h hs IH]; cbn; [|rewrite IH]; ring.
Qed.
(* y' is the derivative of y, y'' = -E'' (10), and the flight begins where and as it should. *)
Lemma position_derivative l t : is_derive (free_position l) t (free_velocity l t).
Proof.
  assert (D := box_position_derivative t). unfold free_position, free_velocity.
  auto_derive; [exists (box_velocity t); exact D|]. replace (Derive (fun x => box_position x) t) with (box_velocity t) by (symmetry; apply is_derive_unique, D). ring.
Qed.
Lemma velocity_derivative l t : is_derive (free_velocity l) t (box_push t).
Proof.
  assert (D := box_velocity_derivative t). unfold free_velocity.
  auto_derive; [exists (- box_push t); exact D|]. replace (Derive (fun x => box_velocity x) t) with (- box_push t) by (symmetry; apply is_derive_unique, D). ring.
Qed.
Lemma position_start l : free_position l (since l) = place l.
Proof. unfold free_position. ring. Qed.
Lemma velocity_start l : free_velocity l (since l) = speed l.
Proof. unfold free_velocity. ring. Qed.

(* The start of the flight after an impact: from the wall, with -e times its velocity (15). *)
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

(* One harmonic (9). *)
Section One.
Hypothesis one_harmonic : others s = [].
Lemma one_position l t : free_position l t =
  - A s * sin (phase s t) + (speed l + A s * W s * cos (phase s (since l))) * (t - since l)
  + A s * sin (phase s (since l)) + place l.
Proof. unfold free_position, box_position, box_velocity. rewrite one_harmonic. unfold sum, swing, pace. cbn. ring. Qed.
Lemma one_velocity l t : free_velocity l t = - A s * W s * cos (phase s t) + (speed l + A s * W s * cos (phase s (since l))).
Proof. unfold free_velocity, box_velocity. rewrite one_harmonic. unfold sum, pace. cbn. ring. Qed.
Lemma one_push t : box_push t = A s * (W s)^2 * sin (phase s t).
Proof. unfold box_push. rewrite one_harmonic. reflexivity. Qed.
End One.
End Motion.

Lemma sin_turns x m : sin (x - IZR m * (2 * PI)) = sin x.
Proof.
  destruct (Z_le_gt_dec 0 m).
  - rewrite <- (sin_period _ (Z.to_nat m)). f_equal. rewrite INR_IZR_INZ, Z2Nat.id by lia. ring.
  - rewrite <- (sin_period x (Z.to_nat (- m))). f_equal. rewrite INR_IZR_INZ, Z2Nat.id, opp_IZR by lia. ring.
Qed.

(* A motion shifted by a time in which every harmonic completes whole periods is a motion. *)
Section Later.
Variable s : scene.
Variable P : R.
Definition recurs : Prop := forall h, In h (reference s :: others s) -> exists n, W h * P = IZR n * (2 * PI).
Hypothesis whole_turns : recurs.
Definition later (i : impact) : impact := {| wall_of := wall_of i; time := time i + P; velocity := velocity i |}.
Definition launch_later (l : launch) : launch := {| since := since l + P; place := place l; speed := speed l |}.

Lemma harmonic_later h t : In h (reference s :: others s) ->
  sin (phase h (t + P)) = sin (phase h t) /\ cos (phase h (t + P)) = cos (phase h t).
Proof.
  intros i. destruct (whole_turns h i) as (n & eq).
  replace (phase h (t + P)) with (phase h t + IZR n * (2 * PI)) by (unfold phase; rewrite <- eq; ring).
  rewrite !cos_sin. rewrite <- (sin_turns (_ + _) n), <- (sin_turns (PI / 2 + (_ + _)) n). split; f_equal; ring.
Qed.
Lemma sum_later (f : harmonic -> R -> R) t : (forall h, In h (reference s :: others s) -> f h (t + P) = f h t) ->
  sum (f s (t + P)) (fun h => f h (t + P)) (others s) = sum (f s t) (fun h => f h t) (others s).
Proof.
  intros same. unfold sum. rewrite (same s (or_introl eq_refl)).
  assert (rest : forall h, In h (others s) -> f h (t + P) = f h t) by (intros h i; apply same; right; exact i). clear same.
  induction (others s) as [|h hs IH]; cbn; [reflexivity|]. rewrite IH, (rest h); [reflexivity|left; reflexivity|].
  intros k i. apply rest. right. exact i.
Qed.
Lemma box_position_later t : box_position s (t + P) = box_position s t.
Proof. apply (sum_later swing). intros h i. unfold swing. rewrite (proj1 (harmonic_later h t i)). reflexivity. Qed.
Lemma box_velocity_later t : box_velocity s (t + P) = box_velocity s t.
Proof. apply (sum_later pace). intros h i. unfold pace. rewrite (proj2 (harmonic_later h t i)). reflexivity. Qed.
Lemma position_later l t : free_position s (launch_later l) (t + P) = free_position s l t.
Proof. unfold free_position. cbn. rewrite !box_position_later, box_velocity_later. ring. Qed.
Lemma velocity_later l t : free_velocity s (launch_later l) (t + P) = free_velocity s l t.
Proof. unfold free_velocity. cbn. rewrite !box_velocity_later. ring. Qed.

Theorem reaches_later l i : reaches s l i -> reaches s (launch_later l) (later i).
Proof.
  intros ((a & b & c) & p & v). unfold reaches, first_contact, later. cbn [wall_of time velocity].
  rewrite position_later, velocity_later. repeat split; try assumption; [cbn; lra|].
  intros t h. cbn in h. replace t with ((t - P) + P) by ring. rewrite position_later. apply c. lra.
Qed.
Theorem next_later i j : next s i j -> next s (later i) (later j).
Proof. intros h. exact (reaches_later _ _ h). Qed.
End Later.

(* The period of one harmonic. *)
Definition period (s : scene) : R := 2 * PI / W s.
Lemma phase_later (s : scene) t : W s <> 0 -> phase s (t + period s) = phase s t + 2 * PI.
Proof. intros shaking. unfold phase, period. field. exact shaking. Qed.
Lemma period_recurs s : others s = [] -> W s <> 0 -> recurs s (period s).
Proof. intros one shaking h. rewrite one. intros [<-|[]]. exists 1%Z. unfold period. field. exact shaking. Qed.
