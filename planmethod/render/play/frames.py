"""Frames of a played construction: a drawing after each step, with its sentence (кадры)."""

# no messages: SVG

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from math import radians
from typing import Any, assert_never

from msgspec import to_builtins

from planmethod.note.document import plain_text
from planmethod.note.formula import Rich
from planmethod.render.backends.canvas import Options
from planmethod.render.backends.svg import SvgCanvas
from planmethod.render.ink.drawing import (
    HEIGHTS,
    Arc,
    Disc,
    Drawing,
    Fill,
    Ink,
    Item,
    Pen,
    Stroke,
    Text,
    shifted,
)
from planmethod.render.ink.typeset import ink_bounds
from planmethod.render.layout.block import paragraph
from planmethod.render.layout.text_blocks import EquationBlock, equation_block
from planmethod.render.play.playback import (
    ArcMark,
    Board,
    Dot,
    Mark,
    Playback,
    PlayedEquation,
    PlayedSection,
    PlayedStep,
    Role,
    Segment,
)

HOT, LATER = "#c2180b", "#9a9a9a"
"""Colours of new strokes, and of terms that are not drawn yet."""

LEAST_WIDTH = 120.0
"""Least width of a frame, mm: its sentences are as wide."""

LETTERS, SIGNS, GAP = 3.5, 55.0, 5.0
"""Least height of the letters of sentences, mm; how many go into a line; white around them, mm."""

CLEAR = 0.5
"""White around letters under which the lines of the construction stop, mm."""


def frames(playback: Playback) -> Iterator[str]:
    """Yield an SVG picture after each step: its strokes in red, its equations and sentences."""
    boards = {board.id: board for board in playback.boards}
    steps = list(playback.steps())
    for number, (section, _) in enumerate(steps):
        shown = [boards[name] for name in (section.board, section.source) if name in boards]
        yield _Frame(section, steps, number).svg(shown)


class _Frame:
    """One frame, from its heading down: boards, equations, sentences."""

    def __init__(
        self,
        section: PlayedSection,
        steps: Sequence[tuple[PlayedSection, PlayedStep]],
        number: int,
    ) -> None:
        self.section, self.steps, self.number = section, steps, number
        self.canvas = SvgCanvas(Options())
        self.body = ""

    def svg(self, boards: Sequence[Board]) -> str:
        """Return the picture with its boards side by side."""
        width = max(sum(_width(board) for board in boards) + GAP * (len(boards) + 1), LEAST_WIDTH)
        own = max(LETTERS, width / SIGNS)
        letter = next((height for height in HEIGHTS if height >= own), HEIGHTS[-1])
        room = width - 2 * GAP
        title = paragraph(self.section.title, letter, room)
        equations = [(one, equation_block(one.equation, letter, width=room))
                     for one in self.section.equations]  # fmt: skip
        words = paragraph("\n".join(self.steps[self.number][1].lines), letter, room)
        captions = [
            paragraph(_caption(board, number), letter, max(_width(board), LEAST_WIDTH / 2))
            for number, board in enumerate(boards)
        ]
        rows = [
            title.height,
            max(caption.height for caption in captions) + GAP,
            max(board.box[3] - board.box[1] for board in boards),
            *(block.height + GAP for _, block in equations),
            words.height + GAP,
        ]
        height = sum(rows) + 3 * GAP
        self.canvas.open(Drawing(width, height))
        corner = complex(GAP, height - GAP)
        self._add(title.place(corner))
        corner -= 1j * (title.height + GAP)
        place = corner
        for board, caption in zip(boards, captions, strict=True):
            self._add(caption.place(place))
            self._add_board(board, place - 1j * rows[1])
            place += _width(board) + GAP
        corner -= 1j * (rows[1] + rows[2])
        for equation, block in equations:
            corner -= 1j * GAP
            self._add_equation(equation, block, corner)
            corner -= 1j * block.height
        self._add(words.place(corner - 1j * GAP))
        return (
            '<?xml version="1.0" encoding="UTF-8"?>\n'
            '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
            f'width="{width:.2f}mm" height="{height:.2f}mm" viewBox="0 0 {width:.2f} {height:.2f}">'
            f"\n<defs>{self.canvas.letters()}</defs>"
            f'<rect width="100%" height="100%" fill="#ffffff"/>{self.body}</svg>\n'
        )

    def _add(self, items: Iterable[Item], colour: str = "") -> None:
        text = self.canvas.parts(list(items))
        self.body += text.replace("#000000", colour) if colour else text

    def _add_board(self, board: Board, corner: complex) -> None:
        """Add a board: lines of the construction, the finished drawing over them, new strokes."""
        origin = corner - complex(board.box[0], board.box[3])

        def add(items: Iterable[Item], colour: str = "") -> None:
            self._add(shifted(items, origin), colour)

        marks = [
            [mark for mark in step.marks if mark.board == board.id]
            for _, step in self.steps[: self.number + 1]
        ]
        left = [mark for step in marks[:-1] for mark in step if mark.role is not Role.AID]
        add(item for mark in left for item in drawn(mark, lasting=True))
        new = sorted(marks[-1], key=is_under, reverse=True)
        under = [item for mark in new if is_under(mark) for item in drawn(mark, lasting=False)]
        add(under, HOT)
        pairs = list(zip(board.appears, board.items, strict=True))
        there = [item for at, item in pairs if at <= self.number]
        add(cleared(there))
        for at, item in pairs:
            if at <= self.number:
                add([item], HOT if at == self.number else "")
        over = [item for mark in new if not is_under(mark) for item in drawn(mark, lasting=False)]
        add(over, HOT)

    def _add_equation(self, one: PlayedEquation, block: EquationBlock, corner: complex) -> None:
        """Add an equation: terms that are not drawn yet are grey, those of the step are red."""
        named = 0 if one.equation.right else 1  # a balance begins with its name
        for number, items in block.parts(corner):
            at = -1
            if number is not None and 0 <= number - named < len(one.drawn):
                at = one.drawn[number - named]
            self._add(items, HOT if at == self.number else LATER if at > self.number else "")


def _caption(board: Board, number: int) -> Rich:
    """Return the caption of a board: the heading of the frame names the first one."""
    return board.scale or (board.title if number else "")


def _width(board: Board) -> float:
    return board.box[2] - board.box[0]


def is_under(mark: Mark) -> bool:
    """Return whether a stroke is drawn under the finished drawing, which it leads to."""
    return isinstance(mark, Segment) and mark.role is Role.CONSTRUCTION


def cleared(items: Iterable[Item]) -> list[Item]:
    """Return the white under each inscription of a drawing: lines of the construction stop there.

    It is drawn under the whole drawing, so it covers none of its lines.
    """
    letters: dict[str, list[Item]] = {}
    for item in items:
        if isinstance(item, Text):
            letters.setdefault(item.label or f"{item.at}", []).append(item)
    found: list[Item] = []
    for group in letters.values():
        left, low, right, high = ink_bounds(group)
        low_corner, high_corner = complex(left, low), complex(right, high)
        low_corner, high_corner = low_corner - CLEAR * (1 + 1j), high_corner + CLEAR * (1 + 1j)
        corners = (
            low_corner,
            complex(high_corner.real, low_corner.imag),
            high_corner,
            complex(low_corner.real, high_corner.imag),
        )
        found.append(Fill(corners, Ink.WHITE))
    return found


def drawn(mark: Mark, *, lasting: bool) -> list[Item]:
    """Return the items of a stroke; ``lasting``: as it is left when the step is over."""
    pen = Pen.THIN if lasting or mark.role is not Role.RESULT else Pen.RESULTANT
    if mark.role is Role.AID:
        pen = Pen.HIDDEN
    match mark:
        case Segment(start=start, end=end):
            return [Stroke((complex(*start), complex(*end)), pen)]
        case ArcMark(centre=centre, radius=radius, start=start, end=end):
            return [Arc(complex(*centre), radius, radians(start), radians(end), pen)]
        case Dot(at=at):
            return [] if lasting else [Disc(complex(*at), 0.9, Ink.BLACK)]
        case _:
            assert_never(mark)


def playback_record(playback: Playback) -> dict[str, Any]:
    """Return a playback as plain data: sentences as text, strokes in mm, results.

    A step has its sentences, the names of its program steps, its strokes and its readings. An
    equation has its terms with their underlines, and the number of the step that draws each.
    """
    numbers = iter(range(len(list(playback.steps()))))

    def step_record(step: PlayedStep) -> dict[str, Any]:
        return {
            "number": next(numbers),
            "lines": [plain_text(line) for line in step.lines],
            "names": list(step.names),
            "strokes": [to_builtins(mark) for mark in step.marks],
            "measured": [
                {key: plain_text(value) if isinstance(value, str) else value
                 for key, value in to_builtins(one).items()}
                for one in step.measured
            ],
        }  # fmt: skip

    return {
        "schema": SCHEMA,
        "title": playback.title,
        "boards": [
            {"id": one.id, "title": plain_text(one.title), "scale": plain_text(one.scale),
             "box": list(one.box)}
            for one in playback.boards
        ],
        "sections": [
            {
                "title": plain_text(section.title),
                "board": section.board,
                "source": section.source,
                "equations": [
                    {
                        side: [
                            {"symbol": plain_text(term.symbol), "underlines": term.underlines,
                             "direction": plain_text(term.direction), "step": step}
                            for term, step in pairs
                        ]
                        for side, pairs in (
                            ("left", list(zip(one.equation.left, one.drawn, strict=False))),
                            ("right", list(zip(one.equation.right,
                                               one.drawn[len(one.equation.left) :], strict=True))),
                        )
                    }
                    for one in section.equations
                ],
                "steps": list(map(step_record, section.steps)),
            }
            for section in playback.sections
        ],
    }  # fmt: skip


SCHEMA = 1
"""Version of the record's shape."""
