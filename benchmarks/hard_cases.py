"""The hard cases: mechanisms of textbook proportions at and near impossible positions."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable

from benchmarks import hard_problems as texts
from benchmarks.hard import HardCase, HardInput

NEARER = tuple(10.0**-k for k in range(1, 13))
GAPS = (*NEARER, 1e-13, 1e-14, 1e-15)
BEYOND = (-1e-15, -1e-13, -1e-11, -1e-6, -1e-1)
TURNED = 37.0
ROUND = (20.0, 100.0, 250.0)
FOUR_BAR = (0.125, 0.5, 0.375, 0.5)  # crank, rod, arm, frame

Make = Callable[[str, str, float], HardCase]


def _both_ways(make: Make, name: str, title: str) -> tuple[HardCase, HardCase]:
    """Return a case along the axes and the same turned."""
    turned = f"{title}, turned by 37 degrees"
    return make(name, title, 0.0), make(f"{name}-turned", turned, TURNED)


def _label(value: float) -> str:
    return f"{value:.0e}" if value else "exactly"


def _vary(text: Callable[[float], str], values: Iterable[float]) -> tuple[HardInput, ...]:
    return tuple(HardInput(_label(value), text(value)) for value in values)


def _approach(text: str, at: Callable[[float], float], alone: str = "") -> tuple[HardInput, ...]:
    """Return rows that approach a position and reach it; ``alone``: it is in the file."""
    rows = [HardInput(_label(d), text, (at(d),)) for d in (*NEARER, 0.0)]
    if alone:
        rows.append(HardInput("exactly, alone in the file", alone))
    return tuple(rows)


def _slider_crank_by_crank(name: str, title: str, turn: float) -> HardCase:
    text = texts.slider_crank(turn=turn)
    rows = (
        *_approach(text, lambda d: turn + 180.0 + math.degrees(d)),
        HardInput("outer, 1e-8", text, (turn + math.degrees(1e-8),)),
        HardInput("outer, exactly", text, (turn,)),
    )
    return HardCase(name, title, "rad from the dead position", rows)


def _slider_crank_by_slider(name: str, title: str, turn: float) -> HardCase:
    text = texts.driven_by_slider(turn=turn)
    alone = texts.driven_by_slider(turn=turn, s=0.5)
    rows = (
        *_approach(text, lambda d: 0.5 - texts.depart(0.125, 0.375, d), alone),
        HardInput("inner, 1.5e-6 m", text, (0.25 + 1.5e-6,)),
        HardInput("inner, exactly", text, (0.25,)),
        HardInput("beyond, 1e-9 m", text, (0.5 + 1e-9,)),
    )
    return HardCase(name, title, "rad of the crank from the dead position", rows)


def _slider_from_dead(name: str, title: str, turn: float) -> HardCase:
    text = texts.driven_by_slider(turn=turn, start=0.5, s=-0.0625)
    rows = _approach(text, lambda d: -texts.depart(0.125, 0.375, d))
    return HardCase(name, title, "rad of the crank from the dead position", rows)


def _rocker_by_crank(name: str, title: str, turn: float) -> HardCase:
    text = texts.rocker(turn=turn)
    dead, other = texts.stretched(*FOUR_BAR), texts.folded(*FOUR_BAR)
    rows = (
        *_approach(text, lambda d: turn + dead + math.degrees(d)),
        HardInput("folded, 1e-8", text, (turn + other + math.degrees(1e-8),)),
        HardInput("folded, exactly", text, (turn + other,)),
    )
    return HardCase(name, title, "rad from the dead position", rows)


def _rocker_by_rocker(name: str, title: str, turn: float) -> HardCase:
    text = texts.rocker(turn=turn, phi=110.0, by_rocker=True)
    alone = texts.rocker(turn=turn, phi=90.0, by_rocker=True)
    rows = (
        *_approach(text, lambda d: turn + 90.0 + math.degrees(d), alone),
        HardInput("beyond, 1e-12", text, (turn + 90.0 - math.degrees(1e-12),)),
        HardInput("beyond, 1e-3", text, (turn + 90.0 - math.degrees(1e-3),)),
    )
    return HardCase(name, title, "rad from the dead position", rows)


def _change_point(rod: float, arm: float, frame: float) -> Make:
    def make(name: str, title: str, turn: float) -> HardCase:
        text, alone = (
            texts.rocker(turn=turn, phi=phi, rod=rod, arm=arm, frame=frame) for phi in (50.0, 0.0)
        )
        rows = _approach(text, lambda d: turn + math.degrees(d), alone)
        return HardCase(name, title, "rad from the change point", rows)

    return make


def _isosceles(name: str, title: str, turn: float) -> HardCase:
    text = texts.slider_crank(turn=turn, crank=0.25, rod=0.25)
    rows = _approach(text, lambda d: turn + 90.0 - math.degrees(d))
    return HardCase(name, title, "rad from the change point", rows)


def _touching(text: Callable[[float, float], str]) -> Make:
    """Return a maker of cases whose ``text(gap, turn)`` closes with a gap, and not beyond it."""

    def make(name: str, title: str, turn: float) -> HardCase:
        rows = _vary(lambda gap: text(gap, turn), (*GAPS, 0.0, *BEYOND))
        return HardCase(name, title, "gap, as a share", rows)

    return make


def _slotted(share: float) -> Make:
    """Return a maker of cases with the slot line offset by a share of the pin's distance."""

    def make(name: str, title: str, turn: float) -> HardCase:
        def text(d: float, size: float = 1.0) -> str:
            return texts.pin_from_pivot(distance=d, turn=turn, offset=share * d, size=size)

        rows = tuple(
            HardInput(_label(d), text(d), like=text(d, 2.0**20) if d else "")
            for d in (*NEARER, 0.0)
        )
        return HardCase(name, title, "m from the pivot", rows)

    return make


def _swinging_block() -> HardCase:
    rows = _vary(lambda d: texts.swinging_block(distance=d), (*NEARER, 0.0))
    title = "pin of a rod next to the pivot of its block"
    return HardCase("swinging-block", title, "m from the pivot", rows)


def _parallel_guides(name: str, title: str, turn: float) -> HardCase:
    rows = _approach(texts.tangent_slide(turn=turn), lambda d: turn + d)
    return HardCase(name, title, "deg between the guides", rows)


def _parallel(text: Callable[[float, float], str]) -> Make:
    def make(name: str, title: str, turn: float) -> HardCase:
        rows = _vary(lambda d: text(d, turn), (10.0, 1.0, *NEARER, 0.0))
        return HardCase(name, title, "deg between the rays", rows)

    return make


def _zeros() -> HardCase:
    t = texts
    rows = (
        HardInput("slider-crank, omega = 0", t.slider_crank(omega=0.0), (50.0, 180.0)),
        HardInput(
            "slider-crank, epsilon alone", t.slider_crank(omega=0.0, epsilon=7.0), (50.0, 180.0)
        ),
        HardInput("rocker, omega = 0", t.rocker(omega=0.0), (70.0, 200.0)),
        HardInput("rocker, epsilon alone", t.rocker(omega=0.0, epsilon=7.0), (70.0, 200.0)),
        HardInput("rocker, epsilon = 0", t.rocker(), (70.0, 200.0)),
        HardInput("slotted link, omega = 0", t.slotted(omega=0.0), (30.0, 200.0)),
        HardInput("slotted link, epsilon alone", t.slotted(omega=0.0, epsilon=7.0), (30.0, 200.0)),
        HardInput("slotted link, epsilon = 0", t.slotted(), (30.0, 200.0)),
        HardInput("stone at rest on the crank", t.tangent_slide(omega=0.0), (40.0, 90.0)),
        HardInput("cross slide, omega = 0", t.cross_slide(omega=0.0), (50.0, 90.0)),
        HardInput("slider v = 0, a = 0", t.driven_by_slider(v=0.0), (0.4375, 0.375)),
        HardInput("slider v = 0, a = 2", t.driven_by_slider(v=0.0, a=2.0), (0.4375, 0.375)),
        HardInput("v_B = 0 at the dead places", t.slider_crank(), (0.0, 180.0)),
        HardInput("v_B = 0, turned", t.slider_crank(turn=TURNED), (TURNED, 180.0 + TURNED)),
        HardInput("omega of the slotted link 0", t.slotted(pivot=0.25 + 0j), (60.0, 300.0)),
        HardInput("sliding of the stone 0", t.slotted(), (0.0, 180.0)),
        HardInput("omega of the rod 0", t.slider_crank(), (90.0, 270.0)),
        HardInput("slider v = 0 in the dead place", t.driven_by_slider(v=0.0), (0.5,)),
    )
    return HardCase("zeros", "zero segments, whose direction is not defined", "", rows)


def _third_point() -> HardCase:
    at = (20.0, 70.0, 200.0)

    def row(label: str, third: str) -> HardInput:
        return HardInput(label, texts.rocker(third=third), at)

    rows = [row("on the line", texts.lay_beside(0.0))]
    rows += [
        row(f"{d:.0e} m off the line", texts.lay_beside(d))
        for d in (1e-3, 1e-6, 1e-9, 1e-12, 1e-15)
    ]
    rows += [
        row(f"sides longer by {d:.0e}", texts.lay_needle(d)) for d in (1e-3, 1e-6, 2e-9, 1e-10)
    ]
    rows += [
        row("at a joint", texts.lay_beside(0.0, at=0.0)),
        row("at the other joint", texts.lay_beside(0.0, at=0.5)),
        row("1e-12 m from the other joint", texts.lay_beside(1e-12, at=0.5)),
        row("1e-12 m from a joint, along", texts.lay_beside(0.0, at=1e-12)),
        row("1e-12 m from a joint, across", texts.lay_beside(1e-12, at=0.0)),
    ]
    rows += [
        row(f"by two lengths, {d:.0e} m from a joint", texts.lay_close(d))
        for d in (1e-2, 1e-4, 1e-6, 1e-8)
    ]
    return HardCase("similar", "similarity triangles that degenerate", "", tuple(rows))


def _short_base() -> HardCase:
    """Return rods much shorter than the arm of their third point: similarity blows errors up."""

    def text(rod: float) -> str:
        return texts.rocker(
            phi=180.0, rod=rod, frame=0.25, third=texts.lay_beside(0.0625, at=0.375)
        )

    rows = _vary(text, (1e-1, 1e-3, 1e-5, 1e-7, 1e-9))
    return HardCase("short-base", "a far point by similarity to a short rod", "rod, m", rows)


def _ratios() -> HardCase:
    small, large = (1e-6, 1e-4, 1e-2), (1e2, 1e4, 1e6)
    rows = [
        HardInput(f"crank {r:.0e} of the rod", texts.slider_crank(rod=0.125 / r), ROUND)
        for r in small
    ]
    rows += [
        HardInput(f"crank {r:.0e} of the other links", texts.rocker(crank=0.5 * r), ROUND)
        for r in small
    ]
    rows += [
        HardInput(
            f"rod and frame {r:.0e} of the arm",
            texts.rocker(rod=0.375 * r, frame=0.375 * r),
            ROUND,
        )
        for r in large
    ]
    rows += [
        HardInput(
            f"rod and arm {r:.0e} of the frame", texts.rocker(rod=0.5 * r, arm=0.5 * r), ROUND
        )
        for r in large
    ]
    rows += [
        HardInput(
            f"crank {r:.0e} of the frame",
            texts.rocker(crank=0.25, rod=0.3125, arm=0.25, frame=0.25 / r),
            ROUND,
        )
        for r in large
    ]
    return HardCase("ratios", "lengths of very different size", "", tuple(rows))


def _sizes() -> HardCase:
    def text(size: float) -> str:
        return texts.rocker(crank=size, rod=4 * size, arm=3 * size, frame=4 * size)

    values = (1e-10, 1e-9, 1e-6, 1e-3, 1.0, 1e3, 1e5, 1e6, 1e9)
    rows = [HardInput(_label(value), text(value), ROUND) for value in values]
    # An offset of an eighth per mille of the crank; powers of two scale the data exactly.
    for name, make in (("slider-crank", texts.slider_crank), ("slotted link", texts.slotted)):
        rows += [
            HardInput(
                f"{name} with an offset, {0.125 * size:.0e}",
                make(offset=2.0**-16, size=size),
                ROUND,
                like=make(offset=2.0**-16),
            )
            for size in (2.0**-10, 2.0**-20, 2.0**-26)
        ]
    return HardCase("sizes", "very small and very large mechanisms", "crank, m", tuple(rows))


def _far() -> HardCase:
    rows = [
        HardInput(f"{name}, {far:.0e}", make(origin=complex(far, -0.7 * far)), ROUND)
        for name, make in (("slider-crank", texts.slider_crank), ("rocker", texts.rocker))
        for far in (1.0, 1e2, 1e4, 5e5)
    ]
    rows += [
        HardInput(
            f"slider-crank of {0.125 * size:.0e} m, 5e+05",
            texts.slider_crank(size=size, origin=5e5 - 3e5j),
            ROUND,
        )
        for size in (2.0**-7, 2.0**-13)
    ]
    rows += [
        HardInput(
            f"cross slide of {0.125 * size:.0e} m, 5e+05",
            texts.cross_slide(size=size, origin=5e5 - 3e5j),
            ROUND,
        )
        for size in (2.0**-7, 2.0**-13)
    ]
    return HardCase("far", "a mechanism far from the origin", "m from the origin", tuple(rows))


def _turns() -> HardCase:
    rows = [
        HardInput(
            f"{turns:+.0e} turns",
            texts.rocker(),
            tuple(360.0 * turns + rest for rest in (0.0, 90.0, 180.0, 37.3, -101.7)),
        )
        for turns in (1.0, -1.0, 1e3, -1e3, 1e6, -1e6)
    ]
    rows.append(HardInput("+1e+06 turns, in the file", texts.rocker(phi=3.6e8)))
    return HardCase("turns", "a crank that has turned many times", "", tuple(rows))


def _quadrants() -> HardCase:
    quadrants = (0.0, 90.0, 180.0, 270.0, 360.0, -90.0, -180.0)
    mechanisms = (
        ("slider-crank", texts.slider_crank()),
        ("rocker", texts.rocker()),
        ("slotted link", texts.slotted()),
    )
    rows = []
    for name, text in mechanisms:
        rows.append(HardInput(f"{name}, exactly", text, quadrants))
        for d in (1e-10, -1e-10):
            beside = tuple(quadrant + d for quadrant in quadrants)
            rows.append(HardInput(f"{name}, {d:+.0e} deg", text, beside))
    return HardCase("quadrants", "the crank at and beside the axes", "", tuple(rows))


def _rates() -> HardCase:
    makers = (
        ("slider-crank", texts.slider_crank),
        ("rocker", texts.rocker),
        ("slotted link", texts.slotted),
    )
    rows = [
        HardInput(f"{name}, {omega:.0e}", make(omega=omega), ROUND)
        for name, make in makers
        for omega in (1e-6, 1e-3, 1.0, 1e3, 1e6)
    ]
    rows += [
        HardInput(f"rocker, 12 and epsilon {e:.0e}", texts.rocker(epsilon=e), ROUND)
        for e in (1e-6, 1e6, -1e9)
    ]
    rows.append(HardInput("rocker, 1e+10", texts.rocker(omega=1e10)))
    return HardCase("rates", "very slow and very fast drivers", "omega, 1/s", tuple(rows))


def _coincident() -> HardCase:
    at = (0.0, 20.0, 110.0)
    t = texts
    rows = (
        HardInput("two pivots", t.rocker(phi=0.0, frame=0.0, crank=0.25), at),
        HardInput("a fixed point on no link", t.add_fixed(t.rocker(), 0j), at),
        HardInput("slider on a fixed point", t.add_fixed(t.slider_crank(), 0.5 + 0j), (0.0,)),
        HardInput("crank pin on a fixed point", t.add_fixed(t.rocker(), 0.125j), (90.0,)),
        HardInput("two points of a link", t.rocker(third=t.lay_beside(0.0, at=0.0)), at),
        HardInput("a crank with both points at one place", t.crank_of_one_place()),
        HardInput("two points of a link that name a line", t.line_of_one_place()),
        HardInput("a length of 0", t.rocker(crank=0.0)),
        HardInput("slider on the crank's pivot", t.slider_crank(crank=0.25, rod=0.25), (90.0,)),
        HardInput("pin on a fixed pivot", t.slotted(pivot=0.125 + 0j), (0.0,)),
        HardInput("pin on a pivot, in the file", t.slotted(phi=0.0, pivot=0.125 + 0j)),
    )
    return HardCase("coincident", "points at one place", "", rows)


def _many() -> HardCase:
    text = texts.pivot_at_origin()
    rows = tuple(HardInput(_label(d), text, (math.degrees(d),), many=True) for d in NEARER[1::3])
    title = "pin next to its pivot in the origin, as one of many positions"
    return HardCase("many", title, "rad from the pivot", rows)


HARD: tuple[HardCase, ...] = (
    *_both_ways(
        _slider_crank_by_crank,
        "slider-crank-by-crank",
        "dead position of the slider, driven by the crank",
    ),
    *_both_ways(
        _slider_crank_by_slider,
        "slider-crank-by-slider",
        "dead position of the crank, driven by the slider",
    ),
    *_both_ways(
        _slider_from_dead,
        "slider-from-dead",
        "the same, the slider's place counted from the dead one",
    ),
    *_both_ways(
        _rocker_by_crank, "rocker-by-crank", "dead position of the rocker, driven by the crank"
    ),
    *_both_ways(
        _rocker_by_rocker, "rocker-by-rocker", "dead position of the crank, driven by the rocker"
    ),
    *_both_ways(
        _change_point(rod=0.5, arm=0.125, frame=0.5),
        "parallelogram",
        "change point of a parallelogram",
    ),
    *_both_ways(_change_point(rod=0.375, arm=0.375, frame=0.125), "kite", "change point of a kite"),
    *_both_ways(_isosceles, "isosceles", "change point of a slider-crank with rod = crank"),
    *_both_ways(
        _touching(lambda gap, turn: texts.abreast(gap=gap, turn=turn)),
        "touching-outside",
        "two arcs touch from outside",
    ),
    *_both_ways(
        _touching(lambda gap, turn: texts.abreast(gap=gap, turn=turn, inside=True)),
        "touching-inside",
        "two arcs touch from inside",
    ),
    *_both_ways(
        _touching(lambda gap, turn: texts.touching_line(gap=gap, turn=turn)),
        "touching-line",
        "an arc touches a guide",
    ),
    *_both_ways(_slotted(0.0), "slotted", "pin of a slotted link next to its pivot"),
    *_both_ways(_slotted(0.6), "slotted-offset", "the same, the slot line offset"),
    *_both_ways(
        _touching(
            lambda gap, turn: texts.pin_from_pivot(
                distance=0.0625 * (1 + gap), turn=turn, offset=0.0625
            )
        ),
        "slotted-touching",
        "pin of a slotted link as near its pivot as the offset of its slot",
    ),
    _swinging_block(),
    *_both_ways(_parallel_guides, "parallel-prp", "nearly parallel guides of a stone"),
    *_both_ways(
        _parallel(lambda d, turn: texts.leaning_guide(angle=d, turn=turn)),
        "parallel-rrp",
        "rod nearly square to its guide",
    ),
    *_both_ways(
        _parallel(lambda d, turn: texts.cross_slide(angle=d, turn=turn)),
        "parallel-rpp",
        "slot of a cross slide nearly along its guide",
    ),
    _zeros(),
    _third_point(),
    _short_base(),
    _ratios(),
    _sizes(),
    _far(),
    _turns(),
    _quadrants(),
    _rates(),
    _coincident(),
    _many(),
)
"""All hard cases."""
