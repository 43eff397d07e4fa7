(* Fixed points of a round of flights, checked by evaluation: a program `check_disc`, and the proof that in an ellipse of states which it accepts
   exactly one state comes back after the round, some forcing periods later; that the trace of the product of the matrices (A.7) is enclosed; and that
   all states of the ellipse tend to it where Newton's matrix is -1.

   In the coordinates of the ellipse the round is p, of the unit disc; s - K (p s - s) is a contraction of it. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Horseshoe Return Covering Certificate Document Banach Jacobian Rounds.
Open Scope R_scope.
Import ListNotations.

(* An ellipse: its centre, and two half vectors. The factor of the contraction, and Newton's matrix, in units of 2^-scale; the round. *)
Record disc := Disc { disc_bits : positive; disc_scale : positive; disc_chart : chart; factor : Z; newton : matrix Z; way : list passage }.

Definition coordinates (N : frame) (x : state) : state := (along N x, across N x).
Definition in_ellipse (N : frame) (x : state) : Prop := Cmod (coordinates N x) <= 1.
Definition placed (N : frame) (x : state) : state := put N (fst x) (snd x).
Lemma coordinates_placed N x : area N <> 0 -> coordinates N (placed N x) = x.
Proof. intros h. unfold coordinates, placed. rewrite put_along, put_across by exact h. symmetry. apply surjective_pairing. Qed.
Lemma placed_coordinates N x : area N <> 0 -> placed N (coordinates N x) = x.
Proof. intros h. unfold coordinates, placed. cbn [fst snd]. apply put_back, h. Qed.
Definition vectors (N : frame) : matrix R := Matrix (fst (long N)) (fst (wide N)) (snd (long N)) (snd (wide N)).
Definition covectors (N : frame) : matrix R :=
  Matrix (snd (wide N) / area N) (- fst (wide N) / area N) (- snd (long N) / area N) (fst (long N) / area N).
Lemma coordinates_differ N x y : area N <> 0 -> minus_ (coordinates N x) (coordinates N y) = act (covectors N) (minus_ x y).
Proof. intros h. unfold minus_, act, covectors, coordinates, along, across, along_area, across_area. cbn [fst snd m11 m12 m21 m22]. apply injective_projections; cbn [fst snd]; field; exact h. Qed.
Lemma placed_differ N x y : minus_ (placed N x) (placed N y) = act (vectors N) (minus_ x y).
Proof. unfold minus_, act, vectors, placed, put. cbn [fst snd m11 m12 m21 m22]. apply injective_projections; cbn [fst snd]; ring. Qed.
Lemma similar_trace N M : area N <> 0 -> trace (times (covectors N) (times M (vectors N))) = trace M.
Proof. intros h. unfold trace, times, covectors, vectors. cbn [m11 m12 m21 m22]. unfold area in *. field. exact h. Qed.
Lemma minus_apart x y : apart x y = Cmod (minus_ x y).
Proof. reflexivity. Qed.

Module Discs (F : FloatOps with Definition sensible_format := true).
Module Import Round := Rounds F.
Import Round.Each.
Import Round.Each.Check.
Local Opaque add sub mul quotient whole hull sine cosine.

Section Program.
Variable param : data.
Variable w : wall.
Variable cycles : Z.
Variable h : disc.
Let p := disc_bits h.
Let q := disc_scale h.
Let N := disc_chart h.
Notation step := (unit_step p q).
Notation pt := (point p step).
Let walls := map onto (way h).

Definition all_starts : cell := Cell (cu N) (Z.abs (lu N) + Z.abs (wu N)) (cv N) (Z.abs (lv N) + Z.abs (wv N)).
Definition centre_start : cell := Cell (cu N) 0 (cv N) 0.
Definition start_vectors : matrix I.type := Matrix (pt (lu N)) (pt (wu N)) (pt (lv N)) (pt (wv N)).
Definition area_in : I.type := sub p (mul p (pt (lu N)) (pt (wv N))) (mul p (pt (lv N)) (pt (wu N))).
Definition covectors_in : matrix I.type := Matrix (quotient p (pt (wv N)) area_in) (quotient p (I.neg (pt (wu N))) area_in)
  (quotient p (I.neg (pt (lv N))) area_in) (quotient p (pt (lu N)) area_in).
Definition round_slopes : matrix I.type := multiply p covectors_in (slopes_at_end p q param w all_starts start_vectors (way h)).
Definition trace_in : I.type := add p (m11 round_slopes) (m22 round_slopes).
Definition shift_in : I.type := mul p (whole p cycles) (mul p (whole p 2) (I.pi (F.PtoP p))).
(* Coordinates of the states of a box; and that it is in the ellipse. *)
Definition along_in (X V : I.type) : I.type := add p (mul p (m11 covectors_in) (sub p X (pt (cu N)))) (mul p (m12 covectors_in) (sub p V (pt (cv N)))).
Definition across_in (X V : I.type) : I.type := add p (mul p (m21 covectors_in) (sub p X (pt (cu N)))) (mul p (m22 covectors_in) (sub p V (pt (cv N)))).
Definition square (X : I.type) : I.type := mul p X X.
Definition has_box (X V : I.type) : bool :=
  is_not_negative (sub p (whole p 1) (add p (square (along_in X V)) (square (across_in X V)))).

(* 1 - K (G - 1), and K (p 0 - 0). *)
Definition remainder : matrix I.type :=
  let K := newton h in let G := round_slopes in
  let one := sub p (m11 G) (whole p 1) in let other := sub p (m22 G) (whole p 1) in
  Matrix (sub p (whole p 1) (add p (mul p (pt (m11 K)) one) (mul p (pt (m12 K)) (m21 G))))
    (I.neg (add p (mul p (pt (m11 K)) (m12 G)) (mul p (pt (m12 K)) other)))
    (I.neg (add p (mul p (pt (m21 K)) one) (mul p (pt (m22 K)) (m21 G))))
    (sub p (whole p 1) (add p (mul p (pt (m21 K)) (m12 G)) (mul p (pt (m22 K)) other))).
Definition moved : I.type * I.type :=
  let C := centre_at_end centre_start (way h) in let X := sub p (phases_of p q C) shift_in in let V := speeds_of p q C in
  let a := along_in X V in let b := across_in X V in let K := newton h in
  (add p (mul p (pt (m11 K)) a) (mul p (pt (m12 K)) b), add p (mul p (pt (m21 K)) a) (mul p (pt (m22 K)) b)).
Definition check_disc : bool :=
  let M := remainder in let g := square (pt (factor h)) in
  let a := sub p g (add p (square (m11 M)) (square (m21 M))) in let d := sub p g (add p (square (m12 M)) (square (m22 M))) in
  let b := add p (mul p (m11 M) (m12 M)) (mul p (m21 M) (m22 M)) in
  let left_over := sub p (whole p 1) (pt (factor h)) in
  (0 <? chart_area N)%Z &? (0 <=? factor h)%Z &? (factor h <? 2 ^ Zpos q)%Z &? negb (m11 (newton h) * m22 (newton h) =? m12 (newton h) * m21 (newton h))%Z &?
  same_wall w (last walls (opposite w)) &?
  check_passages p q param w all_starts centre_start start_vectors (way h) &?
  is_positive a &? is_not_negative (sub p (mul p a d) (square b)) &?
  is_not_negative (sub p (square left_over) (add p (square (fst moved)) (square (snd moved)))).
(* Newton's matrix is -1. *)
Definition is_plain : bool := (m11 (newton h) =? - 2 ^ Zpos q)%Z &? (m22 (newton h) =? - 2 ^ Zpos q)%Z &? (m12 (newton h) =? 0)%Z &? (m21 (newton h) =? 0)%Z.

Variable s : scene.
Hypothesis described : describes param s.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.
Hypothesis checked : check_disc = true.
Let N_ := frame_of q N.
Let P (x : state) : state := turned cycles (fly_on s w walls x).

Lemma area_positive : 0 < area N_.
Proof. assert (c := checked). unfold check_disc in c. cbv zeta in c. split_checks. apply chart_area_positive, Z.ltb_lt. assumption. Qed.
Lemma area_nonzero : area N_ <> 0.
Proof. assert (a := area_positive). lra. Qed.
Lemma holds_at n : holds (pt n) (grid q n).
Proof. apply holds_point, unit_step_holds. Qed.
Lemma holds_covectors : holds_each covectors_in (covectors N_).
Proof.
  assert (h3 := holds_at (lu N)). assert (h4 := holds_at (lv N)). assert (h5 := holds_at (wu N)). assert (h6 := holds_at (wv N)).
  unfold holds_each, covectors_in, covectors, area, N_, frame_of, area_in. cbn [m11 m12 m21 m22 long wide fst snd]. repeat split; enclose.
Qed.
Lemma holds_coordinates X V x : holds X (fst x) -> holds V (snd x) -> holds (along_in X V) (along N_ x) /\ holds (across_in X V) (across N_ x).
Proof.
  intros hX hV. destruct holds_covectors as (c1 & c2 & c3 & c4). assert (h1 := holds_at (cu N)). assert (h2 := holds_at (cv N)). assert (a := area_nonzero).
  assert (e1 : along N_ x = m11 (covectors N_) * (fst x - grid q (cu N)) + m12 (covectors N_) * (snd x - grid q (cv N))).
  { unfold along, along_area, covectors, N_, frame_of. cbn [m11 m12 centre long wide fst snd]. field. exact a. }
  assert (e2 : across N_ x = m21 (covectors N_) * (fst x - grid q (cu N)) + m22 (covectors N_) * (snd x - grid q (cv N))).
  { unfold across, across_area, covectors, N_, frame_of. cbn [m21 m22 centre long wide fst snd]. field. exact a. }
  rewrite e1, e2. unfold along_in, across_in. split; enclose.
Qed.
Lemma holds_square X x : holds X x -> holds (square X) (x ^ 2).
Proof. intros hx. replace (x ^ 2) with (x * x) by ring. unfold square. enclose. Qed.
Lemma has_box_sound X V x : has_box X V = true -> holds X (fst x) -> holds V (snd x) -> in_ellipse N_ x.
Proof.
  intros check hX hV. destruct (holds_coordinates X V x hX hV) as [h1 h2]. apply holds_square in h1, h2.
  assert (le : 0 <= 1 - (along N_ x ^ 2 + across N_ x ^ 2)) by (apply (is_not_negative_sound _ _ check); enclose).
  apply modulus_below; [lra|]. cbn [coordinates fst snd]. lra.
Qed.

Lemma start_family : family q all_starts centre_start start_vectors (placed N_).
Proof.
  assert (c := checked). unfold check_disc in c. cbv zeta in c. split_checks. apply Z.ltb_lt in k. assert (a := area_nonzero).
  assert (around : forall n r x, Rabs (x - grid q n) <= grid q r -> grid q (n - r) <= x <= grid q (n + r)).
  { intros n r x hx. apply Rabs_le_between in hx. unfold Z.sub. rewrite !grid_plus, grid_opp. lra. }
  split; [|split].
  - intros x hx. destruct (modulus_at_least x) as [x1 x2]. assert (x1' : Rabs (fst x) <= 1) by lra. assert (x2' : Rabs (snd x) <= 1) by lra. apply Rabs_le_between in x1', x2'.
    destruct (chart_bounds q N (placed N_ x) k) as [b1 b2].
    { unfold in_frame, slice, placed. fold N_. rewrite put_along, put_across by exact a. split; assumption. }
    split; apply around; assumption.
  - assert (c0 : grid q 0 = 0) by (unfold grid; ring). unfold lies, centre_start, placed, put, N_, frame_of. cbn [at_t by_t at_v by_v fst snd centre long wide].
    rewrite !Rmult_0_r, !Rplus_0_r. unfold Z.sub. rewrite !Z.add_0_r. lra.
  - intros x y _ _. exists (vectors N_). split; [|apply placed_differ].
    unfold holds_each, start_vectors, vectors, N_, frame_of. cbn [m11 m12 m21 m22 long wide fst snd]. repeat split; apply holds_at.
Qed.

Lemma inside_placed x : in_ellipse N_ x -> Cmod (coordinates N_ x) <= 1 /\ placed N_ (coordinates N_ x) = x.
Proof. intros e. split; [exact e|]. apply placed_coordinates, area_nonzero. Qed.
Lemma placed_inside x : Cmod x <= 1 -> in_ellipse N_ (placed N_ x).
Proof. intros e. unfold in_ellipse. rewrite coordinates_placed by apply area_nonzero. exact e. Qed.

Lemma way_checked : check_passages p q param w all_starts centre_start start_vectors (way h) = true.
Proof. assert (c := checked). unfold check_disc in c. cbv zeta in c. split_checks. reflexivity. Qed.
Lemma walls_come_back : last walls (opposite w) = w.
Proof.
  assert (c := checked). unfold check_disc in c. cbv zeta in c. split_checks.
  symmetry. apply same_wall_sound. assumption.
Qed.
Lemma some_walls : way h <> [].
Proof. intros none. assert (b := walls_come_back). unfold walls in b. rewrite none in b. cbn in b. clear - b. destruct w; discriminate b. Qed.

Theorem disc_flies x : in_ellipse N_ x -> all_fly s w walls x /\ visits q s w all_starts (way h) x.
Proof.
  intros e. destruct (inside_placed x e) as [i <-]. exact (proj1 (passages_sound p q param s described A_positive W_positive gap_positive _ _ _ _ _ _ way_checked start_family) _ i).
Qed.

Let in_disc (x : state) : state := coordinates N_ (P (placed N_ x)).
Let K : matrix R := Matrix (grid q (m11 (newton h))) (grid q (m12 (newton h))) (grid q (m21 (newton h))) (grid q (m22 (newton h))).
Let f (x : state) : state := minus_ x (act K (minus_ (in_disc x) x)).
Let g : R := grid q (factor h).

Lemma round_differs x y : Cmod x <= 1 -> Cmod y <= 1 -> exists M, holds_each round_slopes M /\ minus_ (in_disc x) (in_disc y) = act M (minus_ x y).
Proof.
  intros hx hy. destruct (passages_sound p q param s described A_positive W_positive gap_positive _ _ _ _ _ _ way_checked start_family) as (_ & (B & _ & _ & differ) & _).
  destruct (differ x y hx hy) as (M & hM & eq). exists (times (covectors N_) M). split; [exact (holds_multiply p _ _ _ _ holds_covectors hM)|].
  rewrite act_times, <- eq. unfold in_disc. rewrite coordinates_differ by apply area_nonzero. f_equal. unfold P, turned, minus_. cbn [fst snd]. f_equal. fold walls. ring.
Qed.
Lemma factor_range : 0 <= g < 1.
Proof.
  assert (c := checked). unfold check_disc in c. cbv zeta in c. split_checks. apply Z.leb_le in k0. apply Z.ltb_lt in k1.
  assert (c0 : grid q 0 = 0) by (unfold grid; ring). split; [rewrite <- c0; apply grid_le; exact k0|].
  apply IZR_lt in k1. unfold g, grid. assert (0 < IZR (2 ^ Zpos q)) by (apply IZR_lt, Z.pow_pos_nonneg; lia).
  apply (Rmult_lt_reg_l (IZR (2 ^ Zpos q))); [assumption|]. rewrite <- Rmult_assoc, Rinv_r by lra. lra.
Qed.
Lemma newton_contracts x y : Cmod x <= 1 -> Cmod y <= 1 -> apart (f x) (f y) <= g * apart x y.
Proof.
  intros hx hy. destruct (round_differs x y hx hy) as (M & (n1 & n2 & n3 & n4) & eq). rewrite !minus_apart.
  set (R1 := Matrix (1 - (m11 K * (m11 M - 1) + m12 K * m21 M)) (- (m11 K * m12 M + m12 K * (m22 M - 1)))
    (- (m21 K * (m11 M - 1) + m22 K * m21 M)) (1 - (m21 K * m12 M + m22 K * (m22 M - 1)))).
  assert (differ : minus_ (f x) (f y) = (m11 R1 * fst (minus_ x y) + m12 R1 * snd (minus_ x y), m21 R1 * fst (minus_ x y) + m22 R1 * snd (minus_ x y))).
  { assert (e1 := f_equal fst eq). assert (e2 := f_equal snd eq). unfold act in e1, e2. cbn [fst snd minus_] in e1, e2.
    unfold f, minus_, act, R1. cbn [fst snd m11 m12 m21 m22]. set (i := in_disc x) in *. set (j := in_disc y) in *.
    assert (i1 : fst i = fst j + (m11 M * (fst x - fst y) + m12 M * (snd x - snd y))) by lra.
    assert (i2 : snd i = snd j + (m21 M * (fst x - fst y) + m22 M * (snd x - snd y))) by lra.
    rewrite i1, i2. apply injective_projections; cbn [fst snd]; ring. }
  assert (k1 := holds_at (m11 (newton h))). assert (k2 := holds_at (m12 (newton h))). assert (k3 := holds_at (m21 (newton h))). assert (k4 := holds_at (m22 (newton h))).
  assert (hR : holds_each remainder R1).
  { unfold remainder, R1, K, holds_each. cbv zeta. cbn [m11 m12 m21 m22]. repeat split; enclose. }
  destruct hR as (r1 & r2 & r3 & r4). assert (c := checked). unfold check_disc in c. cbv zeta in c. split_checks.
  assert (hg := holds_square _ _ (holds_at (factor h))). fold g in hg.
  assert (s1 := holds_square _ _ r1). assert (s2 := holds_square _ _ r2). assert (s3 := holds_square _ _ r3). assert (s4 := holds_square _ _ r4).
  rewrite differ. rewrite (surjective_pairing (minus_ x y)) at 5. apply shortens; [apply factor_range| |].
  - match goal with pos : is_positive _ = true |- _ => apply (is_positive_sound _ _ pos) end. enclose.
  - match goal with pos : is_not_negative (sub p (mul p _ _) _) = true |- _ => apply (is_not_negative_sound _ _ pos) end.
    apply holds_sub; [enclose|]. apply holds_square. enclose.
Qed.
Lemma newton_middle : Cmod (f (RtoC 0)) <= 1 - g.
Proof.
  destruct (passages_sound p q param s described A_positive W_positive gap_positive _ _ _ _ _ _ way_checked start_family) as (_ & (B & _ & middle & _) & _).
  destruct (holds_cell p q _ _ middle) as [hX hV]. change (map onto (way h)) with walls in hX, hV.
  assert (hS : holds shift_in (IZR cycles * (2 * PI))).
  { unfold shift_in. apply holds_mul; [apply holds_whole|]. apply holds_mul; [apply holds_whole|apply I.pi_correct]. }
  assert (hX' := holds_sub p _ _ _ _ hX hS). set (y := P (placed N_ (0, 0))).
  destruct (holds_coordinates _ _ y hX' hV) as [h1 h2].
  assert (k1 := holds_at (m11 (newton h))). assert (k2 := holds_at (m12 (newton h))). assert (k3 := holds_at (m21 (newton h))). assert (k4 := holds_at (m22 (newton h))).
  set (a := along N_ y) in *. set (b := across N_ y) in *.
  assert (value : f (RtoC 0) = (- (m11 K * a + m12 K * b), - (m21 K * a + m22 K * b))).
  { unfold f, in_disc, RtoC. fold y. unfold minus_, act, coordinates. fold a b. cbn [fst snd]. apply injective_projections; cbn [fst snd]; ring. }
  rewrite value. assert (fr := factor_range). apply modulus_below; [lra|]. cbn [fst snd].
  assert (c := checked). unfold check_disc in c. cbv zeta in c. split_checks.
  assert (hg := holds_at (factor h)). fold g in hg.
  assert (m1 : holds (fst moved) (m11 K * a + m12 K * b)) by (unfold moved, K; cbv zeta; cbn [fst snd m11 m12]; enclose).
  assert (m2 : holds (snd moved) (m21 K * a + m22 K * b)) by (unfold moved, K; cbv zeta; cbn [fst snd m21 m22]; enclose).
  apply holds_square in m1, m2. assert (left_over := holds_square _ _ (holds_sub p _ _ _ _ (holds_whole p 1) hg)).
  assert (0 <= (1 - g) ^ 2 - ((m11 K * a + m12 K * b) ^ 2 + (m21 K * a + m22 K * b) ^ 2)) by (apply (is_not_negative_sound _ _ c); enclose).
  replace ((- (m11 K * a + m12 K * b)) ^ 2) with ((m11 K * a + m12 K * b) ^ 2) by ring.
  replace ((- (m21 K * a + m22 K * b)) ^ 2) with ((m21 K * a + m22 K * b) ^ 2) by ring. lra.
Qed.
Lemma newton_fixed x : f x = x <-> in_disc x = x.
Proof.
  split; intros e.
  - assert (regular : m11 K * m22 K - m12 K * m21 K <> 0).
    { assert (c := checked). unfold check_disc in c. cbv zeta in c. split_checks. apply negb_true_iff, Z.eqb_neq in k2.
      unfold K, grid. cbn [m11 m12 m21 m22]. assert (st := grid_step q). set (r := / IZR (2 ^ Zpos q)) in *. intros z. apply k2.
      apply eq_IZR. rewrite !mult_IZR. assert (r * r * (IZR (m11 (newton h)) * IZR (m22 (newton h)) - IZR (m12 (newton h)) * IZR (m21 (newton h))) = 0) by lra.
      apply Rmult_integral in H. destruct H as [H|H]; [apply Rmult_integral in H; destruct H; lra|lra]. }
    assert (e1 := f_equal fst e). assert (e2 := f_equal snd e). unfold f, minus_, act in e1, e2. cbn [fst snd] in e1, e2.
    set (y := in_disc x) in *. set (a := fst y - fst x) in *. set (b := snd y - snd x) in *.
    assert (z1 : m11 K * a + m12 K * b = 0) by lra. assert (z2 : m21 K * a + m22 K * b = 0) by lra.
    assert (a0 : (m11 K * m22 K - m12 K * m21 K) * a = 0).
    { replace ((m11 K * m22 K - m12 K * m21 K) * a) with (m22 K * (m11 K * a + m12 K * b) - m12 K * (m21 K * a + m22 K * b)) by ring. rewrite z1, z2. ring. }
    assert (b0 : (m11 K * m22 K - m12 K * m21 K) * b = 0).
    { replace ((m11 K * m22 K - m12 K * m21 K) * b) with (m11 K * (m21 K * a + m22 K * b) - m21 K * (m11 K * a + m12 K * b)) by ring. rewrite z1, z2. ring. }
    apply Rmult_integral in a0, b0. destruct a0 as [a0|a0]; [contradiction|]. destruct b0 as [b0|b0]; [contradiction|].
    apply injective_projections; unfold a, b in *; lra.
  - unfold f. rewrite e. unfold minus_, act. cbn [fst snd]. destruct x. cbn [fst snd]. f_equal; ring.
Qed.
Lemma fixed_in_disc x : in_ellipse N_ x -> (P x = x <-> in_disc (coordinates N_ x) = coordinates N_ x).
Proof.
  intros e. unfold in_disc. rewrite placed_coordinates by apply area_nonzero. split; intros eq; [rewrite eq; reflexivity|].
  rewrite <- (placed_coordinates N_ (P x)), <- (placed_coordinates N_ x) at 1 by apply area_nonzero.
  rewrite (placed_coordinates N_ x) by apply area_nonzero. rewrite eq. apply placed_coordinates, area_nonzero.
Qed.

(* Exactly one state of the ellipse comes back. *)
Theorem disc_fixed : exists x, in_ellipse N_ x /\ P x = x /\ forall y, in_ellipse N_ y -> P y = y -> y = x.
Proof.
  destruct (banach f g factor_range newton_contracts newton_middle) as (x & hx & eq). exists (placed N_ x). assert (i := placed_inside x hx).
  apply newton_fixed in eq. split; [exact i|]. split; [apply (fixed_in_disc _ i); rewrite coordinates_placed by apply area_nonzero; exact eq|].
  intros y hy ey. apply (fixed_in_disc _ hy) in ey. apply newton_fixed in ey. apply newton_fixed in eq.
  assert (same := fixed_once f g factor_range newton_contracts _ _ hy hx ey eq). rewrite <- same. symmetry. apply placed_coordinates, area_nonzero.
Qed.

Theorem disc_trace x : in_ellipse N_ x -> P x = x -> holds trace_in (trace (monodromy s w walls x)) /\ det (monodromy s w walls x) = e s ^ (2 * length walls).
Proof.
  intros e eq. destruct (inside_placed x e) as [i back].
  destruct (passages_sound p q param s described A_positive W_positive gap_positive _ _ _ _ _ _ way_checked start_family) as (_ & _ & product & dets). split.
  - assert (own : holds_each start_vectors (vectors N_)).
    { unfold holds_each, start_vectors, vectors, N_, frame_of. cbn [m11 m12 m21 m22 long wide fst snd]. repeat split; apply holds_at. }
    assert (end_ := product _ (vectors N_) i own). rewrite back in end_. assert (all := holds_multiply p _ _ _ _ holds_covectors end_).
    rewrite <- (similar_trace N_ (monodromy s w walls x)) by apply area_nonzero. destruct all as (a & _ & _ & b). unfold trace_in, round_slopes, trace. enclose.
  - destruct (dets _ i some_walls) as [moves value]. rewrite back in moves, value. fold walls in moves, value.
    assert (same := f_equal snd eq). unfold P, turned in same. cbn [snd] in same. rewrite same in moves, value. unfold walls at 2. rewrite map_length.
    apply (Rmult_eq_reg_r (snd x)); [exact value|exact moves].
Qed.

(* All states of the ellipse tend to the one that comes back. *)
Theorem disc_attracts x y : is_plain = true -> in_ellipse N_ x -> P x = x -> in_ellipse N_ y -> forall n,
  in_ellipse N_ (Nat.iter n P y) /\ apart (coordinates N_ (Nat.iter n P y)) (coordinates N_ x) <= g ^ n * apart (coordinates N_ y) (coordinates N_ x).
Proof.
  intros plain hx eq hy n. unfold is_plain in plain. split_checks. apply Z.eqb_eq in k, k0, k1, plain.
  assert (whole_unit : grid q (2 ^ Zpos q) = 1).
  { unfold grid. field. apply not_0_IZR. assert (0 < 2 ^ Zpos q)%Z by (apply Z.pow_pos_nonneg; lia). lia. }
  assert (c0 : grid q 0 = 0) by (unfold grid; ring).
  assert (is_f : forall z, f z = in_disc z).
  { intros z. unfold f, K. rewrite k, k0, k1, plain. rewrite grid_opp, whole_unit, c0. unfold minus_, act. cbn [fst snd m11 m12 m21 m22]. apply injective_projections; cbn [fst snd]; ring. }
  assert (fixed : f (coordinates N_ x) = coordinates N_ x) by (rewrite is_f; apply (fixed_in_disc x hx), eq).
  assert (same : forall n, Nat.iter n f (coordinates N_ y) = coordinates N_ (Nat.iter n P y)).
  { intros m. induction m as [|m IH]; [reflexivity|]. change (f (Nat.iter m f (coordinates N_ y)) = coordinates N_ (P (Nat.iter m P y))).
    rewrite IH, is_f. unfold in_disc. rewrite placed_coordinates by apply area_nonzero. reflexivity. }
  destruct (nearer f g factor_range newton_contracts newton_middle _ _ n hx hy fixed) as [inside near]. rewrite same in inside, near. split; assumption.
Qed.
End Program.
End Discs.
