"""Names of quantities for workbooks and programs: ``l_AB``, ``omega_1`` (имена величин)."""

from __future__ import annotations

import keyword
import re

from planmethod.note.calculation.expression import FUNCTIONS
from planmethod.note.formula import Rich

# Cyrillic letters: those of indices become Latin ones
# no messages: names

_GREEK = dict(zip(
    "αβγδεζηθϑικλμνξπρστυφχψωΓΔΘΛΣΦΨΩ",
    (
        "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "theta", "iota",
        "kappa", "lambda", "mu", "nu", "xi", "pi", "rho", "sigma", "tau", "upsilon", "phi", "chi",
        "psi", "omega", "Gamma", "Delta", "Theta", "Lambda", "Sigma", "Phi", "Psi", "Omega",
    ),
    strict=True,
))  # fmt: skip
_CYRILLIC = dict(zip(
    "абвгдеёжзийклмнопрстуфхцчшщъыьэюя",
    (
        "a", "b", "v", "g", "d", "e", "e", "zh", "z", "i", "y", "k", "l", "m", "n", "o", "p", "r",
        "s", "t", "u", "f", "h", "c", "ch", "sh", "sch", "_", "y", "_", "e", "yu", "ya",
    ),
    strict=True,
))  # fmt: skip
_MARKS = {"′": "_q", "″": "_qq", "'": "_s", "*": "", "τ": "t"}
_CELL_RE = re.compile(r"[A-Za-z]{1,3}\d+|[RrCc]\d*|[Rr]\d*[Cc]\d*")
"""What a workbook takes for the address of a cell."""

RESERVED = frozenset(
    {*FUNCTIONS, "pi", "np", "true", "false", "numpy", "print", "show", "coefficients",
     "involute", "cosd", "sind", "tand"}
)  # fmt: skip
LONGEST = 60


def name_of(symbol: Rich) -> str:
    """Return a letter as a name of Latin letters, digits and ``_``: ``omega_1`` of ``ω_{1}``."""
    if symbol == "Δ":
        return "det"  # beside δ, a workbook takes Delta for the same name
    head, *rest = re.split(r"[_^]\{?", symbol.replace("}", "").replace("\\bar{", ""))
    parts = [_latin(part) for part in (head, *rest)]
    name = re.sub(r"_+", "_", "_".join(part for part in parts if part)).strip("_")[:LONGEST]
    if not name or name[0].isdigit():
        name = f"x_{name}" if name else "x"
    if _CELL_RE.fullmatch(name) or name in RESERVED or keyword.iskeyword(name):
        name += "_"
    return name


def _latin(text: str) -> str:
    found, before = "", ""
    for sign in text:
        low = sign.lower()
        if sign in _MARKS:
            found += _MARKS[sign]
        elif sign in _GREEK:
            is_next = found and not found.endswith("_")
            found += "_" if is_next and found[-1:].islower() and len(found) > 1 else ""
            found += _GREEK[sign]
        elif low in _CYRILLIC:
            said = _CYRILLIC[low]
            found += said if sign == low else said.capitalize()
        elif sign.isascii() and sign.isalnum():
            is_next = sign.isalpha() and before in _GREEK
            found += f"_{sign}" if is_next else sign
        else:
            found += "_"
        before = sign
    return found


class NameRegistry:
    """Names of one calculation: different also without regard to capitals, as workbooks need."""

    def __init__(self) -> None:
        self._taken = set[str]()

    def new(self, symbol: Rich, ending: str = "") -> str:
        """Return a name for a letter that no other quantity has.

        Parameters
        ----------
        ending : str, optional
            Name of the owner of the quantity, as a cam.
        """
        name = wanted = name_of(symbol) + (f"_{_latin(ending)}" if ending else "")
        number = 2
        while name.lower() in self._taken or name.lower() in RESERVED:
            name, number = f"{wanted.rstrip('_')}_v{number}", number + 1
        self._taken.add(name.lower())
        return name
