"""Shipped compositions (готовые компоновки): their names and texts, one TOML file each.

The files have placeholders for words, ``$homework_title``, which come from a language,
`Language.layouts`.
"""

from __future__ import annotations

from pathlib import Path
from string import Template

from planmethod.languages import LANGUAGES
from planmethod.note.wording import get_language

SHIPPED = (
    "one-position",
    "few-positions",
    "many-positions",
    "compact",
    "homework",
    "coursework",
    "coursework-12",
    "forces",
    "forces-cycle",
    "friction",
    "flywheel",
    "run-up",
    "balancing",
    "project-kinematics",
    "project-forces",
    "graphs",
    "analytic",
    "centres",
    "superposition",
    "four-sheets",
    "synthesis",
)
"""Compositions that come with the program; the first three are the defaults."""


def shipped_text(name: str, lang: str = LANGUAGES[0]) -> str:
    """Return the text of a shipped composition in a language, commented and ready to edit.

    Raises
    ------
    KeyError
        The name is not in `SHIPPED`.
    """
    if name not in SHIPPED:
        raise KeyError(name)
    text = (Path(__file__).parent / f"{name}.toml").read_text(encoding="utf-8")
    return Template(text).substitute(get_language(lang).layouts)


def about(name: str, lang: str = LANGUAGES[0]) -> str:
    """Return the description of a shipped composition."""
    import tomllib

    return str(tomllib.loads(shipped_text(name, lang)).get("about", ""))
