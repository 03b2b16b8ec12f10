"""Read drawings back out of the files: a second, independent reader of every vector format.

All answers are in millimetres, y up, so that a test compares them with the display list itself.
"""

from __future__ import annotations

import base64
import re
import xml.etree.ElementTree as ET
import zlib
from cmath import exp, phase, sqrt
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from io import StringIO
from itertools import accumulate
from math import cos, hypot, pi, radians, sin, tau
from typing import Any

from doors import DrawingItem as Item, Text, in_use, lettering_of

SVG = "{http://www.w3.org/2000/svg}"
XLINK = "{http://www.w3.org/1999/xlink}"


@dataclass
class Path:
    """One painted path: its corners, points along its curves, and how it is painted."""

    corners: list[complex] = field(default_factory=list)
    along: list[complex] = field(default_factory=list)
    starts: int = 0
    closed: bool = False
    filled: bool = False
    width: float = 0.0
    grey: float = 0.0


@dataclass
class Run:
    """One run of letters: left end of its base line, em in mm, direction in degrees."""

    at: complex
    em: float
    angle: float
    text: str = ""


@dataclass
class Page:
    """Contents of a file: size in mm, and painted items in order."""

    width: float
    height: float
    items: list[Path | Run]


def read_svg(data: bytes) -> Page:
    """Read the SVG that the backend writes; a construct it should not write is an error."""
    root = ET.fromstring(data)
    box = [float(number) for number in root.attrib["viewBox"].split()]
    assert box[:2] == [0.0, 0.0]
    height = box[3]
    assert root.attrib["width"].endswith("mm")
    page = Page(float(root.attrib["width"][:-2]), float(root.attrib["height"][:-2]), [])
    defined = {f"#{part.attrib['id']}": part for part in root.iterfind(f"{SVG}defs/*")}
    drawn = root.findall(f"{SVG}g")[1]
    for group in drawn:
        said = {**drawn.attrib, **group.attrib}
        for element in group:
            if element.tag in (f"{SVG}use", f"{SVG}g"):
                page.items.append(_svg_run(element, height, defined))
                continue
            if element.tag == f"{SVG}circle":
                centre = complex(float(element.attrib["cx"]), height - float(element.attrib["cy"]))
                radius = float(element.attrib["r"])
                along = [centre + radius * exp(1j * tau * k / 64) for k in range(65)]
                path = Path([], along, 1, True)
            else:
                path = _svg_path(element.attrib["d"], height)
            path.filled = said["fill"] != "none"
            colour = said["fill" if path.filled else "stroke"]
            path.grey = int(colour[1:3], 16) / 255
            path.width = 0.0 if path.filled else float(said["stroke-width"])
            page.items.append(path)
    return page


def _svg_run(element: ET.Element, height: float, defined: dict[str, ET.Element]) -> Run:
    """Read a run from the definitions, or from the place where it is drawn if it is only there."""
    number = r"(-?[\d.]+)"
    if element.tag == f"{SVG}use":
        run, place = (
            defined[element.attrib[f"{XLINK}href"]],
            "translate({x} {y})".format(**element.attrib),
        )
    else:
        run, place = element, ""
    found = re.fullmatch(
        rf"translate\({number} {number}\)(?:rotate\({number}\))?scale\({number}-{number}\)",
        place + run.attrib["transform"],
    )
    assert found, run.attrib["transform"]
    x, y, turn, unit, unit_y = (float(part or 0) for part in found.groups())
    assert unit == unit_y
    letters = [use.attrib[f"{XLINK}href"] for use in run]
    assert set(letters) <= set(defined)
    of = {name.partition("-")[2] for name in letters}  # the name of its lettering
    assert len(of) < 2
    per_em = lettering_of("".join(of), in_use()).units_per_em
    chars = [name.partition("-")[0] for name in letters]
    text = "".join(chr(int(char[2:], 16)) for char in chars if char != "#none")
    return Run(complex(x, height - y), per_em * unit, -turn, text)


def _svg_path(data: str, height: float) -> Path:
    path = Path()
    for verb, told in re.findall("([MlAZ])([^MlAZ]*)", data):
        values = [float(number) for number in re.findall(r"-?[\d.]+", told)]
        if verb == "Z":
            path.closed = True
            continue
        point = complex(values[-2], height - values[-1])
        if verb == "A":
            path.along += _svg_arc(path.corners[-1], point, values[0], values[3], values[4])
        path.starts += verb == "M"
        if verb == "l":
            steps = map(complex, values[::2], (-value for value in values[1::2]))
            path.corners += accumulate(steps, initial=path.corners.pop())
        else:
            path.corners.append(point)
    assert "".join(re.findall("[A-Za-z]", data)) == "".join(re.findall("[MlAZ]", data))
    return path


def _svg_arc(a: complex, b: complex, radius: float, large: float, flag: float) -> list[complex]:
    """Return points along an arc by the rule of the SVG specification (F.6), seen with y up."""
    half = (b - a) / 2
    rise = sqrt(max(0.0, radius**2 - abs(half) ** 2))
    # Flag 0 is counter-clockwise here; the small arc then has its centre to the left of a→b.
    assert flag == 0
    centre = a + half + rise * 1j * half / abs(half) * (-1 if large else 1)
    turn = phase((b - centre) / (a - centre)) % tau
    assert (turn > pi) == bool(large) or abs(turn - pi) < 0.01  # half a circle, rounded
    return [centre + (a - centre) * exp(1j * turn * k / 32) for k in range(33)]


def pdf_streams(data: bytes) -> Iterator[bytes]:
    """Yield the decoded streams of a PDF."""
    for head, body in re.findall(rb"<<([^<>]*)>>\s*stream\r?\n(.*?)\r?\n?endstream", data, re.S):
        decoded = body
        if b"ASCII85Decode" in head:
            decoded = base64.a85decode(decoded.strip().removesuffix(b"~>"))
        if b"FlateDecode" in head:
            decoded = zlib.decompress(decoded)
        yield decoded


def read_pdf(data: bytes, number: int = 0) -> Page:
    """Read a page of a PDF, counted from 0, by its content stream."""
    sizes = re.findall(rb"/MediaBox \[\s*0 0 ([\d.]+) ([\d.]+)\s*\]", data)
    width, height = (float(side) / 72 * 25.4 for side in sizes[number])
    page = Page(width, height, [])
    content = [stream for stream in pdf_streams(data) if b" cm" in stream][number]
    state = {"w": 1.0, "G": 0.0, "g": 0.0}
    scale = 1.0
    em = 0.0
    run: Run | None = None
    path = Path()
    stack: list[str] = []
    text = content.decode("latin-1")
    text = re.sub(r"\((?:\\.|[^\\)])*\)", "(text)", text, flags=re.S)
    for word in text.split():
        if re.fullmatch(r"-?[\d.]+|/\S+|\(text\)|\[.*\]", word):
            stack.append(word)
            continue
        values = [float(part) for part in stack if re.fullmatch(r"-?[\d.]+", part)]
        match word:
            case "cm":
                # The first matrix is the identity; the second makes the millimetre the unit.
                assert values[1:3] == [0, 0]
                assert values[4:] == [0, 0]
                scale *= values[0]
            case "w" | "G" | "g":
                state[word] = values[0]
            case "m" | "l":
                path.starts += word == "m"
                path.corners.append(complex(*values))
            case "c":
                path.along += _cubic(path.corners[-1], values)
                path.corners.append(complex(values[4], values[5]))
            case "h":
                path.closed = True
            case "S" | "f" | "F" | "f*":
                assert word != "f*", "the rule of SVG and Agg is the non-zero one"
                path.filled = word != "S"
                path.width = 0.0 if path.filled else state["w"]
                path.grey = state["g" if path.filled else "G"]
                page.items.append(path)
                path = Path()
            case "Tf":
                em = values[-1]
            case "Tm":
                a, b = values[0], values[1]
                assert abs(hypot(a, b) - 1) < 1e-5
                run = Run(complex(values[4], values[5]), 0.0, phase(complex(a, b)) * 180 / pi)
            case "ET":
                assert run is not None
                run.em = em
                page.items.append(run)
        stack.clear()
    # Within the millionth to which the file writes its numbers.
    assert abs(scale - 72 / 25.4) < 1e-6
    return page


def _cubic(start: complex, values: list[float]) -> list[complex]:
    c1, c2, end = _flat(values), complex(*values[2:4]), complex(*values[4:])
    places = [k / 16 for k in range(17)]
    return [
        start * (1 - t) ** 3 + 3 * c1 * t * (1 - t) ** 2 + 3 * c2 * t**2 * (1 - t) + end * t**3
        for t in places
    ]


def read_dxf(data: bytes) -> Page:
    """Read the model space of a DXF, blocks taken apart; a dashed line is one whole line."""
    import ezdxf

    library: Any = ezdxf
    document = library.read(StringIO(data.decode("utf-8")))
    assert document.units == 4, "millimetres"
    width, height = document.header["$LIMMAX"]
    page = Page(width, height, [])
    for entity in document.modelspace():
        parts = [entity]
        if entity.dxftype() == "INSERT":
            parts = [*entity.virtual_entities(), *entity.attribs]
        elif entity.dxftype() == "DIMENSION":
            inside = entity.virtual_entities()
            parts = [
                p
                for e in inside
                for p in (e.virtual_entities() if e.dxftype() == "INSERT" else [e])
            ]
        for part in parts:
            if part.dxftype() == "ATTDEF" or part.dxf.get("invisible"):
                continue  # the reference has its text
            own = part.dxf.layer
            layer = document.layers.get(entity.dxf.layer if own == "0" else own)
            item = _dxf_item(part)
            if isinstance(item, Path):
                if part.dxftype() == "CIRCLE" and part.dxf.lineweight == 0:
                    continue  # the rim of a disc, for the object snap
                weight = part.dxf.lineweight
                weight = entity.dxf.lineweight if weight == -2 else weight  # that of the block
                item.width = (
                    0.0 if item.filled else (weight if weight >= 0 else layer.dxf.lineweight) / 100
                )
                rgb = part.rgb or layer.rgb or (0, 0, 0)
                item.grey = 1.0 if part.dxftype() == "WIPEOUT" else rgb[0] / 255
            page.items.append(item)
    return page


def _flat(point: Any) -> complex:
    return complex(point[0], point[1])


def _dxf_item(part: Any) -> Path | Run:
    kind, dxf = part.dxftype(), part.dxf
    match kind:
        case "TEXT" | "ATTRIB":
            text = part.plain_text()
            assert dxf.halign == (5 if len(text) > 3 else 0), "fitted, if there is what to fit"
            if dxf.halign:
                way = _flat(dxf.align_point) - _flat(dxf.insert)
                angle = phase(way) * 180 / pi
                assert abs((angle - dxf.rotation + 180) % 360 - 180) < 1e-6
            return Run(_flat(dxf.insert), in_use().em(dxf.height), dxf.rotation, text)
        case "LINE":
            corners = [_flat(dxf.start), _flat(dxf.end)]
            return Path(corners, [], 1)
        case "LWPOLYLINE":
            corners = [complex(x, y) for x, y in part.get_points("xy")]
            return Path(corners, [], 1, part.closed)
        case "CIRCLE" | "ARC":
            start, end = (0.0, 360.0) if kind == "CIRCLE" else (dxf.start_angle, dxf.end_angle)
            turn = radians((end - start) % 360.0 or 360.0)
            along = [
                _flat(dxf.center) + dxf.radius * exp(1j * (radians(start) + turn * k / 64))
                for k in range(65)
            ]
            return Path([], along, 1, kind == "CIRCLE")
        case "SOLID":
            a, b, c, d = (_flat(point) for point in part.vertices())
            return Path([a, b, c, d], [], 1, True, True)
        case "WIPEOUT":
            corners = [_flat(point) for point in part.boundary_path_wcs()]
            if corners[0] == corners[-1]:
                corners.pop()
            return Path(corners, corners if len(corners) > 16 else [], 1, True, True)
        case "HATCH":
            path = Path([], [], len(part.paths), True, True)
            for boundary in part.paths:
                if hasattr(boundary, "vertices"):
                    path.corners += [complex(x, y) for x, y, _ in boundary.vertices]
                    continue
                (arc,) = boundary.edges
                assert arc.end_angle - arc.start_angle == 360.0
                centre = _flat(arc.center)
                path.along += [centre + arc.radius * exp(1j * tau * k / 64) for k in range(65)]
            return path
    raise AssertionError(f"{kind} is not expected")


def turned_box(
    at: complex, angle: float, ink: tuple[float, float, float, float]
) -> tuple[float, float, float, float]:
    """Return the bounds of a box turned about its origin, which is at ``at``."""
    turn = complex(cos(radians(angle)), sin(radians(angle)))
    corners = [at + turn * complex(x, y) for x in ink[::2] for y in ink[1::2]]
    xs, ys = [z.real for z in corners], [z.imag for z in corners]
    return (min(xs), min(ys), max(xs), max(ys))


def texts(items: Iterable[Item]) -> list[Text]:
    """Return the runs of letters among the items of a display list."""
    return [item for item in items if isinstance(item, Text)]
