"""Bad habits of students, and what a teacher would call each (привычки и их имена).

The names are codes that the product prints: the one place here that knows them. A habit without a
code is one that the product has no name for: it always counts as not named. ``slip`` is a name of
a single number calculated wrongly where nothing closer exists.
"""

from __future__ import annotations

NAMES: dict[str, str] = {
    # data and the crank
    "n taken for ω": "S2",
    "n/60 taken for ω": "S2",
    "n·9.55 taken for ω": "S2",
    "diameter for radius of the crank": "slip",
    "crank turned the other way": "V2",
    "aⁿ of the crank without the square": "N3 slip",
    # reading of plans
    "relative velocity along the link": "V1",
    "absolute and relative exchanged": "V6",
    "relative taken for absolute": "V6",
    "another point's segment read": "V6 N5",
    "whole acceleration read for the tangential": "N5",
    "similarity from the other end": "V3",
    "similar figure mirrored": "V3",
    # scales
    "μ_v forgotten": "scale",
    "μ_v inverted": "S1 scale",
    "μ of another plan for μ_v": "S3 scale",
    "μ_a forgotten": "scale",
    "μ_a inverted": "S1 scale",
    "μ of another plan for μ_a": "S3 scale",
    "μ_F forgotten": "scale",
    "μ_F inverted": "S1 scale",
    "μ of another plan for μ_F": "S3 scale",
    "μ forgotten once": "scale slip",
    # angular velocities and accelerations
    "ω with l in mm": "S2",
    "ω by another point's velocity": "V6 slip",
    "ω by another link's length": "V5 slip",
    "diameter for radius in ω": "V5 slip",
    "ω in the other sense": "sign",
    "ε with l in mm": "S2",
    "ε from the whole acceleration": "E2 N5",
    "ε in the other sense": "E1 sign",
    "whole length of the slotted link for its arm": "V5",
    "μ_l forgotten in the arm": "V5 S2 true_mm",
    # accelerations
    "aⁿ by another link's velocity": "N3",
    "aⁿ without the square": "N3",
    "aⁿ away from the centre": "N1",
    "2 of Coriolis forgotten": "A3",
    "ω₁ in Coriolis": "A5",
    "another velocity in Coriolis": "A4",
    "Coriolis forgotten": "A1",
    "Coriolis turned the other way": "A2",
    # copying to the form
    "decimal point moved": "S4",
    "two digits swapped": "S4",
    "two values swapped": "swap V6 N5 K1",
    # forces
    "mass in grams": "S2",
    "inertia force along the acceleration": "F1",
    "mass taken for weight": "F3",
    "weight left out": "F3",
    "inertia couple left out": "F2",
    "inertia couple turned the other way": "F2",
    "arms in mm": "F4 S2",
    "moment of a weight left out": "F3",
    "R^τ of the other sense": "F5 sign",
    "force × 1000": "S2 S4",
    "moment of the other sense": "F5 sign",
    "load left out of the lever": "F6",
    "couple left out of the lever": "Z2 F2",
    # trains
    "carrier forgotten in U": "G3",
    "sign of the stopped ratio": "G1",
    "ratio inverted": "G2",
    "another rim of the satellite": "G4",
    "carrier forgotten in n₂": "G3",
    "carrier added in n₂": "G3 G1",
    "sign of a meshing in n₂": "G1",
    "sign of a given speed": "G1",
    "mean of two speeds": "slip",
    "sign of an internal meshing": "G1",
    "sign of an external meshing": "G1",
    "product instead of quotient for n_H": "G2",
    "ratios added": "slip",
    "n taken for ω at the end": "S2",
    "n/60 for ω": "S2",
    "n·9.55 for ω": "S2",
    # moving points
    "degrees for radians": "K6",
    "sign of a derivative": "sign slip",
    "half of a derivative's term lost": "slip",
    "sum of components": "K4",
    "one component left out": "slip",
    "sign inside a_τ": "slip",
    "a_τ divided by a": "slip",
    "aⁿ = a − a_τ": "K4",
    "aⁿ with plus under the root": "K2 slip",
    "ρ from the whole acceleration": "K2",
    "ρ without the square": "K5",
}
"""Codes that name a habit rightly, by habit."""


def codes_of(habit: str) -> frozenset[str]:
    """Return the codes that name a habit."""
    return frozenset(NAMES[habit].split())
