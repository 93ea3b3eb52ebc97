"""Libraries that only some commands need."""

from importlib import import_module
from importlib.util import find_spec
from types import MappingProxyType
from typing import NamedTuple

from yawdamp_ros.cli.errors import UsageError


class Extra(NamedTuple):
    """Source of an optional library.

    Attributes
    ----------
    package : str
        Ubuntu's package; empty if there is none.
    extra : str
        Extra of this package that brings it with pip.
    """

    package: str
    extra: str


EXTRAS = MappingProxyType(
    {
        "matplotlib": Extra("python3-matplotlib", "pictures"),
        "plotly": Extra("python3-plotly", "pictures"),
        "openpyxl": Extra("python3-openpyxl", "tables"),
        "control": Extra("", "analysis"),
        "pyarrow": Extra("", "parquet"),
        "distributed": Extra("python3-distributed", "cluster"),
    }
)


def require(*modules: str) -> None:
    """Refuse to go on without optional libraries, before anything is computed.

    Parameters
    ----------
    *modules : str
        Keys of `EXTRAS`.

    Raises
    ------
    UsageError
        If one is not installed, which the message says how to do, or does not fit the others.
    """
    for module in modules:
        if find_spec(module) is None:
            package, extra = EXTRAS[module]
            apt = f"sudo apt install {package}, or " if package else ""
            message = f"needs {module}, which is not installed: {apt}pip install 'yawdamp_ros[{extra}]'"
            raise UsageError(message)
        try:
            import_module(module)
        except ImportError as error:
            message = f"needs {module}, which cannot be imported: {str(error).partition(chr(10))[0]}"
            raise UsageError(message) from error
