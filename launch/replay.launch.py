"""The simulator steered by a recorded log; both end when the log does."""

from launch import LaunchDescription
from launch.actions import DeclareLaunchArgument, EmitEvent, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.events import Shutdown
from launch.substitutions import LaunchConfiguration
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def generate_launch_description() -> LaunchDescription:
    """Describe a simulator node and a replay node that steers it."""
    replay = Node(
        package="yawdamp_ros",
        executable="replay",
        output="screen",
        arguments=[LaunchConfiguration("log"), "--steering-ratio", LaunchConfiguration("steering_ratio")],
    )
    return LaunchDescription(
        [
            DeclareLaunchArgument("log", description="CSV file, MCAP file or rosbag2 directory"),
            DeclareLaunchArgument(
                "steering_ratio", default_value="1.0", description="hand wheel over road wheel"
            ),
            DeclareLaunchArgument("vehicle", default_value="interlink", description="builtin name or file"),
            DeclareLaunchArgument("record", default_value="true", description="record the run"),
            Node(
                package="yawdamp_ros",
                executable="sim",
                output="screen",
                parameters=[
                    {
                        "vehicle": LaunchConfiguration("vehicle"),
                        "record": ParameterValue(LaunchConfiguration("record"), value_type=bool),
                    }
                ],
            ),
            replay,
            RegisterEventHandler(OnProcessExit(target_action=replay, on_exit=[EmitEvent(event=Shutdown())])),
        ]
    )
