(* Lemma B2: the operations of `Ball` (src/number/ball.rs), every operation of theirs rounded, with underflow.
   A template: validation/bounds/prove fills in what stands between @ signs, from the source text. *)
From Coq Require Import Reals Lra Lia ZArith.
From Flocq Require Import Core Plus_error.
Require Import rounding.
Open Scope R_scope.

Definition up radius := @UP@.
Definition add_mid A B := @ADD_MID@.
Definition add_rad A ra B rb := @ADD_RAD@.
Definition mul_mid A B := @MUL_MID@.
Definition mul_rad A ra B rb := @MUL_RAD@.
Definition div_least B rb := @DIV_LEAST@.
Definition div_mid A B := @DIV_MID@.
Definition div_rad A ra B rb := @DIV_RAD@.

Lemma split_abs x y : Rabs x <= y -> - y <= x <= y. Proof. unfold Rabs. destruct (Rcase_abs x); lra. Qed.
Lemma abs_product a b x y : Rabs a <= x -> Rabs b <= y -> - (x * y) <= a * b <= x * y.
Proof. intros X Y. apply split_abs. rewrite Rabs_mult. apply Rmult_le_compat; auto using Rabs_pos. Qed.

(* The lower side of a rounding that is not negative. *)
Lemma low x : 0 <= x -> x <= (1 + u) * rnd x + eta /\ 0 <= rnd x.
Proof.
  intros H. assert (P := rnd_positive x H).
  destruct (B1 x) as [_ [F _]]. rewrite (Rabs_pos_eq _ P) in F. apply split_abs in F. generalize eta_positive. unfold u in *. lra.
Qed.
Lemma low_sum x y : double x -> double y -> 0 <= x + y -> x + y <= (1 + u) * rnd (x + y) /\ 0 <= rnd (x + y).
Proof.
  intros X Y H. assert (P := rnd_positive (x + y) H).
  destruct (B1_sum x y X Y) as [F _]. rewrite (Rabs_pos_eq _ P) in F. apply split_abs in F. unfold u in *. lra.
Qed.

(* `up`: never less, and 6u more above the subnormal numbers. *)
Lemma up_le r : double r -> 0 <= r -> r <= up r.
Proof. intros D H. rewrite <- (rnd_id r D) at 1. unfold up. apply rnd_le. lra. Qed.
Lemma up_factor r : 0 <= r -> (1 + 6 * u) * r <= up r + eta.
Proof.
  intros H. unfold up. match goal with |- context [rnd ?y] => set (x := y) end. assert (X : 0 <= x) by (unfold x; lra).
  destruct (B1 x) as [_ [_ F]]. rewrite (Rabs_pos_eq _ X) in F. apply split_abs in F. unfold x, u in *. lra.
Qed.

Lemma half_of_a_sum x y : double x -> double y -> Rabs (rnd (x + y) - (x + y)) <= rnd (u * Rabs (rnd (x + y))).
Proof.
  intros X Y. assert (P : 0 <= rnd (u * Rabs (rnd (x + y)))) by (apply low; unfold u; generalize (Rabs_pos (rnd (x + y))); lra).
  destruct (Rle_lt_dec (Rabs (x + y)) (bpow radix2 (-1021))) as [s|l].
  - rewrite (rnd_id (x + y)) at 1. 2: { apply FLT_format_plus_small; [typeclasses eauto|exact X|exact Y|exact s]. }
    rewrite Rminus_diag_eq, Rabs_R0 by reflexivity. exact P.
  - set (m := rnd (x + y)) in *. assert (big : bpow radix2 (-1021) <= Rabs m).
    { unfold m, rnd. apply abs_round_ge_generic; try typeclasses eauto. apply (double_power (-1021)); lia. now apply Rlt_le. }
    assert (z : m <> 0). { intros e. rewrite e, Rabs_R0 in big. generalize (bpow_gt_0 radix2 (-1021)). lra. }
    assert (e : (-1020 <= mag radix2 m)%Z) by (apply mag_ge_bpow; exact big).
    apply Rle_trans with (bpow radix2 (-53 + (mag radix2 m - 1))).
    + eapply Rle_trans; [apply error_le_half_ulp_round; typeclasses eauto|]. fold rnd. fold m.
      rewrite ulp_neq_0 by exact z. unfold cexp, FLT_exp. rewrite Z.max_l by lia. change (/ 2) with (bpow radix2 (-1)).
        rewrite <- bpow_plus.
      apply bpow_le. lia.
    + rewrite <- (rnd_id (bpow radix2 _)). 2: apply double_power; lia. apply rnd_le. rewrite bpow_plus, <- u_bpow.
      apply Rmult_le_compat_l; [unfold u; lra|]. apply bpow_mag_le. exact z.
Qed.

Lemma up_of_a_sum x y t : double x -> double y -> double t -> 0 <= x -> 0 <= y -> 0 <= t -> x + y + t <= up (rnd (rnd (x + y) + t)).
Proof.
  intros X Y T x0 y0 t0. destruct (low_sum x y X Y) as [S s0]; [lra|]. set (s := rnd (x + y)) in *.
    assert (D : double s) by apply rnd_double.
  destruct (low_sum s t D T) as [R r0]; [lra|]. set (r := rnd (s + t)) in *.
  destruct (Rle_lt_dec tiny r) as [big|small].
  - assert (F := up_factor r r0). rewrite tiny_eta in big. generalize eta_positive. unfold u in *. lra.
  - assert (dt : double tiny) by (apply double_power; lia).
    assert (b1 : s + t < tiny) by (apply Rnot_le_lt; intros H; apply rnd_le in H; rewrite rnd_id in H by exact dt; unfold r in small; lra).
    assert (b2 : x + y < tiny) by (apply Rnot_le_lt; intros H; apply rnd_le in H; rewrite rnd_id in H by exact dt; unfold s in *; lra).
    assert (w : tiny <= bpow radix2 (53 + -1074)) by (apply bpow_le; lia).
    assert (e1 : s = x + y). { apply rnd_id. apply FLT_format_plus_small; auto. typeclasses eauto. rewrite Rabs_pos_eq; lra. }
    assert (e2 : r = s + t). { apply rnd_id. apply FLT_format_plus_small; auto. typeclasses eauto. rewrite Rabs_pos_eq; lra. }
    generalize (up_le r (rnd_double _) r0). lra.
Qed.

Section Balls.
Variables A ra B rb a b : R.
Hypotheses (DA : double A) (Dra : double ra) (DB : double B) (Drb : double rb) (ra0 : 0 <= ra) (rb0 : 0 <= rb).
Hypotheses (Ha : Rabs (a - A) <= ra) (Hb : Rabs (b - B) <= rb).

Theorem B2_add : Rabs (a + b - add_mid A B) <= add_rad A ra B rb.
Proof.
  unfold add_rad, add_mid. assert (H := half_of_a_sum A B DA DB). set (m := rnd (A + B)) in *.
  match goal with |- context [rnd (?k * Rabs m)] => change k with u || replace k with u by (unfold u; lra) end.
  set (t := rnd (u * Rabs m)) in *. assert (t0 : 0 <= t) by (generalize (Rabs_pos (m - (A + B))); lra).
  assert (U := up_of_a_sum ra rb t Dra Drb (rnd_double _) ra0 rb0 t0).
  apply split_abs in Ha, Hb, H. apply Rabs_le. lra.
Qed.

Ltac unit := repeat match goal with |- context [?k * Rabs ?m] =>
  lazymatch k with u => fail | _ => replace (k * Rabs m) with (u * Rabs m) by (unfold u; lra) end end.

Theorem B2_mul : Rabs (a * b - mul_mid A B) <= mul_rad A ra B rb.
Proof.
  unfold mul_rad, mul_mid. unit. destruct (B1 (A * B)) as [_ [M _]]. set (m := rnd (A * B)) in *.
  assert (P1 := abs_product (a - A) (b - B) _ _ Ha Hb). assert (P2 := abs_product A (b - B) _ _ (Rle_refl _) Hb).
  assert (P3 := abs_product (a - A) B _ _ Ha (Rle_refl _)).
  assert (A0 := Rabs_pos A). assert (B0 := Rabs_pos B). assert (m0 := Rabs_pos m). assert (e0 := eta_positive).
  destruct (low_sum (Rabs B) rb) as [L1 N1]; [apply generic_format_abs; exact DB|exact Drb|lra|]. set (w := rnd (Rabs B + rb)) in *.
  apply (Rmult_le_compat_l ra _ _ ra0) in L1.
  destruct (low (Rabs A * rb)) as [L2 N2]; [apply Rmult_le_pos; lra|]. set (p := rnd (Rabs A * rb)) in *.
  destruct (low (ra * w + p)) as [L3 N3]; [nra|]. set (s := rnd (ra * w + p)) in *.
  destruct (low (u * Rabs m)) as [L4 N4]; [unfold u; lra|]. set (v := rnd (u * Rabs m)) in *.
  destruct (low (s + v)) as [L5 N5]; [lra|]. set (x := rnd (s + v)) in *.
  destruct (low (x + tiny)) as [L6 N6]; [rewrite tiny_eta; lra|]. set (y := rnd (x + tiny)) in *.
  assert (U := up_factor y N6). rewrite tiny_eta in *. apply split_abs in M. apply Rabs_le. unfold u in *. lra.
Qed.

Theorem B2_div : tiny < div_least B rb -> b <> 0 /\ Rabs (a / b - div_mid A B) <= div_rad A ra B rb.
Proof.
  intros big. assert (e0 := eta_positive). assert (B0 := Rabs_pos B).
  assert (near : div_least B rb <= Rabs b).
  { assert (D : double (- rb)) by (apply generic_format_opp; exact Drb).
    destruct (B1_sum (Rabs B) (- rb)) as [_ F]; [apply generic_format_abs; exact DB|exact D|].
    change (Rabs B + - rb) with (Rabs B - rb) in F. revert big. unfold div_least. set (d := rnd (Rabs B - rb)) in *.
    match goal with |- context [rnd ?z] => set (y := z); destruct (B1 z) as [_ [_ G]]; fold y in G end.
    rewrite tiny_eta. intros big. assert (b1 : Rabs B - rb <= Rabs b).
    { assert (T := Rabs_triang b (B - b)). rewrite (Rabs_minus_sym B b) in T. replace (b + (B - b)) with B in T by ring. lra. }
    destruct (Rle_lt_dec y 0) as [n|n].
    - exfalso. rewrite (Rabs_left1 y) in G by lra. apply split_abs in G. unfold u in *. lra.
    - rewrite (Rabs_pos_eq y) in G by lra. apply split_abs in F, G.
      destruct (Rle_lt_dec (Rabs B - rb) 0) as [k|k]; [rewrite (Rabs_left1 _ k) in F|rewrite (Rabs_pos_eq (Rabs B - rb)) in F by lra];
        unfold y, u in *; lra. }
  set (L := div_least B rb) in *. assert (L0 : 0 < L) by (rewrite tiny_eta in big; lra).
  assert (b0 : b <> 0) by (intros e; rewrite e, Rabs_R0 in near; lra). split; [exact b0|].
  assert (B1' : B <> 0).
  { intros e. revert near L0. unfold L, div_least. rewrite e, Rabs_R0.
    assert (N := rnd_negative (0 - rb)). intros _ p.
    match type of p with 0 < rnd ?z => assert (rnd z <= 0) by (apply rnd_negative; lra) end. lra. }
  unfold div_rad. fold (div_least B rb). fold L. unfold div_mid. unit. destruct (B1 (A / B)) as [_ [M _]]. set (q := A / B) in *.
    set (m := rnd q) in *.
  assert (m0 := Rabs_pos m). assert (q0 := Rabs_pos q).
  assert (Q : Rabs q <= (1 + u) * Rabs m + eta) by (apply split_abs in M; unfold Rabs, u in *; destruct (Rcase_abs q), (Rcase_abs m); lra).
  destruct (low_sum (Rabs m) tiny) as [L1 N1]; [apply generic_format_abs, rnd_double|apply double_power; lia|rewrite tiny_eta; lra|].
  set (g := rnd (Rabs m + tiny)) in *. apply (Rmult_le_compat_l rb _ _ rb0) in L1. apply (Rmult_le_compat_l rb _ _ rb0) in Q.
  assert (rbe : 0 <= rb * eta) by (apply Rmult_le_pos; lra). assert (rbg : 0 <= rb * g) by (apply Rmult_le_pos; lra).
  destruct (low (rb * g + ra)) as [L2 N2]; [lra|]. set (n1 := rnd (rb * g + ra)) in *.
  destruct (low_sum n1 smallest) as [L3 N3]; [apply rnd_double|apply double_power; lia|rewrite smallest_eta; lra|].
  set (n := rnd (n1 + smallest)) in *. rewrite smallest_eta in L3.
  assert (Li : 0 < / L) by (apply Rinv_0_lt_compat; exact L0).
  destruct (low (n / L)) as [L4 N4]; [apply Rmult_le_pos; lra|]. set (sp := rnd (n / L)) in *.
  assert (U1 := up_factor sp N4). assert (up0 := up_le sp (rnd_double _) N4).
  destruct (low (u * Rabs m)) as [L5 N5]; [unfold u; lra|]. set (v := rnd (u * Rabs m)) in *.
  destruct (low (up sp + v)) as [L6 N6]; [lra|]. set (x := rnd (up sp + v)) in *.
  destruct (low (x + tiny)) as [L7 N7]; [rewrite tiny_eta; lra|]. set (y := rnd (x + tiny)) in *.
  assert (U := up_factor y N7).
  assert (T : ra + Rabs q * rb <= (1 + u) * (1 + u) * (1 + u) * (1 + u) * n) by (rewrite tiny_eta in *; unfold u in *; lra).
  assert (E : a / b - m = ((a - A) - q * (b - B)) / b - (m - q)) by (unfold q; field; auto).
  assert (S : Rabs (((a - A) - q * (b - B)) / b) <= (1 + u) * (1 + u) * (1 + u) * (1 + u) * (n / L)).
  { unfold Rdiv. rewrite Rabs_mult, Rabs_inv. apply Rle_trans with ((ra + Rabs q * rb) * / L).
    - apply Rmult_le_compat; [apply Rabs_pos|left; apply Rinv_0_lt_compat, Rabs_pos_lt; exact b0| |apply Rinv_le_contravar; assumption].
      assert (P := abs_product q (b - B) _ _ (Rle_refl _) Hb). apply split_abs in Ha. apply Rabs_le. lra.
    - rewrite <- Rmult_assoc. apply Rmult_le_compat_r; lra. }
  rewrite E. rewrite tiny_eta in *. apply split_abs in M, S. apply Rabs_le. unfold u in *. lra.
Qed.
End Balls.
