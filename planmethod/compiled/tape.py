"""Tape of real operations: a program after its constants have been folded (лента)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

from msgspec import Struct, field

Ref: TypeAlias = int | float
"""Operand: the number of a node (int), or a constant (float)."""


class Node(NamedTuple):
    """One operation on earlier nodes and constants.

    ``input`` has the number of the input as its only operand; ``cosd`` and ``sind`` take degrees;
    ``at_zero`` has three operands (size, other, value): the other where the size is zero;
    ``degrees`` of an angle in radians are in (-180, 180].
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
