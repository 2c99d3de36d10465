"""A mutant in a copy of a small project: noticed, not noticed, and one that does not end."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.heavy

SOURCE = "def count(most):\n    found = 0\n    while found < most:\n        found += 1\n    return found\n"
TESTS = "from counted import count\n\ndef test_it():\n    assert count(3) == 3\n"


def test_what_becomes_of_mutants(tmp_path):
    copy = tmp_path / "copy"
    (copy / "src").mkdir(parents=True)
    (copy / "tests").mkdir()
    (copy / "tests" / "test_counted.py").write_text(TESTS)
    (copy / "pytest.ini").write_text("[pytest]\nmarkers =\n" + "".join(
        f"    {name}\n" for name in ("slow", "nightly", "browser", "corpora", "real", "heavy")
    ))  # fmt: skip
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parents[1])}
    with subprocess.Popen(
        [sys.executable, "-m", "mutants.server", str(copy)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        text=True, env=environment,
    ) as server:  # fmt: skip
        for old, new, said in (
            ("", "", "survived"),
            ("found = 0", "found = 1 - 1", "survived"),
            ("found = 0", "found = 9", "killed"),
            ("found += 1", "pass", "endless"),
            ("def count", "def counted", "killed"),
        ):
            (copy / "src" / "counted.py").write_text(SOURCE.replace(old, new) if old else SOURCE)
            server.stdin.write(json.dumps([["tests/test_counted.py"], 2.0 if said == "endless" else 20.0]) + "\n")
            server.stdin.flush()
            assert json.loads(server.stdout.readline()) == said, (new, (tmp_path / "copy.txt").read_text())
        server.stdin.close()
