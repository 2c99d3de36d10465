"""Overloads that are chosen by types."""

import pytest

BEFORE = """
#include <type_traits>
namespace own {
namespace ros {
namespace Images = sensor_msgs::msg;
template <class M>
class Bridge {
 public:
  Bridge(rclcpp::Node * node, std::string topic) : node_(node), topic_(topic) { advertise(1, TAG{}); }
  void advertise(int, std::true_type) {
    auto info = node_->create_publisher<Images::CameraInfo>(topic_ + "/info", 1);
    auto images = node_->create_publisher<Images::Image>(topic_, 1);
  }
  void advertise(int, std::false_type) { node_->create_publisher<M>(topic_, 1); }
  rclcpp::Node * node_;
  std::string topic_;
};
}
namespace bridges = ros;
}
"""
ALL = [("a/info", "CameraInfo"), ("a", "Image")]


@pytest.mark.parametrize(
    ("tag", "message", "expected"),
    [
        ("std::is_same<M, Images::Image>", "sensor_msgs::msg::Image", ALL),
        ("std::is_same<M, Images::Image>", "sensor_msgs::msg::Imu", [("a", "Imu")]),
        ("std::true_type", "sensor_msgs::msg::Imu", ALL),
        ("std::false_type", "sensor_msgs::msg::Imu", [("a", "Imu")]),
        ("std::is_same<M, int>", "sensor_msgs::msg::Imu", [("a", "Imu")]),
    ],
)
@pytest.mark.parametrize("space", ["own::ros", "own::bridges"])
def test_a_tag_chooses_the_overload(node_of, tag, message, expected, space):
    facts = node_of(f'{space}::Bridge<{message}> bridge(this, "a");', before=BEFORE.replace("TAG", tag))
    assert [(str(one.name), str(one.type).rpartition("/")[2]) for one in facts.endpoints] == expected
