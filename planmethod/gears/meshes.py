"""Wheels and meshes of a problem file, and which labels are one body (колёса и зацепления)."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction
from functools import partial

from msgspec import Struct, field
from msgspec.structs import replace

from planmethod.gears.model import FLEXIBLE, HALF_MODULES, GearRim, Mesh, MeshKind
from planmethod.languages import translate
from planmethod.problem import keys
from planmethod.problem.faults import is_integer, is_number, show
from planmethod.problem.file_node import FileNode, needed
from planmethod.problem.names import fold, is_label, looks_latin
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


def label_of(value: object) -> str | None:
    """Return the label of a wheel or a carrier, ``2'`` or ``H``, that a value is; None of none."""
    if is_integer(value):
        value = str(value) if abs(value) < 10**9 else "too many digits"
    if not isinstance(value, str):
        return None
    text = fold(value) if looks_latin(value) else value
    text = text.replace("′", "'").replace("’", "'")
    return text if is_label(text) else None


def read_label(node: FileNode, known: Sequence[str] | None = None) -> str:
    """Read the label of a wheel or a carrier: ``2'``, ``H``, or a whole number."""
    label = label_of(node.value)
    if label is None:
        node.reject_value("the label of a wheel", _NAME)
    if known is not None and label not in known:
        node.reject_unknown(label, known, "unknown wheel '{}'")
    return label


def read_key_label(node: FileNode, known: Sequence[str] | None = None) -> str:
    """Return the label that is the key of a node."""
    return read_label(node.with_value(node.key), known)


def read_labels(node: FileNode, limit: int, known: Sequence[str] | None = None) -> tuple[str, ...]:
    """Read a list of labels, each once; those that are faulty are left out."""
    node.array("a list of labels", 'For example: ["3"]', high=limit)
    return tuple(dict.fromkeys(node.read_sound(partial(read_label, known=known))))


def find_carriers(meshes: object, body_groups: object = None) -> frozenset[str]:
    """Return the labels of carriers without a mesh, from ``meshes`` and ``bodies`` of a file."""
    tables = [one for one in meshes if isinstance(one, dict)] if isinstance(meshes, list) else []
    carriers = {label_of(one.get("carrier")) for one in tables}
    lists = [one["of"] for one in tables if isinstance(one.get("of"), list)]
    meshing = {label_of(wheel) for wheels in lists for wheel in wheels}
    for group in body_groups if isinstance(body_groups, list) else ():
        own = {label_of(body) for body in group} if isinstance(group, list) else set()
        carriers |= own if own & carriers else set()
    return frozenset(label for label in carriers - meshing if label is not None)


def read_wheels(
    node: FileNode,
    unknown: Sequence[str],
    draft: TrainDraft,
    carriers: frozenset[str] = frozenset(),
) -> None:
    """Read ``wheels``: teeth by label, or a table; of carriers their radii."""
    table = node.attempt(lambda wheels: wheels.table("wheels = { 1 = 20, 2 = 36 }")) or {}
    node = node.with_value(table)
    node.require_at_most(WHEEL_LIMIT, "{} wheels, the limit is {}")
    wheels = [one for key, one in table.items() if label_of(key) not in carriers]
    bodies = [entry for entry in wheels if isinstance(entry, dict)]
    draft.toothed = not (bodies and len(bodies) == len(wheels) and all("r" in b for b in bodies))
    for entry in node.entries():
        entry.attempt(partial(_read_member, unknown=unknown, draft=draft, carriers=carriers))
    for label in unknown:
        draft.wheels.setdefault(label, GearRim(label, None))
    draft.listed += [label for label in draft.wheels if label not in draft.listed]


def _read_member(
    node: FileNode, unknown: Sequence[str], draft: TrainDraft, carriers: frozenset[str]
) -> None:
    """Read a wheel, or the radius of a carrier."""
    label = read_key_label(node)
    if label in draft.listed:
        node.note("wheel {} is given twice", label)
    draft.listed.append(label)
    if label in carriers:
        draft.arms[label] = _read_arm(node, label)
        return
    wheel = node.attempt(partial(_read_wheel, label=label, draft=draft)) or GearRim(label, _ONE)
    if label in unknown and wheel.size is not None:
        node.note("wheel {} has a size, and is listed in unknown", label)
    elif label not in unknown and wheel.size is None:
        hint = "Give its teeth, or list it in unknown."
        node.note("wheel {} has no teeth", label, hint=hint)
    draft.wheels[label] = wheel


_ONE = Fraction(1)
"""Teeth of a wheel whose own could not be read."""


def _read_arm(node: FileNode, label: str) -> Fraction:
    """Read the radius of a carrier, which has no teeth."""
    if not isinstance(node.value, dict) or set(node.value) != {"r"}:
        hint = "Give {{ r = 0.05 }}, the centre distance of its planets, or omit it."
        node.reject("{} is a carrier and has no teeth", label, hint=hint)
    return fraction(node["r"].length())


def _read_wheel(node: FileNode, label: str, draft: TrainDraft) -> GearRim:
    if is_number(node.value):
        return GearRim(label, Fraction(node.integer(1, TEETH_LIMIT)))
    table = node.attempt(lambda wheel: wheel.table("{ r = 0.07 }"))
    node = node.with_value(table or {})
    given = GearWheelSection(**node.record(GearWheelSection, r=FileNode.length, axis=_read_axis))
    size: Fraction | None = None
    if "z" in node and "r" in node:
        node.note("z and r are both given", hint="Keep one of them.")
    elif "z" in node:
        size = Fraction(given.z or 1)
    elif "r" in node:
        size = _ONE if given.r is None else fraction(given.r)
    plain = "r" in node and draft.toothed
    module = None if given.m is None else fraction(given.m) / 1000
    return GearRim(label, size, fraction(given.x), given.axis, plain, module)


def _read_axis(node: FileNode) -> tuple[float, float, float]:
    numbers = node.value if isinstance(node.value, list) else []
    if len(numbers) != 3 or not all(is_number(n) and abs(n) <= 1e6 for n in numbers):
        node.reject_value("[x, y, z]")
    x, y, z = map(float, numbers)
    if not any((x, y, z)):
        node.reject("the axis has no direction")
    return x, y, z


_MESH = '{ of = [1, 2], kind = "external" }'


def read_meshes(node: FileNode, draft: TrainDraft) -> tuple[Mesh, ...]:
    """Read ``meshes``: pairs of wheels, each with its kind and the carrier of its axes."""
    if not isinstance(node.value, list) or not 1 <= len(node.value) <= WHEEL_LIMIT:
        hint = translate("For example: [{}]", _MESH)
        node.reject("expected 1 to {} meshes, got {}", WHEEL_LIMIT, show(node.value), hint=hint)
    found: list[Mesh] = []
    for entry in node.entries():
        mesh = entry.attempt(partial(_read_mesh, draft=draft))
        if mesh is not None:
            if {mesh.first, mesh.second} in [{m.first, m.second} for m in found]:
                entry.note("the mesh {} is given twice", mesh.name)
            found.append(mesh)
    return tuple(found)


def check_meshes(node: FileNode, meshes: Sequence[Mesh], draft: TrainDraft) -> None:
    """Check what wheels in mesh share, and that each wheel is in mesh; ``node`` is ``[gears]``."""
    _share_modules(node, meshes, draft)
    _check_radii(node["wheels"], meshes, draft)
    meshing = {label for mesh in meshes for label in (mesh.first, mesh.second)}
    for label in draft.wheels:
        if label not in meshing and len(meshes) == len(node["meshes"].value):
            node["wheels"][label].note("wheel {} does not mesh with any other", label)


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


def _share_modules(node: FileNode, meshes: Sequence[Mesh], draft: TrainDraft) -> None:
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
            node["module"][name].note_unknown(name, names, "unknown mesh '{}'")
        else:
            told[mesh] = given_module
    for row, labels in _rows(meshes):
        given = [(node["module"][m.name], told[m]) for m in row if m in told]
        own_modules = ((x, wheels[x].module) for x in labels if x in wheels)
        given += [(node["wheels"][x]["m"], m) for x, m in own_modules if m is not None]
        own = given[0][1] if given else None
        for place, module in given[1:]:
            if own is not None and module != own:
                what = "{:g} mm, and {:g} mm of other wheels in its row"
                hint = "Wheels in mesh have one module."
                place.note(what, float(module * 1000), float(own * 1000), hint=hint)
        if own is None and is_told and draft.module is None:
            hint = "Name every row, or give one module = ... (mm)."
            node["module"].note("the mesh {} has no module", row[0].name, hint=hint)
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


def _check_radii(node: FileNode, meshes: Sequence[Mesh], draft: TrainDraft) -> None:
    """Check the radii beside teeth: only those of belt wheels need not make whole teeth.

    A radius of a wheel with teeth determines their number; that of a pulley is a radius.
    """
    toothed: set[str] = set()
    for mesh in meshes:
        pair = [w for w in (draft.wheels.get(x) for x in (mesh.first, mesh.second)) if w]
        flexible = mesh.kind in FLEXIBLE and all(wheel.is_pulley for wheel in pair)
        for wheel in pair:
            radius = node[wheel.label]["r"]
            if not wheel.is_pulley or wheel.size is None or flexible:
                continue
            toothed.add(wheel.label)
            if draft.module is None:
                hint = "Give module = ... (mm), or every wheel by its radius."
                radius.note("a radius together with teeth needs the module", hint=hint)
            elif wheel.size.denominator != 1:
                radius.note("2r/m = {:g} teeth, not whole", float(wheel.size))
    for label in toothed:
        draft.wheels[label] = replace(draft.wheels[label], is_pulley=False)


def _read_mesh(node: FileNode, draft: TrainDraft) -> Mesh:
    node.table(_MESH)
    node.allow(keys.MESH)
    of = node["of"]
    of.array("two wheels", "For example: [1, 2]", low=2, high=2)
    kind = node.read("kind", lambda kind: kind.member(MeshKind), MeshKind.EXTERNAL)
    rack, wheels = kind is MeshKind.RACK, tuple(draft.wheels)
    one = of[0].attempt(partial(read_label, known=wheels))
    other = of[1].attempt(partial(read_label, known=None if rack else wheels))
    carrier = node.read("carrier", read_label)
    eta = node.read("eta", lambda eta: eta.number("an efficiency", 0.01, 1, hint="0.98"))
    hand = node.read("hand", lambda hand: hand.word(("right", "left")), "right")
    first, second, kind, hand = needed(one), needed(other), needed(kind), needed(hand)
    if first.rstrip("'") == second.rstrip("'"):
        of.reject("{} and {} are one body, and mesh with each other", first, second)
    if rack:
        if carrier is not None:
            node["carrier"].note("a rack is guided in the frame and has no carrier")
        if second in wheels:
            hint = "The second of a rack is the rack; it has no teeth to count."
            of[1].note("{} is a wheel", second, hint=hint)
        elif second not in draft.racks:
            draft.racks.append(second)
    if carrier is not None and carrier not in draft.carriers:
        draft.carriers.append(carrier)
    loss = None if eta is None else fraction(eta)
    return Mesh(first, second, kind, carrier, loss, hand == "left")
