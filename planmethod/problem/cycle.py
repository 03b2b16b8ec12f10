"""The cycle that is looked at (цикл движения): ``[cycle]``."""

from __future__ import annotations

from collections.abc import Mapping

from planmethod.languages import say
from planmethod.mechanism.model import FRAME
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults
from planmethod.problem.model import Body, CycleTask, Differentiation, Drive, Slide, Zero

_EXAMPLE = '[cycle] output = "B", zero = "extreme", count = 12'
_NAMED = {zero.value: zero for zero in Zero}


def read_cycle(
    faults: Faults,
    table: object,
    bodies: Mapping[str, Body],
    slides: Mapping[str, Slide],
    drive: Drive | None,
) -> CycleTask | None:
    """Read ``[cycle]``; None after a fault.

    Parameters
    ----------
    bodies, slides : mapping
        As far as the file has them.
    drive : Drive or None
        None where it has a fault of its own.
    """
    before = len(faults)
    entries = fields.read_table(faults, "cycle", table, _EXAMPLE)
    if entries is None:
        return None
    given = fields.read_keys(faults, "cycle", entries, keys.CYCLE)
    if drive is not None and not drive.is_crank:
        faults.add(
            "cycle",
            say("the driver, link {}, slides: it has no turn", drive.link),
            "A cycle is a turn of a crank. Delete [cycle], or let a crank drive.",
        )
    output = None
    if "output" in given:
        output = _read_output(faults, given["output"], bodies, slides, drive)
    zero: Zero | float | None = Zero.EXTREME
    if fields.is_number(given.get("zero")):
        zero = fields.read_angle(faults, "cycle.zero", given["zero"])
    elif "zero" in given and isinstance(given["zero"], str):
        word = fields.read_word(faults, "cycle.zero", given["zero"], _NAMED)
        zero = None if word is None else _NAMED[word]
    elif "zero" in given:
        wanted = say(" or ").join(f'"{word}"' for word in _NAMED)
        faults.expected("cycle.zero", say("{} or an angle in degrees", wanted), given["zero"])
    count = fields.read_whole(faults, "cycle.count", given.get("count", 12), 3, keys.CYCLE_LIMIT)
    length = _read_mm(faults, "cycle.length", given.get("length", 288), 20.0, 2000.0)
    poles = fields.read_table(
        faults, "cycle.pole", given.get("pole", {}), "pole = { v = 36, a = 36 }"
    )
    poles = fields.read_keys(faults, "cycle.pole", poles or {}, keys.POLE)
    pole = [_read_mm(faults, f"cycle.pole.{key}", poles.get(key, 36), 1.0, 500.0)
            for key in keys.POLE]  # fmt: skip
    way = Differentiation.CHORDS
    if "differentiation" in given:
        ways = [one.value for one in Differentiation]
        word = fields.read_word(faults, "cycle.differentiation", given["differentiation"], ways)
        way = Differentiation(word) if word else way
    if len(faults) > before or zero is None or count is None or length is None:
        return None
    pole_v, pole_a = pole
    assert pole_v is not None and pole_a is not None
    return CycleTask(output, zero, count, length, pole_v, pole_a, way)


def _read_mm(faults: Faults, path: str, value: object, low: float, high: float) -> float | None:
    hint = "Millimetres of the diagrams."
    return fields.read_number(
        faults, path, value, "a length in millimetres", low=low, high=high, positive=True, hint=hint
    )


def _read_output(
    faults: Faults,
    value: object,
    bodies: Mapping[str, Body],
    slides: Mapping[str, Slide],
    drive: Drive | None,
) -> str | None:
    """Read the output: a link, or a point of a link that moves along a guide of the frame."""
    path = "cycle.output"
    if not isinstance(value, str):
        hint = say('Write output = "{}".', value) if isinstance(value, int) else ""
        faults.expected(path, "a point or a link", value, hint)
        return None
    moving = [link for link in bodies if link != FRAME]
    name = value if value in moving else fields.unmask(faults, path, value)
    if name in moving:
        if drive is not None and name == drive.link:
            faults.add(path, say("link {} drives", name), "The output is a link that is driven.")
            return None
        return name
    points = [point for link in moving for point in bodies[link].points]
    if name not in points:
        fields.report_unknown(
            faults, path, name, [*points, *moving], said="unknown point or link '{}'"
        )
        return None
    if guiding(name, bodies, slides) is None:
        links = [link for link in moving if name in bodies[link].points]
        faults.add(
            path,
            say("point {} moves along no guide of the frame", name),
            say("Name a point of a slider, or a link whose angle is meant: {}.", ", ".join(links)),
        )
        return None
    return name


def guiding(point: str, bodies: Mapping[str, Body], slides: Mapping[str, Slide]) -> Slide | None:
    """Return the slide on the frame of the link that a point belongs to; None without one."""
    for slide in slides.values():
        body = bodies.get(slide.slider)
        if slide.host == FRAME and body is not None and point in body.points:
            return slide
    return None
