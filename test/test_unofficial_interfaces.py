"""Private interfaces that the package uses are those listed in CONTRIBUTING.md, and no more."""

import ast
import inspect
import re
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
PACKAGE = ROOT / "yawdamp_ros"
OF_NAMED_TUPLES = {"_asdict", "_fields", "_make", "_replace"}
LISTED = {
    "nodes/subscriptions.py: handle.take_message",
    "logs/mcap_log.py: super()._read_record",
}


def private_uses(path: Path) -> Iterator[str]:
    """Private attributes of others, pybind handles and internal modules that a file uses."""
    place = path.relative_to(PACKAGE).as_posix()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Attribute):
            owner = ast.unparse(node.value)
            private = node.attr.startswith("_") and not node.attr.startswith("__")
            if private and owner not in {"self", "cls", "os"} and node.attr not in OF_NAMED_TUPLES:
                yield f"{place}: {owner}.{node.attr}"
            elif owner.endswith(".handle"):
                yield f"{place}: handle.{node.attr}"
        elif isinstance(node, ast.ImportFrom):
            parts = (node.module or "").split(".")
            # typing has no public name for the readers and writers of csv
            if ("impl" in parts or any(part.startswith("_") for part in parts)) and parts != ["__future__"]:
                yield f"{place}: {node.module}"


def test_the_package_uses_no_private_interface_but_those_listed() -> None:
    found = {use for path in PACKAGE.rglob("*.py") for use in private_uses(path)}
    own = {use for use in found if re.search(r": (self|cls)\b", use)}
    assert found - own == LISTED


def test_each_is_told_of_in_contributing() -> None:
    text = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    for use in LISTED:
        place, _, name = use.partition(": ")
        assert f"| `{place}` | `{name}` |" in text


@pytest.mark.graph
def test_rclpy_takes_a_message_when_asked() -> None:
    import rclpy  # noqa: PLC0415 - where there is no ROS, this test is not run
    from std_msgs.msg import Float64  # noqa: PLC0415

    context = rclpy.Context()
    context.init()
    node = rclpy.create_node("taker", context=context)
    handle = node.create_subscription(Float64, "value", lambda _: None, 1).handle
    try:
        assert hasattr(handle, "take_message"), (
            f"rclpy {version('rclpy')}: Subscription.handle.take_message is gone: commands act one period "
            "later than they could (SteeringSubscription.take)"
        )
        with handle:
            assert handle.take_message(Float64, False) is None  # noqa: FBT003 - as rclpy's executor calls it
    finally:
        node.destroy_node()
        context.try_shutdown()


def test_mcap_reads_a_record_where_it_is_overridden() -> None:
    from mcap.stream_reader import StreamReader  # noqa: PLC0415

    parameters = list(inspect.signature(getattr(StreamReader, "_read_record", lambda: None)).parameters)
    assert parameters == ["self", "opcode", "length"], (
        f"mcap {version('mcap')}: StreamReader._read_record(opcode, length) is gone: a file that ends in "
        "zeros is read to its end, a record of nine bytes at a time (yawdamp_ros/logs/mcap_log.py, _Reader)"
    )
    assert "self._read_record(" in inspect.getsource(StreamReader.records.fget), (
        f"mcap {version('mcap')}: StreamReader.records no longer calls _read_record: nothing stops at zeros"
    )
