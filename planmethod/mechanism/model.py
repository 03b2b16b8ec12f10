"""Links, pairs and driver of a planar mechanism: its joints without coordinates."""

from __future__ import annotations

from msgspec import Struct
from msgspec.structs import replace

FRAME = "0"
"""Name of the frame (стойка) among the links."""


class Revolute(Struct, frozen=True):
    """Point shared by links (шарнир); k links make k - 1 revolute pairs.

    ``links`` are in file order, the frame (if the point is fixed) first.
    """

    point: str
    links: tuple[str, ...]

    @property
    def pairs(self) -> int:
        """Number of revolute pairs in the point."""
        return len(self.links) - 1


class Prismatic(Struct, frozen=True):
    """Pair of a slider and the link that carries its line (поступательная пара)."""

    slider: str
    host: str
    pin: str


class HigherPair(Struct, frozen=True):
    """Contact of two profiles, which a link with two lower pairs replaces (высшая пара).

    Attributes
    ----------
    name : str
        Letter of the contact.
    links : tuple of two str
        The frame first, then in file order.
    by : str
        Link that replaces it (звено заменяющего механизма); it is one of the links.
    roller : str
        Number of the roller that the second link touches with, which is not among the links: it
        turns about itself without effect on other links (местная подвижность). Empty if there is
        none.
    at : str
        Point of the roller's pin.
    """

    name: str
    links: tuple[str, str]
    by: str
    roller: str = ""
    at: str = ""


class Mesh(Struct, frozen=True):
    """Two wheels in mesh, rigid with links, or a wheel and a rack (зубчатое зацепление).

    Attributes
    ----------
    name : str
        Letter of the pole of the mesh.
    links : tuple of two str
    carrier : str
        The link that holds both centres, or the centre of the wheel and the guide of the rack: the
        frame, or a link that turns (водило).
    rolls : bool
        A wheel rolls on the frame without sliding. The carrier replaces the contact and is not a
        link of the mechanism as it is stated: that is one pair of one freedom (p1).
    """

    name: str
    links: tuple[str, str]
    carrier: str
    rolls: bool = False

    @property
    def joined(self) -> tuple[str, ...]:
        """The links whose angles or places the mesh makes depend on each other."""
        return tuple(dict.fromkeys((*self.links, self.carrier)))


class Passive(Struct, frozen=True):
    """Crank that only repeats another one (пассивное звено), as the third of a parallelogram."""

    link: str
    like: str


class Mechanism(Struct, frozen=True):
    """Links and joints of a planar mechanism (механизм).

    Attributes
    ----------
    links : tuple of str
        Moving links in file order (the frame, `FRAME`, is not among them).
    revolutes : tuple of Revolute
        Every point shared by two or more links.
    prismatics : tuple of Prismatic
    driver : str
        Name of the driving link (начальное звено), joined with the frame.
    frame : str
        Printed number of the frame (номер стойки); among the links it is `FRAME`.
    other_drivers : tuple of str
        The other driving links of a mechanism that has several.
    higher : tuple of HigherPair
        Higher pairs that some of the links replace: then this is the replacing mechanism.
    meshes : tuple of Mesh
    passive : tuple of Passive
        Links that the structural analysis leaves out.
    """

    links: tuple[str, ...]
    revolutes: tuple[Revolute, ...]
    prismatics: tuple[Prismatic, ...]
    driver: str
    frame: str = FRAME
    higher: tuple[HigherPair, ...] = ()
    meshes: tuple[Mesh, ...] = ()
    passive: tuple[Passive, ...] = ()

    @property
    def active(self) -> Mechanism:
        """The mechanism without its passive links."""
        if not self.passive:
            return self
        gone = {one.link for one in self.passive}
        left = (
            replace(one, links=tuple(link for link in one.links if link not in gone))
            for one in self.revolutes
        )
        return replace(
            self,
            links=tuple(link for link in self.links if link not in gone),
            revolutes=tuple(one for one in left if len(one.links) > 1),
            passive=(),
        )

    @property
    def rolling(self) -> tuple[Mesh, ...]:
        """Wheels that roll on the frame."""
        return tuple(mesh for mesh in self.meshes if mesh.rolls)

    other_drivers: tuple[str, ...] = ()

    @property
    def drivers(self) -> tuple[str, ...]:
        """All driving links (начальные звенья)."""
        return (self.driver, *self.other_drivers)

    def called(self, link: str) -> str:
        """Return how a link is printed: the frame by its number."""
        return self.frame if link == FRAME else link

    @property
    def lower_pairs(self) -> int:
        """Number of lower one-mobility pairs p1 (низшие пары)."""
        return sum(joint.pairs for joint in self.revolutes) + len(self.prismatics)
