(* The claims of the document of an orbit from the scene's start (`claims`): its data make sense, and from every start that they allow there is
   exactly one motion with such events: impacts, each the first contact after what comes before; rests, after infinitely many impacts or at once;
   and releases; and its outcome holds. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal.
From ImpactPair Require Import Model Motion Certificate Document.
Open Scope R_scope.
Import ListNotations.

(* The listed events. Impacts before a rest need not be listed; these are without a number. *)
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

(* All up to a time is listed: what happens next comes later. That is no rest after infinitely many impacts, which come before it. *)
Definition up_to (s : scene) (a : standing) (motion : list happening) (T : number) : Prop :=
  defined T /\ List.Forall (fun h => moment h <= value T) motion /\ exists h, happens s (after_all s a motion) h /\ kind h <> 1%nat /\ value T < moment h.
(* How many impacts are listed before each release, counted on from n; and how many releases. *)
Fixpoint before_releases (n : Z) (listed : list occurrence) : list Z :=
  match listed with
  | [] => []
  | Impact_at _ :: listed => before_releases (n + 1) listed
  | Rest_at _ _ _ _ :: listed => before_releases n listed
  | Release_at _ _ _ :: listed => n :: before_releases n listed
  end.
Definition releases (listed : list occurrence) : nat := length (before_releases 0 listed).
(* After each release, that before the round and the later ones, as many impacts are listed up to the release a round later, where that is listed. *)
Definition as_many_each (each : Z) (round later : list occurrence) : Prop := let numbers := 0%Z :: before_releases 0 (round ++ later) in
  List.Forall (fun two => snd two = (fst two + each)%Z) (combine numbers (skipn (releases round) numbers)).
(* A part of the list, with the claimed number of impacts, begins after a release and ends with one from the same wall. It happens again and again,
   each time the same number of forcing periods later, for ever; wherever it is listed again, it is so with as many impacts. *)
Definition repeats (s : scene) (a : standing) (listed : list occurrence) (motion : list happening) (cycles each : Z) : Prop :=
  is_fastest s /\ (0 < cycles)%Z /\ exists before round later m1 m2 m3 w t, listed = before ++ round ++ later /\ motion = m1 ++ m2 ++ m3 /\
    Forall2 shows before m1 /\ Forall2 shows round m2 /\ impacts round = each /\ as_many_each each round later /\ after_all s a m1 = Flying (released s w t) /\
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
