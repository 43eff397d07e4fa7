(* A program that verifies the document of a trapping region (`verify_trap`), with the proof that it is right (`trap_verified`). That the scene's motion
   comes into the region needs its first impacts, which are verified elsewhere (Pieces.v). *)
From Coq Require Import Reals Lra List Sorted ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Data Certificate Document Motion Orbit Cycle Region Kept Columns March.
Open Scope R_scope.
Import ListNotations.

(* The columns, counted on from phase 0, between which the scene's motion comes in, and its impacts up to that one. *)
Record entry := Entry { from_column : Z; until_column : Z; impacts_before : list event }.
Definition first_impacts (param : data) (b : beginning) (x : entry) (n : Z) : document :=
  Document param b (map Impact_at (impacts_before x)) (Impacts_reached n).

(* A motion of impacts alone. *)
Lemma impacts_alone events : forall motion, Forall2 shows (map Impact_at events) motion ->
  exists orbit, motion = map Hits orbit /\ Forall2 (fun x i => within (shown x) i) events orbit.
Proof.
  induction events as [|x events IH]; intros motion all; inversion all as [|o y os ys shown_y rest]; subst; [exists []; split; [reflexivity|constructor]|].
  destruct (IH _ rest) as (orbit & -> & each). destruct y as [i|w t c|w t]; cbn in shown_y; try contradiction.
  exists (i :: orbit). split; [reflexivity|constructor; assumption].
Qed.
Lemma goes_follows s orbit : forall l, goes s (Flying l) (map Hits orbit) -> follows s l orbit.
Proof. induction orbit as [|i orbit IH]; intros l; cbn; [trivial|]. intros [a b]. split; [exact a|exact (IH _ b)]. Qed.
Lemma impacts_many events : impacts (map Impact_at events) = Z.of_nat (length events).
Proof.
  unfold impacts. f_equal. induction events as [|x events IH]; [reflexivity|]. cbn. rewrite IH. reflexivity.
Qed.

(* The runs of a region. *)
Definition check_before (a b : Z * (Z * Z)) : bool := ((fst a <? fst b) || ((fst a =? fst b) && (snd (snd a) <? fst (snd b))))%Z.
Fixpoint check_sorted (runs_of : list (Z * (Z * Z))) : bool :=
  match runs_of with a :: ((b :: _) as more) => check_before a b && check_sorted more | _ => true end.
Definition check_grid (r : region) (run : Z * (Z * Z)) : bool :=
  ((0 <=? fst run) && (fst run <? Zpos (columns r)) && (0 <=? fst (snd run)) && (fst (snd run) <=? snd (snd run)))%Z.
Definition check_count (r : region) (n : Z) : bool := forallb (check_grid r) (runs r) && check_sorted (runs r) &&
  (n =? fold_right (fun run n => snd (snd run) - fst (snd run) + 1 + n) 0 (runs r))%Z.
Lemma sorted_sound runs_of : check_sorted runs_of = true -> Sorted run_before runs_of.
Proof.
  induction runs_of as [|a [|b more] IH]; intros c; [constructor|repeat constructor|]. cbn [check_sorted] in c. apply andb_prop in c as [c rest].
  constructor; [exact (IH rest)|]. constructor. unfold check_before in c. unfold run_before. apply orb_prop in c as [c|c]; [left; apply Z.ltb_lt, c|right].
  apply andb_prop in c as [c c']. apply Z.eqb_eq in c. apply Z.ltb_lt in c'. split; assumption.
Qed.
Lemma count_sound r n : check_count r n = true -> has_boxes r n.
Proof.
  unfold check_count. intros c. apply andb_prop in c as [c same]. apply andb_prop in c as [c sorted]. split; [|split; [exact (sorted_sound _ sorted)|apply Z.eqb_eq, same]].
  apply Forall_forall. intros run member. rewrite forallb_forall in c. specialize (c run member). unfold check_grid in c. apply andb_prop in c as [c c4]. apply andb_prop in c as [c c3].
  apply andb_prop in c as [c1 c2]. apply Z.leb_le in c1, c3, c4. apply Z.ltb_lt in c2. unfold in_grid. lia.
Qed.

Module Traps (F : FloatOps with Definition sensible_format := true).
Module Import Marching := Marches F.
Import Marching.Col.
Import Marching.Col.Ver.
Import Marching.Col.Ver.Check.
Local Opaque add sub mul quotient whole hull.

Section Document.
Variables (param : data) (b : beginning) (r : region) (f : properties) (h : plan) (x : entry).
Let p := plan_bits h.
Definition half_columns : Z := (Zpos (columns r) * Zpos (fine h))%Z.
Definition speed_points : Z := (Zpos (rows r) * Zpos (2 * fine h))%Z.
Definition units_in : units :=
  Units (half_pi p) (quotient p (I.pi (F.PtoP p)) (whole p half_columns)) (quotient p (whole p 1) (whole p speed_points)) (hull (whole p (-1)) (whole p 1))
    (quotient p (enclose_range p (gap param)) (enclose_range p (amplitude param))) (enclose_range p (restitution param)).

Definition not_less (a b : I.type) : bool := is_not_negative (sub few a b).
Definition in_periods (n : Z) : Q := Qmake n (2 * (columns r * fine h)).
(* A time of a number of points of the grid. *)
Definition in_time_units (n : Z) : I.type := quotient few (mul few (quotient few (I.pi (F.PtoP few)) (whole few half_columns)) (whole few n)) (enclose_range few (frequency param)).
Definition check_flights : bool :=
  Qle_bool (fst (flight_periods f)) (in_periods (shortest h)) &? Qle_bool (in_periods (longest h)) (snd (flight_periods f)) &?
  Qle_bool (in_periods (longest h)) (longest_flight f) &?
  is_positive (known_number few (fst (flight_periods f))) &?
  not_less (in_time_units (shortest h)) (known_number few (fst (flight_times f))) &? not_less (known_number few (snd (flight_times f))) (in_time_units (longest h)).
Definition fastest : I.type := mul few (enclose_range few (amplitude param)) (enclose_range few (frequency param)).
Definition in_scene_units (row : Z) : I.type := mul few fastest (quotient few (whole few row) (whole few (Zpos (rows r)))).
Definition check_speeds (run : Z * (Z * Z)) : bool :=
  let (_, rows_of) := run in let (first, last) := rows_of in
  (0 <=? first)%Z &? Qle_bool (fst (impact_speeds f)) (Qmake first (rows r)) &? Qle_bool (Qmake (last + 1) (rows r)) (snd (impact_speeds f)) &?
  not_less (in_scene_units first) (known_number few (fst (impact_velocities f))) &? not_less (known_number few (snd (impact_velocities f))) (in_scene_units (last + 1)).

(* An impact in bounds of time and velocity has its state in the region. *)
Definition check_state (w : wall) (T V : I.type) : bool :=
  let turned := add few (add few (mul few (enclose_range few (frequency param)) T) (enclose_range few (shift param))) (match w with left => whole few 0 | right => I.pi (F.PtoP few) end) in
  let column := quotient few (mul few turned (whole few (Zpos (columns r)))) (mul few (whole few 2) (I.pi (F.PtoP few))) in
  let speed := sided w (quotient few V fastest) in let row := mul few speed (whole few (Zpos (rows r))) in
  is_not_negative speed &? not_less column (whole few (from_column x)) &? not_less (whole few (until_column x)) column &?
  in_columns r h most_columns row row (from_column x) (until_column x * Zpos (2 * fine h)).
Definition check_entry (n : Z) : bool :=
  if (n =? 0)%Z then match b with Struck w t v => check_state w (enclose_range few t) (enclose_range few v) | Inside _ _ _ => false end
  else match rev (impacts_before x) with
    | last :: _ => let y := shown last in check_state (on y) (spanned few (time_lower y, time_upper y)) (spanned few (velocity_lower y, velocity_upper y))
    | [] => false
    end.
Definition verify_trap : bool :=
  check_single param b &? check_count r (box_count f) &? check_flights &? forallb check_speeds (runs r) &? (match entered f with None => true | Some n => check_entry n end) &? check_boxes r h units_in.

Lemma flights_positive : check_flights = true -> 0 < Q2R (fst (flight_periods f)).
Proof. unfold check_flights. intros c. split_checks. refine (is_positive_sound _ _ _ (holds_number few _)). assumption. Qed.

Section Scene.
Variable s : scene.
Hypothesis described : describes param s.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.
Let delta := PI / IZR half_columns.
Let sigma := / IZR speed_points.

Lemma units_hold : holds (quarter_turn units_in) (PI / 2) /\ holds (phase_unit units_in) delta /\ holds (speed_unit units_in) sigma /\
  (forall t, -1 <= t <= 1 -> holds (all_signs units_in) t) /\ holds (gap_of units_in) (d s / A s) /\ holds (restitution_of units_in) (e s).
Proof.
  destruct described as ((dA & _) & _ & dd & de). assert (pi := I.pi_correct (F.PtoP p)). change (holds (I.pi (F.PtoP p)) PI) in pi. cbn [units_in quarter_turn phase_unit speed_unit all_signs gap_of restitution_of].
  split; [apply holds_quotient; [exact pi|apply holds_whole]|]. split; [apply holds_quotient; [exact pi|apply holds_whole]|].
  split; [replace sigma with (1 / IZR speed_points) by (unfold sigma, Rdiv; ring); apply holds_quotient; apply holds_whole|].
  split; [intros t o; apply (holds_hull _ _ (IZR (-1)) (IZR 1)); [apply holds_whole|apply holds_whole|exact o]|].
  split; [apply holds_quotient; apply holds_range; assumption|apply holds_range; assumption].
Qed.
Lemma not_less_sound X Y a c : not_less X Y = true -> holds X a -> holds Y c -> c <= a.
Proof. intros k hx hy. assert (0 <= a - c) by exact (is_not_negative_sound _ _ k (holds_sub _ _ _ _ _ hx hy)). lra. Qed.
Lemma half_columns_positive : 0 < IZR half_columns.
Proof. apply IZR_lt. unfold half_columns. lia. Qed.
Lemma in_periods_is n : Q2R (in_periods n) = delta * IZR n / (2 * PI).
Proof.
  unfold Q2R, in_periods, delta, half_columns. cbn [Qnum Qden]. rewrite Pos2Z.inj_mul, Pos2Z.inj_mul, mult_IZR. assert (k := half_columns_positive). unfold half_columns in k.
  field. repeat split; first [apply PI_neq0 | lra].
Qed.
Lemma flights_sound : check_flights = true -> 0 < delta * IZR (shortest h) /\
  forall a c, delta * IZR (shortest h) <= W s * (time c - time a) <= delta * IZR (longest h) -> flight_lasts s f a c.
Proof.
  intros c. assert (positive := flights_positive c). unfold check_flights in c. split_checks. apply Qle_bool_iff, Qle_Rle in k, k0, k1. rewrite in_periods_is in k, k0, k1.
  assert (pi := PI_RGT_0).
  assert (dW : holds (enclose_range few (frequency param)) (W s)) by (apply holds_range, described).
  assert (times : forall n, holds (in_time_units n) (delta * IZR n / W s)).
  { intros n. apply holds_quotient; [|exact dW]. apply holds_mul; [|apply holds_whole]. apply holds_quotient; [apply I.pi_correct|apply holds_whole]. }
  assert (early := not_less_sound _ _ _ _ k3 (times _) (holds_number few _)). assert (late := not_less_sound _ _ _ _ c (holds_number few _) (times _)).
  split.
  - apply (Rmult_lt_reg_r (/ (2 * PI))); [apply Rinv_0_lt_compat; lra|]. rewrite Rmult_0_l. fold (delta * IZR (shortest h) / (2 * PI)). lra.
  - intros i j [o o']. assert (turn : 0 < / (2 * PI)) by (apply Rinv_0_lt_compat; lra). assert (slow : 0 < / W s) by (apply Rinv_0_lt_compat; lra).
    assert (in_turns : delta * IZR (shortest h) / (2 * PI) <= (time j - time i) / period s <= delta * IZR (longest h) / (2 * PI)).
    { replace ((time j - time i) / period s) with (W s * (time j - time i) / (2 * PI)) by (unfold period; field; lra). split; apply Rmult_le_compat_r; lra. }
    assert (in_time : delta * IZR (shortest h) / W s <= time j - time i <= delta * IZR (longest h) / W s).
    { replace (time j - time i) with (W s * (time j - time i) / W s) by (field; lra). split; apply Rmult_le_compat_r; lra. }
    repeat split; lra.
Qed.
Lemma holds_fastest : holds fastest (A s * W s).
Proof. destruct described as ((dA & dW & _) & _). apply holds_mul; apply holds_range; assumption. Qed.
Lemma speeds_sound i : forallb check_speeds (runs r) = true -> in_region s r i -> is_as_fast s f i.
Proof.
  intros c (column & first & last & k & member & _ & o). rewrite forallb_forall in c. specialize (c _ member). unfold check_speeds in c. split_checks.
  apply Z.leb_le, IZR_le in k0. apply Qle_bool_iff, Qle_Rle in k1, k2.
  set (w := speed_seen s i) in *. assert (rp : 0 < IZR (Zpos (rows r))) by (apply IZR_lt; lia). assert (inv : 0 < / IZR (Zpos (rows r))) by (apply Rinv_0_lt_compat; lra).
  assert (over : IZR first / IZR (Zpos (rows r)) <= w) by (apply (Rmult_le_reg_r (IZR (Zpos (rows r)))); [exact rp|]; unfold Rdiv; rewrite Rmult_assoc, Rinv_l by lra; lra).
  assert (under : w <= IZR (last + 1) / IZR (Zpos (rows r))) by (apply (Rmult_le_reg_r (IZR (Zpos (rows r)))); [exact rp|]; unfold Rdiv; rewrite plus_IZR, Rmult_assoc, Rinv_l by lra; lra).
  assert (pos : 0 <= IZR first / IZR (Zpos (rows r))) by (apply Rmult_le_pos; lra).
  assert (scaled : forall n, holds (in_scene_units n) (A s * W s * (IZR n / IZR (Zpos (rows r))))).
  { intros n. apply holds_mul; [exact holds_fastest|]. apply holds_quotient; apply holds_whole. }
  assert (low := not_less_sound _ _ _ _ k3 (scaled _) (holds_number few _)). assert (high := not_less_sound _ _ _ _ c (holds_number few _) (scaled _)).
  assert (aw : 0 < A s * W s) by (apply Rmult_lt_0_compat; assumption).
  assert (size : Rabs (velocity i) = A s * W s * w).
  { assert (e1 : velocity i = side (wall_of i) * (A s * W s * w)) by (unfold w, speed_seen, unit_speed; destruct (wall_of i); cbn; field; lra).
    assert (0 <= A s * W s * w) by (apply Rmult_le_pos; lra). rewrite e1. destruct (wall_of i); cbn; [rewrite Rabs_left1 by lra|rewrite Rabs_pos_eq by lra]; ring. }
  split; split.
  - apply (Rle_trans _ _ _ k1 over).
  - apply (Rle_trans _ _ _ under k2).
  - rewrite size. apply (Rle_trans _ _ _ low). apply Rmult_le_compat_l; lra.
  - rewrite size. refine (Rle_trans _ _ _ _ high). apply Rmult_le_compat_l; lra.
Qed.

Lemma state_sound i T V : check_state (wall_of i) T V = true -> holds T (time i) -> holds V (velocity i) -> in_region s r i.
Proof.
  unfold check_state. intros c hT hV. set (turned := add few _ _) in c. destruct described as ((_ & dW & dt) & _). apply (holds_range few) in dW, dt.
  assert (pi := I.pi_correct (F.PtoP few)). change (holds (I.pi (F.PtoP few)) PI) in pi.
  assert (hp : holds turned (phase_seen s i)). { unfold turned, phase_seen, phase. destruct (wall_of i); cbn [seen]; enclose. }
  assert (hv : holds (sided (wall_of i) (quotient few V fastest)) (speed_seen s i)).
  { apply holds_sided. unfold unit_speed. apply holds_quotient; [exact hV|exact holds_fastest]. }
  set (column := quotient few (mul few turned _) _) in c. set (y := phase_seen s i / (2 * PI) * IZR (Zpos (columns r))).
  assert (hy : holds column y).
  { replace y with (phase_seen s i * IZR (Zpos (columns r)) / (2 * PI)) by (unfold y; field; apply PI_neq0). unfold column. enclose. }
  split_checks. assert (low := not_less_sound _ _ _ _ k0 hy (holds_whole _ _)). assert (high := not_less_sound _ _ _ _ k1 (holds_whole _ _) hy).
  assert (mp : 0 < IZR (Zpos (2 * fine h))) by (apply IZR_lt; lia).
  destruct (in_columns_sound r h _ _ _ _ y _ c low) as (col & in_it & o); [rewrite mult_IZR; apply Rmult_le_compat_r; lra|].
  apply (in_column_sound r h _ _ _ _ _ in_it); [exact (is_not_negative_sound _ _ k hv)|enclose|enclose|exact o].
Qed.
Lemma entry_sound n : check_entry n = true -> (n <> 0%Z -> claims (first_impacts param b x n)) -> comes_in s r b n.
Proof.
  unfold check_entry, comes_in. intros c told. destruct (n =? 0)%Z eqn:zero.
  - destruct b as [w t v|t y v]; [|discriminate]. intros i on_wall ht hv.
    apply (state_sound i (enclose_range few t) (enclose_range few v)); [rewrite on_wall; exact c|apply holds_range, ht|apply holds_range, hv].
  - intros l begin. apply Z.eqb_neq in zero. destruct (told zero) as [_ all]. destruct (all s l described begin) as (_ & _ & _ & motion & goes_so & shown_all & _ & ends_there).
    cbn [events first_impacts ended ends_so] in *. rewrite impacts_many in ends_there. destruct (impacts_alone _ _ shown_all) as (orbit & -> & each).
    destruct (rev (impacts_before x)) as [|last others_] eqn:reversed; [discriminate|].
    assert (split_ : impacts_before x = rev others_ ++ [last]) by (rewrite <- (rev_involutive (impacts_before x)), reversed; reflexivity).
    assert (count_ := as_many _ _ _ each). rewrite split_ in each. apply Forall2_app_inv_l in each as (before & tail & _ & final & ->).
    inversion final as [|y i ys is w none]; subst. inversion none; subst. exists before, i. split; [apply goes_follows, goes_so|]. split; [lia|].
    destruct w as (on_wall & ht & hv). apply (state_sound i _ _ ltac:(rewrite on_wall; exact c)); apply holds_spanned; assumption.
Qed.
End Scene.

Theorem trap_verified : verify_trap = true -> (forall n, entered f = Some n -> n <> 0%Z -> claims (first_impacts param b x n)) -> claims_region param b r f.
Proof.
  unfold verify_trap. intros v told. split_checks. destruct (single_sound _ _ k) as [pr sense]. split; [exact pr|].
  split; [apply count_sound; assumption|].
  assert (checked : check_flights = true) by assumption. split; [exact (flights_positive checked)|].
  intros s described. destruct (sense s described) as (good & one & A_positive & W_positive & gap_positive). split; [exact good|]. split; [exact one|].
  destruct (flights_sound s described W_positive checked) as (least_positive & lasts).
  assert (gap_over : 0 < d s / A s) by (apply Rdiv_lt_0_compat; assumption).
  assert (kept_all := boxes_kept r h units_in (d s / A s) (e s) _ _ gap_over eq_refl eq_refl (units_hold s described) v).
  assert (fast : forall i, in_region s r i -> is_as_fast s f i) by (intros i inr; exact (speeds_sound s described A_positive W_positive i ltac:(assumption) inr)).
  split.
  - intros i inr. split; [exact (fast i inr)|]. exact (region_kept s r _ _ A_positive W_positive gap_positive one kept_all least_positive f i fast lasts inr).
  - destruct (entered f) as [n|]; [|exact I]. apply (entry_sound s described n); [assumption|exact (told n eq_refl)].
Qed.
End Document.
End Traps.
