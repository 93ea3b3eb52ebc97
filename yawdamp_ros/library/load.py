"""Runs from disk."""

from pathlib import Path

from yawdamp_ros.library.curves import Curves


def load_run(path: str | Path) -> Curves:
    """Read a run: a directory or MCAP file of the node or of `simulate`, or a CSV file of `simulate`.

    Parameters
    ----------
    path : str or Path

    Returns
    -------
    Curves

    Raises
    ------
    LogError
        If it is no run, or cannot be read.

    Examples
    --------
    >>> import subprocess
    >>> import sys
    >>> command = [sys.executable, "-m", "yawdamp_ros", "simulate", "--manoeuvre", "step", "--duration", "2"]
    >>> _ = subprocess.run([*command, "--output", "run.csv"], capture_output=True, check=True)
    >>> from yawdamp_ros import load_run
    >>> load_run("run.csv")["truck"].yaw_rate.shape
    (2001,)
    """
    # Imported here: each reader loads only with its files.
    from yawdamp_ros.logs import is_recording  # noqa: PLC0415

    place = Path(path)
    if is_recording(place):
        from yawdamp_ros.runs.response_recording import read_response_recording  # noqa: PLC0415

        return Curves.of_response(read_response_recording(place))
    from yawdamp_ros.runs.response_reader import read_response_csv  # noqa: PLC0415

    return Curves.of_response(read_response_csv(place))
