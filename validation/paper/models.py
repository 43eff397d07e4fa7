"""Models II and III, and "period three" of section 3.1."""
from finding import FALSE, Finding, excludes, expect
from listed import finding, listed
from program import Run, scene


def model_2(quick):
    """th = -pi/2 with v = 0 grazes the right wall once a cycle, if A <= d/2."""
    run = Run("validation/paper/scenes/model-2.toml")
    kinds = {(event["event"], event["wall"]) for event in run.events}
    expect(kinds == {("graze", "right")}, "grazes of the right wall")
    expect(run.outcome["kind"] == "periodic", "proved to repeat")
    beyond = Run(scene("1", "0.5", "0", "-pi/2", "0.51", wall="right"), "--impacts", "1")
    expect(beyond.impacts[0][0] == "left", "A = 0.51 d reaches the left wall")
    return [Finding("model II is physically unattainable: true of impacts, but a grazing orbit exists", FALSE,
                    f"A = 0.4 d, th = -pi/2, v = 0: {len(run.events)} grazes listed, outcome periodic; A = 0.51 d hits "
                    "the left wall first")]


def model_3(quick):
    """Models that do occur."""
    return [finding("model III, RRLL", "model III, P2 P4 P1 P3, occurs"),
            finding("LLR", "the intermediate model LLR occurs")]


def period_three(quick):
    """A stable orbit of period three: its basin is open, and no motion in it is chaotic."""
    orbit = listed("period three")
    excludes(orbit.states[0][2] - orbit.states[2][2], "the period is three")
    return [finding("period three", "period three implies chaos (after (34))", FALSE)]


CLAIMS = {"model-2": model_2, "model-3": model_3, "period-three": period_three}
