"""Schemes without redundant constraints, found by search and evaluated by rank (самоустановка).

A plane pair keeps three constraints out of the plane: a slide along z and the turns about x and y.
What it may be made free of are columns of these three, (turn x, turn y, slide z at the origin).
Every contour of a group must be free in all three; the freedoms of its pairs, summed about the
contours, are a square matrix, and q = 0 without loose motions exactly when it is regular. In the
plane nothing changes: no freedom here has a part in it. A group's outer links count as the frame,
so the whole is block-triangular, and regular when each group is.

A count of freedoms is not enough: a cylindrical pair whose line passes through the centre of a
sphere has one rotation twice, so one constraint stays redundant and one link is loose. The search
is by groups, as in the textbooks, although a search of the whole mechanism would find schemes with
fewer changes: in these a group has redundant constraints and another one loose links.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import combinations, islice

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.mechanism.groups import AssurGroup, Joint, driver_joint
from planmethod.mechanism.model import FRAME, HigherPair, Mechanism, Prismatic, Revolute
from planmethod.mechanism.structure import Structure
from planmethod.problem.model import Problem
from planmethod.solved.aligned.poses import PlanePose, group_pairs, poses

TURNING = ("1v", "2c", "3s")
"""Classes of a turning pair: hinge, cylinder along its axis, sphere."""

SLIDING = ("1p", "2c", "3pl")
"""Classes of a sliding pair: prism, cylinder about its line, plane through its line and z."""

TOUCHING = ("4l", "5t")
"""Classes of a higher pair: profiles that touch along a line, and in a point."""

MAX_SCHEMES = 60
"""Most schemes of a group, and of a mechanism, that are given."""

TRIED = TRIED_FREER = 20_000
"""Maximum number of schemes evaluated per group, and of those that leave local mobilities; only
large groups of high classes have more."""

REGULAR = 1e-7
"""Least pivot of a regular matrix; lengths are in parts of the group's size."""

GENERIC = 3
"""Index of the pose in a sweep that is in general position: not at a round driver angle."""

PLANE = ("1v", "1p", "4l")
"""Classes of the pairs as they are in the plane."""

Column = tuple[float, float, float]


class MovablePair(Struct, frozen=True):
    """Pair of two links that may be given more freedom (кинематическая пара).

    ``key`` names it: joint or pin, and its links, the frame 0: ``B 2-3``; of a higher pair the
    roller that touches, while ``links`` has the link that the roller is on.
    """

    key: str
    joint: Joint | HigherPair
    links: tuple[str, str]

    @property
    def classes(self) -> tuple[str, ...]:
        """Classes that it may have, the plane one first."""
        if isinstance(self.joint, HigherPair):
            return TOUCHING
        return TURNING if isinstance(self.joint, Revolute) else SLIDING


class AlignedScheme(Struct, frozen=True):
    """Pairs of a group without redundant constraints (схема без избыточных связей).

    Attributes
    ----------
    classes : tuple of str
        In the order of the group's pairs.
    loose : int
        How many constraints are redundant yet, and as many motions loose; 0 of a true scheme.
    steady : bool
        True if it is regular in all examined positions; else links are loose in some.
    local : int
        Local mobilities (местные подвижности): motions out of the plane that it leaves, q = 0.
    """

    classes: tuple[str, ...]
    loose: int = 0
    steady: bool = True
    local: int = 0

    @property
    def changes(self) -> int:
        """Number of pairs whose class has changed."""
        return sum(name not in PLANE for name in self.classes)


class AlignedGroup(Struct, frozen=True):
    """Group with its schemes, the best first (группа и её схемы).

    ``links`` are those of the group without what replaces higher pairs. Schemes that leave local
    mobilities are there only where no other is regular.
    ``counted`` has those of a dyad that the formula takes for right, and the rank does not: as many
    constraints as its ``loose`` stay redundant, and as many motions are loose instead.
    """

    group: AssurGroup
    links: tuple[str, ...]
    pairs: tuple[MovablePair, ...]
    schemes: tuple[AlignedScheme, ...]
    counted: tuple[AlignedScheme, ...] = ()


class SelfAligning(Struct, frozen=True):
    """Mechanism without redundant constraints (самоустанавливающийся механизм).

    Attributes
    ----------
    drivers : tuple of MovablePair
        The pair of each driver with the frame, which stays as it is.
    groups : tuple of AlignedGroup
    schemes : tuple of mapping of str to str
        Class of every pair by its key, the best scheme first: fewest changes, then least mobility
        (that of the plane where there is such a scheme), then those that are regular in all
        positions; at most `MAX_SCHEMES`.
    rank : int
        Of the spatial constraint matrix of the first scheme, all links and pairs at once.
    local : tuple of int
        Number of local mobilities that each scheme leaves, besides those of rollers.
    random : bool
        True if ranks are those of random sizes, because the file's close in no position.
    """

    drivers: tuple[MovablePair, ...]
    groups: tuple[AlignedGroup, ...]
    schemes: tuple[Mapping[str, str], ...]
    rank: int = 0
    local: tuple[int, ...] = ()
    random: bool = False

    @property
    def pairs(self) -> tuple[MovablePair, ...]:
        """All pairs: the drivers', then those of the groups."""
        return (*self.drivers, *(pair for group in self.groups for pair in group.pairs))

    @property
    def counts(self) -> dict[int, int]:
        """Number of pairs of the first scheme with mobility 1, 2 and 3: p1, p2, p3."""
        found: dict[int, int] = {}
        for name in self.schemes[0].values() if self.schemes else ():
            found[int(name[0])] = found.get(int(name[0]), 0) + 1
        return found

    @property
    def rows(self) -> int:
        """Rows of the constraint matrix of the first scheme, as many as it has constraints."""
        return sum((6 - mobility) * count for mobility, count in self.counts.items())

    @property
    def without(self) -> tuple[AlignedGroup, ...]:
        """Groups that have no scheme."""
        return tuple(group for group in self.groups if not group.schemes)


def self_aligning(problem: Problem, structure: Structure) -> SelfAligning:
    """Find the schemes without redundant constraints of a mechanism (устранение избыточных связей).

    Parameters
    ----------
    problem : Problem
        Its sizes determine the poses in which ranks are evaluated; if it has none, they are random.
    structure : Structure
        Result of `planmethod.mechanism.structure.analyse` for its mechanism.
    """
    mechanism = problem.mechanism
    # No spatial schemes are known for meshes and passive links.
    plain = not (mechanism.meshes or mechanism.passive)
    places = poses(problem, structure) if structure.groups and plain else []
    groups = (
        () if not plain else tuple(_aligned(mechanism, group, places) for group in structure.groups)
    )
    drivers = tuple(
        _pair(mechanism, driver_joint(mechanism, link), FRAME, link) for link in mechanism.drivers
    )
    whole = [_CombinedScheme()] if plain and all(group.schemes for group in groups) else []
    for group in groups:
        # The sums that are compared grow with every group: the best wholes have the best parts.
        grown = [one.with_(group, scheme) for one in whole for scheme in group.schemes]
        whole = sorted(grown, key=lambda one: one.rank)[:MAX_SCHEMES]
    rollers = [one for one in mechanism.higher if one.roller]
    first = {pair.key: pair.classes[0] for pair in drivers}
    first |= {f"{one.at} {one.links[1]}-{one.roller}": TURNING[0] for one in rollers}
    named = tuple({**first, **dict(one.classes)} for one in whole)
    local = tuple(one.rank[1] for one in whole)
    random = bool(problem.bodies) and any(one.random for one in places)
    found = SelfAligning(drivers, groups, named, local=local, random=random)
    if not places or not named:
        return replace(found, rank=5 if named else 0)
    generic = places[min(GENERIC, len(places) - 1)]
    # A roller has its hinge, whose five constraints nothing repeats.
    rank = constraint_rank(found.pairs, named[0], generic) + 5 * len(rollers)
    return replace(found, rank=rank)


class _CombinedScheme(Struct, frozen=True):
    """Scheme of some groups: its rank for comparison, and its classes."""

    rank: tuple[int, ...] = (0, 0, 0, 0)
    classes: tuple[tuple[str, str], ...] = ()

    def with_(self, group: AlignedGroup, scheme: AlignedScheme) -> _CombinedScheme:
        rank = tuple(a + b for a, b in zip(self.rank, _rank(scheme), strict=True))
        named = zip((pair.key for pair in group.pairs), scheme.classes, strict=True)
        return _CombinedScheme(rank, (*self.classes, *named))


def _rank(scheme: AlignedScheme) -> tuple[int, ...]:
    """Return the key by which schemes are compared: changes, mobility, steadiness, rare pairs."""
    unusual = sum(name == "3pl" for name in scheme.classes)
    return scheme.changes, scheme.local, int(not scheme.steady), unusual


def _pair(mechanism: Mechanism, joint: Joint | HigherPair, one: str, two: str) -> MovablePair:
    order = (FRAME, *mechanism.links)
    first, second = sorted((one, two), key=order.index)
    match joint:
        case Revolute():
            name = joint.point
        case Prismatic():
            name = joint.pin
        case HigherPair():
            name = joint.name
            return MovablePair(f"{name} {first}-{joint.roller or second}", joint, (first, second))
    return MovablePair(f"{name} {first}-{second}", joint, (first, second))


def constraint_rank(
    pairs: Sequence[MovablePair], classes: Mapping[str, str], pose: PlanePose
) -> int:
    """Return the rank of the spatial constraint matrix of a whole mechanism (матрица связей).

    Six columns for the twist of each moving link, a row for each constraint of each pair: with W
    motions left and no redundant constraint there are 6n - W rows, and that is the rank.
    """
    links = sorted({link for pair in pairs for link in pair.links} - {FRAME})
    column = {link: 6 * i for i, link in enumerate(links)}
    size = max(map(abs, pose.places.values())) or 1.0
    rows: list[dict[int, float]] = []  # by columns: nearly all of a long chain's is zero
    for pair in pairs:
        at, along = pose.line(pair.joint)
        for row in _constraints(classes[pair.key], at / size, along):
            whole: dict[int, float] = {}
            for link, sign in zip(pair.links, (1, -1), strict=True):
                if link != FRAME:
                    whole.update((column[link] + i, sign * value) for i, value in enumerate(row))
            rows.append(whole)
    largest = [max(map(abs, row.values())) for row in rows]
    rank = 0
    while rows:
        first = largest.index(max(largest))
        head, most = rows.pop(first), largest.pop(first)
        if most < REGULAR:
            break
        k = min(i for i, value in head.items() if abs(value) == most)
        rank += 1
        for number, other in enumerate(rows):
            share = other.get(k, 0.0) / head[k]
            if share:
                other.update({i: other.get(i, 0.0) - share * value for i, value in head.items()})
                largest[number] = max(map(abs, other.values()))
    return rank


def _constraints(name: str, at: complex, direction: complex) -> list[list[float]]:
    """Return a pair's constraints on the relative twist: turns about, slides along x, y, z at 0."""
    x, y = at.real, at.imag
    z: complex = 0j

    def turn(axis: complex, up: float = 0.0) -> list[float]:
        return [axis.real, axis.imag, up, 0.0, 0.0, 0.0]

    def slide(axis: complex, up: float = 0.0) -> list[float]:
        """Velocity of the pair's place along a direction."""
        moment = x * axis.imag - y * axis.real
        return [up * y, -up * x, moment, axis.real, axis.imag, up]

    flat = [slide(1), slide(1j)] if not direction else [turn(z, 1.0), slide(1j * direction)]
    if name in TOUCHING:
        flat = [slide(direction)]
    lifts = {
        "1v": [turn(1), turn(1j), slide(z, 1.0)],
        "3s": [slide(z, 1.0)],
        "1p": [turn(1), turn(1j), slide(z, 1.0)],
        "3pl": [turn(direction)],
        "4l": [turn(1j * direction)],
        "5t": [],
        "2c": [turn(1j * direction), slide(z, 1.0)] if direction else [turn(1), turn(1j)],
    }
    return [*flat, *lifts[name]]


# A group -------------------------------------------------------------------------------------


def _aligned(mechanism: Mechanism, group: AssurGroup, places: Sequence[PlanePose]) -> AlignedGroup:
    higher = [pair for pair in mechanism.higher if pair.by in group.links]
    replacing = {pair.by for pair in higher}
    joints = [*mechanism.revolutes, *mechanism.prismatics, *mechanism.higher]
    pairs = [_pair(mechanism, *pair) for pair in group_pairs(group) if not replacing & {*pair[1:]}]
    pairs += [_pair(mechanism, pair, *pair.links) for pair in higher]
    pairs.sort(key=lambda pair: joints.index(pair.joint))  # as the table of pairs has them
    links = tuple(link for link in group.links if link not in replacing)
    return _Search(group, links, tuple(pairs), places).run()


class _Search(Struct):
    """Search for the schemes of a group."""

    group: AssurGroup
    links: tuple[str, ...]
    pairs: tuple[MovablePair, ...]
    places: Sequence[PlanePose]
    columns: list[dict[tuple[int, str], list[list[float]]]] = field(default_factory=list)

    def run(self) -> AlignedGroup:
        self.columns = [self._columns(pose) for pose in self.places]
        every = range(len(self.pairs) + 1)
        good = self._find_true(every)
        good.sort(key=lambda one: (*_rank(one), one.classes))
        counted: tuple[AlignedScheme, ...] = ()
        if len(self.pairs) == 3:
            made = [
                AlignedScheme(one, self.need - self._rank(one))
                for one in self._schemes_by_count(every)
            ]
            counted = tuple(one for one in made if one.loose)
        return AlignedGroup(self.group, self.links, self.pairs, tuple(good[:MAX_SCHEMES]), counted)

    @property
    def need(self) -> int:
        """Number of freedoms out of the plane that the contours need."""
        return 3 * (len(self.pairs) - len(self.links))

    @property
    def touching(self) -> set[int]:
        """Numbers of the higher pairs: each has two freedoms as it is, and a third in a point."""
        return {i for i, pair in enumerate(self.pairs) if isinstance(pair.joint, HigherPair)}

    def _find_true(self, every: Sequence[int]) -> list[AlignedScheme]:
        """Return the correct schemes, those with fewest changes first, until there are enough."""
        good: list[AlignedScheme] = []
        tried = 0
        for changes in every:
            if len(good) >= MAX_SCHEMES:
                break
            for classes in self._schemes_by_count((changes,)):
                tried += 1
                if tried > TRIED:
                    break
                if self._measure(self.generic, classes) >= REGULAR:
                    good.append(AlignedScheme(classes, steady=self._steady(classes)))
        # A scheme that jams in the requested position is left out if there is another.
        first = [one for one in good if self._measure(0, one.classes) >= REGULAR]
        return first or good or self._freer(every)

    def _freer(self, every: Sequence[int]) -> list[AlignedScheme]:
        """Return those that leave local mobilities: more changes only where that leaves fewer."""
        good: list[AlignedScheme] = []
        fewest = 1 + 2 * len(self.pairs)
        tried = islice(
            ((changes, more, classes) for changes in every for more in range(1, 1 + changes * 2)
             for classes in self._schemes_by_count((changes,), more)),
            TRIED_FREER,
        )  # fmt: skip
        for changes, more, classes in tried:
            best = (good[-1].changes, good[-1].local) if good else ()
            if more >= fewest and (changes, more) != best:
                continue
            if min(self._measure(k, classes) for k in (0, self.generic)) >= REGULAR:
                good.append(AlignedScheme(classes, steady=self._steady(classes), local=more))
                fewest = more
        return good

    def _schemes_by_count(self, changes: Sequence[int], more: int = 0) -> Iterator[tuple[str, ...]]:
        """Yield schemes of given numbers of changes that fit by count or have more freedoms."""
        touching, every = self.touching, range(len(self.pairs))
        for count in changes:
            # `twos` of the changed pairs have one freedom more, the others two.
            twos = 2 * count - self.need - more + 2 * len(touching)
            if not 0 <= twos <= count:
                continue
            for changed in combinations(every, count):
                for two in combinations(changed, twos):
                    if not touching & set(changed) <= set(two):
                        continue
                    yield tuple(
                        pair.classes[0 if i not in changed else 1 if i in two else 2]
                        for i, pair in enumerate(self.pairs)
                    )

    @property
    def generic(self) -> int:
        """Number of a pose in general position: at no round angle of the driver."""
        return min(GENERIC, len(self.places) - 1)

    def _rank(self, classes: tuple[str, ...]) -> int:
        vectors = self._vectors(self.generic, classes)
        return next(k for k in range(self.need, -1, -1) if _min_pivot(vectors, k))

    def _steady(self, classes: tuple[str, ...]) -> bool:
        """Return whether the matrix is regular over the sweep: its determinant keeps its sign."""
        every = range(len(self.places))
        if len(self._vectors(0, classes)) > self.need:  # not square: no determinant
            return all(self._measure(k, classes) >= REGULAR for k in every)
        values = [_determinant(self._vectors(k, classes)) for k in every]
        return len({0 if abs(value) < REGULAR else value > 0 for value in values}) == 1

    def _measure(self, k: int, classes: tuple[str, ...]) -> float:
        """Return the least pivot of the matrix at a pose: 0 where a constraint is redundant."""
        return _min_pivot(self._vectors(k, classes), self.need)

    def _vectors(self, k: int, classes: tuple[str, ...]) -> list[list[float]]:
        return [v for i, name in enumerate(classes) for v in self.columns[k][i, name]]

    def _columns(self, pose: PlanePose) -> dict[tuple[int, str], list[list[float]]]:
        """Return the freedoms of every class of every pair, each about all contours."""
        lines = [pose.line(pair.joint) for pair in self.pairs]
        middle = sum(at for at, _ in lines) / len(lines)
        size = max(abs(at - middle) for at, _ in lines) or 1.0
        signs = self._contours()
        found = {}
        for i, (pair, (at, along)) in enumerate(zip(self.pairs, lines, strict=True)):
            for name in pair.classes:
                freedoms = _freedoms(name, (at - middle) / size, along)
                found[i, name] = [
                    [sign * value for sign in signs[i] for value in freedom] for freedom in freedoms
                ]
        return found

    def _contours(self) -> list[list[int]]:
        """Return for every pair its sense in every independent contour, 0 where it is in none."""
        own = set(self.links)
        ends = [tuple(x if x in own else FRAME for x in pair.links) for pair in self.pairs]
        above: dict[str, tuple[str, int, int]] = {}  # parent, pair, sense
        reached, closing = {FRAME}, []
        rest = list(range(len(ends)))
        while rest:
            i = next(i for i in rest if reached & set(ends[i]))
            rest.remove(i)
            a, b = ends[i]
            if a in reached and b in reached:
                closing.append(i)
                continue
            parent, child, sense = (a, b, 1) if a in reached else (b, a, -1)
            above[child] = (parent, i, sense)
            reached.add(child)
        signs = [[0] * len(closing) for _ in ends]
        for k, i in enumerate(closing):
            signs[i][k] = 1
            for link, way in zip(ends[i], (1, -1), strict=True):
                while link != FRAME:
                    link, pair, sense = above[link]
                    signs[pair][k] += way * sense
        return signs


def _freedoms(name: str, at: complex, direction: complex) -> list[Column]:
    """Return the freedoms out of the plane of a pair: turns about x and y, slide along z."""
    x, y = at.real, at.imag
    slide: Column = (0.0, 0.0, 1.0)

    def turn(axis: complex) -> Column:
        """About a line through the pair's place: what it lifts at the origin is its moment."""
        return axis.real, axis.imag, x * axis.imag - y * axis.real

    match name:
        case "3s":
            return [turn(1), turn(1j)]
        case "4l":
            return [slide, turn(direction)]
        case "5t":
            return [slide, turn(1), turn(1j)]
        case "3pl":
            return [slide, turn(1j * direction)]
        case "2c":
            return [turn(direction)] if direction else [slide]
    return []


def _min_pivot(vectors: Sequence[Sequence[float]], need: int) -> float:
    """Return the least of ``need`` pivots of the vectors by elimination, the largest ones taken."""
    rows, least = [list(v) for v in vectors], 1.0
    for _ in range(need):
        best = max(((abs(v), i, k) for i, row in enumerate(rows) for k, v in enumerate(row)),
                   default=(0.0, 0, 0))  # fmt: skip
        if best[0] < REGULAR:
            return 0.0
        least = min(least, best[0])
        head, k = rows.pop(best[1]), best[2]
        rows = [[a - row[k] / head[k] * b for a, b in zip(row, head, strict=True)] for row in rows]
    return least


def _determinant(vectors: Sequence[Sequence[float]]) -> float:
    rows, value = [list(v) for v in vectors], 1.0
    for k in range(len(rows)):
        best = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        if abs(rows[best][k]) < 1e-14:
            return 0.0
        if best != k:
            rows[k], rows[best] = rows[best], rows[k]
            value = -value
        head = rows[k]
        value *= head[k]
        for i in range(k + 1, len(rows)):
            share = rows[i][k] / head[k]
            rows[i] = [a - share * b for a, b in zip(rows[i], head, strict=True)]
    return value
