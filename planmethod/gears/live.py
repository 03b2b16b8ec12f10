"""The page of a turning gear train: view along the axes, velocity diagrams, angles of rotation.

Speeds are constant, so the page stores for every body its degrees per degree of the input. Teeth
are drawn where their numbers are known; those of planets are placed as if assembled from the first
central wheel on, so that an impossible set shows as one.
"""

# no messages: HTML

from __future__ import annotations

import cmath
from collections.abc import Iterator, Mapping
from fractions import Fraction
from functools import cached_property
from html import escape
from importlib.resources import files
from math import ceil, pi, radians
from typing import Any

from msgspec.structs import replace

from planmethod.construct.drafting import PROFILES
from planmethod.errors import Fault, ProblemError
from planmethod.gears.construction import construct, read
from planmethod.gears.model import DiagramSettings, GearProblem, Mesh, MeshKind
from planmethod.gears.motion import draw, solve_motion
from planmethod.gears.scheme import Rim, SchemeData
from planmethod.gears.views import angular, linear
from planmethod.languages import translate
from planmethod.note.wording import get_language
from planmethod.render.backends.canvas import Options
from planmethod.render.backends.svg import SvgCanvas
from planmethod.render.ink.drawing import Drawing
from planmethod.render.ink.pens import PenSet
from planmethod.render.ink.typeset import typeset
from planmethod.render.layout.block import Picture
from planmethod.render.live.document import colour_switch, html_document, rich, speed_choice
from planmethod.render.pictures.lettered import lettered

EXTENT = 200.0
"""Height of the view along the axes, mm."""

LETTER = 5.0
"""Height of letters, mm."""

FLANKS = ((-1.25, 0.31), (0.0, 0.25), (1.0, 0.13))
"""A tooth as it is drawn: above the pitch circle, in modules, half its width there, in pitches."""

RIM = 3.0
"""Width of the rim of a wheel with inner teeth, modules."""

MAX_TEETH = 400
"""Teeth of a wheel that are drawn; of one with more the circles alone."""

MAX_TURNS = 20
"""Turns of the input on the slider, each way."""

PACE = 60.0
"""Of the quickest wheel on the page, degrees a second."""


def live_page(problem: GearProblem, lang: str) -> str:
    """Return the page of a train, an HTML document.

    Raises
    ------
    ProblemError
        The train cannot be solved, or does not turn as wheels with parallel axes do.
    """
    return _TrainPage(problem, lang).html()


class _TrainPage:
    def __init__(self, problem: GearProblem, lang: str) -> None:
        self.problem, self.language = problem, get_language(lang)
        self.motion = solve_motion(problem)
        self.train = self.motion.train
        self._require_parallel_axes()
        size = SchemeData(self.motion, 1.0)
        reach = max(map(self._reach(size), self._rims(size)))
        self.scheme = SchemeData(self.motion, EXTENT / 2.0 / reach)
        self.canvas = SvgCanvas(Options())
        self.canvas.open(Drawing(0.0, 0.0, pens=PenSet(is_coloured=True)))

    def _require_parallel_axes(self) -> None:
        """Reject trains without parallel meshing axes, and planets carried by planets."""
        kinds = {mesh.kind for mesh in self.train.meshes}
        odd = kinds - {MeshKind.EXTERNAL, MeshKind.INTERNAL}
        scheme = SchemeData(self.motion, 1.0)
        nested = [body for body, carrier in scheme.over.items() if carrier in scheme.over]
        if odd or nested or scheme.undrawn:
            message = "the live page shows only wheels in mesh on parallel axes"
            hint = translate(
                "To draw the train on a sheet: planmethod sheet {}", self.problem.source_file
            )
            raise ProblemError(self.problem.name, [Fault("gears.meshes", message, hint)])

    @staticmethod
    def _rims(scheme: SchemeData) -> list[Rim]:
        """Return the wheels, each once, the large ones first."""
        rims = {rim.label: rim for column in scheme.columns for rim in column}
        return sorted(rims.values(), key=lambda rim: -rim.radius)

    @staticmethod
    def _reach(scheme: SchemeData) -> Any:
        return lambda rim: abs(rim.centre) + 1.15 * rim.radius

    # Motion ----------------------------------------------------------------------------------

    @cached_property
    def input(self) -> str:
        """The body whose rotation the slider sets: the first input that turns."""
        turning = [body for body, speed in self.train.inputs.items() if speed]
        return turning[0] if turning else max(self.motion.speeds, key=self._speed)

    def _speed(self, body: str) -> float:
        return abs(float(self.motion.speeds[body]))

    def ratio(self, body: str) -> float:
        """Return the rotation of a body per degree of the input."""
        return float(self.motion.speeds[body] / self.motion.speeds[self.input])

    def _axis_motion(self, body: str, start: float = 0.0) -> dict[str, float]:
        """Return the place of a body's axis: its distance, from which height, and its rotation."""
        heights, carrier = self.scheme.heights, self.scheme.over.get(body)
        if carrier is None:
            return {"base": -heights[body], "far": 0.0, "start": 0.0, "carried": 0.0}
        base = heights[carrier]
        far = heights[body] - base
        place = 90.0 if far > 0 else -90.0
        return {
            "base": -base, "far": abs(far), "start": place + start, "carried": self.ratio(carrier),
        }  # fmt: skip

    # Teeth -----------------------------------------------------------------------------------

    def teeth(self, rim: Rim) -> int:
        """Return the number of drawn teeth of a wheel; 0 where it is not known."""
        size = self.motion.axes.sizes[rim.label]
        whole = self.train.counted(rim.label) and size.denominator == 1
        return int(size) if whole and size <= MAX_TEETH else 0

    @cached_property
    def phases(self) -> Mapping[str, float]:
        """Angle of a tooth of each wheel, degrees from its own axis, so that they mesh."""
        rims = {rim.label: rim for rim in self._rims(self.scheme)}
        found: dict[str, float] = {}
        left = [
            m for m in self.train.meshes if self.teeth(rims[m.first]) * self.teeth(rims[m.second])
        ]
        while left:
            mesh = next((m for m in left if m.first in found or m.second in found), left[0])
            left.remove(mesh)
            one, other = (mesh.first, mesh.second)[:: -1 if mesh.second in found else 1]
            found.setdefault(one, 0.0)
            found.setdefault(other, self._meshed(mesh, rims[one], rims[other], found[one]))
        return found

    def _meshed(self, mesh: Mesh, one: Rim, mate: Rim, phase: float) -> float:
        """Return the phase of a wheel whose gap takes a tooth of another."""
        up = mate.centre > one.centre
        if mesh.kind is MeshKind.INTERNAL and one.radius < mate.radius:
            up = not up
        at = 90.0 if up else -90.0
        pitch, own = 360.0 / self.teeth(one), 360.0 / self.teeth(mate)
        share = (at - phase) / pitch
        if mesh.kind is MeshKind.INTERNAL:
            return at - (share + 0.5) * own
        return at + 180.0 - (0.5 - share) * own

    def assembled(self, carrier: str, carrier_angle: float) -> Mapping[str, float]:
        """Return the rotation of wheels of a planetary set with its first central wheel fixed.

        Parameters
        ----------
        carrier_angle : float, degrees
            Of the carrier.
        """
        train, roles = self.train, self.motion.roles
        found = dict.fromkeys(roles.central[carrier][:1], 0.0)
        meshes = [mesh for mesh in train.meshes if train.carrier(mesh) == carrier]
        for _ in meshes:
            for mesh in meshes:
                one, other = train.ends(mesh)
                first, second = mesh.first, mesh.second
                if other in found and one not in found:
                    one, other, first, second = other, one, second, first
                if one in found and other not in found:
                    sizes = self.motion.axes.sizes
                    way = 1 if mesh.kind is MeshKind.INTERNAL else -1
                    share = way * float(sizes[first] / sizes[second])
                    found[other] = carrier_angle + share * (found[one] - carrier_angle)
        return found

    # Page ------------------------------------------------------------------------------------

    def html(self) -> str:
        """Return the document."""
        texts = self.language.live
        views, moved = self._views()
        slow = min((self._speed(b) for b in self.motion.speeds if self._speed(b)), default=1.0)
        turns = min(MAX_TURNS, max(1, ceil(self._speed(self.input) / slow)))
        most, quick = 360.0 * turns, max(map(self._speed, self.motion.speeds))
        scene = moved | {
            "most": most,
            "sense": -1 if self.motion.speeds[self.input] < 0 else 1,
            "pace": PACE * self._speed(self.input) / quick,
            "decimal": self.language.notation.decimal,
            "words": {"play": texts.play, "pause": texts.pause},
        }
        return html_document(
            self.problem,
            lang=self.language.lang,
            body="\n".join((self._bar(most), views, self._table())),
            credit=texts.made_train,
            letters=self.canvas.letters(),
            scene=scene,
            script=files("planmethod.gears").joinpath("live.js").read_text("utf-8"),
        )

    def _bar(self, max_angle: float) -> str:
        texts, label = self.language.live, rich(f"φ_{{{self.input}}}")
        return (
            f'<div id="bar"><section><button id="play" aria-label="{escape(texts.play)}">▶</button>'
            f'<input id="slider" type="range" min="{-max_angle!r}" max="{max_angle!r}" step="any" '
            f'aria-label="{escape(texts.turned)}"><label>{label} = <input id="exact" type="number" '
            f'step="any"> °</label>{speed_choice(texts.speed)}'
            f"{colour_switch(self.problem, texts.colour)}</section></div>"
        )

    def _views(self) -> tuple[str, dict[str, list[dict[str, Any]]]]:
        """Return the figures, and what the script moves in them."""
        drawn: list[str] = []
        scene: dict[str, list[dict[str, Any]]] = {"wheels": [], "arms": [], "labels": []}
        for rim in self._rims(self.scheme):
            carrier = self.scheme.over.get(rim.body)
            count = 1 if carrier is None else self.train.planets.get(carrier, 1)
            for k in range(count):
                start = 360.0 * k / count
                turned = 0.0 if carrier is None else self.assembled(carrier, start)[rim.body]
                number = len(scene["wheels"])
                drawn.append(f'<g id="wheel-{number}">{self._outline(rim)}</g>')
                place = self._axis_motion(rim.body, start)
                wheel = {"of": rim.label, "angle": self.phases.get(rim.label, 0.0) + turned}
                scene["wheels"].append(
                    {"id": f"wheel-{number}", "ratio": self.ratio(rim.body)} | wheel | place
                )
                if carrier is not None:
                    arm = len(scene["arms"])
                    drawn.append(f'<path id="arm-{arm}" class="seg"/>')
                    scene["arms"].append({"id": f"arm-{arm}"} | place)
            place = self._axis_motion(rim.body)
            number = len(scene["labels"])
            drawn.append(f'<g id="label-{number}">{self._letter(rim)}</g>')
            scene["labels"].append({"id": f"label-{number}"} | place)
        scene["angles"] = [
            {"id": f"angle-{k}", "ratio": self.ratio(self.train.body_of[label])}
            for k, label in enumerate(self.train.numbers)
        ]
        wide = max(map(self._reach(self.scheme), self._rims(self.scheme))) + 4.0
        box = f"{-wide:.2f} {-wide:.2f} {2 * wide:.2f} {2 * wide:.2f}"
        figures = [
            self._figure(self.language.gears["sheet"]["front"], f"<g>{''.join(drawn)}</g>", box)
        ]
        figures += (
            self._figure(title, self.canvas.parts(picture.items), _box(picture))
            for title, picture in self._diagrams()
        )
        return f'<div id="views">{"".join(figures)}</div>', scene

    @staticmethod
    def _figure(title: str, drawn: str, box: str) -> str:
        return (
            f'<figure><figcaption>{rich(title)}</figcaption><svg viewBox="{box}" role="group" '
            f'aria-label="{escape(title)}">{drawn}</svg></figure>'
        )

    def _outline(self, rim: Rim) -> str:
        """Return a wheel about its own axis, a tooth of it on the right, with a mark that turns."""
        z, r = self.teeth(rim), rim.radius
        module = 2.0 * r / z if z else 0.06 * r
        ring = r + RIM * module
        circle = f'<circle class="axis" r="{r:.3f}"/>'
        if not z:
            outline = f'<circle class="seg thin" r="{ring if rim.ring else r:.3f}"/>'
        else:
            path = "".join(_tooth(r, module, k, z, inner=rim.ring) for k in range(z))
            outline = f'<path class="seg thin" d="M{path[1:]}Z"/>'
            outline += f'<circle class="seg thin" r="{ring:.3f}"/>' if rim.ring else ""
        inside = (r + 1.6 * module, ring) if rim.ring else (0.0, r - 1.8 * module)
        spoke = f'<path class="seg thin" d="M{inside[0]:.3f} 0H{inside[1]:.3f}"/>'
        axis = "" if rim.ring else f'<circle class="seg" r="{min(2.0, 0.2 * r):.3f}"/>'
        return circle + outline + spoke + axis

    def _letter(self, rim: Rim) -> str:
        """Return the number of a wheel, inside it, above or below its axis."""
        z = self.teeth(rim)
        module = 2.0 * rim.radius / z if z else 0.06 * rim.radius
        text = typeset(rim.label, LETTER)
        far = rim.radius + 1.3 * module if rim.ring else max(rim.radius - 3.0 * module - 2.0, 4.0)
        side = -1.0 if "'" in rim.label else 1.0
        at = cmath.rect(far + (0.4 * LETTER if rim.ring else 0.0), radians(35.0 * side))
        return self.canvas.parts(text.at(at - complex(text.width / 2, 0.35 * LETTER)))

    def _diagrams(self) -> Iterator[tuple[str, Picture]]:
        """Yield the linear and the angular velocity diagram, drawn exactly."""
        mu_l = Fraction(repr(float(self.train.unit_m) / self.scheme.mm))  # as high as the wheels
        picture = draw(self.motion, DiagramSettings(mu_l=mu_l))
        if picture is None:
            return
        drawn, said = construct(self.motion, picture), self.language.gears["sheet"]
        # The page does not enlarge segments too short for a ruler: the reader can.
        seen = replace(read(drawn, PROFILES["cad"]), detail_views=())
        yield said["linear"], lettered(*linear(drawn, seen, LETTER))
        yield said["angular"], angular(drawn, seen, LETTER)

    def _table(self) -> str:
        """Return speeds, ratios to the input and turned angles."""
        texts, say_, train = self.language.live, self.language.notation, self.train
        unit, other = (rich(say_.units[key]) for key in train.units)
        letters = (train.letter, "ω" if train.letter == "n" else "n")
        heads = (
            f"{letters[0]}, {unit}", f"{letters[1]}, {other}",
            rich(f"{train.letter}/{train.letter}_{{{self.input}}}"), "φ, °",
        )  # fmt: skip
        rows = []
        for k, label in enumerate(train.numbers):
            speed = float(self.motion.speed(label))
            cells = (
                rich(say_.computed(speed)),
                rich(say_.computed(speed * train.factor)),
                rich(say_.computed(self.ratio(train.body_of[label]))),
                f'<span id="angle-{k}"></span>',
            )
            text = "".join(f"<td>{cell}</td>" for cell in cells)
            rows.append(f'<tr><th scope="row">{rich(label)}</th>{text}</tr>')
        head = "<td></td>" + "".join(f'<th scope="col">{cell}</th>' for cell in heads)
        return (
            f'<section><h2>{escape(texts.speeds)}</h2><div id="numbers"><table><thead><tr>{head}'
            f"</tr></thead><tbody>{''.join(rows)}</tbody></table></div></section>"
        )


def _tooth(r: float, module: float, k: int, z: int, *, inner: bool) -> str:
    """Return the corners of a tooth of a path: up one flank and down the other, y down."""
    pitch, way = 2.0 * pi / z, -1 if inner else 1
    flank = [(r + way * high * module, half * pitch) for high, half in FLANKS]
    corners = [(far, k * pitch - half) for far, half in flank]
    corners += [(far, k * pitch + half) for far, half in reversed(flank)]
    points = (cmath.rect(far, angle) for far, angle in corners)
    return "".join(f"L{p.real:.3f} {-p.imag:.3f}" for p in points)


def _box(picture: Picture) -> str:
    """Return the view box of a picture, y down."""
    left, low, right, high = picture.bounds
    return f"{left - 2:.2f} {-high - 2:.2f} {right - left + 4:.2f} {high - low + 4:.2f}"
