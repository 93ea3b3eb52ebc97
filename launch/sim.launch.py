"""The simulator, for a truck that drives itself or is steered over the graph."""

from launch.actions import DeclareLaunchArgument
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue

from launch import LaunchDescription


def generate_launch_description() -> LaunchDescription:
    """Describe one simulator node."""
    return LaunchDescription(
        [
            DeclareLaunchArgument("vehicle", default_value="interlink", description="builtin name or file"),
            DeclareLaunchArgument("manoeuvre", default_value="none", description="steering of its own"),
            DeclareLaunchArgument("record", default_value="true", description="record the run"),
            Node(
                package="yawdamp_ros",
                executable="sim",
                output="screen",
                parameters=[
                    {
                        "vehicle": LaunchConfiguration("vehicle"),
                        "manoeuvre": LaunchConfiguration("manoeuvre"),
                        "record": ParameterValue(LaunchConfiguration("record"), value_type=bool),
                    }
                ],
            ),
        ]
    )
