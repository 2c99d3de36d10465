"""roslens measures itself by the command and the gate that it offers to others: src/roslens.toml."""

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_no_function_is_above_the_limit_of_cognitive_complexity():
    roslens = Path(sys.executable).with_name("roslens")
    ended = subprocess.run(
        [roslens, "check", "src", "--no-store", "--quiet", "--format", "gitlab"],
        cwd=ROOT,
        capture_output=True,
        check=False,
        text=True,
    )
    assert ended.returncode in (0, 1), ended.stderr
    found = [
        f"{one['location']['path']}:{one['location']['lines']['begin']}: {one['description']}"
        for one in json.loads(ended.stdout)
    ]
    assert ended.returncode == 0, "the gate of src/roslens.toml is broken; divide what is new of\n" + "\n".join(found)
