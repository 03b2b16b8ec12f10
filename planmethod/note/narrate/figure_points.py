"""Sizes that follow from the coordinates of a figure: given data, protocol (размеры по рисунку)."""

# no messages: names of keys, in the words of the file

from __future__ import annotations

from collections.abc import Iterator, Sequence

from msgspec.structs import replace

from planmethod.note.document import NO_BREAK, GivenFact
from planmethod.note.formula import Rich
from planmethod.note.narrate.naming import point_name
from planmethod.note.narrate.stated_links import DRAWN, StatedNumbers, file_path_of_link
from planmethod.note.numbers import MINUS, trimmed, with_unit
from planmethod.note.wording import Language
from planmethod.problem.model import DrawnPoints, DrawnSize, Problem
from planmethod.problem.names import UNITS, segment
from planmethod.solved.drawn_shift import shifts
from planmethod.solved.solution import Solution


def coordinates_fact(text: StatedNumbers) -> Iterator[GivenFact]:
    """Yield the coordinates of a figure, without fixed points that the frame gives."""
    shown = shown_points(text.problem)
    if shown is None:
        return
    frame = text.problem.source_table.get("frame", {})
    places, data = [], dict[str, object]()
    for name, place in shown.places.items():
        if name in frame and ("frame", name) not in shown.file_values:
            continue
        path = f"drawn.points.{segment(name)}"
        data[path] = [place.real, place.imag]
        values = [
            text.notation.as_input(part * UNITS[text.problem.unit])
            for part in (place.real, place.imag)
        ]
        places.append(f"{point_name(name)}{NO_BREAK}({f';{NO_BREAK}'.join(values)})")
    if places:
        unit = text.notation.units[text.problem.unit]
        derived = text.language.note.given_figure_points.format(points=", ".join(places), unit=unit)
        yield GivenFact(derived, data)
    if shown.step is not None:
        step = text.metres(shown.step, "drawn.round")
        derived = text.language.note.given_figure_step.format(step=step)
        yield GivenFact(derived, {"drawn.round": shown.step})


def shown_points(problem: Problem) -> DrawnPoints | None:
    """Return the coordinates of the figure of a problem, if it has some."""
    return None if problem.drawn is None else problem.drawn.shown


def without_sizes(facts: Sequence[GivenFact], text: StatedNumbers) -> list[GivenFact]:
    """Return the given data with the sizes that follow from the coordinates in one fact."""
    shown = shown_points(text.problem)
    if shown is None:
        return list(facts)
    paths = {".".join(map(segment, size.path)) for size in shown.sizes}
    kept, found = [], [
        f"{size_symbol(size)}{NO_BREAK}={NO_BREAK}{_short(size.value, text)}"
        for size in shown.sizes
        if size.of
    ]  # fmt: skip
    derived = {
        file_path_of_link(size.path[1], size.path[2])
        for size in shown.sizes
        if size.of and size.path[0] == "links"
    }
    for fact in facts:
        followed = {key for key in fact.data if key in paths}
        if not followed:
            kept.append(fact)
        elif not followed <= derived:
            kept += [replace(fact, data={k: v for k, v in fact.data.items() if k not in followed})]
        elif followed != {*fact.data}:
            kept.append(
                replace(fact, data={k: v for k, v in fact.data.items() if k not in followed})
            )
    if found:
        kept.append(
            GivenFact(text.language.note.given_figure_sizes.format(sizes=", ".join(found)), {})
        )
    return kept


def size_symbol(size: DrawnSize) -> Rich:
    """Return the symbol of a size: ``l_{BC}``."""
    return f"l_{{{''.join(size.of)}}}"


def _short(metres: float, text: StatedNumbers, digits: int = DRAWN) -> str:
    """Return a size that follows, to the digits that can be drawn."""
    unit = text.problem.unit
    number = text.notation.number(trimmed(metres * UNITS[unit], digits))
    return with_unit(number, text.notation.units[unit])


def size_sentences(solution: Solution, language: Language) -> list[Rich]:
    """Return how the sizes follow from the coordinates, how they are rounded and what moves."""
    shown, note = shown_points(solution.problem), language.note
    if shown is None:
        return []
    text = StatedNumbers(solution.problem, language)
    lengths = [size for size in shown.sizes if size.of]
    derived = []
    if lengths:
        found = "; ".join(_length(size, shown, text, full=not k) for k, size in enumerate(lengths))
        derived.append(note.figure_sizes.format(sizes=found))
    if shown.step is None:
        return derived
    changed = [size for size in shown.sizes if size.exact != size.value]
    step = text.metres(shown.step, "drawn.round")
    if changed:
        changes = "; ".join(
            note.figure_change.format(
                symbol=size_symbol(size) if size.of else ".".join(size.path),
                before=_short(size.exact, text),
                after=_short(size.value, text),
            )
            for size in changed
        )
        derived.append(note.figure_rounded.format(step=step, changes=changes))
    moved = shifts(solution.problem)
    if moved:
        points = ", ".join(f"{point_name(p)} {_short(off, text, 2)}" for p, off in moved.items())
        derived.append(note.figure_moved.format(points=points))
    return derived


def _length(size: DrawnSize, shown: DrawnPoints, text: StatedNumbers, *, full: bool) -> Rich:
    """Return how a length follows; ``full`` with the formula in letters."""
    one, two = (shown.places[p] if p in shown.places else _fixed(p, text) for p in size.of)
    per, (tail, head) = UNITS[text.problem.unit], map(point_name, size.of)
    parts = []
    for part in ((two - one).real, (two - one).imag):
        number = text.notation.number(trimmed(part * per, DRAWN)).replace("-", MINUS)
        parts.append(f"({number})^{{2}}" if number.startswith(MINUS) else f"{number}^{{2}}")
    letters = " + ".join(f"({a}_{{{head}}} {MINUS} {a}_{{{tail}}})^{{2}}" for a in "xy")
    formula = f" = √({letters})" if full else ""
    return f"{size_symbol(size)}{formula} = √({' + '.join(parts)}) = {_short(size.exact, text)}"


def _fixed(name: str, text: StatedNumbers) -> complex:
    return text.problem.bodies["0"].points[name]
