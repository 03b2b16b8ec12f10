"""The page of cams that turn: cam, follower, normal, pressure angle, the diagram with a cursor.

A camshaft has a view of each cam, whose key turns with the shaft, and the cyclogram as its diagram.

Its numbers are rows for every half degree, which the page interpolates linearly; at a jump a row
has the value after it.
"""

# no messages: HTML

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from importlib.resources import files
from math import degrees
from typing import Any

import numpy as np
from msgspec import Struct

from planmethod.cams.construction import construct
from planmethod.cams.design import CamDesign, design_of
from planmethod.cams.model import TURN, CamProblem, Closure, Contact
from planmethod.cams.pictures import CamView, diagrams_picture
from planmethod.cams.shaft import Camshaft
from planmethod.note.formula import Rich, escape as rich_escape
from planmethod.note.wording import Language, get_language
from planmethod.render.backends.canvas import Options
from planmethod.render.backends.svg import SvgCanvas
from planmethod.render.ink.drawing import Drawing
from planmethod.render.ink.pens import PenSet
from planmethod.render.layout.block import Picture
from planmethod.render.live.document import (
    colour_switch,
    html_document,
    rich,
    runs,
    speed_choice,
)

ROWS = 720
LETTER = 5.0
PACE = 60.0
"""Degrees a second, where the file has no speed."""

QUICK = 120.0
"""Most degrees a second of the page."""

TABLE = ("s", "v_q", "a_q", "pressure")


def live_page(problem: CamProblem, lang: str) -> str:
    """Return the page of a cam, an HTML document.

    Raises
    ------
    ProblemError
        No cam satisfies the requirements.
    """
    language, design = get_language(lang), design_of(problem)
    built = construct(design)
    diagrams = LiveDiagrams(
        diagrams_picture(CamView(built, language, LETTER)),
        language.cam["views"]["diagrams"],
        1 / built.scales.degree,
    )
    return cams_page(problem, lang, (design,), diagrams)


class LiveDiagrams(Struct, frozen=True):
    """The diagrams of a page, over which a cursor moves.

    Attributes
    ----------
    picture : Picture
        The axis of angles begins at x = 0.
    title : Rich
    per_degree : float, mm
    """

    picture: Picture
    title: Rich
    per_degree: float


def cams_page(
    problem: CamProblem | Camshaft, lang: str, designs: Sequence[CamDesign], diagrams: LiveDiagrams
) -> str:
    """Return the page of a cam or of the cams of a shaft.

    Raises
    ------
    ProblemError
        No cam satisfies the requirements.
    """
    language = get_language(lang)
    canvas = SvgCanvas(Options())
    canvas.open(Drawing(0.0, 0.0, pens=PenSet(is_coloured=True)))
    left, low, right, high = diagrams.picture.bounds
    cursor = f'<path id="cursor" class="seg thin" d="M0 {-high:.2f}V{-low:.2f}"/>'
    box = f"{left - 2:.2f} {-high - 2:.2f} {right - left + 4:.2f} {high - low + 4:.2f}"
    one = language.cam["views"]["profile"]
    views = "".join(
        _figure(_title(design, language) or one, *_mechanism(design, _ending(number)))
        for number, design in enumerate(designs)
    )
    drawn = canvas.parts(diagrams.picture.items) + cursor
    views += _figure(diagrams.title, drawn, box, is_wide=len(designs) > 1)
    texts = language.live
    scene: dict[str, Any] = {
        "cams": [_scene(design) for design in designs],
        "per_degree": diagrams.per_degree,
        "pace": min(QUICK, abs(problem.n or 0.0) * 6.0) or PACE,
        "decimal": language.notation.decimal,
        "words": {"play": texts.play, "pause": texts.pause},
    }
    bar = (
        f'<div id="bar"><section><button id="play" aria-label="{escape(texts.play)}">▶</button>'
        f'<input id="slider" type="range" min="0" max="360" step="any" value="0" '
        f'aria-label="{escape(texts.driver)}"><label>φ = <input id="exact" type="number" '
        f'step="any"> °</label>{speed_choice(texts.speed)}'
        f"{colour_switch(problem, texts.colour)}</section></div>"
    )
    return html_document(
        problem,
        lang=lang,
        body="\n".join((bar, f'<div id="views">{views}</div>', _table(designs, language))),
        credit=language.cam.made_live,
        letters=canvas.letters(),
        scene=scene,
        script=files("planmethod.cams").joinpath("live.js").read_text("utf-8"),
    )


def _ending(number: int) -> str:
    """Return the ending of the names of a cam's elements on the page."""
    return f"-{number}" if number else ""


def _title(design: CamDesign, language: Language) -> Rich:
    """Return the name of a cam of a shaft; empty of one that is alone."""
    problem = design.problem
    return (
        "" if problem.phase is None else language.cam.one_cam.format(name=rich_escape(problem.name))
    )


def _table(designs: Sequence[CamDesign], language: Language) -> str:
    """Return the table of numbers, a column for each cam."""
    heads = dict(zip(TABLE, language.cam["heads"][2:6], strict=True))
    lines = ""
    if titles := [title for design in designs if (title := _title(design, language))]:
        cells = "".join(f'<th scope="col">{rich(title)}</th>' for title in titles)
        lines = f"<tr><td></td>{cells}</tr>"
    for key in TABLE:
        cells = "".join(
            f'<td><span id="{key}{_ending(number)}"></span></td>' for number in range(len(designs))
        )
        lines += f"<tr><th>{rich(heads[key])}</th>{cells}</tr>"
    return f'<section><div id="numbers"><table><tbody>{lines}</tbody></table></div></section>'


def _scene(design: CamDesign) -> dict[str, Any]:
    problem = design.problem
    return {
        "rows": _rows(design),
        "phase": round(degrees(problem.phase or 0.0), 9),
        "mirror": problem.mirror,
        "oscillates": problem.oscillates,
        "line": None if problem.oscillates else 1000.0 * design.geometry.e,
        "arm": problem.arm,
        "pivot": design.geometry.centre * design.side,
    }


def _rows(design: CamDesign) -> list[list[float]]:
    """Return s, v_q, a_q (mm), ϑ (degrees), roller and contact in the resting frame (mm)."""
    phi = TURN * np.arange(ROWS + 1) / ROWS
    moved = design.problem.at(phi)
    at = design.geometry.points(phi, moved)
    contact = at.actual * np.exp(1j * phi)
    columns = [
        *(1000.0 * moved), np.degrees(at.pressure), 1000.0 * at.roller.real,
        1000.0 * at.roller.imag, 1000.0 * contact.real, 1000.0 * contact.imag,
    ]  # fmt: skip
    return [[round(float(x), 6) + 0.0 for x in row] for row in np.array(columns).T]


def _figure(title: str, drawn: str, box: str, *, is_wide: bool = False) -> str:
    row = ' class="wide"' if is_wide else ""
    head = f"<figure{row}><figcaption>{rich(title)}</figcaption>"
    name = escape("".join(text for text, _ in runs(title)))
    return f'{head}<svg viewBox="{box}" role="group" aria-label="{name}">{drawn}</svg></figure>'


def _mechanism(design: CamDesign, ending: str) -> tuple[str, str]:
    """Return cam and follower as SVG, mm, y down, and the view box.

    Parameters
    ----------
    ending : str
        Of the names of its elements.
    """
    problem, geometry = design.problem, design.geometry
    at = geometry.at(TURN * np.arange(ROWS) / ROWS)
    mm = 1000.0
    sides = (at.actual, at.outer) if problem.closure is Closure.FORM else (at.actual,)
    cam = "".join(
        '<path class="seg" d="M'
        + "L".join(f"{problem.mirror * mm * z.real:.3f} {-mm * z.imag:.3f}" for z in side)
        + 'Z"/>'
        for side in sides
    )
    # A mark shows that it turns: on a shaft it is where the key is, which points up at zero.
    key = problem.mirror * degrees(problem.phase or 0.0)
    turn = f' transform="rotate({-key:.3f})"' if key else ""
    cam += f'<path class="seg thin"{turn} d="M0 0V{-0.7 * mm * geometry.r_min:.3f}"/>'
    cam += f'<circle class="seg" r="{0.06 * mm * geometry.r_min:.3f}"/>'
    reach = mm * float(max(np.max(np.abs(side)) for side in sides)) + 4.0
    wide, tall = reach, reach
    if problem.oscillates:
        wide = max(wide, mm * geometry.centre + 6.0)
        if problem.contact is Contact.FLAT:
            wide = max(wide, mm * abs(geometry.centre - problem.arm) + 6.0)
    else:
        tall = max(tall, mm * (geometry.r_min + problem.stroke + geometry.roller) + 20.0)
    size = mm * geometry.roller
    tall = max(tall, mm * float(np.max(at.roller.imag)) + size + 6.0)
    plate = problem.contact is Contact.FLAT and not problem.oscillates
    stem = f'<path class="seg" id="stem{ending}" d="M0 0V{-tall - 60:.2f}"/>'
    half = mm * float(np.max(np.abs(problem.at(TURN * np.arange(ROWS) / ROWS)[1]))) + 3.0
    face = f'<path class="seg" d="M{-half:.2f} 0H{half:.2f}"/>' if plate else ""
    roller = f'<circle class="seg thin" r="{size:.3f}"/>' if size else ""
    follower = f'<path class="seg" id="arm{ending}"/>' if problem.oscillates else ""
    follower += f'<g id="follower{ending}">{"" if problem.oscillates else stem + face}{roller}</g>'
    normal = f'<path class="seg thin" id="normal{ending}"/><circle id="contact{ending}" r="0.8"/>'
    box = f"{-wide:.2f} {-tall:.2f} {2 * wide:.2f} {tall + reach:.2f}"
    return f'<g id="cam{ending}">{cam}</g>{follower}{normal}', box
