from roslens.model.graph import Role
from roslens.model.source import Language
from roslens.source.extract.facts.node_facts import EndpointFact, Evidence, NodeFacts
from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.symbolic.reason import OfParameter
from roslens.source.extract.symbolic.text import Text, unknown
from roslens.source.extract.units.assemble_program import classes_made, joined_facts
from roslens.source.extract.units.node_units import node_classes
from roslens.source.parsed_file import parse_file
from roslens.source.settings import MacroSettings

CODE = b"""
#include <rclcpp/rclcpp.hpp>
namespace robot {
class Talker : public rclcpp::Node { public: Talker() : rclcpp::Node("talker") {} };
class Message {};
}
int main(int argc, char ** argv) {
  auto message = std::make_shared<robot::Message>();
  rclcpp::spin(std::make_shared<robot::Talker>());
}
"""


def end(line: int, name: Text) -> EndpointFact:
    return EndpointFact(Role.PUBLISHER, name, Text.of("std_msgs/msg/String"), Evidence("a.cpp", line))


def test_the_classes_that_a_main_function_makes_are_those_that_are_nodes():
    index = indexed({"a.cpp": parse_file(CODE, Language.CPP, MacroSettings()).program()})
    nodes = [one for one, _, _ in node_classes(index)]
    assert list(classes_made(index, "a.cpp", nodes)) == ["robot.Talker"]


def test_main_knows_arguments_and_the_class_what_happens_later():
    main = NodeFacts("main", "a.cpp", 9, "ros2", name=Text.of("given"), endpoints=(end(3, Text.of("said")),))
    of_class = NodeFacts(
        "robot.Talker", "a.cpp", 4, "ros2", "lifecycle", name=unknown(OfParameter("name")),
        endpoints=(end(3, unknown(OfParameter("topic"))), end(5, Text.of("later"))),
    )  # fmt: skip
    both = joined_facts(main, of_class)
    assert (both.unit, both.kind, both.name.known) == ("robot.Talker", "lifecycle", "given")
    assert [one.name.known for one in both.endpoints] == ["said", "later"]
    assert joined_facts(None, of_class) == of_class


def test_a_name_that_main_does_not_know_is_that_of_the_class():
    main = NodeFacts("main", "a.cpp", 9, "ros2")
    of_class = NodeFacts("robot.Talker", "a.cpp", 4, "ros2", name=Text.of("talker"))
    assert joined_facts(main, of_class).name.known == "talker"


def test_a_name_of_which_main_knows_nothing_is_that_of_the_class():
    main = NodeFacts(
        "main", "a.cpp", 9, "ros2", endpoints=(end(3, unknown("an argument")), end(7, unknown("an argument")))
    )
    of_class = NodeFacts("robot.Talker", "a.cpp", 4, "ros2", endpoints=(end(3, unknown("t", parameter="t")),))
    assert [one.name.holes[0].parameter for one in joined_facts(main, of_class).endpoints] == ["", "t"]
