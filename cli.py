"""Launcher of the command line: ``python cli.py sheet PROBLEM``."""

from planmethod.cli import main

main()
