import pytest

from roslens.source.extract.command_words import reads_words, without_ros, words_of
from roslens.source.extract.launched import Launched, Remap
from roslens.source.extract.node_facts import Evidence
from roslens.source.extract.node_units import facts_of_main, facts_of_module
from roslens.source.extract.text import Text, unknown

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
        (launched("scan"), "ros2"),
        (launched(unknown("argument topic")), "ros1"),
        (launched("scan", kind="nodelet"), "ros1"),
    ],
)
def test_words_that_are_not_all_known(one, generation):
    assert words_of(one, generation) is None


def test_words_without_those_of_ros():
    assert [str(one) for one in without_ros(WORDS)] == ["/bin/a", "scan", "out"]


def endpoints(index_of, body, words=WORDS):
    (found,) = facts_of_main(index_of(a_cpp=f"{MAIN}{body}\n}}"), "pkg/a.cpp", words=words)
    return [(str(one.name), one.conditions) for one in found.endpoints]


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
    assert [(str(one.name), one.conditions) for one in found.endpoints] == told


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
