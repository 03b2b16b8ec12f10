"""Machine-readable record of a solution: the object that ``solve --json`` prints."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from typing import Any

import numpy as np
from msgspec.structs import replace

from planmethod.construct.drafting import Profile
from planmethod.languages import WRITTEN, speaking
from planmethod.mechanism.model import Mechanism
from planmethod.mechanism.structure import Structure, stated_pairs
from planmethod.note.columnar import Column, ColumnarRecords, list_of, record_of, to_builtins
from planmethod.note.columns import bounds, named, numbers_or_none, pairs, sizes
from planmethod.note.compared import Series
from planmethod.note.narrate.structure import MOBILITY
from planmethod.note.numbers import record_float
from planmethod.note.series import compared_extremes
from planmethod.note.tables.errors import quantity_series, segment_series, transfer_series
from planmethod.plans.build import Quantity
from planmethod.plans.model import FACTS, MOTION, PlanKind, pole_letter
from planmethod.plans.motion.legs import Relative
from planmethod.problem.machine_records import Differentiation
from planmethod.problem.model import Problem
from planmethod.problem.quantities import OF_PLANS, SLIDINGS, TURNING, QuantityKind
from planmethod.problem.records import reading_record
from planmethod.solved.aligned.schemes import AlignedGroup, SelfAligning
from planmethod.solved.drawn_shift import shifts
from planmethod.solved.errors.motion import drafting_of
from planmethod.solved.errors.spread import Errors
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.many.positions import Gaps, solver_in
from planmethod.solved.many.variants import Batch
from planmethod.solved.quantities import analogues, error_bound, transfers_of
from planmethod.solved.reading import Complexes, Reals
from planmethod.solved.solution import RelativeMotion, Solution
from planmethod.solved.superposition import parts_by_driver
from planmethod.solved.turn.cycle import CrankCycle, Extreme, NoNumber, crank_cycle_of
from planmethod.solved.turn.diagrams import Diagrams, diagrams_of, quantities_over, values_over
from planmethod.solved.turn.extremes import extreme_construction


def analogue_records(solution: Solution) -> ColumnarRecords:
    """Return the transfer functions of every point and link, for every position of a solution.

    A point has ``x1``, ``y1`` (m per radian of the crank) and ``x2``, ``y2`` (m per radian²); a
    link has ``1`` and ``2`` (of its angle, radians). For a driving slider, per metre of its path.
    """
    points, links = analogues(solution)
    told: dict[str, dict[str, Column]] = {
        name: {
            "x1": numbers_or_none(one.velocity.real),
            "y1": numbers_or_none(one.velocity.imag),
            "x2": numbers_or_none(one.acceleration.real),
            "y2": numbers_or_none(one.acceleration.imag),
        }
        for name, one in points.items()
    }
    for name, (first, second) in links.items():  # which may be called as a point is
        told.setdefault(name, {}).update(
            {"1": numbers_or_none(first), "2": numbers_or_none(second)}
        )
    count = len(solution.positions)
    return record_of({name: record_of(columns) for name, columns in told.items()}, count)


def superposition_records(solution: Solution) -> ColumnarRecords:
    """Return the velocities that each driver alone gives, by driving link, for every position.

    Points have ``vx`` and ``vy``, links ``omega``; the sums are the whole velocities.
    """
    count = len(solution.positions)
    parts = {}
    for link, alone in parts_by_driver(solution).items():
        points = {
            name: record_of(
                {
                    "vx": numbers_or_none(one.velocity.real),
                    "vy": numbers_or_none(one.velocity.imag),
                }
            )
            for name, one in alone.points.items()
        }
        links = {name: numbers_or_none(one.omega) for name, one in alone.links.items()}
        both = {"points": record_of(points, count), "omega": record_of(links, count)}
        parts[link] = record_of(both, count)
    return record_of(parts, count)


def cycle_record(solution: Solution) -> dict[str, Any]:
    """Return the results of the crank's cycle as plain data, SI, degrees of the crank.

    ``value`` and ``stroke`` are m, or degrees of a link. A value that does not exist is None, and
    ``reasons`` says why. Diagrams are in millimetres; the path and exact values repeat the first
    position at the end.
    """
    turn, diagrams = crank_cycle_of(solution), diagrams_of(solution)
    reasons: dict[str, NoNumber | None] = {}
    strokes = turn.strokes
    if strokes is None:
        reasons |= dict.fromkeys(
            ("working_deg", "idle_deg"), turn.why_no_stroke or NoNumber.PARTIAL
        )
    if turn.stroke is None:
        reasons["stroke"] = turn.why_no_stroke
    if strokes is None or strokes.K_v is None:
        reasons["K_v"] = turn.why_no_ratio
    if not turn.is_zero_specified:
        reasons["zero_deg"] = turn.why_no_stroke or NoNumber.PARTIAL
    peak = turn.pressure
    if peak is None:
        reasons["pressure_angle"] = NoNumber.NO_DYAD
    if diagrams.mu_t is None:
        reasons["mu_t"] = NoNumber.NO_RATE
    path = diagrams.fractions[np.argsort(turn.numbers)]
    velocity, acceleration, even = diagrams.speeds(path)
    return {
        "output": turn.output.name,
        "zero_deg": record_float(turn.zero),
        "positions_deg": numbers_or_none(turn.positions),
        "path": numbers_or_none(diagrams.path(path)),
        "velocity": numbers_or_none(velocity),
        "acceleration": numbers_or_none(acceleration),
        "acceleration_even": numbers_or_none(even),
        "extremes": [
            {
                "phi_deg": record_float(one.phi),
                "value": record_float(one.value),
                **_constructed(solution, one),
            }
            for one in turn.extremes
        ],
        "stroke": turn.stroke,
        "K_v": strokes.K_v if strokes else None,
        "working_deg": strokes.working_deg if strokes else None,
        "idle_deg": strokes.idle_deg if strokes else None,
        "by": strokes.by if strokes else None,
        "range_deg": None if turn.range is None else numbers_or_none(turn.range),
        "pressure_angle": None
        if peak is None
        else {
            "max_deg": record_float(peak.maximum),
            "phi_deg": record_float(peak.maximum_at),
            "min_deg": record_float(peak.minimum),
            "min_phi_deg": record_float(peak.minimum_at),
        },
        "diagrams": _diagrams(diagrams),
        "hodograph": _hodograph(turn),
        **({"graphs": _graphs(turn)} if turn.task.graphs else {}),
        **({"reasons": {key: why.value for key, why in reasons.items() if why}} if reasons else {}),
    }


def _constructed(solution: Solution, extreme: Extreme) -> dict[str, float]:
    """Return an extreme position as the ruler reads it, and its sigma, where it is constructed."""
    made, whole = extreme_construction(solution), crank_cycle_of(solution).period
    for both in compared_extremes(made) if made is not None else ():
        if abs((extreme.phi - both.exact + whole / 2) % whole - whole / 2) < 1e-9:
            return {
                "read_deg": record_float(extreme.phi + both.off),
                "sigma_deg": record_float(both.sigma),
            }
    return {}


def _diagrams(diagrams: Diagrams) -> dict[str, Any]:
    s, v_chord, a_chord = diagrams.drawn(Differentiation.CHORDS)
    _, v_exact, a_exact = diagrams.exact(diagrams.fractions)
    return {
        "length_mm": diagrams.length,
        "poles_mm": list(diagrams.poles),
        "mu_phi": diagrams.mu_phi,
        "mu_t": diagrams.mu_t,
        "mu_s": diagrams.mu_s,
        "mu_v": diagrams.mu_v,
        "mu_a": diagrams.mu_a,
        "s_mm": numbers_or_none(s),
        "v_chord_mm": numbers_or_none(v_chord),
        "v_curve_mm": numbers_or_none(diagrams.curve),
        "a_chord_mm": numbers_or_none(a_chord),
        "v_exact_mm": numbers_or_none(v_exact),
        "a_exact_mm": numbers_or_none(a_exact),
    }


def _graphs(turn: CrankCycle) -> dict[str, Any]:
    """Return the quantities of ``[cycle] graphs`` in the positions of the cycle, SI and degrees."""
    return {
        one.label: numbers_or_none(values_over(turn, one, turn.positions))
        for one in quantities_over(turn, turn.task.graphs)
    }


def _hodograph(turn: CrankCycle) -> dict[str, list[list[float | None]]]:
    """Return the velocities of the moving points in the positions of the cycle, m/s."""
    reading = turn.read(turn.positions)
    rate = turn.solution.problem.drive.rate
    found = {}
    plan = turn.unit.construction.kinematics.velocity
    for name, at in plan.named.items():
        velocity = rate * reading.point(plan.point[at])
        if np.any(velocity != 0) or not rate:
            found[name] = pairs(velocity).to_list()
    return found


SCHEMA = 1
"""Version of the record's shape."""


def structure_record(structure: Structure, mechanism: Mechanism) -> dict[str, Any]:
    """Return the structural analysis as plain data."""
    return {
        "mobility": structure.mobility,
        "moving_links": structure.moving_links,
        "lower_pairs": structure.lower_pairs,
        "higher_pairs": structure.higher_pairs,
        "redundant": structure.redundant,
        "class": structure.class_number,
        "groups": [
            {
                "signature": group.signature,
                "class": group.class_number,
                "order": group.order,
                "kind": group.kind,
                "links": list(group.links),
            }
            for group in structure.groups
        ],
        "formula": structure.formula,
        "frame": mechanism.frame,
    }


def _vector(prefix: str, values: Complexes) -> dict[str, Column]:
    return {
        f"{prefix}x": numbers_or_none(values.real),
        f"{prefix}y": numbers_or_none(values.imag),
        prefix: sizes(values),
    }


def _segments(solution: Solution, kind: PlanKind) -> ColumnarRecords:
    """Return the records of the segments of a plan."""
    told = {one.symbol: _compared(one) for one in segment_series(solution, kind)}
    return record_of(told, len(solution.positions))


def _compared(series: Series) -> ColumnarRecords:
    """Return the record of a quantity: ``exact``, ``read``, ``sigma``."""
    columns = {"exact": series.exact, "read": series.read, "sigma": series.sigma}
    return record_of({key: numbers_or_none(values) for key, values in columns.items()})


def _drafting_records(solution: Solution) -> ColumnarRecords:
    """Return the results of the read segments, and the sigmas."""
    spreads, count = drafting_of(solution).spreads, len(solution.positions)

    def read_columns(quantities: list[Quantity]) -> dict[str, Column]:
        """Return quantities and their sigmas."""
        columns: dict[str, Column] = {}
        for quantity in quantities:
            series = quantity_series(solution, quantity)
            name = quantity.kind.record
            columns |= {
                name: numbers_or_none(series.read),
                f"sigma_{name}": numbers_or_none(series.sigma),
            }
        return columns

    def place(name: str) -> dict[str, Column]:
        return {
            f"sigma_{axis}": numbers_or_none(spreads[f"{axis}_{name}"].sigma) for axis in ("x", "y")
        }

    points = {
        name: record_of({**read_columns(quantities), **place(name)})
        for name, quantities in solution.quantities(
            QuantityKind.VELOCITY, QuantityKind.ACCELERATION
        ).items()
    }
    turning = solution.quantities(*OF_PLANS)
    links = {
        name: record_of(read_columns(quantities), count) for name, quantities in turning.items()
    }
    sliding = solution.quantities(*SLIDINGS)
    relatives = solution.construction.kinematics.relatives.values()
    return record_of(
        {
            "ruler": [solution.ruler_arithmetic.ruler] * count,
            "profile": [solution.profile.name] * count,
            "points": record_of(points, count),
            "links": record_of(links, count),
            "relative": list_of(
                [
                    record_of({**_names(r, count), **read_columns(sliding[r.name])})
                    for r in relatives
                ],
                count,
            ),
            **_transfers(solution),
            "monte_carlo": named({k: s.drawn for k, s in spreads.items()}, count),
        }
    )


def _transfers(solution: Solution) -> dict[str, Column | ColumnarRecords]:
    """Return the transfer functions through segments, by label: exact, read, sigma."""
    transfers = transfers_of(solution)
    if transfers is None:
        return {}
    told = {one.label: _compared(one) for one in transfer_series(transfers)}
    return {"transfers": record_of(told)}


def _names(relative: Relative | RelativeMotion, count: int) -> dict[str, Column]:
    names = {"point": relative.point, "of": relative.of, "to": relative.to}
    return {key: [name] * count for key, name in names.items()}


def record(solution: Solution) -> dict[str, Any]:
    """Return everything that a solution says as plain data, SI, full precision.

    ``bound`` is that of the relative error of the motion: of the largest of its kind in the
    position (`planmethod.solved.conditioning.error_bound`).
    ``hand.transfers`` are the transfer functions through segments, by label: ``exact``, ``read``,
    ``sigma``. ``segments`` are in millimetres of the plan: ``exact``, ``read`` with the ruler along
    the hand's own chain, and ``sigma``, one standard deviation of the drafting error. ``hand``
    holds the quantities that follow from the read segments with theirs, and the labels of those
    whose sigma was found by random draws because first order does not hold. ``cycle`` is there for
    a problem with ``[cycle]``, ``forces`` for one with ``[dynamics]``: see
    `planmethod.note.tables.forces`.
    """
    found: dict[str, Any] = to_builtins(record_in_columns(solution))
    return found


def record_in_columns(solution: Solution, **more: Column) -> dict[str, Any]:
    """Return `record` with its positions kept column by column, and more of each position."""
    return _solution_record(solution, record_of({**_columns(solution), **more}))


def _columns(solution: Solution) -> dict[str, Column | ColumnarRecords]:
    """Return what the record says of each position."""
    count = len(solution.positions)
    poles = {kind: pole_letter(solution.problem, kind) for kind in MOTION}
    points = {
        name: record_of(
            {
                "x": numbers_or_none(point.place.real),
                "y": numbers_or_none(point.place.imag),
                **_vector("v", point.velocity),
                **_vector("a", point.acceleration),
            }
        )
        for name, point in solution.points.items()
    }
    links = {
        name: record_of(
            {q.kind.columns[0].removeprefix("."): numbers_or_none(solution.exact(q)) for q in known}
        )
        for name, known in solution.quantities(*TURNING).items()
    }
    relatives = [
        record_of(
            {
                **_names(r, count),
                "v": sizes(r.velocity),
                "a_coriolis": sizes(r.coriolis),
                "a_rel": sizes(r.acceleration),
                "vx": numbers_or_none(r.velocity.real),
                "vy": numbers_or_none(r.velocity.imag),
                "a_coriolis_x": numbers_or_none(r.coriolis.real),
                "a_coriolis_y": numbers_or_none(r.coriolis.imag),
                "a_rel_x": numbers_or_none(r.acceleration.real),
                "a_rel_y": numbers_or_none(r.acceleration.imag),
            }
        )
        for r in solution.relatives
    ]
    plans = {
        kind.value: record_of(
            {
                "mu": numbers_or_none(np.broadcast_to(solution.per_mm[FACTS[kind].scale], count)),
                **({"pole": [poles[kind]] * count} if poles[kind] else {}),
                "segments": _segments(solution, kind),
            }
        )
        for kind in MOTION
    }
    several = bool(solution.problem.drive.other_drives)
    columns: dict[str, Column | ColumnarRecords] = {
        solution.problem.drive.coordinate.column: numbers_or_none(solution.positions),
        "margin": numbers_or_none(solution.margin),
        "bound": bounds(error_bound(solution)),
        "points": record_of(points, count),
        "links": record_of(links, count),
        **({} if several else {"analogues": analogue_records(solution)}),
        "relative": list_of(relatives, count),
        "plans": record_of(plans),
        "hand": _drafting_records(solution),
    }
    if several:
        columns["superposition"] = superposition_records(solution)
    if solution.problem.dynamics is not None:
        from planmethod.note.tables.forces import forces_records

        columns["forces"] = forces_records(solution)
    return columns


def _solution_record(solution: Solution, positions: ColumnarRecords | list[Any]) -> dict[str, Any]:
    """Return the record of a solution with the records of its positions."""
    machine = {}
    if solution.problem.machine is not None:
        from planmethod.note.records.machine import machine_record
        from planmethod.solved.machine.flywheel import flywheel_of

        machine["machine"] = machine_record(flywheel_of(solution), solution.profile)
    if solution.problem.balancing is not None:
        from planmethod.note.records.machine import balancing_record

        machine["balancing"] = balancing_record(solution)
    if solution.problem.synthesis is not None:
        from planmethod.note.synthesis.drawing import file_record
        from planmethod.note.synthesis.verification import measured_on

        machine["synthesis"] = file_record(solution, measured_on(solution))
    dynamics = solution.problem.dynamics
    if dynamics is not None and dynamics.friction is not None:
        from planmethod.note.tables.forces import friction_cycle_record
        from planmethod.solved.cycle_forces import cycle_efficiency

        turn = cycle_efficiency(solution)
        machine["friction"] = {"turn": None if turn is None else friction_cycle_record(turn)}
    return {
        "schema": SCHEMA,
        "problem": solution.problem.name,
        **({"variant": v} if (v := solution.problem.variant) is not None else {}),
        **reading_record(solution.problem),
        **_figure_record(solution.problem),
        "structure": structure_record(solution.structure, solution.problem.mechanism),
        **({"cycle": cycle_record(solution)} if solution.problem.cycle is not None else {}),
        "positions": positions,
        **machine,
    }


def _figure_record(problem: Problem) -> dict[str, Any]:
    """Return the coordinates of a figure, the sizes that follow, and what rounding moves."""
    if problem.drawn is None or problem.drawn.shown is None:
        return {}
    shown = problem.drawn.shown
    return {
        "drawn": {
            "points": {name: [z.real, z.imag] for name, z in shown.places.items()},
            "round": shown.step,
            "sizes": [
                {"path": ".".join(size.path), "exact": size.exact, "value": size.value}
                for size in shown.sizes
                if size.path[-1] != "side"
            ],
            "moved": shifts(problem) if shown.step is not None else {},
        }
    }


def partial_record(
    problem: Problem, positions: Reals, gaps: Gaps, profile: Profile
) -> dict[str, Any]:
    """Return `record` of positions of which some are impossible.

    Every position has a ``reason``: None where all is solved. Where the motion is impossible all
    else but the driver's place is None; where only the forces are, ``forces`` is.
    """
    able, moving = gaps.reason < 0, gaps.moving

    solve_at = solver_in(problem, positions, gaps, profile)

    entries: dict[int, dict[str, Any]] = {}
    for asked, chosen in ((replace(problem, dynamics=None), moving & ~able), (problem, able)):
        if chosen.any():
            places = np.flatnonzero(chosen)
            told = record_of(_columns(solve_at(asked, places))).to_list()
            entries |= dict(zip(places.tolist(), told, strict=True))
    names = list(dict.fromkeys(name for entry in entries.values() for name in entry))
    driver = problem.drive.coordinate.column
    with speaking(WRITTEN):  # the bytes of a file do not depend on the system's language
        kinds = [*map(str, gaps.kinds), None]
    return _solution_record(
        solve_at(problem, np.flatnonzero(able)),
        [
            {
                driver: record_float(float(place)),
                **dict.fromkeys(name for name in names if name != driver),
                **entries.get(index, {}),
                "reason": kinds[gaps.reason[index]],
            }
            for index, place in enumerate(positions)
        ],
    )


def batch_records(batch: Batch) -> Iterator[dict[str, Any]]:
    """Yield `record` of each variant of a batch, its positions cut out of all of them."""
    common = to_builtins(record_in_columns(batch))
    common.pop("variant", None)
    for problem, own in zip(batch.problems, batch.rows, strict=True):
        named = {"schema": SCHEMA, "problem": problem.name}
        if problem.variant is not None:
            named["variant"] = problem.variant
        named |= _figure_record(problem)
        yield {**named, **common, **named, "positions": common["positions"][own]}


def finite(value: Any) -> bool:
    """Return whether every number of a record is finite."""
    if isinstance(value, dict):
        return all(finite(v) for v in value.values())
    if isinstance(value, list):
        return all(finite(v) for v in value)
    return not isinstance(value, float) or bool(np.isfinite(value))


def structure_in_full(
    structure: Structure, mechanism: Mechanism, aligned: SelfAligning
) -> dict[str, Any]:
    """Return `structure_record` with the pairs, W in space and the schemes with q = 0."""
    rows = [
        {
            "pair": f"{pair.point} {'-'.join(pair.links)}",
            "kind": pair.kind.value,
            "plane": int(MOBILITY[pair.kind][1]),
            "space": int(MOBILITY[pair.kind][2]),
        }
        for pair in stated_pairs(mechanism)
    ]
    return {
        **structure_record(structure, mechanism),
        "spatial_mobility": structure.spatial_mobility,
        "local_mobility": structure.local_mobility,
        "pairs": rows,
        "self_aligning": aligned_record(aligned),
    }


# no messages: reasons in JSON
def aligned_record(aligned: SelfAligning) -> dict[str, Any]:
    """Return the schemes without redundant constraints, best first; else the reason for none.

    Keys are a joint or pin and the links of the pair, the frame 0; values the classes of
    `planmethod.solved.aligned.schemes`. Where schemes leave local mobilities, ``local_mobility``
    has how many, in the order of the schemes, and the reason; ``sizes`` is there where they are
    random, as the file's close nowhere.
    """
    record: dict[str, Any] = {
        "valid": bool(aligned.schemes),
        "schemes": [dict(scheme) for scheme in aligned.schemes],
        "rank": aligned.rank,
        "groups": [_group(group) for group in aligned.groups],
    }
    if not aligned.schemes:
        links = "; ".join("-".join(group.links) for group in aligned.without)
        record["reason"] = f"no choice of pairs of the links {links} has full rank"
    elif any(aligned.local):
        links = "; ".join("-".join(one.links) for one in aligned.groups if one.schemes[0].local)
        record["local_mobility"] = list(aligned.local)
        record["reason"] = f"every scheme of the links {links} with q = 0 leaves a local mobility"
    if aligned.random:
        record["sizes"] = "random"
    return record


def _group(group: AlignedGroup) -> dict[str, Any]:
    def named(classes: tuple[str, ...]) -> dict[str, str]:
        return dict(zip((pair.key for pair in group.pairs), classes, strict=True))

    return {
        "links": list(group.links),
        "schemes": [named(scheme.classes) for scheme in group.schemes],
        "right_by_count_only": [named(scheme.classes) for scheme in group.counted],
    }


def _errors(solution: Solution) -> Errors:
    if solution.problem.dynamics is None:
        return drafting_of(solution)
    from planmethod.solved.errors.forces import all_errors

    return all_errors(statics_of(solution))


def covariance_text(solutions: list[Solution]) -> str:
    """Return the covariance of every pair of quantities, as CSV.

    A row for each quantity of each position: problem, variant, position (from 0), quantity, its
    sigma, and its covariance with every quantity in the order of the header. Quantities are in SI
    units, segments (``velocity.p-b``) in millimetres of the plan, directions of reactions in
    degrees; all to first order. Forces are there for a problem with ``[dynamics]``.
    """
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    before: list[str] | None = None
    for solution in solutions:
        errors = _errors(solution)
        labels = list(errors.items)
        header = ["problem", "variant", "position", "quantity", "sigma", *labels]
        if header != before:
            writer.writerow(header)
        before = header
        problem = solution.problem
        for i in range(len(solution.positions)):
            matrix = errors.covariance(labels, i)
            for k, label in enumerate(labels):
                sigma = float(matrix[k, k]) ** 0.5
                told = [problem.name, problem.variant or "", i, label, sigma]
                writer.writerow([*told, *matrix[k].tolist()])
    return text.getvalue()
