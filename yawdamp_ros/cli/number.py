"""Numbers in tables."""

ROUNDING_NOISE = 1e-9
"""Magnitude in SI units below which a result counts as rounding and is shown as 0."""


def number(value: float, spec: str = ".4g") -> str:
    """Format a result for users; a value below rounding noise is 0.

    Parameters
    ----------
    value : float
        Value in SI units.
    spec : str
        Format specification.

    Returns
    -------
    str

    Examples
    --------
    >>> number(4.4e-10), number(-0.00001, ".3f"), number(1.0185)
    ('0', '0.000', '1.018')
    """
    return format(0.0 if abs(value) < ROUNDING_NOISE else value, f"z{spec}")
