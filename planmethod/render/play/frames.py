"""Frames of a played construction: a drawing after each step, with its sentence (кадры)."""

from __future__ import annotations

from collections.abc import Iterator
from math import radians
from typing import Any, assert_never

from msgspec import to_builtins

from planmethod.note.document import plain_text
from planmethod.render.backends.canvas import Options
from planmethod.render.backends.svg import SvgCanvas
from planmethod.render.ink.drawing import Arc, Disc, Drawing, Ink, Item, Pen, Stroke, shifted
from planmethod.render.layout.block import paragraph
from planmethod.render.play.playback import (
    ArcMark,
    Board,
    Dot,
    Mark,
    Playback,
    PlayedStep,
    Role,
    Segment,
)

HOT = "#c2180b"
"""Colour of the new lines of a frame."""

LEAST_WIDTH = 120.0
"""Least width of a frame, mm: its sentences are as wide."""

LETTERS, GAP = 3.5, 5.0
"""Height of the letters of sentences, and the white around them, mm."""


def frames(playback: Playback) -> Iterator[str]:
    """Yield an SVG picture after each step: what it adds in red, its sentences below."""
    boards = {board.id: board for board in playback.boards}
    steps = list(playback.steps())
    for number, (section, step) in enumerate(steps):
        board = boards[section.board]
        before = [
            item
            for _, earlier in steps[:number]
            for mark in earlier.marks
            if mark.board == board.id and mark.role is not Role.AID
            for item in drawn(mark, lasting=True)
        ]
        yield _frame(board, number, step, before)


def _frame(board: Board, number: int, step: PlayedStep, before: list[Item]) -> str:
    left, low, right, high = board.box
    width = max(right - left, LEAST_WIDTH)
    words = paragraph("\n".join(step.lines), LETTERS, width - 2 * GAP)
    below = words.height + 2 * GAP
    height = high - low + below
    origin = complex((width - (right - left)) / 2 - left, below - low)
    canvas = SvgCanvas(Options())
    canvas.open(Drawing(width, height))

    def parts(items: list[Item]) -> str:
        return canvas.parts(list(shifted(items, origin)))

    pairs = list(zip(board.appears, board.items, strict=True))
    fresh = [
        item for mark in step.marks if mark.board == board.id for item in drawn(mark, lasting=False)
    ]
    body = parts(before)
    for at, item in pairs:
        if at <= number:
            text = parts([item])
            body += text.replace("#000000", HOT) if at == number else text
    body += parts(fresh).replace("#000000", HOT)
    body += canvas.parts(words.place(complex(GAP, below - GAP)))
    return (
        '<?xml version="1.0" encoding="UTF-8"?>\n'
        '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        f'width="{width:.2f}mm" height="{height:.2f}mm" viewBox="0 0 {width:.2f} {height:.2f}">\n'
        f'<defs>{canvas.letters()}</defs><rect width="100%" height="100%" fill="#ffffff"/>'
        f"{body}</svg>\n"
    )


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
