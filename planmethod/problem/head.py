"""What problem files of every kind state: names, title block, printed values, questions."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum

from msgspec import Struct, field
from msgspec.structs import asdict, replace


class Published(Struct, frozen=True):
    """One value that the source prints (напечатанное значение)."""

    name: str
    value: float
    unit: str = ""
    per_mm: float | None = None
    what: str = ""
    note: str = ""
    position: int | None = None


class AnswerForm(Enum):
    """In what an answer is given (вид ответа)."""

    VALUE = "value"
    MM = "mm"  # millimetres of the student's own plan
    BOTH = "both"  # either is taken


class AskedSense(Enum):
    """As what the sense of an answer is asked (направление)."""

    TURN = "turn"  # ↺ or ↻
    DIRECTION = "direction"  # left, right, up or down
    ANGLE = "angle"  # degrees from +x


class AskedAnswer(Struct, frozen=True):
    """What students are asked for (вопрос).

    Attributes
    ----------
    id : str
        How it is called in every output; each has its own.
    what : str
        The quantity in the words of ``[published]``, also where the file has a name of ``--ask``.
    letters : tuple of str
        How the department writes it: ``VB₃``, ``v_B3``.
    unit : str
        As the file has it; empty for SI.
    points : float
    form : AnswerForm
    sense : AskedSense or None
        None where the sense is not asked.
    position : int or None
        Position of the driver, from 0; None where the file says none.
    digits : int or None
        Significant digits asked for.
    segment : str
        Letters of its segment: ``p-b3``; empty for that of the quantity.
    tolerance : float or None
        The department's own, as a share of the value: 0.05.
    """

    id: str
    what: str
    letters: tuple[str, ...] = ()
    unit: str = ""
    points: float = 1.0
    form: AnswerForm = AnswerForm.BOTH
    sense: AskedSense | None = None
    position: int | None = None
    digits: int | None = None
    segment: str = ""
    tolerance: float | None = None


class SheetSettings(Struct, frozen=True):
    """How the sheets are to be made up (оформление листов): ``[sheet]``; None: not said.

    Attributes
    ----------
    paper : str, optional
        Format, as `planmethod.paper.paper_format` reads it.
    form : str, optional
        Form of the title block: ``1``, ``1+2a``, ``2`` or ``2a``.
    graph_26, graphs_27_30, side_columns : bool, optional
        Which of the additional graphs there are.
    lettering : str, optional
        Type of the lettering: ``A``, ``A-upright``, ``B`` or ``B-upright``.
    lang : str, optional
        Language of the sheets: ``ru`` or ``en``.
    traces : bool, optional
        Whether the traces of the construction are drawn.
    """

    paper: str | None = None
    form: str | None = None
    graph_26: bool | None = None
    graphs_27_30: bool | None = None
    side_columns: bool | None = None
    lettering: str | None = None
    lang: str | None = None
    traces: bool | None = None

    def over(self, lower: SheetSettings) -> SheetSettings:
        """Return these settings, and those of ``lower`` where these say nothing."""
        given = {name: value for name, value in asdict(self).items() if value is not None}
        return replace(lower, **given)


class KindProblem(Struct, frozen=True, kw_only=True):
    """What is read of a problem of any kind (задача).

    Attributes
    ----------
    name : str
        Stem of the file.
    stamp : mapping of str to str
        Texts of the title block.
    answers : tuple of AskedAnswer
        What students are asked for, in the order of the file; empty where it does not say.
    variants : tuple of str
        Names of the variants that the file has.
    variant : str or None
        Which of them it is; None for the main part.
    """

    name: str
    title: str = ""
    source: str = ""
    stamp: Mapping[str, str] = field(default_factory=dict)
    sheet: SheetSettings = SheetSettings()
    published: tuple[Published, ...] = ()
    answers: tuple[AskedAnswer, ...] = ()
    variants: tuple[str, ...] = ()
    variant: str | None = None
