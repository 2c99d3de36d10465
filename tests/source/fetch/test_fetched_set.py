"""A workspace that was fetched, checked: its repositories, the packages that are wanted, what is missing."""

import json

import pytest

from roslens.cli.main import main
from roslens.cli.workplace.workplace import open_store


@pytest.fixture
def given(server, here):
    """Two repositories, one of two packages, and one that is not there; in a .repos file with a filter beside."""
    one = server.package("one")
    server.commit(
        "one", {"extra/package.xml": (server.folder / "one/one/package.xml").read_text().replace(">one<", ">extra<")}
    )
    two = server.package("two", "deux")
    entries = {"one": one, "group/two": two, "gone": server.url("gone")}
    text = json.dumps({"repositories": {name: {"type": "git", "url": url} for name, url in entries.items()}})
    (here / "in.repos").write_text(text)
    return ["--distribution", "in.repos", "--into", "ws"]


def report(here, *words):
    code = main(["check", "-q", "--jobs", "1", "--no-graph", "--format", "json", "-o", "r.json", *words])
    return code, json.loads((here / "r.json").read_text())


def test_fetch_and_check_in_one(given, server, here):
    code, found = report(here, "--fetch", *given)
    assert code == 3
    assert [(one["name"], one["path"], one["packages"]) for one in found["repositories"]] == [
        ("group/two", "group/two", ["deux"]),
        ("one", "one", ["extra", "one"]),
    ]
    assert found["repositories"][1]["commit"] == server.git("one", "rev-parse", "HEAD")
    assert found["repositories"][1]["url"] == server.url("one")
    assert {one["id"]: one["repository"] for one in found["packages"]} == {"deux": "two", "extra": "one", "one": "one"}
    (missing,) = [one for one in found["failures"] if one["tool"] == "fetch"]
    assert missing["entity"] == "repository:gone"
    # The same without fetching: what is missing is still reported.
    assert report(here, "ws")[0] == 3
    with open_store("ws") as store:
        view = store.view()
        assert [one.name for one in view.header.repositories] == ["group/two", "one"]


def test_only_the_packages_that_are_wanted(given, here):
    (here / "filter.yaml").write_text("packages: {one: [extra, absent], group/two: []}\n")
    code, found = report(here, "--fetch", *given, "--filter", "filter.yaml")
    assert code == 3
    assert [one["id"] for one in found["packages"]] == ["deux", "extra"]
    (absent,) = [one for one in found["failures"] if one["tool"] == "fetch"]
    assert absent["what"].startswith("the package 'absent' is not in it at ")


def test_a_changed_file_shows_in_the_commit(given, server, here):
    report(here, "--fetch", *given, "--repository", "one")
    (here / "ws/one/one/new.py").write_text("x = 1\n")
    (here / "ws/one/one/package.xml").write_text((here / "ws/one/one/package.xml").read_text() + "\n")
    _, found = report(here, "ws")
    assert found["repositories"][0]["commit"] == server.git("one", "rev-parse", "HEAD") + "+"


def test_a_lock_that_cannot_be_read_is_a_failure(given, here):
    report(here, "--fetch", *given, "--repository", "one")
    (here / "ws/fetched.repos").write_text("[")
    code, found = report(here, "ws")
    assert code == 3
    assert [one["path"] for one in found["failures"] if one["tool"] == "fetch"] == ["fetched.repos"]


def test_wrong_usage(given, here):
    assert main(["check", "--package", "x"]) == 2
    assert main(["check", "--fetch", "ws", *given]) == 2
