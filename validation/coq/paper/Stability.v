(* Stability of periodic orbits. First (A.7), with -E'' for A W^2 sin th, which it is of one harmonic (one_push): if the next impact depends differentiably on time and velocity of this one,
   the four derivatives are those of the paper (with the velocity column e h/v_{i+1}), and their determinant is
   e^2 v_i/v_{i+1}. Then eigenvalues x + i y of a real 2x2 matrix with trace tr and determinant det: (38), the condition
   (39) for an eigenvalue -1, (40) for an eigenvalue 1, and that |tr| < 1 + det, det < 1 puts both inside the unit circle. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model Step.
Open Scope R_scope.

Section Jacobian.
Variable s : scene.
Variables (w0 w1 : wall) (t0 v0 : R).
(* Phase and velocity of the next impact as functions of those of this one. *)
Variables (t1 v1 : R -> R -> R).
Let at_ t v := {| wall_of := w0; time := t; velocity := v |}.
(* Near (t0, v0) they are given by the model: (A.1)-(A.6). *)
Variable near : posreal.
Let here t v := Rabs (t - t0) < near /\ Rabs (v - v0) < near.
Hypothesis contact : forall t v, here t v -> free_position s (rebound s (at_ t v)) (t1 t v) = plane s w1.
Hypothesis arrival : forall t v, here t v -> v1 t v = free_velocity s (rebound s (at_ t v)) (t1 t v).
Variables (t1_t t1_v : R).
Hypothesis by_time : is_derive (fun t => t1 t v0) t0 t1_t.
Hypothesis by_velocity : is_derive (fun v => t1 t0 v) v0 t1_v.
Let h := t1 t0 v0 - t0.
Let a0 := box_push s t0.
Let a1 := box_push s (t1 t0 v0).
Hypothesis transversal : v1 t0 v0 <> 0.

Lemma here_time t : Rabs (t - t0) < near -> here t v0.
Proof. intros r. split; [exact r|]. replace (v0 - v0) with 0 by ring. rewrite Rabs_R0. apply cond_pos. Qed.
Lemma here_velocity v : Rabs (v - v0) < near -> here t0 v.
Proof. intros r. split; [|exact r]. replace (t0 - t0) with 0 by ring. rewrite Rabs_R0. apply cond_pos. Qed.
Lemma near_derivative (f g : R -> R) (x l : R) : (forall y, Rabs (y - x) < near -> f y = g y) -> is_derive f x l -> is_derive g x l.
Proof. intros k. apply is_derive_ext_loc. exists near. intros y b. apply k, b. Qed.
Lemma derivative_of_constant (f : R -> R) (x l c : R) : (forall y, Rabs (y - x) < near -> f y = c) -> is_derive f x l -> l = 0.
Proof.
  intros k D. apply (near_derivative f (fun _ => c)) in D; [|exact k].
  apply is_derive_unique in D. rewrite <- D. apply Derive_const.
Qed.
Lemma v1_value : v1 t0 v0 = - box_velocity s (t1 t0 v0) + (- e s * v0 + box_velocity s t0).
Proof. rewrite arrival; [reflexivity|]. apply here_time. replace (t0 - t0) with 0 by ring. rewrite Rabs_R0. apply cond_pos. Qed.

Ltac derive := auto_derive; [repeat split; match goal with
  | |- ex_derive (fun x => box_position s x) _ => eexists; apply box_position_derivative
  | |- ex_derive (fun x => box_velocity s x) _ => eexists; apply box_velocity_derivative
  | |- ex_derive (fun x => t1 x v0) _ => exists t1_t; exact by_time
  | _ => exists t1_v; exact by_velocity end|];
  repeat match goal with
  | |- context [Derive (fun x => box_position s x) ?t] =>
    replace (Derive (fun x => box_position s x) t) with (box_velocity s t) by (symmetry; apply is_derive_unique, box_position_derivative)
  | |- context [Derive (fun x => box_velocity s x) ?t] =>
    replace (Derive (fun x => box_velocity s x) t) with (- box_push s t) by (symmetry; apply is_derive_unique, box_velocity_derivative)
  | |- context [Derive (fun x => t1 x v0) t0] =>
    replace (Derive (fun x => t1 x v0) t0) with t1_t by (symmetry; apply is_derive_unique, by_time)
  | |- context [Derive (fun x => t1 t0 x) v0] =>
    replace (Derive (fun x => t1 t0 x) v0) with t1_v by (symmetry; apply is_derive_unique, by_velocity)
  end.

Theorem A7_time_by_time : t1_t = (a0 * h - e s * v0) / v1 t0 v0.
Proof.
  assert (z : v1 t0 v0 * t1_t - (a0 * h - e s * v0) = 0).
  { apply (derivative_of_constant (fun t => free_position s (rebound s (at_ t v0)) (t1 t v0)) t0 _ (plane s w1)).
    - intros t r. apply contact, here_time, r.
    - rewrite v1_value. unfold free_position, at_. cbn [rebound since place speed time velocity wall_of].
      derive. unfold h, a0. ring. }
  apply (Rmult_eq_reg_l (v1 t0 v0)); [|exact transversal]. field_simplify; [lra|exact transversal].
Qed.
Theorem A7_time_by_velocity : t1_v = e s * h / v1 t0 v0.
Proof.
  assert (z : v1 t0 v0 * t1_v - e s * h = 0).
  { apply (derivative_of_constant (fun v => free_position s (rebound s (at_ t0 v)) (t1 t0 v)) v0 _ (plane s w1)).
    - intros v r. apply contact, here_velocity, r.
    - rewrite v1_value. unfold free_position, at_. cbn [rebound since place speed time velocity wall_of].
      derive. unfold h. ring. }
  apply (Rmult_eq_reg_l (v1 t0 v0)); [|exact transversal]. field_simplify; [lra|exact transversal].
Qed.
Theorem A7_velocity_by_time :
  is_derive (fun t => v1 t v0) t0 (a1 * t1_t - a0).
Proof.
  apply (near_derivative (fun t => free_velocity s (rebound s (at_ t v0)) (t1 t v0))); [intros t r; symmetry; apply arrival, here_time, r|].
  unfold free_velocity, at_. cbn [rebound since speed time velocity wall_of].
  derive. unfold a0, a1. ring.
Qed.
Theorem A7_velocity_by_velocity :
  is_derive (fun v => v1 t0 v) v0 (a1 * (e s * h / v1 t0 v0) - e s).
Proof.
  rewrite <- A7_time_by_velocity.
  apply (near_derivative (fun v => free_velocity s (rebound s (at_ t0 v)) (t1 t0 v))); [intros v r; symmetry; apply arrival, here_velocity, r|].
  unfold free_velocity, at_. cbn [rebound since speed time velocity wall_of].
  derive. unfold a1. ring.
Qed.
Theorem determinant : t1_t * (a1 * t1_v - e s)
  - t1_v * (a1 * t1_t - a0) = (e s)^2 * v0 / v1 t0 v0.
Proof. rewrite A7_time_by_time, A7_time_by_velocity. field. exact transversal. Qed.
End Jacobian.

(* x + i y is an eigenvalue: real and imaginary part of z^2 - tr z + det = 0. *)
Definition eigenvalue (tr det x y : R) : Prop := x^2 - y^2 - tr * x + det = 0 /\ 2 * x * y - tr * y = 0.

(* It is one of a matrix: some vector (p + i q, r + i t), not 0, is multiplied by it. *)
Theorem eigenvalue_of_matrix a b c d x y : (exists p q r t, (p <> 0 \/ q <> 0 \/ r <> 0 \/ t <> 0) /\
  a * p + b * r = x * p - y * q /\ a * q + b * t = x * q + y * p /\ c * p + d * r = x * r - y * t /\ c * q + d * t = x * t + y * r) ->
  eigenvalue (a + d) (a * d - b * c) x y.
Proof.
  intros (p & q & r & t & nonzero & e1 & e2 & e3 & e4). set (X := x^2 - y^2 - (a + d) * x + (a * d - b * c)).
  set (Y := 2 * x * y - (a + d) * y).
  (* The two equations of each component, as remainders R1..R4 that vanish. *)
  set (R1 := a * p + b * r - (x * p - y * q)). set (R2 := a * q + b * t - (x * q + y * p)).
  set (R3 := c * p + d * r - (x * r - y * t)). set (R4 := c * q + d * t - (x * t + y * r)).
  assert (z1 : R1 = 0) by (unfold R1; lra). assert (z2 : R2 = 0) by (unfold R2; lra).
  assert (z3 : R3 = 0) by (unfold R3; lra). assert (z4 : R4 = 0) by (unfold R4; lra).
  assert (f1 : X * p - Y * q = 0).
  { replace (X * p - Y * q) with ((d - x) * R1 + y * R2 - b * R3) by (unfold X, Y, R1, R2, R3; ring). rewrite z1, z2, z3. ring. }
  assert (f2 : X * q + Y * p = 0).
  { replace (X * q + Y * p) with ((d - x) * R2 - y * R1 - b * R4) by (unfold X, Y, R1, R2, R4; ring). rewrite z1, z2, z4. ring. }
  assert (f3 : X * r - Y * t = 0).
  { replace (X * r - Y * t) with ((a - x) * R3 + y * R4 - c * R1) by (unfold X, Y, R1, R3, R4; ring). rewrite z1, z3, z4. ring. }
  assert (f4 : X * t + Y * r = 0).
  { replace (X * t + Y * r) with ((a - x) * R4 - y * R3 - c * R2) by (unfold X, Y, R2, R3, R4; ring). rewrite z2, z3, z4. ring. }
  assert (zero : forall m n, m <> 0 \/ n <> 0 -> X * m - Y * n = 0 -> X * n + Y * m = 0 -> X = 0 /\ Y = 0).
  { intros m n no g1 g2. assert (0 < m^2 + n^2).
    { destruct no as [o|o]; apply Rsqr_pos_lt in o; unfold Rsqr in o; [assert (u := pow2_ge_0 n)|assert (u := pow2_ge_0 m)]; lra. }
    assert (k1 : (m^2 + n^2) * X = 0).
    { replace ((m^2 + n^2) * X) with (m * (X * m - Y * n) + n * (X * n + Y * m)) by ring. rewrite g1, g2. ring. }
    assert (k2 : (m^2 + n^2) * Y = 0).
    { replace ((m^2 + n^2) * Y) with (m * (X * n + Y * m) - n * (X * m - Y * n)) by ring. rewrite g1, g2. ring. }
    apply Rmult_integral in k1. apply Rmult_integral in k2. split; lra. }
  unfold eigenvalue. fold X Y. destruct nonzero as [g|[g|[g|g]]].
  - apply (zero p q); auto. - apply (zero p q); auto. - apply (zero r t); auto. - apply (zero r t); auto.
Qed.

(* (38) *)
Theorem eq38_real tr det x : 0 <= tr^2 - 4 * det ->
  (eigenvalue tr det x 0 <-> x = (tr + sqrt (tr^2 - 4 * det)) / 2 \/ x = (tr - sqrt (tr^2 - 4 * det)) / 2).
Proof.
  intros p. assert (q := sqrt_sqrt _ p). set (r := sqrt (tr^2 - 4 * det)) in *. unfold eigenvalue. split.
  - intros [a _]. assert (f : (x - (tr + r) / 2) * (x - (tr - r) / 2) = 0) by lra. apply Rmult_integral in f. lra.
  - intros [-> | ->]; split; lra.
Qed.
Theorem eq38_complex tr det x y : tr^2 - 4 * det < 0 ->
  (eigenvalue tr det x y <-> x = tr / 2 /\ (y = sqrt (4 * det - tr^2) / 2 \/ y = - sqrt (4 * det - tr^2) / 2)).
Proof.
  intros p. assert (q := sqrt_sqrt (4 * det - tr^2) ltac:(lra)). set (r := sqrt (4 * det - tr^2)) in *. unfold eigenvalue. split.
  - intros [a b]. assert (f : y * (2 * x - tr) = 0) by lra. apply Rmult_integral in f. destruct f as [f|f].
    { rewrite f in a. assert (g := pow2_ge_0 (2 * x - tr)). lra. }
    split; [lra|]. replace x with (tr / 2) in a by lra. assert (g : (y - r / 2) * (y + r / 2) = 0) by lra. apply Rmult_integral in g. lra.
  - intros [-> [-> | ->]]; split; lra.
Qed.
Theorem eq39 tr det : eigenvalue tr det (-1) 0 <-> tr + det + 1 = 0.
Proof. unfold eigenvalue. split; [intros [a _]; lra|intros a; split; lra]. Qed.
Theorem eq40 tr det : eigenvalue tr det 1 0 <-> tr = 1 + det.
Proof. unfold eigenvalue. split; [intros [a _]; lra|intros a; split; lra]. Qed.
Theorem inside_unit_circle tr det : Rabs tr < 1 + det -> det < 1 -> forall x y, eigenvalue tr det x y -> x^2 + y^2 < 1.
Proof.
  intros h k x y [a b]. apply Rabs_def2 in h. assert (f : y * (2 * x - tr) = 0) by lra. apply Rmult_integral in f.
  destruct f as [-> | f].
  - assert (x < 1). { destruct (Rlt_le_dec x 1) as [l|l]; [exact l|]. nra. }
    assert (-1 < x). { destruct (Rlt_le_dec (-1) x) as [l|l]; [exact l|]. nra. } nra.
  - replace tr with (2 * x) in * by lra. lra.
Qed.
