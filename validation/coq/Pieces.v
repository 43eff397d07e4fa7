(* Documents with intervals among the data, piece by piece: an interval is cut in two, and the document is verified for either
   part. A claim that holds for all parts holds for all data (`pieces_verified`). *)
From Coq Require Import Reals Lra List ZArith QArith Qreals Bool.
From Interval Require Import Real.Xreal Float.Sig.
From ImpactPair Require Import Model Certificate Document Orbit Rests.
Open Scope R_scope.
Import ListNotations.

(* The datum that is cut: of a harmonic, from 0, the reference; of the pair; of the start. *)
Inductive datum := Amplitude (n : nat) | Frequency (n : nat) | Phase (n : nat) | Gap | Restitution | Start_time | Start_place | Start_velocity.
Inductive pieces := Whole (h : hint) | Cut (which : datum) (at_ : Q) (lower upper : pieces).

Definition below (q : Q) (r : range) : range := Between (least r) (Rational q).
Definition above (q : Q) (r : range) : range := Between (Rational q) (most r).
Lemma either q r x : among r x -> among (below q r) x \/ among (above q r) x.
Proof. unfold among, below, above. cbn. intros [l m]. destruct (Rle_lt_dec x (Q2R q)); [left|right]; lra. Qed.

Definition tone_at (d : datum) (f : range -> range) (x : tone) : tone :=
  match d with
  | Amplitude _ => {| amplitude := f (amplitude x); frequency := frequency x; shift := shift x |}
  | Frequency _ => {| amplitude := amplitude x; frequency := f (frequency x); shift := shift x |}
  | Phase _ => {| amplitude := amplitude x; frequency := frequency x; shift := f (shift x) |}
  | _ => x
  end.
Fixpoint update {X : Type} (n : nat) (f : X -> X) (l : list X) : list X :=
  match l, n with [], _ => [] | x :: l, O => f x :: l | x :: l, S n => x :: update n f l end.
Definition harmonic_at (n : nat) (d : datum) (f : range -> range) (p : data) : data :=
  match n with
  | O => {| leading := tone_at d f (leading p); further := further p; gap := gap p; restitution := restitution p |}
  | S n => {| leading := leading p; further := update n (tone_at d f) (further p); gap := gap p; restitution := restitution p |}
  end.
Definition data_at (d : datum) (f : range -> range) (p : data) : data :=
  match d with
  | Amplitude n | Frequency n | Phase n => harmonic_at n d f p
  | Gap => {| leading := leading p; further := further p; gap := f (gap p); restitution := restitution p |}
  | Restitution => {| leading := leading p; further := further p; gap := gap p; restitution := f (restitution p) |}
  | _ => p
  end.
Definition beginning_at (d : datum) (f : range -> range) (b : beginning) : beginning :=
  match d, b with
  | Start_time, Struck w t v => Struck w (f t) v
  | Start_time, Inside t y v => Inside (f t) y v
  | Start_place, Inside t y v => Inside t (f y) v
  | Start_velocity, Struck w t v => Struck w t (f v)
  | Start_velocity, Inside t y v => Inside t y (f v)
  | _, _ => b
  end.
Definition part (d : datum) (f : range -> range) (x : document) : document :=
  {| scene_data := data_at d f (scene_data x); begun := beginning_at d f (begun x); events := events x; ended := ended x |}.

Lemma tone_either d q x h : describes_harmonic x h -> describes_harmonic (tone_at d (below q) x) h \/ describes_harmonic (tone_at d (above q) x) h.
Proof.
  intros (a & w & t). unfold describes_harmonic. destruct d; cbn; try tauto;
    [destruct (either q _ _ a)|destruct (either q _ _ w)|destruct (either q _ _ t)]; tauto.
Qed.
Lemma update_either {X Y : Type} (P : X -> Y -> Prop) f g : (forall x y, P x y -> P (f x) y \/ P (g x) y) ->
  forall xs ys, Forall2 P xs ys -> forall n, Forall2 P (update n f xs) ys \/ Forall2 P (update n g xs) ys.
Proof.
  intros each xs ys all. induction all as [|x y xs ys h all IH]; intros n; [left; destruct n; constructor|].
  destruct n as [|n]; cbn; [destruct (each x y h); [left|right]; constructor; assumption|].
  destruct (IH n); [left|right]; constructor; assumption.
Qed.
Lemma harmonic_either n d q p s : describes p s -> describes (harmonic_at n d (below q) p) s \/ describes (harmonic_at n d (above q) p) s.
Proof.
  intros (l & f & g). unfold describes. destruct n as [|n]; cbn.
  - destruct (tone_either d q _ _ l); tauto.
  - destruct (update_either _ _ _ (tone_either d q) _ _ f n); tauto.
Qed.
Lemma data_either d q p s : describes p s -> describes (data_at d (below q) p) s \/ describes (data_at d (above q) p) s.
Proof.
  intros h. destruct d; cbn [data_at]; try (apply harmonic_either, h); try (left; exact h);
    destruct h as (l & f & g & e); unfold describes; cbn; [destruct (either q _ _ g)|destruct (either q _ _ e)]; tauto.
Qed.
Lemma beginning_either d q b s l : begins b s l -> begins (beginning_at d (below q) b) s l \/ begins (beginning_at d (above q) b) s l.
Proof.
  destruct b as [w t v|t y v]; cbn.
  - intros (i & hw & ht & hv & hl). destruct d; cbn; try (left; exists i; tauto);
      [destruct (either q _ _ ht)|destruct (either q _ _ hv)]; [left|right|left|right]; exists i; tauto.
  - intros (ht & hy & hv). destruct d; cbn; try tauto;
      [destruct (either q _ _ ht)|destruct (either q _ _ hy)|destruct (either q _ _ hv)]; tauto.
Qed.
(* Only one of scene and start is cut. *)
Lemma part_either d q x s l : describes (scene_data x) s -> begins (begun x) s l ->
  exists f, (f = below q \/ f = above q) /\ describes (scene_data (part d f x)) s /\ begins (begun (part d f x)) s l.
Proof.
  intros h b. destruct (data_either d q _ _ h) as [h'|h'], (beginning_either d q _ _ _ b) as [b'|b'];
    try (exists (below q); tauto); try (exists (above q); tauto);
    destruct d; cbn in *; try (exists (below q); cbn; tauto); try (exists (above q); cbn; tauto).
Qed.

Lemma same_first d f b : first_wall (beginning_at d f b) = first_wall b.
Proof. destruct d, b; reflexivity. Qed.

Module PieceVerifier (F : FloatOps with Definition sensible_format := true).
Module Import Each := Resters F.
Import Each.Each.

Fixpoint verify_each (x : document) (p : pieces) : bool :=
  match p with
  | Whole h => verify x h
  | Cut d q lower upper => verify_each (part d (below q) x) lower && verify_each (part d (above q) x) upper
  end.
Definition verify_document (x : document) (p : pieces) : bool :=
  check_data few (scene_data x) && check_beginning few (scene_data x) (begun x) && verify_each x p.

Lemma each_sound p : forall x, verify_each x p = true -> forall s l, describes (scene_data x) s -> begins (begun x) s l -> is_told x s l.
Proof.
  induction p as [h|d q lower IHl upper IHu]; intros x v s l described begin; cbn [verify_each] in v.
  - exact (verified_told x h v s l described begin).
  - apply andb_prop in v as [a b]. destruct (part_either d q x s l described begin) as (f & which & described' & begin').
    assert (told : is_told (part d f x) s l) by (destruct which as [-> | ->]; [apply (IHl _ a)|apply (IHu _ b)]; assumption).
    unfold is_told, part in told |- *. cbn [events ended begun] in told. rewrite same_first in told. exact told.
Qed.

Theorem pieces_verified x p : verify_document x p = true -> claims x.
Proof.
  unfold verify_document. intros v. apply andb_prop in v as [v each]. apply andb_prop in v as [a b].
  destruct (data_sound few _ _ a b) as [pr sense]. split; [exact pr|]. intros s l described begin.
  destruct (sense s described) as [good st]. split; [exact good|]. split; [exact st|].
  exact (each_sound p x each s l described begin).
Qed.
End PieceVerifier.
