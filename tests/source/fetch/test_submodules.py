"""Submodules come on request, each at the commit that its repository records; else it is noted that they do not."""

import json

from roslens.cli.main import main
from roslens.intake.safe_yaml import load_yaml


def fetch(here, url, *words, name="one"):
    (here / "in.repos").write_text(json.dumps({"repositories": {name: {"type": "git", "url": url, "version": "main"}}}))
    return main(["fetch", "--no-color", "--into", "ws", "--distribution", "in.repos", *words])


def with_submodule(server, url):
    """Return the URL of a repository with a submodule, and the commit of that."""
    server.package("inner", commits=2)
    recorded = server.git("inner", "rev-parse", "HEAD")
    one = server.package("one")
    server.git("one", "submodule", "add", "-q", server.url("inner"), "libs/inner")
    server.git("one", "config", "--file", ".gitmodules", "submodule.libs/inner.url", url)
    server.commit("one")
    server.commit("inner", {"later": "x"})
    return one, recorded


def head(server, folder):
    return server.git(folder, "rev-parse", "HEAD")


def test_the_recorded_commit_is_fetched(server, here, capsys):
    url, recorded = with_submodule(server, server.url("inner"))
    assert fetch(here, url, "--submodules") == 0
    assert "submodule" not in capsys.readouterr().out
    assert head(server, here / "ws/one/libs/inner") == recorded
    assert (here / "ws/one/libs/inner/inner/package.xml").is_file()
    assert not (here / "ws/one/libs/inner/later").exists()
    lock = load_yaml((here / "ws/fetched.repos").read_bytes())["repositories"]["one"]
    assert lock["roslens"]["submodules"] is True
    # What is there is kept, and another commit is fetched with `--update`.
    assert fetch(here, url, "--submodules") == 0
    assert "1 kept" in capsys.readouterr().out
    now = head(server, server.folder / "inner")
    server.git("one/libs/inner", "fetch", "-q", "origin")
    server.git("one/libs/inner", "checkout", "-q", now)
    server.commit("one")
    assert fetch(here, url, "--submodules", "--update") == 0
    assert head(server, here / "ws/one/libs/inner") == now
    assert (here / "ws/one/libs/inner/later").is_file()


def test_they_come_later_if_they_are_wanted_later(server, here, capsys):
    url, recorded = with_submodule(server, server.url("inner"))
    assert fetch(here, url) == 0
    assert "1 submodule is not fetched, the first at libs/inner; `--submodules` fetches them" in capsys.readouterr().out
    assert not any((here / "ws/one/libs/inner").iterdir())
    assert fetch(here, url, "--submodules") == 0
    assert head(server, here / "ws/one/libs/inner") == recorded


def test_a_relative_url_starts_from_that_of_the_repository(server, here):
    url, recorded = with_submodule(server, "../../inner/.git")
    assert fetch(here, url, "--submodules") == 0
    assert head(server, here / "ws/one/libs/inner") == recorded


def test_a_submodule_that_cannot_be_had_fails_its_repository(server, here, capsys):
    url, _ = with_submodule(server, "../../gone/.git")
    assert fetch(here, url, "--submodules") == 3
    assert "the submodule at libs/inner: " in capsys.readouterr().out
    assert not (here / "ws/one").exists()


def test_a_url_of_another_kind_starts_nothing(server, here, capsys):
    mark = here / "ran"
    url, _ = with_submodule(server, f"ext::touch {mark}")
    assert fetch(here, url, "--submodules") == 3
    assert "the submodule at libs/inner: the URL" in capsys.readouterr().out
    assert not mark.exists()


def test_one_that_contains_itself_ends(server, here, capsys):
    url = server.package("one")
    server.git("one", "submodule", "add", "-q", url, "self")
    server.commit("one")
    # The recorded commit is the one before, which has no submodule: this is no circle.
    assert fetch(here, url, "--submodules") == 0
    assert (here / "ws/one/self/one/package.xml").is_file()
    assert capsys.readouterr()
