"""Audit of a source: what it prints beside the exact value and the one read, and its table."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Sequence
from decimal import Decimal
from enum import Enum

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.languages import LANGUAGES
from planmethod.note.compared import DASH, ComparedNumber
from planmethod.note.document import fixed, input_text, localized
from planmethod.note.numbers import is_negligible, significant
from planmethod.note.series import compared_flywheel, compared_segment
from planmethod.note.wording import get_language, wording
from planmethod.plans.build import plan_of
from planmethod.plans.model import FACTS, MOTION, PlanKind
from planmethod.problem.machine_records import FlywheelMethod, Quadrature, WeightSigns
from planmethod.problem.model import Problem, Scales
from planmethod.problem.quantities import Analysis, QuantityKey, QuantityKind, parse_quantity
from planmethod.problem.records import KindProblem, Published
from planmethod.solved.machine.chain import rotor_inertia
from planmethod.solved.machine.drawing import drawing_of
from planmethod.solved.machine.flywheel import Flywheel, flywheel_of, size_of, touching
from planmethod.solved.quantity_steps import NoValue, NoValueError
from planmethod.solved.quantity_values import QuantityValues
from planmethod.solved.selfcheck import verify
from planmethod.solved.solution import Solution
from planmethod.solved.turn.diagrams import diagrams_of


def machine_value(solution: Solution, quantity_key: QuantityKey) -> tuple[float, float | None]:
    """Return a quantity of a machine: exactly, SI and degrees, and as the construction is read.

    Raises
    ------
    NoValueError
        The file has no machine, or the machine no such position.
    """
    if solution.problem.machine is None:
        raise NoValueError(NoValue.NO_MACHINE)
    flywheel, kind = flywheel_of(solution), quantity_key.kind
    drawing = drawing_of(flywheel, solution.profile)
    if quantity_key.names:
        return _in_position(flywheel, kind, quantity_key.names), None
    if kind is QuantityKind.FLYWHEEL or kind.word == f"machine {drawing.construction.segment}":
        compare = compared_flywheel if kind is QuantityKind.FLYWHEEL else compared_segment
        both = compare(drawing)
        return both.exact, both.read
    values = {
        QuantityKind.CONSTANT_MOMENT: flywheel.constant,
        QuantityKind.MIDDLE_SPEED: flywheel.middle_speed,
        QuantityKind.IRREGULARITY: flywheel.machine.delta,
        QuantityKind.ANGLE_SCALE: drawing.scales.phi,
        QuantityKind.WORK_SCALE: drawing.scales.work,
    }
    if not drawing.by_mertsalov:
        values[QuantityKind.GREATEST_SLOPE], values[QuantityKind.LEAST_SLOPE] = drawing.psi
    made = flywheel.exact.inertia - rotor_inertia(flywheel)
    sizes = size_of(flywheel.machine.wheel, made, flywheel.middle_speed)
    if sizes is not None:
        values[QuantityKind.WHEEL_DIAMETER] = sizes.diameter
        values |= {QuantityKind.WHEEL_MASS: sizes.mass, QuantityKind.WHEEL_WIDTH: sizes.width}
    if kind not in values:
        raise NoValueError(NoValue.NO_QUANTITY)
    return values[kind], None


def diagram_value(solution: Solution, quantity_key: QuantityKey) -> float:
    """Return a length or a scale of the diagrams of the output's motion, mm and SI.

    Raises
    ------
    NoValueError
        No crank turns through a cycle, or it is at rest.
    """
    if not solution.problem.drive.revolves:
        raise NoValueError(NoValue.NO_CRANK)
    diagrams = diagrams_of(solution)
    value = {
        QuantityKind.DIAGRAM_LENGTH: diagrams.length,
        QuantityKind.VELOCITY_POLE: diagrams.poles[0],
        QuantityKind.ACCELERATION_POLE: diagrams.poles[1],
        QuantityKind.TIME_SCALE: diagrams.mu_t,
        QuantityKind.PATH_SCALE: diagrams.mu_s,
        QuantityKind.RATE_SCALE: diagrams.mu_v,
        QuantityKind.CHANGE_SCALE: diagrams.mu_a,
    }[quantity_key.kind]
    if value is None:
        raise NoValueError(NoValue.NO_RATE)
    return value


def synthesized_value(problem: Problem) -> float:
    """Return the angle θ between the extreme positions from which the sizes follow, degrees.

    Raises
    ------
    NoValueError
        The file has no synthesis, or one without this angle.
    """
    if problem.synthesis is None or "theta" not in problem.synthesis.values:
        raise NoValueError(NoValue.NO_SYNTHESIS)
    return problem.synthesis.values["theta"]


def _in_position(flywheel: Flywheel, kind: QuantityKind, names: tuple[str, ...]) -> float:
    number = int(names[-1])
    if number >= flywheel.machine.count:
        raise NoValueError(NoValue.NO_POSITION)
    rows, half = flywheel.rows, flywheel.problem.drive.rate**2 / 2.0
    if kind is QuantityKind.LINK_ENERGY:
        nothing = 0.0 * rows.inertia  # of a link without mass
        column = rows.parts.links.get(names[0], nothing) * half
    else:
        column = {
            QuantityKind.MACHINE_MOMENT: rows.moment,
            QuantityKind.MACHINE_INERTIA: rows.inertia,
            QuantityKind.MACHINE_ENERGY: rows.inertia * half,
        }[kind]
    value = float(column[number])
    return 0.0 if is_negligible(value, float(np.max(np.abs(column))) * 1e-7) else value


def chain(problem: Problem) -> list[tuple[str, float]]:
    """Return the way from the printed flywheel to the exact one, an error less at each step.

    Returns
    -------
    list of (str, float)
        Names of the steps, keys of ``chain_steps``, and J_f of each, kg·m²; empty where the file
        does not print M and J of all positions of its table.
    """
    machine = problem.machine
    if machine is None:
        return []
    printed = {item.what: item.value for item in problem.published}
    count = machine.count
    tables = [[printed.get(f"machine {kind} {k}") for k in range(count)] for kind in ("M", "J")]
    moments, inertias = ([x for x in column if x is not None] for column in tables)
    if len(moments) != count or len(inertias) != count:
        return []
    source, true = (
        Flywheel(replace(problem, machine=replace(machine, signs=signs)))
        for signs in (WeightSigns.SOURCE, WeightSigns.TRUE)
    )
    speed = printed.get("machine omega", source.middle_speed)
    delta = printed.get("machine delta", machine.delta)
    exact = true.reduced(count).inertia
    mertsalov = machine.method is FlywheelMethod.MERTSALOV

    def polygon(column: np.ndarray[tuple[int, ...], np.dtype[np.float64]]) -> float:
        """Return the flywheel of printed moments by trapezoids, with the printed numbers."""
        step = true.cycle / count
        closed = np.append(moments, moments[0])
        work = true.sign * np.append(0.0, np.cumsum(closed[1:] + closed[:-1]) * step / 2.0)
        turned = np.asarray(step * np.arange(count + 1), dtype=float)
        gain = true.sign * (work[-1] / true.cycle * turned - work)
        around = np.append(column, column[0])
        slopes = (1.0, 1.0) if mertsalov else (1.0 + delta, 1.0 - delta)
        return touching(turned, gain, around, slopes, speed, delta).inertia

    def by_points(wheel: Flywheel, number: int) -> float:
        slopes = wheel.usual_slopes
        return wheel.by_points(number, Quadrature.TRAPEZOID, slopes).tangents.inertia

    found, by = [], "_mertsalov" if mertsalov else ""
    segment = "machine AB" if mertsalov else "machine KL"
    if {segment, "machine mu_A"} <= printed.keys():
        cut = printed[segment] * printed["machine mu_A"]
        found.append((f"printed{by}", cut / (speed**2 * delta)))
    usual = true.tangents(*true.usual_slopes, true.middle_speed)
    return [
        *found,
        (f"tables{by}", polygon(np.array(inertias))),
        ("inertia", polygon(exact)),
        ("moments", by_points(source, count)),
        ("signs", by_points(true, count)),
        ("positions", by_points(true, 2 * count)),
        ("curve", usual.inertia),
        (f"exact{by}", true.exact.inertia),
    ]


DRAFTING_MM = 1.0
"""Error allowed for a careful drawing, mm of the plan (точность построения)."""

RULER_MM = 0.5
"""Default ruler step, mm."""

SYMBOLS = {kind: FACTS[kind].scale for kind in MOTION}

_WORDS = tuple(map(wording, LANGUAGES))

UNITS = {
    written: symbol
    for texts in _WORDS
    for unit, symbol in (("m", "mu_l"), ("m/s", "mu_v"), ("m/s²", "mu_a"))
    for written in (texts["units"][unit], texts["units"][unit].replace("²", "^2"))
}
"""Plan to which a scale ``per_mm`` belongs, by the unit of its value, in any language."""

NEWTONS, METRES, RADIANS = (
    tuple(texts["units"][unit] for texts in _WORDS) for unit in ("N", "m", "rad")
)


class AuditVerdict(Enum):
    """Verdict on a printed value beside the exact one (заключение)."""

    AGREES = "agrees"  # the exact value rounds to the printed one
    DRAWN = "drawn"  # no further off than a drawing may be
    DIFFERS = "differs"
    ABSENT = "absent"  # nothing to compare with


class Audited(Struct, frozen=True):
    """One printed value and what it should have been (проверенное значение).

    Attributes
    ----------
    exact : float or None
        In the unit of the value; None when it cannot be computed, and ``reason`` says why.
    read : float or None
        What the segments read with the ruler give; None for an angle.
    per_mm : float or None
        What a millimetre of the value's plan is worth.
    """

    published: Published
    exact: float | None = None
    read: float | None = None
    per_mm: float | None = None
    reason: NoValue | None = None

    @property
    def compared(self) -> ComparedNumber | None:
        """The printed value beside the exact one; None where there is none."""
        if self.exact is None:
            return None
        printed = self.published.value
        # Binary noise of a value that is right to the last digit is not a difference.
        size = max(abs(self.exact), self.per_mm or 0.0)
        is_noise = abs(printed - self.exact) <= 1e-12 * size
        return ComparedNumber(printed, printed) if is_noise else ComparedNumber(self.exact, printed)

    @property
    def difference(self) -> float | None:
        """Printed less exact, in the unit of the value."""
        return None if self.compared is None else self.compared.off

    @property
    def percent(self) -> float | None:
        """Difference in percent of the exact value; None beside an exact zero."""
        return None if self.compared is None else self.compared.percent

    @property
    def mm(self) -> float | None:
        """Difference in millimetres of the value's plan."""
        if self.difference is None or self.per_mm is None:
            return None
        return self.difference / self.per_mm

    @property
    def verdict(self) -> AuditVerdict:
        """Verdict on the value: first by its digits, then by the accuracy of a drawing."""
        if self.difference is None:
            return AuditVerdict.ABSENT
        if abs(self.difference) <= half_digit(self.published.value) * (1 + 1e-9):
            return AuditVerdict.AGREES
        if self.mm is not None and abs(self.mm) <= DRAFTING_MM:
            return AuditVerdict.DRAWN
        return AuditVerdict.DIFFERS


def half_digit(value: float) -> float:
    """Return half a unit of the last printed digit.

    A file does not keep the zeros after the point, so a one-digit whole number counts as printed
    with one decimal: 3 as 3.0.

    Examples
    --------
    >>> half_digit(15.28)
    0.005
    >>> half_digit(300.0)
    0.5
    >>> half_digit(3.0)
    0.05
    """
    printed = Decimal(repr(value)).normalize()
    exponent = printed.as_tuple().exponent
    assert isinstance(exponent, int)  # the reader lets only finite numbers in
    if exponent >= 0:
        exponent = -1 if printed.adjusted() == 0 else 0
    return float(Decimal(5).scaleb(exponent - 1))


def source_scales(problem: Problem) -> Scales:
    """Return the scales of the source's own drawing; None where the source gives none.

    They come from ``[scales]``, else from the printed values: ``per_mm`` beside metres is mu_l,
    beside m/s mu_v, beside m/s² mu_a.
    """
    told: dict[str, float] = {}
    for value in problem.published:
        symbol = UNITS.get(value.unit)
        if symbol is not None and value.per_mm is not None:
            told.setdefault(symbol, value.per_mm)
    given = {s: mu for s in SYMBOLS.values() if (mu := getattr(problem.scales, s)) is not None}
    return replace(problem.scales, **{**told, **given})


def audit(problem: Problem, *, ruler: float = RULER_MM) -> list[Audited]:
    """Compare every published value of a problem with the exact one.

    Parameters
    ----------
    problem : Problem
    ruler : float, mm
        Step of the ruler with which the plans are read, at the source's own scales.

    Returns
    -------
    list of Audited
        In the order of the file.

    Raises
    ------
    StructureError, ProblemError, AssemblyError, SelfCheckError
        When the problem cannot be solved.
    """
    if not problem.published:
        return []
    scales, mu_f = source_scales(problem), source_force_scale(problem)
    solution = Solution(replace(problem, scales=scales), ruler=ruler)
    verify(solution)
    places = [QuantityValues(solution, index, mu_f) for index in range(len(solution.positions))]
    return [_audited(places, scales, value) for value in problem.published]


def source_force_scale(problem: Problem) -> float | None:
    """Return the scale of the source's force plans, N/mm: ``per_mm`` of its first force."""
    forces = (v.per_mm for v in problem.published if v.unit in NEWTONS and v.per_mm is not None)
    return next(forces, None)


def _audited(places: Sequence[QuantityValues], scales: Scales, value: Published) -> Audited:
    try:
        quantity_key = _quantity(value, scales)
        if quantity_key.kind.analysis is Analysis.SYNTHESIS:
            return Audited(value, synthesized_value(places[0].solution.problem))
        if quantity_key.kind.analysis is Analysis.CYCLE:
            return Audited(value, diagram_value(places[0].solution, quantity_key))
        if quantity_key.kind.analysis is Analysis.MACHINE:
            exact, read = machine_value(places[0].solution, quantity_key)
            return Audited(value, exact, read, value.per_mm)
        at = places[_position(value, len(places))]
        unit = _unit(at, quantity_key, value)
        exact, read = at.exact(quantity_key) * unit, at.read(quantity_key)
        per_mm = value.per_mm or _per_mm(at, quantity_key, scales, unit)
    except NoValueError as error:
        return Audited(value, reason=error.reason)
    read = None if read is None else read * unit
    if quantity_key.is_angle and quantity_key.over is None:
        exact = _near(exact, value.value, 360.0 * unit)
        read = None if read is None else _near(read, value.value, 360.0 * unit)
    return Audited(value, exact, read, per_mm)


def _unit(at: QuantityValues, quantity_key: QuantityKey, value: Published) -> float:
    """Return what a degree, or a millimetre of the position plan, is in the unit of the value."""
    if quantity_key.over is not None:
        return 1.0
    if quantity_key.is_angle and value.unit in RADIANS:
        return math.radians(1.0)
    if _drawn_on(quantity_key) is PlanKind.POSITION and _is_true(value):
        return at.solution.scales[PlanKind.POSITION].per_mm
    return 1.0


def _is_true(value: Published) -> bool:
    """Return whether the source prints a length of the drawing in its true size."""
    return value.unit in METRES


def _drawn_on(quantity_key: QuantityKey) -> PlanKind | None:
    """Return the plan in whose millimetres a quantity is."""
    return plan_of(quantity_key.kind) if quantity_key.kind.is_length_on_paper else None


def _per_mm(
    at: QuantityValues, quantity_key: QuantityKey, scales: Scales, unit: float
) -> float | None:
    """Return what a millimetre of its plan is worth in an angle or a rate."""
    if quantity_key.kind.is_force:
        whole = quantity_key.is_angle and quantity_key.over is None
        turned = at.rotation_per_mm(quantity_key) if whole else None
        return None if turned is None else turned * unit
    lever = at.lever(quantity_key)
    if lever is None:
        return None
    plan, worth = lever
    scale: float | None = getattr(scales, SYMBOLS[plan])
    return None if scale is None else scale * worth * unit


def _quantity(value: Published, scales: Scales) -> QuantityKey:
    if not value.what:
        raise NoValueError(NoValue.NO_QUANTITY)
    quantity_key = parse_quantity(value.what)
    for part in (quantity_key, quantity_key.over):
        plan = _drawn_on(part) if part else None
        if plan is None or (plan is PlanKind.POSITION and _is_true(value)):
            continue
        if getattr(scales, SYMBOLS[plan]) is None:
            raise NoValueError(NoValue.NO_SCALE)
    return quantity_key


def _position(value: Published, count: int) -> int:
    if value.position is None and count == 1:
        return 0
    if value.position is None or not 0 <= value.position < count:
        raise NoValueError(NoValue.NO_POSITION)
    return value.position


def _near(angle: float, reference: float, turn: float) -> float:
    """Return an angle without the full turns from another one, which a protractor does not show."""
    return angle + turn * round((reference - angle) / turn)


def count(items: Iterable[Audited]) -> dict[AuditVerdict, int]:
    """Count the verdicts, every kind named."""
    found = dict.fromkeys(AuditVerdict, 0)
    for item in items:
        found[item.verdict] += 1
    return found


DIGITS = 5
"""Significant digits of an exact and of a read value."""


class AuditDocument:
    """Audits of one or many problems, written in one language.

    Parameters
    ----------
    lang : str
        ``en`` or ``ru``.
    ruler : float, mm
        Step of the ruler that the audits were made with.

    Raises
    ------
    UnknownLanguageError
    """

    def __init__(self, lang: str, ruler: float) -> None:
        found = get_language(lang)
        self.texts, self.says = found.note, found.audit
        self.ruler = ruler

    def markdown(self, audits: Sequence[tuple[KindProblem, Sequence[Audited]]]) -> str:
        """Return the whole document: what the columns mean, the counts, a table a problem."""
        limits = {
            "ruler": input_text(self.ruler, self.texts),
            "limit": input_text(DRAFTING_MM, self.texts),
        }
        parts = [f"# {self.says.title}", *(text.format(**limits) for text in self.says["intro"])]
        if len(audits) > 1:
            parts.append(self._counts(audits))
        parts += [self._section(problem, items) for problem, items in audits]
        return "\n\n".join(parts) + "\n"

    def _counts(self, audits: Sequence[tuple[KindProblem, Sequence[Audited]]]) -> str:
        says = self.says
        rows = [
            [_strip_markup(name(problem)), str(len(items)), *map(str, count(items).values())]
            for problem, items in audits
        ]
        return _table([says.problem, says.how_many, *says["counted"].values()], rows, "lrrrrr")

    def _section(self, problem: KindProblem, items: Sequence[Audited]) -> str:
        says = self.says
        head = [f"## {_strip_markup(name(problem))}: {_strip_markup(problem.title)}"]
        if problem.source:
            head.append(f"{says.source}: {_strip_markup(problem.source)}.")
        if not items:
            return "\n\n".join([*head, says.nothing])
        counts = {verdict.value: number for verdict, number in count(items).items()}
        head.append(says.summary.format(values=len(items), **counts))
        rows = [self._row(item) for item in items]
        return "\n\n".join(
            [*head, _table(list(says["columns"]), rows, "llrrrrrrll"), *self._chain(problem)]
        )

    def _chain(self, problem: KindProblem) -> list[str]:
        """Return the way from a printed flywheel to the exact one, if the source prints it."""
        if not isinstance(problem, Problem) or problem.machine is None:
            return []

        rows, before = [], 0.0
        for step, value in chain(problem):
            change = ComparedNumber(before, value).percent
            told = self.says["chain_steps"][step]
            rows.append([self._number(value, 6), self._hundredths(change), *told])
            before = value
        if not rows:
            return []
        return [self.says.chain, _table(list(self.says["chain_columns"]), rows, "rrll")]

    def _row(self, item: Audited) -> list[str]:
        published, says = item.published, self.says
        reasons = [says["whys"][item.reason.value] if item.reason else "", published.note]
        return [
            _strip_markup(published.name),
            _strip_markup(published.unit),
            input_text(published.value, self.texts, 12),
            self._number(item.exact, DIGITS),
            self._number(item.read, DIGITS),
            self._number(item.difference, 2),
            self._hundredths(item.percent),
            self._hundredths(item.mm),
            says["verdicts"][item.verdict.value],
            _strip_markup("; ".join(reason for reason in reasons if reason)),
        ]

    def _number(self, value: float | None, digits: int) -> str:
        return DASH if value is None else localized(significant(value, digits), self.texts)

    def _hundredths(self, value: float | None) -> str:
        # Rounded first: a value that rounds to zero has no minus.
        return DASH if value is None else fixed(round(value, 2), self.texts)


def name(problem: KindProblem) -> str:
    """Return what the document calls a problem: its file, and its variant."""
    return problem.name if problem.variant is None else f"{problem.name}, {problem.variant}"


def _strip_markup(text: str) -> str:
    """Return an untrusted text in one line, with the special characters of Markdown escaped."""
    return re.sub(r"([\\`*|<>\[\]#])", r"\\\1", " ".join(text.split()))


def _table(head: list[str], rows: list[list[str]], align: str) -> str:
    rule = ["---:" if side == "r" else "---" for side in align]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [head, rule, *rows])
