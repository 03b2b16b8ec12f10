"""A document with every kind of node, for the writers of notes."""

from __future__ import annotations

from doors import (
    Caption,
    Chapter,
    Contents,
    Document,
    DocumentItem as Item,
    DocumentStep as Step,
    Drawing,
    DrawingView,
    Equation,
    Equations,
    Figure,
    Formula,
    Node,
    Note,
    PageBreak,
    Paragraph,
    Part,
    References,
    Stroke,
    StructuralHeading,
    Subpart,
    Table,
    Term,
    Title,
    TitlePage,
    table_of_columns,
    typeset,
)

SPEED = r"v_{C} = \frac{v_{B}·\sqrt{l_{AB}^{2} + 1}}{l_{AB}} = 9,55 м/с,"
SYSTEM = (
    Equation((Term("v_{B3}"),), (Term("v_{B}", 2), Term("v_{B3B}", 1, "∥ CB"))),
    Equation((Term("v_{B3}"),), (Term("v_{C}", 2, "= 0"), Term("v_{B3C}", 1, "⊥ BC"))),
)


def picture() -> Drawing:
    drawing = Drawing(80.0, 50.0, "Plan")
    drawing.add(Stroke((0j, 80 + 50j)), Stroke((10 + 10j, 20 + 10j)))
    drawing.extend(typeset("v_{B}", 5.0).at(12 + 12j))
    return drawing


def nodes() -> tuple[Node, ...]:
    wide = table_of_columns(
        [[f"a^{{n}}_{{B{k}}}, м/с^{{2}}", "−12345,6789"] for k in range(16)], repeated=1
    )
    return (
        TitlePage(
            ("Технический университет", "Кафедра механики"), "Пояснительная записка",
            "к курсовому проекту", "Пресс", "ТММ.01 ПЗ", "И. Иванов", "М-21", "П. Петров",
            "Омск", "2026",
        ),
        Contents(),
        StructuralHeading("Введение"),
        Paragraph(r"На рисунке \ref{plan} и в таблице \ref{sizes}; см. (\ref{speed}), ω_{1} = 5."),
        Chapter("Кинематика"),
        Part("Скорости v_{B}"),
        Subpart("Группа 2–3"),
        Title("Протокол"),
        Caption("Векторные уравнения"),
        Equations(SYSTEM, numbered=True, key="system"),
        Equations((Equation((Term("F_{12}", 1, "⊥ AB"), Term("G_{2}", 2)), (), r"Σ\bar{F}"),)),
        Formula(SPEED, numbered=True, key="speed"),
        Formula("W = 3·5 − 2·7 = 1"),
        Step(("Откладываем отрезок:", r"(pb) = \frac{v_{B}}{μ_{v}} = 64 мм.", "Получаем b.")),
        Step(("Продолжаем a^{n}_{B}.",), continues=True),
        Item("Звено 2 вращается"),
        Item("n_{1} = 100", label="1"),
        Table(("Величина", "Значение"), (("v_{B}, м/с", "3,2"),), name="Скорости", key="sizes"),
        wide,
        Table(tuple(f"Столбец{k}" for k in range(16)), (tuple(["слово"] * 16),)),
        PageBreak(),
        Figure(DrawingView(picture(), (5.0, 5.0, 60.0, 40.0)), "План", numbered=True, key="plan"),
        Figure(DrawingView(picture())),
        Note("Примечание: μ_{l} = 0,002 м/мм."),
        StructuralHeading("Список использованных источников"),
        References(("Артоболевский И. И. Теория механизмов", "Попов С. А. Курс")),
    )  # fmt: skip


def note() -> Document:
    return Document.of(nodes())
