"""One combination against every measure."""

from collections.abc import Iterable
from dataclasses import dataclass

from yawdamp_ros.analysis.answers import stack_of
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.measures import MEASURES, NONLINEAR, NONLINEAR_MEASURES, Measure
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.vehicle import Vehicle

THRESHOLDS = (0.05, 1.5)
"""Static rollover thresholds that a road vehicle can have [g]; trucks have 0.25 to 0.6."""


@dataclass(frozen=True)
class Finding:
    """What came out for one measure.

    Attributes
    ----------
    measure : Measure
    speed : float
        At which it was taken, in m/s.
    value : float or None
    passed : bool or None
        Whether it meets its levels; None without a value or a level, or where a level takes a static rollover
        threshold that is not given and no other level is failed.
    reason : str
        Why there is no value; empty where that needs no saying.
    ambiguity : str
        Why the verdict is not sure, or why there is none; empty where it is.
    """

    measure: Measure
    speed: float
    value: float | None
    passed: bool | None
    reason: str = ""
    ambiguity: str = ""

    @property
    def level(self) -> str | None:
        """Levels of the measure as text."""
        return "; ".join(level.text for level in self.measure.levels) or None


def assess(
    vehicle: Vehicle, model: str = "consistent", speed: float | None = None, srt: float | None = None
) -> tuple[Finding, ...]:
    """Take every measure of a vehicle.

    Parameters
    ----------
    vehicle : Vehicle
    model : str
        One of `yawdamp_ros.dynamics.MODELS`, or ``nonlinear``.
    speed : float, optional
        For every measure, in m/s; unless given each is taken at its standard's speed or, where that names
        none, at the vehicle's own.
    srt : float, optional
        Static rollover threshold of the rear roll-coupled unit in g, which this planar model cannot tell.

    Returns
    -------
    tuple of Finding
        In the order of `MEASURES`.

    Raises
    ------
    AnalysisError
        If the threshold is none that a road vehicle can have.
    DynamicsError
        If there is no such model of this vehicle at that speed.
    """
    if srt is not None and not THRESHOLDS[0] <= srt <= THRESHOLDS[1]:
        low, high = THRESHOLDS
        message = f"srt: {srt}: expected a static rollover threshold in g, {low:g} to {high:g} (35 % is 0.35)"
        raise AnalysisError(message)
    find = _find_nonlinear if model == NONLINEAR else _find
    return tuple(find(measure, vehicle, model, speed, srt) for measure in MEASURES.values())


def differences(vehicle: Vehicle, speed: float | None = None) -> tuple[tuple[Finding, Finding], ...]:
    """Take every measure that both models have by the linear and by the nonlinear one.

    Parameters
    ----------
    vehicle : Vehicle
    speed : float, optional
        As for `assess`.

    Returns
    -------
    tuple of (Finding, Finding)
        By `consistent` and by the nonlinear model, each at the manoeuvre of its standard.
    """
    pairs = zip(assess(vehicle, speed=speed), assess(vehicle, NONLINEAR, speed), strict=True)
    return tuple(pair for pair in pairs if pair[0].measure.name in NONLINEAR_MEASURES)


def failed(findings: Iterable[Finding]) -> bool:
    """Whether any level is failed, or met in one reading of an ambiguous measure only."""
    return any(finding.passed is False or bool(finding.ambiguity) for finding in findings)


def _find(measure: Measure, vehicle: Vehicle, model: str, speed: float | None, srt: float | None) -> Finding:
    at = linear_model(vehicle, measure.speed_for(vehicle, speed), model)
    answers = measure.answers(stack_of(at))
    try:
        value = answers.only()
    except AnalysisError as error:
        return Finding(measure, at.speed, None, None, str(error))
    passed = _judge(measure, value, srt)
    if value is None or answers.spans is None:
        return Finding(measure, at.speed, value, passed)
    low, high = answers.spans[0].tolist()
    if {_judge(measure, low, srt), _judge(measure, high, srt)} == {passed}:
        return Finding(measure, at.speed, value, passed)
    ambiguity = f"{measure.name} could be read as {low:.4g} to {high:.4g}, on either side of its level"
    # A pass has to hold however the measure is read.
    return Finding(measure, at.speed, value, False if passed is False else None, "", ambiguity)


def _find_nonlinear(
    measure: Measure, vehicle: Vehicle, _model: str, speed: float | None, srt: float | None
) -> Finding:
    # Numba takes long to import, which no linear assessment waits for.
    from yawdamp_ros.analysis.nonlinear_measures import nonlinear_measure  # noqa: PLC0415

    at = measure.speed_for(vehicle, speed)
    if measure.name not in NONLINEAR_MEASURES:
        return Finding(measure, at, None, None, f"{measure.name} is defined for a linear model")
    try:
        value = nonlinear_measure(measure.name, vehicle, speed)
    except AnalysisError as error:
        return Finding(measure, at, None, None, str(error))
    return Finding(measure, at, value, _judge(measure, value, srt))


def _judge(measure: Measure, value: float | None, srt: float | None) -> bool | None:
    if value is None or not measure.levels:
        return None
    met = [level.met(value, srt) for level in measure.levels]
    return False if False in met else None if None in met else True
