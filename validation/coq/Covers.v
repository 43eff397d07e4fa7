(* The covering relation of a map that is defined on a slice of an h-set, by what a check of it finds. *)
From Coq Require Import Reals Lra.
From Coquelicot Require Import Coquelicot.
From ImpactPair Require Import Horseshoe.
Open Scope R_scope.

(* The slice of N from a to b has its image between the edges of M, and its two ends beyond the two ends of M. *)
Record covers (N M : frame) (a b sign : R) (g : state -> state) : Prop := {
  covers_from : -1 <= a; covers_order : a < b; covers_to : b <= 1; covers_sign : sign = 1 \/ sign = -1;
  covers_continuous : continuous_on (slice N a b) g;
  covers_flat : forall x, slice N a b x -> -1 <= across M (g x) <= 1;
  covers_start : forall x, slice N a b x -> along N x = a -> sign * along M (g x) <= -1;
  covers_end : forall x, slice N a b x -> along N x = b -> 1 <= sign * along M (g x) }.

Lemma covers_carries N M a b sign g : covers N M a b sign g -> carries N M (fun x => slice N a b x /\ in_frame M (g x)) g.
Proof. intros [h1 h2 h3 h4 h5 h6 h7 h8]. apply covering with (a := a) (b := b) (sign := sign); try assumption; lra. Qed.
