"""One thing about a vehicle over a range."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.vehicle import parse_vehicle, vehicle_text


@dataclass(frozen=True)
class Variation:
    """Keys of a vehicle file that take the same values together.

    Attributes
    ----------
    keys : tuple of str
        Keys, as in overrides.
    values : tuple of float
        Evenly spaced.

    Examples
    --------
    >>> from yawdamp_ros.analysis import Variation
    >>> Variation(("units.1.mass", "units.2.mass"), (1e4, 2e4)).values
    (10000.0, 20000.0)
    """

    keys: tuple[str, ...]
    values: tuple[float, ...]

    @property
    def label(self) -> str:
        """Short text for the axis of a picture."""
        others = len(self.keys) - 1
        return f"{self.keys[0]} (and {others} more)" if others else self.keys[0]

    def models(
        self, vehicle: str | Path, overrides: Sequence[str] = (), model: str = "consistent"
    ) -> Callable[[float], LinearModel]:
        """Linear model as a function of the value that the keys take.

        Parameters
        ----------
        vehicle : str or Path
            As for `load_vehicle`.
        overrides : sequence of str
            Applied before the keys.
        model : str
            One of `yawdamp_ros.dynamics.MODELS`.

        Returns
        -------
        callable
            Function that raises the errors of `parse_vehicle` and `linear_model`.
        """
        text = vehicle_text(vehicle)

        def at(value: float) -> LinearModel:
            varied = [f"{key}={value!r}" for key in self.keys]
            return linear_model(parse_vehicle(text, str(vehicle), [*overrides, *varied]), model=model)

        return at


def parse_variation(text: str) -> Variation:
    """Read ``KEY=A:B:N``: N values from A to B; KEY may be several keys separated by commas.

    Parameters
    ----------
    text : str

    Returns
    -------
    Variation

    Raises
    ------
    AnalysisError
        If the text is not that.

    Examples
    --------
    >>> from yawdamp_ros.analysis import parse_variation
    >>> parse_variation("speed=10:30:3").values
    (10.0, 20.0, 30.0)
    """
    keys, _, span = text.partition("=")
    names = tuple(keys.split(","))
    try:
        first, last, count = span.split(":")
        start, end, number = float(first), float(last), int(count)
    except ValueError as error:
        raise _unreadable(text) from error
    if not (all(names) and math.isfinite(end - start) and start != end and number > 1):
        raise _unreadable(text)
    return Variation(names, tuple(np.linspace(start, end, number).tolist()))


def _unreadable(text: str) -> AnalysisError:
    return AnalysisError(f"{text}: expected KEY=A:B:N, N values (2 or more) from A to B, as in speed=5:35:31")
