"""Executors of a sweep's chunks: this process, all cores, or a cluster."""

import logging
import os
import signal
import threading
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import (
    BrokenExecutor,
    CancelledError,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
)
from contextlib import contextmanager
from functools import partial
from multiprocessing import get_context, parent_process
from typing import Any

from yawdamp_ros.cli.errors import UsageError

Mapped = Callable[..., Iterable[Any]]

WORTHWHILE = 8
"""Chunks for each process: starting one takes as long as working on a few."""

AHEAD = 4
"""Chunks under way for each worker: enough to keep it busy, few enough that answers do not pile up."""

MOST_JOINING = 16
"""Workers that may join a cluster after the start and still find work."""

CONNECT_TIMEOUT = 10.0
"""Timeout for the scheduler's answer [s]."""


@contextmanager
def mapping(
    chunks: int, jobs: int | None, scheduler: str | None, *, threads: bool = False
) -> Iterator[Mapped]:
    """Ordered `map` by an executor.

    It works only a few chunks ahead of the requested answers, so that memory does not grow with
    their number.

    Parameters
    ----------
    chunks : int
        Pieces that the work comes in.
    jobs : int, optional
        Workers, 1 being this process alone; unless given as many as there are cores and as are worthwhile.
    scheduler : str, optional
        Address of a dask.distributed scheduler, whose workers then do the work.
    threads : bool
        Whether the work runs without Python's lock, so that threads of this process do it.

    Yields
    ------
    callable

    Raises
    ------
    UsageError
        If the scheduler cannot be reached, or a worker ends.
    """
    worthwhile = chunks if threads else chunks // WORTHWHILE
    workers = min(jobs, chunks) if jobs else min(os.cpu_count() or 1, worthwhile)
    if scheduler is None and workers <= 1:
        yield map
        return
    with _cluster(scheduler) if scheduler else _pool(workers, threads=threads) as mapped:
        yield mapped


@contextmanager
def _pool(workers: int, *, threads: bool) -> Iterator[Mapped]:
    executor = (
        ThreadPoolExecutor(workers)
        if threads
        # Spawned: a fork of a process with threads, such as those of NumPy's BLAS, can hang.
        else ProcessPoolExecutor(workers, mp_context=get_context("spawn"), initializer=_set_up_worker)
    )
    try:
        yield partial(_in_order, executor.submit, AHEAD * workers)
    except BrokenExecutor as error:
        message = "a worker process ended before its work did; what is written stands"
        raise UsageError(message) from error
    finally:
        # A context manager would wait for chunks that are no longer needed.
        executor.shutdown(wait=True, cancel_futures=True)


def _in_order(
    submit: Callable[..., Any], ahead: int, function: Callable[[Any], Any], items: Iterable[Any]
) -> Iterator[Any]:
    """Results of a function of each item, with a number of items under way."""
    pending: deque[Any] = deque()
    for item in items:
        pending.append(submit(function, item))
        if len(pending) > ahead:
            yield pending.popleft().result()
    while pending:
        yield pending.popleft().result()


def _set_up_worker() -> None:
    # Ctrl-C in a terminal reaches every process: the writing one decides when to stop.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """Exit when the parent dies; pool workers are not notified and would block."""
    parent = parent_process()
    if parent is not None:
        parent.join()
        os._exit(1)


@contextmanager
def _cluster(address: str) -> Iterator[Mapped]:
    from distributed import Client, KilledWorker  # noqa: PLC0415 - an optional library

    # It warns of a chunk that a lost worker takes with it, and computes it again.
    logging.getLogger("distributed.client").setLevel(logging.ERROR)
    try:
        client = Client(address, timeout=CONNECT_TIMEOUT, set_as_default=False)
    except (OSError, ValueError) as error:
        message = (
            f"--scheduler: {address}: cannot be reached; expected a running one, as tcp://127.0.0.1:8786"
        )
        raise UsageError(message) from error
    with client:
        workers = sum(client.nthreads().values())
        try:
            # Not the client's executor: it fetches answers unasked, and reports those that a stop cuts off.
            yield partial(_in_order, partial(client.submit, pure=False), AHEAD * max(workers, MOST_JOINING))
        except (KilledWorker, CancelledError) as error:
            message = f"--scheduler: {address}: lost the work; what is written stands"
            raise UsageError(message) from error
