"""Quality of service, as code writes it."""

import pytest

from roslens.model.qos import Qos
from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.lowering.python.python_program import program_of_python
from roslens.source.extract.units.workspace_units import facts_of_workspace

SENSOR = "rmw_qos_profile_sensor_data"


@pytest.mark.parametrize(
    ("given", "quality"),
    [
        ("10", ("reliable", "volatile", "keep_last", 10)),
        ("rclcpp::QoS(3).best_effort().transient_local()", ("best_effort", "transient_local", "keep_last", 3)),
        ("rclcpp::SensorDataQoS()", ("best_effort", "volatile", "keep_last", 5)),
        ("rclcpp::QoS(rclcpp::KeepAll())", ("reliable", "volatile", "keep_all", 0)),
        ("rclcpp::KeepLast(4)", ("reliable", "volatile", "keep_last", 4)),
        ("rclcpp::SensorDataQoS(rclcpp::KeepLast(7))", ("best_effort", "volatile", "keep_last", 7)),
        ("rclcpp::SensorDataQoS(rclcpp::KeepLast(7)).reliable()", ("reliable", "volatile", "keep_last", 7)),
        ("rclcpp::QoS(rclcpp::KeepLast(2), rmw_qos_profile_sensor_data)", ("best_effort", "volatile", "keep_last", 2)),
        (
            "rclcpp::QoS(rclcpp::QoSInitialization::from_rmw(rmw_qos_profile_sensor_data))",
            ("reliable", "volatile", "keep_last", 5),
        ),
        (
            f"rclcpp::QoS(rclcpp::QoSInitialization::from_rmw({SENSOR}), {SENSOR})",
            ("best_effort", "volatile", "keep_last", 5),
        ),
    ],
)
def test_quality_of_service(node_of, given, quality):
    (one,) = node_of(f'pub_ = create_publisher<std_msgs::msg::String>("a", {given});').endpoints
    assert (one.qos.reliability, one.qos.durability, one.qos.history, one.qos.depth) == quality
    assert one.qos_unknown == ""


def test_a_depth_that_a_parameter_decides(node_of):
    body = 'int depth = declare_parameter("depth", 5);\n'
    (one,) = node_of(body + 'pub_ = create_publisher<std_msgs::msg::String>("a", rclcpp::QoS(depth));').endpoints
    assert "depth" in one.qos_unknown


def test_a_preset_that_keeps_what_a_parameter_says(node_of):
    body = 'int depth = declare_parameter("depth", 5);\n'
    quality = "rclcpp::SensorDataQoS(rclcpp::KeepLast(depth))"
    (one,) = node_of(f'{body}pub_ = create_publisher<std_msgs::msg::String>("a", {quality});').endpoints
    assert (one.qos.reliability, "depth" in one.qos_unknown) == ("best_effort", True)


@pytest.mark.parametrize(
    ("declared", "reliability", "unknown"),
    [
        ("rclcpp::QoS base", "", "result of somewhere()"),
        ("const rmw_qos_profile_t base", "", "result of somewhere()"),
        ("size_t base", "reliable", "its depth is result of somewhere()"),
        ("auto base", "", "result of somewhere()"),
        # No name decides, but its type.
        ("size_t qos_profile", "reliable", "its depth is result of somewhere()"),
    ],
)
def test_what_is_not_known_is_a_profile_or_a_depth_by_its_type(node_of, declared, reliability, unknown):
    name = declared.rpartition(" ")[2]
    body = f"{declared} = somewhere();\n"
    (one,) = node_of(f'{body}pub_ = create_publisher<std_msgs::msg::String>("a", rclcpp::QoS({name}));').endpoints
    assert (one.qos.reliability, one.qos_unknown) == (reliability, unknown)


@pytest.mark.parametrize(
    ("written", "reliability"),
    [
        ("names_.size()", "reliable"),
        ("2 * depth_", "reliable"),
        ("depth_", "reliable"),
        ("somewhere() ? 10 : depth_", "reliable"),
        ("other_", ""),
        ("made()", ""),
        ("somewhere() ? other_ : made()", ""),
    ],
)
def test_a_depth_by_how_its_member_is_declared(units, written, reliability):
    (facts,) = units(
        a_cpp=f"""
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class A : public rclcpp::Node {{
  A() : Node("a"), depth_(somewhere()), other_(somewhere()) {{
    pub_ = create_publisher<std_msgs::msg::String>("a", rclcpp::QoS({written}));
  }}
  std::vector<std::string> names_ = somewhere();
  const size_t depth_;
  Profile other_;
}};
"""
    )
    (one,) = facts.endpoints
    assert (one.qos.reliability, bool(one.qos_unknown)) == (reliability, True)


def test_what_is_changed_of_a_profile_that_is_not_known_is_known(node_of):
    body = "rclcpp::QoS base = somewhere();\n"
    (one,) = node_of(f'{body}pub_ = create_publisher<std_msgs::msg::String>("a", base.best_effort());').endpoints
    assert (one.qos.reliability, one.qos_unknown) == ("best_effort", "result of somewhere()")


def test_a_profile_that_a_function_nobody_calls_is_given(units):
    (facts,) = units(
        a_cpp="""
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
class A : public rclcpp::Node {
 public:
  explicit A(const rclcpp::QoS & base) : Node("a") {
    pub_ = create_publisher<std_msgs::msg::String>("a", rclcpp::QoS(base).reliable());
  }
};
"""
    )
    (one,) = facts.endpoints
    assert (one.qos.reliability, one.qos.durability, "base" in one.qos_unknown) == ("reliable", "", True)


def python_endpoints(units, *lines):
    text = """
from rclpy.duration import Duration, Infinite
from rclpy.node import Node
from rclpy.qos import QoSPresetProfiles, QoSProfile
from std_msgs.msg import String
class A(Node):
    def __init__(self):
        super().__init__('a')
"""
    (facts,) = units(a_py=text + "".join(f"        {line}\n" for line in lines))
    return facts.endpoints


def test_a_profile_of_rclpy_by_its_name(units):
    (one,) = python_endpoints(units, "self.create_publisher(String, 'a', QoSPresetProfiles.SENSOR_DATA.value)")
    assert (one.qos.reliability, one.qos.depth, one.qos_unknown) == ("best_effort", 5, "")


@pytest.mark.parametrize(
    ("written", "seconds"),
    [
        ("Duration(seconds=0.5)", 0.5),
        ("Duration(seconds=1, nanoseconds=500000000)", 1.5),
        ("Duration()", 0.0),
        ("Infinite", 0.0),
    ],
)
def test_limits_of_rclpy(units, written, seconds):
    (one,) = python_endpoints(
        units, f"self.create_publisher(String, 'a', QoSProfile(depth=1, deadline={written}, lifespan={written}))"
    )
    assert (one.qos.deadline_s, one.qos.lifespan_s, one.qos.lease_s, one.qos_unknown) == (seconds, seconds, 0.0, "")


@pytest.mark.parametrize("written", ["Duration(seconds=period())", "period()"])
def test_a_deadline_that_is_no_number_is_unknown_and_not_none(units, written):
    (one,) = python_endpoints(units, f"self.create_publisher(String, 'a', QoSProfile(depth=1, deadline={written}))")
    assert (one.qos.reliability, one.qos_unknown) == ("reliable", "its deadline is unknown")


@pytest.mark.parametrize(
    "written",
    [
        "1500ms",
        "std::chrono::milliseconds(1500)",
        "rclcpp::Duration(1, 500000000)",
        "rclcpp::Duration::from_seconds(1.5)",
    ],
)
def test_limits_of_rclcpp(node_of, written):
    body = f'pub_ = create_publisher<std_msgs::msg::String>("a", rclcpp::QoS(1).deadline({written}));'
    (one,) = node_of(body).endpoints
    assert (one.qos.deadline_s, one.qos_unknown) == (1.5, "")


def test_a_number_that_is_not_known_is_a_depth(node_of):
    body = """
        int given = 5;
        get_parameter("size", given);
        size_t counted = ask();
        a_ = create_publisher<std_msgs::msg::String>("a", given);
        b_ = create_publisher<std_msgs::msg::String>("b", counted);
        c_ = create_publisher<std_msgs::msg::String>("c", ask());
        d_ = create_subscription<std_msgs::msg::String>("d", this->declare_parameter<int>("depth", 3), cb);
    """
    found = {str(one.name): one for one in node_of(body).endpoints}
    for name in "abd":
        assert found[name].qos == Qos("reliable", "volatile", "keep_last", 0), name
        assert found[name].qos_unknown.startswith("its depth is "), name
    assert found["c"].qos == Qos()


def test_a_parameter_is_a_depth_in_python(units):
    text = """
from rclpy.node import Node
from std_msgs.msg import String
class A(Node):
    def __init__(self):
        super().__init__('a')
        size = self.declare_parameter('size', 10).value
        self.a = self.create_publisher(String, 'a', size)
        self.b = self.create_subscription(String, 'b', self.cb, qos_profile=size)
        self.c = self.create_publisher(String, 'c', ask())
    def cb(self, msg):
        pass
"""
    (facts,) = [one for one in units(a_py=text) if one.unit == "A"]
    found = {str(one.name): one.qos for one in facts.endpoints}
    usual = Qos("reliable", "volatile", "keep_last", 0)
    assert found == {"a": usual, "b": usual, "c": Qos()}


@pytest.mark.parametrize(
    ("imported", "used"),
    [
        ("import nav_utils.qos", "nav_utils.qos.LATCHED"),
        ("import nav_utils.qos as q", "q.LATCHED"),
        ("from nav_utils import qos", "qos.LATCHED"),
        ("from nav_utils.qos import LATCHED", "LATCHED"),
        ("import nav_utils.qos", "nav_utils.qos.latched()"),
        ("from nav_utils import qos", "qos.Profiles.LATCHED"),
        ("import nav_utils", "nav_utils.LATCHED"),
    ],
)
def test_a_constant_of_a_module_of_the_workspace(imported, used):
    profile = "QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)"
    texts = {
        "src/nav_utils/nav_utils/__init__.py": "from .qos import LATCHED\n",
        "src/nav_utils/nav_utils/qos.py": f"""
from rclpy.qos import DurabilityPolicy, QoSProfile
LATCHED = {profile}
def latched():
    return {profile}
class Profiles:
    LATCHED = {profile}
""",
        "src/mapper/mapper/a.py": f"""
from rclpy.node import Node
from std_msgs.msg import String
{imported}
class A(Node):
    def __init__(self):
        super().__init__('a')
        self.a = self.create_publisher(String, 'a', {used})
""",
    }
    programs = {path: program_of_python(text.encode()) for path, text in texts.items()}
    (facts,) = facts_of_workspace(indexed(programs, {path: path.split("/")[1] for path in programs}))
    assert [one.qos for one in facts.endpoints] == [Qos("reliable", "transient_local", "keep_last", 1)]
