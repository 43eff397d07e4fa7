"""``verify``: the program that answers is found, and its answer read. A script stands for it, but in the last test."""

import json
import os
import sys

import pytest
from conftest import ROOT

import impact_pair

BUILT = ROOT / "target" / "verified" / "impact-pair-verified"
pytestmark = pytest.mark.skipif(os.name == "nt", reason="the program that stands for the checker is a shell script")


@pytest.fixture
def answering(tmp_path, monkeypatch):
    """A program that reads all, answers so and exits so."""

    def program(answer, code):
        file = tmp_path / "impact-pair-verified"
        file.write_text(f"#!/bin/sh\ncat >{tmp_path}/read\nprintf '{answer}\\n'\nexit {code}\n")
        file.chmod(0o755)
        monkeypatch.setenv("PATH", f"{tmp_path}:{os.environ['PATH']}")
        return tmp_path / "read"

    return program


def test_a_verified_document(answering):
    read = answering("claim: an orbit\\nverified", 0)
    found = impact_pair.verify({"schema": "impact-pair/orbit/1"})
    assert found
    assert found == impact_pair.Verified("verified", "an orbit", None)
    assert read.read_text() == '{"schema": "impact-pair/orbit/1"}'


def test_an_orbit_a_text_and_a_file(answering, tmp_path):
    read = answering("claim: an orbit\\nnot verified: events[0]: no impact is found there", 1)
    sol = impact_pair.Scene.named("figure-14").run(impacts=2)
    file = tmp_path / "orbit.json"
    sol.save(file)
    for document in (sol, sol.json(), file, sol.document):
        found = impact_pair.verify(document)
        assert not found
        assert (found.verdict, found.reason) == ("not verified", "events[0]: no impact is found there")
        assert read.read_text().startswith('{"schema"')


def test_what_is_no_document(answering):
    answering("unreadable: schema is missing", 2)
    assert impact_pair.verify("{}") == impact_pair.Verified("unreadable", None, "schema is missing")


@pytest.mark.parametrize(
    ("answer", "code"),
    [("", 0), ("claim: an orbit", 0), ("claim: an orbit", 2), ("not verified: no", 0), ("verified", 1), ("verified", 137)],
)
def test_exit_code_and_last_line_say_the_same(answering, answer, code):
    answering(answer, code)
    with pytest.raises(impact_pair.Error, match="stopped without a verdict"):
        impact_pair.verify("{}")


def test_a_missing_program_is_named(monkeypatch, tmp_path):
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr(sys, "executable", str(tmp_path / "python"))
    with pytest.raises(impact_pair.Error, match="validation/coq/verified/build builds it"):
        impact_pair.verify("{}")


@pytest.mark.skipif(not BUILT.exists(), reason="validation/coq/verified/build has not run")
def test_the_program_itself(monkeypatch):
    monkeypatch.setenv("PATH", str(BUILT.parent))
    document = impact_pair.Scene.named("figure-14").run(impacts=20).document
    assert impact_pair.verify(document)
    document["events"][3]["wall"] = "left"
    assert not impact_pair.verify(document)


@pytest.mark.skipif(not BUILT.exists(), reason="validation/coq/verified/build has not run")
def test_a_shadowed_orbit(monkeypatch):
    monkeypatch.setenv("PATH", str(BUILT.parent))
    document = impact_pair.Scene.named("figure-17").run(impacts=20, arithmetic="shadow").document
    answer = impact_pair.verify(document)
    assert answer
    assert "a start on the scene's wall" in str(answer)
    document["outcome"]["epsilon"]["median"] = "1e-30"
    document["outcome"]["message"] = ""
    assert not impact_pair.verify(document)


@pytest.mark.skipif(not BUILT.exists(), reason="validation/coq/verified/build has not run")
def test_a_rest_and_its_release(monkeypatch):
    monkeypatch.setenv("PATH", str(BUILT.parent))
    document = impact_pair.Scene.named("chatter").run(until=12).document
    assert "infinitely many impacts" in str(impact_pair.verify(document))
    assert [event["event"] for event in document["events"][16:18]] == ["rest", "release"]
    document["events"][16]["time"] = document["events"][14]["time"]
    assert not impact_pair.verify(document)


@pytest.mark.skipif(not BUILT.exists(), reason="validation/coq/verified/build has not run")
def test_what_check_confirms_and_no_theorem_covers(monkeypatch):
    monkeypatch.setenv("PATH", str(BUILT.parent))
    graze, described = impact_pair.Scene.named("graze").run(), impact_pair.Scene.named("figure-12").describe()
    for answer, reason in [(graze, "is a graze: covered are"), (described, "covered of a description are the documents in it")]:
        assert answer.check()
        found = impact_pair.verify(answer)
        assert not found
        assert found.verdict == "not verified"
        assert reason in found.reason
    assert impact_pair.verify(json.loads(described.json())["proof"])
    checked = described.check()
    assert (checked.unchecked_claims, checked.theorem[:7]) == (["exponent"], "proof: ")
