"""Small programs written in a test, lowered and evaluated."""

import pytest

from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.lowering.python.python_program import program_of_python
from roslens.source.extract.units.workspace_units import facts_of_workspace
from roslens.source.syntax.macro.macros import load_macros

MACROS = load_macros()


def index_of(**files):
    programs = {}
    for name, text in files.items():
        stem, _, ending = name.rpartition("_")
        lowered = program_of_python(text.encode()) if ending in ("py", "cfg") else program_of_cpp(text.encode(), MACROS)
        programs[f"pkg/{stem}.{ending}"] = lowered
    return indexed(programs)


@pytest.fixture(name="index_of")
def index_of_():
    """Index files that are given as ``stem_ending="text"``."""
    return index_of


@pytest.fixture
def units():
    """Return the facts of all units of such files."""
    return lambda **files: facts_of_workspace(index_of(**files))


@pytest.fixture
def node_of(units):
    """Return the facts of a node of ROS 2 whose constructor has this body, and its members."""

    def make(body, members="", before=""):
        text = (
            "#include <rclcpp/rclcpp.hpp>\n#include <std_msgs/msg/string.hpp>\n"
            f'{before}\nclass A : public rclcpp::Node {{ public: A() : Node("a") {{\n{body}\n}}\n{members}\n}};'
        )
        return next(one for one in units(a_cpp=text) if one.unit == "A")

    return make


@pytest.fixture
def main_of(units):
    """Return the facts of a program of ROS 1 whose main function has this body."""

    def make(body, before=""):
        text = (
            "#include <ros/ros.h>\n#include <std_msgs/String.h>\n"
            f'{before}\nint main(int argc, char ** argv) {{ ros::init(argc, argv, "a"); ros::NodeHandle nh;\n{body}\n}}'
        )
        return next(one for one in units(a_cpp=text) if one.unit == "main")

    return make


@pytest.fixture
def names():
    """Return roles and names of endpoints as people read them."""
    return lambda facts: [(one.role.value, str(one.name)) for one in facts.endpoints]
