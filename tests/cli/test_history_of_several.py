"""Past revisions of a workspace that holds several repositories: how they stood together."""

import argparse
import json
import re
from itertools import count

import pytest
from postgres_server import postgres_server
from process_metrics.small_repository import BEGIN_S, DAY_S, MANIFEST, SmallRepository, function

from roslens.cli.main import main
from roslens.cli.past.past_store import kept_past
from roslens.cli.past.shown_past import shown_past
from roslens.cli.workplace.workplace import open_store

_NUMBERS = count()


# Any other test asks a database at night only: what a store answers is the same (`tests/store/postgres/test_same.py`).
on_both = pytest.mark.parametrize(
    "place", ["file", pytest.param("database", marks=pytest.mark.real)], indirect=True, scope="module"
)


@pytest.fixture(
    scope="module", params=["file", pytest.param("database", marks=[pytest.mark.real, pytest.mark.nightly])]
)
def place(request):
    """Yield what gives the address of another store each time; empty for files."""
    if request.param == "file":
        yield lambda: ""
        return
    with postgres_server() as server:
        yield lambda: server.schema(f"several{next(_NUMBERS)}")


@pytest.fixture(autouse=True)
def _store(place, monkeypatch):
    monkeypatch.setenv("ROSLENS_STORE", place())


@pytest.fixture
def workspace(tmp_path, monkeypatch):
    """Two repositories, the second begun later, each with a release; a file is moved in the first."""
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path))
    root = tmp_path / "ws"
    one = SmallRepository(root / "one")
    one.commit("first", day=0, a__package_DOT_xml=MANIFEST.format("a"), a__old_DOT_cpp=function("f", 20))
    one.git("tag", "1.0.0")
    two = SmallRepository(root / "group/two")
    two.commit("first", day=10, package_DOT_xml=MANIFEST.format("b"), b_DOT_cpp=function("g", 2))
    two.git("tag", "0.1.0")
    one.git("mv", "a/old.cpp", "a/new.cpp")
    one.commit("moved", day=40)
    two.commit("more", day=41, b_DOT_cpp=function("g", 20))
    return root, one, two


def out(capsys, *words, code=0):
    assert main([str(word) for word in words]) == code
    return capsys.readouterr().out


def trend(capsys, root, key):
    return json.loads(out(capsys, "trend", key, root, "--format", "json"))


def test_releases_of_any_are_looked_at_with_the_others_as_they_were(workspace, capsys):
    root, one, two = workspace
    assert main(["history", str(root), "--every", "release"]) == 0
    assert "3 revisions of 2 repositories together, 3 of them analysed now" in capsys.readouterr().err
    with kept_past(str(root)).open() as store:
        assert [dict(kept.commits) for kept in store.revisions()] == [
            {"group/two": "", "one": one.git("rev-parse", "1.0.0")},
            {"group/two": two.git("rev-parse", "0.1.0"), "one": one.git("rev-parse", "1.0.0")},
            {"group/two": two.git("rev-parse", "HEAD"), "one": one.git("rev-parse", "HEAD")},
        ]
    found = trend(capsys, root, "loc")
    assert found["packages"] == {"a": [23, 23, 23], "b": [None, 5, 23]}
    assert found["whole"] == [23, 28, 46]
    assert [point["name"] for point in found["points"]] == ["2020-09-13", "2020-09-23", "2020-10-24"]
    assert [(event["point"], event["text"]) for event in found["events"]] == [(0, "one 1.0.0"), (1, "group/two 0.1.0")]
    assert main(["history", str(root), "--every", "release"]) == 0
    assert "0 of them analysed now" in capsys.readouterr().err


def test_what_repositories_have_is_told_of_each(workspace, capsys):
    root, *_ = workspace
    assert main(["history", str(root), "--every", "1", "-q"]) == 0
    found = trend(capsys, root, "revisions")
    assert (found["whole_is"], found["whole"]) == ("repository_sum", [1, 2, 3, 4])
    assert found["repositories"] == {"group/two": [None, 1, 1, 2], "one": [1, 1, 2, 2]}
    assert trend(capsys, root, "contributors")["whole_is"] == "repository_median"
    text = out(capsys, "trend", "revisions", root)
    assert "all repositories" in text
    assert "one/" in text
    rows = out(capsys, "trend", "revisions", root, "--format", "csv").splitlines()
    assert rows[0].endswith(",value,repository")
    assert sum(row.endswith(",group/two") for row in rows) == 3


def test_the_end_of_each_month(workspace, capsys):
    root, *_ = workspace
    assert main(["history", str(root), "--every", "month", "--since", "2020-09-20", "-q"]) == 0
    assert [point["name"] for point in trend(capsys, root, "loc")["points"]] == ["2020-09-23", "2020-10-24"]


@on_both
def test_what_is_checked_now_is_the_last_point_where_it_differs(workspace, capsys):
    root, *_ = workspace
    quiet = ["-q", "--jobs", "1", "--no-graph", "--fail-on", "never", "--format", "json", "-o", str(root / "r.json")]
    assert main(["history", str(root), "--every", "release", "-q"]) == 0
    assert main(["check", str(root), *quiet]) == 0
    assert len(trend(capsys, root, "loc")["points"]) == 3
    (root / "one/a/new.cpp").write_text(function("f", 1))
    assert main(["check", str(root), *quiet]) == 0
    assert trend(capsys, root, "loc")["packages"]["a"] == [23, 23, 23, 4]


def test_a_run_of_the_folder_above_is_no_point_of_a_repository(workspace, capsys):
    root, one, _ = workspace
    quiet = ["-q", "--jobs", "1", "--no-graph", "--fail-on", "never", "--format", "json", "-o", str(root / "r.json")]
    assert main(["history", str(one.root), "--every", "1", "-q"]) == 0
    (one.root / "a/new.cpp").write_text(function("f", 1))
    assert main(["check", str(root), *quiet]) == 0
    capsys.readouterr()
    assert main(["trend", "loc", str(one.root), "--format", "json"]) == 0
    said = capsys.readouterr()
    found = json.loads(said.out)
    assert (found["packages"], [event["kind"] for event in found["events"]]) == ({"a": [23, 23]}, ["release"])
    with open_store(str(one.root)) as store:
        options = argparse.Namespace(no_store=False, path=str(one.root))
        with shown_past(options, store.view()) as past:
            assert past is None
    assert f'past revisions of "{one.root}" are not shown with a run of "{root}"' in capsys.readouterr().err
    assert main(["check", str(one.root), *quiet]) == 0
    assert trend(capsys, one.root, "loc")["packages"] == {"a": [23, 23, 4]}


@on_both
def test_two_days_and_a_release_are_compared(workspace, capsys):
    root, *_ = workspace
    found = json.loads(out(capsys, "compare", "2020-09-30", "2020-10-31", root, "--format", "json"))
    assert [one["path"] for one in found["new"]] == ["group/two/b.cpp"]
    assert found["resolved"] == []
    assert len(found["moved"]) == 2
    text = out(capsys, "compare", "2020-09-20", "release", root)
    assert text.splitlines()[1].startswith("+++ group/two 0.1.0 (")
    assert "+ package b" in text
    assert (
        main(["check", str(root), "-q", "--jobs", "1", "--no-graph", "--fail-on", "never", "-o", str(root / "r.json")])
        == 0
    )
    text = out(capsys, "compare", "release", "now", root)
    assert re.fullmatch(r"\+\+\+ now \(run \d+ of 2 repositories, \d{4}-\d{2}-\d{2}\)", text.splitlines()[1])


def test_a_package_that_went_to_the_other_repository(workspace, capsys):
    root, one, two = workspace
    (root / "group/two/inner").mkdir()
    one.commit("another", day=45, c__package_DOT_xml=MANIFEST.format("c"))
    (root / "one/a").rename(root / "group/two/inner/a")
    one.commit("gone", day=50, README="x")
    two.commit("here", day=50, README="x")
    assert main(["history", str(root), "--every", "month", "-q"]) == 0
    found = trend(capsys, root, "loc")
    assert found["packages"]["a"] == [23, 23, 23]
    (event,) = (one for one in found["events"] if one["kind"] == "moved")
    assert (event["point"], event["text"]) == (2, "a: one/a -> group/two/inner/a")
    found = json.loads(out(capsys, "compare", "2020-10-31", "2020-11-30", root, "--format", "json"))
    assert found["packages_moved"] == [{"package": "a", "was_in": "one/a", "path": "group/two/inner/a"}]
    assert (found["new"], found["resolved"], found["packages_added"]) == ([], [], [])
    assert {(one["was_in"], one["path"]) for one in found["moved"]} == {("one/a/new.cpp", "group/two/inner/a/new.cpp")}
    text = out(capsys, "compare", "2020-10-31", "2020-11-30", root)
    assert "= package a: group/two/inner/a, was in one/a" in text


def test_names_that_mean_nothing_of_several(workspace, capsys):
    root, *_ = workspace
    for words, said in (
        (["compare", "1.0.0", "now", root], "holds 2 repositories, and a revision is of one of them"),
        (["compare", "2019-01-01", "2020-10-31", root], "before the first commit of all repositories"),
        (["history", root, "--every", "1", "--since", "1.0.0"], "revisions are of one of the repositories"),
    ):
        assert main([str(word) for word in words]) == 2
        assert said in capsys.readouterr().err


def test_a_shallow_repository_and_one_without_commits_are_left_out_and_said(workspace, capsys):
    root, _, two = workspace
    two.git("clone", "-q", "--depth=1", f"file://{two.root}", str(root / "shallow"))
    empty = SmallRepository(root / "empty")
    empty.write("package.xml", MANIFEST.format("e"))
    assert main(["history", str(root), "--every", "release"]) == 0
    said = capsys.readouterr().err
    assert "shallow is left out" in said
    assert "git fetch --unshallow" in said
    assert "empty is left out" in said
    assert "3 revisions of 2 repositories" in said


def test_another_repository_makes_other_revisions(workspace, capsys):
    root, *_ = workspace
    assert main(["history", str(root), "--every", "release", "-q"]) == 0
    three = SmallRepository(root / "three")
    three.commit("first", day=20, package_DOT_xml=MANIFEST.format("c"), c_DOT_py="x = 1\n")
    assert main(["history", str(root), "--every", "release", "-q"]) == 0
    capsys.readouterr()
    assert main(["trend", "loc", str(root), "--format", "json"]) == 0
    reported = capsys.readouterr()
    assert "1 revisions that were analysed are not behind the head" in reported.err
    assert json.loads(reported.out)["whole"] == [23, 28, 47]


def test_only_the_packages_that_are_wanted(workspace, capsys):
    root, one, _ = workspace
    one.commit("another", day=42, x__package_DOT_xml=MANIFEST.format("x"), x__x_DOT_py="x = 1\n")
    own = {"packages": ["a"]}
    entry = {"type": "git", "url": "https://example.org/one.git", "version": one.git("rev-parse", "HEAD")}
    (root / "fetched.repos").write_text(json.dumps({"repositories": {"one": {**entry, "roslens": own}}}))
    from roslens.source.fetch.fetched_set import read_fetched_set

    assert read_fetched_set(str(root)).wanted == {"one": frozenset({"a"})}
    assert main(["history", str(root), "--every", "release", "-q"]) == 0
    assert set(trend(capsys, root, "loc")["packages"]) == {"a", "b"}


def test_releases_before_the_first_revision_are_no_events(workspace, capsys):
    root, *_ = workspace
    assert main(["history", str(root), "--every", "1", "--since", "2020-10-20", "-q"]) == 0
    assert trend(capsys, root, "loc")["events"] == []
    text = out(capsys, "trend", "loc", root).splitlines()
    assert text[0] == "Lines of code (lines): 2 revisions, 2020-10-23 to 2020-10-24"


def test_time_is_that_of_the_commits(workspace):
    root, *_ = workspace
    assert main(["history", str(root), "--every", "1", "-q"]) == 0
    with kept_past(str(root)).open() as store:
        assert [one.time_s for one in store.revisions()] == [BEGIN_S + DAY_S * day for day in (0, 10, 40, 41)]
