"""A linkage as a program that builds it by `planmethod.Mechanism` (экспорт в Python)."""

# no messages: Python

from __future__ import annotations

import keyword
from collections.abc import Iterator, Mapping
from typing import Any

from planmethod.scripting.mechanism import Mechanism

_HEAD = ("title", "source", "units")


def to_script(mechanism: Mechanism) -> str:
    """Return a program in Python that builds an equal mechanism and prints its results."""
    return "\n".join(_lines(mechanism)) + "\n"


def _lines(mechanism: Mechanism) -> Iterator[str]:
    table = mechanism.to_dict()
    yield "import planmethod as pm"
    yield ""
    head = {key: table.pop(key) for key in _HEAD if key in table}
    yield f"m = pm.Mechanism({_arguments([mechanism.name], head)})"
    frame = table.pop("frame", {})
    places = {key: value for key, value in frame.items() if key not in ("guides", "number")}
    if places:
        yield f"m.frame({_arguments([], places)})"
    for key in ("guides", "number"):
        if key in frame:
            yield f"m.set({_arguments([f'frame.{key}', frame[key]], {})})"
    for name, link in table.pop("links", {}).items():
        keys = {key: value for key, value in link.items() if key != "points"}
        yield f"m.link({_arguments([name, *link['points']], keys)})"
    for key, value in table.items():
        yield f"m.set({_arguments([key, value], {})})"
    yield ""
    yield "s = m.solve()"
    yield "print(s.to_columns())"


def _arguments(values: list[Any], keys: Mapping[str, Any]) -> str:
    """Return the arguments of a call."""
    plain = {k: v for k, v in keys.items() if k.isidentifier() and not keyword.iskeyword(k)}
    told = [repr(value) for value in values]
    if len(plain) == len(keys):
        told += [f"{key}={value!r}" for key, value in keys.items()]
    elif keys:
        told.append(f"**{dict(keys)!r}")
    return ", ".join(told)
