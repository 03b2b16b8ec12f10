"""Variants of a task found by the program: numbers varied, judged, chosen (варианты задания)."""
