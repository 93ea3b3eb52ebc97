"""Compile a function by Numba where there is one; otherwise run it as it is."""

import logging
from collections.abc import Callable
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

    The machine code is cached beside the module, or in the user's cache; where neither can be written, that
    is logged once and every process compiles anew.

    Parameters
    ----------
    function : callable
        Of numbers, arrays and named tuples of these.

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
    if numba is None:
        return function
    try:
        made: Function = numba.njit(cache=True, error_model="numpy")(function)
    except RuntimeError:  # Numba's "no locator available"
        _say_once("numba's cache cannot be written: the nonlinear model is compiled anew in each process")
        made = numba.njit(error_model="numpy")(function)
    return made


_said: set[str] = set()


def _say_once(text: str) -> None:
    if text not in _said:
        _said.add(text)
        LOGGER.warning(text)
