import pytest

from roslens.source.extract.interfaces.interfaces_by_package import InterfacesByPackage

OWNERS = {"robot/msg/State.msg": "robot", "robot/action/Go.action": "robot", "robot/srv/Do.srv": "robot@x"}


@pytest.mark.parametrize(
    ("name", "modules", "found"),
    [
        ("String", ["std_msgs.msg", "geometry_msgs.msg"], "std_msgs.msg"),
        ("String", ["std_msgs.msg", "other.msg"], "std_msgs.msg"),
        ("State", ["std_msgs.msg", "robot.msg"], "robot.msg"),
        ("GoAction", ["robot.msg", "std_msgs.msg"], "robot.msg"),
        ("Do", ["std_srvs.srv", "robot.srv"], "robot.srv"),
        ("Foo", ["std_msgs.msg", "other.msg"], "other.msg"),
        ("Foo", ["another.msg", "other.msg"], ""),
        ("Foo", ["std_msgs.msg", "robot.msg"], ""),
        ("Foo", ["other.msg", "other.msg"], "other.msg"),
        ("Foo", [], ""),
    ],
)
def test_which_module_has_a_name(name, modules, found):
    assert InterfacesByPackage(OWNERS).of_modules(name, modules) == found


def test_a_type_of_one_of_several_modules(units):
    text = (
        "import rospy\nfrom std_msgs.msg import *\nfrom geometry_msgs.msg import *\n"
        'rospy.init_node("a")\np = rospy.Publisher("p", Twist, queue_size=1)\nrospy.spin()\n'
    )
    (facts,) = units(a_py=text)
    assert facts.endpoints[0].type.known == "geometry_msgs/Twist"
