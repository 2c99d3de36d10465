import os

from accuracy.ros1 import _executable, _link_libraries, _without_master, why_not
from accuracy.system import System
from roslens.model.graph import Endpoint, Graph, Node, Role


def test_what_is_there_before_a_launch_is_no_part_of_it():
    ends = (Endpoint("/n", Role.PUBLISHER, "/rosout"), Endpoint("/rosout", Role.PUBLISHER, "/rosout_agg"))
    parameters = {"": {"/rosdistro": "x", "/roslaunch/uris/a": "y", "/mine": "1"}, "/n": {"rate": "2"}}
    found = _without_master(Graph("ros1", (Node("/n"), Node("/rosout")), ends, parameters=parameters))
    assert found.nodes == (Node("/n"),)
    assert found.endpoints == ends[:1]
    assert found.parameters == {"": {"/mine": "1"}, "/n": {"rate": "2"}}


def test_scripts_can_be_started_where_they_lie(tmp_path):
    script = tmp_path / "package" / "scripts" / "a.py"
    script.parent.mkdir(parents=True)
    script.write_text("print(1)\n")
    _executable(tmp_path)
    assert script.read_text() == "#!/usr/bin/python3\nprint(1)\n"
    assert os.access(script, os.X_OK)


def test_libraries_of_plugins_are_there_by_the_names_that_are_asked_for(tmp_path):
    library = tmp_path / "usr" / "x86_64" / "libnodelets.so.1.2"
    library.parent.mkdir(parents=True)
    library.write_bytes(b"ELF")
    package = tmp_path / "workspace" / "pkg"
    package.mkdir(parents=True)
    (package / "nodelet_plugins.xml").write_text(
        '<class_libraries><library path="lib/libnodelets"/><library path="lib/libgone"/></class_libraries>'
    )
    for _ in range(2):
        _link_libraries(tmp_path / "workspace", tmp_path / "usr")
    assert [one.name for one in (package / "lib").iterdir()] == ["libnodelets.so"]
    assert (package / "lib" / "libnodelets.so").resolve() == library


def test_a_program_that_is_missing_is_named():
    system = System("a robot", "ros1", "p/x.launch", (), "It.", 1, needs=("/nowhere/tool",))
    assert "/nowhere/tool" in why_not(system)
