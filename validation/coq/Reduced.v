(* The impact map of one harmonic, reduced by its symmetry: impacts on the right wall are seen as mirror images on the left one, half a forcing
   period later. So a state is a phase and the velocity before impact on the left wall over A W (which is not positive), all flights begin on the
   left wall, and a flight to the far wall ends in its mirror image. A word is a list of flights, to the far wall or back to the near one.

   `tread_next`: states one after another are impacts of the scene, each the next one, from either wall. *)
From Coq Require Import Reals Lra List ZArith Bool Lia.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model Step Horseshoe Return Covering Cycle Region.
Open Scope R_scope.
Import ListNotations.

(* A flight, and the whole forcing periods that are taken off the phase of its end as it is seen: half a forcing period is added
   before, if it is to the far wall. *)
Record stride := Stride { far : bool; turns_taken : Z }.
(* The wall on which a flight from the left wall ends. *)
Definition reaching (f : stride) : wall := if far f then right else left.
(* The half periods that are taken off the phase on that wall. *)
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

(* The impact that a state stands for on a wall; on the left wall T whole forcing periods are put back, on the right one half
   a forcing period less. *)
Definition stands_for (w : wall) (T : Z) (x : state) : impact := match w with
  | left => impact_at s left (fst x + IZR T * (2 * PI), snd x) | right => impact_at s right (fst x + IZR T * (2 * PI) - PI, - snd x) end.
(* The wall and the forcing periods after a flight. *)
Definition wall_then (w : wall) (f : stride) : wall := if far f then opposite w else w.
Definition turns_then (w : wall) (T : Z) (f : stride) : Z := match w with
  | left => T + turns_taken f | right => if far f then T + turns_taken f - 1 else T + turns_taken f end.

Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis one : one_harmonic s.

(* A state is the phase and the speed of its impact as they are seen from the left wall, with forcing periods taken off. *)
Lemma stands_for_wall w T x : wall_of (stands_for w T x) = w.
Proof. destruct w; reflexivity. Qed.
Lemma stands_for_phase w T x : phase_seen s (stands_for w T x) = fst x + IZR T * (2 * PI).
Proof. unfold phase_seen, stands_for. destruct w; rewrite phase_at by assumption; cbn; ring. Qed.
Lemma stands_for_speed w T x : speed_seen s (stands_for w T x) = - snd x.
Proof. unfold speed_seen, stands_for. destruct w; rewrite speed_at by assumption; cbn; ring. Qed.

Lemma stands_for_left T x : stands_for left T x = periods_later s T (impact_at s left x).
Proof. unfold stands_for, periods_later, later, impact_at, period. cbn [wall_of time velocity fst snd]. f_equal. field. lra. Qed.
Lemma stands_for_right T x : stands_for right T x = mirrored s (T - 1) (impact_at s left x).
Proof.
  unfold stands_for, mirrored, impact_at, period. cbn [wall_of time velocity fst snd opposite]. f_equal; [|ring].
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
    unfold wall_then, turns_then. destruct (far f); cbn [opposite]; unfold stands_for, periods_later, later, impact_at, period; cbn [wall_of time velocity fst snd];
      f_equal; rewrite plus_IZR; field; lra.
  - rewrite stands_for_right. unfold next in h |- *. rewrite rebound_mirrored. apply (reaches_mirrored s W_positive one (T - 1)) in h.
    replace (stands_for (wall_then right f) (turns_then right T f) z) with (mirrored s (T - 1) (stands_for (if far f then right else left) (turns_taken f) z)); [exact h|].
    unfold wall_then, turns_then. destruct (far f); cbn [opposite]; unfold stands_for, mirrored, impact_at, period; cbn [wall_of time velocity fst snd opposite];
      f_equal; rewrite ?minus_IZR, ?plus_IZR, ?mult_IZR, ?minus_IZR; try ring; field; lra.
Qed.
End Scene.
