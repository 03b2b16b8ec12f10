"""A problem with its requested items, solved once for all students (задание)."""

# Cyrillic letters: letters that quantities are written with in works of students

from __future__ import annotations

import copy
from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import chain, permutations, product

from msgspec import Struct
from msgspec.structs import replace

from planmethod.check.explain import Explanation, Explanations
from planmethod.check.marks import DEFAULT, Settings
from planmethod.check.model import Unread, WrittenAnswer
from planmethod.check.questions import Question, Questions, normalize
from planmethod.check.sheet import Sheet
from planmethod.check.submissions.cells import mark_unreadable, ratio
from planmethod.construct.drafting import PROFILES, Profile
from planmethod.errors import Fault, ProblemError
from planmethod.languages import translate
from planmethod.mechanism.model import FRAME
from planmethod.plans.forces.board import SCALE
from planmethod.plans.model import PlanKind
from planmethod.problem.formula import ratio_of, read_unit
from planmethod.problem.quantities import (
    BALANCES,
    SLIDINGS,
    TURNING,
    QuantityKey,
    QuantityKind,
    QuantityNameError,
    Sign,
    parse_quantity,
    parse_words,
)
from planmethod.problem.records import DirectionMode, KindProblem, QuestionSpec
from planmethod.solved.centres import ordered
from planmethod.solved.forces.statics import Statics
from planmethod.solved.quantity_steps import LOADS, NoValue, NoValueError
from planmethod.solved.solution import Solution


class QuantityAliases:
    """Finds quantities by how they may be written: in words of ``[published]``, or in letters."""

    def __init__(self, questions: Questions) -> None:
        self.questions = questions
        self._known: dict[str, QuantityKey] | None = None

    def find(self, text: str) -> QuantityKey:
        """Return the quantity that a text names.

        Raises
        ------
        NoValueError
        """
        problem = self.questions.solution.problem
        try:
            return parse_words(text).renamed(problem.names_of_letters)
        except QuantityNameError:
            pass
        if self._known is None:
            self._known = find_aliases(self.questions)
        if normalize(text) not in self._known:
            raise NoValueError(NoValue.NO_QUANTITY)
        return self._known[normalize(text)]


def find_aliases(questions: Questions) -> dict[str, QuantityKey]:
    """Return the quantities of a problem by how they may be written, each form `normalize`d.

    A form that two quantities share names neither.
    """
    found: dict[str, QuantityKey] = {}
    twice: set[str] = set()
    for form, quantity_key in _list_aliases(questions):
        alias = normalize(form)
        if found.setdefault(alias, quantity_key) != quantity_key:
            twice.add(alias)
    for symbol, quantity_key in _list_drawn(questions):
        found.setdefault(normalize(symbol), quantity_key)
    return {alias: known for alias, known in found.items() if alias not in twice}


LETTERS = {
    QuantityKind.VELOCITY: ("v",),
    QuantityKind.SLIDING: ("v", "vr", "vs", "vотн"),
    QuantityKind.CORIOLIS: ("ak", "acor", "aкор"),
    QuantityKind.RELATIVE: ("ar", "aотн"),
    QuantityKind.NORMAL: ("an", "aн"),
    QuantityKind.TANGENTIAL: ("at", "aт"),
    QuantityKind.BALANCE: (
        "M_dr", "F_dr", "balance", "Mур", "Fур", "M_b", "F_b", "M_y", "F_y", "Мд"
    ),
    QuantityKind.LEVER: (
        "M_lever", "F_lever", "lever", "MурЖ", "MЖ", "MЖур", "FЖур", "M_Lb", "F_Lb"
    ),
    QuantityKind.REACTION: ("F", "R", "Q"),
    QuantityKind.MOMENT: ("M",),
    QuantityKind.WEIGHT: ("G_",),
    QuantityKind.INERTIA: ("Φ_", "Fи_", "Pи_", "inertia_"),
    QuantityKind.INERTIA_COUPLE: ("MΦ", "Mи", "inertia couple "),
}  # fmt: skip
"""Letters that quantities are written with in works."""


def _list_aliases(questions: Questions) -> Iterator[tuple[str, QuantityKey]]:
    velocity, steps = questions.construction.kinematics.velocity, questions.steps
    problem = questions.solution.problem

    def write(*names: str) -> Iterator[tuple[str, ...]]:
        """Yield the names of points also in the letters of the source: ``A3``, ``A2``."""
        letters = problem.names_of_letters.items()
        return product(*([name, *(one for one, of in letters if of == name)] for name in names))

    for name in velocity.named:
        for (of,) in write(name):
            for kind in (QuantityKind.VELOCITY, QuantityKind.ACCELERATION):
                yield kind.label(of), QuantityKey(kind, (name,))
            for kind in (QuantityKind.PLACE, QuantityKind.VELOCITY, QuantityKind.ACCELERATION):
                yield from ((kind.label(of, x), QuantityKey(kind, (name,), x)) for x in "xy")
    for link in problem.mechanism.links:
        yield from ((kind.label(link), QuantityKey(kind, (link,))) for kind in TURNING)
    for name, pair in steps.pairs():
        forms = [name, *("_".join(own) for own in write(*pair))]
        forms += ["".join(own) for both in (pair, pair[::-1]) for own in write(*both)]
        for kind in SLIDINGS:
            for letter, of in product(LETTERS[kind], forms):
                yield f"{letter}_{of}", QuantityKey(kind, pair)
    yield from _list_centres(questions)
    for kind in (QuantityKind.NORMAL, QuantityKind.TANGENTIAL):
        for one, two in questions.arms():  # of a point of a link that turns about a fixed one
            for letter, (of,) in product(LETTERS[kind], write(one)):
                yield f"{letter}_{of}", QuantityKey(kind, (one, two))
    for names in permutations(velocity.named, 2):
        for own in write(*names):
            yield f"l_{''.join(own)}", QuantityKey(QuantityKind.LENGTH, names)
    for vector, _ in steps.vectors():
        for letter, (one, two) in product(LETTERS[vector.kind], write(*vector.names)):
            yield f"{letter}_{one}{two}", vector
            if vector.kind is QuantityKind.VELOCITY:
                yield f"{letter}_{two}{one}", vector
    if questions.statics is not None:
        yield from _list_forces(questions.statics, problem.letters.balance)


def _list_centres(questions: Questions) -> Iterator[tuple[str, QuantityKey]]:
    """Yield the instant centres, distances from them, and velocities by them.

    ``x_P13``, ``P13E``, ``vP_E``, ``ωP_3``.
    """
    mechanism = questions.solution.problem.mechanism
    links = FRAME, *mechanism.links
    for written in permutations(links, 2):
        letters = "".join(map(mechanism.called, written))
        pair = ordered(links, *written)
        for axis in "xy":
            for form in (f"{axis}_P{letters}", f"P_{letters}.{axis}"):
                yield form, QuantityKey(QuantityKind.CENTRE, pair, axis)
        for point in questions.construction.kinematics.velocity.named:
            key = QuantityKey(QuantityKind.CENTRE_DISTANCE, (*pair, point))
            for form in (f"P{letters}{point}", f"{point}P{letters}", f"l_P{letters}{point}"):
                yield form, key
    for point in questions.construction.kinematics.velocity.named:
        yield f"vP_{point}", QuantityKey(QuantityKind.CENTRE_VELOCITY, (point,))
    for link in mechanism.links:
        yield f"ωP_{link}", QuantityKey(QuantityKind.CENTRE_OMEGA, (link,))


def _list_drawn(questions: Questions) -> Iterator[tuple[str, QuantityKey]]:
    """Yield the vectors of slidings as the plans have them: ``v_{ED}`` of a stone that has D."""
    construction = questions.construction
    symbols = {
        (vector.tail, vector.head): vector.symbol
        for plan in construction.plans
        for vector in plan.vectors
    }
    slidings = construction.kinematics.relatives.values()
    for relative, (_, pair) in zip(slidings, questions.steps.pairs(), strict=True):
        for kind, ends in (
            (QuantityKind.SLIDING, (relative.start, relative.head)),
            (QuantityKind.CORIOLIS, (relative.a_start, relative.a_coriolis)),
            (QuantityKind.RELATIVE, (relative.a_coriolis, relative.a_head)),
        ):
            if ends in symbols:
                yield symbols[ends], QuantityKey(kind, pair)


def _list_forces(statics: Statics, balance: str) -> Iterator[tuple[str, QuantityKey]]:
    for reaction in statics.board.reactions:
        kinds = [QuantityKind.REACTION]
        kinds += [QuantityKind.MOMENT] if reaction.couple is not None else []
        for bodies in ((reaction.on, reaction.by), (reaction.by, reaction.on)):
            for kind in kinds:
                for letter in (*LETTERS[kind], f"{kind.letter}_{reaction.joint}"):
                    yield f"{letter}_{''.join(bodies)}", QuantityKey(kind, bodies)
    for kind in BALANCES:
        yield from ((form, QuantityKey(kind, ())) for form in LETTERS[kind])
    if balance:
        yield balance, QuantityKey(QuantityKind.BALANCE, ())
    kinds_of_loads = {load: kind for kind, load in LOADS.items()}
    for given in statics.board.given:
        applied = given.applied
        kind = kinds_of_loads.get(applied.kind, QuantityKind.LOAD)
        if kind is QuantityKind.LOAD:
            if not applied.name.endswith("'"):  # that of a spring on its second link is as large
                yield applied.name, QuantityKey(kind, (applied.name,))
            continue
        for letter in LETTERS[kind]:
            yield f"{letter}{applied.link}", QuantityKey(kind, (applied.link,))


class TaskItem(Struct, frozen=True):
    """One item, requested or answered without a request (пункт задания).

    Attributes
    ----------
    id : str
    question : Question
    position : int
    points : float
    asks_sense : bool
    fixed : float or None
        Tolerance that the task itself allows, a share.
    label : str
        How the department writes it.
    name : str
        The same for all students, however they call it.
    unit : str
        Requested unit, also of numbers without one; empty for that of the key.
    """

    id: str
    question: Question
    position: int = 0
    points: float = 1.0
    asks_sense: bool = False
    fixed: float | None = None
    label: str = ""
    name: str = ""
    unit: str = ""

    def per(self, scales: Mapping[str, float]) -> float:
        """Return what one of its unit is of that of the key: of a true length, mm of the plan."""
        if not self.unit:
            return 1.0
        per = ratio_of(self.unit, self.question.unit) or 1.0
        true = self.question.is_mm and self.question.plan is PlanKind.POSITION and per != 1.0
        return per / (scales[self.question.scale] * 1000.0) if true else per


class Task:
    """One variant of a problem.

    Parameters
    ----------
    solution : Solution
    settings : Settings
    other_variants : callable, optional
        Returns the other variants, whose numbers may have been copied.

    Attributes
    ----------
    declared : tuple of TaskItem
        Items of ``[[answers]]``; empty if the file has none.
    """

    def __init__(
        self,
        solution: Solution,
        settings: Settings = DEFAULT,
        other_variants: Callable[[], Iterable[Task]] | None = None,
    ) -> None:
        self.solution, self.settings = solution, settings
        self.problem: KindProblem = solution.problem
        self.variant = solution.problem.variant
        self._other_variants = other_variants
        self._questions: dict[int, Questions] = {}
        self._requested: dict[int, dict[str, Question]] = {}
        self._sheets: dict[tuple[object, ...], Sheet] = {}
        self._explained: dict[int, Explanations] = {}
        self._forms: dict[str, TaskItem] = {}
        self._written: dict[int, QuantityAliases] = {}
        self.declared = tuple(chain.from_iterable(map(self._declare, solution.problem.answers)))

    def for_variant(self, solution: Solution) -> Task:
        """Return the same task of another variant, which is drawn by the same steps."""
        other = copy.copy(self)
        other.solution, other.problem = solution, solution.problem
        other.variant = solution.problem.variant
        other._explained, other._written, other._sheets = {}, {}, {}
        other._questions = {p: one.for_variant(solution) for p, one in self._questions.items()}
        other._requested = {p: dict(asked) for p, asked in self._requested.items()}
        for position, asked in other._requested.items():
            scales = other.scales({}, position)
            of_first = self.sheet(position)
            key = other._key(position, scales, of_first.profile, asked)
            other._sheets[key] = of_first.for_variant(other._questions[position], scales)
        return other

    def copy_for_submission(self) -> Task:
        """Return a copy of the task for one submission: its extra answers do not affect others."""
        other = copy.copy(self)
        other._requested = {position: dict(asked) for position, asked in self._requested.items()}
        return other

    def _declare(self, spec: QuestionSpec) -> Iterator[TaskItem]:
        """Yield an answer, and the direction of its vector where that is an answer of its own."""
        position = self.first if spec.position is None else spec.position
        questions = self.questions(position)
        question = questions.question(parse_quantity(spec.what))
        item = TaskItem(
            spec.id,
            self.request(question, position),
            position,
            spec.points,
            spec.sense is not None,
            spec.tolerance,
            spec.letters[0] if spec.letters else "",
            spec.id,
            self.unit_of(spec, question),
        )
        forms = (spec.id, *spec.letters, spec.what)
        if spec.sense is DirectionMode.ANGLE:
            share = self.settings.sense_share
            item = replace(item, points=spec.points * (1.0 - share), asks_sense=False)
            turned = replace(
                item,
                id=f"angle_{spec.id}",
                question=self.request(questions.direction(question), position),
                points=spec.points * share,
                fixed=None,
                unit="",
                label=f"α({item.label})" if item.label else "",
                name=f"angle_{spec.id}",
            )
            for form in forms:
                for word in ("angle", "α"):
                    self._forms.setdefault(normalize(word + form), turned)
        for form in forms[:-1]:
            self._forms.setdefault(normalize(form), item)
        self._forms.setdefault(spec.what, item)
        yield item
        if spec.sense is DirectionMode.ANGLE:
            yield turned

    def unit_of(self, spec: QuestionSpec, question: Question) -> str:
        """Return the unit in which an answer is requested.

        Raises
        ------
        ProblemError
            It is not a unit, or belongs to another quantity.
        """
        if spec.unit and ratio_of(spec.unit, question.unit) is None:
            phrase = translate(
                "'{}' is not a unit of '{}', which is in {}", spec.unit, spec.id, question.unit
            )
            fault = Fault("answers.unit", phrase, "Write a unit of this quantity, or omit it.")
            raise ProblemError(self.problem.name, [fault])
        return spec.unit

    def other_variants(self) -> Iterator[Task]:
        """Yield the other variants."""
        for task in self._other_variants() if self._other_variants else ():
            if task is not self:
                yield task

    @property
    def count(self) -> int:
        """Positions of the driver."""
        return len(self.solution.positions)

    @property
    def first(self) -> int:
        """Default position: the calculated one of a project, else 0."""
        return self.solution.problem.calculated or 0

    # Questions -------------------------------------------------------------------------------

    def questions(self, position: int) -> Questions:
        """Return the possible questions of a position.

        Raises
        ------
        NoValueError
            When the driver is never there.
        """
        if not 0 <= position < self.count:
            raise NoValueError(NoValue.NO_POSITION)
        if position not in self._questions:
            self._questions[position] = Questions(self.solution, position)
        return self._questions[position]

    def _forms_of(self, position: int) -> QuantityAliases:
        if position not in self._written:
            self._written[position] = QuantityAliases(self.questions(position))
        return self._written[position]

    def request(self, question: Question, position: int) -> Question:
        """Have a question on the sheets of a position."""
        return self._requested.setdefault(position, {}).setdefault(question.id, question)

    def usual(self, position: int | None = None) -> tuple[TaskItem, ...]:
        """Return the requested items: those of the file, or the usual quantities of a position."""
        if self.declared:
            return self.declared
        position = self.first if position is None else position
        questions = self.questions(position)
        found = [self.request(questions.question(sel), position) for sel in questions.usual()]
        return tuple(
            TaskItem(q.id, q, position, asks_sense=q.sign is Sign.TURN, label=q.id, name=q.id)
            for q in found
        )

    def list_items(self) -> tuple[TaskItem, ...]:
        """Return all requested items: those of the file, or the usual quantities everywhere."""
        asked = map(self.usual, range(self.count))
        return self.declared or tuple(chain.from_iterable(asked))

    def find(self, written: WrittenAnswer) -> TaskItem:
        """Return what an answer is of.

        Raises
        ------
        NoValueError
            The quantity is unknown.
        """
        if (declared := self.stated(written)) is not None:
            return declared
        position = self.first if written.position is None else written.position
        questions, why = self.questions(position), NoValue.NO_QUANTITY
        for text in (written.what, written.id):
            if not text:
                continue
            try:
                question = self._named(questions, text, position)
            except NoValueError as error:
                why = error.reason
                continue
            return TaskItem(
                written.id or question.id,
                self.request(question, position),
                position,
                label=question.id,
                name=question.id,
            )
        raise NoValueError(why)

    def _named(self, questions: Questions, text: str, position: int) -> Question:
        """Return a quantity by its letters, or the direction of a vector: ``angle v B3``."""
        forms = self._forms_of(position)
        try:
            return questions.question(forms.find(text))
        except NoValueError:
            whole = normalize(text)
            vector = whole.removeprefix("angle").removeprefix("α")
            if vector == whole:
                raise
            return questions.direction(questions.question(forms.find(vector)))

    def stated(self, written: WrittenAnswer) -> TaskItem | None:
        """Return the item of an answer among those of the file."""
        for text in filter(None, (written.id, written.what)):
            item = self._forms.get(text) or self._forms.get(normalize(text))
            if item is not None and written.position in (None, item.position):
                return replace(item, id=written.id or item.id)
        return None

    def written(self, item: TaskItem, written: WrittenAnswer) -> WrittenAnswer:
        """Return an answer as it is graded: a number without a unit is in the requested unit."""
        if written.value is not None and ratio(written, item.question.unit) is None:
            return mark_unreadable(Unread.OTHER, written.unit, written.location, base=written)
        unit = read_unit(item.unit) if item.unit and not written.unit else None
        if unit is None or written.value is None:
            return written
        value, step = written.value * unit.factor, written.step * unit.factor
        return replace(written, value=value, step=step, unit=item.unit)

    # Sheets ----------------------------------------------------------------------------------

    def scales(self, student_scales: Mapping[str, float], position: int) -> dict[str, float]:
        """Return the scales of a sheet: a student's own, and those of the problem for the rest."""
        asked = self._requested.get(position, {}).values()
        scales = {scale.symbol: scale.per_mm for scale in self.solution.scales.values()}
        statics = self.questions(position).statics
        if statics is not None:
            needed = SCALE not in student_scales and any(
                question.key.is_loaded for question in asked
            )
            scales[SCALE] = statics.scale.per_mm if needed else student_scales.get(SCALE, 1.0)
        return {
            **scales,
            **{name: student_scales[name] for name in scales if name in student_scales},
        }

    def profile(self, ruler: float | None, *, drawn: str = "") -> Profile:
        """Return the drafting profile of a sheet, with the reading step of its author, mm.

        Parameters
        ----------
        drawn : str
            Profile of a measured drawing.
        """
        if drawn == "cad":
            return PROFILES["cad"]
        profile, step = PROFILES[self.settings.profile], ruler or self.settings.ruler_mm
        return profile if step is None else replace(profile, ruler=step)

    def sheet(
        self,
        position: int,
        student_scales: Mapping[str, float] | None = None,
        ruler: float | None = None,
        *,
        drawn: str = "",
    ) -> Sheet:
        """Return the sheet of a position at given scales, with all quantities requested so far."""
        scales = self.scales(student_scales or {}, position)
        asked = self._requested.get(position, {})
        profile = self.profile(ruler, drawn=drawn)
        key = self._key(position, scales, profile, asked)
        if key not in self._sheets:
            self._sheets[key] = Sheet(
                self.questions(position), tuple(asked.values()), scales, profile
            )
        return self._sheets[key]

    def _key(
        self, position: int, scales: Mapping[str, float], profile: Profile, ids: Iterable[str]
    ) -> tuple[object, ...]:
        return position, tuple(sorted(scales.items())), profile, tuple(ids)

    def theirs(self, sheet: Sheet) -> Iterator[tuple[str, Sheet]]:
        """Yield the other variants with all requested quantities of a sheet, at its scales."""
        for other in self.other_variants():
            their = self.find_matching_sheet(other, sheet)
            if their is not None:
                yield other.variant or "", their

    def find_matching_sheet(self, task: Task, mine: Sheet) -> Sheet | None:
        """Return another variant's sheet with the same quantities; None if one is missing."""
        position, their = mine.questions.position, task.copy_for_submission()
        try:
            questions = task.questions(position)
            theirs = [questions.match(question) for question in mine.requested]
        except NoValueError:
            return None
        their._requested[position] = {question.id: question for question in theirs}
        return their.sheet(position, mine.scales)

    def named(self, sheet: Sheet) -> list[Explanation]:
        """Return the named mistakes of a sheet, each with its predictions."""
        return self.explanations(sheet).named

    def explanations(self, sheet: Sheet) -> Explanations:
        """Return the mistakes that can be made on a sheet."""
        if id(sheet) not in self._explained:
            self._explained[id(sheet)] = Explanations(sheet)
        return self._explained[id(sheet)]
