import numpy as np
import pytest
from rclpy.serialization import deserialize_message
from rosbags.typesys import Stores, get_typestore
from sensor_msgs.msg import JointState

from yawdamp_ros import load_vehicle
from yawdamp_ros.runs.encoder import Encoder
from yawdamp_ros.runs.recipe import recorded_messages
from yawdamp_ros.simulation import SimParameters, make_motion
from yawdamp_ros.stepping import AppliedInput, Command, TimeGrid

TYPES = get_typestore(Stores.ROS2_JAZZY)


@pytest.mark.parametrize("names", [[], ["a"], ["steering", "b", "cd"]])
@pytest.mark.parametrize("velocity", [0.0, 0.2])
def test_a_joint_state_is_recorded_as_it_came_and_every_reader_reads_it(
    names: list[str], velocity: float
) -> None:
    message = JointState(name=names, position=[0.1] * len(names))
    if velocity:
        message.velocity = [velocity] * len(names)
    message.header.frame_id = "abc"
    motion = make_motion(load_vehicle("interlink"), "consistent", None, 0.001)
    encoder = Encoder(motion, SimParameters(), TimeGrid.of(0.001, 0.01), start_time=0)
    sample = motion.sample()._replace(commands=(Command(0, 0.1, message),))
    (name, stamp, data), *others = recorded_messages(encoder.encoded(sample))
    assert (name, stamp) == ("steering", 0)
    assert deserialize_message(data, JointState) == message
    read = TYPES.deserialize_cdr(data, "sensor_msgs/msg/JointState")
    np.testing.assert_array_equal(read.position, message.position)
    assert [other[0] for other in others[:2]] == ["speed", "steering_applied"]


def test_what_led_to_a_sample_comes_before_it_in_the_order_of_time() -> None:
    motion = make_motion(load_vehicle("interlink"), "consistent", None, 0.001)
    encoder = Encoder(motion, SimParameters(), TimeGrid.of(0.001, 0.01), start_time=5)
    motion.sample()
    motion.apply(AppliedInput(0, "reset", 0.0))
    sample = motion.run([0.0] * 4 + [0.1] * 16, 10)._replace(commands=(Command(5, 0.1), Command(17, 0.3)))
    found = [
        (name, (stamp - 5) // 1_000_000) for name, stamp, _ in recorded_messages(encoder.encoded(sample))
    ]
    led = [entry for entry in found if entry[0] in {"reset", "steering", "steering_applied"}]
    assert led == [("reset", 0), ("steering", 5), ("steering_applied", 5), ("steering", 17)]
    assert [step for _, step in found] == sorted(step for _, step in found)
