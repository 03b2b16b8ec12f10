"""Documents on a solved train: structure, equations, speeds, velocity diagrams (документы)."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from fractions import Fraction

from msgspec import Struct

from planmethod.errors import PlanMethodError
from planmethod.gears.answers import answer, rack_speed
from planmethod.gears.comparison import PlanetaryComparison, compare
from planmethod.gears.conditions import conditions, judgement
from planmethod.gears.derivation import derivation
from planmethod.gears.model import GearProblem, Mesh, MeshKind
from planmethod.gears.motion import (
    Mobility,
    TrainKind,
    TrainMotion,
    analyse,
    mesh_row,
    solve_motion,
)
from planmethod.gears.picture import draw
from planmethod.gears.roles import Roles
from planmethod.gears.velocities import by_velocities
from planmethod.note.compared import ComparedNumber
from planmethod.note.document import (
    Caption,
    Item,
    Node,
    Paragraph,
    Table,
    Title,
    table_of,
)
from planmethod.note.formula import Rich, escape
from planmethod.note.narrate.given import reading_notes
from planmethod.note.narrate.structure import pair_classes
from planmethod.note.numbers import MINUS, half_up
from planmethod.note.wording import Language


def solved_document(problem: GearProblem, words: Language) -> Iterator[Node]:
    """Yield structure, equations, speeds, requested values, conditions, diagrams, printed values.

    Raises
    ------
    ProblemError
    """
    motion, say = solve_motion(problem), words.gears
    structure = _structure(problem, motion.roles, motion.structure, words)
    yield next(structure)
    yield from reading_notes(problem, words)
    yield from structure
    yield Caption(say.equations)
    for mesh in motion.train.meshes:
        equation, stage = (escape(plainly(text)) for text in equation_of(motion, mesh))
        yield Item(say.equation.format(name=mesh.name, equation=equation, stage=stage))
    if derived := [*derivation(motion, words), *by_velocities(motion, words)]:
        yield Caption(say["derived"]["title"])
        yield from (Item(line.text) for line in derived)
    yield Caption(say.wheels)
    yield _wheels(motion, words)
    yield Caption(say.speeds)
    yield from _speeds(motion, words)
    for turns in tabular(motion):
        yield from _tabular(motion, turns, words)
    if motion.train.ask:
        yield Caption(say.asked)
        yield from _asked(motion, words)
    judged = conditions(motion)
    if judged:
        yield Caption(say.checked)
    for one in judged:
        yield Item(escape(judgement(one, words)))
    compared = compare(problem, motion)
    if compared is not None:
        yield Caption(words.teeth["compared"]["title"])
        yield from (Paragraph(line) for line in compared_sentences(compared, words))
        yield compared_table(compared, words)
    yield Caption(say.picture)
    yield from _picture(motion, words)
    if problem.published:
        yield Caption(say.published)
        yield from _published(problem, motion, words)


def compared_sentences(compared: PlanetaryComparison, words: Language) -> Iterator[Rich]:
    """Yield the requirements, the number of sets, and the rank of the train of the file."""
    say, task, number = words.teeth["compared"], compared.task, words.say.given
    scheme: str = words.teeth["schemes"][compared.scheme.name]
    yield say["asked"].format(
        scheme=escape(scheme.partition(";")[0]),
        ratio=words.say.found(float(compared.ratio)),
        symbol=compared.scheme.asked[0] + "_{" + compared.scheme.asked[2:].replace("_", "") + "}",
        within=number(100 * task.within),
        least=task.z_min,
        most=task.z_max,
        ring=task.ring_max,
    )
    yield say["found"].format(
        found="; ".join(f"k = {k}: {count}" for k, count in compared.found.items())
    )
    own, place = compared.own, compared.place
    facts = {
        "teeth": ", ".join(
            f"z_{{{label}}} = {z}"
            for label, z in zip(compared.scheme.wheels, own.teeth, strict=True)
        ),
        "k": compared.satellites,
        "size": number(float(own.size)),
        "error": words.say.number(f"{100 * float(own.error) + 0.0:.2f}"),
    }
    if place is None:
        yield say["outside"].format(**facts)
    elif place.place == 1:
        yield say["best"].format(**facts)
    else:
        yield say["chosen"].format(place=place.place, **facts)


def compared_table(compared: PlanetaryComparison, words: Language) -> Table:
    """Return the variants: planets, teeth, ratio, deviation, size; the file's with a star."""
    say, number = words.teeth["compared"], words.say.given
    first, *others = say["columns"]
    has_mm = compared.module_m is not None
    heads = [first, *(f"z_{{{label}}}" for label in compared.scheme.wheels), *others[:3]]
    rows = []
    for one in compared.variants:
        size = compared.diameter(one.chosen)
        star = " *" if one.is_own else ""
        row = [
            f"{one.satellites}{star}",
            *map(str, one.chosen.teeth),
            words.say.found(float(one.chosen.ratio)),
            words.say.number(f"{100 * float(one.chosen.error) + 0.0:.2f}"),
            number(float(one.chosen.size)),
        ]
        rows.append(row if size is None else [*row, number(size)])
    return table_of([*heads, *(others[3:] if has_mm else [])], rows, names=0)


def structure_document(problem: GearProblem, words: Language) -> Iterator[Node]:
    """Yield the structure of a train.

    Raises
    ------
    ProblemError
    """
    roles, _, structure = analyse(problem)
    yield from _structure(problem, roles, structure, words)


def _structure(
    problem: GearProblem, roles: Roles, found: Mobility, words: Language
) -> Iterator[Node]:
    say, train = words.gears, problem.train
    yield Title(say.title.format(title=escape(problem.title or problem.name)))
    yield Caption(say.structure)
    yield Paragraph(kind_of(found, words))
    yield Item(mobility(found, words, problem.sheet.notation) + say.of_equal)
    yield Item(say.by_meshes.format(rank=found.moving - found.mobility, w=found.mobility))
    yield Item(say.redundant.format(plane=found.redundant, space=found.spatial))
    for carrier in train.carriers:
        central, around = roles.central[carrier], roles.satellites[carrier]
        said = {"central": ", ".join(central) or "—", "satellites": ", ".join(around)}
        yield Item(say.carrier.format(carrier=carrier, **said))
    if found.kind is TrainKind.CLOSED:
        names = [mesh.name for mesh in train.meshes if train.carrier(mesh) is None]
        if names:
            yield Item(say.closing.format(meshes=", ".join(names)))


def kind_of(found: Mobility, words: Language) -> Rich:
    """Return the sentence on the kind of train."""
    return words.gears.kind.format(kind=words.gears["kinds"][found.kind.value])


def mobility(found: Mobility, words: Language, notation: str | None = None) -> Rich:
    """Return the mobility by Chebyshev's formula; ``notation`` is that of ``[sheet]``."""
    formula = str(found.formula).replace("-", MINUS)
    return words.gears.chebyshev.format(
        n=found.moving,
        low=found.lower,
        high=found.higher,
        w=formula,
        **pair_classes(notation, words),
    )


def fraction_text(value: Fraction | None) -> str:
    """Return a fraction, whole numbers without a denominator; a dash of none."""
    return "—" if value is None else str(value).replace("-", MINUS)


def plainly(rich: str) -> str:
    """Return rich text without the braces of its indices."""
    return rich.replace("{", "").replace("}", "")


def equation_of(motion: TrainMotion, mesh: Mesh) -> tuple[str, str]:
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
    # Pulleys are given by their radii in millimetres.
    per = Fraction(1) if train.counted(mesh.first) or not train.toothed else train.unit_m * 1000
    size = "" if mesh.kind is MeshKind.RACK else f"·{fraction_text(abs(row[other]) * per)}"
    left = f"{speed(mesh.first, one)}·{fraction_text(row[one] * per)}"
    hat = "" if mesh.carrier is None else f"^{{{mesh.carrier}}}"
    share = -row[other] / row[one]
    if mesh.kind is MeshKind.WORM or (mesh.kind is MeshKind.BEVEL and mesh.carrier is None):
        share = abs(share)  # axes that cross: it has no sign
    ratio = f"U{hat}_{{{mesh.first}-{mesh.second}}} = {fraction_text(share)}"
    return f"{left} = {sign}{speed(mesh.second, other)}{size}", ratio


def _wheels(motion: TrainMotion, words: Language) -> Table:
    train, say = motion.train, words.gears
    said = {"letter": "z" if train.toothed else "r, " + say["units"]["m"]}
    said["unit"] = say["units"]["m/2" if train.toothed else "m"]
    rows = []
    for label, size in motion.axes.sizes.items():
        height = motion.axes.heights.get(train.body_of[label])
        mark = "*" if label in train.unknown else ""
        shown = [_size(x, words) if x is not None else "—" for x in (size, height)]
        if train.toothed and not train.counted(label):
            mm = motion.axes.radii[label] * train.unit_m * 1000
            shown[0] = f"r = {_size(mm, words)} {say['units']['mm']}"
        rows.append([label + mark, *shown])
    return table_of([head.format(**said) for head in say["columns_wheels"]], rows)


def _size(value: Fraction, words: Language) -> Rich:
    if value.denominator == 1:
        return fraction_text(value)
    return words.say.found(float(value))


def _speeds(motion: TrainMotion, words: Language) -> Iterator[Node]:
    train, say = motion.train, words.gears
    said = {"letter": train.letter, "other": "ω" if train.letter == "n" else "n"}
    said["unit"], said["other_unit"] = (say["units"][unit] for unit in train.units)
    rows = []
    for label in train.numbers:
        body, speed = train.body_of[label], motion.speed(label)
        if body in train.racks:
            metres = rack_speed(motion, label)
            shown = "—" if metres is None else f"{words.say.found(metres)} {say['units']['m/s']}"
            rows.append([f"{label} ({say.rack})", shown, "—", "—", ""])
            continue
        relative = [
            say.relative.format(
                letter=said["letter"], carrier=c, value=fraction_text(motion.speed(label, c))
            )
            for c in train.carriers
            if body in (*motion.roles.central[c], *motion.roles.satellites[c])
        ]
        other = words.say.found(float(speed) * train.factor)
        value = words.say.found(float(speed))
        rows.append([label, value, fraction_text(speed), other, escape("; ".join(relative))])
    heads = [head.format(**said) for head in say["columns_speeds"]]
    if not train.carriers:
        heads, rows = heads[:-1], [row[:-1] for row in rows]
    yield table_of(heads, rows)
    for label in train.numbers:
        if train.body_of[label] in motion.roles.across:
            told = say.across if _is_carried(motion, train.body_of[label]) else say.crossing
            yield Item(told.format(label=label))


def _is_carried(motion: TrainMotion, body: str) -> bool:
    """Return whether a body meshes on a carrier."""
    train = motion.train
    return any(train.carrier(m) is not None and body in train.ends(m) for m in train.meshes)


def _tabular(motion: TrainMotion, turns: Turns, words: Language) -> Iterator[Node]:
    say, letter = words.gears, motion.train.letter
    yield Caption(say.tabular.format(carrier=turns.carrier, wheel=", ".join(turns.started)))
    total = {body: speed + turns.held[body] for body, speed in turns.together.items()}
    yield Table(
        ("", *total),
        tuple(
            (
                name.format(letter=letter, carrier=turns.carrier),
                *(fraction_text(part[body]) for body in total),
            )
            for name, part in zip(
                say["tabular_rows"], (turns.together, turns.held, total), strict=True
            )
        ),
        names=0,
        repeated=1,
    )


def _asked(motion: TrainMotion, words: Language) -> Iterator[Node]:
    say, rows, notes = words.gears, [], []
    for name in motion.train.ask:
        one = answer(motion, name)
        if one.value is None:
            reason = say["reasons"][one.reason].format(label=one.label)
            notes.append(Item(f"{escape(name)}: {reason}"))
            continue
        exact = "" if one.exact is None else fraction_text(one.exact)
        unit = say["units"][one.unit] if one.unit else ""
        whole = one.exact is not None and one.exact.denominator == 1
        rows.append([escape(name), exact if whole else words.say.found(one.value), exact, unit])
    if rows:
        yield table_of(say["columns_asked"], rows)
    yield from notes


def _picture(motion: TrainMotion, words: Language) -> Iterator[Node]:
    say, number, picture = words.gears, words.say.found, draw(motion)
    if picture is None:
        yield Item(say.no_picture)
        return
    name, per_mm = picture.ray_scale(motion.train.unit)
    pole = words.say.given(half_up(float(picture.pole_mm), 2))
    rays = say["sheet"]["inscriptions"][name].format(value=number(per_mm), pole=pole)
    mu_l, mu_v = number(float(picture.mu_l)), number(picture.mu_v)
    yield Item(say.scales.format(mu_l=mu_l, mu_v=mu_v, rays=rays))
    points = []
    for one in picture.contacts:
        shown = (number(float(mm)) for mm in (one.height_mm, one.speed_mm))
        points.append([say["points"][one.at.kind.value].format(name=one.at.of), *shown])
    yield table_of(say["columns_contacts"], points)
    segments = ((label, number(float(segment))) for label, segment in picture.rays)
    yield table_of(say["columns_rays"], segments)


def _published(problem: GearProblem, motion: TrainMotion, words: Language) -> Iterator[Node]:
    say, rows, notes = words.say, [], []
    for one in problem.published:
        exact, name = answer(motion, one.what).value, escape(one.name)
        percent = ComparedNumber(exact or 0.0, one.value).percent
        off = "" if percent is None else say.found(percent)
        printed = say.number(f"{one.value:g}")
        rows.append([name, printed, "—" if exact is None else say.found(exact), off])
        if one.note:
            notes.append(Item(f"{name}: {escape(one.note)}"))
    yield table_of(words.gears["columns_published"], rows)
    yield from notes


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


def tabular(motion: TrainMotion) -> tuple[Turns, ...]:
    """Make the tables of all carriers that may turn, and compare their sums with the speeds.

    Raises
    ------
    PlanMethodError
        A sum differs from the speed that the mesh equations give: an internal error.
    """
    return tuple(
        _table(motion, carrier)
        for carrier in motion.train.carriers
        if carrier not in motion.train.fixed
    )


def _table(motion: TrainMotion, carrier: str) -> Turns:
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


def _follow(motion: TrainMotion, carrier: str, held: dict[str, Fraction]) -> None:
    """Propagate the rotation through each mesh that has one end known already."""
    train = motion.train
    for mesh in train.meshes:
        if train.carrier(mesh) != carrier:
            continue
        row = mesh_row(train, motion.roles, motion.axes, mesh)
        for near, far in (train.ends(mesh), train.ends(mesh)[::-1]):
            if near in held and far not in held:
                held[far] = -held[near] * row[near] / row[far]
