"""The chapter on the cam: its construction with figures and tables (кулачковый механизм)."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from msgspec.structs import replace

from planmethod.cams.construction import construct
from planmethod.cams.design import CamDesign
from planmethod.cams.model import CamProblem
from planmethod.cams.pictures import CamView, diagrams_picture, profile_picture, region_picture
from planmethod.cams.protocol import construction_nodes
from planmethod.cams.sheet import sheet_scales
from planmethod.cams.text import given_facts
from planmethod.note.document import Caption, Chapter, Item, Node, Paragraph, Part, Table
from planmethod.project.report.context import Report, sentences
from planmethod.project.report.figures import figure
from planmethod.render.layout.block import Block


def cam_chapter(report: Report, problem: CamProblem) -> Iterator[Node]:
    """Yield the chapter on the cam."""
    said, language = report.texts["cam"], report.language
    design = CamDesign(problem)
    built = construct(design, sheet_scales(problem))
    yield Chapter(said.title.format())
    facts = given_facts(problem, language)
    about = sentences(said.about.format(facts="; ".join(fact.text for fact in facts)))
    yield replace(about, facts=tuple(facts))
    captions: dict[str, str] = said["figures"]
    names: dict[str, str] = said["tables"]
    keys = iter(_keys(bool(built.results)))

    def drawn(build: Callable[[CamView], Block | None]) -> Callable[[float], Block]:
        def draw(letter: float) -> Block:
            picture = build(CamView(built, language, letter))
            assert picture is not None
            return picture

        return draw

    pictures = {"diagrams": diagrams_picture, "region": region_picture, "profile": profile_picture}
    figures = iter([name for name in pictures if name != "region" or built.results])
    for node in construction_nodes(built, language, report.one.profile):
        match node:
            case Chapter(title):
                yield Part(title)
                name = next(figures, None)
                if name is not None:
                    yield sentences(said.shown.format(key=f"cam_{name}"))
                    yield figure(drawn(pictures[name]), captions[name], f"cam_{name}", height=200.0)
            case Table():
                name = next(keys)
                yield sentences(said.table_text.format(key=f"cam_table_{name}"))
                yield Table(
                    node.head, node.rows, node.names, name=names[name], key=f"cam_table_{name}"
                )  # fmt: skip
            case Caption():
                pass  # the table has a name
            case Item(text):
                yield sentences(text[:1].upper() + text[1:] + ".")
            case Paragraph(text):
                yield sentences(text)
            case _:
                yield node


def _keys(has_region: bool) -> list[str]:
    """Return the names of the tables of a construction, in their order."""
    keys = ["ordinates", "region", "radii", "sizes", "positions"]
    return keys if has_region else [key for key in keys if key != "region"]
