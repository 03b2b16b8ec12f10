"""Ready problem files of the common families of mechanisms, for ``planmethod new``."""

from __future__ import annotations

FAMILIES = (
    "slider-crank",
    "four-bar",
    "slotted-link",
    "swinging-block",
    "sine",
    "six-link",
    "driving-slider",
)
"""Their names; what they are stands in `planmethod.note.wording`."""


def template(family: str) -> str:
    """Return a commented problem file of a family, ready to edit.

    Raises
    ------
    KeyError
        The family is not in `FAMILIES`.
    """
    if family not in FAMILIES:
        raise KeyError(family)
    from importlib.resources import files  # not for those who only read

    source = files("planmethod.problem") / "templates" / f"{family}.toml"
    return source.read_text(encoding="utf-8")
