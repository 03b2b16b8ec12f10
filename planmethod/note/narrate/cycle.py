"""The turn of a crank in words: its facts, and how its diagrams are made (цикл движения)."""

from __future__ import annotations

from planmethod.note.narrate.naming import point_name, scale_inscription
from planmethod.note.numbers import half_up, significant, with_unit
from planmethod.note.series import compared_extremes, compared_stroke
from planmethod.note.wording import Language
from planmethod.solved.turn.cycle import CrankCycle, NoNumber
from planmethod.solved.turn.diagrams import Diagrams
from planmethod.solved.turn.extremes import PRIMES, ExtremesConstruction, Locus
from planmethod.solved.turn.output import LONGER, TOLD, Output

NO_ANGLE = 1e-6
"""Pressure angle taken as zero, degrees: a block on the output link pushes along its motion."""


def degrees(value: float, language: Language) -> str:
    """Return an angle of the crank as text with two decimals."""
    return with_unit(language.notation.number(f"{value + 0.0:.2f}"), "°")


def output_symbol(output: Output) -> str:
    """Return the symbol of the output's path: ``s_{B}``, ``φ_{3}``."""
    if output.slide is None:
        return f"φ_{{{output.link}}}"
    return f"s_{{{point_name(output.point).replace('{', '').replace('}', '').replace('_', '')}}}"


def output_name(output: Output) -> str:
    """Return the output as rich text: its point, or its link."""
    return point_name(output.point) if output.slide is not None else output.link


def extremes_named(turn: CrankCycle | None, names: str, language: Language) -> list[str]:
    """Return what the letters of the extreme positions are, and stroke and phases of a turn."""
    told = [language.sheets.extremes.format(names=names)]
    found = [] if turn is None else [*stroke_facts(turn, language), *ratio_facts(turn, language)]
    return [*told, "; ".join(found)] if found else told


def stroke_facts(turn: CrankCycle, language: Language) -> list[str]:
    """Return the stroke or the swing, if there is one."""
    if turn.stroke is None:
        return []
    unit = language.notation.units[turn.output.unit]
    is_angle = turn.output.slide is None
    size = (
        degrees(turn.stroke, language)
        if is_angle
        else with_unit(language.notation.computed(turn.stroke), unit)
    )
    return [language.cycle["stroke"][turn.output.unit].format(stroke=size)]


def ratio_facts(turn: CrankCycle, language: Language) -> list[str]:
    """Return the angles of the crank of the working and the idle stroke, if there are such."""
    strokes = turn.strokes
    if strokes is None or strokes.K_v is None:
        return []
    working, idle = (degrees(one, language) for one in (strokes.working_deg, strokes.idle_deg))
    ratio = language.notation.computed(strokes.K_v)
    return [language.cycle.ratio.format(working=working, idle=idle, ratio=ratio)]


def working_fact(turn: CrankCycle, language: Language) -> str:
    """Return why a stroke is the working one; empty where there is none, or both are equal."""
    strokes = turn.strokes
    if strokes is None or strokes.K_v is None:
        return ""
    if strokes.by in (LONGER, TOLD):
        alike = strokes.by == LONGER and strokes.K_v < 1.0 + 1e-9
        return "" if alike else language.cycle["working"][strokes.by]
    _, _, names = strokes.by.partition(" ")
    return language.cycle.by_loads.format(names=names)


def cycle_facts(turn: CrankCycle, language: Language) -> list[str]:
    """Return the results of a cycle, one fact each, as rich text."""
    texts, notation, output = language.cycle, language.notation, turn.output
    unit = notation.units[output.unit]

    def size(value: float) -> str:
        return (
            degrees(value, language) if unit == "°" else with_unit(notation.computed(value), unit)
        )

    def place(phi: float) -> str:
        # In a full turn as in the table beside it; within a range like its limits.
        return degrees(phi if turn.range else round(phi % turn.period, 2) % turn.period, language)

    facts = [texts["output"][output.unit].format(name=output_name(output), link=output.link)]
    facts.append(range_fact(turn, language))
    if turn.range is None and turn.tightest is not None:
        closest, at = turn.tightest
        facts.append(texts.tightest.format(links=", ".join(closest), phi=place(at)))
    senses = texts["senses"][turn.solution.problem.drive.mover]
    way = senses["against" if turn.is_against else "along"]
    facts.append(texts.zero.format(phi=place(float(turn.positions[0])), sense=way))
    if turn.turns > 1:
        facts.append(texts.two_turns.format(count=turn.count, way=degrees(turn.travel, language)))
    if turn.range is not None:
        facts.append(texts.path_zero.format(phi=place(turn.zero)))
    if turn.extremes:
        ends = (f"{place(one.phi)} ({size(one.value)})" for one in turn.extremes)
        facts.append(texts.extremes.format(extremes=", ".join(ends)))
    facts += stroke_facts(turn, language)
    if turn.stroke is None and turn.why_no_stroke is not None:
        facts.append(
            _no_value("H" if output.slide is not None else "ψ", turn.why_no_stroke, language)
        )
    # The strokes of a cam have its dwells in them: their ratio is no K_v.
    ratio = ratio_facts(turn, language) if turn.solution.problem.drive.revolves else []
    facts += ratio
    why = working_fact(turn, language) if ratio else ""
    facts += [why] if why else []
    if not ratio and turn.why_no_ratio is not None:
        facts.append(_no_value("K_{v}", turn.why_no_ratio, language))
    peak = turn.pressure
    if peak is not None:
        most, least = degrees(peak.maximum, language), degrees(peak.minimum, language)
        most_at, least_at = place(peak.maximum_at), place(peak.minimum_at)
        text = texts.pressure if abs(peak.maximum) > NO_ANGLE else texts.no_pressure
        facts.append(text.format(most=most, most_at=most_at, least=least, least_at=least_at))
    return facts


def range_fact(turn: CrankCycle, language: Language) -> str:
    """Return the range of rotation of the crank."""
    if turn.range is None:
        return str(language.cycle["full_turn"][turn.solution.problem.drive.mover])
    low, high = (degrees(limit, language) for limit in turn.range)
    links = tuple(dict.fromkeys(link for end in turn.range for link in turn.stopping(end)))
    said = language.cycle["range"][turn.solution.problem.drive.mover]
    return str(said.format(low=low, high=high, links=", ".join(links)))


def _no_value(name: str, reason: NoNumber, language: Language) -> str:
    return language.cycle.none.format(what=name, why=language.cycle["why"][reason.name])


def diagram_scales(diagrams: Diagrams, language: Language) -> list[str]:
    """Return the scales of the diagrams as they are inscribed."""
    convention = diagrams.cycle.solution.problem.scales.convention
    return [scale_inscription(scale, convention, language.notation) for scale in diagrams.scales]


def diagram_steps(diagrams: Diagrams, language: Language) -> list[str]:
    """Return how the diagrams are made, a paragraph each."""
    texts, task, notation = language.cycle, diagrams.task, language.notation
    way, omega = task.differentiation, f"ω_{{{diagrams.cycle.solution.problem.drive.link}}}"
    made = [
        texts.scheme_steps.format(
            length=notation.as_input(half_up(diagrams.length, 2)), count=diagrams.count
        ),
        texts["ray_steps"][way.value].format(pole=notation.as_input(half_up(diagrams.poles[0], 2))),
        texts.again.format(pole=notation.as_input(half_up(diagrams.poles[1], 2))),
        texts.scales.format(
            scales="; ".join(diagram_scales(diagrams, language)),
            radians=notation.computed(diagrams.mu_phi),
            omega=omega,
        ),
    ]
    if diagrams.mu_t is not None:
        made.append(texts.time.format(omega=omega, seconds=notation.computed(diagrams.mu_t)))
    return made


def drawn_notes(diagrams: Diagrams, language: Language) -> list[str]:
    """Return what the lines of the drawn diagrams are, and what they leave out."""
    way, turn = diagrams.task.differentiation, diagrams.cycle
    notes = [language.cycle.drawn.format(way=language.cycle["chords"][way.value])]
    if turn.solution.problem.drive.acceleration:
        even, added, symbol = acceleration_parts(turn.output)
        notes.append(language.cycle.drawn_even.format(symbol=symbol, even=even, added=added))
    return notes


def acceleration_parts(output: Output) -> tuple[str, str, str]:
    """Return the parts of the output's acceleration by omega and epsilon, and the whole."""
    index = output_symbol(output).partition("_")[2]
    v, a = ("ω", "ε") if output.slide is None else ("v", "a")
    return f"{a}_{{q}}·ω^{{2}}", f"{v}_{{q}}·ε", f"{a}_{index}"


def radius_names(construction: ExtremesConstruction) -> tuple[str, str, str]:
    """Return what the crank's radius, the sum and the difference of rod and crank are called."""
    crank, rod = (
        f"l_{{{_flat(construction.pivot, construction.pin)}}}",
        f"l_{{{_flat(construction.pin, construction.end)}}}",
    )
    if construction.locus is Locus.TANGENTS:
        return crank, "", ""
    longer, other = (rod, crank) if construction.is_rod_longer else (crank, rod)
    return crank, f"{rod} + {crank}", f"{longer} − {other}"


def _flat(*names: str) -> str:
    return "".join(name.translate(str.maketrans("", "", "{}_")) for name in map(point_name, names))


def extreme_steps(
    turn: CrankCycle, construction: ExtremesConstruction | None, language: Language
) -> list[str]:
    """Return how the extreme positions are constructed, and their readings."""
    texts, notation = language.cycle, language.notation
    if construction is None:
        return [texts.no_construction] if turn.ends is not None else []
    facts = construction_facts(construction, language)
    angles = [
        texts["constructed"]["phi"].format(
            name=f"φ{p}",
            read=degrees(both.read % turn.period, language),
            exact=degrees(round(both.exact % turn.period, 2) % turn.period, language),
            sigma=degrees(both.sigma, language),
        )
        for p, both in zip(PRIMES, compared_extremes(construction), strict=True)
    ]
    unit = "m" if construction.locus is Locus.GUIDE else "deg"

    def size(value: float, digits: int) -> str:
        if unit == "deg":
            return degrees(value, language)
        return with_unit(notation.number(significant(value, digits)), notation.units["m"])

    stroke = compared_stroke(construction)
    told = texts["constructed"][unit].format(
        angles="; ".join(angles),
        link=construction.link,
        read=size(stroke.read, 4),
        exact=size(stroke.exact, 4),
        sigma=size(stroke.sigma, 2),
    )
    return [texts["construction"][construction.locus.value].format(**facts), told]


def construction_facts(construction: ExtremesConstruction, language: Language) -> dict[str, str]:
    """Return what the sentences of the construction of extreme positions name."""

    def primed(name: str) -> list[str]:
        return [point_name(name) + p for p in PRIMES]

    def mm(name: str) -> str:
        return language.notation.number(f"{construction.length(name):.1f}")

    crank, total, less = radius_names(construction)
    arcs = construction.locus is not Locus.TANGENTS
    return {
        "pivot": point_name(construction.pivot), "end": point_name(construction.end),
        "centre": point_name(construction.centre) if construction.centre else "",
        "crank": crank, "crank_mm": mm("r"), "pins": ", ".join(primed(construction.pin)),
        "ends": ", ".join(primed(construction.end)),
        "rays": ", ".join(point_name(construction.pivot) + end for end in primed(construction.end)),
        "far": total, "near": less,
        "far_mm": mm("l+r") if arcs else "", "near_mm": mm("l-r") if arcs else "",
    }  # fmt: skip
