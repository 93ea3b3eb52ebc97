"""`plot`: the curves of runs."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from yawdamp_ros.cli.options import Parser
from yawdamp_ros.logs import is_recording
from yawdamp_ros.logs.response_reader import read_response_csv
from yawdamp_ros.logs.response_recording import read_response_recording
from yawdamp_ros.stepping import Response


def main(argv: Sequence[str]) -> int:
    """Run the command."""
    parser = Parser(
        "plot",
        "Steer angle, yaw, yaw rate, lateral acceleration and articulation over time, and the paths where a\n"
        "run holds them. Several runs are compared in one picture.",
        "python -m yawdamp_ros plot runs/20261121-120000_interlink --output run.png\n"
        "  python -m yawdamp_ros plot interlink.csv interlink_rated_tyres.csv --output comparison.svg",
    )
    parser.add_argument(
        "runs",
        nargs="+",
        metavar="RUN",
        help="run directory, its MCAP file, or CSV file as simulate --output FILE.csv writes it",
    )
    parser.add_argument(
        "--output",
        default="plot.png",
        metavar="FILE",
        help="PNG or SVG, by the file's name (default: plot.png)",
    )
    options = parser.parse_args(argv)
    runs = [(name, _read(Path(run))) for name, run in zip(_names(options.runs), options.runs, strict=True)]
    # Here and not above: matplotlib takes longer to load than a wrong file name takes to find.
    from yawdamp_ros.pictures import save  # noqa: PLC0415
    from yawdamp_ros.pictures.runs import runs_figure  # noqa: PLC0415

    save(runs_figure(runs), options.output)
    print(options.output)
    return 0


def _read(path: Path) -> Response:
    return read_response_recording(path) if is_recording(path) else read_response_csv(path)


def _names(runs: Sequence[str]) -> list[str]:
    """Short names of runs; where two would be alike, as they were given."""
    stems = Counter(Path(run).stem for run in runs)
    return [Path(run).stem if stems[Path(run).stem] == 1 else run for run in runs]
