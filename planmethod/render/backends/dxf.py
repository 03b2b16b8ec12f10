"""DXF (R2010) for CAD programs: one drawing unit is one millimetre of paper, y up.

Everything a draughtsman would pick is one entity: a side of a plan is a line from end to end, a
dashed line is whole and its line type dashes it, a joint and an arrowhead are blocks. The meaning
of an item is its layer, and its width, dashes and grey are those of the layer wherever they can be.
"""

from __future__ import annotations

from cmath import exp, phase
from collections.abc import Sequence
from io import StringIO
from math import degrees, radians, tau
from typing import Any

from ezdxf.enums import TextEntityAlignment
from ezdxf.math import global_bspline_interpolation

from planmethod.render.backends.canvas import (
    VECTORS,
    Canvas,
    Options,
    coloured_layer,
    layer_of,
    layer_of_area,
    layer_of_text,
)
from planmethod.render.backends.dxf_document import (
    LINE_TYPES,
    TEXT_STYLE,
    colour_of_layer,
    nearest_weight,
    new_document,
    pen_of_layer,
    slant_of,
    true_colour,
    without_clock,
)
from planmethod.render.backends.dxf_shapes import (
    Dimension,
    add_arc,
    arrowhead_of,
    circle,
    is_smooth,
    leads,
    pairs,
)
from planmethod.render.backends.dxf_texts import escaped, phrase_of
from planmethod.render.frame import STAMP
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
from planmethod.render.ink.lettering import OutlineLettering, lettering_of
from planmethod.render.ink.pens import ARROW, PENS, PenSet
from planmethod.render.ink.typeset import PART_OF
from planmethod.render.symbols import DIMENSION

FORM = "TITLE_BLOCK"

OF_DIMENSION = f"{DIMENSION} "

_BY_BLOCK = -2  # line weight that is inherited from the block
_DEGREE = 3  # of splines
_SHORTEST_FITTED = 4  # letters of a run that is fitted to its length


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
        self._is_drawing_dimension = False
        self._dimensions: list[Dimension] = []  # as they are begun

    def open(self, drawing: Drawing) -> None:
        """Begin a sheet: layers, line types and the text style."""
        self._document = new_document(drawing, self._author)
        self._lettering, self._pens = drawing.lettering, drawing.pens
        self._slant = slant_of(drawing)
        self._space = self._document.modelspace()

    # Attributes -----------------------------------------------------------------------------------

    def _layer_of(self, tag: str, pen: Pen) -> str:
        """Return the layer of a line; on a sheet in colour, vectors of each colour have theirs."""
        layer = layer_of(tag, pen)
        return coloured_layer(layer, pen) if self._pens.is_coloured else layer

    def _by_layer(self, layer: str, pen: Pen, colour_of: Pen | None = None) -> dict[str, Any]:
        """Return the attributes of a line: only those that differ from its layer's.

        ``colour_of`` is the pen whose colour it has. Default: its own.
        """
        own: dict[str, Any] = {"layer": layer}
        return {
            **own,
            **self._list_overrides(pen_of_layer(layer), pen),
            **self._own_colour(layer, colour_of or pen),
        }

    def _list_overrides(self, layer_pen: Pen, pen: Pen) -> dict[str, Any]:
        """Return width and dashes that a line of ``pen`` needs on a layer with another pen."""
        said: dict[str, Any] = {}
        weight = nearest_weight(self._pens.width(pen))
        if weight != nearest_weight(self._pens.width(layer_pen)):
            said["lineweight"] = weight
        if LINE_TYPES.get(pen) != LINE_TYPES.get(layer_pen):
            said["linetype"] = LINE_TYPES.get(pen, "Continuous")
        return said

    def _own_colour(self, layer: str, pen: Pen) -> dict[str, int]:
        """Return the colour of ``pen`` as an attribute, unless the layer has it."""
        colour = self._pens.colour(pen)
        has_it = colour == colour_of_layer(layer, self._pens)
        return {} if has_it else {"true_color": true_colour(colour)}

    # Verbs ----------------------------------------------------------------------------------------

    def stroke(self, item: Stroke) -> None:
        """Draw a line or polyline, once the next item shows whether it is an arrow's shaft."""
        self._flush()
        if self._is_of_dimension(item):
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
        if turn <= 0.0 or self._is_of_dimension(item):
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
        add_arc(
            self._space, item, turn, self._by_layer(self._layer_of(item.tag, item.pen), item.pen)
        )

    def fill(self, item: Fill | Disc) -> None:
        """Fill an area: an arrowhead as a block, white as a wipeout, else as a solid hatch."""
        if isinstance(item, Fill) and self._is_of_dimension(item):
            return
        if isinstance(item, Fill) and item.ink is Ink.BLACK and (head := arrowhead_of(item.points)):
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
                hatch.paths.add_polyline_path(pairs(item.points), is_closed=True)

    def text(self, item: Text) -> None:
        """Draw a run of letters: as text fitted to its width, or as outlines.

        A turned inscription, as that of a dimension, is one text with its indices: moved or turned
        in a CAD program it stays whole.
        """
        if (named := self._dimension_of(item)) is not None:
            named.letters.append(item)
            return
        if not self._runs or item.label != self._runs[0].label:
            self._flush()
        if not self._stroked and item.label and item.angle % 360.0 and self._is_in_model(item):
            self._runs.append(item)
        else:
            self._run(item)

    def _is_in_model(self, item: Text) -> bool:
        return not self._is_drawing_dimension and not item.tag.startswith(STAMP)

    def _run(self, item: Text) -> None:
        layer = layer_of_text(item.tag)
        along = exp(1j * radians(item.angle))
        lettering = lettering_of(item.lettering, self._lettering)
        if self._stroked:
            unit = item.height / lettering.cap_height
            pen = nearest_weight(item.height * lettering.line)
            for char, start in lettering.places(item.text):
                name = self._letter(char, item.lettering)
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
        at = item.at + along * lettering.width(item.text[:lead], item.height)
        end = at + along * lettering.width(bare, item.height)
        said = {
            "height": item.height, "layer": layer, "style": TEXT_STYLE, "oblique": self._slant,
            "lineweight": nearest_weight(item.height * lettering.line),
        }  # fmt: skip

        def place(text: Any) -> Any:
            # Fitted: with another font the run keeps its length. LibreCAD stretches the white of
            # its letters, too, which distorts a run of few.
            ends = (at.real, at.imag), (end.real, end.imag)
            text.set_placement(*ends, align=TextEntityAlignment.FIT)
            if len(bare) < _SHORTEST_FITTED:
                text.dxf.halign = 0  # the end stays written, for those who read the runs
            text.dxf.rotation = item.angle % 360.0
            return text

        first, _, field = item.tag.partition(" ")
        if first != STAMP:
            made = place(self._space.add_text(escaped(bare), dxfattribs=said))
            if not self._is_drawing_dimension:
                self._groups.setdefault(item.label, []).append(made)
        elif not field or field == "margin":
            place(self._title_block().add_text(escaped(bare), dxfattribs=said))
        else:
            name = field.replace(" ", "_").upper()
            count = sum(one.dxf.tag.split(".")[0] == name for one in self._title_block_fields())
            name += f".{count + 1}" if count else ""  # a text of several lines
            place(self._title_block().add_attdef(name, text="", dxfattribs=said))
            place(self._fields.add_attrib(name, escaped(bare), dxfattribs=said))
            # LibreCAD reads no attributes, and shows what others hide: this copy of the text.
            hidden = {**said, "invisible": 1}
            place(self._title_block().add_text(escaped(bare), dxfattribs=hidden))

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
        for one in self._dimensions:
            self._dimension(one)
        for parts in self._groups.values():
            if len(parts) > 1:  # letters with indices are picked together
                self._document.groups.new().extend(parts)
        stream = StringIO()
        with without_clock():
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
            self._mask(circle(held.centre, held.radius))

    def _inscription(self, runs: Sequence[Text]) -> None:
        """Draw the runs of one inscription as a text of several heights."""
        whole, turn = max(runs, key=lambda run: run.height), exp(1j * radians(runs[0].angle))
        start = min(runs, key=lambda run: (run.at / turn).real)
        base = ((whole.at - start.at) / turn).imag  # an index may come first
        at = start.at + (base + whole.height) * 1j * turn  # the upper left corner of the capitals
        made = self._space.add_mtext(
            phrase_of(runs),
            dxfattribs={
                "lineweight": nearest_weight(whole.height * self._lettering.line),
                "layer": layer_of_text(whole.tag),
                "style": TEXT_STYLE,
                "char_height": whole.height,
                "insert": (at.real, at.imag),
                "attachment_point": 1,
                "rotation": whole.angle % 360.0,
            },
        )
        self._groups.setdefault(whole.label, []).append(made)

    def _is_of_dimension(self, item: Stroke | Arc | Fill) -> bool:
        """Return whether an item is a part of a dimension, which is drawn when it is whole."""
        if self._is_drawing_dimension or self._stroked or not item.tag.startswith(OF_DIMENSION):
            return False
        last = self._dimensions[-1] if self._dimensions else None
        if last is None or last.tag != item.tag or last.letters:
            self._dimensions.append(last := Dimension(item.tag))
        last.lines.append(item)
        return True

    def _dimension_of(self, item: Text) -> Dimension | None:
        """Return the dimension that a text belongs to."""
        if self._is_drawing_dimension or OF_DIMENSION not in item.label:
            return None
        named = (one for one in reversed(self._dimensions) if item.label.endswith(one.tag))
        return next(named, None)

    def _dimension(self, one: Dimension) -> None:
        """Draw a dimension; its block has the lines, heads and letters of the sheet."""
        space, measured = self._space, one.measured()
        self._is_drawing_dimension = True
        if measured is not None:
            self._space = self._document.blocks.new_anonymous_block(type_char="D")
            space.new_entity(
                "DIMENSION",
                {"layer": "THIN", "dimstyle": "Standard", "geometry": self._space.name, **measured},
            )
        for item in (*one.lines, *one.letters):
            match item:
                case Stroke():
                    self.stroke(item)
                case Arc():
                    self.arc(item)
                case Fill():
                    self.fill(item)
                case Text():
                    self.text(item)
        self._flush()
        self._space, self._is_drawing_dimension = space, False

    def _mask(self, outline: Sequence[complex]) -> None:
        """Hide what lies under an area, whatever the colour of the screen."""
        self._space.add_wipeout(pairs(outline)).dxf.layer = "MASKS"

    def _line(self, item: Stroke) -> None:
        attributes = self._by_layer(self._layer_of(item.tag, item.pen), item.pen)
        is_form = not self._stroked and item.tag.startswith("stamp")
        space = self._title_block() if is_form else self._space
        if len(item.points) == 2 and item.points[0] != item.points[1]:
            (a, b) = pairs(item.points)
            line = space.add_line(a, b, dxfattribs=attributes)
            if item.tag.startswith(PART_OF) and not self._stroked:
                self._groups.setdefault(item.tag.removeprefix(PART_OF), []).append(line)
            return
        if item.smooth and len(item.points) > _DEGREE:
            curve = global_bspline_interpolation(pairs(item.points), _DEGREE)
            self._space.add_spline(dxfattribs=attributes).apply_construction_tool(curve)
            return
        if PENS[item.pen].dashes and is_smooth(item.points):
            attributes["flags"] = 128  # the line type runs on through the corners
        space.add_lwpolyline(pairs(item.points), close=item.closed, dxfattribs=attributes)

    def _arrow(
        self, item: Fill, tip: complex, direction: complex, length: float, wide: float
    ) -> None:
        """Draw an arrowhead, and the shaft that was held for it up to the very tip."""
        held, own = self._pending, dict[str, int]()
        layer = layer_of_area(item.tag)
        if (
            isinstance(held, Stroke)
            and held.tag == item.tag
            and leads(held, tip, direction, length)
        ):
            self._pending = None
            start, stop = held.points
            line, pen = self._layer_of(held.tag, held.pen), held.pen
            if self._pens.is_coloured:
                layer = coloured_layer(layer, pen)
            own, is_vector = self._own_colour(layer, pen), layer_of(held.tag, pen) == VECTORS
            if is_vector and self._pens.width(pen) > self._pens.width(Pen.THIN):
                # A thick line would blunt the tip that it must reach: its thickness is a body.
                side = direction * 1j * self._pens.width(pen) / 2.0
                corners = (start + side, start - side, stop + side, stop - side)
                self._space.add_solid(pairs(corners), dxfattribs={"layer": layer, **own})
                pen = Pen.THIN
            end = tip if is_vector else stop
            (a, b) = pairs((start, end))
            self._space.add_line(a, b, dxfattribs=self._by_layer(line, pen, held.pen))
        self._flush()
        name = "ARROWHEAD"
        if name not in self._document.blocks:
            block = self._document.blocks.new(name)
            notch = 1.0 - ARROW.notch
            outline = ((0.0, 0.0), (-1.0, 0.5), (-notch, 0.0), (-1.0, -0.5))
            # Of its reference's colour, which is that of the shaft.
            block.add_hatch(color=0).paths.add_polyline_path(outline, is_closed=True)
        self._space.add_blockref(
            name,
            (tip.real, tip.imag),
            dxfattribs={
                "layer": layer,
                "xscale": length,
                "yscale": wide,
                "rotation": degrees(phase(direction)),
                **own,
            },
        )

    def _joint(self, radius: float, pen: Pen) -> str:
        """Return the block of a revolute pair: an opaque circle."""
        name = f"JOINT_{radius:.6g}_{layer_of('', pen)}"
        if name not in self._document.blocks:
            block = self._document.blocks.new(name)
            block.add_wipeout(pairs(circle(0j, radius)))
            by_layer = self._by_layer("SYMBOLS", pen)
            del by_layer["layer"]
            add_arc(block, Arc(0j, radius), tau, by_layer)
        return name

    def _letter(self, char: str, of: str) -> str:
        """Return the block of a letter with h = 1, or nothing for a blank.

        Its lines are as thick as the reference says: line weights do not grow with a block.
        """
        lettering = lettering_of(of, self._lettering)
        name = f"LETTER_{of}_" if of else "LETTER_"
        name += "NONE" if lettering.missing(char) else f"{ord(char):04X}"
        strokes = lettering.strokes(char)
        if strokes and name not in self._document.blocks:
            block = self._document.blocks.new(name)
            for line in strokes:
                block.add_lwpolyline(pairs(line), dxfattribs={"lineweight": _BY_BLOCK})
        return name if strokes else ""
