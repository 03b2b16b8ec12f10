"""Requested quantities of a train: U_1_5, U_1_4^H, n_5, W and so on (искомые величины)."""

from __future__ import annotations

from collections.abc import Collection

from msgspec import Struct

from planmethod.languages import translate
from planmethod.note.formula import Rich
from planmethod.problem.names import fold, listed, looks_latin, nearest_name, short

UNLABELLED = ("W", "q")
"""Names without labels."""

COUNTS = {"U": 2, "n": 1, "omega": 1, "z": 1, "r": 1, "v": 1, "a_w": 2, "k": 1, "eta": 0}
"""Quantities and the number of labels of each; ``k`` is the largest number of planets."""

RELATIVE = ("U", "n", "omega")
"""Quantities that can be taken relative to a carrier."""


_GREEK = {"omega": "ω", "eta": "η"}


class RequestedQuantityError(ValueError):
    """The name of a requested quantity cannot be parsed; the message says why."""


class RequestedQuantity(Struct, frozen=True):
    """One quantity of a train (искомая величина)."""

    kind: str
    labels: tuple[str, ...] = ()
    carrier: str | None = None

    @property
    def symbol(self) -> Rich:
        """Symbol: ``U^{(H)}_{14}``, ``n_{5}``, ``ω_{2}``."""
        letter = _GREEK.get(self.kind, self.kind)
        if not self.labels:
            return letter
        index = ("" if all(len(label) == 1 for label in self.labels) else "-").join(self.labels)
        hat = f"^{{({self.carrier})}}" if self.carrier else ""
        return f"a_{{w{index}}}" if self.kind == "a_w" else f"{letter}{hat}_{{{index}}}"


def parse(text: str, known: Collection[str]) -> RequestedQuantity:
    """Parse a name such as ``U_1_4^H``; also ``U_15``, ``n_H_2`` if read in one way only.

    Raises
    ------
    SoughtQuantityError
    """
    name = text.strip().replace("′", "'").replace("’", "'")
    name = fold(name) if looks_latin(name) else name
    if name in UNLABELLED or name == "eta":
        return RequestedQuantity(name)
    whole, hat, carrier = name.partition("^")
    carrier = carrier if carrier in known else carrier.replace("_", "")
    kind = next((k for k in COUNTS if whole.startswith(f"{k}_")), None)
    if kind is None:
        raise RequestedQuantityError(translate("unknown quantity '{}'", short(text)))
    labels = _labels(whole.removeprefix(f"{kind}_"), COUNTS[kind], known)
    if hat and kind not in RELATIVE:
        raise RequestedQuantityError(translate("'{}' is not taken relative to a carrier", kind))
    for label in (*labels, *([carrier] if hat else [])):
        if label not in known:
            guess = nearest_name(label, known)
            hint = (
                translate("the nearest is '{}'", guess)
                if guess
                else translate("known: {}", listed(known))
            )
            raise RequestedQuantityError(
                translate("the train has no '{}' ({})", short(label), hint)
            )
    return RequestedQuantity(kind, labels, carrier if hat else None)


def _labels(text: str, count: int, known: Collection[str]) -> tuple[str, ...]:
    parts = tuple(text.split("_")) if count else ()
    if count and len(parts) != count:  # U_15, n_H_2
        run = "".join(parts)
        cuts = [(run,)] if count == 1 else [(run[:i], run[i:]) for i in range(1, len(run))]
        found = [cut for cut in cuts if all(label in known for label in cut)]
        if len(found) == 1:
            return found[0]
    if len(parts) != count:
        raise RequestedQuantityError(
            translate("expected {} labels with _ between them, got '{}'", count, short(text))
        )
    return parts
