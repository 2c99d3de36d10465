"""image_transport of both generations."""

import pytest

from roslens.model.qos import Qos
from roslens.source.extract.symbolic.reason import NamePart, OfNode

IMAGES = "#include <image_transport/image_transport.hpp>\n#include <image_transport/subscriber_filter.hpp>"


def told(facts):
    return [(one.role.value, str(one.name), str(one.type).rpartition("/")[2]) for one in facts.endpoints]


def test_a_filtered_subscription_is_made_when_it_is_told_to(node_of):
    body = (
        "auto base = get_node_base_interface();\n"
        'std::string topic = base->resolve_topic_or_service_name("a/raw", false);\n'
        'sub_.subscribe(this, topic, "raw");\n'
        "info_.subscribe(this, base->resolve_topic_or_service_name(image_transport::getCameraInfoTopic(topic), false));"
    )
    members = (
        "image_transport::SubscriberFilter sub_;\nmessage_filters::Subscriber<sensor_msgs::msg::CameraInfo> info_;"
    )
    assert told(node_of(body, members, IMAGES)) == [
        ("subscription", "{namespace of the node}/a/raw", "Image"),
        ("subscription", "{namespace of the node}/a/camera_info", "CameraInfo"),
    ]


def test_what_is_filtered_may_be_made_at_once(main_of):
    body = 'image_transport::ImageTransport it(nh); image_transport::SubscriberFilter sub(it, "image", 1);'
    assert told(main_of(body, "#include <image_transport/subscriber_filter.h>")) == [("subscription", "image", "Image")]


def test_what_is_known_of_a_camera_is_beside_its_images(node_of):
    body = (
        'auto pub = image_transport::create_camera_publisher(this, "left/image");\n'
        'std::string own = "left/" + declare_parameter("image", "raw");\n'
        "auto other = image_transport::create_camera_publisher(this, own);"
    )
    assert told(node_of(body, "", IMAGES)) == [
        ("publisher", "left/image", "Image"),
        ("publisher", "left/camera_info", "CameraInfo"),
        ("publisher", "left/{parameter image}", "Image"),
        ("publisher", "{the topic next to that of the image}", "CameraInfo"),
    ]


def test_constructors_with_a_node_and_a_topic_make_endpoints_in_ros2(node_of):
    members = (
        'image_transport::CameraSubscriber camera_{this, "a", [](auto, auto) {},\n'
        "#ifdef QOS\nrclcpp::QoS{rclcpp::QoSInitialization::from_rmw(\n#endif\n"
        'profiles.at("default")\n#ifdef QOS\n)}\n#endif\n};\n'
        "image_transport::Subscriber sub_; image_transport::Publisher pub_; image_transport::CameraPublisher cam_;"
    )
    body = (
        'std::function<void()> f; sub_ = image_transport::Subscriber(this, "b", f, "raw", rmw_qos_profile_default);\n'
        'pub_ = image_transport::Publisher(this, "c", rmw_qos_profile_default);\n'
        'cam_ = image_transport::CameraPublisher(this, "d");'
    )
    assert told(node_of(body, members, IMAGES)) == [
        ("subscription", "a", "Image"),
        ("subscription", "camera_info", "CameraInfo"),
        ("subscription", "b", "Image"),
        ("publisher", "c", "Image"),
        ("publisher", "d", "Image"),
        ("publisher", "camera_info", "CameraInfo"),
    ]


def test_callbacks_that_options_hold_are_followed(node_of, names):
    body = (
        "rclcpp::PublisherOptions options;\n"
        "options.event_callbacks.matched_callback = [this](rclcpp::MatchedInfo & s) {"
        ' if (s.current_count) { sub_ = create_subscription<std_msgs::msg::String>("in", 1, nullptr); } };\n'
        'pub_ = create_publisher<std_msgs::msg::String>("out", 1, options);'
    )
    assert sorted(names(node_of(body))) == [("publisher", "out"), ("subscription", "in")]


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ('base->resolve_topic_or_service_name("/a", false)', "/a"),
        ('base->resolve_topic_or_service_name("~/a", false)', "{full name of the node}/a"),
        ('rclcpp::expand_topic_or_service_name("a", get_name(), get_namespace())', "{namespace of the node}/a"),
        ('rclcpp::expand_topic_or_service_name("a", "b", "c")', "{an expanded name}"),
    ],
)
def test_names_that_code_resolves_itself(node_of, call, expected):
    body = f"auto base = get_node_base_interface();\ncreate_publisher<std_msgs::msg::String>({call}, 1);"
    assert [str(one.name) for one in node_of(body).endpoints] == [expected]


def test_a_relative_name_that_a_parameter_decides_is_below_the_namespace(node_of):
    body = (
        'auto topic = get_node_base_interface()->resolve_topic_or_service_name(declare_parameter("of", "a"), false);\n'
        "create_publisher<std_msgs::msg::String>(topic, 1);"
    )
    ((hole,),) = (one.name.parts for one in node_of(body).endpoints)
    assert (hole.parameter, hole.below) == ("of", OfNode(NamePart.NAMESPACE))


def test_what_is_known_of_a_camera_is_set_by_a_service(node_of, main_of):
    kind = "camera_info_manager::CameraInfoManager"
    (one,) = node_of(f'info_ = std::make_shared<{kind}>(this, "camera", "");').endpoints
    assert (one.name.usual, one.name.known, one.evidence.sure.value) == ("~/set_camera_info", None, "likely")
    (one,) = node_of(f'info_ = std::make_shared<{kind}>(this, "camera", "", "left");').endpoints
    assert (one.name.known, one.type.known) == ("left/set_camera_info", "sensor_msgs/srv/SetCameraInfo")
    (one,) = main_of(f'ros::NodeHandle camera("left"); {kind} info(camera, "name", "");').endpoints
    assert (one.name.known, one.type.known) == ("left/set_camera_info", "sensor_msgs/SetCameraInfo")


@pytest.mark.parametrize(
    ("made", "expected"),
    [
        ('image_transport::create_publisher(this, "a");', Qos("reliable", "volatile", "keep_last", 10)),
        ('image_transport::create_publisher(this, "a", rmw_qos_profile_sensor_data);',
         Qos("best_effort", "volatile", "keep_last", 5)),
        ('image_transport::create_subscription(this, "a", cb, "raw");', Qos("reliable", "volatile", "keep_last", 10)),
        ('image_transport::create_subscription(this, "a", cb, "raw", rmw_qos_profile_sensor_data);',
         Qos("best_effort", "volatile", "keep_last", 5)),
        ('image_transport::create_camera_publisher(this, "a");', Qos("reliable", "volatile", "keep_last", 10)),
        ('image_transport::create_camera_subscription(this, "a", cb, "raw", rmw_qos_profile_sensor_data);',
         Qos("best_effort", "volatile", "keep_last", 5)),
        ('image_transport::ImageTransport it(node); it.advertise("a", 3);',
         Qos("reliable", "volatile", "keep_last", 3)),
        ('image_transport::ImageTransport it(node); it.subscribe("a", 1, cb);',
         Qos("reliable", "volatile", "keep_last", 1)),
        ('image_transport::SubscriberFilter f; f.subscribe(this, "a", "raw");',
         Qos("reliable", "volatile", "keep_last", 10)),
    ],
)  # fmt: skip
def test_the_quality_of_service_of_images(node_of, made, expected):
    found = node_of(made).endpoints
    assert {one.qos for one in found} == {expected}
