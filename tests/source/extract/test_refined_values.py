"""Members that functions set of which only a part is lowered."""

CODE = """
#include <rclcpp/rclcpp.hpp>
class A : public rclcpp::Node {
public:
  A() : Node("a") {
    find_version();
    if (version_ < 14.0) {
      old_ = create_publisher<std_msgs::msg::String>("old", 1);
    } else {
      new_ = create_publisher<std_msgs::msg::String>("new", 1);
    }
    other_ = create_publisher<std_msgs::msg::String>("other", depth_);
  }
  void find_version() {
    for (const auto & one : poll_for_extensions_of_the_device(timeout_of_the_device)) {
      const std::size_t place = one.find("VERSION");
      if (place != std::string::npos) {
        %s
        break;
      }
    }
  }
  float version_ = 0.0;
  int depth_ = 3;
};
"""


def test_a_number_that_is_computed_elsewhere_decides_nothing(units):
    (facts,) = units(a_cpp=CODE % "version_ = std::strtof(one.substr(place).c_str(), nullptr);")
    assert {one.name.known: bool(one.conditions) for one in facts.endpoints} == {
        "old": True, "new": True, "other": False,
    }  # fmt: skip


def test_what_is_not_set_elsewhere_decides(units):
    (facts,) = units(a_cpp=CODE % "const auto version = std::strtof(one.substr(place).c_str(), nullptr);")
    assert [(one.name.known, one.conditions) for one in facts.endpoints] == [("old", ()), ("other", ())]
    assert facts.endpoints[1].qos.depth == 3
