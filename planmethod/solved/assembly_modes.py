"""Choice of the assembly mode of each group (способ сборки групп)."""

from __future__ import annotations

from collections.abc import Collection, Hashable, Mapping, Sequence
from itertools import islice, pairwise
from math import isfinite
from typing import TypeAlias

import numpy as np
from msgspec.structs import replace

from planmethod.construct.arithmetic import Float64, Number
from planmethod.construct.evaluate import Trace, evaluate
from planmethod.construct.steps import GivenNumber, GivenPoint, PointName, Step
from planmethod.errors import Fault, PlanMethodError, ProblemError, StructureError
from planmethod.languages import translate
from planmethod.mechanism.groups import AssurGroup, triad_of
from planmethod.mechanism.structure import Structure, analyse
from planmethod.plans.build import Construction, add_group, begin_positions, build
from planmethod.plans.columns import (
    Column,
    DisagreementError,
    agreed,
    in_columns,
    kind_of_plan,
)
from planmethod.plans.draft import Draft
from planmethod.plans.model import AssemblyMode, assembly_period
from planmethod.plans.motion.position import (
    has_two_modes,
    inner_point,
)
from planmethod.problem.letters import unused_letters
from planmethod.problem.model import AssemblyRelation, Problem, Rule
from planmethod.problem.names import format_length, format_place
from planmethod.solved.assemblies import Assembled, best_third, choose
from planmethod.solved.failures import Cause, Failure, Place, PositionError, explain
from planmethod.solved.reading import Flags, Reading, Reals, driven, other_place
from planmethod.solved.rules import (
    TIE,
    Tried,
    ambiguous_fault,
    changes,
    distinguishing_rules,
    from_joint,
    late_fault,
    rule_text,
    score_of,
    slotted_rule,
    unkept_fault,
)
from planmethod.solved.wheel_turns import count_turns


def structure_of(problem: Problem) -> Structure:
    """Return the groups of the mechanism of a problem.

    Raises
    ------
    StructureError
        As of `analyse`; with a hint if wheels of ``[gears]`` have the names of links.
    """
    try:
        return analyse(problem.mechanism)
    except StructureError as error:
        wheels = problem.tables.get("gears", {}).get("wheels")
        named = [name for name in problem.mechanism.links if name in (wheels or {})]
        if not isinstance(wheels, Mapping) or len(named) < 2:
            raise
        text = translate(
            "Wheels {} of [gears] have the names of links, but a train is beside the linkage. "
            "Give a mesh of wheels on links in [[meshes]], or other names to the wheels.",
            ", ".join(named),
        )
        raise StructureError(f"{error} {text}") from error


def drive_data(
    problem: Problem, draft: Draft, positions: Reals
) -> dict[str, complex | float | Reals]:
    """Return the data of a program at unit scales: a millimetre of the plan is then a metre."""
    drive = problem.drive
    data: dict[str, complex | float | Reals] = dict(draft.numbers)
    data.update(draft.places)
    data.update({name: one.branch(positions) for name, one in draft.branches.items()})
    data.update(mu_l=1.0, mu_v=1.0, mu_a=1.0)
    data.update(zip(drive.program_inputs, driven(drive, positions), strict=True))
    for other in drive.other_drives:
        rates = other.rate, other.acceleration
        placed = (other_place(drive, other, positions), *rates)
        data.update(zip(other.program_inputs, placed, strict=True))
    return data


def reject_ambiguous(problem: Problem, draft: Draft, positions: Reals | None = None) -> None:
    """Reject positions, or all motion, in which no rule of the file determines how a group closes.

    Raises
    ------
    PositionError
    """
    for closing in draft.choice.values():
        known = positions is not None and np.isin(positions, closing.only_at).all()
        if closing.only_at and not known:
            raise PositionError(_coincident_failure(problem, closing.point, closing.start))


def _coincident_failure(problem: Problem, point: str, at: float) -> Failure:
    place = Place.of(problem, np.array([at]), 0)
    return Failure(Cause.COINCIDENT, place, point, problem=problem.name)


def construct(problem: Problem) -> Construction:
    """Return the construction of a problem: its groups, assembly modes and plans as one program.

    It is made once for a problem: positions, scales and drafting accuracies are readings of it. The
    latest ones are cached, because a command uses a problem several times.

    Raises
    ------
    StructureError, ProblemError, AssemblyError
        When the mechanism cannot be analysed or assembled.
    """
    global _CACHE
    for known, made in _CACHE:
        if known is problem:
            return made
    (found,) = _construct_alike([problem], structure_of(problem))
    if isinstance(found, PlanMethodError):
        raise found
    _CACHE = ((problem, found), *_CACHE[:1])
    return found


_CACHE: tuple[tuple[Problem, Construction], ...] = ()
"""The latest problems, compared by identity, and their constructions. The tuple is replaced, never
changed: another thread may be iterating over it."""


def construct_each(problems: Sequence[Problem]) -> list[Construction | None]:
    """Return the constructions of problems, None where there is none: solved alone it says why.

    Problems that differ in sizes are planned at once, and their assembly modes are chosen by
    common readings: as often as there are ways in which they are drawn.
    """
    found: list[Construction | None] = [None] * len(problems)
    alike: dict[Hashable, list[int]] = {}
    for k, problem in enumerate(problems):
        alike.setdefault(kind_of_plan(problem), []).append(k)
    waiting = [*alike.values()]
    while waiting:
        members = waiting.pop()
        own = [problems[k] for k in members]
        try:
            for k, made in zip(
                members, _construct_alike(own, analyse(own[0].mechanism)), strict=True
            ):
                found[k] = made if isinstance(made, Construction) else None
        except DisagreementError as apart:
            for answer in dict.fromkeys(apart.answers):
                pairs = zip(members, apart.answers, strict=True)
                waiting.append([k for k, one in pairs if one == answer])
        except PlanMethodError:
            continue
    return found


def _construct_alike(
    problems: Sequence[Problem], structure: Structure
) -> list[Construction | PlanMethodError]:
    """Return the constructions of problems that are planned at once, or why there is none.

    Raises
    ------
    DisagreementError
        They are not drawn by the same steps.
    """
    chosen = _ModeChoice(problems, structure).modes()
    good = [modes for modes in chosen if not isinstance(modes, PlanMethodError)]
    if not good:
        return [one for one in chosen if isinstance(one, PlanMethodError)]
    made = build(in_columns(problems), structure, good[0])
    unused = unused_letters(problems[0].letters, made.kinematics.velocity.point)
    if unused:
        raise ProblemError(problems[0].name, unused)
    if len(problems) == 1:
        return [made]
    return [
        modes
        if isinstance(modes, PlanMethodError)
        else replace(made, draft=made.draft.of_variant(k, problems[k], modes))
        for k, modes in enumerate(chosen)
    ]


Modes: TypeAlias = dict[tuple[str, ...], AssemblyMode]


def choose_modes(problem: Problem, structure: Structure) -> Modes:
    """Return the assembly mode of every group that has two.

    Raises
    ------
    ProblemError
        When a group that needs a rule has none, a rule is about a point it cannot move, or one
        cannot be kept; all such faults at once. When both modes satisfy a rule.
    AssemblyError
        When a group closes in no requested position, or neither mode satisfies its rule.
    """
    (found,) = _ModeChoice([problem], structure).modes()
    if isinstance(found, PlanMethodError):
        raise found
    return found


def keeps_modes(construction: Construction, columns: Mapping[str, Number], count: int) -> Flags:
    """Return for which numbers the rules choose the modes that a construction has.

    False if the file must be read: the first position does not exist or does not distinguish the
    modes, or the group is a triad, a parallelogram, or passes change points.

    Parameters
    ----------
    columns : mapping of str to ndarray of shape (count,)
        Numbers of the program that differ from those of the construction.
    """
    problem, choice = construction.draft.problem, construction.draft.choice
    positions = np.array((problem.drive.assembly_positions or problem.drive.positions)[:1])
    rules, bodies = {rule.point: rule for rule in problem.rules}, problem.bodies
    settled, extent = begin_positions(problem, {}), _Extent(count)
    kept = np.ones(count, dtype=bool)
    for group in construction.structure.groups:
        own = {point: None for link in group.links for point in bodies[link].points}
        mine = [
            from_joint(problem, group, rules[point])
            for point in own
            if point in rules and point not in settled.marked
        ]
        mode = choice.get(group.links, AssemblyMode())
        if mode != AssemblyMode(mode.side, start=mode.start) or len(mine) > 1:
            return np.zeros(count, dtype=bool)
        if mine:
            both: list[Tried] = []
            for sign in (1, -1):
                draft = _with(settled, group, AssemblyMode(sign))
                data = drive_data(problem, draft, positions)
                data |= {name: column for name, column in columns.items() if name in data}
                trace = evaluate(draft.b.program(), data, Float64())
                both.append((draft, Reading(trace, count)))
            extent.update(settled.marked, both[:1])
            sides = _sides(mine[0], both, extent.of(both), range(count))
            kept &= np.array([sides.get(k) == mode.side for k in range(count)])
            kept &= mode.start == positions[0]
        settled.choice = {**settled.choice, group.links: mode}
        add_group(settled, group)
    return kept


class _ModeChoice:
    """Choice of the assembly modes of problems that are planned at once, group by group.

    Parameters
    ----------
    problems : sequence of Problem
        Of one kind (`kind_of_plan`).
    structure : Structure
    """

    def __init__(self, problems: Sequence[Problem], structure: Structure) -> None:
        self.problems, self.structure = problems, structure
        own = [
            np.asarray(one.drive.assembly_positions or one.drive.positions, dtype=float)
            for one in problems
        ]
        self.positions = np.concatenate(own)
        ends = np.cumsum([0, *map(len, own)]).tolist()
        self.rows = [slice(start, end) for start, end in pairwise(ends)]
        self.choices: list[Modes] = [{} for _ in problems]
        self.faults: list[list[Fault]] = [[] for _ in problems]
        self.failed: dict[int, PlanMethodError] = {}
        self.settled = begin_positions(in_columns(problems), {})
        self._reader = _IncrementalReader([len(rows) for rows in own])
        if len(problems) > 1 and (
            isinstance(self.settled.origin, Column)
            or any(triad_of(group) or group.is_toothed for group in structure.groups)
        ):
            raise DisagreementError(range(len(problems)))

    def modes(self) -> list[Modes | PlanMethodError]:
        """Return the modes of each problem, or why there are none.

        Raises
        ------
        DisagreementError
            The groups of the problems close in different ways.
        """
        rules = {rule.point: rule for rule in self.problems[0].rules}
        used: set[str] = set()
        extent = _Extent(len(self.positions))
        before: AssurGroup | None = None
        for group in self.structure.groups:
            if before is not None:
                add_group(self.settled, before)
            before = group
            bodies = self.problems[0].bodies
            own = {point: None for link in group.links for point in bodies[link].points}
            mine = [
                from_joint(self.problems[0], group, rules[point])
                for point in own
                if point in rules and point not in self.settled.marked
            ]
            used.update(rule.point for rule in mine)
            if triad_of(group) is not None:
                mode, wrong = _assembled(self.settled, group, mine, self.positions)
                self.choices[0][group.links] = mode
                self.faults[0] += wrong
            elif group.is_toothed:
                self._count(group)
            elif has_two_modes(group):
                self._choose(group, mine, extent)
            self._agree(group)
        unused = [rule.point for rule in self.problems[0].rules if rule.point not in used]
        for k, problem in enumerate(self.problems):
            self.faults[k] += [_placed_already(point) for point in unused]
            if self.faults[k]:
                self.failed.setdefault(k, ProblemError(problem.name, self.faults[k]))
        return [self.failed.get(k, own) for k, own in enumerate(self.choices)]

    def _count(self, group: AssurGroup) -> None:
        """Count the turns of the links by which a mesh moves a wheel."""
        problem, base = self.problems[0], self.settled

        def data(draft: Draft, positions: Reals) -> Mapping[str, Number]:
            return drive_data(problem, draft, positions)

        start = float(self.positions[0])
        mode = count_turns(lambda mode: _with(base, group, mode), group, data, start)
        self.choices[0][group.links] = mode

    def _agree(self, group: AssurGroup) -> None:
        """Close a group of the common plan as all problems do."""
        modes = [own.get(group.links) for own in self.choices]
        known = [mode for k, mode in enumerate(modes) if k not in self.failed]
        first = known[0] if known else None
        if len(modes) > 1:
            ways = [
                None if mode is None else (mode.side, mode.parallel, k if mode.changes else -1)
                for k, mode in enumerate(modes)
            ]
            kept = next((way for k, way in enumerate(ways) if k not in self.failed), None)
            agreed([kept if k in self.failed else way for k, way in enumerate(ways)])
        if first is not None:
            self.settled.choice = {**self.settled.choice, group.links: first}

    def _choose(self, group: AssurGroup, mine: list[Rule], extent: _Extent) -> None:
        """Choose the mode of a group for every problem."""
        both: list[Tried] = []
        for sign in (1, -1):
            draft = _with(self.settled, group, AssemblyMode(sign))
            both.append(
                (draft, self._reader.read(draft, len(self.settled.b.steps), self.positions))
            )
        extent.update(self.settled.marked, both[:1])
        size = extent.of(both)
        plain = (
            len(mine) == 1 and not mine[0].continuous and late_fault(mine[0], both[0][0]) is None
        )
        sides = _sides(mine[0], both, size, [rows.start for rows in self.rows]) if plain else {}
        for k, rows in enumerate(self.rows):
            if k in self.failed:
                continue
            self.choices[k][group.links] = AssemblyMode()
            if k in sides:
                start = float(self.positions[rows.start])
                self.choices[k][group.links] = AssemblyMode(sides[k], start=start)
                continue
            try:
                self._choose_alone(k, group, mine, both, size)
            except PlanMethodError as error:
                self.failed[k] = error

    def _choose_alone(
        self, k: int, group: AssurGroup, mine: list[Rule], drafts: list[Tried], size: Reals
    ) -> None:
        """Choose the mode of a group for one of the problems."""
        problem, rows, faults = self.problems[k], self.rows[k], self.faults[k]
        positions, both = self.positions[rows], drafts
        if len(self.problems) > 1:
            both = [
                (draft.of_variant(k, problem, draft.choice), reading.part(rows))
                for draft, reading in drafts
            ]
        late = [late_fault(rule, both[0][0]) for rule in mine] + [
            unkept_fault(problem, rule, group) for rule in mine
        ]
        if any(late):
            faults += [fault for fault in late if fault is not None]
        elif any(rule.relation is AssemblyRelation.PARALLEL for rule in mine):
            self.choices[k][group.links] = AssemblyMode(parallel=True)
        elif mine:
            judged = [_choose_side(problem, rule, both, positions, size[rows]) for rule in mine]
            self.choices[k][group.links] = judged[0]
            if any(rule.continuous for rule in mine):
                going_on = _going_on(problem, both[0], group, judged[0])
                self.choices[k][group.links] = going_on
            faults += [
                Fault(
                    f"assembly.{rule.point}",
                    translate(
                        "'{}' and '{}' require different assemblies of links {}",
                        rule_text(rule, problem.unit),
                        rule_text(mine[0], problem.unit),
                        ", ".join(group.links),
                    ),
                    "Keep the correct one",
                )
                for rule, closing in zip(mine, judged, strict=True)
                if closing.side != judged[0].side
            ]
        else:
            untold = slotted_rule(problem, group) if group.signature == "RPR" else None
            if untold is None and group.signature == "RPR":
                return
            try:
                faults.append(_missing(group, both, positions, untold))
            except PositionError:
                if not faults:  # otherwise an earlier group may be on the side that is not meant
                    raise


def _sides(
    rule: Rule, both: Sequence[Tried], extent: Reals, starts: Sequence[int]
) -> dict[int, int]:
    """Return the sides that a rule selects in the first positions of problems, by their numbers.

    Problems that need an error message are left out: see `_choose_side`.
    """
    if rule.relation is AssemblyRelation.PARALLEL:
        return {}
    plus, minus = (score_of(rule, draft, reading)[starts] for draft, reading in both)
    one, two = (reading.point(PointName(rule.point))[starts] for _, reading in both)
    least = TIE * extent[starts]
    clear = (abs(one - two) > least) & (abs(plus - minus) > least)
    if rule.relation is not AssemblyRelation.NEAR:
        clear &= (np.minimum(plus, minus) <= least) & (np.maximum(plus, minus) > 0)
    clear &= np.isfinite(plus) & np.isfinite(minus)
    sides = np.where(plus > minus, 1, -1)
    return {int(k): int(sides[k]) for k in np.flatnonzero(clear)}


def _placed_already(point: str) -> Fault:
    return Fault(
        f"assembly.{point}",
        translate("{} belongs to the frame or to the driving link: it has one place", point),
        "Delete the rule, or name a point that a group places",
    )


def _assembled(
    base: Draft, group: AssurGroup, rules: list[Rule], positions: Reals
) -> tuple[AssemblyMode, list[Fault]]:
    """Return the assembly of the triad to be placed next, and the faults of its rules."""
    problem, triad = base.problem, triad_of(group)
    assert triad is not None

    def assemble(mode: AssemblyMode) -> Assembled:
        draft = _with(base, group, mode)
        program = draft.b.program()
        return Assembled(draft, program, lambda s: drive_data(problem, draft, s), group, triad)

    drawn = assemble(AssemblyMode())
    late = [late_fault(rule, drawn.draft) for rule in rules]
    late += [unkept_fault(problem, rule, group) for rule in rules]
    if any(late):
        return AssemblyMode(), [fault for fault in late if fault is not None]
    closing, faults = choose(drawn, rules, positions)
    if not faults:
        closing = replace(closing, third=best_third(assemble(closing), positions))
    return closing, faults


def _going_on(
    problem: Problem, tried: Tried, group: AssurGroup, mode: AssemblyMode
) -> AssemblyMode:
    """Return a mode that changes sides where the motion passes a change point."""
    draft, program = tried[0], tried[0].b.program()
    turn, low = problem.drive.coordinate.turn, mode.start
    if problem.drive.goes_round:
        # the links it is joined to may repeat only after two turns, and the changes with them
        settled = {links: one for links, one in draft.choice.items() if links != group.links}
        again = assembly_period(settled, turn)
        turn = again if isfinite(again) else turn
    high = low + turn
    if not problem.drive.goes_round:
        way = sum(abs(length) for _, _, length in problem.lengths)
        low, high, turn = low - way, low + way, mode.period
    around = problem.drive.goes_round
    found = changes(
        draft, program, lambda s: drive_data(problem, draft, s), group, (low, high), around=around
    )
    return replace(mode, changes=found, period=turn)


def _with(base: Draft, group: AssurGroup, mode: AssemblyMode) -> Draft:
    """Return a position plan with one group more, which closes in some way."""
    draft = base.copy()
    draft.choice = {**base.choice, group.links: mode}
    add_group(draft, group)
    return draft


class _IncrementalReader:
    """Incremental evaluator of growing position plans: shared steps are computed once.

    Parameters
    ----------
    counts : sequence of int
        Positions of each of the problems that are planned at once.
    """

    def __init__(self, counts: Sequence[int]) -> None:
        self.counts = counts
        self._reading = Reading(Trace({}, {}), sum(counts))
        self._read = 0

    def read(self, draft: Draft, fixed_steps: int, positions: Reals) -> Reading:
        """Return the reading of a draft whose first steps every later one shares."""
        steps, data = draft.b.steps, drive_data(draft.problem, draft, positions)
        if len(self.counts) > 1:
            data = {name: self._filled(value) for name, value in data.items()}
        self._reading = _further(self._reading, steps[self._read : fixed_steps], data)
        self._read = fixed_steps
        return _further(self._reading, steps[fixed_steps:], data)

    def _filled(self, value: Number) -> Number:
        """Return a number of every problem in every position."""
        if isinstance(value, Column):
            return np.repeat(np.asarray(value.values), self.counts)
        return value if np.ndim(value) else np.full(sum(self.counts), value)


def _further(before: Reading, steps: Sequence[Step], data: Mapping[str, Number]) -> Reading:
    """Return a reading extended by further steps with their part of the data."""
    given = [step.out for step in steps if isinstance(step, GivenPoint | GivenNumber)]
    own: dict[str, Number] = {name: data[name] for name in given}
    return before.extend(steps, own, Float64())


class _Extent:
    """Distance of the farthest point from the first placed one, in every position, m."""

    def __init__(self, count: int) -> None:
        self._far = np.full(count, 1e-300)
        self._taken = 0

    def update(self, points: Collection[str], read: Sequence[Tried]) -> None:
        """Add the points that are new since the last call."""
        self._far, self._taken = self._with(points, read), len(points)

    def of(self, both: Sequence[Tried]) -> Reals:
        """Return the extent of the fixed steps and of a group in both modes."""
        return self._with(both[0][0].marked, both)

    def _with(self, points: Collection[str], read: Sequence[Tried]) -> Reals:
        far = self._far
        for _, reading in read:
            first = reading.point(PointName(next(iter(points))))
            for name in islice(points, self._taken, None):
                away = np.abs(reading.point(PointName(name)) - first)
                far = np.fmax(far, np.where(np.isfinite(away), away, 0.0))
        return far


def _explained(both: list[Tried], positions: Reals) -> Failure:
    """Return the reason why a group closes in none of the positions."""
    draft, reading = both[0]
    program = draft.b.program()

    def read(at: Reals) -> Reading:
        data = drive_data(draft.problem, draft, at)
        return Reading(evaluate(program, data, Float64()), len(at))

    return explain(draft, program, reading, positions, read)


def _choose_side(
    problem: Problem,
    rule: Rule,
    both: list[Tried],
    positions: Reals,
    extent: Reals,
) -> AssemblyMode:
    """Return the side that a rule selects in the first position that distinguishes the modes."""
    scores = [score_of(rule, draft, reading) for draft, reading in both]
    able = np.flatnonzero(np.isfinite(scores[0]) & np.isfinite(scores[1]))
    if not able.size:
        raise PositionError(_explained(both, positions))
    size = float(extent[able[0]])
    one, two = (reading.point(PointName(rule.point)) for _, reading in both)
    apart = abs(one - two)
    # A dead position does not distinguish the modes: the next requested one does.
    distinct = able[apart[able] > TIE * size]
    if not distinct.size:
        # The arcs touch: there is one place, which exists. No side is known of the motion, nor of
        # other positions.
        at = tuple(float(place) for place in positions[able])
        return AssemblyMode(start=at[0], point=rule.point, only_at=at)
    first = int(distinct[0])
    plus, minus = float(scores[0][first]), float(scores[1][first])
    place = Place.of(problem, positions, first)
    phrase = rule_text(rule, problem.unit)
    if abs(plus - minus) <= TIE * size:
        raise ProblemError(
            problem.name,
            [
                Fault(
                    f"assembly.{rule.point}",
                    translate(
                        "'{}' does not distinguish the two assemblies at {}: both give {}",
                        phrase,
                        place.driver,
                        format_length(plus, problem.unit),
                    ),
                    "Compare with another point or with a directed line",
                )
            ],
        )
    if rule.relation is not AssemblyRelation.NEAR and min(plus, minus) > TIE * size:
        raise ProblemError(problem.name, [ambiguous_fault(rule, both, first, place.driver)])
    if rule.relation is not AssemblyRelation.NEAR and max(plus, minus) <= 0:
        missed = (-plus, -minus)
        raise PositionError(Failure(Cause.NEITHER, place, phrase, (rule.point,), missed))
    return AssemblyMode(1 if plus > minus else -1, start=float(positions[first]))


# no messages: rules, in the words of the file
def _missing(
    group: AssurGroup, both: list[Tried], positions: Reals, suggested_rule: Rule | None
) -> Fault:
    """Return the fault of a group whose mode is not given, with a rule for each mode.

    Raises
    ------
    PositionError
        The group closes in no position: a rule would not help.
    """
    c = inner_point(group) if suggested_rule is None else suggested_rule.point
    places = []
    for draft, reading in both:
        values = reading.point(PointName(c)) + draft.origin
        able = values[np.isfinite(values)]
        if not able.size:
            raise PositionError(_explained(both, positions))
        places.append(format_place(complex(able[0]), both[0][0].problem.unit))
    hint = translate(
        'Add {} = "right of ..." (or left of, above, below, or {{ near = [x, y] }}) to [assembly]',
        c,
    )
    words = [] if suggested_rule else distinguishing_rules(c, both, slice(None))
    if suggested_rule is not None:
        ahead = [score_of(suggested_rule, draft, reading) for draft, reading in both]
        sides = [float(np.nansum(score)) for score in ahead]
        if sides[0] * sides[1] < 0:  # both lie to one side if far off the line
            words = [f"towards {suggested_rule.refs[0]}", f"away from {suggested_rule.refs[0]}"]
            words = words if sides[0] > 0 else words[::-1]
    if words:
        hint = translate(
            'Add {} = "{}" for the first or "{}" for the second to [assembly]', c, *words
        )
    return Fault(
        f"assembly.{c}",
        translate(
            "links {} can be assembled in two ways, with {} at ({}) or at ({}) {}, "
            "and no rule selects one",
            ", ".join(group.links),
            c,
            *places,
            translate(both[0][0].problem.unit),
        ),
        hint,
        tuple(words),
    )
