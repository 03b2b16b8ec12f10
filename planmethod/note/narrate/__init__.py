"""Sentences, equations and formulas that describe a construction (рассказ)."""
