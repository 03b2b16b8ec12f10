"""Schemes of trains whose teeth are chosen, their specifications, and sets of teeth.

Separate from the search, which needs NumPy: solving a train does not.
"""

from __future__ import annotations

import math
from fractions import Fraction

from msgspec import Struct

from planmethod.gears.model import MeshKind


class TrainScheme(Struct, frozen=True):
    """A usual scheme of a train (схема).

    Attributes
    ----------
    name : str
    kinds : tuple of MeshKind
        Kinds of the meshes 1-2 and 2'-3, or of the only mesh.
    single : bool
        The second wheel has one rim.
    is_planetary : bool
        A carrier H has wheel 2, and wheel 3 is held.
    ratio_name : str
        The ratio that U means.
    """

    name: str
    kinds: tuple[MeshKind, ...]
    single: bool
    is_planetary: bool
    ratio_name: str

    @property
    def wheels(self) -> tuple[str, ...]:
        """The wheels, in the order of a set."""
        if len(self.kinds) == 1:
            return "1", "2"
        return ("1", "2", "3") if self.single else ("1", "2", "2'", "3")

    @property
    def rings(self) -> tuple[str, ...]:
        """Wheels with internal teeth."""
        ends = zip(self.kinds, ("1", "3"), strict=False)
        return tuple(label for kind, label in ends if kind is MeshKind.INTERNAL)


_OUT, _IN = MeshKind.EXTERNAL, MeshKind.INTERNAL
SCHEMES = (
    TrainScheme("ring", (_OUT, _IN), True, True, "U_1_H"),
    TrainScheme("external-internal", (_OUT, _IN), False, True, "U_1_H"),
    TrainScheme("two-external", (_OUT, _OUT), False, True, "U_H_1"),
    TrainScheme("two-internal", (_IN, _IN), False, True, "U_H_1"),
    TrainScheme("pair", (_OUT,), True, False, "U_1_2"),
    TrainScheme("two-stage", (_OUT, _OUT), False, False, "U_1_3"),
)
"""One-rim set with a ring, sets with two rims by their meshes, a pair, a coaxial pair of stages."""


class TeethSpecification(Struct, frozen=True):
    """Specification of the teeth to be chosen (техническое задание).

    Attributes
    ----------
    ratio : Fraction
        U, with its sign.
    tolerance : Fraction
        Allowed relative error of U, both ways; below 1.
    planets : int
        Number of planets k.
    min_teeth, max_teeth, max_ring_teeth : int
        Bounds of the teeth; the last of wheels with internal teeth.
    modules : tuple of Fraction, mm, or None
        Modules of the two rows; None where both have the same, whatever it is.
    """

    scheme: TrainScheme
    ratio: Fraction
    tolerance: Fraction = Fraction(2, 100)
    planets: int = 3
    min_teeth: int = 17
    max_teeth: int = 120
    max_ring_teeth: int = 250
    modules: tuple[Fraction, Fraction] | None = None

    @property
    def rows(self) -> tuple[int, int]:
        """Modules of the two rows as whole numbers of a unit of their own."""
        one, other = self.modules or (Fraction(1), Fraction(1))
        both = math.lcm(one.denominator, other.denominator)
        return int(one * both), int(other * both)


class TeethSet(Struct, frozen=True):
    """Teeth that meet every condition (вариант).

    Attributes
    ----------
    teeth : tuple of int
        By `TrainScheme.wheels`.
    ratio, error : Fraction
        U, and its relative difference from the requested one.
    size : Fraction
        Diameter of the pitch circles together, in modules of the first row.
    """

    teeth: tuple[int, ...]
    ratio: Fraction
    error: Fraction
    size: Fraction


class TeethSelection(Struct, frozen=True):
    """Result of a search for teeth (результат подбора).

    Attributes
    ----------
    tried_count, match_count : int
        Combinations of teeth tried, and sets among them.
    sets : tuple of TeethSet
        The first of them, by size, those of equal size by the error of U.
    """

    spec: TeethSpecification
    tried_count: int
    match_count: int
    sets: tuple[TeethSet, ...]
