"""Judges `impact-pair chaos`: every word of its document is found and proved by another program, in Arb balls (`tubes.py`).

The document says with which bases; tubes, cells, proofs and words are this program's own. A word that it does not find is a
disagreement; the entropies must follow from the listed words. What it says of a hyperbolic set is proved in `cones.py`.
"""
import json
import math
from collections import Counter, namedtuple
from fractions import Fraction

import numpy as np
from flint import arb, ctx

from compare import Disagreement
from cones import check_hyperbolic, edges_of, frame_of, prove_cones
from program import run
from quads import Chord, Law, cross, minus
from tubes import followed

BITS = 80
Base = namedtuple("Base", "left right")
# Half cycles count what is left of phases with their forcing periods, half a forcing period each time the wall changes.
Word = namedtuple("Word", "from_base to_base impacts half_cycles flights")


def base_of(listed):
    """A base from its corners, which are doubles, in forcing periods."""
    left, right = (Chord(*(tuple(arb(x) for x in end) for end in listed["corners"][side])) for side in ("left", "right"))
    return Base(left, right)


def round_of(base):
    return [base.left.bottom, base.right.bottom, base.right.top, base.left.top]


def side(start, end, state, turns=0):
    """Positive if a state, `turns` forcing periods earlier, is on the left of the line."""
    return cross(minus(end, start), minus((state[0] - turns, state[1]), start))


def check_bases(bases):
    """Refuses bases that are not convex, or not apart from each other and from their own translates, whole forcing periods later."""
    for number, base in enumerate(bases):
        ends = round_of(base)
        if not all(side(ends[i], ends[i - 3], ends[i - 2]) > 0 for i in range(4)):
            raise Disagreement(f"base {number} is not convex")
        for other in bases[: number + 1]:
            for turns in range(-3, 4):
                if other is base and turns == 0:
                    continue
                if not any(
                    all(side(one[i], one[i - 3], state, shift) < 0 for state in two)
                    for one, two, shift in ((ends, round_of(other), turns), (round_of(other), ends, -turns))
                    for i in range(4)
                ):
                    whose = "its own translate" if other is base else "another one"
                    raise Disagreement(f"base {number} is not apart from {whose}")


def crossings(base, tube, turns):
    """(first, last) chords of each stretch of the tube that leads across the base `turns` forcing periods later, between the base's stable edges."""
    last = None
    for number, chord in enumerate(tube):
        if not all(
            side(base.left.bottom, base.right.bottom, state, turns) > 0 and side(base.left.top, base.right.top, state, turns) < 0
            for state in chord
        ):
            last = None
            continue
        before = all(side(*base.left, state, turns) > 0 for state in chord)
        behind = all(side(*base.right, state, turns) < 0 for state in chord)
        if before or behind:
            if last is not None and last[0] != before:
                yield last[1], number
            last = before, number


def words_of(law, bases, depth, dropped):
    """(words, parts): all proved words of `depth` impacts, and the number of parts of cells that the proof took."""
    words, parts = [], 0
    runs = [(number, "", list(base)) for number, base in enumerate(bases)]
    for _ in range(depth):
        left = []
        for start, flights, tube in runs:
            for far, stretch, count in followed(law, tube, dropped):
                parts += count
                so_far = flights + "NF"[far]
                taken = []
                low, high = (edge(float(chord.bottom[0]) for chord in stretch) for edge in (min, max))
                for number, base in enumerate(bases):
                    for turns in range(math.floor(low) - 2, math.ceil(high) + 2):
                        for first, last in crossings(base, stretch, turns):
                            if all(last <= begin or end <= first for begin, end in taken):
                                taken.append((first, last))
                                half_cycles = 2 * turns - so_far.count("F")
                                words.append(Word(start, number, len(so_far), half_cycles, so_far))
                begin = 0
                for first, last in [*sorted(taken), (len(stretch) - 1, None)]:
                    if first > begin:
                        left.append((start, so_far, stretch[begin : first + 1]))
                    begin = last
        runs = left
    return words, parts


def check_entropy(words, bases, claimed, units, weight):
    """Refuses an entropy that does not follow: M(q) v >= v must hold for a vector, M the sums of q^weight over the words."""
    q = (-arb(claimed) / units).exp()
    matrix = [[sum((q ** weight(word) for word in words if word[:2] == (a, b)), arb(0)) for b in range(bases)] for a in range(bases)]
    floats, vector = np.array([[float(x) for x in row] for row in matrix]), np.ones(bases)
    for _ in range(200):
        vector = vector + floats @ vector
        vector /= vector.max()
    vector = [arb(float(x)) for x in np.where(vector < 1e-9, 0, vector)]
    if not all(x == 0 or sum(m * y for m, y in zip(row, vector)) >= x for row, x in zip(matrix, vector)):
        raise Disagreement(f"an entropy of {claimed} does not follow from the listed words")


def prove(document, dropped=lambda place: False):
    """(words, parts of cells) that are proved here of the document's scene, from its bases on."""
    with ctx.workprec(BITS):
        law, bases = law_and_bases(document)
        check_bases(bases)
        return words_of(law, bases, document["depth"], dropped)


def judge_document(document, proved):
    """Refuses a document with a word that is not proved, or with an entropy that does not follow."""
    listed = [Word(*(word[name] for name in ("from", "to", "impacts", "half_cycles", "flights"))) for word in document["words"]]
    more = Counter(listed) - Counter(proved)
    if more:
        raise Disagreement(f"not proved here: {', '.join(str(tuple(word)) for word in more)}")
    with ctx.workprec(BITS):
        bases, entropy = len(document["bases"]), document["entropy"]
        check_entropy(listed, bases, entropy["per_impact"], 1, lambda word: word.impacts)
        check_entropy(listed, bases, entropy["per_cycle"], 2, lambda word: word.half_cycles)


def spoiled(document, proved, few):
    """(name, copy, words) of what must be refused: with the words that are proved of the copy; a few need a proof anew."""
    scene, bases, words, entropy = (document[name] for name in ("scene", "bases", "words", "entropy"))
    if not few:
        yield "a cell dropped here and there", document, prove(document, lambda place: place % 40 == 20)[0]
    wider = document | {"scene": scene | {"gap": decimal(Fraction(scene["gap"]) * Fraction("1.01"))}}
    yield "D moved by 1 %", wider, prove(wider)[0]
    corners = {name: [[u + 0.01, w] for u, w in ends] for name, ends in bases[0]["corners"].items()}
    moved = document | {"bases": [bases[0] | {"corners": corners}, *bases[1:]]}
    if not few:
        yield "a base moved", moved, prove(moved)[0]
    first, *others = words
    for name, copy in (
        ("a word added", [first | {"to": 1}, *words]),
        ("a word listed twice", [first, *words]),
        ("another half cycle", [first | {"half_cycles": first["half_cycles"] + 1}, *others]),
    ):
        yield name, document | {"words": copy}, proved
    for name, claimed in entropy.items():
        more = decimal(Fraction(claimed) + Fraction("0.000001"))
        yield f"an entropy {name} that is greater", document | {"entropy": entropy | {name: more}}, proved


def law_and_bases(document):
    scene = document["scene"]
    law = Law(arb(scene["gap"]) / arb(scene["excitation"]["amplitude"][0]), arb(scene["restitution"]))
    return law, [base_of(listed) for listed in document["bases"]]


def judge_set(document, few):
    """(number of cells, spoiled copies that are refused) of the hyperbolic set of a document; refuses it if it is not proved here."""
    with ctx.workprec(BITS):
        law, bases = law_and_bases(document)
        check_bases([Base(*edges_of(frame_of(base))) for base in bases])
    words, images = prove_cones(document, bases, law)
    check_hyperbolic(document, bases, law, words, images)
    cones = [(name, lambda copy=copy, dropped=dropped: prove_cones(copy, bases, law, dropped)) for name, copy, dropped in list(spoiled_cones(document))[: 1 if few else None]]
    bounds = [(name, lambda copy=copy: check_hyperbolic(copy, bases, law, words, images)) for name, copy in spoiled_bounds(document)]
    return sum(map(len, images)), refused(cones + bounds)


def refused(judged):
    """The number of judgements, (name, function), all of which must be refusals."""
    for name, judge in judged:
        try:
            judge()
        except Disagreement:
            continue
        raise Disagreement(f"negative control: a copy with {name} was not refused")
    return len(judged)


def spoiled_cones(document):
    """(name, copy, cells to drop) of sets whose cones must be refused."""
    claimed = document["hyperbolic"]
    at = 1 / 3
    yield "a cone not proved in one place", document, lambda cell: abs(cell.a - at) <= cell.reach and abs(cell.eta - at) <= cell.rise
    for name, changes in (("cones so wide that curves may meet a strip twice", {"kappa": "700"}),
                          ("a word that does not lead back", {"words": [0, 1, *claimed["words"][1:]]})):  # fmt: skip
        yield name, document | {"hyperbolic": claimed | changes}, lambda cell: False


def spoiled_bounds(document):
    """(name, copy) of sets whose bounds must be refused."""
    claimed = document["hyperbolic"]
    for name, key, of, end, value in (("a greater exponent that is too small", "exponents", "per_impact", 1, "0.75"),
                                      ("a greater exponent that is too great", "exponents", "per_cycle", 0, "1.6"),
                                      ("an entropy that is too great", "entropy", "per_impact", 0, "0.2812")):  # fmt: skip
        bounds = list(claimed[key][of])
        bounds[end] = value
        yield name, document | {"hyperbolic": claimed | {key: claimed[key] | {of: bounds}}}


def decimal(value):
    """With seven places: as many as are requested here."""
    return f"{float(value):.7f}"


def judge_chaos(text, bases, depth, few, binary):
    """(tally, remark): the program's document of a scene, with the bases of a file, and spoiled copies of it, or a few of them."""
    document = json.loads("\n".join(run(binary, text, ["--depth", str(depth), "--bases", bases, "--hyperbolic"], "json", "chaos")))
    if not document["certified"] or not document["words"]:
        raise Disagreement("no word is proved")
    proved, parts = prove(document)
    judge_document(document, proved)
    cells, count = judge_set(document, few)
    count += refused([(name, lambda copy=copy, words=words: judge_document(copy, words)) for name, copy, words in spoiled(document, proved, few)])
    words, entropy = len(document["words"]), document["entropy"]["per_impact"]
    return Counter(scenes=1, words=words, spoiled=count), (
        f"all {words} words proved again, with {parts} parts of cells, and the entropy {entropy} follows; "
        f"{cells} cells of its hyperbolic set, and its exponents up to a sixteenth; "
        f"{count} spoiled copies were refused"
    )
