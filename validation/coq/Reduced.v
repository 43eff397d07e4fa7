(* The impact map of one harmonic, reduced by its symmetry: impacts on the right wall are seen as mirror images on the left one, half a forcing
   period later. So a state is a phase and the velocity before impact on the left wall over A W (which is not positive), all flights begin on the
   left wall, and a flight to the far wall ends in its mirror image. A word is a list of flights, to the far wall or back to the near one.

   `tread_next`, `walk_leads`, `treads_impacts`, `walks_impacts`: sequences of states are the impacts of the scene, one after another, from either wall. *)
From Coq Require Import Reals Lra List ZArith Bool Lia.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model Step Horseshoe Return Covering Cycle Region.
Open Scope R_scope.
Import ListNotations.

(* A flight, and the whole turns that are taken off the phase of its end as it is seen: half a turn is added before, if it is to the far wall. *)
Record stride := Stride { far : bool; turns_taken : Z }.
(* The wall on which a flight from the left wall ends. *)
Definition reaching (f : stride) : wall := if far f then right else left.
(* The half turns that are taken off the phase on that wall. *)
Definition half_turns_off (f : stride) : Z := if far f then 2 * turns_taken f - 1 else 2 * turns_taken f.

Section Scene.
Variable s : scene.

Definition leap (far : bool) (x : state) : state := let y := fly s left x in if far then (fst y + PI, - snd y) else y.
Definition tread (f : stride) (x : state) : state := turned (turns_taken f) (leap (far f) x).
Definition treads (f : stride) (x : state) : Prop := flies s left (reaching f) x.
(* Along a word; and that all its flights are flights to their walls. *)
Fixpoint walk (word : list stride) (x : state) : state := match word with [] => x | f :: word => walk word (tread f x) end.
Fixpoint walks (word : list stride) (x : state) : Prop := match word with [] => True | f :: word => treads f x /\ walks word (tread f x) end.

Lemma tread_shifted f x : tread f x = shifted (IZR (half_turns_off f) * PI) (far f) (fly s left x).
Proof.
  unfold tread, leap, turned, shifted, half_turns_off. destruct (far f); cbn [fst snd]; f_equal; rewrite ?minus_IZR, mult_IZR; ring.
Qed.

(* The impact that a state stands for on a wall; on the left wall T whole turns are put back, on the right one half a turn less. *)
Definition stands_for (w : wall) (T : Z) (x : state) : impact := match w with
  | left => impact_at s left (fst x + IZR T * (2 * PI), snd x) | right => impact_at s right (fst x + IZR T * (2 * PI) - PI, - snd x) end.
(* The wall and the turns after a flight, and after a word. *)
Definition wall_then (w : wall) (f : stride) : wall := if far f then mirror_wall w else w.
Definition turns_then (w : wall) (T : Z) (f : stride) : Z := match w with
  | left => T + turns_taken f | right => if far f then T + turns_taken f - 1 else T + turns_taken f end.
Fixpoint wall_last (w : wall) (word : list stride) : wall := match word with [] => w | f :: word => wall_last (wall_then w f) word end.
Fixpoint turns_last (w : wall) (T : Z) (word : list stride) : Z := match word with [] => T | f :: word => turns_last (wall_then w f) (turns_then w T f) word end.
Fixpoint impacts_along (w : wall) (T : Z) (word : list stride) (x : state) : list impact := match word with
  | [] => [] | f :: word => stands_for (wall_then w f) (turns_then w T f) (tread f x) :: impacts_along (wall_then w f) (turns_then w T f) word (tread f x) end.

Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis one : one_harmonic s.

(* A state is the phase and the speed of its impact as they are seen from the left wall, with turns taken off. *)
Lemma stands_for_wall w T x : wall_of (stands_for w T x) = w.
Proof. destruct w; reflexivity. Qed.
Lemma stands_for_phase w T x : phase_seen s (stands_for w T x) = fst x + IZR T * (2 * PI).
Proof. unfold phase_seen, stands_for. destruct w; rewrite phase_at by assumption; cbn; ring. Qed.
Lemma stands_for_speed w T x : speed_seen s (stands_for w T x) = - snd x.
Proof. unfold speed_seen, stands_for. destruct w; rewrite speed_at by assumption; cbn; ring. Qed.
(* Every impact has a state, with any whole turns taken off. *)
Lemma stood_for i T : i = stands_for (wall_of i) T (phase_seen s i - IZR T * (2 * PI), - speed_seen s i).
Proof.
  destruct i as [w t v]. unfold stands_for, impact_at, phase_seen, speed_seen, phase, unit_speed. cbn [wall_of time velocity fst snd].
  destruct w; cbn [side seen]; f_equal; field; lra.
Qed.

Lemma stands_for_left T x : stands_for left T x = periods_later s T (impact_at s left x).
Proof. unfold stands_for, periods_later, later, impact_at, period. cbn [wall_of time velocity fst snd]. f_equal. field. lra. Qed.
Lemma stands_for_right T x : stands_for right T x = mirrored s (T - 1) (impact_at s left x).
Proof.
  unfold stands_for, mirrored, impact_at, period. cbn [wall_of time velocity fst snd mirror_wall]. f_equal; [|ring].
  rewrite plus_IZR, mult_IZR, minus_IZR. field. lra.
Qed.

(* A flight of states is one of the scene, from either wall. *)
Theorem tread_next w T f x : treads f x -> next s (stands_for w T x) (stands_for (wall_then w f) (turns_then w T f) (tread f x)).
Proof.
  intros h. unfold treads, flies in h. set (y := fly s left x) in *.
  assert (lands : impact_at s (reaching f) y = stands_for (if far f then right else left) (turns_taken f) (tread f x)).
  { unfold reaching, tread, leap, turned, stands_for. fold y. destruct y as [u v]. destruct (far f); cbn [fst snd]; f_equal; f_equal; ring. }
  rewrite lands in h. clear lands. set (z := tread f x) in *. clearbody z.
  destruct w.
  - rewrite stands_for_left. apply (next_later s _ (turns_recur s W_positive one T)) in h.
    replace (stands_for (wall_then left f) (turns_then left T f) z) with (periods_later s T (stands_for (if far f then right else left) (turns_taken f) z)); [exact h|].
    unfold wall_then, turns_then. destruct (far f); cbn [mirror_wall]; unfold stands_for, periods_later, later, impact_at, period; cbn [wall_of time velocity fst snd];
      f_equal; rewrite plus_IZR; field; lra.
  - rewrite stands_for_right. unfold next in h |- *. rewrite rebound_mirrored. apply (reaches_mirrored s W_positive one (T - 1)) in h.
    replace (stands_for (wall_then right f) (turns_then right T f) z) with (mirrored s (T - 1) (stands_for (if far f then right else left) (turns_taken f) z)); [exact h|].
    unfold wall_then, turns_then. destruct (far f); cbn [mirror_wall]; unfold stands_for, mirrored, impact_at, period; cbn [wall_of time velocity fst snd mirror_wall];
      f_equal; rewrite ?minus_IZR, ?plus_IZR, ?mult_IZR, ?minus_IZR; try ring; field; lra.
Qed.

(* The same along a word. *)
Theorem walk_leads word : forall w T x, walks word x ->
  follows s (rebound s (stands_for w T x)) (impacts_along w T word x) /\ length (impacts_along w T word x) = length word /\
  last (impacts_along w T word x) (stands_for w T x) = stands_for (wall_last w word) (turns_last w T word) (walk word x).
Proof.
  induction word as [|f word IH]; intros w T x h; [repeat split|]. destruct h as [h more].
  destruct (IH (wall_then w f) (turns_then w T f) (tread f x) more) as (follow & same & ended). cbn [impacts_along length walk wall_last turns_last].
  split; [split; [exact (tread_next w T f x h)|exact follow]|]. split; [rewrite same; reflexivity|].
  rewrite last_cons. exact ended.
Qed.

(* And for ever: states one after another, from either wall. *)
Section For_ever.
Variables (f : nat -> stride) (x : nat -> state) (w : wall) (T : Z).
Hypothesis all : forall k, treads (f k) (x k) /\ x (S k) = tread (f k) (x k).
Fixpoint wall_number (k : nat) : wall := match k with O => w | S k => wall_then (wall_number k) (f k) end.
Fixpoint turns_number (k : nat) : Z := match k with O => T | S k => turns_then (wall_number k) (turns_number k) (f k) end.
Theorem treads_impacts : exists I : nat -> impact, (forall k, reaches s (rebound s (I k)) (I (S k))) /\
  wall_of (I O) = w /\ (forall k, wall_of (I (S k)) = if far (f k) then mirror_wall (wall_of (I k)) else wall_of (I k)) /\
  forall k, wall_of (I k) = wall_number k /\ phase_seen s (I k) = fst (x k) + IZR (turns_number k) * (2 * PI) /\ speed_seen s (I k) = - snd (x k).
Proof.
  exists (fun k => stands_for (wall_number k) (turns_number k) (x k)). split; [|split; [|split]].
  - intros k. destruct (all k) as [h ->]. exact (tread_next _ _ _ _ h).
  - apply stands_for_wall.
  - intros k. rewrite !stands_for_wall. reflexivity.
  - intros k. split; [apply stands_for_wall|]. split; [apply stands_for_phase|apply stands_for_speed].
Qed.
End For_ever.

(* Words one after another, from ever to ever: the flights of word n lead from the impact of state n to that of state n + 1. *)
Lemma wall_last_then w f word : wall_last (wall_then w f) word = wall_then (wall_last w word) f.
Proof.
  revert w. induction word as [|g word IH]; intros w; [reflexivity|]. cbn [wall_last]. rewrite <- IH. f_equal.
  unfold wall_then. destruct (far f), (far g), w; reflexivity.
Qed.
Lemma wall_last_twice word : forall w, wall_last (wall_last w word) word = w.
Proof.
  induction word as [|f word IH]; intros w; [reflexivity|]. cbn [wall_last]. rewrite <- wall_last_then, IH. unfold wall_then. destruct (far f), w; reflexivity.
Qed.
Lemma turns_last_plus word : forall w T, turns_last w T word = (T + turns_last w 0 word)%Z.
Proof.
  induction word as [|f word IH]; intros w T; [cbn; lia|]. cbn [turns_last]. rewrite IH, (IH _ (turns_then w 0 f)). unfold turns_then. destruct w, (far f); lia.
Qed.
Section Ever.
Variables (u : Z -> list stride) (x : Z -> state) (w : wall) (T : Z).
Hypothesis all : forall n, walks (u n) (x n) /\ x (n + 1)%Z = walk (u n) (x n).
(* The wall and the turns before word n. *)
Fixpoint later_words (k : nat) : wall * Z := match k with
  | O => (w, T) | S k => let (v, n) := later_words k in let word := u (Z.of_nat k) in (wall_last v word, turns_last v n word) end.
Fixpoint earlier_words (k : nat) : wall * Z := match k with
  | O => (w, T) | S k => let (v, n) := earlier_words k in let word := u (- Z.of_nat (S k))%Z in
    let v0 := wall_last v word in (v0, n - turns_last v0 0 word)%Z end.
Definition at_word (n : Z) : wall * Z := if (0 <=? n)%Z then later_words (Z.to_nat n) else earlier_words (Z.to_nat (- n)).
Lemma at_word_next n : at_word (n + 1) = (wall_last (fst (at_word n)) (u n), turns_last (fst (at_word n)) (snd (at_word n)) (u n)).
Proof.
  unfold at_word. destruct (Z.leb_spec 0 n) as [o|o].
  - replace (0 <=? n + 1)%Z with true by (symmetry; apply Z.leb_le; lia). replace (Z.to_nat (n + 1)) with (S (Z.to_nat n)) by lia.
    cbn [later_words]. rewrite Z2Nat.id by exact o. destruct (later_words (Z.to_nat n)). reflexivity.
  - replace (Z.to_nat (- n)) with (S (Z.to_nat (- (n + 1)))) by lia. set (k := Z.to_nat (- (n + 1))). cbn [earlier_words]. replace (- Z.of_nat (S k))%Z with n by lia.
    assert (same : (if (0 <=? n + 1)%Z then later_words (Z.to_nat (n + 1)) else earlier_words k) = earlier_words k).
    { destruct (Z.leb_spec 0 (n + 1)) as [o'|o']; [|reflexivity]. unfold k. replace (n + 1)%Z with 0%Z by lia. reflexivity. }
    rewrite same. destruct (earlier_words k) as [v m]. cbn [fst snd]. rewrite wall_last_twice, turns_last_plus. f_equal. lia.
Qed.
Theorem walks_impacts : exists (walls : Z -> wall) (turns : Z -> Z), walls 0%Z = w /\ turns 0%Z = T /\ forall n,
  let i := stands_for (walls n) (turns n) (x n) in let orbit := impacts_along (walls n) (turns n) (u n) (x n) in
  walls (n + 1)%Z = wall_last (walls n) (u n) /\ turns (n + 1)%Z = turns_last (walls n) (turns n) (u n) /\
  follows s (rebound s i) orbit /\ length orbit = length (u n) /\ last orbit i = stands_for (walls (n + 1)%Z) (turns (n + 1)%Z) (x (n + 1)%Z).
Proof.
  exists (fun n => fst (at_word n)), (fun n => snd (at_word n)). split; [reflexivity|]. split; [reflexivity|]. intros n. cbv zeta.
  rewrite at_word_next. cbn [fst snd]. split; [reflexivity|]. split; [reflexivity|]. destruct (all n) as [h ->]. exact (walk_leads _ _ _ _ h).
Qed.
End Ever.
End Scene.
