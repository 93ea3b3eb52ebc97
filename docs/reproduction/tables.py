"""What stands in the template's fields."""

import json
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from reproduction import markdown
from reproduction.runs import (
    CASES,
    CHIRP,
    MODELS,
    SINE,
    last_peaks,
    lateral_velocity,
    response,
    settled_amplitude,
)
from reproduction.stability import (
    SPEED,
    largest_real_part,
    locus,
    shift_boundaries,
    shifted,
    static_front_axle_load,
    stiffness,
    truck_mass_boundaries,
)
from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import (
    Boundary,
    Mode,
    modes,
    speed_boundaries,
    static_gains,
    steady_steering,
    transfer_function,
)
from yawdamp_ros.dynamics.published import published_matrices
from yawdamp_ros.vehicle import printed_stiffness

PRINTED: dict[str, Any] = json.loads(
    (Path(__file__).parents[1] / "report_reproduction" / "frerichs_2012.json").read_text(encoding="utf-8"),
    parse_float=str,
    parse_int=str,
)
LOADS = (32843.88, 19239.86, 19239.86, 20386.41, 20386.41, 20832.76, 20832.76)
PERIOD = 1.0 / SINE.frequency
INTERLINK = load_vehicle("interlink")


def fields() -> dict[str, str]:
    """Text of every field of the template."""
    return {
        **_matrices(),
        **_eigenvalues(),
        **_stability(),
        **_vehicles(),
        **_curves(),
    }


def _matrices() -> dict[str, str]:
    mass = published_matrices(INTERLINK, SPEED).mass
    state_matrix = linear_model(INTERLINK, SPEED, "published").state_matrix
    axles = [axle for unit in INTERLINK.units for axle in unit.axles]
    rated = [axle for unit in load_vehicle("interlink_rated_tyres").units for axle in unit.axles]
    rows = [
        [
            str(index),
            f"{load:.2f}",
            f"{axle.cornering_stiffness:.2f}",
            f"{printed_stiffness(load):.1f}",
            f"{fancher.cornering_stiffness:.0f}",
            f"{axle.cornering_stiffness / fancher.cornering_stiffness:.4f}",
        ]
        for index, (load, axle, fancher) in enumerate(zip(LOADS, axles, rated, strict=True), 1)
    ]
    header = ["axle", "load per tyre, N", "Table 5, N/rad", "360 z (0.1 - z/300000)", "Fancher", "ratio"]
    return {
        "mass_matrix": markdown.matrix(mass, PRINTED["mass_matrix"]),
        "state_matrix": markdown.matrix(state_matrix, PRINTED["state_matrix"]),
        "table_5": markdown.table(header, rows),
        "front_load": f"{static_front_axle_load() / 1e3:.1f}",
        "front_load_printed": f"{2 * LOADS[0] / 1e3:.1f}",
    }


def _eigenvalues() -> dict[str, str]:
    printed = PRINTED["table_6"]
    table_6 = [
        [
            _printed(value),
            frequency,
            damping,
            markdown.eigenvalue(mode.eigenvalue),
            f"{mode.undamped_frequency:.4f}",
            f"{mode.damping_ratio:.4f}",
        ]
        for value, frequency, damping, mode in zip(
            printed["eigenvalues"],
            printed["undamped_frequency"],
            printed["damping_ratio"],
            modes(linear_model(INTERLINK, SPEED, "published")),
            strict=True,
        )
        if not value[1].startswith("-")
    ]
    header = ["report", "undamped, rad/s", "damping", "published model", "undamped, rad/s", "damping"]
    return {
        "table_6": markdown.table(header, table_6),
        "table_6_consistent": _modes_table(modes(linear_model(INTERLINK, SPEED))),
        "modes_rated": _modes_table(modes(linear_model(load_vehicle("interlink_rated_tyres"), 22.2))),
        "at_34_report": ", ".join(_unpaired(PRINTED["at_34"]["eigenvalues"])),
        "at_34_published": _listed(modes(linear_model(INTERLINK, 34.0, "published")), 4),
        "at_34_consistent": _modes_table(modes(linear_model(INTERLINK, 34.0))),
        "rearward_report": ", ".join(_unpaired(PRINTED["trailer_2_rearward"]["eigenvalues"])),
        "rearward_published": _eigenvalues_of(2, -1.0, "published", 22.2),
        "rearward_consistent": _eigenvalues_of(2, -1.0, "consistent", 22.2),
        "forward_published": _eigenvalues_of(1, 1.0, "published", SPEED),
        "forward_consistent": _eigenvalues_of(1, 1.0, "consistent", SPEED),
        "fig_41_published": f"{_soft_drive('published'):.4f}",
        "fig_41_consistent": f"{_soft_drive('consistent'):.4f}",
        "fig_45": markdown.table(
            ["model", "largest real part, 1/s"],
            [[m, f"{largest_real_part('interlink_swapped', (), m):.4f}"] for m in MODELS],
        ),
    }


def _stability() -> dict[str, str]:
    claims = [
        ("no C1 destabilises", f"{stiffness(1)}=20e3:1.81e6:41", 1e3, "kN/rad", 1),
        ("C2 = C3 unstable below 290 to 300 kN/rad", f"{stiffness(2, 3)}=200e3:1e6:41", 1e3, "kN/rad", 1),
        ("C4 = C5 have no effect", f"{stiffness(4, 5)}=20e3:1e6:41", 1e3, "kN/rad", 1),
        ("C6 = C7 unstable below 250 to 300 kN/rad", f"{stiffness(6, 7)}=20e3:1e6:41", 1e3, "kN/rad", 1),
        ("m2 from 4156 to 36000 kg stable", "units.1.mass=4156:36000:41", 1.0, "kg", 0),
        ("m3 from 4415 kg up stable", "units.2.mass=4415:60000:41", 1.0, "kg", 0),
        ("m1 unstable near 1000 kg", "units.0.mass=1000:9200:41", 1.0, "kg", 0),
    ]
    rows = []
    for claim, variation, scale, unit, digits in claims:
        cells = []
        for model in MODELS:
            found = locus(variation, model)
            low, high = found.values[0] / scale, found.values[-1] / scale
            none = f"stable from {low:.0f} to {high:.0f} {unit}"
            cells.append(_boundaries(found.boundaries, none, scale, unit, digits))
        rows.append([claim, *cells])
    cells = [
        _boundaries(truck_mass_boundaries(model), "stable from 1000 to 9200 kg", 1.0, "kg", 0)
        for model in MODELS
    ]
    rows.append(["the same, J1 in proportion to m1", *cells])
    for trailer, name in ((1, "trailer 1"), (2, "trailer 2")):
        cells = [
            _boundaries(
                shift_boundaries(trailer, model), "stable from 1 m rearward to 1 m forward", 1.0, "m", 3
            )
            for model in MODELS
        ]
        rows.append([f"{name}'s CG shifted by so much forward", *cells])
    speeds = {model: speed_boundaries(INTERLINK, model) for model in MODELS}
    cells = [_boundaries(found, "stable from 0.5 to 70 m/s", 1.0, "m/s", 1) for found in speeds.values()]
    rows.append(["speed", *cells])
    (lowest,) = speeds["published"]
    return {
        "claims": markdown.table(["claim", "published model", "consistent model"], rows),
        "lowest_speed": f"{lowest.value:.1f}",
    }


def _vehicles() -> dict[str, str]:
    rows = []
    for model in MODELS:
        linear = linear_model(INTERLINK, SPEED, model)
        steering = steady_steering(linear)
        gains = static_gains(linear)
        rows.append(
            [
                model,
                f"{steering.equivalent_wheelbase:.3f}",
                f"{steering.understeer_gradient:.5f}",
                f"{gains['truck/yaw_rate']:.3f}",
                f"{gains['truck/lateral_acceleration']:.2f}",
                f"{gains['articulation_1']:.2f}",
                f"{gains['articulation_2']:.2f}",
            ]
        )
    header = [
        "model",
        "equivalent wheelbase, m",
        "understeer gradient, rad/(m/s²)",
        "yaw rate, 1/s",
        "lateral acceleration, m/s²",
        "articulation 1",
        "articulation 2",
    ]
    function, consistent = (
        transfer_function(linear_model(INTERLINK, SPEED, model), "truck/lateral_acceleration")
        for model in MODELS
    )
    car = linear_model(load_vehicle("single_vehicle"))
    trailer = linear_model(load_vehicle("truck_trailer"))
    return {
        "gains": markdown.table(header, rows),
        "g1_gain": f"{function.feedthrough:.2f}",
        "g1_gain_consistent": f"{consistent.feedthrough:.2f}",
        "g1_zeros": _complex_list(function.zeros, 2),
        "g1_poles": _complex_list(function.poles, 2),
        "single_eigenvalue": _listed(modes(car), 4),
        "single_gain": f"{static_gains(car)['car/yaw_rate']:.4f}",
        "trailer_eigenvalues": _listed(modes(trailer), 4),
    }


def _curves() -> dict[str, str]:
    yaw, rate, acceleration = "yaw", "yaw_rate", "lateral_acceleration"
    tables = {
        "sine": (yaw, rate, acceleration),
        "chirp": (yaw,),
        "equal": (rate, yaw, acceleration),
        "swapped": (rate, yaw, acceleration),
        "quarter": (rate, yaw),
        "fast": (rate, yaw),
        "sine_hertz": (acceleration,),
    }
    trailers = ("trailer_sine", "trailer_step", "trailer_step_small")
    peaks = [
        [
            model,
            *(
                f"{amplitude:.2f} at {time:.2f}"
                for amplitude, time in zip(
                    settled_amplitude(response("sine", model), PERIOD),
                    last_peaks(response("sine", model), PERIOD),
                    strict=True,
                )
            ),
        ]
        for model in MODELS
    ]
    return {
        **{
            f"runs_{case}": markdown.ranges({m: response(case, m) for m in MODELS}, quantities)
            for case, quantities in tables.items()
        },
        **{f"runs_{case}": _trailer_table(case) for case in trailers},
        "peaks": markdown.table(["model", *response("sine", "published").unit_names], peaks),
        "single_peak": f"{np.abs(response('single', 'consistent').yaw_rate).max():.3f}",
        "soft_drive_yaw": f"{response('soft_drive', 'published').yaw[-1, 0]:.2f}",
        "chirp_final": f"{CHIRP.final_frequency:.1f}",
    }


def _trailer_table(case: str) -> str:
    """Table of what the truck and the trailer reach, with the lateral velocity that a response lacks."""
    run = response(case, "consistent")
    rows = [
        markdown.ranges_row("lateral velocity, m/s", lateral_velocity(case), 2),
        markdown.ranges_row("yaw rate, rad/s", run.yaw_rate, 3),
    ]
    return markdown.table(["consistent model", *run.unit_names], rows)


def _soft_drive(model: str) -> float:
    return largest_real_part("interlink", CASES["soft_drive"].overrides, model)


def _modes_table(found: Iterable[Mode]) -> str:
    header = ["moving units", "eigenvalue, 1/s", "undamped, rad/s", "damped, rad/s", "damping ratio"]
    rows = [
        [
            " + ".join(mode.moving_units),
            markdown.eigenvalue(mode.eigenvalue),
            f"{mode.undamped_frequency:.4f}",
            f"{mode.damped_frequency:.4f}",
            f"{mode.damping_ratio:.3f}",
        ]
        for mode in found
        if mode.eigenvalue.imag >= 0.0
    ]
    return markdown.table(header, rows)


def _listed(found: Iterable[Mode], digits: int) -> str:
    return _complex_list([mode.eigenvalue for mode in found], digits)


def _complex_list(values: Iterable[complex], digits: int) -> str:
    shown = [markdown.eigenvalue(complex(value), digits) for value in values if value.imag >= 0.0]
    return ", ".join(shown)


def _eigenvalues_of(unit: int, forward: float, model: str, speed: float) -> str:
    vehicle = shifted(unit, model)(forward).vehicle
    return _listed(modes(linear_model(vehicle, speed, model)), 2)


def _printed(pair: Sequence[str]) -> str:
    real, imaginary = pair
    return real if imaginary == "0" else f"{real} ± {imaginary}i"


def _unpaired(pairs: Iterable[Sequence[str]]) -> list[str]:
    return [_printed(pair) for pair in pairs if not pair[1].startswith("-")]


def _boundaries(found: Sequence[Boundary], none: str, scale: float, unit: str, digits: int) -> str:
    kinds: Mapping[str, str] = {
        "monotonic": "real root",
        "oscillatory": "pair",
        "jump": "mass matrix singular",
    }
    return (
        "; ".join(
            f"unstable {'above' if each.unstable_above else 'below'} {each.value / scale:.{digits}f} {unit} "
            f"({kinds[each.kind]})"
            for each in found
        )
        or none
    )
