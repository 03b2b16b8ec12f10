"""``python -m planmethod``: the command line, where PATH does not lead to it."""

from planmethod.cli import main

main()
