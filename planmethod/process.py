"""A process that lives for one command, set up before the libraries are imported."""

import atexit
import gc
import os
import sys
import threading
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


def end_process(code: object) -> None:
    """End a process that has lived for its command, if nobody needs it any more.

    To take five hundred modules apart costs a twentieth of a short command. Where another thread
    works, or a debugger, a profiler or an interpreter's prompt wants to see the end, it ends as
    any process does, by who called.
    """
    watched = sys.gettrace() or sys.getprofile() or sys.flags.inspect
    if watched or threading.active_count() > 1 or not (code is None or isinstance(code, int)):
        return
    atexit._run_exitfuncs()
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            stream.flush()
    os._exit(code or 0)
