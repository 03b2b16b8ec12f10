"""What is asked, what a student wrote, and what is said of it (вопросы, работы, заключения).

Numbers are in SI (degrees for angles), lengths on a plan in millimetres. Checking is a pure
function of a key and a work: nothing here reads a file or draws.
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
        """Whether it is a sense of turning."""
        return self in (Sense.CCW, Sense.CW)


class Verdict(Enum):
    """How an answer is judged (заключение об ответе)."""

    OK = "ok"
    NEAR = "near"  # a little beyond the tolerance
    INHERITED = "inherited"  # wrong, but it follows from an earlier wrong answer
    WRONG = "wrong"
    INCONSISTENT = "inconsistent"  # right, but not from his own numbers
    UNSEEN = "unseen"  # the drawing cannot show it: not judged against the exact value
    BLANK = "blank"
    UNREADABLE = "unreadable"


class Unread(Enum):
    """Why something in a work cannot be read (почему не прочитано); the words are in ``note``."""

    NUMBER = "number"
    UNIT = "unit"
    OTHER = "other"  # a unit of another quantity
    SENSE = "sense"
    POSITION = "position"
    DATE = "date"  # the spreadsheet program made a date of a number
    FORMULA = "formula"  # one that nobody has computed
    TWICE = "twice"  # written before, and otherwise
    QUANTITY = "quantity"  # a value without the quantity that it is of
    SCALE = "scale"
    STUDENT = "student"  # a row without a student
    COLUMN = "column"  # a column with a head that nobody knows
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
    TURNED = "turned"  # a plan that stands turned as a whole


class WrittenAnswer(Struct, frozen=True):
    """One answer as it stands in a work (записанный ответ).

    Attributes
    ----------
    what : str
        Words of ``[published]`` ("v B3"); empty when ``id`` alone tells what it is.
    id : str
        As ``--ask`` or ``[[answers]]`` names it ("v_B3"); empty when ``what`` alone tells it.
    value : float or None
        SI, degrees of angles, with the sign as written; None when there is none.
    unit : str
        As it was written; empty when none was: SI.
    step : float
        Unit of the last digit of ``value`` as written, SI: 0.01 of 2.35 m/s; 0 where unknown.
    mm : float or None
        Segment of his own plan, mm.
    mm_step : float
        Unit of the last digit of ``mm``.
    segment : str
        Letters of the segment: "p b3", "pb3"; empty when it is that of the quantity.
    sense : Sense or None
    position : int or None
        Position of the driver, from 0; None for the only one, or the one of ``[[answers]]``.
    where : str
        Cell or row that it stands in: ``Ответы!D12``, ``group.csv:14``, ``answers[3]``.
    unreadable : str
        Why it cannot be read, with the text; empty when it can.
    raw : str
        Value as it was written: "1,2·10^3".
    why : Unread or None
        What kind of fault ``unreadable`` tells of, for pages in other languages: its words take
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
    where: str = ""
    unreadable: str = ""
    raw: str = ""
    why: Unread | None = None
    fault: str = ""

    @property
    def is_blank(self) -> bool:
        """Whether nothing is answered."""
        return self.value is None and self.mm is None and not self.unreadable


class Work(Struct, frozen=True):
    """Answers of one student (работа студента).

    Attributes
    ----------
    student : str
        Number or name; what tells him from the others.
    answers : tuple of WrittenAnswer
    variant : str or None
    scales : mapping of str to float
        His own scales, unit per mm: ``mu_l`` (m/mm), ``mu_v``, ``mu_a``, ``mu_F``.
    ruler_mm : float or None
        Step to which he reads lengths.
    problem : str
        Problem file that he names; empty when he names none.
    where : str
        File that it was read from.
    remarks : tuple of WrittenAnswer
        What could not be read and is no answer: a scale, a row without a student.
    fingerprint : str
        Of the problem that the form was made for, see `planmethod.check.form.fingerprint_of`; empty
        of other works.
    drawn : str
        Of a drawing that was measured: the profile of the hand that drew it; empty of other works.
    failure : str
        Why it cannot be read as a whole, one of several in a file; empty of what was read.
    """

    student: str
    answers: tuple[WrittenAnswer, ...]
    variant: str | None = None
    scales: Mapping[str, float] = field(default_factory=dict)
    ruler_mm: float | None = None
    problem: str = ""
    where: str = ""
    remarks: tuple[WrittenAnswer, ...] = ()
    fingerprint: str = ""
    drawn: str = ""
    failure: str = ""


class KeyEntry(Struct, frozen=True):
    """What one answer should be (строка ключа).

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
    asked : str
        Unit in which the task asks it, as the file has it; empty for ``unit``.
    per : float
        What one of ``asked`` is of ``unit``: pages tell values in the unit that is asked.
    exact : float
        With its sign if it has one.
    sigma : float
        One standard deviation of drafting; 0 where nothing is drawn.
    tolerance : float
        How far an answer may be off, before the rounding of what is written.
    seen : bool
        False where the drawing cannot show it: the tolerance is above the cap.
    zero : bool
        Too short to be measured: any answer within the tolerance of nothing is right.
    mm : float or None
        Length of its segment on the plan, mm.
    scale : str
        Scale of that plan: ``mu_v``; empty when there is none.
    segment : str
        Letters of that segment: ``p-b3``.
    sense : Sense or None
        Which way it points or turns; None where it has none or nobody can see it.
    asks_sense : bool
        Whether the sense is part of the answer.
    points : float
    position : int
        Position of the driver, from 0.
    hidden : tuple of str
        Codes of mistakes that this answer cannot show.
    signed : bool
        Whether the sign belongs to the number; of a size it tells nothing and is not shown.
    what : str
        The quantity in words of ``[published]``: ``v B3``.
    """

    id: str
    label: str
    symbol: str
    unit: str
    exact: float
    sigma: float
    tolerance: float
    seen: bool = True
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
    asked: str = ""
    per: float = 1.0
    what: str = ""


class Judged(Struct, frozen=True):
    """Verdict of one answer (оценка ответа).

    Attributes
    ----------
    id : str
    verdict : Verdict
    key : KeyEntry or None
        None for what nobody knows or can compute: it is unreadable.
    written : WrittenAnswer or None
        None for an answer that is missing.
    value : float or None
        What he wrote, SI; from his millimetres and scale where he wrote no value.
    tolerance : float or None
        With the rounding of what he wrote.
    follows : str
        Answer that this one follows.
    local : float or None
        What comes out of his own earlier numbers; None where none goes into it.
    local_tolerance : float or None
    sense_right : bool or None
        None where it is not asked, not given or not to be seen.
    slip : bool
        His value is not his millimetres times his scale.
    points, of : float
    remark : str
        Of the instructor, by hand.
    by_hand : bool
        Whether the instructor set the points.
    miscomputed : bool
        His own numbers make another value, and nothing is drawn in between.
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
    by_hand: bool = False
    miscomputed: bool = False

    @property
    def where(self) -> str:
        """Cell or row of the answer."""
        return "" if self.written is None else self.written.where

    @property
    def is_open(self) -> bool:
        """Whether it cannot be read and the instructor has not looked: no answer until then."""
        return self.verdict is Verdict.UNREADABLE and not self.by_hand


class Diagnosis(Struct, frozen=True):
    """Why answers are wrong (распознанная ошибка).

    Attributes
    ----------
    codes : tuple of str
        One code where it is sure; those between which nothing decides; none: not recognised.
    sure : bool
    roots : tuple of str
        Answers where it begins.
    where : str
        Link, point or pair that the mistake was made at, as plain text: "3", "B3/2".
    values : mapping of str to float
        What the mistake gives for each answer, SI.
    places : mapping of str to complex
        Points of the velocity and acceleration plans that have the mistake, by their names in the
        program (``v:B3``), m/s and m/s², as the program has them; empty where nobody made them.
    """

    codes: tuple[str, ...]
    sure: bool
    roots: tuple[str, ...]
    where: str = ""
    values: Mapping[str, float] = field(default_factory=dict)
    places: Mapping[str, complex] = field(default_factory=dict)


class PencilTrace(Struct, frozen=True):
    """What the pencil left in one reading, when the earlier numbers are given (след карандаша).

    Attributes
    ----------
    off : float
        How far it is off what the plans give then, in sigmas.
    step : float
        Unit of its last digit, in sigmas.
    """

    off: float
    step: float


class CheckFailure(Struct, frozen=True):
    """Why a work is not marked (почему работа не оценена).

    Attributes
    ----------
    said : str
        A sentence for the instructor.
    trace : str
        Of a fault of the program: where it happened; empty where the problem, or the work, is at
        fault.
    """

    said: str
    trace: str = ""


class CheckedWork(Struct, frozen=True):
    """One work, judged (проверенная работа).

    Attributes
    ----------
    failure : CheckFailure or None
        Why it is not marked; None of a work that was judged.
    strokes : mapping of (str, int) to PencilTrace
        By answer and position: the fingerprint of a hand.
    alike : tuple of str
        Students whose readings are nearer to these than two pencils come: a finding, never a mark.
    suspicious : bool
        Closer to the exact values than any pencil comes: they are not off the drawing.
    remark : str
        Of the instructor, by hand.
    by_hand : bool
        Whether the instructor set points.
    """

    work: Work
    variant: str | None
    answers: tuple[Judged, ...]
    diagnosis: tuple[Diagnosis, ...] = ()
    points: float = 0.0
    of: float = 0.0
    suspicious: bool = False
    remark: str = ""
    by_hand: bool = False
    strokes: Mapping[tuple[str, int], PencilTrace] = field(default_factory=dict)
    alike: tuple[str, ...] = ()
    failure: CheckFailure | None = None

    @property
    def open(self) -> tuple[Judged, ...]:
        """Answers that the instructor has to look at; none where he set the points of the whole."""
        return () if self.by_hand else tuple(one for one in self.answers if one.is_open)

    @property
    def is_provisional(self) -> bool:
        """Whether the mark may still change: it is given, and an answer is open."""
        return bool(self.of and self.open)
