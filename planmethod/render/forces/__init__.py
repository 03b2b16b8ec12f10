"""Views of the force analysis: links cut free, force plans, lever (силовой расчёт на листе)."""
