(* Chatter: beyond the paper. On a window the wall-ward acceleration of the ball lies between a_lo > 0 and a_hi.

   `bounce`: a ball that leaves the wall at speed u comes back, first contact and same wall, within 2 u/a_lo, and no
   faster than u sqrt(a_hi/a_lo). `chatter`: if r = e sqrt(a_hi/a_lo) < 1 and the sum 2 u/(a_lo (1 - r)) of all return times
   ends inside the window, infinitely many impacts follow; the n-th comes at most 2 u r^n/(a_lo (1 - r)) before their
   limit, with u r^n as a bound on its rebound speed. *)
From Coq Require Import Reals Lra Lia List.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model Step Motion.
From ImpactPair Require Return.
Open Scope R_scope.

(* A function with z' decreasing between two slopes; all that `bounce` needs of the flight. *)
Section Throw.
Variables (z v a : R -> R) (t0 ends u low high : R).
Hypothesis z_derivative : forall t, derivable_pt_lim z t (v t).
Hypothesis v_derivative : forall t, derivable_pt_lim v t (a t).
Hypothesis acceleration : forall t, t0 <= t <= ends -> - high <= a t <= - low.
Hypothesis pressed : 0 < low.
Hypothesis z0 : z t0 = 0.
Hypothesis v0 : v t0 = u.
Hypothesis thrown : 0 < u.
Hypothesis in_time : t0 + 2 * u / low <= ends.

Lemma slope f f' p q : p <= q -> (forall c, derivable_pt_lim f c (f' c)) -> (forall c, p < c < q -> 0 <= f' c) -> f p <= f q.
Proof.
  intros h D k. destruct (Req_dec p q) as [->|n]; [lra|].
  destruct (MVT_cor2 f f' p q ltac:(lra) (fun c _ => D c)) as (c & eq & hc). specialize (k c hc). nra.
Qed.

Lemma v_above t : t0 <= t <= ends -> u - high * (t - t0) <= v t.
Proof.
  intros h. assert (g : v t0 - u + high * (t0 - t0) <= v t - u + high * (t - t0)).
  { apply (slope (fun x => v x - u + high * (x - t0)) (fun x => a x + high)); [lra| |].
    - intros c. replace (a c + high) with (a c - 0 + high * (1 - 0)) by ring.
      apply derivable_pt_lim_plus; [apply derivable_pt_lim_minus; [apply v_derivative|apply derivable_pt_lim_const]|].
      apply derivable_pt_lim_scal. apply derivable_pt_lim_minus; [apply derivable_pt_lim_id|apply derivable_pt_lim_const].
    - intros c hc. assert (b := acceleration c ltac:(lra)). lra. }
  lra.
Qed.
Lemma v_below t : t0 <= t <= ends -> v t <= u - low * (t - t0).
Proof.
  intros h. assert (g : u - low * (t0 - t0) - v t0 <= u - low * (t - t0) - v t).
  { apply (slope (fun x => u - low * (x - t0) - v x) (fun x => - low - a x)); [lra| |].
    - intros c. replace (- low - a c) with (0 - low * (1 - 0) - a c) by ring.
      apply derivable_pt_lim_minus; [|apply v_derivative]. apply derivable_pt_lim_minus; [apply derivable_pt_lim_const|].
      apply derivable_pt_lim_scal. apply derivable_pt_lim_minus; [apply derivable_pt_lim_id|apply derivable_pt_lim_const].
    - intros c hc. assert (b := acceleration c ltac:(lra)). lra. }
  lra.
Qed.
Lemma z_below t : t0 <= t <= ends -> z t <= u * (t - t0) - low * (t - t0) ^ 2 / 2.
Proof.
  intros h. assert (g : u * (t0 - t0) - low / 2 * (t0 - t0) ^ 2 - z t0 <= u * (t - t0) - low / 2 * (t - t0) ^ 2 - z t).
  { apply (slope (fun x => u * (x - t0) - low / 2 * (x - t0) ^ 2 - z x) (fun x => u - low * (x - t0) - v x)); [lra| |].
    - intros c. apply derivable_pt_lim_minus; [|apply z_derivative]. apply is_derive_Reals. auto_derive; [exact I|field].
    - intros c hc. assert (b := v_below c ltac:(lra)). lra. }
  lra.
Qed.
Lemma v_decreasing p q : t0 <= p -> p < q -> q <= ends -> v q < v p.
Proof.
  intros h1 h2 h3. destruct (MVT_cor2 v a p q h2 (fun c _ => v_derivative c)) as (c & eq & hc).
  assert (b := acceleration c ltac:(lra)). nra.
Qed.

Theorem returns : exists t1, t0 < t1 <= t0 + 2 * u / low /\ z t1 = 0 /\ (forall t, t0 < t < t1 -> 0 < z t <= u ^ 2 / (2 * low)) /\
  v t1 < 0 /\ (v t1) ^ 2 <= u ^ 2 * (high / low).
Proof.
  assert (acc0 : low <= high).
  { assert (b := acceleration t0). assert (0 < 2 * u / low) by (apply Rdiv_lt_0_compat; lra). lra. }
  set (last := t0 + 2 * u / low). assert (T0 : 0 < 2 * u / low) by (apply Rdiv_lt_0_compat; lra).
  set (early := t0 + u / high). assert (E0 : 0 < u / high) by (apply Rdiv_lt_0_compat; lra).
  assert (E1 : u / high < 2 * u / low).
  { apply (Rmult_lt_reg_r (high * low)); [nra|]. replace (u / high * (high * low)) with (u * low) by (field; lra).
    replace (2 * u / low * (high * low)) with (2 * u * high) by (field; lra). nra. }
  assert (up : 0 < z early).
  { rewrite <- z0. apply (increasing z v); [unfold early; lra|exact z_derivative|]. intros c hc. unfold early in hc.
    assert (b := v_above c ltac:(unfold last in *; lra)).
    assert (high * (c - t0) < u). { replace u with (high * (u / high)) by (field; lra). apply Rmult_lt_compat_l; lra. } lra. }
  assert (down : z last <= 0).
  { assert (b := z_below last ltac:(unfold last; lra)). unfold last in b at 2 3.
    replace (u * (t0 + 2 * u / low - t0) - low * (t0 + 2 * u / low - t0) ^ 2 / 2) with 0 in b by (field; lra). exact b. }
  destruct (IVT_gen z early last 0) as (t1 & b & zero).
  { intros c. apply derivable_continuous_pt. exists (v c). apply z_derivative. }
  { rewrite Rmin_right, Rmax_left by lra. lra. }
  rewrite Rmin_left, Rmax_right in b by (unfold early, last; lra).
  assert (bounds : t0 < t1 <= last) by (unfold early in b; lra).
  destruct (MVT_cor2 z v t0 t1 (proj1 bounds) (fun c _ => z_derivative c)) as (top & eq & htop).
  assert (vtop : v top = 0) by (rewrite z0, zero in eq; nra).
  exists t1. split; [exact bounds|]. split; [exact zero|]. unfold last in bounds.
  assert (v1 : v t1 < 0) by (rewrite <- vtop; apply v_decreasing; lra).
  split; [|split; [exact v1|]].
  - intros t h. split.
    + destruct (Rlt_le_dec 0 (z t)) as [p|n]; [exact p|exfalso].
      destruct (MVT_cor2 z v t0 t (proj1 h) (fun c _ => z_derivative c)) as (c1 & e1 & h1).
      destruct (MVT_cor2 z v t t1 (proj2 h) (fun c _ => z_derivative c)) as (c2 & e2 & h2).
      assert (v c1 <= 0) by nra. assert (0 <= v c2) by nra.
      assert (v c2 < v c1) by (apply v_decreasing; lra). lra.
    + assert (q := z_below t ltac:(lra)). apply Rle_trans with (1 := q).
      assert (s := pow2_ge_0 (u - low * (t - t0))). apply (Rmult_le_reg_r (2 * low)); [lra|].
      replace (u ^ 2 / (2 * low) * (2 * low)) with (u ^ 2) by (field; lra). lra.
  - (* v^2/2 + low z falls on the way up, v^2/2 + high z on the way down. *)
    assert (D : forall k c, derivable_pt_lim (fun x => - (v x ^ 2 / 2 + k * z x)) c (- (v c * (a c + k)))).
    { intros k c. assert (dz := proj2 (is_derive_Reals _ _ _) (z_derivative c)). assert (dv := proj2 (is_derive_Reals _ _ _) (v_derivative c)).
      apply is_derive_Reals. auto_derive; [repeat split; [exists (a c); exact dv|exists (v c); exact dz]|].
      assert (uz : Derive (fun x : R => z x) c = v c) by (apply is_derive_unique; exact dz).
      assert (uv : Derive (fun x : R => v x) c = a c) by (apply is_derive_unique; exact dv). rewrite uz, uv. field. }
    assert (up2 : - (v t0 ^ 2 / 2 + low * z t0) <= - (v top ^ 2 / 2 + low * z top)).
    { apply (slope (fun x => - (v x ^ 2 / 2 + low * z x)) (fun c => - (v c * (a c + low)))); [lra|apply D|]. intros c hc.
      assert (v top < v c) by (apply v_decreasing; lra). assert (k := acceleration c ltac:(lra)). nra. }
    assert (down2 : - (v top ^ 2 / 2 + high * z top) <= - (v t1 ^ 2 / 2 + high * z t1)).
    { apply (slope (fun x => - (v x ^ 2 / 2 + high * z x)) (fun c => - (v c * (a c + high)))); [lra|apply D|]. intros c hc.
      assert (v c < v top) by (apply v_decreasing; lra). assert (k := acceleration c ltac:(lra)). nra. }
    rewrite v0, z0, vtop in up2. rewrite vtop, zero in down2.
    assert (ztop : z top <= u ^ 2 / (2 * low)).
    { apply (Rmult_le_reg_r (2 * low)); [lra|]. replace (u ^ 2 / (2 * low) * (2 * low)) with (u ^ 2) by (field; lra). lra. }
    apply Rle_trans with (2 * high * z top); [lra|].
    apply Rle_trans with (2 * high * (u ^ 2 / (2 * low))); [apply Rmult_le_compat_l; lra|]. right. field. lra.
Qed.
End Throw.

Section Chatter.
Variable s : scene.
Variables (w : wall) (opens ends low high : R).
Hypothesis gap : 0 < d s.
Hypothesis bouncing : 0 < e s.
(* The wall-ward acceleration (10) on the window. *)
Hypothesis window : forall t, opens <= t <= ends -> low <= side w * (box_push s t) <= high.
Hypothesis pressed : 0 < low.

(* The rebound speed after an impact on w. *)
Definition rebound_speed (i : impact) : R := e s * (side w * velocity i).

Theorem bounce i : wall_of i = w -> 0 < rebound_speed i -> opens <= time i ->
  time i + 2 * rebound_speed i / low <= ends -> rebound_speed i ^ 2 / (2 * low) < d s ->
  exists j, next s i j /\ wall_of j = w /\ time i < time j <= time i + 2 * rebound_speed i / low /\
    0 < side w * velocity j <= rebound_speed i * sqrt (high / low).
Proof.
  intros on thrown opened in_time low_flight. set (u := rebound_speed i) in *. set (l := rebound s i).
  assert (side2 : side w * side w = 1) by (destruct w; cbn; ring).
  set (z := fun t => - side w * (free_position s l t - plane s w)).
  set (v := fun t => - side w * free_velocity s l t). set (a := fun t => - side w * (box_push s t)).
  destruct (returns z v a (time i) ends u low high) as (t1 & r1 & zero & inside & v1 & fast); try assumption.
  - intros t. apply derivable_pt_lim_scal. replace (free_velocity s l t) with (free_velocity s l t - 0) by ring.
    apply derivable_pt_lim_minus; [apply is_derive_Reals, position_derivative|apply derivable_pt_lim_const].
  - intros t. apply derivable_pt_lim_scal, is_derive_Reals, velocity_derivative.
  - intros t h. unfold a. assert (k := window t ltac:(lra)). lra.
  - unfold z. replace (free_position s l (time i)) with (place l) by (symmetry; apply (position_start s l)).
    unfold l. cbn [rebound place]. rewrite on. ring.
  - unfold v. replace (free_velocity s l (time i)) with (speed l) by (symmetry; apply (velocity_start s l)).
    unfold l, u, rebound_speed. cbn [rebound speed]. ring.
  - assert (onwall : free_position s l t1 = plane s w).
    { unfold z in zero. replace (free_position s l t1) with (side w * side w * (free_position s l t1 - plane s w) + plane s w) by (rewrite side2; ring).
      replace (side w * side w * (free_position s l t1 - plane s w)) with (- side w * (- side w * (free_position s l t1 - plane s w))) by ring.
      rewrite zero. ring. }
    exists {| wall_of := w; time := t1; velocity := free_velocity s l t1 |}. cbn [wall_of time velocity].
    split; [|split; [reflexivity|split; [exact r1|]]].
    + split; [split; [cbn; lra|split]|split; [exact onwall|reflexivity]]; cbn [time]; fold l.
      * rewrite onwall. unfold plane. destruct w; cbn; [rewrite Rabs_left|rewrite Rabs_pos_eq]; lra.
      * intros t h. cbn [l rebound since] in h. destruct (inside t h) as [h1 h2]. unfold z, plane in h1, h2.
        destruct w; cbn in *; apply Rabs_def1; lra.
    + unfold v in v1, fast. split; [lra|]. apply Rsqr_incr_0_var.
      * unfold Rsqr. replace (u * sqrt (high / low) * (u * sqrt (high / low))) with (u ^ 2 * (sqrt (high / low) * sqrt (high / low))) by ring.
        rewrite sqrt_sqrt; [lra|]. assert (k := window (time i)). assert (0 < 2 * u / low) by (apply Rdiv_lt_0_compat; lra).
        left. apply Rdiv_lt_0_compat; lra.
      * apply Rmult_le_pos; [lra|apply sqrt_pos].
Qed.

Let r := e s * sqrt (high / low).
Hypothesis shrinking : r < 1.
(* All return times that may still come. *)
Definition remaining (i : impact) : R := 2 * rebound_speed i / (low * (1 - r)).
(* The invariant of the impacts of a chatter. *)
Definition chatters (i : impact) : Prop := wall_of i = w /\ 0 < rebound_speed i /\ opens <= time i /\
  time i + remaining i <= ends /\ rebound_speed i ^ 2 / (2 * low) < d s.

Lemma r_positive : 0 <= r.
Proof. apply Rmult_le_pos; [lra|apply sqrt_pos]. Qed.

Lemma chatter_step i : chatters i -> exists j, next s i j /\ chatters j /\ time i < time j /\
  rebound_speed j <= r * rebound_speed i /\ time j + remaining j <= time i + remaining i.
Proof.
  intros (on & thrown & opened & fits & low_flight). assert (r0 := r_positive). unfold remaining in *.
  set (u := rebound_speed i) in *.
  assert (share : 2 * u / (low * (1 - r)) = 2 * u / low + 2 * (r * u) / (low * (1 - r))) by (field; lra).
  assert (k : 0 < low * (1 - r)) by (apply Rmult_lt_0_compat; lra).
  assert (rest : 0 <= 2 * (r * u) / (low * (1 - r))) by (apply Rdiv_le_0_compat; nra).
  destruct (bounce i on thrown opened) as (j & n & wj & tj & vj); [fold u; lra|exact low_flight|]. fold u in tj, vj.
  assert (slower : rebound_speed j <= r * u).
  { unfold rebound_speed, r. rewrite Rmult_assoc. apply Rmult_le_compat_l; [lra|]. rewrite Rmult_comm. lra. }
  assert (alive : 0 < rebound_speed j) by (apply Rmult_lt_0_compat; lra).
  assert (later : 2 * rebound_speed j / (low * (1 - r)) <= 2 * (r * u) / (low * (1 - r))).
  { apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat; exact k|lra]. }
  exists j. split; [exact n|]. split; [|split; [lra|split; [exact slower|unfold remaining; lra]]].
  split; [exact wj|]. split; [exact alive|]. split; [lra|]. split; [unfold remaining; lra|].
  apply Rle_lt_trans with (2 := low_flight). apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat; lra|].
  apply pow_incr. split; [lra|]. apply Rle_trans with (1 := slower). nra.
Qed.

(* j is the n-th impact after i. *)
Fixpoint after (i : impact) (n : nat) (j : impact) : Prop :=
  match n with O => j = i | S m => exists k, after i m k /\ next s k j end.
Lemma after_unique i n : forall j k, after i n j -> after i n k -> j = k.
Proof.
  induction n as [|n IH]; cbn; [congruence|]. intros j k (j' & a & b) (k' & a' & b').
  rewrite (IH _ _ a a') in b. exact (reaches_unique s gap _ _ _ b b').
Qed.

Section Orbit.
Variable i : impact.
Hypothesis start : chatters i.

Lemma all_follow n : exists j, after i n j /\ chatters j /\ rebound_speed j <= rebound_speed i * r ^ n.
Proof.
  assert (r0 := r_positive). induction n as [|n (j & a & c & b)].
  - exists i. cbn. split; [reflexivity|split; [exact start|lra]].
  - destruct (chatter_step j c) as (k & n' & c' & _ & slower & _). exists k. split; [exists j; auto|]. split; [exact c'|].
    cbn. apply Rle_trans with (1 := slower). apply Rle_trans with (r * (rebound_speed i * r ^ n)); [apply Rmult_le_compat_l; assumption|lra].
Qed.

(* Times increase, and what time and remainder add up to decreases. *)
Lemma ordered m n : (n <= m)%nat -> forall j k, after i n j -> after i m k -> time j <= time k /\ time k + remaining k <= time j + remaining j.
Proof.
  induction 1 as [|m h IH]; intros j k a b.
  - rewrite (after_unique _ _ _ _ a b). lra.
  - destruct b as (k' & b & n'). destruct (IH j k' a b) as [o p].
    destruct (all_follow m) as (k'' & b' & c & _). rewrite <- (after_unique _ _ _ _ b b') in c.
    destruct (chatter_step k' c) as (q & n'' & _ & o' & _ & p'). rewrite (reaches_unique s gap _ _ _ n' n''). lra.
Qed.

Theorem chatter : exists limit, time i < limit <= time i + remaining i /\
  forall n, exists j, after i n j /\ wall_of j = w /\ 0 < rebound_speed j <= rebound_speed i * r ^ n /\
    limit - 2 * (rebound_speed i * r ^ n) / (low * (1 - r)) <= time j < limit.
Proof.
  assert (k : 0 < low * (1 - r)) by (apply Rmult_lt_0_compat; lra).
  set (times := fun t => exists n j, after i n j /\ t = time j).
  assert (above : forall n j, after i n j -> is_upper_bound times (time j + remaining j)).
  { intros n j a t (m & q & b & ->). destruct (all_follow m) as (q' & b' & (_ & alive & _) & _). rewrite <- (after_unique _ _ _ _ b b') in alive.
    destruct (all_follow n) as (j' & a' & (_ & alive' & _) & _). rewrite <- (after_unique _ _ _ _ a a') in alive'.
    assert (0 < remaining q) by (apply Rdiv_lt_0_compat; lra). assert (0 < remaining j) by (apply Rdiv_lt_0_compat; lra).
    destruct (Nat.le_ge_cases n m) as [o|o]; [destruct (ordered m n o j q a b)|destruct (ordered n m o q j b a)]; lra. }
  destruct (completeness times) as (limit & ub & lub).
  { exists (time i + remaining i). apply (above 0%nat i). reflexivity. }
  { exists (time i), 0%nat, i. split; reflexivity. }
  assert (strict : forall n j, after i n j -> time j < limit).
  { intros n j a. destruct (all_follow n) as (j' & a' & c & _). rewrite <- (after_unique _ _ _ _ a a') in c.
    destruct (chatter_step j c) as (q & n' & _ & o & _). apply Rlt_le_trans with (1 := o). apply ub. exists (S n), q. split; [exists j; auto|reflexivity]. }
  exists limit. split; [split; [exact (strict 0%nat i eq_refl)|apply lub, (above 0%nat i eq_refl)]|].
  intros n. destruct (all_follow n) as (j & a & (on & alive & _) & slow). exists j. split; [exact a|]. split; [exact on|]. split; [lra|].
  split; [|exact (strict n j a)]. assert (b := lub _ (above n j a)). unfold remaining in b.
  assert (2 * rebound_speed j / (low * (1 - r)) <= 2 * (rebound_speed i * r ^ n) / (low * (1 - r))).
  { apply Rmult_le_compat_r; [left; apply Rinv_0_lt_compat; exact k|lra]. } lra.
Qed.

(* So they accumulate there, and the contact force acts from then on. *)
Let nth (n : nat) : impact := Nat.iter n (Return.after s) i.
Lemma nth_after n : forall j, after i n j -> nth n = j.
Proof.
  induction n as [|n IH]; intros j; [intros h; symmetry; exact h|]. intros (k & a & follows_). change (Return.after s (nth n) = j). rewrite (IH k a).
  exact (Return.next_after s gap k j follows_).
Qed.
Theorem chatter_accumulates : time i + remaining i < ends -> exists limit, time i < limit <= time i + remaining i /\
  accumulates s (rebound s i) w limit /\ pressed_from s w limit.
Proof.
  intros room. destruct chatter as (limit & bounds & all). exists limit. split; [exact bounds|]. assert (r0 := r_positive).
  assert (k : 0 < low * (1 - r)) by (apply Rmult_lt_0_compat; lra).
  assert (small : is_lim_seq (fun n => r ^ S n) 0).
  { apply (is_lim_seq_incr_1 (fun n => r ^ n)). apply is_lim_seq_geom. rewrite Rabs_pos_eq; lra. }
  assert (scaled : forall c, is_lim_seq (fun n => c * r ^ S n) 0).
  { intros c. replace (Finite 0) with (Rbar_mult (Finite c) (Finite 0)) by (cbn; f_equal; ring).
    apply is_lim_seq_scal_l. exact small. }
  assert (side2 : side w * side w = 1) by (destruct w; cbn; ring).
  split.
  - exists (fun n => nth (S n)). split; [|split; [|split]].
    + destruct (all 1%nat) as (j & a & _). rewrite (nth_after _ _ a). destruct a as (i' & -> & first). exact first.
    + intros n. destruct (all (S n)) as (j & a & on & _ & before). destruct (all (S (S n))) as (j' & a' & _).
      rewrite (nth_after _ _ a), (nth_after _ _ a'). split; [|split; [exact on|apply before]]. destruct a' as (j'' & a'' & follows_).
      rewrite (after_unique _ _ _ _ a a''). exact follows_.
    + apply (is_lim_seq_le_le (fun n => limit - 2 * rebound_speed i / (low * (1 - r)) * r ^ S n) _ (fun _ => limit)).
      * intros n. destruct (all (S n)) as (j & a & _ & _ & before & strictly). rewrite (nth_after _ _ a).
        replace (2 * rebound_speed i / (low * (1 - r)) * r ^ S n) with (2 * (rebound_speed i * r ^ S n) / (low * (1 - r))) by (field; lra). lra.
      * replace (Finite limit) with (Finite (limit - 0)) by (f_equal; ring). apply is_lim_seq_minus'; [apply is_lim_seq_const|apply scaled].
      * apply is_lim_seq_const.
    + set (u := rebound_speed i) in *. apply (is_lim_seq_le_le (fun n => - (u / e s) * r ^ S n) _ (fun n => u / e s * r ^ S n)); [|apply scaled|apply scaled].
      intros n. destruct (all (S n)) as (j & a & _ & fast & _). rewrite (nth_after _ _ a). unfold rebound_speed in fast at 1 2. fold u in fast.
      assert (e s * (side w * velocity j) <= e s * (u / e s * r ^ S n)) by (replace (e s * (u / e s * r ^ S n)) with (u * r ^ S n) by (field; lra); apply fast).
      assert (0 < side w * velocity j) by (apply (Rmult_lt_reg_l (e s)); lra).
      assert (side w * velocity j <= u / e s * r ^ S n) by (apply (Rmult_le_reg_l (e s)); lra).
      destruct w; cbn [side] in *; lra.
  - exists ends. split; [lra|]. intros t h. assert (p := window t ltac:(destruct start as (_ & _ & o & _); lra)). lra.
Qed.
End Orbit.
End Chatter.
