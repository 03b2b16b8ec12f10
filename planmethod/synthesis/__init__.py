"""Synthesis of linkages by construction (синтез механизмов): one module for each kind.

A kind lists its options (``OPTIONS``) and makes a `Synthesis` of their values (``synthesize``).
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Any, Protocol

from msgspec.structs import replace

from planmethod.synthesis import (
    crank_rocker,
    slider_crank,
    slotted,
    three_angles,
    three_positions,
)
from planmethod.synthesis.model import Synthesis


class SynthesisModule(Protocol):
    """Interface of the module of a kind."""

    @property
    def OPTIONS(self) -> tuple[str, ...]:  # noqa: N802
        """Options that it accepts."""

    @property
    def SIZES(self) -> Mapping[str, str]:  # noqa: N802
        """Sizes of the mechanism that are given, by their options."""

    def synthesize(self, options: Mapping[str, Any]) -> Synthesis:
        """Find the mechanism."""


KINDS: Mapping[str, SynthesisModule] = MappingProxyType(
    {
        "slotted": slotted,
        "slider-crank": slider_crank,
        "crank-rocker": crank_rocker,
        "three-positions": three_positions,
        "three-angles": three_angles,
    }
)
"""Kinds of synthesis, a module each."""


def options_of(kind: str) -> tuple[str, ...]:
    """Return the options that a kind accepts."""
    return KINDS[kind].OPTIONS


def sizes_of(kind: str) -> Mapping[str, str]:
    """Return the sizes of the mechanism that options of a kind give, by the options."""
    return KINDS[kind].SIZES


def synthesize(kind: str, options: Mapping[str, Any]) -> Synthesis:
    """Find the mechanism of a kind (синтез).

    Parameters
    ----------
    kind : str
        One of `KINDS`.
    options : mapping
        Values of the options of the kind, SI and degrees; None for an option that is not given.

    Raises
    ------
    InputError
        Too few or too many options are given, or they contradict each other.
    AssemblyError
        There is no such mechanism; the message has the limit.
    """
    return replace(KINDS[kind].synthesize(options), options=dict(options))
