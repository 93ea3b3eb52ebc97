import numpy as np
import pytest
from geometry_msgs.msg import Quaternion
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import Imu, JointState

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.nodes.messages import Noise, OutputMessages
from yawdamp_ros.nodes.templates import Blank, Templates
from yawdamp_ros.stepping import Stepper


def test_what_is_filled_in_is_what_a_reader_reads() -> None:
    odometry = Odometry(child_frame_id="truck")
    odometry.header.frame_id = "odom"
    joints = JointState(name=["a", "b"], position=[0.0, 0.0])
    templates = Templates(
        [
            Blank(odometry, {"pose.pose.position.x": 0, "twist.twist.angular.z": 1}),
            Blank(joints, {"position.1": 0}),
        ]
    )
    stamps = [1_700_000_000_123_456_789, 5]
    values = np.array([[1.5, -2.5], [np.pi, 1e-300]])
    for (first, second), stamp, row in zip(templates.filled(values, stamps), stamps, values, strict=True):
        read, joint = deserialize_message(first, Odometry), deserialize_message(second, JointState)
        assert (read.pose.pose.position.x, read.twist.twist.angular.z) == tuple(row)
        assert joint.position.tolist() == [0.0, row[0]]
        assert (read.header.frame_id, read.child_frame_id) == ("odom", "truck")
        assert joint.name == ["a", "b"]
        for message in (read, joint):
            assert message.header.stamp.sec * 10**9 + message.header.stamp.nanosec == stamp


@pytest.mark.parametrize("name", ["single_vehicle", "truck_trailer", "interlink"])
@pytest.mark.parametrize("noise", [Noise(), Noise(0.01, 0.02, 0.3, 7)])
def test_messages_of_many_instants_are_those_of_each(name: str, noise: Noise) -> None:
    model = linear_model(load_vehicle(name))
    angles = 0.05 * np.sin(np.arange(1, 401) / 90)
    stamps = [10_000_000 * (index + 1) for index in range(40)]
    one, many = (
        OutputMessages(model.vehicle.unit_names, publish_scalars=True, noise=noise) for _ in range(2)
    )
    stepper = Stepper(model, 0.001)
    each = [
        one.serialised(stepper.run(angles[10 * index : 10 * index + 10]), [stamp])[0]
        for index, stamp in enumerate(stamps)
    ]
    together = many.serialised(Stepper(model, 0.001).run(angles, 10), stamps)
    # Decoded, as padding between fields holds whatever was there.
    for found, expected in zip(together, each, strict=True):
        for data, other, kind in zip(found, expected, one.types.values(), strict=True):
            assert deserialize_message(data, kind) == deserialize_message(other, kind)


def test_orientation_is_the_yaw_and_noise_is_on_imu_alone() -> None:
    model = linear_model(load_vehicle("truck_trailer"))
    noise = Noise(0.01, 0.0, 0.0, 3)
    messages = OutputMessages(model.vehicle.unit_names, publish_scalars=True, noise=noise)
    sample = Stepper(model, 0.01).run([0.2] * 1500)  # more than a turn
    [data] = messages.serialised(sample, [0])
    by_topic = dict(zip(messages.types, data, strict=True))

    def yaw(orientation: Quaternion) -> complex:
        return complex(orientation.w, orientation.z) ** 2

    drawn = noise.of_step(1500, 2)[0]
    assert abs(sample.yaw[0]) > 2.0 * np.pi
    for unit, name in enumerate(model.vehicle.unit_names):
        odometry = deserialize_message(by_topic[f"{name}/odom"], Odometry)
        imu = deserialize_message(by_topic[f"{name}/imu"], Imu)
        exact = np.exp(1j * sample.yaw[unit])
        assert yaw(odometry.pose.pose.orientation) == pytest.approx(exact, abs=1e-13)
        assert yaw(imu.orientation) == pytest.approx(exact * np.exp(1j * drawn[unit]), abs=1e-13)
        assert imu.angular_velocity.z == sample.yaw_rate[unit]
