"""One revision after the other in a folder: exactly its files, nothing through links, nothing else touched."""

import pytest
from process_metrics.small_repository import SmallRepository

from roslens.source.history.git_answer import HistoryError
from roslens.source.history.past_tree import LARGEST_OTHER_BYTES, PastTree


def files(folder) -> dict[str, str]:
    return {
        path.relative_to(folder).as_posix(): str(path.readlink()) if path.is_symlink() else path.read_text()
        for path in sorted(folder.rglob("*"))
        if path.is_symlink() or path.is_file()
    }


@pytest.fixture
def made(tmp_path) -> SmallRepository:
    return SmallRepository(tmp_path / "r")


def test_each_revision_is_there_whole(made, tmp_path):
    first = made.commit("1", day=0, a__one_DOT_py="1\n", a__two_DOT_py="2\n", a__file="x\n")
    made.git("mv", "a/one.py", "b.py")
    (made.root / "a/file").unlink()
    second = made.commit("2", day=1, a__file__inner="a folder now\n")
    folder = tmp_path / "past"
    folder.mkdir()
    with PastTree(str(made.root), "", folder) as tree:
        assert sorted(tree.show(first)) == ["a/file", "a/one.py", "a/two.py"]
        assert files(folder) == {"a/file": "x\n", "a/one.py": "1\n", "a/two.py": "2\n"}
        assert set(tree.show(second)) == {"a/file", "a/one.py", "b.py", "a/file/inner"}
        assert files(folder) == {"a/file/inner": "a folder now\n", "a/two.py": "2\n", "b.py": "1\n"}
        assert tree.show(second) == []
        tree.show(first)
        assert files(folder) == {"a/file": "x\n", "a/one.py": "1\n", "a/two.py": "2\n"}


def test_a_part_of_the_repository(made, tmp_path):
    head = made.commit("1", day=0, src__p__a_DOT_py="1\n", other_DOT_py="2\n")
    folder = tmp_path / "past"
    folder.mkdir()
    with PastTree(str(made.root), "src/", folder) as tree:
        tree.show(head)
    assert files(folder) == {"p/a.py": "1\n"}


def test_links_lead_nowhere_else(made, tmp_path):
    made.write("a.py", "1\n")
    (made.root / "in").symlink_to("a.py")
    (made.root / "out").symlink_to("../secret")
    (made.root / "root").symlink_to("/etc/passwd")
    head = made.commit("1", day=0)
    (made.root / "in").unlink()
    later = made.commit("2", day=1, in_DOT_txt="", **{"in": "a file now\n"})
    folder = tmp_path / "past"
    folder.mkdir()
    with PastTree(str(made.root), "", folder) as tree:
        tree.show(head)
        assert files(folder) == {"a.py": "1\n", "in": "a.py"}
        tree.show(later)
        assert files(folder)["in"] == "a file now\n"
        assert files(folder)["a.py"] == "1\n"


def test_what_is_large_and_no_source_is_there_but_empty(made, tmp_path):
    head = made.commit("1", day=0, mesh_DOT_stl=b"x" * (LARGEST_OTHER_BYTES + 1), small_DOT_stl=b"x", a_DOT_py="1\n")
    folder = tmp_path / "past"
    folder.mkdir()
    with PastTree(str(made.root), "", folder) as tree:
        tree.show(head)
    assert files(folder) == {"a.py": "1\n", "mesh.stl": "", "small.stl": "x"}


def test_files_that_git_lacks_are_told(made, tmp_path):
    head = made.commit("1", day=0, a_DOT_py="1\n", b_DOT_py="2\n")
    lost = made.git("rev-parse", "HEAD:b.py")
    (made.root / ".git/objects" / lost[:2] / lost[2:]).unlink()
    folder = tmp_path / "past"
    folder.mkdir()
    with PastTree(str(made.root), "", folder) as tree:
        tree.show(head)
        assert tree.lacking == ("b.py",)
    assert files(folder) == {"a.py": "1\n"}


def test_a_commit_that_is_none(made, tmp_path):
    made.commit("1", day=0)
    with PastTree(str(made.root), "", tmp_path) as tree, pytest.raises(HistoryError):
        tree.show("0" * 40)
