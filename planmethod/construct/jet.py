"""Numbers that carry their first and second derivative in time (струя)."""

from __future__ import annotations

from planmethod.construct.arithmetic import Number


class Jet:
    """A quantity with its rate and the rate of that (значение, скорость, ускорение).

    The three parts are numbers of any type that the evaluator can read in.
    """

    __slots__ = ("acceleration", "rate", "value")
    __array_ufunc__ = None  # so that an array on the left leaves the operation to the jet

    def __init__(self, value: Number, rate: Number = 0.0, acceleration: Number = 0.0) -> None:
        self.value, self.rate, self.acceleration = value, rate, acceleration

    def parts(self) -> tuple[Number, Number, Number]:
        """Return value, rate and acceleration."""
        return self.value, self.rate, self.acceleration

    def __add__(self, other: Number) -> Jet:
        f, f1, f2 = self.parts()
        g, g1, g2 = _jet(other).parts()
        return Jet(f + g, f1 + g1, f2 + g2)

    __radd__ = __add__

    def __neg__(self) -> Jet:
        return Jet(-self.value, -self.rate, -self.acceleration)

    def __sub__(self, other: Number) -> Jet:
        return self + -_jet(other)

    def __rsub__(self, other: Number) -> Jet:
        return _jet(other) + -self

    def __mul__(self, other: Number) -> Jet:
        f, f1, f2 = self.parts()
        g, g1, g2 = _jet(other).parts()
        return Jet(f * g, f1 * g + f * g1, f2 * g + 2 * f1 * g1 + f * g2)

    __rmul__ = __mul__

    def __truediv__(self, other: Number) -> Jet:
        f, f1, f2 = self.parts()
        g, g1, g2 = _jet(other).parts()
        h = f / g
        h1 = (f1 - h * g1) / g
        return Jet(h, h1, (f2 - 2 * h1 * g1 - h * g2) / g)

    def __rtruediv__(self, other: Number) -> Jet:
        return _jet(other) / self

    def __abs__(self) -> Jet:
        f, f1, f2 = self.parts()
        r = abs(f)
        bar = (f + 0 * 1j).conjugate()
        r1 = (bar * f1).real / r
        return Jet(r, r1, (abs(f1) ** 2 + (bar * f2).real - r1 * r1) / r)

    def conjugate(self) -> Jet:
        """Return the complex conjugate."""
        return Jet(*((part + 0 * 1j).conjugate() for part in self.parts()))

    @property
    def real(self) -> Jet:
        """Real part."""
        return Jet(*((part + 0 * 1j).real for part in self.parts()))

    @property
    def imag(self) -> Jet:
        """Imaginary part."""
        return Jet(*((part + 0 * 1j).imag for part in self.parts()))


def _jet(value: Number) -> Jet:
    return value if isinstance(value, Jet) else Jet(value)
