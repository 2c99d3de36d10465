"""What ruff printed is what is reported."""

import pytest
from recorded_tools import reading, request, seen

from roslens.source.tools.ruff import plugin
from roslens.source.tools.run_tool import Ended, ToolError


def test_findings():
    assert seen(reading(plugin, ("sample.py", "old.py"))) == [
        ("old.py", 1, "syntax-error"),
        ("sample.py", 1, "I001"),
        ("sample.py", 1, "F401"),
        ("sample.py", 2, "F401"),
        ("sample.py", 2, "F401"),
        ("sample.py", 3, "B006"),
        ("sample.py", 5, "F821"),
        ("sample.py", 6, "E722"),
        ("sample.py", 6, "S110"),
        ("sample.py", 9, "F841"),
    ]


@pytest.mark.parametrize("output", [b"", b'{"a": 1}', b'[{"filename": 3}]'], ids=["nothing", "object", "types"])
def test_output_of_something_else(output):
    with pytest.raises(ToolError, match="printed what cannot be read"):
        plugin.read(Ended(0, output, b""), request(plugin, ("sample.py",)))


def test_an_exit_code_that_is_none_of_its_own():
    with pytest.raises(ToolError, match="ended with exit code 2: bad option"):
        plugin.checked(Ended(2, b"", b"ruff failed\nbad option\n"))
