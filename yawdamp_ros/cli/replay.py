"""`replay`: publish a recorded steering log."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from yawdamp_ros.nodes.stop_request import StopRequest

if TYPE_CHECKING:
    import argparse


def main(arguments: Sequence[str]) -> int:
    """Publish the log until it ends or a signal comes."""
    # First, because a signal may arrive while the rest is imported.
    with StopRequest() as stop:
        return _replay(arguments, stop)


def _replay(arguments: Sequence[str], stop: StopRequest) -> int:
    from yawdamp_ros.cli.errors import UsageError  # noqa: PLC0415
    from yawdamp_ros.cli.log_options import chosen_log, input_line, steering_ratio  # noqa: PLC0415
    from yawdamp_ros.cli.ros import parse_before_ros, require_ros  # noqa: PLC0415
    from yawdamp_ros.simulation.inputs import LONGITUDINAL  # noqa: PLC0415

    options, ros_arguments = parse_before_ros(_parser(), arguments)
    if not 0.0 < options.rate < float("inf"):
        message = f"--rate: {options.rate}: expected a number above 0"
        raise UsageError(message)
    ratio = steering_ratio(options)
    log = chosen_log(
        options.log, options, options.duration, lambda name: name in {"steering", *LONGITUDINAL}
    ).divided(ratio)
    if options.loop and not log.duration:
        message = "--loop: the log is of one instant"
        raise UsageError(message)
    require_ros()
    from yawdamp_ros.cli.console import progress_bar  # noqa: PLC0415
    from yawdamp_ros.nodes.graph import ros_graph, spinning  # noqa: PLC0415
    from yawdamp_ros.nodes.replay import ReplayNode  # noqa: PLC0415

    with ros_graph(ros_arguments):
        node = ReplayNode(log, options.rate, stop, publish_clock=options.clock)
        lowest, highest = min(log.angles), max(log.angles)
        print(
            f"{log.source}: {len(log.times)} samples over {log.duration:g} s, "
            f"{lowest:.4f} to {highest:.4f} rad, on {node.topic}",
            flush=True,
        )
        for name in (name for name in LONGITUDINAL if name in log.inputs):
            told = input_line(log, name)
            print(f"with {told}, for a node whose longitudinal_source is {name}", flush=True)
        with spinning(node):
            if options.wait:
                node.wait_for_subscriber()
            with progress_bar() as bar:
                task = bar.add_task("replaying", total=log.duration)
                if not stop.requested:
                    node.play(lambda at: bar.update(task, completed=at), loop=options.loop)
            node.close()
        if not stop.requested:
            print(
                f"played; the last sample {1e3 * node.lateness:.2f} ms after its time, "
                f"at worst {1e3 * node.worst_lateness:.2f} ms"
            )
    return 0


def _parser() -> "argparse.ArgumentParser":
    import argparse  # noqa: PLC0415

    from yawdamp_ros.cli.log_options import add_log_options  # noqa: PLC0415
    from yawdamp_ros.cli.options import Parser  # noqa: PLC0415

    parser = Parser(
        "replay",
        "Publish a recorded drive at its own pace: its steering on /steering, as road-wheel angles; where\n"
        "it has them, its speed on /speed and its acceleration on /acceleration.",
        "yawdamp replay drive.csv --column steering_wheel_angle_deg --steering-ratio 16.88\n"
        "  yawdamp replay runs/20261121-120000_interlink",
    )
    parser.add_argument("log", metavar="LOG", help="CSV with named columns, MCAP file or rosbag2 directory")
    parser.add_argument("--rate", type=float, default=1.0, help="times as fast as recorded; default: 1")
    parser.add_argument("--duration", type=float, metavar="S", help="of the log; default: to its end")
    parser.add_argument("--loop", action="store_true", help="start again at its end")
    parser.add_argument("--clock", action="store_true", help="publish the log's own time on /clock")
    parser.add_argument(
        "--wait",
        action=argparse.BooleanOptionalAction,
        default=True,
        help="wait for a subscriber first; default: yes",
    )
    add_log_options(parser)
    return parser
