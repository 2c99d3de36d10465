"""A folder becomes a workspace: its packages, files and what their names tell."""

from roslens.model.source import Language
from roslens.plugins.sample import language_of, sample_workspace

MANIFEST = "<package format='2'><name> robot </name><version>1.2.3</version><depend>roscpp</depend></package>"


def test_packages_and_their_files(tmp_path):
    for name, text in {
        "a/package.xml": MANIFEST,
        "a/src/x.cpp": "int x;",
        "b/package.xml": "<package>",
        "b/__pycache__/x.pyc": "",
        "loose.py": "",
    }.items():
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
    workspace = sample_workspace(tmp_path)
    assert [(package.package.id, package.package.version) for package in workspace.packages] == [
        ("robot", "1.2.3"),
        ("b", ""),
    ]
    robot = workspace.packages[0]
    assert [(file.path, file.language, file.package) for file in robot.files] == [
        ("a/package.xml", Language.MANIFEST, "robot"),
        ("a/src/x.cpp", Language.CPP, "robot"),
    ]
    assert [(dependency.name, dependency.kind) for dependency in robot.package.dependencies] == [("roscpp", "depend")]
    assert [entity.id for entity in robot.entities] == ["package:robot", "file:a/package.xml", "file:a/src/x.cpp"]


def test_a_folder_without_manifest_is_one_package(tmp_path):
    (tmp_path / "x.py").touch()
    (package,) = sample_workspace(tmp_path).packages
    assert (package.package.name, [file.path for file in package.files]) == (tmp_path.name, ["x.py"])
    (single,) = sample_workspace(tmp_path / "x.py").packages
    assert [file.path for file in single.files] == ["x.py"]


def test_languages():
    assert {name: language_of(name).value for name in ("a.launch.py", "a.py", "CMakeLists.txt", "x", "a.hpp")} == {
        "a.launch.py": "launch_python",
        "a.py": "python",
        "CMakeLists.txt": "cmake",
        "x": "other",
        "a.hpp": "cpp",
    }
