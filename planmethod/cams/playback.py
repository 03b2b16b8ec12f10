"""The construction of a cam as it is played: the diagrams, the region of the axis, the profile."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import degrees

import numpy as np

from planmethod.cams.construction import CamConstruction, CamReadings, construct
from planmethod.cams.design import design_of
from planmethod.cams.model import CamProblem
from planmethod.cams.results import CamNarrator, inverted_sentence, region_nodes
from planmethod.cams.sheet import inscribe_scales, sheet_scales
from planmethod.construct.drafting import Profile
from planmethod.construct.steps import AtAngle, LineName, Name, PointName, Step
from planmethod.note.document import Step as ToldStep
from planmethod.note.formula import Rich
from planmethod.note.wording import Language
from planmethod.render.ink.drawing import Item, Pen, Stroke
from planmethod.render.play.playback import (
    Board,
    Playback,
    PlayedSection,
    PlayedStep,
    Role,
    Segment,
    xy,
)
from planmethod.render.play.strokes import Strokes, grouped, lettered_points

DIAGRAMS, REGION, PROFILE = "diagrams", "region", "profile"
"""Boards, in the order of the program."""

SMALL = 3.5
"""Height of letters, mm."""

STROKE_BY_STROKE = 2
"""Divisions of the diagrams that are played stroke by stroke; each later one is a step."""

CURVE_POINTS = 33
"""Points of a smooth part of a given curve."""


def playback(problem: CamProblem, language: Language, profile: Profile) -> Playback:
    """Return the construction of a cam as it is played: the profile division by division.

    Raises
    ------
    ProblemError
        No cam satisfies the requirements.
    LayoutError
        The sheet cannot be drawn.
    """
    built = construct(design_of(problem), sheet_scales(problem))
    return _Player(problem, built, language, profile).playback()


class _CamStrokes(Strokes):
    """Strokes of a cam: those of a clockwise one are mirrored, but not its diagrams."""

    mirrored = False

    def point(self, name: PointName) -> complex:
        """Return the place of a point as it is drawn, mm."""
        return self._drawn(super().point(name), name)

    def line(self, name: LineName) -> tuple[complex, complex]:
        """Return a place and the direction of a line as it is drawn."""
        at, along = super().line(name)
        return self._drawn(at, name), self._drawn(along, name)

    def _drawn(self, place: complex, name: Name) -> complex:
        if not self.mirrored or self.board(self.step[name]) == DIAGRAMS:
            return place
        return -place.conjugate()


class _Player:
    def __init__(
        self, problem: CamProblem, built: CamConstruction, language: Language, profile: Profile
    ) -> None:
        self.problem, self.built, self.language = problem, built, language
        self.drawn = CamReadings(built, language, profile)
        program = built.program.steps
        outs = [step.out for step in program]
        last = outs.index(PointName("O"))
        middle = outs.index(PointName("B")) if "B" in outs else last
        self.parts = {
            DIAGRAMS: program[:middle],
            REGION: program[middle:last],
            PROFILE: program[last:],
        }
        where = {step.out: board for board, part in self.parts.items() for step in part}
        self.strokes = _CamStrokes(
            program, built.exact.value, lambda step: where.get(step.out, DIAGRAMS),
            dots=self._is_visible,
        )  # fmt: skip
        self.strokes.mirrored = problem.mirror < 0
        self.when: dict[Name, int] = {}

    @staticmethod
    def _is_visible(name: PointName) -> bool:
        """Return whether a point is named: divisions of the axis of angles are not."""
        return not name.startswith("x ") and not name.endswith("axis")

    def playback(self) -> Playback:
        """Return all of it."""
        chapters = self.language.cam["chapters"]
        sections = [PlayedSection(chapters["diagrams"], DIAGRAMS, tuple(self._diagrams()))]
        if self.built.results and self.parts[REGION]:
            sections.append(
                PlayedSection(chapters["region"], REGION, tuple(self._region()), source=DIAGRAMS)
            )
        steps_of_profile = tuple(self._profile())
        sections.append(
            PlayedSection(chapters["profile"], PROFILE, steps_of_profile, source=DIAGRAMS)
        )
        count = 0
        for section in sections:
            for step in section.steps:
                self.when |= dict.fromkeys(map(PointName, step.names), count)
                count += 1
        boards = [self._board(section) for section in sections]
        return Playback.of(self.problem.title or self.problem.name, boards, sections)

    # Steps -----------------------------------------------------------------------------------

    def _diagrams(self) -> Iterator[PlayedStep]:
        """Yield the poles, and the steps of each part of the diagrams."""
        texts, notation, scales = self.language.cam, self.language.notation, self.built.scales
        narrator = CamNarrator(self.built, self.drawn, self.language)
        lengths = {
            "pole_a": notation.short(scales.pole_a, 4),
            "pole_v": notation.short(scales.pole_v, 4),
        }
        program = list(self.parts[DIAGRAMS])
        begun = [step.out for step in program].index(PointName("π_v")) + 1
        yield self.strokes.played((texts.poles.format(**lengths),), program[:begun])
        told = grouped((step, narrator.narrate(step)) for step in program[begun:])
        division, lines, drawn = 0, list[Rich](), list[Step]()
        for more, own in told:
            number = next((int(s.out[3:-1]) for s in own if s.out.startswith("m_{")), division)
            if drawn and (number != division or number <= STROKE_BY_STROKE):
                yield self._division(lines, drawn, division)
                lines, drawn = [], []
            division, lines, drawn = number, [*lines, *more], [*drawn, *own]
        if drawn:
            yield self._division(lines, drawn, division)

    def _division(self, lines: Sequence[Rich], drawn: Sequence[Step], number: int) -> PlayedStep:
        """Return a step of the diagrams with the mean ordinate that it integrates."""
        step = self.strokes.played(lines, drawn)
        mean = PointName(f"m_{{{number}}}")
        if mean not in step.names:
            return step
        nodes = {node.number: node.phi for node in self.built.nodes}
        height = 1j * self.strokes.point(mean).imag
        start, end = (self._abscissa(nodes[k]) + height for k in (number - 1, number))
        side = Segment(xy(start), xy(end), Role.CONSTRUCTION, DIAGRAMS)
        return PlayedStep(step.lines, step.names, (*step.marks, side))

    def _abscissa(self, phi: float) -> float:
        """Return where an angle is on the axis of the diagrams, mm."""
        return degrees(phi) / self.built.scales.degree

    def _given_curve(self) -> Iterator[Item]:
        """Yield the given diagram of a_q, a curve for each smooth part."""
        problem, per_mm = self.problem, self.built.scales.a
        last = self.built.nodes[-1].phi
        for part in problem.stretches:
            if part.start >= last:
                continue
            angles = np.linspace(part.start, part.end, CURVE_POINTS)
            heights = problem.on(part, angles)[2] / per_mm
            places = [
                complex(self._abscissa(phi), y) for phi, y in zip(angles, heights, strict=True)
            ]
            yield Stroke(tuple(places), Pen.RESULTANT, smooth=True)

    def _region(self) -> Iterator[PlayedStep]:
        """Yield the sentences on the region: the curve with the first, the rest with the last."""
        nodes = region_nodes(self.built, self.drawn, self.language)
        told = [node.lines for node in nodes if isinstance(node, ToldStep)]
        steps = list(self.parts[REGION])
        ends = [k for k, step in enumerate(steps) if step.out.startswith("D_")]
        cut = ends[-1] + 1 if ends else len(steps)
        yield self.strokes.played(told[0], steps[:cut])
        rest = steps[cut:]
        for lines in told[1:-1]:
            ends = [k for k, step in enumerate(rest) if isinstance(step, AtAngle)]
            end = ends[0] + 1 if ends else 0
            made, rest = rest[:end], rest[end:]
            yield self.strokes.played(lines, made)
        if len(told) > 1:
            yield self.strokes.played(told[-1], rest)

    def _profile(self) -> Iterator[PlayedStep]:
        """Yield a point of the profile for each division, and the side to the last one."""
        steps, before = list(self.parts[PROFILE]), None
        for node in self.built.nodes:
            number = f"R_{{{node.number}}}"
            end = next(k for k, step in enumerate(steps) if step.out == number) + 1
            made, steps = self._with_roller(steps, end, node.number)
            text = inverted_sentence(self.built, self.drawn, node, self.language)
            step = self.strokes.played((text,), made)
            here = self.strokes.point(PointName(f"B_{{{node.number}}}"))
            if before is not None and abs(here - before) > 1e-6:
                side = Segment(xy(before), xy(here), Role.RESULT, PROFILE)
                step = PlayedStep(step.lines, step.names, (*step.marks, side))
            before = here
            yield step

    @staticmethod
    def _with_roller(steps: list[Step], end: int, number: int) -> tuple[list[Step], list[Step]]:
        """Return the steps of a division, the touch of its roller among them, and the rest."""
        touch = f"A_{{{number}}}"
        for k in range(end, min(end + 3, len(steps))):
            if steps[k].out == touch:
                end = k + 1
        return steps[:end], steps[end:]

    # Letters ---------------------------------------------------------------------------------

    def _board(self, section: PlayedSection) -> Board:
        of = "sva" if section.board == DIAGRAMS else (section.board,)
        scale = inscribe_scales(self.built.scales, of, self.language)
        letters = dict(self._letters(section.board))
        items, appears = lettered_points(self.strokes, letters, self.when, SMALL)
        if section.board == DIAGRAMS:  # the integrated curve is given
            given = tuple(self._given_curve())
            items, appears = (*given, *items), (*(0 for _ in given), *appears)
        return Board(section.board, section.title, scale, items=items, appears=appears)

    def _letters(self, board: str) -> Iterator[tuple[PointName, Rich]]:
        """Yield the points of a board with letters: poles, origins, the ends of divisions."""
        starts = {DIAGRAMS: "VS", REGION: "D", PROFILE: "B"}[board]
        for step in self.parts[board]:
            name = str(step.out)
            own = name in ("O_a", "O_v", "O_s", "π_a", "π_v", "B", "O", "O_{1}", "O_{2}", "K", "E")
            division = name[:1] in starts and name[1:2] == "_" and not name.endswith(("'", "axis"))
            if name in self.strokes.step and (own or division):
                yield PointName(name), name
