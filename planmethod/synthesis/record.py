"""Record of a synthesis: what ``synthesize --json`` prints."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from planmethod.note.numbers import finite_or_none
from planmethod.synthesis.drawn import Drawn


def synthesis_record(
    drawn: Drawn, asked: Mapping[str, Any], checks: Mapping[str, Any]
) -> dict[str, Any]:
    """Return lengths (m), checks (m, degrees), and what a drawing by hand gives.

    Parameters
    ----------
    asked : mapping
        The options as they were given.
    """
    made = drawn.synthesis
    sigma = drawn.sigma
    return {
        "schema": 1,
        "kind": made.kind,
        "given": {name: value for name, value in asked.items() if value is not None},
        "lengths": made.metres(),
        "checks": dict(checks),
        "drawing": {
            "mu_l": drawn.mu,
            "read": {name: finite_or_none(drawn.read(name)) for name in made.lengths},
            "sigma": {name: finite_or_none(sigma[name]) for name in made.lengths},
        },
    }
