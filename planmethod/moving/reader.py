"""Read a file with ``[point]``: formulas and moments, all faults at once."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import partial
from pathlib import Path

import numpy as np
from msgspec.structs import replace

from planmethod.errors import ProblemError
from planmethod.languages import translate
from planmethod.moving.motion import (
    FORMULAS,
    ROUNDOFF,
    Law,
    PointProblem,
    TimeFunction,
    Wheel,
    evaluate,
    read_formula,
)
from planmethod.problem import keys
from planmethod.problem.answers import ComputedAnswerNames, read_answers, read_published
from planmethod.problem.drive import read_row, read_scales, require_positions
from planmethod.problem.faults import Faults
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.formula import is_exact
from planmethod.problem.model import Scales
from planmethod.problem.names import listed, nearest_name_hint, short
from planmethod.problem.reader import overlay_variant, varied
from planmethod.problem.records import Published
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
    file = FileNode(Faults(), parse(text, name=name))
    return _build_problem(*overlay_variant(file, name, variant), name, name, variant)


def _build_problem(
    file: FileNode, variants: tuple[str, ...], source: str, name: str, variant: str | None
) -> PointProblem:
    problem = _read(file, name)
    if file.faults:
        raise ProblemError(source, file.faults.listed)
    return replace(problem, source_file=source, variants=variants, variant=variant)


def _read(file: FileNode, name: str) -> PointProblem:
    """Read a problem; after a fault it has other values in place of the faulty ones."""
    file.allow(TOP)
    point = file["point"]
    if "point" not in file:
        point.note("missing", hint=translate("For example: {}", _EXAMPLE))
    elif point.attempt(lambda point: point.table(_EXAMPLE)) is not None:
        point.allow(keys.MOVING)
    if not point.is_sound:
        point.is_whole = False
    if not isinstance(point.value, Mapping):
        point.value = {}
    law = point.attempt(_read_law)
    formulas = {
        key: formula
        for key in (*(FORMULAS[law] if law else ()), *(("theta",) if law is Law.ROLLING else ()))
        if (formula := point.read(key, read_formula))
    }
    if "radius" in point and law not in (Law.NATURAL, None):
        point["radius"].note("valid only with s(t)", hint="Omit it.")
    radius = point.read("radius", FileNode.length)
    wheel = point.read("wheel", _read_wheel)
    if law is Law.ROLLING and wheel is not None and bool(wheel.arm) != ("theta" in point):
        phrase = "theta requires wheel.arm: the rotation of the carrier and its length"
        hint = 'wheel = { arm = 0.05, ... } and theta = "4*t", or neither.'
        point["theta"].note(phrase, hint=hint)
    elif "theta" in point and law not in (Law.ROLLING, None):
        point["theta"].note("valid only with a wheel", hint="Omit it.")
    show = point.read("show", _read_show)
    if "t" not in point and law:
        point.note_missing("t", "Give the moment, s: t = 0; or { from, to, step }.")
    times = point.read("t", _read_times) or ()
    published = partial(_read_published, moments=len(times))
    return PointProblem(
        name=name,
        **read_head(file),
        law=law or Law.COORDINATES,
        formulas=formulas,
        radius=radius,
        wheel=wheel,
        times=times,
        blur=_blur(times, rounded=_has_formula(point["t"].value)),
        show=show,
        scales=file.read("scales", read_scales) or Scales(),
        published=file.read("published", published) or (),
        answers=read_answers(file, _scene(len(times))),
    )


def _read_law(node: FileNode) -> Law | None:
    """Return the form in which the motion is stated, by its keys; None after a fault."""
    given = set(node.value) - {"phi"} if "wheel" in node or "r" in node else set(node.value)
    found = [law for law, wanted in FORMULAS.items() if any(key in given for key in wanted)]
    if "wheel" in node:
        found = [Law.ROLLING, *(law for law in found if law is not Law.ROLLING)]
    elif Law.ROLLING in found:
        found.remove(Law.ROLLING)
    if len(found) > 1:
        both = translate(" and ").join(f"{', '.join(FORMULAS[law])}" for law in found)
        node.reject("the motion is stated twice: {}", both, hint="Keep one of them.")
    if not found:
        if node.is_whole:
            ways = "expected x and y, r and phi, or s, or a wheel and phi"
            node.note(ways, hint=translate("For example: {}", _EXAMPLE))
        return None
    for key in FORMULAS[found[0]]:
        if key not in node:
            hint = translate('A formula of t: {} = "4*t*(1 + t/2)".', key)
            node.note_missing(key, hint)
    return found[0]


def _read_wheel(node: FileNode) -> Wheel:
    """Read a rolling wheel."""
    node.table("wheel = { radius = 0.5, r = 0.3, angle = -90 }")
    node.allow(keys.ROLLING)
    sizes = ("radius", "r", "on", "within", "arm")
    lengths = {key: node.read(key, FileNode.length) for key in sizes}
    angle = node.read("angle", FileNode.angle, 0.0)
    if "radius" not in node and node.is_sound:
        node["radius"].note("missing", hint="The radius of the wheel, m: radius = 0.5")
    tracks = [key for key in ("on", "within", "arm") if key in node]
    if len(tracks) > 1:
        both = translate(" and ").join(tracks)
        node[tracks[-1]].note("{} are both given", both, hint="Keep one of them.")
    radius, within = lengths["radius"], lengths["within"]
    if radius and within and within <= radius * (1 + 1e-9):
        message = "a circle of {:g} m is too small for a wheel of {:g} m"
        hint = "It must be larger than the wheel."
        node["within"].note(message, within, radius, hint=hint)
    node.require_sound()
    radius, track = needed(radius), lengths["on"] or -(within or 0.0)
    return Wheel(radius, lengths["r"] or radius, needed(angle), track, lengths["arm"] or 0.0)


def _read_show(node: FileNode) -> tuple[float, float]:
    """Read the interval that is drawn."""
    node.array("[from, to], s", "For example: [0, 2].", low=2, high=2)
    start, end = node.read_all(_read_time)
    if not end - start > 1e-9 * max(abs(start), abs(end)):
        hint = "Give the earlier moment first."
        node.reject("{:g} s is not after {:g} s", end, start, hint=hint)
    return start, end


# Moments ----------------------------------------------------------------------------------------


def _has_formula(value: object) -> bool:
    if isinstance(value, (list, Mapping)):
        return any(map(_has_formula, value.values() if isinstance(value, Mapping) else value))
    return isinstance(value, str)


def _blur(times: tuple[float, ...], *, rounded: bool) -> tuple[float, ...]:
    """Return the relative errors of moments; ``rounded`` where they are of formulas."""
    return tuple(0.0 if not rounded and is_exact(repr(t)) else 8 * ROUNDOFF for t in times)


def _read_times(node: FileNode) -> tuple[float, ...]:
    """Read one moment, a list of them, or a row."""
    if isinstance(node.value, list):
        if not node.value:
            node.reject("expected at least one moment, got an empty list")
        require_positions(node, len(node.value))
    if not isinstance(node.value, Mapping):
        return node.read_one_or_all(_read_time)
    node.allow(keys.SPAN)
    node.require_sound()
    if set(node.value) not in ({"from", "to", "count"}, {"from", "to", "step"}):
        ways = "{ from, to, step } or { from, to, count }"
        node.reject("expected {}, got {{ {} }}", ways, listed(node.value))
    return read_row(node, _read_time, _read_time)


def _read_time(node: FileNode) -> float:
    """Read a moment, s: a number, or a formula without t."""
    number = node
    if isinstance(node.value, str):
        number = node.with_value(_number_of(read_formula(node, constant=True)))
        if not math.isfinite(number.value):
            node.reject("'{}' has no value", short(node.value))
    return number.number("a moment in seconds", -1e6, 1e6, hint="Seconds.")


def _number_of(formula: TimeFunction) -> float:
    return float(evaluate(formula, np.zeros(1)).value.value[0])


# Printed values ---------------------------------------------------------------------------------


def _read_published(node: FileNode, moments: int) -> tuple[Published, ...]:
    """Read ``[published]``; its ``what`` names columns of the record."""

    def check(quantity: FileNode, _: str) -> str:
        return _read_column(quantity) if quantity.value else ""

    found = read_published(node, check, positions=moments)
    for item in found:
        if item.what and moments > 1 and item.position is None:
            hint = translate("There are {} moments: from 0.", moments)
            node[item.name]["position"].note("missing", hint=hint)
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


def _read_column(node: FileNode) -> str:
    name = node.unmask(node.value)
    if name not in QUANTITY_COLUMNS:
        hint = translate("Known here: {}.", listed(QUANTITY_COLUMNS, limit=20))
        hint = nearest_name_hint(name, QUANTITY_COLUMNS, hint)
        node.reject("a moving point has no '{}'", short(name), hint=hint)
    return QUANTITY_COLUMNS[name]
