(* Documents: the conditions on their data, the claims about impacts and the outcome; and programs that check it, with the proofs that they are
   right. Orbit.v has the documents of orbits from the scene's start, Shadow.v those of orbits that start near it. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Interval Require Import Real.Xreal Float.Sig.
From ImpactPair Require Import Model Certificate.
Open Scope R_scope.
Import ListNotations.

(* The mappings (24)-(27), from wall to wall. *)
Inductive mapping := P1 | P2 | P3 | P4.
Definition mapping_between (a b : wall) : mapping :=
  match a, b with right, left => P1 | left, right => P2 | right, right => P3 | left, left => P4 end.

(* An event is an impact; without a mapping where none is before it. *)
Record event := Event { index : Z; mapped : option mapping; shown : bounds }.
Inductive outcome :=
  | Impacts_reached (impacts : Z)
  | Time_reached (impacts : Z) (until : number)
  | Repeats (impacts : Z) (until : option number) (cycles : Z) (impacts_each : Z).
Record document_of (E : Type) := Document { scene_data : data; begun : beginning; events : list E; ended : outcome }.
Arguments Document {E}.
Arguments scene_data {E}.
Arguments begun {E}.
Arguments events {E}.
Arguments ended {E}.

Definition in_bounds (b : Q * Q) (x : R) : Prop := Q2R (fst b) <= x <= Q2R (snd b).

(* Divisors are not 0, radicands not negative; the interval is not empty. *)
Fixpoint defined (n : number) : Prop :=
  match n with
  | Rational _ | Pi => True
  | Plus a b | Minus a b | Times a b => defined a /\ defined b
  | Over a b => defined a /\ defined b /\ value b <> 0
  | Root a => defined a /\ 0 <= value a
  | Sine a | Cosine a => defined a
  end.
Definition proper (r : range) : Prop := defined (least r) /\ defined (most r) /\ value (least r) <= value (most r).
Definition all_proper (p : data) (b : beginning) : Prop :=
  Forall (fun x => proper (amplitude x) /\ proper (frequency x) /\ proper (shift x)) (leading p :: further p) /\
  proper (gap p) /\ proper (restitution p) /\
  match b with Struck _ t v => proper t /\ proper v | Inside t y v => proper t /\ proper y /\ proper v end.

(* The data of a scene are those of an impact pair: no amplitude is negative, frequencies and gap are positive, 0 <= e <= 1;
   the start is an impact on its wall from inside, or inside the gap. *)
Definition sensible (s : scene) : Prop :=
  Forall (fun h => 0 <= A h /\ 0 < W h) (reference s :: others s) /\ 0 < d s /\ 0 <= e s <= 1.
(* Forcing periods are those of the fastest harmonic, which is the reference. *)
Definition is_fastest (s : scene) : Prop := List.Forall (fun h => W h <= W s) (others s).
Definition starts (b : beginning) (s : scene) : Prop :=
  match b with
  | Struck w _ r => forall v, among r v -> 0 <= side w * v
  | Inside _ r _ => forall y, among r y -> - (d s / 2) < y < d s / 2
  end.

(* The events list the impacts of an orbit, numbered from n. *)
Fixpoint tells (previous : option wall) (n : Z) (events : list event) (orbit : list impact) : Prop :=
  match events, orbit with
  | [], [] => True
  | x :: events, i :: orbit =>
    index x = n /\ mapped x = option_map (fun w => mapping_between w (wall_of i)) previous /\ within (shown x) i /\
    tells (Some (wall_of i)) (n + 1) events orbit
  | _, _ => False
  end.
Definition first_wall (b : beginning) : option wall := match b with Struck w _ _ => Some w | Inside _ _ _ => None end.

(* The launch after an orbit's last impact. *)
Fixpoint after (s : scene) (l : launch) (orbit : list impact) : launch :=
  match orbit with [] => l | i :: rest => after s (rebound s i) rest end.

Definition ends (s : scene) (l : launch) (orbit : list impact) (o : outcome) : Prop :=
  match o with
  | Impacts_reached n => Z.of_nat (length orbit) = n
  | Time_reached n T => defined T /\ Z.of_nat (length orbit) = n /\ Forall (fun i => time i <= value T) orbit /\
      exists i, reaches s (after s l orbit) i /\ value T < time i
  | Repeats _ _ _ _ => False
  end.

Lemma follows_app s a : forall l b, follows s l (a ++ b) -> follows s l a /\ follows s (after s l a) b.
Proof.
  induction a as [|i a IH]; intros l b; cbn; [tauto|]. intros [r f]. destruct (IH _ _ f). tauto.
Qed.
Definition same_wall (a b : wall) : bool := match a, b with left, left | right, right => true | _, _ => false end.
Lemma same_wall_sound a b : same_wall a b = true -> a = b.
Proof. destruct a, b; cbn; congruence. Qed.
Definition same_mapping (a b : option mapping) : bool :=
  match a, b with
  | None, None | Some P1, Some P1 | Some P2, Some P2 | Some P3, Some P3 | Some P4, Some P4 => true
  | _, _ => false
  end.
Lemma same_mapping_sound a b : same_mapping a b = true -> a = b.
Proof. destruct a as [[]|], b as [[]|]; cbn; congruence. Qed.

(* Numbers and mappings. *)
Fixpoint numbered (previous : option wall) (n : Z) (events : list event) : bool :=
  match events with
  | [] => true
  | x :: events => (index x =? n)%Z && same_mapping (mapped x) (option_map (fun w => mapping_between w (on (shown x))) previous)
    && numbered (Some (on (shown x))) (n + 1) events
  end.
Lemma numbered_tells events : forall previous n orbit, numbered previous n events = true ->
  Forall2 within (map shown events) orbit -> tells previous n events orbit.
Proof.
  induction events as [|x events IH]; intros previous n orbit h all; inversion all as [|b i bs is w rest]; subst; cbn; [exact I|].
  cbn in h. apply andb_prop in h as [h more]. apply andb_prop in h as [number name].
  assert (same : wall_of i = on (shown x)) by apply w. rewrite same.
  split; [apply Z.eqb_eq, number|]. split; [apply same_mapping_sound, name|]. split; [exact w|]. apply IH; assumption.
Qed.

(* The same expression, as written. *)
Fixpoint same (a b : number) : bool :=
  match a, b with
  | Rational x, Rational y => (Qnum x =? Qnum y)%Z && (Qden x =? Qden y)%positive
  | Pi, Pi => true
  | Plus a b, Plus c d | Minus a b, Minus c d | Times a b, Times c d | Over a b, Over c d => same a c && same b d
  | Root a, Root b | Sine a, Sine b | Cosine a, Cosine b => same a b
  | _, _ => false
  end.
Lemma same_sound a : forall b, same a b = true -> a = b.
Proof.
  induction a; intros [] h; cbn in h; try discriminate; try (apply andb_prop in h as [h h']); try (f_equal; auto; fail).
  apply Z.eqb_eq in h. apply Pos.eqb_eq in h'. destruct q as [n d], q0 as [n' d']. cbn in *. congruence.
Qed.

Lemma as_many {X Y : Type} (P : X -> Y -> Prop) xs ys : Forall2 P xs ys -> length xs = length ys.
Proof. induction 1; cbn; congruence. Qed.

Module Verifier (F : FloatOps with Definition sensible_format := true).
Module Import Check := Checker F.

Section At.
Variable p : positive.

Definition not_zero (X : I.type) : bool := is_positive X || is_positive (I.neg X).
Fixpoint check_defined (n : number) : bool :=
  match n with
  | Rational _ | Pi => true
  | Plus a b | Minus a b | Times a b => check_defined a && check_defined b
  | Over a b => check_defined a && (check_defined b && not_zero (enclose p b))
  | Root a => check_defined a && is_not_negative (enclose p a)
  | Sine a | Cosine a => check_defined a
  end.
Lemma check_defined_sound n : check_defined n = true -> defined n.
Proof.
  induction n; cbn; intros h; try exact I; try (apply andb_prop in h as [h h']); auto.
  - apply andb_prop in h' as [h' z]. split; [auto|]. split; [auto|]. unfold not_zero in z. assert (x := holds_enclose p n2).
    apply orb_prop in z as [z|z]; [assert (0 < value n2) by exact (is_positive_sound _ _ z x)|
      assert (0 < - value n2) by exact (is_positive_sound _ _ z (holds_neg _ _ x))]; lra.
  - split; [auto|]. exact (is_not_negative_sound _ _ h' (holds_enclose p n)).
Qed.

Definition check_proper (r : range) : bool := check_defined (least r) && check_defined (most r) &&
  (same (least r) (most r) || is_not_negative (sub p (enclose p (most r)) (enclose p (least r)))).
Lemma check_proper_sound r : check_proper r = true -> proper r.
Proof.
  unfold check_proper. intros h. apply andb_prop in h as [h o]. apply andb_prop in h as [h1 h2].
  split; [apply check_defined_sound, h1|]. split; [apply check_defined_sound, h2|]. apply orb_prop in o as [o|o].
  - rewrite (same_sound _ _ o). lra.
  - assert (0 <= value (most r) - value (least r)) by (apply (is_not_negative_sound _ _ o), holds_sub; apply holds_enclose). lra.
Qed.

Definition check_tone (x : tone) : bool := check_proper (amplitude x) && check_proper (frequency x) && check_proper (shift x) &&
  is_not_negative (enclose_range p (amplitude x)) && is_positive (enclose_range p (frequency x)).

(* The data make sense, and so does the start. *)
Definition check_data (x : data) : bool :=
  forallb check_tone (leading x :: further x) && check_proper (gap x) && check_proper (restitution x) &&
  is_positive (enclose_range p (gap x)) && is_not_negative (enclose_range p (restitution x)) &&
  is_not_negative (sub p (whole p 1) (enclose_range p (restitution x))).
Definition check_beginning (x : data) (b : beginning) : bool :=
  match b with
  | Struck w t v => check_proper t && check_proper v && is_not_negative (sided w (enclose_range p v))
  | Inside t y v => check_proper t && check_proper y && check_proper v &&
    (let half := quotient p (enclose_range p (gap x)) (whole p 2) in
     is_positive (sub p half (enclose_range p y)) && is_positive (add p half (enclose_range p y)))
  end.

Ltac conjuncts := repeat match goal with h : _ && _ = true |- _ => apply andb_prop in h as [? ?] end.

Lemma check_tone_sound x : check_tone x = true -> (proper (amplitude x) /\ proper (frequency x) /\ proper (shift x)) /\
  forall h, describes_harmonic x h -> 0 <= A h /\ 0 < W h.
Proof.
  unfold check_tone. intros c. conjuncts. split; [repeat split; apply check_proper_sound; assumption|].
  intros h (a & w & _). split; [refine (is_not_negative_sound _ _ _ (holds_range p _ _ a)); assumption|].
  refine (is_positive_sound _ _ _ (holds_range p _ _ w)); assumption.
Qed.

Lemma data_sound x b : check_data x = true -> check_beginning x b = true ->
  all_proper x b /\ forall s, describes x s -> sensible s /\ starts b s.
Proof.
  unfold check_data. intros c c'. apply andb_prop in c as [c one]. apply andb_prop in c as [c zero]. apply andb_prop in c as [c positive].
  apply andb_prop in c as [c re]. apply andb_prop in c as [c ga]. rewrite forallb_forall in c.
  assert (tones : forall y, In y (leading x :: further x) -> (proper (amplitude y) /\ proper (frequency y) /\ proper (shift y)) /\
    forall h, describes_harmonic y h -> 0 <= A h /\ 0 < W h) by (intros y i; apply check_tone_sound, c, i).
  split.
  - split; [apply Forall_forall; intros y i; apply (tones y i)|]. split; [apply check_proper_sound, ga|].
    split; [apply check_proper_sound, re|]. destruct b; cbn in c'; conjuncts; repeat split; apply check_proper_sound; assumption.
  - intros s (lead & rest & g & r). apply (holds_range p) in g, r. split; [split; [|split]|].
    + constructor; [apply (tones (leading x)); [left; reflexivity|exact lead]|].
      assert (more : forall y, In y (further x) -> forall h, describes_harmonic y h -> 0 <= A h /\ 0 < W h).
      { intros y i. apply (tones y). right. exact i. }
      clear - rest more. induction rest as [|y h ys hs k rest IH]; [constructor|].
      constructor; [apply (more y); [left; reflexivity|exact k]|]. apply IH. intros z i. apply more. right. exact i.
    + exact (is_positive_sound _ _ positive g).
    + assert (0 <= e s) by exact (is_not_negative_sound _ _ zero r).
      assert (0 <= 1 - e s) by (apply (is_not_negative_sound _ _ one), holds_sub; [apply holds_whole|exact r]). lra.
    + destruct b as [w t v|t y v]; cbn in c' |- *; conjuncts.
      * intros u m. refine (is_not_negative_sound _ _ _ (holds_sided w _ _ (holds_range p _ _ m))). assumption.
      * intros u m. apply (holds_range p) in m. assert (half := holds_quotient p _ _ _ _ g (holds_whole p 2)).
        assert (0 < d s / 2 - u) by (refine (is_positive_sound _ _ _ (holds_sub p _ _ _ _ half m)); assumption).
        assert (0 < d s / 2 + u) by (refine (is_positive_sound _ _ _ (holds_add p _ _ _ _ half m)); assumption). lra.
Qed.

(* Of one expression, as written, there is one value. *)
Definition one_value (a b : range) : bool := same (least a) (most a) && same (least a) (least b) && same (least a) (most b).
Definition check_fastest (param : data) : bool :=
  forallb (fun x => one_value (frequency param) (frequency x) ||
    is_not_negative (sub p (enclose_range p (frequency param)) (enclose_range p (frequency x)))) (further param).
Lemma fastest_sound param s : describes param s -> check_fastest param = true -> is_fastest s.
Proof.
  unfold check_fastest, is_fastest. rewrite forallb_forall. intros ((_ & lead & _) & rest & _) check.
  assert (slower : forall x, In x (further param) -> forall h, describes_harmonic x h -> W h <= W s).
  { intros x i h (_ & w & _). specialize (check x i). apply orb_prop in check as [one|less].
    - apply andb_prop in one as [one most_too]. apply andb_prop in one as [own least_too]. apply same_sound in own, least_too, most_too.
      destruct (frequency param), (frequency x). cbn in *. subst. unfold among in lead, w. cbn in lead, w. lra.
    - assert (0 <= W s - W h) by exact (is_not_negative_sound _ _ less (holds_sub p _ _ _ _ (holds_range p _ _ lead) (holds_range p _ _ w))). lra. }
  clear - rest slower. induction rest as [|x h xs hs k rest IH]; [constructor|].
  constructor; [apply (slower x); [left; reflexivity|exact k]|]. apply IH. intros y i. apply slower. right. exact i.
Qed.

(* All listed impacts are before T, and the next one after it. *)
Definition check_until (T : number) (events : list event) (next : bounds) : bool :=
  let X := enclose p T in
  check_defined T && forallb (fun x => is_not_negative (sub p X (known_number p (time_upper (shown x))))) events &&
  is_positive (sub p (known_number p (time_lower next)) X).
End At.

(* Bits of the conditions on all data. *)
Definition few : positive := 256.
(* Data of one harmonic that shakes the box, and what is known of their scenes. *)
Definition check_single (param : data) (b : beginning) : bool :=
  check_data few param && check_beginning few param b && is_positive (enclose_range few (amplitude param)) && match further param with [] => true | _ => false end.
Lemma single_sound param b : check_single param b = true ->
  all_proper param b /\ forall s, describes param s -> sensible s /\ others s = [] /\ 0 < A s /\ 0 < W s /\ 0 < d s.
Proof.
  unfold check_single. intros v. apply andb_prop in v as [v alone]. apply andb_prop in v as [v shaken]. apply andb_prop in v as [good start].
  destruct (data_sound few _ _ good start) as [pr sense]. split; [exact pr|]. intros s described. destruct (sense s described) as [sens _].
  split; [exact sens|]. destruct sens as (tones & gap_positive & _). destruct described as ((dA & _) & rest & _). split; [|split; [|split]].
  - destruct (further param); [inversion rest; reflexivity|discriminate alone].
  - exact (is_positive_sound _ _ shaken (holds_range few _ _ dA)).
  - inversion tones; tauto.
  - exact gap_positive.
Qed.

Definition count (events : list event) : Z := Z.of_nat (length events).
Definition check_outcome (p : positive) (o : outcome) (events : list event) (next : option bounds) : bool :=
  match o, next with
  | Impacts_reached n, None => (count events =? n)%Z
  | Time_reached n T, Some b => (count events =? n)%Z && check_until p T events b
  | _, _ => false
  end.

Lemma until_sound p T events next orbit i : check_until p T events next = true ->
  Forall2 within (map shown events) orbit -> within next i ->
  defined T /\ Forall (fun i => time i <= value T) orbit /\ value T < time i.
Proof.
  unfold check_until. intros h all w. apply andb_prop in h as [h later]. apply andb_prop in h as [def each].
  split; [apply (check_defined_sound p), def|]. split.
  - rewrite forallb_forall in each. revert orbit all.
    induction events as [|x events IH]; intros orbit all; inversion all as [|b j bs js k rest]; subst; [constructor|].
    constructor; [|apply IH; [intros y m; apply each; right; exact m|exact rest]].
    assert (0 <= value T - Q2R (time_upper (shown x))).
    { refine (is_not_negative_sound _ _ (each x (or_introl eq_refl)) _). apply holds_sub; [apply holds_enclose|apply holds_number]. }
    destruct k as (_ & tm & _). lra.
  - assert (0 < Q2R (time_lower next) - value T).
    { refine (is_positive_sound _ _ later _). apply holds_sub; [apply holds_number|apply holds_enclose]. }
    destruct w as (_ & tm & _). lra.
Qed.

End Verifier.
