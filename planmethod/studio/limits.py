"""Limits of requests to the server (пределы)."""

from __future__ import annotations

from msgspec import Struct

MB = 1 << 20

NO_MEMORY = "This takes more memory than is available. Request less."
NESTING_TOO_DEEP = "This is nested too deep to be computed. Request less."
"""Reasons for a missing result, with a server or without."""


class StudioLimits(Struct, frozen=True, kw_only=True):
    """Limits of requests (пределы студии).

    Attributes
    ----------
    seconds, slow_seconds, trusted_seconds : float
        Processor time for one computation; for a note or a project; for a request of an
        instructor.
    memory : int or None
        Address space of a worker process, bytes; if the system can bound it.
    text, upload, uploads : int
        Bytes of a problem file with its request, of one submission, of all those of a session.
    written : int
        Bytes of a file that a computation writes.
    waiting, session_waiting : int
        Computations that wait, of all and of one session.
    works : int
        Maximum number of submissions of a session.
    sessions : int
        Concurrent sessions: a new one replaces the oldest that has no computation.
    idle : float
        Seconds without a request after which a session is deleted.
    stored_results : int
        Computations of a session whose files are kept.
    rate, burst : float
        Computations a second that a session gets in the long run, and at once.
    entries : float
        Sessions a second that one address gets in the long run; ``entered``: at once.
    """

    seconds: float = 10.0
    slow_seconds: float = 120.0
    trusted_seconds: float = 120.0
    memory: int | None = 500 * MB
    text: int = 512 * 1024
    upload: int = 5 * MB
    uploads: int = 20 * MB
    works: int = 2000
    written: int = 64 * MB
    waiting: int = 200
    session_waiting: int = 4
    sessions: int = 500
    idle: float = 2 * 3600.0
    stored_results: int = 6
    rate: float = 4.0
    burst: float = 40.0
    entries: float = 1.0
    entered: float = 120.0


PUBLIC_LIMITS = StudioLimits()
LOCAL_LIMITS = StudioLimits(
    seconds=600.0, slow_seconds=600.0, trusted_seconds=600.0, memory=None, idle=24 * 3600.0,
    rate=50.0,
)  # fmt: skip
"""On one's own machine: its user stops what takes too long."""


class Bucket(Struct):
    """Leaky bucket: a limited burst, and a limited rate in the long run (частота запросов)."""

    level: float = 0.0
    then: float = 0.0

    def admit(self, now: float, *, rate: float, burst: float) -> bool:
        """Take one more at a time, s, unless it is too soon."""
        self.level = max(0.0, self.level - (now - self.then) * rate)
        self.then = now
        if self.level + 1 > burst:
            return False
        self.level += 1
        return True
