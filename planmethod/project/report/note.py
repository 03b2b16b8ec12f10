"""The explanatory note: its chapters in order, results and conclusion (записка)."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from math import isfinite

import numpy as np
from msgspec.structs import replace

from planmethod.cams.design import design_of
from planmethod.cams.model import CamProblem
from planmethod.cams.text import sizes
from planmethod.construct.drafting import PROFILES
from planmethod.gears.involute.geometry import MeshingProblem
from planmethod.gears.involute.results import SolvedMeshing
from planmethod.gears.model import GearProblem, parse
from planmethod.mechanism.structure import roman
from planmethod.moving.motion import PointProblem
from planmethod.note import document
from planmethod.note.accounts.machine import MachineAccount
from planmethod.note.accounts.voice import NOTE, sentences
from planmethod.note.compared import ComparedNumber, Series, percent_text
from planmethod.note.document import (
    Document,
    Item,
    Node,
    Part,
    References,
    StructuralHeading,
    Table,
    table_of_columns,
)
from planmethod.note.formula import Rich, escape, inlined
from planmethod.note.narrate.balancing import BalancingNarrator
from planmethod.note.narrate.forces.loads import FrictionNarrator, lettered as lettered_forces
from planmethod.note.numbers import format_column, significant, with_unit
from planmethod.note.series import balance_series, lever_beside_plans, size_series
from planmethod.note.tables.errors import motion_series, relative_series
from planmethod.note.tables.forces import rubbed
from planmethod.note.tables.results import lead_columns
from planmethod.note.wording import Language, MessageTable
from planmethod.plans.build import MOTION_KINDS, kinds_on
from planmethod.plans.model import RATES, PlanKind
from planmethod.problem.quantities import QuantityKind
from planmethod.project.parts import PartName
from planmethod.project.report.context import NBSP, NoteContext, Report
from planmethod.project.report.drivers import balances, superposition_part
from planmethod.project.report.flywheel import balancing_chapter, flywheel_chapter, machine_of
from planmethod.project.report.forces import ForceChapter, largest_reactions
from planmethod.project.report.front import front, title_page
from planmethod.project.report.gears import (
    cam_chapter,
    failed_conditions,
    failed_quality,
    meshing_chapter,
    point_chapter,
    ratios_of,
    train_chapter,
)
from planmethod.project.report.plans import PlanChapter
from planmethod.project.report.position import (
    diagrams_part,
    has_equal_strokes,
    has_turn,
    loads_drive,
    position_part,
    transfer_chapter,
)
from planmethod.project.report.structure import structure_chapter
from planmethod.project.report.synthesis import synthesis_chapter, synthesis_result
from planmethod.project.settle import Homework, Project, SheetEntry
from planmethod.solved.forces.reading import force_reading
from planmethod.solved.solution import Solution
from planmethod.solved.turn.cycle import crank_cycle_of

MANY_SIGMAS = 3.0
"""Sigmas beyond which a difference is named."""

FAINT = 1e-6
"""Fraction of the largest of its kind below which a quantity is negligible."""


def compared(
    solution: Solution, index: int, *kinds: QuantityKind
) -> list[tuple[Series, ComparedNumber]]:
    """Return the quantities of some kinds in a position; those that are something."""
    every = ((series, series[index]) for series in motion_series(solution, *kinds))
    return [
        (series, one)
        for series, one in every
        if np.isfinite(one.read) and abs(one.exact) > FAINT * series.peak
    ]


def worst(
    comparisons: Sequence[tuple[Series, ComparedNumber]],
) -> tuple[Series, ComparedNumber] | None:
    """Return the quantity with the largest relative difference."""
    return max(comparisons, key=lambda pair: pair[1].percent_size, default=None)


def results_parts(report: Report) -> Iterator[Node]:
    """Yield the tables of all positions, and the comparison."""
    texts: MessageTable = report.texts["results"]
    if report.is_series:
        yield Part(texts.part.format())
        yield sentences(texts.intro.format())
        for plan, key in zip(RATES, ("velocities", "accelerations"), strict=True):
            yield _table_by_positions(report, plan, str(texts[key]).format(), key)
    yield Part(texts.compared.format())
    yield from _compared(report, texts)
    if report.is_series:
        yield from _largest(report, texts)


def _table_by_positions(report: Report, plan: PlanKind, name: Rich, key: str) -> Table:
    every = report.every
    lead = lead_columns(every.problem, report.project.positions, report.language.note)
    columns = []
    for series in (*motion_series(every, *kinds_on(plan)), *relative_series(every, plan)):
        values = [float(value) + 0.0 for value in series.read]
        columns.append([series.symbol, *map(report.notation.number, format_column(values))])
    table = table_of_columns([*lead, *columns], repeated=len(lead))
    return Table(table.head, table.rows, 0, len(lead), name=name, key=key)


def _compared(report: Report, texts: MessageTable) -> Iterator[Node]:
    notation = report.notation
    found = compared(report.one, 0, *MOTION_KINDS)
    yield sentences(texts.intro_compared.format(position=report.of_position))
    rows = [
        (
            series.head(notation),
            *notation.numbers(
                one.read_text, one.exact_text, one.off_text, one.percent_text(2), one.sigma_text
            ),
        )
        for series, one in found
        if one.sigma  # given values have no error
    ]
    yield Table(
        tuple(text.format() for text in texts["columns_compared"]),
        tuple(rows),
        name=texts.compared_table.format(position=report.in_position),
        key="compared",
    )
    yield from report.mark_note(rows)
    beyond = [series.symbol for series, one in found if one.sigmas > MANY_SIGMAS]
    most = worst(found)
    yield sentences(
        texts.beyond.format(symbols=", ".join(beyond))
        if beyond
        else texts.within.format(
            most=notation.number(f"{max(one.sigmas for _, one in found) + 0.05:.1f}")
        ),
        ""
        if most is None
        else texts.largest.format(
            symbol=most[0].symbol, percent=notation.number(percent_text(most[1].percent_size))
        ),
    )


def _largest(report: Report, texts: MessageTable) -> Iterator[Node]:
    """Yield the largest difference of each quantity in all positions."""
    every, notation, rows = report.every, report.notation, []
    for series in motion_series(every, *MOTION_KINDS):
        shown = series.displayed(series.exact, range(len(series.exact)))
        peak = float(np.nanmax(np.abs(shown)))
        k = series.furthest
        if k is None or peak == 0.0 or not series[k].sigma:
            continue  # nothing can be read, or it is given
        one, off = series[k], format_column(list(map(abs, series.displayed(series.off, [k]))), 2)
        percent = percent_text(one.percent_of(peak), 2)
        rows.append(
            (
                series.head(notation),
                *notation.numbers(significant(peak), *off, percent, str(k), one.sigma_text),
            )
        )
    yield sentences(texts.all_intro.format())
    yield Table(
        tuple(text.format() for text in texts["columns_all"]),
        tuple(rows),
        name=texts.all_table.format(),
        key="largest",
    )
    yield from report.mark_note(rows)


MUCH = 10.0
"""Per cent of a difference of the lever above which the text explains it."""


def conclusion(report: Report) -> Iterator[Node]:
    """Yield the results of the project, with numbers."""
    texts: MessageTable = report.texts["conclusion"]
    yield StructuralHeading(texts.title.format())
    yield sentences(texts.intro.format())
    found = [
        synthesis_result(report) if report.has(PartName.SYNTHESIS) else "",
        _structure(report, texts),
        _motion(report, texts),
        *_turn(report, texts),
        *(_forces(report, texts) if report.has(PartName.FORCES) else ()),
        *(_flywheel(report, texts) if report.has(PartName.FLYWHEEL) else ()),
        *(_balancing(report, texts) if report.has(PartName.BALANCING) else ()),
        *_gears(report, texts),
        *_meshing(report, texts),
        *_cam(report, texts),
    ]
    for number, text in enumerate(filter(None, found), 1):
        yield Item(inlined(text), f"{number})")


def _structure(report: Report, texts: MessageTable) -> Rich:
    structure = report.one.structure
    template = (
        texts.structure
        if structure.mobility - structure.local_mobility == 1
        else texts.structure_many
    )
    return template.format(
        w=structure.mobility, roman=roman(structure.class_number), formula=structure.formula
    )


def _motion(report: Report, texts: MessageTable) -> Rich:
    notation, facts = report.notation, {}
    for plan in RATES:
        name, found = plan.value, worst(compared(report.one, 0, *kinds_on(plan)))
        if found is None:
            return ""
        series, most = found
        facts[name] = series.symbol
        facts[f"{name}_percent"] = notation.number(percent_text(most.percent_size))
        facts[f"{name}_sigmas"] = notation.number(f"{most.sigmas:.1f}")
    later = float(facts["acceleration_percent"].replace(notation.decimal, "."))
    earlier = float(facts["velocity_percent"].replace(notation.decimal, "."))
    text = texts.motion.format(position=report.in_position, **facts)
    return f"{text} {texts.why.format()}" if later > earlier else text


def _turn(report: Report, texts: MessageTable) -> Iterator[Rich]:
    if not has_turn(report):
        return
    turn, strokes = crank_cycle_of(report.every), report.project.strokes
    told = []
    if turn.stroke:
        slides = turn.output.slide is not None
        size = report.quantity(turn.stroke, "m") if slides else report.degrees(turn.stroke)
        told.append(str(texts["stroke"][turn.output.unit]).format(stroke=size))
    if strokes is not None and strokes.K_v is not None:
        form = (
            "equal" if has_equal_strokes(strokes) else "drives" if loads_drive(report) else "usual"
        )
        told.append(
            str(texts["ratio"][form]).format(
                working=report.degrees(strokes.working_deg),
                idle=report.degrees(strokes.idle_deg),
                ratio=report.notation.computed(strokes.K_v),
            )
        )
    yield " ".join(told)


def _forces(report: Report, texts: MessageTable) -> Iterator[Rich]:
    reading, notation = force_reading(report.one, 0), report.notation
    joints = reading.statics.reactions
    most = max(joints, key=lambda joint: abs(complex(joint.force[0])))
    size, balance = size_series(reading.statics, most), balance_series(reading.statics)
    (*_, whole) = "", *largest_reactions(report)
    found = [(notation.symbol(balance.symbol), float(balance.read[0]), balance.unit)]
    found += [
        (symbol, read, other.balancing.unit) for other, symbol, read, _ in balances(report, reading)
    ]
    told = [f"{symbol} = {report.quantity(abs(read), unit)}" for symbol, read, unit in found]
    text = (texts.forces if len(found) == 1 else texts.forces_several).format(
        balances=report.listed(told),
        position=report.in_position,
        symbol=size.symbol,
        value=report.quantity(float(size.read[0]), size.unit),
        name=texts["balancing"][reading.balancing.quantity],
        balancing=notation.symbol(balance.symbol),
        balance=report.quantity(abs(float(balance.read[0])), balance.unit),
    )
    yield f"{text} {whole}".rstrip()
    if rubbed(report.every.problem):
        narrator = FrictionNarrator(lettered_forces(reading, report.language), sizes=True)
        yield " ".join([texts.friction.format(), *narrator.results(), *narrator.cycle_lines()])
    lever = lever_beside_plans(reading.statics)
    both = None if lever is None else lever[0]
    if both is None or both.percent is None or both.expected is None or not isfinite(both.sigma):
        return
    share, part = both.percent_size, both.expected
    template = texts.lever_far if share > MUCH and share < 3.0 * part else texts.lever
    yield template.format(
        share=notation.number(percent_text(share)), sigma=notation.number(percent_text(part))
    )


def _flywheel(report: Report, texts: MessageTable) -> Iterator[Rich]:
    narrator, notation = machine_of(report), report.notation
    sizes, inertia = narrator.sizes, narrator.inertia
    if inertia.exact <= 0.0 or sizes is None:
        yield MachineAccount(narrator, NOTE).not_needed
        return
    main = texts.flywheel.format(
        delta=narrator.delta,
        symbol=narrator.letter("flywheel"),
        value=report.quantity(narrator.drawing.adopted, "kg·m²"),
        whole=notation.number(percent_text(inertia.percent_size)),
    )
    size = texts.flywheel_sizes.format(
        diameter=with_unit(notation.as_input(sizes.diameter), report.unit("m")),
        width=report.quantity(sizes.width, "m"),
        mass=report.quantity(sizes.mass, "kg"),
    )
    yield f"{main} {size}"


def _balancing(report: Report, texts: MessageTable) -> Iterator[Rich]:
    narrator = BalancingNarrator(report.every, report.language)
    weights = [one for one in narrator.balancing.counterweights if one.mass]
    told = [
        texts.counterweight.format(link=one.link, mass=report.quantity(one.mass, "kg"))
        for one in weights
    ]
    before, after = narrator.balancing.largest
    size = report.quantity(0.0 if after < 1e-9 * before else after, "N")
    listed = report.listed(told) if told else ""
    template = texts.balancing_part if told else texts.balancing_none
    yield template.format(weights=listed, before=report.quantity(before, "N"), after=size)


def _gears(report: NoteContext, texts: MessageTable) -> Iterator[Rich]:
    part = report.part(PartName.GEARS)
    if part is None or not isinstance(part.problem, GearProblem):
        return
    ratios, failed = ratios_of(part.problem, report), failed_conditions(part.problem, report)
    if ratios:
        form = "one" if len(ratios) == 1 else "many"
        yield str(texts["gears"][form]).format(ratios=report.listed(ratios))
    if failed:
        form = "one" if len(failed) == 1 else "many"
        yield str(texts["failed"][form]).format(conditions="; ".join(failed))


def _meshing(report: NoteContext, texts: MessageTable) -> Iterator[Rich]:
    part = report.part(PartName.MESHING)
    if part is None or not isinstance(part.problem, MeshingProblem):
        return
    solved, problem = SolvedMeshing(part.problem), part.problem
    x1, x2 = (report.notation.as_input(round(x, 4)) for x in problem.x)
    text = texts.meshing.format(
        z1=problem.z[0],
        z2=problem.z[1],
        x1=x1,
        x2=x2,
        a_w=with_unit(report.notation.number(f"{abs(solved.pair.a_w):.3f}"), report.unit("mm")),
        epsilon=report.notation.number(f"{solved.contact.overlap(solved.pair):.3f}"),
    )
    failed = failed_quality(part.problem, report)
    shifted = str(texts["failed"]["shifted"]).format(conditions="; ".join(failed))
    yield f"{text} {shifted}" if failed else text


def _cam(report: NoteContext, texts: MessageTable) -> Iterator[Rich]:
    part = report.part(PartName.CAM)
    if part is not None and isinstance(part.problem, CamProblem):
        table = sizes(design_of(part.problem), report.language)
        unit = report.unit("mm")
        listed = ", ".join(f"{symbol} = {value}{NBSP}{unit}" for _, symbol, value in table.rows)
        yield texts.cam.format(sizes=listed)


def _sources(report: NoteContext) -> Iterator[Node]:
    yield StructuralHeading(report.texts["back"]["sources"].format())
    yield References(tuple(report.sources.values()))


def back(report: Report, sheets: Sequence[SheetEntry]) -> Iterator[Node]:
    """Yield the sources and the list of sheets; of parts, where no sheet is drawn."""
    texts: MessageTable = report.texts["back"]
    yield from _sources(report)
    yield StructuralHeading(texts.sheets.format())
    parts = _parts(report, texts["names"])
    rows: list[tuple[Rich, ...]] = [
        (str(one.number), escape(one.title), one.paper.written(report.language.frame.paper))
        for one in sheets
    ] or [(str(number), name) for number, name in enumerate(parts, 1)]
    if len(rows) == 1:
        (only, *_) = parts
        yield sentences(texts.sheet_text.format(sheet=f"{only[0].lower()}{only[1:]}"))
        return
    yield sentences((texts.sheets_text if sheets else texts.parts_text).format())
    yield Table(
        tuple(texts["columns_sheets" if sheets else "columns_parts"]),
        tuple(rows),
        2,
        name=texts.sheets_table.format(),
        key="sheets",
    )


def _parts(report: Report, names: MessageTable) -> list[Rich]:
    """Return the names of the parts of the drawings."""
    keys = [part.name.value for part in report.project.parts]
    one = f"{PartName.KINEMATICS.value}_one"
    if not has_turn(report):
        keys = [one if key == PartName.KINEMATICS.value else key for key in keys]
    return [str(names[key]).format() for key in keys]


def note_document(
    project: Project | Homework, language: Language, sheets: Sequence[SheetEntry] = ()
) -> Document:
    """Return the explanatory note of a project (пояснительная записка).

    It has the chapters that the file has something for; its numbers are those of the sheets.

    Parameters
    ----------
    project : Project or Homework
    language : Language
    sheets : sequence of SheetEntry
        The sheets of the project where they are drawn; else the parts are listed.

    Raises
    ------
    PositionError
        Where the mechanism cannot be assembled or a force plan does not close.
    """
    units = sorted(set(language.note["units"].values()), key=len, reverse=True)
    tie = re.compile(rf"(?<=\d) (?=(?:{'|'.join(map(re.escape, units))}|%)(?![^\W\d_]))")
    if isinstance(project, Homework):
        nodes = _homework_nodes(project, language)
    else:
        nodes = _nodes(Report(project, language), sheets)
    return Document.of(_tied(node, tie) for node in nodes)


def _nodes(report: Report, sheets: Sequence[SheetEntry]) -> Iterator[Node]:
    yield from front(report)
    for node in _chapters(report):
        if isinstance(node, document.Chapter):
            yield document.PageBreak()
        yield node
    yield from conclusion(report)
    yield from back(report, sheets)


def _chapters(report: Report) -> Iterator[Node]:
    if report.has(PartName.SYNTHESIS):
        yield from synthesis_chapter(report)
    yield from structure_chapter(report)
    yield from position_part(report)
    for kind in RATES:
        yield from PlanChapter(report, kind).nodes()
    yield from superposition_part(report)
    yield from results_parts(report)
    if has_turn(report):
        yield from diagrams_part(report)
    yield from transfer_chapter(report)
    task = report.one.problem.project
    if task is not None and task.centres:
        from planmethod.note.tables.centres import centres_chapter

        yield from centres_chapter(report.one, 0, report.language)
    if task is not None and task.analytic:
        from planmethod.note.accounts.projections import analytic_chapter

        yield from analytic_chapter(report.one, 0, report.language, NOTE)
    if report.has(PartName.FORCES):
        yield from ForceChapter(report).nodes()
    if report.has(PartName.FLYWHEEL):
        yield from flywheel_chapter(report)
    if report.has(PartName.BALANCING):
        yield from balancing_chapter(report)
    yield from _further_chapters(report)


def _further_chapters(report: NoteContext) -> Iterator[Node]:
    """Yield the chapters on the parts that are not of a linkage."""
    for part in report.project_parts:
        if isinstance(part.problem, GearProblem):
            yield from train_chapter(report, part.problem)
        elif isinstance(part.problem, MeshingProblem):
            yield from meshing_chapter(report, part.problem)
        elif isinstance(part.problem, CamProblem):
            yield from cam_chapter(report, part.problem)


def _homework_nodes(homework: Homework, language: Language) -> Iterator[Node]:
    """Yield the note of a homework without a linkage: its data, its chapter, the results."""
    problem = homework.problem
    report = NoteContext(problem, homework.parts, PROFILES["board"], language)
    texts, cited = report.texts["front"], report.cited()
    yield title_page(report)
    yield StructuralHeading(texts["assignment"].format())
    facts = homework.kind.given_facts(problem, language)
    given = language.note.given.format(given="; ".join(fact.text for fact in facts))
    taken = texts["taken"].format(own=cited["own"]) if "own" in cited else ""
    asked = ""
    if isinstance(problem, GearProblem) and problem.train.ask:
        known = tuple(problem.train.body_of)
        symbols = (parse(name, known).symbol for name in problem.train.ask)
        asked = f"{language.gears.asked}: {', '.join(symbols)}."
    yield replace(sentences(taken, given, asked), facts=tuple(facts))
    yield document.PageBreak()
    yield document.Contents()
    chapters = (
        point_chapter(report, problem)
        if isinstance(problem, PointProblem)
        else _further_chapters(report)
    )
    for node in chapters:
        if isinstance(node, document.Chapter):
            yield document.PageBreak()
        yield node
    said: MessageTable = report.texts["conclusion"]
    found = [*_gears(report, said), *_meshing(report, said), *_cam(report, said)]
    if found:
        yield StructuralHeading(said.title.format())
        yield sentences(said.intro.format())
    for number, text in enumerate(found, 1):
        yield Item(inlined(text), f"{number})")
    yield from _sources(report)


def _tied(node: Node, tie: re.Pattern[str]) -> Node:
    """Return a node in whose texts numbers and their units stay together, with one kind of dash."""

    def tied(text: Rich) -> Rich:
        return tie.sub(NBSP, text).replace(" — ", f"{NBSP}– ")

    match node:
        case document.Paragraph() | document.Item() | document.Formula() | document.Note():
            return replace(node, text=tied(node.text))
        case document.Step():
            return replace(node, lines=tuple(map(tied, node.lines)))
        case document.Figure():
            return replace(node, caption=tie.sub(NBSP, node.caption))
        case _:
            return node
