"""What a language must be able to say of gear trains, their teeth and two wheels in mesh."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct


class GearSheetWording(Struct, frozen=True, kw_only=True):
    """Titles, rich text, and sentences of steps, templates of `str.format` (лист и протокол).

    Attributes
    ----------
    kinds : mapping
        Names of meshes, by kind.
    inscriptions : mapping
        Inscriptions of scales, by scale.
    steps : mapping
        Sentences of the protocol, by kind of step.
    """

    scheme: str
    front: str
    linear: str
    angular: str
    results: str
    segments: str
    calculation: str
    inscriptions: Mapping[str, str]
    fixed: str
    by_coaxiality: str
    module: str
    columns_results: tuple[str, ...]
    columns_segments: tuple[str, ...]
    no_scheme: str
    kinds: Mapping[str, str]
    protocol: str
    given: str
    source: str
    pictures: str
    steps: Mapping[str, str]
    ruler: str


class GearWording(Struct, frozen=True, kw_only=True):
    """Headings, columns and sentences of gear trains in one language, templates of `str.format`.

    Attributes
    ----------
    kinds, conditions, reasons : mapping
        By kind of train, name of the condition, reason why a value does not exist.
    columns_* : tuple of str
        Heads of the tables.
    sheet : GearSheetWording
        Sheet and protocol.
    """

    sheet: GearSheetWording
    title: str
    structure: str
    kinds: Mapping[str, str]
    kind: str
    chebyshev: str
    of_equal: str
    by_meshes: str
    redundant: str
    carrier: str
    closing: str
    equations: str
    equation: str
    wheels: str
    columns_wheels: tuple[str, ...]
    speeds: str
    columns_speeds: tuple[str, ...]
    relative: str
    across: str
    rack: str
    tabular: str
    tabular_rows: tuple[str, ...]
    asked: str
    columns_asked: tuple[str, ...]
    checked: str
    conditions: Mapping[str, str]
    holds: Mapping[bool, str]
    picture: str
    scales: str
    columns_contacts: tuple[str, ...]
    columns_rays: tuple[str, ...]
    points: Mapping[str, str]
    no_picture: str
    published: str
    columns_published: tuple[str, ...]
    reasons: Mapping[str, str]
    units: Mapping[str, str]


class TeethWording(Struct, frozen=True, kw_only=True):
    """Headings, columns and sentences in one language, templates of `str.format`.

    Attributes
    ----------
    schemes : mapping
        What the schemes are, with their formula of U.
    """

    title: str
    schemes: Mapping[str, str]
    wanted: str
    satellites: str
    modules: str
    bounds: str
    rings: str
    conditions: str
    carried: str
    found: str
    none: str
    columns: tuple[str, ...]
    file: str


class MeshingWording(Struct, frozen=True, kw_only=True):
    """Headings, names and sentences of a pair of wheels, templates of `str.format`.

    Attributes
    ----------
    tan : str
        How the tangent is written.
    names : mapping
        What the quantities are, by their keys.
    conditions : mapping
        By `planmethod.gears.involute.blocking.LimitKind`; ``wheel`` is its number, ``value`` what
        is compared with ``bound``. In braces of their own stand indices.
    holds : mapping
        Whether a condition is kept.
    steps : mapping
        Headings of the protocol by the key of the quantity that they stand before.
    beside : mapping
        What the protocol says before a quantity.
    """

    tan: str
    title: str
    given: str
    ring: str
    shifts: Mapping[bool, str]
    names: Mapping[str, str]
    pair: str
    wheels: str
    columns: tuple[str, str, str, str]
    checked: str
    conditions: Mapping[str, str]
    holds: Mapping[bool, str]
    undercut: str
    cut_line: str
    missing: str
    units: Mapping[str, str]
    steps: Mapping[str, str]
    beside: Mapping[str, str]
    sheet: str
    meshing: str
    contour: str
    sliding: str
    table: str
