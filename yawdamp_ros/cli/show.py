"""`show`: a vehicle with its given, assumed and implausible values."""

from collections.abc import Sequence

from yawdamp_ros.cli import show_report
from yawdamp_ros.cli.extras import require
from yawdamp_ros.cli.options import DEFAULT_VEHICLE, Parser, add_format_option, overrides
from yawdamp_ros.vehicle import load_vehicle, suspicions


def main(arguments: Sequence[str]) -> int:
    """Run the command."""
    parser = Parser(
        "show",
        "Masses, axle loads, wheelbases, hitches and tyres of a vehicle; what its file gives of what the\n"
        "nonlinear model needs, what is assumed, from which source, and what is implausible.",
        "yawdamp show a_double --plot a_double.png",
    )
    parser.add_argument(
        "vehicle",
        nargs="?",
        default=DEFAULT_VEHICLE,
        metavar="VEHICLE",
        help=f"builtin name or file (default: {DEFAULT_VEHICLE})",
    )
    parser.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="KEY=VALUE",
        help="change it, as in units.1.mass=4156 (counted from 0); may be repeated",
    )
    add_format_option(parser)
    parser.add_argument(
        "--plot", metavar="FILE", help="draw it to scale, from the side and from above, as PNG or SVG"
    )
    parser.set_defaults(speed=None)
    options = parser.parse_args(arguments)
    vehicle = load_vehicle(options.vehicle, overrides(options))
    if options.plot:
        # Imported here: matplotlib takes longer to load than the rest takes to run.
        require("matplotlib")
        from yawdamp_ros.pictures import save  # noqa: PLC0415
        from yawdamp_ros.pictures.vehicle import vehicle_figure  # noqa: PLC0415

        save(vehicle_figure(vehicle), options.plot)
    doubts = suspicions(vehicle)
    if options.format == "json":
        show_report.print_json(vehicle, doubts)
    else:
        show_report.print_text(vehicle, doubts)
    return 0
