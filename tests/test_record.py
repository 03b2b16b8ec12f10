"""Records that write their methods at the first call are what `dataclasses` makes."""

from __future__ import annotations

import copy
import dataclasses
import pickle
from dataclasses import field
from typing import Any

import pytest

from planmethod.record import dataclass


@dataclass(frozen=True, slots=True)
class Base:
    """A record that another adds to."""

    name: str
    values: tuple[int, ...] = ()


@dataclass(frozen=True, slots=True)
class More(Base):
    """A record with everything that a record may have."""

    table: dict[str, int] = field(default_factory=dict)
    total: int = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "total", sum(self.values))


@dataclass(frozen=True, slots=True, kw_only=True)
class Named:
    """A record whose arguments have names."""

    one: int
    two: int = 2


@dataclass(slots=True)
class Open:
    """A record that may be changed."""

    items: list[int] = field(default_factory=list)


@dataclass(frozen=True, eq=False)
class Loose:
    """A record without slots, compared by identity."""

    one: int = 1


def plain(cls: Any) -> Any:
    """Return what `dataclasses` makes of the same fields."""
    told = [(f.name, f.type, copy.copy(f)) for f in dataclasses.fields(cls)]
    for _, _, one in told:
        one.kw_only = dataclasses.MISSING
    return dataclasses.make_dataclass(cls.__qualname__, told, frozen=True)


def test_a_record_is_as_a_data_class() -> None:
    ours, theirs = More("a", (1, 2)), plain(Base)("a", (1, 2))
    assert (ours.name, ours.values, ours.table, ours.total) == ("a", (1, 2), {}, 3)
    assert repr(Base("a", (1, 2))) == repr(theirs)
    assert Base("a") == Base("a") != Base("b")
    assert hash(Base("a", (1,))) == hash(plain(Base)("a", (1,)))
    assert More.__match_args__ == ("name", "values", "table")
    assert not hasattr(ours, "__dict__")
    assert [f.name for f in dataclasses.fields(ours)] == ["name", "values", "table", "total"]
    assert dataclasses.replace(ours, values=(4,)).total == 4
    assert dataclasses.asdict(Named(one=1)) == {"one": 1, "two": 2}
    assert Base("a") != ours, "of another class"
    assert Loose() != Loose()


def test_a_frozen_record_stays_as_it_is() -> None:
    one = Base("a")
    with pytest.raises(dataclasses.FrozenInstanceError):
        one.name = "b"  # type: ignore[misc]
    with pytest.raises(dataclasses.FrozenInstanceError):
        del one.name
    assert pickle.loads(pickle.dumps(More("a", (1,)))) == More("a", (1,))
    assert copy.copy(one) == one


def test_an_open_record_changes_and_has_no_hash() -> None:
    one, other = Open(), Open()
    one.items.append(1)
    assert other.items == []
    other.items = [1]
    assert one == other
    with pytest.raises(TypeError):
        hash(one)


@pytest.mark.parametrize("wrong", [(), ("a", (), {}, 3, 4)], ids=["too few", "too many"])
def test_wrong_arguments_are_a_type_error(wrong: tuple[Any, ...]) -> None:
    with pytest.raises(TypeError):
        More(*wrong)
    with pytest.raises(TypeError):
        Named(1)  # type: ignore[call-arg]
