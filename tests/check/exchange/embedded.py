"""Reads embedded answers as Moodle does, by a grammar independent of the package's writer."""

from __future__ import annotations

import base64
import html
import re
import xml.etree.ElementTree as ET
from typing import NamedTuple

_FRACTION = r"=|%(-?[0-9]+(?:[.,][0-9]*)?)%"
_ALTERNATIVE = re.compile(
    rf"({_FRACTION})?(.+?(?<!\\)(?<!&)(?<!&amp;)(?=[~#}}]|$))(#(.*?(?<!\\)(?=[~}}]|$)))?", re.S
)
_WHOLE = re.compile(
    r"\{([0-9]*):(NUMERICAL|MULTICHOICE):"
    rf"({_ALTERNATIVE.pattern}(?:~{_ALTERNATIVE.pattern})*)\}}",
    re.S,
)
"""A whole gap. A text that only begins like one stays in the question as it is."""

_START = re.compile(r"\{([0-9]*):(NUMERICAL|MULTICHOICE):", re.S)
_NUMBER = r"-?(?:(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:[eE][-+]?[0-9]+)?)"
_NUMERICAL = re.compile(rf"\A({_NUMBER})(?::({_NUMBER}))?\Z")


class Choice(NamedTuple):
    fraction: float
    answer: str
    value: float
    margin: float
    feedback: str


class Gap(NamedTuple):
    points: int
    kind: str
    choices: list[Choice]

    def grade(self, answer: float) -> tuple[float, str]:
        """The fraction and feedback of the first alternative whose interval holds a number."""
        for one in self.choices:
            slack = 1e-14 * max(one.margin, abs(one.value))
            if abs(answer - one.value) <= one.margin + slack:
                return one.fraction, one.feedback
        return 0.0, ""


class Question(NamedTuple):
    name: str
    text: str
    gaps: list[Gap]
    files: dict[str, bytes]


def gaps_of(text: str) -> tuple[list[Gap], str]:
    """The gaps of a question's text, and the text with {#1}, {#2} in their places."""
    gaps: list[Gap] = []
    while start := _START.search(text):
        at, choices = start.end(), []
        while True:
            match = _ALTERNATIVE.match(text, at)
            assert match, text[start.start() : start.start() + 200]
            fraction = 1.0 if match[1] == "=" else float((match[2] or "0").replace(",", ".")) / 100
            feedback = html.unescape(match[5] or "").replace("\\}", "}").replace("\\#", "#")
            answer, value, margin = match[3], 0.0, 0.0
            if start[2] == "NUMERICAL":
                number = _NUMERICAL.match(answer)
                assert number, answer
                value = float(number[1].replace(",", "."))
                margin = float((number[2] or "0").replace(",", "."))
            answer = html.unescape(answer).replace("\\}", "}").replace("\\#", "#")
            choices.append(Choice(fraction, answer, value, margin, feedback))
            at = match.end()
            if text[at] == "}":
                break
            assert text[at] == "~", text[at : at + 50]
            at += 1
        gaps.append(Gap(int(start[1] or 1), start[2], choices))
        whole = _WHOLE.search(text)
        assert whole and whole.span() == (start.start(), at + 1), "the gap is cut elsewhere"
        assert max(one.fraction for one in choices) == 1.0, "Moodle refuses it"
        assert len({one.answer for one in choices}) > (start[2] == "MULTICHOICE")
        assert all(-1.0 <= one.fraction <= 1.0 and one.answer.strip() for one in choices)
        text = text[: start.start()] + f"{{#{len(gaps)}}}" + text[at + 1 :]
    return gaps, text


def read_quiz(data: bytes) -> dict[str, list[Question]]:
    """The questions of a file by their categories."""
    found: dict[str, list[Question]] = {}
    category = ""
    for node in ET.fromstring(data):
        if node.get("type") == "category":
            category = node.findtext("category/text") or ""
            continue
        assert node.get("type") == "cloze" and {one.tag for one in node} <= {
            "name", "questiontext", "generalfeedback", "penalty", "hidden", "idnumber", "tags",
        }  # fmt: skip
        whole = node.find("questiontext")
        assert whole is not None and whole.get("format") == "html"
        gaps, text = gaps_of(whole.findtext("text") or "")
        left = re.sub(r"\{#[0-9]+\}", "", text)
        assert not re.search(r"[{}]", left), "a brace outside of the gaps"
        assert 0 < len((node.findtext("name/text") or "").strip()) <= 255
        assert [int(one) for one in re.findall(r"\{#([0-9]+)\}", text)] == [
            *range(1, len(gaps) + 1)
        ]
        assert all(one.get("path") == "/" and one.get("name") for one in whole.iter("file"))
        used = set(re.findall(r"@@PLUGINFILE@@/([^\"]+)", text))
        assert used == {one.get("name") for one in whole.iter("file")}
        files = {
            one.get("name") or "": base64.b64decode(one.text or "", validate=True)
            for one in whole.iter("file")
        }
        assert all(one.get("encoding") == "base64" for one in whole.iter("file"))
        found.setdefault(category, []).append(
            Question(node.findtext("name/text") or "", text, gaps, files)
        )
    return found
