"""Ratios and speeds derived as the textbook does: stages, Willis, elimination (вывод отношений).

A ratio is a path of stages between two bodies: meshes with fixed axes, sets with a fixed wheel
(``1 - U_13`` with the carrier fixed), and differentials closed by a chain. Speeds without a path
follow from the formula of Willis.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from fractions import Fraction
from itertools import pairwise, permutations

from msgspec import Struct
from msgspec.structs import replace

from planmethod.errors import PlanMethodError
from planmethod.gears.model import Mesh, MeshKind, RequestedQuantity, parse
from planmethod.gears.motion import TrainKind, TrainMotion, mesh_row
from planmethod.note.formula import Rich, fraction
from planmethod.note.numbers import MINUS, raised
from planmethod.note.wording import Language, MessageTable, get_language

_ONE = Fraction(1)


class DerivationLine(Struct, frozen=True):
    """A line of a derivation: a formula, or a sentence (строка вывода)."""

    text: Rich
    is_formula: bool = True


class Stage(Struct, frozen=True):
    """A ratio of the speeds of two bodies that is known by itself (ступень).

    Attributes
    ----------
    first, second : str
        Bodies: the ratio is that of the first to the second.
    labels : (str, str)
        Labels that name the ratio.
    ratio : Fraction
    tops, bottoms : tuple of str
        Wheels whose teeth are multiplied and divided; empty for a set.
    carrier : str or None
        The carrier relative to which the ratio is taken.
    lines : tuple of DerivationLine
        Derivation, line by line; empty for a mesh.
    """

    first: str
    second: str
    labels: tuple[str, str]
    ratio: Fraction
    tops: tuple[str, ...] = ()
    bottoms: tuple[str, ...] = ()
    carrier: str | None = None
    lines: tuple[DerivationLine, ...] = ()

    @property
    def symbol(self) -> Rich:
        """``U_{12}``, ``U^{(H)}_{13}``."""
        return RequestedQuantity("U", self.labels, self.carrier).symbol


def derivation(motion: TrainMotion, language: Language) -> list[DerivationLine]:
    """Return the derivation of the requested ratios and speeds, line by line.

    Raises
    ------
    PlanMethodError
        A derived value differs from the one that the mesh equations give: an internal error.
    """
    known = tuple(motion.train.body_of)
    asked = [parse(name, known) for name in dict.fromkeys(motion.train.ask)]
    teller = _Derivation(motion, language)
    lines = [line for one in asked if one.kind == "U" for line in teller.ratio(one)]
    speeds = [one for one in asked if one.kind == motion.train.unit and not one.carrier]
    return lines + [line for one in speeds for line in teller.speed(one.labels[0])]


def find_stages(motion: TrainMotion) -> list[Stage]:
    """Return the stages of a train one after another, from its input to its last link.

    They are one fewer than the links with fixed axes; none of a differential, closed or not, or
    where the stages do not follow one another.
    """
    train, roles = motion.train, motion.roles
    around = {body for bodies in roles.planets.values() for body in bodies}
    links = [b for b in train.bodies if b not in {*around, *train.fixed, *train.racks}]
    sources = [body for body in train.inputs if body in links]
    is_plain = motion.structure.kind in (TrainKind.ORDINARY, TrainKind.PLANETARY)
    if not is_plain or motion.structure.mobility != 1 or len(sources) != 1:
        return []
    stages = _Derivation(motion, get_language("en")).stages
    ways = (find_path(stages, sources[0], body) for body in links)
    return next((way for way in ways if len(way) == len(links) - 1), [])


def by_speeds(motion: TrainMotion, quantity: RequestedQuantity, language: Language) -> Rich:
    """Return a ratio in letters of speeds and its value: ``U_{15} = n_1/n_5 = -33``."""
    hat = f"^{{({quantity.carrier})}}" if quantity.carrier else ""
    letters = (f"{motion.train.letter}{hat}_{{{label}}}" for label in quantity.labels)
    one, other = (motion.speed(label, quantity.carrier) for label in quantity.labels)
    ratio = one / other if motion.has_sign(*quantity.labels) else abs(one / other)
    return f"{quantity.symbol} = {fraction(*letters)} = {_value(ratio, language)}"


class _Derivation:
    """Derives one quantity after another; a line written once is not repeated."""

    def __init__(self, motion: TrainMotion, language: Language) -> None:
        self.motion, self.train, self.language = motion, motion.train, language
        self.texts: MessageTable = language.gears["derived"]
        self._written: set[Rich] = set()
        fixed = self.train.fixed
        self.moving = [c for c in self.train.carriers if c not in fixed]
        self.stages = [
            stage
            for mesh in self.train.meshes
            if self.train.carrier(mesh) not in self.moving
            for stage in self._both(mesh, None)
        ]
        for carrier in self.moving:
            self.stages += self._fixed_wheel_stages(carrier)
        self._close()
        self.speeds = dict(self.train.inputs) | dict.fromkeys(fixed, Fraction(0))

    # Ratios known by themselves -------------------------------------------------------------------

    def _both(self, mesh: Mesh, carrier: str | None) -> Iterator[Stage]:
        """Yield the ratio of a mesh, seen from its carrier, in both directions."""
        if mesh.kind is MeshKind.RACK:
            return
        row = mesh_row(self.train, self.motion.roles, self.motion.axes, mesh)
        ends, labels = self.train.ends(mesh), (mesh.first, mesh.second)
        ratio = -row[ends[1]] / row[ends[0]]
        yield Stage(*ends, labels, ratio, (labels[1],), (labels[0],), carrier)
        back = ends[::-1]
        yield Stage(*back, labels[::-1], 1 / ratio, (labels[0],), (labels[1],), carrier)

    def _carrier_stages(self, carrier: str) -> list[Stage]:
        return [
            stage
            for mesh in self.train.meshes
            if self.train.carrier(mesh) == carrier
            for stage in self._both(mesh, mesh.carrier)
        ]

    def _fixed_wheel_stages(self, carrier: str) -> Iterator[Stage]:
        """Yield the ratios of wheels to a carrier on whose set a wheel is fixed."""
        stages = self._carrier_stages(carrier)
        fixed = next((s.first for s in stages if s.first in self.train.fixed), None)
        if fixed is None:
            return
        for body in dict.fromkeys(stage.first for stage in stages):
            if body == fixed or body in self.motion.roles.transverse:
                continue
            path = find_path(stages, body, fixed)
            whole = self._combined(path)
            if not path or whole.ratio == 1:
                continue
            label, held = _number(whole.labels[0]), path[0].carrier or carrier
            symbol = _symbol(label, held)
            less = f"1 − {whole.symbol}"
            teeth, numbers = (f"1 {_plus(*parts)}" for parts in self._signed(whole))
            told, ratio = tuple(self._product(path)), 1 - whole.ratio
            line = DerivationLine(
                f"{symbol} = {less} = {teeth} = {numbers} = {_value(ratio, self.language)}"
            )
            yield Stage(body, carrier, (label, held), ratio, lines=(*told, line))
            under = [fraction("1", text) for text in (symbol, less, teeth, numbers)]
            line = DerivationLine(
                " = ".join([_symbol(held, label), *under, _value(1 / ratio, self.language)])
            )
            yield Stage(carrier, body, (held, label), 1 / ratio, lines=(*told, line))

    def _close(self) -> None:
        """Find the ratios of differentials that a chain closes, until there are no more."""
        open_ = [c for c in self.moving if not any(s.second == c and s.lines for s in self.stages)]
        while True:
            found = next(
                ((c, made) for c in open_ if (made := self._eliminated(c))),
                None,
            )
            if found is None:
                return
            open_.remove(found[0])
            self.stages += found[1]

    def _eliminated(self, carrier: str) -> list[Stage]:
        """Return the ratio of a wheel of a differential to its carrier, and its inverse."""
        stages, across = self._carrier_stages(carrier), self.motion.roles.transverse
        around = self.motion.roles.planets[carrier]
        central = [b for b in dict.fromkeys(s.first for s in stages) if b not in (*across, *around)]
        for p, q in permutations(central, 2):
            path = find_path(stages, p, q)
            whole, held = self._combined(path), path[0].carrier if path else None
            if held is None:
                continue
            u, symbol = whole.ratio, whole.symbol
            p_c, letter = _symbol(_number(whole.labels[0]), held), self.train.letter
            n_p, n_q, n_c = (f"{letter}_{{{_number(x)}}}" for x in (*whole.labels, held))
            seen = fraction(f"{n_p} − {n_c}", f"{n_q} − {n_c}")
            willis = f"{symbol} = {seen}"
            if chain := find_path(self.stages, q, carrier):  # n_q = r n_H
                r, link = self._linked(chain)
                closing, ratio = f"{n_q} = {link}·{n_c}", u * (r - 1) + 1
                below = (f"{link}·{n_c} − {n_c}", f"{link} − 1")
                hence = f"{symbol}·({link} − 1) + 1"
                numbers = f"{_built(u)}·({_built(r)} − 1) + 1"
            elif chain := find_path(self.stages, q, p):  # n_q = r n_p
                r, link = self._linked(chain)
                if u * r == 1 or u == 1:
                    continue
                closing, ratio = f"{n_q} = {link}·{n_p}", (u - 1) / (u * r - 1)
                below = (f"{link}·{n_p} − {n_c}", f"{link}·{p_c} − 1")
                hence = fraction(f"{symbol} − 1", f"{symbol}·{link} − 1")
                shown = _built(u)
                numbers = fraction(f"{shown} − 1", f"{shown}·{_factor(r)} − 1")
            else:
                continue
            if not ratio:
                continue
            texts, wheels = self.texts, ", ".join(map(_number, whole.labels))
            shares = [fraction(f"{n_p} − {n_c}", below[0]), fraction(f"{p_c} − 1", below[1])]
            divided = f"{symbol} = {' = '.join(shares)}"
            told = (
                DerivationLine(
                    texts.willis.format(wheels=wheels, carrier=held, formula=willis), False
                ),
                DerivationLine(texts.closing.format(formula=closing), False),
                DerivationLine(texts.divided.format(speed=n_c), False),
                DerivationLine(divided),
                DerivationLine(texts.hence.format(formula=f"{p_c} = {hence}"), False),
                *self._product(path),
                *self._explained(chain, link),
                DerivationLine(f"{p_c} = {numbers} = {_value(ratio, self.language)}"),
            )
            label, inverse = _number(whole.labels[0]), _value(1 / ratio, self.language)
            back = DerivationLine(f"{_symbol(held, label)} = {fraction('1', p_c)} = {inverse}")
            return [
                Stage(p, carrier, (label, held), ratio, lines=told),
                Stage(carrier, p, (held, label), 1 / ratio, lines=(*told, back)),
            ]
        return []

    # Writing --------------------------------------------------------------------------------------

    def ratio(self, quantity: RequestedQuantity) -> Iterator[DerivationLine]:
        """Yield the derivation of a ratio; letters and value alone where no stages lead to it."""
        train = self.train
        one, other = (train.body_of[label] for label in quantity.labels)
        if {one, other} & train.racks or not self.motion.speed(
            quantity.labels[1], quantity.carrier
        ):
            return
        exact = self.motion.speed(quantity.labels[0], quantity.carrier) / self.motion.speed(
            quantity.labels[1], quantity.carrier
        )
        if quantity.carrier is None:
            path = find_path(self.stages, one, other)
        else:
            path = find_path(self._carrier_stages(train.body_of[quantity.carrier]), one, other)
        has_sign = self.motion.has_sign(*quantity.labels)
        if not path:
            yield DerivationLine(by_speeds(self.motion, quantity, self.language))
        else:
            self._check(quantity.symbol, self._combined(path).ratio, exact)
            path = path if has_sign else _sizes(path)
            yield from self._once(self._explained(path, quantity.symbol))
        if not has_sign:
            yield from self._once([self._signless(quantity.symbol, quantity.labels)])
        elif (
            path
            and quantity.carrier is None
            and len(path) > 1
            and not {one, other} & self.motion.roles.transverse
        ):
            first, last = quantity.labels
            sense = str(self.texts["senses"]["same" if exact > 0 else "other"])
            yield DerivationLine(sense.format(symbol=quantity.symbol, one=first, other=last), False)

    def _signless(self, symbol: Rich, labels: Sequence[str]) -> DerivationLine:
        """Return the sentence on a ratio whose bodies turn about axes that are not parallel."""
        one, other = map(_number, labels)
        return DerivationLine(
            self.texts.signless.format(symbol=symbol, one=one, other=other), False
        )

    def _once(self, lines: Iterable[DerivationLine]) -> Iterator[DerivationLine]:
        for line in lines:
            if line.text not in self._written:
                self._written.add(line.text)
                yield line

    def _explained(self, path: Sequence[Stage], symbol: Rich) -> Iterator[DerivationLine]:
        """Yield how the ratio of a path is found."""
        if not any(stage.lines for stage in path):
            yield from self._product(path, symbol)
            return
        if len(path) == 1:
            yield from path[0].lines
            if symbol != path[0].symbol:
                yield DerivationLine(
                    f"{symbol} = {path[0].symbol} = {_value(path[0].ratio, self.language)}"
                )
            return
        product = "·".join(stage.symbol for stage in path)
        yield DerivationLine(f"{symbol} = {product}")
        for stage in path:
            yield from stage.lines or self._product([stage])
        numbers = "·".join(_factor(s.ratio, first=not k) for k, s in enumerate(path))
        yield DerivationLine(
            f"{symbol} = {numbers} = {_value(self._combined(path).ratio, self.language)}"
        )

    def _product(self, path: Sequence[Stage], symbol: Rich = "") -> Iterator[DerivationLine]:
        """Yield the ratio of meshes one after another in teeth: what cancels, and the number."""
        whole = self._combined(path)
        symbol = symbol or whole.symbol
        chain = [symbol]
        if len(path) > 1:
            chain.append("·".join(stage.symbol for stage in path))
            parts = (self._signed(stage)[0] for stage in path)
            chain.append("·".join(f"({sign}{text})" for sign, text in parts))
        elif symbol != path[0].symbol:
            chain.append(path[0].symbol)
        chain += [sign + text for sign, text in self._signed(whole)]
        shown = _value(whole.ratio, self.language)
        if chain[-1] == shown.partition(" = ")[0]:
            chain.pop()
        yield DerivationLine(" = ".join([*chain, shown]))
        idle = [label for one, two in pairwise(path) for label in {one.labels[1]} & {two.labels[0]}]
        if idle:
            form = "one" if len(idle) == 1 else "many"
            phrase = str(self.texts["idlers"][form])
            yield DerivationLine(phrase.format(labels=", ".join(idle), symbol=symbol), False)

    def _combined(self, path: Sequence[Stage]) -> Stage:
        """Return a path as one stage: wheels that are both above and below cancel."""
        if not path:
            return Stage("", "", ("", ""), _ONE)
        tops = [label for stage in path for label in stage.tops]
        bottoms = [label for stage in path for label in stage.bottoms]
        for label in tuple(tops):
            if label in bottoms:
                tops.remove(label)
                bottoms.remove(label)
        ratio = _ONE
        for stage in path:
            ratio *= stage.ratio
        labels = (path[0].labels[0], path[-1].labels[1])
        ends = (path[0].first, path[-1].second)
        return Stage(*ends, labels, ratio, tuple(tops), tuple(bottoms), path[0].carrier)

    def _signed(self, stage: Stage) -> list[tuple[str, Rich]]:
        """Return the sign and the size of a ratio in letters, and the same in numbers."""
        sign = MINUS if stage.ratio < 0 else ""
        texts = []
        for of in (self._letter, self._size):
            above, below = ("·".join(map(of, labels)) for labels in (stage.tops, stage.bottoms))
            texts.append((sign, fraction(above or "1", below) if below else above or "1"))
        return texts

    def _letter(self, label: str) -> Rich:
        return f"{'z' if self.train.counted(label) else 'r'}_{{{label}}}"

    def _size(self, label: str) -> Rich:
        size = self.motion.axes.sizes[label]
        per = _ONE if self.train.counted(label) else self.train.unit_m * self.train.per_m
        return self.language.notation.as_input(float(size * per))

    def _linked(self, chain: Sequence[Stage]) -> tuple[Fraction, Rich]:
        whole = self._combined(chain)
        return whole.ratio, whole.symbol

    def _check(self, symbol: Rich, derived: Fraction, exact: Fraction) -> None:
        if derived != exact:
            raise PlanMethodError(
                "the derivation gives {} = {}, the mesh equations {}; please report the problem "
                "file",
                symbol,
                derived,
                exact,
            )

    # Speeds ---------------------------------------------------------------------------------------

    def speed(self, label: str) -> Iterator[DerivationLine]:
        """Yield the derivation of a speed: by a ratio to a known one, else by Willis."""
        body = self.train.body_of[label]
        if body in self.speeds or body in self.train.racks or body in self.motion.roles.transverse:
            return
        yield from self._once(self._speed_lines(label, body, 2 * len(self.train.bodies)))

    def _speed_lines(self, label: str, body: str, depth: int) -> Iterator[DerivationLine]:
        """Yield the derivation of a speed; for planets as in the textbook, by Willis first."""
        ways = [self._by_ratio, self._by_willis]
        if any(body in around for around in self.motion.roles.planets.values()):
            ways.reverse()
        for way in ways:
            if body not in self.speeds:
                yield from way(label, body, depth)

    def _by_ratio(self, label: str, body: str, _: int) -> Iterator[DerivationLine]:
        letter = self.train.letter
        for source in [b for b, v in self.speeds.items() if v]:
            path = find_path(self.stages, source, body)
            if not path:
                continue
            whole, n = self._combined(path), self.speeds[source]
            top = f"{letter}_{{{_number(source)}}}"
            if not self.motion.has_sign(source, body):
                yield from self._explained(_sizes(path), whole.symbol)
                yield self._signless(whole.symbol, whole.labels)
                sizes = fraction(_built(abs(n)), _built(abs(whole.ratio)))
                is_less = n < 0 or whole.ratio < 0
                formula = fraction(f"|{top}|" if is_less else top, whole.symbol)
                derived = n / whole.ratio
                yield self._speed(label, body, (formula, sizes), derived, is_size=is_less)
                return
            yield from self._explained(path, whole.symbol)
            formula = fraction(top, whole.symbol)
            is_whole = whole.ratio.denominator == 1
            numbers = fraction(_built(n), (_factor if is_whole else _built)(whole.ratio))
            yield self._speed(label, body, (formula, numbers), n / whole.ratio)
            return

    def _by_willis(self, label: str, body: str, depth: int) -> Iterator[DerivationLine]:
        for carrier in self.moving:
            stages = self._carrier_stages(carrier)
            bodies = dict.fromkeys(
                s.first for s in stages if s.first not in self.motion.roles.transverse
            )
            if body == carrier:
                known = [b for b in bodies if b in self.speeds]
                for one, two in permutations(known, 2):
                    path = find_path(stages, one, two)
                    if path and self._combined(path).ratio != 1:
                        yield from self._carrier(label, body, path)
                        return
            elif body in bodies:
                if carrier not in self.speeds and depth:
                    yield from self._speed_lines(_number(carrier), carrier, depth - 1)
                known = sorted(bodies, key=lambda b: b not in self.train.fixed)
                for one in known if carrier in self.speeds else ():
                    if one in self.speeds and find_path(stages, body, one):
                        yield from self._wheel(label, body, carrier, one)
                        return

    def _carrier(self, label: str, body: str, path: Sequence[Stage]) -> Iterator[DerivationLine]:
        """Yield the speed of a carrier by those of two of its wheels."""
        whole, n = self._combined(path), self._letter_of(label)
        u, p, q = whole.ratio, self.speeds[path[0].first], self.speeds[path[-1].second]
        n_p, n_q = (self._letter_of(b) for b in (path[0].first, path[-1].second))
        yield from self._product(path)
        yield DerivationLine(f"{whole.symbol} = {fraction(f'{n_p} − {n}', f'{n_q} − {n}')}")
        formula = fraction(f"{n_p} − {whole.symbol}·{n_q}", f"1 − {whole.symbol}")
        above = f"{_built(p)} − {_factor(u)}·{_factor(q)}"
        numbers = fraction(above, f"1 {_plus(*_split(u))}")
        yield self._speed(label, body, (formula, numbers), (p - u * q) / (1 - u))

    def _wheel(
        self, label: str, body: str, carrier: str, reference: str
    ) -> Iterator[DerivationLine]:
        """Yield the speed of a wheel on a carrier by those of the carrier and another wheel.

        The ratio is the requested one, if any; else that to the other wheel.
        """
        stages, known = self._carrier_stages(carrier), tuple(self.train.body_of)
        asked = [parse(name, known).symbol for name in self.train.ask]
        path = find_path(stages, reference, body)
        is_asked = self._combined(path).symbol in asked
        if not is_asked:
            path = find_path(stages, body, reference)
        whole, n = self._combined(path), self._letter_of(label)
        n_c, n_q = (self._letter_of(b) for b in (carrier, reference))
        c, q, u = self.speeds[carrier], self.speeds[reference], whole.ratio
        yield from self._product(path)
        ways = [f"{n} − {n_c}", f"{n_q} − {n_c}"]
        yield DerivationLine(f"{whole.symbol} = {fraction(*(ways[::-1] if is_asked else ways))}")
        less = f"{_built(q)} {_plus(*_split(c))}"
        if is_asked:
            sides = [fraction(ways[1], whole.symbol), fraction(less, _built(u))]
        else:
            sides = [f"{whole.symbol}·({ways[1]})", f"{_factor(u)}·({less})"]
        formulas = (f"{n_c} + {sides[0]}", f"{_built(c)} + {sides[1]}")
        yield self._speed(label, body, formulas, c + ((q - c) / u if is_asked else u * (q - c)))

    def _letter_of(self, body: str) -> Rich:
        return f"{self.train.letter}_{{{_number(body)}}}"

    def _speed(
        self,
        label: str,
        body: str,
        sides: Iterable[Rich],
        derived: Fraction,
        *,
        is_size: bool = False,
    ) -> DerivationLine:
        """Return a speed with its formula, and keep it for the next; its size if it has no sign."""
        unit = raised(self.language.gears["units"][self.train.units[0]])
        symbol = f"{self.train.letter}_{{{label}}}"
        self._check(symbol, derived, self.motion.speeds[body])
        self.speeds[body] = derived
        if is_size:
            symbol, derived = f"|{symbol}|", abs(derived)
        value = _value(derived, self.language)
        whole = [side for side in sides if side != value.partition(" = ")[0]]
        return DerivationLine(" = ".join([symbol, *whole, f"{value} {unit}"]))


def _sizes(path: Sequence[Stage]) -> list[Stage]:
    """Return stages whose ratios are sizes, without signs."""
    return [replace(stage, ratio=abs(stage.ratio)) for stage in path]


def find_path(stages: Iterable[Stage], start: str, end: str) -> list[Stage]:
    """Return the fewest stages that lead from a body to another; none where none do."""
    by: dict[str, list[Stage]] = {}
    for stage in stages:
        by.setdefault(stage.first, []).append(stage)
    reached: dict[str, list[Stage]] = {start: []}
    rows = [start]
    while rows and end not in reached:
        rows = [
            stage.second
            for body in rows
            for stage in by.get(body, ())
            if stage.second not in reached
            and reached.setdefault(stage.second, [*reached[body], stage])
        ]
    return reached.get(end, [])


def _value(value: Fraction, language: Language) -> Rich:
    """Return a ratio as a fraction, and as a decimal where it is not whole."""
    if value.denominator == 1:
        return _text(value)
    return f"{_built(value)} = {language.notation.computed(float(value))}"


def _number(label: str) -> str:
    return label.rstrip("'")


def _symbol(first: str, second: str) -> Rich:
    return RequestedQuantity("U", (first, second)).symbol


def _text(value: Fraction) -> str:
    return str(value).replace("-", MINUS)


def _built(value: Fraction) -> Rich:
    """Return a number, as a built-up fraction where it is one."""
    size = abs(value)
    text = _text(size) if size.denominator == 1 else fraction(*map(str, size.as_integer_ratio()))
    return (MINUS if value < 0 else "") + text


def _factor(value: Fraction, *, first: bool = False) -> Rich:
    """Return a number as a further factor: in brackets where it has a sign."""
    return _built(value) if first or value >= 0 else f"({_built(value)})"


def _split(value: Fraction) -> tuple[str, Rich]:
    """Return the sign and the size of a number."""
    return MINUS if value < 0 else "", _built(abs(value))


def _plus(sign: str, text: Rich) -> Rich:
    """Return ``+ text`` if a negative number is subtracted, else ``− text``."""
    return f"+ {text}" if sign == MINUS else f"− {text}"
