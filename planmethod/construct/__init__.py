"""Geometry of a construction: steps, programs, readings; knows no mechanism and no pens."""
