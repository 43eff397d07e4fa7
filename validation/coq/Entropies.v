(* Lower bounds of the topological entropy of the motions that follow covering words: a program `grows` that checks, in integers, a vector of values of
   the h-sets that words from them multiply; `growth_entropy`; and `check_entropy`, with a bound of exp by interval arithmetic, and its proof. *)
From Coq Require Import Reals Lra Lia List ZArith QArith Qreals Bool.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Horseshoe Return Certificate Enclosure Covering Covers Cycle Region Reduced Strips Words Chaos Motions.
From ImpactPair Require Shift Separated.
Open Scope R_scope.
Import ListNotations.

(* A factor by which motions multiply with each impact, or half cycle; and values of the h-sets, not negative. *)
Record growth_hint := Growth_hint { growth_by : Q; growth_values : list Z }.
Definition value_at (g : growth_hint) (b : nat) : Z := nth b (growth_values g) 0%Z.
Definition heaviest (weight : word -> Z) (words : list word) : Z := fold_right (fun w most => Z.max (weight w) most) 0%Z words.
(* The contribution of a word to the h-set that it leads from: the value of the one it leads into, over the factor to the power of its weight, all
   times the numerator of the factor to the power `most`. *)
Definition brings (weight : word -> Z) (g : growth_hint) (most : Z) (w : word) : nat * Z :=
  (word_from w, (value_at g (word_into w) * Zpos (Qden (growth_by g)) ^ weight w * Qnum (growth_by g) ^ (most - weight w))%Z).
Definition brought (terms : list (nat * Z)) (b : nat) : Z := fold_right (fun term all => if (fst term =? b)%nat then (snd term + all)%Z else all) 0%Z terms.
Definition grows (c : chaos) (weight : word -> Z) (g : growth_hint) : bool :=
  let most := heaviest weight (words c) in let terms := map (brings weight g most) (words c) in let whole := (Qnum (growth_by g) ^ most)%Z in
  (Zpos (Qden (growth_by g)) <? Qnum (growth_by g))%Z && forallb (fun v => 0 <=? v)%Z (growth_values g) && existsb (fun v => 0 <? v)%Z (growth_values g) &&
  forallb (fun w => 1 <=? weight w)%Z (words c) &&
  forallb (fun b => value_at g b * whole <=? brought terms b)%Z (seq 0 (length (growth_values g))).

Lemma heaviest_most weight ws w : In w ws -> (weight w <= heaviest weight ws)%Z.
Proof. induction ws as [|u ws IH]; intros []; cbn [heaviest fold_right]; [subst; lia|]. specialize (IH H). unfold heaviest in IH. lia. Qed.
(* The sum of what words bring, by their numbers. *)
Lemma filter_of_map {U V : Type} (P : V -> bool) (f : U -> V) l : filter P (map f l) = map f (filter (fun u => P (f u)) l).
Proof. induction l as [|u l IH]; [reflexivity|]. cbn. destruct (P (f u)); cbn; rewrite IH; reflexivity. Qed.
Lemma sum_of_map (f : nat -> R) (h : nat -> nat) l : Separated.sum_over f (map h l) = Separated.sum_over (fun i => f (h i)) l.
Proof. unfold Separated.sum_over. induction l as [|i l IH]; [reflexivity|]. cbn. rewrite IH. reflexivity. Qed.
Lemma brought_sum {U : Type} (f : U -> nat * Z) (d : U) b l : IZR (brought (map f l) b) =
  Separated.sum_over (fun i => IZR (snd (f (nth i l d)))) (filter (fun i => (fst (f (nth i l d)) =? b)%nat) (seq 0 (length l))).
Proof.
  induction l as [|u l IH]; [reflexivity|]. cbn [length seq map brought fold_right filter nth]. rewrite <- seq_shift, filter_of_map. cbn [nth].
  unfold brought in IH. destruct (fst (f u) =? b)%nat.
  - rewrite plus_IZR, IH. cbn [Separated.sum_over fold_right nth]. f_equal. symmetry. apply (sum_of_map (fun i => IZR (snd (f (nth i (u :: l) d)))) S).
  - rewrite IH. symmetry. apply (sum_of_map (fun i => IZR (snd (f (nth i (u :: l) d)))) S).
Qed.
Lemma power_of_exp h n : exp (h * INR n) = exp h ^ n.
Proof. induction n as [|n IH]; [rewrite Rmult_0_r; apply exp_0|]. rewrite S_INR. cbn [pow]. rewrite <- IH, <- exp_plus. f_equal. ring. Qed.
(* Phases that differ by at most 3 do not come closer by whole forcing periods. *)
Lemma turned_apart eps u v k : eps <= Rabs (u - v) -> Rabs (u - v) <= 3 -> Rmin eps 3 <= Rabs (u - v - IZR k * (2 * PI)).
Proof.
  intros far near. assert (p : 3 < PI) by (assert (p := PI2_3_2); unfold PI2 in p; lra).
  destruct (Z.eq_dec k 0) as [->|n]; [rewrite Rmult_0_l, Rminus_0_r; apply Rle_trans with (1 := Rmin_l _ _), far|].
  apply Rle_trans with (1 := Rmin_r _ _). apply Rabs_le_between in near. assert (o : (k <= -1 \/ 1 <= k)%Z) by lia.
  destruct o as [o|o]; apply IZR_le in o; [apply Rle_trans with (2 := Rle_abs _)|rewrite <- Rabs_Ropp; apply Rle_trans with (2 := Rle_abs _)]; nra.
Qed.

Section Growth.
Variables (s : scene) (c : chaos) (x : words_document) (weight : word -> Z) (g : growth_hint).
Hypothesis hold : words_hold s x.
Hypothesis agreed : agrees c x = true.
Hypothesis growing : grows c weight g = true.

Let live (b : nat) : bool := (0 <? value_at g b)%Z.
Let v (b : nat) : R := IZR (value_at g b).
Let r : R := Q2R (growth_by g).
Let weigh (i : nat) : nat := Z.to_nat (weight (word_of c i)).

Lemma growing_parts : (Zpos (Qden (growth_by g)) < Qnum (growth_by g))%Z /\ (forall b, 0 <= value_at g b)%Z /\ (exists b, live b = true) /\
  (forall i, (i < length (words c))%nat -> 1 <= weight (word_of c i))%Z /\
  forall b, (value_at g b * Qnum (growth_by g) ^ heaviest weight (words c) <= brought (map (brings weight g (heaviest weight (words c))) (words c)) b)%Z \/ live b = false.
Proof.
  assert (h := growing). unfold grows in h. cbv zeta in h. apply andb_prop in h as [h h5]. apply andb_prop in h as [h h4]. apply andb_prop in h as [h h3].
  apply andb_prop in h as [h1 h2]. apply Z.ltb_lt in h1. rewrite forallb_forall in h2, h4, h5. split; [exact h1|]. split; [|split; [|split]].
  - intros b. unfold value_at. destruct (Nat.lt_ge_cases b (length (growth_values g))) as [l|l]; [apply Z.leb_le, h2, nth_In, l|rewrite nth_overflow by exact l; lia].
  - apply existsb_exists in h3 as (a & ha & pos). apply (In_nth _ _ 0%Z) in ha as (b & _ & e). exists b. unfold live, value_at. rewrite e. exact pos.
  - intros i hi. apply Z.leb_le, h4, nth_In, hi.
  - intros b. destruct (Nat.lt_ge_cases b (length (growth_values g))) as [l|l]; [left; apply Z.leb_le, h5, in_seq; lia|right]. unfold live, value_at. rewrite nth_overflow by exact l. reflexivity.
Qed.
Lemma factor_above : 1 < r.
Proof.
  destruct growing_parts as (h & _). unfold r, Q2R. apply IZR_lt in h. assert (0 < IZR (Zpos (Qden (growth_by g)))) by (apply IZR_lt; reflexivity).
  apply (Rmult_lt_reg_r (IZR (Zpos (Qden (growth_by g))))); [assumption|]. rewrite Rmult_assoc, Rinv_l by lra. lra.
Qed.
Lemma step_of_word i : (i < length (words c))%nat ->
  Shift.from_set (Shift.word_of (steps s x) i) = word_from (word_of c i) /\ Shift.into_set (Shift.word_of (steps s x) i) = word_into (word_of c i).
Proof.
  intros hi. destruct (agree_at c x agreed i hi) as (-> & -> & _). rewrite (proj2 (lengths c x agreed)) in hi.
  rewrite (proj1 (steps_at s x i hi)). split; reflexivity.
Qed.
Lemma steps_count : length (steps s x) = length (words c).
Proof. rewrite steps_length. symmetry. apply (lengths c x agreed). Qed.
(* One term, times the power. *)
Lemma term_value i : (i < length (words c))%nat -> let K := heaviest weight (words c) in
  IZR (snd (brings weight g K (word_of c i))) = v (Shift.into_set (Shift.word_of (steps s x) i)) / r ^ weigh i * IZR (Qnum (growth_by g) ^ K).
Proof.
  intros hi K. destruct growing_parts as (h1 & _ & _ & h4 & _). specialize (h4 i hi). rewrite (proj2 (step_of_word i hi)). cbn [brings snd]. unfold v, weigh.
  assert (most : (weight (word_of c i) <= K)%Z) by (apply heaviest_most, nth_In, hi). set (k := weight (word_of c i)) in *.
  set (num := Qnum (growth_by g)) in *. set (rest := (num ^ (K - k))%Z).
  assert (whole : (num ^ K = num ^ k * rest)%Z) by (unfold rest; rewrite <- Z.pow_add_r by lia; f_equal; lia).
  assert (powers : forall a, IZR (a ^ k) = IZR a ^ Z.to_nat k) by (intros a; rewrite pow_IZR; do 2 f_equal; lia).
  rewrite whole, !mult_IZR, !powers. unfold r, Q2R. fold num. rewrite Rpow_mult_distr, pow_inv. field.
  split; apply pow_nonzero, not_0_IZR; lia.
Qed.
Lemma growth_holds : Separated.growth (steps s x) weigh live r v.
Proof.
  destruct growing_parts as (h1 & h2 & _ & h4 & h5). assert (r1 := factor_above). split.
  - intros i hi. rewrite steps_count in hi. specialize (h4 i hi). unfold weigh. lia.
  - lra.
  - intros b h. apply IZR_lt, Z.ltb_lt, h.
  - intros b h. apply Z.ltb_ge in h. specialize (h2 b). unfold v. replace (value_at g b) with 0%Z by lia. reflexivity.
  - intros b h. destruct (h5 b) as [large|no]; [|congruence]. set (K := heaviest weight (words c)) in *. apply IZR_le in large.
    rewrite mult_IZR, (brought_sum _ no_word) in large. assert (pos : 0 < IZR (Qnum (growth_by g) ^ K)).
    { apply IZR_lt, Z.pow_pos_nonneg; [lia|]. unfold K, heaviest. clear. induction (words c) as [|w ws IH]; cbn; lia. }
    apply (Rmult_le_reg_r _ _ _ pos). apply Rle_trans with (1 := large). rewrite Separated.sum_over_times. unfold Separated.words_from. rewrite steps_count.
    rewrite (filter_ext_in _ (fun i => (Shift.from_set (Shift.word_of (steps s x) i) =? b)%nat)).
    + apply Separated.sum_over_bound. intros i hi. apply filter_In in hi as [hi _]. apply in_seq in hi. apply Req_le, term_value. lia.
    + intros i hi. apply in_seq in hi. rewrite (proj1 (step_of_word i ltac:(lia))). reflexivity.
Qed.

Lemma fits_words ws : Shift.fits (steps s x) ws -> fits S c ws.
Proof.
  intros h n. assert (l := steps_count). destruct (h n) as [range joined]. assert (range' := proj1 (h (S n))). rewrite l in range, range'.
  rewrite (proj2 (step_of_word _ range)), (proj1 (step_of_word _ range')) in joined. split; assumption.
Qed.
Lemma spent_total ws n : fits S c ws -> Z.of_nat (Separated.spent weigh ws n) = total c weight ws n.
Proof.
  intros fit. destruct growing_parts as (_ & _ & _ & h4 & _). induction n as [|n IH]; [reflexivity|]. cbn [Separated.spent total]. rewrite Nat2Z.inj_add, IH.
  unfold weigh. specialize (h4 _ (proj1 (fit n))). lia.
Qed.

Hypothesis inside : included c x.
Let motion_of (ws : nat -> nat) (y : state) : nat -> nat -> impact := motion s x ws (half_at c ws left) (fun n => Shift.after (steps s x) ws n y).

Theorem growth_entropy h : exp h <= r -> entropy_at_least s c weight h.
Proof.
  intros below. assert (cover := steps_cover s x hold). destruct growing_parts as (_ & _ & (b & lb) & _ & _).
  destruct (Shift.told_apart _ _ cover (steps_apart s x hold)) as (delta & eps & _ & e0 & told).
  destruct (Separated.many_sequences _ _ _ _ _ growth_holds b lb) as (c0 & c0_pos & many).
  exists c0, (Rmin eps 3). split; [exact c0_pos|]. split; [apply Rmin_glb_lt; lra|]. intros n. destruct (many n) as (m & sq & number & fit & part).
  assert (exists L, length L = m /\ forall i, (i < m)%nat -> exists y, nth_error L i = Some (sq i, y) /\ Shift.obeys (base x) (steps s x) (sq i) y) as (L & len & each).
  { assert (obeyed : forall i, (i < m)%nat -> exists y, Shift.obeys (base x) (steps s x) (sq i) y) by (intros i hi; apply Shift.every_sequence_obeyed; [exact cover|apply fit, hi]).
    clear - obeyed. induction m as [|m IH]; [exists []; split; [reflexivity|lia]|].
    destruct IH as (L & len & all); [intros i hi; apply obeyed; lia|]. destruct (obeyed m) as [y oy]; [lia|]. exists (L ++ [(sq m, y)]).
    split; [rewrite app_length, len; cbn; lia|]. intros i hi. destruct (Nat.eq_dec i m) as [->|ne].
    - exists y. split; [rewrite nth_error_app2, len, Nat.sub_diag by lia; reflexivity|exact oy].
    - rewrite nth_error_app1 by lia. apply all. lia. }
  set (F := fun p : (nat -> nat) * state => (fst p, motion_of (fst p) (snd p))).
  assert (known : forall i ws J, nth_error (map F L) i = Some (ws, J) -> (i < m)%nat /\ exists y, ws = sq i /\ J = motion_of (sq i) y /\ Shift.obeys (base x) (steps s x) (sq i) y).
  { intros i ws J e. assert (hi : (i < m)%nat) by (rewrite <- len, <- (map_length F); apply nth_error_Some; congruence). split; [exact hi|].
    destruct (each i hi) as (y & at_i & oy). rewrite (map_nth_error F _ _ at_i) in e. injection e as <- <-. exists y. auto. }
  exists (map F L). split; [|split].
  - rewrite map_length, len. apply Rle_trans with (2 := number). apply Rmult_le_compat_l; [lra|]. rewrite power_of_exp. apply pow_incr. split; [left; apply exp_pos|exact below].
  - intros ws J listed. apply In_nth_error in listed as [i at_i]. destruct (known _ _ _ at_i) as (hi & y & -> & -> & oy).
    assert (f := fits_words _ (proj1 (fit i hi))). split; [exact f|].
    apply (motion_obeys s c x hold agreed inside (sq i) left y f). intros k. apply oy.
  - intros i j ws J ws' J' ne at_i at_j. destruct (known _ _ _ at_i) as (hi & y & -> & -> & oy). destruct (known _ _ _ at_j) as (hj & z & -> & -> & oz).
    destruct (part i j hi hj ne) as (k & same & differ & less). destruct (fit i hi) as [fi bi]. destruct (fit j hj) as [fj bj]. exists k. split; [exact same|].
    split; [rewrite <- spent_total by apply fits_words, fi; lia|].
    destruct (told _ _ k y z fi fj oy oz ltac:(congruence) same differ) as (_ & iy & iz & _ & far).
    destruct (words_positive _ _ hold) as (hA & hW & _). unfold apart.
    assert (first : forall ws y, motion_of ws y k 0 = impact_of s (half_at c ws left k) (Shift.after (steps s x) ws k y)) by (intros; apply along_none).
    rewrite !first, !impact_speed_seen by assumption. set (y' := Shift.after _ _ k y) in *. set (z' := Shift.after _ _ k z) in *.
    destruct far as [far|far]; [right|left].
    + destruct (impact_phase_seen s hA hW (half_at c (sq i) left k) y') as [t ->]. destruct (impact_phase_seen s hA hW (half_at c (sq j) left k) z') as [t' ->].
      intros turns. assert (range := proj1 (fi k)). rewrite steps_length in range. destruct (steps_at s x _ range) as [e listed].
      destruct (words_cover _ _ hold _ (nth_error_In _ _ listed)) as (N & _ & hN & _). destruct (base_is s x hold _ _ hN) as [eN [_ wide_]].
      rewrite e in iy, iz. cbn [Shift.from_set step_from] in iy, iz. rewrite eN in iy, iz.
      assert (t0 := turned_apart eps (fst y') (fst z') (turns - t + t') far (wide_ _ _ iy iz)).
      replace (_ - _ - _) with (fst y' - fst z' - IZR (turns - t + t') * (2 * PI)) by (rewrite plus_IZR, minus_IZR; ring). exact t0.
    + apply Rle_trans with (1 := Rmin_l _ _). replace (- snd y' - - snd z') with (- (snd y' - snd z')) by ring. rewrite Rabs_Ropp. exact far.
Qed.
End Growth.

(* exp h at most the factor, by intervals. *)
Module Growths (F : FloatOps with Definition sensible_format := true).
Module Import Each := Enclosure F.
Definition below_factor (p : positive) (h factor : Q) : bool :=
  is_not_negative (sub p (known_number p factor) (I.exp (F.PtoP p) (known_number p h))).
Lemma below_factor_sound p h factor : below_factor p h factor = true -> exp (Q2R h) <= Q2R factor.
Proof.
  intros k. assert (f := holds_number p factor). assert (e := holds_number p h).
  assert (e' : holds (I.exp (F.PtoP p) (known_number p h)) (exp (Q2R h))) by exact (I.exp_correct (F.PtoP p) _ (Xreal _) e).
  assert (d := is_not_negative_sound _ _ k (holds_sub p _ _ _ _ f e')). cbn [value] in d. lra.
Qed.

Definition check_entropy (p : positive) (c : chaos) (weight : word -> Z) (h : Q) (g : growth_hint) : bool := grows c weight g && below_factor p h (growth_by g).
Theorem entropy_sound p c weight h g : check_entropy p c weight h g = true -> forall s x, agrees c x = true -> included c x -> words_hold s x ->
  entropy_at_least s c weight (Q2R h).
Proof.
  intros k s x a i w. apply andb_prop in k as [k1 k2]. exact (growth_entropy s c x weight g w a k1 i _ (below_factor_sound p h _ k2)).
Qed.
(* Both entropies that a document lists: that of half cycles is half of the one of cycles. *)
Definition check_entropies (p : positive) (c : chaos) (impacts cycles : growth_hint) : bool :=
  check_entropy p c impacts_of (per_impact c) impacts && check_entropy p c half_cycles (per_cycle c * (1 # 2)) cycles.
Theorem entropies_sound p c impacts cycles : check_entropies p c impacts cycles = true -> forall s x, agrees c x = true -> included c x -> words_hold s x ->
  entropy_at_least s c impacts_of (Q2R (per_impact c)) /\ entropy_at_least s c half_cycles (Q2R (per_cycle c) / 2).
Proof.
  intros k s x a i w. apply andb_prop in k as [k1 k2]. split; [exact (entropy_sound _ _ _ _ _ k1 s x a i w)|].
  replace (Q2R (per_cycle c) / 2) with (Q2R (per_cycle c * (1 # 2))); [exact (entropy_sound _ _ _ _ _ k2 s x a i w)|].
  rewrite Q2R_mult. unfold Q2R at 2. cbn. lra.
Qed.
End Growths.
