"""Programs of Python packages as targets."""

import pytest

from roslens.source.extract.builds.python_setup import EntryPoint, Setup
from roslens.source.extract.builds.python_setup_targets import module_file, read_setup, setup_targets
from roslens.source.extract.facts.node_facts import Evidence

HERE = Evidence("p/setup.py", 1)


@pytest.mark.parametrize(
    ("module", "folders", "path"),
    [
        ("a.b", {}, "p/a/b.py"),
        ("a", {}, "p/a/__init__.py"),
        ("s.c", {"": "src"}, "p/src/s/c.py"),
        ("s.c", {}, "p/src/s/c.py"),
        ("n.d", {"n": "lib/n"}, "p/lib/n/d.py"),
        ("gone", {}, None),
    ],
)
def test_files_of_modules(module, folders, path):
    listing = ["p/a/__init__.py", "p/a/b.py", "p/src/s/c.py", "p/lib/n/d.py"]
    assert module_file("p", module, folders, listing) == path


def test_targets():
    setup = Setup(
        (EntryPoint("go", "a.b:main", HERE), EntryPoint("no", "gone:main", HERE)), (("bin/x", HERE), ("bin/y", HERE))
    )
    targets, unresolved = setup_targets("p", "p", setup, frozenset({"p/a/b.py", "p/bin/x"}), "$base/lib/p")
    assert [(one.name, one.sources, one.installed) for one in targets] == [
        ("go", ("p/a/b.py",), True),
        ("no", (), True),
        ("x", ("p/bin/x",), True),
    ]
    assert [one.text for one in unresolved] == ["gone:main", "bin/y"]


def test_what_is_installed_elsewhere():
    setup = Setup((EntryPoint("go", "a.b:main", HERE),))
    targets, _ = setup_targets("p", "p", setup, frozenset({"p/a/b.py"}), "bin")
    assert not targets[0].installed
    assert targets[0].evidence.how == "not installed to lib/p"


def test_all_files_of_a_package():
    class Files:
        def package(self, name):
            return None

        def content(self, path):
            return {
                "p/setup.py": b"setup(entry_points={'console_scripts': ['a = p:one']})",
                "p/setup.cfg": b"[install]\ninstall_scripts=$base/lib/p\n[options.entry_points]\n"
                b"console_scripts =\n  b = p:two\n",
                "p/pyproject.toml": b'[project.scripts]\nc = "p:three"\n',
            }.get(path)

    setup = read_setup("p", Files(), frozenset({"p/setup.py", "p/setup.cfg", "p/pyproject.toml"}))
    assert [one.name for one in setup.programs] == ["a", "b", "c"]
    assert setup.script_folder == "$base/lib/p"


def test_what_is_put_among_programs_as_data_is_one():
    setup = Setup(data=(("lib/p", ("scripts/go.bash", "scripts/gone.bash")), ("share/p", ("package.xml",))))
    targets, _ = setup_targets("p", "p", setup, frozenset({"p/scripts/go.bash", "p/package.xml"}), "lib/p")
    assert [(one.name, one.sources, one.installed) for one in targets] == [("go.bash", ("p/scripts/go.bash",), True)]
