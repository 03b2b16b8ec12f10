"""The synthesis of a mechanism as a calculation: sizes by their formulas (расчёт синтеза)."""

# no messages: formulas

from __future__ import annotations

from planmethod.note.calculation.expression import (
    Call,
    Expression,
    Name,
    Negative,
    Number,
    Operation,
)
from planmethod.note.calculation.model import CalculationBuilder, Equations, Quantity
from planmethod.note.formula import Rich
from planmethod.note.synthesis.drawing import Drawn
from planmethod.note.synthesis.formulas import SynthesisFormulas, SynthesisLetter
from planmethod.note.wording import Language


def synthesis_chapter(drawn: Drawn, builder: CalculationBuilder, language: Language) -> None:
    """Write the chapter: given data, and the sizes in the order in which they are calculated.

    A number that only the construction gives, as the best offset, is a value.
    """
    texts, units = language.calculation, language.notation.units
    letters = SynthesisFormulas(drawn, language).letters
    ratios = [symbol for symbol in letters if symbol.startswith("K_{") and symbol != "K_{v}"]
    if ratios:
        _freudenstein(drawn, {one: letters[one] for one in ratios}, builder, language)
    for symbol, one in letters.items():
        unit = units.get(one.unit, one.unit)
        if one.letters:
            builder.formula(symbol, one.letters, one.value, unit)
        elif one.is_input:
            builder.add_input(symbol, one.value, unit)
        elif symbol not in ratios:
            builder.value(symbol, one.value, unit, texts.computed)
    builder.close(texts.synthesis.format())


def _freudenstein(
    drawn: Drawn,
    ratios: dict[Rich, SynthesisLetter],
    builder: CalculationBuilder,
    language: Language,
) -> None:
    """Write the equations K₁cos ψ − K₂cos φ + K₃ = cos(φ − ψ), whose unknowns are the ratios."""
    angles, degree = drawn.synthesis.options["angles"], language.notation.units["deg"]
    coefficients, right = list[tuple[Expression, ...]](), list[Expression]()
    for number, pair in enumerate(angles, 1):
        phi, psi = (
            Name(builder.add_input(f"{letter}′_{{{number}}}", float(angle), degree).name)
            for letter, angle in zip("φψ", pair, strict=True)
        )
        row = (Call("cos", (psi,)), Negative(Call("cos", (phi,))), Number(1.0))
        coefficients.append(row)
        right.append(Call("cos", (Operation("-", phi, psi),)))
    unknowns = tuple(
        Quantity(builder.new_name(symbol), symbol, "", (one.value,), (None,))
        for symbol, one in ratios.items()
    )
    names = tuple(language.calculation.pair_of_angles.format(number=k) for k in (1, 2, 3))
    builder.add_equations(Equations(names, tuple(coefficients), tuple(right), unknowns))
