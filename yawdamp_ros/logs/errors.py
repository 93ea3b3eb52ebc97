"""The one exception of the logs room."""

from yawdamp_ros.errors import YawdampError


class LogError(YawdampError):
    """A log that cannot be read or written, said in one line that names it."""

    def __init__(self, path: object, problem: str) -> None:
        super().__init__(f"{path}: {problem}")
