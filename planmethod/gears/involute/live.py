"""The page of two wheels in mesh: they turn, and the contact travels along the line of action.

Teeth are exact: their fillets and flanks are those of the sheet (зацепление в движении).
"""

# no messages: HTML

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from math import ceil, degrees

import numpy as np

from planmethod.gears.involute.geometry import MeshingProblem, Points
from planmethod.gears.involute.meshpicture import MeshView
from planmethod.gears.involute.results import SolvedMeshing
from planmethod.note.wording import Language, get_language
from planmethod.render.backends.canvas import Options
from planmethod.render.backends.svg import SvgCanvas
from planmethod.render.ink.drawing import Drawing
from planmethod.render.ink.pens import PenSet
from planmethod.render.ink.typeset import typeset
from planmethod.render.live.document import (
    colour_switch,
    html_document,
    joined,
    rich,
    speed_choice,
)

SCRIPT = ("numbers", "svg", "driver", "meshing")
"""Modules of the page's script, each after those that it imports."""

POINTS = 17
"""Points of a flank and of a fillet."""

NEAR = 3.2
"""Height of the view of the contact, pitches of the base circle."""

LETTER = 0.05
"""Height of letters, as a share of the height of a view."""


def live_page(problem: MeshingProblem, lang: str) -> str:
    """Return the page of a meshing, an HTML document."""
    return _MeshPage(problem, get_language(lang)).html()


class _MeshPage:
    def __init__(self, problem: MeshingProblem, language: Language) -> None:
        self.problem, self.language = problem, language
        self.solved = SolvedMeshing(problem)
        unit = MeshView(self.solved, 1.0, (0.0, 0.0))
        self.view = MeshView(self.solved, 1.0, unit.radii)
        self.canvas = SvgCanvas(Options())
        self.canvas.open(Drawing(0.0, 0.0, pens=PenSet(is_coloured=True)))
        pair, contact = self.solved.pair, self.solved.contact
        self.base = pair.d_b[0] / 2
        self.pole = float(self.base * np.tan(float(pair.alpha_w)))
        self.start, self.end = float(contact.start), float(contact.end)
        self.most = max(1, ceil((self.end - self.start) / pair.p_b + 1e-9))

    def html(self) -> str:
        """Return the document."""
        texts, pair = self.language.live, self.solved.pair
        teeth = [int(z) for z in self.problem.z]
        along = self.view.action_direction
        # A contact goes on to N_2: wheel 1 turns clockwise, wheel 2 against it, a ring with it.
        turns = (1.0, -pair.side * teeth[0] / teeth[1])
        scene = {
            "wheels": [
                {"y": -self.view.centre(wheel).imag, "ratio": turns[wheel]} for wheel in (0, 1)
            ],
            "teeth": [teeth[0], teeth[1] * pair.side],
            "base": float(self.base),
            "pole": self.pole,
            "start": self.start,
            "end": self.end,
            "pitch": float(pair.p_b),
            "line": float(pair.line),
            "along": [along.real, along.imag],
            "most": self.most,
            "words": {
                "play": texts.play,
                "pause": texts.pause,
                "decimal": self.language.notation.decimal,
            },
        }
        bar = (
            f'<div id="bar"><section><button id="play" aria-label="{escape(texts.play)}">▶</button>'
            '<div id="way"><input id="slider" type="range" min="0" max="360" step="any" value="0" '
            f'aria-label="{escape(texts.wheel_turned)}"></div>'
            f'<label>{rich("φ_{1}")} = <input id="exact" type="number" step="any"> °</label>'
            f"{speed_choice(texts.speed)}"
            f"{colour_switch(self.problem, texts.colour)}</section></div>"
        )
        return html_document(
            self.problem,
            lang=self.language.lang,
            body="\n".join((bar, f'<div id="views">{self._views()}</div>', self._table())),
            credit=texts.made_mesh,
            letters=self.canvas.letters(),
            scene=scene,
            script=joined(*SCRIPT),
        )

    # Views -----------------------------------------------------------------------------------

    def _views(self) -> str:
        texts = self.language.live
        wide, top, bottom = 0.0, 0.0, 0.0
        for wheel, tooth in enumerate(self.solved.teeth):
            outer = max(abs(tooth.size("d_a")), abs(tooth.size("d_f"))) / 2 * 1.02
            middle = -self.view.centre(wheel).imag
            wide = max(wide, outer)
            top, bottom = min(top, middle - outer), max(bottom, middle + outer)
        whole = (-wide, top, 2 * wide, bottom - top)
        high = NEAR * self.solved.pair.p_b
        line = np.array([self._on_line(rho) for rho in (self.start, self.end)])
        centre = complex(line.mean())
        across = max(1.3 * high, 1.25 * float(np.ptp(line.real)))
        near = (centre.real - across / 2, centre.imag - across / 2.6, across, across / 1.3)
        wheels = "".join(
            f'<g class="wheel-{wheel}"><path class="seg fine" d="{self._outline(wheel)}"/>'
            f'<path class="seg fine" d="{self._mark(wheel)}"/></g>'
            for wheel in (0, 1)
        )
        return self._figure(texts.near_contact, near, wheels) + self._figure(
            texts.both_wheels, whole, wheels
        )

    def _figure(self, title: str, box: tuple[float, float, float, float], wheels: str) -> str:
        stroke_width = box[3] / 300
        shown = " ".join(f"{value:.3f}" for value in box)
        dots = f'<circle class="dot contact" r="{2.6 * stroke_width:.3f}"/>' * self.most
        letters = "".join(self._letters(box))
        return (
            f'<figure><figcaption>{escape(title)}</figcaption><svg viewBox="{shown}" role="group" '
            f'aria-label="{escape(title)}" stroke-width="{stroke_width:.3f}">'
            f"{self._circles()}{wheels}{self._line(stroke_width)}{letters}{dots}</svg></figure>"
        )

    def _outline(self, wheel: int) -> str:
        """Return the teeth of a wheel about its own axis, turned as they touch in P."""
        tooth = self.solved.teeth[wheel]
        one = tooth.outline(POINTS)[:-1]  # the next tooth begins where it ends
        turned = [one * np.exp(1j * self.view.axis(wheel, k)) for k in range(tooth.z)]
        return _path(np.concatenate(turned)) + "Z"

    def _mark(self, wheel: int) -> str:
        """Return a line that shows how a wheel turns."""
        tooth = self.solved.teeth[wheel]
        inner = abs(tooth.size("d_f")) / 2
        direction = np.exp(1j * self.view.axis(wheel, 0))
        ends = (1.02, 1.06) if tooth.side < 0 else (0.0, 0.95)
        return _path(np.array([inner * share * direction for share in ends]))

    def _circles(self) -> str:
        """Return the working circles and the base circles."""
        found = ""
        for wheel, tooth in enumerate(self.solved.teeth):
            y = -self.view.centre(wheel).imag
            for size, cls in (("d_w", "axis"), ("d_b", "grid")):
                radius = abs(tooth.size(size)) / 2
                found += f'<circle class="{cls} fine" cy="{y:.4f}" r="{radius:.4f}"/>'
        return found

    def _on_line(self, rho: float) -> complex:
        """Return a point of the line of action, y down."""
        return complex(np.conj(self.view.on_line(rho)))

    def _line(self, stroke_width: float) -> str:
        """Return the line of action with its parts where one pair, and where two are in contact."""
        pitch, line = float(self.solved.pair.p_b), float(self.solved.pair.line)
        far = max(line, self.end)
        found = _stroke("axis fine", self._on_line(0.0), self._on_line(far))
        single = (self.end - pitch, self.start + pitch)
        found += f'<g stroke-width="{3 * stroke_width:.3f}">'
        found += _stroke("seg contact-path", self._on_line(self.start), self._on_line(self.end))
        if self.start < single[0] < single[1] < self.end:
            found += _stroke("seg one-pair", *map(self._on_line, single))
        return found + "</g>"

    def _letters(self, box: tuple[float, float, float, float]) -> Iterator[str]:
        """Yield the letters of the points that are within a box, where they do not collide."""
        height, line = LETTER * box[3], float(self.solved.pair.line)
        left, top, width, high = box
        places = {"P": 0j, "B_{1}": self._on_line(self.start), "B_{2}": self._on_line(self.end),
                  "N_{1}": self._on_line(0.0)}  # fmt: skip
        if self.solved.pair.side > 0:
            places["N_{2}"] = self._on_line(line)
        if high > 4 * NEAR * self.solved.pair.p_b:
            places = {f"O_{{{k + 1}}}": -1j * self.view.centre(k).imag for k in (0, 1)}
        for name, place in places.items():
            inside = 0.06 < (place.real - left) / width < 0.94
            if not (inside and 0.06 < (place.imag - top) / high < 0.94):
                continue
            text = typeset(name, height)
            up = 0.5 if name in ("P", "B_{2}", "N_{2}") else -1.4
            at = place.conjugate() + complex(-text.width / 2, up * height)
            yield (
                f'<circle class="tip" cx="{place.real:.4f}" cy="{place.imag:.4f}" '
                f'r="{high / 220:.4f}"/>{self.canvas.parts(text.at(at))}'
            )

    # Numbers ---------------------------------------------------------------------------------

    def _table(self) -> str:
        """Return ε and the values of each contact."""
        texts, names, notation = (
            self.language.live,
            self.language.meshing["names"],
            self.language.notation,
        )
        pair = self.solved.pair
        drawn = self.solved.contact.overlap(pair)
        fixed = [
            (names["alpha_w"], "α_{w}", degrees(float(pair.alpha_w)), "°"),
            (names["a_w"], "a_{w}", abs(float(pair.a_w)), notation.units["mm"]),
            (names["epsilon_alpha"], "ε_{α}", float(pair.epsilon), ""),
        ]
        if abs(drawn - float(pair.epsilon)) > 1e-6:
            fixed.append((names["epsilon_active"], "ε", drawn, ""))
        rows = "".join(
            f'<tr><th scope="row">{escape(name)}, {rich(symbol)}</th>'
            f"<td>{rich(notation.computed(value))}</td><td>{rich(unit)}</td></tr>"
            for name, symbol, value, unit in fixed
        )
        rows += "".join(
            f'<tr><th scope="row">{rich(f"φ_{{{k + 1}}}")}</th><td><span id="turned-{k}"></span>'
            "</td><td>°</td></tr>"
            for k in (0, 1)
        )
        rows += (
            f'<tr><th scope="row">{escape(texts.pairs)}</th><td><span id="pairs"></span></td>'
            "<td></td></tr>"
        )
        mm = rich(notation.units["mm"])
        heads = (
            escape(texts.contact), f"{rich('ρ_{1}')}, {mm}", f"{rich('ρ_{2}')}, {mm}",
            rich("ϑ_{1}"), rich("ϑ_{2}"),
        )  # fmt: skip
        head = "".join(f'<th scope="col">{one}</th>' for one in heads)
        body = "".join(
            f'<tr><th scope="row">{k + 1}</th>'
            + "".join(
                f'<td><span id="{name}-{k}"></span></td>'
                for name in ("rho1", "rho2", "theta1", "theta2")
            )
            + "</tr>"
            for k in range(self.most)
        )
        return (
            f'<section><div id="numbers"><table><caption>{escape(texts.mesh_values)}</caption>'
            f"<tbody>{rows}</tbody></table><table><caption>{escape(texts.contacts)}</caption>"
            f"<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table></div>"
            f'<p class="hint">{escape(texts.contacts_hint)}</p></section>'
        )


def _path(points: Points) -> str:
    """Return a path, y down."""
    return "M" + "L".join(f"{p.real:.3f} {-p.imag:.3f}" for p in points)


def _stroke(cls: str, start: complex, end: complex) -> str:
    """Return a line between two points, y down."""
    ends = f"M{start.real:.4f} {start.imag:.4f}L{end.real:.4f} {end.imag:.4f}"
    return f'<path class="{cls}" d="{ends}"/>'
