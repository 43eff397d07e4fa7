"""Questions as JSON: the answers are those of the methods."""

import json

import pytest

import impact_pair
from impact_pair import Orbit, Scene, answers, ask
from impact_pair.questions import ANSWERS, GRIDS


def question(name, verb, **options):
    return {"verb": verb, "scene": Scene.named(name).document, "options": options}


def test_run_answers_with_an_orbit(cli):
    found = ask(question("figure-14", "run", impacts=200, arithmetic="shadow"))
    assert isinstance(found, Orbit)
    assert found.document == cli.json("run", "scenes/figure-14.toml", "--impacts", 200, "--arithmetic", "shadow")
    # In the text a number has all the digits that are written.
    written = json.dumps(question("figure-14", "run")).replace("{}", '{"until": 1.00000000000000000001}')
    assert ask(written).outcome.fields["until"] == "1.00000000000000000001"


@pytest.mark.parametrize(
    ("name", "verb", "options", "kind", "method"),
    [
        ("figure-13", "periodic", {"word": "RL", "cycles": 1, "all": True}, answers.Periodic, lambda s: s.periodic("RL", 1, all=True)),
        ("figure-13", "describe", {}, answers.Description, lambda s: s.describe()),
        ("figure-13", "two-impact", {"cycles": "1..2"}, answers.TwoImpact, None),
        ("figure-10", "two-impact", {"manifold": "frequency=5..60:8"}, answers.Manifold, lambda s: s.manifold({"frequency": (5, 60, 8)})),
        ("figure-14", "trap", {"words": 5}, answers.Trap, lambda s: s.trap(words=5)),
        ("figure-14", "audit", {"events": "time,wall\n1,left\n"}, answers.Audit, lambda s: s.audit({"time": [1], "wall": ["left"]})),
    ],
)
def test_each_verb_answers_as_its_method(name, verb, options, kind, method):
    found = ask(question(name, verb, **options))
    assert type(found) is kind
    if method is not None:
        assert found.document == method(Scene.named(name)).document


def test_grids_are_asked_by_their_ranges():
    found = ask(question("figure-14", "sweep", over=["amplitude=1..10:3"], transient=5, impacts=4))
    assert list(found) == list(Scene.named("figure-14").sweep({"amplitude": (1, 10, 3)}, transient=5, impacts=4))
    with pytest.raises(impact_pair.RangeError, match="over is missing"):
        ask(question("figure-14", "atlas"))


def test_a_picture_is_drawn_where_the_verb_has_one():
    # A scene of a document has no title.
    scene = Scene.named("figure-14").varied({})
    untitled = Scene.from_text(scene.text.replace(f"title = {json.dumps(scene.title)}\n", ""))
    assert ask(question("figure-14", "trap"), picture=True).svg == untitled.trap(picture=True).svg
    assert ask(question("figure-13", "periodic", word="RL", cycles=1), picture=True).svg is None


def test_every_verb_of_the_command_line_answers_and_has_its_class(cli):
    with pytest.raises(impact_pair.RangeError, match="verb is nothing, but accepted are ") as refused:
        ask(question("figure-14", "nothing"))
    assert refused.value.key == "verb"
    known = str(refused.value).split("accepted are ")[1].split(", ")
    assert sorted(known) == sorted([*ANSWERS, "run"])
    listed = cli.text("help").split("Commands:")[1].split("Options:")[0].splitlines()
    verbs = {line.split()[0] for line in listed if line.startswith("  ") and line.strip() and line[2] != " "}
    # Of documents, of pictures alone, and about the command line.
    others = {"check", "prove", "plot", "man", "completions", "help"}
    assert verbs - others == {*known, *GRIDS}


def test_options_are_named_as_keywords_in_refusals(cli):
    with pytest.raises(impact_pair.RangeError, match=r"^no_orbit applies to one range, but over gap=\.\.\. is divided into 3 cells$"):
        ask(question("figure-14", "chaos", over="gap=9..10:3", **{"no-orbit": True}))
    said = cli.error("chaos", "scenes/figure-14.toml", "--over", "gap=9..10:3", "--no-orbit")
    assert "--no-orbit applies to one range, but --over gap=... is divided into 3 cells" in said


@pytest.mark.parametrize(
    ("change", "error", "said"),
    [
        ({"verb": 1}, impact_pair.RangeError, "invalid type: integer `1`"),
        ({"scene": {"gap": "1"}}, impact_pair.SceneError, "scene.excitation is missing"),
        ({"scene": []}, impact_pair.SceneError, "scene is "),
        ({"options": {"impacts": -1}}, impact_pair.RangeError, "impacts is -1, but"),
        ({"options": {"imapcts": 1}}, impact_pair.RangeError, "imapcts is not an option of run"),
        ({"options": {"impacts": {1}}}, impact_pair.RangeError, "must be JSON"),
        ({"sceen": {}}, impact_pair.RangeError, "unknown field `sceen`"),
    ],
)
def test_what_is_no_question_is_refused(change, error, said):
    with pytest.raises(error, match=said):
        ask(question("figure-14", "run") | change)
    gap = Scene.named("figure-14").document | {"gap": "-1"}
    with pytest.raises(impact_pair.RangeError) as refused:
        ask(question("figure-14", "run") | {"scene": gap})
    assert refused.value.key == "pair.gap"
