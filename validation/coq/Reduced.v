(* The impact map of one harmonic, reduced by its symmetry: impacts on the right wall are seen as mirror images on the left one, half a forcing
   period later. So a state is a phase and the velocity before impact on the left wall over A W (which is not positive), all flights begin on the
   left wall, and a flight to the far wall ends in its mirror image. A word is a list of flights, to the far wall or back to the near one.

   `tread_next`, `walk_leads`, `treads_impacts`: sequences of states are the impacts of the scene, one after another, from either wall. *)
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
Definition half_turns (f : stride) : Z := if far f then 2 * turns_taken f - 1 else 2 * turns_taken f.

Section Scene.
Variable s : scene.

Definition leap (far : bool) (x : state) : state := let y := fly s left x in if far then (fst y + PI, - snd y) else y.
Definition tread (f : stride) (x : state) : state := turned (turns_taken f) (leap (far f) x).
Definition treads (f : stride) (x : state) : Prop := flies s left (reaching f) x.
(* Along a word; and that all its flights are flights to their walls. *)
Fixpoint walk (word : list stride) (x : state) : state := match word with [] => x | f :: word => walk word (tread f x) end.
Fixpoint walks (word : list stride) (x : state) : Prop := match word with [] => True | f :: word => treads f x /\ walks word (tread f x) end.

Lemma tread_shifted f x : tread f x = shifted (IZR (half_turns f) * PI) (far f) (fly s left x).
Proof.
  unfold tread, leap, turned, shifted, half_turns. destruct (far f); cbn [fst snd]; f_equal; rewrite ?minus_IZR, mult_IZR; ring.
Qed.
End Scene.
