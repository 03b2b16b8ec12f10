"""How numbers, units and symbols are written in English (английская запись)."""

from planmethod.note.numbers import Notation, raised

UNITS = {
    "m": "m",
    "cm": "cm",
    "mm": "mm",
    "mm²": "mm²",
    "s": "s",
    "m/s": "m/s",
    "m/s²": "m/s²",
    "1/min": "min⁻¹",
    "rev/min": "rpm",
    "1/s": "s⁻¹",
    "1/s²": "s⁻²",
    "deg": "°",
    "rad": "rad",
    "kg": "kg",
    "kg·m": "kg·m",
    "kg·m²": "kg·m²",
    "N": "N",
    "N·m": "N·m",
    "J": "J",
    "kg/m³": "kg/m³",
}
"""Units as plain text, by those of SI."""

NOTATION = Notation(
    degrees="deg",
    decimal=".",
    units={name: raised(unit) for name, unit in UNITS.items()},
    symbols={
        "resisting moment": "M_{r}",
        "driving moment": "M_{d}",
        "resisting work": "A_{r}",
        "driving work": "A_{d}",
        "energy gain": "ΔT",
        "reduced inertia": "J_{r}",
        "flywheel": "J_{f}",
        "crank inertia": "J_{cr}",
        "mean speed": "ω_{m}",
        "moment by lever": "M^{Zh}",
        "motor moment": "M_{m}",
        "braking moment": "M_{b}",
        "balancing moment": "M_{b}",
        "balancing force": "F_{b}",
        "lever moment": "M^{L}_{b}",
        "lever force": "F^{L}_{b}",
    },
)
