(* A program `check_strip`, on Interval's arithmetic, that decides that a word of the reduced impact map (Reduced.v) covers: that it is continuous
   on a slice of a parallelogram, and carries it across another one; and the proof that it is right (`strip_sound`).

   Parallelograms are charts of Covering.v. The slice is cut, along and across, into cells; the flights of all states of a cell are followed
   through charts that hold their images, and the last images are enclosed: between the edges of the second parallelogram, those of the cells at the
   begin of the slice beyond its one end, and those of the cells at the end of the slice beyond the other.

   All numbers of Z are numbers of the grid 2^-q, but `turns_taken`, which counts whole forcing periods:
     chart      cu, lu, wu: phases; cv, lv, wv: velocities before impact on the left wall over A W. Of h-sets, and of the charts between flights,
                the velocities are not positive. lu * wv - lv * wu > 0.
     stride     one flight of a word: whether it is to the far wall; and the whole forcing periods that are taken off: its end is seen at
                phase of arrival + (pi if far) - 2 pi turns_taken.
     transit    one flight of all states of a chart, all in phases of arrival before half a forcing period is added and turns are taken off:
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
     cells      of a patch of a chart, from one coordinate along to another and from one across to another, each from -2^q to 2^q:
                Cut_along, Cut_across: at which coordinate along or across it is cut, and the cells of what is before and after, or below and above;
                Final: a chart that contains the patch, and the transit of all of that chart (|along|, |across| <= 1) with the last flight of the word;
                Further: such a chart, its transit with the next flight, a chart that contains its image, and the cells of all of that one with the
                flights that follow.
     strip      begins_at, ends_at: the coordinates along of the slice, -2^q <= begins_at < ends_at <= 2^q; opens_until, closes_from: where the
                begin of the slice ends, and where its end begins, between these; opening, inner, closing: the cells of the patches from begins_at
                to opens_until, from there to closes_from, and from there to ends_at, all of them across; backwards: false if along the second chart the
                images of the opening are at <= -1 and those of the closing at >= 1, true if it is the other way round. *)
From Coq Require Import Reals Lra List ZArith Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Horseshoe Return Certificate Covering Covers Reduced.
Open Scope R_scope.
Import ListNotations.

Inductive cells :=
| Final (within : chart) (passes : transit) | Further (within : chart) (passes : transit) (into : chart) (then_ : cells)
| Cut_along (cut : Z) (before after : cells) | Cut_across (cut : Z) (below above : cells).
Record strip := Strip { begins_at : Z; ends_at : Z; backwards : bool; opens_until : Z; closes_from : Z; opening : cells; inner : cells; closing : cells }.
(* For a word without a claimed strip. *)
Definition no_strip : strip :=
  let nowhere := Final (Chart 0 0 0 0 0 0) (Transit 0 0 0 0 0 0 0 0) in Strip 0 0 false 0 0 nowhere nowhere nowhere.

(* Decides whether a patch of a chart, from a to b along and from c to d across, is inside another chart: its corners are. *)
Definition contained (q : positive) (N C : chart) (a b c d : Z) : bool :=
  let most := (2 ^ Zpos q * chart_area C)%Z in
  let corner i j :=
    let u := (2 ^ Zpos q * (cu N - cu C) + lu N * i + wu N * j)%Z in let v := (2 ^ Zpos q * (cv N - cv C) + lv N * i + wv N * j)%Z in
    ((Z.abs (wv C * u - wu C * v) <=? most) && (Z.abs (lu C * v - lv C * u) <=? most))%Z in
  corner a c && corner a d && corner b c && corner b d.

(* The place of images: in all of a chart; before its one end, or beyond its other; or anywhere along it. Always between its edges. *)
Inductive extent := Contained | Short | Past | Anywhere.

Module Strips (F : FloatOps with Definition sensible_format := true).
Include Coverings F.
Local Opaque add sub mul quotient whole hull sine cosine.

Section Program.
Variables p q : positive.
Variable param : data.
Notation OS := (known_in param p).

Notation unit := (2 ^ Zpos q)%Z.

(* Bounds of where the flights of all states of a chart N arrive: their coordinates along and across M, times its area; if they all arrive, and M is a chart. *)
Definition bounds (f : stride) (N M : chart) (c : transit) : option (I.type * I.type) :=
  let w1 := reaching f in let box := launches p q param left N (- unit) unit in let seen := look p OS box p in
  if (0 <? chart_area M)%Z &? check_arrivals p q param w1 N (- unit) unit box seen c then
    let K := mul p (whole p (half_turns_off f)) (I.pi (F.PtoP p)) in let D := reach p q (- unit) unit in
    Some (along_of p q K (far f) M (arrived p q param w1 N box seen c (lean_along c) D), across_of p q K (far f) M (arrived p q param w1 N box seen c (lean_across c) D))
  else None.
(* One flight of all states of a chart, as it is seen in M. *)
Definition check_tread (f : stride) (N M : chart) (c : transit) (where_to : extent) : bool :=
  match bounds f N M c with
  | None => false
  | Some (along, across) => let edge := area_over p q M in
    is_not_negative (sub p edge across) &? is_not_negative (add p edge across) &?
    match where_to with
    | Anywhere => true
    | Short => is_not_negative (I.neg (add p along edge))
    | Past => is_not_negative (sub p along edge)
    | Contained => is_not_negative (sub p edge along) &? is_not_negative (add p edge along)
    end
  end.

(* All flights of a word, from a patch of N. *)
Fixpoint check_cells (t : cells) (word : list stride) (N M : chart) (a b c d : Z) (where_to : extent) : bool :=
  match t with
  | Cut_along m before after => check_cells before word N M a m c d where_to &? check_cells after word N M m b c d where_to
  | Cut_across m below above => check_cells below word N M a b c m where_to &? check_cells above word N M a b m d where_to
  | Final C passes => match word with [f] => contained q N C a b c d &? check_tread f C M passes where_to | _ => false end
  | Further C passes C' then_ => match word with
    | f :: word => contained q N C a b c d &? check_tread f C C' passes Contained &? check_cells then_ word C' M (- unit) unit (- unit) unit where_to
    | [] => false
    end
  end.
Definition check_strip (word : list stride) (N M : chart) (t : strip) : bool :=
  (0 <? chart_area N)%Z &? (- unit <=? begins_at t)%Z &? (begins_at t <? ends_at t)%Z &? (ends_at t <=? unit)%Z &? (begins_at t <=? opens_until t)%Z &? (closes_from t <=? ends_at t)%Z &?
  check_cells (opening t) word N M (begins_at t) (opens_until t) (- unit) unit (if backwards t then Past else Short) &?
  check_cells (closing t) word N M (closes_from t) (ends_at t) (- unit) unit (if backwards t then Short else Past) &?
  check_cells (inner t) word N M (opens_until t) (closes_from t) (- unit) unit Anywhere.
End Program.

Section Proof.
Variables p q : positive.
Variable param : data.
Variable s : scene.
Hypothesis described : describes param s.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.
Hypothesis gap_positive : 0 < d s.
Notation unit := (2 ^ Zpos q)%Z.

(* A patch of a parallelogram. *)
Definition patch (N : chart) (a b c d : Z) (x : state) : Prop :=
  grid q a <= along (frame_of q N) x <= grid q b /\ grid q c <= across (frame_of q N) x <= grid q d.
Lemma patch_whole N a b x : patch N a b (- unit) unit x <-> slice (frame_of q N) (grid q a) (grid q b) x.
Proof. unfold patch, slice. rewrite grid_opp, whole_unit. tauto. Qed.
Lemma closed_patch N a b c d : closed (patch N a b c d).
Proof.
  apply closed_and; [apply (closed_comp (along (frame_of q N)) (fun r => grid q a <= r <= grid q b))|
    apply (closed_comp (across (frame_of q N)) (fun r => grid q c <= r <= grid q d))]; try apply closed_from_to; [apply along_continuous|apply across_continuous].
Qed.

(* A bilinear function attains its maximum over a rectangle at a corner. *)
Lemma at_corners (k m n a b c d xi eta most : R) : a <= xi <= b -> c <= eta <= d ->
  Rabs (k + m * a + n * c) <= most -> Rabs (k + m * a + n * d) <= most -> Rabs (k + m * b + n * c) <= most -> Rabs (k + m * b + n * d) <= most ->
  Rabs (k + m * xi + n * eta) <= most.
Proof.
  intros hx hy h1 h2 h3 h4. apply Rabs_le_between in h1, h2, h3, h4. apply Rabs_le.
  destruct (Rle_lt_dec 0 m), (Rle_lt_dec 0 n); split; nra.
Qed.
Lemma contained_sound N C a b c d : contained q N C a b c d = true -> (0 < chart_area N)%Z -> (0 < chart_area C)%Z ->
  forall x, patch N a b c d x -> in_frame (frame_of q C) x.
Proof.
  intros check areaN areaC x [hx hy]. unfold contained in check. cbv zeta in check.
  apply andb_prop in check as [check h4]. apply andb_prop in check as [check h3]. apply andb_prop in check as [h1 h2].
  assert (corner : forall i j, let u := (2 ^ Zpos q * (cu N - cu C) + lu N * i + wu N * j)%Z in let v := (2 ^ Zpos q * (cv N - cv C) + lv N * i + wv N * j)%Z in
    ((Z.abs (wv C * u - wu C * v) <=? 2 ^ Zpos q * chart_area C) && (Z.abs (lu C * v - lv C * u) <=? 2 ^ Zpos q * chart_area C))%Z = true ->
    Rabs (along_area (frame_of q C) (put (frame_of q N) (grid q i) (grid q j))) <= area (frame_of q C) /\
    Rabs (across_area (frame_of q C) (put (frame_of q N) (grid q i) (grid q j))) <= area (frame_of q C)).
  { intros i j u v h. apply andb_prop in h as [hu hv]. apply Z.leb_le, IZR_le in hu, hv.
    rewrite abs_IZR, mult_IZR in hu, hv. assert (g := grid_step q). assert (whole := whole_unit q). unfold grid in whole.
    set (s2 := IZR (2 ^ Zpos q)) in *. set (r := / s2) in *.
    assert (is_area : area (frame_of q C) = r * r * r * (s2 * IZR (chart_area C))).
    { replace (r * r * r * (s2 * IZR (chart_area C))) with (r * s2 * (r * r * IZR (chart_area C))) by ring. rewrite whole. unfold chart_area.
      rewrite minus_IZR, !mult_IZR. unfold area, frame_of, grid. cbn [long wide fst snd]. fold s2 r. ring. }
    assert (scaled : forall y z, y = r * r * r * z -> Rabs z <= s2 * IZR (chart_area C) -> Rabs y <= area (frame_of q C)).
    { intros y z -> hz. assert (0 < r * r * r) by (apply Rmult_lt_0_compat; [apply Rmult_lt_0_compat|]; exact g).
      rewrite is_area, Rabs_mult, (Rabs_pos_eq (r * r * r)) by lra. apply Rmult_le_compat_l; lra. }
    assert (at_u : fst (put (frame_of q N) (grid q i) (grid q j)) - grid q (cu C) = r * r * IZR u).
    { unfold u. rewrite !plus_IZR, !mult_IZR, minus_IZR. unfold put, frame_of, grid. cbn [centre long wide fst snd]. fold s2 r.
      replace (r * r * (s2 * (IZR (cu N) - IZR (cu C)) + IZR (lu N) * IZR i + IZR (wu N) * IZR j)) with
        (r * s2 * (r * (IZR (cu N) - IZR (cu C))) + r * IZR (lu N) * (r * IZR i) + r * IZR (wu N) * (r * IZR j)) by ring. rewrite whole. ring. }
    assert (at_v : snd (put (frame_of q N) (grid q i) (grid q j)) - grid q (cv C) = r * r * IZR v).
    { unfold v. rewrite !plus_IZR, !mult_IZR, minus_IZR. unfold put, frame_of, grid. cbn [centre long wide fst snd]. fold s2 r.
      replace (r * r * (s2 * (IZR (cv N) - IZR (cv C)) + IZR (lv N) * IZR i + IZR (wv N) * IZR j)) with
        (r * s2 * (r * (IZR (cv N) - IZR (cv C))) + r * IZR (lv N) * (r * IZR i) + r * IZR (wv N) * (r * IZR j)) by ring. rewrite whole. ring. }
    unfold along_area, across_area. change (centre (frame_of q C)) with (grid q (cu C), grid q (cv C)).
    cbn [fst snd] in at_u, at_v |- *. rewrite at_u, at_v. unfold frame_of. cbn [long wide fst snd].
    split; [apply (scaled _ _) with (2 := hu)|apply (scaled _ _) with (2 := hv)]; rewrite minus_IZR, !mult_IZR; unfold grid; fold s2 r; ring. }
  apply corner in h1, h2, h3, h4. clear corner. rewrite <- (put_back (frame_of q N) x) by (apply Rgt_not_eq, chart_area_positive, areaN).
  set (xi := along _ x) in *. set (eta := across _ x) in *. assert (pos := chart_area_positive q C areaC).
  assert (inside : forall y, Rabs y <= area (frame_of q C) -> -1 <= y / area (frame_of q C) <= 1).
  { intros y hy'. apply Rabs_le_between in hy'. split; apply (Rmult_le_reg_r (area (frame_of q C))); try exact pos; unfold Rdiv; rewrite Rmult_assoc, Rinv_l; lra. }
  split; apply inside.
  - assert (linear : forall i j, along_area (frame_of q C) (put (frame_of q N) i j) = along_area (frame_of q C) (centre (frame_of q N)) +
      (grid q (wv C) * grid q (lu N) - grid q (wu C) * grid q (lv N)) * i + (grid q (wv C) * grid q (wu N) - grid q (wu C) * grid q (wv N)) * j)
      by (intros i j; unfold along_area, put, frame_of; cbn [centre long wide fst snd]; ring).
    rewrite !linear in *. exact (at_corners _ _ _ _ _ _ _ _ _ _ hx hy (proj1 h1) (proj1 h2) (proj1 h3) (proj1 h4)).
  - assert (linear : forall i j, across_area (frame_of q C) (put (frame_of q N) i j) = across_area (frame_of q C) (centre (frame_of q N)) +
      (grid q (lu C) * grid q (lv N) - grid q (lv C) * grid q (lu N)) * i + (grid q (lu C) * grid q (wv N) - grid q (lv C) * grid q (wu N)) * j)
      by (intros i j; unfold across_area, put, frame_of; cbn [centre long wide fst snd]; ring).
    rewrite !linear in *. exact (at_corners _ _ _ _ _ _ _ _ _ _ hx hy (proj2 h1) (proj2 h2) (proj2 h3) (proj2 h4)).
Qed.

Definition is_at (where_to : extent) (z : R) : Prop :=
  match where_to with Anywhere => True | Short => z <= -1 | Past => 1 <= z | Contained => -1 <= z <= 1 end.
(* The map of a word on a set of states, seen in a chart. *)
Definition sent (word : list stride) (M : chart) (where_to : extent) (P : state -> Prop) : Prop :=
  (forall x, P x -> walks s word x) /\ continuous_on P (walk s word) /\
  forall x, P x -> -1 <= across (frame_of q M) (walk s word x) <= 1 /\ is_at where_to (along (frame_of q M) (walk s word x)).
Lemma sent_part word M where_to (P Q : state -> Prop) : (forall x, Q x -> P x) -> sent word M where_to P -> sent word M where_to Q.
Proof. intros part (flies & cont & into). split; [auto|]. split; [exact (on_part P Q _ part cont)|auto]. Qed.
Lemma sent_either word M where_to (P Q R : state -> Prop) : closed P -> closed Q -> (forall x, R x -> P x \/ Q x) ->
  sent word M where_to P -> sent word M where_to Q -> sent word M where_to R.
Proof.
  intros shutP shutQ either (flies1 & cont1 & into1) (flies2 & cont2 & into2). apply (sent_part _ _ _ (fun x => P x \/ Q x) R either).
  split; [intros x [h|h]; auto|]. split; [apply on_either; assumption|intros x [h|h]; auto].
Qed.
Lemma sent_anywhere word M where_to P : sent word M where_to P -> sent word M Anywhere P.
Proof. intros (flies & cont & into). split; [exact flies|]. split; [exact cont|]. intros x hx. split; [apply (into x hx)|exact I]. Qed.

Lemma tread_sound f N M c where_to : check_tread p q param f N M c where_to = true ->
  (0 < chart_area N)%Z /\ (0 < chart_area M)%Z /\ sent [f] M where_to (in_frame (frame_of q N)).
Proof.
  unfold check_tread, bounds. cbv zeta. intros check. destruct (0 <? chart_area M)%Z eqn:areaM; [|discriminate check]. apply Z.ltb_lt in areaM.
  destruct (check_arrivals _ _ _ _ _ _ _ _ _ _) eqn:arrive in check; [|discriminate check]. split_checks.
  destruct (arrivals_sound p q param s described A_positive W_positive gap_positive left (reaching f) N (- unit) unit c arrive) as (areaN & all & cont & landed).
  rewrite grid_opp, whole_unit in all, cont, landed. fold (in_frame (frame_of q N)) in all, cont, landed.
  set (K := mul p (whole p (half_turns_off f)) (I.pi (F.PtoP p))) in *.
  assert (hK : holds K (IZR (half_turns_off f) * PI)) by (apply holds_mul; [apply holds_whole|apply I.pi_correct]).
  assert (edge := holds_area p q M). split; [exact areaN|]. split; [exact areaM|]. unfold sent. cbn [walks walk].
  split; [intros x hx; split; [exact (all x hx)|exact I]|]. split.
  { apply (continuous_on_ext (in_frame (frame_of q N)) (fun x : state => shifted (IZR (half_turns_off f) * PI) (far f) (fly s left x))); [intros x _; symmetry; apply tread_shifted|].
    apply (on_comp _ (fun _ => True) (fly s left) (shifted (IZR (half_turns_off f) * PI) (far f))); [exact cont|apply shifted_continuous|auto]. }
  intros x hx. rewrite tread_shifted.
  assert (reached : holds (reach p q (- unit) unit) (along (frame_of q N) x - (-1 + 1) / 2)).
  { assert (h := holds_reach p q N (- unit) unit x). rewrite grid_opp, whole_unit in h. apply h, hx. }
  assert (linear := fun mu n1 n2 n0 N1 N2 N0 h1 h2 h0 => landed x n1 n2 n0 N1 N2 N0 mu _ hx h1 h2 h0 reached).
  assert (far_across := across_of_holds p q _ _ (far f) M _ _ hK areaM (linear (lean_across c))).
  assert (far_along := along_of_holds p q _ _ (far f) M _ _ hK areaM (linear (lean_along c))).
  split; [eapply (between_edges p q _ _ M _ areaM edge far_across); assumption|].
  destruct where_to; cbn [is_at]; [|exact (before_end p q _ _ M _ areaM edge far_along check)|exact (after_end p q _ _ M _ areaM edge far_along check)|exact I].
  split_checks. eapply (between_edges p q _ _ M _ areaM edge far_along); assumption.
Qed.

Lemma cells_sound t : forall word N M a b c d where_to, (0 < chart_area N)%Z -> check_cells p q param t word N M a b c d where_to = true ->
  sent word M where_to (patch N a b c d).
Proof.
  induction t as [C k|C k C' t IH|m before IH1 after IH2|m below IH1 above IH2]; intros word N M a b c d where_to areaN check; cbn [check_cells] in check.
  - destruct word as [|f [|g word]]; try discriminate. split_checks. destruct (tread_sound _ _ _ _ _ check) as (areaC & _ & all).
    exact (sent_part _ _ _ _ _ (contained_sound N C a b c d k0 areaN areaC) all).
  - destruct word as [|f word]; [discriminate|]. split_checks. destruct (tread_sound _ _ _ _ _ k1) as (areaC & areaC' & flies1 & cont1 & in1).
    destruct (IH _ _ _ _ _ _ _ _ areaC' check) as (flies2 & cont2 & in2). apply (sent_part _ _ _ (in_frame (frame_of q C)) _ (contained_sound N C a b c d k0 areaN areaC)).
    assert (into : forall x, in_frame (frame_of q C) x -> patch C' (- unit) unit (- unit) unit (tread s f x)).
    { intros x hx. destruct (in1 x hx). apply patch_whole. rewrite grid_opp, whole_unit. split; assumption. }
    split; [intros x hx; split; [apply (flies1 x hx)|exact (flies2 _ (into x hx))]|]. split; [|intros x hx; exact (in2 _ (into x hx))].
    exact (on_comp _ _ (tread s f) (walk s word) cont1 cont2 into).
  - split_checks. apply (sent_either _ _ _ (patch N a m c d) (patch N m b c d)); auto using closed_patch.
    intros x [hx hy]. destruct (Rle_lt_dec (along (frame_of q N) x) (grid q m)); [left|right]; (split; [lra|exact hy]).
  - split_checks. apply (sent_either _ _ _ (patch N a b c m) (patch N a b m d)); auto using closed_patch.
    intros x [hx hy]. destruct (Rle_lt_dec (across (frame_of q N) x) (grid q m)); [left|right]; (split; [exact hx|lra]).
Qed.

Theorem strip_sound word N M t : check_strip p q param word N M t = true ->
  covers (frame_of q N) (frame_of q M) (grid q (begins_at t)) (grid q (ends_at t)) (if backwards t then -1 else 1) (walk s word) /\
  forall x, slice (frame_of q N) (grid q (begins_at t)) (grid q (ends_at t)) x -> walks s word x.
Proof.
  intros check. unfold check_strip in check. split_checks. apply Z.ltb_lt in k, k1. apply Z.leb_le in k0, k2, k3, k4.
  apply (cells_sound _ _ _ _ _ _ _ _ _ k) in k5, k6, check.
  set (a := begins_at t) in *. set (b := ends_at t) in *. set (a1 := opens_until t) in *. set (b1 := closes_from t) in *.
  assert (all : sent word M Anywhere (slice (frame_of q N) (grid q a) (grid q b))).
  { apply (sent_part _ _ _ (patch N a b (- unit) unit)); [intros x; apply patch_whole|].
    apply (sent_either _ _ _ (patch N a a1 (- unit) unit) (patch N a1 b (- unit) unit)); eauto using closed_patch, sent_anywhere.
    - intros x [hx hy]. destruct (Rle_lt_dec (along (frame_of q N) x) (grid q a1)); [left|right]; (split; [lra|exact hy]).
    - apply (sent_either _ _ _ (patch N a1 b1 (- unit) unit) (patch N b1 b (- unit) unit)); eauto using closed_patch, sent_anywhere.
      intros x [hx hy]. destruct (Rle_lt_dec (along (frame_of q N) x) (grid q b1)); [left|right]; (split; [lra|exact hy]). }
  destruct all as (flying & cont & flat). split; [|exact flying].
  assert (ga := grid_le q _ _ k0). assert (gb := grid_le q _ _ k2). rewrite grid_opp, whole_unit in ga. rewrite whole_unit in gb.
  assert (ab : grid q a < grid q b) by (apply Rmult_lt_compat_l; [apply grid_step|apply IZR_lt, k1]).
  assert (gc := grid_le q _ _ k3). assert (gc' := grid_le q _ _ k4).
  split; try assumption.
  - destruct (backwards t); auto.
  - intros x hx. apply (flat x hx).
  - intros x hx at_a. apply patch_whole in hx as [_ edges]. destruct k5 as (_ & _ & first).
    assert (here : patch N a a1 (- unit) unit x) by (split; [lra|exact edges]). specialize (first x here).
    destruct (backwards t); cbn [is_at] in first; lra.
  - intros x hx at_b. apply patch_whole in hx as [_ edges]. destruct k6 as (_ & _ & final).
    assert (here : patch N b1 b (- unit) unit x) by (split; [lra|exact edges]). specialize (final x here).
    destruct (backwards t); cbn [is_at] in final; lra.
Qed.
Lemma no_flights N M t : check_strip p q param [] N M t <> true.
Proof.
  assert (none : forall t a b c d where_to, check_cells p q param t [] N M a b c d where_to <> true).
  { induction t0 as [| |m before IH1 after IH2|m below IH1 above IH2]; intros a b c d w h; cbn [check_cells] in h; try discriminate; split_checks; exact (IH1 _ _ _ _ _ k). }
  unfold check_strip. intros h. split_checks. exact (none _ _ _ _ _ _ h).
Qed.
End Proof.
End Strips.
