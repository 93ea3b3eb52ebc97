"""Compile the nonlinear model ahead of its first use: ``python -m yawdamp_ros.nonlinear.warm_up``.

`make setup` runs it. Numba keeps the machine code in a cache that every later process loads.
"""

import numpy as np

from yawdamp_ros.nonlinear.dynamics import NonlinearDynamics
from yawdamp_ros.vehicle import Axle, Unit, Vehicle


def warm_up() -> None:
    """Call every compiled function once, which compiles it unless the cache holds it."""
    axles = (Axle(1.0, 1e5, steered=True), Axle(-2.0, 1e5))
    dynamics = NonlinearDynamics(Vehicle("any", 10.0, (Unit("any", 1e4, 1e4, axles),)))
    state, inputs = dynamics.initial_state(10.0), dynamics.inputs()
    dynamics.steps(state, inputs, 0.001, 1)
    dynamics.derivatives(state, inputs)
    dynamics.outputs(state[np.newaxis], inputs)


if __name__ == "__main__":
    warm_up()
