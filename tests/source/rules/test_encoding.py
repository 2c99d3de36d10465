"""A file of Python is refused where, and only where, Python refuses its bytes."""

import subprocess
import sys

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.match_file import match_file
from roslens.source.settings import MacroSettings


@pytest.mark.parametrize(
    ("content", "line"),
    [
        (b"x = 'caf\xe9'\n", 1),
        (b"x = 1\n\n# caf\xe9\n", 3),
        (b"# coding: latin-1\nx = 'caf\xe9'\n", None),
        (b"# coding: utf-8\nx = 1\ny = 'caf\xe9'\n", 3),
        (b"#!/usr/bin/python\n# -*- coding: no-such -*-\nx = 1\n", 1),
        (b"x = 1\ny = 2\n# coding: no-such\n", None),
        ("x = 'café'\n".encode(), None),
        ("\ufeffx = 'café'\n".encode(), None),
        (b"coding = 1\n", None),
    ],
)
def test_what_python_refuses(content, line, tmp_path):
    view = parse_file(content, Language.PYTHON, MacroSettings()).view()
    found = [hit.line for hit in match_file(view).hits if hit.rule == "python.encoding"]
    assert found == ([] if line is None else [line])
    (tmp_path / "x.py").write_bytes(content)
    ran = subprocess.run([sys.executable, str(tmp_path / "x.py")], capture_output=True, check=False)
    assert (b"SyntaxError" in ran.stderr) == bool(found)
