"""Datasets of xarray by the conventions of CF: coordinates with bounds, data with their lower and upper bounds beside them, flags."""

from __future__ import annotations

import json
import os
import shutil
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from .bounds import middles
from .errors import MissingPackageError

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from .bounds import Doubles
    from .orbit import Orbit
    from .sweep import SweepResult

#: Of a wall: no impact, or the side of it.
WALLS = ((-1, 0, 1), ("left", "none", "right"))
#: Bounds of the results of a point of a sweep, with their units.
RESULTS = {
    "impacts_per_cycle": "impacts per forcing period",
    "exponent": "Lyapunov exponent per impact over the listed impacts [nats]",
    "exponent_per_cycle": "Lyapunov exponent per forcing period over the listed impacts [nats]",
    "exponent_limit": "Lyapunov exponent per impact of the orbit that attracts [nats]",
}
#: Whole numbers of a point, which may have none.
COUNTS = {
    "impacts": "impacts that are certified",
    "bits": "greatest precision [bits]",
    "period_impacts": "listed impacts in a period",
    "period_cycles": "forcing periods in a period",
    "attracted_from": "impact from which on the orbit is near the one that attracts",
}
Variable = tuple[Any, Any, dict[str, Any]]


def needed(name: str, extra: str) -> Any:
    """Return an optional package.

    Raises
    ------
    MissingPackageError
        When it is not installed.

    """
    try:
        return import_module(name)
    except ImportError as missing:
        said = f"{name} is not installed, but this needs it: pip install {name}, or impact-pair[{extra}]"
        raise MissingPackageError(said, name) from missing


def coordinate(name: str, dims: Sequence[str], bounds: Doubles, said: str) -> dict[str, Variable]:
    """Return a coordinate, the middles of bounds (n, 2), and its bounds."""
    attributes = {"long_name": said, "units": "1", "bounds": f"{name}_bnds"}
    return {name: (dims, middles(bounds), attributes), f"{name}_bnds": ([*dims, "bnds"], bounds, {})}


def data(name: str, dims: Sequence[str], bounds: Doubles, said: str) -> dict[str, Variable]:
    """Return data, the middles of bounds of the shape of ``dims`` and 2, and its lower and upper bounds."""
    shape = bounds.shape[:-1]
    ends = {f"{name}_{end}": bounds[..., i] for i, end in enumerate(("lower", "upper"))}
    attributes = {"long_name": said, "units": "1", "ancillary_variables": " ".join(ends)}
    named = {end: (dims, column, {"long_name": f"{said}: {end.split('_')[-1]} bound", "units": "1"}) for end, column in ends.items()}
    return {name: (dims, middles(bounds.reshape(-1, 2)).reshape(shape), attributes)} | named


def flags(dims: Sequence[str], values: Any, numbers: Sequence[int], meanings: Sequence[str], said: str) -> Variable:
    """Return numbers with their meanings."""
    named = {"flag_values": np.array(numbers, dtype=np.int8), "flag_meanings": " ".join(meanings)}
    return dims, np.asarray(values, dtype=np.int8), {"long_name": said} | named


def numbers(column: Any) -> Doubles:
    """Return whole numbers as doubles, NaN where there is none."""
    return np.array([np.nan if value is None else value for value in column], dtype=np.float64)


def orbit(found: Orbit, names_of_events: Sequence[str]) -> Any:
    """Return the dataset of an orbit: see its ``to_xarray``."""
    xr = needed("xarray", "xarray")
    dims = ["impact"]
    at = coordinate("time", dims, found.t_bounds, "time of the impact, in the unit of the scene")
    named = data("velocity", dims, found.v_bounds, "y' just before the impact, in the units of the scene")
    named["wall"] = flags(dims, found.sides, *WALLS, "wall of the impact")
    names = ("none", "P1", "P2", "P3", "P4")
    named["mapping"] = flags(dims, [names.index(mapping or "none") for mapping in found.mappings], range(5), names, "mapping to the impact")
    all_events = ["event"]
    at |= coordinate("event_time", all_events, found.event_bounds, "time of the event, in the unit of the scene")
    kinds = [names_of_events.index(kind) for kind in found.event_kinds]
    named["event_kind"] = flags(all_events, kinds, range(len(names_of_events)), names_of_events, "kind of the event")
    named["event_wall"] = flags(all_events, found.event_sides, *WALLS, "wall of the event")
    about = {"scene": found.scene, "outcome": found.outcome.fields, "arithmetic": found.arithmetic}
    encoded = {key: json.dumps(value, ensure_ascii=False) for key, value in about.items()}
    attributes = {"Conventions": "CF-1.11", "certified": int(found.certified), "claim": found.claim, **encoded}
    numbered = {"impact": (dims, np.arange(1, len(found) + 1), {"long_name": "number of the impact", "units": "1"})}
    return xr.Dataset(named, numbered | at, attributes)


def sweep(found: SweepResult) -> Any:
    """Return the dataset of a sweep: see its ``to_xarray``."""
    xr = needed("xarray", "xarray")
    head, points = found.head, found.to_dict("points")
    keys = [over["key"].replace(".", "_") for over in head["over"]]
    counts = [over["count"] for over in head["over"]]
    at: dict[str, Variable] = {}
    for i, key in enumerate(keys):
        # The first point with each value: of two keys the second one varies faster.
        first = [[n if i == j else 0 for j in range(len(counts))] for n in range(counts[i])]
        rows = np.ravel_multi_index(np.transpose(first), counts)
        at |= coordinate(key, [key], np.stack([points[f"{key}_{end}"][rows] for end in ("lower", "upper")], -1), key)
    named: dict[str, Variable] = {}
    for name, said in RESULTS.items():
        bounds = np.stack([points[f"{name}_{end}"] for end in ("lower", "upper")], -1)
        named |= data(name, keys, bounds.reshape(*counts, 2), said)
    for name, said in COUNTS.items():
        named[name] = (keys, numbers(points[name]).reshape(counts), {"long_name": said, "units": "1"})
    kinds = sorted(set(points["outcome"]))
    outcomes = np.array([kinds.index(kind) for kind in points["outcome"]]).reshape(counts)
    named["outcome"] = flags(keys, outcomes, range(len(kinds)), kinds, "what becomes of the motion")
    named["complete"] = flags(keys, points["complete"].astype(bool).reshape(counts), (0, 1), ("no", "yes"), "certified as requested")
    words = np.array([word or "" for word in points["word"]]).reshape(counts)
    named["word"] = (keys, words, {"long_name": "word of the orbit that attracts"})
    if not head["summary"]:
        named |= states(found, keys, counts)
    return xr.Dataset(
        named, at, {"Conventions": "CF-1.11", "certified": int(found.certified), "head": json.dumps(head, ensure_ascii=False)}
    )


def states(found: SweepResult, keys: list[str], counts: list[int]) -> dict[str, Variable]:
    """Return the impacts after the transients on the grid, NaN where a point has fewer."""
    rows, most = found.states, found.head["impacts"]
    points = np.asarray(rows["point"], dtype=np.int64)
    # The rows of a point follow one another.
    numbered = np.arange(len(points)) - np.searchsorted(points, points)
    dims, shape = [*keys, "state"], (*counts, most)
    named: dict[str, Variable] = {}
    for name, said in {"phase": "W t + tau modulo 2 pi at the impact [rad]", "velocity": "y' just before the impact"}.items():
        bounds = np.full((found.points, most, 2), np.nan)
        bounds[points, numbered] = rows[name]
        named |= data(name, dims, bounds.reshape(*shape, 2), said)
    walls = np.zeros((found.points, most), dtype=np.int8)
    walls[points, numbered] = np.where(rows["wall"] == "left", -1, 1)
    return named | {"wall": flags(dims, walls.reshape(shape), *WALLS, "wall of the impact")}


def save(dataset: Any, path: Path) -> None:
    """Write a dataset as NetCDF 4 (.nc) or as a folder of Zarr (.zarr); it is there whole, or as it was."""
    draft = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        if path.suffix.lower() == ".zarr":
            needed("zarr", "xarray")
            dataset.to_zarr(draft, mode="w", zarr_format=2)
            shutil.rmtree(path, ignore_errors=True)
        else:
            needed("netCDF4", "xarray")
            dataset.to_netcdf(draft, engine="netcdf4")
        draft.replace(path)
    finally:
        shutil.rmtree(draft, ignore_errors=True)
        draft.unlink(missing_ok=True)
