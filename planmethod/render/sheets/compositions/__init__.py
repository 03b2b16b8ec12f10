"""Shipped compositions (готовые компоновки): their names and texts, one TOML file each."""

from __future__ import annotations

from pathlib import Path

SHIPPED = ("one-position", "many-positions", "homework", "coursework-12", "forces", "forces-cycle")
"""Compositions that come with the program; the first two are taken when none is asked for."""


def shipped_text(name: str) -> str:
    """Return the text of a shipped composition, commented and ready to edit.

    Raises
    ------
    KeyError
        The name is not in `SHIPPED`.
    """
    if name not in SHIPPED:
        raise KeyError(name)
    return (Path(__file__).parent / f"{name}.toml").read_text(encoding="utf-8")


def about(name: str) -> str:
    """Return what a shipped composition says of itself."""
    import tomllib

    return str(tomllib.loads(shipped_text(name)).get("about", ""))
