"""In which files a command line may be written, and that a result is made anew when one of them changes."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from roslens.source.workspace.command_texts import command_texts

Tree = Callable[[Mapping[str, str | bytes]], Path]


def test_texts_of_the_package_and_those_beside_and_above(tree: Tree) -> None:
    root = tree({"README.md": "", "src/run.sh": "", "src/a/b.txt": "", "src/b/other.sh": "", "src/a/c.cpp": ""})
    inside = ["src/a/c.cpp", "src/a/b.txt"]
    assert command_texts(str(root), "src/a", inside) == ["src/a/b.txt", "src/run.sh", "README.md"]


def test_a_package_at_the_root_has_nothing_above(tree: Tree) -> None:
    root = tree({"README.md": "", "a.cpp": ""})
    assert command_texts(str(root), ".", ["README.md", "a.cpp"]) == ["README.md"]
