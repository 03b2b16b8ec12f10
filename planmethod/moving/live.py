"""The page of a moving point: vectors on its trajectory, and the hodographs (движение точки).

Its numbers are rows of even moments, which the page interpolates linearly.
"""

# no messages: HTML

from __future__ import annotations

from collections.abc import Mapping
from html import escape
from typing import Any

import numpy as np
from numpy.typing import NDArray

from planmethod.moving.construction import POLES, DrawnInterval, at, drawn_interval, places_of
from planmethod.moving.motion import LEGEND, PointProblem
from planmethod.note.document import plain_text
from planmethod.note.wording import Language, get_language
from planmethod.render.backends.canvas import Options
from planmethod.render.backends.svg import SvgCanvas
from planmethod.render.ink.drawing import Drawing
from planmethod.render.ink.pens import PenSet
from planmethod.render.ink.typeset import typeset, vector_markup
from planmethod.render.live.boxes import box_around, scale_of
from planmethod.render.live.document import (
    colour_switch,
    html_document,
    joined,
    rich,
    runs,
    slider_marks,
    speed_choice,
)

SCRIPT = ("numbers", "geometry", "svg", "labels", "views", "marks", "driver", "point")
"""Modules of the page's script, each after those that it imports."""

ROWS = 1440
LETTER = 5.0

VECTOR = 32.0
"""Length of the longest vectors on the trajectory, mm."""

MARGIN = 13.0

COMMON = 95
"""Percentile of the sizes of a vector that is drawn with that length."""

VECTORS = {"v": "v", "a": "a", "at": "a^{τ}", "an": "a^{n}"}

Complexes = NDArray[Any]


def live_page(problem: PointProblem, lang: str) -> str:
    """Return the page of a point, an HTML document.

    Raises
    ------
    ProblemError
        The point is nowhere in the shown interval.
    """
    return _PointPage(problem, get_language(lang)).html()


class _PointPage:
    def __init__(self, problem: PointProblem, language: Language) -> None:
        self.problem, self.language = problem, language
        self.course: DrawnInterval = drawn_interval(problem)
        self.canvas = SvgCanvas(Options())
        self.canvas.open(Drawing(0.0, 0.0, pens=PenSet(is_coloured=True)))
        motion = at(problem, np.linspace(*self.course.interval, ROWS + 1))
        self.columns: Mapping[str, Any] = {
            name: values for name, values in motion.columns.items() if name in LEGEND
        }

    def html(self) -> str:
        """Return the document."""
        texts, point, notation = self.language.live, self.language.point, self.language.notation
        views = [self._path(), self._hodograph("v"), self._hodograph("a")]
        titles = (point.trajectory, point.hodograph_v, point.hodograph_a)
        drawn = "".join(
            self._figure(view, title) for view, title in zip(views, titles, strict=True)
        )
        times = self.course.marks.columns["t"]
        low, high = self.course.interval
        own = [time for time in self.problem.times if low <= time <= high]
        moments = zip(*self.columns.values(), strict=True)
        scene = {
            "ends": [low, high],
            "start": own[0] if own else low,
            "columns": [*self.columns],
            "rows": [[_number(value) for value in row] for row in moments],
            "views": [view for view, _, _ in views],
            "wheel": None if self.problem.wheel is None else self.problem.wheel.radius,
            "words": {
                "play": texts.play, "pause": texts.pause, "decimal": notation.decimal,
                "s": plain_text(notation.units["s"]),
                "symbols": [[name, runs(LEGEND[name].symbol)] for name in self.columns],
            },
        }  # fmt: skip
        bar = (
            f'<div id="bar"><section><button id="play" aria-label="{escape(texts.play)}">▶</button>'
            f'<div id="way"><input id="slider" type="range" min="{low!r}" max="{high!r}" '
            f'step="any" aria-label="{escape(texts.time)}">'
            f"{slider_marks(list(enumerate(times.tolist())), texts.moment)}</div>"
            f'<label>t = <input id="exact" type="number" step="any"> {rich(notation.units["s"])}'
            f"</label>{speed_choice(texts.speed)}"
            f"{colour_switch(self.problem, texts.colour)}</section></div>"
        )
        return html_document(
            self.problem,
            lang=self.language.lang,
            body="\n".join((bar, f'<div id="views">{drawn}</div>', self._table())),
            credit=texts.made_point,
            letters=self.canvas.letters(),
            scene=scene,
            script=joined(*SCRIPT),
        )

    # Views -----------------------------------------------------------------------------------

    def _path(self) -> tuple[dict[str, Any], list[Complexes], Complexes]:
        """Return the trajectory: its data, its curves and its numbered points, mm."""
        curves = list(self.course.curves("x", "y"))
        whole = [*curves]
        wheel = self.problem.wheel
        if wheel is not None:
            centre = places_of(self.course.path, "xC", "yC")
            centre = centre[np.isfinite(centre)]
            for way in (1.0, -1.0, 1j, -1j):
                whole.append(centre + wheel.radius * way)
        per_mm = scale_of(np.concatenate(whole) if whole else np.zeros(0, complex))
        places = places_of(self.course.path, "x", "y") / per_mm
        arrows, tips = [], [np.concatenate(whole) / per_mm if whole else np.zeros(0, complex)]
        for of, style in (("v", "resultant"), ("a", "resultant"), ("at", "component"),
                          ("an", "component")):  # fmt: skip
            scale = self._vector_scale(of[0])
            arrows.append({"of": of, "style": style, "per_mm": scale})
            vectors = places_of(self.course.path, f"{of[0]}x", f"{of[0]}y")
            ends = places + vectors / scale
            near = np.abs(vectors) / scale <= 1.5 * VECTOR
            tips.append(ends[np.isfinite(ends) & near])
        letters = ["M", "K", *VECTORS, *(["C", "P"] if wheel is not None else [])]
        view = self._view("path", per_mm, np.concatenate(tips), arrows, letters)
        return view, [part / per_mm for part in curves], self.course.numbered("x", "y") / per_mm

    def _hodograph(self, plan: str) -> tuple[dict[str, Any], list[Complexes], Complexes]:
        """Return the hodograph of v or a from its pole."""
        curves = list(self.course.curves(f"{plan}x", f"{plan}y"))
        whole = np.concatenate([*curves, np.zeros(1, complex)])
        per_mm = scale_of(whole)
        arrows: list[dict[str, Any]] = [
            {"of": plan, "style": "resultant", "per_mm": per_mm, "pole": True}
        ]
        if plan == "v":  # the velocity of the end of v is a
            arrows.append({"of": "a", "style": "component", "per_mm": self._vector_scale("a")})
        else:
            arrows.append({"of": "at", "style": "component", "per_mm": per_mm, "pole": True})
            arrows.append({"of": "an", "style": "component", "per_mm": per_mm, "from": "at"})
        letters = [*(one["of"] for one in arrows), pole := str(POLES[plan])]
        view = self._view(plan, per_mm, whole / per_mm, arrows, letters) | {"pole": pole}
        numbered = self.course.numbered(f"{plan}x", f"{plan}y") / per_mm
        return view, [part / per_mm for part in curves], numbered

    def _vector_scale(self, plan: str) -> float:
        """Return the value of a millimetre of a vector that is drawn at the point."""
        sizes = self.columns[plan]
        sizes = sizes[np.isfinite(sizes)]
        common = float(np.percentile(sizes, COMMON)) if sizes.size else 0.0
        return common / VECTOR or 1.0

    def _view(
        self, name: str, per_mm: float, ends: Complexes, arrows: list[dict[str, Any]],
        letters: list[str],
    ) -> dict[str, Any]:  # fmt: skip
        labels = []
        for number, letter in enumerate(letters):
            text = self._typeset(letter)
            labels.append({"letter": letter, "centre": number, "width": text.width, "gap": 1.6,
                           "up": text.ascent, "down": text.descent})  # fmt: skip
        box = list(box_around(ends, MARGIN))
        return {"id": name, "per_mm": per_mm, "box": box, "arrows": arrows, "labels": labels}

    def _typeset(self, letter: str) -> Any:
        vector = VECTORS.get(letter)
        return typeset(letter if vector is None else vector_markup(vector), LETTER)

    def _figure(self, view: tuple[dict[str, Any], list[Complexes], Complexes], title: str) -> str:
        data, curves, numbered = view
        left, top, width, height = data["box"]
        axes = ""
        if data["id"] != "path" or left < 0 < left + width:
            axes += f'<path class="axis fine" d="M0 {top:.3f}V{top + height:.3f}"/>'
        if data["id"] != "path" or top < 0 < top + height:
            axes += f'<path class="axis fine" d="M{left:.3f} 0H{left + width:.3f}"/>'
        if data["id"] == "path" and self.problem.wheel is not None and self.problem.wheel.track:
            radius = abs(self.problem.wheel.track) / data["per_mm"]
            axes += f'<circle class="seg thin" r="{radius:.3f}"/>'
        lines = "".join(f'<path class="trace whole" d="{_path(part)}"/>' for part in curves)
        dots = "".join(
            f'<circle class="tip" cx="{p.real:.3f}" cy="{-p.imag:.3f}" r=".7"/>'
            for p in numbered
            if np.isfinite(p)
        )
        letters = "".join(
            f'<g id="label-{data["id"]}-{letter}" role="img" aria-label="{escape(letter)}">'
            f"{self.canvas.parts(self._typeset(letter).at(0j))}</g>"
            for letter in (one["letter"] for one in data["labels"])
        )
        box = " ".join(f"{value:.3f}" for value in data["box"])
        return (
            f'<figure><figcaption>{rich(title)}</figcaption><svg id="svg-{data["id"]}" '
            f'viewBox="{box}" role="group" aria-label="{escape(title)}">{axes}{lines}{dots}'
            f'<g class="lines"></g>{letters}</svg></figure>'
        )

    def _table(self) -> str:
        """Return the values of the moment."""
        texts, units = self.language.live, self.language.notation.units
        rows = "".join(
            f'<tr><th scope="row" id="name-{name}"></th><td><span id="cell-{name}"></span></td>'
            f"<td>{rich(units[LEGEND[name].unit])}</td></tr>"
            for name in self.columns
        )
        return (
            f'<section><h2>{escape(texts.at_moment)}</h2><div id="numbers"><table><tbody>{rows}'
            "</tbody></table></div></section>"
        )


def _path(points: Complexes) -> str:
    return "M" + "L".join(f"{p.real:.2f} {-p.imag:.2f}" for p in points)


def _number(value: float) -> float | None:
    return float(f"{value:.9g}") if np.isfinite(value) else None
