"""Section 5: chaos "under high frequency excitation". Only A/d and e matter."""
from finding import FALSE, Finding, expect
from program import Run

IMPACTS = 300


def frequency(quick):
    """Figure 16 with W = 20 pi, and the same with W = 1/1000 and lengths seven times as long: the same events."""
    fast = Run("scenes/figure-16.toml", "--impacts", str(IMPACTS))
    slow = Run("validation/paper/scenes/figure-16-slow.toml", "--impacts", str(IMPACTS))
    for (wall, th, v), (other_wall, other_th, other_v) in zip(fast.impacts, slow.impacts, strict=True):
        expect(wall == other_wall and th.overlaps(other_th) and v.overlaps(other_v), "the same scaled impacts")
        expect(max(th.rad(), v.rad(), other_th.rad(), other_v.rad()) < 1e-7, "narrow enough to tell")
    return [Finding("figure 16 is chaotic because of its high frequency", FALSE,
                    f"W = 20 pi and W = 1/1000: the same {IMPACTS} walls, W t + tau and v/(A W) to 9 digits")]


CLAIMS = {"frequency": frequency}
