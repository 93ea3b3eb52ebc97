"""Compilation of functions by Numba; without Numba they run uncompiled."""

import hashlib
import logging
import os
from collections.abc import Callable
from functools import cache
from pathlib import Path
from typing import TypeVar

Function = TypeVar("Function", bound=Callable[..., object])

LOGGER = logging.getLogger(__name__)

try:
    import numba
except ImportError:
    numba = None
    LOGGER.warning(
        "numba is not installed: the nonlinear model runs uncompiled, about a hundred times slower"
    )

COMPILED = numba is not None
"""Whether the functions of this room are compiled."""


def compiled(function: Function) -> Function:
    """Compile a function on its first call, keeping floating-point operations in their written order.

    It runs without Python's lock, so that threads can step vehicles in parallel.

    Parameters
    ----------
    function : callable
        Function of numbers, arrays and named tuples of these.

    Returns
    -------
    callable

    Examples
    --------
    >>> @compiled
    ... def twice(value: float) -> float:
    ...     return 2.0 * value
    >>> twice(1.5)
    3.0
    """
    if numba is None or function.__module__ == "__main__":
        return function
    directory = cache_directory()
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = str(directory or "")
    try:
        made: Function = numba.njit(cache=directory is not None, nogil=True, error_model="numpy")(function)
    finally:
        numba.config.CACHE_DIR = before
    return made


@cache
def cache_directory() -> Path | None:
    """Directory that holds the machine code: beside the modules, else in the user's cache.

    Its name holds a digest of this room's sources, for Numba itself does not notice that a function has
    changed which a compiled one calls.

    Returns
    -------
    Path or None
        None if neither can be written; this is logged, and every process compiles again.
    """
    sources = sorted(Path(__file__).parent.glob("*.py"))
    digest = hashlib.sha256(b"\0".join(path.read_bytes() for path in sources)).hexdigest()[:16]
    home = os.environ.get("XDG_CACHE_HOME") or str(Path("~/.cache").expanduser())
    for base in (Path(__file__).parent / "__pycache__", Path(home) / "yawdamp_ros"):
        directory = base / f"numba-{digest}"
        try:
            directory.mkdir(parents=True, exist_ok=True)
        except OSError:
            continue
        if os.access(directory, os.W_OK):
            return directory
    LOGGER.warning(
        "no cache can be written: the nonlinear model is compiled anew in each process, half a minute"
    )
    return None


@cache
def announce_compilation() -> None:
    """Log, once in a process, that the functions are about to be compiled; not where a cache holds them."""
    directory = cache_directory() if COMPILED else None
    if directory is not None and not any(directory.rglob("*.nbi")):
        LOGGER.warning("the nonlinear model is compiled for its first use here: half a minute")
