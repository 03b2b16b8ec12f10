"""Sentences, equations and formulas that tell a construction (рассказ)."""
