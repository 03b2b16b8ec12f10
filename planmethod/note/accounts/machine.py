"""The account of a machine: reduction, flywheel, sizes, power, run-up, balancing (маховик)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.accounts.drive_chain import ChainAccount, chain_of
from planmethod.note.accounts.voice import ITEMS, STEPS, Voice
from planmethod.note.document import Caption, Chapter, Item, Node
from planmethod.note.formula import Rich, capitalized, escape
from planmethod.note.narrate.balancing import BalancingNarrator, ReductionNarrator
from planmethod.note.narrate.machine import (
    MachineNarrator,
    course_columns,
    courses,
    has_run_up,
    run_up_lines,
)
from planmethod.note.numbers import MINUS, half_up, in_heads, with_unit
from planmethod.note.wording import Language, MessageTable
from planmethod.problem.machine_records import Quadrature
from planmethod.problem.records import Load, SizeTable
from planmethod.solved.machine.drawing import drawing_of, split
from planmethod.solved.machine.flywheel import (
    DISC_WIDTH,
    RIM_WIDTH,
    density_of,
    flywheel_of,
)
from planmethod.solved.solution import Solution


def machine_narrator(solution: Solution, language: Language) -> MachineNarrator:
    """Return the narrator of the machine of a solution."""
    return MachineNarrator(drawing_of(flywheel_of(solution), solution.profile), language)


class MachineAccount:
    """Sections on a machine and its flywheel, in a voice (расчёт маховика).

    Parameters
    ----------
    narrator : MachineNarrator
    voice : Voice
        Its figures are those of the keys ``load``, ``machine_diagrams``, ``speed`` and ``wheel``.
    """

    def __init__(self, narrator: MachineNarrator, voice: Voice) -> None:
        self.narrator, self.voice, self.notation = narrator, voice, narrator.notation
        self.drawing, self.flywheel = narrator.drawing, narrator.flywheel
        self.texts: MessageTable = narrator.texts
        self.references: MessageTable = narrator.language.document
        names = (
            ("M", narrator.moment),
            ("A", narrator.work),
            ("J", narrator.letter("reduced inertia")),
            ("A_const", narrator.letter(f"{narrator.keeps} work")),
            ("M_const", narrator.letter(f"{narrator.keeps} moment")),
            ("T_II", narrator.letter("second energy")),
            ("T_I", narrator.letter("first energy")),
            ("wheel", narrator.letter("flywheel")),
        )
        self.letters: dict[str, Rich] = dict(names)

    def quantity(self, value: float, unit: str) -> Rich:
        """Return a computed number with its unit."""
        return with_unit(self.notation.computed(value), self.narrator.unit(unit))

    @property
    def has_load_diagram(self) -> bool:
        """Whether a load has a diagram of its own."""
        dynamics = self.flywheel.problem.dynamics
        return dynamics is not None and any(
            isinstance(load, Load) and isinstance(load.size, SizeTable) for load in dynamics.loads
        )

    def by_method(self, key: str, **places: object) -> Rich:
        """Return what a key of the catalogue says of the file's method."""
        return self.narrator.by_method(key, **self.letters, **places)

    # Sections --------------------------------------------------------------------------------

    def definitions(self) -> Iterator[Node]:
        """Yield what the reduced moment and the reduced moment of inertia are."""
        texts, omega = self.texts, f"ω_{{{self.flywheel.problem.drive.link}}}"
        # What resists has a negative power, and counts as positive.
        minus = MINUS if self.flywheel.sign > 0 else ""
        formulas = (texts.moment_formula, texts.inertia_formula)
        defined = [one.format(**self.letters, omega=omega, minus=minus) for one in formulas]
        yield from self.voice.statement(
            texts.about.format(), defined, numbered=True, closing=texts.where.format()
        )

    def reduction(self) -> Iterator[Node]:
        """Yield the table by positions, and the reduced quantities term by term."""
        narrator, texts, machine = self.narrator, self.texts, self.flywheel.machine
        cycle = texts.cycle.format(
            cycle=with_unit(self.notation.as_input(machine.cycle_deg), "°"),
            count=machine.count,
            table=self.voice.reference(self.references.in_table, "machine"),
            **self.letters,
        )
        yield from self.voice.statement(f"{cycle} {self.lever_agrees}")
        yield from self.voice.table(narrator.columns(), texts.table, "machine", repeated=2)
        reduction = ReductionNarrator(narrator)
        for key, formulas, columns in (
            ("moments", [reduction.moment_formula()], reduction.moments()),
            ("energies", reduction.energy_formulas(), reduction.energy_columns()),
        ):
            table = self.voice.reference(self.references.in_table, f"machine_{key}")
            yield from self.voice.statement(str(texts["terms"][key]).format(table=table), formulas)
            yield from self.voice.table(columns, texts[key], f"machine_{key}", repeated=1)

    @property
    def lever_agrees(self) -> Rich:
        """What the moment by the lever is, in the table by positions."""
        return self.texts.lever_agrees.format(lever=self.narrator.letter("moment by lever"))

    def construction(self) -> Iterator[Node]:
        """Yield how the diagrams are made."""
        narrator, texts, scales = self.narrator, self.texts, self.drawing.scales
        middle = self.flywheel.machine.ordinates is Quadrature.MIDDLE
        pole = self.notation.as_input(half_up(self.drawing.pole, 2))
        plotted = texts.plotted.format(
            mu_M=narrator.scale("M", scales.moment, "N·m"),
            way=texts["ways"]["middle" if middle else "trapezoid"],
            pole=with_unit(pole, narrator.unit("mm")),
            built=texts["built"]["middle" if middle else "trapezoid"].format(),
            **self.letters,
        )
        yield from self.voice.statement(plotted, narrator.scale_formulas(), numbered=True)
        constant = float(self.drawing.points.work[-1]) / self.flywheel.cycle
        value = self.quantity(constant, "N·m")
        yield from self.voice.statement(texts.constant.format(value=value, **self.letters))
        energy = self.by_method(
            "energy",
            mu_J=narrator.scale("J", scales.inertia, "kg·m²"),
            figure=self.voice.reference(self.references.in_figure, "machine_diagrams"),
        )
        yield from self.voice.statement(energy)
        yield from self.voice.figure("machine_diagrams", self.by_method("diagrams"))

    def inertia(self) -> Iterator[Node]:
        """Yield the flywheel by the construction, and the check of it."""
        narrator, segment = self.narrator, self.narrator.segment
        yield from self.voice.statement(
            self.by_method("sought"), narrator.sought_formulas(), numbered=True
        )
        top, bottom = narrator.tangent_positions
        mm = narrator.unit("mm")
        cut = self.by_method(
            "cut",
            top=top,
            bottom=bottom,
            segment=with_unit(self.notation.measured(segment.read), mm),
            exact=with_unit(self.notation.number(f"{segment.exact:.2f}"), mm),
        )
        yield from self.voice.results(cut)
        lines = [narrator.largest_change()] if self.drawing.by_mertsalov else []
        lines.append(narrator.inertia_formula())
        yield from self.voice.statement(
            self.by_method("found"), lines, numbered=True, key="flywheel"
        )
        yield from self.voice.results(*self.check())

    def check(self) -> Iterator[Rich]:
        """Yield the error of the construction, the exact flywheel, the causes, the motion."""
        narrator, flywheel, texts, one = (
            self.narrator, self.flywheel, self.texts, self.narrator.inertia,
        )  # fmt: skip
        sigma = with_unit(self.notation.short(one.sigma, 2), narrator.unit("kg·m²"))
        yield texts.sigma.format(sigma=sigma)
        if one.exact <= 0.0:
            yield self.not_needed
            return
        percents = 1 if self.voice.is_note else 2

        def percent(value: float) -> Rich:
            return self.notation.number(one.part_text(value, percents))

        exact = with_unit(self.notation.number(one.exact_text), narrator.unit("kg·m²"))
        yield self.by_method("exact", value=exact, whole=percent(one.off))
        parts, least = split(self.drawing), 0.5 * 10.0 ** (-2 - percents) * one.exact
        causes = [
            str(texts["parts"][name]).format(
                value=percent(value), count=self.drawing.count, **self.letters
            )
            for name in ("slopes", "method", "positions", "pencil")
            if abs(value := float(getattr(parts, name))) > least
        ]
        if causes:
            yield texts.causes.format(parts="; ".join(causes))
        high, low = flywheel.integrated
        yield texts.reached.format(
            delta=self.delta,
            high=self.quantity(high.value, "1/s"),
            low=self.quantity(low.value, "1/s"),
            at_high=narrator.speed_extreme(high),
            at_low=narrator.speed_extreme(low),
        )

    @property
    def delta(self) -> Rich:
        """Coefficient of fluctuation that is reached: with digits to compare outside a note."""
        decimals = 4 if self.voice.is_note else 6
        return self.notation.number(f"{self.flywheel.delta_reached:.{decimals}f}")

    @property
    def not_needed(self) -> Rich:
        """Sentence for a machine that needs no flywheel, or only its rotor."""
        if self.narrator.rotor and self.drawing.adopted > 0.0:
            chain: MessageTable = self.texts["chain"]
            return chain.rotor_enough.format(wheel=self.letters["wheel"])
        return self.texts.not_needed.format(delta=self.delta)

    def sizes(self, shaft: tuple[str, float] | None = None) -> Iterator[Node]:
        """Yield the sizes of the flywheel, and those on a faster shaft: its link and ratio."""
        narrator, texts, sizes = self.narrator, self.texts, self.narrator.sizes
        assert sizes is not None
        wheel = self.flywheel.machine.wheel
        lead = str(texts["on_shaft"]["crank" if wheel.ratio == 1.0 else "other"]).format(
            ratio=self.notation.as_input(wheel.ratio),
            adopted=self.notation.computed(narrator.made_inertia),
            value=self.quantity(sizes.inertia, "kg·m²"),
            **{**self.letters, "wheel": narrator.made_letter},
        )
        if narrator.rotor:
            rest = texts.rotor_off.format(
                rest=narrator.made_letter,
                numbers=f"{self.notation.computed(self.drawing.adopted)} − "
                f"{self.notation.computed(narrator.rotor)}",
                value=self.quantity(narrator.made_inertia, "kg·m²"),
                **self.letters,
            )
            lead = f"{rest} {lead}"
        share = self.notation.as_input(RIM_WIDTH if sizes.bore else DISC_WIDTH)
        width = "" if sizes.is_speed_limited else texts.made_width.format(share=share)
        made = str(texts["made"][sizes.shape.value]).format(width=width)
        yield from self.voice.statement(f"{lead} {made}", narrator.size_formulas())
        material = texts.material.format(
            density=self.quantity(density_of(wheel), "kg/m³"),
            speed=self.quantity(sizes.speed, "m/s"),
        )
        limit = f"{capitalized(narrator.speed_limit_text)}." if sizes.is_speed_limited else ""
        yield from self.voice.results(material, limit, self._on_shaft(shaft))

    def _on_shaft(self, shaft: tuple[str, float] | None) -> Rich:
        if shaft is None:
            return ""
        label, ratio = shaft
        sizes = self.narrator.on_shaft(ratio)
        assert sizes is not None, "it is needed on the crank"
        return self.texts.quicker.format(
            link=escape(label),
            ratio=self.notation.short(ratio),
            value=self.quantity(sizes.inertia, "kg·m²"),
            diameter=with_unit(self.notation.as_input(sizes.diameter), self.narrator.unit("m")),
            width=self.quantity(sizes.width, "m"),
            mass=self.quantity(sizes.mass, "kg"),
            **{**self.letters, "wheel": self.narrator.made_letter},
        )

    def power(self) -> Iterator[Node]:
        """Yield the mean power of the cycle, that of the motor, and the motor."""
        formulas = self.narrator.power_formulas()
        lead = self.texts["power"]["motor" if len(formulas) > 1 else "crank"].format()
        yield from self.voice.statement(lead, formulas)
        if choice := self.narrator.motor_choice():
            yield from self.voice.results(choice)

    @property
    def chain(self) -> ChainAccount | None:
        """The account of motor, train and shaft of the flywheel; None without ``[[motors]]``."""
        found = chain_of(self.narrator)
        return None if found is None else ChainAccount(self.narrator, found, self.voice)

    # Documents -------------------------------------------------------------------------------

    def chapter(self, shaft: tuple[str, float] | None = None) -> Iterator[Node]:
        """Yield the chapter of a note or of a protocol.

        Parameters
        ----------
        shaft : tuple of str and float or None
            A faster shaft the flywheel may be on, and its speed ratio to the crank.
        """
        voice, texts = self.voice, self.texts
        yield Chapter(texts.title)
        yield from voice.part(texts.reduced)
        yield from self.definitions()
        yield from self.reduction()
        if self.has_load_diagram:
            yield from voice.figure("load", texts.load_figure, texts.load_text.format())
        yield from voice.part(texts.diagrams_title)
        yield from self.construction()
        yield from voice.part(texts.calculation)
        yield from self.inertia()
        yield from voice.figure("speed", texts.speed, texts.speed_text.format())
        if self.narrator.sizes is not None:
            yield from voice.part(texts.sizes_title)
            yield from self.sizes(shaft)
            yield from voice.figure("wheel", texts.wheel_figure, texts.wheel_text.format())
        yield from voice.part(texts.power_title)
        yield from self.power()
        if (chain := self.chain) is not None:
            yield from voice.part(chain.texts.title.format())
            yield from chain.sections()

    def calculation(self) -> Iterator[Node]:
        """Yield the formulas of scales, flywheel and power, with their results."""
        yield from self.construction()
        yield from self.inertia()
        yield from self.power()
        if (chain := self.chain) is not None:
            yield from chain.lines()


def machine_chapter(solution: Solution, language: Language) -> Iterator[Node]:
    """Yield the chapter of a protocol: the flywheel step by step, then the run-up."""
    narrator = machine_narrator(solution, language)
    yield from MachineAccount(narrator, STEPS).chapter()
    yield from _run_up(narrator)


def machine_results(solution: Solution, language: Language) -> Iterator[Node]:
    """Yield the table by positions, the formulas, the exact flywheel and its sizes."""
    narrator = machine_narrator(solution, language)
    account, texts = MachineAccount(narrator, ITEMS), narrator.texts
    yield Chapter(texts.title, numbered=False)
    yield from account.reduction()
    yield Caption(texts.calculation)
    yield from account.calculation()
    if (sizes := narrator.sizes) is not None:
        yield Item(f"{texts['sizes'][sizes.shape.value]}: {'; '.join(narrator.size_lines(sizes))}")
    if (chain := account.chain) is not None:
        for name, columns in chain.tables():
            if columns:
                yield from ITEMS.table(columns, texts["chain"]["tables"][name], "", repeated=1)
    yield from _run_up(narrator)


def _run_up(narrator: MachineNarrator) -> Iterator[Node]:
    if not has_run_up(narrator):
        return
    yield Chapter(narrator.texts.run_up, numbered=False)
    yield from map(Item, run_up_lines(narrator))
    for title, course in courses(narrator):
        yield from ITEMS.table(course_columns(course, narrator), title, "", repeated=1)


def balancing_results(solution: Solution, language: Language) -> Iterator[Node]:
    """Yield the counterweights with their numbers, and the main vector by positions."""
    narrator = BalancingNarrator(solution, language)
    yield Chapter(narrator.texts.balancing, numbered=False)
    yield from map(Item, narrator.lines())
    columns = in_heads(narrator.columns(), narrator.notation)
    yield from ITEMS.table(columns, narrator.texts.forces_table, "", repeated=2)
