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

PartReplacer = Callable[[ast.expr], ast.expr]

MIN_ROUNDING = 5e-4
"""Least share of a number by which the rounding of its terms may change it."""


class Change(NamedTuple):
    """A formula with one change (изменённая формула).

    Attributes
    ----------
    operation : str
        ``sign``, ``term``, ``factor``, ``inverted``, ``sum``, ``root``, ``squares``, ``square`` or
        ``instead``.
    before, after : ast.expr
        The part that is changed.
    formula : ast.expr
    code : str
        Where that of the operation is not meant.
    """

    operation: str
    before: ast.expr
    after: ast.expr
    formula: ast.expr
    code: str = ""


class RelationSlip(NamedTuple):
    """A change of an answer's formula that gives the number written (описка в формуле)."""

    code: str
    place: str
    value: float
    is_usual: bool


# Values --------------------------------------------------------------------------------------


@cache
def parse_formula(formula: str) -> ast.expr:
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
def find_names(node: ast.expr) -> frozenset[str]:
    """Return the keys of the terms of a formula."""
    return frozenset(one.id for one in ast.walk(node) if isinstance(one, ast.Name)) - FUNCTIONS


FUNCTIONS = frozenset(("sqrt", "abs"))


def derive(
    node: ast.expr, terms: Mapping[str, RelationTerm], values: Numbers, steps: Numbers
) -> tuple[float, float, tuple[str, ...]]:
    """Return what a formula gives from a student's numbers, and how far rounding may change it.

    Parameters
    ----------
    values, steps : mapping
        Numbers, and the units of their last digits, by the names of answers; an answer that is
        not there counts as right.

    Returns
    -------
    value, rounding : float
    parents : tuple of str
        Names of the answers in it.
    """
    used = sorted(find_names(node))
    numbers = {key: values.get(terms[key].answer, terms[key].value) for key in used}
    value, rounding = evaluate(node, numbers), 0.0
    parents = [key for key in used if terms[key].answer in values]
    for key in parents:
        moved = {**numbers, key: numbers[key] + steps.get(terms[key].answer, 0.0) / 2}
        rounding += abs(evaluate(node, moved) - value)
    return value, rounding, tuple(terms[key].answer for key in parents)


def keep_exact_relations(relations: Relations, exact: Numbers) -> Relations:
    """Return relations without those that do not give the exact values.

    A ratio of bodies whose axes cross has no sign: its formula is that of the size.
    """
    numbers = {key: term.value for key, term in relations.terms.items()}
    found = []
    for one in relations.relations:
        value, right = evaluate(parse_formula(one.formula), numbers), exact[one.answer]
        if math.isclose(value, -right, rel_tol=1e-9) and right > 0:
            one, value = replace(one, formula=f"abs({one.formula})"), -value
        if math.isclose(value, right, rel_tol=1e-9):
            found.append(one)
    return replace(relations, relations=tuple(found))


def derived_values(
    relations: Relations, name: str, values: Numbers
) -> Iterator[tuple[float, tuple[str, ...]]]:
    """Yield the values of an answer by those of others that are given, with their names."""
    for one in relations.relations:
        if one.answer == name:
            value, _, parents = derive(parse_formula(one.formula), relations.terms, values, {})
            if parents:
                yield value, parents


# Changes -------------------------------------------------------------------------------------


@cache
def change_operations(formula: str) -> tuple[Change, ...]:
    """Return the changes of a formula's operations and signs."""
    root = parse_formula(formula)
    found = [
        Change(operation, node, after, replace_part(after))
        for node, replace_part in _list_parts(root)
        for operation, after in _list_alternatives(node)
    ]
    return (*found, *_change_repeated(root))


def _change_repeated(root: ast.expr) -> Iterator[Change]:
    """Yield the changes of a quotient that a formula has in several places, in all of them."""
    texts = [ast.unparse(node) for node, _ in _list_parts(root)]
    for node, _ in _list_parts(root):
        text = ast.unparse(node)
        if isinstance(node, ast.BinOp) and texts.count(text) > 1:
            for operation, after in (*_list_alternatives(node), ("factor", ast.Constant(1))):
                yield Change(operation, node, after, _substitute(root, {text: after}))
            texts = [one for one in texts if one != text]


def _negate(node: ast.expr) -> ast.expr:
    return node.operand if isinstance(node, ast.UnaryOp) else ast.UnaryOp(ast.USub(), node)


def _list_parts(
    root: ast.expr, replace_part: PartReplacer = lambda new: new
) -> Iterator[tuple[ast.expr, PartReplacer]]:
    """Yield the parts of a formula, and what returns the whole with another part there."""
    yield root, replace_part
    match root:
        case ast.BinOp(left, joined, right):
            yield from _list_parts(left, lambda new: replace_part(ast.BinOp(new, joined, right)))
            yield from _list_parts(right, lambda new: replace_part(ast.BinOp(left, joined, new)))
        case ast.UnaryOp(minus, operand):
            yield from _list_parts(operand, lambda new: replace_part(ast.UnaryOp(minus, new)))
        case ast.Call(function, [argument]):
            yield from _list_parts(argument, lambda new: replace_part(_make_call(function, new)))


def _make_call(function: ast.expr, argument: ast.expr) -> ast.expr:
    return ast.Call(function, [argument], [])


def _list_alternatives(node: ast.expr) -> Iterator[tuple[str, ast.expr]]:
    """Yield what may be written for a part of a formula, with the operation that is changed."""
    add, sub, mult, div = ast.Add(), ast.Sub(), ast.Mult(), ast.Div()
    match node:
        case ast.BinOp(one, ast.Add() | ast.Sub() as joined, two):
            yield "sign", ast.BinOp(one, sub if isinstance(joined, ast.Add) else add, two)
            yield "term", one
            yield "term", two
            yield "term", _negate(two)
        case ast.BinOp(one, ast.Mult(), two):
            yield "sign", _negate(node)
            yield "inverted", ast.BinOp(one, div, two)
            yield "inverted", ast.BinOp(two, div, one)
            yield "inverted", ast.BinOp(ast.Constant(1), div, node)
            yield "factor", one
            yield "factor", two
            yield "sum", ast.BinOp(one, add, two)
        case ast.BinOp(one, ast.Div(), two):
            yield "sign", _negate(node)
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
                    sizes = (_make_call(ast.Name("abs"), base) for base in (one, two))
                    yield "squares", ast.BinOp(next(sizes), between, next(sizes))
                    yield "squares", ast.BinOp(one, between, two)
        case ast.UnaryOp(_, operand):
            yield "sign", operand


def _substitute(node: ast.expr, replacements: Mapping[str, ast.expr]) -> ast.expr:
    """Return a formula with other parts in all places of some, which are given as text."""
    is_whole = isinstance(node, ast.Name) or any(" " in text for text in replacements)
    if is_whole and (other := replacements.get(ast.unparse(node))) is not None:
        return other
    match node:
        case ast.BinOp(left, joined, right):
            return ast.BinOp(
                _substitute(left, replacements), joined, _substitute(right, replacements)
            )
        case ast.UnaryOp(minus, operand):
            return ast.UnaryOp(minus, _substitute(operand, replacements))
        case ast.Call(function, [argument]):
            return _make_call(function, _substitute(argument, replacements))
    return node


def _leave_out(node: ast.expr, key: str) -> ast.expr | None:
    """Return a formula without a term, as if it were zero; None if it has no other term."""
    match node:
        case ast.Name(name):
            return None if name == key else node
        case ast.BinOp(left, joined, right):
            one, two = _leave_out(left, key), _leave_out(right, key)
            if one is not None and two is not None:
                return ast.BinOp(one, joined, two)
            if isinstance(joined, ast.Add):
                return one or two
            if isinstance(joined, ast.Sub):
                return one or (two and _negate(two))
            return None
        case ast.UnaryOp(minus, operand):
            one = _leave_out(operand, key)
            return None if one is None else ast.UnaryOp(minus, one)
        case ast.Call(function, [argument]):
            one = _leave_out(argument, key)
            return None if one is None else _make_call(function, one)
    return node


@lru_cache(MANY)
def _all_changes(relation: Relation, relations: Relations) -> tuple[Change, ...]:
    """Return the changes of a relation, the usual ones first."""
    return tuple(_find_changes(relation, relations))


def _find_changes(relation: Relation, relations: Relations) -> Iterator[Change]:
    """Yield the changes of a relation, the usual ones first."""
    terms, instead, root = relations.terms, relations.instead, parse_formula(relation.formula)
    keys = sorted(find_names(root))
    for key in keys:
        if terms[key].code and (left := _leave_out(root, key)) is not None and left is not root:
            yield Change("term", root, left, left, terms[key].code)
    for one in change_operations(relation.formula):
        yield one._replace(code=_code_of(one, terms))
    for key, code in instead.get(relation.answer, {}).items():
        other = ast.Name(key)
        yield Change("instead", root, other, other, code)
    for node, replace_part in _list_parts(root):
        if isinstance(node, ast.Name) and terms[node.id].turns:
            made = Change("sign", node, _negate(node), replace_part(_negate(node)))
            yield made._replace(code=terms[node.id].code)
        for key, code in instead.get(node.id, {}).items() if isinstance(node, ast.Name) else ():
            yield Change("instead", node, ast.Name(key), replace_part(ast.Name(key)), code)
    for key in keys:
        for other_key, code in instead.get(key, {}).items():
            name, other = ast.Name(key), ast.Name(other_key)
            yield Change("instead", name, other, _substitute(root, {key: other}), code)
            if key < other_key in keys:
                both = _substitute(root, {key: other, other_key: name})
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


def find_slips(
    relations: Relations,
    relation: Relation,
    values: Numbers,
    steps: Numbers,
    matches: Callable[[float, float], bool],
) -> Iterator[RelationSlip]:
    """Yield the changes of a relation that give the number written.

    Parameters
    ----------
    matches : callable
        Whether a value, and how far rounding may change it, is the number written.
    """
    root, terms, found = parse_formula(relation.formula), relations.terms, list[RelationSlip]()
    right, spread, _ = derive(root, terms, values, steps)
    numbers = {key: values.get(term.answer, term.value) for key, term in terms.items()}
    for change in _all_changes(relation, relations):
        value = evaluate(change.formula, numbers)
        if not math.isfinite(value) or not matches(value, NEAR * abs(value)):
            continue
        if _is_sense(change, value, right, terms) or any(map(_is_one, ast.walk(change.formula))):
            continue
        value, rounding, _ = derive(change.formula, terms, values, steps)
        rounding = max(rounding, MIN_ROUNDING * abs(value))
        if abs(value - right) <= MIN_DISTANCE * (rounding + spread) or not matches(value, rounding):
            continue
        code = change.code or relation.codes.get(change.operation, "slip")
        place = f"{format_formula(change.after, terms)} ≠ {format_formula(change.before, terms)}"
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
    return turned and any(terms[key].turns for key in find_names(change.before))


def _is_one(node: ast.AST) -> bool:
    """Return whether a number is divided by itself: students do not write that."""
    match node:
        case ast.BinOp(ast.Name(one), ast.Div(), ast.Name(two)):
            return one == two
    return False


NEAR = 0.05
"""Share of a number within which the rounding of a change is looked at."""

MIN_DISTANCE = 2.0
"""Roundings by which a slip must differ from the value of the right formula."""


def format_formula(node: ast.expr, terms: Mapping[str, RelationTerm]) -> str:
    """Return a formula as rich text."""
    text = ast.unparse(node).replace(" * ", "·").replace(" / ", "/").replace("sqrt", "√")
    text = re.sub(r" ?\*\* ?(\d)", r"^{\1}", text).replace("-", MINUS)
    text = re.sub(r"abs\(([^()]*)\)", r"|\1|", text)
    symbols = {key: term.symbol for key, term in terms.items()}
    return re.sub(r"[a-z]\w*", lambda found: symbols.get(found[0], found[0]), text)
