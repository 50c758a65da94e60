"""Runs and sweeps on the workers of a Dask cluster, in shards that each take some seconds.

Every worker needs this package, of one version. What is computed is what one machine would compute: the same bytes, the
same numbers. Dask itself is installed by `pip install 'hyperstat[dask]'`.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, Optional, Union

import numpy as np

from . import _hyperstat
from ._errors import ArgumentError, MissingError
from ._mechanism import Mechanism, Progress, _json, _path, _reporter, _whole
from ._poses import Poses, columns_of
from ._table import Table, joined

if TYPE_CHECKING:
    from distributed import Client

__all__ = ["JobRun", "run", "sweep"]

# What a shard takes at the most [s], and what is worth one.
_LONG, _SHORT = 5.0, 0.5
# Rows that a shard of a sweep has at the most: what is found of them is some 60 MB.
_MOST_ROWS = 1 << 17


@dataclass(frozen=True)
class JobRun:
    """How a job of a run came out.

    Attributes
    ----------
    rows : int
        Rows of its table.
    failures : dict of int
        How many of them have no result, by their status.
    files : list of Path
        Its table, summary and figures.
    notes : list of str
        What is hardly meant, and figures that could not be drawn.
    """

    rows: int
    failures: dict[str, int]
    files: list[Path]
    notes: list[str]


def run(
    client: Client,
    batch: Union[str, PathLike[str]],
    out: Union[str, PathLike[str]],
    *,
    shards: Optional[int] = None,
    retries: int = 2,
    progress: Progress = False,
    format: Literal["csv", "parquet"] = "csv",
    summary: bool = False,
    pdf: bool = False,
    one_by_one: bool = False,
) -> dict[str, JobRun]:
    """Runs a batch file on the workers of a cluster, as `hyperstat run` does on one machine.

    The shards write to the folder, which all workers see under the same path, and are merged here. What is done stays
    in `out/parts`: the same call goes on from there, whatever ended it.

    Parameters
    ----------
    client : distributed.Client
    batch : path
        Read here alone.
    out : path
        Folder for the results.
    shards : int, optional
        How many; by default as many as take some seconds each.
    retries : int
        How often a shard that failed is tried again. One whose worker died always is, as often as Dask allows it
        (`distributed.scheduler.allowed-failures`).
    progress : bool or callable
        As of `Mechanism.sweep`; rows are those of the longest job.
    format, summary, pdf, one_by_one
        The options of the command.

    Returns
    -------
    dict of JobRun
        By the names of the jobs.

    Raises
    ------
    InputError
        With the place of the first mistake in the batch.
    RunError
        The folder has parts of another run, cannot be written to, or is not the one that the workers see.
    MissingError
        Dask is not installed.
    """
    _check(client)
    if format not in ("csv", "parquet"):
        raise ArgumentError(f"`{format!r}` is no form of tables", help='give "csv" or "parquet"')
    folder = str(Path(_path(out)).absolute())
    options = (format == "parquet", summary, pdf, one_by_one)
    own, rows, seconds = _hyperstat.begin_run(_path(batch), folder, *options)
    count = _count(client, shards, seconds, rows)
    tasks = [(folder, own, k, count) for k in range(count)]
    ends = [rows * (k + 1) // count for k in range(count)]
    for _, unusable in _each(client, _hyperstat.run_share, tasks, ends, retries, progress):
        for told in unusable:
            warnings.warn(f"{told}; its rows were computed again", stacklevel=2)
    merged = _hyperstat.merge_run(folder, own)
    return {
        job: JobRun(rows, dict(failures), files, notes)
        for job, rows, failures, files, notes in merged
    }


def sweep(
    client: Client,
    m: Mechanism,
    poses: Poses,
    loads: Optional[Sequence[Any]] = None,
    *,
    shards: Optional[int] = None,
    retries: int = 2,
    progress: Progress = False,
    one_by_one: bool = False,
    **fields: Any,
) -> Table:
    """Solves a mechanism in many poses on the workers of a cluster.

    Parameters
    ----------
    client : distributed.Client
    m, poses, loads, one_by_one
        As of `Mechanism.sweep`.
    shards, retries
        As of `run`; a shard has at most 131072 rows.
    progress : bool or callable
        As of `Mechanism.sweep`.
    **fields
        `cases`, `columns` and `modes` of `Mechanism.sweep`.

    Returns
    -------
    Table
        That of `m.sweep(poses, ...)`, which fits into the memory here.
    """
    _check(client)
    if not isinstance(m, Mechanism):
        raise ArgumentError(f"`{m!r}` is no mechanism", help="give one, such as `hyperstat.load(path)`")
    unknown = fields.keys() - {"cases", "columns", "modes"}
    if unknown:
        raise ArgumentError(f"there is no argument `{min(unknown)}`", help="give `cases`, `columns` or `modes`")
    fields["loads"] = loads
    names, table = columns_of(poses)
    rows = len(table)
    seconds = _hyperstat.lasts(m._core, (names, table), _json(fields), one_by_one)
    count = max(_count(client, shards, seconds, rows), -(-rows // _MOST_ROWS))
    ends = [rows * (k + 1) // count for k in range(count)]
    # Every shard is of the whole sweep: how a pose is solved follows from all poses. A task that holds them is there
    # again where the worker that had it died.
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", "Sending large graph")
        whole = client.submit(_Sweep, m, dict(zip(names, table.T)), fields, one_by_one, pure=False)
    tasks = [(whole, a, b) for a, b in zip([0, *ends], ends)]
    found: list[Optional[Table]] = [None] * count
    for place, own in _each(client, _swept, tasks, ends, retries, progress):
        found[place] = own
    return joined([own for own in found if own is not None])


@dataclass(frozen=True)
class _Sweep:
    """All that a sweep is of."""

    m: Mechanism
    poses: Poses
    fields: dict[str, Any]
    one_by_one: bool


def _swept(of: _Sweep, start: int, end: int) -> Table:
    return of.m._swept(of.poses, of.fields, None, 1, of.one_by_one, False, (start, end))


def _check(client: Any) -> None:
    """That it is one, and of a Dask that is there."""
    try:
        from distributed import Client
    except ImportError:
        raise MissingError(
            "Dask is not installed", help="pip install 'hyperstat[dask]', on the workers too"
        ) from None
    if not isinstance(client, Client) or client.asynchronous:
        raise ArgumentError(
            f"`{client!r}` is no client of a cluster", help="give a `distributed.Client` that waits for its answers"
        )


def _count(client: Client, shards: Optional[int], seconds: float, rows: int) -> int:
    """Number of shards: each of some seconds, and all threads of the workers have some."""
    if shards is not None:
        if _whole(shards, "shards") < 1:
            raise ArgumentError(f"{shards} shards", help="give at least 1, or leave it out")
        return min(shards, max(rows, 1))
    threads = sum(int(own) for own in client.nthreads().values())
    count = max(math.ceil(seconds / _LONG), min(4 * threads, math.ceil(seconds / _SHORT)))
    return max(1, min(count, rows))


def _each(
    client: Client,
    function: Callable[..., Any],
    tasks: Sequence[tuple[Any, ...]],
    ends: Sequence[int],
    retries: int,
    progress: Progress,
) -> Iterator[tuple[int, Any]]:
    """What the shards return, with their numbers, in the order in which they are done."""
    from distributed import as_completed

    if _whole(retries, "retries") < 0:
        raise ArgumentError(f"{retries} retries", help="0 is none")
    sizes = np.diff([0, *ends])
    call, close = _reporter(progress)
    done = 0
    futures = [client.submit(function, *task, pure=False, retries=retries) for task in tasks]
    places = {future.key: place for place, future in enumerate(futures)}
    try:
        for future in as_completed(futures):
            place = places[future.key]
            found = future.result()
            # Workers need not keep it.
            future.release()
            done += int(sizes[place])
            if call is not None:
                call(done, ends[-1])
            yield place, found
    finally:
        client.cancel(futures)
        close()
