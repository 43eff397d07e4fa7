(* Lemma B1 from Flocq's model of IEEE 754: binary64, rounded to nearest even, with subnormal numbers, without overflow. *)
From Coq Require Import Reals Lra Lia ZArith.
From Flocq Require Import Core Plus_error Relative.
Open Scope R_scope.

Notation bin := (FLT_exp (-1074) 53).
Global Instance positive : Prec_gt_0 53. Proof. unfold Prec_gt_0. lia. Qed.
Definition double := generic_format radix2 bin.
Definition rnd := round radix2 bin ZnearestE.

Definition u := / 9007199254740992.
Definition eta := bpow radix2 (-1075).
Definition tiny := bpow radix2 (-1022).
Definition smallest := bpow radix2 (-1074).
(* `binade` of ball.rs. *)
Definition binade x := if Rlt_dec (Rabs x) tiny then 0 else bpow radix2 (mag radix2 x - 1).

(* What is used of a rounded operation: `fused` of any one, `added` of a sum of two doubles. *)
Definition fused x m := Rabs (m - x) <= u * binade m + eta /\ Rabs (m - x) <= u * Rabs m + eta /\ Rabs (m - x) <= u * Rabs x + eta.
(* A fused one, or a product, that does not underflow. *)
Definition normal x m := Rabs (m - x) <= u * binade m /\ Rabs (m - x) <= u * Rabs m /\ Rabs (m - x) <= u * Rabs x.
Definition added x m := Rabs (m - x) <= u * Rabs m /\ Rabs (m - x) <= u * Rabs x.

Lemma u_bpow : u = bpow radix2 (-53). Proof. reflexivity. Qed.
Lemma eta_positive : 0 < eta. Proof. apply bpow_gt_0. Qed.
Lemma tiny_eta : tiny = 9007199254740992 * eta.
Proof. unfold tiny, eta. change (-1022)%Z with (53 + -1075)%Z. rewrite bpow_plus. reflexivity. Qed.
Lemma smallest_eta : smallest = 2 * eta.
Proof. unfold smallest, eta. change (-1074)%Z with (1 + -1075)%Z. rewrite bpow_plus. reflexivity. Qed.
Lemma eta_small : eta <= / 2 ^ 900.
Proof.
  replace (/ 2 ^ 900) with (bpow radix2 (-900)). apply bpow_le; lia.
  change (bpow radix2 (- (900)) = / 2 ^ 900). rewrite bpow_opp. f_equal. rewrite (bpow_powerRZ radix2 900).
  change (powerRZ 2 (Z.of_nat 900) = 2 ^ 900). now rewrite <- pow_powerRZ.
Qed.

Lemma rnd_double x : double (rnd x). Proof. apply generic_format_round; typeclasses eauto. Qed.
Lemma rnd_le x y : x <= y -> rnd x <= rnd y. Proof. apply round_le; typeclasses eauto. Qed.
Lemma rnd_id x : double x -> rnd x = x. Proof. apply round_generic; typeclasses eauto. Qed.
Lemma rnd_0 : rnd 0 = 0. Proof. apply round_0; typeclasses eauto. Qed.
Lemma rnd_positive x : 0 <= x -> 0 <= rnd x. Proof. intros H. apply rnd_le in H. rewrite rnd_0 in H. exact H. Qed.
Lemma rnd_negative x : x <= 0 -> rnd x <= 0. Proof. intros H. apply rnd_le in H. rewrite rnd_0 in H. exact H. Qed.
Lemma double_power e : (-1074 <= e)%Z -> double (bpow radix2 e).
Proof. intros H. apply generic_format_bpow. unfold FLT_exp. lia. Qed.

Lemma half_ulp_normal m : tiny <= Rabs m -> / 2 * ulp radix2 bin m = u * binade m.
Proof.
  intros n. unfold binade. destruct (Rlt_dec (Rabs m) tiny) as [s|_]; [lra|].
  assert (z : m <> 0). { intros e. rewrite e, Rabs_R0 in n. generalize (bpow_gt_0 radix2 (-1022)). unfold tiny in n. lra. }
  rewrite ulp_neq_0 by exact z. unfold cexp, FLT_exp.
  assert (e : (-1021 <= mag radix2 m)%Z). { apply mag_ge_bpow. exact n. }
  rewrite Z.max_l by lia. rewrite u_bpow, <- bpow_plus. change (/ 2) with (bpow radix2 (-1)). rewrite <- bpow_plus. f_equal. ring.
Qed.
Lemma half_ulp m : / 2 * ulp radix2 bin m <= u * binade m + eta.
Proof.
  unfold binade. destruct (Rlt_dec (Rabs m) tiny) as [s|n].
  - rewrite ulp_FLT_small. 2: typeclasses eauto.
    2: apply Rlt_trans with (1 := s); apply bpow_lt; lia. unfold eta. change (-1074)%Z with (1 + -1075)%Z. rewrite bpow_plus.
    change (bpow radix2 1) with 2. lra.
  - assert (z : m <> 0). { intros e. apply n. rewrite e, Rabs_R0. apply bpow_gt_0. }
    rewrite ulp_neq_0 by exact z. unfold cexp, FLT_exp.
    assert (e : (-1021 <= mag radix2 m)%Z). { apply mag_ge_bpow. apply Rnot_lt_le. exact n. }
    rewrite Z.max_l by lia. rewrite u_bpow, <- bpow_plus. change (/ 2) with (bpow radix2 (-1)). rewrite <- bpow_plus.
    generalize eta_positive. replace (-1 + (mag radix2 m - 53))%Z with (-53 + (mag radix2 m - 1))%Z by ring. lra.
Qed.
Lemma binade_le m : 0 <= binade m <= Rabs m.
Proof.
  unfold binade. destruct (Rlt_dec (Rabs m) tiny) as [s|n]; [split; [lra|apply Rabs_pos]|]. split; [apply bpow_ge_0|].
  apply bpow_mag_le. intros e. apply n. rewrite e, Rabs_R0. apply bpow_gt_0.
Qed.
Theorem B1_binade x : Rabs (rnd x - x) <= u * binade (rnd x) + eta.
Proof. eapply Rle_trans; [apply error_le_half_ulp_round; typeclasses eauto|apply half_ulp]. Qed.
Theorem B1 x : fused x (rnd x).
Proof.
  split; [apply B1_binade|split].
  - eapply Rle_trans; [apply B1_binade|]. generalize (binade_le (rnd x)). unfold u. lra.
  - eapply Rle_trans; [apply error_le_half_ulp; typeclasses eauto|]. fold bin.
    eapply Rle_trans; [apply half_ulp|]. generalize (binade_le x). unfold u. lra.
Qed.
Theorem B1_normal x : tiny <= Rabs x -> normal x (rnd x).
Proof.
  intros H. assert (M : tiny <= Rabs (rnd x)) by (apply abs_round_ge_generic; try typeclasses eauto; [apply double_power; lia|exact H]).
  assert (E : Rabs (rnd x - x) <= u * binade (rnd x)).
  { rewrite <- half_ulp_normal by exact M. apply error_le_half_ulp_round; typeclasses eauto. }
  split; [exact E|split].
  - generalize (binade_le (rnd x)). unfold u in *. lra.
  - eapply Rle_trans; [apply error_le_half_ulp; typeclasses eauto|]. fold bin. rewrite half_ulp_normal by exact H.
    generalize (binade_le x). unfold u. lra.
Qed.
Theorem B1_sum x y : double x -> double y -> added (x + y) (rnd (x + y)).
Proof.
  intros X Y. assert (U : u_ro radix2 53 = u) by (unfold u_ro; rewrite u_bpow; change (-53)%Z with (-1 + (-53 + 1))%Z;
    rewrite (bpow_plus _ (-1)); reflexivity).
  assert (P : 0 < u) by (unfold u; lra). split.
  - destruct (@FLT_plus_error_N_round_ex radix2 (-1074) 53 _ (fun z => negb (Z.even z)) x y X Y) as (e & H & E).
    rewrite U in H. fold rnd in E. change (round radix2 bin ZnearestE (x + y)) with (rnd (x + y)) in E. rewrite E at 2.
    replace (rnd (x + y) - rnd (x + y) * (1 + e)) with (- (e * rnd (x + y))) by ring. rewrite Rabs_Ropp, Rabs_mult.
    apply Rmult_le_compat_r; [apply Rabs_pos|exact H].
  - destruct (@FLT_plus_error_N_ex radix2 (-1074) 53 _ (fun z => negb (Z.even z)) x y X Y) as (e & H & E).
    change (round radix2 bin ZnearestE (x + y)) with (rnd (x + y)) in E. rewrite E.
    replace ((x + y) * (1 + e) - (x + y)) with (e * (x + y)) by ring. rewrite Rabs_mult.
    apply Rmult_le_compat_r; [apply Rabs_pos|]. apply Rle_trans with (1 := H). rewrite U.
    apply Rmult_le_reg_r with (1 + u); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. nra.
Qed.
