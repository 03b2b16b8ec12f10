"""What the norm control says (замечания нормоконтроля): codes, severities, sentences.

Sentences are templates of `str.format` with the same named places in every language; besides its
own places each may name ``place``, ``value`` and ``limit``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from types import MappingProxyType
from typing import TypeAlias

from planmethod.errors import ExitCode, PlanMethodError
from planmethod.paper import FORMATS
from planmethod.render.control.words import thing_text

Segments: TypeAlias = tuple[tuple[str, float], ...]
"""Letters and lengths of segments, mm."""

Facts: TypeAlias = Mapping[str, str | float | Segments]
"""What fills the places of a remark's templates; numbers are written as the language does."""

LANGUAGES = ("ru", "en")


class Severity(StrEnum):
    """How grave a finding is: an error is a fault of the drawing, a warning is advice."""

    ERROR = "error"
    WARNING = "warning"


class UnknownRemarkError(PlanMethodError):
    """A remark was asked for in a language that nobody speaks here (неизвестный язык)."""

    exit_code = ExitCode.USAGE


@dataclass(frozen=True, slots=True)
class Said:
    """A remark in one language.

    ``actions`` is what to do next; where it depends on the finding its fact ``advice`` is the key.
    """

    title: str
    what: str
    actions: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Remark:
    """One code: how grave, in which unit its numbers are, and its sentences by language."""

    severity: Severity
    unit: str
    said: Mapping[str, Said]


def _remark(
    severity: Severity, unit: str, **said: tuple[str, str, str | Mapping[str, str]]
) -> Remark:
    by_language = {}
    for lang, (title, what, action) in said.items():
        actions = {"": action} if isinstance(action, str) else action
        by_language[lang] = Said(title, what, MappingProxyType(dict(actions)))
    return Remark(severity, unit, MappingProxyType(by_language))


_ERROR, _WARNING = Severity.ERROR, Severity.WARNING

REMARKS: Mapping[str, Remark] = MappingProxyType(
    {
        "PM-D01": _remark(
            _ERROR,
            "mm²",
            ru=(
                "надписи перекрываются",
                "«{one}» и «{two}» перекрываются, {place}",
                "Возьмите формат крупнее (--paper) или другой масштаб: надписям нужно место.",
            ),
            en=(
                "inscriptions overlap",
                "'{one}' and '{two}' overlap at {place}",
                "Take a larger format (--paper) or another scale, so that the letters have room.",
            ),
        ),
        "PM-D02": _remark(
            _ERROR,
            "mm",
            ru=(
                "надпись на линии",
                "«{shown}» лежит на {thing}, {place}: {value} мм под надписью",
                "Возьмите формат крупнее (--paper) или другой масштаб: надписям нужно место.",
            ),
            en=(
                "inscription on a line",
                "'{shown}' lies on {thing} at {place}, {value} mm of it",
                "Take a larger format (--paper) or another scale, so that the letters have room.",
            ),
        ),
        "PM-D03": _remark(
            _ERROR,
            "mm",
            ru=(
                "текст вышел из графы",
                "«{shown}» выходит из своей графы на {value} мм, {place}",
                "Сократите текст или возьмите меньший номер шрифта.",
            ),
            en=(
                "text outside its cell",
                "'{shown}' leaves its cell by {value} mm at {place}",
                "Shorten the text, or take smaller letters.",
            ),
        ),
        "PM-D04": _remark(
            _ERROR,
            "mm",
            ru=(
                "текст за рамкой",
                "«{shown}» выходит за рамку на {value} мм, {place}",
                "Возьмите формат крупнее (--paper) или мельче масштаб.",
            ),
            en=(
                "text outside the frame",
                "'{shown}' leaves the frame by {value} mm at {place}",
                "Take a larger format (--paper) or a coarser scale.",
            ),
        ),
        "PM-D05": _remark(
            _ERROR,
            "mm",
            ru=(
                "мелкий шрифт",
                "«{shown}» в надписи «{whole}» высотой {value} мм, меньше {limit} мм, {place}",
                "Возьмите шрифт не мельче {limit} мм; где нет места — формат крупнее.",
            ),
            en=(
                "letters too small",
                "'{shown}' of '{whole}' is {value} mm high, less than {limit} mm, at {place}",
                "Take letters of {limit} mm or more; a larger format where there is no room.",
            ),
        ),
        "PM-D06": _remark(
            _ERROR,
            "",
            ru=(
                "текст сокращён",
                "«{shown}» сокращено, чтобы поместиться в графу, {place}",
                "Напишите в [stamp] или --stamp более короткий текст.",
            ),
            en=(
                "text shortened",
                "'{shown}' was shortened to fit its cell at {place}",
                "Write a shorter text into [stamp] or --stamp.",
            ),
        ),
        "PM-D07": _remark(
            _ERROR,
            "mm",
            ru=(
                "вид за рамкой",
                "линии выходят за рамку на {value} мм, дальше всего {place}",
                "Возьмите мельче масштаб в [scales] или формат крупнее (--paper).",
            ),
            en=(
                "view outside the frame",
                "lines leave the frame by {value} mm, furthest at {place}",
                "Take a coarser scale in [scales] or a larger format (--paper).",
            ),
        ),
        "PM-D08": _remark(
            _WARNING,
            "mm",
            ru=(
                "короткие отрезки плана",
                "отрезки короче {limit} мм: {segments}; первый из них {place}",
                {
                    "": "Возьмите масштаб, в котором план крупнее в {times} раза или больше.",
                    "scale": "Впишите в [scales] {key} = {scale}: отрезки станут не короче "
                    "{limit} мм, и план поместится на {paper}.",
                    "own": "Нужен масштаб {key} = {scale}, но такой план на {paper} не "
                    "помещается: вычертите его отдельно в своём масштабе или возьмите формат "
                    "крупнее (--paper).",
                    "nothing": "В этом положении вектор почти нулевой, и никакой масштаб его не "
                    "покажет: подпишите у плана «≈ 0» или возьмите другое положение (--phi).",
                },
            ),
            en=(
                "short segments of a plan",
                "segments shorter than {limit} mm: {segments}; the first at {place}",
                {
                    "": "Take a scale that draws the plan {times} times larger or more.",
                    "scale": "Write {key} = {scale} into [scales]: the segments are then "
                    "{limit} mm or longer, and the plan fits {paper}.",
                    "own": "It needs the scale {key} = {scale}, but such a plan does not fit "
                    "{paper}: draw it apart at a scale of its own, or take a larger format "
                    "(--paper).",
                    "nothing": "In this position the vector is nearly zero, and no scale shows it: "
                    "write '≈ 0' beside the plan, or take another position (--phi).",
                },
            ),
        ),
        "PM-D09": _remark(
            _ERROR,
            "",
            ru=(
                "нет масштаба",
                "под видом нет надписи масштаба «{scale} = …», {place}",
                "Напишите под названием вида «{scale} = …» с единицей.",
            ),
            en=(
                "no scale inscription",
                "there is no inscription of the scale '{scale} = …' under the view at {place}",
                "Write '{scale} = …' with its unit under the name of the view.",
            ),
        ),
        "PM-D10": _remark(
            _WARNING,
            "%",
            ru=(
                "незаполненное поле",
                "пустой прямоугольник {width} × {height} мм занимает {value} % поля, "
                "середина {place}",
                "Возьмите крупнее масштаб в [scales] или формат меньше (--paper).",
            ),
            en=(
                "unused paper",
                "an empty rectangle of {width} × {height} mm takes {value} % of the field, "
                "its middle at {place}",
                "Take a larger scale in [scales] or a smaller format (--paper).",
            ),
        ),
        "PM-D11": _remark(
            _ERROR,
            "mm",
            ru=(
                "линия кончается промежутком",
                "{thing} не начинается или не кончается штрихом: не хватает {value} мм, {place}",
                "Начните и закончите линию целым штрихом.",
            ),
            en=(
                "a dashed line ends in a gap",
                "{thing} does not begin and end with a stroke, {value} mm are wanting, at {place}",
                "Begin and end the line with a stroke.",
            ),
        ),
        "PM-D12": _remark(
            _WARNING,
            "mm",
            ru=(
                "штрихов не видно",
                "{thing} длиной {value} мм короче {limit} мм и выглядит сплошной, {place}",
                "Возьмите крупнее масштаб или формат либо подпишите, что линия штриховая.",
            ),
            en=(
                "dashes not shown",
                "{thing}, {value} mm long, is shorter than {limit} mm and looks solid, at {place}",
                "Take a larger scale or format, or write beside the line that it is dashed.",
            ),
        ),
        "PM-D13": _remark(
            _ERROR,
            "mm",
            ru=(
                "заходит на графы",
                "линии или надписи заходят на {value} мм в основную надпись или графу 26, {place}",
                "Возьмите мельче масштаб в [scales] или формат крупнее (--paper).",
            ),
            en=(
                "runs into a graph",
                "lines or inscriptions run {value} mm into the title block or graph 26 at {place}",
                "Take a coarser scale in [scales] or a larger format (--paper).",
            ),
        ),
    }
)
"""Every code and what is said of it."""

SEVERITIES = {
    "ru": {_ERROR: "ошибка", _WARNING: "предупреждение"},
    "en": {_ERROR: "error", _WARNING: "warning"},
}

UNITS = {
    "ru": {"mm": "мм", "mm²": "мм²", "%": "%", "": ""},
    "en": {"mm": "mm", "mm²": "mm²", "%": "%", "": ""},
}


def number_text(value: float, lang: str, decimals: int | None = None) -> str:
    """Return a number with the decimal sign of a language."""
    text = f"{value:g}" if decimals is None else f"{value:.{decimals}f}"
    return text.replace(".", ",") if lang == "ru" else text


def limit_text(limit: float, lang: str) -> str:
    """Return a limit, no more than two digits after the decimal sign and no zeros."""
    return number_text(round(limit, 2), lang)


def unlike(value: float, limit: float, lang: str, decimals: int) -> str:
    """Return a number with as many decimals, up to three, as tell it from a limit."""
    while decimals < 3 and round(value, decimals) == round(limit, decimals):
        decimals += 1
    return number_text(value, lang, decimals)


def _said(code: str, lang: str) -> Said:
    if lang not in LANGUAGES:
        known = ", ".join(LANGUAGES)
        raise UnknownRemarkError(f"No remarks in the language {lang!r}. Choose one of: {known}.")
    return REMARKS[code].said[lang]


def place_text(where: complex, lang: str) -> str:
    """Return a place on the sheet: ``(50.0, 50.0) mm``, ``(50,0; 50,0) мм``."""
    x, y = (number_text(part, lang, 1) for part in (where.real, where.imag))
    return f"({x}; {y}) мм" if lang == "ru" else f"({x}, {y}) mm"


def russian_paper(name: str) -> str:
    """Return the name of a format as it is written in Russian: ``А3 (книжная)``."""
    return FORMATS[name].cyrillic + (" (книжная)" if name.endswith(":portrait") else "")


def _fact(fact: str | float | Segments, limit: float, lang: str) -> str:
    if isinstance(fact, str):
        return russian_paper(fact) if lang == "ru" and fact in FORMATS else fact
    if isinstance(fact, tuple):
        mm = UNITS[lang]["mm"]
        return ", ".join(f"{name} {unlike(length, limit, lang, 1)} {mm}" for name, length in fact)
    return number_text(fact, lang)


def _filled(
    template: str, where: complex, value: float, limit: float, facts: Facts, lang: str
) -> str:
    places = {key: _fact(fact, limit, lang) for key, fact in facts.items()}
    if "thing" in places:
        places["thing"] = thing_text(places["thing"], lang)
    places |= {
        "place": place_text(where, lang),
        "value": number_text(value, lang, 2),
        "limit": limit_text(limit, lang),
    }
    return template.format_map(places)


def what(
    code: str, where: complex, value: float, limit: float, facts: Facts, *, lang: str = "en"
) -> str:
    """Return what a finding says, where and with which numbers."""
    return _filled(_said(code, lang).what, where, value, limit, facts, lang)


def action(
    code: str, where: complex, value: float, limit: float, facts: Facts, *, lang: str = "en"
) -> str:
    """Return what to do about a finding."""
    template = _said(code, lang).actions[str(facts.get("advice", ""))]
    return _filled(template, where, value, limit, facts, lang)
