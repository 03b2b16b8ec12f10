"""Zero forces, and moments that cancel: described, without unfinished formulas."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner
from doors import (
    Drawing,
    ModelProblem as Problem,
    Solution,
    Text,
    audit,
    cli,
    force_reading,
    kinematics_sheets,
    problem_loads as loads,
    problem_template as template,
    statics_of,
)
from texts import protocol

CANCEL = """
[dynamics.links.1]
mass = 2
centre = "O"
inertia = 1
[[loads]]
name = "M_{1}"
link = "1"
couple = 3
"""


def six_link(more: str, **changes: str) -> Problem:
    text = template("six-link")
    for key, value in changes.items():
        assert f"\n{key} = " in text
        head, _, tail = text.partition(f"\n{key} = ")
        text = f"{head}\n{key} = {value}\n" + tail.partition("\n")[2]
    return loads(text + more, name="six-link")


def shown(problem: Problem) -> str:
    (sheet,) = kinematics_sheets(problem, layout="forces")
    return texts(sheet)


def texts(sheet: Drawing) -> str:
    """Return the texts of a sheet, without spaces."""
    return "".join(i.text for i in sheet.items if isinstance(i, Text)).replace(" ", "")


def test_couples_that_cancel_on_the_crank_are_described() -> None:
    """M_Φ1 = -1·3 and M_1 = +3 N·m: the moment that balances them is zero."""
    problem = six_link(CANCEL, epsilon="3")
    solution = Solution(problem)
    assert statics_of(solution).balance[0] == pytest.approx(0.0, abs=1e-12)
    told = " ".join(protocol(solution).replace("\u00a0", " ").split())
    assert "ΣM_O = M₁ + M_ур − M_Φ1 = 0, M_ур = 3 − 3 = 0." in told
    assert "+ M_ур·(pa)/l_OA" in told
    assert "момента относительно точки O не дают" not in told.partition("Рычаг")[0]
    sheet = shown(problem)
    assert "Mур=3−3=0" in sheet
    assert re.search(r"Mур·\(pa\)/?l", sheet)  # on the lever, too: a fraction is built or not


def test_of_no_forces_there_are_no_plans() -> None:
    problem = six_link("[dynamics]\n")
    sheet = shown(problem)
    assert sheet.count("нестроится") >= 3
    assert "Всесилыравнынулю" in sheet and "Нагрузкиработынесовершают:Mур=0" in sheet
    assert "ΣMp" not in sheet


def test_a_driver_at_rest_has_no_lever_and_one_remark_on_it(tmp_path: Path) -> None:
    text = template("six-link").replace("omega = 20", "omega = 0") + "[dynamics]\n"
    problem = loads(text, name="still")
    assert force_reading(Solution(problem), 0).statics.lever_plan is None
    assert shown(problem).count("рычагнестроится") == 1
    file = tmp_path / "still.toml"
    file.write_text(text, encoding="utf-8")
    for lang, said in (("ru", "рычага Жуковского нет"), ("en", "there is no Zhukovsky lever")):
        assert said in CliRunner().invoke(cli, ["solve", str(file), "--lang", lang]).output


@pytest.mark.parametrize("what", ["balance O", "lever O"])
def test_a_force_along_the_axis_of_the_crank_has_no_moment(what: str) -> None:
    more = f'{CANCEL}\n[published]\n"q" = {{ value = 1.0, unit = "Н", what = "{what}" }}\n'
    (entry,) = audit(six_link(more))
    assert entry.exact is None and entry.reason is not None and entry.reason.value == "no arm"
