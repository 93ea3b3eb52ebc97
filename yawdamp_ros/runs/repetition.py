"""Results of repeating a run, the same for recordings and CSV files."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.errors import YawdampError
from yawdamp_ros.logs import LogError
from yawdamp_ros.runs.csv_resimulation import QUANTITIES, TOLERANCE, first_mismatch, repeat
from yawdamp_ros.runs.response_reader import read_response_csv

CLOSE = f"{TOLERANCE:.0e} of the motion".replace("e-0", "e-")
"""Promise where bit-identity is not promised."""


@dataclass(frozen=True)
class Difference:
    """First value that differs."""

    where: str
    field: str
    time: float
    recorded: str
    repeated: str


@dataclass(frozen=True)
class Answer:
    """Result of repeating a run: the promise, and whether it holds.

    Attributes
    ----------
    agrees, bit_identical : bool
        Whether the promise holds; whether every value is the same to the last bit.
    promise, reason : str
    duration : float
        Simulated time compared [s].
    samples, values : int
        Number of samples and values compared.
    difference : Difference or None
        First difference.
    warning : str
        Fault of the file that did not prevent reading; else empty.
    """

    agrees: bool
    bit_identical: bool
    promise: str
    reason: str
    duration: float
    samples: int
    values: int
    difference: Difference | None
    warning: str = ""


def repeat_recording(path: Path, progress: Callable[[float], object] = lambda _: None) -> Answer:
    """Repeat a recorded run from its own contents.

    Parameters
    ----------
    path : Path
        Run directory or its MCAP file.
    progress : callable, optional
        Function that receives the simulated time of every sample [s].

    Raises
    ------
    LogError
        If it is no run, or cannot be followed.
    """
    from yawdamp_ros.runs.resimulation import Resimulation  # noqa: PLC0415 - needs ROS's messages

    run = Resimulation(path)
    for time in run.compare():
        progress(time)
    if run.promised:
        reason = f"it was recorded on this kind of machine with this build: {run.build}"
    else:
        reason = f"it was recorded with {run.recorded_build}; this is {run.build}"
    found = run.difference
    return Answer(
        agrees=run.agrees,
        bit_identical=run.bit_identical,
        promise="bit-identical" if run.promised else CLOSE,
        reason=reason,
        duration=run.duration,
        samples=run.samples,
        values=run.values,
        difference=found and Difference(found.topic, found.field, found.time, found.recorded, found.repeated),
        warning=run.warning,
    )


def repeat_csv(path: Path, model: LinearModel) -> Answer:
    """Repeat a CSV file of every step by a model that the file does not name.

    Raises
    ------
    LogError
        If it is no run of that model's vehicle, sampled at every step.
    """
    recorded = read_response_csv(path)
    try:
        repeated = repeat(recorded, model)
    except YawdampError as error:
        raise LogError(path, str(error)) from error
    mismatch = first_mismatch(recorded, repeated, TOLERANCE)
    return Answer(
        agrees=mismatch is None,
        bit_identical=first_mismatch(recorded, repeated, 0.0) is None,
        promise=CLOSE,
        reason="a CSV file does not record its build",
        duration=float(recorded.time[-1]),
        samples=len(recorded.time),
        values=sum(getattr(recorded, quantity).size for quantity in QUANTITIES),
        difference=mismatch
        and Difference(
            f"column {mismatch.column + 1}",
            mismatch.quantity,
            mismatch.time,
            repr(mismatch.recorded),
            repr(mismatch.repeated),
        ),
    )
