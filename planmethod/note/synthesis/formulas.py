"""Sizes of a synthesized mechanism by formulas with numbers (размеры по формулам).

They are those of the dead positions, and independent of the construction.
"""

from __future__ import annotations

from msgspec import Struct

from planmethod.note.formula import Rich
from planmethod.note.narrate.synthesis import point_name, size_symbol
from planmethod.note.spelled import (
    ONE,
    Spelled,
    cosine,
    degree,
    equation,
    magnitude,
    named,
    named_angle,
    number,
    over,
    root,
    sine,
    squared,
    tangent,
    times,
    total,
)
from planmethod.note.synthesis.drawing import Drawn
from planmethod.note.wording import Language
from planmethod.synthesis import sizes_of
from planmethod.synthesis.model import place


class SynthesisLetter(Struct, frozen=True):
    """A letter of a synthesis: given, read from the construction, or calculated (величина).

    Attributes
    ----------
    value : float
        m, degrees.
    unit : str
        Key of the unit.
    letters : Rich
        Its formula; empty of a letter that has none.
    is_input : bool
    """

    value: float
    unit: str
    letters: Rich = ""
    is_input: bool = False


class SynthesisFormulas:
    """The formulas of the sizes of a synthesis, in the order in which they are calculated.

    Attributes
    ----------
    lines : list of Rich
    letters : dict of Rich to SynthesisLetter
        Every letter, behind those that it needs.
    """

    def __init__(self, drawn: Drawn, language: Language) -> None:
        self.drawn, self.language, self.notation = drawn, language, language.notation
        self.made, self.given = drawn.synthesis, drawn.synthesis.options
        self.lines: list[Rich] = []
        self.letters: dict[Rich, SynthesisLetter] = {}
        _KINDS[self.made.kind](self)

    @property
    def values(self) -> dict[Rich, float]:
        """Values of the letters that are calculated, m and degrees."""
        return {symbol: one.value for symbol, one in self.letters.items() if one.letters}

    # Letters ---------------------------------------------------------------------------------

    def _define(self, symbol: Rich, value: Spelled, unit: str = "m") -> Spelled:
        self.lines.append(equation(symbol, value, unit, self.notation))
        self.letters[symbol] = SynthesisLetter(value.value, unit, value.sides()[0])
        letters = named_angle if unit == "°" else named
        return letters(symbol, value.value, self.notation)

    def _known(
        self, symbol: Rich, value: float, unit: str = "m", *, is_input: bool = False
    ) -> Spelled:
        """Return a letter that is given, or that the construction gives."""
        self.letters.setdefault(symbol, SynthesisLetter(value, unit, is_input=is_input))
        letters = named_angle if unit == "°" else named
        return letters(symbol, value, self.notation)

    def _symbol(self, size: str) -> Rich:
        return size_symbol(size, self.drawn.shown_letters)

    def _size(self, size: str) -> Spelled:
        return self._known(
            self._symbol(size), self.made.metres()[size], is_input=self._is_input(size)
        )

    def _is_input(self, size: str) -> bool:
        """Return whether a size of the mechanism is one of the given data."""
        keys = (key for key, one in sizes_of(self.made.kind).items() if one == size)
        return any(self.given.get(key) is not None for key in keys)

    def _datum(self, name: str) -> Spelled:
        symbol, unit = self.language.synthesis["given"][name]
        unit = "°" if unit == "deg" else unit
        short = symbol.split("\u00a0")[0]
        return self._known(short, float(self.given[name]), unit, is_input=True)

    def _set(self, size: str, value: Spelled) -> Spelled:
        return self._define(self._symbol(size), value)

    def _number(self, value: float) -> Spelled:
        return number(value, self.notation)

    def _point(self, name: str) -> Rich:
        return point_name(name, self.drawn.shown_letters)

    def _theta(self) -> Spelled | None:
        """Define the angle between the dead positions; None where no ratio above 1 gives it."""
        ratio = self.given["K_v"]
        if ratio is None or ratio == 1.0:
            return None
        given = self._datum("K_v")
        share = over(total(given, -ONE), total(given, ONE))
        return self._define("θ", times(degree(180.0, self.notation), share), "°")

    def _half(self, angle: Spelled) -> Spelled:
        return over(angle, self._number(2.0))

    # Kinds -----------------------------------------------------------------------------------

    def slotted(self) -> None:
        """Write the sizes by the right triangle of the pivots and the crank's pin."""
        theta = self._theta() or self._define("θ", self._datum("swing"), "°")
        half, centres = self._half(theta), self._size("O1O3")
        crank = self._set("O1A", times(centres, sine(half)))
        self._set("O3D", total(centres, crank))
        if self.given["stroke"] is None:
            return
        arm = self._set("O3B", over(self._datum("stroke"), times(self._number(2.0), sine(half))))
        turned = cosine(half)
        rod = None
        if self.given["rod"] is None:
            quick = over(times(arm, total(ONE, -turned)), turned)
            rod = max(over(arm, self._number(2.0)), quick, key=lambda one: one.value)
            self._set("BC", rod)
        self._set("O3M", over(times(arm, total(ONE, turned)), self._number(2.0)))

    def slider_crank(self) -> None:
        """Write them by the cosines and the area of the triangle of the pivot and the stroke."""
        theta, stroke = self._theta(), self._datum("stroke")
        sizes, two = self.made.metres(), self._number(2.0)
        ratio = self.given["lambda"]
        if theta is not None:
            tan = tangent(self._half(theta), self.language.synthesis.tangent)
            if ratio is None:
                offset = self._size("e")
            else:
                lam = self._datum("lambda")
                below = total(over(squared(lam), tan), tan)
                above = times(stroke, total(ONE, -squared(lam)))
                offset = self._define("e", over(above, times(two, below)))
            twice = times(two, stroke, magnitude(offset))
            crank = over(root(total(squared(stroke), -times(twice, tan))), two)
            rod = over(root(total(squared(stroke), over(twice, tan))), two)
            self._set("OA", crank)
            self._set("AB", rod)
            return
        if ratio is None and self.given["pressure"] is not None and not sizes["e"]:
            lam = self._define("λ", sine(self._datum("pressure")), "")
        elif ratio is None:
            lam = self._known("λ", sizes["OA"] / sizes["AB"], "")
        else:
            lam = self._datum("lambda")
        if not sizes["e"]:
            crank = self._set("OA", over(stroke, two))
            self._set("AB", over(crank, lam))
            return
        offset, wide = self._size("e"), squared(stroke)
        square = squared(lam)
        inner = total(
            times(wide, squared(total(ONE, -square))),
            -times(self._number(16.0), square, squared(offset)),
        )
        whole = total(times(wide, total(ONE, square)), times(stroke, root(inner)))
        rod = self._set("AB", over(root(over(whole, self._number(8.0))), lam))
        self._set("OA", times(lam, rod))

    def crank_rocker(self) -> None:
        """Write them by the triangles of a pivot and the chord of the rocker's end."""
        theta, two = self._theta(), self._number(2.0)
        swing, rocker = self._datum("swing"), self._size("CB")
        o, ends = self._point("O"), (f"{self._point('B')}′", f"{self._point('B')}′′")
        chord = self._define(
            f"l_{{{ends[1]}{ends[0]}}}",
            times(two, rocker, sine(self._half(swing))),
        )
        angle = self.made.facts.get("beta_deg")
        if theta is not None and angle is not None:
            beta = self._known("β", angle, "°", is_input=self.given.get("beta") is not None)
            size = magnitude(beta)
            far = over(times(chord, sine(size)), sine(theta))
            near = over(times(chord, sine(total(theta, size))), sine(theta))
            long, short = (
                self._define(f"l_{{{o}{end}}}", one)
                for end, one in zip(ends, (far, near), strict=True)
            )
        else:
            if theta is not None:
                self._define("R", over(chord, times(two, sine(theta))))
            exact = self.made.exact()
            long, short = (
                self._known(f"l_{{{o}{end}}}", abs(place(exact, at) - place(exact, "O")))
                for end, at in zip(ends, ("B'", "B''"), strict=True)
            )
        self._set("OA", over(total(long, -short), two))
        self._set("AB", over(total(long, short), two))
        if theta is not None and angle is not None:
            across = sine(total(beta, self._half(swing)))
            squares = total(squared(rocker), squared(short), -times(two, rocker, short, across))
            self._set("OC", root(squares))

    def three_positions(self) -> None:
        """Write the distances of the pivots found from the first position of the coupler."""
        exact = self.made.exact()
        for size in self.made.lengths:
            ends = [name if name in self.made.pivots else f"{name}1" for name in size]
            shifts = []
            for axis, turn in (("x", 1.0), ("y", -1j)):
                one, other = (
                    self._known(f"{axis}_{{{self._point(end)}}}", (place(exact, end) * turn).real)
                    for end in ends
                )
                shifts.append(squared(total(other, -one)))
            self._set(size, root(total(*shifts)))

    def three_angles(self) -> None:
        """Write them by Freudenstein's equation K₁cos ψ − K₂cos φ + K₃ = cos(φ − ψ)."""
        frame = self._size("OC")
        phrases = (phrase for phrase in self.made.board.phrases.values() if phrase is not None)
        found = next(facts for key, facts in phrases if key == "freudenstein")
        ratios = [self._known(f"K_{{{k}}}", float(found[f"k{k}"]), "") for k in (1, 2, 3)]
        self.lines += [" = ".join(one.sides()) for one in ratios]
        sizes = []
        for size, ratio in zip(("OA", "CB"), ratios, strict=False):
            sizes.append(self._set(size, over(frame, magnitude(ratio))))
        one, two = sizes
        sign = 1.0 if ratios[0].value * ratios[1].value > 0.0 else -1.0
        product = times(self._number(2.0), one, two, ratios[2])
        last = -product if sign > 0.0 else product
        self._set("AB", root(total(squared(one), squared(two), squared(frame), last)))


_KINDS = {
    "slotted": SynthesisFormulas.slotted,
    "slider-crank": SynthesisFormulas.slider_crank,
    "crank-rocker": SynthesisFormulas.crank_rocker,
    "three-positions": SynthesisFormulas.three_positions,
    "three-angles": SynthesisFormulas.three_angles,
}
