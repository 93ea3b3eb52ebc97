from importlib import import_module
from pkgutil import iter_modules

import pytest


@pytest.mark.parametrize("package", ["yawdamp_ros", "yawdamp_ros.analysis", "yawdamp_ros.logs"])
def test_every_name_loads_and_none_is_hidden_by_a_module(package: str) -> None:
    found = import_module(package)
    for name in found.__all__:
        assert getattr(found, name) is not None
    assert not {module.name for module in iter_modules(found.__path__)} & set(found.__all__)


def test_a_name_that_there_is_not_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match=r"'yawdamp_ros.logs' has no attribute 'nothing'"):
        import_module("yawdamp_ros.logs").nothing  # noqa: B018
