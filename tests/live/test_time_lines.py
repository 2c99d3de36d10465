"""The rules of judging, each as a time line of what happens and what has to be said of it."""

from __future__ import annotations

from pathlib import Path

import pytest
from live.time_line import Played, read, wrong

LINES = sorted((Path(__file__).parent / "time_lines").glob("*.yaml"))


@pytest.mark.parametrize("path", LINES, ids=lambda path: path.stem)
def test_what_has_to_be_said_is_said(path):
    line = read(path)
    assert wrong(line, Played(line)) == []
