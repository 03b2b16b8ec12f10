"""Formulas as rich text: symbols, the numbers put in, the result with its unit (формулы)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from planmethod.construct.steps import Compute, LineName, Name, NumberName, PointName
from planmethod.note.formula import fraction
from planmethod.note.narrate.naming import SCALE_KIND, Names
from planmethod.note.wording import Language, get_language
from planmethod.plans.model import FACTS, PlanKind, Vector
from planmethod.problem.names import fold
from planmethod.solved.detail_views import DetailView
from planmethod.solved.solution import Solution

SHORTEST_MM = 1e-9
"""Length, mm, below which a segment is a point."""


class Formulas:
    """Values of one position, as the hand has them, and formulas with them (расчётные формулы).

    Magnitudes are written without signs: words beside them give the sense.
    """

    def __init__(self, solution: Solution, names: Names, index: int) -> None:
        self.solution, self.names, self.index = solution, names, index
        self.texts = names.texts
        self.language = get_language(names.texts.lang)
        self.notation = self.language.notation

    # Values ----------------------------------------------------------------------------------

    def number(self, name: NumberName) -> float:
        """Return a number as the hand has it."""
        return float(self.solution.ruler_reading.number(name)[self.index])

    def exact_value(self, name: NumberName) -> float:
        """Return a number without the error of reading."""
        return float(self.solution.paper.number(name)[self.index])

    @property
    def position(self) -> float:
        """Position of the driver, degrees or m."""
        return float(self.solution.positions[self.index])

    def readable(self, name: Name) -> bool:
        """Return whether the hand has a value: not where it divides by a reading of 0."""
        return bool(self.solution.ruler_reading.has(name)[self.index])

    def place(self, point: PointName) -> complex:
        """Return a point of the exact drawing, mm."""
        column = self.solution.paper.point(point)
        return complex(column[self.index])

    def direction_vector(self, line: LineName) -> complex:
        """Return a vector along a line of the exact drawing."""
        return complex(self.solution.paper.line_vector(line)[self.index])

    def per_mm(self, kind: PlanKind) -> float:
        """Return the scale of a plan, unit per mm."""
        return self.solution.plan_scale(kind, self.index).per_mm

    # Formulas --------------------------------------------------------------------------------

    def unit(self, key: str) -> str:
        """Return a unit in the language."""
        return self.notation.units[key]

    def exactly(self, value: float, unit: str = "") -> str:
        """Return the exact value in brackets; empty on a sheet, whose table has it."""
        if self.names.on_sheet:
            return ""
        text = f"{self.notation.computed(value)} {unit}".rstrip()
        return self.texts.exact.format(value=text)

    def product(
        self,
        powers: Iterable[tuple[NumberName, int]],
        factor: float = 1.0,
        *,
        called: str | None = None,
    ) -> tuple[str, str]:
        """Return a product of powers in symbols and in numbers, a fraction where there is one.

        ``called`` is another symbol for the factor that is not a scale.
        """
        factors = []
        for name, power in powers:
            is_scale = name in SCALE_KIND
            symbol = self.names.symbol(name) if is_scale or called is None else called
            factors.append((symbol, abs(self.number(name)), power, is_scale))
        return self.fraction(factors, factor)

    def fraction(
        self, factors: Sequence[tuple[str, float, int, bool]], factor: float = 1.0
    ) -> tuple[str, str]:
        """Return factors (symbol, value, power, is a scale) as a fraction: symbols and numbers."""
        above: list[tuple[str, str]] = []
        below: list[tuple[str, str]] = []
        if factor != 1.0:
            above.append((self.notation.as_input(factor),) * 2)
        for symbol, value, power, is_scale in factors:
            if is_scale and self.names.is_inverse_scale():
                value, power = 1.0 / value, -power
            text = self.notation.short(value)
            mark = "" if abs(power) == 1 else f"^{{{abs(power)}}}"
            if mark and "·" in text:
                text = f"({text})"
            (above if power > 0 else below).append((symbol + mark, text + mark))
        return _over(above, below, 0), _over(above, below, 1)

    def formula(
        self, symbol: str, sides: Sequence[str], value: float, unit: str, more: str = ""
    ) -> str:
        """Return ``symbol = in symbols = in numbers = value unit``, without repetition."""
        number = self.notation.short(value, 4)
        parts = [symbol, *(side for side in sides if side != number), f"{number} {self.unit(unit)}"]
        return " = ".join(parts) + more

    def laid_off_formulas(
        self, step: Compute, segment: str, kind: PlanKind, vector: Vector | None
    ) -> list[str]:
        """Return how a length to be laid off on a plan is computed: the quantity, then the length.

        On a sheet, a quantity that is not given covers both.

        Parameters
        ----------
        step : Compute
            The length: a quantity over the scale.
        segment : str
            Name of the length, as ``(pb)``.
        """
        (value, _), (scale, _) = step.powers
        length, mu = abs(self.number(step.out)), self.per_mm(kind)
        symbol = vector.symbol if vector else self.names.symbol(value)
        made, lines = self.names.step[value], []
        sides: tuple[str, ...] = self.fraction(
            [(symbol, _as_written(length * mu), 1, False), (self.names.symbol(scale), mu, -1, True)]
        )
        if isinstance(made, Compute):
            product = self.product(made.powers, made.factor)
            lines.append(self.formula(symbol, product, length * mu, FACTS[kind].unit, ";"))
            sides = () if self.names.on_sheet else sides
        lines.append(self.formula(segment, sides, length, "mm", "."))
        return ["  ".join(lines)] if self.names.on_sheet else lines

    def quantity_from_segment(self, step: Compute, kind: PlanKind) -> str:
        """Return a quantity from the read segment that shows it."""
        symbol = self.names.symbol(step.out)
        powers = step.powers[::-1] if self.names.is_inverse_scale() else step.powers
        exact, unit = abs(self.exact_value(step.out)), FACTS[kind].unit
        if not self.readable(step.out):
            text = self.exactly(exact, self.unit(unit))
            return f"{symbol} {self.language.sheets.unreadable}{text}"
        value, product = abs(self.number(step.out)), self.product(powers)
        text = self._read_on(step) + self.exactly(exact)
        if value == 0.0 < exact:  # no enlargement of GOST 2.302 shows it
            return f"{symbol} = {product[0]} ≈ 0{text}"
        return self.formula(symbol, product, value, unit, text)

    def _read_on(self, step: Compute) -> str:
        """Return the detail view on which a quantity's segment is read; empty for others."""
        read_on = self.solution.read_on(self.index)
        knot = next((read_on[name] for name, _ in step.powers if name in read_on), None)
        if knot is None:
            return ""
        return f" ({self.language.sheets.read_on.format(view=view_name(knot, self.language))})"


def view_name(detail_view: DetailView, language: Language) -> str:
    """Return the name of a detail view: ``А (10:1)``."""
    ratio = language.notation.short(detail_view.times)
    return language.sheets.enlarged.format(
        letter=detail_view_letter(detail_view, language), ratio=ratio
    )


def detail_view_letter(detail_view: DetailView, language: Language) -> str:
    """Return the letter of a detail view, none that looks like that of a point.

    Where the letters are too few they start again with a number: ``Б1``.
    """
    every: tuple[str, ...] = language.sheets["knots"]
    letters = [one for one in every if fold(one) not in detail_view.initials] or every
    again, which = divmod(detail_view.number, len(letters))
    return f"{letters[which]}{again or ''}"


def _as_written(value: float) -> float:
    """Return a number as just written, so that the next formula uses the same digits."""
    return float(f"{value:.4g}")


def _over(above: list[tuple[str, str]], below: list[tuple[str, str]], which: int) -> str:
    top = "·".join(pair[which] for pair in above) or "1"
    return fraction(top, "·".join(pair[which] for pair in below)) if below else top
