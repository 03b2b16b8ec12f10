"""A group of class III as a student draws it, by Assur's special point (группа III класса)."""

from __future__ import annotations

from benchmarks.checking.drawing import ACCELERATIONS, LETTER, SCHEME, VELOCITIES, Drawing
from benchmarks.checking.scheme import lines, on_three_arms


def triad(
    student: Drawing, arms: tuple[tuple[str, str, str], ...], base: str, side: int, guess: complex
) -> None:
    """Draw a body on three arms (ground, corner, link of the arm), by the special point."""
    grounds = tuple(ground for ground, _, _ in arms)
    one, two, three = corners = tuple(corner for _, corner, _ in arms)
    pairs = tuple(student.pair_of(ground, corner) for ground, corner, _ in arms)
    if student.stage == SCHEME:
        length = student.length(student.pair_of(one, two))
        body = (0j, complex(length), student.shape(one, two, three, side) * length)
        places = tuple(student.true[name] for name in grounds)
        found = on_three_arms(
            (places[0], places[1], places[2]),
            (student.length(pairs[0]), student.length(pairs[1]), student.length(pairs[2])),
            body,
            guess,
        )
        for name, where in zip(corners, found, strict=True):
            student.place(name, where)
        return
    if student.stage not in student.plan:
        return
    plan = student.plan[student.stage]
    starts = [plan[ground] for ground in grounds]
    if student.stage == ACCELERATIONS:
        starts = [
            plan[ground] + student.normal(link, corner, ground, f"speed {corner} {ground}")
            for ground, corner, link in arms
        ]
    _by_special_point(student, grounds, corners, starts)
    _triad_readings(student, arms, base, pairs, starts)


def _by_special_point(
    student: Drawing, grounds: tuple[str, ...], corners: tuple[str, ...], starts: list[complex]
) -> None:
    """Draw the corners: the special point is where the lines of the first two arms meet."""
    along = [student.at[c] - student.at[g] for g, c in zip(grounds, corners, strict=True)]
    special = lines(student.at[corners[0]], along[0], student.at[corners[1]], along[1])
    across = [1j * student.along(g, c) for g, c in zip(grounds, corners, strict=True)]
    scale, last = student.scale("mu_l"), student.stage == ACCELERATIONS
    turn = student.turns.get("3", 0.0)

    def inward(tail: complex, head: complex) -> complex:
        """Return the normal acceleration of tail about head on the body, mm of the plan."""
        return turn**2 * (head - tail) * scale / student.scale("mu_a") if last else 0j

    first, second, third = (student.at[corner] for corner in corners)
    s = lines(
        starts[0] - inward(first, special), across[0],
        starts[1] - inward(second, special), across[1],
    )  # fmt: skip
    s = student.hand.put(f"{student.stage} special", s)
    way = 1j * student.hand.carry(f"{student.stage} SD", third - special)
    d = student.draw(corners[2], lines(s + inward(third, special), way, starts[2], across[2]))
    for corner, where, start, line in zip(corners, (first, second), starts, across, strict=False):
        way = 1j * student.hand.carry(f"{student.stage} D{corner}", where - third)
        student.draw(corner, lines(d + inward(where, third), way, start, line))


def _triad_readings(
    student: Drawing,
    arms: tuple[tuple[str, str, str], ...],
    base: str,
    pairs: tuple[str, ...],
    starts: list[complex],
) -> None:
    plan, letter = student.plan[student.stage], LETTER[student.stage]
    one, two = arms[0][1], arms[1][1]
    for _, corner, _ in arms:
        student.keep(f"{letter} {corner}", plan[corner])
    arm = student.at[two] - student.at[one]
    for number, (ground, corner, link) in enumerate(arms):
        own = student.at[corner] - student.at[ground]
        if student.stage == VELOCITIES:
            speed = f"v {corner}"
            if plan[ground] != 0:
                speed = f"v {corner} {ground}"
                student.keep(speed, plan[corner] - plan[ground])
            student.known[f"speed {corner} {ground}"] = student.known[speed]
            student.rotation(link, speed, pairs[number], own, plan[corner] - plan[ground])
        else:
            student.tangential(f"at {corner} {ground}", starts[number], plan[corner])
    pair = student.pair_of(one, two)
    if student.stage == VELOCITIES:
        student.keep(f"v {two} {one}", plan[two] - plan[one])
        student.rotation(base, f"v {two} {one}", pair, arm, plan[two] - plan[one])
        return
    normal = student.normal(base, two, one, f"v {two} {one}")
    across = plan[two] - plan[one] - normal
    student.tangential(f"at {two} {one}", 0j, across)
    student.angular(base, f"at {two} {one}", pair, arm, across)
