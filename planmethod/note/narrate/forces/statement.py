"""The statement of the force analysis: given data and unknowns (Дано, Определить)."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import assert_never

from planmethod.note.document import GivenFact
from planmethod.note.narrate.forces.springs import spring_facts
from planmethod.note.narrate.naming import point_name
from planmethod.note.narrate.stated_links import StatedNumbers
from planmethod.note.narrate.statement import NBSP, given_facts
from planmethod.note.numbers import Notation, with_unit
from planmethod.note.wording import Language
from planmethod.plans.forces.polygons import Applied, ForcePlan, LoadKind, reaction_symbol
from planmethod.problem.model import Problem
from planmethod.problem.names import segment
from planmethod.problem.placement import rotation
from planmethod.problem.records import (
    Against,
    Couple,
    Fixed,
    Interpolation,
    Load,
    Over,
    SizeTable,
    Spring,
    SpringEnd,
    largest_size,
)
from planmethod.solved.forces.friction import pair_data
from planmethod.solved.forces.reading import NEGLIGIBLE_FRACTION, ForceReading
from planmethod.solved.forces.statics import Statics, statics_of
from planmethod.solved.solution import Solution


def link_names(links: tuple[str, ...]) -> str:
    """Return links as a title has them: ``4–5``."""
    return "–".join(links)


def plan_title(reading: ForceReading, plan: ForcePlan, language: Language) -> str:
    """Return the name of the free body: ``Группа звеньев 4–5``, ``Начальное звено 1``."""
    is_driver = plan.links in {(link,) for link in reading.solution.problem.drive.links}
    title = language.sheets.cut_driver if is_driver else language.sheets.cut_group
    return title.format(links=link_names(plan.links))


def statement(reading: ForceReading, language: Language) -> list[GivenFact]:
    """Return the given facts: the mechanism, masses, moments of inertia, external loads."""
    problem, index = reading.solution.problem, reading.index
    dynamics = problem.dynamics
    assert dynamics is not None
    facts = given_facts(problem, language, [float(reading.solution.positions[index])])
    facts += mass_lines(problem, language)
    text = StatedNumbers(problem, language)
    for contact in reading.statics.contacts.values():
        if contact.length is not None:
            by = problem.mechanism.called(contact.joint.by)
            letter = reaction_symbol(contact.joint.on, by, letter="a")
            path = f"links.{segment(contact.joint.on)}.slides.length"
            known = contact.joint.on in problem.slides
            own: dict[str, object] = {path: contact.length} if known else {}
            facts.append(GivenFact(f"{letter} = {text.metres(contact.length)}", own))
    loads = {load.name: load for load in dynamics.loads}
    for one in _external(reading):
        size = abs(complex(one.force[index])) if one.point else abs(float(one.couple[index]))
        if not size:
            continue
        unit = language.notation.units["N" if one.point else "N·m"]
        phrase = f"{language.notation.computed(size)} {unit}"
        if one.name not in loads:
            facts.append(GivenFact(f"{one.name} = {phrase}"))
            continue
        load = loads[one.name]
        path = f"{load.path}.{load.key}"
        match load.size:
            case SizeTable():
                signed = float(one.couple[index]) if isinstance(load, Couple) else size
                if isinstance(load, Load) and isinstance(load.sense, Fixed):
                    along = complex(one.force[index]) / rotation(load.sense.angle)
                    signed = math.copysign(size, along.real)
            case Spring():  # it has a fact of its own
                continue
            case int() | float() as signed:
                phrase = text.number(size, load.unit, path)
            case _:
                assert_never(load.size)
        where, data = _placement(load, signed, language)
        data[path] = signed
        facts.append(GivenFact(f"{one.name} = {phrase} ({where})", data))
    facts += spring_facts(problem, language)
    return [*facts, *_pushed(problem, language), *_in_pairs(reading.statics, language)]


def mass_lines(problem: Problem, language: Language) -> list[GivenFact]:
    """Return the masses, moments of inertia and the acceleration of free fall as the file has."""
    dynamics, text, facts = problem.dynamics, StatedNumbers(problem, language), []
    assert dynamics is not None
    for symbol, key, unit in (("m_{%s}", "mass", "kg"), ("J_{S%s}", "inertia", "kg·m²")):
        for link, mass in dynamics.masses.items():
            if value := getattr(mass, key):
                path = f"dynamics.links.{segment(link)}.{key}"
                phrase = text.number(value, unit, path)
                facts.append(GivenFact(f"{symbol % link} = {phrase}", {path: value}))
    for link, mass in dynamics.masses.items():
        if mass.centre is not None and mass.mass:
            path = f"dynamics.links.{segment(link)}.centre"
            told = language.note.given_centre.format(link=link, point=point_name(mass.centre))
            # S2 is the centre of link 2 by its name.
            named = mass.centre == f"S{link}" or len(problem.bodies[link].points) == 1
            facts.append(GivenFact("" if named else told, {path: mass.centre}))
    gravity = text.number(dynamics.gravity, "m/s²", "dynamics.gravity")
    return [*facts, GivenFact(f"g = {gravity}", {"dynamics.gravity": dynamics.gravity})]


def _placement(
    load: Load | Couple, size: float, language: Language
) -> tuple[str, dict[str, object]]:
    """Return the point of action and the direction of a load, and the keys for them."""
    note, path = language.note, load.path
    data: dict[str, object] = {f"{path}.name": load.name, f"{path}.link": load.link}
    if isinstance(load, Couple):
        if isinstance(load.sense, Against):
            data[f"{path}.against"] = "rotation"
            way = note["load_ways"]["against turning" if size >= 0 else "with turning"]
        else:
            way = note["load_ways"]["ccw" if size >= 0 else "cw"]
        return note.load_on.format(link=load.link, way=way), data
    data[f"{path}.at"] = load.at
    if isinstance(load.sense, Against):
        data[f"{path}.against"] = "velocity"
        way = note["load_ways"]["against" if size >= 0 else "with"]
    else:
        assert not isinstance(load.sense, SpringEnd), "a spring has a fact of its own"
        data[f"{path}.angle"] = load.sense.angle
        angle = (load.sense.angle + (0.0 if size >= 0 else 180.0)) % 360.0
        quarter = {0.0: "right", 90.0: "up", 180.0: "left", 270.0: "down"}.get(angle)
        ways = note["given_ways"]
        degrees = with_unit(language.notation.as_input(angle), language.notation.units["deg"])
        way = ways[quarter] if quarter else note.given_angle.format(angle=degrees)
    return note.load_at.format(point=point_name(load.at), link=load.link, way=way), data


def _pushed(problem: Problem, language: Language) -> list[GivenFact]:
    """Return where a force balances the crank, in place of a couple."""
    pushed, pivot = problem.drive.pushed, problem.drive.pivot
    if pushed is None or pivot is None:
        return []
    data: dict[str, object] = {"balancing_force.at": pushed.at}
    if pushed.angle is None:
        way = language.note.push_across.format(line=f"{point_name(pivot)}{point_name(pushed.at)}")
    else:
        data["balancing_force.angle"] = pushed.angle
        way = language.note.push_angle.format(angle=language.notation.as_input(pushed.angle))
    text = language.note.given_push.format(
        symbol=language.notation.symbol(problem.balancer.symbol),
        point=point_name(pushed.at),
        way=way,
    )
    return [GivenFact(text, data)]


def _in_pairs(statics: Statics, language: Language) -> list[GivenFact]:
    """Return the given facts on the pairs: their friction, the bearings of shafts."""
    dynamics, notation = statics.solution.problem.dynamics, language.notation
    facts = friction_facts(statics, language)
    for joint, bearing in {} if dynamics is None else dynamics.bearings.items():
        first, second, plane = (
            with_unit(notation.as_input(z), notation.units["m"])
            for z in (*bearing.at, bearing.plane)
        )
        text = language.note.given_bearings.format(
            joint=point_name(joint), first=first, second=second, plane=plane
        )
        path = f"bearings.{segment(joint)}"
        facts.append(GivenFact(text, {f"{path}.at": [*bearing.at], f"{path}.plane": bearing.plane}))
    return facts


def friction_facts(statics: Statics, language: Language) -> list[GivenFact]:
    """Return the coefficients of friction and the radii of pins, those of pairs alike once."""
    problem, notation = statics.solution.problem, language.notation
    task = None if problem.dynamics is None else problem.dynamics.friction
    found: dict[tuple[bool, float, float], tuple[list[str], dict[str, object]]] = {}
    for joint in statics.reactions if task is not None else ():
        assert task is not None
        pair = pair_data(problem, task, joint)
        if not pair.rubs:
            continue
        names, data = found.setdefault((pair.slides, pair.f, pair.radius), ([], {}))
        between = f"{joint.on}–{problem.mechanism.called(joint.by)}"
        names.append(f"{point_name(joint.joint)} ({between})")
        path = f'friction.pairs."{pair.name}"'
        data[f"{path}.f"] = pair.f
        if not pair.slides:
            data[f"{path}.radius"] = pair.radius
    return [
        GivenFact(
            (language.friction.given_sliding if slides else language.friction.given_turning).format(
                pairs=", ".join(names),
                f=notation.short(f),
                radius=f"{notation.short(1e3 * radius)} {notation.units['mm']}",
            ),
            data,
        )
        for (slides, f, radius), (names, data) in found.items()
    ]


def _external(reading: ForceReading) -> list[Applied]:
    loads = (given.applied for given in reading.statics.board.given)
    return [one for one in loads if one.kind is LoadKind.EXTERNAL]


def force_unknowns(reading: ForceReading, notation: Notation) -> str:
    """Return the unknowns as one line of symbols: reactions, their angles, what acts beside."""
    statics, called = reading.statics, reading.solution.problem.mechanism.called
    symbols = [reaction_symbol(joint.on, called(joint.by)) for joint in statics.reactions]
    symbols.append("φ_{ij}")
    for k, contact in statics.contacts.items():
        # A guide that gives only a couple has no point of action.
        is_none = (
            abs(statics.reactions[k].force[reading.index]) <= NEGLIGIBLE_FRACTION * reading.peak
        )
        letter = "M" if is_none else "l"
        by = called(contact.joint.by)
        symbols.append(reaction_symbol(contact.joint.on, by, letter=letter))
    return ", ".join([*symbols, *map(notation.symbol, reading.balancing_symbols)])


def cycle_statement(solution: Solution, language: Language) -> list[GivenFact]:
    """Return the given facts for all positions: mechanism, masses, external loads."""
    problem = solution.problem
    assert problem.dynamics is not None
    facts = given_facts(problem, language, [float(position) for position in solution.positions])
    facts += mass_lines(problem, language)
    facts += [*load_facts(problem, language), *_pushed(problem, language)]
    return [*facts, *_in_pairs(statics_of(solution), language)]


def load_facts(problem: Problem, language: Language) -> list[GivenFact]:
    """Return the loads of a whole cycle: sizes or tables, where they act; then the springs."""
    found = []
    for load in () if problem.dynamics is None else problem.dynamics.loads:
        match load.size:
            case int() | float():
                found.append(_constant(load, load.size, language))
            case SizeTable(like=None):
                found += [
                    _table(problem, load, language),
                    _rows(problem, load, load.size, language),
                ]
            case SizeTable():
                found.append(_likened(load, load.size, language))
            case Spring():
                continue
            case _:
                assert_never(load.size)
    return [*found, *spring_facts(problem, language)]


def _constant(load: Load | Couple, size: float, language: Language) -> GivenFact:
    notation = language.notation
    where, data = _placement(load, size, language)
    phase = _phase(load, language)
    phrase = with_unit(notation.short(abs(size)), notation.units[load.unit])
    data = {**data, **phase.data, f"{load.path}.{load.key}": size}
    return GivenFact(f"{load.name} = {phrase} ({where}{phase.text})", data)


def _likened(load: Load | Couple, size: SizeTable, language: Language) -> GivenFact:
    where, data = _placement(load, largest_size(size), language)
    keys = {f"{load.path}.like": size.like, f"{load.path}.shift": size.shift}
    return GivenFact(f"{like_line(load, language)} ({where})", {**data, **keys})


def largest_symbol(symbol: str) -> str:
    """Return the letter of a load where it is largest: ``F_{5 max}``, ``P_{max}``, ``F_{5 max}'``.

    The name of a second load on a link has a prime.
    """
    plain = symbol.rstrip("'")
    name, index, end = plain.partition("_{")
    most = f"{name}_{{{end.removesuffix('}')}{' ' if index else ''}max}}"
    return most + symbol[len(plain) :]


def _table(problem: Problem, load: Load | Couple, language: Language) -> GivenFact:
    notation, largest = language.notation, largest_size(load.size)
    over = _over(problem, load, language)
    where, data = _placement(load, largest, language)
    phase = _phase(load, language)
    text = language.sheets.load_table.format(
        name=load.name,
        over=over,
        peak=largest_symbol(load.name),
        largest=f"{notation.short(abs(largest))} {notation.units[load.unit]}",
    )
    return GivenFact(f"{text} ({where}{phase.text})", {**data, **phase.data})


def _over(problem: Problem, load: Load | Couple, language: Language) -> str:
    """Return the letter of the independent variable of a table."""
    assert isinstance(load.size, SizeTable)
    match load.size.over:
        case Over.PHI:
            return f"φ_{{{problem.drive.link}}}"
        case Over.S:
            return "s"
        case Over.X | Over.Y:
            assert isinstance(load, Load), "a couple has no point"
            return f"{load.size.over.value}_{{{point_name(load.at)}}}"
        case Over.PATH | Over.STROKES:
            assert isinstance(load, Load), "a couple has no point"
            return f"s_{{{point_name(load.at)}}}"
        case Over.POSITION:
            return str(language.note.number)


def _rows(problem: Problem, load: Load | Couple, size: SizeTable, language: Language) -> GivenFact:
    """Return the rows of a table, those of an indicator diagram stroke by stroke, as the file."""
    notation, note = language.notation, language.note
    path = f"{load.path}.{load.key}"
    over = _over(problem, load, language)
    if size.over in (Over.PATH, Over.STROKES):
        over += "/H"

    def listed(rows: Iterable[tuple[float, float]], scale: float = 1.0) -> str:
        return ", ".join(
            f"({notation.as_input(x)};{NBSP}{notation.as_input(scale * y)})" for x, y in rows
        )

    if size.indicator is not None:
        told = size.indicator
        strokes = "; ".join(
            note.load_stroke.format(number=k, rows=listed(rows, 1e-6))
            for k, rows in enumerate(told.strokes, 1)
        )
        square = f"{notation.units['m']}^{{2}}"
        area, other = (with_unit(notation.as_input(x), square) for x in (told.area, told.area_2))
        template = note.load_indicator_both if told.sides == 2 else note.load_indicator
        phrase = template.format(name=load.name, over=over, strokes=strokes, area=area, other=other)
        data: dict[str, object] = {
            f"{path}.law": "indicator",
            f"{path}.area": told.area,
            f"{path}.strokes": [[[*row] for row in rows] for rows in told.strokes],
        }
        if problem.machine is not None and problem.machine.cycle_deg != 360.0:
            whole = problem.machine.cycle_deg
            data["machine.cycle_deg"] = whole
            phrase += note.load_cycle.format(
                cycle=with_unit(notation.as_input(whole), notation.units["deg"])
            )
        if told.sides == 2:
            data |= {f"{path}.sides": 2, f"{path}.area_2": told.area_2}
        return GivenFact(phrase, data)
    data = {f"{path}.over": size.over.value}
    rows: list[tuple[float, float]]
    if size.over is Over.POSITION:
        rows, data[f"{path}.values"] = [*enumerate(size.values)], [*size.values]
    else:
        rows = [*zip(size.at, size.values, strict=True)]
        data[f"{path}.values"] = [[*row] for row in rows]
        data[f"{path}.interpolation"] = size.interpolation.value
    steps = size.interpolation is Interpolation.STEP
    template = note.load_steps if steps else note.load_rows
    units = notation.units[load.unit]
    return GivenFact(
        template.format(name=load.name, over=over, unit=units, rows=listed(rows)), data
    )


def _phase(load: Load | Couple, language: Language) -> GivenFact:
    """Return when a load acts: the phrase after its point of action."""
    phase, note = load.phase, language.note
    if phase is None:
        return GivenFact("")
    data: dict[str, object] = {}
    phrase, path = "", f"{load.path}.phases"
    if phase.phi:
        data[f"{path}.phi"] = [[*pair] for pair in phase.phi]
        pairs = (
            f"{language.notation.as_input(one)}…{language.notation.as_input(two)}°"
            for one, two in phase.phi
        )
        phrase += note.load_between.format(ranges=", ".join(pairs))
    for key, sense in (("moving", phase.moving), ("turning", phase.turning)):
        if sense is not None:
            data[f"{path}.{key}"] = sense.value
            phrase += note["load_while"][sense.value]
    return GivenFact(phrase, data)


def like_line(load: Load | Couple, language: Language) -> str:
    """Return the load whose indicator diagram a load shares, and the delay (второй цилиндр)."""
    assert isinstance(load.size, SizeTable) and load.size.like is not None
    shift = f"{language.notation.as_input(load.size.shift)}{language.notation.units['deg']}"
    return language.sheets.load_like.format(name=load.name, other=load.size.like, shift=shift)


def cycle_force_unknowns(solution: Solution, notation: Notation) -> str:
    """Return the unknowns of all positions as one line of symbols."""
    called = solution.problem.mechanism.called
    joints = statics_of(solution).reactions
    symbols = [reaction_symbol(joint.on, called(joint.by)) for joint in joints]
    return ", ".join([*symbols, notation.symbol(solution.problem.balancer.symbol)])
