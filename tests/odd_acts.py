"""Work of the studio's processes in tests of their limits: a function of a module."""

from __future__ import annotations

import os
import signal
import time
from pathlib import Path
from typing import Any


def act(asked: dict[str, Any], tell: Any) -> dict[str, Any]:
    if asked["do"] == "warm":
        return {}
    if asked["do"] == "pictured":
        return {"svg": "<svg/>"}
    word, _, number = asked.get("text", "").partition(" ")
    if word == "sleep":
        time.sleep(float(number))
    if word == "burn":  # seconds of a processor
        began = time.process_time()
        for part in range(10):
            tell(part / 10)
            while time.process_time() - began < float(number) * (part + 1) / 10:
                pass
    if word == "nest":
        deep: list[Any] = []
        for _ in range(10_000):
            deep = [deep]
        return {"deep": deep}
    if word == "hold":  # until there is a file
        while not Path(number).exists():
            time.sleep(0.01)
    if word == "fill":
        held = [bytearray(1 << 20) for _ in range(int(number))]
        return {"held": len(held)}
    if word == "die":
        os._exit(int(number))
    if word == "kill":
        os.kill(os.getpid(), signal.Signals[number])
    return {"said": asked.get("text"), "name": asked.get("name")}
