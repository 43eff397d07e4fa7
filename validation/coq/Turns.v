(* Numbers as they are written, a + b pi or multiples of one number; and the whole periods of harmonics, which follow from that. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From ImpactPair Require Import Model Certificate Document.
Open Scope R_scope.
Import ListNotations.

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
(* Whole half periods. *)
Definition half_turns (n : number) : bool :=
  match linear n with Some (x, y) => Qeq_bool x 0 && (Qnum y mod Zpos (Qden y) =? 0)%Z | None => false end.
Lemma half_turns_sound n : half_turns n = true -> exists k, value n = IZR k * PI.
Proof.
  unfold half_turns. destruct (linear n) as [[x y]|] eqn:l; [|discriminate]. intros h. apply andb_prop in h as [zero whole].
  rewrite (linear_sound n x y l). exists (Qnum y / Zpos (Qden y))%Z. apply Qeq_bool_eq in zero. rewrite (Qeq_eqR _ _ zero).
  apply Z.eqb_eq in whole. assert (m := Z.div_mod (Qnum y) (Zpos (Qden y)) ltac:(lia)). rewrite whole, Z.add_0_r in m.
  assert (q0 : Q2R 0 = 0) by (unfold Q2R; cbn; lra). rewrite q0. unfold Q2R. rewrite m at 1. rewrite mult_IZR. field. apply IZR_neq. lia.
Qed.

(* A harmonic completes a whole number of periods in a number of periods of the reference: both frequencies are a + b pi, or
   multiples of one number. *)
Definition turns_of (cycles : Z) (a b : Q) : Z := let q := (a * inject_Z cycles / b)%Q in (Qnum q / Zpos (Qden q))%Z.
Definition are_turns (cycles m : Z) (a b : Q) : bool := Qeq_bool (a * inject_Z cycles) (inject_Z m * b).
Definition whole_turns (cycles : Z) (w0 w1 : number) : option Z :=
  let (q0, u0) := multiple w0 in let (q1, u1) := multiple w1 in let m := turns_of cycles q1 q0 in
  if same u0 u1 && are_turns cycles m q1 q0 then Some m
  else match linear w0, linear w1 with
    | Some (x0, y0), Some (x1, y1) =>
      let m := if Qeq_bool y0 0 then turns_of cycles x1 x0 else turns_of cycles y1 y0 in
      if are_turns cycles m x1 x0 && are_turns cycles m y1 y0 then Some m else None
    | _, _ => None
    end.
Definition check_turns (param : data) (cycles : Z) (x : tone) : bool :=
  same (least (frequency param)) (most (frequency param)) && same (least (frequency x)) (most (frequency x)) &&
  match whole_turns cycles (least (frequency param)) (least (frequency x)) with Some _ => true | None => false end.
Lemma whole_turns_sound cycles w0 w1 m : whole_turns cycles w0 w1 = Some m -> value w1 * IZR cycles = IZR m * value w0.
Proof.
  assert (equal : forall m a b, are_turns cycles m a b = true -> Q2R a * IZR cycles = IZR m * Q2R b).
  { intros k a b h. apply Qeq_bool_eq, Qeq_eqR in h. rewrite !Q2R_mult in h.
    assert (inject : forall z, Q2R (inject_Z z) = IZR z) by (intros z; unfold Q2R; cbn; field). rewrite !inject in h. exact h. }
  unfold whole_turns. assert (k0 := multiple_sound w0). assert (k1 := multiple_sound w1).
  destruct (multiple w0) as [q0 u0], (multiple w1) as [q1 u1]. cbn [fst snd] in k0, k1. cbv zeta.
  destruct (same u0 u1 && are_turns cycles (turns_of cycles q1 q0) q1 q0) eqn:one.
  - intros h. injection h as <-. apply andb_prop in one as [unit_of h]. apply same_sound in unit_of. subst u1. apply equal in h. rewrite k0, k1.
    replace (Q2R q1 * value u0 * IZR cycles) with (Q2R q1 * IZR cycles * value u0) by ring. rewrite h. ring.
  - destruct (linear w0) as [[x0 y0]|] eqn:l0; [|discriminate]. destruct (linear w1) as [[x1 y1]|] eqn:l1; [|discriminate].
    destruct (are_turns _ _ x1 x0 && are_turns _ _ y1 y0) eqn:both; [|discriminate]. intros h. injection h as <-. apply andb_prop in both as [e1 e2].
    apply equal in e1, e2. rewrite (linear_sound _ _ _ l0), (linear_sound _ _ _ l1).
    replace ((Q2R x1 + Q2R y1 * PI) * IZR cycles) with (Q2R x1 * IZR cycles + Q2R y1 * IZR cycles * PI) by ring. rewrite e1, e2. ring.
Qed.
Lemma turns_sound param s (described : describes param s) (W_positive : 0 < W s) cycles : forallb (check_turns param cycles) (further param) = true ->
  recurs s (IZR cycles * period s).
Proof.
  intros check h [<-|i].
  { exists cycles. unfold period. field. lra. }
  rewrite forallb_forall in check. destruct described as ((_ & lead & _) & rest & _).
  assert (each : forall x, In x (further param) -> forall h, describes_harmonic x h -> exists n, W h * (IZR cycles * period s) = IZR n * (2 * PI)).
  { intros x j k (_ & w & _). specialize (check x j). unfold check_turns in check. apply andb_prop in check as [check turns_]. apply andb_prop in check as [one one'].
    apply same_sound in one, one'. unfold among in lead, w. rewrite <- one in lead. rewrite <- one' in w.
    destruct (whole_turns cycles _ _) as [m|] eqn:found in turns_; [|discriminate]. apply whole_turns_sound in found. exists m.
    assert (same_turns : W k * IZR cycles = IZR m * W s).
    { replace (W k) with (value (least (frequency x))) by lra. replace (W s) with (value (least (frequency param))) by lra. exact found. }
    unfold period. replace (W k * (IZR cycles * (2 * PI / W s))) with (W k * IZR cycles * (2 * PI / W s)) by ring. rewrite same_turns. field. lra. }
  clear - rest each i. induction rest as [|x k xs ks r rest IH]; [destruct i|]. destruct i as [<-|i]; [exact (each x (or_introl eq_refl) k r)|].
  apply IH; [exact i|intros y j; apply each; right; exact j].
Qed.
