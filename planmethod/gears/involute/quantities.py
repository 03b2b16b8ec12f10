"""Quantities of a pair: names of the standard, symbols, units, formulas (величины и формулы)."""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum
from math import pi, sin

import numpy as np
from msgspec import Struct
from msgspec.structs import replace

from planmethod.gears.angles import involute
from planmethod.gears.involute.blocking import BlockingLimit, LimitKind, limits
from planmethod.gears.involute.generation import RackCutting
from planmethod.gears.involute.profile import LineOfAction, Tooth
from planmethod.gears.involute.sizes import MeshingProblem, Pair, Reals
from planmethod.note.formula import Rich
from planmethod.note.numbers import Notation, trimmed
from planmethod.note.wording import Language


class Unit(Enum):
    """Unit of a quantity, and the decimals it is shown with."""

    MM = ("mm", 3)
    DEGREE = ("°", 4)
    NONE = ("", 4)
    FINE = ("", 6)
    COUNT = ("", 0)

    @property
    def places(self) -> int:
        """Decimals that are shown."""
        return self.value[1]

    @property
    def in_record(self) -> str:
        """What a record calls it; empty of a number without a unit."""
        return "deg" if self is Unit.DEGREE else self.value[0]


class GearSize(Struct, frozen=True):
    """One quantity of the record, the table and the protocol (величина).

    Attributes
    ----------
    key : str
        Its name in JSON; that of `Pair` where it stands there.
    symbol : str
        Rich text; ``#`` stands for the number of the wheel.
    formula, numbers : str
        What it is computed by: in letters, and the same with fields for numbers. ``#`` is the
        wheel, ``@`` the other one. A quantity without them is not derived in the protocol.
    in_table : bool
        It stands in the table of the sheet.
    """

    key: str
    symbol: str
    unit: Unit
    formula: str = ""
    numbers: str = ""
    in_table: bool = True

    @property
    def symbols(self) -> Rich | list[Rich]:
        """Its symbol; those of both wheels where each has its own."""
        both = [self.symbol.replace("#", wheel) for wheel in ("1", "2")]
        return both if "#" in self.symbol else self.symbol


_OF_PAIR = (
    GearSize("m", "m", Unit.MM),
    GearSize("alpha", "α", Unit.DEGREE),
    GearSize("ha", "h_{a}^{*}", Unit.NONE),
    GearSize("c", "c^{*}", Unit.NONE),
    GearSize("rho_f", "ρ_{f}^{*}", Unit.NONE, in_table=False),
    GearSize(
        "z_min",
        "z_{min}",
        Unit.NONE,
        "\\frac{2·h_{l}^{*}}{sin^{2}α}",
        "\\frac{{2·{h_l}}}{{{sin}^{{2}}}}",
        False,
    ),
    GearSize("inv_alpha", "inv α", Unit.FINE, "{tan} α − α", "{tan_alpha} − {rad_alpha}", False),
    GearSize("x_sum", "x_{Σ}", Unit.NONE, "x_{1} + x_{2}", "{x1} + {x2}"),
    GearSize(
        "inv_alpha_w",
        "inv α_{w}",
        Unit.FINE,
        "inv α + \\frac{2·x_{Σ}·{tan} α}{z_{1} + z_{2}}",
        "{inv_alpha} + \\frac{{2·{x_sum}·{tan_alpha}}}{{{z1} + {z2}}}",
    ),
    GearSize("alpha_w", "α_{w}", Unit.DEGREE),
    GearSize("a", "a", Unit.MM, "\\frac{m·(z_{1} + z_{2})}{2}", "\\frac{{{m}·({z1} + {z2})}}{{2}}"),
    GearSize(
        "a_w",
        "a_{w}",
        Unit.MM,
        "\\frac{a·cos α}{cos α_{w}}",
        "\\frac{{{a}·{cos}}}{{{cos_w}}}",
    ),
    GearSize("y", "y", Unit.NONE, "\\frac{a_{w} − a}{m}", "\\frac{{{a_w} − {a}}}{{{m}}}"),
    GearSize("delta_y", "Δy", Unit.NONE, "x_{Σ} − y", "{x_sum} − {y}"),
    GearSize("p", "p", Unit.MM, "π·m", "π·{m}"),
    GearSize("p_b", "p_{b}", Unit.MM, "p·cos α", "{p}·{cos}"),
)
_OF_WHEELS = (
    GearSize("z", "z_{#}", Unit.COUNT),
    GearSize(
        "x_min",
        "x_{min#}",
        Unit.NONE,
        "h_{l}^{*} − \\frac{z_{#}·sin^{2}α}{2}",
        "{h_l} − \\frac{{{z#}·{sin}^{{2}}}}{{2}}",
    ),
    GearSize("x", "x_{#}", Unit.NONE),
    GearSize("d", "d_{#}", Unit.MM, "m·z_{#}", "{m}·{z#}"),
    GearSize("d_b", "d_{b#}", Unit.MM, "d_{#}·cos α", "{d#}·{cos}"),
    GearSize("d_w", "d_{w#}", Unit.MM, "\\frac{d_{b#}}{cos α_{w}}", "\\frac{{{d_b#}}}{{{cos_w}}}"),
    GearSize(
        "d_a",
        "d_{a#}",
        Unit.MM,
        "d_{#} + 2·m·(h_{a}^{*} + x_{#} − Δy)",
        "{d#} + 2·{m}·({ha} + {x#} − {delta_y})",
    ),
    GearSize(
        "d_f",
        "d_{f#}",
        Unit.MM,
        "d_{#} − 2·m·(h_{a}^{*} + c^{*} − x_{#})",
        "{d#} − 2·{m}·({ha} + {c} − {x#})",
    ),
    GearSize(
        "s",
        "s_{#}",
        Unit.MM,
        "m·(\\frac{π}{2} + 2·x_{#}·{tan} α)",
        "{m}·(\\frac{{π}}{{2}} + 2·{x#}·{tan_alpha})",
    ),
    GearSize("e", "e_{#}", Unit.MM, "p − s_{#}", "{p} − {s#}", False),
    GearSize(
        "h",
        "h_{#}",
        Unit.MM,
        "\\frac{d_{a#} − d_{f#}}{2}",
        "\\frac{{{d_a#} − {d_f#}}}{{2}}",
        False,
    ),
    GearSize(
        "alpha_a",
        "α_{a#}",
        Unit.DEGREE,
        "arccos(\\frac{d_{b#}}{d_{a#}})",
        "arccos(\\frac{{{d_b#}}}{{{d_a#}}})",
        False,
    ),
    GearSize(
        "s_a",
        "s_{a#}",
        Unit.MM,
        "d_{a#}·(\\frac{s_{#}}{d_{#}} + inv α − inv α_{a#})",
        "{d_a#}·(\\frac{{{s#}}}{{{d#}}} + {inv_alpha} − {inv_alpha_a#})",
    ),
    GearSize("k", "k_{#}", Unit.COUNT),
    GearSize(
        "W",
        "W_{#}",
        Unit.MM,
        "m·cos α·(π·(k_{#} − 0,5) + 2·x_{#}·{tan} α + z_{#}·inv α)",
        "{m}·{cos}·(π·({k#} − 0,5) + 2·{x#}·{tan_alpha} + {z#}·{inv_alpha})",
    ),
    GearSize(
        "rho_a",
        "ρ_{a#}",
        Unit.MM,
        "\\frac{d_{b#}·{tan} α_{a#}}{2}",
        "\\frac{{{d_b#}·{tan_alpha_a#}}}{{2}}",
        False,
    ),
    GearSize("rho_p", "ρ_{p#}", Unit.MM, "a_{w}·sin α_{w} − ρ_{a@}", "{a_w}·{sin_w} − {rho_a@}"),
    GearSize(
        "rho_l",
        "ρ_{l#}",
        Unit.MM,
        "\\frac{d_{#}·sin α}{2} − \\frac{m·(h_{l}^{*} − x_{#})}{sin α}",
        "\\frac{{{d#}·{sin}}}{{2}} − \\frac{{{m}·({h_l} − {x#})}}{{{sin}}}",
    ),
    GearSize("rho_low", "ρ_{min#}", Unit.MM, in_table=False),
    GearSize(
        "theta_p",
        "ϑ_{p#}",
        Unit.NONE,
        "1 − \\frac{ρ_{a@}·z_{#}}{ρ_{p#}·z_{@}}",
        "1 − \\frac{{{rho_a@}·{z#}}}{{{rho_p#}·{z@}}}",
    ),
    GearSize(
        "theta_a",
        "ϑ_{a#}",
        Unit.NONE,
        "1 − \\frac{ρ_{p@}·z_{#}}{ρ_{a#}·z_{@}}",
        "1 − \\frac{{{rho_p@}·{z#}}}{{{rho_a#}·{z@}}}",
        False,
    ),
)
_OF_CONTACT = (
    GearSize("g_alpha", "g_{α}", Unit.MM, "ρ_{a1} − ρ_{p1}", "{rho_a1} − {rho_p1}", False),
    GearSize(
        "epsilon_alpha",
        "ε_{α}",
        Unit.NONE,
        "\\frac{ρ_{a1} + ρ_{a2} − a_{w}·sin α_{w}}{p_{b}}",
        "\\frac{{{rho_a1} + {rho_a2} − {a_w}·{sin_w}}}{{{p_b}}}",
    ),
    GearSize("epsilon_active", "ε_{α}'", Unit.NONE, in_table=False),
)


_RING: dict[str, tuple[tuple[str, str] | None, tuple[str, str] | None]] = {
    "x_sum": (("x_{2} − x_{1}", "{x2} − {x1}"), None),
    "inv_alpha_w": (
        (
            "inv α + \\frac{2·x_{d}·{tan} α}{z_{2} − z_{1}}",
            "{inv_alpha} + \\frac{{2·{x_sum}·{tan_alpha}}}{{{z2} − {z1}}}",
        ),
        None,
    ),
    "a": (("\\frac{m·(z_{2} − z_{1})}{2}", "\\frac{{{m}·({z2} − {z1})}}{{2}}"), None),
    "delta_y": (("x_{d} − y", "{x_sum} − {y}"), None),
    "d_a": (
        ("d_{1} + 2·m·(h_{a}^{*} + x_{1} + Δy)", "{d1} + 2·{m}·({ha} + {x1} + {delta_y})"),
        ("d_{2} − 2·m·(h_{a}^{*} − x_{2} + Δy)", "{d2} − 2·{m}·({ha} − {x2} + {delta_y})"),
    ),
    "d_f": (None, ("2·a_{w0} + d_{a0}", "2·{a_w0} + {d_a0}")),
    "s": (
        None,
        ("m·(\\frac{π}{2} − 2·x_{2}·{tan} α)", "{m}·(\\frac{{π}}{{2}} − 2·{x2}·{tan_alpha})"),
    ),
    "s_a": (
        None,
        (
            "d_{a2}·(\\frac{s_{2}}{d_{2}} − inv α + inv α_{a2})",
            "{d_a2}·(\\frac{{{s2}}}{{{d2}}} − {inv_alpha} + {inv_alpha_a2})",
        ),
    ),
    "h": (None, ("\\frac{d_{f2} − d_{a2}}{2}", "\\frac{{{d_f2} − {d_a2}}}{{2}}")),
    "rho_p": (
        ("ρ_{a2} − a_{w}·sin α_{w}", "{rho_a2} − {a_w}·{sin_w}"),
        ("ρ_{a1} + a_{w}·sin α_{w}", "{rho_a1} + {a_w}·{sin_w}"),
    ),
    "rho_l": (
        None,
        (
            "a_{w0}·sin α_{w0} + \\frac{d_{a0}·sin α_{a0}}{2}",
            "{a_w0}·{sin_w0} + \\frac{{{d_a0}·{sin_a0}}}{{2}}",
        ),
    ),
    "epsilon_alpha": (
        (
            "\\frac{ρ_{a1} − ρ_{a2} + a_{w}·sin α_{w}}{p_{b}}",
            "\\frac{{{rho_a1} − {rho_a2} + {a_w}·{sin_w}}}{{{p_b}}}",
        ),
        None,
    ),
}
"""Formulas of an internal pair (GOST 19274) where they are others: of wheel 1 or the pair, and of
wheel 2; None for the same."""


def _helical(
    key: str, symbol: str = "", formula: str = "", numbers: str = ""
) -> tuple[str, tuple[str, str, str]]:
    return key, (symbol, formula, numbers)


_HELICAL = dict((
    _helical(
        "z_min", "",
        "\\frac{2·h_{l}^{*}·cos β}{sin^{2}α_{t}}",
        "\\frac{{2·{h_l}·{cos_beta}}}{{{sin}^{{2}}}}",
    ),
    _helical("inv_alpha", "inv α_{t}", "{tan} α_{t} − α_{t}", "{tan_t} − {rad_alpha}"),
    _helical(
        "inv_alpha_w", "inv α_{tw}",
        "inv α_{t} + \\frac{2·x_{Σ}·{tan} α}{z_{1} + z_{2}}",
    ),
    _helical("alpha_w", "α_{tw}"),
    _helical(
        "a", "",
        "\\frac{m·(z_{1} + z_{2})}{2·cos β}", "\\frac{{{m}·({z1} + {z2})}}{{2·{cos_beta}}}",
    ),
    _helical("a_w", "", "\\frac{a·cos α_{t}}{cos α_{tw}}"),
    _helical("p", "p_{t}", "\\frac{π·m}{cos β}", "\\frac{{π·{m}}}{{{cos_beta}}}"),
    _helical("p_b", "p_{bt}", "p_{t}·cos α_{t}"),
    _helical(
        "x_min", "",
        "h_{l}^{*} − \\frac{z_{#}·sin^{2}α_{t}}{2·cos β}",
        "{h_l} − \\frac{{{z#}·{sin}^{{2}}}}{{2·{cos_beta}}}",
    ),
    _helical("d", "", "\\frac{m·z_{#}}{cos β}", "\\frac{{{m}·{z#}}}{{{cos_beta}}}"),
    _helical("d_b", "", "d_{#}·cos α_{t}"),
    _helical("d_w", "", "\\frac{d_{b#}}{cos α_{tw}}"),
    _helical(
        "s", "s_{t#}",
        "\\frac{m}{cos β}·(\\frac{π}{2} + 2·x_{#}·{tan} α)",
        "\\frac{{{m}}}{{{cos_beta}}}·(\\frac{{π}}{{2}} + 2·{x#}·{tan_alpha})",
    ),
    _helical("e", "e_{t#}", "p_{t} − s_{t#}"),
    _helical("alpha_a", "α_{ta#}"),
    _helical("s_a", "s_{ta#}", "d_{a#}·(\\frac{s_{t#}}{d_{#}} + inv α_{t} − inv α_{ta#})"),
    _helical(
        "W", "",
        "m·cos α·(π·(k_{#} − 0,5) + 2·x_{#}·{tan} α + z_{#}·inv α_{t})",
        "{m}·{cos_n}·(π·({k#} − 0,5) + 2·{x#}·{tan_alpha} + {z#}·{inv_alpha})",
    ),
    _helical("rho_a", "", "\\frac{d_{b#}·{tan} α_{ta#}}{2}"),
    _helical("rho_p", "", "a_{w}·sin α_{tw} − ρ_{a@}"),
    _helical(
        "rho_l", "", "\\frac{d_{#}·sin α_{t}}{2} − \\frac{m·(h_{l}^{*} − x_{#})}{sin α_{t}}"
    ),
    _helical(
        "epsilon_alpha", "", "\\frac{ρ_{a1} + ρ_{a2} − a_{w}·sin α_{tw}}{p_{bt}}"
    ),
))  # fmt: skip
"""Symbols, formulas and numbers of helical wheels where they are others; empty for the same."""

_OF_HELIX = (
    GearSize("beta", "β", Unit.DEGREE),
    GearSize("m_t", "m_{t}", Unit.MM, "\\frac{m}{cos β}", "\\frac{{{m}}}{{{cos_beta}}}"),
    GearSize(
        "alpha_t",
        "α_{t}",
        Unit.DEGREE,
        "arctg(\\frac{{tan} α}{cos β})",
        "arctg(\\frac{{{tan_alpha}}}{{{cos_beta}}})",
    ),
    GearSize(
        "beta_b",
        "β_{b}",
        Unit.DEGREE,
        "arcsin(sin β·cos α)",
        "arcsin({sin_beta}·{cos_n})",
        False,
    ),
)
_OF_TEETH = (
    GearSize(
        "z_v",
        "z_{v#}",
        Unit.NONE,
        "\\frac{z_{#}}{cos^{3}β}",
        "\\frac{{{z#}}}{{{cos_beta}^{{3}}}}",
    ),
    GearSize(
        "s_na",
        "s_{na#}",
        Unit.MM,
        "s_{ta#}·cos β_{a#}",
        "{s_a#}·{cos_beta_a#}",
        False,
    ),
)
_OF_WIDTH = (
    GearSize("width", "b_{w}", Unit.MM, in_table=False),
    GearSize(
        "epsilon_beta",
        "ε_{β}",
        Unit.NONE,
        "\\frac{b_{w}·sin β}{π·m}",
        "\\frac{{{width}·{sin_beta}}}{{π·{m}}}",
    ),
    GearSize(
        "epsilon_gamma", "ε_{γ}", Unit.NONE, "ε_{α} + ε_{β}", "{epsilon_alpha} + {epsilon_beta}"
    ),
)
"""What helical wheels have beside; the last ones where the width is known."""


def _sizes(problem: MeshingProblem) -> tuple[list[GearSize], list[GearSize], list[GearSize]]:
    """Return the quantities of the pair, of both wheels, and of their contact."""
    if not problem.beta:
        return list(_OF_PAIR), list(_OF_WHEELS), list(_OF_CONTACT)

    def own(one: GearSize) -> GearSize:
        symbol, formula, numbers = _HELICAL.get(one.key, ("", "", ""))
        return replace(
            one,
            symbol=symbol or one.symbol,
            formula=formula or one.formula,
            numbers=numbers or one.numbers,
        )

    at = next(k for k, one in enumerate(_OF_PAIR) if one.key == "z_min")
    pair = (*_OF_PAIR[:at], *_OF_HELIX, *_OF_PAIR[at:])
    contact = (*_OF_CONTACT, *(_OF_WIDTH if problem.width is not None else ()))
    one, two, three = (list(map(own, group)) for group in (pair, _OF_WHEELS + _OF_TEETH, contact))
    return one, two, three


_SIGNED = ("x_sum", "a", "a_w", "y", "delta_y")
_SIGNED_2 = ("z", "x", "d", "d_b", "d_w", "d_a", "d_f", "rho_a", "rho_p", "rho_l", "rho_low")
"""What is negative in `Pair` of an internal pair, and of its wheel 2."""


_ANGLES = ("alpha_w", "alpha_a", "beta", "alpha_t", "beta_b")
"""What `Pair` has in radians."""


class Told(Struct, frozen=True):
    """A quantity with its value: one, or those of both wheels."""

    quantity: GearSize
    values: tuple[float, ...]

    def shown(self, say: Notation) -> list[str]:
        """Return the values as they are written, a dash for what does not exist."""
        places = self.quantity.unit.places
        return [
            say.number(f"{value + 0.0:.{places}f}") if np.isfinite(value) else "—"
            for value in self.values
        ]


class SolvedMeshing:
    """A pair solved: its sizes, its teeth, its line of action, its limits (решение)."""

    def __init__(self, problem: MeshingProblem) -> None:
        self.problem = problem
        self.pair = pair = Pair.of(problem)
        self.teeth = (Tooth(pair, 0), Tooth(pair, 1))
        self.cuttings = tuple(RackCutting(t) if t.side > 0 else None for t in self.teeth)
        self.contact = LineOfAction.of(*self.teeth)
        self.limits = limits(problem.tip, problem.overlap, internal=bool(problem.cutter))

    @property
    def epsilon_beta(self) -> float:
        """Overlap ratio ε_β (коэффициент осевого перекрытия); 0 where the width is not known."""
        return (self.problem.width or 0.0) * sin(self.pair.beta) / (pi * self.pair.m)

    def _value(self, key: str) -> Reals:
        problem, pair, rack = self.problem, self.pair, self.pair.rack
        own = {
            "m": pair.m,
            "alpha": np.degrees(rack.alpha),
            "ha": rack.ha,
            "c": rack.c,
            "rho_f": rack.rho,
            "inv_alpha": involute(pair.alpha_t),
            "z": np.array(pair.z, dtype=float),
            "W": pair.base_tangent,
            "rho_low": np.array([tooth.rho_low for tooth in self.teeth]),
            "g_alpha": pair.rho_a[0] - pair.rho_p[0],
            "epsilon_alpha": pair.epsilon,
            "epsilon_active": self.contact.overlap(pair),
            "width": np.nan if problem.width is None else problem.width,
            "epsilon_beta": self.epsilon_beta,
            "epsilon_gamma": float(pair.epsilon) + self.epsilon_beta,
        }
        found = own[key] if key in own else getattr(pair, key)
        if key in _SIGNED_2:
            found = found * np.array([1, pair.side])
        elif key in _SIGNED:
            found = found * pair.side
        return np.asarray(np.degrees(found) if key in _ANGLES else found)

    def told(self) -> tuple[list[Told], list[Told], list[Told]]:
        """Return the quantities of the pair, of both wheels, and of their contact."""
        one, two, three = (
            [Told(q, tuple(float(v) for v in np.atleast_1d(self._value(q.key)))) for q in group]
            for group in _sizes(self.problem)
        )
        if self.problem.cutter:
            at = next(k for k, t in enumerate(one) if t.quantity.key == "x_sum")
            one[at] = replace(one[at], quantity=replace(one[at].quantity, symbol="x_{d}"))
        return one, two, three

    def fields(self, say: Notation) -> dict[str, str]:
        """Return the numbers that formulas are filled with, by their names; ``x1`` of a wheel."""
        rack, alpha_w = self.pair.rack, float(self.pair.alpha_w)
        alpha_t, beta = self.pair.alpha_t, self.pair.beta
        values = {
            "h_l": rack.straight,
            "rad_alpha": alpha_t,
            "tan_alpha": np.tan(rack.alpha),
            "tan_t": np.tan(alpha_t),
            "cos": np.cos(alpha_t),
            "cos_n": np.cos(rack.alpha),
            "sin": np.sin(alpha_t),
            "cos_beta": np.cos(beta),
            "sin_beta": np.sin(beta),
            "cos_w": np.cos(alpha_w),
            "sin_w": np.sin(alpha_w),
        }
        if self.problem.cutter:
            pair = self.pair
            values |= {"a_w0": float(pair.a_w0), "d_a0": pair.d_a0}
            values |= {"sin_w0": np.sin(pair.alpha_w0), "sin_a0": np.sin(pair.alpha_a0)}
        for group in self.told():
            for one in group:
                ends = ("",) if len(one.values) == 1 else ("1", "2")
                values |= {one.quantity.key + e: v for e, v in zip(ends, one.values, strict=True)}
        for k, angle in enumerate(self.pair.alpha_a):
            values[f"inv_alpha_a{k + 1}"] = float(involute(angle))
            values[f"tan_alpha_a{k + 1}"] = np.tan(angle)
            values[f"cos_beta_a{k + 1}"] = float(self.pair.s_na[k] / self.pair.s_a[k])
        angle = {"angle": "α_{tw}" if beta else "α_{w}"}
        return angle | {
            name: f"({shown})" if value < 0 else shown
            for name, value in values.items()
            for shown in [say.number(trimmed(float(value), 6))]
        }

    def formulas(self, words: Language) -> Iterator[tuple[str, str]]:
        """Yield keys and formulas with their numbers and results, rich text, in order."""
        say, fields = words.say, self.fields(words.say)
        tan = words.meshing.tan
        for group in self.told():
            for one in group:
                q = one.quantity
                for k, shown in enumerate(one.shown(say)) if q.formula else ():
                    if not np.isfinite(one.values[k]) and self.problem.cutter:
                        continue  # a ring has no least shift
                    own, other = ("1", "2") if k == 0 else ("2", "1")

                    def put(text: str, own: str = own, other: str = other) -> str:
                        text = text.replace("#", own).replace("@", other)
                        return text.replace("0,5", say.number("0.5"))

                    unit = "°" if q.unit is Unit.DEGREE else ""
                    unit = f" {words.meshing['units']['mm']}" if q.unit is Unit.MM else unit
                    ring = _RING.get(q.key, (None, None))[k] if self.problem.cutter else None
                    formula, filled = ring or (q.formula, q.numbers)
                    letters = put(formula).replace("{tan}", tan)
                    numbers = put(filled).format_map(fields)
                    yield q.key, f"{put(q.symbol)} = {letters} = {numbers} = {shown}{unit}"

    def judged(self) -> Iterator[tuple[BlockingLimit, float, float]]:
        """Yield every limit with what is compared with it, and its bound.

        The contact ratio is that of the teeth as they are cut. Radii of a ring are negative.
        """
        for one in self.limits:
            if not (one.hard and one.kind in (LimitKind.TIP, LimitKind.OVERLAP)):
                value = float(one.value(self.pair))
                if one.kind is LimitKind.OVERLAP:
                    value = self.contact.overlap(self.pair)
                yield one, value, float(one.bound(self.pair))

    def shown(self, limit: BlockingLimit, value: float, bound: float) -> tuple[float, float]:
        """Return what is compared as the standard has it: radii of a ring are positive."""
        if limit.kind is LimitKind.INTERFERENCE and limit.wheel == 1:
            return self.pair.side * value, self.pair.side * bound
        return value, bound

    def sentences(self, words: Language) -> list[tuple[BlockingLimit, bool, str]]:
        """Return every limit: whether it is kept, and what is said of it, rich text."""
        say, found = words.meshing, []
        for one, value, bound in self.judged():
            number = "" if one.wheel is None else str(one.wheel + 1)
            shown = {
                k: words.say.number(f"{v + 0.0:.3f}")
                for k, v in zip(("value", "bound"), self.shown(one, value, bound), strict=True)
            }
            holds = value >= bound
            turned = self.shown(one, 1.0, 1.0)[0] < 0
            sign = ("≤" if turned else "≥") if holds else (">" if turned else "<")
            name = one.kind.value
            if self.pair.beta and one.kind is LimitKind.TIP:
                name = "tip_helical"
            text = say["conditions"][name].format(wheel=number, sign=sign, **shown)
            found.append((one, holds, text))
        return found
