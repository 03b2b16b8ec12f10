"""A process that lives for one command, set up before the libraries are imported."""

import atexit
import gc
import os
import sys
import warnings


def settle_process() -> None:
    """Set up a process that lives for one command and says itself what there is to say."""
    # A command lives a fraction of a second and makes few cycles: to look for them all the time
    # costs a twentieth, and once more at the end a tenth.
    gc.set_threshold(100_000)
    atexit.register(gc.freeze)
    # Its matrices are small: to start threads for them costs a third of the import of NumPy.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    if not sys.warnoptions:  # -W and PYTHONWARNINGS: for who develops it
        warnings.simplefilter("ignore")
