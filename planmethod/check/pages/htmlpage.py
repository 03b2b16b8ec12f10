"""A student's page as one HTML file: no scripts, nothing from outside (лист студента в HTML)."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from planmethod.check.pages.overlay import Overlay, true_plan
from planmethod.check.pages.speech import tagged
from planmethod.check.pages.student import Page
from planmethod.note.wording import Language, Words
from planmethod.plans.model import PlanKind
from planmethod.problem.head import KindProblem
from planmethod.render.backends import render
from planmethod.render.ink.drawing import Fill, Stroke
from planmethod.solved.reading import remembered
from planmethod.solved.solution import Solution

STYLE = """
@page{size:A4;margin:12mm}
*{box-sizing:border-box}
body{font:10pt/1.35 "Segoe UI","Noto Sans","DejaVu Sans",Arial,sans-serif;color:#1b1b1b;
background:#fff;max-width:186mm;margin:0 auto;padding:0 2mm}
h1{font-size:16pt;margin:0}h2{font-size:12pt;margin:4mm 0 1mm;break-after:avoid}
p{margin:1mm 0}.facts{display:flex;flex-wrap:wrap;gap:1mm 7mm;margin:2mm 0;padding:2mm 3mm;
background:#eef2f7;border-radius:1.5mm;font-weight:600}
ul{margin:0;padding-left:5mm}li{margin:.7mm 0}
table{border-collapse:collapse;width:100%;font-size:9pt}
th,td{border:.25mm solid #bbb;padding:.5mm 1.5mm;text-align:left;vertical-align:top}
th{background:#f4f4f4;font-weight:600}td.n{text-align:right;white-space:nowrap}
td:not(:nth-child(6)){white-space:nowrap}
tr{break-inside:avoid}sub,sup{line-height:0}
tr.ok td:nth-child(6),tr.inherited td:nth-child(6){background:#e5f2e7}
tr.near td:nth-child(6),tr.inconsistent td:nth-child(6),tr.unseen td:nth-child(6){
background:#fdf3d3}
tr.wrong td:nth-child(6){background:#fbe3e0;font-weight:600}
tr.blank td:nth-child(6),tr.unreadable td:nth-child(6){background:#ececec}
.note{color:#555;font-size:9pt}.plans{display:flex;flex-wrap:wrap;gap:4mm;align-items:flex-end}
figure{margin:0}section{break-inside:avoid}figcaption{font-size:9pt;text-align:center}
.true [class^=pen]{stroke:#9c9c9c}.true .ink-black{fill:#9c9c9c}.true .text{stroke:#5c5c5c}
.own{fill:none;stroke-width:.6}.right{stroke:#1f5fbf}.off{stroke:#c0271b;stroke-dasharray:2.4 1.2}
.own.head{stroke:none}.right.head{fill:#1f5fbf}.off.head{fill:#c0271b}
.mistaken{stroke-width:.35}
.tag{fill:#fff;stroke:#c0271b;stroke-width:.3}.number{font:600 4px sans-serif;fill:#c0271b;
text-anchor:middle;dominant-baseline:central}
"""


def html_page(page: Page, solution: Solution | KindProblem, words: Language) -> str:
    """Return the page of a student as HTML."""
    return "\n".join(_parts(page, solution, words)) + "\n"


def _parts(page: Page, solution: Solution | KindProblem, words: Language) -> Iterator[str]:
    say: Words = words.check["student"]
    yield f'<!DOCTYPE html>\n<html lang="{page.lang}"><head><meta charset="utf-8">'
    yield '<meta name="viewport" content="width=device-width, initial-scale=1">'
    # What is shown comes from files of strangers: nothing of it may load or run anything.
    yield (
        '<meta http-equiv="Content-Security-Policy" '
        "content=\"default-src 'none'; style-src 'unsafe-inline'\">"
    )
    yield f"<title>{tagged(page.facts[0])}</title><style>{STYLE}</style></head><body>"
    yield f"<h1>{tagged(page.title)}</h1><p>{tagged(page.subtitle)}</p>"
    yield '<div class="facts">' + "".join(f"<span>{tagged(f)}</span>" for f in page.facts)
    yield f"</div><p>{tagged(page.counted)}</p>"
    yield f"<h2>{say.remarks}</h2>" + _listed(page.remarks)
    if page.redraw:
        yield f"<h2>{say.redraw}</h2>" + _listed(page.redraw)
    yield f"<h2>{say.answers}</h2><table><thead><tr>"
    yield "".join(f"<th>{tagged(head)}</th>" for head in say["columns"]) + "</tr></thead><tbody>"
    for line in page.lines:
        cells = "".join(
            f"<td{' class=n' if column in (0, 4) else ''}>{tagged(cell)}</td>"
            for column, cell in enumerate(line.cells)
        )
        yield f'<tr class="{line.verdict.value}">{cells}</tr>'
    yield f'</tbody></table><p class="note">{tagged(page.tolerance)}</p>'
    if isinstance(solution, Solution) and page.plans:
        yield f'<section><h2>{say.plans}</h2><div class="plans">'
        for plan, factor, caption in chain.from_iterable(page.rows()):
            yield f"<figure>{_picture(plan, factor, solution)}"
            yield f"<figcaption>{tagged(caption)}</figcaption></figure>"
        yield f'</div><p class="note">{tagged(page.legend)}</p></section>'
    yield "</body></html>"


def _listed(sentences: tuple[str, ...]) -> str:
    return "<ul>" + "".join(f"<li>{tagged(sentence)}</li>" for sentence in sentences) + "</ul>"


@remembered
def true_svg(solution: Solution, kind: PlanKind, index: int) -> str:
    """Return what is inside the SVG of a plan alone."""
    text = render(true_plan(solution, kind, index)[0], "svg").decode("utf-8")
    start = text.index(">", text.index("<svg")) + 1
    return text[start : text.rindex("</svg>")]


def _picture(plan: Overlay, factor: float, solution: Solution) -> str:
    left, _, _, high = plan.bounds
    width, height = plan.size
    top = plan.drawing.height - high
    own = "".join(_own(plan))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" '
        f'role="img" width="{width * factor:.2f}mm" height="{height * factor:.2f}mm" '
        f'viewBox="{left:.2f} {top:.2f} {width:.2f} {height:.2f}">'
        f'<g class="true">{true_svg(solution, plan.kind, plan.index)}</g>{own}</svg>'
    )


def _own(plan: Overlay) -> Iterator[str]:
    def path(points: tuple[complex, ...]) -> str:
        return "M" + "L".join(f"{p.real:.2f} {plan.drawing.height - p.imag:.2f}" for p in points)

    for own in plan.own:
        kind = "right" if own.is_right else "off" if own.number else "off mistaken"
        for item in own.items():
            if isinstance(item, Stroke):
                yield f'<path class="own {kind}" d="{path(item.points)}"/>'
            elif isinstance(item, Fill):
                yield f'<path class="own head {kind}" d="{path(item.points)}Z"/>'
    for own in plan.own:
        if own.number is not None and not own.is_right:
            at = own.label_at
            x, y = at.real, plan.drawing.height - at.imag
            yield f'<circle class="tag" cx="{x:.2f}" cy="{y:.2f}" r="3"/>'
            yield f'<text class="number" x="{x:.2f}" y="{y:.2f}">{own.number}</text>'
