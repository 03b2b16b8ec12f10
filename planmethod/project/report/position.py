"""The position plan and the extreme positions (план положений, крайние положения)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.construct.steps import AtAngle, Step
from planmethod.mechanism.model import FRAME
from planmethod.note.document import Chapter, Node, Part, Table
from planmethod.note.formula import Rich, fraction
from planmethod.note.narrate.cycle import construction_facts
from planmethod.note.plaintext import input_text
from planmethod.note.wording import MessageTable
from planmethod.plans.model import PlanKind
from planmethod.problem.cycle_records import Zero
from planmethod.project.report.context import Report, displayed, lettered, sentences
from planmethod.project.report.figures import figure
from planmethod.render.pictures.seriesview import series_picture
from planmethod.solved.turn.construction import PRIMES, extreme_construction
from planmethod.solved.turn.cycle import CrankCycle, crank_cycle_of
from planmethod.solved.turn.strokes import LONGER, TOLD, Strokes, powers, sample_positions

EQUAL = 1e-6
"""Difference of K_v from 1 up to which both strokes take the same time."""


def position_part(report: Report) -> Iterator[Node]:
    """Yield the heading of kinematics and the position plan."""
    texts: MessageTable = report.texts["position"]
    yield Chapter(texts.title.format())
    yield Part(texts.part.format())
    yield from _scale(report, texts)
    if report.is_series:
        yield from _series(report, texts)
    yield from _building(report, texts)
    if report.is_series:
        yield _series_figure(report, texts)
    if report.every.problem.cycle is not None and report.every.problem.drive.is_crank:
        yield from _extremes(report, texts)


def _scale(report: Report, texts: MessageTable) -> Iterator[Node]:
    """Yield the scale and the lengths in it."""
    problem, notation = report.one.problem, report.notation
    told = {name: metres for _, name, metres in problem.lengths}
    for body in problem.bodies.values():
        for point, form in body.forms.items():
            start = form.point or form.line[0]
            straight = form.kind not in ("side", "vertex") and not form.lateral_offset
            if straight and not {start + point, point + start} & told.keys():
                told[start + point] = abs(form.at)
    per_mm = report.one.plan_scale(PlanKind.POSITION, 0).per_mm
    inverse = report.names.is_inverse_scale()
    template = texts.scale_inverse if inverse else texts.scale
    yield sentences(template.format(scale=report.scale(PlanKind.POSITION)))
    name, metres = next(iter(told.items()))
    sides = report.formulas.fraction(
        [(f"l_{{{name}}}", metres, 1, False), ("μ_{l}", per_mm, -1, True)]
    )
    drawn = f"{input_text(metres / per_mm, report.language.note, 5)} {report.unit('mm')}"
    yield displayed(" = ".join([lettered(name), *sides, f"{drawn}."]))
    rows = [
        (
            lettered(name),
            notation.as_input(metres),
            input_text(metres / per_mm, report.language.note, 5),
        )
        for name, metres in told.items()
    ]
    yield Table(
        tuple(texts["columns_drawn"]), tuple(rows), name=texts.drawn_table.format(), key="drawn"
    )


def _series(report: Report, texts: MessageTable) -> Iterator[Node]:
    """Yield the numbering of the positions, and the picture of all of them."""
    problem, every = report.every.problem, report.every
    count = len(every.positions)
    if problem.cycle is not None and problem.drive.is_crank and crank_cycle_of(every).range is None:
        turn = crank_cycle_of(every)
        named = isinstance(turn.task.zero, Zero) and turn.is_zero_specified
        zero = str(texts["zeros"]["extreme" if named else "given"])
        crank = problem.bodies[problem.drive.link]
        pin = next((p for p in crank.points if p not in problem.bodies[FRAME].points), "")
        note, turns = report.language.note, every.turns
        against = turn.is_against
        yield sentences(
            texts.divided.format(
                zero=zero.format(symbol=report.coordinate, value=report.place_of(0)),
                pin=pin,
                parts=report.parts(count // turns),
                way=texts["turning"]["against" if against else "along"],
                sense=note.cw if turn.sense < 0 else note.ccw,
                turns=texts.twice.format(count=count) if turns > 1 else "",
            )
        )
    else:
        places = ", ".join(report.place_of(k) for k in range(count))
        yield sentences(texts.turned.format(count=count, positions=places))


def _series_figure(report: Report, texts: MessageTable) -> Node:
    """Return the picture of all positions."""
    every = report.every
    indices = tuple(range(len(every.positions)))
    return figure(
        lambda letter: series_picture(
            every, report.project.calculated, indices, letter_height=letter
        ),
        texts.series.format(scale=report.scale(PlanKind.POSITION)),
        "series",
        height=190.0,
    )


def _building(report: Report, texts: MessageTable) -> Iterator[Node]:
    """Yield the construction of the calculated position, group by group."""
    narrator, problem = report.narrator, report.one.problem
    sections = [s for s in report.one.construction.sections if s.kind is PlanKind.POSITION]
    for section in sections:
        for step in section.steps:
            narrator.narrate(step)  # lengths are computed once: here the table has them
    if report.is_series:
        number, symbol = report.project.calculated, report.coordinate
        yield sentences(texts.building.format(number=number, symbol=symbol, value=report.place))
    for section in sections:
        if section.frame:
            lines = [_fixed(report)] if problem.bodies[FRAME].points else []
            lead = ""
        else:
            lines = [line for step in section.steps for line in _describe_step(step, report, texts)]
            links = () if section.group is None else section.group.links
            lead = (
                texts.group.format(links="–".join(links))
                if links
                else texts.driver.format(link=problem.drive.link)
            )
        if any(lines):
            yield sentences(lead, *lines)


def _describe_step(step: Step, report: Report, texts: MessageTable) -> list[Rich]:
    """Return the sentences of a step, with the direction of a horizontal or vertical guide."""
    names = report.names
    guide = names.guide(step.out) if isinstance(step, AtAngle) else None
    if guide is None:
        return report.narrator.narrate(step)
    assert isinstance(step, AtAngle)
    angle = names.value_of(step.angle)
    way = "slanted" if angle % 90.0 else "upright" if angle % 180.0 else "level"
    text = str(texts["ways"][way]).format(angle=input_text(angle, report.language.note))
    if step.through not in names.guides:
        return [texts.guide.format(point=names.point(step.through), guide=guide, way=text)]
    place = report.formulas.place(step.through)
    x, y = (input_text(value, report.language.note, 5) for value in (place.real, place.imag))
    return [texts.guide_at.format(x=x, y=y, guide=guide, way=text)]


def _fixed(report: Report) -> Rich:
    """Return the places of the fixed points on the drawing."""
    points = []
    for name in report.one.problem.bodies[FRAME].points:
        place = report.formulas.place(name)  # type: ignore[arg-type]
        x, y = (input_text(value, report.language.note, 5) for value in (place.real, place.imag))
        points.append(f"{lettered(name)} ({x}; {y})")
    return report.language.note.fixed_points.format(points=", ".join(points))


def _extremes(report: Report, texts: MessageTable) -> Iterator[Node]:
    """Yield extreme positions, stroke and the ratio of the strokes."""
    turn = crank_cycle_of(report.every)
    yield Part(texts.extremes.format())
    if turn.range is None:
        lead = texts.full.format()
    else:
        low, high = (report.degrees(limit) for limit in turn.range)
        lead = texts.range.format(symbol=report.coordinate, low=low, high=high)
    whole = turn.period
    angles = [report.degrees(round(one.phi % whole, 2) % whole) for one in turn.extremes]
    found = ""
    if angles:
        told = [f"{report.coordinate} = {angle}" for angle in angles]
        found = texts.extreme_at.format(angles=report.listed(told))
    yield sentences(lead, found)
    if turn.ends is not None:
        yield sentences(*_constructed(report, texts))
    if turn.stroke:
        yield from _stroke(report, texts, turn)
    yield from _ratio(report, texts)


def _constructed(report: Report, texts: MessageTable) -> Iterator[Rich]:
    """Yield the construction of the extreme positions, and the measured angles."""
    made = extreme_construction(report.every)
    if made is None:
        yield texts.no_construction.format()
        return
    facts, whole = construction_facts(made, report.language), crank_cycle_of(report.every).period
    yield str(texts["construction"][made.locus.value]).format(**facts)
    read = [
        f"φ{prime} = {report.degrees((phi + made.off(k)) % whole)}"
        for k, (prime, phi) in enumerate(zip(PRIMES, made.phi, strict=True))
    ]
    exact = [report.degrees(round(phi % whole, 2) % whole) for phi in made.phi]
    yield texts.measured.format(angles=report.listed(read), exact=report.listed(exact))


def _stroke(report: Report, texts: MessageTable, turn: CrankCycle) -> Iterator[Node]:
    output = turn.output
    assert turn.stroke is not None
    yield sentences(str(texts["stroke"][output.unit]).format())
    size = report.quantity(turn.stroke, "m") if output.slide else report.degrees(turn.stroke)
    yield displayed(f"{'H' if output.slide else 'ψ'} = {size}.")


def has_equal_strokes(strokes: Strokes) -> bool:
    """Return whether both strokes of the output take the same time."""
    return strokes.K_v is not None and abs(strokes.K_v - 1.0) < EQUAL


def loads_drive(report: Report) -> bool:
    """Return whether the loads that determine the strokes drive the mechanism, as gas does."""
    turn, strokes = crank_cycle_of(report.every), report.project.strokes
    if strokes is None or turn.ends is None or strokes.by in (LONGER, TOLD):
        return False
    start = turn.ends[0].phi
    at = sample_positions(report.every.problem, start, turn.turns)
    return sum(float(one.sum()) for one in powers(report.every, start, at).values()) > 0.0


def _why_working(strokes: Strokes, texts: MessageTable, *, drives: bool, four: bool) -> Rich:
    """Return the reason why a stroke is the working one; empty for equal strokes."""
    by: MessageTable = texts["by"]
    if strokes.by == TOLD:
        return by.told.format()
    if strokes.by == LONGER:
        return "" if has_equal_strokes(strokes) else by.longer.format()
    word, _, names = strokes.by.partition(" ")
    form = "one" if word == "load" else "many"
    kind = ("expansion" if four else "drives") if drives else "load"
    return str(by[kind][form]).format(names=names)


def _ratio(report: Report, texts: MessageTable) -> Iterator[Node]:
    strokes = report.project.strokes
    if strokes is None:
        return
    four, drives = crank_cycle_of(report.every).turns > 1, loads_drive(report)
    working, idle = report.degrees(strokes.working_deg), report.degrees(strokes.idle_deg)
    if has_equal_strokes(strokes):
        phases = texts.phases_equal.format(angle=working)
    else:
        form = "four" if four else "drives" if drives else "usual"
        phases = str(texts["phases"][form]).format(working=working, idle=idle)
    yield sentences(
        texts.four_strokes.format() if four else "",
        phases,
        _why_working(strokes, texts, drives=drives, four=four),
    )
    if strokes.K_v is None or has_equal_strokes(strokes):
        return
    yield sentences(texts.ratio.format())
    sides = [
        (str(texts["phase"]["working"]).format(), working),
        (str(texts["phase"]["idle"]).format(), idle),
    ]
    if strokes.working_deg < strokes.idle_deg:
        sides.reverse()
    letters, numbers = (fraction(*pair) for pair in zip(*sides, strict=True))
    yield displayed(f"K_{{v}} = {letters} = {numbers} = {report.notation.computed(strokes.K_v)}.")
