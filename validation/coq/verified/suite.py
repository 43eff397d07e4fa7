#!/usr/bin/env python3
"""Has impact-pair-verified judge documents of `impact-pair run`, `periodic`, `trap` and `chaos`: right ones, corrupted ones, and texts that are none.

Run: suite.py --program IMPACT_PAIR --verified PROGRAM [--report DIR] [--quick]

Nothing that `impact-pair check` refutes may be verified; Coq's own evaluator must give the same answers on the same inputs.
"""
import argparse
import hashlib
import json
import os
import resource
import subprocess
import sys
from decimal import Decimal
from fractions import Fraction
from pathlib import Path

import corpus
import scenes
import texts

# Seconds that no program may take; of the checker they are seconds of processor time.
TIMEOUT = 120
SCENES = [Path("scenes"), Path("validation/certificates/scenes")]
OTHERS = [Path("validation/coq/tests/harmonics.toml")]
# Documents verified in full and in small: scene, options, seconds of processor time accepted.
SHADOWED = ["--arithmetic", "shadow"]
SPEED = [("figure-14", ["--impacts", "200"], 1.0), ("figure-14", ["--impacts", "2000"], 15.0), ("figure-14", [*SHADOWED, "--impacts", "1000"], 15.0)]
# Data that are intervals in the scene of figure 14, and how many impacts.
INTERVALS = [({"gap": "[9.42496, 9.42498]"}, 6), ({"restitution": "[0.49, 0.5]"}, 2), ({"gap": "[9.42496999, 9.42497001]", "restitution": "[0.4999999, 0.5]"}, 8),
             ({"velocity": "[-12.5664, -12.5663]", "time": "[0, 1e-6]"}, 4), ({"amplitude": "[7.99999, 8.00001]"}, 3),
             ({"frequency": "[3.14159, 3.1416]", "phase": "[-1e-6, 1e-6]"}, 3)]
# A scene of two harmonics, by the places of the faster and of the slower one.
TWO = "excitation = {{ amplitude = {0}, frequency = {1}, phase = 0 }}\npair = {{ gap = 9.42497, restitution = 0.5 }}\n" \
      'start = {{ time = 0, wall = "left", velocity = -12.56636 }}'
COVERED = ("impacts-reached", "time-reached")
# Two harmonics with a common period, the faster one last, and a motion that repeats.
COMMON = 'excitation = { amplitude = [2, 0.4], frequency = ["pi", "3*pi"], phase = [0, 1] }\npair = { gap = 3, restitution = 0 }\n' \
         'start = { time = 0, wall = "left", velocity = -1 }'
# Periodic orbits: scene, word, cycles.
PERIODIC = [("figure-12", "P2 P1", 1), ("figure-15", "P1 P3 P2 P4 P4", 1), ("figure-15", "P1 P3 P2 P4 P4 P1 P3 P2 P4 P4", 2), ("even-cycles", "P2 P1", 2)]
# Trapping regions, and seconds of processor time accepted.
REGIONS = [("figure-13", 1.0), ("figure-14", 10.0), ("figure-12", 1.0), ("even-cycles", 5.0), ("figure-10", 5.0), ("figure-11", 5.0), ("cascade", 5.0), ("doublings", 40.0),
           ("figure-14-sink", 10.0), ("figure-15", 40.0), ("figure-17", 60.0)]
REGIONS_OF_INTERVALS = [{"gap": "[9.42496, 9.42498]"}, {"restitution": "[0.4999, 0.5001]"}, {"velocity": "[-12.5664, -12.5663]", "time": "[0, 1e-6]"}]
# Horseshoes: scene, options, seconds of processor time accepted.
BASES = ["--bases", "docs/bases-figure-14.json", "--depth"]
THICK = ("figure-17", ["--bases", "validation/coq/verified/bases-figure-17.json", "--depth", "5"], {}, 40.0)
HORSESHOES = [("figure-14", [*BASES, "3"], {}, 10.0), ("figure-14-sink", [*BASES, "3"], {}, 10.0), ("figure-14", [*BASES, "3"], {"gap": "[9.42496, 9.42498]"}, 10.0),
              ("figure-14", [*BASES, "6"], {}, 30.0), ("figure-14", [*BASES, "8"], {}, 60.0), ("figure-14", [*BASES, "9"], {}, 110.0), THICK]
# Covered by the theorems, but the program finds no hints for them (docs/verified.md): scenes with options, and numbers of random scenes.
NOT_FOUND, NOT_FOUND_AT_RANDOM = {("figure-14-sink-35", "--impacts 60"), ("quasi-periodic-rests", "--arithmetic shadow --impacts 200")}, {100}
# The axioms of Coq's real numbers: all that a theorem may rest on.
AXIOMS = {"ClassicalDedekindReals.sig_not_dec", "ClassicalDedekindReals.sig_forall_dec", "FunctionalExtensionality.functional_extensionality_dep",
          "Classical_Prop.classic"}
CODES = {0: "verified", 1: "not verified", 2: "unreadable"}


def spent():
    """Processor time of the programs that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


class Suite:
    def __init__(self, program, verified):
        self.program, self.verified, self.failures = program, verified, []

    def run(self, scene, options, text=None):
        """The orbit document of a scene, a file or - for a text; None where it is no scene with these options."""
        command = [self.program, "run", scene, *options, "--format", "json", "--quiet"]
        done = subprocess.run(command, input=text, capture_output=True, text=True, check=False, timeout=TIMEOUT)
        return json.loads(done.stdout) if done.returncode != 2 else None

    def periodic(self, scene, word, cycles):
        """The document of the periodic orbits of a word."""
        command = [self.program, "periodic", f"scenes/{scene}.toml", "--word", word, "--cycles", str(cycles), "--format", "json", "--quiet"]
        return json.loads(subprocess.run(command, capture_output=True, text=True, check=False, timeout=TIMEOUT).stdout)

    def trap(self, scene, data=None):
        """The document of a trapping region; with other data of the scene."""
        command = [self.program, "trap", "-", "--format", "json", "--quiet"]
        text = with_intervals(Path(f"scenes/{scene}.toml").read_text(encoding="utf-8"), data or {})
        return json.loads(subprocess.run(command, input=text, capture_output=True, text=True, check=False, timeout=TIMEOUT).stdout)

    def chaos(self, scene, options, data=None):
        """The document of a horseshoe, without what becomes of the scene's own orbit; with other data of the scene."""
        command = [self.program, "chaos", "-", *options, "--no-orbit", "--format", "json", "--quiet"]
        text = with_intervals(Path(f"scenes/{scene}.toml").read_text(encoding="utf-8"), data or {})
        return json.loads(subprocess.run(command, input=text, capture_output=True, text=True, check=False, timeout=TIMEOUT).stdout)

    def answer(self, text):
        """(verdict, its last line, seconds of processor time) of a text."""
        began = spent()
        done = subprocess.run(["bash", "-c", f'ulimit -t {TIMEOUT}; exec "$0" -', self.verified], input=text, capture_output=True, check=False)
        if done.returncode < 0:
            self.failures.append(f"no answer in {TIMEOUT} s of processor time, or stopped by signal {-done.returncode}: {text[:200]!r}")
            return "none", "", TIMEOUT
        lines = done.stdout.decode(errors="replace").splitlines() or [done.stderr.decode(errors="replace")]
        name = [line for line in lines if line.startswith("document: ")]
        if name not in ([], [f"document: SHA-256 {hashlib.sha256(text).hexdigest()}"]):
            self.failures.append(f"not the SHA-256 of the document: {name}")
        verdict = CODES.get(done.returncode, f"exit code {done.returncode}")
        if not lines[-1].startswith(verdict):
            self.failures.append(f"{verdict}, but it says {lines[-1]!r}")
        return verdict, lines[-1], spent() - began

    def check(self, document):
        """The verdict of `impact-pair check`."""
        command = [self.program, "check", "-", "--quiet", "--format", "json"]
        done = subprocess.run(command, input=json.dumps(document).encode(), capture_output=True, check=False, timeout=TIMEOUT)
        return json.loads(done.stdout)["verdict"] if done.returncode in (0, 1) else "unreadable"


def is_covered(document):
    """True if a theorem covers the outcome and all events; of shadowed orbits those from a wall, with impacts alone."""
    is_shadowed = document["claim"] == "shadowed"
    repeats = not is_shadowed and document["outcome"]["kind"] == "periodic"
    draws = not is_shadowed and document["outcome"]["kind"] == "attracted" and len(document["scene"]["excitation"]["amplitude"]) == 1
    starts, events = not is_shadowed or "wall" in document["scene"]["start"], ("impact",) if is_shadowed else ("impact", "rest", "release")
    until = Fraction(document["outcome"].get("until") or -1)
    # No bounds tell a time to stop at from the very time of an event.
    beside = not any(Fraction(event["time"][0]) <= until <= Fraction(event["time"][1]) for event in document["events"] if event["event"] == "impact")
    return beside and starts and (repeats or draws or document["outcome"]["kind"] in COVERED) and all(event["event"] in events for event in document["events"])


def random_scenes(suite, quick):
    """Documents of random scenes: those covered must be verified, all others not. (documents, verified)"""
    total = verified = 0
    for number, (text, options) in enumerate(scenes.at_random(25 if quick else 250)):
        document = suite.run("-", options, text)
        if document is None:
            continue
        total += 1
        verdict, said, _ = suite.answer(json.dumps(document).encode())
        verified += verdict == "verified"
        if (is_covered(document) and number not in NOT_FOUND_AT_RANDOM) != (verdict == "verified"):
            suite.failures.append(f"random scene {number}: {said}")
    return total, verified


def right(suite, quick):
    """Rows of documents as `run` writes them; those that are covered must be verified, all others not."""
    rows = []
    for scene in [scene for folder in SCENES for scene in sorted(folder.glob("*.toml"))] + OTHERS:
        for options in (["--impacts", "12" if quick else "60"], ["--until", "3"], [*SHADOWED, "--impacts", "12" if quick else "200"], [*SHADOWED, "--until", "3"]):
            document = suite.run(scene, options)
            if document is None:
                continue
            kind, others = document["outcome"]["kind"], {event["event"] for event in document["events"]} - {"impact"}
            verdict, said, seconds = suite.answer(json.dumps(document).encode())
            if (is_covered(document) and (scene.stem, " ".join(options)) not in NOT_FOUND) != (verdict == "verified"):
                suite.failures.append(f"{scene.stem} {' '.join(options)}: {said}")
            what = kind if not others else f"{kind}, with a {min(others)}"
            what = "shadowed: " + what if document["claim"] == "shadowed" else what
            rows.append(f"| {scene.stem} | {len(document['events'])} | {what} | {said} | {seconds:.2f} |")
    return rows


def with_intervals(text, data):
    """The text of a scene with these data instead."""
    lines = [line for line in text.splitlines() if not line.startswith(("impacts", "digits"))]
    return "\n".join(next((f'{key} = "{value}"' for key, value in data.items() if line.startswith(f"{key} =")), line) for line in lines)


def intervals(suite, quick):
    """Rows of documents with intervals among their data; of wider intervals with the same bounds none is verified that `check` refutes."""
    rows, text = [], Path("scenes/figure-14.toml").read_text(encoding="utf-8")
    for data, impacts in INTERVALS:
        document = json.dumps(suite.run("-", ["--impacts", str(impacts)], with_intervals(text, data)))
        verdict, said, seconds = suite.answer(document.encode())
        if verdict != "verified":
            suite.failures.append(f"{data}: {said}")
        rows.append(f"| {', '.join(f'{key} {value}' for key, value in data.items())} | {impacts} | {said} | {seconds:.2f} |")
        for key, value in data.items():
            low, high = map(float, value.strip("[]").split(","))
            for widths in (0.1, 4, 100):
                wider = json.loads(document.replace(value, f"[{low - widths * (high - low):.12f}, {high:.12f}]"))
                if suite.answer(json.dumps(wider).encode())[0] == "verified" and suite.check(wider) != "confirmed":
                    suite.failures.append(f"{key} from {low} lower by {widths} widths of {value}: verified")
    return rows


def fast(suite, quick):
    """Rows of measured times."""
    rows = []
    for name, options, accepted in SPEED[: 1 if quick else None]:
        text = json.dumps(suite.run(f"scenes/{name}.toml", options)).encode()
        verdict, said, seconds = min((suite.answer(text) for _ in range(3)), key=lambda answer: answer[2])
        if verdict != "verified" or seconds > accepted:
            suite.failures.append(f"{name} {' '.join(options)}: {said}, {seconds:.2f} s, but accepted are {accepted} s")
        rows.append(f"| {name} {' '.join(options)} | {seconds:.2f} | {accepted:.0f} |")
    return rows


def periodic_orbits(suite, quick):
    """Rows of documents of periodic orbits; and of the orbit that attracts figure 14's neighbour. They must be verified."""
    rows = []
    for scene, word, cycles in PERIODIC[: 2 if quick else None]:
        document = suite.periodic(scene, word, cycles)
        verdict, said, seconds = suite.answer(json.dumps(document).encode())
        if verdict != "verified":
            suite.failures.append(f"{scene}, {word} in {cycles}: {said}")
        rows.append(f"| {scene} | {word} in {cycles} | {len(document['orbits'])} | {said} | {seconds:.2f} |")
    return rows


def verified_in_time(suite, document, accepted, kind, scene, data):
    """The name of a document, the answer and its seconds; it must be verified, in the accepted time."""
    verdict, said, seconds = suite.answer(json.dumps(document).encode())
    if verdict != "verified" or seconds > accepted:
        suite.failures.append(f"{kind} of {scene}: {said}, {seconds:.2f} s, but accepted are {accepted} s")
    return ", ".join([scene, *(f"{key} {value}" for key, value in data.items())]), said, seconds


def regions(suite, quick):
    """Rows of documents of trapping regions, which must be verified."""
    rows, others = [], [("figure-14", 10.0, data) for data in REGIONS_OF_INTERVALS[: 1 if quick else None]]
    for scene, accepted, data in [*((*region, {}) for region in REGIONS[: 3 if quick else None]), *others]:
        document = suite.trap(scene, data)
        what, said, seconds = verified_in_time(suite, document, accepted, "region", scene, data)
        rows.append(f"| {what} | {document['boxes']} | {document['entered_at_impact']} | {said} | {seconds:.2f} |")
    return rows


def horseshoes(suite, quick):
    """Rows of documents of horseshoes, which must be verified."""
    rows = []
    for scene, options, data, accepted in HORSESHOES[: 2 if quick else None]:
        document = suite.chaos(scene, options, data)
        what, said, seconds = verified_in_time(suite, document, accepted, "horseshoe", scene, data)
        rows.append(f"| {what} | {options[-1]} | {len(document['words'])} | {document['entropy']['per_impact']} | {said} | {seconds:.2f} |")
    return rows


def r43_periods(suite, quick):
    """The distance of a shadowed orbit from the middles of its bounds is in periods of the fastest harmonic, wherever that is listed."""
    least = []
    for order in (1, -1):
        scene = TWO.format(*(json.dumps(values[::order]) for values in (["1/100", "8"], ["3*pi", "pi"])))
        document = suite.run("-", [*SHADOWED, "--impacts", "20" if quick else "150"], scene)
        document["outcome"] |= {"message": ""}
        epsilon, half = document["outcome"]["epsilon"], 0
        most, verdict = Decimal(epsilon["maximum"]), "verified"
        while verdict == "verified" and half < 20:
            epsilon.update(median=f"{most / 2**half:.40f}".rstrip("0"), maximum=f"{most / 2**half:.40f}".rstrip("0"))
            verdict, half = suite.answer(json.dumps(document).encode())[0], half + 1
        least.append(half)
    if least[0] != least[1] or not 2 < least[0] < 20:
        suite.failures.append(f"epsilon of an orbit of two harmonics: refused at halving {least[0]} with the fastest first, {least[1]} with it last")


def common_periods(suite):
    """A period of several harmonics is that of the fastest one, wherever it stands in the list."""
    document = suite.run("-", ["--impacts", "30"], COMMON)
    if document["outcome"]["kind"] != "periodic" or (said := suite.answer(json.dumps(document).encode())[1]) != "verified":
        suite.failures.append(f"two harmonics with a common period: {document['outcome']}, {said}")
    for key, other in (("cycles", 1 / 3), ("cycles", 3), ("cycles", 2), ("impacts", 2)):
        copy = json.loads(json.dumps(document))
        copy["outcome"] |= {"message": "", "period": {**document["outcome"]["period"], key: int(document["outcome"]["period"][key] * other)}}
        if suite.answer(json.dumps(copy).encode())[0] == "verified":
            suite.failures.append(f"two harmonics with a common period: {copy['outcome']['period']} is verified")


def small_ellipse(suite):
    """Of an orbit of 35 impacts the ellipse is smaller than bounds of 9 digits; those of 20 are in it."""
    document = suite.run("scenes/figure-14-sink-35.toml", ["--impacts", "70", "--digits", "20"])
    if (said := suite.answer(json.dumps(document).encode())[1]) != "verified":
        suite.failures.append(f"figure-14-sink-35 in 20 digits: {said}")


def unreadable(suite, quick):
    """Texts that are no document of this kind; the number of them."""
    document = suite.run("scenes/figure-14.toml", ["--impacts", "3"])
    total = 0
    for what, text, accepted in [*texts.all_of(document, quick), *texts.all_of(suite.trap("figure-13"), True),
                                 *([] if quick else texts.all_of(suite.chaos(*HORSESHOES[0][:2]), True))]:
        verdict, said, _ = suite.answer(text)
        total += 1
        # Another number may be as true.
        if verdict not in accepted and not (verdict == "verified" and suite.check(json.loads(text)) == "confirmed"):
            suite.failures.append(f"{what}: {said}, but accepted is {' or '.join(accepted)}")
    return total


def same_as_coq(suite, quick):
    """The answers on these inputs are those of Coq's own evaluator; the number of them."""
    folder, library = Path(suite.verified).parent, Path("target/coq").resolve()
    document = suite.run("scenes/figure-14.toml", ["--impacts", "4"])
    shadowed, resting = suite.run("scenes/figure-14.toml", [*SHADOWED, "--impacts", "3"]), suite.run("scenes/chatter.toml", ["--until", "3", "--digits", "3"])
    repeated = suite.run("scenes/chatter.toml", ["--until", "20", "--digits", "3"])
    corrupted = [json.loads(entry["text"]) for entry in corpus.entries("orbit") if entry["truth"] != "unreadable"][:30]
    samples = [document, resting, shadowed, suite.run("scenes/two-tones.toml", ["--until", "1"]), repeated, suite.run("scenes/figure-12.toml", ["--impacts", "3"]), suite.periodic(*PERIODIC[0]), suite.trap("figure-12"), suite.chaos(*HORSESHOES[0][:2]), *corrupted]
    # One file of a module for each: Coq loads its libraries once.
    modules = []
    for number, copy in enumerate([*samples[:4], samples[5]] if quick else samples):
        source = folder / f"Answer_{number}.json"
        source.write_text(json.dumps(copy), encoding="utf-8")
        done = subprocess.run([suite.verified, "--coq", source], capture_output=True, text=True, check=False)
        if done.returncode == 0:
            head, opened, body = done.stdout.partition("Open Scope Z_scope.\n")
            # Axioms are printed once: Coq goes through its libraries for them.
            body = body.replace("Print Assumptions document_claims.\n", "") if modules else body
            modules.append(f"Module Answer_{number}.\n{body}End Answer_{number}.\n")
    (folder / "Answers.v").write_text("".join([head, opened, *modules]), encoding="utf-8")
    command = ["coqc", "-q", "-w", "none", "-R", str(library), "ImpactPair", "Answers.v"]
    compiled = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    if compiled.returncode != 0:
        suite.failures.append(f"Answers.v: Coq answers otherwise: {compiled.stderr.strip()[:300]}")
    elif axioms_in(compiled.stdout) != AXIOMS:
        suite.failures.append(f"Answers.v: the theorem rests on {', '.join(sorted(axioms_in(compiled.stdout)))}")
    return len(modules)


def compared_with_check(suite):
    """`check --verified` answers as the checker, with its exit code, on what `check` confirms; a graze, or a kind without theorem, is unverified."""
    describe = [suite.program, "describe", "scenes/figure-12.toml", "--format", "json", "--quiet"]
    described = json.loads(subprocess.run(describe, capture_output=True, text=True, check=True, timeout=TIMEOUT).stdout)
    orbit, graze = suite.run("scenes/figure-14.toml", ["--impacts", "3"]), suite.run("scenes/graze.toml", [])
    path = os.pathsep.join([str(Path(suite.verified).parent), os.environ["PATH"]])
    for document, code, reason in [(orbit, 0, "verified"), (graze, 1, "is a graze: covered are impacts"), (described, 1, "covered of a description are the documents in it: impact-pair-verified --part proof"), ({}, 2, "schema is missing")]:
        text = json.dumps(document).encode()
        done = subprocess.run([suite.program, "check", "--verified", "-"], input=text, capture_output=True, check=False, timeout=TIMEOUT, env=os.environ | {"PATH": path})
        said, verdict = (done.stdout + done.stderr).decode(), suite.check(document)
        if done.returncode != code or reason not in said or suite.answer(text)[1] not in said or verdict != ("confirmed" if document else "unreadable"):
            suite.failures.append(f"check --verified, exit code {done.returncode}, {reason!r} wanted: {said}; check says {verdict}")


def axioms_in(said):
    """The axioms that Coq prints."""
    return {line.split(":")[0].strip() for line in said.splitlines() if line[:1].isalpha()} - {"Axioms"}


def axioms(suite, quick):
    """The axioms of the theorems: only those of Coq's real numbers are accepted. In small validation/coq/run asks it of one."""
    if quick:
        return []
    found = axioms_in((Path(suite.verified).parent / "Axioms.out").read_text(encoding="utf-8"))
    if found != AXIOMS:
        suite.failures.append(f"the theorem rests on {', '.join(sorted(found))}")
    return sorted(found)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True)
    parser.add_argument("--verified", required=True)
    parser.add_argument("--report", default="validation/report")
    parser.add_argument("--quick", action="store_true")
    arguments = parser.parse_args()
    suite, quick = Suite(arguments.program, arguments.verified), arguments.quick
    r43_periods(suite, quick)
    common_periods(suite)
    compared_with_check(suite)
    if not quick:
        small_ellipse(suite)
    rows, times, orbits = right(suite, quick), fast(suite, quick), periodic_orbits(suite, quick)
    trapping, chaotic = regions(suite, quick), horseshoes(suite, quick)
    boxes, (made, accepted) = intervals(suite, quick), random_scenes(suite, quick)
    (table, false_ones), refused, coq = corpus.judged(suite, quick), unreadable(suite, quick), same_as_coq(suite, quick)
    rests_on = axioms(suite, quick)
    verdict = (f"{sum('| verified |' in row for row in rows + boxes + orbits + trapping + chaotic) + accepted} documents verified, {false_ones} false documents and {refused} other texts judged, "
               f"{coq} answers equal to those of Coq's evaluator; {len(suite.failures)} failures.")
    lines = ["# Documents verified by a checker extracted from Coq", "", verdict, "",
             "| scene | events | outcome | answer | seconds |", "|---|---|---|---|---|", *rows, "",
             "| intervals of figure 14 | impacts | answer | seconds |", "|---|---|---|---|", *boxes, "",
             "| periodic orbits | word in forcing periods | orbits | answer | seconds |", "|---|---|---|---|---|", *orbits, "",
             "| trapping region | boxes | entered at impact | answer | seconds |", "|---|---|---|---|---|", *trapping, "",
             "| horseshoe | impacts of a word | words | entropy per impact | answer | seconds |", "|---|---|---|---|---|---|", *chaotic, "",
             "| speed | seconds of processor time | accepted |", "|---|---|---|", *times, "",
             f"Random scenes: {made} documents, {accepted} verified, all others with an event or an outcome that is not covered.", "",
             "False documents, by what is changed; all that are confirmed or verified are true after all, or changed beside the claims:", "",
             "| change | documents | confirmed by `check` | verified |", "|---|---|---|---|", *table, "",
             f"The theorem rests on {', '.join(f'`{axiom}`' for axiom in rests_on)}." if rests_on else "Its axioms: see `coq.md`."]
    if suite.failures:
        lines += ["", "## Failures", "", *(f"- {failure}" for failure in suite.failures)]
    folder = Path(arguments.report)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "verified.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print(verdict)
    for failure in suite.failures:
        print(failure, file=sys.stderr)
    return 1 if suite.failures else 0


if __name__ == "__main__":
    sys.exit(main())
