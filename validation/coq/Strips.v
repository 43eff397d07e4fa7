(* A program `check_strip`, on Interval's arithmetic, that decides that a word of the reduced impact map (Reduced.v) covers: that it is continuous
   on a slice of a parallelogram, and carries it across another one; and the proof that it is right (`strip_sound`).

   Parallelograms are charts of Covering.v. The slice is cut into cells, one after another along it; the flights of all states of a cell are followed
   through charts that hold their images, and the last images are enclosed: between the edges of the second parallelogram, those of the first cell
   beyond its one end and those of the last cell beyond the other.

   All numbers of Z are numbers of the grid 2^-q, but `turns_taken`, which counts whole turns:
     chart      cu, lu, wu: phases; cv, lv, wv: velocities before impact on the left wall over A W. Of h-sets, and of the charts between flights,
                the velocities are not positive. lu * wv - lv * wu > 0.
     stride     one flight of a word: whether it is to the far wall; and the whole turns that are taken off: its end is seen at
                phase of arrival + (pi if far) - 2 pi turns_taken.
     passage    one flight of all states of a cell, all in phases of arrival before half a turn is added and turns are taken off:
                wide_mid, wide_rad: bracket of the phases of arrival that shows the first contact: at its begin all are inside the gap, at its end
                all are beyond the wall, and on all of it they go towards the wall;
                near_mid, near_rad: a narrow bracket inside the wide one, for the image;
                go, come: up to go (not before the latest start) all move away from the wall they leave, or are pressed away from it; from go to come
                all are inside the gap; from come to the end of the wide bracket all go towards the wall of arrival; go <= come <= wide_mid - wide_rad;
                lean_along, lean_across: tilts, grid 2^-q. The image's coordinate n1 phase + n2 velocity (along or across the chart of arrival, times
                its area) is enclosed by that of n1 phase + n2 velocity - tilt * (distance from the wall), best where its derivative
                by the phase of arrival, n1 + n2 (-E'') - tilt * velocity, is about 0: tilt = (n1 + n2 sin(phase)) / velocity on arrival over A W, with
                along: n1 = wv, n2 = -wu (far: wu); across: n1 = -lv, n2 = lu (far: -lu), of the chart of arrival, as numbers (2^-q of the integers).
     cell       until: where it ends, in the coordinate along of the first chart, from -2^q to 2^q; it begins where the one before ends;
                through: for all flights but the last, the passage, and a chart that holds the image of all states of the cell, or of the chart
                before (all of it: |along|, |across| <= 1);
                finally: the passage of the last flight.
     strip      begins: where the first cell begins, >= -2^q; backwards: false if along the second chart the first cell's image is at <= -1 and the last
                cell's at >= 1, true if it is the other way round; cells: two or more. *)
From Coq Require Import Reals Lra List ZArith Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Horseshoe Return Certificate Covering Covers Reduced.
Open Scope R_scope.
Import ListNotations.

Record cell := Cell { until : Z; through : list (passage * chart); finally : passage }.
Record strip := Strip { begins_at : Z; backwards : bool; cells : list cell }.
(* Where a strip ends. *)
Definition ends_at (t : strip) : Z := last (map until (cells t)) (begins_at t).

(* Where images are: in all of a chart; before its one end, or beyond its other; or anywhere along it. Always between its edges. *)
Inductive extent := Contained | Short | Past | Anywhere.

Module Strips (F : FloatOps with Definition sensible_format := true).
Include Coverings F.
Local Opaque add sub mul quotient whole hull sine cosine.

Section Program.
Variables p q : positive.
Variable param : data.
Notation OS := (known_in param p).

(* One flight of all states from a to b of a chart N, as it is seen in M. *)
Definition check_tread (f : stride) (N M : chart) (a b : Z) (c : passage) (where_to : extent) : bool :=
  let w1 := reaching f in let box := launches p q param left N a b in let seen := look p OS box p in
  (0 <? chart_area M)%Z &? check_arrivals p q param w1 N a b box seen c &?
  let K := mul p (whole p (half_turns f)) (I.pi (F.PtoP p)) in let edge := area_over p q M in let D := reach p q a b in
  let across := across_of p q K (far f) M (arrived p q param w1 N box seen c (lean_across c) D) in
  let along (_ : unit) := along_of p q K (far f) M (arrived p q param w1 N box seen c (lean_along c) D) in
  is_not_negative (sub p edge across) &? is_not_negative (add p edge across) &?
  match where_to with
  | Anywhere => true
  | Short => is_not_negative (I.neg (add p (along tt) edge))
  | Past => is_not_negative (sub p (along tt) edge)
  | Contained => let X := along tt in is_not_negative (sub p edge X) &? is_not_negative (add p edge X)
  end.

(* All flights of a word. *)
Fixpoint check_walk (word : list stride) (N M : chart) (a b : Z) (through : list (passage * chart)) (finally : passage) (where_to : extent) : bool :=
  match word, through with
  | [f], [] => check_tread f N M a b finally where_to
  | f :: word, (c, C) :: through => check_tread f N C a b c Contained &? check_walk word C M (- 2 ^ Zpos q) (2 ^ Zpos q) through finally where_to
  | _, _ => false
  end.
Definition check_cell (word : list stride) (N M : chart) (a : Z) (c : cell) (where_to : extent) : bool :=
  (a <? until c)%Z &? check_walk word N M a (until c) (through c) (finally c) where_to.
(* The cells after the first. *)
Fixpoint check_cells (word : list stride) (N M : chart) (a : Z) (cells : list cell) (at_end : extent) : bool :=
  match cells with
  | [] => false
  | [c] => check_cell word N M a c at_end
  | c :: cells => check_cell word N M a c Anywhere &? check_cells word N M (until c) cells at_end
  end.
Definition check_strip (word : list stride) (N M : chart) (t : strip) : bool :=
  (- 2 ^ Zpos q <=? begins_at t)%Z &? (ends_at t <=? 2 ^ Zpos q)%Z &?
  match cells t with
  | [] => false
  | c :: cells => check_cell word N M (begins_at t) c (if backwards t then Past else Short) &?
      check_cells word N M (until c) cells (if backwards t then Short else Past)
  end.
End Program.
End Strips.
