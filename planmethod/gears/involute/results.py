"""A pair solved: quantities, formulas with numbers, limits of the shifts, JSON record, texts."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from enum import Enum
from itertools import groupby
from math import degrees, pi, sin
from typing import Any

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.drafting import Profile
from planmethod.gears.angles import involute
from planmethod.gears.involute.formulas import RING_FORMULAS, GearSize, Unit, sizes_of
from planmethod.gears.involute.geometry import (
    LineOfAction,
    MeshingProblem,
    Pair,
    RackCutting,
    Reals,
    ShiftAim,
    Tooth,
)
from planmethod.gears.record import head
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
    plain_text,
    table_of,
)
from planmethod.note.formula import Rich, escape
from planmethod.note.numbers import Notation, finite_or_none, trimmed
from planmethod.note.records.legend import legend_record
from planmethod.note.wording import Language, get_language

STEP = 0.01
"""Chosen shifts are multiples of it."""

LOWEST_SHIFT, HIGHEST_SHIFT = -1.0, 1.5
"""Between them shifts are looked for."""

_HALVINGS = 60
_SAME = 1e-9  # difference of equal specific slidings


class LimitKind(Enum):
    """The fault that a limit prevents (вид ограничения)."""

    UNDERCUT = "undercut"
    TIP = "tip"
    OVERLAP = "overlap"
    INTERFERENCE = "interference"
    TIPS = "tips"
    BASE = "base"


class ProfileShiftLimit(Struct, frozen=True):
    """One limit (ограничение).

    Attributes
    ----------
    kind : LimitKind
    wheel : int or None
        0 or 1; None for a limit of the pair.
    min_value : float
        Least thickness at the tip in modules, or least contact ratio.
    hard : bool
        Beyond it the pair does not work; other limits are advice.
    """

    kind: LimitKind
    wheel: int | None
    min_value: float = 0.0
    hard: bool = False

    def value(self, pair: Pair) -> Reals:
        """Return the value compared with the limit: x, s_a/m, ε_α, ρ_p, d_a/m."""
        match self.kind:
            case LimitKind.UNDERCUT:
                return np.asarray(pair.x[self.wheel])
            case LimitKind.TIP:
                return np.asarray(pair.s_na[self.wheel] / pair.m)
            case LimitKind.OVERLAP:
                return pair.epsilon
            case LimitKind.INTERFERENCE:
                return np.asarray(pair.rho_p[self.wheel])
            case LimitKind.TIPS:
                return pair.tips
            case LimitKind.BASE:
                return np.asarray(np.abs(pair.d_a[self.wheel]) / pair.m)

    def bound(self, pair: Pair) -> Reals:
        """Return the limit itself: x_min, the least s_a/m or ε_α, ρ_l, d_b/m."""
        match self.kind:
            case LimitKind.UNDERCUT:
                return np.asarray(pair.x_min[self.wheel])
            case LimitKind.INTERFERENCE:
                return np.asarray(pair.rho_l[self.wheel])
            case LimitKind.TIPS:
                return np.asarray(0.0)
            case LimitKind.BASE:
                return np.asarray(np.abs(pair.d_b[self.wheel]) / pair.m)
            case _:
                return np.asarray(self.min_value)

    def margin(self, pair: Pair) -> Reals:
        """Return the margin to the limit, positive where it is met; NaN where no pair exists."""
        return np.asarray(self.value(pair) - self.bound(pair))


def limits(tip: float, overlap: float, *, internal: bool = False) -> tuple[ProfileShiftLimit, ...]:
    """Return all limits: those without which the pair does not work, then those of good use.

    The tips of an internal pair must not meet outside the mesh; its ring has no undercut.
    """
    wheels = (0, 1)
    return (
        *((ProfileShiftLimit(LimitKind.TIPS, None, hard=True),) if internal else ()),
        *(ProfileShiftLimit(LimitKind.INTERFERENCE, k, hard=True) for k in wheels),
        *(ProfileShiftLimit(LimitKind.TIP, k, hard=True) for k in wheels),
        ProfileShiftLimit(LimitKind.OVERLAP, None, 1.0, hard=True),
        *(ProfileShiftLimit(LimitKind.UNDERCUT, k) for k in wheels[: 1 if internal else 2]),
        *(ProfileShiftLimit(LimitKind.TIP, k, tip) for k in wheels),
        ProfileShiftLimit(LimitKind.OVERLAP, None, overlap),
    )


BASES = tuple(ProfileShiftLimit(LimitKind.BASE, k, hard=True) for k in (0, 1))
"""Limits beyond which a tooth has no involute: they bound the contour, not a real pair."""


def meets_limits(pair: Pair, required: tuple[ProfileShiftLimit, ...]) -> Reals:
    """Return where all of some limits are met."""
    with np.errstate(all="ignore"):
        return np.asarray(np.all([one.margin(pair) >= 0 for one in required], axis=0))


def candidate_shifts(total: float | None, side: int = 1) -> Reals:
    """Return all shifts that are compared, shape (2, ...).

    With ``total``, only those of that sum; with ``side`` -1, of that difference x₂ − x₁.
    """
    row = np.round(np.arange(round(LOWEST_SHIFT / STEP), round(HIGHEST_SHIFT / STEP) + 1) * STEP, 9)
    return np.stack([row, total - side * row] if total is not None else np.meshgrid(row, row))


def choose(
    pair: Pair,
    required: tuple[ProfileShiftLimit, ...],
    total: float | None = None,
    aim: ShiftAim = ShiftAim.BLOCKING,
) -> tuple[float, float] | None:
    """Return the shifts that meet all limits and are the best for an aim.

    All multiples of `STEP` from `LOWEST_SHIFT` to `HIGHEST_SHIFT` are compared, so that no pair
    of them is missed. The best shifts have the least maximum of specific sliding at the lower
    points, or the greatest contact ratio. For equal sliding x₁ is a multiple and x₂ follows.

    Parameters
    ----------
    total : float, optional
        Sum of the shifts, x₂ − x₁ of an internal pair, where the centre distance is given; then
        only x₁ is a multiple; for equal sliding neither is.

    Returns
    -------
    (float, float) or None
        None where no shifts meet all limits.
    """
    x = candidate_shifts(total, pair.side)
    if aim is ShiftAim.SLIDING:
        x = _equal(pair, x)
    every = pair.shifted(x)
    with np.errstate(all="ignore"):
        worst = np.max(np.abs(every.theta_p), axis=0)
        if aim is ShiftAim.OVERLAP:
            worst = -every.epsilon
        worst = np.where(meets_limits(every, required), worst, np.inf)
    worst = np.where(np.isnan(worst), np.inf, worst)
    if not np.any(np.isfinite(worst)):
        return None
    best = np.unravel_index(int(np.argmin(worst)), worst.shape)
    return float(x[0][best]), float(x[1][best])


def _equal(pair: Pair, x: Reals) -> Reals:
    """Return the shifts of equal sliding between neighbours of a grid, shape (2, n).

    Along the first axis of the grid the difference of the slidings changes its sign there.
    """

    def sliding_difference(at: Reals) -> Reals:
        with np.errstate(all="ignore"):
            one, two = np.abs(pair.shifted(at).theta_p)
        return np.asarray(one - two)

    here = sliding_difference(x)
    between = here[1:] * here[:-1] <= 0  # of NaN it is not
    low, high = x[:, :-1][:, between], x[:, 1:][:, between]
    start = sliding_difference(low)
    for _ in range(_HALVINGS):
        middle = (low + high) / 2
        is_low = sliding_difference(middle) * start > 0
        low, high = np.where(is_low, middle, low), np.where(is_low, high, middle)
    found = (low + high) / 2
    return np.asarray(
        found[:, np.abs(sliding_difference(found)) < _SAME]
    )  # no jump through infinity


_SIGNED = ("x_sum", "a", "a_w", "y", "delta_y")
_SIGNED_2 = ("z", "x", "d", "d_b", "d_w", "d_a", "d_f", "rho_a", "rho_p", "rho_l", "rho_low")
"""Quantities that are negative in `Pair` for an internal pair, and for its wheel 2."""


_ANGLES = ("alpha_w", "alpha_a", "beta", "alpha_t", "beta_b")
"""Quantities that `Pair` has in radians."""


class SizedQuantity(Struct, frozen=True):
    """A quantity with its value: one, or those of both wheels."""

    quantity: GearSize
    values: tuple[float, ...]

    def format_values(self, notation: Notation) -> list[str]:
        """Return the values as text, a dash for a value that does not exist."""
        places = self.quantity.unit.places
        return [
            notation.number(f"{value + 0.0:.{places}f}") if np.isfinite(value) else "—"
            for value in self.values
        ]


class SolvedMeshing:
    """A pair solved: its sizes, its teeth, its line of action, its limits (решение)."""

    def __init__(self, problem: MeshingProblem) -> None:
        self.problem = problem
        self.pair = pair = Pair.of(problem)
        self.teeth = (Tooth(pair, 0), Tooth(pair, 1))
        self.cuttings = tuple(RackCutting(t) if t.side > 0 else None for t in self.teeth)
        self.contact = LineOfAction.of(*self.teeth)
        self.limits = limits(problem.tip, problem.overlap, internal=bool(problem.cutter))

    @property
    def epsilon_beta(self) -> float:
        """Overlap ratio ε_β (коэффициент осевого перекрытия); 0 where the width is not known."""
        return (self.problem.width or 0.0) * sin(self.pair.beta) / (pi * self.pair.m)

    def _value(self, key: str) -> Reals:
        problem, pair, rack = self.problem, self.pair, self.pair.rack
        own = {
            "m": pair.m,
            "alpha": np.degrees(rack.alpha),
            "ha": rack.ha,
            "c": rack.c,
            "rho_f": rack.rho,
            "inv_alpha": involute(pair.alpha_t),
            "z": np.array(pair.z, dtype=float),
            "W": pair.base_tangent,
            "rho_low": np.array([tooth.rho_low for tooth in self.teeth]),
            "g_alpha": pair.rho_a[0] - pair.rho_p[0],
            "epsilon_alpha": pair.epsilon,
            "epsilon_active": self.contact.overlap(pair),
            "width": np.nan if problem.width is None else problem.width,
            "epsilon_beta": self.epsilon_beta,
            "epsilon_gamma": float(pair.epsilon) + self.epsilon_beta,
        }
        found = own[key] if key in own else getattr(pair, key)
        if key in _SIGNED_2:
            found = found * np.array([1, pair.side])
        elif key in _SIGNED:
            found = found * pair.side
        return np.asarray(np.degrees(found) if key in _ANGLES else found)

    def sized_quantities(
        self,
    ) -> tuple[list[SizedQuantity], list[SizedQuantity], list[SizedQuantity]]:
        """Return the quantities of the pair, of both wheels, and of their contact."""
        one, two, three = (
            [
                SizedQuantity(q, tuple(float(v) for v in np.atleast_1d(self._value(q.key))))
                for q in group
            ]
            for group in sizes_of(self.problem)
        )
        if self.problem.cutter:
            at = next(k for k, t in enumerate(one) if t.quantity.key == "x_sum")
            one[at] = replace(one[at], quantity=replace(one[at].quantity, symbol="x_{d}"))
        return one, two, three

    def fields(self, notation: Notation) -> dict[str, str]:
        """Return the numbers that formulas are filled with, by their names; ``x1`` of a wheel."""
        rack, alpha_w = self.pair.rack, float(self.pair.alpha_w)
        alpha_t, beta = self.pair.alpha_t, self.pair.beta
        values = {
            "h_l": rack.straight,
            "rad_alpha": alpha_t,
            "tan_alpha": np.tan(rack.alpha),
            "tan_t": np.tan(alpha_t),
            "cos": np.cos(alpha_t),
            "cos_n": np.cos(rack.alpha),
            "sin": np.sin(alpha_t),
            "cos_beta": np.cos(beta),
            "sin_beta": np.sin(beta),
            "cos_w": np.cos(alpha_w),
            "sin_w": np.sin(alpha_w),
        }
        if self.problem.cutter:
            pair = self.pair
            values |= {"a_w0": float(pair.a_w0), "d_a0": pair.d_a0}
            values |= {"sin_w0": np.sin(pair.alpha_w0), "sin_a0": np.sin(pair.alpha_a0)}
        for group in self.sized_quantities():
            for one in group:
                ends = ("",) if len(one.values) == 1 else ("1", "2")
                values |= {one.quantity.key + e: v for e, v in zip(ends, one.values, strict=True)}
        for k, angle in enumerate(self.pair.alpha_a):
            values[f"inv_alpha_a{k + 1}"] = float(involute(angle))
            values[f"tan_alpha_a{k + 1}"] = np.tan(angle)
            values[f"cos_beta_a{k + 1}"] = float(self.pair.s_na[k] / self.pair.s_a[k])
        angle = {"angle": "α_{tw}" if beta else "α_{w}"}
        return angle | {
            name: f"({shown})" if value < 0 else shown
            for name, value in values.items()
            for shown in [notation.number(trimmed(float(value), 6))]
        }

    def formulas(self, language: Language) -> Iterator[tuple[str, str]]:
        """Yield keys and formulas with their numbers and results, rich text, in order."""
        notation, fields = language.notation, self.fields(language.notation)
        tan = language.meshing.tan
        for group in self.sized_quantities():
            for one in group:
                q = one.quantity
                for k, shown in enumerate(one.format_values(notation)) if q.formula else ():
                    if not np.isfinite(one.values[k]) and self.problem.cutter:
                        continue  # a ring has no least shift
                    own, other = ("1", "2") if k == 0 else ("2", "1")

                    def substitute(text: str, index: str = own, mate: str = other) -> str:
                        text = text.replace("#", index).replace("@", mate)
                        return text.replace("0,5", notation.number("0.5"))

                    unit = "°" if q.unit is Unit.DEGREE else ""
                    unit = f" {language.meshing['units']['mm']}" if q.unit is Unit.MM else unit
                    ring = (
                        RING_FORMULAS.get(q.key, (None, None))[k] if self.problem.cutter else None
                    )
                    formula, filled = ring or (q.formula, q.numbers)
                    letters = substitute(formula).replace("{tan}", tan)
                    numbers = substitute(filled).format_map(fields | {"tan": tan})
                    yield q.key, f"{substitute(q.symbol)} = {letters} = {numbers} = {shown}{unit}"

    def evaluated_limits(self) -> Iterator[tuple[ProfileShiftLimit, float, float]]:
        """Yield every limit with the value compared with it, and its bound.

        The contact ratio is that of the teeth as cut. Radii of a ring are negative.
        """
        for one in self.limits:
            if not (one.hard and one.kind in (LimitKind.TIP, LimitKind.OVERLAP)):
                value = float(one.value(self.pair))
                if one.kind is LimitKind.OVERLAP:
                    value = self.contact.overlap(self.pair)
                yield one, value, float(one.bound(self.pair))

    def standard_values(
        self, limit: ProfileShiftLimit, value: float, bound: float
    ) -> tuple[float, float]:
        """Return value and bound with the signs of the standard: radii of a ring are positive."""
        if limit.kind is LimitKind.INTERFERENCE and limit.wheel == 1:
            return self.pair.side * value, self.pair.side * bound
        return value, bound

    def sentences(self, language: Language) -> list[tuple[ProfileShiftLimit, bool, str]]:
        """Return every limit, whether it is met, and its sentence as rich text."""
        texts, found = language.meshing, []
        for one, value, bound in self.evaluated_limits():
            number = "" if one.wheel is None else str(one.wheel + 1)
            shown = {
                k: language.notation.number(f"{v + 0.0:.3f}")
                for k, v in zip(
                    ("value", "bound"), self.standard_values(one, value, bound), strict=True
                )
            }
            holds = value >= bound
            turned = self.standard_values(one, 1.0, 1.0)[0] < 0
            sign = ("≤" if turned else "≥") if holds else (">" if turned else "<")
            name = one.kind.value
            if self.pair.beta and one.kind is LimitKind.TIP:
                name = "tip_helical"
            text = texts["conditions"][name].format(wheel=number, sign=sign, **shown)
            found.append((one, holds, text))
        return found


def record(problem: MeshingProblem, lang: str) -> dict[str, Any]:
    """Return one object for a problem: the standard's names, mm and degrees, full precision."""
    solved, language = SolvedMeshing(problem), get_language(lang)
    told: dict[str, Any] = {"length": "mm", "angle": "deg", "shifts_chosen": problem.chosen}
    told["criterion"] = None if problem.aim is None else problem.aim.value
    for group in solved.sized_quantities():
        for one in group:
            values = [finite_or_none(value) for value in one.values]
            told[one.quantity.key] = values[0] if len(values) == 1 else values
    told["k"] = [int(k) for k in told["k"]]
    told["z"] = list(problem.z)
    told["undercut"] = [tooth.is_cut for tooth in solved.teeth]
    told["cutting"] = [
        one
        and {
            "displacement": one.displacement,
            "clearance": one.clearance,
            "boundary_rho": one.boundary,
            "undercut_displacement": one.min_displacement,
            "undercut_diameter": one.cut_diameter,
        }
        for one in solved.cuttings
    ]
    told["conditions"] = [
        {
            "name": limit.kind.value,
            "wheel": None if limit.wheel is None else limit.wheel + 1,
            "value": solved.standard_values(limit, value, bound)[0],
            "limit": solved.standard_values(limit, value, bound)[1],
            "holds": holds,
            "text": plain_text(text),
        }
        for (limit, holds, text), (_, value, bound) in zip(
            solved.sentences(language), solved.evaluated_limits(), strict=True
        )
    ]
    told["internal"] = bool(problem.cutter)
    if problem.cutter:
        pair = solved.pair
        told |= {"z_0": problem.cutter, "a_w0": float(pair.a_w0), "d_a0": pair.d_a0}
    missing = [k for k, value in enumerate(told["theta_p"]) if value is None]
    if missing:
        told["theta_reason"] = language.meshing.missing.format(wheel=missing[0] + 1)
    sizes = [one.quantity for group in solved.sized_quantities() for one in group]
    legend = ((one.key, one.symbols, one.unit.in_record) for one in sizes)
    return {**head(problem), "meshing": told, "legend": legend_record(legend)}


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
