"""Words of the structural sheet in Russian (структурный лист по-русски)."""

from planmethod.note.wording.sheet_model import StructureWording

STRUCTURE = StructureWording(
    title="Структурный анализ механизма",
    scheme="Структурная схема механизма",
    parts="Первичный механизм и структурные группы",
    pairs="Кинематические пары",
    links="Звенья механизма",
    formulas="Структурные формулы",
    columns_pairs=("Пара", "Звенья", "Вид пары", "Класс", "Подвижность"),
    columns_links=("Звено", "Название", "Вид движения", "Пары"),
    pair_kinds={
        "revolute": "вращательная",
        "prismatic": "поступательная",
    },
    motions={
        "fixed": "неподвижно",
        "rotation": "вращательное",
        "translation": "поступательное",
        "plane": "плоское",
    },
    counts="n\u00a0=\u00a0{n}; p_{{н}}\u00a0=\u00a0{low} (вращательных\u00a0{revolute}, "
    "поступательных\u00a0{prismatic}); p_{{в}}\u00a0=\u00a0{high}",
    chebyshev="По Чебышеву: W = 3n − 2p_{{н}} − p_{{в}} = 3·{n} − 2·{low} − {high} = {w}",
    spatial="Пространственная схема: W_{{пр}} = 6n − 5p_{{1}} = 6·{n} − 5·{low} = {w}",
    redundant="Избыточные связи: q = W_{{0}} + W_{{м}} − W_{{пр}} = {ways} + {local} − {w} = {q}",
    formula="Структурная формула: {order}",
    mechanism_class="Класс механизма: {roman}",
    kinematic_order="Порядок кинематического анализа: {order}",
    force_order="Порядок силового расчёта: {order}",
    primary="Первичный механизм I\u00a0класса ({kind} пара): звенья\u00a0{links}",
    group="Группа {roman}\u00a0класса, {order}-го\u00a0порядка{kind}: звенья\u00a0{links}",
    group_kind=", {kind}-го\u00a0вида ({letters})",
    group_leads={
        2: " (двухповодковая)",
        3: " (трёхповодковая)",
        4: " (четырёхповодковая)",
        5: " (пятиповодковая)",
        6: " (шестиповодковая)",
    },
)
