"""Formulas between the answers of a computed problem, right and with one change (зависимости).

A formula gives an answer from a student's own numbers, to the digits written. A slip is a formula
with one operation, sign or term changed: the changes are those of any formula, not of a problem.
"""

from __future__ import annotations

import ast
import math
import operator
import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache, lru_cache
from typing import NamedTuple

from msgspec.structs import replace

from planmethod.note.numbers import MINUS
from planmethod.problem.records import Relation, Relations, RelationTerm

Numbers = Mapping[str, float]

MANY = 4096
"""Formulas of which the terms and the changes are kept."""

Put = Callable[[ast.expr], ast.expr]

EXACT = 5e-4
"""Least share of a number by which the rounding of what it is computed from may change it."""


class Change(NamedTuple):
    """A formula with one change (изменённая формула).

    Attributes
    ----------
    operation : str
        ``sign``, ``term``, ``factor``, ``inverted``, ``sum``, ``root``, ``squares``, ``square`` or
        ``instead``.
    before, after : ast.expr
        The part that is changed.
    whole : ast.expr
    code : str
        Where that of the operation is not meant.
    """

    operation: str
    before: ast.expr
    after: ast.expr
    whole: ast.expr
    code: str = ""


class RelationSlip(NamedTuple):
    """A change of an answer's formula that gives the number written (описка в формуле)."""

    code: str
    place: str
    value: float
    is_usual: bool


# Values --------------------------------------------------------------------------------------


@cache
def parsed(formula: str) -> ast.expr:
    """Return a formula as a tree."""
    return ast.parse(formula, mode="eval").body


def evaluate(node: ast.expr, numbers: Numbers) -> float:
    """Return the value of a formula; NaN where it has none, and 0 for the root of less than 0."""
    if isinstance(node, ast.Name):
        return numbers[node.id]
    if isinstance(node, ast.BinOp):
        return OPERATIONS[type(node.op)](
            evaluate(node.left, numbers), evaluate(node.right, numbers)
        )
    match node:
        case ast.Constant(value):
            return float(value)  # type: ignore[arg-type]
        case ast.UnaryOp(_, operand):
            return -evaluate(operand, numbers)
        case ast.Call(ast.Name(name), [argument]):
            value = evaluate(argument, numbers)
            return abs(value) if name == "abs" else math.sqrt(max(value, 0.0))
    raise TypeError(ast.dump(node))


OPERATIONS: Mapping[type[ast.operator], Callable[[float, float], float]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: lambda one, two: one / two if two else math.nan,
    ast.Pow: math.pow,
}


@lru_cache(MANY)
def names_in(node: ast.expr) -> frozenset[str]:
    """Return the keys of the terms of a formula."""
    return frozenset(one.id for one in ast.walk(node) if isinstance(one, ast.Name)) - FUNCTIONS


FUNCTIONS = frozenset(("sqrt", "abs"))


def derive(
    node: ast.expr, terms: Mapping[str, RelationTerm], own: Numbers, steps: Numbers
) -> tuple[float, float, tuple[str, ...]]:
    """Return what a formula gives from a student's numbers, and how far rounding may change it.

    Parameters
    ----------
    own, steps : mapping
        Numbers, and the units of their last digits, by the names of answers; an answer that is
        not there counts as right.

    Returns
    -------
    value, rounding : float
    parents : tuple of str
        Names of the answers in it.
    """
    used = sorted(names_in(node))
    numbers = {key: own.get(terms[key].answer, terms[key].value) for key in used}
    value, rounding = evaluate(node, numbers), 0.0
    parents = [key for key in used if terms[key].answer in own]
    for key in parents:
        moved = {**numbers, key: numbers[key] + steps.get(terms[key].answer, 0.0) / 2}
        rounding += abs(evaluate(node, moved) - value)
    return value, rounding, tuple(terms[key].answer for key in parents)


def sound(relations: Relations, exact: Numbers) -> Relations:
    """Return relations without those that do not give the exact values.

    A ratio of bodies whose axes cross has no sign: its formula is that of the size.
    """
    numbers = {key: term.value for key, term in relations.terms.items()}
    found = []
    for one in relations.relations:
        value, right = evaluate(parsed(one.formula), numbers), exact[one.answer]
        if math.isclose(value, -right, rel_tol=1e-9) and right > 0:
            one, value = replace(one, formula=f"abs({one.formula})"), -value
        if math.isclose(value, right, rel_tol=1e-9):
            found.append(one)
    return replace(relations, relations=tuple(found))


def derived_values(
    relations: Relations, name: str, own: Numbers
) -> Iterator[tuple[float, tuple[str, ...]]]:
    """Yield the values of an answer by those of others that are given, with their names."""
    for one in relations.relations:
        if one.answer == name:
            value, _, parents = derive(parsed(one.formula), relations.terms, own, {})
            if parents:
                yield value, parents


# Changes -------------------------------------------------------------------------------------


@cache
def changes(formula: str) -> tuple[Change, ...]:
    """Return the changes of a formula's operations and signs."""
    root = parsed(formula)
    found = [
        Change(operation, node, after, put(after))
        for node, put in _places(root)
        for operation, after in _alternatives(node)
    ]
    return (*found, *_repeated(root))


def _repeated(root: ast.expr) -> Iterator[Change]:
    """Yield the changes of a quotient that a formula has in several places, in all of them."""
    texts = [ast.unparse(node) for node, _ in _places(root)]
    for node, _ in _places(root):
        text = ast.unparse(node)
        if isinstance(node, ast.BinOp) and texts.count(text) > 1:
            for operation, after in (*_alternatives(node), ("factor", ast.Constant(1))):
                yield Change(operation, node, after, _with_instead(root, {text: after}))
            texts = [one for one in texts if one != text]


def _minus(node: ast.expr) -> ast.expr:
    return node.operand if isinstance(node, ast.UnaryOp) else ast.UnaryOp(ast.USub(), node)


def _places(root: ast.expr, put: Put = lambda new: new) -> Iterator[tuple[ast.expr, Put]]:
    """Yield the parts of a formula, and what returns the whole with another part there."""
    yield root, put
    match root:
        case ast.BinOp(left, joined, right):
            yield from _places(left, lambda new: put(ast.BinOp(new, joined, right)))
            yield from _places(right, lambda new: put(ast.BinOp(left, joined, new)))
        case ast.UnaryOp(minus, operand):
            yield from _places(operand, lambda new: put(ast.UnaryOp(minus, new)))
        case ast.Call(function, [argument]):
            yield from _places(argument, lambda new: put(_call(function, new)))


def _call(function: ast.expr, argument: ast.expr) -> ast.expr:
    return ast.Call(function, [argument], [])


def _alternatives(node: ast.expr) -> Iterator[tuple[str, ast.expr]]:
    """Yield what may be written for a part of a formula, with the operation that is changed."""
    add, sub, mult, div = ast.Add(), ast.Sub(), ast.Mult(), ast.Div()
    match node:
        case ast.BinOp(one, ast.Add() | ast.Sub() as joined, two):
            yield "sign", ast.BinOp(one, sub if isinstance(joined, ast.Add) else add, two)
            yield "term", one
            yield "term", two
            yield "term", _minus(two)
        case ast.BinOp(one, ast.Mult(), two):
            yield "sign", _minus(node)
            yield "inverted", ast.BinOp(one, div, two)
            yield "inverted", ast.BinOp(two, div, one)
            yield "inverted", ast.BinOp(ast.Constant(1), div, node)
            yield "factor", one
            yield "factor", two
            yield "sum", ast.BinOp(one, add, two)
        case ast.BinOp(one, ast.Div(), two):
            yield "sign", _minus(node)
            yield "inverted", ast.BinOp(two, div, one)
            yield "inverted", ast.BinOp(one, mult, two)
            yield "factor", one
            yield "factor", two
        case ast.BinOp(base, ast.Pow(), ast.Constant(power)):
            yield "square", base
            if power == 3:
                yield "square", ast.BinOp(base, ast.Pow(), ast.Constant(2))
        case ast.Call(ast.Name("sqrt"), [argument]):
            yield "root", argument
            match argument:
                case ast.BinOp(ast.BinOp(one, ast.Pow()), between, ast.BinOp(two, ast.Pow())):
                    sizes = (_call(ast.Name("abs"), base) for base in (one, two))
                    yield "squares", ast.BinOp(next(sizes), between, next(sizes))
                    yield "squares", ast.BinOp(one, between, two)
        case ast.UnaryOp(_, operand):
            yield "sign", operand


def _with_instead(node: ast.expr, others: Mapping[str, ast.expr]) -> ast.expr:
    """Return a formula with other parts in all places of some, which are given as text."""
    is_whole = isinstance(node, ast.Name) or any(" " in text for text in others)
    if is_whole and (other := others.get(ast.unparse(node))) is not None:
        return other
    match node:
        case ast.BinOp(left, joined, right):
            return ast.BinOp(_with_instead(left, others), joined, _with_instead(right, others))
        case ast.UnaryOp(minus, operand):
            return ast.UnaryOp(minus, _with_instead(operand, others))
        case ast.Call(function, [argument]):
            return _call(function, _with_instead(argument, others))
    return node


def _without(node: ast.expr, key: str) -> ast.expr | None:
    """Return a formula without a term, as if it were zero; None where nothing is left."""
    match node:
        case ast.Name(name):
            return None if name == key else node
        case ast.BinOp(left, joined, right):
            one, two = _without(left, key), _without(right, key)
            if one is not None and two is not None:
                return ast.BinOp(one, joined, two)
            if isinstance(joined, ast.Add):
                return one or two
            if isinstance(joined, ast.Sub):
                return one or (two and _minus(two))
            return None
        case ast.UnaryOp(minus, operand):
            one = _without(operand, key)
            return None if one is None else ast.UnaryOp(minus, one)
        case ast.Call(function, [argument]):
            one = _without(argument, key)
            return None if one is None else _call(function, one)
    return node


@lru_cache(MANY)
def _all_changes(relation: Relation, relations: Relations) -> tuple[Change, ...]:
    """Return the changes of a relation, the usual ones first."""
    return tuple(_find_changes(relation, relations))


def _find_changes(relation: Relation, relations: Relations) -> Iterator[Change]:
    """Yield the changes of a relation, the usual ones first."""
    terms, instead, root = relations.terms, relations.instead, parsed(relation.formula)
    for key in sorted(names_in(root)):
        if terms[key].code and (left := _without(root, key)) is not None and left is not root:
            yield Change("term", root, left, left, terms[key].code)
    for one in changes(relation.formula):
        yield one._replace(code=_code_of(one, terms))
    for key, code in instead.get(relation.answer, {}).items():
        other = ast.Name(key)
        yield Change("instead", root, other, other, code)
    for node, put in _places(root):
        if isinstance(node, ast.Name) and terms[node.id].turns:
            made = Change("sign", node, _minus(node), put(_minus(node)))
            yield made._replace(code=terms[node.id].code)
        for key, code in instead.get(node.id, {}).items() if isinstance(node, ast.Name) else ():
            yield Change("instead", node, ast.Name(key), put(ast.Name(key)), code)
    keys = sorted(names_in(root))
    for key in keys:
        for other_key, code in instead.get(key, {}).items():
            name, other = ast.Name(key), ast.Name(other_key)
            yield Change("instead", name, other, _with_instead(root, {key: other}), code)
            if key < other_key in keys:
                both = _with_instead(root, {key: other, other_key: name})
                yield Change("instead", root, both, both, code)


def _code_of(change: Change, terms: Mapping[str, RelationTerm]) -> str:
    """Return the code of the term that a change leaves out, inverts, or turns the sign of."""
    match change.before, change.after, change.operation:
        case ast.BinOp(_, ast.Add() | ast.Sub(), ast.Name(key)), _, "sign":
            return terms[key].code
        case ast.BinOp(one, _, two), after, "term" | "factor":
            left_out = two if after is one else one
            return terms[left_out.id].code if isinstance(left_out, ast.Name) else ""
        case ast.BinOp(one, ast.Mult(), two), ast.BinOp(_, ast.Div(), by), "inverted":
            return terms[by.id].code if isinstance(by, ast.Name) and by in (one, two) else ""
    return ""


# Slips ---------------------------------------------------------------------------------------


def slips(
    relations: Relations,
    relation: Relation,
    own: Numbers,
    steps: Numbers,
    matches: Callable[[float, float], bool],
) -> Iterator[RelationSlip]:
    """Yield the changes of a relation that give the number written.

    Parameters
    ----------
    matches : callable
        Whether a value, and how far rounding may change it, is the number written.
    """
    root, terms, found = parsed(relation.formula), relations.terms, list[RelationSlip]()
    right, spread, _ = derive(root, terms, own, steps)
    numbers = {key: own.get(term.answer, term.value) for key, term in terms.items()}
    for change in _all_changes(relation, relations):
        value = evaluate(change.whole, numbers)
        if not math.isfinite(value) or not matches(value, NEAR * abs(value)):
            continue
        if _is_sense(change, value, right, terms) or any(map(_is_one, ast.walk(change.whole))):
            continue
        value, rounding, _ = derive(change.whole, terms, own, steps)
        rounding = max(rounding, EXACT * abs(value))
        if abs(value - right) <= APART * (rounding + spread) or not matches(value, rounding):
            continue
        code = change.code or relation.codes.get(change.operation, "slip")
        place = f"{written(change.after, terms)} ≠ {written(change.before, terms)}"
        slip = RelationSlip(code, place, value, change.operation != "instead")
        same = [one for one in found if math.isclose(one.value, value, rel_tol=1e-9)]
        if not same:
            found.append(slip)
        elif (
            same[0].code == code and change.operation != "sign" and len(place) < len(same[0].place)
        ):
            found[found.index(same[0])] = slip
    yield from found


def _is_sense(
    change: Change, value: float, right: float, terms: Mapping[str, RelationTerm]
) -> bool:
    """Return whether a change only turns the sense of an answer, with that of another one."""
    turned = change.operation == "sign" and math.isclose(value, -right, rel_tol=1e-9)
    return turned and any(terms[key].turns for key in names_in(change.before))


def _is_one(node: ast.AST) -> bool:
    """Return whether a number is divided by itself: nobody writes that."""
    match node:
        case ast.BinOp(ast.Name(one), ast.Div(), ast.Name(two)):
            return one == two
    return False


NEAR = 0.05
"""Share of a number within which the rounding of a change is looked at."""

APART = 2.0
"""Roundings by which a slip must differ from what the right formula gives."""


def written(node: ast.expr, terms: Mapping[str, RelationTerm]) -> str:
    """Return a formula as rich text."""
    text = ast.unparse(node).replace(" * ", "·").replace(" / ", "/").replace("sqrt", "√")
    text = re.sub(r" ?\*\* ?(\d)", r"^{\1}", text).replace("-", MINUS)
    text = re.sub(r"abs\(([^()]*)\)", r"|\1|", text)
    return re.sub(r"[a-z]\w*", lambda found: _symbol(found[0], terms), text)


def _symbol(key: str, terms: Mapping[str, RelationTerm]) -> str:
    return terms[key].symbol if key in terms else key
