"""Repositories come over http and ssh from servers that are real, with what such servers do."""

import json
import os

import pytest

from roslens.cli.check import fetch_options
from roslens.cli.main import main

from .git_servers import git_ssh, git_web

pytestmark = [pytest.mark.real, pytest.mark.timed]


@pytest.fixture(autouse=True)
def _no_pauses(monkeypatch):
    monkeypatch.setattr(fetch_options, "_pause", lambda *_: None)


@pytest.fixture
def arm(server):
    """Return the newest of three commits; its file was another one before."""
    server.package("arm", commits=2)
    server.commit("arm", {"arm/a.cpp": "int before();\n"}, day="2020-02-01")
    return server.commit("arm", {"arm/a.cpp": "int f();\n"}, day="2020-02-02")


def fetch(here, url, *words):
    (here / "in.repos").write_text(json.dumps({"repositories": {"arm": {"type": "git", "url": url}}}))
    return main(["fetch", "--distribution", "in.repos", "--into", "ws", *words])


def objects(server, place):
    """Return how many objects a clone has, without asking its server."""
    return len(server.git(place, "cat-file", "--batch-all-objects", "--batch-check").splitlines())


def test_over_http_only_what_is_needed_comes(server, here, arm):
    with git_web(server.folder) as web:
        assert fetch(here, web.url("arm")) == 0
        assert server.git(here / "ws/arm", "rev-parse", "HEAD") == arm
        assert (here / "ws/arm/arm/a.cpp").read_text() == "int f();\n"
        # The content of the past stays where it is.
        assert objects(server, here / "ws/arm") == objects(server, "arm") - 1
        asked = len(web.asked)
        assert fetch(here, web.url("arm")) == 0
        assert len(web.asked) == asked


def test_over_http_a_server_that_is_busy_is_asked_again(server, here, arm):
    with git_web(server.folder) as web:
        web.refuse = 2
        assert fetch(here, web.url("arm")) == 0
        assert server.git(here / "ws/arm", "rev-parse", "HEAD") == arm


def test_over_http_what_is_not_there_is_a_failure_of_its_own(server, here, arm, capsys):
    with git_web(server.folder) as web:
        assert fetch(here, web.url("leg")) == 3
    assert "not found" in capsys.readouterr().out


def test_over_http_a_password_comes_from_the_helpers_of_git_alone(server, here, arm, capsys, monkeypatch):
    with git_web(server.folder) as web:
        web.password = "secret"
        assert fetch(here, web.url("arm")) == 3
        assert "secret" not in capsys.readouterr().out
        helper = "!f() { echo username=robot; echo password=secret; }; f"
        (here / "gitconfig").write_text(f'[credential]\n\thelper = "{helper}"\n')
        monkeypatch.setenv("GIT_CONFIG_GLOBAL", str(here / "gitconfig"))
        assert fetch(here, web.url("arm")) == 0
    assert server.git(here / "ws/arm", "rev-parse", "HEAD") == arm
    assert "secret" not in (here / "ws/fetched.repos").read_text() + (here / "ws/arm/.git/config").read_text()


def test_over_ssh(server, here, arm, capsys, tmp_path, monkeypatch):
    with git_ssh(tmp_path / "ssh") as (address, command):
        url = f"{address}{server.folder}/arm/.git"
        monkeypatch.setenv("GIT_SSH_COMMAND", command.replace(f"{tmp_path}/ssh/known", os.devnull))
        assert fetch(here, url) == 3
        assert "Host key verification failed" in capsys.readouterr().out
        monkeypatch.setenv("GIT_SSH_COMMAND", command)
        assert fetch(here, url) == 0
    assert server.git(here / "ws/arm", "rev-parse", "HEAD") == arm
    assert (here / "ws/arm/arm/a.cpp").read_text() == "int f();\n"
