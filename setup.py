"""Packaging for colcon (ament_python) and pip alike."""

from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = "yawdamp_ros"
ROOT = Path(__file__).resolve().parent  # colcon's --symlink-install runs a link to this file


def data_directory(directory: str) -> list[tuple[str, list[str]]]:
    """Every file below a directory, to be installed below share/yawdamp_ros alike."""
    files: dict[str, list[str]] = {}
    for path in sorted(Path(directory).rglob("*")):
        if path.is_file():
            files.setdefault(f"share/{PACKAGE}/{path.parent}", []).append(str(path))
    return list(files.items())


setup(
    name=PACKAGE,
    version="0.1.0",
    description="Lateral dynamics of heavy vehicle combinations as a ROS 2 simulator node",
    long_description=(ROOT / "README.md").read_text(encoding="utf-8"),
    long_description_content_type="text/markdown",
    maintainer="yawdamp_ros maintainers",
    maintainer_email="maintainers@yawdamp-ros.example",
    license="Apache-2.0",
    python_requires=">=3.11",
    packages=find_packages(include=[PACKAGE, f"{PACKAGE}.*"]),
    package_data={PACKAGE: ["py.typed", "pictures/*.html", "pictures/page.*s"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        (f"lib/{PACKAGE}", sorted(map(str, Path("resource/commands").iterdir()))),  # for `ros2 run`
        *data_directory("config"),
        *data_directory("launch"),
    ],
    install_requires=[
        "setuptools",
        "numpy>=1.26.4",
        "scipy>=1.11.4",
        "mcap>=1.6.0",  # the run files' own format library
        "mcap-ros2-support>=0.6.0",  # decodes ROS messages from the schemas in a file, without ROS
        "jsonschema>=4.10.3",  # vehicle files, by a schema that editors understand, too
        "ruamel.yaml>=0.17.21",  # YAML 1.2 that refuses a key given twice
        "rich>=13.7.1",  # progress bars and tables for terminals
        "threadpoolctl>=3.1.0",  # tells which kernels the BLAS has chosen, which the last bits depend on
    ],
    extras_require={
        "fast": ["numba>=0.59.1"],  # compiles the nonlinear model, which runs without, a hundred times slower
        "pictures": [
            "matplotlib>=3.6.3",  # the field's plotting library
            "plotly>=5.18.0",  # pages of curves to zoom into, which load nothing from elsewhere
        ],
        "analysis": ["control>=0.10.2"],  # root locus, Bode and Nyquist by the field's own library
        "bags": ["rosbags"],  # reads rosbag2 recordings with sqlite3 storage
        "cluster": ["distributed>=2026.8.0"],  # sweeps on other machines
        "tables": ["openpyxl>=3.1.2"],  # assessments as spreadsheets
        "parquet": ["pyarrow>=26.0.1"],  # sweeps as columns that other tools read fast
        "gymnasium": ["gymnasium>=1.4.0"],  # rigs as environments to learn in
        "pandas": ["pandas>=2.1.4"],  # runs as tables
        "ros": ["ros-jazzy-rclpy[fastrtps]", "ros-jazzy-common-interfaces"],
        # pytest 9 breaks the plugin of the launch_testing that a sourced Jazzy brings.
        "test": [
            "pytest>=7.4.4,<9",
            "pytest-timeout",
            "wheel",  # setuptools before 70.1 cannot install this package without
            "pytest-xdist",
            "hypothesis",
            "psutil",
            "rosbags",
            'atheris; python_version < "3.12"',  # fuzzes; its newest wheels are for Python 3.11
        ],
        # Repeats in several processes, and keeps every value; psutil and rosbags come with the tests.
        "bench": ["pyperf"],
        # The manual: what rosdoc2 builds ROS packages' pages with, and a gallery of scripts.
        "docs": ["sphinx>=8", "myst-parser", "numpydoc", "pydata-sphinx-theme", "sphinx-gallery"],
        "lint": ["ruff", "mypy", "import-linter"],
        "colcon": ["colcon-core", "colcon-ros"],
    },
    entry_points={
        "console_scripts": [f"yawdamp = {PACKAGE}.__main__:main"],
    },
    zip_safe=False,
)
