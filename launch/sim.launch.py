"""The simulator, for a truck that drives itself or is steered over the graph."""

from launch import LaunchContext, LaunchDescription
from launch.actions import DeclareLaunchArgument, OpaqueFunction
from launch.conditions import IfCondition
from launch.substitutions import LaunchConfiguration, PathJoinSubstitution
from launch_ros.actions import Node
from launch_ros.parameter_descriptions import ParameterValue
from launch_ros.substitutions import FindPackageShare

STRINGS = {"vehicle": "vehicle", "manoeuvre": "manoeuvre.name", "steering_type": "steering_type"}
NUMBERS = {"speed": "speed", "duration": "duration", "real_time_factor": "real_time_factor"}
"""Parameters by launch argument; one that is empty is left to the parameter file and the node."""


def simulator(context: LaunchContext) -> list[Node]:
    """Simulator node with the parameters that were given."""

    def given(argument: str) -> str:
        return str(context.launch_configurations[argument])

    parameters: dict[str, object] = {
        name: ParameterValue(given(argument), value_type=str)
        for argument, name in STRINGS.items()
        if given(argument)
    }
    parameters |= {name: float(given(argument)) for argument, name in NUMBERS.items() if given(argument)}
    for argument in ("record", "publish_markers"):
        source = "rviz" if argument == "publish_markers" else argument
        parameters[argument] = given(source).lower() == "true"
    files = [given("params_file")] if given("params_file") else []
    return [
        Node(
            package="yawdamp_ros",
            executable="sim",
            namespace=given("namespace"),
            output="screen",
            parameters=[*files, parameters],
        )
    ]


def rviz(context: LaunchContext) -> list[Node]:
    """RViz, with the ground frame of the simulator."""
    namespace = context.launch_configurations["namespace"].strip("/")
    use_sim_time = context.launch_configurations["use_sim_time"].lower() == "true"
    configuration = PathJoinSubstitution([FindPackageShare("yawdamp_ros"), "config", "yawdamp.rviz"])
    return [
        Node(
            package="rviz2",
            executable="rviz2",
            namespace=namespace,
            parameters=[{"use_sim_time": use_sim_time}],
            arguments=["-d", configuration, "-f", f"{namespace}/odom" if namespace else "odom"],
        )
    ]


def generate_launch_description() -> LaunchDescription:
    """Describe one simulator node and, if wanted, RViz beside it."""
    arguments = {
        "vehicle": ("", "builtin name or file; empty: the node's default"),
        "manoeuvre": ("", "steering of its own; empty: steered on the topic"),
        "steering_type": ("", "message type of the steering topic"),
        "speed": ("", "in m/s; empty: the vehicle's own"),
        "duration": ("", "simulated time in s after which it ends; empty: never"),
        "real_time_factor": ("", "simulated over real time"),
        "params_file": ("", "YAML file of parameters; arguments given here win"),
        "namespace": ("", "of all topics and, as a prefix, of the frames"),
        "record": ("true", "record the run"),
        "rviz": ("false", "show the units in RViz"),
        "use_sim_time": ("false", "let RViz go by /clock, which comes with another real_time_factor"),
    }
    return LaunchDescription(
        [
            *(
                DeclareLaunchArgument(name, default_value=default, description=description)
                for name, (default, description) in arguments.items()
            ),
            OpaqueFunction(function=simulator),
            OpaqueFunction(function=rviz, condition=IfCondition(LaunchConfiguration("rviz"))),
        ]
    )
