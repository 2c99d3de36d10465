import pytest

BEFORE = "#include <realtime_tools/realtime_publisher.h>\n"
WHOLE = "realtime_tools::RealtimePublisher<std_msgs::String>"


def ends(facts):
    return [(str(one.name), one.type.known, one.queue, one.latched, len(one.sites)) for one in facts.endpoints]


@pytest.mark.parametrize(
    ("body", "told"),
    [
        (f'{WHOLE} p(nh, "a", 4); p.unlockAndPublish();', ("a", "std_msgs/String", 4, False, 1)),
        (f'auto p = new {WHOLE}(nh, "a", 4, true);', ("a", "std_msgs/String", 4, True, 0)),
        (f'auto p = std::make_shared<{WHOLE}>(nh, "a", 4);', ("a", "std_msgs/String", 4, False, 0)),
        (f'boost::scoped_ptr<{WHOLE}> p; p.reset(new {WHOLE}(nh, "a", 4));', ("a", "std_msgs/String", 4, False, 0)),
        (f'{WHOLE} p; p.init(nh, "a", 4); p.unlockAndPublish();', ("a", "std_msgs/String", 4, False, 1)),
        (f'typedef {WHOLE} P; P p(nh, "a", 4);', ("a", "std_msgs/String", 4, False, 0)),
        (f'ros::NodeHandle q("~"); {WHOLE} p(q, "a", 4);', ("~/a", "std_msgs/String", 4, False, 0)),
    ],
)
def test_of_ros_1_makes_its_publisher(main_of, body, told):
    assert ends(main_of(body, BEFORE)) == [told]


def test_of_ros_2_is_given_one(node_of):
    facts = node_of(
        'p_ = create_publisher<std_msgs::msg::String>("a", 1);'
        "r_ = std::make_unique<realtime_tools::RealtimePublisher<std_msgs::msg::String>>(p_); r_->unlockAndPublish();"
    )
    assert [(name, kind, sites) for name, kind, _, _, sites in ends(facts)] == [("a", "std_msgs/msg/String", 1)]


def test_one_that_nothing_is_made_of(main_of):
    assert ends(main_of(f"{WHOLE} p; p.unlockAndPublish();", BEFORE)) == []
