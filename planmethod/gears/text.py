"""What the terminal shows of a train: tables of structure, speeds, pictures (таблицы)."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction

from msgspec import Struct

from planmethod.errors import PlanMethodError
from planmethod.gears.answers import answer, rack_speed
from planmethod.gears.conditions import conditions, sentence
from planmethod.gears.model import GearProblem, Mesh, MeshKind
from planmethod.gears.motion import Motion, Structure, TrainKind, analyse, mesh_row, solve_motion
from planmethod.gears.picture import draw
from planmethod.gears.roles import Roles
from planmethod.note.numbers import MINUS
from planmethod.note.plaintext import found, spoken
from planmethod.note.wording import Language, language
from planmethod.note.writers.plain import columns_text, heading, table, wrap


def solved_text(problem: GearProblem, lang: str) -> str:
    """Tell structure, equations, speeds, what is asked, conditions, pictures, printed values.

    Raises
    ------
    ProblemError
    """
    motion = solve_motion(problem)
    words = language(lang)
    say = words.gears
    lines = heading(say.title.format(title=problem.title or problem.name), "═")
    lines += _structure(problem, motion.roles, motion.structure, words)
    lines += ["", say.equations]
    for mesh in motion.train.meshes:
        lines += wrap(_equation(motion, mesh, words), rest="  ")
    lines += ["", say.wheels, *_wheels(motion, words)]
    lines += ["", say.speeds, *_speeds(motion, words)]
    for turns in tabular(motion):
        lines += ["", *_tabular(motion, turns, words)]
    if motion.train.ask:
        lines += ["", say.asked, *_asked(motion, words)]
    judged = conditions(motion)
    if judged:
        lines += ["", say.checked]
    for one in judged:
        lines += wrap(f"{sentence(one, words)}: {say.holds[one.holds]}", rest="  ")
    lines += ["", say.picture, *_picture(motion, words)]
    if problem.published:
        lines += ["", say.published, *_published(problem, motion, words)]
    return "\n".join(lines)


def structure_text(problem: GearProblem, lang: str) -> str:
    """Tell the structure of a train.

    Raises
    ------
    ProblemError
    """
    roles, _, structure = analyse(problem)
    words = language(lang)
    lines = heading(words.gears.title.format(title=problem.title or problem.name), "═")
    return "\n".join([*lines, *_structure(problem, roles, structure, words)])


def _structure(problem: GearProblem, roles: Roles, found: Structure, words: Language) -> list[str]:
    say, train = words.gears, problem.train
    lines = ["", say.structure, say.kind.format(kind=say.kinds[found.kind.value])]
    formula = str(found.formula).replace("-", MINUS)
    texts = [
        say.chebyshev.format(n=found.moving, low=found.lower, high=found.higher, w=formula),
        say.by_meshes.format(rank=found.moving - found.mobility, w=found.mobility),
        say.redundant.format(plane=found.redundant, space=found.spatial),
    ]
    for carrier in train.carriers:
        central, around = roles.central[carrier], roles.satellites[carrier]
        said = {"central": ", ".join(central) or "—", "satellites": ", ".join(around)}
        texts.append(say.carrier.format(carrier=carrier, **said))
    if found.kind is TrainKind.CLOSED:
        names = [mesh.name for mesh in train.meshes if train.carrier(mesh) is None]
        if names:
            texts.append(say.closing.format(meshes=", ".join(names)))
    for text in texts:
        lines += wrap(text, rest="  ")
    return lines


def fraction_text(value: Fraction | None) -> str:
    """Return a fraction, whole numbers without a denominator; a dash of none."""
    return "—" if value is None else str(value).replace("-", MINUS)


def _equation(motion: Motion, mesh: Mesh, words: Language) -> str:
    """Return the equation of a mesh with its ratio: ``(n_1 − n_H)·20 = −(n_2 − n_H)·40``."""
    equation, stage = (plainly(text) for text in equation_of(motion, mesh))
    return words.gears.equation.format(name=mesh.name, equation=equation, stage=stage)


def plainly(rich: str) -> str:
    """Return rich text without the braces of its indices."""
    return rich.replace("{", "").replace("}", "")


def equation_of(motion: Motion, mesh: Mesh) -> tuple[str, str]:
    """Return the equation of a mesh, and its ratio seen from the carrier, as rich text."""
    train = motion.train
    row = mesh_row(train, motion.roles, motion.axes, mesh)
    one, other = train.ends(mesh)

    def speed(label: str, body: str) -> str:
        if body in train.racks:
            return f"v_{{{label}}}"
        if mesh.carrier is None or body in motion.roles.across:
            return f"{train.letter}_{{{label}}}"
        return f"({train.letter}_{{{label}}} − {train.letter}_{{{mesh.carrier}}})"

    sign = MINUS if row[other] > 0 else ""
    size = "" if mesh.kind is MeshKind.RACK else f"·{fraction_text(abs(row[other]))}"
    left = f"{speed(mesh.first, one)}·{fraction_text(row[one])}"
    hat = "" if mesh.carrier is None else f"^{{{mesh.carrier}}}"
    ratio = f"U{hat}_{{{mesh.first}-{mesh.second}}} = {fraction_text(-row[other] / row[one])}"
    return f"{left} = {sign}{speed(mesh.second, other)}{size}", ratio


def _wheels(motion: Motion, words: Language) -> list[str]:
    train, say = motion.train, words.gears
    said = {"letter": "z" if train.toothed else "r, " + say.units["m"]}
    said["unit"] = say.units["m/2" if train.toothed else "m"]
    rows = []
    for label, size in motion.axes.sizes.items():
        height = motion.axes.heights.get(train.body_of[label])
        mark = "*" if label in train.unknown else ""
        shown = [_size(x, words) if x is not None else "—" for x in (size, height)]
        if train.toothed and not train.counted(label):
            shown[0] = f"r = {shown[0]} {say.units['mm']}"
        rows.append([label + mark, *shown])
    return table([head.format(**said) for head in say.columns_wheels], rows)


def _size(value: Fraction, words: Language) -> str:
    if value.denominator == 1:
        return fraction_text(value)
    return found(float(value), words.note)


def _speeds(motion: Motion, words: Language) -> list[str]:
    train, say = motion.train, words.gears
    said = {"letter": train.letter, "other": "ω" if train.letter == "n" else "n"}
    said["unit"], said["other_unit"] = (say.units[unit] for unit in train.units)
    rows, notes = [], []
    for label in train.numbers:
        body, speed = train.body_of[label], motion.speed(label)
        if body in train.racks:
            metres = rack_speed(motion, label)
            shown = "—" if metres is None else f"{found(metres, words.note)} {say.units['m/s']}"
            rows.append([f"{label} ({say.rack})", shown, "—", "—", ""])
            continue
        relative = [
            say.relative.format(
                letter=said["letter"], carrier=c, value=fraction_text(motion.speed(label, c))
            )
            for c in train.carriers
            if body in (*motion.roles.central[c], *motion.roles.satellites[c])
        ]
        other = found(float(speed) * train.factor, words.note)
        value = found(float(speed), words.note)
        rows.append([label, value, fraction_text(speed), other, "; ".join(relative)])
        if body in motion.roles.across:
            notes += wrap(say.across.format(label=label), rest="  ")
    return table([head.format(**said) for head in say.columns_speeds], rows) + notes


def _tabular(motion: Motion, turns: Turns, words: Language) -> list[str]:
    say = words.gears
    letter = motion.train.letter
    said = {"carrier": turns.carrier, "wheel": ", ".join(turns.started)}
    head = wrap(say.tabular.format(**said), rest="  ")
    total = {body: speed + turns.held[body] for body, speed in turns.together.items()}
    rows = [
        [
            name.format(letter=letter, carrier=turns.carrier),
            *(fraction_text(part[body]) for body in total),
        ]
        for name, part in zip(say.tabular_rows, (turns.together, turns.held, total), strict=True)
    ]
    return [*head, *columns_text(list(zip(("", *total), *rows, strict=True)), 1)]


def _asked(motion: Motion, words: Language) -> list[str]:
    say, rows, notes = words.gears, [], []
    for name in motion.train.ask:
        one = answer(motion, name)
        if one.value is None:
            reason = say.reasons[one.reason].format(label=one.label)
            notes += wrap(f"{name}: {reason}", rest="  ")
            continue
        exact = "" if one.exact is None else fraction_text(one.exact)
        unit = say.units[one.unit] if one.unit else ""
        whole = one.exact is not None and one.exact.denominator == 1
        value = exact if whole else found(one.value, words.note)
        rows.append([name, value, exact, unit])
    return [*(table(list(say.columns_asked), rows) if rows else []), *notes]


def _picture(motion: Motion, words: Language) -> list[str]:
    say, picture = words.gears, draw(motion)
    if picture is None:
        return wrap(say.no_picture, rest="  ")
    scales = say.scales.format(
        mu_l=found(float(picture.mu_l), words.note),
        mu_v=found(picture.mu_v, words.note),
        pole=found(float(picture.pole_mm), words.note),
        mu_omega=found(picture.mu_omega, words.note),
    )
    points = []
    for one in picture.contacts:
        kind, _, name = one.name.partition(" ")
        both = (one.height_mm, one.speed_mm)
        shown = (found(float(mm), words.note) for mm in both)
        points.append([say.points[kind].format(name=name), *shown])
    rays = [[label, found(float(segment), words.note)] for label, segment in picture.rays]
    return [
        *wrap(scales, rest="  "),
        *table(list(say.columns_contacts), points),
        "",
        *table(list(say.columns_rays), rays),
    ]


def _published(problem: GearProblem, motion: Motion, words: Language) -> list[str]:
    say, rows, notes = words.gears, [], []
    for one in problem.published:
        exact = answer(motion, one.what).value
        off = "" if not exact else found(100 * (one.value / exact - 1), words.note)
        printed = spoken(f"{one.value:g}", words.note)
        rows.append([one.name, printed, "—" if exact is None else found(exact, words.note), off])
        if one.note:
            notes += wrap(f"{one.name}: {one.note}", rest="  ")
    return table(list(say.columns_published), rows) + notes


class Turns(Struct, frozen=True):
    """The table of one carrier (таблица вращений).

    Attributes
    ----------
    carrier : str
    started : tuple of str
        Bodies that are turned while the carrier is held; the others follow by the stages.
    together, held : mapping
        By body: speeds of the locked train, and those with the carrier held. Their sum is the
        speed; of a body across the main axis that is its own turning, with the carrier it has none.
    """

    carrier: str
    started: tuple[str, ...]
    together: Mapping[str, Fraction]
    held: Mapping[str, Fraction]


def tabular(motion: Motion) -> tuple[Turns, ...]:
    """Make the tables of all carriers that may turn, and compare their sums with the speeds.

    Raises
    ------
    PlanMethodError
        A sum is not the speed that the mesh equations give: a mistake of ours.
    """
    return tuple(
        _table(motion, carrier)
        for carrier in motion.train.carriers
        if carrier not in motion.train.fixed
    )


def _table(motion: Motion, carrier: str) -> Turns:
    train, roles = motion.train, motion.roles
    central = roles.central[carrier]
    bodies = (*central, *roles.satellites[carrier])
    locked = motion.speeds[carrier]
    together = {b: Fraction(0) if b in roles.across else locked for b in bodies}
    sources = sorted(bodies, key=lambda b: (b not in train.fixed, b not in train.inputs))
    held: dict[str, Fraction] = {}
    started = []
    for source in sources:
        if source in held:
            continue
        started.append(source)
        held[source] = motion.speeds[source] - together[source]
        for _ in train.meshes:
            _follow(motion, carrier, held)
    for body in bodies:
        if together[body] + held[body] != motion.speeds[body]:
            raise PlanMethodError(
                "the tabular method gives {} the speed {}, the mesh equations {}; please "
                "report the problem file",
                body,
                together[body] + held[body],
                motion.speeds[body],
            )
    return Turns(
        carrier, tuple(started), {carrier: locked} | together, {carrier: Fraction(0)} | held
    )


def _follow(motion: Motion, carrier: str, held: dict[str, Fraction]) -> None:
    """Carry the turning on through each mesh that has one end turned already."""
    train = motion.train
    for mesh in train.meshes:
        if train.carrier(mesh) != carrier:
            continue
        row = mesh_row(train, motion.roles, motion.axes, mesh)
        for near, far in (train.ends(mesh), train.ends(mesh)[::-1]):
            if near in held and far not in held:
                held[far] = -held[near] * row[near] / row[far]
