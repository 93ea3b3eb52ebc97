"""Where a linear model has lost its meaning."""

from collections.abc import Sequence

from yawdamp_ros.stepping.sample import Sample


def meaningless(
    sample: Sample, unit_names: Sequence[str], max_lateral_acceleration: float, max_articulation: float
) -> str:
    """What of a sample no vehicle could do; empty if nothing is.

    Parameters
    ----------
    sample : Sample
        Of one instant.
    unit_names : sequence of str
    max_lateral_acceleration : float
        Largest magnitude in m/s^2.
    max_articulation : float
        Largest magnitude in rad.
    """
    for name, value in zip(unit_names, sample.lateral_acceleration.tolist(), strict=True):
        # Said this way round, no number is too much, too.
        if not abs(value) <= max_lateral_acceleration:
            return f"lateral acceleration of {name} {value:.4g} m/s^2, past {max_lateral_acceleration:g}"
    for joint, value in enumerate(sample.articulation.tolist(), 1):
        if not abs(value) <= max_articulation:
            return f"articulation_{joint} {value:.4g} rad, past {max_articulation:g}"
    return ""
