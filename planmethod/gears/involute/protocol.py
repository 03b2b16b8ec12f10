"""The calculation of a pair of wheels, formula by formula (протокол расчёта)."""

from __future__ import annotations

from planmethod.construct.drafting import Profile
from planmethod.gears.involute.quantities import Solved
from planmethod.gears.involute.sizes import MeshingProblem
from planmethod.gears.involute.text import head, limits_text, plainly
from planmethod.note.wording import language


def protocol_text(problem: MeshingProblem, lang: str, profile: Profile) -> str:
    """Tell the calculation formula by formula, as the note has it; no hand draws in it."""
    solved, words = Solved(problem), language(lang)
    say, fields = words.meshing, solved.fields(words.say)
    lines, number, before = head(solved, words), 0, ""
    for key, formula in solved.formulas(words):
        if key != before and key in say["steps"]:
            number += 1
            lines += ["", f"{number}. {say['steps'][key]}"]
        if key != before and key in say["beside"]:
            lines += plainly(say["beside"][key].format(**fields))
        lines += plainly(formula)
        before = key
    return "\n".join([*lines, *limits_text(solved, words)])
