(* Floats for the extracted checker: those of Interval on Coq's binary integers (StdZRadix2), but with shifts and lengths by
   Z.shiftl, Z.shiftr and Z.log2, which the extraction maps to those of Zarith. *)
From Coq Require Import ZArith Lia.
From Flocq Require Import Core.Zaux Core.Digits.
From Interval Require Import Float.Basic Float.Generic Float.Generic_proof Float.Specific_sig Float.Specific_stdz Float.Specific_ops.
From Coq Require Import Bool.
From ImpactPair Require Data Document Pieces Shadow Orbit Cycle Cycles Drawn Region Columns March Trap Chaos Reduced Strips Words Motions Entropies Blocks Sets.
Open Scope Z_scope.

Module Import Std := StdZRadix2.

Definition power (x : positive) : positive := Z.to_pos (Z.shiftl 1 (Zpos x)).

Lemma power_is x : Zpos (power x) = 2 ^ Zpos x.
Proof. unfold power. rewrite Z.shiftl_1_l. apply Z2Pos.id. apply Z.pow_pos_nonneg; lia. Qed.
Lemma shift_is m x : Zpos (shift radix2 m x) = Zpos m * 2 ^ Zpos x.
Proof. rewrite shift_correct. reflexivity. Qed.
Lemma shift_power x : shift radix2 1 x = power x.
Proof. apply Pos2Z.inj. rewrite shift_is, power_is. lia. Qed.

Module ShiftRadix2 <: FloatCarrier.
Definition radix := Std.radix.
Definition smantissa_type := Std.smantissa_type.
Definition mantissa_type := Std.mantissa_type.
Definition exponent_type := Std.exponent_type.
Definition MtoP := Std.MtoP.
Definition PtoM := Std.PtoM.
Definition MtoZ := Std.MtoZ.
Definition ZtoM := Std.ZtoM.
Definition EtoZ := Std.EtoZ.
Definition ZtoE := Std.ZtoE.
Definition valid_mantissa := Std.valid_mantissa.
Definition exponent_zero := Std.exponent_zero.
Definition exponent_one := Std.exponent_one.
Definition mantissa_zero := Std.mantissa_zero.
Definition mantissa_one := Std.mantissa_one.
Definition mantissa_pos := Std.mantissa_pos.
Definition mantissa_neg := Std.mantissa_neg.
Definition exponent_neg := Std.exponent_neg.
Definition exponent_add := Std.exponent_add.
Definition exponent_sub := Std.exponent_sub.
Definition exponent_cmp := Std.exponent_cmp.
Definition exponent_div2_floor (e : Z) : Z * bool := (Z.div2 e, Z.odd e).
Definition mantissa_sign := Std.mantissa_sign.
Definition mantissa_add := Std.mantissa_add.
Definition mantissa_sub := Std.mantissa_sub.
Definition mantissa_mul := Std.mantissa_mul.
Definition mantissa_cmp (x y : positive) : comparison := Z.compare (Zpos x) (Zpos y).
Definition mantissa_digits (m : positive) : Z := Z.log2 (Zpos m) + 1.
Definition mantissa_even (m : positive) : bool := Z.even (Zpos m).
Definition mantissa_scale2 := Std.mantissa_scale2.
Definition mantissa_shl (m : positive) (d : Z) : positive := Z.to_pos (Z.shiftl (Zpos m) d).
Definition mantissa_shr (m : positive) (d : Z) (pos : position) : positive * position :=
  let q := Z.shiftr (Zpos m) d in
  (Z.to_pos q, adjust_pos (Zpos m - Z.shiftl q d) (power (Z.to_pos d)) pos).
Definition mantissa_shrp (m : positive) (d : Z) (pos : position) : position :=
  adjust_pos (Zpos m) (power (Z.to_pos d)) pos.
Definition mantissa_div (m d : positive) : positive * position :=
  let (q, r) := Z.div_eucl (Zpos m) (Zpos d) in (Z.to_pos q, adjust_pos r d pos_Eq).
Definition mantissa_sqrt := Std.mantissa_sqrt.

Definition PtoM_correct := Std.PtoM_correct.
Definition ZtoM_correct := Std.ZtoM_correct.
Definition ZtoE_correct := Std.ZtoE_correct.
Definition exponent_zero_correct := Std.exponent_zero_correct.
Definition exponent_one_correct := Std.exponent_one_correct.
Definition exponent_neg_correct := Std.exponent_neg_correct.
Definition exponent_add_correct := Std.exponent_add_correct.
Definition exponent_sub_correct := Std.exponent_sub_correct.
Definition exponent_cmp_correct := Std.exponent_cmp_correct.
Lemma exponent_div2_floor_correct e : let (e', b) := exponent_div2_floor e in EtoZ e = 2 * EtoZ e' + (if b then 1 else 0).
Proof. exact (Z.div2_odd e). Qed.
Definition mantissa_zero_correct := Std.mantissa_zero_correct.
Definition mantissa_pos_correct := Std.mantissa_pos_correct.
Definition mantissa_neg_correct := Std.mantissa_neg_correct.
Definition mantissa_sign_correct := Std.mantissa_sign_correct.
Definition mantissa_even_correct (x : positive) (_ : True) := eq_refl (Z.even (Zpos x)).
Definition mantissa_one_correct := Std.mantissa_one_correct.
Definition mantissa_add_correct := Std.mantissa_add_correct.
Definition mantissa_sub_correct := Std.mantissa_sub_correct.
Definition mantissa_mul_correct := Std.mantissa_mul_correct.
Definition mantissa_cmp_correct (x y : positive) (_ _ : True) := eq_refl (Zpos x ?= Zpos y).
Lemma mantissa_digits_correct x : valid_mantissa x -> EtoZ (mantissa_digits x) = Zpos (count_digits radix (MtoP x)).
Proof.
  intros _. rewrite <- digits_conversion. unfold EtoZ, mantissa_digits, MtoP.
  assert (low := Z.log2_spec (Zpos x) ltac:(lia)).
  symmetry. apply Zdigits_unique. change (radix_val radix) with 2. rewrite Z.abs_eq by lia.
  unfold Std.EtoZ, Std.MtoP. replace (Z.log2 (Zpos x) + 1 - 1) with (Z.log2 (Zpos x)) by ring. exact low.
Qed.
Definition mantissa_scale2_correct := Std.mantissa_scale2_correct.
Lemma mantissa_shl_correct x y z : valid_mantissa y -> EtoZ z = Zpos x ->
  MtoP (mantissa_shl y z) = shift radix (MtoP y) x /\ valid_mantissa (mantissa_shl y z).
Proof.
  unfold EtoZ, Std.EtoZ. intros _ ->. split; [|exact I]. apply Pos2Z.inj. change radix with radix2. rewrite shift_is.
  unfold MtoP, Std.MtoP, mantissa_shl. rewrite Z.shiftl_mul_pow2 by lia.
  apply Z2Pos.id. apply Z.mul_pos_pos; [lia|apply Z.pow_pos_nonneg; lia].
Qed.
Lemma mantissa_shr_correct x y z k : valid_mantissa y -> EtoZ z = Zpos x -> Zpos (shift radix 1 x) <= Zpos (MtoP y) ->
  let (sq, l) := mantissa_shr y z k in
  let (q, r) := Z.div_eucl (Zpos (MtoP y)) (Zpos (shift radix 1 x)) in
  Zpos (MtoP sq) = q /\ l = adjust_pos r (shift radix 1 x) k /\ valid_mantissa sq.
Proof.
  unfold EtoZ, Std.EtoZ, MtoP, Std.MtoP. change radix with radix2. rewrite shift_power. intros _ -> h. unfold mantissa_shr. cbn [Z.to_pos].
  assert (dm := Z.div_mod (Zpos y) (Zpos (power x)) ltac:(lia)).
  assert (low := Z.div_str_pos (Zpos y) (Zpos (power x)) ltac:(lia)).
  unfold Z.div, Z.modulo in dm, low. destruct (Z.div_eucl (Zpos y) (Zpos (power x))) as [q r] eqn:e.
  assert (is_q : Z.shiftr (Zpos y) (Zpos x) = q).
  { rewrite Z.shiftr_div_pow2, <- power_is by lia. unfold Z.div. rewrite e. reflexivity. }
  rewrite is_q. rewrite Z.shiftl_mul_pow2, <- power_is by lia. split; [apply Z2Pos.id; exact low|]. split; [|exact I].
  f_equal. lia.
Qed.
Lemma mantissa_shrp_correct x y z k : valid_mantissa y -> EtoZ z = Zpos x ->
  radix ^ (Zpos x - 1) <= Zpos (MtoP y) < Zpos (shift radix 1 x) ->
  let l := mantissa_shrp y z k in l = adjust_pos (Zpos (MtoP y)) (shift radix 1 x) k.
Proof. unfold EtoZ, Std.EtoZ. intros _ -> _. unfold mantissa_shrp. change radix with radix2. rewrite shift_power. reflexivity. Qed.
Lemma mantissa_div_correct x y : valid_mantissa x -> valid_mantissa y -> Zpos (MtoP y) <= Zpos (MtoP x) ->
  let (q, l) := mantissa_div x y in
  Zpos (MtoP q) = Zpos (MtoP x) / Zpos (MtoP y) /\
  Bracket.inbetween_int (Zpos (MtoP q)) (Rdefinitions.Rdiv (Rdefinitions.IZR (Zpos (MtoP x))) (Rdefinitions.IZR (Zpos (MtoP y))))
    (convert_location_inv l) /\ valid_mantissa q.
Proof.
  intros vx vy h. assert (s := Std.mantissa_div_correct x y vx vy h).
  unfold Std.mantissa_div, Std.mantissa_split_div in s. rewrite Zfast_div_eucl_correct in s. unfold mantissa_div.
  assert (low := Z.div_str_pos (Zpos x) (Zpos y) ltac:(unfold MtoP, Std.MtoP in h; lia)). unfold Z.div in low.
  destruct (Z.div_eucl (Zpos x) (Zpos y)) as [q r]. destruct q as [|q|q]; [lia| |lia]. exact s.
Qed.
Definition mantissa_sqrt_correct := Std.mantissa_sqrt_correct.
End ShiftRadix2.

Module ShiftFloats := SpecificFloat ShiftRadix2.
Module Shifting := Pieces.PieceVerifier ShiftFloats.
Module Shadowing := Shadow.Shadows ShiftFloats.
Module Drawing := Drawn.Drawings ShiftFloats.
Module Trapping := Trap.Traps ShiftFloats.
Module Striding := Words.Documents ShiftFloats.
Module Setting := Sets.Sets ShiftFloats.
Module Growing := Entropies.Growths ShiftFloats.

(* A document of a motion that a stable periodic orbit attracts. *)
Definition verify_attracted (x : Orbit.document) (found : Pieces.pieces) (from : Z) (c : Cycle.cycle) (h : Cycles.surroundings) (a : Drawn.approach_to) : bool :=
  Shifting.verify_document x found && Drawing.verify_drawn x from c h a.
Theorem attracted_verified x found from c h a : verify_attracted x found from c h a = true -> Cycle.claims_attracted x from c.
Proof. intros v. apply andb_prop in v as [listed drawn]. exact (Drawing.drawn_verified x from c h a (Shifting.pieces_verified x found listed) drawn). Qed.

(* A document of a trapping region; `found` are the pieces of the impacts up to the one with which the scene's motion comes in. *)
Definition verify_region (param : Data.data) (b : Data.beginning) (r : Region.region) (f : Region.properties) (h : Columns.plan) (x : Trap.entry) (found : Pieces.pieces) : bool :=
  match Region.entered f with
  | Some n => (n =? 0) || Shifting.verify_document (Trap.first_impacts param b x n) found
  | None => true
  end && Trapping.verify_trap param b r f h x.
Theorem region_verified param b r f h x found : verify_region param b r f h x found = true -> Region.claims_region param b r f.
Proof.
  unfold verify_region. intros v. apply andb_prop in v as [listed trap]. apply (Trapping.trap_verified _ _ _ _ _ _ trap). intros n is_n some. rewrite is_n in listed.
  apply orb_prop in listed as [zero|listed]; [apply Z.eqb_eq in zero; contradiction|]. exact (Shifting.pieces_verified _ found listed).
Qed.

(* A document of words: parallelograms inside its h-sets, with the strips of its words; and how fast their number grows, by impacts and by half cycles. *)
Record chaos_hint := Chaos_hint { found_words : Words.words_document; by_impacts : Entropies.growth_hint; by_half_cycles : Entropies.growth_hint }.
Definition verify_chaos (param : Data.data) (b : Data.beginning) (c : Chaos.chaos) (h : chaos_hint) : bool :=
  let x := found_words h in let p := Words.word_bits x in
  Shadowing.Each.check_data p param && Shadowing.Each.check_beginning p param b && Motions.agrees c x && Blocks.check_blocks c &&
  Setting.check_h_sets p (Words.grid_bits x) (Chaos.h_sets c) (Words.sets x) && Growing.check_entropies p c (by_impacts h) (by_half_cycles h) && Striding.check_words param x.
Theorem chaos_verified param b c h : verify_chaos param b c h = true -> Chaos.claims_chaos param b c.
Proof.
  unfold verify_chaos. intros v. apply andb_prop in v as [v checked]. apply andb_prop in v as [v grow]. apply andb_prop in v as [v sets]. apply andb_prop in v as [v order].
  apply andb_prop in v as [v agree]. apply andb_prop in v as [proper begun]. destruct (Shadowing.Each.data_sound _ _ _ proper begun) as [pr sense].
  destruct (Setting.h_sets_checked _ _ _ _ sets) as (disjoint & listed & _ & inside). split; [exact pr|].
  split; [exact disjoint|]. split; [exact listed|]. split; [exact (Blocks.blocks_sound c order)|]. intros s described.
  assert (hold := Striding.words_verified param _ checked s described). split; [apply (sense s described)|]. split; [exact (Words.words_one _ _ hold)|].
  destruct (Motions.motions_sound s c _ agree inside hold) as (every & two_sided & periodic). split; [exact every|]. split; [exact two_sided|]. split; [exact periodic|].
  exact (Growing.entropies_sound _ _ _ _ grow s _ agree inside hold).
Qed.
