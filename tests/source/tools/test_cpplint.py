"""What cpplint printed is what is reported."""

import pytest
from recorded_tools import OUTPUT, reading, request

from roslens.source.tools.cpplint import plugin
from roslens.source.tools.running.run_tool import Ended, ToolError


def test_a_file_that_it_does_not_name_was_not_looked_at():
    found = reading(plugin, ("sample.hpp", "gone.cpp", "other.cpp"))
    assert found.skipped == {
        "gone.cpp": "Can't open for reading",
        "other.cpp": "it does not report that it checked it",
    }


def test_a_line_of_another_kind_is_told():
    stderr = (OUTPUT / "cpplint" / "stderr").read_bytes() + b"error 17 in engine\n"
    found = plugin.read(Ended(1, b"Done processing ./sample.cpp\n", stderr), request(plugin, ("sample.cpp",)))
    assert found.trouble == ("error 17 in engine",)


@pytest.mark.parametrize(
    "output", [b"", b"\x00\xff" * 20, b"usage: something else\n"], ids=["nothing", "bytes", "usage"]
)
def test_output_of_something_else(output):
    with pytest.raises(ToolError, match="printed what cannot be read"):
        plugin.read(Ended(0, output, b""), request(plugin, ("sample.cpp",)))


def test_options_reach_the_call():
    words = plugin.words(request(plugin, ("-x.cpp",), options={"filter": ["+runtime/int"], "line_length": 120}))
    assert "--filter=+runtime/int" in words
    assert "--linelength=120" in words
    assert words[-2:] == ["--", "./-x.cpp"]
