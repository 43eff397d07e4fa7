(* Rests and releases, checked by evaluation: programs `check_rest`, `check_release` and `check_steps`, with the proofs that they are right. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Float.Sig.
From ImpactPair Require Import Model Step Motion Certificate Document Turns Orbit.
From ImpactPair Require Chatter.
Open Scope R_scope.
Import ListNotations.

(* The check of a rest: the contact force acts up to a phase, between two bounds of the ball's acceleration, the root of their ratio at most. *)
Record resting := At_rest { rest_bits : positive; rest_scale : positive; ends : Z; low : Z; high : Z; ratio : Z }.
(* The check of a release: the contact force acts up to an interval of phases in which it decreases, and vanishes in a bracket inside it. *)
Record releasing := At_release { release_bits : positive; release_scale : positive; held_from : Z; ceases : Z; ceases_by : Z; falls_by : Z }.
Inductive step := Flight (l : leg) | Rest (r : resting) | Release (r : releasing).

Module Restings (F : FloatOps with Definition sensible_format := true).
Module Import Each := Verifier F.
Import Check.

(* A ball that flies, with a phase up to which the wall that it has left without velocity pulls; or that rests, since a phase. *)
Inductive place_of := In_flight (b : box) (clear : option (positive * Z)) | On_wall (w : wall) (X : I.type).

Section Data.
Variable param : data.

(* The departure of a ball that is released. *)
Definition check_away (b : box) (q0 : positive) (n : Z) (l : leg) : bool :=
  let c := coarse l in let q := scale l in let p := bits l in
  match from b with
  | None => false
  | Some w => is_not_negative (sub p (point p (unit_step p q) (depart l)) (T b)) &?
      sweep (pressed_over c (known_in param c) q (unit_step c q) w) depth (n * 2 ^ Zpos q / 2 ^ Zpos q0) (depart l)
  end.
Definition check_flies (b : box) (clear : option (positive * Z)) (l : leg) : bool :=
  match clear with None => check_departure (known_in param (bits l)) b l | Some (q0, n) => check_away b q0 n l end.

Section At.
Variables p q : positive.
Notation pt := (point p (unit_step p q)).
Notation E := (enclose_range p (restitution param)).
Notation OS := (known_in param p).
Notation phase_of t := (phase_over param p (known_number p t)).

(* The phase by which a chatter has ended, at most. *)
Definition last_phase (b : box) (w : wall) (r : resting) : I.type :=
  add p (T b) (quotient p (mul p (whole p 2) (I.neg (sided w (U b)))) (mul p (pt (low r)) (sub p (whole p 1) (mul p E (pt (ratio r)))))).
Definition check_rest (b : box) (w : wall) (lower upper : Q) (bounces : bool) (r : resting) : bool :=
  let press := sided w (box_bend_over p OS (turns q (ends r)) (hull (T b) (pt (ends r)))) in
  let V := I.neg (sided w (U b)) in let e := E in let low := pt (low r) in let high := pt (high r) in let ratio := pt (ratio r) in
  match from b with None => false | Some w0 => same_wall w0 w end &?
  is_not_negative (sub p (T b) (phase_of lower)) &?
  if bounces then
    let last := last_phase b w r in
    is_positive low &? is_not_negative (sub p press low) &? is_not_negative (sub p high press) &? is_not_negative ratio &?
    is_not_negative (sub p (mul p (mul p ratio ratio) low) high) &? is_positive e &? is_positive (sub p (whole p 1) (mul p e ratio)) &?
    is_positive V &? is_positive (sub p (pt (ends r)) last) &? is_positive (sub p (mul p (mul p (whole p 2) low) (gamma_in param p)) (mul p V V)) &?
    is_not_negative (sub p (phase_of upper) last)
  else
    is_not_negative (U b) &? is_not_negative (I.neg (U b)) &? is_positive (sub p (pt (ends r)) (T b)) &? is_positive press &?
    is_not_negative (sub p (phase_of upper) (T b)).
Definition rest_phase (b : box) (w : wall) (bounces : bool) (r : resting) : I.type := if bounces then hull (T b) (last_phase b w r) else T b.

(* All harmonics are at whole half periods: the box has no acceleration. *)
Definition check_still (t : Q) : bool :=
  forallb (fun x => same (least (frequency x)) (most (frequency x)) && same (least (shift x)) (most (shift x)) &&
    half_turns (Plus (Times (least (frequency x)) (Rational t)) (least (shift x)))) (leading param :: further param).
Definition check_release (w : wall) (X : I.type) (lower upper : Q) (r : releasing) : bool :=
  let lo := (ceases r - ceases_by r)%Z in let hi := (ceases r + ceases_by r)%Z in let m := turns q (ceases r) in
  let near := (ceases r - falls_by r)%Z in let far := (ceases r + falls_by r)%Z in
  (0 <=? ceases_by r)%Z &? (ceases_by r <=? falls_by r)%Z &? is_not_negative (sub p X (pt (held_from r))) &? is_positive (sub p (pt lo) X) &?
  sweep (pressed_over p OS q (unit_step p q) (opposite w)) depth (held_from r) near &?
  is_positive (I.neg (sided w (box_jerk_over p OS m (stretch p (unit_step p q) near far)))) &?
  is_positive (sided w (box_bend_over p OS m (pt lo))) &? is_positive (I.neg (sided w (box_bend_over p OS m (pt hi)))) &?
  (if bounded p (phase_of lower) (stretch p (unit_step p q) lo hi) (phase_of upper) then true
   else Qle_bool lower upper && check_still lower && between p (unit_step p q) (phase_of lower) lo hi).
Definition away (w : wall) (r : releasing) : place_of :=
  In_flight (landing p E w q (ceases r) (ceases_by r) 0 0) (Some (q, ceases r + falls_by r)%Z).
End At.

Fixpoint check_steps (a : place_of) (steps : list step) (listed : list occurrence) : bool :=
  match steps, listed with
  | [], [] => true
  | x :: steps, o :: listed =>
    match a, x, o with
    | In_flight b clear, Flight l, Impact_at y => check_flies b clear l &? check_course param b l &? check_arrival param b l (shown y) &?
        check_steps (In_flight (landed param l) None) steps listed
    | In_flight b _, Rest r, Rest_at w lower upper bounces => check_rest (rest_bits r) (rest_scale r) b w lower upper bounces r &?
        check_steps (On_wall w (rest_phase (rest_bits r) (rest_scale r) b w bounces r)) steps listed
    | On_wall w X, Release r, Release_at w' lower upper => same_wall w w' &? check_release (release_bits r) (release_scale r) w X lower upper r &?
        check_steps (away (release_bits r) (release_scale r) w r) steps listed
    | _, _, _ => false
    end
  | _, _ => false
  end.

Variable s : scene.
Hypothesis described : describes param s.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.
Let os := companions s.

Definition clears (b : box) (clear : option (positive * Z)) (l : launch) : Prop :=
  match clear with
  | None => True
  | Some (q0, n) => speed l = 0 /\ forall w, from b = Some w -> forall th, phase s (since l) < th <= grid q0 n -> 0 < - side w * box_bend os th
  end.
Definition stands (a : place_of) (x : standing) : Prop :=
  match a, x with
  | In_flight b clear, Flying l => launched s b l /\ clears b clear l
  | On_wall w X, Resting w' t => w' = w /\ holds X (phase s t)
  | _, _ => False
  end.

Lemma unit_of_zero v : v = 0 -> unit_speed s v = 0.
Proof. intros ->. unfold unit_speed. field. lra. Qed.
Lemma zero_of_unit v : unit_speed s v = 0 -> v = 0.
Proof. unfold unit_speed. intros h. assert (v = v / (A s * W s) * (A s * W s)) by (field; lra). rewrite h in H. lra. Qed.
Lemma finer q q0 n : grid q (n * 2 ^ Zpos q / 2 ^ Zpos q0) <= grid q0 n.
Proof.
  assert (h := Z.mul_div_le (n * 2 ^ Zpos q) (2 ^ Zpos q0) ltac:(apply Z.pow_pos_nonneg; lia)). apply IZR_le in h. rewrite !mult_IZR in h.
  assert (0 < IZR (2 ^ Zpos q)) by (apply IZR_lt, Z.pow_pos_nonneg; lia). assert (0 < IZR (2 ^ Zpos q0)) by (apply IZR_lt, Z.pow_pos_nonneg; lia).
  unfold grid. apply (Rmult_le_reg_l (IZR (2 ^ Zpos q0))); [assumption|]. apply (Rmult_le_reg_l (IZR (2 ^ Zpos q))); [assumption|].
  replace (IZR (2 ^ Zpos q) * (IZR (2 ^ Zpos q0) * (/ IZR (2 ^ Zpos q) * IZR (n * 2 ^ Zpos q / 2 ^ Zpos q0)))) with
    (IZR (2 ^ Zpos q0) * IZR (n * 2 ^ Zpos q / 2 ^ Zpos q0)) by (field; lra).
  replace (IZR (2 ^ Zpos q) * (IZR (2 ^ Zpos q0) * (/ IZR (2 ^ Zpos q0) * IZR n))) with (IZR n * IZR (2 ^ Zpos q)) by (field; lra). exact h.
Qed.
Lemma flies_sound b clear l leg : launched s b l -> clears b clear l -> check_flies b clear leg = true ->
  departs s leg (place l / A s) (phase s (since l)) (unit_speed s (speed l)).
Proof.
  intros inb clear_of check. destruct clear as [[q0 n]|]; cbn [check_flies] in check; [|exact (leg_departs param s described b leg l inb check)].
  destruct inb as (thc & uc & inb). pose proof inb as (hf & h0 & _). unfold check_away in check. cbv zeta in check.
  destruct (from b) as [w|] eqn:f; [|discriminate]. split_checks. destruct clear_of as (still & away). specialize (away w f).
  assert (hos := holds_known param s described (coarse leg)). assert (sp := unit_step_holds (bits leg) (scale leg)). assert (sc := unit_step_holds (coarse leg) (scale leg)).
  assert (a1 : 0 <= grid (scale leg) (depart leg) - phase s (since l)) by (apply (is_not_negative_sound _ _ k); enclose).
  exists (grid (scale leg) (depart leg)). split; [right; exists w; split; [exact hf|]|lra].
  right. rewrite (unit_of_zero _ still). split; [lra|]. intros th r. destruct (Rle_lt_dec th (grid q0 n)) as [before|later]; [apply away; lra|].
  refine (sweep_sound (scale leg) _ (fun x => 0 < - side w * box_bend os x) _ _ _ _ check th _).
  - intros i j h x rx. exact (pressed_sound _ _ _ hos (scale leg) _ sc _ _ _ h x rx).
  - assert (fine := finer (scale leg) q0 n). lra.
Qed.

Section At.
Variables p q : positive.
Notation pt := (point p (unit_step p q)).
Notation E := (enclose_range p (restitution param)).
Notation OS := (known_in param p).

Lemma phase_holds t : holds (phase_over param p (known_number p t)) (phase s (Q2R t)).
Proof. apply (holds_phase_over param s described). exact (holds_number p t). Qed.
Lemma pt_holds n : holds (pt n) (grid q n).
Proof. apply holds_point, unit_step_holds. Qed.
(* A phase as a time. *)
Definition time_of (th : R) : R := (th - tau s) / W s.
Lemma phase_time_of th : phase s (time_of th) = th.
Proof. unfold phase, time_of. field. lra. Qed.
Lemma press_sound w X x : holds X x -> forall m, holds (sided w (box_bend_over p OS m X)) (side w * box_bend os x).
Proof. intros h m. apply holds_sided. exact (holds_box_bend p _ _ (holds_known param s described p) m X x h). Qed.
Lemma phase_le a b : phase s a <= phase s b -> a <= b.
Proof. unfold phase. intros h. apply (Rmult_le_reg_l (W s)); lra. Qed.

Lemma rest_sound b l w lower upper bounces r : launched s b l -> check_rest p q b w lower upper bounces r = true ->
  exists t, happens s (Flying l) (Rests w t bounces) /\ in_time lower upper t /\ holds (rest_phase p q b w bounces r) (phase s t).
Proof.
  intros (thc & uc & inb) check. unfold check_rest in check. cbv zeta in check.
  pose proof inb as (hf & hT & _ & _ & _ & hU & _). set (th0 := phase s (since l)) in *. set (u := unit_speed s (speed l)) in *.
  destruct (from b) as [w0|] eqn:f; [|discriminate]. destruct (same_wall w0 w) eqn:same_w; [|discriminate]. apply same_wall_sound in same_w. subst w0.
  assert (on_wall : place l = plane s w).
  { unfold plane. replace (place l) with (A s * (place l / A s)) by (field; lra). rewrite hf. field. lra. }
  assert (hends := pt_holds (ends r)). assert (hlow := pt_holds (low r)). assert (hhigh := pt_holds (high r)). assert (hratio := pt_holds (ratio r)).
  assert (hE : holds E (e s)) by (apply holds_range, described).
  assert (hl := phase_holds lower). assert (hu := phase_holds upper).
  assert (hV : holds (I.neg (sided w (U b))) (- (side w * u))) by (apply holds_neg, holds_sided, hU).
  split_checks. assert (begins_after : 0 <= th0 - phase s (Q2R lower)) by (apply (is_not_negative_sound _ _ k); enclose).
  assert (window : forall t, since l <= t -> phase s t <= grid q (ends r) ->
    holds (sided w (box_bend_over p OS (turns q (ends r)) (hull (T b) (pt (ends r))))) (side w * box_bend os (phase s t))).
  { intros t h1 h2. apply press_sound. apply (holds_hull _ _ th0 (grid q (ends r))); [exact hT|exact hends|].
    split; [|exact h2]. unfold th0, phase. apply Rplus_le_compat_r, Rmult_le_compat_l; lra. }
  assert (AW2 : 0 < A s * W s ^ 2) by (apply Rmult_lt_0_compat; [lra|apply pow_lt; lra]).
  destruct bounces.
  - split_checks. set (g := gamma_in param p) in *. assert (hg : holds g (d s / A s)) by apply (holds_gamma param s described p).
    set (lo := grid q (low r)) in *. set (hi := grid q (high r)) in *. set (rho := grid q (ratio r)) in *. set (fin := grid q (ends r)) in *.
    set (V := - (side w * u)) in *.
    assert (lo0 : 0 < lo) by exact (is_positive_sound _ _ k0 hlow).
    assert (rho0 : 0 <= rho) by exact (is_not_negative_sound _ _ k3 hratio).
    assert (root : 0 <= rho * rho * lo - hi) by (apply (is_not_negative_sound _ _ k4); enclose).
    assert (e0 : 0 < e s) by exact (is_positive_sound _ _ k5 hE).
    assert (D0 : 0 < 1 - e s * rho) by (apply (is_positive_sound _ _ k6); enclose).
    assert (V0 : 0 < V) by exact (is_positive_sound _ _ k7 hV).
    assert (hlast : holds (last_phase p q b w r) (th0 + 2 * V / (lo * (1 - e s * rho)))) by (unfold last_phase, V, lo, rho; enclose).
    assert (room : 0 < fin - (th0 + 2 * V / (lo * (1 - e s * rho)))) by (apply (is_positive_sound _ _ k8); enclose).
    assert (flat : 0 < 2 * lo * (d s / A s) - V * V) by (apply (is_positive_sound _ _ k9); enclose).
    assert (shown_so : 0 <= phase s (Q2R upper) - (th0 + 2 * V / (lo * (1 - e s * rho)))) by (apply (is_not_negative_sound _ _ check); enclose).
    set (i := {| wall_of := w; time := since l; velocity := - speed l / e s |}).
    assert (left_so : rebound s i = l).
    { destruct l as [t0 y0 v0]. unfold rebound, i. cbn [wall_of time velocity since place speed] in *. rewrite on_wall. f_equal. field. lra. }
    set (LO := A s * W s ^ 2 * lo). set (HI := A s * W s ^ 2 * hi).
    assert (window' : forall t, since l <= t <= time_of fin -> LO <= side w * box_push s t <= HI).
    { intros t h. assert (in_window : phase s t <= fin).
      { rewrite <- (phase_time_of fin). unfold phase. apply Rplus_le_compat_r, Rmult_le_compat_l; lra. }
      assert (hp := window t (proj1 h) in_window).
      assert (0 <= side w * box_bend os (phase s t) - lo) by (apply (is_not_negative_sound _ _ k1); enclose).
      assert (0 <= hi - side w * box_bend os (phase s t)) by (apply (is_not_negative_sound _ _ k2); enclose).
      rewrite (push_in_units s A_positive W_positive t). fold os. unfold LO, HI.
      replace (side w * (A s * W s ^ 2 * box_bend os (phase s t))) with (A s * W s ^ 2 * (side w * box_bend os (phase s t))) by ring.
      split; apply Rmult_le_compat_l; lra. }
    assert (LO0 : 0 < LO) by (apply Rmult_lt_0_compat; assumption).
    assert (quotients : HI / LO = hi / lo) by (unfold HI, LO; field; repeat split; lra).
    assert (root' : sqrt (HI / LO) <= rho).
    { rewrite quotients. rewrite <- (sqrt_square rho) by exact rho0. apply sqrt_le_1_alt. apply (Rmult_le_reg_r lo); [exact lo0|].
      replace (hi / lo * lo) with hi by (field; lra). lra. }
    assert (speed_of : Chatter.rebound_speed s w i = A s * W s * V).
    { unfold Chatter.rebound_speed, i, V, u, unit_speed. cbn [velocity]. field. repeat split; lra. }
    assert (shrinks : e s * sqrt (HI / LO) <= e s * rho) by (apply Rmult_le_compat_l; lra).
    set (R := e s * sqrt (HI / LO)) in *.
    assert (ratio0 : 0 <= R) by (apply Rmult_le_pos; [lra|apply sqrt_pos]).
    assert (left_time : Chatter.remaining s w LO HI i <= 2 * V / (lo * (1 - e s * rho)) / W s).
    { unfold Chatter.remaining. fold R. rewrite speed_of. unfold LO.
      replace (2 * (A s * W s * V) / (A s * W s ^ 2 * lo * (1 - R))) with (2 * V / lo / W s * / (1 - R)) by (field; repeat split; lra).
      replace (2 * V / (lo * (1 - e s * rho)) / W s) with (2 * V / lo / W s * / (1 - e s * rho)) by (field; repeat split; lra).
      apply Rmult_le_compat_l; [|apply Rinv_le_contravar; lra].
      apply Rmult_le_pos; [|left; apply Rinv_0_lt_compat; lra]. apply Rmult_le_pos; [lra|left; apply Rinv_0_lt_compat; lra]. }
    assert (last_time : since l + 2 * V / (lo * (1 - e s * rho)) / W s = time_of (th0 + 2 * V / (lo * (1 - e s * rho)))).
    { unfold time_of, th0, phase. field. repeat split; try lra. }
    assert (before_fin : time_of (th0 + 2 * V / (lo * (1 - e s * rho))) < time_of fin).
    { unfold time_of. apply Rmult_lt_compat_r; [apply Rinv_0_lt_compat; lra|lra]. }
    destruct (Chatter.chatter_accumulates s w (since l) (time_of fin) LO HI gap_positive e0 window' LO0 ltac:(fold R; lra) i) as (limit & [l1 l2] & acc & press).
    + unfold Chatter.chatters. cbn [wall_of i time]. fold i. rewrite speed_of. split; [reflexivity|]. split; [|split; [lra|split; [lra|]]].
      * apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat|]; lra.
      * unfold LO. apply (Rmult_lt_reg_r (2 * lo)); [lra|].
        replace ((A s * W s * V) ^ 2 / (2 * (A s * W s ^ 2 * lo)) * (2 * lo)) with (A s * (V * V)) by (field; repeat split; lra).
        replace (d s * (2 * lo)) with (A s * (2 * lo * (d s / A s))) by (field; lra). apply Rmult_lt_compat_l; lra.
    + cbn [time i]. lra.
    + cbn [time i] in l1, l2. rewrite left_so in acc. exists limit. split; [split; assumption|].
      assert (upper_time : limit <= time_of (th0 + 2 * V / (lo * (1 - e s * rho)))) by lra.
      assert (upper_phase : phase s limit <= th0 + 2 * V / (lo * (1 - e s * rho))).
      { rewrite <- (phase_time_of (th0 + 2 * V / (lo * (1 - e s * rho)))). unfold phase. apply Rplus_le_compat_r, Rmult_le_compat_l; lra. }
      assert (lower_phase : th0 <= phase s limit) by (unfold th0, phase; apply Rplus_le_compat_r, Rmult_le_compat_l; lra).
      split; [split; apply phase_le; lra|]. cbn [rest_phase]. apply (holds_hull _ _ _ _ _ hT hlast). lra.
  - split_checks. assert (u_up : 0 <= u) by exact (is_not_negative_sound _ _ k0 hU).
    assert (u_down : 0 <= - u) by (apply (is_not_negative_sound _ _ k1); enclose).
    assert (room : 0 < grid q (ends r) - th0) by (apply (is_positive_sound _ _ k2); enclose).
    assert (shown_so : 0 <= phase s (Q2R upper) - th0) by (apply (is_not_negative_sound _ _ check); enclose).
    exists (since l). cbn [happens rest_phase]. split; [|split; [split; apply phase_le; fold th0; lra|exact hT]].
    split; [exact on_wall|]. split; [apply zero_of_unit; fold u; lra|]. split; [reflexivity|].
    exists (time_of (grid q (ends r))). split.
    { assert (eq : since l = time_of th0) by (unfold time_of, th0, phase; field; lra). rewrite eq.
      unfold time_of. apply Rmult_lt_compat_r; [apply Rinv_0_lt_compat; lra|lra]. }
    intros t h. assert (in_window : phase s t <= grid q (ends r)).
    { rewrite <- (phase_time_of (grid q (ends r))). unfold phase. apply Rplus_le_compat_r, Rmult_le_compat_l; lra. }
    assert (0 < side w * box_bend os (phase s t)) by (apply (is_positive_sound _ _ k3), window; [lra|exact in_window]).
    rewrite (push_in_units s A_positive W_positive t). fold os.
    replace (side w * (A s * W s ^ 2 * box_bend os (phase s t))) with (A s * W s ^ 2 * (side w * box_bend os (phase s t))) by ring.
    apply Rmult_lt_0_compat; lra.
Qed.

Lemma still_sound t : check_still t = true -> box_push s (Q2R t) = 0.
Proof.
  unfold check_still. rewrite forallb_forall. intros check. destruct described as (lead & rest & _).
  assert (each : forall x, In x (leading param :: further param) -> forall h, describes_harmonic x h -> push h (Q2R t) = 0).
  { intros x i h (_ & w & v). specialize (check x i). apply andb_prop in check as [check half]. apply andb_prop in check as [one one'].
    apply same_sound in one, one'. destruct (half_turns_sound _ half) as [k eq]. cbn [value] in eq.
    unfold among in w, v. rewrite <- one in w. rewrite <- one' in v. unfold push, phase.
    replace (W h * Q2R t + tau h) with (IZR k * PI) by (rewrite <- eq; replace (W h) with (value (least (frequency x))) by lra; lra).
    rewrite (sin_eq_0_1 (IZR k * PI)) by (exists k; reflexivity). ring. }
  unfold box_push. rewrite (each (leading param) (or_introl eq_refl) s lead).
  assert (more : forall x, In x (further param) -> forall h, describes_harmonic x h -> push h (Q2R t) = 0) by (intros x i; apply each; right; exact i).
  clear - rest more. unfold sum. induction rest as [|x h xs hs k rest IH]; cbn [fold_right]; [reflexivity|].
  rewrite IH by (intros y i; apply more; right; exact i). rewrite (more x (or_introl eq_refl) h k). ring.
Qed.

Lemma time_of_phase t : time_of (phase s t) = t.
Proof. unfold time_of, phase. field. lra. Qed.
Lemma phase_lt a b : a < b -> phase s a < phase s b.
Proof. apply (proj1 (phase_increasing s W_positive a b)). Qed.
Lemma lt_phase a b : phase s a < phase s b -> a < b.
Proof. apply (proj2 (phase_increasing s W_positive a b)). Qed.

Lemma release_sound w X t lower upper r : holds X (phase s t) -> check_release p q w X lower upper r = true ->
  exists t', happens s (Resting w t) (Leaves w t') /\ in_time lower upper t' /\ stands (away p q w r) (Flying (released s w t')).
Proof.
  intros hX check. unfold check_release in check. cbv zeta in check.
  set (lo := (ceases r - ceases_by r)%Z) in *. set (hi := (ceases r + ceases_by r)%Z) in *. set (th := phase s t) in *.
  set (near := (ceases r - falls_by r)%Z) in *. set (far := (ceases r + falls_by r)%Z) in *. split_checks.
  assert (by0 : (0 <= ceases_by r)%Z) by (apply Z.leb_le; assumption). assert (by1 : (ceases_by r <= falls_by r)%Z) by (apply Z.leb_le; assumption).
  assert (hfrom := pt_holds (held_from r)). assert (hlo := pt_holds lo). assert (hhi := pt_holds hi).
  assert (after_from : 0 <= th - grid q (held_from r)) by (apply (is_not_negative_sound _ _ k1); enclose).
  assert (before_lo : 0 < grid q lo - th) by (apply (is_positive_sound _ _ k2); enclose).
  assert (order : grid q lo <= grid q hi) by (apply grid_le; unfold lo, hi; lia).
  assert (order' : grid q near <= grid q lo) by (apply grid_le; unfold lo, near; lia).
  assert (order'' : grid q hi <= grid q far) by (apply grid_le; unfold hi, far; lia).
  set (f := fun x => side w * box_bend os x).
  assert (st := unit_step_holds p q).
  assert (side_of : - side (opposite w) = side w) by (rewrite side_opposite; ring).
  assert (held : forall x, grid q (held_from r) <= x <= grid q near -> 0 < f x).
  { intros x rx. unfold f. rewrite <- side_of. refine (sweep_sound q _ (fun x => 0 < - side (opposite w) * box_bend os x) _ _ _ _ k3 x rx).
    intros i j h y ry. exact (pressed_sound _ _ _ (holds_known param s described p) q _ st _ _ _ h y ry). }
  assert (falling : forall x, grid q near <= x <= grid q far -> 0 < - (side w * box_jerk os x)).
  { intros x rx. apply (is_positive_sound _ _ k4). apply holds_neg, holds_sided.
    apply (holds_box_jerk p _ _ (holds_known param s described p)). apply (holds_stretch p q _ st). exact rx. }
  assert (gone : 0 < - f (grid q hi)).
  { apply (is_positive_sound _ _ k6). unfold f. apply holds_neg. apply press_sound. exact hhi. }
  assert (D : forall x, derivable_pt_lim f x (side w * box_jerk os x)).
  { intros x. apply (derivable_pt_lim_scal (box_bend os)). apply is_derive_Reals, box_bend_derivative. }
  assert (down : forall x y, grid q near <= x -> x < y -> y <= grid q far -> f y < f x).
  { intros x y h1 h2 h3. assert (g := increasing (fun x => - f x) (fun x => - (side w * box_jerk os x)) x y h2).
    assert (- f x < - f y); [|lra]. apply g; [intros c; apply (derivable_pt_lim_opp f), D|intros c hc; apply falling; lra]. }
  assert (at_lo : 0 < f (grid q lo)) by (apply (is_positive_sound _ _ k5); unfold f; apply press_sound; exact hlo).
  destruct (IVT_gen f (grid q lo) (grid q hi) 0) as (z & b & zero).
  { intros c. apply derivable_continuous_pt. eexists. apply D. }
  { rewrite Rmin_right, Rmax_left by lra. lra. }
  rewrite Rmin_left, Rmax_right in b by lra.
  assert (z_hi : z < grid q hi) by (destruct (Req_dec z (grid q hi)) as [eq|]; [rewrite eq in zero|]; lra).
  assert (AW2 : 0 < A s * W s ^ 2) by (apply Rmult_lt_0_compat; [lra|apply pow_lt; lra]).
  assert (pushed : forall x, side w * box_push s x = A s * W s ^ 2 * f (phase s x)).
  { intros x. rewrite (push_in_units s A_positive W_positive x). unfold f, os. ring. }
  exists (time_of z). split; [|split].
  - split; [reflexivity|]. split; [apply lt_phase; rewrite phase_time_of; fold th; lra|]. split.
    + intros x [h1 h2]. apply phase_lt in h1, h2. rewrite phase_time_of in h2. fold th in h1. rewrite pushed. apply Rmult_lt_0_compat; [exact AW2|].
      destruct (Rle_lt_dec (phase s x) (grid q near)) as [c|c]; [apply held; lra|]. rewrite <- zero. apply down; lra.
    + exists (time_of (grid q hi)). split; [apply lt_phase; rewrite !phase_time_of; exact z_hi|].
      intros x [h1 h2]. apply phase_lt in h1, h2. rewrite phase_time_of in h1, h2. rewrite pushed.
      assert (f (phase s x) < 0) by (rewrite <- zero; apply down; lra). nra.
  - assert (l := phase_holds lower). assert (u := phase_holds upper).
    destruct (bounded p _ _ _) eqn:shown_so in check.
    + assert (r1 := bounded_sound _ _ _ _ _ _ _ shown_so l (holds_stretch p q _ st _ _ z b) u).
      split; apply phase_le; rewrite phase_time_of; lra.
    + apply andb_prop in check as [check inside]. apply andb_prop in check as [ordered still].
      apply Qle_bool_imp_le, Qle_Rle in ordered. assert (r1 := between_sound _ _ _ _ _ _ inside l).
      assert (none := still_sound lower still). assert (zero' := pushed (Q2R lower)). rewrite none, Rmult_0_r in zero'.
      assert (f0 : f (phase s (Q2R lower)) = 0) by (apply (Rmult_eq_reg_l (A s * W s ^ 2)); lra).
      assert (same_z : z = phase s (Q2R lower)).
      { destruct (Rtotal_order z (phase s (Q2R lower))) as [c|[c|c]]; [|exact c|].
        - assert (g := down z (phase s (Q2R lower)) ltac:(lra) c ltac:(lra)). lra.
        - assert (g := down (phase s (Q2R lower)) z ltac:(lra) c ltac:(lra)). lra. }
      rewrite same_z, time_of_phase. split; lra.
  - unfold away. cbn [stands]. split.
    + exists (grid q (ceases r)), (- e s * grid q 0). cbn [released place since speed]. rewrite phase_time_of.
      replace (plane s w / A s) with (side w * (d s / A s / 2)) by (unfold plane; field; lra).
      replace (unit_speed s 0) with (- e s * 0) by (rewrite (unit_of_zero 0 eq_refl); ring).
      assert (g0 : grid q 0 = 0) by (unfold grid; ring).
      apply landing_in; [exact by0|lia|apply holds_range, described|exact b|change (0 - 0)%Z with 0%Z; change (0 + 0)%Z with 0%Z; rewrite g0; lra].
    + split; [reflexivity|]. intros w' eq. injection eq as <-. intros x [h1 h2]. cbn [released since] in h1. rewrite phase_time_of in h1. fold far in h2.
      assert (f x < f z) by (apply down; lra).
      replace (- side w * box_bend os x) with (- f x) by (unfold f; ring). lra.
Qed.
End At.

Lemma steps_sound steps : forall a listed x, stands a x -> check_steps a steps listed = true ->
  exists motion, goes s x motion /\ Forall2 shows listed motion.
Proof.
  induction steps as [|step steps IH]; intros a [|o listed] x here check; cbn [check_steps] in check; try discriminate.
  - exists []. split; [exact I|constructor].
  - destruct a as [b clear|w X], x as [l|w' t0]; try destruct here; try (destruct step; discriminate);
      destruct step as [leg|r|r]; try discriminate; destruct o as [y|w1 lower upper bounces|w1 lower upper]; try discriminate.
    + split_checks. destruct (landed_sound param s described A_positive W_positive b leg (shown y) l H (flies_sound b clear l leg H H0 k) k0 k1)
        as (i & reach & inside & _ & _ & _ & next_in).
      destruct (IH (In_flight (landed param leg) None) listed (Flying (rebound s i)) (conj next_in I) check) as (motion & g & all).
      exists (Hits i :: motion). split; [split; [exact reach|exact g]|constructor; [exact inside|exact all]].
    + split_checks. destruct (rest_sound (rest_bits r) (rest_scale r) b l w1 lower upper bounces r H k) as (t1 & happened & inside & phase_in).
      destruct (IH (On_wall w1 _) listed (Resting w1 t1) (conj eq_refl phase_in) check) as (motion & g & all).
      exists (Rests w1 t1 bounces :: motion). split; [split; [exact happened|exact g]|]. constructor; [|exact all].
      split; [reflexivity|]. split; [reflexivity|exact inside].
    + split_checks. apply same_wall_sound in k. subst w1. subst w'.
      destruct (release_sound (release_bits r) (release_scale r) w X t0 lower upper r H0 k0) as (t1 & happened & inside & away_in).
      destruct (IH _ listed (Flying (released s w t1)) away_in check) as (motion & g & all).
      exists (Leaves w t1 :: motion). split; [split; [exact happened|exact g]|]. constructor; [|exact all]. split; [reflexivity|exact inside].
Qed.
End Data.
End Restings.
