"""Read a problem of a gear train: every fault at once (чтение файла задачи)."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path
from typing import Any

from planmethod.errors import ProblemError
from planmethod.gears.meshes import (
    TrainDraft,
    find_carriers,
    fraction,
    read_label,
    read_labels,
    read_meshes,
    read_wheels,
)
from planmethod.gears.model import DiagramSettings, GearProblem, Train
from planmethod.gears.requested_quantities import RequestedQuantityError, parse
from planmethod.languages import translate
from planmethod.problem import fields, keys
from planmethod.problem.answers import ComputedAnswerNames, read_answers
from planmethod.problem.common import Published
from planmethod.problem.fields import Faults
from planmethod.problem.flat_tables import read_flat
from planmethod.problem.names import fold, is_label, joined, segment
from planmethod.problem.reader import varied
from planmethod.problem.selector import read_published
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
    table, variants, faults = varied(path, variant)
    if "links" in table:
        table = {key: value for key, value in table.items() if key in SHARED}
    given = fields.read_keys(faults, "", table, TOP)
    head = read_head(faults, given)
    body = fields.read_table(faults, "gears", given.get("gears", {}), "wheels = { 1 = 20, 2 = 36 }")
    train = None if body is None else read_train(faults, body)
    published = _read_published(faults, given.get("published", {}), train)
    answers = read_answers(faults, given, _scene(train))
    if faults or train is None:
        raise ProblemError(str(path), faults.listed)
    return GearProblem(
        name=path.stem, source_file=str(path), variants=variants, variant=variant, train=train,
        **head, published=published, answers=answers,
    )  # fmt: skip


def read_train(faults: Faults, table: Mapping[str, Any]) -> Train | None:
    """Read the table ``[gears]``; None where it has faults."""
    before = len(faults)
    given = fields.read_keys(faults, "gears", table, keys.GEARS)
    module, modules = _read_module(faults, given)
    draft = TrainDraft(module, modules)
    for key, example in (("wheels", "{ 1 = 20, 2 = 36 }"), ("meshes", "[{ of = [1, 2] }]")):
        if key not in given:
            faults.add(f"gears.{key}", "missing", translate("For example: {} = {}", key, example))
    unknown = read_labels(faults, "gears.unknown", given.get("unknown", []), GROUP_LIMIT)
    carriers = find_carriers(given.get("meshes"), given.get("bodies"))
    read_wheels(faults, given.get("wheels", {}), unknown, draft, carriers)
    meshes = read_meshes(faults, given.get("meshes", []), draft)
    told_bodies = given.get("bodies", [])
    draft.names = _further_names(told_bodies)
    known = draft.labels()
    groups = _read_groups(faults, "gears.bodies", told_bodies, known)
    coaxial = _read_groups(faults, "gears.coaxial", given.get("coaxial", []), known)
    body_of = draft.merge_labels(groups)
    fixed = _known(faults, "gears.fixed", given.get("fixed", []), known)
    unit, inputs = _read_inputs(faults, given, known)
    for label in fixed:
        if body_of.get(label) in {body_of.get(name) for name, speed in inputs.items() if speed}:
            faults.add("gears.fixed", translate("{} is fixed, and a speed of it is given", label))
    satellites = _read_planets(faults, given.get("satellites", {}), draft)
    output = None
    if "output" in given:
        output = read_label(faults, "gears.output", given["output"], known)
        for what, held in (("fixed", fixed), ("an input", tuple(inputs))):
            if output is not None and body_of[output] in {body_of[label] for label in held}:
                faults.add(
                    "gears.output", translate("{} is {}, no power comes out of it", output, what)
                )
    picture = _read_picture(faults, given.get("picture", {}))
    design = _read_design(faults, given["design"]) if "design" in given else None
    ask = _read_ask(faults, given.get("ask", []), known)
    if any(mesh.eta is not None for mesh in meshes) and "eta" not in ask:
        ask = (*ask, "eta")  # use the given efficiencies, or report why not
    if len(faults) != before:
        return None
    speeds: dict[str, Fraction] = {}
    for label, speed in inputs.items():
        if speeds.setdefault(body_of[label], speed) != speed:
            faults.add(
                f"gears.{unit}", translate("{} is given another speed than its own body", label)
            )
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
    )


def _read_module(
    faults: Faults, table: Mapping[str, Any]
) -> tuple[Fraction | None, dict[str, Fraction]]:
    """Read ``module``: that of all wheels, or of rows by their meshes, m."""

    def read(path: str, value: object) -> Fraction | None:
        told = fields.read_number(faults, path, value, "a module in mm", low=0.01, high=1000)
        return None if told is None else fraction(told) / 1000

    value = table.get("module")
    if not isinstance(value, Mapping):
        return (None if value is None else read("gears.module", value)), {}
    found = {name: read(f"gears.module.{segment(name)}", one) for name, one in value.items()}
    return None, {name: one for name, one in found.items() if one is not None}


def _known(faults: Faults, path: str, value: object, known: tuple[str, ...]) -> tuple[str, ...]:
    found = read_labels(faults, path, value, GROUP_LIMIT)
    for index, label in enumerate(found):
        if label not in known:
            fields.report_unknown(
                faults, f"{path}[{index}]", label, known, message="unknown wheel '{}'"
            )
    return tuple(label for label in found if label in known)


def _further_names(value: object) -> list[str]:
    """Return letters that only ``bodies`` has: a shaft or a carrier with a name of its own."""
    groups = (
        [group for group in value if isinstance(group, list)] if isinstance(value, list) else []
    )
    names = [name for group in groups[:GROUP_LIMIT] for name in group[:GROUP_LIMIT]]
    kept = [fold(name) for name in names if isinstance(name, str) and is_label(fold(name))]
    return [name for name in dict.fromkeys(kept) if name[0].isalpha()]


def _read_groups(
    faults: Faults, path: str, value: object, known: tuple[str, ...]
) -> list[tuple[str, ...]]:
    if not isinstance(value, list) or len(value) > GROUP_LIMIT:
        faults.expected(path, "a list of lists", value, '[["3", "H"]]')
        return []
    if value and not any(isinstance(group, list) for group in value):
        written = ", ".join(f'"{label}"' for label in value)
        faults.add(
            path,
            "expected a list of lists, got one list of labels",
            translate("Write {} = [[{}]].", path.partition(".")[2], written),
        )
        return []
    return [_known(faults, f"{path}[{i}]", group, known) for i, group in enumerate(value)]


_SPEEDS = {"n": "a rotational speed in rev/min", "omega": "an angular velocity in 1/s"}


def _read_inputs(
    faults: Faults, gears_table: Mapping[str, Any], known: tuple[str, ...]
) -> tuple[str, dict[str, Fraction]]:
    if "n" in gears_table and "omega" in gears_table:
        faults.add("gears.omega", "n and omega are both given", "Keep one of them.")
    unit = "omega" if "omega" in gears_table else "n"
    found: dict[str, Fraction] = {}
    table = (
        fields.read_table(faults, f"gears.{unit}", gears_table.get(unit, {}), "n = { 1 = 2400 }")
        or {}
    )
    for key, value in table.items():
        path = joined("gears", unit, segment(key))
        label = read_label(faults, path, key, known)
        what = _SPEEDS[unit]
        speed = fields.read_number(faults, path, value, what, low=-1e6, high=1e6)
        if label is not None and speed is not None:
            found[label] = fraction(speed)
    return unit, found


def _read_planets(faults: Faults, value: object, draft: TrainDraft) -> dict[str, int]:
    """Read the number of planets: one for every carrier, or by carrier."""
    carriers = tuple(draft.carriers)
    if not isinstance(value, Mapping):
        count = fields.read_integer(faults, "gears.satellites", value, 1, 100)
        return {} if count is None else dict.fromkeys(carriers, count)
    found: dict[str, int] = {}
    for key, number in value.items():
        path = joined("gears.satellites", segment(key))
        label = read_label(faults, path, key, carriers)
        count = fields.read_integer(faults, path, number, 1, 100)
        if label is not None and count is not None:
            found[label] = count
    return found


def _read_picture(faults: Faults, value: object) -> DiagramSettings:
    table = fields.read_table(faults, "gears.picture", value, "picture = { pole_mm = 40 }") or {}
    found = read_flat(faults, "gears.picture", table, PictureSection)
    return DiagramSettings(**{key: fraction(value) for key, value in found.items()})


def _read_design(faults: Faults, value: object) -> PlanetaryTask:
    example = "design = { U = 6.5, k_min = 3, k_max = 5 }"
    table = fields.read_table(faults, "gears.design", value, example) or {}
    design = PlanetaryTask(**read_flat(faults, "gears.design", table, PlanetaryTask))
    if design.U == 0:
        faults.add("gears.design.U", "the ratio is 0", "Leave it out, or give another one.")
    for low, high in (("z_min", "z_max"), ("k_min", "k_max")):
        least, most = getattr(design, low), getattr(design, high)
        if least > most:
            what = translate("{} = {} is more than {} = {}", low, least, high, most)
            faults.add(f"gears.design.{low}", what, "Exchange them.")
    return design


def _read_ask(faults: Faults, value: object, known: tuple[str, ...]) -> tuple[str, ...]:
    if not isinstance(value, list) or len(value) > ASK_LIMIT:
        faults.expected("gears.ask", "a list of names", value, '["U_1_5", "n_5"]')
        return ()
    found: list[str] = []
    for index, name in enumerate(value):
        text = fields.read_text(faults, f"gears.ask[{index}]", name, limit=80)
        if text is not None and _is_requestable(faults, f"gears.ask[{index}]", text, known):
            found.append(text)
    return tuple(found)


def _is_requestable(faults: Faults, path: str, text: str, known: tuple[str, ...]) -> bool:
    phrase = _fault_of(text, known)
    if phrase:
        faults.add(path, phrase, _NAMES)
    return not phrase


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


def _read_published(faults: Faults, value: object, train: Train | None) -> tuple[Published, ...]:
    """Read the values that the source prints; ``what`` is a name that can be requested."""

    def check(path: str, quantity: str, name: str) -> str:
        if train is not None:
            _is_requestable(faults, path, quantity or name, tuple(train.body_of))
        return quantity or name

    example = 'value = -375, what = "n_5"'
    return read_published(faults, value, check, example=example, without=("per_mm", "position"))
