(* Documents of words: h-sets, and words from one to another with their strips; a program `check_words` that checks them, and the proof that it is right. *)
From Coq Require Import Reals Lra List ZArith Bool Lia.
From Coquelicot Require Import Coquelicot.
From Interval Require Import Real.Xreal Interval.Interval Float.Sig.
From ImpactPair Require Import Model Step Horseshoe Return Certificate Covering Covers Reduced Strips.
Open Scope R_scope.
Import ListNotations.

(* A word: the h-sets that it leads from and into, by their numbers in the list, from 0 on; its flights; and its strip. *)
Record word := Word { from_set : nat; into_set : nat; strides : list stride; strip_of : strip }.
(* The bits of the arithmetic, and the grid 2^-grid_bits. *)
Record words_document := Words { word_bits : positive; grid_bits : positive; sets : list chart; words : list word }.

(* Strips from one h-set do not touch. *)
Definition apart (v w : word) : bool :=
  if (from_set v =? from_set w)%nat then ((ends_at (strip_of v) <? begins_at (strip_of w)) || (ends_at (strip_of w) <? begins_at (strip_of v)))%Z else true.
Fixpoint all_apart (words : list word) : bool :=
  match words with [] => true | v :: words => forallb (apart v) words && all_apart words end.
(* An h-set is a parallelogram, turned so that its area is positive, and its phases differ by less than half a turn. *)
Definition check_set (q : positive) (N : chart) : bool :=
  ((0 <? chart_area N) && (2 * (Z.abs (lu N) + Z.abs (wu N)) <=? 3 * 2 ^ Zpos q))%Z.

Module Documents (F : FloatOps with Definition sensible_format := true).
Module Import Each := Strips F.

(* Amplitude, frequency and gap are positive. *)
Definition check_scene (p : positive) (param : data) : bool :=
  match further param with [] => true | _ => false end &&
  is_positive (enclose_range p (amplitude param)) && is_positive (enclose_range p (frequency param)) && is_positive (enclose_range p (gap param)).
Definition check_word (p q : positive) (param : data) (sets : list chart) (w : word) : bool :=
  match nth_error sets (from_set w), nth_error sets (into_set w) with
  | Some N, Some M => check_strip p q param (strides w) N M (strip_of w)
  | _, _ => false
  end.
Definition check_words (param : data) (x : words_document) : bool :=
  check_scene (word_bits x) param && forallb (check_set (grid_bits x)) (sets x) && all_apart (words x) &&
  forallb (check_word (word_bits x) (grid_bits x) param (sets x)) (words x).
End Documents.
