"""Several sources that define the same names, each for itself."""

import pytest

from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.units.node_units import facts_of_main
from roslens.source.syntax.macro.macros import load_macros

NODE = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
static const char * TOPIC = "{name}_topic";
class Demo : public rclcpp::Node {{
public:
  Demo() : Node("{name}") {{ pub_ = create_publisher<std_msgs::msg::String>(TOPIC, 1); more(); }}
  void more();
  static constexpr const char * SERVICE = "{name}_service";
}};
void Demo::more() {{ serve_ = create_service<std_srvs::srv::Empty>(SERVICE, nullptr); }}
int main() {{ rclcpp::spin(std::make_shared<Demo>()); }}
"""


def test_each_source_means_its_own(units):
    facts = units(a_cpp=NODE.format(name="a"), b_cpp=NODE.format(name="b"))
    of_mains = {one.name.known: one for one in facts if one.unit == "main"}
    assert set(of_mains) == {"a", "b"}
    for name, one in of_mains.items():
        assert [two.name.known for two in one.endpoints] == [f"{name}_topic", f"{name}_service"]
        assert {two.evidence.path for two in one.endpoints} == {f"pkg/{name}.cpp"}


def test_a_member_that_only_one_of_two_classes_of_a_name_has(index_of):
    one = 'class A { static const char * NAME; };\nconst char * A::NAME = "one";'
    index = index_of(a_cpp=one, b_cpp="class A { int other; };")
    assert index.member(index.class_of("A", "pkg/a.cpp", ""), "NAME")[1].value == "one"
    assert index.member(index.class_of("A", "pkg/b.cpp", ""), "NAME") is None


def test_a_class_of_a_header_is_meant_by_all_that_define_none(index_of):
    index = index_of(a_hpp="class A { int of_header; };", b_cpp="class A { int own; };", c_cpp="A a;")
    assert index.class_of("A", "pkg/c.cpp", "").path == "pkg/a.hpp"
    assert index.class_of("A", "pkg/b.cpp", "").path == "pkg/b.cpp"
    assert index.key(index.class_of("A", "pkg/b.cpp", "")) == "pkg/b.cpp:A"


@pytest.mark.parametrize("header", ["extern const std::string TOPIC;", "class Other {};"])
def test_what_a_source_defines_for_all(index_of, header):
    index = index_of(a_hpp=header, b_cpp='const std::string TOPIC = "t";', c_cpp="int main() {}")
    assert index.constant("TOPIC", "pkg/c.cpp", "")[1].value == "t"


def test_a_source_that_another_one_includes_is_like_a_header(index_of):
    index = index_of(a_cpp="class A {};", b_cpp='#include "a.cpp"\n', c_cpp="class A {};")
    assert index.class_of("A", "pkg/b.cpp", "").path == "pkg/a.cpp"


def test_of_two_headers_the_one_is_meant_that_is_included(units):
    robot = """#include "pkg/robot.hpp"
namespace ns { Robot::Robot() : Node("robot") { pub_ = create_publisher<std_msgs::msg::String>("of_robot", 1); } }
"""
    other = """#include "pkg/other.hpp"
namespace ns {
Other::Other() : Node("other") { pub_ = create_publisher<std_msgs::msg::String>("of_other", 1); }
}
"""
    facts = units(
        a_struct_hpp="namespace ns { struct Robot { double x; }; }",
        robot_hpp="#include <rclcpp/rclcpp.hpp>\nnamespace ns { class Robot : public rclcpp::Node { Robot(); }; }",
        between_hpp='#include "a_struct.hpp"\n',
        other_hpp='#include "between.hpp"\nnamespace ns { class Other : public rclcpp::Node { Other(); Robot r_; }; }',
        robot_cpp=robot,
        other_cpp=other,
    )
    found = {one.name.known: [two.name.known for two in one.endpoints] for one in facts}
    assert found == {"robot": ["of_robot"], "other": ["of_other"]}


def test_who_includes_both_headers_means_what_all_others_do(index_of):
    index = index_of(
        a_hpp="class A { int first; };",
        b_hpp="class A { int second; };",
        c_cpp='#include "a.hpp"\n#include "b.hpp"\nA a;',
        d_cpp='#include "b.hpp"\nA a;',
    )
    assert index.class_of("A", "pkg/c.cpp", "").path == "pkg/a.hpp"
    assert index.class_of("A", "pkg/d.cpp", "").path == "pkg/b.hpp"


ROBOT = """#include <rclcpp/rclcpp.hpp>
class Robot : public rclcpp::Node {{ public: Robot() : Node("{name}") {{}} }};
"""
MAIN = '#include "common/robot.hpp"\nint main() { rclcpp::spin(std::make_shared<Robot>()); }'


@pytest.mark.parametrize(("needs", "name"), [({"c": ["a"]}, "a"), ({"c": ["b"]}, "b"), ({"c": ["d", "b"]}, "b")])
def test_of_two_packages_with_a_header_of_one_path_the_one_is_meant_that_is_needed(needs, name):
    macros = load_macros()
    texts = {f"{one}/include/common/robot.hpp": ROBOT.format(name=one) for one in "ab"}
    texts |= {f"{one}/src/main.cpp": MAIN for one in "abc"}
    programs = {path: program_of_cpp(text.encode(), macros) for path, text in texts.items()}
    index = indexed(programs, {path: path[0] for path in texts}, needs)
    found = {one: facts_of_main(index, f"{one}/src/main.cpp")[0].name.known for one in "abc"}
    assert found == {"a": "a", "b": "b", "c": name}


def test_a_constant_means_what_it_does_where_it_is_defined(main_of, names):
    before = """
namespace a { const std::string Prefix = "/a/"; const std::string Name = Prefix + "x"; }
namespace b { const std::string Prefix = "/b/"; const std::string Name = Prefix + "x";
  namespace inner { const std::string Deep = Name + "/y";
    void make(ros::NodeHandle & nh) { auto p = nh.advertise<p::M>(Name, 1); auto q = nh.advertise<p::M>(Deep, 1); } } }
"""
    body = "auto p = nh.advertise<p::M>(a::Name, 1); b::inner::make(nh);"
    assert names(main_of(body, before)) == [("publisher", "/a/x"), ("publisher", "/b/x"), ("publisher", "/b/x/y")]


def test_a_constant_of_two_headers_is_that_of_the_included_one(units, names):
    main = (
        'int main(int c, char ** v) { ros::init(c, v, "a"); ros::NodeHandle n; auto p = n.advertise<p::M>(TOPIC, 1); }'
    )
    found = units(
        a_h='const char TOPIC[] = "of_a";',
        b_h='const char TOPIC[] = "of_b";',
        a_cpp='#include "a.h"\n' + main,
        b_cpp='#include "b.h"\n' + main,
    )
    assert [names(one) for one in found] == [[("publisher", "of_a")], [("publisher", "of_b")]]
