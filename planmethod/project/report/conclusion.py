"""Results of the project, sources, sheets (заключение, источники, перечень листов)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import isfinite

from planmethod.cams.design import CamDesign
from planmethod.cams.model import CamProblem
from planmethod.cams.text import sizes
from planmethod.gears.involute.quantities import SolvedMeshing
from planmethod.gears.involute.sizes import MeshingProblem
from planmethod.gears.model import GearProblem
from planmethod.mechanism.structure import roman
from planmethod.note.compared import percent_text
from planmethod.note.document import Item, Node, References, StructuralHeading, Table
from planmethod.note.force_series import balance_series, lever_beside_plans, size_series
from planmethod.note.formula import Rich, escape, inlined
from planmethod.note.narrate.balancing import BalancingNarrator
from planmethod.note.narrate.forces.common import lettered as lettered_forces
from planmethod.note.narrate.forces.friction import FrictionNarrator
from planmethod.note.numbers import with_unit
from planmethod.note.tables.forces import rubbed
from planmethod.note.wording import MessageTable
from planmethod.plans.legend import kinds_on
from planmethod.plans.model import RATES
from planmethod.project.model import PartName, SheetEntry
from planmethod.project.report.context import NBSP, Report, sentences
from planmethod.project.report.flywheel import machine_of
from planmethod.project.report.forces import largest_reactions
from planmethod.project.report.gears import failed_conditions, failed_quality, ratios_of
from planmethod.project.report.position import has_equal_strokes, loads_drive
from planmethod.project.report.results import compared, worst
from planmethod.project.report.turn import has_turn
from planmethod.solved.forces.reading import force_reading
from planmethod.solved.turn.cycle import crank_cycle_of

MUCH = 10.0
"""Per cent of a difference of the lever above which the text explains it."""


def conclusion(report: Report) -> Iterator[Node]:
    """Yield the results of the project, with numbers."""
    texts: MessageTable = report.texts["conclusion"]
    yield StructuralHeading(texts.title.format())
    yield sentences(texts.intro.format())
    found = [
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
    text = texts.forces.format(
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
    flywheel, sizes, inertia = narrator.flywheel, narrator.sizes, narrator.inertia
    if inertia.exact <= 0.0 or sizes is None:
        yield texts.no_flywheel.format(delta=notation.number(f"{flywheel.delta_reached:.4f}"))
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


def _gears(report: Report, texts: MessageTable) -> Iterator[Rich]:
    part = report.project.part(PartName.GEARS)
    if part is None or not isinstance(part.problem, GearProblem):
        return
    ratios, failed = ratios_of(part.problem, report), failed_conditions(part.problem, report)
    if ratios:
        form = "one" if len(ratios) == 1 else "many"
        yield str(texts["gears"][form]).format(ratios=report.listed(ratios))
    if failed:
        form = "one" if len(failed) == 1 else "many"
        yield str(texts["failed"][form]).format(conditions="; ".join(failed))


def _meshing(report: Report, texts: MessageTable) -> Iterator[Rich]:
    part = report.project.part(PartName.MESHING)
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


def _cam(report: Report, texts: MessageTable) -> Iterator[Rich]:
    part = report.project.part(PartName.CAM)
    if part is not None and isinstance(part.problem, CamProblem):
        table = sizes(CamDesign(part.problem), report.language)
        unit = report.unit("mm")
        listed = ", ".join(f"{symbol} = {value}{NBSP}{unit}" for _, symbol, value in table.rows)
        yield texts.cam.format(sizes=listed)


def back(report: Report, sheets: Sequence[SheetEntry]) -> Iterator[Node]:
    """Yield the sources and the list of sheets; of parts, where no sheet is drawn."""
    texts: MessageTable = report.texts["back"]
    yield StructuralHeading(texts.sources.format())
    yield References(tuple(report.sources.values()))
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
