"""Read a file with ``[point]``: formulas and moments, all faults at once."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from msgspec.structs import replace

from planmethod.errors import ProblemError
from planmethod.languages import translate
from planmethod.moving.model import FORMULAS, Law, PointProblem, TimeFunction, Wheel, read_formula
from planmethod.moving.series import ROUNDOFF, evaluate
from planmethod.problem import fields, keys
from planmethod.problem.answers import ComputedAnswerNames, read_answers
from planmethod.problem.common import Published
from planmethod.problem.drive import exceeds_position_limit, read_scales, spread
from planmethod.problem.fields import Faults
from planmethod.problem.formula import is_exact
from planmethod.problem.names import listed, nearest_name_hint, segment, short
from planmethod.problem.reader import overlay_variant, varied
from planmethod.problem.selector import read_published
from planmethod.problem.sheet import read_head
from planmethod.problem.source import parse

TOP = (
    "title", "source", "point", "scales", "stamp", "sheet", "published", "answers", "compare",
    "variants",
)  # fmt: skip
"""Keys of a file with a moving point."""

QUANTITY_COLUMNS: Mapping[str, str] = {
    **{name: name for name in ("x", "y", "vx", "vy", "v", "ax", "ay", "a", "rho")},
    **dict.fromkeys(("a_tangential", "a_tau", "at"), "a_tangential"),
    **dict.fromkeys(("a_normal", "a_n", "an"), "a_normal"),
}
"""Words of ``what`` in ``[published]``, and the columns of the record that they name."""

_LETTERS = {"ρ": "rho", "a_τ": "a_tau", "aτ": "a_tau", "a^τ": "a_tau", "at": "a_tau", "an": "a_n"}

_EXAMPLE = '[point] x = "3*t*exp(t/2)", y = "4*t*(1 + t/2)", t = 0'


def column_of(name: str) -> str | None:
    """Return the column of the record that a name means, as people write it; None of no such."""
    bare = "".join(name.split()).translate(str.maketrans("ₓᵧₙ", "xyn", "{}"))
    bare = _LETTERS.get(bare, bare)
    return QUANTITY_COLUMNS.get(bare) or QUANTITY_COLUMNS.get(bare.replace("_", ""))


def load(path: str | Path, *, variant: str | None = None) -> PointProblem:
    """Read a file with ``[point]``.

    Raises
    ------
    ProblemError
        With every fault of the file.
    """
    path = Path(path)
    return _build_problem(*varied(path, variant), str(path), path.stem, variant)


def loads(text: str, *, name: str, variant: str | None = None) -> PointProblem:
    """Read a moving point from a text."""
    faults = Faults()
    table, variants = overlay_variant(faults, parse(text, name=name), name, variant)
    return _build_problem(table, variants, faults, name, name, variant)


def _build_problem(
    table: Mapping[str, Any],
    variants: tuple[str, ...],
    faults: Faults,
    source: str,
    name: str,
    variant: str | None,
) -> PointProblem:
    problem = _read(faults, table, name)
    if faults or problem is None:
        raise ProblemError(source, faults.listed)
    return replace(problem, source_file=source, variants=variants, variant=variant)


def _read(faults: Faults, table: Mapping[str, Any], name: str) -> PointProblem | None:
    given = fields.read_keys(faults, "", table, TOP)
    if "point" not in given:
        faults.add("point", "missing", translate("For example: {}", _EXAMPLE))
    told = fields.read_table(faults, "point", given.get("point", {}), _EXAMPLE)
    before = len(faults)
    point = fields.read_keys(faults, "point", told or {}, keys.MOVING)
    is_whole = len(faults) == before and told is not None and "point" in given
    law = _read_law(faults, point, is_complete=is_whole)
    formulas = {
        key: formula
        for key in (*(FORMULAS[law] if law else ()), *(("theta",) if law is Law.ROLLING else ()))
        if key in point and (formula := read_formula(faults, f"point.{key}", point[key]))
    }
    radius = None
    if "radius" in point:
        if law not in (Law.NATURAL, None):
            faults.add("point.radius", "goes with s(t) only", "Leave it out.")
        radius = fields.read_length(faults, "point.radius", point["radius"])
    wheel = _read_wheel(faults, point["wheel"]) if "wheel" in point else None
    if law is Law.ROLLING and wheel is not None and bool(wheel.arm) != ("theta" in point):
        phrase = "theta goes with wheel.arm: the carrier's turn and its length"
        faults.add(
            "point.theta", phrase, 'wheel = { arm = 0.05, ... } and theta = "4*t", or neither.'
        )
    elif "theta" in point and law not in (Law.ROLLING, None):
        faults.add("point.theta", "goes with a wheel only", "Leave it out.")
    show = _read_show(faults, point["show"]) if "show" in point else None
    times: tuple[float, ...] = ()
    if "t" in point:
        times = _read_times(faults, point["t"])
    elif is_whole and law:
        faults.add("point.t", "missing", "Give the moment, s: t = 0; or { from, to, step }.")
    problem = PointProblem(
        name=name,
        **read_head(faults, given),
        law=law or Law.COORDINATES,
        formulas=formulas,
        radius=radius,
        wheel=wheel,
        times=times,
        blur=_blur(times, rounded=_has_formula(point.get("t"))),
        show=show,
        scales=read_scales(faults, given.get("scales", {})),
        published=_read_published(faults, given.get("published", {}), len(times)),
        answers=read_answers(faults, given, _scene(len(times))),
    )
    return None if faults else problem


def _read_law(faults: Faults, point: Mapping[str, Any], *, is_complete: bool) -> Law | None:
    """Return the form in which the motion is stated, by its keys."""
    told = set(point) - {"phi"} if {"wheel", "r"} & set(point) else set(point)
    found = [law for law, wanted in FORMULAS.items() if any(key in told for key in wanted)]
    if "wheel" in point:
        found = [Law.ROLLING, *(law for law in found if law is not Law.ROLLING)]
    elif Law.ROLLING in found:
        found.remove(Law.ROLLING)
    if len(found) > 1:
        both = translate(" and ").join(f"{', '.join(FORMULAS[law])}" for law in found)
        faults.add("point", translate("the motion is stated twice: {}", both), "Keep one of them.")
        return None
    if not found:
        if is_complete:
            ways = "expected x and y, r and phi, or s, or a wheel and phi"
            faults.add("point", ways, translate("For example: {}", _EXAMPLE))
        return None
    for key in FORMULAS[found[0]]:
        if key not in point and is_complete:
            faults.add(
                f"point.{key}", "missing", translate('A formula of t: {} = "4*t*(1 + t/2)".', key)
            )
    return found[0]


def _read_wheel(faults: Faults, value: object) -> Wheel | None:
    """Read a rolling wheel; None after noting a fault."""
    path, before = "point.wheel", len(faults)
    told = fields.read_table(faults, path, value, "wheel = { radius = 0.5, r = 0.3, angle = -90 }")
    given = fields.read_keys(faults, path, told or {}, keys.ROLLING)
    lengths = {
        key: fields.read_length(faults, f"{path}.{key}", given[key])
        for key in ("radius", "r", "on", "within", "arm")
        if key in given
    }
    angle = fields.read_angle(faults, f"{path}.angle", given.get("angle", 0.0))
    if told is not None and "radius" not in given and len(faults) == before:
        faults.add(f"{path}.radius", "missing", "The radius of the wheel, m: radius = 0.5")
    tracks = [key for key in ("on", "within", "arm") if key in given]
    if len(tracks) > 1:
        both = translate(" and ").join(tracks)
        faults.add(
            f"{path}.{tracks[-1]}", translate("{} are both given", both), "Keep one of them."
        )
    radius, within = lengths.get("radius"), lengths.get("within")
    if radius and within and within <= radius * (1 + 1e-9):
        phrase = translate("a circle of {:g} m has no room for a wheel of {:g} m", within, radius)
        faults.add(f"{path}.within", phrase, "It must be larger than the wheel.")
    if len(faults) != before or radius is None or angle is None:
        return None
    track, arm = lengths.get("on") or -(within or 0.0), lengths.get("arm") or 0.0
    return Wheel(radius, lengths.get("r") or radius, angle, track, arm)


def _read_show(faults: Faults, value: object) -> tuple[float, float] | None:
    """Read the interval that is drawn; None after noting a fault."""
    path = "point.show"
    if not isinstance(value, list) or len(value) != 2:
        faults.expected(path, "[from, to], s", value, "For example: [0, 2].")
        return None
    start, end = (_read_time(faults, f"{path}[{k}]", item) for k, item in enumerate(value))
    if start is None or end is None:
        return None
    if not end - start > 1e-9 * max(abs(start), abs(end)):
        faults.add(
            path,
            translate("{:g} s is not after {:g} s", end, start),
            "Give the earlier moment first.",
        )
        return None
    return start, end


# Moments ----------------------------------------------------------------------------------------


def _has_formula(value: object) -> bool:
    if isinstance(value, (list, Mapping)):
        return any(map(_has_formula, value.values() if isinstance(value, Mapping) else value))
    return isinstance(value, str)


def _blur(times: tuple[float, ...], *, rounded: bool) -> tuple[float, ...]:
    """Return the relative errors of moments; ``rounded`` where they are of formulas."""
    return tuple(0.0 if not rounded and is_exact(repr(t)) else 8 * ROUNDOFF for t in times)


def _read_times(faults: Faults, value: object) -> tuple[float, ...]:
    """Read one moment, a list of them, or a row; none after noting a fault."""
    path = "point.t"
    before = len(faults)
    if isinstance(value, list):
        if not value:
            faults.add(path, "expected at least one moment, got an empty list")
        elif not exceeds_position_limit(faults, path, len(value)):
            read = [_read_time(faults, f"{path}[{i}]", item) for i, item in enumerate(value)]
            return () if len(faults) != before else tuple(item for item in read if item is not None)
        return ()
    if not isinstance(value, Mapping):
        one = _read_time(faults, path, value)
        return () if one is None else (one,)
    given = fields.read_keys(faults, path, value, keys.SPAN)
    if len(faults) != before:
        return ()
    if set(given) not in ({"from", "to", "count"}, {"from", "to", "step"}):
        ways = "{ from, to, step } or { from, to, count }"
        faults.add(path, translate("expected {}, got {{ {} }}", ways, listed(given)))
        return ()
    start = _read_time(faults, f"{path}.from", given["from"])
    end = _read_time(faults, f"{path}.to", given["to"])
    if "step" in given:
        given["step"] = _read_time(faults, f"{path}.step", given["step"])
    if len(faults) != before:
        return ()
    return spread(faults, path, given, start, end) or ()


def _read_time(faults: Faults, path: str, value: object) -> float | None:
    """Read a moment, s: a number, or a formula without t."""
    number = value
    if isinstance(value, str):
        formula = read_formula(faults, path, value, constant=True)
        if formula is None:
            return None
        number = _number_of(formula)
        if not math.isfinite(number):
            faults.add(path, translate("'{}' has no value", short(value)))
            return None
    what = "a moment in seconds"
    return fields.read_number(faults, path, number, what, low=-1e6, high=1e6, hint="Seconds.")


def _number_of(formula: TimeFunction) -> float:
    return float(evaluate(formula, np.zeros(1)).value.value[0])


# Printed values ---------------------------------------------------------------------------------


def _read_published(faults: Faults, table: object, moments: int) -> tuple[Published, ...]:
    """Read ``[published]``; its ``what`` names columns of the record."""

    def check(path: str, quantity: str, _: str) -> str:
        return _column(faults, path, quantity) if quantity else ""

    found = read_published(faults, table, check, positions=moments)
    for item in found:
        if item.what and moments > 1 and item.position is None:
            path = f"published.{segment(item.name)}.position"
            faults.add(path, "missing", translate("There are {} moments: from 0.", moments))
    return found


def _scene(moments: int) -> ComputedAnswerNames:
    def fault(name: str) -> str:
        return "" if column_of(name) else translate("a moving point has no '{}'", short(name))

    return ComputedAnswerNames(
        fault,
        lambda name: False,
        translate("Known here: {}.", listed(QUANTITY_COLUMNS, limit=20)),
        moments,
    )


def _column(faults: Faults, path: str, quantity: str) -> str:
    name = fields.unmask(faults, path, quantity)
    if name not in QUANTITY_COLUMNS:
        hint = nearest_name_hint(
            name, QUANTITY_COLUMNS, translate("Known here: {}.", listed(QUANTITY_COLUMNS, limit=20))
        )
        faults.add(path, translate("a moving point has no '{}'", short(name)), hint)
    return QUANTITY_COLUMNS.get(name, "")
