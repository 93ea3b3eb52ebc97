import numpy as np
from nav_msgs.msg import Odometry
from rclpy.serialization import deserialize_message
from sensor_msgs.msg import JointState

from yawdamp_ros.runs.templates import Blank, Templates


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
