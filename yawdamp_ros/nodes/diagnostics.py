"""Diagnostics of the simulator, published once a second."""

from collections.abc import Mapping
from typing import NamedTuple

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue

from yawdamp_ros.nodes.neighbours import Neighbourhood
from yawdamp_ros.nodes.states import (
    RECORDER_SENTENCES,
    VERDICT_SENTENCES,
    EventState,
    InputState,
    ModelState,
    RecorderState,
    SteeringState,
    TimingState,
)
from yawdamp_ros.stepping import Verdict
from yawdamp_ros.stepping.time_grid import SECOND

OK, WARN, ERROR = DiagnosticStatus.OK, DiagnosticStatus.WARN, DiagnosticStatus.ERROR


class InputReading(NamedTuple):
    """State of an input besides steering.

    Attributes
    ----------
    value : float or None
        Value in force; None if nothing is demanded.
    age : float or None
        Simulated time since the last one [s]; None before the first.
    counts : mapping of Verdict to int
        Values so far by verdict.
    timed_out : bool
        Whether a controller that repeated it has fallen silent.
    """

    value: float | None
    age: float | None
    counts: Mapping[Verdict, int]
    timed_out: bool = False


class Readings(NamedTuple):
    """State of the simulator at one instant; counts are since its start.

    Attributes
    ----------
    samples : int
        Published.
    rate_wanted : float
        Samples a second of real time; 0 where there is no such rate.
    worst_lateness : float
        Since the last look [s].
    steps_dropped : int
    simulated_time : float
        Simulated time [s].
    paused : bool
    steering_age : float or None
        Simulated time since the last command [s]; None before the first.
    steering_timed_out : bool
    manoeuvre : str
        Name of the manoeuvre that steers; empty where the topic does.
    commands : mapping of Verdict to int
        Steering commands by verdict.
    inputs : mapping of str to InputReading
        Inputs besides steering, by topic.
    neighbourhood : Neighbourhood
        Publishers of the inputs.
    recorder : RecorderState
    recorder_detail : str
        Directory of the recording, or the reason that there is none.
    messages_lost : int
        Number of messages that the recorder lost.
    least_damping_ratio : float
    beyond : str
        Excess of the linear range since the last report; empty if there is none.
    speed : float
        Speed [m/s].
    callback_failures : int
        Number of callbacks of the node that ended in an error.
    events : tuple of str
        Events of the vehicle so far, each with its simulated time.
    """

    samples: int
    rate_wanted: float
    worst_lateness: float
    steps_dropped: int
    simulated_time: float
    paused: bool
    steering_age: float | None
    steering_timed_out: bool
    manoeuvre: str
    commands: Mapping[Verdict, int]
    inputs: Mapping[str, InputReading]
    neighbourhood: Neighbourhood
    recorder: RecorderState
    recorder_detail: str
    messages_lost: int
    least_damping_ratio: float
    beyond: str
    speed: float
    callback_failures: int = 0
    events: tuple[str, ...] = ()


class Diagnosis:
    """Turns readings into diagnostics: a count that grew since the last reading warns.

    Each status holds the key of its ``state``; the sentence in ``message`` is made from it last.

    Parameters
    ----------
    node_name : str
    vehicle_name : str
    steering_topic : str
        Fully qualified.
    """

    def __init__(self, node_name: str, vehicle_name: str, steering_topic: str = "/steering") -> None:
        self._steering_topic = steering_topic
        self._node_name = node_name
        self._vehicle_name = vehicle_name
        self._before: Readings | None = None

    def of(self, readings: Readings, elapsed: float, stamp: int) -> DiagnosticArray:
        """Return the diagnostics of this reading.

        Parameters
        ----------
        readings : Readings
        elapsed : float
            Time since the last look [s].
        stamp : int
            Time stamp [ns].

        Returns
        -------
        DiagnosticArray
        """
        before = self._before or readings._replace(
            samples=0,
            commands={},
            inputs={},
            messages_lost=0,
            steps_dropped=0,
            callback_failures=0,
            events=(),
        )
        self._before = readings
        array = DiagnosticArray()
        array.header.stamp.sec, array.header.stamp.nanosec = divmod(stamp, SECOND)
        array.status = [
            self._timing(readings, before, elapsed),
            self._steering(readings, before),
            self._inputs(readings, before),
            self._recorder(readings, before),
            self._model(readings),
            self._events(readings, before),
        ]
        return array

    def _timing(self, now: Readings, before: Readings, elapsed: float) -> DiagnosticStatus:
        achieved = (now.samples - before.samples) / elapsed if elapsed else 0.0
        dropped = now.steps_dropped - before.steps_dropped
        state = TimingState.PAUSED if now.paused else TimingState.IN_TIME
        message = "paused" if now.paused else "in time"
        if dropped:
            state, message = TimingState.STEPS_DROPPED, f"{dropped} steps dropped since the last look"
        failed = now.callback_failures - before.callback_failures
        if failed:
            state, message = TimingState.CALLBACK_FAILED, f"{failed} callbacks failed since the last look"
        wanted = f"{now.rate_wanted:.2f} Hz" if now.rate_wanted else "as fast as it goes"
        return self._status(
            "timing",
            WARN if dropped or failed else OK,
            message,
            state=state,
            achieved_rate=f"{achieved:.2f} Hz",
            wanted_rate="paused" if now.paused else wanted,
            worst_lateness=f"{1e3 * now.worst_lateness:.3f} ms",
            steps_dropped=str(now.steps_dropped),
            callback_failures=str(now.callback_failures),
            simulated_time=f"{now.simulated_time:.9g} s",
        )

    def _steering(self, now: Readings, before: Readings) -> DiagnosticStatus:
        commands = _grown(now.commands, before.commands)
        found = [each for each in now.neighbourhood.findings if each.topic in {"", self._steering_topic}]
        state, message, troubles = _steered(now)
        grown = [f"steering {VERDICT_SENTENCES[verdict]}" for verdict in commands]
        troubles += [finding.sentence for finding in found]
        troubles += [f"since the last look: {'; '.join(grown)}"] if grown else []
        age = "none yet" if now.steering_age is None else f"{now.steering_age:.3f} s"
        return self._status(
            "steering",
            WARN if troubles else OK,
            "; ".join(troubles) or message,
            state=state,
            problems=",".join(dict.fromkeys([*(finding.problem for finding in found), *commands])),
            age=age,
            publishers=str(now.neighbourhood.publishers),
            **{verdict: str(count) for verdict, count in now.commands.items()},
        )

    def _inputs(self, now: Readings, before: Readings) -> DiagnosticStatus:
        found = [each for each in now.neighbourhood.findings if each.topic not in {"", self._steering_topic}]
        troubles = [finding.sentence for finding in found]
        problems: list[str] = [finding.problem for finding in found]
        told, grown = {}, []
        for name, reading in now.inputs.items():
            value = "none" if reading.value is None else f"{reading.value:.6g}"
            told[name] = value if reading.age is None else f"{value}, {reading.age:.3f} s ago"
            told |= {f"{name}_{verdict}": str(count) for verdict, count in reading.counts.items() if count}
            for verdict in _grown(
                reading.counts, before.inputs[name].counts if name in before.inputs else {}
            ):
                grown.append(f"{name} {VERDICT_SENTENCES[verdict]}")
                problems.append(f"{name}_{verdict}")
        silent = [name for name, reading in now.inputs.items() if reading.timed_out]
        troubles += [f"{name}: no command for longer than steering_timeout" for name in silent]
        problems += [f"{name}_timed_out" for name in silent]
        troubles += [f"since the last look: {'; '.join(grown)}"] if grown else []
        commanded = any(reading.age is not None for reading in now.inputs.values())
        state = InputState.COMMANDED if commanded else InputState.NO_COMMAND
        state = InputState.TIMED_OUT if silent else state
        return self._status(
            "inputs",
            WARN if troubles else OK,
            "; ".join(troubles) or ("commanded" if commanded else "no command yet"),
            state=state,
            problems=",".join(dict.fromkeys(problems)),
            **told,
        )

    def _recorder(self, now: Readings, before: Readings) -> DiagnosticStatus:
        state, message = now.recorder, RECORDER_SENTENCES[now.recorder].format(now.recorder_detail)
        if state is not RecorderState.FAILED and now.messages_lost > before.messages_lost:
            state, message = RecorderState.DROPPING, RECORDER_SENTENCES[RecorderState.DROPPING]
        level = ERROR if state in {RecorderState.FAILED, RecorderState.DROPPING} else OK
        return self._status("recorder", level, message, state=state, messages_lost=str(now.messages_lost))

    def _model(self, now: Readings) -> DiagnosticStatus:
        state, message = ModelState.STABLE, "stable"
        if now.beyond:
            state, message = ModelState.BEYOND_LINEAR_RANGE, now.beyond
        elif now.least_damping_ratio <= 0.0:
            state, message = ModelState.UNSTABLE, "unstable: a mode grows"
        return self._status(
            "model",
            OK if state is ModelState.STABLE else WARN,
            message,
            state=state,
            least_damping_ratio=f"{now.least_damping_ratio:.4f}",
            speed=f"{now.speed:.6g} m/s",
        )

    def _events(self, now: Readings, before: Readings) -> DiagnosticStatus:
        new = now.events[len(before.events) :]
        return self._status(
            "events",
            WARN if new else OK,
            "; ".join(new) or "nothing since the last look",
            state=EventState.HAPPENED if new else EventState.NOTHING,
            count=str(len(now.events)),
            last=now.events[-1] if now.events else "",
        )

    def _status(self, part: str, level: bytes, message: str, **values: str) -> DiagnosticStatus:
        return DiagnosticStatus(
            level=level,
            name=f"{self._node_name}: {part}",
            message=message,
            hardware_id=self._vehicle_name,
            values=[KeyValue(key=key, value=str(value)) for key, value in values.items()],
        )


def _grown(now: Mapping[Verdict, int], before: Mapping[Verdict, int]) -> list[Verdict]:
    """Verdicts, other than acceptance, whose counts have grown."""
    return [
        verdict
        for verdict, count in now.items()
        if verdict is not Verdict.ACCEPTED and count > before.get(verdict, 0)
    ]


def _steered(now: Readings) -> tuple[SteeringState, str, list[str]]:
    """State of the steering, its sentence without a fault, and its faults."""
    if now.manoeuvre:
        return SteeringState.MANOEUVRE, f"steered by the manoeuvre {now.manoeuvre}", []
    if now.steering_age is None:
        return SteeringState.NO_COMMAND, "no command yet", []
    if now.steering_timed_out:
        return SteeringState.TIMED_OUT, "", ["no command for longer than steering_timeout"]
    return SteeringState.COMMANDED, "steered by the topic", []
