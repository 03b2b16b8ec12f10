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
from planmethod.note.compared import ComparedNumber, percent_text
from planmethod.note.document import Item, Node, References, StructuralHeading, Table
from planmethod.note.formula import Rich, escape, inlined
from planmethod.note.narrate.balancing import BalancingTeller
from planmethod.note.narrate.forces.common import lettered as lettered_forces
from planmethod.note.narrate.forces.friction import FrictionTeller
from planmethod.note.narrate.forces.lever import both_balances, compared_balances
from planmethod.note.numbers import with_unit
from planmethod.note.tables.forces import rubbed
from planmethod.note.wording import Words
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
from planmethod.solved.errors.forces import drawn_forces, size_label
from planmethod.solved.forces.reading import force_reading
from planmethod.solved.turn.turn import turn_of

MUCH = 10.0
"""Per cent of a difference of the lever above which the text explains it."""


def conclusion(report: Report) -> Iterator[Node]:
    """Yield the results of the project, with numbers."""
    said: Words = report.said["conclusion"]
    yield StructuralHeading(said.title.format())
    yield sentences(said.intro.format())
    found = [
        _structure(report, said),
        _motion(report, said),
        *_turn(report, said),
        *(_forces(report, said) if report.has(PartName.FORCES) else ()),
        *(_flywheel(report, said) if report.has(PartName.FLYWHEEL) else ()),
        *(_balancing(report, said) if report.has(PartName.BALANCING) else ()),
        *_gears(report, said),
        *_meshing(report, said),
        *_cam(report, said),
    ]
    for number, text in enumerate(filter(None, found), 1):
        yield Item(inlined(text), f"{number})")


def _structure(report: Report, said: Words) -> Rich:
    structure = report.one.structure
    template = (
        said.structure
        if structure.mobility - structure.local_mobility == 1
        else said.structure_many
    )
    return template.format(
        w=structure.mobility, roman=roman(structure.class_number), formula=structure.formula
    )


def _motion(report: Report, said: Words) -> Rich:
    say, facts = report.say, {}
    for plan in RATES:
        name, found = plan.value, worst(compared(report.one, 0, *kinds_on(plan)))
        if found is None:
            return ""
        quantity, most = found
        facts[name] = quantity.symbol
        facts[f"{name}_percent"] = say.number(percent_text(most.share))
        facts[f"{name}_sigmas"] = say.number(f"{most.sigmas:.1f}")
    later = float(facts["acceleration_percent"].replace(say.decimal, "."))
    earlier = float(facts["velocity_percent"].replace(say.decimal, "."))
    text = said.motion.format(position=report.in_position, **facts)
    return f"{text} {said.why.format()}" if later > earlier else text


def _turn(report: Report, said: Words) -> Iterator[Rich]:
    if not has_turn(report):
        return
    turn, strokes = turn_of(report.every), report.project.strokes
    told = []
    if turn.stroke:
        slides = turn.output.slide is not None
        size = report.quantity(turn.stroke, "m") if slides else report.degrees(turn.stroke)
        told.append(str(said["stroke"][turn.output.unit]).format(stroke=size))
    if strokes is not None and strokes.K_v is not None:
        form = (
            "equal" if has_equal_strokes(strokes) else "drives" if loads_drive(report) else "usual"
        )
        told.append(
            str(said["ratio"][form]).format(
                working=report.degrees(strokes.working_deg),
                idle=report.degrees(strokes.idle_deg),
                ratio=report.say.found(strokes.K_v),
            )
        )
    yield " ".join(told)


def _forces(report: Report, said: Words) -> Iterator[Rich]:
    reading, say = force_reading(report.one, 0), report.say
    joints = reading.statics.reactions
    most = max(joints, key=lambda joint: abs(complex(joint.force[0])))
    read = float(drawn_forces(reading.statics).read(size_label(most))[0])
    plans, _ = both_balances(reading)
    balancing = reading.balancing
    (*_, whole) = "", *largest_reactions(report)
    told = said.forces.format(
        position=report.in_position,
        symbol=report.reaction(most),
        value=report.quantity(read, "N"),
        name=said["balancing"][balancing.quantity],
        balancing=say.symbol(reading.balancing_symbol),
        balance=report.quantity(abs(plans), balancing.unit),
    )
    yield f"{told} {whole}".rstrip()
    if rubbed(report.every.problem):
        tell = FrictionTeller(lettered_forces(reading, report.words), sizes=True)
        yield " ".join([said.friction.format(), *tell.results(), *tell.turn()])
    both = compared_balances(reading.statics, reading.index)
    if both is None or both.percent is None or both.expected is None or not isfinite(both.sigma):
        return
    share, part = both.share, both.expected
    template = said.lever_far if share > MUCH and share < 3.0 * part else said.lever
    yield template.format(
        share=say.number(percent_text(share)), sigma=say.number(percent_text(part))
    )


def _flywheel(report: Report, said: Words) -> Iterator[Rich]:
    tell, say = machine_of(report), report.say
    flywheel, sizes = tell.flywheel, tell.sizes
    exact, read = flywheel.exact.inertia, tell.drawing.read_inertia
    if exact <= 0.0 or sizes is None:
        yield said.no_flywheel.format(delta=say.number(f"{flywheel.delta_reached:.4f}"))
        return
    main = said.flywheel.format(
        delta=tell.delta,
        symbol=tell.letter("flywheel"),
        value=report.quantity(tell.drawing.adopted, "kg·m²"),
        whole=say.number(percent_text(ComparedNumber(exact, read).share)),
    )
    size = said.flywheel_sizes.format(
        diameter=with_unit(say.given(sizes.diameter), report.unit("m")),
        width=report.quantity(sizes.width, "m"),
        mass=report.quantity(sizes.mass, "kg"),
    )
    yield f"{main} {size}"


def _balancing(report: Report, said: Words) -> Iterator[Rich]:
    tell = BalancingTeller(report.every, report.words)
    weights = [one for one in tell.balancing.counterweights if one.mass]
    told = [
        said.counterweight.format(link=one.link, mass=report.quantity(one.mass, "kg"))
        for one in weights
    ]
    before, after = tell.balancing.largest
    size = report.quantity(0.0 if after < 1e-9 * before else after, "N")
    listed = report.listed(told) if told else ""
    template = said.balancing_part if told else said.balancing_none
    yield template.format(weights=listed, before=report.quantity(before, "N"), after=size)


def _gears(report: Report, said: Words) -> Iterator[Rich]:
    part = report.project.part(PartName.GEARS)
    if part is None or not isinstance(part.problem, GearProblem):
        return
    ratios, failed = ratios_of(part.problem, report), failed_conditions(part.problem, report)
    if ratios:
        form = "one" if len(ratios) == 1 else "many"
        yield str(said["gears"][form]).format(ratios=report.listed(ratios))
    if failed:
        form = "one" if len(failed) == 1 else "many"
        yield str(said["failed"][form]).format(conditions="; ".join(failed))


def _meshing(report: Report, said: Words) -> Iterator[Rich]:
    part = report.project.part(PartName.MESHING)
    if part is None or not isinstance(part.problem, MeshingProblem):
        return
    solved, problem = SolvedMeshing(part.problem), part.problem
    x1, x2 = (report.say.given(round(x, 4)) for x in problem.x)
    told = said.meshing.format(
        z1=problem.z[0],
        z2=problem.z[1],
        x1=x1,
        x2=x2,
        a_w=with_unit(report.say.number(f"{abs(solved.pair.a_w):.3f}"), report.unit("mm")),
        epsilon=report.say.number(f"{solved.contact.overlap(solved.pair):.3f}"),
    )
    failed = failed_quality(part.problem, report)
    shifted = str(said["failed"]["shifted"]).format(conditions="; ".join(failed))
    yield f"{told} {shifted}" if failed else told


def _cam(report: Report, said: Words) -> Iterator[Rich]:
    part = report.project.part(PartName.CAM)
    if part is not None and isinstance(part.problem, CamProblem):
        table = sizes(CamDesign(part.problem), report.words)
        unit = report.unit("mm")
        listed = ", ".join(f"{symbol} = {value}{NBSP}{unit}" for _, symbol, value in table.rows)
        yield said.cam.format(sizes=listed)


def back(report: Report, sheets: Sequence[SheetEntry]) -> Iterator[Node]:
    """Yield the sources and the list of sheets; of parts, where no sheet is drawn."""
    said: Words = report.said["back"]
    yield StructuralHeading(said.sources.format())
    yield References(tuple(report.sources.values()))
    yield StructuralHeading(said.sheets.format())
    parts = _parts(report, said["names"])
    rows: list[tuple[Rich, ...]] = [
        (str(one.number), escape(one.title), one.paper.written(report.words.frame.paper))
        for one in sheets
    ] or [(str(number), name) for number, name in enumerate(parts, 1)]
    if len(rows) == 1:
        (only, *_) = parts
        yield sentences(said.sheet_text.format(sheet=f"{only[0].lower()}{only[1:]}"))
        return
    yield sentences((said.sheets_text if sheets else said.parts_text).format())
    yield Table(
        tuple(said["columns_sheets" if sheets else "columns_parts"]),
        tuple(rows),
        2,
        name=said.sheets_table.format(),
        key="sheets",
    )


def _parts(report: Report, names: Words) -> list[Rich]:
    """Return the names of the parts of the drawings."""
    keys = [part.name.value for part in report.project.parts]
    one = f"{PartName.KINEMATICS.value}_one"
    if not has_turn(report):
        keys = [one if key == PartName.KINEMATICS.value else key for key in keys]
    return [str(names[key]).format() for key in keys]
