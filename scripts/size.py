"""Lines of code by package, and their budget: ``make size``.

Only lines of ``planmethod/`` that hold code are counted: no blank lines, comments or docstrings.
The budget is in ``budget.toml`` beside this file. Above it a warning is printed, no failure: a
rebuild may need more for a while. A feature that needs more lines raises it, in its own commit.
"""

from __future__ import annotations

import ast
import tokenize
import tomllib
from collections import Counter
from pathlib import Path

ROOT = Path(__file__).parent.parent
PACKAGE = ROOT / "planmethod"
BUDGET = Path(__file__).with_name("budget.toml")

EMPTY = {
    tokenize.COMMENT,
    tokenize.NL,
    tokenize.NEWLINE,
    tokenize.INDENT,
    tokenize.DEDENT,
    tokenize.ENCODING,
    tokenize.ENDMARKER,
}


def code_lines(path: Path) -> int:
    """Return how many lines of a module hold code."""
    with tokenize.open(path) as source:
        text = source.read()
    with path.open("rb") as stream:
        held = {
            line
            for token in tokenize.tokenize(stream.readline)
            if token.type not in EMPTY
            for line in range(token.start[0], token.end[0] + 1)
        }
    for node in ast.walk(ast.parse(text)):
        if not isinstance(node, ast.Expr) or not isinstance(node.value, ast.Constant):
            continue
        if isinstance(node.value.value, str):  # of a module, class, function, or below a constant
            held -= set(range(node.lineno, (node.end_lineno or node.lineno) + 1))
    return len(held)


def main() -> None:
    """Print the table, and a warning where the whole is above its budget."""
    code: Counter[str] = Counter()
    lines: Counter[str] = Counter()
    modules: Counter[str] = Counter()
    for path in sorted(PACKAGE.rglob("*.py")):
        parts = path.relative_to(PACKAGE).parts
        room = parts[0] if len(parts) > 1 else "(top)"
        code[room] += code_lines(path)
        lines[room] += len(path.read_text(encoding="utf-8").splitlines())
        modules[room] += 1
    print(f"{'room':<12}{'code':>8}{'lines':>8}{'modules':>9}")
    for room in sorted(code, key=lambda room: -code[room]):
        print(f"{room:<12}{code[room]:>8}{lines[room]:>8}{modules[room]:>9}")
    whole, budget = code.total(), tomllib.loads(BUDGET.read_text(encoding="utf-8"))["code"]
    print(f"{'all':<12}{whole:>8}{lines.total():>8}{modules.total():>9}")
    if whole > budget:
        print(f"Warning: {whole} lines of code, the budget is {budget}: {BUDGET.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
