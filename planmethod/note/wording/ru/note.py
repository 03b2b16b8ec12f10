"""Sentences in Russian (русский каталог)."""

from planmethod.note.wording.model import Wording
from planmethod.note.wording.ru.numbers import NOTATION, UNITS

NOTE = Wording(
    lang="ru",
    decimal=NOTATION.decimal,
    units=UNITS,
    ccw="против часовой стрелки",
    cw="по часовой стрелке",
    left="слева",
    right="справа",
    rightmost="правую",
    leftmost="левую",
    upper="верхнюю",
    lower="нижнюю",
    title_protocol="Протокол построения планов",
    title_results="Результаты",
    source="Источник: {source}",
    one_position="Положение: {symbol} = {value}",
    position="Положение {number} (всего {count}): {symbol} = {value}",
    formula="Формула строения: {formula}",
    given="Дано: {given}.",
    given_count=" ({count} полож.)",
    given_steps="от {first} до {last} через {step}",
    given_left="{point} слева от {line}",
    given_right="{point} справа от {line}",
    given_through="направляющая {guide} проходит через точку {point}",
    given_along="{point}: {at} вдоль {line} от {start}, {across} поперёк",
    given_position="положение: {position}",
    given_extremes={
        "": "крайнее положение",
        "other": "другое крайнее положение",
        "left": "крайнее левое положение",
        "right": "крайнее правое положение",
        "upper": "крайнее верхнее положение",
        "lower": "крайнее нижнее положение",
    },
    given_going={
        "right": " (ход вправо)",
        "left": " (ход влево)",
        "up": " (ход вверх)",
        "down": " (ход вниз)",
        "ccw": " (поворот против часовой стрелки)",
        "cw": " (поворот по часовой стрелке)",
        "forth": " (прямой ход)",
        "back": " (обратный ход)",
    },
    given_arc="камень {link} в дуговой направляющей R = {radius} (заменён звеном {line})",
    given_guide="∠(направляющая звена {link}, {line})",
    scales="Масштабы",
    scales_text="Принимаем масштабные коэффициенты: {scales}.",
    ruler="Отрезки откладываем точно, а снимаем линейкой с ценой деления {ruler} мм; в скобках "
    "после слова «точно» — значение без погрешности снятия.",
    plans={
        "position": "План положений",
        "velocity": "План скоростей",
        "acceleration": "План ускорений",
    },
    frame="Стойка",
    driver="Начальное звено {link}",
    group="Группа {links} ({letters}): II класс, 2-й порядок, {kind}-й вид",
    higher_group="Группа {links}: {roman} класс, {order}-й порядок",
    plain_group="Группа {links}",
    letters={"R": "В", "P": "П"},
    of_point="точки {point}",
    of_pole="полюса {point}",
    of_guide_start="начала направляющей {guide}",
    parallel="параллельно {base}",
    perpendicular="перпендикулярно {base}",
    at_angle="под углом {angle}° к {base}",
    along="по прямой {base}",
    beyond="по прямой {base}, на её продолжении за точку {point},",
    backwards=" в обратную сторону",
    to_left=" (влево, если смотреть по ходу {base})",
    to_right=" (вправо, если смотреть по ходу {base})",
    line_join="прямой {base}",
    line_guide="направляющей {guide}",
    line_through="прямой из {of} {direction}",
    draw_parallel="Из {of} проводим прямую, параллельную {base}",
    draw_perpendicular="Из {of} проводим прямую, перпендикулярную {base}",
    draw_at_angle="Из {of} проводим прямую под углом {angle}° к {base}",
    draw_join="Проводим прямую {base}",
    draw_guide="Через точку {point} под углом {angle}° к оси x проводим направляющую {guide}.",
    draw_guide_at="Через точку ({x}; {y}) мм под углом {angle}° к оси x проводим направляющую "
    "{guide}.",
    carries=": таково направление {symbol}",
    slot="направляющей",
    slot_of="направляющей звена {link}",
    x_axis="оси x",
    fixed_points="Наносим неподвижные точки, координаты на чертеже в мм: {points}.",
    lay_off_at="Из {of} под углом {symbol} = {angle}° к оси x откладываем {length}; получаем "
    "точку {point}.",
    lay_off="Из {of} {direction} откладываем {length}{sense}; получаем точку {point}.",
    two_arcs="Делаем засечки: из точки {one} радиусом {first} и из точки {two} радиусом {second}. "
    "Из двух точек пересечения дуг берём ту, что {side} от прямой {one}{two}, если смотреть от "
    "{one} к {two}: это точка {point}.",
    arc_and_line="Из точки {centre} радиусом {radius} делаем засечку; из точек пересечения дуги и "
    "{line} берём {way}: это точка {point}.",
    touch="Вокруг точки {centre} проводим окружность радиусом {radius} и из точки {source} — "
    "касательную к ней, точка касания {point} лежит {side} от прямой {centre}{source}, если "
    "смотреть от {centre} к {source}.",
    meet="В пересечении {first} и {second} получаем точку {point}{coincide}.",
    meet_coincide=" (она же {points})",
    measure="Измеряем отрезок {segment} = {length} мм (точно {exact} мм).",
    measure_drawing="Измеряем на плане положений отрезок {segment} = {length} мм (точно {exact} "
    "мм).",
    exact=" (точно {value})",
    zero_length="{symbol} = 0, точка {point} не отходит от {of}.",
    pole="Выбираем полюс {pole}",
    pole_fixed="Выбираем полюс {pole}; в нём лежат неподвижные точки: {points}",
    equation_legend="Под членами уравнений: двойная черта — известны модуль и направление, "
    "одинарная — известно только направление.",
    equations="Векторные уравнения:",
    lay_off_vector="Из {of} {direction} откладываем отрезок {segment} = {length} мм{sense}; "
    "получаем точку {point}{coincide}.",
    sense_of=" в сторону {symbol} ({sense})",
    sense_normal="{base}, от {tail} к {head},",
    sense_coriolis=" по направлению {relative}, повёрнутого на 90° в сторону {omega} ({sense})",
    constant_speed="{symbol} постоянна, поэтому ускорение точек звена {link} — только нормальное.",
    no_coriolis_frame="{symbol} = 0: направляющая {guide} неподвижна, кориолисова ускорения нет.",
    no_coriolis_link="{symbol} = 0: звено {link} не вращается, кориолисова ускорения нет.",
    translating="Звено {link} движется поступательно: ω{index} = 0, ε{index} = 0, все его точки "
    "движутся одинаково.",
    shared_turning="Звено {link} поворачивается вместе со звеном {other}: {symbol} = {same}.",
    turning="Вектор {segment}, перенесённый в точку {place}, поворачивает звено {link} вокруг "
    "точки {joint} {sense}.",
    turning_zero="{symbol} = 0: отрезок {segment} равен нулю.",
    unreadable="{symbol} на этом плане не читается: линейка снимает {divisor} = 0.",
    unreadable_points="По снятому не построить: {points}. Точные значения — в таблице результатов.",
    similar_on="По теореме подобия точка {point} лежит на отрезке {segment}: откладываем от {of} "
    "отрезок {part}{coincide}.",
    similar_beyond="По теореме подобия точка {point} лежит на продолжении отрезка {segment} за "
    "точку {beyond}: откладываем от {of} отрезок {part}{coincide}.",
    similar_same="По теореме подобия точка {point} совпадает с точкой {other}{coincide}.",
    similar_triangle="По теореме подобия строим засечками треугольник {plan}, подобный "
    "треугольнику {link} и сходственно с ним расположенный (порядок обхода букв один и тот же); "
    "получаем точку {point}{coincide}.",
    read_off="Находим по плану:",
    referee_note=(
        "Числа float64 рядом с арбитром, {digits} цифр: ошибка в единицах СИ, число "
        "обусловленности κ и ошибка в единицах κ·u, u = 2⁻⁵³. Направление φ дано косинусом и "
        "синусом."
    ),
    columns_referee=("величина", "арбитр", "ошибка", "κ", "ошибка/(κ·u)"),
    table_points="Точки",
    table_links="Звенья",
    table_sliding="Относительное движение в поступательных парах",
    table_segments="Отрезки: {plan}, {scale}",
    columns_points=("точка", "x, м", "y, м", "v, м/с", "снято", "a, м/с²", "снято"),
    columns_links=("звено", "φ, °", "ω, с⁻¹", "снято", "куда", "ε, с⁻²", "снято", "куда"),
    columns_sliding=("точка", "v, м/с", "снято", "aᵏ, м/с²", "снято", "aʳ, м/с²", "снято"),
    columns_vectors=("вектор", "отрезок", "точно, мм", "снято, мм", "по снятому, {unit}"),
    columns_lengths=("отрезок", "точно, мм", "снято, мм"),
    sliding_row="{point}: {of} по {to}",
    table_forces="Реакции в кинематических парах: сила на первое звено от второго",
    columns_forces=("пара", "звенья", "F, Н", "снято", "φ, °", "M, Н·м", "l, м"),
    edges_note=(
        "{joint} {links}: равнодействующая вне ползуна длиной {length}\u00a0м; на его краях "
        "навстречу друг другу действуют {first} и {second}."
    ),
    edges_couple=(
        "{joint} {links}: сила равна нулю, есть только момент; на краях ползуна длиной "
        "{length}\u00a0м действует пара сил {first} и {second}."
    ),
    balance={
        "moment": "Уравновешивающий момент на ведущем звене: {value} {unit}.",
        "force": "Уравновешивающая сила на ведущем звене: {value} {unit}.",
    },
    lever_stands="Начальное звено неподвижно: рычага Жуковского нет.",
    lever_note=(
        "По снятым отрезкам: планы сил {plans} {unit}, рычаг Жуковского {lever} {unit}, "
        "расхождение {difference} {unit} ({share}%); ожидаемое СКО расхождения σ = {sigma} "
        "{unit}."
    ),
    resultant_shift="{force} приложена в точке {point} и заменяет {couple}",
    resultant_no_force="{couple} остаётся: у звена {link} нет силы инерции.",
    resultant_faint=(
        "{force} и {couple} не приведены к одной силе: в одном из положений ускорение центра масс "
        "на плане слишком мало."
    ),
    resultant_far=(
        "{force} и {couple} не приведены к одной силе: {shift} = {value} м больше наибольшего "
        "размера механизма, {limit} м."
    ),
    hand_note="«Снято» — то, что следует из отрезков, снятых линейкой с ценой деления {ruler} мм.",
    many_forces="Реакции в кинематических парах, Н; уравновешивающий момент (сила)",
    many_places="Координаты точек, м",
    many_velocities="Скорости точек, м/с, и угловые скорости звеньев, с⁻¹",
    many_accelerations="Ускорения точек, м/с², и угловые ускорения звеньев, с⁻²",
    many_by_hand="{title} (снято с планов)",
    number="№",
    margin="запас",
    sense_note="ω и ε положительны против часовой стрелки.",
    profiles={"cad": "САПР", "board": "чертёжная доска", "coarse": "грубо"},
    sigma="±σ",
    sigma_note="±σ — погрешность построения: одно среднее квадратическое отклонение, точность "
    "«{profile}».",
    drawn_note="*: первый порядок здесь неверен, σ найдена по множеству возможных чертежей.",
    many_sigmas="Погрешность построения ±σ: v, м/с; ω, с⁻¹; a, м/с²; ε, с⁻²",
    table_causes="Что вносит наибольшую погрешность",
    worst_result="Наибольшая относительная погрешность: {symbol} = {value} ± {sigma} {unit} "
    "({part} %); доли дисперсии:",
    cause_given="нанесение точки {point}",
    cause_angle="откладывание угла {symbol}",
    cause_line="проведение {line}",
    cause_lay_off="откладывание отрезка от {of} до точки {point}",
    cause_meet="отметка точки {point} в пересечении прямых",
    cause_arc="засечка точки {point}",
    cause_touch="касательная в точке {point}",
    cause_similar="построение точки {point} по подобию",
    cause_read="снятие отрезка {segment}",
    roles={
        "frame": "стойка",
        "crank": "кривошип",
        "rocker": "коромысло",
        "slider": "ползун",
        "rod": "шатун",
        "stone": "камень",
        "slotted link": "кулиса",
    },
    static_counts=(
        "Кинетостатика: N_y = 3n = 3·{n} = {equations} уравнений, N_F = {pairs} + {w} = {unknowns} "
        "неизвестных (две на низшую пару и уравновешивающие): {verdict}"
    ),
    statically_determinate="статически определимо.",
    statically_not="статически неопределимо.",
    joint_outer="внешние пары: {joints}",
    joint_inner="внутренние пары: {joints}",
)
