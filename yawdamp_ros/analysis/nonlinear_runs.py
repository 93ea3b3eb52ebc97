"""Runs of the nonlinear model from straight running, for measures of its motion."""

from typing import NamedTuple

import numpy as np

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.analysis.lane_change import run_lane_change
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear import NonlinearDynamics, Outputs
from yawdamp_ros.nonlinear.layout import STEERING
from yawdamp_ros.stepping import TimeGrid
from yawdamp_ros.vehicle import Vehicle

GRID = TimeGrid.of(0.001, 0.01)
"""Steps and samples of the runs."""


class Run(NamedTuple):
    """Samples of a run, up to where a unit rolls over.

    Attributes
    ----------
    time, steering : ndarray, shape (m,)
        Time [s] and road-wheel steer angle [rad].
    outputs : Outputs
        Outputs of m instants.
    rolled_over : str
        Name of the unit that rolls over at the end; empty otherwise.
    """

    time: FloatArray
    steering: FloatArray
    outputs: Outputs
    rolled_over: str


def drive(vehicle: Vehicle, speed: float, steering: FloatArray) -> Run:
    """Drive from straight running at a held speed.

    Parameters
    ----------
    vehicle : Vehicle
    speed : float
        Speed [m/s].
    steering : ndarray
        Road-wheel steer angle of each step of `GRID` [rad].

    Returns
    -------
    Run

    Raises
    ------
    AnalysisError
        If the motion diverges.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> float(drive(load_vehicle("single_vehicle"), 20.0, np.full(1001, 0.01)).time[-1])
    1.0
    """
    dynamics, every = NonlinearDynamics(vehicle), GRID.steps_per_sample
    inputs = np.tile(dynamics.inputs(speed=speed), (len(steering), 1))
    inputs[:, STEERING] = steering
    run = dynamics.try_steps(dynamics.initial_state(speed), inputs[:-1], GRID.step_size, every=every)
    if run.diverged:
        message = f"{vehicle.name}: divergence of {run.diverged} at {GRID.seconds(run.taken):.2f} s"
        raise AnalysisError(message)
    shown = slice(every, every * (len(run.states) + 1), every)
    return Run(
        GRID.seconds(np.arange(len(steering))[shown]),
        steering[shown],
        dynamics.outputs(run.states, inputs[shown]),
        run.rolled_over,
    )


def drive_lane_change(vehicle: Vehicle, speed: float) -> Run:
    """Drive the lane change of SAE J2179, steered as its path takes it of the linear model.

    Parameters
    ----------
    vehicle : Vehicle
    speed : float
        Speed [m/s].

    Returns
    -------
    Run

    Raises
    ------
    AnalysisError
        If no steering leads the linear model through the lane change, or the motion diverges.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import load_vehicle
    >>> drive_lane_change(load_vehicle("single_vehicle"), 24.0).rolled_over
    ''
    """
    planned = run_lane_change(linear_model(vehicle, speed))
    steps = GRID.samples_in(float(planned.time[-1])) * GRID.steps_per_sample
    times = GRID.seconds(np.arange(steps + 1))
    return drive(vehicle, speed, np.interp(times, planned.time, planned.steering_angle))
