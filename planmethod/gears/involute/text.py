"""Texts on a pair of wheels: given data, sizes, limits (данные, размеры, проверки)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import degrees

from planmethod.gears.involute.formulas import Unit
from planmethod.gears.involute.quantities import SolvedMeshing, Told
from planmethod.gears.involute.sizes import MeshingProblem
from planmethod.note.document import (
    Caption,
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


def solved_document(problem: MeshingProblem, words: Language) -> Iterator[Node]:
    """Yield the given data, the sizes of the pair and of the wheels, and the limits."""
    solved, say = SolvedMeshing(problem), words.meshing
    pair, wheels, contact = solved.told()
    yield from head(solved, words)
    yield Caption(say.pair)
    yield table([*pair, *contact], words, (*say["columns"][:2], ""))
    yield Caption(say.wheels)
    yield table(wheels, words, say["columns"])
    yield Caption(say.cutting)
    yield from map(Item, cutting(solved, words))
    yield Caption(say.checked)
    yield from map(Item, quality(solved, words))


def cutting(solved: SolvedMeshing, words: Language) -> Iterator[Rich]:
    """Return where the rack stands that cuts each wheel, and where undercut begins or would."""
    say = words.meshing
    for k, one in enumerate(solved.cuttings):
        if one is None:
            yield say.cut_by_cutter.format(wheel=k + 1)
            continue
        numbers = {
            "moved": one.displacement,
            "c": one.clearance,
            "rho": abs(one.boundary),
            "least": one.least,
        }
        cut = one.cut_diameter
        key = "whole" if cut is None else "cut"
        if cut is not None:
            numbers["d"] = cut
        yield say["cut_by_rack"][key].format(wheel=k + 1, **_shown(numbers, words))


def head(solved: SolvedMeshing, words: Language) -> Iterator[Node]:
    """Yield the title and the given data."""
    title = escape(solved.problem.title or solved.problem.name)
    yield Title(words.meshing.title.format(title=title))
    facts = given(solved, words)
    yield Paragraph(given_text(facts, words), facts=tuple(facts))
    if solved.problem.beta:
        yield Paragraph(words.meshing.helical)
    yield Paragraph(shifts(solved, words))


def given_text(facts: Sequence[GivenFact], words: Language) -> Rich:
    """Return the given data in one line, without the shifts, which have their own sentence."""
    return words.note.given.format(given="; ".join(fact.text for fact in facts[:-1]))


def given(solved: SolvedMeshing, words: Language) -> list[GivenFact]:
    """Return the given facts, sufficient to cut the wheels again; the shifts come last."""
    problem, say, units = solved.problem, words.say, words.meshing["units"]
    rack = problem.rack
    z1, z2 = problem.z
    alpha, beta = round(degrees(rack.alpha), 9), round(degrees(problem.beta), 9)
    facts = [
        GivenFact(f"z_{{1}} = {z1}; z_{{2}} = {z2}", {"meshing.z": [z1, z2]}),
        GivenFact(f"m = {say.given(problem.m)} {units['mm']}", {"meshing.m": problem.m}),
        GivenFact(f"α = {say.given(alpha)}{say.units['deg']}", {"meshing.alpha": alpha}),
        GivenFact(f"h_{{a}}^{{*}} = {say.given(rack.ha)}", {"meshing.ha": rack.ha}),
        GivenFact(f"c^{{*}} = {say.given(rack.c)}", {"meshing.c": rack.c}),
    ]
    if problem.a_w is not None:
        text = f"a_{{w}} = {say.given(problem.a_w)} {units['mm']}"
        facts.append(GivenFact(text, {"meshing.a_w": problem.a_w}))
    if problem.beta:
        facts.append(GivenFact(f"β = {say.given(beta)}{say.units['deg']}", {"meshing.beta": beta}))
    if problem.width is not None:
        text = f"b_{{w}} = {say.given(problem.width)} {units['mm']}"
        facts.append(GivenFact(text, {"meshing.b": problem.width}))
    if problem.cutter:
        ring = words.meshing.ring.format(cutter=problem.cutter)
        facts.append(GivenFact(ring, {"meshing.internal": True, "meshing.cutter": problem.cutter}))
    least = {"tip": say.given(problem.tip), "overlap": say.given(problem.overlap)}
    data = {"meshing.s_a_min": problem.tip, "meshing.epsilon_min": problem.overlap}
    facts.append(GivenFact(words.meshing.least.format(**least), data))
    told: dict[str, object] = {"meshing.x": [*problem.x]}
    if problem.aim is not None:
        told = {"meshing.x": problem.aim.value}
    elif problem.alone is not None:
        told = {f"meshing.x{problem.alone + 1}": problem.x[problem.alone]}
    return [*facts, GivenFact(shifts(solved, words), told)]


def shifts(solved: SolvedMeshing, words: Language) -> Rich:
    """Return the sentence on the shifts, and whether they were chosen."""
    key = "given" if solved.problem.aim is None else solved.problem.aim.value
    sentence: str = words.meshing["shifts"][key]
    return sentence.format(**_bare(solved, words))


def _bare(solved: SolvedMeshing, words: Language) -> dict[str, str]:
    """Return the numbers without the brackets that they have within a formula."""
    return {name: shown.strip("()") for name, shown in solved.fields(words.say).items()}


def quality(solved: SolvedMeshing, words: Language) -> Iterator[Rich]:
    """Yield the verdicts of the limits, and the effect of undercut."""
    say = words.meshing
    for _, holds, text in solved.sentences(words):
        yield f"{text}: {say['holds']['yes' if holds else 'no']}"
    for k, tooth in enumerate(solved.teeth):
        if tooth.is_cut:
            rho, d = tooth.rho_low, 2 * abs(complex(tooth.flank(tooth.rho_low)))
            numbers = {"rho": rho, "d": d, "x_min": tooth.size("x_min")}
            yield say.undercut.format(wheel=k + 1, **_shown(numbers, words))
    standard, active = float(solved.pair.epsilon), solved.contact.overlap(solved.pair)
    if active < standard - 1e-9:
        yield say.cut_line.format(**_shown({"epsilon": active, "standard": standard}, words))


def _shown(numbers: dict[str, float], words: Language) -> dict[str, str]:
    return {name: words.say.number(f"{value:.3f}") for name, value in numbers.items()}


def table(told: Sequence[Told], words: Language, head: Sequence[str]) -> Table:
    """Return a table of quantities: name with unit, symbol, values."""
    return table_of(head, [_row(one, words) for one in told], names=2)


def _row(one: Told, words: Language) -> tuple[Rich, ...]:
    say, quantity = words.meshing, one.quantity
    has_unit = quantity.unit in (Unit.MM, Unit.DEGREE)
    unit = f", {say['units'][quantity.unit.value[0]]}" if has_unit else ""
    # For both wheels, without a number.
    symbol = quantity.symbol.replace("#", "").replace("_{}", "")
    return escape(say["names"][quantity.key] + unit), symbol, *one.shown(words.say)
