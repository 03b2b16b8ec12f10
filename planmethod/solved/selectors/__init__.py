"""Quantities by the short grammar of ``[published]`` (величины по краткой записи)."""
