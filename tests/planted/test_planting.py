"""What is put into a real file lies where it says."""

from random import Random

from planted.planting import plant_cpp, plant_python, without_guard

HOST = "#include <string>\n\nnamespace a\n{\nint one();\nint two();\n}  // namespace a\n"


def test_a_text_lies_between_two_declarations():
    planted = plant_cpp(HOST, "#include <vector>\nvoid f() {\n}\n", Random(1))
    lines = planted.content.splitlines()
    assert lines[planted.first - 1 : planted.last] == ["void f() {", "}"]
    assert lines[: planted.head] == ["#include <vector>"]
    assert [one for one in lines if one not in ("void f() {", "}", "#include <vector>")] == [
        one for one in HOST.splitlines() if one != "}"
    ]


def test_a_file_without_declarations_takes_nothing():
    assert plant_cpp("#include <string>\n", "int a;\n", Random(1)) is None
    assert plant_python("import os\n", "a = 1\n", Random(1)) is None
    assert plant_python("print 'two'\n", "a = 1\n", Random(1)) is None


def test_a_text_lies_between_two_statements():
    planted = plant_python(
        "from __future__ import annotations\nimport os\n\n@os.name\ndef f():\n    pass\n", "a = 1\nb = 2\n", Random(2)
    )
    assert planted.content.splitlines()[planted.first - 1 : planted.last] == ["a = 1", "b = 2"]
    compile(planted.content, "planted.py", "exec")


def test_a_header_loses_its_guard():
    header = "#ifndef A_H_\n#define A_H_\n#include <string>\nclass A;\n#endif  // A_H_\n"
    assert without_guard(header).content == "#include <string>\nclass A;\n"
    assert (
        without_guard("#pragma once\n#include <string>\nstruct A {};\n").content == "#include <string>\nstruct A {};\n"
    )
    assert without_guard("#include <string>\nclass A;\n") is None
