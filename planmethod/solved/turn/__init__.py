"""The whole turn of a crank: range, extreme positions, phases, diagrams (цикл движения)."""
