"""`sim`: the simulator node."""

import gc
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from yawdamp_ros.nodes.stop_request import StopRequest

if TYPE_CHECKING:
    import argparse
    from pathlib import Path

    from rclpy.node import Node

    from yawdamp_ros.nodes.sim import Simulator


def main(arguments: Sequence[str]) -> int:
    """Run the node until its duration is over or a signal comes."""
    # First, because a signal may arrive while the rest is imported.
    with StopRequest() as stop, _uncollected():
        return _sim(arguments, stop)


@contextmanager
def _uncollected() -> Iterator[None]:
    """Suspend garbage collection before the node runs: it takes long, and imports stay anyway."""
    gc.disable()
    try:
        yield
    finally:
        gc.enable()


def _sim(arguments: Sequence[str], stop: StopRequest) -> int:
    from yawdamp_ros.cli.errors import UsageError  # noqa: PLC0415
    from yawdamp_ros.cli.ros import parse_before_ros, require_ros  # noqa: PLC0415

    options, ros_arguments = parse_before_ros(_parser(), arguments)
    if options.no_record and options.output is not None:
        message = "--output: there is no recording with --no-record"
        raise UsageError(message)
    require_ros()
    from yawdamp_ros.nodes.graph import join, ros_graph  # noqa: PLC0415
    from yawdamp_ros.nodes.parameter_files import parameter_files  # noqa: PLC0415

    with ros_graph(ros_arguments):
        node = join("yawdamp_sim", _overrides(options))
        # DDS takes 0.1 s to discover the graph: the rest loads meanwhile.
        from yawdamp_ros.nodes.sim import Simulator  # noqa: PLC0415

        simulator = Simulator(node)
        try:
            served, dropped = _run(node, simulator, stop, parameter_files(ros_arguments))
        finally:
            simulator.close()
        _report(simulator, dropped)
    return 0 if served and simulator.flawless else 1


def _run(
    node: "Node", simulator: "Simulator", stop: StopRequest, files: "Sequence[Path]"
) -> tuple[bool, int]:
    """Serve the node; return whether its ROS context outlived it, and the steps that it dropped."""
    if stop.requested:
        return True, 0
    from yawdamp_ros.nodes.graph import spin  # noqa: PLC0415
    from yawdamp_ros.nodes.parameter_files import misfit  # noqa: PLC0415
    from yawdamp_ros.nodes.server import Server  # noqa: PLC0415

    simulator.publish_first()
    for path in files:
        if problem := misfit(path, node.get_fully_qualified_name()):
            node.get_logger().warning(problem)
    with _progress(simulator) as progress:
        gc.freeze()  # existing objects are never garbage
        gc.enable()
        server = Server(node, simulator)
        return spin(node, stop, lambda: simulator.finished, progress), server.steps_dropped


@contextmanager
def _progress(simulator: "Simulator") -> Iterator[Callable[[], None]]:
    """Yield a function that shows the progress of a run with a known end."""
    if not simulator.settings.duration:
        yield lambda: None
        return
    # Imported late: neither the first sample nor the clock waits for it.
    from yawdamp_ros.cli.console import progress_bar  # noqa: PLC0415

    with progress_bar() as bar:
        task = bar.add_task("simulating", total=simulator.settings.duration)
        yield lambda: bar.update(task, completed=simulator.run.time)


def _report(simulator: "Simulator", dropped: int) -> None:
    from yawdamp_ros.cli.peaks_table import print_events, print_peaks  # noqa: PLC0415

    print_peaks(simulator.model, simulator.peaks, simulator.range.sentence)
    print_events(simulator.run.events, simulator.grid)
    if dropped:
        lost = simulator.grid.seconds(dropped)
        print(f"late: {dropped} steps dropped, {lost:g} s behind the steady clock")
    if simulator.run.stopped:
        print(f"stopped at {simulator.run.time:g} s: {simulator.run.stopped.reason}")
    if simulator.recorder.directory is not None:
        print(f"run: {simulator.recorder.directory}")


def _parser() -> "argparse.ArgumentParser":
    from yawdamp_ros.cli.options import (  # noqa: PLC0415
        Parser,
        add_manoeuvre_options,
        add_run_settings,
        add_vehicle_options,
    )
    from yawdamp_ros.simulation import MODELS  # noqa: PLC0415

    parser = Parser(
        "sim",
        "The simulator node: steering in on /steering, the motion of every unit out, recorded. Every\n"
        "parameter of the node can also follow --ros-args.",
        "yawdamp sim --vehicle interlink --manoeuvre lane_change --duration 15\n"
        "  ros2 run yawdamp_ros sim --ros-args -p vehicle:=interlink -p publish_rate:=50.0",
    )
    add_vehicle_options(parser, MODELS)
    add_manoeuvre_options(parser)
    add_run_settings(parser)
    run = parser.add_argument_group("run")
    run.add_argument("--duration", type=float, metavar="S", help="simulated time; default: until Ctrl-C")
    run.add_argument("--step-size", type=float, metavar="S", help="default: 0.001")
    run.add_argument("--publish-rate", type=float, metavar="HZ", help="default: 100")
    run.add_argument("--output", metavar="DIRECTORY", help="of the run; default: runs/<stamp>_<vehicle>")
    run.add_argument("--no-record", action="store_true", help="do not record")
    return parser


def _overrides(options: "argparse.Namespace") -> dict[str, Any]:
    """Node parameters of the options; the others are left to --ros-args."""
    from yawdamp_ros.cli.options import manoeuvre_settings, run_settings  # noqa: PLC0415

    given: dict[str, Any] = {
        "vehicle": options.vehicle,
        "vehicle_overrides": options.set or None,
        "model": options.model,
        "speed": options.speed,
        "manoeuvre.name": options.manoeuvre,
        "duration": options.duration,
        "step_size": options.step_size,
        "publish_rate": options.publish_rate,
        "record_directory": options.output,
        "record": False if options.no_record else None,
        **run_settings(options),
        **{f"manoeuvre.{name}": value for name, value in manoeuvre_settings(options).items()},
    }
    return {name: value for name, value in given.items() if value is not None}
