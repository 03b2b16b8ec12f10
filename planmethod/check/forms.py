"""What quantities people mean by what they write: ``v_B3``, ``VB₃``, ``ω3`` (записи величин)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.check.letters import plain
from planmethod.check.questions import Questions
from planmethod.plans.forces.loads import LoadKind
from planmethod.problem.selector import Selector, SelectorError, parse_selector
from planmethod.solved.selected.asking import NoAnswer, UnansweredError


class Forms:
    """Finds quantities by how they may be written: in words of ``[published]``, or in letters."""

    def __init__(self, questions: Questions) -> None:
        self.questions = questions
        self._known: dict[str, Selector] | None = None

    def find(self, text: str) -> Selector:
        """Return the quantity that a text names.

        Raises
        ------
        UnansweredError
        """
        try:
            return parse_selector(text)
        except SelectorError:
            pass
        if self._known is None:
            self._known = known_forms(self.questions)
        if plain(text) not in self._known:
            raise UnansweredError(NoAnswer.NO_WHAT)
        return self._known[plain(text)]


def known_forms(questions: Questions) -> dict[str, Selector]:
    """Return the quantities of a problem by how they may be written, each form as `plain` has it.

    A form that two quantities share names neither.
    """
    found: dict[str, Selector] = {}
    twice: set[str] = set()
    for form, selector in _forms(questions):
        key = plain(form)
        if found.setdefault(key, selector) != selector:
            twice.add(key)
    return {key: selector for key, selector in found.items() if key not in twice}


def _forms(questions: Questions) -> Iterator[tuple[str, Selector]]:
    kin = questions.construction.kinematics
    for name in kin.velocity.named:
        for word in ("v", "a", "vx", "vy", "ax", "ay", "x", "y"):
            yield f"{word}_{name}", Selector(word, (name,))
    for link in questions.solution.problem.mechanism.links:
        for word in ("omega", "epsilon", "phi"):
            yield f"{word}_{link}", Selector(word, (link,))
    for name, pair in questions.pairs():
        for word, letters in (
            ("vs", ("v", "vr", "vs", "vотн")),
            ("ak", ("ak", "acor", "aкор")),
            ("ar", ("ar", "aотн")),
        ):
            for letter in letters:
                yield f"{letter}_{name}", Selector(word, pair)
                yield f"{letter}_{pair[0]}{pair[1]}", Selector(word, pair)
                yield f"{letter}_{pair[1]}{pair[0]}", Selector(word, pair)
                yield f"{letter}_{pair[0]}_{pair[1]}", Selector(word, pair)
    for selector, _, _ in questions.vectors():
        one, two = selector.names
        ways = {"at": ("at", "aτ", "aт"), "an": ("an", "aн")}.get(selector.kind, ("v",))
        for letter in ways:
            yield f"{letter}_{one}{two}", selector
            if selector.kind == "v":
                yield f"{letter}_{two}{one}", selector
    if questions.statics is None:
        return
    for reaction in questions.statics.board.reactions:
        for on, by in ((reaction.on, reaction.by), (reaction.by, reaction.on)):
            for letter in ("F", "R", "Q", f"F_{reaction.joint}"):
                yield f"{letter}_{on}{by}", Selector("F", (on, by))
            if reaction.couple is not None:
                for letter in ("M", f"M_{reaction.joint}"):
                    yield f"{letter}_{on}{by}", Selector("M", (on, by))
    for form in ("M_dr", "F_dr", "balance", "Mур", "Fур", "M_y", "F_y", "Мд"):
        yield form, Selector("balance", ())
    for form in ("M_lever", "F_lever", "lever", "MурЖ", "MЖ"):
        yield form, Selector("lever", ())
    for given in questions.statics.board.given:
        applied = given.applied
        if applied.kind is LoadKind.WEIGHT:
            yield f"G_{applied.link}", Selector("weight", (applied.link,))
        elif applied.kind is LoadKind.INERTIA:
            for letter in ("Φ", "Fи", "Pи", "inertia"):
                yield f"{letter}_{applied.link}", Selector("inertia", (applied.link,))
        elif applied.kind is LoadKind.INERTIA_COUPLE:
            for letter in ("MΦ", "Mи", "inertia couple "):
                yield f"{letter}{applied.link}", Selector("inertia couple", (applied.link,))
        else:
            yield applied.name, Selector("load", (applied.name,))
