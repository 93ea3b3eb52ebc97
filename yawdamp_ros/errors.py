"""The base of every error that a user's input can cause."""


class YawdampError(ValueError):
    """Input that cannot be used; the message is one line that says what and why."""
