"""Launcher of the command line: ``planmethod``, or ``python -m planmethod`` off the PATH."""

import atexit
import gc
import os
import sys
import warnings

INTERRUPTED = 130
"""Exit code of a command that was stopped by Ctrl+C."""


def _end(number: int, _frame: object) -> None:
    """End as if the command had ended: temporary folders are removed, and helper processes end."""
    import signal

    signal.signal(number, signal.SIG_IGN)
    raise SystemExit(128 + number)


def main() -> None:
    """Run the command line in a process of its own; Ctrl+C ends it with one line at any time."""
    import signal

    for name in ("SIGTERM", "SIGHUP"):  # Windows has no SIGHUP
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) is signal.SIG_DFL:  # nohup ignores it
            signal.signal(number, _end)
    try:
        _run()
    except KeyboardInterrupt:
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        from planmethod.languages import choose_language, speaking, translate

        with speaking(choose_language(sys.argv[1:])):
            text = translate("Stopped; all written files are complete.")
        sys.stderr.write(f"\n{text}\n")
        sys.exit(INTERRUPTED)


def _run() -> None:
    # A command lives a fraction of a second and makes few cycles: to look for them all the time
    # costs a twentieth, and once more at the end a tenth.
    gc.set_threshold(100_000)
    atexit.register(gc.freeze)
    # Its matrices are small: to start threads for them costs a third of the import of NumPy.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    if not sys.warnoptions:  # -W and PYTHONWARNINGS: for developers
        warnings.simplefilter("ignore")
    os.environ.pop("SOURCE_DATE_EPOCH", None)  # files have no date, whatever a library writes
    from planmethod.cli import main as run  # with click, and NumPy later, in a process set up

    run()


if __name__ == "__main__":
    main()
