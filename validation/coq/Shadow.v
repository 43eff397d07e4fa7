(* The claims of the document of a shadowed orbit, and a program `verify_shadow` that verifies it, proved sound once and for all
   (`shadow_verified`): a start on the scene's wall, within the listed bounds, which hold the scene's own, and with its time or its velocity, has
   an orbit with the listed impacts. Parallelograms around the impacts are carried across one another, as Covering.v has it. The starts are a path
   across the first one; so a part of it keeps to all of them. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Float.Sig.
From ImpactPair Require Import Model Step Horseshoe Return Certificate Covering Document.
Open Scope R_scope.
Import ListNotations.

(* Bounds of the start; and how far the impacts are from the middles of their bounds at most, in forcing periods: half of
   them, and all. A forcing period is one of the fastest harmonic, which is the reference. *)
Record nearness := Nearness { start_times : Q * Q; start_velocities : Q * Q; half_within : Q; all_within : Q }.
(* Bounds of a start that is near the scene's: no more than a thousandth of a forcing period apart, and of A W. *)
Definition width (b : Q * Q) : R := Q2R (snd b) - Q2R (fst b).
Definition near (s : scene) (n : nearness) : Prop :=
  1000 * width (start_times n) <= period s /\ 1000 * width (start_velocities n) <= A s * W s.
Definition between_rationals (b : Q * Q) : range := Between (Rational (fst b)) (Rational (snd b)).
Definition middle_time (b : bounds) : R := (Q2R (time_lower b) + Q2R (time_upper b)) / 2.
Definition off (s : scene) (b : bounds) (i : impact) : R := Rabs (time i - middle_time b) / period s.

(* n members or more have a property. *)
Fixpoint at_least {X : Type} (P : X -> Prop) (n : nat) (xs : list X) : Prop :=
  match xs with
  | [] => n = O
  | x :: xs => at_least P n xs \/ exists k, n = Datatypes.S k /\ P x /\ at_least P k xs
  end.
Definition as_near (s : scene) (n : nearness) (events : list event) (orbit : list impact) : Prop :=
  Forall2 (fun x i => off s (shown x) i <= Q2R (all_within n)) events orbit /\
  exists half, (length events <= 2 * half)%nat /\
    at_least (fun xi => off s (shown (fst xi)) (snd xi) <= Q2R (half_within n)) half (combine events orbit).

Definition claims_shadow (x : document_of event) (n : nearness) : Prop := all_proper (scene_data x) (begun x) /\
  match begun x with
  | Inside _ _ _ => False
  | Struck w times velocities => forall s t v, describes (scene_data x) s -> among times t -> among velocities v ->
    sensible s /\ is_fastest s /\ near s n /\ in_bounds (start_times n) t /\ in_bounds (start_velocities n) v /\
    (forall v, in_bounds (start_velocities n) v -> 0 <= side w * v) /\
    exists i, wall_of i = w /\ in_bounds (start_times n) (time i) /\ in_bounds (start_velocities n) (velocity i) /\
      (time i = t \/ velocity i = v) /\
      exists orbit, follows s (rebound s i) orbit /\ tells (Some w) 1 (events x) orbit /\
        ends s (rebound s i) orbit (ended x) /\ as_near s n (events x) orbit
  end.

(* Hints for the check: a parallelogram of starts, of which one half vector is a velocity and the other a phase, the starts being a line along the
   first of them; and one for each impact, with the link that leads to it. For an outcome `time-reached` the next impact is the last of these, with
   bounds of it. Nothing is claimed of it. *)
Record chain := Chain { chain_bits : positive; chain_scale : positive; first_chart : chart; links : list (link * chart); afterwards : option bounds }.
Definition with_next (events : list event) (next : option bounds) : list event :=
  events ++ match next with None => [] | Some b => [Event 0 None b] end.

(* The flights from wall to wall. *)
Fixpoint flights (w : wall) (events : list event) : list hop_of :=
  match events with [] => [] | x :: events => Hop w (on (shown x)) 0 :: flights (on (shown x)) events end.

(* Phases and speeds of a parallelogram. *)
Definition phase_reach (N : chart) : Z := (Z.abs (lu N) + Z.abs (wu N))%Z.
Definition speed_reach (N : chart) : Z := (Z.abs (lv N) + Z.abs (wv N))%Z.

Module Shadows (F : FloatOps with Definition sensible_format := true).
Module Import Each := Verifier F.
Module Import Cover := Coverings F.

Section Program.
Variables p q : positive.
Variable param : data.
Notation step := (unit_step p q).

Definition phases (N : chart) : I.type := stretch p step (cu N - phase_reach N) (cu N + phase_reach N).
Definition speeds (N : chart) : I.type := stretch p step (cv N - speed_reach N) (cv N + speed_reach N).
Definition one_speed (V : range) : I.type := quotient p (enclose_range p V) (velocity_over param p (whole p 1)).
Definition check_near (n : nearness) : bool :=
  let width b := mul p (whole p 1000) (sub p (known_number p (snd b)) (known_number p (fst b))) in
  let turn := quotient p (mul p (whole p 2) (I.pi (F.PtoP p))) (enclose_range p (frequency param)) in
  is_not_negative (sub p turn (width (start_times n))) &?
  is_not_negative (sub p (velocity_over param p (whole p 1)) (width (start_velocities n))).
(* The starts with the scene's time, or with its velocity, cross it. *)
Definition check_first (T V : range) (n : nearness) (N : chart) : bool :=
  (0 <? chart_area N)%Z &?
  if (lu N =? 0)%Z && (wv N =? 0)%Z then
    between p step (phase_over param p (enclose_range p T)) (cu N - phase_reach N) (cu N + phase_reach N) &?
    is_within p (start_velocities n) (velocity_over param p (speeds N))
  else (lv N =? 0)%Z &? (wu N =? 0)%Z &?
    between p step (one_speed V) (cv N - speed_reach N) (cv N + speed_reach N) &?
    bounded p (phase_over param p (known_number p (fst (start_times n)))) (phases N) (phase_over param p (known_number p (snd (start_times n)))).

Definition check_off (N : chart) (b : bounds) (most : Q) : bool :=
  let X := sub p (phases N) (phase_over param p (quotient p (add p (known_number p (time_lower b)) (known_number p (time_upper b))) (whole p 2))) in
  let M := mul p (mul p (whole p 2) (I.pi (F.PtoP p))) (known_number p most) in
  is_not_negative (sub p M X) &? is_not_negative (add p M X).
Definition check_place (b : bounds) (N : chart) : bool :=
  (0 <? chart_area N)%Z &?
  check_shown param p step (cu N - phase_reach N) (cu N + phase_reach N) (cv N - speed_reach N) (cv N + speed_reach N) b.
Definition check_node (n : nearness) (x : event) (N : chart) : bool := check_place (shown x) N &? check_off N (shown x) (all_within n).
Fixpoint check_nodes (n : nearness) (events : list event) (next : option bounds) (way : list (link * chart)) : bool :=
  match events, way with
  | x :: events, (_, N) :: way => check_node n x N &? check_nodes n events next way
  | [], [] => match next with None => true | Some _ => false end
  | [], (_, N) :: _ => match next with None => false | Some b => check_place b N end
  | _, _ => false
  end.
Fixpoint near_ones (n : nearness) (events : list event) (way : list (link * chart)) : nat :=
  match events, way with
  | x :: events, (_, N) :: way =>
    let rest := near_ones n events way in if check_off N (shown x) (half_within n) then Datatypes.S rest else rest
  | _, _ => O
  end.

Variable s : scene.
Hypothesis described : describes param s.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.

Lemma grid_around c r x : Rabs (x - grid q c) <= grid q r -> grid q (c - r) <= x <= grid q (c + r).
Proof. intros h. apply Rabs_le_between in h. unfold Z.sub. rewrite !grid_plus, grid_opp. lra. Qed.

Lemma near_sound n : check_near n = true -> near s n.
Proof.
  unfold check_near. cbv zeta. intros check. split_checks.
  assert (narrow : forall b, holds (mul p (whole p 1000) (sub p (known_number p (snd b)) (known_number p (fst b)))) (1000 * width b)).
  { intros b. assert (l := holds_number p (fst b)). assert (h := holds_number p (snd b)). unfold width. enclose. }
  assert (turn : holds (quotient p (mul p (whole p 2) (I.pi (F.PtoP p))) (enclose_range p (frequency param))) (period s)).
  { destruct described as ((_ & dW & _) & _). unfold period.
    apply holds_quotient; [apply holds_mul; [apply holds_whole|apply I.pi_correct]|exact (holds_range p _ _ dW)]. }
  assert (fast := holds_velocity_over param s described p _ _ (holds_whole p 1)). rewrite Rmult_1_r in fast.
  assert (h1 := narrow (start_times n)). assert (h2 := narrow (start_velocities n)).
  assert (0 <= period s - 1000 * width (start_times n)) by (apply (is_not_negative_sound _ _ k); enclose).
  assert (0 <= A s * W s - 1000 * width (start_velocities n)) by (apply (is_not_negative_sound _ _ check); enclose).
  unfold near. lra.
Qed.

Lemma off_sound w N b most x : (0 < chart_area N)%Z -> in_frame (frame_of q N) x -> check_off N b most = true ->
  off s b (impact_at s w x) <= Q2R most.
Proof.
  intros area inside check. unfold check_off in check. cbv zeta in check. split_checks.
  destruct (chart_bounds q N x area inside) as [r _]. apply grid_around in r.
  assert (hX := holds_stretch p q _ (unit_step_holds p q) _ _ _ r). fold (phases N) in hX.
  assert (l := holds_number p (time_lower b)). assert (h := holds_number p (time_upper b)). assert (m := holds_number p most).
  assert (mid : holds (phase_over param p (quotient p (add p (known_number p (time_lower b)) (known_number p (time_upper b))) (whole p 2)))
    (phase s (middle_time b))).
  { apply (holds_phase_over param s described). unfold middle_time. enclose. }
  assert (turn : holds (mul p (mul p (whole p 2) (I.pi (F.PtoP p))) (known_number p most)) (2 * PI * Q2R most)).
  { apply holds_mul; [|exact m]. apply holds_mul; [apply holds_whole|apply I.pi_correct]. }
  assert (0 <= 2 * PI * Q2R most - (fst x - phase s (middle_time b))) by (apply (is_not_negative_sound _ _ k); enclose).
  assert (0 <= 2 * PI * Q2R most + (fst x - phase s (middle_time b))) by (apply (is_not_negative_sound _ _ check); enclose).
  assert (pi := PI_RGT_0). unfold off, impact_at, period. cbn [time].
  assert (eq : fst x - phase s (middle_time b) = W s * ((fst x - tau s) / W s - middle_time b)) by (unfold phase; field; lra).
  rewrite eq in *. set (away := (fst x - tau s) / W s - middle_time b) in *.
  assert (Rabs away * W s <= 2 * PI * Q2R most).
  { rewrite <- (Rabs_pos_eq (W s)) by lra. rewrite <- Rabs_mult. apply Rabs_le. lra. }
  replace (Rabs away / (2 * PI / W s)) with (Rabs away * W s / (2 * PI)) by (field; lra).
  apply (Rmult_le_reg_r (2 * PI)); [lra|]. replace (Rabs away * W s / (2 * PI) * (2 * PI)) with (Rabs away * W s) by (field; lra). lra.
Qed.

Lemma place_sound w b N x : w = on b -> in_frame (frame_of q N) x -> check_place b N = true -> within b (impact_at s w x).
Proof.
  intros same inside check. unfold check_place in check. split_checks. apply Z.ltb_lt in k.
  destruct (chart_bounds q N x k inside) as [r1 r2].
  apply (shown_sound param s described A_positive W_positive p q _ _ _ _ b _ check).
  - exact same.
  - rewrite phase_at by assumption. apply grid_around, r1.
  - rewrite speed_at by assumption. apply grid_around, r2.
Qed.
Lemma place_area b N : check_place b N = true -> (0 < chart_area N)%Z.
Proof. unfold check_place. intros check. split_checks. apply Z.ltb_lt. assumption. Qed.

(* The orbit, and the next impact where one is given. *)
Lemma chain_sound n next events : forall way w N x, check_way p q param (flights w (with_next events next)) N way = true ->
  check_nodes n events next way = true -> keeps q s (flights w (with_next events next)) N way x ->
  exists orbit later, follows s (rebound s (impact_at s w x)) (orbit ++ later) /\ Forall2 within (map shown events) orbit /\
    Forall2 (fun y i => off s (shown y) i <= Q2R (all_within n)) events orbit /\
    at_least (fun yi => off s (shown (fst yi)) (snd yi) <= Q2R (half_within n)) (near_ones n events way) (combine events orbit) /\
    match next with None => later = [] | Some b => exists i, later = [i] /\ within b i end.
Proof.
  induction events as [|y events IH]; intros way w N x check nodes kept.
  - exists []. destruct next as [b|], way as [|[l M] way]; cbn in check, nodes; try discriminate; cbn in kept.
    + destruct way as [|[? ?] ?]; cbn in check; split_checks; try discriminate.
      set (h := Hop w (on b) 0) in *. destruct kept as [here _].
      destruct (link_sound p q param s described A_positive W_positive gap_positive h N M l k) as [flight _].
      destruct (flight x here) as [_ fl]. cbn [off_wall on_wall h] in fl. destruct here as [_ inside].
      assert (same : hop s h x = fly s w x) by (unfold hop, h; cbn [off_wall turns_off]; apply turned_none). rewrite same in inside.
      exists [impact_at s (on b) (fly s w x)]. split; [split; [exact fl|exact I]|]. split; [constructor|]. split; [constructor|]. split; [reflexivity|].
      exists (impact_at s (on b) (fly s w x)). split; [reflexivity|]. exact (place_sound (on b) b M _ eq_refl inside nodes).
    + exists []. cbn. repeat constructor.
  - destruct way as [|[l M] way]; cbn [with_next app flights check_way check_nodes] in check, nodes; try discriminate. fold (with_next events next) in check.
    split_checks. cbn [with_next app flights keeps] in kept. fold (with_next events next) in kept. destruct kept as [here rest].
    set (h := Hop w (on (shown y)) 0) in *. set (w1 := on (shown y)) in *.
    destruct (link_sound p q param s described A_positive W_positive gap_positive h N M l k0) as [flight _].
    destruct (flight x here) as [_ fl]. cbn [off_wall on_wall h] in fl.
    assert (same : hop s h x = fly s w x) by (unfold hop, h; cbn [off_wall turns_off]; apply turned_none).
    destruct here as [_ inside]. rewrite same in inside, rest.
    destruct (IH way w1 M (fly s w x) check nodes rest) as (orbit & later & f & all & offs & half & after).
    unfold check_node in k. split_checks. assert (area := place_area _ _ k1).
    assert (shown_in := place_sound w1 (shown y) M (fly s w x) eq_refl inside k1).
    exists (impact_at s w1 (fly s w x) :: orbit), later. split; [split; [exact fl|exact f]|]. split; [constructor; assumption|].
    split; [constructor; [exact (off_sound w1 M _ _ _ area inside k)|exact offs]|]. split; [|exact after]. cbn [near_ones combine at_least]. cbv zeta.
    destruct (check_off M (shown y) (half_within n)) eqn:close; [right|left; exact half].
    exists (near_ones n events way). split; [reflexivity|]. split; [exact (off_sound w1 M _ _ _ area inside close)|exact half].
Qed.

Lemma grid_absolute m : grid q (Z.abs m) = Rabs (grid q m).
Proof. assert (g := grid_step q). unfold grid. rewrite abs_IZR, Rabs_mult, (Rabs_pos_eq (/ _)); [reflexivity|lra]. Qed.
(* A number within the reach of a half side is a part of it away. *)
Lemma a_part c r x : grid q r <> 0 -> grid q (c - Z.abs r) <= x <= grid q (c + Z.abs r) ->
  exists eta, -1 <= eta <= 1 /\ x = grid q c + grid q r * eta.
Proof.
  intros side_of h. unfold Z.sub in h. rewrite !grid_plus, grid_opp, grid_absolute in h.
  exists ((x - grid q c) / grid q r). split; [|field; exact side_of].
  apply Rabs_le_between. unfold Rdiv. rewrite Rabs_mult, Rabs_inv. assert (away : Rabs (x - grid q c) <= Rabs (grid q r)) by (apply Rabs_le; lra).
  apply (Rmult_le_reg_r (Rabs (grid q r))); [apply Rabs_pos_lt, side_of|].
  rewrite Rmult_assoc, Rinv_l, Rmult_1_r, Rmult_1_l by (apply Rabs_no_R0, side_of). exact away.
Qed.

(* A path of starts across the first parallelogram. *)
Lemma first_sound T V n N w t v : check_first T V n N = true -> among T t -> among V v ->
  in_bounds (start_times n) t -> in_bounds (start_velocities n) v -> exists eta, -1 <= eta <= 1 /\
  forall x, -1 <= x <= 1 -> let i := impact_at s w (put (frame_of q N) x eta) in
    in_bounds (start_times n) (time i) /\ in_bounds (start_velocities n) (velocity i) /\ (time i = t \/ velocity i = v).
Proof.
  intros check at_t at_v t_in v_in. unfold check_first in check. split_checks. apply Z.ltb_lt in k.
  assert (area_of := chart_area_positive q N k). assert (zero : grid q 0 = 0) by (unfold grid; ring).
  assert (inside : forall eta, -1 <= eta <= 1 -> forall x, -1 <= x <= 1 -> in_frame (frame_of q N) (put (frame_of q N) x eta)).
  { intros eta he x hx. unfold in_frame, slice. rewrite put_along, put_across by (apply Rgt_not_eq, area_of). lra. }
  unfold area, frame_of in area_of. cbn [long wide fst snd] in area_of.
  destruct ((lu N =? 0)%Z && (wv N =? 0)%Z) eqn:which.
  - apply andb_prop in which as [k0 which]. apply Z.eqb_eq in k0. apply Z.eqb_eq in which. rewrite k0, which, zero in area_of. split_checks.
    assert (r := between_sound _ _ _ _ _ _ k1 (holds_phase_over param s described p _ _ (holds_range p _ _ at_t))).
    unfold phase_reach in r. rewrite k0 in r. cbn [Z.abs Z.add] in r.
    destruct (a_part (cu N) (wu N) (phase s t)) as (eta & he & eq); [intros z; rewrite z in area_of; lra|exact r|].
    exists eta. split; [exact he|]. intros x hx i. assert (same : time i = t).
    { unfold i, impact_at, put, frame_of. cbn [time fst snd centre long wide]. rewrite k0, zero. replace (_ + _ + _) with (phase s t) by (rewrite eq; ring).
      unfold phase. field. lra. }
    split; [rewrite same; exact t_in|]. split; [|left; exact same].
    destruct (chart_bounds q N _ k (inside eta he x hx)) as [_ near]. apply grid_around in near.
    apply (is_within_sound _ _ _ _ check). unfold i. cbn [velocity impact_at].
    apply (holds_velocity_over param s described), (holds_stretch p q _ (unit_step_holds p q)), near.
  - split_checks. apply Z.eqb_eq in k0. apply Z.eqb_eq in k1. rewrite k0, k1, zero in area_of.
    assert (unit_of : holds (one_speed V) (v / (A s * W s * 1))).
    { apply holds_quotient; [apply holds_range, at_v|]. apply (holds_velocity_over param s described), holds_whole. }
    assert (r := between_sound _ _ _ _ _ _ k2 unit_of). unfold speed_reach in r. rewrite k0 in r. cbn [Z.abs Z.add] in r.
    destruct (a_part (cv N) (wv N) (v / (A s * W s * 1))) as (eta & he & eq); [intros z; rewrite z in area_of; lra|exact r|].
    exists eta. split; [exact he|]. intros x hx i. assert (same : velocity i = v).
    { unfold i, impact_at, put, frame_of. cbn [velocity fst snd centre long wide]. rewrite k0, zero.
      replace (_ + _ + _) with (v / (A s * W s * 1)) by (rewrite eq; ring). field. lra. }
    split; [|split; [rewrite same; exact v_in|right; exact same]].
    destruct (chart_bounds q N _ k (inside eta he x hx)) as [near _]. apply grid_around in near.
    set (y := put (frame_of q N) x eta) in *. assert (back : phase s (time i) = fst y) by (apply phase_at; assumption). rewrite <- back in near.
    assert (hX := holds_stretch p q _ (unit_step_holds p q) _ _ _ near). fold (phases N) in hX.
    assert (bounds := bounded_sound _ _ _ _ _ _ _ check (holds_phase_over param s described p _ _ (holds_number _ _)) hX
      (holds_phase_over param s described p _ _ (holds_number _ _))).
    unfold in_bounds, phase in *. nra.
Qed.
End Program.

Definition verify_shadow (x : document_of event) (n : nearness) (h : chain) : bool :=
  let p := chain_bits h in let q := chain_scale h in let param := scene_data x in
  match begun x with
  | Struck w times velocities =>
    check_data p param && check_beginning p param (begun x) && check_beginning p param (Struck w times (between_rationals (start_velocities n))) &&
    is_positive (enclose_range p (amplitude param)) && check_fastest p param && check_near p param n &&
    is_within p (start_times n) (enclose_range p times) &&
    is_within p (start_velocities n) (enclose_range p velocities) && check_outcome p (ended x) (events x) (afterwards h) &&
    numbered (Some w) 1 (events x) && check_first p q param times velocities n (first_chart h) &&
    check_way p q param (flights w (with_next (events x) (afterwards h))) (first_chart h) (links h) &&
    check_nodes p q param n (events x) (afterwards h) (links h) && (length (events x) <=? 2 * near_ones p q param n (events x) (links h))%nat
  | Inside _ _ _ => false
  end.

Theorem shadow_verified x n h : verify_shadow x n h = true -> claims_shadow x n.
Proof.
  unfold verify_shadow, claims_shadow. cbv zeta. set (p := chain_bits h). set (q := chain_scale h).
  destruct (begun x) as [w times velocities|] eqn:begin; [|discriminate].
  intros v. apply andb_prop in v as [v halves]. apply andb_prop in v as [v nodes]. apply andb_prop in v as [v carried].
  apply andb_prop in v as [v start_on]. apply andb_prop in v as [v names]. apply andb_prop in v as [v ending].
  apply andb_prop in v as [v velocity_in]. apply andb_prop in v as [v time_in]. apply andb_prop in v as [v close].
  apply andb_prop in v as [v fastest]. apply andb_prop in v as [v positive]. apply andb_prop in v as [v near_start]. apply andb_prop in v as [v start_good].
  destruct (data_sound p _ _ v start_good) as [pr sense]. destruct (data_sound p _ _ v near_start) as [_ sense'].
  split; [exact pr|]. intros s t u described at_t at_u.
  destruct (sense s described) as [good _]. destruct (sense' s described) as [_ inwards]. split; [exact good|].
  destruct good as (tones & gap_positive & _). assert (W_positive : 0 < W s) by (inversion tones; tauto).
  assert (A_positive : 0 < A s).
  { destruct described as ((dA & _) & _). exact (is_positive_sound _ _ positive (holds_range p _ _ dA)). }
  assert (t_in := is_within_sound p _ _ _ time_in (holds_range p _ _ at_t)).
  assert (u_in := is_within_sound p _ _ _ velocity_in (holds_range p _ _ at_u)).
  split; [exact (fastest_sound p _ s described fastest)|]. split; [exact (near_sound p _ s described n close)|].
  split; [exact t_in|]. split; [exact u_in|]. split; [intros z hz; exact (inwards z hz)|].
  set (N := first_chart h) in *.
  destruct (first_sound p q _ s described A_positive W_positive times velocities n N w t u start_on at_t at_u t_in u_in) as (eta & he & started).
  assert (positive_area : area (frame_of q N) <> 0).
  { unfold check_first in start_on. split_checks. apply Rgt_not_eq, chart_area_positive, Z.ltb_lt. assumption. }
  destruct (way_sound p q _ s described A_positive W_positive gap_positive _ _ _ carried) as [(_ & _ & cross) _].
  destruct (cross _ _ _ (crosses_at _ eta positive_area he)) as (a & b & la & lb & kept & (ab & _)). specialize (kept a ltac:(lra)).
  set (y := put (frame_of q N) a eta) in *.
  destruct (chain_sound p q _ s described A_positive W_positive gap_positive n (afterwards h) (events x) (links h) w N y carried nodes kept)
    as (orbit & later & f & all & offs & half & next).
  destruct (started a ltac:(lra)) as (time_of & velocity_of & own). fold y in time_of, velocity_of, own.
  exists (impact_at s w y). split; [reflexivity|]. split; [exact time_of|]. split; [exact velocity_of|]. split; [exact own|].
  apply follows_app in f as [f f'].
  exists orbit. split; [exact f|]. split; [exact (numbered_tells _ _ _ _ names all)|].
  assert (len := as_many _ _ _ all). rewrite map_length in len.
  split; [|split; [exact offs|exists (near_ones p q (scene_data x) n (events x) (links h)); split; [apply Nat.leb_le, halves|exact half]]].
  unfold check_outcome, count in ending. destruct (ended x) as [m|m T|m T c k], (afterwards h) as [b'|]; try discriminate; cbn.
  - apply Z.eqb_eq in ending. rewrite <- len. exact ending.
  - apply andb_prop in ending as [number until]. apply Z.eqb_eq in number. destruct next as (i & eq & i_in). rewrite eq in f'.
    destruct (until_sound _ _ _ _ _ _ until all i_in) as (def & before & after_T).
    split; [exact def|]. split; [rewrite <- len; exact number|]. split; [exact before|]. exists i. split; [apply f'|exact after_T].
Qed.
End Shadows.
