"""The simulator, for a truck that drives itself or is steered over the graph."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare


def generate_launch_description() -> LaunchDescription:
    """Describe one simulator node and, if wanted, RViz beside it."""
    return LaunchDescription(
        [
            DeclareLaunchArgument("vehicle", default_value="interlink", description="builtin name or file"),
            DeclareLaunchArgument("manoeuvre", default_value="none", description="steering of its own"),
            DeclareLaunchArgument("record", default_value="true", description="record the run"),
            DeclareLaunchArgument("rviz", default_value="false", description="show the units in RViz"),
            Node(
                package="yawdamp_ros",
                executable="sim",
                output="screen",
                parameters=[
                    {
                        "vehicle": LaunchConfiguration("vehicle"),
                        "manoeuvre.name": LaunchConfiguration("manoeuvre"),
                        "record": ParameterValue(LaunchConfiguration("record"), value_type=bool),
                        "publish_markers": ParameterValue(LaunchConfiguration("rviz"), value_type=bool),
                    }
                ],
            ),
            Node(
                package="rviz2",
                executable="rviz2",
                condition=IfCondition(LaunchConfiguration("rviz")),
                arguments=[
                    "-d",
                    PathJoinSubstitution([FindPackageShare("yawdamp_ros"), "config", "yawdamp.rviz"]),
                ],
            ),
        ]
    )
