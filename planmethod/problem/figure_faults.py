"""Faults of a drawn position and their remedies (ошибки рисунка)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.construct.steps import IntersectCircles, IntersectLineCircle, PointName
from planmethod.languages import translate
from planmethod.mechanism.model import FRAME, Mechanism
from planmethod.problem.figure import Figure, Values
from planmethod.problem.figure_checks import (
    ANGLE_TOLERANCE,
    LENGTH_TOLERANCE,
    SAME,
    Check,
    PlaceValues,
)
from planmethod.problem.figure_scene import Scene
from planmethod.problem.file_node import FileNode
from planmethod.problem.model import DrawnFact, DrawnKind, Rule
from planmethod.problem.names import format_length, format_place, listed

SUGGESTED = 8
"""Most numbers that are suggested where the figure does not determine a place."""


class FigureFaults:
    """What prevents a drawn position, noted at ``[drawn]``.

    Parameters
    ----------
    file : FileNode
        The whole problem file.
    joints : sequence of str
        Inner joints of built groups that close in two ways.
    crank : str
        Driving link.
    """

    def __init__(
        self,
        file: FileNode,
        figure: Figure,
        mechanism: Mechanism,
        *,
        joints: Sequence[str],
        crank: str,
        rules: Sequence[Rule],
    ) -> None:
        self.file, self.node, self.figure, self.scene = file, file["drawn"], figure, figure.scene
        self.mechanism, self.joints, self.crank, self.rules = mechanism, joints, crank, rules

    def note_missing(self, missing: Sequence[str]) -> None:
        """Note what the figure does not determine, and which number would."""
        names = listed(self._called(name) for name in missing)
        told = [key for key, fact in self._candidates() if self._suffices(fact)][:SUGGESTED]
        links = [link for link in self.mechanism.links if link not in self.figure.turned]
        if told:
            hint = translate("One of these would determine it: {}.", listed(told))
        elif not links:
            hint = 'Give numbers in place of one "drawn".'
        else:
            hint = translate(
                "More than one number is missing; the directions of links {} are not known.",
                listed(links),
            )
        self.node.reject("the figure does not determine {}", names, hint=hint)

    def _called(self, name: str) -> str:
        if name in self.scene.points:
            return translate("point {}", name)
        if name in self.scene.lines:
            return translate("guide {}", name)
        return translate("the position of link {}", name)

    def _candidates(self) -> Iterator[tuple[str, DrawnFact | str]]:
        """Yield numbers that the file lacks."""
        mechanism, told = self.mechanism, {fact.key for fact in self.scene.facts}
        for link in mechanism.links:
            if link not in self.figure.turned:
                yield f"phi_{link}", DrawnFact(DrawnKind.PHI, (link,), 57.3)
        pairs = [tuple(joint.links) for joint in mechanism.revolutes]
        for pair in dict.fromkeys((a, b) for links in pairs for a in links for b in links if a < b):
            fact = DrawnFact(DrawnKind.BETWEEN, pair, 57.3)
            if FRAME not in pair and fact.key not in told:
                yield fact.key, fact
        for name in self._sought_points():
            place = self.scene.points[name]
            if place[0] is None and place[1] is None:
                yield f'{name} = ["drawn", 0]', name

    def _sought_points(self) -> list[str]:
        return [name for name in self.scene.unknown if name in self.scene.points]

    def _suffices(self, fact: DrawnFact | str) -> bool:
        """Return whether one more number determines all that is sought."""
        scene, points, facts = self.scene, dict(self.scene.points), self.scene.facts
        if isinstance(fact, str):
            points[fact] = (None, 0.0)
        else:
            facts = (*facts, fact)
        more = Scene(
            scene.links, scene.slides, points, scene.lines, scene.line_of, facts, scene.travel,
            scene.unknown,
        )  # fmt: skip
        return not Figure(more).build()

    def note_impossible(self, steps: Sequence[Any], values: Values) -> None:
        """Note the first arcs or lines of the figure that do not meet."""
        unit = self.file.faults.unit
        for step in steps:
            value = values[step.out]
            if not isinstance(value, np.ndarray) or np.isfinite(value).any():
                continue
            name = str(step.out).partition("~")[0]
            facts = ""
            if isinstance(step, IntersectCircles):
                p, q = values[step.centre1], values[step.centre2]
                apart = np.abs(q - p)
                k = int(np.flatnonzero(np.isfinite(apart))[0])
                one, two = (float(values[r][k]) for r in (step.radius1, step.radius2))
                said = [format_length(x, unit, 6) for x in (one, two, float(apart[k]))]
                facts = translate(
                    "the arcs have radii {} and {}, their centres are {} apart", *said
                )
            elif isinstance(step, IntersectLineCircle):
                p, u = values[step.line]
                away = np.abs(((values[step.centre] - p) * np.conj(u)).imag) / np.abs(u)
                k = int(np.flatnonzero(np.isfinite(away))[0])
                radius = float(values[step.radius][k])
                said = [format_length(x, unit, 6) for x in (radius, float(away[k]))]
                facts = translate(
                    "the arc has the radius {}, the line is {} from its centre", *said
                )
            else:
                facts = translate("its lines are parallel")
            hint = "Check these lengths, and the angles in [drawn]."
            self.node.reject("the figure cannot be built at {}: {}", name, facts, hint=hint)
        self.node.reject("the figure cannot be built", hint="Check the angles in [drawn].")

    def note_contradiction(self, checks: Sequence[Check], built: npt.NDArray[np.bool_]) -> None:
        """Note the numbers that the nearest mirror image contradicts."""
        off = np.array(
            [np.where(check.is_consistent, 0.0, np.minimum(check.off, 1e9)) for check in checks]
        )
        total = np.where(built, (off > 0).sum(axis=0) * 1e12 + off.sum(axis=0), np.inf)
        k = int(np.argmin(total))
        unit = self.file.faults.unit
        for check in checks:
            if check.is_consistent[k]:
                continue
            said = [
                format_length(x, unit, 6) if check.unit == "m" else f"{x:.6g}°"
                for x in (check.given_value, float(check.drawn_values[k]))
            ]
            hint = translate(
                "Correct or remove one of the numbers. Angles may differ by {:g}°, lengths by "
                "{:g} %.",
                *(ANGLE_TOLERANCE, 100.0 * LENGTH_TOLERANCE),
            )
            message = "{} = {} is given, and the other data of the figure give {}"
            check.node.note(message, check.name, *said, hint=hint)
        self.node.reject_all(())

    def note_rule(self, rule: Rule, k: int, values: Values) -> None:
        """Note a rule that holds in no mirror image of the figure."""
        unit = self.file.faults.unit
        at = format_place(complex(values[PointName(rule.point)][k]), unit)
        axes = [
            f"{link}: {''.join(body.axis)}"
            for link, body in self.scene.links.items()
            if body.axis is not None and rule.point in body.axis
        ]
        hint = translate("The direction of a link is that of its first length: {}.", listed(axes))
        self.file["assembly"][rule.point].reject(
            "the figure contradicts this rule: {} is at ({}) {}", rule.point, at, translate(unit),
            hint=hint,
        )  # fmt: skip

    def note_ambiguous(
        self, images: Sequence[int], places: Mapping[int, PlaceValues], values: Values
    ) -> None:
        """Note that several mirror images fit, with rules that distinguish two of them."""
        unit = self.file.faults.unit
        told = []
        for k in images[:4]:
            parts = []
            for path, value in places[k].items():
                if isinstance(value, list):
                    shown = f"({format_place(complex(*value), unit)}) {translate(unit)}"
                else:
                    shown = f"{value:.6g}°"
                parts.append(f"{'.'.join(path[-2:] if len(path) > 2 else path[-1:])} = {shown}")
            told.append(", ".join(parts))
        rules = self._distinguishing(images[0], images[1], values)
        hint = translate("Give another angle, or a rule in [assembly].")
        if rules:
            hint = translate("Give in [assembly] {} for the first or {} for the second.", *rules)
        self.node.reject(
            "{} mirror images of the figure fit: {}", len(images), "; ".join(told), hint=hint
        )

    def _distinguishing(self, one: int, two: int, values: Values) -> tuple[str, str] | None:
        """Return two rules for a joint, of which each holds in one mirror image."""
        best: tuple[float, tuple[str, str]] | None = None
        told = {rule.point for rule in self.rules}

        def offer(p: str, sides: tuple[float, float], words: tuple[str, str], of: str) -> None:
            nonlocal best
            width = min(map(abs, sides))
            if sides[0] * sides[1] < 0 and width > SAME and (best is None or width > best[0]):
                pair = words if sides[0] > 0 else words[::-1]
                best = width, (f'{p} = "{pair[0]} {of}"', f'{p} = "{pair[1]} {of}"')

        for p, refs in self._comparable():
            if p in told:
                continue
            at = [[complex(values[PointName(q)][k]) for k in (one, two)] for q in (p, *refs)]
            ways = [[place[i] - at[0][i] for i in (0, 1)] for place in at[1:]]
            for q, (v, w) in zip(refs, ways, strict=True):
                offer(p, (-v.real, -w.real), ("right of", "left of"), q)
                offer(p, (-v.imag, -w.imag), ("above", "below"), q)
        if best is not None:
            return best[1]
        for p, refs in self._comparable():
            lines = [(q, r) for q in refs for r in refs if q != r and p not in told]
            for q, r in lines:
                sides = []
                for k in (one, two):
                    a, b, c = (complex(values[PointName(name)][k]) for name in (q, r, p))
                    sides.append(((b - a).conjugate() * (c - a)).imag / (abs(b - a) or 1.0))
                offer(p, (sides[0], sides[1]), ("left of", "right of"), q + r)
        return None if best is None else best[1]

    def _comparable(self) -> Iterator[tuple[str, list[str]]]:
        """Yield points that may have a rule, each with the points that it may be compared with."""
        placed = self.figure.placed
        crank = [p for p in self.scene.links[self.crank].points if p in placed]
        crank = [p for p in crank if p not in self.scene.points]
        early = [*(p for p in self.scene.points if p in placed), *crank]
        drawn = [*self._sought_points(), *(crank if self.crank in self.scene.unknown else ())]
        for p in self.joints:
            yield p, [q for q in early if q != p]
        for p in drawn:
            yield p, [q for q in placed if q != p]
