"""The position plan, extreme positions, kinematic diagrams, hodographs (план положений)."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import degrees

from planmethod.construct.steps import AtAngle, Step
from planmethod.mechanism.model import FRAME
from planmethod.note.accounts.voice import chain, displayed, lettered, sentences
from planmethod.note.document import Chapter, Node, Part, Table, input_text
from planmethod.note.formula import Rich, fraction
from planmethod.note.narrate.cycle import (
    NO_ANGLE,
    construction_facts,
    diagram_scales,
    output_name,
    output_symbol,
)
from planmethod.note.narrate.figure import figure_sentences
from planmethod.note.narrate.naming import point_name, scale_inscription
from planmethod.note.narrate.sizes import laid_off_sizes
from planmethod.note.narrate.transfers import TransferNarrator
from planmethod.note.numbers import half_up, in_heads, with_unit
from planmethod.note.tables.cycle import (
    Columns,
    cycle_columns,
    deviation_columns,
    transfer_columns,
)
from planmethod.note.wording import MessageTable
from planmethod.plans.model import RATES, PlanKind
from planmethod.problem.machine_records import GraphQuantity, Zero
from planmethod.project.report.context import Report, figure
from planmethod.project.report.drivers import named_links
from planmethod.project.report.theory import definitions
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.kinematic import kinematic_picture
from planmethod.render.pictures.planview import PictureStyle
from planmethod.render.pictures.seriesview import series_picture
from planmethod.render.sheets.graphs import graph_groups, graph_picture
from planmethod.render.sheets.turn import hodograph
from planmethod.solved.quantities import Transfers, transfers_of
from planmethod.solved.turn.cycle import TURN, CrankCycle, crank_cycle_of
from planmethod.solved.turn.diagrams import diagrams_of
from planmethod.solved.turn.extremes import PRIMES, extreme_construction
from planmethod.solved.turn.output import LONGER, TOLD, Strokes, powers, sample_positions

EQUAL = 1e-6
"""Difference of K_v from 1 up to which both strokes take the same time."""


def position_part(report: Report) -> Iterator[Node]:
    """Yield the heading of kinematics and the position plan."""
    texts: MessageTable = report.texts["position"]
    yield Chapter(texts.title.format())
    yield from definitions(report)
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
        form, places = texts.turned, [report.place_of(k) for k in range(count)]
        if problem.drive.other_drives:
            form = texts.turned_several
            places = [f"({report.coordinate} = {place})" for place in places]
        links = named_links(report)
        yield sentences(form.format(count=count, positions=", ".join(places), links=links))


def _series_figure(report: Report, texts: MessageTable) -> Node:
    """Return the picture of all positions."""
    every = report.every
    indices = tuple(range(len(every.positions)))
    return figure(
        lambda letter: series_picture(
            every, report.project.calculated, indices, PictureStyle(letter)
        ),
        texts.series.format(scale=report.scale(PlanKind.POSITION)),
        "series",
        height=190.0,
    )


def _building(report: Report, texts: MessageTable) -> Iterator[Node]:
    """Yield the construction of the calculated position, group by group."""
    narrator, problem = report.narrator, report.one.problem
    sections = [s for s in report.one.construction.sections if s.kind is PlanKind.POSITION]
    if problem.drawn is not None:
        yield sentences(*figure_sentences(report.one, report.language))
    for section in sections:
        for step in section.steps:
            narrator.narrate(step)  # lengths are computed once: here the table has them
    if report.is_series:
        number, symbol = report.project.calculated, report.coordinate
        yield sentences(texts.building.format(number=number, symbol=symbol, value=report.place))
    for section in sections:
        lines = [line for step in section.steps for line in _describe_step(step, report, texts)]
        if section.frame:
            lines = [_fixed(report), *lines] if problem.bodies[FRAME].points else lines
            lead = ""
        else:
            links = () if section.group is None else section.group.links
            lead = (
                texts.group.format(links="–".join(links))
                if links
                else (texts.drivers if problem.drive.other_drives else texts.driver).format(
                    link=problem.drive.link, links=named_links(report)
                )
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
    fixed = report.language.note.fixed_points.format(points=", ".join(points))
    return " ".join((fixed, *map(lettered, laid_off_sizes(report.formulas))))


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


SIDE = 100.0
"""Side of the square that a hodograph fills, mm."""


def has_turn(report: Report) -> bool:
    """Return whether the file requests a cycle."""
    problem = report.every.problem
    return problem.cycle is not None and problem.drive.is_crank


def diagrams_part(report: Report) -> Iterator[Node]:
    """Yield the construction of the kinematic diagrams."""
    texts: MessageTable = report.texts["turn"]
    diagrams, language = diagrams_of(report.every), report.language
    turn, task, notation = diagrams.cycle, diagrams.task, report.notation
    output, drive = turn.output, report.every.problem.drive
    symbol, of = output_symbol(output), output_name(output)
    yield Part(texts.part.format())
    shown = texts["whose"][output.unit].format(name=of)
    yield sentences(
        texts.shown.format(of=shown),
        str(texts["path"][output.unit]).format(symbol=symbol, of=of),
        texts.axes.format(
            whole=str(texts["whole"]["turn" if turn.travel == TURN else "cycle"]).format(
                way=report.degrees(turn.travel)
            ),
            length=_mm(report, half_up(diagrams.length, 2)),
            parts=report.parts(diagrams.count),
        ),
    )
    yield displayed(_axis(report))
    if diagrams.mu_t is not None:
        yield displayed(_time(report, diagrams.mu_t))
    scales = diagram_scales(diagrams, language)[:3]
    v, a = (_mm(report, half_up(pole, 2)) for pole in diagrams.poles)
    yield sentences(
        texts.ordinates.format(scale=scales[0]),
        str(texts["ways"][task.differentiation.value]).format(pole=v),
    )
    yield sentences(texts.again.format(pole=a), texts.poles.format() if diagrams.rate else "")
    for text in _poles(report):
        yield displayed(text)
    if drive.acceleration:
        yield sentences(texts.even.format(link=drive.link))
    yield figure(
        lambda letter: kinematic_picture(diagrams, letter, notation),
        texts.figure.format(of=shown, scales="; ".join(scales)),
        "diagrams",
        height=190.0,
    )
    ruler = report.notation.as_input(report.every.profile.ruler)
    yield sentences(
        texts.deviations.format(ruler=f"{ruler} {report.unit('mm')}"),
        texts.deviations_plans.format() if diagrams.plans is not None else "",
        texts.deviations_found.format(),
    )
    name = texts.deviations_table.format()
    (_, _, ways), (_, _, letters), *others = deviation_columns(
        diagrams, language, [task.differentiation]
    )
    columns = [(texts.way.format(), "", ways), (texts.diagram.format(), "", letters), *others]
    yield _table(columns, report, name, "deviations", names=2)
    yield from _hodographs(report, texts)


def _mm(report: Report, value: float) -> Rich:
    return with_unit(report.notation.as_input(value), report.unit("mm"))


def _axis(report: Report) -> Rich:
    """Return the scale of the angles with numbers, by degrees and by radians."""
    diagrams, notation = diagrams_of(report.every), report.notation
    length = notation.as_input(half_up(diagrams.length, 2))
    way, per_mm = diagrams.cycle.travel, degrees(diagrams.mu_phi)
    side = fraction(notation.as_input(round(way, 2)), length)
    rad, mm = (report.unit(name) for name in ("rad", "mm"))
    found = f"{notation.computed(diagrams.mu_phi)} {rad}/{mm}"
    return (
        f"μ_{{φ}} = {side} = {notation.short(per_mm, 4)} {notation.in_head('deg')}/{mm} = {found}."
    )


def _time(report: Report, mu_t: float) -> Rich:
    """Return the scale of the time by that of the angle, with numbers."""
    diagrams, notation = diagrams_of(report.every), report.notation
    omega = f"ω_{{{report.every.problem.drive.link}}}"
    numbers = fraction(notation.computed(diagrams.mu_phi), notation.computed(diagrams.rate))
    unit = "/".join(report.unit(name) for name in ("s", "mm"))
    return f"μ_{{t}} = {fraction('μ_{φ}', omega)} = {numbers} = {notation.computed(mu_t)} {unit}."


def _poles(report: Report) -> Iterator[Rich]:
    """Yield the pole distances by the scales, with numbers."""
    diagrams, notation = diagrams_of(report.every), report.notation
    if not diagrams.rate:
        return
    omega = f"ω_{{{report.every.problem.drive.link}}}"
    speed, phi = notation.computed(diagrams.rate), notation.computed(diagrams.mu_phi)
    scales = diagrams.scales[:3]
    for number, ((one, two), pole) in enumerate(
        zip(pairwise(scales), diagrams.poles, strict=True), 1
    ):
        first, second = (f"μ_{{{x.symbol.removeprefix('mu_')}}}" for x in (one, two))
        letters = fraction(f"{omega}·{first}", f"μ_{{φ}}·{second}")
        above, below = (notation.as_input(float(f"{x.per_mm:.6g}")) for x in (one, two))
        numbers = fraction(f"{speed}·{above}", f"{phi}·{below}")
        sides = "" if report.names.is_inverse_scale() else f"{letters} = {numbers} = "
        end = "." if number == 2 else ","
        yield f"K_{{{number}}} = {sides}{_mm(report, half_up(pole, 2))}{end}"


def _hodographs(report: Report, texts: MessageTable) -> Iterator[Node]:
    made = {kind: hodograph(report.every, kind, SIDE) for kind in RATES}
    yield Part(texts.hodographs.format())
    point = point_name(next(iter(made.values())).point)
    yield sentences(texts.hodograph_text.format(of=point))
    for kind, one in made.items():
        caption = str(texts["hodograph"][kind.value]).format(of=point)
        yield figure(one.picture, caption, f"hodograph_{kind.value}", height=75.0)


def transfer_chapter(report: Report) -> Iterator[Node]:
    """Yield the chapter on transfer functions: by segments of the plans, and over the turn."""
    transfers = transfers_of(report.one)
    if transfers is None:
        return
    yield Chapter(report.texts["turn"].transfer.format())
    yield from _by_segments(report, transfers)
    if has_turn(report):
        yield from _over_the_turn(report)


def _by_segments(report: Report, transfers: Transfers) -> Iterator[Node]:
    """Yield the transfer functions of the calculated position with the segments that give them."""
    said, told = report.texts["turn"], TransferNarrator(report.formulas, transfers)
    facts = {"link": report.one.problem.drive.link, "position": report.in_position}
    yield sentences(said.transfer_first.format(**facts))
    yield from chain(told.formulas(PlanKind.VELOCITY, senses=False))
    yield from _senses(said, told, PlanKind.VELOCITY)
    carried = told.crank_acceleration_lines()
    even = said.transfer_second_even if carried else said.transfer_second
    yield sentences(even.format(**facts))
    if carried:
        yield from chain(carried[:1])
        yield sentences(*carried[1:])
    yield from chain(told.formulas(PlanKind.ACCELERATION, senses=False))
    yield from _senses(said, told, PlanKind.ACCELERATION)


def _senses(texts: MessageTable, narrator: TransferNarrator, plan: PlanKind) -> Iterator[Node]:
    found: dict[Rich, list[Rich]] = {}
    for one in narrator.senses(plan):
        symbols, _, sense = one.rpartition(" – ")
        found.setdefault(sense, []).append(symbols)
    if found:
        senses = (f"{', '.join(symbols)} – {sense}" for sense, symbols in found.items())
        yield sentences(texts.transfer_senses.format(senses="; ".join(senses)))


def _over_the_turn(report: Report) -> Iterator[Node]:
    """Yield the transfer functions of the output, of all points and links, and requested graphs."""
    texts: MessageTable = report.texts["turn"]
    diagrams = diagrams_of(report.every)
    turn, drive = crank_cycle_of(report.every), report.every.problem.drive
    symbol = output_symbol(turn.output)
    index, link = symbol.partition("_")[2], drive.link
    v, a = ("v", "a") if turn.output.slide is not None else ("ω", "ε")
    yield sentences(texts.transfer_text.format(symbol=symbol))
    first = fraction(f"d{symbol}", f"dφ_{{{link}}}")
    second = fraction(f"d^{{2}}{symbol}", f"dφ_{{{link}}}^{{2}}")
    yield displayed(f"{v}_{{q}} = {first},  {a}_{{q}} = {second}.")
    yield sentences(texts.transfer_true.format())
    yield displayed(
        f"{v}_{index} = {v}_{{q}}·ω_{{{link}}},  "
        f"{a}_{index} = {a}_{{q}}·ω_{{{link}}}^{{2}} + {v}_{{q}}·ε_{{{link}}}."
    )
    even = texts.transfer_table_even if drive.acceleration else texts.transfer_table_text
    yield sentences(even.format())
    columns = cycle_columns(diagrams, report.language)
    yield _table(columns, report, texts.transfer_table.format(), "transfer", names=1)
    yield sentences(texts.transfer_all_text.format())
    columns = transfer_columns(diagrams, report.language)
    yield _table(columns, report, texts.transfer_all.format(), "transfer_all", names=1)
    yield from _graphs(report, texts)
    peak = turn.pressure
    if peak is not None and abs(peak.maximum) > NO_ANGLE:
        place = f"{report.coordinate} = {report.degrees(round(peak.maximum_at % 360.0, 2) % 360.0)}"
        yield sentences(texts.pressure.format(most=report.degrees(peak.maximum), most_at=place))


def _graphs(report: Report, texts: MessageTable) -> Iterator[Node]:
    """Yield the graphs of ``[cycle] graphs``, a figure for each diagram."""
    diagrams = diagrams_of(report.every)
    groups = graph_groups(diagrams.cycle, diagrams.task.graphs)
    if groups:
        keys = [f"\\ref{{graph_{k}}}" for k in range(len(groups))]
        yield sentences(texts.graphs_text.format(figures=report.listed(keys)))
    convention = report.every.problem.scales.convention
    for number, group in enumerate(groups):

        def draw(letter: float, group: list[GraphQuantity] = group) -> Picture:
            return graph_picture(diagrams, group, letter, report.language)[0]

        _, scale = graph_picture(diagrams, group, 5.0, report.language)
        caption = texts.graph.format(
            name=report.language.cycle["graphs"][group[0].family],
            scale=scale_inscription(scale, convention, report.notation),
        )
        yield figure(draw, caption, f"graph_{number}", height=75.0)


def _table(columns: Columns, report: Report, name: Rich, key: str, *, names: int) -> Table:
    """Return columns as a table with a name."""
    told = [
        (f"{head}, {unit}" if unit else head, cells)
        for head, unit, cells in in_heads(columns, report.notation)
    ]
    rows = zip(*(cells for _, cells in told), strict=True)
    return Table(tuple(head for head, _ in told), tuple(rows), names, names, name=name, key=key)
