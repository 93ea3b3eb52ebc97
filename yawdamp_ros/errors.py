"""The base of every error that a user's input can cause."""

LONGEST_LINE = 1000
"""Limit on the characters of a message: a longer quotation of a file would not help."""


class YawdampError(ValueError):
    """Input that cannot be used; the message is one line that says what and why."""

    def __init__(self, message: str) -> None:
        super().__init__(one_line(message))


def one_line(text: str) -> str:
    """Return a text as one line that a terminal shows as it is, whatever a file put in it.

    Characters that cannot be printed are escaped as in Python. A long text loses its middle: the beginning
    names the file and the end says what was expected.
    """
    if len(text) > LONGEST_LINE:
        text = f"{text[: LONGEST_LINE // 2]} ... {text[-LONGEST_LINE // 2 :]}"
    return "".join(character if character.isprintable() else repr(character)[1:-1] for character in text)
