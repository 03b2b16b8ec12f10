"""Documents as Markdown: formulas in LaTeX, steps, tables."""

from __future__ import annotations

import re
from typing import cast

import pytest
from doors import (
    Document,
    Equation,
    Node,
    Term,
    document,
    formula_parse as parse,
    get_language,
    latex,
    markdown_document,
    table_of,
)
from noted import note


def written(*nodes: Node, lang: str = "ru") -> str:
    return markdown_document(Document.of(nodes), get_language(lang)) + "\n"


@pytest.mark.parametrize(
    ("rich", "tex"),
    [
        (r"v_{C} = \frac{v_{B}·\sqrt{x}}{l} = 9,55 м/с",
         r"v_{C} = \frac{v_{B}\cdot \sqrt{x}}{l} = 9{,}55\ \text{м/с}"),
        (r"a^{n}_{B} = −0,5·ω_{1}^{2}", r"a_{B}^{n} = -0{,}5\cdot \omega_{1}^{2}"),
        (r"ε_{1} ≤ sin φ_{2}", r"\varepsilon_{1} \le \sin \varphi_{2}"),
        (r"U^{H}_{1-2} = (\frac{a}{b})", r"U_{1\text{-}2}^{H} = \left(\frac{a}{b}\right)"),
        (r"|ω| = inv α", r"\vert \omega \vert = \operatorname{inv} \alpha"),
        ("^{2}", "{}^{2}"),
        ("μ_{v} = 100 mm/(m/s)", r"\mu_{v} = 100\ \text{mm/(m/s)}"),
        ("μ_{a} = 2 (m/s^{2})/mm", r"\mu_{a} = 2\ \text{(m/s}^{2}\text{)/mm}"),
    ],
)  # fmt: skip
def test_a_formula_is_latex(rich: str, tex: str) -> None:
    assert latex(parse(rich)) == tex


def test_formulas_of_a_sentence_are_between_dollars() -> None:
    text = written(document.Paragraph("Скорость v_{B} = 3,2 м/с, по рисунку *точно* $5 [1]."))
    assert text == "Скорость $v_{B} = 3{,}2\\ \\text{м/с}$, по рисунку \\*точно\\* \\$5 \\[1\\].\n"


def test_a_paragraph_is_no_entry_of_a_list() -> None:
    assert written(document.Paragraph("1. Вал"), document.Paragraph("- нет")) == (
        "1\\. Вал\n\n\\- нет\n"
    )


def test_steps_are_numbered_throughout_and_a_continuation_belongs_to_the_last() -> None:
    text = written(
        document.Step(("Первый", "и ещё")),
        document.Step(("дальше",), continues=True),
        document.Chapter("Глава"),
        document.Step(("Второй",)),
        document.Step(("Третий",)),
    )
    assert text.startswith("1. Первый\\\n   и ещё\\\n   дальше\n\n## 1. Глава\n\n")
    assert text.endswith("2. Второй\n3. Третий\n")


def test_a_table_has_pipes_and_its_numbers_on_the_right() -> None:
    text = written(table_of(("имя", "a, м/с"), [("x|y", "|ω_{1}|")]))
    assert text == "| имя | a, м/с |\n| --- | ---: |\n| x\\|y | $\\vert \\omega_{1}\\vert$ |\n"


def test_vector_equations_mark_known_terms_and_form_a_system() -> None:
    one = Equation((Term("v_{B}"),), (Term("v_{A}", 2), Term("v_{BA}", 1, "⊥ AB")))
    text = written(document.Equations((one, one), numbered=True))
    line = (
        r"\overline{v}_{B} &= \underline{\underline{\overline{v}_{A}}}"
        r" + \underset{\perp \ AB}{\underline{\overline{v}_{BA}}}"
    )
    assert text.count(line) == 2
    assert text.startswith("$$\n\\begin{aligned}\n")
    assert text.endswith("\\end{aligned}\n\\tag{1}$$\n")
    alone = written(document.Equations((Equation((Term("F"), Term("G")), (), "ΣF"),)))
    assert alone == "$$\\Sigma F = \\overline{F} + \\overline{G} = 0$$\n"


def test_figures_are_captions_and_a_title_page_is_lines() -> None:
    page = document.TitlePage(("Вуз", "Кафедра"), work="Записка", place="Омск", year="2026")
    figure = document.Figure(cast("document.DrawableView", None), "План v_{B}", numbered=True)
    text = written(page, document.PageBreak(), figure, document.References(("Попов", "Юдин")))
    assert text == (
        "Вуз\\\nКафедра\\\nЗаписка\\\nОмск 2026\n\n"
        "*Рисунок 1 – План $v_{B}$*\n\n1. Попов\n2. Юдин\n"
    )


def test_every_node_is_written_and_each_brace_and_dollar_has_its_pair() -> None:
    text = markdown_document(note(), get_language("ru"))
    assert text.count("{") == text.count("}")
    assert len(re.findall(r"(?<!\\)\$", text)) % 2 == 0
    for shown in ("## Содержание", "- 1 Кинематика", "#### 1.1.1. Группа 2–3", "- 1 $n_{1}"):
        assert shown in text
    assert "см. ($1.2$)" in text or "см. (1.2)" in text
