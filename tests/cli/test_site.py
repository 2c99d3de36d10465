"""What the pages read of the workspace: what is in it, and nothing else, whatever a run says its files are called."""

import os
from types import SimpleNamespace

import pytest

from roslens.cli.graph.site import site_of, source_reader
from roslens.model.errors import DocumentError


@pytest.fixture
def root(tmp_path):
    made = tmp_path / "ws"
    (made / "arm").mkdir(parents=True)
    (made / "arm" / "a.cpp").write_bytes(b"int a;")
    (tmp_path / "ws-secret").write_bytes(b"secret")
    (tmp_path / "secret").write_bytes(b"secret")
    (made / "link").symlink_to(tmp_path / "secret")
    (made / "folder").symlink_to(tmp_path)
    (made / "loop").symlink_to("loop")
    os.mkfifo(made / "pipe")
    return made


@pytest.mark.parametrize("path", ["arm/a.cpp", "arm/../arm/a.cpp", "./arm/a.cpp"])
def test_a_file_of_the_workspace_is_read(root, path):
    assert source_reader(root)(path) == b"int a;"


@pytest.mark.parametrize(
    "path",
    [
        "../secret", "arm/../../secret", "../ws-secret", "link", "folder/secret", "folder/ws/../secret", "loop", "pipe",
        "arm", "", ".", "gone", "a\0b", "a" * 300, "/etc/passwd", "/proc/self/environ",
    ],
)  # fmt: skip
def test_nothing_else_is(root, path):
    assert source_reader(root)(path) is None


def test_an_absolute_path_is_not_read(root, tmp_path):
    assert source_reader(root)(str(tmp_path / "secret")) is None


@pytest.fixture
def run():
    quantity = SimpleNamespace(key="loc")
    header = SimpleNamespace(models=("own", "roslens"), root="/nowhere")
    return SimpleNamespace(workspace=SimpleNamespace(quantities=(quantity,)), header=header)


@pytest.fixture
def models(monkeypatch):
    """Stand for the site by what it is made of, and for models by their names; ``missing`` cannot be loaded."""

    def load(name, quantities):
        assert list(quantities) == ["loc"]
        if name in missing:
            raise DocumentError("no such quantity", expected="one that was measured")
        return name

    missing = set()
    monkeypatch.setattr("roslens.dashboard.site.Site", lambda view, **given: SimpleNamespace(view=view, **given))
    monkeypatch.setattr("roslens.judge.quality.quality_model.load_model", load)
    monkeypatch.setattr("roslens.judge.quality.quality_model.builtin_models", lambda: ("roslens", "other"))
    return missing


def test_a_site_has_the_models_of_the_run_and_the_others_once(run, models):
    found = site_of(run)
    assert found.view is run
    assert found.models == ("own", "roslens", "other")
    assert (found.configurations, found.about, found.unstarted) == (None, None, ())
    assert (found.graph_note, found.graphs_counted) == ("", True)
    assert found.read_source("gone.cpp") is None


def test_a_model_that_cannot_be_loaded_keeps_no_other_away(run, models):
    models |= {"own", "roslens"}
    assert site_of(run).models == ("other",)


def test_what_is_said_of_graphs_is_handed_on(run, models):
    shown = SimpleNamespace(configurations=("c",), findings=("f",), unstarted=("u",))
    found = site_of(run, shown, "a note", counted=False)
    assert (found.configurations, found.about, found.unstarted) == (("c",), ("f",), ("u",))
    assert (found.graph_note, found.graphs_counted) == ("a note", False)
