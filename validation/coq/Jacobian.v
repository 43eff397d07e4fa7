(* The matrix (A.7) of a flight; and what the impacts after two impacts of one box differ by: a matrix with the entries of (A.7) at phases in between. *)
From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model Step Certificate Horseshoe Return.
Open Scope R_scope.
Import ListNotations.

Record matrix (X : Type) := Matrix { m11 : X; m12 : X; m21 : X; m22 : X }.
Arguments Matrix {X}.
Arguments m11 {X}.
Arguments m12 {X}.
Arguments m21 {X}.
Arguments m22 {X}.
Definition identity : matrix R := Matrix 1 0 0 1.
Definition times (a b : matrix R) : matrix R := Matrix
  (m11 a * m11 b + m12 a * m21 b) (m11 a * m12 b + m12 a * m22 b) (m21 a * m11 b + m22 a * m21 b) (m21 a * m12 b + m22 a * m22 b).
Definition act (a : matrix R) (x : state) : state := (m11 a * fst x + m12 a * snd x, m21 a * fst x + m22 a * snd x).
Definition minus_ (x y : state) : state := (fst x - fst y, snd x - snd y).
Definition trace (a : matrix R) : R := m11 a + m22 a.
Definition det (a : matrix R) : R := m11 a * m22 a - m12 a * m21 a.
Lemma times_assoc a b c : times (times a b) c = times a (times b c).
Proof. unfold times. cbn. f_equal; ring. Qed.
Lemma act_times a b x : act (times a b) x = act a (act b x).
Proof. unfold act, times. cbn. f_equal; ring. Qed.
Lemma det_times a b : det (times a b) = det a * det b.
Proof. unfold det, times. cbn. ring. Qed.

Section Scene.
Variable s : scene.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.
Let os := companions s.

(* (A.7) with the phases x0, x1 at which -E'' is taken, launch velocity u and velocity of arrival r, after a time h. *)
Definition entries (bend0 bend1 bend0' u h h' r : R) : matrix R :=
  let a := (bend0 * h + u) / r in let b := e s * h' / r in Matrix a b (bend1 * a - bend0') (bend1 * b - e s).
Definition A7 (w : wall) (x : state) : matrix R := let y := fly s w x in
  entries (box_bend os (fst x)) (box_bend os (fst y)) (box_bend os (fst x)) (launch_speed s x) (fst y - fst x) (fst y - fst x) (snd y).

(* Along several flights: the last state, that all are flights to these walls, and the product of (A.7). *)
Fixpoint fly_on (w : wall) (walls : list wall) (x : state) : state := match walls with [] => x | w1 :: walls => fly_on w1 walls (fly s w x) end.
Fixpoint all_fly (w : wall) (walls : list wall) (x : state) : Prop := match walls with [] => True | w1 :: walls => flies s w w1 x /\ all_fly w1 walls (fly s w x) end.
Fixpoint monodromy (w : wall) (walls : list wall) (x : state) : matrix R :=
  match walls with [] => identity | w1 :: walls => times (monodromy w1 walls (fly s w x)) (A7 w x) end.

(* det (A.7) = e^2 v_i / v_{i+1}. *)
Lemma det_A7 w w1 x : flies s w w1 x -> snd (fly s w x) <> 0 -> det (A7 w x) * snd (fly s w x) = e s ^ 2 * snd x.
Proof. intros _ h. unfold det, A7, entries, launch_speed. cbn [m11 m12 m21 m22]. field. exact h. Qed.

Lemma between_range a b lo hi x : lo <= a <= hi -> lo <= b <= hi -> Rmin a b <= x <= Rmax a b -> lo <= x <= hi.
Proof.
  intros ha hb [h h']. split; [apply Rle_trans with (2 := h); apply Rmin_glb; lra|apply Rle_trans with (1 := h'); apply Rmax_lub; lra].
Qed.

Lemma secant w w1 x y lo hi : flies s w w1 x -> flies s w w1 y -> lo <= fst (fly s w x) <= hi -> lo <= fst (fly s w y) <= hi ->
  (forall th, lo <= th <= hi -> 0 < side w1 * rate os (fst y) (launch_speed s y) th) ->
  exists xi xi' zeta zeta', (Rmin (fst y) (fst x) <= xi <= Rmax (fst y) (fst x)) /\ (Rmin (fst y) (fst x) <= xi' <= Rmax (fst y) (fst x)) /\
    lo <= zeta <= hi /\ lo <= zeta' <= hi /\
    minus_ (fly s w x) (fly s w y) = act (entries (box_bend os xi) (box_bend os zeta') (box_bend os xi') (launch_speed s x) (fst (fly s w x) - xi)
      (fst (fly s w x) - fst y) (rate os (fst y) (launch_speed s y) zeta)) (minus_ x y).
Proof.
  intros fx fy bx by_ towards. assert (hx := landing_height s A_positive W_positive w w1 x fx). assert (hy := landing_height s A_positive W_positive w w1 y fy).
  assert (vx := landing_rate s A_positive W_positive w w1 x fx). assert (vy := landing_rate s A_positive W_positive w w1 y fy).
  unfold height in hx, hy. fold os in hx, hy, vx, vy.
  set (t := fst x) in *. set (t' := fst y) in *. set (u := launch_speed s x) in *. set (u' := launch_speed s y) in *.
  set (t1 := fst (fly s w x)) in *. set (t1' := fst (fly s w y)) in *.
  destruct (mean_value (fun z => rise os z u t1) (fun z => - box_bend os z * (t1 - z) - u) t' t) as (xi & r1 & e1); [intros z; apply rise_derivative_launch|].
  destruct (mean_value (box_rate os) (fun z => - box_bend os z) t' t) as (xi' & r2 & e2).
  { intros z. apply is_derive_Reals, box_rate_derivative. }
  destruct (mean_value (rise os t' u') (rate os t' u') t1' t1) as (zeta & r3 & e3); [intros z; apply rise_derivative|].
  destruct (mean_value (box_rate os) (fun z => - box_bend os z) t1' t1) as (zeta' & r4 & e4).
  { intros z. apply is_derive_Reals, box_rate_derivative. }
  assert (r3' : lo <= zeta <= hi) by exact (between_range _ _ _ _ _ by_ bx r3).
  assert (r4' : lo <= zeta' <= hi) by exact (between_range _ _ _ _ _ by_ bx r4).
  exists xi, xi', zeta, zeta'. split; [exact r1|]. split; [exact r2|]. split; [exact r3'|]. split; [exact r4'|].
  assert (pos := towards zeta r3'). set (r := rate os t' u' zeta) in *. assert (r0 : r <> 0) by (intros z; rewrite z in pos; lra).
  assert (du : u - u' = - e s * (snd x - snd y)) by (unfold u, u', launch_speed; ring).
  assert (balance : r * (t1 - t1') = (box_bend os xi * (t1 - xi) + u) * (t - t') + e s * (t1 - t') * (snd x - snd y)).
  { assert (split_ : rise os t' u t1 = rise os t' u' t1 + (u - u') * (t1 - t')) by (unfold rise; ring). rewrite du in split_. lra. }
  assert (dt : t1 - t1' = (box_bend os xi * (t1 - xi) + u) / r * (t - t') + e s * (t1 - t') / r * (snd x - snd y)).
  { apply (Rmult_eq_reg_l r); [|exact r0]. rewrite balance. field. exact r0. }
  assert (dv : snd (fly s w x) - snd (fly s w y) = (u - u') + - box_bend os xi' * (t - t') + box_bend os zeta' * (t1 - t1')).
  { rewrite vx, vy. unfold rate. lra. }
  unfold minus_, act, entries. cbn [fst snd m11 m12 m21 m22]. apply injective_projections; cbn [fst snd].
  - exact dt.
  - change (fst x) with t. change (fst y) with t'. rewrite dv, du, dt. ring.
Qed.
End Scene.
