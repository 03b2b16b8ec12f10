"""Spellings of the letters of quantities: ``VB₃``, ``ω_3``, ``a_n ED`` (обозначения).

Spellings are compared after normalization: case of the first letter, underscores, spaces,
subscripts, and letters of another alphabet that look the same.
"""

from __future__ import annotations

import unicodedata

from planmethod.problem.names import LOOKALIKES
from planmethod.problem.selector import Selector

GREEK = {
    "ω": "omega", "ε": "epsilon", "φ": "phi", "Φ": "inertia", "ϕ": "phi", "έ": "epsilon", "τ": "t",
}  # fmt: skip
SHORT = {"eps": "epsilon", "om": "omega", "w": "omega", "fi": "phi"}
DROPPED = str.maketrans("", "", " _{}^()|,.·-–—/'′’*\\$\u00a0\u202f")


def normalize(text: str) -> str:
    """Return the letters without all differences of spelling."""
    folded = unicodedata.normalize("NFKC", text).translate(DROPPED)
    folded = "".join(LOOKALIKES.get(c, c) for c in folded)
    folded = "".join(GREEK.get(c, c) for c in folded)
    for short, whole in SHORT.items():
        rest = folded[len(short) :]
        if folded.lower().startswith(short) and rest.isdigit():
            return whole + rest
    return folded.lower()


def name_and_symbol(selector: Selector) -> tuple[str, str]:
    """Return what a quantity is called, ``v_B3``, and its symbol in rich text, ``v_{B3}``."""
    kind, names = selector.kind, selector.names
    own = f"{kind.replace(' ', '_')}_{'_'.join(names)}" if names else kind
    letters = {
        "omega": "ω",
        "epsilon": "ε",
        "phi": "φ",
        "vs": "v",
        "an": "a^{n}",
        "at": "a^{τ}",
        "ak": "a^{k}",
        "ar": "a^{r}",
        "Ft": "F^{τ}",
        "Fn": "F^{n}",
        "weight": "G",
        "inertia": "Φ",
        "length": "l",
        "v_q": "v",
        "a_q": "a",
        "epsilon_q": "ε",
        "load": "",
    }
    if selector.over is not None:
        over_own, over_symbol = name_and_symbol(selector.over)
        one_own, one_symbol = name_and_symbol(Selector(kind, names))
        return f"{one_own}/{over_own}", f"{one_symbol}/{over_symbol}"
    if kind.startswith("segment"):
        return own, "".join(name.lower() for name in names)
    if kind.startswith("arm"):
        return own, "h_{" + ",".join(names) + "}"
    if kind.startswith("angle"):
        return own, "α_{" + ",".join(names) + "}"
    letter = letters.get(kind, kind)
    if kind == "load":
        return own, names[0]
    if kind.endswith("_q"):
        return own, f"{letter}_{{q{names[0]}}}"
    if kind == "inertia couple":
        return own, f"M_{{Φ{names[0]}}}"
    joined = "".join(names) if all(len(n) < 3 for n in names) else ",".join(names)
    return own, f"{letter}_{{{joined}}}" if names else letter


def worded(selector: Selector) -> str:
    """Return a quantity in the words of ``[published]``: what `parse_selector` reads as it."""
    kind, names = selector.kind, list(selector.names)
    if kind.startswith("arm "):
        names.insert(-1, "about")
    words = " ".join((kind, *names))
    return words if selector.over is None else f"{words} / {worded(selector.over)}"
