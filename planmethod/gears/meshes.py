"""Wheels and meshes of a problem file, and which labels are one body (колёса и зацепления)."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.gears.model import FLEXIBLE, HALF_MODULES, GearRim, Mesh, MeshKind
from planmethod.languages import translate
from planmethod.problem import fields, keys
from planmethod.problem.fields import Faults
from planmethod.problem.flat_tables import read_flat
from planmethod.problem.names import fold, is_label, joined, looks_latin, segment
from planmethod.problem.tables import GearWheelSection

WHEEL_LIMIT = 60
TEETH_LIMIT = 10_000
_NAME = "A wheel is a number, perhaps with primes, a carrier a letter: 2, 2', H."


def fraction(number: float) -> Fraction:
    """Return a number of a file exactly as it is written there."""
    return Fraction(repr(number))


class TrainDraft(Struct):
    """The parts of a train read so far (черновик)."""

    module: Fraction | None
    modules: dict[str, Fraction] = field(default_factory=dict)
    wheels: dict[str, GearRim] = field(default_factory=dict)
    arms: dict[str, Fraction] = field(default_factory=dict)
    listed: list[str] = field(default_factory=list)
    racks: list[str] = field(default_factory=list)
    carriers: list[str] = field(default_factory=list)
    names: list[str] = field(default_factory=list)
    toothed: bool = True

    def labels(self) -> tuple[str, ...]:
        """Return all names of bodies: wheels, their numbers, racks, carriers, others."""
        numbers = [wheel.number for wheel in self.wheels.values()]
        return tuple(
            dict.fromkeys(
                [*self.wheels, *numbers, *self.racks, *self.carriers, *self.names, *self.arms]
            )
        )

    def merge_labels(self, groups: Sequence[Sequence[str]]) -> dict[str, str]:
        """Return the body of every label; a body is called by its carrier, or its first label."""
        body = {label: label.rstrip("'") for label in self.labels()}
        for group in groups:
            taken = {body[label] for label in group}
            for label, old in body.items():
                if old in taken:
                    body[label] = body[group[0]]
        for carrier in self.carriers:
            old = body[carrier]
            if old not in self.carriers:
                body.update({label: carrier for label, name in body.items() if name == old})
        return body


def read_label(
    faults: Faults, path: str, value: object, known: Sequence[str] | None = None
) -> str | None:
    """Read the label of a wheel or a carrier: ``2'``, ``H``, or a whole number."""
    if isinstance(value, int) and not isinstance(value, bool):
        value = str(value) if abs(value) < 10**9 else "too many digits"
    text = fold(value) if isinstance(value, str) and looks_latin(value) else value
    if isinstance(text, str):
        text = text.replace("′", "'").replace("’", "'")
    if not isinstance(text, str) or not is_label(text):
        faults.expected(path, "the label of a wheel", value, _NAME)
        return None
    if known is not None and text not in known:
        fields.report_unknown(faults, path, text, known, message="unknown wheel '{}'")
        return None
    return text


def read_labels(faults: Faults, path: str, value: object, limit: int) -> tuple[str, ...]:
    """Read a list of labels."""
    if not isinstance(value, list) or len(value) > limit:
        faults.expected(path, "a list of labels", value, 'For example: ["3"]')
        return ()
    found = [read_label(faults, f"{path}[{i}]", label) for i, label in enumerate(value)]
    return tuple(dict.fromkeys(label for label in found if label is not None))


def find_carriers(meshes: object, body_groups: object = None) -> frozenset[str]:
    """Return the labels of carriers without a mesh, from ``meshes`` and ``bodies`` of a file."""
    silent = Faults()
    tables = [one for one in meshes if isinstance(one, dict)] if isinstance(meshes, list) else []
    wheels = [x for one in tables if isinstance(one.get("of"), list) for x in one["of"]]
    both = ([one.get("carrier") for one in tables], wheels)
    told = [{read_label(silent, "", x) for x in labels} for labels in both]
    carriers, meshing = told
    for group in body_groups if isinstance(body_groups, list) else ():
        own = {read_label(silent, "", x) for x in group} if isinstance(group, list) else set()
        carriers |= own if own & carriers else set()
    return frozenset(label for label in carriers - meshing if label is not None)


def read_wheels(
    faults: Faults,
    value: object,
    unknown: Sequence[str],
    draft: TrainDraft,
    carriers: frozenset[str] = frozenset(),
) -> None:
    """Read ``wheels``: teeth by label, or a table; of carriers their radii."""
    table = fields.read_table(faults, "gears.wheels", value, "wheels = { 1 = 20, 2 = 36 }") or {}
    if len(table) > WHEEL_LIMIT:
        faults.add("gears.wheels", translate("{} wheels, the limit is {}", len(table), WHEEL_LIMIT))
        return
    silent = Faults()
    wheels = [one for key, one in table.items() if read_label(silent, "", key) not in carriers]
    bodies = [entry for entry in wheels if isinstance(entry, dict)]
    draft.toothed = not (bodies and len(bodies) == len(wheels) and all("r" in b for b in bodies))
    for key, entry in table.items():
        path = joined("gears.wheels", segment(key))
        label = read_label(faults, path, key)
        if label is None:
            continue
        if label in draft.listed:
            faults.add(path, translate("wheel {} is given twice", label))
        draft.listed.append(label)
        if label in carriers:
            _read_arm(faults, path, label, entry, draft)
            continue
        wheel = _read_wheel(faults, path, label, entry, draft)
        if label in unknown:
            if wheel.size is not None:
                faults.add(path, translate("wheel {} has a size, and is listed in unknown", label))
        elif wheel.size is None:
            hint = "Give its teeth, or list it in unknown."
            faults.add(path, translate("wheel {} has no teeth", label), hint)
        draft.wheels[label] = wheel
    for label in unknown:
        draft.wheels.setdefault(label, GearRim(label, None))
    draft.listed += [label for label in draft.wheels if label not in draft.listed]


def _read_arm(faults: Faults, path: str, label: str, entry: object, draft: TrainDraft) -> None:
    """Read the radius of a carrier, which has no teeth."""
    if not isinstance(entry, dict) or set(entry) != {"r"}:
        hint = "Give {{ r = 0.05 }}, the distance of the axes of its planets, or leave it out."
        faults.add(path, translate("{} is a carrier and has no teeth", label), hint)
        return
    radius = fields.read_length(faults, f"{path}.r", entry["r"])
    if radius is not None:
        draft.arms[label] = fraction(radius)


def _read_wheel(faults: Faults, path: str, label: str, entry: object, draft: TrainDraft) -> GearRim:
    if fields.is_number(entry):
        teeth = fields.read_integer(faults, path, entry, 1, TEETH_LIMIT)
        return GearRim(label, Fraction(teeth or 1))
    table = fields.read_table(faults, path, entry, "{ r = 0.07 }") or {}
    own = {"r": fields.read_length, "axis": _read_axis}
    given = GearWheelSection(**read_flat(faults, path, table, GearWheelSection, own))
    size: Fraction | None = None
    if "z" in table and "r" in table:
        faults.add(path, "z and r are both given", "Keep one of them.")
    elif "z" in table:
        size = Fraction(given.z or 1)
    elif "r" in table:
        size = Fraction(1) if given.r is None else fraction(given.r)
    plain = "r" in table and draft.toothed
    module = None if given.m is None else fraction(given.m) / 1000
    return GearRim(label, size, fraction(given.x), given.axis, plain, module)


def _read_axis(faults: Faults, path: str, value: object) -> tuple[float, float, float] | None:
    numbers = value if isinstance(value, list) else []
    if len(numbers) != 3 or not all(fields.is_number(n) and abs(n) <= 1e6 for n in numbers):
        faults.expected(path, "[x, y, z]", value)
        return None
    x, y, z = map(float, numbers)
    if not any((x, y, z)):
        faults.add(path, "the axis has no direction")
        return None
    return x, y, z


def read_meshes(faults: Faults, value: object, draft: TrainDraft) -> tuple[Mesh, ...]:
    """Read ``meshes``: pairs of wheels, each with its kind and the carrier of its axes."""
    example = '{ of = [1, 2], kind = "external" }'
    if not isinstance(value, list) or not 1 <= len(value) <= WHEEL_LIMIT:
        text = translate("expected 1 to {} meshes, got {}", WHEEL_LIMIT, fields.show(value))
        faults.add("gears.meshes", text, translate("For example: [{}]", example))
        return ()
    found: list[Mesh] = []
    for index, entry in enumerate(value):
        path = f"gears.meshes[{index}]"
        table = fields.read_table(faults, path, entry, example)
        mesh = None if table is None else _read_mesh(faults, path, table, draft)
        if mesh is not None:
            if {mesh.first, mesh.second} in [{m.first, m.second} for m in found]:
                faults.add(path, translate("the mesh {} is given twice", mesh.name))
            found.append(mesh)
    _share_modules(faults, found, draft)
    _check_radii(faults, found, draft)
    meshing = {label for mesh in found for label in (mesh.first, mesh.second)}
    for label in draft.wheels:
        if label not in meshing and len(found) == len(value):
            faults.add(
                f"gears.wheels.{segment(label)}",
                translate("wheel {} does not mesh with any other", label),
            )
    return tuple(found)


def _rows(meshes: Sequence[Mesh]) -> list[tuple[list[Mesh], list[str]]]:
    """Return what has one module: meshes of teeth that are joined by wheels, and those wheels."""
    rows: list[tuple[list[Mesh], list[str]]] = []
    for mesh in meshes:
        if mesh.kind in FLEXIBLE:
            continue
        own = [mesh.first] if mesh.kind is MeshKind.RACK else [mesh.first, mesh.second]
        near = [row for row in rows if set(row[1]) & set(own)]
        rows = [row for row in rows if row not in near]
        rows.append(([*(m for row in near for m in row[0]), mesh],
                     [*dict.fromkeys([*(x for row in near for x in row[1]), *own])]))  # fmt: skip
    return rows


def _share_modules(faults: Faults, meshes: Sequence[Mesh], draft: TrainDraft) -> None:
    """Give the wheels of every row their module: by the name of a mesh, or by one of them.

    Radii beside teeth, which are metres until then, become teeth, or half modules of a pulley.
    """
    wheels = draft.wheels
    by_mesh = {frozenset((mesh.first, mesh.second)): mesh for mesh in meshes}
    names = [mesh.name for mesh in meshes if mesh.kind not in FLEXIBLE]
    told: dict[Mesh, Fraction] = {}
    is_told = bool(draft.modules) or any(wheel.module is not None for wheel in wheels.values())
    for name, given_module in draft.modules.items():
        mesh = by_mesh.get(frozenset(name.replace("′", "'").replace("’", "'").split("-")))
        if mesh is None or mesh.kind in FLEXIBLE:
            fields.report_unknown(
                faults, f"gears.module.{segment(name)}", name, names, message="unknown mesh '{}'"
            )
        else:
            told[mesh] = given_module
    for row, labels in _rows(meshes):
        given = [(f"gears.module.{segment(m.name)}", told[m]) for m in row if m in told]
        own_modules = ((x, wheels[x].module) for x in labels if x in wheels)
        given += [(f"gears.wheels.{segment(x)}.m", m) for x, m in own_modules if m is not None]
        own = given[0][1] if given else None
        for path, module in given[1:]:
            if own is not None and module != own:
                what = "{:g} mm, and {:g} mm of other wheels in its row"
                what = translate(what, float(module * 1000), float(own * 1000))
                faults.add(path, what, "Wheels in mesh have one module.")
        if own is None and is_told and draft.module is None:
            what = translate("the mesh {} has no module", row[0].name)
            faults.add("gears.module", what, "Name every row, or give one module = ... (mm).")
        for label in labels if own is not None else ():
            if label in wheels:
                wheels[label] = replace(wheels[label], module=own)
    if draft.module is None:
        every = [w.module for w in wheels.values() if w.module is not None]
        draft.module = every[0] if every else None
    for label, wheel in wheels.items():
        if not wheel.is_pulley or wheel.size is None:
            continue
        its = wheel.module or draft.module
        per = HALF_MODULES if its is None else 2 / its
        wheels[label] = replace(wheel, size=wheel.size * per)


def _check_radii(faults: Faults, meshes: Sequence[Mesh], draft: TrainDraft) -> None:
    """Check the radii beside teeth: only those of belt wheels need not make whole teeth.

    A radius of a wheel with teeth determines their number; that of a pulley is a radius.
    """
    toothed: set[str] = set()
    for mesh in meshes:
        pair = [w for w in (draft.wheels.get(x) for x in (mesh.first, mesh.second)) if w]
        flexible = mesh.kind in FLEXIBLE and all(wheel.is_pulley for wheel in pair)
        for wheel in pair:
            path = f"gears.wheels.{segment(wheel.label)}.r"
            if not wheel.is_pulley or wheel.size is None or flexible:
                continue
            toothed.add(wheel.label)
            if draft.module is None:
                hint = "Give module = ... (mm), or every wheel by its radius."
                faults.add(path, "a radius beside teeth needs the module", hint)
            elif wheel.size.denominator != 1:
                faults.add(path, translate("2r/m = {:g} teeth, not whole", float(wheel.size)))
    for label in toothed:
        draft.wheels[label] = replace(draft.wheels[label], is_pulley=False)


def _read_mesh(faults: Faults, path: str, table: Any, draft: TrainDraft) -> Mesh | None:
    given = fields.read_keys(faults, path, table, keys.MESH)
    of = given.get("of")
    if not isinstance(of, list) or len(of) != 2:
        faults.expected(f"{path}.of", "two wheels", of, "For example: [1, 2]")
        return None
    kind = fields.read_member(faults, f"{path}.kind", given.get("kind", "external"), MeshKind)
    rack = kind is MeshKind.RACK
    wheels = tuple(draft.wheels)
    first = read_label(faults, f"{path}.of[0]", of[0], wheels)
    second = read_label(faults, f"{path}.of[1]", of[1], None if rack else wheels)
    carrier = None
    if "carrier" in given:
        carrier = read_label(faults, f"{path}.carrier", given["carrier"])
    eta = None
    if "eta" in given:
        eta = fields.read_number(
            faults, f"{path}.eta", given["eta"], "an efficiency", low=0.01, high=1, hint="0.98"
        )
    hand = fields.read_word(faults, f"{path}.hand", given.get("hand", "right"), ("right", "left"))
    if None in (kind, first, second, hand) or first is None or second is None or kind is None:
        return None
    if first.rstrip("'") == second.rstrip("'"):
        faults.add(
            f"{path}.of",
            translate("{} and {} are one body, and mesh with each other", first, second),
        )
        return None
    if rack:
        if carrier is not None:
            faults.add(f"{path}.carrier", "a rack is guided in the frame and has no carrier")
        if second in wheels:
            hint = "The second of a rack is the rack; it has no teeth to count."
            faults.add(f"{path}.of[1]", translate("{} is a wheel", second), hint)
        elif second not in draft.racks:
            draft.racks.append(second)
    if carrier is not None and carrier not in draft.carriers:
        draft.carriers.append(carrier)
    loss = None if eta is None else fraction(eta)
    return Mesh(first, second, kind, carrier, loss, hand == "left")
