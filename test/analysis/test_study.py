"""Many vehicles at once are what each is alone, whoever computes them."""

import pickle
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import numpy as np
import pytest

from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import MEASURES, AnalysisError, least_damping_ratio, rightmost
from yawdamp_ros.analysis.nonlinear_measures import nonlinear_measure
from yawdamp_ros.analysis.points import Draws, Grid
from yawdamp_ros.analysis.study import STUDIED, Study, evaluate_all
from yawdamp_ros.vehicle import VehicleError, vehicle_text

KEYS = (("units.1.mass",), ("units.0.axles.1.cornering_stiffness", "units.0.axles.2.cornering_stiffness"))
POINTS = Grid([[5e3, 3e4], [2e5, 4e5]])[:]


def study(
    measure: str = "stability", model: str = "consistent", keys: tuple[tuple[str, ...], ...] = KEYS
) -> Study:
    return Study(vehicle_text("interlink"), "interlink", (), model, keys, measure)


@pytest.mark.parametrize("model", ["consistent", "published"])
def test_stability_of_each_point_is_its_rightmost_eigenvalue(model: str) -> None:
    (answers,) = evaluate_all(study(model=model), POINTS)
    for (mass, stiffness), (largest,) in zip(POINTS.tolist(), answers, strict=True):
        changes = [f"{KEYS[0][0]}={mass!r}", *(f"{key}={stiffness!r}" for key in KEYS[1])]
        alone = linear_model(load_vehicle("interlink", changes), model=model)
        assert largest == pytest.approx(rightmost(alone.state_matrix).real, abs=1e-8)


def test_least_damping_ratio_of_a_stack_is_that_of_each() -> None:
    (answers,) = evaluate_all(study("least_damping_ratio"), POINTS)
    for (mass, stiffness), (_, ratio) in zip(POINTS.tolist(), answers, strict=True):
        changes = [f"{KEYS[0][0]}={mass!r}", *(f"{key}={stiffness!r}" for key in KEYS[1])]
        alone = linear_model(load_vehicle("interlink", changes))
        assert ratio == pytest.approx(least_damping_ratio(alone), abs=1e-9)


@pytest.mark.parametrize("measure", MEASURES)
def test_every_measure_can_be_swept(measure: str) -> None:
    chosen = study(measure)
    (answers,) = evaluate_all(chosen, np.array([[5e3, 4e5], [2e4, 6e5]]))
    vehicle = load_vehicle("interlink", ["units.1.mass=20000.0", *(f"{key}=6e5" for key in KEYS[1])])
    speed = MEASURES[measure].speed or vehicle.speed
    expected = MEASURES[measure].value(linear_model(vehicle, speed))
    assert chosen.columns == ("largest_real_part", measure)
    assert answers[1, 1] == pytest.approx(np.nan if expected is None else expected, nan_ok=True)


def test_measure_is_taken_at_a_speed_that_varies() -> None:
    measure = "high_speed_transient_offtracking"
    points = np.array([[15.0], [30.0]])
    (answers,) = evaluate_all(study(measure, keys=(("speed",),)), points)
    for (speed,), (_, value) in zip(points, answers, strict=True):
        model = linear_model(load_vehicle("interlink"), float(speed))
        assert value == pytest.approx(MEASURES[measure].value(model))


def test_what_has_no_value_is_nan() -> None:
    (answers,) = evaluate_all(study("rearward_amplification"), POINTS)
    unstable = answers[:, 0] > 0.0
    assert unstable.tolist() == [False, False, True, False]
    np.testing.assert_array_equal(np.isnan(answers[:, 1]), unstable)


def test_chunks_make_no_difference() -> None:
    points = Draws([(5e3, 3e4), (2e5, 4e5)], 1200, seed=3)
    chosen = study("steady_offtracking")
    chunks = list(evaluate_all(chosen, points))
    assert [len(chunk) for chunk in chunks] == [500, 500, 200]
    np.testing.assert_allclose(np.concatenate(chunks), chosen.evaluate(points[:]))


def test_other_processes_give_the_same() -> None:
    points = Draws([(5e3, 3e4), (2e5, 4e5)], 1200, seed=3)
    chosen = study("yaw_damping_coefficient")
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as executor:
        elsewhere = np.concatenate(list(evaluate_all(chosen, points, executor.map)))
    np.testing.assert_allclose(elsewhere, chosen.evaluate(points[:]), rtol=1e-9)


def test_threads_give_what_each_vehicle_gives_alone_by_the_nonlinear_model() -> None:
    points = np.array([[2.0], [3.0], [4.0], [4.5], [5.0], [5.5]])
    chosen = study("rearward_amplification", "nonlinear", (("units.1.front_hitch",),))
    with ThreadPoolExecutor(2) as executor:
        together = np.concatenate(list(evaluate_all(chosen, points, executor.map)))
    alone = [
        nonlinear_measure(
            "rearward_amplification", load_vehicle("interlink", [f"units.1.front_hitch={hitch}"])
        )
        for (hitch,) in points.tolist()
    ]
    np.testing.assert_array_equal(together[:, 1], alone)


@pytest.mark.parametrize("mass", [-5.0, 0.0])
def test_one_wrong_point_is_refused_before_any_work(mass: float) -> None:
    points = np.array([[5e3, 3e5], [mass, 3e5]])
    with pytest.raises(VehicleError, match=r"interlink: units.1.mass: .*: expected a mass"):
        study().check(points)


def test_vehicle_error_survives_the_way_from_another_process() -> None:
    error = VehicleError("interlink", "units.1.mass", "0: expected a mass")
    again = pickle.loads(pickle.dumps(error))  # noqa: S301 - its own
    assert (str(again), again.key) == (str(error), error.key)


def test_an_unknown_measure_says_which_there_are() -> None:
    with pytest.raises(AnalysisError, match="measure: 'comfort': expected one of stability, least_damping"):
        study("comfort")
    assert STUDIED[0] == "stability"
