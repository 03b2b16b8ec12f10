"""Parts of the force plans besides their steps: loads, polygons, equations, moments."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

import numpy as np
import numpy.typing as npt
from msgspec import Struct
from msgspec.structs import replace

from planmethod.construct.arithmetic import Number
from planmethod.construct.steps import NumberName, PointName
from planmethod.mechanism.groups import OuterLeg
from planmethod.plans.model import Direction, Ends, KnownParts, Relation
from planmethod.problem.model import Problem

DOWN = -90.0
"""Direction of the weights, degrees."""

Complexes = npt.NDArray[np.complex128]
Reals = npt.NDArray[np.float64]


class LoadKind(Enum):
    """Kind of a load (вид нагрузки)."""

    WEIGHT = "weight"
    INERTIA = "inertia"
    INERTIA_COUPLE = "inertia couple"
    EXTERNAL = "external"
    FRICTION = "friction"


class Applied(Struct, frozen=True):
    """One force or couple on a link in every position (приложенная нагрузка).

    Attributes
    ----------
    name : str
        Letter in rich text: ``G_{2}``, ``Φ_{2}``, ``M_{Φ2}``, or that of the external load.
    link : str
    point : str or None
        Name of the point where the force acts; None for a couple.
    force : ndarray of shape (n,), N
        Complex; zero for a couple.
    couple : ndarray of shape (n,), N·m
        Counter-clockwise positive; zero for a force.
    kind : LoadKind
    steady : complex or None
        The force or couple where it is the same in every position.
    numbers : tuple of ndarray of shape (n,), optional
        Its known numbers in every position, for loads of many variants.
    """

    name: str
    link: str
    point: str | None
    force: Complexes
    couple: Reals
    kind: LoadKind
    steady: complex | None = None
    numbers: tuple[Reals, ...] | None = None


def numbers_of(one: Applied) -> tuple[Number, ...]:
    """Return the known numbers of a load: its couple, N·m, or its direction, degrees, and size, N.

    Numbers of a load that is the same in every position, else arrays of shape (n,).
    """
    if one.numbers is not None:
        return one.numbers
    if one.point is None:
        return (one.couple if one.steady is None else one.steady.real,)
    force = one.force if one.steady is None else one.steady
    turned = DOWN if one.kind is LoadKind.WEIGHT else np.degrees(np.angle(force))
    return turned, np.abs(force)


class Shift(Struct, frozen=True):
    """Inertia force moved off the centre of mass (смещённая сила инерции).

    Attributes
    ----------
    letter : str
        Of the point T where the force acts, in rich text: ``T_{2}``; not the name of any point.
    moment : Applied
        The couple M_Φ that the force includes.
    couple : NumberName
        Its size, N·m.
    centre, at : PointName
        Centre of mass and T on the position plan.
    length : NumberName
        h, mm of the position plan: positive to the left of the acceleration.
    letters : mapping of NumberName to str
        Letters of the numbers that the couple is computed from, in rich text.
    """

    letter: str
    moment: Applied
    couple: NumberName
    centre: PointName
    at: PointName
    length: NumberName
    letters: Mapping[NumberName, str]

    @property
    def link(self) -> str:
        """The link that the force acts on."""
        return self.moment.link


def free_letter(letter: str, link: str, problem: Problem) -> str:
    """Return the letter of a point of a link, ``T_{2}``; primed where a point has that name."""
    taken = {point for body in problem.bodies.values() for point in body.points}
    index = link
    while f"{letter}{index}" in taken:
        index += "'"
    return f"{letter}_{{{index}}}"


class Component(Enum):
    """Component of a force that a segment shows (составляющая)."""

    TOTAL = "whole"
    NORMAL = "normal"  # along the link (нормальная)
    TANGENTIAL = "tangential"  # across the link (касательная)


class Edge(Struct, frozen=True):
    """One side of a force polygon, and the term of the equation that it shows (вектор плана сил).

    Attributes
    ----------
    symbol : str
        Letter in rich text: ``G_{2}``, ``F^{n}_{21}``; of a reaction the first index is the link
        that it acts on, the second the link that exerts it. The balancing force has none.
    on : str
        The link that the force acts on.
    at : PointName
        Where on the position plan.
    tail, head : PointName
        Ends on the force plan.
    known : KnownParts
        Before the plan is drawn.
    direction : Direction or None
        Where only that is known: ``∥ BC``, ``⊥ y-y``.
    """

    symbol: str
    on: str
    at: PointName
    tail: PointName
    head: PointName
    known: KnownParts = KnownParts.BOTH
    direction: Direction | None = None
    component: Component = Component.TOTAL

    @property
    def ends(self) -> Ends:
        """The segment."""
        return self.tail, self.head

    @property
    def is_aslant(self) -> bool:
        """True if it has a direction of its own, so that its arm is measured."""
        return self.direction is not None and self.direction.relation is Relation.ANGLED


class CoupleOn(Struct, frozen=True):
    """Couple on a link: a moment of inertia forces, of a guide, the balancing one (пара сил).

    ``at`` is the place it is about, or None where that is all the same.
    """

    symbol: str
    on: str
    moment: NumberName
    at: PointName | None = None


class Balance(Struct, frozen=True):
    """Equation of forces: their sum is zero (уравнение сил)."""

    links: tuple[str, ...]
    edges: tuple[Edge, ...]


class Moments(Struct, frozen=True):
    """Equation of moments that gives a force or a couple (уравнение моментов).

    Attributes
    ----------
    links : tuple of str
    about : PointName
    edges : tuple of Edge
        The known forces, where they are laid off (all of them, those through the point too).
    couples : tuple of CoupleOn
        The known couples.
    force : Edge or None
        The found force, whose arm is from ``about`` to its place.
    couple : CoupleOn or None
        The found couple.
    arm : tuple of (NumberName, int)
        Factors of the arm of the found force, m.
    """

    links: tuple[str, ...]
    about: PointName
    edges: tuple[Edge, ...]
    couples: tuple[CoupleOn, ...]
    force: Edge | None = None
    couple: CoupleOn | None = None
    arm: tuple[tuple[NumberName, int], ...] = ()


class ForcePlan(Struct, frozen=True):
    """Force plan of links that are cut free together (план сил группы или начального звена).

    Attributes
    ----------
    links : tuple of str
    polygon : tuple of Edge
        One after another, closed.
    wholes : tuple of Edge
        Reactions whose components are in the polygon.
    inner : tuple of Edge
        The reactions in the inner joints, which close the plans of single links.
    balances : tuple of Balance
        In the order of solving.
    moments : tuple of Moments
        In the order of solving.
    couples : tuple of CoupleOn
        On the links from outside them.
    """

    links: tuple[str, ...]
    polygon: tuple[Edge, ...]
    wholes: tuple[Edge, ...] = ()
    inner: tuple[Edge, ...] = ()
    balances: tuple[Balance, ...] = ()
    moments: tuple[Moments, ...] = ()
    couples: tuple[CoupleOn, ...] = ()

    @property
    def reactions(self) -> tuple[Edge, ...]:
        """The forces that the plan finds."""
        found = [edge for edge in self.polygon if edge.known is not KnownParts.BOTH]
        return (*found, *self.wholes, *self.inner)


def reaction_symbol(
    on: str, by: str, component: Component = Component.TOTAL, letter: str = "F"
) -> str:
    """Return the letter of a reaction on a link, exerted by another: ``F_{21}``, ``F^{n}_{21}``.

    Links are as they are printed (`Mechanism.called`).
    """
    index = f"{on},{by}" if len(on) > 1 or len(by) > 1 else f"{on}{by}"
    above = {Component.TOTAL: "", Component.NORMAL: "^{n}", Component.TANGENTIAL: "^{τ}"}[component]
    return f"{letter}{above}_{{{index}}}"


class Components(Struct, frozen=True):
    """Reaction of a revolute leg in two components (нормальная и касательная составляющие).

    ``by`` is the printed name of the link that exerts it, ``line`` are the points of the link from
    the joint to the middle one, ``arm`` the factors of its length, m.
    """

    leg: OuterLeg
    by: str
    at: PointName
    line: tuple[str, str]
    arm: tuple[tuple[NumberName, int], ...]

    def _edge(self, tail: PointName, head: PointName, component: Component) -> Edge:
        symbol = reaction_symbol(self.leg.link, self.by, component)
        return Edge(symbol, self.leg.link, self.at, tail, head, component=component)

    def normal(self, tail: PointName, head: PointName) -> Edge:
        """Return the share along the link, which the plan finds."""
        edge = self._edge(tail, head, Component.NORMAL)
        return replace(
            edge, known=KnownParts.ONE, direction=Direction(Relation.PARALLEL, self.line)
        )

    def tangential(self, tail: PointName, head: PointName) -> Edge:
        """Return the share across the link, which moments have found."""
        return self._edge(tail, head, Component.TANGENTIAL)

    def total(self, tail: PointName, head: PointName) -> Edge:
        """Return the reaction itself."""
        return replace(self._edge(tail, head, Component.TOTAL), known=KnownParts.NONE)


def reaction_edge(
    on: str,
    by: str,
    at: PointName,
    tail: PointName,
    head: PointName,
    direction: Direction | None = None,
) -> Edge:
    """Return a reaction that a plan finds: of a known ``direction`` if there is one.

    ``by`` is the printed name of a link.
    """
    known = KnownParts.NONE if direction is None else KnownParts.ONE
    return Edge(reaction_symbol(on, by), on, at, tail, head, known, direction)


def as_known(edge: Edge) -> Edge:
    """Return a force that an equation before has found."""
    return replace(edge, known=KnownParts.BOTH, direction=None)


def back(edge: Edge, on: str) -> Edge:
    """Return the opposite reaction, on the other link, when it has been found."""
    return Edge(reaction_symbol(on, edge.on), on, edge.at, edge.head, edge.tail)
