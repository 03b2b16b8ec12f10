"""The account of a machine as one chain: motor, train, shaft of the flywheel (привод машины)."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from planmethod.note import formula
from planmethod.note.accounts.voice import Columns, Voice
from planmethod.note.document import Node
from planmethod.note.formula import Rich, escape
from planmethod.note.narrate.machine import MachineNarrator
from planmethod.note.narrate.statement import turns_symbol
from planmethod.note.numbers import with_unit
from planmethod.solved.machine.chain import (
    MachineChain,
    MotorOffer,
    ShaftWheel,
    check_module,
    machine_chain,
)

_ABSENT = "–"
_SAME = 1e-6
"""Share by which the ratio of a shaft may differ from that of the drawn flywheel."""


def chain_of(narrator: MachineNarrator) -> MachineChain | None:
    """Return the chain with the flywheel of the construction; None without ``[[motors]]``."""
    return machine_chain(narrator.flywheel, narrator.drawing.adopted)


class ChainAccount:
    """Sections on the motor, the train and the shaft of the flywheel, in a voice.

    Parameters
    ----------
    narrator : MachineNarrator
    chain : MachineChain
    voice : Voice
    """

    def __init__(self, narrator: MachineNarrator, chain: MachineChain, voice: Voice) -> None:
        self.narrator, self.chain, self.voice = narrator, chain, voice
        self.notation, self.texts = narrator.notation, narrator.texts["chain"]

    def lines(self) -> Iterator[Node]:
        """Yield the formulas and results without the tables, for a sheet and for results."""
        yield from self._motor_results()
        yield from self._ratio()
        yield from self._rotor()
        yield from self.voice.results(*self._choice())

    def sections(self) -> Iterator[Node]:
        """Yield everything, with the tables."""
        for (name, columns), told in zip(
            self.tables(), (self._motors, self._stages, self._shafts), strict=True
        ):
            key = f"chain_{name}"
            yield from told(key)
            if columns:
                yield from self.voice.table(columns, self.texts["tables"][name], key, repeated=1)
        yield from self.voice.results(*self._choice())

    def _motors(self, key: str) -> Iterator[Node]:
        yield from self.voice.statement(self.texts.motors.format(table=self._reference(key)))
        yield from self._motor_results()

    def _stages(self, key: str) -> Iterator[Node]:
        yield from self._ratio()
        if self.chain.stages:
            table = self._reference(key)
            yield from self.voice.statement(self.texts.stages.format(table=table))
            yield from self.voice.results(*self._module_faults())

    def _shafts(self, key: str) -> Iterator[Node]:
        yield from self._rotor()
        if self.chain.slow is not None:
            table = self._reference(key)
            yield from self.voice.statement(self.texts.shafts.format(table=table))

    def _reference(self, key: str) -> Rich:
        template = self.narrator.language.document.in_table
        return self.voice.reference(template, key)

    # Tables ----------------------------------------------------------------------------------

    def tables(self) -> list[tuple[str, Columns]]:
        """Return the tables of motors, of stages and of shafts with their names; empty columns."""
        return [
            ("motors", self._motor_columns()),
            ("stages", self._stage_columns() if self.chain.stages else ()),
            ("shafts", self._shaft_columns()),
        ]

    @property
    def _turns(self) -> Rich:
        """Letters of the rotational speed of the crank."""
        return turns_symbol(self.narrator.flywheel.problem, self.narrator.language)

    def _head(self, unit: str) -> Rich:
        return self.notation.in_head(unit)

    def _motor_columns(self) -> Columns:
        heads, offers, notation = self.texts["heads"], self.chain.offers, self.notation
        speeds = [offer.speed for offer in offers if offer.speed is not None]
        found: list[tuple[Rich, Rich, Sequence[Rich]]] = [
            (heads["motor"], "", [escape(one.motor.name) for one in offers]),
            (
                self.narrator.letter("motor power"), self._head("kW"),
                [notation.as_input(one.motor.power / 1000.0) for one in offers],
            ),
            ("n", self._head("rev/min"), [notation.as_input(one.motor.speed) for one in offers]),
            (
                f"J_{{{heads['rotor']}}}", self._head("kg·m²"),
                [notation.as_input(one.motor.inertia) for one in offers],
            ),
            ("i", "", [notation.computed(one.ratio) for one in offers]),
        ]  # fmt: skip
        if speeds:
            found.append((self._turns, self._head("rev/min"), [*map(notation.computed, speeds)]))
        return [*found, (heads["verdict"], "", [self._verdict(one) for one in offers])]

    def _verdict(self, offer: MotorOffer) -> Rich:
        if offer is self.chain.chosen:
            return str(self.texts["verdicts"]["chosen"])
        key = "suits" if offer.is_suitable else "speed" if offer.is_strong else "weak"
        return str(self.texts["verdicts"][key])

    def _stage_columns(self) -> Columns:
        heads, notation, mm = self.texts["heads"], self.notation, self._head("mm")
        names, teeth, modules = list[Rich](), list[Rich](), list[Rich]()
        pitch, rows = list[Rich](), list[Rich]()
        for labels, counts, module in self.chain.stages:
            names.append("–".join(map(escape, labels)))
            teeth.append("; ".join(_ABSENT if z is None else str(z) for z in counts))
            modules.append(_ABSENT if module is None else notation.as_input(float(module * 1000)))
            pitch.append(
                "; ".join(
                    _ABSENT
                    if z is None or module is None
                    else notation.as_input(float(z * module * 1000))
                    for z in counts
                )
            )
            row = 0 if module is None else check_module(module).row
            rows.append(str(row) if row else _ABSENT)
        return [
            (heads["stage"], "", names), ("z", "", teeth), ("m", mm, modules), ("d", mm, pitch),
            (heads["row"], "", rows),
        ]  # fmt: skip

    def _shaft_columns(self) -> Columns:
        heads, notation, metre = self.texts["heads"], self.notation, self._head("m")
        wheels = [one for one in (self.chain.slow, self.chain.fast) if one is not None]
        if not wheels:
            return ()
        sizes = [one.sizes for one in wheels]
        return [
            (heads["shaft"], "", [self.texts["shaft"][key] for key in ("slow", "fast")]),
            ("i", "", [notation.computed(one.ratio) for one in wheels]),
            ("J", self._head("kg·m²"), [notation.computed(one.inertia) for one in wheels]),
            ("D", metre, [notation.as_input(one.diameter) for one in sizes]),
            ("b", metre, [notation.computed(one.width) for one in sizes]),
            ("m", self._head("kg"), [notation.computed(one.mass) for one in sizes]),
            ("v", self._head("m/s"), [notation.computed(one.speed) for one in sizes]),
            (
                f"M_{{{heads['train']}}}", self._head("N·m"),
                [notation.computed(one.moment) for one in wheels],
            ),
        ]  # fmt: skip

    # Sentences -------------------------------------------------------------------------------

    def _quantity(self, value: float, unit: str) -> Rich:
        return with_unit(self.notation.computed(value), self.narrator.unit(unit))

    def _motor_results(self) -> Iterator[Node]:
        offer, notation = self.chain.chosen, self.notation
        if offer is not None:
            motor = offer.motor
            power = with_unit(notation.as_input(motor.power / 1000.0), self.narrator.unit("kW"))
            speed = with_unit(notation.as_input(motor.speed), self.narrator.unit("rev/min"))
            text = self.texts.chosen.format(name=escape(motor.name), power=power, n=speed)
        else:
            is_weak = not any(one.is_strong for one in self.chain.offers)
            ratio = notation.computed(self.chain.ratio or 0.0)
            text = self.texts["none"]["weak" if is_weak else "speed"].format(ratio=ratio)
        yield from self.voice.results(text)

    def _ratio(self) -> Iterator[Node]:
        chain, notation = self.chain, self.notation
        if chain.chosen is None:
            return
        speeds = notation.as_input(chain.chosen.motor.speed), notation.computed(chain.crank_speed)
        letters = formula.fraction(f"n_{{{self.texts['heads']['of_motor']}}}", self._turns)
        line = (
            f"i = {letters} = {formula.fraction(*speeds)} = {notation.computed(chain.chosen.ratio)}"
        )
        yield from self.voice.statement(self.texts.ratio.format(), [line])
        if chain.chosen.speed is not None and chain.ratio is not None:
            speed = with_unit(notation.computed(chain.chosen.speed), self.narrator.unit("rev/min"))
            ratio = notation.computed(chain.ratio)
            link = self.narrator.flywheel.problem.drive.link
            text = self.texts.by_train.format(ratio=ratio, link=link, speed=speed)
            yield from self.voice.results(text)

    def _module_faults(self) -> Iterator[Rich]:
        for labels, _, module in self.chain.stages:
            name = "–".join(map(escape, labels))
            if module is None:
                yield self.texts.no_module.format(stage=name)
            elif not (found := check_module(module)).row:
                nearest = self.notation.as_input(float(found.nearest * 1000))
                yield self.texts.odd_module.format(
                    stage=name, module=self.notation.as_input(float(module * 1000)),
                    nearest=with_unit(nearest, self.narrator.unit("mm")),
                )  # fmt: skip

    def _rotor(self) -> Iterator[Node]:
        chain, notation = self.chain, self.notation
        if chain.chosen is None or chain.ratio is None or chain.inertia <= 0.0:
            return
        rotor, wheel = f"J_{{{self.texts['heads']['rotor']}}}", self.narrator.letter("flywheel")
        numbers = notation.as_input(chain.chosen.motor.inertia), notation.computed(chain.ratio)
        unit = self.narrator.unit("kg·m²")
        lines = [
            f"{rotor}·i^{{2}} = {numbers[0]}·{numbers[1]}^{{2}} = "
            f"{with_unit(notation.computed(chain.rotor), unit)}"
        ]
        if chain.slow is not None:
            lines.append(
                f"{wheel} − {rotor}·i^{{2}} = {notation.computed(chain.inertia)} − "
                f"{notation.computed(chain.rotor)} = "
                f"{with_unit(notation.computed(chain.slow.inertia), unit)}"
            )
        yield from self.voice.statement(self.texts.rotor.format(), lines)
        if chain.slow is None:
            yield from self.voice.results(self.texts.rotor_enough.format(wheel=wheel))

    def _choice(self) -> Iterator[Rich]:
        """Yield on which shaft the flywheel is, why, and where the sheet has it."""
        chain, best = self.chain, self.chain.lighter
        if best is None or chain.slow is None or chain.fast is None:
            return
        key = "fast" if best is chain.fast else "slow"
        other = chain.slow if best is chain.fast else chain.fast
        yield self.texts["choice"][key].format(
            mass=self._quantity(best.sizes.mass, "kg"),
            other=self._quantity(other.sizes.mass, "kg"),
            moment=self._quantity(chain.fast.moment, "N·m"),
            less=self._quantity(chain.slow.moment, "N·m"),
        )
        if chain.rotor:
            yield self.texts.rest.format(wheel=self.narrator.letter("flywheel"))
        if abs(self._drawn / best.ratio - 1.0) > _SAME:
            yield self.texts.drawn.format(
                ratio=self.notation.short(best.ratio), own=self.notation.as_input(self._drawn)
            )

    @property
    def _drawn(self) -> float:
        """Ratio of the shaft of the flywheel that the file has, and the sheet."""
        return self.narrator.flywheel.machine.wheel.ratio


def shaft_record(wheel: ShaftWheel | None) -> dict[str, float] | None:
    """Return a flywheel on a shaft as plain data, SI; None of one that is not needed."""
    if wheel is None:
        return None
    return {
        "ratio": wheel.ratio,
        "J": wheel.inertia,
        "D": wheel.sizes.diameter,
        "b": wheel.sizes.width,
        "m": wheel.sizes.mass,
        "rim_speed": wheel.sizes.speed,
        "M_train": wheel.moment,
    }
