"""A server of git repositories: bare ones in a folder, reached by file://."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

MANIFEST = (
    '<package format="3"><name>{name}</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">a</maintainer><license>MIT</license></package>\n'
)


class Server:
    """Makes repositories and changes them."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def git(self, name: str, *words: str, when: str = "2020-01-01T12:00:00 +0000") -> str:
        environment = {
            **os.environ,
            "GIT_CONFIG_GLOBAL": os.devnull,
            "GIT_AUTHOR_DATE": when,
            "GIT_COMMITTER_DATE": when,
        }
        options = ["-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "protocol.file.allow=always"]
        done = subprocess.run(
            ["git", *options, "-C", str(self.folder / name), *words],
            check=True, capture_output=True, text=True, env=environment,
        )  # fmt: skip
        return done.stdout.strip()

    def make(self, name: str, *, branch: str = "main") -> str:
        """Make an empty repository and return its URL."""
        (self.folder / name).mkdir(parents=True)
        self.git(name, "init", "-q", "-b", branch)
        return self.url(name)

    def url(self, name: str) -> str:
        return f"file://{self.folder / name}/.git"

    def commit(self, name: str, files: dict[str, str] | None = None, *, day: str = "2020-01-01") -> str:
        """Write files, commit them and return the commit."""
        for path, text in (files or {}).items():
            place = self.folder / name / path
            place.parent.mkdir(parents=True, exist_ok=True)
            place.write_text(text)
        self.git(name, "add", "-A")
        self.git(name, "commit", "-q", "--allow-empty", "-m", "c", when=f"{day}T12:00:00 +0000")
        return self.git(name, "rev-parse", "HEAD")

    def package(self, name: str, package: str = "", *, commits: int = 1) -> str:
        """Make a repository with one package and so many commits; return its URL."""
        url = self.make(name)
        package = package or name
        for number in range(commits):
            day = f"2020-01-{number + 1:02}"
            self.commit(name, {f"{package}/package.xml": MANIFEST.format(name=package)}, day=day)
        return url


@pytest.fixture
def server(tmp_path):
    return Server(tmp_path / "server")


@pytest.fixture
def here(tmp_path, monkeypatch):
    """Be in a folder of one's own, with a configuration of git that is nobody's."""
    folder = tmp_path / "here"
    folder.mkdir()
    monkeypatch.chdir(folder)
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", os.devnull)
    monkeypatch.setenv("GIT_CONFIG_SYSTEM", os.devnull)
    return folder
