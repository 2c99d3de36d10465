"""Names that a program of Python takes from its command line by argparse, held against argparse itself."""

import argparse

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.text import Text
from roslens.source.extract.units.node_units import facts_of_module

BEFORE = """
import argparse
import sys
import rclpy
from rclpy.utilities import remove_ros_args
from std_msgs.msg import String
def main():
    rclpy.init()
    node = rclpy.create_node('a')
    parser = argparse.ArgumentParser()
"""


def names(index_of, lines, words):
    text = BEFORE + "".join(f"    {line}\n" for line in lines)
    given_ = None if words is None else tuple(Text.of(one) for one in ("/bin/a", *words.split(), "--ros-args"))
    found = facts_of_module(index_of(a_py=text), "pkg/a.py", "main", words=given_)
    return [(str(one.name), as_written(one.conditions)) for facts in found for one in facts.endpoints]


PARSE = "args = parser.parse_args(remove_ros_args()[1:])"
PUBLISH = "node.create_publisher(String, f'{args.topic}', 1)"
TOPIC = "parser.add_argument('--topic', '-t', default='scan', help='where to')"


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ("--topic odom", "odom"),
        ("--topic=odom", "odom"),
        ("-t odom", "odom"),
        ("-todom", "odom"),
        ("--to odom", "odom"),
        ("", "scan"),
        (None, "{argument --topic}"),
        ("--other odom", "{argument --topic}"),
        ("--topic", "{argument --topic}"),
        ("odom", "{argument --topic}"),
    ],
)
def test_an_option(index_of, words, found):
    assert names(index_of, (TOPIC, PARSE, PUBLISH), words) == [(found, ())]


@pytest.mark.parametrize(
    ("argument", "words", "found"),
    [
        ("'topic'", "odom", ["odom"]),
        ("'topic', nargs='?', default='scan'", "", ["scan"]),
        ("'topic', nargs='?', default='scan'", "odom", ["odom"]),
        ("'-n', '--number', dest='topic', type=int, default=3", "-n 4", ["4"]),
        ("'-n', '--number', dest='topic', type=int, default=3", "", ["3"]),
        ("'-n', '--number', dest='topic', type=int", "-n four", ["{argument -n}"]),
        ("'--topic', type=named", "--topic a", ["{argument --topic}"]),
    ],
)
def test_other_arguments(index_of, argument, words, found):
    lines = (f"parser.add_argument({argument})", PARSE, PUBLISH)
    assert [name for name, _ in names(index_of, lines, words)] == found


def test_a_list_of_topics(index_of):
    lines = ("parser.add_argument('topics', nargs='+')", PARSE, "for one in args.topics:",
             "    node.create_publisher(String, one, 1)")  # fmt: skip
    assert names(index_of, lines, "a b") == [("a", ()), ("b", ())]
    assert [name for name, _ in names(index_of, lines, None)] == ["{each of argument topics}"]


@pytest.mark.parametrize(("words", "found"), [("--loud", [("x", ())]), ("", [])])
def test_a_switch(index_of, words, found):
    lines = ("parser.add_argument('--loud', action='store_true')", PARSE, "if args.loud:",
             "    node.create_publisher(String, 'x', 1)")  # fmt: skip
    assert names(index_of, lines, words) == found
    assert [bool(conditions) for _, conditions in names(index_of, lines, None)] == [True]


def test_words_that_are_left_over(index_of):
    lines = (TOPIC, "args, more = parser.parse_known_args()", PUBLISH)
    assert names(index_of, lines, "--topic odom") == [("odom", ())]
    assert names(index_of, (TOPIC, "args = parser.parse_args()", PUBLISH), "-t odom") == [("{argument --topic}", ())]


@pytest.mark.parametrize(
    "line",
    ["parser.add_subparsers()", "parser.add_argument(name())", "if ask(): parser.add_argument('--more')"],
)
def test_a_parser_that_is_not_followed(index_of, line):
    assert names(index_of, (TOPIC, line, PARSE, PUBLISH), "--topic odom")[0][0] == "{argument --topic}"


def test_groups_and_defaults(index_of):
    lines = ("group = parser.add_argument_group('a')", "group.add_argument('--topic')",
             "parser.set_defaults(space='left')", PARSE,
             "node.create_publisher(String, args.space + '/' + args.topic, 1)")  # fmt: skip
    assert names(index_of, lines, "--topic odom") == [("left/odom", ())]


@given(
    st.lists(
        st.sampled_from(["--topic", "--topic=a", "-t", "-tb", "c", "--loud", "-l", "3", "-3", "--", "-x"]), max_size=5
    )
)
def test_what_is_known_is_what_argparse_says(words):
    check(words)


@pytest.mark.parametrize(
    "words",
    [
        [],
        ["c"],
        ["--topic", "d", "c"],
        ["c", "-td"],
        ["--loud", "c"],
        ["-l", "-t", "3", "c"],
        ["--loud"],
        ["c", "d"],
        ["-x"],
    ],
)
def test_what_argparse_says(words):
    check(words)


def check(words):
    from roslens.source.extract.overlays.language.vocabulary_argparse import LostError, Option, values_of

    parser = argparse.ArgumentParser(exit_on_error=False)
    parser.add_argument("--topic", "-t", default="scan")
    parser.add_argument("--loud", "-l", action="store_true")
    parser.add_argument("name")
    options = [Option(("--topic", "-t"), "topic", Text.of("scan")),
               Option(("--loud", "-l"), "loud", False, action="store_true"), Option((), "name")]  # fmt: skip
    try:
        found = values_of(options, [Text.of(one) for one in words], rest=False)
    except LostError:
        return
    try:
        right = vars(parser.parse_args(words))
    except (argparse.ArgumentError, SystemExit):
        return
    assert {name: one.known if isinstance(one, Text) else one for name, one in found.items()} == right


def test_what_a_command_of_the_command_line_does_is_followed(units):
    text = """
import argparse
import rospy
from std_srvs.srv import Trigger
def arm(args):
    rospy.ServiceProxy('arm', Trigger)
def main():
    parser = argparse.ArgumentParser()
    commands = parser.add_subparsers()
    one = commands.add_parser('arm')
    one.set_defaults(func=arm)
    args = parser.parse_args(rospy.myargv()[1:])
    rospy.init_node('tool')
    args.func(args)
if __name__ == '__main__':
    main()
"""
    (facts,) = units(a_py=text)
    assert [(str(one.name), as_written(one.conditions)) for one in facts.endpoints] == [
        ("arm", ("the command line requests it",))
    ]
