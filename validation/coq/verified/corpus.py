"""The corpus of documents that `tests/corpus` writes to `target/corpus`: false ones, with what `impact-pair check` found, and files of single ones."""
import json
from pathlib import Path

FOLDER = Path("target/corpus")
# Kinds of which a theorem covers some; beside these the files of crates/certificate/tests/forged, of each schema.
KINDS = ("orbit", "lines", "shadow", "periodic", "two-impact", "trap", "chaos")
# Of how many entries of a kind one is judged in small, where it is not of two.
RARE = {"trap": 8, "forged-trap": 6, "forged-chaos": 4, "forged-orbit": 3}
# What a document has beside its claims: neither checker uses it.
UNUSED = ("program", "arithmetic", "title")


def entries(kind):
    """The entries of a kind: of, family, place, what, why, truth, check, text."""
    file = FOLDER / f"{kind}.jsonl"
    if not file.exists():
        raise SystemExit(f"error: no {file}: `cargo test --workspace --test library corpus::` and `--test recorded cases::` write it")
    return [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]


def claims_nothing(entry):
    """True if what is changed is beside the claims; of periodic orbits the scene's start is as well."""
    place = entry["place"]
    return place.startswith(UNUSED) or entry["kind"] in ("periodic", "two-impact") and place.startswith("scene.start")


def is_accepted(entry):
    """True if a document may be verified: a true one, one whose claims are unchanged, or one that `check` leaves open."""
    return entry["check"] in ("True", "true") or claims_nothing(entry) or entry["truth"] == "open" and entry["check"] in ("NotJudged", "Undecided")


def rarity(kind, entry):
    """Of how many such entries one is judged in small: of another shape, of a schema without a theorem, or of regions, which take seconds, few."""
    is_covered = kind in KINDS or kind.removeprefix("forged-") in (*KINDS, "other")
    return 10 if entry["truth"] == "unreadable" or not is_covered else RARE.get(kind, 2)


def judged(suite, quick):
    """Rows of the table of verdicts: of each kind of change how many `check` and the verified checker refuse, confirm and verify."""
    counts = {}
    for kind in [*KINDS, *(file.stem for file in sorted(FOLDER.glob("forged-*.jsonl")))]:
        for number, entry in enumerate(entries(kind)):
            if quick and number % rarity(kind, entry):
                continue
            verdict, said, _ = suite.answer(entry["text"].encode())
            if verdict == "verified" and not is_accepted(entry):
                suite.failures.append(f"{kind}, {entry['of']}: {entry['family']}, {entry['place']} {entry['what']}: {said}, but check: {entry['check']}")
            row = counts.setdefault(entry["family"], [0, 0, 0])
            row[0] += 1
            row[1] += entry["check"] in ("True", "true", "NotJudged")
            row[2] += verdict == "verified"
    return [f"| {family} | {made} | {confirmed} | {verified} |" for family, (made, confirmed, verified) in sorted(counts.items())], sum(row[0] for row in counts.values())
