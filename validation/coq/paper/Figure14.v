(* The title of the paper, "Chaotic motion of a horizontal impact pair", as a theorem about its figure 14.

   Each cycle of the motion is P1 P2 or P1 P2 P4, in any order: 20 parallelograms, of which 28 stretches are carried across one
   another. The program ../horseshoe finds them. *)
From Coq Require Import Reals Lra Lia List ZArith QArith Qreals Bool.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Model Step Horseshoe Return Certificate Covering.
Import ListNotations.
Open Scope R_scope.

Local Open Scope Z_scope.
(* Written by ../horseshoe. *)
Definition at_aaa_0 := Chart 88802072333913 (-22792341190677) 20797243791 (-9178913402) 91645314452 127082893481.
Definition at_aaa_1 := Chart 144034892386663 22945073387062 42204708642 18573007501 (-11683003331) 16158331951.
Definition at_aab_0 := Chart 88662521597043 (-22729264918818) 30101868753 (-13326421105) 92055443378 128484730612.
Definition at_aab_1 := Chart 144359840924164 23087648132655 62230145810 27157085975 (-12022284323) 16344560982.
Definition at_aba_0 := Chart 87904816045909 (-22385229764892) 55347987555 (-24856821318) 93453133488 134700635623.
Definition at_aba_1 := Chart 146166666605249 23854376015694 119431074066 49113215139 (-13861129506) 16777524431.
Definition at_abb_0 := Chart 88095602082925 (-22472454531956) 28566057089 (-12792475876) 92852918079 132896209251.
Definition at_abb_1 := Chart 145704904169792 23663175063970 61106752344 25570122110 (-12562655705) 15590029850.
Definition at_baa_0 := Chart 83997330015959 (-20597406467877) 96379648399 (-42791382652) 93277616492 159255760160.
Definition at_baa_1 := Chart 109482769850098 (-6166548067162) 266493150388 80806965281 (-176238037796) 27337233778.
Definition at_baa_2 := Chart 142566280508765 24995923829401 37376106116 21348175252 (-21836008364) 30699474583.
Definition at_bab_0 := Chart 84289162151025 (-20728405347554) 80270422785 (-35869223896) 100490823048 154420041462.
Definition at_bab_1 := Chart 110514636321488 (-5841645798187) 249758584512 81418944700 (-123553697927) 32528360825.
Definition at_bab_2 := Chart 142860486105054 25149397100696 58112196204 26328020473 (-16665887163) 23107307283.
Definition at_bba_0 := Chart 85147287670756 (-21119033658012) 56046528431 (-25379319538) 106809573977 145594564559.
Definition at_bba_1 := Chart 114400320767834 (-4369929314773) 265010017045 113889252752 (-57542459147) 38414877969.
Definition at_bba_2 := Chart 144665966464890 25704930467011 129279536075 25750932743 (-14750515724) 18557115731.
Definition at_bbb_0 := Chart 84988174634625 (-21046423015459) 31595475612 (-14278837362) 106210573568 146377163711.
Definition at_bbb_1 := Chart 113537002663108 (-4731365062850) 135574336607 55425513712 (-54631340708) 32205854718.
Definition at_bbb_2 := Chart 144176578656906 25593992194205 62658134309 15861872106 (-6721902394) 8643285657.
Definition from_aaa_0 := Link (-17592186044416) 17592186044416 144034907954958 376167422960 144034907954958 61035509544 102264437915371 121747253638254 20852782239 16336212966 true.
Definition from_aaa_1a := Link (-17592186044416) (-9501529710473) 199255038535757 64654361569 199255038535757 24503343504 157535426895820 176982603720638 (-164171118562) 8057243717 true.
Definition from_aaa_1b := Link 5892387402228 17592186044416 199115053939325 74776491599 199115053939325 34662892012 157812808707145 176685391322432 (-166175277976) 11721350978 true.
Definition from_aab_0 := Link (-17592186044416) 17592186044416 144359891382156 403401622605 144359891382156 84098158885 101702900292202 122355152548754 21053316232 23818490372 true.
Definition from_aab_1a := Link 2687537161548 17592186044416 198356108067129 103184069863 198356108067129 62814153513 171375908738283 171375908738283 (-175506164791) 22153560728 true.
Definition from_aab_1b := Link (-17592186044416) (-9934990580663) 198547547489504 73558443696 198547547489504 33136288437 159533235617369 174885110004265 (-172763338388) 11350760297 true.
Definition from_aba_0 := Link (-17592186044416) 17592186044416 146166836344916 490455391710 146166836344916 151546186664 99458166481434 124862194545762 21557008414 42910952422 true.
Definition from_aba_1a := Link 2092549208353 17592186044416 194449262069035 149863905997 194449262069035 109681752174 170341373617092 170341373617092 (-214087447694) 45322244596 true.
Definition from_aba_1b := Link (-17592186044416) (-4853866606832) 194734893399132 131766665395 194734893399132 91474240916 170412684165637 170412684165637 (-214687389875) 37250809630 true.
Definition from_baa_0 := Link (-17592186044416) 17592186044416 109482536417840 956511960589 109482536417840 447675062309 92470983825628 98842285426099 (-47928141619) 275981056333 false.
Definition from_baa_1 := Link (-17592186044416) 17592186044416 142566283005441 110340230342 142566283005441 94430597188 126024526427769 126024526427769 36496927112 10462895471 false.
Definition from_baa_2a := Link (-17592186044416) (-9494815194756) 199417617714837 105056702644 199417617714837 25745613503 156046594105689 178145857441347 (-165586764090) 8088266378 true.
Definition from_baa_2b := Link 5920668000008 17592186044416 199278211695599 115014941804 199278211695599 35748899943 156235762747025 177935278149392 (-167634904246) 11769530039 true.
Definition from_abb_0 := Link (-17592186044416) 17592186044416 145704726663330 416235222355 145704726663330 82939499454 99948317492203 124304212462886 20086034980 22314605992 true.
Definition from_abb_1a := Link (-17592186044416) (-814129270037) 195586969913036 101781132578 195586969913036 64056257492 170629953380420 170629953380420 (-208306577674) 25043185562 true.
Definition from_abb_1b := Link 8162687258515 17592186044416 195428338142304 74089671253 195428338142304 36415480057 170588986151799 170588986151799 (-209261836160) 14216983095 true.
Definition from_bba_0 := Link (-17592186044416) 17592186044416 114401110115421 1445182730126 114401110115421 379520451924 94212901772178 101526357383344 (-205164150914) 225930008313 false.
Definition from_bba_1 := Link (-17592186044416) 17592186044416 144666186797446 214835666741 144666186797446 174312513491 129533253782640 129533253782640 22114608583 64887409776 false.
Definition from_bba_2a := Link 2539995340013 17592186044416 194614436663118 156126007449 194614436663118 109518992241 169677187858132 169677187858132 (-216991894410) 45898602993 true.
Definition from_bba_2b := Link (-17592186044416) (-5217113869023) 194913232081562 138131098394 194913232081562 91405929844 169747694650009 169747694650009 (-217475970056) 37691774423 true.
Definition from_bab_0 := Link (-17592186044416) 17592186044416 110515154403892 990963437183 110515154403892 393227417620 92899072793969 99455570857185 (-97543428848) 246048389580 false.
Definition from_bab_1 := Link (-17592186044416) 17592186044416 142860559969080 131057602637 142860559969080 101876392394 126687598145284 126687598145284 27409447438 20796083907 false.
Definition from_bab_2a := Link 2736330931753 17592186044416 198522021633206 122465352946 198522021633206 62996246080 157472747193331 176584945127447 (-177195752150) 22275784400 true.
Definition from_bab_2b := Link (-17592186044416) (-9942784845495) 198712846926568 93114432645 198712846926568 33593209242 157114297551289 176971336766372 (-174391954158) 11409426310 true.
Definition from_bbb_0 := Link (-17592186044416) 17592186044416 113536869654492 1105138082125 113536869654492 217046184576 93962576011843 101099749766810 (-154240257554) 120481251780 false.
Definition from_bbb_1 := Link (-17592186044416) 17592186044416 144176395929386 115074078699 144176395929386 81780527334 128856699296247 128856699296247 10294568833 29678726133 false.
Definition from_bbb_2a := Link (-17592186044416) (-937657440870) 195778109058446 84695713958 195778109058446 62791113872 169960844409869 169960844409869 (-210768578876) 25289068836 true.
Definition from_bbb_2b := Link 8247151487186 17592186044416 195618747034289 57276279628 195618747034289 35396075308 169920670854344 169920670854344 (-211772971765) 14361313195 true.
Definition base (a b c : bool) : chart := match a, b, c with
  | true, true, true => at_aaa_0
  | true, true, false => at_aab_0
  | true, false, true => at_aba_0
  | true, false, false => at_abb_0
  | false, true, true => at_baa_0
  | false, true, false => at_bab_0
  | false, false, true => at_bba_0
  | false, false, false => at_bbb_0
  end.
Definition way (a b c d : bool) : list (link * chart) := match a, b, c, d with
  | true, true, true, true => [(from_aaa_0, at_aaa_1); (from_aaa_1a, at_aaa_0)]
  | true, true, true, false => [(from_aaa_0, at_aaa_1); (from_aaa_1b, at_aab_0)]
  | true, true, false, true => [(from_aab_0, at_aab_1); (from_aab_1a, at_aba_0)]
  | true, true, false, false => [(from_aab_0, at_aab_1); (from_aab_1b, at_abb_0)]
  | true, false, true, true => [(from_aba_0, at_aba_1); (from_aba_1a, at_baa_0)]
  | true, false, true, false => [(from_aba_0, at_aba_1); (from_aba_1b, at_bab_0)]
  | true, false, false, true => [(from_abb_0, at_abb_1); (from_abb_1a, at_bba_0)]
  | true, false, false, false => [(from_abb_0, at_abb_1); (from_abb_1b, at_bbb_0)]
  | false, true, true, true => [(from_baa_0, at_baa_1); (from_baa_1, at_baa_2); (from_baa_2a, at_aaa_0)]
  | false, true, true, false => [(from_baa_0, at_baa_1); (from_baa_1, at_baa_2); (from_baa_2b, at_aab_0)]
  | false, true, false, true => [(from_bab_0, at_bab_1); (from_bab_1, at_bab_2); (from_bab_2a, at_aba_0)]
  | false, true, false, false => [(from_bab_0, at_bab_1); (from_bab_1, at_bab_2); (from_bab_2b, at_abb_0)]
  | false, false, true, true => [(from_bba_0, at_bba_1); (from_bba_1, at_bba_2); (from_bba_2a, at_baa_0)]
  | false, false, true, false => [(from_bba_0, at_bba_1); (from_bba_1, at_bba_2); (from_bba_2b, at_bab_0)]
  | false, false, false, true => [(from_bbb_0, at_bbb_1); (from_bbb_1, at_bbb_2); (from_bbb_2a, at_bba_0)]
  | false, false, false, false => [(from_bbb_0, at_bbb_1); (from_bbb_1, at_bbb_2); (from_bbb_2b, at_bbb_0)]
  end.
(* End of what is written. *)
Local Open Scope R_scope.

Definition param : data := {| leading := {| amplitude := Exactly (Rational 8); frequency := Exactly Pi; shift := Exactly (Rational 0) |}; further := [];
  gap := Exactly (Rational 9.42497); restitution := Exactly (Rational 0.5) |}%Q.
Definition figure_14 : scene := {| reference := {| A := 8; W := PI; tau := 0 |}; others := []; d := 9.42497; e := 0.5 |}.

(* The words, from the left wall: true is P1 P2, false is P1 P2 P4. *)
Definition word (a : bool) : list hop_of :=
  if a then [Hop left right 0; Hop right left 1] else [Hop left left 0; Hop left right 0; Hop right left 1].
(* One cycle of the motion, from an impact on the left wall to another. *)
Definition cycle (s : scene) (a : bool) (i j : impact) : Prop := wall_of i = left /\ wall_of j = left /\
  if a then exists r, wall_of r = right /\ next s i r /\ next s r j
  else exists l r, wall_of l = left /\ wall_of r = right /\ next s i l /\ next s l r /\ next s r j.

Definition for_all (f : bool -> bool) : bool := if f true then f false else false.
Lemma for_all_each f : for_all f = true -> forall a, f a = true.
Proof. unfold for_all. intros h a. destruct (f true) eqn:t; [destruct a; assumption|discriminate]. Qed.
Definition accepted (a b c d : bool) : bool := PlainCoverings.check_way 56 44 param (word a) (base a b c) (way a b c d).
Lemma all_accepted : for_all (fun a => for_all (fun b => for_all (fun c => for_all (accepted a b c)))) = true.
Proof. vm_cast_no_check (eq_refl true). Qed.
Lemma each_accepted a b c d : accepted a b c d = true.
Proof.
  generalize all_accepted. generalize accepted. intros f h.
  exact (for_all_each _ (for_all_each _ (for_all_each _ (for_all_each _ h a) b) c) d).
Qed.
Lemma ends_at_base a b c d : PlainCoverings.last_of (base a b c) (way a b c d) = base b c d.
Proof. destruct a, b, c, d; reflexivity. Qed.
Lemma base_positive a b c : (0 < chart_area (base a b c))%Z.
Proof. destruct a, b, c; reflexivity. Qed.

Section Scenes.
Variable s : scene.
Hypothesis described : describes param s.
Lemma A_positive : 0 < A s.
Proof. destruct described as ((h & _) & _). unfold among, param, Exactly, Q2R in h. cbn in h. lra. Qed.
Lemma W_positive : 0 < W s.
Proof. destruct described as ((_ & h & _) & _). unfold among, param, Exactly in h. cbn in h. assert (p := PI_RGT_0). lra. Qed.
Lemma gap_positive : 0 < d s.
Proof. destruct described as (_ & _ & h & _). unfold among, param, Exactly, Q2R in h. cbn in h. lra. Qed.
Lemma one_harmonic : others s = [].
Proof. destruct described as (_ & h & _). inversion h. reflexivity. Qed.

Definition starts (a b c d : bool) : state -> Prop := PlainCoverings.keeps 44 s (word a) (base a b c) (way a b c d).
Definition letter (x : state) : bool := match wall_of (after s (impact_at s left x)) with left => false | right => true end.
Definition back (x : state) : state := follow s (word (letter x)) x.

Lemma carried a b c d : carries (frame_of 44 (base a b c)) (frame_of 44 (base b c d)) (starts a b c d) (follow s (word a)).
Proof.
  rewrite <- (ends_at_base a b c d).
  exact (proj1 (PlainCoverings.way_sound 56 44 param s described A_positive W_positive gap_positive _ _ _ (each_accepted a b c d))).
Qed.
Lemma start_in a b c d x : starts a b c d x -> in_frame (frame_of 44 (base a b c)) x /\ flown s (word a) x.
Proof.
  intros h. destruct (proj2 (PlainCoverings.way_sound 56 44 param s described A_positive W_positive gap_positive _ _ _ (each_accepted a b c d)) x h) as [inside flight].
  split; [apply inside; destruct a; discriminate|exact flight].
Qed.
Lemma told a b c d x : starts a b c d x -> letter x = a.
Proof.
  intros h. destruct (start_in a b c d x h) as [_ flight]. unfold letter.
  destruct a; destruct flight as [first _]; cbn [off_wall on_wall] in first; rewrite (next_after s gap_positive _ _ first); reflexivity.
Qed.
(* Where the starts are. *)
Lemma start_bounds a b c d x : starts a b c d x -> 4.7 <= fst x <= 5.1 /\ -1.4 <= snd x <= -1.1.
Proof.
  intros h. destruct (start_in a b c d x h) as [inside _].
  destruct (chart_bounds 44 _ _ (base_positive a b c) inside) as [bu bv]. apply Rabs_le_between in bu, bv.
  set (N := base a b c) in *.
  assert (p1 : (10 * (cu N + (Z.abs (lu N) + Z.abs (wu N))) <= 51 * 2 ^ 44)%Z) by (unfold N; destruct a, b, c; cbv; discriminate).
  assert (p2 : (10 * (- cu N + (Z.abs (lu N) + Z.abs (wu N))) <= -47 * 2 ^ 44)%Z) by (unfold N; destruct a, b, c; cbv; discriminate).
  assert (p3 : (10 * (cv N + (Z.abs (lv N) + Z.abs (wv N))) <= -11 * 2 ^ 44)%Z) by (unfold N; destruct a, b, c; cbv; discriminate).
  assert (p4 : (10 * (- cv N + (Z.abs (lv N) + Z.abs (wv N))) <= 14 * 2 ^ 44)%Z) by (unfold N; destruct a, b, c; cbv; discriminate).
  apply grid_at_most in p1, p2, p3, p4. rewrite !PlainCoverings.grid_plus in *. rewrite ?PlainCoverings.grid_opp in *. lra.
Qed.

(* The set of starts whose every cycle is one of the two words. *)
Definition chaotic : state -> Prop := followers starts (fun a => follow s (word a)) letter.
Theorem full_shift : full_shift_factor chaotic letter back.
Proof.
  apply (horseshoe (fun a b c => frame_of 44 (base a b c)) starts (fun a => follow s (word a)) letter).
  - intros a b c. apply Rgt_not_eq, chart_area_positive, base_positive.
  - exact carried.
  - exact told.
  - exists 6. intros a b c d x h. apply start_bounds in h. split; apply Rabs_le; lra.
Qed.
Theorem back_is_a_cycle x : chaotic x -> (4.7 <= fst x <= 5.1 /\ -1.4 <= snd x <= -1.1) /\
  cycle s (letter x) (impact_at s left x) (later (period s) (impact_at s left (back x))).
Proof.
  intros h. destruct (h O) as (a & b & c & d & st). cbn in st. split; [exact (start_bounds _ _ _ _ _ st)|].
  destruct (start_in _ _ _ _ _ st) as [_ flight]. unfold back. rewrite (told _ _ _ _ _ st).
  assert (W0 : W s <> 0) by (apply Rgt_not_eq, W_positive).
  assert (landing : forall y, impact_at s left y = later (period s) (impact_at s left (turned 1 y))).
  { intros y. rewrite (turned_later s left 1 y W0). f_equal. ring. }
  split; [reflexivity|]. split; [reflexivity|].
  destruct a; cbn [word follow flown hop off_wall on_wall turns_off] in *; unfold hop in *; cbn [off_wall on_wall turns_off] in *; rewrite !turned_none in *; rewrite <- landing.
  - destruct flight as (f1 & f2 & _). eexists. split; [|split; [exact f1|exact f2]]. reflexivity.
  - destruct flight as (f1 & f2 & f3 & _). do 2 eexists. split; [|split; [|split; [exact f1|split; [exact f2|exact f3]]]]; reflexivity.
Qed.

Lemma cycle_later a i j : cycle s a i j -> cycle s a (later (period s) i) (later (period s) j).
Proof.
  assert (P := period_recurs s one_harmonic (Rgt_not_eq _ _ W_positive)).
  intros (wi & wj & h). split; [exact wi|]. split; [exact wj|]. destruct a.
  - destruct h as (r & wr & n1 & n2). exists (later (period s) r). split; [exact wr|]. split; apply next_later; assumption.
  - destruct h as (l & r & wl & wr & n1 & n2 & n3). exists (later (period s) l), (later (period s) r).
    split; [exact wl|]. split; [exact wr|]. split; [|split]; apply next_later; assumption.
Qed.
(* For every sequence of the two words there is a motion with these cycles. *)
Theorem every_order (letters : nat -> bool) : exists starts : nat -> impact, forall n,
  cycle s (letters n) (starts n) (starts (S n)) /\ 4.7 + INR n * (2 * PI) <= phase s (time (starts n)) <= 5.1 + INR n * (2 * PI).
Proof.
  destruct (factor_onto _ _ _ full_shift letters) as (x & inside & same).
  exists (fun n => Nat.iter n (later (period s)) (impact_at s left (Nat.iter n back x))). intros n.
  assert (here : chaotic (Nat.iter n back x)).
  { clear same. induction n as [|n IH]; [exact inside|]. exact (factor_invariant _ _ _ full_shift _ IH). }
  destruct (back_is_a_cycle _ here) as [bounds c]. fold (itinerary letter back x n) in c. rewrite same in c. split.
  - assert (shift : forall n i j, cycle s (letters n) i j -> forall k, cycle s (letters n) (Nat.iter k (later (period s)) i) (Nat.iter k (later (period s)) j)).
    { intros m i j h k. induction k as [|k IH]; [exact h|]. exact (cycle_later _ _ _ IH). }
    specialize (shift n _ _ c n). rewrite iter_next in shift. exact shift.
  - assert (later_phase : forall k i, phase s (time (Nat.iter k (later (period s)) i)) = phase s (time i) + INR k * (2 * PI)).
    { induction k as [|k IH]; intros i; [cbn; ring|]. change (Nat.iter (S k) (later (period s)) i) with (later (period s) (Nat.iter k (later (period s)) i)).
      cbn [later time]. rewrite phase_later, IH, S_INR by (apply Rgt_not_eq, W_positive). ring. }
    rewrite later_phase, phase_at by (exact A_positive || exact W_positive). lra.
Qed.
End Scenes.

Lemma figure_14_described : describes param figure_14.
Proof. unfold describes, describes_harmonic, among, param, figure_14, Exactly, Q2R. cbn. repeat split; try exact (Forall2_nil _); lra. Qed.
Theorem figure_14_full_shift : full_shift_factor (chaotic figure_14) (letter figure_14) (back figure_14).
Proof. exact (full_shift figure_14 figure_14_described). Qed.
Theorem figure_14_cycles x : chaotic figure_14 x ->
  cycle figure_14 (letter figure_14 x) (impact_at figure_14 left x) (later (period figure_14) (impact_at figure_14 left (back figure_14 x))).
Proof. intros h. exact (proj2 (back_is_a_cycle figure_14 figure_14_described x h)). Qed.
Theorem figure_14_every_order (letters : nat -> bool) : exists starts : nat -> impact, forall n, cycle figure_14 (letters n) (starts n) (starts (S n)).
Proof. destruct (every_order figure_14 figure_14_described letters) as [starts h]. exists starts. intros n. apply h. Qed.
