#!/usr/bin/env python3
"""Draws docs/idea.svg, the README's picture: the first certified impacts of figure 14 and what proves one of them.

    python3 docs/idea.py > docs/idea.svg

Impacts are read from `impact-pair run scenes/figure-14.toml`; between them the motion is equation (11).
"""
import csv, io, math, subprocess
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal

A, W, D, E = 8.0, math.pi, 9.42497, 0.5
T_END, WIDTH, HEIGHT, LEFT, TOP = 4.35, 900, 330, 70, 40
PLOT_W, PLOT_H = WIDTH - LEFT - 30, HEIGHT - TOP - 60
BLUE, ORANGE, GREY = "#0072b2", "#d55e00", "#777777"
T, Y, D2 = (f'<tspan font-style="italic">{letter}</tspan>' for letter in "tyd")

command = "impact-pair run scenes/figure-14.toml --format csv --quiet".split()
rows = list(csv.DictReader(io.StringIO(subprocess.run(command, capture_output=True, text=True, check=True).stdout)))
impacts = [(0.0, "left", -12.56636, "")] + [
    (float(r["time_lower"]), r["wall"], float(r["velocity_lower"]), r["mapping"]) for r in rows
]


def x(t):
    return LEFT + PLOT_W * t / T_END


def y(displacement):
    return TOP + PLOT_H * (0.5 - displacement / D)


def flight(start, wall, before):
    """Equation (11) after an impact."""
    v, y0 = -E * before, (-D / 2 if wall == "left" else D / 2)
    c = v + A * W * math.cos(W * start)
    return lambda t: -A * math.sin(W * t) + c * (t - start) + A * math.sin(W * start) + y0


def curve(z, start, end, pieces=12):
    """The motion as cubic Bezier segments with its velocities at their ends."""
    rate = lambda t: (z(t + 1e-5) - z(t - 1e-5)) / 2e-5
    h = (end - start) / pieces
    data = f"M{x(start):.1f} {y(z(start)):.1f}"
    for a, b in ((start + i * h, start + (i + 1) * h) for i in range(pieces)):
        knots = ((a + h / 3, z(a) + h / 3 * rate(a)), (b - h / 3, z(b) - h / 3 * rate(b)), (b, z(b)))
        data += "C" + " ".join(f"{x(t):.1f} {y(place):.1f}" for t, place in knots)
    return data


def mapping_name(name):
    return f'<tspan font-style="italic">{name[0]}</tspan><tspan dy="3" font-size="10">{name[1]}</tspan>'


out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="13">']
out.append(f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>')
for level, name in ((D / 2, "right wall"), (-D / 2, "left wall")):
    out.append(f'<line x1="{LEFT}" x2="{LEFT + PLOT_W}" y1="{y(level):.1f}" y2="{y(level):.1f}" stroke="black" stroke-width="3"/>')
    out.append(f'<text x="{LEFT - 6}" y="{y(level) + 4:.1f}" text-anchor="end">{name}</text>')
for t in range(5):
    out.append(f'<line x1="{x(t):.1f}" x2="{x(t):.1f}" y1="{TOP}" y2="{TOP + PLOT_H}" stroke="#ddd"/>')
    out.append(f'<text x="{x(t):.1f}" y="{TOP + PLOT_H + 20}" text-anchor="middle" fill="{GREY}">{t}</text>')
out.append(f'<text x="{LEFT + PLOT_W}" y="{TOP + PLOT_H + 38}" text-anchor="end" fill="{GREY}">time {T} (two units are a period of the shaker); relative displacement {Y} upwards</text>')
for (t0, wall, before, _), (t1, *_) in zip(impacts, impacts[1:]):
    if t0 > T_END:
        break
    z = flight(t0, wall, before)
    end = min(t1, T_END)
    out.append(f'<path fill="none" stroke="{BLUE}" stroke-width="2" d="{curve(z, t0, end)}"/>')
for i, (t, wall, _, mapping) in enumerate(impacts[1:], 1):
    if t > T_END:
        break
    level = D / 2 if wall == "right" else -D / 2
    out.append(f'<rect x="{x(t) - 4:.1f}" y="{y(level) - 4:.1f}" width="8" height="8" fill="{ORANGE}"/>')
    shift = -12 if wall == "right" else 20
    out.append(f'<text x="{x(t):.1f}" y="{y(level) + shift:.1f}" text-anchor="middle">{i}: {mapping_name(mapping)}</text>')
# The flight from impact 1 to impact 2 turns twice; the second time it nearly returns to the right wall.
(t1, wall, before, _), (t2, *_) = impacts[1], impacts[2]
z = flight(t1, wall, before)
grid = [t1 + (t2 - t1) * i / 1000 for i in range(1001)]
for a, b, c in zip(grid, grid[1:], grid[2:]):
    if (z(b) - z(a)) * (z(c) - z(b)) < 0:
        out.append(f'<circle cx="{x(b):.1f}" cy="{y(z(b)):.1f}" r="5" fill="none" stroke="{ORANGE}" stroke-width="2"/>')
note = (x(0.52), y(0.05 * D))
out.append(f'<text x="{note[0]:.1f}" y="{note[1]:.1f}">both extrema are proved</text>')
out.append(f'<text x="{note[0]:.1f}" y="{note[1] + 17:.1f}">to lie inside the gap:</text>')
out.append(f'<text x="{note[0]:.1f}" y="{note[1] + 34:.1f}">no contact before 2</text>')
places = Decimal("1e-14")
low = Decimal(rows[1]["time_lower"]).quantize(places, ROUND_FLOOR)
high = Decimal(rows[1]["time_upper"]).quantize(places, ROUND_CEILING)
out.append(f'<text x="{x(1.82):.1f}" y="{y(-D / 2) - 27:.1f}">2 lies in [{low}, &#8230;{str(high)[-3:]}]:</text>')
out.append(f'<text x="{x(1.82):.1f}" y="{y(-D / 2) - 10:.1f}">{Y} + {D2}/2 changes sign on it, {Y}&#8242; does not</text>')
out.append("</svg>")
print("\n".join(out))
