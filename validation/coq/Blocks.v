(* Blocks in any order: a program `any_order` that finds h-sets from each of which a word of either of two blocks leads to one of them, the most of them, and the
   proof that words of the two blocks then follow one another in every order (`order_sound`); and that no two blocks of fewer impacts do so (`fewest_sound`). *)
From Coq Require Import Reals Lia List ZArith QArith Bool.
From ImpactPair Require Import Model Step Certificate Document Cycle Region Chaos Motions.
Import ListNotations.

(* Decides whether two words are the same block. *)
Definition one_block (a b : word) : bool := pairwise Bool.eqb (word_flights a) (word_flights b) && (half_cycles a =? half_cycles b)%Z.
Lemma pairwise_same a : forall b, pairwise Bool.eqb a b = true <-> a = b.
Proof.
  induction a as [|u a IH]; intros [|v b]; cbn [pairwise]; try (split; congruence). rewrite andb_true_iff, eqb_true_iff, IH.
  split; [intros [-> ->]; reflexivity|intros [= -> ->]; auto].
Qed.
Lemma one_block_is a b : one_block a b = true <-> same_block a b.
Proof. unfold one_block, same_block. rewrite andb_true_iff, pairwise_same, Z.eqb_eq. reflexivity. Qed.

(* H-sets are marked in a list. Those from which a word leads to a marked one; those of the marked ones from which words of both lists do; and so on, while
   any are taken away. *)
Definition marked (live : list bool) (b : nat) : bool := nth b live false.
Definition sources (ws : list word) (live : list bool) : list nat := map word_from (filter (fun w => marked live (word_into w)) ws).
Definition shrink (ws ws' : list word) (live : list bool) : list bool := let from := sources ws live in let from' := sources ws' live in
  map (fun b => if marked live b then if existsb (Nat.eqb b) from then existsb (Nat.eqb b) from' else false else false) (seq 0 (length live)).
Fixpoint shrunk (fuel : nat) (ws ws' : list word) (live : list bool) : list bool := match fuel with
  | O => live | S fuel => let less := shrink ws ws' live in if pairwise Bool.eqb less live then live else shrunk fuel ws ws' less end.
Definition any_order (c : chaos) (a b : nat) : bool := let number := length (words c) in
  if ((a <? number) && (b <? number) && negb (one_block (word_of c a) (word_of c b)))%nat then
    let ws := filter (one_block (word_of c a)) (words c) in let ws' := filter (one_block (word_of c b)) (words c) in
    let live := shrunk (length (h_sets c)) ws ws' (map (fun _ => true) (h_sets c)) in existsb (fun l => l) live && pairwise Bool.eqb (shrink ws ws' live) live
  else false.

Lemma sources_in ws live b : existsb (Nat.eqb b) (sources ws live) = true -> exists w, In w ws /\ word_from w = b /\ marked live (word_into w) = true.
Proof.
  intros h. apply existsb_exists in h as (b' & h & e). apply Nat.eqb_eq in e. subst b'. apply in_map_iff in h as (w & e & h).
  apply filter_In in h as [h l]. exists w. auto.
Qed.
Lemma shrink_stays ws ws' live b : shrink ws ws' live = live -> marked live b = true ->
  existsb (Nat.eqb b) (sources ws live) = true /\ existsb (Nat.eqb b) (sources ws' live) = true.
Proof.
  intros same h. assert (hb : (b < length live)%nat) by (apply not_ge; intros o; unfold marked in h; rewrite nth_overflow in h by lia; discriminate).
  assert (k := h). rewrite <- same in k. unfold marked at 1, shrink in k. cbv zeta in k.
  set (f := fun b => if marked live b then _ else false) in k.
  rewrite (nth_indep _ false (f 0%nat)), map_nth, seq_nth in k by (rewrite ?map_length, ?seq_length; exact hb).
  change (0 + b)%nat with b in k. unfold f in k. rewrite h in k. destruct (existsb (Nat.eqb b) (sources ws live)); [auto|discriminate].
Qed.

Section Order.
Variables (c : chaos) (a b : nat) (live : list bool).
Definition either (letter : bool) : nat := if letter then a else b.
Hypothesis both : forall set letter, marked live set = true -> exists w, In w (words c) /\ one_block (word_of c (either letter)) w = true /\
  word_from w = set /\ marked live (word_into w) = true.
(* The first word that will do, and the sequence of such words. *)
Definition will_do (set : nat) (letter : bool) (i : nat) : bool := let w := word_of c i in
  one_block (word_of c (either letter)) w && (word_from w =? set)%nat && marked live (word_into w).
Definition chosen (set : nat) (letter : bool) : nat := hd O (filter (will_do set letter) (seq 0 (length (words c)))).
Lemma chosen_well set letter : marked live set = true -> (chosen set letter < length (words c))%nat /\ word_from (word_of c (chosen set letter)) = set /\
  marked live (word_into (word_of c (chosen set letter))) = true /\ same_block (word_of c (either letter)) (word_of c (chosen set letter)).
Proof.
  intros h. destruct (both set letter h) as (w & hw & block & from & into). apply (In_nth _ _ no_word) in hw as (i & hi & e).
  assert (found : In i (filter (will_do set letter) (seq 0 (length (words c))))).
  { apply filter_In. split; [apply in_seq; lia|]. unfold will_do. change (word_of c i = w) in e. rewrite e, block, from, into, Nat.eqb_refl. reflexivity. }
  unfold chosen. destruct (filter (will_do set letter) (seq 0 (length (words c)))) as [|k l] eqn:some; [destruct found|]. cbn [hd].
  assert (k_in : In k (k :: l)) by (left; reflexivity). rewrite <- some in k_in. apply filter_In in k_in as [range good]. apply in_seq in range.
  unfold will_do in good. apply andb_prop in good as [good g3]. apply andb_prop in good as [g1 g2]. apply Nat.eqb_eq in g2. apply one_block_is in g1.
  split; [lia|]. auto.
Qed.
Section Letters.
Variables (start : nat) (letters : nat -> bool).
Fixpoint place (n : nat) : nat := match n with O => start | S n => word_into (word_of c (chosen (place n) (letters n))) end.
Hypothesis begins : marked live start = true.
Lemma place_marked n : marked live (place n) = true.
Proof. induction n as [|n IH]; [exact begins|]. apply (chosen_well _ (letters n) IH). Qed.
Lemma ordered : exists ws, fits S c ws /\ forall n, same_block (word_of c (ws n)) (word_of c (either (letters n))).
Proof.
  exists (fun n => chosen (place n) (letters n)). split; intros n; assert (well := chosen_well _ (letters n) (place_marked n)).
  - split; [apply well|]. symmetry. apply (chosen_well (place (S n)) (letters (S n)) (place_marked (S n))).
  - destruct well as (_ & _ & _ & e1 & e2). split; symmetry; assumption.
Qed.
End Letters.
End Order.

Theorem order_sound c a b : any_order c a b = true -> in_any_order c a b.
Proof.
  unfold any_order. cbv zeta. intros h. destruct (_ && _) eqn:k in h; [|discriminate]. apply andb_prop in k as [k k3]. apply andb_prop in k as [k1 k2].
  apply Nat.ltb_lt in k1, k2. apply negb_true_iff in k3. apply andb_prop in h as [some same]. apply pairwise_same in same. revert some same.
  generalize (shrunk (length (h_sets c)) (filter (one_block (word_of c a)) (words c)) (filter (one_block (word_of c b)) (words c)) (map (fun _ => true) (h_sets c))).
  intros live some same. split; [exact k1|]. split; [exact k2|]. split; [intros e; apply one_block_is in e; congruence|]. intros letters.
  apply existsb_exists in some as (l & hl & ->). apply (In_nth _ _ false) in hl as (start & _ & begins).
  apply (ordered c a b live) with (start := start); [|exact begins]. intros set letter h. destruct (shrink_stays _ _ _ _ same h) as [from from'].
  destruct letter; [apply sources_in in from as (w & hw & e)|apply sources_in in from' as (w & hw & e)]; apply filter_In in hw as [hw block]; exists w; auto.
Qed.
(* No h-sets in which two blocks stay are taken away. *)
Lemma shrink_keeps ws ws' live (sets : nat -> Prop) : (forall b, sets b -> marked live b = true) ->
  (forall b, sets b -> exists w, In w ws /\ word_from w = b /\ sets (word_into w)) -> (forall b, sets b -> exists w, In w ws' /\ word_from w = b /\ sets (word_into w)) ->
  forall b, sets b -> marked (shrink ws ws' live) b = true.
Proof.
  intros all both both' b h. assert (live_b := all b h).
  assert (source : forall ws0, (forall b, sets b -> exists w, In w ws0 /\ word_from w = b /\ sets (word_into w)) -> existsb (Nat.eqb b) (sources ws0 live) = true).
  { intros ws0 leads. destruct (leads b h) as (w & hw & from & into). apply existsb_exists. exists b. split; [|apply Nat.eqb_refl].
    apply in_map_iff. exists w. split; [exact from|]. apply filter_In. split; [exact hw|exact (all _ into)]. }
  assert (hb : (b < length live)%nat) by (apply not_ge; intros o; unfold marked in live_b; rewrite nth_overflow in live_b by lia; discriminate).
  unfold marked, shrink. cbv zeta. set (f := fun b => if marked live b then _ else false).
  rewrite (nth_indep _ false (f 0%nat)), map_nth, seq_nth by (rewrite ?map_length, ?seq_length; exact hb).
  change (0 + b)%nat with b. unfold f. rewrite live_b, (source ws both), (source ws' both'). reflexivity.
Qed.
Lemma shrunk_keeps fuel ws ws' (sets : nat -> Prop) : (forall b, sets b -> exists w, In w ws /\ word_from w = b /\ sets (word_into w)) ->
  (forall b, sets b -> exists w, In w ws' /\ word_from w = b /\ sets (word_into w)) ->
  forall live, (forall b, sets b -> marked live b = true) -> forall b, sets b -> marked (shrunk fuel ws ws' live) b = true.
Proof.
  intros both both'. induction fuel as [|fuel IH]; intros live all b h; cbn [shrunk]; [exact (all b h)|]. cbv zeta.
  destruct (pairwise _ _ _); [exact (all b h)|]. apply IH; [|exact h]. apply shrink_keeps; assumption.
Qed.
Lemma all_marked {X : Type} (xs : list X) : forall b, (b < length xs)%nat -> marked (map (fun _ => true) xs) b = true.
Proof. induction xs as [|x xs IH]; intros [|b] h; cbn [length] in h; try lia; [reflexivity|]. apply IH. lia. Qed.
(* No two blocks of fewer impacts stay in any h-sets. *)
Definition is_fewer (a b a' b' : word) : bool := let size := fun w => length (word_flights w) in
  let longer := Nat.max (size a) (size b) in let longer' := Nat.max (size a') (size b') in
  if (longer <? longer')%nat then true else if (longer =? longer')%nat then (Nat.min (size a) (size b) <? Nat.min (size a') (size b'))%nat else false.
Definition check_fewest (c : chaos) (a b : nat) : bool := let numbers := seq 0 (length (words c)) in
  forallb (fun i => forallb (fun j =>
    if (if is_fewer (word_of c i) (word_of c j) (word_of c a) (word_of c b) then negb (one_block (word_of c i) (word_of c j)) else false) then
      negb (existsb (fun l => l) (shrunk (length (h_sets c)) (filter (one_block (word_of c i)) (words c)) (filter (one_block (word_of c j)) (words c)) (map (fun _ => true) (h_sets c))))
    else true) numbers) numbers.
Theorem fewest_sound c a b : check_fewest c a b = true -> are_fewest c a b.
Proof.
  intros check i j (hi & hj & differ & sets & (n & some) & range & stays_i & stays_j) less. unfold check_fewest in check. cbv zeta in check.
  rewrite forallb_forall in check. assert (check' := check i ltac:(apply in_seq; lia)). cbv beta in check'. rewrite forallb_forall in check'.
  assert (h := check' j ltac:(apply in_seq; lia)). cbv beta in h. clear check check'.
  assert (small : is_fewer (word_of c i) (word_of c j) (word_of c a) (word_of c b) = true).
  { unfold is_fewer. cbv zeta. unfold fewer in less. cbv zeta in less. destruct less as [less|[same less]].
    - apply Nat.ltb_lt in less. rewrite less. reflexivity.
    - destruct (_ <? _)%nat; [reflexivity|]. apply Nat.eqb_eq in same. rewrite same. apply Nat.ltb_lt. exact less. }
  rewrite small in h. destruct (one_block (word_of c i) (word_of c j)) eqn:one; [destruct differ; apply one_block_is, one|]. cbn [negb] in h.
  apply negb_true_iff in h.
  assert (filtered : forall k, stays c sets k -> forall b, sets b -> exists w, In w (filter (one_block (word_of c k)) (words c)) /\ word_from w = b /\ sets (word_into w)).
  { intros k hk b' hb. destruct (hk b' hb) as (w & hw & block & from & into). exists w. split; [|auto]. apply filter_In. split; [exact hw|apply one_block_is, block]. }
  assert (kept := shrunk_keeps (length (h_sets c)) _ _ sets (filtered i stays_i) (filtered j stays_j) (map (fun _ => true) (h_sets c))
    (fun b' hb => all_marked _ _ (range b' hb)) n some).
  revert h kept. generalize (shrunk (length (h_sets c)) (filter (one_block (word_of c i)) (words c)) (filter (one_block (word_of c j)) (words c)) (map (fun _ => true) (h_sets c))).
  intros live none kept. assert (yes : existsb (fun l => l) live = true).
  { apply existsb_exists. exists true. split; [|reflexivity]. unfold marked in kept. rewrite <- kept. apply nth_In. apply not_ge. intros o. rewrite nth_overflow in kept by lia. discriminate. }
  congruence.
Qed.
(* The two blocks that a document lists, if it does. *)
Definition check_blocks (c : chaos) : bool := match blocks c with None => true | Some (a, b) => if any_order c a b then check_fewest c a b else false end.
Theorem blocks_sound c : check_blocks c = true -> match blocks c with None => True | Some (a, b) => in_any_order c a b /\ are_fewest c a b end.
Proof.
  unfold check_blocks. destruct (blocks c) as [[a b]|]; [|trivial]. destruct (any_order c a b) eqn:order; [|discriminate].
  intros fewest. split; [exact (order_sound _ _ _ order)|exact (fewest_sound _ _ _ fewest)].
Qed.
