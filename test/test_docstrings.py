"""Exported functions and classes are documented in full, and their examples run."""

import ast
import doctest
import inspect
import struct
import textwrap
from collections.abc import Callable, Iterator
from dataclasses import fields, is_dataclass
from enum import Enum
from importlib import import_module
from pathlib import Path

import pytest

import yawdamp_ros
from yawdamp_ros.runs import Channel, RunWriter, make_run_directory

DOCS = Path(__file__).parents[1] / "docs"
ROOMS = [name for name in yawdamp_ros.__all__ if inspect.ismodule(getattr(yawdamp_ros, name))]
TYRE = """[MODEL]
PROPERTY_FILE_FORMAT = 'PAC2002'
[VERTICAL]
FNOMIN = 35000
[LATERAL_COEFFICIENTS]
PCY1 = 1.2
PDY1 = 0.8
PKY1 = -12
PKY2 = 1.7
"""
NOT_IMPERATIVE = ("Of ", "What ", "Where ", "How ", "Whether ")


def exported() -> Iterator[tuple[str, Callable[..., object]]]:
    for package in ("yawdamp_ros", *(f"yawdamp_ros.{room}" for room in ROOMS)):
        module = import_module(package)
        for name in module.__all__:
            found = getattr(module, name)
            if inspect.isclass(found) or inspect.isfunction(found):
                yield f"{package}.{name}", found


EXPORTED = dict(exported())


def raises(found: Callable[..., object]) -> bool:
    tree = ast.parse(textwrap.dedent(inspect.getsource(found)))
    return any(isinstance(node, ast.Raise) for node in ast.walk(tree))


@pytest.mark.parametrize("name", EXPORTED)
def test_parameters_returns_and_raises_are_described(name: str) -> None:
    docscrape = pytest.importorskip("numpydoc.docscrape", reason="the manual needs the extra `docs`")
    found = EXPORTED[name]
    described = (docscrape.ClassDoc if inspect.isclass(found) else docscrape.FunctionDoc)(found)
    entries = [*described["Parameters"], *described["Attributes"]]
    documented = {part.strip() for entry in entries for part in entry.name.split(",")}
    if is_dataclass(found):  # a field may hold its description itself, as those of a settings record
        documented |= {field.name for field in fields(found) if "description" in field.metadata}
    if not (inspect.isclass(found) and issubclass(found, Enum | BaseException)):
        assert set(inspect.signature(found).parameters) - {"args", "kwargs"} - documented == set()
    if inspect.isfunction(found):
        assert described["Returns"] or described["Yields"] or found.__annotations__["return"] is None
        assert described["Raises"] or not raises(found)


@pytest.fixture(scope="module")
def files(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """Files that examples read: a recording, a tyre, and those of the manual."""
    directory = tmp_path_factory.mktemp("files")
    run = make_run_directory(directory / "steering_run", numbered=False)
    writer = RunWriter(run, {"steering": Channel("/steering", "std_msgs/msg/Float64")}, {}, {})
    writer.write([("steering", 0, bytes([0, 1, 0, 0]) + struct.pack("<d", 0.02))])
    writer.close()
    tyre = directory / "truck.tir"
    tyre.write_text(TYRE, encoding="utf-8")
    return [run, tyre, DOCS]


@pytest.mark.parametrize("name", EXPORTED)
def test_the_example_runs(
    name: str, files: list[Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    for each in files:
        (tmp_path / each.name).symlink_to(each)
    monkeypatch.chdir(tmp_path)
    finder = doctest.DocTestFinder(recurse=False)
    (example,) = finder.find(EXPORTED[name], name)
    assert example.examples
    results: list[str] = []
    assert doctest.DocTestRunner().run(example, out=results.append).failed == 0, "".join(results)


def test_summaries_are_imperative_or_name_the_thing() -> None:
    package = Path(yawdamp_ros.__file__).parent
    found = []
    for path in package.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
                summary = ast.get_docstring(node) or ""
                if summary.startswith(NOT_IMPERATIVE):
                    found.append(f"{path.relative_to(package)}: {summary.splitlines()[0]}")
    assert found == []
