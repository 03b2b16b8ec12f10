"""Formulas between the speeds and ratios of a train, as students calculate (зависимости).

A ratio is a product of stages: of wheels in mesh, ``U_ab = ±z_b/z_a``, and of a carrier beside a
fixed wheel f, ``U_aH = 1 − U^H_af``. Speeds follow from ratios, and by Willis on any carrier.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import NamedTuple

from planmethod.gears.model import Mesh, RequestedQuantity, parse
from planmethod.gears.motion import TrainMotion, mesh_row
from planmethod.gears.solution import answer
from planmethod.problem.records import Relation, Relations, RelationTerm

SPEEDS = ("n", "omega")

CODES = {"sign": "G1", "inverted": "G2"}

TURN = {
    r"\frac{π}{30}": math.pi / 30, r"\frac{30}{π}": 30 / math.pi, r"\frac{1}{60}": 1 / 60,
    "1": 1.0,
}  # fmt: skip
"""Factors that are taken for that between rev/min and 1/s."""


class Stage(NamedTuple):
    """Ratio of the speeds of two bodies (ступень).

    Attributes
    ----------
    first, last : str
    formula : str
        Of the ratio, or of the inverse one.
    is_inverse : bool
    answer : str
        Name of the answer that it is, if any.
    """

    first: str
    last: str
    formula: str
    is_inverse: bool = False
    answer: str = ""

    def of(self, speed: str) -> str:
        """Return the speed of the last body from that of the first."""
        return f"{speed} {'*' if self.is_inverse else '/'} ({self.formula})"


def relations_of(motion: TrainMotion, names: Sequence[str]) -> Relations:
    """Return the relations of the requested quantities of a train."""
    return _RelationWriter(motion, names).write()


class _RelationWriter:
    def __init__(self, motion: TrainMotion, names: Sequence[str]) -> None:
        self.motion, self.train = motion, motion.train
        known = tuple(self.train.body_of)
        self.asked = {name: parse(name, known) for name in names}
        self.terms: dict[str, RelationTerm] = {}
        self.keys: dict[tuple[str, str], str] = {}
        self.instead: dict[str, dict[str, str]] = {}
        for label, size in motion.axes.sizes.items():
            if label in self.train.wheels:
                letter = "z" if self.train.counted(label) else "r"
                self._key(("size", label), RelationTerm(float(size), f"{letter}_{{{label}}}"))
        for label in motion.axes.sizes:
            if ("size", label) in self.keys:
                others = (self.keys["size", other] for other in self._list_alternatives(label))
                self.instead[self.keys["size", label]] = dict.fromkeys(others, "G4")
        self.one = self._key(("one", ""), RelationTerm(1.0, "1", code="G3"))
        self.earlier: list[str] = []

    def _key(self, of: tuple[str, str], term: RelationTerm) -> str:
        key = self.keys.setdefault(of, f"x{len(self.keys)}")
        self.terms.setdefault(key, term)
        return key

    def _list_alternatives(self, label: str) -> list[str]:
        """Return the other wheels of a stage, and the other rims of a wheel's body."""
        meshes = [mesh for mesh in self.train.meshes if label in (mesh.first, mesh.second)]
        carriers = {self._carrier(mesh) for mesh in meshes}
        bodies = {body for mesh in self.train.meshes if self._carrier(mesh) in carriers
                  for body in self.train.ends(mesh)} | {self.train.body_of[label]}  # fmt: skip
        return [
            other
            for of, other in self.keys
            if of == "size" and other != label and self.train.body_of[other] in bodies
        ]

    def write(self) -> Relations:
        """Return the relations, each that gives the exact value."""
        found: dict[tuple[str, str], Relation] = {}
        for name, asked in self.asked.items():
            stages = [*self._by_meshes(), *self._by_carriers()]
            self.stages = [*stages, *self._by_closing(stages)]
            for formula, is_usual in self._formulas(name, asked):
                made = Relation(name, formula, CODES, is_usual)
                found.setdefault((name, formula), made)
            self.earlier.append(name)
        speeds = [key for (of, _), key in self.keys.items() if of == "speed"]
        for key in speeds:
            self.instead[key] = {other: "slip" for other in speeds if other != key}
        return Relations(self.terms, tuple(found.values()), self.instead)

    def _formulas(self, name: str, quantity: RequestedQuantity) -> Iterator[tuple[str, bool]]:
        body_of = self.train.body_of
        if quantity.kind == "U":
            one, other = (body_of[label] for label in quantity.labels)
            carrier = None if quantity.carrier is None else body_of[quantity.carrier]
            yield from self._ratios(name, one, other, carrier)
        if quantity.kind not in SPEEDS:
            return
        body = body_of[quantity.labels[0]]
        if quantity.carrier is not None:
            yield self._relative(body, body_of[quantity.carrier]), False
        elif quantity.kind == self.train.unit:
            yield from self._speed_formulas(body)
        elif self._name_of(body):
            yield f"{self._turn()} * {self._speed(body)}", True
        else:
            for formula, is_usual in self._speed_formulas(body):
                yield f"{self._turn()} * ({formula})", is_usual

    # Terms -----------------------------------------------------------------------------------

    def _name_of(self, body: str) -> str:
        """Return the name of the answer that is a body's speed, in the unit of the inputs."""
        return next(
            (
                name
                for name, asked in self.asked.items()
                if asked.kind == self.train.unit
                and asked.carrier is None
                and self.train.body_of[asked.labels[0]] == body
            ),
            "",
        )

    def _is_known(self, body: str, earlier: Sequence[str] | None = None) -> bool:
        name = self._name_of(body)
        told = bool(name) if earlier is None else name in earlier
        return told or body in self.train.inputs or body in self.train.fixed

    def _speed(self, body: str) -> str:
        """Return the key of a body's speed; empty for a fixed one."""
        if body in self.train.fixed:
            return ""
        name = self._name_of(body)
        label = self.asked[name].labels[0] if name else body
        symbol = RequestedQuantity(self.train.unit, (label,)).symbol
        code = "G3" if body in self.train.carriers else ""
        value = float(self.motion.speeds[body])
        return self._key(("speed", body), RelationTerm(value, symbol, name, code, turns=True))

    def _relative(self, body: str, carrier: str) -> str:
        """Return the formula of a speed seen from a carrier."""
        speed, carried = self._speed(body), self._speed(carrier)
        if body in self.motion.roles.transverse:
            return speed
        return f"({speed} - {carried})" if speed and carried else speed or f"-{carried}"

    def _turn(self) -> str:
        right = [*TURN][self.train.unit != "n"]
        keys = {
            text: self._key(("turn", text), RelationTerm(value, text, code="S2"))
            for text, value in TURN.items()
        }
        self.instead[keys[right]] = {key: "S2" for text, key in keys.items() if text != right}
        return keys[right]

    # Stages ----------------------------------------------------------------------------------

    def _chain(self, first: str, last: str, carrier: str | None) -> tuple[int, str] | None:
        """Return the sign and size of the ratio of two bodies by meshes on a carrier.

        An answer before is taken for it.
        """
        for name in self.earlier if carrier is not None else ():
            asked = self.asked[name]
            if asked.kind == "U" and asked.carrier is not None:
                bodies = [self.train.body_of[label] for label in (*asked.labels, asked.carrier)]
                if bodies[2] == carrier and {*bodies[:2]} == {first, last}:
                    key = self._ratio_key(name)
                    return 1, key if bodies[0] == first else f"({self.one} / {key})"
        ways: dict[str, tuple[Mesh, ...]] = {first: ()}
        todo = [first]
        for body in todo:
            for mesh in self.train.meshes:
                ends = self.train.ends(mesh)
                if body in ends and self._carrier(mesh) == carrier:
                    far = ends[ends[0] == body]
                    if far not in ways:
                        ways[far] = (*ways[body], mesh)
                        todo.append(far)
        if not ways.get(last):
            return None
        sign, body, quotients = 1, first, list[tuple[str, str]]()
        for mesh in ways[last]:
            ends = self.train.ends(mesh)
            is_first = ends[0] == body
            near, far = (mesh.first, mesh.second) if is_first else (mesh.second, mesh.first)
            row = mesh_row(self.train, self.motion.roles, self.motion.axes, mesh)
            body = ends[is_first]
            sign = -sign if row[ends[0]] * row[ends[1]] > 0 else sign
            if ("size", near) not in self.keys or ("size", far) not in self.keys:
                return None
            if quotients and quotients[-1][0] == near:  # an idle wheel
                quotients[-1] = far, quotients[-1][1]
            else:
                quotients.append((far, near))
        texts = (f"{self.keys['size', z]} / {self.keys['size', by]}" for z, by in quotients)
        return sign, " * ".join(f"({text})" for text in texts)

    def _carrier(self, mesh: Mesh) -> str | None:
        """Return the body that carries the axes of a mesh; None if it is fixed."""
        carrier = self.train.carrier(mesh)
        return None if carrier in self.train.fixed else carrier

    def _by_meshes(self) -> Iterator[Stage]:
        for one in self.train.bodies:
            for other in self.train.bodies:
                found = None if one == other else self._chain(one, other, None)
                if found is not None:
                    yield Stage(one, other, _signed(*found))

    def _by_carriers(self) -> Iterator[Stage]:
        for carrier in self.train.carriers:
            for still in self.train.fixed:
                for body in self.train.bodies:
                    found = None if body == still else self._chain(body, still, carrier)
                    if found is None or body in self.motion.roles.transverse:
                        continue
                    sign, size = found
                    formula = f"{self.one} {'-' if sign > 0 else '+'} {size}"
                    yield Stage(body, carrier, formula)
                    yield Stage(carrier, body, formula, is_inverse=True)

    def _by_closing(self, stages: Sequence[Stage]) -> Iterator[Stage]:
        """Yield the ratios of a differential whose bodies are joined by other stages too."""
        stages = [*self._asked_stages(self.earlier), *stages]
        for carrier in self.train.carriers:
            for one in self.train.bodies:
                for other in self.train.bodies:
                    moving = not {one, other, carrier} & self.train.fixed
                    across = {one, other} & self.motion.roles.transverse
                    found = None if one == other else self._chain(one, other, carrier)
                    if found is None or not moving or across or carrier in (one, other):
                        continue
                    minus, size = "-" if found[0] > 0 else "+", found[1]
                    path = self._find_path(other, carrier, [s for s in stages if one not in s[:2]])
                    if path:
                        closed = f"{minus} {size} * ({self.one} - {_product(path)})"
                        yield Stage(one, carrier, f"{self.one} {closed}")
                    path = self._find_path(other, one, [s for s in stages if carrier not in s[:2]])
                    if path:
                        whole = f"{self.one} {minus} {size} * ({_product(path)})"
                        yield Stage(one, carrier, f"({self.one} {minus} {size}) / ({whole})")

    def _ratio_key(self, name: str) -> str:
        value = answer(self.motion, name).value or math.nan
        return self._key(("U", name), RelationTerm(value, self.asked[name].symbol, name))

    def _asked_stages(self, names: Sequence[str]) -> Iterator[Stage]:
        for name in names:
            asked = self.asked[name]
            if asked.kind == "U" and asked.carrier is None:
                one, other = (self.train.body_of[label] for label in asked.labels)
                key = self._ratio_key(name)
                yield Stage(one, other, key, answer=name)
                yield Stage(other, one, key, is_inverse=True, answer=name)

    def _find_path(self, first: str, last: str, stages: Sequence[Stage]) -> tuple[Stage, ...]:
        """Return the fewest stages from one body to another; the first ones before others."""
        ways: dict[str, tuple[Stage, ...]] = {first: ()}
        todo = [first]
        for body in todo:
            for stage in stages:
                if stage.first == body and stage.last not in ways:
                    ways[stage.last] = (*ways[body], stage)
                    todo.append(stage.last)
        return ways.get(last, ())

    # Ratios ----------------------------------------------------------------------------------

    def _ratios(
        self, name: str, first: str, last: str, carrier: str | None
    ) -> Iterator[tuple[str, bool]]:
        if carrier is not None:
            found = self._chain(first, last, None if carrier in self.train.fixed else carrier)
            if found is not None:
                yield _signed(*found), True
            known = all(map(self._is_known, (first, last, carrier)))
            if known and last not in self.train.fixed:
                above, below = self._relative(first, carrier), self._relative(last, carrier)
                yield f"{above} / {below}", False
            return
        asked = [*self._asked_stages(self.earlier)]
        later = [key for key in self.asked if key not in (name, *self.earlier)]
        others = [*self._asked_stages(later)]
        for stages, is_usual in (([*asked, *self.stages], True), ([*others, *self.stages], False)):
            path = self._find_path(first, last, stages)
            if path and (is_usual or any(stage.answer for stage in path)):
                yield _product(path), is_usual
        if self._is_known(first) and self._is_known(last) and not {first, last} & self.train.fixed:
            yield f"{self._speed(first)} / {self._speed(last)}", False

    # Speeds ----------------------------------------------------------------------------------

    def _speed_formulas(self, body: str) -> Iterator[tuple[str, bool]]:
        asked = [*self._asked_stages(self.earlier)]
        found: list[tuple[str, bool]] = []
        for stage in (*asked, *self.stages):
            is_own = stage.last == body and stage.first not in self.train.fixed
            if is_own and self._is_known(stage.first):
                is_usual = self._is_known(stage.first, self.earlier) and bool(stage.answer)
                found.append((stage.of(self._speed(stage.first)), is_usual))
        if not found:
            for source in self.train.inputs:
                path = self._find_path(source, body, [*asked, *self.stages])
                if path:
                    found.append((f"{self._speed(source)} / ({_product(path)})", True))
        yield from found
        yield from ((formula, False) for formula in self._by_willis(body))

    def _by_willis(self, body: str) -> Iterator[str]:
        """Yield a speed by two others of a moving carrier's stage (формула Виллиса)."""
        for carrier in self.train.carriers:
            if carrier in self.train.fixed:
                continue
            carried = self._speed(carrier)
            for other in self.train.bodies:
                still = other == body or other in self.train.fixed  # that is a stage
                found = None if still else self._chain(body, other, carrier)
                if found is not None and self._is_known(other):
                    sign, size = found
                    turned = self._relative(other, carrier)
                    if body in self.motion.roles.transverse:
                        yield f"{'-' if sign < 0 else ''}{turned} * {size}"
                    else:
                        yield f"{carried} {'-' if sign < 0 else '+'} {turned} * {size}"
            if body == carrier:
                yield from self._carrier_speeds(carrier)

    def _carrier_speeds(self, carrier: str) -> Iterator[str]:
        """Yield the speed of a carrier by two bodies on it."""
        for one in self.train.bodies:
            for other in self.train.bodies:
                known = self._is_known(one) and self._is_known(other)
                still = {one, other} & self.train.fixed or one == other
                found = self._chain(one, other, carrier) if known and not still else None
                if found is None or {one, other} & self.motion.roles.transverse:
                    continue
                sign, size = found
                minus = "-" if sign > 0 else "+"
                first, second = self._speed(one), self._speed(other)
                yield f"({first} {minus} {second} * {size}) / ({self.one} {minus} {size})"


def _signed(sign: int, size: str) -> str:
    return size if sign > 0 else f"-{size}"


def _product(path: Sequence[Stage]) -> str:
    """Return the product of stages, the inverse ones below the line."""
    above = [f"({stage.formula})" for stage in path if not stage.is_inverse]
    below = [f"({stage.formula})" for stage in path if stage.is_inverse]
    return " / ".join([" * ".join(above) or "1", *below])
