"""Words and numbers of the structural analysis as rich text (таблицы и формулы структуры)."""

from __future__ import annotations

from collections.abc import Mapping

from planmethod.mechanism.describe import Motion, PairKind, Role, kind_of_motion, pairs
from planmethod.mechanism.groups import AssurGroup, links_of
from planmethod.mechanism.model import FRAME, Mechanism
from planmethod.mechanism.structure import LOCAL_MOBILITY, WAYS_IN, Structure, roman
from planmethod.render.layout.tables import TableColumn
from planmethod.render.pictures.chains import letters

NBSP = "\u00a0"

MOTIONS: Mapping[Motion, str] = {
    Motion.FIXED: "неподвижно",
    Motion.ROTATION: "вращательное",
    Motion.TRANSLATION: "поступательное",
    Motion.PLANE: "плоское",
}
ROLES: Mapping[Role, str] = {
    Role.FRAME: "стойка",
    Role.CRANK: "кривошип",
    Role.ROCKER: "коромысло",
    Role.SLIDER: "ползун",
    Role.ROD: "шатун",
    Role.STONE: "камень",
    Role.SLOTTED_LINK: "кулиса",
}
KINDS: Mapping[PairKind, str] = {
    PairKind.REVOLUTE: "вращательная",
    PairKind.PRISMATIC: "поступательная",
}

_LEADS = {
    2: "двухповодковая",
    3: "трёхповодковая",
    4: "четырёхповодковая",
    5: "пятиповодковая",
    6: "шестиповодковая",
}


def pair_columns(mechanism: Mechanism) -> list[TableColumn]:
    """Return the table of kinematic pairs (кинематические пары)."""
    rows = pairs(mechanism)
    return [
        TableColumn("Пара", tuple(letters(pair.name) for pair in rows)),
        TableColumn("Звенья", tuple(" – ".join(pair.links) for pair in rows)),
        TableColumn("Вид пары", tuple(KINDS[pair.kind] for pair in rows)),
        TableColumn("Класс", tuple("V" for _ in rows)),
        TableColumn("Подвижность", tuple("1" for _ in rows)),
    ]


def link_columns(mechanism: Mechanism) -> list[TableColumn]:
    """Return the table of links (звенья)."""
    rows = kind_of_motion(mechanism)
    return [
        TableColumn("Звено", tuple(row.link for row in rows)),
        TableColumn("Название", tuple(ROLES[row.role] for row in rows)),
        TableColumn("Вид движения", tuple(MOTIONS[row.motion] for row in rows)),
        TableColumn("Пары", tuple(_pairs_of(mechanism, row.link) for row in rows)),
    ]


def _pairs_of(mechanism: Mechanism, link: str) -> str:
    return ", ".join(letters(pair.name) for pair in pairs(mechanism) if link in pair.links)


def formulas(mechanism: Mechanism, structure: Structure) -> list[str]:
    """Return the formulas of the structural analysis as rich text (структурные формулы)."""
    n, low, high = structure.moving_links, structure.lower_pairs, structure.higher_pairs
    revolute = sum(pair.kind is PairKind.REVOLUTE for pair in pairs(mechanism))
    first = f"I({FRAME},{mechanism.driver})"
    steps = [f"{roman(group.class_number)}({','.join(group.links)})" for group in structure.groups]
    backwards = [*steps[::-1], first]
    spatial = structure.spatial_mobility
    return [
        # Broken between the three statements only, should it not fit one line.
        f"n{NBSP}={NBSP}{n}; p_{{н}}{NBSP}={NBSP}{low} "
        f"(вращательных{NBSP}{revolute}, поступательных{NBSP}{low - revolute}); "
        f"p_{{в}}{NBSP}={NBSP}{high}",
        f"По Чебышеву: W = 3n − 2p_{{н}} − p_{{в}} = 3·{n} − 2·{low} − {high} = "
        f"{_signed(structure.mobility)}",
        f"Пространственная схема: W_{{пр}} = 6n − 5p_{{1}} = 6·{n} − 5·{low} = {_signed(spatial)}",
        f"Избыточные связи: q = W_{{0}} + W_{{м}} − W_{{пр}} = "
        f"{WAYS_IN} + {LOCAL_MOBILITY} − {_bracketed(spatial)} = {structure.redundant}",
        f"Структурная формула: {' → '.join([first, *steps])}",
        f"Класс механизма: {roman(structure.class_number)}",
        f"Порядок кинематического анализа: {' → '.join([first, *steps])}",
        f"Порядок силового расчёта: {' → '.join(backwards)}",
    ]


def driver_caption(mechanism: Mechanism) -> list[str]:
    """Return name, mobility and redundant constraints of the driver (первичный механизм)."""
    ends = {FRAME, mechanism.driver}
    kind = next(pair.kind for pair in pairs(mechanism) if set(pair.links) == ends)
    return [
        f"Первичный механизм I{NBSP}класса ({KINDS[kind]} пара): "
        f"звенья{NBSP}{FRAME},{NBSP}{mechanism.driver}",
        "W = 3·1 − 2·1 = 1".replace(" ", NBSP),
        "q = 1 − (6·1 − 5·1) = 0".replace(" ", NBSP),
    ]


def group_caption(group: AssurGroup) -> list[str]:
    """Return class, order, kind, mobility and redundant constraints of a group."""
    n = len(group.links)
    p = len(group.leads) + sum(
        sum(link in group.links for link in links_of(joint)) - 1 for joint in group.inner
    )
    named = f"Группа {roman(group.class_number)}{NBSP}класса, {group.order}-го{NBSP}порядка"
    if group.kind is not None:
        letters_ru = group.signature.replace("R", "В").replace("P", "П")
        named += f", {group.kind}-го{NBSP}вида ({letters_ru})"
    elif len(group.leads) in _LEADS:
        named += f" ({_LEADS[len(group.leads)]})"
    return [
        f"{named}: звенья{NBSP}{f',{NBSP}'.join(group.links)}",
        f"W = 3·{n} − 2·{p} = {_signed(3 * n - 2 * p)}".replace(" ", NBSP),
        f"q = 0 − (6·{n} − 5·{p}) = {5 * p - 6 * n}".replace(" ", NBSP),
    ]


def _signed(number: int) -> str:
    return f"−{-number}" if number < 0 else str(number)


def _bracketed(number: int) -> str:
    return f"({_signed(number)})" if number < 0 else str(number)
