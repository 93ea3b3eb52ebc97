"""Build a message of Autoware's from its definition, for its packages are not on PyPI: ``... DIRECTORY``.

The definition is autoware_control_msgs' Lateral.msg (Apache-2.0, autowarefoundation/autoware_msgs).
"""

import os
import shlex
import subprocess
import sys
import sysconfig
from pathlib import Path

import numpy as np

PACKAGE = "autoware_control_msgs"
LATERAL = """\
builtin_interfaces/Time stamp
builtin_interfaces/Time control_time
float32 steering_tire_angle
float32 steering_tire_rotation_rate
bool is_defined_steering_tire_rotation_rate
"""
PREFIX = Path(sys.prefix)
NEEDED = (
    *(f"builtin_interfaces__rosidl_{part}" for part in ("generator_c", "generator_py")),
    *(f"builtin_interfaces__rosidl_typesupport_{part}" for part in ("fastrtps_c", "introspection_c")),
    *("rosidl_runtime_c", "rosidl_typesupport_c", "rosidl_typesupport_fastrtps_c"),
    *("rosidl_typesupport_fastrtps_cpp", "rosidl_typesupport_introspection_c"),
)


def build(directory: Path) -> None:
    """Generate the sources of the message, compile them, and put them into an ament index."""
    # The generators are no dependency: they come with the wheels of rclpy, or the test is skipped.
    from rosidl_adapter.cli import TranslateMsgToIDL  # noqa: PLC0415
    from rosidl_generator_c.cli import GenerateC  # noqa: PLC0415
    from rosidl_generator_py.cli import GeneratePython  # noqa: PLC0415
    from rosidl_generator_type_description.cli import HashTypeDescription  # noqa: PLC0415
    from rosidl_typesupport_c.cli import GenerateCTypesupport  # noqa: PLC0415
    from rosidl_typesupport_fastrtps_c.cli import GenerateFastRTPSCTypesupport  # noqa: PLC0415
    from rosidl_typesupport_introspection_c.cli import GenerateIntrospectionCTypesupport  # noqa: PLC0415

    share, out, lib = directory / "share" / PACKAGE, directory / "out" / PACKAGE, directory / "lib"
    other = directory / "introspection" / PACKAGE
    index = directory / "share" / "ament_index" / "resource_index" / "packages"
    for made in (share / "msg", out, other, lib, index):
        made.mkdir(parents=True)
    (index / PACKAGE).touch()
    (share / "msg" / "Lateral.msg").write_text(LATERAL, encoding="utf-8")
    includes = [str(PREFIX / "share")]
    os.chdir(share)
    TranslateMsgToIDL("msg2idl").translate(PACKAGE, ["msg/Lateral.msg"], includes, out)
    os.chdir(out)
    files = ["msg/Lateral.idl"]
    HashTypeDescription("hash").generate_type_hashes(PACKAGE, files, includes, out)
    for generator in (GenerateC, GeneratePython, GenerateCTypesupport, GenerateFastRTPSCTypesupport):
        generator("any").generate(PACKAGE, files, includes, out)
    # Its file names are those of the generator for C.
    GenerateIntrospectionCTypesupport("any").generate(PACKAGE, files, includes, other)
    (out / "__init__.py").touch()
    own = f"-l{PACKAGE}__rosidl_generator_c"
    c = sorted(map(str, (out / "msg" / "detail").glob("*.c")))
    _link(directory, "gcc", c, lib / f"lib{PACKAGE}__rosidl_generator_c.so")
    for source, part in (
        (out / "msg" / "detail" / "lateral__type_support_c.cpp", "typesupport_fastrtps_c"),
        (out / "msg" / "lateral__type_support.cpp", "typesupport_c"),
        (other / "msg" / "detail" / "lateral__type_support.c", "typesupport_introspection_c"),
        (out / "msg" / "_lateral_s.c", "generator_py"),
    ):
        compiler = "g++" if source.suffix == ".cpp" else "gcc"
        _link(directory, compiler, [str(source)], lib / f"lib{PACKAGE}__rosidl_{part}.so", own)
    module = f"{PACKAGE}_s__rosidl_typesupport_c{sysconfig.get_config_var('EXT_SUFFIX')}"
    parts = [f"-l{PACKAGE}__rosidl_{part}" for part in ("generator_py", "typesupport_c")]
    source = out / f"_{PACKAGE}_s.ep.rosidl_typesupport_c.c"
    _link(directory, "gcc", [str(source)], out / module, *parts, own)


def _link(directory: Path, compiler: str, sources: list[str], target: Path, *libraries: str) -> None:
    headers = [directory / "out", directory / "introspection", PREFIX / "include"]
    headers += sorted((PREFIX / "include").iterdir())
    headers += [Path(sysconfig.get_path("include")), Path(np.get_include())]
    command = [compiler, *shlex.split("-shared -fPIC -O0 -w -Wl,--allow-shlib-undefined -Wl,--no-as-needed")]
    command += [f"-I{header}" for header in headers]
    command += [f"-L{PREFIX / 'lib'}", f"-L{directory / 'lib'}", *sources, "-o", str(target)]
    command += [*libraries, *(f"-l{name}" for name in NEEDED)]
    subprocess.run(command, check=True)


if __name__ == "__main__":
    build(Path(sys.argv[1]))
