"""What the simulator says of itself, once a second."""

from typing import NamedTuple

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from yawdamp_ros.nodes.neighbours import Neighbourhood
from yawdamp_ros.stepping.time_grid import SECOND

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


class Readings(NamedTuple):
    """What is true of the simulator at one look; counts are since its start.

    Attributes
    ----------
    samples : int
        Published.
    rate_wanted : float
        Samples a second of real time; 0 where there is no such rate.
    worst_lateness : float
        Since the last look, s.
    steps_given_up : int
    simulated_time : float
        In s.
    paused : bool
    steering_silence : float or None
        In s of simulated time; None before the first command.
    steering_timed_out : bool
    steering_source : str
        ``topic`` or the name of the manoeuvre.
    refused : dict of str to int
        Commands and speeds that were refused or clamped, by reason.
    neighbourhood : Neighbourhood
        Who publishes on the inputs.
    recorder : str
        ``recording``, ``idle`` or ``failed: ...``.
    messages_lost : int
        By the recorder.
    least_damping_ratio : float
    speed : float
        In m/s.
    """

    samples: int
    rate_wanted: float
    worst_lateness: float
    steps_given_up: int
    simulated_time: float
    paused: bool
    steering_silence: float | None
    steering_timed_out: bool
    steering_source: str
    refused: dict[str, int]
    neighbourhood: Neighbourhood
    recorder: str
    messages_lost: int
    least_damping_ratio: float
    speed: float


class Diagnosis:
    """Turns readings into diagnostics: counts that grew since the last look are what warns.

    Parameters
    ----------
    node_name : str
    vehicle_name : str
    """

    def __init__(self, node_name: str, vehicle_name: str) -> None:
        self._node_name = node_name
        self._vehicle_name = vehicle_name
        self._before: Readings | None = None

    def of(self, readings: Readings, elapsed: float, stamp: int) -> DiagnosticArray:
        """Diagnostics of this look.

        Parameters
        ----------
        readings : Readings
        elapsed : float
            Time since the last look in s.
        stamp : int
            In ns.
        """
        before = self._before or readings._replace(samples=0, refused={}, messages_lost=0, steps_given_up=0)
        self._before = readings
        array = DiagnosticArray()
        array.header.stamp.sec, array.header.stamp.nanosec = divmod(stamp, SECOND)
        array.status = [
            self._timing(readings, before, elapsed),
            self._steering(readings, before),
            self._recorder(readings, before),
            self._model(readings),
        ]
        return array

    def _timing(self, now: Readings, before: Readings, elapsed: float) -> DiagnosticStatus:
        achieved = (now.samples - before.samples) / elapsed if elapsed else 0.0
        given_up = now.steps_given_up - before.steps_given_up
        level, message = OK, "paused" if now.paused else "in time"
        if given_up:
            level, message = WARN, f"{given_up} steps given up since the last look"
        wanted = f"{now.rate_wanted:.2f} Hz" if now.rate_wanted else "as fast as it goes"
        return self._status(
            "timing",
            level,
            message,
            achieved_rate=f"{achieved:.2f} Hz",
            wanted_rate="paused" if now.paused else wanted,
            worst_lateness=f"{1e3 * now.worst_lateness:.3f} ms",
            steps_given_up=str(now.steps_given_up),
            simulated_time=f"{now.simulated_time:.9g} s",
        )

    def _steering(self, now: Readings, before: Readings) -> DiagnosticStatus:
        grown = [reason for reason, count in now.refused.items() if count > before.refused.get(reason, 0)]
        troubles = list(now.neighbourhood.problems)
        message = f"steered by {now.steering_source}"
        if grown:
            troubles.append(f"since the last look: {', '.join(grown)}")
        elif now.steering_timed_out:
            troubles.append("no command for longer than steering_timeout")
        elif now.steering_source == "topic" and now.steering_silence is None:
            message = "no command yet"
        age = "none yet" if now.steering_silence is None else f"{now.steering_silence:.3f} s"
        return self._status(
            "steering",
            WARN if troubles else OK,
            "; ".join(troubles) or message,
            age=age,
            publishers=str(now.neighbourhood.publishers),
            **{reason.replace(" ", "_"): str(count) for reason, count in now.refused.items()},
        )

    def _recorder(self, now: Readings, before: Readings) -> DiagnosticStatus:
        level, message = OK, now.recorder
        if now.recorder.startswith("failed"):
            level = ERROR
        elif now.messages_lost > before.messages_lost:
            level, message = ERROR, "the disk does not keep up"
        return self._status("recorder", level, message, messages_lost=str(now.messages_lost))

    def _model(self, now: Readings) -> DiagnosticStatus:
        stable = now.least_damping_ratio > 0.0
        return self._status(
            "model",
            OK if stable else WARN,
            "stable" if stable else "unstable: a mode grows",
            least_damping_ratio=f"{now.least_damping_ratio:.4f}",
            speed=f"{now.speed:.6g} m/s",
        )

    def _status(self, part: str, level: bytes, message: str, **values: str) -> DiagnosticStatus:
        return DiagnosticStatus(
            level=level,
            name=f"{self._node_name}: {part}",
            message=message,
            hardware_id=self._vehicle_name,
            values=[KeyValue(key=key, value=value) for key, value in values.items()],
        )
