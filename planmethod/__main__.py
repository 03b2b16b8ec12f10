"""Launcher of the command line: ``planmethod``, or ``python -m planmethod`` off the PATH."""

import atexit
import gc
import os
import sys
import warnings


def main() -> None:
    """Run the command line in a process of its own."""
    # A command lives a fraction of a second and makes few cycles: to look for them all the time
    # costs a twentieth, and once more at the end a tenth.
    gc.set_threshold(100_000)
    atexit.register(gc.freeze)
    # Its matrices are small: to start threads for them costs a third of the import of NumPy.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    if not sys.warnoptions:  # -W and PYTHONWARNINGS: for who develops it
        warnings.simplefilter("ignore")
    from planmethod.cli import main as run  # with click, and NumPy later, in a process set up

    run()


if __name__ == "__main__":
    main()
