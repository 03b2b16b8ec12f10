"""Rates of the driver that follow from an output or from a load, among the given data."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from planmethod.note.document import GivenFact
from planmethod.note.formula import Rich, fraction
from planmethod.note.narrate.stated_links import StatedNumbers
from planmethod.note.numbers import signed_sum
from planmethod.problem.model import Drive, FoundRates, OutputRate
from planmethod.solved.reading import other_place


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
    return "v", "a"


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
    yield GivenFact(phrase, {f"driver.{output.gain_key}": output.gain})


def _by_load(text: StatedNumbers, effort: float, rates: FoundRates) -> GivenFact:
    """Return the load that drives, and how the acceleration follows by the reduced inertia."""
    drive, notation = text.problem.drive, text.notation
    balancing = text.problem.balancer
    key = "torque" if balancing.turns else "force"
    symbol = notation.symbol(balancing.symbol)
    phrase = f"{symbol} = {text.number(effort, balancing.unit, f'driver.{key}')}"
    if rates.inertia:
        _, gain = driver_symbols(drive)
        unit, own = notation.units[balancing.unit], "1/s²" if drive.is_crank else "m/s²"
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


def other_drivers(text: StatedNumbers, positions: Sequence[float]) -> Iterator[GivenFact]:
    """Yield the position and the rates of each other driving link."""
    drive = text.problem.drive
    for number, other in enumerate(drive.other_drives, 1):
        places = other_place(drive, other, np.asarray(positions, dtype=float)).tolist()
        path, turns = f"drivers[{number}]", other.pivot is not None
        letters = ("φ", "ω", "ε") if turns else ("s", "v", "a")
        units = ("deg", "1/s", "1/s²") if turns else ("m", "m/s", "m/s²")
        keys = ("phi", "omega", "epsilon") if turns else ("s", "v", "a")
        place, rate, gain = (f"{letter}_{{{other.link}}}" for letter in letters)
        at = ", ".join(
            text.metres(one) if units[0] == "m" else text.number(round(one, 6), "deg")
            for one in places
        )
        yield GivenFact(f"{place} = {at}", {f"{path}.{keys[0]}": places})
        even = "" if other.acceleration else " = const"
        phrase = f"{rate} = {text.number(other.rate, units[1])}{even}"
        yield GivenFact(phrase, {f"{path}.{keys[1]}": other.rate})
        if other.acceleration:
            phrase = f"{gain} = {text.number(other.acceleration, units[2])}"
            yield GivenFact(phrase, {f"{path}.{keys[2]}": other.acceleration})
