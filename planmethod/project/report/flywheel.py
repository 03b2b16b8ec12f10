"""Chapter on the flywheel: reduction, diagrams, moment of inertia, sizes (маховик)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.document import Chapter, Node, Part, Table, table_of_quantities
from planmethod.note.formula import Rich, escape, fraction
from planmethod.note.narrate.machine import MachineTeller
from planmethod.note.narrate.reduction import ReductionTeller
from planmethod.note.numbers import MINUS, half_up, with_unit
from planmethod.note.wording import Words
from planmethod.problem.load_records import Load, SizeTable
from planmethod.problem.machine_records import Quadrature, WheelShape
from planmethod.project.report.context import NBSP, Report, chain, displayed, sentences
from planmethod.project.report.figures import figure, of_sheet
from planmethod.project.train import ALIKE, quick_shaft
from planmethod.render.pictures.flywheel import construction_picture
from planmethod.solved.machine.drawing import drawing_of, split
from planmethod.solved.machine.flywheel import flywheel_of
from planmethod.solved.machine.sizes import density_of

COLUMN = 240.0
"""Width of the texts of the sheet, which its diagrams are measured by, mm."""

SMALL = 5e-4
"""Share of the moment of inertia below which a cause of a difference is not named."""


def machine_of(report: Report) -> MachineTeller:
    """Return the narrator of the machine of a project."""
    flywheel = flywheel_of(report.every)
    return MachineTeller(drawing_of(flywheel, report.every.profile), report.words)


def flywheel_chapter(report: Report) -> Iterator[Node]:
    """Yield the chapter."""
    said: Words = report.said["flywheel"]
    tell = machine_of(report)
    yield Chapter(said.title.format())
    yield Part(said.reduced.format())
    yield from _reduced(report, tell, said)
    yield Part(said.diagrams.format())
    yield from _diagrams(report, tell, said)
    yield Part(said.sizes_title.format())
    yield from _inertia(report, tell, said)
    yield Part(said.power_title.format())
    formulas = tell.power_formulas()
    yield sentences(str(said["power"]["motor" if len(formulas) > 1 else "crank"]).format())
    yield from chain(formulas)
    for text in tell.motor_choice():
        yield sentences(f"{text}.")


def _reduced(report: Report, tell: MachineTeller, said: Words) -> Iterator[Node]:
    J = tell.letter("reduced inertia")  # noqa: N806 - the letter of the textbook
    yield sentences(said.about.format())
    omega = f"ω_{{{report.one.problem.drive.link}}}"
    # What resists has a negative power, and counts as positive.
    minus = MINUS if tell.flywheel.sign > 0 else ""
    yield displayed(said.moment_formula.format(M=tell.moment, omega=omega, minus=minus))
    yield displayed(said.inertia_formula.format(J=J, omega=omega))
    yield sentences(said.where.format())
    flywheel = tell.flywheel
    cycle = with_unit(report.say.given(flywheel.machine.cycle_deg), "°")
    lever, count = tell.letter("moment by lever"), flywheel.machine.count
    yield sentences(said.cycle.format(cycle=cycle, count=count, lever=lever))
    columns = tell.columns()
    head = tuple(f"{name}, {unit}" if unit else name for name, unit, _ in columns)
    rows = tuple(zip(*(cells for _, _, cells in columns), strict=True))
    yield Table(head, rows, 1, 2, name=said.table.format(), key="machine")
    yield from _terms(tell, said)
    dynamics = report.one.problem.dynamics
    changing = dynamics is not None and any(
        isinstance(load, Load) and isinstance(load.size, SizeTable) for load in dynamics.loads
    )
    if changing:
        made = of_sheet("load-diagram", report.every, report.words, column=COLUMN)
        yield sentences(said.load_text.format())
        yield figure(made, said.load_figure.format(), "load", height=90.0)


def _terms(tell: MachineTeller, said: Words) -> Iterator[Node]:
    """Yield the reduced moment and the energies term by term, with their tables."""
    reduction = ReductionTeller(tell)
    for key, formulas, columns in (
        ("moments", [reduction.moment_formula()], reduction.moments()),
        ("energies", reduction.energy_formulas(), reduction.energy_columns()),
    ):
        yield sentences(str(said["terms"][key]).format())
        yield from chain(formulas)
        table = table_of_quantities(columns, repeated=1)
        yield Table(table.head, table.rows, 1, 1, name=str(tell.said[key]), key=f"machine_{key}")


def _diagrams(report: Report, tell: MachineTeller, said: Words) -> Iterator[Node]:
    drawing, machine, say = tell.drawing, tell.flywheel.machine, report.say
    scales = drawing.scales
    middle = machine.ordinates is Quadrature.MIDDLE
    letters = {
        "M": tell.moment,
        "A": tell.work,
        "J": tell.letter("reduced inertia"),
        "A_const": tell.letter(f"{tell.keeps} work"),
        "M_const": tell.letter(f"{tell.keeps} moment"),
    }
    yield sentences(
        said.moment.format(
            M=letters["M"],
            A=letters["A"],
            mu_M=tell.scale("M", scales.moment, "N·m"),
            way=str(said["ways"]["middle" if middle else "trapezoid"]).format(),
            pole=with_unit(say.given(half_up(drawing.pole, 2)), report.unit("mm")),
        )
    )
    yield from _listed(tell.scale_formulas())
    constant = float(drawing.points.work[-1]) / tell.flywheel.cycle
    yield sentences(
        said.constant.format(
            value=report.quantity(constant, "N·m"),
            **{key: letters[key] for key in ("A", "A_const", "M_const")},
        ),
        _by_method(said, tell, "energy").format(
            mu_J=tell.scale("J", scales.inertia, "kg·m²"), J=letters["J"], **_energies(tell)
        ),
    )
    yield figure(
        lambda letter: construction_picture(drawing, tell, letter),
        _by_method(said, tell, "figure").format(**_energies(tell)),
        "machine_diagrams",
        height=190.0,
    )


def _by_method(said: Words, tell: MachineTeller, key: str) -> str:
    return str(said[key][tell.flywheel.machine.method.value])


def _energies(tell: MachineTeller) -> dict[str, str]:
    return {"T_II": tell.letter("second energy"), "T_I": tell.letter("first energy")}


def _listed(formulas: list[Rich]) -> Iterator[Node]:
    """Yield formulas that follow each other in a sentence."""
    for k, text in enumerate(formulas, 1):
        yield displayed(f"{text}{'.' if k == len(formulas) else ','}")


def _inertia(report: Report, tell: MachineTeller, said: Words) -> Iterator[Node]:
    drawing, flywheel, say = tell.drawing, tell.flywheel, report.say
    top, bottom = tell.found_in
    yield sentences(_by_method(said, tell, "sought").format())
    yield from _listed(tell.sought_formulas())
    segment = drawing.made.segment
    exact = float(drawing.exact.number(segment)[0])
    yield sentences(
        _by_method(said, tell, "cut").format(
            top=top,
            bottom=bottom,
            segment=report.mm(tell.segment),
            exact=f"{say.number(f'{exact:.2f}')} {report.unit('mm')}",
            **_energies(tell),
        )
    )
    if drawing.by_mertsalov:
        yield displayed(f"{tell.largest_change()},")
    symbol, omega = tell.letter("flywheel"), tell.letter("mean speed")
    speed = say.found(flywheel.middle_speed)
    letters = fraction(f"μ_{{T}}·{segment}", f"{omega}^{{2}}·δ")
    numbers = fraction(
        f"{say.found(drawing.scales.work)}·{say.ruled(tell.segment)}",
        f"{speed}^{{2}}·{say.given(flywheel.machine.delta)}",
    )
    value = report.quantity(drawing.read_inertia, "kg·m²")
    yield displayed(f"{symbol} = {letters} = {numbers} = {value}.", "flywheel")
    sigma = f"{say.short(drawing.sigma, 2)} {report.unit('kg·m²')}"
    yield sentences(said.sigma.format(sigma=sigma), *_checked(report, tell, said))
    sizes = tell.sizes
    if sizes is not None:
        yield from _sizes(report, tell, said)
    made = of_sheet("speed-diagram", report.every, report.words, column=COLUMN)
    yield sentences(said.speed.format())
    yield figure(made, said.speed_figure.format(), "speed", height=90.0)


def _checked(report: Report, tell: MachineTeller, said: Words) -> Iterator[Rich]:
    """Yield the error of the construction from the exact flywheel, and the motion check."""
    flywheel, say = tell.flywheel, report.say
    exact, unit = flywheel.exact.inertia, report.unit("kg·m²")
    delta = say.number(f"{flywheel.delta_reached:.4f}")
    if exact <= 0.0:
        yield said.not_needed.format(delta=delta)
        return
    parts = split(tell.drawing)

    def percent(value: float) -> str:
        return say.number(f"{100.0 * value / exact:+.1f}")

    causes = {name: getattr(parts, name) for name in ("slopes", "method", "positions", "pencil")}
    told = [
        str(said["parts"][name]).format(
            value=percent(value), count=tell.drawing.count, **_energies(tell)
        )
        for name, value in causes.items()
        if abs(value) > SMALL * exact
    ]
    yield _by_method(said, tell, "exact").format(
        **_energies(tell),
        symbol=tell.letter("flywheel"),
        value=f"{say.found(exact)} {unit}",
        whole=percent(tell.drawing.read_inertia - exact),
    )
    if told:
        form = "one" if len(told) == 1 else "many"
        yield str(said["why"][form]).format(parts=", ".join(told))
    high, low = flywheel.integrated
    per_second = report.unit("1/s")
    yield said.reached.format(
        delta=delta,
        high=f"{say.found(high.value)} {per_second}",
        low=f"{say.found(low.value)} {per_second}",
        at_high=tell.speed_extreme(high),
        at_low=tell.speed_extreme(low),
    )


def _quicker(report: Report, tell: MachineTeller, said: Words) -> Rich:
    """Return the text on a flywheel on the fast shaft of the train; empty if there is none."""
    shaft = quick_shaft(report.project)
    if shaft is None or abs(shaft[1] / tell.flywheel.machine.wheel.ratio - 1.0) <= ALIKE:
        return ""
    label, ratio = shaft
    sizes = tell.on_shaft(ratio)
    assert sizes is not None, "it is needed on the crank"
    return said.quicker.format(
        link=escape(label),
        ratio=report.say.short(ratio),
        inertia=tell.letter("flywheel"),
        value=report.quantity(sizes.inertia, "kg·m²"),
        diameter=with_unit(report.say.given(sizes.diameter), report.unit("m")),
        width=report.quantity(sizes.width, "m"),
        mass=report.quantity(sizes.mass, "kg"),
    )


def _sizes(report: Report, tell: MachineTeller, said: Words) -> Iterator[Node]:
    sizes, say = tell.sizes, report.say
    assert sizes is not None
    disc = sizes.shape is WheelShape.DISC
    held = ""
    if sizes.held:
        limit = say.given(tell.flywheel.machine.wheel.greatest_speed)
        held = said.held.format(speed=f"{limit}{NBSP}{report.unit('m/s')}")
    ratio = tell.flywheel.machine.wheel.ratio
    yield sentences(
        str(said["on_shaft"]["crank" if ratio == 1.0 else "other"]).format(
            ratio=say.given(ratio),
            inertia=tell.letter("flywheel"),
            value_of=say.found(tell.drawing.adopted),
            value=report.quantity(sizes.inertia, "kg·m²"),
        ),
        (said.disc if disc else said.rim).format(),
    )
    yield from chain(tell.size_formulas())
    yield sentences(
        said.made.format(
            density=report.quantity(density_of(tell.flywheel.machine.wheel), "kg/m³"),
            speed=report.quantity(sizes.speed, "m/s"),
        ),
        held,
        _quicker(report, tell, said),
        said.wheel_text.format(),
    )
    made = of_sheet("flywheel", report.every, report.words, column=130.0)
    yield figure(made, said.wheel_figure.format(), "wheel", height=90.0)
