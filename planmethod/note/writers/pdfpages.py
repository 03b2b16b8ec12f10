"""Pages whose pictures and tables let the text after them go before (перенос рисунков и таблиц)."""

from __future__ import annotations

from typing import Any

from reportlab.platypus import BaseDocTemplate, CondPageBreak, Flowable, KeepTogether, PageBreak

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


class FloatingPages(BaseDocTemplate):  # type: ignore[misc]
    """Pages without gaps: content that does not fit waits, the text after it goes before.

    It waits at most until the next heading. A picture that cannot wait is made smaller, if it
    fits then.
    """

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
