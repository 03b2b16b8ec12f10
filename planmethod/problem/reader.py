"""Read a problem file, and lay a variant over it: all faults at once."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from functools import lru_cache
from pathlib import Path
from typing import Any, TypeAlias

from msgspec.structs import replace

from planmethod.errors import Fault, ProblemError
from planmethod.languages import current_language, translate
from planmethod.problem.file_node import Faults, FileNode, read_units
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
    file, known = _open(path)
    names = tuple(known)  # one for all: ten thousand have as many names each
    for variant in variants:
        varied = _overlay_variant(file, known, str(path), variant)
        yield _read_varied(varied.copy(), names, str(path), path.stem, variant, train)


def _open(path: Path) -> tuple[FileNode, Variants]:
    """Return a file and its variants, which may be in a separate table file.

    A file that is loaded variant by variant is parsed once.
    """
    text = read_source(path)
    beside = isinstance(parse(text, name=str(path)).get("variants"), str)
    look = _looked_through.__wrapped__ if beside else _looked_through  # that may change alone
    file, variants = look(text, path, current_language())
    return file.copy(), variants


@lru_cache(maxsize=2)
def _looked_through(text: str, path: Path, _lang: str) -> tuple[FileNode, Variants]:
    """Return the result of `_open`, with faults in a language."""
    file = with_table(FileNode(Faults(), parse(text, name=str(path))), path.parent)
    return file, read_variants(file)


def varied(path: Path, variant: str | None) -> tuple[FileNode, tuple[str, ...]]:
    """Return a file with a variant's values, and the names of all variants.

    So reads a problem of any kind.

    Raises
    ------
    ProblemError
        The file cannot be read, or has no such variant.
    """
    file, known = _open(path)
    file = _overlay_variant(file, known, str(path), variant)
    read_units(file)
    return file, tuple(known)


def overlay_variant(
    file: FileNode, source: str, variant: str | None
) -> tuple[FileNode, tuple[str, ...]]:
    """Return a file with a variant's values, and the names of all variants.

    Raises
    ------
    ProblemError
        No such variant.
    """
    variants = read_variants(file)
    return _overlay_variant(file, variants, source, variant), tuple(variants)


def _overlay_variant(
    file: FileNode, variants: Variants, source: str, variant: str | None
) -> FileNode:
    if variant is None:
        return file
    if variant not in variants:
        raise ProblemError(source, [*file.faults.listed, unknown_variant(variant, variants)])
    return file.with_value(apply_variant(file.value, variants[variant]))


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
    file, variants = _open(path)
    if file.faults:
        raise ProblemError(str(path), file.faults.listed)
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
    file = with_table(FileNode(Faults(), table), None)
    file, variants = overlay_variant(file, source, variant)
    return _read_varied(file, variants, source, name, variant, train)


def _read_varied(
    file: FileNode,
    variants: tuple[str, ...],
    source: str,
    name: str,
    variant: str | None,
    train: TrainReader | None,
) -> Problem:
    table = file.value
    problem = read_parts(file, name, train)
    if file.faults or problem is None:
        raise ProblemError(source, file.faults.listed)
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
