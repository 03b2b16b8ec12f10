"""Random tapes of real operations, and the due value of each operation."""

from __future__ import annotations

import math
import random
from collections.abc import Callable

from doors import Ref, Tape

INPUTS = 3


def drawn(rng: random.Random, tape: Tape, steps: int) -> list[tuple[Ref, Callable[..., float]]]:
    """Draw operations; return each node and its due value."""
    made: list[tuple[Ref, Callable[..., float]]] = [
        (tape.input(k), lambda *values, k=k: values[k]) for k in range(INPUTS)
    ]
    made += [(c, lambda *values, c=c: c) for c in (0.0, 1.0, -1.0, 2.0, 3.0, 0.5)]
    for _ in range(steps):
        (a, f), (b, g) = rng.choice(made), rng.choice(made)
        match rng.choice(("add", "sub", "mul", "div", "neg", "abs", "sqrt", "max", "min")):
            case "add":
                made.append((tape.add(a, b), lambda *v, f=f, g=g: f(*v) + g(*v)))
            case "sub":
                made.append((tape.sub(a, b), lambda *v, f=f, g=g: f(*v) - g(*v)))
            case "mul":
                made.append((tape.mul(a, b), lambda *v, f=f, g=g: f(*v) * g(*v)))
            case "div":
                # A divisor that is not zero: 1 + its absolute value.
                one = tape.add(1.0, tape.abs(b))
                made.append((tape.div(a, one), lambda *v, f=f, g=g: f(*v) / (1.0 + abs(g(*v)))))
            case "neg":
                made.append((tape.neg(a), lambda *v, f=f: -f(*v)))
            case "abs":
                made.append((tape.abs(a), lambda *v, f=f: abs(f(*v))))
            case "sqrt":
                root = tape.add_node("sqrt", tape.abs(a))
                made.append((root, lambda *v, f=f: math.sqrt(abs(f(*v)))))
            case kind:
                pick = max if kind == "max" else min
                node = tape.add_node(kind, a, b)
                made.append((node, lambda *v, f=f, g=g, pick=pick: pick(f(*v), g(*v))))
    return made
