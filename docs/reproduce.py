"""Write docs/report_reproduction.md and the pictures of docs/, or check that it says what comes out."""

import argparse
import re
import sys
from pathlib import Path
from string import Template

from reproduction.drawing import write_drawing
from reproduction.pictures import write_pictures
from reproduction.tables import fields

DOCS = Path(__file__).parent
DOCUMENT = DOCS / "report_reproduction.md"
NUMBER = re.compile(r"(?<![\w.])-?\d+(?:\.\d+)?")


def document() -> str:
    """Text of the reproduction, from its template and the numbers of today's code."""
    template = Template((DOCS / "reproduction" / "template.md").read_text(encoding="utf-8"))
    return template.substitute(fields())


def differences(committed: str, computed: str) -> list[str]:
    """Lines that differ by more than one unit in the last digit of a number, which rounding explains."""
    old, new = committed.splitlines(), computed.splitlines()
    if len(old) != len(new):
        return [f"{len(old)} lines, and {len(new)} come out"]
    return [
        f"line {number}: {before}\n  comes out as: {after}"
        for number, (before, after) in enumerate(zip(old, new, strict=True), 1)
        if not _alike(before, after)
    ]


def main() -> int:
    """Write the document, or compare."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--check", action="store_true", help="compare only; 1 if the document is stale")
    options = parser.parse_args()
    computed = document()
    if options.check:
        stale = differences(DOCUMENT.read_text(encoding="utf-8"), computed)
        for line in stale:
            sys.stderr.write(f"{DOCUMENT.name}: {line}\n")
        return 1 if stale else 0
    DOCUMENT.write_text(computed, encoding="utf-8")
    write_pictures(DOCS / "report_reproduction")
    write_drawing(DOCS / "theory.svg")
    return 0


def _alike(before: str, after: str) -> bool:
    if NUMBER.sub("#", before) != NUMBER.sub("#", after):
        return False
    pairs = zip(NUMBER.findall(before), NUMBER.findall(after), strict=True)
    return all(_near(old, new) for old, new in pairs)


def _near(old: str, new: str) -> bool:
    decimals = len(old.partition(".")[2])
    if decimals != len(new.partition(".")[2]):
        return False
    digit = 10.0**-decimals if decimals else 0.0
    return abs(float(old) - float(new)) <= 1.001 * digit


if __name__ == "__main__":
    sys.exit(main())
