import pytest

from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.lowering.python.python_program import program_of_python
from roslens.source.extract.units.node_units import facts_of_module


def test_the_name_is_said_by_the_caller(node_of):
    facts = node_of(
        'make("left");\nmake("right");',
        "void make(const std::string & name) { pubs_.push_back(create_publisher<std_msgs::msg::String>(name, 1)); }",
    )
    assert [str(one.name) for one in facts.endpoints] == ["left", "right"]
    assert [one.evidence.line for one in facts.endpoints] == [5, 6]
    assert {place.line for one in facts.endpoints for place in one.through} == {8}


def test_overloads_by_the_number_of_arguments(node_of):
    before = (
        'std::string named(const std::string & a) { return a + "_one"; }\n'
        'std::string named(const std::string & a, const std::string & b) { return a + "_" + b; }'
    )
    body = 'a_ = create_publisher<std_msgs::msg::String>(named("x"), 1);\n'
    body += 'b_ = create_publisher<std_msgs::msg::String>(named("x", "two"), 1);'
    assert [one.name.known for one in node_of(body, before=before).endpoints] in (["x_one", "x_two"], [None, None])


def test_a_text_that_something_unknown_may_set_is_not_empty(node_of):
    body = "std::string topic;\nfill(topic);\npub_ = create_publisher<std_msgs::msg::String>(topic, 1);"
    (one,) = node_of(body).endpoints
    assert str(one.name) == "{a string that fill() may set}"


def test_templates_are_handed_on(node_of):
    members = "template<typename T> void make(const std::string & name) { pub_ = create_publisher<T>(name, 1); }"
    (one,) = node_of('make<std_msgs::msg::String>("a");', members).endpoints
    assert one.type.known == "std_msgs/msg/String"


def test_bound_callbacks(node_of):
    body = (
        'sub_ = create_subscription<std_msgs::msg::String>("in", 1, std::bind(&A::heard, this, std::placeholders::_1));'
    )
    members = (
        'void heard(std_msgs::msg::String::SharedPtr m) { pub_ = create_publisher<std_msgs::msg::String>("out", 1); }'
    )
    facts = node_of(body, members)
    assert [(str(one.name), one.callback) for one in facts.endpoints] == [("in", "A.heard"), ("out", "")]


def test_super_of_python(units, names):
    text = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class Base(Node):
    def __init__(self, name, topic):
        super().__init__(name)
        self.pub = self.create_publisher(String, topic, 10)
class Derived(Base):
    def __init__(self):
        super().__init__('derived', 'chatter')
"""
    found = {one.unit: one for one in units(a_py=text)}
    assert found["Derived"].name.known == "derived"
    assert names(found["Derived"]) == [("publisher", "chatter")]


def test_an_alias_of_a_class_with_its_template_arguments(main_of):
    before = "namespace n { typedef actionlib::SimpleActionServer<demo::GoAction> Server; }\nusing n::Server;"
    (one,) = main_of('auto s = new n::Server(nh, "go", run, false);', before).endpoints
    assert (one.role.value, str(one.name)) == ("action_server", "go")


def test_an_alias_in_the_class_that_uses_it(units):
    text = """
#include <ros/ros.h>
class A { typedef actionlib::SimpleActionServer<demo::GoAction> Server; Server * server_;
public: A() { server_ = new Server(ros::NodeHandle(), "go", run, false); } };
int main(int argc, char ** argv) { ros::init(argc, argv, "a"); A a; }
"""
    facts = next(one for one in units(a_cpp=text) if one.unit == "main")
    assert [(str(one.name), one.type.known) for one in facts.endpoints] == [("go", "demo/GoAction")]


@pytest.mark.parametrize(
    "script",
    ["import pkg.lib\npkg.lib.main([])\n", "from pkg import lib\nlib.main([])\n", "import lib\nlib.main([])\n"],
)
def test_a_function_of_a_module(units, script):
    module = "import rospy\ndef main(words):\n    rospy.Publisher('said', String, queue_size=1)\n"
    found = {one.path: [str(end.name) for end in one.endpoints] for one in units(lib_py=module, run_py=script)}
    assert found["pkg/run.py"] == ["said"]


def test_a_class_of_a_package_that_is_named_like_the_script():
    package = """
import rospy
from std_msgs.msg import String
class Talker:
    def __init__(self):
        self.pub = rospy.Publisher("said", String, queue_size=1)
"""
    script = """
import rospy
import talker
if __name__ == "__main__":
    rospy.init_node("talker")
    talker.Talker()
"""
    texts = {"pkg/scripts/talker": script, "pkg/src/talker/__init__.py": package}
    index = indexed({path: program_of_python(text.encode()) for path, text in texts.items()})
    (found,) = facts_of_module(index, "pkg/scripts/talker")
    assert [(str(one.name), one.evidence.path) for one in found.endpoints] == [("said", "pkg/src/talker/__init__.py")]


@pytest.mark.parametrize("base", ["Own", "lib.Own"])
def test_a_method_of_a_class_that_is_called_with_the_object(units, base):
    module = """
import rclpy
from rclpy.node import Node
from std_msgs.msg import String
class Own(Node):
    def __init__(self):
        self.ready = False
    def start(self, name, topic):
        super().__init__(name)
        self.pub = self.create_publisher(String, topic, 10)
    @staticmethod
    def serve(node, topic):
        node.pub = node.create_publisher(String, topic, 10)
"""
    script = f"""
import lib
from lib import Own
class Talker({base}):
    def __init__(self):
        {base}.__init__(self)
    def main(self):
        {base}.start(self, 'talker', 'said')
        {base}.serve(self, 'served')
        self.create_subscription(String, 'heard', print, 10)
def main():
    Talker().main()
if __name__ == '__main__':
    main()
"""
    found = {one.path: one for one in units(lib_py=module, run_py=script)}["pkg/run.py"]
    assert str(found.name) == "talker"
    assert [str(one.name) for one in found.endpoints] == ["said", "served", "heard"]
