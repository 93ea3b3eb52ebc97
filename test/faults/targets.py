"""The readers of files as functions of bytes, each to be fuzzed and to have its corpus replayed."""

import warnings
from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

import numpy as np

from yawdamp_ros.errors import YawdampError
from yawdamp_ros.logs import read_steering_csv, read_steering_mcap
from yawdamp_ros.runs.resimulation import Resimulation
from yawdamp_ros.runs.response_reader import read_response_csv
from yawdamp_ros.runs.response_recording import read_response_recording
from yawdamp_ros.vehicle import load_vehicle

CORPUS = Path(__file__).parent / "corpus"


def _read_mcap(path: Path) -> None:
    _judged(read_steering_mcap, path)
    _judged(read_response_recording, path)


def _resimulate(path: Path) -> None:
    for _ in Resimulation(path).compare():
        pass


TARGETS: Mapping[str, Callable[[Path], object]] = MappingProxyType(
    {
        "steering_csv": read_steering_csv,
        "mcap": _read_mcap,
        "vehicle": load_vehicle,
        "response_csv": read_response_csv,
        "resimulation": _resimulate,
    }
)


def judge(target: str, content: bytes, directory: Path) -> None:
    """Let a target read some bytes; it takes them, or refuses them in one line that names the file."""
    path = directory / "file"
    path.write_bytes(content)
    with warnings.catch_warnings(), np.errstate(all="raise"):
        warnings.simplefilter("error")
        _judged(TARGETS[target], path)
    assert list(directory.iterdir()) == [path]


def _judged(read: Callable[[Path], object], path: Path) -> None:
    try:
        read(path)
    except YawdampError as error:
        said = str(error)
        assert said.isprintable()
        assert said.startswith(f"{path}: ")
        assert len(said) < 10_000
