(* Trapping regions of one harmonic: the claims of a document (`claims_region`), and the conditions on the flights from its boxes, in the units of
   Step.v (`kept`; Kept.v). States are seen from the left wall: those of the right one half a forcing period later, as mirror images. A region is a
   union of boxes of phase and speed. *)
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
(* The claimed properties: bounds of the flights between impacts, in forcing periods, above once more, and in time; of the speeds before impacts,
   over A W and in the scene's units; and with which impact the scene's motion comes in, if it does; 0 is its start. *)
Record properties := Properties { box_count : Z; flight_periods : Q * Q; longest_flight : Q; flight_times : Q * Q; impact_speeds : Q * Q; impact_velocities : Q * Q; entered : option Z }.

(* Phases are taken up to whole forcing periods. Boxes are closed: they contain their edges. *)
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
(* Impact number n of the scene's motion is in the region; 0 is its start. *)
Definition comes_in (r : region) (b : beginning) (n : Z) : Prop :=
  if (n =? 0)%Z then match b with Struck w t v => forall i, wall_of i = w -> among t (time i) -> among v (velocity i) -> in_region r i | Inside _ _ _ => False end
  else forall l, begins b s l -> exists orbit i, follows s l (orbit ++ [i]) /\ Z.of_nat (length (orbit ++ [i])) = n /\ in_region r i.
End Scene.

Definition claims_region (p : data) (b : beginning) (r : region) (f : properties) : Prop := all_proper p b /\ has_boxes r (box_count f) /\ 0 < Q2R (fst (flight_periods f)) /\
  forall s, describes p s -> sensible s /\ one_harmonic s /\
    (forall i, in_region s r i -> is_as_fast s f i /\ stays s r f i) /\
    match entered f with None => True | Some n => comes_in s r b n end.

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

(* Whole forcing periods. *)
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
(* A ball that arrives at a wall from inside moves towards it. *)
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

(* Sine and cosine near a phase; a mean value; whole numbers. *)
Lemma sin_near x dx : exists t, -1 <= t <= 1 /\ sin (x + dx) = sin x + (cos x + t * dx) * dx.
Proof.
  destruct (Req_dec dx 0) as [->|n]; [exists 0; split; [lra|rewrite Rplus_0_r; ring]|].
  destruct (mean_value sin cos x (x + dx) derivable_pt_lim_sin) as (c & hc & first).
  destruct (mean_value cos (fun y => - sin y) x c derivable_pt_lim_cos) as (c' & _ & second).
  exists (- sin c' * ((c - x) / dx)). split.
  - assert (part : 0 <= (c - x) / dx <= 1).
    { destruct (Rle_lt_dec 0 dx) as [o|o].
      - rewrite Rmin_left, Rmax_right in hc by lra. split; [apply Rdiv_le_0_compat; lra|]. apply (Rmult_le_reg_r dx); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra.
      - rewrite Rmin_right, Rmax_left in hc by lra. replace ((c - x) / dx) with ((x - c) / - dx) by (field; lra).
        split; [apply Rdiv_le_0_compat; lra|]. apply (Rmult_le_reg_r (- dx)); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. lra. }
    assert (b := SIN_bound c'). nra.
  - rewrite first, second. field. exact n.
Qed.
Lemma cos_near x dx : exists t, -1 <= t <= 1 /\ cos (x + dx) = cos x - (sin x + t * dx) * dx.
Proof.
  destruct (sin_near (PI / 2 + x) dx) as (t & b & eq). exists (- t). split; [lra|]. rewrite Rplus_assoc, <- !cos_sin in eq. rewrite eq.
  replace (cos (PI / 2 + x)) with (- sin x) by (rewrite (sin_cos x); ring). ring.
Qed.
Lemma mean_value_between f f' a b : (forall c, Rmin a b <= c <= Rmax a b -> derivable_pt_lim f c (f' c)) -> exists c, Rmin a b <= c <= Rmax a b /\ f b = f a + f' c * (b - a).
Proof.
  intros f_derives. destruct (MVT_gen f a b f') as (c & o & eq).
  - intros x o. apply is_derive_Reals, f_derives. lra.
  - intros x o. apply derivable_continuous_pt. exists (f' x). apply f_derives, o.
  - exists c. split; [exact o|lra].
Qed.
Lemma halfway a b : (a <= b)%Z -> (a <= Z.div2 (a + b) <= b)%Z.
Proof. intros o. assert (e := Z.div2_odd (a + b)). unfold Z.b2z in e. destruct (Z.odd (a + b)); lia. Qed.
(* A number between two whole ones is between two that follow one another. *)
Lemma between_whole n : forall row x, IZR row <= x <= IZR (row + Z.of_nat (S n)) -> exists k, (row <= k < row + Z.of_nat (S n))%Z /\ IZR k <= x <= IZR (k + 1).
Proof.
  induction n as [|n IH]; intros row x o; [exists row; split; [lia|exact o]|].
  destruct (Rle_lt_dec x (IZR (row + 1))) as [l|g]; [exists row; split; [lia|lra]|].
  destruct (IH (row + 1)%Z x) as (k & hk & ok); [|exists k; split; [lia|exact ok]]. split; [lra|].
  replace (row + 1 + Z.of_nat (S n))%Z with (row + Z.of_nat (S (S n)))%Z by lia. apply o.
Qed.
