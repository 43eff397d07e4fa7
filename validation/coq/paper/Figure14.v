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
Definition at_aaa_0 := Chart 88802135353704 (-22792269873054) 20788277997 (-9174956327) 91705112283 127165814048.
Definition at_aaa_1 := Chart 144034869058726 22945073367553 42186413052 18564956169 (-11690255996) 16168362846.
Definition at_aab_0 := Chart 88662642953195 (-22729219032885) 30099352524 (-13325307143) 92115153164 128568069472.
Definition at_aab_1 := Chart 144359684522022 23087589957622 62243555599 27162937975 (-12029683537) 16354620377.
Definition at_aba_0 := Chart 87905268626260 (-22385427025550) 55511526913 (-24930266962) 93457366325 134706736712.
Definition at_aba_1 := Chart 146165593722005 23853936904237 119846673837 49284120752 (-13866820601) 16784412939.
Definition at_abb_0 := Chart 88095749778576 (-22472511631613) 28796455745 (-12895653197) 92858989064 132904898379.
Definition at_abb_1 := Chart 145704556148541 23663030464902 61624318939 25786697866 (-12569982777) 15599122614.
Definition at_baa_0 := Chart 83997034490198 (-20597860871660) 100089310489 (-45049389943) 87200185488 162087294441.
Definition at_baa_1 := Chart 109483007896902 (-6166620800237) 271949287570 82452685174 (-182874637824) 28340865919.
Definition at_baa_2 := Chart 142566246972710 24995939904445 37365367317 21342041554 (-22786806095) 32036211146.
Definition at_bab_0 := Chart 84288787754796 (-20728737569794) 80389571292 (-36485065894) 97483273047 155866442130.
Definition at_bab_1 := Chart 110514390608277 (-5841845861632) 249753935092 81451430384 (-124373354587) 32817555396.
Definition at_bab_2 := Chart 142860335376487 25149348013993 58125317400 26333965097 (-16747885090) 23220997678.
Definition at_bba_0 := Chart 85148206964953 (-21119446722234) 56905056704 (-25768083375) 106817159420 145604904449.
Definition at_bba_1 := Chart 114405639270199 (-4367640105001) 269289672434 115728454001 (-57942994258) 38682271953.
Definition at_bba_2 := Chart 144669150980818 25705581220367 131216448874 26136742537 (-15060968762) 18947686004.
Definition at_bbb_0 := Chart 84988053167851 (-21046363161836) 31839459655 (-14389100253) 106215094771 146383394737.
Definition at_bbb_1 := Chart 113536353508629 (-4731628641682) 136725047498 55895947452 (-54695392204) 32243613871.
Definition at_bbb_2 := Chart 144176223803124 25593903383920 63185896946 15995474926 (-6764148605) 8697607491.
Definition from_aaa_0 := Link (-17592186044416) 17592186044416 144034881846628 376358880365 144034881846628 61021843475 102254765795933 121738113506117 20865732491 16329147573 true.
Definition from_aaa_1a := Link (-17592186044416) (-9502607605882) 199255050516341 64667070167 199255050516341 24491117799 157532383880155 176981319563022 (-164278193350) 8053765200 true.
Definition from_aaa_1b := Link 5891909253436 17592186044416 199115124785288 74789246729 199115124785288 34650720291 157812292621057 176684836722413 (-166282753121) 11720326049 true.
Definition from_aab_0 := Link (-17592186044416) 17592186044416 144359729263813 403609146714 144359729263813 84099366457 101695766110876 122345456612025 21066357734 23823835745 true.
Definition from_aab_1a := Link 2653299477961 17592186044416 198356568643701 103365533780 198356568643701 62970639382 171376034405695 171376034405695 (-175511981238) 22218502148 true.
Definition from_aab_1b := Link (-17592186044416) (-9878693819692) 198547688112562 73824645899 198547688112562 33377568154 159524456692815 174883583098805 (-172773995586) 11442226832 true.
Definition from_aba_0 := Link (-17592186044416) 17592186044416 146165746844183 490875447185 146165746844183 151953528236 99451773374111 124853335332832 21566540443 43063483619 true.
Definition from_aba_1a := Link 1541062712209 17592186044416 194454662886735 154161716106 194454662886735 113960938462 170342714593211 170342714593211 (-211316848981) 46541555328 true.
Definition from_aba_1b := Link (-17592186044416) (-4839649382018) 194737479792620 132208916249 194737479792620 91898966398 170413332567436 170413332567436 (-213365379999) 36828995460 true.
Definition from_abb_0 := Link (-17592186044416) 17592186044416 145704383277963 416830584999 145704383277963 83513904281 99945131538635 124295574735006 20097946809 22504114914 true.
Definition from_abb_1a := Link (-17592186044416) (-709273046519) 195587870949790 102730371817 195587870949790 64983207679 170630186334736 170630186334736 (-208316822394) 25426018343 true.
Definition from_abb_1b := Link 8180455075009 17592186044416 195428209114844 74341689785 195428209114844 36645566317 170588952616063 170588952616063 (-209271394613) 14326829789 true.
Definition from_baa_0 := Link (-17592186044416) 17592186044416 109482749971361 961435032697 109482749971361 483135670907 92469443528002 98840872398293 (-49665024339) 281593525401 false.
Definition from_baa_1 := Link (-17592186044416) 17592186044416 142566245405082 113607758437 142566245405082 97100254004 126024626650992 126024626650992 38086087038 10459897279 false.
Definition from_baa_2a := Link (-17592186044416) (-9491862410283) 199417631006173 108633322969 199417631006173 25868775717 156039413775018 178140901001927 (-165694772881) 8084774579 true.
Definition from_baa_2b := Link 5916943297839 17592186044416 199278283259648 118585330551 199278283259648 35867772318 156228001355634 177924972682547 (-167743325069) 11768499949 true.
Definition from_bab_0 := Link (-17592186044416) 17592186044416 110514888788806 987302025520 110514888788806 406464259932 92894228805848 99450754064350 (-98402448451) 246148849175 false.
Definition from_bab_1 := Link (-17592186044416) 17592186044416 142860403143064 131413002659 142860403143064 102041790139 126687396875671 126687396875671 27544388785 20800917618 false.
Definition from_bab_2a := Link 2702021605406 17592186044416 198522479146719 122924025545 198522479146719 63162182361 157465086757392 176576990301882 (-177201557710) 22341067640 true.
Definition from_bab_2b := Link (-17592186044416) (-9886413178910) 198712987040945 93657687202 198712987040945 33843557944 157110869843134 176965153669851 (-174402696292) 11501363167 true.
Definition from_bba_0 := Link (-17592186044416) 17592186044416 114406377603283 1451996564985 114406377603283 384946834764 94210927615956 101525470275539 (-206767695816) 229380780061 false.
Definition from_bba_1 := Link (-17592186044416) 17592186044416 144669352124298 218106272588 144669352124298 177267480906 129537495697248 129537495697248 22578815006 65852084047 false.
Definition from_bba_2a := Link 2161393867600 17592186044416 194608989293095 161502247002 194608989293095 113916526055 169675904595762 169675904595762 (-214239522898) 47147278155 true.
Definition from_bba_2b := Link (-17592186044416) (-5338355159721) 194910401556386 139598655026 194910401556386 91891169386 169747017736774 169747017736774 (-216165901132) 37270327734 true.
Definition from_bbb_0 := Link (-17592186044416) 17592186044416 113536231499054 1106485986081 113536231499054 218347748602 93959320345882 101096364928683 (-154405374884) 121515381552 false.
Definition from_bbb_1 := Link (-17592186044416) 17592186044416 144176046197275 115790787261 144176046197275 82462091571 128856199852952 128856199852952 10359335128 29929098303 false.
Definition from_bbb_2a := Link (-17592186044416) (-832540620931) 195779005403536 85757967211 195779005403536 63715562451 169961070569556 169961070569556 (-210778783528) 25675621052 true.
Definition from_bbb_2b := Link 8264089924839 17592186044416 195618618702122 57647165645 195618618702122 35629466827 169920638264777 169920638264777 (-211782668619) 14472278245 true.
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

(* Every gap from 9.42477 to 9.42498: the printed one, and 3 pi, of which it is a slip. *)
Definition param : data := {| leading := {| amplitude := Exactly (Rational 8); frequency := Exactly Pi; shift := Exactly (Rational 0) |}; further := [];
  gap := Between (Rational 9.42477) (Rational 9.42498); restitution := Exactly (Rational 0.5) |}%Q.
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
(* Bounds of the starts. *)
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
Theorem figure_14_every_order (letters : nat -> bool) : exists starts : nat -> impact, forall n,
  cycle figure_14 (letters n) (starts n) (starts (S n)) /\
  4.7 + INR n * (2 * PI) <= phase figure_14 (time (starts n)) <= 5.1 + INR n * (2 * PI).
Proof. exact (every_order figure_14 figure_14_described letters). Qed.
