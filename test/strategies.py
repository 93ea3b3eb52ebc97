"""Random vehicles that are valid, for laws that hold for all of them."""

from hypothesis import strategies as st

from yawdamp_ros.vehicle import Axle, Unit, Vehicle


def _between(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high, allow_nan=False, allow_infinity=False)


@st.composite
def _units(draw: st.DrawFn, index: int, last: int) -> Unit:
    axles = [
        Axle(draw(_between(-6.0, 4.0)), draw(_between(5e4, 1e6)), steered=draw(st.booleans()))
        for _ in range(draw(st.integers(1, 3)))
    ]
    if index == 0:
        axles.append(Axle(draw(_between(0.5, 4.0)), draw(_between(5e4, 1e6)), steered=True))
    return Unit(
        name=f"unit_{index}",
        mass=draw(_between(500.0, 4e4)),
        yaw_inertia=draw(_between(1e3, 6e5)),
        axles=tuple(axles),
        front_hitch=draw(_between(0.5, 8.0)) if index else None,
        rear_hitch=draw(_between(-8.0, -0.5)) if index < last else None,
    )


@st.composite
def vehicles(draw: st.DrawFn, min_units: int = 1, max_units: int = 4) -> Vehicle:
    """Combinations of units with any number of axles, some of them steered."""
    count = draw(st.integers(min_units, max_units))
    units = tuple(draw(_units(index, count - 1)) for index in range(count))
    return Vehicle("random", draw(_between(2.0, 40.0)), units)
