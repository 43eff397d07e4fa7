(* A program `check_strip`, on Interval's arithmetic, that decides that a word of the reduced impact map (Reduced.v) covers: that it is continuous
   on a slice of a parallelogram, and carries it across another one; and the proof that it is right (`strip_sound`).

   Parallelograms are charts of Covering.v. The slice is cut into segments, one after another along it; the flights of all states of a segment are followed
   through charts that hold their images, and the last images are enclosed: between the edges of the second parallelogram, those of the first segment
   beyond its one end and those of the last segment beyond the other.

   All numbers of Z are numbers of the grid 2^-q, but `turns_taken`, which counts whole turns:
     chart      cu, lu, wu: phases; cv, lv, wv: velocities before impact on the left wall over A W. Of h-sets, and of the charts between flights,
                the velocities are not positive. lu * wv - lv * wu > 0.
     stride     one flight of a word: whether it is to the far wall; and the whole turns that are taken off: its end is seen at
                phase of arrival + (pi if far) - 2 pi turns_taken.
     transit    one flight of all states of a segment, all in phases of arrival before half a turn is added and turns are taken off:
                wide_mid, wide_rad: bracket of the phases of arrival that shows the first contact: at its begin all are inside the gap, at its end
                all are beyond the wall, and on all of it they go towards the wall; phase and velocity of the launch are taken as independent here,
                so it has to be wider than the arrivals;
                near_mid, near_rad: a narrow bracket inside the wide one, for the image;
                go, come: up to go (not before the latest start) all move away from the wall they leave, or are pressed away from it; from go to come
                all are inside the gap; from come to the end of the wide bracket all go towards the wall of arrival; go <= come <= wide_mid - wide_rad;
                lean_along, lean_across: tilts, grid 2^-q. The image's coordinate n1 phase + n2 velocity (along or across the chart of arrival, times
                its area) is enclosed by that of n1 phase + n2 velocity - tilt * (distance from the wall), best where its derivative
                by the phase of arrival, n1 + n2 (-E'') - tilt * velocity, is about 0: tilt = (n1 + n2 sin(phase)) / velocity on arrival over A W, with
                along: n1 = wv, n2 = -wu (far: wu); across: n1 = -lv, n2 = lu (far: -lu), of the chart of arrival, as numbers (2^-q of the integers).
     segment    until: where it ends, in the coordinate along of the first chart, from -2^q to 2^q; it begins where the one before ends;
                through: for all flights but the last, the transit, and a chart that holds the image of all states of the segment, or of the chart
                before (all of it: |along|, |across| <= 1);
                finally: the transit of the last flight.
     strip      begins_at: where the first segment begins, >= -2^q; backwards: false if along the second chart the first segment's image is at <= -1 and the last
                segment's at >= 1, true if it is the other way round; segments: two or more. *)
From Coq Require Import Reals Lra List ZArith Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Horseshoe Return Certificate Covering Covers Reduced.
Open Scope R_scope.
Import ListNotations.

Record segment := Segment { until : Z; through : list (transit * chart); finally : transit }.
Record strip := Strip { begins_at : Z; backwards : bool; segments : list segment }.
(* Where a strip ends. *)
Definition ends_at (t : strip) : Z := last (map until (segments t)) (begins_at t).

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
Definition check_tread (f : stride) (N M : chart) (a b : Z) (c : transit) (where_to : extent) : bool :=
  let w1 := reaching f in let box := launches p q param left N a b in let seen := look p OS box p in
  (0 <? chart_area M)%Z &? check_arrivals p q param w1 N a b box seen c &?
  let K := mul p (whole p (half_turns_off f)) (I.pi (F.PtoP p)) in let edge := area_over p q M in let D := reach p q a b in
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
Fixpoint check_walk (word : list stride) (N M : chart) (a b : Z) (through : list (transit * chart)) (finally : transit) (where_to : extent) : bool :=
  match word, through with
  | [f], [] => check_tread f N M a b finally where_to
  | f :: word, (c, C) :: through => check_tread f N C a b c Contained &? check_walk word C M (- 2 ^ Zpos q) (2 ^ Zpos q) through finally where_to
  | _, _ => false
  end.
Definition check_segment (word : list stride) (N M : chart) (a : Z) (c : segment) (where_to : extent) : bool :=
  (a <? until c)%Z &? check_walk word N M a (until c) (through c) (finally c) where_to.
(* The segments after the first. *)
Fixpoint check_segments (word : list stride) (N M : chart) (a : Z) (segments : list segment) (at_end : extent) : bool :=
  match segments with
  | [] => false
  | [c] => check_segment word N M a c at_end
  | c :: segments => check_segment word N M a c Anywhere &? check_segments word N M (until c) segments at_end
  end.
Definition check_strip (word : list stride) (N M : chart) (t : strip) : bool :=
  (- 2 ^ Zpos q <=? begins_at t)%Z &? (ends_at t <=? 2 ^ Zpos q)%Z &?
  match segments t with
  | [] => false
  | c :: segments => check_segment word N M (begins_at t) c (if backwards t then Past else Short) &?
      check_segments word N M (until c) segments (if backwards t then Short else Past)
  end.
End Program.

Section Proof.
Variables p q : positive.
Variable param : data.
Variable s : scene.
Hypothesis described : describes param s.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.
Notation part N a b := (slice (frame_of q N) (grid q a) (grid q b)).

Definition is_at (where_to : extent) (z : R) : Prop :=
  match where_to with Anywhere => True | Short => z <= -1 | Past => 1 <= z | Contained => -1 <= z <= 1 end.
(* The map of a word on a stretch of a chart, seen in a second one. *)
Definition sent (word : list stride) (N M : chart) (a b : Z) (where_to : extent) : Prop :=
  (forall x, part N a b x -> walks s word x) /\ continuous_on (part N a b) (walk s word) /\
  forall x, part N a b x -> -1 <= across (frame_of q M) (walk s word x) <= 1 /\ is_at where_to (along (frame_of q M) (walk s word x)).

Lemma tread_sound f N M a b c where_to : check_tread p q param f N M a b c where_to = true -> sent [f] N M a b where_to.
Proof.
  intros check. unfold check_tread in check. cbv zeta in check. split_checks.
  assert (areaM : (0 < chart_area M)%Z) by (apply Z.ltb_lt; assumption).
  destruct (arrivals_sound p q param s described A_positive W_positive gap_positive left (reaching f) N a b c k0) as (areaN & all & cont & landed).
  set (K := mul p (whole p (half_turns_off f)) (I.pi (F.PtoP p))) in *.
  assert (hK : holds K (IZR (half_turns_off f) * PI)) by (apply holds_mul; [apply holds_whole|apply I.pi_correct]).
  assert (edge := holds_area p q M). unfold sent. cbn [walks walk].
  split; [intros x hx; split; [exact (all x hx)|exact I]|]. split.
  { apply (continuous_on_ext (part N a b) (fun x : state => shifted (IZR (half_turns_off f) * PI) (far f) (fly s left x))); [intros x _; symmetry; apply tread_shifted|].
    apply (on_comp (part N a b) (fun _ => True) (fly s left) (shifted (IZR (half_turns_off f) * PI) (far f))); [exact cont|apply shifted_continuous|auto]. }
  intros x hx. rewrite tread_shifted.
  assert (linear := fun mu n1 n2 n0 N1 N2 N0 h1 h2 h0 => landed x n1 n2 n0 N1 N2 N0 mu _ hx h1 h2 h0 (holds_reach p q N a b x hx)).
  assert (far_across := across_of_holds p q _ _ (far f) M _ _ hK areaM (linear (lean_across c))).
  assert (far_along := along_of_holds p q _ _ (far f) M _ _ hK areaM (linear (lean_along c))).
  split; [exact (between_edges p q _ _ M _ areaM edge far_across k1 k2)|].
  destruct where_to; cbn [is_at]; [|exact (before_end p q _ _ M _ areaM edge far_along check)|exact (after_end p q _ _ M _ areaM edge far_along check)|exact I].
  split_checks. exact (between_edges p q _ _ M _ areaM edge far_along k3 check).
Qed.

Lemma walk_sound word : forall N M a b through finally where_to, check_walk p q param word N M a b through finally where_to = true -> sent word N M a b where_to.
Proof.
  induction word as [|f word IH]; intros N M a b through finally where_to check; [discriminate|].
  destruct through as [|[c C] through]; cbn [check_walk] in check.
  - destruct word; [exact (tread_sound _ _ _ _ _ _ _ check)|discriminate].
  - assert (both : (check_tread p q param f N C a b c Contained &? check_walk p q param word C M (- 2 ^ Zpos q) (2 ^ Zpos q) through finally where_to) = true)
      by (destruct word; exact check).
    clear check. split_checks. destruct (tread_sound _ _ _ _ _ _ _ k) as (flies1 & cont1 & in1). destruct (IH _ _ _ _ _ _ _ both) as (flies2 & cont2 & in2).
    cbn [walk walks is_at] in *.
    assert (into : forall x, part N a b x -> part C (- 2 ^ Zpos q) (2 ^ Zpos q) (tread s f x)).
    { intros x hx. destruct (in1 x hx). unfold slice. rewrite grid_opp, whole_unit. auto. }
    split; [intros x hx; split; [apply (flies1 x hx)|exact (flies2 _ (into x hx))]|]. split; [|intros x hx; exact (in2 _ (into x hx))].
    exact (on_comp _ _ (tread s f) (walk s word) cont1 cont2 into).
Qed.

(* Two stretches, one after the other. *)
Lemma part_joined N a b c x : (a <= b)%Z -> (b <= c)%Z -> part N a c x <-> part N a b x \/ part N b c x.
Proof.
  intros h1 h2. apply (grid_le q) in h1, h2. unfold slice. split; [|intros [h|h]; (split; [lra|apply h])].
  intros [h k]. destruct (Rle_lt_dec (along (frame_of q N) x) (grid q b)); [left|right]; (split; [lra|exact k]).
Qed.
Lemma sent_joined word N M a b c here there : (a <= b)%Z -> (b <= c)%Z -> sent word N M a b here -> sent word N M b c there -> sent word N M a c Anywhere.
Proof.
  intros h1 h2 (flies1 & cont1 & in1) (flies2 & cont2 & in2).
  assert (either := fun x => part_joined N a b c x h1 h2). split; [|split].
  - intros x hx. apply either in hx as [hx|hx]; auto.
  - apply (on_part (fun x => part N a b x \/ part N b c x)); [intros x; apply either|]. apply on_either; try assumption; apply closed_slice.
  - intros x hx. split; [|exact I]. apply either in hx as [hx|hx]; [apply (in1 x hx)|apply (in2 x hx)].
Qed.

(* The segments, one after another, up to the last one. *)
Definition last_end (a : Z) (segments : list segment) : Z := last (map until segments) a.
Lemma last_end_next a c segments : last_end a (c :: segments) = last_end (until c) segments.
Proof.
  unfold last_end. cbn [map]. destruct (map until segments) as [|b more] eqn:eq; [reflexivity|]. clear eq.
  change (last (b :: more) a = last (b :: more) (until c)). revert b. induction more as [|m more IH]; intros b; [reflexivity|exact (IH m)].
Qed.
Lemma segments_sound word N M at_end segments : forall a, check_segments p q param word N M a segments at_end = true ->
  (a < last_end a segments)%Z /\ sent word N M a (last_end a segments) Anywhere /\
  forall x, part N a (last_end a segments) x -> along (frame_of q N) x = grid q (last_end a segments) -> is_at at_end (along (frame_of q M) (walk s word x)).
Proof.
  induction segments as [|c segments IH]; intros a check; [discriminate|]. rewrite last_end_next. cbn [check_segments] in check. destruct segments as [|c' segments].
  - unfold check_segment in check. split_checks. apply Z.ltb_lt in k. apply walk_sound in check. change (last_end (until c) []) with (until c).
    split; [exact k|]. split; [|intros x hx _; apply (proj2 (proj2 check) x hx)]. destruct check as (h1 & h2 & h3).
    split; [exact h1|]. split; [exact h2|]. intros x hx. split; [apply (h3 x hx)|exact I].
  - split_checks. destruct (IH (until c) check) as (order & rest & ends). clear IH check. unfold check_segment in k. split_checks. apply Z.ltb_lt in k0. apply walk_sound in k.
    set (b := last_end (until c) (c' :: segments)) in *. split; [lia|].
    split; [apply (sent_joined word N M a (until c) b Anywhere Anywhere); try assumption; lia|].
    intros x [r across] at_b. apply ends; [|exact at_b]. split; [|exact across]. rewrite at_b. assert (g := grid_le q (until c) b ltac:(lia)). lra.
Qed.

Theorem strip_sound word N M t : check_strip p q param word N M t = true ->
  covers (frame_of q N) (frame_of q M) (grid q (begins_at t)) (grid q (ends_at t)) (if backwards t then -1 else 1) (walk s word) /\
  forall x, slice (frame_of q N) (grid q (begins_at t)) (grid q (ends_at t)) x -> walks s word x.
Proof.
  intros check. unfold check_strip in check. unfold ends_at in *. set (a := begins_at t) in *.
  destruct (segments t) as [|c segments]; split_checks; [discriminate|]. fold (last_end a (c :: segments)) in *. rewrite last_end_next in *.
  apply Z.leb_le in k, k0. unfold check_segment in k1. split_checks. apply Z.ltb_lt in k2. apply walk_sound in k1.
  destruct (segments_sound _ _ _ _ _ _ check) as (order & rest & ends). set (b := last_end (until c) segments) in *.
  assert (all := sent_joined word N M a (until c) b _ _ ltac:(lia) ltac:(lia) k1 rest). destruct all as (flying & cont & flat).
  split; [|exact flying]. assert (ga := grid_le q _ _ k). assert (gb := grid_le q _ _ k0). rewrite grid_opp, whole_unit in ga. rewrite whole_unit in gb.
  assert (ab : grid q a < grid q b).
  { unfold grid. apply Rmult_lt_compat_l; [apply grid_step|]. apply IZR_lt. lia. }
  assert (gc := grid_le q a (until c) ltac:(lia)). assert (gc' := grid_le q (until c) b ltac:(lia)).
  split; try assumption; try lra.
  - destruct (backwards t); auto.
  - intros x hx. apply (flat x hx).
  - intros x [_ edges] at_a. assert (first : is_at (if backwards t then Past else Short) (along (frame_of q M) (walk s word x))).
    { apply (proj2 (proj2 k1) x). split; [lra|exact edges]. }
    destruct (backwards t); cbn [is_at] in first; lra.
  - intros x [_ edges] at_b. assert (final : is_at (if backwards t then Short else Past) (along (frame_of q M) (walk s word x))).
    { apply ends; [split; [lra|exact edges]|exact at_b]. }
    destruct (backwards t); cbn [is_at] in final; lra.
Qed.
Lemma no_flights N M t : check_strip p q param [] N M t <> true.
Proof.
  unfold check_strip. intros h. destruct (segments t) as [|c segments]; split_checks; [discriminate|]. unfold check_segment in k1. split_checks. discriminate k1.
Qed.
End Proof.
End Strips.
