(* Certificates of orbits, and their statements; the boxes and cuts of flights by which they are checked (Certificate.v). With lemmas that the
   proofs need. *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig Float.Specific_ops Float.Specific_stdz Float.Specific_bigint.
From ImpactPair Require Import Model Step.
From ImpactPair Require Export Enclosure.
Open Scope R_scope.
Import ListNotations.

(* A, W, tau of a harmonic; of all, first the reference, with d and e. *)
Record tone := { amplitude : range; frequency : range; shift : range }.
Record data := { leading :> tone; further : list tone; gap : range; restitution : range }.
Definition describes_harmonic (p : tone) (h : harmonic) : Prop :=
  among (amplitude p) (A h) /\ among (frequency p) (W h) /\ among (shift p) (tau h).
Definition describes (p : data) (s : scene) : Prop :=
  describes_harmonic p s /\ Forall2 describes_harmonic (further p) (others s) /\ among (gap p) (d s) /\ among (restitution p) (e s).

(* An orbit starts with an impact, or inside the gap. *)
Inductive beginning := Struck (w : wall) (t v : range) | Inside (t y v : range).
Definition begins (b : beginning) (s : scene) (l : launch) : Prop :=
  match b with
  | Struck w t v => exists i, wall_of i = w /\ among t (time i) /\ among v (velocity i) /\ l = rebound s i
  | Inside t y v => among t (since l) /\ among y (place l) /\ among v (speed l)
  end.

(* The printed bounds of an impact. *)
Record bounds := Impact { on : wall; time_lower : Q; time_upper : Q; velocity_lower : Q; velocity_upper : Q }.
Definition within (b : bounds) (i : impact) : Prop :=
  wall_of i = on b /\ Q2R (time_lower b) <= time i <= Q2R (time_upper b) /\
  Q2R (velocity_lower b) <= velocity i <= Q2R (velocity_upper b).

(* The statement of a theorem about an orbit. *)
Definition certified (s : scene) (l : launch) (printed : list bounds) : Prop :=
  exists orbit, follows s l orbit /\ Forall2 within printed orbit /\
    forall other, follows s l other -> length other = length orbit -> other = orbit.

(* The data of the check. A leg holds the box of its impact and where the flight that ends there is cut: departure before `depart`, middle up to
   `approach`, then arrival; `tilt` is about y'' over the velocity of arrival. *)
Record leg := Leg {
  bits : positive; coarse : positive; scale : positive; hits : wall;
  t : Z; rt : Z; v : Z; rv : Z; depart : Z; approach : Z; tilt : Z }.

(* The box of the beginning; from inside the gap its velocity is that of the launch. *)
Record start := Start { start_bits : positive; start_scale : positive; start_t : Z; start_rt : Z; start_v : Z; start_rv : Z }.

(* Cuts [a, b] in halves until `test` holds on all parts. *)
Fixpoint sweep (test : Z -> Z -> bool) (depth : nat) (a b : Z) : bool :=
  if test a b then true else
  match depth with
  | O => false
  | S k => let m := Z.div2 (a + b) in
    if ((a <? m) && (m <? b))%Z then (if sweep test k a m then sweep test k m b else false) else false
  end.

Lemma sweep_sound q test (P : R -> Prop) : (forall a b, test a b = true -> forall x, grid q a <= x <= grid q b -> P x) ->
  forall depth a b, sweep test depth a b = true -> forall x, grid q a <= x <= grid q b -> P x.
Proof.
  intros sound depth. induction depth as [|k IH]; intros a b h x r; cbn [sweep] in h.
  - destruct (test a b) eqn:c; [exact (sound a b c x r)|discriminate].
  - destruct (test a b) eqn:c; [exact (sound a b c x r)|].
    destruct (((a <? Z.div2 (a + b)) && (Z.div2 (a + b) <? b))%Z); [|discriminate].
    destruct (sweep test k a (Z.div2 (a + b))) eqn:l; [|discriminate].
    destruct (Rle_lt_dec x (grid q (Z.div2 (a + b)))); [apply (IH _ _ l)|apply (IH _ _ h)]; lra.
Qed.

Lemma mean_value f f' a b : (forall c, derivable_pt_lim f c (f' c)) ->
  exists c, Rmin a b <= c <= Rmax a b /\ f b = f a + f' c * (b - a).
Proof.
  intros D. destruct (MVT_gen f a b f') as (c & r & eq).
  - intros x _. apply is_derive_Reals, D.
  - intros x _. apply derivable_continuous_pt. exists (f' x). apply D.
  - exists c. split; [exact r|lra].
Qed.

Lemma tilted f f' g g' mu off z : derivable_pt_lim f z f' -> derivable_pt_lim g z g' ->
  derivable_pt_lim (fun x => f x - mu * (off + g x)) z (f' - mu * g').
Proof.
  intros F' G'. apply (derivable_pt_lim_minus f (fun x => mu * (off + g x))); [exact F'|].
  apply (derivable_pt_lim_scal (fun x => off + g x)). replace g' with (0 + g') by ring.
  apply (derivable_pt_lim_plus (fun _ => off)); [apply derivable_pt_lim_const|exact G'].
Qed.
