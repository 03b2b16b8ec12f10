"""Texts and the JSON record of a cam: given data, sizes, checks, positions."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from math import degrees, gcd, pi
from typing import Any

import numpy as np
from msgspec import Struct

from planmethod.cams.design import (
    OF_R_MIN,
    OF_RHO,
    CamDesign,
    CamExtreme,
    design_of,
    motion_in_division,
    nodes_of,
)
from planmethod.cams.laws import CamLawName, Reals, UnitLaw, spline_moments
from planmethod.cams.model import (
    MOVING,
    TURN,
    CamMotion,
    CamPhase,
    CamProblem,
    Closure,
    Contact,
    Stretch,
)
from planmethod.note.document import (
    Caption,
    GivenFact,
    Item,
    Node,
    Paragraph,
    Table,
    Title,
    table_of,
)
from planmethod.note.formula import Rich, escape
from planmethod.note.numbers import decimals_of, finite_or_none, trimmed
from planmethod.note.records.legend import legend_record
from planmethod.note.records.spreadsheet import SpreadsheetRows
from planmethod.note.wording import Language

KEYS = (
    "phi_deg", "s", "v_q", "a_q", "pressure_deg", "x", "y", "x_theoretical", "y_theoretical", "rho",
)  # fmt: skip
LEGEND = (
    ("phi_deg", "φ", "deg"), ("s", "s", "m"), ("v_q", "v_{q}", "m"), ("a_q", "a_{q}", "m"),
    ("pressure_deg", "ϑ", "deg"), ("x", "x", "m"), ("y", "y", "m"), ("x_theoretical", "x_{0}", "m"),
    ("y_theoretical", "y_{0}", "m"), ("rho", "ρ", "m"), ("r_min", "r_{min}", "m"), ("e", "e", "m"),
    ("centre_distance", "a", "m"), ("roller", "r_{p}", "m"), ("curvature_min", "ρ_{min}", "m"),
)  # fmt: skip


def rows(design: CamDesign, count: int = 0) -> list[dict[str, float]]:
    """Return all or ``count`` positions; m, degrees; ``rho`` is of the pitch curve."""
    count = count or design.problem.count
    phi = TURN * np.arange(count) / count
    return _rows(design, 360.0 * np.arange(count) / count, phi, design.problem.at(phi))


def division_rows(design: CamDesign) -> list[tuple[int, dict[str, float]]]:
    """Return the same in the divisions of the diagrams, with their numbers."""
    nodes = nodes_of(design.problem)
    phi = np.array([node.phi for node in nodes])
    moved = np.array([motion_in_division(design.problem, node) for node in nodes]).T
    found = _rows(design, np.degrees(phi), phi, moved)
    return [(node.number, row) for node, row in zip(nodes, found, strict=True)]


def _rows(design: CamDesign, degrees: Reals, phi: Reals, motion: Reals) -> list[dict[str, float]]:
    at = design.geometry.points(phi, motion)
    mirror = design.problem.mirror
    with np.errstate(divide="ignore"):
        rho = 1 / at.curvature
    columns = (
        degrees, *motion, np.degrees(at.pressure),
        mirror * at.actual.real, at.actual.imag,
        mirror * at.theoretical.real, at.theoretical.imag, rho,
    )  # fmt: skip
    return [dict(zip(KEYS, map(float, row), strict=True)) for row in np.array(columns).T]


PROFILE_ROWS = 720
"""Rows of the table of a profile: every half degree."""


def spreadsheet(problem: CamProblem) -> SpreadsheetRows:
    """Return the profile as a table: every half degree, m and degrees; positions among them."""
    design = design_of(problem)
    count = PROFILE_ROWS * problem.count // gcd(PROFILE_ROWS, problem.count)
    told = rows(design, count)
    values = [[row[key] + 0.0 for key in KEYS] for row in told]
    return SpreadsheetRows(problem, KEYS, len(values), partial(iter, [values]))


def record(problem: CamProblem, lang: str = "ru") -> dict[str, Any]:
    """Return one object for a problem: metres and degrees, full precision.

    Raises
    ------
    ProblemError
        No cam satisfies the requirements.
    """
    design = design_of(problem)
    geometry, cut = design.geometry, design.undercut
    rise, back = (design.pressure(phase) for phase in MOVING)
    told: dict[str, Any] = {"schema": 1, "problem": problem.name, "kind": "cam"}
    if problem.variant is not None:
        told["variant"] = problem.variant
    place = {} if cut is None else {"x": problem.mirror * cut.point.real, "y": cut.point.imag}
    degrees = np.degrees
    return {
        **told,
        "r_min": geometry.r_min,
        "e": None if problem.oscillates else geometry.e,
        "centre_distance": geometry.centre if problem.oscillates else None,
        "roller": geometry.roller,
        "pressure_deg": {
            "rise": float(degrees(rise.value)),
            "return": float(degrees(back.value)),
            "at_deg": {"rise": float(degrees(rise.phi)), "return": float(degrees(back.phi))},
        },
        "curvature_min": finite_or_none(design.rho_min.value),
        "undercut": cut
        and {
            "phi_deg": float(degrees(cut.phi)),
            "from_deg": float(degrees(cut.start)),
            "to_deg": float(degrees(cut.end)),
            "rho": cut.rho,
            **place,
            "outer": cut.outer,
        },
        "motions": [
            {
                "phase": one.phase.value,
                "from_deg": float(degrees(one.start)),
                "to_deg": float(degrees(one.end)),
                "s_from": one.before,
                "s_to": one.after,
                "law": None if one.law is None else one.law.name.value,
            }
            for one in problem.motions
        ],
        "jumps": [
            {
                "phi_deg": float(degrees(jump.phi)),
                "of": "v_q" if jump.order == 1 else "a_q",
                "before": float(jump.before[jump.order]),
                "after": float(jump.after[jump.order]),
            }
            for jump in problem.jumps
        ],
        "positions": [
            {key: finite_or_none(value) for key, value in row.items()} for row in rows(design)
        ],
        "legend": legend_record(LEGEND),
    }


MM = 1000.0


def solved_document(problem: CamProblem, language: Language) -> Iterator[Node]:
    """Yield the given data, the sizes, the checks and the positions.

    Raises
    ------
    ProblemError
    """
    design, texts = design_of(problem), language.cam
    yield from head(problem, language)
    yield Caption(texts.sizes)
    yield from result_nodes(design, language)


def result_nodes(design: CamDesign, language: Language) -> Iterator[Node]:
    """Yield the sizes, the checks, the forces and the positions of a cam."""
    texts = language.cam
    yield sizes(design, language)
    yield Caption(texts.checked)
    yield from map(Item, checks(design, language))
    if design.problem.has_forces:
        yield Caption(texts.forces)
        yield from map(Item, forces(design, language))
    yield Caption(positions_title(design, language))
    yield positions(design, language)


def head(problem: CamProblem, language: Language) -> Iterator[Node]:
    """Yield the title and the given data."""
    variant = f" ({problem.variant})" if problem.variant else ""
    yield Title(language.cam.title.format(title=escape((problem.title or problem.name) + variant)))
    yield facts_paragraph(given_facts(problem, language), language)


def facts_paragraph(facts: Sequence[GivenFact], language: Language) -> Paragraph:
    """Return the given data as a paragraph."""
    text = language.note.given.format(given="; ".join(fact.text for fact in facts))
    return Paragraph(text, facts=tuple(facts))


def given_facts(
    problem: CamProblem, language: Language, *, numbered: bool = False
) -> list[GivenFact]:
    """Return the given data, part by part: they suffice to design the cam again.

    ``numbered``: with the meaning of the position numbers of answers.
    """
    facts = [
        *_on_shaft(problem, language),
        *_follower(problem, language),
        *_turn(problem, language),
        *_limits(problem, language),
    ]
    if numbered:
        said = language.cam.numbered if problem.has_one_lift else language.cam.numbered_turn
        text = said.format(count=problem.count)
        facts.append(GivenFact(text, {"cam.count": problem.count}))
    return facts


def _on_shaft(problem: CamProblem, language: Language) -> Iterator[GivenFact]:
    """Yield the name of a cam on a shaft and its phase."""
    if problem.phase is None:
        return
    turned = degrees(problem.phase)
    phase = language.notation.as_input(round(turned, 9))
    text = language.cam.on_shaft.format(name=escape(problem.name), phase=phase)
    yield GivenFact(text, {"cam.name": problem.name, "cam.phase": turned})


def motion_facts(problem: CamProblem, language: Language) -> list[GivenFact]:
    """Return the given data of the follower's motion, but for the speed of the cam."""
    facts = [*_follower(problem, language), *_turn(problem, language)]
    others = {"cam.closure", "cam.parts", "cam.n"}
    return [fact for fact in facts if not others & {*fact.data}]


def _follower(problem: CamProblem, language: Language) -> Iterator[GivenFact]:
    """Yield the follower, its stroke and its closure."""
    texts, notation = language.cam, language.notation
    kind = {"cam.follower": problem.follower.value, "cam.contact": problem.contact.value}
    yield GivenFact(texts["followers"][problem.follower.value][problem.contact.value], kind)
    if problem.oscillates and not problem.has_one_lift:
        text = texts.arm.format(arm=notation.as_input(MM * problem.arm))
        yield GivenFact(text, {"cam.arm": problem.arm})
    elif problem.oscillates:
        swing = degrees(problem.stroke / problem.arm)
        text = texts.swing.format(
            swing=notation.as_input(swing), arm=notation.as_input(MM * problem.arm)
        )
        yield GivenFact(text, {"cam.swing": swing, "cam.arm": problem.arm})
    elif problem.has_one_lift:
        text = texts.stroke.format(h=notation.as_input(MM * problem.stroke))
        yield GivenFact(text, {"cam.stroke": problem.stroke})
    if problem.oscillates:
        yield GivenFact(texts["senses"][problem.sense.value], {"cam.sense": problem.sense.value})
    closure = problem.closure.value
    yield GivenFact(texts["closures"][closure], {"cam.closure": closure})


def _turn(problem: CamProblem, language: Language) -> Iterator[GivenFact]:
    """Yield the phases of a turn, the laws, and the number of divisions of a turn."""
    texts, notation = language.cam, language.notation
    yield from (_phases if problem.has_one_lift else _motions)(problem, language)
    yield GivenFact(texts.divided_in.format(parts=problem.parts), {"cam.parts": problem.parts})
    if problem.n:
        speed = texts["speed"]["ccw" if problem.n > 0 else "cw"]
        yield GivenFact(speed.format(n=notation.as_input(abs(problem.n))), {"cam.n": problem.n})


def _phases(problem: CamProblem, language: Language) -> Iterator[GivenFact]:
    """Yield the four phases, and the laws of the rise and of the return."""
    texts, notation = language.cam, language.notation
    names, keys = (
        ("rise", "upper", "back", "lower"),
        ("rise", "upper_dwell", "return", "lower_dwell"),
    )
    angles = [degrees(problem.length(phase)) for phase in CamPhase]
    shown = dict(zip(names, map(notation.as_input, angles), strict=True))
    data = {f"cam.{key}": angle for key, angle in zip(keys, angles, strict=True)}
    yield GivenFact(texts.phases.format(**shown), data)
    rise, back = (_law(law, language) for law in problem.laws)
    own = dict[str, object]()
    for key, law in zip(("rise", "return"), problem.laws, strict=True):
        own |= {f"cam.law.{key}.{number}": value for number, value in _law_data(law)}
    yield GivenFact(
        (texts.law if rise == back else texts.two_laws).format(rise=rise, back=back), own
    )


def _motions(problem: CamProblem, language: Language) -> Iterator[GivenFact]:
    """Yield the motions and dwells one after another, each with its law."""
    texts, notation = language.cam, language.notation
    shown, data = list[Rich](), list[dict[str, object]]()
    is_one = len(set(problem.laws)) == 1
    for one in problem.motions:
        angle = degrees(one.length)
        fields = {
            "symbol": angle_symbol(problem, one, language),
            "angle": notation.as_input(round(angle, 9)),
        }
        if one.law is None:
            shown.append(texts["motions"]["dwell"].format(**fields))
            data.append({"dwell": angle})
            continue
        size = degrees(one.size / problem.arm) if problem.oscillates else MM * one.size
        unit = "°" if problem.oscillates else f" {notation.units['mm']}"
        key = one.phase.value
        text = texts["motions"][key].format(
            size=f"{notation.as_input(round(size, 9))}{unit}", **fields
        )
        shown.append(text if is_one else f"{text} ({_law(one.law, language)})")
        of, told = ("swing", size) if problem.oscillates else ("stroke", one.size)
        data.append({key: angle, of: told, "law": dict(_law_data(one.law))})
    listed = texts.motions_listed.format(motions=", ".join(shown))
    if is_one:
        listed += "; " + texts.law.format(rise=_law(problem.laws[0], language))
    yield GivenFact(listed, {"cam.motions": data})


def angle_symbol(problem: CamProblem, motion: CamMotion, language: Language) -> Rich:
    """Return the symbol of the angle of a motion or a dwell, with a number if there are several."""
    texts = language.cam
    if problem.has_one_lift:
        return str(texts["phase_angles"][motion.phase.value].format())
    kinds = [one.phase if one.phase in MOVING else None for one in problem.motions]
    number = next(k for k, one in enumerate(problem.motions) if one is motion)
    key = "dwell" if kinds[number] is None else motion.phase.value
    several = kinds.count(kinds[number]) > 1
    which = kinds[: number + 1].count(kinds[number]) if several else ""
    return str(texts["numbered_angles"][key].format(k=which))


def _law_data(law: UnitLaw) -> Iterator[tuple[str, object]]:
    """Yield the keys that give a law in a file."""
    yield "law", law.name.value
    yield from law.parameters


def _limits(problem: CamProblem, language: Language) -> Iterator[GivenFact]:
    """Yield allowed pressure angles, sizes, and the sources of forces."""
    texts, notation = language.cam, language.notation
    flat = problem.contact is Contact.FLAT
    if not flat:
        up, down = problem.allowed
        text = texts.allowed.format(rise=notation.as_input(degrees(up)))
        data = {"cam.pressure.rise": degrees(up)}
        if down is not None:
            text += texts.allowed_back.format(back=notation.as_input(degrees(down)))
            data["cam.pressure.return"] = degrees(down)
        yield GivenFact(text, data)
    for name, symbol, key in (
        ("r_min", "r_{0}" if flat else "r_{min}", "r_min"),
        ("offset", "e", "offset"),
        ("centre", "a", "centre"),
        ("roller", "r_{p}", "roller"),
        ("min_radius", "[ρ]", "curvature"),
    ):
        value = getattr(problem, name)
        if value if name == "min_radius" else value is not None:
            text = f"{symbol} = {notation.as_input(MM * value)} {notation.units['mm']}"
            yield GivenFact(text, {f"cam.{key}": value})
    if problem.mass:
        mass = f"{notation.as_input(problem.mass)} {notation.units['kg']}"
        yield GivenFact(texts.mass.format(mass=mass), {"cam.mass": problem.mass})
    if problem.load:
        load = f"{notation.as_input(problem.load)} {notation.units['N']}"
        yield GivenFact(texts.load.format(load=load), {"cam.load": problem.load})
    if problem.has_forces:
        margin = texts.margin.format(margin=notation.as_input(problem.margin))
        yield GivenFact(margin, {"cam.margin": problem.margin})


def _law(law: UnitLaw, language: Language) -> Rich:
    """Return a law with the numbers that make it this one."""
    texts, notation = language.cam, language.notation
    name: str = texts["laws"][law.name.value]
    for key, value in law.parameters:
        match value:
            case float():
                is_usual = key in ("ratio", "blend") and value == float(key == "ratio")
                name += "" if is_usual else texts[key].format(**{key: notation.as_input(value)})
            case tuple() if key == "values":
                by = texts.by_lifts if law.name is CamLawName.LIFT else texts.by_values
                listed = "; ".join(map(notation.as_input, value))
                name += by.format(parts=len(value) - 1, values=listed)
            case tuple():
                pairs = ", ".join(
                    f"({notation.as_input(x)}; {notation.as_input(y)})" for x, y in value
                )
                name += texts.by_points.format(points=pairs)
    return name


def sizes(design: CamDesign, language: Language) -> Table:
    """Return the table of the sizes, mm."""
    problem, geometry, texts = design.problem, design.geometry, language.cam
    flat = problem.contact is Contact.FLAT
    told: list[tuple[str, str, float]] = [
        ("r_plate" if flat else "r_min", "r_{0}" if flat else "r_{min}", geometry.r_min)
    ]
    if problem.oscillates:
        told.append(("centre", "a", geometry.centre))
    elif not flat:
        told += [("e", "e", geometry.e), ("s0", "s_{0}", geometry.s0)]
    if problem.contact is Contact.ROLLER:
        told.append(("roller", "r_{p}", geometry.roller))
    if np.isfinite(design.rho_min.value):
        told.append(("rho", "ρ_{min}", design.rho_min.value))
    rows = [
        (texts["names"][name], symbol, hundredths(MM * x, language)) for name, symbol, x in told
    ]
    return table_of(texts["columns"], rows, names=2)


def checks(design: CamDesign, language: Language) -> Iterator[Rich]:
    """Yield the remarks on pressure angles, undercut, the roller and impacts."""
    problem, texts, notation = design.problem, language.cam, language.notation

    def mm(value: float) -> Rich:
        return notation.computed(MM * value)

    def at(phi: float) -> Rich:
        return notation.as_input(round(degrees(phi), 2) % 360.0)

    for phase in MOVING:
        if problem.contact is Contact.FLAT:
            break
        value, phi = design.pressure(phase)
        limit = problem.limit(phase)
        fields = {
            "phase": texts["phase"][phase.value],
            "value": notation.computed(degrees(value)),
            "phi": at(phi),
        }
        if limit is None:
            yield texts.free.format(**fields)
        else:
            text = texts.within if value <= limit * (1 + 1e-9) else texts.exceeded
            yield text.format(limit=notation.as_input(degrees(limit)), **fields)
    cut, (rho, phi) = design.undercut, design.rho_min
    if cut is not None:
        text = texts.hollow if problem.contact is Contact.FLAT else texts.undercut
        yield text.format(
            start=at(cut.start), end=at(cut.end), phi=at(cut.phi), rho=mm(cut.rho),
            roller=mm(design.geometry.roller), x=mm(problem.mirror * cut.point.real),
            y=mm(cut.point.imag),
        )  # fmt: skip
    elif not np.isfinite(rho):
        yield texts.straight
    else:
        yield texts.no_undercut.format(rho=mm(rho), phi=at(phi))
    if problem.contact is Contact.ROLLER and np.isfinite(rho):
        share, curved = OF_R_MIN * design.geometry.r_min, OF_RHO * rho
        yield texts.roller_limits.format(
            roller=mm(design.geometry.roller), share=mm(share), curved=mm(curved)
        )
    for order, text in ((1, texts.hard), (2, texts.soft)):
        told = [
            texts.jump.format(
                phi=at(jump.phi),
                before=mm(float(jump.before[order])),
                after=mm(float(jump.after[order])),
            )
            for jump in problem.jumps
            if jump.order == order
        ]
        if told:
            yield text.format(jumps="; ".join(told))
    if not problem.jumps:
        yield texts.smooth
    for law in dict.fromkeys(problem.laws):
        if abs(law.balance - 1) > 1e-9:
            yield texts.balanced.format(factor=notation.short(law.balance))
    for one in problem.moving:
        if one.law is not None and one.law.name is CamLawName.LIFT:
            yield from _smoothness(problem, one, language)


MEASURED_TO = 0.01
"""Error of a measured lift, mm, whose effect is printed."""


def _smoothness(problem: CamProblem, motion: CamMotion, language: Language) -> Iterator[Rich]:
    """Yield how smooth the spline through measured lifts is, and what an error of them does."""
    texts, notation, law = language.cam, language.notation, motion.law
    assert law is not None
    values = np.array(dict(law.parameters)["values"], float)
    parts = len(values) - 1
    bends = [*law.ends[:, 0, 2].tolist(), float(law.ends[-1, 1, 2])]
    signs = np.sign([bend for bend in bends if abs(bend) > 1e-9 * max(map(abs, bends))])
    # The spline through one lift of 1 among zeros: its second derivative is largest there.
    unit = np.zeros(parts + 1)
    unit[parts // 2] = 1.0
    per_lift = float(np.max(np.abs(spline_moments(unit)))) / motion.length**2
    lifted = motion.size / abs(values[-1] - values[0])
    yield texts.spline.format(
        symbol=angle_symbol(problem, motion, language),
        points=parts + 1,
        turns=int(np.count_nonzero(np.diff(signs))),
        change=notation.short(MEASURED_TO * per_lift),
    )
    if abs(lifted - 1) > 1e-9:
        yield texts.scaled.format(factor=notation.short(lifted))
    s = np.concatenate(
        [law.on(k, np.linspace(bit.start, bit.end, 33))[0] for k, bit in enumerate(law.bits)]
    )
    if (over := float(max(np.max(s) - 1.0, -np.min(s)))) > 1e-9:
        yield texts.overshoot.format(over=notation.short(MM * over * motion.size))


def hundredths(value: float, language: Language) -> Rich:
    """Return a number with two decimals, never a negative zero."""
    return language.notation.number(f"{round(value, 2) + 0.0:.2f}")


def positions(design: CamDesign, language: Language) -> Table:
    """Return the table of the positions, mm and degrees: the divisions of the diagrams."""
    notation, told = language.notation, []
    found = division_rows(design)
    angles = [trimmed(round(row["phi_deg"], 2)) for _, row in found]
    decimals = max(map(decimals_of, angles))
    for (k, row), angle in zip(found, angles, strict=True):
        cells = [str(k), notation.number(f"{float(angle):.{decimals}f}")]
        for key in ("s", "v_q", "a_q", "pressure_deg", "x", "y", "rho"):
            value = row[key] if key == "pressure_deg" else MM * row[key]
            cells.append(hundredths(value, language) if abs(value) < 1e5 else "∞")
        told.append(cells)
    return table_of(language.cam["heads"], told, names=0)


def positions_title(design: CamDesign, language: Language) -> Rich:
    """Return the title of that table: which profiles it describes, and what a negative ρ is."""
    texts, notes = language.cam, list[str]()
    if design.geometry.roller:
        notes.append(texts.both_profiles)
    if any(row["rho"] < 0 for _, row in division_rows(design)):
        notes.append(texts.concave)
    return f"{texts.positions} ({'; '.join(notes)})" if notes else texts.positions


# Forces -------------------------------------------------------------------------------------------


class CamForces(Struct, frozen=True):
    """Force of the spring that keeps contact, N, and the greatest reaction (силы)."""

    needed: CamExtreme
    spring: float
    normal: CamExtreme


def forces_of(design: CamDesign) -> CamForces:
    """Return the forces on a follower; the mass of a pivoted one is that reduced to its roller."""
    one = design.problem
    omega = abs(one.n or 0.0) * pi / 30

    def push(stretch: Stretch, phi: Reals) -> Reals:
        load = one.load if stretch.phase is CamPhase.RISE else 0.0
        return np.asarray(one.mass * omega**2 * one.on(stretch, phi)[2] + load)

    needed = design.highest(lambda stretch, phi: -push(stretch, phi))
    spring = one.margin * max(needed.value, 0.0) if one.closure is Closure.FORCE else 0.0

    def normal(stretch: Stretch, phi: Reals) -> Reals:
        at = design.geometry.points(phi, one.on(stretch, phi))
        return np.abs((push(stretch, phi) + spring) / np.cos(at.pressure))

    return CamForces(needed, spring, design.highest(normal))


def forces(design: CamDesign, language: Language) -> Iterator[Rich]:
    """Yield the force of the spring and the greatest reaction."""
    told, texts, notation = forces_of(design), language.cam, language.notation

    def at(phi: float) -> Rich:
        return notation.as_input(round(degrees(phi), 2) % 360.0)

    if design.problem.closure is Closure.FORCE:
        yield texts.spring.format(
            spring=notation.computed(told.spring), needed=notation.computed(told.needed.value),
            phi=at(told.needed.phi), margin=notation.as_input(design.problem.margin),
        )  # fmt: skip
    yield texts.normal.format(force=notation.computed(told.normal.value), phi=at(told.normal.phi))
