"""Files with another path in a later revision."""

import os
import subprocess

from roslens.cli.git.git_renames import renamed_files
from roslens.cli.git.git_repository import repository_of

TEXT = "".join(f"line {number}\n" for number in range(30))


def git(root, *arguments):
    who = {f"GIT_{role}_{what}": "a@b.c" for role in ("AUTHOR", "COMMITTER") for what in ("NAME", "EMAIL")}
    environment = {**os.environ, **who, "GIT_CONFIG_GLOBAL": "/dev/null"}
    subprocess.run(["git", "-C", str(root), *arguments], check=True, env=environment)


def test_a_file_that_is_much_the_same_has_moved(tmp_path):
    (tmp_path / "ws/a b").mkdir(parents=True)
    (tmp_path / "ws/a b/ä.py").write_text(TEXT)
    (tmp_path / "ws/left.py").write_text(TEXT.upper())
    (tmp_path / "ws/other.py").write_text("nothing alike")
    git(tmp_path, "init", "-q")
    git(tmp_path, "add", ".")
    git(tmp_path, "commit", "-qm", "before")
    (tmp_path / "ws/b").mkdir()
    git(tmp_path, "mv", "ws/a b/ä.py", "ws/b/ö.py")
    git(tmp_path, "mv", "ws/left.py", "left.py")
    (tmp_path / "ws/b/ö.py").write_text(TEXT + "more\n")
    git(tmp_path, "commit", "-qam", "after")
    repository = repository_of(str(tmp_path / "ws"))
    assert renamed_files(repository, "HEAD~1", "HEAD") == {"a b/ä.py": "b/ö.py"}
    assert renamed_files(repository_of(str(tmp_path)), "HEAD~1", "HEAD") == {
        "ws/a b/ä.py": "ws/b/ö.py",
        "ws/left.py": "left.py",
    }
    assert renamed_files(repository, "HEAD", "HEAD") == {}
    assert renamed_files(repository, "HEAD~7", "HEAD") == {}
