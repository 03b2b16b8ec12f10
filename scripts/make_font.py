"""Make the fonts of the package from the skeletons of the letters (by hand; needs the dev extra).

Run as ``python -m scripts.make_font``.

The pen of the lettering goes along every skeleton (`scripts.skeleton`):
shapely widens it by half the line thickness, and for each style of GOST 2.304 (types A and B,
upright and slanted) two files come into ``planmethod/render/ink/fonts/``:

- ``PlanmethodGOST-B-Slanted.ttf`` and so on: the font, for formats that embed one;
- ``PlanmethodGOST-B-Slanted.json``: advance, ink bounds and strokes of each letter and the pairs
  that stand closer, so that drawing needs no font library at run time.

The same skeletons give the same bytes.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from itertools import chain, pairwise
from pathlib import Path
from typing import Any

from fontTools.feaLib.builder import addOpenTypeFeaturesFromString
from fontTools.fontBuilder import FontBuilder
from fontTools.pens.ttGlyphPen import TTGlyphPen
from shapely import LineString, union_all
from shapely.geometry import MultiPolygon, Polygon
from shapely.geometry.polygon import orient

from planmethod.render.ink.lettering import FONTS, STYLES, Style
from scripts.skeleton import (
    Skeleton,
    Strokes,
    letters,
    missing_box,
    skeleton,
)

CAP_HEIGHT = 1400
"""Font units to the height h: whole units to the line thickness in both types."""
UNITS_PER_EM = 2000

ROUND = 5  # parts of a quarter circle at the end of a stroke
WITHIN = 0.004  # d: how far an outline may be simplified
OPENING = 1.0  # d: gap kept everywhere between two letters that are closer
REACH = 1.0  # d: how far above and below a stroke keeps others away

KERNED = (
    "АБВГДЕЖЗИКЛМНОПРСТУФХЦЧШЩЪЫЬЭЮЯабвгдежзиклмнопрстуфхцчшщъыьэюя"
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz"
)
"""Letters that may stand closer: not digits, which stand under one another in tables."""


def leant(strokes: Strokes, style: Style) -> Strokes:
    """Return the strokes slanted if the style is."""
    lean = style.lean
    waist = style.proportions.small / 2  # ink leaning right above it leans left below
    return tuple(tuple(p + lean * (p.imag - waist) for p in line) for line in strokes)


def outline(strokes: Strokes) -> list[Polygon]:
    """Return the outline of a pen drawn along the strokes, d."""
    parts = [
        LineString([(p.real, p.imag) for p in line]).buffer(0.5, quad_segs=ROUND)
        for line in strokes
    ]
    whole = union_all(parts).simplify(WITHIN)
    found = whole.geoms if isinstance(whole, MultiPolygon) else [whole]
    return sorted((orient(part) for part in found), key=lambda part: part.bounds)


def contours(polygons: Iterable[Polygon], unit: float) -> list[list[tuple[int, int]]]:
    """Return the contours in font units, without the points that rounding made one."""
    found = []
    for polygon in polygons:
        for ring in (polygon.exterior, *polygon.interiors):
            points = [(round(x * unit), round(y * unit)) for x, y in ring.coords]
            found.append([b for a, b in pairwise(points) if a != b])
    return found


def svg_path(strokes: Strokes, unit: float) -> str:
    """Return strokes as an SVG path of M and l, in font units."""
    path = ""
    for line in strokes:
        points = [(round(p.real * unit), round(p.imag * unit)) for p in line]
        steps = [(c - a, d - b) for (a, b), (c, d) in pairwise(points)]
        ways = " ".join(f"{x} {y}" for x, y in steps if x or y)
        path += f"M{points[0][0]} {points[0][1]}l{ways}"
    return path.replace(" -", "-")


def closer(kind: str) -> dict[str, str]:
    """Return the letters that may follow a letter at half the gap (ГА, АТ), by that letter.

    GOST 2.304 lets the gap between strokes that are not parallel be halved: here where the nearest
    strokes of the two then still stand a whole gap apart.
    """
    right = {char: _edge(skeleton(char, kind), 1) for char in KERNED}
    left = {char: _edge(skeleton(char, kind), -1) for char in KERNED}
    pairs = {}
    for a in KERNED:
        free = (
            min(x + y for x, y in zip(right[a], left[b], strict=True)) >= OPENING for b in KERNED
        )
        following = "".join(b for b, is_free in zip(KERNED, free, strict=True) if is_free)
        if following:
            pairs[a] = following
    return pairs


def _edge(letter: Skeleton, way: int) -> list[float]:
    """Return how far the strokes stay off the letter's right (+1) or left side, level by level."""
    points = [
        p for line in letter.strokes for a, b in pairwise((*line, line[-1])) for p in _fine(a, b)
    ]
    reach = max(way * p.real for p in points)
    levels = [-5 + 0.5 * k for k in range(50)]
    return [
        min((reach - way * p.real for p in points if abs(p.imag - level) <= REACH), default=99.0)
        for level in levels
    ]


def _fine(a: complex, b: complex) -> list[complex]:
    count = max(1, int(abs(b - a) / 0.1))
    return [a + (b - a) * k / count for k in range(count + 1)]


def make(style: Style, target: Path) -> None:
    """Write both files of a style into a folder."""
    measures = style.proportions
    unit = CAP_HEIGHT / measures.cap
    shapes: dict[str, Skeleton] = {"": missing_box(style.kind)}
    shapes |= {char: skeleton(char, style.kind) for char in letters()}
    strokes = {char: leant(shape.strokes, style) for char, shape in shapes.items()}
    rings = {char: contours(outline(own), unit) if own else [] for char, own in strokes.items()}
    advances = {char: round(shape.advance * unit) for char, shape in shapes.items()}
    kern = closer(style.kind)
    data = {
        "cap_height": CAP_HEIGHT,
        "units_per_em": UNITS_PER_EM,
        "kern": -round(measures.gap / 2 * unit),
        "closer": kern,
        "glyphs": {
            f"{ord(char):x}" if char else "": [
                advances[char],
                *_bounds(rings[char]),
                svg_path(strokes[char], unit),
            ]
            for char in shapes
        },
    }
    text = json.dumps(data, ensure_ascii=True, separators=(",", ":")) + "\n"
    (target / f"{style.name}.json").write_text(text, encoding="ascii")
    made = font(style, rings, advances, kern, -round(measures.gap / 2 * unit))
    made.save(target / f"{style.name}.ttf")


def _bounds(rings: Sequence[Sequence[tuple[int, int]]]) -> tuple[int, int, int, int]:
    points = list(chain.from_iterable(rings))
    if not points:
        return (0, 0, 0, 0)
    xs, ys = zip(*points, strict=True)
    return (min(xs), min(ys), max(xs), max(ys))


def font(
    style: Style,
    rings: dict[str, list[list[tuple[int, int]]]],
    advances: dict[str, int],
    kern: dict[str, str],
    by: int,
) -> Any:
    """Return the TrueType font; a step of its lines is the line step of the standard."""
    measures = style.proportions
    unit = CAP_HEIGHT / measures.cap
    names = {char: f"uni{ord(char):04X}" if char else ".notdef" for char in rings}
    builder: Any = FontBuilder(UNITS_PER_EM, isTTF=True)
    builder.setupGlyphOrder(list(names.values()))
    builder.setupCharacterMap({ord(char): name for char, name in names.items() if char})
    glyphs = {}
    for char, name in names.items():
        pen = TTGlyphPen(None)
        for ring in rings[char]:
            pen.moveTo(ring[0])
            for point in ring[1:]:
                pen.lineTo(point)
            pen.closePath()
        glyphs[name] = pen.glyph()
    builder.setupGlyf(glyphs)
    builder.setupHorizontalMetrics(
        {name: (advances[char], _bounds(rings[char])[0]) for char, name in names.items()}
    )
    line = round(measures.line_step * unit)
    ascent = round(0.75 * line)
    builder.setupHorizontalHeader(ascent=ascent, descent=ascent - line)
    told = {
        "familyName": f"Planmethod GOST {style.kind}",
        "styleName": "Italic" if style.slanted else "Regular",
        "uniqueFontIdentifier": style.name,
        "fullName": f"Planmethod GOST {style.kind}{' Slanted' if style.slanted else ''}",
        "psName": style.name,
        "version": "Version 1.000",
        "copyright": "The planmethod developers",
        "licenseDescription": "MIT License",
    }
    builder.setupNameTable(told, mac=False)
    builder.setupOS2(
        sTypoAscender=ascent,
        sTypoDescender=ascent - line,
        sTypoLineGap=0,
        usWinAscent=ascent,
        usWinDescent=line - ascent,
        sxHeight=round(measures.small * unit),
        sCapHeight=CAP_HEIGHT,
        fsSelection=0x01 if style.slanted else 0x40,
        usWeightClass=300,
    )
    builder.setupPost(italicAngle=-15.0 if style.slanted else 0.0)
    rules = [
        f"pos {names[left]} [{' '.join(names[char] for char in right)}] {by};"
        for left, right in kern.items()
    ]
    feature = "feature kern {\n" + "\n".join(rules) + "\n} kern;\n"
    addOpenTypeFeaturesFromString(builder.font, "languagesystem DFLT dflt;\n" + feature)
    head = builder.font["head"]
    head.created = head.modified = 3_849_984_000  # a fixed moment: the same bytes every time
    if style.slanted:
        head.macStyle = 0x02
    builder.font.recalcTimestamp = False
    return builder.font


def main(target: Path = FONTS) -> None:
    """Write the files of all styles."""
    target.mkdir(parents=True, exist_ok=True)
    for style in STYLES.values():
        make(style, target)


if __name__ == "__main__":
    main()
