"""What a program prints with several numbers of threads."""

import os
import subprocess
import sys
from pathlib import Path


def answers_by_threads(program: str, kernels: str = "") -> set[str]:
    """Different answers of a program with 1, 2, 3 and 7 threads, by named kernels of OpenBLAS or its own."""
    return {
        subprocess.run(
            [sys.executable, "-c", program],
            env={
                **os.environ,
                "OPENBLAS_NUM_THREADS": threads,
                "OPENBLAS_CORETYPE": kernels,
                "PYTHONPATH": str(Path(__file__).parent),
            },
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for threads in ("1", "2", "3", "7")
    }
