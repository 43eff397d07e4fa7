(* A program that follows all flights from a box of phase and speed until they are beyond a wall (`check_boxes`), with the proof that whatever they come to
   is in the boxes of a region (`boxes_kept`).

   The march goes over phases of arrival, from one point of a grid to another. Of a grid of 2 `fine` points a column, whole numbers stand for phases and speeds. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Data Certificate Document Region Columns.
Open Scope R_scope.
Import ListNotations.

(* Launches: phases and speeds before impact between points of the grid. *)
Record patch := Patch { from_phase : Z; to_phase : Z; from_speed : Z; to_speed : Z }.

Module Marches (F : FloatOps with Definition sensible_format := true).
Module Import Col := Columns F.
Import Col.Ver.
Import Col.Ver.Check.
Local Opaque add sub mul quotient whole hull sine cosine quarters half_pi.

Section Region.
Variables (r : region) (h : plan).
Let p := plan_bits h.
Notation half_turn := (Zpos (columns r) * Zpos (fine h))%Z.
(* Enclosures of pi/2, of the units of phase and speed, and of d/A and e. *)
Record units := Units { quarter_turn : I.type; phase_unit : I.type; speed_unit : I.type; all_signs : I.type; gap_of : I.type; restitution_of : I.type }.
Variable U : units.

Definition angle (n : Z) : I.type := mul p (phase_unit U) (whole p n).
Definition angles (a b : Z) : I.type := hull (angle a) (angle b).
(* Sine and cosine at a point of the grid, and of phases that differ from it by `X`. *)
Definition turned_by (k : Z) (n : Z) : I.type := sub p (angle n) (mul p (whole p k) (quarter_turn U)).
Definition sine_at (n : Z) : I.type := let k := (2 * n / half_turn)%Z in quarters p k (turned_by k n).
Definition cosine_at (n : Z) : I.type := let k := (2 * n / half_turn)%Z in quarters p (k + 1) (turned_by k n).
Definition sines (S C X : I.type) : I.type := add p S (mul p (add p C (mul p (all_signs U) X)) X).
Definition cosines (S C X : I.type) : I.type := sub p C (mul p (add p S (mul p (all_signs U) X)) X).

(* All launches of a patch, from a middle. *)
Record launches := Launches { middle : Z; off : I.type; speed_after : I.type; sine_mid : I.type; cosine_mid : I.type; sine_all : I.type; cosine_all : I.type }.
Definition launches_of (q : patch) : launches :=
  let m := Z.div2 (from_phase q + to_phase q) in let X := angles (from_phase q - m) (to_phase q - m) in let S := sine_at m in let C := cosine_at m in
  Launches m X (mul p (restitution_of U) (mul p (speed_unit U) (hull (whole p (from_speed q)) (whole p (to_speed q))))) S C (sines S C X) (cosines S C X).

(* Heights and velocities at phases between two points, with what is needed of them: sines and cosines, and times since the launch, of these phases and of one between. *)
Record view := View { sine_then : I.type; cosine_then : I.type; lasting : I.type; around : I.type; sine_between : I.type; cosine_between : I.type; lasting_between : I.type;
  height : I.type; velocity_then : I.type }.
Definition look_at (L : launches) (a b : Z) : view :=
  let m := Z.div2 (a + b) in let X := angles (a - m) (b - m) in let S := sine_at m in let C := cosine_at m in
  let S' := sines S C X in let C' := cosines S C X in let since := angle (m - middle L) in
  let at_middle := add p (sub p (sine_mid L) S) (mul p (add p (speed_after L) (cosine_mid L)) since) in
  let by_launch := I.neg (add p (speed_after L) (mul p (sub p since (off L)) (sine_all L))) in
  let v := sub p (add p (speed_after L) (cosine_all L)) C' in
  View S' C' (sub p (add p since X) (off L)) X S C since (add p (add p at_middle (mul p by_launch (off L))) (mul p v X)) v.

(* Departure: inside the gap up to a point of the grid. *)
Definition check_depart (q : patch) (L : launches) (until : Z) : bool :=
  let a := from_phase q in let m := Z.div2 (a + until) in let X := sines (sine_at m) (cosine_at m) (angles (a - m) (until - m)) in
  let H := angles 0 (until - a) in let v := add p (speed_after L) (mul p X H) in
  is_positive (sub p (gap_of U) (mul p H v)) &? (if is_positive v then true else is_not_negative (speed_after L) &? is_positive X).
Fixpoint depart (n : nat) (q : patch) (L : launches) (after : Z) : option Z :=
  let until := (to_phase q + after)%Z in
  if ((0 <? after)%Z &? check_depart q L until) then Some until else match n with O => None | S n => depart n q L (Z.div2 after) end.

(* The velocity of arrival at a wall, of all launches from which the ball comes there. *)
Definition velocity_told (L : launches) (v : view) (far : bool) : I.type :=
  let rise S S0 := if far then add p (gap_of U) (sub p S S0) else sub p S S0 in
  let slope := quotient p (rise (sine_then v) (sine_all L)) (lasting v) in
  let between := sub p (quotient p (rise (sine_between v) (sine_mid L)) (lasting_between v)) (cosine_between v) in
  let by_launch := quotient p (sub p slope (cosine_all L)) (lasting v) in
  let by_arrival := add p (quotient p (sub p (cosine_then v) slope) (lasting v)) (sine_then v) in
  add p (add p between (mul p by_launch (off L))) (mul p by_arrival (around v)).
(* All arrivals at a wall between two points of the grid. *)
Definition arrivals (L : launches) (v : view) (a b : Z) (far : bool) : bool :=
  let signed X := if far then X else I.neg X in
  if is_positive (if far then sub p (gap_of U) (height v) else height v) then true else
  let V := signed (velocity_then v) in
  if is_positive (I.neg V) then true else
  let V' := signed (velocity_told L v far) in
  if is_positive (I.neg V') then true else
  let in_rows X := mul p X (whole p (Zpos (rows r))) in let more := if far then half_turn else 0%Z in
  in_columns r h most_columns (in_rows V) (in_rows V') ((a + more) / Zpos (2 * fine h)) (b + more).
Fixpoint march (n : nat) (q : patch) (L : launches) (finest : Z) (a step : Z) : bool :=
  match n with
  | O => false
  | S n =>
    let b := (a + step)%Z in let v := look_at L a b in
    if (is_positive (height v) &? is_positive (sub p (gap_of U) (height v))) then march n q L finest b (2 * step) else
    if (if is_positive (I.neg (height v)) then true else is_positive (sub p (height v) (gap_of U))) then true else
    if (finest <? step)%Z then march n q L finest a (Z.max finest (Z.div2 step)) else
    (shortest h <=? a - to_phase q)%Z &? (b - from_phase q <=? longest h)%Z &? arrivals L v a b false &? arrivals L v a b true &? march n q L finest b step
  end.
Definition most_steps : nat := 4096.
Definition check_patch (q : patch) : bool :=
  let width := (to_phase q - from_phase q)%Z in let L := launches_of q in
  match depart 16 q L (8 * width) with
  | None => false
  | Some start => march most_steps q L (Z.max 1 (width / parts h)) start (start - to_phase q)
  end.
Fixpoint check_halves (n : nat) (by_phase : bool) (q : patch) : bool :=
  if check_patch q then true else
  match n with
  | O => false
  | S n =>
    let m := if by_phase then Z.div2 (from_phase q + to_phase q) else Z.div2 (from_speed q + to_speed q) in
    let (low, high) := if by_phase then (Patch (from_phase q) m (from_speed q) (to_speed q), Patch m (to_phase q) (from_speed q) (to_speed q))
      else (Patch (from_phase q) (to_phase q) (from_speed q) m, Patch (from_phase q) (to_phase q) m (to_speed q)) in
    (if by_phase then ((from_phase q <? m)%Z &? (m <? to_phase q)%Z) else true) &? check_halves n (negb by_phase) low &? check_halves n (negb by_phase) high
  end.
Fixpoint check_rows (n : nat) (column row : Z) : bool :=
  match n with
  | O => true
  | S n => let k := Zpos (2 * fine h) in
    check_halves (halvings h) true (Patch (column * k) ((column + 1) * k) (row * k) ((row + 1) * k)) &? check_rows n column (row + 1)
  end.
Definition check_run (run : Z * (Z * Z)) : bool :=
  let (column, rows) := run in
  (0 <=? fst rows)%Z &? (fst rows <=? snd rows)%Z &? check_rows (Z.to_nat (snd rows - fst rows + 1)) column (fst rows).
Definition check_boxes : bool := forallb check_run (runs r).

(* The proof. *)
Variables (D e0 delta sigma : R).
Hypothesis gap_positive : 0 < D.
Hypothesis delta_is : delta = PI / IZR half_turn.
Hypothesis sigma_is : sigma = / IZR (Zpos (rows r) * Zpos (2 * fine h)).
Hypothesis units_hold : holds (quarter_turn U) (PI / 2) /\ holds (phase_unit U) delta /\ holds (speed_unit U) sigma /\
  (forall t, -1 <= t <= 1 -> holds (all_signs U) t) /\ holds (gap_of U) D /\ holds (restitution_of U) e0.
Definition at_point (n : Z) : R := delta * IZR n.

Lemma delta_positive : 0 < delta.
Proof. rewrite delta_is. apply Rdiv_lt_0_compat; [apply PI_RGT_0|apply IZR_lt; lia]. Qed.
Lemma at_point_le a b : (a <= b)%Z -> at_point a <= at_point b.
Proof. intros o. apply IZR_le in o. apply Rmult_le_compat_l; [left; apply delta_positive|exact o]. Qed.
Lemma at_point_lt a b : (a < b)%Z -> at_point a < at_point b.
Proof. intros o. apply IZR_lt in o. apply Rmult_lt_compat_l; [apply delta_positive|exact o]. Qed.
Lemma at_point_minus a b : at_point (a - b) = at_point a - at_point b.
Proof. unfold at_point. rewrite minus_IZR. ring. Qed.
Lemma at_point_plus a b : at_point (a + b) = at_point a + at_point b.
Proof. unfold at_point. rewrite plus_IZR. ring. Qed.

Lemma holds_angle n : holds (angle n) (at_point n).
Proof. destruct units_hold as (_ & hd & _). apply holds_mul; [exact hd|apply holds_whole]. Qed.
Lemma holds_angles a b x : at_point a <= x <= at_point b -> holds (angles a b) x.
Proof. apply holds_hull; apply holds_angle. Qed.
Lemma holds_turned_by k n : holds (turned_by k n) (at_point n - IZR k * (PI / 2)).
Proof. destruct units_hold as (hq & _). apply holds_sub; [apply holds_angle|]. apply holds_mul; [apply holds_whole|exact hq]. Qed.
Lemma holds_sine_at n : holds (sine_at n) (sin (at_point n)).
Proof.
  unfold sine_at. set (k := (2 * n / half_turn)%Z). replace (at_point n) with (at_point n - IZR k * (PI / 2) + IZR k * (PI / 2)) by ring.
  apply holds_quarters, holds_turned_by.
Qed.
Lemma holds_cosine_at n : holds (cosine_at n) (cos (at_point n)).
Proof.
  unfold cosine_at. set (k := (2 * n / half_turn)%Z). rewrite cos_sin.
  replace (PI / 2 + at_point n) with (at_point n - IZR k * (PI / 2) + IZR (k + 1) * (PI / 2)) by (rewrite plus_IZR; ring).
  apply holds_quarters, holds_turned_by.
Qed.
Lemma holds_sines S C X x y : holds S (sin x) -> holds C (cos x) -> holds X (y - x) -> holds (sines S C X) (sin y).
Proof.
  destruct units_hold as (_ & _ & _ & signs & _). intros hs hc hx. destruct (sin_near x (y - x)) as (t & b & eq). specialize (signs t b).
  replace (x + (y - x)) with y in eq by ring. rewrite eq. unfold sines. enclose.
Qed.
Lemma holds_cosines S C X x y : holds S (sin x) -> holds C (cos x) -> holds X (y - x) -> holds (cosines S C X) (cos y).
Proof.
  destruct units_hold as (_ & _ & _ & signs & _). intros hs hc hx. destruct (cos_near x (y - x)) as (t & b & eq). specialize (signs t b).
  replace (x + (y - x)) with y in eq by ring. rewrite eq. unfold cosines. enclose.
Qed.

Definition in_patch (q : patch) (th0 w : R) : Prop := at_point (from_phase q) <= th0 <= at_point (to_phase q) /\
  sigma * IZR (from_speed q) <= w <= sigma * IZR (to_speed q).
(* One patch, and one launch of it. *)
Section Patch.
Variable q : patch.
Variables th0 w : R.
Hypothesis in_q : in_patch q th0 w.
Let u := e0 * w.
Let L := launches_of q.
Let mid := at_point (middle L).

Lemma phases_ordered : (from_phase q <= to_phase q)%Z.
Proof. apply Z.le_ngt. intros o. apply at_point_lt in o. destruct in_q. lra. Qed.
Lemma middle_in : at_point (from_phase q) <= mid <= at_point (to_phase q).
Proof. assert (o := halfway _ _ phases_ordered). split; apply at_point_le; cbn; lia. Qed.
Lemma holds_off x : at_point (from_phase q) <= x <= at_point (to_phase q) -> holds (off L) (x - mid).
Proof. intros o. cbn [off L launches_of]. apply holds_angles. rewrite !at_point_minus. unfold mid, L. cbn [middle launches_of]. lra. Qed.
Lemma holds_sine_all x : at_point (from_phase q) <= x <= at_point (to_phase q) -> holds (sine_all L) (sin x).
Proof. intros o. apply (holds_sines _ _ _ mid); [apply holds_sine_at|apply holds_cosine_at|exact (holds_off x o)]. Qed.
Lemma holds_cosine_all x : at_point (from_phase q) <= x <= at_point (to_phase q) -> holds (cosine_all L) (cos x).
Proof. intros o. apply (holds_cosines _ _ _ mid); [apply holds_sine_at|apply holds_cosine_at|exact (holds_off x o)]. Qed.
Lemma sigma_positive : 0 < sigma.
Proof. rewrite sigma_is. apply Rinv_0_lt_compat, IZR_lt. lia. Qed.
Lemma holds_speed_after : holds (speed_after L) u.
Proof.
  destruct units_hold as (_ & _ & hs & _ & _ & he). assert (pos := sigma_positive). destruct in_q as [_ o].
  cbn [speed_after L launches_of]. apply holds_mul; [exact he|]. replace w with (sigma * (w / sigma)) by (field; lra). apply holds_mul; [exact hs|].
  apply (holds_hull _ _ (IZR (from_speed q)) (IZR (to_speed q))); [apply holds_whole|apply holds_whole|].
  split; apply (Rmult_le_reg_l sigma); try exact pos; replace (sigma * (w / sigma)) with w by (field; lra); lra.
Qed.

Lemma seen_between a b x : at_point a <= x <= at_point b -> let v := look_at L a b in
  holds (around v) (x - at_point (Z.div2 (a + b))) /\ holds (sine_then v) (sin x) /\ holds (cosine_then v) (cos x).
Proof.
  intros o v. set (m := Z.div2 (a + b)). assert (hX : holds (angles (a - m) (b - m)) (x - at_point m)) by (apply holds_angles; rewrite !at_point_minus; lra).
  split; [exact hX|]. split; [apply (holds_sines _ _ _ (at_point m))|apply (holds_cosines _ _ _ (at_point m))]; solve [apply holds_sine_at|apply holds_cosine_at|exact hX].
Qed.
Lemma look_sound a b th : (a <= b)%Z -> at_point a <= th <= at_point b -> let v := look_at L a b in
  holds (sine_then v) (sin th) /\ holds (cosine_then v) (cos th) /\ holds (lasting v) (th - th0) /\
  holds (height v) (height_at th0 u th) /\ holds (velocity_then v) (rate_at th0 u th).
Proof.
  intros ab o v. set (m := Z.div2 (a + b)). assert (hm := halfway a b ab). fold m in hm.
  assert (om : at_point a <= at_point m <= at_point b) by (split; apply at_point_le; lia).
  assert (hX : forall x, at_point a <= x <= at_point b -> holds (angles (a - m) (b - m)) (x - at_point m)) by (intros x ox; apply (seen_between a b x ox)).
  assert (hs : forall x, at_point a <= x <= at_point b -> holds (sine_then v) (sin x)) by (intros x ox; apply (seen_between a b x ox)).
  assert (hc : forall x, at_point a <= x <= at_point b -> holds (cosine_then v) (cos x)) by (intros x ox; apply (seen_between a b x ox)).
  assert (since : holds (angle (m - middle L)) (at_point m - mid)) by (unfold mid; rewrite <- at_point_minus; apply holds_angle).
  assert (hu := holds_speed_after). assert (o0 := proj1 in_q). assert (oc := middle_in).
  assert (hv : forall x, at_point a <= x <= at_point b -> holds (velocity_then v) (rate_at th0 u x)).
  { intros x ox. rewrite rate_is. specialize (hc x ox). assert (h0 := holds_cosine_all th0 o0). cbn [velocity_then look_at v] in *. enclose. }
  split; [exact (hs th o)|]. split; [exact (hc th o)|]. split; [|split; [|exact (hv th o)]].
  - replace (th - th0) with (at_point m - mid + (th - at_point m) - (th0 - mid)) by ring. specialize (hX th o). assert (h0 := holds_off th0 o0).
    cbn [lasting look_at v]. fold m. enclose.
  - destruct (mean_value (height_at th0 u) (rate_at th0 u) (at_point m) th (height_derivative th0 u)) as (z & oz & last).
    destruct (mean_value (fun x => height_at x u (at_point m)) (fun x => - (sin x) * (at_point m - x) - u) mid th0) as (y & oy & first).
    { intros x. exact (rise_derivative_launch [] x u (at_point m)). }
    assert (oz' : at_point a <= z <= at_point b) by (revert oz; apply Rmin_case; apply Rmax_case; lra).
    assert (oy' : at_point (from_phase q) <= y <= at_point (to_phase q)) by (revert oy; apply Rmin_case; apply Rmax_case; lra).
    specialize (hv z oz'). specialize (hX th o). assert (h0 := holds_off th0 o0). assert (hy := holds_off y oy'). assert (hsy := holds_sine_all y oy').
    rewrite last, first, height_is.
    assert (hsm := holds_sine_at m). assert (hS : holds (sine_mid L) (sin mid)) by apply holds_sine_at. assert (hC : holds (cosine_mid L) (cos mid)) by apply holds_cosine_at.
    replace (- sin y * (at_point m - y) - u) with (- (u + (at_point m - mid - (y - mid)) * sin y)) by ring.
    cbn [height look_at v velocity_then] in *. fold m in hv |- *. enclose.
Qed.

Lemma told_sound a b far th : (a <= b)%Z -> at_point a <= th <= at_point b -> at_point (to_phase q) < at_point a -> height_at th0 u th = level D far ->
  holds (velocity_told L (look_at L a b) far) (rate_at th0 u th).
Proof.
  intros ab o late on. set (m := Z.div2 (a + b)). assert (hm := halfway a b ab). fold m in hm. assert (o0 := proj1 in_q). assert (oc := middle_in).
  assert (om : at_point a <= at_point m <= at_point b) by (split; apply at_point_le; lia). destruct units_hold as (_ & _ & _ & _ & hD & _).
  set (l := level D far). set (g := fun x y => (l + (sin y - sin x)) / (y - x) - cos y).
  set (slope := fun x y => (l + (sin y - sin x)) / (y - x)).
  assert (same : rate_at th0 u th = g th0 th) by (unfold g, l; rewrite <- on, height_is, rate_is; field; lra).
  destruct (mean_value_between (fun y => g th0 y) (fun y => (cos y - slope th0 y) / (y - th0) + sin y) (at_point m) th) as (z & oz & last).
  { intros y oy. assert (at_point a <= y) by (revert oy; apply Rmin_case; apply Rmax_case; lra). apply is_derive_Reals. unfold g, slope. auto_derive; [lra|field; lra]. }
  destruct (mean_value_between (fun x => g x (at_point m)) (fun x => (slope x (at_point m) - cos x) / (at_point m - x)) mid th0) as (y & oy & first).
  { intros x ox. assert (x <= at_point (to_phase q)) by (revert ox; apply Rmin_case; apply Rmax_case; lra). apply is_derive_Reals. unfold g, slope. auto_derive; [lra|field; lra]. }
  assert (oz' : at_point a <= z <= at_point b) by (revert oz; apply Rmin_case; apply Rmax_case; lra).
  assert (oy' : at_point (from_phase q) <= y <= at_point (to_phase q)) by (revert oy; apply Rmin_case; apply Rmax_case; lra).
  cbv beta in first, last. rewrite same, last, first.
  set (v := look_at L a b).
  assert (hX : forall x, at_point a <= x <= at_point b -> holds (around v) (x - at_point m)) by (intros x ox; apply (seen_between a b x ox)).
  assert (hs : forall x, at_point a <= x <= at_point b -> holds (sine_then v) (sin x)) by (intros x ox; apply (seen_between a b x ox)).
  assert (hc : forall x, at_point a <= x <= at_point b -> holds (cosine_then v) (cos x)) by (intros x ox; apply (seen_between a b x ox)).
  assert (since : holds (lasting_between v) (at_point m - mid)) by (unfold mid; rewrite <- at_point_minus; apply holds_angle).
  assert (hl : forall x y, at_point (from_phase q) <= x <= at_point (to_phase q) -> at_point a <= y <= at_point b -> holds (lasting v) (y - x)).
  { intros x y0 ox oy0. replace (y0 - x) with (at_point m - mid + (y0 - at_point m) - (x - mid)) by ring. specialize (hX y0 oy0). assert (h0 := holds_off x ox).
    cbn [lasting around lasting_between look_at v] in *. enclose. }
  set (rise := fun S S0 => if far then add p (gap_of U) (sub p S S0) else sub p S S0).
  assert (rises : forall S S0 s1 s0, holds S s1 -> holds S0 s0 -> holds (rise S S0) (l + (s1 - s0))).
  { intros S S0 s1 s0 h1 h0. unfold rise, l. destruct far; cbn [level]; [enclose|rewrite Rplus_0_l; enclose]. }
  assert (hS := holds_sine_all). assert (hC := holds_cosine_all).
  assert (slopes : forall x y, at_point (from_phase q) <= x <= at_point (to_phase q) -> at_point a <= y <= at_point b ->
    holds (quotient p (rise (sine_then v) (sine_all L)) (lasting v)) (slope x y)).
  { intros x y0 ox oy0. apply holds_quotient; [apply rises; [exact (hs y0 oy0)|exact (hS x ox)]|exact (hl x y0 ox oy0)]. }
  assert (hsm : holds (sine_between v) (sin (at_point m))) by apply holds_sine_at. assert (hcm : holds (cosine_between v) (cos (at_point m))) by apply holds_cosine_at.
  assert (hS0 : holds (sine_mid L) (sin mid)) by apply holds_sine_at.
  unfold velocity_told. apply holds_add; [apply holds_add|].
  - apply holds_sub; [|exact hcm]. apply holds_quotient; [apply rises; assumption|exact since].
  - apply holds_mul; [|exact (holds_off th0 o0)]. apply holds_quotient; [|exact (hl y _ oy' om)]. apply holds_sub; [exact (slopes y _ oy' om)|exact (hC y oy')].
  - apply holds_mul; [|exact (hX th o)]. apply holds_add; [|exact (hs z oz')]. apply holds_quotient; [|exact (hl th0 z o0 oz')].
    apply holds_sub; [exact (hc z oz')|exact (slopes th0 z o0 oz')].
Qed.

Lemma depart_sound until : (from_phase q <= until)%Z -> check_depart q L until = true -> forall th, th0 < th <= at_point until -> 0 < height_at th0 u th < D.
Proof.
  intros ord c th o. unfold check_depart in c. set (m := Z.div2 (from_phase q + until)) in *. destruct units_hold as (_ & _ & _ & _ & hD & _).
  assert (o0 := proj1 in_q). set (X := sines _ _ _) in c. set (H := angles _ _) in c.
  assert (hX : forall x, at_point (from_phase q) <= x <= at_point until -> holds X (sin x)).
  { intros x ox. apply (holds_sines _ _ _ (at_point m)); [apply holds_sine_at|apply holds_cosine_at|]. apply holds_angles. rewrite !at_point_minus. lra. }
  assert (hH : forall x, 0 <= x <= at_point until - at_point (from_phase q) -> holds H x).
  { intros x ox. apply holds_angles. rewrite at_point_minus. unfold at_point at 1. lra. }
  assert (hu := holds_speed_after).
  destruct (MVT_cor2 (height_at th0 u) (rate_at th0 u) th0 th (proj1 o) (fun c _ => height_derivative th0 u c)) as (y & eq & oy).
  destruct (MVT_cor2 cos (fun x => - sin x) th0 y (proj1 oy) (fun c _ => derivable_pt_lim_cos c)) as (z & eq' & oz).
  assert (rate_y : rate_at th0 u y = u + sin z * (y - th0)) by (rewrite rate_is; lra).
  rewrite height_start, Rminus_0_r in eq.
  assert (hz := hX z ltac:(lra)). assert (hh := hH (y - th0) ltac:(lra)). assert (hth := hH (th - th0) ltac:(lra)).
  assert (hv : holds (add p (speed_after L) (mul p X H)) (u + sin z * (y - th0))) by enclose.
  split_checks. split.
  - rewrite eq, rate_y. apply Rmult_lt_0_compat; [|lra].
    destruct (is_positive (add p (speed_after L) (mul p X H))) eqn:pos; [exact (is_positive_sound _ _ pos hv)|]. split_checks.
    assert (0 <= u) by exact (is_not_negative_sound _ _ k0 hu). assert (0 < sin z) by exact (is_positive_sound _ _ c hz).
    assert (0 < sin z * (y - th0)) by (apply Rmult_lt_0_compat; lra). lra.
  - assert (0 < D - (th - th0) * (u + sin z * (y - th0))); [|rewrite eq, rate_y; lra].
    apply (is_positive_sound _ _ k). enclose.
Qed.

Lemma half_turn_is : at_point half_turn = PI.
Proof. unfold at_point. rewrite delta_is. field. apply not_0_IZR. lia. Qed.

Lemma arrivals_sound a b far th1 : (a <= b)%Z -> at_point (to_phase q) < at_point a -> arrivals L (look_at L a b) a b far = true -> at_point a <= th1 <= at_point b -> comes D th0 u th1 far ->
  in_boxes r (th1 + if far then PI else 0) (towards far * rate_at th0 u th1).
Proof.
  intros ab late c o cm. destruct (look_sound a b th1 ab o) as (hs & hc & hl & hh & hv). pose proof cm as (later1 & _ & on).
  assert (pos := comes_towards D th0 u th1 far cm). destruct units_hold as (_ & _ & _ & _ & hD & _).
  unfold arrivals in c. set (v := look_at L a b) in *.
  assert (signed : forall X x, holds X x -> holds (if far then X else I.neg X) (towards far * x)).
  { intros X x hX. destruct far; cbn [towards]; [rewrite Rmult_1_l; exact hX|replace (-1 * x) with (- x) by ring; apply holds_neg, hX]. }
  destruct (is_positive (if far then sub p (gap_of U) (height v) else height v)) eqn:clear.
  { exfalso. destruct far; cbn [level] in on; [assert (0 < D - height_at th0 u th1) by (apply (is_positive_sound _ _ clear); enclose)|
      assert (0 < height_at th0 u th1) by exact (is_positive_sound _ _ clear hh)]; lra. }
  assert (hV := signed _ _ hv). destruct (is_positive (I.neg (if far then velocity_then v else I.neg (velocity_then v)))) eqn:away.
  { assert (0 < - (towards far * rate_at th0 u th1)) by exact (is_positive_sound _ _ away (holds_neg _ _ hV)). lra. }
  assert (hV' := signed _ _ (told_sound a b far th1 ab o late on)).  fold v in hV'.
  match type of c with (if ?b then true else _) = true => destruct b eqn:away' end.
  { assert (0 < - (towards far * rate_at th0 u th1)) by exact (is_positive_sound _ _ away' (holds_neg _ _ hV')). lra. }
  set (th := th1 + (if far then PI else 0)). set (more := if far then half_turn else 0%Z) in c.
  assert (moved : at_point (a + more) <= th <= at_point (b + more)).
  { rewrite !at_point_plus. unfold th, more. destruct far; [rewrite half_turn_is; lra|unfold at_point at 2 4; lra]. }
  set (y := th / (2 * PI) * IZR (Zpos (columns r))).
  assert (y_is : y * IZR (Zpos (2 * fine h)) = th / delta).
  { unfold y. rewrite delta_is, mult_IZR. change (Zpos (2 * fine h)) with (2 * Zpos (fine h))%Z. rewrite mult_IZR. field.
    repeat split; try apply PI_neq0; apply not_0_IZR; lia. }
  assert (dp := delta_positive). assert (in_points : IZR (a + more) <= th / delta <= IZR (b + more)).
  { split; apply (Rmult_le_reg_l delta); try exact dp; replace (delta * (th / delta)) with th by (field; lra); apply moved. }
  destruct (in_columns_sound r h _ _ _ _ y _ c) as (column & in_it & oc).
  - apply (Rmult_le_reg_r (IZR (Zpos (2 * fine h)))); [apply IZR_lt; lia|]. rewrite y_is. refine (Rle_trans _ _ _ _ (proj1 in_points)).
    rewrite <- mult_IZR. apply IZR_le. rewrite Z.mul_comm. apply Z.mul_div_le. lia.
  - rewrite y_is. apply in_points.
  - apply (in_column_sound r h _ _ _ _ _ in_it pos); [enclose|enclose|exact oc].
Qed.

(* All that the flights come to from a phase on. *)
Definition comes_well (th1 : R) (far : bool) : Prop := at_point (shortest h) <= th1 - th0 <= at_point (longest h) /\
  in_boxes r (th1 + if far then PI else 0) (towards far * rate_at th0 u th1).
Lemma march_sound n finest : (0 < finest)%Z -> forall a step, (0 < step)%Z -> at_point (to_phase q) < at_point a -> march n q L finest a step = true ->
  (exists th, at_point a <= th /\ (height_at th0 u th < 0 \/ D < height_at th0 u th)) /\
  forall th1 far, comes D th0 u th1 far -> at_point a <= th1 -> comes_well th1 far.
Proof.
  intros fp. induction n as [|n IH]; intros a step sp later0 c; cbn [march] in c; [discriminate|]. set (b := (a + step)%Z) in *.
  assert (ab : (a <= b)%Z) by (unfold b; lia). assert (oab : at_point a < at_point b) by (apply at_point_lt; unfold b; lia).
  assert (o0 := proj1 in_q). assert (after : th0 < at_point a) by lra. destruct units_hold as (_ & _ & _ & _ & hD & _).
  assert (seen_at : forall th, at_point a <= th <= at_point b -> holds (height (look_at L a b)) (height_at th0 u th)) by (intros th o; apply (look_sound a b th ab o)).
  set (v := look_at L a b) in *.
  assert (go_on : forall step', (0 < step')%Z -> march n q L finest b step' = true ->
    (forall th1 far, comes D th0 u th1 far -> at_point a <= th1 <= at_point b -> comes_well th1 far) ->
    (exists th, at_point a <= th /\ (height_at th0 u th < 0 \/ D < height_at th0 u th)) /\
    forall th1 far, comes D th0 u th1 far -> at_point a <= th1 -> comes_well th1 far).
  { intros step' sp' c' here. destruct (IH b step' sp' (Rlt_trans _ _ _ later0 oab) c') as [(th & o & out) all]. split; [exists th; split; [lra|exact out]|].
    intros th1 far cm o1. destruct (Rle_lt_dec th1 (at_point b)); [apply here|apply all]; try assumption; lra. }
  destruct (is_positive (height v) &? is_positive (sub p (gap_of U) (height v))) eqn:clear.
  { split_checks. apply (go_on (2 * step)%Z ltac:(lia) c). intros th1 far (_ & _ & on) o. exfalso. specialize (seen_at th1 o).
    assert (0 < height_at th0 u th1) by exact (is_positive_sound _ _ k seen_at).
    assert (0 < D - height_at th0 u th1) by (apply (is_positive_sound _ _ clear); enclose). destruct far; cbn in on; lra. }
  destruct (if is_positive (I.neg (height v)) then true else is_positive (sub p (height v) (gap_of U))) eqn:beyond.
  { specialize (seen_at (at_point a) ltac:(lra)).
    assert (out : height_at th0 u (at_point a) < 0 \/ D < height_at th0 u (at_point a)).
    { destruct (is_positive (I.neg (height v))) eqn:k.
      - left. assert (0 < - height_at th0 u (at_point a)) by exact (is_positive_sound _ _ k (holds_neg _ _ seen_at)). lra.
      - right. assert (0 < height_at th0 u (at_point a) - D) by (apply (is_positive_sound _ _ beyond); enclose). lra. }
    split; [exists (at_point a); split; [lra|exact out]|]. intros th1 far (o & inside & on) o1. exfalso.
    destruct (Rle_lt_or_eq_dec _ _ o1) as [l|<-]; [specialize (inside (at_point a) ltac:(lra)); lra|]. destruct far; cbn in on; lra. }
  destruct (finest <? step)%Z eqn:long; [apply (IH a (Z.max finest (Z.div2 step)) ltac:(lia) later0 c)|].
  split_checks. apply Z.leb_le in k, k0. apply (go_on step sp c). intros th1 far cm o. split.
  - apply at_point_le in k, k0. rewrite at_point_minus in k, k0. lra.
  - apply (arrivals_sound a b far th1 ab); try assumption. destruct far; assumption.
Qed.

Lemma depart_found n : forall after start, (0 <= to_phase q - from_phase q)%Z -> depart n q L after = Some start -> (to_phase q < start)%Z /\ check_depart q L start = true.
Proof.
  induction n as [|n IH]; intros after start o c; cbn [depart] in c;
    (destruct ((0 <? after)%Z &? check_depart q L (to_phase q + after)) eqn:k; [injection c as <-; split_checks; apply Z.ltb_lt in k0; split; [lia|exact k]|]).
  - discriminate.
  - exact (IH _ _ o c).
Qed.
Lemma patch_sound : check_patch q = true -> kept D r (at_point (shortest h)) (at_point (longest h)) th0 u.
Proof.
  unfold check_patch. fold L. destruct (depart 16 q L _) as [start|] eqn:found; [|discriminate]. intros c. assert (ord := phases_ordered).
  destruct (depart_found _ _ _ ltac:(lia) found) as [after dep]. assert (inside := depart_sound start ltac:(lia) dep).
  assert (late := at_point_lt _ _ after). assert (o0 := proj1 in_q).
  apply march_sound in c; [|lia|lia|lra]. destruct c as [(th & o & out) all]. split; [exists (at_point start); split; [lra|exact inside]|].
  split; [exists th; split; [lra|exact out]|]. intros th1 far cm. apply all; [exact cm|]. apply Rnot_lt_le. intros l.
  destruct cm as (o1 & _ & on). specialize (inside th1 ltac:(lra)). destruct far; cbn in on; lra.
Qed.
End Patch.

Definition patch_kept (q : patch) : Prop := forall th0 w, in_patch q th0 w -> kept D r (at_point (shortest h)) (at_point (longest h)) th0 (e0 * w).
Lemma halves_sound n : forall by_phase q, check_halves n by_phase q = true -> patch_kept q.
Proof.
  induction n as [|n IH]; intros by_phase q c; cbn [check_halves] in c; (destruct (check_patch q) eqn:whole_one; [intros th0 w i; exact (patch_sound q th0 w i whole_one)|]);
    [discriminate|]. intros th0 w [o o']. destruct by_phase; split_checks.
  - set (m := Z.div2 (from_phase q + to_phase q)) in *. destruct (Rle_lt_dec th0 (at_point m)).
    + refine (IH _ (Patch (from_phase q) m (from_speed q) (to_speed q)) _ _ _ _); [eassumption|split; [cbn; lra|exact o']].
    + refine (IH _ (Patch m (to_phase q) (from_speed q) (to_speed q)) _ _ _ _); [eassumption|split; [cbn; lra|exact o']].
  - set (m := Z.div2 (from_speed q + to_speed q)) in *. destruct (Rle_lt_dec w (sigma * IZR m)).
    + refine (IH _ (Patch (from_phase q) (to_phase q) (from_speed q) m) _ _ _ _); [eassumption|split; [exact o|cbn; lra]].
    + refine (IH _ (Patch (from_phase q) (to_phase q) m (to_speed q)) _ _ _ _); [eassumption|split; [exact o|cbn; lra]].
Qed.
Lemma rows_sound n column : forall row, check_rows n column row = true -> forall k, (row <= k < row + Z.of_nat n)%Z ->
  let m := Zpos (2 * fine h) in patch_kept (Patch (column * m) ((column + 1) * m) (k * m) ((k + 1) * m)).
Proof.
  induction n as [|n IH]; intros row c k o; [lia|]. cbn [check_rows] in c. split_checks.
  destruct (Z.eq_dec k row) as [->|ne]; [exact (halves_sound _ _ _ k0)|]. apply (IH _ c). lia.
Qed.
Theorem boxes_kept : check_boxes = true -> forall th w, in_boxes r th w -> kept D r (at_point (shortest h)) (at_point (longest h)) th (e0 * w).
Proof.
  unfold check_boxes. intros c th w (column & first & last & turns & member & o & o'). rewrite forallb_forall in c. specialize (c _ member). unfold check_run in c. cbn [fst snd] in c.
  split_checks. apply Z.leb_le in k, k0. set (n := Z.to_nat (last - first + 1)) in *.
  destruct (between_whole (Z.to_nat (last - first)) first (w * IZR (Zpos (rows r)))) as (row & hrow & orow).
  { split; [apply o'|]. replace (first + Z.of_nat (S (Z.to_nat (last - first))))%Z with (last + 1)%Z by lia. rewrite plus_IZR. apply o'. }
  apply (kept_turned D r _ _ turns). apply (rows_sound n column first c row ltac:(lia)). set (m := Zpos (2 * fine h)).
  assert (mp : 0 < IZR m) by (apply IZR_lt; reflexivity). assert (cp : 0 < IZR (Zpos (columns r))) by (apply IZR_lt; lia). assert (rp : 0 < IZR (Zpos (rows r))) by (apply IZR_lt; lia).
  assert (dm : delta * IZR m * IZR (Zpos (columns r)) = 2 * PI).
  { rewrite delta_is, mult_IZR. unfold m. change (Zpos (2 * fine h)) with (2 * Zpos (fine h))%Z. rewrite mult_IZR. field. split; apply not_0_IZR; lia. }
  assert (sm : sigma * IZR m * IZR (Zpos (rows r)) = 1) by (rewrite sigma_is, mult_IZR; fold m; field; split; lra).
  assert (dp := delta_positive). assert (pi := PI_RGT_0). split; unfold at_point; cbn [from_phase to_phase from_speed to_speed].
  - rewrite !mult_IZR, plus_IZR. assert (eq : th - IZR turns * (2 * PI) = delta * IZR m * ((th / (2 * PI) - IZR turns) * IZR (Zpos (columns r)))).
    { transitivity ((th / (2 * PI) - IZR turns) * (delta * IZR m * IZR (Zpos (columns r)))); [rewrite dm; field; lra|ring]. }
    rewrite eq. assert (0 < delta * IZR m) by (apply Rmult_lt_0_compat; lra).
    assert (unit_of : forall x, delta * (x * IZR m) = delta * IZR m * x) by (intros; ring). rewrite !unit_of. split; apply Rmult_le_compat_l; lra.
  - rewrite !mult_IZR. assert (sp := sigma_positive). assert (eq : w = sigma * IZR m * (w * IZR (Zpos (rows r)))).
    { transitivity (w * (sigma * IZR m * IZR (Zpos (rows r)))); [rewrite sm; ring|ring]. }
    rewrite eq. assert (0 < sigma * IZR m) by (apply Rmult_lt_0_compat; lra).
    assert (unit_of : forall x, sigma * (x * IZR m) = sigma * IZR m * x) by (intros; ring). rewrite !unit_of. split; apply Rmult_le_compat_l; lra.
Qed.
End Region.
End Marches.
