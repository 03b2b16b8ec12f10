"""What processes of the studio do in tests of their limits: a function of a module."""

from __future__ import annotations

import os
import time
from pathlib import Path
from typing import Any


def act(asked: dict[str, Any], tell: Any) -> dict[str, Any]:
    match asked["do"]:
        case "warm":
            return {}
        case "sketched" | "sheets" | "pictured":
            word, _, number = asked["text"].partition(" ")
            if word == "sleep":
                for part in range(10):
                    tell(part / 10)
                    time.sleep(float(number) / 10)
            if word == "hold":  # until there is a file
                while not Path(number).exists():
                    time.sleep(0.01)
            if word == "fill":
                held = [bytearray(1 << 20) for _ in range(int(number))]
                return {"held": len(held)}
            if word == "die":
                os._exit(1)
            return {"said": asked["text"], "process": os.getpid(), "name": asked["name"]}
    raise AssertionError(asked)
