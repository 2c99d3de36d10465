import pytest

PUB = "pub_ = create_publisher<std_msgs::msg::String>({}, 1);"


@pytest.mark.parametrize(
    ("expression", "name"),
    [
        ('"a"', "a"),
        ('std::string("a") + "/" + "b"', "a/b"),
        ('"camera" + std::to_string(2)', "camera2"),
        ("TOPIC", "from_constant"),
        ("Names::TOPIC", "of_a_class"),
        ("MACRO", "of_a_macro"),
        ('true ? "yes" : "no"', "yes"),
        ('1 + 1 == 2 ? "yes" : "no"', "yes"),
        ('!(1 < 2) ? "yes" : "no"', "no"),
        ('true && false ? "yes" : "no"', "no"),
        ('unknown() && false ? "yes" : "no"', "no"),
        ('true || unknown() ? "yes" : "no"', "yes"),
        ("topic_", "of_a_member"),
    ],
)
def test_names_that_come_out(node_of, expression, name):
    before = (
        '#define MACRO "of_a_macro"\nconst std::string TOPIC = "from_constant";\n'
        'struct Names { static constexpr auto TOPIC = "of_a_class"; };'
    )
    facts = node_of(PUB.format(expression), 'std::string topic_{"of_a_member"};', before)
    assert [(one.name.known, one.evidence.sure.value) for one in facts.endpoints] == [(name, "certain")]


@pytest.mark.parametrize("expression", ["unknown()", "argument", '"a" + unknown()', 'unknown() ? "a" : "b"'])
def test_names_that_do_not_come_out_are_not_certain(node_of, expression):
    (one,) = node_of(PUB.format(expression)).endpoints
    assert one.name.known is None
    assert one.name.holes
    assert one.evidence.sure.value in ("likely", "possible")


def test_python_texts(units, names):
    text = """
import rospy
from std_msgs.msg import String
PREFIX = 'a'
TABLE = {'one': 'b', 'two': 'c'}
def main():
    rospy.init_node('n')
    rospy.Publisher(f'{PREFIX}/x', String, queue_size=1)
    rospy.Publisher('{}/{}'.format(PREFIX, 'y'), String, queue_size=1)
    rospy.Publisher('%s/z' % PREFIX, String, queue_size=1)
    rospy.Publisher(TABLE['two'], String, queue_size=1)
    rospy.Publisher('/'.join([PREFIX, 'w']), String, queue_size=1)
if __name__ == '__main__':
    main()
"""
    (facts,) = units(a_py=text)
    assert [name for _, name in names(facts)] == ["a/x", "a/y", "a/z", "c", "a/w"]


def test_the_name_of_the_package_is_known_in_its_code(units):
    text = "#include <ros/ros.h>\nint main(int argc, char ** argv) { ros::init(argc, argv, ROS_PACKAGE_NAME); }"
    (facts,) = units(a_cpp=text)
    assert str(facts.name) == "pkg"
