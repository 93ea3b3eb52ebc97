"""A boundary of stability, in words and as JSON."""

from yawdamp_ros.analysis import Boundary


def boundary_text(boundary: Boundary, unit: str) -> str:
    """One sentence; the unit is written after the value."""
    side = "above" if boundary.unstable_above else "below"
    how = {
        "monotonic": "a real root crosses",
        "oscillatory": f"a pair crosses at {boundary.frequency:.4g} rad/s",
        "jump": "a root jumps through infinity: the mass matrix is singular there",
    }[boundary.kind]
    return f"unstable {side} {boundary.value:.6g}{unit} ({how})"


def boundary_record(boundary: Boundary) -> dict[str, object]:
    """Boundary as a JSON object."""
    return {
        "value": boundary.value,
        "unstable": "above" if boundary.unstable_above else "below",
        "kind": boundary.kind,
        "frequency": boundary.frequency,
    }
