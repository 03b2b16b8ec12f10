"""The page of a moving mechanism: one HTML file without a server, a network or a library.

Contents of a problem file are escaped text or data, never source.
"""

# no messages: HTML

from __future__ import annotations

from collections.abc import Iterator
from html import escape
from typing import Any

from planmethod.mechanism.model import FRAME
from planmethod.note.narrate.naming import point_name, scale_inscription
from planmethod.note.wording import get_language
from planmethod.plans.build import Quantity
from planmethod.plans.model import Start, Turns
from planmethod.problem.model import Problem
from planmethod.problem.quantities import TURNING, QuantityKind
from planmethod.render.backends.canvas import Options
from planmethod.render.backends.svg import SvgCanvas
from planmethod.render.ink.drawing import Drawing
from planmethod.render.ink.pens import PenSet
from planmethod.render.ink.typeset import typeset
from planmethod.render.live.centres import LiveCentres
from planmethod.render.live.document import (
    colour_switch,
    html_document,
    joined,
    rich,
    runs,
    slider_marks,
    speed_choice,
)
from planmethod.render.live.scene import LETTER, SMALL, LiveScene, LiveView, reasons_of
from planmethod.render.live.sizes import LiveSizes
from planmethod.render.live.tolerances import tolerances

SCRIPT = (
    "numbers", "geometry", "svg", "motion", "labels", "views", "diagrams", "centres", "marks",
    "compare", "guess", "sizes", "skeleton", "live",
)  # fmt: skip
"""Modules of the page's script, each after those that it imports."""


def live_page(problem: Problem, lang: str) -> str:
    """Return the page of a problem, an HTML document.

    Parameters
    ----------
    lang : str
        Language of all its texts.

    Raises
    ------
    StructureError, ProblemError, AssemblyError, SelfCheckError
    """
    return _Page(problem, lang).html()


class _Page:
    def __init__(self, problem: Problem, lang: str) -> None:
        self.problem, self.language = problem, get_language(lang)
        self.scene = LiveScene(problem, self.language)
        self.centres = LiveCentres(self.scene.shown) if problem.drive.rate else None
        if self.centres is not None:
            self.scene.views[0].labels += [
                {"centre": number, "text": symbol, "height": SMALL}
                for number, symbol in self.centres.marked.items()
            ]
        self.sizes = LiveSizes.of(self.scene)
        self.tolerances = tolerances(self.scene)
        self.canvas = SvgCanvas(Options())
        self.canvas.open(Drawing(0.0, 0.0, pens=PenSet(is_coloured=True)))

    def html(self) -> str:
        """Return the document."""
        return html_document(
            self.problem,
            lang=self.language.lang,
            body="\n".join(
                (self._bar(), self._views(), self._compared(), self._sizes(), self._numbers())
            ),
            credit=self.language.live.made,
            letters=self.canvas.letters(),
            scene=self._scene(),
            script=self._tape() + self.scene.loads() + self._centre_numbers() + joined(*SCRIPT),
        )

    def _tape(self) -> str:
        """Return the function of the outputs, of all lengths where they may change."""
        if self.sizes is None:
            return self.scene.sweep.javascript()
        return self.sizes.dragged.runner.javascript()

    def _bar(self) -> str:
        texts, drive, low, high = self.language.live, self.problem.drive, *self.scene.driver_range
        label = rich(drive.coordinate.symbol)
        unit = rich(self.language.notation.units[drive.coordinate.unit])
        follows = centres = ""
        if self.centres is not None:
            text = escape(texts.centres)
            centres = f'<label><input id="centres" type="checkbox"> {text}</label>'
        if self.scene.flywheel is not None:
            text = rich(texts.follows.format(speed=f"ω_{{{drive.link}}}(φ)"))
            follows = f'<label><input id="follows" type="checkbox"> {text}</label>'
        return (
            f'<div id="bar"><section><button id="play" aria-label="{escape(texts.play)}">▶</button>'
            f'<div id="way"><input id="slider" type="range" min="{low!r}" max="{high!r}" '
            f'step="any" aria-label="{escape(texts.driver)}">{self._marks()}</div>'
            f'<label>{label} = <input id="exact" type="number" '
            f'step="any"> {unit}</label>{speed_choice(texts.speed)}'
            '</section><section id="why" role="status" hidden></section></div>'
            '<section id="how"><button id="hold" aria-pressed="false">'
            f"{escape(texts.hold)}</button>"
            '<label><input id="trace" type="checkbox" checked> '
            f"{escape(texts.traces)}</label>{colour_switch(self.problem, texts.colour)}"
            f'{centres}<label><input id="hides" type="checkbox"> {escape(texts.hides)}</label>'
            f"{follows}</section>{self._guess()}"
        )

    def _marks(self) -> str:
        """Return the positions of the task, with their numbers."""
        drive, (low, high) = self.problem.drive, self.scene.driver_range
        places = [
            (number, float(own) % high if drive.goes_round else float(own))
            for number, own in enumerate(drive.positions)
        ]
        own = [(number, place) for number, place in places if low <= place <= high]
        return slider_marks(own, self.language.live.position)

    def _guess(self) -> str:
        """Return the form of a value that a reader has measured."""
        texts, sigma = self.language.live, self.tolerances["sigma"]
        choice = "".join(
            f'<option value="{number}">{escape(_strip_markup(self._symbol(one)))}</option>'
            for number, one in enumerate(self.scene.quantities)
            if number in sigma and one.kind is not QuantityKind.PLACE
        )
        first = next((k for k in sigma if self.scene.quantities[k].kind.written_unit), 0)
        unit = rich(self._unit(self.scene.quantities[first]))
        return (
            f'<section id="guess" hidden><form id="asked"><label>{escape(texts.measured)} '
            f'<select id="guessed">{choice}</select></label> = <input id="measured" type="text" '
            f'inputmode="decimal" autocomplete="off" aria-label="{escape(texts.value)}"> '
            f'<span id="guess-unit">{unit}</span> <button>{escape(texts.judge)}</button>'
            f'<output id="verdict" role="status"></output></form></section>'
        )

    def _compared(self) -> str:
        """Return the table of differences of two positions, which the script fills."""
        texts = self.language.live
        heads = (texts.quantity, "", "", texts.difference, texts.unit)
        cells = "".join(f'<th scope="col">{escape(head)}</th>' for head in heads)
        return (
            f'<section id="compared" hidden><h2>{escape(texts.compared)}</h2>'
            '<div class="scrolled" tabindex="0" role="region" '
            f'aria-label="{escape(texts.compared)}">'
            f"<table><thead><tr>{cells}</tr></thead><tbody></tbody></table></div></section>"
        )

    def _sizes(self) -> str:
        """Return the sliders of the numbers that may be changed, or why there are none."""
        texts, units = self.language.live, self.language.notation.units
        head = f'<section><details id="sizes"><summary>{escape(texts.sizes)}</summary>'
        if self.sizes is None:
            return f'{head}<p class="hint">{escape(texts.no_sizes)}</p></details></section>'
        rows = ""
        for k, one in enumerate(self.sizes.sliders()):
            low, high = one["ends"]
            name = escape("".join(text for text, _ in one["label"]))
            label = "".join(
                f"<{tag}>{escape(text)}</{tag}>" if tag else escape(text)
                for text, tag in one["label"]
            )
            ends = f'min="{low:.6g}" max="{high:.6g}" step="any" value="{one["value"]:.8g}"'
            rows += (
                f'<div class="size"><span>{label}</span>'
                f'<input id="size-slider-{k}" type="range" {ends} aria-label="{name}">'
                f'<input id="size-field-{k}" type="number" step="any" value="{one["value"]:.8g}" '
                f'aria-label="{name}"> <span>{rich(units[one["unit"]])}</span></div>'
            )
        return (
            f'{head}<p class="hint">{escape(texts.sizes_hint)}</p><div id="size-rows">{rows}</div>'
            f'<button id="first-sizes" disabled>{escape(texts.first_sizes)}</button>'
            "</details></section>"
        )

    # Pictures --------------------------------------------------------------------------------

    def _views(self) -> str:
        return '<div id="views">' + "\n".join(map(self._view, self.scene.views)) + "</div>"

    def _view(self, view: LiveView) -> str:
        notation, convention = self.language.notation, self.problem.scales.convention
        box = " ".join(f"{value:.3f}" for value in view.box)
        scheme = view.id == "scheme"
        mu = f"{self.language.live.sheet} {scale_inscription(view.scale, convention, notation)}"
        labels = "".join(
            f'<g id="label-{view.id}-{number}" role="img" '
            f'aria-label="{escape(_strip_markup(one["text"]))}">{self._lettered(view, one)}</g>'
            for number, one in enumerate(view.labels)
        )
        return (
            f"<figure><figcaption>{rich(view.title)} "
            f'<span>{rich(mu)}</span> <span id="zoom-{view.id}"></span></figcaption>'
            f'<svg id="svg-{view.id}" viewBox="{box}" tabindex="0" role="group" '
            f'aria-label="{escape(_strip_markup(view.title))}"><g class="ghosts"></g>'
            f'<g class="traces"></g>{self._drawn() if scheme else ""}'
            f'<g class="lines"></g>{labels}</svg><output id="told-{view.id}"></output></figure>'
        )

    def _lettered(self, view: LiveView, label: dict[str, Any]) -> str:
        """Return the letters of an inscription from its start, and note their size."""
        text = typeset(label.pop("text"), label.pop("height", LETTER))
        label |= {"width": text.width, "up": text.ascent, "down": text.descent}
        label["gap"] = 2.6 if view.id == "scheme" else 1.4
        return self.canvas.parts(text.at(0j))

    def _drawn(self) -> str:
        """Return the parts of the scheme, and the group of the lines that replace them."""
        parts = "".join(self._parts())
        return f'<g class="drawn">{parts}</g><g class="skeleton"></g>'

    def _parts(self) -> Iterator[str]:
        """Yield the parts of the scheme, those of a link in its own axes."""
        for number, part in enumerate(self.scene.parts):
            drawn = self.canvas.parts(part.items)
            if part.link == FRAME:
                yield f"<g>{drawn}</g>"
                continue
            start, turn = self.scene.axes(part)
            back = f"rotate({turn:.6f}) translate({-start.real:.5f} {start.imag:.5f})"
            yield f'<g id="part-{number}"><g transform="{back}">{drawn}</g></g>'
        for number, spring in enumerate(self.scene.springs):
            yield f'<g id="spring-{number}">{self.canvas.parts(spring.items)}</g>'

    def _centre_numbers(self) -> str:
        """Return the function of the instant centres; empty of a driver at rest."""
        if self.centres is None:
            return ""
        rows = [row.name for row in self.scene.sweep.rows]
        return self.centres.javascript(self.problem, self.scene.construction, rows)

    # Numbers ---------------------------------------------------------------------------------

    def _numbers(self) -> str:
        texts, note = self.language.live, self.language.note
        tables: dict[str, list[str]] = {}
        for number, quantity in enumerate(self.scene.quantities):
            kind = quantity.kind
            title = (
                texts.forces if kind.is_force
                else note.table_links if kind in TURNING
                else note.table_sliding if kind.is_number
                else note.table_points
            )  # fmt: skip
            tables.setdefault(title, []).append(self._row(number, quantity))
        if self.scene.flywheel is not None:
            tables[texts.steady] = [self._steady_row()]
        text = "".join(
            f"<table><caption>{escape(title)}</caption><tbody>{''.join(rows)}</tbody></table>"
            for title, rows in tables.items()
        )
        return (
            f'<section><h2>{escape(texts.diagrams)}</h2><p class="hint">{escape(texts.choose)}</p>'
            f'<div id="diagrams"></div></section>\n<section><h2>{escape(texts.numbers)}</h2>'
            f'<div id="numbers">{text}</div></section>'
        )

    def _steady_row(self) -> str:
        """Return the row of the crank's speed in the steady motion, after all quantities."""
        number, row = len(self.scene.quantities), len(self.scene.sweep.rows) + 1
        symbol = rich(f"ω_{{{self.problem.drive.link}}}(φ)")
        return (
            f'<tr><th><button id="choose-{number}" aria-pressed="false">{symbol}</button></th>'
            f'<td><span id="cell-{row}" data-row="{row}"></span></td>'
            f"<td>{rich(self.language.notation.units['1/s'])}</td></tr>"
        )

    def _unit(self, quantity: Quantity) -> str:
        unit = quantity.kind.written_unit
        return self.language.notation.units[unit] if unit else ""

    def _row(self, number: int, quantity: Quantity) -> str:
        unit = rich(self._unit(quantity))
        symbol = rich(self._symbol(quantity))
        first = self.scene.row(quantity.columns[0])
        cells = [f'<span id="cell-{first + k}" data-row="{first + k}"></span>' for k in (0, 1)]
        pair = f"<span>x = {cells[0]};</span> <span>y = {cells[1]}</span>"
        if quantity.kind is QuantityKind.PLACE:
            return f"<tr><th>{symbol}</th><td>{pair}</td><td>{unit}</td></tr>"
        value = cells[0]
        if not quantity.kind.is_number and len(quantity.columns) > 1:
            value = f'<span id="size-{number}"></span><small>{pair}</small>'
        return (
            f'<tr><th><button id="choose-{number}" aria-pressed="false">{symbol}</button></th>'
            f"<td>{value}</td><td>{unit}</td></tr>"
        )

    def _symbol(self, quantity: Quantity) -> str:
        balancing, notation = self.problem.balancer, self.language.notation
        roles = {"dr": balancing.symbol, "lever": f"lever {balancing.quantity}"}
        if quantity.kind.is_force and quantity.of in roles:
            return notation.symbol(roles[quantity.of])
        return (
            point_name(quantity.symbol) if quantity.kind is QuantityKind.PLACE else quantity.symbol
        )

    # Data ------------------------------------------------------------------------------------

    def _cam(self) -> dict[str, Any] | None:
        """Return the law by which a cam's follower drives."""
        drive = self.problem.drive
        if drive.cam_drive is None:
            return None
        return {
            "pieces": [piece._asdict() for piece in drive.cam_drive.pieces],
            "lowest": drive.cam_drive.lowest,
            "degrees": drive.cam_drive.turns,
            "rate": drive.rate,
        }

    def _scene(self) -> dict[str, Any]:
        scene, drive, notation, texts = (
            self.scene,
            self.problem.drive,
            self.language.notation,
            self.language.live,
        )
        closings = scene.sweep.branches.values()
        chosen = scene.chosen()
        forces = scene.rows_of(lambda kind: kind.is_force)
        return {
            "rows": [row.name for row in scene.sweep.rows],
            "way": list(scene.driver_range),
            "start": scene.start,
            "crank": drive.goes_round,
            "sense": -1 if drive.rate < 0 else 1,
            "symbol": runs(drive.coordinate.symbol),
            "unit": ("" if drive.goes_round else " ")
            + _strip_markup(notation.units[drive.coordinate.unit]),
            "branches": [
                {"places": one.tracked.places, "values": one.values, "turn": one.tracked.period}
                if isinstance(one, Start)
                else {"jumps": one.places, "counts": one.counts, "low": one.low,
                      "turn": one.period, "net": one.per_period}
                if isinstance(one, Turns)
                else {"changes": list(one.changes), "start": one.start, "turn": one.period}
                for one in closings
            ],
            "cam": self._cam(),
            "loads": 0 if scene.sweep.loads is None else len(scene.sweep.loads.names),
            "places": scene.rows_of(lambda kind: kind is QuantityKind.PLACE),
            "forces": forces,
            "reasons": [runs(text) for text in self._reasons()],
            "parts": [
                {"id": f"part-{k}", "at": scene.place(scene.anchor_point(part.link)),
                 "turn": scene.row(f"{part.link}.phi_deg")}
                for k, part in enumerate(scene.parts) if part.link != FRAME
            ],
            "springs": [
                {"id": f"spring-{k}", "length": spring.length,
                 "ends": [self._spring_end(end) for end in spring.ends]}
                for k, spring in enumerate(scene.springs)
            ],
            "views": [self._view_data(view) for view in scene.views],
            "quantities": [
                {
                    "rows": [scene.row(column) for column in one.columns],
                    "vector": len(one.columns) > 1,
                    "symbol": runs(self._symbol(one)),
                    "unit": runs(self._unit(one)),
                    "place": one.kind is QuantityKind.PLACE,
                    "angle": one.kind is QuantityKind.DIRECTION,
                    "chosen": one.label in chosen,
                }
                for one in scene.quantities
            ] + self._steady(),
            "motion": scene.motion(),
            "tolerances": self.tolerances,
            "sizes": None
            if self.sizes is None
            else self.sizes.numbers | {"sliders": self.sizes.sliders()},
            "words": {
                "play": texts.play, "pause": texts.pause, "touch": texts.touch,
                "nearest": texts.nearest, "unknown": texts.unknown,
                "unknown_sizes": texts.unknown_sizes, "right": texts.right,
                "sense": texts.sense, "near": texts.near, "wrong": texts.wrong,
                "tolerance": texts.tolerance, "exactly": texts.exactly,
                "no_number": texts.no_number, "no_tolerance": texts.no_tolerance,
                "decimal": notation.decimal,
                "mm": f"{_strip_markup(notation.units['mm'])} {texts.sheet}",
            },
        }  # fmt: skip

    def _reasons(self) -> list[str]:
        if self.sizes is None:
            return self.scene.reasons()
        return reasons_of(self.scene.sweep, self.language, self.sizes.dragged.guards)

    def _spring_end(self, end: str | complex) -> dict[str, Any]:
        """Return the outputs of an end of a spring, or its fixed place."""
        if isinstance(end, complex):
            return {"at": [end.real, end.imag]}
        return {"ref": self.scene.place(end)}

    def _steady(self) -> list[dict[str, Any]]:
        if self.scene.flywheel is None:
            return []
        return [
            {
                "rows": [len(self.scene.sweep.rows) + 1],
                "vector": False,
                "symbol": runs(f"ω_{{{self.problem.drive.link}}}(φ)"),
                "unit": runs(self.language.notation.units["1/s"]),
                "chosen": True,
                "steady": True,
            }
        ]

    def _view_data(self, view: LiveView) -> dict[str, Any]:
        segments = [
            {k: runs(v) if k in ("name", "symbol") else v for k, v in one.items()}
            for one in view.segments
        ]
        told: dict[str, Any] = {
            "id": view.id,
            "per_mm": view.per_mm,
            "mu": view.scale.per_mm,
            "unit": runs(self.language.notation.units[view.scale.unit]),
            "box": list(view.box),
            "segments": segments,
            "labels": view.labels,
            "turns": view.turns,
            "pushes": view.pushes,
            "fixed": self.scene.fixed if view.id == "scheme" else [],
            "blocks": self.scene.blocks if view.id == "scheme" else [],
            "rods": self._rods() if view.id == "scheme" else [],
            "supports": [
                [left, -high, right, -low] for left, low, right, high in self.scene.supports
            ]
            if view.id == "scheme"
            else [],
            "zooms": view.id != "scheme",
        }
        if view.id == "scheme" and self.centres is not None:
            told["centres"] = self.centres.data()
        origin = self.scene.construction.draft.origin
        if view.id == "scheme" and origin:
            told["origin"] = [origin.real, origin.imag]
        return told

    def _rods(self) -> list[dict[str, Any]]:
        """Return the lines of the moving parts that inscriptions keep clear of."""
        return [
            {
                "at": self.scene.place(self.scene.anchor_point(part.link)),
                "turn": self.scene.row(f"{part.link}.phi_deg"),
                "bars": [
                    [round(v, 3) for end in bar for v in (end.real, end.imag)]
                    for bar in self.scene.bars(part)
                ],
            }
            for part in self.scene.parts
            if part.link != FRAME
        ]


def _strip_markup(markup: str) -> str:
    return "".join(text for text, _ in runs(markup))
