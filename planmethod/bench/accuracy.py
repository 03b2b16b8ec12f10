"""Moved to planmethod.plans.accuracy."""

from planmethod.plans.accuracy import DIGITS, NOTHING, Examined, Verdict, examine

__all__ = ["DIGITS", "NOTHING", "Examined", "Verdict", "examine"]
