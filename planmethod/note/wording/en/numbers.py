"""How numbers, units and symbols are written in English (английская запись)."""

from planmethod.note.numbers import Notation

NOTATION = Notation(
    decimal=".",
    units={
        "m": "m",
        "mm": "mm",
        "mm²": "mm^{2}",
        "m/s": "m/s",
        "m/s²": "m/s^{2}",
        "1/s": "s^{−1}",
        "1/s²": "s^{−2}",
        "deg": "°",
        "rad": "rad",
        "kg": "kg",
        "kg·m²": "kg·m^{2}",
        "N": "N",
        "N·m": "N·m",
    },
    symbols={"balancing moment": "M_{b}", "balancing force": "F_{b}"},
)
