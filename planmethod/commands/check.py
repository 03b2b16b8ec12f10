"""Command ``check``: answers of students against the plans."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from msgspec import Struct
from msgspec.structs import replace

from planmethod.commands.output import LocalizedCommand, bar, json_text
from planmethod.commands.problems import (
    LoadedProblem,
    act_by_kind,
    fail,
    finish,
    for_each_problem,
    guarded,
    language_of_file,
)
from planmethod.errors import ExitCode, PlanMethodError
from planmethod.languages import current_language, translate
from planmethod.options import (
    PathType,
    UsageError,
    basename,
    jobs_option,
    out_option,
    problem_lang_option,
    warn_each,
)

if TYPE_CHECKING:
    from planmethod.check.checking import Variants
    from planmethod.check.exchange.quiz import QuizQuestion
    from planmethod.check.key import Key
    from planmethod.check.marks import Settings
    from planmethod.check.model import CheckFailure, GradedSubmission, Submission
    from planmethod.check.pages.files import Table
    from planmethod.kind import ProblemKind
    from planmethod.note.wording import Language

POLICIES = ("construction", "department", "wider", "stricter")
MANY_SUBMISSIONS = 10
"""Submissions whose pages take about a second."""

FORMATS = ("html", "pdf")


@click.command(cls=LocalizedCommand)
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
    help="Plan on a layer or in a colour of a drawing: velocity, acceleration, plans.",
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
    help="Scores and remarks set by hand. Default: overrides.csv in the output folder.",
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
    from planmethod.check.checking import Variants

    variants = Variants(problem, settings, variant)
    found = _read(variants, paths, columns, layers)
    works = found.works
    checked = _checked(variants, works, jobs)
    from planmethod.check.pages.files import hidden_name
    from planmethod.check.pages.listing import apply_overrides, read_overrides
    from planmethod.check.pages.student import unread_lines
    from planmethod.note.wording import get_language

    hidden = {hidden_name(work.student, salt): work.student for work in works} if anonymize else {}
    by_hand = overrides or (None if as_json else out / "overrides.csv")
    if by_hand is not None:
        told = read_overrides(by_hand)
        if anonymize:
            told = tuple(replace(one, student=hidden.get(one.student, one.student)) for one in told)
            if overrides is None:
                _reject_names(by_hand, hidden)
        checked, unused = apply_overrides(checked, told)
        for where in unused:
            click.echo(translate("Warning: {}: no such work or answer.", where), err=True)
    _warn_of_others(problem, works)
    language, lost = get_language(current_language()), bool(found.unread)
    if as_json:
        _print_json(checked, salt if anonymize else None)
    else:
        addresses = {} if anonymize else found.addresses or {}
        lost |= _write_results(
            variants,
            paths,
            checked,
            out,
            salt if anonymize else None,
            language_of_file(problem, lang),
            addresses if gradebook or found.addresses is not None else None,
            found.unread,
        )
    for line, is_lost in unread_lines(checked, language):
        click.echo(line, err=True)
        lost |= is_lost
    for line in _unread_tables(works):
        click.echo(line, err=True)
        lost = True
    _report_provisional(checked, by_hand, settings)
    finish(ExitCode.FINDINGS if lost else ExitCode.DONE)


def _reject_names(path: Path, hidden: Mapping[str, str]) -> None:
    """Reject hidden names beside a file of the instructor that has them."""
    from planmethod.check.pages.folder import RunFolder
    from planmethod.check.pages.listing import students_of

    named = students_of(path) - hidden.keys()
    if named and not RunFolder(path.parent).owns(path.name):
        raise UsageError(
            "{0} names {1} student{1:||s}, and --anonymize would leave them there. Move it out of "
            "the folder and give it with --overrides, or name another folder with --out.",
            path,
            len(named),
        )


def _report_provisional(
    checked: list[GradedSubmission], overrides: Path | None, settings: Settings
) -> None:
    """Report the grades that may still change, and the reason."""
    from planmethod.check.pages.files import marks_of

    for one, mark in zip(checked, marks_of(checked, settings), strict=True):
        if one.is_provisional:
            click.echo(
                translate(
                    "Provisional: {}: mark {}, {:g} of {:g} points. Answers that cannot be read, "
                    "and count as none until {} has points for them: {}.",
                    one.work.student,
                    mark,
                    one.points,
                    one.of,
                    overrides or "overrides.csv",
                    len(one.open),
                ),
                err=True,
            )


def _unread_tables(works: list[Submission]) -> Iterator[str]:
    """Yield a line on each file without readable answers, with the columns it has."""
    from planmethod.check.model import Unread

    files: dict[str, list[Submission]] = {}
    for work in works:
        files.setdefault(work.location, []).append(work)
    for where, found in files.items():
        if any(work.answers for work in found):
            continue
        columns = [r.fault for work in found for r in work.remarks if r.reason is Unread.COLUMN]
        text = ", ".join(dict.fromkeys(columns)) or "—"
        yield translate(
            "{}: no answer was read. Unknown columns: {}. Name them: student, what, value, "
            "unit, mm, sense; or student and the quantities: v_B, omega_3.",
            where,
            text,
        )


def _settings(file: Path | None, policy: str | None, profile: str | None) -> Settings:
    from planmethod.check.marks import DEFAULT, load_settings

    settings = DEFAULT if file is None else load_settings(file)
    return replace(settings, policy=policy or settings.policy, profile=profile or settings.profile)


class WorksRead(Struct, frozen=True):
    """Submissions of files (прочитанные работы).

    Attributes
    ----------
    works : list of Submission
    addresses : dict of str to str or None
        Addresses of the students in the system; None without an export.
    unread : dict of Path to CheckFailure
        Unreadable files, and the reasons.
    """

    works: list[Submission]
    addresses: dict[str, str] | None
    unread: dict[Path, CheckFailure]


def _read(
    variants: Variants, paths: list[Path], columns: tuple[str, ...], layers: tuple[str, ...]
) -> WorksRead:
    """Read the submissions of files; an unreadable one is reported and the others continue."""
    from planmethod.check.checking import failure_of
    from planmethod.check.exchange.responses import read_columns
    from planmethod.check.measured.drawing import read_layers
    from planmethod.check.model import CheckFailure
    from planmethod.check.submissions import SubmissionError

    told, drawn = read_columns(columns), read_layers(layers)
    works: list[Submission] = []
    addresses: dict[str, str] | None = None
    unread: dict[Path, CheckFailure] = {}
    code = ExitCode.DONE
    for path in paths:
        try:
            found, known = _read_file(variants, path, told, drawn)
        except SubmissionError as error:
            unread[path], code = CheckFailure(str(error)), error.exit_code
            fail(error)
        except (PlanMethodError, click.ClickException, MemoryError):
            raise
        except Exception as error:  # an internal error: the other files are read
            unread[path], code = failure_of(error), ExitCode.USAGE
            click.echo(translate("Error: {}: {}", path, unread[path].message), err=True)
        else:
            works += found
            if known is not None:
                addresses = {**(addresses or {}), **known}
    if not works:
        finish(code)
    return WorksRead(works, addresses, unread)


def _read_file(
    variants: Variants, path: Path, columns: dict[str, str], drawn: dict[str, str]
) -> tuple[list[Submission], dict[str, str] | None]:
    """Read the submissions of a file, and of an export the students' addresses, else None."""
    from planmethod.check.exchange.quiz import gaps_of
    from planmethod.check.exchange.responses import is_export, read_responses
    from planmethod.check.measured.drawing import is_drawing
    from planmethod.check.submissions import read_works

    if is_drawing(path):
        from planmethod.check.measured.plan import read_drawing  # its readers of files cost

        return [read_drawing(path, drawn, variants.task(variants.default))], None
    if not columns and not is_export(path):
        return read_works(path), None
    found = read_responses(
        path, columns, variants.names, lambda name: gaps_of(variants.task(name or variants.default))
    )
    return found.submissions, found.addresses


def _checked(variants: Variants, works: list[Submission], jobs: int) -> list[GradedSubmission]:
    from planmethod.check.checking import check_works
    from planmethod.check.grading import mark_similar_submissions

    if jobs > 1 and len(works) > jobs:
        parts = _in_processes(variants, works, jobs)
    else:
        parts = ([one] for one in check_works(variants, works))
    checked: list[GradedSubmission] = []
    with bar(len(works), long=len(works) >= MANY_SUBMISSIONS) as done:
        for part in parts:
            checked += part
            done(len(part))
    if all(one.failure is not None and not one.failure.trace for one in checked):
        for one in checked:
            if not one.work.failure:
                variants.task(one.variant)  # none has a grade: raises the reason, and ends the run
    return mark_similar_submissions(checked)


def _in_processes(
    variants: Variants, works: list[Submission], jobs: int
) -> Iterator[list[GradedSubmission]]:
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
        if outcome is not None:
            yield outcome.result() or []
            continue
        alone = [[work] for work in part]  # one of them is what kills a process
        for work, own in zip(part, in_processes(act, alone, jobs), strict=True):
            yield [_killed(work)] if own is None else own.result() or []


def _killed(work: Submission) -> GradedSubmission:
    """Return the failed result of a submission whose processes were all killed."""
    from planmethod.check.checking import unmarked
    from planmethod.check.model import CheckFailure

    phrase = translate("the process at work on it was killed, twice; perhaps it needs more memory")
    return unmarked(work, work.variant, CheckFailure(str(phrase)))


def check_part(
    part: list[Submission],
    *,
    problem: Path,
    variant: str | None,
    settings: Settings,
) -> list[GradedSubmission]:
    """Check some of the submissions of a group."""
    from planmethod.check.checking import Variants, check_works

    return list(check_works(Variants(problem, settings, variant), part))


def _warn_of_others(problem: Path, works: list[Submission]) -> None:
    """Warn of submissions that name another problem."""
    for work in works:
        named = Path(work.problem).stem if work.problem else problem.stem
        if named != problem.stem:
            click.echo(
                translate(
                    "Warning: {}: the work is of {}, it is checked as {}.",
                    work.student or work.location,
                    named,
                    problem.stem,
                ),
                err=True,
            )


def _print_json(checked: list[GradedSubmission], salt: str | None) -> None:
    from planmethod.check.pages.files import anonymous
    from planmethod.check.pages.listing import record

    shown = checked if salt is None else anonymous(checked, salt)
    click.echo(json_text([record(one) for one in shown]))


def _write_results(
    variants: Variants,
    paths: list[Path],
    checked: list[GradedSubmission],
    out: Path,
    salt: str | None,
    lang: str,
    addresses: dict[str, str] | None,
    unread: dict[Path, CheckFailure],
) -> bool:
    """Write the files of a group; those of a gradebook where there are addresses, even none.

    Returns whether any of it failed.
    """
    from planmethod.check.checking import keys_of
    from planmethod.check.exchange.gradebook import feedback_zip, gradebook_csv
    from planmethod.check.pages.files import anonymous, write_all
    from planmethod.note.wording import get_language

    if salt is not None:
        checked = anonymous(checked, salt)
    keys, inputs, language = keys_of(variants, checked), [variants.path, *paths], get_language(lang)
    tables: dict[str, Table] = {}
    if addresses is not None:
        known = addresses
        tables = {
            "gradebook.csv": lambda marks, pages: gradebook_csv(checked, marks, known, language),
            "feedback.zip": lambda marks, pages: feedback_zip(checked, pages),
        }
    with bar(len(checked), long=len(checked) >= MANY_SUBMISSIONS) as done:
        written = write_all(
            out,
            checked,
            keys,
            variants.settings,
            inputs,
            lang,
            hidden=salt is not None,
            unread=unread,
            tables=tables,
            done=done,
        )
    for path in written.paths:
        click.echo(str(path))
    for student, failure in written.failures:
        click.echo(translate("No page: {}: {}. See run.json.", student, failure.message), err=True)
    for path in written.changed_files:
        text = "Warning: {} was changed after an earlier run wrote it, and stays."
        click.echo(translate(text, path), err=True)
    return bool(written.failures)


class KeyFiles(Struct, frozen=True):
    """Files and formats of keys (файлы ключа)."""

    out: Path
    lang: str
    as_json: bool
    moodle: Path | None
    gift: Path | None


class KeyQuestion(Struct, frozen=True):
    """The key of a variant, and its question where one is written (ключ и вопрос)."""

    key: Key
    question: QuizQuestion | None


def _write_keys(
    files: tuple[Path, ...],
    variant: str | None,
    all_variants: bool,
    settings: Settings,
    files_wanted: KeyFiles,
    jobs: int,
) -> None:
    from planmethod.problem import variant_names

    as_questions = bool(files_wanted.moodle or files_wanted.gift)
    act = partial(key_question, settings=settings, lang=files_wanted.lang if as_questions else None)
    code = ExitCode.DONE
    whole: list[KeyQuestion] = []
    for path in files:
        found: list[KeyQuestion] = []
        try:
            every = all_variants or (variant is None and bool(variant_names(path)))
        except OSError:
            every = False
        ahead = None if as_questions else partial(keys_ahead, settings=settings)
        code = (
            for_each_problem(
                (path,), variant, every, act, jobs=jobs, on_result=found.append, act_on_many=ahead
            )
            or code
        )
        whole += found
        if found and not as_questions and not files_wanted.as_json:
            _write_key(path, [one.key for one in found], files_wanted)
    if files_wanted.as_json:
        from planmethod.check.exchange.quiz import key_record

        click.echo(json_text([key_record(one.key) for one in whole]))
    questions = [one.question for one in whole if one.question is not None]
    if questions:
        _write_questions(questions, files_wanted)
    finish(code)


def _write_questions(questions: list[QuizQuestion], key_files: KeyFiles) -> None:
    """Write the questions for a learning management system."""
    from planmethod.check.exchange.quiz import gift, moodle_xml
    from planmethod.note.wording import get_language
    from planmethod.render.backends.output import write

    for path, written in ((key_files.moodle, moodle_xml), (key_files.gift, gift)):
        if path is not None:
            write(path, written(questions, get_language(key_files.lang)))
            click.echo(str(path), err=key_files.as_json)


def _write_key(path: Path, keys: list[Key], targets: KeyFiles) -> None:
    from planmethod.check.pages.keypage import key_document
    from planmethod.note.wording import get_language
    from planmethod.note.writers.terminal import plain_document
    from planmethod.render.backends.output import write

    language = get_language(targets.lang)
    click.echo(plain_document(key_document(keys, language), language))
    name = basename(keys[0].problem) if len(keys) == 1 else path.stem
    for ending, data in key_files(keys, language):
        target = targets.out / f"{name}-key.{ending}"
        write(target, data, output_root=targets.out)
        click.echo(str(target))


def key_question(
    item: LoadedProblem, settings: Settings, lang: str | None, *, mistakes: bool = True
) -> KeyQuestion:
    """Return the key of a problem of any kind, and its question in a language.

    Without ``mistakes`` it has none, which saves half of the time.
    """
    from planmethod.check.calculation import task_of_problem
    from planmethod.check.key import key_of_task

    task = task_of_problem(item.kind, item.problem, settings)
    warn_each(item.problem, item.kind.accuracy_warnings(item.problem))
    key = key_of_task(task, named=None if mistakes else lambda _: ())
    if lang is None:
        return KeyQuestion(key, None)
    from planmethod.check.exchange.quiz import question_of
    from planmethod.note.wording import get_language

    return KeyQuestion(key, question_of(task, item.kind, get_language(lang)))


def keys_ahead(items: Sequence[LoadedProblem], settings: Settings) -> dict[int, KeyQuestion]:
    """Return the keys of problems that can be solved together, by their numbers."""
    from planmethod.check.key import compute_keys
    from planmethod.construct.drafting import PROFILES

    def keys_of(kind: ProblemKind[Any], problems: list[Any]) -> dict[int, Key]:
        return compute_keys(kind.batches(problems, PROFILES["board"]), settings)

    keys = act_by_kind(items, keys_of)
    return {k: KeyQuestion(key, None) for k, key in keys.items()}


def key_of(item: LoadedProblem, settings: Settings) -> Key:
    """Return the key of a problem of any kind."""
    return key_question(item, settings, None).key


def key_files(keys: list[Key], language: Language) -> Iterator[tuple[str, bytes]]:
    """Yield the files of keys, each with its ending."""
    from planmethod.check.pages.keypage import key_pdf, key_xlsx

    yield "pdf", key_pdf(keys, language)
    yield "xlsx", key_xlsx(keys, language)
