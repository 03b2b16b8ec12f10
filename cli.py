"""Launcher of the command line: ``python cli.py sheet PROBLEM``."""

from planmethod.__main__ import main

if __name__ == "__main__":  # processes at work may import this file
    main()
