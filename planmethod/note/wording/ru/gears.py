"""Words of gear trains in Russian (зубчатые механизмы по-русски)."""

from planmethod.note.wording.gear_model import GearWording
from planmethod.note.wording.ru.gearsheet import GEAR_SHEET

GEARS = GearWording(
    sheet=GEAR_SHEET,
    title="Зубчатый механизм: {title}",
    structure="Структура",
    kinds={
        "ordinary": "рядовой (оси неподвижны)",
        "planetary": "планетарный",
        "differential": "дифференциальный",
        "closed differential": "замкнутый дифференциальный",
    },
    kind="Вид механизма: {kind}",
    chebyshev="W = 3n − 2p₁ − p₂ = 3·{n} − 2·{low} − {high} = {w} (по одному сателлиту из каждых "
    "одинаковых)",
    by_meshes="Независимых зацеплений: {rank}; степень подвижности W = {w}",
    redundant="Избыточные связи: на плоскости q = {plane}, в пространстве (зубья касаются по "
    "линии) q = {space}",
    carrier="Водило {carrier}: центральные колёса {central}; сателлиты {satellites}",
    closing="Замыкающая цепь: {meshes}",
    equations="Уравнения зацеплений",
    equation="{name}: {equation};  {stage}",
    wheels="Колёса",
    columns_wheels=("колесо", "{letter}", "ось, {unit}"),
    speeds="Скорости звеньев",
    columns_speeds=("звено", "{letter}, {unit}", "дробью", "{other}, {other_unit}", "отн. водила"),
    relative="{letter}^{carrier} = {value}",
    across="Ось звена {label} не параллельна главной: его скорость дана относительно водила, "
    "вокруг собственной оси.",
    rack="рейка",
    tabular="Табличный метод, водило {carrier}: всё повёрнуто вместе с водилом, затем при "
    "неподвижном водиле довёрнуто {wheel}; сумма равна найденному из уравнений",
    tabular_rows=("вместе с водилом, {letter}", "водило неподвижно, {letter}", "сумма, {letter}"),
    asked="Искомое",
    columns_asked=("величина", "значение", "дробью", "единица"),
    checked="Условия",
    conditions={
        "coaxiality": "Соосность, ось {axis}: {sums} = {value}",
        "satellites": "Водило {carrier}: сателлитов не больше {most} (сборка и соседство)",
        "assembly": "Сборка, водило {carrier}, k = {k}: {whole}/{k} = {value} должно быть целым",
        "neighbourhood": "Соседство, водило {carrier}, k = {k}: sin(π/k) = {left} должно быть "
        "больше {right}",
        "undercutting": "Подрезание: z_{wheel} = {z}, без подрезания не меньше {least}",
        "interference": "Внутреннее зацепление: z_{ring} − z_{wheel} = {less}, нужно не меньше "
        "{least}",
    },
    holds={True: "да", False: "НЕТ"},
    picture="Картины скоростей",
    scales="μ_l = {mu_l} м/мм; μ_v = {mu_v} (м/с)/мм; полюсное расстояние {pole} мм; "
    "μ_ω = {mu_omega} (1/с)/мм. Высоты от главной оси вверх, отрезки вправо положительны, лучи "
    "против часовой стрелки положительны.",
    columns_contacts=("точка", "высота, мм", "отрезок, мм"),
    columns_rays=("луч", "отрезок, мм"),
    points={"pitch": "полюс {name}", "axis": "ось {name}"},
    no_picture="Картины нет: оси не параллельны, их расстояния не следуют из колёс или всё "
    "неподвижно.",
    published="Напечатано в источнике",
    columns_published=("величина", "напечатано", "точно", "разность, %"),
    reasons={
        "zero": "звено {label} неподвижно, отношения к нему нет",
        "module": "не задан модуль",
        "rack": "{label}: у рейки скорость, у колеса частота вращения",
        "satellites": "число сателлитов находится для водила с одним рядом сателлитов",
        "efficiency": "нужны КПД всех зацеплений, одно ведущее звено, W = 1 и ведомое звено; "
        "самотормозящаяся передача КПД не имеет",
        "wheel": "{label}: размера или оси нет",
        "teeth": "колёса заданы радиусами",
    },
    units={"1/min": "мин⁻¹", "1/s": "с⁻¹", "m/s": "м/с", "mm": "мм", "m": "м", "m/2": "m/2"},
)
