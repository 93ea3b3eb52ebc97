"""`plot`: the curves of runs."""

import argparse
from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.extras import require
from yawdamp_ros.cli.options import (
    Parser,
    add_manoeuvre_options,
    add_vehicle_options,
    chosen_vehicle,
    manoeuvre_settings,
)
from yawdamp_ros.cli.peaks_table import print_events
from yawdamp_ros.logs import is_recording
from yawdamp_ros.runs import read_response_csv, read_response_recording
from yawdamp_ros.runs.recorded_vehicle import recorded_vehicle
from yawdamp_ros.stepping import Response, TimeGrid

STEP_SIZE, SAMPLE_PERIOD = 0.001, 0.01
"""Step and sample period of the runs that --models makes [s]."""
KINDS = (".png", ".svg", ".html")


def main(argv: Sequence[str]) -> int:
    """Run the command."""
    parser = Parser(
        "plot",
        "Steer angle, yaw, yaw rate, lateral acceleration and articulation over time, and the paths where a\n"
        "run holds them. Several runs are compared in one picture.",
        "yawdamp plot runs/20261121-120000_interlink --output run.html\n"
        "  yawdamp plot interlink.csv interlink_rated_tyres.csv --output comparison.svg\n"
        "  yawdamp plot runs/20261121-120000_interlink --swept --output swept.png\n"
        "  yawdamp plot --models consistent,nonlinear --manoeuvre lane_change --amplitude 0.05",
    )
    parser.add_argument(
        "runs",
        nargs="*",
        metavar="RUN",
        help="run directory, its MCAP file, or CSV file as simulate --output FILE.csv writes it",
    )
    parser.add_argument(
        "--output",
        default="plot.png",
        metavar="FILE",
        help="PNG, SVG or an HTML page to zoom into, by the file's name (default: plot.png)",
    )
    parser.add_argument(
        "--models",
        metavar="NAME,NAME",
        help="in place of runs: one manoeuvre of one vehicle by several models, laid over each other",
    )
    parser.add_argument(
        "--swept",
        action="store_true",
        help="of one run: what its bodies sweep, to scale; a CSV file takes --vehicle besides",
    )
    parser.add_argument("--duration", type=float, metavar="S", help="of that manoeuvre; default: 15")
    add_vehicle_options(parser, ())
    add_manoeuvre_options(parser)
    options = parser.parse_args(argv)
    kind = Path(options.output).suffix.lower()
    if kind not in KINDS:
        message = f"--output: {options.output}: expected a name ending in {', '.join(KINDS)}"
        raise UsageError(message)
    require("plotly" if kind == ".html" else "matplotlib")
    if options.swept:
        _draw_swept(options)
        print(options.output)
        return 0
    runs = _by_models(options) if options.models else _recorded(options)
    _draw(runs, options.output, kind)
    print(options.output)
    return 0


def _draw_swept(options: argparse.Namespace) -> None:
    """Draw the area that the bodies of one run sweep."""
    if len(options.runs) != 1 or options.models or Path(options.output).suffix.lower() == ".html":
        message = "--swept: expected one RUN, and a picture as PNG or SVG"
        raise UsageError(message)
    from yawdamp_ros.pictures import save  # noqa: PLC0415 - as below
    from yawdamp_ros.pictures.swept import swept_figure  # noqa: PLC0415

    path = Path(options.runs[0])
    if options.vehicle is not None:
        vehicle = chosen_vehicle(options)
    elif is_recording(path):
        vehicle = recorded_vehicle(path)
    else:
        message = "--swept: a CSV file does not hold its vehicle: expected --vehicle"
        raise UsageError(message)
    save(swept_figure(path.stem, _read(path), vehicle), options.output)


def _recorded(options: argparse.Namespace) -> list[tuple[str, Response]]:
    """Runs that were given, each with its name."""
    if not options.runs:
        message = "no run; expected RUN, or --models with a manoeuvre"
        raise UsageError(message)
    given = [
        name for name in ("vehicle", "speed", "duration", "manoeuvre") if getattr(options, name) is not None
    ]
    if given or options.set or manoeuvre_settings(options):
        message = f"--{given[0] if given else 'set'}: a run holds its own; it goes with --models"
        raise UsageError(message)
    return [(name, _read(Path(run))) for name, run in zip(_names(options.runs), options.runs, strict=True)]


def _by_models(options: argparse.Namespace) -> list[tuple[str, Response]]:
    """The same manoeuvre by every model."""
    from yawdamp_ros.manoeuvres import make_manoeuvre  # noqa: PLC0415
    from yawdamp_ros.simulation import MODELS, simulate  # noqa: PLC0415 - not needed by recorded runs

    if options.runs or options.manoeuvre is None:
        message = "--models: expected --manoeuvre NAME and no RUN"
        raise UsageError(message)
    runs = []
    for model in options.models.split(","):
        if model not in MODELS:
            message = f"--models: {model!r}: expected names of {', '.join(MODELS)}"
            raise UsageError(message)
        duration = 15.0 if options.duration is None else options.duration
        steering, vehicle = (
            make_manoeuvre(options.manoeuvre, manoeuvre_settings(options)),
            chosen_vehicle(options),
        )
        response = simulate(
            vehicle, steering, duration, step_size=STEP_SIZE, sample_period=SAMPLE_PERIOD, model=model
        )
        print_events(response.events, TimeGrid.of(STEP_SIZE, SAMPLE_PERIOD), f"{model}: ")
        runs.append((f"{vehicle.name}, {model}", response))
    return runs


def _draw(runs: Sequence[tuple[str, Response]], output: str, kind: str) -> None:
    # Imported here: a wrong file name is reported before the drawing library has loaded.
    if kind == ".html":
        from yawdamp_ros.pictures.page import save_page  # noqa: PLC0415
        from yawdamp_ros.pictures.runs_page import runs_page  # noqa: PLC0415

        save_page(runs_page(runs), output)
    else:
        from yawdamp_ros.pictures import save  # noqa: PLC0415
        from yawdamp_ros.pictures.runs import runs_figure  # noqa: PLC0415

        save(runs_figure(runs), output)


def _read(path: Path) -> Response:
    return read_response_recording(path) if is_recording(path) else read_response_csv(path)


def _names(runs: Sequence[str]) -> list[str]:
    """Short names of runs; the given ones if two would be equal."""
    stems = Counter(Path(run).stem for run in runs)
    return [Path(run).stem if stems[Path(run).stem] == 1 else run for run in runs]
