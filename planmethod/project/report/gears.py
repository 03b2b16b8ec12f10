"""The chapters on gears and on the cam, with their pictures (зубчатые механизмы, кулачок)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from fractions import Fraction
from itertools import dropwhile, groupby

import numpy as np
from msgspec.structs import replace

from planmethod.cams.construction import construct as construct_cam
from planmethod.cams.design import design_of
from planmethod.cams.model import CamProblem
from planmethod.cams.pictures import CamView, diagrams_picture, region_picture
from planmethod.cams.profilepicture import profile_picture
from planmethod.cams.results import construction_nodes
from planmethod.cams.sheet import sheet_scales
from planmethod.cams.text import given_facts
from planmethod.gears.coaxiality import derived_teeth
from planmethod.gears.comparison import compare
from planmethod.gears.construction import construct, read
from planmethod.gears.derivation import DerivationLine, by_speeds
from planmethod.gears.involute.cuttingpicture import cutting_picture, cutting_view
from planmethod.gears.involute.geometry import MeshingProblem
from planmethod.gears.involute.meshpicture import meshing_picture, view_for
from planmethod.gears.involute.results import (
    SolvedMeshing,
    cutting,
    given_facts as given_of_meshing,
    quality,
    table,
)
from planmethod.gears.model import GearProblem, Mesh, MeshKind, parse
from planmethod.gears.motion import TrainMotion, draw, mesh_row, solve_motion
from planmethod.gears.sheet import as_drawn, draw_views
from planmethod.gears.sheet_texts import indexed, measured_quantities, ratios, results, train_facts
from planmethod.gears.solution import answer, checked, conditions, judgement, sentence
from planmethod.gears.text import (
    carrier_text,
    compared_sentences,
    compared_table,
    equation_of,
    fraction_text,
    kind_of,
    mobility,
    stages_of,
)
from planmethod.moving.motion import PointProblem
from planmethod.moving.results import protocol_document as construct_point
from planmethod.moving.sheet import drawn_views
from planmethod.note.accounts.voice import chain, displayed, sentences
from planmethod.note.document import Caption, Chapter, Item, Node, Paragraph, Part, Table
from planmethod.note.formula import Rich, capitalized, fraction
from planmethod.note.narrate.structure import pair_classes
from planmethod.note.numbers import MINUS, raised
from planmethod.note.wording import MessageTable
from planmethod.project.parts import PartName
from planmethod.project.report.context import (
    NoteContext,
    PictureDrawer,
    figure,
    items,
    without_heading,
)
from planmethod.project.settle import meshed, output_of
from planmethod.render.layout.block import Block
from planmethod.render.sheets.composer import Sizes

FRACTION = 1
"""Column of the results that has them as fractions."""

TEXT_WIDTH = 185.0
"""Width of the texts of the sheet, mm."""

_FURTHER = {"meshing.b", "meshing.cutter", "meshing.s_a_min"}
"""Given data of a meshing except the wheels and the rack, which the first sentence has."""

MIN_SHOWN_DIFFERENCE = 0.005
"""Minimum difference of construction and calculation that a table shows, per cent."""


def train_chapter(report: NoteContext, problem: GearProblem) -> Iterator[Node]:
    """Yield the chapter on a gear train."""
    texts: MessageTable = report.texts["gears"]
    motion, language = as_drawn(problem, report.profile), report.language
    yield Chapter(texts.title.format())
    facts = train_facts(motion, language)
    fixed = facts[-1].text if motion.train.fixed else ""
    about = facts[: -1 if fixed else None]
    paragraph = sentences(
        texts.about.format(facts="; ".join(fact.text for fact in about)),
        f"{capitalized(fixed)}." if fixed else "",
        _module(report, motion, texts),
    )
    yield replace(paragraph, facts=tuple(facts))
    yield from _figures(report, problem, motion, "train")
    yield from _structure(report, problem, motion, texts)
    yield Part(texts.analysis.format())
    yield from _ratios(report, motion, texts)
    yield from _compared(report, problem, motion)
    yield Part(language.gears.picture)
    yield from _pictures(report, problem, motion, texts)


def _compared(report: NoteContext, problem: GearProblem, motion: TrainMotion) -> Iterator[Node]:
    """Yield the variants of a planetary train that was designed."""
    compared = compare(problem, motion)
    if compared is None:
        return
    title = report.language.teeth["compared"]["title"]
    yield Part(title)
    yield sentences(*compared_sentences(compared, report.language))
    told = compared_table(compared, report.language)
    yield Table(told.head, told.rows, name=title, key="train_variants")


def _module(report: NoteContext, motion: TrainMotion, texts: MessageTable) -> Rich:
    """Return the sentence on the module of the scheme, where the train has none."""
    train, ends = motion.train, wheels_of(report)
    if not train.toothed or draw(motion) is None:
        return ""
    if ends is not None and train.module is not None and train.wheels[ends[0]].module is None:
        return texts.module_mesh.format(one=ends[0], other=ends[1])
    return texts.module_assumed.format() if train.module is None else ""


def wheels_of(report: NoteContext) -> tuple[str, str] | None:
    """Return the wheels of the train that mesh in the meshing, its wheel 1 first; else None."""
    train, pair = (report.part(name) for name in (PartName.GEARS, PartName.MESHING))
    if train is None or pair is None:
        return None
    assert isinstance(train.problem, GearProblem) and isinstance(pair.problem, MeshingProblem)
    return meshed(train.problem.train, pair.problem)


def _structure(
    report: NoteContext, problem: GearProblem, motion: TrainMotion, texts: MessageTable
) -> Iterator[Node]:
    roles, language = motion.roles, report.language
    yield sentences(f"{kind_of(motion.structure, language)}.", texts.mobility)
    yield displayed(f"{mobility(motion.structure, language, problem.sheet.notation)},")
    carriers = [
        f"{carrier_text(carrier, roles, language)}."
        for carrier in motion.train.carriers
        if roles.central[carrier]
    ]
    classes = pair_classes(problem.sheet.notation, language)
    if motion.structure.is_spatial:
        classes = {"lower": "1", "higher": "5"}
        if problem.sheet.notation == "p5 p4":
            classes = {"lower": "5", "higher": "1"}
    where = texts.where.format(**classes)
    stages = [f"{text}." for text in stages_of(motion, language)]
    yield sentences(where, *carriers, *stages)
    yield from _derived(derived_teeth(motion, language))


def _ratios(report: NoteContext, motion: TrainMotion, texts: MessageTable) -> Iterator[Node]:
    train = motion.train
    yield sentences((texts.willis if train.carriers else texts.plain).format())
    for text in (willis(motion, mesh, report) for mesh in train.meshes):
        yield displayed(f"{text}.")
    derived = list(ratios(request_ratios(motion, report), report.language))
    if derived:
        yield sentences(texts.derived.format())
    yield from _derived(derived)
    yield sentences((texts.solved if train.fixed else texts.solved_plain).format())
    yield from chain(_speeds(motion, report))
    judged = checked(motion)
    if judged:
        form = "one" if len(judged) == 1 else "many"
        yield sentences(str(texts["conditions"][form]).format())
    yield from items(indexed(judgement(one, report.language)) for one in judged)


def willis(motion: TrainMotion, mesh: Mesh, report: NoteContext) -> Rich:
    """Return the ratio of a mesh seen from its carrier, by speeds and by teeth."""
    train = motion.train
    row = mesh_row(train, motion.roles, motion.axes, mesh)
    one, other = train.ends(mesh)
    if mesh.kind is MeshKind.RACK:
        return ", ".join(equation_of(motion, mesh))

    def speed(label: str, body: str) -> Rich:
        if mesh.carrier is None or body in motion.roles.transverse:
            return f"{train.letter}_{{{label}}}"
        return f"{train.letter}_{{{label}}} − {train.letter}_{{{mesh.carrier}}}"

    letters = [f"{'z' if train.counted(x) else 'r'}_{{{x}}}" for x in (mesh.second, mesh.first)]
    mm = Fraction(1) if train.counted(mesh.first) else train.unit_m * 1000
    mm = mm if train.toothed else train.per_m
    sizes = [fraction_text(abs(row[x]) * mm) for x in (other, one)]
    share = -row[other] / row[one]
    if mesh.kind is MeshKind.WORM or (mesh.kind is MeshKind.BEVEL and mesh.carrier is None):
        share = abs(share)  # axes that cross: it has no sign
    sign = MINUS if share < 0 else ""
    hat = "" if mesh.carrier is None else f"^{{({mesh.carrier})}}"
    ratio = fraction_text(share)
    speeds = fraction(speed(mesh.first, one), speed(mesh.second, other))
    found = f"{sign}{fraction(*letters)} = {sign}{fraction(*sizes)}"
    return f"U{hat}_{{{mesh.first}{mesh.second}}} = {speeds} = {found} = {ratio}"


def _derived(lines: Iterable[DerivationLine]) -> Iterator[Node]:
    """Yield a derivation: formulas in chains, sentences between them."""
    for is_formula, run in groupby(lines, lambda line: line.is_formula):
        if is_formula:
            yield from chain(line.text for line in run)
        else:
            yield from (sentences(f"{line.text}.") for line in run)


def request_ratios(motion: TrainMotion, report: NoteContext) -> TrainMotion:
    """Return a train with its requested ratios: those of the file, else input to output.

    For a train that drives the crank they include the overall ratio.
    """
    train, geared = motion.train, report.gear_drive
    ask = [one for one in train.ask if one.startswith("U")]
    more = [one for one in train.ask if one not in ask]
    if len(train.inputs) == 1:
        (source,) = train.inputs
        end = geared.label if geared is not None and not ask[1:] else output_of(motion)
        whole = f"U_{source}_{end}"
        if end is not None and end != source and (not ask or geared is not None):
            ask += [] if whole in ask else [whole]
    return replace(motion, train=replace(train, ask=(*ask, *more)))


def _speeds(motion: TrainMotion, report: NoteContext) -> Iterator[Rich]:
    """Yield the speeds of the bodies that are not given."""
    train, unit = motion.train, raised(report.language.gears["units"][motion.train.units[0]])
    for label in train.numbers:
        body = train.body_of[label]
        if body in train.inputs or body in train.fixed or body in train.racks:
            continue
        if label != body and label in train.body_of and train.body_of[label] != label:
            continue
        value = fraction_text(motion.speeds[body])
        yield f"{train.letter}_{{{label}}} = {value} {unit}"


def _pictures(
    report: NoteContext, problem: GearProblem, motion: TrainMotion, texts: MessageTable
) -> Iterator[Node]:
    picture, notation = draw(motion), report.notation
    if picture is None:
        drawn = seen = None
    else:
        drawn = construct(motion, picture)
        seen = read(drawn, report.profile)
        inscriptions: MessageTable = report.language.gears["sheet"]["inscriptions"]
        yield sentences(
            texts.picture.format(
                mu_l=inscriptions.mu_l.format(value=notation.short(float(picture.mu_l), 4)),
                mu_v=inscriptions.mu_v.format(value=notation.short(picture.mu_v, 4)),
            ),
            texts.angular.format(
                pole=f"{notation.as_input(float(picture.pole_mm))} {report.unit('mm')}",
                scale=inscriptions.mu_omega.format(
                    value=notation.short(picture.mu_omega, 4),
                    pole=notation.as_input(float(picture.pole_mm)),
                ).partition(", ")[0],
            ),
        )
        yield from _figures(report, problem, motion, "angular")
    rows = list(results(motion, drawn, seen, report.language))
    yield sentences(texts.speeds.format(), texts.signs.format())
    # The fraction of whole numbers has the same value as the decimal.
    fractions = any(fraction not in (exact, "—") for _, fraction, exact, *_ in rows)
    columns = report.language.gears["sheet"]["columns_results"]
    heads = columns if drawn is not None else columns[:3]
    shown = [k for k in range(len(heads)) if fractions or k != FRACTION]
    yield Table(
        tuple(heads[k] for k in shown),
        tuple(tuple(row[k] for k in shown) for row in rows),
        name=texts.results.format(),
        key="train_results",
    )
    if drawn is not None and seen is not None:
        every = measured_quantities(drawn, seen).values()
        offs = [one.percent_size for one in every if one.exact]
        if offs and max(offs) < MIN_SHOWN_DIFFERENCE:
            yield sentences(texts.same)
        elif offs:
            yield sentences(texts.agree.format(most=notation.number(f"{max(offs):.2f}")))


def _figures(
    report: NoteContext, problem: GearProblem, motion: TrainMotion, which: str
) -> Iterator[Node]:
    texts: MessageTable = report.texts["gears"]
    has_picture = draw(motion) is not None

    def draw_picture(letter: float) -> Block:
        sizes = Sizes(letter, letter, letter, TEXT_WIDTH)
        found = draw_views(motion, report.profile, report.language, sizes)
        return found[0] if which == "train" or found[1] is None else without_heading(found[1])

    captions = {
        "train": texts.figure if has_picture else texts.figure_scheme,
        "angular": report.language.gears["sheet"]["angular"],
    }
    yield figure(draw_picture, captions[which].format(), which, height=160.0)


def meshing_chapter(report: NoteContext, problem: MeshingProblem) -> Iterator[Node]:
    """Yield the chapter on two wheels in mesh."""
    said: MessageTable = report.texts["meshing"]
    solved, language = SolvedMeshing(problem), report.language
    say: MessageTable = language.meshing
    fields, ends = solved.fields(language.notation), wheels_of(report)
    yield Chapter(said.title.format())
    form = "internal" if problem.cutter else "helical" if problem.beta else "external"
    told = {name: text.strip("()") for name, text in fields.items()}  # in no product
    way = "given" if problem.aim is None else problem.aim.value
    way = "distance" if problem.a_w is not None else way
    facts = given_of_meshing(solved, language)
    about = sentences(
        str(said["about"][form]).format(rack=report.cited()["rack"], **told),
        said.wheels.format(one=ends[0], other=ends[1]) if ends is not None else "",
        str(said["shifts"][way]).format(**told),
        facts[-1].text if way == "distance" and problem.aim is not None else "",
        language.note.given.format(
            given="; ".join(x.text for x in facts if x.data.keys() & _FURTHER)
        ),
    )
    yield replace(about, facts=tuple(facts))
    lead, lines = "", list[Rich]()
    for key, formulas in groupby(solved.formulas(language), lambda one: one[0]):
        if key in say["steps"] or key in say["beside"]:
            yield from _led(lead, lines)
            lead, lines = "", []
        if key in say["steps"]:
            yield Part(say["steps"][key])
            if key == "x_min":
                yield sentences(*_undercut(solved, report, said))
            lead = str(said["steps"][key]).format()
        if key in say["beside"]:
            beside = say["beside"][key].format(**told), str(said["beside"][key]).format()
            lead = " ".join(filter(None, (lead, *beside)))
        lines += [formula for _, formula in formulas]
    yield from _led(lead, lines)
    yield Part(said.table.format())
    yield sentences(said.table_text.format())
    pair, wheels, contact = solved.sized_quantities()
    heads: tuple[str, ...] = say["columns"]
    whole = table([*pair, *contact], language, (*heads[:2], say.pair))
    yield Table(whole.head, whole.rows, 2, name=said.table_pair.format(), key="meshing")
    own = table(wheels, language, heads)
    yield Table(own.head, own.rows, 2, name=said.table_wheels.format(), key="wheels")
    yield sentences(said.quality.format(facts="; ".join(quality(solved, language))))
    yield figure(
        lambda letter: meshing_picture(view_for(solved, 300.0, 240.0), language, letter),
        said.figure.format(),
        "meshing_picture",
    )
    pinion = solved.cuttings[0]
    assert pinion is not None  # only wheel 2 may be a ring
    yield sentences(said.cutting_text.format(), *cutting(solved, language))
    yield figure(
        lambda letter: cutting_picture(cutting_view(pinion, 260.0, 200.0), language, letter),
        said.cutting_figure.format(),
        "cutting_picture",
    )


def _led(lead: Rich, lines: list[Rich]) -> Iterator[Node]:
    """Yield a sentence and the formulas that it leads to."""
    if lead:
        yield sentences(lead)
    yield from chain(lines)


def _undercut(solved: SolvedMeshing, report: NoteContext, texts: MessageTable) -> Iterator[Rich]:
    """Yield the effect of the shift of every wheel that the rack would undercut unshifted."""
    least = solved.pair.x_min
    for k, (count, shift) in enumerate(zip(solved.problem.z, solved.problem.x, strict=True)):
        bound = float(least[k])
        if not np.isfinite(bound) or bound <= 0.0 or (k and solved.problem.cutter):
            continue
        form = "avoided" if shift >= bound else "stays"
        yield str(texts["is_undercut"][form]).format(
            wheel=k + 1,
            z=count,
            x=report.notation.number(f"{shift:.2f}"),
            x_min=report.notation.number(f"{bound:.2f}"),
        )


def failed_quality(problem: MeshingProblem, report: NoteContext) -> list[Rich]:
    """Return the limits of a meshing that its shifts do not keep."""
    return [
        text for _, holds, text in SolvedMeshing(problem).sentences(report.language) if not holds
    ]


def failed_conditions(problem: GearProblem, report: NoteContext) -> list[Rich]:
    """Return the conditions of the numbers of teeth that do not hold."""
    judged = (one for one in conditions(solve_motion(problem)) if not one.is_satisfied)
    told = (indexed(sentence(one, report.language)) for one in judged)
    return [f"{text[:1].lower()}{text[1:]}" for text in told]


def ratios_of(problem: GearProblem, report: NoteContext) -> list[Rich]:
    """Return the requested ratios and that of the whole train, with their symbols."""
    motion = request_ratios(solve_motion(problem), report)
    known = tuple(motion.train.body_of)
    asked = [parse(name, known) for name in motion.train.ask if answer(motion, name).value]
    return [by_speeds(motion, one, report.language) for one in asked if one.kind == "U"]


def cam_chapter(report: NoteContext, problem: CamProblem) -> Iterator[Node]:
    """Yield the chapter on the cam."""
    said, language = report.texts["cam"], report.language
    design = design_of(problem)
    built = construct_cam(design, sheet_scales(problem))
    yield Chapter(said.title.format())
    facts = given_facts(problem, language)
    about = sentences(said.about.format(facts="; ".join(fact.text for fact in facts)))
    yield replace(about, facts=tuple(facts))
    captions: dict[str, str] = said["figures"]
    names: dict[str, str] = said["tables"]
    keys = iter(_keys(bool(built.results)))

    def drawn(build: Callable[[CamView], Block | None]) -> Callable[[float], Block]:
        def draw(letter: float) -> Block:
            picture = build(CamView(built, language, letter))
            assert picture is not None
            return picture

        return draw

    pictures = {"diagrams": diagrams_picture, "region": region_picture, "profile": profile_picture}
    figures = iter([name for name in pictures if name != "region" or built.results])
    for node in construction_nodes(built, language, report.profile):
        match node:
            case Chapter(title):
                yield Part(title)
                name = next(figures, None)
                if name is not None:
                    yield sentences(said.shown.format(key=f"cam_{name}"))
                    yield figure(drawn(pictures[name]), captions[name], f"cam_{name}", height=200.0)
            case Table():
                name = next(keys)
                yield sentences(said.table_text.format(key=f"cam_table_{name}"))
                yield Table(
                    node.head, node.rows, node.names, name=names[name], key=f"cam_table_{name}"
                )  # fmt: skip
            case Caption():
                pass  # the table has a name
            case Item(text):
                yield sentences(f"{capitalized(text)}.")
            case Paragraph(text):
                yield sentences(text)
            case _:
                yield node


def _keys(has_region: bool) -> list[str]:
    """Return the names of the tables of a construction, in their order."""
    keys = ["ordinates", "region", "radii", "sizes", "positions"]
    return keys if has_region else [key for key in keys if key != "region"]


def point_chapter(report: NoteContext, problem: PointProblem) -> Iterator[Node]:
    """Yield the chapter on a moving point: its curves, then what its protocol constructs."""
    language = report.language
    yield Chapter(language.point.chapter)
    for key, caption, picture in drawn_views(problem, report.profile, language):
        yield figure(_constantly(picture), caption, key, height=150.0)
    nodes = construct_point(problem, language, report.profile)
    # The title page and the assignment have title, source and data.
    for node in dropwhile(lambda node: node != Paragraph(language.point.wanted), nodes):
        yield Part(node.title) if isinstance(node, Chapter) else node


def _constantly(picture: Block) -> PictureDrawer:
    """Return a drawer of a picture whose letters keep their height."""
    return lambda _: picture
