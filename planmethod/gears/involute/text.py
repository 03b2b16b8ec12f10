"""Texts on a pair of wheels: given data, sizes, limits, the calculation by formulas."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby
from math import degrees

from planmethod.construct.drafting import Profile
from planmethod.gears.involute.formulas import Unit
from planmethod.gears.involute.geometry import MeshingProblem
from planmethod.gears.involute.quantities import SizedQuantity, SolvedMeshing
from planmethod.note.document import (
    Caption,
    Chapter,
    Formula,
    GivenFact,
    Item,
    Node,
    Paragraph,
    Table,
    Title,
    table_of,
)
from planmethod.note.formula import Rich, escape
from planmethod.note.wording import Language


def solved_document(problem: MeshingProblem, language: Language) -> Iterator[Node]:
    """Yield the given data, the sizes of the pair and of the wheels, and the limits."""
    solved, texts = SolvedMeshing(problem), language.meshing
    pair, wheels, contact = solved.sized_quantities()
    yield from meshing_head(solved, language)
    yield Caption(texts.pair)
    yield table([*pair, *contact], language, (*texts["columns"][:2], ""))
    yield Caption(texts.wheels)
    yield table(wheels, language, texts["columns"])
    yield Caption(texts.cutting)
    yield from map(Item, cutting(solved, language))
    yield Caption(texts.checked)
    yield from map(Item, quality(solved, language))


def cutting(solved: SolvedMeshing, language: Language) -> Iterator[Rich]:
    """Return where the rack stands that cuts each wheel, and where undercut begins or would."""
    texts = language.meshing
    for k, one in enumerate(solved.cuttings):
        if one is None:
            yield texts.cut_by_cutter.format(wheel=k + 1)
            continue
        numbers = {
            "moved": one.displacement,
            "c": one.clearance,
            "rho": abs(one.boundary),
            "least": one.min_displacement,
        }
        cut = one.cut_diameter
        key = "whole" if cut is None else "cut"
        if cut is not None:
            numbers["d"] = cut
        yield texts["cut_by_rack"][key].format(wheel=k + 1, **_format_numbers(numbers, language))


def meshing_head(solved: SolvedMeshing, language: Language) -> Iterator[Node]:
    """Yield the title and the given data."""
    title = escape(solved.problem.title or solved.problem.name)
    yield Title(language.meshing.title.format(title=title))
    facts = given_facts(solved, language)
    yield Paragraph(given_text(facts, language), facts=tuple(facts))
    if solved.problem.beta:
        yield Paragraph(language.meshing.helical)
    yield Paragraph(shifts(solved, language))


def given_text(facts: Sequence[GivenFact], language: Language) -> Rich:
    """Return the given data in one line, without the shifts, which have their own sentence."""
    return language.note.given.format(given="; ".join(fact.text for fact in facts[:-1]))


def given_facts(solved: SolvedMeshing, language: Language) -> list[GivenFact]:
    """Return the given facts, sufficient to cut the wheels again; the shifts come last."""
    problem, notation, units = solved.problem, language.notation, language.meshing["units"]
    rack = problem.rack
    z1, z2 = problem.z
    alpha, beta = round(degrees(rack.alpha), 9), round(degrees(problem.beta), 9)
    facts = [
        GivenFact(f"z_{{1}} = {z1}; z_{{2}} = {z2}", {"meshing.z": [z1, z2]}),
        GivenFact(f"m = {notation.as_input(problem.m)} {units['mm']}", {"meshing.m": problem.m}),
        GivenFact(
            f"α = {notation.as_input(alpha)}{notation.units['deg']}", {"meshing.alpha": alpha}
        ),
        GivenFact(f"h_{{a}}^{{*}} = {notation.as_input(rack.ha)}", {"meshing.ha": rack.ha}),
        GivenFact(f"c^{{*}} = {notation.as_input(rack.c)}", {"meshing.c": rack.c}),
    ]
    if problem.a_w is not None:
        text = f"a_{{w}} = {notation.as_input(problem.a_w)} {units['mm']}"
        facts.append(GivenFact(text, {"meshing.a_w": problem.a_w}))
    if problem.beta:
        facts.append(
            GivenFact(
                f"β = {notation.as_input(beta)}{notation.units['deg']}", {"meshing.beta": beta}
            )
        )
    if problem.width is not None:
        text = f"b_{{w}} = {notation.as_input(problem.width)} {units['mm']}"
        facts.append(GivenFact(text, {"meshing.b": problem.width}))
    if problem.cutter:
        ring = language.meshing.ring.format(cutter=problem.cutter)
        facts.append(GivenFact(ring, {"meshing.internal": True, "meshing.cutter": problem.cutter}))
    least = {"tip": notation.as_input(problem.tip), "overlap": notation.as_input(problem.overlap)}
    data = {"meshing.s_a_min": problem.tip, "meshing.epsilon_min": problem.overlap}
    facts.append(GivenFact(language.meshing.least.format(**least), data))
    told: dict[str, object] = {"meshing.x": [*problem.x]}
    if problem.aim is not None:
        told = {"meshing.x": problem.aim.value}
    elif problem.shift_wheel is not None:
        told = {f"meshing.x{problem.shift_wheel + 1}": problem.x[problem.shift_wheel]}
    return [*facts, GivenFact(shifts(solved, language), told)]


def shifts(solved: SolvedMeshing, language: Language) -> Rich:
    """Return the sentence on the shifts, and whether they were chosen."""
    key = "given" if solved.problem.aim is None else solved.problem.aim.value
    sentence: str = language.meshing["shifts"][key]
    return sentence.format(**_without_brackets(solved, language))


def _without_brackets(solved: SolvedMeshing, language: Language) -> dict[str, str]:
    """Return the numbers without the brackets that they have within a formula."""
    return {name: shown.strip("()") for name, shown in solved.fields(language.notation).items()}


def quality(solved: SolvedMeshing, language: Language) -> Iterator[Rich]:
    """Yield the verdicts of the limits, and the effect of undercut."""
    texts = language.meshing
    for _, holds, text in solved.sentences(language):
        yield f"{text}: {texts['holds']['yes' if holds else 'no']}"
    for k, tooth in enumerate(solved.teeth):
        if tooth.is_cut:
            rho, d = tooth.rho_low, 2 * abs(complex(tooth.flank(tooth.rho_low)))
            numbers = {"rho": rho, "d": d, "x_min": tooth.size("x_min")}
            yield texts.undercut.format(wheel=k + 1, **_format_numbers(numbers, language))
    standard, active = float(solved.pair.epsilon), solved.contact.overlap(solved.pair)
    if active < standard - 1e-9:
        yield texts.cut_line.format(
            **_format_numbers({"epsilon": active, "standard": standard}, language)
        )


def _format_numbers(numbers: dict[str, float], language: Language) -> dict[str, str]:
    return {name: language.notation.number(f"{value:.3f}") for name, value in numbers.items()}


def table(quantities: Sequence[SizedQuantity], language: Language, head: Sequence[str]) -> Table:
    """Return a table of quantities: name with unit, symbol, values."""
    return table_of(head, [_row(one, language) for one in quantities], names=2)


def _row(one: SizedQuantity, language: Language) -> tuple[Rich, ...]:
    texts, quantity = language.meshing, one.quantity
    has_unit = quantity.unit in (Unit.MM, Unit.DEGREE)
    unit = f", {texts['units'][quantity.unit.value[0]]}" if has_unit else ""
    # For both wheels, without a number.
    symbol = quantity.symbol.replace("#", "").replace("_{}", "")
    return (
        escape(texts["names"][quantity.key] + unit),
        symbol,
        *one.format_values(language.notation),
    )


def protocol_document(
    problem: MeshingProblem, language: Language, profile: Profile
) -> Iterator[Node]:
    """Yield the calculation formula by formula, as the note has it; no hand draws in it."""
    solved, texts = SolvedMeshing(problem), language.meshing
    fields = solved.fields(language.notation)
    yield from meshing_head(solved, language)
    for key, formulas in groupby(solved.formulas(language), lambda one: one[0]):
        if key in texts["steps"]:
            yield Chapter(texts["steps"][key])
        if key in texts["beside"]:
            yield Paragraph(texts["beside"][key].format(**fields))
        yield from (Formula(formula) for _, formula in formulas)
    yield Chapter(texts.cutting)
    yield from map(Item, cutting(solved, language))
    yield Caption(texts.checked)
    yield from map(Item, quality(solved, language))
