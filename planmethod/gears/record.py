"""JSON record of a train (запись для JSON)."""

from __future__ import annotations

import math
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from planmethod.gears.comparison import PlanetaryComparison, compare
from planmethod.gears.model import GearProblem, parse
from planmethod.gears.motion import TrainMotion, analyse, draw, solve_motion, why_not_drawn
from planmethod.gears.solution import Answer, answer, conditions, named, rack_speed, sentence
from planmethod.note.records.legend import legend_record
from planmethod.note.wording import get_language
from planmethod.problem.records import KindProblem, reading_record


def record(problem: GearProblem, lang: str) -> dict[str, Any]:
    """Return one object for a problem: floats, and exact fractions as ``-375/1``.

    Raises
    ------
    ProblemError
        The train cannot be, or its inputs do not fit.
    """
    motion = solve_motion(problem)
    texts = get_language(lang).gears
    train = motion.train
    sizes = motion.axes.sizes
    radii = motion.axes.radii
    metres = {
        x: train.arms[x] if x in train.arms else radii[x] * train.unit_m
        for x in train.listed
        if x in train.arms or not train.counted(x)
    }
    told: dict[str, Any] = {
        "mobility": motion.structure.mobility,
        "kind": motion.structure.kind.value,
        "redundant": motion.structure.spatial,
        "teeth": {x: _number(size) for x, size in sizes.items() if train.counted(x)},
        "radii_m": {x: _number(size) for x, size in metres.items()},
        "modules_mm": {
            x: _number(module * 1000) for module, of in train.modules.items() for x in of
        },
        "unit": train.units[0],
        "bodies": {label: _body(motion, label) for label in train.body_of},
        "asked": {name: _answer(answer(motion, name), texts["reasons"]) for name in train.ask},
        "conditions": [
            {
                "name": one.name,
                "holds": one.is_satisfied,
                "text": sentence(one, get_language(lang)),
            }
            for one in conditions(motion)
        ],
        "picture": _diagrams_record(motion),
    }
    if (compared := compare(problem, motion)) is not None:
        told["design"] = _compared(compared)
    if told["picture"] is None:
        told["picture_reason"] = texts["no_picture"][why_not_drawn(motion)]
    told["published"] = [
        {"name": one.name, "printed": one.value, "note": one.note, "unit": one.unit}
        | _answer(answer(motion, one.what), texts["reasons"])
        for one in problem.published
    ]
    known = tuple(train.body_of)
    legend = ((x, parse(x, known).symbol, answer(motion, x).unit) for x in named(motion))
    return {**head(problem), "gears": told, "legend": legend_record(legend)}


def _compared(compared: PlanetaryComparison) -> dict[str, Any]:
    """Return the variants that the train is compared with."""
    place = compared.place
    return {
        "scheme": compared.scheme.name,
        "ratio": {"name": compared.scheme.ratio_name, "value": float(compared.ratio)},
        "found": {str(k): count for k, count in compared.set_counts.items()},
        "satellites": compared.planets,
        "place": None if place is None else place.place,
        "error": float(compared.file_set.error),
        "variants": [
            {
                "satellites": one.planets,
                "teeth": dict(zip(compared.scheme.wheels, one.chosen.teeth, strict=True)),
                "value": float(one.chosen.ratio),
                "error": float(one.chosen.error),
                "size": float(one.chosen.size),
                "size_mm": compared.diameter(one.chosen),
                "is_own": one.is_file_train,
            }
            for one in compared.variants
        ],
    }


def structure_record(problem: GearProblem) -> dict[str, Any]:
    """Return the structure of a train.

    Raises
    ------
    ProblemError
    """
    roles, _, found = analyse(problem)
    told = {
        "kind": found.kind.value,
        "mobility": found.mobility,
        "moving_links": found.moving,
        "lower_pairs": found.lower,
        "higher_pairs": found.higher,
        "chebyshev": found.formula,
        "redundant_in_plane": found.redundant,
        "redundant": found.spatial,
        "carriers": {
            carrier: {
                "central": list(roles.central[carrier]),
                "satellites": list(roles.planets[carrier]),
            }
            for carrier in problem.train.carriers
        },
        "across": sorted(roles.transverse),
    }
    return {**head(problem), "structure": told}


def head(problem: KindProblem) -> dict[str, Any]:
    """Return what an object begins with: which problem it is of."""
    return {
        "schema": 1,
        "problem": problem.name,
        "variant": problem.variant,
        "title": problem.title,
        "source": problem.source,
        **reading_record(problem),
    }


def exact_text(value: Fraction) -> str:
    """Return a fraction as JSON has it: ``-375/1``."""
    return f"{value.numerator}/{value.denominator}"


def _number(value: Fraction) -> int | float:
    return value.numerator if value.denominator == 1 else float(value)


def _body(motion: TrainMotion, label: str) -> dict[str, Any]:
    """Return the speeds of a body, absolute and relative to the carrier of its meshes."""
    speed, train = motion.speed(label), motion.train
    body = train.body_of[label]
    if body in train.racks:
        metres = rack_speed(motion, label)
        return {"n": None, "omega": None, "v": metres, "exact": exact_text(speed)}
    told = {**_speeds(train.unit, speed), "exact": exact_text(speed)}
    told["body"] = body
    relative = {
        carrier: exact_text(motion.speed(label, carrier))
        for carrier in train.carriers
        if body in (*motion.roles.central[carrier], *motion.roles.planets[carrier])
    }
    if relative:
        told["relative"] = relative
    if body in motion.roles.transverse:
        told["about_own_axis"] = True
    return told


def _speeds(unit: str, speed: Fraction) -> dict[str, float]:
    if unit == "n":
        return {"n": float(speed), "omega": float(speed) * math.pi / 30}
    return {"n": float(speed) * 30 / math.pi, "omega": float(speed)}


def _answer(result: Answer, reasons: Mapping[str, str]) -> dict[str, Any]:
    told: dict[str, Any] = {
        "value": result.value,
        "exact": None if result.exact is None else exact_text(result.exact),
    }
    if result.value is None:
        told["reason"] = reasons[result.reason].format(label=result.label)
    return told


def _diagrams_record(motion: TrainMotion) -> dict[str, Any] | None:
    picture = draw(motion)
    if picture is None:
        return None
    return {
        "mu_l": float(picture.mu_l),
        "mu_v": picture.mu_v,
        "mu_omega": picture.mu_omega,
        "pole_mm": float(picture.pole_mm),
        "contacts": [
            {
                "name": one.at.name,
                "height_mm": float(one.height_mm),
                "speed_mm": float(one.speed_mm),
            }
            for one in picture.contacts
        ],
        "rays": [{"label": label, "segment_mm": float(segment)} for label, segment in picture.rays],
    }
