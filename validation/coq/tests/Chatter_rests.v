(* The chatter scene as a whole: ten impacts by certificate (Sample_chatter.v), then infinitely many, which accumulate
   between t = 0.2180125 and 0.218013404. *)
From Coq Require Import Reals Lra List QArith Qreals ZArith.
From ImpactPair Require Import Model Step Certificate Chatter tests.Sample_chatter.
Open Scope R_scope.
Import ListNotations.

Lemma wallward t : 0.2180125 <= t <= 0.2180135 -> 6.24 <= side left * box_push the_scene t <= 6.25.
Proof.
  intros h. unfold box_push, push, sum, phase. cbn [fold_right others reference side the_scene A W tau].
  replace (-1 * (1 * PI ^ 2 * sin (PI * t + PI))) with (PI * PI * sin (PI * t)) by (rewrite neg_sin; ring).
  set (T := Plain.hull (Plain.enclose 60 (Rational 0.2180125)) (Plain.enclose 60 (Rational 0.2180135))).
  assert (hT : Plain.holds T t).
  { apply (Plain.holds_hull _ _ _ _ _ (Plain.holds_enclose 60 (Rational 0.2180125)) (Plain.holds_enclose 60 (Rational 0.2180135))).
    cbn [value]. unfold Q2R. cbn. lra. }
  assert (hpi := Plain.holds_enclose 60 Pi). cbn [value] in hpi.
  assert (hE := Plain.holds_mul 60 _ _ _ _ (Plain.holds_mul 60 _ _ _ _ hpi hpi) (Plain.holds_sine 60 0 _ _ (Plain.holds_mul 60 _ _ _ _ hpi hT))).
  assert (l := Plain.holds_sub 60 _ _ _ _ hE (Plain.holds_enclose 60 (Rational 6.24))).
  assert (m := Plain.holds_sub 60 _ _ _ _ (Plain.holds_enclose 60 (Rational 6.25)) hE).
  apply Plain.is_positive_sound in l; [|vm_cast_no_check (eq_refl true)]. apply Plain.is_positive_sound in m; [|vm_cast_no_check (eq_refl true)].
  cbn [value] in l, m. unfold Q2R in l, m. cbn [Qnum Qden] in l, m. lra.
Qed.

Theorem chatter_scene_accumulates : exists ten tenth limit,
  follows the_scene (rebound the_scene the_start) (ten ++ [tenth]) /\ Forall2 within printed (ten ++ [tenth]) /\
  0.2180125 < limit <= 0.218013404 /\
  forall n, exists j, after the_scene tenth n j /\ wall_of j = left /\ time j < limit /\
    limit - time j <= 1e-6 * 0.301 ^ n /\ 0 < e the_scene * - velocity j <= 2e-6 * 0.301 ^ n.
Proof.
  destruct orbit_certified as (orbit & f & inside & _).
  assert (exists ten tenth, orbit = ten ++ [tenth]) as (ten & tenth & eq).
  { destruct orbit as [|i o]; [inversion inside|]. exists (removelast (i :: o)), (last (i :: o) i). apply app_removelast_last. discriminate. }
  exists ten, tenth. rewrite eq in f, inside.
  assert (at_ : within (last printed (Impact left 0 0 0 0)) tenth).
  { apply Forall2_app_inv_r in inside. destruct inside as (l1 & l2 & _ & b & p). inversion b as [|x y l3 l4 b' b'' e1 e2]. inversion b''. subst.
    rewrite p, last_last. exact b'. }
  destruct at_ as (on & [t1 t2] & [v1 v2]). unfold Q2R in t1, t2, v1, v2. cbn in on, t1, t2, v1, v2.
  set (u := rebound_speed the_scene left tenth).
  assert (ub : 1.8712e-6 < u < 1.8714e-6) by (unfold u, rebound_speed; cbn; lra).
  assert (root : 0.3 <= 0.3 * sqrt (6.25 / 6.24) <= 0.301).
  { assert (sqrt 1 <= sqrt (6.25 / 6.24)) by (apply sqrt_le_1_alt; lra). rewrite sqrt_1 in H.
    assert (sqrt (6.25 / 6.24) <= sqrt (1.003 * 1.003)) by (apply sqrt_le_1_alt; lra). rewrite sqrt_square in H0 by lra. lra. }
  set (r := 0.3 * sqrt (6.25 / 6.24)) in *.
  assert (k : 6.24 * 0.699 <= 6.24 * (1 - r) <= 6.24 * 0.7) by lra.
  assert (fits : 2 * u / (6.24 * (1 - r)) <= 8.59e-7).
  { apply (Rmult_le_reg_r (6.24 * (1 - r))); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l, Rmult_1_r by lra. nra. }
  destruct (chatter the_scene left 0.2180125 0.2180135 6.24 6.25) with (i := tenth) as (limit & [l1 l2] & all).
  - cbn. lra.
  - cbn. lra.
  - exact wallward.
  - lra.
  - cbn [e the_scene]. fold r. lra.
  - unfold chatters, remaining. fold u. cbn [e the_scene d]. fold r. repeat split; try lra; try exact on.
    apply (Rmult_lt_reg_r (2 * 6.24)); [lra|]. unfold Rdiv. rewrite Rmult_assoc, Rinv_l by lra. nra.
  - exists limit. split; [exact f|]. split; [exact inside|]. unfold remaining in l2. fold u in l2, all. cbn [e the_scene] in l2, all. fold r in l2, all.
    split; [lra|]. intros n. destruct (all n) as (j & a & wj & [s1 s2] & [h1 h2]). exists j. split; [exact a|]. split; [exact wj|]. split; [exact h2|].
    assert (rn : r ^ n <= 0.301 ^ n) by (apply pow_incr; lra). assert (rn0 : 0 < r ^ n) by (apply pow_lt; lra).
    split.
    + replace (2 * (u * r ^ n) / (6.24 * (1 - r))) with (2 * u / (6.24 * (1 - r)) * r ^ n) in h1 by (field; lra).
      assert (2 * u / (6.24 * (1 - r)) * r ^ n <= 8.59e-7 * 0.301 ^ n) by (apply Rmult_le_compat; try lra; left; apply Rdiv_lt_0_compat; lra).
      assert (0 < 0.301 ^ n) by lra. lra.
    + unfold rebound_speed in s1, s2. cbn [side e the_scene] in s1, s2. split; [cbn [e the_scene]; lra|].
      assert (u * r ^ n <= 2e-6 * 0.301 ^ n) by (apply Rmult_le_compat; lra). cbn [e the_scene]. lra.
Qed.
