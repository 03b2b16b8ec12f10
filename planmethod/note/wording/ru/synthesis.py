"""Words of syntheses in Russian (синтез по-русски)."""

from planmethod.note.wording.synthesis_model import SynthesisWording

SYNTHESIS = SynthesisWording(
    titles={
        "slotted": "Синтез кулисного механизма",
        "slider-crank": "Синтез кривошипно-ползунного механизма",
        "crank-rocker": "Синтез кривошипно-коромыслового механизма",
        "three-positions": "Синтез по трём положениям шатуна",
        "three-angles": "Синтез по трём парам углов",
    },
    mechanisms={
        "slotted": "Кулисный механизм",
        "slider-crank": "Кривошипно-ползунный механизм",
        "crank-rocker": "Кривошипно-коромысловый механизм",
        "three-positions": "Шарнирный четырёхзвенник",
        "three-angles": "Шарнирный четырёхзвенник",
    },
    comments={
        "frame": "стойка, м",
        "crank": "кривошип",
        "input": "ведущее звено",
        "stone": "камень",
        "slotted": "кулиса; камень не выходит за точку D",
        "rod": "шатун",
        "coupler": "шатун",
        "rocker": "коромысло",
        "output": "ведомое звено",
        "slider": "ползун",
        "driver": "начальное звено",
        "zero": "град, от крайнего положения",
        "omega": "1/с: поставьте свою",
        "assembly": "способ сборки",
    },
    construction="Построение",
    steps_title="Ход построения",
    to_bisector="серединного перпендикуляра к {base}",
    steps={
        "bisector": "К отрезку {tail}{head} проводим серединный перпендикуляр.",
        "inscribed": "Строим окружность с центром {centre}, из точек которой хорда {tail}{head} "
        "видна под углом {angle}°: из {tail} проводим прямую под углом {rest}° к хорде до "
        "серединного перпендикуляра.",
        "again": "Прямая из {tail} под углом {angle}° к {tail}{head} встречает окружность ещё раз "
        "в точке {point}.",
        "apollonius": "Точка {centre} — середина {tail}{head}: окружность на диаметре "
        "{tail}{head} — место точек, для которых (l − r)/(l + r) постоянно, "
        "λ\u00a0=\u00a0r/l\u00a0=\u00a0{ratio}.",
        "freudenstein": "По уравнению Фрейденштейна для трёх пар углов K_{{1}} = {k1}, K_{{2}} = "
        "{k2}, K_{{3}} = {k3}; l_{{{tail}{head}}} = l_{{OC}} / |K_{{1}}|.",
        "centre": "В пересечении перпендикуляров — {centre}, центр окружности через {points}.",
    },
    point="Отмечаем точку {point} ({x}; {y}) мм.",
    given={
        "K_v": ("K_{v}", ""),
        "swing": ("ψ", "deg"),
        "centres": ("l_{0}", "m"),
        "stroke": ("H", "m"),
        "rod": ("l_{BC}", "m"),
        "lambda": ("λ\u00a0=\u00a0r/l", ""),
        "offset": ("e", "m"),
        "pressure": ("α_{max}", "deg"),
        "rocker": ("l_{CB}", "m"),
        "line": ("прямая точки O", ""),
        "beta": ("β", "deg"),
        "coupler": ("l_{BC}", "m"),
        "positions": ("положения шатуна", ""),
        "angles": ("пары углов", ""),
    },
    lengths="Размеры механизма",
    columns=("размер", "точно, м", "снято, м", "σ, м"),
    measured="Проверка по построенному механизму",
    checks={
        "K_v": "коэффициент K_v",
        "stroke": "ход",
        "swing": "размах",
        "working_deg": "рабочая фаза",
        "idle_deg": "холостая фаза",
        "pressure": "наибольший угол давления",
        "transmission": "наименьший угол передачи",
        "grashof": "условие Грасгофа",
        "missed": "отклонение от положений",
        "branch": "проходит все три без пересборки",
        "order": "в порядке 1, 2, 3",
    },
    verdicts={
        "swinging slotted link": "кулиса качается",
        "slider-crank": "кривошип проворачивается",
        "crank-rocker": "кривошипно-коромысловый",
        "rocker-crank": "проворачивается ведомое звено",
        "double-crank": "двухкривошипный",
        "double-rocker": "двухкоромысловый",
        "triple-rocker": "двухкоромысловый, ни одно звено не проворачивается",
        "change point": "предельный",
    },
    holds={True: "да", False: "нет"},
    interrupted="{name}: механизм не проходит все три положения подряд без пересборки: возьмите "
    "другие точки шатуна или другие углы.",
    ruler="линейка {ruler} мм, μ_l = {scale} м/мм",
)
"""Words of syntheses."""
