(* Cells of a lattice on which n functions of two values all change: what the theorem of Poincaré and Miranda needs of topology.

   Functions s_0, ..., s_{n-1} of the points of {0..k}^n have the values true and false (1 and 0, added modulo 2); s_i is false where
   the coordinate i is 0, and true where it is k. Then on the points of one cell each of them has both values. No simplices and no
   permutations are needed: d below is the coboundary of the cubical complex, and d s_0 d s_1 ... d s_{n-1}, defined as
   d (s_0 d (s_1 ... d s_{n-1})), is a sum over the cell that is 0 if one of the functions is constant on it. The sum of all cells
   is by Stokes' theorem one over the sides of the cube. Those of the coordinate i > 0 give 0, as s_i is constant there, and so does
   the one with coordinate 0 equal to 0; the opposite one gives the same for n - 1, at last 1. *)
From Coq Require Import Arith Bool List Lia Classical FunctionalExtensionality.
Import ListNotations.

(* Points of the lattice, and the next one along an axis. *)
Definition point := nat -> nat.
Definition place (p : point) (a t : nat) : point := fun i => if i =? a then t else p i.
Definition next (p : point) (a : nat) : point := place p a (S (p a)).

(* A cochain: a value for each cell, given by its axes and its lowest point. *)
Definition form := list nat -> point -> bool.
(* Its coboundary: the sum over the sides of a cell. *)
Fixpoint d (w : form) (A : list nat) (p : point) : bool :=
  match A with [] => false | a :: r => xorb (xorb (w r p) (w r (next p a))) (d (fun r => w (a :: r)) r p) end.
Fixpoint product (s : list (point -> bool)) : form := match s with [] => fun _ _ => true | f :: s => d (fun r p => f p && product s r p) end.

Lemma next_next p a b : next (next p a) b = next (next p b) a.
Proof.
  apply functional_extensionality. intros i. unfold next, place.
  destruct (Nat.eqb_spec i b), (Nat.eqb_spec i a), (Nat.eqb_spec b a), (Nat.eqb_spec a b); subst; congruence.
Qed.
Lemma place_place p a b s t : a <> b -> place (place p a s) b t = place (place p b t) a s.
Proof. intros n. apply functional_extensionality. intros i. unfold place. destruct (Nat.eqb_spec i b), (Nat.eqb_spec i a); congruence. Qed.
Lemma place_again p a s t : place (place p a s) a t = place p a t.
Proof. apply functional_extensionality. intros i. unfold place. destruct (Nat.eqb_spec i a); reflexivity. Qed.
Lemma place_same p a t : place p a t a = t.
Proof. unfold place. rewrite Nat.eqb_refl. reflexivity. Qed.
Lemma place_other p a t i : i <> a -> place p a t i = p i.
Proof. intros n. unfold place. destruct (Nat.eqb_spec i a); [contradiction|reflexivity]. Qed.

Lemma d_sum (w v : form) A : forall p, d (fun r q => xorb (w r q) (v r q)) A p = xorb (d w A p) (d v A p).
Proof.
  revert w v. induction A as [|a r IH]; intros w v p; [reflexivity|]. cbn [d]. rewrite (IH (fun r => w (a :: r)) (fun r => v (a :: r))).
  destruct (w r p), (v r p), (w r (next p a)), (v r (next p a)), (d _ r p), (d _ r p); reflexivity.
Qed.
Lemma d_next (w : form) a A : forall p, d (fun r q => w r (next q a)) A p = d w A (next p a).
Proof.
  revert w. induction A as [|b r IH]; intros w p; [reflexivity|]. cbn [d]. rewrite (IH (fun r => w (b :: r))), (next_next p a b). reflexivity.
Qed.
Lemma d_constant c A : forall p, d (fun _ _ => c) A p = false.
Proof. induction A as [|a r IH]; intros p; [reflexivity|]. cbn [d]. rewrite IH. destruct c; reflexivity. Qed.
Lemma d_d A : forall (w : form) p, d (d w) A p = false.
Proof.
  induction A as [|a r IH]; intros w p; [reflexivity|]. cbn [d].
  change (fun r0 p0 => xorb (xorb (w r0 p0) (w r0 (next p0 a))) (d (fun r => w (a :: r)) r0 p0))
    with (fun r0 p0 => xorb ((fun r q => xorb (w r q) ((fun r q => w r (next q a)) r q)) r0 p0) (d (fun r => w (a :: r)) r0 p0)).
  rewrite !d_sum, IH, d_next. destruct (d w r p), (d w r (next p a)); reflexivity.
Qed.
Lemma product_closed s A p : d (product s) A p = false.
Proof. destruct s; [exact (d_constant true A p)|apply d_d]. Qed.

(* The cell of q with the axes r is a part of the one of p with A. *)
Definition part (r : list nat) (q : point) (A : list nat) (p : point) : Prop :=
  forall i, p i <= q i /\ q i + count_occ Nat.eq_dec r i <= p i + count_occ Nat.eq_dec A i.
Lemma part_then r q A p B o : part r q A p -> part A p B o -> part r q B o.
Proof. intros h k i. specialize (h i). specialize (k i). lia. Qed.
Lemma d_local A : forall (w v : form) p, (forall r q, part r q A p -> w r q = v r q) -> d w A p = d v A p.
Proof.
  induction A as [|a r IH]; intros w v p same; [reflexivity|]. cbn [d]. f_equal; [f_equal|].
  - apply same. intros i. cbn. destruct (Nat.eq_dec a i); lia.
  - apply same. intros i. cbn. unfold next, place. destruct (Nat.eq_dec a i), (Nat.eqb_spec i a); subst; lia.
  - apply IH. intros r' q h. apply same. intros i. specialize (h i). cbn. destruct (Nat.eq_dec a i); lia.
Qed.
(* No product of functions, one of which is constant on the cell. *)
Lemma product_constant c (f : point -> bool) s : In f s -> forall A p, (forall q, part [] q A p -> f q = c) -> product s A p = false.
Proof.
  induction s as [|g s IH]; intros member A p same; [destruct member|]. cbn [product].
  assert (corner : forall r q, part r q A p -> part [] q A p) by (intros r q h i; specialize (h i); cbn; lia).
  destruct member as [->|member].
  - rewrite (d_local A _ (fun r q => c && product s r q)) by (intros r q h; rewrite same; [reflexivity|exact (corner r q h)]).
    destruct c; cbn; [apply product_closed|apply d_constant].
  - rewrite (d_local A _ (fun _ _ => false)); [apply d_constant|]. intros r q h. rewrite (IH member r q); [apply andb_false_r|].
    intros q' h'. apply same. exact (part_then _ _ _ _ _ _ h' h).
Qed.

(* The sum over all cells of {0..k}^A, other coordinates being fixed. *)
Section Sums.
Variable k : nat.
Fixpoint sum (n : nat) (f : nat -> bool) : bool := match n with O => false | S n => xorb (sum n f) (f n) end.
Fixpoint total (A : list nat) (f : point -> bool) (p : point) : bool := match A with [] => f p | a :: r => sum k (fun t => total r f (place p a t)) end.

Lemma sum_same n f g : (forall t, f t = g t) -> sum n f = sum n g.
Proof. intros e. induction n as [|n IH]; [reflexivity|]. cbn. rewrite IH, e. reflexivity. Qed.
Lemma sum_xor n f g : sum n (fun t => xorb (f t) (g t)) = xorb (sum n f) (sum n g).
Proof. induction n as [|n IH]; [reflexivity|]. cbn. rewrite IH. destruct (sum n f), (sum n g), (f n), (g n); reflexivity. Qed.
Lemma sum_false n f : (forall t, f t = false) -> sum n f = false.
Proof. intros e. induction n as [|n IH]; [reflexivity|]. cbn. rewrite IH, e. reflexivity. Qed.
Lemma sum_steps n f : sum n (fun t => xorb (f t) (f (S t))) = xorb (f 0) (f n).
Proof. induction n as [|n IH]; [destruct (f 0); reflexivity|]. cbn. rewrite IH. destruct (f 0), (f n), (f (S n)); reflexivity. Qed.
Lemma sum_true n f : sum n f = true -> exists t, t < n /\ f t = true.
Proof.
  induction n as [|n IH]; [discriminate|]. cbn. intros e. destruct (f n) eqn:last; [exists n; auto|].
  rewrite xorb_false_r in e. destruct (IH e) as (t & lt & h). exists t. auto.
Qed.

Lemma total_xor f g A : forall p, total A (fun q => xorb (f q) (g q)) p = xorb (total A f p) (total A g p).
Proof. induction A as [|a r IH]; intros p; [reflexivity|]. cbn. rewrite <- sum_xor. apply sum_same. intros t. apply IH. Qed.
Lemma total_same f g A : forall p, (forall q, (forall i, ~ In i A -> q i = p i) -> f q = g q) -> total A f p = total A g p.
Proof.
  induction A as [|a r IH]; intros p e; [apply e; reflexivity|]. cbn. apply sum_same. intros t. apply IH. intros q h. apply e.
  intros i n. cbn in n. rewrite h by tauto. apply place_other. intros ->. tauto.
Qed.
Lemma total_false A : forall p, total A (fun _ => false) p = false.
Proof. induction A as [|a r IH]; intros p; [reflexivity|]. cbn. apply sum_false. intros t. apply IH. Qed.
Lemma total_next f a A : ~ In a A -> forall p, total A (fun q => f (next q a)) p = total A f (next p a).
Proof.
  induction A as [|b r IH]; intros n p; [reflexivity|]. cbn in n |- *. apply sum_same. intros t. rewrite IH by tauto. f_equal.
  unfold next. rewrite (place_other p b t a) by (intros ->; tauto). apply place_place. intros ->; tauto.
Qed.
Lemma total_true f A : forall p, total A f p = true -> exists q, (forall i, In i A -> q i < k) /\ (forall i, ~ In i A -> q i = p i) /\ f q = true.
Proof.
  induction A as [|a r IH]; intros p e; [exists p; repeat split; [intros i []|exact e]|]. cbn in e.
  destruct (sum_true _ _ e) as (t & lt & e'). destruct (IH _ e') as (q & low & fixed & h). exists q. split; [|split; [|exact h]].
  - intros i m. destruct (in_dec Nat.eq_dec i r) as [m'|m']; [exact (low i m')|]. destruct m as [<-|m]; [|contradiction].
    rewrite fixed, place_same by exact m'. exact lt.
  - intros i n. cbn in n. rewrite fixed by tauto. apply place_other. intros ->. tauto.
Qed.

(* Stokes' theorem, along one axis. *)
Lemma total_d (w : form) a r p : ~ In a r -> total (a :: r) (d w (a :: r)) p =
  xorb (xorb (total r (w r) (place p a 0)) (total r (w r) (place p a k))) (sum k (fun t => total r (d (fun r => w (a :: r)) r) (place p a t))).
Proof.
  intros n. cbn [total]. rewrite <- (sum_steps k (fun t => total r (w r) (place p a t))), <- sum_xor. apply sum_same. intros t. cbn [d].
  rewrite (total_xor (fun q => xorb (w r q) (w r (next q a)))), (total_xor (w r) (fun q => w r (next q a))), total_next by exact n.
  unfold next. rewrite place_same, place_again. reflexivity.
Qed.
(* The sum of the coboundary of what is 0 on the sides of the cube. *)
Lemma total_inside A : NoDup A -> forall (w : form) p,
  (forall r q a, In a A -> ~ In a r -> q a = 0 \/ q a = k -> w r q = false) -> total A (d w A) p = false.
Proof.
  induction 1 as [|a r n _ IH]; intros w p zero; [reflexivity|]. rewrite total_d by exact n.
  assert (side : forall t, t = 0 \/ t = k -> total r (w r) (place p a t) = false).
  { intros t ht. rewrite (total_same _ (fun _ => false)); [apply total_false|]. intros q h. apply (zero r q a); [left; reflexivity|exact n|].
    rewrite h, place_same by exact n. exact ht. }
  rewrite !side by auto. rewrite sum_false; [reflexivity|]. intros t. apply IH. intros r' q b m m' h. apply (zero (a :: r') q b); [right; exact m| |exact h].
  intros [->|m'']; contradiction.
Qed.

Variable s : nat -> point -> bool.
Lemma total_product A : NoDup A -> (forall i p, In i A -> p i = 0 -> s i p = false) -> (forall i p, In i A -> p i = k -> s i p = true) ->
  forall p, total A (product (map s A) A) p = true.
Proof.
  induction 1 as [|a r n nodup IH]; intros low high p; [reflexivity|]. cbn [map product]. rewrite total_d by exact n.
  rewrite (total_same _ (fun _ => false) r (place p a 0)), total_false.
  2:{ intros q h. rewrite low; [reflexivity|left; reflexivity|]. rewrite h by exact n. apply place_same. }
  rewrite (total_same _ (product (map s r) r) r (place p a k)), IH.
  2:{ intros i q m. apply low. right. exact m. }
  2:{ intros i q m. apply high. right. exact m. }
  2:{ intros q h. rewrite high; [reflexivity|left; reflexivity|]. rewrite h by exact n. apply place_same. }
  rewrite sum_false; [reflexivity|]. intros t. apply (total_inside r nodup (fun r' q => s a q && product (map s r) (a :: r') q)). intros r' q b m m' h.
  assert (c : exists c, forall q', q' b = q b -> s b q' = c).
  { destruct h as [h|h]; [exists false|exists true]; intros q' e; [apply low|apply high]; try (right; exact m); congruence. }
  destruct c as [c same]. rewrite (product_constant c (s b)); [apply andb_false_r|apply in_map; exact m|].
  intros q' inside. apply same. specialize (inside b). cbn [count_occ] in inside.
  assert (count_occ Nat.eq_dec r' b = 0) by (apply count_occ_not_In; exact m').
  destruct (Nat.eq_dec a b) as [<-|_]; [contradiction|]. lia.
Qed.
End Sums.

(* A cell on which each of the functions has both values. *)
Theorem cell (n k : nat) (s : nat -> point -> bool) :
  (forall i p, i < n -> p i = 0 -> s i p = false) -> (forall i p, i < n -> p i = k -> s i p = true) ->
  exists p : point, (forall i, i < n -> p i < k) /\ forall i c, i < n -> exists q, (forall j, p j <= q j <= S (p j)) /\ s i q = c.
Proof.
  intros low high. set (A := seq 0 n). assert (member : forall i, In i A <-> i < n) by (intros i; unfold A; rewrite in_seq; lia).
  assert (one : forall i, count_occ Nat.eq_dec A i <= 1) by (apply NoDup_count_occ, seq_NoDup).
  destruct (total_true k (product (map s A) A) A (fun _ => 0)) as (p & inside & _ & odd).
  { apply total_product; [apply seq_NoDup|intros i p m; apply low, member, m|intros i p m; apply high, member, m]. }
  exists p. split; [intros i h; apply inside, member, h|]. intros i c h. apply NNPP. intros none.
  enough (product (map s A) A p = false) by congruence. apply (product_constant (negb c) (s i)); [apply in_map, member, h|].
  intros q corner. destruct (s i q) eqn:e, c; try reflexivity; exfalso; apply none; exists q; (split; [|exact e]);
    intros j; specialize (corner j); specialize (one j); cbn in corner; lia.
Qed.
