"""Read a problem file, and lay a variant over it: all faults at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeAlias

from msgspec.structs import replace

from planmethod.errors import Fault, ProblemError
from planmethod.languages import current_language, translate
from planmethod.problem.fields import Faults, read_units
from planmethod.problem.linkage import TrainReader, read_parts
from planmethod.problem.model import Problem, SourceTable
from planmethod.problem.names import fold, listed, nearest_name
from planmethod.problem.source import parse, read_source
from planmethod.problem.variants import apply_variant, read_variants, with_table

Variants: TypeAlias = Mapping[str, Mapping[tuple[str, ...], Any]]
"""Overrides of every variant, by path."""


def load(
    path: str | Path, *, variant: str | None = None, train: TrainReader | None = None
) -> Problem:
    """Read a problem file (файл задачи).

    Parameters
    ----------
    path : str or Path
        TOML file as ``docs/problem-file.md`` describes it.
    variant : str, optional
        Name of a ``[variants]`` table to lay over the main part.
    train : callable, optional
        Reads the train that drives the crank (`planmethod.kinds`). Default: no train.

    Raises
    ------
    ProblemError
        With every fault of the file: path, what was expected, what was found, the next action.
    """
    (problem,) = load_each(path, (variant,), train=train)
    return problem


def load_each(
    path: str | Path, variants: Iterable[str | None], *, train: TrainReader | None = None
) -> Iterator[Problem]:
    """Read some variants of a problem file, None for its main part: the file itself once.

    Raises
    ------
    ProblemError
        As of `load`.
    """
    path = Path(path)
    table, known, faults = _from_file(path)
    names = tuple(known)  # one for all: ten thousand have as many names each
    for variant in variants:
        varied = _overlay_variant(faults, table, known, str(path), variant)
        yield _read_varied(faults.copy(), varied, names, str(path), path.stem, variant, train)


def _from_file(path: Path) -> tuple[Mapping[str, Any], Variants, Faults]:
    """Return the table of a file, its variants, which may be in a separate table file, and faults.

    A file that is loaded variant by variant is parsed once.
    """
    text = read_source(path)
    beside = isinstance(parse(text, name=str(path)).get("variants"), str)
    look = _looked_through.__wrapped__ if beside else _looked_through  # that may change alone
    table, variants, faults = look(text, path, current_language())
    return table, variants, faults.copy()


@lru_cache(maxsize=2)
def _looked_through(
    text: str, path: Path, _lang: str
) -> tuple[Mapping[str, Any], Variants, Faults]:
    """Return the result of `_from_file`, with faults in a language."""
    faults = Faults()
    table = with_table(faults, parse(text, name=str(path)), path.parent)
    return table, read_variants(faults, table), faults


def varied(path: Path, variant: str | None) -> tuple[Mapping[str, Any], tuple[str, ...], Faults]:
    """Return the table of a file with a variant's values, the names of all variants, and faults.

    So reads a problem of any kind.

    Raises
    ------
    ProblemError
        The file cannot be read, or has no such variant.
    """
    table, known, faults = _from_file(path)
    table = _overlay_variant(faults, table, known, str(path), variant)
    read_units(faults, table)
    return table, tuple(known), faults


def overlay_variant(
    faults: Faults, table: Mapping[str, Any], source: str, variant: str | None
) -> tuple[Mapping[str, Any], tuple[str, ...]]:
    """Return a table with a variant's values, and the names of all variants.

    Raises
    ------
    ProblemError
        No such variant.
    """
    variants = read_variants(faults, table)
    return _overlay_variant(faults, table, variants, source, variant), tuple(variants)


def _overlay_variant(
    faults: Faults,
    table: Mapping[str, Any],
    variants: Variants,
    source: str,
    variant: str | None,
) -> Mapping[str, Any]:
    if variant is None:
        return table
    if variant not in variants:
        raise ProblemError(source, [*faults.listed, unknown_variant(variant, variants)])
    return apply_variant(table, variants[variant])


def loads(
    text: str, *, name: str, variant: str | None = None, train: TrainReader | None = None
) -> Problem:
    """Read a problem from a text; ``name`` replaces the stem of the file name."""
    table = parse(text, name=name)
    return read_parsed(table, source=name, name=name, variant=variant, train=train)


def variant_names(path: str | Path) -> tuple[str, ...]:
    """Return the names of the variants of a file, in file order.

    Raises
    ------
    ProblemError
        The file cannot be read, or its variants are faulty.
    """
    path = Path(path)
    _, variants, faults = _from_file(path)
    if faults:
        raise ProblemError(str(path), faults.listed)
    return tuple(variants)


def read_parsed(
    table: Mapping[str, Any],
    *,
    source: str,
    name: str,
    variant: str | None = None,
    train: TrainReader | None = None,
) -> Problem:
    """Read a problem from its parsed TOML.

    Parameters
    ----------
    source : str
        What messages call the file.
    name : str
        Name of the problem.
    variant, train
        As of `load`.

    Raises
    ------
    ProblemError
    """
    faults = Faults()
    table = with_table(faults, table, None)
    table, variants = overlay_variant(faults, table, source, variant)
    return _read_varied(faults, table, variants, source, name, variant, train)


def _read_varied(
    faults: Faults,
    table: Mapping[str, Any],
    variants: tuple[str, ...],
    source: str,
    name: str,
    variant: str | None,
    train: TrainReader | None,
) -> Problem:
    problem = read_parts(faults, table, name, train)
    if faults or problem is None:
        raise ProblemError(source, faults.listed)
    return replace(
        problem,
        source_file=source,
        variants=variants,
        variant=variant,
        source_table=SourceTable(table),
    )


def unknown_variant(variant: str, known: Mapping[str, Any]) -> Fault:
    """Return the fault of a variant that a file has not, with the nearest name."""
    if not known:
        return Fault(
            "variants",
            translate("variant '{}' does not exist", variant),
            "The file has no variants.",
        )
    guess = nearest_name(variant, known) or next(
        (k for k in known if fold(k) == fold(variant)), None
    )
    hint = (
        translate("Did you mean '{}'?", guess)
        if guess
        else translate("There are {}.", listed(known))
    )
    if guess and fold(guess) == fold(variant):
        hint = translate("Did you mean '{}' in the other layout (Russian or Latin)?", guess)
    return Fault("variants", translate("variant '{}' does not exist", variant), hint)
