"""Kinematic diagrams, hodographs, transfer functions (диаграммы, годографы, аналоги)."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import degrees

from planmethod.note.document import Chapter, Node, Part, Table
from planmethod.note.formula import Rich, fraction
from planmethod.note.narrate.cycle import NO_ANGLE, diagram_scales, output_name, output_symbol
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.narrate.statement import point_name
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
from planmethod.problem.graphs import GraphQuantity
from planmethod.project.report.context import Report, chain, displayed, sentences
from planmethod.project.report.figures import figure
from planmethod.render.layout.block import Picture
from planmethod.render.pictures.kinematic import kinematic_picture
from planmethod.render.sheets.graphs import graph_groups, graph_picture
from planmethod.render.sheets.turn import hodograph
from planmethod.solved.transfers import Transfers, transfers_of
from planmethod.solved.turn.cycle import TURN, crank_cycle_of
from planmethod.solved.turn.diagrams import diagrams_of

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
