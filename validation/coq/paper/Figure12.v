(* Figure 12 with the data the paper prints, d = 9.42497 and v = -12.56636: its orbit is not on the periodic one, but it
   never leaves its neighbourhood. Every start on the left wall with |W t| <= 2^-7 and |v/(A W) + 4| <= 2^-7, the paper's
   among them, follows P2 P1 for ever: its n-th impact pair comes within 2^-7 of phase 2 pi n and of v = -4 A W again.
   Proof: the box goes into itself, shifted by a period, after two flights (Step.v, checked by Certificate.v). *)
From Coq Require Import Reals Lra Lia List ZArith QArith Qreals.
From Coquelicot Require Import Rcomplements.
From ImpactPair Require Import Model Step Certificate.
Open Scope R_scope.
Import ListNotations.

Definition figure_12 : scene := {| reference := {| A := 1; W := PI; tau := 0 |}; others := []; d := 9.42497; e := 0.5 |}.
Definition figure_12_data : data := {| leading := {| amplitude := Exactly (Rational 1); frequency := Exactly Pi; shift := Exactly (Rational 0) |}; further := [];
  gap := Exactly (Rational 9.42497); restitution := Exactly (Rational 0.5) |}%Q.
Lemma described : describes figure_12_data figure_12.
Proof. unfold describes, describes_harmonic, among, figure_12_data, Exactly, Q2R. cbn. repeat split; try exact (Forall2_nil _); lra. Qed.

Definition near (i : impact) (cycle : nat) : Prop := wall_of i = left /\
  Rabs (phase figure_12 (time i) - INR cycle * (2 * PI)) <= / 2 ^ 7 /\ Rabs (unit_speed figure_12 (velocity i) + 4) <= / 2 ^ 7.

(* The boxes in units of 2^-20: 2^-7 is 8192, -4 is -4194304; and the walls, with bounds that say nothing more. *)
Definition before : Plain.box := Plain.landing 60 (Plain.enclose_range 60 (restitution figure_12_data)) left 20 0 8192 (-4194304) 8192.
Definition to_right : leg := Leg 60 40 20 right 3294199 7700 4194304 4600 1647099 1647099 0.
Definition to_left : leg := Leg 60 40 20 left 6588397 6500 (-4194304) 2800 4941298 4941298 0.
Definition anywhere (w : wall) : bounds := Impact w (-99) 99 (-99) 99.
Lemma P2_checked : Plain.check_leg figure_12_data before to_right (anywhere right) = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
Lemma P1_checked : Plain.check_leg figure_12_data
  (Plain.landing 60 (Plain.enclose_range 60 (restitution figure_12_data)) right 20 3294199 7700 4194304 4600) to_left (anywhere left) = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
Lemma pi_bounds : 3.141 < PI < 3.142.
Proof.
  assert (h : forall q, Plain.holds (Plain.enclose 60 (Minus Pi (Rational q))) (PI - Q2R q)) by (intros q; apply (Plain.holds_enclose 60)).
  assert (k : forall q, Plain.holds (Plain.enclose 60 (Minus (Rational q) Pi)) (Q2R q - PI)) by (intros q; apply (Plain.holds_enclose 60)).
  assert (a := Plain.is_positive_sound _ _ ltac:(vm_cast_no_check (eq_refl true)) (h 3.141%Q)).
  assert (b := Plain.is_positive_sound _ _ ltac:(vm_cast_no_check (eq_refl true)) (k 3.142%Q)).
  unfold Q2R in a, b. cbn in a, b. lra.
Qed.

Lemma A_positive : 0 < A figure_12. Proof. cbn. lra. Qed.
Lemma W_positive : 0 < W figure_12. Proof. exact PI_RGT_0. Qed.

(* After an impact in a box the launch is in the box of launches. *)
Lemma launched_after i w t rt v rv : wall_of i = w -> (0 <= rt)%Z -> (0 <= rv)%Z ->
  grid 20 (t - rt) <= phase figure_12 (time i) <= grid 20 (t + rt) ->
  grid 20 (v - rv) <= unit_speed figure_12 (velocity i) <= grid 20 (v + rv) ->
  Plain.launched figure_12 (Plain.landing 60 (Plain.enclose_range 60 (restitution figure_12_data)) w 20 t rt v rv) (rebound figure_12 i).
Proof.
  intros <- rt0 rv0 r1 r2. exists (grid 20 t), (- e figure_12 * grid 20 v).
  assert (E := Plain.holds_range 60 _ _ (proj2 (proj2 (proj2 described)))).
  assert (h := Plain.landing_in 60 _ (wall_of i) _ _ _ _ _ (d figure_12 / A figure_12) _ _ _ rt0 rv0 E r1 r2).
  assert (a := A_positive). assert (w := W_positive). cbn [rebound place since speed].
  replace (plane figure_12 (wall_of i) / A figure_12) with (side (wall_of i) * (d figure_12 / A figure_12 / 2)) by (unfold plane; field; lra).
  replace (unit_speed figure_12 (- e figure_12 * velocity i)) with (- e figure_12 * unit_speed figure_12 (velocity i)) by (unfold unit_speed; field; lra).
  exact h.
Qed.

Lemma grid_20 n : grid 20 n = IZR n / 1048576.
Proof. unfold grid. change (2 ^ 20)%Z with 1048576%Z. field. Qed.
Ltac units_of h := rewrite !grid_20 in h; repeat match type of h with context [IZR ?z] =>
  let n := eval vm_compute in z in progress change (IZR z) with (IZR n) in h end.
Lemma first_cycle i : near i 0 -> exists j k, wall_of j = right /\ next figure_12 i j /\ next figure_12 j k /\ near k 1.
Proof.
  intros (w & p & q). apply Rabs_le_between in p. apply Rabs_le_between in q. cbn [INR] in p.
  assert (r1 : grid 20 (0 - 8192) <= phase figure_12 (time i) <= grid 20 (0 + 8192)) by (rewrite !grid_20; cbn in *; lra).
  assert (r2 : grid 20 (-4194304 - 8192) <= unit_speed figure_12 (velocity i) <= grid 20 (-4194304 + 8192)) by (rewrite !grid_20; cbn in *; lra).
  assert (l := launched_after i left 0 8192 (-4194304) 8192 w ltac:(lia) ltac:(lia) r1 r2).
  destruct (Plain.leg_sound figure_12_data figure_12 described A_positive W_positive _ to_right _ _ l P2_checked) as (j & n & _ & wj & s1 & s2 & _).
  assert (l' := launched_after j right 3294199 7700 4194304 4600 wj ltac:(lia) ltac:(lia) s1 s2).
  destruct (Plain.leg_sound figure_12_data figure_12 described A_positive W_positive _ to_left _ _ l' P1_checked) as (k & n' & _ & wk & u1 & u2 & _).
  exists j, k. split; [exact wj|]. split; [exact n|]. split; [exact n'|]. split; [exact wk|].
  assert (pi := pi_bounds). units_of u1. units_of u2. cbn [INR].
  split; apply Rabs_le_between; lra.
Qed.

Lemma cycle i n : near i n -> exists j k, wall_of j = right /\ next figure_12 i j /\ next figure_12 j k /\ near k (S n).
Proof.
  assert (w0 := W_positive). assert (turning : W figure_12 <> 0) by lra.
  revert i. induction n as [|n IH]; intros i h; [exact (first_cycle i h)|].
  set (i0 := {| wall_of := wall_of i; time := time i - period figure_12; velocity := velocity i |}).
  assert (one : forall t, phase figure_12 (t + period figure_12) = phase figure_12 t + 2 * PI) by (intros t; apply phase_later, turning).
  assert (back : later (period figure_12) i0 = i).
  { destruct i. unfold later, i0. cbn. f_equal. ring. }
  destruct (IH i0) as (j & k & wj & n1 & n2 & nk).
  { destruct h as (w & p & q). split; [exact w|]. split; [|exact q]. rewrite S_INR in p.
    replace (phase figure_12 (time i0) - INR n * (2 * PI)) with (phase figure_12 (time i) - (INR n + 1) * (2 * PI)); [exact p|].
    rewrite <- back. cbn [later time]. rewrite one. ring. }
  exists (later (period figure_12) j), (later (period figure_12) k). split; [exact wj|].
  assert (whole := period_recurs figure_12 eq_refl turning). apply (next_later _ _ whole) in n1. apply (next_later _ _ whole) in n2. rewrite back in n1.
  split; [exact n1|]. split; [exact n2|]. destruct nk as (w & p & q). split; [exact w|]. split; [|exact q].
  cbn [later time]. rewrite one, (S_INR (S n)).
  replace (phase figure_12 (time k) + 2 * PI - (INR (S n) + 1) * (2 * PI)) with (phase figure_12 (time k) - INR (S n) * (2 * PI)) by ring. exact p.
Qed.

(* right, left, right, left ... *)
Fixpoint alternate (cycles : nat) : list wall := match cycles with O => [] | S n => right :: left :: alternate n end.

Theorem figure_12_trapped i : near i 0 -> forall cycles, exists orbit last,
  follows figure_12 (rebound figure_12 i) (orbit ++ [last]) /\ map wall_of (orbit ++ [last]) = alternate (S cycles) /\ near last (S cycles) /\
  forall other, follows figure_12 (rebound figure_12 i) other -> length other = length (orbit ++ [last]) -> other = orbit ++ [last].
Proof.
  intros h cycles.
  assert (steps : forall m n i, near i n -> exists orbit last,
    follows figure_12 (rebound figure_12 i) (orbit ++ [last]) /\ map wall_of (orbit ++ [last]) = alternate (S m) /\ near last (S m + n)).
  { induction m as [|m IH]; intros n i' h'; destruct (cycle i' n h') as (j & k & wj & n1 & n2 & nk).
    - exists [j], k. cbn [app follows map alternate]. rewrite wj, (proj1 nk). split; [split; [exact n1|split; [exact n2|exact I]]|split; [reflexivity|exact nk]].
    - destruct (IH (S n) k nk) as (orbit & last & f & walls & nl). exists (j :: k :: orbit), last. cbn [app follows map alternate].
      rewrite walls, wj, (proj1 nk). split; [split; [exact n1|split; [exact n2|exact f]]|]. split; [reflexivity|].
      replace (S (S m) + n)%nat with (S m + S n)%nat by lia. exact nl. }
  destruct (steps cycles 0%nat i h) as (orbit & last & f & walls & nl). rewrite Nat.add_0_r in nl.
  exists orbit, last. split; [exact f|]. split; [exact walls|]. split; [exact nl|].
  intros other f' len. refine (follows_unique figure_12 _ _ _ _ f' f len). cbn. lra.
Qed.

(* The paper's start is one of these. *)
Theorem paper_start_trapped : near {| wall_of := left; time := 0; velocity := -12.56636 |} 0.
Proof.
  assert (pi := pi_bounds). split; [reflexivity|]. unfold phase, unit_speed. cbn [time velocity reference figure_12 A W tau INR]. split.
  - replace (PI * 0 + 0 - 0 * (2 * PI)) with 0 by ring. rewrite Rabs_R0. lra.
  - assert (eq : forall x, x / (1 * PI) + 4 = (4 * PI + x) * / PI) by (intros x; field; lra). rewrite eq.
    rewrite Rabs_mult, (Rabs_pos_eq (/ PI)) by (left; apply Rinv_0_lt_compat; lra).
    assert (Rabs (4 * PI + -12.56636) <= 0.003) by (apply Rabs_le_between; lra).
    apply (Rmult_le_reg_r PI); [lra|]. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. lra.
Qed.
