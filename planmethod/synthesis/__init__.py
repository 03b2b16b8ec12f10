"""Synthesis of linkages by construction (синтез механизмов): one module for each kind.

A kind says which options it takes (``TAKES``) and makes a `Synthesis` of their values
(``synthesize``).
"""

from __future__ import annotations

from collections.abc import Mapping
from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from planmethod.synthesis.model import Synthesis

KINDS = ("slotted", "slider-crank", "crank-rocker", "three-positions", "three-angles")
"""Kinds of synthesis; each is the module of its name."""


def takes(kind: str) -> tuple[str, ...]:
    """Return the options that a kind takes."""
    names: tuple[str, ...] = _module(kind).TAKES
    return names


def synthesize(kind: str, asked: Mapping[str, Any]) -> Synthesis:
    """Find the mechanism of a kind (синтез).

    Parameters
    ----------
    kind : str
        One of `KINDS`.
    asked : mapping
        Values of the options of the kind, SI and degrees; None of those that are not given.

    Raises
    ------
    AskedError
        Too little or too much is asked, or it contradicts itself.
    AssemblyError
        There is no such mechanism; the message tells the limit.
    """
    made: Synthesis = _module(kind).synthesize(asked)
    return made


def _module(kind: str) -> Any:
    return import_module(f"{__name__}.{kind.replace('-', '_')}")
