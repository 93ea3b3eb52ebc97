"""Values of a measure for a stack of vehicles; one vehicle is a stack of one."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.vehicle import unstacked


@dataclass(frozen=True)
class Answers:
    """Values of one measure for k vehicles.

    Attributes
    ----------
    values : ndarray, shape (k,)
        NaN where there is none.
    reasons : mapping of int to str
        Why there is none, by index of the vehicle, where that needs saying.
    spans : ndarray, shape (k, 2), optional
        Lowest and highest value that the measure could be read as, where it is ambiguous.
    """

    values: FloatArray
    reasons: Mapping[int, str] = field(default_factory=dict)
    spans: FloatArray | None = None

    def only(self) -> float | None:
        """Value of a stack of one, None where there is none.

        Raises
        ------
        AnalysisError
            If the reason for that needs saying.
        """
        if 0 in self.reasons:
            raise AnalysisError(self.reasons[0])
        return None if np.isnan(self.values[0]) else float(self.values[0])


def stack_of(model: LinearModel) -> LinearModel:
    """One vehicle as a stack of one; a stack as it is."""
    if model.state_matrix.ndim > 2:  # noqa: PLR2004 - rows and columns
        return model
    return replace(
        model,
        state_matrix=model.state_matrix[np.newaxis],
        input_matrix=model.input_matrix[np.newaxis],
        output_matrix=model.output_matrix[np.newaxis],
        feedthrough=model.feedthrough[np.newaxis],
    )


def one_of(stack: LinearModel, index: int) -> LinearModel:
    """One vehicle of a stack."""
    return replace(
        stack,
        vehicle=unstacked(stack.vehicle, index),
        speed=float(np.broadcast_to(stack.speed, len(stack.state_matrix))[index]),
        state_matrix=stack.state_matrix[index],
        input_matrix=stack.input_matrix[index],
        output_matrix=stack.output_matrix[index],
        feedthrough=stack.feedthrough[index],
    )


def one_by_one(measure: Callable[[LinearModel], float | None]) -> Callable[[LinearModel], Answers]:
    """A measure of one vehicle as one of a stack of them."""

    def answers(stack: LinearModel) -> Answers:
        values = np.full(len(stack.state_matrix), np.nan)
        reasons = {}
        for index in range(len(values)):
            try:
                value = measure(one_of(stack, index))
            except AnalysisError as error:
                reasons[index] = str(error)
            else:
                values[index] = np.nan if value is None else value
        return Answers(values, reasons)

    return answers
