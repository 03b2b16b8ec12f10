"""Slotted link (кулисный механизм) from the ratio of times or the swing, and the centres.

The crank is perpendicular to the slotted link where that turns back, so its swing is the angle θ
between the two cranks: ψ = θ = 180°(K - 1)/(K + 1) (Artobolevsky; Popov).
"""

from __future__ import annotations

from collections.abc import Mapping
from math import cos, radians, sin
from typing import Any

from planmethod.construct.steps import LineSense
from planmethod.errors import AssemblyError
from planmethod.synthesis.model import (
    Board,
    FileTable,
    Pose,
    Synthesis,
    angle_of_ratio,
    choose_option_set,
)

OPTIONS = ("K_v", "swing", "centres", "stroke", "rod")
SIZES: Mapping[str, str] = {"centres": "O1O3", "rod": "BC"}


def synthesize(options: Mapping[str, Any]) -> Synthesis:
    """Find crank, slotted link and, with a stroke, the rod and the guide of a shaper.

    Parameters
    ----------
    options : mapping
        ``K_v`` or ``swing`` (degrees), ``centres`` O1O3 (m); with ``stroke`` (m) a slider driven by
        a rod, ``rod`` long; default: O3B/2 (more for swings near 180 degrees).

    Raises
    ------
    InputError, AssemblyError
    """
    ways = ("K_v centres", "swing centres")
    more = ("", " stroke", " stroke rod")
    choose_option_set(options, "slotted", *(way + also for also in more for way in ways))
    swing = options["swing"] if options["K_v"] is None else angle_of_ratio(options["K_v"])
    if not 0.0 < swing < 180.0:
        raise AssemblyError(
            "There is no such mechanism: the slotted link would swing through {:.10g} "
            "deg; more than 0 (K_v > 1, the crank would have no length) and less than "
            "180 (the crank as long as O1O3: the link turns fully) is possible.",
            swing,
        )
    b = Board()
    o3 = b.fixed("O3", 0j)
    lies = options["stroke"] is None
    up = b.ray(o3, None, 0.0 if lies else 90.0)
    o1 = b.lay_off_length("O1", o3, up, b.length("O1O3", options["centres"]))
    axis = b.join(o3, o1)
    rays = [b.ray(o3, axis, way * swing / 2) for way in (1.0, -1.0)]
    pins = [
        b.intersect_lines(name, ray, b.perpendicular(o1, ray))
        for name, ray in zip(("A'", "A''"), rays, strict=True)
    ]
    b.circles.append((o1, *pins))
    crank = b.measure("O1 A", o1, pins[0])
    b.length_from("O1A", crank)
    # The block must not leave the slot: its furthest place is on the line of centres.
    b.length_from("O3D", b.measure("O3 O1", o3, o1), crank)
    lengths: tuple[str, ...] = ("O1O3", "O1A", "O3D")
    poses = [Pose((("O1", pin), ("O3", pin)), (), stones=((pin, "O3"),)) for pin in pins]
    tables = [
        FileTable("links.1", "crank", ('points = ["O1", "A"]', 'O1A = "l_O1A"')),
        FileTable("links.2", "stone", ('points = ["A"]', 'slides = { on = "3", along = "O3D" }')),
        FileTable("links.3", "slotted", ('points = ["O3", "D"]', 'O3D = "l_O3D"')),
        FileTable("assembly", "assembly", (f'D = "{"right of" if lies else "above"} O3"',)),
    ]
    found: dict[str, Any] = {
        "targets": {"swing": swing} | ({} if options["K_v"] is None else {"K_v": options["K_v"]}),
        "output": "3",
        "pressure": ("", "", ""),
    }
    if options["stroke"] is not None:
        half = options["stroke"] / 2
        across = b.ray(o3, None, 0.0)
        ends = []
        for name, ray, away in zip(("B'", "B''"), rays, (-half, half), strict=True):
            foot = b.lay_off_length(f"K{name[1:]}", o3, across, b.length(f"H/2 {name}", away))
            ends.append(b.intersect_lines(name, ray, b.parallel(foot, up)))
        reach = b.measure("O3 B", o3, ends[0])
        b.length_from("O3B", reach)
        top = b.intersect_line_circle("B", up, o3, reach, LineSense.FORWARD)
        b.circles.append((o3, *ends))
        low = b.intersect_lines("E", up, b.perpendicular(ends[0], up))
        middle = b.intersect_lines("M", up, b.bisector(low, top))
        b.length_from("O3M", b.measure("O3 M", o3, middle))
        guide = b.parallel(middle, across)
        # Where the rod came to be parallel to the slotted link, the slider would turn back.
        turn = radians(swing / 2)
        rise = half / sin(turn) * (1.0 - cos(turn)) / 2
        rod = options["rod"] or max(half / sin(turn) / 2, 2.0 * rise / cos(turn))
        if rod * cos(turn) <= rise:
            raise AssemblyError(
                "rod = {:.10g} m: with this stroke and swing it must be longer than {:.10g} "
                "m, else the slider turns back before the slotted link.",
                rod,
                rise / cos(turn),
            )
        arm = b.length("BC", rod)
        sliders = [
            b.intersect_line_circle(f"C{end[1:]}", guide, end, arm, LineSense.FORWARD)
            for end in ends
        ]
        for k, (end, slider) in enumerate(zip(ends, sliders, strict=True)):
            links = (("O1", pins[k]), ("O3", end), (end, slider))
            poses[k] = Pose(links, (end,), (slider,), poses[k].stones)
        lengths += ("O3B", "BC", "O3M")
        tables[2] = FileTable(
            "links.3",
            "slotted",
            ('points = ["O3", "D", "B"]', 'O3D = "l_O3D"', 'B = { on = "O3D", at = "l_O3B" }'),
        )
        tables[3:] = [
            FileTable("links.4", "rod", ('points = ["B", "C"]', 'BC = "l_BC"')),
            FileTable("links.5", "slider", ('points = ["C"]', 'slides = { on = "x-x" }')),
            FileTable("assembly", "assembly", ('D = "above O3"', 'C = "right of B"')),
        ]
        found["targets"]["stroke"] = options["stroke"]
        found |= {"output": "C", "pressure": ("B", "C", ""), "guide": ("M",)}
    return Synthesis(
        "slotted",
        b,
        lengths,
        ("O3", "O1"),
        tuple(poses),
        grashof=("O1A", "O1O3"),
        tables=tuple(tables),
        driver=("O1", pins[0]),
        theta=("O3", *pins),
        **found,
    )
