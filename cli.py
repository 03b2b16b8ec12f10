"""Launcher of the command line: ``python cli.py sheet PROBLEM``."""

from planmethod.__main__ import launch

if __name__ == "__main__":  # processes at work may import this file
    launch()
