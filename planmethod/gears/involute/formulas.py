"""Quantities of a pair: names, symbols, units, formulas with their numbers (формулы).

The formulas are those of an external spur pair, with replacements for an internal pair and for
helical wheels.
"""

# no messages: formulas

from __future__ import annotations

from enum import Enum

from msgspec import Struct
from msgspec.structs import replace

from planmethod.gears.involute.geometry import MeshingProblem
from planmethod.note.formula import Rich


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
        """Name of the unit in a record; empty for a number without a unit."""
        return "deg" if self is Unit.DEGREE else self.value[0]


class GearSize(Struct, frozen=True):
    """One quantity of the record, the table and the protocol (величина).

    Attributes
    ----------
    key : str
        Its name in JSON; that of `Pair` if it has one there.
    symbol : str
        Rich text; ``#`` stands for the number of the wheel.
    formula, numbers : str
        Its formula in letters, and the same with fields for numbers. ``#`` is the wheel, ``@``
        the other one. A quantity without a formula is not derived in the protocol.
    in_table : bool
        Whether it is in the table of the sheet.
    """

    key: str
    symbol: str
    unit: Unit
    formula: str = ""
    numbers: str = ""
    in_table: bool = True

    @property
    def symbols(self) -> Rich | list[Rich]:
        """Symbol; one for each wheel where they differ."""
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


RING_FORMULAS: dict[str, tuple[tuple[str, str] | None, tuple[str, str] | None]] = {
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
        "arc{tan}(\\frac{{tan} α}{cos β})",
        "arc{tan}(\\frac{{{tan_alpha}}}{{{cos_beta}}})",
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
"""Additional quantities of helical wheels whose width is known."""


def sizes_of(problem: MeshingProblem) -> tuple[list[GearSize], list[GearSize], list[GearSize]]:
    """Return the quantities of the pair, of both wheels, and of their contact."""
    if not problem.beta:
        return list(_OF_PAIR), list(_OF_WHEELS), list(_OF_CONTACT)

    def helical(one: GearSize) -> GearSize:
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
    one, two, three = (
        list(map(helical, group)) for group in (pair, _OF_WHEELS + _OF_TEETH, contact)
    )
    return one, two, three
