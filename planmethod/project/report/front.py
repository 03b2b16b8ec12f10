"""Title page, assignment, contents, introduction (титульный лист, задание, введение)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from planmethod.mechanism.structure import roman
from planmethod.note.document import (
    Contents,
    Node,
    PageBreak,
    StructuralHeading,
    Table,
    TitlePage,
)
from planmethod.note.formula import Rich, escape
from planmethod.note.narrate.forces.common import QUARTERS
from planmethod.note.narrate.forces.statement import mass_lines
from planmethod.note.narrate.given import given
from planmethod.note.narrate.machine import MachineTeller
from planmethod.note.numbers import with_unit
from planmethod.note.wording import Words
from planmethod.problem.load_records import Against, Couple, Fixed, Load, SizeTable
from planmethod.project.model import PartName
from planmethod.project.report.context import NBSP, Report, items, lettered, sentences
from planmethod.project.report.figures import figure
from planmethod.render.pictures.schemeview import scheme_picture
from planmethod.solved.machine.drawing import drawing_of
from planmethod.solved.machine.flywheel import flywheel_of

_FACT = re.compile(r"^([^\s=(]+) = (.+)$")
_CONST = " = const"

LINKS = ("n", "ω", "ε", "φ", "m", "J", "length")
"""Letters of quantities of links."""


_OTHERS = (
    PartName.FORCES, PartName.FLYWHEEL, PartName.GEARS, PartName.MESHING, PartName.CAM,
)  # fmt: skip
"""Parts that a file may have beside the analysis of its linkage."""


def title_page(report: Report) -> TitlePage:
    """Return the first page: what ``[stamp]`` says."""
    problem, said = report.project.problem, report.said["front"]
    stamp = {key: escape(text) for key, text in problem.stamp.items()}
    kind = said.project if len(report.project.parts) > 1 else said.homework
    designation = stamp.get("designation", "")
    year = re.search(r"\d{4}", stamp.get("author_date") or stamp.get("date", ""))
    # Never the year of the clock: the same problem gives the same note.
    return TitlePage(
        organisation=tuple(stamp[k] for k in ("organisation", "department") if stamp.get(k)),
        work=said.note.format(),
        subject=kind.format(),
        title=escape(problem.title or problem.name),
        designation=said.designation.format(designation=designation) if designation else "",
        author=stamp.get("author", ""),
        group=stamp.get("group", ""),
        checker=stamp.get("checker", ""),
        place=stamp.get("city", ""),
        year=stamp.get("year") or (year[0] if year else ""),
    )


def front(report: Report) -> Iterator[Node]:
    """Yield all that stands before the first chapter."""
    yield title_page(report)
    yield from _assignment(report)
    yield PageBreak()
    yield Contents()
    yield from _introduction(report)


# Assignment --------------------------------------------------------------------------------------


def _assignment(report: Report) -> Iterator[Node]:
    said: Words = report.said["front"]
    yield StructuralHeading(said.assignment.format())
    number = report.project.calculated
    statement = said.statement_series if report.is_series else said.statement
    yield sentences(statement.format(symbol=report.coordinate, value=report.place, number=number))
    yield from items(_tasks(report))
    rows, further = _data(report)
    yield sentences(said.data.format())
    yield Table(
        tuple(said["columns_data"]), tuple(rows), 3, name=said.data_table.format(), key="data"
    )
    if further:
        yield sentences(said.further.format(facts="; ".join(further)))
    if report.has(PartName.FORCES) and (loads := _loads(report)):
        yield sentences(*loads)
    caption = said.scheme.format(position=report.in_position)
    yield figure(
        lambda letter: scheme_picture(report.one, 0, letter_height=letter), caption, "scheme"
    )


def _tasks(report: Report) -> Iterator[Rich]:
    tasks: Words = report.said["front"]["tasks"]
    yield tasks.structure.format()
    yield tasks.kinematics.format()
    yield tasks.motion.format()
    if report.every.problem.cycle is not None:
        yield tasks.cycle.format()
    for name in _OTHERS:
        if report.has(name):
            balancing = report.said["balancing"][report.one.problem.drive.balancing.quantity]
            yield str(tasks[name.value]).format(balancing=balancing)


def _data(report: Report) -> tuple[list[tuple[Rich, Rich, Rich]], list[Rich]]:
    """Return the rows of the table of data, and what is given that is no number with a letter."""
    problem, words = report.one.problem, report.words
    facts = given(problem, words, [float(report.one.positions[0])])
    if report.has(PartName.FORCES):
        facts += mass_lines(problem, words)
    rows: list[tuple[Rich, Rich, Rich]] = []
    further: list[Rich] = []
    series = report.is_series
    for fact in dict.fromkeys(facts):
        told = _FACT.match(fact)
        name = None if told is None else _name(told[1], report)
        if told is None or name is None:
            further.append(fact)
        elif not (series and told[1] == report.coordinate):
            rows.append((lettered(name), told[1], _value(told[2], report)))
    if report.has(PartName.FLYWHEEL):
        tell = MachineTeller(drawing_of(flywheel_of(report.every), report.every.profile), words)
        quantities = report.said["quantities"]
        own = [fact for fact in tell.given() if fact not in facts]
        for fact in own:
            told = _FACT.match(fact)
            if told is not None and told[1] in ("δ", tell.letter("crank inertia")):
                key = "δ" if told[1] == "δ" else "crank inertia"
                rows.append((str(quantities[key]).format(), told[1], told[2]))
    return rows, further


def _value(text: Rich, report: Report) -> Rich:
    """Return a value; of one that is constant that it is."""
    value, const, _ = text.partition(_CONST)
    return report.said["front"].constant.format(value=value) if const else value


def _name(symbol: Rich, report: Report) -> Rich | None:
    """Return what a letter with its index stands for; None of those that have no name."""
    letter, _, index = symbol.partition("_{")
    index = index.removesuffix("}")
    quantities, problem = report.said["quantities"], report.one.problem
    if letter == "J":
        index = index.removeprefix("S")
    if letter in ("x", "y") and index in problem.guides:
        letter += "-"
    if letter == "a" and problem.drive.is_crank:  # of a guide: how long its slider is
        letter, index = "length", index[:1]
    if letter in ("φ", "s", "v", "a") and not index:
        index = problem.drive.link
    template = quantities.get(letter)
    if template is None:
        return None
    of = report.link(index, "of") if letter in LINKS and index in problem.bodies else index
    return str(template).format(of=of)


def _loads(report: Report) -> list[Rich]:
    """Return the external loads as the file gives them, a sentence each."""
    dynamics = report.every.problem.dynamics
    return [] if dynamics is None else [_load(load, report) for load in dynamics.loads]


def _load(load: Load | Couple, report: Report) -> Rich:
    said: Words = report.said["front"]["loads"]
    force = isinstance(load, Load)
    unit = "N" if force else "N·m"
    if isinstance(load.size, SizeTable):
        largest = report.quantity(max(load.size.values, key=abs), unit)
        size = (said.table if force else said.table_couple).format(value=largest)
    else:
        size = said.constant.format(value=with_unit(report.say.short(load.size), report.unit(unit)))
    against = said.against if force else said.against_couple
    sense = against.format() if isinstance(load.sense, Against) else ""
    if isinstance(load.sense, Fixed):
        sense = said.fixed.format(way=_way(load, load.sense, report))
    moving = None if load.phase is None else load.phase.moving
    facts = {
        "link": report.link(load.link, "on"),
        "symbol": load.name,
        "size": size,
        "sense": sense,
        "phase": str(said["moving"][moving.value]).format() if moving else "",
    }
    if isinstance(load, Load):
        return said.force.format(point=load.at, **facts)
    return said.couple.format(**facts)


def _way(load: Load | Couple, fixed: Fixed, report: Report) -> Rich:
    """Return the way of a force that stays on the paper."""
    largest = max(load.size.values, key=abs) if isinstance(load.size, SizeTable) else load.size
    angle = (fixed.angle + (180.0 if largest < 0 else 0.0)) % 360.0
    forces = report.words.forces
    quarter = QUARTERS.get(round(angle, 6) % 360.0)
    return forces[quarter] if quarter else forces.way_angle.format(angle=report.say.short(angle))


# Introduction ------------------------------------------------------------------------------------


def _introduction(report: Report) -> Iterator[Node]:
    said, structure = report.said["introduction"], report.one.structure
    counts: Words = report.said["counts"]
    many = structure.moving_links
    links = counts["links"][many] if many < len(counts["links"]) else counts.many.format(count=many)
    yield StructuralHeading(said.title.format())
    others = [str(said["kinds"][name.value]).format() for name in _OTHERS if report.has(name)]
    yield sentences(
        said.object.format(roman=roman(structure.class_number), links=links),
        said.parts.format(parts=report.listed(others)) if others else "",
    )
    ruler = f"{report.say.given(report.one.profile.ruler)}{NBSP}{report.unit('mm')}"
    calculated = said.calculated.format(
        number=report.project.calculated, symbol=report.coordinate, value=report.place
    )
    yield sentences(
        said.way.format(ruler=ruler),
        calculated if report.is_series else "",
        said.drawn.format(),
    )
