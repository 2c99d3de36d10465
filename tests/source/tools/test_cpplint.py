"""What cpplint printed is what is reported."""

from pathlib import Path

import msgspec
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


OPTIONS = {"filter": ["+runtime/int"], "line_length": 120}


def test_options_reach_the_call():
    words = plugin.words(request(plugin, ("-x.cpp",), options=OPTIONS, own_settings=True))
    assert "--filter=+runtime/int" in words
    assert "--linelength=120" in words
    assert words[-2:] == ["--", "./-x.cpp"]


def test_where_settings_do_not_count_it_looks_at_links_without_any_above_them(tmp_path):
    root, scratch = tmp_path / "ws", tmp_path / "scratch"
    (root / "arm" / "src" / ".git").mkdir(parents=True)
    (root / "arm" / "src" / "a.cpp").write_text("int a;\n")
    (root / "CPPLINT.cfg").write_text("filter=-\n")
    scratch.mkdir()
    asked = request(plugin, ("arm/src/a.cpp",), options=OPTIONS)
    asked = msgspec.structs.replace(asked, root=str(root), scratch=str(scratch))
    link = plugin.words(asked)[-1]
    assert Path(link).read_text() == "int a;\n"
    assert [path.name for path in sorted(Path(link).parent.iterdir())] == [".git", "a.cpp"], "the repository is known"
    settings = [path / "CPPLINT.cfg" for path in Path(link).parents if (path / "CPPLINT.cfg").exists()]
    assert [path.read_text() for path in settings] == ["set noparent\n"]
    found = plugin.read(
        Ended(1, f"Done processing {link}\n".encode(), f"{link}:1:  x  [runtime/int] [4]\n".encode()), asked
    )
    assert [(one.path, one.check) for one in found.findings] == [("arm/src/a.cpp", "runtime/int")]
