"""Words of the moving point in Russian (движение точки по-русски)."""

from planmethod.note.wording.point_model import PointWording

POINT = PointWording(
    circle="по окружности радиуса {radius} м, из точки (R; 0) против часовой стрелки",
    line="по оси x",
    at="В момент t = {time} с",
    reasons={
        "position undefined": "формулы координат не имеют значения",
        "velocity undefined": "скорость не существует: у координат нет производной",
        "acceleration undefined": "ускорение не существует: у координат нет второй производной",
        "at rest": "точка неподвижна, a_τ, a_n и ρ не определены",
        "straight": "a_n = 0, траектория здесь не искривлена, ρ не определён (ρ → ∞)",
    },
    polar="Полярные координаты",
    printed=("Напечатано", "Величина", "В источнике", "Точно", "Разность"),
)
