"""A run that a controller in the same process drives, call by call."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from yawdamp_ros.simulation.commands import ACCEPTED, Commands
from yawdamp_ros.simulation.errors import SimulationError
from yawdamp_ros.simulation.limits import Limits
from yawdamp_ros.simulation.models import make_motion
from yawdamp_ros.simulation.run import Run
from yawdamp_ros.simulation.settings import SimParameters
from yawdamp_ros.simulation.sink import Sink
from yawdamp_ros.stepping import Sample, TimeGrid
from yawdamp_ros.vehicle import Vehicle, load_vehicle

NO_INPUTS: Mapping[str, float] = {}


class Plant:
    """The node's run without the node: commands in, sample of the next period out.

    Parameters
    ----------
    settings : SimParameters
        Settings as for the node; `publish_rate` is the rate of the controller.
    vehicle : Vehicle, optional
        Vehicle in place of that of the settings.
    sinks : sequence of Sink
        Further receivers of every sample.

    Attributes
    ----------
    settings : SimParameters
    vehicle : Vehicle
    grid : TimeGrid
    run : Run
        Present run; each `reset` makes a new one.
    commands : Commands
        Commands of the run.
    sample : Sample
        Newest sample.

    Raises
    ------
    YawdampError
        If the settings or the vehicle cannot be.

    Examples
    --------
    >>> plant = Plant(SimParameters(model="nonlinear", longitudinal_source="acceleration", speed=20.0))
    >>> for _ in range(100):
    ...     sample = plant.step({"steering": 0.01, "acceleration": -3.0})
    >>> round(float(sample.velocity[0].real), 1)  # after a second, m/s
    17.1
    """

    def __init__(
        self, settings: SimParameters, vehicle: Vehicle | None = None, sinks: Sequence[Sink] = ()
    ) -> None:
        if problem := settings.problem():
            raise SimulationError(problem)
        if vehicle is None:
            changes = tuple(change for change in settings.vehicle_overrides if change)
            vehicle = load_vehicle(settings.vehicle, changes)
        self.vehicle = vehicle
        self.settings = settings
        self.grid = TimeGrid.of(settings.step_size, 1.0 / settings.publish_rate)
        self._sinks = (self, *sinks)
        self.reset()

    @property
    def time(self) -> float:
        """Simulated time [s]."""
        return self.run.time

    def reset(self) -> Sample:
        """Begin a new run at the start, and return its first sample."""
        settings = self.settings
        motion = make_motion(
            self.vehicle, settings.model, settings.first_speed, self.grid.step_size, settings.first_pose
        )
        self.settings = settings = replace(settings, initial_speed=motion.speed)
        self.commands = Commands(settings, self.grid, motion)
        self.run = Run(motion, self.grid, self.commands, self._sinks, Limits.of(settings))
        self.run.start()
        return self.sample

    def step(self, inputs: Mapping[str, float] = NO_INPUTS) -> Sample:
        """Take a period under commands, which act from its second step on as the node's do.

        Parameters
        ----------
        inputs : mapping of str to float
            ``steering`` and other inputs by name; an input that is not given keeps its value.

        Returns
        -------
        Sample
            Sample at the end of the period, or the last sample of a run that was stopped.

        Raises
        ------
        SimulationError
            If the model does not take an input, or rejects its value.
        """
        commands, steered = self.commands, self.settings.manoeuvre == "none"
        for name, value in inputs.items():
            if name == "steering" and steered:
                verdict = commands.steer(value)
            elif name in commands.held:
                verdict = commands.demand(name, value)
            else:
                known = ", ".join([*(["steering"] if steered else []), *commands.held])
                taker = f"model {self.settings.model}" if name != "steering" else "a run with a manoeuvre"
                message = f"{name}: {taker} does not take it; expected one of {known}"
                raise SimulationError(message)
            if verdict not in ACCEPTED:
                message = f"{name}: {value}: {verdict}"
                raise SimulationError(message)
        self.run.advance()
        return self.sample

    def write(self, sample: Sample) -> None:
        """Keep the newest sample; see `Sink`."""
        self.sample = sample

    def close(self) -> None:
        """See `Sink`."""
