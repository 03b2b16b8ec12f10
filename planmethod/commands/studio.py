"""Command ``studio``: one page in a browser that does what the commands do."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import click
from msgspec import Struct
from msgspec.structs import replace

from planmethod.commands.command import command
from planmethod.commands.output import bar
from planmethod.languages import translate
from planmethod.options import (
    NumberRange,
    PathType,
    UsageError,
    argument,
    lang_option,
    open_option,
    option,
)

if TYPE_CHECKING:
    from planmethod.studio.server import StudioSettings

LOOPBACK = ("127.0.0.1", "localhost")
NEEDS = "studio needs starlette and uvicorn: pip install starlette uvicorn"
PLACES = 128
"""Maximum number of connections waiting to be accepted."""

LEADING = '<meta http-equiv="refresh" content="0; url={}">'

KEEP_ALIVE = 75
"""Seconds that an idle connection is kept open while a user is typing."""


class StudioOptions(Struct, frozen=True, kw_only=True):
    """Options of ``studio``."""

    file: Path | None = argument(required=False, type=PathType(), metavar="[FILE|FOLDER]")
    host: str = option(
        "--host",
        default="127.0.0.1",
        show_default=True,
        help="Address on which the server listens.",
    )
    port: int = option(
        "--port",
        type=click.IntRange(0, 65535),
        default=8765,
        show_default=True,
        help="Port of the server; 0 for any free one.",
    )
    shown: bool = open_option("Show the page in the browser.")
    served: bool = option(
        "--serve",
        is_flag=True,
        help="Public server: limits of time, memory and size; instructor's pages by a token.",
    )
    seconds: float | None = option(
        "--time",
        type=NumberRange(1.0, 600.0),
        help="Processor time of one computation, s. Default with --serve: 10, and 120 for a "
        "project.",
    )
    jobs: int | None = option(
        "--jobs",
        type=click.IntRange(1, 64),
        help="Number of processes. Default: one for each core.",
    )
    written: Path | None = option(
        "--static",
        type=PathType(),
        metavar="DIR",
        help="Write the studio into a folder for static hosting: Python runs in the browser.",
    )
    runtime: str | None = option(
        "--pyodide",
        metavar="URL|FOLDER",
        help="With --static: address of Pyodide. Default: the official address.",
    )
    lang: str = lang_option()

    def reject_contradictions(self) -> None:
        """Reject what a written page does not take, and what strangers must not get.

        Raises
        ------
        click.UsageError
        """
        if self.written is not None:
            if self.file is not None or self.served or self.shown:
                raise UsageError(
                    "--static writes a page that needs no server: only --pyodide may go with it"
                )
            return
        if self.runtime is not None:
            raise UsageError("--pyodide requires --static")
        if not self.served and self.host not in LOOPBACK:
            raise UsageError(
                "--host {}: without --serve the studio listens only at 127.0.0.1, because "
                "its users can read and write files here. Add --serve.",
                self.host,
            )
        if self.served and self.file is not None:
            raise UsageError("--serve does not publish files of this machine: omit {}", self.file)
        if self.file is not None and not self.file.exists():
            raise UsageError(
                "{}: this file or folder does not exist. planmethod new writes a file.", self.file
            )


@command(StudioOptions)
def studio(options: StudioOptions) -> None:
    """Open the studio: tasks, editor, plans, sheets, answers and checking on one page.

    The studio edits FILE, or the problem files of FOLDER. Without an argument it writes only
    downloads. Press Ctrl+C to stop it. More: docs/how-to/studio.md.
    """
    options.reject_contradictions()
    if options.written is not None:
        _write(options.written, options.runtime, options.lang)
        return
    try:
        import starlette  # noqa: F401
        import uvicorn  # noqa: F401
    except ImportError:
        raise UsageError(NEEDS) from None
    _serve(settings_of(options), options)


def _write(folder: Path, runtime: str | None, lang: str) -> None:
    """Write the page that needs no server."""
    from planmethod.commands.studio_jobs import act
    from planmethod.render.sheets.compositions import SHIPPED
    from planmethod.studio.static_export import VERSION, runtime_of, task_names, write_studio

    try:
        found = runtime_of(runtime)
    except LookupError as error:
        raise UsageError(
            "--pyodide {}: the core of Pyodide is missing: {}. npm pack pyodide@{} contains it.",
            runtime,
            error.args[0],
            VERSION,
        ) from None

    def pictured(file: str) -> str:
        return str(act({"do": "pictured", "file": file, "lang": lang}, lambda share: None)["svg"])

    with bar(len(task_names()), long=True) as done:
        write_studio(folder, found, tuple(SHIPPED), pictured, lang=lang, done=done)
    click.echo(
        translate("{}: the studio. Upload it to static hosting; it opens over http.", folder)
    )


def settings_of(options: StudioOptions) -> StudioSettings:
    """Return the settings with which the studio is started."""
    import os
    import secrets

    from planmethod.render.sheets.compositions import SHIPPED
    from planmethod.studio.requests import LOCAL_LIMITS, PUBLIC_LIMITS
    from planmethod.studio.server import StudioSettings
    from planmethod.studio.sessions import Desk

    served, seconds, file = options.served, options.seconds, options.file
    limits = PUBLIC_LIMITS if served else LOCAL_LIMITS
    if seconds is not None:
        limits = replace(
            limits,
            seconds=seconds,
            slow_seconds=max(seconds, limits.slow_seconds) if served else seconds,
            trusted_seconds=max(seconds, limits.trusted_seconds) if served else seconds,
        )
    return StudioSettings(
        limits=limits,
        served=served,
        token=secrets.token_urlsafe(24),
        processes=options.jobs or max(2, os.cpu_count() or 1),
        desk=None if file is None else Desk(file.resolve()),
        layouts=tuple(SHIPPED),
    )


def _serve(settings: StudioSettings, options: StudioOptions) -> None:
    """Listen until stopped."""
    import os
    import socket

    import uvicorn

    from planmethod.commands.studio_jobs import act
    from planmethod.studio.door import PatientProtocol
    from planmethod.studio.server import application
    from planmethod.studio.sessions import served_folder

    host, port = options.host, options.port
    for name in ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"):  # threads would take the memory
        os.environ.setdefault(name, "1")
    listening = socket.socket(socket.AF_INET6 if ":" in host else socket.AF_INET)
    if os.name != "nt":
        listening.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        listening.bind((host, port))
        listening.listen(PLACES)  # who opens the page at once waits for the first answer
    except OSError as error:
        raise UsageError(
            "--port {} at {}: {}. Give another port, or 0 for any free one.",
            port,
            host,
            error.strerror or error,
        ) from None
    with served_folder() as root, listening:
        address = f"http://{f'[{host}]' if ':' in host else host}:{listening.getsockname()[1]}/"
        own = f"{address}?token={settings.token}"
        click.echo(
            translate("The studio is at {}  Ctrl+C stops it.", address if settings.served else own)
        )
        if settings.served:
            click.echo(translate("Instructor's pages: {}", f"{address}#token={settings.token}"))
        if options.shown:
            click.launch(address if settings.served else str(_leading(root, own)))
        config = uvicorn.Config(
            application(settings, act, root / "sessions"),
            log_level="warning",
            access_log=False,
            server_header=False,
            backlog=PLACES,
            http=PatientProtocol,
            timeout_keep_alive=KEEP_ALIVE,
            timeout_graceful_shutdown=2,
        )
        uvicorn.Server(config).run(sockets=[listening])


def _leading(folder: Path, address: str) -> Path:
    """Write a page that leads to an address, and return where it is.

    What a browser is started with every user of the machine can read; this folder its owner alone.
    """
    from html import escape

    path = folder / "studio.html"
    path.write_text(LEADING.format(escape(address)), "utf-8")
    return path
