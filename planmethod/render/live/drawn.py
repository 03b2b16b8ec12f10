"""A mechanism as the drawing room of the studio moves it by hand: plain data (модель для правки).

Numbers are SI and degrees. What a number of the file means, and which numbers of the tape follow
from it, is given for each, so that the page computes every pose without a server.
"""

# no messages: codes of JSON

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from planmethod.construct.steps import Name, PointName
from planmethod.note.narrate.naming import point_name
from planmethod.note.wording import Language
from planmethod.plans.model import RATES, Start, Turns
from planmethod.problem.model import Body, Problem
from planmethod.problem.names import UNITS, split_names
from planmethod.problem.parameters import Key, Parameter, Parameters
from planmethod.render.live.document import runs
from planmethod.render.live.scene import LiveView, plan_view, reasons_of
from planmethod.solved.many.sweep import DraggedTape, Sweep
from planmethod.solved.many.variants import SIDE
from planmethod.solved.solution import Solution
from planmethod.solved.turn.determined import pose


def drawn_model(solution: Solution, language: Language) -> dict[str, Any]:
    """Return the model of a mechanism that can be assembled.

    Parameters
    ----------
    solution : Solution
        In the positions of the file that exist.
    language : Language
        Of its texts.

    Returns
    -------
    dict
        Where a cam or another driver also gives inputs, ``no_tape`` says which and ``places``
        has the points of the first position, in place of ``tape``.
    """
    problem = solution.problem
    names: dict[Name, int] = {}
    construction = solution.construction

    def ref(name: Name) -> list[int]:
        return [2 * names.setdefault(name, len(names))]

    plans = [plan_view(construction, kind, language, ref) for kind in RATES]
    offered = list(Sweep(problem, ["positions"]).parameters)
    sweep = Sweep(problem, varied=offered, drawn=tuple(names))
    dragged = sweep.dragged()
    count = len(sweep.rows) - 2 * len(names)
    first = float(solution.positions[0])
    return (
        {
            "unit": problem.unit,
            "per": UNITS[problem.unit],
            "driver": _driver(problem, first),
            "order": [*construction.draft.marked],
            "rows": [row.name for row in sweep.rows],
            "views": [_view(view, count, language) for view in plans],
            "reasons": [runs(text) for text in reasons_of(sweep, language, dragged.guards)],
            "groups": [
                {"links": list(group.links), "class": group.class_number, "kind": group.kind}
                for group in construction.structure.groups
            ],
        }
        | numbers_of(problem, dragged)
        | _tape(dragged, solution)
    )


def numbers_of(problem: Problem, dragged: DraggedTape) -> dict[str, Any]:
    """Return the numbers of a file, and the inputs of its tape that follow from them.

    These inputs are between the driver's coordinate and those that differ from position to
    position.
    """
    constants = dragged.case.constants
    return {
        "links": {
            link: {name: _pair(place) for name, place in body.points.items()}
            for link, body in problem.bodies.items()
        },
        "slides": [_slide(problem, link) for link in problem.slides],
        "parameters": [
            _parameter(problem, one, dragged)
            for one in Parameters(problem, pose).by_name.values()
            if one.name in dragged.slopes
        ],
        "inputs": [
            {"name": name, "value": _number(constants[name])}
            | ({"side": name.removeprefix(SIDE)} if name.startswith(SIDE) else {})
            for name in dragged.free
        ],
    }


def _tape(dragged: DraggedTape, solution: Solution) -> dict[str, Any]:
    """Return the tape and its inputs."""
    branches = dragged.case.results.draft.branches
    if set(dragged.inputs) - set(branches):
        marked = solution.construction.draft.marked
        return {
            "no_tape": "drivers" if solution.problem.drive.cam_drive is None else "cam",
            "places": {str(name): _pair(solution.place(PointName(name))[0]) for name in marked},
        }
    return {
        "tape": dragged.runner.registers(),
        "branches": [
            {"places": one.tracked.places, "values": one.values, "turn": one.tracked.period}
            if isinstance(one, Start)
            else {"jumps": one.places, "counts": one.counts, "low": one.low,
                  "turn": one.period, "net": one.per_period}
            if isinstance(one, Turns)
            else {"changes": list(one.changes), "start": one.start, "turn": one.period}
            for one in branches.values()
        ],
    }  # fmt: skip


def _pair(place: complex) -> list[float]:
    return [place.real, place.imag]


def _number(value: complex | float) -> float | list[float]:
    return _pair(value) if isinstance(value, complex) else float(value)


def _slide(problem: Problem, link: str) -> dict[str, Any]:
    slide = problem.slides[link]
    return {
        "slider": slide.slider, "host": slide.host, "pin": slide.pin, "label": slide.label,
        "base": _pair(slide.base), "angle": slide.angle, "offset": slide.offset,
        "through": slide.through, "towards": slide.towards,
    }  # fmt: skip


def _driver(problem: Problem, first: float) -> dict[str, Any]:
    drive = problem.drive
    given = problem.source_table.get("driver")
    value = given.get(drive.coordinate.name) if isinstance(given, Mapping) else None
    return {
        "link": drive.link,
        "pivot": drive.pivot,
        "coordinate": drive.coordinate.name,
        "crank": drive.goes_round,
        "rate": drive.rate,
        "first": first,
        "positions": [float(one) for one in drive.positions],
        "single": isinstance(value, int | float),
    }


def _view(view: LiveView, start: int, language: Language) -> dict[str, Any]:
    """Return a plan; its points count from the first output of the plans."""

    def shift(ref: list[int]) -> list[int]:
        return [ref[0] + start, *ref[1:]]

    return {
        "id": view.id,
        "title": runs(view.title),
        "unit": runs(language.notation.units[view.scale.unit]),
        "segments": [
            {k: runs(v) if k in ("name", "symbol") else v for k, v in one.items()}
            | {"a": shift(one["a"]), "b": shift(one["b"])}
            for one in view.segments
        ],
        "labels": [{"at": shift(one["at"]), "text": runs(one["text"])} for one in view.labels],
    }


# What a number of the file means -----------------------------------------------------------------


def _parameter(problem: Problem, one: Parameter, dragged: DraggedTape) -> dict[str, Any]:
    slopes = dragged.slopes.get(one.name, {})
    own = {name: slope for name, slope in slopes.items() if name in dragged.free}
    return {
        "name": one.name,
        "label": runs(point_name(one.name)) if "_" not in one.name else runs(_symbol(one.name)),
        "key": list(one.key),
        "value": one.value,
        "per": one.per,
        "means": list(meaning(problem, one.key)),
        "moves": {name: _number(slope) for name, slope in own.items()},
    }


def _symbol(name: str) -> str:
    head, _, index = name.partition("_")
    greek = {"omega": "ω", "epsilon": "ε", "angle": "∠"}
    return f"{greek.get(head, head)}_{{{index}}}"


def meaning(problem: Problem, key: Key) -> Iterator[str]:
    """Yield the kind of a number and the names that it is of."""
    match key:
        case ("frame", "guides", guide, "through", int() as axis):
            yield from ("guide", str(guide), "xy"[axis])
        case ("frame", "guides", guide, "angle"):
            yield from ("guide angle", str(guide))
        case ("frame", point, int() as axis):
            yield from ("fixed", str(point), "xy"[axis])
        case ("links", link, "slides", kind):
            yield from (f"slide {kind}", str(link))
        case ("links", link, name) if len(split_names(str(name))) == 2:
            yield from ("length", str(link), *split_names(str(name)))
        case ("links", link, point, ("at" | "across") as kind):
            yield from (kind, str(link), str(point), *_line(problem.bodies[str(link)], str(point)))
        case ("links", link, point, ("angle" | "distance") as kind):
            form = problem.bodies[str(link)].forms.get(str(point))
            if form is not None:
                yield from (f"arm {kind}", str(link), str(point), form.point, *form.line)
        case ("driver", name):
            yield from ("rate", str(name))


def _line(body: Body, point: str) -> tuple[str, ...]:
    """Return the two points of the line that a third point is counted along and across."""
    form = body.forms.get(point)
    if form is None:
        return ()
    line = form.line if all(form.line) else body.axis or ()
    start = form.point or (line[0] if line else "")
    return (start, *line)


# Which assembly was drawn ------------------------------------------------------------------------


def distance_of(solution: Solution, drawn: Mapping[str, complex]) -> float:
    """Return how far points of a solution are from drawn ones in its first position, m.

    The root of the sum of squares; infinite where none of them is in it.
    """
    marked = solution.construction.draft.marked
    own = [name for name in drawn if name in marked]
    away = [solution.place(PointName(name))[0] - drawn[name] for name in own]
    return float(np.linalg.norm(away)) if away else math.inf
