"""A recorded run, run again from what it contains, and compared value by value."""

import json
import struct
from collections.abc import Iterator, Mapping
from itertools import chain, groupby
from pathlib import Path
from typing import Any

import numpy as np
from rclpy.serialization import deserialize_message

from yawdamp_ros.analysis.repetition import TOLERANCE
from yawdamp_ros.dynamics import linear_model
from yawdamp_ros.logs import LogError, McapLog, RecordedMessage
from yawdamp_ros.nodes.deviations import Deviations, Difference, quantity
from yawdamp_ros.nodes.messages import TWISTS, Noise, OutputMessages
from yawdamp_ros.nodes.recording import METADATA_NAME, VEHICLE_FILE
from yawdamp_ros.stepping import AppliedInput, Snapshot, Stepper
from yawdamp_ros.stepping.build import build_of_numerics
from yawdamp_ros.stepping.time_grid import SECOND
from yawdamp_ros.vehicle import parse_vehicle

SHORTEST_STEP = 1000
"""In ns, as for the node."""

MOST_STEPS = 10_000_000
"""Steps from one sample to the next, as for the node: at its shortest step and its lowest rate."""

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
        Simulated time compared, in s.
    samples, messages, values : int
        How much was compared.
    difference : Difference or None
        The first one.
    bit_identical : bool
        Whether every value compared so far is the same to the last bit.
    promised : bool
        Whether bit-identity is: the run is of this kind of machine and this build of the numerics.
    recorded_build, build : str
        The build it is of, and this one.

    Raises
    ------
    LogError
        If it is no run, or does not hold what is needed.
    """

    def __init__(self, path: Path) -> None:
        self._log = McapLog(path)
        self._messages = self._log.messages()
        # What explains a run comes before its first message.
        self._first = next(self._messages, None)
        try:
            known = self._log.metadata[METADATA_NAME]
            vehicle = parse_vehicle(
                self._log.attachments[VEHICLE_FILE].decode(),
                str(path),
                json.loads(known["vehicle_overrides"]),
            )
            self._model = linear_model(vehicle, float(known["speed"]), known["model"])
            self._step_ns, self._start_time = int(known["step_ns"]), int(known["start_time_ns"])
            self._inputs = {topic: name for name, topic in json.loads(known["input_topics"]).items()}
            self._steps_per_sample = int(known["steps_per_sample"])
            self._outputs: Mapping[str, str] = json.loads(known["output_topics"])
            self._initial = Snapshot(**json.loads(known["initial"]))
            parameters = json.loads(known["parameters"])
            self._noise = Noise(
                parameters.get("yaw_stddev", 0.0),
                parameters.get("yaw_rate_stddev", 0.0),
                parameters.get("lateral_acceleration_stddev", 0.0),
                parameters.get("noise_seed", 0),
            )
            self._frame_prefix = parameters.get("frame_prefix", "")
            self._twist = known.get("twist", TWISTS[-1])
            self.recorded_build = known["build"]
            if not (self._step_ns >= SHORTEST_STEP and 1 <= self._steps_per_sample <= MOST_STEPS):
                message = f"steps of {self._step_ns} ns, {self._steps_per_sample} a sample"
                raise ValueError(message)  # noqa: TRY301 - it is one of many ways not to be a run
            self._start = self._at_the_start()
        except Exception as error:  # whatever its texts hold in place of what they should
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

    @property
    def agrees(self) -> bool:
        """Whether what is promised holds of all that was compared, and something was."""
        return self.difference is None and self.samples > 0

    @property
    def warning(self) -> str:
        """What is wrong with the file, though this much could be read; else empty."""
        return self._log.warning

    def compare(self) -> Iterator[float]:
        """Run and compare to the end, or to the first difference.

        Yields
        ------
        float
            Simulated time of each sample, in s.

        Raises
        ------
        LogError
            If a message is not what its topic says, or nothing that a model could follow.
        """
        try:
            yield from self._compared()
        except Exception as error:  # whatever the bytes of a message make the libraries raise
            raise LogError(
                self._log.path, f"cannot be run again beyond {self.duration:g} s: {error}"
            ) from error

    def _compared(self) -> Iterator[float]:
        outputs, stepper = self._start
        due = stepper.step + (self._steps_per_sample if self._initial.sampled else 0)
        for step, inputs, recorded in self._instants():
            if step > due or (recorded and step != due):
                missing = due * self._step_ns / SECOND
                self._part(Difference("every output", missing, "", "no sample", "a sample"))
                return
            with np.errstate(all="ignore"):  # what overflows is no number, and so a difference
                stepper.advance(step - stepper.step)
            for applied in inputs:
                stepper.apply(applied)
            if not recorded:
                continue
            due += self._steps_per_sample
            self.duration = step * self._step_ns / SECOND
            [repeated] = outputs.serialised(stepper.sample(), [self._start_time + step * self._step_ns])
            for (name, kind), data in zip(outputs.types.items(), repeated, strict=True):
                self._compare(self._outputs[name], kind, recorded, data)
                if self.difference is not None:
                    return
            self.samples += 1
            yield self.duration
        if self._deviations.found:
            self.difference = self._deviations.first_beyond(TOLERANCE, self._sizes())

    def _at_the_start(self) -> tuple[OutputMessages, Stepper]:
        """What the messages and the model were when the recording began."""
        scalars = any(name.endswith("/yaw") for name in self._outputs)
        names = self._model.vehicle.unit_names
        outputs = OutputMessages(
            names,
            publish_scalars=scalars,
            noise=self._noise,
            frame_prefix=self._frame_prefix,
            twist=self._twist,
        )
        stepper = Stepper(self._model, self._step_ns / SECOND)
        stepper.restore(self._initial)
        if self._initial.sampled:  # the recording goes on from a sample that is not in it
            stamp = self._start_time + self._initial.step * self._step_ns
            outputs.go_on_from(stamp, stepper.steering_angle)
        return outputs, stepper

    def _instants(self) -> Iterator[tuple[int, list[AppliedInput], dict[str, bytes]]]:
        """Step, inputs, and outputs by topic, of every instant at which something was recorded."""
        messages = chain([self._first] if self._first is not None else [], self._messages)
        for log_time, group in groupby(messages, key=lambda message: message.log_time):
            step = (log_time - self._start_time) // self._step_ns
            inputs, outputs = [], {}
            for message in group:
                if message.topic in self._inputs:
                    inputs.append(self._applied(message, step))
                else:
                    outputs[message.topic] = message.data
            if self.warning:  # the last instant of a run that was cut off need not be whole
                return
            yield step, inputs, outputs

    def _applied(self, message: RecordedMessage, step: int) -> AppliedInput:
        name: Any = self._inputs[message.topic]
        # An Empty has no value; a Float64 in CDR is four bytes of header and the number.
        value = 0.0 if name == "reset" else struct.unpack_from("<d", message.data, 4)[0]
        return AppliedInput(step, name, value)

    def _compare(self, topic: str, kind: type, recorded: Mapping[str, bytes], repeated: bytes) -> None:
        if topic not in recorded:
            self._part(Difference(topic, self.duration, "", "no message", "a message"))
            return
        self.messages += 1
        if topic not in self._value_counts:
            self._value_counts[topic] = sum(1 for _ in _values(deserialize_message(repeated, kind)))
        self.values += self._value_counts[topic]
        # The same bytes are the same values. Others need not be others: padding holds old memory.
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
        kinds = {self._outputs[name]: kind for name, kind in self._start[0].types.items()}
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
