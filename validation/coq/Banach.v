(* Contractions of the unit disc: Banach's fixed point theorem. Points of the plane are Coquelicot's complex numbers, for their modulus. *)
From Coq Require Import Reals Lra Lia.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

Definition apart (x y : C) : R := Cmod (Cminus x y).

Lemma apart_triangle x y z : apart x z <= apart x y + apart y z.
Proof. unfold apart. replace (Cminus x z) with (Cplus (Cminus x y) (Cminus y z)) by (apply injective_projections; cbn; ring). apply Cmod_triangle. Qed.
Lemma apart_sym x y : apart x y = apart y x.
Proof. unfold apart. rewrite <- (Cmod_opp (Cminus x y)). f_equal. apply injective_projections; cbn; ring. Qed.
Lemma apart_0 x y : apart x y <= 0 -> x = y.
Proof.
  intros h. assert (z : Cminus x y = 0%C) by (apply Cmod_eq_0; assert (p := Cmod_ge_0 (Cminus x y)); unfold apart in h; lra).
  destruct x, y. injection z as z1 z2. f_equal; lra.
Qed.
Lemma modulus_at_most x : Cmod x <= Rabs (fst x) + Rabs (snd x).
Proof.
  assert (a := Rabs_pos (fst x)). assert (b := Rabs_pos (snd x)). rewrite <- (sqrt_Rsqr (Rabs (fst x) + Rabs (snd x))) by lra.
  unfold Cmod. apply sqrt_le_1_alt. rewrite <- (pow2_abs (fst x)), <- (pow2_abs (snd x)). unfold Rsqr. nra.
Qed.
Lemma modulus_at_least x : Rabs (fst x) <= Cmod x /\ Rabs (snd x) <= Cmod x.
Proof. assert (h := Rmax_Cmod x). split; [apply Rle_trans with (2 := h), Rmax_l|apply Rle_trans with (2 := h), Rmax_r]. Qed.
Lemma modulus_square x : Cmod x ^ 2 = fst x ^ 2 + snd x ^ 2.
Proof. unfold Cmod. rewrite pow2_sqrt; [reflexivity|]. assert (0 <= fst x ^ 2) by apply pow2_ge_0. assert (0 <= snd x ^ 2) by apply pow2_ge_0. lra. Qed.
Lemma modulus_below x r : 0 <= r -> fst x ^ 2 + snd x ^ 2 <= r ^ 2 -> Cmod x <= r.
Proof. intros h le. rewrite <- modulus_square in le. assert (p := Cmod_ge_0 x). nra. Qed.

Section Contraction.
Variables (f : C -> C) (g : R).
Hypothesis factor : 0 <= g < 1.
Hypothesis contracts : forall x y, Cmod x <= 1 -> Cmod y <= 1 -> apart (f x) (f y) <= g * apart x y.
Hypothesis middle : Cmod (f 0%C) <= 1 - g.

Lemma modulus_apart x : Cmod x = apart x 0%C.
Proof. unfold apart. f_equal. apply injective_projections; cbn; ring. Qed.
Lemma stays x : Cmod x <= 1 -> Cmod (f x) <= 1.
Proof.
  intros h. assert (z : Cmod 0%C <= 1) by (rewrite Cmod_0; lra). assert (c := contracts x 0%C h z). rewrite !modulus_apart in *.
  assert (t := apart_triangle (f x) (f 0%C) 0%C).
  assert (p := Cmod_ge_0 (f 0%C)). rewrite modulus_apart in p. nra.
Qed.
Lemma fixed_once x y : Cmod x <= 1 -> Cmod y <= 1 -> f x = x -> f y = y -> x = y.
Proof. intros hx hy ex ey. assert (c := contracts x y hx hy). rewrite ex, ey in c. apply apart_0. assert (p := Cmod_ge_0 (Cminus x y)). unfold apart in *. nra. Qed.
Lemma nearer x y n : Cmod x <= 1 -> Cmod y <= 1 -> f x = x -> Cmod (Nat.iter n f y) <= 1 /\ apart (Nat.iter n f y) x <= g ^ n * apart y x.
Proof.
  intros hx hy ex. induction n as [|n [inside IH]]; [split; [exact hy|cbn; rewrite Rmult_1_l; apply Rle_refl]|].
  change (Nat.iter (S n) f y) with (f (Nat.iter n f y)). cbn [pow].
  split; [exact (stays _ inside)|]. assert (c := contracts _ x inside hx). rewrite ex in c.
  apply Rle_trans with (1 := c). rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|exact IH].
Qed.

Let u (n : nat) : C := Nat.iter n f 0%C.
Lemma u_inside n : Cmod (u n) <= 1.
Proof. induction n as [|n IH]; [change (Cmod 0%C <= 1); rewrite Cmod_0; lra|exact (stays _ IH)]. Qed.
Lemma u_steps n : apart (u (S n)) (u n) <= 2 * g ^ n.
Proof.
  induction n as [|n IH].
  - change (u 0) with (RtoC 0). rewrite <- modulus_apart. assert (b := u_inside 1). cbn [pow]. lra.
  - assert (c := contracts (u (S n)) (u n) (u_inside _) (u_inside _)). change (f (u (S n))) with (u (S (S n))) in c. change (f (u n)) with (u (S n)) in c.
    cbn [pow]. nra.
Qed.
Lemma coordinate_converges (p : C -> R) : (forall x y, Rabs (p x - p y) <= apart x y) -> exists l : R, is_lim_seq (fun n => p (u (S n))) l.
Proof.
  intros short. set (a := fun n => p (u (S n)) - p (u n)).
  assert (ex : ex_series a).
  { apply (ex_series_le (K := R_AbsRing) (V := R_CompleteNormedModule) a (fun n => 2 * g ^ n)).
    - intros n. apply Rle_trans with (2 := u_steps n), short.
    - apply (ex_series_scal_l (K := R_AbsRing) 2 (fun n => g ^ n)). apply ex_series_geom. rewrite Rabs_pos_eq; lra. }
  destruct ex as [l h]. exists (l + p (u 0)). apply (is_lim_seq_ext (fun n => sum_n a n + p (u 0))).
  - intros n. induction n as [|n IH]; [rewrite sum_O; unfold a; ring|]. rewrite sum_Sn.
      change (plus (sum_n a n) (a (S n))) with (sum_n a n + (p (u (S (S n))) - p (u (S n)))). lra.
  - apply (is_lim_seq_plus' _ _ l (p (u 0))); [exact h|apply is_lim_seq_const].
Qed.

Theorem banach : exists x, Cmod x <= 1 /\ f x = x.
Proof.
  destruct (coordinate_converges (fun z : C => fst z)) as [a ha]; [intros x y; exact (proj1 (modulus_at_least (Cminus x y)))|].
  destruct (coordinate_converges (fun z : C => snd z)) as [b hb]; [intros x y; exact (proj2 (modulus_at_least (Cminus x y)))|].
  set (x := (a, b) : C).
  assert (near : forall eps : posreal, exists n, apart (u (S n)) x < eps /\ apart (u (S (S n))) x < eps).
  { intros eps. assert (e4 : 0 < eps / 2) by (assert (p := cond_pos eps); lra).
    apply is_lim_seq_spec in ha, hb. destruct (ha (mkposreal _ e4)) as [n hn]. destruct (hb (mkposreal _ e4)) as [m hm]. cbn [pos] in hn, hm.
    exists (n + m)%nat. assert (one : forall k, (n + m <= k)%nat -> apart (u (S k)) x < eps).
    { intros k hk. specialize (hn k ltac:(lia)). specialize (hm k ltac:(lia)). assert (t := modulus_at_most (Cminus (u (S k)) x)).
      unfold apart. change (fst (Cminus (u (S k)) x)) with (fst (u (S k)) - a) in t. change (snd (Cminus (u (S k)) x)) with (snd (u (S k)) - b) in t. lra. }
    split; apply one; lia. }
  assert (inside : Cmod x <= 1).
  { apply le_epsilon. intros eps eps0. destruct (near (mkposreal eps eps0)) as (n & h & _). cbn [pos] in h. assert (t := apart_triangle x (u (S n)) 0%C).
    rewrite (apart_sym x (u (S n))), <- !modulus_apart in t. assert (i := u_inside (S n)). lra. }
  exists x. split; [exact inside|]. apply apart_0. apply le_epsilon. intros eps eps0. assert (e2 : 0 < eps / 2) by lra.
  destruct (near (mkposreal _ e2)) as (n & h & h'). cbn [pos] in h, h'. assert (t := apart_triangle (f x) (u (S (S n))) x).
  assert (c := contracts x (u (S n)) inside (u_inside _)). change (f (u (S n))) with (u (S (S n))) in c. rewrite (apart_sym x) in c.
  assert (p : 0 <= apart (u (S n)) x) by apply Cmod_ge_0.
  assert (g * apart (u (S n)) x <= 1 * apart (u (S n)) x) by (apply Rmult_le_compat_r; lra). lra.
Qed.
End Contraction.

(* A matrix makes vectors shorter by g. *)
Lemma shortens a b c d g x y : 0 <= g -> 0 < g ^ 2 - (a ^ 2 + c ^ 2) ->
  0 <= (g ^ 2 - (a ^ 2 + c ^ 2)) * (g ^ 2 - (b ^ 2 + d ^ 2)) - (a * b + c * d) ^ 2 -> Cmod (a * x + b * y, c * x + d * y) <= g * Cmod (x, y).
Proof.
  intros g0 p1 p2. apply modulus_below; [assert (p := Cmod_ge_0 (x, y)); nra|]. rewrite Rpow_mult_distr, modulus_square. cbn [fst snd].
  set (A := g ^ 2 - (a ^ 2 + c ^ 2)) in *. set (B := a * b + c * d) in *. set (D := g ^ 2 - (b ^ 2 + d ^ 2)) in *.
  assert (form : 0 <= A * (A * x ^ 2 - 2 * B * x * y + D * y ^ 2)).
  { replace (A * _) with ((A * x - B * y) ^ 2 + (A * D - B ^ 2) * y ^ 2) by ring.
    assert (0 <= (A * x - B * y) ^ 2) by apply pow2_ge_0. assert (0 <= y ^ 2) by apply pow2_ge_0. nra. }
  assert (0 <= A * x ^ 2 - 2 * B * x * y + D * y ^ 2) by nra. unfold A, B, D in *. nra.
Qed.
