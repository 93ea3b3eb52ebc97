"""The pictures of the reproduction."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from reproduction.runs import CASES, MODELS, lateral_velocity, response
from reproduction.stability import locus, stiffness
from yawdamp_ros.pictures import new_figure, save
from yawdamp_ros.pictures.figure import COLOURS, UNSTABLE, add_legend, style

LABELS = {
    "lateral_velocity": "lateral velocity, m/s",
    "yaw": "yaw, rad",
    "yaw_rate": "yaw rate, rad/s",
    "lateral_acceleration": "lateral acceleration, m/s$^2$",
}
RUNS = {
    "fig_17_24": ("sine", ("yaw", "yaw_rate", "lateral_acceleration")),
    "fig_25": ("chirp", ("yaw",)),
    "fig_26_28": ("equal", ("yaw_rate", "yaw", "lateral_acceleration")),
    "fig_29_31": ("swapped", ("yaw_rate", "yaw", "lateral_acceleration")),
    "fig_32_33": ("quarter", ("yaw_rate", "yaw")),
    "fig_34_35": ("fast", ("yaw_rate", "yaw")),
}
LOCI = {
    "fig_41": (2, 3),
    "fig_43": (6, 7),
}


def write_pictures(directory: Path) -> None:
    """Write every picture of the reproduction."""
    figures = {
        "fig_04": _single_vehicle(),
        "fig_07_11": _truck_and_trailer(),
        **{name: _both_models(case, quantities) for name, (case, quantities) in RUNS.items()},
        **{name: _stiffness_locus(axles) for name, axles in LOCI.items()},
        "fig_42": _diverging_yaw(),
    }
    for name, figure in figures.items():
        save(figure, directory / f"{name}.png", dpi=80.0)


def _single_vehicle() -> Figure:
    run = response("single", "consistent")
    figure = new_figure(8.0, 3.0)
    axes = figure.subplots()
    axes.plot(run.time, run.yaw_rate, color=COLOURS[0], linewidth=1.0)
    style(axes, "time, s", LABELS["yaw_rate"], "single vehicle, chirp 0.15 to 4 Hz over 15 s")
    return figure


def _truck_and_trailer() -> Figure:
    figure = new_figure(9.0, 5.4)
    panels = figure.subplots(2, 2, sharex=True)
    cases = {"trailer_sine": "sine, 0.1 rad, 0.25 Hz", "trailer_step": "step, 1 rad after 1 s"}
    for column, (case, title) in zip(panels.T, cases.items(), strict=True):
        run = response(case, "consistent")
        sideways = lateral_velocity(case)
        for index, unit in enumerate(run.unit_names):
            line = {"color": COLOURS[index], "linewidth": 1.2, "label": unit}
            column[0].plot(run.time, sideways[:, index], **line)
            column[1].plot(run.time, run.yaw_rate[:, index], **line)
        style(column[0], "", LABELS["lateral_velocity"], title)
        style(column[1], "time, s", LABELS["yaw_rate"])
    add_legend(figure, 2, panels[0, 0].get_legend_handles_labels()[0])
    return figure


def _both_models(case: str, quantities: Sequence[str]) -> Figure:
    figure = new_figure(9.0, 2.5 * len(quantities) + 0.6)
    panels = figure.subplots(len(quantities), 2, sharex=True, sharey="row", squeeze=False)
    for column, model in enumerate(MODELS):
        run = response(case, model)
        for row, quantity in enumerate(quantities):
            axes = panels[row, column]
            for index, unit in enumerate(run.unit_names):
                values = getattr(run, quantity)[:, index]
                axes.plot(run.time, values, color=COLOURS[index], linewidth=1.1, label=unit)
            style(
                axes,
                "time, s" if row == len(quantities) - 1 else "",
                "" if column else LABELS[quantity],
                "" if row else f"{model} model",
            )
    figure.suptitle(f"{CASES[case].vehicle}, {CASES[case].speed:g} m/s", fontsize="medium")
    add_legend(figure, 3, panels[0, 0].get_legend_handles_labels()[0])
    return figure


def _stiffness_locus(axles: tuple[int, int]) -> Figure:
    figure = new_figure(9.0, 3.6)
    panels = figure.subplots(1, 2)
    for axes, model in zip(panels, MODELS, strict=True):
        found = locus(f"{stiffness(*axles)}=200e3:400e3:81", model)
        values = np.repeat(found.values / 1e3, found.eigenvalues.shape[1])
        real, imaginary = found.eigenvalues.real.ravel(), found.eigenvalues.imag.ravel()
        points = axes.scatter(real, imaginary, c=values, cmap="viridis", s=10)
        axes.set_xlim(-8.0, 4.0)
        axes.axvspan(0.0, 4.0, color=UNSTABLE, alpha=0.08, linewidth=0)
        axes.axvline(0.0, color=UNSTABLE, linewidth=1.0)
        style(axes, "real part, 1/s", "imaginary part, rad/s", f"{model} model")
    figure.colorbar(points, ax=panels, label=f"C{axles[0]} = C{axles[1]}, kN/rad")
    return figure


def _diverging_yaw() -> Figure:
    run = response("soft_drive", "published")
    figure = new_figure(8.0, 3.0)
    axes = figure.subplots()
    for index, unit in enumerate(run.unit_names):
        axes.plot(run.time, run.yaw[:, index], color=COLOURS[index], linewidth=1.2, label=unit)
    style(axes, "time, s", LABELS["yaw"], "published model, C2 = C3 = 290 kN/rad, sine")
    add_legend(figure, len(run.unit_names))
    return figure
