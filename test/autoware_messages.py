"""Build messages of Autoware's from their definitions, for its packages are not on PyPI: ``... DIRECTORY``.

The definitions are those of autoware_msgs (Apache-2.0, autowarefoundation/autoware_msgs), some constants and
comments left out.
"""

import os
import shlex
import subprocess
import sys
import sysconfig
from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

TIME = "builtin_interfaces/Time stamp\n"
BOTH_TIMES = TIME + "builtin_interfaces/Time control_time\n"
PACKAGES: Mapping[str, Mapping[str, str]] = {
    "autoware_control_msgs": {
        "Lateral": f"{BOTH_TIMES}float32 steering_tire_angle\nfloat32 steering_tire_rotation_rate\n"
        "bool is_defined_steering_tire_rotation_rate\n",
        "Longitudinal": f"{BOTH_TIMES}float32 velocity\nfloat32 acceleration\nfloat32 jerk\n"
        "bool is_defined_acceleration\nbool is_defined_jerk\n",
        "Control": f"{BOTH_TIMES}Lateral lateral\nLongitudinal longitudinal\n",
    },
    "autoware_vehicle_msgs": {
        "GearCommand": f"uint8 DRIVE = 2\nuint8 REVERSE = 20\n{TIME}uint8 command\n",
        "GearReport": f"{TIME}uint8 report\n",
        "ControlModeReport": f"{TIME}uint8 mode\n",
        "SteeringReport": f"{TIME}float32 steering_tire_angle\n",
        "VelocityReport": "std_msgs/Header header\nfloat32 longitudinal_velocity\n"
        "float32 lateral_velocity\nfloat32 heading_rate\n",
    },
}
PREFIX = Path(sys.prefix)
NEEDED = (
    *(
        f"{package}__rosidl_{part}"
        for package in ("builtin_interfaces", "std_msgs")
        for part in ("generator_c", "generator_py", "typesupport_fastrtps_c", "typesupport_introspection_c")
    ),
    *("rosidl_runtime_c", "rosidl_typesupport_c", "rosidl_typesupport_fastrtps_c"),
    *("rosidl_typesupport_fastrtps_cpp", "rosidl_typesupport_introspection_c"),
)


def build(directory: Path, package: str, definitions: Mapping[str, str]) -> None:
    """Generate the sources of the messages, compile them, and put them into an ament index."""
    # The generators are no dependency: they come with the wheels of rclpy, or the test is skipped.
    from rosidl_adapter.cli import TranslateMsgToIDL  # noqa: PLC0415
    from rosidl_generator_c.cli import GenerateC  # noqa: PLC0415
    from rosidl_generator_py.cli import GeneratePython  # noqa: PLC0415
    from rosidl_generator_type_description.cli import HashTypeDescription  # noqa: PLC0415
    from rosidl_typesupport_c.cli import GenerateCTypesupport  # noqa: PLC0415
    from rosidl_typesupport_fastrtps_c.cli import GenerateFastRTPSCTypesupport  # noqa: PLC0415
    from rosidl_typesupport_introspection_c.cli import GenerateIntrospectionCTypesupport  # noqa: PLC0415

    share, out, lib = directory / "share" / package, directory / "out" / package, directory / "lib"
    other = directory / "introspection" / package
    index = directory / "share" / "ament_index" / "resource_index" / "packages"
    for made in (share / "msg", out, other, lib, index):
        made.mkdir(parents=True, exist_ok=True)
    (index / package).touch()
    for name, definition in definitions.items():
        (share / "msg" / f"{name}.msg").write_text(definition, encoding="utf-8")
    includes = [str(PREFIX / "share")]
    os.chdir(share)
    TranslateMsgToIDL("msg2idl").translate(
        package, [f"msg/{name}.msg" for name in definitions], includes, out
    )
    os.chdir(out)
    files = [f"msg/{name}.idl" for name in definitions]
    HashTypeDescription("hash").generate_type_hashes(package, files, includes, out)
    for generator in (GenerateC, GeneratePython, GenerateCTypesupport, GenerateFastRTPSCTypesupport):
        generator("any").generate(package, files, includes, out)
    # Its file names are those of the generator for C.
    GenerateIntrospectionCTypesupport("any").generate(package, files, includes, other)
    (out / "__init__.py").touch()
    _link_all(directory, package, out / "msg", other / "msg" / "detail")


def _link_all(directory: Path, package: str, messages: Path, introspection: Path) -> None:
    """Compile what was generated into the libraries that rclpy loads."""
    lib, own, detail = directory / "lib", f"-l{package}__rosidl_generator_c", messages / "detail"
    _link(directory, detail.glob("*.c"), lib / f"lib{package}__rosidl_generator_c.so")
    for sources, part in (
        (detail.glob("*__type_support_c.cpp"), "typesupport_fastrtps_c"),
        (messages.glob("*__type_support.cpp"), "typesupport_c"),
        (introspection.glob("*__type_support.c"), "typesupport_introspection_c"),
        (messages.glob("_*_s.c"), "generator_py"),
    ):
        _link(directory, sources, lib / f"lib{package}__rosidl_{part}.so", own)
    module = f"{package}_s__rosidl_typesupport_c{sysconfig.get_config_var('EXT_SUFFIX')}"
    parts = [f"-l{package}__rosidl_{part}" for part in ("generator_py", "typesupport_c")]
    source = messages.parent / f"_{package}_s.ep.rosidl_typesupport_c.c"
    _link(directory, [source], messages.parent / module, *parts, own)


def _link(directory: Path, sources: Iterable[Path], target: Path, *libraries: str) -> None:
    headers = [directory / "out", directory / "introspection", PREFIX / "include"]
    headers += sorted((PREFIX / "include").iterdir())
    headers += [Path(sysconfig.get_path("include")), Path(np.get_include())]
    files = sorted(map(str, sources))
    command = ["g++" if files[0].endswith("pp") else "gcc"]
    command += shlex.split("-shared -fPIC -O0 -w -Wl,--allow-shlib-undefined -Wl,--no-as-needed")
    command += [f"-I{header}" for header in headers]
    command += [f"-L{PREFIX / 'lib'}", f"-L{directory / 'lib'}", *files, "-o", str(target)]
    command += [*libraries, *(f"-l{name}" for name in NEEDED)]
    subprocess.run(command, check=True)


if __name__ == "__main__":
    for name, messages in PACKAGES.items():
        build(Path(sys.argv[1]), name, messages)
