"""Location of the package's data files."""

from functools import cache
from pathlib import Path

PACKAGE = "yawdamp_ros"


@cache
def share_directory() -> Path:
    """Directory that holds `config` and `launch`.

    It is found from where the package itself was imported, so that it is right for colcon, pip and a
    source checkout alike, and no environment variable is needed.

    Returns
    -------
    Path
        ``PREFIX/share/yawdamp_ros`` of an installation, or the root of a source checkout.

    Raises
    ------
    FileNotFoundError
        If the data files were not installed with the package.
    """
    package = Path(__file__).resolve().parent
    if (package.parent / "package.xml").is_file():
        return package.parent
    for prefix in package.parents:
        share = prefix / "share" / PACKAGE
        if (share / "config").is_dir():
            return share
    message = f"no share/{PACKAGE} beside {package}: the package's data files are not installed"
    raise FileNotFoundError(message)
