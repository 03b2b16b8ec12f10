"""How numbers, units and symbols are written in Russian (русская запись)."""

from planmethod.note.numbers import Notation, raised

UNITS = {
    "m": "м",
    "cm": "см",
    "mm": "мм",
    "mm²": "мм²",
    "s": "с",
    "m/s": "м/с",
    "m/s²": "м/с²",
    "1/min": "мин⁻¹",
    "rev/min": "об/мин",
    "1/s": "с⁻¹",
    "1/s²": "с⁻²",
    "deg": "°",
    "rad": "рад",
    "kg": "кг",
    "kg·m": "кг·м",
    "kg·m²": "кг·м²",
    "N": "Н",
    "N·m": "Н·м",
    "J": "Дж",
    "kg/m³": "кг/м³",
}
"""Units as plain text, by those of SI."""

NOTATION = Notation(
    degrees="град",
    decimal=",",
    units={name: raised(unit) for name, unit in UNITS.items()},
    symbols={
        "resisting moment": "M_{с}",
        "driving moment": "M_{д}",
        "resisting work": "A_{с}",
        "driving work": "A_{д}",
        "energy gain": "ΔT",
        "reduced inertia": "J_{п}",
        "flywheel": "J_{м}",
        "crank inertia": "J_{кр}",
        "mean speed": "ω_{ср}",
        "moment by lever": "M^{Ж}",
        "motor moment": "M_{дв}",
        "braking moment": "M_{т}",
        "balancing moment": "M_{ур}",
        "balancing force": "F_{ур}",
        "lever moment": "M^{Ж}_{ур}",
        "lever force": "F^{Ж}_{ур}",
    },
)
