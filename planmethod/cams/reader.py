"""Read a file with ``[cam]``: every fault at once (чтение файла задачи)."""

from __future__ import annotations

from collections.abc import Mapping
from math import isclose, pi, radians
from pathlib import Path
from typing import Any

from planmethod.cams.laws import CamLawName, UnitLaw, law_of
from planmethod.cams.model import ArmSense, CamProblem, Closure, Contact, Follower
from planmethod.errors import ProblemError
from planmethod.languages import translate
from planmethod.problem import fields
from planmethod.problem.answers import ComputedAnswerNames, read_answers
from planmethod.problem.fields import Faults
from planmethod.problem.flat_tables import CustomReader, read_flat
from planmethod.problem.names import short
from planmethod.problem.reader import varied
from planmethod.problem.sheet import read_head
from planmethod.problem.tables import CAM_EXAMPLE, CHOOSE, CamSection
from planmethod.problem.units import measured

TOP = ("title", "source", "units", "stamp", "sheet", "answers", "compare", "variants", "cam")
"""Tables of the file that a cam may have."""

SIZE_NAMES = ("r_min", "e", "centre_distance", "roller", "theta_max", "theta_max_return", "rho_min")
PLACED = ("s", "v_q", "a_q", "theta")
"""Quantities that students answer: of the cam, and of each of its positions."""

OF_LAW: Mapping[CamLawName, tuple[str, float, float]] = {
    CamLawName.CONSTANT: ("ratio", 0.05, 20.0),
    CamLawName.TRAPEZOIDAL: ("ramp", 0.001, 0.25),
    CamLawName.MODIFIED: ("ramp", 0.001, 0.25),
    CamLawName.LINEAR: ("blend", 0.0, 0.499),
}
"""Numbers that laws may have, with their bounds."""

_NEEDED = {
    "swing": "swing = 20 (degrees)", "arm": "arm = 0.12 (m)", "stroke": "stroke = 0.04 (m)",
}  # fmt: skip
_TABLE = 'law = { rise = { law = "table", values = [0, 1, 1, 0, -1, -1, 0] }, return = "sine" }'
_POINTS = 'law = { law = "piecewise-linear", points = [[0, 1], [0.5, 1], [0.5, -1], [1, -1]] }'


def load(path: str | Path, *, variant: str | None = None) -> CamProblem:
    """Read a file with ``[cam]``; of one with a linkage, too, that table and the title block.

    Raises
    ------
    ProblemError
        With every fault of the file.
    """
    path = Path(path)
    table, variants, faults = varied(path, variant)
    crank = table.get("driver") if "links" in table else None
    if "links" in table:
        table = {key: value for key, value in table.items() if key in TOP and key != "answers"}
    given = fields.read_keys(faults, "", table, TOP)
    head = read_head(faults, given)
    body = fields.read_table(faults, "cam", given.get("cam", {}), CAM_EXAMPLE)
    told = None if body is None else _read(faults, body, _speed(crank))
    count = 1 if told is None else told["count"]
    answers = read_answers(faults, given, _scene(count))
    if faults or told is None:
        raise ProblemError(str(path), faults.listed)
    return CamProblem(
        name=path.stem,
        source_file=str(path),
        variants=variants,
        variant=variant,
        answers=answers,
        **head,
        **told,
    )


def read_cam(faults: Faults, table: object) -> dict[str, Any] | None:
    """Return the fields of a cam whose follower drives a linkage; None after noting a fault."""
    body = fields.read_table(faults, "cam", table, CAM_EXAMPLE)
    return None if body is None else _read(faults, body, None)


def _scene(count: int) -> ComputedAnswerNames:
    def fault(name: str) -> str:
        return "" if name in (*SIZE_NAMES, *PLACED) else translate("a cam has no '{}'", short(name))

    hint = translate("Known here: {}.", ", ".join((*SIZE_NAMES, *PLACED)))
    return ComputedAnswerNames(fault, lambda name: False, hint, count)


def _speed(crank: object) -> float | None:
    """Return the speed of the crank that a file has beside the cam, rev/min."""
    if not isinstance(crank, Mapping):
        return None
    said = fields.Faults()  # the crank's is read, and its faults are reported, with the driver
    if "n" in crank:
        return fields.read_number(said, "", crank["n"], "a rotational speed in rev/min")
    omega = fields.read_number(said, "", crank.get("omega"), "an angular velocity in 1/s")
    return None if omega is None else omega * 30 / pi


def _read(faults: Faults, body: Mapping[str, Any], speed: float | None) -> dict[str, Any] | None:
    """Return the fields of a problem that its table has."""
    sizes = ("offset", "centre", "r_min", "roller")
    own: dict[str, CustomReader] = dict.fromkeys(sizes, _read_size)
    own |= dict.fromkeys(("law", "pressure"), _accept)  # both need other keys
    found = read_flat(faults, "cam", body, CamSection, own, example=CAM_EXAMPLE)
    if faults:
        return None
    given = CamSection(**found)
    oscillates, flat = given.follower == "oscillating", given.contact == "flat"
    _check_keys(faults, body, oscillates=oscillates, contact=given.contact)
    laws = _read_laws(faults, given.law)
    allowed = _read_pressure(faults, given)
    phases = _phases(faults, given)
    chosen = {
        name: size if isinstance(size := getattr(given, name), float) else None for name in sizes
    }
    if faults:
        return None
    assert laws is not None and allowed is not None and phases is not None
    arm = given.arm or 0.0
    stroke = arm * radians(given.swing or 0.0) if oscillates else given.stroke or 0.0
    _check_sizes(faults, chosen, oscillates=oscillates, flat=flat, arm=arm)
    if flat and any(law.start for law in laws):
        what = translate(
            "a plate cannot follow a jump of the velocity, which law '{}' has", "linear"
        )
        faults.add("cam.law", what, "Take another law, or linear with blend.")
    return None if faults else {
        "follower": Follower(given.follower),
        "contact": Contact(given.contact),
        "closure": Closure(given.closure),
        "sense": ArmSense(given.sense),
        "stroke": stroke,
        "arm": arm,
        "phases": phases,
        "laws": laws,
        "allowed": allowed,
        **chosen,
        "min_radius": given.curvature,
        "count": given.count,
        "parts": given.parts,
        "n": speed if given.n is None else given.n,
        "mass": given.mass,
        "load": given.load,
        "margin": given.margin,
    }  # fmt: skip


def _accept(faults: Faults, path: str, value: object) -> object:
    return value


def _read_size(faults: Faults, path: str, value: object) -> float | str | None:
    if value == CHOOSE:
        return CHOOSE
    if isinstance(value, str) and measured(value) is None:
        hint = f'{path.rpartition(".")[2]} = "{CHOOSE}"'
        faults.expected(path, translate("a length in metres, or '{}'", CHOOSE), value, hint)
        return None
    low = -10.0 if path.endswith("offset") else 1e-5
    return fields.read_metres(faults, path, value, "length", low=low, high=10.0)


def _check_keys(faults: Faults, body: Mapping[str, Any], *, oscillates: bool, contact: str) -> None:
    """Note keys that the follower needs, and those that are another one's."""
    needed = ("swing", "arm") if oscillates else ("stroke",)
    alien = ("stroke", "offset") if oscillates else ("swing", "arm", "centre", "sense")
    whose = "an oscillating follower" if oscillates else "a translating follower"
    for key in needed:
        if key not in body:
            faults.add(f"cam.{key}", "missing", translate("For example: {}", _NEEDED[key]))
    for key in alien:
        if key in body:
            faults.add(f"cam.{key}", translate("{} has none", translate(whose)), "Leave it out.")
    if contact != "roller" and body.get("roller", CHOOSE) != CHOOSE:
        faults.add("cam.roller", "goes with contact = 'roller'", "Leave it out.")
    if contact != "flat" and "curvature" in body:
        faults.add("cam.curvature", "goes with contact = 'flat'", "Leave it out.")
    if contact != "roller" and body.get("closure") == "form":
        faults.add("cam.closure", "only a roller runs in a groove", "contact = 'roller'")


def _check_sizes(
    faults: Faults, chosen: Mapping[str, float | None], *, oscillates: bool, flat: bool, arm: float
) -> None:
    """Note sizes that do not go together."""
    r_min, offset, centre = (chosen[key] for key in ("r_min", "offset", "centre"))
    if r_min is not None and offset is not None and abs(offset) >= r_min:
        what = translate("{:g} m, the least radius is {:g} m", offset, r_min)
        faults.add("cam.offset", what, "The line of the follower meets the base circle.")
    if not oscillates:
        return
    if flat and centre is None:
        faults.add("cam.centre", "missing", "Under a plate the distance of the pivot is given.")
    elif flat and centre is not None and r_min is not None and r_min >= centre:
        faults.add("cam.r_min", translate("{:g} m reach the pivot at {:g} m", r_min, centre))
    elif flat or centre is None or r_min is None:
        return
    elif not abs(centre - arm) < r_min < centre + arm:
        what = translate(
            "no triangle: r_min = {:g}, centre = {:g}, arm = {:g} m", r_min, centre, arm
        )
        hint = translate("r_min lies between {:g} and {:g} m.", abs(centre - arm), centre + arm)
        faults.add("cam.r_min", what, hint)


def _phases(faults: Faults, table: CamSection) -> tuple[float, float, float, float] | None:
    """Return the phases, rad."""
    told = table.rise + table.upper_dwell + table.return_
    rest = 360.0 - told if table.lower_dwell is None else table.lower_dwell
    if rest < -1e-9 or not isclose(told + rest, 360.0, abs_tol=1e-9):
        what = translate("the phases are {:g}° in all, a turn is 360°", told + max(rest, 0.0))
        left = 360.0 - told
        hint = (
            translate("lower_dwell = {:g}", left)
            if left >= 0
            else translate("Take shorter phases.")
        )
        faults.add("cam.lower_dwell", what, hint)
        return None
    one, two, three = (radians(x) for x in (table.rise, table.upper_dwell, table.return_))
    four = 2 * pi - one - two - three
    return one, two, three, four if four > 1e-9 else 0.0


def _read_pressure(faults: Faults, table: CamSection) -> tuple[float, float | None] | None:
    """Return the allowed angles of rise and return, rad."""
    value = table.pressure
    told = value if isinstance(value, Mapping) else {} if value is None else {"rise": value}
    known = fields.read_keys(faults, "cam.pressure", told, ("rise", "return"))
    read = {
        key: fields.read_number(
            faults, f"cam.pressure.{key}", one, "an angle in degrees", low=1.0, high=85.0
        )
        for key, one in known.items()
    }
    rise = read.get("rise", 45.0 if table.follower == "oscillating" else 30.0)
    back = read.get("return", rise if table.closure == "form" else None)
    return None if rise is None else (radians(rise), None if back is None else radians(back))


def _read_laws(faults: Faults, value: object) -> tuple[UnitLaw, UnitLaw] | None:
    """Return the laws of rise and return."""
    usual = CamLawName.CUBIC.value
    if isinstance(value, Mapping) and "law" not in value:
        told = fields.read_keys(faults, "cam.law", value, ("rise", "return"))
        rise = _read_law(faults, "cam.law.rise", told.get("rise", usual))
        back = _read_law(faults, "cam.law.return", told.get("return", usual))
    else:
        rise = back = _read_law(faults, "cam.law", usual if value is None else value)
    return None if rise is None or back is None else (rise, back)


def _read_law(faults: Faults, path: str, value: object) -> UnitLaw | None:
    told = value if isinstance(value, Mapping) else {"law": value}
    known = ("law", "ratio", "ramp", "blend", "values", "points")
    given = fields.read_keys(faults, path, told, known)
    name = fields.read_member(faults, f"{path}.law", given.get("law"), CamLawName)
    if name is None:
        return None
    own: dict[str, Any] = {}
    key, low, high = OF_LAW.get(name, ("", 0.0, 0.0))
    for other in given:
        needed = {CamLawName.TABLE: "values", CamLawName.PIECEWISE: "points"}.get(name, key)
        if other not in ("law", needed):
            faults.add(
                f"{path}.{other}", translate("law '{}' has none", name.value), "Leave it out."
            )
    if key in given:
        own[key] = fields.read_number(faults, f"{path}.{key}", given[key], low=low, high=high)
        if own[key] is None:
            return None
    if name is CamLawName.TABLE:
        own["values"] = _read_values(faults, f"{path}.values", given.get("values"))
        points = own["values"] and [(0.0, y) for y in own["values"]]
    elif name is CamLawName.PIECEWISE:
        points = own["points"] = _read_points(faults, f"{path}.points", given.get("points"))
    else:
        return law_of(name, **own)
    if not points:
        return None
    sizes = [y for _, y in points]
    if min(sizes) >= 0 or max(sizes) <= 0:
        what = translate("the follower does not come to rest: accelerations of one sign only")
        faults.add(f"{path}.law", what, "Give positive and negative ones.")
        return None
    law = law_of(name, **own)
    if law.ends[-1, 1, 0] <= 0 or not isclose(float(law.ends[-1, 1, 0]), 1.0):
        faults.add(f"{path}.law", "the follower does not rise by such accelerations")
        return None
    return law


def _read_values(faults: Faults, path: str, value: object) -> list[float] | None:
    if not isinstance(value, list) or not 3 <= len(value) <= 721:
        faults.expected(
            path, "3 to 721 second derivatives at equal parts of the phase", value, _TABLE
        )
        return None
    read = [fields.read_number(faults, f"{path}[{k}]", one) for k, one in enumerate(value)]
    found = [one for one in read if one is not None]
    return found if len(found) == len(value) else None


def _read_points(faults: Faults, path: str, value: object) -> list[tuple[float, float]] | None:
    pairs = value if isinstance(value, list) else []
    if not 2 <= len(pairs) <= 721 or not all(isinstance(p, list) and len(p) == 2 for p in pairs):
        faults.expected(path, "points [part of the phase, second derivative]", value, _POINTS)
        return None
    read = [
        fields.read_number(faults, f"{path}[{k}][{n}]", one)
        for k, pair in enumerate(pairs)
        for n, one in enumerate(pair)
    ]
    if None in read:
        return None
    found = [(float(x or 0.0), float(y or 0.0)) for x, y in zip(read[::2], read[1::2], strict=True)]
    across = [x for x, _ in found]
    if across != sorted(across) or across[0] != 0.0 or across[-1] != 1.0:
        faults.add(path, "parts of the phase go from 0 to 1 and never back", _POINTS)
        return None
    return found
