"""Namespaces and modules that are used whole: what an unqualified class of a library means."""

import pytest

SPACES = "using namespace actionlib;\nusing namespace interactive_markers;\n"
HEADERS = "#include <ros/ros.h>\n#include <actionlib/client/simple_action_client.h>\n"
MAIN = 'int main(int argc, char ** argv) {{ ros::init(argc, argv, "a"); ros::NodeHandle nh; {} }}'
MADE = (
    'SimpleActionClient<p::DoAction> c("do", true); SimpleActionServer<p::DoAction> s(nh, "serve", false);'
    'InteractiveMarkerServer m("marks");'
)
TOLD = [
    ("action_client", "do"),
    ("action_server", "serve"),
    ("publisher", "marks/update_full"),
    ("publisher", "marks/update"),
    ("subscription", "marks/feedback"),
]


def test_a_namespace_that_the_file_uses(units, names):
    (facts,) = units(a_cpp=HEADERS + SPACES + MAIN.format(MADE))
    assert names(facts) == TOLD
    assert facts.endpoints[0].type.known == "p/DoAction"


def test_a_namespace_that_an_included_header_uses(units, names):
    (facts,) = units(b_h=HEADERS + SPACES, a_cpp='#include "b.h"\n' + MAIN.format(MADE))
    assert names(facts) == TOLD


def test_a_header_that_is_not_included_says_nothing(units):
    (facts,) = units(b_h=HEADERS + SPACES, a_cpp=HEADERS + MAIN.format(MADE))
    assert not facts.endpoints


def test_members_and_pointers_of_a_class(units, names):
    text = """
class C { public: C(ros::NodeHandle & nh) : c_("do", true) { m_.reset(new InteractiveMarkerServer("marks")); }
  SimpleActionClient<p::DoAction> c_; boost::shared_ptr<InteractiveMarkerServer> m_; };
"""
    (facts,) = units(a_cpp=HEADERS + SPACES + text + MAIN.format("C c(nh);"))
    assert names(facts) == [TOLD[0], *TOLD[2:]]


def test_a_class_of_the_workspace_comes_first(units):
    text = HEADERS + SPACES + "struct InteractiveMarkerServer { explicit InteractiveMarkerServer(std::string) {} };\n"
    (facts,) = units(a_cpp=text + MAIN.format('InteractiveMarkerServer m("marks");'))
    assert not facts.endpoints


@pytest.mark.parametrize("import_", ["from rospy import *\nfrom std_msgs.msg import String", "from shared import *"])
def test_a_module_that_is_imported_whole(units, names, import_):
    shared = "from rospy import *\nfrom std_msgs.msg import String\n"
    text = f'{import_}\ninit_node("a")\np = Publisher("p", String, queue_size=1)\nspin()\n'
    found = [one for one in units(shared_py=shared, a_py=text) if one.path == "pkg/a.py"]
    assert names(found[0]) == [("publisher", "p")]
