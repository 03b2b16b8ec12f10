"""Rate of an output, or a torque, that determines the rates of the driver."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence

from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.problem.file_node import FileNode
from planmethod.problem.links import LinkText
from planmethod.problem.model import Drive, OutputRate
from planmethod.problem.names import segment, split_pair
from planmethod.problem.toml import value_text

_KEY = re.compile(r"(v|vx|vy|omega|a|ax|ay|epsilon)_(.+)\Z")
_GAINS = {"v": "a", "vx": "ax", "vy": "ay", "omega": "epsilon"}
_SPEEDS = {gain: speed for speed, gain in _GAINS.items()}
_DRIVER_RATES = ("omega", "n", "train", "v")
"""Keys of the driver's own rate."""

_SHOWN = 6
"""Positions that a hint writes out."""


def is_output_rate(key: str) -> bool:
    """Return whether a key of the driver is a rate of an output: ``v_B``, ``omega_2_3``."""
    found = _KEY.match(key)
    return found is not None and split_pair(found[2]) is None


def has_motor(node: FileNode) -> bool:
    """Return whether the angle and the rate of two links relative to each other are given."""
    pairs = [
        {kind: {*key.partition("_")[2].split("_")} for kind in ("phi", "omega")
         if key.startswith(f"{kind}_") and key.count("_") == 2}
        for key in node.value
    ]  # fmt: skip
    turned = [one["phi"] for one in pairs if "phi" in one]
    return any(one.get("omega") in turned for one in pairs if "omega" in one)


def effort_key(node: FileNode, *, crank: bool) -> str:
    """Return the key of message drives: ``force`` of a slider or an actuator, else ``torque``."""
    if any(split_pair(key) is not None for key in node.value if key[:1].isupper()):
        return "force"
    relative = any(key.startswith("phi_") and key.count("_") == 2 for key in node.value)
    return "torque" if crank or relative else "force"


def read_output_rate(
    node: FileNode,
    link: LinkText,
    links: Mapping[str, LinkText],
    fixed: Collection[str],
    hosts: Mapping[str, str],
) -> OutputRate | None:
    """Read the rate of an output that gives the rate of the driver; None where there is none.

    Parameters
    ----------
    node : FileNode
        ``[driver]``.
    link : LinkText
        The driving link.
    hosts : mapping of str to str
        Host of each slider.
    """
    rates = [key for key in node.value if is_output_rate(key)]
    speeds = [key for key in rates if key.partition("_")[0] in _GAINS]
    for key in rates:
        kind, _, name = key.partition("_")
        if kind in _SPEEDS and f"{_SPEEDS[kind]}_{name}" not in speeds:
            hint = translate("Give the velocity too: {} = 2.", f"{_SPEEDS[kind]}_{name}")
            node[key].note("is an acceleration without its velocity", hint=hint)
    if not speeds:
        return None
    speed, *others = speeds
    for other in others + [key for key in _DRIVER_RATES if key in node]:
        node[other].note("{} and {} are both given", speed, other, hint="Keep one of them.")
    kind, _, name = speed.partition("_")
    found = node[speed].attempt(lambda one: _read_names(one, kind, name, link, links, fixed))
    unit = "an angular velocity in 1/s" if kind == "omega" else "a velocity in m/s"
    rate = node.read(speed, lambda one: one.number(unit))
    gain_key = f"{_GAINS[kind]}_{name}"
    gain = None
    if gain_key in node:
        unit = "an angular acceleration in 1/s²" if kind == "omega" else "an acceleration in m/s²"
        gain = node.read(gain_key, lambda one: one.number(unit))
        if kind == "v" and not _on_guide(name, links, hosts):
            hint = translate("Give a component, vx_{0} and ax_{0}, or epsilon.", name)
            message = "point {} is not on a guide of the frame, so its acceleration has no sign"
            node[gain_key].note(message, name, hint=hint)
        own = "epsilon" if "epsilon" in node else "a"
        if own in node:
            message = "{} and {} are both given"
            node[own].note(message, gain_key, own, hint="Keep one of them.")
    return None if found is None or rate is None else OutputRate(speed, rate, gain)


def _on_guide(point: str, links: Mapping[str, LinkText], hosts: Mapping[str, str]) -> bool:
    """Return whether a point is the pin of a slider on a guide of the frame."""
    sliders = [links[slider] for slider, host in hosts.items() if host == FRAME]
    return any(slider.points[:1] == (point,) for slider in sliders)


def _read_names(
    node: FileNode,
    kind: str,
    name: str,
    link: LinkText,
    links: Mapping[str, LinkText],
    fixed: Collection[str],
) -> str:
    """Check the point or the links of a rate."""
    if kind != "omega":
        points = [point for one in links.values() for point in one.points if point not in fixed]
        if name not in points:
            node.reject_unknown(name, dict.fromkeys(points), "unknown moving point '{}'")
        return name
    pair = name.split("_")
    for one in pair:
        if one not in links:
            node.reject_unknown(one, links, "unknown link '{}'")
    if pair == [link.name]:
        hint = translate("Write omega = ..., the angular velocity of link {} itself.", link.name)
        node.reject("link {} drives", link.name, hint=hint)
    if len(pair) > 2 or len({*pair}) < len(pair):
        node.reject("a relative rate must be of two links", hint="For example: omega_2_3 = 4")
    return name


def check_one_position(nodes: Sequence[FileNode], drives: Sequence[Drive], *, cycle: bool) -> None:
    """Note what gives the drivers other rates in each position, where there are several.

    Parameters
    ----------
    nodes, drives : sequence
        The tables of all driving links and what was read there.
    cycle : bool
        ``[cycle]`` gives the positions.
    """
    if not cycle and max(len(drive.positions) for drive in drives) < 2:
        return
    hint = _variants_hint(nodes, drives, cycle=cycle)
    for node, drive in zip(nodes, drives, strict=True):
        for key in _determining(node, drive):
            message = "{} gives the driver other rates in each position, but a file has one for all"
            node[key].note(message, key, hint=hint)


def _determining(node: FileNode, drive: Drive) -> Iterator[str]:
    """Find the keys that determine the rates of a driver in one position only."""
    if drive.output_rate is not None:
        yield drive.output_rate.key
    if drive.effort is not None:
        yield effort_key(node, crank=drive.is_crank)
    if drive.actuator is not None:
        yield "v_" + "".join(drive.actuator)


def _variants_hint(nodes: Sequence[FileNode], drives: Sequence[Drive], *, cycle: bool) -> str:
    """Return how a file has each position as a variant: the lines to write."""
    if cycle:
        return translate("Delete [cycle], or give the rates of the driver.")
    first, others = list[str](), list[str]()
    for node, drive in zip(nodes, drives, strict=True):
        key = drive.posed.key if drive.posed else "phi" if drive.is_crank else "s"
        given = node[key].value
        if isinstance(given, Mapping):
            given = list(drive.positions) if drive.is_crank else ["..."] * len(drive.positions)
        if not isinstance(given, list) or len(given) < 2:
            continue
        first.append(f"{key} = {_as_toml(given[0])}")
        place = node.path.replace("[", ".").replace("]", "")
        for number, value in enumerate(given[1:_SHOWN], 2):
            others.append(f"{number}.{place}.{segment(key)} = {_as_toml(value)}")
            if "root" in node and place == "driver":  # a variant's place replaces it, too
                others.append(f"{number}.{place}.root = {_as_toml(node['root'].value)}")
    if max(len(drive.positions) for drive in drives) > _SHOWN:
        others.append("...")
    return translate(
        "Write {}, and before the first table the line variants = {{ {} }}. "
        "Request --all-variants. Or give the rates of the driver.",
        ", ".join(first), ", ".join(others),
    )  # fmt: skip


def _as_toml(value: object) -> str:
    """Return a number or a text as a file has it."""
    if isinstance(value, str) and value != "...":
        return value_text(value)
    return f"{value:.10g}" if isinstance(value, float) else str(value)


def read_effort(node: FileNode, *, crank: bool, rates: Collection[str]) -> float | None:
    """Read the torque or the force that drives, N·m or N; None where there is none.

    ``rates`` are the keys of accelerations, which follow from it.
    """
    key = effort_key(node, crank=crank)
    other = "force" if key == "torque" else "torque"
    if other in node:
        unit = "N·m" if key == "torque" else "N"
        hint = translate("Write {} = ..., in {}.", key, unit)
        node[other].note("this driver has a {}", key, hint=hint)
    if key not in node:
        return None
    given = [one for one in rates if one in node]
    for one in given:
        hint = translate("Delete {}.", one)
        node[one].note("follows from {}", key, hint=hint)
    if "cam" in node:
        hint = translate("Delete {}.", key)
        node[key].note("a cam determines the accelerations of its follower", hint=hint)
    unit = "a couple in N·m" if key == "torque" else "a force in N"
    return node.read(key, lambda one: one.number(unit))


def check_driving_load(file: FileNode, drive: Drive, driver: FileNode, *, has_forces: bool) -> None:
    """Note tables that a torque or a force that drives needs, or excludes."""
    node = driver["torque" if "torque" in driver else "force"]
    if not has_forces and "dynamics" not in file:
        hint = "For example: [dynamics.links.1] inertia = 0.02"
        node.note("an acceleration follows from masses, and the file has none", hint=hint)
    if drive.pushed is not None:
        hint = "Delete the table, or give epsilon."
        file["balancing_force"].note("{} drives the crank already", node.key, hint=hint)
    if "machine" in file:
        hint = "Delete the key: [machine] has the driving moment."
        node.note("a flywheel is chosen for an even turn of the crank", hint=hint)
