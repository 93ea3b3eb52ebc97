"""Deviations from recorded values, judged by the size of their motion."""

import re
from collections.abc import Mapping
from typing import NamedTuple

_INDEX = re.compile(r"\[\d+\]")


class Difference(NamedTuple):
    """First mismatch of a run and its repetition.

    Attributes
    ----------
    topic : str
    time : float
        Simulated time [s].
    field : str
        Path of the value in the message.
    recorded, repeated : str
    """

    topic: str
    time: float
    field: str
    recorded: str
    repeated: str


class Deviations:
    """Deviations of a run, judged when the size of the whole motion is known."""

    def __init__(self) -> None:
        # Only a deviation larger than all before can be the first beyond a bound.
        self._rising: dict[str, list[tuple[float, Difference]]] = {}

    @property
    def found(self) -> bool:
        """True if there is any."""
        return bool(self._rising)

    def note(self, topic: str, time: float, field: str, recorded: float, repeated: float) -> None:
        """Add a recorded value and its repetition."""
        deviation = abs(repeated - recorded)
        rising = self._rising.setdefault(quantity(topic, field), [])
        if not rising or not deviation <= rising[-1][0]:  # written so that NaN counts, too
            rising.append((deviation, Difference(topic, time, field, repr(recorded), repr(repeated))))

    def first_beyond(self, tolerance: float, sizes: Mapping[str, float]) -> Difference | None:
        """First value that deviates by more than a share of the size of its quantity.

        Parameters
        ----------
        tolerance : float
        sizes : mapping of str to float
            Largest magnitude over the run by `quantity`.
        """
        beyond = [
            found
            for key, rising in self._rising.items()
            for deviation, found in rising
            if not deviation <= tolerance * sizes.get(key, 0.0)
        ]
        return min(beyond, key=lambda found: found.time, default=None)


def quantity(topic: str, field: str) -> str:
    """Name of a field's quantity, the same for all units and joints: their values have one size."""
    return f"{topic.rsplit('/', 1)[-1]} {_INDEX.sub('', field)}"
