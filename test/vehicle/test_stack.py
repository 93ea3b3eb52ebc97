"""A stack of vehicles is those vehicles, one by one."""

import numpy as np
import pytest

from yawdamp_ros.dynamics.consistent import state_space
from yawdamp_ros.vehicle import VehicleError, load_stack, load_vehicle, unstacked, vehicle_text

KEYS = {
    "speed": (10.0, 30.0),
    "units.0.axles.1.cornering_stiffness": (2e5, 6e5),
    "units.1.mass": (4156.0, 36000.0),
    "units.1.rear_hitch": (-7.0, -4.0),
    "units.2.yaw_inertia": (1e5, 5e5),
    "units.2.front_hitch": (2.0, 6.0),
    "units.2.axles.0.position": (-4.0, -2.0),
    "units.2.load.0.mass": (0.0, 5000.0),
    "units.2.load.0.position": (-3.0, 3.0),
}
LOAD = "units.2.load=[{mass: 1000, position: 0}]"


def drawn(keys: dict[str, tuple[float, float]], count: int) -> dict[str, np.ndarray]:
    random = np.random.default_rng(1)
    return {key: random.uniform(*span, count) for key, span in keys.items()}


@pytest.mark.parametrize("keys", [*([key] for key in KEYS), list(KEYS)])
@pytest.mark.parametrize("vehicle", ["interlink", "interlink_rated_tyres"])
def test_every_vehicle_of_a_stack_is_what_its_values_give_alone(vehicle: str, keys: list[str]) -> None:
    if vehicle == "interlink_rated_tyres":
        keys = [key.replace("cornering_stiffness", "tyre_load") for key in keys]
        values = drawn({key: KEYS.get(key, (1e4, 3e4)) for key in keys}, 4)
    else:
        values = drawn({key: KEYS[key] for key in keys}, 4)
    stack = load_stack(vehicle_text(vehicle), vehicle, [LOAD], values)
    matrices, inputs = (
        np.broadcast_to(matrix, (4, *matrix.shape[-rank:]))
        for matrix, rank in zip(state_space(stack, stack.speed), (2, 1), strict=True)
    )
    for index in range(4):
        alone = load_vehicle(vehicle, [LOAD, *(f"{key}={float(values[key][index])!r}" for key in keys)])
        assert unstacked(stack, index) == alone
        matrix, by_steering = state_space(alone, alone.speed)
        np.testing.assert_allclose(matrices[index], matrix, rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(inputs[index], by_steering, rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize(
    "key, values, said",
    [
        ("units.1.mass", [1.0, -2.0, 3.0], "units.1.mass: -2.0: expected a mass in kg, from 0.001"),
        ("units.1.load.0.mass", [1.0, 2.0], "units.1.load.0.mass: no such key to set"),
        ("units.1.rear_hitch", [-5.0, 2.0], "2.0: expected a position behind the front hitch at 1.275"),
        ("units.1.axles.0.position", [-5.0, -29.0], "30.275 m from its foremost to its rearmost"),
        ("units.2.load.0.mass", [5.0, 9e4], "N with the loads on the vehicle: expected above 0"),
        ("name", [5.0, 6.0], "name: 5.0: expected a name"),
    ],
)
def test_a_stack_with_one_wrong_value_is_refused_as_that_vehicle_is(
    key: str, values: list[float], said: str
) -> None:
    with pytest.raises(VehicleError) as caught:
        load_stack(vehicle_text("interlink_rated_tyres"), "mine.yaml", [LOAD], {key: np.array(values)})
    assert said in str(caught.value)
    assert str(caught.value).startswith("mine.yaml: ")
    assert "\n" not in str(caught.value)
