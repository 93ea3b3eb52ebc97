"""A measure of a stack of vehicles is that of each of them."""

from dataclasses import replace

import numpy as np
import pytest

from random_vehicles import built_in_but_changed, stacked
from yawdamp_ros import linear_model, load_vehicle
from yawdamp_ros.analysis import MEASURES, AnalysisError
from yawdamp_ros.vehicle import Vehicle

COUNT = 60


def drawn(name: str, *, spread: bool = True) -> list[Vehicle]:
    generator = np.random.default_rng(17)
    found = [built_in_but_changed(generator, name) for _ in range(COUNT)]
    return [replace(vehicle, speed=generator.uniform(8.0, 40.0)) if spread else vehicle for vehicle in found]


@pytest.mark.parametrize("name", ["a_double", "interlink", "truck_trailer", "single_vehicle"])
@pytest.mark.parametrize("measure", MEASURES)
def test_values_and_reasons_of_a_stack_are_those_of_each_within_1e_9(measure: str, name: str) -> None:
    vehicles = drawn(name)
    answers = MEASURES[measure].answers(linear_model(stacked(vehicles)))
    assert answers.values.shape == (COUNT,)
    for index, vehicle in enumerate(vehicles):
        reason = alone = None
        try:
            alone = MEASURES[measure].value(linear_model(vehicle))
        except AnalysisError as error:
            reason = str(error)
        assert answers.reasons.get(index) == reason
        if alone is None:
            assert np.isnan(answers.values[index])
        else:
            assert answers.values[index] == pytest.approx(alone, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("measure", MEASURES)
def test_the_published_model_is_stacked_too(measure: str) -> None:
    masses = np.linspace(5e3, 3e4, 7)
    stack = load_vehicle("interlink")
    units = list(stack.units)
    units[2] = replace(units[2], mass=masses)
    answers = MEASURES[measure].answers(linear_model(replace(stack, units=tuple(units)), model="published"))
    for index, mass in enumerate(masses.tolist()):
        model = linear_model(load_vehicle("interlink", [f"units.2.mass={mass!r}"]), model="published")
        try:
            alone = MEASURES[measure].value(model)
        except AnalysisError:
            alone = None
        expected = np.nan if alone is None else alone
        assert answers.values[index] == pytest.approx(expected, rel=1e-9, abs=1e-12, nan_ok=True)
