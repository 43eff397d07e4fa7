(* The theorem of Poincaré and Miranda: n continuous functions on the cube, the i-th of opposite signs on the two sides of the i-th
   coordinate, have a common zero. By cells of finer and finer lattices (Lattice.v) and the compactness of the cube; points are
   sequences of coordinates, of which the first n matter. *)
From Coq Require Import Reals Lra Lia Bool Classical FunctionalExtensionality.
From ImpactPair Require Lattice.
Open Scope R_scope.

Definition cube (n : nat) (x : nat -> R) : Prop := forall i, (i < n)%nat -> -1 <= x i <= 1.
(* Nearer than del in each coordinate. *)
Definition close (n : nat) (del : R) (x y : nat -> R) : Prop := forall j, (j < n)%nat -> Rabs (y j - x j) < del.
Definition continuous_at_cube n (f : (nat -> R) -> R) : Prop := forall x, cube n x -> forall eps, 0 < eps -> exists del, 0 < del /\
  forall y, cube n y -> (forall j, (j < n)%nat -> Rabs (y j - x j) < del) -> Rabs (f y - f x) < eps.

(* Compactness: a property that holds near each point of the cube, for some del > 0 and all smaller ones, holds for one del on the whole cube. *)
Section Compact.
Variables (n : nat) (good : R -> (nat -> R) -> Prop).
Hypothesis smaller : forall del del' x, del' <= del -> good del x -> good del' x.
Hypothesis local : forall x, cube n x -> exists del, 0 < del /\ forall y, cube n y -> close n del x y -> good del y.

(* The first j coordinates are free, the next one at most below, the others near those of x. *)
Let tube (j : nat) (x : nat -> R) (below : R) : Prop := exists del, 0 < del /\ forall y, cube n y ->
  (forall i, (j < i)%nat -> (i < n)%nat -> Rabs (y i - x i) < del) -> y j <= below -> good del y.
Lemma tube_next j x : (j < n)%nat -> cube n x ->
  (forall z, cube n z -> exists del, 0 < del /\ forall y, cube n y -> (forall i, (j <= i)%nat -> (i < n)%nat -> Rabs (y i - z i) < del) -> good del y) ->
  tube j x 1.
Proof.
  intros jn hx all. set (at_ := fun t i => if Nat.eqb i j then t else x i).
  (* From values below t, a value a little above t is reached. *)
  assert (near : forall t, -1 <= t <= 1 -> exists e, 0 < e /\ forall u, t - e < u -> tube j x u \/ u < -1 -> tube j x (t + e)).
  { intros t ht. destruct (all (at_ t)) as (del & pos & h).
    { intros i hi. unfold at_. destruct (Nat.eqb_spec i j); [lra|apply hx, hi]. }
    exists (del / 2). split; [lra|]. intros u hu reached.
    assert (tube j x u) as (del' & pos' & h').
    { destruct reached as [reached|low]; [exact reached|]. exists 1. split; [lra|]. intros y hy _ yj. specialize (hy j jn). lra. }
    exists (Rmin del del'). split; [apply Rmin_glb_lt; assumption|]. assert (m := Rmin_l del del'). assert (m' := Rmin_r del del').
    intros y hy others yj. destruct (Rle_lt_dec (y j) u) as [l|g].
    - apply (smaller del' _ y m'), h'; [exact hy| |exact l]. intros i ji hi. specialize (others i ji hi). lra.
    - apply (smaller del _ y m), h; [exact hy|]. intros i ji hi. unfold at_. destruct (Nat.eqb_spec i j) as [->|ne]; [apply Rabs_def1; lra|].
      specialize (others i ltac:(lia) hi). lra. }
  set (E := fun t => -1 <= t <= 1 /\ tube j x t).
  assert (lower : forall t u, u <= t -> tube j x t -> tube j x u).
  { intros t u ut (del & pos & h). exists del. split; [exact pos|]. intros y hy others yj. apply h; [exact hy|exact others|lra]. }
  assert (first : E (-1)).
  { destruct (near (-1) ltac:(lra)) as (e & pos & h). split; [lra|]. apply (lower (-1 + e)); [lra|]. apply (h (-1 - e / 2)); [lra|right; lra]. }
  destruct (completeness E) as (t & upper & least); [exists 1; intros u [hu _]; lra|exists (-1); exact first|].
  assert (ht : -1 <= t <= 1) by (split; [exact (upper _ first)|apply least; intros u [hu _]; lra]).
  destruct (near t ht) as (e & pos & h).
  assert (exists u, E u /\ t - e < u) as (u & [hu reached] & close_u).
  { apply NNPP. intros none. assert (t <= t - e); [|lra]. apply least. intros u hu. apply Rnot_lt_le. intros l. apply none. exists u. auto. }
  specialize (h u close_u (or_introl reached)). destruct (Rle_lt_dec 1 (t + e)) as [l|l]; [exact (lower _ 1 l h)|].
  assert (t + e <= t) by (apply upper; split; [lra|exact h]). lra.
Qed.
(* One coordinate after the other is freed. *)
Theorem uniformly : exists del, 0 < del /\ forall y, cube n y -> good del y.
Proof.
  assert (all : forall j, (j <= n)%nat -> forall x, cube n x -> exists del, 0 < del /\ forall y, cube n y ->
    (forall i, (j <= i)%nat -> (i < n)%nat -> Rabs (y i - x i) < del) -> good del y).
  { induction j as [|j IH]; intros jn x hx.
    - destruct (local x hx) as (del & pos & h). exists del. split; [exact pos|]. intros y hy others. apply h; [exact hy|].
      intros i hi. apply others; [lia|exact hi].
    - destruct (tube_next j x ltac:(lia) hx (IH ltac:(lia))) as (del & pos & h). exists del. split; [exact pos|].
      intros y hy others. apply h; [exact hy|exact others|]. apply hy. lia. }
  destruct (all n (le_n n) (fun _ => 0)) as (del & pos & h); [intros i _; lra|]. exists del. split; [exact pos|]. intros y hy. apply h; [exact hy|lia].
Qed.
End Compact.

(* The points of a lattice of the cube, k steps to a side. *)
Definition spot (k : nat) (p : Lattice.point) : nat -> R := fun i => -1 + 2 * (INR (p i) / INR k).
Lemma spot_inside n k p : (0 < k)%nat -> (forall i, (i < n)%nat -> (p i <= k)%nat) -> cube n (spot k p).
Proof.
  intros k0 inside i hi. unfold spot. apply lt_0_INR in k0. assert (a := pos_INR (p i)). assert (b := le_INR _ _ (inside i hi)).
  assert (INR (p i) / INR k * INR k = INR (p i)) by (field; lra). nra.
Qed.

(* Poincaré and Miranda. *)
Theorem poincare_miranda n (f : nat -> (nat -> R) -> R) : (forall i, (i < n)%nat -> continuous_at_cube n (f i)) ->
  (forall i x, (i < n)%nat -> cube n x -> x i = -1 -> f i x <= 0) -> (forall i x, (i < n)%nat -> cube n x -> x i = 1 -> 0 <= f i x) ->
  exists x, cube n x /\ forall i, (i < n)%nat -> f i x = 0.
Proof.
  intros cont low high. apply NNPP. intros none.
  (* Else near each point one of the functions has one sign. *)
  set (good := fun del x => exists i, (i < n)%nat /\
    ((forall y, cube n y -> close n del x y -> 0 < f i y) \/ (forall y, cube n y -> close n del x y -> f i y < 0))).
  destruct (uniformly n good) as (del & pos & all).
  - intros del del' x le (i & hi & sign). exists i. split; [exact hi|].
    destruct sign as [h|h]; [left|right]; intros y hy c; (apply h; [exact hy|]); intros j hj; specialize (c j hj); lra.
  - intros x hx. assert (exists i, (i < n)%nat /\ f i x <> 0) as (i & hi & ne).
    { apply NNPP. intros no. apply none. exists x. split; [exact hx|]. intros i hi. apply NNPP. intros ne. apply no. exists i. auto. }
    destruct (cont i hi x hx (Rabs (f i x)) (Rabs_pos_lt _ ne)) as (del & pos & h). exists (del / 2). split; [lra|].
    intros y hy c. exists i. split; [exact hi|].
    assert (near : forall z, cube n z -> close n (del / 2) y z -> Rabs (f i z - f i x) < Rabs (f i x)).
    { intros z hz c'. apply h; [exact hz|]. intros j hj. specialize (c j hj). specialize (c' j hj).
      replace (z j - x j) with ((z j - y j) + (y j - x j)) by ring. apply Rle_lt_trans with (1 := Rabs_triang _ _). lra. }
    destruct (Rtotal_order (f i x) 0) as [neg|[zero|plus]]; [right|contradiction|left]; intros z hz c'; specialize (near z hz c'); apply Rabs_def2 in near.
    + rewrite Rabs_left in near by exact neg. lra.
    + rewrite Rabs_pos_eq in near by lra. lra.
  - (* On a cell of a fine lattice all of them have both. *)
    destruct (archimed_cor1 (del / 2) ltac:(lra)) as (k & fine & k0). assert (K := lt_0_INR k k0).
    set (s := fun i (p : Lattice.point) => if Nat.eqb (p i) 0 then false else if Nat.eqb (p i) k then true
      else if Rlt_dec 0 (f i (spot k p)) then true else false).
    destruct (Lattice.cell n k s) as (p & inside & both).
    { intros i p _ e. unfold s. rewrite e. reflexivity. }
    { intros i p _ e. unfold s. rewrite e, Nat.eqb_refl. destruct (Nat.eqb_spec k 0); [lia|reflexivity]. }
    assert (of_cell : forall q, (forall j, (p j <= q j <= S (p j))%nat) -> cube n (spot k q) /\ close n del (spot k p) (spot k q)).
    { intros q corner. split; [apply spot_inside; [exact k0|]; intros i hi; specialize (inside i hi); specialize (corner i); lia|].
      intros j _. unfold spot. destruct (corner j) as [a b]. apply le_INR in a, b. rewrite S_INR in b.
      replace (_ - _) with (2 * ((INR (q j) - INR (p j)) * / INR k)) by (field; lra). assert (0 < / INR k) by (apply Rinv_0_lt_compat, K).
      rewrite Rabs_pos_eq; nra. }
    destruct (all (spot k p)) as (i & hi & sign); [apply of_cell; intros j; lia|].
    destruct (both i true hi) as (q & cq & eq). destruct (both i false hi) as (r & cr & er).
    destruct (of_cell q cq) as [q_in q_close]. destruct (of_cell r cr) as [r_in r_close].
    assert (at_q : 0 <= f i (spot k q)).
    { unfold s in eq. destruct (Nat.eqb_spec (q i) 0); [discriminate|]. destruct (Nat.eqb_spec (q i) k) as [e|_].
      - apply high; [exact hi|exact q_in|]. unfold spot. rewrite e. field. lra.
      - destruct (Rlt_dec 0 (f i (spot k q))); [lra|discriminate]. }
    assert (at_r : f i (spot k r) <= 0).
    { unfold s in er. destruct (Nat.eqb_spec (r i) 0) as [e|_].
      - apply low; [exact hi|exact r_in|]. unfold spot. rewrite e. cbn. field. lra.
      - destruct (Nat.eqb_spec (r i) k); [discriminate|]. destruct (Rlt_dec 0 (f i (spot k r))); [discriminate|lra]. }
    destruct sign as [h|h]; [specialize (h _ r_in r_close)|specialize (h _ q_in q_close)]; lra.
Qed.
