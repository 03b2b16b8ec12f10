"""Drawings as files: DXF of CAD programs, SVG sheets of planmethod (чтение чертежей)."""

from __future__ import annotations

import logging
import math
import re
from cmath import exp, pi
from collections.abc import Iterable, Iterator
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path
from typing import Any

from lxml import etree
from msgspec import Struct

from planmethod.check.measured.drawing import MeasuredDrawing
from planmethod.check.submissions.cells import SubmissionError, read_bytes
from planmethod.render.backends.canvas import FIGURES, VECTORS, layer_of
from planmethod.render.ink.drawing import Pen

SIZE_LIMIT = 8 * 1024 * 1024
ENTITIES_LIMIT = 200_000
DEPTH_LIMIT = 8
BULGED = 1e-6
"""Minimum bulge of a polyline segment that is an arc."""

MARK_MM = 3.0
"""Radius of the largest circle that marks a point."""

WIDE = 0.6
"""Width of a letter in its heights, where the drawing does not say it."""

GAP = 1.3
"""From one letter of a run to the next, in heights; a word of another inscription is further."""

BY_BLOCK, BY_LAYER = 0, 256
_LETTER = "LETTER_"
_FIT_ALIGNMENT = 5  # alignment of a text between two places
_ARROWS = ("ARROW", "_OPEN", "_CLOSED", "_DOT")


class _Letters(Struct):
    """A run of letters that are adjacent blocks."""

    text: str
    start: complex
    last: complex
    high: float
    direction: complex

    def accepts(self, at: complex, high: float, direction: complex) -> bool:
        """Return whether a letter continues this run."""
        step = (at - self.last) * direction.conjugate()
        tall = max(high, self.high)
        return (
            abs(direction - self.direction) < 1e-3
            and 0.0 < step.real < GAP * tall
            and abs(step.imag) < 0.6 * tall
        )


def read_dxf(path: Path) -> MeasuredDrawing:
    """Return the lines, letters and points of the model space of a DXF file.

    Raises
    ------
    WorksError
        ezdxf is not installed, the file is no DXF, or there is too much in it.
    """
    data = read_bytes(path, SIZE_LIMIT)
    if data.startswith(b"AC10"):
        raise SubmissionError("{}: this is a DWG. Save it as DXF.", path)
    if data.startswith(b"AutoCAD Binary DXF"):
        raise SubmissionError("{}: this is a binary DXF. Save it as an ASCII one.", path)
    if find_spec("ezdxf") is None:
        raise SubmissionError("{}: reading a DXF file requires ezdxf: pip install ezdxf", path)
    return _Reader(path, _document(data, path)).read()


def _document(data: bytes, path: Path) -> Any:
    from ezdxf import recover

    logging.getLogger("ezdxf").addHandler(logging.NullHandler())
    try:
        document, _ = recover.read(BytesIO(data), errors="ignore")
    except Exception as error:  # the library meets whatever a stranger has written
        raise SubmissionError(
            "{}: this is not a readable DXF file: {}.", path, _describe_error(error)
        ) from None
    return document


def _describe_error(error: Exception) -> str:
    return f"{type(error).__name__} {error}".strip()[:80]


class _Reader:
    """Explodes the entities of a document."""

    def __init__(self, path: Path, document: Any) -> None:
        from ezdxf import enums, units

        self.path, self.document = path, document
        code = document.header.get("$INSUNITS", 0)
        self.mm = 1.0
        if isinstance(code, int) and 0 < code <= 20:
            of = enums.InsertUnits
            self.mm = float(units.conversion_factor(of(code), of.Millimeters))
        self.drawing, self.entity_count = MeasuredDrawing(path, self.mm), 0
        self.run: _Letters | None = None

    def read(self) -> MeasuredDrawing:
        """Return the contents of the model space."""
        try:
            for entity in self.document.modelspace():
                self._read_entity(entity, "0", BY_LAYER, 0)
        except SubmissionError:
            raise
        except Exception as error:  # as above: incomplete entities raise many kinds of exception
            raise SubmissionError(
                "{}: this is not a readable DXF file: {}.", self.path, _describe_error(error)
            ) from None
        self._end_run()
        return self.drawing

    def _read_entity(self, entity: Any, layer: str, colour: int, depth: int) -> None:
        self.entity_count += 1
        if self.entity_count > ENTITIES_LIMIT or depth > DEPTH_LIMIT:
            raise SubmissionError(
                "{}: over {} entities, or blocks nested over {} deep. Keep the plans.",
                self.path,
                ENTITIES_LIMIT,
                DEPTH_LIMIT,
            )
        own = entity.dxf.get("layer", "0")
        layer = layer if own == "0" and depth else own
        own_colour = entity.dxf.get("color", BY_LAYER)
        colour = colour if own_colour == BY_BLOCK and depth else own_colour
        kind = entity.dxftype()
        if kind == "INSERT":
            self._insert(entity, layer, colour, depth)
            return
        if kind == "TEXT" and _is_between_places(entity):
            self._piece(entity)
            return
        self._end_run()
        shown = self._colour(layer, colour)
        if kind == "LINE":
            self.drawing.line(map(self._at, (entity.dxf.start, entity.dxf.end)), layer, shown)
        elif kind in ("LWPOLYLINE", "POLYLINE", "LEADER"):
            for corners in _straight(entity):
                self.drawing.line(map(self._at, corners), layer, shown)
        elif kind == "MTEXT":
            self._paragraph(entity)
        elif kind in ("TEXT", "ATTRIB"):
            self._text(entity)
        elif kind == "POINT":
            self.drawing.point(self._at(entity.dxf.location), layer, shown)
        elif kind == "CIRCLE" and entity.dxf.radius * self.mm <= MARK_MM:
            self.drawing.point(self._at(*_in_world(entity, [entity.dxf.center])), layer, shown)

    def _insert(self, insert: Any, layer: str, colour: int, depth: int) -> None:
        name = str(insert.dxf.get("name", ""))
        if name.startswith(_LETTER):
            self._letter(insert, name.removeprefix(_LETTER))
            return
        if any(word in name.upper() for word in _ARROWS):
            return
        for part in insert.virtual_entities():
            self._read_entity(part, layer, colour, depth + 1)
        for attribute in insert.attribs:
            self._read_entity(attribute, layer, colour, depth + 1)

    def _at(self, place: Any) -> complex:
        return complex(place[0], place[1]) * self.mm

    def _colour(self, layer: str, colour: int) -> int:
        if colour != BY_LAYER:
            return int(colour)
        layers = self.document.layers
        return abs(int(layers.get(layer).color)) if layers.has_entry(layer) else 7

    # Letters ---------------------------------------------------------------------------------

    def _text(self, entity: Any) -> None:
        turn = exp(1j * math.radians(float(entity.dxf.get("rotation", 0.0))))
        right, up = _anchor(entity)
        backward, upside_down = (entity.dxf.get("text_generation_flag", 0) & bit for bit in (2, 4))
        aligned = entity.dxf.get("halign", 0) or entity.dxf.get("valign", 0)
        place = entity.dxf.get("align_point", entity.dxf.insert) if aligned else entity.dxf.insert
        high = float(entity.dxf.get("height", 2.5))
        text = entity.plain_text()
        wide = len(text) * high * WIDE * float(entity.dxf.get("width", 1.0) or 1.0)
        away = turn * complex(
            right * wide * (-1 if backward else 1), up * high * (-1 if upside_down else 1)
        )
        (middle,) = _in_world(entity, [(place[0] + away.real, place[1] + away.imag, place[2])])
        self._inscribe(text, self._at(middle), turn, wide * self.mm, high * self.mm)

    def _paragraph(self, entity: Any) -> None:
        """Add an MTEXT; its place and its direction are those of the drawing, not its own."""
        high = float(entity.dxf.get("char_height", 2.5)) * self.mm
        lines = _without_stacks(entity).split("\n")
        wide = max(map(len, lines)) * high * WIDE  # its width is that of the column
        tall = high * (1.6 * len(lines) - 0.6)
        turn = exp(1j * math.radians(float(entity.get_rotation())))
        right, up = _middle_of_text(entity)
        up *= math.copysign(1.0, entity.dxf.get("extrusion", (0, 0, 1))[2])
        middle = self._at(entity.dxf.insert) + turn * complex(right * wide, up * tall)
        self._inscribe("\n".join(lines), middle, turn, wide, tall)

    def _inscribe(
        self, text: str, middle: complex, turn: complex, wide: float, high: float
    ) -> None:
        across = abs(turn.real) * wide + abs(turn.imag) * high
        self.drawing.text(text, middle, across, abs(turn.imag) * wide + abs(turn.real) * high)

    def _letter(self, insert: Any, code: str) -> None:
        try:
            char = chr(int(code, 16))
        except (ValueError, OverflowError):
            return
        at, high = self._at(insert.dxf.insert), abs(float(insert.dxf.xscale)) * self.mm
        direction = exp(1j * math.radians(float(insert.dxf.get("rotation", 0.0))))
        self._join(char, at, at, high, direction)

    def _piece(self, text: Any) -> None:
        """Add a text that is fitted between two places: an inscription has one for each index."""
        ends = _in_world(text, [text.dxf.insert, text.dxf.get("align_point", text.dxf.insert)])
        start, end = map(self._at, ends)
        high = float(text.dxf.get("height", 2.5)) * self.mm
        direction = (end - start) / abs(end - start) if end != start else 1 + 0j
        self._join(text.plain_text(), start, end - direction * WIDE * high, high, direction)

    def _join(
        self, text: str, start: complex, last: complex, high: float, direction: complex
    ) -> None:
        """Add letters, the last of which begins at ``last``, to the run that they continue."""
        run = self.run
        if run is not None and run.accepts(start, high, direction):
            gap = ((start - run.last) * direction.conjugate()).real > 0.95 * max(high, run.high)
            run.text += f" {text}" if gap else text
            run.last = last
            return
        self._end_run()
        self.run = _Letters(text, start, last, high, direction)

    def _end_run(self) -> None:
        run, self.run = self.run, None
        if run is not None:
            end = run.last + run.direction * run.high * WIDE
            middle = (run.start + end) / 2 + run.direction * 0.5j * run.high
            self._inscribe(run.text, middle, run.direction, abs(end - run.start), run.high)


def _is_between_places(text: Any) -> bool:
    """Return whether a text is fitted between two places, or has its end written nevertheless."""
    align, start = text.dxf.get("halign", 0), text.dxf.insert
    end = text.dxf.get("align_point", start)
    # Programs that do not align write zeros or the same place.
    return align == _FIT_ALIGNMENT or (align == 0 and bool(end) and not end.isclose(start))


def _anchor(entity: Any) -> tuple[float, float]:
    """Return where the middle of a text is from its place, in widths and heights."""
    right = {0: 0.5, 1: 0.0, 2: -0.5, 3: 0.0, 4: 0.0, 5: 0.0}.get(entity.dxf.get("halign", 0), 0.5)
    up = {0: 0.5, 1: 0.5, 2: 0.0, 3: -0.5}.get(entity.dxf.get("valign", 0), 0.5)
    return right, 0.0 if entity.dxf.get("halign", 0) == 4 else up


def _middle_of_text(entity: Any) -> tuple[float, float]:
    """Return the same of a text of several lines, by its point of attachment."""
    point = int(entity.dxf.get("attachment_point", 1)) - 1
    return (0.5, 0.0, -0.5)[point % 3], (-0.5, 0.0, 0.5)[min(point // 3, 2) if point >= 0 else 0]


def _in_world(entity: Any, places: Iterable[Any]) -> list[Any]:
    """Return places of an entity's own plane in the drawing: a mirrored one has its x reversed."""
    from ezdxf.math import Vec3

    plane = entity.ocs()
    return [plane.to_wcs(Vec3(place)) for place in places]


_STACK = re.compile(r"(?s)\\S((?:\\.|[^\\;])*+);?")  # one without an end is to the end
_DIVIDED = re.compile(r"[\^/#]")


def _without_stacks(entity: Any) -> str:
    r"""Return the text of an MTEXT: ``s\S^2;`` is s₂, ``a\Sτ^BA;`` has both indices.

    A stack with a line is a fraction. It is replaced before the library decodes the text: there
    ``^2`` is a control character.
    """

    def flat(stack: re.Match[str]) -> str:
        over = "" if "^" in stack[1] else "/"
        return over.join(map(str.strip, _DIVIDED.split(stack[1], maxsplit=1)))

    entity = entity.copy()
    entity.text = _STACK.sub(flat, entity.text)
    return str(entity.plain_text())


def _straight(entity: Any) -> Iterator[list[Any]]:
    """Yield the straight runs of corners of a polyline."""
    if entity.dxftype() == "LEADER":
        yield list(entity.vertices)
        return
    if entity.dxftype() == "LWPOLYLINE":
        told = [((x, y), bulge) for x, y, _, _, bulge in entity.get_points()]
        closed = entity.closed
    elif entity.is_2d_polyline or entity.is_3d_polyline:
        told = [(v.dxf.location, v.dxf.get("bulge", 0.0)) for v in entity.vertices]
        closed = entity.is_closed
    else:
        return
    if entity.dxftype() != "POLYLINE" or entity.is_2d_polyline:
        world = _in_world(entity, (corner for corner, _ in told))
        told = [(corner, bulge) for corner, (_, bulge) in zip(world, told, strict=True)]
    run: list[Any] = []
    for corner, bulge in [*told, *(told[:1] if closed else ())]:
        run.append(corner)
        if abs(bulge) > BULGED:
            yield run
            run = []
    yield run


TIP_MM = 8.0
"""Maximum gap between the end of a thick line and the tip of its arrow, mm."""

CAPITAL = 0.7
"""Height of the letters of a text, a share of the size of its font."""


_SVG = "{http://www.w3.org/2000/svg}"
_STEP = re.compile(r"([A-Za-z])|(-?(?:\d+\.?\d*|\.\d+)(?:e-?\d+)?)")
_TURN = re.compile(r"rotate\((-?[\d.]+) ")


def read_svg(path: Path) -> MeasuredDrawing:
    """Return the vectors and letters of one of our own sheets.

    Raises
    ------
    WorksError
        It is not an SVG, or not from planmethod.
    """
    data = read_bytes(path, SIZE_LIMIT)
    parser = etree.XMLParser(resolve_entities=False, no_network=True, huge_tree=False)
    try:
        root = etree.fromstring(data, parser)
    except etree.XMLSyntaxError as error:
        raise SubmissionError("{}: this is not an SVG file: {}.", path, str(error)[:80]) from None
    if root.tag != f"{_SVG}svg" or not str(root.get("height", "")).endswith("mm"):
        raise SubmissionError("{}: this is not an SVG sheet of planmethod. Save it as DXF.", path)
    drawing = MeasuredDrawing(path)
    try:
        _read_elements(root, drawing)
    except ValueError as error:
        raise SubmissionError("{}: this is not an SVG file: {}.", path, str(error)[:80]) from None
    return drawing


def _read_elements(root: Any, drawing: MeasuredDrawing) -> None:
    held: tuple[str, list[complex]] | None = None
    for element in root.iter(f"{_SVG}path", f"{_SVG}text"):
        if element.tag == f"{_SVG}text":
            _text(element, drawing)
            continue
        tag = element.get("data-tag", "")
        layer = layer_of(tag, Pen.THIN)
        if layer not in (VECTORS, FIGURES):
            continue
        corners = list(_corners(element.get("d", "")))
        if str(element.getparent().get("class", "")).startswith("ink-"):
            if held is not None and corners and held[0] == tag:
                held = (tag, _to_tip(held[1], corners[0]))
            continue
        if held is not None:
            drawing.line(held[1], layer_of(held[0], Pen.THIN), 0)
        held = tag, corners
    if held is not None:
        drawing.line(held[1], layer_of(held[0], Pen.THIN), 0)


def _to_tip(corners: list[complex], tip: complex) -> list[complex]:
    """Return a line up to the tip of its arrow."""
    near = len(corners) == 2 and abs(tip - corners[-1]) < TIP_MM
    return [corners[0], tip] if near else corners


def _corners(data: str) -> Iterator[complex]:
    """Yield the corners of a path of straight lines, y up; none from where it bends."""
    command, numbers, at, start = "", list[float](), 0j, 0j
    for step in _STEP.finditer(data):
        if step[1]:
            command = step[1]
            if command in "Zz":
                yield start.conjugate()
            elif command not in "MmLl":
                return
            continue
        numbers.append(float(step[2]))
        if len(numbers) == 2:
            to = complex(*numbers)
            at = at + to if command in "ml" else to
            if command in "Mm":
                start = at
                command = "l" if command == "m" else "L"
            numbers.clear()
            yield at.conjugate()


def _text(element: Any, drawing: MeasuredDrawing) -> None:
    text = element.text or ""
    size = float(element.get("font-size") or element.getparent().get("font-size") or 5.0)
    high = CAPITAL * size
    wide = float(element.get("textLength") or WIDE * high * len(text))
    turned = _TURN.match(element.get("transform") or "")
    direction = exp(-1j * float(turned[1]) * pi / 180.0) if turned else 1.0 + 0j
    corner = complex(float(element.get("x", 0)), -float(element.get("y", 0)))
    across = abs(direction.real) * wide + abs(direction.imag) * high
    tall = abs(direction.imag) * wide + abs(direction.real) * high
    drawing.text(text, corner + direction * complex(wide / 2, high / 2), across, tall)
