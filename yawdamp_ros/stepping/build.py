"""Parts of an installation that the last bit of a result depends on."""

import platform

import numpy as np

NUMERICS = 3
"""Version of the computation; a change that affects last bits increases it."""


def build_of_numerics() -> str:
    """Return machine, NumPy, and BLAS with its chosen kernels in one line.

    OpenBLAS selects its kernels when it loads, by the processor or ``OPENBLAS_CORETYPE``; threadpoolctl reads
    it which. Without threadpoolctl the line says that they are not known.
    """
    configuration = np.show_config(mode="dicts")
    blas = configuration["Build Dependencies"]["blas"]
    extensions = configuration["SIMD Extensions"].get("found", [])
    return (
        f"{platform.machine()} ({' '.join(extensions)}), numpy {np.__version__}, "
        f"{blas['name']} {blas['version']}, {_kernels()}, numerics {NUMERICS}"
    )


def _kernels() -> str:
    try:
        # Imported here: few need it, and installations by distributions may lack it.
        from threadpoolctl import threadpool_info  # noqa: PLC0415
    except ImportError:
        return "kernels not known (no threadpoolctl)"
    # SciPy has a BLAS of its own, which no step uses.
    found = [
        library["architecture"]
        for library in threadpool_info()
        if library.get("architecture") and "scipy.libs" not in library["filepath"]
    ]
    return f"{' '.join(dict.fromkeys(found)) or 'unnamed'} kernels"
