"""Motors of a machine: characteristics, and those to choose from (двигатели)."""

from __future__ import annotations

from typing import Annotated

from msgspec import Struct

from planmethod.problem.tables import CustomKey, NumberKey, TextKey


class KlossSection(Struct, frozen=True):
    """Numbers of Kloss's formula as the file gives them, in one of two ways (формула Клосса)."""

    M_max: Annotated[float, NumberKey("greatest moment, N·m", low=1e-9)] = 0.0
    s_k: Annotated[float, NumberKey("slip at the greatest moment", low=1e-9)] = 0.0
    n_sync: Annotated[float, NumberKey("synchronous speed, rev/min", low=1e-9)] = 0.0
    P_nom: Annotated[
        float,
        NumberKey(
            "nominal power, W; with `n_nom` and `lambda` from the name plate instead of `M_max` "
            "and `s_k`",
            low=1e-9,
        ),
    ] = 0.0
    n_nom: Annotated[float, NumberKey("nominal speed, rev/min", low=1e-9)] = 0.0
    overload: Annotated[
        float, NumberKey("greatest moment over the nominal moment", low=1e-9, name="lambda")
    ] = 0.0


class LineSection(Struct, frozen=True):
    """Numbers of a straight characteristic as the file gives them, in one of two ways."""

    M_start: Annotated[float, NumberKey("moment at rest, N·m", low=1e-9)] = 0.0
    n_idle: Annotated[float, NumberKey("speed without load, rev/min", low=1e-9)] = 0.0
    M_nom: Annotated[
        float,
        NumberKey("moment of the nominal point, N·m; with `n_nom` instead of `M_start`", low=1e-9),
    ] = 0.0
    n_nom: Annotated[float, NumberKey("speed of the nominal point, rev/min", low=1e-9)] = 0.0


class MotorSection(Struct, frozen=True):
    """A motor as the file gives it: ``kloss`` or ``line`` (механическая характеристика)."""

    kloss: Annotated[
        KlossSection,
        CustomKey(
            "characteristic by Kloss's formula, M = 2M_max/(s/s_k + s_k/s), s = 1 − n/n_sync"
        ),
    ] = KlossSection()
    line: Annotated[LineSection, CustomKey("characteristic as a straight line")] = LineSection()
    ratio: Annotated[
        float,
        NumberKey(
            "turns of the motor for one turn of the crank. Add the inertia of the rotor, times "
            "ratio², to `J_crank`",
            "a ratio of speeds", low=1e-3, high=1e3,
        ),
    ] = 1.0  # fmt: skip


class Motor(Struct, frozen=True):
    """Characteristic of a motor, reduced to the crank (механическая характеристика двигателя).

    Attributes
    ----------
    idle : float, 1/s
        Speed of the crank at zero moment: synchronous, or idling.
    moment : float, N·m
        The greatest one of Kloss's formula; of a straight line the moment at rest.
    critical_slip : float or None
        Slip of the greatest moment; None of a straight line.
    """

    idle: float
    moment: float
    critical_slip: float | None = None

    def at(self, omega: float) -> float:
        """Return the moment, N·m, at a speed of the crank, 1/s (формула Клосса, прямая)."""
        slip = 1.0 - omega / self.idle
        if self.critical_slip is None:
            return self.moment * slip
        critical = self.critical_slip
        return 2.0 * self.moment * slip * critical / (slip * slip + critical * critical)


class CatalogueMotor(Struct, frozen=True):
    """A motor of the table in the file (двигатель из таблицы)."""

    name: Annotated[str, TextKey("name of the motor", 40, required=True)]
    power: Annotated[
        float, NumberKey("rated power", "a power", "W", 1.0, 1e8, required=True)
    ]  # fmt: skip
    speed: Annotated[
        float,
        NumberKey(
            "speed at the rated power", "a rotational speed", "rev/min", 1.0, 1e5, name="n",
            required=True,
        ),
    ]  # fmt: skip
    synchronous: Annotated[
        float | None,
        NumberKey("synchronous speed", "a rotational speed", "rev/min", 1.0, 1e5, name="n_sync"),
    ] = None
    inertia: Annotated[
        float,
        NumberKey(
            "moment of inertia of the rotor",
            "a moment of inertia", "kg·m²", 0.0, 1e6, name="J",
        ),
    ] = 0.0  # fmt: skip
