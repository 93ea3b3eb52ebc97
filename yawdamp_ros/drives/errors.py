"""The one exception of the drives room."""

from yawdamp_ros.errors import YawdampError


class DriveError(YawdampError):
    """A drive that cannot be compared or identified; the message is one line.

    Examples
    --------
    >>> from yawdamp_ros import load_drive
    >>> from yawdamp_ros.drives import DriveError, identify
    >>> from yawdamp_ros.vehicle import VehicleSource, vehicle_text
    >>> source = VehicleSource(vehicle_text("truck_trailer"), ())
    >>> drive = load_drive("docs/recorded_drive.csv")
    >>> try:
    ...     identify(drive, source, ["colour"])
    ... except DriveError as error:
    ...     print(str(error)[:40])
    colour: expected one of stiffness, inert
    """
