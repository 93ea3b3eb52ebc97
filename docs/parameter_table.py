"""Parameters, inputs and outputs as tables of the manual; `make parameters` writes config/sim.yaml."""

import math
import sys
from pathlib import Path

from yawdamp_ros.runs.outputs import OUTPUTS, Of, available
from yawdamp_ros.simulation import make_motion
from yawdamp_ros.simulation.inputs import INPUTS
from yawdamp_ros.simulation.settings import PARAMETERS, SimParameters
from yawdamp_ros.simulation.steering_messages import STEERING_TYPES
from yawdamp_ros.vehicle import load_vehicle

ROOT = Path(__file__).parents[1]
HEAD = "| parameter | default | |\n|---|---|---|\n"
INPUT_HEAD = "| topic | type | meaning |\n|---|---|---|\n"
OUTPUT_HEAD = "| topic | type | meaning |\n|---|---|---|\n"
OTHER_TOPICS = """\
| `/diagnostics` | diagnostic_msgs/DiagnosticArray | once a second: timing, inputs, recorder, model, events |
| `events` | diagnostic_msgs/DiagnosticStatus | what happens to the vehicle: name and where; nonlinear model |
| `/clock` | rosgraph_msgs/Clock | simulated time, if `real_time_factor` is not 1 or `publish_clock` is true |
| `markers` | visualization_msgs/MarkerArray | the units as boxes, if `publish_markers` is true |
| `/tf` | tf2_msgs/TFMessage | `odom`, the units and their hitches, if tf2_msgs is installed |
"""
FILE_HEAD = """\
# Parameters of the simulator node, with their defaults:
#   ros2 run yawdamp_ros sim --ros-args --params-file sim.yaml
# A number must be written as declared: 100.0, not 100. .nan is a number that was not given.
/**:
  ros__parameters:
"""


def input_table() -> str:
    """Table of the topics that the node subscribes to, in Markdown."""
    kinds = ", ".join(kind.replace("/msg/", "/") for kind in STEERING_TYPES)
    angle = "road-wheel steer angle, left positive, divided by `steering_ratio`, rad"
    rows = [f"| `steering` | by `steering_type`: {kinds} | {angle} |\n"]
    linear = make_motion(load_vehicle("interlink"), "consistent", None, 0.001)
    for each in INPUTS:
        of_model = "" if each.topic in linear.input_names else "nonlinear model: "
        unit = each.unit.replace("^2", "²")
        described = f"{of_model}{each.description}, {unit}, {each.low:g} to {each.high:g}"
        rows.append(f"| `{each.topic}` | std_msgs/Float64 | {described} |\n")
    return INPUT_HEAD + "".join(rows)


def output_table() -> str:
    """Table of the topics that the node publishes, in Markdown."""
    rows = []
    for output in OUTPUTS:
        if output.type_name:
            names = {Of.RUN: "{}", Of.UNIT: "<unit>/{}", Of.JOINT: "{}_<joint>"}
            described = ", ".join(filter(None, [output.description, output.unit.replace("^2", "²")]))
            described += "" if output in available(()) else "; nonlinear model"
            kind = output.type_name.replace("/msg/", "/")
            rows.append(f"| `{names[output.of].format(output.name)}` | {kind} | {described} |\n")
    return OUTPUT_HEAD + "".join(rows) + OTHER_TOPICS


def table() -> str:
    """Table of the parameters in Markdown."""
    return f"{HEAD}{_rows()}"


def parameter_file() -> str:
    """Text of config/sim.yaml."""
    lines = []
    groups: set[str] = set()
    for name, declared in PARAMETERS.items():
        group, _, key = name.rpartition(".")
        if group and group not in groups:
            groups.add(group)
            lines.append(f"    {group}:\n")
        indent = "      " if group else "    "
        default = getattr(SimParameters(), declared.name)
        # What follows from other parameters unless given would be given if it were written.
        value = (
            f"{indent}{key}: {_yaml(default)}" if not declared.metadata["otherwise"] else f"{indent}# {key}:"
        )
        lines.append(f"{value:<42}# {declared.metadata['description']}\n")
    return FILE_HEAD + "".join(lines)


def main() -> int:
    """Write config/sim.yaml."""
    (ROOT / "config" / "sim.yaml").write_text(parameter_file(), encoding="utf-8")
    return 0


def _rows() -> str:
    rows = []
    for name, declared in PARAMETERS.items():
        default = declared.metadata["otherwise"] or _yaml(getattr(SimParameters(), declared.name))
        described = declared.metadata["description"]
        if declared.metadata["choices"]:
            described += f" ({', '.join(declared.metadata['choices'])})"
        if declared.metadata["dynamic"]:
            described += "; *while running*"
        rows.append(f"| `{name}` | {default} | {described} |")
    return "\n".join(rows)


def _yaml(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, float) and math.isnan(value):
        return ".nan"
    return '[""]' if value == [""] else str(value) or '""'


if __name__ == "__main__":
    sys.exit(main())
