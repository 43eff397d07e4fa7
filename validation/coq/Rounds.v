(* Rounds of flights from a disc of states, checked by evaluation: a program `check_passages` on Interval's arithmetic, and the proof
   that all flights of the disc are those listed, that images of two states of it differ by a matrix of an enclosure, and that the
   product of the matrices (A.7) is in it.

   Boxes of states lie in the plane (phase, velocity before impact over A W), on the grid of 2^-q. The image of the centre is followed in narrow
   boxes; all others are the centre's plus a matrix times a vector of the disc. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Horseshoe Return Covering Certificate Document Banach Jacobian.
Open Scope R_scope.
Import ListNotations.

Record cell := Cell { at_t : Z; by_t : Z; at_v : Z; by_v : Z }.
Definition lies (q : positive) (B : cell) (x : state) : Prop :=
  grid q (at_t B - by_t B) <= fst x <= grid q (at_t B + by_t B) /\ grid q (at_v B - by_v B) <= snd x <= grid q (at_v B + by_v B).

(* One flight of all states: its wall, a bracket of phases of arrival, where flights are cut, a tilt as in Certificate.v; the boxes of the centre's
   image and of all images. *)
Record passage := Passage { onto : wall; arrives_at : Z; arrives_by : Z; departed : Z; approached : Z; centre_tilt : Z; centre_image : cell; image_of_all : cell }.

Module Rounds (F : FloatOps with Definition sensible_format := true).
Module Import Each := Verifier F.
Import Check.
Local Opaque add sub mul quotient whole hull sine cosine.

Definition holds_each (A : matrix I.type) (M : matrix R) : Prop :=
  holds (m11 A) (m11 M) /\ holds (m12 A) (m12 M) /\ holds (m21 A) (m21 M) /\ holds (m22 A) (m22 M).

Section Program.
Variables p q : positive.
Variable param : data.
Notation step := (unit_step p q).
Notation E := (enclose_range p (restitution param)).
Notation OS := (known_in param p).
Notation G := (gamma_in param p).

Definition multiply (a b : matrix I.type) : matrix I.type := Matrix
  (add p (mul p (m11 a) (m11 b)) (mul p (m12 a) (m21 b))) (add p (mul p (m11 a) (m12 b)) (mul p (m12 a) (m22 b)))
  (add p (mul p (m21 a) (m11 b)) (mul p (m22 a) (m21 b))) (add p (mul p (m21 a) (m12 b)) (mul p (m22 a) (m22 b))).
Lemma holds_multiply a b x y : holds_each a x -> holds_each b y -> holds_each (multiply a b) (times x y).
Proof. intros (h1 & h2 & h3 & h4) (k1 & k2 & k3 & k4). unfold multiply, times, holds_each. cbn [m11 m12 m21 m22]. repeat split; enclose. Qed.

Definition box_of (w : wall) (B : cell) : box := landing p E w q (at_t B) (by_t B) (at_v B) (by_v B).
Definition wide_leg (x : passage) : leg := Leg p p q (onto x) (arrives_at x) (arrives_by x) 0 0 (departed x) (approached x) 0.
Definition centre_leg (x : passage) : leg := let C := centre_image x in
  Leg p p q (onto x) (at_t C) (by_t C) (at_v C) (by_v C) (departed x) (approached x) (centre_tilt x).

(* The entries of (A.7), for all states of a box and phases of the bracket. *)
Definition slopes (w : wall) (B : cell) (x : passage) : matrix I.type :=
  let b := box_of w B in let a := look p OS b p in let m := turns q (arrives_at x) in
  let X := stretch p step (arrives_at x - arrives_by x) (arrives_at x + arrives_by x) in
  let h := sub p X (T b) in let r := rate_over p OS b a m X in let bend1 := box_bend_over p OS m X in
  let by_phase := quotient p (add p (mul p (Bend0 a) h) (U b)) r in let by_velocity := quotient p (mul p E h) r in
  Matrix by_phase by_velocity (sub p (mul p bend1 by_phase) (Bend0 a)) (sub p (mul p bend1 by_velocity) E).

Definition in_cell (X V : I.type) (B : cell) : bool :=
  between p step X (at_t B - by_t B) (at_t B + by_t B) &? between p step V (at_v B - by_v B) (at_v B + by_v B).
Definition phases_of (B : cell) : I.type := stretch p step (at_t B - by_t B) (at_t B + by_t B).
Definition speeds_of (B : cell) : I.type := stretch p step (at_v B - by_v B) (at_v B + by_v B).
Definition unit_interval : I.type := hull (whole p (-1)) (whole p 1).
(* The box of an impact after all flights from a box. *)
Definition lands (w : wall) (B : cell) (l : leg) (C : cell) : bool :=
  (0 <=? by_t B)%Z &? (0 <=? by_v B)%Z &? check_flight param (box_of w B) l &?
  (at_t C =? t l)%Z &? (by_t C =? rt l)%Z &?
  between p step (arrival p OS G (box_of w B) p (look p OS (box_of w B) p) q step (hits l) (t l) (rt l) (tilt l)) (at_v C - by_v C) (at_v C + by_v C).
Definition check_passage (w : wall) (B C : cell) (A : matrix I.type) (x : passage) : bool :=
  let A' := multiply (slopes w B x) A in let C' := centre_image x in
  (0 <=? by_t B)%Z &? (0 <=? by_v B)%Z &? check_flight param (box_of w B) (wide_leg x) &? lands w C (centre_leg x) C' &?
  in_cell (add p (phases_of C') (add p (mul p (m11 A') unit_interval) (mul p (m12 A') unit_interval)))
    (add p (speeds_of C') (add p (mul p (m21 A') unit_interval) (mul p (m22 A') unit_interval))) (image_of_all x).
Fixpoint check_passages (w : wall) (B C : cell) (A : matrix I.type) (way : list passage) : bool :=
  match way with
  | [] => true
  | x :: way => check_passage w B C A x &? check_passages (onto x) (image_of_all x) (centre_image x) (multiply (slopes w B x) A) way
  end.
Fixpoint slopes_at_end (w : wall) (B : cell) (A : matrix I.type) (way : list passage) : matrix I.type :=
  match way with [] => A | x :: way => slopes_at_end (onto x) (image_of_all x) (multiply (slopes w B x) A) way end.
Definition centre_at_end (C : cell) (way : list passage) : cell := fold_left (fun _ x => centre_image x) way C.

Variable s : scene.
Hypothesis described : describes param s.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.
Let os := companions s.
Lemma holds_restitution : holds E (e s).
Proof. apply holds_range, described. Qed.
Lemma others_known : Forall2 knows OS os.
Proof. apply holds_known; assumption. Qed.

Lemma box_holds w B x : (0 <= by_t B)%Z -> (0 <= by_v B)%Z -> lies q B x ->
  in_box (d s / A s) (side w * (d s / A s / 2)) (fst x) (launch_speed s x) (grid q (at_t B)) (- e s * grid q (at_v B)) (box_of w B).
Proof. intros h1 h2 (h3 & h4). apply landing_in; try assumption. exact holds_restitution. Qed.
Lemma holds_cell B x : lies q B x -> holds (phases_of B) (fst x) /\ holds (speeds_of B) (snd x).
Proof. intros (h1 & h2). split; apply (holds_stretch p q _ (unit_step_holds p q)); assumption. Qed.
Lemma in_cell_sound X V B x : in_cell X V B = true -> holds X (fst x) -> holds V (snd x) -> lies q B x.
Proof. unfold in_cell. intros check hX hV. split_checks. split; eapply between_sound; eassumption. Qed.

Lemma flies_all w B l x : (0 <= by_t B)%Z -> (0 <= by_v B)%Z -> lies q B x -> scale l = q -> check_flight param (box_of w B) l = true ->
  flies s w (hits l) x /\ (grid q (t l - rt l) <= fst (fly s w x) <= grid q (t l + rt l)) /\
  forall th, grid q (t l - rt l) <= th <= grid q (t l + rt l) -> 0 < side (hits l) * rate os (fst x) (launch_speed s x) th.
Proof.
  intros h1 h2 inside same check. assert (inb := box_holds w B x h1 h2 inside). set (b := box_of w B) in *.
  assert (inb' : in_box (d s / A s) (place (rebound s (impact_at s w x)) / A s) (phase s (since (rebound s (impact_at s w x))))
      (unit_speed s (speed (rebound s (impact_at s w x)))) (grid q (at_t B)) (- e s * grid q (at_v B)) b).
  { rewrite launch_speed_at, launch_place_at by assumption. cbn [since rebound]. rewrite phase_at by assumption. exact inb. }
  destruct (flight_sound param s described A_positive W_positive b l _ _ _ inb' check) as (i & reached & on & bracket & _ & _ & towards).
  rewrite launch_speed_at in towards by assumption. cbn [since rebound] in towards. rewrite phase_at in towards by assumption. rewrite same in *.
  destruct (flies_to s A_positive W_positive gap_positive w (hits l) x i reached on) as [fl ->]. split; [exact fl|]. split; [exact bracket|exact towards].
Qed.

Lemma slopes_hold w B z x y xi xi' t1 zeta zeta' : (0 <= by_t B)%Z -> (0 <= by_v B)%Z -> lies q B x -> lies q B y ->
  Rmin (fst y) (fst x) <= xi <= Rmax (fst y) (fst x) -> Rmin (fst y) (fst x) <= xi' <= Rmax (fst y) (fst x) ->
  let within_bracket r := grid q (arrives_at z - arrives_by z) <= r <= grid q (arrives_at z + arrives_by z) in
  within_bracket t1 -> within_bracket zeta -> within_bracket zeta' ->
  holds_each (slopes w B z) (entries s (box_bend os xi) (box_bend os zeta') (box_bend os xi') (launch_speed s x) (t1 - xi) (t1 - fst y) (rate os (fst y) (launch_speed s y) zeta)).
Proof.
  intros h1 h2 hx hy r1 r2 within_bracket b1 b2 b3. assert (ix := box_holds w B x h1 h2 hx). assert (iy := box_holds w B y h1 h2 hy).
  set (b := box_of w B) in *. assert (sx := look_seen _ _ _ _ _ _ _ p _ p b others_known ix). assert (sy := look_seen _ _ _ _ _ _ _ p _ p b others_known iy).
  set (a := look p OS b p) in *.
  pose proof ix as (_ & tx & _ & _ & _ & ux & _). pose proof iy as (_ & ty & _).
  assert (hxi : holds (T b) xi) by exact (holds_between _ _ _ _ ty tx r1). assert (hxi' : holds (T b) xi') by exact (holds_between _ _ _ _ ty tx r2).
  destruct (proj1 sx xi hxi) as [bend_xi _]. destruct (proj1 sx xi' hxi') as [bend_xi' _].
  set (X := stretch p step (arrives_at z - arrives_by z) (arrives_at z + arrives_by z)).
  assert (hX : forall r, within_bracket r -> holds X r) by (intros r hr; apply (holds_stretch p q _ (unit_step_holds p q)); exact hr).
  assert (hr := holds_rate _ _ _ _ _ _ _ p OS others_known b iy a sy (turns q (arrives_at z)) X zeta (hX _ b2)).
  assert (hb := holds_box_bend p OS os others_known (turns q (arrives_at z)) X zeta' (hX _ b3)).
  assert (ht := hX _ b1). assert (hE := holds_restitution).
  unfold slopes, entries, holds_each. cbv zeta. fold b a X. cbn [m11 m12 m21 m22]. repeat split; enclose.
Qed.

Lemma slopes_sound w B z x y : (0 <= by_t B)%Z -> (0 <= by_v B)%Z -> check_flight param (box_of w B) (wide_leg z) = true -> lies q B x -> lies q B y ->
  exists M, holds_each (slopes w B z) M /\ minus_ (fly s w x) (fly s w y) = act M (minus_ x y).
Proof.
  intros h1 h2 check hx hy. destruct (flies_all w B (wide_leg z) x h1 h2 hx eq_refl check) as (fx & bx & _).
  destruct (flies_all w B (wide_leg z) y h1 h2 hy eq_refl check) as (fy & by_ & towards).
  destruct (secant s A_positive W_positive w _ x y _ _ fx fy bx by_ towards) as (xi & xi' & zeta & zeta' & r1 & r2 & r3 & r4 & eq).
  eexists. split; [|exact eq]. exact (slopes_hold w B z x y xi xi' _ zeta zeta' h1 h2 hx hy r1 r2 bx r3 r4).
Qed.
Lemma slopes_A7 w B z x : (0 <= by_t B)%Z -> (0 <= by_v B)%Z -> check_flight param (box_of w B) (wide_leg z) = true -> lies q B x ->
  holds_each (slopes w B z) (A7 s w x) /\ snd (fly s w x) <> 0.
Proof.
  intros h1 h2 check hx. destruct (flies_all w B (wide_leg z) x h1 h2 hx eq_refl check) as (fx & bx & towards).
  assert (v := landing_rate s A_positive W_positive w _ x fx). fold os in v. assert (self : Rmin (fst x) (fst x) <= fst x <= Rmax (fst x) (fst x)) by (rewrite Rmin_left, Rmax_left; lra).
  split.
  - unfold A7. cbv zeta. rewrite v at 1. exact (slopes_hold w B z x x (fst x) (fst x) _ _ _ h1 h2 hx hx self self bx bx bx).
  - assert (t0 := towards _ bx). rewrite <- v in t0. intros zero. rewrite zero in t0. lra.
Qed.

Lemma lands_sound w B l C x : bits l = p -> coarse l = p -> scale l = q -> lands w B l C = true -> lies q B x ->
  flies s w (hits l) x /\ lies q C (fly s w x).
Proof.
  intros same1 same2 same check inside. unfold lands in check. split_checks. apply Z.leb_le in k, k0. apply Z.eqb_eq in k2, k3.
  destruct (flies_all w B l x k k0 inside same k1) as (fl & bracket & _). split; [exact fl|]. split; [rewrite k2, k3; exact bracket|].
  assert (inb := box_holds w B x k k0 inside). set (b := box_of w B) in *.
  assert (sx := look_seen _ _ _ _ _ _ _ p _ p b others_known inb).
  assert (rt0 : (0 <= rt l)%Z) by (unfold check_flight in k1; split_checks; unfold check_course in k1; cbv zeta in k1; split_checks; apply Z.leb_le; assumption).
  assert (on := landing_height s A_positive W_positive w (hits l) x fl). unfold height in on. fold os in on.
  assert (v := holds_arrival _ _ _ _ _ _ os p OS others_known _ (holds_gamma param s described p) b inb p _ sx q _ (unit_step_holds p q) (hits l) (t l) (rt l) (tilt l) _ rt0 bracket on).
  assert (arrived := landing_rate s A_positive W_positive w (hits l) x fl). fold os in arrived. rewrite <- arrived in v. exact (between_sound _ _ _ _ _ _ check v).
Qed.

(* States X sigma for all sigma of the disc: in B, that of 0 in C, their differences by A. *)
Definition family (B C : cell) (A : matrix I.type) (X : state -> state) : Prop :=
  (forall x, Cmod x <= 1 -> lies q B (X x)) /\ lies q C (X (0, 0)) /\
  forall x y, Cmod x <= 1 -> Cmod y <= 1 -> exists M, holds_each A M /\ minus_ (X x) (X y) = act M (minus_ x y).

(* The boxes that the flights from a state visit. *)
Fixpoint visits (w : wall) (B : cell) (way : list passage) (x : state) : Prop :=
  lies q B x /\ match way with [] => True | z :: way => visits (onto z) (image_of_all z) way (fly s w x) end.

Lemma zero_inside : Cmod (0, 0) <= 1.
Proof. change (Cmod 0%C <= 1). rewrite Cmod_0. lra. Qed.
Lemma family_next w B C A X z : check_passage w B C A z = true -> family B C A X ->
  (forall x, Cmod x <= 1 -> flies s w (onto z) (X x)) /\ family (image_of_all z) (centre_image z) (multiply (slopes w B z) A) (fun x => fly s w (X x)).
Proof.
  unfold check_passage. cbv zeta. intros check (all & middle & differ). split_checks. apply Z.leb_le in k, k0.
  destruct (lands_sound w C (centre_leg z) (centre_image z) (X (0, 0)) eq_refl eq_refl eq_refl k2 middle) as [_ middle'].
  assert (differ' : forall x y, Cmod x <= 1 -> Cmod y <= 1 -> exists M, holds_each (multiply (slopes w B z) A) M /\ minus_ (fly s w (X x)) (fly s w (X y)) = act M (minus_ x y)).
  { intros x y hx hy. destruct (differ x y hx hy) as (M & hM & eq). destruct (slopes_sound w B z (X x) (X y) k k0 k1 (all x hx) (all y hy)) as (J & hJ & eq').
    exists (times J M). split; [exact (holds_multiply _ _ _ _ hJ hM)|]. rewrite eq', eq, act_times. reflexivity. }
  split; [intros x hx; exact (proj1 (flies_all w B (wide_leg z) (X x) k k0 (all x hx) eq_refl k1))|]. split; [|split; [exact middle'|exact differ']].
  intros x hx. destruct (differ' x (0, 0) hx zero_inside) as (M & (n1 & n2 & n3 & n4) & eq). destruct (holds_cell _ _ middle') as [c1 c2].
  destruct (modulus_at_least x) as [x1 x2].
  assert (u : forall r, Rabs r <= Cmod x -> holds unit_interval r).
  { intros r hr. apply (holds_hull _ _ (-1) 1); try apply (holds_whole p). apply Rabs_le_between. lra. }
  assert (u1 := u _ x1). assert (u2 := u _ x2).
  apply (in_cell_sound _ _ _ _ check).
  - assert (e1 := f_equal fst eq). unfold minus_, act in e1. cbn [fst snd] in e1.
    replace (fst (fly s w (X x))) with (fst (fly s w (X (0, 0))) + (m11 M * fst x + m12 M * snd x)) by lra. enclose.
  - assert (e1 := f_equal snd eq). unfold minus_, act in e1. cbn [fst snd] in e1.
    replace (snd (fly s w (X x))) with (snd (fly s w (X (0, 0))) + (m21 M * fst x + m22 M * snd x)) by lra. enclose.
Qed.

Theorem passages_sound way : forall w B C A X, check_passages w B C A way = true -> family B C A X ->
  (forall x, Cmod x <= 1 -> all_fly s w (map onto way) (X x) /\ visits w B way (X x)) /\
  (exists B', family B' (centre_at_end C way) (slopes_at_end w B A way) (fun x => fly_on s w (map onto way) (X x))) /\
  (forall x K, Cmod x <= 1 -> holds_each A K -> holds_each (slopes_at_end w B A way) (times (monodromy s w (map onto way) (X x)) K)) /\
  (forall x, Cmod x <= 1 -> way <> [] -> snd (fly_on s w (map onto way) (X x)) <> 0 /\
    det (monodromy s w (map onto way) (X x)) * snd (fly_on s w (map onto way) (X x)) = e s ^ (2 * length way) * snd (X x)).
Proof.
  induction way as [|z way IH]; intros w B C A X check fam; cbn [check_passages] in check.
  - pose proof fam as (all & _). split; [intros x hx; split; [exact I|split; [exact (all x hx)|exact I]]|]. split; [exists B; exact fam|].
    split; [|intros x _ no; destruct (no eq_refl)]. intros x K _ hK. cbn [map monodromy slopes_at_end]. replace (times identity K) with K; [exact hK|].
    destruct K. unfold times, identity. cbn. f_equal; ring.
  - split_checks. destruct (family_next w B C A X z k fam) as [fl fam']. pose proof fam as (all & _).
    destruct (IH _ _ _ _ _ check fam') as (I1 & I2 & I3 & I4). unfold check_passage in k. cbv zeta in k. split_checks. apply Z.leb_le in k0, k1.
    cbn [map all_fly visits fly_on monodromy slopes_at_end centre_at_end fold_left].
    split; [intros x hx; destruct (I1 x hx) as [a v]; split; [split; [exact (fl x hx)|exact a]|split; [exact (all x hx)|exact v]]|].
    split; [exact I2|]. split.
    + intros x K hx hK. rewrite times_assoc. apply I3; [exact hx|]. apply holds_multiply; [|exact hK]. exact (proj1 (slopes_A7 w B z (X x) k0 k1 k2 (all x hx))).
    + intros x hx _. destruct (slopes_A7 w B z (X x) k0 k1 k2 (all x hx)) as [_ moves]. assert (one := det_A7 s w _ (X x) (fl x hx) moves).
      destruct way as [|z' way].
      * cbn [map fly_on monodromy length]. split; [exact moves|]. rewrite det_times. replace (det identity) with 1 by (unfold det, identity; cbn; ring). cbn [pow Nat.mul Nat.add] in *. lra.
      * destruct (I4 x hx ltac:(discriminate)) as [last product]. split; [exact last|]. rewrite det_times.
        replace (2 * length (z :: z' :: way))%nat with (2 + 2 * length (z' :: way))%nat by (cbn [length]; lia). rewrite pow_add.
        set (D := det (monodromy s (onto z) (map onto (z' :: way)) (fly s w (X x)))) in *. set (L := snd (fly_on s (onto z) (map onto (z' :: way)) (fly s w (X x)))) in *.
        replace (D * det (A7 s w (X x)) * L) with (det (A7 s w (X x)) * (D * L)) by ring. rewrite product.
        replace (det (A7 s w (X x)) * (e s ^ (2 * length (z' :: way)) * snd (fly s w (X x)))) with (e s ^ (2 * length (z' :: way)) * (det (A7 s w (X x)) * snd (fly s w (X x)))) by ring.
        rewrite one. ring.
Qed.
End Program.
End Rounds.
