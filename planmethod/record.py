"""Data classes whose methods are written when they are first called.

`dataclasses.dataclass` writes the source of six methods for every class and compiles it when the
class is made: half a millisecond a class, and a command meets two hundred of them before it begins.
Here a class gets its slots at once and the rest at the first call: what is never made an instance
of costs nothing, and what is made a few times is filled by a loop. To a reader and to a type
checker it is `dataclasses.dataclass`, with those of its options that are used here (ADR 0026);
`fields`, `asdict` and `match` work as on any, and `replace` of this module does what theirs does.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from dataclasses import MISSING, Field
from operator import attrgetter
from typing import TYPE_CHECKING, Any

MANY = 24
"""Instances of a class for which its ``__init__`` is compiled; before, a loop fills them."""

_CALLS: dict[type, int] = {}
_ALL: dict[type, dict[str, Told]] = {}

if TYPE_CHECKING:
    from dataclasses import dataclass as dataclass
    from dataclasses import replace as replace
else:

    def replace(record: Any, /, **changes: Any) -> Any:
        """Return a record with other values of some fields, as `dataclasses.replace` does."""
        told = _all_of(type(record))
        if not told:
            return dataclasses.replace(record, **changes)
        kept = {t.name: getattr(record, t.name) for t in told.values() if t.init}
        return type(record)(**kept | changes)

    def dataclass(
        cls: type | None = None,
        /,
        *,
        frozen: bool = False,
        slots: bool = False,
        eq: bool = True,
        kw_only: bool = False,
    ) -> Any:
        """Return a class as `dataclasses.dataclass` makes it, its methods to be written later."""

        def made(cls: type) -> type:
            return _made(cls, frozen=frozen, slots=slots, eq=eq, kw_only=kw_only)

        return made if cls is None else made(cls)


class Told:
    """What is told of one field: its default and whether it is an argument by name only."""

    __slots__ = ("by_name", "default", "factory", "init", "name")

    def __init__(self, name: str, value: Any, by_name: bool) -> None:
        """Read the value that stands in the class's body."""
        given = value if isinstance(value, Field) else None
        self.name = name
        self.by_name = by_name
        self.default = value if given is None else given.default
        self.factory = MISSING if given is None else given.default_factory
        self.init = given is None or given.init


def _made(cls: type, *, frozen: bool, slots: bool, eq: bool, kw_only: bool) -> type:
    """Return the class with slots and with methods that write themselves."""
    told = {
        name: Told(name, cls.__dict__.get(name, MISSING), kw_only)
        for name, kind in vars(cls).get("__annotations__", {}).items()
        if not kind.startswith("ClassVar")
    }
    inherited: dict[str, Told] = {}
    for base in cls.__mro__[:0:-1]:
        inherited |= base.__dict__.get("__told__", {})
    everything = inherited | told
    body: dict[str, Any] = {
        "__told__": told,
        "__match_args__": tuple(t.name for t in everything.values() if t.init and not t.by_name),
        "__dataclass_fields__": _Fields(),
        "__init__": _WRITTEN["__init__"],
        "__repr__": cls.__dict__.get("__repr__", _shown),
    }
    if eq:
        body["__eq__"] = cls.__dict__.get("__eq__", _WRITTEN["__eq__"])
        body["__hash__"] = cls.__dict__.get("__hash__") or (
            _WRITTEN["__hash__"] if frozen else None
        )
    if frozen:
        body |= {"__setattr__": _kept, "__delattr__": _kept}
    if not slots:
        for name, value in body.items():
            setattr(cls, name, value)
        for one in told.values():
            if one.default is not MISSING:
                setattr(cls, one.name, one.default)
            elif one.name in cls.__dict__:
                delattr(cls, one.name)
        return cls
    if frozen:
        body |= {"__getstate__": _state, "__setstate__": _set_state}
    # Slots are a matter of the class's making: it is made again, without the defaults in its body.
    rest = {k: v for k, v in cls.__dict__.items() if k not in {*told, "__dict__", "__weakref__"}}
    body["__slots__"] = tuple(name for name in told if name not in inherited)
    again = type(cls)(cls.__name__, cls.__bases__, rest | body)
    again.__qualname__ = cls.__qualname__
    return again


def _all_of(cls: type) -> dict[str, Told]:
    """Return what is told of all fields, the bases' first."""
    found = _ALL.get(cls)
    if found is None:
        found = _ALL[cls] = {}
        for base in cls.__mro__[::-1]:
            found |= base.__dict__.get("__told__", {})
    return found


def _begun(cls: type, self: Any, args: tuple[Any, ...], given: dict[str, Any]) -> bool:
    """Fill a record field by field; False when the arguments are not its own."""
    places: tuple[str, ...] = cls.__dict__["__match_args__"]
    values = dict(zip(places, args, strict=False)) | given if args else given
    left = len(args) + len(given)
    for name, one in _all_of(cls).items():
        if one.init and name in values:
            value = values[name]
            left -= 1
        elif one.factory is not MISSING:
            value = one.factory()
        elif one.init and one.default is not MISSING:
            value = one.default
        elif one.init:
            return False
        else:
            continue
        object.__setattr__(self, name, value)
    if left:  # too many, unknown, or given twice
        return False
    if hasattr(cls, "__post_init__"):
        self.__post_init__()
    return True


def _written_later(name: str, write: Callable[[type], Any]) -> Any:
    """Return a method that, called first, puts what is written in its place and calls that."""

    def method(self: Any, *args: Any, **kwargs: Any) -> Any:
        owner = type(self)
        if owner.__dict__.get(name) is not method:
            owner = next(c for c in owner.__mro__ if c.__dict__.get(name) is method)
        if name == "__init__":
            _CALLS[owner] = _CALLS.get(owner, 0) + 1
            if _CALLS[owner] < MANY and _begun(owner, self, args, kwargs):
                return None
        written = write(owner)
        written.__name__, written.__qualname__ = name, f"{owner.__qualname__}.{name}"
        setattr(owner, name, written)
        return written(self, *args, **kwargs)

    method.__name__ = name
    return method


def _initial(cls: type) -> Any:
    """Return ``__init__``, compiled."""
    names: dict[str, Any] = {"_set": object.__setattr__, "_none": MISSING}
    exec("\n ".join(_lines(cls, names)), names)
    return names["__init__"]


def _lines(cls: type, names: dict[str, Any]) -> Iterator[str]:
    """Yield the lines of ``__init__``; defaults go into its names."""
    told = _all_of(cls).values()
    arguments = []
    for one in sorted((t for t in told if t.init), key=lambda t: t.by_name):
        if one.by_name and "*" not in arguments:
            arguments.append("*")
        if one.default is not MISSING:
            names[f"_of_{one.name}"] = one.default
            arguments.append(f"{one.name}=_of_{one.name}")
        else:
            arguments.append(one.name if one.factory is MISSING else f"{one.name}=_none")
    yield f"def __init__({', '.join(['self', *arguments])}):"
    for one in told:
        value = one.name
        if one.factory is not MISSING:
            names[f"_new_{one.name}"] = one.factory
            new = f"_new_{one.name}()"
            value = f"{new} if {one.name} is _none else {one.name}" if one.init else new
        elif not one.init:
            continue
        yield f"_set(self, {one.name!r}, {value})"
    yield "self.__post_init__()" if hasattr(cls, "__post_init__") else "pass"


def _key(cls: type) -> Callable[[Any], tuple[Any, ...]]:
    """Return what gives the tuple of all fields of a record."""
    names = tuple(_all_of(cls))
    if len(names) > 1:
        return attrgetter(*names)
    return lambda one: tuple(getattr(one, name) for name in names)


def _equal(cls: type) -> Any:
    """Return ``__eq__``."""
    key = _key(cls)

    def equal(self: Any, other: Any) -> Any:
        return key(self) == key(other) if other.__class__ is self.__class__ else NotImplemented

    return equal


def _hashed(cls: type) -> Any:
    """Return ``__hash__``."""
    key = _key(cls)
    return lambda self: hash(key(self))


_WRITTEN = {
    "__init__": _written_later("__init__", _initial),
    "__eq__": _written_later("__eq__", _equal),
    "__hash__": _written_later("__hash__", _hashed),
}


class _Fields:
    """Fields as `dataclasses` knows them, made when they are asked for."""

    def __get__(self, instance: Any, cls: type) -> dict[str, Field[Any]]:
        """Return the fields of the class and of its bases by name."""
        body: dict[str, Any] = {"__annotations__": {}, "__module__": cls.__module__}
        body["__doc__"] = cls.__name__  # or its signature would be looked up for one
        for base in cls.__mro__[::-1]:
            for one in base.__dict__.get("__told__", {}).values():
                body["__annotations__"][one.name] = base.__annotations__[one.name]
                body[one.name] = dataclasses.field(
                    **({"default": one.default} if one.default is not MISSING else {}),
                    **({"default_factory": one.factory} if one.factory is not MISSING else {}),
                    init=one.init,
                    kw_only=one.by_name,
                )
        plain: Any = dataclasses.dataclass(init=False, repr=False, eq=False)(
            type(cls.__name__, (), body)
        )
        fields: dict[str, Field[Any]] = plain.__dataclass_fields__
        type.__setattr__(cls, "__dataclass_fields__", fields)
        return fields


def _shown(self: Any) -> str:
    """Return the class's name and its fields."""
    fields = (f"{name}={getattr(self, name)!r}" for name in _all_of(type(self)))
    return f"{type(self).__qualname__}({', '.join(fields)})"


def _kept(self: Any, name: str, *_: Any) -> None:
    """Refuse to set or to delete a field of a frozen record."""
    raise dataclasses.FrozenInstanceError(f"cannot assign to field {name!r}")


def _state(self: Any) -> list[Any]:
    """Return the values of the fields, for other processes."""
    return [getattr(self, name) for name in _all_of(type(self))]


def _set_state(self: Any, state: list[Any]) -> None:
    """Take the values of the fields."""
    for name, value in zip(_all_of(type(self)), state, strict=True):
        object.__setattr__(self, name, value)
