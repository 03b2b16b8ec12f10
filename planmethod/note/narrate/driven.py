"""Rates of the driver that follow from an output or from a load, among the given data."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from msgspec.structs import replace

from planmethod.note.document import GivenFact
from planmethod.note.formula import Rich, fraction
from planmethod.note.narrate.stated_links import StatedNumbers
from planmethod.note.numbers import signed_sum
from planmethod.problem.model import Drive, FoundRates, OtherDrive, OutputRate, Problem


def determined_rates(text: StatedNumbers) -> Iterator[GivenFact]:
    """Yield how the driving link moves: by its output, or by the load that drives it."""
    drive = text.problem.drive
    rates = drive.found_rates or FoundRates()
    rate, gain = driver_symbols(drive)
    units = ("1/s", "1/s²") if drive.is_crank else ("m/s", "m/s²")
    if drive.output_rate is not None:
        yield from _by_output(text, drive.output_rate, rates)
    elif drive.actuator is None:
        key = "n" if drive.turns is not None else "omega" if drive.is_crank else "v"
        value = drive.rate if drive.turns is None else drive.turns
        unit = "rev/min" if key == "n" else units[0]
        symbol = f"n_{{{drive.link}}}" if key == "n" else rate
        phrase = f"{symbol} = {text.number(value, unit, f'driver.{key}')}"
        yield GivenFact(phrase, {f"driver.{key}": value} if drive.rate else {})
    if drive.effort is not None:
        yield _by_load(text, drive.effort, rates)
        return
    by_output = drive.output_rate is not None and drive.output_rate.gain is not None
    if drive.acceleration and not by_output:
        key = "epsilon" if drive.is_crank else "a"
        phrase = text.number(drive.acceleration, units[1], f"driver.{key}")
        yield GivenFact(f"{gain} = {phrase}", {f"driver.{key}": drive.acceleration})


def driver_symbols(drive: Drive) -> tuple[Rich, Rich]:
    """Return the letters of the driver's rate and acceleration."""
    if drive.is_crank:
        return f"ω_{{{drive.link}}}", f"ε_{{{drive.link}}}"
    own = f"_{{{drive.link}}}" if isinstance(drive, OtherDrive) else ""
    return f"v{own}", f"a{own}"


def output_symbol(key: str) -> Rich:
    """Return the letters of a rate: ``v_{B}``, ``v_{Bx}``, ``ω_{3} − ω_{2}``."""
    kind, _, name = key.partition("_")
    if kind in ("omega", "epsilon"):
        letter = "ω" if kind == "omega" else "ε"
        return " − ".join(f"{letter}_{{{link}}}" for link in name.split("_")[::-1])
    return f"{kind[0]}_{{{name}{kind[1:]}}}"


def _by_output(text: StatedNumbers, output: OutputRate, rates: FoundRates) -> Iterator[GivenFact]:
    """Yield the rate of the output, and how that of the driver follows by proportion."""
    drive, notation, note = text.problem.drive, text.notation, text.language.note
    rate, gain = driver_symbols(drive)
    turns = output.kind == "omega"
    units, own = (("1/s", "1/s²") if one else ("m/s", "m/s²") for one in (turns, drive.is_crank))
    number, path = text.number, f"driver.{output.key}"
    phrase = f"{output_symbol(output.key)} = {number(output.rate, units[0], path)}"
    if rates.first:
        share = fraction(notation.computed(output.rate), notation.computed(rates.first))
        phrase += note.given_by_output.format(
            found=f"{rate} = {share} = {notation.computed(drive.rate)} {notation.units[own[0]]}",
            one=f"{rate} = 1 {notation.units[own[0]]}",
            output=f"{notation.computed(rates.first)} {notation.units[units[0]]}",
        )
    elif rates.derivatives:
        phrase += " = " + _linear_sum(text, rates.derivatives)
        phrase += note.given_together.format(
            found=f"{rate} = {notation.computed(drive.rate)} {notation.units[own[0]]}"
        )
    yield GivenFact(phrase, {path: output.rate})
    if output.gain is None:
        return
    phrase = f"{output_symbol(output.gain_key)} = "
    phrase += number(output.gain, units[1], f"driver.{output.gain_key}")
    if rates.first and drive.effort is None:
        even = notation.computed(rates.second * drive.rate**2)
        above = signed_sum([(1.0, notation.computed(output.gain)), (-1.0, f"({even})")])
        share = fraction(above, notation.computed(rates.first))
        phrase += note.given_by_gain.format(
            found=f"{gain} = {share} = {notation.computed(drive.acceleration)} "
            f"{notation.units[own[1]]}",
            even=f"{even} {notation.units[units[1]]}",
        )
    elif rates.derivatives and drive.effort is None:
        phrase += note.given_together.format(
            found=f"{gain} = {notation.computed(drive.acceleration)} {notation.units[own[1]]}"
        )
    yield GivenFact(phrase, {f"driver.{output.gain_key}": output.gain})


def _linear_sum(text: StatedNumbers, derivatives: Sequence[float]) -> Rich:
    """Return the rate of an output as the sum of those that each driver alone gives."""
    slides, letters = text.problem.slides, []
    for link in text.problem.mechanism.drivers:
        letters.append(f"v_{{{link}}}" if link in slides else f"ω_{{{link}}}")
    computed = text.notation.computed
    pairs = [(one, letter) for one, letter in zip(derivatives, letters, strict=True) if one]
    return signed_sum([(one, f"{computed(abs(one))}·{letter}") for one, letter in pairs])


def _by_load(text: StatedNumbers, effort: float, rates: FoundRates) -> GivenFact:
    """Return the load that drives, and how the acceleration follows by the reduced inertia."""
    drive, notation = text.problem.drive, text.notation
    balancing = text.problem.balancer
    key = "torque" if balancing.turns else "force"
    symbol = notation.symbol(balancing.symbol)
    if isinstance(drive, OtherDrive):
        symbol = notation.symbol(text.problem.balancer_of(drive))
    phrase = f"{symbol} = {text.number(effort, balancing.unit, f'driver.{key}')}"
    (_, gain), own = driver_symbols(drive), "1/s²" if drive.is_crank else "m/s²"
    if not rates.inertia:
        found = f"{gain} = {notation.computed(drive.acceleration)} {notation.units[own]}"
        phrase += text.language.note.given_together.format(found=found)
    else:
        unit = notation.units[balancing.unit]
        load = f"({notation.computed(rates.load)})"
        above = signed_sum([(1.0, notation.computed(effort)), (-1.0, load)])
        share = fraction(above, notation.computed(rates.inertia))
        inertia = "kg·m²" if drive.is_crank and balancing.turns else "kg"
        phrase += text.language.note.given_by_load.format(
            found=f"{gain} = {share} = {notation.computed(drive.acceleration)} "
            f"{notation.units[own]}",
            load=f"{notation.computed(rates.load)} {unit}",
            inertia=f"{notation.computed(rates.inertia)} {notation.units[inertia]}",
        )
    return GivenFact(phrase, {f"driver.{key}": effort})


def single_driver(problem: Problem, number: int) -> Problem:
    """Return a problem with one of its drivers alone, whose given data are those of ``[driver]``.

    `as_listed` gives the paths of its facts their number again.
    """
    own = f"drivers[{number}]."
    stated = {
        _DRIVER + path.removeprefix(own) if path.startswith(own) else path: said
        for path, said in problem.stated.items()
    }
    drive = replace(problem.drive.every[number], other_drives=())
    return replace(problem, drive=drive, stated=stated)


_DRIVER = "driver."


def as_listed(facts: Iterable[GivenFact], number: int) -> Iterator[GivenFact]:
    """Yield facts of one of several drivers with the paths of ``[[drivers]]``."""
    for fact in facts:
        data = {
            path.replace(_DRIVER, f"drivers[{number}].", 1)
            if path.startswith(_DRIVER)
            else path: one
            for path, one in fact.data.items()
        }
        yield GivenFact(fact.text, data)
