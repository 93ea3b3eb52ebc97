"""Whatever the vehicle file and the commands, a motion is finite or refused."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from strategies import vehicles
from yawdamp_ros.nonlinear import NonlinearDynamics, NonlinearError

COMMANDS = st.fixed_dictionaries(
    {
        "steering": st.floats(-1.5, 1.5),
        "acceleration": st.floats(-20.0, 20.0),
        "speed": st.one_of(st.none(), st.floats(-40.0, 40.0)),
        "friction": st.tuples(st.floats(0.0, 2.0), st.floats(0.0, 2.0)),
        "grade": st.floats(-1.0, 1.0),
        "crossfall": st.floats(-1.0, 1.0),
    }
)


@settings(max_examples=60)
@given(vehicles(), st.floats(-70.0, 70.0), COMMANDS, st.sampled_from([0.001, 0.01, 0.1]), st.data())
def test_a_motion_is_finite_or_it_ends_with_a_reason(
    vehicle: object, speed: float, commands: dict[str, object], dt: float, data: st.DataObject
) -> None:
    dynamics = NonlinearDynamics(vehicle)
    inputs = dynamics.inputs(**commands)
    layout = dynamics.input_layout
    for part, size in ((layout.axle_steering, 1.5), (layout.brake, 1e6), (layout.yaw_moment, 1e6)):
        inputs[part] = data.draw(st.floats(-size, size))
    state = dynamics.initial_state(speed)
    try:
        run = dynamics.steps(state, inputs, dt, 200, 20)
    except NonlinearError as error:
        assert "diverges at step" in str(error)  # noqa: PT017
        return
    assert np.isfinite(run.states).all()
    for values in dynamics.outputs(run.states, inputs):
        assert np.isfinite(values).all()
    friction = np.tile(inputs[3:5], layout.axles)
    found = dynamics.outputs(run.states, inputs)
    total = np.hypot(found.longitudinal_force, found.lateral_force)
    assert (total <= friction * found.wheel_load * (1.0 + 1e-9) + 1e-6).all(), "friction limits every wheel"
