(* Periodic orbits of one harmonic: the claims of a document about one (`is_cycle`), and about a motion that it attracts (`is_drawn`). With lemmas
   on the states of a round of flights, and on mirror images. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model Step Horseshoe Return Covering Certificate Document Jacobian Motion Orbit.
Open Scope R_scope.
Import ListNotations.

(* An impact of a periodic orbit: its wall, bounds of phase, the lower one from 0 to 2 pi, and velocity; and, if given, its forcing period, counted from
   that of the first impact. The phase of the impact is its bounds' plus 2 pi for each forcing period: where the bounds straddle 2 pi, the forcing
   period is that of the lower bound. *)
Record spot := Spot { spot_wall : wall; spot_phase : Q * Q; spot_velocity : Q * Q; spot_period : option Z }.
(* Real and imaginary part of an eigenvalue. *)
Definition complex_bounds : Set := ((Q * Q) * (Q * Q))%type.
Record cycle := Cycle { word : list mapping; cycles : Z; spots : list spot; is_symmetric : bool; trace_bounds : Q * Q; determinant_bounds : Q * Q;
  first_eigenvalue : complex_bounds; second_eigenvalue : complex_bounds; is_stable : bool }.

(* The mappings along walls, in time order. *)
Fixpoint mappings (w : wall) (walls : list wall) : list mapping :=
  match walls with [] => [] | w1 :: walls => mapping_between w w1 :: mappings w1 walls end.

Section Scene.
Variable s : scene.

Definition periods_later (k : Z) (i : impact) : impact := later (IZR k * period s) i.
Definition shows_spot (first : Z) (b : spot) (i : impact) : Prop := wall_of i = spot_wall b /\ in_bounds (spot_velocity b) (velocity i) /\
  (0 <= Q2R (fst (spot_phase b)) < 2 * PI /\ Q2R (snd (spot_phase b)) - Q2R (fst (spot_phase b)) < 2 * PI) /\ exists k, in_bounds (spot_phase b) (phase s (time i) - IZR k * (2 * PI)) /\ match spot_period b with None => True | Some n => k = (first + n)%Z end.
(* The first impact, from whose forcing period the others' are counted. *)
Definition as_first (b : spot) : spot := Spot (spot_wall b) (spot_phase b) (spot_velocity b) (Some 0%Z).
(* The same on the other wall, an odd number of half periods later. *)
Definition mirrored (k : Z) (i : impact) : impact :=
  {| wall_of := opposite (wall_of i); time := time i + IZR (2 * k + 1) * (period s / 2); velocity := - velocity i |}.

(* From a launch an orbit leads to impact j along the walls. *)
Definition leads (l : launch) (walls : list wall) (orbit : list impact) (j : impact) : Prop :=
  follows s l orbit /\ map wall_of orbit = walls /\ last orbit j = j.
Definition inside_circle (x y : R) : Prop := x ^ 2 + y ^ 2 < 1.
Definition outside_circle (x y : R) : Prop := 1 < x ^ 2 + y ^ 2.
(* x1 + i y1 and x2 + i y2 are the eigenvalues of a matrix: their sum is its trace, their product its determinant. *)
Definition are_eigenvalues (M : matrix R) (x1 y1 x2 y2 : R) : Prop :=
  x1 + x2 = trace M /\ y1 + y2 = 0 /\ x1 * x2 - y1 * y2 = det M /\ x1 * y2 + x2 * y1 = 0.
Definition in_complex (b : complex_bounds) (x y : R) : Prop := in_bounds (fst b) x /\ in_bounds (snd b) y.

(* Impact i and those of the orbit, the first contacts one after another, again and again, each time `cycles` forcing periods later: within the bounds of
   the document; no shorter orbit several times; the only such orbit whose first impact is; its own mirror image or not; and the product of the matrices (A.7) at its impacts. *)
Definition is_cycle (c : cycle) (i : impact) (orbit : list impact) : Prop :=
  let walls := map wall_of orbit in let P := IZR (cycles c) * period s in let M := monodromy s (wall_of i) walls (point_of s i) in
  (0 < cycles c)%Z /\ orbit <> [] /\ last walls (wall_of i) = wall_of i /\ word c = rev (mappings (wall_of i) walls) /\
  (forall n, let shift := IZR n * P in leads (rebound s (later shift i)) walls (map (later shift) orbit) (later (shift + P) i)) /\
  (exists first, Forall2 (shows_spot first) (spots c) (firstn (length orbit) (i :: orbit)) /\
    forall b, hd_error (spots c) = Some b -> shows_spot first (as_first b) i) /\
  (forall n k, (0 < n < length orbit)%nat -> nth n (i :: orbit) i <> periods_later k i) /\
  (forall z again b first, hd_error (spots c) = Some b -> shows_spot first b z -> leads (rebound s z) walls again (later P z) -> exists k, z = periods_later k i) /\
  (is_symmetric c = true <-> exists n k, (n < length orbit)%nat /\ nth n (i :: orbit) i = mirrored k i) /\
  in_bounds (trace_bounds c) (trace M) /\ in_bounds (determinant_bounds c) (det M) /\
  exists x1 y1 x2 y2, are_eigenvalues M x1 y1 x2 y2 /\ in_complex (first_eigenvalue c) x1 y1 /\ in_complex (second_eigenvalue c) x2 y2 /\
    if is_stable c then inside_circle x1 y1 /\ inside_circle x2 y2 else outside_circle x1 y1 \/ outside_circle x2 y2.

(* Of the listed impacts number `from`, j, is on the wall of impact i, and from there on the motion repeats the walls of the orbit for ever; the first impacts of
   its rounds tend to impact i, whole periods taken off. *)
Definition is_drawn (listed : list occurrence) (motion : list happening) (from : Z) (c : cycle) (i : impact) (orbit : list impact) : Prop :=
  exists before j, (exists rest, motion = before ++ Hits j :: rest) /\ impacts (firstn (S (length before)) listed) = from /\ wall_of j = wall_of i /\
    exists rounds first (y : nat -> impact) turn, (0 < rounds)%nat /\ leads (rebound s j) (concat (repeat (map wall_of orbit) rounds)) first (y O) /\
      (forall n, exists again, leads (rebound s (y n)) (map wall_of orbit) again (y (S n))) /\
      is_lim_seq (fun n => time (y n) - IZR (turn + Z.of_nat n * cycles c) * period s) (time i) /\
      is_lim_seq (fun n => velocity (y n)) (velocity i).
End Scene.

Definition one_harmonic (s : scene) : Prop := others s = [].
(* No impact of the other orbit is the first one of this, up to periods. *)
Definition others_than (s : scene) (a b : impact * list impact) : Prop :=
  forall n k, (n < length (snd b))%nat -> nth n (fst b :: snd b) (fst b) <> periods_later s k (fst a).
Definition claims_cycles (p : data) (b : beginning) (orbits : list cycle) : Prop := all_proper p b /\
  forall s, describes p s -> sensible s /\ one_harmonic s /\
    exists found, Forall2 (fun c o => is_cycle s c (fst o) (snd o)) orbits found /\ ForallOrdPairs (others_than s) found.
Definition claims_attracted (x : document) (from : Z) (c : cycle) : Prop := claims x /\
  forall s l, describes (scene_data x) s -> begins (begun x) s l -> one_harmonic s /\
    exists motion i orbit, goes s (Flying l) motion /\ Forall2 shows (events x) motion /\
      is_cycle s c i orbit /\ is_drawn s (events x) motion from c i orbit.

Section States.
Variable s : scene.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.
Hypothesis one : one_harmonic s.

(* The impacts after a state. *)
Fixpoint impacts_on (w : wall) (walls : list wall) (x : state) : list impact :=
  match walls with [] => [] | w1 :: walls => impact_at s w1 (fly s w x) :: impacts_on w1 walls (fly s w x) end.
Lemma impacts_walls walls : forall w x, map wall_of (impacts_on w walls x) = walls.
Proof. induction walls as [|w1 walls IH]; intros w x; [reflexivity|]. cbn. rewrite IH. reflexivity. Qed.
Lemma impacts_follow walls : forall w x, all_fly s w walls x -> follows s (rebound s (impact_at s w x)) (impacts_on w walls x).
Proof. induction walls as [|w1 walls IH]; intros w x; [intros _; exact I|]. intros [f rest]. split; [exact f|exact (IH _ _ rest)]. Qed.
Lemma last_default {X : Type} (xs : list X) : forall a b, xs <> [] -> last xs a = last xs b.
Proof. induction xs as [|x [|y xs] IH]; intros a b h; [destruct (h eq_refl)|reflexivity|]. exact (IH a b ltac:(discriminate)). Qed.
Lemma last_cons {X : Type} (x : X) xs a : last (x :: xs) a = last xs x.
Proof. destruct xs as [|y xs]; [reflexivity|]. change (last (y :: xs) a = last (y :: xs) x). apply last_default. discriminate. Qed.
Lemma last_app {X : Type} (xs ys : list X) : forall a, ys <> [] -> last (xs ++ ys) a = last ys a.
Proof. induction xs as [|x xs IH]; intros a some; [reflexivity|]. cbn [app]. rewrite last_cons, (IH x some). apply last_default, some. Qed.
Lemma last_skipn {X : Type} n : forall (xs : list X) a, skipn n xs <> [] -> last xs a = last (skipn n xs) a.
Proof.
  induction n as [|n IH]; intros [|x xs] a some; try reflexivity. cbn [skipn] in *. rewrite last_cons, (IH xs x some). apply last_default, some.
Qed.
Lemma last_firstn {X : Type} (xs : list X) : forall n a b, (n < length xs)%nat -> last (firstn (S n) xs) a = nth n xs b.
Proof.
  induction xs as [|x xs IH]; intros n a b h; [cbn in h; lia|]. cbn [firstn]. rewrite last_cons. destruct n as [|n]; [reflexivity|].
  cbn [nth]. cbn [length] in h. apply IH. lia.
Qed.
Lemma after_nth orbit : forall n i j, (n <= length orbit)%nat -> after s (rebound s i) (firstn n orbit) = rebound s (nth n (i :: orbit) j).
Proof.
  induction orbit as [|y orbit IH]; intros [|n] i j h; cbn [length] in h; try reflexivity; [lia|]. cbn [firstn after]. rewrite (IH n y j) by lia. reflexivity.
Qed.
Lemma after_last orbit : forall i, after s (rebound s i) orbit = rebound s (last orbit i).
Proof. induction orbit as [|y orbit IH]; intros i; [reflexivity|]. rewrite last_cons. apply IH. Qed.
Lemma follows_joined a : forall l b, follows s l a -> follows s (after s l a) b -> follows s l (a ++ b).
Proof. induction a as [|y a IH]; intros l b fa fb; [exact fb|]. destruct fa as [r fa]. split; [exact r|exact (IH _ _ fa fb)]. Qed.
Lemma impacts_last walls : forall w x, last (impacts_on w walls x) (impact_at s w x) = impact_at s (last walls w) (fly_on s w walls x).
Proof. induction walls as [|w1 walls IH]; intros w x; [reflexivity|]. cbn [impacts_on fly_on]. rewrite !last_cons. apply IH. Qed.
Lemma follows_states orbit : forall w x, follows s (rebound s (impact_at s w x)) orbit ->
  all_fly s w (map wall_of orbit) x /\ orbit = impacts_on w (map wall_of orbit) x.
Proof.
  induction orbit as [|i orbit IH]; intros w x; [intros _; split; [exact I|reflexivity]|]. intros [r f].
  destruct (flies_to s A_positive W_positive gap_positive w (wall_of i) x i r eq_refl) as [fl eq].
  assert (i_is : i = impact_at s (wall_of i) (fly s w x)) by (rewrite eq; symmetry; apply impact_of_point; assumption).
  cbn [map all_fly impacts_on]. rewrite i_is in f. destruct (IH _ _ f) as [a same]. split; [split; [exact fl|exact a]|].
  f_equal; [exact i_is|exact same].
Qed.

Lemma turns_recur k : recurs s (IZR k * period s).
Proof. intros h i. rewrite one in i. destruct i as [<-|[]]. exists k. unfold period. field. lra. Qed.
Lemma later_later a b i : later a (later b i) = later (a + b) i.
Proof. unfold later. cbn. f_equal. ring. Qed.
Lemma later_nothing i : later 0 i = i.
Proof. unfold later. destruct i. cbn. f_equal. ring. Qed.
Lemma follows_later P orbit : recurs s P -> forall l, follows s l orbit -> follows s (launch_later P l) (map (later P) orbit).
Proof.
  intros r. induction orbit as [|i orbit IH]; intros l; [intros _; exact I|]. intros [h f]. split; [exact (reaches_later s P r l i h)|exact (IH _ f)].
Qed.
Lemma last_map {X Y : Type} (f : X -> Y) xs : forall a, last (map f xs) (f a) = f (last xs a).
Proof. induction xs as [|x xs IH]; intros a; [reflexivity|]. cbn [map]. rewrite !last_cons. apply IH. Qed.
Lemma leads_later P walls orbit i j : recurs s P -> leads s (rebound s i) walls orbit j -> leads s (rebound s (later P i)) walls (map (later P) orbit) (later P j).
Proof.
  intros r (f & w & e). split; [exact (follows_later P orbit r _ f)|]. split; [rewrite map_map; exact w|]. rewrite last_map, e. reflexivity.
Qed.
Lemma point_later k i : turned k (point_of s (periods_later s k i)) = point_of s i.
Proof. unfold turned, point_of, periods_later, later. cbn [fst snd time velocity]. f_equal. unfold phase, period. field. lra. Qed.
Lemma later_of_turned w k x : impact_at s w x = periods_later s k (impact_at s w (turned k x)).
Proof. apply turned_later. lra. Qed.

(* Mirror images of one harmonic. *)
Lemma half_turn x k : sin (x + IZR (2 * k + 1) * PI) = - sin x /\ cos (x + IZR (2 * k + 1) * PI) = - cos x.
Proof.
  assert (eq : x + IZR (2 * k + 1) * PI - IZR k * (2 * PI) = x + PI) by (rewrite plus_IZR, mult_IZR; ring).
  assert (cos_turns : forall y m, cos (y - IZR m * (2 * PI)) = cos y).
  { intros y m. rewrite !cos_sin. rewrite <- (sin_turns (PI / 2 + y) m). f_equal. ring. }
  split; [rewrite <- (sin_turns _ k), eq; apply neg_sin|rewrite <- (cos_turns _ k), eq; apply neg_cos].
Qed.
Definition launch_mirrored (k : Z) (l : launch) : launch :=
  {| since := since l + IZR (2 * k + 1) * (period s / 2); place := - place l; speed := - speed l |}.
Lemma phase_mirrored t k : phase s (t + IZR (2 * k + 1) * (period s / 2)) = phase s t + IZR (2 * k + 1) * PI.
Proof. unfold phase, period. field. lra. Qed.
Lemma position_mirrored k l t : free_position s (launch_mirrored k l) (t + IZR (2 * k + 1) * (period s / 2)) = - free_position s l t.
Proof.
  rewrite !one_position by exact one. cbn [since place speed launch_mirrored]. rewrite !phase_mirrored.
  destruct (half_turn (phase s t) k) as [-> _]. destruct (half_turn (phase s (since l)) k) as [-> ->]. ring.
Qed.
Lemma velocity_mirrored k l t : free_velocity s (launch_mirrored k l) (t + IZR (2 * k + 1) * (period s / 2)) = - free_velocity s l t.
Proof.
  rewrite !one_velocity by exact one. cbn [since place speed launch_mirrored]. rewrite !phase_mirrored.
  destruct (half_turn (phase s t) k) as [_ ->]. destruct (half_turn (phase s (since l)) k) as [_ ->]. ring.
Qed.
Lemma reaches_mirrored k l i : reaches s l i -> reaches s (launch_mirrored k l) (mirrored s k i).
Proof.
  intros ((a & b & c) & p & v). set (H := IZR (2 * k + 1) * (period s / 2)). unfold reaches, first_contact, mirrored. cbn [wall_of time velocity].
  fold H. assert (pos := position_mirrored k l). assert (vel := velocity_mirrored k l). fold H in pos, vel.
  change (since (launch_mirrored k l)) with (since l + H). split; [split; [lra|split]|split].
  - rewrite pos, Rabs_Ropp. exact b.
  - intros t r. replace t with ((t - H) + H) by ring. rewrite pos, Rabs_Ropp. apply c. lra.
  - rewrite pos, p. unfold plane, side. destruct (wall_of i); cbn; ring.
  - rewrite vel, v. reflexivity.
Qed.
Lemma rebound_mirrored k i : rebound s (mirrored s k i) = launch_mirrored k (rebound s i).
Proof. unfold rebound, mirrored, launch_mirrored, plane, side. cbn. f_equal; [destruct (wall_of i); cbn; ring|ring]. Qed.
Lemma follows_mirrored k orbit : forall i, follows s (rebound s i) orbit -> follows s (rebound s (mirrored s k i)) (map (mirrored s k) orbit).
Proof.
  induction orbit as [|j orbit IH]; intros i; [intros _; exact I|]. intros [h f]. split; [rewrite rebound_mirrored; exact (reaches_mirrored k _ _ h)|exact (IH _ f)].
Qed.
Lemma mirrored_later k P i : mirrored s k (later P i) = later P (mirrored s k i).
Proof. unfold mirrored, later. cbn. f_equal. ring. Qed.
Lemma mirrored_back k i : mirrored s (- k - 1) (mirrored s k i) = i.
Proof.
  unfold mirrored. destruct i as [w t v]. cbn [wall_of time velocity]. f_equal; [destruct w; reflexivity| |ring].
  replace (2 * (- k - 1) + 1)%Z with (- (2 * k + 1))%Z by lia. rewrite opp_IZR. ring.
Qed.
End States.
