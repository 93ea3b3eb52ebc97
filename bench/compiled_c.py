"""The nonlinear model's steps by a kernel that is written by hand in C, where there is gcc."""

import ctypes
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np

from yawdamp_ros.dynamics.kinematics import FloatArray
from yawdamp_ros.nonlinear import NonlinearDynamics

Steps = Callable[[FloatArray, FloatArray, float, int], None]

SOURCE = Path(__file__).with_name("kernel.c")


def compiled_steps(dynamics: NonlinearDynamics, directory: Path) -> Steps | None:
    """Function that takes steps from a state, which it changes; None where there is no gcc."""
    gcc = shutil.which("gcc")
    if gcc is None:
        return None
    library = directory / "kernel.so"
    options = ["-O3", "-march=native", "-shared", "-fPIC", "-o", str(library), str(SOURCE), "-lm"]
    subprocess.run([gcc, *options], check=True)  # noqa: S603 - this project's own source
    kernel = ctypes.CDLL(str(library)).steps
    kernel.restype = None
    p = dynamics.parameters
    tables = [np.ascontiguousarray(table) for table in (p.units, p.axles, p.scalars, p.first_axle)]
    fixed = [
        ctypes.c_long(dynamics.layout.units),
        ctypes.c_long(dynamics.layout.axles),
        *(ctypes.c_void_p(table.ctypes.data) for table in tables),
    ]

    def steps(state: FloatArray, inputs: FloatArray, dt: float, count: int) -> None:
        places = [ctypes.c_void_p(array.ctypes.data) for array in (state, inputs)]
        kernel(*fixed, *places, ctypes.c_double(dt), ctypes.c_long(count))

    # The kernel reads the tables for as long as it is there.
    steps.tables = tables  # type: ignore[attr-defined]
    return steps
