"""Process metrics are git's own answers, and what cannot be determined is said."""

from pathlib import Path

import pytest
from process_metrics.against_git import differences, process_of
from process_metrics.small_repository import BEGIN_S, DAY_S, MANIFEST, SmallRepository, function

from roslens.model.process import Coupling
from roslens.source.history import histories
from roslens.source.history.histories import histories_of, log_reader
from roslens.source.settings import WorkspaceSettings
from roslens.source.workspace.find import find_workspace
from roslens.store.cache import Cache


def test_every_answer_is_gits(small):
    compared, found = differences(small.root)
    assert not found
    assert compared > 60


def test_values_worked_out_by_hand(small):
    found = process_of(small.root)
    assert found.values == {
        "revisions": 14,  # first, second, 6 together, 3 branches, octopus, moved, README
        "contributors": 4,  # Ann, Bob = bobby, Éve, nobody
        "age": 12,
        "churn": found.values["churn"],
        "ownership": pytest.approx(7 / 17),  # Éve: 2 together, 3 branches, README, co-author once
        "bus_factor": 2,  # 7 + 6 of 17
        "releases": 2,
        "revisions_since_release": 1,
    }
    a, inner = found.files["outer/src/a.cpp"], found.packages["inner"]
    assert (a["revisions"], a["contributors"], a["age"], a["time_since_last_commit"]) == (8, 4, 12, 5)
    assert inner["revisions"] == 7
    assert found.packages["outer"]["revisions"] == 12  # not README; the file inside the inner package is not its own
    assert found.files["outer/src/moved.cpp"]["revisions"] == 2  # and as one.cpp
    assert found.files["outer/src/moved.cpp"]["churn"] == 4  # moving changed no line
    assert found.files["outer/src/grün & blau.py"]["churn"] == 1
    assert found.coupled_packages == (Coupling("inner", "outer", 7, round(14 / 19, 4)),)
    assert found.coupled_files == (Coupling("outer/inner/b.cpp", "outer/src/a.cpp", 7, round(14 / 15, 4)),)
    assert (a["change_coupling"], found.files["outer/src/moved.cpp"]["change_coupling"]) == (1, 0)
    assert [one.name for one in found.releases] == ["release/1.0", "v0.1.0"]


def test_ages_are_told_at_another_time(small):
    found = process_of(small.root, as_of_s=BEGIN_S + 100 * DAY_S)
    assert (found.values["age"], found.values["time_since_last_commit"]) == (100, 88)
    assert found.packages["inner"]["time_since_last_commit"] == 93
    assert process_of(small.root, as_of_s=BEGIN_S - DAY_S).values["age"] == 0


def test_names_are_not_kept(small):
    from msgspec import msgpack

    from roslens.source.history.read_log import read_log

    kept = msgpack.encode(read_log(str(small.root), "HEAD"))
    assert not [name for name in (b"Ann", b"Bob", b"bobby", "Éve".encode(), b"x.org") if name in kept]


def test_a_log_is_read_once(small, tmp_path, monkeypatch):
    workspace = find_workspace([small.root], WorkspaceSettings())
    found = histories_of(workspace)
    with Cache.open(tmp_path / "cache.sqlite") as cache:
        first = found.measure({}, {}, {}, log_reader(cache))
        monkeypatch.setattr(histories, "read_log", None)
        assert found.measure({}, {}, {}, log_reader(cache)) == first


def test_what_shapes_it_shapes_the_key(tmp_path):
    made = SmallRepository(tmp_path / "r")
    made.write("package.xml", MANIFEST.format("p"))
    made.commit("first", day=0)
    workspace = find_workspace([made.root], WorkspaceSettings())
    keys = [histories_of(workspace).key]
    made.git("tag", "1.0.0")
    keys.append(histories_of(workspace).key)
    made.write(".mailmap", "Ann <ann@x.org>\n")
    keys.append(histories_of(workspace).key)
    made.commit("second", day=1)
    keys.append(histories_of(workspace).key)
    assert len(set(keys)) == 4
    assert histories_of(workspace).key == keys[-1] != histories_of(workspace, as_of_s=1.0).key


def test_clocks_that_went_wrong_are_told(empty):
    empty.commit("first", day=10, package_DOT_xml=MANIFEST.format("p"))
    empty.commit("before its parent", day=3, a_DOT_cpp=function("a", 1))
    empty.commit("later", day=11, b_DOT_cpp=function("b", 1))
    found = process_of(empty.root)
    assert (found.skewed, found.skew_s) == (1, 7 * DAY_S)
    assert found.values["age"] == 8
    empty.commit("in the past", day=1, a_DOT_cpp=function("a", 2))
    assert process_of(empty.root).files["b.cpp"]["time_since_last_commit"] == 0


def failures_of(folder: Path) -> list[str]:
    found = histories_of(find_workspace([folder], WorkspaceSettings()))
    with Cache.open(None) as cache:
        _, failures = found.measure({}, {}, {}, log_reader(cache))
    return [one.what for one in (*found.failures, *failures)]


def test_a_repository_without_a_commit(empty):
    empty.write("package.xml", MANIFEST.format("p"))
    assert failures_of(empty.root) == ['repository "." has no commit yet']


def test_a_shallow_clone_is_said_and_not_counted(small, tmp_path):
    small.git("clone", "-q", "--depth=1", f"file://{small.root}", str(tmp_path / "clone"))
    (said,) = failures_of(tmp_path / "clone")
    assert said.startswith('repository "." is a shallow clone')


@pytest.mark.parametrize(("filtered", "lacks"), [("blob:none", "churn and hotspots"), ("tree:0", "of packages and")])
def test_a_partial_clone_tells_what_it_can(small, tmp_path, filtered, lacks):
    small.git("config", "uploadpack.allowFilter", "true")
    clone = tmp_path / "clone"
    small.git("clone", "-q", f"--filter={filtered}", f"file://{small.root}", str(clone))
    (said,) = failures_of(clone)
    assert lacks in said
    workspace = find_workspace([clone], WorkspaceSettings())
    with Cache.open(None) as cache:
        (found,), _ = histories_of(workspace).measure({"inner": "outer/inner"}, {}, {}, log_reader(cache))
    assert (found.values["revisions"], found.values["contributors"], "churn" in found.values) == (14, 4, filtered == "")
    assert found.packages.get("inner", {}).get("revisions") == (7 if filtered == "blob:none" else None)


def test_each_repository_of_a_workspace_has_its_own(tmp_path):
    for name in ("one", "two"):
        made = SmallRepository(tmp_path / "src" / name)
        made.commit(name, day=0, package_DOT_xml=MANIFEST.format(name))
    (tmp_path / "src/none").mkdir()
    (tmp_path / "src/none/package.xml").write_text(MANIFEST.format("none"))
    made.commit("again", day=1)
    found = histories_of(find_workspace([tmp_path], WorkspaceSettings()))
    with Cache.open(None) as cache:
        reported, failures = found.measure({"one": "src/one", "two": "src/two"}, {}, {}, log_reader(cache))
    assert [(one.path, one.values["revisions"], list(one.packages)) for one in reported] == [
        ("src/one", 1, ["one"]),
        ("src/two", 2, ["two"]),
    ]
    assert not failures


def test_a_bare_repository_that_a_clone_brings_is_not_asked(tmp_path):
    made = SmallRepository(tmp_path / "w")
    made.commit("first", day=0, package_DOT_xml=MANIFEST.format("p"))
    bare = made.root / "bare"
    made.git("clone", "-q", "--bare", str(made.root), str(bare))
    (bare / "package.xml").write_text(MANIFEST.format("q"))
    assert failures_of(bare) == []
    assert failures_of(made.root) == []


def test_names_that_want_to_break_something(empty):
    trailers = ["<>", "x <y", "a <b> c <d>", "\u2028 <u@x.org>", "tab\tname <t@x.org>", "\x1fsplit <s@x.org>", "> <"]
    message = "odd\n\n" + "".join(f"Co-authored-by: {one}\n" for one in trailers)
    empty.commit(message, day=0, who="A\x1fB <a@x.org>", package_DOT_xml=MANIFEST.format("p"))
    empty.write("new\nline.py", "x = 1\n")
    empty.write("tab\tname.py", "x = 1\n")
    empty.commit("odd names", day=1)
    found = process_of(empty.root)
    assert found.values["revisions"] == 2
    assert 2 <= found.values["contributors"] <= 9
    assert found.values["churn"] == 3


def test_a_clone_that_lost_an_object_tells_what_it_can(empty):
    empty.commit("one", day=0, package_DOT_xml=MANIFEST.format("p"), a_DOT_py="x = 1\n")
    lost = empty.git("rev-parse", "HEAD:a.py")
    empty.commit("two", day=1, a_DOT_py="x = 2\n")
    (empty.root / ".git/objects" / lost[:2] / lost[2:]).unlink()
    (said,) = failures_of(empty.root)
    assert "lacks objects of its history" in said
    with Cache.open(None) as cache:
        (found,), _ = histories_of(find_workspace([empty.root], WorkspaceSettings())).measure(
            {"p": "."}, {}, {}, log_reader(cache)
        )
    assert (found.values["revisions"], found.packages["p"]["revisions"], "churn" in found.values) == (2, 2, False)


def test_a_file_keeps_its_past_under_the_names_it_had(empty):
    ann, bob = "Ann Ott <ann@x.org>", "Bob <bob@x.org>"
    empty.commit("first", day=0, who=ann, p__package_DOT_xml=MANIFEST.format("p"), p__a_DOT_cpp=function("a", 20))
    empty.commit("second", day=1, who=bob, p__a_DOT_cpp=function("a", 21))
    empty.git("mv", "p/a.cpp", "p/b.cpp")
    empty.commit("renamed and changed", day=2, who=ann, p__b_DOT_cpp=function("a", 23))
    (empty.root / "q").mkdir()
    empty.git("mv", "p/b.cpp", "q/c.cpp")
    empty.commit("renamed again", day=3, who=ann, q__package_DOT_xml=MANIFEST.format("q"))
    empty.commit("and changed", day=4, who=ann, q__c_DOT_cpp=function("a", 24))
    compared, wrong = differences(empty.root)
    assert not wrong
    assert compared > 30
    found = process_of(empty.root).files["q/c.cpp"]
    assert (found["revisions"], found["contributors"], found["age"]) == (5, 2, 4)
    assert found["churn"] == 23 + 1 + 2 + 0 + 1
    assert found["ownership"] == 0.8


def test_a_path_that_another_file_takes_over(empty):
    first, second = function("first", 20), "".join(f"#define A{number} {number}\n" for number in range(40))
    empty.commit("first", day=0, package_DOT_xml=MANIFEST.format("p"), a_DOT_cpp=first, b_DOT_cpp=second)
    empty.commit("second", day=1, a_DOT_cpp=first + "int more;\n")
    # a.cpp was there before and afterwards, so to git it is a file that changed, and c.cpp a copy of what it was.
    empty.git("mv", "a.cpp", "c.cpp")
    empty.git("mv", "b.cpp", "a.cpp")
    empty.commit("third", day=2)
    compared, wrong = differences(empty.root)
    assert not wrong
    assert compared
    files = process_of(empty.root).files
    assert {path: files[path]["revisions"] for path in ("a.cpp", "c.cpp")} == {"a.cpp": 3, "c.cpp": 1}


def test_a_path_that_is_used_again(empty):
    empty.commit("first", day=0, package_DOT_xml=MANIFEST.format("p"), a_DOT_cpp=function("a", 20))
    empty.git("mv", "a.cpp", "b.cpp")
    empty.commit("renamed", day=1)
    empty.commit("another", day=2, a_DOT_cpp="".join(f"#define A{number} {number}\n" for number in range(40)))
    empty.commit("both", day=3, a_DOT_cpp="// none\n", b_DOT_cpp=function("a", 21))
    compared, wrong = differences(empty.root)
    assert not wrong
    assert compared
    assert process_of(empty.root).files["b.cpp"]["revisions"] == 3


def test_a_renaming_on_a_branch_that_is_merged(empty):
    empty.commit("first", day=0, package_DOT_xml=MANIFEST.format("p"), a_DOT_cpp=function("a", 20))
    empty.git("checkout", "-q", "-b", "side")
    empty.git("mv", "a.cpp", "b.cpp")
    empty.commit("renamed", day=1)
    empty.git("checkout", "-q", "-")
    empty.commit("elsewhere", day=2, c_DOT_cpp=function("c", 1))
    empty.git("merge", "-q", "--no-ff", "-m", "merged", "side", day=3)
    _, wrong = differences(empty.root)
    assert not wrong
    assert process_of(empty.root).files["b.cpp"]["revisions"] == 2


def test_a_partial_clone_follows_what_was_renamed_without_a_change(small, tmp_path):
    from roslens.source.history.read_log import read_log

    log = read_log(str(small.root), "HEAD", contents=False)
    renames = [(log.paths[one.old], log.paths[one.new]) for commit in log.commits for one in commit.renames]
    assert renames == [("outer/src/one.cpp", "outer/src/moved.cpp")]
