"""Texts of sheet and protocol on a train, as rich text: given, calculation, results (тексты)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from planmethod.gears.coaxiality import derived_teeth
from planmethod.gears.construction import GearDrawing, GearReading
from planmethod.gears.derivation import DerivationLine, derivation
from planmethod.gears.model import Mesh, MeshKind, Train, parse
from planmethod.gears.motion import TrainMotion
from planmethod.gears.solution import Answer, answer, checked, judgement, named
from planmethod.gears.text import (
    equation_of,
    fraction_text,
    kind_of,
    mobility,
    stages_of,
)
from planmethod.gears.velocities import by_velocities
from planmethod.note.compared import DASH, ComparedNumber
from planmethod.note.document import GivenFact
from planmethod.note.numbers import raised
from planmethod.note.wording import Language
from planmethod.problem.names import segment

SHORT_STAGES = 80
"""Length of a sentence on stages beside the mobility, characters."""


def unit_of(one: Answer, language: Language) -> str:
    """Return the unit of a value as rich text."""
    return raised(language.gears["units"][one.unit]) if one.unit else ""


def indexed(text: str) -> str:
    """Return plain text with indices as rich text: ``z_2'`` gives ``z_{2'}``."""
    return re.sub(r"_([^\W²]+'*(?:-[^\W²]+'*)?)", r"_{\1}", text)


def train_facts(motion: TrainMotion, language: Language) -> list[GivenFact]:
    """Return the given facts of a train, sufficient to rebuild it (дано).

    Of the sizes that coaxiality gives only the letters. Fixed bodies come last.
    """
    facts = [
        *_sizes(motion, language),
        *_meshes(motion.train, language),
        *_body_facts(motion.train, language),
        *_speeds(motion.train, language),
        *_modules(motion.train, language),
    ]
    if motion.train.fixed:
        labels = sorted(motion.train.fixed)
        form = "one" if len(labels) == 1 else "many"
        text = str(language.gears["sheet"]["fixed"][form]).format(labels=", ".join(labels))
        facts.append(GivenFact(text, {"gears.fixed": labels}))
    return facts


def _sizes(motion: TrainMotion, language: Language) -> Iterator[GivenFact]:
    """Yield teeth or radii of wheels, radii of carriers, shifts, axes of bevel wheels."""
    train, notation, told = motion.train, language.notation, language.gears["sheet"]
    for label in train.listed:
        path = f"gears.wheels.{segment(label)}"
        if label in train.arms:
            radius = float(train.arms[label])
            arm = notation.as_input(float(train.arms[label] * train.per_m))
            arm = f"{arm} {language.gears['units'][train.length_unit]}"
            yield GivenFact(f"r_{{{label}}} = {arm}", {f"{path}.r": radius})
            continue
        size = motion.axes.sizes[label]
        counted = train.counted(label)
        letter = f"z_{{{label}}}" if counted else f"r_{{{label}}}"
        number = int(size) if counted and size.denominator == 1 else float(size)
        value = notation.as_input(float(size))
        if not counted:
            number = float(size * train.unit_m)
            value = notation.as_input(float(size * train.unit_m * train.per_m))
            value = f"{value} {language.gears['units'][train.length_unit]}"
        if label in train.unknown:
            data: dict[str, object] = {"gears.unknown": list(train.unknown)}
            yield GivenFact(told.sought.format(symbol=letter), data)
        else:
            yield GivenFact(f"{letter} = {value}", {f"{path}.{letter[0]}": number})
    for label, wheel in train.wheels.items():
        if wheel.shift:
            shift = float(wheel.shift)
            path = f"gears.wheels.{segment(label)}.x"
            yield GivenFact(f"x_{{{label}}} = {notation.as_input(shift)}", {path: shift})
    for label, wheel in train.wheels.items():
        if wheel.axis is not None:
            places = "; ".join(map(notation.as_input, wheel.axis))
            yield GivenFact(
                told.axis.format(label=label, places=places),
                {f"gears.wheels.{segment(label)}.axis": list(wheel.axis)},
            )


def _meshes(train: Train, language: Language) -> Iterator[GivenFact]:
    """Yield the meshes with their kinds and carriers; hands of worms and efficiencies."""
    told, rows = language.gears["sheet"], dict[tuple[str, str], dict[int, Mesh]]()
    for k, mesh in enumerate(train.meshes):
        kind = mesh.kind.value
        if mesh.kind is MeshKind.WORM:
            kind = "left worm" if mesh.left else "right worm"
        rows.setdefault((kind, mesh.carrier or ""), {})[k] = mesh
    for (kind, carrier), meshes in rows.items():
        data: dict[str, object] = {}
        for k, mesh in meshes.items():
            path = f"gears.meshes[{k}]"
            data |= {f"{path}.of": [mesh.first, mesh.second], f"{path}.kind": mesh.kind.value}
            data |= {f"{path}.carrier": carrier} if carrier else {}
            data |= {f"{path}.hand": "left"} if mesh.left else {}
        names = ", ".join(mesh.name for mesh in meshes.values())
        on = told.on_carrier.format(carrier=carrier) if carrier else ""
        yield GivenFact(told["meshes"][kind].format(names=names, on=on), data)
    for k, mesh in enumerate(train.meshes):
        if mesh.eta is not None:
            text = f"η_{{{mesh.name}}} = {language.notation.as_input(float(mesh.eta))}"
            yield GivenFact(text, {f"gears.meshes[{k}].eta": float(mesh.eta)})


def _body_facts(train: Train, language: Language) -> Iterator[GivenFact]:
    """Yield labels of one body and of one axis, numbers of planets, the output."""
    told = language.gears["sheet"]
    carriers = {mesh.carrier for mesh in train.meshes}
    wheels = {wheel.number for wheel in train.wheels.values()}
    groups, texts = [], []
    for body in train.bodies:
        labels = [label for label in train.body_of if train.body_of[label] == body]
        numbers = dict.fromkeys(label.rstrip("'") for label in labels)
        group = [body, *(number for number in numbers if number != body.rstrip("'"))]
        if len(group) > 1 or body.endswith("'"):
            groups.append(group)
        shown = [x for x in labels if x in train.wheels or x in carriers or x not in wheels]
        if len(shown) > 1:
            texts.append(told.one_body.format(labels=", ".join(shown)))
    if texts:
        yield GivenFact("; ".join(texts), {"gears.bodies": groups} if groups else {})
    if train.coaxial:
        rows = [list(group) for group in train.coaxial]
        text = "; ".join(told.coaxial.format(labels=", ".join(group)) for group in rows)
        yield GivenFact(text, {"gears.coaxial": rows})
    for carrier, count in train.planets.items():
        text = told.satellites.format(carrier=carrier, count=count)
        yield GivenFact(text, {f"gears.satellites.{segment(carrier)}": count})
    if train.output is not None:
        yield GivenFact(told.output.format(label=train.output), {"gears.output": train.output})


def _speeds(train: Train, language: Language) -> Iterator[GivenFact]:
    unit = raised(language.gears["units"][train.units[0]])
    for body, speed in train.inputs.items():
        text = f"{train.letter}_{{{body}}} = {language.notation.as_input(float(speed))} {unit}"
        name = "n" if train.unit == "n" else "omega"
        yield GivenFact(text, {f"gears.{name}.{segment(body)}": float(speed)})


def _modules(train: Train, language: Language) -> Iterator[GivenFact]:
    """Yield the module of the wheels, or those of the rows."""
    notation, told = language.notation, language.gears["sheet"]
    modules = train.modules if train.module is not None else {}
    for module, wheels in modules.items():
        mm = float(module * 1000)
        own = [label for label in wheels if train.wheels[label].module is not None]
        data = {f"gears.wheels.{segment(label)}.m": mm for label in own}
        if len(own) < len(wheels):
            data["gears.module"] = mm
        form = told.module if len(modules) == 1 else told.module_of
        yield GivenFact(form.format(value=notation.as_input(mm), labels=", ".join(wheels)), data)


def calculation(
    motion: TrainMotion,
    language: Language,
    pair_notation: str | None = None,
    *,
    in_short: bool = False,
) -> list[str]:
    """Return kind, mobility, equations of the meshes with their ratios, derivations.

    ``in_short`` gives stages and unknown teeth in fewer lines, for a sheet.
    """
    train, found = motion.train, motion.structure
    lines = [kind_of(found, language), mobility(found, language, pair_notation)]
    stages = stages_of(motion, language, in_short=in_short)
    if in_short and stages and len(stages[0]) < SHORT_STAGES and not found.is_spatial:
        lines[-1] += f".  {stages.pop()}"
    lines += stages
    lines += [line.text for line in derived_teeth(motion, language, in_short=in_short)]
    for mesh in train.meshes:
        lines.append(";  ".join(equation_of(motion, mesh)))
    lines += [line.text for line in ratios(motion, language)]
    rest = [
        one for name in dict.fromkeys(train.ask) for one in _other_quantity(name, motion, language)
    ]
    lines += ["; ".join(rest)] if rest else []
    lines += [indexed(judgement(one, language)) for one in checked(motion)]
    return lines


def ratios(motion: TrainMotion, language: Language) -> Iterator[DerivationLine]:
    """Yield derivations of the requested ratios and speeds, and why some have no value."""
    yield from derivation(motion, language)
    yield from by_velocities(motion, language)
    texts, known = language.gears, tuple(motion.train.body_of)
    for name in dict.fromkeys(motion.train.ask):
        asked, one = parse(name, known), answer(motion, name)
        if asked.kind == "U" and one.value is None:
            told = texts["reasons"][one.reason].format(label=one.label)
            yield DerivationLine(f"{asked.symbol}: {told}", False)


def _other_quantity(name: str, motion: TrainMotion, language: Language) -> Iterator[str]:
    """Yield a quantity that the lines before have not given, with its value."""
    asked = parse(name, tuple(motion.train.body_of))
    is_derived = bool({*asked.labels} & {*motion.train.unknown}) and asked.kind == "z"
    if asked.kind in ("W", "U", "n", "omega") or is_derived:
        return
    one = answer(motion, name)
    if one.value is None:
        yield f"{asked.symbol}: {language.gears['reasons'][one.reason].format(label=one.label)}"
        return
    value = language.notation.short(one.value, 4)
    yield f"{asked.symbol} = {value} {unit_of(one, language)}".rstrip()


def measured_quantities(drawn: GearDrawing, reading: GearReading) -> dict[str, ComparedNumber]:
    """Return the quantities measured on the diagrams, by their names."""
    return {
        one.name: ComparedNumber(
            float(one.exact), float(reading.read.value[one.read]), reading.sigma[one.read]
        )
        for one in drawn.quantities
    }


def results(
    motion: TrainMotion,
    drawn: GearDrawing | None,
    reading: GearReading | None,
    language: Language,
) -> Iterator[tuple[str, ...]]:
    """Yield rows: symbol with unit, fraction, decimal, reading, sigma, difference in per cent."""
    notation, known = language.notation, tuple(motion.train.body_of)
    found = {} if drawn is None or reading is None else measured_quantities(drawn, reading)
    for name in named(motion):
        if drawn is not None and name not in found:
            continue
        one: Answer = answer(motion, name)
        unit = unit_of(one, language)
        head = parse(name, known).symbol + (f", {unit}" if unit else "")
        if one.value is None:
            yield head, *[DASH] * 5
            continue
        is_integer = one.exact is not None and one.exact.denominator == 1
        exact = (notation.as_input if is_integer else notation.computed)(one.value)
        row = (head, fraction_text(one.exact), exact)
        if name not in found:
            yield (*row, *[DASH] * 3)
            continue
        both = found[name]
        yield (*row, *notation.numbers(both.read_text, both.sigma_text, both.percent_text(2)))
