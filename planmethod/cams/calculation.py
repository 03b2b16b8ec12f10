"""A cam as a calculation: law of motion, profile, pressure angle (расчёт кулачка).

The divisions are those of the diagrams. Each phase has its angle and its displacement; the law is
written in units of the phase. A least cam is found by the program: its radius is a given number.
"""

# no messages: formulas

from __future__ import annotations

from collections.abc import Sequence
from math import degrees, sin
from typing import TypeAlias

import numpy as np

from planmethod.cams.design import CamDesign, CamNode, design_of, nodes_of, stretch_of
from planmethod.cams.laws import Reals
from planmethod.cams.model import CamMotion, CamProblem, Contact
from planmethod.cams.text import division_rows
from planmethod.note.calculation.expression import Call, Expression, Name, Number, Operation
from planmethod.note.calculation.model import CalculationBuilder
from planmethod.note.formula import Rich, fraction
from planmethod.note.wording import Language

MOST_BITS = 6
"""Parts of a law that are written as formulas: a measured lift has a hundred."""

_NO_START = 1e-15

LawTerms: TypeAlias = tuple[list[float], float, float, float]
"""Powers of a part of a law, and size, rate and phase of a sine: `UnitLaw.terms`."""


def cam_chapter(problem: CamProblem, builder: CalculationBuilder, language: Language) -> None:
    """Write the chapter.

    Raises
    ------
    ProblemError
        No cam satisfies the requirements.
    """
    CamChapter(design_of(problem), builder, language).write(language.calculation.cam.format())


class CamChapter:
    """Writes one cam.

    Parameters
    ----------
    design : CamDesign
    builder : CalculationBuilder
    language : Language
    """

    def __init__(self, design: CamDesign, builder: CalculationBuilder, language: Language) -> None:
        self.design, self.problem = design, design.problem
        self.builder, self.texts = builder, language.calculation
        self.nodes = nodes_of(self.problem)
        self.rows = [row for _, row in division_rows(design)]
        self.m = language.notation.units["m"]

    def write(self, title: str) -> None:
        """Write the law of motion, the sizes and the profile as a chapter."""
        self.builder.add_heading(self.texts.law.format())
        self._phases()
        self._law()
        self.builder.add_heading(self.texts.geometry.format())
        self._sizes()
        self.builder.add_heading(self.texts.profile.format())
        self._profile()
        heads = [self.texts.position.format(number=node.number) for node in self.nodes]
        self.builder.close(title, heads)

    def _column(self, key: str) -> list[float]:
        return [row[key] for row in self.rows]

    # Law ---------------------------------------------------------------------------------------

    def _phases(self) -> None:
        """Write the angles and displacements of all phases, and where each begins."""
        builder, before = self.builder, 0
        for k, motion in enumerate(self.problem.motions, 1):
            name: str = self.texts["phases"][motion.phase.value]
            builder.add_input(f"φ_{{Φ{k}}}", _neat(degrees(motion.length)), "°", name)
            if motion.law is not None:
                builder.add_input(f"h_{{{k}}}", motion.after - motion.before, self.m, name)
        start = self.problem.motions[0].before
        if start:
            builder.add_input("s_{b1}", start, self.m)
        for k, motion in enumerate(self.problem.motions, 1):
            if k > 1:
                letters = f"φ_{{0,{before}}} + φ_{{Φ{before}}}" if before > 1 else "φ_{Φ1}"
                builder.formula(f"φ_{{0,{k}}}", letters, degrees(motion.start), "°")
                last = self.problem.motions[before - 1]
                parts = [f"s_{{b{before}}}"] if f"s_{{b{before}}}" in builder.symbols else []
                parts += [f"h_{{{before}}}"] if last.law is not None else []
                if parts:
                    builder.formula(f"s_{{b{k}}}", " + ".join(parts), motion.before, self.m)
            before = k

    def number_of(self, motion: CamMotion) -> int:
        """Return the number of a motion of the turn, from 1."""
        return self.problem.motions.index(motion) + 1

    def _law(self) -> None:
        builder, texts = self.builder, self.texts
        shares = [(node.phi - node.motion.start) / node.motion.length for node in self.nodes]
        part = Name(builder.value("u", shares, "", texts.share, is_input=True).name)
        angles: list[Rich | None] = []
        for node in self.nodes:
            k = self.number_of(node.motion)
            angles.append(f"φ_{{0,{k}}} + φ_{{Φ{k}}}·u" if k > 1 else "φ_{Φ1}·u")
        builder.row("φ", angles, [degrees(node.phi) for node in self.nodes], "°",
                    by_position=True)  # fmt: skip
        for order, symbol in enumerate(("f", "f′", "f″")):
            self._unit_row(symbol, self.nodes, order, part)
        for order, (symbol, letter) in enumerate((("s", "f"), ("v_{q}", "f′"), ("a_{q}", "f″"))):
            values = self._column(("s", "v_q", "a_q")[order])
            self.builder.row(symbol, self._displacements(self.nodes, order, letter), values, self.m,
                             by_position=True)  # fmt: skip

    def lift_at(self, angle: Rich, cam_angles: Reals, lift: Reals) -> None:
        """Write the displacement at other angles, whichever phases they are in.

        It is the sum of the lifts of all phases up to the angle. In each phase, u stays between
        its bounds: (|u − u_1| − |u − u_2| + u_2 − u_1) / 2.

        Parameters
        ----------
        angle : Rich
            Letter of the row of angles of the cam.
        cam_angles : Reals, rad
            Their values.
        lift : Reals, m
        """
        builder, parts = self.builder, list[Rich]()
        moving = [one for one in self.problem.motions if one.law is not None]
        if any(len(one.law.bits) > MOST_BITS for one in moving if one.law is not None):
            builder.value("s_{c}", lift.tolist(), self.m, self.texts.computed)
            return
        for motion in moving:
            k, law = self.number_of(motion), motion.law
            assert law is not None
            start = f"{angle} − φ_{{0,{k}}}" if k > 1 else angle
            shares = (cam_angles - motion.start) / motion.length
            letters = fraction(start, f"φ_{{Φ{k}}}")
            share = builder.row(f"u_{{c{k}}}", letters, shares.tolist(), "", self.texts.of_phase)
            total: Expression | None = None
            for number, bit in enumerate(law.bits):
                inside = _between(Name(share.name), bit.start, bit.end)
                gain = _gain(law.terms(number), inside)
                total = gain if total is None else Operation("+", total, gain)
            assert total is not None
            done = np.clip(shares, 0.0, 1.0)
            bits = np.searchsorted([bit.end for bit in law.bits[:-1]], done)
            values = [float(law.on(int(b), u)[0]) for b, u in zip(bits, done, strict=True)]
            symbol = f"f_{{c{k}}}"
            builder.row(symbol, total, values, "", self.texts.of_unit)
            parts.append(f"h_{{{k}}}·{symbol}")
        base = "s_{b1} + " if "s_{b1}" in builder.symbols else ""
        builder.row("s_{c}", base + " + ".join(parts), lift.tolist(), self.m)

    def _unit_row(self, symbol: Rich, nodes: Sequence[CamNode], order: int, part: Name) -> None:
        told = [self._unit_law(node, order, part) for node in nodes]
        values = [self._unit_value(node, order) for node in nodes]
        self.builder.row(symbol, told, values, "", self.texts.of_unit, by_position=True)

    def _displacements(self, nodes: Sequence[CamNode], order: int, letter: Rich) -> list[Rich]:
        """Return s, v_q or a_q by the law in units of its phase."""
        lines = list[Rich]()
        for node in nodes:
            k = self.number_of(node.motion)
            base = f"s_{{b{k}}}" if f"s_{{b{k}}}" in self.builder.symbols else ""
            rest = f"0·{letter}"
            if node.motion.law is None:
                lines.append((base or rest) if not order else rest)
                continue
            part = f"h_{{{k}}}·{letter}"
            if order:
                power = f"^{{{order}}}" if order > 1 else ""
                part = f"\\frac{{{part}}}{{(\\frac{{φ_{{Φ{k}}}·π}}{{180}}){power}}}"
            lines.append(f"{base} + {part}" if base and not order else part)
        return lines

    def _unit_value(self, node: CamNode, order: int) -> float:
        law = node.motion.law
        if law is None:
            return 0.0
        share = (node.phi - node.motion.start) / node.motion.length
        return float(law.on(stretch_of(self.problem, node).bit, share)[order])  # type: ignore[arg-type]

    def _unit_law(self, node: CamNode, order: int, part: Name) -> Expression:
        """Return a derivative of the law in units of its phase, on the part of a division."""
        law = node.motion.law
        if law is None:
            return Operation("*", Number(0.0), part)
        bit = stretch_of(self.problem, node).bit
        start = law.bits[bit].start
        x: Expression = Operation("-", part, Number(start)) if start else part
        return _derivative(law.terms(bit), x, order) or Operation("*", Number(0.0), part)

    # Profile -----------------------------------------------------------------------------------

    def _sizes(self) -> None:
        builder, one, sizes = self.builder, self.problem, self.design.geometry
        remark = "" if one.r_min is not None else self.texts.least
        builder.add_input("r_{min}", sizes.r_min, self.m, remark)
        if one.contact is Contact.ROLLER:
            builder.add_input("r_{p}", sizes.roller, self.m,
                          "" if one.roller is not None else self.texts.chosen)  # fmt: skip
        if one.oscillates:
            builder.add_input("l", one.arm, self.m)
            builder.add_input("a", sizes.centre, self.m,
                          "" if one.centre is not None else self.texts.least)  # fmt: skip
            flat = "arcsin(\\frac{r_{min}}{a})"
            other = "arccos(\\frac{a^{2} + l^{2} − r_{min}^{2}}{2·a·l})"
            letters = flat if one.contact is Contact.FLAT else other
            builder.formula("δ_{0}", letters, degrees(sizes.delta0), "°")
        elif one.contact is not Contact.FLAT:
            builder.add_input("e", sizes.e, self.m,
                          "" if one.offset is not None else self.texts.least)  # fmt: skip
            builder.formula("s_{0}", "\\sqrt{r_{min}^{2} − e^{2}}", sizes.s0, self.m)

    def _profile(self) -> None:
        one = self.problem
        if one.contact is Contact.FLAT:
            self._plate() if one.oscillates else self._level()
        else:
            self._arm() if one.oscillates else self._line()
            self._traced()

    def _rows(self, *rows: tuple[Rich, Rich, Rich]) -> None:
        """Write rows that are steps of the profile only: what the formula gives is their value."""
        for symbol, letters, unit in rows:
            self.builder.derived(symbol, letters, len(self.nodes), unit)

    def _line(self) -> None:
        self._rows(
            ("X_{B}", "e + 0·s", self.m), ("Y_{B}", "s_{0} + s", self.m),
            ("w_{x}", "s_{0} + s", self.m), ("w_{y}", "v_{q} − e", self.m),
        )  # fmt: skip
        self.builder.row("ϑ", "atan2(w_{y}; w_{x})", self._column("pressure_deg"), "°")
        self._rows(("c_{x}", "v_{q}", self.m), ("c_{y}", "a_{q}", self.m))

    def _arm(self) -> None:
        side = "" if self.design.side > 0 else "−"
        self._rows(
            ("δ", "δ_{0} + \\frac{180·s}{π·l}", "°"),
            ("X_{B}", f"{side}(a − l·cos δ)", self.m), ("Y_{B}", "l·sin δ", self.m),
            ("w_{x}", f"({side}v_{{q}} + l)·sin δ", self.m),
            ("w_{y}", "v_{q}·cos δ − X_{B}", self.m),
        )  # fmt: skip
        self.builder.row(
            "ϑ", f"atan2({side}w_{{x}}·sin δ + w_{{y}}·cos δ; w_{{x}}·cos δ − {side or ''}"
            "w_{y}·sin δ)".replace("− −", "+ "), self._column("pressure_deg"), "°",
        )  # fmt: skip
        self._rows(
            ("c_{x}", f"{side}a_{{q}}·sin δ + v_{{q}}·cos δ "
             f"{'+' if not side else '−'} \\frac{{v_{{q}}^{{2}}·cos δ}}{{l}}", self.m),
            ("c_{y}", f"a_{{q}}·cos δ − \\frac{{v_{{q}}^{{2}}·sin δ}}{{l}} "
             f"{'−' if not side else '+'} v_{{q}}·sin δ", self.m),
        )  # fmt: skip

    def _traced(self) -> None:
        """Write the profiles of a centre of a roller or of a point, turned with the cam."""
        builder, mirror = self.builder, "" if self.problem.mirror > 0 else "−"
        turned = (f"{mirror}({{0}}·cos φ + {{1}}·sin φ)", "{1}·cos φ − {0}·sin φ")
        for letters, key in zip(turned, ("x_theoretical", "y_theoretical"), strict=True):
            builder.row(f"{key[0]}_{{0}}", letters.format("X_{B}", "Y_{B}"), self._column(key),
                        self.m)  # fmt: skip
        self._rows(("w", "\\sqrt{w_{x}^{2} + w_{y}^{2}}", self.m))
        builder.row("ρ", "\\frac{w^{3}}{w^{2} − w_{x}·c_{y} + w_{y}·c_{x}}", self._column("rho"),
                    self.m)  # fmt: skip
        if self.problem.contact is not Contact.ROLLER:
            return
        self._rows(
            ("X_{K}", "X_{B} + \\frac{r_{p}·w_{y}}{w}", self.m),
            ("Y_{K}", "Y_{B} − \\frac{r_{p}·w_{x}}{w}", self.m),
        )
        for letters, key in zip(turned, ("x", "y"), strict=True):
            builder.row(key, letters.format("X_{K}", "Y_{K}"), self._column(key), self.m)

    def _level(self) -> None:
        self._rows(("X_{K}", "v_{q}", self.m), ("Y_{K}", "r_{min} + s", self.m))
        self.builder.row("ρ", "r_{min} + s + a_{q}", self._column("rho"), self.m)
        self._touching()

    def _plate(self) -> None:
        side = "" if self.design.side > 0 else "−"
        plus = "−" if side else "+"
        self._rows(
            ("δ", "δ_{0} + \\frac{180·s}{π·l}", "°"),
            ("κ", f"1 {plus} \\frac{{v_{{q}}}}{{l}}", ""),
            ("R", "\\frac{a·cos δ}{κ}", self.m),
            ("X_{K}", f"{side}(a − R·cos δ)", self.m), ("Y_{K}", "R·sin δ", self.m),
        )  # fmt: skip
        letters = (
            f"a·(\\frac{{sin δ·(1 {plus} \\frac{{2·v_{{q}}}}{{l}})}}{{κ^{{2}}}} + "
            "\\frac{cos δ·a_{q}}{l·κ^{3}})"
        )
        self.builder.row("ρ", letters, self._column("rho"), self.m)
        self._touching()

    def _touching(self) -> None:
        mirror = "" if self.problem.mirror > 0 else "−"
        turned: Sequence[tuple[str, Rich]] = (
            ("x", f"{mirror}(X_{{K}}·cos φ + Y_{{K}}·sin φ)"), ("y", "Y_{K}·cos φ − X_{K}·sin φ"),
        )  # fmt: skip
        for key, letters in turned:
            self.builder.row(key, letters, self._column(key), self.m)


def _derivative(terms: LawTerms, x: Expression, order: int) -> Expression | None:
    """Return a derivative of a part of a law at a distance from its start; None of zero."""
    powers, wave, rate, phase = terms
    for _ in range(order):
        powers = [k * factor for k, factor in enumerate(powers)][1:]
        wave *= rate
    found = _polynomial(powers, x)
    if not wave:
        return found
    turn: Expression = Operation("*", Number(_neat(degrees(rate))), x)
    shift = _neat(degrees(phase)) + 90.0 * order
    if shift:
        turn = Operation("+", turn, Number(shift))
    sine = Operation("*", Number(wave), Call("sin", (turn,)))
    return sine if found is None else Operation("+", found, sine)


def _gain(terms: LawTerms, x: Expression) -> Expression:
    """Return by how much a law grows on a part, up to a distance from its start."""
    powers, wave, rate, phase = terms
    at_start = (powers[0] if powers else 0.0) + wave * sin(phase)
    whole = _derivative(([*powers], wave, rate, phase), x, 0) or Number(0.0)
    return Operation("-", whole, Number(at_start)) if abs(at_start) > _NO_START else whole


def _between(part: Name, start: float, end: float) -> Expression:
    """Return the distance of a number from the first of two bounds, not beyond the second."""
    first, last = (
        Call("abs", (Operation("-", part, Number(one)) if one else part,)) for one in (start, end)
    )
    both = Operation("+", Operation("-", first, last), Number(end - start))
    return Operation("/", both, Number(2.0))


def _neat(angle: float) -> float:
    """Return an angle without the rounding of its conversion to degrees."""
    return round(angle, 9)


def _polynomial(powers: Sequence[float], x: Expression) -> Expression | None:
    found: Expression | None = None
    for k, factor in enumerate(powers):
        if not factor:
            continue
        size = float(factor) if found is None else abs(float(factor))
        term: Expression = Number(size)
        if k:
            power = x if k == 1 else Operation("^", x, Number(float(k)))
            term = power if size == 1.0 else Operation("*", term, power)
        found = term if found is None else Operation("+" if factor > 0 else "-", found, term)
    return found
