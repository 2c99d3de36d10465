import pytest

from roslens.source.extract.facts.launched import Launched, Remap
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.overlays.language.command_words import reads_words, without_ros, words_of
from roslens.source.extract.symbolic.condition import as_written
from roslens.source.extract.symbolic.text import Text, unknown
from roslens.source.extract.units.node_units import facts_of_main, facts_of_module

HERE = Evidence("pkg/a.launch", 3)
WORDS = (Text.of("/bin/a"), Text.of("scan"), Text.of("_rate:=3"), Text.of("out"), Text.of("__name:=n"))
MAIN = """
#include <ros/ros.h>
#include <std_msgs/String.h>
int main(int argc, char ** argv) {
"""
LISTED = "std::vector<std::string> args; ros::removeROSArgs(argc, argv, args);\n"


def launched(*words: str | Text, **others) -> Launched:
    texts = tuple(one if isinstance(one, Text) else Text.of(one) for one in words)
    return Launched(Text.of("pkg"), Text.of("a"), HERE, name=Text.of("n"), arguments=texts, **others)


def test_the_words_that_roslaunch_starts_a_node_with():
    remap = Remap(Text.of("a"), Text.of("b"), HERE)
    found = words_of(launched("scan", "_rate:=3", remaps=(remap,)), "ros1")
    assert [one.pattern for one in found or ()] == ["*", "scan", "_rate:=3", "a:=b", "__name:=n", "__log:=*"]


@pytest.mark.parametrize(
    ("one", "generation"),
    [
        (launched(unknown("argument topic")), "ros2"),
        (launched(unknown("argument topic")), "ros1"),
        (launched("scan", kind="component"), "ros2"),
        (launched("scan", kind="nodelet"), "ros1"),
    ],
)
def test_words_that_are_not_all_known(one, generation):
    assert words_of(one, generation) is None


def test_the_words_that_launch_ros_starts_a_node_with():
    found = words_of(launched("scan", "-r", "out"), "ros2")
    assert [one.pattern for one in found or ()] == ["*", "scan", "-r", "out", "--ros-args"]


def test_words_without_those_of_ros():
    assert [str(one) for one in without_ros(WORDS)] == ["/bin/a", "scan", "out"]


def endpoints(index_of, body, words=WORDS):
    (found,) = facts_of_main(index_of(a_cpp=f"{MAIN}{body}\n}}"), "pkg/a.cpp", words=words)
    return [(str(one.name), as_written(one.conditions)) for one in found.endpoints]


@pytest.mark.parametrize(
    ("body", "told"),
    [
        ("auto p = n.advertise<std_msgs::String>(argv[1], 1);", [("scan", ())]),
        ('std::string t = argv[2]; auto p = n.advertise<std_msgs::String>(t + "_x", 1);', [("out_x", ())]),
        ("if (argc == 3) { auto p = n.advertise<std_msgs::String>(std::string(argv[1]), 1); }", [("scan", ())]),
        ("if (argc == 5) { auto p = n.advertise<std_msgs::String>(argv[1], 1); }", []),
        ('if (!strcmp(argv[1], "scan")) { auto p = n.advertise<std_msgs::String>("a", 1); }', [("a", ())]),
        ('if (!strcmp(argv[1], "other")) { auto p = n.advertise<std_msgs::String>("a", 1); }', []),
        (
            f"{LISTED} if (args.size() > 2) {{ auto p = n.advertise<std_msgs::String>(args[2], 1); }}",
            [("out", ())],
        ),
    ],
)
def test_a_program_of_cpp_with_its_words(index_of, body, told):
    assert endpoints(index_of, f'ros::init(argc, argv, "a"); ros::NodeHandle n;\n{body}') == told


def test_a_list_of_words_before_ros_takes_its_own(index_of):
    body = LISTED + 'ros::init(argc, argv, "a"); ros::NodeHandle n; auto p = n.advertise<std_msgs::String>(args[1], 1);'
    assert endpoints(index_of, body) == [("scan", ())]


def test_a_word_that_nobody_gave_stays_unknown(index_of):
    body = 'ros::init(argc, argv, "a"); ros::NodeHandle n; auto p = n.advertise<std_msgs::String>(argv[3], 1);'
    assert endpoints(index_of, body) == [("{argv[3]}", ())]
    assert endpoints(index_of, body, None) == [("{argv}", ())]


@pytest.mark.parametrize(
    ("body", "told"),
    [
        ("rospy.Publisher(sys.argv[1], String, queue_size=1)", [("scan", ())]),
        ("rospy.Publisher(rospy.myargv()[2], String, queue_size=1)", [("out", ())]),
        ("rospy.Publisher(rospy.myargv(argv=sys.argv)[2], String, queue_size=1)", [("out", ())]),
        ('if len(sys.argv) > 9:\n    rospy.Publisher("a", String, queue_size=1)', []),
        (
            'if len(sys.argv) > 1 and sys.argv[1] == "scan":\n    rospy.Publisher("a", String, queue_size=1)',
            [("a", ())],
        ),
        ('if argv[1] == "--no":\n    rospy.Publisher("a", String, queue_size=1)', []),
    ],
)
def test_a_program_of_python_with_its_words(index_of, body, told):
    text = "import sys\nimport rospy\nfrom sys import argv\nfrom std_msgs.msg import String\nrospy.init_node('a')\n"
    (found,) = facts_of_module(index_of(a_py=text + body), "pkg/a.py", words=WORDS)
    assert [(str(one.name), as_written(one.conditions)) for one in found.endpoints] == told


@pytest.mark.parametrize(
    ("text", "reads"),
    [
        (f'{MAIN}ros::init(argc, argv, "a"); }}', False),
        (f'{MAIN}ros::init(argc, argv, "a"); f(argv[1]); }}', True),
        (f'{MAIN}ros::init(argc, argv, "a"); if (argc > 1) f(); }}', True),
    ],
)
def test_programs_that_read_their_words(index_of, text, reads):
    assert reads_words(index_of(a_cpp=text).programs["pkg/a.cpp"]) is reads


def test_a_script_that_reads_its_words(index_of):
    assert reads_words(index_of(a_py="import sys\nf(sys.argv[1])").programs["pkg/a.py"])
    assert not reads_words(index_of(a_py="import sys\nf(sys.path)").programs["pkg/a.py"])


ROS2 = tuple(Text.of(one) for one in ("/bin/a", "scan", "--rate", "3", "--ros-args"))
MAIN2 = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
int main(int argc, char ** argv) {
"""


@pytest.mark.parametrize(
    ("before", "topic", "name"),
    [
        ("rclcpp::init(argc, argv);", "argv[1]", "scan"),
        ("auto args = rclcpp::init_and_remove_ros_arguments(argc, argv);", "args[1]", "scan"),
        ("auto args = rclcpp::remove_ros_arguments(argc, argv);", "args[argc > 2 ? 1 : 2]", "scan"),
        ('std::string t = rcutils_cli_get_option(argv, argv + argc, "--rate");', 't + "_x"', "3_x"),
        ('std::string t = "no"; if (rcutils_cli_option_exist(argv, argv + argc, "--no")) { t = "yes"; }', "t", "no"),
        ('std::string t = "no"; if (rcutils_cli_option_exist(argv, argv + argc, "--rate")) { t = "yes"; }', "t", "yes"),
    ],
)
def test_a_program_of_rclcpp_with_its_words(index_of, before, topic, name):
    body = f'{before}\nrclcpp::Node n("a"); auto p = n.create_publisher<std_msgs::msg::String>({topic}, 1);'
    (found,) = facts_of_main(index_of(a_cpp=f"{MAIN2}{body}\n}}"), "pkg/a.cpp", words=ROS2)
    assert [(str(one.name), as_written(one.conditions)) for one in found.endpoints] == [(name, ())]


PYTHON2 = """
import sys
import rclpy
from rclpy.utilities import remove_ros_args
from std_msgs.msg import String
def main(args=sys.argv[1:]):
    rclpy.init(args=args)
    node = rclpy.create_node('a')
"""


@pytest.mark.parametrize(
    ("line", "told"),
    [
        ("node.create_publisher(String, sys.argv[1], 1)", [("scan", ())]),
        ("node.create_publisher(String, args[0], 1)", [("scan", ())]),
        ("node.create_publisher(String, remove_ros_args(args)[-1], 1)", [("3", ())]),
        ("node.create_publisher(String, remove_ros_args()[1:][0], 1)", [("scan", ())]),
        ("if len(sys.argv) > 3: node.create_publisher(String, 'a', 1)", [("a", ())]),
        ("if len(sys.argv) < 2: node.create_publisher(String, 'a', 1)", []),
        ("if len(remove_ros_args()) == 4: node.create_publisher(String, 'a', 1)", [("a", ())]),
    ],
)
def test_a_program_of_rclpy_with_its_words(index_of, line, told):
    index = index_of(a_py=f"{PYTHON2}    {line}\n    node.create_timer(1, main)\n")
    (found,) = facts_of_module(index, "pkg/a.py", "main", words=ROS2)
    assert [(str(one.name), as_written(one.conditions)) for one in found.endpoints] == told


@pytest.mark.parametrize("line", ["sys.argv[-1]", "sys.argv[7]", "sys.argv[1:-1][0]", "args[9]"])
def test_words_behind_those_that_are_known_are_not(index_of, line):
    text = f"{PYTHON2}    node.create_publisher(String, {line}, 1)\n"
    (found,) = facts_of_module(index_of(a_py=text), "pkg/a.py", "main", words=ROS2)
    assert [one.name.known for one in found.endpoints] == [None]


def test_how_many_words_there_are_may_be_unknown(index_of):
    text = f"{PYTHON2}    if len(sys.argv) == 8: node.create_publisher(String, 'a', 1)\n"
    (found,) = facts_of_module(index_of(a_py=text), "pkg/a.py", "main", words=ROS2)
    assert [bool(one.conditions) for one in found.endpoints] == [True]


@pytest.mark.parametrize(
    ("text", "reads"),
    [
        (f"{MAIN2}rclcpp::init(argc, argv); }}", False),
        (f"{MAIN2}rclcpp::init(argc, argv); f(argv[1]); }}", True),
    ],
)
def test_programs_of_rclcpp_that_read_their_words(index_of, text, reads):
    assert reads_words(index_of(a_cpp=text).programs["pkg/a.cpp"]) is reads


@pytest.mark.parametrize(
    ("text", "reads"),
    [
        ("import sys, rclpy\nrclpy.init(args=sys.argv)", False),
        ("import sys\ndef main(args=sys.argv[1:]):\n    pass", True),
        ("def main():\n    parser.parse_args()", True),
    ],
)
def test_scripts_of_rclpy_that_read_their_words(index_of, text, reads):
    assert reads_words(index_of(a_py=text).programs["pkg/a.py"]) is reads
