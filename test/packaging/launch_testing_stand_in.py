"""What launch_testing's pytest plugin does to every test file: it imports it by its base name."""

import sys
from importlib import import_module
from pathlib import Path


def pytest_pycollect_makemodule(module_path: Path) -> None:
    """Import a test file as `launch_testing` does, which is not on PyPI, to look for a launch description."""
    sys.path.insert(0, str(module_path.parent))
    module = import_module(module_path.stem)
    if Path(module.__file__ or "") != module_path:
        message = f"import file mismatch: {module_path} is not {module.__file__}"
        raise ImportError(message)
