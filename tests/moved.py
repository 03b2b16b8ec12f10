"""A problem moved as a whole on its plane: turned, mirrored, scaled, shifted.

The records are transformed, not the files. A motion takes a place ``z`` to
``factor·z + shift``, or to ``factor·conj(z) + shift`` when it mirrors.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping
from dataclasses import dataclass

from doors import (
    FRAME,
    AssemblyRelation,
    Body,
    ModelProblem as Problem,
    Rule,
    Scales,
    Slide,
)
from msgspec.structs import replace

MIRRORED = {
    AssemblyRelation.LEFT_OF: AssemblyRelation.RIGHT_OF,
    AssemblyRelation.RIGHT_OF: AssemblyRelation.LEFT_OF,
}


@dataclass(frozen=True)
class Move:
    """Similarity of the plane. ``degrees`` is the angle of ``factor``, kept exact."""

    degrees: float = 0.0
    size: float = 1.0
    mirrors: bool = False
    shift: complex = 0j

    @property
    def factor(self) -> complex:
        quadrant = {0.0: 1, 90.0: 1j, 180.0: -1, 270.0: -1j}.get(self.degrees % 360.0)
        if quadrant is not None:
            return self.size * complex(quadrant)
        return cmath.rect(self.size, math.radians(self.degrees))

    @property
    def sense(self) -> int:
        """-1 when counter-clockwise becomes clockwise."""
        return -1 if self.mirrors else 1

    def vector(self, z: complex) -> complex:
        return self.factor * (z.conjugate() if self.mirrors else z)

    def place(self, z: complex) -> complex:
        return self.vector(z) + self.shift

    def own(self, z: complex) -> complex:
        """Place in the own axes of a moving link."""
        return self.size * (z.conjugate() if self.mirrors else z)

    def angle(self, degrees: float) -> float:
        """Direction on the paper."""
        return self.sense * degrees + self.degrees

    def problem(self, problem: Problem, *, near: Mapping[str, complex] | None = None) -> Problem:
        """Return the problem moved.

        Parameters
        ----------
        near : mapping of str to complex, optional
            Places of the points in the solved problem: every rule becomes ``near`` the moved
            place. Without them the phrases stay, left and right of a line are exchanged by a
            mirror, and the motion must keep right and above.
        """
        drive = problem.drive
        positions = (
            tuple(self.angle(phi) for phi in drive.positions)
            if drive.is_crank
            else tuple(self.size * s for s in drive.positions)
        )
        linear = self.sense if drive.is_crank else self.size
        return replace(
            problem,
            bodies={link: self._body(link, body) for link, body in problem.bodies.items()},
            slides={link: self._slide(slide) for link, slide in problem.slides.items()},
            drive=replace(
                drive,
                positions=positions,
                rate=linear * drive.rate,
                acceleration=linear * drive.acceleration,
            ),
            guides={
                name: (through, self.place(base), self.angle(angle))
                for name, (through, base, angle) in problem.guides.items()
            },
            assembly=tuple(self._rule(rule, near) for rule in problem.assembly),
            scales=self._scales(problem.scales),
        )

    def _scales(self, scales: Scales) -> Scales:
        """The same drawing on the paper: the scales go with the size."""
        times = [None if mu is None else mu * self.size for mu in _mu(scales)]
        return replace(scales, mu_l=times[0], mu_v=times[1], mu_a=times[2])

    def _body(self, link: str, body: Body) -> Body:
        move = self.place if link == FRAME else self.own
        return replace(body, points={name: move(z) for name, z in body.points.items()})

    def _slide(self, slide: Slide) -> Slide:
        fixed = slide.host == FRAME
        return replace(
            slide,
            base=self.place(slide.base) if fixed else self.own(slide.base),
            angle=self.angle(slide.angle) if fixed else self.sense * slide.angle,
            offset=self.sense * self.size * slide.offset,
        )

    def _rule(self, rule: Rule, near: Mapping[str, complex] | None) -> Rule:
        if near is not None:
            return Rule(rule.point, AssemblyRelation.NEAR, (), self.place(near[rule.point]))
        if rule.relation is AssemblyRelation.NEAR:
            return replace(rule, at=self.place(rule.at))
        return replace(
            rule,
            relation=MIRRORED.get(rule.relation, rule.relation) if self.mirrors else rule.relation,
        )


def _mu(scales: Scales) -> tuple[float | None, float | None, float | None]:
    return scales.mu_l, scales.mu_v, scales.mu_a
