"""The page that plays a construction: one HTML file without a server, a network or a library."""

# no messages: HTML

from __future__ import annotations

from cmath import rect
from collections.abc import Iterator
from html import escape
from importlib.resources import files
from itertools import groupby
from math import radians
from typing import Any

from planmethod.note.document import Term, plain_text
from planmethod.note.wording import Language
from planmethod.note.writers.html import markup
from planmethod.problem.records import KindProblem
from planmethod.render.backends.canvas import Options
from planmethod.render.backends.svg import SvgCanvas
from planmethod.render.ink.drawing import Drawing
from planmethod.render.ink.pens import PenSet
from planmethod.render.ink.typeset import vector_markup
from planmethod.render.live.document import html_document, joined, speed_choice
from planmethod.render.play.frames import cleared, is_under
from planmethod.render.play.playback import (
    ArcMark,
    Board,
    Dot,
    Mark,
    Playback,
    PlayedEquation,
    Role,
    Segment,
)

SCRIPT = ("playback", "player")
"""Modules of the page's script, each after those that it imports."""

FOLDER = "planmethod.render.play"

PAGES = (1, 2, 4, 6)
"""Frames on a printed page; the usual number is the third."""


def play_page(problem: KindProblem, playback: Playback, language: Language) -> str:
    """Return the page that plays a construction, an HTML document.

    Parameters
    ----------
    problem : KindProblem
        For the title and the source.
    playback : Playback
    language : Language
        Of the page's own texts.
    """
    return _Page(problem, playback, language).html()


class _Page:
    def __init__(self, problem: KindProblem, playback: Playback, language: Language) -> None:
        self.problem, self.playback, self.language = problem, playback, language
        self.texts = language.play
        self.canvas = SvgCanvas(Options())
        self.canvas.open(Drawing(0.0, 0.0, pens=PenSet(is_coloured=False)))

    def html(self) -> str:
        """Return the document."""
        body = "\n".join(
            (
                f'<div id="stage">{self._bar()}<div id="scene-row">'
                f'<div id="boards">{"".join(map(self._board, self.playback.boards))}</div>'
                f'<aside id="words">{self._words()}</aside></div></div>',
                f'<section><p class="keys">{escape(self.texts["key_help"])}</p></section>',
                f'<div id="frames" data-pages="{PAGES[2]}"></div>',
                *self._sentences(),
            )
        )
        return html_document(
            self.problem,
            lang=self.language.lang,
            body=body,
            credit=self.texts.made,
            letters=self.canvas.letters(),
            scene=self._scene(),
            script=joined(*SCRIPT, package=FOLDER),
            style=files(FOLDER).joinpath("play.css").read_text("utf-8"),
        )

    def _bar(self) -> str:
        texts, last = self.texts, len(list(self.playback.steps())) - 1

        def button(name: str, sign: str, text: str) -> str:
            said, pressed = escape(text), ' aria-pressed="false"' if name == "play" else ""
            return f'<button id="{name}" aria-label="{said}"{pressed}>{sign}</button>'

        sections = "".join(
            f'<option value="{number}">{escape(plain_text(section.title))}</option>'
            for number, section in enumerate(self.playback.sections)
        )
        pages = "".join(
            f'<option value="{n}"{" selected" if n == PAGES[2] else ""}>{n}</option>' for n in PAGES
        )
        return (
            f'<div id="bar"><section>{button("begin", "|◀", texts.begin)}'
            f"{button('back', '←', texts.back)}"
            f"{button('play', '▶', texts.play)}"
            f"{button('on', '→', texts.on)}{button('end', '▶|', texts.end)}"
            f'<span id="count"></span><input id="place" type="range" min="0" max="{last}" '
            f'value="0" aria-label="{escape(texts.place)}">{speed_choice(texts.speed)}'
            f'<select id="section" aria-label="{escape(texts.section)}">{sections}</select>'
            f'<label><input id="ask" type="checkbox"> {escape(texts.question)}</label>'
            f'<button id="full">{escape(texts.full)}</button>'
            f'<button id="print">{escape(texts["print"])}</button>'
            f'<label>{escape(texts["pages"])} <select id="pages">{pages}</select></label>'
            "</section></div>"
        )

    # Boards ----------------------------------------------------------------------------------

    def _board(self, board: Board) -> str:
        left, low, right, high = board.box
        box = f"{left:.3f} {-high:.3f} {right - left:.3f} {high - low:.3f}"
        title = f"{markup(board.title)} <span>{markup(board.scale)}</span>"
        kind = ' class="finished"' if board.items else ""
        return (
            f'<figure data-board="{escape(board.id)}"><figcaption>{title}</figcaption>'
            f'<svg viewBox="{box}" role="img" aria-label="{escape(plain_text(board.title))}"{kind}>'
            f"{self._strokes(board, 'marks')}{self._strokes(board, 'under')}"
            f"{''.join(self._finished(board))}"
            f"{''.join(self._strokes(board, kind) for kind in OVER)}</svg></figure>"
        )

    def _finished(self, board: Board) -> Iterator[str]:
        """Yield the finished drawing, items in a row that appear with one step together."""
        pairs = list(zip(board.appears, board.items, strict=True))
        for step in sorted({*board.appears}):
            under = self.canvas.parts(cleared(item for at, item in pairs if at == step))
            if under:
                yield f'<g data-step="{step}">{under}</g>'
        for step, run in groupby(pairs, key=lambda pair: pair[0]):
            drawn = self.canvas.parts([item for _, item in run])
            yield f'<g data-step="{step}">{drawn}</g>'

    def _strokes(self, board: Board, kind: str) -> str:
        """Return the strokes of each step of a kind: under the finished drawing, or over it."""
        found = ""
        for number, (_, step) in enumerate(self.playback.steps()):
            own = [path(one) for one in step.marks if one.board == board.id and of_kind(one, kind)]
            if own:
                name = "fresh" if kind == "under" else kind
                found += f'<g class="{name}" data-step="{number}">{"".join(own)}</g>'
        return found

    # Words -----------------------------------------------------------------------------------

    def _words(self) -> str:
        parts = []
        for number, section in enumerate(self.playback.sections):
            rows = "".join(map(self._equation, section.equations))
            if rows:
                head = f"<h3>{escape(self.texts.equations)}</h3>"
                rows = f'{head}{rows}<p class="hint">{escape(self.texts.legend)}</p>'
            title = f"<h2>{markup(section.title)}</h2>"
            parts.append(f'<div data-section="{number}" hidden>{title}{rows}</div>')
        return "".join(parts) + '<div id="said" aria-live="polite"></div>'

    def _equation(self, one: PlayedEquation) -> str:
        def side(terms: tuple[Term, ...], drawn: tuple[int, ...]) -> str:
            return " + ".join(
                f'<span class="term" data-drawn="{step}">'
                f'<span class="u{term.underlines}">{markup(vector_markup(term.symbol))}</span>'
                f"<small>{markup(term.direction)}</small></span>"
                for term, step in zip(terms, drawn, strict=True)
            )

        cut = len(one.equation.left)
        left, right = side(one.equation.left, one.drawn[:cut]), "0"
        if one.equation.right:
            right = side(one.equation.right, one.drawn[cut:])
        number = f" ({markup(one.equation.number)})" if one.equation.number else ""
        return f'<p class="equation">{left} = {right}{number}</p>'

    def _sentences(self) -> Iterator[str]:
        for number, (_, step) in enumerate(self.playback.steps()):
            lines = "".join(f"<p>{markup(line, built=True)}</p>" for line in step.lines)
            yield f'<template id="said-{number}">{lines}</template>'

    # Data ------------------------------------------------------------------------------------

    def _scene(self) -> dict[str, Any]:
        texts, steps = self.texts, list[dict[str, Any]]()
        drawn = {step for board in self.playback.boards for step in board.appears}
        for number, section in enumerate(self.playback.sections):
            for step in section.steps:
                has_strokes = any(mark.role is not Role.AID for mark in step.marks)
                steps.append(
                    {
                        "section": number,
                        "board": section.board,
                        "source": section.source,
                        "strokes": has_strokes or len(steps) in drawn,
                        "words": sum(len(plain_text(line).split()) for line in step.lines),
                    }
                )
        return {
            "steps": steps,
            "words": {"ask": texts.ask, "play": texts.play, "pause": texts.pause},
        }


OVER = ("fresh", "aids", "dots")
"""Kinds of strokes over the finished drawing: those of the step itself, aids, points.

Its lines of the construction are ``under`` it, as those of the steps before, ``marks``.
"""


def of_kind(mark: Mark, kind: str) -> bool:
    """Return whether a stroke is drawn with those of a kind."""
    if isinstance(mark, Dot):
        return kind == "dots"
    if mark.role is Role.AID or kind == "aids":
        return mark.role is Role.AID and kind == "aids"
    return kind == "marks" or ((kind == "under") == is_under(mark) and kind != "dots")


def path(mark: Mark) -> str:
    """Return a stroke as an SVG element, y down; ``pathLength`` is 1 for its animation."""
    match mark:
        case Segment(start=(x, y), end=(u, v)):
            return f'<path pathLength="1" d="M{x:.3f} {-y:.3f}L{u:.3f} {-v:.3f}"/>'
        case ArcMark(centre=(x, y), radius=radius, start=start, end=end):
            one, two = (complex(x, y) + rect(radius, radians(turn)) for turn in (start, end))
            large = int(end - start > 180.0)
            return (
                f'<path pathLength="1" d="M{one.real:.3f} {-one.imag:.3f}'
                f'A{radius:.3f} {radius:.3f} 0 {large} 0 {two.real:.3f} {-two.imag:.3f}"/>'
            )
        case Dot(at=(x, y)):
            return f'<circle cx="{x:.3f}" cy="{-y:.3f}" r=".7"/>'
