"""The interface for programs in Python: mechanisms built, varied and fitted (работа из Python)."""
