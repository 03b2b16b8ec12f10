"""DXF (R2010) for CAD programs: one drawing unit is one millimetre of paper, y up.

Everything a draughtsman would pick is one entity: a side of a plan is a line from end to end, a
dashed line is whole and its line type dashes it, a joint and an arrowhead are blocks. The meaning
of an item is its layer, and its width, dashes and grey are those of the layer wherever they can be.
"""

from __future__ import annotations

import re
from cmath import exp, phase
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from io import StringIO
from itertools import pairwise
from math import acos, atan, ceil, degrees, pi, radians, tau
from types import MappingProxyType
from typing import Any

import ezdxf
from ezdxf.enums import TextEntityAlignment
from ezdxf.lldxf.const import VALID_DXF_LINEWEIGHTS
from ezdxf.math import global_bspline_interpolation

from planmethod.render.backends.canvas import (
    ARROWS,
    LAYERS,
    VECTORS,
    Canvas,
    Options,
    layer_of,
    layer_of_area,
    layer_of_text,
)
from planmethod.render.ink.drawing import (
    Arc,
    Disc,
    Drawing,
    Fill,
    Ink,
    Pen,
    Stroke,
    Text,
    sweep,
)
from planmethod.render.ink.lettering import OutlineLettering
from planmethod.render.ink.pens import ARROW, PENS, PenSet
from planmethod.render.ink.typeset import PART_OF

_LIBRARY: Any = ezdxf  # its types are of the parts only

# LibreCAD takes the font that is called as the style, and this one of its own has Russian and Greek
# letters; others take the font of the style, the one of CAD programs that is nearest GOST 2.304.
TEXT_STYLE, FONT = "lc_opengost-br", "isocpeur.ttf"
FORM = "TITLE_BLOCK"

# Standard names with the dashes of GOST 2.303: LibreCAD goes by the name, and draws whole what it
# does not know; AutoCAD goes by the pattern.
LINE_TYPES: Mapping[Pen, str] = MappingProxyType(
    {
        Pen.AXIS: "CENTER",
        Pen.THICK_AXIS: "DASHDOT",
        Pen.PHANTOM: "DIVIDE",
        Pen.HIDDEN: "DASHED",
    }
)

_TOLERANCE = 2e-3  # mm: how far a polygon may leave the curve that it replaces
_BY_BLOCK = -2  # line weight that is inherited from the block
_SMOOTH = radians(20.0)
_DEGREE = 3  # of splines
_NOT_TEXT = "[\x00-\x1f\x7f-\x9f]"


def _nearest_weight(width: float) -> int:
    return min(VALID_DXF_LINEWEIGHTS, key=lambda weight: abs(weight - width * 100.0))


def _true_colour(colour: tuple[int, int, int]) -> int:
    return int.from_bytes(bytes(colour), "big")


def _escaped(text: str) -> str:
    """Return a text that a CAD program shows unchanged: control codes are escaped."""
    return _clean(text).replace("^", "^ ").replace("%%", "%%%%%%")


def _coded(text: str) -> str:
    """Return a text of several heights that is shown unchanged: control codes are escaped."""
    return re.sub(r"([\\{}])", r"\\\1", _clean(text)).replace("^", "^ ")


def _stacked(text: str) -> str:
    """Return an index whose stack separators are escaped as letters."""
    return re.sub(r"([#/;])", r"\\\1", _coded(text))


def _clean(text: str) -> str:
    return re.sub(_NOT_TEXT, "�", text)


@contextmanager
def _no_clock() -> Iterator[None]:
    """Make the library's output free of time and chance: same drawing, same bytes."""
    options = _LIBRARY.options
    before = options.write_fixed_meta_data_for_testing
    options.write_fixed_meta_data_for_testing = True
    try:
        yield
    finally:
        options.write_fixed_meta_data_for_testing = before


class DxfCanvas(Canvas):
    """Canvas that writes DXF."""

    def __init__(self, options: Options) -> None:
        self._author = options.author
        self._stroked = options.dxf_text == "strokes"
        self._document: Any = None
        self._space: Any = None
        self._lettering: OutlineLettering
        self._pens: PenSet
        # An item whose meaning depends on the next one: the shaft of an arrow, the inside of a
        # joint.
        self._pending: Stroke | Disc | None = None
        self._runs: list[Text] = []  # of one turned inscription
        self._form: Any = None  # the block of the title block
        self._fields: Any = None  # the reference to it, which has the texts of its graphs
        self._groups: dict[str, list[Any]] = {}  # parts of inscriptions by label
        self._slant = 0.0  # degrees from upright
        self._is_drawing_size = False
        self._sizes: dict[str, list[Stroke | Fill | Text]] = {}  # parts of dimensions by tag

    def open(self, drawing: Drawing) -> None:
        """Begin a sheet: layers, line types and the text style."""
        with _no_clock():
            document = _LIBRARY.new("R2010", units=4)  # millimetres
        width, height = drawing.width, drawing.height
        self._document = document
        self._lettering = drawing.lettering
        self._pens = drawing.pens
        self._space = document.modelspace()
        header = document.header
        header["$LTSCALE"] = 1.0
        header["$LWDISPLAY"] = 1
        header["$EXTMIN"], header["$EXTMAX"] = (0.0, 0.0, 0.0), (width, height, 0.0)
        self._space.reset_extents((0.0, 0.0, 0.0), (width, height, 0.0))
        self._space.reset_limits((0.0, 0.0), (width, height))
        header.custom_vars.append("Title", _clean(drawing.title))
        header.custom_vars.append("Author", _clean(self._author))
        middle = (width / 2, height / 2)
        document.set_modelspace_vport(height * 1.05, center=middle)
        # The default printed area: the whole sheet, 1:1.
        header["$PSVPSCALE"] = 1.0
        paper = document.paperspace()
        paper.page_setup(size=(width, height), scale=(1, 1))
        paper.reset_extents((0.0, 0.0, 0.0), (width, height, 0.0))
        paper.reset_limits((0.0, 0.0), (width, height))
        window = paper.add_viewport(middle, (width, height), middle, height)
        for viewport in (paper.main_viewport(), window):
            viewport.dxf.layer = "Defpoints"  # its lines are never printed
        document.set_wipeout_variables(frame=0)
        # Otherwise the library adds them in the order of a set, which differs between processes.
        for name in ("ACDBPLACEHOLDER", "LAYOUT", "WIPEOUT", "WIPEOUTVARIABLES"):
            document.classes.add_class(name)
        for pen, name in LINE_TYPES.items():
            dashes = PENS[pen].dashes
            assert dashes is not None
            whole = dashes.stroke + dashes.gap
            document.linetypes.add(name, [whole, *dashes.period], description="GOST 2.303")
        for name, pen in LAYERS.items():
            layer = document.layers.add(
                name,
                color=7,
                lineweight=_nearest_weight(self._pens.width(pen)),
                linetype=LINE_TYPES.get(pen, "Continuous"),
            )
            if any(colour := self._pens.colour(pen)):
                layer.dxf.true_color = _true_colour(colour)
        self._slant = degrees(atan(drawing.lettering.style.lean))
        document.styles.add(TEXT_STYLE, font=FONT).dxf.oblique = self._slant

    # Attributes -----------------------------------------------------------------------------------

    def _by_layer(self, layer: str, pen: Pen) -> dict[str, Any]:
        """Return the attributes of a line: only those that differ from its layer's."""
        own: dict[str, Any] = {"layer": layer}
        return {**own, **self._list_overrides(LAYERS[layer], pen)}

    def _list_overrides(self, layer_pen: Pen, pen: Pen) -> dict[str, Any]:
        """Return the attributes that a line of ``pen`` needs on a layer with that of another."""
        said: dict[str, Any] = {}
        weight = _nearest_weight(self._pens.width(pen))
        if weight != _nearest_weight(self._pens.width(layer_pen)):
            said["lineweight"] = weight
        if LINE_TYPES.get(pen) != LINE_TYPES.get(layer_pen):
            said["linetype"] = LINE_TYPES.get(pen, "Continuous")
        if (colour := self._pens.colour(pen)) != self._pens.colour(layer_pen):
            said["true_color"] = _true_colour(colour)
        return said

    # Verbs ----------------------------------------------------------------------------------------

    def stroke(self, item: Stroke) -> None:
        """Draw a line or polyline, once the next item shows whether it is an arrow's shaft."""
        self._flush()
        if self._is_of_size(item.tag, item):
            return
        if PENS[item.pen].dashes and len(set(item.points)) < 2:
            return
        if len(item.points) == 2 and not item.closed and PENS[item.pen].dashes is None:
            self._pending = item
        else:
            self._line(item)

    def arc(self, item: Arc) -> None:
        """Draw a circle or an arc; a circle around its own white inside is a joint."""
        turn = sweep(item)
        if turn <= 0.0:
            return
        held = self._pending
        if (
            isinstance(held, Disc)
            and turn >= tau
            and held.centre == item.centre
            and held.radius == item.radius
        ):
            self._pending = None
            name = self._joint(item.radius, item.pen)
            place = (item.centre.real, item.centre.imag)
            self._space.add_blockref(name, place, dxfattribs={"layer": "SYMBOLS"})
            return
        self._flush()
        _add_arc(self._space, item, turn, self._by_layer(layer_of(item.tag, item.pen), item.pen))

    def fill(self, item: Fill | Disc) -> None:
        """Fill an area: an arrowhead as a block, white as a wipeout, else as a solid hatch."""
        if isinstance(item, Fill) and self._is_of_size(item.tag, item):
            return
        if isinstance(item, Fill) and item.ink is Ink.BLACK and (head := _arrowhead(item.points)):
            self._arrow(item, *head)
            return
        self._flush()
        if isinstance(item, Disc) and item.ink is Ink.WHITE:
            self._pending = item
        elif item.ink is Ink.WHITE:
            assert isinstance(item, Fill)
            self._mask(item.points)
        else:
            layer = layer_of_area(item.tag)
            hatch = self._space.add_hatch(color=256, dxfattribs={"layer": layer})
            if isinstance(item, Disc):
                x, y = item.centre.real, item.centre.imag
                hatch.paths.add_edge_path().add_arc((x, y), item.radius, 0.0, 360.0)
                # A target for the object snap.
                thin = {"layer": layer, "lineweight": 0}
                self._space.add_circle((x, y), item.radius, dxfattribs=thin)
            else:
                hatch.paths.add_polyline_path(_pairs(item.points), is_closed=True)

    def text(self, item: Text) -> None:
        """Draw a run of letters: as text fitted to its width, or as outlines.

        A turned inscription, as that of a dimension, is one text with its indices: moved or turned
        in a CAD program it stays whole.
        """
        if item.label in self._sizes:
            self._sizes[item.label].append(item)
            return
        if not self._runs or item.label != self._runs[0].label:
            self._flush()
        if not self._stroked and item.label and item.angle % 360.0:
            self._runs.append(item)
        else:
            self._run(item)

    def _run(self, item: Text) -> None:
        layer = layer_of_text(item.tag)
        along = exp(1j * radians(item.angle))
        if self._stroked:
            unit = item.height / self._lettering.cap_height
            pen = _nearest_weight(item.height * self._lettering.line)
            for char, start in self._lettering.places(item.text):
                name = self._letter(char)
                if name:
                    at = item.at + along * start * unit
                    self._space.add_blockref(
                        name,
                        (at.real, at.imag),
                        dxfattribs={
                            "layer": layer,
                            "lineweight": pen,
                            "xscale": item.height,
                            "yscale": item.height,
                            "zscale": item.height,
                            "rotation": item.angle,
                        },
                    )
            return
        bare = item.text.strip()
        lead = len(item.text) - len(item.text.lstrip())
        at = item.at + along * self._lettering.width(item.text[:lead], item.height)
        end = at + along * self._lettering.width(bare, item.height)
        said = {
            "height": item.height, "layer": layer, "style": TEXT_STYLE, "oblique": self._slant,
        }  # fmt: skip

        def place(text: Any) -> Any:
            # Fitted: with another font the run keeps its length.
            ends = (at.real, at.imag), (end.real, end.imag)
            text.set_placement(*ends, align=TextEntityAlignment.FIT)
            text.dxf.rotation = item.angle % 360.0
            return text

        first, _, field = item.tag.partition(" ")
        if first != "stamp":
            made = place(self._space.add_text(_escaped(bare), dxfattribs=said))
            if not self._is_drawing_size:
                self._groups.setdefault(item.label, []).append(made)
        elif not field or field == "margin":
            place(self._title_block().add_text(_escaped(bare), dxfattribs=said))
        else:
            name = field.replace(" ", "_").upper()
            count = sum(one.dxf.tag.split(".")[0] == name for one in self._title_block_fields())
            name += f".{count + 1}" if count else ""  # a text of several lines
            place(self._title_block().add_attdef(name, text="", dxfattribs=said))
            place(self._fields.add_attrib(name, _escaped(bare), dxfattribs=said))

    def _title_block(self) -> Any:
        """Return the block of the title block; the first part of it also places the block."""
        if self._form is None:
            self._form = self._document.blocks.new(FORM)
            self._fields = self._space.add_blockref(FORM, (0.0, 0.0), dxfattribs={"layer": FORM})
        return self._form

    def _title_block_fields(self) -> list[Any]:
        self._title_block()
        return list(self._fields.attribs)

    def close(self) -> bytes:
        """Return the file, the same bytes for the same drawing."""
        self._flush()
        sizes, self._sizes = self._sizes, {}
        for items in sizes.values():
            self._dimension(items)
        for parts in self._groups.values():
            if len(parts) > 1:  # letters with indices are picked together
                self._document.groups.new().extend(parts)
        stream = StringIO()
        with _no_clock():
            self._document.write(stream)
        return stream.getvalue().encode("utf-8", errors="replace")

    # Parts ----------------------------------------------------------------------------------------

    def _flush(self) -> None:
        """Draw the held item on its own, and the runs of a turned inscription."""
        runs, self._runs = self._runs, []
        if len(runs) > 1:
            self._inscription(runs)
        elif runs:
            self._run(runs[0])
        held, self._pending = self._pending, None
        if isinstance(held, Stroke):
            self._line(held)
        elif isinstance(held, Disc):
            self._mask(_circle(held.centre, held.radius))

    def _inscription(self, runs: Sequence[Text]) -> None:
        """Draw the runs of one inscription as a text of several heights."""
        whole, turn = max(runs, key=lambda run: run.height), exp(1j * radians(runs[0].angle))
        phrase = ""
        for run in runs:
            if run.height == whole.height:
                phrase += _coded(run.text)
                continue
            is_above = ((run.at - whole.at) / turn).imag > 0.0
            index = f"{_stacked(run.text)}^ " if is_above else f"^ {_stacked(run.text)}"
            phrase += f"{{\\H{run.height / whole.height:.3g}x;\\S{index};}}"
        start = min(runs, key=lambda run: (run.at / turn).real)
        base = ((whole.at - start.at) / turn).imag  # an index may come first
        at = start.at + (base + whole.height) * 1j * turn  # the upper left corner of the capitals
        self._space.add_mtext(
            phrase,
            dxfattribs={
                "layer": layer_of_text(whole.tag),
                "style": TEXT_STYLE,
                "char_height": whole.height,
                "insert": (at.real, at.imag),
                "attachment_point": 1,
                "rotation": whole.angle % 360.0,
            },
        )

    def _is_of_size(self, tag: str, item: Stroke | Fill) -> bool:
        """Return whether an item is a part of a dimension, which is drawn when it is whole."""
        if self._is_drawing_size or self._stroked or not tag.startswith("size "):
            return False
        self._sizes.setdefault(tag, []).append(item)
        return True

    def _dimension(self, items: Sequence[Stroke | Fill | Text]) -> None:
        """Draw a linear dimension; its block has the lines, heads and letters of the sheet."""
        tips = [item.points[0] for item in items if isinstance(item, Fill)]
        line, *sides = (item for item in items if isinstance(item, Stroke))
        letters = [item for item in items if isinstance(item, Text)]
        feet = [side.points[0] for side in sides]
        space, block = self._space, self._document.blocks.new_anonymous_block(type_char="D")
        self._space, self._is_drawing_size = block, True
        for item in items:
            match item:
                case Stroke():
                    self.stroke(item)
                case Fill():
                    self.fill(item)
                case Text():
                    self._flush()
                    self._run(item)
        self._flush()
        self._space, self._is_drawing_size = space, False
        start, foot, other = _pairs((tips[1], feet[0], feet[1]))
        middle = letters[0].at if letters else sum(tips) / len(tips)
        space.new_entity("DIMENSION", {
            "layer": "THIN", "geometry": block.name, "dimstyle": "Standard", "dimtype": 32,
            "defpoint": start, "defpoint2": foot, "defpoint3": other,
            "text_midpoint": (middle.real, middle.imag), "text": "".join(t.text for t in letters),
            "angle": degrees(phase(line.points[-1] - line.points[0])) % 180.0,
        })  # fmt: skip

    def _mask(self, outline: Sequence[complex]) -> None:
        """Hide what lies under an area, whatever the colour of the screen."""
        self._space.add_wipeout(_pairs(outline)).dxf.layer = "MASKS"

    def _line(self, item: Stroke) -> None:
        attributes = self._by_layer(layer_of(item.tag, item.pen), item.pen)
        is_form = not self._stroked and item.tag.startswith("stamp")
        space = self._title_block() if is_form else self._space
        if len(item.points) == 2 and item.points[0] != item.points[1]:
            (a, b) = _pairs(item.points)
            line = space.add_line(a, b, dxfattribs=attributes)
            if item.tag.startswith(PART_OF) and not self._stroked:
                self._groups.setdefault(item.tag.removeprefix(PART_OF), []).append(line)
            return
        if item.smooth and len(item.points) > _DEGREE:
            curve = global_bspline_interpolation(_pairs(item.points), _DEGREE)
            self._space.add_spline(dxfattribs=attributes).apply_construction_tool(curve)
            return
        if PENS[item.pen].dashes and _is_smooth(item.points):
            attributes["flags"] = 128  # the line type runs on through the corners
        space.add_lwpolyline(_pairs(item.points), close=item.closed, dxfattribs=attributes)

    def _arrow(
        self, item: Fill, tip: complex, direction: complex, length: float, wide: float
    ) -> None:
        """Draw an arrowhead, and the shaft that was held for it up to the very tip."""
        held = self._pending
        layer = layer_of_area(item.tag)
        if (
            isinstance(held, Stroke)
            and held.tag == item.tag
            and _leads(held, tip, direction, length)
        ):
            self._pending = None
            start, stop = held.points
            line = layer_of(held.tag, held.pen)
            pen = held.pen
            if line == VECTORS and self._pens.width(pen) > self._pens.width(Pen.THIN):
                # A thick line would blunt the tip that it must reach: its thickness is a body.
                side = direction * 1j * self._pens.width(pen) / 2.0
                corners = (start + side, start - side, stop + side, stop - side)
                self._space.add_solid(_pairs(corners), dxfattribs={"layer": ARROWS})
                pen = Pen.THIN
            end = tip if line == VECTORS else stop
            (a, b) = _pairs((start, end))
            self._space.add_line(a, b, dxfattribs=self._by_layer(line, pen))
        self._flush()
        name = "ARROWHEAD"
        if name not in self._document.blocks:
            block = self._document.blocks.new(name)
            notch = 1.0 - ARROW.notch
            outline = ((0.0, 0.0), (-1.0, 0.5), (-notch, 0.0), (-1.0, -0.5))
            block.add_hatch(color=256).paths.add_polyline_path(outline, is_closed=True)
        self._space.add_blockref(
            name,
            (tip.real, tip.imag),
            dxfattribs={
                "layer": layer,
                "xscale": length,
                "yscale": wide,
                "rotation": degrees(phase(direction)),
            },
        )

    def _joint(self, radius: float, pen: Pen) -> str:
        """Return the block of a revolute pair: an opaque circle."""
        name = f"JOINT_{radius:.6g}_{layer_of('', pen)}"
        if name not in self._document.blocks:
            block = self._document.blocks.new(name)
            block.add_wipeout(_pairs(_circle(0j, radius)))
            _add_arc(block, Arc(0j, radius), tau, self._list_overrides(LAYERS["SYMBOLS"], pen))
        return name

    def _letter(self, char: str) -> str:
        """Return the block of a letter with h = 1, or nothing for a blank.

        Its lines are as thick as the reference says: line weights do not grow with a block.
        """
        name = "LETTER_NONE" if self._lettering.missing(char) else f"LETTER_{ord(char):04X}"
        strokes = self._lettering.strokes(char)
        if strokes and name not in self._document.blocks:
            block = self._document.blocks.new(name)
            for line in strokes:
                block.add_lwpolyline(_pairs(line), dxfattribs={"lineweight": _BY_BLOCK})
        return name if strokes else ""


def _pairs(points: Iterable[complex]) -> list[tuple[float, float]]:
    return [(point.real, point.imag) for point in points]


def _add_arc(space: Any, item: Arc, turn: float, attributes: dict[str, Any]) -> None:
    centre = (item.centre.real, item.centre.imag)
    if turn >= tau:
        space.add_circle(centre, item.radius, dxfattribs=attributes)
    else:
        ends = degrees(item.start) % 360.0, degrees(item.start + turn) % 360.0
        space.add_arc(centre, item.radius, *ends, dxfattribs=attributes)


def _circle(centre: complex, radius: float) -> list[complex]:
    count = max(24, ceil(pi / acos(max(0.0, 1.0 - _TOLERANCE / radius))))
    return [centre + radius * exp(1j * tau * k / count) for k in range(count)]


def _is_smooth(points: Sequence[complex]) -> bool:
    steps = [b - a for a, b in pairwise(points) if a != b]
    return all(abs(phase(after / before)) < _SMOOTH for before, after in pairwise(steps))


def _arrowhead(points: Sequence[complex]) -> tuple[complex, complex, float, float] | None:
    """Return tip, direction, length and width if the polygon is an arrowhead, else None."""
    if len(points) != 4:
        return None
    tip, left, notch, right = points
    middle = (left + right) / 2.0
    length, width = abs(tip - middle), abs(left - right)
    if length < 1e-6 or width < 1e-6:
        return None
    along = (tip - middle) / length
    straight = abs(left - middle - along * 1j * width / 2.0)
    cut = abs(tip - along * length * (1.0 - ARROW.notch) - notch)
    return (tip, along, length, width) if max(straight, cut) < 1e-6 else None


def _leads(shaft: Stroke, tip: complex, direction: complex, length: float) -> bool:
    """Return whether a line runs into the arrowhead that ends at ``tip``."""
    start, stop = shaft.points
    ahead = [(tip - point) / direction for point in (start, stop)]
    return all(abs(way.imag) < 1e-6 for way in ahead) and (
        ahead[0].real > ahead[1].real and 0.0 <= ahead[1].real <= length
    )
