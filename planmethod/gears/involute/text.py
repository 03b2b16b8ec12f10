"""A pair of wheels for the terminal and the note: tables, the calculation (текст расчёта)."""

from __future__ import annotations

from planmethod.gears.involute.quantities import Solved, Told, Unit
from planmethod.gears.involute.sizes import MeshingProblem
from planmethod.note.plaintext import plain_text
from planmethod.note.wording import Language, language
from planmethod.note.writers.plain import heading, table, wrap


def solved_text(problem: MeshingProblem, lang: str) -> str:
    """Tell what is given, the sizes of the pair and of the wheels, and the limits."""
    solved, words = Solved(problem), language(lang)
    say = words.meshing
    pair, wheels, contact = solved.told()
    lines = head(solved, words)
    lines += ["", say.pair, *_table([*pair, *contact], words, say.columns[:2])]
    lines += ["", say.wheels, *_table(wheels, words, say.columns)]
    return "\n".join([*lines, *limits_text(solved, words)])


def given_text(solved: Solved, words: Language) -> list[str]:
    """Return what is given and which shifts there are, rich text."""
    problem, say = solved.problem, words.meshing
    fields = {name: shown.strip("()") for name, shown in solved.fields(words.say).items()}
    further = ""
    if problem.a_w is not None:
        further = f", a_{{w}} = {words.say.given(problem.a_w)} {say.units['mm']}"
    if problem.cutter:
        further += say.ring.format(cutter=problem.cutter)
    return [
        say.given.format(further=further, **fields),
        say.shifts[problem.chosen].format(**fields),
    ]


def remarks(solved: Solved, words: Language) -> list[str]:
    """Return what undercut takes away, rich text; nothing where there is none."""
    say, found = words.meshing, []
    for k, tooth in enumerate(solved.teeth):
        if tooth.is_cut:
            rho, d = tooth.rho_low, 2 * abs(complex(tooth.flank(tooth.rho_low)))
            numbers = {"rho": rho, "d": d, "x_min": tooth.size("x_min")}
            shown = {name: words.say.number(f"{v:.3f}") for name, v in numbers.items()}
            found.append(say.undercut.format(wheel=k + 1, **shown))
    standard, active = float(solved.pair.epsilon), solved.contact.overlap(solved.pair)
    if active < standard - 1e-9:
        told = {"epsilon": active, "standard": standard}
        shown = {name: words.say.number(f"{v:.3f}") for name, v in told.items()}
        found.append(say.cut_line.format(**shown))
    return found


def head(solved: Solved, words: Language) -> list[str]:
    """Return the title and what is given."""
    title = solved.problem.title or solved.problem.name
    lines = heading(words.meshing.title.format(title=title), "═")
    for text in given_text(solved, words):
        lines += plainly(text, "")
    return lines


def plainly(rich: str, first: str = "  ") -> list[str]:
    """Return rich text as lines of plain text."""
    return wrap(plain_text(rich), first=first, rest="    " if first else "")


def unit_of(one: Told, words: Language) -> str:
    """Return what stands after the name of a quantity: its unit, if it has one."""
    unit = one.quantity.unit
    return f", {words.meshing.units[unit.value[0]]}" if unit in (Unit.MM, Unit.DEGREE) else ""


def symbol_of(one: Told) -> str:
    """Return the symbol of a quantity; of both wheels without a number."""
    return one.quantity.symbol.replace("#", "").replace("_{}", "")


def _table(told: list[Told], words: Language, columns: tuple[str, ...]) -> list[str]:
    rows = []
    for one in told:
        name = words.meshing.names[one.quantity.key] + unit_of(one, words)
        shown = ["—" if "nan" in text else text for text in one.shown(words.say)]
        rows.append([name, plain_text(symbol_of(one)), *map(plain_text, shown)])
    head = list(columns) + ([""] if len(columns) == 2 else [])
    return table(head, rows, left=2)


def limits_text(solved: Solved, words: Language) -> list[str]:
    """Return what the limits say, and what undercut takes away."""
    say = words.meshing
    lines = ["", say.checked]
    for _, holds, text in solved.sentences(words):
        lines += plainly(f"{text}: {say.holds[holds]}")
    for text in remarks(solved, words):
        lines += plainly(text)
    return lines
