import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from yawdamp_ros.logs import LogError
from yawdamp_ros.runs.message_definitions import message_definition

TYPES = [
    "std_msgs/msg/Float64",
    "sensor_msgs/msg/Imu",
    "sensor_msgs/msg/JointState",
    "nav_msgs/msg/Odometry",
    "diagnostic_msgs/msg/DiagnosticArray",
]


@pytest.mark.parametrize("name", TYPES)
def test_a_definition_and_its_hash_are_those_of_jazzy(name: str) -> None:
    definition = message_definition(name)
    typestore = get_typestore(Stores.EMPTY)
    typestore.register(get_types_from_msg(definition.text, name))
    assert definition.type_hash == typestore.hash_rihs01(name)


def test_every_dependency_follows_once_under_its_own_name() -> None:
    text = message_definition("nav_msgs/msg/Odometry").text
    dependencies = [line[5:] for line in text.splitlines() if line.startswith("MSG: ")]
    assert dependencies == [
        "std_msgs/Header",
        "geometry_msgs/PoseWithCovariance",
        "geometry_msgs/TwistWithCovariance",
        "builtin_interfaces/Time",
        "geometry_msgs/Pose",
        "geometry_msgs/Twist",
        "geometry_msgs/Point",
        "geometry_msgs/Quaternion",
        "geometry_msgs/Vector3",
    ]
    assert text.count("=" * 80) == len(dependencies)
    assert text.endswith("\n")


def test_a_package_that_is_not_installed_is_named() -> None:
    with pytest.raises(
        LogError, match="gps_msgs/msg/GPSFix: its definition is not installed; install gps_msgs"
    ):
        message_definition("gps_msgs/msg/GPSFix")
