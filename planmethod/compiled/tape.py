"""Tape of real operations: a program read in symbols, its constants folded (лента)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

from msgspec import Struct, field

from planmethod.construct import steps
from planmethod.construct.arithmetic import Exact, Number, unit_vectors
from planmethod.construct.evaluate import apply, limit_of
from planmethod.construct.program import Program
from planmethod.construct.steps import Name, Step, operands

Ref: TypeAlias = int | float
"""Operand: the number of a node (int), or a constant (float)."""


class Node(NamedTuple):
    """One operation on earlier nodes and constants.

    ``input`` has the number of the input as its only operand; ``cosd`` and ``sind`` take degrees;
    ``at_zero`` has three operands (size, other, value): the other where the size is zero;
    ``above`` is 1 where the first operand is greater than the second, else 0; ``degrees`` of an
    angle in radians are in (-180, 180].
    """

    kind: str
    operands: tuple[Ref, ...]


def _divided(a: float, b: float) -> float:
    if b == 0.0:
        return math.nan if a == 0.0 or math.isnan(a) else math.copysign(math.inf, a)
    return a / b


FOLD: dict[str, Callable[..., float]] = {
    "add": lambda a, b: a + b,
    "sub": lambda a, b: a - b,
    "mul": lambda a, b: a * b,
    "div": _divided,
    "neg": lambda a: -a,
    "abs": abs,
    "sqrt": math.sqrt,
    "min": min,
    "max": max,
    "atan2": math.atan2,
    "degrees": lambda angle: 180.0 if angle <= -math.pi else angle * (180.0 / math.pi),
    "at_zero": lambda size, other, value: other if size == 0.0 else value,
    "above": lambda a, b: 1.0 if a > b else 0.0,
    "floor": lambda a: float(math.floor(a)),
}
"""Functions that fold an operation on constants."""


def same(a: Ref, b: Ref) -> bool:
    """Return whether two operands are the same; node 2 is not the constant 2.0, though equal."""
    return type(a) is type(b) and a == b


def _key(kind: str, operands: tuple[Ref, ...]) -> tuple[Any, ...]:
    nodes = 0  # which operands are nodes: 2 == 2.0
    for operand in operands:
        nodes = 2 * nodes + (type(operand) is int)
    return kind, nodes, *operands


class Tape(Struct):
    """Operations in order, each recorded once.

    An operation on constants is carried out at once, and one that changes nothing (times 1, plus 0,
    a + b - a) is not recorded: the tape has no step that a person would skip.

    Attributes
    ----------
    part : int
        Part of the program that is being written, to which new nodes belong.
    parts : list of int
        Part of every node: the latest of its own and its operands'. Running the parts one after the
        other keeps few values in use, however long the tape is (`used_by`).
    """

    nodes: list[Node] = field(default_factory=list)
    part: int = 0
    parts: list[int] = field(default_factory=list)
    _numbers: dict[tuple[Any, ...], int] = field(default_factory=dict)

    def add_node(self, kind: str, *operands: Ref) -> Ref:
        """Return a node for an operation, an earlier one of the same kind if there is one."""
        if kind in FOLD and all(type(operand) is float for operand in operands):
            return FOLD[kind](*operands)
        key = _key(kind, operands)
        number = self._numbers.get(key)
        if number is None:
            number = self._numbers[key] = len(self.nodes)
            self.nodes.append(Node(kind, operands))
            latest, read = (0, ()) if kind == "input" else (self.part, operands)
            for ref in read:
                if type(ref) is int and self.parts[ref] > latest:
                    latest = self.parts[ref]
            self.parts.append(latest)
        return number

    def input(self, number: int) -> Ref:
        """Return the node of an input."""
        return self.add_node("input", number)

    def _is(self, ref: Ref, kind: str) -> bool:
        return type(ref) is int and self.nodes[ref].kind == kind

    def add(self, a: Ref, b: Ref) -> Ref:
        """Return a + b."""
        if a == 0.0 and type(a) is float:
            return b
        if b == 0.0 and type(b) is float:
            return a
        if self._is(b, "neg"):
            return self.sub(a, self.nodes[int(b)].operands[0])
        if self._is(a, "neg"):
            return self.sub(b, self.nodes[int(a)].operands[0])
        return self.add_node("add", *self._sorted(a, b))

    def sub(self, a: Ref, b: Ref) -> Ref:
        """Return a - b; of a sum less one of its terms, the other term."""
        if b == 0.0 and type(b) is float:
            return a
        if same(a, b):
            return 0.0
        if a == 0.0 and type(a) is float:
            return self.neg(b)
        if self._is(b, "neg"):
            return self.add(a, self.nodes[int(b)].operands[0])
        if self._is(a, "add"):
            one, two = self.nodes[int(a)].operands
            if same(b, one) or same(b, two):
                return two if same(b, one) else one
        if self._is(b, "add"):
            one, two = self.nodes[int(b)].operands
            if same(a, one) or same(a, two):
                return self.neg(two if same(a, one) else one)
        if self._is(a, "sub") and same(b, self.nodes[int(a)].operands[0]):
            return self.neg(self.nodes[int(a)].operands[1])
        if self._is(a, "neg"):
            return self.neg(self.add(self.nodes[int(a)].operands[0], b))
        turned = self._numbers.get(_key("sub", (b, a)))
        if turned is not None:
            return self.add_node("neg", turned)
        return self.add_node("sub", a, b)

    def neg(self, a: Ref) -> Ref:
        """Return -a."""
        if self._is(a, "neg"):
            return self.nodes[int(a)].operands[0]
        return self.add_node("neg", a)

    def mul(self, a: Ref, b: Ref) -> Ref:
        """Return a·b with the sign outside, so that rotated vectors are recognised."""
        if type(b) is float:
            a, b = b, a
        if type(a) is float:
            if a in (0.0, 1.0, -1.0):
                return 0.0 if a == 0.0 else b if a == 1.0 else self.neg(b)
            if a < 0.0 and type(b) is int:
                return self.neg(self.mul(-a, b))
        inner = self._factor(b) if type(a) is float else None
        if inner is not None and type(a) is float:
            return self.mul(a * inner[0], inner[1])
        if type(a) is float and self._is(b, "div"):
            one, two = self.nodes[int(b)].operands
            if type(one) is float:
                return self.div(a * one, two)
        negative = False
        if self._is(a, "neg"):
            a, negative = self.nodes[int(a)].operands[0], not negative
        if self._is(b, "neg"):
            b, negative = self.nodes[int(b)].operands[0], not negative
        undone = self._undone(a, b)
        undone = self._undone(b, a) if undone is None else undone
        product = self.add_node("mul", *self._sorted(a, b)) if undone is None else undone
        return self.neg(product) if negative else product

    def _undone(self, a: Ref, b: Ref) -> Ref | None:
        """Return x where a is x/b, or 0 where b is 0 and else x/b; None of anything else."""
        if self._is(a, "at_zero"):
            size, other, value = self.nodes[int(a)].operands
            if not (same(size, b) and same(other, 0.0)):
                return None
            a = value
        if self._is(a, "div"):
            one, two = self.nodes[int(a)].operands
            return one if same(two, b) else None
        return None

    def div(self, a: Ref, b: Ref) -> Ref:
        """Return a / b."""
        if type(b) is float and b in (1.0, -1.0):
            return a if b == 1.0 else self.neg(a)
        if type(a) is float and a == 0.0:
            return 0.0
        if type(b) is float and b != 0.0:
            if math.frexp(b)[0] == 0.5:
                return self.mul(1.0 / b, a)  # exact
            if self._is(a, "div") and type(self.nodes[int(a)].operands[1]) is float:
                first, second = self.nodes[int(a)].operands
                return self.div(first, second * b)
            factor = self._factor(a)
            if factor is not None and factor[0] == b:
                return factor[1]
        if self._is(a, "neg"):
            return self.neg(self.div(self.nodes[int(a)].operands[0], b))
        if self._is(b, "neg"):
            return self.neg(self.div(a, self.nodes[int(b)].operands[0]))
        return self.add_node("div", a, b)

    def _factor(self, a: Ref) -> tuple[float, Ref] | None:
        """Return the constant factor of a product and the other factor."""
        if self._is(a, "mul") and type(self.nodes[int(a)].operands[0]) is float:
            one, two = self.nodes[int(a)].operands
            return float(one), two
        return None

    def abs(self, a: Ref) -> Ref:
        """Return |a|."""
        if self._is(a, "neg"):
            a = self.nodes[int(a)].operands[0]
        return a if self._is(a, "abs") or self._is(a, "sqrt") else self.add_node("abs", a)

    @staticmethod
    def _sorted(a: Ref, b: Ref) -> tuple[Ref, Ref]:
        """Return operands in one order: constants first, then by number."""
        if type(a) is type(b):
            return (a, b) if a <= b else (b, a)
        return (a, b) if type(a) is float else (b, a)

    def unsigned(self, ref: Ref) -> Ref:
        """Return a node without its sign, to recognise vectors of equal length."""
        if self._is(ref, "neg"):
            return self.nodes[int(ref)].operands[0]
        return abs(ref) if type(ref) is float else ref


def as_symbol(tape: Tape, value: Number) -> Symbol:
    """Return a number of a tape unchanged, or given data as one."""
    if isinstance(value, Symbol):
        return value
    if isinstance(value, complex):
        return Symbol(tape, value.real, value.imag)
    return Symbol(tape, float(value))


class Symbol:
    """Real or complex number of a tape.

    Attributes
    ----------
    re, im : Ref
        ``im`` is None for a real number.
    size : Ref or None
        Absolute value, if known beforehand: the radius of the arc on which a point was found.
    """

    __slots__ = ("im", "re", "size", "tape")

    def __init__(self, tape: Tape, re: Ref, im: Ref | None = None, size: Ref | None = None) -> None:
        self.tape, self.re, self.im, self.size = tape, re, im, size

    def _parts(self) -> tuple[Ref, Ref]:
        return self.re, 0.0 if self.im is None else self.im

    def _new(self, re: Ref, im: Ref, real: bool, size: Ref | None = None) -> Symbol:
        return Symbol(self.tape, re, None if real else im, size)

    def __add__(self, value: Number) -> Symbol:
        other, tape = as_symbol(self.tape, value), self.tape
        (a, b), (c, d) = self._parts(), other._parts()
        real = self.im is None and other.im is None
        return self._new(tape.add(a, c), 0.0 if real else tape.add(b, d), real)

    __radd__ = __add__

    def __sub__(self, value: Number) -> Symbol:
        other, tape = as_symbol(self.tape, value), self.tape
        (a, b), (c, d) = self._parts(), other._parts()
        real = self.im is None and other.im is None
        return self._new(tape.sub(a, c), 0.0 if real else tape.sub(b, d), real)

    def __rsub__(self, value: Number) -> Symbol:
        return as_symbol(self.tape, value) - self

    def __neg__(self) -> Symbol:
        a, b = self._parts()
        return self._new(self.tape.neg(a), self.tape.neg(b), self.im is None, self.size)

    def __mul__(self, value: Number) -> Symbol:
        other, tape = as_symbol(self.tape, value), self.tape
        (a, b), (c, d) = self._parts(), other._parts()
        size = None
        if self.size is not None and other.size is not None:
            size = tape.mul(self.size, other.size)
        elif self.size is not None and type(c) is float and type(d) is float:
            size = tape.mul(self.size, math.hypot(c, d))
        if self.im is None and other.im is None:
            return Symbol(tape, tape.mul(a, c))
        re = tape.sub(tape.mul(a, c), tape.mul(b, d))
        return Symbol(tape, re, tape.add(tape.mul(a, d), tape.mul(b, c)), size)

    __rmul__ = __mul__

    def __truediv__(self, value: Number) -> Symbol:
        other, tape = as_symbol(self.tape, value), self.tape
        if other.im is None:
            a, b = self._parts()
            re = tape.div(a, other.re)
            return self._new(re, tape.div(b, other.re), self.im is None)
        square = abs(other)
        return self * other.conjugate() / (square * square)

    def __rtruediv__(self, value: Number) -> Symbol:
        return as_symbol(self.tape, value) / self

    def conjugate(self) -> Symbol:
        """Return the complex conjugate."""
        if self.im is None:
            return self
        return Symbol(self.tape, self.re, self.tape.neg(self.im), self.size)

    @property
    def real(self) -> Symbol:
        """Real part."""
        return Symbol(self.tape, self.re)

    @property
    def imag(self) -> Symbol:
        """Imaginary part."""
        return Symbol(self.tape, self._parts()[1])

    def __abs__(self) -> Symbol:
        tape = self.tape
        a, b = self._parts()
        if self.size is not None:
            return Symbol(tape, self.size)
        if b == 0.0 and type(b) is float:
            return Symbol(tape, tape.abs(a))
        if a == 0.0 and type(a) is float:
            return Symbol(tape, tape.abs(b))
        if type(a) is float and type(b) is float:
            return Symbol(tape, math.hypot(a, b))
        squares = tape.add(
            tape.mul(tape.unsigned(a), tape.unsigned(a)),
            tape.mul(tape.unsigned(b), tape.unsigned(b)),
        )
        return Symbol(tape, tape.add_node("sqrt", squares))


class Guard(Struct, frozen=True):
    """Margin that must exceed a limit for a step to exist."""

    step: Name
    margin: Ref
    limit: float


class Symbolic(Exact, Struct):
    """Arithmetic that records operations on a tape and knows some lengths beforehand.

    Attributes
    ----------
    tape : Tape
    sizes : dict
        Absolute values of vectors, by their two coordinates without signs in either order: a
        vector and the same one turned by 90 degrees have one length.
    """

    tape: Tape = field(default_factory=Tape)
    sizes: dict[frozenset[tuple[type, Ref]], Ref] = field(default_factory=dict)

    def _key(self, value: Symbol) -> frozenset[tuple[type, Ref]]:
        return frozenset((type(ref), ref) for ref in map(self.tape.unsigned, value._parts()))

    def note(self, vector: Symbol, size: Symbol) -> None:
        """Note how long a vector is."""
        self.sizes.setdefault(self._key(vector), self.tape.abs(size.re))

    def known(self, vector: Symbol) -> Symbol:
        """Return a vector with its length if it was noted."""
        if vector.size is None and vector.im is not None:
            vector.size = self.sizes.get(self._key(vector))
        return vector

    def lift(self, value: Number) -> Number:
        """Turn given data into a symbol."""
        return as_symbol(self.tape, value)

    def root(self, value: Number) -> Number:
        """Return the square root, 0 of a negative number."""
        symbol = self.lift(value)
        largest = self.tape.add_node("max", symbol.re, 0.0)
        return Symbol(self.tape, self.tape.add_node("sqrt", largest))

    def guard(self, margin: Number, limit: float, value: Number) -> Number:
        """Return the value; the caller that runs the tape checks the margins."""
        return value

    def nonzero(self, value: Number) -> Number:
        """Return the value; the caller that runs the tape checks the margins."""
        return value

    def direction_margin(self, length: Number) -> Number:
        """Return the length, which is positive if it is not zero."""
        return length

    def unless_zero(self, size: Number, value: Number, fallback: Number) -> Number:
        """Return ``fallback`` where ``size`` is zero, else ``value``."""
        size, value, fallback = (self.lift(number) for number in (size, value, fallback))
        if type(size.re) is float:
            return fallback if size.re == 0.0 else value
        (a, b), (c, d) = value._parts(), fallback._parts()
        if same(a, c) and same(b, d):
            return value
        re = self.tape.add_node("at_zero", size.re, c, a)
        if value.im is None and fallback.im is None:
            return Symbol(self.tape, re)
        return Symbol(self.tape, re, self.tape.add_node("at_zero", size.re, d, b))

    def length_ratio(self, length: Number, vector: Number) -> Number:
        """Return 1 if the length is known to be that of the vector, else the computed ratio."""
        drawn, told = abs(vector), abs(length)
        noted = self.sizes.get(self._key(vector))
        if same(drawn.re, told.re) or (noted is not None and same(noted, told.re)):
            return 1.0
        return super().length_ratio(length, vector)

    def ordered(self, one: Number, two: Number) -> tuple[Number, Number]:
        """Return the smaller and the larger of two real numbers."""
        make, (a, b) = self.tape.add_node, (one.re, two.re)
        return Symbol(self.tape, make("min", a, b)), Symbol(self.tape, make("max", a, b))

    def direction(self, degrees: Number) -> Number:
        """Return the unit complex number at an angle."""
        angle = self.lift(degrees).re
        if type(angle) is float:
            unit = complex(unit_vectors(angle))
            return Symbol(self.tape, unit.real, unit.imag, 1.0)
        make = self.tape.add_node
        return Symbol(self.tape, make("cosd", angle), make("sind", angle), 1.0)

    def angle(self, vector: Number) -> Number:
        """Return the angle of a vector, degrees in (-180, 180]."""
        along = self.lift(vector)
        turned = self.tape.add_node("atan2", along.imag.re, along.re)
        return Symbol(self.tape, self.tape.add_node("degrees", turned))

    def line_through(self, out: str, tail: Number, vector: Number) -> tuple[Number, Number]:
        """Return the line, its length if it is known."""
        return tail, self.known(vector)


class PiecewiseTape:
    """Piecewise arithmetic that records operations on a tape: conditions are 1 or 0."""

    def __init__(self, tape: Tape) -> None:
        self.tape, self._symbols = tape, Symbolic(tape)

    def input(self, number: int) -> Symbol:
        """Return an input of the tape as a number."""
        return Symbol(self.tape, self.tape.input(number))

    def _add_operation(self, kind: str, *numbers: Number) -> Symbol:
        return Symbol(self.tape, self.tape.add_node(kind, *(self._ref(one) for one in numbers)))

    def _ref(self, number: Number) -> Ref:
        return as_symbol(self.tape, number).re

    def above(self, first: Number, second: Number) -> Number:
        """Return whether ``first > second``."""
        return self._add_operation("above", first, second)

    def reaches(self, first: Number, second: Number) -> Number:
        """Return whether ``first >= second``."""
        return self.select(self.above(second, first), 0.0, 1.0)

    def both(self, first: Number, second: Number) -> Number:
        """Return whether two conditions hold."""
        return self._add_operation("min", first, second)

    def either(self, first: Number, second: Number) -> Number:
        """Return whether one of two conditions holds."""
        return self._add_operation("max", first, second)

    def select(self, condition: Number, value: Number, fallback: Number) -> Number:
        """Return the value where a condition holds, else ``fallback``."""
        return self._symbols.unless_zero(condition, value, fallback)

    def larger(self, first: Number, second: Number) -> Number:
        """Return the larger of two real numbers."""
        return self._add_operation("max", first, second)

    def clipped(self, value: Number, low: float, high: float) -> Number:
        """Return a real number moved into a range."""
        return self._add_operation("min", self._add_operation("max", value, low), high)

    def modulo(self, value: Number, turn: float) -> Number:
        """Return what remains of a real number above a multiple of ``turn``."""
        return value - self._add_operation("floor", value / turn) * turn

    def angle(self, vector: Number) -> Number:
        """Return the angle of a vector, radians."""
        return self._add_operation("atan2", vector.imag, vector.real)

    def degrees(self, angle: Number) -> Number:
        """Return degrees in (-180, 180] of an angle in radians."""
        return self._add_operation("degrees", angle)

    def passed(self, marks: Sequence[float], value: Number) -> Number:
        """Return how many of some rising marks a number has reached."""
        reached = (self.reaches(value, mark) for mark in marks)
        return sum(reached, as_symbol(self.tape, 0.0))

    def interpolated(self, at: Sequence[float], values: Sequence[float], value: Number) -> Number:
        """Read a table straight between its rows."""
        found: Number = values[0]
        for (x0, y0), (x1, y1) in pairwise(zip(at, values, strict=True)):
            if x1 > x0:  # else a jump
                piece = y0 + (value - x0) * ((y1 - y0) / (x1 - x0))
                found = self.select(self.above(x0, value), found, piece)
        # NaN is not beyond the end.
        beyond = self.above(value, math.nextafter(at[-1], -math.inf))
        return self.select(beyond, values[-1], found)

    def stepped(self, at: Sequence[float], values: Sequence[float], value: Number) -> Number:
        """Read a table each row of which holds until the next one."""
        found: Number = values[0]
        for start, size in zip(at[1:], values[1:], strict=True):
            found = self.select(self.above(start, value), found, size)
        return found

    def listed(
        self,
        at: Sequence[float],
        values: Sequence[float],
        value: Number,
        tolerance: float,
        reject: Callable[[float], Exception],
    ) -> Number:
        """Read a table that is known at its rows alone; NaN elsewhere."""
        found: Number = math.nan
        for own, size in zip(at, values, strict=True):
            found = self.select(self.above(abs(value - own), tolerance), found, size)
        return found


class TapeProgram(Struct, frozen=True):
    """A program written on a tape.

    Attributes
    ----------
    tape : Tape
    value : mapping
        Symbol of every point and number; pair of symbols of every line.
    guards : tuple of Guard
        Every margin except constants that hold in all positions.
    depends : mapping of name to frozenset of int
        Guards that a result depends on, by their place in ``guards``.
    inputs : tuple of str
        Data that vary, in the order of the tape's inputs.
    """

    tape: Tape
    value: Mapping[Name, Any]
    guards: tuple[Guard, ...]
    depends: Mapping[Name, frozenset[int]]
    inputs: tuple[str, ...]


def write(
    program: Program,
    data: Mapping[str, complex | float],
    inputs: tuple[str, ...],
    parts: Mapping[Name, int] | None = None,
) -> TapeProgram:
    """Read a program in symbols.

    Parameters
    ----------
    program : Program
    data : mapping
        Constants: complex points, float numbers.
    inputs : tuple of str
        Known numbers that differ from position to position; a complex point that varies has two
        inputs, ``name.x`` and ``name.y``.
    parts : mapping of name to int, optional
        Part of the program that a step begins or goes on with; any other step belongs to the latest
        part among its operands.
    """
    ar = Symbolic()
    parts = parts or {}
    lifted: dict[str, Number] = {name: ar.lift(value) for name, value in data.items()}
    refs = {name: ar.tape.input(number) for number, name in enumerate(inputs)}
    for name, ref in refs.items():
        point, dot, axis = name.rpartition(".")
        if not dot:
            lifted[name] = Symbol(ar.tape, ref)
        elif axis == "x":
            lifted[point] = Symbol(ar.tape, ref, refs[f"{point}.y"])
    env: dict[Name, Any] = {}
    guards: list[Guard] = []
    depends: dict[Name, int] = {}  # guards as bits: a set for every step would be many numbers
    for step in program.steps:
        ar.tape.part = parts.get(step.out, 0)
        value, margin = apply(step, env, lifted, ar)
        mine = 0
        for name, _ in operands(step):
            mine |= depends[name]
        if margin is not None:
            guard = _watched(Guard(step.out, ar.lift(margin).re, limit_of(step)), ar.tape)
            if guard is not None:
                mine |= 1 << len(guards)
                guards.append(guard)
        # A sum of no terms is a plain number.
        env[step.out] = value if isinstance(value, Symbol | tuple) else ar.lift(value)
        depends[step.out] = mine
        _note_lengths(step, env, ar)
    ar.tape.part = 0
    alike = {bits: _numbers(bits) for bits in set(depends.values())}
    told = {name: alike[bits] for name, bits in depends.items()}
    return TapeProgram(ar.tape, env, tuple(guards), told, inputs)


def _numbers(bits: int) -> frozenset[int]:
    """Return the numbers of the bits that are set."""
    return frozenset(number for number, bit in enumerate(f"{bits:b}"[::-1]) if bit == "1")


def _watched(guard: Guard, tape: Tape) -> Guard | None:
    """Return a guard without the operations that it does not need; None if it always holds."""
    margin, limit = guard.margin, guard.limit
    while type(margin) is int:
        kind, refs = tape.nodes[margin]
        if kind == "at_zero" and all(type(ref) is float and ref > limit for ref in refs[1:]):
            return None
        scaled = refs[-1] if kind == "div" else refs[0] if kind == "mul" else None
        if not (type(scaled) is float and scaled > 0.0):
            break
        margin, limit = (refs[0], limit * scaled) if kind == "div" else (refs[1], limit / scaled)
    if type(margin) is float and margin > limit:
        return None
    return Guard(guard.step, margin, limit)


def _note_lengths(step: Step, env: Mapping[Name, Any], ar: Symbolic) -> None:
    """Note how far a new point is from the points that it was found from."""
    match step:
        case steps.IntersectCircles(out, c1, r1, c2, r2, _):
            pairs: tuple[tuple[Name, Name], ...] = ((c1, r1), (c2, r2))
        case steps.IntersectLineCircle(out, _, c, r, _):
            pairs = ((c, r),)
        case steps.LayOffLength(out, o, _, length):
            pairs = ((o, length),)
        case steps.MeasureAlong(
            out, tail, head, _
        ):  # a segment of the line along which it is measured
            ar.note(env[head] - env[tail], env[out])
            return
        case steps.Carry(out, o, _, _, length, times, _) if length is not None:
            scaled = env[length] if times is None else env[length] * env[times]
            ar.note(env[out] - env[o], abs(scaled))
            return
        case _:
            return
    for centre, radius in pairs:
        ar.note(env[out] - env[centre], env[radius])
