(* Trapping regions of one harmonic: what a document says of one (`claims_region`), and what has to be shown of the flights from its boxes, in the units
   of Step.v (`kept`, `region_kept`).

   States are seen from the left wall: those of the right one half a forcing period later, as mirror images. A region is a union of boxes of phase and speed. *)
From Coq Require Import Reals Lra List Sorted ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model Step Certificate Document Motion Orbit Cycle.
Open Scope R_scope.
Import ListNotations.

(* A forcing period has columns, a speed of A W has rows; a column has runs of boxes from a first row to a last one. *)
Record region := Region { columns : positive; rows : positive; runs : list (Z * (Z * Z)) }.
(* Runs are listed in order, so that no box is in two of them; and how many boxes they have. *)
Definition run_before (a b : Z * (Z * Z)) : Prop := (fst a < fst b \/ fst a = fst b /\ snd (snd a) < fst (snd b))%Z.
Definition in_grid (r : region) (run : Z * (Z * Z)) : Prop := (0 <= fst run < Zpos (columns r) /\ 0 <= fst (snd run) <= snd (snd run))%Z.
Definition has_boxes (r : region) (n : Z) : Prop := List.Forall (in_grid r) (runs r) /\ Sorted run_before (runs r) /\
  n = fold_right (fun run n => (snd (snd run) - fst (snd run) + 1 + n)%Z) 0%Z (runs r).
(* What is said of it: bounds of the flights between impacts, in forcing periods, above once more, and in time; of the speeds before impacts, over A W and in the scene's units;
   and with which impact the scene's motion comes in, if it does; 0 is its start. *)
Record properties := Properties { box_count : Z; flight_periods : Q * Q; longest_flight : Q; flight_times : Q * Q; impact_speeds : Q * Q; impact_velocities : Q * Q; entered : option Z }.

(* Phases are taken up to whole turns. Boxes are closed: they contain their edges. *)
Definition in_boxes (r : region) (th w : R) : Prop := exists column first last k, In (column, (first, last)) (runs r) /\
  IZR column <= (th / (2 * PI) - IZR k) * IZR (Zpos (columns r)) <= IZR column + 1 /\ IZR first <= w * IZR (Zpos (rows r)) <= IZR last + 1.

Section Scene.
Variable s : scene.

Definition seen (w : wall) : R := match w with left => 0 | right => PI end.
Definition phase_seen (i : impact) : R := phase s (time i) + seen (wall_of i).
Definition speed_seen (i : impact) : R := side (wall_of i) * unit_speed s (velocity i).
Definition in_region (r : region) (i : impact) : Prop := in_boxes r (phase_seen i) (speed_seen i).

(* A flight comes to a wall: at its first contact, or at a later one if it passes contacts before without hitting the wall. At a graze both ways on are allowed. *)
Definition comes_to (l : launch) (i : impact) : Prop := since l < time i /\
  (forall t, since l < t < time i -> Rabs (free_position s l t) <= d s / 2) /\
  free_position s l (time i) = plane s (wall_of i) /\ velocity i = free_velocity s l (time i).
Fixpoint comes_along (l : launch) (orbit : list impact) : Prop :=
  match orbit with [] => True | i :: orbit => comes_to l i /\ comes_along (rebound s i) orbit end.
Lemma reaches_comes l i : reaches s l i -> comes_to l i.
Proof. intros ((a & _ & c) & p & v). repeat split; try assumption. intros t h. left. apply c, h. Qed.
Lemma follows_comes orbit : forall l, follows s l orbit -> comes_along l orbit.
Proof. induction orbit as [|i orbit IH]; intros l; cbn; [trivial|]. intros [r f]. split; [exact (reaches_comes _ _ r)|exact (IH _ f)]. Qed.

Definition flight_lasts (f : properties) (i j : impact) : Prop :=
  in_bounds (flight_periods f) ((time j - time i) / period s) /\ (time j - time i) / period s <= Q2R (longest_flight f) /\ in_bounds (flight_times f) (time j - time i).
Fixpoint flights_last (f : properties) (i : impact) (orbit : list impact) : Prop :=
  match orbit with [] => True | j :: orbit => flight_lasts f i j /\ flights_last f j orbit end.
Definition is_as_fast (f : properties) (i : impact) : Prop := in_bounds (impact_speeds f) (speed_seen i) /\ in_bounds (impact_velocities f) (Rabs (velocity i)).

(* After an impact there are as many as one likes, each the first contact after the one before. Whatever ways are taken at grazes, all impacts are in the
   region, and the bounds hold. An impact is all that can happen next: no rest, and no infinitely many impacts before a time. *)
Definition stays (r : region) (f : properties) (i : impact) : Prop :=
  (forall n, exists orbit, length orbit = n /\ follows s (rebound s i) orbit) /\
  (forall orbit, comes_along (rebound s i) orbit -> List.Forall (fun j => in_region r j /\ is_as_fast f j) orbit /\ flights_last f i orbit) /\
  (forall h, happens s (Flying (rebound s i)) h -> exists j, h = Hits j).
Definition comes_in (r : region) (l : launch) (n : Z) : Prop :=
  if (n =? 0)%Z then exists i, l = rebound s i /\ in_region r i
  else exists orbit i, follows s l (orbit ++ [i]) /\ Z.of_nat (length (orbit ++ [i])) = n /\ in_region r i.
End Scene.

Definition claims_region (p : data) (b : beginning) (r : region) (f : properties) : Prop := all_proper p b /\ has_boxes r (box_count f) /\ 0 < Q2R (fst (flight_periods f)) /\
  forall s, describes p s -> sensible s /\ one_harmonic s /\
    (forall i, in_region s r i -> is_as_fast s f i /\ stays s r f i) /\
    match entered f with None => True | Some n => forall l, begins b s l -> comes_in s r l n end.

(* The flights of a ball that leaves the left wall at phase th0 with velocity p, in the units of Step.v; D is the gap. *)
Section Units.
Variable D : R.
Definition height_at (th0 p th : R) : R := rise [] th0 p th.
Definition rate_at (th0 p th : R) : R := rate [] th0 p th.
Definition level (far : bool) : R := if far then D else 0.
Definition towards (far : bool) : R := if far then 1 else -1.
Definition comes (th0 p th1 : R) (far : bool) : Prop :=
  th0 < th1 /\ (forall th, th0 < th < th1 -> 0 <= height_at th0 p th <= D) /\ height_at th0 p th1 = level far.
Definition departs (th0 p : R) : Prop := exists th1, th0 < th1 /\ forall th, th0 < th <= th1 -> 0 < height_at th0 p th < D.
(* All flights to a wall, each with its duration, come to states in the boxes; and there is one. *)
Definition kept (r : region) (least most : R) (th0 p : R) : Prop := departs th0 p /\
  (exists th, th0 < th /\ (height_at th0 p th < 0 \/ D < height_at th0 p th)) /\
  forall th1 far, comes th0 p th1 far -> least <= th1 - th0 <= most /\
    in_boxes r (th1 + if far then PI else 0) (towards far * rate_at th0 p th1).

Lemma height_is th0 p th : height_at th0 p th = sin th0 - sin th + (p + cos th0) * (th - th0).
Proof. reflexivity. Qed.
Lemma rate_is th0 p th : rate_at th0 p th = p + cos th0 - cos th.
Proof. reflexivity. Qed.
Lemma height_derivative th0 p th : derivable_pt_lim (height_at th0 p) th (rate_at th0 p th).
Proof. apply rise_derivative. Qed.
Lemma height_continuous th0 p th : continuity_pt (height_at th0 p) th.
Proof. apply derivable_continuous_pt. exists (rate_at th0 p th). apply height_derivative. Qed.
Lemma height_start th0 p : height_at th0 p th0 = 0.
Proof. rewrite height_is. ring. Qed.

(* Whole turns. *)
Lemma cos_turns x m : cos (x - IZR m * (2 * PI)) = cos x.
Proof. rewrite !cos_sin, <- (sin_turns (PI / 2 + x) m). f_equal. ring. Qed.
Lemma height_turned k th0 p th : height_at (th0 - IZR k * (2 * PI)) p (th - IZR k * (2 * PI)) = height_at th0 p th.
Proof. rewrite !height_is, !sin_turns, cos_turns. ring. Qed.
Lemma rate_turned k th0 p th : rate_at (th0 - IZR k * (2 * PI)) p (th - IZR k * (2 * PI)) = rate_at th0 p th.
Proof. rewrite !rate_is, !cos_turns. ring. Qed.
Lemma in_boxes_turned r k th w : in_boxes r (th - IZR k * (2 * PI)) w -> in_boxes r th w.
Proof.
  intros (c & a & b & m & i & h & g). exists c, a, b, (m + k)%Z. split; [exact i|]. split; [|exact g]. rewrite plus_IZR.
  replace (th / (2 * PI) - (IZR m + IZR k)) with ((th - IZR k * (2 * PI)) / (2 * PI) - IZR m) by (field; apply PI_neq0). exact h.
Qed.
Lemma kept_turned r least most k th0 p : kept r least most (th0 - IZR k * (2 * PI)) p -> kept r least most th0 p.
Proof.
  set (K := IZR k * (2 * PI)). assert (turned : forall x, height_at (th0 - K) p (x - K) = height_at th0 p x) by (intros x; apply height_turned).
  intros ((th1 & o & inside) & (th2 & o2 & out) & all). split; [|split].
  - exists (th1 + K). split; [lra|]. intros th h. rewrite <- turned. apply inside. lra.
  - exists (th2 + K). split; [lra|]. rewrite <- turned. replace (th2 + K - K) with th2 by ring. exact out.
  - intros th far (h & b & on). destruct (all (th - K) far) as [lasts boxed].
    + split; [lra|]. split; [|rewrite turned; exact on]. intros x hx. replace x with (x + K - K) by ring. rewrite turned. apply b. lra.
    + split; [lra|]. unfold K in boxed. rewrite rate_turned in boxed. apply (in_boxes_turned r k).
      replace (th + (if far then PI else 0) - IZR k * (2 * PI)) with (th - IZR k * (2 * PI) + (if far then PI else 0)) by ring. exact boxed.
Qed.

(* The first time at which a continuous function is 0. *)
Lemma first_zero (f : R -> R) a b : a < b -> (forall x, continuity_pt f x) -> 0 < f a -> f b < 0 ->
  exists m, a < m < b /\ f m = 0 /\ forall x, a <= x < m -> 0 < f x.
Proof.
  intros ab cont fa fb.
  set (E := fun x => a <= x <= b /\ forall y, a <= y <= x -> 0 < f y).
  assert (inhabited : E a) by (split; [lra|intros y hy; replace y with a by lra; exact fa]).
  destruct (completeness E) as (m & upper & least); [exists b; intros x [h _]; lra|exists a; exact inhabited|].
  assert (am : a <= m) by (apply upper, inhabited). assert (mb : m <= b) by (apply least; intros x [h _]; lra).
  assert (below : forall x, a <= x < m -> 0 < f x).
  { intros x [h1 h2]. destruct (Rlt_le_dec 0 (f x)) as [p|n]; [exact p|]. exfalso.
    assert (m <= x); [|lra]. apply least. intros y [hy all]. destruct (Rle_lt_dec y x) as [l|g]; [exact l|]. specialize (all x ltac:(lra)). lra. }
  assert (near : forall eps, 0 < eps -> exists del, 0 < del /\ forall x, Rabs (x - m) < del -> Rabs (f x - f m) < eps).
  { intros eps he. destruct (cont m eps he) as (del & hd & close). exists del. split; [exact hd|]. intros x hx.
    destruct (Req_dec x m) as [->|n]; [rewrite Rminus_eq_0, Rabs_R0; exact he|].
    apply close. split; [split; [exact I|congruence]|exact hx]. }
  destruct (Rtotal_order (f m) 0) as [neg|[zero|pos]].
  - exfalso. destruct (near (- f m) ltac:(lra)) as (del & hd & close). destruct (Req_dec a m) as [<-|n]; [lra|].
    set (x := Rmax a (m - del / 2)). assert (a <= x) by apply Rmax_l. assert (m - del / 2 <= x) by apply Rmax_r.
    assert (x < m) by (apply Rmax_lub_lt; lra). specialize (below x ltac:(lra)). specialize (close x ltac:(apply Rabs_def1; lra)).
    apply Rabs_def2 in close. lra.
  - exists m. split; [|split; [exact zero|exact below]]. split; [destruct am as [l|<-]; [exact l|lra]|destruct mb as [l|<-]; [exact l|lra]].
  - exfalso. destruct (near (f m) pos) as (del & hd & close). assert (m < b) by (destruct mb as [l|<-]; [exact l|lra]).
    set (x := Rmin b (m + del / 2)). assert (x <= b) by apply Rmin_l. assert (x <= m + del / 2) by apply Rmin_r.
    assert (m < x) by (apply Rmin_glb_lt; lra). assert (x <= m); [|lra]. apply upper. split; [lra|]. intros y hy.
    destruct (Rlt_le_dec y m) as [l|g]; [apply below; lra|]. specialize (close y ltac:(apply Rabs_def1; lra)). apply Rabs_def2 in close. lra.
Qed.

Hypothesis D_positive : 0 < D.
(* A flight that departs, and is beyond a wall at some time, has a first contact. *)
Lemma first_comes th0 p : departs th0 p -> (exists th, th0 < th /\ (height_at th0 p th < 0 \/ D < height_at th0 p th)) ->
  exists th1 far, th0 < th1 /\ (forall th, th0 < th < th1 -> 0 < height_at th0 p th < D) /\ height_at th0 p th1 = level far.
Proof.
  intros (a & ha & inside) (b & hb & out). set (f := fun th => height_at th0 p th * (D - height_at th0 p th)).
  assert (sign : forall th, 0 < f th <-> 0 < height_at th0 p th < D) by (intros th; unfold f; split; [intros h; split; nra|nra]).
  assert (fb : f b < 0) by (unfold f; nra).
  assert (ab : a < b). { destruct (Rlt_le_dec a b) as [l|g]; [exact l|]. specialize (inside b ltac:(lra)). lra. }
  destruct (first_zero f a b ab) as (m & hm & zero & before).
  - intros x. apply continuity_pt_mult; [apply height_continuous|].
    apply continuity_pt_minus; [apply continuity_pt_const; intros ? ?; reflexivity|apply height_continuous].
  - apply sign, inside. lra.
  - exact fb.
  - assert (on : exists far, height_at th0 p m = level far).
    { unfold f in zero. apply Rmult_integral in zero as [z|z]; [exists false|exists true]; cbn; lra. }
    destruct on as (far & on). exists m, far. split; [lra|]. split; [|exact on]. intros th h.
    destruct (Rle_lt_dec th a) as [l|g]; [apply inside; lra|]. apply sign, before. lra.
Qed.
(* Who comes to a wall from inside moves towards it. *)
Lemma comes_towards th0 p th1 far : comes th0 p th1 far -> 0 <= towards far * rate_at th0 p th1.
Proof.
  intros (o & inside & on). apply Rnot_lt_le. intros neg. set (l := rate_at th0 p th1) in *.
  destruct (height_derivative th0 p th1 (- (towards far * l)) ltac:(lra)) as ((del & hd) & close). cbn in close.
  set (h := - (Rmin del (th1 - th0)) / 2). assert (Rmin del (th1 - th0) <= del) by apply Rmin_l. assert (Rmin del (th1 - th0) <= th1 - th0) by apply Rmin_r.
  assert (0 < Rmin del (th1 - th0)) by (apply Rmin_glb_lt; lra). assert (hh : h < 0) by (unfold h; lra).
  specialize (close h ltac:(lra) ltac:(apply Rabs_def1; unfold h; lra)). fold l in close.
  specialize (inside (th1 + h) ltac:(unfold h; lra)). set (y := height_at th0 p (th1 + h)) in *. rewrite on in close.
  assert (q : (y - level far) / h * h = y - level far) by (field; lra). apply Rabs_def2 in close.
  destruct far; cbn in *; nra.
Qed.
End Units.

(* In the scene's units. *)
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
(* What is said of a landing in the units of Step.v is said of the impact. *)
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
  set (w := if far then mirror_wall (wall_of i) else wall_of i).
  set (j := {| wall_of := w; time := t; velocity := free_velocity s (rebound s i) t |}).
  assert (far_is : far_from i j = far) by (unfold far_from; cbn; unfold w; destruct far, (wall_of i); reflexivity).
  assert (place_is : free_position s (rebound s i) t = plane s w) by (apply (on_wall_seen i j); cbn [time j]; rewrite far_is, eq; exact on).
  exists j. split; [split; [|split]|split; [exact place_is|reflexivity]].
  - cbn. apply (from_increasing i). rewrite eq, from_start. exact o.
  - cbn [time j]. rewrite place_is. unfold plane. destruct w; cbn; [rewrite Rabs_left by lra|rewrite Rabs_right by lra]; lra.
  - intros x [h h']. cbn in h, h'. apply strictly_inside_seen, inside. apply (from_increasing i) in h, h'. rewrite eq in h'. rewrite from_start in h. lra.
Qed.

(* No rest at once: the wall would press the ball into itself. *)
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
