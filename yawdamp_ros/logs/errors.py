"""The one exception of the logs room."""

from yawdamp_ros.errors import YawdampError


class LogError(YawdampError):
    """A log that cannot be read or written; the message is one line that names it.

    Examples
    --------
    >>> from pathlib import Path
    >>> from yawdamp_ros.logs import LogError, read_steering_csv
    >>> try:
    ...     read_steering_csv(Path("nothing.csv"))
    ... except LogError as error:
    ...     print(error)
    nothing.csv: cannot be read: No such file or directory
    """

    def __init__(self, path: object, problem: str) -> None:
        super().__init__(f"{path}: {problem}")
