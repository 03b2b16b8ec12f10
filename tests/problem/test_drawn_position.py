"""Fixed points and guides that follow from a drawn position, against figures made by numpy."""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest
from cases import each, some
from doors import (
    AssemblyError,
    FormulaError,
    ProblemError,
    Solution,
    drawn,
    evaluate_arithmetic,
    fingerprint_of,
    get_language,
    protocol_document,
    statement_given_facts as given_facts,
)

from benchmarks.rebuilt import rebuilt
from planmethod import loads

SAME = 1e-9
LANGUAGES = [get_language("ru"), get_language("en")]


def cis(degrees: float) -> complex:
    return complex(np.exp(1j * np.radians(degrees)))


def angle(vector: complex) -> float:
    return float(np.degrees(np.angle(vector)))


def near(**points: complex) -> str:
    """Return rules that choose a figure by some of its points."""
    return "\n".join(
        f"{p} = {{ near = [{float(z.real)!r}, {float(z.imag)!r}] }}" for p, z in points.items()
    )


def four_bar(
    c: str, shown: str, rules: str, *, phi: str = "90", sizes: tuple[float, ...] = (0.3, 0.8, 0.7),
    more: str = "",
) -> str:  # fmt: skip
    """Return the file of a four-bar linkage whose pivot C, or position, is drawn."""
    return f"""
[frame]
O = [0, 0]
C = {c}
[drawn]
{shown}
[links.1]
points = ["O", "A"]
OA = {sizes[0]!r}
[links.2]
points = ["A", "B"]
AB = {sizes[1]!r}
[links.3]
points = ["C", "B"]
CB = {sizes[2]!r}
[driver]
link = "1"
phi = {phi}
omega = 10
[assembly]
{rules}
{more}
"""


def fixed(text: str, name: str = "C") -> complex:
    return complex(loads(text, name="drawn").bodies["0"].points[name])


# The tasks of section 2.1 that give the position by angles: lengths of the crank, rod and rocker,
# angles as printed, and the pivot of the rocker by hand.
TASKS: list[tuple[str, tuple[float, ...], dict[str, float], complex]] = [
    ("2.1.2", (0.1, 0.4, 0.4), {"phi_1": 90, "phi_3": 90, "phi_2_3": 90}, 0.4 - 0.3j),
    ("2.1.4", (0.1, 0.2, 0.15), {"phi_1": 30, "phi_3": 90},
     0.1 * cis(30).real + np.sqrt(0.2**2 - 0.1**2) + 0j),
    ("2.1.5", (0.05, 0.2, 0.2), {"phi_1": 45, "phi_3": 90, "phi_2_3": 90},
     0.05 * cis(45) + 0.2 - 0.2j),
    ("2.1.7", (0.3, 0.8, 0.7), {"phi_1": 90, "phi_2": 30, "phi_3": 90}, 0.8 * cis(30).real + 0j),
    ("2.1.15", (0.05, 0.1, 0.1), {"phi_1_2": 90, "phi_2_3": 90, "phi_3": 90}, 0.1 - 0.05j),
    ("2.1.17", (0.25, 0.5, 0.5), {"phi_1_2": 90, "phi_2_3": 90, "phi_3": 90}, 0.5 - 0.25j),
    ("2.1.36", (0.05, 0.12, 0.12), {"phi_1": 90, "phi_2_3": 120, "phi_3": 30},
     0.05j + 0.12 * cis(-90) - 0.12 * cis(30)),
    ("2.1.45", (0.08, 0.2, 0.18), {"phi_1": 30, "phi_1_2": 30, "phi_2_3": 90, "phi_3": 90},
     0.08 * cis(30) + 0.2 - 0.18j),
    ("2.1.48", (0.1, 0.25, 0.25), {"phi_1": 90, "phi_1_2": 90, "phi_2_3": 90, "phi_3": 90},
     0.25 - 0.15j),
    ("2.1.51", (0.06, 0.15, 0.06), {"phi_1": 90, "phi_1_2": 90, "phi_3": 90}, 0.15 + 0j),
    ("2.1.52", (0.05, 0.14, 0.14), {"phi_1": 90, "phi_1_2": 90, "phi_2_3": 90}, 0.14 - 0.09j),
    ("2.1.87", (0.1, 0.2, 0.2), {"phi_1": 90, "phi_1_2": 45, "phi_2_3": 90},
     0.1j + 0.2 * cis(45) - 0.2 * cis(135)),
    ("2.1.134", (0.06, 0.1, 0.15), {"phi_1": 90, "phi_2_3": 90, "phi_3": 90}, 0.1 - 0.09j),
    ("2.1.136", (0.1, 0.15, 0.15), {"phi_1": 90, "phi_2_3": 90, "phi_3": 90}, 0.15 - 0.05j),
    ("2.1.137", (0.04, 0.06, 0.06), {"phi_1": 30, "phi_3": 90},
     0.04 * cis(30).real + np.sqrt(0.06**2 - 0.04**2) + 0j),
]  # fmt: skip


def task_file(sizes: tuple[float, ...], angles: dict[str, float], c: complex) -> str:
    shown = "\n".join(f"{key} = {value}" for key, value in angles.items() if key != "phi_1")
    phi = str(angles["phi_1"]) if "phi_1" in angles else '"drawn"'
    crank = {} if "phi_1" in angles else {"A": sizes[0] * 1j}
    told = [*angles] == ["phi_1", "phi_3"]
    pivot = '["drawn", 0]' if told else '"drawn"'  # there the pivots are on one level
    return four_bar(pivot, shown, near(C=c, **crank), phi=phi, sizes=sizes)


@each("name, sizes, angles, c", TASKS)
def test_tasks_are_written_with_the_angles_that_they_print(
    name: str, sizes: tuple[float, ...], angles: dict[str, float], c: complex
) -> None:
    problem = loads(task_file(sizes, angles, c), name=name)
    assert abs(problem.bodies["0"].points["C"] - c) < SAME
    solution = Solution(problem)
    for key, value in angles.items():  # the position that is drawn is the one that is solved
        links = [solution.links[link].phi_deg[0] for link in key.split("_")[1:]]
        turned = links[0] if len(links) == 1 else abs((links[1] - links[0] + 180) % 360 - 180)
        assert turned % 360 == pytest.approx(value, abs=1e-6), key
    for language in LANGUAGES:
        facts = [drawn(problem, language), *given_facts(problem, language)]
        again = Solution(rebuilt(facts))
        for point, motion in solution.points.items():
            assert abs(again.points[point].place - motion.place).max() < SAME


def test_a_line_of_a_link_has_an_angle_of_its_own() -> None:
    """Link 3 is at 70 degrees to BE, a line of link 2 that is not its own axis."""
    b, phi = 0.3 * cis(60), 40.0
    e, c = b + 0.2 * cis(phi), b + 0.5 * cis(phi - 35)
    d = c - 0.4 * cis(phi - 70)
    text = f"""
[frame]
A = [0, 0]
D = "drawn"
[drawn]
phi_BE = {phi}
phi_3_BE = 70
[links.1]
points = ["A", "B"]
AB = 0.3
[links.2]
points = ["B", "C", "E"]
BC = 0.5
E = {{ vertex = "B", ray = "BC", angle = 35, distance = 0.2 }}
[links.3]
points = ["D", "C"]
DC = 0.4
[driver]
link = "1"
phi = 60
omega = 10
[assembly]
{near(D=d)}
"""
    problem = loads(text, name="lines")
    assert abs(problem.bodies["0"].points["D"] - d) < SAME
    solution = Solution(problem)
    assert abs(solution.points["E"].place[0] - e) < SAME
    for language, line in zip(LANGUAGES, ("к BE", "to BE"), strict=True):
        facts = [drawn(problem, language), *given_facts(problem, language)]
        assert "φ_{BE} = 40°" in "; ".join(fact.text for fact in facts)
        again = rebuilt(facts)
        assert abs(again.bodies["0"].points["D"] - d) < SAME
        text = str(protocol_document(solution, language))
        assert "φ_{3,BE} = 70°" in text and line in text


def test_the_found_place_is_told_and_the_statement_keeps_the_angles() -> None:
    _, sizes, angles, c = TASKS[3]
    solution = Solution(loads(task_file(sizes, angles, c), name="2.1.7"))
    for language, words in zip(LANGUAGES, (("по рисунку", "Построение по рисунку"),
                                           ("figure shows", "Construction of the figure")),
                               strict=True):  # fmt: skip
        nodes = protocol_document(solution, language).nodes
        text = repr(nodes)
        for word in (*words, "φ_{3} + 180° = 270°", "x_{C} = 0"):
            assert word in text
        given = "; ".join(fact.text for fact in given_facts(solution.problem, language))
        assert "x_{C}" not in given and "φ_{2} = 30°" in given and "φ_{3} = 90°" in given


WAYS = (
    ("phi_2", "phi_3"), ("phi_2", "phi_2_3"), ("phi_3", "phi_2_3"), ("phi_1_2", "phi_2_3"),
    ("phi_1_2", "phi_3"), ("AC", "OC"), ("OB", "phi_3"), ("OC", "phi_3"), ("OC", "phi_2"),
    ("AC", "phi_2"), ("y", "phi_3"), ("x", "phi_2"), ("y", "phi_1_2"), ("x", "OB"), ("y", "AC"),
    ("MC", "phi_2"), ("OC", "phi_2_3"), ("y", "phi_2_3"), ("phi_MB", "phi_3"),
    ("phi_2", "phi_AM_3"), ("phi_MB_3", "phi_CB"), ("phi_1_MB", "phi_AM_CB"), ("OC", "phi_MB_3"),
    ("AC", "phi_3"), ("AC", "phi_1_3"),
)  # fmt: skip
"""Data that place the pivot of a rocker, beside the position of the crank."""


@each("way, seed", [(way, seed) for way in WAYS for seed in range(some(2, 25))])
def test_a_pivot_is_found_from_any_sufficient_data(way: tuple[str, ...], seed: int) -> None:
    rng = np.random.default_rng([seed, WAYS.index(way)])

    def vector(low: float, high: float) -> complex:
        return complex(rng.uniform(low, high) * np.exp(2j * np.pi * rng.uniform()))

    a = vector(0.1, 0.4)
    b = a + vector(0.4, 1.0)
    c, m = b + vector(0.4, 1.0), a + (b - a) * vector(0.3, 1.0)
    shown = {
        "phi_2": angle(b - a), "phi_3": angle(b - c), "phi_2_3": abs(angle((b - c) / (b - a))),
        "phi_1_2": abs(angle((b - a) / a)), "AC": abs(c - a), "OC": abs(c), "OB": abs(b),
        "MC": abs(m - c), "phi_MB": angle(b - m), "phi_CB": angle(b - c),
        "phi_AM_3": abs(angle((b - c) / (m - a))), "phi_MB_3": abs(angle((b - c) / (b - m))),
        "phi_AM_CB": abs(angle((b - c) / (m - a))), "phi_1_MB": abs(angle((b - m) / a)),
        "phi_1_3": abs(angle((b - c) / a)),
    }  # fmt: skip
    pivot = f'["drawn", {c.imag!r}]' if "y" in way else '"drawn"'
    pivot = f'[{c.real!r}, "drawn"]' if "x" in way else pivot
    told = "\n".join(f"{key} = {shown[key]!r}" for key in way if key in shown)
    sizes = (abs(a), abs(b - a), abs(b - c))
    at = (m - a) / (b - a) * abs(b - a)
    text = four_bar(pivot, told, near(B=b, C=c), phi=repr(angle(a)), sizes=sizes)
    point = f'M = {{ from = "A", at = {at.real!r}, across = {at.imag!r} }}'
    text = text.replace('points = ["A", "B"]', f'points = ["A", "B", "M"]\n{point}')
    problem = loads(text, name="way")
    assert abs(problem.bodies["0"].points["C"] - c) < SAME
    assert abs(Solution(problem).points["B"].place[0] - b) < 1e-6

    turn, scale = vector(1.0, 1.0), rng.uniform(0.1, 10.0)  # another figure of the same shape
    if "x" not in way and "y" not in way and "M" not in "".join(way):
        angles = {k: v + angle(turn) if k in ("phi_2", "phi_3") else v for k, v in shown.items()}
        told = "\n".join(
            f"{key} = {angles[key] * (1.0 if key.startswith('phi') else scale)!r}" for key in way
        )
        grown = tuple(size * scale for size in sizes)
        place = near(B=b * turn * scale, C=c * turn * scale)
        moved = four_bar(pivot, told, place, phi=repr(angle(a * turn)), sizes=grown)
        assert abs(fixed(moved) - c * turn * scale) < SAME * max(scale, 1.0)


SLIDER = """
[frame]
A = [0.02, -0.01]
guides.x-x = {{ through = {through}, angle = {angle} }}
[drawn]
{shown}
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B", "C"]
BC = 0.3
[links.3]
points = ["C"]
slides = {{ on = "x-x"{offset} }}
[driver]
link = "1"
phi = 50
omega = 10
[assembly]
{rules}
"""
B_OF_SLIDER = 0.02 - 0.01j + 0.1 * cis(50)
C_OF_SLIDER = B_OF_SLIDER + 0.3 * cis(-12)


@each(
    "through, of_guide, shown, offset",
    (
        ('"drawn"', "20", "phi_2 = -12", 0.0),
        ('"drawn"', "20", "phi_2_3 = 32", 0.0),
        ('"drawn"', "20", "phi_2 = -12", 0.03),
        ('["drawn", 0]', "20", "phi_2 = -12", 0.0),
        ('[0.1, "drawn"]', "20", f"AC = {abs(C_OF_SLIDER - 0.02 + 0.01j)!r}", 0.0),
        ('"A"', '"drawn"', "phi_2 = -12", 0.0),
        ('"drawn"', '"drawn"', "phi_2 = -12\nphi_2_3 = 32", 0.0),
        ('"drawn"', '"drawn"', "phi_2 = -12\nphi_3 = 20", 0.01),
    ),
)
def test_a_guide_is_found(through: str, of_guide: str, shown: str, offset: float) -> None:
    rules = near(C=C_OF_SLIDER)
    side = f", offset = {offset}" if offset else ""
    if of_guide == '"drawn"' and "phi_2_3" in shown:  # both senses of the angle fit
        with pytest.raises(ProblemError, match="mirror images"):
            loads(SLIDER.format(through=through, angle=of_guide, shown=shown, offset=side,
                                rules=rules), name="guide")  # fmt: skip
        return
    text = SLIDER.format(through=through, angle=of_guide, shown=shown, offset=side, rules=rules)
    problem = loads(text, name="guide")
    _, base, turned = problem.guides["x-x"]
    along = C_OF_SLIDER - 1j * offset * cis(turned) - base
    assert abs((along * cis(-turned)).imag) < SAME
    if of_guide == "20":
        assert turned == 20
    elif through == '"A"':
        assert turned == pytest.approx(angle(C_OF_SLIDER - 0.02 + 0.01j), abs=1e-9)
    else:
        assert turned == pytest.approx(20, abs=1e-9)
    known = re.findall(r"-?[\d.]+", through)
    if known:
        assert (base.imag if through.startswith('["') else base.real) == float(known[0])
    assert abs(Solution(problem).points["C"].place[0] - C_OF_SLIDER) < 1e-7


SLOTTED = """
[frame]
A = [0, 0]
D = {pivot}
[drawn]
{shown}
[links.1]
points = ["A", "B"]
AB = 0.1
[links.2]
points = ["B"]
slides = {{ on = "3", through = "D", angle = 0 }}
[links.3]
points = ["D", "E"]
DE = 0.4
[driver]
link = "1"
phi = 35
omega = 10
"""


def test_the_pivot_of_a_slotted_link_is_found() -> None:
    b = 0.1 * cis(35)
    expected = b.real - (b.imag + 0.3) / np.tan(np.radians(70)) - 0.3j
    problem = loads(SLOTTED.format(pivot='["drawn", -0.3]', shown="phi_3 = 70"), name="slot")
    assert abs(problem.bodies["0"].points["D"] - expected) < SAME
    assert Solution(problem).links["3"].phi_deg[0] == pytest.approx(70, abs=1e-9)
    end = expected + 0.4 * cis(70)
    shown = f"phi_3 = 70\nAE = {float(abs(end))!r}"
    text = SLOTTED.format(pivot='"drawn"', shown=shown) + "[assembly]\n" + near(D=expected)
    assert abs(fixed(text, "D") - expected) < SAME


def test_a_driving_slider_and_its_own_place_in_the_figure() -> None:
    text = """
    [frame]
    O = [0, 0]
    D = ["drawn", 0.5]
    guides.x-x = { through = "O", angle = 0 }
    [drawn]
    s = 0.1
    phi_2 = 60
    [links.1]
    points = ["A"]
    slides = { on = "x-x" }
    [links.2]
    points = ["A", "B"]
    AB = 0.3
    [links.3]
    points = ["D", "B"]
    DB = 0.4
    [driver]
    link = "1"
    s = 0.12
    v = 1
    [assembly]
    D = "right of B"
    """
    b = 0.1 + 0.3 * cis(60)
    d = b.real + np.sqrt(0.4**2 - (0.5 - b.imag) ** 2) + 0.5j
    problem = loads(text, name="slider")
    assert abs(problem.bodies["0"].points["D"] - d) < SAME
    for language in LANGUAGES:
        again = rebuilt([drawn(problem, language), *given_facts(problem, language)])
        assert abs(again.bodies["0"].points["D"] - d) < SAME


def test_the_figure_may_have_another_position_than_the_driver() -> None:
    c = 0.3 * 1j + 0.8 * cis(30) - 0.7j
    text = four_bar('"drawn"', "phi_1 = 90\nphi_2 = 30\nphi_3 = 90", "", phi="[20, 70]")
    problem = loads(text, name="other")
    assert abs(problem.bodies["0"].points["C"] - c) < SAME
    solution = Solution(problem)  # it closes as the figure does, which no rule has to say
    crank = 0.3 * cis(20)
    reach, chord = (0.8**2 - 0.7**2 + abs(c - crank) ** 2) / 2 / abs(c - crank), c - crank
    b = crank + chord / abs(chord) * complex(reach, np.sqrt(0.8**2 - reach**2))
    assert abs(solution.points["B"].place[0] - b) < SAME
    for positions in ([20.0, 70.0], [90.0], [45.0]):
        facts = [drawn(problem, LANGUAGES[0]), *given_facts(problem, LANGUAGES[0], positions)]
        again = Solution(rebuilt(facts)).with_positions(positions)
        own = solution.with_positions(positions)
        assert abs(again.points["B"].place - own.points["B"].place).max() < SAME


def test_lengths_in_millimetres_and_arithmetic_of_angles() -> None:
    text = 'units = "mm"\n' + four_bar(
        '"drawn"', 'phi_2 = "atan2(1, sqrt(3))"\nphi_3 = "60 + 30"', "", sizes=(300, 800, 700)
    )
    assert abs(fixed(text) - 0.8 * cis(30).real) < SAME
    text = four_bar('["0.8*cos(30)", "0.3 + 0.8*sin(30) - 0.7"]', "", 'B = "above C"')
    assert abs(fixed(text.replace("[drawn]\n", "")) - 0.8 * cis(30).real) < SAME


@each(
    "text, value",
    (
        ("0.8*cos(60)", 0.4), ("2*sin(30)", 1.0), ("tg(45)", 1.0), ("atan2(1, -1)", 135.0),
        ("atan2(-0.3;0.4)", float(np.degrees(np.arctan2(-0.3, 0.4)))), ("acos(0.5)", 60.0),
        ("3*arctg(1)/ctg(45)", 135.0), ("cos(-450) + sin(720)", 0.0),
    ),
)  # fmt: skip
def test_functions_in_numbers_are_of_degrees(text: str, value: float) -> None:
    assert evaluate_arithmetic(text) == pytest.approx(value, abs=1e-12)


@pytest.mark.parametrize(
    "text", ("tg(90)", "asin(2)", "atan2(0, 0)", "atan2(1)", "cos 30", "ln(2)")
)
def test_functions_without_a_value_are_faults(text: str) -> None:
    with pytest.raises(FormulaError):
        evaluate_arithmetic(text)


def test_a_cyrillic_letter_in_a_function_is_named() -> None:
    told = "character 2: '\u043e' is the Cyrillic letter \u043e (U+043E), expected the Latin letter"
    with pytest.raises(FormulaError, match=re.escape(told)):
        evaluate_arithmetic("c\u043es(60)")


def test_a_form_does_not_depend_on_how_the_pivot_is_given() -> None:
    shown = four_bar('"drawn"', "phi_2 = 30\nphi_3 = 90", 'B = "above C"')
    c = fixed(shown)
    plain = four_bar(f"[{c.real!r}, {c.imag!r}]", "", 'B = "above C"').replace("[drawn]\n", "")
    one, two = (fingerprint_of(loads(text, name="form")) for text in (shown, plain))
    assert one == two


def test_a_variant_has_its_own_angles() -> None:
    more = "[variants.2]\ndrawn.phi_2 = 40\nlinks.2.AB = 0.9\ndriver.phi = 80"
    text = four_bar('"drawn"', "phi_2 = 30\nphi_3 = 90", "", more=more)
    problem = loads(text, name="v", variant="2")
    expected = 0.3 * cis(80) + 0.9 * cis(40) - 0.7j
    assert abs(problem.bodies["0"].points["C"] - expected) < SAME


FAULTS: list[tuple[str, dict[str, Any], str]] = [
    ("too little", {"shown": "phi_3 = 90"},
     r"does not determine point C\..*phi_2, phi_1_2, phi_2_3"),
    ("nothing", {"shown": "", "phi": '"drawn"'}, r"More than one number is missing.*1, 2, 3"),
    ("no place", {"c": '"drawn"\nguides.x-x = { through = "drawn", angle = 0 }',
                  "shown": "phi_2 = 30\nphi_3 = 90"},
     r'does not determine guide x-x\. Give numbers in place of one "drawn"'),
    ("contradiction", {"shown": "phi_2 = 30\nphi_3 = 90\nphi_2_3 = 50"},
     r"drawn\.phi_2_3: phi_2_3 = 50° is given, and the other data of the figure give 60°"),
    ("length", {"shown": "phi_2 = 30\nphi_3 = 90\nOC = 0.72"},
     r"OC = 0\.72 m is given, and the other data of the figure give 0\.69282 m"),
    ("coordinate", {"c": '["drawn", 0.05]', "shown": "phi_2 = 30\nphi_3 = 90"},
     r"y_C = 0\.05 m is given, and the other data of the figure give"),
    ("gap", {"c": '["drawn", 2]', "shown": "phi_3 = 90"},
     r"cannot be built at .: the arc has the radius"),
    ("mirror", {"shown": "phi_2_3 = 90\nphi_3 = 90"},
     r"2 mirror images of the figure fit.*\(-0\.8, -0\.4\).*\(0\.8, -0\.4\).*Give in \[assembly\]"),
    ("rule", {"shown": "phi_2 = 30\nphi_3 = 90", "rules": 'B = "below C"'},
     r"assembly\.B: the figure contradicts this rule: B is at \(0\.6928, 0\.7\) m.*3: CB"),
    ("twice", {"shown": "phi_2_3 = 90\nphi_3_2 = 90"}, r"drawn\.phi_3_2: the same as phi_2_3"),
    ("link", {"shown": "phi_4 = 90"}, r"drawn\.phi_4: unknown link '4'"),
    ("key", {"shown": "psi = 90"}, r"drawn\.psi: unknown key"),
    ("line", {"shown": "phi_2_AC = 90"}, r"drawn\.phi_2_AC: no link has both points A and C"),
    ("own line", {"shown": "phi_2_AB = 90"}, r"phi_2_AB: an angle must be between two links"),
    ("no point", {"shown": "phi_AX = 90"}, r"drawn\.phi_AX: the mechanism has no point 'X'"),
    ("wide", {"shown": "phi_2_3 = 200"}, r"drawn\.phi_2_3: expected an angle of two links from 0"),
    ("point", {"shown": "AX = 1"}, r"drawn\.AX: the mechanism has no point 'X'"),
    ("place", {"shown": "s = 0.1\nphi_2 = 30"}, r"drawn\.s: link 1 turns"),
    ("known", {"c": "[0.7, 0]", "shown": "phi_2 = 30"}, r'nothing in the file is "drawn"'),
]  # fmt: skip


@each("name, parts, message", FAULTS)
def test_a_fault_says_what_is_missing_or_contradicts(
    name: str, parts: dict[str, Any], message: str
) -> None:
    told = {"c": '"drawn"', "rules": "", "shown": "", "phi": "90"} | parts
    with pytest.raises((ProblemError, AssemblyError)) as caught:
        loads(four_bar(told["c"], told["shown"], told["rules"], phi=told["phi"]), name=name)
    assert re.search(message, str(caught.value).replace("\n", " ")), str(caught.value)


def test_each_suggested_rule_chooses_one_mirror_image() -> None:
    shown = "phi_2_3 = 90\nphi_3 = 90"
    with pytest.raises(ProblemError) as caught:
        loads(four_bar('"drawn"', shown, ""), name="mirror")
    rules = re.findall(r'\w = "[^"]+"', str(caught.value).partition("Give in")[2])
    found = [fixed(four_bar('"drawn"', shown, rule)) for rule in rules]
    assert len(found) == 2
    assert np.allclose(sorted(found, key=lambda z: z.real), [-0.8 - 0.4j, 0.8 - 0.4j])


@each("off, fits", ((0.4, True), (0.6, False)))
def test_a_number_more_may_be_rounded(off: float, fits: bool) -> None:
    text = four_bar('"drawn"', f"phi_2 = 30\nphi_3 = 90\nphi_2_3 = {60 + off}", "")
    if fits:
        assert abs(fixed(text) - 0.8 * cis(30).real) < SAME
        return
    with pytest.raises(ProblemError, match=r"phi_2_3 = 60\.6° is given"):
        loads(text, name="rounded")


def test_the_supplement_of_an_angle_is_taken_where_it_alone_fits() -> None:
    c = 0.3j + 0.8 * cis(30) - 0.7j  # the axes are at 60 degrees, the angle at the pin is 120
    text = four_bar('"drawn"', "phi_1_2 = 120\nphi_3 = 90", near(C=c))
    assert abs(fixed(text) - c) < SAME


def test_every_number_that_is_suggested_suffices() -> None:
    with pytest.raises(ProblemError) as caught:
        loads(four_bar('"drawn"', "phi_3 = 90", ""), name="little")
    suggested = re.findall(r"phi_\w+", str(caught.value).partition("One of these")[2])
    assert {*suggested} == {"phi_2", "phi_1_2", "phi_2_3"}
    b = 0.3j + 0.8 * cis(30)
    for key, value in (("phi_2", 30), ("phi_1_2", 60), ("phi_2_3", 60)):
        text = four_bar('"drawn"', f"phi_3 = 90\n{key} = {value}", near(B=b))
        assert abs(fixed(text) - 0.8 * cis(30).real) < SAME
