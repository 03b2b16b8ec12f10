"""Choice of teeth: every set for a ratio within bounds, and its report (подбор чисел зубьев)."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from fractions import Fraction
from typing import Any

import numpy as np
import numpy.typing as npt

from planmethod.gears.model import MeshKind
from planmethod.gears.solution import RING_LESS, SIN2, ring_fits
from planmethod.gears.teeth import TeethSelection, TeethSet, TeethSpecification, TrainScheme
from planmethod.note.compared import percent_text
from planmethod.note.document import Node, Paragraph, table_of
from planmethod.note.formula import escape
from planmethod.note.numbers import MINUS
from planmethod.note.wording import Language, get_language

Ints = npt.NDArray[np.int64]
Mask = npt.NDArray[np.bool_]
Reals = npt.NDArray[np.float64]

LARGEST = 400
"""Largest number of teeth that a bound may name: above it a search takes longer than a second."""

BORDER = 1e-11
"""Relative nearness to a bound of the ratio at which it is judged in fractions."""


def choose(spec: TeethSpecification, *, first: int | None = None) -> TeethSelection:
    """Try every combination of teeth within the bounds.

    For two rows, z_1, z_2 and z_2' run through their bounds and coaxiality gives z_3; every
    combination is tried, so that no set is missed.

    Parameters
    ----------
    first : int, optional
        Number of sets to return. Default: all.
    """
    looked, blocks = 0, []
    for z_1, second, rim in _grids(spec):
        looked += second.size * rim.size
        blocks.append(_fitting(spec, z_1, second, rim))
    columns = [np.concatenate(column) for column in zip(*blocks, strict=True)]
    *teeth, upper, lower, doubled, off = columns
    order = np.lexsort((*reversed(teeth), np.abs(off), doubled))
    sets = []
    for at in order[:first]:
        ratio = _overall_ratio(spec.scheme, Fraction(int(upper[at]), int(lower[at])))
        assert ratio is not None
        size = Fraction(int(doubled[at]), 2 * spec.rows[0])
        found = tuple(int(column[at]) for column in teeth)
        sets.append(TeethSet(found, ratio, ratio / spec.ratio - 1, size))
    return TeethSelection(spec, looked, len(order), tuple(sets))


def set_of(spec: TeethSpecification, teeth: tuple[int, ...]) -> TeethSet:
    """Return the set of certain teeth, whatever conditions it meets.

    Raises
    ------
    ValueError
        It has no ratio.
    """
    scheme, z = spec.scheme, dict(zip(spec.scheme.wheels, teeth, strict=True))
    z.setdefault("2'", z["2"])
    z.setdefault("3", z["2"])
    held = Fraction(z["2"] * z["3"], z["1"] * z["2'"])
    ratio = _overall_ratio(scheme, held if len(scheme.kinds) > 1 else Fraction(z["2"], z["1"]))
    if ratio is None:
        raise ValueError(teeth)
    arrays = {label: np.array(count) for label, count in z.items()}
    side = 1 if scheme.kinds[0] is MeshKind.EXTERNAL else -1
    distance = spec.rows[0] * (arrays["1"] + side * arrays["2"])
    doubled = int(_doubled_size(spec, arrays, distance))
    size = Fraction(doubled, 2 * spec.rows[0])
    return TeethSet(teeth, ratio, ratio / spec.ratio - 1, size)


def _grids(spec: TeethSpecification) -> Iterator[tuple[int, Ints, Ints]]:
    """Yield z_1 with all z_2 and z_2', arrays of shapes (n, 1) and (1, m)."""
    scheme = spec.scheme
    spur: Ints = np.arange(spec.min_teeth, spec.max_teeth + 1)
    most = spec.max_ring_teeth if "1" in scheme.rings else spec.max_teeth
    one: Ints = np.zeros((1, 1), dtype=np.int64)
    for first in range(spec.min_teeth, most + 1):
        yield first, spur[:, None], one if scheme.single else spur[None, :]


def _fitting(
    spec: TeethSpecification, z_1: int, second: Ints, rim: Ints
) -> tuple[Ints | Reals, ...]:
    """Return the sets with one z_1: teeth, upper and lower part of U^H, twice the size, error."""
    scheme, (p, q) = spec.scheme, spec.rows
    if len(scheme.kinds) == 1:
        z_2 = second[:, 0]
        z_rim = z_3 = z_2
        upper, lower, distance = z_2, np.full_like(z_2, z_1), p * (z_1 + z_2)
        fits = _near_target(spec, upper / lower)
    else:
        z_2, z_rim = np.broadcast_arrays(second, second if scheme.single else rim)
        distance = p * (z_1 + z_2 if scheme.kinds[0] is MeshKind.EXTERNAL else z_1 - z_2)
        side = -1 if scheme.kinds[1] is MeshKind.EXTERNAL else 1
        z_3 = distance // q + side * z_rim
        upper, lower = z_2 * z_3, z_1 * z_rim
        most = spec.max_ring_teeth if "3" in scheme.rings else spec.max_teeth
        fits = (distance > 0) & (distance % q == 0) & (z_3 >= spec.min_teeth) & (z_3 <= most)
        fits &= _near_target(spec, upper / lower)
    at = np.nonzero(fits)  # the rest is for the few
    z_2, z_rim, z_3, upper, lower, distance = (
        array[at] for array in (z_2, z_rim, z_3, upper, lower, distance)
    )
    first = np.full_like(z_2, z_1)
    fits = _mesh_properly(scheme.kinds[0], first, z_2) & _mesh_properly(
        scheme.kinds[-1], z_3, z_rim
    )
    if scheme.is_planetary:
        fits &= _planets_fit(spec, first, (z_2, z_rim, z_3), distance)
    off, doubtful = _error(spec, upper, lower)
    fits &= doubtful | (np.abs(off) <= float(spec.tolerance))
    for one in np.nonzero(doubtful & fits)[0]:
        ratio = _overall_ratio(scheme, Fraction(int(upper[one]), int(lower[one])))
        fits[one] = ratio is not None and abs(ratio / spec.ratio - 1) <= spec.tolerance
    z = {"1": first, "2": z_2, "2'": z_rim, "3": z_3}
    kept = (*(z[label] for label in scheme.wheels), upper, lower)
    return *(column[fits] for column in kept), _doubled_size(spec, z, distance)[fits], off[fits]


def _overall_ratio(scheme: TrainScheme, fixed_carrier_ratio: Fraction) -> Fraction | None:
    """Return U from the size of the ratio with the carrier held; None where it has no value."""
    ratio = _sign(scheme) * fixed_carrier_ratio
    if scheme.is_planetary:
        ratio = 1 - ratio
    if scheme.ratio_name != "U_H_1":
        return ratio
    return 1 / ratio if ratio else None


def _sign(scheme: TrainScheme) -> int:
    return -1 if scheme.kinds.count(MeshKind.EXTERNAL) % 2 else 1


def _near_target(spec: TeethSpecification, fixed_carrier_ratio: Reals) -> Mask:
    """Return where U is within its bounds, or so close to one that fractions must decide."""
    ends = [spec.ratio * (1 + share) for share in (-spec.tolerance, spec.tolerance)]
    if spec.scheme.ratio_name == "U_H_1":
        ends = [1 / end for end in ends]
    if spec.scheme.is_planetary:
        ends = [1 - end for end in ends]
    low, high = sorted(float(end * _sign(spec.scheme)) for end in ends)
    edge = BORDER * (1 + fixed_carrier_ratio)
    return (fixed_carrier_ratio >= low - edge) & (fixed_carrier_ratio <= high + edge)


def _error(spec: TeethSpecification, upper: Ints, lower: Ints) -> tuple[Reals, Mask]:
    """Return the relative error of U, and where it is too close to the bound for floats."""
    above, below = _sign(spec.scheme) * upper, lower
    if spec.scheme.is_planetary:
        above = below - above
    if spec.scheme.ratio_name == "U_H_1":
        above, below = below, above
    off = np.divide(above, below, where=below != 0, out=np.full(upper.shape, np.inf))
    off = off / float(spec.ratio) - 1
    return off, np.abs(np.abs(off) - float(spec.tolerance)) <= BORDER


# Conditions --------------------------------------------------------------------------------------


def _mesh_properly(kind: MeshKind, first: Ints, second: Ints) -> Mask:
    """Return where standard teeth of two wheels neither interfere nor cut each other.

    The tip of the larger wheel stays short of where the line of action touches the base circle of
    the smaller. If one of them is a ring, it is the larger of ``first`` and ``second``.
    """
    small, large = np.minimum(first, second), np.maximum(first, second)
    if kind is MeshKind.INTERNAL:
        inside: Mask = ring_fits(small, large)
        return inside
    room: Reals = 4 - 2 * small * SIN2
    fits: Mask = (room <= 0) | (large * room <= small**2 * SIN2 - 4)
    return fits


def _planets_fit(
    spec: TeethSpecification, first: Ints, rows: tuple[Ints, Ints, Ints], distance: Ints
) -> Mask:
    """Return where k planets can be assembled and their tips, one module high, do not touch."""
    z_2, rim, z_3 = rows
    (p, q), k = spec.rows, spec.planets
    whole = np.abs(first * rim - _sign(spec.scheme) * z_2 * z_3) // np.gcd(z_2, rim)
    fits: Mask = whole % k == 0
    if k > 1:
        tips = np.maximum(p * (z_2 + 2), q * (rim + 2))
        fits &= math.sin(math.pi / k) > tips / distance
    return fits


def _doubled_size(spec: TeethSpecification, z: Mapping[str, Ints], distance: Ints) -> Ints:
    """Return twice the diameter over the pitch circles of all wheels, in the modules' unit."""
    p, q = spec.rows
    if len(spec.scheme.kinds) == 1:
        return 2 * distance
    middle, around = np.maximum(p * z["1"], q * z["3"]), np.maximum(p * z["2"], q * z["2'"])
    if spec.scheme.is_planetary:
        return 2 * np.maximum(middle, distance + around)
    return distance + middle + around


def selection_document(selection: TeethSelection, language: Language) -> Iterator[Node]:
    """Yield the requirements, the bounds, the number of combinations tried, and the sets."""
    texts, wanted, number = language.teeth, selection.spec, language.notation.as_input
    scheme = wanted.scheme
    carried = texts.satellites.format(k=wanted.planets) if scheme.is_planetary else ""
    rings = texts.rings.format(ring_most=wanted.max_ring_teeth) if scheme.rings else ""
    modules = ""
    if wanted.modules is not None:
        first, second = (number(float(module)) for module in wanted.modules)
        modules = texts.modules.format(first=first, second=second)
    yield Paragraph(texts.title.format(scheme=escape(texts["schemes"][scheme.name])))
    yield Paragraph(
        texts.wanted.format(
            ratio=number(float(wanted.ratio)),
            within=number(100 * float(wanted.tolerance)),
            satellites=carried,
            modules=modules,
        )
    )
    yield Paragraph(
        texts.bounds.format(
            least=wanted.min_teeth, most=wanted.max_teeth, rings=rings, looked=selection.tried_count
        )
    )
    text = texts.conditions.format(difference=RING_LESS, carried=texts.carried if carried else "")
    yield Paragraph(escape(text))
    if not selection.sets:
        yield Paragraph(texts.none)
        return
    yield Paragraph(texts.found.format(found=selection.match_count, shown=len(selection.sets)))
    first, *others = texts["columns"]
    yield table_of(
        [first, *(escape(f"z_{label}") for label in scheme.wheels), *others],
        [
            [
                str(at),
                *map(str, one.teeth),
                language.notation.computed(float(one.ratio)),
                str(one.ratio).replace("-", MINUS),
                language.notation.number(percent_text(100 * float(one.error), 2)),
                number(float(one.size)),
            ]
            for at, one in enumerate(selection.sets, 1)
        ],
        names=0,
    )


def selection_record(selection: TeethSelection) -> dict[str, Any]:
    """Return the JSON record of a selection: requirements, bounds, counts, sets."""
    wanted = selection.spec
    return {
        "schema": 1,
        "scheme": wanted.scheme.name,
        "ratio": {"name": wanted.scheme.ratio_name, "value": float(wanted.ratio)},
        "within": float(wanted.tolerance),
        "satellites": wanted.planets if wanted.scheme.is_planetary else None,
        "modules_mm": None if wanted.modules is None else [float(m) for m in wanted.modules],
        "bounds": {
            "z_min": wanted.min_teeth,
            "z_max": wanted.max_teeth,
            "ring_max": wanted.max_ring_teeth if wanted.scheme.rings else None,
        },
        "looked_at": selection.tried_count,
        "found": selection.match_count,
        "sets": [
            {
                "teeth": dict(zip(wanted.scheme.wheels, one.teeth, strict=True)),
                "value": float(one.ratio),
                "exact": f"{one.ratio.numerator}/{one.ratio.denominator}",
                "error": float(one.error),
                "size": float(one.size),
            }
            for one in selection.sets
        ],
    }


def problem_text(selection: TeethSelection, number: int, lang: str) -> str:
    """Return the problem file of the set with this number, counted from 1.

    Rows of different modules are written as radii: a train has one module.
    """
    wanted, one = selection.spec, selection.sets[number - 1]
    scheme, texts = wanted.scheme, get_language(lang).teeth
    lines = [f'title = "{texts.file.format(number=number)}"', ""]
    lines.append(f"# {texts['schemes'][scheme.name]}")
    teeth = ", ".join(f"z_{x} = {z}" for x, z in zip(scheme.wheels, one.teeth, strict=True))
    lines += [f"# {teeth}", "[gears]", f"wheels = {{ {_wheels(selection, one)} }}", "meshes = ["]
    carried = ', carrier = "H"' if scheme.is_planetary else ""
    rim = "2'" if "2'" in scheme.wheels else "2"
    for kind, of in zip(scheme.kinds, (("1", "2"), (rim, "3")), strict=False):
        lines.append(f'  {{ of = ["{of[0]}", "{of[1]}"], kind = "{kind.value}"{carried} }},')
    lines.append("]")
    if not scheme.is_planetary and len(scheme.kinds) == 2:
        lines.append('coaxial = [["1", "3"]]')
    if scheme.is_planetary:
        lines += ['fixed = ["3"]', f"satellites = {wanted.planets}"]
    if wanted.modules is not None and len(set(wanted.modules)) == 1:
        lines.append(f"module = {float(wanted.modules[0]):g}")
    source = scheme.ratio_name.split("_")[1]
    lines += [
        f"n = {{ {source} = 1 }}",
        f'ask = ["W", "{scheme.ratio_name}"]',
        *_design_table(wanted),
        "",
    ]
    return "\n".join(lines)


def _design_table(spec: TeethSpecification) -> list[str]:
    """Return the requirements from which the sheet compares variants; none if it cannot."""
    if not spec.scheme.is_planetary or len(set(spec.rows)) != 1:
        return []
    k = spec.planets
    bounds = f"z_min = {spec.min_teeth}, z_max = {spec.max_teeth}, ring_max = {spec.max_ring_teeth}"
    shown = f"k_min = {max(1, k - 1)}, k_max = {min(24, k + 2)}"
    asked = f"U = {float(spec.ratio)!r}, within = {min(float(spec.tolerance), 0.5)!r}"
    return [f"design = {{ {asked}, {bounds}, {shown} }}"]


def _wheels(selection: TeethSelection, one: TeethSet) -> str:
    modules = selection.spec.modules
    cells = []
    for label, z in zip(selection.spec.scheme.wheels, one.teeth, strict=True):
        text = str(z)
        if modules is not None and modules[0] != modules[1]:
            text = f"{{ r = {float(z * modules[label not in ('1', '2')] / 2000):.9g} }}"
        cells.append(f'"{label}" = {text}')
    return ", ".join(cells)
