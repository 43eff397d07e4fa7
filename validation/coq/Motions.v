(* From words that cover (`words_hold`, Words.v) to the motions that a document of `chaos` claims (Chaos.v): a program `agrees` that compares the two documents,
   and `motions_sound`: every sequence of words that fit, one-sided, two-sided or periodic, has a motion that follows it, from either wall. *)
From Coq Require Import Reals Lra Lia List ZArith QArith Qreals Bool.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model Step Horseshoe Return Certificate Covering Covers Cycle Region Reduced Strips Words Chaos.
From ImpactPair Require Shift Twosided Periodic.
Open Scope R_scope.
Import ListNotations.

(* Two lists are as long, and f holds of their members one by one. *)
Fixpoint pairwise {U V : Type} (f : U -> V -> bool) (a : list U) (b : list V) : bool :=
  match a, b with [], [] => true | u :: a, v :: b => f u v && pairwise f a b | _, _ => false end.
Lemma pairwise_sound {U V : Type} (f : U -> V -> bool) a b : pairwise f a b = true ->
  length a = length b /\ forall i u v, (i < length a)%nat -> f (nth i a u) (nth i b v) = true.
Proof.
  revert b. induction a as [|u a IH]; intros [|v b] h; try discriminate; [split; [reflexivity|cbn; lia]|].
  cbn [pairwise] in h. apply andb_prop in h as [first rest]. destruct (IH b rest) as [same each]. cbn [length nth]. split; [lia|].
  intros [|i] u' v' hi; [exact first|apply each; lia].
Qed.

(* The half periods that are taken off along a word: the half cycles that it takes, but for the difference of the phases of its ends. *)
Definition half_turns (flights : list stride) : Z := fold_right (fun f n => half_turns_off f + n)%Z 0%Z flights.
(* A word of one document is that of the other. *)
Definition agrees_word (number : nat) (w : word) (e : word_entry) : bool :=
  (word_from w =? from_set e)%nat && (word_into w =? into_set e)%nat && (word_from w <? number)%nat && (word_into w <? number)%nat &&
  pairwise (fun f g => Bool.eqb (far f) g) (strides e) (word_flights w) && (half_cycles w =? half_turns (strides e))%Z && (1 <=? half_cycles w)%Z.
Definition agrees (c : chaos) (x : words_document) : bool := let number := length (h_sets c) in
  (number =? length (sets x))%nat && pairwise (agrees_word number) (words c) (entries x).
(* The parallelograms are in the h-sets of the document, as these are seen. *)
Definition included (c : chaos) (x : words_document) : Prop := forall n h N, nth_error (h_sets c) n = Some h -> nth_error (sets x) n = Some N ->
  forall y, in_frame (frame_of (grid_bits x) N) y -> in_set h (fst y) (- snd y).

(* The impact that a state represents after half cycles, from the left wall on: on the right wall after an odd number of them. *)
Section Impacts.
Variable s : scene.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis one : one_harmonic s.

Definition impact_of (half : Z) (y : state) : impact := {| wall_of := if Z.odd half then right else left; time := (fst y + IZR half * PI - tau s) / W s;
  velocity := if Z.odd half then - (A s * W s * snd y) else A s * W s * snd y |}.
Definition halves (w : wall) (T : Z) : Z := match w with left => (2 * T)%Z | right => (2 * T - 1)%Z end.

Lemma impact_is w T y : impact_of (halves w T) y = stands_for s w T y.
Proof.
  unfold impact_of, halves, stands_for, impact_at. destruct w; cbn [fst snd].
  - rewrite Z.odd_mul. cbn [Z.odd andb]. f_equal. rewrite mult_IZR. field. lra.
  - rewrite Z.odd_sub, Z.odd_mul. cbn [Z.odd andb xorb]. f_equal; [|ring]. rewrite minus_IZR, mult_IZR. field. lra.
Qed.
Lemma halves_some half : exists w T, half = halves w T.
Proof.
  assert (m := Zmod_odd half). exists (if Z.odd half then right else left), ((half + 1) / 2)%Z.
  unfold halves. destruct (Z.odd half); Z.div_mod_to_equations; lia.
Qed.
Lemma impact_phase half y : phase s (time (impact_of half y)) = fst y + IZR half * PI.
Proof. unfold impact_of, phase. cbn [time]. field. lra. Qed.
Lemma impact_phase_seen half y : exists turns, phase_seen s (impact_of half y) = fst y + IZR turns * (2 * PI).
Proof. destruct (halves_some half) as (w & T & ->). exists T. rewrite impact_is. apply stands_for_phase; assumption. Qed.
Lemma impact_speed_seen half y : speed_seen s (impact_of half y) = - snd y.
Proof. destruct (halves_some half) as (w & T & ->). rewrite impact_is. apply stands_for_speed; assumption. Qed.
Lemma impact_later more half y : impact_of (more + half) y = later_by s more (impact_of half y).
Proof.
  unfold impact_of, later_by. cbn [wall_of time velocity]. rewrite Z.odd_add, plus_IZR. unfold period.
  destruct (Z.odd more), (Z.odd half); cbn [xorb wall_after opposite]; f_equal; try ring; field; lra.
Qed.
Lemma impact_step f half y : treads s f y -> next s (impact_of half y) (impact_of (half + half_turns_off f) (tread s f y)) /\
  wall_of (impact_of (half + half_turns_off f) (tread s f y)) = wall_after (far f) (wall_of (impact_of half y)).
Proof.
  intros h. destruct (halves_some half) as (w & T & ->).
  replace (halves w T + half_turns_off f)%Z with (halves (wall_then w f) (turns_then w T f))
    by (unfold halves, wall_then, turns_then, half_turns_off; destruct w, (far f); cbn [opposite]; lia).
  rewrite !impact_is. split; [apply tread_next; assumption|]. rewrite !stands_for_wall. reflexivity.
Qed.

(* The impacts along a word. *)
Definition along_word (half : Z) (flights : list stride) (y : state) (k : nat) : impact := impact_of (half + half_turns (firstn k flights)) (walk s (firstn k flights) y).
Lemma along_none half flights y : along_word half flights y 0 = impact_of half y.
Proof. unfold along_word. cbn. rewrite Z.add_0_r. reflexivity. Qed.
Lemma along_all half flights y : along_word half flights y (length flights) = impact_of (half + half_turns flights) (walk s flights y).
Proof. unfold along_word. rewrite firstn_all. reflexivity. Qed.
Lemma along_next flights : forall half y k, walks s flights y -> (k < length flights)%nat -> next s (along_word half flights y k) (along_word half flights y (S k)) /\
  wall_of (along_word half flights y (S k)) = wall_after (nth k (map far flights) false) (wall_of (along_word half flights y k)).
Proof.
  induction flights as [|f flights IH]; intros half y k h hk; [cbn in hk; lia|]. destruct h as [h more].
  assert (skip : forall k, along_word half (f :: flights) y (S k) = along_word (half + half_turns_off f) flights (tread s f y) k).
  { intros i. unfold along_word. cbn [firstn half_turns fold_right walk]. rewrite Z.add_assoc. reflexivity. }
  destruct k as [|k]; rewrite !skip.
  - rewrite !along_none. exact (impact_step f half y h).
  - cbn [map nth length] in *. apply IH; [exact more|lia].
Qed.
Lemma along_later more half flights y k : along_word (more + half) flights y k = later_by s more (along_word half flights y k).
Proof. unfold along_word. rewrite <- Z.add_assoc. apply impact_later. Qed.
End Impacts.

(* The words as Shift.v has them. *)
Definition no_frame : frame := {| centre := (0, 0); long := (0, 0); wide := (0, 0) |}.
Definition no_entry : word_entry := Words.Word O O [] no_strip.
Definition base (x : words_document) (n : nat) : frame := match nth_error (sets x) n with Some N => frame_of (grid_bits x) N | None => no_frame end.
Definition entry (x : words_document) (i : nat) : word_entry := nth i (entries x) no_entry.
Definition step_from (s : scene) (q : positive) (e : word_entry) : Shift.step_of :=
  Shift.Step (from_set e) (into_set e) (grid q (begins_at (strip_of e))) (grid q (ends_at (strip_of e))) (sign_of e) (walk s (strides e)).
Definition steps (s : scene) (x : words_document) : list Shift.step_of := map (step_from s (grid_bits x)) (entries x).
Definition starting_at (w : wall) : Z := match w with left => 0%Z | right => 1%Z end.

Section Motions.
Variables (s : scene) (c : chaos) (x : words_document).
Hypothesis hold : words_hold s x.
Let q := grid_bits x.

Lemma steps_length : length (steps s x) = length (entries x).
Proof. apply map_length. Qed.
Lemma steps_at i : (i < length (entries x))%nat -> Shift.word_of (steps s x) i = step_from s q (entry x i) /\ nth_error (entries x) i = Some (entry x i).
Proof.
  intros h. split; [|apply nth_error_nth'; exact h]. unfold Shift.word_of, steps, entry. rewrite (nth_indep _ _ (step_from s q no_entry)) by (rewrite map_length; exact h).
  apply (map_nth (step_from s q)).
Qed.
Lemma base_is n N : set_number x n N -> base x n = frame_of q N /\ is_set q N.
Proof. intros h. split; [unfold base; rewrite h; reflexivity|exact (words_sets _ _ hold n N h)]. Qed.
Lemma steps_cover : Shift.words_cover (base x) (steps s x).
Proof.
  split; intros v h; apply in_map_iff in h as (e & <- & h); destruct (words_cover _ _ hold e h) as (N & M & hN & hM & covered & _);
    destruct (base_is _ _ hN) as [eN isN]; cbn [Shift.from_set Shift.into_set Shift.lower Shift.upper Shift.over Shift.move step_from]; rewrite eN.
  - apply Rgt_not_eq, isN.
  - rewrite (proj1 (base_is _ _ hM)). exact covered.
Qed.
Lemma steps_apart : Shift.words_apart (steps s x).
Proof.
  intros i j hi hj ne. rewrite steps_length in hi, hj. destruct (steps_at i hi) as [-> ei]. destruct (steps_at j hj) as [-> ej].
  cbn [Shift.from_set Shift.lower Shift.upper step_from]. intros same.
  destruct (words_cover _ _ hold _ (nth_error_In _ _ ei)) as (N & M & hN & _ & ci & _). destruct (words_cover _ _ hold _ (nth_error_In _ _ ej)) as (N' & M' & _ & _ & cj & _).
  assert (oi := covers_order _ _ _ _ _ _ ci). assert (oj := covers_order _ _ _ _ _ _ cj). fold q in oi, oj.
  assert (areaN : area (frame_of q N) <> 0) by apply Rgt_not_eq, (base_is _ _ hN).
  set (a := grid q (begins_at (strip_of (entry x i)))) in *. set (b := grid q (ends_at (strip_of (entry x i)))) in *.
  set (a' := grid q (begins_at (strip_of (entry x j)))) in *. set (b' := grid q (ends_at (strip_of (entry x j)))) in *.
  destruct (Rlt_le_dec b a') as [l|l]; [left; exact l|]. destruct (Rlt_le_dec b' a) as [l'|l']; [right; exact l'|]. exfalso.
  apply (words_apart _ _ hold i j _ _ ei ej ne same N (put (frame_of q N) (Rmax a a') 0)).
  unfold starts_of, slice. fold q. fold a b a' b'. rewrite put_along, put_across by exact areaN.
  assert (Rmax a a' <= b) by (apply Rmax_lub; lra). assert (Rmax a a' <= b') by (apply Rmax_lub; lra).
  assert (m := Rmax_l a a'). assert (m' := Rmax_r a a'). lra.
Qed.

Hypothesis agreed : agrees c x = true.
Lemma lengths : length (h_sets c) = length (sets x) /\ length (words c) = length (entries x).
Proof.
  unfold agrees in agreed. apply andb_prop in agreed as [h1 h2]. apply Nat.eqb_eq in h1. split; [exact h1|]. apply (pairwise_sound _ _ _ h2).
Qed.
Lemma agree_at i : (i < length (words c))%nat -> let w := word_of c i in let e := entry x i in word_from w = from_set e /\ word_into w = into_set e /\
  (word_from w < length (h_sets c))%nat /\ (word_into w < length (h_sets c))%nat /\ map far (strides e) = word_flights w /\
  half_cycles w = half_turns (strides e) /\ (1 <= half_cycles w)%Z.
Proof.
  intros hi w e. unfold agrees in agreed. apply andb_prop in agreed as [_ h]. assert (k := proj2 (pairwise_sound _ _ _ h) i no_word no_entry hi).
  change (agrees_word (length (h_sets c)) w e = true) in k. unfold agrees_word in k.
  apply andb_prop in k as [k k7]. apply andb_prop in k as [k k6]. apply andb_prop in k as [k k5]. apply andb_prop in k as [k k4].
  apply andb_prop in k as [k k3]. apply andb_prop in k as [k1 k2].
  apply Nat.eqb_eq in k1, k2. apply Nat.ltb_lt in k3, k4. apply Z.eqb_eq in k6. apply Z.leb_le in k7.
  repeat split; try assumption. clear - k5. revert k5. generalize (word_flights w). induction (strides e) as [|f l IH]; intros [|g r] k; try discriminate; [reflexivity|].
  cbn [pairwise] in k. apply andb_prop in k as [k1' k2']. apply eqb_prop in k1'. cbn [map]. rewrite k1', (IH r k2'). reflexivity.
Qed.
(* Sequences that fit do so in Shift.v too. *)
Lemma fits_step i j : (i < length (words c))%nat -> (j < length (words c))%nat -> word_into (word_of c i) = word_from (word_of c j) ->
  (i < length (steps s x))%nat /\ Shift.into_set (Shift.word_of (steps s x) i) = Shift.from_set (Shift.word_of (steps s x) j).
Proof.
  intros hi hj e. destruct (agree_at i hi) as (_ & ei & _). destruct (agree_at j hj) as (ej & _). destruct lengths as [_ l]. rewrite l in hi, hj.
  rewrite steps_length. split; [exact hi|]. rewrite (proj1 (steps_at i hi)), (proj1 (steps_at j hj)). cbn. congruence.
Qed.
Lemma fits_steps ws : fits S c ws -> Shift.fits (steps s x) ws.
Proof. intros h n. apply fits_step; [apply h|apply h|apply h]. Qed.

(* The motion of states, one for each word of a sequence. *)
Definition motion {X : Type} (ws : X -> nat) (half : X -> Z) (at_ : X -> state) (n : X) (k : nat) : impact := along_word s (half n) (strides (entry x (ws n))) (at_ n) k.

Hypothesis inside : included c x.
Lemma seen_inside n y : (n < length (h_sets c))%nat -> in_frame (base x n) y -> in_set (set_of c n) (fst y) (- snd y).
Proof.
  intros hn. unfold base. destruct (nth_error (sets x) n) as [N|] eqn:e.
  - apply (inside n); [apply nth_error_nth'; exact hn|exact e].
  - apply nth_error_None in e. destruct lengths as [l _]. lia.
Qed.
Theorem motion_follows {X : Type} (succ : X -> X) (ws : X -> nat) (half : X -> Z) (at_ : X -> state) : fits succ c ws ->
  (forall n, Shift.in_slice (base x) (steps s x) (ws n) (at_ n)) -> (forall n, at_ (succ n) = Shift.move (Shift.word_of (steps s x) (ws n)) (at_ n)) ->
  (forall n, half (succ n) = (half n + half_cycles (word_of c (ws n)))%Z) -> follows_words s succ c ws (motion ws half at_).
Proof.
  intros fit slices moves halves_on. destruct (words_positive _ _ hold) as (hA & hW & _). assert (one := words_one _ _ hold). exists (fun n => fst (at_ n)). intros n.
  destruct (fit n) as [range joined]. assert (range' := proj1 (fit (succ n))). destruct (agree_at _ range) as (from & into & few & few' & flights & half_same & _).
  destruct (agree_at _ range') as (from' & _). destruct lengths as [_ l]. assert (r := range). rewrite l in r. assert (r' := range'). rewrite l in r'.
  destruct (steps_at _ r) as [at_n listed].
  assert (fly : walks s (strides (entry x (ws n))) (at_ n)).
  { destruct (words_cover _ _ hold _ (nth_error_In _ _ listed)) as (N & M & hN & _ & _ & _ & fly). apply fly.
    assert (sl := slices n). unfold Shift.in_slice in sl. rewrite at_n in sl. cbn [Shift.from_set Shift.lower Shift.upper step_from] in sl.
    rewrite (proj1 (base_is _ _ hN)) in sl. exact sl. }
  assert (frames : forall m, (ws m < length (words c))%nat -> in_frame (base x (word_from (word_of c (ws m)))) (at_ m)).
  { intros m hm. destruct (agree_at _ hm) as (e & _). rewrite e. assert (hm' := hm). rewrite l in hm'. rewrite <- steps_length in hm'.
    assert (f := Shift.slice_in_frame _ _ steps_cover _ _ hm' (slices m)). rewrite steps_length in hm'. rewrite (proj1 (steps_at _ hm')) in f. exact f. }
  assert (count : length (word_flights (word_of c (ws n))) = length (strides (entry x (ws n)))) by (rewrite <- flights; apply map_length).
  assert (first : forall m, motion ws half at_ m O = impact_of s (half m) (at_ m)) by (intros m; apply along_none).
  assert (last : motion ws half at_ n (length (word_flights (word_of c (ws n)))) = impact_of s (half (succ n)) (at_ (succ n))).
  { unfold motion. rewrite count, along_all, halves_on, moves, at_n, half_same. reflexivity. }
  split; [|rewrite last, first; reflexivity]. unfold follows_word. cbv zeta. rewrite last, first, !impact_speed_seen, !impact_phase by assumption.
  split; [apply seen_inside; [exact few|exact (frames n range)]|]. split; [rewrite joined; apply seen_inside; [rewrite <- joined; exact few'|exact (frames _ range')]|].
  split; [apply impact_phase_seen; assumption|]. split; [rewrite halves_on, plus_IZR; ring|].
  intros k hk. rewrite count in hk. rewrite <- flights. apply along_next; assumption.
Qed.
Lemma motion_wall {X : Type} (ws : X -> nat) half at_ (n : X) w : half n = starting_at w -> wall_of (motion ws half at_ n 0) = w.
Proof. intros h. unfold motion. rewrite along_none, h. destruct w; reflexivity. Qed.

(* One-sided sequences; the half cycles up to word n. *)
Definition half_at (ws : nat -> nat) (w : wall) (n : nat) : Z := (starting_at w + total c half_cycles ws n)%Z.
Lemma half_at_next ws w n : half_at ws w (S n) = (half_at ws w n + half_cycles (word_of c (ws n)))%Z.
Proof. unfold half_at. cbn [total]. ring. Qed.
Lemma motion_obeys ws w y : fits S c ws -> (forall n, Shift.in_slice (base x) (steps s x) (ws n) (Shift.after (steps s x) ws n y)) ->
  let J := motion ws (half_at ws w) (fun n => Shift.after (steps s x) ws n y) in wall_of (J O O) = w /\ follows_words s S c ws J.
Proof.
  intros fit slices J. split; [apply motion_wall; unfold half_at; cbn [total]; ring|].
  apply motion_follows; [exact fit|exact slices|reflexivity|apply half_at_next].
Qed.
Theorem one_sided : every_sequence s c.
Proof.
  intros ws fit w. destruct (Shift.every_sequence_obeyed _ _ steps_cover ws (fits_steps ws fit)) as [y obeyed].
  eexists. apply (motion_obeys ws w y fit). intros n. apply obeyed.
Qed.

(* Two-sided ones: before word 0 the half cycles are counted backwards. *)
Definition half_both (ws : Z -> nat) (w : wall) (n : Z) : Z := (starting_at w + if n <? 0 then - total c half_cycles (fun k => ws (-1 - Z.of_nat k)) (Z.to_nat (- n))
  else total c half_cycles (fun k => ws (Z.of_nat k)) (Z.to_nat n))%Z.
Lemma half_both_next ws w n : half_both ws w (Z.succ n) = (half_both ws w n + half_cycles (word_of c (ws n)))%Z.
Proof.
  unfold half_both. destruct (Z.ltb_spec n 0) as [neg|pos].
  - replace (Z.to_nat (- n)) with (S (Z.to_nat (- Z.succ n))) by lia. cbn [total]. replace (-1 - Z.of_nat (Z.to_nat (- Z.succ n)))%Z with n by lia.
    destruct (Z.ltb_spec (Z.succ n) 0) as [neg'|zero]; [ring|]. replace (Z.succ n) with 0%Z by lia. cbn [Z.opp Z.to_nat total]. ring.
  - destruct (Z.ltb_spec (Z.succ n) 0) as [neg|_]; [lia|]. replace (Z.to_nat (Z.succ n)) with (S (Z.to_nat n)) by lia. cbn [total].
    rewrite Z2Nat.id by exact pos. ring.
Qed.
Theorem two_sided : every_two_sided_sequence s c.
Proof.
  intros ws fit w. destruct (Twosided.every_orbit _ _ steps_cover ws) as [y orbit].
  { intros n. apply fits_step; [apply fit|apply fit|apply (fit n)]. }
  exists (motion ws (half_both ws w) y). split; [apply motion_wall; unfold half_both; cbn; ring|].
  apply motion_follows; [exact fit|intros n; apply orbit|intros n; apply orbit|apply half_both_next].
Qed.

(* Periodic ones. *)
Theorem recurring : every_periodic_sequence s c.
Proof.
  intros ws m fit some again w. set (ring_ := fun n => base x (Shift.from_set (Shift.word_of (steps s x) (ws n)))).
  assert (again' : forall n, ws (n + m)%nat = ws n) by (intros n; rewrite Nat.add_comm; apply again).
  assert (fit' := fits_steps ws fit). assert (listed : forall i, In (Shift.word_of (steps s x) (ws i)) (steps s x)) by (intros i; apply Shift.word_in, fit').
  destruct (Periodic.periodic m ring_ (fun n => Shift.lower (Shift.word_of (steps s x) (ws n))) (fun n => Shift.upper (Shift.word_of (steps s x) (ws n)))
    (fun n => Shift.over (Shift.word_of (steps s x) (ws n))) (fun n => Shift.move (Shift.word_of (steps s x) (ws n))) some) as [y orbit].
  1-4: intros i; unfold ring_; rewrite again'; reflexivity.
  { intros i _. apply (Shift.words_area _ _ steps_cover), listed. }
  { intros i _. unfold ring_. rewrite <- (proj2 (fit' i)). apply (Shift.words_covers _ _ steps_cover), listed. }
  exists (motion ws (half_at ws w) (fun n => Shift.after (steps s x) ws n y)).
  destruct (motion_obeys ws w y fit) as [start follow]; [intros n; apply (orbit n)|]. split; [exact start|]. split; [exact follow|].
  intros n k. unfold motion. rewrite again. replace (Shift.after (steps s x) ws (m + n) y) with (Shift.after (steps s x) ws n y)
    by (rewrite Nat.add_comm; symmetry; apply (orbit n)).
  replace (half_at ws w (m + n)) with (total c half_cycles ws m + half_at ws w n)%Z.
  { destruct (words_positive _ _ hold) as (_ & hW & _). apply along_later, hW. }
  unfold half_at. assert (split_ : total c half_cycles ws (m + n) = (total c half_cycles ws m + total c half_cycles ws n)%Z); [|rewrite split_; ring].
  clear - again. induction n as [|n IH]; [rewrite Nat.add_0_r; cbn [total]; ring|]. rewrite Nat.add_succ_r. cbn [total]. rewrite IH, again. ring.
Qed.
End Motions.

Theorem motions_sound s c x : agrees c x = true -> included c x -> words_hold s x -> every_sequence s c /\ every_two_sided_sequence s c /\ every_periodic_sequence s c.
Proof. intros a i h. split; [exact (one_sided s c x h a i)|]. split; [exact (two_sided s c x h a i)|exact (recurring s c x h a i)]. Qed.
