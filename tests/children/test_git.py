"""What a hostile repository configures is not started, whatever it is asked."""

import os
import subprocess

import pytest

from roslens.children.git import COMMANDS, git_environment, git_words, looks_bare

PROGRAMS = """\
[core]
    repositoryformatversion = 0
    bare = false
    worktree = {tree}
    fsmonitor = {touch}
    hooksPath = {hooks}
    pager = {touch}
    sshCommand = {touch}
    attributesFile = {attributes}
[diff]
    external = {touch}
[diff "evil"]
    textconv = {touch}
    command = {touch}
[filter "evil"]
    clean = {touch}
    smudge = {touch}
    process = {touch}
[pager]
    log = {touch}
"""


@pytest.fixture
def hostile(tmp_path):
    """A repository with all that can name a program, and a file whose content differs from the commit's."""
    root = tmp_path / "clone"
    root.mkdir()
    asked = {"cwd": root, "check": True, "capture_output": True}
    subprocess.run(["git", "init", "-q"], **asked)
    (root / "a.cpp").write_text("int a;\n")
    who = ["-c", "user.name=a", "-c", "user.email=a@example.org"]
    for number in range(2):
        (root / "a.cpp").write_text(f"int a{number};\n")
        subprocess.run(["git", "add", "."], **asked)
        subprocess.run(["git", *who, "commit", "-qm", "one"], **asked)
    touch = tmp_path / "touch.sh"
    touch.write_text(f"#!/bin/sh\necho ran >> {tmp_path}/ran\ncat\n")
    touch.chmod(0o755)
    hooks = tmp_path / "hooks"
    hooks.mkdir()
    for name in ("post-index-change", "reference-transaction", "pre-commit"):
        (hooks / name).write_text(touch.read_text())
        (hooks / name).chmod(0o755)
    (tmp_path / "attributes").write_text("*.cpp filter=evil diff=evil\n")
    (root / ".gitattributes").write_text("*.cpp filter=evil diff=evil\n")
    settings = PROGRAMS.format(tree=root, touch=touch, hooks=hooks, attributes=tmp_path / "attributes")
    (root / ".git" / "config").write_text(settings)
    (root / "a.cpp").write_text("int changed;\n")
    os.utime(root / "a.cpp", (1, 1))
    return root


ASKED = {
    "cat-file": ("-p", "HEAD:a.cpp"),
    "check-mailmap": ("A Name <a@b>",),
    "config": ("--list",),
    "diff-tree": ("-r", "-p", "HEAD~1", "HEAD"),
    "for-each-ref": (),
    "log": ("-p", "HEAD"),
    "ls-files": ("-s",),
    "ls-tree": ("-r", "HEAD"),
    "rev-list": ("HEAD",),
    "rev-parse": ("HEAD",),
}


@pytest.mark.parametrize("command", sorted(COMMANDS))
def test_no_program_of_the_repository_runs(hostile, command):
    done = subprocess.run(
        git_words(str(hostile), command, *ASKED[command]), env=git_environment(os.environ), capture_output=True
    )
    assert done.returncode == 0, done.stderr
    assert not (hostile.parent / "ran").exists()


def test_the_trap_works(hostile):
    subprocess.run(["git", "status"], cwd=hostile, capture_output=True, check=False)
    assert (hostile.parent / "ran").exists()


def test_commands_that_may_start_something_are_refused():
    with pytest.raises(ValueError, match="git status may start what a repository configures"):
        git_words("/r", "status")


def test_a_bare_repository_inside_a_clone_is_recognised(tmp_path):
    inner = tmp_path / "clone" / "fixtures" / "evil"
    (tmp_path / "clone" / ".git").mkdir(parents=True)
    for name in ("objects", "refs", "src"):
        (inner / name).mkdir(parents=True)
    assert looks_bare(str(inner)) == ""
    (inner / "HEAD").write_text("ref: refs/heads/main\n")
    assert looks_bare(str(inner / "src")) == str(inner)
    assert looks_bare(str(tmp_path / "clone")) == ""


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("core.fsmonitor", "false"),
        ("core.hooksPath", os.devnull),
        ("core.pager", "cat"),
        ("credential.helper", ""),
        ("diff.external", ""),
        ("log.showSignature", "false"),
        ("protocol.allow", "never"),
        ("safe.bareRepository", "explicit"),
        ("submodule.recurse", "false"),
    ],
)
def test_what_a_repository_says_is_overruled(hostile, name, value):
    """Asked of git itself: no command that is allowed looks at all of these."""
    subprocess.run(["git", "-C", hostile, "config", name, "true"], check=False)
    words = git_words(str(hostile), "config", "--get", name)
    done = subprocess.run(words, env=git_environment(os.environ), capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.rstrip("\n")) == (0, value)


def test_programs_that_the_environment_names_are_left_out_and_the_rest_is_kept():
    programs = ("GIT_EXTERNAL_DIFF", "GIT_SSH", "GIT_SSH_COMMAND", "GIT_ASKPASS", "SSH_ASKPASS", "GIT_PAGER")
    found = git_environment({"PATH": "/usr/bin", "HOME": "/h", **dict.fromkeys(programs, "evil")})
    assert found == {
        "PATH": "/usr/bin",
        "HOME": "/h",
        "GIT_TERMINAL_PROMPT": "0",
        "GIT_NO_LAZY_FETCH": "1",
        "GIT_OPTIONAL_LOCKS": "0",
        "GIT_ATTR_NOSYSTEM": "1",
        "LC_ALL": "C",
    }


def test_further_objects_are_named_as_git_reads_them():
    found = git_environment({}, ['/a"b\\c', "/d:e"])
    assert found["GIT_ALTERNATE_OBJECT_DIRECTORIES"] == '"/a\\"b\\\\c":"/d:e"'


@pytest.mark.parametrize("missing", ["HEAD", "objects", "refs"])
def test_what_lacks_a_part_is_no_bare_repository(tmp_path, missing):
    for name in {"objects", "refs"} - {missing}:
        (tmp_path / name).mkdir()
    if missing != "HEAD":
        (tmp_path / "HEAD").touch()
    assert looks_bare(str(tmp_path)) == ""
