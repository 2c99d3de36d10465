"""What sources include that tells a package's role: of own files, once, with its place."""

from roslens.model.result import RoleInclude
from roslens.model.source import Language, Role, SourceFile
from roslens.source.measure.role_includes import role_includes
from roslens.source.syntax.facts import FileFacts, Lines


def file(path, *includes, role=Role.OWN):
    syntax = "python" if path.endswith(".py") else "cpp"
    language = Language.PYTHON if syntax == "python" else Language.CPP
    return SourceFile(path, language, role), FileFacts(syntax, Lines(), includes=tuple(includes))


def test_headers_and_modules_of_devices_and_tasks():
    found = role_includes(
        [
            file("a.cpp", ("<linux/can/raw.h>", 3), ('"serial/serial.h"', 4), ("<vector>", 5)),
            file("b.cpp", ("<serial/serial.h>", 9), ("<moveit/move_group_interface/move_group_interface.h>", 2)),
            file("c.py", ("serial.tools", 1), ("os", 2), ("serialize", 3)),
        ],
        own=("thing",),
    )
    assert found == (
        RoleInclude("devices", "linux/can/raw.h", "a.cpp", 3),
        RoleInclude("devices", "serial.tools", "c.py", 1),
        RoleInclude("devices", "serial/serial.h", "a.cpp", 4),
        RoleInclude("tasks", "moveit/move_group_interface/move_group_interface.h", "b.cpp", 2),
    )


def test_tests_and_the_package_itself_tell_nothing():
    files = [file("test/a.cpp", ("<libusb.h>", 1), role=Role.TEST), file("b.cpp", ('"serial/serial.h"', 1))]
    assert role_includes(files, own=("serial",)) == ()


def test_few_of_a_kind_are_enough():
    includes = [(f"<linux/can/{number}.h>", number) for number in range(9)]
    names = [one.name for one in role_includes([file("a.cpp", *includes)], own=())]
    assert names == ["linux/can/0.h", "linux/can/1.h", "linux/can/2.h"]
