"""Coverage-guided fuzzing of one target: ``python test/faults/fuzz.py TARGET`` and libFuzzer's arguments.

As the kept corpus is made, from seeds and what was found in a directory of one's own::

    python test/faults/fuzz.py vehicle FOUND test/faults/corpus/vehicle -max_total_time=600
    python test/faults/fuzz.py vehicle -set_cover_merge=1 test/faults/corpus/vehicle FOUND
"""

import sys
import tempfile
from pathlib import Path

import atheris

sys.path.insert(0, str(Path(__file__).parents[1]))
with atheris.instrument_imports(include=["yawdamp_ros", "faults", "mcap", "mcap_ros2", "ruamel"]):
    from faults.targets import judge


def main() -> None:
    """Fuzz until libFuzzer has enough, or something is found."""
    _, target, *arguments = sys.argv
    # libFuzzer merges in processes of its own, which it starts by the first word.
    command = f"{sys.executable} {__file__} {target}"
    directory = Path(tempfile.mkdtemp())
    atheris.Setup([command, *arguments], lambda content: judge(target, content, directory))
    atheris.Fuzz()


if __name__ == "__main__":
    main()
