"""The motion that a cam's follower gives to the driving link of a linkage (привод от кулачка)."""

from __future__ import annotations

from collections.abc import Iterator

from planmethod.cams.model import ArmSense, CamPhase, CamProblem
from planmethod.cams.reader import read_cam
from planmethod.cams.text import motion_facts
from planmethod.note.document import GivenFact
from planmethod.note.wording import Language
from planmethod.problem.file_node import FileNode
from planmethod.problem.model import CamDrive, LawPiece


class CamFollower(CamDrive, frozen=True, kw_only=True):
    """Follower that drives a linkage, with its cam.

    Attributes
    ----------
    cam : CamProblem
    """

    cam: CamProblem

    def given_facts(self, language: Language) -> list[GivenFact]:
        """Return the given facts of the follower's motion: its law."""
        return motion_facts(self.cam, language)


def read_follower_drive(file: FileNode) -> CamDrive:
    """Return the motion that the follower gives the driving link over a turn of the cam."""
    cam = file["cam"]
    problem = CamProblem(name="", **read_cam(cam))
    if not problem.n:
        hint = "Give the speed of the cam that drives, rev/min: n = 120."
        cam["n"].reject("missing", hint=hint)
    return follower_drive(problem)


def follower_drive(problem: CamProblem) -> CamDrive:
    """Return the motion of the follower from its lowest position.

    The displacement of a translating follower grows with the rise; during the rise an oscillating
    one turns in the sense of the cam, or against it.
    """
    size = problem.stroke
    if problem.oscillates:
        size *= problem.mirror * (1 if problem.sense is ArmSense.SAME else -1) / problem.arm
    pieces = tuple(_pieces(problem, size))
    return CamFollower(problem.oscillates, problem.n or 0.0, pieces, cam=problem)


def _pieces(problem: CamProblem, size: float) -> Iterator[LawPiece]:
    """Yield the smooth parts of the turn, the stroke being ``size``."""
    for stretch in problem.stretches:
        law, length = problem.law(stretch.phase), problem.length(stretch.phase)
        if law is None:
            top = size if stretch.phase is CamPhase.UPPER else 0.0
            yield LawPiece(stretch.start, (top,))
            continue
        powers, wave, rate, phase = law.terms(stretch.bit)
        way, first = (size, 0.0) if stretch.phase is CamPhase.RISE else (-size, size)
        lengthened = [way * factor / length**k for k, factor in enumerate(powers)]
        lengthened[0] += first
        yield LawPiece(stretch.start, tuple(lengthened), way * wave, rate / length, phase)
