"""Texts of a sheet: the statement, the vector equations and the formulas with read segments."""

from __future__ import annotations

from planmethod.note.calculation import calculation
from planmethod.note.given import given, wanted
from planmethod.plans.model import PlanKind
from planmethod.plans.solution import Solution
from planmethod.render.block import Block, Column, heading, paragraph
from planmethod.render.equations import equation_block, formula_block
from planmethod.render.sheets.views import Heights

NBSP = "\u00a0"


def statement_block(solution: Solution, size: Heights, width: float) -> Block:
    """Return "Дано" and "Определить"."""
    facts = given(solution.problem, list(solution.positions))
    said = "; ".join(fact.replace(" ", NBSP) for fact in facts)
    return Column(
        [
            paragraph(f"Дано: {said}.", size.text, width=width),
            paragraph(f"Определить: {wanted(solution)}.", size.text, width=width),
        ],
        gap=3.0,
    )


def equations_block(solution: Solution, kind: PlanKind, size: Heights, width: float) -> Block:
    """Return the vector equations of a plan, one under another."""
    plan = solution.construction.plan(kind)
    title = "Уравнения скоростей" if kind is PlanKind.VELOCITY else "Уравнения ускорений"
    height = max(3.5, min(5.0, size.text))
    blocks: list[Block] = [heading(title, size.text)]
    blocks += [equation_block(e, height, width=width) for e in plan.equations]
    return Column(blocks, gap=4.0)


def calculation_block(solution: Solution, kind: PlanKind, index: int, height: float) -> Block:
    """Return the formulas with the read segments."""
    lines = calculation(solution, kind, index)
    title = "Расчёт скоростей" if kind is PlanKind.VELOCITY else "Расчёт ускорений"
    return Column([heading(title, height), *(formula_block(x, height) for x in lines)], gap=2.2)
