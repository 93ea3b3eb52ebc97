"""A rig as a Gymnasium environment, over the same run as the node."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.runs.outputs import available, columns
from yawdamp_ros.simulation import SimParameters, SimulationError
from yawdamp_ros.simulation.plant import Plant
from yawdamp_ros.stepping import Sample
from yawdamp_ros.vehicle import Vehicle

try:
    import gymnasium
    from gymnasium.spaces import Box
except ImportError as error:
    message = "gymnasium is not installed: pip install 'yawdamp_ros[gymnasium]'"
    raise ImportError(message) from error

Reward = Callable[[Sample], float]


class RigEnv(gymnasium.Env[FloatArray, FloatArray]):
    """An episode is a run: actions are its inputs, observations its outputs.

    Parameters
    ----------
    settings : SimParameters
        Settings as for the node: actions come at `publish_rate`; an episode lasts `duration`, or 15 s.
    reward : callable
        Function from the sample that follows an action to its reward.
    actions : sequence of str
        Inputs by name, ``steering`` or one of `Plant.commands.held`.
    observations : sequence of str, optional
        Columns of the outputs, as a CSV file of the run has them; all of them unless given.
    vehicle : Vehicle, optional
        Vehicle in place of that of the settings.

    Attributes
    ----------
    plant : Plant

    Raises
    ------
    YawdampError
        If the settings cannot be, or there is no such action or observation.

    Examples
    --------
    >>> settings = SimParameters(vehicle="truck_trailer", duration=5.0)
    >>> env = RigEnv(settings, lambda sample: -float(abs(sample.lateral_acceleration[-1])))
    >>> observation, info = env.reset(seed=1)
    >>> observation, reward, terminated, truncated, info = env.step(np.array([0.01]))
    >>> info["time"]
    0.01
    """

    metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012 - Gymnasium's

    def __init__(
        self,
        settings: SimParameters,
        reward: Reward,
        actions: Sequence[str] = ("steering",),
        observations: Sequence[str] | None = None,
        vehicle: Vehicle | None = None,
    ) -> None:
        if not settings.duration:
            settings = replace(settings, duration=15.0)
        self.plant = Plant(settings, vehicle)
        self._reward = reward
        self._actions = tuple(actions)
        motion = self.plant.run.motion
        known = {
            name: (output, index)
            for name, output, index in columns(available(motion.quantity_names), motion.vehicle.unit_names)
        }
        names = tuple(known) if observations is None else tuple(observations)
        if missing := [name for name in names if name not in known]:
            text = f"observation {missing[0]}: expected one of {', '.join(known)}"
            raise SimulationError(text)
        self.observation_names = names
        self._observed = [known[name] for name in names]
        self.action_space = Box(*self._bounds(settings.max_steering_angle), dtype=np.float64)
        self.observation_space = Box(-np.inf, np.inf, (len(names),), np.float64)

    def reset(
        self, *, seed: int | None = None, options: Mapping[str, Any] | None = None
    ) -> tuple[FloatArray, dict[str, Any]]:
        """Begin a new run at the start; nothing in it is random."""
        super().reset(seed=seed, options=dict(options or {}))
        self.plant.reset()
        return self._observation(), self._info()

    def step(self, action: FloatArray) -> tuple[FloatArray, float, bool, bool, dict[str, Any]]:
        """Take a period under an action; a run that a limit or a rollover stops is terminated."""
        plant = self.plant
        sample = plant.step(dict(zip(self._actions, np.asarray(action, float).tolist(), strict=True)))
        terminated = plant.run.stopped is not None
        truncated = plant.run.samples > plant.grid.samples_in(plant.settings.duration)
        return self._observation(), float(self._reward(sample)), terminated, truncated, self._info()

    def _bounds(self, steering: float) -> tuple[FloatArray, FloatArray]:
        low, high = [], []
        for name in self._actions:
            if name == "steering":
                low.append(-steering)
                high.append(steering)
                continue
            held = self.plant.commands.held
            if name not in held:
                known = ", ".join(("steering", *held))
                text = f"action {name}: model {self.plant.settings.model} does not take it; expected {known}"
                raise SimulationError(text)
            low.append(held[name].low)
            high.append(held[name].high)
        return np.array(low), np.array(high)

    def _observation(self) -> FloatArray:
        sample = self.plant.sample
        values = (np.ravel(output.values(sample))[index] for output, index in self._observed)
        return np.fromiter(values, float, len(self._observed))

    def _info(self) -> dict[str, Any]:
        run = self.plant.run
        stopped = "" if run.stopped is None else run.stopped.reason
        return {"time": self.plant.time, "stopped": stopped}
