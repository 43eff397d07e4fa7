(* Horseshoes, by paths: a continuous map that carries parallelograms across one another follows every sequence of them.

   A path crosses a parallelogram from one end to the other. Under a map that carries this one across the next, a part of
   the path crosses the next, and so on for ever: a point of the path stays in all of them (`followed`). Nothing is used but
   the intermediate value theorem and the compactness of an interval. `horseshoe` says what two words give of which each may
   follow each: a closed bounded set on which the map is semiconjugate to the full shift on two symbols. *)
From Coq Require Import Reals Lra Lia List Classical.
From Coquelicot Require Import Coquelicot.
Open Scope R_scope.

(* Continuity on a set, and closed sets, as in Coquelicot. *)
Lemma on_balls {U V : UniformSpace} (S : U -> Prop) (f : U -> V) : continuous_on S f <-> forall x, S x -> forall eps : posreal,
  exists del : posreal, forall y, ball x del y -> S y -> ball (f x) eps (f y).
Proof.
  split.
  - intros h x hx eps. exact (h x hx (ball (f x) eps) (ex_intro _ eps (fun _ b => b))).
  - intros h x hx P [eps inside]. destruct (h x hx eps) as [del near]. exists del. intros y b s. apply inside, near; assumption.
Qed.
Lemma on_part {U V : UniformSpace} (S T : U -> Prop) (f : U -> V) : (forall x, T x -> S x) -> continuous_on S f -> continuous_on T f.
Proof. intros part h. exact (continuous_on_subset S T f part h). Qed.
Lemma on_comp {U V X : UniformSpace} (S : U -> Prop) (T : V -> Prop) (f : U -> V) (g : V -> X) :
  continuous_on S f -> continuous_on T g -> (forall x, S x -> T (f x)) -> continuous_on S (fun x => g (f x)).
Proof.
  rewrite !on_balls. intros hf hg into x hx eps. destruct (hg (f x) (into x hx) eps) as [mid g_near].
  destruct (hf x hx mid) as [del f_near]. exists del. intros y b s. apply g_near; auto.
Qed.
Lemma on_pair {U V X : UniformSpace} (S : U -> Prop) (f : U -> V) (g : U -> X) :
  continuous_on S f -> continuous_on S g -> continuous_on S (fun x => (f x, g x)).
Proof.
  rewrite !on_balls. intros hf hg x hx eps. destruct (hf x hx eps) as [a f_near]. destruct (hg x hx eps) as [b g_near].
  exists (mkposreal _ (Rmin_stable_in_posreal a b)). intros y near s. split; [apply f_near|apply g_near]; try exact s;
    apply (ball_le x _ _) with (2 := near); [apply Rmin_l|apply Rmin_r].
Qed.
Lemma closed_part {U V : UniformSpace} (S : U -> Prop) (T : V -> Prop) (f : U -> V) :
  closed S -> continuous_on S f -> closed T -> closed (fun x => S x /\ T (f x)).
Proof.
  intros hS hf hT x near. assert (s : S x).
  { apply hS. intros [eps out]. apply near. exists eps. intros y b [s _]. exact (out y b s). }
  split; [exact s|]. apply hT. intros [eps out]. apply near. destruct (proj1 (on_balls S f) hf x s eps) as [del close].
  exists del. intros y b [sy t]. exact (out (f y) (close y b sy) t).
Qed.
Lemma outside {U : UniformSpace} (S : U -> Prop) x : closed S -> ~ S x -> locally x (fun y => ~ S y).
Proof. intros h n. apply NNPP. intros m. exact (n (h x m)). Qed.
Lemma closed_either {U : UniformSpace} (S T : U -> Prop) : closed S -> closed T -> closed (fun x => S x \/ T x).
Proof.
  intros hS hT x near. apply NNPP. intros n. apply near.
  apply (filter_imp (fun y => ~ S y /\ ~ T y)); [tauto|]. apply filter_and; apply outside; tauto.
Qed.
(* A map on two closed sets that is continuous on each. *)
Lemma on_either {U V : UniformSpace} (S T : U -> Prop) (f : U -> V) : closed S -> closed T ->
  continuous_on S f -> continuous_on T f -> continuous_on (fun x => S x \/ T x) f.
Proof.
  intros hS hT. rewrite !on_balls. intros fS fT x _ eps.
  assert (one : forall Z : U -> Prop, closed Z -> (forall x, Z x -> forall eps : posreal, exists del : posreal, forall y, ball x del y -> Z y -> ball (f x) eps (f y)) ->
    exists del : posreal, forall y, ball x del y -> Z y -> ball (f x) eps (f y)).
  { intros Z hZ fZ. destruct (classic (Z x)) as [z|z]; [exact (fZ x z eps)|].
    destruct (outside Z x hZ z) as [del out]. exists del. intros y b zy. destruct (out y b zy). }
  destruct (one S hS fS) as [a near_a]. destruct (one T hT fT) as [b near_b].
  exists (mkposreal _ (Rmin_stable_in_posreal a b)). intros y near [s|t]; [apply near_a|apply near_b]; try assumption;
    apply (ball_le x _ _) with (2 := near); [apply Rmin_l|apply Rmin_r].
Qed.

(* Intervals and functions of one variable. *)
Definition from_to (p q t : R) : Prop := p <= t <= q.
Lemma closed_from_to p q : closed (from_to p q).
Proof. apply closed_and; [apply closed_ge|apply closed_le]. Qed.

(* A function that rises to a height reaches it a first time. *)
Lemma first_reach (g : R -> R) p q top : p <= q -> continuous_on (from_to p q) g -> g p <= top <= g q ->
  exists r, p <= r <= q /\ g r = top /\ forall t, p <= t <= r -> g t <= top.
Proof.
  intros pq cont [low high]. set (E := fun t => p <= t <= q /\ forall x, p <= x <= t -> g x <= top).
  assert (Ep : E p). { split; [lra|]. intros x hx. replace x with p by lra. exact low. }
  destruct (completeness E) as (r & upper & least); [exists q; intros t [ht _]; lra|exists p; exact Ep|].
  assert (pr : p <= r) by exact (upper p Ep). assert (rq : r <= q) by (apply least; intros t [ht _]; lra).
  assert (before : forall t, p <= t < r -> g t <= top).
  { intros t ht. apply NNPP. intros n. assert (r <= t); [|lra]. apply least. intros x [hx below].
    apply Rnot_lt_le. intros tx. apply n, below. lra. }
  rewrite on_balls in cont.
  assert (close : forall eps : posreal, exists del : posreal, forall y, p <= y <= q -> Rabs (y - r) < del -> Rabs (g y - g r) < eps).
  { intros eps. destruct (cont r (conj pr rq) eps) as [del near]. exists del. intros y hy b. exact (near y b hy). }
  assert (at_most : g r <= top).
  { apply Rnot_lt_le. intros above. destruct (close (mkposreal (g r - top) ltac:(lra))) as [del near]. cbn in near.
    assert (del_pos := cond_pos del). destruct (Req_dec p r) as [<-|n]; [lra|].
    set (y := Rmax p (r - del / 2)). assert (p <= y < r) by (unfold y; split; [apply Rmax_l|apply Rmax_lub_lt; lra]).
    assert (r - del / 2 <= y) by apply Rmax_r. specialize (before y H).
    specialize (near y ltac:(lra) ltac:(apply Rabs_def1; lra)). apply Rabs_def2 in near. lra. }
  exists r. split; [lra|]. assert (top <= g r).
  { apply Rnot_lt_le. intros below. destruct (close (mkposreal (top - g r) ltac:(lra))) as [del near]. cbn in near.
    assert (del_pos := cond_pos del). assert (n : r < q) by (destruct (Req_dec r q) as [->|]; lra).
    set (y := Rmin q (r + del / 2)). assert (r < y <= q) by (unfold y; split; [apply Rmin_glb_lt; lra|apply Rmin_l]).
    assert (y <= r + del / 2) by apply Rmin_r.
    assert (E y); [|specialize (upper y H1); lra]. split; [lra|]. intros x hx. destruct (Rlt_le_dec x r); [apply before; lra|].
    specialize (near x ltac:(lra) ltac:(apply Rabs_def1; lra)). apply Rabs_def2 in near. lra. }
  split; [lra|]. intros t ht. destruct (Req_dec t r) as [->|]; [exact at_most|]. apply before. lra.
Qed.

Lemma on_opposite (g : R -> R) (S : R -> Prop) : continuous_on S g -> continuous_on S (fun t => - g t).
Proof.
  intros h. apply (on_comp S (fun _ => True) g Ropp); auto. apply continuous_on_forall. intros x _.
  apply (continuous_opp (fun x : R => x)), continuous_id.
Qed.
(* One that goes from one height to another does so on a part where it stays between them. *)
Lemma climb (g : R -> R) p q lo hi : p <= q -> lo <= hi -> continuous_on (from_to p q) g -> g p <= lo -> hi <= g q ->
  exists p' q', p <= p' /\ p' <= q' /\ q' <= q /\ g p' = lo /\ g q' = hi /\ forall t, p' <= t <= q' -> lo <= g t <= hi.
Proof.
  intros pq lohi cont low high. destruct (first_reach g p q hi pq cont ltac:(lra)) as (q' & hq & at_hi & below).
  destruct (first_reach (fun t => - g (- t)) (- q') (- p) (- lo)) as (r & hr & at_lo & above).
  - lra.
  - apply (on_comp _ (from_to p q) Ropp (fun t => - g t)).
    + apply continuous_on_forall. intros x _. apply (continuous_opp (fun x : R => x)), continuous_id.
    + apply on_opposite, cont.
    + unfold from_to. intros x hx. lra.
  - rewrite !Ropp_involutive. lra.
  - exists (- r), q'. repeat split; try lra.
    + specialize (above (- t) ltac:(lra)). rewrite Ropp_involutive in above. lra.
    + apply below. lra.
Qed.
Definition goes (g : R -> R) (p q lo hi : R) : Prop := (g p <= lo /\ hi <= g q) \/ (g q <= lo /\ hi <= g p).
Lemma between (g : R -> R) p q lo hi : p <= q -> lo <= hi -> continuous_on (from_to p q) g -> goes g p q lo hi ->
  exists p' q', p <= p' /\ p' <= q' /\ q' <= q /\ ((g p' = lo /\ g q' = hi) \/ (g p' = hi /\ g q' = lo)) /\ forall t, p' <= t <= q' -> lo <= g t <= hi.
Proof.
  intros pq lohi cont [[a b]|[a b]].
  - destruct (climb g p q lo hi pq lohi cont a b) as (p' & q' & h1 & h2 & h3 & h4 & h5 & h6). exists p', q'. auto 10.
  - destruct (climb (fun t => - g t) p q (- hi) (- lo) pq ltac:(lra) (on_opposite _ _ cont) ltac:(lra) ltac:(lra)) as (p' & q' & h1 & h2 & h3 & h4 & h5 & h6).
    exists p', q'. repeat split; try assumption; [right; lra|specialize (h6 t ltac:(lra)); lra|specialize (h6 t ltac:(lra)); lra].
Qed.

(* Closed sets of an interval, each in the one before, have a common point. *)
Lemma common (p q : R) (S : nat -> R -> Prop) : (forall n, closed (S n)) -> (forall n t, S n t -> from_to p q t) ->
  (forall n m t, (n <= m)%nat -> S m t -> S n t) -> (forall n, exists t, S n t) -> exists t, forall n, S n t.
Proof.
  intros shut inside nested some.
  set (E := fun t => exists n, forall x, S n x -> t <= x).
  destruct (completeness E) as (t & upper & least).
  - exists q. intros t [n below]. destruct (some n) as [x hx]. specialize (below x hx). specialize (inside n x hx). unfold from_to in inside. lra.
  - exists p. exists O. intros x hx. exact (proj1 (inside _ _ hx)).
  - exists t. intros n. apply (shut n). intros [eps out]. assert (eps_pos := cond_pos eps).
    assert (exists t0, E t0 /\ t - eps / 2 < t0) as (t0 & [m below] & near).
    { apply NNPP. intros none. assert (t <= t - eps / 2); [|lra]. apply least. intros x hx. apply Rnot_lt_le. intros lt. apply none. exists x. auto. }
    assert (exists x, S (max n m) x /\ x < t + eps / 2) as (x & hx & close).
    { apply NNPP. intros none. assert (t + eps / 2 <= t); [|lra]. apply upper. exists (max n m). intros x hx. apply Rnot_lt_le. intros lt. apply none. exists x. auto. }
    assert (t0 <= x) by (apply below; apply (nested m (max n m)); [lia|exact hx]).
    apply (out x).
    + change (Rabs (x - t) < eps). apply Rabs_def1; lra.
    + apply (nested n (max n m)); [lia|exact hx].
Qed.

(* Parallelograms of the plane: centre + xi long + eta wide, |xi|, |eta| <= 1. *)
Definition state := (R * R)%type.
Record frame := { centre : state; long : state; wide : state }.
Definition area (N : frame) : R := fst (long N) * snd (wide N) - snd (long N) * fst (wide N).
Definition along_area (N : frame) (x : state) : R := snd (wide N) * (fst x - fst (centre N)) - fst (wide N) * (snd x - snd (centre N)).
Definition across_area (N : frame) (x : state) : R := fst (long N) * (snd x - snd (centre N)) - snd (long N) * (fst x - fst (centre N)).
Definition along (N : frame) (x : state) : R := along_area N x / area N.
Definition across (N : frame) (x : state) : R := across_area N x / area N.
Definition put (N : frame) (xi eta : R) : state :=
  (fst (centre N) + fst (long N) * xi + fst (wide N) * eta, snd (centre N) + snd (long N) * xi + snd (wide N) * eta).
(* The slice a <= xi <= b. *)
Definition slice (N : frame) (a b : R) (x : state) : Prop := a <= along N x <= b /\ -1 <= across N x <= 1.
Definition in_frame (N : frame) : state -> Prop := slice N (-1) 1.

Lemma put_along N xi eta : area N <> 0 -> along N (put N xi eta) = xi.
Proof. intros h. unfold along, along_area, put. cbn [fst snd]. unfold area in *. field. exact h. Qed.
Lemma put_across N xi eta : area N <> 0 -> across N (put N xi eta) = eta.
Proof. intros h. unfold across, across_area, put. cbn [fst snd]. unfold area in *. field. exact h. Qed.
Lemma put_back N x : area N <> 0 -> put N (along N x) (across N x) = x.
Proof. intros h. destruct x as [u v]. unfold put, along, across, along_area, across_area. cbn [fst snd]. unfold area in *. apply injective_projections; cbn [fst snd]; field; exact h. Qed.

Lemma linear_continuous (a b c : R) (x : state) : continuous (fun x : state => a * fst x + b * snd x + c) x.
Proof.
  destruct x as [u v].
  apply (continuous_plus (fun x : state => a * fst x + b * snd x) (fun _ => c)); [|apply continuous_const].
  apply (continuous_plus (fun x : state => a * fst x) (fun x : state => b * snd x)).
  - apply (continuous_mult (fun _ : state => a) (fun x : state => fst x)); [apply continuous_const|apply continuous_fst].
  - apply (continuous_mult (fun _ : state => b) (fun x : state => snd x)); [apply continuous_const|apply continuous_snd].
Qed.
Lemma along_continuous N x : continuous (along N) x.
Proof.
  apply (continuous_ext (fun x : state => snd (wide N) / area N * fst x + - fst (wide N) / area N * snd x
    + (fst (wide N) * snd (centre N) - snd (wide N) * fst (centre N)) / area N)); [|apply linear_continuous].
  intros [u v]. unfold along, along_area, Rdiv. cbn [fst snd]. match goal with |- ?l = ?r => change (@eq R l r) end. ring.
Qed.
Lemma across_continuous N x : continuous (across N) x.
Proof.
  apply (continuous_ext (fun x : state => - snd (long N) / area N * fst x + fst (long N) / area N * snd x
    + (snd (long N) * fst (centre N) - fst (long N) * snd (centre N)) / area N)); [|apply linear_continuous].
  intros [u v]. unfold across, across_area, Rdiv. cbn [fst snd]. match goal with |- ?l = ?r => change (@eq R l r) end. ring.
Qed.
Lemma closed_slice N a b : closed (slice N a b).
Proof.
  apply closed_and.
  - apply (closed_comp (along N) (fun r => a <= r <= b)); [apply along_continuous|apply closed_from_to].
  - apply (closed_comp (across N) (fun r => -1 <= r <= 1)); [apply across_continuous|apply closed_from_to].
Qed.

(* The path c crosses the parallelogram while its parameter runs from p to q. *)
Definition crosses (N : frame) (c : R -> state) (p q : R) : Prop := p <= q /\ continuous_on (from_to p q) c /\
  (forall t, p <= t <= q -> in_frame N (c t)) /\
  ((along N (c p) = -1 /\ along N (c q) = 1) \/ (along N (c p) = 1 /\ along N (c q) = -1)).

(* g carries N across M, on a closed set S where it is continuous: so that a part of every path that crosses N is in S, and
   has an image that crosses M. *)
Definition carries (N M : frame) (S : state -> Prop) (g : state -> state) : Prop := closed S /\ continuous_on S g /\
  forall c p q, crosses N c p q -> exists p' q', p <= p' /\ q' <= q /\ (forall t, p' <= t <= q' -> S (c t)) /\ crosses M (fun t => g (c t)) p' q'.

Lemma carries_nothing N : carries N N (fun _ => True) (fun x => x).
Proof.
  split; [apply closed_true|]. split; [apply continuous_on_forall; intros; apply continuous_id|].
  intros c p q h. exists p, q. split; [lra|]. split; [lra|]. split; [auto|exact h].
Qed.
Lemma carries_then N M O S T g h : carries N M S g -> carries M O T h ->
  carries N O (fun x => S x /\ T (g x)) (fun x => h (g x)).
Proof.
  intros (shut & cont & cross) (shut' & cont' & cross'). split; [exact (closed_part S T g shut cont shut')|]. split.
  - apply (on_comp _ T g h); [|exact cont'|tauto]. apply (on_part S); tauto.
  - intros c p q hc. destruct (cross c p q hc) as (p1 & q1 & a & b & inside & hc1).
    destruct (cross' _ p1 q1 hc1) as (p2 & q2 & a' & b' & inside' & hc2).
    exists p2, q2. split; [lra|]. split; [lra|]. split; [|exact hc2]. intros t ht. split; [apply inside; destruct hc1; lra|apply inside'; exact ht].
Qed.

(* The covering relation: the ends of a slice of N go beyond the two ends of M, and all of it between M's other edges. *)
Theorem covering (N M : frame) (a b sign : R) (g : state -> state) : -1 <= a -> a <= b -> b <= 1 -> sign = 1 \/ sign = -1 ->
  continuous_on (slice N a b) g -> (forall x, slice N a b x -> -1 <= across M (g x) <= 1) ->
  (forall x, slice N a b x -> along N x = a -> sign * along M (g x) <= -1) ->
  (forall x, slice N a b x -> along N x = b -> 1 <= sign * along M (g x)) ->
  carries N M (fun x => slice N a b x /\ in_frame M (g x)) g.
Proof.
  intros ha ab hb sg cont flat left_end right_end.
  split; [exact (closed_part _ _ g (closed_slice N a b) cont (closed_slice M _ _))|].
  split; [apply (on_part (slice N a b)); [tauto|exact cont]|].
  intros c p q (pq & path & inside & ends).
  assert (xi : continuous_on (from_to p q) (fun t => along N (c t))).
  { apply (on_comp _ (fun _ => True) c (along N)); auto. apply continuous_on_forall. intros. apply along_continuous. }
  destruct (between (fun t => along N (c t)) p q a b pq ab xi) as (p1 & q1 & h1 & h2 & h3 & ends1 & part).
  { unfold goes. destruct ends as [[-> ->]|[-> ->]]; lra. }
  assert (on : forall t, p1 <= t <= q1 -> slice N a b (c t)).
  { intros t ht. split; [exact (part t ht)|]. apply inside. lra. }
  assert (image : continuous_on (from_to p1 q1) (fun t => g (c t))).
  { apply (on_comp _ (slice N a b) c g); [|exact cont|exact on]. apply (on_part (from_to p q)); [unfold from_to; intros; lra|exact path]. }
  assert (xi' : continuous_on (from_to p1 q1) (fun t => along M (g (c t)))).
  { apply (on_comp _ (fun _ => True) (fun t => g (c t)) (along M)); auto. apply continuous_on_forall. intros. apply along_continuous. }
  destruct (between (fun t => along M (g (c t))) p1 q1 (-1) 1 h2 ltac:(lra) xi') as (p2 & q2 & k1 & k2 & k3 & ends2 & part2).
  { assert (o1 := on p1 ltac:(lra)). assert (o2 := on q1 ltac:(lra)). unfold goes.
    destruct ends1 as [[e1 e2]|[e1 e2]]; [specialize (left_end _ o1 e1); specialize (right_end _ o2 e2)|specialize (right_end _ o1 e1); specialize (left_end _ o2 e2)];
      destruct sg as [->| ->]; lra. }
  assert (inside2 : forall t, p2 <= t <= q2 -> in_frame M (g (c t))).
  { intros t ht. split; [apply part2; lra|]. apply flat, on. lra. }
  exists p2, q2. split; [lra|]. split; [lra|]. split; [intros t ht; split; [apply on; lra|apply inside2; lra]|].
  split; [exact k2|]. split; [apply (on_part (from_to p1 q1)); [unfold from_to; intros; lra|exact image]|].
  split; [exact inside2|]. destruct ends2 as [[-> ->]|[-> ->]]; auto.
Qed.

(* A sequence of such maps is followed for ever. *)
Section Follow.
Variables (N : nat -> frame) (S : nat -> state -> Prop) (g : nat -> state -> state).
Hypothesis carried : forall n, carries (N n) (N (Datatypes.S n)) (S n) (g n).
Fixpoint visit (n : nat) (x : state) : state := match n with O => x | Datatypes.S n => g n (visit n x) end.

Variables (c : R -> state) (p q : R).
Hypothesis crossing : crosses (N 0%nat) c p q.
Let stays (n : nat) (t : R) : Prop := from_to p q t /\ forall k, (k < n)%nat -> S k (visit k (c t)).

Lemma stays_next n t : stays (Datatypes.S n) t <-> stays n t /\ S n (visit n (c t)).
Proof.
  unfold stays. split.
  - intros [h k]. split; [split; [exact h|intros j hj; apply k; lia]|apply k; lia].
  - intros [[h k] l]. split; [exact h|]. intros j hj. destruct (Nat.eq_dec j n) as [->|]; [exact l|apply k; lia].
Qed.
Lemma stays_closed n : closed (stays n) /\ continuous_on (stays n) (fun t => visit n (c t)).
Proof.
  induction n as [|n [shut cont]].
  - split; [apply (closed_ext (from_to p q)); [|apply closed_from_to]|apply (on_part (from_to p q)); [|apply crossing]].
    + intros t. unfold stays. split; [intros h; split; [exact h|lia]|tauto].
    + intros t h. apply h.
  - destruct (carried n) as (shut' & cont' & _). split.
    + apply (closed_ext (fun t => stays n t /\ S n (visit n (c t)))); [intros t; symmetry; apply stays_next|]. exact (closed_part _ _ _ shut cont shut').
    + cbn [visit]. apply (on_comp _ (S n) (fun t => visit n (c t)) (g n)); [|exact cont'|intros t h; apply stays_next in h; tauto].
      apply (on_part (stays n)); [|exact cont]. intros t h. apply stays_next in h. tauto.
Qed.
Lemma stays_some n : exists p' q', p <= p' /\ q' <= q /\ (forall t, p' <= t <= q' -> stays n t) /\ crosses (N n) (fun t => visit n (c t)) p' q'.
Proof.
  induction n as [|n (p1 & q1 & a & b & inside & hc)].
  - exists p, q. split; [lra|]. split; [lra|]. split; [|exact crossing]. intros t h. split; [exact h|lia].
  - destruct (carried n) as (_ & _ & cross). destruct (cross _ _ _ hc) as (p2 & q2 & a2 & b2 & inside2 & hc2).
    exists p2, q2. split; [lra|]. split; [lra|]. split; [|exact hc2]. intros t h. apply stays_next. split; [apply inside; lra|apply inside2; exact h].
Qed.
Theorem followed : exists t, p <= t <= q /\ forall n, S n (visit n (c t)).
Proof.
  destruct (common p q stays) as [t h].
  - intros n. apply stays_closed.
  - intros n t h. apply h.
  - intros n m t nm [h k]. split; [exact h|]. intros j hj. apply k. lia.
  - intros n. destruct (stays_some n) as (p' & q' & _ & _ & h & hc). exists p'. apply h. destruct hc as [hc _]. lra.
  - exists t. split; [apply (h O)|]. intros n. apply (h (Datatypes.S n)). lia.
Qed.
End Follow.

(* The paths along a parallelogram. *)
Lemma crosses_at N eta : area N <> 0 -> -1 <= eta <= 1 -> crosses N (fun t => put N t eta) (-1) 1.
Proof.
  intros h level. split; [lra|]. split.
  - apply on_pair; apply continuous_on_forall; intros t _;
      match goal with |- continuous (fun x => ?a + ?b * x + ?c) t => apply (continuous_ext (fun x => b * x + (a + c))); [intros x; match goal with |- ?l = ?r => change (@eq R l r) end; ring|];
        apply (continuous_plus (fun x => b * x) (fun _ => a + c)); [apply (continuous_mult (fun _ => b) (fun x : R => x)); [apply continuous_const|apply continuous_id]|apply continuous_const] end.
  - rewrite !put_along by exact h. split; [|left; lra]. intros t ht. unfold in_frame, slice. rewrite put_along, put_across by exact h. lra.
Qed.

Lemma iter_next {X : Type} (f : X -> X) n x : Nat.iter n f (f x) = Nat.iter (S n) f x.
Proof. induction n as [|n IH]; [reflexivity|]. exact (f_equal f IH). Qed.

(* The map R on a set L has the full shift on two symbols as a factor: L is closed and bounded, R is continuous there and does not leave it; each
   point of L has a sequence of letters, of which the first n are the same for all points of L near enough; R shifts the sequence; and every
   sequence is that of a point. *)
Definition itinerary (letter : state -> bool) (R : state -> state) (x : state) (n : nat) : bool := letter (Nat.iter n R x).
Record full_shift_factor (L : state -> Prop) (letter : state -> bool) (R : state -> state) : Prop := {
  factor_closed : closed L;
  factor_bounded : exists size, forall x, L x -> Rabs (fst x) <= size /\ Rabs (snd x) <= size;
  factor_invariant : forall x, L x -> L (R x);
  factor_continuous : continuous_on L R;
  factor_letters : forall x, L x -> forall n, locally x (fun y => L y -> forall k, (k <= n)%nat -> itinerary letter R y k = itinerary letter R x k);
  factor_shift : forall x n, itinerary letter R (R x) n = itinerary letter R x (S n);
  factor_onto : forall letters : nat -> bool, exists x, L x /\ forall n, itinerary letter R x n = letters n }.

(* Two words, one for each letter; parallelograms for the next three letters; S for the next four. *)
Section Horseshoe.
Variable base : bool -> bool -> bool -> frame.
Variable S : bool -> bool -> bool -> bool -> state -> Prop.
Variable word : bool -> state -> state.
Variable letter : state -> bool.
Hypothesis base_area : forall a b c, area (base a b c) <> 0.
Hypothesis carried : forall a b c d, carries (base a b c) (base b c d) (S a b c d) (word a).
Hypothesis told : forall a b c d x, S a b c d x -> letter x = a.
Hypothesis bounded : exists size, forall a b c d x, S a b c d x -> Rabs (fst x) <= size /\ Rabs (snd x) <= size.

Definition return_map (x : state) : state := word (letter x) x.
Definition starting (x : state) : Prop := exists a b c d, S a b c d x.
Definition followers (x : state) : Prop := forall n, starting (Nat.iter n return_map x).

(* The starts of one letter. *)
Let starts (a : bool) (x : state) : Prop := ((S a true true true x \/ S a true true false x) \/ (S a true false true x \/ S a true false false x)) \/
  ((S a false true true x \/ S a false true false x) \/ (S a false false true x \/ S a false false false x)).
Lemma starts_some a x : starts a x <-> exists b c d, S a b c d x.
Proof.
  unfold starts. split; [intros [[[h|h]|[h|h]]|[[h|h]|[h|h]]]; do 3 eexists; exact h|].
  intros (b & c & d & h). destruct b, c, d; tauto.
Qed.
Lemma starts_letter a x : starts a x -> letter x = a.
Proof. intros h. apply starts_some in h. destruct h as (b & c & d & h). exact (told _ _ _ _ _ h). Qed.
Lemma starts_closed a : closed (starts a).
Proof. unfold starts. repeat apply closed_either; apply carried. Qed.
Lemma word_continuous a : continuous_on (starts a) (word a).
Proof. unfold starts. repeat apply on_either; repeat apply closed_either; try apply carried; apply (carried a). Qed.
Lemma starting_either x : starting x <-> starts true x \/ starts false x.
Proof.
  rewrite !starts_some. unfold starting. split.
  - intros (a & b & c & d & h). destruct a; [left|right]; exists b, c, d; exact h.
  - intros [(b & c & d & h)|(b & c & d & h)]; do 4 eexists; exact h.
Qed.
Lemma starting_closed : closed starting.
Proof.
  apply (closed_ext (fun x => starts true x \/ starts false x)); [intros x; symmetry; apply starting_either|].
  apply closed_either; apply starts_closed.
Qed.
Lemma return_continuous : continuous_on starting return_map.
Proof.
  apply (on_part (fun x => starts true x \/ starts false x)); [intros x; apply starting_either|].
  apply on_either; try apply starts_closed;
    (eapply continuous_on_ext; [|apply word_continuous]; intros x h; unfold return_map; rewrite (starts_letter _ _ h); reflexivity).
Qed.
Lemma followers_return x : followers x -> followers (return_map x).
Proof. intros h n. rewrite iter_next. apply h. Qed.
Lemma iter_continuous n : continuous_on followers (Nat.iter n return_map).
Proof.
  induction n as [|n IH]; cbn; [apply continuous_on_forall; intros; apply continuous_id|].
  apply (on_comp _ starting (fun x => Nat.iter n return_map x) return_map); [exact IH|exact return_continuous|]. intros x h. apply h.
Qed.
Lemma followers_closed : closed followers.
Proof.
  set (upto := fun n x => forall k, (k <= n)%nat -> starting (Nat.iter k return_map x)).
  assert (all : forall n, closed (upto n) /\ continuous_on (upto n) (Nat.iter n return_map)).
  { induction n as [|n [shut cont]].
    - split; [|apply continuous_on_forall; intros; apply continuous_id]. apply (closed_ext starting); [|apply starting_closed].
      intros x. split; [intros h k hk; replace k with O by lia; exact h|intros h; apply (h O); lia].
    - assert (cont' : continuous_on (upto n) (Nat.iter (Datatypes.S n) return_map)).
      { apply (on_comp _ starting (fun x => Nat.iter n return_map x) return_map); [exact cont|exact return_continuous|]. intros x h. apply h. lia. }
      split; [|apply (on_part (upto n)); [intros x h k hk; apply h; lia|exact cont']].
      apply (closed_ext (fun x => upto n x /\ starting (Nat.iter (Datatypes.S n) return_map x))); [|exact (closed_part _ _ _ shut cont' starting_closed)].
      intros x. split.
      + intros [h k] j hj. destruct (Nat.eq_dec j (Datatypes.S n)) as [->|]; [exact k|apply h; lia].
      + intros h. split; [intros j hj; apply h; lia|apply h; lia]. }
  intros x near n. apply (proj1 (all n)); [|lia]. intros [eps out]. apply near. exists eps. intros y b h. apply (out y b). intros k _. apply h.
Qed.
Lemma letter_near x : starting x -> locally x (fun y => starting y -> letter y = letter x).
Proof.
  intros h. assert (alone : forall a, letter x = a -> locally x (fun y => ~ starts (negb a) y)).
  { intros a e. apply outside; [apply starts_closed|]. intros s. apply starts_letter in s. destruct a; cbn in s; congruence. }
  specialize (alone _ eq_refl). apply (filter_imp (F := locally x)) with (2 := alone). intros y n s. apply starting_either in s.
  destruct s as [s|s]; assert (l := starts_letter _ _ s); destruct (letter x); cbn in n; congruence || tauto.
Qed.
Lemma itinerary_near x : followers x -> forall n, locally x (fun y => followers y -> forall k, (k <= n)%nat -> itinerary letter return_map y k = itinerary letter return_map x k).
Proof.
  intros h. assert (one : forall k, locally x (fun y => followers y -> itinerary letter return_map y k = itinerary letter return_map x k)).
  { intros k. destruct (letter_near _ (h k)) as [eps near]. destruct (proj1 (on_balls _ _) (iter_continuous k) x h eps) as [del close].
    exists del. intros y b fy. apply near; [exact (close y b fy)|apply fy]. }
  induction n as [|n IH].
  - apply (filter_imp (F := locally x)) with (2 := one O). intros y e fy k hk. replace k with O by lia. exact (e fy).
  - apply (filter_imp (F := locally x)) with (2 := filter_and _ _ IH (one (Datatypes.S n))). intros y [e e'] fy k hk.
    destruct (Nat.eq_dec k (Datatypes.S n)) as [->|]; [exact (e' fy)|apply e; [exact fy|lia]].
Qed.
Lemma every_sequence (letters : nat -> bool) : exists x, followers x /\ forall n, itinerary letter return_map x n = letters n.
Proof.
  set (N := fun n => base (letters n) (letters (1 + n)%nat) (letters (2 + n)%nat)).
  set (T := fun n => S (letters n) (letters (1 + n)%nat) (letters (2 + n)%nat) (letters (3 + n)%nat)).
  set (g := fun n => word (letters n)).
  assert (path : crosses (N O) (fun t => put (N O) t 0) (-1) 1) by (apply crosses_at; [apply base_area|lra]).
  destruct (followed N T g (fun n => carried _ _ _ _) _ _ _ path) as (t & _ & h). set (x := put (N O) t 0) in *.
  assert (same : forall n, Nat.iter n return_map x = visit g n x).
  { induction n as [|n IH]; [reflexivity|]. change (return_map (Nat.iter n return_map x) = g n (visit g n x)). rewrite IH.
    unfold return_map, g at 2. rewrite (told _ _ _ _ _ (h n)). reflexivity. }
  exists x. split.
  - intros n. rewrite same. repeat eexists. exact (h n).
  - intros n. unfold itinerary. rewrite same. exact (told _ _ _ _ _ (h n)).
Qed.
Theorem horseshoe : full_shift_factor followers letter return_map.
Proof.
  split.
  - exact followers_closed.
  - destruct bounded as [size h]. exists size. intros x f. destruct (f O) as (a & b & c & d & s). exact (h _ _ _ _ _ s).
  - exact followers_return.
  - apply (on_part starting); [intros x h; exact (h O)|exact return_continuous].
  - exact itinerary_near.
  - intros x n. unfold itinerary. rewrite iter_next. reflexivity.
  - exact every_sequence.
Qed.
End Horseshoe.
