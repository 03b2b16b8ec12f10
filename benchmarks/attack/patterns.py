"""Regular expressions of the package on texts that expose slow matching (выражения).

The text is the prefix that a pattern requires, one or two runs of the characters that its repeats
match, and an ending that it does not match. A pattern whose time grows as a power of the length
needs minutes for such a text; a linear one needs milliseconds.
"""

from __future__ import annotations

import ast
import importlib
import pkgutil
import re
import signal
import warnings
from collections.abc import Iterator
from itertools import islice, product
from types import FrameType, ModuleType
from typing import Any

import planmethod

LENGTH = 1 << 15
"""Characters of a text that is tried."""

PATIENCE = 0.5
"""Processor time for such a text, s."""

MOST = 400
"""Texts for a pattern."""

_CALLS = {"compile", "match", "search", "fullmatch", "sub", "subn", "split", "findall", "finditer"}
_SAMPLES = "a0 .,'\"-_=/([{}])|A\t\nя^\\:;*+~#1"


class _SlowError(Exception):
    pass


def patterns() -> Iterator[tuple[str, str, bool]]:
    """Yield module and text of every pattern of the package, and whether it is looked for anywhere.

    Else it is tried at the beginning of a text.
    """
    found: set[tuple[str, bool]] = set()
    for info in pkgutil.walk_packages(planmethod.__path__, "planmethod."):
        if info.name == "planmethod.__main__":
            continue
        module = importlib.import_module(info.name)
        for one in _of_module(module):
            if one not in found:
                found.add(one)
                yield info.name.removeprefix("planmethod."), *one


def _of_module(module: ModuleType) -> Iterator[tuple[str, bool]]:
    file = module.__file__
    assert file is not None
    with open(file, encoding="utf-8") as source:  # noqa: PTH123
        tree = ast.parse(source.read())
    for node in ast.walk(tree):
        match node:
            case ast.Call(ast.Attribute(ast.Name("re"), name), [first, *_]) if name in _CALLS:
                try:
                    value = eval(compile(ast.Expression(first), file, "eval"), vars(module))
                except NameError:  # a function's own; its source is examined
                    continue
                if isinstance(value, str):
                    yield value, name not in ("match", "fullmatch")
    for name, value in vars(module).items():  # tables of them
        if name == "_REPAIRS":
            yield from ((pattern, True) for pattern, _ in value)


def hostile(pattern: str, length: int) -> Iterator[str]:
    """Yield texts of a length that a pattern may be slow on."""
    from re import _parser  # type: ignore[attr-defined]

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        runs = list(_runs(_parser.parse(pattern), ""))
    for before, one in runs:
        for end in ("\x01", "", "=", '"', "a"):
            yield before + (one * length)[:length] + end
            yield (before + one) * (length // (len(before + one) or 1)) + end
    for (before, one), (_, two) in product(runs, runs):
        if one != two:
            yield before + ((one + two) * length)[:length] + "\x01"
            yield before + one * (length // 2) + two * (length // 2) + "\x01"


def _runs(parsed: Any, before: str) -> Iterator[tuple[str, str]]:
    """Yield the prefix of each unbounded repeat, and the pattern that it repeats."""
    for op, value in parsed:
        name = str(op)
        if name in ("MAX_REPEAT", "MIN_REPEAT", "POSSESSIVE_REPEAT"):
            least, most, inside = value
            for one in {_sample(inside, 0), _sample(inside, 1)}:
                if str(most) == "MAXREPEAT" and one:
                    yield before, one
                yield from _runs(inside, before)
            before += _sample(inside, 0) * least
        elif name == "BRANCH":
            for way in value[1]:
                yield from _runs(way, before)
            before += _sample([(op, value)], 0)
        elif name == "SUBPATTERN":
            yield from _runs(value[3], before)
            before += _sample(value[3], 0)
        else:
            before += _sample([(op, value)], 0)


def _sample(parsed: Any, which: int) -> str:
    """Return a text that a part of a pattern takes; another one for another number."""
    text = ""
    for op, value in parsed:
        match str(op):
            case "LITERAL":
                text += chr(value)
            case "NOT_LITERAL":
                text += "b" if value == ord("a") else "a"
            case "ANY":
                text += "a"
            case "IN":
                text += _of_set(value, which)
            case "MAX_REPEAT" | "MIN_REPEAT" | "POSSESSIVE_REPEAT":
                text += _sample(value[2], which) * max(value[0], which)
            case "SUBPATTERN":
                text += _sample(value[3], which)
            case "ATOMIC_GROUP":
                text += _sample(value, which)
            case "BRANCH":
                ways = value[1]
                text += _sample(ways[which % len(ways)], which)
    return text


def _of_set(members: Any, which: int) -> str:
    from re import _compiler, _parser  # type: ignore[attr-defined]

    one = _parser.SubPattern(_parser.State(), [(_parser.IN, members)])
    taken = _compiler.compile(one)
    found = [c for c in (" ", *_SAMPLES) if taken.match(c)]
    return found[which % len(found)] if found else "b"


def slow(pattern: str, anywhere: bool, length: int, patience: float = PATIENCE) -> str:
    """Return the beginning of a text that a pattern is slow on; empty where there is none."""

    def stop(_number: int, _frame: FrameType | None) -> None:
        raise _SlowError

    compiled = re.compile(pattern)
    before = signal.signal(signal.SIGVTALRM, stop)
    try:
        for text in islice(hostile(pattern, length), MOST):
            signal.setitimer(signal.ITIMER_VIRTUAL, patience)
            try:
                compiled.match(text)
                if anywhere:
                    compiled.findall(text)
            except _SlowError:
                return text[:80]
            finally:
                signal.setitimer(signal.ITIMER_VIRTUAL, 0)
    finally:
        signal.signal(signal.SIGVTALRM, before)
    return ""
