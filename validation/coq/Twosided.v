(* Two-sided sequences: every sequence of words that fit together, from minus infinity to infinity, is that of an orbit. *)
From Coq Require Import Reals Lra Lia List ZArith Classical.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Horseshoe Covers Shift.
Open Scope R_scope.

(* Closed bounded sets of the plane, each in the one before: a common point is computed, as the least upper bound of what is below their first coordinates,
   and then below the second coordinates of the points near. *)
Definition within (size : R) (x : state) : Prop := Rabs (fst x) <= size /\ Rabs (snd x) <= size.
Definition bounded (S : state -> Prop) : Prop := exists size, forall x, S x -> within size x.

Section Least.
Variables (S : nat -> state -> Prop) (f : state -> R).
Hypotheses (down : forall n m x, (n <= m)%nat -> S m x -> S n x) (some : forall n, exists x, S n x).
Hypothesis bound : exists size, forall n x, S n x -> Rabs (f x) <= size.
Lemma least_limit : {t : R | forall n (eps : posreal), exists x, S n x /\ Rabs (f x - t) < eps}.
Proof.
  set (E := fun t => exists n, forall x, S n x -> t <= f x).
  destruct (completeness E) as (t & upper & least).
  - destruct bound as [size h]. exists size. intros t [n below]. destruct (some n) as [x hx]. specialize (below x hx). specialize (h n x hx).
    assert (a := Rle_abs (f x)). lra.
  - destruct bound as [size h]. exists (- size). exists O. intros x hx. specialize (h O x hx). apply Rabs_le_between in h. lra.
  - exists t. intros n eps. assert (eps0 := cond_pos eps).
    assert (exists t0, E t0 /\ t - eps < t0) as (t0 & [m below] & near).
    { apply NNPP. intros none. assert (t <= t - eps); [|lra]. apply least. intros x hx. apply Rnot_lt_le. intros lt. apply none. exists x. auto. }
    assert (exists x, S (max n m) x /\ f x < t + eps) as (x & hx & close).
    { apply NNPP. intros none. assert (t + eps <= t); [|lra]. apply upper. exists (max n m). intros x hx. apply Rnot_lt_le. intros lt. apply none. exists x. auto. }
    exists x. split; [apply (down n (max n m)); [lia|exact hx]|]. specialize (below x (down _ _ _ (Nat.le_max_r n m) hx)). apply Rabs_def1; lra.
Qed.
End Least.

Lemma common_state (S : nat -> state -> Prop) : (forall n, closed (S n)) -> bounded (S 0%nat) -> (forall n m x, (n <= m)%nat -> S m x -> S n x) ->
  (forall n, exists x, S n x) -> {x : state | forall n, S n x}.
Proof.
  intros shut bound down some.
  destruct (least_limit S fst down some) as [u hu]; [destruct bound as [size h]; exists size; intros n x hx; apply h, (down O n); [lia|exact hx]|].
  set (T := fun n x => S n x /\ Rabs (fst x - u) < / (INR n + 1)).
  assert (pos : forall n, 0 < / (INR n + 1)) by (intros n; apply Rinv_0_lt_compat; assert (p := pos_INR n); lra).
  destruct (least_limit T snd) as [v hv].
  - intros n m x nm [hx close]. split; [exact (down n m x nm hx)|]. apply Rlt_le_trans with (1 := close), Rinv_le_contravar; [assert (p := pos_INR n); lra|].
    apply le_INR in nm. lra.
  - intros n. exact (hu n (mkposreal _ (pos n))).
  - destruct bound as [size h]. exists size. intros n x [hx _]. apply h, (down O n); [lia|exact hx].
  - exists (u, v). intros n. apply (shut n). intros [eps out]. assert (eps0 := cond_pos eps).
    destruct (nfloor_ex (/ eps)) as [k [_ hk]]; [apply Rlt_le, Rinv_0_lt_compat, eps0|].
    destruct (hv (max n k) eps) as (x & [hx close] & close'). apply (out x); [|apply (down n (max n k)); [lia|exact hx]].
    split; [|exact close']. apply Rlt_le_trans with (1 := close). rewrite <- (Rinv_inv eps). apply Rinv_le_contravar; [apply Rinv_0_lt_compat, eps0|].
    assert (INR k <= INR (max n k)) by (apply le_INR; lia). lra.
Qed.

(* A state alone, and those near it, are closed sets; and so is the image of a closed bounded set. *)
Lemma closed_near (z : state) r : closed (fun x : state => Rabs (fst x - fst z) <= r /\ Rabs (snd x - snd z) <= r).
Proof.
  apply closed_and.
  - apply (closed_comp (fun x : state => Rabs (fst x - fst z)) (fun t => t <= r)); [|apply closed_le]. intros x.
    apply (continuous_comp (fun x : state => fst x - fst z) Rabs); [|apply continuous_Rabs].
    apply (continuous_minus (V := R_NormedModule) (fun x : state => fst x)); [apply continuous_fst|apply continuous_const].
  - apply (closed_comp (fun x : state => Rabs (snd x - snd z)) (fun t => t <= r)); [|apply closed_le]. intros x.
    apply (continuous_comp (fun x : state => snd x - snd z) Rabs); [|apply continuous_Rabs].
    apply (continuous_minus (V := R_NormedModule) (fun x : state => snd x)); [apply continuous_snd|apply continuous_const].
Qed.
Lemma only_near (x z : state) : (forall n, Rabs (fst x - fst z) <= / (INR n + 1) /\ Rabs (snd x - snd z) <= / (INR n + 1)) -> x = z.
Proof.
  intros h. assert (zero : forall a, (forall n, Rabs a <= / (INR n + 1)) -> a = 0).
  { intros a ha. apply NNPP. intros n0. apply Rabs_pos_lt in n0. destruct (nfloor_ex (/ Rabs a)) as [k [_ hk]]; [apply Rlt_le, Rinv_0_lt_compat, n0|].
    specialize (ha k). assert (p := pos_INR k). apply Rinv_le_contravar in ha; [|exact n0]. rewrite Rinv_inv in ha. lra. }
  apply injective_projections; apply Rminus_diag_uniq, zero; intros n; apply h.
Qed.
Lemma closed_image (S : state -> Prop) (f : state -> state) : closed S -> bounded S -> continuous_on S f -> closed (fun z => exists x, S x /\ f x = z).
Proof.
  intros shut bound cont z near. assert (pos : forall n, 0 < / (INR n + 1)) by (intros n; apply Rinv_0_lt_compat; assert (p := pos_INR n); lra).
  destruct (common_state (fun n x => S x /\ Rabs (fst (f x) - fst z) <= / (INR n + 1) /\ Rabs (snd (f x) - snd z) <= / (INR n + 1))) as [x h].
  - intros n. exact (closed_part S _ f shut cont (closed_near z _)).
  - destruct bound as [size h]. exists size. intros x hx. apply h, hx.
  - intros n m x nm [hx [a b]]. assert (/ (INR m + 1) <= / (INR n + 1)); [|split; [exact hx|lra]].
    apply Rinv_le_contravar; [assert (p := pos_INR n); lra|]. apply le_INR in nm. lra.
  - intros n. apply NNPP. intros none. apply near. exists (mkposreal _ (pos n)). intros y [a b] (x & hx & <-). apply none. exists x. split; [exact hx|].
    split; apply Rlt_le; assumption.
  - exists x. split; [apply (h O)|]. apply only_near. intros n. apply h.
Qed.

(* Maps of closed bounded sets, each into the one before: a sequence of states, each the image of the next. *)
Section Backwards.
Variables (T : nat -> state -> Prop) (g : nat -> state -> state).
Hypotheses (shut : forall n, closed (T n)) (bound : forall n, bounded (T n)) (some : forall n, exists x, T n x).
Hypotheses (cont : forall n, continuous_on (T (S n)) (g n)) (into : forall n x, T (S n) x -> T n (g n x)).
(* From set m + n to set n. *)
Fixpoint descend (m n : nat) (x : state) : state := match m with O => x | S m => g n (descend m (S n) x) end.
Lemma descend_good m : forall n, continuous_on (T (m + n)%nat) (descend m n) /\ forall x, T (m + n)%nat x -> T n (descend m n x).
Proof.
  induction m as [|m IH]; intros n.
  - split; [apply continuous_on_forall; intros; apply continuous_id|auto].
  - destruct (IH (S n)) as [c i]. cbn [descend]. rewrite Nat.add_succ_r in c, i. change (S (m + n)) with (S m + n)%nat in c, i. split.
    + exact (on_comp _ (T (S n)) (descend m (S n)) (g n) c (cont n) i).
    + intros x h. apply into, i, h.
Qed.
Definition come_from (m n : nat) (z : state) : Prop := exists x, T (m + n)%nat x /\ descend m n x = z.
Lemma come_from_closed m n : closed (come_from m n).
Proof. apply closed_image; [apply shut|apply bound|apply descend_good]. Qed.
Lemma come_from_back m n z : come_from (S m) n z -> exists y, come_from m (S n) y /\ g n y = z.
Proof. intros (x & h & e). exists (descend m (S n) x). split; [exists x; split; [rewrite Nat.add_succ_r; exact h|reflexivity]|exact e]. Qed.
Lemma come_from_inside m n z : come_from m n z -> T n z.
Proof. intros (x & h & <-). apply descend_good, h. Qed.
Lemma come_from_less m : forall n z, come_from (S m) n z -> come_from m n z.
Proof.
  induction m as [|m IH]; intros n z h; [exists z; split; [exact (come_from_inside _ _ _ h)|reflexivity]|].
  apply come_from_back in h as (y & h & <-). apply IH in h as (x & h & <-). exists x. split; [rewrite Nat.add_succ_r in h; exact h|reflexivity].
Qed.
Lemma come_from_down n m k z : (m <= k)%nat -> come_from k n z -> come_from m n z.
Proof. induction 1 as [|k _ IH]; intros h; [exact h|apply IH, come_from_less, h]. Qed.
Let from_ever (n : nat) (z : state) : Prop := forall m, come_from m n z.

Lemma one_back n (z : {z : state | from_ever n z}) : {y : state | from_ever (S n) y /\ g n y = proj1_sig z}.
Proof.
  destruct z as [z h]. cbn [proj1_sig].
  destruct (common_state (fun m y => come_from m (S n) y /\ g n y = z)) as [y hy].
  - intros m. assert (c : closed (fun x : state => x = z)).
    { apply (closed_ext (fun x : state => Rabs (fst x - fst z) <= 0 /\ Rabs (snd x - snd z) <= 0)); [|apply closed_near]. intros x. split.
      - intros [a b]. apply injective_projections; apply Rminus_diag_uniq; apply NNPP; intros ne; apply Rabs_pos_lt in ne; lra.
      - intros ->. rewrite !Rminus_eq_0, Rabs_R0. lra. }
    apply (closed_part _ _ (g n) (come_from_closed m (S n))) with (2 := c). apply on_part with (2 := cont n). apply come_from_inside.
  - destruct (bound (S n)) as [size b]. exists size. intros y [hy _]. apply b, (come_from_inside O), hy.
  - intros m k y mk [hy e]. split; [exact (come_from_down _ _ _ _ mk hy)|exact e].
  - intros m. apply come_from_back, h.
  - exists y. split; [intros m; apply hy|apply (hy O)].
Qed.
Lemma first_back : {z : state | from_ever 0 z}.
Proof.
  apply (common_state (fun m z => come_from m 0 z)).
  - intros m. apply come_from_closed.
  - destruct (bound O) as [size b]. exists size. intros y hy. apply b, (come_from_inside O), hy.
  - intros m k z mk. apply come_from_down, mk.
  - intros m. destruct (some (m + 0)) as [x h]. exists (descend m 0 x), x. auto.
Qed.
Fixpoint back (n : nat) : {z : state | from_ever n z} := match n with
  | O => first_back
  | S n => let (y, h) := one_back n (back n) in exist _ y (proj1 h) end.
Theorem all_back : exists x : nat -> state, forall n, T n (x n) /\ g n (x (S n)) = x n.
Proof.
  exists (fun n => proj1_sig (back n)). intros n. split; [destruct (back n) as [z h]; exact (come_from_inside O _ _ (h O))|].
  cbn [back]. destruct (one_back n (back n)) as (y & h & e). exact e.
Qed.
End Backwards.

Section Both_ways.
Variables (base : nat -> frame) (words : list step_of).
Hypothesis cover : words_cover base words.
Definition fits_both_ways (s : Z -> nat) : Prop := forall n, (s n < length words)%nat /\ into_set (word_of words (s n)) = from_set (word_of words (s (n + 1)%Z)).

(* The states that obey a sequence are a closed bounded set. *)
Lemma obeys_next s x : fits words s -> obeys base words s x -> obeys base words (fun n => s (S n)) (move (word_of words (s O)) x).
Proof.
  intros _ h. assert (shift : forall n, after words (fun n => s (S n)) n (move (word_of words (s O)) x) = after words s (S n) x).
  { induction n as [|n IH]; [reflexivity|]. unfold after in *. cbn [visit] in *. rewrite IH. reflexivity. }
  intros n. rewrite !shift. exact (h (S n)).
Qed.
Lemma obeys_closed s : fits words s -> closed (obeys base words s).
Proof.
  intros f. set (here := fun n x => in_slice base words (s n) x /\ in_frame (base (into_set (word_of words (s n)))) (move (word_of words (s n)) x)).
  set (upto := fun n x => forall k, (k < n)%nat -> here k (after words s k x)).
  assert (next : forall n x, upto (S n) x <-> upto n x /\ here n (after words s n x)).
  { intros n x. split; [intros h; split; [intros k hk; apply h; lia|apply h; lia]|].
    intros [h l] k hk. destruct (Nat.eq_dec k n) as [->|ne]; [exact l|apply h; lia]. }
  assert (all : forall n, closed (upto n) /\ continuous_on (upto n) (after words s n)).
  { induction n as [|n [shut cont]].
    - split; [apply (closed_ext (fun _ => True)); [intros x; split; [intros _ k hk; lia|auto]|apply closed_true]|].
      apply continuous_on_forall. intros. apply continuous_id.
    - destruct (carried_word base words cover (s n) (proj1 (f n))) as (shut' & cont' & _). split.
      + apply (closed_ext (fun x => upto n x /\ here n (after words s n x))); [intros x; symmetry; apply next|]. exact (closed_part _ _ _ shut cont shut').
      + apply (on_comp _ (here n) (after words s n) (move (word_of words (s n)))); [|exact cont'|intros x h; apply next in h; apply h].
        apply (on_part (upto n)); [intros x h; apply next in h; apply h|exact cont]. }
  intros x near n. apply (proj1 (all (S n))) with (k := n); [|lia]. intros [eps out]. apply near. exists eps. intros y b h. apply (out y b). intros k _. apply h.
Qed.
Lemma frame_bounded N : area N <> 0 -> bounded (in_frame N).
Proof.
  intros h. exists (Rabs (fst (centre N)) + Rabs (fst (long N)) + Rabs (fst (wide N)) + (Rabs (snd (centre N)) + Rabs (snd (long N)) + Rabs (snd (wide N)))).
  intros x [a b]. rewrite <- (put_back N x h). unfold put, within. cbn [fst snd]. set (xi := along N x) in *. set (eta := across N x) in *.
  assert (size : forall c l w, Rabs (c + l * xi + w * eta) <= Rabs c + Rabs l + Rabs w).
  { intros c l w. apply Rle_trans with (1 := Rabs_triang _ _), Rplus_le_compat; [apply Rle_trans with (1 := Rabs_triang _ _), Rplus_le_compat_l|];
      rewrite Rabs_mult, <- Rmult_1_r; apply Rmult_le_compat_l; try apply Rabs_pos; apply Rabs_le; lra. }
  assert (s1 := size (fst (centre N)) (fst (long N)) (fst (wide N))). assert (s2 := size (snd (centre N)) (snd (long N)) (snd (wide N))).
  assert (p : forall c l w, 0 <= Rabs c + Rabs l + Rabs w) by (intros c l w; assert (p1 := Rabs_pos c); assert (p2 := Rabs_pos l); assert (p3 := Rabs_pos w); lra).
  assert (p1 := p (fst (centre N)) (fst (long N)) (fst (wide N))). assert (p2 := p (snd (centre N)) (snd (long N)) (snd (wide N))). lra.
Qed.
Lemma obeys_bounded s : fits words s -> bounded (obeys base words s).
Proof.
  intros f. destruct (frame_bounded (base (from_set (word_of words (s O))))) as [size h]; [apply (words_area _ _ cover), word_in, f|].
  exists size. intros x o. apply h, (slice_in_frame _ _ cover); [apply f|apply (o O)].
Qed.

(* Two-sided sequences. *)
Theorem every_orbit s : fits_both_ways s -> exists x : Z -> state, forall n, in_slice base words (s n) (x n) /\ x (n + 1)%Z = move (word_of words (s n)) (x n).
Proof.
  intros f. set (from := fun (k : Z) (n : nat) => s (k + Z.of_nat n)%Z).
  assert (fit : forall k, fits words (from k)).
  { intros k n. unfold from. rewrite Nat2Z.inj_succ, <- Z.add_1_r, Z.add_assoc. apply f. }
  assert (step : forall k x, obeys base words (from k) x -> obeys base words (from (k + 1)%Z) (move (word_of words (s k)) x)).
  { intros k x h. assert (e : s k = from k 0%nat) by (unfold from; rewrite Z.add_0_r; reflexivity). rewrite e.
    assert (h' := obeys_next _ _ (fit k) h). intros n. specialize (h' n).
    assert (same : forall n, from (k + 1)%Z n = from k (S n)) by (intros i; unfold from; f_equal; lia).
    rewrite !(after_same words (from (k + 1)%Z) (fun i => from k (S i))) by (intros; apply same). rewrite same. exact h'. }
  destruct (all_back (fun n => obeys base words (from (- Z.of_nat n)%Z)) (fun n => move (word_of words (s (- Z.of_nat (S n))%Z)))) as [y hy].
  - intros n. apply obeys_closed, fit.
  - intros n. apply obeys_bounded, fit.
  - intros n. apply every_sequence_obeyed; [exact cover|apply fit].
  - intros n. set (k := (- Z.of_nat (S n))%Z). apply (on_part (in_slice base words (s k))); [|apply (words_covers _ _ cover), word_in, f].
    intros x h. assert (h0 := proj1 (h O)). unfold from in h0. rewrite Z.add_0_r in h0. exact h0.
  - intros n x h. apply step in h. replace (- Z.of_nat n)%Z with (- Z.of_nat (S n) + 1)%Z by lia. exact h.
  - set (x := fun n : Z => if (n <? 0)%Z then y (Z.to_nat (- n)) else after words (from 0%Z) (Z.to_nat n) (y 0%nat)). exists x.
    assert (start := proj1 (hy O)). cbn beta in start. change (- Z.of_nat 0)%Z with 0%Z in start.
    intros n. unfold x. destruct (Z.ltb_spec n 0) as [neg|pos].
    + assert (e : n = (- Z.of_nat (Z.to_nat (- n)))%Z) by lia. split.
      * assert (h := proj1 (proj1 (hy (Z.to_nat (- n))) O)). rewrite <- e in h. unfold from in h. rewrite Z.add_0_r in h. exact h.
      * destruct (hy (Z.to_nat (- (n + 1)))) as [_ h]. replace (S (Z.to_nat (- (n + 1)))) with (Z.to_nat (- n)) in h by lia. rewrite <- e in h. rewrite h.
        destruct (Z.ltb_spec (n + 1) 0) as [neg'|zero]; [reflexivity|]. replace n with (-1)%Z by lia. reflexivity.
    + assert (there : forall k, from 0%Z (Z.to_nat k) = s k \/ (k < 0)%Z) by (intros k; unfold from; destruct (Z.ltb_spec k 0); [right; assumption|left; f_equal; lia]).
      assert (e : from 0%Z (Z.to_nat n) = s n) by (destruct (there n); [assumption|lia]). split.
      * rewrite <- e. apply start.
      * destruct (Z.ltb_spec (n + 1) 0) as [neg|_]; [lia|]. replace (Z.to_nat (n + 1)) with (S (Z.to_nat n)) by lia. rewrite <- e. reflexivity.
Qed.
End Both_ways.
