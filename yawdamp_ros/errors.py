"""The base of every error that a user's input can cause."""

LONGEST_LINE = 1000
"""Characters of a message: more of a file's own words would help nobody."""


class YawdampError(ValueError):
    """Input that cannot be used; the message is one line that says what and why."""

    def __init__(self, message: str) -> None:
        super().__init__(one_line(message))


def one_line(text: str) -> str:
    """A text as one line that a terminal shows as it is, whatever a file put in it.

    What is no printable character is written as Python writes it, and of a long text the middle is left
    out: its beginning names the file and its end says what was expected.
    """
    if len(text) > LONGEST_LINE:
        text = f"{text[: LONGEST_LINE // 2]} ... {text[-LONGEST_LINE // 2 :]}"
    return "".join(character if character.isprintable() else repr(character)[1:-1] for character in text)
