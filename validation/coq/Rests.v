(* A program `verify` that verifies the document of an orbit with impacts, rests and releases, proved sound once and for all (`verified_told`). *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Float.Sig.
From ImpactPair Require Import Model Step Motion Certificate Document Turns Orbit Resting.
From ImpactPair Require Chatter.
Open Scope R_scope.
Import ListNotations.

(* Hints for the check: a box of the start, steps, with a time up to which all is listed what happens next, and of what repeats how much is listed
   before and how much each time. Nothing is claimed of it. *)
Record hint := Hint { origin : start; steps : list step; next_one : option occurrence; rounds : nat * nat }.

Module Resters (F : FloatOps with Definition sensible_format := true).
Include Restings F.
Import Each.
Import Each.Check.

(* All that is listed is before T, and the next one, which no other ones come before, after it. *)
Definition is_single (o : occurrence) : bool := match o with Rest_at _ _ _ true => false | _ => true end.
Definition latest (o : occurrence) : Q := match o with Impact_at x => time_upper (shown x) | Rest_at _ _ upper _ | Release_at _ _ upper => upper end.
Definition earliest (o : occurrence) : Q := match o with Impact_at x => time_lower (shown x) | Rest_at _ lower _ _ | Release_at _ lower _ => lower end.
Definition check_until (p : positive) (until : option number) (listed : list occurrence) (next : option occurrence) : bool :=
  match until, next with
  | None, None => true
  | Some T, Some next => is_single next && check_defined p T &&
      forallb (fun x => is_not_negative (sub p (enclose p T) (known_number p (latest x)))) listed &&
      is_positive (sub p (known_number p (earliest next)) (enclose p T))
  | _, _ => false
  end.
(* Two rests on one wall, the first seen a number of forcing periods later, have a time in common: so do their releases. *)
Definition check_repeats (p : positive) (param : data) (listed : list occurrence) (cycles each : Z) (rounds : nat * nat) : bool :=
  let before := firstn (fst rounds) listed in let rest := skipn (fst rounds) listed in let round := firstn (snd rounds) rest in
  let numbers := 0%Z :: before_releases 0 rest in
  match last_rest before, last_rest round with
  | Some (w, u, (a, _)), Some (w', u', (a', _)) =>
    let P := quotient p (mul p (whole p (2 * cycles)) (I.pi (F.PtoP p))) (enclose_range p (frequency param)) in
    check_fastest p param && (0 <? cycles)%Z && forallb (check_turns param cycles) (further param) && same_wall w w' && (impacts round =? each)%Z &&
    forallb (fun two => (snd two =? fst two + each)%Z) (combine numbers (skipn (releases round) numbers)) &&
    is_positive (sub p (add p (known_number p a) P) (known_number p u')) && is_positive (sub p (known_number p a') (add p (known_number p u) P))
  | _, _ => false
  end.
Definition check_end (p : positive) (param : data) (o : outcome) (listed : list occurrence) (h : hint) : bool :=
  match o with
  | Impacts_reached n => (impacts listed =? n)%Z && check_until p None listed (next_one h)
  | Time_reached n T => (impacts listed =? n)%Z && check_until p (Some T) listed (next_one h)
  | Repeats n until cycles each => (impacts listed =? n)%Z && check_until p until listed (next_one h) &&
      check_repeats p param listed cycles each (rounds h)
  end.

Lemma shown_times o h : shows o h -> Q2R (earliest o) <= moment h <= Q2R (latest o).
Proof.
  destruct o as [x|w a b c|w a b], h as [i|w' t c'|w' t]; cbn [shows earliest latest moment]; try tauto.
  intros (_ & r & _). exact r.
Qed.
Lemma single_shown o h : is_single o = true -> shows o h -> kind h <> 1%nat.
Proof.
  destruct o as [x|w a b [|]|w a b], h as [i|w' t [|]|w' t]; cbn [is_single shows kind]; intros single r; try discriminate; try contradiction.
  destruct r as (_ & none & _). discriminate.
Qed.

Lemma repeats_sound p param s (described : describes param s) (W_positive : 0 < W s) x listed motion cycles each rounds :
  goes s x motion -> Forall2 shows listed motion -> check_repeats p param listed cycles each rounds = true -> repeats s x listed motion cycles each.
Proof.
  intros g all check. unfold check_repeats in check. cbv zeta in check.
  set (before := firstn (fst rounds) listed) in *. set (rest := skipn (fst rounds) listed) in *. set (round := firstn (snd rounds) rest) in *.
  set (later := skipn (snd rounds) rest).
  destruct (last_rest before) as [[[w u] [a b]]|] eqn:r1; [|discriminate]. destruct (last_rest round) as [[[w' u'] [a' b']]|] eqn:r2; [|discriminate].
  apply andb_prop in check as [check second_in]. apply andb_prop in check as [check first_in]. apply andb_prop in check as [check again].
  apply andb_prop in check as [check number]. apply andb_prop in check as [check same_w]. apply andb_prop in check as [check turns_of].
  apply andb_prop in check as [fastest cycles0]. apply same_wall_sound in same_w. subst w'.
  apply Z.ltb_lt in cycles0. apply Z.eqb_eq in number. assert (turns_ := turns_sound param s described W_positive cycles turns_of).
  assert (each_time : as_many_each each round later).
  { unfold as_many_each. cbv zeta. replace (round ++ later) with rest by (unfold round, later; rewrite firstn_skipn; reflexivity).
    apply Forall_forall. rewrite forallb_forall in again. intros two in_list. apply Z.eqb_eq, again, in_list. }
  assert (split_list : listed = before ++ round ++ later) by (unfold before, round, later, rest; rewrite !firstn_skipn; reflexivity).
  rewrite split_list in all. apply Forall2_app_inv_l in all as (m1 & m' & all1 & all' & eq). apply Forall2_app_inv_l in all' as (m2 & m3 & all2 & all3 & eq').
  rewrite eq, eq' in g. apply goes_app in g as [g1 g]. apply goes_app in g as [g2 _].
  destruct (ends_rested _ _ _ _ _ _ _ _ g1 all1 r1) as (t0 & t & at1 & rest1 & b0 & b1 & b2). rewrite at1 in g2.
  destruct (ends_rested _ _ _ _ _ _ _ _ g2 all2 r2) as (t0' & t' & at2 & rest2 & b0' & b3 & b4).
  set (P := IZR cycles * period s) in *.
  assert (hP : holds (quotient p (mul p (whole p (2 * cycles)) (I.pi (F.PtoP p))) (enclose_range p (frequency param))) P).
  { replace P with (IZR (2 * cycles) * PI / W s) by (unfold P, period; rewrite mult_IZR; field; lra).
    apply holds_quotient; [apply holds_mul; [apply holds_whole|apply I.pi_correct]|apply holds_range, described]. }
  assert (0 < Q2R a + P - Q2R u') by (apply (is_positive_sound _ _ first_in); apply holds_sub; [apply holds_add; [apply holds_number|exact hP]|apply holds_number]).
  assert (0 < Q2R a' - (Q2R u + P)) by (apply (is_positive_sound _ _ second_in); apply holds_sub; [apply holds_number|apply holds_add; [apply holds_number|exact hP]]).
  assert (eq_time : t' = t + P) by (apply (release_later s P turns_ w t0 t t0' t' rest1 rest2); lra).
  split; [exact (fastest_sound p param s described fastest)|]. split; [exact cycles0|]. exists before, round, later, m1, m2, m3, w, t. split; [exact split_list|]. split; [rewrite eq, eq'; reflexivity|].
  split; [exact all1|]. split; [exact all2|]. split; [exact number|]. split; [exact each_time|]. split; [exact at1|]. cbv zeta. intros n. fold P. set (shift := INR n * P).
  assert (all_turns : recurs s shift).
  { intros h i. destruct (turns_ h i) as [m whole_]. exists (Z.of_nat n * m)%Z. unfold shift. rewrite INR_IZR_INZ, mult_IZR.
    replace (W h * (IZR (Z.of_nat n) * P)) with (IZR (Z.of_nat n) * (W h * P)) by ring. rewrite whole_. ring. }
  split; [exact (goes_later s shift all_turns m2 _ g2)|].
  change (Flying (released s w (t + shift))) with (standing_later shift (Flying (released s w t))). rewrite after_later, at2, eq_time.
  cbn [standing_later]. unfold launch_later, released. cbn [since place speed]. f_equal. f_equal. ring.
Qed.

Definition verify (x : document) (h : hint) : bool :=
  let p := start_bits (origin h) in let param := scene_data x in
  check_data p param && check_beginning p param (begun x) && check_named (first_wall (begun x)) 1 (events x) &&
  check_end p param (ended x) (events x) h && check_start param (begun x) (origin h) &&
  check_steps param (In_flight (start_box param (begun x) (origin h)) None) (steps h)
    (events x ++ match next_one h with Some next => [next] | None => [] end).

Lemma verified_told x h : verify x h = true -> forall s l, describes (scene_data x) s -> begins (begun x) s l -> is_told x s l.
Proof.
  unfold verify. intros v s l described begin. apply andb_prop in v as [v checked]. apply andb_prop in v as [v started].
  apply andb_prop in v as [v ending]. apply andb_prop in v as [_ names]. set (p := start_bits (origin h)) in *.
  destruct (start_sound _ _ _ s l described begin started) as (a & w & g & inb).
  destruct (steps_sound (scene_data x) s described a w g (steps h) (In_flight _ None) _ (Flying l) (conj inb I) checked) as (whole & f & all).
  apply Forall2_app_inv_l in all as (motion & rest & all & tail & ->). apply goes_app in f as [f f'].
  split; [apply named_sound, names|]. exists motion. split; [exact f|]. split; [exact all|].
  split; [intros other fo same_kinds; exact (goes_unique s g other _ motion fo f same_kinds)|].
  assert (until_told : forall until, check_until p until (events x) (next_one h) = true ->
    match until with None => True | Some T => up_to s (Flying l) motion T end).
  { intros [T|] check; [|exact I]. unfold check_until in check. destruct (next_one h) as [next|]; [|discriminate].
    apply andb_prop in check as [check later]. apply andb_prop in check as [check each]. apply andb_prop in check as [single def].
    split; [apply (check_defined_sound p), def|]. split.
    - rewrite forallb_forall in each. clear - each all. induction all as [|o k os ks r all IH]; [constructor|].
      constructor; [|apply IH; intros y i; apply each; right; exact i].
      assert (0 <= value T - Q2R (latest o)).
      { refine (is_not_negative_sound _ _ (each o (or_introl eq_refl)) _). apply holds_sub; [apply holds_enclose|apply holds_number]. }
      assert (b := shown_times o k r). lra.
    - inversion tail as [|o k os ks r none]; subst. destruct f' as [happened _]. exists k. split; [exact happened|]. split; [exact (single_shown next k single r)|].
      assert (0 < Q2R (earliest next) - value T).
      { refine (is_positive_sound _ _ later _). apply holds_sub; [apply holds_number|apply holds_enclose]. }
      assert (b := shown_times next k r). lra. }
  unfold check_end in ending. destruct (ended x) as [n|n T|n until cycles each]; cbn [ends_so].
  - apply andb_prop in ending as [number _]. apply Z.eqb_eq, number.
  - apply andb_prop in ending as [number until]. split; [apply Z.eqb_eq, number|exact (until_told (Some T) until)].
  - apply andb_prop in ending as [ending again]. apply andb_prop in ending as [number till].
    split; [apply Z.eqb_eq, number|]. split; [exact (until_told until till)|].
    exact (repeats_sound p (scene_data x) s described w (Flying l) (events x) motion cycles each (rounds h) f all again).
Qed.
End Resters.
