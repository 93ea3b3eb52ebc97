"""From a command line to the module of its command."""

import errno
import os
import sys
from collections.abc import Mapping, Sequence
from importlib import import_module
from io import TextIOWrapper
from types import MappingProxyType

from yawdamp_ros.cli.errors import UsageError
from yawdamp_ros.cli.program import program
from yawdamp_ros.errors import YawdampError
from yawdamp_ros.version import VERSION

COMMANDS: Mapping[str, str] = MappingProxyType(
    {
        "sim": "the simulator node: steering in, motion of every unit out, recorded",
        "replay": "publish a recorded steering log at its own pace",
        "simulate": "the same run offline, as fast as it goes",
        "resimulate": "run a recorded run again and say whether it is bit-identical",
        "stability": "modes, damping, understeer gradient, critical speed; root locus, Bode, Nyquist",
        "assess": "rearward amplification, yaw damping, offtracking against the levels of the field",
        "sweep": "a measure over ranges of parameters: curve, stability map, random vehicles",
        "compare": "simulated against measured on a recorded drive: bias, gain, lag, R2, coherence",
        "identify": "parameters of a vehicle from a recorded drive, with confidence intervals",
        "plot": "the curves of a run, or of several compared, as a picture",
        "show": "what a vehicle is: loads, hitches, tyres; given, assumed, implausible; to scale",
        "urdf": "a vehicle as URDF, for robot_state_publisher",
    }
)

WRONG_USE = 2
INTERRUPTED = 130


def run(arguments: Sequence[str]) -> int:
    """Run a command.

    Parameters
    ----------
    arguments : sequence of str
        Name of the command and its arguments.

    Returns
    -------
    int
        Exit status: 0, 1 for a negative answer, 2 for wrong use, 130 when interrupted.
    """
    prefix = " ".join([program(), *arguments[:1]])
    _make_writable()
    try:
        try:
            return _dispatch(arguments)
        finally:
            sys.stdout.flush()
    except YawdampError as error:
        print(f"{prefix}: {error}", file=sys.stderr)
        return WRONG_USE
    except KeyboardInterrupt:
        print(f"{prefix}: interrupted", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        # The reader of a pipe (head, less) has exited: not an error, and no further output is possible.
        _give_up_output()
        return 0
    except MemoryError:
        print(f"{prefix}: out of memory", file=sys.stderr)
        return WRONG_USE
    except OSError as error:
        if error.filename is not None or error.errno != errno.ENOSPC:
            raise
        _give_up_output()
        print(f"{prefix}: standard output: {error.strerror}", file=sys.stderr)
        return WRONG_USE


def _make_writable() -> None:
    """Make the streams accept any text: dropped if closed, escaped if it cannot be encoded."""
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:
            setattr(sys, name, os.fdopen(os.open(os.devnull, os.O_WRONLY), "w", encoding="utf-8"))
        elif isinstance(stream, TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")


def _give_up_output() -> None:
    """Discard buffered output: Python would try again at its exit and report a failure."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _dispatch(arguments: Sequence[str]) -> int:
    if not arguments or arguments[0] in {"-h", "--help"}:
        print(_overview())
        return 0 if arguments else WRONG_USE
    if arguments[0] == "--version":
        print(f"yawdamp_ros {VERSION}")
        return 0
    name, *rest = arguments
    if name not in COMMANDS:
        message = f"no such command; expected one of {', '.join(COMMANDS)}"
        raise UsageError(message)
    status: int = import_module(f"yawdamp_ros.cli.{name}").main(rest)
    return status


def _overview() -> str:
    width = max(map(len, COMMANDS))
    commands = "\n".join(f"  {name:{width}}  {summary}" for name, summary in COMMANDS.items())
    return (
        f"usage: {program()} COMMAND ...\n       {program()} --version\n\n"
        "Lateral dynamics of heavy vehicle combinations.\n\n"
        f"commands (each explains itself with --help):\n{commands}\n\n"
        f"example:\n  {program()} sim --vehicle interlink --manoeuvre lane_change --duration 15"
    )
