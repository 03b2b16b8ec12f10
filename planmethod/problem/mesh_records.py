"""Wheels and racks on links of a linkage: keys of the file, and the mesh as it is read."""

# no messages: sentences of keys are translated where the reference is made
# Cyrillic letters: terms of the field in brackets

from __future__ import annotations

from math import pi
from typing import Annotated

from msgspec import Struct

from planmethod.mechanism.model import FRAME, Mesh
from planmethod.problem.tables import AngleKey, ChoiceKey, CustomKey, NumberKey, TextKey

KINDS = ("external", "internal", "rack")

STANDARD_ANGLE = 20.0
"""Pressure angle of standard wheels, degrees."""


class MeshSection(Struct, frozen=True):
    """Two wheels, or a wheel and a rack, that are rigid with links (зацепление на звеньях)."""

    links: Annotated[
        tuple[str, ...],
        CustomKey(
            'the two links with the wheels, `["1", "4"]`; `"0"` is the frame. A rack comes second',
            required=True,
            missing='Name the links with the wheels: links = ["1", "4"].',
        ),
    ]
    centres: Annotated[
        tuple[str, ...],
        CustomKey(
            "centres of the wheels, a point of each link. One link, or the frame, must have both "
            "(водило). For a rack, any point on its pitch line",
            required=True,
            missing='Name the centres, a point of each link: centres = ["O", "D"].',
        ),
    ]
    kind: Annotated[
        str, ChoiceKey("kind of mesh", words=KINDS, absent='`"external"`')
    ] = "external"  # fmt: skip
    z: Annotated[
        tuple[int, ...],
        CustomKey("numbers of teeth of both wheels; beside a rack, of the wheel"),
    ] = ()
    module: Annotated[
        float | None,
        NumberKey(
            "module, mm. The pitch radii must fit the distance of the centres",
            "a module", "mm", low=1e-3, high=1e3, positive=True,
            absent="from the distance of the centres",
        ),
    ] = None  # fmt: skip
    r: Annotated[
        tuple[float, ...],
        CustomKey(
            "pitch radii, m, instead of teeth; of an external mesh the first is enough; beside a "
            "rack, of the wheel"
        ),
    ] = ()
    phi: Annotated[
        tuple[float, ...],
        CustomKey(
            "angles of the own axes of both links in one assembled position, degrees. Where the "
            "centres are on a moving link, a third number: the angle of that link. For a rack, the "
            "angle of the wheel, and of the link with the guide if that turns",
            absent="0 each",
        ),
    ] = ()
    s: Annotated[
        float,
        CustomKey(
            "place of the rack in that position, m: of the pin of its slider from the point of "
            "the guide",
            absent="0",
        ),
    ] = 0.0
    alpha: Annotated[
        float, AngleKey("pressure angle α: the force on a tooth is along the line of action")
    ] = STANDARD_ANGLE
    name: Annotated[
        str, TextKey("letter of the pole of the mesh", limit=8, absent="a free letter")
    ] = ""  # fmt: skip


class RollingSection(Struct, frozen=True):
    """A wheel that rolls on a line or a circle of the frame (качение без скольжения)."""

    on: Annotated[
        str,
        CustomKey(
            "guide of the frame, or the fixed centre of a circle",
            required=True,
            missing='Name a guide of the frame: on = "x-x".',
        ),
    ]
    radius: Annotated[
        float,
        CustomKey(
            "radius of the wheel, m", required=True, missing="Give the radius: radius = 0.04."
        ),
    ]
    centre: Annotated[
        str,
        CustomKey(
            "point of the link in the middle of the wheel", absent="the first point of the link"
        ),
    ]
    circle: Annotated[float | None, CustomKey("radius of the circle, m")] = None
    side: Annotated[
        str,
        ChoiceKey(
            "side of the wheel: of the directed guide, or of the circle",
            words=("left", "right", "outside", "inside"),
            absent='`"left"`, of a circle `"outside"`',
        ),
    ] = ""
    phi: Annotated[
        float, AngleKey("angle of the own axis of the link when its centre is at that place")
    ] = 0.0
    at: Annotated[
        float,
        CustomKey(
            "place of the centre: m along the guide from its point, of a circle the angle of the "
            "line from the fixed centre, degrees",
            absent="0",
        ),
    ] = 0.0
    by: Annotated[
        str,
        CustomKey(
            "number of the link that replaces the contact in the analysis",
            absent="the next free number",
        ),
    ] = ""


class GearMesh(Struct, frozen=True):
    """Mesh of two links with its sizes (зацепление звеньев).

    Attributes
    ----------
    mesh : Mesh
        Its links and carrier; of a rack pair the rack is the second.
    centres : tuple of two str
        Centres of the wheels; of a rack, the point on its pitch line, or empty.
    kind : str
        ``external``, ``internal`` or ``rack``.
    radii : tuple of two float, m
        Pitch radii; 0 of a rack.
    phi : tuple of three float, degrees
        Angles of the first link, the second one and the carrier in one assembled position; 0 of
        the frame.
    place : float, m
        Place of the slider of a rack pair on its guide in that position.
    slider : str
        Slider of the pair of rack and carrier.
    offset : float, m
        Distance of the pitch line of a rack from the centre of the wheel, positive to the left of
        the guide.
    alpha : float, degrees
        Pressure angle (угол зацепления); 0 of a wheel that rolls.
    teeth : tuple of int
    module : float or None, mm
    """

    mesh: Mesh
    centres: tuple[str, str]
    kind: str
    radii: tuple[float, float]
    phi: tuple[float, float, float] = (0.0, 0.0, 0.0)
    place: float = 0.0
    slider: str = ""
    offset: float = 0.0
    alpha: float = STANDARD_ANGLE
    teeth: tuple[int, ...] = ()
    module: float | None = None

    @property
    def pole(self) -> str:
        """Letter of the pole."""
        return self.mesh.name

    @property
    def is_rack(self) -> bool:
        """True if one of the two is a rack."""
        return self.kind == "rack"

    def counterpart(self, link: str) -> str:
        """Return the other of the two links."""
        one, two = self.mesh.links
        return two if link == one else one

    def centre(self, link: str) -> str:
        """Return the centre of the wheel of a link."""
        return self.centres[self.mesh.links.index(link)]

    def radius(self, link: str) -> float:
        """Return the pitch radius of a link, m; 0 of a rack."""
        return self.radii[self.mesh.links.index(link)]

    def angle(self, link: str) -> float:
        """Return the angle of a link in the assembled position, degrees."""
        if link == FRAME:
            return 0.0
        return self.phi[(*self.mesh.links, self.mesh.carrier).index(link)]

    def ratio(self, link: str) -> float:
        """Return how fast a link turns for each turn of the other, relative to the carrier."""
        turned = self.radius(self.counterpart(link)) / self.radius(link)
        return turned if self.kind == "internal" else -turned

    @property
    def pole_radius(self) -> float:
        """Distance of the pole from the first centre towards the second one, m."""
        one, two = self.radii
        return -one if self.kind == "internal" and one < two else one

    @property
    def degrees_per_metre(self) -> float:
        """Degrees by which the wheel turns for a metre of the rack, both relative to the carrier.

        The rack is counted along its guide.
        """
        return -180.0 / (pi * self.offset)

    @property
    def rack_sign(self) -> int:
        """+1 if the rack slides on the carrier, -1 if the carrier slides on the rack."""
        return 1 if self.slider == self.mesh.links[1] else -1
