"""Pages whose pictures and tables let the text after them go before (перенос рисунков и таблиц)."""

from __future__ import annotations

from typing import Any

from reportlab.platypus import (
    BaseDocTemplate,
    CondPageBreak,
    Flowable,
    Frame,
    KeepTogether,
    PageBreak,
    Paragraph,
)

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
