"""Command ``check``: answers of students against the plans."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click
from msgspec import Struct
from msgspec.structs import replace

from planmethod.commands.command import command
from planmethod.commands.output import bar, json_text
from planmethod.commands.problems import (
    LoadedProblem,
    act_by_kind,
    fail,
    finish,
    for_each_problem,
    language_of_file,
)
from planmethod.errors import ExitCode, PlanMethodError
from planmethod.languages import current_language, translate
from planmethod.options import (
    PathType,
    ProblemChoice,
    UsageError,
    argument,
    basename,
    jobs_option,
    json_option,
    option,
    out_option,
    problem_lang_option,
    settings_option,
    variant_option,
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


class CheckOptions(Struct, frozen=True, kw_only=True):
    """Options of ``check``."""

    files: tuple[Path, ...] = argument(
        nargs=-1, required=True, metavar="PROBLEM [WORK]...", type=PathType()
    )
    key_only: bool = option(
        "--key", is_flag=True, help="Print and write the answer key of every PROBLEM."
    )
    variant: str | None = variant_option("Variant of submissions that do not name one.")
    all_variants: bool = option(
        "--all-variants", is_flag=True, help="With --key: the keys of all variants."
    )
    as_json: bool = json_option("Print verdicts or the key as JSON, and write no files.")
    moodle: Path | None = option(
        "--moodle",
        type=PathType(dir_okay=False),
        metavar="FILE",
        help="With --key: write Moodle questions, one for each variant, instead of the "
        "key's files.",
    )
    gift: Path | None = option(
        "--gift",
        type=PathType(dir_okay=False),
        metavar="FILE",
        help="With --key: write the numbers as GIFT questions instead of the key's files.",
    )
    columns: tuple[str, ...] = option(
        "--columns",
        multiple=True,
        metavar="HEAD=WHAT",
        help="Meaning of a column in an export of a learning management system, or a TOML "
        "file with such pairs.",
    )
    layers: tuple[str, ...] = option(
        "--layer",
        multiple=True,
        metavar="NAME=PLAN",
        help="Plan on a layer or in a colour of a drawing: velocity, acceleration, or "
        "plans for both.",
    )
    gradebook: bool = option(
        "--gradebook",
        is_flag=True,
        help="Also write gradebook.csv and feedback.zip, as for submissions from an export.",
    )
    out: Path = out_option()
    settings_file: Path | None = settings_option(
        "TOML file with the department's tolerances, points and marks."
    )
    policy: str | None = option(
        "--policy", type=click.Choice(POLICIES), help="Tolerance that counts."
    )
    profile: str | None = option(
        "--profile",
        type=click.Choice(("board", "cad", "coarse")),
        help="Accuracy of the students' drawings.",
    )
    overrides: Path | None = option(
        "--overrides",
        type=PathType(dir_okay=False),
        metavar="FILE",
        help="File of points and remarks set by hand. Default: overrides.csv in the output folder.",
    )
    anonymize: bool = option("--anonymize", is_flag=True, help="Replace names by stable numbers.")
    salt: str = option(
        "--salt",
        default="",
        metavar="WORD",
        help="Secret word of the course from which these numbers are computed.",
    )
    jobs: int = jobs_option()
    lang: str | None = problem_lang_option()

    @property
    def own_salt(self) -> str | None:
        """Word that hidden names depend on; None where names are shown."""
        return self.salt if self.anonymize else None

    @property
    def overrides_file(self) -> Path | None:
        """File of scores and remarks of the instructor, which need not exist."""
        return self.overrides or (None if self.as_json else self.out / "overrides.csv")

    @property
    def as_questions(self) -> bool:
        """Whether questions for a learning management system are written."""
        return self.moodle is not None or self.gift is not None

    def settings(self) -> Settings:
        """Return how works are judged."""
        from planmethod.check.marks import DEFAULT, load_settings

        settings = DEFAULT if self.settings_file is None else load_settings(self.settings_file)
        return replace(
            settings,
            policy=self.policy or settings.policy,
            profile=self.profile or settings.profile,
        )


@command(
    CheckOptions,
    findings="An answer, a table or a file of the submissions could not be read or graded.",
)
def check(options: CheckOptions) -> None:
    """Check answers of one student or of a group; with --key, print and write the answer key.

    The questions are [[answers]] of PROBLEM, else the list of the key. WORK is a student's JSON or
    TOML, a group's CSV or XLSX, a filled-in form, or a DXF drawing. Writes results.xlsx,
    results.csv, run.json and a page for each student.
    """
    settings = options.settings()
    if options.key_only:
        _write_keys(options, settings)
        return
    if options.as_questions:
        raise UsageError("--moodle and --gift require --key: they write questions")
    if options.all_variants:
        raise UsageError("--all-variants requires --key: every submission names its own variant")
    problem, *paths = options.files
    if not paths:
        raise UsageError("name a WORK after the PROBLEM, or request the key with --key")
    from planmethod.check.checking import Variants

    variants = Variants(problem, settings, options.variant)
    read = _read(variants, paths, options)
    checked = _with_overrides(_checked(variants, read.works, options.jobs), read.works, options)
    from planmethod.check.pages.student import unread_lines
    from planmethod.note.wording import get_language

    _warn_of_others(problem, read.works)
    lost = bool(read.unread)
    if options.as_json:
        _print_json(checked, options.own_salt)
    else:
        lost |= _write_results(variants, checked, read, options)
    for line, is_lost in unread_lines(checked, get_language(current_language())):
        click.echo(line, err=True)
        lost |= is_lost
    for line in _unread_tables(read.works):
        click.echo(line, err=True)
        lost = True
    _report_provisional(checked, options.overrides_file, settings)
    finish(ExitCode.FINDINGS if lost else ExitCode.DONE)


def _with_overrides(
    checked: list[GradedSubmission], works: list[Submission], options: CheckOptions
) -> list[GradedSubmission]:
    """Return graded works with the scores of the instructor; report lines that fit no work."""
    from planmethod.check.pages.files import hidden_name
    from planmethod.check.pages.listing import apply_overrides, read_overrides

    overrides_file = options.overrides_file
    if overrides_file is None:
        return checked
    told = read_overrides(overrides_file)
    if options.anonymize:
        hidden = {hidden_name(work.student, options.salt): work.student for work in works}
        told = tuple(replace(one, student=hidden.get(one.student, one.student)) for one in told)
        if options.overrides is None:
            _reject_names(overrides_file, hidden)
    checked, unused = apply_overrides(checked, told)
    for where in unused:
        click.echo(
            translate("Warning: {}: this submission or answer does not exist.", where), err=True
        )
    return checked


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
                    "Provisional: {}: mark {}, {:g} of {:g} points. Unreadable answers, "
                    "which count as zero until {} has points for them: {}.",
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


def _read(variants: Variants, paths: list[Path], options: CheckOptions) -> WorksRead:
    """Read the submissions of files; an unreadable one is reported and the others continue."""
    from planmethod.check.checking import failure_of
    from planmethod.check.exchange.responses import read_columns
    from planmethod.check.measured.drawing import read_layers
    from planmethod.check.model import CheckFailure
    from planmethod.check.submissions import SubmissionError

    told, drawn = read_columns(options.columns), read_layers(options.layers)
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
        from planmethod.check.measured import plan  # its readers of files cost

        drawing = plan.open_drawing(path)
        variant = plan.variant_of(drawing, variants.names) or variants.default
        return [plan.read_drawing(drawing, drawn, variants.task(variant))], None
    if not columns and not is_export(path):
        return read_works(path), None
    found = read_responses(
        path, columns, variants.names, lambda name: gaps_of(variants.task(name or variants.default))
    )
    return found.submissions, found.addresses


def _checked(variants: Variants, works: list[Submission], jobs: int) -> list[GradedSubmission]:
    from planmethod.check.checking import check_works
    from planmethod.check.copies import mark_similar_submissions

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

    phrase = translate("its process was killed twice; perhaps it needs more memory")
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
                    "Warning: {}: the submission belongs to {}, but is checked as {}.",
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
    variants: Variants, checked: list[GradedSubmission], read: WorksRead, options: CheckOptions
) -> bool:
    """Write the files of a group; those of a gradebook for works of an export, or if requested.

    Returns whether any of it failed.
    """
    from planmethod.check.checking import keys_of
    from planmethod.check.exchange.gradebook import feedback_zip, gradebook_csv
    from planmethod.check.pages.files import GradingRun, anonymous, write_all
    from planmethod.note.wording import get_language

    salt = options.own_salt
    if salt is not None:
        checked = anonymous(checked, salt)
    keys, lang = keys_of(variants, checked), language_of_file(variants.path, options.lang)
    language = get_language(lang)
    tables: dict[str, Table] = {}
    if options.gradebook or read.addresses is not None:
        known = {} if options.anonymize else read.addresses or {}
        tables = {
            "gradebook.csv": lambda marks, pages: gradebook_csv(checked, marks, known, language),
            "feedback.zip": lambda marks, pages: feedback_zip(checked, pages),
        }
    with bar(len(checked), long=len(checked) >= MANY_SUBMISSIONS) as done:
        written = write_all(
            options.out,
            checked,
            keys,
            GradingRun(variants.settings, options.files, lang, salt is not None, read.unread),
            tables=tables,
            done=done,
        )
    for path in written.paths:
        click.echo(str(path))
    for student, failure in written.failures:
        click.echo(translate("No page: {}: {}. See run.json.", student, failure.message), err=True)
    for path in written.changed_files:
        text = "Warning: {} was changed after an earlier run wrote it, and is kept."
        click.echo(translate(text, path), err=True)
    return bool(written.failures)


class KeyQuestion(Struct, frozen=True):
    """The key of a variant, and its question where one is written (ключ и вопрос)."""

    key: Key
    question: QuizQuestion | None


def _write_keys(options: CheckOptions, settings: Settings) -> None:
    """Print and write the key of every problem, or its questions."""
    lang = language_of_file(options.files[0], options.lang)
    act = partial(key_question, settings=settings, lang=lang if options.as_questions else None)
    ahead = None if options.as_questions else partial(keys_ahead, settings=settings)
    code = ExitCode.DONE
    whole: list[KeyQuestion] = []
    for path in options.files:
        found: list[KeyQuestion] = []
        choice = _key_choice(path, options)
        code = (
            for_each_problem(
                choice, act, jobs=options.jobs, on_result=found.append, act_on_many=ahead
            )
            or code
        )
        whole += found
        if found and not options.as_questions and not options.as_json:
            _write_key(path, [one.key for one in found], options.out, lang)
    if options.as_json:
        from planmethod.check.exchange.quiz import key_record

        click.echo(json_text([key_record(one.key) for one in whole]))
    questions = [one.question for one in whole if one.question is not None]
    if questions:
        _write_questions(questions, options, lang)
    finish(code)


def _key_choice(path: Path, options: CheckOptions) -> ProblemChoice:
    """Return the variants of a file whose keys are meant: all, if none is named."""
    from planmethod.problem import variant_names

    try:
        every = options.all_variants or (options.variant is None and bool(variant_names(path)))
    except OSError:
        every = False
    return ProblemChoice(problems=(path,), variant=options.variant, all_variants=every)


def _write_questions(questions: list[QuizQuestion], options: CheckOptions, lang: str) -> None:
    """Write the questions for a learning management system."""
    from planmethod.check.exchange.quiz import gift, moodle_xml
    from planmethod.note.wording import get_language
    from planmethod.render.backends.output import write

    for path, written in ((options.moodle, moodle_xml), (options.gift, gift)):
        if path is not None:
            write(path, written(questions, get_language(lang)))
            click.echo(str(path), err=options.as_json)


def _write_key(path: Path, keys: list[Key], out: Path, lang: str) -> None:
    from planmethod.check.pages.keypage import key_document
    from planmethod.note.wording import get_language
    from planmethod.note.writers.terminal import plain_document
    from planmethod.render.backends.output import write

    language = get_language(lang)
    click.echo(plain_document(key_document(keys, language), language))
    name = basename(keys[0].problem) if len(keys) == 1 else path.stem
    for ending, data in key_files(keys, language):
        target = out / f"{name}-key.{ending}"
        write(target, data, output_root=out)
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
