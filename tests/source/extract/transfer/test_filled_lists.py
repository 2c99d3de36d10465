import pytest

from roslens.source.extract.symbolic.text import Hole, Text
from roslens.source.extract.units.node_units import facts_of_main

SUBSCRIBE = "for (size_t i = 0; i < found.size(); i++) nh.subscribe<std_msgs::String>(found[i], 1, got);"
FILL = "for (int i = 1; i < argc; i++) found.push_back(argv[i]);"


@pytest.fixture
def names(index_of):
    """Return the names of what a program makes that is started with two words."""

    def make(body, before=""):
        text = f"""
#include <ros/ros.h>
#include <std_msgs/String.h>
void got(const std_msgs::String &) {{}}
{before}
int main(int argc, char ** argv) {{ ros::init(argc, argv, "a"); ros::NodeHandle nh;
{body}
}}"""
        words = (Text((Hole("path"),)), Text.of("one"), Text.of("two"))
        (facts,) = facts_of_main(index_of(a_cpp=text), "pkg/a.cpp", words=words)
        return [str(one.name) for one in facts.endpoints]

    return make


@pytest.mark.parametrize("kind", ["std::vector<std::string>", "vector<string>"])
def test_a_list_of_the_words_of_the_command_line(names, kind):
    assert names(f"{kind} found; {FILL} {SUBSCRIBE}", "using namespace std;") == ["one", "two"]


@pytest.mark.parametrize(
    "body",
    [
        # Who is given the list may put more into it.
        f"std::vector<std::string> found; {FILL} more(found); {SUBSCRIBE}",
        f"std::vector<std::string> found; {FILL} auto f = [&]() {{ found.push_back(name()); }}; f(); {SUBSCRIBE}",
        f"std::vector<std::string> found = all(); {FILL} {SUBSCRIBE}",
        f"std::vector<std::string> found; {FILL} found = all(); {SUBSCRIBE}",
        f"std::vector<std::string> found; {FILL} found.insert(found.end(), all()); {SUBSCRIBE}",
        # What is there may hang on a condition, or on what nobody knows.
        f'std::vector<std::string> found; {FILL} if (argv[1][0] == name()) found.push_back("b"); {SUBSCRIBE}',
        f"std::vector<std::string> found; {FILL} found.push_back(name()); {SUBSCRIBE}",
        f"std::vector<std::string> found; {SUBSCRIBE}",
    ],
)
def test_a_list_that_may_hold_others_is_unknown(names, body):
    (one,) = names(body)
    assert one.startswith("{")


def test_a_list_of_others_is_unknown(names):
    before = f"void make(std::vector<std::string> & found) {{ ros::NodeHandle nh; {SUBSCRIBE} }}"
    assert names(f"std::vector<std::string> found; {FILL} make(found);", before) == ["{found[i]}"]
