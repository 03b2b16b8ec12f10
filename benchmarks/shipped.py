"""Every shipped problem (задачи поставки): solved in its variants, drawn and checked.

Run ``python -m benchmarks.shipped [PROBLEM]...``; it prints the unsolved problems, the remarks of
the drawing-standards check, and the counts. With ``--seed`` it takes random mechanisms, for which
the layout was not tuned, and writes them into a folder first:
``--seed 91301 --seed 91302 --written out/random``.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import click

from benchmarks.generator import random_problem
from benchmarks.sheets import positions_of
from planmethod.commands.command import guarded
from planmethod.errors import PlanMethodError
from planmethod.kinds import LINKAGES, kind_of
from planmethod.options import PlanRequest
from planmethod.problem import Problem, variant_names
from planmethod.problem.tasks import home
from planmethod.render.control.remarks import REMARKS
from planmethod.render.sheets.controlled import CheckedSheet, check_drawings, controlled_kinematics
from planmethod.render.sheets.kinematics import kinematics_sheets

HEAD = ("| files | positions | sheets | errors | warnings | of them |", "| --- " * 6 + "|")


def solved(path: Path, variant: str | None) -> None:
    """Solve a problem of any kind in a variant."""
    kind = kind_of(path)
    kind.record(kind.load(path, variant), "ru")


def looked(path: Path, variant: str | None, count: int) -> list[CheckedSheet]:
    """Draw the default sheets in ``count`` positions and check them; a train has only one."""
    kind = kind_of(path)
    problem = kind.load(path, variant)
    if isinstance(problem, Problem):
        own = count == 1 and len(problem.drive.positions) == 1
        positions = None if own else positions_of(problem, count)
        return controlled_kinematics(problem, partial(kinematics_sheets, positions=positions))
    drawings = kind.drawings(problem, PlanRequest())
    return check_drawings(drawings, kind.scales)


def _written(seed: int, folder: Path) -> Path:
    """Write the problem file of a random mechanism; return where it is."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"random-{seed}.toml"
    path.write_text(random_problem(seed)[0], encoding="utf-8")
    return path


def _files(problems: tuple[Path, ...]) -> Iterator[tuple[Path, list[str | None]]]:
    for path in problems or sorted(home().rglob("*.toml")):
        yield path, [*variant_names(path)] or [None]


@click.command()
@click.argument("problems", nargs=-1, metavar="[PROBLEM]...", type=click.Path(path_type=Path))
@click.option("--positions", "counts", type=int, multiple=True, default=(1, 3), show_default=True)
@click.option("--all-variants", is_flag=True, help="Sheets of every variant, not of the first.")
@click.option("--seed", "seeds", type=int, multiple=True, help="Random mechanisms instead.")
@click.option("--written", type=click.Path(path_type=Path), default=Path("out/random"),
              show_default=True, help="Folder for the files of random mechanisms.")  # fmt: skip
@guarded
def main(
    problems: tuple[Path, ...],
    counts: tuple[int, ...],
    all_variants: bool,
    seeds: tuple[int, ...],
    written: Path,
) -> None:
    """Solve every shipped problem in all its variants, draw its sheets and look them over."""
    problems += tuple(_written(seed, written) for seed in seeds)
    files = list(_files(problems))
    tried = failed = 0
    for path, variants in files:
        for variant in variants:
            tried += 1
            try:
                solved(path, variant)
            except PlanMethodError as error:
                failed += 1
                click.echo(f"{_called(path, variant)}: {error}")
    click.echo(f"{len(files)} files, {tried} problems with their variants, {failed} unsolved.\n")
    rows = [_row(files, count, all_variants) for count in counts]
    click.echo("\n".join(("", *HEAD, *rows)))


def _row(files: list[tuple[Path, list[str | None]]], count: int, all_variants: bool) -> str:
    """Check the sheets of all files in ``count`` positions; return their row."""
    drawn = sheets = 0
    codes: Counter[str] = Counter()
    for path, variants in files:
        if count > 1 and kind_of(path) is not LINKAGES:
            continue
        drawn += 1
        for variant in variants if all_variants else variants[:1]:
            try:
                seen = looked(path, variant, count)
            except PlanMethodError as error:
                codes["undrawn"] += 1
                click.echo(f"{_called(path, variant)} in {count}: {error}")
                continue
            sheets += len(seen)
            found = [finding.code for sheet in seen for finding in sheet.findings]
            codes.update(found)
            wrong = [code for code in found if REMARKS[code].severity == "error"]
            if wrong:
                click.echo(f"{_called(path, variant)} in {count}: {', '.join(wrong)}")
    errors = sum(n for code, n in codes.items() if code not in REMARKS or _is_error(code))
    warnings = {code: n for code, n in sorted(codes.items()) if code in REMARKS}
    of_them = ", ".join(f"{n} {code}" for code, n in warnings.items() if not _is_error(code))
    return (
        f"| {drawn} | {count} | {sheets} | {errors} | {sum(codes.values()) - errors} | {of_them} |"
    )


def _called(path: Path, variant: str | None) -> str:
    return path.stem if variant is None else f"{path.stem} {variant}"


def _is_error(code: str) -> bool:
    return REMARKS[code].severity == "error"


if __name__ == "__main__":
    main()
