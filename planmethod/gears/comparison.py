"""Variants of a planetary train compared by size and number of planets (сравнение вариантов)."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from msgspec import Struct

from planmethod.errors import Fault, ProblemError
from planmethod.gears.meshes import fraction
from planmethod.gears.model import GearProblem, Train
from planmethod.gears.motion import TrainMotion
from planmethod.gears.solution import max_planets
from planmethod.gears.teeth import SCHEMES, TeethSet, TeethSpecification, TrainScheme
from planmethod.languages import translate
from planmethod.problem.tables import PlanetaryTask


class PlanetaryVariant(Struct, frozen=True):
    """A set of teeth for a number of planets (вариант).

    Attributes
    ----------
    planets : int
    place : int
        Its rank among all sets for that number of planets, from 1, the smallest first.
    chosen : TeethSet
    is_file_train : bool
        Whether it is the train of the file.
    """

    planets: int
    place: int
    chosen: TeethSet
    is_file_train: bool


class PlanetaryComparison(Struct, frozen=True):
    """Comparison of the train of a file with other variants (сравнение).

    Attributes
    ----------
    set_counts : mapping of int to int
        Number of sets for each number of planets.
    file_set : TeethSet
        The train of the file.
    planets : int
        Number of its planets: from the file, else the largest that can be assembled.
    """

    scheme: TrainScheme
    task: PlanetaryTask
    ratio: Fraction
    module_m: Fraction | None
    set_counts: Mapping[int, int]
    variants: tuple[PlanetaryVariant, ...]
    file_set: TeethSet
    planets: int

    @property
    def place(self) -> PlanetaryVariant | None:
        """The train of the file among the variants; None if it does not meet the requirements."""
        return next((one for one in self.variants if one.is_file_train), None)

    def diameter(self, one: TeethSet) -> float | None:
        """Return the diameter over the pitch circles, mm; None without a module."""
        return None if self.module_m is None else float(one.size * self.module_m * 1000)


def planetary_labels(train: Train) -> tuple[str, TrainScheme, tuple[str, ...]] | None:
    """Return the carrier of a planetary stage, its scheme, its wheels in the order of a set.

    Other stages before or behind it make no difference. None where no carrier of the train has one
    of the schemes that teeth are chosen for.
    """
    for carrier in train.carriers:
        found = _scheme_of(train, carrier)
        if found is not None:
            return carrier, *found
    return None


def _scheme_of(train: Train, carrier: str) -> tuple[TrainScheme, tuple[str, ...]] | None:
    own_meshes = [mesh for mesh in train.meshes if train.carrier(mesh) == carrier]
    held = [one for one in own_meshes if set(train.ends(one)) & train.fixed]
    if len(own_meshes) != 2 or len(held) != 1 or not train.toothed:
        return None
    last = held[0]
    first = next(one for one in own_meshes if one is not last)
    at = 0 if train.ends(last)[0] in train.fixed else 1
    satellite = train.ends(last)[1 - at]
    if satellite not in train.ends(first):
        return None
    labels = (last.first, last.second)
    near = (first.first, first.second)
    own = train.ends(first).index(satellite)
    wheels = (near[1 - own], near[own], labels[1 - at], labels[at])
    single = wheels[1] == wheels[2]
    for scheme in SCHEMES:
        if (
            scheme.is_planetary
            and scheme.kinds == (first.kind, last.kind)
            and scheme.single is single
        ):
            return scheme, (wheels[:2] + wheels[3:]) if single else wheels
    return None


def compare(problem: GearProblem, motion: TrainMotion) -> PlanetaryComparison | None:
    """Return the variants for every number of planets; None if the file asks for no comparison.

    Raises
    ------
    ProblemError
        The train is not one of the planetary schemes for which teeth are chosen.
    """
    train, task = motion.train, motion.train.design
    if task is None:
        return None
    from planmethod.gears.teeth_selection import choose, set_of

    known = planetary_labels(train)
    sizes = motion.axes.sizes
    if known is None or any(sizes[label].denominator != 1 for label in known[2]):
        names = ", ".join(one.name for one in SCHEMES if one.is_planetary)
        text = "the train is not one of the planetary schemes that are compared"
        hint = translate("They are: {}; the last wheel held, sizes in teeth.", names)
        raise ProblemError(problem.source_file, [Fault("gears.design", text, hint)])
    carrier, scheme, labels = known
    teeth = tuple(int(sizes[label]) for label in labels)
    ratio = fraction(task.U) if task.U is not None else None
    modules = (train.module_of(labels[0]), train.module_of(labels[-1]))
    rows = None if modules[0] is None or modules[1] is None else (modules[0], modules[1])
    if rows is not None and rows[0] == rows[1]:
        rows = None
    own = set_of(_specification(scheme, task, ratio or Fraction(1), 1, rows), teeth)
    ratio = ratio or own.ratio
    count = train.planets.get(carrier) or max_planets(motion, carrier) or 1
    found, variants = {}, list[PlanetaryVariant]()
    for k in sorted({*range(task.k_min, task.k_max + 1), count}):
        chosen = choose(_specification(scheme, task, ratio, k, rows))
        found[k] = chosen.match_count
        variants += [
            PlanetaryVariant(k, place, one, k == count and one.teeth == teeth)
            for place, one in enumerate(chosen.sets, 1)
            if place <= task.count or (k == count and one.teeth == teeth)
        ]
    own = set_of(_specification(scheme, task, ratio, count, rows), teeth)
    return PlanetaryComparison(scheme, task, ratio, modules[0], found, tuple(variants), own, count)


def _specification(
    scheme: TrainScheme,
    task: PlanetaryTask,
    ratio: Fraction,
    count: int,
    rows: tuple[Fraction, Fraction] | None,
) -> TeethSpecification:
    within = fraction(task.within)
    return TeethSpecification(
        scheme, ratio, within, count, task.z_min, task.z_max, task.ring_max, rows
    )
