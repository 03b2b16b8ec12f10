"""Position plan: the mechanism drawn to scale by arcs and lines (план положений, метод засечек)."""

from __future__ import annotations

from msgspec import Struct

from planmethod.construct.steps import LineName, PointName
from planmethod.errors import AssemblyError
from planmethod.mechanism.groups import AssurGroup, Lead
from planmethod.mechanism.model import FRAME, Prismatic, Revolute
from planmethod.plans.closing import Closing
from planmethod.plans.dimensions import Dimension, DimensionKind
from planmethod.plans.draft import Draft, side, way
from planmethod.problem.model import Problem, Slide

EQUAL = 1e-9
"""Share of a length by which the opposite sides of a parallelogram may differ."""


def slide_of(draft: Draft, joint: Prismatic | Revolute) -> Slide:
    """Return the line of a prismatic pair."""
    assert isinstance(joint, Prismatic)
    return draft.problem.slides[joint.slider]


def has_two_closings(group: AssurGroup) -> bool:
    """Tell whether the same links can be joined in two ways: then a rule must choose."""
    return group.signature in ("RRR", "RRP", "RPR")


def place_frame(draft: Draft) -> None:
    """Take the fixed points as given."""
    for point, place in draft.problem.bodies[FRAME].points.items():
        draft.places[point] = place - draft.origin
        draft.b.given(point)
        draft.mark_placed(point)


def place_driver(draft: Draft) -> None:
    """Draw the driving link in the asked position."""
    drive = draft.problem.drive
    if drive.pivot is not None:
        phi = draft.b.known("phi")
        draft.axes[drive.link] = draft.b.at_angle(PointName(drive.pivot), None, phi)
        draft.place_rest(drive.link)
        return
    slide = draft.problem.slides[drive.link]
    s = draft.b.compute("|s|", (draft.b.known("s"), 1), (draft.mu_l, -1))
    draft.dimensions[s] = Dimension(DimensionKind.WAY, (slide.pin,), "s")
    track = draft.path(slide, FRAME, slide.pin)
    draft.b.lay_off(slide.pin, track.origin, track.line, s)
    draft.mark_placed(slide.pin)
    draft.turn_with(slide, FRAME, PointName(slide.pin))
    draft.place_rest(drive.link)


def place_group(draft: Draft, group: AssurGroup) -> None:
    """Place the links of a dyad between the links that it hangs on.

    Raises
    ------
    AssemblyError
        For a group of a higher class: it is recognised, and not built by these steps.
    """
    if group.class_number != 2:
        raise AssemblyError(
            "Group of class {}, order {} (links {}) cannot be built by arcs and lines "
            "alone: only dyads (class II) are. Choose another driving link, so that the "
            "mechanism falls into dyads.",
            group.class_number,
            group.order,
            ", ".join(group.links),
        )
    closing = draft.choice.get(group.links, Closing())
    match group.signature:
        case "RRR" if closing.parallel:
            _place_parallel(draft, group)
        case "RRR":
            _place_rrr(draft, group, closing)
        case "RRP":
            _place_rrp(draft, group, closing)
        case "RPR":
            _place_rpr(draft, group, closing.side)
        case "PRP":
            _place_prp(draft, group)
        case "RPP":
            _place_rpp(draft, group)
        case _:
            raise AssemblyError("No recipe for a group {} of class II.", group.signature)
    for link in group.links:
        draft.place_rest(link)


def inner_point(group: AssurGroup) -> str:
    """Return the point of the inner revolute joint."""
    (joint,) = group.inner
    assert isinstance(joint, Revolute)
    return joint.point


def lead_point(lead: Lead) -> str:
    """Return the point of a revolute outer joint."""
    assert isinstance(lead.joint, Revolute)
    return lead.joint.point


def split(group: AssurGroup) -> tuple[Lead, Lead]:
    """Return the leads with the revolute one first (a mixed dyad), else in the group's order."""
    first, second = group.leads
    if isinstance(first.joint, Prismatic) and isinstance(second.joint, Revolute):
        return second, first
    return first, second


def _place_rrr(draft: Draft, group: AssurGroup, closing: Closing) -> None:
    c = inner_point(group)
    one, two = group.leads
    p, q = lead_point(one), lead_point(two)
    draft.b.meet_circles(
        c,
        PointName(p),
        draft.drawn(draft.length(one.link, p, c)),
        PointName(q),
        draft.drawn(draft.length(two.link, q, c)),
        side(closing.side),
        draft.branch(c, closing),
    )
    draft.mark_placed(c)


def _place_parallel(draft: Draft, group: AssurGroup) -> None:
    """Draw the fourth corner of a parallelogram with the set square: no arcs that may touch."""
    c = inner_point(group)
    found = parallelogram(draft.problem, group)
    assert found is not None and found.is_one
    line = draft.b.parallel(
        PointName(found.far), draft.b.join(PointName(found.corner), PointName(found.near))
    )
    length = draft.drawn(draft.length(found.link, found.far, c))
    draft.b.lay_off(c, PointName(found.far), line, length)
    draft.mark_placed(c)


class Quadrilateral(Struct, frozen=True):
    """A dyad RRR and the corner across it: corner, near, its inner joint, far (четырёхзвенник).

    Attributes
    ----------
    corner, near, far : str
        The dyad's outer joints ``near`` and ``far`` each share a body with the corner.
    link : str
        Link of the dyad from ``far`` to its inner joint.
    sides : tuple of (str, float)
        Names and lengths in order around, m: corner-near, far-inner, corner-far, near-inner.
    """

    corner: str
    near: str
    far: str
    link: str
    sides: tuple[tuple[str, float], ...]

    @property
    def is_one(self) -> bool:
        """True where opposite sides are equal: a parallelogram."""
        (_, a), (_, b), (_, c), (_, d) = self.sides
        return abs(a - b) <= EQUAL * a and abs(c - d) <= EQUAL * c


def parallelogram(problem: Problem, group: AssurGroup) -> Quadrilateral | None:
    """Return the quadrilateral that a dyad RRR closes, a parallelogram if one can be found.

    None where its outer joints share no corner.
    """
    one, two = group.leads
    near, far, c = lead_point(one), lead_point(two), inner_point(group)
    found = None
    bodies = [body.points for link, body in problem.bodies.items() if link not in group.links]
    for first in (points for points in bodies if near in points):
        for other in (points for points in bodies if far in points and points is not first):
            for corner in (p for p in first if p in other and p not in (near, far)):
                sides = tuple(
                    (p + q, abs(points[q] - points[p]))
                    for points, p, q in (
                        (first, corner, near),
                        (problem.bodies[two.link].points, far, c),
                        (other, corner, far),
                        (problem.bodies[one.link].points, near, c),
                    )
                )
                found = Quadrilateral(corner, near, far, two.link, sides)
                if found.is_one:
                    return found
    return found


def _place_rrp(draft: Draft, group: AssurGroup, closing: Closing) -> None:
    c = inner_point(group)
    revolute, prismatic = split(group)
    slide = slide_of(draft, prismatic.joint)
    p = lead_point(revolute)
    radius = draft.drawn(draft.length(revolute.link, p, c))
    track = draft.path(slide, prismatic.to, c)
    branch = draft.branch(c, closing)
    draft.b.meet_line_circle(c, track.line, PointName(p), radius, way(closing.side), branch)
    at = draft.mark_placed(c)
    draft.turn_with(slide, prismatic.to, at)


def _place_rpr(draft: Draft, group: AssurGroup, sign: int) -> None:
    slide, host, slider = rpr_parts(draft, group)
    p, q = PointName(lead_point(host)), PointName(lead_point(slider))
    across = draft.across(slide, p, q)
    if across == 0:
        line = draft.b.join(p, q) if sign > 0 else draft.b.join(q, p)
    else:
        # The line through the slider's joint touches a circle about the host's joint.
        offset = draft.dimension(DimensionKind.OFFSET, abs(across), q, host=host.link)
        radius = draft.drawn(offset)
        foot = draft.b.touch(f"T_{q}_{host.link}", p, radius, q, side(sign * across))
        # Joined over the tangent, not turned from its short radius: that keeps the digits.
        line = draft.b.join(foot, q) if sign > 0 else draft.b.join(q, foot)
    draft.axes[slider.link] = draft.b.parallel(q, line)
    draft.axes[host.link] = draft.turned(line, p, -slide.angle, host.link)


def rpr_parts(draft: Draft, group: AssurGroup) -> tuple[Slide, Lead, Lead]:
    """Return the inner slide line of an RPR dyad, the lead that carries it, and the slider's."""
    slide = slide_of(draft, group.inner[0])
    host, slider = group.leads if group.leads[0].link == slide.host else group.leads[::-1]
    return slide, host, slider


def _place_prp(draft: Draft, group: AssurGroup) -> None:
    c = inner_point(group)
    tracks: list[LineName] = []
    for lead in group.leads:
        tracks.append(draft.path(slide_of(draft, lead.joint), lead.to, c).line)
    draft.b.meet_lines(c, tracks[0], tracks[1])
    at = draft.mark_placed(c)
    for lead in group.leads:
        draft.turn_with(slide_of(draft, lead.joint), lead.to, at)


def _place_rpp(draft: Draft, group: AssurGroup) -> None:
    revolute, prismatic = split(group)
    outer, inner = slide_of(draft, prismatic.joint), slide_of(draft, group.inner[0])
    at = PointName(lead_point(revolute))
    # Both links turn with the link that the group slides on; the first then hangs on its joint.
    draft.turn_with(outer, prismatic.to, at)
    draft.turn_with(inner, prismatic.link, at)
    draft.place_rest(revolute.link)
    x = meeting_point(draft, group)
    draft.b.meet_lines(
        x, draft.path(outer, prismatic.to, x).line, draft.path(inner, revolute.link, x).line
    )
    draft.mark_placed(x)


def meeting_point(draft: Draft, group: AssurGroup) -> str:
    """Return the point of an RPP dyad's sliding link at which its two rays meet."""
    _, prismatic = split(group)
    return next(iter(draft.problem.bodies[prismatic.link].points))
