"""Make the lettering data of the package from DejaVu Sans (run by hand; needs the dev extra).

Writes into ``planmethod/render/fonts/``:

- ``PlanmethodSans.ttf``: the letters a sheet can need, renamed as the licence of the font asks;
- ``PlanmethodSans.json``: advance, ink bounds and outline of each letter, so that drawing needs
  no font library at run time;
- ``PlanmethodSans-LICENSE.txt``: the licence of the font.

The bytes depend only on the source font and the version of fontTools.
"""

from __future__ import annotations

import json
import sys
from itertools import chain, pairwise
from pathlib import Path
from typing import Any

import matplotlib
from fontTools import subset
from fontTools.pens.basePen import decomposeQuadraticSegment
from fontTools.pens.recordingPen import DecomposingRecordingPen
from fontTools.ttLib import TTFont

NAME = "PlanmethodSans"
FAMILY = "Planmethod Sans"
TARGET = Path(__file__).resolve().parent.parent / "planmethod" / "render" / "fonts"

RANGES = (
    (0x0020, 0x007E),  # Basic Latin
    (0x00A0, 0x00FF),  # Latin-1
    (0x02C6, 0x02DD),  # spacing modifiers: circumflex, macron, dot above
    (0x0300, 0x0308),  # combining accents, macron, overline, dots
    (0x0391, 0x03D6),  # Greek
    (0x0400, 0x045F),  # Cyrillic
    (0x0490, 0x0491),  # Ukrainian ґ
    (0x2010, 0x2027),  # dashes, quotes, dots
    (0x2030, 0x203A),  # per mille, primes, angle quotes
    (0x2044, 0x2044),  # fraction slash
    (0x2070, 0x209C),  # superscripts and subscripts
    (0x20AC, 0x20AC),
    (0x20D7, 0x20D7),  # combining vector arrow
    (0x2100, 0x214E),  # letterlike: №, ℓ, ...
    (0x2150, 0x215E),  # fractions
    (0x2160, 0x217F),  # Roman numerals: classes of groups
    (0x2190, 0x21FF),  # arrows, ↺ ↻ among them
    (0x2200, 0x22FF),  # mathematical operators
    (0x2308, 0x230B),
    (0x25A0, 0x25FF),  # geometric shapes
    (0x27C2, 0x27C2),  # perpendicular
    (0x27E8, 0x27E9),
    (0x2A7D, 0x2A7E),
)


def svg_path(glyphs: Any, name: str) -> str:
    """Return an outline as an SVG path of M, L, Q and Z with absolute coordinates."""
    pen = DecomposingRecordingPen(glyphs)
    glyphs[name].draw(pen)
    parts: list[str] = []

    def put(letter: str, *points: tuple[float, float]) -> None:
        parts.append(letter + " ".join(f"{value:g}" for value in chain.from_iterable(points)))

    for verb, points in pen.value:
        match verb:
            case "moveTo":
                put("M", *points)
            case "lineTo":
                put("L", *points)
            case "qCurveTo":
                if points[-1] is None:
                    # No point of this contour is on the curve: it starts halfway between two.
                    (ax, ay), (bx, by) = points[-2], points[0]
                    start = ((ax + bx) / 2, (ay + by) / 2)
                    put("M", start)
                    points = (*points[:-1], start)
                for curve in decomposeQuadraticSegment(points):
                    put("Q", *curve)
            case "closePath":
                put("Z")
            case _:
                raise ValueError(f"{name}: no rule for {verb} {points}")
    return "".join(parts)


def read_source() -> tuple[TTFont, str]:
    """Return DejaVu Sans as matplotlib carries it, and its licence."""
    fonts = Path(matplotlib.get_data_path()) / "fonts" / "ttf"
    font = TTFont(fonts / "DejaVuSans.ttf", recalcTimestamp=False)
    return font, (fonts / "LICENSE_DEJAVU").read_text(encoding="utf-8")


def make_subset(font: TTFont) -> None:
    """Keep the letters of `RANGES`, without hints, kerning and layout tables, and rename."""
    options = subset.Options()
    options.hinting = False
    options.layout_features = []
    options.drop_tables += ["GDEF", "GPOS", "GSUB", "kern", "FFTM", "MATH", "gasp"]
    options.name_IDs = [0, 1, 2, 3, 4, 5, 6, 13, 14]
    options.notdef_outline = True
    options.recalc_timestamp = False
    maker = subset.Subsetter(options)
    maker.populate(unicodes=list(chain.from_iterable(range(a, b + 1) for a, b in RANGES)))
    maker.subset(font)
    for record in font["name"].names:
        renamed = {1: FAMILY, 3: f"{FAMILY} (subset of DejaVu Sans)", 4: FAMILY, 6: NAME}
        if record.nameID in renamed:
            record.string = renamed[record.nameID]


def glyph_table(font: TTFont) -> dict[str, object]:
    """Return the data file: letters by code point in hex, lengths in font units.

    Each letter is ``[advance, xmin, ymin, xmax, ymax, outline]``; the key ``""`` is the box drawn
    for a letter that the font has not.
    """
    glyphs = font.getGlyphSet()
    outlines = font["glyf"]

    def row(name: str) -> list[object]:
        path = svg_path(glyphs, name)
        glyph = outlines[name]
        glyph.recalcBounds(outlines)
        bounds = [glyph.xMin, glyph.yMin, glyph.xMax, glyph.yMax] if path else [0, 0, 0, 0]
        return [glyphs[name].width, *bounds, path]

    letters = {f"{code:x}": row(name) for code, name in sorted(font.getBestCmap().items())}
    cap_height = outlines["H"].yMax
    return {
        "name": FAMILY,
        "units_per_em": font["head"].unitsPerEm,
        "cap_height": cap_height,
        "glyphs": {"": row(".notdef"), **letters},
    }


def main(target: Path = TARGET) -> None:
    """Write the three files into ``target``."""
    for (_, end), (start, _) in pairwise(RANGES):
        assert end < start, "ranges overlap"
    font, licence = read_source()
    make_subset(font)
    table = glyph_table(font)
    target.mkdir(parents=True, exist_ok=True)
    font.save(target / f"{NAME}.ttf")
    text = json.dumps(table, ensure_ascii=True, separators=(",", ":"))
    # One letter a line: a change of one letter is one line of a diff.
    text = text.replace('],"', '],\n"') + "\n"
    (target / f"{NAME}.json").write_text(text, encoding="ascii", newline="\n")
    note = (
        f"{FAMILY} is a subset of DejaVu Sans, renamed as its licence asks; "
        "no outline is changed.\n"
        "The licence of DejaVu Sans follows.\n\n"
    )
    path = target / f"{NAME}-LICENSE.txt"
    path.write_text(note + licence, encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else TARGET)
