"""`lsp` and `serve` go on whatever shape a file of a workspace has: each is read, or named as left out."""

import sys
import time
from importlib.util import find_spec
from types import SimpleNamespace

import pytest
from cli.editor_client import Editor

from roslens.cli.check.shown_run import shown_run
from roslens.cli.graph.read_beside import GraphsBeside
from roslens.cli.graph.site import site_of
from roslens.cli.terminal.streams import NoProgress
from shapes.workspace import write_shapes

SMALL = 2_000
LARGE = 30_000
LOST = ("s of processor time", "MB of memory", "breaks the parser")

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the kernel's bounds are those of Linux")


@pytest.mark.heavy
@pytest.mark.parametrize("size", [SMALL, pytest.param(LARGE, marks=[pytest.mark.nightly, pytest.mark.timeout(3600)])])
def test_an_editor_is_answered_about_every_shape(tmp_path, size):
    if find_spec("pygls") is None:
        pytest.skip("pygls is not installed: pip install 'roslens[lsp]'")
    written = write_shapes(tmp_path, size)
    editor = Editor(tmp_path)
    try:
        editor.start()
        for shapes in written.values():
            # All files of a package are read about each; the last ones are those that are longest or never closed.
            for name in [*shapes][:: max(1, len(shapes) // 4)]:
                lost = [one["message"] for one in editor.open(shapes[name][0]) if one["code"] == "roslens.not_analysed"]
                assert size > SMALL or not any(why in message for message in lost for why in LOST), (name, lost)
        assert editor.stop() == 0
    finally:
        editor.end()


@pytest.mark.heavy
@pytest.mark.parametrize("size", [SMALL, pytest.param(LARGE, marks=[pytest.mark.nightly, pytest.mark.timeout(3600)])])
def test_pages_show_a_workspace_of_all_shapes(tmp_path, size):
    write_shapes(tmp_path, size)
    asked = SimpleNamespace(
        path=str(tmp_path), changed=False, no_store=True, number=None, no_graph=False, no_cache=True, trust=False
    )
    with shown_run(asked, NoProgress()) as made:
        shown = {file.path for _, file in made.files()}
        assert {"cpp/src/a0.cpp", "yaml/config/a0.yaml", "launch/launch/a0.launch"} <= shown
        lost = [one.what for one in made.failures()]
        assert size > SMALL or not any(why in what for what in lost for why in LOST), lost
        site = site_of(made)
        GraphsBeside(site, made, None, NoProgress(), quiet=True).start()
        end = time.monotonic() + 3000
        while site.reading.startswith("Computation graphs are being read"):
            assert time.monotonic() < end
            time.sleep(0.1)
        assert site.reading == ""
