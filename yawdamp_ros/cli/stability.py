"""`stability`: the modes of a vehicle, and their dependence on parameters."""

import argparse
from collections.abc import Sequence

from yawdamp_ros.analysis import TransferFunction, eigenvalue_locus, parse_variation, transfer_function
from yawdamp_ros.cli import severity_report, stability_report
from yawdamp_ros.cli.console import progress_of
from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.extras import require
from yawdamp_ros.cli.options import (
    DEFAULT_MODEL,
    Parser,
    add_format_option,
    add_vehicle_options,
    chosen_model,
    chosen_name,
    chosen_vehicle,
    overrides,
)
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.simulation import MODELS

PICTURES = {"bode": "Bode diagram", "nyquist": "Nyquist diagram", "root_locus": "root locus under feedback"}


def main(argv: Sequence[str]) -> int:
    """Run the command; 1 if the vehicle is unstable."""
    options = _parser().parse_args(argv)
    if options.model == "nonlinear":
        return _severity(options)
    for name in severity_report.CONDITIONS:
        if getattr(options, name) is not None:
            message = f"--{name}: only --model nonlinear depends on it"
            raise UsageError(message)
    if options.plot and not options.vary:
        message = (
            "--plot: it draws what --vary gives; the pictures of --output are --bode, --nyquist, --root-locus"
        )
        raise UsageError(message)
    if options.vary:
        return _vary(options)
    if _wants_picture(options):
        require("matplotlib", "control")
    model = chosen_model(options)
    function = _transfer_function(options, model)
    if function:
        _draw(options, function)
    answer = stability_report.assess(model)
    if options.format == "json":
        stability_report.print_json(answer, function)
    else:
        stability_report.print_text(answer, function)
    return 0 if answer.stable else 1


def _severity(options: argparse.Namespace) -> int:
    for name in ("vary", "output", *PICTURES):
        if getattr(options, name):
            message = f"--{name.replace('_', '-')}: not with --model nonlinear; expected --turn"
            raise UsageError(message)
    return severity_report.run(options)


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        "stability",
        "Modes, damping, frequencies, understeer gradient, static gains and critical speed of a vehicle.\n"
        "Exit status: 0 if it is stable, 1 if it is not, 2 for wrong use; 0 with --vary.",
        "yawdamp stability --vehicle interlink --vary speed=5:35:31 --plot locus.png",
    )
    add_vehicle_options(parser, MODELS)
    add_format_option(parser)
    severity_report.add_conditions(parser)
    group = parser.add_argument_group("over a parameter")
    group.add_argument(
        "--vary",
        metavar="KEY=A:B:N",
        help="eigenvalues and boundaries of stability over N values of a key, as in speed=5:35:31 or "
        "units.1.mass=4156:36000:33; keys separated by commas vary together",
    )
    group.add_argument("--plot", metavar="FILE", help="draw that locus, or the turns, as PNG or SVG")
    group = parser.add_argument_group("transfer function from the steer angle")
    group.add_argument(
        "--output",
        metavar="NAME",
        help="poles, zeros and static gain to an output, as truck/yaw_rate or articulation_1 "
        "(for pictures: the lead unit's yaw rate unless given)",
    )
    for picture, name in PICTURES.items():
        group.add_argument(
            f"--{picture.replace('_', '-')}",
            metavar="FILE",
            help=f"draw its {name} as PNG or SVG (needs python-control)",
        )
    return parser


def _wants_picture(options: argparse.Namespace) -> bool:
    return any(getattr(options, picture) for picture in PICTURES)


def _transfer_function(options: argparse.Namespace, model: LinearModel) -> TransferFunction | None:
    if options.output is None and not _wants_picture(options):
        return None
    return transfer_function(model, options.output or f"{model.vehicle.unit_names[0]}/yaw_rate")


def _draw(options: argparse.Namespace, function: TransferFunction) -> None:
    if not _wants_picture(options):
        return
    # Imported here: matplotlib takes longer to load than the rest takes to run.
    from yawdamp_ros.pictures import save  # noqa: PLC0415
    from yawdamp_ros.pictures.transfer import bode_figure, nyquist_figure, root_locus_figure  # noqa: PLC0415

    figures = {"bode": bode_figure, "nyquist": nyquist_figure, "root_locus": root_locus_figure}
    for picture, figure in figures.items():
        path = getattr(options, picture)
        if path:
            save(figure(function), path)


def _vary(options: argparse.Namespace) -> int:
    if options.output or _wants_picture(options):
        message = "--vary: not together with --output, --bode, --nyquist or --root-locus"
        raise UsageError(message)
    if options.plot:
        require("matplotlib")
    variation = parse_variation(options.vary)
    chosen_vehicle(options)  # warns of implausible values, whichever key varies
    models = variation.models(chosen_name(options), overrides(options), options.model or DEFAULT_MODEL)
    locus = eigenvalue_locus(models, variation.values, progress_of("varying"))
    first = models(variation.values[0])
    if options.plot:
        from yawdamp_ros.pictures import save  # noqa: PLC0415
        from yawdamp_ros.pictures.eigenvalues import locus_figure  # noqa: PLC0415

        save(locus_figure(locus, variation.label), options.plot)
    if options.format == "json":
        stability_report.print_locus_json(first, variation.keys, locus)
    else:
        stability_report.print_locus_text(first, variation.keys, locus)
    return 0
