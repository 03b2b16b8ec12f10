"""Read a problem of a gear train: every fault at once (чтение файла задачи)."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from functools import partial
from pathlib import Path

from planmethod.errors import ProblemError
from planmethod.gears.meshes import (
    TrainDraft,
    check_meshes,
    find_carriers,
    fraction,
    read_key_label,
    read_label,
    read_labels,
    read_meshes,
    read_wheels,
)
from planmethod.gears.model import (
    DiagramSettings,
    GearProblem,
    RequestedQuantityError,
    Train,
    parse,
)
from planmethod.languages import translate
from planmethod.problem import keys
from planmethod.problem.answers import ComputedAnswerNames, read_answers, read_published
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.names import fold, is_label
from planmethod.problem.reader import varied
from planmethod.problem.records import Published
from planmethod.problem.sheet import read_head
from planmethod.problem.tables import PictureSection, PlanetaryTask

ASK_LIMIT = 100
TURNS = ("n", "omega")
_NAMES = "For example: W, U_1_5, U_1_4^H, n_5, omega_H, z_5, a_w_1_2."
GROUP_LIMIT = 60
TOP = (
    "title",
    "source",
    "units",
    *keys.READING,
    "stamp",
    "sheet",
    "published",
    "answers",
    "compare",
    "variants",
    "gears",
)
"""Tables of the file that a gear train may have."""

SHARED = ("title", "source", "units", "stamp", "sheet", "variants", "gears")
"""Tables that are read of the file of a linkage, whose project has a train."""


def load(path: str | Path, *, variant: str | None = None) -> GearProblem:
    """Read a file with ``[gears]``; of one with a linkage, too, that table and the title block.

    Raises
    ------
    ProblemError
        With every fault of the file: path, what was expected, what was found, the next action.
    """
    path = Path(path)
    file, variants = varied(path, variant)
    if "links" in file:
        file = file.with_value({key: file.value[key] for key in file.value if key in SHARED})
    file.allow(TOP)
    head = read_head(file)
    train = file.get("gears", {}).attempt(read_train)
    published = file.read("published", partial(_read_published, train=train)) or ()
    answers = read_answers(file, _scene(train))
    if file.faults or train is None:
        raise ProblemError(str(path), file.faults.listed)
    return GearProblem(
        name=path.stem, source_file=str(path), variants=variants, variant=variant, train=train,
        **head, published=published, answers=answers,
    )  # fmt: skip


def read_train(node: FileNode) -> Train:
    """Read the table ``[gears]``."""
    node.table("wheels = { 1 = 20, 2 = 36 }")
    node.allow(keys.GEARS)
    draft = TrainDraft(*_read_module(node))
    for key, example in (("wheels", "{ 1 = 20, 2 = 36 }"), ("meshes", "[{ of = [1, 2] }]")):
        if key not in node:
            node[key].note("missing", hint=translate("For example: {} = {}", key, example))
    unknown = node.read("unknown", partial(read_labels, limit=GROUP_LIMIT)) or ()
    carriers = find_carriers(node["meshes"].value, node["bodies"].value)
    read = partial(read_wheels, unknown=unknown, draft=draft, carriers=carriers)
    node.get("wheels", {}).attempt(read)
    meshes = node.get("meshes", []).attempt(partial(read_meshes, draft=draft))
    if meshes is not None:
        check_meshes(node, meshes, draft)
    meshes = meshes or ()
    draft.names = _further_names(node["bodies"].value)
    known = draft.labels()
    groups = node.read("bodies", partial(_read_groups, known=known)) or ()
    coaxial = node.read("coaxial", partial(_read_groups, known=known)) or ()
    body_of = draft.merge_labels(groups)
    fixed = node.read("fixed", partial(read_labels, limit=GROUP_LIMIT, known=known)) or ()
    unit, inputs = _read_inputs(node, known)
    for label in fixed:
        if body_of.get(label) in {body_of.get(name) for name, speed in inputs.items() if speed}:
            node["fixed"].note("{} is fixed, but its speed is given", label)
    satellites = node.read("satellites", partial(_read_planets, draft=draft)) or {}
    output = node.read("output", partial(read_label, known=known))
    for what, held in (("fixed", fixed), ("an input", tuple(inputs))):
        if output is not None and body_of[output] in {body_of[label] for label in held}:
            node["output"].note("{} is {}: no power can be taken from it", output, what)
    picture = node.read("picture", _read_picture) or DiagramSettings()
    design = node.read("design", _read_design)
    ask = node.read("ask", partial(_read_ask, known=known)) or ()
    if any(mesh.eta is not None for mesh in meshes) and "eta" not in ask:
        ask = (*ask, "eta")  # use the given efficiencies, or report why not
    node.require_sound()
    speeds: dict[str, Fraction] = {}
    for label, speed in inputs.items():
        if speeds.setdefault(body_of[label], speed) != speed:
            node[unit].note("{} has another speed than its own body", label)
    return Train(
        wheels=draft.wheels,
        meshes=meshes,
        body_of=body_of,
        bodies=tuple(dict.fromkeys(body_of.values())),
        carriers=tuple(dict.fromkeys(body_of[c] for c in draft.carriers)),
        racks=frozenset(body_of[rack] for rack in draft.racks),
        fixed=frozenset(body_of[label] for label in fixed),
        inputs=speeds,
        unit=unit,
        module=draft.module,
        toothed=draft.toothed,
        unknown=unknown,
        listed=tuple(draft.listed),
        arms=draft.arms,
        coaxial=tuple(tuple(body_of[label] for label in group) for group in coaxial),
        planets={body_of[c]: k for c, k in satellites.items()},
        output=None if output is None else body_of[output],
        ask=ask,
        picture=picture,
        design=design,
        length_unit=node.faults.unit,
    )


def _read_module(node: FileNode) -> tuple[Fraction | None, dict[str, Fraction]]:
    """Read ``module``: that of all wheels, or of rows by their meshes, m."""

    def read(module: FileNode) -> Fraction:
        return fraction(module.number("a module in mm", 0.01, 1000)) / 1000

    if isinstance(node["module"].value, Mapping):
        return None, node["module"].read_each(read)
    return node.read("module", read), {}


def _further_names(value: object) -> list[str]:
    """Return letters that only ``bodies`` has: a shaft or a carrier with a name of its own."""
    groups = (
        [group for group in value if isinstance(group, list)] if isinstance(value, list) else []
    )
    names = [name for group in groups[:GROUP_LIMIT] for name in group[:GROUP_LIMIT]]
    kept = [fold(name) for name in names if isinstance(name, str) and is_label(fold(name))]
    return [name for name in dict.fromkeys(kept) if name[0].isalpha()]


def _read_groups(node: FileNode, known: tuple[str, ...]) -> tuple[tuple[str, ...], ...]:
    node.array("a list of lists", '[["3", "H"]]', high=GROUP_LIMIT)
    if node.value and not any(isinstance(group, list) for group in node.value):
        written = ", ".join(f'"{label}"' for label in node.value)
        hint = translate("Write {} = [[{}]].", node.key, written)
        node.reject("expected a list of lists, got one list of labels", hint=hint)
    return node.read_sound(partial(read_labels, limit=GROUP_LIMIT, known=known))


_SPEEDS = {"n": "a rotational speed in rev/min", "omega": "an angular velocity in 1/s"}


def _read_inputs(node: FileNode, known: tuple[str, ...]) -> tuple[str, dict[str, Fraction]]:
    if "n" in node and "omega" in node:
        node["omega"].note("n and omega are both given", hint="Keep one of them.")
    unit = "omega" if "omega" in node else "n"

    def read_speed(speed: FileNode) -> tuple[str, Fraction]:
        label = speed.attempt(partial(read_key_label, known=known))
        number = speed.number(_SPEEDS[unit], -1e6, 1e6)
        return needed(label), fraction(number)

    def read_speeds(speeds: FileNode) -> dict[str, Fraction]:
        speeds.table("n = { 1 = 2400 }")
        return dict(speeds.read_each(read_speed).values())

    return unit, node.read(unit, read_speeds) or {}


def _read_planets(node: FileNode, draft: TrainDraft) -> dict[str, int]:
    """Read the number of planets: one for every carrier, or by carrier."""
    carriers = tuple(draft.carriers)

    def read_count(count: FileNode) -> tuple[str, int]:
        label = count.attempt(partial(read_key_label, known=carriers))
        number = count.integer(1, 100)
        return needed(label), number

    if not isinstance(node.value, Mapping):
        return dict.fromkeys(carriers, node.integer(1, 100))
    return dict(node.read_each(read_count).values())


def _read_picture(node: FileNode) -> DiagramSettings:
    node.table("picture = { pole_mm = 40 }")
    found = node.record(PictureSection)
    values = {key: fraction(value) for key, value in found.items()}
    return DiagramSettings(**values, file_keys=frozenset(values))


def _read_design(node: FileNode) -> PlanetaryTask:
    node.table("design = { U = 6.5, k_min = 3, k_max = 5 }")
    design = PlanetaryTask(**node.record(PlanetaryTask))
    if design.U == 0:
        node["U"].note("the ratio is 0", hint="Omit it, or give another one.")
    for low, high in (("z_min", "z_max"), ("k_min", "k_max")):
        least, most = getattr(design, low), getattr(design, high)
        if least > most:
            message = "{} = {} is more than {} = {}"
            node[low].note(message, low, least, high, most, hint="Exchange them.")
    return design


def _read_ask(node: FileNode, known: tuple[str, ...]) -> tuple[str, ...]:
    def read_name(name: FileNode) -> str:
        return _requestable(name, name.text(80), known)

    node.array("a list of names", '["U_1_5", "n_5"]', high=ASK_LIMIT)
    return node.read_sound(read_name)


def _requestable(node: FileNode, name: str, known: tuple[str, ...]) -> str:
    """Return the name of a quantity that can be requested of a train."""
    phrase = _fault_of(name, known)
    if phrase:
        node.reject(phrase, hint=_NAMES)
    return name


def _fault_of(text: str, known: tuple[str, ...]) -> str:
    try:
        parse(text, known)
    except RequestedQuantityError as error:
        return str(error)
    return ""


def _scene(train: Train | None) -> ComputedAnswerNames:
    """Return the names that answers may use; any name where the train is faulty itself."""
    if train is None:
        return ComputedAnswerNames(lambda name: "", lambda name: False, _NAMES)
    known = tuple(train.body_of)
    return ComputedAnswerNames(
        lambda n: _fault_of(n, known), lambda n: parse(n, known).kind in TURNS, _NAMES
    )


def _read_published(node: FileNode, train: Train | None) -> tuple[Published, ...]:
    """Read the values that the source prints; ``what`` is a name that can be requested."""

    def check(quantity: FileNode, name: str) -> str:
        text = quantity.value or name
        return text if train is None else _requestable(quantity, text, tuple(train.body_of))

    example = 'value = -375, what = "n_5"'
    return read_published(node, check, example=example, without=("per_mm", "position"))
