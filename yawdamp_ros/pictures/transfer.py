"""Bode, Nyquist and root locus of a transfer function: computed by python-control, drawn here."""

from types import ModuleType
from typing import Any

import numpy as np
from matplotlib.figure import Figure

from yawdamp_ros.analysis import TransferFunction
from yawdamp_ros.pictures.figure import COLOURS, GREY, STABLE, UNSTABLE, add_legend, new_figure, style

FREQUENCIES = np.geomspace(0.01, 10.0, 600)
"""Frequencies from far slower to far faster than a driver steers [Hz]."""

GAINS = np.geomspace(1e-3, 1e4, 2500)
"""Feedback gains of a root locus, over the inverse of the largest gain of the transfer function."""


def bode_figure(function: TransferFunction) -> Figure:
    """Draw gain and phase over frequency, for steering up to 10 Hz.

    Raises
    ------
    ModuleNotFoundError
        If python-control is not installed.
    """
    control, system = _system(function)
    response = control.frequency_response(system, 2.0 * np.pi * FREQUENCIES, squeeze=True)
    figure = new_figure(7.0, 5.6)
    gain, phase = figure.subplots(2, 1, sharex=True)
    gain.loglog(FREQUENCIES, response.magnitude, color=STABLE)
    gain.axhline(abs(function.static_gain), color=GREY, linewidth=0.8, linestyle="--", label="static gain")
    gain.legend(loc="lower left", fontsize="small")
    phase.semilogx(FREQUENCIES, np.degrees(np.unwrap(response.phase)), color=STABLE)
    style(gain, "", f"gain, {_unit(function.output)}/rad", f"steer angle to {function.output}")
    style(phase, "frequency, Hz", "phase, deg")
    return figure


def nyquist_figure(function: TransferFunction) -> Figure:
    """Draw the frequency response in the complex plane, for steering up to 10 Hz.

    Raises
    ------
    ModuleNotFoundError
        If python-control is not installed.
    """
    control, system = _system(function)
    response = control.frequency_response(system, 2.0 * np.pi * FREQUENCIES, squeeze=True)
    value = response.frdata.ravel()
    figure = new_figure(6.0, 5.6)
    axes = figure.subplots()
    axes.plot(value.real, value.imag, color=STABLE, label="0.01 to 10 Hz")
    axes.plot(value.real, -value.imag, color=STABLE, linewidth=0.8, linestyle="--", label="-0.01 to -10 Hz")
    for hertz in (0.1, 0.2, 0.5, 1.0, 2.0):
        point = function(2j * np.pi * hertz)
        axes.plot(point.real, point.imag, "o", color=STABLE, markersize=4)
        axes.annotate(
            f"{hertz:g} Hz",
            (point.real, point.imag),
            xytext=(5, 5),
            textcoords="offset points",
            fontsize="small",
        )
    axes.plot(-1.0, 0.0, "+", color=UNSTABLE, markersize=10, label="-1")
    axes.axhline(0.0, color=GREY, linewidth=0.8)
    axes.axvline(0.0, color=GREY, linewidth=0.8)
    unit = f"{_unit(function.output)}/rad"
    style(axes, f"real part, {unit}", f"imaginary part, {unit}", f"steer angle to {function.output}")
    axes.set_aspect("equal", "datalim")
    add_legend(figure, 3)
    return figure


def root_locus_figure(function: TransferFunction) -> Figure:
    """Draw the closed-loop poles as a proportional feedback of the output to the steering grows from 0.

    Raises
    ------
    ModuleNotFoundError
        If python-control is not installed.
    """
    control, system = _system(function)
    # Gains are given, because python-control's own choice fails for an output with an inverse response.
    largest = max(abs(function(2j * np.pi * hertz)) for hertz in FREQUENCIES)
    loci = control.root_locus_map(system, gains=np.concatenate([[0.0], GAINS / largest]))
    figure = new_figure(7.0, 5.6)
    axes = figure.subplots()
    # Dots and no lines: where a branch passes infinity, a line would join its ends through the picture.
    roots = np.asarray(loci.loci).ravel()
    axes.plot(roots.real, roots.imag, ".", color=COLOURS[5], markersize=2.5)
    poles, zeros = function.poles, function.zeros
    axes.plot(poles.real, poles.imag, "x", color="black", markersize=8, label="poles (no feedback)")
    axes.plot(zeros.real, zeros.imag, "o", color="black", fillstyle="none", markersize=8, label="zeros")
    style(
        axes, "real part, 1/s", "imaginary part, rad/s", f"feedback of {function.output} to the steer angle"
    )
    places = np.concatenate([poles, zeros])
    reach = 1.3 * float(np.abs(places).max())
    axes.set_xlim(-reach, max(0.3 * reach, 1.1 * float(places.real.max())))
    axes.set_ylim(-reach, reach)
    axes.axvspan(0.0, axes.get_xlim()[1], color=UNSTABLE, alpha=0.08, linewidth=0)
    axes.axvline(0.0, color=UNSTABLE, linewidth=1.0)
    add_legend(figure, 2)
    return figure


def _system(function: TransferFunction) -> tuple[ModuleType, Any]:
    import control  # noqa: PLC0415 - an optional library

    system = control.ss(
        function.state_matrix,
        function.input_matrix[:, np.newaxis],
        function.output_row[np.newaxis],
        function.feedthrough,
    )
    return control, system


def _unit(output: str) -> str:
    quantity = output.rpartition("/")[2]
    return {"yaw_rate": "(rad/s)", "lateral_velocity": "(m/s)", "lateral_acceleration": "(m/s$^2$)"}.get(
        quantity, "rad"
    )
