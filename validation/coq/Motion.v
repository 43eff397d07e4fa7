(* Motions with rests. A ball flies, or sticks to a wall under contact force; a flight ends with an impact, or with infinitely many of them that
   accumulate at a time, or not at all where the ball has no velocity and is pressed; a rest ends where the wall no longer presses. `goes_unique`:
   which of these happens next is the ball's only choice of words; when and where it does is a function of the beginning. *)
From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model.
Open Scope R_scope.
Import ListNotations.

Inductive standing := Flying (l : launch) | Resting (w : wall) (t : R).
(* An impact; a rest, after infinitely many impacts or at once; a release. *)
Inductive happening := Hits (i : impact) | Rests (w : wall) (t : R) (bounces : bool) | Leaves (w : wall) (t : R).
Definition moment (h : happening) : R := match h with Hits i => time i | Rests _ t _ | Leaves _ t => t end.
Definition kind (h : happening) : nat := match h with Hits _ => 0 | Rests _ _ true => 1 | Rests _ _ false => 2 | Leaves _ _ => 3 end.

Section Scene.
Variable s : scene.

(* The contact force acts between two times, and for some time after one; and it does not act for some time. *)
Definition pressed (w : wall) (t0 t1 : R) : Prop := forall t, t0 < t < t1 -> 0 < side w * box_push s t.
Definition pressed_from (w : wall) (t : R) : Prop := exists later, t < later /\ pressed w t later.
Definition free_from (w : wall) (t : R) : Prop := exists later, t < later /\ forall x, t < x < later -> side w * box_push s x < 0.

(* Infinitely many impacts on one wall, one after another, before a time that is the limit of theirs; velocities tend to 0. *)
Definition accumulates (l : launch) (w : wall) (limit : R) : Prop := exists impacts : nat -> impact,
  reaches s l (impacts O) /\ (forall n, next s (impacts n) (impacts (S n)) /\ wall_of (impacts n) = w /\ time (impacts n) < limit) /\
  is_lim_seq (fun n => time (impacts n)) limit /\ is_lim_seq (fun n => velocity (impacts n)) 0.

Definition happens (a : standing) (h : happening) : Prop :=
  match a, h with
  | Flying l, Hits i => reaches s l i
  | Flying l, Rests w t true => accumulates l w t /\ pressed_from w t
  | Flying l, Rests w t false => place l = plane s w /\ speed l = 0 /\ t = since l /\ pressed_from w t
  | Resting w t, Leaves w' t' => w' = w /\ t < t' /\ pressed w t t' /\ free_from w t'
  | _, _ => False
  end.
(* A ball that is released leaves the wall without velocity. *)
Definition released (w : wall) (t : R) : launch := {| since := t; place := plane s w; speed := 0 |}.
Definition then_ (h : happening) : standing :=
  match h with Hits i => Flying (rebound s i) | Rests w t _ => Resting w t | Leaves w t => Flying (released w t) end.
Fixpoint goes (a : standing) (motion : list happening) : Prop :=
  match motion with [] => True | h :: motion => happens a h /\ goes (then_ h) motion end.
Fixpoint after_all (a : standing) (motion : list happening) : standing :=
  match motion with [] => a | h :: motion => after_all (then_ h) motion end.

Lemma after_all_app xs : forall a ys, after_all a (xs ++ ys) = after_all (after_all a xs) ys.
Proof. induction xs as [|h xs IH]; intros a ys; [reflexivity|apply IH]. Qed.
Lemma goes_app xs : forall a ys, goes a (xs ++ ys) -> goes a xs /\ goes (after_all a xs) ys.
Proof. induction xs as [|h xs IH]; intros a ys; cbn; [tauto|]. intros [r f]. destruct (IH _ _ f). tauto. Qed.

Hypothesis gap : 0 < d s.

Lemma accumulates_unique l w t w' t' : accumulates l w t -> accumulates l w' t' -> w = w' /\ t = t'.
Proof.
  intros (f & first & each & times & _) (g & first' & each' & times' & _).
  assert (same : forall n, f n = g n).
  { induction n as [|n IH]; [exact (reaches_unique s gap _ _ _ first first')|].
    destruct (each n) as [a _], (each' n) as [b _]. rewrite IH in a. exact (reaches_unique s gap _ _ _ a b). }
  split; [destruct (each O) as (_ & <- & _), (each' O) as (_ & <- & _); rewrite same; reflexivity|].
  apply (is_lim_seq_ext _ (fun n => time (g n))) in times; [|intros n; rewrite same; reflexivity].
  apply is_lim_seq_unique in times. apply is_lim_seq_unique in times'. rewrite times in times'. injection times' as ->. reflexivity.
Qed.
Lemma plane_unique w w' : plane s w = plane s w' -> w = w'.
Proof. unfold plane, side. destruct w, w'; intros; try reflexivity; lra. Qed.
Lemma release_unique w t t1 t2 : t < t1 -> t < t2 -> pressed w t t1 -> pressed w t t2 -> free_from w t1 -> free_from w t2 -> t1 = t2.
Proof.
  assert (no_later : forall a b, t < a -> pressed w t b -> free_from w a -> a < b -> False).
  { intros a b h p (later & l & f) ab. set (x := (a + Rmin later b) / 2).
    assert (Rmin later b <= later) by apply Rmin_l. assert (Rmin later b <= b) by apply Rmin_r. assert (a < Rmin later b) by (apply Rmin_glb_lt; lra).
    specialize (f x ltac:(unfold x; lra)). specialize (p x ltac:(unfold x; lra)). lra. }
  intros h1 h2 p1 p2 f1 f2. destruct (Rtotal_order t1 t2) as [h|[h|h]]; [destruct (no_later t1 t2)|exact h|destruct (no_later t2 t1)]; assumption.
Qed.

Theorem happens_unique a x y : happens a x -> happens a y -> kind x = kind y -> x = y.
Proof.
  destruct a as [l|w t], x as [i|w1 t1 [|]|w1 t1], y as [j|w2 t2 [|]|w2 t2]; cbn; try discriminate; try tauto.
  - intros r r' _. f_equal. exact (reaches_unique s gap _ _ _ r r').
  - intros (r & _) (r' & _) _. destruct (accumulates_unique _ _ _ _ _ r r') as [-> ->]. reflexivity.
  - intros (p & _ & -> & _) (p' & _ & -> & _) _. f_equal. apply plane_unique. congruence.
  - intros (-> & h1 & p1 & f1) (-> & h2 & p2 & f2) _. f_equal. exact (release_unique w t t1 t2 h1 h2 p1 p2 f1 f2).
Qed.
Theorem goes_unique xs : forall a ys, goes a xs -> goes a ys -> map kind xs = map kind ys -> xs = ys.
Proof.
  induction xs as [|x xs IH]; intros a [|y ys]; cbn [goes map]; try discriminate; [reflexivity|].
  intros [r f] [r' f'] h. injection h as h more. assert (x = y) as <- by exact (happens_unique a x y r r' h). f_equal. exact (IH _ _ f f' more).
Qed.
End Scene.

(* A motion shifted by a time in which every harmonic completes whole periods is a motion. *)
Section Later.
Variable s : scene.
Variable P : R.
Hypothesis whole_turns : recurs s P.
Definition later_on (h : happening) : happening :=
  match h with Hits i => Hits (later P i) | Rests w t b => Rests w (t + P) b | Leaves w t => Leaves w (t + P) end.
Definition standing_later (a : standing) : standing := match a with Flying l => Flying (launch_later P l) | Resting w t => Resting w (t + P) end.

Lemma push_later t : box_push s (t + P) = box_push s t.
Proof. apply (sum_later s P push). intros h i. unfold push. rewrite (proj1 (harmonic_later s P whole_turns h t i)). reflexivity. Qed.
Lemma pressed_later w a b : pressed s w a b -> pressed s w (a + P) (b + P).
Proof. intros p t h. replace t with ((t - P) + P) by ring. rewrite push_later. apply p. lra. Qed.
Lemma pressed_from_later w a : pressed_from s w a -> pressed_from s w (a + P).
Proof. intros (b & ab & p). exists (b + P). split; [lra|exact (pressed_later _ _ _ p)]. Qed.
Lemma free_from_later w a : free_from s w a -> free_from s w (a + P).
Proof. intros (b & ab & p). exists (b + P). split; [lra|]. intros t h. replace t with ((t - P) + P) by ring. rewrite push_later. apply p. lra. Qed.
Lemma accumulates_later l w t : accumulates s l w t -> accumulates s (launch_later P l) w (t + P).
Proof.
  intros (f & first & each & times & speeds). exists (fun n => later P (f n)). split; [exact (reaches_later s P whole_turns _ _ first)|].
  split; [|split; [exact (is_lim_seq_plus' _ _ _ _ times (is_lim_seq_const P))|exact speeds]].
  intros n. destruct (each n) as (follow & on & before). split; [exact (next_later s P whole_turns _ _ follow)|]. cbn [later wall_of time]. split; [exact on|lra].
Qed.
Lemma happens_later a h : happens s a h -> happens s (standing_later a) (later_on h).
Proof.
  destruct a as [l|w t], h as [i|w1 t1 [|]|w1 t1]; cbn; try tauto.
  - exact (reaches_later s P whole_turns l i).
  - intros [acc p]. split; [exact (accumulates_later _ _ _ acc)|exact (pressed_from_later _ _ p)].
  - intros (p & v & -> & press). repeat split; try assumption. exact (pressed_from_later _ _ press).
  - intros (-> & h & p & f). split; [reflexivity|]. split; [lra|]. split; [exact (pressed_later _ _ _ p)|exact (free_from_later _ _ f)].
Qed.
Lemma then_later h : then_ s (later_on h) = standing_later (then_ s h).
Proof. destruct h; reflexivity. Qed.
Theorem goes_later motion : forall a, goes s a motion -> goes s (standing_later a) (map later_on motion).
Proof.
  induction motion as [|h motion IH]; intros a; cbn [goes map]; [trivial|]. intros [x g]. split; [exact (happens_later _ _ x)|].
  rewrite then_later. exact (IH _ g).
Qed.
Lemma after_later motion : forall a, after_all s (standing_later a) (map later_on motion) = standing_later (after_all s a motion).
Proof. induction motion as [|h motion IH]; intros a; cbn [after_all map]; [reflexivity|]. rewrite then_later. apply IH. Qed.
End Later.

(* A release is that of another rest on the same wall, later, if both rests, one seen that much later, have a time in common. *)
Lemma release_later s P (whole_turns : recurs s P) w t0 t1 t2 t3 : happens s (Resting w t0) (Leaves w t1) -> happens s (Resting w t2) (Leaves w t3) ->
  t2 < t1 + P -> t0 + P < t3 -> t3 = t1 + P.
Proof.
  intros (_ & o1 & p1 & f1) (_ & o2 & p2 & f2) h1 h2. assert (p1' := pressed_later s P whole_turns _ _ _ p1).
  set (t := Rmax (t0 + P) t2). assert (t0 + P <= t) by apply Rmax_l. assert (t2 <= t) by apply Rmax_r.
  symmetry. apply (release_unique s w t).
  - apply Rmax_lub_lt; lra.
  - apply Rmax_lub_lt; lra.
  - intros x hx. apply p1'. lra.
  - intros x hx. apply p2. lra.
  - exact (free_from_later s P whole_turns _ _ f1).
  - exact f2.
Qed.
