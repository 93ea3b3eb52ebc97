"""`plot`: the curves of runs."""

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.extras import require
from yawdamp_ros.cli.options import Parser
from yawdamp_ros.logs import is_recording
from yawdamp_ros.runs import read_response_csv, read_response_recording
from yawdamp_ros.stepping import Response

KINDS = (".png", ".svg", ".html")


def main(argv: Sequence[str]) -> int:
    """Run the command."""
    parser = Parser(
        "plot",
        "Steer angle, yaw, yaw rate, lateral acceleration and articulation over time, and the paths where a\n"
        "run holds them. Several runs are compared in one picture.",
        "yawdamp plot runs/20261121-120000_interlink --output run.html\n"
        "  yawdamp plot interlink.csv interlink_rated_tyres.csv --output comparison.svg",
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
        help="PNG, SVG or an HTML page to zoom into, by the file's name (default: plot.png)",
    )
    options = parser.parse_args(argv)
    kind = Path(options.output).suffix.lower()
    if kind not in KINDS:
        message = f"--output: {options.output}: expected a name ending in {', '.join(KINDS)}"
        raise UsageError(message)
    require("plotly" if kind == ".html" else "matplotlib")
    runs = [(name, _read(Path(run))) for name, run in zip(_names(options.runs), options.runs, strict=True)]
    _draw(runs, options.output, kind)
    print(options.output)
    return 0


def _draw(runs: Sequence[tuple[str, Response]], output: str, kind: str) -> None:
    # Here and not above: what draws takes longer to load than a wrong file name takes to find.
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
    """Short names of runs; where two would be alike, as they were given."""
    stems = Counter(Path(run).stem for run in runs)
    return [Path(run).stem if stems[Path(run).stem] == 1 else run for run in runs]
