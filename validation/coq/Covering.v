(* Covering relations of the impact map, checked by evaluation: a program `check_way` on Interval's arithmetic, and the proof
   that ways which it accepts are carried, as Horseshoe.v has it, by true flights.

   Parallelograms lie in the plane (phase, velocity before impact over A W), their corners on the grid of 2^-q. All flights of a
   stretch of one are proved as those of a leg of a certificate; bounds of their image are of mean-value form in the
   parallelogram's own coordinates, with the entries of (A.7). *)
From Coq Require Import Reals Lra List ZArith Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Horseshoe Return Certificate.
Open Scope R_scope.
Import ListNotations.

(* A parallelogram: its centre, and half vectors along and across. *)
Record chart := Chart { cu : Z; cv : Z; lu : Z; lv : Z; wu : Z; wv : Z }.
Definition frame_of (q : positive) (N : chart) : frame := {| centre := (grid q (cu N), grid q (cv N));
  long := (grid q (lu N), grid q (lv N)); wide := (grid q (wu N), grid q (wv N)) |}.

Definition chart_area (N : chart) : Z := (lu N * wv N - lv N * wu N)%Z.
Lemma chart_area_positive q N : (0 < chart_area N)%Z -> 0 < area (frame_of q N).
Proof.
  intros h. apply IZR_lt in h. unfold chart_area in h. rewrite minus_IZR, !mult_IZR in h.
  unfold area, frame_of, grid. cbn [long wide fst snd]. assert (g := grid_step q). set (r := / IZR (2 ^ Zpos q)) in *.
  replace (_ - _) with (r * r * (IZR (lu N) * IZR (wv N) - IZR (lv N) * IZR (wu N))) by ring.
  apply Rmult_lt_0_compat; [nra|exact h].
Qed.
(* Bounds of a parallelogram. *)
Lemma chart_bounds q N x : (0 < chart_area N)%Z -> in_frame (frame_of q N) x ->
  Rabs (fst x - grid q (cu N)) <= grid q (Z.abs (lu N) + Z.abs (wu N)) /\ Rabs (snd x - grid q (cv N)) <= grid q (Z.abs (lv N) + Z.abs (wv N)).
Proof.
  intros h [hxi heta]. rewrite <- (put_back (frame_of q N) x) by (apply Rgt_not_eq, chart_area_positive, h).
  set (xi := along _ x) in *. set (eta := across _ x) in *. unfold put, frame_of, grid. cbn [fst snd centre long wide].
  assert (g := grid_step q). set (r := / IZR (2 ^ Zpos q)) in *. rewrite !plus_IZR, !abs_IZR.
  assert (one : forall a b c : R, Rabs (r * a + r * b * xi + r * c * eta - r * a) <= r * (Rabs b + Rabs c)).
  { intros a b c. replace (r * a + r * b * xi + r * c * eta - r * a) with (r * (b * xi + c * eta)) by ring.
    rewrite Rabs_mult, (Rabs_pos_eq r) by lra. apply Rmult_le_compat_l; [lra|]. eapply Rle_trans; [apply Rabs_triang|].
    assert (Rabs xi <= 1) by (apply Rabs_le; lra). assert (Rabs eta <= 1) by (apply Rabs_le; lra).
    rewrite !Rabs_mult. assert (b0 := Rabs_pos b). assert (c0 := Rabs_pos c). nra. }
  split; apply one.
Qed.
Lemma grid_at_most q m n k : (m * n <= k * 2 ^ Zpos q)%Z -> IZR m * grid q n <= IZR k.
Proof.
  intros h. apply IZR_le in h. rewrite !mult_IZR in h. unfold grid. assert (g := grid_step q).
  assert (0 < IZR (2 ^ Zpos q)) by (apply IZR_lt, Z.pow_pos_nonneg; lia).
  apply (Rmult_le_reg_r (IZR (2 ^ Zpos q))); [assumption|]. replace (_ * _ * _) with (IZR m * IZR n) by (field; lra). exact h.
Qed.

(* The arrival of all flights from a stretch of a parallelogram: brackets of the phases of arrival, middle and radius, a wide one that shows the
   first contact and a narrow one for the image; where flights are cut, the end of the departure and the begin of the arrival; two tilts, as in
   Certificate.v, for the image along and across a parallelogram. All on the grid. *)
Record transit := Transit { wide_mid : Z; wide_rad : Z; near_mid : Z; near_rad : Z; go : Z; come : Z; lean_along : Z; lean_across : Z }.

(* One covering relation: a stretch of the first parallelogram; its transit; whether it is turned over. *)
Record link := Link { stretch_from : Z; stretch_to : Z; wide_at : Z; wide_by : Z; near_at : Z; near_by : Z;
  leave : Z; arrive : Z; tilt_along : Z; tilt_across : Z; turned_over : bool }.
Definition transit_of (l : link) : transit := Transit (wide_at l) (wide_by l) (near_at l) (near_by l) (leave l) (arrive l) (tilt_along l) (tilt_across l).

(* A step of a word: a flight from wall to wall, and the whole forcing periods that are taken off its phase. *)
Record hop_of := Hop { off_wall : wall; on_wall : wall; turns_off : Z }.

Section Maps.
Variable s : scene.
Definition turned (k : Z) (x : state) : state := (fst x - IZR k * (2 * PI), snd x).
Definition hop (h : hop_of) (x : state) : state := turned (turns_off h) (fly s (off_wall h) x).
Fixpoint follow (word : list hop_of) (x : state) : state := match word with [] => x | h :: word => follow word (hop h x) end.
(* Each step of the word is a flight to its wall. *)
Fixpoint flown (word : list hop_of) (x : state) : Prop :=
  match word with [] => True | h :: word => flies s (off_wall h) (on_wall h) x /\ flown word (hop h x) end.
(* The same for any shift, of the state or of its mirror image. *)
Definition shifted (k : R) (mirror : bool) (x : state) : state := (fst x - k, if mirror then - snd x else snd x).
Lemma shifted_continuous k mirror : continuous_on (fun _ => True) (shifted k mirror).
Proof.
  unfold shifted. refine (on_pair _ (fun x : state => fst x - k) _ (on_minus _ _ _ (on_fst _) (on_const _ _)) _). destruct mirror; [|exact (on_snd _)].
  apply (continuous_on_ext _ (fun x : state => 0 - snd x)); [intros x _; apply Rminus_0_l|]. exact (on_minus _ _ _ (on_const _ _) (on_snd _)).
Qed.
Lemma turned_continuous k : continuous_on (fun _ => True) (turned k).
Proof.
  refine (on_pair _ _ _ _ (on_snd _)). exact (on_minus _ _ _ (on_fst _) (on_const _ _)).
Qed.
Lemma turned_none x : turned 0 x = x.
Proof. destruct x as [u v]. unfold turned. cbn [fst snd]. f_equal. ring. Qed.
(* Turns taken off a phase are periods taken off a time. *)
Lemma turned_later w k x : W s <> 0 -> impact_at s w x = later (IZR k * period s) (impact_at s w (turned k x)).
Proof. intros h. unfold later, impact_at, turned, period. cbn. f_equal. field. exact h. Qed.
End Maps.

Module Coverings (F : FloatOps with Definition sensible_format := true).
Include Checker F.
Local Opaque add sub mul quotient whole hull sine cosine.

Section Grid_of_charts.
Variables p q : positive.
Variable param : data.
Notation pt := (point p (unit_step p q)).
Notation E := (enclose_range p (restitution param)).
Notation OS := (known_in param p).
Notation G := (gamma_in param p).

Lemma holds_pt n : holds (pt n) (grid q n).
Proof. apply holds_point, unit_step_holds. Qed.

(* The middle of a stretch of the coordinate along, half its length, and the coordinates from there. *)
Definition middle (a b : Z) : I.type := quotient p (add p (pt a) (pt b)) (whole p 2).
Definition half (a b : Z) : I.type := quotient p (sub p (pt b) (pt a)) (whole p 2).
Definition reach (a b : Z) : I.type := hull (I.neg (half a b)) (half a b).
Definition one : I.type := hull (whole p (-1)) (whole p 1).

Definition launches (w : wall) (N : chart) (a b : Z) : box :=
  let Tc := add p (pt (cu N)) (mul p (pt (lu N)) (middle a b)) in
  let dT := add p (mul p (pt (lu N)) (reach a b)) (mul p (pt (wu N)) one) in
  let Vc := add p (pt (cv N)) (mul p (pt (lv N)) (middle a b)) in
  let dV := add p (mul p (pt (lv N)) (reach a b)) (mul p (pt (wv N)) one) in
  {| from := Some w; somewhere := whole p 0; around := turns q (cu N); lowest := cu N + Z.min (lu N * a) (lu N * b) / 2 ^ Zpos q - Z.abs (wu N); box_scale := q;
     T := add p Tc dT; Tc := Tc; dT := dT;
     U := mul p (I.neg E) (add p Vc dV); Uc := mul p (I.neg E) Vc; dU := mul p (I.neg E) dV |}.

(* n1 th + n2 rate + n0 - mu (distance from the wall), at phase th of flights of a box, in mean-value form: th in X1, X its
   middle, R their difference; D the coordinate along, from the middle of the stretch. *)
Definition image (b : box) (a : aspects) (N : chart) (w : wall) (n1 n2 n0 mu : I.type) (m : Z) (X X1 R D : I.type) : I.type :=
  let middle := sub p (add p (add p (mul p n1 X) (mul p n2 (rate_centre p OS b a p m X))) n0)
    (mul p mu (add p (offset p G b w) (rise_centre p OS b a m X))) in
  let by_phase := sub p (mul p n2 (I.neg (Bend0 a))) (mul p mu (sub p (mul p (I.neg (Bend0 a)) (sub p X1 (T b))) (U b))) in
  let by_speed := sub p n2 (mul p mu (sub p X1 (Tc b))) in
  let by_arrival := sub p (add p n1 (mul p n2 (box_bend_over p OS m X1))) (mul p mu (rate_centre p OS b a p m X1)) in
  let side u v := add p (mul p by_phase (pt u)) (mul p by_speed (mul p (I.neg E) (pt v))) in
  add p (add p (add p middle (mul p (side (lu N) (lv N)) D)) (mul p (side (wu N) (wv N)) one)) (mul p by_arrival R).

Definition area_over (N : chart) : I.type := sub p (mul p (pt (lu N)) (pt (wv N))) (mul p (pt (lv N)) (pt (wu N))).

(* All flights of a stretch of the chart N, of which b is the box of launches, are from w to w1, and arrive in the narrow bracket. *)
Definition check_arrivals (w1 : wall) (N : chart) (from to : Z) (b : box) (a : aspects) (c : transit) : bool :=
  let n := near_mid c in let lo := (n - near_rad c)%Z in let hi := (n + near_rad c)%Z in let zero := whole p 0 in
  let height x := image b a N w1 zero zero zero (whole p (-1)) (turns q x) (pt x) (pt x) zero (reach from to) in
  (0 <=? near_rad c)%Z &? (0 <? chart_area N)%Z &? (wide_mid c - wide_rad c <=? lo)%Z &? (hi <=? wide_mid c + wide_rad c)%Z &?
  check_flight param b (Leg p p q w1 (wide_mid c) (wide_rad c) 0 0 (go c) (come c) 0) &?
  is_positive (I.neg (sided w1 (height lo))) &? is_not_negative (sided w1 (height hi)).
(* n1 phase + n2 velocity + n0 where they arrive; mu is the tilt. *)
Definition arrived (w1 : wall) (N : chart) (b : box) (a : aspects) (c : transit) (mu : Z) (D n1 n2 n0 : I.type) : I.type :=
  let n := near_mid c in let r := near_rad c in
  image b a N w1 n1 n2 n0 (pt mu) (turns q n) (pt n) (stretch p (unit_step p q) (n - r) (n + r)) (stretch p (unit_step p q) (- r) r) D.
(* The coordinates along and across M, times its area, of an arrival from whose phase K is taken off, or of its mirror image. *)
Definition along_of (K : I.type) (mirror : bool) (M : chart) (image : I.type -> I.type -> I.type -> I.type) : I.type :=
  let u := pt (wu M) in let v := pt (wv M) in
  image v (if mirror then u else I.neg u) (sub p (mul p u (pt (cv M))) (mul p v (add p (pt (cu M)) K))).
Definition across_of (K : I.type) (mirror : bool) (M : chart) (image : I.type -> I.type -> I.type -> I.type) : I.type :=
  let u := pt (lu M) in let v := pt (lv M) in
  image (I.neg v) (if mirror then I.neg u else u) (sub p (mul p v (add p (pt (cu M)) K)) (mul p u (pt (cv M)))).
Definition turn_over (yes : bool) (X : I.type) : I.type := if yes then I.neg X else X.

Definition check_link (h : hop_of) (N M : chart) (l : link) : bool :=
  let w1 := on_wall h in let a := stretch_from l in let b := stretch_to l in let c := transit_of l in
  let box := launches (off_wall h) N a b in let seen := look p OS box p in
  let K := mul p (whole p (turns_off h)) (mul p (whole p 2) (I.pi (F.PtoP p))) in
  let along D := turn_over (turned_over l) (along_of K false M (arrived w1 N box seen c (lean_along c) D)) in
  let across := across_of K false M (arrived w1 N box seen c (lean_across c) (reach a b)) in
  let edge := area_over M in
  (- 2 ^ Zpos q <=? a)%Z &? (a <=? b)%Z &? (b <=? 2 ^ Zpos q)%Z &? (0 <? chart_area M)%Z &? check_arrivals w1 N a b box seen c &?
  is_not_negative (sub p edge across) &? is_not_negative (add p edge across) &?
  is_not_negative (I.neg (add p (along (I.neg (half a b))) edge)) &? is_not_negative (sub p (along (half a b)) edge).

(* A way: parallelograms one after another, along a word. *)
Fixpoint check_way (word : list hop_of) (N : chart) (way : list (link * chart)) : bool :=
  match word, way with
  | [], [] => true
  | h :: word, (l, M) :: way => check_link h N M l &? check_way word M way
  | _, _ => false
  end.
End Grid_of_charts.

Section Sound.
Variables p q : positive.
Variable param : data.
Variable s : scene.
Hypothesis described : describes param s.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.
Notation pt := (point p (unit_step p q)).
Notation E := (enclose_range p (restitution param)).
Notation OS := (known_in param p).
Let os := companions s.
Let gamma := d s / A s.

Lemma holds_e : holds E (e s).
Proof. apply holds_range, described. Qed.

Section Stretch.
Variable N : chart.
Hypothesis N_area : (0 < chart_area N)%Z.
Variables (w : wall) (a b : Z).
Variable x : state.
Hypothesis x_in : slice (frame_of q N) (grid q a) (grid q b) x.
Let b_in := launches p q param w N a b.
Let mid := (grid q a + grid q b) / 2.
Let delta := along (frame_of q N) x - mid.
Let eta := across (frame_of q N) x.
Let thc := grid q (cu N) + grid q (lu N) * mid.
Let uc := - e s * (grid q (cv N) + grid q (lv N) * mid).

Lemma x_phase : fst x = thc + (grid q (lu N) * delta + grid q (wu N) * eta).
Proof.
  rewrite <- (put_back (frame_of q N) x) at 1 by (apply Rgt_not_eq, (chart_area_positive q), N_area).
  unfold put, thc, delta, eta. cbn [fst snd frame_of centre long wide]. ring.
Qed.
Lemma x_speed : snd x = grid q (cv N) + grid q (lv N) * mid + (grid q (lv N) * delta + grid q (wv N) * eta).
Proof.
  rewrite <- (put_back (frame_of q N) x) at 1 by (apply Rgt_not_eq, (chart_area_positive q), N_area).
  unfold put, delta, eta. cbn [fst snd frame_of centre long wide]. ring.
Qed.
Lemma holds_one : holds (one p) eta.
Proof. apply (holds_hull _ _ (-1) 1); try apply (holds_whole p). apply x_in. Qed.
Lemma holds_middle : holds (middle p q a b) mid.
Proof. unfold middle, mid. assert (ha := holds_pt p q a). assert (hb := holds_pt p q b). enclose. Qed.
Lemma holds_half : holds (half p q a b) ((grid q b - grid q a) / 2).
Proof. unfold half. assert (ha := holds_pt p q a). assert (hb := holds_pt p q b). enclose. Qed.
Lemma holds_reach : holds (reach p q a b) delta.
Proof.
  assert (h := holds_half). apply (holds_hull _ _ _ _ _ (holds_neg _ _ h) h). unfold delta, mid. destruct x_in as [r _]. lra.
Qed.
Lemma holds_reach_0 : holds (reach p q a b) 0.
Proof.
  assert (h := holds_half). apply (holds_hull _ _ _ _ _ (holds_neg _ _ h) h). destruct x_in as [r _]. lra.
Qed.
Lemma holds_one_0 : holds (one p) 0.
Proof. apply (holds_hull _ _ (-1) 1); try apply (holds_whole p). lra. Qed.

Lemma launches_hold : in_box gamma (side w * (gamma / 2)) (fst x) (launch_speed s x) thc uc b_in.
Proof.
  assert (hE := holds_neg _ _ holds_e). assert (h1 := holds_one). assert (hm := holds_middle). assert (hr := holds_reach).
  assert (z := holds_reach_0). assert (z1 := holds_one_0).
  assert (h2 := holds_pt p q (cu N)). assert (h3 := holds_pt p q (cv N)). assert (h4 := holds_pt p q (lu N)).
  assert (h5 := holds_pt p q (lv N)). assert (h6 := holds_pt p q (wu N)). assert (h7 := holds_pt p q (wv N)).
  assert (d1 : fst x - thc = grid q (lu N) * delta + grid q (wu N) * eta) by (rewrite x_phase; ring).
  assert (d2 : launch_speed s x - uc = - e s * (grid q (lv N) * delta + grid q (wv N) * eta)) by (unfold launch_speed, uc; rewrite x_speed; ring).
  assert (c1 : thc = thc + (grid q (lu N) * 0 + grid q (wu N) * 0)) by ring.
  unfold in_box, b_in, launches. cbn [from somewhere T Tc dT U Uc dU]. split; [reflexivity|].
  split; [rewrite x_phase; unfold thc; enclose|]. split; [rewrite c1; unfold thc; enclose|]. split; [unfold thc; enclose|].
  split; [rewrite d1; enclose|]. split; [|split; [unfold uc; enclose|rewrite d2; enclose]].
  unfold launch_speed. rewrite x_speed. enclose.
Qed.

Variable seen_ : aspects.
Hypothesis seen_holds : seen thc os b_in seen_.
Variable w1 : wall.
Lemma image_holds n1 n2 n0 mu N1 N2 N0 MU m x1 th1 X X1 R D : holds N1 n1 -> holds N2 n2 -> holds N0 n0 -> holds MU mu ->
  holds X x1 -> holds X1 x1 -> holds X1 th1 -> holds R (th1 - x1) -> holds D delta ->
  holds (image p q param b_in seen_ N w1 N1 N2 N0 MU m X X1 R D)
    (n1 * th1 + n2 * rate os (fst x) (launch_speed s x) th1 + n0
      - mu * (side w * (gamma / 2) - side w1 * (gamma / 2) + rise os (fst x) (launch_speed s x) th1)).
Proof.
  intros h1 h2 h0 hmu hX hX1 hth hR hD.
  set (th0 := fst x). set (u := launch_speed s x). set (off := side w * (gamma / 2) - side w1 * (gamma / 2)).
  assert (inb := launches_hold). fold th0 u in inb. pose proof inb as (_ & k0 & k1 & kc & kd & ku & kuc & kdu).
  assert (hos : Forall2 knows OS os) by (apply holds_known; assumption).
  destruct (mean_value (fun z => n2 * rate os z u th1 - mu * (off + rise os z u th1))
    (fun z => n2 * - box_bend os z - mu * (- box_bend os z * (th1 - z) - u)) thc th0) as (z & rz & eq).
  { intros z. apply (tilted (fun z => n2 * rate os z u th1)); [apply (derivable_pt_lim_scal (fun z => rate os z u th1)), rate_derivative_launch|apply rise_derivative_launch]. }
  destruct (mean_value (fun z => (n1 * z + n2 * rate os thc uc z) - mu * (off + rise os thc uc z))
    (fun z => (n1 + n2 * box_bend os z) - mu * rate os thc uc z) x1 th1) as (z1 & rz1 & eq1).
  { intros z1. apply (tilted (fun z => n1 * z + n2 * rate os thc uc z)); [|apply rise_derivative].
    apply (derivable_pt_lim_plus (fun z => n1 * z)); [|apply (derivable_pt_lim_scal (rate os thc uc)), rate_derivative].
    assert (D1 : derivable_pt_lim (fun z => n1 * z) z1 (n1 * 1)) by (apply (derivable_pt_lim_scal (fun z => z)), derivable_pt_lim_id).
    rewrite Rmult_1_r in D1. exact D1. }
  assert (hz : holds (T b_in) z) by exact (holds_between _ _ _ _ k1 k0 rz).
  assert (hz1 : holds X1 z1) by exact (holds_between _ _ _ _ hX1 hth rz1).
  destruct (proj1 seen_holds z hz) as [hs _].
  assert (hp : th0 - thc = grid q (lu N) * delta + grid q (wu N) * eta) by (unfold th0; rewrite x_phase; ring).
  assert (hu : u - uc = - e s * (grid q (lv N) * delta + grid q (wv N) * eta)) by (unfold u, launch_speed, uc; rewrite x_speed; ring).
  set (by_phase := n2 * - box_bend os z - mu * (- box_bend os z * (th1 - z) - u)) in *.
  set (by_speed := n2 - mu * (th1 - thc)).
  replace (n1 * th1 + n2 * rate os th0 u th1 + n0 - mu * (off + rise os th0 u th1)) with
    (n1 * x1 + n2 * rate os thc uc x1 + n0 - mu * (off + rise os thc uc x1)
      + (by_phase * grid q (lu N) + by_speed * (- e s * grid q (lv N))) * delta
      + (by_phase * grid q (wu N) + by_speed * (- e s * grid q (wv N))) * eta
      + (n1 + n2 * box_bend os z1 - mu * rate os thc uc z1) * (th1 - x1)).
  2:{ assert (r1 : rate os thc u th1 = rate os thc uc th1 + (u - uc)) by (unfold rate; ring).
      assert (r2 : rise os thc u th1 = rise os thc uc th1 + (u - uc) * (th1 - thc)) by (unfold rise; ring).
      rewrite r1, r2 in eq. cbv beta in eq1.
      replace (n1 * th1 + n2 * rate os th0 u th1 + n0 - mu * (off + rise os th0 u th1)) with
        (n1 * th1 + n0 + (n2 * rate os th0 u th1 - mu * (off + rise os th0 u th1))) by ring.
      rewrite eq, hp. replace (n1 * th1 + n0 + (n2 * (rate os thc uc th1 + (u - uc)) - mu * (off + (rise os thc uc th1 + (u - uc) * (th1 - thc))) +
        by_phase * (grid q (lu N) * delta + grid q (wu N) * eta))) with
        ((n1 * th1 + n2 * rate os thc uc th1 - mu * (off + rise os thc uc th1)) + n0 + by_speed * (u - uc) +
        by_phase * (grid q (lu N) * delta + grid q (wu N) * eta)) by (unfold by_speed; ring).
      rewrite eq1, hu. ring. }
  assert (ho := holds_offset gamma (side w * (gamma / 2)) th0 u thc uc p _ (holds_gamma param s described p) b_in inb w1). fold off in ho.
  assert (hrc := holds_rate_centre gamma _ th0 u thc uc os p OS hos b_in inb seen_ seen_holds p m X x1 hX).
  assert (hri := holds_rise_centre gamma _ th0 u thc uc os p OS hos b_in inb seen_ seen_holds m X x1 hX).
  assert (hrz := holds_rate_centre gamma _ th0 u thc uc os p OS hos b_in inb seen_ seen_holds p m X1 z1 hz1).
  assert (hbz := holds_box_bend p OS os hos m X1 z1 hz1).
  assert (hE := holds_neg _ _ holds_e). assert (hone := holds_one).
  assert (h4 := holds_pt p q (lu N)). assert (h5 := holds_pt p q (lv N)). assert (h6 := holds_pt p q (wu N)). assert (h7 := holds_pt p q (wv N)).
  unfold image, by_phase, by_speed. enclose.
Qed.
End Stretch.

Lemma grid_half_turns k : holds (mul p (whole p k) (mul p (whole p 2) (I.pi (F.PtoP p)))) (IZR k * (2 * PI)).
Proof. apply holds_mul; [apply holds_whole|]. apply holds_mul; [apply holds_whole|apply I.pi_correct]. Qed.
Lemma holds_area M : holds (area_over p q M) (area (frame_of q M)).
Proof.
  unfold area_over, area, frame_of. cbn [long wide fst snd].
  assert (h4 := holds_pt p q (lu M)). assert (h5 := holds_pt p q (lv M)). assert (h6 := holds_pt p q (wu M)). assert (h7 := holds_pt p q (wv M)). enclose.
Qed.
Lemma area_times_along M x : 0 < area (frame_of q M) -> along_area (frame_of q M) x = area (frame_of q M) * along (frame_of q M) x.
Proof. intros h. unfold along. field. lra. Qed.
Lemma area_times_across M x : 0 < area (frame_of q M) -> across_area (frame_of q M) x = area (frame_of q M) * across (frame_of q M) x.
Proof. intros h. unfold across. field. lra. Qed.

(* All flights of a stretch whose arrivals are checked: they are flights, depend on their starts continuously, and any linear function of their
   arrivals is enclosed, with the coordinate along from the middle of the stretch in D. *)
Lemma arrivals_sound (w w1 : wall) (N : chart) (a b : Z) (c : transit) (P := slice (frame_of q N) (grid q a) (grid q b))
  (box := launches p q param w N a b) (seen_ := look p OS box p) : check_arrivals p q param w1 N a b box seen_ c = true ->
  (0 < chart_area N)%Z /\ (forall x, P x -> flies s w w1 x) /\ continuous_on P (fly s w) /\
  forall x n1 n2 n0 N1 N2 N0 mu D, P x -> holds N1 n1 -> holds N2 n2 -> holds N0 n0 -> holds D (along (frame_of q N) x - (grid q a + grid q b) / 2) ->
    holds (arrived p q param w1 N box seen_ c mu D N1 N2 N0) (n1 * fst (fly s w x) + n2 * snd (fly s w x) + n0).
Proof.
  intros check. unfold check_arrivals in check. cbv zeta in check.
  set (n := near_mid c) in *. set (r := near_rad c) in *. set (lo := (n - r)%Z) in *. set (hi := (n + r)%Z) in *.
  split_checks.
  assert (o4 : (0 <= r)%Z) by (apply Z.leb_le; assumption). assert (areaN : (0 < chart_area N)%Z) by (apply Z.ltb_lt; assumption).
  assert (o5 : (wide_mid c - wide_rad c <= lo)%Z) by (apply Z.leb_le; assumption). assert (o6 : (hi <= wide_mid c + wide_rad c)%Z) by (apply Z.leb_le; assumption).
  set (leg := Leg p p q w1 (wide_mid c) (wide_rad c) 0 0 (go c) (come c) 0) in *.
  set (mid := (grid q a + grid q b) / 2). set (thc := grid q (cu N) + grid q (lu N) * mid).
  set (uc := - e s * (grid q (cv N) + grid q (lv N) * mid)).
  assert (hos : Forall2 knows OS os) by (apply holds_known; assumption).
  assert (inb : forall x, P x -> in_box gamma (side w * (gamma / 2)) (fst x) (launch_speed s x) thc uc box).
  { intros x hx. exact (launches_hold N areaN w a b x hx). }
  assert (seen_holds : forall x, P x -> seen thc os box seen_).
  { intros x hx. exact (look_seen _ _ _ _ _ _ _ p _ p box hos (inb x hx)). }
  (* All flights, and their arrivals in the wide bracket. *)
  assert (all : forall x, P x -> flies s w w1 x /\ (grid q (wide_mid c - wide_rad c) <= fst (fly s w x) <= grid q (wide_mid c + wide_rad c)) /\
    forall th, grid q (wide_mid c - wide_rad c) <= th <= grid q (wide_mid c + wide_rad c) -> 0 < side w1 * rate os (fst x) (launch_speed s x) th).
  { intros x hx. assert (inb' : in_box (d s / A s) (place (rebound s (impact_at s w x)) / A s) (phase s (since (rebound s (impact_at s w x))))
      (unit_speed s (speed (rebound s (impact_at s w x)))) thc uc box).
    { rewrite launch_speed_at, launch_place_at by assumption. cbn [since rebound]. rewrite phase_at by assumption. exact (inb x hx). }
    destruct (flight_sound param s described A_positive W_positive box leg _ thc uc inb' k3) as (i & reached & on & inside & _ & _ & towards).
    rewrite launch_speed_at in towards by assumption. cbn [since rebound] in towards. rewrite phase_at in towards by assumption.
    destruct (flies_to s A_positive W_positive gap_positive w w1 x i reached on) as [fl ->]. split; [exact fl|]. split; [exact inside|exact towards]. }
  assert (heights : forall x y, P x -> holds (image p q param box seen_ N w1 (whole p 0) (whole p 0) (whole p 0) (whole p (-1)) (turns q y) (pt y) (pt y) (whole p 0) (reach p q a b))
    (side w * (gamma / 2) - side w1 * (gamma / 2) + rise os (fst x) (launch_speed s x) (grid q y))).
  { intros x y hx.
    assert (z := image_holds N areaN w a b x hx seen_ (seen_holds x hx) w1 0 0 0 (-1) (whole p 0) (whole p 0) (whole p 0) (whole p (-1)) (turns q y)
      (grid q y) (grid q y) (pt y) (pt y) (whole p 0) (reach p q a b)).
    replace (side w * (gamma / 2) - side w1 * (gamma / 2) + rise os (fst x) (launch_speed s x) (grid q y)) with
      (0 * grid q y + 0 * rate os (fst x) (launch_speed s x) (grid q y) + 0 - -1 * (side w * (gamma / 2) - side w1 * (gamma / 2) + rise os (fst x) (launch_speed s x) (grid q y))) by ring.
    apply z; try apply holds_pt; try apply (holds_whole p); [|exact (holds_reach N a b x hx)].
    replace (grid q y - grid q y) with 0 by ring. apply (holds_whole p). }
  assert (grid q (wide_mid c - wide_rad c) <= grid q lo) by (apply grid_le; exact o5).
  assert (grid q hi <= grid q (wide_mid c + wide_rad c)) by (apply grid_le; exact o6).
  assert (grid q lo <= grid q hi) by (apply grid_le; unfold lo, hi; lia).
  assert (near : forall x, P x -> grid q lo <= fst (fly s w x) <= grid q hi).
  { intros x hx. destruct (all x hx) as (fl & inside & towards). assert (on := landing_height s A_positive W_positive w w1 x fl). unfold height in on. fold gamma os in on.
    assert (side2 : side w1 * side w1 = 1) by (destruct w1; cbn; ring).
    assert (up : forall y z, grid q (wide_mid c - wide_rad c) <= y -> y < z -> z <= grid q (wide_mid c + wide_rad c) ->
      side w1 * rise os (fst x) (launch_speed s x) y < side w1 * rise os (fst x) (launch_speed s x) z).
    { intros y z hy yz hz. apply (increasing (fun th => side w1 * rise os (fst x) (launch_speed s x) th) (fun th => side w1 * rate os (fst x) (launch_speed s x) th) y z yz).
      - intros t. apply (derivable_pt_lim_scal (rise os (fst x) (launch_speed s x))). apply rise_derivative.
      - intros t ht. apply towards. lra. }
    assert (low : 0 < - (side w1 * (side w * (gamma / 2) - side w1 * (gamma / 2) + rise os (fst x) (launch_speed s x) (grid q lo)))).
    { apply (is_positive_sound _ _ k4). apply holds_neg, holds_sided. exact (heights x lo hx). }
    assert (high : 0 <= side w1 * (side w * (gamma / 2) - side w1 * (gamma / 2) + rise os (fst x) (launch_speed s x) (grid q hi))).
    { apply (is_not_negative_sound _ _ check). apply holds_sided. exact (heights x hi hx). }
    set (T1 := fst (fly s w x)) in *.
    assert (at_wall : side w1 * (side w * (gamma / 2) - side w1 * (gamma / 2)) + side w1 * rise os (fst x) (launch_speed s x) T1 = 0).
    { replace (rise os (fst x) (launch_speed s x) T1) with (side w1 * (gamma / 2) - side w * (gamma / 2)) by lra. ring. }
    rewrite Rmult_plus_distr_l in low, high.
    split; apply Rnot_lt_le; intros lt.
    - assert (u1 := up T1 (grid q lo) ltac:(lra) lt ltac:(lra)). lra.
    - assert (u1 := up (grid q hi) T1 ltac:(lra) lt ltac:(lra)). lra. }
  split; [exact areaN|]. split; [intros x hx; apply (all x hx)|]. split.
  { apply (fly_continuous s A_positive W_positive P w w1 (grid q (wide_mid c - wide_rad c)) (grid q (wide_mid c + wide_rad c))).
    - intros x hx. apply (all x hx).
    - intros x hx. apply (all x hx).
    - intros x th hx. apply (all x hx). }
  intros x n1 n2 n0 N1 N2 N0 mu D hx h1 h2 h0 hD. assert (nr := near x hx). destruct (all x hx) as (fl & _).
  assert (on := landing_height s A_positive W_positive w w1 x fl). unfold height in on. fold gamma os in on.
  replace (n1 * fst (fly s w x) + n2 * snd (fly s w x) + n0) with (n1 * fst (fly s w x) + n2 * rate os (fst x) (launch_speed s x) (fst (fly s w x)) + n0
    - grid q mu * (side w * (gamma / 2) - side w1 * (gamma / 2) + rise os (fst x) (launch_speed s x) (fst (fly s w x)))).
  2:{ rewrite (landing_rate s A_positive W_positive w w1 x fl). fold os. replace (side w * (gamma / 2) - side w1 * (gamma / 2) + _) with 0 by lra. ring. }
  assert (c0 : grid q 0 = 0) by (unfold grid; ring).
  assert (r0 : 0 <= grid q r) by (rewrite <- c0; apply grid_le, o4).
  assert (minus : grid q lo = grid q n - grid q r) by (unfold lo, Z.sub; rewrite grid_plus, grid_opp; reflexivity).
  assert (plus : grid q hi = grid q n + grid q r) by (unfold hi; apply grid_plus).
  unfold arrived. cbv zeta. fold n r lo hi.
  apply (image_holds N areaN w a b x hx seen_ (seen_holds x hx) w1 n1 n2 n0 (grid q mu) N1 N2 N0 (pt mu) (turns q n) (grid q n)); try assumption.
  - apply holds_pt.
  - apply holds_pt.
  - apply (holds_stretch p q _ (unit_step_holds p q)). lra.
  - apply (holds_stretch p q _ (unit_step_holds p q)). exact nr.
  - apply (holds_stretch p q _ (unit_step_holds p q)). rewrite grid_opp. lra.
Qed.

(* Coordinates of a state, or of its mirror image, from enclosures of linear functions of it. *)
Section Coordinates.
Variables (K : I.type) (k : R) (mirror : bool) (M : chart) (image : I.type -> I.type -> I.type -> I.type) (y : state).
Hypothesis hK : holds K k.
Hypothesis M_area : (0 < chart_area M)%Z.
Hypothesis linear : forall n1 n2 n0 N1 N2 N0, holds N1 n1 -> holds N2 n2 -> holds N0 n0 -> holds (image N1 N2 N0) (n1 * fst y + n2 * snd y + n0).
Lemma along_of_holds : holds (along_of p q K mirror M image) (area (frame_of q M) * along (frame_of q M) (shifted k mirror y)).
Proof.
  rewrite <- area_times_along by (apply chart_area_positive, M_area). unfold along_of. cbv zeta.
  replace (along_area (frame_of q M) (shifted k mirror y)) with (grid q (wv M) * fst y + (if mirror then grid q (wu M) else - grid q (wu M)) * snd y
    + (grid q (wu M) * grid q (cv M) - grid q (wv M) * (grid q (cu M) + k)))
    by (unfold along_area, shifted; cbn [fst snd frame_of centre long wide]; destruct mirror; ring).
  assert (m1 := holds_pt p q (cu M)). assert (m2 := holds_pt p q (cv M)). assert (m5 := holds_pt p q (wu M)). assert (m6 := holds_pt p q (wv M)).
  apply linear; [enclose| |enclose]. destruct mirror; enclose.
Qed.
Lemma across_of_holds : holds (across_of p q K mirror M image) (area (frame_of q M) * across (frame_of q M) (shifted k mirror y)).
Proof.
  rewrite <- area_times_across by (apply chart_area_positive, M_area). unfold across_of. cbv zeta.
  replace (across_area (frame_of q M) (shifted k mirror y)) with (- grid q (lv M) * fst y + (if mirror then - grid q (lu M) else grid q (lu M)) * snd y
    + (grid q (lv M) * (grid q (cu M) + k) - grid q (lu M) * grid q (cv M)))
    by (unfold across_area, shifted; cbn [fst snd frame_of centre long wide]; destruct mirror; ring).
  assert (m1 := holds_pt p q (cu M)). assert (m2 := holds_pt p q (cv M)). assert (m3 := holds_pt p q (lu M)). assert (m4 := holds_pt p q (lv M)).
  apply linear; [enclose| |enclose]. destruct mirror; enclose.
Qed.
End Coordinates.

(* A number, over an area, is in [-1, 1], or beyond an end. *)
Lemma between_edges EDGE X M z : (0 < chart_area M)%Z -> holds EDGE (area (frame_of q M)) -> holds X (area (frame_of q M) * z) ->
  is_not_negative (sub p EDGE X) = true -> is_not_negative (add p EDGE X) = true -> -1 <= z <= 1.
Proof.
  intros pos edge hX k1 k2. apply (chart_area_positive q) in pos. set (m := area (frame_of q M)) in *.
  assert (0 <= m - m * z) by (apply (is_not_negative_sound _ _ k1); enclose). assert (0 <= m + m * z) by (apply (is_not_negative_sound _ _ k2); enclose).
  split; apply (Rmult_le_reg_l m); lra.
Qed.
Lemma before_end EDGE X M z : (0 < chart_area M)%Z -> holds EDGE (area (frame_of q M)) -> holds X (area (frame_of q M) * z) ->
  is_not_negative (I.neg (add p X EDGE)) = true -> z <= -1.
Proof.
  intros pos edge hX k1. apply (chart_area_positive q) in pos. set (m := area (frame_of q M)) in *.
  assert (0 <= - (m * z + m)) by (apply (is_not_negative_sound _ _ k1); enclose). apply (Rmult_le_reg_l m); lra.
Qed.
Lemma after_end EDGE X M z : (0 < chart_area M)%Z -> holds EDGE (area (frame_of q M)) -> holds X (area (frame_of q M) * z) ->
  is_not_negative (sub p X EDGE) = true -> 1 <= z.
Proof.
  intros pos edge hX k1. apply (chart_area_positive q) in pos. set (m := area (frame_of q M)) in *.
  assert (0 <= m * z - m) by (apply (is_not_negative_sound _ _ k1); enclose). apply (Rmult_le_reg_l m); lra.
Qed.
Lemma whole_unit : grid q (2 ^ Zpos q) = 1.
Proof. unfold grid. field. apply not_0_IZR. assert (0 < 2 ^ Zpos q)%Z by (apply Z.pow_pos_nonneg; lia). lia. Qed.

(* A start in the stretch of a link, with its image in the second parallelogram. *)
Definition held (h : hop_of) (N M : chart) (l : link) (x : state) : Prop :=
  slice (frame_of q N) (grid q (stretch_from l)) (grid q (stretch_to l)) x /\ in_frame (frame_of q M) (hop s h x).

Theorem link_sound h N M l : check_link p q param h N M l = true ->
  (forall x, held h N M l x -> in_frame (frame_of q N) x /\ flies s (off_wall h) (on_wall h) x) /\ carries (frame_of q N) (frame_of q M) (held h N M l) (hop s h).
Proof.
  intros check. unfold check_link in check. cbv zeta in check.
  set (w := off_wall h) in *. set (w1 := on_wall h) in *. set (a := stretch_from l) in *. set (b := stretch_to l) in *. set (c := transit_of l) in *.
  split_checks.
  assert (o1 : (- 2 ^ Zpos q <= a)%Z) by (apply Z.leb_le; assumption). assert (o2 : (a <= b)%Z) by (apply Z.leb_le; assumption).
  assert (o3 : (b <= 2 ^ Zpos q)%Z) by (apply Z.leb_le; assumption). assert (areaM : (0 < chart_area M)%Z) by (apply Z.ltb_lt; assumption).
  destruct (arrivals_sound w w1 N a b c k3) as (areaN & all & fly_on & landed).
  set (P := slice (frame_of q N) (grid q a) (grid q b)) in *. set (sign := if turned_over l then -1 else 1).
  assert (hK := grid_half_turns (turns_off h)). assert (edge := holds_area M).
  assert (same : forall x, hop s h x = shifted (IZR (turns_off h) * (2 * PI)) false (fly s w x)) by reflexivity.
  assert (crossed : forall x z, P x -> along (frame_of q N) x = z -> forall D, holds D (z - (grid q a + grid q b) / 2) ->
    holds (turn_over (turned_over l) (along_of p q (mul p (whole p (turns_off h)) (mul p (whole p 2) (I.pi (F.PtoP p)))) false M
      (arrived p q param w1 N (launches p q param w N a b) (look p OS (launches p q param w N a b) p) c (lean_along c) D)))
      (area (frame_of q M) * (sign * along (frame_of q M) (hop s h x)))).
  { intros x z hx <- D hD. rewrite same. replace (_ * (sign * _)) with (sign * (area (frame_of q M) * along (frame_of q M) (shifted (IZR (turns_off h) * (2 * PI)) false (fly s w x)))) by ring.
    assert (hA := along_of_holds _ _ false M _ (fly s w x) hK areaM (fun n1 n2 n0 N1 N2 N0 h1 h2 h0 => landed x n1 n2 n0 N1 N2 N0 (lean_along c) D hx h1 h2 h0 hD)).
    unfold turn_over, sign. destruct (turned_over l); [|rewrite Rmult_1_l; exact hA].
    set (y := area _ * _) in hA |- *. replace (-1 * y) with (- y) by ring. apply holds_neg, hA. }
  assert (ga := grid_le q _ _ o1). assert (gb := grid_le q _ _ o3). rewrite grid_opp, whole_unit in ga. rewrite whole_unit in gb.
  split; [intros x [hx _]; change (P x) in hx; split; [destruct hx as [[? ?] ?]; split; [split; lra|assumption]|exact (all x hx)]|].
  apply (covering _ _ (grid q a) (grid q b) sign).
  - lra.
  - apply grid_le, o2.
  - exact gb.
  - unfold sign. destruct (turned_over l); auto.
  - apply (on_comp P (fun _ => True) (fly s w) (turned (turns_off h))); [exact fly_on|apply turned_continuous|auto].
  - intros x hx. rewrite same. refine (between_edges _ _ M _ areaM edge (across_of_holds _ _ false M _ (fly s w x) hK areaM _) k4 k5).
    intros n1 n2 n0 N1 N2 N0 h1 h2 h0. exact (landed x n1 n2 n0 N1 N2 N0 _ _ hx h1 h2 h0 (holds_reach N a b x hx)).
  - intros x hx at_end. refine (before_end _ _ M _ areaM edge (crossed x _ hx at_end _ _) k6).
    replace (grid q a - (grid q a + grid q b) / 2) with (- ((grid q b - grid q a) / 2)) by field. apply holds_neg, holds_half.
  - intros x hx at_end. refine (after_end _ _ M _ areaM edge (crossed x _ hx at_end _ _) check).
    replace (grid q b - (grid q a + grid q b) / 2) with ((grid q b - grid q a) / 2) by field. apply holds_half.
Qed.

(* The starts that keep to a way. *)
Fixpoint keeps (word : list hop_of) (N : chart) (way : list (link * chart)) (x : state) : Prop :=
  match word, way with
  | h :: word, (l, M) :: way => held h N M l x /\ keeps word M way (hop s h x)
  | _, _ => True
  end.
Definition last_of (N : chart) (way : list (link * chart)) : chart := fold_left (fun _ step => snd step) way N.

Theorem way_sound word : forall N way, check_way p q param word N way = true ->
  carries (frame_of q N) (frame_of q (last_of N way)) (keeps word N way) (follow s word) /\
  forall x, keeps word N way x -> (word <> [] -> in_frame (frame_of q N) x) /\ flown s word x.
Proof.
  induction word as [|h word IH]; intros N [|[l M] way] check; cbn [check_way] in check; try discriminate.
  - split; [apply carries_nothing|]. intros x _. split; [congruence|exact I].
  - split_checks. destruct (link_sound h N M l k) as [flights carried]. destruct (IH M way check) as [rest walls]. split.
    + exact (carries_then _ _ _ _ _ _ _ carried rest).
    + intros x [here later]. destruct (flights x here) as [inside flight]. split; [intros _; exact inside|]. split; [exact flight|apply (walls _ later)].
Qed.
End Sound.
End Coverings.

Module PlainCoverings := Coverings PlainFloats.
