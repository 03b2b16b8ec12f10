"""How people write the letters of quantities: ``VB₃``, ``ω_3``, ``a_n ED`` (обозначения).

Forms are compared after all that is only a way of writing is taken away: case of the first letter,
underscores, spaces, subscripts, and letters of another alphabet that look the same.
"""

from __future__ import annotations

import unicodedata

from planmethod.problem.names import LOOKALIKES

GREEK = {"ω": "omega", "ε": "epsilon", "φ": "phi", "Φ": "inertia", "ϕ": "phi", "έ": "epsilon"}
SHORT = {"eps": "epsilon", "om": "omega", "w": "omega", "fi": "phi"}
DROPPED = str.maketrans("", "", " _{}^()|,.·-–—/'′’*\\$\u00a0\u202f")


def plain(text: str) -> str:
    """Return what is left of letters when all that is only a way of writing is taken away."""
    folded = unicodedata.normalize("NFKC", text).translate(DROPPED)
    folded = "".join(LOOKALIKES.get(c, c) for c in folded)
    folded = "".join(GREEK.get(c, c) for c in folded)
    for short, whole in SHORT.items():
        rest = folded[len(short) :]
        if folded.lower().startswith(short) and rest.isdigit():
            return whole + rest
    return folded.lower()
