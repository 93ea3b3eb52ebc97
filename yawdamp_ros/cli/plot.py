"""`plot`: the curves of runs."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from yawdamp_ros.cli.options import Parser
from yawdamp_ros.logs.response_reader import read_response_csv


def main(argv: Sequence[str]) -> int:
    """Run the command."""
    parser = Parser(
        "plot",
        "Steer angle, yaw, yaw rate, lateral acceleration and articulation over time, and the paths where a\n"
        "run holds them. Several runs are compared in one picture.",
        "python -m yawdamp_ros plot interlink.csv interlink_rated_tyres.csv --output comparison.svg",
    )
    parser.add_argument(
        "runs", nargs="+", metavar="RUN", help="CSV file as simulate --output FILE.csv writes it"
    )
    parser.add_argument(
        "--output",
        default="plot.png",
        metavar="FILE",
        help="PNG or SVG, by the file's name (default: plot.png)",
    )
    options = parser.parse_args(argv)
    runs = [
        (name, read_response_csv(Path(run)))
        for name, run in zip(_names(options.runs), options.runs, strict=True)
    ]
    # Here and not above: matplotlib takes longer to load than a wrong file name takes to find.
    from yawdamp_ros.pictures import save  # noqa: PLC0415
    from yawdamp_ros.pictures.runs import runs_figure  # noqa: PLC0415

    save(runs_figure(runs), options.output)
    print(options.output)
    return 0


def _names(runs: Sequence[str]) -> list[str]:
    """Short names of runs; where two would be alike, as they were given."""
    stems = Counter(Path(run).stem for run in runs)
    return [Path(run).stem if stems[Path(run).stem] == 1 else run for run in runs]
