"""What is mutated, and which tests are asked about it."""

from __future__ import annotations

from pathlib import Path
from typing import NamedTuple

LEAST_KILLED = 0.8
"""Share of the mutants of each part."""


class Part(NamedTuple):
    """Sources, and the tests that shall notice a change of them."""

    name: str
    sources: tuple[str, ...]
    tests: tuple[str, ...]


PARTS = (
    Part(
        "judge",
        ("src/roslens/judge/**/*.py",),
        ("tests/judge", "tests/live/test_time_lines.py", "tests/live/test_monitor.py"),
    ),
    Part(
        "window",
        ("src/roslens/live/window/window.py",),
        (
            "tests/live/test_window_cases.py", "tests/live/test_window.py",
            "tests/live/test_gaps.py", "tests/live/test_one_stretch.py",
            "tests/live/test_time_lines.py", "tests/live/test_alarm_times.py", "tests/live/test_monitor.py",
        ),
    ),
    Part("store", ("src/roslens/store/*.py",), ("tests/store", "tests/cli/test_own_results.py")),
    Part(
        "agent",
        ("src/roslens/live/agent/*.py", "src/roslens/live/observe/listen.py", "src/roslens/live/observe/host_keys.py"),
        ("tests/live/agent", "tests/live/test_listen.py", "tests/cli/test_agent.py"),
    ),
    Part(
        "guards",
        (
            "src/roslens/dashboard/guard.py", "src/roslens/dashboard/listener.py", "src/roslens/dashboard/server.py",
            "src/roslens/intake/*.py", "src/roslens/live/publish/endpoint.py", "src/roslens/children/git.py",
            "src/roslens/cli/graph/site.py", "src/roslens/source/extract/facts/files.py",
            "src/roslens/source/inventory.py", "src/roslens/live/adapters/bag/decompress.py",
        ),
        (
            "tests/intake", "tests/dashboard/test_guard.py", "tests/dashboard/test_server.py",
            "tests/dashboard/test_listener.py", "tests/dashboard/test_serve.py",
            "tests/live/publish/test_endpoint.py", "tests/children/test_git.py",
            "tests/cli/test_site.py", "tests/source/extract/facts/test_files.py", "tests/source/test_inventory.py",
            "tests/live/adapters/bag/test_decompress.py",
        ),
    ),
)  # fmt: skip


def sources_of(part: Part, root: Path) -> list[Path]:
    """Return the files of a part below a root."""
    found = {path.relative_to(root) for pattern in part.sources for path in root.glob(pattern)}
    return sorted(path for path in found if path.name != "__init__.py")


def asked_about(part: Part, source: Path, root: Path) -> list[str]:
    """Return test files to ask, those named after the source first: most mutants end there."""
    found: list[Path] = []
    for name in part.tests:
        place = root / name
        found += sorted(place.glob("test_*.py")) if place.is_dir() else [place] if place.exists() else []
    stem = source.stem
    found.sort(key=lambda path: stem not in path.stem)
    return [str(path.relative_to(root)) for path in found]
