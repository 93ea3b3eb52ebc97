"""The simulator steered by a recorded log; both end when the log does, and a log that fails is a failure."""

from pathlib import Path

from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, EmitEvent, OpaqueFunction, RegisterEventHandler
from launch.event_handlers import OnProcessExit
from launch.events import Shutdown
from launch.events.process import ProcessExited
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue


def nodes(context: LaunchContext) -> list[Node | RegisterEventHandler]:
    """Simulator and the replay node that steers it; neither where there is no such log."""

    def given(argument: str) -> str:
        return str(context.launch_configurations[argument])

    if not Path(given("log")).exists():
        message = f"log: {given('log')}: no such file or directory"
        raise FileNotFoundError(message)
    parameters: dict[str, object] = {"record": given("record").lower() == "true"}
    if given("vehicle"):
        parameters["vehicle"] = ParameterValue(given("vehicle"), value_type=str)
    if given("speed"):
        parameters["speed"] = float(given("speed"))
    files = [given("params_file")] if given("params_file") else []
    until = ["--duration", given("duration")] if given("duration") else []
    replay = Node(
        package="yawdamp_ros",
        executable="replay",
        namespace=given("namespace"),
        output="screen",
        arguments=[given("log"), "--steering-ratio", given("steering_ratio"), *until],
    )
    simulator = Node(
        package="yawdamp_ros",
        executable="sim",
        namespace=given("namespace"),
        output="screen",
        parameters=[*files, parameters],
    )
    return [
        simulator,
        replay,
        RegisterEventHandler(OnProcessExit(target_action=replay, on_exit=replayed)),
    ]


def replayed(event: ProcessExited, _context: LaunchContext) -> list[EmitEvent]:
    """End the simulator with the log; raise, which ends the launch with a failure, if the log failed."""
    if event.returncode:
        message = f"replay ended with status {event.returncode}"
        raise RuntimeError(message)
    return [EmitEvent(event=Shutdown(reason="the log has ended"))]


def generate_launch_description() -> LaunchDescription:
    """Describe a simulator node and a replay node that steers it."""
    return LaunchDescription(
        [
            DeclareLaunchArgument("log", description="CSV file, MCAP file or rosbag2 directory"),
            DeclareLaunchArgument(
                "steering_ratio", default_value="1.0", description="hand wheel over road wheel"
            ),
            DeclareLaunchArgument("vehicle", default_value="", description="builtin name or file"),
            DeclareLaunchArgument("speed", default_value="", description="in m/s; empty: the vehicle's own"),
            DeclareLaunchArgument(
                "duration", default_value="", description="of the log in s; empty: all of it"
            ),
            DeclareLaunchArgument("params_file", default_value="", description="YAML file of parameters"),
            DeclareLaunchArgument("namespace", default_value="", description="of all topics and frames"),
            DeclareLaunchArgument("record", default_value="true", description="record the run"),
            OpaqueFunction(function=nodes),
        ]
    )
