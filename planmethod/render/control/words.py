"""What the norm control calls the parts of a sheet: views, pens, lines, what letters lie on."""

from __future__ import annotations

from planmethod.render.ink.drawing import Pen

PLACES = {
    "ru": {
        "position": "план положения",
        "velocity": "план скоростей",
        "acceleration": "план ускорений",
        "forces": "план сил",
        "balance": "диаграмма уравновешивания",
        "reactions": "диаграмма реакций",
        "hodograph": "годографы реакций",
        "structure": "структурные схемы",
        "stamp": "основная надпись",
        "": "лист",
    },
    "en": {
        "position": "position plan",
        "velocity": "velocity plan",
        "acceleration": "acceleration plan",
        "forces": "force plan",
        "balance": "diagram of the balance",
        "reactions": "diagram of reactions",
        "hodograph": "polar diagrams",
        "structure": "structural schemes",
        "stamp": "title block",
        "": "sheet",
    },
}
"""What the views and the rest of a sheet are called."""

_PENS_RU = {
    Pen.MAIN: "основной",
    Pen.THIN: "тонкой",
    Pen.FRAME: "рамки",
    Pen.AXIS: "штрихпунктирной",
    Pen.HIDDEN: "штриховой",
    Pen.THICK_AXIS: "утолщённой штрихпунктирной",
    Pen.PHANTOM: "штрихпунктирной с двумя точками",
    Pen.HATCH: "штриховки",
    Pen.BREAK: "обрыва",
    Pen.PALE: "бледной",
}
_LINES = {
    "ru": {
        Pen.HIDDEN: "штриховая линия",
        Pen.AXIS: "штрихпунктирная линия",
        Pen.THICK_AXIS: "утолщённая штрихпунктирная линия",
        Pen.PHANTOM: "штрихпунктирная линия с двумя точками",
    },
    "en": {
        Pen.HIDDEN: "a dashed line",
        Pen.AXIS: "a dash-dot line",
        Pen.THICK_AXIS: "a thick dash-dot line",
        Pen.PHANTOM: "a dash-dot line with two dots",
    },
}
"""Lines with dashes: of these a remark may be made by themselves."""


def thing_text(name: str, lang: str) -> str:
    """Return what an inscription lies on (``stroke main``), or a line by itself (``line axis``)."""
    kind, _, rest = name.partition(" ")
    # The names of pens may have a space, as may what follows them.
    pen = max((p for p in Pen if f"{rest} ".startswith(f"{p.value} ")),
              key=lambda p: len(p.value), default=None)  # fmt: skip
    tag = rest if pen is None else rest[len(pen.value) :].strip()
    told = f" ({tag})" if tag else ""
    if kind == "line":
        assert pen is not None, f"a line without a pen: {name}"
        return _LINES[lang][pen] + told
    if lang == "en":
        return f"a {pen.value if pen else ''} {kind}".replace("  ", " ") + told
    if pen is not None:
        return f"{'линии' if kind == 'stroke' else 'дуге'} ({_PENS_RU[pen]}){told}"
    return ("закрашенной области" if kind == "fill" else "круге") + told
