import pytest

from roslens.source.extract.overlays.ros.reconfigure_file import read_reconfigure_file, reconfigure_files
from roslens.source.extract.symbolic.condition import as_written

MODULE = "dynamic_reconfigure.parameter_generator_catkin"
HEAD = f"#!/usr/bin/env python\nfrom {MODULE} import *\ngen = ParameterGenerator()\n"
END = '\nexit(gen.generate("pkg", "node", "A"))\n'


@pytest.fixture
def read(index_of):
    """Return the declarations of a ``.cfg`` file with this between generator and class."""

    def make(text, head=HEAD, end=END, **files):
        (file,) = read_reconfigure_file(index_of(A_cfg=head + text + end, **files), "pkg/A.cfg")
        return file.declarations

    return make


def told(declarations):
    return [(str(one.name), one.type, one.default.known, one.range) for one in declarations]


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ('"rate", double_t, 0, "Hz", 10, 0, 100', ("rate", "double", "10.0", "0.0..100.0")),
        ('"rate", double_t, 0, "Hz", .5', ("rate", "double", "0.5", "")),
        ('"count", int_t, 1, "", 3, 1', ("count", "int", "3", "1..")),
        ('"count", int_t, 1, "", -3, max=1', ("count", "int", "-3", "..1")),
        ('"on", bool_t, 0, "", True', ("on", "bool", "true", "")),
        ('"frame", str_t, 0, "", "map"', ("frame", "string", "map", "")),
        ('"x", paramtype=int_t, level=0, description="", default=1, min=-1, max=2', ("x", "int", "1", "-1..2")),
        # Without a default it is nothing of its type.
        ('"x", double_t, 0, ""', ("x", "double", "0.0", "")),
        ('"x", int_t, 0, ""', ("x", "int", "0", "")),
        ('"x", bool_t, 0, ""', ("x", "bool", "false", "")),
        ('"x", str_t, 0, ""', ("x", "string", "", "")),
        # What is not evaluated, or fits its type nowhere, is unknown.
        ('"x", int_t, 0, "", os.getpid()', ("x", "int", None, "")),
        ('"x", int_t, 0, "", 1.5', ("x", "int", None, "")),
        ('"x", bool_t, 0, "", 1', ("x", "bool", None, "")),
    ],
)  # fmt: skip
def test_a_parameter(read, arguments, expected):
    assert told(read(f"gen.add({arguments})")) == [expected]


def test_what_people_are_told_and_where(read):
    (one,) = read('gen.add("rate", double_t, 0,\n  "How often. "\n  "In Hz.", 10)')
    assert (one.description, one.evidence.path, one.evidence.line) == ("How often. In Hz.", "pkg/A.cfg", 4)


def test_pi_of_python(read):
    found = read('from math import pi\nimport math\ngen.add("x", double_t, 0, "", pi / 2, -math.pi, 2 * pi)')
    assert told(found) == [("x", "double", "1.5707963267948966", "-3.141592653589793..6.283185307179586")]


def test_constants_and_choices(read):
    text = """
least = 1
sizes = gen.enum([gen.const("small", int_t, 0, ""), gen.const("large", int_t, 1, "")], "Sizes")
gen.add("size", int_t, 0, "", 1, 0, least, edit_method=sizes)
"""
    assert told(read(text)) == [("size", "int", "1", "0..1")]


def test_groups_do_not_change_names(read):
    text = """
outer = gen.add_group("Outer", type="tab")
inner = outer.add_group("Inner")
gen.add("a", int_t, 0, "")
outer.add("b", int_t, 0, "")
inner.add("c", int_t, 0, "")
"""
    assert [str(one.name) for one in read(text)] == ["a", "b", "c"]


def test_loops_over_constants(read):
    text = 'for number, name in enumerate(["left", "right"]):\n    gen.add(name + "_%d" % number, int_t, 0, "", number)'
    assert told(read(text)) == [("left_0", "int", "0", ""), ("right_1", "int", "1", "")]


def test_a_function_of_another_package(index_of):
    common = """
from dynamic_reconfigure.parameter_generator_catkin import double_t
def add_limits(gen, least=0.1):
    gen.add("max_speed", double_t, 0, "", 0.5, least)
"""
    text = HEAD.replace("gen =", "from limits import add_limits\ngen =") + "add_limits(gen)" + END
    index = index_of(A_cfg=text, limits_py=common)
    ((one,),) = (file.declarations for file in read_reconfigure_file(index, "pkg/A.cfg"))
    assert told([one]) == [("max_speed", "double", "0.5", "0.1..")]
    assert (one.evidence.path, one.evidence.line) == ("pkg/limits.py", 4)


@pytest.mark.parametrize(
    "head",
    [
        f"from {MODULE} import ParameterGenerator, int_t\ngen = ParameterGenerator()\n",
        "from dynamic_reconfigure.parameter_generator import *\ngen = ParameterGenerator()\n",
        f"import {MODULE} as made\nint_t = made.int_t\ngen = made.ParameterGenerator()\n",
    ],
)
def test_ways_to_import(read, head):
    assert told(read('gen.add("a", int_t, 0, "", 1)', head=head)) == [("a", "int", "1", "")]


def test_the_source_of_the_generator_may_be_there(read):
    own = 'int_t = "int"\nclass ParameterGenerator(object):\n    def add(self, *args):\n        raise Exception\n'
    assert told(read('gen.add("a", int_t, 0, "", 1)', parameter_generator_catkin_py=own)) == [("a", "int", "1", "")]


def test_what_only_a_run_decides_keeps_its_condition(read):
    found = read('import os\nif os.path.exists("/x"):\n    gen.add("a", int_t, 0, "")\ngen.add("b", int_t, 0, "")')
    assert [bool(one.conditions) for one in found] == [True, False]


def test_only_where_it_is_started(read):
    text = 'gen.add("a", int_t, 0, "")\nif __name__ == "__main__":\n    gen.add("b", int_t, 0, "")'
    assert [(str(one.name), as_written(one.conditions)) for one in read(text)] == [("a", ()), ("b", ())]


def test_files_are_found_by_the_name_of_their_class(index_of):
    index = index_of(A_cfg=HEAD + END, B_cfg=HEAD + 'exit(gen.generate(PACKAGE, "node", "B"))')
    assert [(one.package, one.name, one.whole) for one in reconfigure_files(index, "A")] == [("pkg", "A", True)]
    assert [(one.package, one.name) for one in reconfigure_files(index, "B")] == [("", "B")]
    assert not reconfigure_files(index, "C")


def test_a_file_that_is_not_understood_says_so(index_of):
    text = HEAD + 'gen.add("a", int_t, 0, "")\ngen.add("b", int_t, 0,, "")' + END
    (file,) = read_reconfigure_file(index_of(A_cfg=text), "pkg/A.cfg")
    assert not file.whole


def test_a_file_that_never_ends_ends(index_of):
    text = """
def f(x):
    for y in range(16):
        f(x + [y])
        g(x)
def g(x):
    f(x)
while True:
    f([])
"""
    read_reconfigure_file(index_of(A_cfg=HEAD + text + END), "pkg/A.cfg")


def test_settings_of_something_else_are_left_alone(index_of):
    assert read_reconfigure_file(index_of(A_cfg="[net]\nbatch=64\n"), "pkg/A.cfg") == ()
