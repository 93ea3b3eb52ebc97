"""Where a sweep's chunks are worked on: here, on all cores, or on a cluster."""

import os
import signal
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import BrokenExecutor, CancelledError, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context, parent_process
from typing import Any

from yawdamp_ros.cli.errors import UsageError

Mapped = Callable[..., Iterable[Any]]

WORTHWHILE = 8
"""Chunks for each process: starting one takes as long as working on a few."""

CONNECT_TIMEOUT = 10.0
"""In s, for the scheduler to answer."""


@contextmanager
def mapping(chunks: int, jobs: int | None, scheduler: str | None) -> Iterator[Mapped]:
    """A `map` that is carried out by an executor.

    Parameters
    ----------
    chunks : int
        Pieces that the work comes in.
    jobs : int, optional
        Processes, 1 being this one; unless given as many as there are cores and as are worthwhile.
    scheduler : str, optional
        Address of a dask.distributed scheduler, whose workers then do the work.

    Yields
    ------
    callable

    Raises
    ------
    UsageError
        If the scheduler cannot be reached, or a worker ends.
    """
    processes = min(jobs, chunks) if jobs else min(os.cpu_count() or 1, chunks // WORTHWHILE)
    if scheduler is None and processes <= 1:
        yield map
        return
    with _cluster(scheduler) if scheduler else _pool(processes) as mapped:
        yield mapped


@contextmanager
def _pool(processes: int) -> Iterator[Mapped]:
    # Spawned: a fork of a process that has threads, as NumPy's BLAS does, can hang.
    executor = ProcessPoolExecutor(processes, mp_context=get_context("spawn"), initializer=_set_up_worker)
    try:
        yield executor.map
    except BrokenExecutor as error:
        message = "a worker process ended before its work did; what is written stands"
        raise UsageError(message) from error
    finally:
        # A mere context would wait for chunks that nobody asks for any more.
        executor.shutdown(wait=True, cancel_futures=True)


def _set_up_worker() -> None:
    # A terminal's Ctrl-C reaches every process: the one that writes decides when to stop.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """Of a parent that was killed its workers learn nothing: they would wait for work for ever."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


@contextmanager
def _cluster(address: str) -> Iterator[Mapped]:
    from distributed import Client, KilledWorker  # noqa: PLC0415 - an optional library

    try:
        client = Client(address, timeout=CONNECT_TIMEOUT, set_as_default=False)
    except (OSError, ValueError) as error:
        message = (
            f"--scheduler: {address}: cannot be reached; expected a running one, as tcp://127.0.0.1:8786"
        )
        raise UsageError(message) from error
    with client:
        executor = client.get_executor(pure=False)
        try:
            yield executor.map
        except (KilledWorker, CancelledError) as error:
            message = f"--scheduler: {address}: lost the work; what is written stands"
            raise UsageError(message) from error
        finally:
            executor.shutdown(wait=False)
