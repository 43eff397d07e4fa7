(* Must NOT compile: impact 4 of figure 14, on the right wall, is left out; all else fits the flight that would go on through the wall. *)
From Coq Require Import Reals Lra QArith Qreals ZArith List.
From ImpactPair Require Import Model Certificate.
Import ListNotations.

Definition the_scene : scene := {| reference := {| A := 8; W := PI; tau := 0 |}; others := []; d := 9.42497; e := 0.5 |}%R.
Definition the_start : impact := {| wall_of := left; time := 0; velocity := -12.56636 |}%R.

(* The printed impacts: wall, bounds of the time, bounds of the velocity before the impact. *)
Definition printed : list bounds := [
  Impact right 0.551348020218520847 0.551348020218521655 (35.4526376012345435) (35.4526376012346412);
  Impact left 1.66598428796560517 1.66598428796561104 (-34.28271683030372) (-34.28271683030331);
  Impact right 2.48710061392068445 2.48710061392070662 (28.642824118035764) (28.642824118036806);
  Impact left 3.92916386013001 3.92916386213001 (-37.8161743664604) (-37.8161723664604)
]%Q.

Definition param : data := {| leading := {| amplitude := Exactly (Rational 8); frequency := Exactly Pi; shift := Exactly (Rational 0) |}; further := [];
  gap := Exactly (Rational 9.42497); restitution := Exactly (Rational 0.5) |}%Q.
Definition first : beginning := Struck left (Exactly (Rational 0)) (Exactly (Rational (-12.56636)))%Q.
Definition origin : start := Start 94 70 (0) 0 (-590295311757164942921) 1%Z.
Definition legs : list leg := [
  Leg 91 40 70 right (2044915602757256420151) 5 (1665360992796208469008) 5 (1022457801378628210075) (1022457801378628210075) (826067690541059177019);
  Leg 93 40 70 left (6179032370623297515077) 21 (-1610404844300706941092) 11 (2829134975358708595609) (4790258961789660231149) (750466226485555752844);
  Leg 93 40 70 right (9224501883615780610361) 46 (1345475125045109252448) 22 (7701767127119539062719) (7701767127119539062719) (1035063546096586413221);
  Leg 94 40 70 left (14573025005567602023567) 160 (-1776386308112908125631) 28 (9754280900225113604201) (12885321653480423083134) (173171403884996625104)
]%Z.

Lemma checked : Plain.check param first origin legs printed = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem orbit_certified : certified the_scene (rebound the_scene the_start) printed.
Proof.
  apply (Plain.orbit_checked _ _ _ _ _ checked).
  - unfold describes, describes_harmonic, among, param, Exactly, Q2R. cbn. repeat split; try exact (Forall2_nil _); lra.
  - exists the_start. unfold among, Exactly, Q2R. cbn. repeat split; lra.
Qed.
