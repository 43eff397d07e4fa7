(* Eight impacts under three harmonics, the frequencies of which have no common period, as 'impact-pair prove' writes them. *)
From Coq Require Import Reals Lra QArith Qreals ZArith List.
From ImpactPair Require Import Model Certificate.
Import ListNotations.

Definition the_scene : scene := {|
  reference := {| A := 2; W := PI; tau := 1 |};
  others := [{| A := 6; W := sqrt 2; tau := 0.3 |}; {| A := 4; W := 1; tau := 0 |}]; d := 9.42497; e := 0.8 |}%R.
Definition the_start : impact := {| wall_of := left; time := 0; velocity := -12.56636 |}%R.

(* The printed impacts: wall, bounds of the time, bounds of the velocity before the impact. *)
Definition printed : list bounds := [
  Impact right 0.553947598221 0.553947600221 23.962478105779 23.962478125779;
  Impact left 1.140295495202 1.140295497202 (-15.588435799593) (-15.588435779593);
  Impact right 1.908680287217 1.908680289217 15.454233267007 15.454233287007;
  Impact left 3.273466677632 3.273466679632 (-16.984844527834) (-16.984844507834);
  Impact right 4.575256144993 4.575256146993 12.220066043366 12.220066063366;
  Impact left 5.424731731267 5.424731733267 (-14.722414899832) (-14.722414879832);
  Impact right 6.101598213282 6.101598215282 19.705197970967 19.705197990967;
  Impact left 7.067773897515 7.067773899515 (-12.891013258054) (-12.891013238054)
]%Q.

Definition param : data := {|
  leading := {| amplitude := (Exactly (Rational 2)); frequency := (Exactly (Pi)); shift := (Exactly (Rational 1)) |};
  further := [{| amplitude := (Exactly (Rational 6)); frequency := (Exactly (Root (Rational 2))); shift := (Exactly (Rational 0.3)) |};
    {| amplitude := (Exactly (Rational 4)); frequency := (Exactly (Rational 1)); shift := (Exactly (Rational 0)) |}];
  gap := (Exactly (Rational 9.42497)); restitution := (Exactly (Rational 0.8)) |}%Q.
Definition first : beginning := (Struck left (Exactly (Rational 0)) (Exactly (Rational (-12.56636))))%Q.
Definition origin : start := Start 89 64 (0x10000000000000000) 0 (-0x1ffffe3a864848165) 2%Z.
Definition legs : list leg := [
  Leg 89 45 64 right (0x2bd82d7029d395107) 7 (0x3d051b684b4e8913d) 6 (0x1dec16b814e9ca884) (0x1dec16b814e9ca884) (0x456eb3ef9f9c5bf8);
  Leg 90 46 64 left (0x495147e4c8b914f1b) 12 (-0x27b21487e5189c1c5) 18 (0x3a94baaa794655011) (0x3a94baaa794655011) (0x1836541c2e80d678);
  Leg 90 46 64 right (0x6ff0d40b6c8999f5b) 27 (0x275a9800cd1d2e859) 16 (0x5ca10df81aa15773b) (0x5ca10df81aa15773b) (0x60f63741839111cb);
  Leg 91 47 64 left (0xb48ad98a748c3b2e3) 47 (-0x2b4065ac374c80487) 32 (0x923dd6caf08aea91f) (0x923dd6caf08aea91f) (0x9589ac52182ac532);
  Leg 91 47 64 right (0xf5fa3aa85bc4d453a) 168 (0x1f1e3e99354dc1bd1) 40 (0xd5428a19682887c0e) (0xd5428a19682887c0e) (0x363c67aacdb653e9);
  Leg 92 48 64 left (0x120ad3ffe86487c308) 75 (-0x257d85b875193fe8f) 107 (0x10b53bd537106a8421) (0x10b53bd537106a8421) (0x1db8d5f29842e154);
  Leg 92 48 64 right (0x142b324a6b25efa1aa) 95 (0x322dcaba025dc4171) 79 (0x131b032529c53bb259) (0x131b032529c53bb259) (0x63adcc71c5c80744);
  Leg 92 48 64 left (0x17343db4b3b4b13ba7) 157 (-0x20d3a253f5d909bb3) 107 (0x15afb7ff8f6d506ea8) (0x15afb7ff8f6d506ea8) (0x9d030f150fac6602)
]%Z.

Lemma checked : Plain.check param first origin legs printed = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem orbit_certified : certified the_scene (rebound the_scene the_start) printed.
Proof.
  apply (Plain.orbit_checked _ _ _ _ _ checked).
  - assert (two : Q2R 2 = 2) by (unfold Q2R; cbn; lra). unfold describes, describes_harmonic, among, param, Exactly. cbn.
    repeat match goal with |- Forall2 _ _ _ => constructor | |- _ /\ _ => split end; cbn; rewrite ?two; unfold Q2R; cbn; lra.
  - exists the_start. unfold among, Exactly, Q2R. cbn. repeat split; lra.
Qed.
Print Assumptions orbit_certified.
