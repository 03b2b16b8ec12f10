"""What a language must be able to say of the checking of works (слова проверки работ)."""

from __future__ import annotations

from collections.abc import Mapping

from msgspec import Struct


class MistakeWords(Struct, frozen=True):
    """What is said of one mistake.

    Attributes
    ----------
    name : str
        What was done, without a full stop: for tables.
    so : str
        Goes on from "this comes out if".
    advice : str
        Whole sentences: how it is right, and what to do now.
    """

    name: str
    so: str
    advice: str


class KeyWording(Struct, frozen=True, kw_only=True):
    """What stands on the key; see `planmethod.check.pages.keypage`.

    ``columns`` are those of its table, ``rows`` the heads of the leading columns where several
    variants or positions stand in one table; ``unseen`` and ``zero`` are notes on an answer,
    ``note`` says what the tolerance is, ``computed`` that of a problem without plans.
    """

    title: str
    variant: str
    position: str
    scales: str
    columns: tuple[str, ...]
    rows: tuple[str, str]
    unseen: str
    zero: str
    note: str
    computed: str
    hidden: str
    sheet: str
    sheet_hidden: str


class ComparedWording(Struct, frozen=True, kw_only=True):
    """What stands beside a student's own numbers before he hands them in.

    ``columns`` are the quantity, his value, the exact one, the difference, per cent of it.
    """

    columns: tuple[str, ...]
    note: str


class ResultWording(Struct, frozen=True, kw_only=True):
    """What stands in the tables of results: names of the sheets, heads of their columns.

    ``by_code`` and ``by_answer`` are the two tables on the sheet of the group's mistakes.
    """

    sheets: tuple[str, str, str, str]
    summary: tuple[str, ...]
    answers: tuple[str, ...]
    by_code: tuple[str, ...]
    by_answer: tuple[str, ...]
    settings: tuple[str, str]
    perhaps: str
    unknown: str
    suspicious: str
    by_hand: str
    files: str


class StudentWording(Struct, frozen=True, kw_only=True):
    """What stands on the page of a student; see `planmethod.check.pages.remarks`.

    ``columns`` are those of the table of answers. Places are ``answer`` (symbols of quantities),
    ``own`` and ``right`` (numbers with units), ``tol``, ``segment``, ``so``, ``advice``, ``where``.
    """

    title: str
    student: str
    variant: str
    points: str
    mark: str
    counted: str
    remarks: str
    all_right: str
    answers: str
    columns: tuple[str, ...]
    tolerance: str
    computed: str
    plans: str
    plan_names: Mapping[str, str]
    plan_title: str
    position: str
    legend: str
    legend_mistake: str
    redraw: str
    redraw_line: str
    compared: str
    mistake: str
    mistake_here: Mapping[str, str]
    also: str
    follow: str
    one_of: str
    one_of_end: str
    unknown: str
    unknown_computed: str
    kept: str
    reduced: str
    inherited: str
    near: str
    near_points: str
    inconsistent: str
    sense: str
    unseen: str
    no_sense: str
    slip: str
    slip_bare: str
    blank: str
    unreadable: str
    unreadable_other: str
    remark: str
    page: str
    quoted: str
    source: str
    share: str


class CheckWording(Struct, frozen=True, kw_only=True):
    """What checking says in one language.

    ``verdicts`` are by the values of `planmethod.check.model.Verdict`, ``senses`` by those of
    `planmethod.check.model.Sense` (a sign and its word), ``mistakes`` by their codes.
    """

    verdicts: Mapping[str, str]
    senses: Mapping[str, tuple[str, str]]
    mistakes: Mapping[str, MistakeWords]
    key: KeyWording
    results: ResultWording
    student: StudentWording
    compared: ComparedWording


class FormWording(Struct, frozen=True, kw_only=True):
    """Words of the form (бланк ответов) and of works that come back.

    ``columns`` are in the order of the form; all of them, and ``student``, ``variant`` and
    ``problem``, are heads that are read again. ``scales`` are by the names of the scales,
    ``senses`` by the values of `planmethod.check.model.Sense`, ``unread`` by those of
    `planmethod.check.model.Unread`.
    """

    sheet: str
    title: str
    student: str
    group: str
    variant: str
    problem: str
    scales: Mapping[str, str]
    ruler: str
    advice: tuple[str, ...]
    columns: tuple[str, ...]
    position: str
    agrees: str
    differs: str
    senses: Mapping[str, str]
    units: tuple[str, ...]
    refused: str
    unread: Mapping[str, str]
