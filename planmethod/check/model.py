"""Questions, written answers and results of checking (вопросы, работы, заключения).

Numbers are in SI (degrees for angles), lengths on a plan in millimetres. Checking is a pure
function of a key and a submission: this module does not read files or draw.
"""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from msgspec import Struct, field


class Sense(Enum):
    """Sense of a quantity (направление): of turning, or the way a vector points."""

    CCW = "ccw"  # против часовой стрелки, ↺
    CW = "cw"  # по часовой стрелке, ↻
    UP = "up"
    DOWN = "down"
    LEFT = "left"
    RIGHT = "right"

    @property
    def turns(self) -> bool:
        """True for a sense of rotation."""
        return self in (Sense.CCW, Sense.CW)


class Verdict(Enum):
    """Verdict on an answer (заключение об ответе)."""

    OK = "ok"
    NEAR = "near"  # a little beyond the tolerance
    INHERITED = "inherited"  # wrong, but it follows from an earlier wrong answer
    WRONG = "wrong"
    INCONSISTENT = "inconsistent"  # right, but not from the student's own numbers
    UNSEEN = "unseen"  # not shown by the drawing: not graded against the exact value
    BLANK = "blank"
    UNREADABLE = "unreadable"


class Unread(Enum):
    """Why an entry cannot be read (почему не прочитано); the words are in ``note``."""

    NUMBER = "number"
    UNIT = "unit"
    OTHER = "other"  # a unit of another quantity
    SENSE = "sense"
    POSITION = "position"
    DATE = "date"  # the spreadsheet program made a date of a number
    FORMULA = "formula"  # one without a computed value
    TWICE = "twice"  # written before, and otherwise
    QUANTITY = "quantity"  # a value without the quantity that it is of
    SCALE = "scale"
    STUDENT = "student"  # a row without a student
    COLUMN = "column"  # a column with an unknown head
    KEY = "key"  # the same of a key in JSON or TOML
    FIELDS = "fields"  # a row with more fields than there are heads
    ROW = "row"  # a row of the form that is gone
    TEXT = "text"  # halves of characters, which no file can have
    PLAN = "plan"  # of a drawing: none of its lines are this plan
    LETTER = "letter"  # a vertex that no letter of the drawing names
    SEVERAL = "several"  # plans of a kind, and not as many as there are positions
    DOUBT = "doubt"  # a letter that may as well name another vertex
    VERTEX = "vertex"  # a vertex without a letter
    OPEN = "open"  # lines that should meet at a letter do not
    TURNED = "turned"  # a plan that is rotated as a whole
    MIRRORED = "mirrored"  # a drawing whose plans are all mirrored
    DRAWING_UNIT = "drawing_unit"  # a drawing in another unit than it states


class WrittenAnswer(Struct, frozen=True):
    """One answer as written in a submission (записанный ответ).

    Attributes
    ----------
    what : str
        Words of ``[published]`` ("v B3"); empty if ``id`` alone identifies the answer.
    id : str
        As in ``--ask`` or ``[[answers]]`` ("v_B3"); empty if ``what`` alone identifies it.
    value : float or None
        SI, degrees for angles, with the sign as written; None if there is none.
    unit : str
        As it was written; empty when none was: SI.
    step : float
        Unit of the last digit of ``value`` as written, SI: 0.01 of 2.35 m/s; 0 where unknown.
    mm : float or None
        Segment of the student's own plan, mm.
    mm_step : float
        Unit of the last digit of ``mm``.
    segment : str
        Letters of the segment: "p b3", "pb3"; empty when it is that of the quantity.
    sense : Sense or None
    position : int or None
        Position of the driver, from 0; None for the only one, or the one of ``[[answers]]``.
    location : str
        Its cell or row: ``Ответы!D12``, ``group.csv:14``, ``answers[3]``.
    unreadable : str
        Why it cannot be read, with the text; empty when it can.
    raw : str
        Value as it was written: "1,2·10^3".
    reason : Unread or None
        Kind of fault that ``unreadable`` describes, for pages in other languages: its message takes
        ``fault``.
    fault : str
        Text that cannot be read.
    """

    what: str = ""
    id: str = ""
    value: float | None = None
    unit: str = ""
    step: float = 0.0
    mm: float | None = None
    mm_step: float = 0.0
    segment: str = ""
    sense: Sense | None = None
    position: int | None = None
    location: str = ""
    unreadable: str = ""
    raw: str = ""
    reason: Unread | None = None
    fault: str = ""

    @property
    def is_blank(self) -> bool:
        """True for an unanswered question."""
        return self.value is None and self.mm is None and not self.unreadable


class Submission(Struct, frozen=True):
    """Answers of one student (работа студента).

    Attributes
    ----------
    student : str
        Number or name that identifies the student.
    answers : tuple of WrittenAnswer
    variant : str or None
    scales : mapping of str to float
        His own scales, unit per mm: ``mu_l`` (m/mm), ``mu_v``, ``mu_a``, ``mu_F``.
    ruler_mm : float or None
        Step to which the student reads lengths.
    problem : str
        Problem file that the student names; empty if none.
    location : str
        File that it was read from.
    remarks : tuple of WrittenAnswer
        Unreadable entries that are not answers: a scale, a row without a student.
    fingerprint : str
        Of the problem that the form was made for, see `planmethod.check.form.fingerprint_of`; empty
        for other submissions.
    drawn : str
        Profile of the measured drawing; empty for other submissions.
    failure : str
        Why one of several submissions in a file cannot be read at all; empty if it was read.
    """

    student: str
    answers: tuple[WrittenAnswer, ...]
    variant: str | None = None
    scales: Mapping[str, float] = field(default_factory=dict)
    ruler_mm: float | None = None
    problem: str = ""
    location: str = ""
    remarks: tuple[WrittenAnswer, ...] = ()
    fingerprint: str = ""
    drawn: str = ""
    failure: str = ""


class KeyEntry(Struct, frozen=True):
    """The right answer to one question (строка ключа).

    Attributes
    ----------
    id : str
        How it is called in every output.
    label : str
        Letters that the department uses, as plain text: ``v_B3``.
    symbol : str
        The same as rich text: ``v_{B3}``.
    unit : str
        SI; ``deg`` of angles, ``mm`` of lengths on a plan.
    requested_unit : str
        Unit requested by the task, as in the file; empty for ``unit``.
    per : float
        Size of one ``requested_unit`` in ``unit``: pages show values in the requested unit.
    exact : float
        With its sign if it has one.
    sigma : float
        One standard deviation of drafting; 0 for a computed quantity.
    tolerance : float
        Permitted deviation of an answer, before the rounding of the written value.
    is_visible : bool
        False where the drawing cannot show it: the tolerance is above the cap.
    zero : bool
        Too short to be measured: any answer within the tolerance of zero is right.
    mm : float or None
        Length of its segment on the plan, mm.
    scale : str
        Scale of that plan: ``mu_v``; empty if there is none.
    segment : str
        Letters of that segment: ``p-b3``.
    sense : Sense or None
        Direction or sense of rotation; None if it has none or it cannot be seen.
    asks_sense : bool
        Whether the sense is part of the answer.
    points : float
    position : int
        Position of the driver, from 0.
    hidden : tuple of str
        Codes of mistakes that this answer cannot show.
    signed : bool
        Whether the sign belongs to the number; the sign of a size has no meaning and is not shown.
    what : str
        The quantity in words of ``[published]``: ``v B3``.
    computed : bool
        Whether the value is computed first, and its segment laid off by it: aⁿ, aᵏ, v of the crank.
    """

    id: str
    label: str
    symbol: str
    unit: str
    exact: float
    sigma: float
    tolerance: float
    is_visible: bool = True
    zero: bool = False
    mm: float | None = None
    scale: str = ""
    segment: str = ""
    sense: Sense | None = None
    asks_sense: bool = False
    points: float = 1.0
    position: int = 0
    hidden: tuple[str, ...] = ()
    signed: bool = True
    requested_unit: str = ""
    per: float = 1.0
    what: str = ""
    computed: bool = False


class GradedAnswer(Struct, frozen=True):
    """Verdict of one answer (оценка ответа).

    Attributes
    ----------
    id : str
    verdict : Verdict
    key : KeyEntry or None
        None for an unknown quantity, or one that cannot be computed: the answer is unreadable.
    written : WrittenAnswer or None
        None for an answer that is missing.
    value : float or None
        Written value, SI; computed from the student's millimetres and scale if there is none.
    tolerance : float or None
        Includes the rounding of the written value.
    follows : str
        Answer that this one follows.
    local : float or None
        Value derived from the student's own earlier numbers; None if it uses none.
    local_tolerance : float or None
    sense_right : bool or None
        None if the sense is not requested, not stated or not visible.
    slip : bool
        The value is not the student's millimetres times the student's scale.
    points, of : float
    remark : str
        Of the instructor, by hand.
    is_manual : bool
        Whether the instructor set the points.
    miscomputed : bool
        The student's own numbers give another value, with nothing drawn in between.
    """

    id: str
    verdict: Verdict
    key: KeyEntry | None = None
    written: WrittenAnswer | None = None
    value: float | None = None
    tolerance: float | None = None
    follows: str = ""
    local: float | None = None
    local_tolerance: float | None = None
    sense_right: bool | None = None
    slip: bool = False
    points: float = 0.0
    of: float = 0.0
    remark: str = ""
    is_manual: bool = False
    miscomputed: bool = False

    @property
    def location(self) -> str:
        """Cell or row of the answer."""
        return "" if self.written is None else self.written.location

    @property
    def is_open(self) -> bool:
        """True if it is unreadable and not yet reviewed: until then it does not count."""
        return self.verdict is Verdict.UNREADABLE and not self.is_manual


class Diagnosis(Struct, frozen=True):
    """Why answers are wrong (распознанная ошибка).

    Attributes
    ----------
    codes : tuple of str
        One code if it is certain; several if undecided; none if not recognised.
    sure : bool
    roots : tuple of str
        Answers where it begins.
    mistake_at : str
        Link, point or pair that the mistake was made at, as plain text: "3", "B3/2".
    values : mapping of str to float
        What the mistake gives for each answer, SI.
    places : mapping of str to complex
        Points of the velocity and acceleration plans with the mistake, by their names in the
        program (``v:B3``), m/s and m/s², as in the program; empty if they were not computed.
    """

    codes: tuple[str, ...]
    sure: bool
    roots: tuple[str, ...]
    mistake_at: str = ""
    values: Mapping[str, float] = field(default_factory=dict)
    places: Mapping[str, complex] = field(default_factory=dict)


class PencilTrace(Struct, frozen=True):
    """Drafting error of one reading, given the earlier numbers (след карандаша).

    Attributes
    ----------
    off : float
        Deviation from the value that the plans then give, in sigmas.
    step : float
        Unit of its last digit, in sigmas.
    """

    off: float
    step: float


class CheckFailure(Struct, frozen=True):
    """Why a submission is not marked (почему работа не оценена).

    Attributes
    ----------
    message : str
        A sentence for the instructor.
    trace : str
        Traceback of an internal error; empty if the problem, or the submission, is at
        fault.
    """

    message: str
    trace: str = ""


class GradedSubmission(Struct, frozen=True):
    """One graded submission (проверенная работа).

    Attributes
    ----------
    failure : CheckFailure or None
        Why it is not marked; None for a graded submission.
    strokes : mapping of (str, int) to PencilTrace
        By answer and position: the fingerprint of a drawing.
    similar_students : tuple of str
        Students whose readings agree better than two drawings can: reported, without effect on
        marks.
    suspicious : bool
        More accurate than any drawing: the values were not read from one.
    remark : str
        Of the instructor, by hand.
    is_manual : bool
        Whether the instructor set points.
    """

    work: Submission
    variant: str | None
    answers: tuple[GradedAnswer, ...]
    diagnosis: tuple[Diagnosis, ...] = ()
    points: float = 0.0
    of: float = 0.0
    suspicious: bool = False
    remark: str = ""
    is_manual: bool = False
    strokes: Mapping[tuple[str, int], PencilTrace] = field(default_factory=dict)
    similar_students: tuple[str, ...] = ()
    failure: CheckFailure | None = None

    @property
    def open(self) -> tuple[GradedAnswer, ...]:
        """Answers that the instructor has to review; none if the total points were set by hand."""
        return () if self.is_manual else tuple(one for one in self.answers if one.is_open)

    @property
    def is_provisional(self) -> bool:
        """True if the mark may still change: there is one, and an answer is open."""
        return bool(self.of and self.open)
