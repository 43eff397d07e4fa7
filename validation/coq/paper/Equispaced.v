(* Existence, for all time, of the equally spaced orbit with two impacts per N cycles, N odd, (64)-(67), when
   (1+e) cos th0 > 1-e: with v and d of (66), (67) every listed impact is the first contact after the one before.
   Then figure 12 as meant: A = 1, W = pi, e = 1/2, N = 1, th0 = 0 give v = -4 pi and d = 3 pi. *)
From Coq Require Import Reals Lra Lia List ZArith.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model Step.
Open Scope R_scope.
Import ListNotations.

Section Orbit.
Variable s : scene.
Variables (t0 : R) (n : nat).
Let N := (2 * n + 1)%nat.
Let th0 := phase s t0.
(* (66) *)
Definition speed_66 : R := - (2 * A s * W s / (1 - e s)) * cos th0.
Hypothesis one_harmonic : others s = [].
Hypothesis shaken : 0 < A s.
Hypothesis turning : 0 < W s.
Hypothesis restitution : 0 <= e s < 1.
Hypothesis eq67 : d s = 2 * A s * sin th0 - (1 + e s) * INR N * PI / (2 * W s) * speed_66.
Hypothesis gap : 0 < d s.
Hypothesis steep : (1 + e s) * cos th0 > 1 - e s.

(* Impact k: on the left wall when k is even, on the right one when it is odd, N half periods after impact k - 1. *)
Fixpoint wall_after (k : nat) : wall := match k with O => left | S k => opposite (wall_after k) end.
Definition orbit (k : nat) : impact :=
  {| wall_of := wall_after k; time := t0 + INR k * (INR N * PI / W s); velocity := - side (wall_after k) * speed_66 |}.

Lemma half_turns x m : sin (x + INR (2 * m + 1) * PI) = - sin x /\ cos (x + INR (2 * m + 1) * PI) = - cos x.
Proof.
  rewrite plus_INR, mult_INR. cbn [INR]. replace (x + ((1 + 1) * INR m + 1) * PI) with (x + 2 * INR m * PI + PI) by ring.
  rewrite neg_sin, neg_cos, sin_period, cos_period. split; reflexivity.
Qed.
Lemma side_square w : side w * side w = 1.
Proof. destruct w; cbn; ring. Qed.

(* On the wall w the phase is th0 or its opposite. *)
Lemma phase_orbit k : sin (phase s (time (orbit k))) = - side (wall_after k) * sin th0 /\
  cos (phase s (time (orbit k))) = - side (wall_after k) * cos th0.
Proof.
  induction k as [|k [a b]].
  - cbn [orbit time wall_after side INR]. replace (t0 + 0 * (INR N * PI / W s)) with t0 by ring. fold th0. split; ring.
  - replace (phase s (time (orbit (S k)))) with (phase s (time (orbit k)) + INR N * PI).
    2:{ unfold orbit, phase. cbn [time]. rewrite S_INR. field. lra. }
    unfold N. rewrite (proj1 (half_turns _ n)), (proj2 (half_turns _ n)), a, b. cbn [wall_after]. rewrite side_opposite. split; ring.
Qed.

Lemma N_positive : 0 < INR N.
Proof. apply lt_0_INR. unfold N. lia. Qed.

Theorem equispaced_for_ever k : next s (orbit k) (orbit (S k)).
Proof.
  destruct (phase_orbit k) as [sk ck]. destruct (phase_orbit (S k)) as [sk' ck'].
  assert (AW : 0 < A s * W s) by (apply Rmult_lt_0_compat; assumption).
  assert (np := N_positive). assert (pi := PI_RGT_0).
  set (l := rebound s (orbit k)). set (w := wall_after k) in *. set (c := speed_66) in *.
  assert (inward : forall t, 0 < - side w * free_velocity s l t).
  { intros t. rewrite one_velocity by exact one_harmonic. unfold l, orbit. cbn [rebound since speed time velocity]. fold (orbit k).
    change (t0 + INR k * (INR N * PI / W s)) with (time (orbit k)). rewrite ck. fold w. fold c.
    replace (- side w * (- A s * W s * cos (phase s t) + (- e s * (- side w * c) + A s * W s * (- side w * cos th0))))
      with (A s * W s * (side w * cos (phase s t)) - e s * c * (side w * side w) + A s * W s * cos th0 * (side w * side w)) by ring.
    rewrite side_square.
    replace (- e s * c) with (A s * W s * (2 * e s / (1 - e s) * cos th0)) by (unfold c, speed_66; field; lra).
    assert (q : 1 < (1 + e s) / (1 - e s) * cos th0).
    { apply (Rmult_lt_reg_l (1 - e s)); [lra|]. field_simplify; lra. }
    assert (bound := COS_bound (phase s t)).
    assert (big : -1 <= side w * cos (phase s t)) by (destruct w; cbn; lra).
    replace (A s * W s * (side w * cos (phase s t)) - e s * c * 1 + A s * W s * cos th0 * 1)
      with (A s * W s * (side w * cos (phase s t) + (1 + e s) / (1 - e s) * cos th0)).
    2:{ unfold c, speed_66. field. lra. }
    apply Rmult_lt_0_compat; lra. }
  assert (rises : forall a b, a < b -> - side w * free_position s l a < - side w * free_position s l b).
  { intros a b h. apply (increasing (fun t => - side w * free_position s l t) (fun t => - side w * free_velocity s l t)); auto.
    intros x. apply (derivable_pt_lim_scal (free_position s l)). apply is_derive_Reals, position_derivative. }
  assert (begin : free_position s l (time (orbit k)) = side w * (d s / 2)) by apply (position_start s l).
  assert (arrive : free_position s l (time (orbit (S k))) = - side w * (d s / 2)).
  { rewrite one_position by exact one_harmonic. rewrite sk'. unfold l. cbn [rebound since speed place wall_of]. rewrite sk, ck. unfold plane.
    cbn [wall_after orbit velocity wall_of time]. fold w. rewrite side_opposite, S_INR. fold c.
    replace (t0 + (INR k + 1) * (INR N * PI / W s) - (t0 + INR k * (INR N * PI / W s))) with (INR N * PI / W s) by ring.
    rewrite eq67. unfold c, speed_66. field. lra. }
  assert (later : time (orbit k) < time (orbit (S k))).
  { unfold orbit. cbn [time]. rewrite S_INR. assert (0 < INR N * PI / W s) by (apply Rdiv_lt_0_compat; nra). lra. }
  split; [split; [exact later|split]|split].
  - fold l. rewrite arrive. destruct w; cbn; [rewrite Rabs_pos_eq|rewrite Rabs_left]; lra.
  - fold l. intros t [h h']. cbn [since l rebound] in h. apply rises in h. apply rises in h'. rewrite begin in h. rewrite arrive in h'.
    destruct w; cbn in *; apply Rabs_def1; lra.
  - fold l. rewrite arrive. unfold plane. cbn [orbit wall_of wall_after]. fold w. rewrite side_opposite. reflexivity.
  - fold l. rewrite one_velocity by exact one_harmonic. rewrite ck'. unfold l. cbn [rebound since speed]. rewrite ck.
    cbn [orbit velocity wall_after]. fold w. rewrite side_opposite. fold c. unfold c, speed_66. field. lra.
Qed.
End Orbit.

(* Figure 12 with its exact data; the printed d = 9.42497 and v = -12.56636 are roundings of these. *)
Definition figure_12_exact : scene := {| reference := {| A := 1; W := PI; tau := 0 |}; others := []; d := 3 * PI; e := 1 / 2 |}.
Definition figure_12_orbit (k : nat) : impact :=
  {| wall_of := wall_after k; time := INR k; velocity := side (wall_after k) * (4 * PI) |}.
Theorem figure_12_for_ever k : next figure_12_exact (figure_12_orbit k) (figure_12_orbit (S k)).
Proof.
  assert (pi := PI_RGT_0). assert (z : phase figure_12_exact 0 = 0) by (unfold phase; cbn; ring).
  assert (v : speed_66 figure_12_exact 0 = - (4 * PI)) by (unfold speed_66; rewrite z, cos_0; cbn; field).
  assert (same : forall m, orbit figure_12_exact 0 0 m = figure_12_orbit m).
  { intros m. unfold orbit, figure_12_orbit. rewrite v. cbn [W reference figure_12_exact Nat.mul Nat.add INR]. f_equal; field; lra. }
  rewrite <- !same. apply equispaced_for_ever; try rewrite z; try rewrite v; rewrite ?sin_0, ?cos_0; cbn; try lra; [reflexivity|]. field. lra.
Qed.
(* It is periodic: so the hypotheses of TwoImpact.v can be met. *)
Theorem figure_12_periodic : next figure_12_exact (figure_12_orbit 0) (figure_12_orbit 1) /\
  next figure_12_exact (figure_12_orbit 1)
    {| wall_of := left; time := time (figure_12_orbit 0) + INR 1 * period figure_12_exact; velocity := velocity (figure_12_orbit 0) |}.
Proof.
  split; [apply figure_12_for_ever|]. replace {| wall_of := left; time := _; velocity := _ |} with (figure_12_orbit 2); [apply figure_12_for_ever|].
  assert (pi := PI_RGT_0). unfold figure_12_orbit, period. cbn [wall_after opposite side time velocity W reference figure_12_exact INR]. f_equal; field; lra.
Qed.
