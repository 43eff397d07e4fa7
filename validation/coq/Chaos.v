(* Words of the impact map, and the motions that follow them, as `chaos` lists them: the claims of a document (`claims_chaos`). States are seen
   from the left wall (Region.v). An h-set is a convex quadrilateral of phases and speeds. A word leads from one h-set to another, by flights to
   the far wall and back to the near one; it takes half cycles, half forcing periods that is, and the difference of the phases in the two h-sets. *)
From Coq Require Import Reals List ZArith QArith Qreals Bool.
From ImpactPair Require Import Model Step Certificate Document Cycle Region.
Open Scope R_scope.
Import ListNotations.

(* Corners have a phase, in forcing periods, and a speed over A W. The middle and the half vectors that expand and contract have phases in radians. *)
Record h_set := H_set { left_bottom : Q * Q; left_top : Q * Q; right_bottom : Q * Q; right_top : Q * Q; set_middle : Q * Q; set_expanding : Q * Q; set_contracting : Q * Q }.
(* Flights in the order of time: true to the far wall, false back to the near one. *)
Record word := Word { word_from : nat; word_into : nat; word_flights : list bool; half_cycles : Z }.
(* Entropies in nats; two words that are blocks which may follow one another in any order, those with the fewest impacts. *)
Record chaos := Chaos { h_sets : list h_set; words : list word; per_impact : Q; per_cycle : Q; blocks : option (nat * nat) }.

(* On the left of the edge from a to b, or on it. *)
Definition left_of (a b : Q * Q) (u w : R) : Prop :=
  0 <= (Q2R (fst b) - Q2R (fst a)) * (w - Q2R (snd a)) - (Q2R (snd b) - Q2R (snd a)) * (u - Q2R (fst a)).
Definition edges (h : h_set) : list ((Q * Q) * (Q * Q)) :=
  [(left_bottom h, right_bottom h); (right_bottom h, right_top h); (right_top h, left_top h); (left_top h, left_bottom h)].
Definition in_set (h : h_set) (th w : R) : Prop := List.Forall (fun edge => left_of (fst edge) (snd edge) (th / (2 * PI)) w) (edges h).

Definition no_set : h_set := let o := (0%Q, 0%Q) in H_set o o o o o o o.
Definition no_word : word := Word O O [] 0.
Definition set_of (x : chaos) (n : nat) : h_set := nth n (h_sets x) no_set.
Definition word_of (x : chaos) (n : nat) : word := nth n (words x) no_word.

(* No state is in two h-sets, nor with two phases, whole forcing periods apart, in one. *)
Definition disjoint_sets (x : chaos) : Prop := forall i j th w (k : Z), (i < length (h_sets x))%nat -> (j < length (h_sets x))%nat ->
  in_set (set_of x i) th w -> in_set (set_of x j) (th + IZR k * (2 * PI)) w -> i = j /\ k = 0%Z.
(* The listed middle and half vectors are those of the corners, to nine digits. *)
Definition nearly (a b : R) : Prop := Rabs (a - b) <= / 10 ^ 9.
Definition mean (f : Q * Q -> R) (a b : Q * Q) : R := (f a + f b) / 2.
Definition phase_of (c : Q * Q) : R := 2 * PI * Q2R (fst c).
Definition speed_of (c : Q * Q) : R := Q2R (snd c).
Definition as_listed (h : h_set) : Prop := let lb := left_bottom h in let lt := left_top h in let rb := right_bottom h in let rt := right_top h in
  let along (f : Q * Q -> R) := (mean f rb rt - mean f lb lt) / 2 in let across (f : Q * Q -> R) := (mean f lt rt - mean f lb rb) / 2 in
  let all (f : Q * Q -> R) := (mean f lb lt + mean f rb rt) / 2 in
  nearly (all phase_of) (Q2R (fst (set_middle h))) /\ nearly (all speed_of) (Q2R (snd (set_middle h))) /\
  nearly (along phase_of) (Q2R (fst (set_expanding h))) /\ nearly (along speed_of) (Q2R (snd (set_expanding h))) /\
  nearly (across phase_of) (Q2R (fst (set_contracting h))) /\ nearly (across speed_of) (Q2R (snd (set_contracting h))).

Definition wall_after (far : bool) (w : wall) : wall := if far then opposite w else w.

Section Scene.
Variable s : scene.

(* The impacts J 0, J 1, ... follow a word, from the phase th in its h-set to the phase th1 in the next one: each is the first contact after the one before, on the wall that the
   word says. *)
Definition follows_word (x : chaos) (w : word) (th th1 : R) (J : nat -> impact) : Prop := let last := J (length (word_flights w)) in
  in_set (set_of x (word_from w)) th (speed_seen s (J O)) /\ in_set (set_of x (word_into w)) th1 (speed_seen s last) /\
  (exists turns, phase_seen s (J O) = th + IZR turns * (2 * PI)) /\
  phase s (time last) - phase s (time (J O)) = th1 - th + IZR (half_cycles w) * PI /\
  forall k, (k < length (word_flights w))%nat -> reaches s (rebound s (J k)) (J (S k)) /\ wall_of (J (S k)) = wall_after (nth k (word_flights w) false) (wall_of (J k)).

(* A sequence of words, of which each begins where the one before ends; `next` is that of the numbers of a one-sided sequence, or of a two-sided one. *)
Section Sequences.
Context {X : Type}.
Variable next : X -> X.
Definition fits (x : chaos) (ws : X -> nat) : Prop :=
  forall n, (ws n < length (words x))%nat /\ word_into (word_of x (ws n)) = word_from (word_of x (ws (next n))).
(* The impacts J n 0, J n 1, ... are those of word n of the sequence; its last one is the first one of the next word. *)
Definition follows_words (x : chaos) (ws : X -> nat) (J : X -> nat -> impact) : Prop := exists th, forall n,
  follows_word x (word_of x (ws n)) (th n) (th (next n)) (J n) /\ J n (length (word_flights (word_of x (ws n)))) = J (next n) O.
End Sequences.

(* For every sequence of words that fit, one-sided or two-sided, there is a motion that follows it, from either wall. *)
Definition every_sequence (x : chaos) : Prop := forall ws, fits S x ws -> forall w, exists J, wall_of (J O O) = w /\ follows_words S x ws J.
Definition every_two_sided_sequence (x : chaos) : Prop := forall ws, fits Z.succ x ws -> forall w, exists J, wall_of (J 0%Z O) = w /\ follows_words Z.succ x ws J.

(* The total weight of the first n words of a sequence. *)
Fixpoint total (x : chaos) (weight : word -> Z) (ws : nat -> nat) (n : nat) : Z :=
  match n with O => 0%Z | S n => (total x weight ws n + weight (word_of x (ws n)))%Z end.
Definition impacts_of (w : word) : Z := Z.of_nat (length (word_flights w)).

(* An impact half cycles later, as its mirror image where their number is odd. *)
Definition later_by (half : Z) (i : impact) : impact := let mirrored := Z.odd half in
  {| wall_of := wall_after mirrored (wall_of i); time := time i + IZR half * (period s / 2); velocity := if mirrored then - velocity i else velocity i |}.
(* Every periodic sequence has a motion that repeats after the half cycles of its words, if need be as its mirror image. *)
Definition every_periodic_sequence (x : chaos) : Prop := forall ws m, fits S x ws -> (0 < m)%nat -> (forall n, ws (m + n)%nat = ws n) -> forall w, exists J,
  wall_of (J O O) = w /\ follows_words S x ws J /\
  forall n k, J (m + n)%nat k = later_by (total x half_cycles ws m) (J n k).

(* Two impacts differ by eps in speed over A W, or in phase up to whole forcing periods, as they are seen from the left wall. *)
Definition apart (eps : R) (i j : impact) : Prop := eps <= Rabs (speed_seen s i - speed_seen s j) \/
  forall k, eps <= Rabs (phase_seen s i - phase_seen s j - IZR k * (2 * PI)).
(* The number of motions that are apart within n, impacts or half cycles, grows with n by the factor exp h: the topological entropy, by separated sets (Bowen), is at least h. *)
Definition entropy_at_least (x : chaos) (weight : word -> Z) (h : R) : Prop := exists c eps, 0 < c /\ 0 < eps /\ forall n : nat, exists motions : list ((nat -> nat) * (nat -> nat -> impact)),
  c * exp (h * INR n) <= INR (length motions) /\ (forall ws J, In (ws, J) motions -> fits S x ws /\ follows_words S x ws J) /\
  forall i j ws J ws' J', i <> j -> nth_error motions i = Some (ws, J) -> nth_error motions j = Some (ws', J') ->
    exists m, (forall k, (k < m)%nat -> ws k = ws' k) /\ (total x weight ws m < Z.of_nat n)%Z /\ apart eps (J m O) (J' m O).

(* Words that are one block have the same flights and half cycles. *)
Definition same_block (a b : word) : Prop := word_flights a = word_flights b /\ half_cycles a = half_cycles b.
(* For every sequence of the two blocks there is a motion that follows it. *)
Definition in_any_order (x : chaos) (a b : nat) : Prop := (a < length (words x))%nat /\ (b < length (words x))%nat /\ ~ same_block (word_of x a) (word_of x b) /\
  forall letters : nat -> bool, exists ws, fits S x ws /\ forall n, same_block (word_of x (ws n)) (word_of x (if letters n then a else b)).
End Scene.

(* H-sets from each of which a block leads to one of them. *)
Definition stays (x : chaos) (sets : nat -> Prop) (a : nat) : Prop :=
  forall b, sets b -> exists w, In w (words x) /\ same_block (word_of x a) w /\ word_from w = b /\ sets (word_into w).
(* Two blocks that both stay in some h-sets: they may follow one another in any order. *)
Definition are_free (x : chaos) (a b : nat) : Prop := (a < length (words x))%nat /\ (b < length (words x))%nat /\ ~ same_block (word_of x a) (word_of x b) /\
  exists sets : nat -> Prop, (exists n, sets n) /\ (forall n, sets n -> (n < length (h_sets x))%nat) /\ stays x sets a /\ stays x sets b.
(* Two words of fewer impacts than two others: the longer ones are compared first. *)
Definition fewer (a b a' b' : word) : Prop := let size := fun w => length (word_flights w) in
  let longer := Nat.max (size a) (size b) in let longer' := Nat.max (size a') (size b') in
  (longer < longer')%nat \/ longer = longer' /\ (Nat.min (size a) (size b) < Nat.min (size a') (size b'))%nat.
Definition are_fewest (x : chaos) (a b : nat) : Prop := forall i j, are_free x i j -> ~ fewer (word_of x i) (word_of x j) (word_of x a) (word_of x b).

Definition claims_chaos (p : data) (b : beginning) (x : chaos) : Prop := all_proper p b /\ disjoint_sets x /\ List.Forall as_listed (h_sets x) /\
  match blocks x with None => True | Some (m, n) => in_any_order x m n /\ are_fewest x m n end /\
  forall s, describes p s -> sensible s /\ one_harmonic s /\
    every_sequence s x /\ every_two_sided_sequence s x /\ every_periodic_sequence s x /\
    entropy_at_least s x impacts_of (Q2R (per_impact x)) /\ entropy_at_least s x half_cycles (Q2R (per_cycle x) / 2).
