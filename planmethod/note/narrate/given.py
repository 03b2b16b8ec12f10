"""The statement of a problem in symbols: what is given, what to find (Дано, Определить)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence

import numpy as np

from planmethod.mechanism.model import FRAME
from planmethod.note.document import Item, Node
from planmethod.note.formula import escape, fraction
from planmethod.note.numbers import MINUS, Notation, trimmed, with_unit
from planmethod.note.wording import Language
from planmethod.plans.legend import MOTION_KINDS, TURNINGS, Quantity, QuantityKind
from planmethod.plans.model import Relation
from planmethod.plans.motion.leads import has_slot_name, slot_name, track_direction
from planmethod.problem.head import KindProblem
from planmethod.problem.model import Body, Drive, Geared, Lifted, Posed, PosedBy, Problem, Slide
from planmethod.problem.names import UNITS, split_names
from planmethod.solved.driving import driven
from planmethod.solved.solution import Solution

NBSP = "\u00a0"


def reading_notes(problem: KindProblem, words: Language) -> Iterator[Node]:
    """Yield that the scheme is one of several that fit the data, and what the others are."""
    if problem.reading:
        yield Item(words.tasks.reading)
        if problem.other_readings:
            others = escape("; ".join(problem.other_readings))
            yield Item(words.tasks.other_readings.format(others=others))


def point_name(point: str) -> str:
    """Return a point's name as rich text: S2 gives ``S_{2}``."""
    return f"{point[:1]}_{{{point[1:]}}}" if point[1:] else point


def unbroken(facts: Sequence[str]) -> str:
    """Return facts in one line that is broken between them only."""
    return "; ".join(fact.replace(" ", NBSP) for fact in facts)


def given(problem: Problem, words: Language, positions: Sequence[float] | None = None) -> list[str]:
    """Return what is given, one ``symbol = value unit`` each.

    ``positions`` are the driver's, degrees (m for a slider); the file's when absent.
    """
    drive, text = problem.drive, As(problem, words)
    asked = drive.positions if positions is None else positions
    lines = [_position(text, asked)]
    named = {name for _, name, _ in problem.lengths}
    for link, name, metres in problem.lengths:
        centre = problem.bodies[link].arc
        if centre is not None and name == "".join(problem.bodies[link].axis or ()):
            radius = text.metres(metres, _path(link, "slides.radius"))
            said = words.note.given_arc.format(
                link=link, radius=radius, line=_line(*split_names(name))
            )
            lines.append(said)
            continue
        lines.append(f"l_{{{name}}} = {text.metres(metres, _path(link, name))}")
    for link, body in problem.bodies.items():
        if link != FRAME:
            lines += _third_points(link, body, named, text)
    for point, place in problem.bodies[FRAME].points.items():
        if place != 0:
            lines += _coordinates(point, place, text, f"frame.{point}")
    carried = {slide.label for slide in problem.slides.values() if slide.host == FRAME}
    told: set[str] = set()
    for guide, (through, base, angle) in problem.guides.items():
        if through is None:
            lines += _guide(guide, base, angle, text)
        elif guide in carried:
            beside = told_beside(guide, problem)
            lines.append(_given_guide(guide, through, beside, text))
            told |= set() if beside is None else {beside.slider}
    pins = [slide.pin for slide in problem.slides.values() if slide.offset]
    for slide in problem.slides.values():
        lines += _carried(problem, slide, text)
        if slide.offset and slide.slider not in told:
            name = slide.pin if pins.count(slide.pin) == 1 else f"{slide.pin}{slide.slider}"
            offset = text.metres(slide.offset, _path(slide.slider, "slides.offset"))
            lines.append(f"e_{{{name}}} = {offset}")
    if drive.posed is not None and drive.posed.by is PosedBy.LENGTH:
        return lines
    if drive.followed is not None:
        return [*lines, *_lifted(drive, drive.followed, text, asked)]
    if drive.is_crank:
        lines += [] if drive.geared is None else _through(drive.geared, words)
        constant = "" if drive.acceleration else " = const"
        wheel = "" if drive.geared is None else f" = ω_{{{drive.geared.label}}}"
        omega = f"ω_{{{drive.link}}}"
        if drive.turns is not None:
            speed = text.number(drive.turns, "rev/min", "driver.n")
            rate = text.say.found(drive.rate)
            turns = fraction(f"πn_{{{drive.link}}}", "30")
            found = f"{omega} = {turns} = {rate} {text.say.units['1/s']}"
            lines.append(f"n_{{{drive.link}}} = {speed}{constant} ({found})")
        else:
            rate = text.number(drive.rate, "1/s", "driver.omega")
            lines.append(f"{omega}{wheel} = {rate}{constant}")
        if drive.acceleration:
            epsilon = text.number(drive.acceleration, "1/s²", "driver.epsilon")
            lines.append(f"ε_{{{drive.link}}} = {epsilon}")
    else:
        lines.append(f"v = {text.number(drive.rate, 'm/s', 'driver.v')}")
        lines.append(f"a = {text.number(drive.acceleration, 'm/s²', 'driver.a')}")
    return lines


class As:
    """How a file gives its numbers: its arithmetic, its unit of lengths (как дано)."""

    def __init__(self, problem: Problem, words: Language) -> None:
        self.problem, self.words, self.say = problem, words, words.say

    def plain(self, value: float, path: str = "") -> str:
        """Return a number without its unit; its arithmetic where digits would not be exact."""
        stated = self.problem.stated.get(path)
        if stated is None or abs(float(trimmed(value, 6)) - value) <= 1e-12 * abs(value):
            return self.say.given(value)
        return arithmetic(stated, self.say)

    def number(self, value: float, unit: str, path: str = "") -> str:
        """Return a number with its unit."""
        return with_unit(self.plain(value, path), self.say.units[unit])

    def metres(self, value: float, path: str = "") -> str:
        """Return a length, m, in the unit of the file."""
        unit = self.problem.unit
        return self.number(value * UNITS[unit], unit, path)


def arithmetic(text: str, say: Notation) -> str:
    """Return arithmetic of a file as rich text: ``0.25/3`` gives ``0,25/3``."""
    text = text.replace("**", "^").replace("sqrt", "√").replace("pi", "π").strip(" °")
    text = re.sub(r"\^ *([0-9]+)", r"^{\1}", text.replace("²", "^2").replace("³", "^3"))
    return text.replace(".", say.decimal).replace("*", "·").replace("-", MINUS)


def _path(link: str, key: str) -> str:
    return f"links.{link}.{key}"


DRAWN = 5
"""Digits of a coordinate that was computed: a hundredth of a millimetre of a link."""

NEAR_DEG = 0.5
"""Degrees within which an angle is that of a position."""

MOST_LISTED = 6
"""Most positions that are given one by one."""


def _position(text: As, asked: Sequence[float]) -> str:
    """Return the position: as the output tells it, where the asked ones are those of the file."""
    drive = text.problem.drive
    of = [k for k, position in enumerate(drive.positions) if position in asked]
    if drive.posed is not None and len(of) == len(asked):
        return _posed(drive.posed, of, text)
    unit, key = drive.coordinate.unit, ""
    if len(asked) == 1 and tuple(asked) == drive.positions:
        key = f"driver.{drive.coordinate.name}"

    def told(value: float) -> str:
        if unit == "m":
            return text.metres(value, key)
        return text.number(value if key else text.problem.shown(value), unit, key)

    symbol = drive.coordinate.symbol
    if tuple(asked) == text.problem.numbered:
        return _numbered(text, asked)
    if len(asked) <= MOST_LISTED:
        return f"{symbol} = {', '.join(told(float(one)) for one in asked)}"
    first, last = float(asked[0]), float(asked[-1])
    step = round((last - first) / (len(asked) - 1), 4)
    if np.allclose(np.diff(asked), step, rtol=0.0, atol=1e-6 * abs(step)):
        steps = text.words.note.given_steps
        return f"{symbol} {steps.format(first=told(first), last=told(last), step=told(step))}"
    count = text.words.note.given_count.format(count=len(asked))
    return f"{symbol} = {told(first)}…{told(last)}{count}"


def _numbered(text: As, asked: Sequence[float]) -> str:
    """Return the numbered positions of the cycle: the first one, the step and its sense."""
    drive, note = text.problem.drive, text.words.note
    step = float(asked[1]) - float(asked[0])
    against = step * (drive.rate or 1.0) < 0.0
    facts = [text.number(round(one, 2), drive.coordinate.unit, "")
             for one in (text.problem.shown(float(asked[0])), abs(step))]  # fmt: skip
    return note.given_numbered.format(
        symbol=drive.coordinate.symbol,
        first=facts[0],
        step=facts[1],
        sense=text.words.cycle["senses"][drive.mover]["against" if against else "along"],
        count=len(asked),
    )


def of_turn(problem: Problem, position: float, angle: str, words: Language) -> str:
    """Return an angle of the crank with the positions it is at, which tell the turn of two.

    Parameters
    ----------
    position : float, degrees
        Of the driver, as it goes on over both turns.
    angle : str
        How it is written.
    """
    place, count = problem.counted(position), len(problem.numbered)
    if place is None:
        return angle
    number, note = round(place), words.note
    if abs(place - number) * 360.0 * problem.turns / count < NEAR_DEG:
        return note.at_position.format(at=angle, number=number % count)
    before = int(place)
    return note.between_positions.format(at=angle, one=before, other=(before + 1) % count)


def _posed(posed: Posed, of: Sequence[int], text: As) -> str:
    """Return how the output tells some of the positions."""
    note, values = text.words.note, [posed.values[k] for k in of]
    if posed.by is PosedBy.LINE:
        pairs = [posed.extremes[k].split(" on ") for k in of]
        return "; ".join(note.given_on_line.format(point=one, line=line) for one, line in pairs)
    if posed.by is PosedBy.EXTREME:
        told = []
        for where, after in ((posed.extremes[k], posed.values[k]) for k in of):
            sign = f" {MINUS if after < 0 else '+'} {text.say.given(abs(after))}°"
            told.append(note["given_extremes"][where] + (sign if after else ""))
        return note.given_position.format(position=", ".join(told))

    def said(value: float) -> str:
        path = f"driver.{posed.key}"
        if path not in text.problem.stated:
            path += f"[{posed.values.index(value)}]"
        if posed.by is PosedBy.STROKE:
            return text.plain(value, path)
        if posed.by in (PosedBy.PHI, PosedBy.BETWEEN):
            return text.number(value, "deg", path)
        return text.metres(value, path)

    if posed.by is PosedBy.LENGTH:
        pair, drive, say = posed.of, text.problem.drive, text.say
        v, a = posed.rates
        acted = f"l_{{{pair}}} = {said(values[0])}; "
        acted += f"v_{{{pair}}} = {text.number(v, 'm/s', f'driver.v_{pair}')}; "
        acted += f"a_{{{pair}}} = {text.number(a, 'm/s²', f'driver.a_{pair}')}"
        letter, unit = (f"ω_{{{drive.link}}}", "1/s") if drive.is_crank else ("v", "m/s")
        return f"{acted} ({letter} = {say.found(drive.rate)} {say.units[unit]})"
    letter = {PosedBy.PHI: "φ", PosedBy.BETWEEN: "φ", PosedBy.STROKE: "s/H"}.get(
        posed.by, posed.by.value
    )
    symbol = f"{letter}_{{{posed.of.replace('_', ',')}}}" if posed.of else letter
    way = note["given_going"][posed.going] if posed.going else ""
    return f"{symbol} = {', '.join(map(said, values))}{way}"


def _through(geared: Geared, words: Language) -> list[str]:
    """Return what drives the crank: the speeds of the inputs, and the ratio to it."""
    letter, unit = ("n", "1/min") if geared.unit == "n" else ("ω", "1/s")
    lines = [
        f"{letter}_{{{label}}} = {words.say.given(speed)} {words.say.units[unit]}"
        for label, speed in geared.inputs
    ]
    if geared.ratio is not None:
        source, ratio = geared.inputs[0][0], words.say.given(float(geared.ratio))
        lines.append(f"U_{{{source}-{geared.label}}} = {ratio}")
    return lines


def _lifted(drive: Drive, led: Lifted, text: As, asked: Sequence[float]) -> list[str]:
    """Return the cam that drives, its lowest place, and the motion that its follower gives.

    Of several positions that is in their tables: here stands where the follower rests.
    """
    say, note, path = text.say, text.words.note, f"driver.{drive.given[0]}"
    lowest = text.number(led.lowest, "deg", path) if led.turns else text.metres(led.lowest, path)
    symbol = f"φ_{{{drive.link}}}" if led.turns else "s"
    speed = text.number(led.n, "rev/min", "cam.n")
    lines = [note.given_cam.format(n=speed, lowest=f"{symbol} = {lowest}")]
    _, rates, gains = map(np.asarray, driven(drive, np.asarray(asked, dtype=float)))
    resting = np.flatnonzero((rates == 0.0) & (gains == 0.0))
    if len(asked) == 1:
        names = (f"ω_{{{drive.link}}}", f"ε_{{{drive.link}}}") if led.turns else ("v", "a")
        units = ("1/s", "1/s²") if led.turns else ("m/s", "m/s²")
        told = zip(names, (rates, gains), units, strict=True)
        lines += [f"{name} = {say.found(of[0])} {say.units[unit]}" for name, of, unit in told]
        return [*lines, note.given_rest] if resting.size else lines
    if resting.size:
        lines.append(note.given_rests.format(numbers=", ".join(map(str, resting))))
    return lines


def told_beside(guide: str, problem: Problem) -> Slide | None:
    """Return the one slide of a guide, where it runs beside the point that the guide is laid to.

    Then the guide is told, and drawn, where the slider runs; else where the file has it.
    """
    if problem.guides[guide][0] is None:
        return None
    on = [s for s in problem.slides.values() if s.host == FRAME and s.label == guide]
    return on[0] if len(on) == 1 and on[0].offset else None


def _given_guide(guide: str, through: str, beside: Slide | None, text: As) -> str:
    """Return that a guide passes through a point, or how far from it it is drawn."""
    name, point, note = text.problem.guide_name(guide), point_name(through), text.words.note
    if beside is None:
        return note.given_through.format(guide=name, point=point)
    offset = text.metres(abs(beside.offset), _path(beside.slider, "slides.offset"))
    return note.given_beside.format(guide=name, point=point, offset=offset)


def _third_points(link: str, body: Body, named: set[str], text: As) -> list[str]:
    """Return how a link's further points are given, where lengths of its do not tell it."""
    note, points = text.words.note, list(body.points)
    lines = []
    for point, form in body.forms.items():
        start = form.point or form.line[0]
        at = f"{_path(link, point)}.at"
        if form.kind == "side":
            side = note.given_left if form.left else note.given_right
            lines.append(side.format(point=point_name(point), line=_line(*form.line)))
        elif form.kind == "vertex":
            angle = text.number(form.angle, "deg", f"{_path(link, point)}.angle")
            lines.append(f"∠{_line(form.line[1], start)}{point_name(point)} = {angle}")
            if form.distance is not None:
                distance = text.metres(form.distance, f"{_path(link, point)}.distance")
                lines.append(f"l_{{{start}{point}}} = {distance}")
        elif not form.across:
            if f"{start}{point}" not in named and f"{point}{start}" not in named:
                lines.append(f"l_{{{start}{point}}} = {text.metres(abs(form.at), at)}")
        else:
            axis = form.line if form.kind == "on" else body.axis
            along = _line(*axis) if axis else _own_way(link, (start, points[0]), text)
            across = text.metres(form.across, f"{_path(link, point)}.across")
            lines.append(
                note.given_along.format(
                    point=point_name(point),
                    at=text.metres(form.at, at),
                    line=along,
                    start=point_name(start),
                    across=across,
                )
            )
    for key, degrees in body.angles.items():
        angle = text.number(degrees, "deg", f"{_path(link, 'angle')}.{key}")
        letters = [point_name(name) for name in split_names(key)]
        said = "".join(letters)
        if len(letters) == 4:
            said = f"({''.join(letters[:2])}, {''.join(letters[2:])})"
        lines.append(f"∠{said} = {angle}")
    return lines


def _own_way(link: str, letters: tuple[str, str], text: As) -> str:
    """Return what the own axis of a link without letters for it is called: its slide's line."""
    problem = text.problem
    slides = [s for s in problem.slides.values() if link in (s.slider, s.host)]
    if not slides:
        return _line(*letters)
    slide = min(slides, key=lambda s: s.slider != link)
    told = track_direction(slide, problem)
    if told.guide:
        return told.guide
    if told.relation is Relation.ALONG:
        return _line(*told.points)
    return text.words.note.given_way.format(link=slide.host)


def _line(start: str, end: str) -> str:
    return f"{point_name(start)}{point_name(end)}"


def _carried(problem: Problem, slide: Slide, text: As) -> list[str]:
    """Return how the line of a moving link lies on it, where two letters do not tell it."""
    axis, note = problem.bodies[slide.host].axis, text.words.note
    if has_slot_name(slide, problem):
        guide = slot_name(slide)
        return [note.given_slot.format(guide=guide, link=slide.host, slider=slide.slider)]
    if slide.host == FRAME or slide.through is None or slide.towards is not None or axis is None:
        return []
    angle = text.number(slide.angle, "deg", _path(slide.slider, "slides.angle"))
    if slide.offset:
        guide = note.given_guide.format(link=slide.host, line=_line(*axis))
        return [f"{guide} = {angle}"]
    line = _line(slide.through, slide.pin)
    if slide.angle % 180 == 90:
        return [f"{line} ⊥ {_line(*axis)}"]
    return [f"∠({line}, {_line(*axis)}) = {angle}"] if slide.angle % 180 else []


def _coordinates(name: str, place: complex, text: As, path: str) -> list[str]:
    lines = []
    for index, (letter, metres) in enumerate((("x", place.real), ("y", place.imag))):
        value, stated = metres * UNITS[text.problem.unit], f"{path}[{index}]"
        said = text.plain(value, stated)
        # A coordinate that was computed has more digits than anybody draws.
        if stated not in text.problem.stated and trimmed(value) != trimmed(value, 6):
            said = text.say.number(trimmed(value, DRAWN))
        lines.append(f"{letter}_{{{name}}} = {said} {text.say.units[text.problem.unit]}")
    return lines


def _guide(name: str, base: complex, angle: float, text: As) -> list[str]:
    """Return where a guide is: by one coordinate when it runs along an axis."""
    shown, path = text.problem.guide_name(name), f"frame.guides.{name}"
    x, y = _coordinates(shown, base, text, f"{path}.through")
    if angle % 180 == 90:
        return [x]
    if angle % 180 == 0:
        return [y]
    return [x, y, f"∠({shown}) = {text.number(angle, 'deg', f'{path}.angle')}"]


def asked_points(solution: Solution) -> list[str]:
    """Return the moving points whose velocity and acceleration the sheet tells.

    Points of a link that does not turn move alike: the first stands for them all.
    """
    velocity = solution.construction.kinematics.velocity
    seen: set[object] = {velocity.pole}
    asked = []
    for name, at in velocity.named.items():
        if velocity.point[at] not in seen:
            seen.add(velocity.point[at])
            asked.append(name)
    return asked


def asked_links(solution: Solution) -> list[str]:
    """Return the links whose angular velocity is not given and not zero by nature.

    That of a link which a cam's follower swings is given in one position, in several it is told.
    """
    kin, drive = solution.construction.kinematics, solution.problem.drive
    given = "" if drive.followed is not None and len(solution.positions) > 1 else drive.link
    return [
        link for link in solution.problem.mechanism.links if link in kin.omega and link != given
    ]


def told(solution: Solution, *kinds: QuantityKind) -> list[Quantity]:
    """Return the quantities of the motion that a sheet tells, kind by kind.

    Of points and links those of `asked_points` and `asked_links`.
    """
    still = {*solution.points} - {*asked_points(solution)}
    driven = {*solution.links} - {*asked_links(solution)}
    return [
        quantity
        for kind in kinds
        for of, quantities in solution.quantities(kind).items()
        for quantity in quantities
        if of not in (driven if kind in TURNINGS else still)
    ]


def wanted(solution: Solution) -> str:
    """Return what is to be found, as one line of symbols."""
    return ", ".join(quantity.symbol for quantity in told(solution, *MOTION_KINDS))


def solution_peak(solution: Solution, kind: QuantityKind) -> float:
    """Return the largest value of a kind of quantities in all positions of a solution."""
    found = [quantity for each in solution.quantities(kind).values() for quantity in each]
    return float(np.max([np.abs(solution.exact(quantity)) for quantity in found]))
