"""Parameters of a vehicle from a recorded drive, by maximum likelihood."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from types import MappingProxyType

import numpy as np

from yawdamp_ros.drives.channel import QUANTITIES, Channel, quantity_of
from yawdamp_ros.drives.comparison import ChannelComparison, compare
from yawdamp_ros.drives.drive import Drive
from yawdamp_ros.drives.errors import DriveError
from yawdamp_ros.drives.likelihood import Fit, Series, maximise
from yawdamp_ros.drives.matching import Match, matches
from yawdamp_ros.drives.parameters import DEFAULT, Parameter, Subject, steered
from yawdamp_ros.drives.prediction import Inputs, inputs_of, predict
from yawdamp_ros.dynamics import MODELS as LINEAR_MODELS
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.vehicle import Vehicle, VehicleSource

Predictor = Callable[[Vehicle, Inputs], Mapping[str, FloatArray]]
"""Outputs of a vehicle under inputs, by name."""

FITTED = ("yaw_rate", "lateral_acceleration", "articulation")
"""Quantities that are fitted; a measured yaw drifts."""
OFFSET_SPREAD: Mapping[str, float] = MappingProxyType(
    {"yaw_rate": 0.01, "lateral_acceleration": 0.3, "articulation": 0.02}
)
"""Standard deviation expected of a sensor's offset; the offset is estimated, too."""
FITTED_SHARE = 2.0 / 3.0
"""Share of the drive that is fitted; the rest checks the result."""
SETTLING = 5.0
"""Time left out at the start [s]: the motion before the drive is unknown."""
QUANTILE = 1.959963984540054
"""Standard errors from the middle of a 95 % interval to its ends."""
SENSOR_OFFSET = "offset of "
"""Prefix of the name of a sensor's offset."""
CLOSE = 0.98
"""Correlation above which two parameters cannot be distinguished."""


@dataclass(frozen=True)
class Estimate:
    """A fitted parameter.

    Attributes
    ----------
    parameter : Parameter
    value : float
    low, high : float
        Ends of the 95 % confidence interval.

    Examples
    --------
    >>> from yawdamp_ros.drives import Estimate, Parameter
    >>> stiffness = Parameter("stiffness", "", start=1.0, scale=0.5, positive=True)
    >>> Estimate(stiffness, value=0.86, low=0.84, high=0.88).seen
    True
    """

    parameter: Parameter
    value: float
    low: float
    high: float

    @property
    def seen(self) -> bool:
        """True if the drive shows the parameter: the interval is narrower than a change that matters."""
        return self.high - self.low <= 2.0 * self.parameter.scale


@dataclass(frozen=True)
class Identification:
    """Parameters of a vehicle, identified from a drive.

    Attributes
    ----------
    estimates : tuple of Estimate
        Requested estimates, then ``offset of <output>`` of every sensor.
    correlations : ndarray, shape (p, p)
        Correlations between the estimates.
    fitted, checked : list of ChannelComparison
        Model and measurement, less the sensors' offsets, on the part that was fitted and on the rest.
    before : list of ChannelComparison
        Comparison on the rest, with the initial parameters.
    noise_order : int
        Order of the autoregression of the residuals.
    overrides : list of str
        Changes to the vehicle file that make it the identified vehicle.
    notes : tuple of str
        Data that was left out, with the reason.

    Examples
    --------
    >>> from yawdamp_ros import load_drive
    >>> from yawdamp_ros.drives import identify
    >>> from yawdamp_ros.vehicle import VehicleSource, vehicle_text
    >>> drive = load_drive("docs/recorded_drive.csv").steered_by(18.0).window(0.0, 12.0)
    >>> source = VehicleSource(vehicle_text("truck_trailer"), ())
    >>> found = identify(drive, source, ["stiffness"])
    >>> len(found.overrides), found.warnings
    (3, [])
    """

    estimates: tuple[Estimate, ...]
    correlations: FloatArray
    fitted: list[ChannelComparison]
    checked: list[ChannelComparison]
    before: list[ChannelComparison]
    noise_order: int
    overrides: list[str]
    notes: tuple[str, ...]

    def __getitem__(self, name: str) -> Estimate:
        """Estimate of a parameter."""
        return next(each for each in self.estimates if each.parameter.name == name)

    @property
    def warnings(self) -> list[str]:
        """Warnings about parameters that the drive does not determine."""
        told = [
            f"{each.parameter.name} cannot be seen in this drive: anything from {each.low:.4g} to "
            f"{each.high:.4g} {each.parameter.unit}".rstrip()
            for each in self.estimates
            if not (each.seen or each.parameter.name.startswith(SENSOR_OFFSET))
        ]
        names = [each.parameter.name for each in self.estimates]
        for row, name in enumerate(names):
            alike = [
                other
                for column, other in enumerate(names)
                if column > row and abs(self.correlations[row, column]) > CLOSE
            ]
            if alike and not name.startswith(SENSOR_OFFSET):
                told.append(f"{name} cannot be told from {', '.join(alike)}: correlations above {CLOSE:g}")
        return told


def predictor_of(model: str) -> Predictor:
    """Predictor of a model.

    Parameters
    ----------
    model : str
        One of `yawdamp_ros.simulation.MODELS`.
    """
    if model in LINEAR_MODELS:
        return partial(predict, model=model)
    # Numba takes long to import, which the linear models do without.
    from yawdamp_ros.drives.nonlinear_prediction import predict_nonlinear  # noqa: PLC0415

    return predict_nonlinear


def identify(  # noqa: PLR0913 - each is one setting of a fit
    drive: Drive,
    source: VehicleSource,
    parameters: Sequence[str] = DEFAULT,
    *,
    speed: float | None = None,
    predictor: Predictor = predict,
    fitted_share: float = FITTED_SHARE,
) -> Identification:
    """Fit parameters of a vehicle to the measurements of a drive.

    Each sensor's offset is estimated with them, with what is known of it (`OFFSET_SPREAD`). The residuals
    are a vector autoregression, fitted in turn with the parameters, so that the intervals hold for
    coloured noise, too. The time by which the steering is late is estimated, too, unless a lag is asked
    for: clocks and filters differ, and steering that holds between samples is half of one late. An
    interval is the wider one of the likelihood's and of one that holds whatever the noise is.

    Parameters
    ----------
    drive : Drive
    source : VehicleSource
        Source of the vehicle.
    parameters : sequence of str
        Names of parameters, as for `Subject`.
    speed : float, optional
        Speed for a drive without one [m/s]; the vehicle's own unless given.
    predictor : callable
        Function that predicts the outputs.
    fitted_share : float
        Share of the drive that is fitted, from its start.

    Returns
    -------
    Identification

    Raises
    ------
    DriveError
        If there is no such parameter, or nothing was measured that it could be fitted to.
    VehicleError
        If the vehicle is none, or a fit leaves the range of a key.

    Examples
    --------
    >>> from yawdamp_ros import load_drive
    >>> from yawdamp_ros.drives import identify
    >>> from yawdamp_ros.vehicle import VehicleSource, vehicle_text
    >>> drive = load_drive("docs/recorded_drive.csv").steered_by(18.0).window(0.0, 12.0)
    >>> source = VehicleSource(vehicle_text("truck_trailer"), ())
    >>> found = identify(drive, source, ["stiffness"])
    >>> bool(found["stiffness"].low < found["stiffness"].value < found["stiffness"].high)
    True
    """
    lagging = {"steering_time_constant", "steering_delay"}.intersection(parameters)
    subject = Subject(source, parameters if lagging else (*parameters, "steering_delay"))
    own = subject.vehicle.speed if speed is None else speed
    times = inputs_of(drive, own).times
    matched, notes = matches(drive, subject.vehicle.unit_names)
    chosen = [match for match in matched if quantity_of(match.output) in FITTED]
    if not chosen:
        message = f"{drive.source}: nothing measured to fit to; expected one of {', '.join(FITTED)}"
        raise DriveError(message)
    start, middle, end = _parts(drive.duration, fitted_share)

    def outputs(values: Mapping[str, float], instants: int | None = None) -> Mapping[str, FloatArray]:
        inputs = steered(inputs_of(drive, own, delay=values.get("steering_delay", 0.0)), values)
        return predictor(subject.vehicle_with(values), Inputs(*(each[:instants] for each in inputs)))

    first = outputs({each.name: each.start for each in subject.parameters})
    if (ended := np.isnan(np.column_stack([*first.values()])).any(axis=1)).any():
        message = (
            f"{drive.source}: the model's motion ends {times[np.argmax(ended)]:.1f} s into the drive, as "
            "by a rollover; expected a drive, or a vehicle to start from, on which it does not"
        )
        raise DriveError(message)
    series = [
        Series(match.output, match.channel.times[kept], match.channel.values[kept])
        for match in chosen
        if (kept := (match.channel.times >= start) & (match.channel.times <= middle)).any()
    ]
    # The motion after the fitted part is not needed for the fit.
    instants = int(np.searchsorted(times, middle)) + 1
    fit = maximise(
        subject.parameters,
        partial(outputs, instants=instants),
        times[:instants],
        series,
        [OFFSET_SPREAD[quantity_of(each.name)] for each in series],
    )
    values = {
        each.name: each.value(at) for each, at in zip(subject.parameters, fit.coordinates, strict=False)
    }
    offsets = dict(zip([each.name for each in series], fit.coordinates[len(values) :], strict=True))
    compared = partial(_compared, chosen, offsets, times)
    found = outputs(values)
    return Identification(
        estimates=_estimates(subject.parameters, series, fit),
        correlations=fit.correlations,
        fitted=compared(found, start, middle),
        checked=compared(found, middle, end),
        before=compared(first, middle, end),
        noise_order=fit.noise_order,
        overrides=subject.overrides(values),
        notes=(*drive.notes, *notes),
    )


def _parts(duration: float, share: float) -> tuple[float, float, float]:
    start = min(SETTLING, 0.2 * duration)
    return start, start + share * (duration - start), duration


def _compared(  # noqa: PLR0913, PLR0917 - what all three parts share comes first
    chosen: Sequence[Match],
    offsets: Mapping[str, float],
    times: FloatArray,
    outputs: Mapping[str, FloatArray],
    start: float,
    end: float,
) -> list[ChannelComparison]:
    if end <= start:
        return []
    parts = [
        Match(match.output, _without(match.channel.window(start, end), offsets.get(match.output, 0.0), start))
        for match in chosen
    ]
    return compare([part for part in parts if len(part.channel.times) > 20], times, outputs)  # noqa: PLR2004


def _without(channel: Channel, offset: float, start: float) -> Channel:
    return replace(channel, times=channel.times + start, values=channel.values - offset)


def _estimates(parameters: Sequence[Parameter], series: Sequence[Series], fit: Fit) -> tuple[Estimate, ...]:
    sensors = [
        Parameter(
            f"{SENSOR_OFFSET}{each.name}",
            QUANTITIES[quantity_of(each.name)],
            0.0,
            OFFSET_SPREAD[quantity_of(each.name)],
            positive=False,
        )
        for each in series
    ]
    estimates = [
        Estimate(
            parameter,
            parameter.value(at),
            parameter.value(at - QUANTILE * error),
            parameter.value(at + QUANTILE * error),
        )
        for parameter, at, error in zip(
            parameters, fit.coordinates.tolist(), fit.errors.tolist(), strict=False
        )
    ]
    rest = slice(len(parameters), None)
    estimates += [
        Estimate(sensor, at, at - QUANTILE * error, at + QUANTILE * error)
        for sensor, at, error in zip(
            sensors, fit.coordinates[rest].tolist(), fit.errors[rest].tolist(), strict=True
        )
    ]
    return tuple(estimates)
