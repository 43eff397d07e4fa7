(* H-sets of a document of `chaos` (Chaos.v), and parallelograms that stand for them: a program `check_h_sets`, with the proof that it is right
   (`h_sets_checked`).

   That no two h-sets meet, up to whole forcing periods, is shown in whole numbers; that the middles and half vectors are as listed, and that each
   parallelogram is in its h-set, in interval arithmetic. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Enclosure Horseshoe Certificate Covering Chaos.
Open Scope R_scope.
Import ListNotations.

(* The property of all h-sets that the program proves: `disjoint_sets` of their list. *)
Definition disjoint_list (hs : list h_set) : Prop := forall i j th w (k : Z), (i < length hs)%nat -> (j < length hs)%nat ->
  in_set (nth i hs no_set) th w -> in_set (nth j hs no_set) (th + IZR k * (2 * PI)) w -> i = j /\ k = 0%Z.

(* Twice the area of a triangle, counterclockwise. *)
Definition turn_of (a b c : R * R) : R := (fst b - fst a) * (snd c - snd a) - (snd b - snd a) * (fst c - fst a).
(* A linear function is at most as large in a triangle as at a corner. *)
Lemma triangle_below a b c x n1 n2 m : 0 < turn_of a b c -> 0 <= turn_of a b x -> 0 <= turn_of b c x -> 0 <= turn_of c a x ->
  n1 * fst a + n2 * snd a <= m -> n1 * fst b + n2 * snd b <= m -> n1 * fst c + n2 * snd c <= m -> n1 * fst x + n2 * snd x <= m.
Proof.
  intros big ab bc ca ha hb hc. apply Rnot_lt_le. intros over.
  assert (mean : turn_of a b c * (m - (n1 * fst x + n2 * snd x)) = turn_of b c x * (m - (n1 * fst a + n2 * snd a)) +
    turn_of c a x * (m - (n1 * fst b + n2 * snd b)) + turn_of a b x * (m - (n1 * fst c + n2 * snd c))) by (unfold turn_of; ring).
  assert (0 <= turn_of b c x * (m - (n1 * fst a + n2 * snd a))) by (apply Rmult_le_pos; lra).
  assert (0 <= turn_of c a x * (m - (n1 * fst b + n2 * snd b))) by (apply Rmult_le_pos; lra).
  assert (0 <= turn_of a b x * (m - (n1 * fst c + n2 * snd c))) by (apply Rmult_le_pos; lra).
  assert (0 < turn_of a b c * ((n1 * fst x + n2 * snd x) - m)) by (apply Rmult_lt_0_compat; lra). lra.
Qed.

(* Quadrilaterals with whole corners, in the order of `edges`. *)
Definition corner : Type := Z * Z.
Record quadrilateral := Quadrilateral { first_corner : corner; second_corner : corner; third_corner : corner; fourth_corner : corner }.
Definition corner_point (c : corner) : R * R := (IZR (fst c), IZR (snd c)).
Definition contains_point (A : quadrilateral) (x : R * R) : Prop :=
  let a := corner_point (first_corner A) in let b := corner_point (second_corner A) in let c := corner_point (third_corner A) in
  let d := corner_point (fourth_corner A) in 0 <= turn_of a b x /\ 0 <= turn_of b c x /\ 0 <= turn_of c d x /\ 0 <= turn_of d a x.

Definition turns_left (a b c : corner) : bool := (0 <? (fst b - fst a) * (snd c - snd a) - (snd b - snd a) * (fst c - fst a))%Z.
Definition is_convex (A : quadrilateral) : bool := let '(Quadrilateral a b c d) := A in
  turns_left a b c && turns_left b c d && turns_left c d a && turns_left d a b.
(* Its coordinate in a direction. *)
Definition in_direction (n c : Z * Z) : Z := (fst n * fst c + snd n * snd c)%Z.
Definition reaches_to (n : Z * Z) (A : quadrilateral) : Z := let '(Quadrilateral a b c d) := A in
  Z.max (Z.max (in_direction n a) (in_direction n b)) (Z.max (in_direction n c) (in_direction n d)).

Lemma turns_left_sound a b c : turns_left a b c = true -> 0 < turn_of (corner_point a) (corner_point b) (corner_point c).
Proof. unfold turns_left. intros h. apply Z.ltb_lt, IZR_lt in h. rewrite !minus_IZR, !mult_IZR, !minus_IZR in h. exact h. Qed.
Lemma reaches_sound n A x : is_convex A = true -> contains_point A x -> IZR (fst n) * fst x + IZR (snd n) * snd x <= IZR (reaches_to n A).
Proof.
  destruct A as [a b c d]. unfold is_convex, contains_point, reaches_to. cbn [first_corner second_corner third_corner fourth_corner].
  intros convex (ab & bc & cd & da). apply andb_prop in convex as [convex _]. apply andb_prop in convex as [convex cda].
  apply andb_prop in convex as [abc _]. apply turns_left_sound in abc, cda.
  set (m := Z.max _ _). assert (most : forall e, (in_direction n e <= m)%Z -> IZR (fst n) * fst (corner_point e) + IZR (snd n) * snd (corner_point e) <= IZR m).
  { intros e h. apply IZR_le in h. unfold in_direction in h. rewrite plus_IZR, !mult_IZR in h. exact h. }
  assert (ha := most a ltac:(lia)). assert (hb := most b ltac:(lia)). assert (hc := most c ltac:(lia)). assert (hd := most d ltac:(lia)).
  assert (turned : turn_of (corner_point c) (corner_point a) x = - turn_of (corner_point a) (corner_point c) x) by (unfold turn_of; ring).
  destruct (Rle_lt_dec 0 (turn_of (corner_point a) (corner_point c) x)) as [l|r].
  - apply (triangle_below (corner_point c) (corner_point d) (corner_point a)); assumption.
  - apply (triangle_below (corner_point a) (corner_point b) (corner_point c)); try assumption. lra.
Qed.

Section Scaled.
(* A common denominator of all corners: their unit is its inverse, and it is the number of units in a forcing period. *)
Variable D : Z.
Definition in_units (r : Q) : bool := (D mod Zpos (Qden r) =? 0)%Z.
Definition scaled (r : Q) : Z := (Qnum r * (D / Zpos (Qden r)))%Z.
Definition scaled_corner (c : Q * Q) : corner := (scaled (fst c), scaled (snd c)).
Definition scaled_set (h : h_set) : quadrilateral :=
  Quadrilateral (scaled_corner (left_bottom h)) (scaled_corner (right_bottom h)) (scaled_corner (right_top h)) (scaled_corner (left_top h)).
Definition set_in_units (h : h_set) : bool := forallb (fun c => in_units (fst c) && in_units (snd c)) [left_bottom h; right_bottom h; right_top h; left_top h].

Lemma scaled_sound r : in_units r = true -> IZR (scaled r) = IZR D * Q2R r.
Proof.
  unfold in_units, scaled, Q2R. intros h. apply Z.eqb_eq in h. assert (e := Z.div_mod D (Zpos (Qden r)) ltac:(lia)). rewrite h, Z.add_0_r in e.
  rewrite e at 2. rewrite !mult_IZR. field. apply IZR_neq. lia.
Qed.
Lemma scaled_set_sound h th w : set_in_units h = true -> in_set h th w -> contains_point (scaled_set h) (IZR D * (th / (2 * PI)), IZR D * w).
Proof.
  unfold set_in_units, in_set, edges, contains_point, scaled_set. cbn [forallb first_corner second_corner third_corner fourth_corner]. set (u := th / (2 * PI)).
  intros fit inside. apply andb_prop in fit as [f1 fit]. apply andb_prop in fit as [f2 fit]. apply andb_prop in fit as [f3 fit].
  apply andb_prop in fit as [f4 _].
  assert (one : forall a b, in_units (fst a) && in_units (snd a) = true -> in_units (fst b) && in_units (snd b) = true -> left_of a b u w ->
    0 <= turn_of (corner_point (scaled_corner a)) (corner_point (scaled_corner b)) (IZR D * u, IZR D * w)).
  { intros a b ha hb on. apply andb_prop in ha as [ha ha'], hb as [hb hb']. unfold turn_of, corner_point, scaled_corner. cbn [fst snd].
    rewrite !scaled_sound by assumption. unfold left_of in on.
    apply (Rmult_le_pos (IZR D * IZR D)) in on; [|nra]. match type of on with 0 <= ?r => replace r with
      ((IZR D * Q2R (fst b) - IZR D * Q2R (fst a)) * (IZR D * w - IZR D * Q2R (snd a)) -
        (IZR D * Q2R (snd b) - IZR D * Q2R (snd a)) * (IZR D * u - IZR D * Q2R (fst a))) in on by ring end.
    exact on. }
  inversion inside as [|e l h1 inside1]. inversion inside1 as [|e1 l1 h2 inside2]. inversion inside2 as [|e2 l2 h3 inside3].
  inversion inside3 as [|e3 l3 h4 _]. subst. cbn [fst snd] in *. repeat split; apply one; assumption.
Qed.

(* k periods after a point of the first one there is none of the second one, as a line has them on its two sides. *)
Definition separates (k : Z) (A B : quadrilateral) (n : Z * Z) : bool := (reaches_to n A + k * D * fst n + reaches_to (- fst n, - snd n) B <? 0)%Z.
Definition outward (a b : corner) : Z * Z := (snd b - snd a, fst a - fst b)%Z.
Definition outwards (A : quadrilateral) : list (Z * Z) := let '(Quadrilateral a b c d) := A in [outward a b; outward b c; outward c d; outward d a].
Definition apart_by (A B : quadrilateral) (k : Z) : bool :=
  if separates k A B (1, 0)%Z then true else if separates k A B (-1, 0)%Z then true else if existsb (separates k A B) (outwards A) then true else
  existsb (fun n => separates k A B (- fst n, - snd n)%Z) (outwards B).
(* Their phases differ by less than three periods. *)
Definition less_than_three (A B : quadrilateral) : bool :=
  ((reaches_to (1, 0) A + reaches_to (-1, 0) B <? 3 * D) && (reaches_to (1, 0) B + reaches_to (-1, 0) A <? 3 * D))%Z.
Definition is_apart (A B : quadrilateral) : bool := less_than_three A B && forallb (apart_by A B) [-2; -1; 0; 1; 2]%Z.
Definition is_alone (A : quadrilateral) : bool := less_than_three A A && forallb (apart_by A A) [-2; -1; 1; 2]%Z.
Fixpoint all_disjoint (As : list quadrilateral) : bool := match As with [] => true | A :: As => is_alone A && forallb (is_apart A) As && all_disjoint As end.

Hypothesis D_positive : (0 < D)%Z.
Section Two.
Variables (A B : quadrilateral) (x : R * R) (k : Z).
Hypothesis A_convex : is_convex A = true.
Hypothesis B_convex : is_convex B = true.
Hypothesis in_first : contains_point A x.
Hypothesis in_second : contains_point B (fst x + IZR k * IZR D, snd x).
Lemma separates_sound n : separates k A B n = false.
Proof.
  apply not_true_is_false. unfold separates. intros h. apply Z.ltb_lt, IZR_lt in h. rewrite !plus_IZR, !mult_IZR in h.
  assert (ha := reaches_sound n A x A_convex in_first). assert (hb := reaches_sound (- fst n, - snd n)%Z B _ B_convex in_second).
  cbn [fst snd] in hb. rewrite !opp_IZR in hb. lra.
Qed.
Lemma apart_by_sound : apart_by A B k = false.
Proof.
  assert (none : forall (f : Z * Z -> Z * Z) ns, existsb (fun n => separates k A B (f n)) ns = false).
  { intros f ns. induction ns as [|n ns IH]; [reflexivity|]. cbn [existsb]. rewrite separates_sound. exact IH. }
  unfold apart_by. rewrite !separates_sound, (none (fun n => n)). apply none.
Qed.
Lemma less_than_three_sound : less_than_three A B = true -> (-3 < k < 3)%Z.
Proof.
  unfold less_than_three. intros h. apply andb_prop in h as [ab ba]. apply Z.ltb_lt, IZR_lt in ab, ba. rewrite plus_IZR, mult_IZR in ab, ba.
  assert (ha := reaches_sound (1, 0)%Z A x A_convex in_first). assert (ha' := reaches_sound (-1, 0)%Z A x A_convex in_first).
  assert (hb := reaches_sound (1, 0)%Z B _ B_convex in_second). assert (hb' := reaches_sound (-1, 0)%Z B _ B_convex in_second).
  cbn [fst snd] in *. apply IZR_lt in D_positive. split; apply lt_IZR; apply (Rmult_lt_reg_r (IZR D)); lra.
Qed.
Lemma is_apart_sound : is_apart A B = false.
Proof.
  apply not_true_is_false. unfold is_apart. intros h. apply andb_prop in h as [near h]. apply less_than_three_sound in near. rewrite forallb_forall in h.
  specialize (h k). rewrite apart_by_sound in h. discriminate h. cbn [In]. lia.
Qed.
End Two.
Lemma is_alone_sound A x k : is_convex A = true -> is_alone A = true -> contains_point A x -> contains_point A (fst x + IZR k * IZR D, snd x) -> k = 0%Z.
Proof.
  unfold is_alone. intros convex h h1 h2. apply andb_prop in h as [near h]. apply (less_than_three_sound A A x k) in near; try assumption.
  rewrite forallb_forall in h. destruct (Z.eq_dec k 0) as [e|n]; [exact e|]. specialize (h k). rewrite (apart_by_sound A A x k) in h by assumption.
  discriminate h. cbn [In]. lia.
Qed.
Lemma all_disjoint_sound As : all_disjoint As = true -> (forall n A, nth_error As n = Some A -> is_alone A = true) /\
  forall i j A B, (i < j)%nat -> nth_error As i = Some A -> nth_error As j = Some B -> is_apart A B = true.
Proof.
  induction As as [|A0 As IH]; intros h; [split; [intros []|intros []]; discriminate|]. cbn [all_disjoint] in h.
  apply andb_prop in h as [h rest]. apply andb_prop in h as [alone apart]. destruct (IH rest) as [one two]. rewrite forallb_forall in apart. split.
  - intros [|n] A e; [injection e as <-; exact alone|exact (one n A e)].
  - intros i [|j] A B o hi hj; [lia|]. cbn [nth_error] in hj. destruct i as [|i]; [|exact (two i j A B ltac:(lia) hi hj)].
    injection hi as <-. exact (apart B (nth_error_In _ _ hj)).
Qed.
End Scaled.

(* A common denominator: any that passes the check would do. *)
Definition denominators (h : h_set) : list Z :=
  flat_map (fun c => [Zpos (Qden (fst c)); Zpos (Qden (snd c))]) [left_bottom h; right_bottom h; right_top h; left_top h].
Definition common_denominator (hs : list h_set) : Z := fold_right (fun h D => fold_right Z.lcm D (denominators h)) 1%Z hs.
Definition check_disjoint (hs : list h_set) : bool := let D := common_denominator hs in let As := map (scaled_set D) hs in
  (0 <? D)%Z && forallb (set_in_units D) hs && forallb is_convex As && all_disjoint D As.

Theorem check_disjoint_sound hs : check_disjoint hs = true -> disjoint_list hs.
Proof.
  unfold check_disjoint. cbv zeta. set (D := common_denominator hs). clearbody D. intros h. apply andb_prop in h as [h disjoint].
  apply andb_prop in h as [h convex]. apply andb_prop in h as [positive fit]. apply Z.ltb_lt in positive. rewrite forallb_forall in fit, convex.
  apply all_disjoint_sound in disjoint as [alone apart].
  assert (seen : forall n th w, (n < length hs)%nat -> in_set (nth n hs no_set) th w -> exists A,
    nth_error (map (scaled_set D) hs) n = Some A /\ is_convex A = true /\ contains_point A (IZR D * (th / (2 * PI)), IZR D * w)).
  { intros n th w o inside. exists (scaled_set D (nth n hs no_set)). assert (e : nth_error (map (scaled_set D) hs) n = Some (scaled_set D (nth n hs no_set))).
    { apply map_nth_error, nth_error_nth', o. }
    split; [exact e|]. split; [exact (convex _ (nth_error_In _ _ e))|]. apply scaled_set_sound; [apply fit, nth_In, o|exact inside]. }
  assert (turned : forall th k, IZR D * ((th + IZR k * (2 * PI)) / (2 * PI)) = IZR D * (th / (2 * PI)) + IZR k * IZR D).
  { intros th k. field. apply Rgt_not_eq, PI_RGT_0. }
  assert (less : forall i j th w k, (i < j)%nat -> (i < length hs)%nat -> (j < length hs)%nat ->
    in_set (nth i hs no_set) th w -> ~ in_set (nth j hs no_set) (th + IZR k * (2 * PI)) w).
  { intros i j th w k o hi hj h1 h2. destruct (seen _ _ _ hi h1) as (A & eA & cA & inA). destruct (seen _ _ _ hj h2) as (B & eB & cB & inB).
    rewrite turned in inB. specialize (apart i j A B o eA eB). rewrite (is_apart_sound D positive A B _ k cA cB inA inB) in apart. discriminate. }
  intros i j th w k hi hj h1 h2. destruct (Nat.lt_total i j) as [o|[->|o]].
  - destruct (less i j th w k o hi hj h1 h2).
  - destruct (seen _ _ _ hj h1) as (A & eA & cA & inA). destruct (seen _ _ _ hj h2) as (B & eB & _ & inB). rewrite turned in inB.
    rewrite eA in eB. injection eB as <-. split; [reflexivity|]. exact (is_alone_sound D positive A _ k cA (alone j A eA) inA inB).
  - exfalso. apply (less j i (th + IZR k * (2 * PI)) w (- k)%Z o hj hi h2). rewrite opp_IZR. replace (th + _ + _) with th by ring. exact h1.
Qed.

(* The listed values, as exact data. *)
Definition mean_number (f : Q * Q -> number) (a b : Q * Q) : number := Over (Plus (f a) (f b)) (Rational 2).
Definition half_number (a : number) : number := Over a (Rational 2).
Definition phase_number (c : Q * Q) : number := Times (Times (Rational 2) Pi) (Rational (fst c)).
Definition speed_number (c : Q * Q) : number := Rational (snd c).
Definition listed_numbers (h : h_set) : list (number * Q) :=
  let lb := left_bottom h in let lt := left_top h in let rb := right_bottom h in let rt := right_top h in
  let along f := half_number (Minus (mean_number f rb rt) (mean_number f lb lt)) in
  let across f := half_number (Minus (mean_number f lt rt) (mean_number f lb rb)) in
  let all f := half_number (Plus (mean_number f lb lt) (mean_number f rb rt)) in
  [(all phase_number, fst (set_middle h)); (all speed_number, snd (set_middle h));
    (along phase_number, fst (set_expanding h)); (along speed_number, snd (set_expanding h));
    (across phase_number, fst (set_contracting h)); (across speed_number, snd (set_contracting h))].
Lemma listed_numbers_sound h : (forall a r, In (a, r) (listed_numbers h) -> nearly (value a) (Q2R r)) -> as_listed h.
Proof.
  assert (two : Q2R 2 = 2) by (unfold Q2R; cbn; field). intros all. unfold as_listed, mean, phase_of, speed_of. cbv zeta.
  repeat split; match goal with |- nearly _ (Q2R ?r) => match eval unfold listed_numbers in (listed_numbers h) with context [(?a, r)] =>
    assert (one : nearly (value a) (Q2R r)) by (apply all; cbn; tauto) end end; cbn [value half_number mean_number phase_number speed_number] in one;
    rewrite two in one; exact one.
Qed.

Module Sets (F : FloatOps with Definition sensible_format := true).
Module Import Each := Enclosure F.
Local Opaque add sub mul quotient whole hull.

Definition is_nearly (p : positive) (x : number * Q) : bool :=
  let off := sub p (enclose p (fst x)) (known_number p (snd x)) in let least := quotient p (whole p 1) (whole p (10 ^ 9)) in
  is_not_negative (sub p least off) && is_not_negative (add p least off).
Definition check_listed (p : positive) (h : h_set) : bool := forallb (is_nearly p) (listed_numbers h).
Lemma is_nearly_sound p a r : is_nearly p (a, r) = true -> nearly (value a) (Q2R r).
Proof.
  unfold is_nearly, nearly. cbv zeta. cbn [fst snd]. intros h. apply andb_prop in h as [above below].
  assert (hl : holds (quotient p (whole p 1) (whole p (10 ^ 9))) (1 / IZR (10 ^ 9))) by (apply holds_quotient; apply holds_whole).
  assert (ho := holds_sub p _ _ _ _ (holds_enclose p a) (holds_number p r)).
  assert (h1 := is_not_negative_sound _ _ above (holds_sub p _ _ _ _ hl ho)). assert (h2 := is_not_negative_sound _ _ below (holds_add p _ _ _ _ hl ho)).
  cbn [value] in h1, h2. replace (1 / IZR (10 ^ 9)) with (/ 10 ^ 9) in h1, h2 by (change (10 ^ 9)%Z with 1000000000%Z; field). apply Rabs_le. lra.
Qed.
Lemma check_listed_sound p h : check_listed p h = true -> as_listed h.
Proof.
  unfold check_listed. rewrite forallb_forall. intros all. apply listed_numbers_sound. intros a r i. exact (is_nearly_sound p a r (all _ i)).
Qed.

(* A parallelogram is on the left of an edge, 2 pi times as far as it is in forcing periods. *)
Definition check_edge (p q : positive) (N : chart) (edge : (Q * Q) * (Q * Q)) : bool :=
  let pt := point p (unit_step p q) in let one := hull (whole p (-1)) (whole p 1) in
  let a := fst edge in let b := snd edge in let turn := mul p (whole p 2) (I.pi (F.PtoP p)) in
  let by_speed := mul p turn (sub p (known_number p (fst b)) (known_number p (fst a))) in let by_phase := sub p (known_number p (snd b)) (known_number p (snd a)) in
  let middle := sub p (mul p by_speed (sub p (I.neg (pt (cv N))) (known_number p (snd a))))
    (mul p by_phase (sub p (pt (cu N)) (mul p turn (known_number p (fst a))))) in
  let change u v := mul p (sub p (mul p by_speed (I.neg (pt v))) (mul p by_phase (pt u))) one in
  is_not_negative (add p (add p middle (change (lu N) (lv N))) (change (wu N) (wv N))).
Definition check_inside (p q : positive) (h : h_set) (N : chart) : bool := (0 <? chart_area N)%Z && forallb (check_edge p q N) (edges h).
Lemma check_edge_sound p q N edge x : 0 < area (frame_of q N) -> check_edge p q N edge = true -> in_frame (frame_of q N) x ->
  left_of (fst edge) (snd edge) (fst x / (2 * PI)) (- snd x).
Proof.
  destruct edge as [a b]. unfold check_edge. cbv zeta. cbn [fst snd]. intros areaN check [hxi heta].
  rewrite <- (put_back (frame_of q N) x) by (apply Rgt_not_eq, areaN).
  set (xi := along _ x) in *. set (eta := across _ x) in *. unfold put, frame_of. cbn [fst snd centre long wide].
  assert (one : forall y, -1 <= y <= 1 -> holds (hull (whole p (-1)) (whole p 1)) y) by (intros y; apply holds_hull; apply holds_whole).
  assert (h1 := one xi hxi). assert (h2 := one eta heta). set (unit := hull _ _) in *.
  assert (ht : holds (mul p (whole p 2) (I.pi (F.PtoP p))) (2 * PI)) by (apply holds_mul; [apply holds_whole|apply I.pi_correct]).
  set (turn := mul p _ (I.pi _)) in *.
  assert (hp : forall n, holds (point p (unit_step p q) n) (grid q n)) by (intros n; apply holds_point, unit_step_holds).
  assert (ha := holds_number p (fst a)). assert (ha' := holds_number p (snd a)). assert (hb := holds_number p (fst b)). assert (hb' := holds_number p (snd b)).
  assert (u0 := hp (cu N)). assert (v0 := hp (cv N)). assert (u1 := hp (lu N)). assert (v1 := hp (lv N)). assert (u2 := hp (wu N)). assert (v2 := hp (wv N)).
  set (by_speed := 2 * PI * (Q2R (fst b) - Q2R (fst a))). set (by_phase := Q2R (snd b) - Q2R (snd a)).
  set (at_middle := by_speed * (- grid q (cv N) - Q2R (snd a)) - by_phase * (grid q (cu N) - 2 * PI * Q2R (fst a))).
  set (by_xi := by_speed * - grid q (lv N) - by_phase * grid q (lu N)). set (by_eta := by_speed * - grid q (wv N) - by_phase * grid q (wu N)).
  match type of check with is_not_negative ?E = true => assert (held : holds E (at_middle + by_xi * xi + by_eta * eta)) end.
  { unfold at_middle, by_xi, by_eta, by_speed, by_phase. enclose. }
  apply (is_not_negative_sound _ _ check) in held. assert (pi := PI_RGT_0). unfold left_of.
  apply (Rmult_le_reg_l (2 * PI)); [lra|]. rewrite Rmult_0_r. match type of held with _ <= ?r => replace (2 * PI * _) with r; [exact held|] end.
  unfold at_middle, by_xi, by_eta, by_speed, by_phase. field. lra.
Qed.
Lemma check_inside_sound p q h N : check_inside p q h N = true -> forall x, in_frame (frame_of q N) x -> in_set h (fst x) (- snd x).
Proof.
  unfold check_inside. intros check x hx. apply andb_prop in check as [areaN check]. apply Z.ltb_lt, (chart_area_positive q) in areaN.
  rewrite forallb_forall in check. apply List.Forall_forall. intros edge i. exact (check_edge_sound p q N edge x areaN (check edge i) hx).
Qed.

Fixpoint all_inside (p q : positive) (hs : list h_set) (charts : list chart) : bool := match hs, charts with
  | [], [] => true | h :: hs, N :: charts => check_inside p q h N && all_inside p q hs charts | _, _ => false end.
(* p bits of interval arithmetic; the parallelograms, one for each h-set, on the grid 2^-q. *)
Definition check_h_sets (p q : positive) (hs : list h_set) (charts : list chart) : bool :=
  all_inside p q hs charts && forallb (check_listed p) hs && check_disjoint hs.

Lemma all_inside_sound p q hs : forall charts, all_inside p q hs charts = true -> length charts = length hs /\
  forall n h N, nth_error hs n = Some h -> nth_error charts n = Some N -> check_inside p q h N = true.
Proof.
  induction hs as [|h0 hs IH]; intros [|N0 charts] check; try discriminate; [split; [reflexivity|intros []; discriminate]|].
  apply andb_prop in check as [first rest]. destruct (IH charts rest) as [same all]. split; [cbn; lia|].
  intros [|n] h N; [intros [= <-] [= <-]; exact first|exact (all n h N)].
Qed.
Theorem h_sets_checked p q hs charts : check_h_sets p q hs charts = true -> disjoint_list hs /\ List.Forall as_listed hs /\ length charts = length hs /\
  forall n h N, nth_error hs n = Some h -> nth_error charts n = Some N -> forall x, in_frame (frame_of q N) x -> in_set h (fst x) (- snd x).
Proof.
  unfold check_h_sets. intros check. apply andb_prop in check as [check disjoint]. apply andb_prop in check as [insides lists]. rewrite forallb_forall in lists.
  apply all_inside_sound in insides as [same all]. split; [exact (check_disjoint_sound hs disjoint)|]. split; [|split; [exact same|]].
  - apply List.Forall_forall. intros h i. exact (check_listed_sound p h (lists h i)).
  - intros n h N eh eN. exact (check_inside_sound p q h N (all n h N eh eN)).
Qed.
End Sets.
