"""A small repository with everything that makes counting commits hard."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

MANIFEST = (
    '<package format="2"><name>{0}</name><version>1.0.0</version><description>d</description>'
    '<maintainer email="a@example.org">a</maintainer><license>BSD</license></package>\n'
)
BEGIN_S = 1_600_000_000
DAY_S = 86_400


class SmallRepository:
    """Commits of chosen people at chosen times; days count from :data:`BEGIN_S`."""

    def __init__(self, root: Path) -> None:
        self.root = root
        root.mkdir(parents=True, exist_ok=True)
        self.git("init", "-q")

    def git(self, *arguments: str, who: str = "Ann Ott <ann@x.org>", day: float = 0) -> str:
        name, _, address = who.removesuffix(">").partition(" <")
        when = f"{int(BEGIN_S + day * DAY_S)} +0000"
        person = {
            f"GIT_{role}_{what}": value
            for role in ("AUTHOR", "COMMITTER")
            for what, value in (("NAME", name), ("EMAIL", address), ("DATE", when))
        }
        return subprocess.run(
            ["git", "-C", str(self.root), "-c", "init.defaultBranch=main", *arguments],
            check=True, capture_output=True, text=True,
            env={**os.environ, **person, "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_NOSYSTEM": "1"},
        ).stdout.strip()  # fmt: skip

    def write(self, path: str, content: str | bytes) -> None:
        place = self.root / path
        place.parent.mkdir(parents=True, exist_ok=True)
        place.write_bytes(content if isinstance(content, bytes) else content.encode())

    def commit(self, message: str, *, day: float, who: str = "Ann Ott <ann@x.org>", **files: str | bytes) -> str:
        """Write files (``__`` stands for ``/``, ``_DOT_`` for a dot) and commit everything."""
        for path, content in files.items():
            self.write(path.replace("__", "/").replace("_DOT_", "."), content)
        self.git("add", "-A")
        self.git("commit", "-qm", message, "--allow-empty", who=who, day=day)
        return self.git("rev-parse", "HEAD")


def function(name: str, decisions: int) -> str:
    """Return a C++ function of the complexity ``decisions + 1``."""
    return f"int {name}(int x) {{\n" + "  if (x) ++x;\n" * decisions + "  return x;\n}\n"


def small_repository(root: Path) -> SmallRepository:
    """Return a repository of two packages, one inside the other, with merges, an octopus, renames and two names."""
    made = SmallRepository(root)
    ann, bob, old_bob, eve = "Ann Ott <ann@x.org>", "Bob <bob@x.org>", "bobby <bob@old.org>", "Éve <eve@x.org>"
    made.write("outer/package.xml", MANIFEST.format("outer"))
    made.write("outer/inner/package.xml", MANIFEST.format("inner"))
    made.commit("first", day=0, outer__src__a_DOT_cpp=function("a", 1), outer__inner__b_DOT_cpp=function("b", 2))
    both = "second\n\nCo-authored-by: bobby <bob@old.org>\nCo-Authored-By: Éve <eve@x.org>\nCo-authored-by: nobody\n"
    made.commit(both, day=1, who=ann, outer__src__a_DOT_cpp=function("a", 3))
    made.git("tag", "v0.1.0")
    for number in range(6):
        made.commit(
            f"together {number}", day=2 + number, who=(bob, old_bob, eve)[number % 3],
            outer__src__a_DOT_cpp=function("a", 4 + number), outer__inner__b_DOT_cpp=function("b", 3 + number),
        )  # fmt: skip
    for branch in ("one", "two", "three"):
        made.git("checkout", "-q", "-b", branch, "main")
        made.write(f"outer/src/{branch}.cpp", function(branch, 1))
        made.commit(branch, day=9, who=eve)
    made.git("checkout", "-q", "main")
    made.git("merge", "-q", "--no-ff", "-m", "octopus", "one", "two", "three", who=ann, day=10)
    made.git("mv", "outer/src/one.cpp", "outer/src/moved.cpp")
    made.write("outer/src/mesh.bin", bytes(range(256)))
    made.write("outer/src/grün & blau.py", "x = 1\n")
    made.write(".mailmap", "Bob <bob@x.org> bobby <bob@old.org>\n")
    made.commit("moved", day=11, who=bob)
    made.git("tag", "-a", "-m", "a release", "release/1.0", day=11)
    made.git("tag", "not-a-version")
    made.commit("not all files", day=12, who=eve, README="read me\n")
    return made
