from __future__ import annotations

import pytest
from doors import QuantityKey, QuantityKind, QuantityNameError, parse_quantity

K = QuantityKind


@pytest.mark.parametrize(
    ("texts", "key"),
    [
        (("v C", "v_C", "C.v"), QuantityKey(K.VELOCITY, ("C",))),
        (("v C B", "v_C_B"), QuantityKey(K.VELOCITY, ("C", "B"))),
        (("vx C", "vx_C", "C.vx"), QuantityKey(K.VELOCITY, ("C",), "x")),
        (("y C", "y_C", "C.y"), QuantityKey(K.PLACE, ("C",), "y")),
        (("an C B", "an_C_B"), QuantityKey(K.NORMAL, ("C", "B"))),
        (("ak B3 B", "ak_B3_B"), QuantityKey(K.CORIOLIS, ("B3", "B"))),
        (("omega 2", "omega_2", "2.omega"), QuantityKey(K.OMEGA, ("2",))),
        (("  phi   3 ", "phi_3", "3.phi_deg"), QuantityKey(K.DIRECTION, ("3",))),
        (("segment velocity p D",), QuantityKey(K.VELOCITY_SEGMENT, ("p", "D"))),
        (("length B C",), QuantityKey(K.LENGTH, ("B", "C"))),
        (
            ("vx D / omega 1", "vx D/omega 1", "vx_D/omega_1"),
            QuantityKey(K.VELOCITY, ("D",), "x", QuantityKey(K.OMEGA, ("1",))),
        ),
        (("centre x 1 3", "P_13.x"), QuantityKey(K.CENTRE, ("1", "3"), "x")),
        (("centre y 1 12", "P_1,12.y"), QuantityKey(K.CENTRE, ("1", "12"), "y")),
        (("centre distance 0 3 E",), QuantityKey(K.CENTRE_DISTANCE, ("0", "3", "E"))),
        (("centre v E",), QuantityKey(K.CENTRE_VELOCITY, ("E",))),
        (("v_q C",), QuantityKey(K.TRANSFER, ("C",))),
        (("x1 C", "x1_C", "v_qx_C"), QuantityKey(K.TRANSFER, ("C",), "x")),
        (("u 2 1", "u_21", "u_2/1"), QuantityKey(K.RATIO, ("2", "1"))),
        (("epsilon_q 2", "epsilon_q_2"), QuantityKey(K.RATIO_2, ("2",))),
        (("F 2 0", "F_B_2/0", "F.B.2-0"), QuantityKey(K.REACTION, ("2", "0"))),
        (("Fx 2 0", "F.B.2-0.x"), QuantityKey(K.REACTION, ("2", "0"), "x")),
        (("M 2 0", "M_B_2/0", "M.B.2-0"), QuantityKey(K.MOMENT, ("2", "0"))),
        (("Ft 2 1 B C",), QuantityKey(K.TANGENTIAL_REACTION, ("2", "1", "B", "C"))),
        (("inertia 2", "inertia_2"), QuantityKey(K.INERTIA, ("2",))),
        (("inertia couple 2",), QuantityKey(K.INERTIA_COUPLE, ("2",))),
        (("angle F 2 1",), QuantityKey(K.REACTION_ANGLE, ("2", "1"))),
        (("arm F 2 1 about C",), QuantityKey(K.REACTION_ARM, ("2", "1", "C"))),
        (("arm load F_{5C} about C",), QuantityKey(K.LOAD_ARM, ("F_{5C}", "C"))),
        (("load F3", "load_F3", "load F_{3}"), QuantityKey(K.LOAD, ("F_{3}",))),
        (
            ("balance", "M_dr", "F_dr", "driving.moment", "driving.force"),
            QuantityKey(K.BALANCE, ()),
        ),
        (("lever", "M_lever", "F_lever", "lever.moment"), QuantityKey(K.LEVER, ())),
        (("lever A",), QuantityKey(K.LEVER, ("A",))),
        (("machine energy 2 3",), QuantityKey(K.LINK_ENERGY, ("2", "3"))),
        (
            ("M 5 0 / F 5 0",),
            QuantityKey(K.MOMENT, ("5", "0"), "", QuantityKey(K.REACTION, ("5", "0"))),
        ),
    ],
)
def test_every_spelling_is_read(texts: tuple[str, ...], key: QuantityKey) -> None:
    assert {text: parse_quantity(text) for text in texts} == dict.fromkeys(texts, key)
    assert parse_quantity(key.words) == key


def test_labels_of_sliding_need_the_pairs_of_the_mechanism() -> None:
    pairs = {"B3/2": ("B3", "B"), "E5/0": ("E",)}
    found = {name: parse_quantity(name, pairs).words for name in ("v_B3/2", "ar_B3/2", "v_E5/0")}
    assert found == {"v_B3/2": "vs B3 B", "ar_B3/2": "ar B3 B", "v_E5/0": "v E"}
    with pytest.raises(QuantityNameError):
        parse_quantity("v_B3/2")


@pytest.mark.parametrize("kind", K, ids=lambda kind: kind.name)
def test_every_kind_that_is_named_is_read_back(kind: QuantityKind) -> None:
    for form in kind.forms:
        names = tuple(str(number) for number in range(2, 2 + len(form)))
        for axis in ("", "x", "y") if kind.part else ("",):
            key = QuantityKey(kind, names, axis)
            if key.word and (not axis or form == kind.forms[0]):
                assert parse_quantity(key.words) == key


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", 'expected a quantity such as "v C", got an empty text'),
        ("w 2", "unknown quantity 'w'"),
        ("omga 2", "unknown quantity 'omga' (the nearest is 'omega')"),
        ("x", "'x' takes 1 name, got 0"),
        ("v A B C", "'v' takes 1 or 2 names, got 3"),
        ("at A A", "'at' needs two different names"),
        ("v A / v B / v C", "expected one division at most"),
        ("v A /", 'expected a quantity such as "v C", got an empty text'),
        ("segment", "unknown quantity 'segment'"),
        ("angle 2 1", "unknown quantity 'angle 2'"),
        ("arm weigth 2 about C", "unknown quantity 'arm weigth' (the nearest is 'arm weight')"),
        ("arm weight 2 C", "'arm weight' must end with 'about' and a point"),
        ("arm weight about C", "'arm weight' takes 2 names, got 1"),
        ("F 2", "'F' takes 2 names, got 1"),
        ("F 2 2", "'F' needs two different names"),
        ("Ft 2 1 B B", "'Ft' needs two different names"),
        ("balance A B", "'balance' takes 0 or 1 names, got 2"),
    ],
)
def test_faulty_selectors_are_rejected(text: str, message: str) -> None:
    with pytest.raises(QuantityNameError) as caught:
        parse_quantity(text)
    assert str(caught.value).startswith(message)


def test_unknown_names_know_the_pole_and_links() -> None:
    points, links = ["B", "B3"], ["3"]
    assert parse_quantity("segment velocity p B3").unknown_names(points, links) == []
    assert parse_quantity("v p").unknown_names(points, links) == ["p"]
    assert parse_quantity("omega B").unknown_names(points, links) == ["B"]
    assert parse_quantity("v C / omega 4").unknown_names(points, links) == ["C", "4"]


@pytest.mark.parametrize(
    ("text", "unknown"),
    [
        ("F 3 0", []),
        ("F 0 3", []),
        ("F 3 4", ["4"]),
        ("weight 0", ["0"]),
        ("Fn 3 0 B C", ["C"]),
        ("arm load P about B", []),
        ("arm load Q about D", ["Q", "D"]),
        ("arm F 3 B about 3", ["B", "3"]),
        ("M 3 4 / F 3 0", ["4"]),
        ("lever p", ["p"]),
        ("balance", []),
    ],
)
def test_unknown_names_of_forces(text: str, unknown: list[str]) -> None:
    assert parse_quantity(text).unknown_names(["B", "B3"], ["3"], ["P"]) == unknown


def test_a_link_and_a_point_may_have_one_name() -> None:
    assert parse_quantity("Ft A B A B").names == ("A", "B", "A", "B")


def test_selectors_of_forces_are_recognized() -> None:
    told = {"v B": False, "F 2 1": True, "v B / v C": False, "v B / F 2 1": True}
    assert {text: parse_quantity(text).is_loaded for text in told} == told
