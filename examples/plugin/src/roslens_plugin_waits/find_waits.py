"""Where source code waits for a fixed time: pure functions, tested without roslens."""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

NUMBER = r"(?P<number>\d+(?:\.\d*)?|\.\d+)"

SECONDS = 1.0
UNITS = {"h": 3600.0, "min": 60.0, "s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
CHRONO = {"hours": "h", "minutes": "min", "seconds": "s", "milliseconds": "ms", "microseconds": "us", "nanoseconds": "ns"}

CPP_WAITS = (
    (re.compile(rf"\bros::(?:Wall)?Duration\s*\(\s*{NUMBER}f?\s*\)\s*\.\s*sleep\s*\("), SECONDS),
    (re.compile(rf"\bsleep_for\s*\(\s*{NUMBER}(?P<unit>h|min|s|ms|us|ns)\s*\)"), None),
    (re.compile(rf"\bsleep_for\s*\(\s*std::chrono::(?P<chrono>\w+)\s*[({{]\s*{NUMBER}\s*[)}}]"), None),
    (re.compile(rf"(?<![\w.>])usleep\s*\(\s*{NUMBER}\s*\)"), UNITS["us"]),
    (re.compile(rf"(?<![\w.>])sleep\s*\(\s*{NUMBER}\s*\)"), SECONDS),
)
PYTHON_WAITS = ((re.compile(rf"\b(?:rospy|time)\.sleep\s*\(\s*{NUMBER}\s*\)"), SECONDS),)


class Wait(NamedTuple):
    """A fixed wait: 1-based line and column, how long, and how it is written."""

    line: int
    column: int
    seconds: float
    text: str


def find_waits(source: str, language: str) -> Iterator[Wait]:
    """Yield the fixed waits of C++ or Python source, line by line.

    What stands behind ``//`` or ``#`` is a comment; a wait whose time is no number is no fixed wait.
    """
    patterns, comment = (CPP_WAITS, "//") if language in ("c", "cpp") else (PYTHON_WAITS, "#")
    for number, line in enumerate(source.splitlines(), 1):
        code = line.partition(comment)[0]
        for pattern, unit in patterns:
            for match in pattern.finditer(code):
                seconds = float(match["number"]) * (unit if unit is not None else _unit(match))
                yield Wait(number, match.start() + 1, seconds, match.group())


def _unit(match: re.Match[str]) -> float:
    groups = match.groupdict()
    return UNITS[groups.get("unit") or CHRONO.get(groups.get("chrono") or "", "s")]
