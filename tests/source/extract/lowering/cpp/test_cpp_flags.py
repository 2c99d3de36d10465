"""Flags of a file that functions set of which not all is lowered."""

import time

from pace import slowness

from roslens.source.extract.ir.program import Assign, Literal, Opaque
from roslens.source.extract.lowering.cpp.cpp_flags import _SET
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.syntax.macro.macros import load_macros

COMPUTES = (
    "  double sum = 0; for (int i = 0; i < 10; ++i) { sum += i * i; } double mean = sum / 10; double last = mean * 2;\n"
)
CALLBACK = """
#include <ros/ros.h>
static int map_loaded = 0;
static bool set = false;
static int seen = 0, never = 0;
static double offset = 0.5;
void loaded(const Message& message)
{
%s  map_loaded = 1; ++seen; offset = mean; if (never == 1) { last = never; }
}
void received(const Message& message)
{
  static ros::NodeHandle nh;
  if (map_loaded == 1) { static ros::Publisher out = nh.advertise<std_msgs::Bool>("pose", 1); }
  if (never == 1) { static ros::Publisher no = nh.advertise<std_msgs::Bool>("no", 1); }
}
int main(int argc, char** argv)
{
  ros::init(argc, argv, "a");
  ros::NodeHandle nh;
  ros::Subscriber one = nh.subscribe("map", 1, loaded), two = nh.subscribe("points", 1, received);
  ros::spin();
}
"""


def values(text):
    body = program_of_cpp(text.encode(), load_macros()).body
    return {one.target.name: one.value for one in body if isinstance(one, Assign)}


def test_what_a_part_that_is_left_out_sets_is_no_constant():
    found = values(CALLBACK % COMPUTES)
    assert isinstance(found["map_loaded"], Opaque)
    assert isinstance(found["seen"], Opaque)
    assert found["never"] == Literal(0)


def test_what_no_part_that_is_left_out_sets_stays():
    found = values((CALLBACK % "").replace("++seen;", ""))
    assert found["map_loaded"] == found["seen"] == Literal(0)


def test_endpoints_behind_such_a_flag_are_not_lost(units):
    (facts,) = units(a_cpp=CALLBACK % COMPUTES)
    assert sorted(str(one.name) for one in facts.endpoints) == ["map", "points", "pose"]
    (pose,) = (one for one in facts.endpoints if str(one.name) == "pose")
    assert as_written(pose.conditions) == ("map_loaded == 1",)


def test_a_long_word_is_read_once():
    source = b"static int flag = 0;\n" + b"a" * 200_000
    begun = time.process_time()
    assert _SET.findall(source) == [b"flag"]
    assert time.process_time() - begun < 1 * slowness()
