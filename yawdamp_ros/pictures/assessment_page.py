"""An assessment as one HTML page that needs nothing else: styles, script and data are in it."""

import math
from collections.abc import Sequence

import numpy as np

from yawdamp_ros.analysis import (
    MEASURES,
    SAE_J2179,
    AnalysisError,
    Finding,
    amplification_at,
    axle_path,
    modes,
    pulse_decay,
    run_lane_change,
    steer_axle_position,
)
from yawdamp_ros.analysis.yaw_damping import PULSE_WIDTH
from yawdamp_ros.dynamics import LinearModel, linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.pictures.page import page_text
from yawdamp_ros.vehicle import STANDARD_GRAVITY, Unit, Vehicle

OVERHANG = 1.1
"""Of a unit's drawn outline past its outermost axle or hitch, in m."""

LARGEST_YAW = 0.22
"""Of a unit in the picture of a mode, in rad."""

EVERY = 8
"""Samples of the lane change from one frame to the next."""

_SHOWN_DECAY, _POINTS = 0.002, 400


def assessment_page(vehicle: Vehicle, model: str, findings: Sequence[Finding]) -> str:
    """HTML text of an assessment.

    Parameters
    ----------
    vehicle : Vehicle
    model : str
        One of `yawdamp_ros.dynamics.MODELS`.
    findings : sequence of Finding
        As `assess` gives them.

    Returns
    -------
    str
    """
    found = {finding.measure.name: finding for finding in findings}
    data = {
        "title": f"{vehicle.name}: lateral performance",
        "subtitle": f"{model} model, {len(vehicle.units)} units, "
        f"{sum(unit.mass for unit in vehicle.units) / 1000.0:.1f} t, own speed {vehicle.speed:.2f} m/s",
        "rows": [_row(finding) for finding in findings],
        "notes": _notes(findings),
        "units": [_unit(unit) for unit in vehicle.units],
        "couplings": vehicle.hitches,
        "length": _length(vehicle),
        "start": 3.0,
        "lane_change": _lane_change(vehicle, model, found["rearward_amplification"].speed),
        "curves": [
            *_decay(linear_model(vehicle, found["yaw_damping_coefficient"].speed, model)),
            *_amplification(linear_model(vehicle, found["rearward_amplification_peak_gain"].speed, model)),
        ],
        **_modes(linear_model(vehicle, found["least_damping_ratio"].speed, model)),
    }
    return page_text("assessment.html", f"{vehicle.name}: lateral performance", data)


def _row(finding: Finding) -> dict[str, object]:
    measure, value = finding.measure, finding.value
    shown = "none" if value is None else f"{value:.4g} {measure.unit.replace('s2', 's²')}".strip()
    if measure.name == "understeer_gradient" and value is not None:
        shown = f"{math.degrees(value) * STANDARD_GRAVITY:.4f} deg/g"
    return {
        "measure": measure.name,
        "name": measure.name.replace("_", " "),
        "shown": shown,
        "level": (finding.level or "").replace("<=", "≤").replace(">=", "≥"),
        "pass": finding.passed,
        "speed": f"{finding.speed:.2f}",
        "definition": measure.definition[0].upper() + measure.definition[1:],
        "reason": finding.reason,
    }


def _notes(findings: Sequence[Finding]) -> str:
    notes = list(dict.fromkeys(f"No value: {finding.reason}." for finding in findings if finding.reason))
    notes += [f"Ambiguous: {finding.ambiguity}." for finding in findings if finding.ambiguity]
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
    """Of the drawn combination, stretched out."""
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
