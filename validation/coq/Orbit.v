(* What the document of an orbit from the scene's start claims (`claims`): its data make sense, and from every start that they allow there is
   exactly one motion with such events: impacts, each the first contact after what comes before; rests, after infinitely many impacts or at once;
   and releases; and its outcome holds. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal.
From ImpactPair Require Import Model Motion Certificate Document.
Open Scope R_scope.
Import ListNotations.

(* What a document lists. Impacts before a rest need not be listed; these are without a number. *)
Inductive occurrence :=
  | Impact_at (x : event)
  | Rest_at (w : wall) (lower upper : Q) (bounces : bool)
  | Release_at (w : wall) (lower upper : Q).
Definition document := document_of occurrence.
Definition in_time (lower upper : Q) (t : R) : Prop := Q2R lower <= t <= Q2R upper.
Definition shows (o : occurrence) (h : happening) : Prop :=
  match o, h with
  | Impact_at x, Hits i => within (shown x) i
  | Rest_at w lower upper bounces, Rests w' t bounces' => w' = w /\ bounces' = bounces /\ in_time lower upper t
  | Release_at w lower upper, Leaves w' t => w' = w /\ in_time lower upper t
  | _, _ => False
  end.
(* Impacts are numbered from n; a mapping is named from the wall that was touched last. *)
Fixpoint named (previous : option wall) (n : Z) (listed : list occurrence) : Prop :=
  match listed with
  | [] => True
  | Impact_at x :: listed => index x = n /\ mapped x = option_map (fun w => mapping_between w (on (shown x))) previous /\
      named (Some (on (shown x))) (n + 1) listed
  | Rest_at w _ _ _ :: listed | Release_at w _ _ :: listed => named (Some w) n listed
  end.
Definition is_impact (o : occurrence) : bool := match o with Impact_at _ => true | _ => false end.
Definition impacts (listed : list occurrence) : Z := Z.of_nat (length (filter is_impact listed)).

(* All up to a time is listed: what happens next comes later. *)
Definition up_to (s : scene) (a : standing) (motion : list happening) (T : number) : Prop :=
  defined T /\ List.Forall (fun h => moment h <= value T) motion /\ exists h, happens s (after_all s a motion) h /\ value T < moment h.
(* A part of the list, with as many impacts as are said, begins after a release and ends with one from the same wall. It happens again and again,
   each time so many forcing periods later, for ever. *)
Definition repeats (s : scene) (a : standing) (listed : list occurrence) (motion : list happening) (cycles each : Z) : Prop :=
  is_fastest s /\ (0 < cycles)%Z /\ exists before round later m1 m2 m3 w t, listed = before ++ round ++ later /\ motion = m1 ++ m2 ++ m3 /\
    Forall2 shows before m1 /\ Forall2 shows round m2 /\ impacts round = each /\ after_all s a m1 = Flying (released s w t) /\
    let period_of := IZR cycles * period s in
    forall n, let shift := INR n * period_of in
      goes s (Flying (released s w (t + shift))) (map (later_on shift) m2) /\
      after_all s (Flying (released s w (t + shift))) (map (later_on shift) m2) = Flying (released s w (t + shift + period_of)).
Definition ends_so (s : scene) (a : standing) (listed : list occurrence) (motion : list happening) (o : outcome) : Prop :=
  match o with
  | Impacts_reached n => impacts listed = n
  | Time_reached n T => impacts listed = n /\ up_to s a motion T
  | Repeats n until cycles each => impacts listed = n /\ match until with None => True | Some T => up_to s a motion T end /\
      repeats s a listed motion cycles each
  end.
Definition is_told (x : document) (s : scene) (l : launch) : Prop := named (first_wall (begun x)) 1 (events x) /\
  exists motion, goes s (Flying l) motion /\ Forall2 shows (events x) motion /\
    (forall other, goes s (Flying l) other -> map kind other = map kind motion -> other = motion) /\
    ends_so s (Flying l) (events x) motion (ended x).
Definition claims (x : document) : Prop := all_proper (scene_data x) (begun x) /\
  forall s l, describes (scene_data x) s -> begins (begun x) s l -> sensible s /\ starts (begun x) s /\ is_told x s l.

Fixpoint check_named (previous : option wall) (n : Z) (listed : list occurrence) : bool :=
  match listed with
  | [] => true
  | Impact_at x :: listed => (index x =? n)%Z && same_mapping (mapped x) (option_map (fun w => mapping_between w (on (shown x))) previous)
      && check_named (Some (on (shown x))) (n + 1) listed
  | Rest_at w _ _ _ :: listed | Release_at w _ _ :: listed => check_named (Some w) n listed
  end.
Lemma named_sound listed : forall previous n, check_named previous n listed = true -> named previous n listed.
Proof.
  induction listed as [|[x|w a b c|w a b] listed IH]; intros previous n; cbn; [trivial| |apply IH|apply IH].
  intros h. apply andb_prop in h as [h more]. apply andb_prop in h as [number name].
  split; [apply Z.eqb_eq, number|]. split; [apply same_mapping_sound, name|apply IH, more].
Qed.
Lemma same_wall_sound a b : same_wall a b = true -> a = b.
Proof. destruct a, b; cbn; congruence. Qed.

(* A number as a + b pi, a and b rational, where it is written so. *)
Fixpoint linear (n : number) : option (Q * Q) :=
  match n with
  | Rational q => Some (q, 0%Q)
  | Pi => Some (0%Q, 1%Q)
  | Plus a b => match linear a, linear b with Some (x, y), Some (z, w) => Some (x + z, y + w)%Q | _, _ => None end
  | Minus a b => match linear a, linear b with Some (x, y), Some (z, w) => Some (x - z, y - w)%Q | _, _ => None end
  | Times a b => match linear a, linear b with
    | Some (x, y), Some (z, w) =>
      if Qeq_bool y 0 then Some (x * z, x * w)%Q else if Qeq_bool w 0 then Some (x * z, y * z)%Q else None
    | _, _ => None end
  | Over a b => match linear a, linear b with
    | Some (x, y), Some (z, w) => if Qeq_bool w 0 && negb (Qeq_bool z 0) then Some (x / z, y / z)%Q else None
    | _, _ => None end
  | _ => None
  end.
Lemma linear_sound n : forall x y, linear n = Some (x, y) -> value n = Q2R x + Q2R y * PI.
Proof.
  assert (zero : forall q, Qeq_bool q 0 = true -> Q2R q = 0).
  { intros q h. apply Qeq_bool_eq in h. rewrite (Qeq_eqR _ _ h). unfold Q2R. cbn. lra. }
  assert (q0 : Q2R 0 = 0) by (unfold Q2R; cbn; lra). assert (q1 : Q2R 1 = 1) by (unfold Q2R; cbn; lra).
  induction n as [q| |a IHa b IHb|a IHa b IHb|a IHa b IHb|a IHa b IHb|a IHa|a IHa|a IHa]; cbn [linear value]; intros x y h; try discriminate.
  - injection h as <- <-. rewrite q0. ring.
  - injection h as <- <-. rewrite q0, q1. ring.
  - destruct (linear a) as [[x1 y1]|]; [|discriminate]. destruct (linear b) as [[x2 y2]|]; [|discriminate]. injection h as <- <-.
    rewrite (IHa _ _ eq_refl), (IHb _ _ eq_refl), !Q2R_plus. ring.
  - destruct (linear a) as [[x1 y1]|]; [|discriminate]. destruct (linear b) as [[x2 y2]|]; [|discriminate]. injection h as <- <-.
    rewrite (IHa _ _ eq_refl), (IHb _ _ eq_refl), !Q2R_minus. ring.
  - destruct (linear a) as [[x1 y1]|]; [|discriminate]. destruct (linear b) as [[x2 y2]|]; [|discriminate].
    rewrite (IHa _ _ eq_refl), (IHb _ _ eq_refl). destruct (Qeq_bool y1 0) eqn:z1; [|destruct (Qeq_bool y2 0) eqn:z2; [|discriminate]];
      injection h as <- <-; rewrite !Q2R_mult; [rewrite (zero _ z1)|rewrite (zero _ z2)]; ring.
  - destruct (linear a) as [[x1 y1]|]; [|discriminate]. destruct (linear b) as [[x2 y2]|]; [|discriminate].
    destruct (Qeq_bool y2 0) eqn:z2; [|discriminate]. destruct (Qeq_bool x2 0) eqn:z1; [discriminate|]. injection h as <- <-.
    assert (n0 : ~ (x2 == 0)%Q) by (intros eq; apply Qeq_bool_iff in eq; congruence).
    rewrite (IHa _ _ eq_refl), (IHb _ _ eq_refl), (zero _ z2), !Q2R_div by exact n0. field.
    intros eq. apply n0, eqR_Qeq. rewrite eq. symmetry. exact q0.
Qed.
(* A number as a rational multiple of another one, as it is written. *)
Fixpoint multiple (n : number) : Q * number :=
  match n with
  | Times a b => match a, b with
    | Rational q, _ => let (r, x) := multiple b in ((q * r)%Q, x)
    | _, Rational q => let (r, x) := multiple a in ((r * q)%Q, x)
    | _, _ => (1%Q, n) end
  | Over a b => match b with
    | Rational q => if Qeq_bool q 0 then (1%Q, n) else let (r, x) := multiple a in ((r / q)%Q, x)
    | _ => (1%Q, n) end
  | _ => (1%Q, n)
  end.
Lemma multiple_sound n : value n = Q2R (fst (multiple n)) * value (snd (multiple n)).
Proof.
  assert (q1 : Q2R 1 = 1) by (unfold Q2R; cbn; lra). assert (once : forall m, value m = Q2R (fst (1%Q, m)) * value (snd (1%Q, m))) by (intros m; cbn [fst snd]; rewrite q1; ring).
  induction n as [q| |a IHa b IHb|a IHa b IHb|a IHa b IHb|a IHa b IHb|a IHa|a IHa|a IHa]; try apply once.
  - cbn [multiple]. destruct (multiple a) as [r1 x1], (multiple b) as [r2 x2]. cbn [fst snd] in IHa, IHb.
    destruct a; try (destruct b; try apply once); cbn [fst snd value] in *; rewrite Q2R_mult; rewrite ?IHa, ?IHb; ring.
  - cbn [multiple]. destruct b; try apply once. destruct (Qeq_bool q 0) eqn:z; [apply once|]. destruct (multiple a) as [r1 x1]. cbn [fst snd value] in *.
    assert (n0 : ~ (q == 0)%Q) by (intros eq; apply Qeq_bool_iff in eq; congruence). rewrite Q2R_div by exact n0. rewrite IHa. unfold Rdiv. ring.
Qed.
(* Whole half turns. *)
Definition half_turns (n : number) : bool :=
  match linear n with Some (x, y) => Qeq_bool x 0 && (Qnum y mod Zpos (Qden y) =? 0)%Z | None => false end.
Lemma half_turns_sound n : half_turns n = true -> exists k, value n = IZR k * PI.
Proof.
  unfold half_turns. destruct (linear n) as [[x y]|] eqn:l; [|discriminate]. intros h. apply andb_prop in h as [zero whole].
  rewrite (linear_sound n x y l). exists (Qnum y / Zpos (Qden y))%Z. apply Qeq_bool_eq in zero. rewrite (Qeq_eqR _ _ zero).
  apply Z.eqb_eq in whole. assert (m := Z.div_mod (Qnum y) (Zpos (Qden y)) ltac:(lia)). rewrite whole, Z.add_0_r in m.
  assert (q0 : Q2R 0 = 0) by (unfold Q2R; cbn; lra). rewrite q0. unfold Q2R. rewrite m at 1. rewrite mult_IZR. field. apply IZR_neq. lia.
Qed.

(* The end of a list, a rest and its release: the wall, the latest time of the rest, and bounds of the release. *)
Definition last_rest (listed : list occurrence) : option (wall * Q * (Q * Q)) :=
  match rev listed with Release_at w a b :: Rest_at _ _ u _ :: _ => Some (w, u, (a, b)) | _ => None end.
Lemma last_rest_sound listed w u a b : last_rest listed = Some (w, u, (a, b)) -> exists init w' l c, listed = init ++ [Rest_at w' l u c; Release_at w a b].
Proof.
  unfold last_rest. destruct (rev listed) as [|[x|w1 l1 u1 c|w1 l1 u1] [|[y|w2 l2 u2 c2|w2 l2 u2] more]] eqn:r; try discriminate.
  intros h. injection h as -> -> -> ->. exists (rev more), w2, l2, c2.
  rewrite <- (rev_involutive listed), r. cbn [rev]. rewrite <- app_assoc. reflexivity.
Qed.
Lemma ends_rested s x listed motion w u a b : goes s x motion -> Forall2 shows listed motion -> last_rest listed = Some (w, u, (a, b)) ->
  exists t0 t, after_all s x motion = Flying (released s w t) /\ happens s (Resting w t0) (Leaves w t) /\ t0 <= Q2R u /\ in_time a b t.
Proof.
  intros g all last. destruct (last_rest_sound _ _ _ _ _ last) as (init & w' & l & c & ->). apply Forall2_app_inv_l in all as (m & tail & _ & tl & ->).
  inversion tl as [|o h os hs r1 more]; subst. inversion more as [|o' h' os' hs' r2 none]; subst. inversion none; subst.
  apply goes_app in g as [_ (_ & happened & _)]. rewrite after_all_app. cbn [after_all].
  destruct h as [i|w1 t0 c1|w1 t0]; cbn [shows] in r1; try contradiction. destruct r1 as (-> & -> & [_ late]).
  destruct h' as [i|w2 t c2|w2 t]; cbn [shows] in r2; try contradiction. destruct r2 as [-> times].
  exists t0, t. cbn [then_] in happened |- *. pose proof happened as (same_w & _). subst w'. repeat split; try exact late; apply happened || apply times.
Qed.
