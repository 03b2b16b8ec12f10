"""Title page, assignment, contents, introduction (титульный лист, задание, введение)."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import assert_never

from planmethod.gears.involute.geometry import MeshingProblem
from planmethod.gears.model import GearProblem
from planmethod.mechanism.structure import roman
from planmethod.note.accounts.voice import lettered, sentences
from planmethod.note.document import Contents, Node, PageBreak, StructuralHeading, Table, TitlePage
from planmethod.note.formula import Rich, escape
from planmethod.note.narrate.driven import output_symbol
from planmethod.note.narrate.forces.loads import (
    QUARTERS,
    FrictionNarrator,
    lettered as lettered_forces,
)
from planmethod.note.narrate.forces.springs import SpringNarrator
from planmethod.note.narrate.forces.statement import mass_lines
from planmethod.note.narrate.machine import MachineNarrator
from planmethod.note.narrate.naming import mark, point_name
from planmethod.note.narrate.sizes import given_sizes, shown_name
from planmethod.note.narrate.statement import given_facts, turns_symbol
from planmethod.note.numbers import with_unit
from planmethod.note.tables.forces import push_direction, rubbed
from planmethod.note.wording import MessageTable
from planmethod.problem.records import (
    Against,
    Couple,
    Fixed,
    Interpolation,
    Load,
    SizeTable,
    Spring,
    largest_size,
)
from planmethod.project.parts import PartName
from planmethod.project.report.context import NBSP, NoteContext, Report, figure, items
from planmethod.project.report.synthesis import datum_name
from planmethod.project.settle import meshed
from planmethod.render.pictures.planview import PictureStyle
from planmethod.render.pictures.schemeview import scheme_picture
from planmethod.solved.forces.reading import force_reading
from planmethod.solved.machine.drawing import drawing_of
from planmethod.solved.machine.flywheel import flywheel_of

_FACT = re.compile(r"^([^\s=(]+) = (.+)$")
_CONST = " = const"

_EVERY = (PartName.KINEMATICS, PartName.NOTE)
_FURTHER = tuple(name for name in PartName if name not in _EVERY)
"""Parts that not every project has."""

LINKS = ("n", "ω", "ε", "φ", "m", "J", "length")
"""Letters of quantities of links."""


def title_page(report: NoteContext) -> TitlePage:
    """Return the first page, with the data of ``[stamp]``."""
    problem, said = report.problem, report.texts["front"]
    stamp = {key: escape(text) for key, text in problem.title_block.items()}
    kind = said.project if len(report.project_parts) > 1 else said.homework
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
    """Yield everything before the first chapter."""
    yield title_page(report)
    yield from _assignment(report)
    yield PageBreak()
    yield Contents()
    yield from _introduction(report)


# Assignment --------------------------------------------------------------------------------------


def _assignment(report: Report) -> Iterator[Node]:
    texts: MessageTable = report.texts["front"]
    yield StructuralHeading(texts.assignment.format())
    number = report.project.calculated
    statement = texts.statement_series if report.is_series else texts.statement
    yield sentences(statement.format(symbol=report.coordinate, value=report.place, number=number))
    yield from items(_tasks(report))
    rows, further = _data(report)
    cited = report.cited()
    taken = texts.taken.format(own=cited["own"]) if "own" in cited else ""
    yield sentences(taken, texts.data.format())
    yield Table(
        tuple(texts["columns_data"]), tuple(rows), 3, name=texts.data_table.format(), key="data"
    )
    if further:
        yield sentences(texts.further.format(facts="; ".join(further)))
    if report.has(PartName.FORCES):
        yield from (sentences(*told) for told in (_loads(report), [*_further_data(report)]) if told)
        yield from _load_tables(report)
    caption = texts.scheme.format(position=report.in_position)
    yield figure(
        lambda letter: scheme_picture(report.one, 0, PictureStyle(letter)), caption, "scheme"
    )


def _tasks(report: Report) -> Iterator[Rich]:
    tasks: MessageTable = report.texts["front"]["tasks"]
    if report.has(PartName.SYNTHESIS):
        yield tasks.synthesis.format()
    yield tasks.structure.format()
    yield tasks.kinematics.format()
    yield tasks.motion.format()
    if report.every.problem.cycle is not None:
        yield tasks.cycle.format()
    for name in _FURTHER:
        if report.has(name) and name is not PartName.SYNTHESIS:
            balancing = _balanced(report)
            yield str(tasks[name.value]).format(balancing=balancing)
            if name is PartName.FORCES and rubbed(report.every.problem):
                yield tasks.friction.format()


def _balanced(report: Report) -> Rich:
    """Return what balances the driving links, which is to be found."""
    said: MessageTable = report.texts["balancing"]
    problem = report.one.problem
    kinds = {one.balancing.quantity for one in problem.drive.every}
    if not problem.drive.other_drives:
        return str(said[problem.balancer.quantity])
    return str(said["several"][kinds.pop() if len(kinds) == 1 else "mixed"])


def _data(report: Report) -> tuple[list[tuple[Rich, Rich, Rich]], list[Rich]]:
    """Return the rows of the data table, and the given facts that are not a lettered number."""
    problem, language = report.one.problem, report.language
    facts = given_facts(problem, language, [float(report.one.positions[0])])
    if report.has(PartName.FORCES):
        facts += mass_lines(problem, language)
    coordinates = {report.coordinate, *(one.coordinate.symbol for one in problem.drive.every)}
    rows: list[tuple[Rich, Rich, Rich]] = []
    further: list[Rich] = []
    series, driving = report.is_series, {**_driving(report), **_outputs(report)}
    listed_facts = (x for x in facts if not any(key.startswith("gears.") for key in x.data))
    stated = {x.text: datum_name(x, report.texts) for x in listed_facts}
    for fact, datum in stated.items():  # the rows of the train are its own
        if not fact:
            continue
        told = _FACT.match(fact)
        name = None if told is None else datum or driving.get(told[1]) or _name(told[1], report)
        if told is None or name is None:
            further.append(fact)
        elif told[1] == _ratio(report) and report.has(PartName.GEARS):
            continue  # it follows from the teeth, in the chapter on gears
        elif not (series and told[1] in coordinates):
            rows.append((lettered(name), told[1], _value(told[2], report)))
    for slide in problem.slides.values():
        if slide.length is not None:
            name = report.texts["quantities"]["length"].format(of=report.link(slide.slider, "of"))
            rows.append((name, f"l_{{{slide.slider}}}", _input_quantity(slide.length, "m", report)))
    if report.has(PartName.FLYWHEEL):
        narrator = MachineNarrator(
            drawing_of(flywheel_of(report.every), report.every.profile), language
        )
        quantities = report.texts["quantities"]
        own = [fact.text for fact in narrator.given_facts() if fact not in facts]
        for fact in own:
            told = _FACT.match(fact)
            if told is not None and told[1] in ("δ", narrator.letter("crank inertia")):
                key = "δ" if told[1] == "δ" else "crank inertia"
                rows.append((str(quantities[key]).format(), told[1], told[2]))
        if narrator.flywheel.machine.cycle_deg != 360.0:
            cycle = with_unit(
                report.notation.as_input(narrator.flywheel.machine.cycle_deg), report.unit("deg")
            )
            rows.append((str(quantities["cycle"]).format(), "Φ", cycle))
        ratio = narrator.flywheel.machine.wheel.ratio
        if ratio != 1.0:
            rows.append(
                (str(quantities["flywheel ratio"]).format(), "i", report.notation.as_input(ratio))
            )
    listed = {symbol for _, symbol, _ in rows}
    return rows + [row for row in _teeth(report) if row[1] not in listed], further


def _input_quantity(value: float, unit: str, report: Report) -> Rich:
    return with_unit(report.notation.as_input(value), report.unit(unit))


def _driving(report: Report) -> dict[Rich, Rich]:
    """Return the names of the letters of the crank's rotational speed, or of its train's."""
    geared, quantities = report.one.problem.drive.gear_drive, report.texts["quantities"]
    if geared is None:
        drive = report.one.problem.drive
        name = str(quantities["n"]).format(of=report.link(drive.link, "of"))
        return {turns_symbol(report.one.problem, report.language): name}
    letter = "n" if geared.unit == "n" else "ω"
    named = {f"{letter}_{{{x}}}": str(quantities[f"{letter}_train"]).format(of=x)
             for x, _ in geared.inputs}  # fmt: skip
    ratio = str(quantities["U"]).format(of=geared.inputs[0][0], to=geared.label)
    return {**named, _ratio(report): ratio}


def _outputs(report: Report) -> dict[Rich, Rich]:
    """Return the names of the rates of outputs that determine those of the driving links."""
    said, found = report.texts["quantities"]["output"], dict[Rich, Rich]()
    for drive in report.one.problem.drive.every:
        rate = drive.output_rate
        for key in () if rate is None else (rate.key, rate.gain_key):
            letter, _, of = key.partition("_")
            if letter in said:
                found[output_symbol(key)] = str(said[letter]).format(of=point_name(of))
    return found


def _ratio(report: Report) -> Rich:
    """Return the letter of the ratio from the input of the train to the crank, as given has it."""
    geared = report.one.problem.drive.gear_drive
    return "" if geared is None else f"U_{{{geared.inputs[0][0]}-{geared.label}}}"


def _teeth(report: Report) -> Iterator[tuple[Rich, Rich, Rich]]:
    """Yield the rows of the train and of the wheels in mesh."""
    quantities, notation = report.texts["quantities"], report.notation

    def row(key: str, symbol: Rich, value: Rich, **facts: object) -> tuple[Rich, Rich, Rich]:
        return str(quantities[key]).format(**facts), symbol, value

    parts = [part.problem for part in report.project.parts]
    train = next((x.train for x in parts if isinstance(x, GearProblem)), None)
    pair = next((x for x in parts if isinstance(x, MeshingProblem)), None)
    ends = None if train is None or pair is None else meshed(train, pair)
    if train is not None:
        for label, wheel in train.wheels.items():
            if wheel.size is not None and train.counted(label):
                yield row("z", f"z_{{{label}}}", notation.as_input(float(wheel.size)), of=label)
        unit = "1/min" if train.unit == "n" else "1/s"
        for body, speed in train.inputs.items():
            symbol = f"{train.letter}_{{{body}}}"
            yield row(
                f"{train.letter}_train",
                symbol,
                _input_quantity(float(speed), unit, report),
                of=body,
            )
        for mesh in train.meshes:
            if mesh.eta is not None:
                eta = notation.as_input(float(mesh.eta))
                yield row("eta_mesh", f"η_{{{mesh.name}}}", eta, of=mesh.name)
        for carrier, count in train.planets.items():
            yield row("satellites", "k", str(count), of=carrier)
        is_told = ends is None or train.wheels[ends[0]].module is not None
        for module, wheels in train.modules.items() if is_told else ():
            labels = ", ".join(label for label in wheels if label not in (ends or ()))
            key = "module" if len(train.modules) == 1 and ends is None else "module_of"
            mm = _input_quantity(float(module) * 1000.0, "mm", report)
            if labels:
                yield row(key, "m", mm, labels=labels)
    if pair is not None:
        if ends is None:
            for k, count in enumerate(pair.z, 1):
                yield row("z_mesh", f"z_{{{k}}}", str(count), of=k)
        told = ends or ("1", "2")
        yield row(
            "module_mesh", "m", _input_quantity(pair.m, "mm", report), one=told[0], other=told[1]
        )


def _value(text: Rich, report: Report) -> Rich:
    """Return a value; of one that is constant that it is."""
    value, const, _ = text.partition(_CONST)
    if report.one.problem.drive.gear_drive is not None:
        value = value.rpartition(" = ")[2]  # the name of the wheel is not part of the value
    return report.texts["front"].constant.format(value=value) if const else value


def _name(symbol: Rich, report: Report) -> Rich | None:
    """Return the name of a letter with its index; None if it does not have one."""
    letter, _, index = symbol.partition("_{")
    index = index.removesuffix("}")
    quantities, problem = report.texts["quantities"], report.one.problem
    for one in given_sizes(problem):
        if one.symbol == symbol:
            ends = (shown_name(problem, name) for name in (one.size.first, one.size.second))
            return str(quantities["size"][one.size.axis]).format(*ends)
    if letter == "J":
        index = index.removeprefix("S")
    if letter in ("x", "y") and index in problem.guides:
        letter += "-"
    sliding = {"" if one is problem.drive else one.link
               for one in problem.drive.every if not one.is_crank}  # fmt: skip
    if letter == "a" and index not in sliding:  # of a guide: how long its slider is
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
    if dynamics is None:
        return []
    narrator = SpringNarrator(report.every.problem, report.language)
    loads = (load for load in dynamics.loads if not isinstance(load.size, Spring))
    return [*(_load(load, report) for load in loads), *map(narrator.sentence, dynamics.springs)]


def _load_tables(report: Report) -> Iterator[Node]:
    """Yield the tables of the loads as in the file, so that the task can be repeated."""
    said, notation = report.texts["front"], report.notation
    dynamics = report.every.problem.dynamics
    for number, load in enumerate(dynamics.loads if dynamics is not None else ()):
        size = load.size
        if not isinstance(size, SizeTable) or size.like is not None:
            continue
        unit, key = report.unit(load.unit), f"load_{number}"
        head: tuple[Rich, ...]
        rows: list[tuple[Rich, ...]]
        if size.indicator is not None:
            told = size.indicator
            both = said.second_side.format(area=report.area(told.area_2)) if told.sides == 2 else ""
            places = {"area": report.area(told.area), "both": both, "key": key}
            yield sentences(said.indicator.format(name=load.name, **places))
            head = tuple(said["columns_indicator"])
            rows = [
                (str(k), notation.as_input(share), notation.as_input(pressure * 1e-6))
                for k, stroke in enumerate(told.strokes, 1)
                for share, pressure in stroke
            ]
        else:
            over = str(said["load_over"][size.over.value])
            steps = size.interpolation is Interpolation.STEP
            template = said.load_steps if steps else said.load_rows
            yield sentences(template.format(name=load.name, key=key))
            head = (over, f"{load.name}, {unit}")
            at = [*size.at] or [float(k) for k in range(len(size.values))]
            rows = [
                (notation.as_input(x), notation.as_input(y))
                for x, y in zip(at, size.values, strict=True)
            ]
        yield Table(head, tuple(rows), 0, name=said.load_data.format(name=load.name), key=key)


def _further_data(report: Report) -> Iterator[Rich]:
    """Yield the balancing force's point, the friction data and the bearings."""
    texts: MessageTable = report.texts["front"]
    problem, notation = report.every.problem, report.notation
    if problem.drive.pushed is not None:
        way = push_direction(problem, report.language.note)
        yield texts.pushed.format(point=mark(problem.drive.pushed.at), way=way)
    if rubbed(problem):
        narrator = FrictionNarrator(lettered_forces(force_reading(report.one, 0), report.language))
        yield texts.friction.format(given="; ".join(narrator.given_lines()))
    for joint, bearing in problem.dynamics.bearings.items() if problem.dynamics else ():
        first, second, plane = (with_unit(notation.as_input(z), report.unit("m"))
                                for z in (*bearing.at, bearing.plane))  # fmt: skip
        yield texts.bearings.format(joint=mark(joint), first=first, second=second, plane=plane)


def _load(load: Load | Couple, report: Report) -> Rich:
    texts: MessageTable = report.texts["front"]["loads"]
    force = isinstance(load, Load)
    match load.size:
        case int() | float():
            value = with_unit(report.notation.short(load.size), report.unit(load.unit))
            size = texts.constant.format(value=value)
        case SizeTable(like=None):
            largest = report.quantity(largest_size(load.size), load.unit)
            size = (texts.table if force else texts.table_couple).format(value=largest)
        case Spring():
            raise AssertionError  # a spring has a sentence of its own
        case SizeTable():
            shift = with_unit(report.notation.as_input(load.size.shift), report.unit("deg"))
            size = texts.like.format(other=load.size.like, shift=shift)
        case _:
            assert_never(load.size)
    against = texts.against if force else texts.against_couple
    sense = against.format() if isinstance(load.sense, Against) else ""
    if isinstance(load.sense, Fixed):
        sense = texts.fixed.format(way=_direction_text(load, load.sense, report))
    moving = None if load.phase is None else load.phase.moving
    facts = {
        "link": report.link(load.link, "on"),
        "symbol": load.name,
        "size": size,
        "sense": sense,
        "phase": str(texts["moving"][moving.value]).format() if moving else "",
    }
    if isinstance(load, Load):
        return texts.force.format(point=load.at, **facts)
    return texts.couple.format(**facts)


def _direction_text(load: Load | Couple, fixed: Fixed, report: Report) -> Rich:
    """Return the direction of a force that is constant on the paper."""
    angle = (fixed.angle + (180.0 if largest_size(load.size) < 0 else 0.0)) % 360.0
    forces = report.language.forces
    quarter = QUARTERS.get(round(angle, 6) % 360.0)
    return (
        forces[quarter] if quarter else forces.way_angle.format(angle=report.notation.short(angle))
    )


# Introduction ------------------------------------------------------------------------------------


def _introduction(report: Report) -> Iterator[Node]:
    said, structure = report.texts["introduction"], report.one.structure
    counts: MessageTable = report.texts["counts"]
    many = structure.moving_links
    links = counts["links"][many] if many < len(counts["links"]) else counts.many.format(count=many)
    yield StructuralHeading(said.title.format())
    others = [str(said["kinds"][name.value]).format() for name in _FURTHER if report.has(name)]
    yield sentences(
        said.object.format(roman=roman(structure.class_number), links=links),
        said.parts.format(parts=report.listed(others)) if others else "",
    )
    ruler = f"{report.notation.as_input(report.one.profile.ruler)}{NBSP}{report.unit('mm')}"
    calculated = said.calculated.format(
        number=report.project.calculated, symbol=report.coordinate, value=report.place
    )
    yield sentences(
        said.way.format(ruler=ruler),
        calculated if report.is_series else "",
        said.drawn.format(),
    )
    books = report.cited_books()
    yield sentences(
        said.books.format(cited=books) if books else "",
        said.standards.format(**report.cited()),
    )
