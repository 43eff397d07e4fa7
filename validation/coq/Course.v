(* Enclosures of a flight from a box of launches, and the tests of Step.v's conditions on it, with interval arithmetic on floats F. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig Float.Specific_ops Float.Specific_stdz Float.Specific_bigint.
From ImpactPair Require Import Model Step Data.
From ImpactPair Require Export Enclosure.
Open Scope R_scope.
Import ListNotations.

Module Courses (F : FloatOps with Definition sensible_format := true).
Include Enclosure F.
Local Opaque add sub mul quotient whole hull sine cosine.

(* The set of launches of a leg: from a wall, or from anywhere in the gap; th0 and u each in an interval, with a centre. *)
Record box := Box {
  from : option wall; somewhere : I.type; around : Z; lowest : Z; box_scale : positive;
  T : I.type; Tc : I.type; dT : I.type; U : I.type; Uc : I.type; dU : I.type }.

(* A harmonic in the units of the reference. *)
Record known := { Share : I.type; Ratio : I.type; Lag : I.type }.
Definition knows (O : known) (o : companion) : Prop := holds (Share O) (share o) /\ holds (Ratio O) (ratio o) /\ holds (Lag O) (lag o).

(* E, E' and -E'' of the box near m quarter periods of the reference; the others turn as their phases say. *)
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

Definition depth : nat := 40.
Notation "a &? b" := (if a then b else false) (at level 45, right associativity).

Ltac split_checks := repeat match goal with
  | h : (if ?c then _ else false) = true |- _ => let k := fresh "k" in destruct c eqn:k; [|discriminate h] end.

(* X lies between L and H; and between the grid points lo and hi. *)
Definition bounded (p : positive) (L X H : I.type) : bool := is_not_negative (sub p X L) &? is_not_negative (sub p H X).
(* Rational bounds. *)
Definition is_within (p : positive) (b : Q * Q) (X : I.type) : bool := bounded p (known_number p (fst b)) X (known_number p (snd b)).
Definition between (p : positive) (step X : I.type) (lo hi : Z) : bool := bounded p (point p step lo) X (point p step hi).
Lemma bounded_sound p L X H l x h : bounded p L X H = true -> holds L l -> holds X x -> holds H h -> l <= x <= h.
Proof.
  unfold bounded. intros check hL hX hH. split_checks.
  assert (0 <= x - l) by (apply (is_not_negative_sound _ _ k); enclose).
  assert (0 <= h - x) by (apply (is_not_negative_sound _ _ check); enclose). lra.
Qed.
Lemma is_within_sound p b X x : is_within p b X = true -> holds X x -> Q2R (fst b) <= x <= Q2R (snd b).
Proof. intros check hX. exact (bounded_sound _ _ _ _ _ _ _ check (holds_number _ _) hX (holds_number _ _)). Qed.
Lemma between_sound p q X x lo hi : between p (unit_step p q) X lo hi = true -> holds X x -> grid q lo <= x <= grid q hi.
Proof. intros check hX. assert (st := unit_step_holds p q). apply (bounded_sound _ _ _ _ _ _ _ check); [enclose|exact hX|enclose]. Qed.
End Courses.
