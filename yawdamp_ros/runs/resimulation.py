"""Resimulation of a recorded run from its own contents, compared value by value."""

import json
import struct
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import fields, replace
from itertools import chain, groupby
from pathlib import Path
from typing import Any

import numpy as np
from rclpy.serialization import deserialize_message

from yawdamp_ros.logs import LogError, McapLog, RecordedMessage
from yawdamp_ros.runs.csv_resimulation import TOLERANCE
from yawdamp_ros.runs.deviations import Deviations, Difference, quantity
from yawdamp_ros.runs.encoder import TWISTS, Encoded, Encoder, Jump, message_class
from yawdamp_ros.runs.jumps import jump_of
from yawdamp_ros.runs.recorded_vehicle import METADATA_NAME, vehicle_of
from yawdamp_ros.simulation import Run, SimParameters, make_motion
from yawdamp_ros.stepping import AppliedInput, Command, Event, TimeGrid
from yawdamp_ros.stepping.build import build_of_numerics
from yawdamp_ros.stepping.stamps import Stamps

SHORTEST_STEP = 1000
"""Shortest step [ns], as for the node."""

MOST_STEPS = 10_000_000
"""Limit on the steps between samples, as for the node at its shortest step and lowest rate."""

Value = float | int | str | bool


class Resimulation:
    """A run and its repetition.

    Everything is taken from the run itself: the vehicle, the model, the step, and the inputs with the steps
    at which they took effect.

    Parameters
    ----------
    path : Path
        Run directory or its MCAP file, finished or cut off.

    Attributes
    ----------
    duration : float
        Simulated time compared [s].
    samples, messages, values : int
        Number of samples, messages and values compared.
    difference : Difference or None
        First difference.
    bit_identical : bool
        Whether every value compared so far agrees to the last bit.
    promised : bool
        Whether bit-identity is promised: the run comes from this kind of machine and this numerical build.
    recorded_build, build : str
        Build that made the run, and this build.

    Raises
    ------
    LogError
        If it is no run, or lacks data for the repetition.
    """

    def __init__(self, path: Path) -> None:
        self._log = McapLog(path)
        self._messages = self._log.messages()
        # The metadata that explains a run precedes its first message.
        self._first = next(self._messages, None)
        try:
            known = self._log.metadata[METADATA_NAME]
            vehicle = vehicle_of(self._log, path)
            self._grid = TimeGrid(int(known["step_ns"]), int(known["steps_per_sample"]))
            if not (self._grid.step_ns >= SHORTEST_STEP and 1 <= self._grid.steps_per_sample <= MOST_STEPS):
                message = f"steps of {self._grid.step_ns} ns, {self._grid.steps_per_sample} a sample"
                raise ValueError(message)  # noqa: TRY301 - it is one of many ways not to be a run
            start_time = int(known["start_time_ns"])
            self._stamps = Stamps(self._grid.step_ns, start_time)
            self._jump_topic = known.get("jump_topic", "")
            self._inputs = {topic: name for name, topic in json.loads(known["input_topics"]).items()}
            self._topics: Mapping[str, str] = dict(json.loads(known["output_topics"]))
            if not self._topics:
                message = "no outputs"
                raise ValueError(message)  # noqa: TRY301 - as below
            self.recorded_build = known["build"]
            motion = make_motion(vehicle, known["model"], float(known["speed"]), self._grid.step_size)
            initial = json.loads(known["initial"])
            motion.restore(initial)
            self._encoder = Encoder(
                motion,
                self._settings(dict(json.loads(known["parameters"]))),
                self._grid,
                start_time,
                twist=known.get("twist", TWISTS[-1]),
                surge=known.get("surge", "") == "true",
            )
            self._encoder.sensors.history = json.loads(known.get("imu_history", "[]"))
            self._encoder.sinks.append(self)
            self._source = _Recorded(motion.steering_angle)
            self._run = Run(motion, self._grid, self._source, [self._encoder])
            self._begun = bool(initial["sampled"])
            if self._begun:  # the recording continues after a sample that it does not hold
                self._encoder.go_on_from(motion.step, motion.steering_angle)
        except Exception as error:  # invalid texts may raise anything
            why = self._log.warning or error
            raise LogError(path, f"not a run of this package, or not a whole one: {why}") from error
        self.build = build_of_numerics()
        self.promised = self.build == self.recorded_build
        self.duration = 0.0
        self.samples = self.messages = self.values = 0
        self.difference: Difference | None = None
        self.bit_identical = True
        self._value_counts: dict[str, int] = {}
        self._deviations = Deviations()
        self._recorded: Mapping[str, bytes] = {}

    @property
    def agrees(self) -> bool:
        """True if values were compared and all keep the promise."""
        return self.difference is None and self.samples > 0

    @property
    def warning(self) -> str:
        """Defect of the file, though this much could be read; else empty."""
        return self._log.warning

    def compare(self) -> Iterator[float]:
        """Run and compare to the end, or to the first difference.

        Yields
        ------
        float
            Simulated time of each sample [s].

        Raises
        ------
        LogError
            If a message is not what its topic says, or nothing that a model could follow.
        """
        try:
            yield from self._compared()
        except Exception as error:  # the libraries may raise anything for bad bytes
            raise LogError(
                self._log.path, f"cannot be run again beyond {self.duration:g} s: {error}"
            ) from error

    def write(self, encoded: Encoded) -> None:
        """Compare a sample of the repetition with the recorded one of its instant; see `EncodedSink`."""
        for name, data in zip(encoded.names, encoded.messages[0], strict=True):
            # Outputs added after the version that recorded the run are not in it.
            if self.difference is None and name in self._topics:
                self._compare(self._topics[name], self._encoder.types[name], data)

    def tell(self, events: Sequence[tuple[int, Event]]) -> None:
        """See `EncodedSink`; events follow from the motion, and are not compared."""

    def close(self) -> None:
        """See `EncodedSink`."""

    def _compared(self) -> Iterator[float]:
        run, source = self._run, self._source
        due = run.motion.step + (self._grid.steps_per_sample if self._begun else 0)
        for step, jump, inputs, recorded in self._instants():
            if jump:
                self._encoder.jump(Jump(step, jump))
            if step > due or (recorded and step != due):
                missing = self._grid.seconds(due)
                self._part(Difference("every output", missing, "", "no sample", "a sample"))
                return
            source.add(inputs)
            if not recorded:
                continue
            self._recorded = recorded
            self.duration = self._grid.seconds(step)
            with np.errstate(all="ignore"):  # overflow gives NaN, and so a difference
                if step == run.motion.step:
                    run.start()
                else:
                    run.advance()
            if self.difference is not None:
                return
            due += self._grid.steps_per_sample
            self.samples += 1
            yield self.duration
        if self._deviations.found:
            self.difference = self._deviations.first_beyond(TOLERANCE, self._sizes())

    def _settings(self, parameters: Mapping[str, Any]) -> SimParameters:
        """Settings that affect the messages; earlier versions wrote other ones, too."""
        shown = [
            field.name
            for field in fields(SimParameters)
            if field.name.endswith(("_stddev", "_bias", "_drift"))
            or field.name in {"noise_seed", "imu_delay", "frame_prefix"}
        ]
        return replace(
            SimParameters(),
            publish_scalars=any(name.endswith("/yaw") for name in self._topics),
            **{name: parameters[name] for name in shown if name in parameters},
        )

    def _instants(self) -> Iterator[tuple[int, int, list[AppliedInput], dict[str, bytes]]]:
        """Step, jump of stamps [ns], inputs, and outputs by topic, of every recorded instant."""
        topics = frozenset(self._topics.values())
        messages = chain([self._first] if self._first is not None else [], self._messages)
        for log_time, group in groupby(messages, key=lambda message: message.log_time):
            instant = list(group)
            jump = sum(jump_of(message.data) for message in instant if message.topic == self._jump_topic)
            self._stamps.jump(jump)
            step = self._stamps.at(log_time)
            inputs, outputs = [], {}
            for message in instant:
                if message.topic in self._inputs:
                    inputs.append(self._applied(message, step))
                elif message.topic in topics:
                    outputs[message.topic] = message.data
            if self.warning:  # the last instant of a truncated run may be incomplete
                return
            yield step, jump, inputs, outputs

    def _applied(self, message: RecordedMessage, step: int) -> AppliedInput:
        name: Any = self._inputs[message.topic]
        # An Empty has no value; a Float64 in CDR is four bytes of header and the number.
        value = 0.0 if name == "reset" else struct.unpack_from("<d", message.data, 4)[0]
        return AppliedInput(step, name, value)

    def _compare(self, topic: str, type_name: str, repeated: bytes) -> None:
        recorded, kind = self._recorded, message_class(type_name)
        if topic not in recorded:
            self._part(Difference(topic, self.duration, "", "no message", "a message"))
            return
        self.messages += 1
        if topic not in self._value_counts:
            self._value_counts[topic] = sum(1 for _ in _values(deserialize_message(repeated, kind)))
        self.values += self._value_counts[topic]
        # Equal bytes are equal values. Different bytes may also be equal values: padding holds old memory.
        if recorded[topic] == repeated:
            return
        pairs = zip(
            _values(deserialize_message(recorded[topic], kind)),
            _values(deserialize_message(repeated, kind)),
            strict=True,
        )
        for (field, one), (_, other) in pairs:
            if not self._same(topic, field, one, other):
                self.difference = Difference(topic, self.duration, field, repr(one), repr(other))
                return

    def _part(self, difference: Difference) -> None:
        self.difference = difference
        self.bit_identical = False

    def _same(self, topic: str, field: str, one: Value, other: Value) -> bool:
        if not isinstance(one, float) or not isinstance(other, float):
            return one == other
        if struct.pack("<d", one) == struct.pack("<d", other):
            return True
        self.bit_identical = False
        self._deviations.note(topic, self.duration, field, one, other)
        return not self.promised

    def _sizes(self) -> dict[str, float]:
        """Largest magnitude of every quantity over the run."""
        kinds = {
            self._topics[name]: message_class(kind)
            for name, kind in self._encoder.types.items()
            if name in self._topics
        }
        sizes: dict[str, float] = {}
        for message in McapLog(self._log.path).messages():
            if message.topic in kinds:
                for field, value in _values(deserialize_message(message.data, kinds[message.topic])):
                    if isinstance(value, float):
                        key = quantity(message.topic, field)
                        sizes[key] = max(sizes.get(key, 0.0), abs(value))
        return sizes


def _values(message: Any, path: str = "") -> Iterator[tuple[str, Value]]:  # noqa: ANN401 - generated
    """Every value of a message with its path."""
    if hasattr(message, "get_fields_and_field_types"):
        for name in message.get_fields_and_field_types():
            yield from _values(getattr(message, name), f"{path}.{name}" if path else name)
    elif hasattr(message, "tolist"):
        yield from _values(message.tolist(), path)
    elif isinstance(message, list):
        for index, value in enumerate(message):
            yield from _values(value, f"{path}[{index}]")
    else:
        yield path, message


class _Recorded:
    """Source of a repeated run: inputs with the steps at which they took effect.

    Parameters
    ----------
    steering_angle : float
        Steering angle in force before the first of them [rad].
    """

    def __init__(self, steering_angle: float) -> None:
        self._angle = steering_angle
        self._steering: deque[AppliedInput] = deque()
        self._others: list[AppliedInput] = []

    def add(self, inputs: Sequence[AppliedInput]) -> None:
        """Schedule inputs for their steps."""
        for applied in inputs:
            (self._steering if applied.name == "steering" else self._others).append(applied)

    def inputs(self, _steps: range) -> Sequence[AppliedInput]:
        """See `Source`."""
        others, self._others = self._others, []
        return others

    def steering(self, steps: range) -> Sequence[float]:
        """See `Source`."""
        angles = np.empty(len(steps))
        begin = 0
        while self._steering:
            applied = self._steering.popleft()
            end = applied.step - steps.start
            angles[begin:end] = self._angle
            self._angle, begin = applied.value, max(end, 0)
        angles[begin:] = self._angle
        return angles  # type: ignore[return-value]

    def received(self) -> tuple[Command, ...]:
        """See `Source`."""
        return ()
