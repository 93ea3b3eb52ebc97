"""`urdf`: a vehicle as robot description."""

from collections.abc import Sequence
from pathlib import Path

from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.options import Parser, add_vehicle_options, chosen_vehicle
from yawdamp_ros.vehicle.urdf import urdf


def main(arguments: Sequence[str]) -> int:
    """Print the description, or write it to a file."""
    parser = Parser(
        "urdf",
        "A vehicle as URDF for robot_state_publisher: a link for every unit, a joint for every hitch and\n"
        "for the steered axle, named as in joint_states.",
        "yawdamp urdf --vehicle interlink --output interlink.urdf",
    )
    add_vehicle_options(parser)
    parser.add_argument("--output", metavar="FILE", help="default: standard output")
    options = parser.parse_args(arguments)
    text = urdf(chosen_vehicle(options))
    if options.output is None:
        print(text, end="")
        return 0
    try:
        Path(options.output).write_text(text, encoding="utf-8")
    except OSError as error:
        message = f"--output: {options.output}: cannot be written: {error.strerror}"
        raise UsageError(message) from error
    return 0
