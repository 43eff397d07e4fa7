"""Texts that are no orbit document: none may be verified, and each has an answer."""
import json
import random

REFUSED = ("not verified", "unreadable")
UNREADABLE = ("unreadable",)
WRONG_TYPES = (None, True, 7, -1, 1.5, 1e300, "", "x", "7", [], [1], {}, {"a": 1})
DEEP = 100_000
HUGE = "9" * 100_000


def malformed(text):
    """Texts that are not JSON, or have a key twice."""
    yield "nothing", "", UNREADABLE
    yield "no JSON", "amplitude = 8", UNREADABLE
    yield "deep lists", "[" * DEEP, UNREADABLE
    yield "deep objects", '{"a":' * DEEP, UNREADABLE
    yield "a deep value", text.replace('"0.5"', "[" * DEEP + "]" * DEEP, 1), UNREADABLE
    yield "a key twice", text.replace('"gap"', '"gap": "9", "gap"', 1), UNREADABLE
    yield "a key of the head twice", text.replace('"certified"', '"certified": true, "certified"', 1), UNREADABLE
    yield "an event's key twice", text.replace('"index"', '"index": 1, "index"', 1), UNREADABLE
    yield "a comma too many", text.replace("]}", "],}", 1), UNREADABLE
    yield "a second document", text + text, UNREADABLE
    yield "a NaN", text.replace('"index": 1', '"index": NaN'), UNREADABLE
    yield "a control character", text.replace("impact-pair/orbit", "impact\u0001pair", 1), UNREADABLE
    yield "an escaped key", text.replace('"gap"', '"g\\u0061p"', 1), REFUSED
    yield "an escaped wall", text.replace('"left"', '"l\\u0065ft"', 1), REFUSED


def numbers(text):
    """Numbers too large, too small, or of another spelling."""
    for what, gap in {"a huge gap": HUGE, "a huge exponent": "1e999999999999", "a large exponent": "1e9999", "a small one": "1e-9999",
                      "powers of powers": "((((2^64)^64)^64)^64)", "deep parentheses": "(" * 5000 + "9" + ")" * 5000, "no number": "nan",
                      "a quotient by 0": "1/0", "the root of -4": "sqrt(-4)", "a hidden 0": "9.42497/(1-1)", "two numbers": "9 .42497",
                      "a word": "gap", "a sum without end": "9+", "an interval": "[9, 9.5]", "a sign after a sign": "9 - -0.42497", "infinity": "inf", "a hexadecimal": "0x9"}.items():
        yield what, text.replace('"9.42497"', json.dumps(gap), 1), REFUSED
    yield "a huge index", text.replace('"index": 1', f'"index": {HUGE}'), REFUSED
    yield "an index as a decimal", text.replace('"index": 1', '"index": 1.0'), REFUSED
    yield "an index as text", text.replace('"index": 1', '"index": "1"'), REFUSED
    yield "a root of -4 as phase", text.replace('"phase": ["0"]', '"phase": ["sqrt(-4)"]'), REFUSED
    yield "a quotient by 0 as phase", text.replace('"phase": ["0"]', '"phase": ["1/0"]'), REFUSED


def all_of(document, quick):
    """(what, bytes, verdicts accepted) of all texts."""
    text = json.dumps(document)
    seeded = random.Random(36)
    for what, spoiled, accepted in (*malformed(text), *numbers(text)):
        yield what, spoiled.encode(), accepted
    for at in range(0, len(text), 97 if quick else 11):
        yield f"cut at {at}", text[:at].encode(), UNREADABLE
    for key in [key for key in document if key not in ("program", "arithmetic", "claim")]:
        yield f"without {key}", json.dumps({name: value for name, value in document.items() if name != key}).encode(), REFUSED
        for value in WRONG_TYPES:
            if value is not True or key != "certified":
                yield f"{key} as {value!r}", json.dumps({**document, key: value}).encode(), REFUSED
    for _ in range(50 if quick else 2000):
        spoiled = bytearray(text.encode())
        for _ in range(seeded.choice((1, 1, 2, 8))):
            spoiled[seeded.randrange(text.index('"scene"'), len(spoiled))] = seeded.randrange(256)
        if json_of(spoiled) != document:
            yield f"bytes {bytes(spoiled[:40])!r}..", bytes(spoiled), (*REFUSED, "verified")


def json_of(text):
    try:
        return json.loads(bytes(text))
    except ValueError:
        return None
