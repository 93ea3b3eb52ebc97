"""Packages whose names load on first use."""

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module


def load_on_use(
    package: str, modules: Mapping[str, Sequence[str]], rooms: Sequence[str] = ()
) -> Callable[[str], object]:
    """Make a package's ``__getattr__``, so that an import loads only what is used.

    Parameters
    ----------
    package : str
        Name of the package, its ``__name__``.
    modules : mapping of str to sequence of str
        Names by the module that holds them.
    rooms : sequence of str
        Public packages inside it, which load on first use, too.

    Returns
    -------
    callable
    """
    homes = {name: module for module, names in modules.items() for name in names}

    def get(name: str) -> object:
        if name in homes:
            return getattr(import_module(homes[name]), name)
        if name in rooms:
            return import_module(f"{package}.{name}")
        message = f"module {package!r} has no attribute {name!r}"
        raise AttributeError(message)

    return get
