"""The files of a revision of a Git repository."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable, Mapping
from functools import cached_property
from pathlib import Path


class Revision:
    """A revision that stands for a distribution."""

    def __init__(self, repository: Path, distro: str, revision: str) -> None:
        """Take where it is, and what it stands for."""
        self.repository = repository
        self.distro = distro
        self.revision = revision

    @cached_property
    def date(self) -> str:
        """The month of its commit."""
        return self._git("log", "-1", "--format=%cs", self.revision).decode().strip()[:7]

    @cached_property
    def paths(self) -> tuple[str, ...]:
        """All its files."""
        return tuple(self._git("ls-tree", "-r", "--name-only", self.revision).decode("utf-8", "replace").splitlines())

    def read(self, paths: Iterable[str]) -> Mapping[str, str]:
        """Return the contents of files, by path."""
        wanted = list(paths)
        asked = "".join(f"{self.revision}:{path}\n" for path in wanted).encode()
        done = subprocess.run(
            ["git", "-C", str(self.repository), "cat-file", "--batch"], input=asked, capture_output=True, check=True
        )
        found, at = {}, 0
        for path in wanted:
            end = done.stdout.index(b"\n", at)
            fields = done.stdout[at:end].split()
            at = end + 1
            if fields[-1] == b"missing":
                continue
            size = int(fields[-1])
            found[path] = done.stdout[at : at + size].decode("utf-8", "replace")
            at += size + 1
        return found

    def _git(self, *words: str) -> bytes:
        return subprocess.run(["git", "-C", str(self.repository), *words], capture_output=True, check=True).stdout
