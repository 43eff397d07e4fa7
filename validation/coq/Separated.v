(* The number of sequences: where words from h-sets have a vector v with v b <= the sum of v (into) / q ^ weight over the words from b, there are c
   q^n sequences of which any two part after words of a total weight less than n. *)
From Coq Require Import Reals Lra Lia List Arith.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Horseshoe Covers Shift.
Import ListNotations.
Open Scope R_scope.

(* The sum of f over a list; the weight of the first n letters of a sequence. *)
Definition sum_over (f : nat -> R) (l : list nat) : R := fold_right (fun i r => f i + r) 0 l.
Fixpoint spent (weight : nat -> nat) (s : nat -> nat) (n : nat) : nat := match n with O => O | S n => (spent weight s n + weight (s n))%nat end.

Section Count.
Variables (words : list step_of) (weight : nat -> nat) (live : nat -> bool) (q : R) (v : nat -> R).
(* The words from an h-set. *)
Definition words_from (b : nat) : list nat := filter (fun i => (from_set (word_of words i) =? b)%nat) (seq 0 (length words)).
Record growth : Prop := {
  growth_weight : forall i, (i < length words)%nat -> (1 <= weight i)%nat;
  growth_factor : 1 <= q;
  growth_live : forall b, live b = true -> 0 < v b;
  growth_dead : forall b, live b = false -> v b = 0;
  growth_sum : forall b, live b = true -> v b <= sum_over (fun i => v (into_set (word_of words i)) / q ^ weight i) (words_from b) }.

Lemma sum_over_bound (f g : nat -> R) l : (forall i, In i l -> f i <= g i) -> sum_over f l <= sum_over g l.
Proof. induction l as [|i l IH]; intros h; cbn; [lra|]. apply Rplus_le_compat; [apply h; left; reflexivity|apply IH; intros k hk; apply h; right; exact hk]. Qed.
Lemma sum_over_times (f : nat -> R) r l : sum_over f l * r = sum_over (fun i => f i * r) l.
Proof. unfold sum_over. induction l as [|i l IH]; cbn; [ring|]. rewrite <- IH. ring. Qed.

(* Those of the words that lead on to h-sets from which one can go on; strings of them, ended as soon as their weight is n or more. *)
Let into (i : nat) : nat := into_set (word_of words i).
Definition exits (b : nat) : list nat := filter (fun i => live (into i)) (words_from b).
Fixpoint strings (fuel n b : nat) : list (list nat) := match fuel with
  | O => [[]]
  | S fuel => if (n =? 0)%nat then [[]] else flat_map (fun i => List.map (cons i) (strings fuel (n - weight i) (into i))) (exits b) end.
(* An infinite continuation of the sequence. *)
Definition next (b : nat) : nat := hd 0%nat (exits b).
Fixpoint onward (l : list nat) (b n : nat) : nat := match n, l with
  | O, [] => next b | O, i :: _ => i
  | S n, [] => onward [] (into (next b)) n | S n, i :: l => onward l (into i) n end.

Hypothesis grows : growth.

Lemma exits_some i b : In i (exits b) -> (i < length words)%nat /\ from_set (word_of words i) = b /\ live (into i) = true.
Proof.
  intros h. apply filter_In in h as [h l]. apply filter_In in h as [h e]. apply in_seq in h. apply Nat.eqb_eq in e. repeat split; [lia|exact e|exact l].
Qed.
Lemma exits_once b : NoDup (exits b).
Proof. apply NoDup_filter, NoDup_filter, seq_NoDup. Qed.
Lemma power_positive n : 0 < q ^ n.
Proof. apply pow_lt. assert (h := growth_factor grows). lra. Qed.
Lemma exits_sum b : live b = true -> v b <= sum_over (fun i => v (into i) / q ^ weight i) (exits b).
Proof.
  intros h. apply Rle_trans with (1 := growth_sum grows b h). unfold exits. fold into. induction (words_from b) as [|i l IH]; cbn; [lra|].
  destruct (live (into i)) eqn:e; cbn.
  - apply Rplus_le_compat_l, IH.
  - fold (into i). rewrite (growth_dead grows _ e). unfold Rdiv at 1. rewrite Rmult_0_l, Rplus_0_l. exact IH.
Qed.
Lemma next_in b : live b = true -> In (next b) (exits b).
Proof.
  intros h. unfold next. assert (s := exits_sum b h). assert (p := growth_live grows b h).
  destruct (exits b) as [|i l]; [cbn in s; lra|left; reflexivity].
Qed.

(* Their number. *)
Lemma strings_number m : (forall i, (i < length words)%nat -> v (into i) <= m) -> forall fuel n b, (n <= fuel)%nat -> live b = true -> v b <= m ->
  v b * q ^ n <= m * INR (length (strings fuel n b)).
Proof.
  intros most. induction fuel as [|fuel IH]; intros n b hn h low.
  - replace n with O by lia. cbn. rewrite !Rmult_1_r. exact low.
  - cbn [strings]. destruct (Nat.eqb_spec n 0) as [->|n0]; [cbn; rewrite !Rmult_1_r; exact low|].
    apply Rle_trans with (sum_over (fun i => m * INR (length (strings fuel (n - weight i) (into i)))) (exits b)).
    + apply Rle_trans with (sum_over (fun i => v (into i) / q ^ weight i) (exits b) * q ^ n).
      * apply Rmult_le_compat_r; [apply Rlt_le, power_positive|exact (exits_sum b h)].
      * rewrite sum_over_times. apply sum_over_bound. intros i hi. destruct (exits_some i b hi) as (range & _ & li).
        assert (w := growth_weight grows i range). assert (p := growth_live grows _ li).
        apply Rle_trans with (v (into i) * q ^ (n - weight i)); [|apply IH; [lia|exact li|exact (most i range)]].
        unfold Rdiv. rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|]. apply (Rmult_le_reg_l (q ^ weight i)); [apply power_positive|].
        rewrite <- Rmult_assoc, Rinv_r, Rmult_1_l, <- pow_add by (assert (pw := power_positive (weight i)); lra).
        apply Rle_pow; [exact (growth_factor grows)|lia].
    + apply Req_le. clear. induction (exits b) as [|i l IH]; [cbn; ring|]. cbn [flat_map sum_over fold_right]. rewrite app_length, map_length, plus_INR.
      fold (sum_over (fun i => m * INR (length (strings fuel (n - weight i) (into i)))) l). rewrite IH. ring.
Qed.

(* Any two part, after a weight less than n. *)
Definition parts (n : nat) (l l' : list nat) : Prop := exists p a r a' r',
  l = p ++ a :: r /\ l' = p ++ a' :: r' /\ a <> a' /\ (fold_right (fun i w => weight i + w) 0 p < n)%nat.
Lemma pairs_app {A : Type} (P : A -> A -> Prop) l l' : ForallOrdPairs P l -> ForallOrdPairs P l' ->
  (forall x y, In x l -> In y l' -> P x y) -> ForallOrdPairs P (l ++ l').
Proof.
  intros h h' cross. induction h as [|x l one h IH]; [exact h'|]. cbn. constructor.
  - apply Forall_app. split; [exact one|]. apply Forall_forall. intros y hy. apply cross; [left; reflexivity|exact hy].
  - apply IH. intros z y hz hy. apply cross; [right; exact hz|exact hy].
Qed.
Lemma strings_part fuel : forall n b, ForallOrdPairs (parts n) (strings fuel n b).
Proof.
  induction fuel as [|fuel IH]; intros n b; cbn [strings]; [constructor; constructor|].
  destruct (Nat.eqb_spec n 0) as [->|n0]; [constructor; constructor|].
  assert (once := exits_once b). assert (heavy : forall i, In i (exits b) -> (1 <= weight i)%nat) by (intros i hi; apply (growth_weight grows), (exits_some i b hi)).
  induction once as [|i l new once IH']; cbn [flat_map]; [constructor|]. apply pairs_app.
  - assert (w := heavy i (or_introl eq_refl)). specialize (IH (n - weight i)%nat (into i)). clear - IH n0 w. induction IH as [|x l one h IH]; cbn; constructor; [|exact IH].
    apply Forall_map. revert one. apply Forall_impl. intros y (p & a & r & a' & r' & -> & -> & ne & less).
    exists (i :: p), a, r, a', r'. repeat split; [exact ne|]. cbn [fold_right]. lia.
  - apply IH'. intros k hk. apply heavy. right. exact hk.
  - intros x y hx hy. apply in_map_iff in hx as (x' & <- & _). apply in_flat_map in hy as (k & hk & hy). apply in_map_iff in hy as (y' & <- & _).
    exists [], i, x', k, y'. repeat split; [intros ->; exact (new hk)|cbn; lia].
Qed.

(* The sequences. *)
Fixpoint leads_on (l : list nat) (b : nat) : Prop := match l with [] => True | i :: l => In i (exits b) /\ leads_on l (into i) end.
Lemma strings_lead fuel : forall n b l, In l (strings fuel n b) -> leads_on l b.
Proof.
  induction fuel as [|fuel IH]; intros n b l h; cbn [strings] in h; [destruct h as [<-|[]]; exact I|].
  destruct (n =? 0)%nat; [destruct h as [<-|[]]; exact I|]. apply in_flat_map in h as (i & hi & h). apply in_map_iff in h as (l' & <- & h).
  split; [exact hi|exact (IH _ _ _ h)].
Qed.
Lemma onward_first l b : live b = true -> leads_on l b -> In (onward l b 0) (exits b).
Proof. destruct l as [|i l]; intros h lead; [exact (next_in b h)|apply lead]. Qed.
Lemma onward_fits l b : live b = true -> leads_on l b -> fits words (onward l b).
Proof.
  intros h lead n. revert l b h lead. induction n as [|n IH]; intros l b h lead.
  - destruct (exits_some _ _ (onward_first l b h lead)) as (range & _ & on). split; [exact range|]. destruct l as [|i l]; cbn [onward] in *.
    + symmetry. apply (exits_some _ (into (next b))), next_in, on.
    + symmetry. destruct lead as [_ lead]. apply (exits_some _ (into i)). exact (onward_first l (into i) on lead).
  - destruct l as [|i l]; cbn [onward].
    + apply (IH [] (into (next b))); [|exact I]. apply (exits_some _ b), next_in, h.
    + destruct lead as [hi lead]. apply (IH l (into i)); [|exact lead]. apply (exits_some _ b), hi.
Qed.
Lemma onward_prefix p a r b k : onward (p ++ a :: r) b (length p) = a /\ ((k < length p)%nat -> onward (p ++ a :: r) b k = nth k p 0%nat).
Proof.
  revert b k. induction p as [|i p IH]; intros b k; cbn [app length]; [split; [reflexivity|lia]|]. cbn [onward]. split; [apply (IH (into i) O)|].
  intros hk. destruct k as [|k]; [reflexivity|]. cbn [onward nth]. apply IH. lia.
Qed.
Lemma spent_list (s : nat -> nat) p : (forall k, (k < length p)%nat -> s k = nth k p 0%nat) -> spent weight s (length p) = fold_right (fun i w => weight i + w)%nat 0%nat p.
Proof.
  induction p as [|i p IH] using rev_ind; intros h; [reflexivity|].
  rewrite app_length, Nat.add_1_r in *. cbn [spent]. rewrite IH.
  - rewrite h, app_nth2, Nat.sub_diag by lia. cbn [nth]. rewrite fold_right_app. cbn [fold_right]. rewrite Nat.add_0_r. clear. induction p as [|k p IH]; cbn; lia.
  - intros k hk. rewrite h by lia. apply app_nth1. exact hk.
Qed.
Lemma pairs_nth {A : Type} (P : A -> A -> Prop) (d : A) l : ForallOrdPairs P l -> forall i j, (i < j)%nat -> (j < length l)%nat -> P (nth i l d) (nth j l d).
Proof.
  induction 1 as [|x l one h IH]; intros i j ij hj; cbn [length] in hj; [lia|]. destruct j as [|j]; [lia|]. destruct i as [|i]; cbn [nth].
  - rewrite Forall_forall in one. apply one, nth_In. lia.
  - apply IH; lia.
Qed.
Lemma values_bound : exists m, 0 < m /\ forall i, (i < length words)%nat -> v (into i) <= m.
Proof.
  generalize (length words). induction n as [|n (m & m0 & h)]; [exists 1; split; [lra|lia]|].
  exists (Rmax m (v (into n))). split; [apply Rlt_le_trans with (1 := m0), Rmax_l|]. intros i hi.
  destruct (Nat.eq_dec i n) as [->|ne]; [apply Rmax_r|apply Rle_trans with (2 := Rmax_l _ _), h; lia].
Qed.

(* c q^n sequences from b, any two of which part after j words, of a weight less than n. *)
Theorem many_sequences b : live b = true -> exists c, 0 < c /\ forall n, exists (m : nat) (s : nat -> nat -> nat), c * q ^ n <= INR m /\
  (forall i, (i < m)%nat -> fits words (s i) /\ from_set (word_of words (s i 0%nat)) = b) /\
  (forall i i', (i < m)%nat -> (i' < m)%nat -> i <> i' -> exists j, (forall k, (k < j)%nat -> s i k = s i' k) /\ s i j <> s i' j /\ (spent weight (s i) j < n)%nat).
Proof.
  intros h. destruct values_bound as (m0 & m0_pos & below). set (m := Rmax m0 (v b)).
  assert (m_pos : 0 < m) by apply Rlt_le_trans with (1 := m0_pos), Rmax_l.
  exists (v b / m). split; [apply Rdiv_lt_0_compat; [exact (growth_live grows b h)|exact m_pos]|]. intros n. set (L := strings n n b).
  assert (lead : forall i, (i < length L)%nat -> leads_on (nth i L []) b) by (intros i hi; apply (strings_lead n n b), nth_In, hi).
  exists (length L), (fun i => onward (nth i L []) b). split; [|split].
  - assert (count := strings_number m (fun i hi => Rle_trans _ _ _ (below i hi) (Rmax_l _ _)) n n b (le_n n) h (Rmax_r _ _)). fold L in count.
    apply (Rmult_le_reg_l m); [exact m_pos|]. apply Rle_trans with (2 := count), Req_le. field. lra.
  - intros i hi. split; [exact (onward_fits _ b h (lead i hi))|]. apply (exits_some _ b), onward_first; [exact h|exact (lead i hi)].
  - assert (one : forall i i', (i < i')%nat -> (i' < length L)%nat -> exists j, (forall k, (k < j)%nat -> onward (nth i L []) b k = onward (nth i' L []) b k) /\
      onward (nth i L []) b j <> onward (nth i' L []) b j /\ (spent weight (onward (nth i L []) b) j < n)%nat).
    { intros i i' o hi'. destruct (pairs_nth _ [] L (strings_part n n b) i i' o hi') as (p & a & r & a' & r' & -> & -> & ne & less).
      exists (length p). split; [|split].
      - intros k hk. rewrite !(proj2 (onward_prefix _ _ _ _ _)) by exact hk. reflexivity.
      - rewrite !(proj1 (onward_prefix _ _ _ _ O)). exact ne.
      - rewrite spent_list; [exact less|]. intros k hk. apply onward_prefix, hk. }
    intros i i' hi hi' ne. destruct (Nat.lt_total i i') as [o|[e|o]]; [exact (one i i' o hi')|contradiction|].
    destruct (one i' i o hi) as (j & same & part & less). exists j. split; [intros k hk; symmetry; exact (same k hk)|]. split; [congruence|].
    apply Nat.le_lt_trans with (2 := less), Nat.eq_le_incl. clear - same. induction j as [|j IH]; [reflexivity|]. cbn [spent].
    rewrite IH by (intros k hk; apply same; lia). rewrite same by lia. reflexivity.
Qed.

End Count.
