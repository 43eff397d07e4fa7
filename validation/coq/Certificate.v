(* Certificates of orbits, what they say, and a program that checks them, proved sound once and for all.

   `orbit_checked` (at the end) turns a run of `check` by Coq's own evaluator into a theorem about the model of Model.v:
   from the given start there is exactly one sequence of first contacts, it has the listed walls, and its times and
   velocities lie within the printed bounds.

   A leg of the certificate encloses one impact in phases and unit speeds (Step.v): th in [t - rt, t + rt],
   v/(A W) in [v - rv, v + rv], all in units of 2^-scale. Bounds in the launch are of mean-value form, with the entries
   of (A.7). *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig Float.Specific_ops Float.Specific_stdz Float.Specific_bigint.
From ImpactPair Require Import Model Step.
From ImpactPair Require Export Enclosure.
Open Scope R_scope.
Import ListNotations.

(* A, W, tau of a harmonic; of all, first the reference, with d and e. *)
Record tone := { amplitude : range; frequency : range; shift : range }.
Record data := { leading :> tone; further : list tone; gap : range; restitution : range }.
Definition describes_harmonic (p : tone) (h : harmonic) : Prop :=
  among (amplitude p) (A h) /\ among (frequency p) (W h) /\ among (shift p) (tau h).
Definition describes (p : data) (s : scene) : Prop :=
  describes_harmonic p s /\ Forall2 describes_harmonic (further p) (others s) /\ among (gap p) (d s) /\ among (restitution p) (e s).

(* An orbit starts with an impact, or inside the gap. *)
Inductive beginning := Struck (w : wall) (t v : range) | Inside (t y v : range).
Definition begins (b : beginning) (s : scene) (l : launch) : Prop :=
  match b with
  | Struck w t v => exists i, wall_of i = w /\ among t (time i) /\ among v (velocity i) /\ l = rebound s i
  | Inside t y v => among t (since l) /\ among y (place l) /\ among v (speed l)
  end.

(* What a certificate prints of an impact. *)
Record bounds := Impact { on : wall; time_lower : Q; time_upper : Q; velocity_lower : Q; velocity_upper : Q }.
Definition within (b : bounds) (i : impact) : Prop :=
  wall_of i = on b /\ Q2R (time_lower b) <= time i <= Q2R (time_upper b) /\
  Q2R (velocity_lower b) <= velocity i <= Q2R (velocity_upper b).

(* What a theorem about an orbit says. *)
Definition certified (s : scene) (l : launch) (printed : list bounds) : Prop :=
  exists orbit, follows s l orbit /\ Forall2 within printed orbit /\
    forall other, follows s l other -> length other = length orbit -> other = orbit.

(* How it is checked. A leg holds the box of its impact and where the flight that ends there is cut: departure before
   `depart`, middle up to `approach`, then arrival; `tilt` is about y'' over the velocity of arrival. *)
Record leg := Leg {
  bits : positive; coarse : positive; scale : positive; hits : wall;
  t : Z; rt : Z; v : Z; rv : Z; depart : Z; approach : Z; tilt : Z }.

(* The box of the beginning; from inside the gap its velocity is that of the launch. *)
Record start := Start { start_bits : positive; start_scale : positive; start_t : Z; start_rt : Z; start_v : Z; start_rv : Z }.

(* Cuts [a, b] in halves until `test` holds on all parts. *)
Fixpoint sweep (test : Z -> Z -> bool) (depth : nat) (a b : Z) : bool :=
  if test a b then true else
  match depth with
  | O => false
  | S k => let m := Z.div2 (a + b) in
    if ((a <? m) && (m <? b))%Z then (if sweep test k a m then sweep test k m b else false) else false
  end.

Lemma sweep_sound q test (P : R -> Prop) : (forall a b, test a b = true -> forall x, grid q a <= x <= grid q b -> P x) ->
  forall depth a b, sweep test depth a b = true -> forall x, grid q a <= x <= grid q b -> P x.
Proof.
  intros sound depth. induction depth as [|k IH]; intros a b h x r; cbn [sweep] in h.
  - destruct (test a b) eqn:c; [exact (sound a b c x r)|discriminate].
  - destruct (test a b) eqn:c; [exact (sound a b c x r)|].
    destruct (((a <? Z.div2 (a + b)) && (Z.div2 (a + b) <? b))%Z); [|discriminate].
    destruct (sweep test k a (Z.div2 (a + b))) eqn:l; [|discriminate].
    destruct (Rle_lt_dec x (grid q (Z.div2 (a + b)))); [apply (IH _ _ l)|apply (IH _ _ h)]; lra.
Qed.

Lemma mean_value f f' a b : (forall c, derivable_pt_lim f c (f' c)) ->
  exists c, Rmin a b <= c <= Rmax a b /\ f b = f a + f' c * (b - a).
Proof.
  intros D. destruct (MVT_gen f a b f') as (c & r & eq).
  - intros x _. apply is_derive_Reals, D.
  - intros x _. apply derivable_continuous_pt. exists (f' x). apply D.
  - exists c. split; [exact r|lra].
Qed.

Lemma tilted f f' g g' mu off z : derivable_pt_lim f z f' -> derivable_pt_lim g z g' ->
  derivable_pt_lim (fun x => f x - mu * (off + g x)) z (f' - mu * g').
Proof.
  intros F' G'. apply (derivable_pt_lim_minus f (fun x => mu * (off + g x))); [exact F'|].
  apply (derivable_pt_lim_scal (fun x => off + g x)). replace g' with (0 + g') by ring.
  apply (derivable_pt_lim_plus (fun _ => off)); [apply derivable_pt_lim_const|exact G'].
Qed.

(* Checks with interval arithmetic on floats F; two instances at the end. *)
Module Checker (F : FloatOps with Definition sensible_format := true).
Include Enclosure F.
Local Opaque add sub mul quotient whole hull sine cosine.

(* The set of launches of a leg: from a wall, or from anywhere in the gap; th0 and u each in an interval, with a centre. *)
Record box := Box {
  from : option wall; somewhere : I.type; around : Z; lowest : Z; box_scale : positive;
  T : I.type; Tc : I.type; dT : I.type; U : I.type; Uc : I.type; dU : I.type }.

(* A harmonic in the units of the reference. *)
Record known := { Share : I.type; Ratio : I.type; Lag : I.type }.
Definition knows (O : known) (o : companion) : Prop := holds (Share O) (share o) /\ holds (Ratio O) (ratio o) /\ holds (Lag O) (lag o).

(* E, E' and -E'' of the box near m quarter turns of the reference; the others turn as their phases say. *)
Section Excitation.
Variable p : positive.
Variables (OS : list known) (os : list companion).
Hypothesis OS_holds : Forall2 knows OS os.
Definition total (first : I.type) (term : known -> Z -> I.type -> I.type) (X : I.type) : I.type :=
  fold_right (fun O rest => let P := add p (mul p (Ratio O) X) (Lag O) in add p rest (term O (turns_in p P) P)) first OS.
Definition box_at_over (m : Z) (X : I.type) : I.type := total (sine p m X) (fun O k P => mul p (Share O) (sine p k P)) X.
Definition box_rate_over (m : Z) (X : I.type) : I.type :=
  total (cosine p m X) (fun O k P => mul p (mul p (Share O) (Ratio O)) (cosine p k P)) X.
Definition box_bend_over (m : Z) (X : I.type) : I.type :=
  total (sine p m X) (fun O k P => mul p (mul p (mul p (Share O) (Ratio O)) (Ratio O)) (sine p k P)) X.
Definition box_jerk_over (m : Z) (X : I.type) : I.type :=
  total (cosine p m X) (fun O k P => mul p (mul p (mul p (mul p (Share O) (Ratio O)) (Ratio O)) (Ratio O)) (cosine p k P)) X.

Lemma holds_total first f term part X x : holds first f -> holds X x ->
  (forall O o k P, knows O o -> holds P (companion_phase o x) -> holds (term O k P) (part o)) ->
  holds (total first term X) (sum f part os).
Proof.
  intros hf hx each. unfold total, sum. induction OS_holds as [|O o OS' os' k rest IH]; cbn [fold_right]; [exact hf|].
  apply holds_add; [exact (IH rest)|]. apply each; [exact k|]. destruct k as (_ & hr & hl). unfold companion_phase. enclose.
Qed.
Lemma holds_box_at m X x : holds X x -> holds (box_at_over m X) (box_at os x).
Proof. intros h. refine (holds_total _ _ _ _ _ x _ h _); [enclose|]. intros O o k P (hs & hr & hl) hp. enclose. Qed.
Lemma holds_box_rate m X x : holds X x -> holds (box_rate_over m X) (box_rate os x).
Proof. intros h. refine (holds_total _ _ _ _ _ x _ h _); [enclose|]. intros O o k P (hs & hr & hl) hp. enclose. Qed.
Lemma holds_box_bend m X x : holds X x -> holds (box_bend_over m X) (box_bend os x).
Proof. intros h. refine (holds_total _ _ _ _ _ x _ h _); [enclose|]. intros O o k P (hs & hr & hl) hp. enclose. Qed.
Lemma holds_box_jerk m X x : holds X x -> holds (box_jerk_over m X) (box_jerk os x).
Proof. intros h. refine (holds_total _ _ _ _ _ x _ h _); [enclose|]. intros O o k P (hs & hr & hl) hp. enclose. Qed.
End Excitation.

Section Flight.
(* d/A and the launch: place over A, phase, velocity over A W; the centre of its box; the other harmonics. *)
Variables (gamma y th0 u thc uc : R) (os : list companion).

Definition in_box (b : box) : Prop :=
  match from b with Some w => y = side w * (gamma / 2) | None => holds (somewhere b) y end /\
  holds (T b) th0 /\ holds (T b) thc /\ holds (Tc b) thc /\ holds (dT b) (th0 - thc) /\
  holds (U b) u /\ holds (Uc b) uc /\ holds (dU b) (u - uc).

Section Precision.
Variable p : positive.
Variable OS : list known.
Hypothesis OS_holds : Forall2 knows OS os.
Variable G : I.type.
Hypothesis G_holds : holds G gamma.
Variable b : box.
Hypothesis b_holds : in_box b.

(* -E'' and E' of the box at th0, where precision c is enough, and E and E' at its centre. *)
Variable c : positive.
Record aspects := { Bend0 : I.type; Rate0 : I.type; Atc : I.type; Ratec : I.type }.
Definition look : aspects :=
  {| Bend0 := box_bend_over c OS (around b) (T b); Rate0 := box_rate_over c OS (around b) (T b);
     Atc := box_at_over p OS (around b) (Tc b); Ratec := box_rate_over p OS (around b) (Tc b) |}.
Variable a : aspects.
Definition seen : Prop := (forall x, holds (T b) x -> holds (Bend0 a) (box_bend os x) /\ holds (Rate0 a) (box_rate os x)) /\
  holds (Atc a) (box_at os thc) /\ holds (Ratec a) (box_rate os thc).
Hypothesis a_holds : seen.

(* y - side w gamma / 2: from the wall itself exactly 0. *)
Definition offset (w : wall) : I.type :=
  match from b, w with
  | Some left, left | Some right, right => whole p 0
  | Some left, right => I.neg G
  | Some right, left => G
  | None, _ => sub p (somewhere b) (sided w (quotient p G (whole p 2)))
  end.
Lemma holds_offset w : holds (offset w) (y - side w * (gamma / 2)).
Proof.
  destruct b_holds as [h _]. unfold offset. destruct (from b) as [[|]|], w; cbn [side sided] in h |- *; try rewrite h.
  - replace (_ - _) with 0 by field. apply holds_whole.
  - replace (_ - _) with (- gamma) by field. enclose.
  - replace (_ - _) with gamma by field. exact G_holds.
  - replace (_ - _) with 0 by field. apply holds_whole.
  - apply holds_sub; [exact h|]. apply (holds_sided left). enclose.
  - apply holds_sub; [exact h|]. apply (holds_sided right). enclose.
Qed.

Variable q : positive.
Variable step : I.type.
Hypothesis step_holds : holds step (/ IZR (2 ^ Zpos q)).
Let at_ := point p step.
Let over := stretch p step.
Lemma at_holds n : holds (at_ n) (grid q n).
Proof. apply holds_point, step_holds. Qed.
Lemma over_holds i j x : grid q i <= x <= grid q j -> holds (over i j) x.
Proof. apply holds_stretch, step_holds. Qed.

(* The velocity over a stretch, and the displacement since launch at a point and over a stretch. *)
Definition rate_over (m : Z) (X : I.type) : I.type := sub p (add p (U b) (Rate0 a)) (box_rate_over p OS m X).
Definition rise_centre (m : Z) (X : I.type) : I.type :=
  add p (sub p (Atc a) (box_at_over p OS m X)) (mul p (add p (Uc b) (Ratec a)) (sub p X (Tc b))).
Definition rise_at (n : Z) : I.type :=
  let X := at_ n in
  add p (add p (rise_centre (turns q n) X) (mul p (sub p (mul p (I.neg (Bend0 a)) (sub p X (T b))) (U b)) (dT b)))
        (mul p (sub p X (Tc b)) (dU b)).
Definition rise_over (i j : Z) : I.type :=
  let m := Z.div2 (i + j) in let X := over i j in
  add p (rise_at m) (mul p (rate_over (turns q m) X) (sub p X (at_ m))).

Lemma holds_rate m X x : holds X x -> holds (rate_over m X) (rate os th0 u x).
Proof. destruct b_holds as (_ & h0 & _ & _ & _ & hu & _), a_holds as (h & _). intros hx. assert (hr := holds_box_rate p _ _ OS_holds m _ _ hx). unfold rate_over, rate. destruct (h _ h0). enclose. Qed.
Lemma holds_rise_centre m X x : holds X x -> holds (rise_centre m X) (rise os thc uc x).
Proof.
  destruct b_holds as (_ & _ & _ & hc & _ & _ & hu & _), a_holds as (_ & h & h'). intros hx. assert (ha := holds_box_at p _ _ OS_holds m _ _ hx).
  unfold rise_centre, rise. enclose.
Qed.
Lemma holds_rise_at n : holds (rise_at n) (rise os th0 u (grid q n)).
Proof.
  set (x := grid q n). destruct b_holds as (_ & h0 & h1 & hc & hd & hu & huc & hdu).
  destruct (mean_value (fun z => rise os z u x) (fun z => - box_bend os z * (x - z) - u) thc th0) as (z & r & eq).
  { intros z. apply rise_derivative_launch. }
  assert (hz : holds (T b) z) by exact (holds_between _ _ _ _ h1 h0 r).
  destruct (proj1 a_holds z hz) as [hs _].
  replace (rise os th0 u x) with (rise os thc uc x + (- box_bend os z * (x - z) - u) * (th0 - thc) + (x - thc) * (u - uc)).
  2:{ rewrite eq. unfold rise. ring. }
  assert (hx := at_holds n). fold x in hx.
  assert (hr := holds_rise_centre (turns q n) _ _ hx). unfold rise_at. enclose.
Qed.
Lemma holds_rise_over i j x : (i <= j)%Z -> grid q i <= x <= grid q j -> holds (rise_over i j) (rise os th0 u x).
Proof.
  intros o r. unfold rise_over. set (m := Z.div2 (i + j)).
  assert (im : grid q i <= grid q m <= grid q j).
  { unfold m. rewrite Z.div2_div. split; apply grid_le; [apply Z.div_le_lower_bound|apply Z.div_le_upper_bound]; lia. }
  destruct (mean_value (rise os th0 u) (rate os th0 u) (grid q m) x (rise_derivative os th0 u)) as (z & rz & ->).
  assert (hz : holds (over i j) z).
  { apply over_holds. split; [apply Rle_trans with (2 := proj1 rz); apply Rmin_glb|apply Rle_trans with (1 := proj2 rz); apply Rmax_lub]; lra. }
  assert (hx := over_holds i j x r). assert (hm := at_holds m). assert (hr := holds_rise_at m).
  assert (hv := holds_rate (turns q m) _ _ hz). enclose.
Qed.

(* The tests of Step.v's conditions. *)
Definition inwards_over (w : wall) (i j : Z) : bool :=
  is_positive (I.neg (sided w (rate_over (turns q (Z.div2 (i + j))) (over i j)))).
Definition pressed_over (w : wall) (i j : Z) : bool :=
  is_positive (I.neg (sided w (box_bend_over p OS (turns q (Z.div2 (i + j))) (over i j)))).
Definition inside_over (i j : Z) : bool :=
  let r := rise_over i j in
  if (i <=? j)%Z then if is_positive (add p (offset left) r) then is_positive (I.neg (add p (offset right) r)) else false else false.

Lemma inwards_sound w i j : inwards_over w i j = true -> forall x, grid q i <= x <= grid q j -> 0 < - side w * rate os th0 u x.
Proof.
  intros h x r. replace (- side w * rate os th0 u x) with (- (side w * rate os th0 u x)) by ring.
  apply (is_positive_sound _ _ h), holds_neg, holds_sided, holds_rate, over_holds, r.
Qed.
Lemma pressed_sound w i j : pressed_over w i j = true -> forall x, grid q i <= x <= grid q j -> 0 < - side w * box_bend os x.
Proof.
  intros h x r. replace (- side w * box_bend os x) with (- (side w * box_bend os x)) by ring.
  apply (is_positive_sound _ _ h), holds_neg, holds_sided, (holds_box_bend p _ _ OS_holds), over_holds, r.
Qed.
Lemma inside_sound i j : inside_over i j = true -> forall x, grid q i <= x <= grid q j -> Rabs (y + rise os th0 u x) < gamma / 2.
Proof.
  unfold inside_over. intros h x r. destruct (Z.leb_spec i j) as [o|]; [|discriminate].
  destruct (is_positive (add p (offset left) (rise_over i j))) eqn:l; [|discriminate].
  assert (hr := holds_rise_over i j x o r).
  assert (0 < - (y - side right * (gamma / 2) + rise os th0 u x)).
  { apply (is_positive_sound _ _ h), holds_neg, holds_add; [apply holds_offset|exact hr]. }
  assert (0 < y - side left * (gamma / 2) + rise os th0 u x).
  { apply (is_positive_sound _ _ l), holds_add; [apply holds_offset|exact hr]. }
  cbn in *. apply Rabs_def1; lra.
Qed.

(* Velocity of arrival at w between lo and hi, around n: its value where wall and flight meet is that of
   rate - tilt * (distance from the wall), which hardly depends on the phase of arrival. *)
Definition rate_centre (k : positive) (m : Z) (X : I.type) : I.type := sub p (add p (Uc b) (Ratec a)) (box_rate_over k OS m X).
Definition arrival (w : wall) (n r k : Z) : I.type :=
  let m := turns q n in let X := at_ n in let X1 := over (n - r) (n + r) in let mu := at_ k in
  (* rate - tilt * (distance), with the launch's velocity once: it may be an interval. *)
  let turned := mul p (add p (Uc b) (Ratec a)) (sub p (whole p 1) (mul p mu (sub p X (Tc b)))) in
  let height := add p (offset w) (sub p (Atc a) (box_at_over p OS m X)) in
  let centre := sub p (sub p turned (box_rate_over p OS m X)) (mul p mu height) in
  let by_phase := sub p (I.neg (Bend0 a)) (mul p mu (sub p (mul p (I.neg (Bend0 a)) (sub p X1 (T b))) (U b))) in
  let by_speed := sub p (whole p 1) (mul p mu (sub p X1 (Tc b))) in
  let by_arrival := sub p (box_bend_over c OS m X1) (mul p mu (rate_centre c m X1)) in
  add p (add p (add p centre (mul p by_phase (dT b))) (mul p by_speed (dU b))) (mul p by_arrival (over (- r) r)).

Lemma holds_rate_centre k m X x : holds X x -> holds (rate_centre k m X) (rate os thc uc x).
Proof.
  destruct b_holds as (_ & _ & _ & _ & _ & _ & hu & _), a_holds as (_ & _ & h).
  intros hx. assert (hr := holds_box_rate k _ _ OS_holds m _ _ hx). unfold rate_centre, rate. enclose.
Qed.

Lemma grid_plus i j : grid q (i + j) = grid q i + grid q j.
Proof. unfold grid. rewrite plus_IZR. ring. Qed.
Lemma grid_opp i : grid q (- i) = - grid q i.
Proof. unfold grid. rewrite opp_IZR. ring. Qed.

Lemma holds_arrival w n r k th1 : (0 <= r)%Z -> grid q (n - r) <= th1 <= grid q (n + r) ->
  y + rise os th0 u th1 = side w * (gamma / 2) -> holds (arrival w n r k) (rate os th0 u th1).
Proof.
  intros r0 r1 on. destruct b_holds as (_ & h0 & h1 & hc & hd & hu & huc & hdu).
  set (mu := grid q k). set (x := grid q n). set (off := y - side w * (gamma / 2)).
  destruct (mean_value (fun z => rate os z u th1 - mu * (off + rise os z u th1))
    (fun z => - box_bend os z - mu * (- box_bend os z * (th1 - z) - u)) thc th0) as (z & rz & eq).
  { intros z. apply tilted; [apply rate_derivative_launch|apply rise_derivative_launch]. }
  destruct (mean_value (fun z => rate os thc uc z - mu * (off + rise os thc uc z))
    (fun z => box_bend os z - mu * rate os thc uc z) x th1) as (z1 & rz1 & eq1).
  { intros z1. apply tilted; [apply rate_derivative|apply rise_derivative]. }
  assert (hz : holds (T b) z) by exact (holds_between _ _ _ _ h1 h0 rz).
  destruct (proj1 a_holds z hz) as [hs _].
  assert (hx1 := over_holds _ _ _ r1).
  assert (gr : 0 <= grid q r). { replace 0 with (grid q 0) by (unfold grid; ring). apply grid_le, r0. }
  assert (minus : grid q (n - r) = x - grid q r) by (unfold Z.sub; rewrite grid_plus, grid_opp; reflexivity).
  assert (plus : grid q (n + r) = x + grid q r) by apply grid_plus.
  assert (hz1 : holds (over (n - r) (n + r)) z1).
  { apply over_holds. rewrite minus, plus in *.
    split; [apply Rle_trans with (2 := proj1 rz1); apply Rmin_glb|apply Rle_trans with (1 := proj2 rz1); apply Rmax_lub]; lra. }
  assert (hd1 : holds (over (- r) r) (th1 - x)) by (apply over_holds; rewrite grid_opp; lra).
  replace (rate os th0 u th1) with (((uc + box_rate os thc) * (1 - mu * (x - thc)) - box_rate os x - mu * (off + (box_at os thc - box_at os x)))
    + (- box_bend os z - mu * (- box_bend os z * (th1 - z) - u)) * (th0 - thc)
    + (1 - mu * (th1 - thc)) * (u - uc) + (box_bend os z1 - mu * rate os thc uc z1) * (th1 - x)).
  2:{ assert (zero : off + rise os th0 u th1 = 0) by (unfold off; lra). rewrite zero in eq.
      replace (rate os thc u th1) with (rate os thc uc th1 + (u - uc)) in eq by (unfold rate; ring).
      replace (rise os thc u th1) with (rise os thc uc th1 + (u - uc) * (th1 - thc)) in eq by (unfold rise; ring).
      replace ((uc + box_rate os thc) * (1 - mu * (x - thc)) - box_rate os x - mu * (off + (box_at os thc - box_at os x)))
        with (rate os thc uc x - mu * (off + rise os thc uc x)) by (unfold rate, rise; ring). lra. }
  assert (hx := at_holds n). assert (hk := at_holds k). assert (ho := holds_offset w).
  destruct a_holds as (_ & hac & hrc). assert (hax := holds_box_at p _ _ OS_holds (turns q n) _ _ hx).
  assert (hrx := holds_box_rate p _ _ OS_holds (turns q n) _ _ hx).
  assert (hrz := holds_rate_centre c (turns q n) _ _ hz1).
  assert (hbz := holds_box_bend c _ _ OS_holds (turns q n) _ _ hz1).
  assert (one : holds (whole p 1) 1) by apply holds_whole.
  unfold arrival. fold x in hx, hax, hrx. fold mu in hk. fold off in ho. enclose.
Qed.
End Precision.
End Flight.

Lemma look_seen gamma y th0 u thc uc os p OS c b : Forall2 knows OS os -> in_box gamma y th0 u thc uc b -> seen thc os b (look p OS b c).
Proof.
  intros hos (_ & _ & _ & hc & _). unfold seen, look. cbn [Bend0 Rate0 Atc Ratec].
  split; [intros x hx; split|split]; auto using holds_box_at, holds_box_rate, holds_box_bend.
Qed.

(* The launches after an impact on w, from a box of phase and velocity. *)
Definition landing (p : positive) (E : I.type) (w : wall) (q : positive) (t rt v rv : Z) : box :=
  let step := unit_step p q in
  {| from := Some w; somewhere := whole p 0; around := turns q t; lowest := t - rt; box_scale := q;
     T := stretch p step (t - rt) (t + rt); Tc := point p step t; dT := stretch p step (- rt) rt;
     U := mul p (I.neg E) (stretch p step (v - rv) (v + rv)); Uc := mul p (I.neg E) (point p step v);
     dU := mul p (I.neg E) (stretch p step (- rv) rv) |}.
(* The launches from inside the gap at a place in Y. *)
Definition midway (p : positive) (Y : I.type) (q : positive) (t rt v rv : Z) : box :=
  let step := unit_step p q in
  {| from := None; somewhere := Y; around := turns q t; lowest := t - rt; box_scale := q;
     T := stretch p step (t - rt) (t + rt); Tc := point p step t; dT := stretch p step (- rt) rt;
     U := stretch p step (v - rv) (v + rv); Uc := point p step v; dU := stretch p step (- rv) rv |}.

Lemma from_centre p q n r x : (0 <= r)%Z -> grid q (n - r) <= x <= grid q (n + r) ->
  holds (stretch p (unit_step p q) (n - r) (n + r)) x /\ holds (stretch p (unit_step p q) (n - r) (n + r)) (grid q n) /\
  holds (point p (unit_step p q) n) (grid q n) /\ holds (stretch p (unit_step p q) (- r) r) (x - grid q n).
Proof.
  intros r0 h. unfold Z.sub in *. rewrite !grid_plus, !grid_opp in h.
  assert (0 <= grid q r). { replace 0 with (grid q 0) by (unfold grid; ring). apply grid_le, r0. }
  assert (st := unit_step_holds p q).
  repeat split; try (apply (holds_stretch p q _ st); rewrite ?grid_plus, ?grid_opp; lra). apply (holds_point p q _ st).
Qed.

Lemma landing_in p E w q t rt v rv gamma e th w' : (0 <= rt)%Z -> (0 <= rv)%Z -> holds E e ->
  grid q (t - rt) <= th <= grid q (t + rt) -> grid q (v - rv) <= w' <= grid q (v + rv) ->
  in_box gamma (side w * (gamma / 2)) th (- e * w') (grid q t) (- e * grid q v) (landing p E w q t rt v rv).
Proof.
  intros a1 a2 he h1 h2. destruct (from_centre p q t rt th a1 h1) as (b1 & b2 & b3 & b4).
  destruct (from_centre p q v rv w' a2 h2) as (c1 & c2 & c3 & c4). unfold in_box, landing. cbn [from somewhere T Tc dT U Uc dU].
  split; [reflexivity|]. repeat (split; [assumption|]).
  replace (- e * w' - - e * grid q v) with (- e * (w' - grid q v)) by ring. split; [|split]; enclose.
Qed.
Lemma midway_in p Y q t rt v rv gamma y th u : (0 <= rt)%Z -> (0 <= rv)%Z -> holds Y y ->
  grid q (t - rt) <= th <= grid q (t + rt) -> grid q (v - rv) <= u <= grid q (v + rv) ->
  in_box gamma y th u (grid q t) (grid q v) (midway p Y q t rt v rv).
Proof.
  intros a1 a2 hy h1 h2. destruct (from_centre p q t rt th a1 h1) as (b1 & b2 & b3 & b4).
  destruct (from_centre p q v rv u a2 h2) as (c1 & c2 & c3 & c4). unfold in_box, midway. cbn [from somewhere T Tc dT U Uc dU].
  repeat (split; [assumption|]). assumption.
Qed.

Definition opposite (w : wall) : wall := match w with left => right | right => left end.
Definition depth : nat := 40.
Notation "a &? b" := (if a then b else false) (at level 45, right associativity).

Ltac split_checks := repeat match goal with
  | h : (if ?c then _ else false) = true |- _ => let k := fresh "k" in destruct c eqn:k; [|discriminate h] end.

(* X lies between L and H; and between the grid points lo and hi. *)
Definition bounded (p : positive) (L X H : I.type) : bool := is_not_negative (sub p X L) &? is_not_negative (sub p H X).
Definition between (p : positive) (step X : I.type) (lo hi : Z) : bool := bounded p (point p step lo) X (point p step hi).
Lemma bounded_sound p L X H l x h : bounded p L X H = true -> holds L l -> holds X x -> holds H h -> l <= x <= h.
Proof.
  unfold bounded. intros check hL hX hH. split_checks.
  assert (0 <= x - l) by (apply (is_not_negative_sound _ _ k); enclose).
  assert (0 <= h - x) by (apply (is_not_negative_sound _ _ check); enclose). lra.
Qed.
Lemma between_sound p q X x lo hi : between p (unit_step p q) X lo hi = true -> holds X x -> grid q lo <= x <= grid q hi.
Proof. intros check hX. assert (st := unit_step_holds p q). apply (bounded_sound _ _ _ _ _ _ _ check); [enclose|exact hX|enclose]. Qed.

Section Data.
Variable param : data.

Definition gamma_in (p : positive) : I.type := quotient p (enclose_range p (gap param)) (enclose_range p (amplitude param)).

(* A harmonic in the units of the reference. *)
Definition known_of (p : positive) (x : tone) : known :=
  let ratio := quotient p (enclose_range p (frequency x)) (enclose_range p (frequency param)) in
  {| Share := quotient p (enclose_range p (amplitude x)) (enclose_range p (amplitude param)); Ratio := ratio;
     Lag := sub p (enclose_range p (shift x)) (mul p ratio (enclose_range p (shift param))) |}.
Definition known_in (p : positive) : list known := map (known_of p) (further param).

(* The departure from wall w, or from nowhere. *)
Definition check_departure (OS : list known) (b : box) (l : leg) : bool :=
  let c := coarse l in let q := scale l in let p := bits l in
  let step := unit_step p q in let rough := unit_step c q in
  match from b with
  | None => is_not_negative (sub p (T b) (point p step (depart l))) &? is_not_negative (sub p (point p step (approach l)) (T b))
  | Some w => let low := (lowest b * 2 ^ Zpos q / 2 ^ Zpos (box_scale b) - 1)%Z in let a := look c OS b c in
    is_not_negative (sub p (point p step (depart l)) (T b)) &? is_not_negative (sub p (T b) (point p step low)) &?
    (if sweep (inwards_over c OS b a q rough w) depth low (depart l) then true
     else is_not_negative (I.neg (sided w (U b))) &? sweep (pressed_over c OS q rough w) depth low (depart l))
  end.

(* The flight of all launches of a box, once they have departed: its first contact is on the leg's wall, in the leg's bracket of phases. *)
Definition check_course (b : box) (l : leg) : bool :=
  let p := bits l in let c := coarse l in let q := scale l in let w := hits l in let OS := known_in p in
  let G := gamma_in p in let step := unit_step p q in let rough := unit_step c q in
  let a := look p OS b c in let ac := look c OS b c in let lo := (t l - rt l)%Z in let hi := (t l + rt l)%Z in
  (0 <=? rt l)%Z &? (depart l <=? approach l)%Z &? (approach l <=? lo)%Z &?
  is_positive (sub p (point p step lo) (T b)) &?
  sweep (inside_over c OS (gamma_in c) b ac q rough) depth (depart l) (approach l) &?
  sweep (inwards_over c OS b ac q rough (opposite w)) depth (approach l) hi &?
  is_positive (I.neg (sided w (add p (offset p G b w) (rise_at p OS b a q step lo)))) &?
  is_not_negative (sided w (add p (offset p G b w) (rise_at p OS b a q step hi))).
Definition check_flight (b : box) (l : leg) : bool := check_departure (known_in (bits l)) b l &? check_course b l.

(* The phase at a time, and velocities of unit speeds. *)
Definition phase_over (p : positive) (time : I.type) : I.type :=
  add p (mul p (enclose_range p (frequency param)) time) (enclose_range p (shift param)).
Definition velocity_over (p : positive) (speed : I.type) : I.type :=
  mul p (mul p (enclose_range p (amplitude param)) (enclose_range p (frequency param))) speed.

(* What is printed holds all phases and unit speeds between grid points. *)
Definition check_shown (p : positive) (step : I.type) (lo hi slow fast : Z) (printed : bounds) : bool :=
  let TH := stretch p step lo hi in let V := velocity_over p (stretch p step slow fast) in
  let known r := enclose p (Rational r) in
  bounded p (phase_over p (known (time_lower printed))) TH (phase_over p (known (time_upper printed))) &?
  bounded p (known (velocity_lower printed)) V (known (velocity_upper printed)).

(* Its velocity on arrival; and all that is printed of it. *)
Definition check_arrival (b : box) (l : leg) (printed : bounds) : bool :=
  let p := bits l in let c := coarse l in let q := scale l in let w := hits l in let OS := known_in p in
  let step := unit_step p q in let a := look p OS b c in let lo := (t l - rt l)%Z in let hi := (t l + rt l)%Z in
  (0 <=? rv l)%Z &?
  between p step (arrival p OS (gamma_in p) b c a q step w (t l) (rt l) (tilt l)) (v l - rv l) (v l + rv l) &?
  match w, on printed with left, left | right, right => true | _, _ => false end &?
  check_shown p step lo hi (v l - rv l) (v l + rv l) printed.
Definition check_leg (b : box) (l : leg) (printed : bounds) : bool := check_flight b l &? check_arrival b l printed.
Definition landed (l : leg) : box :=
  landing (bits l) (enclose_range (bits l) (restitution param)) (hits l) (scale l) (t l) (rt l) (v l) (rv l).

Fixpoint check_legs (b : box) (legs : list leg) (printed : list bounds) : bool :=
  match legs, printed with
  | [], [] => true
  | l :: legs, i :: printed => check_leg b l i &? check_legs (landed l) legs printed
  | _, _ => false
  end.

Variable s : scene.
Hypothesis described : describes param s.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.

Lemma holds_gamma p : holds (gamma_in p) (d s / A s).
Proof. destruct described as ((a & _) & _ & g & _). apply holds_quotient; apply holds_range; assumption. Qed.

Lemma holds_known p : Forall2 knows (known_in p) (companions s).
Proof.
  destruct described as ((hA & hW & ht) & others & _). unfold known_in, companions. induction others as [|x h xs hs (a & w & t) rest IH]; [constructor|].
  cbn [map]. constructor; [|exact IH]. unfold knows, known_of, companion_of. cbn [Share Ratio Lag share ratio lag].
  apply (holds_range p) in hA, hW, ht, a, w, t. split; [|split]; enclose.
Qed.

(* A launch of the model is in a box. *)
Definition launched (b : box) (l : launch) : Prop :=
  exists thc uc, in_box (d s / A s) (place l / A s) (phase s (since l)) (unit_speed s (speed l)) thc uc b.

(* th0 <= depart, the departure is inwards, or the flight is followed in the gap from th0 on. *)
Lemma departure_sound OS b l gamma y th0 u thc uc (os := companions s) : Forall2 knows OS os -> in_box gamma y th0 u thc uc b ->
  check_departure OS b l = true ->
  let q := scale l in exists ta, (ta = th0 \/ exists w0, y = side w0 * (gamma / 2) /\ leaves os w0 th0 u ta) /\
  th0 <= ta /\ grid q (depart l) <= ta /\ (ta <= grid q (approach l) \/ ta = grid q (depart l)).
Proof.
  intros hos inb check q. assert (ac := look_seen _ _ _ _ _ _ _ (coarse l) _ (coarse l) b hos inb).
  assert (sp := unit_step_holds (bits l) q). assert (sc := unit_step_holds (coarse l) q).
  pose proof inb as (hf & h0 & _ & _ & _ & hu & _). unfold check_departure in check. fold q in check.
  destruct (from b) as [w|] eqn:f.
  - split_checks. assert (a1 : 0 <= grid q (depart l) - th0) by (apply (is_not_negative_sound _ _ k); enclose).
    set (low := (lowest b * 2 ^ Zpos q / 2 ^ Zpos (box_scale b) - 1)%Z) in *.
    assert (a2 : 0 <= th0 - grid q low) by (apply (is_not_negative_sound _ _ k0); enclose).
    exists (grid q (depart l)). split; [right; exists w; split; [exact hf|]|lra].
    destruct (sweep (inwards_over _ _ _ _ _ _ _) _ _ _) eqn:d in check.
    + left. intros th r. refine (sweep_sound q _ (fun x => 0 < - side w * rate os th0 u x) _ _ _ _ d th _); [|lra].
      intros i j h x rx. exact (inwards_sound _ _ _ _ _ _ _ _ _ hos _ inb _ ac q _ sc _ _ _ h x rx).
    + right. split_checks. split.
      * replace (- side w * u) with (- (side w * u)) by ring. apply (is_not_negative_sound _ _ k1). enclose.
      * intros th r. refine (sweep_sound q _ (fun x => 0 < - side w * box_bend os x) _ _ _ _ check th _); [|lra].
        intros i j h x rx. exact (pressed_sound _ _ _ hos q _ sc _ _ _ h x rx).
  - split_checks. exists th0. split; [left; reflexivity|].
    assert (0 <= th0 - grid q (depart l)) by (apply (is_not_negative_sound _ _ k); enclose).
    assert (0 <= grid q (approach l) - th0) by (apply (is_not_negative_sound _ _ check); enclose). lra.
Qed.

(* What a departure has to show. *)
Definition departs (leg : leg) (y th0 u : R) : Prop := exists ta, (ta = th0 \/ exists w0, y = side w0 * (d s / A s / 2) /\ leaves (companions s) w0 th0 u ta) /\
  th0 <= ta /\ grid (scale leg) (depart leg) <= ta /\ (ta <= grid (scale leg) (approach leg) \/ ta = grid (scale leg) (depart leg)).

Lemma course_sound b leg l thc uc : in_box (d s / A s) (place l / A s) (phase s (since l)) (unit_speed s (speed l)) thc uc b ->
  departs leg (place l / A s) (phase s (since l)) (unit_speed s (speed l)) -> check_course b leg = true -> exists i, reaches s l i /\ wall_of i = hits leg /\
    grid (scale leg) (t leg - rt leg) <= phase s (time i) <= grid (scale leg) (t leg + rt leg) /\
    place l / A s + rise (companions s) (phase s (since l)) (unit_speed s (speed l)) (phase s (time i)) = side (hits leg) * (d s / A s / 2) /\
    unit_speed s (velocity i) = rate (companions s) (phase s (since l)) (unit_speed s (speed l)) (phase s (time i)) /\
    forall th, grid (scale leg) (t leg - rt leg) <= th <= grid (scale leg) (t leg + rt leg) ->
      0 < side (hits leg) * rate (companions s) (phase s (since l)) (unit_speed s (speed l)) th.
Proof.
  intros inb left_ check. unfold check_course in check. cbv zeta in check.
  set (p := bits leg) in *. set (c := coarse leg) in *. set (q := scale leg) in *.
  set (lo := (t leg - rt leg)%Z) in *. set (hi := (t leg + rt leg)%Z) in *.
  assert (Gp := holds_gamma p). assert (Gc := holds_gamma c).
  assert (sp := unit_step_holds p q). assert (sc := unit_step_holds c q).
  set (OS := known_in p) in *. set (os := companions s) in *. assert (hos : Forall2 knows OS os) by apply holds_known.
  assert (ap := look_seen _ _ _ _ _ _ _ p _ c b hos inb). assert (ac := look_seen _ _ _ _ _ _ _ c _ c b hos inb).
  split_checks. rename check into high_check.
  set (th0 := phase s (since l)) in *. set (u := unit_speed s (speed l)) in *. set (gamma := d s / A s) in *.
  set (y := place l / A s) in *.
  assert (hT : holds (T b) th0) by apply inb.
  assert (rt0 : (0 <= rt leg)%Z) by (apply Z.leb_le; assumption).
  assert (order1 : (depart leg <= approach leg)%Z) by (apply Z.leb_le; assumption).
  assert (order2 : (approach leg <= lo)%Z) by (apply Z.leb_le; assumption).
  apply (grid_le q) in order1. apply (grid_le q) in order2.
  assert (order3 : grid q lo <= grid q hi) by (apply grid_le; unfold lo, hi; lia).
  assert (order4 : 0 < grid q lo - th0) by (apply (is_positive_sound _ _ k2); enclose).
  destruct left_ as (ta & departs & o1 & o2 & o3). fold q in o2, o3.
  assert (off := holds_offset gamma y th0 u thc uc p _ Gp b inb (hits leg)).
  assert (low := holds_rise_at gamma y th0 u thc uc os p OS hos b inb _ ap q _ sp lo).
  assert (high := holds_rise_at gamma y th0 u thc uc os p OS hos b inb _ ap q _ sp hi).
  assert (arriving : forall th, grid q (approach leg) <= th <= grid q hi -> 0 < side (hits leg) * rate os th0 u th).
  { intros th r. replace (side (hits leg)) with (- side (opposite (hits leg))) by (destruct (hits leg); cbn; ring).
    refine (sweep_sound q _ (fun x => 0 < - side (opposite (hits leg)) * rate os th0 u x) _ _ _ _ k4 th _); [|lra].
    intros i j h x rx. exact (inwards_sound _ _ _ _ _ _ _ _ _ hos _ inb _ ac q _ sc _ _ _ h x rx). }
  destruct (flight s A_positive W_positive l (hits leg) ta (grid q (approach leg)) (grid q lo) (grid q hi)) as (i & reach & same & r1 & onwall & vel).
  - fold th0. destruct o3; lra.
  - lra.
  - fold th0. lra.
  - replace (d s / A s / 2) with (gamma / 2) by reflexivity. exact departs.
  - fold th0 u y os. intros th r. replace (d s / A s / 2) with (gamma / 2) by reflexivity.
    refine (sweep_sound q _ (fun x => Rabs (y + rise os th0 u x) < gamma / 2) _ _ _ _ k3 th _); [|lra].
    intros i j h x rx. exact (inside_sound _ _ _ _ _ _ _ _ _ hos _ Gc _ inb _ ac q _ sc _ _ h x rx).
  - fold th0 u os. exact arriving.
  - fold th0 u y os. replace (d s / A s / 2) with (gamma / 2) by reflexivity.
    assert (0 < - (side (hits leg) * (y - side (hits leg) * (gamma / 2) + rise os th0 u (grid q lo)))) by (apply (is_positive_sound _ _ k5); enclose).
    destruct (hits leg); cbn [side] in *; lra.
  - fold th0 u y os. replace (d s / A s / 2) with (gamma / 2) by reflexivity.
    assert (0 <= side (hits leg) * (y - side (hits leg) * (gamma / 2) + rise os th0 u (grid q hi))) by (apply (is_not_negative_sound _ _ high_check); enclose).
    destruct (hits leg); cbn [side] in *; lra.
  - exists i. split; [exact reach|]. split; [exact same|]. split; [exact r1|]. split; [exact onwall|]. split; [exact vel|].
    intros th r. apply arriving. lra.
Qed.

Lemma flight_sound b leg l thc uc : in_box (d s / A s) (place l / A s) (phase s (since l)) (unit_speed s (speed l)) thc uc b ->
  check_flight b leg = true -> exists i, reaches s l i /\ wall_of i = hits leg /\
    grid (scale leg) (t leg - rt leg) <= phase s (time i) <= grid (scale leg) (t leg + rt leg) /\
    place l / A s + rise (companions s) (phase s (since l)) (unit_speed s (speed l)) (phase s (time i)) = side (hits leg) * (d s / A s / 2) /\
    unit_speed s (velocity i) = rate (companions s) (phase s (since l)) (unit_speed s (speed l)) (phase s (time i)) /\
    forall th, grid (scale leg) (t leg - rt leg) <= th <= grid (scale leg) (t leg + rt leg) ->
      0 < side (hits leg) * rate (companions s) (phase s (since l)) (unit_speed s (speed l)) th.
Proof.
  intros inb check. unfold check_flight in check. split_checks. refine (course_sound b leg l thc uc inb _ check).
  exact (departure_sound (known_in (bits leg)) b leg (d s / A s) _ _ _ thc uc (holds_known (bits leg)) inb k).
Qed.

Lemma holds_phase_over p T t : holds T t -> holds (phase_over p T) (phase s t).
Proof.
  destruct described as ((_ & dW & dt) & _). assert (hW := holds_range p _ _ dW). assert (ht := holds_range p _ _ dt).
  intros hT. unfold phase_over, phase. enclose.
Qed.
Lemma holds_velocity_over p V v : holds V v -> holds (velocity_over p V) (A s * W s * v).
Proof.
  destruct described as ((dA & dW & _) & _). assert (hA := holds_range p _ _ dA). assert (hW := holds_range p _ _ dW).
  intros hV. unfold velocity_over. enclose.
Qed.

Lemma shown_sound p q lo hi slow fast printed i : check_shown p (unit_step p q) lo hi slow fast printed = true -> wall_of i = on printed ->
  grid q lo <= phase s (time i) <= grid q hi -> grid q slow <= unit_speed s (velocity i) <= grid q fast -> within printed i.
Proof.
  unfold check_shown. cbv zeta. intros check same r1 r2. split_checks.
  assert (sp := unit_step_holds p q).
  assert (hTH := holds_stretch p q _ sp _ _ _ r1). assert (hV := holds_velocity_over p _ _ (holds_stretch p q _ sp _ _ _ r2)).
  replace (A s * W s * unit_speed s (velocity i)) with (velocity i) in hV by (unfold unit_speed; field; lra).
  assert (known : forall r, holds (enclose p (Rational r)) (Q2R r)) by (intros r; exact (holds_enclose p (Rational r))).
  assert (times := bounded_sound _ _ _ _ _ _ _ k (holds_phase_over p _ _ (known _)) hTH (holds_phase_over p _ _ (known _))).
  assert (velocities := bounded_sound _ _ _ _ _ _ _ check (known _) hV (known _)).
  unfold within, phase in *. rewrite same. repeat split; nra.
Qed.

(* A flight, its impact as printed, and the launch from there. *)
Lemma landed_sound b leg printed l : launched b l -> departs leg (place l / A s) (phase s (since l)) (unit_speed s (speed l)) ->
  check_course b leg = true -> check_arrival b leg printed = true ->
  exists i, reaches s l i /\ within printed i /\ wall_of i = hits leg /\
    grid (scale leg) (t leg - rt leg) <= phase s (time i) <= grid (scale leg) (t leg + rt leg) /\
    grid (scale leg) (v leg - rv leg) <= unit_speed s (velocity i) <= grid (scale leg) (v leg + rv leg) /\
    launched (landed leg) (rebound s i).
Proof.
  intros (thc & uc & inb) left_ course check. unfold check_arrival in check. cbv zeta in check.
  destruct (course_sound b leg l thc uc inb left_ course) as (i & reach & same & r1 & onwall & vel & _).
  assert (rt0 : (0 <= rt leg)%Z) by (apply Z.leb_le; unfold check_course in course; cbv zeta in course; split_checks; reflexivity).
  set (p := bits leg) in *. set (c := coarse leg) in *. set (q := scale leg) in *.
  set (lo := (t leg - rt leg)%Z) in *. set (hi := (t leg + rt leg)%Z) in *.
  assert (sp := unit_step_holds p q).
  set (OS := known_in p) in *. set (os := companions s) in *. assert (hos : Forall2 knows OS os) by apply holds_known.
  assert (ap := look_seen _ _ _ _ _ _ _ p _ c b hos inb).
  split_checks. assert (rv0 : (0 <= rv leg)%Z) by (apply Z.leb_le; assumption).
  set (th0 := phase s (since l)) in *. set (u := unit_speed s (speed l)) in *. set (gamma := d s / A s) in *.
  set (y := place l / A s) in *.
  assert (speed_in := holds_arrival gamma y th0 u thc uc os p OS hos _ (holds_gamma p) b inb c _ ap q _ sp (hits leg) (t leg) (rt leg) (tilt leg) _ rt0 r1 onwall).
  assert (r2 := between_sound _ _ _ _ _ _ k0 speed_in). rewrite <- vel in r2.
  exists i. split; [exact reach|]. split; [|split; [exact same|split; [exact r1|split; [exact r2|]]]].
  - apply (shown_sound p q lo hi (v leg - rv leg) (v leg + rv leg)); try assumption. rewrite same.
    destruct (hits leg), (on printed); congruence.
  - exists (grid q (t leg)), (- e s * grid q (v leg)).
    assert (E := holds_range p _ _ (proj2 (proj2 (proj2 described)))).
    assert (h := landing_in p _ (hits leg) _ _ _ _ _ gamma _ _ _ rt0 rv0 E r1 r2).
    cbn [rebound place since speed]. rewrite same. fold gamma.
    replace (plane s (hits leg) / A s) with (side (hits leg) * (gamma / 2)) by (unfold plane, gamma; field; lra).
    replace (unit_speed s (- e s * velocity i)) with (- e s * unit_speed s (velocity i)) by (unfold unit_speed; field; lra).
    exact h.
Qed.
Lemma leg_departs b leg l : launched b l -> check_departure (known_in (bits leg)) b leg = true ->
  departs leg (place l / A s) (phase s (since l)) (unit_speed s (speed l)).
Proof. intros (thc & uc & inb) check. exact (departure_sound (known_in (bits leg)) b leg (d s / A s) _ _ _ thc uc (holds_known (bits leg)) inb check). Qed.

Lemma leg_sound b leg printed l : launched b l -> check_leg b leg printed = true ->
  exists i, reaches s l i /\ within printed i /\ wall_of i = hits leg /\
    grid (scale leg) (t leg - rt leg) <= phase s (time i) <= grid (scale leg) (t leg + rt leg) /\
    grid (scale leg) (v leg - rv leg) <= unit_speed s (velocity i) <= grid (scale leg) (v leg + rv leg) /\
    launched (landed leg) (rebound s i).
Proof.
  unfold check_leg, check_flight. intros inb check. split_checks. exact (landed_sound b leg printed l inb (leg_departs _ _ _ inb k0) k check).
Qed.

Lemma legs_sound legs : forall printed b l, launched b l -> check_legs b legs printed = true ->
  exists orbit, follows s l orbit /\ Forall2 within printed orbit.
Proof.
  induction legs as [|leg legs IH]; intros [|i printed] b l inb check; cbn [check_legs] in check; try discriminate.
  - exists []. split; [exact I|constructor].
  - split_checks. destruct (leg_sound b leg i l inb k) as (j & reach & inside & _ & _ & _ & landed_in).
    destruct (IH printed _ _ landed_in check) as (orbit & f & a).
    exists (j :: orbit). split; [split; assumption|constructor; assumption].
Qed.
End Data.

Definition start_box (param : data) (b : beginning) (o : start) : box :=
  let p := start_bits o in let q := start_scale o in
  match b with
  | Struck w _ _ => landing p (enclose_range p (restitution param)) w q (start_t o) (start_rt o) (start_v o) (start_rv o)
  | Inside _ y _ => midway p (quotient p (enclose_range p y) (enclose_range p (amplitude param))) q (start_t o) (start_rt o) (start_v o) (start_rv o)
  end.

Definition check_start (param : data) (b : beginning) (o : start) : bool :=
  let p := start_bits o in let q := start_scale o in let step := unit_step p q in
  let A := enclose_range p (amplitude param) in let W := enclose_range p (frequency param) in
  let (t, v) := match b with Struck _ t v | Inside t _ v => (t, v) end in
  (0 <=? start_rt o)%Z &? (0 <=? start_rv o)%Z &?
  is_positive A &? is_positive W &? is_positive (enclose_range p (gap param)) &?
  between p step (add p (mul p W (enclose_range p t)) (enclose_range p (shift param))) (start_t o - start_rt o) (start_t o + start_rt o) &?
  between p step (quotient p (enclose_range p v) (mul p A W)) (start_v o - start_rv o) (start_v o + start_rv o).

Definition check (param : data) (b : beginning) (o : start) (legs : list leg) (printed : list bounds) : bool :=
  check_start param b o &? check_legs param (start_box param b o) legs printed.

Lemma start_sound param b o s l : describes param s -> begins b s l -> check_start param b o = true ->
  0 < A s /\ 0 < W s /\ 0 < d s /\ launched s (start_box param b o) l.
Proof.
  intros described. pose proof described as ((dA & dW & dt) & _ & dd & de). unfold check_start. set (p := start_bits o). set (q := start_scale o).
  assert (hA := holds_range p _ _ dA). assert (hW := holds_range p _ _ dW). assert (ht := holds_range p _ _ dt).
  assert (hd := holds_range p _ _ dd). assert (he := holds_range p _ _ de).
  destruct b as [w tr vr|tr yr vr]; intros begun h; cbv zeta in h; split_checks;
    assert (a := is_positive_sound _ _ k1 hA); assert (w0 := is_positive_sound _ _ k2 hW);
    assert (g := is_positive_sound _ _ k3 hd); (split; [exact a|split; [exact w0|split; [exact g|]]]);
    apply Z.leb_le in k; apply Z.leb_le in k0.
  - destruct begun as (i & <- & bt & bv & ->). assert (hbt := holds_range p _ _ bt). assert (hbv := holds_range p _ _ bv).
    exists (grid q (start_t o)), (- e s * grid q (start_v o)). cbn [rebound place since speed start_box].
    replace (plane s (wall_of i) / A s) with (side (wall_of i) * (d s / A s / 2)) by (unfold plane; field; lra).
    replace (unit_speed s (- e s * velocity i)) with (- e s * (velocity i / (A s * W s))) by (unfold unit_speed; field; lra).
    apply landing_in; try assumption.
    + apply (between_sound _ _ _ _ _ _ k4). unfold phase. enclose.
    + apply (between_sound _ _ _ _ _ _ h). enclose.
  - destruct begun as (bt & bY & bv). assert (hbt := holds_range p _ _ bt). assert (hbv := holds_range p _ _ bv). assert (hby := holds_range p _ _ bY).
    exists (grid q (start_t o)), (grid q (start_v o)). cbn [start_box]. apply midway_in; try assumption.
    + enclose.
    + apply (between_sound _ _ _ _ _ _ k4). unfold phase. enclose.
    + apply (between_sound _ _ _ _ _ _ h). unfold unit_speed. enclose.
Qed.

(* For every scene and beginning that the data allow: there is exactly one sequence of first contacts, with the printed
   walls, times and velocities. *)
Theorem orbit_checked param b o legs printed : check param b o legs printed = true ->
  forall s l, describes param s -> begins b s l -> certified s l printed.
Proof.
  unfold check. intros h s l described begun. split_checks.
  destruct (start_sound param b o s l described begun k) as (a & w & g & inb).
  destruct (legs_sound param s described a w legs printed _ l inb h) as (orbit & f & inside).
  exists orbit. split; [exact f|split; [exact inside|]]. intros other f' len.
  exact (follows_unique s g other l orbit f' f len).
Qed.
End Checker.

(* Plain: floats on Coq's binary integers; no axioms but those of the real numbers. Fast: on arrays of machine integers
   (Bignums), whose axioms say that the machine's 63-bit integers compute right. *)
Module PlainFloats := SpecificFloat StdZRadix2.
Module FastFloats := SpecificFloat BigIntRadix2.
Module Plain := Checker PlainFloats.
Module Fast := Checker FastFloats.
