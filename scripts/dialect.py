"""Names and sentences that only the makers of a tool would guess: ``python -m scripts.dialect``.

A definition counts if every word of its name is one of `WORDS`, or a small word: its module must be
open to guess what it is. A sentence counts if it has one of `PATTERNS`, turns of speech for which
plain English has a noun and a verb. The ceilings are in ``budget.toml`` beside this file. If a
count falls, its ceiling must follow (`tests.test_dialect`).
"""

from __future__ import annotations

import ast
import re
import tomllib
from collections.abc import Iterable, Iterator
from pathlib import Path

ROOT = Path(__file__).parent.parent
CEILINGS = Path(__file__).with_name("budget.toml")

_WORDS = """
across ahead alike alone along also another apart aside ask asked asking asks bad bare begin
begins begun beside better beyond bodies bold borne came carried come comes crowded dear deep
doubted doubtful doubts else even excused fair far felt fit fits fitted followed foot found give
given gives gone good had hand hands heard held hold holds honest how judge judged judges
judging just keep keeping keeps kept kin knot knots ladder laid lay let lets lie lies lifted
look looked looks lost made make makes making manner mend mended met moved nearly nobody none
nothing other others own pale plain put refuse refused refuses room rooms said say saying says
see seen sees settle settled settles share shared shares slack speech spoken stand standing
stands stay stayed stays stem still strained take taken takes tell teller telling tells thick
thin thing things today todo together told too touched turned unlike untold want wanted wants
way ways what where who whole whose why within worth yet
"""
_SMALL = """
a after again all and any as at back be before between both by down each every few first for
from has here in is last least left many most new next no not of off on one only or out over
same second several some the then there to two up with
"""
WORDS, SMALL = frozenset(_WORDS.split()), frozenset(_SMALL.split())
PATTERNS = (
    r"\b(is|are|was|be|were) (told|said)\b|\btells?\b|\bsays? so\b",
    r"\b(is|are|was|be|were) asked\b|\basked (for|of)\b|\b(the|what is) asked\b",
    r"(?:^|[.;:(] )Of (?!course\b)[a-z]",
    r"\b(of|by|from|in|than|with|for|at|to) what\b|\bwhat (is|are|stands|follows|goes|cannot)\b",
    r"\b[Ww]ho (asks|reads|adds|takes|needs|gets|has|makes|draws|writes|waits)\b|\b[Ww]hoever\b",
    r"\bnobody\b|\bnothing (is|are|stands|goes|has|tells|fits|hangs)\b|\b(of|is) nothing\b",
    r"\b(is|are) no (?!(longer|more|less|need|such)\b)[a-z]",
    r"\bwithout (it|them)\b|\bwhen absent\b",
    r"\bso many\b",
    r"\b(his|him|he)\b",
    r"\b(stands?|stood) (in|on|at|for|there|beside|still|above|near|alone)\b|\bhangs? (on|at)\b",
    r"\bmend(s|ed|ing)?\b|\banew\b|\bnoughts?\b|\baslant\b|\bhardly\b|\bof ours\b|\bshall\b",
)


def split_words(name: str) -> list[str]:
    """Return the words of a name in lower case."""
    parts = re.findall(r"[A-Z]+(?=[A-Z][a-z])|[A-Z]?[a-z]+|[A-Z]+", name)
    return [part.lower() for part in parts]


def list_definitions() -> Iterator[tuple[Path, int, str]]:
    """Yield file, line and name of every module, class, function, argument, field and constant."""
    for path in sorted((ROOT / "planmethod").rglob("*.py")):
        yield path, 1, path.stem
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.ClassDef | ast.FunctionDef):
                yield path, node.lineno, node.name
            if isinstance(node, ast.FunctionDef):
                for one in (*node.args.args, *node.args.kwonlyargs):
                    if not (node.name.startswith("__") and one.arg == "other"):  # Python's name
                        yield path, one.lineno, one.arg
            if isinstance(node, ast.ClassDef | ast.Module):
                for item in node.body:
                    targets: list[ast.expr] = []
                    if isinstance(item, ast.Assign):
                        targets = item.targets
                    elif isinstance(item, ast.AnnAssign):
                        targets = [item.target]
                    for target in targets:
                        if isinstance(target, ast.Name):
                            yield path, item.lineno, target.id


def list_unclear_names() -> list[str]:
    """Return the definitions whose names have no word of the field."""
    found = []
    for path, line, name in list_definitions():
        words = split_words(name)
        if words and WORDS.intersection(words) and WORDS.union(SMALL).issuperset(words):
            found.append(f"{path.relative_to(ROOT)}:{line}: {name}")
    return found


def list_unclear_sentences() -> list[str]:
    """Return the lines of code, catalogues and tests that have one of the patterns."""
    folders = [ROOT / name for name in ("planmethod", "scripts", "tests")]
    paths = [path for folder in folders for path in folder.rglob("*.py")]
    paths += (ROOT / "planmethod/note/wording/en").rglob("*.toml")
    return list_lines(path for path in paths if path.name != Path(__file__).name)


def list_unclear_lines_of_pages() -> list[str]:
    """Return the lines of the English pages that have one of the patterns."""
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *(ROOT / "docs").rglob("*.md")]
    return list_lines(path for path in pages if "ru" not in path.relative_to(ROOT).parts)


def list_lines(paths: Iterable[Path]) -> list[str]:
    """Return the lines of files that have one of the patterns."""
    pattern = re.compile("|".join(f"(?:{one})" for one in PATTERNS))
    found = []
    for path in sorted(paths):
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
            if pattern.search(line):
                found.append(f"{path.relative_to(ROOT)}:{number}: {line.strip()}")
    return found


KINDS = {
    "names": list_unclear_names,
    "sentences": list_unclear_sentences,
    "pages": list_unclear_lines_of_pages,
}
"""What is counted, by the key of its ceiling."""


def main() -> None:
    """Print every place, and the counts beside their ceilings."""
    ceilings = tomllib.loads(CEILINGS.read_text(encoding="utf-8"))["dialect"]
    for kind, listed in KINDS.items():
        found = listed()
        print(*found, sep="\n")
        print(f"{kind}: {len(found)}, at most {ceilings[kind]}\n")


if __name__ == "__main__":
    main()
