"""What tools printed when they looked at ``tests/fixtures/tool_output/sources``, and tools that play it back."""

from pathlib import Path

from roslens.plugins.options import resolve_options
from roslens.source.tools.running.run_tool import Ended
from roslens.source.tools.tool import Request

OUTPUT = Path(__file__).parent / "fixtures" / "tool_output"
SOURCES = OUTPUT / "sources"
ROOT = "/robot"


def request(tool, files=(), **given):
    """Return a call of a tool in the workspace that the output was recorded in."""
    options = resolve_options(tool.manifest, given.pop("options", {}))
    return Request(
        "/usr/bin/tool", ROOT, tuple(f"./{file}" for file in files), options, **{"scratch": "/tmp/scratch", **given}
    )


def ended(tool, code=1, stdout="stdout", stderr="stderr"):
    """Return what a tool left."""
    folder = OUTPUT / tool.name
    content = [(folder / name).read_bytes() if (folder / name).is_file() else b"" for name in (stdout, stderr)]
    return Ended(code, *content)


def reading(tool, files, code=1, **more):
    """Return what a tool's recorded output says of files."""
    return tool.read(tool.checked(ended(tool, code)), request(tool, files, **more))
