"""A response for notebooks: one unit, a table, a picture."""

from dataclasses import dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping import Response

if TYPE_CHECKING:
    import pandas as pd
    from matplotlib.figure import Figure

UNIT_QUANTITIES = {"yaw": "rad", "yaw_rate": "rad/s", "lateral_acceleration": "m/s^2", "x": "m", "y": "m"}
"""Quantities of every unit, each with its unit of measure."""


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
        return UnitCurves(self.time, *(getattr(self, name)[:, index] for name in UNIT_QUANTITIES))

    def columns(self) -> dict[str, FloatArray]:
        """Every curve by the name of its column.

        Returns
        -------
        dict of str to ndarray, shape (m,)
            ``steering_angle``, ``<unit>/yaw`` and so on, ``articulation_1`` onwards.
        """
        units = {
            f"{unit}/{name}": getattr(self, name)[:, index]
            for index, unit in enumerate(self.unit_names)
            for name in UNIT_QUANTITIES
        }
        joints = {f"articulation_{joint}": angles for joint, angles in enumerate(self.articulation.T, 1)}
        return {"steering_angle": self.steering_angle, **units, **joints}

    def column_units(self) -> dict[str, str]:
        """Unit of measure of every column."""
        return {name: UNIT_QUANTITIES.get(name.rpartition("/")[2], "rad") for name in self.columns()}

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
