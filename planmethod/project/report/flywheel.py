"""Chapters on the flywheel and on static balancing (маховик, уравновешивание)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.document import Chapter, Node, Part, Table, table_of_quantities
from planmethod.note.formula import Rich, escape, fraction
from planmethod.note.narrate.balancing import BalancingNarrator, ReductionNarrator
from planmethod.note.narrate.machine import MachineNarrator
from planmethod.note.numbers import MINUS, half_up, in_heads, with_unit
from planmethod.note.wording import MessageTable
from planmethod.problem.machine_records import Quadrature, WheelShape
from planmethod.problem.records import Load, SizeTable
from planmethod.project.report.context import (
    NBSP,
    Report,
    chain,
    displayed,
    figure,
    of_sheet,
    sentences,
)
from planmethod.project.settle import SPEED_TOLERANCE, quick_shaft
from planmethod.render.pictures.flywheel import construction_picture
from planmethod.solved.machine.drawing import drawing_of, split
from planmethod.solved.machine.flywheel import flywheel_of
from planmethod.solved.machine.sizes import density_of

TEXT_WIDTH = 240.0
"""Width of the texts of the sheet, which its diagrams are measured by, mm."""

SMALL = 5e-4
"""Share of the moment of inertia below which a cause of a difference is not named."""


def machine_of(report: Report) -> MachineNarrator:
    """Return the narrator of the machine of a project."""
    flywheel = flywheel_of(report.every)
    return MachineNarrator(drawing_of(flywheel, report.every.profile), report.language)


def flywheel_chapter(report: Report) -> Iterator[Node]:
    """Yield the chapter."""
    texts: MessageTable = report.texts["flywheel"]
    narrator = machine_of(report)
    yield Chapter(texts.title.format())
    yield Part(texts.reduced.format())
    yield from _reduced(report, narrator, texts)
    yield Part(texts.diagrams.format())
    yield from _diagrams(report, narrator, texts)
    yield Part(texts.sizes_title.format())
    yield from _inertia(report, narrator, texts)
    yield Part(texts.power_title.format())
    formulas = narrator.power_formulas()
    yield sentences(str(texts["power"]["motor" if len(formulas) > 1 else "crank"]).format())
    yield from chain(formulas)
    for text in narrator.motor_choice():
        yield sentences(f"{text}.")


def _reduced(report: Report, narrator: MachineNarrator, texts: MessageTable) -> Iterator[Node]:
    J = narrator.letter("reduced inertia")  # noqa: N806 - the letter of the textbook
    yield sentences(texts.about.format())
    omega = f"ω_{{{report.one.problem.drive.link}}}"
    # What resists has a negative power, and counts as positive.
    minus = MINUS if narrator.flywheel.sign > 0 else ""
    yield displayed(texts.moment_formula.format(M=narrator.moment, omega=omega, minus=minus))
    yield displayed(texts.inertia_formula.format(J=J, omega=omega))
    yield sentences(texts.where.format())
    flywheel = narrator.flywheel
    cycle = with_unit(report.notation.as_input(flywheel.machine.cycle_deg), "°")
    lever, count = narrator.letter("moment by lever"), flywheel.machine.count
    yield sentences(texts.cycle.format(cycle=cycle, count=count, lever=lever))
    columns = narrator.columns()
    head = tuple(f"{name}, {unit}" if unit else name for name, unit, _ in columns)
    rows = tuple(zip(*(cells for _, _, cells in columns), strict=True))
    yield Table(head, rows, 1, 2, name=texts.table.format(), key="machine")
    yield from _terms(narrator, texts)
    dynamics = report.one.problem.dynamics
    changing = dynamics is not None and any(
        isinstance(load, Load) and isinstance(load.size, SizeTable) for load in dynamics.loads
    )
    if changing:
        made = of_sheet("load-diagram", report.every, report.language, column=TEXT_WIDTH)
        yield sentences(texts.load_text.format())
        yield figure(made, texts.load_figure.format(), "load", height=90.0)


def _terms(narrator: MachineNarrator, texts: MessageTable) -> Iterator[Node]:
    """Yield the reduced moment and the energies term by term, with their tables."""
    reduction = ReductionNarrator(narrator)
    for key, formulas, columns in (
        ("moments", [reduction.moment_formula()], reduction.moments()),
        ("energies", reduction.energy_formulas(), reduction.energy_columns()),
    ):
        yield sentences(str(texts["terms"][key]).format())
        yield from chain(formulas)
        table = table_of_quantities(columns, repeated=1)
        yield Table(
            table.head, table.rows, 1, 1, name=str(narrator.texts[key]), key=f"machine_{key}"
        )


def _diagrams(report: Report, narrator: MachineNarrator, texts: MessageTable) -> Iterator[Node]:
    drawing, machine, notation = narrator.drawing, narrator.flywheel.machine, report.notation
    scales = drawing.scales
    middle = machine.ordinates is Quadrature.MIDDLE
    letters = {
        "M": narrator.moment,
        "A": narrator.work,
        "J": narrator.letter("reduced inertia"),
        "A_const": narrator.letter(f"{narrator.keeps} work"),
        "M_const": narrator.letter(f"{narrator.keeps} moment"),
    }
    yield sentences(
        texts.moment.format(
            M=letters["M"],
            A=letters["A"],
            mu_M=narrator.scale("M", scales.moment, "N·m"),
            way=str(texts["ways"]["middle" if middle else "trapezoid"]).format(),
            pole=with_unit(notation.as_input(half_up(drawing.pole, 2)), report.unit("mm")),
        )
    )
    yield from _listed(narrator.scale_formulas())
    constant = float(drawing.points.work[-1]) / narrator.flywheel.cycle
    yield sentences(
        texts.constant.format(
            value=report.quantity(constant, "N·m"),
            **{key: letters[key] for key in ("A", "A_const", "M_const")},
        ),
        _by_method(texts, narrator, "energy").format(
            mu_J=narrator.scale("J", scales.inertia, "kg·m²"), J=letters["J"], **_energies(narrator)
        ),
    )
    yield figure(
        lambda letter: construction_picture(drawing, narrator, letter),
        _by_method(texts, narrator, "figure").format(**_energies(narrator)),
        "machine_diagrams",
        height=190.0,
    )


def _by_method(texts: MessageTable, narrator: MachineNarrator, key: str) -> str:
    return str(texts[key][narrator.flywheel.machine.method.value])


def _energies(narrator: MachineNarrator) -> dict[str, str]:
    return {"T_II": narrator.letter("second energy"), "T_I": narrator.letter("first energy")}


def _listed(formulas: list[Rich]) -> Iterator[Node]:
    """Yield formulas that follow each other in a sentence."""
    for k, text in enumerate(formulas, 1):
        yield displayed(f"{text}{'.' if k == len(formulas) else ','}")


def _inertia(report: Report, narrator: MachineNarrator, texts: MessageTable) -> Iterator[Node]:
    drawing, flywheel, notation = narrator.drawing, narrator.flywheel, report.notation
    top, bottom = narrator.tangent_positions
    yield sentences(_by_method(texts, narrator, "sought").format())
    yield from _listed(narrator.sought_formulas())
    segment = drawing.construction.segment
    yield sentences(
        _by_method(texts, narrator, "cut").format(
            top=top,
            bottom=bottom,
            segment=report.mm(narrator.segment.read),
            exact=f"{notation.number(f'{narrator.segment.exact:.2f}')} {report.unit('mm')}",
            **_energies(narrator),
        )
    )
    if drawing.by_mertsalov:
        yield displayed(f"{narrator.largest_change()},")
    symbol, omega = narrator.letter("flywheel"), narrator.letter("mean speed")
    speed = notation.computed(flywheel.middle_speed)
    letters = fraction(f"μ_{{T}}·{segment}", f"{omega}^{{2}}·δ")
    numbers = fraction(
        f"{notation.computed(drawing.scales.work)}·{notation.measured(narrator.segment.read)}",
        f"{speed}^{{2}}·{notation.as_input(flywheel.machine.delta)}",
    )
    value = report.quantity(narrator.inertia.read, "kg·m²")
    yield displayed(f"{symbol} = {letters} = {numbers} = {value}.", "flywheel")
    sigma = f"{notation.short(narrator.inertia.sigma, 2)} {report.unit('kg·m²')}"
    yield sentences(texts.sigma.format(sigma=sigma), *_checked(report, narrator, texts))
    sizes = narrator.sizes
    if sizes is not None:
        yield from _sizes(report, narrator, texts)
    made = of_sheet("speed-diagram", report.every, report.language, column=TEXT_WIDTH)
    yield sentences(texts.speed.format())
    yield figure(made, texts.speed_figure.format(), "speed", height=90.0)


def _checked(report: Report, narrator: MachineNarrator, texts: MessageTable) -> Iterator[Rich]:
    """Yield the error of the construction from the exact flywheel, and the motion check."""
    flywheel, notation = narrator.flywheel, report.notation
    one, unit = narrator.inertia, report.unit("kg·m²")
    delta = notation.number(f"{flywheel.delta_reached:.4f}")
    if one.exact <= 0.0:
        yield texts.not_needed.format(delta=delta)
        return
    parts = split(narrator.drawing)

    def percent(value: float) -> str:
        return notation.number(one.part_text(value, 1))

    causes = {name: getattr(parts, name) for name in ("slopes", "method", "positions", "pencil")}
    told = [
        str(texts["parts"][name]).format(
            value=percent(value), count=narrator.drawing.count, **_energies(narrator)
        )
        for name, value in causes.items()
        if abs(value) > SMALL * one.exact
    ]
    yield _by_method(texts, narrator, "exact").format(
        **_energies(narrator),
        symbol=narrator.letter("flywheel"),
        value=f"{notation.number(one.exact_text)} {unit}",
        whole=percent(one.off),
    )
    if told:
        form = "one" if len(told) == 1 else "many"
        yield str(texts["why"][form]).format(parts=", ".join(told))
    high, low = flywheel.integrated
    per_second = report.unit("1/s")
    yield texts.reached.format(
        delta=delta,
        high=f"{notation.computed(high.value)} {per_second}",
        low=f"{notation.computed(low.value)} {per_second}",
        at_high=narrator.speed_extreme(high),
        at_low=narrator.speed_extreme(low),
    )


def _quicker(report: Report, narrator: MachineNarrator, texts: MessageTable) -> Rich:
    """Return the text on a flywheel on the fast shaft of the train; empty if there is none."""
    shaft = quick_shaft(report.project)
    if (
        shaft is None
        or abs(shaft[1] / narrator.flywheel.machine.wheel.ratio - 1.0) <= SPEED_TOLERANCE
    ):
        return ""
    label, ratio = shaft
    sizes = narrator.on_shaft(ratio)
    assert sizes is not None, "it is needed on the crank"
    return texts.quicker.format(
        link=escape(label),
        ratio=report.notation.short(ratio),
        inertia=narrator.letter("flywheel"),
        value=report.quantity(sizes.inertia, "kg·m²"),
        diameter=with_unit(report.notation.as_input(sizes.diameter), report.unit("m")),
        width=report.quantity(sizes.width, "m"),
        mass=report.quantity(sizes.mass, "kg"),
    )


def _sizes(report: Report, narrator: MachineNarrator, texts: MessageTable) -> Iterator[Node]:
    sizes, notation = narrator.sizes, report.notation
    assert sizes is not None
    disc = sizes.shape is WheelShape.DISC
    held = ""
    if sizes.is_speed_limited:
        limit = notation.as_input(narrator.flywheel.machine.wheel.greatest_speed)
        held = texts.held.format(speed=f"{limit}{NBSP}{report.unit('m/s')}")
    ratio = narrator.flywheel.machine.wheel.ratio
    yield sentences(
        str(texts["on_shaft"]["crank" if ratio == 1.0 else "other"]).format(
            ratio=notation.as_input(ratio),
            inertia=narrator.letter("flywheel"),
            value_of=notation.computed(narrator.drawing.adopted),
            value=report.quantity(sizes.inertia, "kg·m²"),
        ),
        (texts.disc if disc else texts.rim).format(),
    )
    yield from chain(narrator.size_formulas())
    yield sentences(
        texts.made.format(
            density=report.quantity(density_of(narrator.flywheel.machine.wheel), "kg/m³"),
            speed=report.quantity(sizes.speed, "m/s"),
        ),
        held,
        _quicker(report, narrator, texts),
        texts.wheel_text.format(),
    )
    made = of_sheet("flywheel", report.every, report.language, column=130.0)
    yield figure(made, texts.wheel_figure.format(), "wheel", height=90.0)


BALANCING_TEXT_WIDTH = 180.0
"""Width of the texts of the sheet, mm."""

Columns = list[tuple[str, str, list[str]]]


def balancing_chapter(report: Report) -> Iterator[Node]:
    """Yield the chapter."""
    texts: MessageTable = report.texts["weights"]
    narrator = BalancingNarrator(report.every, report.language)
    first, *others = narrator.lines()
    yield Chapter(texts.title.format())
    yield sentences(texts.about.format(), f"{first}.")
    for line in others[:-2]:
        yield sentences(f"{line}.")
    for kind in ("balanced-scheme", "mass-polygons"):
        made = of_sheet(kind, report.every, report.language, column=BALANCING_TEXT_WIDTH)
        yield figure(made, str(texts["figures"][kind]).format(), kind.replace("-", "_"))
    yield sentences(texts.weights_text.format(), *(f"{line}." for line in others[-2:]))
    (_, unit, links), *numbers = narrator.weights()
    weights = [(texts.link.format(), unit, links), *numbers]
    yield _table(weights, report, texts.weights_table.format(), "weights", 1)
    yield sentences(texts.forces_text.format())
    yield _table(narrator.columns(), report, texts.forces_table.format(), "inertia", 2)
    made = of_sheet(
        "inertia-hodographs", report.every, report.language, column=BALANCING_TEXT_WIDTH
    )
    yield figure(made, texts.hodographs.format(), "inertia_hodographs", height=90.0)


def _table(columns: Columns, report: Report, name: Rich, key: str, lead: int) -> Table:
    told = [(f"{head}, {unit}" if unit else head, cells)
            for head, unit, cells in in_heads(columns, report.notation)]  # fmt: skip
    rows = zip(*(cells for _, cells in told), strict=True)
    return Table(tuple(head for head, _ in told), tuple(rows), lead, lead, name=name, key=key)
