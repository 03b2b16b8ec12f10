"""The statement of the force analysis: what is given, what to find (Дано, Определить)."""

from __future__ import annotations

import math

from planmethod.note.document import GivenFact
from planmethod.note.narrate.given import As, given, point_name
from planmethod.note.numbers import Notation, with_unit
from planmethod.note.wording import Language
from planmethod.plans.forces.loads import Applied, LoadKind
from planmethod.plans.forces.polygons import ForcePlan, reaction_symbol
from planmethod.problem.bodies import rotation
from planmethod.problem.load_records import Against, Couple, Fixed, Load, Over, SizeTable
from planmethod.problem.model import Problem
from planmethod.problem.names import segment
from planmethod.solved.forces.reading import FAINT_SHARE, ForceReading
from planmethod.solved.forces.statics import statics_of
from planmethod.solved.solution import Solution


def link_names(links: tuple[str, ...]) -> str:
    """Return links as a title has them: ``4–5``."""
    return "–".join(links)


def plan_title(reading: ForceReading, plan: ForcePlan, words: Language) -> str:
    """Return what is cut free: ``Группа звеньев 4–5``, ``Начальное звено 1``."""
    is_driver = plan.links == (reading.solution.problem.drive.link,)
    title = words.sheets.cut_driver if is_driver else words.sheets.cut_group
    return title.format(links=link_names(plan.links))


def statement(reading: ForceReading, words: Language) -> list[GivenFact]:
    """Return what is given: the mechanism, masses, moments of inertia, external loads."""
    problem, index = reading.solution.problem, reading.index
    dynamics = problem.dynamics
    assert dynamics is not None
    facts = given(problem, words, [float(reading.solution.positions[index])])
    facts += mass_lines(problem, words)
    text = As(problem, words)
    for contact in reading.statics.contacts.values():
        if contact.length is not None:
            by = problem.mechanism.called(contact.joint.by)
            letter = reaction_symbol(contact.joint.on, by, letter="a")
            path = f"links.{segment(contact.joint.on)}.slides.length"
            known = contact.joint.on in problem.slides
            own: dict[str, object] = {path: contact.length} if known else {}
            facts.append(GivenFact(f"{letter} = {text.metres(contact.length)}", own))
    loads = {load.name: (k, load) for k, load in enumerate(dynamics.loads)}
    for one in _external(reading):
        size = abs(complex(one.force[index])) if one.point else abs(float(one.couple[index]))
        if not size:
            continue
        unit, key = ("N", "force") if one.point else ("N·m", "couple")
        if one.name not in loads:
            facts.append(GivenFact(f"{one.name} = {words.say.found(size)} {words.say.units[unit]}"))
            continue
        number, load = loads[one.name]
        if isinstance(load.size, SizeTable):
            signed = float(one.couple[index]) if isinstance(load, Couple) else size
            if isinstance(load, Load) and isinstance(load.sense, Fixed):
                along = complex(one.force[index]) / rotation(load.sense.angle)
                signed = math.copysign(size, along.real)
            said = f"{words.say.found(size)} {words.say.units[unit]}"
        else:
            signed = load.size
            said = text.number(size, unit, f"loads[{number}].{key}")
        where, data = _where(load, number, signed, words)
        data[f"loads[{number}].{key}"] = signed
        facts.append(GivenFact(f"{one.name} = {said} ({where})", data))
    return [*facts, *_pushed(problem, words)]


def mass_lines(problem: Problem, words: Language) -> list[GivenFact]:
    """Return the masses, moments of inertia and the acceleration of free fall as the file has."""
    dynamics, text, facts = problem.dynamics, As(problem, words), []
    assert dynamics is not None
    for symbol, key, unit in (("m_{%s}", "mass", "kg"), ("J_{S%s}", "inertia", "kg·m²")):
        for link, mass in dynamics.masses.items():
            if value := getattr(mass, key):
                path = f"dynamics.links.{segment(link)}.{key}"
                said = text.number(value, unit, path)
                facts.append(GivenFact(f"{symbol % link} = {said}", {path: value}))
    for link, mass in dynamics.masses.items():
        if mass.centre is not None and mass.mass:
            path = f"dynamics.links.{segment(link)}.centre"
            told = words.note.given_centre.format(link=link, point=point_name(mass.centre))
            # S2 is the centre of link 2 by its name.
            named = mass.centre == f"S{link}" or len(problem.bodies[link].points) == 1
            facts.append(GivenFact("" if named else told, {path: mass.centre}))
    gravity = text.number(dynamics.gravity, "m/s²", "dynamics.gravity")
    return [*facts, GivenFact(f"g = {gravity}", {"dynamics.gravity": dynamics.gravity})]


def _where(
    load: Load | Couple, number: int, size: float, words: Language
) -> tuple[str, dict[str, object]]:
    """Return where a load acts and which way, and the keys that say so."""
    note, path = words.note, f"loads[{number}]"
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
        data[f"{path}.angle"] = load.sense.angle
        angle = (load.sense.angle + (0.0 if size >= 0 else 180.0)) % 360.0
        quarter = {0.0: "right", 90.0: "up", 180.0: "left", 270.0: "down"}.get(angle)
        ways = note["given_ways"]
        degrees = with_unit(words.say.given(angle), words.say.units["deg"])
        way = ways[quarter] if quarter else note.given_angle.format(angle=degrees)
    return note.load_at.format(point=point_name(load.at), link=load.link, way=way), data


def _pushed(problem: Problem, words: Language) -> list[GivenFact]:
    """Return where a force balances the crank, in place of a couple."""
    pushed, pivot = problem.drive.pushed, problem.drive.pivot
    if pushed is None or pivot is None:
        return []
    data: dict[str, object] = {"balancing_force.at": pushed.at}
    if pushed.angle is None:
        way = words.note.push_across.format(line=f"{point_name(pivot)}{point_name(pushed.at)}")
    else:
        data["balancing_force.angle"] = pushed.angle
        way = words.note.push_angle.format(angle=words.say.given(pushed.angle))
    told = words.note.given_push.format(
        symbol=words.say.symbol(problem.drive.balancing.symbol),
        point=point_name(pushed.at),
        way=way,
    )
    return [GivenFact(told, data)]


def _external(reading: ForceReading) -> list[Applied]:
    loads = (given.applied for given in reading.statics.board.given)
    return [one for one in loads if one.kind is LoadKind.EXTERNAL]


def wanted(reading: ForceReading, say: Notation) -> str:
    """Return what is to be found, as one line of symbols."""
    statics, called = reading.statics, reading.solution.problem.mechanism.called
    symbols = [reaction_symbol(joint.on, called(joint.by)) for joint in statics.reactions]
    for k, contact in statics.contacts.items():
        # Of a guide that gives a couple alone nobody can ask where its force acts.
        is_none = abs(statics.reactions[k].force[reading.index]) <= FAINT_SHARE * reading.peak
        letter = "M" if is_none else "l"
        by = called(contact.joint.by)
        symbols.append(reaction_symbol(contact.joint.on, by, letter=letter))
    return ", ".join([*symbols, say.symbol(reading.balancing_symbol)])


def cycle_statement(solution: Solution, words: Language) -> list[GivenFact]:
    """Return what is given for all positions: mechanism, masses, external loads."""
    problem = solution.problem
    assert problem.dynamics is not None
    facts = given(problem, words, [float(position) for position in solution.positions])
    facts += mass_lines(problem, words)
    return [*facts, *load_facts(problem, words), *_pushed(problem, words)]


def load_facts(problem: Problem, words: Language) -> list[GivenFact]:
    """Return the loads of a whole cycle: sizes, or what they are tables of; where they act."""
    loads = () if problem.dynamics is None else problem.dynamics.loads
    return [_load(problem, load, k, words) for k, load in enumerate(loads)]


def _load(problem: Problem, load: Load | Couple, number: int, words: Language) -> GivenFact:
    say = words.say
    unit, key = ("N", "force") if isinstance(load, Load) else ("N·m", "couple")
    if not isinstance(load.size, SizeTable):
        where, data = _where(load, number, load.size, words)
        phase = _phase(load, number, words)
        said = with_unit(say.short(abs(load.size)), say.units[unit])
        data = {**data, **phase.data, f"loads[{number}].{key}": load.size}
        return GivenFact(f"{load.name} = {said} ({where}{phase.text})", data)
    if load.size.like is not None:
        where, data = _where(load, number, max(load.size.values, key=abs), words)
        keys = {f"loads[{number}].like": load.size.like, f"loads[{number}].shift": load.size.shift}
        return GivenFact(f"{like_line(load, words)} ({where})", {**data, **keys})
    largest = max(load.size.values, key=abs)
    match load.size.over:
        case Over.PHI:
            over = f"φ_{{{problem.drive.link}}}"
        case Over.S:
            over = "s"
        case Over.X | Over.Y:
            assert isinstance(load, Load), "a couple has no point"
            over = f"{load.size.over.value}_{{{point_name(load.at)}}}"
        case Over.PATH | Over.STROKES:
            assert isinstance(load, Load), "a couple has no point"
            over = f"s_{{{point_name(load.at)}}}"
        case Over.POSITION:
            over = words.note.number
    name, index, end = load.name.partition("_{")
    peak = f"{name}_{{{end.removesuffix('}')}{' ' if index else ''}max}}"
    where, data = _where(load, number, largest, words)
    phase = _phase(load, number, words)
    told = words.sheets.load_table.format(
        name=load.name, over=over, peak=peak, largest=f"{say.short(abs(largest))} {say.units[unit]}"
    )
    return GivenFact(f"{told} ({where}{phase.text})", {**data, **phase.data})


def _phase(load: Load | Couple, number: int, words: Language) -> GivenFact:
    """Return when a load acts: what is told after where it does."""
    phase, note = load.phase, words.note
    if phase is None:
        return GivenFact("")
    data: dict[str, object] = {}
    said, path = "", f"loads[{number}].phases"
    if phase.phi:
        data[f"{path}.phi"] = [[*pair] for pair in phase.phi]
        pairs = (f"{words.say.given(one)}…{words.say.given(two)}°" for one, two in phase.phi)
        said += note.load_between.format(ranges=", ".join(pairs))
    for key, sense in (("moving", phase.moving), ("turning", phase.turning)):
        if sense is not None:
            data[f"{path}.{key}"] = sense.value
            said += note["load_while"][sense.value]
    return GivenFact(said, data)


def like_line(load: Load | Couple, words: Language) -> str:
    """Return whose indicator diagram a load has, and how much later (второй цилиндр)."""
    assert isinstance(load.size, SizeTable) and load.size.like is not None
    shift = f"{words.say.given(load.size.shift)}{words.say.units['deg']}"
    return words.sheets.load_like.format(name=load.name, other=load.size.like, shift=shift)


def cycle_wanted(solution: Solution, say: Notation) -> str:
    """Return what is to be found in all positions, as one line of symbols."""
    called = solution.problem.mechanism.called
    joints = statics_of(solution).reactions
    symbols = [reaction_symbol(joint.on, called(joint.by)) for joint in joints]
    return ", ".join([*symbols, say.symbol(solution.problem.drive.balancing.symbol)])
