"""The turn of a crank in words: its facts, and how its diagrams are made (цикл движения)."""

from __future__ import annotations

from planmethod.note.narrate.given import point_name
from planmethod.note.narrate.scales import scale_inscription
from planmethod.note.numbers import half_up, significant, with_unit
from planmethod.note.wording import Language
from planmethod.solved.turn.construction import PRIMES, ExtremesConstruction, Locus
from planmethod.solved.turn.diagrams import Diagrams
from planmethod.solved.turn.output import Output
from planmethod.solved.turn.strokes import LONGER, TOLD
from planmethod.solved.turn.turn import NoNumber, Turn

NO_ANGLE = 1e-6
"""Pressure angle taken as zero, degrees: a block on the output link pushes along its motion."""


def degrees(value: float, words: Language) -> str:
    """Return an angle of the crank as text with two decimals."""
    return with_unit(words.say.number(f"{value + 0.0:.2f}"), "°")


def output_symbol(output: Output) -> str:
    """Return the symbol of the output's path: ``s_{B}``, ``φ_{3}``."""
    if output.slide is None:
        return f"φ_{{{output.link}}}"
    return f"s_{{{point_name(output.point).replace('{', '').replace('}', '').replace('_', '')}}}"


def output_name(output: Output) -> str:
    """Return the output as rich text: its point, or its link."""
    return point_name(output.point) if output.slide is not None else output.link


def extremes_named(turn: Turn | None, names: str, words: Language) -> list[str]:
    """Return what the letters of the extreme positions are, and stroke and phases of a turn."""
    told = [words.sheets.extremes.format(names=names)]
    found = [] if turn is None else [*stroke_facts(turn, words), *ratio_facts(turn, words)]
    return [*told, "; ".join(found)] if found else told


def stroke_facts(turn: Turn, words: Language) -> list[str]:
    """Return the stroke or the swing, if there is one."""
    if turn.stroke is None:
        return []
    unit = words.say.units[turn.output.unit]
    is_angle = turn.output.slide is None
    size = (
        degrees(turn.stroke, words) if is_angle else with_unit(words.say.found(turn.stroke), unit)
    )
    return [words.cycle["stroke"][turn.output.unit].format(stroke=size)]


def ratio_facts(turn: Turn, words: Language) -> list[str]:
    """Return the angles of the crank of the working and the idle stroke, if there are such."""
    strokes = turn.strokes
    if strokes is None or strokes.K_v is None:
        return []
    working, idle = (degrees(one, words) for one in (strokes.working_deg, strokes.idle_deg))
    ratio = words.say.found(strokes.K_v)
    return [words.cycle.ratio.format(working=working, idle=idle, ratio=ratio)]


def working_fact(turn: Turn, words: Language) -> str:
    """Return why a stroke is the working one; empty where there is none, or both are equal."""
    strokes = turn.strokes
    if strokes is None or strokes.K_v is None:
        return ""
    if strokes.by in (LONGER, TOLD):
        alike = strokes.by == LONGER and strokes.K_v < 1.0 + 1e-9
        return "" if alike else words.cycle["working"][strokes.by]
    _, _, names = strokes.by.partition(" ")
    return words.cycle.by_loads.format(names=names)


def turn_facts(turn: Turn, words: Language) -> list[str]:
    """Return the results of a cycle, one fact each, as rich text."""
    said, say, output = words.cycle, words.say, turn.output
    unit = say.units[output.unit]

    def size(value: float) -> str:
        return degrees(value, words) if unit == "°" else with_unit(say.found(value), unit)

    def place(phi: float) -> str:
        # In a full turn as in the table beside it; within a range like its limits.
        return degrees(phi if turn.range else round(phi % turn.period, 2) % turn.period, words)

    facts = [said["output"][output.unit].format(name=output_name(output), link=output.link)]
    facts.append(range_fact(turn, words))
    if turn.range is None and turn.tightest is not None:
        closest, at = turn.tightest
        facts.append(said.tightest.format(links=", ".join(closest), phi=place(at)))
    senses = said["senses"][turn.solution.problem.drive.mover]
    way = senses["against" if turn.is_against else "along"]
    facts.append(said.zero.format(phi=place(float(turn.positions[0])), sense=way))
    if turn.turns > 1:
        facts.append(said.two_turns.format(count=turn.count, way=degrees(turn.way, words)))
    if turn.range is not None:
        facts.append(said.path_zero.format(phi=place(turn.zero)))
    if turn.extremes:
        ends = (f"{place(one.phi)} ({size(one.value)})" for one in turn.extremes)
        facts.append(said.extremes.format(extremes=", ".join(ends)))
    facts += stroke_facts(turn, words)
    if turn.stroke is None and turn.why_no_stroke is not None:
        facts.append(_none("H" if output.slide is not None else "ψ", turn.why_no_stroke, words))
    # The strokes of a cam have its dwells in them: their ratio is no K_v.
    ratio = ratio_facts(turn, words) if turn.solution.problem.drive.revolves else []
    facts += ratio
    why = working_fact(turn, words) if ratio else ""
    facts += [why] if why else []
    if not ratio and turn.why_no_ratio is not None:
        facts.append(_none("K_{v}", turn.why_no_ratio, words))
    peak = turn.pressure
    if peak is not None:
        most, least = degrees(peak.most, words), degrees(peak.least, words)
        most_at, least_at = place(peak.most_at), place(peak.least_at)
        told = said.pressure if abs(peak.most) > NO_ANGLE else said.no_pressure
        facts.append(told.format(most=most, most_at=most_at, least=least, least_at=least_at))
    return facts


def range_fact(turn: Turn, words: Language) -> str:
    """Return the range of rotation of the crank."""
    if turn.range is None:
        return str(words.cycle["full_turn"][turn.solution.problem.drive.mover])
    low, high = (degrees(limit, words) for limit in turn.range)
    links = tuple(dict.fromkeys(link for end in turn.range for link in turn.stopping(end)))
    said = words.cycle["range"][turn.solution.problem.drive.mover]
    return str(said.format(low=low, high=high, links=", ".join(links)))


def _none(what: str, why: NoNumber, words: Language) -> str:
    return words.cycle.none.format(what=what, why=words.cycle["why"][why.name])


def diagram_scales(diagrams: Diagrams, words: Language) -> list[str]:
    """Return the scales of the diagrams as they are inscribed."""
    convention = diagrams.turn.solution.problem.scales.convention
    return [scale_inscription(scale, convention, words.say) for scale in diagrams.scales]


def diagram_steps(diagrams: Diagrams, words: Language) -> list[str]:
    """Return how the diagrams are made, a paragraph each."""
    said, task, say = words.cycle, diagrams.task, words.say
    way = task.differentiation
    return [
        said.scheme_steps.format(
            length=say.given(half_up(diagrams.length, 2)), count=diagrams.count
        ),
        said["ray_steps"][way.value].format(pole=say.given(half_up(diagrams.poles[0], 2))),
        said.again.format(pole=say.given(half_up(diagrams.poles[1], 2))),
        said.scales.format(
            scales="; ".join(diagram_scales(diagrams, words)),
            radians=say.found(diagrams.mu_phi),
            omega=f"ω_{{{diagrams.turn.solution.problem.drive.link}}}",
        ),
    ]


def drawn_notes(diagrams: Diagrams, words: Language) -> list[str]:
    """Return what the lines of the drawn diagrams are, and what they leave out."""
    way, turn = diagrams.task.differentiation, diagrams.turn
    notes = [words.cycle.drawn.format(way=words.cycle["chords"][way.value])]
    if turn.solution.problem.drive.acceleration:
        even, added, symbol = acceleration_parts(turn.output)
        notes.append(words.cycle.drawn_even.format(symbol=symbol, even=even, added=added))
    return notes


def acceleration_parts(output: Output) -> tuple[str, str, str]:
    """Return the parts of the output's acceleration by omega and epsilon, and the whole."""
    index = output_symbol(output).partition("_")[2]
    v, a = ("ω", "ε") if output.slide is None else ("v", "a")
    return f"{a}_{{q}}·ω^{{2}}", f"{v}_{{q}}·ε", f"{a}_{index}"


def radius_names(made: ExtremesConstruction) -> tuple[str, str, str]:
    """Return what the crank's radius, the sum and the difference of rod and crank are called."""
    crank, rod = f"l_{{{_flat(made.pivot, made.pin)}}}", f"l_{{{_flat(made.pin, made.end)}}}"
    if made.locus is Locus.TANGENTS:
        return crank, "", ""
    longer, other = (rod, crank) if made.is_rod_longer else (crank, rod)
    return crank, f"{rod} + {crank}", f"{longer} − {other}"


def _flat(*names: str) -> str:
    return "".join(name.translate(str.maketrans("", "", "{}_")) for name in map(point_name, names))


def extreme_steps(turn: Turn, made: ExtremesConstruction | None, words: Language) -> list[str]:
    """Return how the extreme positions are constructed, and their readings."""
    said, say = words.cycle, words.say
    if made is None:
        return [said.no_construction] if turn.ends is not None else []
    facts = construction_facts(made, words)
    angles = [
        said["constructed"]["phi"].format(
            name=f"φ{p}",
            read=degrees((phi + made.off(k)) % turn.period, words),
            exact=degrees(round(phi % turn.period, 2) % turn.period, words),
            sigma=degrees(made.sigma[k], words),
        )
        for k, (p, phi) in enumerate(zip(PRIMES, made.phi, strict=True))
    ]
    unit = "m" if made.locus is Locus.GUIDE else "deg"

    def size(value: float, digits: int) -> str:
        if unit == "deg":
            return degrees(value, words)
        return with_unit(say.number(significant(value, digits)), say.units["m"])

    told = said["constructed"][unit].format(
        angles="; ".join(angles),
        link=made.link,
        read=size(made.stroke(made.read), 4),
        exact=size(made.stroke(made.exact), 4),
        sigma=size(made.sigma[2], 2),
    )
    return [said["construction"][made.locus.value].format(**facts), told]


def construction_facts(made: ExtremesConstruction, words: Language) -> dict[str, str]:
    """Return what the sentences of the construction of extreme positions name."""

    def primed(name: str) -> list[str]:
        return [point_name(name) + p for p in PRIMES]

    def mm(name: str) -> str:
        return words.say.number(f"{made.length(name):.1f}")

    crank, total, less = radius_names(made)
    arcs = made.locus is not Locus.TANGENTS
    return {
        "pivot": point_name(made.pivot), "end": point_name(made.end),
        "centre": point_name(made.centre) if made.centre else "",
        "crank": crank, "crank_mm": mm("r"), "pins": ", ".join(primed(made.pin)),
        "ends": ", ".join(primed(made.end)),
        "rays": ", ".join(point_name(made.pivot) + end for end in primed(made.end)),
        "far": total, "near": less,
        "far_mm": mm("l+r") if arcs else "", "near_mm": mm("l-r") if arcs else "",
    }  # fmt: skip
