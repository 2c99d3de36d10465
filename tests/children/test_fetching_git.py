"""Git for fetching: what it may be asked, and what of the environment reaches it."""

import os
import subprocess

import pytest

from roslens.children.fetching_git import fetching_environment, fetching_words
from roslens.children.session import number_in_session


@pytest.mark.parametrize("command", ["clone", "submodule", "checkout", "push", "gc", "difftool"])
def test_what_may_start_programs_is_refused(command):
    with pytest.raises(ValueError, match="may start what a repository brings"):
        fetching_words(".", command)


def test_only_some_protocols_are_spoken_and_nobody_is_asked():
    words = fetching_words("/r", "fetch", "origin")
    assert words[-2:] == ["fetch", "origin"]
    assert "protocol.allow=never" in words
    assert "core.hooksPath=/dev/null" in words
    environment = fetching_environment({"GIT_DIR": "/other", "GIT_SSH_COMMAND": "ssh -i key", "SSH_ASKPASS": "x"})
    assert environment["GIT_TERMINAL_PROMPT"] == "0"
    assert environment["GIT_ALLOW_PROTOCOL"] == "http:https:ssh:file"
    assert environment["GIT_SSH_COMMAND"] == "ssh -i key"
    assert not environment.keys() & {"GIT_DIR", "SSH_ASKPASS"}


def test_another_transport_is_not_used(tmp_path):
    def git(*words):
        return subprocess.run(words, capture_output=True, text=True, env=fetching_environment(os.environ), check=False)

    assert git(*fetching_words(str(tmp_path), "init", "-q")).returncode == 0
    done = git(*fetching_words(str(tmp_path), "ls-remote", f"ext::touch {tmp_path}/ran"))
    assert "not allowed" in done.stderr
    assert not (tmp_path / "ran").exists()


@pytest.mark.skipif(not os.path.isdir("/proc/self"), reason="the kernel does not tell")  # noqa: PTH112 - at import
def test_processes_of_a_session_are_counted():
    with subprocess.Popen(["sh", "-c", "sleep 60 & cat"], stdin=subprocess.PIPE, start_new_session=True) as process:
        try:
            while number_in_session(process.pid) < 3:
                assert process.poll() is None
        finally:
            os.killpg(process.pid, 9)
