"""Read a file with ``[cam]``: every fault at once (чтение файла задачи)."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import partial
from itertools import pairwise
from math import degrees, isclose, pi, radians
from pathlib import Path
from typing import Any, NamedTuple

from planmethod.cams.laws import CamLawName, UnitLaw, law_of
from planmethod.cams.model import (
    ArmSense,
    CamMotion,
    CamProblem,
    Closure,
    Contact,
    Follower,
    MotionOrder,
    motions_of,
)
from planmethod.errors import ProblemError
from planmethod.languages import translate
from planmethod.problem.answers import ComputedAnswerNames, read_answers
from planmethod.problem.faults import Faults
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.formula import measured
from planmethod.problem.names import short
from planmethod.problem.reader import varied
from planmethod.problem.sheet import read_head
from planmethod.problem.tables import CAM_EXAMPLE, CHOOSE, CamMotionEntry, CamSection

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
    "rise": "rise = 120 (degrees)", "return": "return = 120 (degrees)",
}  # fmt: skip
_TABLE = 'law = { rise = { law = "table", values = [0, 1, 1, 0, -1, -1, 0] }, return = "sine" }'
_LIFTS = 'law = { rise = { law = "lift", values = [0, 0.001, 0.006, 0.010] }, return = "sine" }'
_POINTS = 'law = { law = "piecewise-linear", points = [[0, 1], [0.5, 1], [0.5, -1], [1, -1]] }'


def load(path: str | Path, *, variant: str | None = None) -> CamProblem:
    """Read a file with ``[cam]``; of one with a linkage, too, that table and the title block.

    Raises
    ------
    ProblemError
        With every fault of the file.
    """
    path = Path(path)
    file, variants = varied(path, variant)
    speed = None
    if "links" in file:
        speed = _crank_speed(file.value)
        tables = {key: file.value[key] for key in file.value if key in TOP and key != "answers"}
        file = file.with_value(tables)
    file.allow(TOP)
    head = read_head(file)
    cam = file.get("cam", {}).attempt(partial(read_cam, speed=speed))
    answers = read_answers(file, _scene(1 if cam is None else cam["count"]))
    if file.faults or cam is None:
        raise ProblemError(str(path), file.faults.listed)
    return CamProblem(
        name=path.stem,
        source_file=str(path),
        variants=variants,
        variant=variant,
        answers=answers,
        **head,
        **cam,
    )


def _scene(count: int) -> ComputedAnswerNames:
    def fault(name: str) -> str:
        return "" if name in (*SIZE_NAMES, *PLACED) else translate("a cam has no '{}'", short(name))

    hint = translate("Known here: {}.", ", ".join((*SIZE_NAMES, *PLACED)))
    return ComputedAnswerNames(fault, lambda name: False, hint, count)


def _crank_speed(table: Mapping[str, Any]) -> float | None:
    """Return the speed of the crank that a file has beside the cam, rev/min."""
    # a root of its own: the faults of the crank are reported with the driver
    crank = FileNode(Faults(), table.get("driver"))
    if not isinstance(crank.value, Mapping):
        return None
    if "n" in crank:
        return crank.read("n", lambda n: n.number("a rotational speed in rev/min"))
    omega = crank.read("omega", lambda omega: omega.number("an angular velocity in 1/s"))
    return None if omega is None else omega * 30 / pi


_CHOSEN = ("offset", "centre", "r_min", "roller")
"""Sizes that the program may choose."""


def read_cam(node: FileNode, speed: float | None = None) -> dict[str, Any]:
    """Read the fields of a cam from ``[cam]``.

    Parameters
    ----------
    speed : float, optional, rev/min
        Where the table has none.
    """
    node.table(CAM_EXAMPLE)
    size = _read_size
    found = node.record(
        CamSection, example=CAM_EXAMPLE, offset=size, centre=size, r_min=size, roller=size
    )
    node.require_sound()
    given = CamSection(**found)
    oscillates, flat = given.follower == "oscillating", given.contact == "flat"
    _check_keys(node, given)
    usual = law_of(CamLawName.CUBIC)
    laws = node.read("law", _read_laws, (usual, usual))
    allowed = node.attempt(partial(_read_pressure, table=given))
    motions = _read_turn(node, given, laws)
    chosen = {name: None if size == CHOOSE else size for name in _CHOSEN
              for size in [getattr(given, name)]}  # fmt: skip
    node.require_sound()
    arm = given.arm or 0.0
    _check_sizes(node, chosen, oscillates=oscillates, flat=flat, arm=arm)
    if flat and any(one.law is not None and one.law.start for one in needed(motions)):
        message = "a plate cannot follow a jump of the velocity, which law '{}' has"
        node["law"].note(message, "linear", hint="Choose another law, or linear with blend.")
    node.require_sound()
    return {
        "follower": Follower(given.follower),
        "contact": Contact(given.contact),
        "closure": Closure(given.closure),
        "sense": ArmSense(given.sense),
        "arm": arm,
        "motions": motions,
        "allowed": allowed,
        **chosen,
        "min_radius": given.curvature,
        "count": given.count,
        "parts": given.parts,
        "n": speed if given.n is None else given.n,
        "mass": given.mass,
        "load": given.load,
        "margin": given.margin,
    }


def _read_size(node: FileNode) -> float | str:
    if node.value == CHOOSE:
        return CHOOSE
    if isinstance(node.value, str) and measured(node.value) is None:
        hint = f'{node.key} = "{CHOOSE}"'
        node.reject_value(translate("a length in metres, or '{}'", CHOOSE), hint)
    return node.metres("length", low=-10.0 if node.key == "offset" else 1e-5, high=10.0)


def _check_keys(node: FileNode, table: CamSection) -> None:
    """Note keys that the follower needs, and those that are another one's."""
    oscillates = table.follower == "oscillating"
    given = ("rise", "return", "swing" if oscillates else "stroke")
    required = (*(() if table.motions is not None else given), *(("arm",) if oscillates else ()))
    alien = ("stroke", "offset") if oscillates else ("swing", "arm", "centre", "sense")
    whose = "an oscillating follower" if oscillates else "a translating follower"
    for key in required:
        if key not in node:
            node[key].note("missing", hint=translate("For example: {}", _NEEDED[key]))
    if table.motions is not None:
        for key in ("rise", "upper_dwell", "return", "lower_dwell", "stroke", "swing"):
            if key in node and key not in alien:
                node[key].note("each entry of motions has its own", hint="Omit it.")
    for key in alien:
        if key in node:
            node[key].note("{} has none", translate(whose), hint="Omit it.")
    if table.contact != "roller" and "roller" in node and table.roller != CHOOSE:
        node["roller"].note("valid only with contact = 'roller'", hint="Omit it.")
    if table.contact != "flat" and "curvature" in node:
        node["curvature"].note("valid only with contact = 'flat'", hint="Omit it.")
    if table.contact != "roller" and table.closure == "form":
        node["closure"].note("only a roller runs in a groove", hint="contact = 'roller'")


def _check_sizes(
    node: FileNode,
    chosen: Mapping[str, float | None],
    *,
    oscillates: bool,
    flat: bool,
    arm: float,
) -> None:
    """Note sizes that do not go together."""
    r_min, offset, centre = (chosen[key] for key in ("r_min", "offset", "centre"))
    if r_min is not None and offset is not None and abs(offset) >= r_min:
        hint = "The line of the follower meets the base circle."
        node["offset"].note("{:g} m, the least radius is {:g} m", offset, r_min, hint=hint)
    if not oscillates:
        return
    if flat and centre is None:
        node["centre"].note("missing", hint="Under a plate the distance of the pivot is given.")
    elif flat and centre is not None and r_min is not None and r_min >= centre:
        node["r_min"].note("{:g} m reach the pivot at {:g} m", r_min, centre)
    elif flat or centre is None or r_min is None:
        return
    elif not abs(centre - arm) < r_min < centre + arm:
        hint = translate("r_min must be between {:g} and {:g} m.", abs(centre - arm), centre + arm)
        message = "no triangle: r_min = {:g}, centre = {:g}, arm = {:g} m"
        node["r_min"].note(message, r_min, centre, arm, hint=hint)


def _read_turn(
    node: FileNode, table: CamSection, laws: tuple[UnitLaw, UnitLaw] | None
) -> tuple[CamMotion, ...] | None:
    """Return the motions of a turn, listed or as a rise and a return; None after a fault."""
    if table.motions is not None:
        return node["motions"].attempt(partial(_read_motions, table=table, laws=laws))
    if table.rise is None or table.return_ is None:
        return None
    phases = node.attempt(partial(_read_phases, table=table))
    if phases is None or laws is None:
        return None
    stroke = table.stroke or 0.0
    if table.follower == "oscillating":
        stroke = (table.arm or 0.0) * radians(table.swing or 0.0)
    changes, ruling = (stroke, 0.0, -stroke, 0.0), (laws[0], None, laws[1], None)
    return motions_of([*map(MotionOrder, phases, changes, ruling)])


def _read_phases(node: FileNode, table: CamSection) -> tuple[float, float, float, float]:
    """Return the phases, rad."""
    rise, back = needed(table.rise), needed(table.return_)
    total = rise + table.upper_dwell + back
    rest = 360.0 - total if table.lower_dwell is None else table.lower_dwell
    if rest < -1e-9 or not isclose(total + rest, 360.0, abs_tol=1e-9):
        hint = translate("Shorten the phases.")
        if total <= 360.0:
            hint = translate("lower_dwell = {:g}", 360.0 - total)
        message = "the phases are {:g}° in all, a turn is 360°"
        node["lower_dwell"].reject(message, total + max(rest, 0.0), hint=hint)
    one, two, three = (radians(x) for x in (rise, table.upper_dwell, back))
    four = 2 * pi - one - two - three
    return one, two, three, four if four > 1e-9 else 0.0


# Several rises in a turn --------------------------------------------------------------------------

_KINDS = ("rise", "return", "dwell")
_MOTION = "motions = [{ rise = 90, stroke = 0.03 }, { dwell = 60 }, { return = 90 }]"
_SWUNG = "motions = [{ rise = 90, swing = 20 }, { dwell = 60 }, { return = 90 }]"


class _Entry(NamedTuple):
    """An entry of ``motions``: angle, degrees; change, m; law; a return may lack its stroke."""

    kind: str
    angle: float
    change: float | None
    law: UnitLaw | None


def _read_motions(
    node: FileNode, table: CamSection, laws: tuple[UnitLaw, UnitLaw] | None
) -> tuple[CamMotion, ...]:
    """Read ``motions``: rises, returns and dwells one after another, closed after a turn.

    A return without a stroke ends at the place where the turn began. A last motion is followed by a
    dwell for the rest of the turn.
    """
    example = _SWUNG if table.follower == "oscillating" else _MOTION
    node.array("a list of 2 to 40 motions and dwells", example, low=2, high=40)
    read = node.read_all(partial(_read_motion, table=table, laws=laws, example=example))
    orders, height = list[MotionOrder](), 0.0
    for entry, (kind, angle, change, law) in zip(node.entries(), read, strict=True):
        if change is None:
            if height <= 0.0:
                message = "the follower is not above the place where the turn began"
                entry["return"].reject(message, hint="Give the return its stroke or swing.")
            change = -height
        orders.append(MotionOrder(radians(angle), change, law))
        height += change
        if kind == "dwell" and len(orders) > 1 and orders[-2].law is None:
            entry["dwell"].note("two dwells one after the other", hint="Write them as one.")
    node.require_sound()
    _check_turn(node, read, orders, table)
    rest = 2 * pi
    for order in orders:
        rest -= order.length
    if rest > 1e-9:
        orders.append(MotionOrder(rest, 0.0))
    else:  # the turn ends at its end, whatever the rounding of the angles
        orders[-1] = orders[-1]._replace(length=orders[-1].length + rest)
    return motions_of(orders)


def _check_turn(
    node: FileNode, read: Sequence[_Entry], orders: Sequence[MotionOrder], table: CamSection
) -> None:
    """Make sure that the motions are a turn, and end where they began."""
    total = sum(one.angle for one in read)
    rest = 360.0 - total
    if rest < -1e-9 or (rest > 1e-9 and read[-1].kind == "dwell"):
        hint = translate("Shorten the phases.")
        if rest > 0.0:
            hint = translate("Last dwell: {{ dwell = {:g} }}", read[-1].angle + rest)
        node.note("the phases are {:g}° in all, a turn is 360°", total, hint=hint)
    up = sum(order.change for order in orders if order.change > 0)
    down = -sum(order.change for order in orders if order.change < 0)
    if not up and not down:
        node.reject("no rise and no return", hint=_MOTION)
    if not isclose(up, down, rel_tol=1e-9):
        message = "the follower rises by {:g} m and returns by {:g} m in a turn"
        hint = "Make both equal; a return without stroke ends where the turn began."
        if table.follower == "oscillating":
            arm = needed(table.arm)
            up, down = degrees(up / arm), degrees(down / arm)
            message = "the follower rises by {:g}° and returns by {:g}° in a turn"
            hint = "Make both equal; a return without swing ends where the turn began."
        node.reject(message, up, down, hint=hint)
    node.require_sound()


def _read_motion(
    node: FileNode,
    *,
    table: CamSection,
    laws: tuple[UnitLaw, UnitLaw] | None,
    example: str,
) -> _Entry:
    node.table(example)
    kinds = [kind for kind in _KINDS if kind in node]
    falls = kinds == ["return"]
    own = node.record(CamMotionEntry, law=partial(_read_law, falls=falls))
    node.require_sound()
    if len(kinds) != 1:
        message = "expected one of rise, return and dwell"
        node.reject(message, hint=translate("For example: {}", example))
    given = CamMotionEntry(**own)
    (kind,) = kinds
    angle = needed({"rise": given.rise, "return": given.return_, "dwell": given.dwell}[kind])
    of, alien = ("swing", "stroke") if table.follower == "oscillating" else ("stroke", "swing")
    whose = "an oscillating follower" if of == "swing" else "a translating follower"
    if alien in node:
        node[alien].note("{} has none", translate(whose), hint="Omit it.")
    if kind == "dwell":
        for key in ("stroke", "swing", "law"):
            if key in node and key != alien:
                node[key].note("a dwell has none", hint="Omit it.")
        node.require_sound()
        return _Entry(kind, angle, 0.0, None)
    if kind == "rise" and of not in node:
        node[of].note("missing", hint=translate("For example: {}", _NEEDED[of]))
    node.require_sound()
    usual = law_of(CamLawName.CUBIC) if laws is None else laws[falls]
    law = usual if given.law is None else own["law"]
    size = given.stroke
    if given.swing is not None and table.arm is not None:
        size = table.arm * radians(given.swing)
    elif given.swing is not None:
        size = 1.0  # the missing arm is a fault of the table
    return _Entry(kind, angle, None if size is None else -size if falls else size, law)


def _read_pressure(node: FileNode, table: CamSection) -> tuple[float, float | None]:
    """Read the allowed angles of rise and return, rad."""
    pressure = node.get("pressure", {})
    if not isinstance(pressure.value, Mapping):
        pressure = pressure.with_value({"rise": pressure.value})
    pressure.allow(("rise", "return"))
    rise = pressure.read("rise", _read_allowed, 45.0 if table.follower == "oscillating" else 30.0)
    back = pressure.read("return", _read_allowed, rise if table.closure == "form" else None)
    return radians(needed(rise)), None if back is None else radians(back)


def _read_allowed(node: FileNode) -> float:
    return node.number("an angle in degrees", 1.0, 85.0)


def _read_laws(node: FileNode) -> tuple[UnitLaw, UnitLaw]:
    """Read the laws of rise and return."""
    if not isinstance(node.value, Mapping) or "law" in node:
        law = _read_law(node)
        return law, law
    node.allow(("rise", "return"))
    usual = law_of(CamLawName.CUBIC)
    rise = node.read("rise", _read_law, usual)
    back = node.read("return", partial(_read_law, falls=True), usual)
    return needed(rise), needed(back)


_LISTED = {
    CamLawName.TABLE: "values", CamLawName.LIFT: "values", CamLawName.PIECEWISE: "points",
}  # fmt: skip
"""Lists that laws need."""


def _read_law(node: FileNode, *, falls: bool = False) -> UnitLaw:
    """Read a law; measured lifts of a return may fall."""
    if not isinstance(node.value, Mapping):
        node = node.with_value({"law": node.value})
    node.allow(("law", "ratio", "ramp", "blend", "values", "points"))
    name = node["law"].member(CamLawName)
    key, low, high = OF_LAW.get(name, ("", 0.0, 0.0))
    key = _LISTED.get(name, key)
    for other in node.value:
        if other not in ("law", key):
            node[other].note("law '{}' has none", name.value, hint="Omit it.")
    match name:
        case CamLawName.LIFT:
            return law_of(name, values=_read_lifts(node, falls=falls))
        case CamLawName.TABLE:
            values = _read_values(node["values"])
            points = [(float(k), value) for k, value in enumerate(values)]
            _check_sides(node["law"], points)
            law = law_of(name, values=list(values))
        case CamLawName.PIECEWISE:
            points = _read_points(node["points"])
            _check_sides(node["law"], points)
            law = law_of(name, points=points)
        case _:
            own: dict[str, Any] = {}
            if key in node:
                own[key] = node[key].number(low=low, high=high)
            return law_of(name, **own)
    if law.ends[-1, 1, 0] <= 0 or not isclose(float(law.ends[-1, 1, 0]), 1.0):
        node["law"].reject("the follower does not rise by such accelerations")
    return law


def _read_lifts(node: FileNode, *, falls: bool) -> tuple[float, ...]:
    """Read measured lifts at equal parts of the phase, in any unit."""
    if "values" not in node:
        node.note_missing("values", translate("For example: {}", _LIFTS))
    node.require_sound()
    listed = node["values"]
    listed.array("3 to 721 lifts at equal parts of the phase", _LIFTS, low=3, high=721)
    values = listed.read_all(FileNode.number)
    first, last = values[0], values[-1]
    if first == last or (last < first and not falls):
        message = "the last lift, {:g}, must be greater than the first, {:g}"
        hint = 'Falling lifts belong to a return: law = { return = { law = "lift", … } }.'
        listed.reject(message, last, first, hint=hint)
    low, high = sorted((first, last))
    for entry, value in zip(listed.entries(), values, strict=True):
        if not low <= value <= high:
            message = "{:g} is not between the first and the last lift, {:g} and {:g}"
            hint = "Give each rise and each return its own entry of motions."
            entry.reject(message, value, first, last, hint=hint)
    return values


def _check_sides(node: FileNode, points: Sequence[tuple[float, float]]) -> None:
    """Make sure that accelerations at parts of the phase have both signs over some of it."""
    sides = [(y, high) for (x, y), (end, high) in pairwise(points) if end > x]
    if min(map(min, sides)) >= 0 or max(map(max, sides)) <= 0:
        message = "the follower does not come to rest: accelerations of one sign only"
        node.reject(message, hint="Give positive and negative ones.")


def _read_values(node: FileNode) -> tuple[float, ...]:
    expected = "3 to 721 second derivatives at equal parts of the phase"
    node.array(expected, _TABLE, low=3, high=721)
    return node.read_all(FileNode.number)


def _read_points(node: FileNode) -> list[tuple[float, float]]:
    points = node.value if isinstance(node.value, list) else []
    if not 2 <= len(points) <= 721 or not all(isinstance(p, list) and len(p) == 2 for p in points):
        node.reject_value("points [part of the phase, second derivative]", _POINTS)
    read = node.read_all(lambda point: point.read_all(FileNode.number))
    found = [(x, y) for x, y in read]
    across = [x for x, _ in found]
    if across != sorted(across) or across[0] != 0.0 or across[-1] != 1.0:
        node.reject("parts of the phase must increase from 0 to 1", hint=_POINTS)
    return found
