"""What a recorded run holds besides its messages, alike for the node and for offline runs."""

import json
import math
import platform
from collections import deque
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from yawdamp_ros.logs import Channel, RunWriter, SerialisedMessage
from yawdamp_ros.nodes.messages import (
    INPUT_TYPES,
    TWISTS,
    OutputMessages,
    serialised_input,
    type_name,
)
from yawdamp_ros.stepping import Sample, Stepper, TimeGrid
from yawdamp_ros.stepping.build import build_of_numerics
from yawdamp_ros.vehicle import VehicleSource
from yawdamp_ros.version import VERSION

INPUT_CHANNELS = tuple(INPUT_TYPES)
VEHICLE_FILE = "vehicle.yaml"
"""Name of the attachment that holds the vehicle file."""
METADATA_NAME = "yawdamp_ros"
"""Name of the metadata record that explains a run."""


def open_run(  # noqa: PLR0913 - each is one part of what explains a run
    directory: Path,
    outputs: OutputMessages,
    stepper: Stepper,
    grid: TimeGrid,
    *,
    start_time: int,
    parameters: Mapping[str, object],
    vehicle: VehicleSource,
    topics: Sequence[str],
) -> RunWriter:
    """Start a run directory that explains itself.

    Parameters
    ----------
    directory : Path
    outputs : OutputMessages
    stepper : Stepper
        At the instant from which the run goes on.
    grid : TimeGrid
    start_time : int
        Stamp of step 0 in ns.
    parameters : mapping of str to object
        As the run was asked for.
    vehicle : VehicleSource
    topics : sequence of str
        Fully qualified names: of the applied inputs as in `INPUT_TYPES`, then of the outputs.

    Returns
    -------
    RunWriter
        Its first channels are the inputs as applied, the others are the outputs.

    Raises
    ------
    LogError
        If the directory cannot be written.
    """
    types = [type_name(kind) for kind in (*INPUT_TYPES.values(), *outputs.types.values())]
    channels = [Channel(topic, name) for topic, name in zip(topics, types, strict=True)]
    model = stepper.model
    inputs, outputs_ = topics[: len(INPUT_TYPES)], topics[len(INPUT_TYPES) :]
    metadata = {
        "vehicle": model.vehicle.name,
        "vehicle_overrides": json.dumps(vehicle.overrides),
        "model": model.model,
        "speed": repr(model.speed),
        "step_ns": str(grid.step_ns),
        "steps_per_sample": str(grid.steps_per_sample),
        "start_time_ns": str(start_time),
        "input_topics": json.dumps(dict(zip(INPUT_TYPES, inputs, strict=True))),
        "output_topics": json.dumps(dict(zip(outputs.types, outputs_, strict=True))),
        "initial": json.dumps(stepper.snapshot()._asdict()),
        "state_names": json.dumps(model.state_names),
        "state_matrix": json.dumps(model.state_matrix.tolist()),
        "input_matrix": json.dumps(model.input_matrix.tolist()),
        "parameters": json.dumps(
            {name: None if _is_nan(value) else value for name, value in parameters.items()}
        ),
        "twist": TWISTS[0],
        "version": VERSION,
        "python": platform.python_version(),
        "build": build_of_numerics(),
    }
    return RunWriter(directory, channels, {VEHICLE_FILE: vehicle.text}, {METADATA_NAME: metadata})


def run_messages(
    sample: Sample, outputs: Sequence[Sequence[bytes]], grid: TimeGrid, start_time: int
) -> list[SerialisedMessage]:
    """Messages of a sample, and the inputs that it tells, in the order of time.

    Parameters
    ----------
    sample : Sample
        Of one or more instants.
    outputs : sequence of sequence of bytes
        Serialised, for each instant.
    grid : TimeGrid
    start_time : int
        Stamp of step 0 in ns.
    """
    found: list[SerialisedMessage] = []
    pending = deque(sample.inputs)
    for step, of_instant in zip(np.atleast_1d(sample.step).tolist(), outputs, strict=True):
        while pending and pending[0].step <= step:
            applied = pending.popleft()
            stamp = start_time + applied.step * grid.step_ns
            found.append((INPUT_CHANNELS.index(applied.name), stamp, serialised_input(applied)))
        stamp = start_time + step * grid.step_ns
        found += ((channel, stamp, data) for channel, data in enumerate(of_instant, len(INPUT_CHANNELS)))
    return found


def _is_nan(value: object) -> bool:
    return isinstance(value, float) and math.isnan(value)


class RunRecorder:
    """Writes the samples of an offline run, stamped from 0, as the node would.

    Parameters
    ----------
    directory : Path
    stepper : Stepper
        At step 0.
    grid : TimeGrid
    parameters : mapping of str to object
    vehicle : VehicleSource

    Raises
    ------
    LogError
        If the directory cannot be written, here and at every write.
    """

    def __init__(
        self,
        directory: Path,
        stepper: Stepper,
        grid: TimeGrid,
        *,
        parameters: Mapping[str, object],
        vehicle: VehicleSource,
    ) -> None:
        self._grid = grid
        self._outputs = OutputMessages(stepper.model.vehicle.unit_names, publish_scalars=True)
        self._writer = open_run(
            directory,
            self._outputs,
            stepper,
            grid,
            start_time=0,
            parameters=parameters,
            vehicle=vehicle,
            topics=[f"/{topic}" for topic in (*INPUT_CHANNELS, *self._outputs.types)],
        )

    def write(self, sample: Sample) -> None:
        """Append the messages of a sample of one or more instants."""
        stamps = [step * self._grid.step_ns for step in np.atleast_1d(sample.step).tolist()]
        outputs = self._outputs.serialised(sample, stamps)
        self._writer.write(run_messages(sample, outputs, self._grid, 0))

    def close(self) -> None:
        """Finish the run."""
        self._writer.close()
