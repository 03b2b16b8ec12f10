"""Kinematic diagrams, hodographs, transfer functions (диаграммы, годографы, аналоги)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.document import Chapter, Node, Part, Table
from planmethod.note.formula import Rich
from planmethod.note.narrate.given import point_name
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.narrate.turn import NO_ANGLE, diagram_scales, output_name, output_symbol
from planmethod.note.numbers import in_heads, with_unit
from planmethod.note.tables.turn import Columns, cycle_columns, deviation_columns
from planmethod.note.wording import Words
from planmethod.plans.model import RATES
from planmethod.project.report.context import Report, displayed, sentences
from planmethod.project.report.figures import WIDTH, figure
from planmethod.render.pictures.kinematic import kinematic_picture
from planmethod.render.sheets.turn import hodograph
from planmethod.solved.turn.diagrams import diagrams_of
from planmethod.solved.turn.turn import turn_of

SIDE = 100.0
"""Side of the square that a hodograph fills, mm."""


def has_turn(report: Report) -> bool:
    """Tell whether the file asks for a cycle."""
    problem = report.every.problem
    return problem.cycle is not None and problem.drive.is_crank


def diagrams_part(report: Report) -> Iterator[Node]:
    """Yield how the kinematic diagrams are made."""
    said: Words = report.said["turn"]
    diagrams, words = diagrams_of(report.every), report.words
    turn, task, say = diagrams.turn, diagrams.task, report.say
    output, drive = turn.output, report.every.problem.drive
    symbol, of = output_symbol(output), output_name(output)
    yield Part(said.part.format())
    yield sentences(
        str(said["path"][output.unit]).format(symbol=symbol, of=of),
        said.axes.format(length=_mm(report, task.length), count=diagrams.count),
    )
    yield displayed(_axis(report))
    scales = diagram_scales(diagrams, words)[:3]
    yield sentences(
        said.ordinates.format(scale=scales[0]),
        str(said["ways"][task.differentiation.value]).format(pole=_mm(report, task.pole.v)),
    )
    yield sentences(said.again.format(pole=_mm(report, task.pole.a)))
    for text in _derived(report):
        yield displayed(text)
    if drive.acceleration:
        yield sentences(said.even.format(link=drive.link))
    shown = report.said["turn"]["whose"][output.unit].format(name=of)
    yield figure(
        lambda letter: kinematic_picture(diagrams, letter, say),
        said.figure.format(of=shown, scales="; ".join(scales)),
        "diagrams",
    )
    ruler = report.say.given(report.every.profile.ruler)
    yield sentences(said.deviations.format(ruler=f"{ruler} {report.unit('mm')}"))
    name = said.deviations_table.format()
    (way, _, ways), (_, _, letters), *others = deviation_columns(diagrams, words)
    columns = [(way, "", ways), (said.diagram.format(), "", letters), *others]
    yield _table(columns, report, name, "deviations", names=2)
    yield from _hodographs(report, said)


def _mm(report: Report, value: float) -> Rich:
    return with_unit(report.say.given(value), report.unit("mm"))


def _axis(report: Report) -> Rich:
    """Return the scale of the angles and that of time, with numbers."""
    diagrams, say = diagrams_of(report.every), report.say
    length, rate = say.given(diagrams.task.length), abs(report.every.problem.drive.rate)
    rad, mm, s = (report.unit(name) for name in ("rad", "mm", "s"))
    angle = f"μ_{{φ}} = 2π/{length} = {say.found(diagrams.mu_phi)} {rad}/{mm}"
    if not rate:
        return f"{angle}."
    omega = f"ω_{{{report.every.problem.drive.link}}}"
    phi, speed = say.found(diagrams.mu_phi), say.found(rate)
    time = say.found(diagrams.mu_phi / rate)
    return f"{angle},  μ_{{t}} = μ_{{φ}}/{omega} = {phi}/{speed} = {time} {s}/{mm}."


def _derived(report: Report) -> Iterator[Rich]:
    """Yield the scales of velocity and acceleration with numbers."""
    diagrams, say = diagrams_of(report.every), report.say
    rate = abs(report.every.problem.drive.rate)
    if not rate:
        return
    convention = report.every.problem.scales.convention
    first, *others = diagrams.scales[:3]
    before, poles = first, (diagrams.task.pole.v, diagrams.task.pole.a)
    inverse = report.names.is_inverse_scale()
    for number, (scale, pole) in enumerate(zip(others, poles, strict=True), 1):
        one, two = (f"μ_{{{x.symbol.removeprefix('mu_')}}}" for x in (before, scale))
        told = scale_inscription(scale, convention, say).partition(" = ")[2]
        end = "." if number == len(others) else ","
        if inverse:
            yield f"{two} = {told}{end}"
        else:
            time = say.found(diagrams.mu_phi / rate)
            sides = f"{say.given(before.per_mm)}/({time}·{say.given(pole)})"
            yield f"{two} = {one}/(μ_{{t}}·K_{{{number}}}) = {sides} = {told}{end}"
        before = scale


def _hodographs(report: Report, said: Words) -> Iterator[Node]:
    made = {kind: hodograph(report.every, kind, SIDE) for kind in RATES}
    yield Part(said.hodographs.format())
    point = point_name(next(iter(made.values())).point)
    yield sentences(said.hodograph_text.format(of=point))
    for kind, one in made.items():
        caption = str(said["hodograph"][kind.value]).format(of=point)
        yield figure(one.picture, caption, f"hodograph.{kind.value}", room=(WIDTH, 110.0))


def transfer_chapter(report: Report) -> Iterator[Node]:
    """Yield the chapter on transfer functions."""
    said: Words = report.said["turn"]
    diagrams = diagrams_of(report.every)
    turn, drive = turn_of(report.every), report.every.problem.drive
    symbol = output_symbol(turn.output)
    index, link = symbol.partition("_")[2], drive.link
    v, a = ("v", "a") if turn.output.slide is not None else ("ω", "ε")
    yield Chapter(said.transfer.format())
    yield sentences(said.transfer_text.format(symbol=symbol))
    yield displayed(
        f"{v}_{{q}} = d{symbol}/dφ_{{{link}}},  {a}_{{q}} = d^{{2}}{symbol}/dφ_{{{link}}}^{{2}}."
    )
    yield sentences(said.transfer_true.format())
    yield displayed(
        f"{v}_{index} = {v}_{{q}}·ω_{{{link}}},  "
        f"{a}_{index} = {a}_{{q}}·ω_{{{link}}}^{{2}} + {v}_{{q}}·ε_{{{link}}}."
    )
    even = said.transfer_table_even if drive.acceleration else said.transfer_table_text
    yield sentences(even.format())
    columns = cycle_columns(diagrams, report.words)
    yield _table(columns, report, said.transfer_table.format(), "transfer", names=1)
    peak = turn.pressure
    if peak is not None and abs(peak.most) > NO_ANGLE:
        place = f"{report.coordinate} = {report.degrees(round(peak.most_at % 360.0, 2) % 360.0)}"
        yield sentences(said.pressure.format(most=report.degrees(peak.most), most_at=place))


def _table(columns: Columns, report: Report, name: Rich, key: str, *, names: int) -> Table:
    """Return columns as a table with a name."""
    told = [
        (f"{head}, {unit}" if unit else head, cells)
        for head, unit, cells in in_heads(columns, report.say)
    ]
    rows = zip(*(cells for _, cells in told), strict=True)
    return Table(tuple(head for head, _ in told), tuple(rows), names, names, name=name, key=key)
