"""Reports of `stability`, as text and as JSON."""

import json
import math
from collections.abc import Sequence
from dataclasses import dataclass

from yawdamp_ros.analysis import (
    SPEEDS,
    AnalysisError,
    Boundary,
    Locus,
    Mode,
    Steering,
    TransferFunction,
    critical_speed,
    modes,
    speed_boundaries,
    static_gains,
    steady_steering,
)
from yawdamp_ros.cli.boundary_text import boundary_record, boundary_text
from yawdamp_ros.cli.number import number
from yawdamp_ros.cli.table import print_table
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.vehicle import STANDARD_GRAVITY


@dataclass(frozen=True)
class Stability:
    """Answer for one vehicle at one speed."""

    model: LinearModel
    modes: tuple[Mode, ...]
    steering: Steering
    static_gains: dict[str, float] | None
    boundaries: tuple[Boundary, ...]

    @property
    def stable(self) -> bool:
        """True if every eigenvalue lies in the left half plane."""
        return all(mode.eigenvalue.real < 0.0 for mode in self.modes)


def assess(model: LinearModel) -> Stability:
    """Compute the answer for a model."""
    try:
        gains = static_gains(model)
    except AnalysisError:
        gains = None
    return Stability(
        model=model,
        modes=modes(model),
        steering=steady_steering(model),
        static_gains=gains,
        boundaries=speed_boundaries(model.vehicle, model.model),
    )


def print_json(answer: Stability, function: TransferFunction | None) -> None:
    """Print an answer as one JSON object."""
    model = answer.model
    report: dict[str, object] = {
        **_heading(model),
        "speed": model.speed,
        "stable": answer.stable,
        "state_names": model.state_names,
        "state_matrix": model.state_matrix.tolist(),
        "input_matrix": model.input_matrix.tolist(),
        "modes": [
            {
                "eigenvalue": _pair(mode.eigenvalue),
                "damping_ratio": mode.damping_ratio,
                "undamped_frequency": mode.undamped_frequency,
                "damped_frequency": mode.damped_frequency,
                "moving_units": mode.moving_units,
                "yaw_rates": [_pair(complex(rate)) for rate in mode.yaw_rates],
            }
            for mode in answer.modes
        ],
        "understeer_gradient": answer.steering.understeer_gradient,
        "equivalent_wheelbase": answer.steering.equivalent_wheelbase,
        "critical_speed": critical_speed(answer.boundaries),
        "stability_boundaries": [boundary_record(each) for each in answer.boundaries],
        "searched_speeds": SPEEDS,
        "static_gains": answer.static_gains,
    }
    if function:
        report["transfer_function"] = {
            "output": function.output,
            "poles": [_pair(pole) for pole in function.poles],
            "zeros": [_pair(zero) for zero in function.zeros],
            "static_gain": function.static_gain,
        }
    print(json.dumps(report, indent=2))


def print_text(answer: Stability, function: TransferFunction | None) -> None:
    """Print an answer as tables and sentences."""
    model = answer.model
    print(_title(model, f"{model.speed:.6g} m/s", "stable" if answer.stable else "UNSTABLE"))
    print_table(
        "Modes, lightest damping first",
        ("moving units", "eigenvalue, 1/s", "damping ratio", "undamped, rad/s", "damped, rad/s"),
        [
            (
                " + ".join(mode.moving_units),
                _complex(mode.eigenvalue),
                number(mode.damping_ratio, ".4f"),
                number(mode.undamped_frequency, ".4f"),
                number(mode.damped_frequency, ".4f"),
            )
            for mode in answer.modes
        ],
    )
    print_table(
        "Mode shapes: yaw rate of each unit, the largest 1, with its phase",
        ("eigenvalue, 1/s", *model.vehicle.unit_names),
        [
            (_complex(mode.eigenvalue), *(_polar(complex(rate)) for rate in mode.yaw_rates))
            for mode in answer.modes
            if mode.eigenvalue.imag >= 0.0
        ],
    )
    steering = answer.steering
    degrees_per_g = math.degrees(steering.understeer_gradient) * STANDARD_GRAVITY
    gradient = f"{number(steering.understeer_gradient, '.6f')} rad/(m/s2)"
    print(f"\nundersteer gradient   {gradient} ({number(degrees_per_g, '.4f')} deg/g)")
    print(f"equivalent wheelbase  {steering.equivalent_wheelbase:.4f} m")
    print(f"critical speed        {_critical_speed(answer)}")
    if answer.static_gains is None:
        print("static gains          none: a root at the origin")
    else:
        print_table(
            "Static gains per rad of steer angle" if answer.stable else "Static gains, never settled to",
            ("output", "gain"),
            [(name, number(gain, ".4f")) for name, gain in answer.static_gains.items()],
        )
    if function:
        _print_transfer_function(function)


def print_locus_json(first: LinearModel, keys: Sequence[str], locus: Locus) -> None:
    """Print a locus as one JSON object."""
    report = {
        **_heading(first),
        "keys": keys,
        "values": locus.values.tolist(),
        "eigenvalues": [[_pair(complex(value)) for value in row] for row in locus.eigenvalues],
        "stability_boundaries": [boundary_record(each) for each in locus.boundaries],
    }
    print(json.dumps(report, indent=2))


def print_locus_text(first: LinearModel, keys: Sequence[str], locus: Locus) -> None:
    """Print a locus as a table and the boundaries in it."""
    name = ", ".join(keys)
    print(_title(first, f"over {name}"))
    print_table(
        "Eigenvalues, 1/s (of a pair the one above the real axis), rightmost first",
        (keys[-1].rpartition(".")[2], "stable", "eigenvalues"),
        [
            (
                f"{value:.6g}",
                "yes" if row[-1].real < 0.0 else "NO",
                "   ".join(_complex(complex(each)) for each in row[::-1] if each.imag >= 0.0),
            )
            for value, row in zip(locus.values, locus.eigenvalues, strict=True)
        ],
        prose=(2, 0),
    )
    print()
    lowest, highest = sorted((locus.values[0], locus.values[-1]))
    if not locus.boundaries:
        always = "unstable" if locus.eigenvalues[0, -1].real > 0.0 else "stable"
        print(f"{always} all the way from {lowest:.6g} to {highest:.6g}")
    for boundary in locus.boundaries:
        print(boundary_text(boundary, ""))


def _print_transfer_function(function: TransferFunction) -> None:
    print(f"\nTransfer function from steer angle to {function.output}")
    print(f"  static gain  {number(function.static_gain, '.6g')}")
    for name, values in (("poles", function.poles), ("zeros", function.zeros)):
        shown = "   ".join(_complex(complex(value)) for value in values if value.imag >= 0.0)
        print(f"  {name:11}  {shown or 'none'}")


def _critical_speed(answer: Stability) -> str:
    lowest, highest = SPEEDS
    searched = f"from {lowest:g} to {highest:g} m/s"
    if not answer.boundaries:
        return f"none: {'stable' if answer.stable else 'unstable'} at every speed {searched}"
    sentences = "; ".join(boundary_text(boundary, " m/s") for boundary in answer.boundaries)
    none = "" if critical_speed(answer.boundaries) else "none reached by speeding up; "
    return f"{none}{sentences} (searched {searched})"


def _heading(model: LinearModel) -> dict[str, object]:
    return {"vehicle": model.vehicle.name, "model": model.model}


def _title(model: LinearModel, *facts: str) -> str:
    return ", ".join((model.vehicle.name, f"{model.model} model", *facts))


def _pair(value: complex) -> list[float]:
    return [float(value.real), float(value.imag)]


def _complex(value: complex) -> str:
    if not value.imag:
        return number(value.real, ".4f")
    return f"{number(value.real, '.4f')} {'-' if value.imag < 0.0 else '+'} {number(abs(value.imag), '.4f')}i"


def _polar(value: complex) -> str:
    degrees = round(math.degrees(math.atan2(value.imag, value.real)))
    return f"{abs(value):.3f} at {degrees:4d} deg"
