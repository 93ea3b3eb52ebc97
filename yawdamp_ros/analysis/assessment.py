"""One combination against the measures and levels of a scheme."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from enum import Enum

from yawdamp_ros.analysis.answers import stack_of
from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.measures import (
    MEASURES,
    NONLINEAR,
    NONLINEAR_MEASURES,
    VEHICLE_MEASURES,
    Measure,
    VehicleMeasure,
)
from yawdamp_ros.analysis.schemes import DEFAULT_SCHEME, Requirement, Scheme, load_scheme
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.vehicle import Vehicle

THRESHOLDS = (0.05, 1.5)
"""Static rollover thresholds that a road vehicle can have [g]; trucks have 0.25 to 0.6."""
ROLLOVER = ("static_rollover_threshold", "rear_static_rollover_threshold")
"""Measures that a given threshold replaces."""


@dataclass(frozen=True)
class Finding:
    """Result for one measure.

    Attributes
    ----------
    measure : Measure or VehicleMeasure
    speed : float
        Speed at which the measure was taken [m/s].
    value : float or None
    passed : bool or None
        Whether it meets its limits; None without a value or a limit, or where a limit takes a static rollover
        threshold that is not known and no other limit is failed.
    reason : str
        Reason for a missing value; empty if none is needed.
    ambiguity : str
        Reason for an uncertain or a missing verdict; empty for a certain one.
    requirements : tuple of Requirement
        Requirements of the scheme.
    limits : tuple of float or None
        Limit of the chosen level for each requirement; of the easiest level if none is chosen.
    reached : int or None
        Index of the hardest level that it meets.

    Examples
    --------
    >>> from yawdamp_ros import load_vehicle
    >>> from yawdamp_ros.analysis import assess
    >>> findings = assess(load_vehicle("interlink"))
    >>> findings[0].measure.name, findings[0].passed
    ('least_damping_ratio', True)
    """

    measure: Measure | VehicleMeasure
    speed: float
    value: float | None
    passed: bool | None
    reason: str = ""
    ambiguity: str = ""
    requirements: tuple[Requirement, ...] = ()
    limits: tuple[float | None, ...] = ()
    reached: int | None = None

    @property
    def is_off_standard(self) -> bool:
        """True where the measure has a limit, and a speed of its own that is not the one taken."""
        return bool(self.requirements) and self.measure.speed not in {None, self.speed}

    @property
    def level(self) -> str | None:
        """Limits of the scheme as text."""
        return "; ".join(each.text for each in self.requirements) or None


class Verdict(Enum):
    """Verdict on a whole combination.

    Examples
    --------
    >>> Verdict("fail") is Verdict.FAIL
    True
    """

    PASS = "pass"  # noqa: S105 - no password
    FAIL = "fail"
    OPEN = "open"


@dataclass(frozen=True)
class Outcome:
    """Result of an assessment.

    Attributes
    ----------
    verdict : Verdict
        Open where nothing is failed and something is not known, or nothing has a limit.
    reached : str or None
        Hardest level that every measure with a value meets; None where there is none.
    deciding : tuple of str
        Measures that are failed or, where all pass, those that keep it from a harder level.
    unknown : tuple of str
        Measures with a limit that could not be judged.

    Examples
    --------
    >>> from yawdamp_ros.analysis import Outcome, Verdict
    >>> Outcome(Verdict.PASS, reached="level 1", deciding=("tail_swing",), unknown=()).verdict
    <Verdict.PASS: 'pass'>
    """

    verdict: Verdict
    reached: str | None
    deciding: tuple[str, ...]
    unknown: tuple[str, ...]


@dataclass(frozen=True)
class Assessment:
    """Assessment of one vehicle.

    Attributes
    ----------
    vehicle : Vehicle
    model : str
    scheme : Scheme
    level : str or None
        Requested level.
    findings : tuple of Finding

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> vehicle, rtac = load_vehicle("a_double"), load_scheme("rtac")
    >>> Assessment(vehicle, "consistent", rtac, None, assess(vehicle, scheme=rtac)).sentence
    'FAILS rtac; decided by load_transfer_ratio, high_speed_transient_offtracking'
    """

    vehicle: Vehicle
    model: str
    scheme: Scheme
    level: str | None
    findings: tuple[Finding, ...]

    @property
    def outcome(self) -> Outcome:
        """Result of the whole."""
        return outcome(self.findings, self.scheme)

    @property
    def sentence(self) -> str:
        """Verdict on the whole."""
        scheme, found = self.scheme, self.outcome
        asked = f"{scheme.name}, level {self.level}" if self.level else scheme.name
        said = {Verdict.PASS: "meets", Verdict.FAIL: "FAILS", Verdict.OPEN: "meets what is known of"}
        parts = [f"{said[found.verdict]} {asked}"]
        if scheme.levels[0]:
            parts.append(f"level reached: {found.reached or 'none'}")
        if found.deciding:
            parts.append(f"decided by {', '.join(found.deciding)}")
        if found.unknown:
            parts.append(f"not known: {', '.join(found.unknown)}")
        if assuming := [
            finding.measure.name
            for finding in self.findings
            if finding.passed is not None
            and isinstance(finding.measure, VehicleMeasure)
            and finding.measure.assumes
        ]:
            parts.append(f"by assumptions for {', '.join(assuming)}")
        if moved := [each.measure.name for each in self.findings if each.is_off_standard]:
            parts.append(f"not at the speed of the standard: {', '.join(moved)}")
        return "; ".join(parts)


def assess(  # noqa: PLR0913, PLR0917 - each chooses one thing
    vehicle: Vehicle,
    model: str = "consistent",
    speed: float | None = None,
    srt: float | None = None,
    scheme: Scheme | None = None,
    level: str | None = None,
) -> tuple[Finding, ...]:
    """Take the measures of a scheme.

    Parameters
    ----------
    vehicle : Vehicle
    model : str
        One of `yawdamp_ros.dynamics.MODELS`, or ``nonlinear``; for the measures that several models have.
    speed : float, optional
        Speed of every measure whose manoeuvre has none of its own [m/s]. The default is the speed of the
        measure's standard or, without one, the vehicle's own.
    srt : float, optional
        Static rollover threshold in g, in place of the computed one.
    scheme : Scheme, optional
        The linear lateral measures with the limits of PBS and RTAC unless given.
    level : str, optional
        Level of the scheme; the easiest unless given.

    Returns
    -------
    tuple of Finding
        Findings in the order of the scheme.

    Raises
    ------
    AnalysisError
        If the threshold is none that a road vehicle can have, or there is no such level.
    DynamicsError
        If there is no such model of this vehicle at that speed.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> from yawdamp_ros.analysis import load_scheme
    >>> found = assess(load_vehicle("interlink"), scheme=load_scheme("rtac"))
    >>> [finding.measure.name for finding in found if finding.passed][-1]
    'high_speed_transient_offtracking'
    """
    if srt is not None and not THRESHOLDS[0] <= srt <= THRESHOLDS[1]:
        low, high = THRESHOLDS
        message = f"srt: {srt}: expected a static rollover threshold in g, {low:g} to {high:g} (35 % is 0.35)"
        raise AnalysisError(message)
    chosen = load_scheme(DEFAULT_SCHEME) if scheme is None else scheme
    place = None if level is None else chosen.level(level)
    findings, spans = [], {}
    for name in chosen.measures:
        finding, span = _find(name, vehicle, model, speed, srt)
        findings.append(finding)
        if span is not None:
            spans[name] = span
    values = {finding.measure.name: finding.value for finding in findings}
    if srt is not None:
        values.update(dict.fromkeys(ROLLOVER, srt))
    return tuple(
        _judged(replace(finding, requirements=chosen.of(finding.measure.name)), chosen, place, values, spans)
        for finding in findings
    )


def outcome(findings: Iterable[Finding], scheme: Scheme) -> Outcome:
    """Sum up an assessment.

    Parameters
    ----------
    findings : iterable of Finding
        Findings of `assess` for the scheme.
    scheme : Scheme

    Returns
    -------
    Outcome

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> from yawdamp_ros.analysis import load_scheme
    >>> rtac = load_scheme("rtac")
    >>> outcome(assess(load_vehicle("a_double"), scheme=rtac), rtac).verdict
    <Verdict.FAIL: 'fail'>
    """
    judged = [finding for finding in findings if finding.requirements]
    failing = tuple(finding.measure.name for finding in judged if finding.passed is False)
    unknown = tuple(
        finding.measure.name
        for finding in judged
        if finding.passed is None and (finding.value is not None or finding.reason)
    )
    held_to = any(finding.passed for finding in judged)
    verdict = Verdict.FAIL if failing else Verdict.PASS if held_to and not unknown else Verdict.OPEN
    known = [
        finding for finding in judged if finding.value is not None and finding.measure.name not in unknown
    ]
    places = {finding.measure.name: finding.reached for finding in known}
    worst = (
        None if None in places.values() else max((p for p in places.values() if p is not None), default=None)
    )
    held = tuple(name for name, place in places.items() if place == worst and worst)
    return Outcome(verdict, None if worst is None else scheme.levels[worst] or None, failing or held, unknown)


def differences(vehicle: Vehicle, speed: float | None = None) -> tuple[tuple[Finding, Finding], ...]:
    """Take every measure that both models have, by each of them.

    Parameters
    ----------
    vehicle : Vehicle
    speed : float, optional
        As for `assess`.

    Returns
    -------
    tuple of (Finding, Finding)
        Findings by `consistent` and by the nonlinear model, each at the manoeuvre of its standard.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> linear, nonlinear = differences(load_vehicle("single_vehicle"))[0]
    >>> linear.measure.name
    'least_damping_ratio'
    """
    pairs = zip(assess(vehicle, speed=speed), assess(vehicle, NONLINEAR, speed), strict=True)
    return tuple(pair for pair in pairs if pair[0].measure.name in NONLINEAR_MEASURES)


def failed(findings: Iterable[Finding]) -> bool:
    """Return whether a limit is failed, or met only in one reading of an ambiguous measure.

    Parameters
    ----------
    findings : iterable of Finding

    Returns
    -------
    bool

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> failed(assess(load_vehicle("a_double")))
    True
    """
    return any(finding.passed is False or bool(finding.ambiguity) for finding in findings)


def _find(
    name: str, vehicle: Vehicle, model: str, speed: float | None, srt: float | None
) -> tuple[Finding, tuple[float, float] | None]:
    """Value of a measure, and the lowest and highest reading of an ambiguous one."""
    measure = MEASURES[name] if name in MEASURES else VEHICLE_MEASURES[name]
    at = measure.speed_for(vehicle, speed)
    span = None
    try:
        if isinstance(measure, VehicleMeasure):
            value = srt if srt is not None and name in ROLLOVER else measure.value_of(vehicle, at)
        elif model == NONLINEAR:
            value = _nonlinear(name, vehicle, speed)
        else:
            answers = measure.answers(stack_of(linear_model(vehicle, at, model)))
            value = answers.only()
            if value is not None and answers.spans is not None:
                low, high = answers.spans[0].tolist()
                span = low, high
    except AnalysisError as error:
        return Finding(measure, at, None, None, str(error)), None
    return Finding(measure, at, value, None), span


def _nonlinear(name: str, vehicle: Vehicle, speed: float | None) -> float:
    # Numba takes long to import, which no linear assessment waits for.
    from yawdamp_ros.analysis.nonlinear_measures import nonlinear_measure  # noqa: PLC0415

    if name not in NONLINEAR_MEASURES:
        message = f"{name} is defined for a linear model"
        raise AnalysisError(message)
    return nonlinear_measure(name, vehicle, speed)


def _judged(
    finding: Finding,
    scheme: Scheme,
    level: int | None,
    values: Mapping[str, float | None],
    spans: Mapping[str, tuple[float, float]],
) -> Finding:
    """Check a value against its limits."""
    easiest = len(scheme.levels) - 1
    chosen = easiest if level is None else level
    limits = tuple(each.limit(chosen, values) for each in finding.requirements)
    value = finding.value
    if value is None or not finding.requirements:
        return replace(finding, limits=limits)

    def met(reading: float, place: int) -> bool | None:
        found = [each.met(reading, place, values) for each in finding.requirements]
        return False if False in found else None if None in found else True

    reached = next((place for place in range(easiest + 1) if met(value, place)), None)
    passed = met(value, chosen)
    judged = replace(finding, limits=limits, reached=reached, passed=passed)
    span = spans.get(finding.measure.name)
    if span is None or {met(reading, chosen) for reading in span} == {passed}:
        return judged
    low, high = span
    ambiguity = (
        f"{finding.measure.name} could be read as {low:.4g} to {high:.4g}, on either side of its level"
    )
    # A pass has to hold however the measure is read.
    return replace(judged, passed=False if passed is False else None, ambiguity=ambiguity)
