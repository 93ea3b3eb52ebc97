"""A response for notebooks: one unit, a table, a picture."""

from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.runs.outputs import Output, available, columns, quantity
from yawdamp_ros.stepping import Response

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure


class UnitCurves(NamedTuple):
    """Motion of one unit over m samples.

    Attributes
    ----------
    time : ndarray, shape (m,)
        Time [s].
    yaw, yaw_rate, lateral_acceleration, x, y : ndarray, shape (m,)
        Values of the unit [rad, rad/s, m/s^2, m].

    Examples
    --------
    >>> from yawdamp_ros import simulate
    >>> from yawdamp_ros.manoeuvres import Step
    >>> truck = simulate("interlink", Step(amplitude=0.01), 5.0, sample_period=0.01)["truck"]
    >>> float(truck.y[-1].round(2))
    5.26
    """

    time: FloatArray
    yaw: FloatArray
    yaw_rate: FloatArray
    lateral_acceleration: FloatArray
    x: FloatArray
    y: FloatArray


@dataclass(frozen=True)
class Curves(Response):
    """A `Response` that gives a unit by its name, a table and a picture.

    Parameters
    ----------
    unit_names, time, steering_angle, yaw, yaw_rate, lateral_acceleration, articulation, x, y
        As for `Response`.
    extra, events, event_times
        As for `Response`.

    Examples
    --------
    >>> from yawdamp_ros import simulate
    >>> from yawdamp_ros.manoeuvres import LaneChange
    >>> run = simulate("interlink", LaneChange(amplitude=0.02), 5.0, sample_period=0.01)
    >>> float(run["trailer_2"].yaw_rate.max().round(4))
    0.0631
    >>> run.column_units()["articulation_1"]
    'rad'
    """

    @classmethod
    def of_response(cls, response: Response) -> "Curves":
        """The same run.

        Parameters
        ----------
        response : Response
        """
        return cls(**{field.name: getattr(response, field.name) for field in fields(Response)})

    def __getitem__(self, unit: str) -> UnitCurves:
        """Curves of a unit.

        Parameters
        ----------
        unit : str
            One of `unit_names`.

        Raises
        ------
        KeyError
            If there is no such unit.
        """
        if unit not in self.unit_names:
            message = f"{unit!r}: no such unit; expected one of {', '.join(self.unit_names)}"
            raise KeyError(message)
        index = self.unit_names.index(unit)
        return UnitCurves(self.time, *(getattr(self, name)[:, index] for name in UnitCurves._fields[1:]))

    def columns(self) -> dict[str, FloatArray]:
        """Every curve by the name of its column.

        Returns
        -------
        dict of str to ndarray, shape (m,)
            Those of a CSV file but for the time and the speed: ``steering_angle``, ``<unit>/yaw`` and so on,
            ``articulation_1`` onwards, ``<unit>/x``, ``<unit>/y``.
        """
        curves = {
            name: np.reshape(quantity(self, output.name), (len(self.time), -1))[:, index]
            for name, output, index in self._table()
        }
        for index, unit in enumerate(self.unit_names):
            curves |= {f"{unit}/x": self.x[:, index], f"{unit}/y": self.y[:, index]}
        return curves

    def column_units(self) -> dict[str, str]:
        """Unit of measure of every column."""
        known = {name: output.unit for name, output, _ in self._table()}
        return {name: known.get(name, "m") for name in self.columns()}

    def _table(self) -> list[tuple[str, Output, int]]:
        return columns(available(self.extra), self.unit_names)

    def to_dataframe(self) -> "pd.DataFrame":
        """Table of every curve, by the package pandas (the extra ``pandas``).

        Returns
        -------
        pandas.DataFrame
            Indexed by ``time`` in s; ``attrs["units"]`` has the unit of every column.

        Raises
        ------
        ImportError
            If pandas is not installed.
        """
        try:
            import pandas as pd  # noqa: PLC0415 - an extra
        except ImportError as error:
            message = "to_dataframe needs pandas: pip install 'yawdamp_ros[pandas]'"
            raise ImportError(message) from error
        table = pd.DataFrame(self.columns(), index=pd.Index(self.time, name="time"))
        table.attrs["units"] = {"time": "s", **self.column_units()}
        return table

    def plot(self, path: str | Path | None = None) -> "Figure":
        """Draw steering, yaw, yaw rate, lateral acceleration, articulation and paths.

        Parameters
        ----------
        path : str or Path, optional
            PNG or SVG to be written, too.

        Returns
        -------
        matplotlib.figure.Figure

        Raises
        ------
        PictureError
            If there are more units than a picture can distinguish, or the file cannot be written.
        """
        # Imported here: only a drawn run needs the drawing library.
        from yawdamp_ros.pictures import save  # noqa: PLC0415
        from yawdamp_ros.pictures.runs import runs_figure  # noqa: PLC0415

        figure = runs_figure([("run", self)])
        if path is not None:
            save(figure, path)
        return figure
