"""Ready problem files of the common families of mechanisms, for ``planmethod new``."""

from __future__ import annotations

FAMILIES: dict[str, str] = {
    "slider-crank": "кривошипно-ползунный механизм",
    "four-bar": "шарнирный четырёхзвенник",
    "slotted-link": "кулисный механизм с вращающейся кулисой",
    "swinging-block": "механизм с качающимся цилиндром (камнем)",
    "sine": "синусный (кулисно-ползунный) механизм",
    "six-link": "шестизвенный механизм с кулисой и ползуном",
    "driving-slider": "механизм с ведущим ползуном",
}
"""Family and its description in Russian."""


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
