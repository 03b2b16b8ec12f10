"""Launcher of the command line: ``planmethod``, or ``python -m planmethod`` off the PATH."""

from planmethod.process import settle_process


def main() -> None:
    """Run the command line in this process."""
    settle_process()
    from planmethod.cli import main as run  # with click, in a process that is settled

    run()


if __name__ == "__main__":
    main()
