"""How numbers, units and symbols are written in Russian (русская запись)."""

from planmethod.note.numbers import Notation, raised

UNITS = {
    "m": "м",
    "mm": "мм",
    "mm²": "мм²",
    "s": "с",
    "m/s": "м/с",
    "m/s²": "м/с²",
    "1/min": "мин⁻¹",
    "1/s": "с⁻¹",
    "1/s²": "с⁻²",
    "deg": "°",
    "rad": "рад",
    "kg": "кг",
    "kg·m²": "кг·м²",
    "N": "Н",
    "N·m": "Н·м",
}
"""Units as plain text, by those of SI."""

NOTATION = Notation(
    decimal=",",
    units={name: raised(unit) for name, unit in UNITS.items()},
    symbols={
        "balancing moment": "M_{ур}",
        "balancing force": "F_{ур}",
        "lever moment": "M^{Ж}_{ур}",
        "lever force": "F^{Ж}_{ур}",
    },
)
