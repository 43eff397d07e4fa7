(* The first eight impacts of figure 14, as 'impact-pair prove' writes them. *)
From Coq Require Import Reals Lra QArith Qreals ZArith List.
From ImpactPair Require Import Model Certificate.
Import ListNotations.

Definition the_scene : scene := {| reference := {| A := 8; W := PI; tau := 0 |}; others := []; d := 9.42497; e := 0.5 |}%R.
Definition the_start : impact := {| wall_of := left; time := 0; velocity := -12.56636 |}%R.

(* What the certificate prints: wall, bounds of the time, bounds of the velocity before the impact. *)
Definition printed : list bounds := [
  Impact right 0.551348020218520847 0.551348020218521655 (35.4526376012345435) (35.4526376012346412);
  Impact left 1.66598428796560517 1.66598428796561104 (-34.28271683030372) (-34.28271683030331);
  Impact right 2.48710061392068445 2.48710061392070662 (28.642824118035764) (28.642824118036806);
  Impact right 2.8973108589986154 2.8973108589987093 (10.532996648646331) (10.532996648647718);
  Impact left 3.575505191041565 3.5755051910416004 (-35.008591762214763) (-35.008591762214298);
  Impact right 4.6256992295708048 4.6256992295708821 (33.079063419976487) (33.079063419978709);
  Impact left 5.5658130106583104 5.5658130106584813 (-31.367841494086) (-31.36784149408008);
  Impact right 6.702421955260126 6.702421955260578 (35.77029746454169) (35.77029746455359)
]%Q.

Definition param : data := {| leading := {| amplitude := Exactly (Rational 8); frequency := Exactly Pi; shift := Exactly (Rational 0) |}; further := [];
  gap := Exactly (Rational 9.42497); restitution := Exactly (Rational 0.5) |}%Q.
Definition first : beginning := Struck left (Exactly (Rational 0)) (Exactly (Rational (-12.56636)))%Q.
Definition origin : start := Start 95 70 (0) 0 (-590295311757164942921) 1%Z.
Definition legs : list leg := [
  Leg 91 40 70 right (2044915602757256420151) 5 (1665360992796208469008) 5 (1022457801378628210075) (1022457801378628210075) (826067690541059177019);
  Leg 93 40 70 left (6179032370623297515077) 21 (-1610404844300706941092) 11 (2829134975358708595609) (4790258961789660231149) (750466226485555752844);
  Leg 93 40 70 right (9224501883615780610361) 46 (1345475125045109252448) 22 (7701767127119539062719) (7701767127119539062719) (1035063546096586413221);
  Leg 94 46 70 right (10745946234206434437430) 118 (494779597309824328787) 26 (9754280900225113604201) (10134641987872777060968) (893104864388114449817);
  Leg 94 40 70 left (13261326938296825083812) 64 (-1644502273407394060607) 12 (12003636586251629760621) (12003636586251629760621) (823816284802350715458);
  Leg 94 40 70 right (17156431475826455284521) 143 (1553864130434804250070) 63 (14112419380816237541299) (15745647997927503922589) (827952275704189483404);
  Leg 95 40 70 left (20643255167604855450452) 319 (-1473480767214936482571) 147 (18899843321715655367487) (18899843321715655367487) (925774576415306870618);
  Leg 95 40 70 right (24858867230796442258397) 841 (1680282826011801780942) 288 (21326066691012108092045) (23429905571407598392874) (667351345790829456832)
]%Z.

Lemma checked : Plain.check param first origin legs printed = true.
Proof. vm_cast_no_check (eq_refl true). Qed.

Theorem orbit_certified : certified the_scene (rebound the_scene the_start) printed.
Proof.
  apply (Plain.orbit_checked _ _ _ _ _ checked).
  - unfold describes, describes_harmonic, among, param, Exactly, Q2R. cbn. repeat split; try exact (Forall2_nil _); lra.
  - exists the_start. unfold among, Exactly, Q2R. cbn. repeat split; lra.
Qed.
Print Assumptions orbit_certified.
