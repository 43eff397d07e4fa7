"""Documents that are false in one claim, and true ones: `crates/certificate/tests/forged`, one a file. The checker in Rust judges the same files."""
import json
from pathlib import Path

FOLDER = Path("crates/certificate/tests/forged")


def judged(suite):
    """Has each document judged: no false one may be verified. How many of the false ones and of the true ones are verified, and how many there are."""
    found = []
    for kind in ("false", "true"):
        answers = []
        for file in sorted((FOLDER / kind).glob("*.json")):
            lines = json.loads(file.read_text(encoding="utf-8"))["document"]
            verdict, said, _ = suite.answer("\n".join(map(json.dumps, lines)).encode())
            answers.append(verdict)
            if kind == "false" and verdict == "verified":
                suite.failures.append(f"{file.stem}: {said}")
        if not answers:
            suite.failures.append(f"{FOLDER / kind} has no documents")
        found.append((answers.count("verified"), len(answers)))
    return found
