"""What ruff printed is what is reported."""

import pytest
from recorded_tools import request

from roslens.source.tools.ruff import plugin
from roslens.source.tools.running.run_tool import Ended, ToolError


@pytest.mark.parametrize("output", [b"", b'{"a": 1}', b'[{"filename": 3}]'], ids=["nothing", "object", "types"])
def test_output_of_something_else(output):
    with pytest.raises(ToolError, match="printed what cannot be read"):
        plugin.read(Ended(0, output, b""), request(plugin, ("sample.py",)))


def test_an_exit_code_that_is_none_of_its_own():
    with pytest.raises(ToolError, match="ended with exit code 2: bad option"):
        plugin.checked(Ended(2, b"", b"ruff failed\nbad option\n"))
