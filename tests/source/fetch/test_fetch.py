"""`roslens fetch` against repositories in a folder: what comes, what stays, what fails alone."""

import json
import os
import shutil

import pytest

from roslens.cli.check import fetch_options
from roslens.cli.main import main
from roslens.intake.safe_yaml import load_yaml
from roslens.source.fetch import clone, git_runner
from roslens.source.fetch.retry import Retry


def repos(folder, **repositories):
    """Write a .repos file: names to URLs, or to pairs of URL and version."""
    entries = {}
    for name, given in repositories.items():
        url, version = given if isinstance(given, tuple) else (given, None)
        entries[name] = {"type": "git", "url": url, **({"version": version} if version else {})}
    (folder / "in.repos").write_text(json.dumps({"repositories": entries}))
    return "in.repos"


def fetch(*words):
    return main(["fetch", "-q", "--into", "ws", *words])


def head(server, folder):
    return server.git(folder, "rev-parse", "HEAD")


def lock(here, into="ws"):
    return load_yaml((here / into / "fetched.repos").read_bytes())["repositories"]


@pytest.fixture(autouse=True)
def _no_pauses(monkeypatch):
    monkeypatch.setattr(fetch_options, "_pause", lambda *_: None)


def test_a_repos_file_becomes_a_folder_each_and_a_lock(server, here, capsys):
    given = repos(here, one=server.package("one", commits=3), two=(server.package("two"), "main"))
    assert main(["fetch", "--into", "ws", "--distribution", given, "--no-color"]) == 0
    out = capsys.readouterr().out
    assert out.splitlines()[-1] == "2 repositories: 2 fetched"
    assert (here / "ws/one/one/package.xml").is_file()
    entry = lock(here)["one"]
    assert entry["version"] == server.git("one", "rev-parse", "HEAD") == head(server, here / "ws/one")
    assert entry["roslens"]["commits"] == 3
    assert entry["roslens"]["day"].startswith("2020-01-03")
    assert not list((here / "ws/one/.git/hooks").glob("*"))


def test_what_is_there_stays_without_asking_the_server(server, here):
    given = repos(here, one=server.package("one"), two=server.package("two"))
    assert fetch("--distribution", given) == 0
    before = (here / "ws/fetched.repos").read_bytes()
    shutil.move(server.folder, server.folder.with_name("gone"))
    assert fetch("--distribution", given) == 0
    assert fetch() == 0
    assert (here / "ws/fetched.repos").read_bytes() == before
    # Only what is missing is asked for, and what fails so leaves the other alone.
    shutil.rmtree(here / "ws/one")
    assert fetch("--distribution", given) == 3
    assert "failure" in lock(here)["one"]["roslens"]
    assert lock(here)["two"]["version"] == head(server, here / "ws/two")


def test_the_lock_gives_the_same_tree_elsewhere(server, here):
    assert fetch("--distribution", repos(here, one=server.package("one", commits=2))) == 0
    wanted = head(server, here / "ws/one")
    server.commit("one", {"later": "x"})
    assert main(["fetch", "-q", "--into", "again", "--distribution", "ws/fetched.repos"]) == 0
    assert head(server, here / "again/one") == wanted
    # And where only the lock was kept.
    shutil.rmtree(here / "ws/one")
    assert fetch() == 0
    assert head(server, here / "ws/one") == wanted
    assert lock(here)["one"]["roslens"]["version"] == ""


def test_update_takes_what_the_branch_has_now(server, here, capsys):
    assert fetch("--distribution", repos(here, one=(server.package("one"), "main"))) == 0
    (server.folder / "one/one/package.xml").unlink()
    now = server.commit("one", {"one/new.py": "x = 1\n"})
    assert fetch("--update") == 0
    assert head(server, here / "ws/one") == now
    assert (here / "ws/one/one/new.py").is_file()
    assert not (here / "ws/one/one/package.xml").exists()
    server.git("one", "commit", "--amend", "-q", "-m", "rewritten")
    capsys.readouterr()
    assert main(["fetch", "--into", "ws", "--update", "--no-color"]) == 0
    out = capsys.readouterr().out
    assert "its history was rewritten" in out
    assert "1 updated" in out


def test_files_that_were_changed_are_not_overwritten(server, here, capsys):
    assert fetch("--distribution", repos(here, one=server.package("one"))) == 0
    server.commit("one", {"new": "x"})
    (here / "ws/one/one/package.xml").write_text("mine")
    assert fetch("--update") == 3
    assert "files in it were changed" in capsys.readouterr().out
    assert (here / "ws/one/one/package.xml").read_text() == "mine"
    assert lock(here)["one"]["version"] == head(server, here / "ws/one")


@pytest.mark.parametrize(
    ("version", "said"),
    [
        ("mian", "there is no branch or tag 'mian'; the server has main"),
        ("-x", "is not a valid name"),
        ("a..b", "is not a valid name"),
    ],
)
def test_a_missing_branch_names_what_is_there(server, here, capsys, version, said):
    given = repos(here, one=(server.package("one"), version), two=server.package("two"))
    assert fetch("--distribution", given) == 3
    assert said in capsys.readouterr().out
    assert (here / "ws/two/two/package.xml").is_file()
    assert not (here / "ws/one").exists()


def test_an_empty_repository_and_one_that_is_none(server, here, capsys):
    (server.folder / "text").mkdir(parents=True)
    given = repos(here, none=server.make("none"), text=server.url("text"), named=(server.make("named"), "main"))
    assert fetch("--distribution", given) == 3
    out = capsys.readouterr().out
    assert out.count("the repository is empty: it has no branch") == 2
    assert "text" in out


def test_tags_and_commits_are_versions_too(server, here):
    url = server.package("one", commits=2)
    server.git("one", "tag", "-m", "t", "1.0.0", "HEAD~1")
    first = server.git("one", "rev-parse", "HEAD~1")
    server.git("one", "checkout", "-q", "--orphan", "other")
    hidden = server.commit("one", {"x": "1"})
    server.git("one", "checkout", "-q", "main")
    given = repos(here, tag=(url, "1.0.0"), commit=(url, first), hidden=(url, hidden))
    assert fetch("--distribution", given) == 0
    assert head(server, here / "ws/tag") == head(server, here / "ws/commit") == first
    assert head(server, here / "ws/hidden") == hidden


def test_a_commit_that_the_server_has_no_more(server, here, capsys):
    given = repos(here, one=(server.package("one"), "0123456789" * 4))
    assert fetch("--distribution", given) == 3
    assert "has no commit 012345678901 any more" in capsys.readouterr().out


def test_a_revision_by_count_by_day_and_by_filter(server, here):
    given = repos(here, one=(server.package("one", commits=5), "main"))
    for words, commits in ((["--at", "2"], 2), (["--at", "2020-01-03"], 3)):
        assert main(["fetch", "-q", "--into", words[1], "--distribution", given, *words]) == 0
        assert lock(here, words[1])["one"]["roslens"]["commits"] == commits
    (here / "filter.yaml").write_text("packages: {one: [one]}\nmeta: {one: {commits: 4}}\n")
    assert fetch("--distribution", given, "--filter", "filter.yaml", "--at", "count") == 0
    assert lock(here)["one"]["roslens"]["commits"] == 4
    assert lock(here)["one"]["roslens"]["packages"] == ["one"]
    # Another revision of what is there is brought about from what is there.
    assert fetch("--distribution", given, "--at", "5") == 0
    assert lock(here)["one"]["roslens"]["commits"] == 5


def test_depth_is_told_and_not_counted(server, here):
    given = repos(here, one=server.package("one", commits=3))
    assert fetch("--distribution", given, "--depth", "1") == 0
    assert "commits" not in lock(here)["one"]["roslens"]
    assert server.git(here / "ws/one", "rev-list", "--count", "HEAD") == "1"
    assert main(["fetch", "--distribution", given, "--depth", "1", "--at", "2", "--into", "x"]) == 2


def test_a_server_with_a_part_of_the_history(server, here, capsys):
    server.package("one", commits=3)
    server.git("one", "clone", "-q", "--depth", "1", server.url("one"), str(server.folder / "shallow"))
    assert main(["fetch", "--into", "ws", "--distribution", repos(here, one=server.url("shallow")), "--no-color"]) == 0
    assert "only a part of the history" in capsys.readouterr().out
    assert "commits" not in lock(here)["one"]["roslens"]


def test_a_server_that_makes_git_start_itself_without_end(server, here, capsys, monkeypatch):
    # What a folder shows beforehand, a server on the network does not.
    monkeypatch.setattr(clone, "_is_shallow", lambda _: False)
    server.package("one", commits=3)
    server.git("one", "clone", "-q", "--depth", "1", server.url("one"), str(server.folder / "shallow"))
    assert fetch("--distribution", repos(here, one=server.url("shallow"))) == 3
    assert not (here / "ws/one").exists()


def test_content_of_the_past_comes_only_when_asked_for(server, here):
    url = server.make("one")
    server.commit("one", {"a": "first"})
    old = server.git("one", "rev-parse", "HEAD:a")
    server.commit("one", {"a": "second"})
    given = repos(here, one=url)
    assert fetch("--distribution", given) == 0
    assert not has(server, here / "ws/one", old)
    assert fetch("--distribution", given, "--whole") == 0
    assert has(server, here / "ws/one", old)


def has(server, folder, blob):
    listed = server.git(folder, "rev-list", "--objects", "--all", "--missing=print")
    return f"?{blob}" not in listed.split()


def test_a_mirror_takes_the_place_of_a_server(server, here):
    server.package("ros/one")
    (here / "roslens.toml").write_text(
        f'[fetch]\njobs = 2\n[fetch.rewrite]\n"https://nowhere.invalid/" = "file://{server.folder}/"\n'
        '[fetch.version]\none = "main"\n'
    )
    given = repos(here, one=("https://nowhere.invalid/ros/one", "gone"))
    shutil.move(server.folder / "ros/one", server.folder / "ros/x")
    server.git("ros/x", "clone", "-q", "--bare", str(server.folder / "ros/x"), str(server.folder / "ros/one"))
    assert fetch("--distribution", given) == 0
    assert lock(here)["one"]["url"] == "https://nowhere.invalid/ros/one"


def test_other_systems_have_a_way_round(here, capsys):
    entries = {kind: {"type": kind, "url": "https://h/x"} for kind in ("hg", "svn", "tar", "bzr")}
    (here / "in.repos").write_text(json.dumps({"repositories": entries}))
    assert fetch("--distribution", "in.repos") == 3
    out = capsys.readouterr().out
    assert "git svn clone https://h/x" in out
    assert "hg-fast-export" in out
    assert out.count("[fetch.rewrite]") == 4


@pytest.mark.parametrize("name", ["../out", "/tmp/out", ".git", "a/../../out", "x.git"])
def test_no_name_leads_out_of_the_folder(server, here, capsys, name):
    assert fetch("--distribution", repos(here, **{name: server.package("one")})) == 3
    assert "is not a folder" in capsys.readouterr().out
    assert sorted(one.name for one in here.iterdir()) == ["in.repos", "ws"]
    assert not (here.parent / "out").exists()


def test_nothing_that_a_repository_brings_runs_or_leads_out(server, here, capsys, monkeypatch):
    mark = here / "ran"
    (here / "global").write_text(f'[filter "evil"]\n\tsmudge = touch {mark}\n\trequired = true\n')
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", str(here / "global"))
    url = server.package("one")
    inner = server.package("inner")
    (server.folder / "one/out").symlink_to("/etc/passwd")
    (server.folder / "one/in").symlink_to("one/package.xml")
    (server.folder / "one/round").symlink_to("../two/one/package.xml")
    server.git("one", "submodule", "add", "-q", inner, "sub")
    server.commit("one", {".gitattributes": "* filter=evil text eol=crlf\n", "a.txt": "a\nb\n"})
    (server.folder / "one/.git/hooks/post-upload-pack").write_text(f"touch {mark}")
    assert main(["fetch", "--into", "ws", "--distribution", repos(here, one=url), "--no-color"]) == 0
    out = capsys.readouterr().out
    assert "1 submodule is not fetched, the first at sub" in out
    assert "2 links that lead out of the repository are left out, the first at out" in out
    assert not mark.exists()
    assert (here / "ws/one/a.txt").read_bytes() == b"a\nb\n"
    assert (here / "ws/one/in").is_symlink()
    assert not os.path.lexists(here / "ws/one/out")
    assert not list((here / "ws/one/sub").iterdir())
    # What was left out is no change of the user's.
    server.commit("one", {"a.txt": "new\n"})
    assert fetch("--update") == 0


@pytest.mark.parametrize("before", [None, "* -text -filter -diff\n"], ids=["cloned", "of another version"])
def test_git_counts_lines_of_what_was_fetched_and_compares_nothing_by_a_program(server, here, monkeypatch, before):
    mark = here / "ran"
    (here / "global").write_text(f'[diff "evil"]\n\ttextconv = touch {mark};cat\n\tcommand = touch {mark}\n')
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", str(here / "global"))
    url = server.package("one")
    server.commit("one", {".gitattributes": "*.txt diff=evil\n", "a.txt": "a\nb\n"})
    given = repos(here, one=url)
    assert fetch("--distribution", given, "--whole") == 0
    if before:
        (here / "ws/one/.git/info/attributes").write_text(before)
        assert fetch("--distribution", given, "--whole") == 0
    said = main(["check", "ws", "--process-metrics", "--fail-on", "never", "-q", "--format", "json", "-o", "run.json"])
    assert said == 0
    (found,) = json.loads((here / "run.json").read_text())["process"]
    manifest = len((here / "ws/one/one/package.xml").read_text().splitlines())
    assert found["metrics"]["churn"] == 3 + manifest
    assert "\n+a\n" in server.git(here / "ws/one", "log", "-p")
    assert not mark.exists()


def test_a_folder_that_somebody_else_configured_is_not_fetched_into(server, here, capsys):
    given = repos(here, one=server.package("one"))
    assert fetch("--distribution", given) == 0
    server.git(here / "ws/one", "config", "core.sshCommand", "touch ran")
    assert fetch("--update") == 3
    assert 'its configuration has "core.sshcommand"' in capsys.readouterr().out
    (here / "ws/two").mkdir()
    assert fetch("--distribution", repos(here, two=server.package("two"))) == 3
    assert "the folder already exists" in capsys.readouterr().out


def test_a_clone_that_was_cut_off_is_made_again(server, here):
    given = repos(here, one=server.package("one"), two=server.package("two"))
    half = here / "ws/.roslens/fetch/parts/0/.git"
    assert fetch("--distribution", given, "--repository", "two") == 0
    half.mkdir(parents=True)
    (half / "HEAD").write_text("ref: refs/heads/main")
    journal = here / "ws/.roslens/fetch/journal.jsonl"
    journal.write_text('{"wanted": {"name": "on')
    assert fetch("--distribution", given) == 0
    assert not half.exists()
    assert not journal.exists()


def test_a_clone_of_which_only_the_note_is_missing_is_taken(server, here):
    given = repos(here, one=(server.package("one"), "main"))
    assert fetch("--distribution", given) == 0
    (here / "ws/fetched.repos").unlink()
    assert fetch("--distribution", given) == 0
    assert lock(here)["one"]["version"] == head(server, here / "ws/one")


def test_offline_asks_no_server(server, here, capsys):
    (here / "in.repos").write_text(
        json.dumps({"repositories": {"one": {"type": "git", "url": "https://nowhere.invalid/x"}}})
    )
    assert fetch("--offline", "--distribution", "in.repos") == 3
    assert "--offline allows no download" in capsys.readouterr().out
    assert fetch("--offline", "--distribution", "https://nowhere.invalid/d.yaml") == 2


def test_what_the_network_breaks_is_tried_again(server, here, monkeypatch):
    pauses = []
    real = git_runner.GitRunner._run
    broken = {"left": 2}

    def run(self, folder, command, arguments, **more):
        if command == "fetch" and broken["left"]:
            broken["left"] -= 1
            raise git_runner.GitError("fatal: early EOF fatal: fetch-pack: invalid index-pack output")
        return real(self, folder, command, arguments, **more)

    monkeypatch.setattr(git_runner.GitRunner, "_run", run)
    monkeypatch.setattr(fetch_options, "_pause", lambda _, seconds: pauses.append(seconds))
    assert fetch("--distribution", repos(here, one=server.package("one"))) == 0
    assert pauses == list(Retry(pauses.append).pauses_s[:2])


def test_a_host_that_is_not_there(here, capsys):
    (here / "in.repos").write_text(
        json.dumps({"repositories": {"one": {"type": "git", "url": "http://127.0.0.1:9/x.git"}}})
    )
    assert fetch("--distribution", "in.repos") == 3
    assert "127.0.0.1" in capsys.readouterr().out


def test_one_at_a_time(server, here, capsys):
    from roslens.source.fetch.journal import alone

    given = repos(here, one=server.package("one"))
    assert fetch("--distribution", given) == 0
    with alone(here / "ws/.roslens/fetch"):
        assert fetch("--distribution", given) == 2
    assert "another `roslens fetch` is at work" in capsys.readouterr().err


@pytest.mark.parametrize(
    "words",
    [[], ["--at", "soon"], ["--depth", "0"], ["--at", "count"], ["--distribution", "none.yaml"], ["--jobs", "-1"]],
)
def test_wrong_usage(here, words):
    assert fetch(*words) == 2


def test_a_document_that_names_nothing_it_can(here, capsys):
    (here / "in.repos").write_text("repositories: {a: {type: git}, b: 7}\n")
    assert fetch("--distribution", "in.repos") == 3
    assert capsys.readouterr().out.count("it has no url") == 2
    (here / "in.repos").write_text("repositories: 7\n")
    assert fetch("--distribution", "in.repos") == 2


def lacking(server, name, path):
    """Take the content of a file out of a server's repository."""
    blob = server.git(name, "rev-parse", f"HEAD:{path}")
    (server.folder / name / ".git" / "objects" / blob[:2] / blob[2:]).unlink()


def test_a_mirror_without_a_recording_gives_the_rest(server, here, capsys):
    url = server.package("arm")
    first = server.commit("arm", {"arm/long.bag": "x", "arm/pic[1].gif": "y", "arm/a.cpp": "int f();\n"})
    # Made while all content is there: git makes no tree of what it lacks.
    later = server.commit("arm", {"arm/b.cpp": "int g();\n"})
    server.git("arm", "update-ref", "refs/heads/main", first)
    lacking(server, "arm", "arm/long.bag")
    lacking(server, "arm", "arm/pic[1].gif")
    repos(here, arm=url)
    assert main(["fetch", "--distribution", "in.repos", "--into", "ws"]) == 0
    assert "lacks the content of 2 files, first arm/long.bag; none is a source" in capsys.readouterr().out
    assert (here / "ws/arm/arm/a.cpp").read_text() == "int f();\n"
    assert not (here / "ws/arm/arm/long.bag").exists()
    assert server.git(here / "ws/arm", "status", "--porcelain") == ""
    # It is a clone like any other: kept, and brought to what the branch has later.
    server.git("arm", "update-ref", "refs/heads/main", later)
    assert fetch("--into", "ws", "--update") == 0
    assert head(server, here / "ws/arm") == later
    assert (here / "ws/arm/arm/b.cpp").exists()


def test_a_mirror_without_a_source_is_refused(server, here, capsys):
    url = server.package("arm")
    server.commit("arm", {"arm/a.cpp": "int f();\n"})
    lacking(server, "arm", "arm/a.cpp")
    repos(here, arm=url)
    assert fetch("--distribution", "in.repos", "--into", "ws") == 3
    assert "does not have the content of arm/a.cpp" in capsys.readouterr().out
    assert not (here / "ws/arm").exists()
