"""Benchmarks within one process, timed by pyperf, which repeats each in several processes."""

import itertools
import math
from collections.abc import Callable

import control
import numpy as np
import pyperf
from scipy.integrate import solve_ivp
from scipy.signal import lsim

from yawdamp_ros.analysis.points import Draws
from yawdamp_ros.analysis.study import Study, evaluate_all
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.dynamics.consistent import state_space
from yawdamp_ros.nonlinear import NonlinearDynamics
from yawdamp_ros.stepping import Stepper, TimeGrid
from yawdamp_ros.stepping.response import linear_response, respond
from yawdamp_ros.vehicle import load_stack, load_vehicle, vehicle_text

STEP = 0.001
POINTS = 100_000
SPANS = {
    "units.0.axles.1.cornering_stiffness": (1e5, 6e5),
    "units.1.mass": (4e3, 36e3),
    "units.2.front_hitch": (2.0, 6.0),
    "speed": (10.0, 40.0),
}


def offline(runner: pyperf.Runner) -> None:
    """15 s of the interlink at 1 kHz."""
    model = linear_model(load_vehicle("interlink"))
    time = np.arange(15_001) * STEP
    angles = 0.05 * np.sin(3.0 * time)
    system = (
        model.state_matrix, model.input_matrix[:, None], model.output_matrix, model.feedthrough[:, None],
    )  # fmt: skip
    grid = TimeGrid.of(STEP, STEP)
    # The same question: an input that is held over each step.
    runner.bench_func("lsim", lambda: lsim(system, angles, time, interp=False))
    state_space_of_control = control.ss(*system)
    runner.bench_func(
        "forced_response", lambda: control.forced_response(state_space_of_control, time, angles)
    )
    runner.bench_func("linear_response", lambda: linear_response(model, angles, STEP))
    runner.bench_func("respond", lambda: respond(model, angles, grid))


def step(runner: pyperf.Runner) -> None:
    """One step of the node's stepper, of the ten that it takes for a sample, and the sample."""
    size = 8  # six states, the yaw and the steer angle
    matrix, vector, result = np.random.default_rng(0).random((size, size)), np.ones(size), np.empty(size)
    runner.bench_func("matrix-vector product", lambda: np.dot(matrix, vector, out=result))
    stepper = Stepper(linear_model(load_vehicle("interlink")), STEP)
    stepper.steer(0.03)
    runner.bench_func("step", lambda: stepper.advance(10), inner_loops=10)
    runner.bench_func("sample", stepper.sample)
    # Speeds that it never had before.
    unknown = itertools.count(10.0, 1e-6)

    def change() -> None:
        stepper.change_speed(next(unknown))

    runner.bench_func("change of speed", change)


def speeds(runner: pyperf.Runner) -> None:
    """15 s of the interlink at 1 kHz, sampled at 100 Hz, at one speed and at a new one in every sample."""
    model = linear_model(load_vehicle("interlink"))
    new = itertools.count(10.0, 1e-6)

    def drive(speed: Callable[[], float | None]) -> None:
        stepper = Stepper(model, STEP)
        stepper.steer(0.03)
        for _ in range(1500):
            if (changed := speed()) is not None:
                stepper.change_speed(changed)
            stepper.advance(10)
            stepper.sample()

    runner.bench_func("constant speed", lambda: drive(lambda: None))
    runner.bench_func("changing speed", lambda: drive(lambda: next(new)))


def nonlinear(runner: pyperf.Runner) -> None:
    """Steps of the nonlinear interlink, and SciPy's integrator on the same equations."""
    dynamics = NonlinearDynamics(load_vehicle("interlink"))
    start, inputs = dynamics.initial_state(22.0), dynamics.inputs(0.02, speed=22.0)
    runner.bench_func(
        "nonlinear step", lambda: dynamics.steps(start, inputs, STEP, 2000, 2000), inner_loops=2000
    )
    runner.bench_func("nonlinear steps", lambda: dynamics.steps(start, inputs, STEP, 2000, 2000))

    def integrated(longest: float) -> None:
        solve_ivp(
            lambda _, state: dynamics.derivatives(state, inputs),
            (0.0, 2.0),
            start,
            rtol=1e-6,
            atol=1e-6,
            max_step=longest,
        )

    runner.bench_func("solve_ivp", lambda: integrated(STEP))
    runner.bench_func("solve_ivp, adaptive", lambda: integrated(math.inf))


def eigenvalues(runner: pyperf.Runner) -> None:
    """Stability of 100,000 interlinks."""
    text = vehicle_text("interlink")
    study = Study(text, "interlink", (), "consistent", tuple((key,) for key in SPANS))
    points = Draws(list(SPANS.values()), POINTS, seed=0)[:]
    stack = load_stack(text, "interlink", (), dict(zip(SPANS, points.T, strict=True)))
    matrices, _ = state_space(stack, stack.speed)
    runner.bench_func("eigvals", lambda: np.linalg.eigvals(matrices))
    runner.bench_func("sweep", lambda: list(evaluate_all(study, points)))


def main() -> None:
    """Measure; `-o FILE` keeps the figures."""
    runner = pyperf.Runner(processes=1, values=3, warmups=1)
    offline(runner)
    step(runner)
    speeds(runner)
    nonlinear(runner)
    eigenvalues(runner)


if __name__ == "__main__":
    main()
