"""The statement of a problem in symbols: given data and unknowns (Дано, Определить)."""

# no messages: rules, in the words of the file

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from enum import Enum
from functools import partial

import numpy as np

from planmethod.mechanism.model import FRAME
from planmethod.mechanism.structure import analyse
from planmethod.note.document import GivenFact, Item, Node, Paragraph
from planmethod.note.formula import Rich, escape, fraction
from planmethod.note.narrate.driven import (
    as_listed,
    determined_rates,
    driver_symbols,
    single_driver,
)
from planmethod.note.narrate.figure import figure_facts, sought_paths
from planmethod.note.narrate.figure_points import without_sizes
from planmethod.note.narrate.meshes import mesh_facts
from planmethod.note.narrate.naming import point_name
from planmethod.note.narrate.sizes import given_sizes
from planmethod.note.narrate.stated_links import (
    StatedNumbers,
    axis_angle,
    coordinate_facts,
    direction_key,
    file_path_of_link,
    guide_facts,
    line_name,
    slide_line_facts,
    start_of_form,
    third_point_facts,
)
from planmethod.note.narrate.synthesis import synthesis_facts, without_results
from planmethod.note.numbers import MINUS
from planmethod.note.wording import Language
from planmethod.plans.build import MOTION_KINDS, Quantity
from planmethod.problem.model import (
    ANYWHERE,
    AssemblyRelation,
    CamDrive,
    Drive,
    GearDrive,
    OutputPositionKind,
    OutputPositions,
    Problem,
    Rule,
)
from planmethod.problem.names import segment, split_names
from planmethod.problem.quantities import OF_PLANS, QuantityKind
from planmethod.problem.records import KindProblem
from planmethod.solved.reading import driven, other_place
from planmethod.solved.rules import from_joint
from planmethod.solved.solution import Solution

NBSP = "\u00a0"

SHORT = 40
"""Letters of a sentence that is not broken."""


def reading_notes(problem: KindProblem, language: Language) -> Iterator[Node]:
    """Yield that the scheme is one of several that fit the data, and what the others are."""
    if problem.reading:
        yield Item(language.tasks.reading)
        if problem.other_readings:
            others = escape("; ".join(problem.other_readings))
            yield Item(language.tasks.other_readings.format(others=others))


def unbroken(facts: Iterable[Rich]) -> Rich:
    """Return facts in one line that is broken between them; sentences at their words as well.

    A long list of values is broken between them.
    """
    return "; ".join(map(_unbroken, filter(None, facts)))


def _unbroken(fact: Rich) -> Rich:
    if " = " in fact or len(fact) <= SHORT:
        whole = fact.replace(" ", NBSP)
        return whole if len(fact) <= 2 * SHORT else whole.replace(f",{NBSP}", ", ")  # a list
    return re.sub(r"(?<=[0-9}]) (?=\w)", NBSP, fact)  # a number stays with its unit


def given_paragraph(facts: Sequence[GivenFact], language: Language) -> Paragraph:
    """Return the given facts as one paragraph, which keeps the keys of its facts (дано)."""
    text = unbroken(fact.text for fact in facts)
    return Paragraph(language.note.given.format(given=text), facts=tuple(facts))


def given_facts(
    problem: Problem, language: Language, positions: Sequence[float] | None = None
) -> list[GivenFact]:
    """Return the given facts; with the scheme of `drawn` the mechanism can be rebuilt from them.

    Each fact has the keys of the problem file that it states, with their values (`GivenFact`).
    ``positions`` are the driver's, degrees (m for a slider). Default: the file's.
    """
    drive, text = problem.drive, StatedNumbers(problem, language)
    asked = drive.positions if positions is None else tuple(positions)
    several = bool(drive.other_drives)
    first = StatedNumbers(single_driver(problem, 0), language) if several else text
    facts = [_position(first, asked), *_reference_lines(first), *synthesis_facts(text)]
    for link, name, metres in problem.lengths:
        centre = problem.bodies[link].arc
        if centre is not None and name == "".join(problem.bodies[link].axis or ()):
            facts.append(_arc(link, name, metres, text))
            continue
        path = file_path_of_link(link, name)
        data: dict[str, object] = {path: metres}
        for point, form in problem.bodies[link].forms.items():
            if form.kind in ("on", "from") and {*split_names(name)} == {point, start_of_form(form)}:
                data[f"{file_path_of_link(link, segment(point))}.at"] = form.at
        facts.append(GivenFact(f"l_{{{name}}} = {text.metres(metres, path)}", data))
    for link, body in problem.bodies.items():
        if link != FRAME:
            facts += third_point_facts(link, body, text)
    for one in given_sizes(problem):
        facts.append(GivenFact(f"{one.symbol} = {text.metres(one.metres)}", {}))
    sought = sought_paths(problem)
    for point, place in problem.bodies[FRAME].points.items():
        path = f"frame.{segment(point)}"
        if point in sought:
            continue
        if place != 0:
            facts += coordinate_facts(point, place, text, path)
        else:
            origin = language.note.given_origin.format(point=point_name(point))
            facts.append(GivenFact(origin, {path: [0.0, 0.0]}))
    facts += guide_facts(text, sought)
    if problem.drawn is not None:
        facts += figure_facts(text, asked)
    for slide in problem.slides.values():
        if slide.host != FRAME or slide.label not in problem.guides:
            facts += slide_line_facts(slide, text)
    facts += mesh_facts(text)
    facts += _angles_sense(text)
    facts = without_sizes(without_results(facts, text), text)
    facts += _assembled(text, asked)
    if several:
        return [*as_listed([*facts, *_driving(first)], 0), *_other_drivers(text, asked)]
    if drive.actuator is not None and drive.effort is None:
        return facts
    if drive.cam_drive is not None:
        return [*facts, *_cam_facts(drive, drive.cam_drive, text, asked)]
    return [*facts, *_rates(text)]


def _driving(text: StatedNumbers) -> Iterator[GivenFact]:
    """Yield how one of several drivers moves; the rate of an actuator is beside its length."""
    drive = text.problem.drive
    if drive.actuator is None or drive.effort is not None:
        yield from _rates(text)


def _other_drivers(text: StatedNumbers, positions: Sequence[float]) -> Iterator[GivenFact]:
    """Yield the position and the rates of each other driving link."""
    drive = text.problem.drive
    for number, other in enumerate(drive.other_drives, 1):
        places = other_place(drive, other, np.asarray(positions, dtype=float)).tolist()
        own = StatedNumbers(single_driver(text.problem, number), text.language)
        yield from as_listed(
            [_position(own, places), *_reference_lines(own), *_driving(own)], number
        )


def _rates(text: StatedNumbers) -> Iterator[GivenFact]:
    """Yield how the driving link moves."""
    drive, units = text.problem.drive, text.notation.units
    if drive.output_rate is not None or drive.effort is not None:
        yield from determined_rates(text)
        return
    if not drive.is_crank:
        (rate, speed), (gain, growth) = zip(
            driver_symbols(drive), (drive.rate, drive.acceleration), strict=True
        )
        yield GivenFact(f"{rate} = {text.number(speed, 'm/s', 'driver.v')}", {"driver.v": speed})
        yield GivenFact(f"{gain} = {text.number(growth, 'm/s²', 'driver.a')}", {"driver.a": growth})
        return
    constant = "" if drive.acceleration else " = const"
    if drive.gear_drive is not None:
        yield from _through(drive.gear_drive, text, constant)
        return
    omega = f"ω_{{{drive.link}}}"
    still = {} if drive.acceleration else {"driver.epsilon": 0.0}
    if drive.turns is not None:
        turned = text.number(drive.turns, "rev/min", "driver.n")
        symbol = turns_symbol(text.problem, text.language)
        turns = fraction(f"π{symbol}", "30")
        found = f"{omega} = {turns} = {text.notation.computed(drive.rate)} {units['1/s']}"
        phrase = f"{symbol} = {turned}{constant} ({found})"
        yield GivenFact(phrase, {"driver.n": drive.turns, **still})
    else:
        rate = text.number(drive.rate, "1/s", "driver.omega")
        yield GivenFact(f"{omega} = {rate}{constant}", {"driver.omega": drive.rate, **still})
    yield from _gain(text)


def _gain(text: StatedNumbers) -> Iterator[GivenFact]:
    drive = text.problem.drive
    if drive.acceleration:
        epsilon = text.number(drive.acceleration, "1/s²", "driver.epsilon")
        yield GivenFact(f"ε_{{{drive.link}}} = {epsilon}", {"driver.epsilon": drive.acceleration})


def turns_symbol(problem: Problem, language: Language) -> Rich:
    """Return the letters of the crank's rotational speed: beside a train not those of wheel 1."""
    drive, task = problem.drive, problem.project
    if drive.gear_drive is not None:
        return f"n_{{{drive.gear_drive.label}}}"
    has_train = "gears" in problem.tables or bool(task is not None and task.gears)
    return language.notation.symbol("crank turns") if has_train else f"n_{{{drive.link}}}"


def drawn(problem: Problem, language: Language) -> GivenFact:
    """Return the scheme in words: links with their points, sliders with their guides.

    It replaces the scheme where none is beside the given data.
    """
    note, told = language.note, []
    data: dict[str, object] = {"driver.link": problem.drive.link}
    for link in problem.mechanism.links:
        body, slide = problem.bodies[link], problem.slides.get(link)
        points = [point for point in body.points if point != body.arc]
        data[file_path_of_link(link, "points")] = points
        phrase = f"{link} ({', '.join(map(point_name, points))}"
        if slide is not None:
            on = slide.label if slide.label in problem.guides else slide.host
            data[file_path_of_link(link, "slides.on")] = on
            way = problem.guide_name(on) if slide.host == FRAME else on
            template = note.drawn_on_guide if slide.host == FRAME else note.drawn_on_link
            phrase += "; " + template.format(on=problem.mechanism.called(way))
        phrase += "; " + note.drawn_driver if link in problem.drive.links else ""
        told.append(phrase + ")")
    return GivenFact(note.drawn.format(links=", ".join(told)), data)


POSITION_TOLERANCE_DEG = 0.5
"""Degrees within which an angle is that of a position."""

SAME_POSITION = {"deg": 0.01, "m": 1e-5}
"""Positions less apart are one on a drawing, in the unit of the driver."""

MAX_LISTED = 6
"""Most positions that are given one by one where their steps are even."""

MAX_UNEVEN = 36
"""Most that are, where they are not."""


def _position(text: StatedNumbers, positions: Sequence[float]) -> GivenFact:
    """Return the position: by the output, where the requested ones are those of the file."""
    drive = text.problem.drive
    of = [k for k, position in enumerate(drive.positions) if position in positions]
    if drive.posed is not None and len(of) == len(positions):
        return _posed(drive.posed, of, text)
    path = f"driver.{drive.coordinate.name}"
    figure = text.problem.drawn
    if (
        figure is not None
        and ("driver", "phi") in figure.file_values
        and tuple(positions) == drive.positions
    ):
        return GivenFact(text.language.note.given_drawn_position, {path: "drawn"})
    return GivenFact(_positions_text(text, positions), {path: [float(one) for one in positions]})


def _positions_text(text: StatedNumbers, positions: Sequence[float]) -> str:
    drive = text.problem.drive
    unit, key = drive.coordinate.unit, ""
    if len(positions) == 1 and tuple(positions) == drive.positions:
        key = f"driver.{drive.coordinate.name}"

    def position_text(value: float) -> str:
        if unit == "m":
            return text.metres(value, key)
        return text.number(value if key else text.problem.display_position(value), unit, key)

    symbol = drive.coordinate.symbol
    if tuple(positions) == text.problem.numbered:
        return _numbered(text, positions)
    if len(positions) > MAX_LISTED:
        first, last = float(positions[0]), float(positions[-1])
        step = round((last - first) / (len(positions) - 1), 4)
        if np.allclose(np.diff(positions), step, rtol=0.0, atol=1e-6 * abs(step)):
            return f"{symbol} " + text.language.note.given_steps.format(
                first=position_text(first), last=position_text(last), step=position_text(step)
            )
        if len(positions) > MAX_UNEVEN:
            count = text.language.note.given_count.format(count=len(positions))
            return f"{symbol} = {position_text(first)}…{position_text(last)}{count}"
    return f"{symbol} = {', '.join(position_text(float(one)) for one in positions)}"


def _reference_lines(text: StatedNumbers) -> Iterator[GivenFact]:
    """Yield the line from which the crank's angle is measured, or the axis of its slider."""
    problem, note = text.problem, text.language.note
    drive = problem.drive
    posed, body = drive.posed, problem.bodies[drive.link]
    if posed is not None and posed.by is OutputPositionKind.PHI:
        axis = problem.bodies[posed.of].axis
        if axis is not None:
            yield GivenFact(
                note.given_axis.format(symbol=f"φ_{{{posed.of}}}", line=line_name(*axis))
            )
    if drive.is_crank and body.axis is not None:
        start, direction = (body.points[p] for p in body.axis)
        for place in body.points.values():
            aside = (place - start) * (direction - start).conjugate()
            if aside.real < 0 or abs(aside.imag) > 1e-9 * abs(aside):
                line = line_name(*body.axis)
                yield GivenFact(note.given_axis.format(symbol=f"φ_{{{drive.link}}}", line=line))
                return
    elif not drive.is_crank and (slide := problem.slides.get(drive.link)) is not None:
        base = "; ".join(text.metres(one) for one in (slide.base.real, slide.base.imag))
        origin = f"({base})" if slide.through is None else point_name(slide.through)
        way = note["given_ways"][direction_key(slide.angle)]
        name = problem.guide_name(slide.label)
        data: dict[str, object] = {}
        if slide.through is None:
            path = f"frame.guides.{segment(slide.label)}.through"
            data = {f"{path}[{k}]": x for k, x in enumerate((slide.base.real, slide.base.imag))}
        yield GivenFact(note.given_place.format(guide=name, start=origin, way=way), data)


def _arc(link: str, name: str, metres: float, text: StatedNumbers) -> GivenFact:
    """Return the fact on a sliding block in a circular slot."""
    problem = text.problem
    body, path = problem.bodies[link], file_path_of_link(link, "slides.radius")
    phrase = text.language.note.given_arc.format(
        link=link, radius=text.metres(metres, path), line=line_name(*split_names(name))
    )
    host = next((x for x, other in problem.bodies.items()
                 if x != link and body.arc in other.points), FRAME)  # fmt: skip
    keys = {"on": host, "centre": body.arc, "radius": metres}
    return GivenFact(
        phrase, {file_path_of_link(link, f"slides.{key}"): value for key, value in keys.items()}
    )


def _numbered(text: StatedNumbers, positions: Sequence[float]) -> str:
    """Return the numbered positions of the cycle: the first one, the step and its sense."""
    drive, note = text.problem.drive, text.language.note
    step = float(positions[1]) - float(positions[0])
    against = step * (drive.rate or 1.0) < 0.0
    first = text.problem.display_position(float(positions[0]))
    facts = [text.number(round(one, 2), drive.coordinate.unit, "") for one in (first, abs(step))]
    return note.given_numbered.format(
        symbol=drive.coordinate.symbol,
        first=facts[0],
        step=facts[1],
        sense=text.language.cycle["senses"][drive.mover]["against" if against else "along"],
        count=len(positions),
    )


def angle_with_positions(problem: Problem, position: float, angle: str, language: Language) -> str:
    """Return an angle of the crank with its position numbers, which distinguish two turns.

    Parameters
    ----------
    position : float, degrees
        Position of the driver, continuous over both turns.
    angle : str
        The angle as text.
    """
    place, count = problem.counted(position), len(problem.numbered)
    if place is None:
        return angle
    number, note = round(place), language.note
    if abs(place - number) * 360.0 * problem.turns / count < POSITION_TOLERANCE_DEG:
        return note.at_position.format(at=angle, number=number % count)
    before = int(place)
    return note.between_positions.format(at=angle, one=before, other=(before + 1) % count)


def _posed(posed: OutputPositions, of: Sequence[int], text: StatedNumbers) -> GivenFact:
    """Return how the output determines positions, and which of several is meant."""
    note, values = text.language.note, [posed.values[k] for k in of]
    root: int | str = posed.number or ""
    way = ""
    if posed.going:
        root, way = f"going {posed.going}", note["given_going"][posed.going]
    elif posed.nearest_to is not None:
        root = f"near {posed.nearest_to!r}"
        coordinate = text.problem.drive.coordinate
        near = (text.metres if coordinate.unit == "m" else partial(text.number, unit="deg"))(
            posed.nearest_to
        )
        way = note.given_near.format(place=f"{coordinate.symbol} = {near}")
    elif posed.number:
        symbol = text.problem.drive.coordinate.symbol
        way = note.given_which.format(number=posed.number, symbol=symbol)
    data: dict[str, object] = {"driver.root": root} if root else {}
    if posed.by is OutputPositionKind.LINE:
        said = [posed.extremes[k] for k in of]
        pairs = [one.split(" on ") for one in said]
        told = [note.given_on_line.format(point=one, line=line) for one, line in pairs]
        return GivenFact("; ".join(told) + way, {"driver.at": said, **data})
    if posed.by is OutputPositionKind.EXTREME:
        told, keys = [], []
        for where, after in ((posed.extremes[k], posed.values[k]) for k in of):
            sign = f" {MINUS if after < 0 else '+'} {text.notation.as_input(abs(after))}°"
            told.append(note["given_extremes"][where] + (sign if after else ""))
            keys.append(f"{where} extreme".strip() + (f" {after:+}" if after else ""))
        output, cycle = _output(text)
        said_so = note.given_position.format(position=", ".join(told))
        return GivenFact(said_so + output, {"driver.at": keys, **cycle})

    def value_text(value: float) -> str:
        path = f"driver.{posed.key}"
        if path not in text.problem.stated:
            path += f"[{posed.values.index(value)}]"
        if posed.by is OutputPositionKind.STROKE:
            return text.number_text(value, path)
        if posed.by in (OutputPositionKind.PHI, OutputPositionKind.BETWEEN):
            return text.number(value, "deg", path)
        return text.metres(value, path)

    if posed.by is OutputPositionKind.LENGTH:
        pair, drive, notation = posed.of, text.problem.drive, text.notation
        v, a = posed.rates
        acted = f"l_{{{pair}}} = {value_text(values[0])}{way}; "
        acted += f"v_{{{pair}}} = {text.number(v, 'm/s', f'driver.v_{pair}')}; "
        acted += f"a_{{{pair}}} = {text.number(a, 'm/s²', f'driver.a_{pair}')}"
        letter, unit = driver_symbols(drive)[0], "1/s" if drive.is_crank else "m/s"
        found = f" ({letter} = {notation.computed(drive.rate)} {notation.units[unit]})"
        rates = {f"driver.v_{pair}": v, f"driver.a_{pair}": a}
        return GivenFact(acted + found, {f"driver.{pair}": values[0], **rates, **data})
    letter = {
        OutputPositionKind.PHI: "φ",
        OutputPositionKind.BETWEEN: "φ",
        OutputPositionKind.STROKE: "s/H",
    }.get(posed.by, posed.by.value)
    symbol = f"{letter}_{{{posed.of.replace('_', ',')}}}" if posed.of else letter
    symbol += _between(posed, text.problem)
    if posed.by is OutputPositionKind.STROKE:
        output, cycle = _output(text)
        way, data = way + output, {**data, **cycle}
    key = f"driver.{posed.key}"
    return GivenFact(f"{symbol} = {', '.join(map(value_text, values))}{way}", {key: values, **data})


def _between(posed: OutputPositions, problem: Problem) -> str:
    """Return the letters of the angle between two links that have a pin in common."""
    if posed.by is not OutputPositionKind.BETWEEN:
        return ""
    one, two = (problem.bodies[link].axis or () for link in posed.of.split("_"))
    common = {*one} & {*two}
    if len(common) != 1:
        return ""
    (pin,) = common
    ends = [point_name(*({*axis} - common)) for axis in (one, two)]
    return f" = ∠{ends[0]}{point_name(pin)}{ends[1]}"


def _output(text: StatedNumbers) -> tuple[str, dict[str, object]]:
    """Return whose extremes and stroke are meant, and which extreme is the first one."""
    cycle = text.problem.cycle
    if cycle is None:
        return "", {}
    data: dict[str, object] = {}
    phrase = ""
    if cycle.output is not None:
        data["cycle.output"] = cycle.output
        phrase = text.language.note.given_output.format(output=point_name(cycle.output))
    for key, value in (("zero", cycle.zero), ("direction", cycle.direction),
                       ("working", cycle.working)):  # fmt: skip
        told = value.value if isinstance(value, Enum) else value
        if told not in ("", None):
            data[f"cycle.{key}"] = told
    return phrase, data


def _through(geared: GearDrive, text: StatedNumbers, constant: str) -> Iterator[GivenFact]:
    """Yield what drives the crank: the train, the ratio to the crank, and the speed of it."""
    notation, drive = text.notation, text.problem.drive
    yield from geared.given_facts(text.language)
    if geared.ratio is not None:
        source, ratio = geared.inputs[0][0], notation.as_input(float(geared.ratio))
        yield GivenFact(f"U_{{{source}-{geared.label}}} = {ratio}")
    rate = text.number(drive.rate, "1/s", "driver.omega")
    phrase = f"ω_{{{drive.link}}} = ω_{{{geared.label}}} = {rate}{constant}"
    still: dict[str, object] = {} if drive.acceleration else {"driver.epsilon": 0.0}
    yield GivenFact(phrase, {"driver.train": geared.label, **still})
    yield from _gain(text)


def _cam_facts(
    drive: Drive, led: CamDrive, text: StatedNumbers, positions: Sequence[float]
) -> list[GivenFact]:
    """Return the cam that drives, its lowest place, and the motion that its follower gives.

    Of several positions that is in their tables: here stands where the follower rests.
    """
    notation, note, path = text.notation, text.language.note, f"driver.{drive.program_inputs[0]}"
    lowest = text.number(led.lowest, "deg", path) if led.turns else text.metres(led.lowest, path)
    symbol = f"φ_{{{drive.link}}}" if led.turns else "s"
    speed = text.number(led.n, "rev/min", "cam.n")
    phrase = note.given_cam.format(n=speed, lowest=f"{symbol} = {lowest}")
    facts = [GivenFact(phrase, {path: led.lowest, "cam.n": led.n}), *led.given_facts(text.language)]
    _, rates, gains = map(np.asarray, driven(drive, np.asarray(positions, dtype=float)))
    resting = np.flatnonzero((rates == 0.0) & (gains == 0.0))
    if len(positions) == 1:
        names = (f"ω_{{{drive.link}}}", f"ε_{{{drive.link}}}") if led.turns else ("v", "a")
        units = ("1/s", "1/s²") if led.turns else ("m/s", "m/s²")
        told = zip(names, (rates, gains), units, strict=True)
        facts += [
            GivenFact(f"{name} = {notation.computed(of[0])} {notation.units[unit]}")
            for name, of, unit in told
        ]
        return [*facts, GivenFact(note.given_rest)] if resting.size else facts
    if resting.size:
        facts.append(GivenFact(note.given_rests.format(numbers=", ".join(map(str, resting)))))
    return facts


def _angles_sense(text: StatedNumbers) -> Iterator[GivenFact]:
    """Yield the positive sense of angles of links, where such are given."""
    problem = text.problem
    told = any(
        body.angles or any(form.kind == "vertex" for form in body.forms.values())
        for body in problem.bodies.values()
    )
    slots = (s for s in problem.slides.values() if s.host != FRAME and s.towards is None)
    if told or any(s.angle % 90 and axis_angle(s.host, problem) is None for s in slots):
        yield GivenFact(text.language.note.given_sense)


_RULES = {
    AssemblyRelation.LEFT_OF: "left of {}",
    AssemblyRelation.RIGHT_OF: "right of {}",
    AssemblyRelation.RIGHT: "right of {}",
    AssemblyRelation.LEFT: "left of {}",
    AssemblyRelation.ABOVE: "above {}",
    AssemblyRelation.BELOW: "below {}",
    AssemblyRelation.TOWARDS: "towards {}",
    AssemblyRelation.AWAY: "away from {}",
}
"""Phrases of the file for the rules that have one."""


def _with_joint(problem: Problem, rule: Rule) -> Rule:
    """Return a rule with the joint from which it measures a direction, where it does."""
    groups = (
        analyse(problem.mechanism).groups
        if rule.relation in (AssemblyRelation.TOWARDS, AssemblyRelation.AWAY)
        else ()
    )
    for group in groups:
        if any(rule.point in problem.bodies[link].points for link in group.links):
            return from_joint(problem, group, rule)
    return rule


def _assembled(text: StatedNumbers, positions: Sequence[float]) -> Iterator[GivenFact]:
    """Yield the assembly of each group, and the position to which it refers."""
    problem, rules = text.problem, text.language.note["given_rules"]
    for rule in map(partial(_with_joint, problem), problem.assembly):
        path = f"assembly.{segment(rule.point)}"
        ray = rule.relation in (AssemblyRelation.TOWARDS, AssemblyRelation.AWAY)
        letters = [point_name(ref) for ref in rule.refs]
        said = rules[rule.relation.value].format(
            point=point_name(rule.point),
            of=letters[0] if ray else "".join(letters),
            joint=letters[-1] if letters else "",
            at="; ".join(text.metres(one) for one in (rule.at.real, rule.at.imag)),
        )
        data: dict[str, object]
        if rule.relation is AssemblyRelation.PARALLEL:
            data = {f"{path}.keep": "parallel"}
        elif rule.relation is AssemblyRelation.NEAR:
            data = {f"{path}.near": [rule.at.real, rule.at.imag]}
        else:
            phrase = _RULES[rule.relation].format("".join(rule.refs[: 1 if ray else None]))
            data = {f"{path}.rule": phrase} if rule.continuous else {path: phrase}
        if rule.continuous:
            data[f"{path}.keep"] = "continuous"
            said += text.language.note.given_continuous
        yield GivenFact(said, data)
    drive = problem.drive
    judged = drive.assembly_positions or drive.positions
    if not problem.assembly or drive.posed is not None or {*positions} <= {*judged}:
        return
    note, data = text.language.note, {"judged": [*judged]}
    if judged == ANYWHERE:
        yield GivenFact(note.given_anywhere.format(symbol=drive.coordinate.symbol), data)
    else:
        shown = _positions_text(StatedNumbers(problem, text.language), judged)
        apart = drive.coordinate.distance
        least = SAME_POSITION[drive.coordinate.unit]
        is_drawn = any(apart(one, other) < least for one in positions for other in judged)
        said = note.given_judged if is_drawn else note.given_judged_elsewhere
        yield GivenFact(said.format(positions=shown), data)


def reported_points(solution: Solution) -> list[str]:
    """Return the moving points whose velocity and acceleration the sheet reports.

    Points of a translating link move alike: the first represents them all.
    """
    velocity = solution.construction.kinematics.velocity
    seen: set[object] = {velocity.pole}
    asked = []
    for name, at in velocity.named.items():
        if velocity.point[at] not in seen:
            seen.add(velocity.point[at])
            asked.append(name)
    return asked


def reported_links(solution: Solution) -> list[str]:
    """Return the links whose angular velocity is not given and not zero by nature.

    That of a link driven by a cam's follower is given in one position, in several it is reported.
    """
    kinematics, drive = solution.construction.kinematics, solution.problem.drive
    given = () if drive.cam_drive is not None and len(solution.positions) > 1 else drive.links
    return [
        link
        for link in solution.problem.mechanism.links
        if link in kinematics.omega and link not in given
    ]


def reported_quantities(solution: Solution, *kinds: QuantityKind) -> list[Quantity]:
    """Return the quantities of the motion that a sheet reports, kind by kind.

    Points and links are those of `reported_points` and `reported_links`.
    """
    still = {*solution.points} - {*reported_points(solution)}
    driven = {*solution.links} - {*reported_links(solution)}
    return [
        quantity
        for kind in kinds
        for of, quantities in solution.quantities(kind).items()
        for quantity in quantities
        if of not in (driven if kind in OF_PLANS else still)
    ]


def motion_unknowns(solution: Solution) -> str:
    """Return the unknowns as one line of symbols."""
    return ", ".join(quantity.symbol for quantity in reported_quantities(solution, *MOTION_KINDS))
