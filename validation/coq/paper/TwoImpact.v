(* Two impacts per N cycles (models I, eqs (54)-(71)): an impact on the left wall, the next on the right one, the next
   again on the left, N periods of the box after the first (56). What must then hold, from the model alone:
   (61) v_i = - v_{i+1}; (62) v_i = A W/(1-e) [cos th1 - cos th0]; for impacts equally spaced in time (64) and e < 1:
   N even is impossible, since (65) v = 0 also forces d = 0; N odd gives (66), (67) and (68); and for e = 1 (70), (71). *)
From Coq Require Import Reals Lra Lia List ZArith.
From ImpactPair Require Import Model Step.
Open Scope R_scope.
Import ListNotations.

Section TwoImpact.
Variable s : scene.
Hypothesis one_harmonic : others s = [].
Hypothesis shaken : 0 < A s.
Hypothesis turning : 0 < W s.
Hypothesis gap : 0 < d s.
Hypothesis bouncing : 0 <= e s.

(* A periodic orbit of the word P1 P2: impacts i (left), j (right), and i again after N periods (56). *)
Variables (i j : impact) (N : nat).
Definition again : impact := {| wall_of := left; time := time i + INR N * period s; velocity := velocity i |}.
Hypothesis left_i : wall_of i = left.
Hypothesis right_j : wall_of j = right.
Hypothesis P2 : next s i j.
Hypothesis P1 : next s j again.

Let th0 := phase s (time i).
Let th1 := phase s (time j).
Let v := velocity i.

Lemma cycles x n : cos (x + 2 * INR n * PI) = cos x /\ sin (x + 2 * INR n * PI) = sin x.
Proof. split; [apply cos_period|apply sin_period]. Qed.
Lemma phase_again : phase s (time again) = th0 + 2 * INR N * PI.
Proof. unfold again, phase, period, th0. cbn. field_simplify; [unfold phase; field; lra|lra]. Qed.

Lemma velocities : velocity j = - e s * v + A s * W s * (cos th0 - cos th1) /\
  v = - e s * velocity j + A s * W s * (cos th1 - cos th0).
Proof.
  destruct P2 as (_ & _ & a), P1 as (_ & _ & b). rewrite one_velocity in a, b by exact one_harmonic. cbn [rebound speed since] in *.
  rewrite phase_again, (proj1 (cycles th0 N)) in b. cbn [again velocity] in b. unfold v. split; [rewrite a|rewrite b at 1]; unfold th0, th1; ring.
Qed.

Theorem eq61 : v = - velocity j.
Proof. destruct velocities. nra. Qed.

Theorem eq62 : e s < 1 -> v = A s * W s / (1 - e s) * (cos th1 - cos th0).
Proof.
  intros h. destruct velocities as [a _]. assert (b := eq61).
  apply (Rmult_eq_reg_l (1 - e s)); [|lra]. field_simplify; [|lra]. nra.
Qed.

(* The flight from wall to wall takes d (A.4). *)
Lemma eqA4 : d s = - A s * sin th1 + (- e s * v + A s * W s * cos th0) * (time j - time i) + A s * sin th0.
Proof.
  destruct P2 as (_ & a & _). rewrite one_position in a by exact one_harmonic. unfold plane in a. rewrite right_j in a. cbn [rebound speed since place side] in a.
  rewrite left_i in a. cbn [side] in a. unfold plane in a. cbn [side] in a. fold th0 th1 v in a. lra.
Qed.

(* Equally spaced impacts (64). *)
Hypothesis equispaced : time j = time i + INR N * PI / W s.
Lemma phase_half : th1 = th0 + INR N * PI.
Proof. unfold th1, th0, phase. rewrite equispaced. field. lra. Qed.

Section Even.
Variable n : nat.
Hypothesis even : N = (2 * n)%nat.
Lemma even_phase : cos th1 = cos th0 /\ sin th1 = sin th0.
Proof.
  rewrite phase_half, even, mult_INR. cbn [INR]. replace (th0 + (1 + 1) * INR n * PI) with (th0 + 2 * INR n * PI) by ring. apply cycles.
Qed.
Theorem eq65 : e s < 1 -> v = 0.
Proof. intros h. rewrite (eq62 h), (proj1 even_phase). ring. Qed.
(* In the same way the first flight gives d = A W h cos th0, and the second one d = - A W h cos th0. *)
Theorem even_impossible : e s < 1 -> False.
Proof.
  intros h. assert (v0 := eq65 h). assert (a := eqA4). rewrite (proj2 even_phase), v0 in a.
  destruct P1 as (_ & b & _). rewrite one_position in b by exact one_harmonic. unfold plane in b. cbn [rebound speed since place again wall_of] in b.
  rewrite right_j in b. unfold plane in b. cbn [side] in b.
  rewrite phase_again, (proj2 (cycles th0 N)) in b. fold th1 in b. rewrite (proj2 even_phase), (proj1 even_phase) in b.
  replace (velocity j) with 0 in b by (assert (c := eq61); lra).
  replace (time again - time j) with (time j - time i) in b.
  2:{ cbn. rewrite equispaced. unfold period. field. lra. }
  lra.
Qed.
End Even.

Section Odd.
Variable n : nat.
Hypothesis odd : N = (2 * n + 1)%nat.
Lemma odd_phase : cos th1 = - cos th0 /\ sin th1 = - sin th0.
Proof.
  rewrite phase_half, odd, plus_INR, mult_INR. cbn [INR].
  replace (th0 + ((1 + 1) * INR n + 1) * PI) with (th0 + 2 * INR n * PI + PI) by ring.
  rewrite neg_cos, neg_sin, (proj1 (cycles _ _)), (proj2 (cycles _ _)). split; reflexivity.
Qed.
Theorem eq66 : e s < 1 -> v = - (2 * A s * W s / (1 - e s)) * cos th0.
Proof. intros h. rewrite (eq62 h), (proj1 odd_phase). field. lra. Qed.
Theorem eq67 : e s < 1 -> d s = 2 * A s * sin th0 - (1 + e s) * INR N * PI / (2 * W s) * v.
Proof.
  intros h. assert (a := eqA4). rewrite (proj2 odd_phase), equispaced in a.
  assert (b : A s * W s * cos th0 = - v * (1 - e s) / 2) by (rewrite (eq66 h); field; lra).
  rewrite b in a. rewrite a. field. lra.
Qed.
Theorem eq68 : e s < 1 ->
  A s = 1 / 2 * sqrt (((1 - e s) * v / W s) ^ 2 + (d s + (1 + e s) * INR N * PI * v / (2 * W s)) ^ 2).
Proof.
  intros h. replace (d s + (1 + e s) * INR N * PI * v / (2 * W s)) with (2 * A s * sin th0) by (rewrite (eq67 h); field; lra).
  replace ((1 - e s) * v / W s) with (- (2 * A s * cos th0)) by (rewrite (eq66 h); field; lra).
  replace ((- (2 * A s * cos th0)) ^ 2 + (2 * A s * sin th0) ^ 2) with ((2 * A s) ^ 2 * (Rsqr (sin th0) + Rsqr (cos th0))) by (unfold Rsqr; ring).
  rewrite sin2_cos2, Rmult_1_r, sqrt_pow2 by lra. field.
Qed.
(* No loss at impact: the speed is free, the phase is not. *)
Theorem eq70 : e s = 1 -> cos th1 = cos th0 /\ d s = 2 * A s * sin th0 - INR N * PI / W s * v.
Proof.
  intros h. destruct velocities as [a _]. assert (b := eq61). rewrite h in a. assert (0 < A s * W s) by nra.
  assert (c : cos th1 = cos th0) by nra. split; [exact c|].
  assert (z : cos th0 = 0) by (assert (o := proj1 odd_phase); lra).
  assert (f := eqA4). rewrite (proj2 odd_phase), equispaced, h, z in f. rewrite f. field. lra.
Qed.
Theorem eq71 : e s = 1 -> d s = 2 * A s - INR N * PI / W s * v \/ d s = - 2 * A s - INR N * PI / W s * v.
Proof.
  intros h. destruct (eq70 h) as [c ->]. assert (z : cos th0 = 0) by (assert (o := proj1 odd_phase); lra).
  assert (q := sin2_cos2 th0). unfold Rsqr in q. rewrite z in q.
  assert (p : sin th0 = 1 \/ sin th0 = - 1).
  { assert (r : (sin th0 - 1) * (sin th0 + 1) = 0) by lra. apply Rmult_integral in r. lra. }
  destruct p as [-> | ->]; [left|right]; ring.
Qed.
End Odd.
End TwoImpact.
