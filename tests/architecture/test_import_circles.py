"""No module comes back to itself over imports, whenever they are carried out."""

import textwrap

import pytest

from architecture.imports import When, circles, imports


@pytest.fixture(scope="module")
def graph():
    return imports()


def test_no_module_comes_back_to_itself(graph):
    # Over imports at load, in functions and for type checkers together.
    assert circles(graph, *When) == []


@pytest.mark.parametrize(
    ("back", "when"),
    [
        ("from roslens import a", When.LOADED),
        ("from .a import x", When.LOADED),
        ("import roslens.a", When.LOADED),
        ("def f():\n    from roslens.a import x", When.CALLED),
        ("class C:\n    def f(self):\n        if self:\n            from . import a", When.CALLED),
        ("if typing.TYPE_CHECKING:\n    from roslens.a import x", When.CHECKED),
    ],
)
def test_a_planted_circle_is_seen(tmp_path, back, when):
    package = tmp_path / "roslens"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / "a.py").write_text("from roslens.b import y\nx = 1\n")
    (package / "b.py").write_text(textwrap.dedent(back))
    found = imports(tmp_path)
    assert found["roslens.b"] == {"roslens.a": when}
    assert circles(found, When.LOADED, when) == [["roslens.a", "roslens.b"]]
    assert circles(found, When.LOADED) == ([["roslens.a", "roslens.b"]] if when is When.LOADED else [])


def test_circles_that_share_a_module_are_one(tmp_path):
    (tmp_path / "a.py").write_text("import b, c")
    (tmp_path / "b.py").write_text("import a")
    (tmp_path / "c.py").write_text("import a, d")
    (tmp_path / "d.py").write_text("")
    assert circles(imports(tmp_path), *When) == [["a", "b", "c"]]
