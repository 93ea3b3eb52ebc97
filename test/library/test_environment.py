"""The Gymnasium environment: its own checker passes, and an episode is the node's run."""

import warnings
from importlib.util import find_spec

import numpy as np
import pytest

from yawdamp_ros.simulation import SimParameters, SimulationError, simulate
from yawdamp_ros.stepping import Sample

if find_spec("gymnasium"):
    from gymnasium.utils.env_checker import check_env
    from gymnasium.vector import SyncVectorEnv

    from yawdamp_ros.library.environment import RigEnv

pytestmark = pytest.mark.skipif(find_spec("gymnasium") is None, reason="needs gymnasium, an extra")

DRIVEN = SimParameters(model="nonlinear", longitudinal_source="acceleration", speed=15.0, duration=1.0)


def reward(sample: Sample) -> float:
    return -float(np.abs(sample.lateral_acceleration[-1]))


@pytest.mark.parametrize(
    "settings, actions",
    [
        (SimParameters(duration=1.0), ("steering", "speed")),
        (DRIVEN, ("steering", "acceleration", "trailer_2/yaw_moment")),
    ],
)
def test_gymnasium_s_checker_passes(settings: SimParameters, actions: tuple[str, ...]) -> None:
    if "speed" in actions:
        settings = SimParameters(duration=1.0, longitudinal_source="speed")
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", message=".*(symmetric|infinity).*")
        env = RigEnv(settings, reward, actions)
        env.action_space.seed(1)
        check_env(env, skip_render_check=True)


def test_an_episode_is_the_run_of_simulate() -> None:
    env = RigEnv(SimParameters(duration=2.0), reward, observations=("truck/yaw_rate", "trailer_2/yaw_rate"))
    seen = [env.reset()[0]]
    done = False
    while not done:
        observation, _, terminated, done, info = env.step(np.array([0.02]))
        seen.append(observation)
        assert not terminated
    assert info == {"time": 2.0, "stopped": ""}
    # A command acts from the step after the newest one on.
    held = np.full(2001, 0.02)
    held[0] = 0.0
    expected = simulate("interlink", held, 2.0, sample_period=0.01).yaw_rate[:, [0, 2]]
    np.testing.assert_array_equal(np.array(seen), expected)


def test_a_rollover_terminates() -> None:
    env = RigEnv(
        SimParameters(model="nonlinear", speed=25.0, vehicle="a_double", duration=20.0), reward, ("steering",)
    )
    env.reset()
    terminated = truncated = False
    while not (terminated or truncated):
        observation, _, terminated, truncated, info = env.step(np.array([0.3]))
    assert terminated
    assert info["stopped"]
    assert np.isfinite(observation).all()


def test_several_rigs_are_one_vector_and_an_unknown_name_is_told() -> None:
    envs = SyncVectorEnv(
        [lambda: RigEnv(DRIVEN, reward, ("steering", "acceleration"), ("truck/yaw_rate",))] * 2
    )
    envs.reset(seed=1)
    for _ in range(20):
        seen, *_ = envs.step(np.array([[0.02, 0.0], [-0.02, -2.0]]))
    assert seen[0, 0] > 0.0 > seen[1, 0]
    with pytest.raises(SimulationError, match="action wings: model consistent does not take it"):
        RigEnv(SimParameters(), reward, ("wings",))
    with pytest.raises(SimulationError, match="observation wings: expected one of steering_angle"):
        RigEnv(SimParameters(), reward, observations=("wings",))
