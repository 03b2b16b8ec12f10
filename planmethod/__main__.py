"""Launcher of the command line: ``planmethod``, or ``python -m planmethod`` off the PATH."""

from planmethod.process import end_process, settle_process


def main() -> None:
    """Run the command line in this process."""
    settle_process()
    from planmethod.cli import main as run  # with click, in a process that is settled

    run()


def launch() -> None:
    """Run the command line in a process of its own, which ends with it."""
    try:
        main()
    except SystemExit as end:
        end_process(end.code)
        raise


if __name__ == "__main__":
    launch()
