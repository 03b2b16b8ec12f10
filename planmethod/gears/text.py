"""Documents on a solved train: structure, equations, speeds, velocities of contact points."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from planmethod.gears.coaxiality import derived_teeth
from planmethod.gears.comparison import PlanetaryComparison, compare
from planmethod.gears.derivation import derivation, find_stages
from planmethod.gears.model import GearProblem, Mesh, MeshKind, Roles
from planmethod.gears.motion import (
    Mobility,
    TabularMotion,
    TrainKind,
    TrainMotion,
    analyse,
    draw,
    mesh_row,
    solve_motion,
    tabular,
    why_not_drawn,
)
from planmethod.gears.solution import answer, checked, judgement, rack_speed
from planmethod.gears.velocities import by_velocities
from planmethod.note.compared import ComparedNumber, percent_text
from planmethod.note.document import Caption, Item, Node, Paragraph, Table, Title, table_of
from planmethod.note.formula import Rich, escape
from planmethod.note.narrate.statement import reading_notes
from planmethod.note.narrate.structure import pair_classes, spatial_sum
from planmethod.note.numbers import MINUS, half_up
from planmethod.note.wording import Language


def solved_document(problem: GearProblem, language: Language) -> Iterator[Node]:
    """Yield structure, equations, speeds, requested values, conditions, diagrams, printed values.

    Raises
    ------
    ProblemError
    """
    motion, texts = solve_motion(problem), language.gears
    structure = _structure(problem, motion.roles, motion.structure, language)
    yield next(structure)
    yield from reading_notes(problem, language)
    yield from structure
    yield from (Item(line) for line in stages_of(motion, language))
    if teeth := list(derived_teeth(motion, language)):
        yield Caption(texts["derived"]["coaxiality"]["title"])
        yield from (Item(line.text) for line in teeth)
    yield Caption(texts.equations)
    for mesh in motion.train.meshes:
        equation, stage = (escape(plainly(text)) for text in equation_of(motion, mesh))
        yield Item(texts.equation.format(name=mesh.name, equation=equation, stage=stage))
    if derived := [*derivation(motion, language), *by_velocities(motion, language)]:
        yield Caption(texts["derived"]["title"])
        yield from (Item(line.text) for line in derived)
    yield Caption(texts.wheels)
    yield _wheels(motion, language)
    yield Caption(texts.speeds)
    yield from _speeds(motion, language)
    for turns in tabular(motion):
        yield from _tabular(motion, turns, language)
    if motion.train.ask:
        yield Caption(texts.asked)
        yield from _requested_table(motion, language)
    judged = checked(motion)
    if judged:
        yield Caption(texts.checked)
    for one in judged:
        yield Item(escape(judgement(one, language)))
    compared = compare(problem, motion)
    if compared is not None:
        yield Caption(language.teeth["compared"]["title"])
        yield from (Paragraph(line) for line in compared_sentences(compared, language))
        yield compared_table(compared, language)
    yield Caption(texts.picture)
    yield from _diagram_tables(motion, language)
    if problem.published:
        yield Caption(texts.published)
        yield from _published(problem, motion, language)


def compared_sentences(compared: PlanetaryComparison, language: Language) -> Iterator[Rich]:
    """Yield the requirements, the number of sets, and the rank of the train of the file."""
    say, task, number = language.teeth["compared"], compared.task, language.notation.as_input
    scheme: str = language.teeth["schemes"][compared.scheme.name]
    yield say["asked"].format(
        scheme=escape(scheme.partition(";")[0]),
        ratio=language.notation.computed(float(compared.ratio)),
        symbol=compared.scheme.ratio_name[0]
        + "_{"
        + compared.scheme.ratio_name[2:].replace("_", "")
        + "}",
        within=number(100 * task.within),
        least=task.z_min,
        most=task.z_max,
        ring=task.ring_max,
    )
    yield say["found"].format(
        found="; ".join(f"k = {k}: {count}" for k, count in compared.set_counts.items())
    )
    own, place = compared.file_set, compared.place
    facts = {
        "teeth": ", ".join(
            f"z_{{{label}}} = {z}"
            for label, z in zip(compared.scheme.wheels, own.teeth, strict=True)
        ),
        "k": compared.planets,
        "size": number(float(own.size)),
        "error": language.notation.number(percent_text(100 * float(own.error), 2)),
    }
    if place is None:
        yield say["outside"].format(**facts)
    elif place.place == 1:
        yield say["best"].format(**facts)
    else:
        yield say["chosen"].format(place=place.place, **facts)


def compared_table(compared: PlanetaryComparison, language: Language) -> Table:
    """Return the variants: planets, teeth, ratio, deviation, size; the file's with a star."""
    say, number = language.teeth["compared"], language.notation.as_input
    first, *others = say["columns"]
    has_mm = compared.module_m is not None
    heads = [first, *(f"z_{{{label}}}" for label in compared.scheme.wheels), *others[:3]]
    rows = []
    for one in compared.variants:
        size = compared.diameter(one.chosen)
        star = " *" if one.is_file_train else ""
        row = [
            f"{one.planets}{star}",
            *map(str, one.chosen.teeth),
            language.notation.computed(float(one.chosen.ratio)),
            language.notation.number(percent_text(100 * float(one.chosen.error), 2)),
            number(float(one.chosen.size)),
        ]
        rows.append(row if size is None else [*row, number(size)])
    return table_of([*heads, *(others[3:] if has_mm else [])], rows, names=0)


def structure_document(problem: GearProblem, language: Language) -> Iterator[Node]:
    """Yield the structure of a train.

    Raises
    ------
    ProblemError
    """
    roles, _, structure = analyse(problem)
    yield from _structure(problem, roles, structure, language)


def _structure(
    problem: GearProblem, roles: Roles, mobility_data: Mobility, language: Language
) -> Iterator[Node]:
    texts, train = language.gears, problem.train
    yield Title(texts.title.format(title=escape(problem.title or problem.name)))
    yield Caption(texts.structure)
    yield Paragraph(kind_of(mobility_data, language))
    yield Item(mobility(mobility_data, language, problem.sheet.notation) + texts.of_equal)
    yield Item(
        texts.by_meshes.format(
            rank=mobility_data.moving - mobility_data.mobility, w=mobility_data.mobility
        )
    )
    redundant = texts.redundant_in_space if mobility_data.is_spatial else texts.redundant
    yield Item(redundant.format(plane=mobility_data.redundant, space=mobility_data.spatial))
    for carrier in train.carriers:
        yield Item(carrier_text(carrier, roles, language))
    if mobility_data.kind is TrainKind.CLOSED:
        names = [mesh.name for mesh in train.meshes if train.carrier(mesh) is None]
        if names:
            yield Item(texts.closing.format(meshes=", ".join(names)))


def carrier_text(carrier: str, roles: Roles, language: Language) -> Rich:
    """Return a carrier with its central wheels and its planets."""
    return language.gears.carrier.format(
        carrier=carrier,
        central=", ".join(roles.central[carrier]) or "—",
        satellites=", ".join(roles.planets[carrier]),
    )


def kind_of(structure: Mobility, language: Language) -> Rich:
    """Return the sentence on the kind of train."""
    return language.gears.kind.format(kind=language.gears["kinds"][structure.kind.value])


def stages_of(motion: TrainMotion, language: Language, *, in_short: bool = False) -> list[Rich]:
    """Return the sentence on the stages of a train, if they follow one another.

    ``in_short`` gives only their number if none is planetary.
    """
    stages, texts = find_stages(motion), language.gears["stages"]
    if not stages:
        return []
    count, carriers = len(stages), motion.train.carriers
    names: list[str] = texts["adjectives"]
    adjective = names[count - 1] if count <= len(names) else texts["many"].format(count=count)
    told, is_planetary = [], any(stage.lines for stage in stages)
    for k, stage in enumerate(stages):
        ends = [
            texts[to + ("carrier" if stage.lines and label in carriers else "wheel")].format(
                label=label
            )
            for label, to in zip(stage.labels, ("", "to_"), strict=True)
        ]
        ordinal = texts["ordinals"][k] if k < len(names) else str(k + 1)
        kind = texts["planetary" if stage.lines else "ordinary"] if is_planetary else ""
        form = texts["stage" if count > 1 else "only"]
        told.append(form.format(ordinal=ordinal, kind=kind, one=ends[0], other=ends[1]))
    head = texts["count"].format(links=count + 1, count=count)
    if in_short and not is_planetary:
        return [head]
    return [texts["named"].format(head=head, adjective=adjective, stages="; ".join(told))]


def mobility(structure: Mobility, language: Language, pair_notation: str | None = None) -> Rich:
    """Return the mobility: by Chebyshev's formula, of trains in space by Somov's and Malyshev's.

    ``pair_notation`` is that of ``[sheet]``.
    """
    formula = str(structure.formula).replace("-", MINUS)
    if structure.is_spatial:
        pairs = {1: structure.lower, 5: structure.higher}
        letters, numbers = spatial_sum(structure.moving, pairs, pair_notation)
        return language.gears.somov.format(letters=letters, numbers=numbers, w=formula)
    return language.gears.chebyshev.format(
        n=structure.moving,
        low=structure.lower,
        high=structure.higher,
        w=formula,
        **pair_classes(pair_notation, language),
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
        if mesh.carrier is None or body in motion.roles.transverse:
            return f"{train.letter}_{{{label}}}"
        return f"({train.letter}_{{{label}}} − {train.letter}_{{{mesh.carrier}}})"

    sign = MINUS if row[other] > 0 else ""
    # Beside teeth, pulleys are given by their radii in millimetres.
    per = Fraction(1) if train.counted(mesh.first) else train.unit_m * 1000
    per = per if train.toothed else train.per_m
    size = "" if mesh.kind is MeshKind.RACK else f"·{fraction_text(abs(row[other]) * per)}"
    left = f"{speed(mesh.first, one)}·{fraction_text(row[one] * per)}"
    hat = "" if mesh.carrier is None else f"^{{{mesh.carrier}}}"
    share = -row[other] / row[one]
    if mesh.kind is MeshKind.WORM or (mesh.kind is MeshKind.BEVEL and mesh.carrier is None):
        share = abs(share)  # axes that cross: it has no sign
    ratio = f"U{hat}_{{{mesh.first}-{mesh.second}}} = {fraction_text(share)}"
    return f"{left} = {sign}{speed(mesh.second, other)}{size}", ratio


def _wheels(motion: TrainMotion, language: Language) -> Table:
    train, texts = motion.train, language.gears
    said = {"letter": "z" if train.toothed else "r, " + texts["units"][train.length_unit]}
    said["unit"] = texts["units"]["m/2" if train.toothed else train.length_unit]
    per = Fraction(1) if train.toothed else train.per_m
    rows = []
    for label, size in motion.axes.sizes.items():
        height = motion.axes.heights.get(train.body_of[label])
        mark = "*" if label in train.unknown else ""
        shown = [_size(x * per, language) if x is not None else "—" for x in (size, height)]
        if train.toothed and not train.counted(label):
            mm = motion.axes.radii[label] * train.unit_m * 1000
            shown[0] = f"r = {_size(mm, language)} {texts['units']['mm']}"
        rows.append([label + mark, *shown])
    return table_of([head.format(**said) for head in texts["columns_wheels"]], rows)


def _size(value: Fraction, language: Language) -> Rich:
    if value.denominator == 1:
        return fraction_text(value)
    return language.notation.computed(float(value))


def _speeds(motion: TrainMotion, language: Language) -> Iterator[Node]:
    train, texts = motion.train, language.gears
    said = {"letter": train.letter, "other": "ω" if train.letter == "n" else "n"}
    said["unit"], said["other_unit"] = (texts["units"][unit] for unit in train.units)
    rows = []
    for label in train.numbers:
        body, speed = train.body_of[label], motion.speed(label)
        if body in train.racks:
            metres = rack_speed(motion, label)
            shown = (
                "—"
                if metres is None
                else f"{language.notation.computed(metres)} {texts['units']['m/s']}"
            )
            rows.append([f"{label} ({texts.rack})", shown, "—", "—", ""])
            continue
        relative = [
            texts.relative.format(
                letter=said["letter"], carrier=c, value=fraction_text(motion.speed(label, c))
            )
            for c in train.carriers
            if body in (*motion.roles.central[c], *motion.roles.planets[c])
        ]
        other = language.notation.computed(float(speed) * train.factor)
        value = language.notation.computed(float(speed))
        rows.append([label, value, fraction_text(speed), other, escape("; ".join(relative))])
    heads = [head.format(**said) for head in texts["columns_speeds"]]
    if not train.carriers:
        heads, rows = heads[:-1], [row[:-1] for row in rows]
    yield table_of(heads, rows)
    for label in train.numbers:
        if train.body_of[label] in motion.roles.transverse:
            text = texts.across if _has_carrier(motion, train.body_of[label]) else texts.crossing
            yield Item(text.format(label=label))


def _has_carrier(motion: TrainMotion, body: str) -> bool:
    """Return whether a body meshes on a carrier."""
    train = motion.train
    return any(train.carrier(m) is not None and body in train.ends(m) for m in train.meshes)


def _tabular(motion: TrainMotion, turns: TabularMotion, language: Language) -> Iterator[Node]:
    texts, letter = language.gears, motion.train.letter
    yield Caption(texts.tabular.format(carrier=turns.carrier, wheel=", ".join(turns.started)))
    total = {body: speed + turns.held_speeds[body] for body, speed in turns.locked_speeds.items()}
    yield Table(
        ("", *total),
        tuple(
            (
                name.format(letter=letter, carrier=turns.carrier),
                *(fraction_text(part[body]) for body in total),
            )
            for name, part in zip(
                texts["tabular_rows"], (turns.locked_speeds, turns.held_speeds, total), strict=True
            )
        ),
        names=0,
        repeated=1,
    )


def _requested_table(motion: TrainMotion, language: Language) -> Iterator[Node]:
    texts, rows, notes = language.gears, [], []
    for name in motion.train.ask:
        one = answer(motion, name)
        if one.value is None:
            reason = texts["reasons"][one.reason].format(label=one.label)
            notes.append(Item(f"{escape(name)}: {reason}"))
            continue
        exact = "" if one.exact is None else fraction_text(one.exact)
        unit = texts["units"][one.unit] if one.unit else ""
        whole = one.exact is not None and one.exact.denominator == 1
        rows.append(
            [escape(name), exact if whole else language.notation.computed(one.value), exact, unit]
        )
    if rows:
        yield table_of(texts["columns_asked"], rows)
    yield from notes


def no_diagrams(motion: TrainMotion, language: Language) -> str:
    """Return the sentence on why a train has no diagrams."""
    return str(language.gears["no_picture"][why_not_drawn(motion)])


def _diagram_tables(motion: TrainMotion, language: Language) -> Iterator[Node]:
    texts, number, picture = language.gears, language.notation.computed, draw(motion)
    if picture is None:
        yield Item(no_diagrams(motion, language))
        return
    name, per_mm = picture.ray_scale(motion.train.unit)
    pole = language.notation.as_input(half_up(float(picture.pole_mm), 2))
    rays = texts["sheet"]["inscriptions"][name].format(value=number(per_mm), pole=pole)
    mu_l, mu_v = number(float(picture.mu_l)), number(picture.mu_v)
    yield Item(texts.scales.format(mu_l=mu_l, mu_v=mu_v, rays=rays))
    points = []
    for one in picture.contacts:
        shown = (number(float(mm)) for mm in (one.height_mm, one.speed_mm))
        points.append([texts["points"][one.at.kind.value].format(name=one.at.of), *shown])
    yield table_of(texts["columns_contacts"], points)
    segments = ((label, number(float(segment))) for label, segment in picture.rays)
    yield table_of(texts["columns_rays"], segments)


def _published(problem: GearProblem, motion: TrainMotion, language: Language) -> Iterator[Node]:
    notation, rows, notes = language.notation, [], []
    for one in problem.published:
        exact, name = answer(motion, one.what).value, escape(one.name)
        percent = ComparedNumber(exact or 0.0, one.value).percent
        off = "" if percent is None else notation.computed(percent)
        printed = notation.number(f"{one.value:g}")
        rows.append([name, printed, "—" if exact is None else notation.computed(exact), off])
        if one.note:
            notes.append(Item(f"{name}: {escape(one.note)}"))
    yield table_of(language.gears["columns_published"], rows)
    yield from notes
