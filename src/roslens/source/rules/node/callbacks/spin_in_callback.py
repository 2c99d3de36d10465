"""Rule ``node.spin_in_callback``: a callback that spins the executor it runs in."""

from __future__ import annotations

from collections.abc import Iterator

from tree_sitter import Node

from roslens.model.finding import Severity
from roslens.source.rules.callbacks import callback_around, spoken
from roslens.source.rules.calls import call_at
from roslens.source.rules.file_view import FileView
from roslens.source.rules.hit import Hit
from roslens.source.rules.rule import ROS_CPP, FileRule


def found(node: Node, view: FileView) -> Iterator[Hit]:
    """Yield a call that spins in a callback; an executor of its own may."""
    call = call_at(node)
    if call is None:
        return
    text = view.text(call.child_by_field_name("function"))
    is_ros2 = text.startswith("rclcpp::")
    if not is_ros2 and text not in ("ros::spin", "ros::spinOnce"):
        return
    callback = callback_around(call, view)
    if callback is not None:
        yield view.hit(
            "node.spin_in_callback",
            call,
            f"`{text}` in {spoken(callback)}, which an executor is running already; expected "
            + ("`async_send_request` with a callback" if is_ros2 else "the callback to return"),
            callback=callback,
            severity=None if is_ros2 else Severity.WARNING,
        )


RULE = FileRule(
    id="node.spin_in_callback",
    title="Spinning in a callback",
    finds="`rclcpp::spin_until_future_complete`, `rclcpp::spin_some`, `rclcpp::spin`, `ros::spinOnce` or `ros::spin` "
    "in a "
    "callback. Give the request a callback of its own instead, or return.",
    why="In ROS 2 the node already belongs to the executor that runs the callback, and adding it to another throws "
    "«Node has already been added to an executor»: the process ends. In ROS 1 callbacks run inside each other, in an "
    "order nobody meant.",
    severity=Severity.ERROR,
    profiles=("ros2", "ros1"),
    tags=("callbacks", "deadlock"),
    bad="""#include <rclcpp/rclcpp.hpp>
void Arm::tick() { rclcpp::spin_until_future_complete(shared_from_this(), client_->async_send_request(r_)); }
void Arm::start() { timer_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }
""",
    good="""#include <rclcpp/rclcpp.hpp>
void Arm::tick() { client_->async_send_request(r_, [this](Client::SharedFuture f) { take(f.get()); }); }
void Arm::start() { timer_ = create_wall_timer(1s, std::bind(&Arm::tick, this)); }
""",
    syntax="cpp",
    anchors=("spin_until_future_complete", "spin_some", "spin", "spinOnce"),
    mentions=ROS_CPP,
    found=found,
)
