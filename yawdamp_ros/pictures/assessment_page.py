"""An assessment as one HTML page that needs nothing else: styles, script and data are in it."""

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from yawdamp_ros.analysis import (
    MEASURES,
    SAE_J2179,
    AnalysisError,
    Assessment,
    Finding,
    Scheme,
    amplification_at,
    axle_path,
    modes,
    pulse_decay,
    run_lane_change,
    steer_axle_position,
)
from yawdamp_ros.analysis.assessment import ROLLOVER
from yawdamp_ros.analysis.engineering import SI, converted
from yawdamp_ros.analysis.schemes import DEFAULT_SCHEME, SIGNS
from yawdamp_ros.analysis.yaw_damping import PULSE_WIDTH
from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.pictures.assessment_data import differing, side_view, turn_view, vehicle_tables
from yawdamp_ros.pictures.measure_charts import measure_charts
from yawdamp_ros.pictures.page import page_text
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Unit, Vehicle

OVERHANG = 1.1
"""Overhang of a unit's drawn outline past its outermost axle or hitch [m]."""

LARGEST_YAW = 0.22
"""Largest yaw of a unit in the picture of a mode [rad]."""

EVERY = 8
"""Samples of the lane change from one frame to the next."""

MOST_ROLL = 0.35
"""Largest mean roll of the curves of static roll [rad]."""

NOISE = 1e-9
"""Magnitude below which a value counts as rounding and is shown as 0."""

_SHOWN_DECAY, _POINTS = 0.002, 400


class Heading(NamedTuple):
    """Project, author and date of a page.

    Attributes
    ----------
    project, author, date : str
        Project, author and date; empty ones are left out.

    Examples
    --------
    >>> Heading(project="Bulk haul").author
    ''
    """

    project: str = ""
    author: str = ""
    date: str = ""


def assessment_page(
    assessments: Sequence[Assessment], heading: Heading | None = None, units: str = SI
) -> str:
    """HTML text of an assessment of one vehicle, or of several side by side.

    Parameters
    ----------
    assessments : sequence of Assessment
        Assessments by one scheme and one linear model. The first gives the lane change, curves and modes.
    heading : Heading, optional
    units : str
        One of `yawdamp_ros.analysis.engineering.SYSTEMS`.

    Returns
    -------
    str

    Examples
    --------
    >>> from yawdamp_ros.analysis import assess, load_scheme
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> vehicle, rtac = load_vehicle("interlink"), load_scheme("rtac")
    >>> page = assessment_page([Assessment(vehicle, "consistent", rtac, None, assess(vehicle, scheme=rtac))])
    >>> page.startswith("<!DOCTYPE html>")
    True
    """
    first, several = assessments[0], len(assessments) > 1
    vehicle, model, findings = first.vehicle, first.model, first.findings
    found = {finding.measure.name: finding for finding in findings}

    def speed_of(name: str) -> float:
        return found[name].speed if name in found else MEASURES[name].speed_for(vehicle)

    names = ", ".join(one.vehicle.name for one in assessments)
    at, unit = converted(vehicle.speed, "m/s", units)
    data = {
        "title": f"{names}: {_subject(first.scheme)}",
        "heading": _heading(first, heading or Heading()),
        "subtitle": (f"{vehicle.name}: " if several else "") + f"{model} model, {len(vehicle.units)} units, "
        f"{sum(unit.mass for unit in vehicle.units) / 1000.0:.1f} t, own speed {at:.2f} {unit}",
        "verdicts": [_verdict(one, named=several) for one in assessments],
        "rows": [_row(finding, first, units) for finding in findings],
        "speed_unit": unit,
        "notes": _notes(findings),
        "compared": _compared(assessments, units) if several else None,
        "drawings": [
            {"name": one.vehicle.name, **side_view(one.vehicle), "tables": vehicle_tables(one.vehicle)}
            for one in assessments
        ],
        "turns": [turn for one in assessments if (turn := turn_view(one.vehicle))],
        "pictures": measure_charts(first),
        "roll": _roll_curves(vehicle) if set(ROLLOVER) & set(found) else None,
        "units": [_unit(unit) for unit in vehicle.units],
        "couplings": vehicle.hitches,
        "length": _length(vehicle),
        "start": 3.0,
        "lane_change": _lane_change(vehicle, model, speed_of("rearward_amplification")),
        "curves": [
            *_decay(linear_model(vehicle, speed_of("yaw_damping_coefficient"), model)),
            *_amplification(linear_model(vehicle, speed_of("rearward_amplification_peak_gain"), model)),
        ],
        **_modes(linear_model(vehicle, speed_of("least_damping_ratio"), model)),
        "sources": first.scheme.sources,
    }
    return page_text("assessment.html", f"{names}: {first.scheme.name}", data)


def _subject(scheme: Scheme) -> str:
    return "lateral performance" if scheme.name == DEFAULT_SCHEME else f"assessment by {scheme.name}"


def _heading(assessment: Assessment, heading: Heading) -> list[list[str]]:
    """Names and texts of the page's own data."""
    said = {"Project": heading.project, "Author": heading.author, "Date": heading.date}
    if assessment.scheme.name != DEFAULT_SCHEME:
        said |= {"Scheme": assessment.scheme.title, "Level": assessment.level or ""}
    return [[name, text] for name, text in said.items() if text]


def _verdict(assessment: Assessment, *, named: bool) -> dict[str, object]:
    """Overall verdict as a sentence, with the vehicle's name or without, and whether it is a failure."""
    judged = [finding for finding in assessment.findings if finding.passed is not None]
    failures = [finding.measure.name.replace("_", " ") for finding in judged if not finding.passed]
    if assessment.scheme.name == DEFAULT_SCHEME:
        text = (
            f"Fails: {', '.join(failures)}"
            if failures
            else (f"Meets every level that could be judged ({len(judged)})")
        )
    else:
        text = assessment.sentence.replace("_", " ")
    shown = f"{assessment.vehicle.name}: {text}" if named else text[0].upper() + text[1:]
    return {"text": shown, "fails": bool(failures)}


def _compared(assessments: Sequence[Assessment], units: str) -> list[dict[str, object]]:
    """Tables of the values of several vehicles, and of the differences in their data."""
    rows = []
    for findings in zip(*(one.findings for one in assessments), strict=True):
        cells = [
            _shown(finding, units) + (" \u2717" if finding.passed is False else "") for finding in findings
        ]
        rows.append([findings[0].measure.name.replace("_", " "), *cells])
    reached = [one.outcome.reached or "\u2013" for one in assessments]
    rows.append(["verdict", *(one.outcome.verdict.value for one in assessments)])
    if assessments[0].scheme.levels[0]:
        rows.append(["level reached", *reached])
    names = [one.vehicle.name for one in assessments]
    return [
        {
            "title": "Side by side",
            "columns": ["measure", *names],
            "rows": rows,
            "note": "\u2717 fails its limit",
        },
        {"title": "What differs in their data", "columns": ["key", *names], "rows": differing(assessments)},
    ]


def _shown(finding: Finding, units: str) -> str:
    measure, value = finding.measure, finding.value
    if measure.name == "understeer_gradient" and value is not None:
        return f"{math.degrees(value) * STANDARD_GRAVITY:.4f} deg/g"
    shown, unit = converted(value, measure.unit, units)
    if shown is None:
        return "none"
    named = unit.replace("s2", "s\u00b2")
    return f"{0.0 if abs(shown) < NOISE else shown:.4g} {named}".strip()


def _row(finding: Finding, assessment: Assessment, units: str) -> dict[str, object]:
    measure, levels = finding.measure, assessment.scheme.levels
    level = finding.level or ""
    if assessment.scheme.name != DEFAULT_SCHEME:
        limits = [
            f"{SIGNS[each.kind]} {limit:.4g}" if limit is not None else f"{SIGNS[each.kind]} ?"
            for each, limit in zip(finding.requirements, finding.limits, strict=True)
        ]
        reached = (
            f"; reaches level {levels[finding.reached]}" if finding.reached is not None and levels[0] else ""
        )
        by = "".join(f" ({each.text})" for each in finding.requirements if each.times or len(each.limits) > 1)
        level = "; ".join(limits) + by.replace("_", " ") + reached
    at, _ = converted(finding.speed, "m/s", units)
    return {
        "measure": measure.name,
        "name": measure.name.replace("_", " "),
        "shown": _shown(finding, units),
        "level": level.replace("<=", "\u2264").replace(">=", "\u2265"),
        "pass": finding.passed,
        "speed": f"{at:.2f}" if at else "\u2013",
        "definition": measure.definition[0].upper() + measure.definition[1:],
        "reason": finding.reason,
    }


def _roll_curves(vehicle: Vehicle) -> list[dict[str, object]] | None:
    """Lateral acceleration that holds a roll, of every group of units that roll together."""
    # Numba takes long to import, which no linear assessment waits for.
    from yawdamp_ros.nonlinear import NonlinearError  # noqa: PLC0415
    from yawdamp_ros.nonlinear.static_roll import static_rollover  # noqa: PLC0415

    try:
        groups = static_rollover(vehicle)
    except NonlinearError:
        return None
    return [
        {
            "name": " + ".join(group.units),
            "x": _rounded(np.degrees(group.curve[shown, 0])),
            "y": _rounded(group.curve[shown, 1]),
        }
        for group in groups
        for shown in [group.curve[:, 0] < MOST_ROLL]
    ]


def _notes(findings: Sequence[Finding]) -> str:
    notes = list(dict.fromkeys(f"No value: {finding.reason}." for finding in findings if finding.reason))
    notes += [f"Ambiguous: {finding.ambiguity}." for finding in findings if finding.ambiguity]
    notes += [
        f"{finding.measure.name.replace('_', ' ').capitalize()} assumes: {assumes}."
        for finding in findings
        if finding.value is not None and (assumes := getattr(finding.measure, "assumes", ""))
    ]
    if any(limit is None for f in findings if f.value is not None for limit in f.limits):
        notes.append("The PBS level of rearward amplification takes the static rollover threshold (--srt).")
    return " ".join(notes)


def _unit(unit: Unit) -> dict[str, object]:
    front, rear = _outline(unit)
    return {
        "name": unit.name,
        "front": front,
        "rear": rear,
        "axles": [{"position": axle.position, "steered": axle.steered} for axle in unit.axles],
        "hitches": _hitches(unit),
    }


def _outline(unit: Unit) -> tuple[float, float]:
    places = [axle.position for axle in unit.axles] + _hitches(unit)
    return max(places) + OVERHANG, min(places) - OVERHANG


def _hitches(unit: Unit) -> list[float]:
    return [hitch for hitch in (unit.front_hitch, unit.rear_hitch) if hitch is not None]


def _length(vehicle: Vehicle) -> float:
    """Length of the drawn combination, stretched out [m]."""
    to_last = sum(rear - front for rear, front in vehicle.hitches)
    (front, _), (_, rear) = _outline(vehicle.units[0]), _outline(vehicle.units[-1])
    return front - to_last - rear


def _lane_change(vehicle: Vehicle, model: str, speed: float) -> dict[str, object] | None:
    try:
        run = run_lane_change(linear_model(vehicle, speed, model))
    except AnalysisError:
        return None
    last = len(vehicle.units) - 1
    paths = {
        "steer": axle_path(run, 0, steer_axle_position(vehicle)),
        "last": axle_path(run, last, min(axle.position for axle in vehicle.units[-1].axles)),
    }
    return {
        "text": f"SAE J2179's single lane change at {speed:.2f} m/s ({3.6 * speed:.0f} km/h): "
        f"{SAE_J2179.displacement:.3f} m to the left in {1.0 / SAE_J2179.frequency:g} s, by the steer angle "
        "that holds the steer axle on its path.",
        "time": _listed(run.time),
        "steering": _listed(run.steering_angle),
        **{
            name: _listed(getattr(run, name))
            for name in ("x", "y", "yaw", "yaw_rate", "lateral_acceleration")
        },
        **{name: {"x": _listed(path.x), "y": _listed(path.y)} for name, path in paths.items()},
    }


def _decay(model: LinearModel) -> list[dict[str, object]]:
    values = pulse_decay(model)
    step = 1.0 / (100.0 * float(np.abs(np.linalg.eigvals(model.state_matrix)).max()))
    large = np.flatnonzero(np.abs(values) > _SHOWN_DECAY * np.abs(values).max())
    shown = values[: large[-1] + 1]
    every = max(len(shown) // _POINTS, 1)
    return [
        {
            "title": "Free decay after a steering pulse",
            "x_label": "time after the pulse, s",
            "y_label": "yaw rate of the last unit, 1/s per rad",
            "x": _rounded(step * np.arange(0.0, len(shown), every)),
            "y": _rounded(shown[::every]),
            "caption": f"A pulse of {PULSE_WIDTH:g} s at {model.speed:.2f} m/s.",
        }
    ]


def _amplification(model: LinearModel) -> list[dict[str, object]]:
    frequencies = np.linspace(0.0, 2.0, 201)
    try:
        MEASURES["rearward_amplification_peak_gain"].value(model)
    except AnalysisError:
        return []
    return [
        {
            "title": "Rearward amplification in steady sine steering",
            "x_label": "frequency, Hz",
            "y_label": "lateral acceleration, last unit over first",
            "x": _rounded(frequencies),
            "y": _rounded(amplification_at(model, frequencies)),
            "caption": f"At {model.speed:.2f} m/s.",
        }
    ]


def _modes(model: LinearModel) -> dict[str, object]:
    shown = []
    for mode in modes(model):
        if mode.eigenvalue.imag < 0.0:
            continue
        # Yaw is the integral of yaw rate: in a mode, over the eigenvalue.
        yaw = mode.yaw_rates / mode.eigenvalue if mode.eigenvalue else mode.yaw_rates
        scaled = yaw / np.abs(yaw).max() * LARGEST_YAW if np.abs(yaw).max() else yaw
        swings = f"{mode.damped_frequency / math.tau:.2f} Hz" if mode.eigenvalue.imag else "no swinging"
        shown.append(
            {
                "title": f"{swings}, damping ratio {mode.damping_ratio:.3f}",
                "caption": f"{' + '.join(mode.moving_units)}; eigenvalue {mode.eigenvalue.real:.3f}"
                + (f" ± {mode.eigenvalue.imag:.3f}i 1/s" if mode.eigenvalue.imag else " 1/s"),
                "yaw": [[round(value.real, 5), round(value.imag, 5)] for value in scaled.tolist()],
            }
        )
    text = (
        f"At {model.speed:.2f} m/s, lightest damping first: the yaw of each unit as the mode goes round, the "
        f"largest drawn as {math.degrees(LARGEST_YAW):.0f} degrees, decay left out."
    )
    return {"modes": shown, "mode_text": text}


def _listed(values: FloatArray) -> list[object]:
    return _rounded(values[::EVERY])


def _rounded(values: FloatArray) -> list[object]:
    listed: list[object] = np.round(values, 5).tolist()
    return listed
