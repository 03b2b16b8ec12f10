"""Speed and errors of one's own problem."""
