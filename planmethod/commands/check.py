"""Command ``check``: answers of students against the plans."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click
from msgspec import Struct
from msgspec.structs import replace

from planmethod.commands.helptext import Spoken
from planmethod.commands.output import bar, json_text
from planmethod.commands.problems import (
    Todo,
    each,
    finish,
    guarded,
    language_of_file,
    of_linkages,
    stem,
    tell_doubts,
)
from planmethod.errors import ExitCode, PlanMethodError
from planmethod.languages import say, spoken
from planmethod.options import PathType, UsageError, jobs_option, out_option, problem_lang_option

if TYPE_CHECKING:
    from planmethod.check.exchange.cloze import QuizQuestion
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
@click.option(
    "--json", "as_json", is_flag=True, help="Verdicts, or the key, as JSON, and no files."
)
@click.option(
    "--moodle",
    type=PathType(dir_okay=False),
    metavar="FILE",
    help="With --key: a question for each variant for Moodle, in place of the key's files.",
)
@click.option(
    "--gift",
    type=PathType(dir_okay=False),
    metavar="FILE",
    help="With --key: the numbers as questions in GIFT, in place of the key's files.",
)
@click.option(
    "--columns",
    multiple=True,
    metavar="HEAD=WHAT",
    help="What a column of an export of a learning management system is; or a TOML file of such.",
)
@click.option(
    "--layer",
    "layers",
    multiple=True,
    metavar="NAME=PLAN",
    help="Which plan stands on a layer or in a colour of a drawing: velocity, acceleration, plans.",
)
@click.option(
    "--gradebook",
    is_flag=True,
    help="Write gradebook.csv and feedback.zip too, as for works of such an export.",
)
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
@problem_lang_option
@guarded
def check(
    files: tuple[Path, ...],
    key_only: bool,
    variant: str | None,
    all_variants: bool,
    as_json: bool,
    moodle: Path | None,
    gift: Path | None,
    columns: tuple[str, ...],
    layers: tuple[str, ...],
    gradebook: bool,
    out: Path,
    settings_file: Path | None,
    policy: str | None,
    profile: str | None,
    overrides: Path | None,
    anonymize: bool,
    salt: str,
    jobs: int,
    lang: str | None,
) -> None:
    """Check answers: key first, then one student's work or a whole group's.

    PROBLEM asks what its [[answers]] say, else what the key lists. WORK is one student's JSON or
    TOML, a group's CSV or XLSX, a form filled in, or a drawing as DXF. Writes results.xlsx,
    results.csv, run.json and a page for each student.
    """
    settings = _settings(settings_file, policy, profile)
    if key_only:
        written = language_of_file(files[0], lang)
        asked = KeyFiles(out, written, as_json, moodle, gift)
        _write_keys(files, variant, all_variants, settings, asked, jobs)
        return
    if moodle or gift:
        raise UsageError("--moodle and --gift go with --key: they ask, and answers are read back")
    if all_variants:
        raise UsageError("--all-variants goes with --key: every work names its own variant")
    problem, *paths = files
    if not paths:
        raise UsageError("name a WORK after the PROBLEM, or ask for its --key")
    from planmethod.check.group import Variants

    variants = Variants(problem, settings, variant)
    works, addresses = _read(variants, paths, columns, layers)
    checked = _checked(variants, works, jobs)
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
        hidden = salt if anonymize else None
        book = {} if anonymize else addresses or {}
        also = book if gradebook or addresses is not None else None
        _write_results(variants, paths, checked, out, hidden, language_of_file(problem, lang), also)
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


def _read(
    variants: Variants, paths: list[Path], columns: tuple[str, ...], layers: tuple[str, ...]
) -> tuple[list[Work], dict[str, str] | None]:
    """Read the works of files; of exports also how the system knows the students, else None."""
    from planmethod.check.exchange.quiz import gaps_of
    from planmethod.check.exchange.responses import is_export, read_columns, read_responses
    from planmethod.check.measured.drawing import is_drawing
    from planmethod.check.measured.layers import read_layers
    from planmethod.check.works import read_works

    told, drawn = read_columns(columns), read_layers(layers)
    works: list[Work] = []
    addresses: dict[str, str] | None = None
    for path in paths:
        if is_drawing(path):
            from planmethod.check.measured.plan import read_drawing  # its readers of files cost

            works.append(read_drawing(path, drawn, variants.task(variants.default)))
            continue
        if not told and not is_export(path):
            works += read_works(path)
            continue
        found = read_responses(
            path,
            told,
            variants.names,
            lambda name: gaps_of(variants.task(name or variants.default)),
        )
        works += found.works
        addresses = {**(addresses or {}), **found.addresses}
    return works, addresses


def _checked(variants: Variants, works: list[Work], jobs: int) -> list[CheckedWork]:
    from planmethod.check.copied import compared
    from planmethod.check.group import check_works

    if jobs > 1 and len(works) > jobs:
        parts = _in_processes(variants, works, jobs)
    else:
        parts = ([one] for one in check_works(variants, works))
    checked: list[CheckedWork] = []
    with bar(len(works), long=len(works) >= MANY_WORKS) as done:
        for part in parts:
            checked += part
            done(len(part))
    return compared(checked)


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
    addresses: dict[str, str] | None,
) -> None:
    """Write the files of a group; those of a gradebook where there are addresses, even none."""
    from planmethod.check.group import keys_of
    from planmethod.check.pages.files import anonymous, write_all

    if salt is not None:
        checked = anonymous(checked, salt)
    keys, inputs = keys_of(variants, checked), [variants.path, *paths]
    with bar(len(checked), long=len(checked) >= MANY_WORKS) as done:
        written = write_all(
            out,
            checked,
            keys,
            variants.settings,
            inputs,
            lang,
            hidden=salt is not None,
            done=done,
        )
    if addresses is not None:
        written += _write_gradebook(variants, checked, out, written, addresses, lang)
    for path in written:
        click.echo(str(path))


def _write_gradebook(
    variants: Variants,
    checked: list[CheckedWork],
    out: Path,
    written: list[Path],
    addresses: dict[str, str],
    lang: str,
) -> list[Path]:
    from planmethod.check.exchange.gradebook import feedback_zip, gradebook_csv
    from planmethod.note.wording import language
    from planmethod.render.backends.output import write

    mark = variants.settings.mark
    marks = [mark(work.points / work.of) if work.of else "" for work in checked]
    pages = [path for path in written if path.parent.name == "pages"]
    files = {
        "gradebook.csv": gradebook_csv(checked, marks, addresses, language(lang)),
        "feedback.zip": feedback_zip(checked, pages),
    }
    for name, data in files.items():
        write(out / name, data)
    return [out / name for name in files]


class KeyFiles(Struct, frozen=True):
    """Where keys are written, and as what (файлы ключа)."""

    out: Path
    lang: str
    as_json: bool
    moodle: Path | None
    gift: Path | None


class Asked(Struct, frozen=True):
    """The key of a variant, and its question where one is written (ключ и вопрос)."""

    key: Key
    question: QuizQuestion | None


def _write_keys(
    files: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    settings: Settings,
    asked: KeyFiles,
    jobs: int,
) -> None:
    from planmethod.problem import variant_names

    as_questions = bool(asked.moodle or asked.gift)
    act = partial(asked_of, settings=settings, lang=asked.lang if as_questions else None)
    code = ExitCode.DONE
    whole: list[Asked] = []
    for path in files:
        found: list[Asked] = []
        try:
            every = all_variants or (variant is None and bool(variant_names(path)))
        except OSError:
            every = False
        ahead = None if as_questions else partial(keys_ahead, settings=settings)
        code = each((path,), variant, every, act, jobs=jobs, take=found.append, ahead=ahead) or code
        whole += found
        if found and not as_questions and not asked.as_json:
            _write_key(path, [one.key for one in found], asked)
    if asked.as_json:
        from planmethod.check.exchange.keyrecord import key_record

        click.echo(json_text([key_record(one.key) for one in whole]))
    questions = [one.question for one in whole if one.question is not None]
    if questions:
        _write_questions(questions, asked)
    finish(code)


def _write_questions(questions: list[QuizQuestion], asked: KeyFiles) -> None:
    """Write the questions for a learning management system."""
    from planmethod.check.exchange.cloze import moodle_xml
    from planmethod.check.exchange.gift import gift
    from planmethod.note.wording import language
    from planmethod.render.backends.output import write

    for path, written in ((asked.moodle, moodle_xml), (asked.gift, gift)):
        if path is not None:
            write(path, written(questions, language(asked.lang)))
            click.echo(str(path), err=asked.as_json)


def _write_key(path: Path, keys: list[Key], asked: KeyFiles) -> None:
    from planmethod.check.pages.keypage import key_document
    from planmethod.note.wording import language
    from planmethod.note.writers.plain import plain_document
    from planmethod.render.backends.output import write

    words = language(asked.lang)
    click.echo(plain_document(key_document(keys, words), words))
    name = stem(keys[0].problem) if len(keys) == 1 else path.stem
    for ending, data in key_files(keys, words):
        target = asked.out / f"{name}-key.{ending}"
        write(target, data)
        click.echo(str(target))


def asked_of(todo: Todo, settings: Settings, lang: str | None, *, mistakes: bool = True) -> Asked:
    """Return the key of a problem of any kind, and its question in a language.

    Without ``mistakes`` it tells none: to find them is half of the work.
    """
    from planmethod.check.group import task_of_problem
    from planmethod.check.key import key_of_task

    task = task_of_problem(todo.kind, todo.problem, settings)
    if todo.kind is None:
        tell_doubts(todo.linkage)
    key = key_of_task(task, named=None if mistakes else lambda _: ())
    if lang is None:
        return Asked(key, None)
    from planmethod.check.exchange.variant import question_of
    from planmethod.note.wording import language

    return Asked(key, question_of(task, todo.kind, language(lang)))


def keys_ahead(todo: Sequence[Todo], settings: Settings) -> dict[int, Asked]:
    """Return the keys of linkages that are asked alike, by their numbers."""
    from planmethod.check.together import keys_together

    keys = of_linkages(todo, lambda problems: keys_together(problems, settings))
    return {k: Asked(key, None) for k, key in keys.items()}


def key_of(todo: Todo, settings: Settings) -> Key:
    """Return the key of a problem of any kind."""
    return asked_of(todo, settings, None).key


def key_files(keys: list[Key], words: Language) -> Iterator[tuple[str, bytes]]:
    """Yield the files of keys, each with its ending."""
    from planmethod.check.pages.keypage import key_pdf, key_xlsx

    yield "pdf", key_pdf(keys, words)
    yield "xlsx", key_xlsx(keys, words)
