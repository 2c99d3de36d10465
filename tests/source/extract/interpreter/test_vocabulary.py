from roslens.source.extract.domain.abstract_value import Handle, NodeBuilder, Obj, Unknown
from roslens.source.extract.facts.node_facts import Evidence
from roslens.source.extract.interpreter.interpreter import Interpreter
from roslens.source.extract.interpreter.vocabulary import CallSite, below, find_outer, known_names
from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.symbolic.text import Text

NODE = NodeBuilder("A", "a.cpp", 1, "ros1")


def called(arguments, keywords):
    return CallSite("f", arguments, keywords, (), (), Evidence("a.cpp", 1))


def test_arguments_by_name_or_place():
    one = called([1, 2], {"c": 3})
    assert [one.argument(0, "a"), one.argument(1), one.argument(2, "c"), one.argument(5)] == [1, 2, 3, None]
    assert one.argument(5, default=7) == 7


def test_words_are_found_by_whole_names():
    assert {"ros.init", "rclcpp.Node", "tf2_ros.TransformListener", "BT.InputPort"} <= known_names()
    engine = Interpreter(indexed({}), NODE)
    assert find_outer(engine, "rclcpp.Node") is not None
    assert find_outer(engine, "my.Node") is None


def test_names_below_a_handle():
    handle = Handle(NODE, Text.of("~"))
    assert [str(below(handle, Text.of(name))) for name in ("a", "/a", "~a")] == ["~/a", "/a", "~a"]
    assert below(Handle(NODE), Text.of("a")) == below(Obj("T"), Text.of("a")) == below(Unknown("x"), Text.of("a"))


def test_what_is_known_is_meant_where_its_source_is_in_the_workspace(units):
    library = """
namespace ros {
class NodeHandle { public: template<class M> Publisher advertise(const std::string & t, int q) { return make(t); } };
}
"""
    program = """
#include <ros/ros.h>
#include <std_msgs/String.h>
int main(int argc, char ** argv) { ros::init(argc, argv, "a"); ros::NodeHandle n("~");
  ros::Publisher p = n.advertise<std_msgs::String>("out", 1); }
"""
    (facts,) = units(lib_cpp=library, main_cpp=program)
    assert [str(one.name) for one in facts.endpoints] == ["~/out"]
