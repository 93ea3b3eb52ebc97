"""Execute a page of the manual as a reader would, and renew the outputs that it shows: `make pages`.

Every fenced block counts, from the top of the page to its end, in one shell and one Python session:

==========  =================================================================================================
block       what happens
==========  =================================================================================================
console     each line after ``$`` is executed; what it prints replaces what the page shows
sh          every line is executed and must succeed
python      is executed; with ``>>>`` what each statement prints replaces what the page shows
diff        is applied by ``patch -p1`` to a copy of the project
any         whose first line is a comment with a file name is written to that file instead
==========  =================================================================================================

A block below a comment ``<!-- not run: REASON -->`` is left alone, as is text of any other language.
"""

import contextlib
import doctest
import io
import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any, cast

DOCS = Path(__file__).parent
ROOT = DOCS.parent
ROS2 = ROOT / "test" / "ros2_commands.py"
PROJECT = ("config", "docs", "examples", "launch", "package.xml", "resource", "yawdamp_ros")
BLOCK = re.compile(r"(<!-- not run: [^>]+ -->\n+)?^```([a-z]+)\n(.*?)^```$", re.DOTALL | re.MULTILINE)
FILE = re.compile(r"# ([\w./-]+\.[a-z]+)\n")
MADE = {"_build", "auto_gallery", "library", "reproduction"}
PAGES = sorted(
    path.relative_to(ROOT).as_posix()
    for path in [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *DOCS.rglob("*.md")]
    if not MADE & set(path.parts)
    and re.search(r"^```(console|sh|python|diff)$", path.read_text(), re.MULTILINE)
)
"""Pages with blocks to execute, from the root of the project."""


class PageError(Exception):
    """A block that cannot be executed."""


class Shell:
    """One bash session, in which directories, variables and background jobs last from block to block.

    Parameters
    ----------
    directory : Path
        Where it starts; its copy of the package, or this one, is what the commands run.
    """

    def __init__(self, directory: Path) -> None:
        source = directory if (directory / "yawdamp_ros").is_dir() else ROOT
        path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        self._process = subprocess.Popen(
            ["bash", "--norc"],  # noqa: S607 - found on the PATH, as the reader's
            cwd=directory,
            env={**os.environ, "PATH": path, "PYTHONPATH": str(source), "COLUMNS": "80"},
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )
        self._lines = cast("IO[str]", self._process.stdin)
        self._answers = cast("IO[str]", self._process.stdout)
        self._output = directory / ".output"
        # With job control, background jobs heed SIGINT as those of a terminal do.
        self._send("set -m")
        if shutil.which("ros2") is None:
            self._send(f'ros2() {{ "{sys.executable}" "{ROS2}" "$@"; }}')

    def run(self, command: str) -> str:
        """Execute a command and return its standard output, without blanks at the ends of lines.

        Parameters
        ----------
        command : str

        Raises
        ------
        PageError
            If it fails, with what it printed.
        """
        errors = self._output.with_suffix(".errors")
        redirected = f"eval {_quoted(command)} >{self._output} 2>{errors}"
        self._send(f"{redirected}; echo $?")
        status = self._answers.readline().strip()
        printed = self._output.read_text(encoding="utf-8")
        if status != "0":
            message = f"{command}: exit status {status}\n{printed}{errors.read_text(encoding='utf-8')}"
            raise PageError(message)
        return "".join(f"{line.rstrip()}\n" for line in printed.splitlines())

    def close(self) -> None:
        """End what still runs in the background, then the shell."""
        with contextlib.suppress(BrokenPipeError):  # a command that failed has ended the session
            self._send('jobs="$(jobs -p)"; [ -z "$jobs" ] || { kill $jobs; wait; }; exit')
        self._process.communicate(timeout=60)

    def _send(self, line: str) -> None:
        self._lines.write(f"{line}\n")
        self._lines.flush()


def executed(page: str, directory: Path) -> str:
    """Execute a page in a directory and return its text with the outputs of now.

    Parameters
    ----------
    page : str
        Path from the root of the project.
    directory : Path
        Empty; it gets links to the project's folders, or copies where the page changes the code.

    Raises
    ------
    PageError
        If a block fails.
    """
    text = (ROOT / page).read_text(encoding="utf-8")
    _furnish(directory, copied="```diff" in text)
    with _shell(directory) as shell, contextlib.chdir(directory):
        scope: dict[str, Any] = {"__name__": "__page__"}

        def renew(match: re.Match[str]) -> str:
            skipped, language, body = match.groups()
            if skipped is None:
                body = _execute(language, body, shell, scope)
            return f"{skipped or ''}```{language}\n{body}```"

        return BLOCK.sub(renew, text)


def main() -> int:
    """Renew the pages named on the command line, or all."""
    for page in sys.argv[1:] or PAGES:
        with tempfile.TemporaryDirectory() as directory:
            renewed = executed(page, Path(directory))
        (ROOT / page).write_text(renewed, encoding="utf-8")
    return 0


def _execute(language: str, body: str, shell: Shell, scope: dict[str, Any]) -> str:
    if named := FILE.match(body):
        path = Path(named[1])
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(body, encoding="utf-8")
    elif language == "console":
        return "".join(f"$ {command}\n{shell.run(command)}" for command in _commands(body))
    elif language == "sh":
        shell.run(f"set -e\n{body}" if "&\n" not in body else body)
        shell.run("set +e")
    elif language == "diff":
        Path(".patch").write_text(body, encoding="utf-8")
        shell.run("patch --quiet -p1 <.patch")
    elif language == "python" and ">>>" in body:
        return "".join(_statements(body, scope))
    elif language == "python":
        exec(compile(body, "<page>", "exec"), scope)  # noqa: S102 - the manual's own lines
    return body


def _commands(body: str) -> list[str]:
    return [line.removeprefix("$ ") for line in body.splitlines() if line.startswith("$ ")]


def _statements(body: str, scope: dict[str, Any]) -> Iterator[str]:
    for example in doctest.DocTestParser().get_examples(body):
        first, *others = example.source.splitlines()
        printed = io.StringIO()
        with contextlib.redirect_stdout(printed):
            exec(compile(example.source, "<page>", "single"), scope)  # noqa: S102
        yield "".join([f">>> {first}\n", *(f"... {line}\n" for line in others), printed.getvalue()])


@contextlib.contextmanager
def _shell(directory: Path) -> Iterator[Shell]:
    shell = Shell(directory)
    try:
        yield shell
    finally:
        shell.close()


def _furnish(directory: Path, *, copied: bool) -> None:
    ignored = shutil.ignore_patterns("_build", "auto_gallery", "__pycache__", ".*")
    for name in PROJECT:
        source = ROOT / name
        if not copied:
            if name not in {"yawdamp_ros", "package.xml"}:
                (directory / name).symlink_to(source)
        elif source.is_dir():
            shutil.copytree(source, directory / name, ignore=ignored)
        else:
            shutil.copy(source, directory / name)


def _quoted(text: str) -> str:
    return "'" + text.replace("'", "'\\''") + "'"


if __name__ == "__main__":
    sys.exit(main())
