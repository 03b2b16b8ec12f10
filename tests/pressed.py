"""The mechanism of the textbook's third example, as a program builds it."""

from __future__ import annotations

import planmethod as pm


def press() -> pm.Mechanism:
    """Return the mechanism of ex3 as a program writes it."""
    m = pm.Mechanism("press")
    m.frame(A=(0, 0), C=(0, -0.11), guides={"x-x": ("A", 0)})
    m.link("1", A="B", length=0.064)
    m.link("3", C="D", length=0.22)
    m.slider("2", on="3", at="B")
    m.link("4", D="E", length=0.18)
    m.slider("5", on="x-x", at="E")
    m.drive("1", omega=50)
    return m.assemble(E="right of D")
