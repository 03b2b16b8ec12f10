"""Command ``batch``: sheets and keys of all variants, also by a cluster of machines (рассылка)."""

from __future__ import annotations

import contextlib
import json
import threading
from collections import Counter, deque
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

import click
from msgspec import Struct, convert, field
from msgspec.structs import asdict, replace

from planmethod.commands.command import answering, command
from planmethod.commands.problems import (
    AT_ONCE_DRAWN,
    LoadedProblem,
    finish,
    language_of,
    raise_killed,
    run_steps,
)
from planmethod.commands.sheet import SheetOrder, draw
from planmethod.commands.sheet_options import PaperRequest
from planmethod.errors import PlanMethodError
from planmethod.languages import current_language, translate
from planmethod.options import (
    DraftingOptions,
    DrawingOptions,
    FileOptions,
    PlanRequest,
    Positions,
    ProblemChoice,
    UsageError,
    basename,
    format_option,
    jobs_option,
    layout_option,
    option,
    out_option,
    positions_option,
    settings_option,
)

if TYPE_CHECKING:
    from distributed import Client, Future

    from planmethod.check.marks import Settings
    from planmethod.commands.processes import Outcome

NEEDS = "--scheduler needs dask: pip install 'dask[distributed]'"

MANIFEST = "batch.jsonl"
"""Record of the files made and of their inputs, in their folder: a line for each variant."""

PATIENCE = 30
"""For a scheduler and the first of its workers, s."""

QUEUED_CHUNKS = 2
"""Chunks of variants that are sent ahead to each thread of the cluster."""


_Order: TypeAlias = "tuple[VariantOrder, str]"
"""An order, and the hash of its inputs."""

_ONE = threading.Lock()
"""Lock of the working thread of a worker: printed output belongs to the whole process."""


class VariantOrder(Struct, frozen=True):
    """Order for the files of one variant (заказ); it names no file of this machine.

    Attributes
    ----------
    item : LoadedProblem
        The problem.
    sheets : SheetOrder, optional
        Its sheets. Default: none.
    layout : bytes, optional
        Text of the layout file of the sheets.
    settings : Settings, optional
        Of the key. Default: no key.
    lang : str
        Language of messages.
    """

    item: LoadedProblem
    sheets: SheetOrder | None
    layout: bytes | None
    settings: Settings | None
    lang: str


def make_on_worker(order: VariantOrder) -> Outcome[dict[str, bytes]]:
    """Make the files of an order: called on the machines of the cluster."""
    from planmethod.commands.processes import captured

    with _ONE, answering(order.lang):
        return replace(captured(partial(make_files, order)), output="")  # names of files there


def make_chunk_on_worker(orders: Sequence[VariantOrder]) -> list[Outcome[dict[str, bytes]]]:
    """Make the files of a chunk of orders: called on the machines of the cluster."""
    return [make_on_worker(order) for order in orders]


def make_chunk(orders: Sequence[VariantOrder]) -> list[Outcome[dict[str, bytes]]]:
    """Make the files of a chunk of orders: called in the processes of this machine."""
    from planmethod.commands.processes import captured

    return [captured(partial(make_files, order)) for order in orders]


def make_files(order: VariantOrder) -> dict[str, bytes]:
    """Make the files of an order: called in the processes of this machine."""
    from tempfile import TemporaryDirectory

    with TemporaryDirectory(prefix="planmethod-") as name:
        return _files(order, Path(name))


def _files(order: VariantOrder, folder: Path) -> dict[str, bytes]:
    item, out = order.item, folder / "out"
    files: dict[str, bytes] = {}
    if order.sheets is not None:
        sheets = replace(order.sheets, out=out)
        if order.layout is not None:
            layout = folder / "layout.toml"
            layout.write_bytes(order.layout)
            sheets = replace(sheets, request=replace(sheets.request, layout=str(layout)))
        draw(item, sheets)
        files = {path.name: path.read_bytes() for path in sorted(out.iterdir())}
    if order.settings is not None:
        from planmethod.commands.check import key_files, key_of
        from planmethod.note.wording import get_language

        language = get_language(language_of(item.problem, None))
        for ending, data in key_files([key_of(item, order.settings)], language):
            files[f"{basename(item.problem)}-key.{ending}"] = data
    return files


def installed() -> str:
    """Return the version of the package on a machine of the cluster."""
    from importlib.metadata import version

    return version("planmethod")


class BatchOptions(Struct, frozen=True, kw_only=True):
    """Options of ``batch``."""

    choice: ProblemChoice = field(default_factory=ProblemChoice)
    phi: Positions | None = positions_option()
    drafting: DraftingOptions = field(default_factory=DraftingOptions)
    out: Path = out_option()
    formats: tuple[str, ...] = format_option("pdf")
    paper: PaperRequest = field(default_factory=PaperRequest)
    layout: str | None = layout_option()
    drawing: DrawingOptions = field(default_factory=DrawingOptions)
    files: FileOptions = field(default_factory=FileOptions)
    sheets: bool = option(
        "--sheets/--no-sheets", default=True, help="Write the sheets (default) or skip them."
    )
    keys: bool = option(
        "--keys", is_flag=True, help="Also write the key of every variant: PDF and XLSX."
    )
    settings_file: Path | None = settings_option(
        "TOML file with the department's tolerances, points and marks for the keys."
    )
    scheduler: str | None = option(
        "--scheduler",
        metavar="ADDRESS",
        help="Address of a dask scheduler, such as tls://10.0.0.5:8786. Default: --jobs on "
        "this machine.",
    )
    jobs: int = jobs_option()

    def reject_contradictions(self) -> None:
        """Reject options that go without each other.

        Raises
        ------
        click.UsageError
        """
        if not self.sheets and not self.keys:
            raise UsageError("--no-sheets leaves no output: add --keys")
        if self.settings_file is not None and not self.keys:
            raise UsageError("--settings applies to keys: add --keys")
        if self.scheduler is not None and self.jobs > 1:
            raise UsageError("--jobs applies to this machine; --scheduler has its own workers")


@command(BatchOptions)
def batch(options: BatchOptions) -> None:
    """Draw the sheets and keys of every variant, also on many machines; resume an interrupted run.

    Files that the same version wrote from the same problem file and options are not drawn again.
    The machines need planmethod, but no common folder. Anyone with access to their scheduler
    can run programs as you.
    """
    scheduler, layout = options.scheduler, options.layout
    if scheduler is not None:
        try:
            import distributed  # noqa: F401
        except ImportError:
            raise UsageError(NEEDS) from None
    from planmethod.check.marks import DEFAULT, load_settings
    from planmethod.problem.sheet import Config
    from planmethod.render.sheets.composition import composition
    from planmethod.render.sheets.compositions import SHIPPED

    options.reject_contradictions()
    if layout is not None:
        composition(layout)  # its faults are reported once, before any problem is drawn
    settled = options.paper.resolve()
    request = PlanRequest(
        fields=settled.fields,
        phi=options.phi,
        drafting=options.drafting,
        layout=layout,
        drawing=options.drawing,
    )
    # The config file is laid over the problems here.
    own = replace(settled, config=Config())
    sheets = SheetOrder(request, own, options.out, options.formats, options.files)
    settings = None
    if options.keys:
        settings = (
            DEFAULT if options.settings_file is None else load_settings(options.settings_file)
        )
    ordered = partial(
        VariantOrder,
        sheets=sheets if options.sheets else None,
        layout=None if layout is None or layout in SHIPPED else Path(layout).read_bytes(),
        settings=settings,
        lang=current_language(),
    )
    manifest = Manifest(options.out)

    def make_steps(items: list[LoadedProblem]) -> Iterator[Callable[[], None]]:
        twice = [
            name for name, count in Counter(basename(t.problem) for t in items).items() if count > 1
        ]
        if twice:
            raise UsageError(
                "two problems have the name {}, so their files would have the same names; "
                "write them into two folders with --out",
                twice[0],
            )
        orders = []
        for one in items:
            order = ordered(replace(one, problem=settled.over(one.problem)))
            orders.append((order, _hash(order)))
        if all(manifest.has(order, key) for order, key in orders):
            yield from (partial(manifest.count_existing) for _ in orders)
            return
        if scheduler is None:
            yield from _shared(orders, manifest, options.jobs)
            return
        with _cluster(scheduler) as client:
            yield from _sent(client, orders, manifest)

    choice = options.choice
    code = run_steps(
        replace(choice, all_variants=choice.all_variants or choice.variant is None), make_steps
    )
    manifest.close()
    finish(code)


def _hash(order: VariantOrder) -> str:
    """Return the hash of the inputs of files."""
    from planmethod.problem.source import read_source

    one, problem, sheets, phi = order.item, order.item.problem, order.sheets, None
    if sheets is not None:
        request = sheets.request
        phi = None if request.phi is None else request.phi.tolist()
        sheets = replace(sheets, request=replace(request, phi=None), out=Path())
    parts = (
        installed(), read_source(one.path), repr(problem),  # with a table of variants beside it
        sheets, phi, order.layout, order.settings,
    )  # fmt: skip
    return _digest(repr(parts).encode())


# Files there are ---------------------------------------------------------------------------------


class Manifest:
    """Files of a folder and their inputs (ведомость): one line of JSON for each variant.

    A line is added when its files are written; a line cut off by the end of a run is ignored.
    """

    def __init__(self, out: Path) -> None:
        self.out, self.path = out, out / MANIFEST
        self.made, self.existing = 0, 0
        self._lines: dict[str, _Line] = {}
        if self.path.is_file():
            for line in self.path.read_text("utf-8", errors="replace").splitlines():
                with contextlib.suppress(ValueError, RecursionError):  # msgspec's are ValueErrors
                    told = convert(json.loads(line), _Line)
                    self._lines[told.problem] = told

    def has(self, order: VariantOrder, key: str) -> bool:
        """Return whether the files of an order are there as they were made."""
        told = self._lines.get(basename(order.item.problem))
        if told is None or told.key != key:
            return False
        files = [(self.out / Path(name).name, digest) for name, digest in told.files.items()]
        return all(path.is_file() and _digest(path.read_bytes()) == d for path, d in files)

    def count_existing(self) -> None:
        """Count an order whose files exist."""
        self.existing += 1

    def add(self, order: VariantOrder, key: str, files: Mapping[str, bytes]) -> None:
        """Write the files of an order, then its line."""
        from planmethod.render.backends.output import resolve_output_path, write

        for name, data in files.items():
            write(self.out / name, data, output_root=self.out)
            click.echo(str(self.out / name))
        digests = {name: _digest(data) for name, data in files.items()}
        name = basename(order.item.problem)
        told = _Line(name, key, digests)
        self._lines[name] = told
        with resolve_output_path(self.path, output_root=self.out).open(
            "a", encoding="utf-8"
        ) as file:
            file.write("\n" * (not self.made) + _line(told))  # ends a broken line
        self.made += 1

    def close(self) -> None:
        """Write the lines in the order of names, and print the counts."""
        if self.made:
            from planmethod.render.backends.output import write

            lines = (_line(told) for _, told in sorted(self._lines.items()))
            write(self.path, "".join(lines).encode(), output_root=self.out)
        click.echo(translate("{} written, {} existed already.", self.made, self.existing))


class _Line(Struct, frozen=True):
    """Line of the manifest: the record of a variant."""

    problem: str
    key: str
    files: dict[str, str]


def _line(record: _Line) -> str:
    return json.dumps(asdict(record), ensure_ascii=False) + "\n"


def _digest(data: bytes) -> str:
    import hashlib

    return hashlib.sha256(data).hexdigest()


def _shared(orders: list[_Order], manifest: Manifest, jobs: int) -> Iterator[Callable[[], None]]:
    """Yield a callable for each order, made in processes of this machine, without a scheduler."""
    wanted = [order for order, key in orders if not manifest.has(order, key)]
    outcomes = _in_chunks(wanted, jobs)
    for order, key in orders:
        if manifest.has(order, key):
            yield manifest.count_existing
        else:
            outcome = next(outcomes)
            yield partial(_record_files, outcome, order, key, manifest)


def _in_chunks(
    orders: Sequence[VariantOrder], jobs: int
) -> Iterator[Outcome[dict[str, bytes]] | None]:
    """Yield the outcome of every order; a chunk whose process was killed is retried one by one."""
    from planmethod.commands.processes import in_processes, split_into_chunks

    parts = split_into_chunks(orders, jobs, AT_ONCE_DRAWN)
    for part, outcome in zip(parts, in_processes(make_chunk, parts, jobs), strict=True):
        if outcome is not None:
            yield from outcome.result() or ()
        elif len(part) == 1:
            yield None
        else:
            yield from in_processes(make_files, part, jobs)


def _record_files(
    outcome: Outcome[dict[str, bytes]] | None, order: VariantOrder, key: str, manifest: Manifest
) -> None:
    if outcome is None:
        raise_killed(order.item)
    manifest.add(order, key, replace(outcome, output="").result() or {})


# The cluster -------------------------------------------------------------------------------------


@contextlib.contextmanager
def _cluster(scheduler: str) -> Iterator[Client]:
    """Give a cluster with workers of this version."""
    import logging

    from distributed import Client

    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # its errors are reported here
    with contextlib.ExitStack() as open_ones:
        try:
            client = open_ones.enter_context(Client(scheduler, timeout=PATIENCE))
            client.wait_for_workers(1, timeout=PATIENCE)
            versions = client.run(installed)
        except (OSError, TimeoutError, ValueError) as error:
            raise UsageError(
                "--scheduler {}: no worker answers within {} s ({}). Start dask scheduler "
                "and dask worker there.",
                scheduler,
                PATIENCE,
                type(error).__name__,
            ) from None
        except ImportError as error:
            raise UsageError(
                "--scheduler {}: a worker cannot start: {}. Install planmethod and "
                "'dask[distributed]' there.",
                scheduler,
                error,
            ) from None
        others = {address: own for address, own in versions.items() if own != installed()}
        if others:
            address, own = next(iter(others.items()))
            raise UsageError(
                "--scheduler {}: the worker {} has planmethod {}, here it is {}. Install the "
                "same there.",
                scheduler,
                address,
                own,
                installed(),
            )
        yield client


def _sent(client: Client, orders: list[_Order], manifest: Manifest) -> Iterator[Callable[[], None]]:
    """Send orders ahead, and yield a callable that receives each of them, in order."""
    from planmethod.commands.processes import split_into_chunks

    threads = max(1, sum(client.nthreads().values()))
    wanted = [one for one in orders if not manifest.has(*one)]
    ahead: deque[tuple[Sequence[_Order], Future]] = deque()

    def receivers() -> Iterator[Callable[[], None]]:
        for part in split_into_chunks(wanted, threads, AT_ONCE_DRAWN):
            name = _digest("".join(key for _, key in part).encode())
            sent = [order for order, _ in part]
            ahead.append(
                (part, client.submit(make_chunk_on_worker, sent, key=f"planmethod-{name}"))
            )
            if len(ahead) > QUEUED_CHUNKS * threads:
                yield from each_of(*ahead.popleft())
        while ahead:
            yield from each_of(*ahead.popleft())

    def each_of(part: Sequence[_Order], future: Future) -> Iterator[Callable[[], None]]:
        for number, (order, key) in enumerate(part):
            yield partial(_receive, client, future, number, order, key, manifest)

    left, made_ones = {key for _, key in wanted}, receivers()
    for _, key in orders:
        yield next(made_ones) if key in left else manifest.count_existing


def _receive(
    client: Client, future: Future, number: int, order: VariantOrder, key: str, manifest: Manifest
) -> None:
    """Wait for a chunk of orders and record the files of one.

    If the workers of the chunk were killed, each order is sent alone.
    """
    from concurrent.futures import CancelledError

    from distributed import KilledWorker

    name = basename(order.item.problem)
    try:
        try:
            outcome: Outcome[dict[str, bytes]] = future.result()[number]
        except KilledWorker:
            outcome = client.submit(make_on_worker, order, key=f"planmethod-{key}").result()
    except KilledWorker:
        raise PlanMethodError(
            "{}: every worker that processed it was killed; perhaps it needs more memory "
            "than is available. Request fewer positions at once.",
            name,
        ) from None
    except (CancelledError, OSError) as error:
        raise UsageError(
            "the scheduler stopped ({}) before {}; {} are written, and the same command "
            "continues from there",
            type(error).__name__,
            name,
            manifest.made,
        ) from None
    manifest.add(order, key, outcome.result() or {})
