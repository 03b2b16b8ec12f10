"""A question for the defence: its text, the kind of its answer, its place on a sheet (вопрос)."""

from __future__ import annotations

from collections.abc import Mapping
from enum import Enum
from typing import TypeAlias

from msgspec import Struct

from planmethod.note.formula import Rich


class Subject(Enum):
    """Subject of a question, in the order of a pack (раздел)."""

    STRUCTURE = "structure"
    SYNTHESIS = "synthesis"
    KINEMATICS = "kinematics"
    FORCES = "forces"
    FLYWHEEL = "flywheel"
    BALANCING = "balancing"
    GEARS = "gears"
    MESHING = "meshing"
    CAM = "cam"
    POINT = "point"


class Place(Struct, frozen=True):
    """Place on a sheet (место на листе).

    Attributes
    ----------
    sheet : int
        Number in the set of all sheets, from 1.
    title : str
        Of the sheet, as in its title block.
    view : Rich
        Name of the view above it; empty if it has none.
    zone : str
        Zone of the sheet: a number from the right and a letter from below, ``3B``.
    at : complex, mm
        From the lower left corner of the paper.
    mark : str
        Name of the inscription that is there; empty for the middle of a view.
    """

    sheet: int
    title: str
    view: Rich
    zone: str
    at: complex
    mark: str = ""


class NumberAnswer(Struct, frozen=True):
    """A number with its tolerance in one unit, which the question names (число).

    Attributes
    ----------
    value, tolerance : float
    unit : Rich
        Empty of a number without a unit.
    """

    value: float
    tolerance: float
    unit: Rich = ""


class ChoiceAnswer(Struct, frozen=True):
    """One of several options (выбор).

    Attributes
    ----------
    right : str
        Key of the right option.
    options : mapping of str to Rich
        Options by their keys; empty where the catalogue of the language has them.
    """

    right: str
    options: Mapping[str, Rich] = {}


class TextAnswer(Struct, frozen=True):
    """A short text: letters, numbers of positions (короткий ответ)."""

    text: Rich


Answer: TypeAlias = NumberAnswer | ChoiceAnswer | TextAnswer


class Instance(Struct, frozen=True):
    """A question of a template about one object, as data (случай вопроса).

    Attributes
    ----------
    about : str
        Object that it is about: a point and a position; one template asks about each once.
    answer : Answer
    place : Place
    facts : mapping of str to Rich
        What the sentences of the catalogue have places for.
    states, requests : str
        Quantity whose value is in the text, and the quantity of the answer: in a pack no text has
        the answer of another question.
    """

    about: str
    answer: Answer
    place: Place
    facts: Mapping[str, Rich] = {}
    states: str = ""
    requests: str = ""


class Question(Struct, frozen=True):
    """A question of a pack (вопрос).

    Attributes
    ----------
    subject : Subject
    key : str
        Of its template, in the catalogue of the language.
    about : str
    text : Rich
    answer : Answer
        Options of a choice are in the order in which they are offered.
    reason : Rich
        One or two sentences that explain the answer.
    place : Place
    """

    subject: Subject
    key: str
    about: str
    text: Rich
    answer: Answer
    reason: Rich
    place: Place
