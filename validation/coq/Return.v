(* The impact map as a function of the plane (phase, velocity over A W): where contacts are transversal it is continuous. *)
From Coq Require Import Reals Lra List ZArith.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model Step Horseshoe.
Open Scope R_scope.

Section Scene.
Variable s : scene.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.

(* The impact after a launch: at the first time after it at which y is not inside the gap. *)
Definition contact_time (l : launch) : R := real (Glb_Rbar (fun t => since l < t /\ d s / 2 <= Rabs (free_position s l t))).
Definition land (l : launch) : impact := let t := contact_time l in
  {| wall_of := if Rle_dec 0 (free_position s l t) then right else left; time := t; velocity := free_velocity s l t |}.
Definition after (i : impact) : impact := land (rebound s i).

Lemma land_reached l i : reaches s l i -> land l = i.
Proof.
  intros ((before & on & inside) & place & speed). destruct i as [w t v]. cbn [wall_of time velocity] in *.
  assert (T : contact_time l = t).
  { unfold contact_time. rewrite (is_glb_Rbar_unique _ (Finite t)); [reflexivity|]. split.
    - intros x [later out]. apply Rnot_lt_le. intros lt. specialize (inside x (conj later lt)). lra.
    - intros b lower. apply (lower t). split; [exact before|lra]. }
  unfold land. rewrite T, place, speed. f_equal. unfold plane, side. destruct w, (Rle_dec _ _); try reflexivity; lra.
Qed.
Lemma next_after i j : next s i j -> after i = j.
Proof. apply land_reached. Qed.

(* Impacts on a wall as points of the plane. *)
Definition impact_at (w : wall) (x : state) : impact := {| wall_of := w; time := (fst x - tau s) / W s; velocity := A s * W s * snd x |}.
Definition point_of (i : impact) : state := (phase s (time i), unit_speed s (velocity i)).
Lemma impact_of_point i : impact_at (wall_of i) (point_of i) = i.
Proof. destruct i as [w t v]. unfold impact_at, point_of, phase, unit_speed. cbn. f_equal; field; lra. Qed.
Lemma point_of_impact w x : point_of (impact_at w x) = x.
Proof. destruct x as [u v]. unfold impact_at, point_of, phase, unit_speed. cbn. f_equal; field; lra. Qed.

(* The next impact's point. *)
Definition fly (w : wall) (x : state) : state := point_of (after (impact_at w x)).
(* All of a set land on one wall. *)
Definition flies (w w1 : wall) (x : state) : Prop := next s (impact_at w x) (impact_at w1 (fly w x)).
Lemma flies_to w w1 x i : reaches s (rebound s (impact_at w x)) i -> wall_of i = w1 -> flies w w1 x /\ fly w x = point_of i.
Proof.
  intros h <-. assert (e := next_after (impact_at w x) i h). assert (f : fly w x = point_of i) by (unfold fly; rewrite e; reflexivity).
  split; [|exact f]. unfold flies. rewrite f, impact_of_point. exact h.
Qed.

(* The flight in the units of Step.v. *)
Let os := companions s.
Let half := d s / A s / 2.
Definition launch_speed (x : state) : R := - e s * snd x.
Definition height (w : wall) (x : state) (th : R) : R := side w * half + rise os (fst x) (launch_speed x) th.
Lemma phase_at w x : phase s (time (impact_at w x)) = fst x.
Proof. exact (f_equal fst (point_of_impact w x)). Qed.
Lemma speed_at w x : unit_speed s (velocity (impact_at w x)) = snd x.
Proof. exact (f_equal snd (point_of_impact w x)). Qed.
Lemma launch_speed_at w x : unit_speed s (speed (rebound s (impact_at w x))) = launch_speed x.
Proof. unfold launch_speed. rewrite <- (speed_at w x). cbn. unfold unit_speed. field. lra. Qed.
Lemma launch_place_at w x : place (rebound s (impact_at w x)) / A s = side w * half.
Proof. cbn. unfold plane, half. field. lra. Qed.
Lemma landing_height w w1 x : flies w w1 x -> height w x (fst (fly w x)) = side w1 * half.
Proof.
  intros (_ & on & _). cbn [wall_of impact_at] in on. rewrite position_in_phases in on by assumption.
  rewrite launch_place_at, launch_speed_at, phase_at in on. cbn [since rebound] in on. rewrite phase_at in on. fold os in on.
  unfold height. apply (Rmult_eq_reg_l (A s)); [|lra]. rewrite on. unfold plane, half. field. lra.
Qed.
Lemma landing_rate w w1 x : flies w w1 x -> snd (fly w x) = rate os (fst x) (launch_speed x) (fst (fly w x)).
Proof.
  intros (_ & _ & v). rewrite velocity_in_phases in v by assumption. rewrite launch_speed_at, phase_at in v.
  cbn [since rebound] in v. rewrite phase_at in v. rewrite <- (speed_at w1 (fly w x)). rewrite v. unfold unit_speed. fold os. field. lra.
Qed.

Lemma box_at_continuous th : continuous (box_at os) th.
Proof. apply (ex_derive_continuous (V := R_NormedModule)). eexists. apply box_at_derivative. Qed.
Lemma box_rate_continuous th : continuous (box_rate os) th.
Proof. apply (ex_derive_continuous (V := R_NormedModule)). eexists. apply box_rate_derivative. Qed.
Section Sums.
Context {U : UniformSpace}.
Variables (S : U -> Prop) (f g : U -> R).
Hypotheses (hf : continuous_on S f) (hg : continuous_on S g).
Lemma on_plus : continuous_on S (fun x => f x + g x).
Proof. intros x hx. apply (filterlim_comp_2 f g Rplus (hf x hx) (hg x hx)). apply (filterlim_plus (V := R_NormedModule)). Qed.
Lemma on_minus : continuous_on S (fun x => f x - g x).
Proof.
  intros x hx. apply (filterlim_comp_2 f (fun x => - g x) Rplus (hf x hx)) with (2 := filterlim_plus (V := R_NormedModule) _ _).
  exact (filterlim_comp _ _ _ g Ropp _ _ _ (hg x hx) (filterlim_opp (V := R_NormedModule) _)).
Qed.
Lemma on_times : continuous_on S (fun x => f x * g x).
Proof. intros x hx. apply (filterlim_comp_2 f g Rmult (hf x hx) (hg x hx)). apply (filterlim_mult (K := R_AbsRing)). Qed.
Lemma on_const (c : R) : continuous_on S (fun _ => c).
Proof. intros x _. apply filterlim_const. Qed.
Lemma on_box_at : continuous_on S (fun x => box_at os (f x)).
Proof. apply (on_comp S (fun _ => True) f (box_at os)); auto. apply continuous_on_forall. intros x _. apply box_at_continuous. Qed.
Lemma on_box_rate : continuous_on S (fun x => box_rate os (f x)).
Proof. apply (on_comp S (fun _ => True) f (box_rate os)); auto. apply continuous_on_forall. intros x _. apply box_rate_continuous. Qed.
End Sums.
Lemma on_fst (S : state -> Prop) : continuous_on S (fun x : state => fst x).
Proof. apply continuous_on_forall. intros [u v] _. apply continuous_fst. Qed.
Lemma on_snd (S : state -> Prop) : continuous_on S (fun x : state => snd x).
Proof. apply continuous_on_forall. intros [u v] _. apply continuous_snd. Qed.
Lemma on_launch_speed S : continuous_on S launch_speed.
Proof. unfold launch_speed. apply on_times; [apply on_const|apply on_snd]. Qed.
(* Sums, products and the box's motion, taken apart by their form. *)
Ltac sums := repeat lazymatch goal with
  | |- continuous_on _ (fun x => @?a x + @?b x) => refine (on_plus _ a b _ _)
  | |- continuous_on _ (fun x => @?a x - @?b x) => refine (on_minus _ a b _ _)
  | |- continuous_on _ (fun x => @?a x * @?b x) => refine (on_times _ a b _ _)
  | |- continuous_on _ (fun x => box_at os (@?a x)) => refine (on_box_at _ a _)
  | |- continuous_on _ (fun x => box_rate os (@?a x)) => refine (on_box_rate _ a _)
  | |- continuous_on _ (fun x => launch_speed x) => exact (on_launch_speed _)
  | |- continuous_on _ (fun x => fst x) => exact (on_fst _)
  | |- continuous_on _ (fun _ => ?c) => exact (on_const _ c)
  | _ => assumption end.
Lemma on_height S w (f : state -> R) : continuous_on S f -> continuous_on S (fun x => height w x (f x)).
Proof.
  intros hf. unfold height, rise. sums.
Qed.

(* The impact map is continuous on a set of impacts on one wall that all reach the same wall within one bracket of phases in
   which all are on their way towards it. *)
Theorem fly_continuous (P : state -> Prop) (w w1 : wall) (lo hi : R) : (forall x, P x -> flies w w1 x) ->
  (forall x, P x -> lo <= fst (fly w x) <= hi) ->
  (forall x th, P x -> lo <= th <= hi -> 0 < side w1 * rate os (fst x) (launch_speed x) th) -> continuous_on P (fly w).
Proof.
  intros all bracket towards.
  set (f := fun x th => side w1 * height w x th).
  assert (side2 : side w1 * side w1 = 1) by (destruct w1; cbn; ring).
  assert (up : forall x a b, P x -> lo <= a -> a < b -> b <= hi -> f x a < f x b).
  { intros x a b hx ha ab hb. apply (increasing (f x) (fun th => side w1 * rate os (fst x) (launch_speed x) th) a b ab).
    - intros c. apply (derivable_pt_lim_scal (height w x)). replace (rate os (fst x) (launch_speed x) c) with (0 + rate os (fst x) (launch_speed x) c) by ring.
      apply (derivable_pt_lim_plus (fun _ => side w * half)); [apply derivable_pt_lim_const|apply rise_derivative].
    - intros c hc. apply towards; [exact hx|lra]. }
  assert (at_wall : forall x, P x -> f x (fst (fly w x)) = half).
  { intros x hx. unfold f. rewrite (landing_height w w1 x (all x hx)). rewrite <- Rmult_assoc, side2. ring. }
  assert (heights : forall th, continuous_on P (fun x => f x th)).
  { intros th. unfold f. refine (on_times _ _ _ _ _); [exact (on_const _ _)|exact (on_height _ _ _ (on_const _ _))]. }
  assert (phases : continuous_on P (fun x => fst (fly w x))).
  { apply on_balls. intros x hx eps. assert (eps_pos := cond_pos eps). set (T := fst (fly w x)). assert (hT := bracket x hx). fold T in hT.
    assert (here := at_wall x hx). fold T in here.
    assert (above : exists del : posreal, forall y, ball x del y -> P y -> fst (fly w y) < T + eps).
    { destruct (Rle_lt_dec (T + eps) hi) as [le|lt].
      - assert (h : f x T < f x (T + eps)) by (apply up; try exact hx; lra).
        destruct (proj1 (on_balls _ _) (heights (T + eps)) x hx (mkposreal (f x (T + eps) - half) ltac:(lra))) as [del near].
        exists del. intros y b hy. specialize (near y b hy).
        change (Rabs (f y (T + eps) - f x (T + eps)) < f x (T + eps) - half) in near. apply Rabs_def2 in near.
        apply Rnot_le_lt. intros le'. assert (hy' := bracket y hy). assert (m := at_wall y hy).
        destruct le' as [lt'|same]; [assert (h' := up y (T + eps) (fst (fly w y)) hy ltac:(lra) lt' ltac:(lra))|rewrite <- same in m]; lra.
      - exists (mkposreal 1 Rlt_0_1). intros y _ hy. assert (hy' := bracket y hy). lra. }
    assert (below : exists del : posreal, forall y, ball x del y -> P y -> T - eps < fst (fly w y)).
    { destruct (Rle_lt_dec lo (T - eps)) as [le|lt].
      - assert (h : f x (T - eps) < f x T) by (apply up; try exact hx; lra).
        destruct (proj1 (on_balls _ _) (heights (T - eps)) x hx (mkposreal (half - f x (T - eps)) ltac:(lra))) as [del near].
        exists del. intros y b hy. specialize (near y b hy).
        change (Rabs (f y (T - eps) - f x (T - eps)) < half - f x (T - eps)) in near. apply Rabs_def2 in near.
        apply Rnot_le_lt. intros le'. assert (hy' := bracket y hy). assert (m := at_wall y hy).
        destruct le' as [lt'|same]; [assert (h' := up y (fst (fly w y)) (T - eps) hy ltac:(lra) lt' ltac:(lra))|rewrite same in m]; lra.
      - exists (mkposreal 1 Rlt_0_1). intros y _ hy. assert (hy' := bracket y hy). lra. }
    destruct above as [a near_a], below as [b near_b]. exists (mkposreal _ (Rmin_stable_in_posreal a b)). intros y near hy.
    assert (fst (fly w y) < T + eps) by (apply near_a; [apply (ball_le x _ _) with (2 := near); apply Rmin_l|exact hy]).
    assert (T - eps < fst (fly w y)) by (apply near_b; [apply (ball_le x _ _) with (2 := near); apply Rmin_r|exact hy]).
    change (Rabs (fst (fly w y) - T) < eps). apply Rabs_def1; lra. }
  assert (speeds : continuous_on P (fun x => snd (fly w x))).
  { apply (continuous_on_ext P (fun x => rate os (fst x) (launch_speed x) (fst (fly w x)))).
    - intros x hx. symmetry. exact (landing_rate w w1 x (all x hx)).
    - unfold rate. sums. }
  apply (continuous_on_ext P (fun x => (fst (fly w x), snd (fly w x)))); [intros x _; symmetry; apply surjective_pairing|].
  exact (on_pair _ _ _ phases speeds).
Qed.
End Scene.
