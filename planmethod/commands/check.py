"""Command ``check``: answers of students against the plans."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click
from msgspec.structs import replace

from planmethod.commands.helptext import Spoken
from planmethod.commands.output import bar, json_text
from planmethod.commands.problems import Todo, each, finish, guarded, stem
from planmethod.errors import ExitCode, PlanMethodError
from planmethod.languages import say, spoken
from planmethod.options import PathType, UsageError, jobs_option, lang_option, out_option

if TYPE_CHECKING:
    from planmethod.check.group import Variants
    from planmethod.check.key import Key
    from planmethod.check.marks import Settings
    from planmethod.check.model import CheckedWork, Work
    from planmethod.note.wording import Language

POLICIES = ("construction", "department", "wider", "stricter")
MANY_WORKS = 10
"""Works whose pages take about a second."""

FORMATS = ("html", "pdf")


@click.command(cls=Spoken)
@click.argument("files", nargs=-1, required=True, metavar="PROBLEM [WORK]...", type=PathType())
@click.option("--key", "key_only", is_flag=True, help="Print and write the key of every PROBLEM.")
@click.option("--variant", metavar="NAME", help="Variant of the works that name none.")
@click.option("--all-variants", is_flag=True, help="With --key: of every variant.")
@click.option("--json", "as_json", is_flag=True, help="Verdicts as JSON, and no files.")
@out_option
@click.option(
    "--settings",
    "settings_file",
    type=PathType(dir_okay=False),
    metavar="FILE",
    help="TOML of the department: tolerances, points, marks.",
)
@click.option("--policy", type=click.Choice(POLICIES), help="Whose tolerance counts.")
@click.option(
    "--profile", type=click.Choice(("board", "cad", "coarse")), help="How well the works are drawn."
)
@click.option(
    "--overrides",
    type=PathType(dir_okay=False),
    metavar="FILE",
    help="Points and remarks set by hand; overrides.csv of the output folder when absent.",
)
@click.option("--anonymize", is_flag=True, help="Stable numbers in place of the names.")
@click.option(
    "--salt", default="", metavar="WORD", help="Word of the course that these numbers depend on."
)
@jobs_option
@lang_option
@guarded
def check(
    files: tuple[Path, ...],
    key_only: bool,
    variant: str | None,
    all_variants: bool,
    as_json: bool,
    out: Path,
    settings_file: Path | None,
    policy: str | None,
    profile: str | None,
    overrides: Path | None,
    anonymize: bool,
    salt: str,
    jobs: int,
    lang: str,
) -> None:
    """Check answers: key first, then one student's work or a whole group's.

    PROBLEM asks what its [[answers]] say, else what the key lists. WORK is one student's JSON or
    TOML, a group's CSV or XLSX, or a form filled in. Writes results.xlsx, results.csv, run.json
    and a page for each student.
    """
    settings = _settings(settings_file, policy, profile)
    if key_only:
        _write_keys(files, variant, all_variants, settings, out, lang, jobs)
        return
    if all_variants:
        raise UsageError("--all-variants goes with --key: every work names its own variant")
    problem, *paths = files
    if not paths:
        raise UsageError("name a WORK after the PROBLEM, or ask for its --key")
    from planmethod.check.group import Variants

    variants = Variants(problem, settings, variant)
    checked, works = _checked(variants, paths, jobs)
    from planmethod.check.pages.compared import unread_lines
    from planmethod.check.pages.overrides import overridden, read_overrides
    from planmethod.note.wording import language

    by_hand = overrides or (None if as_json else out / "overrides.csv")
    if by_hand is not None:
        checked, unused = overridden(checked, read_overrides(by_hand))
        for where in unused:
            click.echo(say("Warning: {}: no such work or answer.", where), err=True)
    _warn_of_others(problem, works)
    if as_json:
        _print_json(checked)
    else:
        _write_results(variants, paths, checked, out, salt if anonymize else None, lang)
    lost = False
    for line, is_lost in unread_lines(checked, language(spoken())):
        click.echo(line, err=True)
        lost |= is_lost
    for line in _unread_tables(works):
        click.echo(line, err=True)
        lost = True
    finish(ExitCode.FINDINGS if lost else ExitCode.DONE)


def _unread_tables(works: list[Work]) -> Iterator[str]:
    """Yield a line on each file of which no answer was read, with the columns it has."""
    from planmethod.check.model import Unread

    files: dict[str, list[Work]] = {}
    for work in works:
        files.setdefault(work.where, []).append(work)
    for where, found in files.items():
        if any(work.answers for work in found):
            continue
        columns = [r.fault for work in found for r in work.remarks if r.why is Unread.COLUMN]
        told = ", ".join(dict.fromkeys(columns)) or "—"
        yield say(
            "{}: no answer was read. Columns that nobody understands: {}. Name them: student, "
            "what, value, unit, mm, sense; or student and the quantities: v_B, omega_3.",
            where,
            told,
        )


def _settings(file: Path | None, policy: str | None, profile: str | None) -> Settings:
    from planmethod.check.marks import DEFAULT, load_settings

    settings = DEFAULT if file is None else load_settings(file)
    return replace(settings, policy=policy or settings.policy, profile=profile or settings.profile)


def _checked(
    variants: Variants, paths: list[Path], jobs: int
) -> tuple[list[CheckedWork], list[Work]]:
    from planmethod.check.copied import compared
    from planmethod.check.group import check_works
    from planmethod.check.works import read_works

    works = [work for path in paths for work in read_works(path)]
    if jobs > 1 and len(works) > jobs:
        parts = _in_processes(variants, works, jobs)
    else:
        parts = ([one] for one in check_works(variants, works))
    checked: list[CheckedWork] = []
    with bar(len(works), long=len(works) >= MANY_WORKS) as done:
        for part in parts:
            checked += part
            done(len(part))
    return compared(checked), works


def _in_processes(variants: Variants, works: list[Work], jobs: int) -> Iterator[list[CheckedWork]]:
    """Check works in several processes."""
    from planmethod.commands.processes import in_processes

    share = -(-len(works) // jobs)
    parts = [works[start : start + share] for start in range(0, len(works), share)]
    act = partial(
        check_part,
        problem=variants.path,
        variant=variants.default,
        settings=variants.settings,
    )
    for part, outcome in zip(parts, in_processes(act, parts, jobs), strict=True):
        if outcome is None:
            raise PlanMethodError(
                "The process at work on {} to {} was killed, twice; perhaps it needs more memory "
                "than there is. Check fewer works at once.",
                part[0].student or part[0].where,
                part[-1].student or part[-1].where,
            )
        yield outcome.result() or []


def check_part(
    part: list[Work],
    *,
    problem: Path,
    variant: str | None,
    settings: Settings,
) -> list[CheckedWork]:
    """Check some of the works of a group."""
    from planmethod.check.group import Variants, check_works

    return list(check_works(Variants(problem, settings, variant), part))


def _warn_of_others(problem: Path, works: list[Work]) -> None:
    """Warn of works that name another problem."""
    for work in works:
        named = Path(work.problem).stem if work.problem else problem.stem
        if named != problem.stem:
            click.echo(
                say(
                    "Warning: {}: the work is of {}, it is checked as {}.",
                    work.student or work.where,
                    named,
                    problem.stem,
                ),
                err=True,
            )


def _print_json(checked: list[CheckedWork]) -> None:
    from planmethod.check.pages.listing import record

    click.echo(json_text([record(one) for one in checked]))


def _write_results(
    variants: Variants,
    paths: list[Path],
    checked: list[CheckedWork],
    out: Path,
    salt: str | None,
    lang: str,
) -> None:
    from planmethod.check.group import keys_of
    from planmethod.check.pages.files import anonymous, write_all

    if salt is not None:
        checked = anonymous(checked, salt)
    keys, inputs = keys_of(variants, checked), [variants.path, *paths]
    with bar(len(checked), long=len(checked) >= MANY_WORKS) as done:
        written = write_all(out, checked, keys, variants.settings, inputs, lang, done=done)
    for path in written:
        click.echo(str(path))


def _write_keys(
    files: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    settings: Settings,
    out: Path,
    lang: str,
    jobs: int,
) -> None:
    from planmethod.check.pages.keypage import key_document
    from planmethod.note.wording import language
    from planmethod.note.writers.plain import plain_document
    from planmethod.problem import variant_names
    from planmethod.render.backends.output import write

    act = partial(key_of, settings=settings)
    words = language(lang)
    code = ExitCode.DONE
    for path in files:
        keys: list[Key] = []
        try:
            every = all_variants or (variant is None and bool(variant_names(path)))
        except OSError:
            every = False
        code = each((path,), variant, every, act, jobs=jobs, take=keys.append) or code
        if not keys:
            continue
        click.echo(plain_document(key_document(keys, words), words))
        name = stem(keys[0].problem) if len(keys) == 1 else path.stem
        for ending, data in key_files(keys, words):
            target = out / f"{name}-key.{ending}"
            write(target, data)
            click.echo(str(target))
    finish(code)


def key_of(todo: Todo, settings: Settings) -> Key:
    """Return the key of a problem of any kind."""
    from planmethod.check.group import key_of_problem

    return key_of_problem(todo.kind, todo.problem, settings)


def key_files(keys: list[Key], words: Language) -> Iterator[tuple[str, bytes]]:
    """Yield the files of keys, each with its ending."""
    from planmethod.check.pages.keypage import key_pdf, key_xlsx

    yield "pdf", key_pdf(keys, words)
    yield "xlsx", key_xlsx(keys, words)
