"""How quantities of a train are written, as rich text (обозначения величин)."""

from __future__ import annotations

import re
from collections.abc import Collection

from planmethod.gears.answers import Answer
from planmethod.gears.asked import parse
from planmethod.gears.model import Train
from planmethod.note.numbers import MINUS, raised
from planmethod.note.wording import Language

_GREEK = {"omega": "ω", "eta": "η"}


def symbol(name: str, known: Collection[str]) -> str:
    """Return the symbol of a quantity: ``U^{(H)}_{14}``, ``n_{5}``, ``ω_{2}``.

    Raises
    ------
    AskedError
    """
    asked = parse(name, known)
    letter = _GREEK.get(asked.kind, asked.kind)
    if not asked.labels:
        return letter
    index = ("" if all(len(label) == 1 for label in asked.labels) else "-").join(asked.labels)
    hat = f"^{{({asked.carrier})}}" if asked.carrier else ""
    return f"a_{{w{index}}}" if asked.kind == "a_w" else f"{letter}{hat}_{{{index}}}"


def unit_of(one: Answer, words: Language) -> str:
    """Return the unit of a value as rich text."""
    return raised(words.gears.units[one.unit]) if one.unit else ""


def speed_unit(train: Train) -> str:
    """Return the unit of the inputs by its key: ``1/min`` or ``1/s``."""
    return "1/min" if train.unit == "n" else "1/s"


def speed_letter(train: Train) -> str:
    """Return the letter of the speeds of the inputs."""
    return "n" if train.unit == "n" else "ω"


def indexed(text: str) -> str:
    """Return plain text with indices as rich text: ``z_2'`` gives ``z_{2'}``, ``p₁`` ``p_{1}``."""
    braced = re.sub(r"_([\w']+)", r"_{\1}", text)
    return re.sub("[₁₂]", lambda sign: f"_{{{'₁₂'.index(sign[0]) + 1}}}", braced)


def fraction_text(value: object) -> str:
    """Return a fraction, or a float's place of none."""
    return "—" if isinstance(value, float) or value is None else str(value).replace("-", MINUS)
