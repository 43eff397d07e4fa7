"""Scenes at random: one to three harmonics, starts on either wall or inside the gap, all restitutions."""
import json
import math
import random


def scene(seeded):
    """The text of a scene, and the options of `run`."""
    def number(low, high):
        return f"{math.exp(seeded.uniform(math.log(low), math.log(high))):.{seeded.choice((2, 4, 6))}g}"

    count = seeded.choice((1, 1, 1, 2, 3))
    amplitude, frequency = [number(0.1, 10) for _ in range(count)], [number(0.3, 30) for _ in range(count)]
    phase = [f"{seeded.uniform(-4, 4):.4f}" for _ in range(count)]
    gap, restitution = number(0.2, 60), seeded.choice(("0", "1", "0.5", "0.9", f"{seeded.random():.3f}"))
    if seeded.random() < 0.3:
        start = f'position = "{float(gap) * seeded.uniform(-0.49, 0.49):.5f}"\nvelocity = {seeded.uniform(-30, 30):.3f}'
    else:
        wall, speed = seeded.choice(("left", "right")), seeded.choice((0, 1, 1, 1)) * seeded.uniform(0, 60)
        start = f'wall = "{wall}"\nvelocity = {-speed if wall == "left" else speed:.3f}'
    text = (f"[excitation]\namplitude = {json.dumps(amplitude)}\nfrequency = {json.dumps(frequency)}\nphase = {json.dumps(phase)}\n"
            f'[pair]\ngap = "{gap}"\nrestitution = "{restitution}"\n[start]\ntime = {seeded.uniform(-5, 5):.3f}\n{start}\n')
    options = ["--impacts", str(seeded.choice((1, 5, 20, 40)))] if seeded.random() < 0.7 else ["--until", f"{seeded.uniform(0, 20):.3f}"]
    return text, options


def at_random(count):
    """So many scenes with their options, from a fixed seed."""
    seeded = random.Random(36)
    return [scene(seeded) for _ in range(count)]
