(* Periodic sequences of words: h-sets in a ring, each of which is carried across the next, have a periodic orbit through them.

   The unknowns are the coordinates of all states of the orbit, each in its slice; the equations say that each state is the image of
   the one before. That of a coordinate along is of opposite signs at the two ends of the slice, that of one across at the two edges:
   the theorem of Poincaré and Miranda. *)
From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Horseshoe Covers Miranda.
Open Scope R_scope.

(* Continuous functions on the cube. *)
Lemma cube_linear n f h p q r : continuous_at_cube n f -> continuous_at_cube n h -> continuous_at_cube n (fun x => p * f x + q * h x + r).
Proof.
  intros hf hh x hx eps pos. set (size := Rabs p + Rabs q + 1). assert (p0 := Rabs_pos p). assert (q0 := Rabs_pos q).
  assert (e : 0 < eps / size) by (apply Rdiv_lt_0_compat; unfold size; lra).
  destruct (hf x hx _ e) as (a & a0 & near_f). destruct (hh x hx _ e) as (b & b0 & near_h). exists (Rmin a b). split; [apply Rmin_glb_lt; assumption|].
  intros y hy near. assert (l := Rmin_l a b). assert (l' := Rmin_r a b).
  specialize (near_f y hy ltac:(intros j hj; specialize (near j hj); lra)). specialize (near_h y hy ltac:(intros j hj; specialize (near j hj); lra)).
  replace (_ - _) with (p * (f y - f x) + q * (h y - h x)) by ring. apply Rle_lt_trans with (1 := Rabs_triang _ _). rewrite !Rabs_mult.
  assert (eps / size * size = eps) by (field; unfold size; lra). unfold size in *. nra.
Qed.
Lemma cube_coordinate n i : (i < n)%nat -> continuous_at_cube n (fun x => x i).
Proof. intros hi x _ eps pos. exists eps. split; [exact pos|]. intros y _ near. exact (near i hi). Qed.
(* Of two coordinates. *)
Definition square (u : R * R) : Prop := -1 <= fst u <= 1 /\ -1 <= snd u <= 1.
Lemma cube_two n i j (w : R * R -> R) : (i < n)%nat -> (j < n)%nat -> continuous_on square w -> continuous_at_cube n (fun x => w (x i, x j)).
Proof.
  intros hi hj h x hx eps pos. rewrite on_balls in h. destruct (h (x i, x j) (conj (hx i hi) (hx j hj)) (mkposreal eps pos)) as [del near].
  exists del. split; [apply cond_pos|]. intros y hy b. apply (near (y i, y j)); [exact (conj (b i hi) (b j hj))|exact (conj (hy i hi) (hy j hj))].
Qed.
(* A point of a slice, by two coordinates that run from -1 to 1. *)
Definition height (a b t : R) : R := (a + b) / 2 + (b - a) / 2 * t.
Definition point_of (N : frame) (a b : R) (u : R * R) : state := put N (height a b (fst u)) (snd u).
Lemma point_continuous N a b : continuous_on square (point_of N a b).
Proof.
  assert (line : forall c p q, continuous_on square (fun u : R * R => c + p * height a b (fst u) + q * snd u)).
  { intros c p q. apply continuous_on_forall. intros u _.
    apply (continuous_ext (fun u : R * R => p * ((b - a) / 2) * fst u + q * snd u + (c + p * ((a + b) / 2)))); [|apply linear_continuous].
    intros v. unfold height. match goal with |- ?l = ?r => change (@eq R l r) end. ring. }
  unfold point_of, put. apply on_pair; apply line.
Qed.
Lemma height_between a b t : a <= b -> -1 <= t <= 1 -> a <= height a b t <= b.
Proof. intros o h. unfold height. nra. Qed.

Section Ring.
Variable m : nat.
Variables (N : nat -> frame) (a b sign : nat -> R) (g : nat -> state -> state).
Hypothesis some : (0 < m)%nat.
Hypothesis closed_ring : N m = N 0%nat.
Hypothesis areas : forall i, (i < m)%nat -> area (N i) <> 0.
Hypothesis covered : forall i, (i < m)%nat -> covers (N i) (N (S i)) (a i) (b i) (sign i) (g i).

(* The states, by 2 m coordinates: those along first, then those across. *)
Let xi (i : nat) (x : nat -> R) : R := height (a i) (b i) (x i).
Let at_ (i : nat) (x : nat -> R) : state := point_of (N i) (a i) (b i) (x i, x (m + i)%nat).
Let after (i : nat) : nat := if Nat.eqb (S i) m then O else S i.
Let before (i : nat) : nat := match i with O => Nat.pred m | S i => i end.
(* The residuals of the equations. *)
Let miss (i : nat) (x : nat -> R) : R :=
  if Nat.ltb i m then sign i * along (N (S i)) (g i (at_ i x)) + - sign i * xi (after i) x
  else let j := before (i - m) in x i - across (N (S j)) (g j (at_ j x)).

Lemma after_inside i : (i < m)%nat -> (after i < m)%nat /\ N (after i) = N (S i).
Proof. intros h. unfold after. destruct (Nat.eqb_spec (S i) m) as [e|n]; [|split; [lia|reflexivity]].
  rewrite e, closed_ring. split; [exact some|reflexivity]. Qed.
Lemma before_after i : (i < m)%nat -> before (after i) = i.
Proof. intros h. unfold after. destruct (Nat.eqb_spec (S i) m) as [e|n]; cbn; lia. Qed.
Lemma before_inside i : (i < m)%nat -> (before i < m)%nat.
Proof. intros h. destruct i; cbn; lia. Qed.
Lemma xi_inside i x : (i < m)%nat -> cube (m + m) x -> a i <= xi i x <= b i.
Proof. intros h hx. destruct (covered i h). apply height_between; [lra|apply hx; lia]. Qed.
Lemma at_along i x : (i < m)%nat -> along (N i) (at_ i x) = xi i x.
Proof. intros h. apply put_along, areas, h. Qed.
Lemma at_across i x : (i < m)%nat -> across (N i) (at_ i x) = x (m + i)%nat.
Proof. intros h. apply put_across, areas, h. Qed.
Lemma at_slice i x : (i < m)%nat -> cube (m + m) x -> slice (N i) (a i) (b i) (at_ i x).
Proof. intros h hx. split; [rewrite at_along by exact h; apply xi_inside; assumption|rewrite at_across by exact h; apply hx; lia]. Qed.

Lemma image_continuous i (along_or_across : state -> R) : (i < m)%nat -> (forall y, continuous along_or_across y) ->
  continuous_at_cube (m + m) (fun x => along_or_across (g i (at_ i x))).
Proof.
  intros h cont. apply (cube_two (m + m) i (m + i) (fun u => along_or_across (g i (point_of (N i) (a i) (b i) u)))); [lia|lia|].
  apply (on_comp square (slice (N i) (a i) (b i)) (point_of (N i) (a i) (b i)) (fun y => along_or_across (g i y))); [apply point_continuous| |].
  - apply (on_comp _ (fun _ => True) (g i) along_or_across);
      [apply (covers_continuous _ _ _ _ _ _ (covered i h))|apply continuous_on_forall; intros y _; apply cont|auto].
  - intros u [h1 h2]. destruct (covered i h). unfold point_of, slice. rewrite put_along, put_across by (apply areas, h). split; [|exact h2].
    apply height_between; [lra|exact h1].
Qed.
Lemma miss_continuous i : (i < m + m)%nat -> continuous_at_cube (m + m) (miss i).
Proof.
  intros h x hx eps pos. unfold miss. destruct (Nat.ltb_spec i m) as [l|l].
  - destruct (after_inside i l) as [la _]. set (j := after i) in *.
    assert (c := cube_linear (m + m) _ _ (sign i) (- sign i * ((b j - a j) / 2)) (- sign i * ((a j + b j) / 2))
      (image_continuous i _ l (along_continuous (N (S i)))) (cube_coordinate (m + m) j ltac:(lia))).
    destruct (c x hx eps pos) as (del & del0 & near). exists del. split; [exact del0|]. intros y hy close. specialize (near y hy close). cbn beta in near.
    unfold xi, height. match type of near with Rabs ?e < _ => match goal with |- Rabs ?e' < _ => replace e' with e by ring end end. exact near.
  - cbn zeta. assert (lj := before_inside (i - m) ltac:(lia)). set (j := before (i - m)) in *.
    assert (c := cube_linear (m + m) _ _ (-1) 1 0 (image_continuous j _ lj (across_continuous (N (S j)))) (cube_coordinate (m + m) i h)).
    destruct (c x hx eps pos) as (del & del0 & near). exists del. split; [exact del0|]. intros y hy close. specialize (near y hy close). cbn beta in near.
    match type of near with Rabs ?e < _ => match goal with |- Rabs ?e' < _ => replace e' with e by ring end end. exact near.
Qed.
Lemma miss_side i x t : (i < m + m)%nat -> cube (m + m) x -> x i = t -> t = -1 \/ t = 1 -> 0 <= t * miss i x.
Proof.
  intros h hx e side. unfold miss. destruct (Nat.ltb_spec i m) as [l|l].
  - destruct (after_inside i l) as [la _]. assert (s := at_slice i x l hx). assert (o := xi_inside _ x la hx).
    destruct (covered _ la) as [a1 _ b1 _ _ _ _ _]. destruct (covered i l) as [_ _ _ sg _ _ start stop].
    assert (al := at_along i x l). unfold xi at 1, height in al. rewrite e in al.
    destruct side as [->| ->]; [specialize (start _ s ltac:(lra))|specialize (stop _ s ltac:(lra))]; destruct sg as [k|k]; rewrite k in *; lra.
  - cbn zeta. assert (lj := before_inside (i - m) ltac:(lia)). set (j := before (i - m)) in *.
    assert (flat := covers_flat _ _ _ _ _ _ (covered j lj) _ (at_slice j x lj hx)). rewrite e. destruct side as [->| ->]; lra.
Qed.
Lemma miss_nothing x i : (i < m)%nat -> cube (m + m) x -> miss i x = 0 -> miss (m + after i) x = 0 -> g i (at_ i x) = at_ (after i) x.
Proof.
  intros l hx along0 across0. destruct (after_inside i l) as [la same]. unfold miss in *.
  destruct (Nat.ltb_spec i m) as [_|]; [|lia]. destruct (Nat.ltb_spec (m + after i) m) as [|_]; [lia|].
  replace (m + after i - m)%nat with (after i) in across0 by lia. cbn zeta in across0. rewrite (before_after i l) in across0.
  rewrite <- same in *. set (y := g i (at_ i x)) in *.
  assert (e : along (N (after i)) y = xi (after i) x) by (destruct (covers_sign _ _ _ _ _ _ (covered i l)) as [s|s]; rewrite s in along0; lra).
  assert (e' : across (N (after i)) y = x (m + after i)%nat) by lra.
  rewrite <- (put_back (N (after i)) y), e, e' by (apply areas, la). reflexivity.
Qed.

(* There is a state that follows the words 0, ..., m - 1, and comes back. *)
Theorem closing : exists x, visit g m x = x /\ (forall i, (i < m)%nat -> slice (N i) (a i) (b i) (visit g i x)) /\
  forall i, (i <= m)%nat -> in_frame (N i) (visit g i x).
Proof.
  destruct (poincare_miranda (m + m) miss) as (x & hx & zero).
  - exact miss_continuous.
  - intros i x h hx e. assert (s := miss_side i x (-1) h hx e ltac:(lra)). lra.
  - intros i x h hx e. assert (s := miss_side i x 1 h hx e ltac:(lra)). lra.
  - assert (step : forall i, (i < m)%nat -> g i (at_ i x) = at_ (after i) x).
    { intros i h. destruct (after_inside i h). apply miss_nothing; [exact h|exact hx|apply zero; lia|apply zero; lia]. }
    assert (orbit : forall i, (i < m)%nat -> visit g i (at_ 0 x) = at_ i x).
    { induction i as [|i IH]; intros h; [reflexivity|]. cbn [visit]. rewrite IH, step by lia. f_equal. unfold after. destruct (Nat.eqb_spec (S i) m); lia. }
    assert (back : visit g m (at_ 0 x) = at_ 0 x).
    { replace (visit g m (at_ 0 x)) with (visit g (S (Nat.pred m)) (at_ 0 x)) by (f_equal; lia). cbn [visit]. rewrite orbit, step by lia.
      f_equal. unfold after. destruct (Nat.eqb_spec (S (Nat.pred m)) m); lia. }
    assert (parts : forall i, (i < m)%nat -> slice (N i) (a i) (b i) (visit g i (at_ 0 x))).
    { intros i h. rewrite orbit by exact h. apply at_slice; assumption. }
    assert (whole : forall i, (i < m)%nat -> in_frame (N i) (visit g i (at_ 0 x))).
    { intros i h. destruct (parts i h) as [p q]. destruct (covered i h). split; [lra|exact q]. }
    exists (at_ 0 x). split; [exact back|]. split; [exact parts|]. intros i h. destruct (Nat.eq_dec i m) as [->|n]; [|apply whole; lia].
    rewrite closed_ring, back. exact (whole O some).
Qed.
End Ring.

(* For ever: a sequence of words with the period m has an orbit with this period. *)
Corollary periodic (m : nat) (N : nat -> frame) (a b sign : nat -> R) (g : nat -> state -> state) : (0 < m)%nat ->
  (forall i, N (i + m)%nat = N i) -> (forall i, a (i + m)%nat = a i) -> (forall i, b (i + m)%nat = b i) -> (forall i, g (i + m)%nat = g i) ->
  (forall i, (i < m)%nat -> area (N i) <> 0) -> (forall i, (i < m)%nat -> covers (N i) (N (S i)) (a i) (b i) (sign i) (g i)) ->
  exists x, forall i, slice (N i) (a i) (b i) (visit g i x) /\ in_frame (N i) (visit g i x) /\ visit g (i + m) x = visit g i x.
Proof.
  intros some eN ea eb eg areas covered. destruct (closing m N a b sign g some (eN 0%nat) areas covered) as (x & back & parts & whole). exists x.
  assert (again : forall i, visit g (i + m) x = visit g i x) by (induction i as [|i IH]; [exact back|cbn; rewrite IH, eg; reflexivity]).
  intros i. induction i as [i IH] using (well_founded_induction Wf_nat.lt_wf). destruct (Nat.lt_ge_cases i m) as [l|l].
  - split; [exact (parts i l)|]. split; [apply whole; lia|apply again].
  - destruct (IH (i - m)%nat ltac:(lia)) as (s & t & _). replace i with (i - m + m)%nat by lia. rewrite !again, eN, ea, eb. repeat split; try apply s; apply t.
Qed.
