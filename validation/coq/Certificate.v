(* Certificates of orbits, their statements, and a program that checks them, proved sound once and for all. `orbit_checked` (at the end) turns a
   run of `check` by Coq's own evaluator into a theorem about the model of Model.v: from the given start there is exactly one sequence of first
   contacts, it has the listed walls, and its times and velocities lie within the printed bounds. A leg of the certificate encloses one impact in
   phases and unit speeds (Step.v): th in [t - rt, t + rt], v/(A W) in [v - rv, v + rv], all in units of 2^-scale. Bounds in the launch are of
   mean-value form, with the entries of (A.7). *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig Float.Specific_ops Float.Specific_stdz Float.Specific_bigint.
From ImpactPair Require Import Model Step.
From ImpactPair Require Export Enclosure Data Course.
Open Scope R_scope.
Import ListNotations.

(* Checks with interval arithmetic on floats F; two instances at the end. *)
Module Checker (F : FloatOps with Definition sensible_format := true).
Include Courses F.
Local Opaque add sub mul quotient whole hull sine cosine.

Section Data.
Variable param : data.

Definition gamma_in (p : positive) : I.type := quotient p (enclose_range p (gap param)) (enclose_range p (amplitude param)).

(* A harmonic in the units of the reference. *)
Definition known_of (p : positive) (x : tone) : known :=
  let ratio := quotient p (enclose_range p (frequency x)) (enclose_range p (frequency param)) in
  {| Share := quotient p (enclose_range p (amplitude x)) (enclose_range p (amplitude param)); Ratio := ratio;
     Lag := sub p (enclose_range p (shift x)) (mul p ratio (enclose_range p (shift param))) |}.
Definition known_in (p : positive) : list known := map (known_of p) (further param).

(* The departure from wall w, or from nowhere. *)
Definition check_departure (OS : list known) (b : box) (l : leg) : bool :=
  let c := coarse l in let q := scale l in let p := bits l in
  let step := unit_step p q in let rough := unit_step c q in
  match from b with
  | None => is_not_negative (sub p (T b) (point p step (depart l))) &? is_not_negative (sub p (point p step (approach l)) (T b))
  | Some w => let low := (lowest b * 2 ^ Zpos q / 2 ^ Zpos (box_scale b) - 1)%Z in let a := look c OS b c in
    is_not_negative (sub p (point p step (depart l)) (T b)) &? is_not_negative (sub p (T b) (point p step low)) &?
    (if sweep (inwards_over c OS b a q rough w) depth low (depart l) then true
     else is_not_negative (I.neg (sided w (U b))) &? sweep (pressed_over c OS q rough w) depth low (depart l))
  end.

(* The flight of all launches of a box, once they have departed: its first contact is on the leg's wall, in the leg's bracket of phases. *)
Definition check_course (b : box) (l : leg) : bool :=
  let p := bits l in let c := coarse l in let q := scale l in let w := hits l in let OS := known_in p in
  let G := gamma_in p in let step := unit_step p q in let rough := unit_step c q in
  let a := look p OS b c in let ac := look c OS b c in let lo := (t l - rt l)%Z in let hi := (t l + rt l)%Z in
  (0 <=? rt l)%Z &? (depart l <=? approach l)%Z &? (approach l <=? lo)%Z &?
  is_positive (sub p (point p step lo) (T b)) &?
  sweep (inside_over c OS (gamma_in c) b ac q rough) depth (depart l) (approach l) &?
  sweep (inwards_over c OS b ac q rough (opposite w)) depth (approach l) hi &?
  is_positive (I.neg (sided w (add p (offset p G b w) (rise_at p OS b a q step lo)))) &?
  is_not_negative (sided w (add p (offset p G b w) (rise_at p OS b a q step hi))).
Definition check_flight (b : box) (l : leg) : bool := check_departure (known_in (bits l)) b l &? check_course b l.

(* The phase at a time, and velocities of unit speeds. *)
Definition phase_over (p : positive) (time : I.type) : I.type :=
  add p (mul p (enclose_range p (frequency param)) time) (enclose_range p (shift param)).
Definition velocity_over (p : positive) (speed : I.type) : I.type :=
  mul p (mul p (enclose_range p (amplitude param)) (enclose_range p (frequency param))) speed.

(* Decides whether the printed bounds hold all phases and unit speeds between grid points. *)
Definition check_shown (p : positive) (step : I.type) (lo hi slow fast : Z) (printed : bounds) : bool :=
  let TH := stretch p step lo hi in let V := velocity_over p (stretch p step slow fast) in
  bounded p (phase_over p (known_number p (time_lower printed))) TH (phase_over p (known_number p (time_upper printed))) &?
  is_within p (velocity_lower printed, velocity_upper printed) V.

(* Its velocity on arrival; and all that is printed of it. *)
Definition check_arrival (b : box) (l : leg) (printed : bounds) : bool :=
  let p := bits l in let c := coarse l in let q := scale l in let w := hits l in let OS := known_in p in
  let step := unit_step p q in let a := look p OS b c in let lo := (t l - rt l)%Z in let hi := (t l + rt l)%Z in
  (0 <=? rv l)%Z &?
  between p step (arrival p OS (gamma_in p) b c a q step w (t l) (rt l) (tilt l)) (v l - rv l) (v l + rv l) &?
  match w, on printed with left, left | right, right => true | _, _ => false end &?
  check_shown p step lo hi (v l - rv l) (v l + rv l) printed.
Definition check_leg (b : box) (l : leg) (printed : bounds) : bool := check_flight b l &? check_arrival b l printed.
Definition landed (l : leg) : box :=
  landing (bits l) (enclose_range (bits l) (restitution param)) (hits l) (scale l) (t l) (rt l) (v l) (rv l).

Fixpoint check_legs (b : box) (legs : list leg) (printed : list bounds) : bool :=
  match legs, printed with
  | [], [] => true
  | l :: legs, i :: printed => check_leg b l i &? check_legs (landed l) legs printed
  | _, _ => false
  end.

Variable s : scene.
Hypothesis described : describes param s.
Hypothesis A_positive : 0 < A s.
Hypothesis W_positive : 0 < W s.

Lemma holds_gamma p : holds (gamma_in p) (d s / A s).
Proof. destruct described as ((a & _) & _ & g & _). apply holds_quotient; apply holds_range; assumption. Qed.

Lemma holds_known p : Forall2 knows (known_in p) (companions s).
Proof.
  destruct described as ((hA & hW & ht) & others & _). unfold known_in, companions. induction others as [|x h xs hs (a & w & t) rest IH]; [constructor|].
  cbn [map]. constructor; [|exact IH]. unfold knows, known_of, companion_of. cbn [Share Ratio Lag share ratio lag].
  apply (holds_range p) in hA, hW, ht, a, w, t. split; [|split]; enclose.
Qed.

(* A launch of the model is in a box. *)
Definition launched (b : box) (l : launch) : Prop :=
  exists thc uc, in_box (d s / A s) (place l / A s) (phase s (since l)) (unit_speed s (speed l)) thc uc b.

(* th0 <= depart, the departure is inwards, or the flight is followed in the gap from th0 on. *)
Lemma departure_sound OS b l gamma y th0 u thc uc (os := companions s) : Forall2 knows OS os -> in_box gamma y th0 u thc uc b ->
  check_departure OS b l = true ->
  let q := scale l in exists ta, (ta = th0 \/ exists w0, y = side w0 * (gamma / 2) /\ leaves os w0 th0 u ta) /\
  th0 <= ta /\ grid q (depart l) <= ta /\ (ta <= grid q (approach l) \/ ta = grid q (depart l)).
Proof.
  intros hos inb check q. assert (ac := look_seen _ _ _ _ _ _ _ (coarse l) _ (coarse l) b hos inb).
  assert (sp := unit_step_holds (bits l) q). assert (sc := unit_step_holds (coarse l) q).
  pose proof inb as (hf & h0 & _ & _ & _ & hu & _). unfold check_departure in check. fold q in check.
  destruct (from b) as [w|] eqn:f.
  - split_checks. assert (a1 : 0 <= grid q (depart l) - th0) by (apply (is_not_negative_sound _ _ k); enclose).
    set (low := (lowest b * 2 ^ Zpos q / 2 ^ Zpos (box_scale b) - 1)%Z) in *.
    assert (a2 : 0 <= th0 - grid q low) by (apply (is_not_negative_sound _ _ k0); enclose).
    exists (grid q (depart l)). split; [right; exists w; split; [exact hf|]|lra].
    destruct (sweep (inwards_over _ _ _ _ _ _ _) _ _ _) eqn:d in check.
    + left. intros th r. refine (sweep_sound q _ (fun x => 0 < - side w * rate os th0 u x) _ _ _ _ d th _); [|lra].
      intros i j h x rx. exact (inwards_sound _ _ _ _ _ _ _ _ _ hos _ inb _ ac q _ sc _ _ _ h x rx).
    + right. split_checks. split.
      * replace (- side w * u) with (- (side w * u)) by ring. apply (is_not_negative_sound _ _ k1). enclose.
      * intros th r. refine (sweep_sound q _ (fun x => 0 < - side w * box_bend os x) _ _ _ _ check th _); [|lra].
        intros i j h x rx. exact (pressed_sound _ _ _ hos q _ sc _ _ _ h x rx).
  - split_checks. exists th0. split; [left; reflexivity|].
    assert (0 <= th0 - grid q (depart l)) by (apply (is_not_negative_sound _ _ k); enclose).
    assert (0 <= grid q (approach l) - th0) by (apply (is_not_negative_sound _ _ check); enclose). lra.
Qed.

(* The condition on a departure. *)
Definition departs (leg : leg) (y th0 u : R) : Prop := exists ta, (ta = th0 \/ exists w0, y = side w0 * (d s / A s / 2) /\ leaves (companions s) w0 th0 u ta) /\
  th0 <= ta /\ grid (scale leg) (depart leg) <= ta /\ (ta <= grid (scale leg) (approach leg) \/ ta = grid (scale leg) (depart leg)).

Lemma course_sound b leg l thc uc : in_box (d s / A s) (place l / A s) (phase s (since l)) (unit_speed s (speed l)) thc uc b ->
  departs leg (place l / A s) (phase s (since l)) (unit_speed s (speed l)) -> check_course b leg = true -> exists i, reaches s l i /\ wall_of i = hits leg /\
    grid (scale leg) (t leg - rt leg) <= phase s (time i) <= grid (scale leg) (t leg + rt leg) /\
    place l / A s + rise (companions s) (phase s (since l)) (unit_speed s (speed l)) (phase s (time i)) = side (hits leg) * (d s / A s / 2) /\
    unit_speed s (velocity i) = rate (companions s) (phase s (since l)) (unit_speed s (speed l)) (phase s (time i)) /\
    forall th, grid (scale leg) (t leg - rt leg) <= th <= grid (scale leg) (t leg + rt leg) ->
      0 < side (hits leg) * rate (companions s) (phase s (since l)) (unit_speed s (speed l)) th.
Proof.
  intros inb left_ check. unfold check_course in check. cbv zeta in check.
  set (p := bits leg) in *. set (c := coarse leg) in *. set (q := scale leg) in *.
  set (lo := (t leg - rt leg)%Z) in *. set (hi := (t leg + rt leg)%Z) in *.
  assert (Gp := holds_gamma p). assert (Gc := holds_gamma c).
  assert (sp := unit_step_holds p q). assert (sc := unit_step_holds c q).
  set (OS := known_in p) in *. set (os := companions s) in *. assert (hos : Forall2 knows OS os) by apply holds_known.
  assert (ap := look_seen _ _ _ _ _ _ _ p _ c b hos inb). assert (ac := look_seen _ _ _ _ _ _ _ c _ c b hos inb).
  split_checks. rename check into high_check.
  set (th0 := phase s (since l)) in *. set (u := unit_speed s (speed l)) in *. set (gamma := d s / A s) in *.
  set (y := place l / A s) in *.
  assert (hT : holds (T b) th0) by apply inb.
  assert (rt0 : (0 <= rt leg)%Z) by (apply Z.leb_le; assumption).
  assert (order1 : (depart leg <= approach leg)%Z) by (apply Z.leb_le; assumption).
  assert (order2 : (approach leg <= lo)%Z) by (apply Z.leb_le; assumption).
  apply (grid_le q) in order1. apply (grid_le q) in order2.
  assert (order3 : grid q lo <= grid q hi) by (apply grid_le; unfold lo, hi; lia).
  assert (order4 : 0 < grid q lo - th0) by (apply (is_positive_sound _ _ k2); enclose).
  destruct left_ as (ta & departs & o1 & o2 & o3). fold q in o2, o3.
  assert (off := holds_offset gamma y th0 u thc uc p _ Gp b inb (hits leg)).
  assert (low := holds_rise_at gamma y th0 u thc uc os p OS hos b inb _ ap q _ sp lo).
  assert (high := holds_rise_at gamma y th0 u thc uc os p OS hos b inb _ ap q _ sp hi).
  assert (arriving : forall th, grid q (approach leg) <= th <= grid q hi -> 0 < side (hits leg) * rate os th0 u th).
  { intros th r. replace (side (hits leg)) with (- side (opposite (hits leg))) by (rewrite side_opposite; ring).
    refine (sweep_sound q _ (fun x => 0 < - side (opposite (hits leg)) * rate os th0 u x) _ _ _ _ k4 th _); [|lra].
    intros i j h x rx. exact (inwards_sound _ _ _ _ _ _ _ _ _ hos _ inb _ ac q _ sc _ _ _ h x rx). }
  destruct (flight s A_positive W_positive l (hits leg) ta (grid q (approach leg)) (grid q lo) (grid q hi)) as (i & reach & same & r1 & onwall & vel).
  - fold th0. destruct o3; lra.
  - lra.
  - fold th0. lra.
  - replace (d s / A s / 2) with (gamma / 2) by reflexivity. exact departs.
  - fold th0 u y os. intros th r. replace (d s / A s / 2) with (gamma / 2) by reflexivity.
    refine (sweep_sound q _ (fun x => Rabs (y + rise os th0 u x) < gamma / 2) _ _ _ _ k3 th _); [|lra].
    intros i j h x rx. exact (inside_sound _ _ _ _ _ _ _ _ _ hos _ Gc _ inb _ ac q _ sc _ _ h x rx).
  - fold th0 u os. exact arriving.
  - fold th0 u y os. replace (d s / A s / 2) with (gamma / 2) by reflexivity.
    assert (0 < - (side (hits leg) * (y - side (hits leg) * (gamma / 2) + rise os th0 u (grid q lo)))) by (apply (is_positive_sound _ _ k5); enclose).
    destruct (hits leg); cbn [side] in *; lra.
  - fold th0 u y os. replace (d s / A s / 2) with (gamma / 2) by reflexivity.
    assert (0 <= side (hits leg) * (y - side (hits leg) * (gamma / 2) + rise os th0 u (grid q hi))) by (apply (is_not_negative_sound _ _ high_check); enclose).
    destruct (hits leg); cbn [side] in *; lra.
  - exists i. split; [exact reach|]. split; [exact same|]. split; [exact r1|]. split; [exact onwall|]. split; [exact vel|].
    intros th r. apply arriving. lra.
Qed.

Lemma flight_sound b leg l thc uc : in_box (d s / A s) (place l / A s) (phase s (since l)) (unit_speed s (speed l)) thc uc b ->
  check_flight b leg = true -> exists i, reaches s l i /\ wall_of i = hits leg /\
    grid (scale leg) (t leg - rt leg) <= phase s (time i) <= grid (scale leg) (t leg + rt leg) /\
    place l / A s + rise (companions s) (phase s (since l)) (unit_speed s (speed l)) (phase s (time i)) = side (hits leg) * (d s / A s / 2) /\
    unit_speed s (velocity i) = rate (companions s) (phase s (since l)) (unit_speed s (speed l)) (phase s (time i)) /\
    forall th, grid (scale leg) (t leg - rt leg) <= th <= grid (scale leg) (t leg + rt leg) ->
      0 < side (hits leg) * rate (companions s) (phase s (since l)) (unit_speed s (speed l)) th.
Proof.
  intros inb check. unfold check_flight in check. split_checks. refine (course_sound b leg l thc uc inb _ check).
  exact (departure_sound (known_in (bits leg)) b leg (d s / A s) _ _ _ thc uc (holds_known (bits leg)) inb k).
Qed.

Lemma holds_phase_over p T t : holds T t -> holds (phase_over p T) (phase s t).
Proof.
  destruct described as ((_ & dW & dt) & _). assert (hW := holds_range p _ _ dW). assert (ht := holds_range p _ _ dt).
  intros hT. unfold phase_over, phase. enclose.
Qed.
Lemma holds_velocity_over p V v : holds V v -> holds (velocity_over p V) (A s * W s * v).
Proof.
  destruct described as ((dA & dW & _) & _). assert (hA := holds_range p _ _ dA). assert (hW := holds_range p _ _ dW).
  intros hV. unfold velocity_over. enclose.
Qed.

Lemma shown_sound p q lo hi slow fast printed i : check_shown p (unit_step p q) lo hi slow fast printed = true -> wall_of i = on printed ->
  grid q lo <= phase s (time i) <= grid q hi -> grid q slow <= unit_speed s (velocity i) <= grid q fast -> within printed i.
Proof.
  unfold check_shown. cbv zeta. intros check same r1 r2. split_checks.
  assert (sp := unit_step_holds p q).
  assert (hTH := holds_stretch p q _ sp _ _ _ r1). assert (hV := holds_velocity_over p _ _ (holds_stretch p q _ sp _ _ _ r2)).
  replace (A s * W s * unit_speed s (velocity i)) with (velocity i) in hV by (unfold unit_speed; field; lra).
  assert (times := bounded_sound _ _ _ _ _ _ _ k (holds_phase_over p _ _ (holds_number _ _)) hTH (holds_phase_over p _ _ (holds_number _ _))).
  assert (velocities := is_within_sound _ _ _ _ check hV). cbn [fst snd] in velocities.
  unfold within, phase in *. rewrite same. repeat split; nra.
Qed.

(* A flight, its impact as printed, and the launch from there. *)
Lemma landed_sound b leg printed l : launched b l -> departs leg (place l / A s) (phase s (since l)) (unit_speed s (speed l)) ->
  check_course b leg = true -> check_arrival b leg printed = true ->
  exists i, reaches s l i /\ within printed i /\ wall_of i = hits leg /\
    grid (scale leg) (t leg - rt leg) <= phase s (time i) <= grid (scale leg) (t leg + rt leg) /\
    grid (scale leg) (v leg - rv leg) <= unit_speed s (velocity i) <= grid (scale leg) (v leg + rv leg) /\
    launched (landed leg) (rebound s i).
Proof.
  intros (thc & uc & inb) left_ course check. unfold check_arrival in check. cbv zeta in check.
  destruct (course_sound b leg l thc uc inb left_ course) as (i & reach & same & r1 & onwall & vel & _).
  assert (rt0 : (0 <= rt leg)%Z) by (apply Z.leb_le; unfold check_course in course; cbv zeta in course; split_checks; reflexivity).
  set (p := bits leg) in *. set (c := coarse leg) in *. set (q := scale leg) in *.
  set (lo := (t leg - rt leg)%Z) in *. set (hi := (t leg + rt leg)%Z) in *.
  assert (sp := unit_step_holds p q).
  set (OS := known_in p) in *. set (os := companions s) in *. assert (hos : Forall2 knows OS os) by apply holds_known.
  assert (ap := look_seen _ _ _ _ _ _ _ p _ c b hos inb).
  split_checks. assert (rv0 : (0 <= rv leg)%Z) by (apply Z.leb_le; assumption).
  set (th0 := phase s (since l)) in *. set (u := unit_speed s (speed l)) in *. set (gamma := d s / A s) in *.
  set (y := place l / A s) in *.
  assert (speed_in := holds_arrival gamma y th0 u thc uc os p OS hos _ (holds_gamma p) b inb c _ ap q _ sp (hits leg) (t leg) (rt leg) (tilt leg) _ rt0 r1 onwall).
  assert (r2 := between_sound _ _ _ _ _ _ k0 speed_in). rewrite <- vel in r2.
  exists i. split; [exact reach|]. split; [|split; [exact same|split; [exact r1|split; [exact r2|]]]].
  - apply (shown_sound p q lo hi (v leg - rv leg) (v leg + rv leg)); try assumption. rewrite same.
    destruct (hits leg), (on printed); congruence.
  - exists (grid q (t leg)), (- e s * grid q (v leg)).
    assert (E := holds_range p _ _ (proj2 (proj2 (proj2 described)))).
    assert (h := landing_in p _ (hits leg) _ _ _ _ _ gamma _ _ _ rt0 rv0 E r1 r2).
    cbn [rebound place since speed]. rewrite same. fold gamma.
    replace (plane s (hits leg) / A s) with (side (hits leg) * (gamma / 2)) by (unfold plane, gamma; field; lra).
    replace (unit_speed s (- e s * velocity i)) with (- e s * unit_speed s (velocity i)) by (unfold unit_speed; field; lra).
    exact h.
Qed.
Lemma leg_departs b leg l : launched b l -> check_departure (known_in (bits leg)) b leg = true ->
  departs leg (place l / A s) (phase s (since l)) (unit_speed s (speed l)).
Proof. intros (thc & uc & inb) check. exact (departure_sound (known_in (bits leg)) b leg (d s / A s) _ _ _ thc uc (holds_known (bits leg)) inb check). Qed.

Lemma leg_sound b leg printed l : launched b l -> check_leg b leg printed = true ->
  exists i, reaches s l i /\ within printed i /\ wall_of i = hits leg /\
    grid (scale leg) (t leg - rt leg) <= phase s (time i) <= grid (scale leg) (t leg + rt leg) /\
    grid (scale leg) (v leg - rv leg) <= unit_speed s (velocity i) <= grid (scale leg) (v leg + rv leg) /\
    launched (landed leg) (rebound s i).
Proof.
  unfold check_leg, check_flight. intros inb check. split_checks. exact (landed_sound b leg printed l inb (leg_departs _ _ _ inb k0) k check).
Qed.

Lemma legs_sound legs : forall printed b l, launched b l -> check_legs b legs printed = true ->
  exists orbit, follows s l orbit /\ Forall2 within printed orbit.
Proof.
  induction legs as [|leg legs IH]; intros [|i printed] b l inb check; cbn [check_legs] in check; try discriminate.
  - exists []. split; [exact I|constructor].
  - split_checks. destruct (leg_sound b leg i l inb k) as (j & reach & inside & _ & _ & _ & landed_in).
    destruct (IH printed _ _ landed_in check) as (orbit & f & a).
    exists (j :: orbit). split; [split; assumption|constructor; assumption].
Qed.
End Data.

Definition start_box (param : data) (b : beginning) (o : start) : box :=
  let p := start_bits o in let q := start_scale o in
  match b with
  | Struck w _ _ => landing p (enclose_range p (restitution param)) w q (start_t o) (start_rt o) (start_v o) (start_rv o)
  | Inside _ y _ => midway p (quotient p (enclose_range p y) (enclose_range p (amplitude param))) q (start_t o) (start_rt o) (start_v o) (start_rv o)
  end.

Definition check_start (param : data) (b : beginning) (o : start) : bool :=
  let p := start_bits o in let q := start_scale o in let step := unit_step p q in
  let A := enclose_range p (amplitude param) in let W := enclose_range p (frequency param) in
  let (t, v) := match b with Struck _ t v | Inside t _ v => (t, v) end in
  (0 <=? start_rt o)%Z &? (0 <=? start_rv o)%Z &?
  is_positive A &? is_positive W &? is_positive (enclose_range p (gap param)) &?
  between p step (add p (mul p W (enclose_range p t)) (enclose_range p (shift param))) (start_t o - start_rt o) (start_t o + start_rt o) &?
  between p step (quotient p (enclose_range p v) (mul p A W)) (start_v o - start_rv o) (start_v o + start_rv o).

Definition check (param : data) (b : beginning) (o : start) (legs : list leg) (printed : list bounds) : bool :=
  check_start param b o &? check_legs param (start_box param b o) legs printed.

Lemma start_sound param b o s l : describes param s -> begins b s l -> check_start param b o = true ->
  0 < A s /\ 0 < W s /\ 0 < d s /\ launched s (start_box param b o) l.
Proof.
  intros described. pose proof described as ((dA & dW & dt) & _ & dd & de). unfold check_start. set (p := start_bits o). set (q := start_scale o).
  assert (hA := holds_range p _ _ dA). assert (hW := holds_range p _ _ dW). assert (ht := holds_range p _ _ dt).
  assert (hd := holds_range p _ _ dd). assert (he := holds_range p _ _ de).
  destruct b as [w tr vr|tr yr vr]; intros begun h; cbv zeta in h; split_checks;
    assert (a := is_positive_sound _ _ k1 hA); assert (w0 := is_positive_sound _ _ k2 hW);
    assert (g := is_positive_sound _ _ k3 hd); (split; [exact a|split; [exact w0|split; [exact g|]]]);
    apply Z.leb_le in k; apply Z.leb_le in k0.
  - destruct begun as (i & <- & bt & bv & ->). assert (hbt := holds_range p _ _ bt). assert (hbv := holds_range p _ _ bv).
    exists (grid q (start_t o)), (- e s * grid q (start_v o)). cbn [rebound place since speed start_box].
    replace (plane s (wall_of i) / A s) with (side (wall_of i) * (d s / A s / 2)) by (unfold plane; field; lra).
    replace (unit_speed s (- e s * velocity i)) with (- e s * (velocity i / (A s * W s))) by (unfold unit_speed; field; lra).
    apply landing_in; try assumption.
    + apply (between_sound _ _ _ _ _ _ k4). unfold phase. enclose.
    + apply (between_sound _ _ _ _ _ _ h). enclose.
  - destruct begun as (bt & bY & bv). assert (hbt := holds_range p _ _ bt). assert (hbv := holds_range p _ _ bv). assert (hby := holds_range p _ _ bY).
    exists (grid q (start_t o)), (grid q (start_v o)). cbn [start_box]. apply midway_in; try assumption.
    + enclose.
    + apply (between_sound _ _ _ _ _ _ k4). unfold phase. enclose.
    + apply (between_sound _ _ _ _ _ _ h). unfold unit_speed. enclose.
Qed.

(* For every scene and beginning that the data allow: there is exactly one sequence of first contacts, with the printed
   walls, times and velocities. *)
Theorem orbit_checked param b o legs printed : check param b o legs printed = true ->
  forall s l, describes param s -> begins b s l -> certified s l printed.
Proof.
  unfold check. intros h s l described begun. split_checks.
  destruct (start_sound param b o s l described begun k) as (a & w & g & inb).
  destruct (legs_sound param s described a w legs printed _ l inb h) as (orbit & f & inside).
  exists orbit. split; [exact f|split; [exact inside|]]. intros other f' len.
  exact (follows_unique s g other l orbit f' f len).
Qed.
End Checker.

(* Plain: floats on Coq's binary integers; no axioms but those of the real numbers. Fast: on arrays of machine integers
   (Bignums), whose axioms say that the machine's 63-bit integers compute right. *)
Module PlainFloats := SpecificFloat StdZRadix2.
Module FastFloats := SpecificFloat BigIntRadix2.
Module Plain := Checker PlainFloats.
Module Fast := Checker FastFloats.
