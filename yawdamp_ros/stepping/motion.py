"""Interface of a model in time."""

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.stepping.sample import AppliedInput, Sample
from yawdamp_ros.stepping.start import Start
from yawdamp_ros.vehicle import Vehicle


class Motion(Protocol):
    """A vehicle that moves in fixed steps.

    The bits of a run depend only on the inputs and their steps, not on the number of steps taken at once.

    Attributes
    ----------
    vehicle : Vehicle
    step : int
        Steps since the start.
    input_names : sequence of str
        Inputs that `apply` takes; ``steering`` is among them.
    state_names : sequence of str
    quantity_names : sequence of str
        Keys of `Sample.extra`.

    Examples
    --------
    >>> from yawdamp_ros import linear_model, load_vehicle
    >>> from yawdamp_ros.stepping import Stepper
    >>> motion = Stepper(linear_model(load_vehicle("truck_trailer")), step_size=0.001)
    >>> motion.input_names
    ('steering', 'speed', 'reset')
    >>> float(motion.run([0.02] * 1000).yaw_rate[0].round(4))
    0.0753
    >>> snapshot = motion.snapshot()
    >>> motion.advance(500)
    >>> motion.restore(snapshot)
    >>> motion.step
    1000
    """

    @property
    def vehicle(self) -> Vehicle: ...  # noqa: D102 - the class describes its attributes

    @property
    def step(self) -> int: ...  # noqa: D102

    @property
    def input_names(self) -> Sequence[str]: ...  # noqa: D102

    @property
    def state_names(self) -> Sequence[str]: ...  # noqa: D102

    @property
    def quantity_names(self) -> Sequence[str]: ...  # noqa: D102

    @property
    def speed(self) -> float:
        """Present longitudinal velocity of the lead unit [m/s]."""

    @property
    def steering_angle(self) -> float:
        """Road-wheel steer angle in force from this instant on [rad]."""

    def begin(self, start: Start) -> None:
        """Set the start, to which a reset returns; allowed at step 0 before the first sample.

        Raises
        ------
        SteppingError
            If the model cannot begin so.
        """

    def apply(self, applied: AppliedInput) -> None:
        """Let an input act from this instant on."""

    def advance(self, steps: int = 1) -> None:
        """Take steps with the steering held."""

    def run(self, angles: Sequence[float] | FloatArray, steps_per_sample: int | None = None) -> Sample:
        """Take a step for every steer angle, and sample.

        Parameters
        ----------
        angles : array_like, shape (k,)
            Road-wheel steer angles [rad], each in force from the instant after its step on.
        steps_per_sample : int, optional
            A divisor of k: sample every so many steps. The last instant alone unless given.

        Returns
        -------
        Sample
            Last instant, or k / steps_per_sample instants. A motion that overflows is NaN.
        """

    def sample(self) -> Sample:
        """Return the sample of this instant; the lists of events and inputs start anew."""

    def snapshot(self) -> Mapping[str, Any]:
        """State sufficient for `restore`, of what JSON holds: the same bits follow here as there.

        Its ``sampled`` says whether this instant's sample was taken.
        """

    def restore(self, snapshot: Mapping[str, Any]) -> None:
        """Go on from a snapshot of the same vehicle and model; its inputs count as reported."""

    def linearise(self) -> LinearModel:
        """Linear model about straight running at the present speed."""
