"""Sources of the drafting error of a result, in words (источники погрешности)."""

from __future__ import annotations

from collections.abc import Iterator
from typing import assert_never

from planmethod.construct import steps
from planmethod.construct.steps import PointName, Step
from planmethod.note.compared import ComparedNumber, Series, rounded_to
from planmethod.note.document import Caption, Item, Node, Paragraph, fixed, localized
from planmethod.note.formula import Rich
from planmethod.note.narrate.naming import Names
from planmethod.note.narrate.transfers import even_letter
from planmethod.note.tables.errors import motion_series
from planmethod.plans.build import MOTION_KINDS
from planmethod.plans.model import FACTS, PlanKind
from planmethod.plans.motion.position import link_of_axis
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.errors.spread import SHORT
from planmethod.solved.quantities import transfers_of

MAX_CAUSES = 3
"""Causes that are listed for one result."""


class ErrorCauses:
    """Finds and names the strokes of a drawing that cause the error of a result.

    Parameters
    ----------
    names : Names
        Of the solution, in the language.
    """

    def __init__(self, names: Names) -> None:
        self.names, self.texts, self.solution = names, names.texts, names.solution
        titles = names.texts["plans"].items()
        transfers = transfers_of(self.solution)
        added = () if transfers is None else transfers.added
        self._added = {str(step.out): step for step in added}
        self._titles = {kind: title[:1].lower() + title[1:] for kind, title in titles}

    def nodes(self, index: int) -> Iterator[Node]:
        """Yield the worst result of a position and its largest causes; none if none is known."""
        worst = self._worst(index)
        if worst is None:
            return
        series, one = worst
        texts, part = self.texts, one.expected
        assert part is not None
        yield Caption(texts.table_causes)
        yield Paragraph(
            texts.worst_result.format(
                symbol=series.symbol,
                value=localized(rounded_to(one.exact, one.sigma), texts),
                sigma=localized(one.sigma_text, texts),
                unit=texts["units"][series.unit] if series.unit else "",
                part=fixed(part, texts, 0 if part > 2.0 else 1),
            )
        )
        causes = drafting_of(self.solution).causes(series.label, index)
        for stroke, share in causes[:MAX_CAUSES]:
            yield Item(self.describe(stroke), label=f"{100 * share:.0f} %")

    def _worst(self, index: int) -> tuple[Series, ComparedNumber] | None:
        """Return the result with the largest error for its size.

        A value lost in its error, or found by random draws, has no causes of first order.
        """
        every = ((one, one[index]) for one in motion_series(self.solution, *MOTION_KINDS))
        known = [
            (series, one)
            for series, one in every
            if not one.mark and 0.0 < SHORT * one.sigma <= abs(one.exact)
        ]
        return max(known, key=lambda pair: pair[1].expected or 0.0, default=None)

    def describe(self, stroke: str) -> Rich:
        """Return a stroke in words: "проведение прямой из точки b ⊥ BC (план скоростей)"."""
        if stroke in self._added:  # of the analogues of accelerations of a crank with ε
            text = self._of_analogues(self._added[stroke])
            return f"{text} ({self._titles[PlanKind.ACCELERATION.value]})"
        step = self.names.step[PointName(stroke)]
        text = self._stroke(step)
        plans = self.names.construction.draft.plans
        plan = plans.get(step.out) or plans.get(getattr(step, "head", step.out))
        return text if plan is None else f"{text} ({self._titles[plan.value]})"

    def _of_analogues(self, step: Step) -> Rich:
        names, texts = self.names, self.texts
        if isinstance(step, steps.Measure):
            point = str(step.out).strip("|").removeprefix("a_q_")
            segment = f"{names.pole(PlanKind.ACCELERATION)}{even_letter(names, point)}"
            return texts.cause_read.format(segment=segment)
        assert isinstance(step, steps.Carry)
        point = str(step.out).removeprefix(FACTS[PlanKind.ACCELERATION].prefix).removesuffix("_q")
        return texts.cause_lay_off.format(of=names.of(step.origin), point=even_letter(names, point))

    def _stroke(self, step: Step) -> str:
        names, texts = self.names, self.texts
        match step:
            case steps.AtAngle(_, _, None, angle) if names.guide(step.out) is None:
                return texts.cause_angle.format(symbol=names.symbol(angle))
            case steps.Join() | steps.Parallel() | steps.Perpendicular() | steps.AtAngle():
                return texts.cause_line.format(line=names.line(step.out))
            case steps.GivenPoint(out):
                return texts.cause_given.format(point=names.point(out))
            case steps.LayOffLength(out, origin) | steps.Carry(out, origin):
                return texts.cause_lay_off.format(of=names.of(origin), point=names.point(out))
            case steps.IntersectLines(out):
                return texts.cause_meet.format(point=names.point(out))
            case steps.IntersectCircles(out) | steps.IntersectLineCircle(out):
                return texts.cause_arc.format(point=names.point(out))
            case steps.Touch(out):
                return texts.cause_touch.format(point=names.point(out))
            case steps.TriadPose():
                return texts.cause_hold.format(link=link_of_axis(step))
            case steps.Spot(out):
                return texts.cause_spot.format(point=names.point(out))
            case steps.Similar(out):
                return texts.cause_similar.format(point=names.point(out))
            case steps.Measure(_, tail, head) | steps.MeasureAlong(_, tail, head, _):
                return texts.cause_read.format(segment=names.segment(tail, head))
            case steps.MeasureArm(_, about, at):
                return texts.cause_read.format(segment=names.segment(about, at))
            case steps.MeasureAngle(_, line):
                return texts.cause_measured_angle.format(line=names.line(line))
            case steps.GivenNumber() | steps.Compute() | steps.Total():
                raise TypeError(f"{step.out} is no stroke")
            case _:
                assert_never(step)
