"""What sheet and protocol say of a train, as rich text: given, calculation, results (тексты)."""

from __future__ import annotations

import re
from collections.abc import Iterator

from planmethod.gears.answers import Answer, answer, named
from planmethod.gears.asked import parse
from planmethod.gears.conditions import conditions, judgement
from planmethod.gears.construction import GearDrawing, GearReading
from planmethod.gears.derivation import DerivedLine, derivation
from planmethod.gears.motion import TrainMotion
from planmethod.gears.text import equation_of, fraction_text, kind_of, mobility
from planmethod.gears.velocities import by_velocities
from planmethod.note.compared import ComparedNumber
from planmethod.note.numbers import raised
from planmethod.note.wording import Language


def unit_of(one: Answer, words: Language) -> str:
    """Return the unit of a value as rich text."""
    return raised(words.gears["units"][one.unit]) if one.unit else ""


def indexed(text: str) -> str:
    """Return plain text with indices as rich text: ``z_2'`` gives ``z_{2'}``."""
    return re.sub(r"_([^\W²]+'*(?:-[^\W²]+'*)?)", r"_{\1}", text)


def given(motion: TrainMotion, words: Language) -> list[str]:
    """Return what is given of a train, as rich text (дано)."""
    train, say, told = motion.train, words.say, words.gears["sheet"]
    facts = []
    for label in train.listed:
        if label in train.arms:
            arm = f"{say.given(float(train.arms[label]))} {words.gears['units']['m']}"
            facts.append(f"r_{{{label}}} = {arm}")
            continue
        size = motion.axes.sizes[label]
        letter, value = f"z_{{{label}}}", say.given(float(size))
        if not train.counted(label):
            letter = f"r_{{{label}}}"
            value = f"{say.given(float(size * train.unit_m))} {words.gears['units']['m']}"
        by = told.by_coaxiality if label in train.unknown else "{symbol} = {value}"
        facts.append(by.format(symbol=letter, value=value))
    for label, wheel in train.wheels.items():
        if wheel.shift:
            facts.append(f"x_{{{label}}} = {say.given(float(wheel.shift))}")
    unit = raised(words.gears["units"][train.units[0]])
    for body, speed in train.inputs.items():
        value = say.given(float(speed))
        facts.append(f"{train.letter}_{{{body}}} = {value} {unit}")
    modules = train.modules if train.module is not None else {}
    for module, wheels in modules.items():
        value = say.given(float(module * 1000))
        of = {"value": value, "labels": ", ".join(wheels)}
        facts.append((told.module if len(modules) == 1 else told.module_of).format(**of))
    if train.fixed:
        labels = sorted(train.fixed)
        form = "one" if len(labels) == 1 else "many"
        facts.append(str(told["fixed"][form]).format(labels=", ".join(labels)))
    return facts


def calculation(motion: TrainMotion, words: Language, notation: str | None = None) -> list[str]:
    """Return kind, mobility, equations of the meshes with their ratios, what is derived."""
    train, found = motion.train, motion.structure
    lines = [kind_of(found, words), mobility(found, words, notation)]
    for mesh in train.meshes:
        lines.append(";  ".join(equation_of(motion, mesh)))
    lines += [line.text for line in ratios(motion, words)]
    rest = [one for name in dict.fromkeys(train.ask) for one in _plain(name, motion, words)]
    lines += ["; ".join(rest)] if rest else []
    lines += [indexed(judgement(one, words)) for one in conditions(motion)]
    return lines


def ratios(motion: TrainMotion, words: Language) -> Iterator[DerivedLine]:
    """Yield how ratios and speeds that are asked for are derived, and why some have no value."""
    yield from derivation(motion, words)
    yield from by_velocities(motion, words)
    say, known = words.gears, tuple(motion.train.body_of)
    for name in dict.fromkeys(motion.train.ask):
        asked, one = parse(name, known), answer(motion, name)
        if asked.kind == "U" and one.value is None:
            told = say["reasons"][one.reason].format(label=one.label)
            yield DerivedLine(f"{asked.symbol}: {told}", False)


def _plain(name: str, motion: TrainMotion, words: Language) -> Iterator[str]:
    """Yield a quantity that is neither a ratio nor a speed, with its value."""
    asked = parse(name, tuple(motion.train.body_of))
    if asked.kind in ("U", "n", "omega"):
        return
    one = answer(motion, name)
    if one.value is None:
        yield f"{asked.symbol}: {words.gears['reasons'][one.reason].format(label=one.label)}"
        return
    value = words.say.short(one.value, 4)
    yield f"{asked.symbol} = {value} {unit_of(one, words)}".rstrip()


def results(
    motion: TrainMotion,
    drawn: GearDrawing | None,
    seen: GearReading | None,
    words: Language,
) -> Iterator[tuple[str, ...]]:
    """Yield rows: symbol with unit, fraction, decimal, read off, sigma, difference in per cent."""
    train, say = motion.train, words.say
    known = tuple(train.body_of)
    found = {} if drawn is None else {one.name: one for one in drawn.found}
    for name in named(motion):
        if drawn is not None and name not in found:
            continue
        one: Answer = answer(motion, name)
        unit = unit_of(one, words)
        head = parse(name, known).symbol + (f", {unit}" if unit else "")
        if one.value is None:
            yield head, "—", "—", "—", "—", "—"
            continue
        exact = say.found(one.value) if one.exact is None or one.exact.denominator != 1 else (
            say.given(one.value)
        )  # fmt: skip
        row = (head, fraction_text(one.exact), exact)
        if name not in found or seen is None:
            yield (*row, "—", "—", "—")
            continue
        read = found[name].read
        both = ComparedNumber(one.value, float(seen.read.value[read]), float(seen.sigma[read]))
        off = say.number(both.percent_text(2))
        yield (*row, say.found(both.read), say.number(both.sigma_text), off)
