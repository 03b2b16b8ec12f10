"""Formulas on the sheets of forces, by the parts of the analysis, in one line."""

from __future__ import annotations

import re
from math import sqrt

from doors import (
    ForcePlan,
    ForcePlanNarrator,
    ForceReading,
    LeverNarrator,
    LoadNarrator,
    MomentNarrator,
    get_language,
    inlined,
    lettered,
)


def load_lines(reading: ForceReading, lang: str = "ru") -> list[str]:
    links = LoadNarrator(lettered(reading, get_language(lang))).formulas()
    return [inlined(line) for lines in links for line in lines]


def moment_lines(reading: ForceReading, plan: ForcePlan, lang: str = "ru") -> list[str]:
    voice = MomentNarrator(lettered(reading, get_language(lang)), plan)
    return [inlined(line) for equation in plan.moments for line in voice.lines(equation)]


def place_lines(reading: ForceReading, plan: ForcePlan, lang: str = "ru") -> list[str]:
    return [*map(inlined, MomentNarrator(lettered(reading, get_language(lang)), plan).places())]


def closing_lines(reading: ForceReading, number: int, lang: str = "ru") -> list[str]:
    plan = reading.plans[number]
    voice = ForcePlanNarrator(lettered(reading, get_language(lang)), plan, number)
    return [inlined(voice.force_text(edge)) for edge in plan.reactions]


def lever_lines(reading: ForceReading, lang: str = "ru") -> list[str]:
    return [*map(inlined, LeverNarrator(lettered(reading, get_language(lang))).lines())]


def force_lines(reading: ForceReading, lang: str) -> list[str]:
    """Return all formulas of a position."""
    lines = load_lines(reading, lang)
    for number, plan in enumerate(reading.plans):
        lines += moment_lines(reading, plan, lang) + closing_lines(reading, number, lang)
        lines += place_lines(reading, plan, lang)
    return lines + (lever_lines(reading, lang) if reading.statics.lever_plan is not None else [])


def computed(numbers: str, decimal: str = ",") -> float:
    """Compute an expression between two equals signs."""
    plain = numbers.replace(decimal, ".").replace("−", "-")
    plain = re.sub(r"·10\^\{(-?\d+)\}", r"e\1", plain)
    plain = re.sub(r"\^\{(\d+)\}", r"**\1", plain.replace("·", "*"))
    plain = plain.replace("√(", "sqrt(")
    assert re.fullmatch(r"(?:[\d.*/()e+\- ]|sqrt)+", plain), numbers
    return float(eval(plain, {"sqrt": sqrt}))
