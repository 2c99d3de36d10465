"""How far source is evaluated, and that its end is told."""

import time

import pytest
from pace import turned_s

from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.units.workspace_units import facts_of_workspace
from roslens.source.syntax.macro.macros import load_macros


def facts_of(text):
    program = program_of_cpp(text.encode(), load_macros())
    return facts_of_workspace(indexed({"demo/src/a.cpp": program}))


@pytest.mark.timed
def test_too_many_steps_are_told():
    calls = "\n".join(f"void f{n}() {{ for (auto i : {{1,2,3,4,5,6,7,8}}) {{ f{n + 1}(); }} }}" for n in range(9))
    text = f'#include <ros/ros.h>\n{calls}\nvoid f9() {{ ros::NodeHandle n; n.setParam("a", 1); }}'
    text += '\nint main(int argc, char ** argv) { ros::init(argc, argv, "a"); f0(); }'
    begin = time.process_time()
    (found,) = facts_of(text)
    assert turned_s(begin) < 6
    assert [reason for _, reason in found.unresolved] == [
        "evaluation exceeded its limit of steps; partial results are kept"
    ]
