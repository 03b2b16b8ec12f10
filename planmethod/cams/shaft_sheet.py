"""Sheets of a camshaft: the cyclogram with all lifts, then the sheet of each cam (циклограмма)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import degrees

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.cams.model import TURN, CamProblem
from planmethod.cams.shaft import Camshaft, PhaseSpan, phase_of, spans_of
from planmethod.cams.shaft_text import given_facts, lifts_table, phases_table, timing_scale
from planmethod.cams.sheet import TEXT_WIDTH, drawings as drawings_of_cam
from planmethod.cams.text import MM, angle_symbol
from planmethod.construct.drafting import Profile
from planmethod.construct.scale import Scale
from planmethod.errors import LayoutError
from planmethod.languages import LANGUAGES, translate
from planmethod.note.document import Table
from planmethod.note.wording import Language, get_language
from planmethod.options import PlanRequest
from planmethod.paper import STAMP_WIDTH
from planmethod.render.frame import Furniture
from planmethod.render.ink.drawing import Drawing, Item, Pen, Stroke, shifted
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Block, Column, Picture, heading, paragraph, titled
from planmethod.render.layout.groups import Group, LayoutItem
from planmethod.render.layout.text_blocks import TableColumn, TableForm, table_block
from planmethod.render.pictures.diagram import (
    Abscissae,
    Curve,
    Diagram,
    Ordinates,
    diagram_picture,
)
from planmethod.render.sheets.composer import (
    NoFitAdvice,
    Packing,
    Sizes,
    TrialPaper,
    ViewBlock,
    compose,
)

DEGREES = (1.0, 1.25, 2.0)
"""Scales of the axis of angles that are tried, degrees per mm."""

LETTERS = (
    Sizes(5.0, 7.0, 3.5, TEXT_WIDTH, 6.0),
    Sizes(3.5, 5.0, 2.5, TEXT_WIDTH, 5.0),
)
"""Letters that are tried."""

_BETWEEN = 7.0  # mm: between diagrams one below the other
_BAR = 10.0  # mm: height of a row of the cyclogram
_NAME = 16.0  # mm: width of the names at its left
_POINTS = 61
_AXIS_BEYOND_TURN = 20.0  # mm: the name of the axis is clear of the lift of the next turn


def drawings(shaft: Camshaft, request: PlanRequest) -> list[Drawing]:
    """Draw the cyclogram and each cam with the key of the shaft.

    Raises
    ------
    ProblemError
        A cam cannot satisfy its requirements.
    LayoutError
        The content does not fit on the requested paper.
    """
    language = get_language(shaft.sheet.lang or LANGUAGES[0])
    total = request.total or len(shaft.cams) + 1
    furniture = Furniture.of(shaft.sheet, before=request.before, total=total)
    misfit = NoFitAdvice(
        lambda paper, advice: LayoutError(
            "{}: the cyclogram and its tables do not fit {}. {}", shaft.name, paper, advice
        ),
        translate("Request fewer positions with count."),
    )
    title = language.cam.cyclogram
    made = compose(
        shaft, _Timing(shaft, language, request.profile), misfit,
        fields=request.fields, furniture=furniture, title=title,
    )  # fmt: skip
    for cam in shaft.cams:
        own = replace(
            cam,
            source_file=shaft.source_file,
            title=language.cam.one_cam.format(name=cam.name),
            stamp=shaft.title_block,
            sheet=shaft.sheet,
        )
        made += drawings_of_cam(
            own, replace(request, before=request.before + len(made), total=total)
        )
    return made


class _Timing(Struct, frozen=True):
    """Search for the sheet of the cyclogram."""

    shaft: Camshaft
    language: Language
    profile: Profile

    formats = ("A3", "A2", "A1")

    def proposals(self, papers: Sequence[TrialPaper]) -> Iterator[Packing]:
        """Yield the blocks at smaller scales and letters on each paper in turn."""
        for paper in papers:
            for letters in LETTERS:
                for degree in DEGREES:
                    parts = tuple(self.parts(degree, letters))
                    yield Packing(paper, (Group(parts),), scales={"degree": degree})

    def parts(self, degree: float, letters: Sizes) -> Iterator[LayoutItem]:
        """Yield the blocks in reading order."""
        texts, notation = self.language.cam, self.language.notation
        scale = timing_scale(self.shaft)
        picture = cyclogram_picture(self.shaft, self.language, degree, letters.letter)
        told = "; ".join(
            (
                texts.scale.format(symbol="μ_{s}", value=notation.as_input(MM * scale)),
                texts.scale_phi.format(degree=notation.as_input(degree)),
            )
        )
        heights = letters.title, letters.text
        block = titled(picture, texts.cyclogram, [told], heights, is_wrapped=True)
        yield LayoutItem(ViewBlock(block, "diagram", Scale("mu_s", scale, "m")))
        facts = "; ".join(fact.text for fact in given_facts(self.shaft, self.language))
        told = self.language.note.given.format(given=facts)
        lines = [paragraph(text, letters.text, TEXT_WIDTH) for text in (told, texts.key_told)]
        yield LayoutItem(Column(lines, gap=2.0), text=True)
        for table, title in (
            (phases_table(self.shaft, self.language), texts.phases_title),
            (lifts_table(self.shaft, self.language, self.profile), texts.lifts_read),
        ):
            yield LayoutItem(_table(table, letters, title), text=True)


def cyclogram_picture(shaft: Camshaft, language: Language, degree: float, letter: float) -> Picture:
    """Return the lifts of all followers over a turn of the shaft, and the rows of their phases.

    Parameters
    ----------
    degree : float
        Degrees per mm.
    letter : float, mm
    """
    items: list[Item] = []
    level = right = left = 0.0
    for cam in shaft.cams:
        picture = _lift(cam, timing_scale(shaft), language, degree, letter)
        drop = level - picture.bounds[3]
        items += shifted(picture.items, 1j * drop)
        level = drop + picture.bounds[1] - _BETWEEN
        left, right = min(left, picture.bounds[0]), max(right, picture.bounds[2])
    for cam in shaft.cams:
        items += _row(cam, language, degree, letter, level)
        level -= _BAR
    left = min(left, -_NAME)
    return Picture(tuple(items), (left, level - 1.0, right, 0.0))


def _lift(
    cam: CamProblem, per_mm: float, language: Language, degree: float, letter: float
) -> Picture:
    """Return the diagram of a lift; the angles of its phases are at the axis."""
    parts: list[list[complex]] = []
    for stretch in cam.stretches:
        phi = np.linspace(stretch.start, stretch.end, _POINTS)
        turned = phi + phase_of(cam)
        # the part beyond the end of the turn is drawn at its beginning
        whole = TURN * np.floor((turned[0] + 1e-12) / TURN)
        if turned[0] - whole < TURN - 1e-12 < turned[-1] - whole - 1e-9:
            cut = whole + TURN - phase_of(cam)
            pieces = [
                np.linspace(stretch.start, cut, _POINTS),
                np.linspace(cut, stretch.end, _POINTS),
            ]
        else:
            pieces = [phi]
        for number, piece in enumerate(pieces):
            across = np.degrees(piece + phase_of(cam) - whole - number * TURN) / degree
            heights = cam.on(stretch, piece)[0] / per_mm
            parts.append([complex(x, y) for x, y in zip(across, heights, strict=True)])
    parts.sort(key=lambda part: part[0].real)
    joined: list[list[complex]] = []
    for part in parts:
        if joined and abs(joined[-1][-1] - part[0]) < 1e-6:
            joined[-1] += part[1:]
        else:
            joined.append(part)
    ends = sorted({round(degrees(x), 6) for one in spans_of(cam) for x in (one.start, one.end)})
    marks = tuple(end / degree for end in ends)
    numbers = tuple(language.notation.as_input(end) for end in ends)
    symbol = f"s_{{{cam.name}}}, {language.notation.units['mm']}"
    return diagram_picture(
        Diagram(
            Abscissae("φ, °", marks, numbers, extension=_AXIS_BEYOND_TURN),
            Ordinates(symbol, MM * per_mm, language.notation),
            [Curve("", tuple(map(tuple, joined)))],
        ),
        letter_height=letter,
        name=f"lift {cam.name}",
    )


def _row(
    cam: CamProblem, language: Language, degree: float, letter: float, top: float
) -> list[Item]:
    """Return the row of a cam: a bar for each phase, level where the follower rests."""
    items: list[Item] = []
    size = max(2.5, 0.7 * letter)
    name = typeset(cam.name, letter)
    items += name.at(complex(-3.0 - name.width, top - _BAR / 2 - size / 2))
    for span in spans_of(cam):
        one, two = (degrees(x) / degree for x in (span.start, span.end))
        corners = (complex(one, top), complex(two, top), complex(two, top - _BAR),
                   complex(one, top - _BAR))  # fmt: skip
        items.append(Stroke(corners, Pen.THIN, closed=True, tag="cyclogram"))
        low, high = _levels(cam, span)
        line = (complex(one, top - _BAR + low), complex(two, top - _BAR + high))
        items.append(Stroke(line, Pen.MAIN, tag="cyclogram"))
        text = typeset(angle_symbol(cam, span.motion, language), size)
        if two - one > text.width + 2.0:
            middle = (one + two) / 2
            slope = (high - low) / (two - one) * text.width / 2
            at = (low + high) / 2  # the letters are on the side of the line that has more room
            up = at < _BAR / 2
            base = (
                at + abs(slope) + 1.0 + text.descent if up else at - abs(slope) - 1.0 - text.ascent
            )
            items += text.at(complex(middle - text.width / 2, top - _BAR + base))
    return items


def _levels(cam: CamProblem, span: PhaseSpan) -> tuple[float, float]:
    """Return the heights of a span's line at its ends within the row, mm."""
    motion, inner = span.motion, _BAR - 3.0
    start = (span.start - phase_of(cam) - motion.start) % TURN
    start = 0.0 if TURN - start < 1e-9 else start
    shares = (start / motion.length, (start + span.end - span.start) / motion.length)
    heights = (motion.before + share * (motion.after - motion.before) for share in shares)
    low, high = (1.5 + inner * height / cam.stroke for height in heights)
    return low, high


def _table(content: Table, letters: Sizes, title: str) -> Block:
    columns = [TableColumn(head, cells) for head, cells in content.columns()]
    table = table_block(
        columns, TableForm(letters.text, units="none", row_height=letters.row), width=STAMP_WIDTH
    )
    return Column([heading(title, letters.text, width=TEXT_WIDTH), table], gap=2.0)
