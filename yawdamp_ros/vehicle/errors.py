"""The one exception of the vehicle room."""

from yawdamp_ros.errors import YawdampError


class VehicleError(YawdampError):
    """Invalid vehicle; the message is one line.

    Parameters
    ----------
    source : str
        File or builtin name the vehicle came from.
    key : str
        Path of the wrong key, as `--set` takes it (``units.1.mass``); empty for the whole file.
    problem : str
        Value found and value expected.

    Examples
    --------
    >>> from yawdamp_ros.vehicle import VehicleError, load_vehicle
    >>> try:
    ...     load_vehicle("truck_trailer", ["units.1.mass=-5"])
    ... except VehicleError as error:
    ...     print(error)
    truck_trailer: units.1.mass: -5: expected a mass in kg, from 0.001 to 1e7
    """

    def __init__(self, source: str, key: str, problem: str) -> None:
        super().__init__(": ".join(part for part in (source, key, problem) if part))
        self.source = source
        self.key = key
        self.problem = problem

    def __reduce__(self) -> tuple[type["VehicleError"], tuple[str, str, str]]:
        # As raised in another process: an exception is otherwise made again from its message alone.
        return type(self), (self.source, self.key, self.problem)
