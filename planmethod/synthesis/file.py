"""Problem file of a mechanism that was found (файл задачи): commented, ready to solve."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.note.wording import Language
from planmethod.synthesis.model import Synthesis, place, ray_angle

COUNT = 12
"""Positions of the driver in a file whose driver turns fully."""

OMEGA = 10.0
"""Angular velocity of the driver, 1/s: to be changed to one's own."""


def problem_text(synthesis: Synthesis, source: str, words: Language) -> str:
    """Return the problem file.

    Parameters
    ----------
    source : str
        The command that made it.
    """
    return "\n".join(_lines(synthesis, source, words)) + "\n"


def _lines(made: Synthesis, source: str, words: Language) -> Iterator[str]:
    said = words.synthesis
    exact, lengths = made.exact(), made.metres()
    origin = place(exact, made.pivots[0]) if made.moved else 0j
    yield f'title = "{said.mechanisms[made.kind]}"'
    yield f'source = "{source}"'
    yield ""
    yield f"[frame] # {said.comments['frame']}"
    for pivot in made.pivots:
        at = place(exact, pivot) - origin
        yield f"{pivot} = [{at.real + 0.0!r}, {at.imag + 0.0!r}]"
    for point in made.guide:
        level = (place(exact, point) - origin).imag + 0.0
        yield f"guides.x-x = {{ through = [0.0, {level!r}], angle = 0 }}"
    for table in made.tables[:-1]:
        yield ""
        yield f"[{table.head}] # {said.comments[table.word]}"
        yield from (line.format(**lengths) for line in table.lines)
    yield ""
    yield f"[driver] # {said.comments['driver']}"
    yield 'link = "1"'
    if made.positions:
        yield f"phi = [{', '.join(repr(phi) for phi in made.positions)}]"
    else:
        pivot, pin = made.driver
        start = ray_angle(place(exact, pivot), place(exact, pin))
        yield f"phi = {{ from = {start!r}, count = {COUNT} }} # {said.comments['zero']}"
    yield f"omega = {OMEGA!r} # {said.comments['omega']}"
    yield "epsilon = 0.0"
    yield ""
    yield f"[assembly] # {said.comments['assembly']}"
    yield from made.tables[-1].lines
