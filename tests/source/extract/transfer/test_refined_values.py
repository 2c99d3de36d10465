"""Members that functions set of which only a part is lowered."""

from roslens.source.extract.symbolic.condition import as_written

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
    assert [(one.name.known, as_written(one.conditions)) for one in facts.endpoints] == [
        ("old", ()),
        ("other", ()),
    ]
    assert facts.endpoints[1].qos.depth == 3


def test_a_number_that_a_function_may_set_for_its_caller_where_it_was_left_out_is_not_known(node_of):
    computes = "double sum = 0; for (int i = 0; i < 10; ++i) { sum += i * 2.0; } double mean = sum / 10.0; " * 3
    facts = node_of(
        "timer_ = create_wall_timer(std::chrono::seconds(1), [this]() { process(); });",
        f"bool at(const double & known, double & limit) {{ {computes} limit = mean + known; return sum > 1; }}\n"
        "void process() { auto made = std::make_unique<std_msgs::msg::String>(); if (!at(known_, limit_)) { return; }\n"
        'if (limit_ != before_) { out_ = create_publisher<std_msgs::msg::String>("limit", 1); }\n'
        'if (known_ != 2) { no_ = create_publisher<std_msgs::msg::String>("never", 1); } }\n'
        "double limit_ = 100; double before_ = 100; int known_ = 2; rclcpp::TimerBase::SharedPtr timer_;\n"
        "rclcpp::Publisher<std_msgs::msg::String>::SharedPtr out_, no_;",
    )
    assert [str(one.name) for one in facts.endpoints] == ["limit"]
