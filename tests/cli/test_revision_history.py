"""Past revisions by the command line: analysed once, followed, compared; the work tree is left alone."""

import json
from itertools import count

import pytest
from postgres_server import postgres_server
from process_metrics.small_repository import MANIFEST, SmallRepository, function

from roslens.cli.main import main
from roslens.cli.past.past_store import kept_past

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
        yield lambda: server.schema(f"w{next(_NUMBERS)}")


@pytest.fixture(scope="module")
def of_made(place) -> str:
    return place()


@pytest.fixture(autouse=True)
def _store(request, place, monkeypatch):
    """Have each workspace keep its runs where the place says."""
    own = request.getfixturevalue("of_made") if "made" in request.fixturenames else place()
    monkeypatch.setenv("ROSLENS_STORE", own)


@pytest.fixture(scope="module")
def made(tmp_path_factory, of_made):
    """Three releases: a function grows beyond its limit in the second, and is split in the third."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("ROSLENS_STORE", of_made)
        return _made(tmp_path_factory)


def _made(tmp_path_factory) -> SmallRepository:
    repository = SmallRepository(tmp_path_factory.mktemp("w") / "w")
    repository.commit("one", day=0, p__package_DOT_xml=MANIFEST.format("p"), p__src__a_DOT_cpp=function("a", 2))
    repository.git("tag", "1.0.0")
    repository.commit("between", day=1, README="read me\n")
    repository.commit("two", day=2, p__src__a_DOT_cpp=function("a", 20))
    repository.git("tag", "1.1.0")
    halves = function("a", 3) + function("b", 4)
    repository.commit("three", day=40, p__src__a_DOT_cpp=halves, q__package_DOT_xml=MANIFEST.format("q"))
    repository.git("tag", "2.0.0")
    repository.commit("head", day=41, q__b_DOT_py="x = 1\n")
    (repository.root / "p/src/a.cpp").write_text("int a() { return 1; }\n")
    assert main(["history", str(repository.root), "--every", "release", "-q"]) == 0
    assert (
        main(
            [
                "check",
                str(repository.root),
                "-q",
                "--jobs",
                "1",
                "--fail-on",
                "never",
                "-o",
                str(repository.root / "a.json"),
            ]
        )
        == 0
    )
    return repository


def out(capsys, *words: str, code: int = 0) -> str:
    assert main([str(word) for word in words]) == code
    return capsys.readouterr().out


def reported(capsys, *words: str) -> str:
    assert main([str(word) for word in words]) == 2
    return capsys.readouterr().err


def runs(made: SmallRepository) -> list[str]:
    with kept_past(str(made.root)).open() as store:
        return [one.commit for one in sorted(store.revisions(), key=lambda one: one.run)]


def test_runs_are_where_they_are_said_to_be(made, of_made):
    assert (made.root / ".roslens/history.sqlite").exists() == (not of_made)
    assert (made.root / ".roslens/store.shared").exists() == bool(of_made)
    assert kept_past(str(made.root / "p")).root == made.root


def test_each_release_and_the_head_are_runs(made):
    names = ["1.0.0", "1.1.0", "2.0.0", "HEAD"]
    assert runs(made)[:4] == [made.git("rev-parse", name) for name in names]
    assert made.git("status", "--porcelain", "--untracked-files=no").split() == ["M", "p/src/a.cpp"]
    assert (made.root / "p/src/a.cpp").read_text() == "int a() { return 1; }\n"


@on_both
def test_a_second_time_nothing_is_analysed(made, capsys):
    assert main(["history", str(made.root), "--every", "release"]) == 0
    assert "4 revisions, 0 of them analysed now" in capsys.readouterr().err


def test_a_past_run_is_the_run_of_its_files(made, capsys, tmp_path):
    made.git("worktree", "add", "-q", "--detach", str(tmp_path / "then"), "1.1.0")
    words = ("--no-store", "--format", "json", "-q", "--fail-on", "never")
    report = json.loads(out(capsys, "check", tmp_path / "then", *words))
    found = json.loads(out(capsys, "compare", "1.0.0", "1.1.0", made.root, "--format", "json"))
    fingerprints = {one["fingerprint"] for one in report["findings"]}
    assert found["new"]
    assert {one["fingerprint"] for one in found["new"]} <= fingerprints
    trend = json.loads(out(capsys, "trend", "findings", made.root, "--format", "json"))
    assert trend["whole"][1] == sum(1 for one in report["findings"] if one["gated"])


def test_a_trend_as_text(made, capsys):
    lines = out(capsys, "trend", "cyclomatic_complexity.max", made.root).splitlines()
    assert lines[0] == "Cyclomatic complexity (max): 5 revisions, 1.0.0 (2020-09-13) to " + lines[0].split(" to ")[1]
    (row,) = [line for line in lines if line.startswith("  p ")]
    assert row.split() == ["p", "▂█▂▂▁", "3", "1", "-2"]
    assert [line.split()[1:] for line in lines if "release" in line] == [
        ["release", "1.0.0"],
        ["release", "1.1.0"],
        ["release", "2.0.0"],
    ]


def test_a_trend_as_json_and_csv(made, capsys):
    found = json.loads(out(capsys, "trend", "loc", made.root, "--format", "json"))
    assert [point["name"] for point in found["points"]][:3] == ["1.0.0", "1.1.0", "2.0.0"]
    assert found["whole_is"] == "sum"
    assert found["packages"]["q"] == [None, None, 0, 1, 1]
    assert found["whole"] == [5, 23, 13, 14, 2]
    rows = out(capsys, "trend", "loc", made.root, "--format", "csv", "--package", "p").splitlines()
    assert rows[0] == "quantity,package,commit,time_s,name,run,now,value,repository"
    assert [row.split(",")[1] for row in rows[1:]] == ["p"] * 5
    since = json.loads(out(capsys, "trend", "loc", made.root, "--format", "json", "--since", "2020-10-01"))
    assert since["whole"] == [13, 14, 2]
    assert [(one["point"], one["text"]) for one in since["events"]] == [(0, "2.0.0")]


def test_history_of_history(made, capsys):
    found = json.loads(out(capsys, "trend", "revisions", made.root, "--format", "json"))
    assert (found["whole_is"], found["whole"]) == ("repository", [1, 3, 4, 5, None])
    assert found["packages"]["p"] == [1, 2, 3, 3, None]


def test_the_tree_of_today_is_the_last_point(made, capsys):
    found = json.loads(out(capsys, "trend", "loc", made.root, "--format", "json"))
    assert [point["name"] for point in found["points"]][-1] == "now"
    text = out(capsys, "compare", "release", "now", made.root)
    assert text.splitlines()[0].startswith("--- 2.0.0 (")
    assert text.splitlines()[1].startswith("+++ now (run ")
    assert "~ p: loc 13 -> 1" in text


@on_both
def test_new_and_resolved_between_two_releases(made, capsys):
    text = out(capsys, "compare", "1.0.0", "1.1.0", made.root)
    assert "findings: 1 (1 note) new" in text
    assert "[extreme." in text
    assert out(capsys, "compare", "1.0.0", "1.1.0", made.root, "--fail-on", "note", code=1)
    back = out(capsys, "compare", "1.1.0", "2.0.0", made.root, "--fail-on", "note")
    assert "+ package q" in back
    assert "resolved" in back
    page = out(capsys, "compare", "1.0.0", "1.1.0", made.root, "--format", "markdown")
    assert page.startswith("### roslens: `1.0.0 (")
    assert "<summary>New: " in page


def test_a_commit_between_is_analysed_when_it_is_asked_for(made, capsys):
    before = len(runs(made))
    text = out(capsys, "compare", made.git("rev-parse", "--short", "1.1.0~1"), "1.1.0", made.root)
    assert "new" in text
    assert len(runs(made)) == before + 1


def test_both_meanings_are_told_apart(made, capsys, tmp_path):
    assert "neither a FILE nor --every" in reported(capsys, "history")
    assert "is a folder" in reported(capsys, "history", made.root)
    assert "--signal with --every" in reported(capsys, "history", made.root, "--every", "1", "--signal", "rate")
    assert "--model without --every" in reported(capsys, "history", tmp_path / "x.sqlite", "--model", "ros")
    assert "neither one of release" in reported(capsys, "history", made.root, "--every", "sometimes")
    assert "no revision since" in reported(capsys, "history", made.root, "--every", "1", "--since", "2030-01-01")
    assert "expected a date" in reported(capsys, "history", made.root, "--every", "1", "--since", "soon")


def test_names_that_mean_nothing(made, capsys):
    assert "Did you mean 1.0.0" in reported(capsys, "compare", "1.0.O", "now", made.root)
    assert "there is no run 77" in reported(capsys, "compare", "77", "now", made.root)
    assert "Did you mean loc" in reported(capsys, "trend", "locs", made.root)
    assert "has no loc in any revision" in reported(capsys, "trend", "loc", made.root, "--package", "P")


def test_without_a_history(tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(tmp_path.parent))
    assert "no past revisions" in reported(capsys, "trend", "loc", tmp_path)
    assert "no git repository" in reported(capsys, "history", tmp_path, "--every", "1")
    empty = SmallRepository(tmp_path / "empty")
    assert "has no commit yet" in reported(capsys, "history", empty.root, "--every", "1")
    made = SmallRepository(tmp_path / "full")
    made.commit("one", day=0, package_DOT_xml=MANIFEST.format("p"))
    made.commit("two", day=1)
    made.git("clone", "-q", "--depth=1", f"file://{made.root}", str(tmp_path / "shallow"))
    assert "is a shallow clone" in reported(capsys, "history", tmp_path / "shallow", "--every", "1")


def test_a_part_of_a_repository(tmp_path, capsys):
    made = SmallRepository(tmp_path / "r")
    made.commit("one", day=0, src__p__package_DOT_xml=MANIFEST.format("p"), src__p__a_DOT_py="x = 1\n")
    made.commit("two", day=1, src__p__a_DOT_py="x = 1\ny = 2\n", elsewhere_DOT_py="z = 3\n")
    assert main(["history", str(made.root / "src"), "--every", "1", "-q"]) == 0
    found = json.loads(out(capsys, "trend", "loc", made.root / "src", "--format", "json"))
    assert found["packages"] == {"p": [1, 2]}
    churn = json.loads(out(capsys, "trend", "churn", made.root / "src", "--format", "json"))
    assert churn["packages"]["p"] == [2, 3]


def test_a_command_that_was_ended_goes_on_where_it_was(tmp_path, capsys, monkeypatch):
    from roslens.cli.past.past_runs import PastRuns

    made = SmallRepository(tmp_path / "r")
    for day in range(4):
        made.commit(f"day {day}", day=day, package_DOT_xml=MANIFEST.format("p"), a_DOT_py="x = 1\n" * (day + 1))
    whole, asked = PastRuns._analysed, []

    def ended(runs, commit, begun):
        asked.append(commit.id)
        if len(asked) == 3:
            raise KeyboardInterrupt
        return whole(runs, commit, begun)

    monkeypatch.setattr(PastRuns, "_analysed", ended)
    assert main(["history", str(made.root), "--every", "1", "-q"]) == 130
    assert len(runs(made)) == 2
    assert main(["history", str(made.root), "--every", "1", "-q"]) == 0
    assert len(asked) == 5
    found = json.loads(out(capsys, "trend", "loc", made.root, "--format", "json"))
    assert found["whole"] == [1, 2, 3, 4]


def test_revisions_without_a_package_and_with_a_broken_one(tmp_path, capsys):
    made = SmallRepository(tmp_path / "r")
    made.commit("nothing", day=0, README="read me\n")
    made.commit("broken", day=1, package_DOT_xml="<package><name>", a_DOT_py="def f(:\n")
    made.commit("mended", day=2, package_DOT_xml=MANIFEST.format("p"), a_DOT_py="x = 1\n")
    assert main(["history", str(made.root), "--every", "1"]) == 0
    assert "could not be analysed in part" in capsys.readouterr().err
    found = json.loads(out(capsys, "trend", "files", made.root, "--format", "json"))
    assert found["packages"]["p"][-1] == 1
    assert "package p" in out(capsys, "compare", made.git("rev-parse", "HEAD~2"), "HEAD", made.root)


def test_what_a_forced_push_took_away_is_left_out_and_said(tmp_path, capsys):
    made = SmallRepository(tmp_path / "r")
    made.commit("one", day=0, package_DOT_xml=MANIFEST.format("p"), a_DOT_py="x = 1\n")
    gone = made.commit("two", day=1, a_DOT_py="x = 1\n" * 2)
    assert main(["history", str(made.root), "--every", "1", "-q"]) == 0
    made.git("reset", "-q", "--hard", "HEAD~1")
    made.commit("another two", day=2, a_DOT_py="x = 1\n" * 3)
    assert main(["history", str(made.root), "--every", "1", "-q"]) == 0
    assert main(["trend", "loc", str(made.root), "--format", "json"]) == 0
    reported = capsys.readouterr()
    assert json.loads(reported.out)["whole"] == [1, 3]
    assert gone not in reported.out
    assert "1 revisions that were analysed are not behind the head" in reported.err


@pytest.mark.real
def test_the_database_goes_away_between_two_revisions(tmp_path, capsys, monkeypatch):
    from roslens.cli.past.past_runs import PastRuns

    made = SmallRepository(tmp_path / "r")
    for day in range(3):
        made.commit(f"day {day}", day=day, package_DOT_xml=MANIFEST.format("p"), a_DOT_py="x = 1\n" * (day + 1))
    whole, asked = PastRuns._analysed, []
    with postgres_server() as server:
        monkeypatch.setenv("ROSLENS_STORE", server.schema("gone"))

        def thrown_out(runs, commit, begun):
            asked.append(commit.id)
            if len(asked) == 2:
                server.throw_out()
            return whole(runs, commit, begun)

        monkeypatch.setattr(PastRuns, "_analysed", thrown_out)
        assert main(["history", str(made.root), "--every", "1", "-q"]) == 2
        assert "Run the same command again" in capsys.readouterr().err
        assert len(runs(made)) == 1
        assert main(["history", str(made.root), "--every", "1", "-q"]) == 0
        assert len(asked) == 4
        found = json.loads(out(capsys, "trend", "loc", made.root, "--format", "json"))
        assert found["whole"] == [1, 2, 3]
        server.kill()
        assert "does not let in" in reported(capsys, "trend", "loc", made.root)


def test_a_partial_clone_says_what_brings_its_past(tmp_path, capsys):
    made = SmallRepository(tmp_path / "r")
    made.commit("first", day=0, package_DOT_xml=MANIFEST.format("p"), a_DOT_cpp=function("a", 1))
    made.git("tag", "1.0.0")
    made.commit("second", day=1, a_DOT_cpp=function("a", 2))
    made.git("config", "uploadpack.allowFilter", "true")
    clone = tmp_path / "clone"
    made.git("clone", "-q", "--filter=blob:none", f"file://{made.root}", str(clone))
    assert main(["history", str(clone), "--every", "release", "-q"]) == 2
    said = capsys.readouterr().err
    assert "git cannot give the files of revision" in said
    assert "roslens fetch --whole" in said
