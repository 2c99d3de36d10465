"""Texts that streams of C++ put together, and words that are read from them."""

import pytest

from roslens.source.extract.facts.chosen import Chosen
from roslens.source.extract.units.node_units import facts_of_class, node_classes


def test_a_name_is_put_together_by_a_stream(node_of):
    body = (
        'std::stringstream ss; ss << "robot" << 2 << "/" << declare_parameter("of", "scan");\n'
        "create_publisher<std_msgs::msg::String>(ss.str(), 1);\n"
        'std::ostringstream other("first"); other.str("second"); other.clear(); other << "/x";\n'
        "create_publisher<std_msgs::msg::String>(other.str(), 1);"
    )
    first, second = node_of(body).endpoints
    assert (str(first.name), first.name.usual) == ("robot2/{parameter of}", "robot2/scan")
    assert second.name.known == "second/x"


WORDS = (
    'std::string all; declare_parameter("all", std::string("a b")); get_parameter("all", all);\n'
    "std::stringstream stream(all); std::string one;\n"
    "while (stream >> one) { create_publisher<std_msgs::msg::String>(one, 1); }"
)


def test_a_loop_goes_through_the_words_of_a_text(node_of):
    facts = node_of(WORDS.replace("stream(all)", 'stream("x  y")'))
    assert [one.name.known for one in facts.endpoints] == ["x", "y"]


def test_words_of_an_unknown_text_are_one_for_each(node_of):
    facts = node_of(WORDS)
    assert [str(one.name) for one in facts.endpoints] == ["{each word of {parameter all}}"]
    assert [str(one) for one in facts.asks] == ["{parameter all}"]


@pytest.mark.parametrize(("value", "names"), [("c", ["c"]), (None, ["a", "b"]), ("", [])])
def test_words_that_are_chosen_are_known(index_of, value, names):
    text = f'#include <rclcpp/rclcpp.hpp>\nclass A : public rclcpp::Node {{ public: A() : Node("a") {{ {WORDS} }} }};'
    index = index_of(a_cpp=text)
    (facts,) = facts_of_class(index, *next(node_classes(index)), chosen=Chosen((("", "all", value),)))
    assert [one.name.usual for one in facts.endpoints] == names
    assert all(bool(one.name.holes) is (value is None) for one in facts.endpoints)
