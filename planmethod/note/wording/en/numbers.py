"""How numbers, units and symbols are written in English (английская запись)."""

from planmethod.note.numbers import Notation, raised

UNITS = {
    "m": "m",
    "mm": "mm",
    "mm²": "mm²",
    "s": "s",
    "m/s": "m/s",
    "m/s²": "m/s²",
    "1/min": "min⁻¹",
    "1/s": "s⁻¹",
    "1/s²": "s⁻²",
    "deg": "°",
    "rad": "rad",
    "kg": "kg",
    "kg·m²": "kg·m²",
    "N": "N",
    "N·m": "N·m",
}
"""Units as plain text, by those of SI."""

NOTATION = Notation(
    decimal=".",
    units={name: raised(unit) for name, unit in UNITS.items()},
    symbols={
        "balancing moment": "M_{b}",
        "balancing force": "F_{b}",
        "lever moment": "M^{L}_{b}",
        "lever force": "F^{L}_{b}",
    },
)
