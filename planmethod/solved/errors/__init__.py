"""Errors of hand-drawn plans (погрешности построения)."""
