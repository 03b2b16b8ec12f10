"""Formulas and floating pictures on the pages of PDF (формулы в PDF)."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, TypeAlias, assert_never

from msgspec import Struct
from reportlab.pdfbase.pdfmetrics import stringWidth
from reportlab.platypus import (
    BaseDocTemplate,
    CondPageBreak,
    Flowable,
    Frame,
    KeepTogether,
    PageBreak,
    Paragraph,
)

from planmethod.note.document import Equation, Term
from planmethod.note.formula import Fraction, Index, Letters, Node, Overline, Root, parse
from planmethod.note.writers.formulas import PAIRS, Token, matching_bracket, tokens_of

ASCENT, DESCENT, AXIS = 0.68, 0.22, 0.25
"""Ascent and descent of letters, height of a fraction line, in parts of the font size."""

SMALL, RISE, DROP = 0.7, 0.42, 0.18
RULE = 0.045
"""Width of a line, in parts of the size of the font."""

Place: TypeAlias = tuple[float, float]


class Fonts(Struct, frozen=True):
    """Names of fonts that reportlab knows: upright, bold, italic (шрифты)."""

    upright: str
    bold: str
    italic: str


class Letter(Struct, frozen=True):
    """Letters of one font at a place, points (буквы)."""

    x: float
    y: float
    text: str
    font: str
    size: float


class FormulaBox(Struct, frozen=True):
    """A typeset formula, from the left end of its base line, points (набор)."""

    width: float
    ascent: float
    descent: float
    letters: tuple[Letter, ...] = ()
    lines: tuple[tuple[Place, ...], ...] = ()
    rule: float = 0.5

    def at(self, x: float, y: float) -> tuple[tuple[Letter, ...], tuple[tuple[Place, ...], ...]]:
        """Return letters and lines moved."""
        letters = (
            Letter(one.x + x, one.y + y, one.text, one.font, one.size) for one in self.letters
        )
        lines = (tuple((px + x, py + y) for px, py in line) for line in self.lines)
        return tuple(letters), tuple(lines)


def overlay(
    parts: Iterable[tuple[float, float, FormulaBox]], width: float, rule: float
) -> FormulaBox:
    """Return formulas at their places as one formula of a width."""
    letters: list[Letter] = []
    lines: list[tuple[Place, ...]] = []
    ascent = descent = 0.0
    for x, y, ink in parts:
        moved = ink.at(x, y)
        letters += moved[0]
        lines += moved[1]
        ascent, descent = max(ascent, ink.ascent + y), max(descent, ink.descent - y)
    return FormulaBox(width, ascent, descent, tuple(letters), tuple(lines), rule)


class FormulaSetter:
    """Sets formulas in letters of one size, points."""

    def __init__(self, fonts: Fonts, size: float) -> None:
        self._fonts, self._size, self._rule = fonts, size, RULE * size

    def set(self, nodes: Iterable[Node]) -> FormulaBox:
        """Return a formula."""
        return self._tokens(list(tokens_of(nodes)))

    def row(self, parts: Sequence[FormulaBox]) -> FormulaBox:
        """Return inks one after another."""
        placed, x = [], 0.0
        for part in parts:
            placed.append((x, 0.0, part))
            x += part.width
        return overlay(placed, x, self._rule)

    def text(self, text: str, font: str = "", size: float = 0.0) -> FormulaBox:
        """Return letters on the base line."""
        font, size = font or self._fonts.upright, size or self._size
        width = stringWidth(text, font, size)
        return FormulaBox(
            width, ASCENT * size, DESCENT * size, (Letter(0.0, 0.0, text, font, size),)
        )

    def _tokens(self, tokens: Sequence[Token]) -> FormulaBox:
        parts: list[FormulaBox] = []
        k = 0
        while k < len(tokens):
            token, k = tokens[k], k + 1
            if token.kind == "brackets" and (end := matching_bracket(tokens, k - 1)) is not None:
                inside = self._tokens(tokens[k:end])
                parts += [
                    self._tall(token.text, inside),
                    inside,
                    self._tall(PAIRS[token.text], inside),
                ]
                k = end + 1
            elif token.kind == "sign":
                sign = token.text.strip(" \u00a0")
                starts = k < 2 or tokens[k - 2].kind == "sign"  # as after a sign of equality
                beside = sign in "·×/" or (starts and sign in "+−-±")
                parts.append(self.text(sign if beside else f"\u00a0{sign}\u00a0"))
            elif token.node is not None:
                parts.append(self._node(token.node))
            else:
                font = self._fonts.italic if token.kind == "letters" else self._fonts.upright
                parts.append(self.text(token.text.replace("\n", " "), font))
        return self.row(parts)

    def _tall(self, bracket: str, inside: FormulaBox) -> FormulaBox:
        """Return a bracket as high as its content."""
        need = max(inside.ascent - AXIS * self._size, inside.descent + AXIS * self._size)
        share = max(1.0, need / (0.5 * self._size))
        if share < 1.25:
            return self.text(bracket)
        large = self.text(bracket, size=share * self._size)
        drop = AXIS * self._size * (1.0 - share)
        return overlay([(0.0, drop, large)], large.width, self._rule)

    def _smaller(self) -> FormulaSetter:
        return FormulaSetter(self._fonts, SMALL * self._size)

    def _node(self, node: Node) -> FormulaBox:
        match node:
            case Letters():
                return self.set([node])
            case Index(below, above):
                small = self._smaller()
                low, high = small.set(below), small.set(above)
                drop, rise = -DROP * self._size, RISE * self._size
                return overlay(
                    [(0.0, drop, low), (0.0, rise, high)], max(low.width, high.width), self._rule
                )
            case Overline(body):
                return self._barred(self.set(body))
            case Fraction(above, below):
                return self._fraction(self.set(above), self.set(below))
            case Root(body):
                return self._root(self.set(body))
            case _:
                assert_never(node)

    def _barred(self, body: FormulaBox) -> FormulaBox:
        level = body.ascent + 0.06 * self._size
        line = ((0.04 * self._size, level), (body.width, level))
        return FormulaBox(
            body.width,
            level + self._rule,
            body.descent,
            body.letters,
            (*body.lines, line),
            self._rule,
        )

    def _fraction(self, above: FormulaBox, below: FormulaBox) -> FormulaBox:
        axis, gap, pad = AXIS * self._size, 0.12 * self._size, 0.15 * self._size
        width = max(above.width, below.width) + 2 * pad
        up, down = axis + gap + above.descent, axis - gap - below.ascent
        placed = [((width - above.width) / 2, up, above), ((width - below.width) / 2, down, below)]
        whole = overlay(placed, width, self._rule)
        line = ((0.03 * self._size, axis), (width - 0.03 * self._size, axis))
        return FormulaBox(
            width, whole.ascent, whole.descent, whole.letters, (*whole.lines, line), self._rule
        )

    def _root(self, body: FormulaBox) -> FormulaBox:
        size, top = self._size, body.ascent + 0.1 * self._size
        lead = 0.55 * size
        whole = overlay([(lead, 0.0, body)], lead + body.width + 0.08 * size, self._rule)
        sign = (
            (0.05 * size, 0.22 * size),
            (0.15 * size, 0.28 * size),
            (0.32 * size, -body.descent),
            (0.5 * size, top),
            (whole.width, top),
        )
        return FormulaBox(
            whole.width,
            top + self._rule,
            whole.descent,
            whole.letters,
            (*whole.lines, sign),
            self._rule,
        )

    # Vector equations -----------------------------------------------------------------------------

    def equations(self, equations: Sequence[Equation]) -> FormulaBox:
        """Return vector equations, several as a system behind a brace."""
        rows = [self._equation(one) for one in equations]
        if len(rows) == 1:
            return self.row(rows[0])
        lead = max(row[0].width for row in rows)
        inks = [self.row(row) for row in rows]
        gap, y, placed = 0.35 * self._size, 0.0, list[tuple[float, float, FormulaBox]]()
        brace = 0.8 * self._size
        for row, ink in zip(rows, inks, strict=True):
            y -= ink.ascent
            placed.append((brace + lead - row[0].width, y, ink))
            y -= ink.descent + gap
        middle = (y + gap) / 2 - AXIS * self._size
        width = max(x + ink.width for x, _, ink in placed)
        lines = overlay([(x, v - middle, ink) for x, v, ink in placed], width, self._rule)
        tip = 0.5 * brace
        high, low, axis = lines.ascent, -lines.descent, AXIS * self._size
        bend = 0.25 * self._size
        sign = (
            (tip + 0.15 * brace, high), (tip, high - bend / 2), (tip, axis + bend),
            (tip - 0.2 * brace, axis), (tip, axis - bend), (tip, low + bend / 2),
            (tip + 0.15 * brace, low),
        )  # fmt: skip
        return FormulaBox(
            width, lines.ascent, lines.descent, lines.letters, (*lines.lines, sign), self._rule
        )

    def _equation(self, one: Equation) -> list[FormulaBox]:
        left, equal = self._sum(one.left), self.text("\u00a0=\u00a0")
        if one.right:
            return [left, equal, self._sum(one.right)]
        head = [self.set(parse(one.name)), equal] if one.name else []
        return [*head, left, equal, self.text("0")]

    def _sum(self, terms: Sequence[Term]) -> FormulaBox:
        parts: list[FormulaBox] = []
        for number, term in enumerate(terms):
            parts += [self.text("\u00a0+\u00a0")] if number else []
            parts.append(self._term(term))
        return self.row(parts)

    def _term(self, term: Term) -> FormulaBox:
        nodes = parse(term.symbol)
        barred = (Overline(nodes[:1]), *nodes[1:]) if isinstance(nodes[0], Letters) else nodes
        symbol = self.set(barred)
        below = self._smaller().set(parse(term.direction))
        width = max(symbol.width, below.width + 0.2 * self._size * bool(term.direction))
        at, gap = (width - symbol.width) / 2, 0.12 * self._size
        levels = [-symbol.descent - gap * (1 + k) for k in range(term.underlines)]
        lines = tuple(((at, level), (at + symbol.width, level)) for level in levels)
        placed = [(at, 0.0, symbol)]
        if term.direction:
            low = min([-symbol.descent, *levels]) - gap - below.ascent
            placed.append(((width - below.width) / 2, low, below))
        whole = overlay(placed, width, self._rule)
        depth = max([whole.descent, *(-level for level in levels)])
        return FormulaBox(
            width, whole.ascent, depth, whole.letters, (*whole.lines, *lines), self._rule
        )


class FormulaLines(Flowable):  # type: ignore[misc]
    """Formulas one under another in the middle of a page, the number beside the last (формула).

    ``section``: as close as it is set, as much less white is above and below each.
    """

    def __init__(
        self, rows: Sequence[FormulaBox], number: str, font: str, size: float, section: Section
    ) -> None:
        super().__init__()
        self._rows, self._number, self._font, self._size = rows, number, font, size
        self._section, self._gap, self._width = section, 0.0, 0.0

    def wrap(self, width: float, height: float) -> tuple[float, float]:
        """Return the space that the formulas take, points."""
        self._width, self._gap = width, 0.45 * self._size * (2.0 * self._section.scale - 1.0)
        return width, sum(row.ascent + row.descent + self._gap for row in self._rows) + self._gap

    def draw(self) -> None:
        """Draw the formulas on the canvas; one that is too wide is drawn smaller."""
        _, y = self.wrap(self._width, 0.0)
        y -= self._gap
        side = 4.0 * self._size if self._number else 0.0
        for k, row in enumerate(self._rows):
            y -= row.ascent
            room = self._width - 2 * side
            share = min(1.0, room / row.width) if row.width else 1.0
            self.canv.saveState()
            self.canv.translate(side + (room - share * row.width) / 2, y)
            self.canv.scale(share, share)
            draw_ink(self.canv, row)
            self.canv.restoreState()
            if self._number and k == len(self._rows) - 1:
                self.canv.setFont(self._font, self._size)
                self.canv.drawRightString(self._width, y, f"({self._number})")
            y -= row.descent + self._gap


def draw_ink(canvas: Any, ink: FormulaBox) -> None:
    """Draw a typeset formula from the origin of the canvas."""
    for one in ink.letters:
        canvas.setFont(one.font, one.size)
        canvas.drawString(one.x, one.y, one.text)
    canvas.setLineWidth(ink.rule)
    for line in ink.lines:
        path = canvas.beginPath()
        path.moveTo(*line[0])
        for place in line[1:]:
            path.lineTo(*place)
        canvas.drawPath(path, stroke=1, fill=0)


class Section(Struct):
    """Part of a note between two page breaks; ``scale``: how close its content is set.

    Its pictures are smaller by it; formulas and lines of the contents are closer.
    """

    scale: float = 1.0


MAX_PASSED = 12
"""Largest number of paragraphs and formulas moved before content that does not fit."""


MIN_SHRINK = 0.78
"""Least scale to which a picture may be shrunk where no text can go before it.

Its letters of 3.2 mm are 2.5 mm high then.
"""


_CLEARANCE = 0.1  # points that a picture stays off the foot of the page


class Floating(KeepTogether):  # type: ignore[misc]
    """Content kept on one page, if need be the next (то, что не разрывается)."""

    passed = 0
    """Texts that went before it."""

    shrunk: Any = None
    """The picture that may be smaller: ``at_most`` is the share of its size that it is shown in."""


class LaidParagraph(Paragraph):  # type: ignore[misc]
    """A paragraph whose lines are broken once for a width: pages try it several times."""

    _broken: float | None = None

    def wrap(self, width: float, height: float) -> tuple[float, float]:
        """Return the space that the lines take, points."""
        if width != self._broken:
            super().wrap(width, height)
            self._broken = width
        return self.width, self.height

    def split(self, width: float, height: float) -> list[Flowable]:
        """Return the part that fits, and the rest; reportlab changes words of the whole then."""
        parts = list(super().split(width, height))
        self._broken = None
        return parts


class LaidFrame(Frame):  # type: ignore[misc]
    """The part of a page that has the text; it is drawn when all pages are laid out."""

    def add(self, flowable: Flowable, canvas: Any, trySplit: int = 0) -> int:  # noqa: N803
        """Put a flowable at the current place; return whether it fits."""
        if canvas._doctemplate.is_drawn:
            return int(super().add(flowable, canvas, trySplit))
        flowable.drawOn = _leave_undrawn
        try:
            return int(super().add(flowable, canvas, trySplit))
        finally:
            del flowable.drawOn


def _leave_undrawn(*_: Any, **__: Any) -> None:
    """Stand for the drawing of a flowable."""


class FloatingPages(BaseDocTemplate):  # type: ignore[misc]
    """Pages without gaps: content that does not fit waits, the text after it goes before.

    It waits at most until the next heading. A picture that cannot wait is made smaller, if it
    fits then.
    """

    is_drawn = False
    """Whether a run over the pages draws them; else they are laid out."""

    def filterFlowables(self, flowables: list[Any]) -> None:  # noqa: N802
        """Put the text after a picture or table before it where that does not fit."""
        first = flowables[0]
        if not isinstance(first, Floating) or (missing := self._missing(first)) <= 0.0:
            return
        end = 2
        while end < len(flowables) and flowables[end - 1].getKeepWithNext():
            end += 1
        group = flowables[1:end]
        if group and all(map(_is_text, group)) and first.passed < MAX_PASSED:
            self._set(first, "passed", first.passed + len(group), before=0)
            flowables[:end] = [*group, first]
        elif (picture := first.shrunk) is not None and picture.at_most == 1.0:
            high = picture.wrap(self.frame._aW, 0.0)[1]
            share = (high - missing - _CLEARANCE) / high
            if share >= MIN_SHRINK:
                self._set(picture, "at_most", share, before=1.0)

    def _set(self, one: Any, name: str, value: float, *, before: float) -> None:
        """Change a number for this run over the pages: the next run starts with the old value."""
        mended = getattr(self, "_multiBuildEdits", None)
        if mended:
            mended((setattr, one, name, before))
        setattr(one, name, value)

    def _missing(self, one: Floating) -> float:
        """Return the missing height for something, points; 0 or less where it fits."""
        one.wrapOn(self.canv, self.frame._aW, 1e6)
        room = self.frame._y - self.frame._y1p
        return 0.0 if self.frame._atTop else float(one._H - room)


def _is_text(flowable: Flowable) -> bool:
    """Return whether something is text or a formula, not a heading, picture, table or break."""
    return not isinstance(
        flowable, Floating | KeepTogether | PageBreak | CondPageBreak
    ) and not hasattr(flowable, "level")
