(* A program `check_cycle` that verifies the claims of a document about a periodic orbit (Cycle.v), with the proof that it is right
   (`cycle_sound`). A wide ellipse of states contains all that the bounds of the first impact allow, a narrow one, inside it, gives the bounds: in
   both exactly one state comes back after the round, so that it is the same. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Horseshoe Return Covering Certificate Document Turns Jacobian Rounds Discs Cycle.
Open Scope R_scope.
Import ListNotations.

(* The mirror image of impact n is the first one, 2 k + 1 half periods later; or none is: whole forcing periods below the difference of phases. *)
Inductive mirroring := Mirror_of (n : nat) (k : Z) | No_mirror (turns : list Z).
Record surroundings := Surroundings { wide_disc : disc; narrow_disc : disc; spot_turns : list Z; first_turns : Z; mirroring_of : mirroring }.

Fixpoint same_walls (a b : list wall) : bool :=
  match a, b with [], [] => true | x :: a, y :: b => same_wall x y && same_walls a b | _, _ => false end.
Lemma same_walls_sound a : forall b, same_walls a b = true -> a = b.
Proof.
  induction a as [|x a IH]; intros [|y b]; cbn; try discriminate; [reflexivity|]. intros h. apply andb_prop in h as [e h]. rewrite (IH _ h).
  destruct x, y; cbn in e; congruence.
Qed.
Fixpoint same_names (a b : list mapping) : bool :=
  match a, b with [], [] => true | x :: a, y :: b => same_mapping (Some x) (Some y) && same_names a b | _, _ => false end.
Lemma same_names_sound a : forall b, same_names a b = true -> a = b.
Proof.
  induction a as [|x a IH]; intros [|y b]; cbn [same_names]; try discriminate; [reflexivity|]. intros h. apply andb_prop in h as [e h]. rewrite (IH _ h).
  apply same_mapping_sound in e. congruence.
Qed.
Fixpoint rational_power (x : Q) (n : nat) : Q := match n with O => 1%Q | S n => (x * rational_power x n)%Q end.
Lemma rational_power_value x n : Q2R (rational_power x n) = Q2R x ^ n.
Proof. induction n as [|n IH]; cbn; [unfold Q2R; cbn; lra|]. rewrite Q2R_mult, IH. reflexivity. Qed.

Lemma forall_nth {X : Type} (P : X -> Prop) d : forall m n xs, List.Forall P (firstn m xs) -> (n < m)%nat -> (n < length xs)%nat -> P (nth n xs d).
Proof.
  induction m as [|m IH]; intros n xs h lt len; [lia|]. destruct xs as [|x xs]; [cbn in len; lia|]. cbn in h. inversion h; subst.
  destruct n as [|n]; [assumption|]. cbn in *. apply IH; [assumption|lia|lia].
Qed.
Lemma forall2_nth {X Y : Type} (P : X -> Y -> Prop) a b xs ys : Forall2 P xs ys -> forall n, (n < length ys)%nat -> P (nth n xs a) (nth n ys b).
Proof. induction 1; intros [|n] h; cbn in *; try lia; [assumption|]. apply IHForall2. lia. Qed.

Module Cycles (F : FloatOps with Definition sensible_format := true).
Module Import Disc := Discs F.
Import Disc.Round.
Import Disc.Round.Each.
Import Disc.Round.Each.Check.
Local Opaque add sub mul quotient whole hull sine cosine.

Definition half_turns_in (p : positive) (k : Z) : I.type := mul p (whole p k) (I.pi (F.PtoP p)).
Lemma holds_half_turns p k : holds (half_turns_in p k) (IZR k * PI).
Proof. apply holds_mul; [apply holds_whole|apply I.pi_correct]. Qed.
(* Bounds of two impacts that are not one, whatever the periods between them. *)
Definition is_less (a b : Q) : bool := negb (Qle_bool b a).
Definition within_turn (a b : Q) : bool := is_positive (sub few (half_turns_in few 2) (sub few (known_number few b) (known_number few a))).
Definition apart_spots (a b : spot) : bool := let (p, p') := spot_phase a in let (r, r') := spot_phase b in
  negb (same_wall (spot_wall a) (spot_wall b)) || is_less (snd (spot_velocity a)) (fst (spot_velocity b)) || is_less (snd (spot_velocity b)) (fst (spot_velocity a)) ||
  (is_less p' r && within_turn p r') || (is_less r' p && within_turn r p').
Lemma is_less_sound a b : is_less a b = true -> Q2R a < Q2R b.
Proof.
  unfold is_less. intros h. apply negb_true_iff in h. apply Qlt_Rlt. apply Qnot_le_lt. intros le. apply Qle_bool_iff in le. congruence.
Qed.
Lemma within_turn_sound a b : within_turn a b = true -> Q2R b - Q2R a < 2 * PI.
Proof.
  intros h. assert (h1 := holds_number few a). assert (h2 := holds_number few b). assert (t := holds_half_turns few 2).
  assert (0 < IZR 2 * PI - (Q2R b - Q2R a)) by (apply (is_positive_sound _ _ h); enclose). lra.
Qed.
Lemma apart_spots_sound (s : scene) a b first first' i j : 0 < W s -> apart_spots a b = true -> shows_spot s first a i -> shows_spot s first' b j -> forall k, j <> periods_later s k i.
Proof.
  intros W_positive check (w1 & v1 & _ & k1 & p1 & _) (w2 & v2 & _ & k2 & p2 & _) k eq. subst j. unfold periods_later, later in *. cbn [wall_of velocity time] in *.
  replace (phase s (time i + IZR k * period s)) with (phase s (time i) + IZR k * (2 * PI)) in p2 by (unfold phase, period; field; lra).
  unfold apart_spots in check. destruct (spot_phase a) as [p p'], (spot_phase b) as [r r']. unfold in_bounds in *. cbn [fst snd] in *.
  assert (pi := PI_RGT_0). set (x := phase s (time i)) in *. set (m := (k2 - k1 - k)%Z).
  assert (differ : (x - IZR k1 * (2 * PI)) - (x + IZR k * (2 * PI) - IZR k2 * (2 * PI)) = IZR m * (2 * PI)) by (unfold m; rewrite !minus_IZR; ring).
  assert (no_turn : forall n, 0 < IZR n * (2 * PI) < 2 * PI -> False).
  { intros n [h1 h2]. assert (0 < IZR n) by nra. assert (IZR n < 1) by nra. apply lt_IZR in H, H0. lia. }
  repeat (apply orb_prop in check as [check|check]).
  - rewrite <- w1, <- w2 in check. destruct (wall_of i); discriminate check.
  - apply is_less_sound in check. lra.
  - apply is_less_sound in check. lra.
  - apply andb_prop in check as [c1 c2]. apply is_less_sound in c1. apply within_turn_sound in c2. apply (no_turn (- m)%Z). rewrite opp_IZR. lra.
  - apply andb_prop in check as [c1 c2]. apply is_less_sound in c1. apply within_turn_sound in c2. apply (no_turn m). lra.
Qed.
Section Program.
Variable param : data.

Definition unit_of (p : positive) (b : Q * Q) : I.type := quotient p (spanned p b) (velocity_over param p (whole p 1)).

Fixpoint check_spots (p q : positive) (first : Z) (spots : list spot) (cells : list cell) (turns : list Z) : bool :=
  match spots, cells, turns with
  | [], _, _ => true
  | b :: spots, C :: cells, k :: turns =>
    is_within p (spot_phase b) (sub p (phases_of p q C) (half_turns_in p (2 * k))) &?
    is_within p (spot_velocity b) (velocity_over param p (speeds_of p q C)) &?
    match spot_period b with None => true | Some n => (k =? first + n)%Z end &?
    Qle_bool 0 (fst (spot_phase b)) &? is_positive (sub p (half_turns_in p 2) (known_number p (fst (spot_phase b)))) &?
    within_turn (fst (spot_phase b)) (snd (spot_phase b)) &? check_spots p q first spots cells turns
  | _, _, _ => false
  end.
(* No impact is a mirror image of the first one. *)
Fixpoint check_apart (p q : positive) (w : wall) (C0 : cell) (walls : list wall) (cells : list cell) (turns : list Z) : bool :=
  match walls, cells, turns with
  | _, _, [] => true
  | w1 :: walls, C :: cells, k :: turns =>
    let X := sub p (sub p (phases_of p q C) (phases_of p q C0)) (half_turns_in p 1) in
    (same_wall w w1 || not_zero (add p (speeds_of p q C) (speeds_of p q C0)) ||
      (is_positive (sub p X (half_turns_in p (2 * k))) && is_positive (sub p (half_turns_in p (2 * (k + 1))) X))) &?
    check_apart p q w C0 walls cells turns
  | _, _, _ => false
  end.
Definition no_cell : cell := Cell 0 0 0 0.
Definition check_mirroring (w : wall) (c : cycle) (wide narrow : disc) (m : mirroring) : bool :=
  let walls := map onto (way narrow) in let cells := all_starts narrow :: map image_of_all (way narrow) in
  let p := disc_bits wide in let q := disc_scale narrow in
  match m with
  | Mirror_of n k => is_symmetric c &? (n <? length walls)%nat &? same_walls (map opposite (skipn n walls ++ firstn n walls)) walls &?
      same_wall (opposite (nth n (w :: walls) w)) w &?
      has_box wide (add p (phases_of p q (nth n cells no_cell)) (half_turns_in p (2 * k + 1))) (I.neg (speeds_of p q (nth n cells no_cell)))
  | No_mirror turns => negb (is_symmetric c) &? (length turns =? length walls)%nat &?
      check_apart (disc_bits narrow) q w (all_starts narrow) (w :: walls) cells turns
  end.

(* Powers of the restitution, exact where it is rational. *)
Fixpoint power_in (p : positive) (X : I.type) (n : nat) : I.type := match n with O => whole p 1 | S n => mul p X (power_in p X n) end.
Definition check_determinant (p : positive) (b : Q * Q) (n : nat) : bool :=
  let e := restitution param in
  match linear (least e) with
  | Some (x, y) => if same (least e) (most e) && Qeq_bool y 0 then Qle_bool (fst b) (rational_power x n) && Qle_bool (rational_power x n) (snd b)
      else is_within p b (power_in p (enclose_range p e) n)
  | None => is_within p b (power_in p (enclose_range p e) n)
  end.

(* Real and imaginary parts of the eigenvalues of trace T and determinant D. *)
Definition eigenvalues_in (p : positive) (T D : I.type) : (I.type * I.type) * (I.type * I.type) :=
  let disc := sub p (mul p T T) (mul p (whole p 4) D) in let zero := whole p 0 in
  if is_not_negative disc then
    let r := I.sqrt (F.PtoP p) disc in ((quotient p (add p T r) (whole p 2), zero), (quotient p (sub p T r) (whole p 2), zero))
  else if is_positive (I.neg disc) then
    let r := quotient p (I.sqrt (F.PtoP p) (I.neg disc)) (whole p 2) in let x := quotient p T (whole p 2) in ((x, r), (x, I.neg r))
  else (* Near one another, real or not. *)
    let r := hull zero (quotient p (I.sqrt (F.PtoP p) (I.abs disc)) (whole p 2)) in let x := quotient p T (whole p 2) in
    ((add p x r, r), (sub p x r, I.neg r)).
Definition is_within_complex (p : positive) (b : complex_bounds) (z : I.type * I.type) : bool := is_within p (fst b) (fst z) &? is_within p (snd b) (snd z).
Definition circle (p : positive) (z : I.type * I.type) : I.type := sub p (whole p 1) (add p (mul p (fst z) (fst z)) (mul p (snd z) (snd z))).
Definition check_stability (p : positive) (stable : bool) (z1 z2 : I.type * I.type) : bool :=
  if stable then is_positive (circle p z1) &? is_positive (circle p z2) else is_positive (I.neg (circle p z1)) || is_positive (I.neg (circle p z2)).
Definition check_eigenvalues (p : positive) (c : cycle) (T D : I.type) : bool :=
  let (z1, z2) := eigenvalues_in p T D in check_stability p (is_stable c) z1 z2 &?
    ((is_within_complex p (first_eigenvalue c) z1 && is_within_complex p (second_eigenvalue c) z2) ||
     (is_within_complex p (first_eigenvalue c) z2 && is_within_complex p (second_eigenvalue c) z1)).

Definition check_cycle (c : cycle) (h : surroundings) : bool :=
  match spots c, further param with
  | b :: others, [] =>
    let wide := wide_disc h in let narrow := narrow_disc h in let w := spot_wall b in let walls := map onto (way narrow) in
    let p := disc_bits wide in let pn := disc_bits narrow in let q := disc_scale narrow in let start := all_starts narrow in
    let cells := start :: map image_of_all (way narrow) in let n := (2 * length walls)%nat in
    (0 <? cycles c)%Z &? same_walls (map onto (way wide)) walls &? same_names (word c) (rev (mappings w walls)) &?
    same_walls (map spot_wall (spots c)) (firstn (length walls) (w :: walls)) &? (length (spots c) =? length walls)%nat &?
    check_disc param w (cycles c) wide &? check_disc param w (cycles c) narrow &?
    has_box wide (phases_of p q start) (speeds_of p q start) &?
    has_box wide (add p (spanned p (spot_phase b)) (half_turns_in p (2 * first_turns h))) (unit_of p (spot_velocity b)) &?
    check_spots pn q (hd 0%Z (spot_turns h)) (spots c) cells (spot_turns h) &?
    check_spots pn q (hd 0%Z (spot_turns h)) [as_first b] cells (spot_turns h) &? forallb (apart_spots b) others &? check_mirroring w c wide narrow (mirroring_of h) &?
    is_within pn (trace_bounds c) (trace_in param w narrow) &? check_determinant pn (determinant_bounds c) n &?
    check_eigenvalues pn c (trace_in param w narrow) (power_in pn (enclose_range pn (restitution param)) n)
  | _, _ => false
  end.

Variable s : scene.
Hypothesis described : describes param s.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.

Lemma holds_unit p b i : in_bounds b (velocity i) -> holds (unit_of p b) (snd (point_of s i)).
Proof.
  intros r. assert (u := holds_velocity_over param s described p _ _ (holds_whole p 1)). replace (snd (point_of s i)) with (velocity i / (A s * W s * 1)).
  - apply holds_quotient; [exact (holds_spanned p b _ r)|exact u].
  - unfold point_of, unit_speed. cbn [snd]. f_equal. ring.
Qed.
Lemma holds_speed p V i : holds V (snd (point_of s i)) -> holds (velocity_over param p V) (velocity i).
Proof.
  intros hV. replace (velocity i) with (A s * W s * snd (point_of s i)) by (unfold point_of, unit_speed; cbn [snd]; field; lra).
  exact (holds_velocity_over param s described p _ _ hV).
Qed.

Definition cells_hold (q : positive) (cells : list cell) (is : list impact) : Prop := Forall2 (fun C i => lies q C (point_of s i)) cells is.
Lemma visits_lie q way : forall w B x, visits q s w B way x -> cells_hold q (B :: map image_of_all way) (impact_at s w x :: impacts_on s w (map onto way) x).
Proof.
  induction way as [|z way IH]; intros w B x [here rest]; (constructor; [rewrite point_of_impact by assumption; exact here|]); [constructor|exact (IH _ _ _ rest)].
Qed.
Lemma spots_sound p q first spots : forall cells turns is, check_spots p q first spots cells turns = true -> cells_hold q cells is ->
  map spot_wall spots = map wall_of (firstn (length spots) is) -> Forall2 (shows_spot s first) spots (firstn (length spots) is).
Proof.
  induction spots as [|b spots IH]; intros [|C cells] [|k turns] is check hold walls; cbn [check_spots] in check; try discriminate; try (cbn; constructor).
  inversion hold as [|C' i cs js here rest]; subst. cbn [length firstn map] in *. injection walls as same more. split_checks.
  constructor; [|exact (IH _ _ _ check rest more)]. destruct (holds_cell p q _ _ here) as [hX hV].
  split; [symmetry; exact same|]. split; [exact (is_within_sound _ _ _ _ k1 (holds_speed _ _ _ hV))|].
  split.
  { split; [|match goal with narrow : within_turn _ _ = true |- _ => exact (within_turn_sound _ _ narrow) end].
    assert (n0 := holds_number p (fst (spot_phase b))). assert (t2 := holds_half_turns p 2). split.
    - match goal with low : Qle_bool 0 _ = true |- _ => apply Qle_bool_imp_le, Qle_Rle in low; assert (q0 : Q2R 0 = 0) by (unfold Q2R; cbn; lra); lra end.
    - match goal with high : is_positive _ = true |- _ => assert (0 < IZR 2 * PI - Q2R (fst (spot_phase b))) by (apply (is_positive_sound _ _ high); enclose) end. lra. }
  exists k. split.
  2:{ destruct (spot_period b) as [n|]; [|exact I]. match goal with same_turn : (k =? first + n)%Z = true |- _ => apply Z.eqb_eq, same_turn end. }
  apply (is_within_sound _ _ _ _ k0). assert (t := holds_half_turns p (2 * k)).
  replace (phase s (time i) - IZR k * (2 * PI)) with (fst (point_of s i) - IZR (2 * k) * PI) by (rewrite mult_IZR; unfold point_of; cbn [fst]; ring). enclose.
Qed.

Lemma not_zero_sound X : not_zero X = true -> ~ holds X 0.
Proof.
  unfold not_zero. intros h hX. apply orb_prop in h as [h|h]; [assert (0 < 0) by exact (is_positive_sound _ _ h hX)|assert (0 < - 0) by exact (is_positive_sound _ _ h (holds_neg _ _ hX))]; lra.
Qed.
Lemma apart_sound p q i0 C0 walls : lies q C0 (point_of s i0) -> forall cells turns is, check_apart p q (wall_of i0) C0 walls cells turns = true ->
  cells_hold q cells is -> map wall_of is = walls -> List.Forall (fun i => forall k, i <> mirrored s k i0) (firstn (length turns) is).
Proof.
  intros here0. induction walls as [|w walls IH]; intros cells turns is check hold same.
  { destruct turns; [constructor|]. destruct is; [constructor|discriminate same]. }
  destruct turns as [|t turns]; [constructor|]. destruct cells as [|C cells]; [discriminate check|]. cbn [check_apart] in check. cbv zeta in check.
  inversion hold as [|C' i cs js here rest]; subst. injection same as <- more. cbn [length firstn]. split_checks. rename k into k0.
  constructor; [|exact (IH _ _ _ check rest more)]. intros k eq. destruct (holds_cell p q _ _ here) as [hX hV]. destruct (holds_cell p q _ _ here0) as [hX0 hV0].
  apply orb_prop in k0 as [k0|k0]; [apply orb_prop in k0 as [k0|k0]|].
  - assert (m := f_equal wall_of eq). cbn [mirrored wall_of] in m. rewrite m in k0. destruct (wall_of i0); discriminate k0.
  - apply not_zero_sound in k0. apply k0. assert (m := f_equal velocity eq). cbn [mirrored velocity] in m.
    replace 0 with (snd (point_of s i) + snd (point_of s i0)) by (unfold point_of, unit_speed; cbn [snd]; rewrite m; field; lra). enclose.
  - apply andb_prop in k0 as [above below]. assert (m := f_equal time eq). cbn [mirrored time] in m.
    assert (turned_by : fst (point_of s i) - fst (point_of s i0) - IZR 1 * PI = 2 * IZR k * PI).
    { unfold point_of. cbn [fst]. rewrite m. rewrite (phase_mirrored s W_positive). rewrite plus_IZR, mult_IZR. ring. }
    assert (h1 := holds_half_turns p 1). assert (h2 := holds_half_turns p (2 * t)). assert (h3 := holds_half_turns p (2 * (t + 1))).
    assert (0 < fst (point_of s i) - fst (point_of s i0) - IZR 1 * PI - IZR (2 * t) * PI) by (apply (is_positive_sound _ _ above); enclose).
    assert (0 < IZR (2 * (t + 1)) * PI - (fst (point_of s i) - fst (point_of s i0) - IZR 1 * PI)) by (apply (is_positive_sound _ _ below); enclose).
    rewrite turned_by, mult_IZR in *. assert (pi := PI_RGT_0). assert (IZR t < IZR k) by nra. assert (IZR k < IZR (t + 1)) by nra.
    apply lt_IZR in H1, H2. lia.
Qed.

Lemma holds_power p X x n : holds X x -> holds (power_in p X n) (x ^ n).
Proof. intros h. induction n as [|n IH]; cbn [power_in pow]; [apply holds_whole|apply holds_mul; assumption]. Qed.
Lemma determinant_sound p b n : check_determinant p b n = true -> in_bounds b (e s ^ n).
Proof.
  assert (he : among (restitution param) (e s)) by apply described.
  assert (interval : is_within p b (power_in p (enclose_range p (restitution param)) n) = true -> in_bounds b (e s ^ n)).
  { intros check. apply (is_within_sound _ _ _ _ check), holds_power, holds_range, he. }
  unfold check_determinant. cbv zeta. destruct (linear (least (restitution param))) as [[x y]|] eqn:l; [|exact interval].
  destruct (same _ _ && Qeq_bool y 0) eqn:exact_one; [|exact interval]. intros check.
  apply andb_prop in exact_one as [one zero]. apply same_sound in one. unfold among in he. rewrite <- one in he.
  apply linear_sound in l. apply Qeq_bool_eq, Qeq_eqR in zero. rewrite zero in l. assert (q0 : Q2R 0 = 0) by (unfold Q2R; cbn; lra). rewrite q0 in l.
  replace (e s) with (Q2R x) by lra. rewrite <- rational_power_value. apply andb_prop in check as [low high].
  split; apply Qle_Rle, Qle_bool_imp_le; assumption.
Qed.

Lemma eigenvalues_sound p M T D z1 z2 : holds T (trace M) -> holds D (det M) -> eigenvalues_in p T D = (z1, z2) ->
  exists x1 y1 x2 y2, are_eigenvalues M x1 y1 x2 y2 /\ (holds (fst z1) x1 /\ holds (snd z1) y1) /\ (holds (fst z2) x2 /\ holds (snd z2) y2).
Proof.
  intros hT hD. unfold eigenvalues_in. cbv zeta. set (disc := sub p (mul p T T) (mul p (whole p 4) D)).
  assert (hd : holds disc (trace M * trace M - 4 * det M)) by (unfold disc; enclose). set (delta := trace M * trace M - 4 * det M) in *.
  destruct (is_not_negative disc) eqn:sign.
  - intros eq. injection eq as <- <-. assert (le := is_not_negative_sound _ _ sign hd).
    assert (hr : holds (I.sqrt (F.PtoP p) disc) (sqrt delta)) by exact (I.sqrt_correct (F.PtoP p) disc (Xreal delta) hd).
    assert (sq := sqrt_sqrt _ le). exists ((trace M + sqrt delta) / 2), 0, ((trace M - sqrt delta) / 2), 0. cbn [fst snd].
    split; [unfold are_eigenvalues; repeat split; try field|split; split; enclose].
    replace ((trace M + sqrt delta) / 2 * ((trace M - sqrt delta) / 2) - 0 * 0) with ((trace M * trace M - sqrt delta * sqrt delta) / 4) by field.
    rewrite sq. unfold delta. field.
  - destruct (is_positive (I.neg disc)) eqn:sign'; intros eq; injection eq as <- <-.
    2:{ assert (ha : holds (I.abs disc) (Rabs delta)) by exact (I.abs_correct disc (Xreal delta) hd).
      assert (hr : holds (I.sqrt (F.PtoP p) (I.abs disc)) (sqrt (Rabs delta))) by exact (I.sqrt_correct (F.PtoP p) _ (Xreal (Rabs delta)) ha).
      assert (h2 := holds_quotient p _ _ _ _ hr (holds_whole p 2)). assert (pos := sqrt_pos (Rabs delta)).
      assert (between_them : forall x, 0 <= x <= sqrt (Rabs delta) / 2 -> holds (hull (whole p 0) (quotient p (I.sqrt (F.PtoP p) (I.abs disc)) (whole p 2))) x).
      { intros x hx. exact (holds_hull _ _ _ _ x (holds_whole p 0) h2 hx). }
      assert (z0 := between_them 0 ltac:(lra)). assert (zr := between_them (sqrt (Rabs delta) / 2) ltac:(lra)).
      assert (sq := sqrt_sqrt (Rabs delta) (Rabs_pos delta)). set (r := sqrt (Rabs delta)) in *. cbn [fst snd]. destruct (Rle_lt_dec 0 delta) as [le|lt].
      - exists (trace M / 2 + r / 2), 0, (trace M / 2 - r / 2), (- 0). rewrite Rabs_pos_eq in sq by exact le.
        split; [unfold are_eigenvalues; repeat split; try field|split; split; enclose].
        replace ((trace M / 2 + r / 2) * (trace M / 2 - r / 2) - 0 * - 0) with ((trace M * trace M - r * r) / 4) by field. rewrite sq. unfold delta. field.
      - exists (trace M / 2 + 0), (r / 2), (trace M / 2 - 0), (- (r / 2)). rewrite Rabs_left in sq by exact lt.
        split; [unfold are_eigenvalues; repeat split; try field|split; split; enclose].
        replace ((trace M / 2 + 0) * (trace M / 2 - 0) - r / 2 * - (r / 2)) with ((trace M * trace M + r * r) / 4) by field. rewrite sq. unfold delta. field. }
    assert (hn := holds_neg _ _ hd). assert (lt := is_positive_sound _ _ sign' hn).
    assert (hr : holds (I.sqrt (F.PtoP p) (I.neg disc)) (sqrt (- delta))) by exact (I.sqrt_correct (F.PtoP p) (I.neg disc) (Xreal (- delta)) hn).
    assert (sq := sqrt_sqrt (- delta) ltac:(lra)). exists (trace M / 2), (sqrt (- delta) / 2), (trace M / 2), (- (sqrt (- delta) / 2)). cbn [fst snd].
    split; [unfold are_eigenvalues; repeat split; try field|split; split; enclose].
    replace (trace M / 2 * (trace M / 2) - sqrt (- delta) / 2 * - (sqrt (- delta) / 2)) with ((trace M * trace M + sqrt (- delta) * sqrt (- delta)) / 4) by field.
    rewrite sq. unfold delta. field.
Qed.
Lemma stability_sound p stable z1 z2 x1 y1 x2 y2 : check_stability p stable z1 z2 = true -> holds (fst z1) x1 -> holds (snd z1) y1 -> holds (fst z2) x2 -> holds (snd z2) y2 ->
  if stable then inside_circle x1 y1 /\ inside_circle x2 y2 else outside_circle x1 y1 \/ outside_circle x2 y2.
Proof.
  intros check a b c f. assert (k1 : holds (circle p z1) (1 - (x1 * x1 + y1 * y1))) by (unfold circle; enclose).
  assert (k2 : holds (circle p z2) (1 - (x2 * x2 + y2 * y2))) by (unfold circle; enclose). unfold check_stability in check. unfold inside_circle, outside_circle.
  destruct stable.
  - split_checks. assert (i1 := is_positive_sound _ _ k k1). assert (i2 := is_positive_sound _ _ check k2). split; lra.
  - apply orb_prop in check as [o|o]; [left; assert (i1 := is_positive_sound _ _ o (holds_neg _ _ k1))|right; assert (i1 := is_positive_sound _ _ o (holds_neg _ _ k2))]; lra.
Qed.
Lemma complex_sound p b z x y : is_within_complex p b z = true -> holds (fst z) x -> holds (snd z) y -> in_complex b x y.
Proof. unfold is_within_complex. intros check hx hy. split_checks. split; eapply is_within_sound; eassumption. Qed.
Lemma check_eigenvalues_sound p c M T D : holds T (trace M) -> holds D (det M) -> check_eigenvalues p c T D = true ->
  exists x1 y1 x2 y2, are_eigenvalues M x1 y1 x2 y2 /\ in_complex (first_eigenvalue c) x1 y1 /\ in_complex (second_eigenvalue c) x2 y2 /\
    if is_stable c then inside_circle x1 y1 /\ inside_circle x2 y2 else outside_circle x1 y1 \/ outside_circle x2 y2.
Proof.
  intros hT hD. unfold check_eigenvalues. destruct (eigenvalues_in p T D) as [z1 z2] eqn:found. intros check. split_checks.
  destruct (eigenvalues_sound p M T D z1 z2 hT hD found) as (x1 & y1 & x2 & y2 & (r1 & r2 & r3 & r4) & (h1 & h2) & (h3 & h4)).
  assert (st := stability_sound p _ _ _ _ _ _ _ k h1 h2 h3 h4). apply orb_prop in check as [c1|c1]; apply andb_prop in c1 as [c1 c2].
  - exists x1, y1, x2, y2. split; [repeat split; assumption|]. split; [exact (complex_sound _ _ _ _ _ c1 h1 h2)|]. split; [exact (complex_sound _ _ _ _ _ c2 h3 h4)|exact st].
  - exists x2, y2, x1, y1. split; [repeat split; lra|]. split; [exact (complex_sound _ _ _ _ _ c1 h3 h4)|]. split; [exact (complex_sound _ _ _ _ _ c2 h1 h2)|].
    destruct (is_stable c); tauto.
Qed.

(* A round back to the same impact, some periods later, whose first state is in the ellipse, is that of the state that comes back. *)
Lemma round_state w k h z again : check_disc param w k h = true -> one_harmonic s -> wall_of z = w -> in_ellipse (frame_of (disc_scale h) (disc_chart h)) (point_of s z) ->
  leads s (rebound s z) (map onto (way h)) again (later (IZR k * period s) z) ->
  turned k (fly_on s w (map onto (way h)) (point_of s z)) = point_of s z.
Proof.
  intros check one on inside (f & walls & back). assert (z_is : z = impact_at s w (point_of s z)) by (rewrite <- on; symmetry; apply impact_of_point; assumption).
  rewrite z_is in f at 1. destruct (follows_states s A_positive W_positive gap_positive again w (point_of s z) f) as [_ same]. rewrite walls in same.
  assert (end_ := impacts_last s (map onto (way h)) w (point_of s z)). rewrite <- same, <- z_is in end_.
  assert (some : again <> []).
  { intros none. rewrite none in walls. cbn in walls. assert (n := some_walls param w k h check). destruct (way h); [exact (n eq_refl)|discriminate walls]. }
  rewrite (last_default again z (later (IZR k * period s) z) some), back in end_.
  assert (last_wall := walls_come_back param w k h check).
  rewrite (last_default (map onto (way h)) w (opposite w)), last_wall in end_ by (assert (n := some_walls param w k h check); destruct (way h); [destruct (n eq_refl)|discriminate]).
  assert (p1 := f_equal (point_of s) end_). rewrite point_of_impact in p1 by assumption. rewrite <- p1.
  exact (point_later s W_positive k z).
Qed.

Theorem cycle_sound c h : check_cycle c h = true -> exists b x, hd_error (spots c) = Some b /\ one_harmonic s /\
  let w := spot_wall b in let walls := map onto (way (wide_disc h)) in
  check_disc param w (cycles c) (wide_disc h) = true /\ in_ellipse (frame_of (disc_scale (wide_disc h)) (disc_chart (wide_disc h))) x /\
  turned (cycles c) (fly_on s w walls x) = x /\ is_cycle s c (impact_at s w x) (impacts_on s w walls x).
Proof.
  unfold check_cycle. destruct (spots c) as [|b more] eqn:listed; [discriminate|]. destruct (further param) as [|? ?] eqn:alone; [|discriminate]. cbv zeta. intros check. split_checks.
  set (wide := wide_disc h) in *. set (narrow := narrow_disc h) in *. set (w := spot_wall b) in *. set (walls := map onto (way narrow)) in *.
  assert (one : one_harmonic s).
  { destruct described as (_ & rest & _). rewrite alone in rest. inversion rest. unfold one_harmonic. congruence. }
  apply Z.ltb_lt in k. apply same_walls_sound in k0, k2. apply same_names_sound in k1. apply Nat.eqb_eq in k3.
  destruct (disc_fixed param w (cycles c) wide s described A_positive W_positive gap_positive k4) as (x & in_wide & comes & unique).
  destruct (disc_fixed param w (cycles c) narrow s described A_positive W_positive gap_positive k5) as (x' & in_narrow & comes' & _).
  rewrite k0 in comes, unique.
  assert (start' := start_family param w (cycles c) narrow k5). destruct start' as (all_starts_in & _).
  assert (x'_in : lies (disc_scale narrow) (all_starts narrow) x').
  { rewrite <- (placed_coordinates (frame_of (disc_scale narrow) (disc_chart narrow)) x') by (apply (area_nonzero param w (cycles c) narrow k5)). apply all_starts_in. exact in_narrow. }
  destruct (holds_cell (disc_bits wide) (disc_scale narrow) _ _ x'_in) as [nX nV].
  assert (same_state : x' = x).
  { apply unique; [exact (has_box_sound param w (cycles c) wide k4 _ _ x' k6 nX nV)|exact comes']. }
  subst x'. destruct (disc_flies param w (cycles c) narrow s described A_positive W_positive gap_positive k5 x in_narrow) as [flown visited]. fold walls in flown, comes'.
  assert (lie := visits_lie (disc_scale narrow) (way narrow) w _ x visited). fold walls in lie.
  assert (some := some_walls param w (cycles c) narrow k5). assert (come_back := walls_come_back param w (cycles c) narrow k5). fold walls in come_back.
  assert (walls_some : walls <> []) by (unfold walls; destruct (way narrow); [destruct (some eq_refl)|discriminate]).
  exists b, x. split; [reflexivity|]. split; [exact one|]. split; [exact k4|]. split; [exact in_wide|]. rewrite k0. split; [exact comes|]. fold w.
  set (i := impact_at s w x). set (orbit := impacts_on s w walls x). assert (orbit_walls : map wall_of orbit = walls) by apply impacts_walls.
  assert (len : length orbit = length walls) by (rewrite <- orbit_walls, map_length; reflexivity).
  assert (point_i : point_of s i = x) by (apply point_of_impact; assumption).
  assert (round : leads s (rebound s i) walls orbit (later (IZR (cycles c) * period s) i)).
  { split; [exact (impacts_follow s walls w x flown)|]. split; [exact orbit_walls|].
    assert (e := impacts_last s walls w x). fold i orbit in e.
    rewrite (last_default orbit _ i) by (intros none; rewrite none in orbit_walls; cbn in orbit_walls; congruence). rewrite e.
    rewrite (last_default walls w (opposite w) walls_some), come_back. unfold i.
    rewrite (later_of_turned s W_positive w (cycles c) (fly_on s w walls x)), comes. reflexivity. }
  unfold is_cycle. cbv zeta. rewrite orbit_walls. change (wall_of i) with w. rewrite point_i. rewrite listed.
  destruct (disc_trace param w (cycles c) narrow s described A_positive W_positive gap_positive k5 x in_narrow comes') as [hT det_is]. fold walls in hT, det_is.
  split; [exact k|]. split; [intros none; rewrite none in orbit_walls; cbn in orbit_walls; congruence|].
  split; [rewrite (last_default walls w (opposite w) walls_some); exact come_back|]. split; [exact k1|].
  split.
  { intros n. replace (later (IZR n * (IZR (cycles c) * period s) + IZR (cycles c) * period s) i) with (later (IZR n * (IZR (cycles c) * period s)) (later (IZR (cycles c) * period s) i)).
    - apply leads_later; [|exact round]. replace (IZR n * (IZR (cycles c) * period s)) with (IZR (n * cycles c) * period s) by (rewrite mult_IZR; ring). apply turns_recur; assumption.
    - rewrite later_later. reflexivity. }
  set (first_turn := hd 0%Z (spot_turns h)) in *.
  assert (shown : Forall2 (shows_spot s first_turn) (b :: more) (firstn (length orbit) (i :: orbit))).
  { rewrite len, <- k3. apply (spots_sound (disc_bits narrow) (disc_scale narrow) _ _ _ _ (i :: orbit) k8 lie). rewrite k2, k3.
    rewrite <- firstn_map. cbn [map]. rewrite orbit_walls. reflexivity. }
  assert (first_shown : forall j f, (0 < length orbit)%nat -> Forall2 (shows_spot s f) (b :: more) (firstn (length orbit) (j :: orbit)) -> shows_spot s f b j).
  { intros j f positive all. destruct (length orbit) as [|m]; [lia|]. cbn [firstn] in all. inversion all; assumption. }
  assert (orbit_some : (0 < length orbit)%nat) by (rewrite len; destruct walls; [destruct (walls_some eq_refl)|cbn; lia]).
  split.
  { exists first_turn. split; [exact shown|]. intros b' first_is. injection first_is as <-.
    assert (one_shown : Forall2 (shows_spot s first_turn) [as_first b] (firstn 1 (i :: orbit))).
    { apply (spots_sound (disc_bits narrow) (disc_scale narrow) _ _ _ _ (i :: orbit) k9 lie). cbn [firstn map as_first spot_wall]. reflexivity. }
    inversion one_shown; assumption. }
  split.
  { intros n k' [n_low n_high]. assert (in_list : (n < length (firstn (length orbit) (i :: orbit)))%nat) by (rewrite firstn_length; cbn [length]; lia).
    assert (there := forall2_nth _ b i _ _ shown n in_list). assert (count := as_many _ _ _ shown).
    replace (nth n (firstn (length orbit) (i :: orbit)) i) with (nth n (i :: orbit) i) in there.
    - rewrite forallb_forall in k10. destruct n as [|n]; [lia|]. cbn [nth] in there.
      apply (apart_spots_sound s b (nth n more b) first_turn first_turn i _ W_positive).
      + apply k10, nth_In. cbn [length] in count. lia.
      + exact (first_shown _ _ orbit_some shown).
      + exact there.
    - rewrite <- (firstn_skipn (length orbit) (i :: orbit)) at 1. apply app_nth1. exact in_list. }
  split.
  { intros z again b' from first_is shown_so leading. injection first_is as <-. destruct shown_so as (on & speed_in & _ & turns & phase_in & _).
    set (back := (first_turns h - turns)%Z). set (z' := periods_later s back z).
    assert (inside : in_ellipse (frame_of (disc_scale wide) (disc_chart wide)) (point_of s z')).
    { apply (has_box_sound param w (cycles c) wide k4 _ _ _ k7).
      - replace (fst (point_of s z')) with ((phase s (time z) - IZR turns * (2 * PI)) + IZR (2 * first_turns h) * PI).
        + assert (a := holds_spanned (disc_bits wide) _ _ phase_in). assert (t := holds_half_turns (disc_bits wide) (2 * first_turns h)). enclose.
        + unfold z', back, point_of, periods_later, later, phase, period. cbn [fst time]. rewrite mult_IZR, minus_IZR. field. lra.
      - apply (holds_unit (disc_bits wide) (spot_velocity b) z'). exact speed_in. }
    assert (round' : leads s (rebound s z') walls (map (later (IZR back * period s)) again) (later (IZR (cycles c) * period s) z')).
    { unfold z', periods_later. rewrite later_later, (Rplus_comm (IZR (cycles c) * period s)), <- later_later.
      apply leads_later; [apply turns_recur; assumption|exact leading]. }
    assert (fixed := round_state w (cycles c) wide z' _ k4 one on inside ltac:(rewrite k0; exact round')). rewrite k0 in fixed.
    assert (same := unique _ inside fixed). exists (- back)%Z. unfold i. rewrite <- same.
    replace w with (wall_of z') by exact on. rewrite impact_of_point by assumption. unfold z', periods_later. rewrite later_later, opp_IZR.
    replace (- IZR back * period s + IZR back * period s) with 0 by ring. symmetry. apply later_nothing. }
  split.
  { unfold check_mirroring in k11. cbv zeta in k11. fold narrow walls in k11. destruct (mirroring_of h) as [n m|turns].
    - split_checks. split; [intros _|intros _; reflexivity]. apply Nat.ltb_lt in k15. apply same_walls_sound in k16. apply same_wall_sound in k17.
      set (j := nth n (i :: orbit) i). exists n, (- m - 1)%Z. split; [rewrite len; exact k15|]. fold j.
      assert (len' : (n < length (i :: orbit))%nat) by (cbn [length]; lia).
      assert (j_lies := forall2_nth _ no_cell i _ _ lie n len'). fold j in j_lies.
      assert (j_wall : wall_of j = nth n (w :: walls) w).
      { unfold j. rewrite <- (map_nth wall_of). cbn [map]. rewrite orbit_walls. reflexivity. }
      set (z := mirrored s m j). assert (z_wall : wall_of z = w) by (cbn [z mirrored wall_of]; rewrite j_wall; exact k17).
      assert (inside : in_ellipse (frame_of (disc_scale wide) (disc_chart wide)) (point_of s z)).
      { destruct (holds_cell (disc_bits wide) (disc_scale narrow) _ _ j_lies) as [jX jV]. apply (has_box_sound param w (cycles c) wide k4 _ _ _ k11).
        - replace (fst (point_of s z)) with (fst (point_of s j) + IZR (2 * m + 1) * PI) by (unfold z, point_of; cbn [fst mirrored time]; rewrite phase_mirrored by assumption; reflexivity).
          assert (t := holds_half_turns (disc_bits wide) (2 * m + 1)). enclose.
        - replace (snd (point_of s z)) with (- snd (point_of s j)) by (unfold z, point_of, unit_speed; cbn [snd mirrored velocity]; field; lra). enclose. }
      (* The orbit from j on, a round long, and its mirror image. *)
      set (P := IZR (cycles c) * period s) in *. assert (recur : recurs s P) by (apply turns_recur; assumption).
      assert (from_j : follows s (rebound s j) (skipn n orbit ++ map (later P) (firstn n orbit)) /\ last (skipn n orbit ++ map (later P) (firstn n orbit)) j = later P j).
      { destruct round as (f & _ & back). rewrite <- (firstn_skipn n orbit) in f. apply follows_app in f as [f1 f2].
        rewrite (after_nth s orbit n i i) in f2 by lia. fold j in f2. assert (l0 := skipn_length n orbit).
        assert (some_left : skipn n orbit <> []) by (intros none; rewrite none in l0; cbn in l0; lia).
        assert (some_orbit : orbit <> []) by (intros none; rewrite none, skipn_nil in some_left; exact (some_left eq_refl)).
        assert (last_left : forall a, last (skipn n orbit) a = later P i).
        { intros a. rewrite <- (last_skipn n orbit a some_left), <- back. apply last_default, some_orbit. }
        split.
        - apply follows_joined; [exact f2|]. rewrite after_last, last_left. exact (follows_later s P (firstn n orbit) recur _ f1).
        - destruct n as [|n']; [cbn [firstn map]; rewrite app_nil_r, last_left; reflexivity|].
          assert (some_tail : map (later P) (firstn (S n') orbit) <> []) by (destruct orbit; [exact (fun _ => some_orbit eq_refl)|discriminate]).
          rewrite last_app by exact some_tail. rewrite (last_default _ j (later P i) some_tail), last_map, (last_firstn orbit n' i i) by lia. reflexivity. }
      destruct from_j as [f_j last_j].
      assert (mirrored_round : leads s (rebound s z) walls (map (mirrored s m) (skipn n orbit ++ map (later P) (firstn n orbit))) (later P z)).
      { split; [exact (follows_mirrored s W_positive one m _ j f_j)|]. split.
        - etransitivity; [|exact k16]. rewrite map_map. change (fun x0 => wall_of (mirrored s m x0)) with (fun x0 => opposite (wall_of x0)). rewrite <- (map_map wall_of opposite). f_equal. rewrite map_app. f_equal; [rewrite <- skipn_map, orbit_walls; reflexivity|].
          rewrite map_map. change (fun x0 => wall_of (later P x0)) with wall_of. rewrite <- firstn_map, orbit_walls. reflexivity.
        - assert (z_later : later P z = mirrored s m (later P j)) by (symmetry; apply mirrored_later). rewrite z_later, last_map. f_equal.
          etransitivity; [|exact last_j]. apply last_default. intros none. apply app_eq_nil in none as [none _]. assert (l0 := skipn_length n orbit). rewrite none in l0. cbn in l0. lia. }
      assert (fixed := round_state w (cycles c) wide z _ k4 one z_wall inside ltac:(rewrite k0; exact mirrored_round)). rewrite k0 in fixed.
      assert (same := unique _ inside fixed).
      assert (i_is : i = z) by (unfold i; rewrite <- same, <- z_wall; apply impact_of_point; assumption).
      rewrite i_is. unfold z. symmetry. apply mirrored_back.
    - split_checks. apply negb_true_iff in k14. rewrite k14. split; [discriminate|]. intros (n & m & lt & eq). exfalso. apply Nat.eqb_eq in k15.
      assert (apart := apart_sound (disc_bits narrow) (disc_scale narrow) i (all_starts narrow) (w :: walls) ltac:(rewrite point_i; exact x'_in) _ _ (i :: orbit) k11 lie ltac:(cbn [map]; rewrite orbit_walls; reflexivity)).
      refine (forall_nth _ i _ n _ apart _ _ m eq); [rewrite k15, <- len; exact lt|cbn [length]; lia]. }
  split; [exact (is_within_sound _ _ _ _ k12 hT)|].
  split; [rewrite det_is; exact (determinant_sound _ _ _ k13)|].
  apply (check_eigenvalues_sound (disc_bits narrow) c _ _ _ hT) with (2 := check). rewrite det_is. apply holds_power, holds_range, described.
Qed.
End Program.
End Cycles.
