"""How numbers, units and symbols are written in Russian (русская запись)."""

from planmethod.note.numbers import Notation

NOTATION = Notation(
    decimal=",",
    units={
        "m": "м",
        "mm": "мм",
        "mm²": "мм^{2}",
        "m/s": "м/с",
        "m/s²": "м/с^{2}",
        "1/s": "с^{−1}",
        "1/s²": "с^{−2}",
        "deg": "°",
        "rad": "рад",
        "kg": "кг",
        "kg·m²": "кг·м^{2}",
        "N": "Н",
        "N·m": "Н·м",
    },
    symbols={"balancing moment": "M_{ур}", "balancing force": "F_{ур}"},
)
