(* Extraction of `verify_document` (Pieces.v), `verify_shadow` (Shadow.v), `verify_cycles` (Drawn.v), `verify_attracted`, `verify_region` and `verify_chaos` (Carrier.v) to OCaml.
   Coq's binary integers become those of Zarith: each function below has the meaning of the Coq function, for all arguments; what it says of Zarith's is in integers.ml. These
   lines are trusted. *)
From Coq Require Import ZArith QArith Extraction ExtrOcamlBasic.
From Flocq Require Import Zaux.
From ImpactPair Require Import Model Certificate Document Orbit Rests Pieces Covering Shadow Cycle Cycles Drawn Region Columns March Trap Carrier.
From ImpactPair Require Chaos Reduced Strips Words Motions Entropies Blocks Sets.

Extract Inductive positive => "Integers.t" [ "Integers.double_plus_one" "Integers.double" "Integers.one" ] "Integers.match_positive".
Extract Inductive Z => "Integers.t" [ "Integers.zero" "(fun p -> p)" "Integers.neg" ] "Integers.match_integer".
Extract Inductive N => "Integers.t" [ "Integers.zero" "(fun p -> p)" ] "Integers.match_natural".
Extract Inductive comparison => "Integers.comparison" [ "Integers.Eq" "Integers.Lt" "Integers.Gt" ].

Extract Inlined Constant Pos.succ => "Integers.succ".
Extract Inlined Constant Pos.add => "Integers.add".
Extract Inlined Constant Pos.mul => "Integers.mul".
Extract Inlined Constant Pos.sub => "Integers.sub_positive".
Extract Inlined Constant Pos.pred => "Integers.pred_positive".
Extract Inlined Constant Pos.compare => "Integers.compared".
Extract Inlined Constant Pos.eqb => "Integers.equal".
Extract Inlined Constant Pos.leb => "Integers.leq".
Extract Inlined Constant Pos.ltb => "Integers.lt".

Extract Inlined Constant Z.add => "Integers.add".
Extract Inlined Constant Z.sub => "Integers.sub".
Extract Inlined Constant Z.mul => "Integers.mul".
Extract Inlined Constant Z.opp => "Integers.neg".
Extract Inlined Constant Z.succ => "Integers.succ".
Extract Inlined Constant Z.pred => "Integers.pred".
Extract Inlined Constant Z.abs => "Integers.abs".
Extract Inlined Constant Z.max => "Integers.max".
Extract Inlined Constant Z.min => "Integers.min".
Extract Inlined Constant Z.compare => "Integers.compared".
Extract Inlined Constant Z.eqb => "Integers.equal".
Extract Inlined Constant Z.leb => "Integers.leq".
Extract Inlined Constant Z.ltb => "Integers.lt".
Extract Inlined Constant Z.even => "Integers.is_even".
Extract Inlined Constant Z.odd => "Integers.is_odd".
Extract Inlined Constant Z.div2 => "Integers.div2".
Extract Inlined Constant Z.shiftl => "Integers.shiftl".
Extract Inlined Constant Z.shiftr => "Integers.shiftr".
Extract Inlined Constant Z.log2 => "Integers.log2".
Extract Inlined Constant Z.pow => "Integers.pow".
Extract Inlined Constant Z.pow_pos => "Integers.pow".
Extract Inlined Constant Z.div_eucl => "Integers.div_eucl".
Extract Inlined Constant Zaux.Zfast_div_eucl => "Integers.div_eucl".
Extract Inlined Constant Z.div => "Integers.div".
Extract Inlined Constant Z.modulo => "Integers.modulo".
Extract Inlined Constant Z.sqrtrem => "Integers.sqrtrem".
Extract Inlined Constant Z.to_pos => "Integers.to_positive".
Extract Inlined Constant Z.sgn => "Integers.signum".

(* Coq's real numbers are in the modules of Interval, which extraction takes whole; the checker never computes with them. Should it
   do so, it would stop without an answer. *)
Extract Constant ClassicalDedekindReals.sig_forall_dec => "(fun _ -> failwith ""real numbers are not computed"")".

Extraction Language OCaml.
Set Extraction Output Directory ".".
Extraction "checker.ml" Shifting Shadowing Drawing Trapping Striding Setting Growing Strips.no_strip verify_attracted verify_region verify_chaos.
