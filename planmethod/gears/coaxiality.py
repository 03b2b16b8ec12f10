"""Loops of coaxial axes, and the teeth derived from them (условие соосности)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction

from planmethod.errors import PlanMethodError
from planmethod.gears.axes import is_shifted
from planmethod.gears.derivation import DerivationLine
from planmethod.gears.model import PARALLEL, Mesh, MeshKind
from planmethod.gears.motion import TrainMotion
from planmethod.note.formula import Rich, fraction
from planmethod.note.numbers import MINUS
from planmethod.note.wording import Language, MessageTable

Terms = tuple[tuple[int, str], ...]
"""A height as a sum of sizes: signs (or counts with signs) and labels."""


def coaxial_paths(motion: TrainMotion) -> Iterator[tuple[str, Fraction, tuple[Terms, Terms]]]:
    """Yield each mesh that returns to an axis already reached: the axis, its height, both paths.

    The sums of sizes along both paths are the same.
    """
    train, axes = motion.train, motion.axes
    left = [
        mesh
        for mesh in train.meshes
        if mesh.kind in PARALLEL and all(body in axes.heights for body in train.ends(mesh))
    ]
    reached: dict[str, Terms] = {}
    while left:
        start = axes.axis_of[train.ends(left[0])[0]]
        main = next((axes.axis_of[b] for b in axes.heights if not axes.heights[b]), start)
        reached.setdefault(start if main in reached else main, ())
        while True:
            mesh = next(
                (m for m in left if any(_axis(motion, m, i) in reached for i in (0, 1))), None
            )
            if mesh is None:
                break
            left.remove(mesh)
            far = 1 if _axis(motion, mesh, 0) in reached else 0
            if _axis(motion, mesh, far) in reached and reached[_axis(motion, mesh, far)] == ():
                far = 1 - far
            name, before = _axis(motion, mesh, far), reached[_axis(motion, mesh, 1 - far)]
            terms = (*before, *_step(motion, mesh, far))
            if name not in reached:
                reached[name] = terms
                continue
            yield name, axes.heights[train.ends(mesh)[far]], (reached[name], terms)


def _axis(motion: TrainMotion, mesh: Mesh, end: int) -> str:
    return motion.axes.axis_of[motion.train.ends(mesh)[end]]


def _step(motion: TrainMotion, mesh: Mesh, end: int) -> Terms:
    """Return the height of the far axis of a mesh above the near one."""
    ends, heights = motion.train.ends(mesh), motion.axes.heights
    side = 1 if heights[ends[end]] > heights[ends[1 - end]] else -1
    one, other = mesh.first, mesh.second
    if mesh.kind is MeshKind.EXTERNAL:
        return ((side, one), (side, other)) if end else ((side, other), (side, one))
    sizes = motion.axes.sizes
    ring, small = (one, other) if sizes[one] > sizes[other] else (other, one)
    return (side, ring), (-side, small)


def derived_teeth(
    motion: TrainMotion, language: Language, *, in_short: bool = False
) -> Iterator[DerivationLine]:
    """Yield how coaxiality gives the unknown sizes, each as soon as it follows.

    ``in_short`` leaves out the equations between the radii and the result, as a sheet does.

    Loops of axes are equations of radii. One with a single unknown size gives it; where each has
    several, the rest follow from all of them together.

    Raises
    ------
    PlanMethodError
        The sizes do not satisfy an equation: an internal error.
    """
    left, known = list(motion.train.unknown), _Teeth(motion, language)
    equations = [_net(one, other) for _, _, (one, other) in coaxial_paths(motion)]
    equations = [terms for terms in equations if any(label in left for _, label in terms)]
    is_first = True
    while left and equations:
        counts = [sum(label in left for _, label in terms) for terms in equations]
        if 1 not in counts:
            for terms in equations:
                yield known.of_radii(terms)
            values = ", ".join(known.value(label) for label in left)
            yield DerivationLine(known.texts.together.format(values=values), False)
            return
        terms = equations.pop(counts.index(1))
        (label,) = (label for _, label in terms if label in left)
        left.remove(label)
        yield from known.lines(terms, label, is_first=is_first, in_short=in_short)
        equations = [t for t in equations if any(label in left for _, label in t)]
        is_first = False


def _net(first: Terms, second: Terms) -> Terms:
    """Return the terms of one path less those of the other; the first is positive."""
    found: dict[str, int] = {}
    for way, terms in ((1, first), (-1, second)):
        for sign, label in terms:
            found[label] = found.get(label, 0) + way * sign
    kept = tuple((count, label) for label, count in found.items() if count)
    turn = 1 if kept and kept[0][0] > 0 else -1
    return tuple((turn * count, label) for count, label in kept)


class _Teeth:
    """Words on one equation after another."""

    def __init__(self, motion: TrainMotion, language: Language) -> None:
        self.motion, self.train, self.language = motion, motion.train, language
        self.texts: MessageTable = language.gears["derived"]["coaxiality"]
        self.radius = "r" if is_shifted(self.train) or not self.train.toothed else "r_w"

    def lines(
        self, terms: Terms, unknown: str, *, is_first: bool, in_short: bool
    ) -> Iterator[DerivationLine]:
        """Yield an equation, what cancels in it, and the unknown size."""
        self._check(terms)
        modules = {self.train.module_of(label) for _, label in terms}
        per = {x: self._module(x) for _, x in terms} if len(modules) > 1 else {}
        radii, solved = self.of_radii(terms), self._solved(terms, unknown, per)
        if per:
            text = self._sides(terms, lambda label: f"m_{{{label}}}·z_{{{label}}}")
            yield from (radii, DerivationLine(self.texts.modules.format(formula=text), False))
        elif in_short and not (is_first and self.train.toothed):
            yield DerivationLine(f"{radii.text};  {solved.text}", False)
            return
        elif not self.train.toothed:
            yield radii
        else:
            *lines, last = self._cancelled(terms, modules.pop(), is_first, in_short)
            yield from (radii, *lines)
            if in_short:
                yield DerivationLine(f"{last.text};  {solved.text}", False)
                return
            yield last
        yield solved

    def _cancelled(
        self, terms: Terms, module: Fraction | None, is_first: bool, in_short: bool
    ) -> Iterator[DerivationLine]:
        """Yield an equation in teeth, at first with the module that cancels."""
        text = self._sides(terms, lambda label: f"z_{{{label}}}")
        if not is_first:
            yield DerivationLine(text)
            return
        if not in_short:
            yield DerivationLine(self._sides(terms, lambda x: fraction(f"m·z_{{{x}}}", "2")))
        form = "one_module" if module is None else "given_module"
        mm = "" if module is None else self.language.notation.as_input(float(module * 1000))
        yield DerivationLine(str(self.texts[form]).format(m=mm, formula=text), False)

    def of_radii(self, terms: Terms) -> DerivationLine:
        """Return the equation in radii, with the wheels that it makes coaxial."""
        r = "r_{{{}}}" if self.radius == "r" else "r_{{w{}}}"
        formula = self._sides(terms, r.format)
        labels = ", ".join(self._coaxial(terms))
        return DerivationLine(self.texts.condition.format(labels=labels, formula=formula), False)

    def value(self, label: str) -> Rich:
        """Return an unknown size with its value."""
        return f"{self._letter(label)} = {self._size(label)}{self._unit()}"

    def _coaxial(self, terms: Terms) -> list[str]:
        """Return the wheels of several bodies on one axis; rather those of the main axis."""
        axes, body_of = self.motion.axes, self.train.body_of
        groups: dict[str, list[str]] = {}
        for _, label in terms:
            groups.setdefault(axes.axis_of[body_of[label]], []).append(label)

        def rank(group: Sequence[str]) -> tuple[bool, bool, int]:
            bodies = {body_of[label] for label in group}
            return len(bodies) > 1, not axes.heights[body_of[group[0]]], len(group)

        return max(groups.values(), key=rank)

    def _solved(self, terms: Terms, unknown: str, per: dict[str, Rich]) -> DerivationLine:
        """Return the unknown size in letters, in numbers, and its value."""
        (own,) = (count for count, label in terms if label == unknown)
        rest = [(-count if own > 0 else count, x) for count, x in terms if x != unknown]
        rest.sort(key=lambda term: term[0] < 0)
        sides = []
        for of, modules in (
            (self._letter, {label: f"m_{{{label}}}" for label in per}),
            (self._size, per),
        ):
            texts = {x: f"{modules[x]}·{of(x)}" if modules else of(x) for _, x in rest}
            above = _joined(rest, texts.__getitem__)
            count = str(abs(own)) if abs(own) > 1 else ""
            below = "·".join(filter(None, (count, modules.get(unknown, ""))))
            sides.append(fraction(above, below) if below else above)
        return DerivationLine(" = ".join([self._letter(unknown), *sides, self._size(unknown)])
                              + self._unit())  # fmt: skip

    def _sides(self, terms: Terms, of: Callable[[str], Rich]) -> Rich:
        plus = [(count, label) for count, label in terms if count > 0]
        minus = [(-count, label) for count, label in terms if count < 0]
        return f"{_joined(plus, of)} = {_joined(minus, of)}"

    def _letter(self, label: str) -> Rich:
        return f"{'z' if self.train.toothed else 'r'}_{{{label}}}"

    def _size(self, label: str) -> Rich:
        per = Fraction(1) if self.train.toothed else self.train.per_m
        return self.language.notation.as_input(float(self.motion.axes.sizes[label] * per))

    def _unit(self) -> str:
        return (
            "" if self.train.toothed else f" {self.language.gears['units'][self.train.length_unit]}"
        )

    def _module(self, label: str) -> Rich:
        module = self.train.module_of(label) or self.train.module or Fraction(0)
        return self.language.notation.as_input(float(module * 1000))

    def _check(self, terms: Terms) -> None:
        if sum(count * self.motion.axes.radii[label] for count, label in terms):
            raise PlanMethodError(
                "the sizes do not satisfy the coaxiality of {}; please report the problem file",
                ", ".join(label for _, label in terms),
            )


def _joined(terms: Iterable[tuple[int, str]], of: Callable[[str], Rich]) -> Rich:
    """Return a sum of sizes with their counts: ``z_3 + 2·z_4``."""
    parts = (
        f"{MINUS if count < 0 else '+'} {f'{abs(count)}·' if abs(count) > 1 else ''}{of(label)}"
        for count, label in terms
    )
    return " ".join(parts).removeprefix("+ ")
