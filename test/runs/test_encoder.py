import numpy as np
import pytest
from geometry_msgs.msg import Quaternion
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import Imu, JointState

from yawdamp_ros import load_vehicle
from yawdamp_ros.runs.encoder import Encoder, message_class
from yawdamp_ros.runs.sensors import Sensors
from yawdamp_ros.simulation import SimParameters, make_motion
from yawdamp_ros.stepping import AppliedInput, Motion, TimeGrid
from yawdamp_ros.vehicle import STANDARD_GRAVITY, complete

NOISY = {"yaw_stddev": 0.01, "yaw_rate_stddev": 0.02, "lateral_acceleration_stddev": 0.3, "noise_seed": 7}
ERRONEOUS = NOISY | {
    "yaw_bias": 0.1,
    "yaw_rate_drift": 0.01,
    "lateral_acceleration_bias": -0.2,
    "imu_delay": 0.05,
}


def encoder(vehicle: str, step_size: float, noise: dict[str, float]) -> tuple[Motion, Encoder]:
    motion = make_motion(load_vehicle(vehicle), "consistent", None, step_size)
    grid = TimeGrid.of(step_size, 10 * step_size)
    return motion, Encoder(motion, SimParameters(**noise), grid, start_time=1_000)  # type: ignore[arg-type]


@pytest.mark.parametrize("name", ["single_vehicle", "truck_trailer", "interlink"])
@pytest.mark.parametrize("noise", [{}, NOISY, ERRONEOUS])
def test_messages_of_many_instants_are_those_of_each(name: str, noise: dict[str, float]) -> None:
    angles = 0.05 * np.sin(np.arange(1, 401) / 90)
    (one, of_one), (many, of_many) = (encoder(name, 0.001, noise) for _ in range(2))
    each = [of_one.encoded(one.run(angles[begin : begin + 10])) for begin in range(0, 400, 10)]
    together = of_many.encoded(many.run(angles, 10))
    assert together.stamps == [stamp for encoded in each for stamp in encoded.stamps]
    assert together.stamps[0] == 1_000 + 10_000_000
    # Decoded, as padding between fields holds whatever was there.
    for found, expected in zip(together.messages, each, strict=True):
        for data, other, kind in zip(found, expected.messages[0], of_one.types.values(), strict=True):
            read = message_class(kind)
            assert deserialize_message(data, read) == deserialize_message(other, read)


def test_orientation_is_the_yaw_and_noise_is_on_imu_alone() -> None:
    motion, encodes = encoder("truck_trailer", 0.01, {"yaw_stddev": 0.01, "noise_seed": 3})
    sample = motion.run([0.2] * 1500)  # more than a turn
    by_topic = dict(zip(encodes.types, encodes.encoded(sample).messages[0], strict=True))

    def yaw(orientation: Quaternion) -> complex:
        return complex(orientation.w, orientation.z) ** 2

    drawn = 0.01 * np.random.default_rng([3, 1500]).standard_normal((2, 3))[:, 0]
    assert abs(sample.yaw[0]) > 2.0 * np.pi
    for unit, name in enumerate(motion.vehicle.unit_names):
        odometry = deserialize_message(by_topic[f"{name}/odom"], Odometry)
        imu = deserialize_message(by_topic[f"{name}/imu"], Imu)
        exact = np.exp(1j * sample.yaw[unit])
        assert yaw(odometry.pose.pose.orientation) == pytest.approx(exact, abs=1e-13)
        assert yaw(imu.orientation) == pytest.approx(exact * np.exp(1j * drawn[unit]), abs=1e-13)
        assert imu.angular_velocity.z == sample.yaw_rate[unit]


def test_axles_and_hitches_show_the_forces_that_balance_the_combination() -> None:
    grid = TimeGrid.of(0.001, 0.01)
    motion = make_motion(load_vehicle("interlink"), "nonlinear", 20.0, grid.step_size)
    encodes = Encoder(motion, SimParameters(), grid, start_time=0)
    motion.apply(AppliedInput(0, "acceleration", -2.0))
    sample = motion.run([0.01] * 3000)
    by_topic = dict(zip(encodes.types, encodes.encoded(sample).messages[0], strict=True))
    units = motion.vehicle.units
    wheels = [deserialize_message(by_topic[f"{unit.name}/axles"], JointState) for unit in units]
    hitches = deserialize_message(by_topic["joint_states"], JointState)
    assert hitches.name[:3] == ["steering", "articulation_1", "articulation_2"]
    assert hitches.name[3:6] == ["hitch_1_x", "hitch_1_y", "hitch_1_z"]
    last, behind = units[-1], wheels[-1]
    assert behind.name[:4] == ["axle_1_left_x", "axle_1_left_y", "axle_1_left_z", "axle_1_right_x"]
    assert list(behind.position[0:2]) == [
        last.axles[0].position,
        0.5 * complete(motion.vehicle).units[-1].axles[0].track_width,
    ]
    loads = [sum(message.effort[2::3]) for message in wheels]
    weight = STANDARD_GRAVITY * sum(unit.mass for unit in units)
    assert sum(loads) == pytest.approx(weight, rel=1e-3)
    # What the last hitch carries, its wheels do not.
    carried = hitches.effort[hitches.name.index("hitch_2_z")]
    assert loads[-1] + carried == pytest.approx(STANDARD_GRAVITY * last.mass, rel=1e-3)
    # Newton's second law of the last unit along itself and across, in its own frame.
    ahead = complex(*hitches.effort[6:8]) * np.exp(1j * sample.articulation[-1])
    found = ahead + complex(sum(behind.effort[0::3]), sum(behind.effort[1::3]))
    surge = sample.extra["longitudinal_acceleration"][-1]
    expected = last.mass * complex(surge, sample.lateral_acceleration[-1])
    assert found == pytest.approx(expected, rel=0.02)
    assert surge == pytest.approx(-2.0, abs=0.2)


def test_an_imu_is_late_and_off_and_walks_and_odometry_is_the_truth() -> None:
    grid = TimeGrid.of(0.01, 0.1)

    def shown(**errors: float) -> tuple[np.ndarray, np.ndarray]:
        """Yaw rate of the truck by imu and by odometry over forty seconds."""
        motion = make_motion(load_vehicle("truck_trailer"), "consistent", None, grid.step_size)
        encodes = Encoder(motion, SimParameters(**errors), grid, start_time=0)  # type: ignore[arg-type]
        angles = 0.02 * np.sin(np.arange(1, 4_001) / 30.0)
        encoded = encodes.encoded(motion.run(angles, 10))
        places = [list(encodes.types).index(f"truck/{name}") for name in ("imu", "odom")]
        rates = []
        for place, kind in zip(places, (Imu, Odometry), strict=True):
            read = [deserialize_message(row[place], kind) for row in encoded.messages]
            rates.append(
                [(each.angular_velocity if kind is Imu else each.twist.twist.angular).z for each in read]
            )
        return np.array(rates[0]), np.array(rates[1])

    imu, truth = shown(imu_delay=0.5, yaw_rate_bias=0.01)
    np.testing.assert_allclose(imu[5:], truth[:-5] + 0.01, rtol=0.0, atol=1e-15)
    assert imu[0] == truth[0] + 0.01
    imu, truth = shown(yaw_rate_drift=0.001, noise_seed=3)
    walk = imu - truth
    seconds = walk[9::10]  # a sample each second, from the first on
    assert 0.0007 < np.diff(seconds).std() < 0.0013
    np.testing.assert_allclose(walk[14], 0.5 * (walk[9] + walk[19]), atol=1e-12)
    assert np.array_equal(shown(yaw_rate_drift=0.001, noise_seed=3)[0], imu)
    assert not np.array_equal(shown(yaw_rate_drift=0.001, noise_seed=4)[0], imu)


def test_the_drift_is_drawn_apart_from_the_noise() -> None:
    grid, zero = TimeGrid.of(0.01, 0.1), np.zeros((1, 2))

    def error(step: int, **errors: float) -> np.ndarray:
        sensors = Sensors(SimParameters(**errors), grid, units=2)  # type: ignore[arg-type]
        return sensors.readings([step], zero + 1.0, zero, zero, zero)["imu_yaw_rate"]

    walked = error(100, yaw_rate_drift=1.0)  # the first knot, after a second
    for step in (0, 1, 100):
        assert not np.allclose(error(step, yaw_rate_stddev=1.0), walked)
