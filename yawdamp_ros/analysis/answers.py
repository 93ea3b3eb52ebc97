"""Values of a measure for a stack of vehicles; one vehicle is a stack of one."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from yawdamp_ros.analysis.errors import AnalysisError
from yawdamp_ros.dynamics import LinearModel
from yawdamp_ros.dynamics.kinematics import FloatArray


@dataclass(frozen=True)
class Answers:
    """Values of one measure for k vehicles.

    Attributes
    ----------
    values : ndarray, shape (k,)
        NaN where there is none.
    reasons : mapping of int to str
        Reasons for missing values by index of the vehicle, where one is needed.
    spans : ndarray, shape (k, 2), optional
        Lowest and highest reading of an ambiguous value.
    """

    values: FloatArray
    reasons: Mapping[int, str] = field(default_factory=dict)
    spans: FloatArray | None = None

    def only(self) -> float | None:
        """Value of a stack of one; None without a value.

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
