import pytest

SERVER = "SimpleActionServer<nav2_msgs::action::Wait>"


def ends(facts):
    return [(one.role.value, str(one.name), one.type.known) for one in facts.endpoints]


@pytest.mark.parametrize(
    ("body", "told"),
    [
        (
            'c_ = std::make_shared<nav2_util::ServiceClient<nav2_msgs::srv::LoadMap>>("map/load", shared_from_this());',
            ("service_client", "map/load", "nav2_msgs/srv/LoadMap"),
        ),
        (
            'c_ = std::make_unique<nav2_util::ServiceClient<std_srvs::srv::Empty>>("clear", this);',
            ("service_client", "clear", "std_srvs/srv/Empty"),
        ),
        (
            f's_ = std::make_unique<nav2_util::{SERVER}>(shared_from_this(), "wait", [this]() {{ again(); }});',
            ("action_server", "wait", "nav2_msgs/action/Wait"),
        ),
        (
            f's_ = std::make_unique<nav2_ros_common::{SERVER}>(shared_from_this(), "wait", std::bind(&N::run, this));',
            ("action_server", "wait", "nav2_msgs/action/Wait"),
        ),
    ],
)
def test_what_nodes_of_navigation_hold(node_of, body, told):
    assert ends(node_of(body)) == [told]
