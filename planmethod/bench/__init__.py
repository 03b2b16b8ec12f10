"""Speed beside error of one's own problem."""
