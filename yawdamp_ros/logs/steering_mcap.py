"""Steering logs in recordings: found by topic or by type, decoded by the definitions in the file."""

import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from yawdamp_ros.logs.channel_names import named
from yawdamp_ros.logs.errors import LogError
from yawdamp_ros.logs.mcap_log import McapLog, MessageDecoder, RecordedMessage
from yawdamp_ros.logs.steering_log import LARGEST_ANGLE, SteeringLog
from yawdamp_ros.simulation.steering_messages import STEERING_TYPES, message_stamp
from yawdamp_ros.stepping.time_grid import SECOND

LATEST = 2**31 * SECOND
"""Largest stamp [ns]: its seconds have 32 bits."""


def read_steering_mcap(
    path: Path, topic: str | None = None, *, joint: str = "steering", degrees: bool = False
) -> SteeringLog:
    """Read a steering log from an MCAP file or a rosbag2 directory.

    Parameters
    ----------
    path : Path
        Finished, or cut off: then it is read up to where it breaks, and the log says so.
    topic : str, optional
        Unless given, the one topic of a type in `STEERING_TYPES`; of several, the one whose name
        contains ``steer``.
    joint : str
        Joint that steers, where the type is JointState.
    degrees : bool
        Whether the angles are in degrees.

    Returns
    -------
    SteeringLog
        Timed by the stamps in the messages, or by the time they were recorded where they have none.

    Raises
    ------
    LogError
        If there is no such topic, several fit, or a value is none.

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros.logs import read_steering_mcap
    >>> list(read_steering_mcap(Path("steering_run")).angles)
    [0.02]
    """
    log = McapLog(path)
    found: dict[str, list[RecordedMessage]] = {}
    topics: dict[str, str] = {}
    for message in log.messages():
        topics[message.topic] = message.type_name
        if message.type_name in STEERING_TYPES and topic in {None, message.topic}:
            found.setdefault(message.topic, []).append(message)
    chosen = steering_topic(topic, topics, path, log.warning)
    return steering_log(path, chosen, found[chosen], joint, degrees=degrees, warning=log.warning)


def steering_topic(topic: str | None, topics: Mapping[str, str], path: Path, warning: str) -> str:
    """Return the requested topic, else the one that fits.

    A topic whose name says another quantity, such as ``yaw_rate``, does not.

    Raises
    ------
    LogError
        If there is no such topic, or several fit.
    """
    fitting = [name for name, kind in topics.items() if kind in STEERING_TYPES]
    if topic is not None:
        if topic not in topics:
            raise LogError(path, f"{topic}: no such topic; expected one of {_listed(fitting or topics)}")
        if topic not in fitting:
            raise LogError(path, f"{topic}: {topics[topic]}: expected one of {', '.join(STEERING_TYPES)}")
        return topic
    fitting = [name for name in fitting if named(name) is None]
    so_named = [name for name in fitting if "steer" in name.rpartition("/")[2].lower()]
    # A run of the node holds the commanded and the applied steering.
    exactly = [name for name in so_named if name.rpartition("/")[2] == "steering"]
    for candidates in (exactly, so_named, fitting):
        if len(candidates) == 1:
            return candidates[0]
    if not fitting:
        why = f"; {warning}" if warning else ""
        raise LogError(path, f"no steering in it; its topics: {_listed(topics) or 'none'}{why}")
    raise LogError(
        path, f"several topics could be steering; name one with --topic: {_listed(so_named or fitting)}"
    )


def steering_log(  # noqa: PLR0913 - it gathers what was found
    path: Path,
    topic: str,
    found: Sequence[RecordedMessage],
    joint: str,
    *,
    degrees: bool,
    warning: str,
) -> SteeringLog:
    """Steering log of the messages of a topic, in the order of their log times.

    Raises
    ------
    LogError
        If a value is none.
    """
    messages = sorted(found, key=lambda message: message.log_time)
    decode = MessageDecoder()
    scale = math.pi / 180.0 if degrees else 1.0
    stamps: list[int] = []
    angles: list[float] = []
    for index, message in enumerate(messages):
        where = f"{topic}: message {index + 1}"
        decoded = decode(message)
        try:
            angle = STEERING_TYPES[message.type_name](decoded, joint)
            stamp = message_stamp(decoded) or message.log_time
        except (AttributeError, TypeError, ValueError, OverflowError) as error:
            raise LogError(path, f"{where}: not the {message.type_name} that is known") from error
        if angle is None:
            raise LogError(path, f"{where}: no joint {joint!r} with a position; name one with --joint")
        if not math.isfinite(angle):
            raise LogError(path, f"{where}: {angle}: expected a finite angle")
        if abs(angle) * scale > LARGEST_ANGLE:
            raise LogError(path, f"{where}: {angle}: expected an angle within {LARGEST_ANGLE:g} rad")
        if stamp >= LATEST:
            raise LogError(path, f"{where}: {stamp} ns: expected a time that ROS can hold, before 2038")
        if stamps and stamp < stamps[-1]:
            raise LogError(path, f"{where}: time goes back by {(stamps[-1] - stamp) / SECOND:g} s")
        stamps.append(stamp)
        angles.append(scale * angle)
    # Divided, not multiplied: so a time is the same float as that of a step at the same nanosecond.
    times = [(stamp - stamps[0]) / SECOND for stamp in stamps]
    return SteeringLog(str(path), times, angles, start_time=stamps[0], warning=warning)


def _listed(names: Any, limit: int = 12) -> str:  # noqa: ANN401 - any names
    shown = ", ".join(list(names)[:limit])
    return shown if len(names) <= limit else f"{shown}, ..."
