"""The tutorials do what they say: each command in its order, each result that they print, each exit code."""

from __future__ import annotations

from pathlib import Path

import pytest
from documents.commands import ROOT, Block, Done, Reader, blocks, squeezed, without_comment

from roslens.cli.main import parser

TUTORIALS = sorted((ROOT / "docs/tutorials").glob("*.md"))
ENVIRONMENT = ("python3 -m venv", "pip install")
"""The tests run in an environment that is made already."""
ON_A_ROBOT = ("roslens watch --ros2", "roslens run -- ros2")
"""What needs a ROS that is set up in the shell is only understood."""

pytestmark = pytest.mark.heavy


def test_there_are_tutorials() -> None:
    assert len(TUTORIALS) >= 2


@pytest.mark.parametrize("path", TUTORIALS, ids=lambda path: path.stem)
def test_a_reader_who_follows_it_sees_what_it_says(path: Path, tmp_path: Path) -> None:
    reader = Reader(tmp_path)
    done = Done(0, "")
    for block in blocks(path.read_text("utf-8")):
        where = f"{path.name}:{block.line}"
        if block.is_commands:
            done = run(reader, block, where)
        else:
            shows(block, done, where)
        if block.exit_code is not None:
            assert done.code == block.exit_code, f"{where}: {done.printed[-2000:]}"


def run(reader: Reader, block: Block, where: str) -> Done:
    done = Done(0, "")
    for line in block.lines:
        command = without_comment(line)
        if command.startswith(ENVIRONMENT):
            continue
        if command.startswith(ON_A_ROBOT):
            understood(command)
            continue
        if " ID " in command:
            command = command.replace(" ID ", f" {reader.some_finding()} ")
        done = reader.type(command)
        assert done.code in {0, 1, 3}, f"{where}: `{command}` ends with {done.code}: {done.printed[-2000:]}"
    return done


def shows(block: Block, done: Done, where: str) -> None:
    """Assert that a command printed each line of a block, wherever the terminal breaks it."""
    printed = squeezed(done.printed)
    whole = squeezed(" ".join(block.lines))
    lines = [squeezed(line) for line in block.lines]
    assert whole in printed or all(line in printed for line in lines), (
        f"{where}: not printed:\n{whole}\nbut:\n{done.printed}"
    )


def understood(command: str) -> None:
    """Assert that the command line has these options; raises SystemExit otherwise."""
    words = command.split()[1:]
    parser(words[0]).parse_args(words)
