"""YAML 1.2 of any origin, turned into plain data in bounded time and memory."""

import warnings
from typing import Any

DEEPEST = 32
"""Levels of nesting."""
LONGEST_NUMBER = 1000
"""Characters of a whole number: Python refuses to write out one of some thousand digits."""


def parse_yaml(text: str, most_values: int) -> Any:  # noqa: ANN401 - any YAML until it is checked
    """Plain data of a YAML text.

    Tags of the safe schema are followed, and no other: none can execute anything.

    Parameters
    ----------
    text : str
    most_values : int
        Largest number of keys and values; the contents of an alias count at each use.

    Returns
    -------
    object
        Data of mappings, sequences and scalars.

    Raises
    ------
    ValueError
        If it is not valid; the message says where and why, not always in one line.
    """
    # Imported here: help needs no file.
    from ruamel.yaml import YAML  # noqa: PLC0415
    from ruamel.yaml.error import MarkedYAMLError  # noqa: PLC0415

    # By ruamel.yaml: 1e5 is a number, and a key given twice is an error.
    yaml = YAML(typ="safe", pure=True)
    yaml.max_depth = DEEPEST
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # about odd but valid YAML
            root = yaml.compose(text)
            if root is None:
                return None
            _check_extent(root, most_values)
            return yaml.constructor.construct_document(root)
    except MarkedYAMLError as error:
        where = f"line {error.problem_mark.line + 1}: " if error.problem_mark else ""
        # The message on too deep nesting goes on with advice for programmers.
        problem = str(error.problem).partition("\n")[0].partition(", if necessary")[0]
        message = f"{where}not valid YAML: {problem}"
        raise ValueError(message) from error
    except RecursionError as error:  # ruamel.yaml before 0.18 has no limit of its own
        message = "not valid YAML: maximum depth of nesting exceeded"
        raise ValueError(message) from error
    except Exception as error:  # a tag on a value that cannot have it makes ruamel.yaml raise anything
        problem = str(error).partition("\n")[0] or type(error).__name__
        message = f"not valid YAML: {problem}"
        raise ValueError(message) from error


def _check_extent(root: Any, most_values: int) -> None:  # noqa: ANN401 - a node of ruamel.yaml
    """Refuse what aliases, of which a few lines can stand for billions of values, make too much of."""
    from ruamel.yaml.composer import ComposerError  # noqa: PLC0415 - as above

    pending, count = [(root, 1)], 0
    while pending:
        node, depth = pending.pop()
        if isinstance(node.value, str):
            if str(node.tag).endswith(":int") and len(node.value) > LONGEST_NUMBER:
                raise ComposerError(None, None, "a very long number", node.start_mark)
            continue
        # A mapping holds pairs of nodes, a sequence nodes.
        count += len(node.value)
        if count > most_values or depth > DEEPEST:
            problem = f"more than {most_values} values or {DEEPEST} levels, with what its aliases stand for"
            raise ComposerError(None, None, problem, node.start_mark)
        for child in node.value:
            pending += [(part, depth + 1) for part in (child if isinstance(child, tuple) else (child,))]
