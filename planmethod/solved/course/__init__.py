"""The motion of a whole cycle as polynomials piece by piece (движение за цикл)."""
