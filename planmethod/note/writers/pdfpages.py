"""Pages whose pictures and tables let the text after them go before (перенос рисунков и таблиц)."""

from __future__ import annotations

from typing import Any

from reportlab.platypus import BaseDocTemplate, CondPageBreak, Flowable, KeepTogether, PageBreak

MOST = 12
"""Paragraphs and formulas that may go before what has no room, at the most."""


class Floating(KeepTogether):  # type: ignore[misc]
    """What stands on one page, if need be on the next (то, что не разрывается)."""

    passed = 0
    """Texts that went before it."""


class FloatingPages(BaseDocTemplate):  # type: ignore[misc]
    """Pages without room left over: what has no room waits, the text after it goes before.

    It waits no longer than to the next heading.
    """

    def filterFlowables(self, flowables: list[Any]) -> None:  # noqa: N802
        """Put the text after a picture or table before it where that has no room."""
        first = flowables[0]
        if not isinstance(first, Floating) or first.passed >= MOST or self._fits(first):
            return
        end = 2
        while end < len(flowables) and flowables[end - 1].getKeepWithNext():
            end += 1
        group = flowables[1:end]
        if group and all(map(_is_text, group)):
            first.passed += len(group)
            mended = getattr(self, "_multiBuildEdits", None)
            if mended:
                mended((setattr, first, "passed", 0))
            flowables[:end] = [*group, first]

    def _fits(self, one: Floating) -> bool:
        one.wrapOn(self.canv, self.frame._aW, 1e6)
        return bool(self.frame._atTop or self.frame._y - self.frame._y1p >= one._H)


def _is_text(flowable: Flowable) -> bool:
    """Tell whether something is text or a formula, no heading, picture, table or break."""
    return not isinstance(
        flowable, Floating | KeepTogether | PageBreak | CondPageBreak
    ) and not hasattr(flowable, "level")
