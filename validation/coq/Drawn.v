(* Programs that verify documents of periodic orbits (`verify_cycles`), and of motions that a stable periodic orbit attracts (`verify_drawn`), with the proofs
   that they are right (`cycles_verified`, `drawn_verified`). *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Horseshoe Return Covering Certificate Document Banach Jacobian Rounds Discs Motion Orbit Cycle Cycles.
Open Scope R_scope.
Import ListNotations.

(* The passage of the motion into the ellipse: the number of listed events before the impact from which on it repeats the walls, and up to the one
   that is followed on; how many rounds until it is there; a box of that impact, the flights after it, and whole forcing periods. *)
Record approach_to := Approach { listed_before : nat; listed_until : nat; rounds_until : nat; last_listed : cell; flights_on : list passage; turns_until : Z }.

Fixpoint walls_listed (listed : list occurrence) : option (list wall) :=
  match listed with
  | [] => Some []
  | Impact_at x :: listed => option_map (cons (on (shown x))) (walls_listed listed)
  | _ => None
  end.
Definition last_impact (listed : list occurrence) : option bounds :=
  match rev listed with Impact_at x :: _ => Some (shown x) | _ => None end.

(* The first impact of round n from a state y on, the round n of the map P, with whole periods. *)
Definition visit (s : scene) (w : wall) (cycles_of : Z) (walls : list wall) (y : state) (turn : Z) (n : nat) : impact :=
  periods_later s (turn + Z.of_nat n * cycles_of) (impact_at s w (Nat.iter n (fun x => turned cycles_of (fly_on s w walls x)) y)).
Definition first_events (n : nat) (x : document) : document := Document (scene_data x) (begun x) (firstn n (events x)) (ended x).
Lemma drawn_longer s listed more motion motion' from c i orbit : Forall2 shows listed motion ->
  is_drawn s listed motion from c i orbit -> is_drawn s (listed ++ more) (motion ++ motion') from c i orbit.
Proof.
  intros all (before & j & (rest & motion_is) & number & draws). exists before, j. split; [exists (rest ++ motion'); rewrite motion_is, <- app_assoc; reflexivity|].
  split; [|exact draws]. rewrite firstn_app.
  replace (S (length before) - length listed)%nat with 0%nat; [rewrite firstn_O, app_nil_r; exact number|].
  assert (len := as_many _ _ _ all). rewrite motion_is, app_length in len. cbn [length] in len. lia.
Qed.

Module Drawings (F : FloatOps with Definition sensible_format := true).
Module Import Cyc := Cycles F.
Import Cyc.Disc.
Import Cyc.Disc.Round.
Import Cyc.Disc.Round.Each.
Import Cyc.Disc.Round.Each.Check.
Local Opaque add sub mul quotient whole hull sine cosine.

Fixpoint check_all (param : data) (orbits : list cycle) (hints : list surroundings) : bool :=
  match orbits, hints with
  | [], [] => true
  | c :: orbits, h :: hints => check_cycle param c h && check_all param orbits hints
  | _, _ => false
  end.
(* Orbits of which none is listed twice. *)
Definition apart_cycles (a b : cycle) : bool := match spots a with [] => false | first :: _ => forallb (apart_spots first) (spots b) end.
Fixpoint check_distinct (orbits : list cycle) : bool := match orbits with [] => true | c :: orbits => forallb (apart_cycles c) orbits && check_distinct orbits end.
Definition verify_cycles (param : data) (b : beginning) (orbits : list cycle) (hints : list surroundings) : bool :=
  check_single param b && check_distinct orbits && check_all param orbits hints.

Lemma apart_cycles_sound (s : scene) a b o o' : 0 < W s -> apart_cycles a b = true -> is_cycle s a (fst o) (snd o) -> is_cycle s b (fst o') (snd o') -> others_than s o o'.
Proof.
  intros W_positive check (_ & _ & _ & _ & _ & (f & own & _) & _) (_ & _ & _ & _ & _ & (f' & theirs & _) & _) n k lt. unfold apart_cycles in check.
  destruct (spots a) as [|x more] eqn:listed; [discriminate|]. inversion own as [|x' i xs is first rest eq1 eq2]; subst.
  destruct (snd o) as [|i1 orbit]; [discriminate eq2|]. cbn [length firstn] in eq2. injection eq2 as first_is _. subst i.
  assert (len := as_many _ _ _ theirs). assert (in_list : (n < length (firstn (length (snd o')) (fst o' :: snd o')))%nat) by (rewrite firstn_length; cbn [length]; lia).
  assert (shown := forall2_nth _ x (fst o') _ _ theirs n in_list).
  replace (nth n (firstn (length (snd o')) (fst o' :: snd o')) (fst o')) with (nth n (fst o' :: snd o') (fst o')) in shown.
  - rewrite forallb_forall in check. apply (apart_spots_sound s x (nth n (spots b) x) f f' (fst o) _ W_positive); [|exact first|exact shown].
    apply check, nth_In. rewrite len. exact in_list.
  - rewrite <- (firstn_skipn (length (snd o')) (fst o' :: snd o')) at 1. apply app_nth1. exact in_list.
Qed.

Theorem cycles_verified param b orbits hints : verify_cycles param b orbits hints = true -> claims_cycles param b orbits.
Proof.
  unfold verify_cycles. intros v. apply andb_prop in v as [v all]. apply andb_prop in v as [single distinct].
  destruct (single_sound _ _ single) as [pr sense]. split; [exact pr|]. intros s described.
  destruct (sense s described) as (sens & one & A_positive & W_positive & gap_positive). split; [exact sens|]. split; [exact one|].
  clear - described A_positive W_positive gap_positive all distinct. revert hints all distinct.
  induction orbits as [|c orbits IH]; intros [|h hints] all distinct; cbn in all, distinct; try discriminate; [exists []; split; constructor|].
  apply andb_prop in all as [check all]. apply andb_prop in distinct as [apart distinct]. destruct (IH _ all distinct) as (found & are & pairs).
  destruct (cycle_sound param s described A_positive W_positive gap_positive c h check) as (w & x & _ & _ & _ & _ & _ & is_one).
  exists ((impact_at s (spot_wall w) x, impacts_on s (spot_wall w) (map onto (way (wide_disc h))) x) :: found). split; [constructor; [exact is_one|exact are]|]. constructor; [|exact pairs].
  rewrite forallb_forall in apart. clear - W_positive apart are is_one. induction are as [|c' o cs os one are IH]; constructor.
  - exact (apart_cycles_sound s c c' (_, _) o W_positive (apart c' (or_introl eq_refl)) is_one one).
  - apply IH. intros y i. apply apart. right. exact i.
Qed.

Section Program.
Variable param : data.

Section On.
Variables p q : positive.
(* Flights from box to box. *)
Fixpoint check_flights (w : wall) (B : cell) (way : list passage) : bool :=
  match way with [] => true | z :: way => lands p q param w B (centre_leg p q z) (centre_image z) &? check_flights (onto z) (centre_image z) way end.
Definition cell_of (b : bounds) (B : cell) : bool :=
  in_cell p q (phase_over param p (spanned p (time_lower b, time_upper b))) (unit_of param p (velocity_lower b, velocity_upper b)) B.
End On.

Definition check_approach (x : document) (from : Z) (w : wall) (h : disc) (a : approach_to) : bool :=
  let p := disc_bits h in let q := disc_scale h in let walls := map onto (way h) in
  let before := firstn (listed_before a) (events x) in let rest := skipn (listed_before a) (events x) in
  match last_impact (events x), last_impact before, walls_listed rest with
  | Some b, Some b0, Some ws =>
    let last_cell := centre_at_end (last_listed a) (flights_on a) in
    (impacts before =? from)%Z &? same_wall (on b0) w &? same_walls (ws ++ map onto (flights_on a)) (concat (repeat walls (rounds_until a))) &?
    (0 <? rounds_until a)%nat &? is_plain h &? cell_of p q b (last_listed a) &? check_flights p q (on b) (last_listed a) (flights_on a) &?
    has_box h (sub p (phases_of p q last_cell) (half_turns_in p (2 * turns_until a))) (speeds_of p q last_cell)
  | _, _, _ => false
  end.

Variable s : scene.
Hypothesis described : describes param s.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.

Lemma cell_of_sound p q b B i : cell_of p q b B = true -> within b i -> lies q B (point_of s i).
Proof.
  intros check (_ & times & speeds). apply (in_cell_sound p q _ _ _ _ check).
  - apply (holds_phase_over param s described). exact (holds_spanned p (time_lower b, time_upper b) _ times).
  - apply (holds_unit param s described p (velocity_lower b, velocity_upper b)). exact speeds.
Qed.
Lemma flights_sound p q way : forall w B x, check_flights p q w B way = true -> lies q B x ->
  all_fly s w (map onto way) x /\ lies q (centre_at_end B way) (fly_on s w (map onto way) x).
Proof.
  induction way as [|z way IH]; intros w B x check inside; [split; [exact I|exact inside]|]. cbn [check_flights] in check. split_checks.
  destruct (lands_sound p q param s described A_positive W_positive gap_positive w B (centre_leg p q z) _ x eq_refl eq_refl eq_refl k inside) as [fl next_in].
  destruct (IH _ _ _ check next_in) as [a l]. split; [split; [exact fl|exact a]|exact l].
Qed.

Lemma last_impact_shown listed motion b : last_impact listed = Some b -> Forall2 shows listed motion -> exists before i, motion = before ++ [Hits i] /\ within b i.
Proof.
  unfold last_impact. destruct (rev listed) as [|[x|? ? ? ?|? ? ?] more] eqn:r; try discriminate. intros eq all. injection eq as <-.
  assert (list_is : listed = rev more ++ [Impact_at x]) by (rewrite <- (rev_involutive listed), r; reflexivity). rewrite list_is in all.
  apply Forall2_app_inv_l in all as (m1 & m2 & _ & tail & ->). inversion tail as [|o h os hs one none]; subst. inversion none; subst.
  destruct h as [i|? ? ?|? ?]; cbn in one; try contradiction. exists m1, i. split; [reflexivity|exact one].
Qed.
Lemma walls_listed_shown listed : forall l motion walls, walls_listed listed = Some walls -> Forall2 shows listed motion -> goes s (Flying l) motion ->
  exists orbit, motion = map Hits orbit /\ follows s l orbit /\ map wall_of orbit = walls.
Proof.
  induction listed as [|[x|? ? ? ?|? ? ?] listed IH]; intros l motion walls eq all g; cbn in eq; try discriminate.
  - injection eq as <-. inversion all; subst. exists []. repeat split.
  - inversion all as [|o h os hs one rest]; subst. destruct h as [i|? ? ?|? ?]; cbn in one; try contradiction. destruct g as [r g].
    destruct (walls_listed listed) as [more|] eqn:eq'; [|discriminate]. injection eq as <-. destruct (IH _ _ _ eq_refl rest g) as (orbit & -> & f & ws).
    exists (i :: orbit). split; [reflexivity|]. split; [split; [exact r|exact f]|]. cbn. rewrite ws. f_equal. apply one.
Qed.
Lemma after_hits orbit : forall l, after_all s (Flying l) (map Hits orbit) = Flying (after s l orbit).
Proof. induction orbit as [|i orbit IH]; intros l; [reflexivity|]. apply IH. Qed.

(* Impacts after rounds from a state of the ellipse, as many periods later. *)
Section Tends.
Variables (w : wall) (cycles_of : Z) (h : disc).
Hypothesis checked : check_disc param w cycles_of h = true.
Hypothesis plain : is_plain h = true.
Hypothesis one : one_harmonic s.
Let walls := map onto (way h).
Let N := frame_of (disc_scale h) (disc_chart h).
Let P (x : state) : state := turned cycles_of (fly_on s w walls x).
Variables x y : state.
Hypothesis x_in : in_ellipse N x.
Hypothesis x_back : P x = x.
Hypothesis y_in : in_ellipse N y.
Variable turn : Z.
Let visit : nat -> impact := visit s w cycles_of walls y turn.

Lemma visits_stay n : in_ellipse N (Nat.iter n P y).
Proof. exact (proj1 (disc_attracts param w cycles_of h s described A_positive W_positive gap_positive checked x y plain x_in x_back y_in n)). Qed.
Lemma visit_leads n : exists again, leads s (rebound s (visit n)) walls again (visit (S n)).
Proof.
  set (z := Nat.iter n P y). assert (inside := visits_stay n). fold z in inside.
  destruct (disc_flies param w cycles_of h s described A_positive W_positive gap_positive checked z inside) as [flown _]. fold walls in flown.
  assert (some : walls <> []) by (assert (o := some_walls param w cycles_of h checked); unfold walls; destruct (way h); [destruct (o eq_refl)|discriminate]).
  assert (back := walls_come_back param w cycles_of h checked). fold walls in back.
  set (shift := IZR (turn + Z.of_nat n * cycles_of) * period s). exists (map (later shift) (impacts_on s w walls z)).
  replace (visit (S n)) with (later shift (impact_at s w (fly_on s w walls z))).
  - apply leads_later; [apply turns_recur; assumption|]. split; [exact (impacts_follow s walls w z flown)|]. split; [apply impacts_walls|].
    assert (e := impacts_last s walls w z). rewrite (last_default walls w (opposite w) some), back in e. rewrite <- e at 2. apply last_default.
    intros none. assert (ws := impacts_walls s walls w z). rewrite none in ws. cbn in ws. congruence.
  - unfold visit, Drawn.visit. change (Nat.iter (S n) (fun x0 => turned cycles_of (fly_on s w walls x0)) y) with (P z). unfold P. rewrite (later_of_turned s W_positive w cycles_of (fly_on s w walls z)). unfold periods_later.
    rewrite later_later. f_equal. unfold shift. rewrite Nat2Z.inj_succ, <- Z.add_1_r. rewrite !plus_IZR, !mult_IZR, plus_IZR. ring.
Qed.

Let g := grid (disc_scale h) (factor h).
Let far := apart (coordinates N y) (coordinates N x).
Lemma powers_vanish c : is_lim_seq (fun n => g ^ n * far * c) 0.
Proof.
  replace (Finite 0) with (Rbar_mult (Rbar_mult 0 far) c) by (cbn; f_equal; ring).
  apply is_lim_seq_scal_r. apply is_lim_seq_scal_r. apply is_lim_seq_geom. assert (r := factor_range param w cycles_of h checked). unfold g. rewrite Rabs_pos_eq; lra.
Qed.
Lemma squeezed (u : nat -> R) (l c : R) : (forall n, Rabs (u n - l) <= g ^ n * far * c) -> is_lim_seq u l.
Proof.
  intros near. apply (is_lim_seq_ext (fun n => (u n - l) + l)); [intros n; ring|]. replace (Finite l) with (Finite (0 + l)) by (f_equal; ring).
  apply is_lim_seq_plus'; [|apply is_lim_seq_const]. apply is_lim_seq_abs_0.
  apply (is_lim_seq_le_le (fun _ => 0) _ (fun n => g ^ n * far * c)); [|apply is_lim_seq_const|apply powers_vanish].
  intros n. split; [apply Rabs_pos|apply near].
Qed.
Lemma states_tend : is_lim_seq (fun n => fst (Nat.iter n P y)) (fst x) /\ is_lim_seq (fun n => snd (Nat.iter n P y)) (snd x).
Proof.
  assert (a := area_nonzero param w cycles_of h checked). fold N in a.
  assert (each : forall n, Rabs (along N (Nat.iter n P y) - along N x) <= g ^ n * far /\ Rabs (across N (Nat.iter n P y) - across N x) <= g ^ n * far).
  { intros n. destruct (disc_attracts param w cycles_of h s described A_positive W_positive gap_positive checked x y plain x_in x_back y_in n) as [_ near].
    destruct (modulus_at_least (Cminus (coordinates N (Nat.iter n P y)) (coordinates N x))) as [h1 h2].
    split; [apply Rle_trans with (1 := h1)|apply Rle_trans with (1 := h2)]; exact near. }
  assert (differ : forall n b c, Rabs (b * (along N (Nat.iter n P y) - along N x) + c * (across N (Nat.iter n P y) - across N x)) <= g ^ n * far * (Rabs b + Rabs c)).
  { intros n b c. destruct (each n) as [h1 h2]. eapply Rle_trans; [apply Rabs_triang|]. rewrite !Rabs_mult. assert (b0 := Rabs_pos b). assert (c0 := Rabs_pos c). nra. }
  split.
  - apply (squeezed _ _ (Rabs (fst (long N)) + Rabs (fst (wide N)))). intros n.
    replace (fst (Nat.iter n P y) - fst x) with (fst (long N) * (along N (Nat.iter n P y) - along N x) + fst (wide N) * (across N (Nat.iter n P y) - across N x)); [apply differ|].
    rewrite <- (put_back N (Nat.iter n P y)) at 3 by exact a. rewrite <- (put_back N x) at 3 by exact a. unfold put. cbn [fst]. ring.
  - apply (squeezed _ _ (Rabs (snd (long N)) + Rabs (snd (wide N)))). intros n.
    replace (snd (Nat.iter n P y) - snd x) with (snd (long N) * (along N (Nat.iter n P y) - along N x) + snd (wide N) * (across N (Nat.iter n P y) - across N x)); [apply differ|].
    rewrite <- (put_back N (Nat.iter n P y)) at 3 by exact a. rewrite <- (put_back N x) at 3 by exact a. unfold put. cbn [snd]. ring.
Qed.
Lemma visits_tend : is_lim_seq (fun n => time (visit n) - IZR (turn + Z.of_nat n * cycles_of) * period s) (time (impact_at s w x)) /\
  is_lim_seq (fun n => velocity (visit n)) (velocity (impact_at s w x)).
Proof.
  destruct states_tend as [h1 h2]. split.
  - apply (is_lim_seq_ext (fun n => (fst (Nat.iter n P y) - tau s) * / W s)); [intros n|].
    { change (time (visit n)) with ((fst (Nat.iter n P y) - tau s) / W s + IZR (turn + Z.of_nat n * cycles_of) * period s). unfold Rdiv. ring. }
    cbn [impact_at time]. unfold Rdiv. replace (Finite ((fst x - tau s) * / W s)) with (Rbar_mult (fst x - tau s) (/ W s)) by reflexivity.
    apply is_lim_seq_scal_r. apply (is_lim_seq_minus' _ _ _ _ h1). apply is_lim_seq_const.
  - apply (is_lim_seq_ext (fun n => A s * W s * snd (Nat.iter n P y))); [intros n; reflexivity|]. cbn [impact_at velocity].
    replace (Finite (A s * W s * snd x)) with (Rbar_mult (A s * W s) (snd x)) by reflexivity. apply is_lim_seq_scal_l. exact h2.
Qed.
End Tends.

Lemma last_repeated {X : Type} (xs : list X) n : forall a, xs <> [] -> (0 < n)%nat -> last (concat (repeat xs n)) a = last xs a.
Proof.
  induction n as [|n IH]; intros a some h; [lia|]. cbn [repeat concat]. destruct n as [|n]; [cbn; rewrite app_nil_r; reflexivity|].
  rewrite last_app; [apply IH; [exact some|lia]|]. cbn [repeat concat]. destruct xs; [destruct (some eq_refl)|discriminate].
Qed.

Theorem approach_sound x from w h a cycles_of c state_ : scene_data x = param -> check_disc param w cycles_of h = true -> cycles c = cycles_of -> one_harmonic s ->
  in_ellipse (frame_of (disc_scale h) (disc_chart h)) state_ -> turned cycles_of (fly_on s w (map onto (way h)) state_) = state_ ->
  check_approach x from w h a = true -> forall l motion, begins (begun x) s l -> goes s (Flying l) motion -> Forall2 shows (events x) motion ->
  is_drawn s (events x) motion from c (impact_at s w state_) (impacts_on s w (map onto (way h)) state_).
Proof.
  intros same_data checked same_cycles one state_in state_back check l motion begin g all. unfold check_approach in check. cbv zeta in check.
  set (walls := map onto (way h)) in *. set (n := listed_before a) in *. set (before := firstn n (events x)) in *. set (rest := skipn n (events x)) in *.
  destruct (last_impact (events x)) as [b|] eqn:final; [|discriminate]. destruct (last_impact before) as [b0|] eqn:wall0; [|discriminate].
  destruct (walls_listed rest) as [ws|] eqn:listed; [|discriminate]. split_checks. apply Z.eqb_eq in k. apply same_wall_sound in k0.
  apply same_walls_sound in k1. apply Nat.ltb_lt in k2.
  assert (split_list : events x = before ++ rest) by (unfold before, rest; rewrite firstn_skipn; reflexivity).
  pose proof all as all0. rewrite split_list in all0. apply Forall2_app_inv_l in all0 as (m1 & m2 & all1 & all2 & motion_is).
  pose proof g as g0. rewrite motion_is in g0. apply goes_app in g0 as [g1 g2].
  (* The impact from which on the walls are repeated. *)
  destruct (last_impact_shown _ _ _ wall0 all1) as (m00 & j0 & m1_is & j0_in). set (l' := rebound s j0) in *.
  assert (there : after_all s (Flying l) m1 = Flying l') by (rewrite m1_is, after_all_app; reflexivity). rewrite there in g2.
  destruct (walls_listed_shown rest l' m2 ws listed all2 g2) as (orbit1 & m2_is & f1 & walls1).
  (* The last listed impact, and the flights on from there. *)
  destruct (last_impact_shown _ _ _ final all) as (m0 & i & motion_ends & i_in).
  assert (i_lies := cell_of_sound _ _ _ _ _ k4 i_in). set (z := point_of s i) in *. assert (i_is : i = impact_at s (on b) z) by (unfold z; destruct i_in as [<- _]; symmetry; apply impact_of_point; assumption).
  destruct (flights_sound _ _ _ _ _ _ k5 i_lies) as [flown z_end]. set (way2 := flights_on a) in *. set (orbit2 := impacts_on s (on b) (map onto way2) z).
  assert (f2 : follows s (rebound s i) orbit2) by (rewrite i_is; exact (impacts_follow s _ _ _ flown)).
  assert (joins : after s l' orbit1 = rebound s i).
  { assert (e := f_equal (after_all s (Flying l)) motion_ends). rewrite motion_is, !after_all_app, there, m2_is, after_hits in e. cbn in e. injection e as e. exact e. }
  rewrite <- joins in f2. assert (f := follows_joined s orbit1 l' orbit2 f1 f2).
  assert (orbit_walls : map wall_of (orbit1 ++ orbit2) = concat (repeat walls (rounds_until a))) by (rewrite map_app, walls1; unfold orbit2; rewrite impacts_walls; exact k1).
  assert (some : walls <> []) by (assert (o := some_walls param w cycles_of h checked); unfold walls; destruct (way h); [destruct (o eq_refl)|discriminate]).
  assert (some_rounds : concat (repeat walls (rounds_until a)) <> []) by (destruct (rounds_until a); [lia|cbn; destruct walls; [destruct (some eq_refl)|discriminate]]).
  assert (some_orbit : orbit1 ++ orbit2 <> []) by (intros none; rewrite none in orbit_walls; cbn in orbit_walls; congruence).
  set (j := last orbit2 i). assert (j_last : forall dflt, last (orbit1 ++ orbit2) dflt = j).
  { intros dflt. destruct orbit2 as [|o2 more2] eqn:o2_is.
    - rewrite app_nil_r in *. unfold j. cbn [last]. destruct orbit1 as [|o1 more1] eqn:o1_is; [destruct (some_orbit eq_refl)|].
      assert (e : last motion (Hits i) = Hits i) by (rewrite motion_ends, last_app by discriminate; reflexivity).
      rewrite motion_is, m2_is, last_app in e by discriminate. rewrite last_map in e. injection e as e. change (last (o1 :: more1) i = i) in e.
      etransitivity; [|exact e]. apply last_default. discriminate.
    - rewrite last_app by discriminate. unfold j. apply last_default. discriminate. }
  set (end_ := fly_on s (on b) (map onto way2) z) in *.
  assert (j_is : j = impact_at s (last (map onto way2) (on b)) end_) by (unfold j, orbit2, end_; rewrite i_is at 1; apply impacts_last).
  assert (j_wall : wall_of j = w).
  { rewrite <- (j_last j). rewrite <- (last_map wall_of), orbit_walls. rewrite (last_repeated walls _ _ some k2).
    assert (back := walls_come_back param w cycles_of h checked). fold walls in back.
    etransitivity; [|exact back]. apply last_default, some. }
  assert (j_at : j = impact_at s w end_) by (rewrite <- j_wall; rewrite j_is at 1; rewrite j_is; reflexivity).
  set (t := turns_until a) in *. set (y := turned t end_).
  assert (y_in : in_ellipse (frame_of (disc_scale h) (disc_chart h)) y).
  { destruct (holds_cell (disc_bits h) (disc_scale h) _ _ z_end) as [hX hV]. apply (has_box_sound param w cycles_of h checked _ _ _ check).
    - unfold y, turned. cbn [fst]. assert (ht := holds_half_turns (disc_bits h) (2 * t)). replace (IZR t * (2 * PI)) with (IZR (2 * t) * PI) by (rewrite mult_IZR; ring). enclose.
    - exact hV. }
  destruct (visits_tend w cycles_of h checked k3 state_ y state_in state_back y_in t) as [times speeds].
  exists m00, j0. split; [exists m2; rewrite motion_is, m1_is, <- app_assoc; reflexivity|]. split.
  { replace (S (length m00)) with (length m1) by (rewrite m1_is, app_length; cbn [length]; lia).
    rewrite <- (as_many _ _ _ all1). rewrite split_list at 1. rewrite firstn_app, Nat.sub_diag, firstn_all. cbn [firstn]. rewrite app_nil_r. exact k. }
  split; [destruct j0_in as [-> _]; exact k0|].
  exists (rounds_until a), (orbit1 ++ orbit2), (visit s w cycles_of walls y t), t. rewrite impacts_walls. fold walls. split; [exact k2|]. split.
  { assert (first : visit s w cycles_of walls y t 0 = j).
    { unfold visit. cbn [Nat.iter nat_rect Z.of_nat Z.mul]. rewrite Z.add_0_r. unfold y. rewrite <- (later_of_turned s W_positive w t end_). symmetry. exact j_at. }
    rewrite first. split; [exact f|]. split; [exact orbit_walls|apply j_last]. }
  split; [exact (visit_leads w cycles_of h checked k3 one state_ y state_in state_back y_in t)|]. rewrite same_cycles. split; [exact times|exact speeds].
Qed.
End Program.

(* The claims about the listed motion are verified in Pieces.v. *)
Definition verify_drawn (x : document) (from : Z) (c : cycle) (h : surroundings) (a : approach_to) : bool :=
  check_cycle (scene_data x) c h && is_stable c && check_single (scene_data x) (begun x) &&
  match spots c with b :: _ => check_approach (scene_data x) (first_events (listed_until a) x) from (spot_wall b) (wide_disc h) a | [] => false end.
Theorem drawn_verified x from c h a : claims x -> verify_drawn x from c h a = true -> claims_attracted x from c.
Proof.
  intros told v. split; [exact told|]. unfold verify_drawn in v. apply andb_prop in v as [v approach]. apply andb_prop in v as [v single]. apply andb_prop in v as [check _].
  intros s l described begin. destruct told as [_ told]. destruct (told s l described begin) as (_ & _ & (_ & motion & g & all & _ & _)).
  destruct (single_sound _ _ single) as [_ sense]. destruct (sense s described) as (_ & _ & A_positive & W_positive & gap_positive).
  destruct (cycle_sound (scene_data x) s described A_positive W_positive gap_positive c h check) as (b & z & first & one & checked & inside & back & is_one).
  destruct (spots c) as [|b' more] eqn:listed; [discriminate|]. injection first as ->. split; [exact one|].
  exists motion. eexists. eexists. split; [exact g|]. split; [exact all|]. split; [exact is_one|].
  pose proof all as parts. rewrite <- (firstn_skipn (listed_until a) (events x)) in parts. apply Forall2_app_inv_l in parts as (m1 & m2 & all1 & _ & motion_is).
  rewrite motion_is in g |- *. apply goes_app in g as [g1 _]. rewrite <- (firstn_skipn (listed_until a) (events x)). apply (drawn_longer s _ _ _ _ _ _ _ _ all1).
  exact (approach_sound (scene_data x) s described A_positive W_positive gap_positive (first_events (listed_until a) x) from (spot_wall b) (wide_disc h) a (cycles c) c z
    eq_refl checked eq_refl one inside back approach l m1 begin g1 all1).
Qed.
End Drawings.
