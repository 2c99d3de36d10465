"""Classes that are loaded by name: what they make stands at the node that loads them."""

import pytest

from roslens.source.extract.facts.chosen import Chosen, node_key
from roslens.source.extract.units.node_units import facts_of_class, facts_of_main, node_classes

PLUGINS = """
#include <rclcpp/rclcpp.hpp>
#include <std_msgs/msg/string.hpp>
#include <pluginlib/class_loader.hpp>
namespace core { class Base { public:
  virtual void configure(rclcpp::Node::SharedPtr n, const std::string & name) = 0; }; }
namespace p {
class Talks : public core::Base { public:
  void configure(rclcpp::Node::SharedPtr n, const std::string & name) override {
    n->create_publisher<std_msgs::msg::String>(name + "/said", 1); } };
class Hears : public core::Base { public:
  void configure(rclcpp::Node::SharedPtr n, const std::string & name) override {
    n->create_subscription<std_msgs::msg::String>("heard", 1, [](){}); n->declare_parameter(name + ".loud", false); } };
}
PLUGINLIB_EXPORT_CLASS(p::Talks, core::Base)
PLUGINLIB_EXPORT_CLASS(p::Hears, core::Base)
"""
HOST = """
class Host : public rclcpp::Node {{ public:
  Host() : Node("host"), loader_("core", "core::Base") {{
{body}
  }}
  pluginlib::ClassLoader<core::Base> loader_;
  std::vector<std::string> names_, types_;
  std::vector<std::shared_ptr<core::Base>> loaded_;
}};
"""
EACH = """
    names_ = declare_parameter("plugins", std::vector<std::string>{"a", "b"});
    types_.resize(names_.size());
    for (size_t i = 0; i < names_.size(); ++i) {
      types_[i] = declare_parameter(names_[i] + ".plugin", std::string("p::Talks"));
    }
    for (size_t i = 0; i < names_.size(); ++i) { loaded_.push_back(loader_.createSharedInstance(types_[i])); }
    for (size_t i = 0; i < names_.size(); ++i) { loaded_[i]->configure(shared_from_this(), names_[i]); }
"""
SET = Chosen((("", "plugins", "[x, y]"), ("", "x.plugin", "p::Talks"), ("", "y.plugin", "p::Hears")))


@pytest.fixture(name="host")
def host_(index_of):
    def make(body, chosen=None, names=None):
        index = index_of(a_cpp=PLUGINS + HOST.format(body=body))
        (one,) = (found for found in node_classes(index) if found[0].what.name == "Host")
        (facts,) = facts_of_class(index, *one, chosen=chosen, plugin_names=names or {})
        return facts

    return make


def made(facts):
    return sorted(str(one.name) for one in facts.endpoints)


def test_without_a_choice_it_is_told_what_decides(host):
    facts = host(EACH)
    assert made(facts) == []
    (one,) = facts.plugins
    assert (one.base, one.made) == ("core::Base", "")
    (hole,) = one.type.holes
    assert hole.named[0].pattern == "*.plugin"
    assert hole.named[0].holes[0].parameter == "plugins"


def test_each_that_is_chosen_makes_its_own(host):
    facts = host(EACH, SET)
    assert made(facts) == ["heard", "x/said"]
    assert [one.made for one in facts.plugins] == ["p.Talks", "p.Hears"]
    assert [str(one.name) for one in facts.parameters if str(one.name).endswith("loud")] == ["y.loud"]


def test_defaults_are_holes_with_what_they_say(host):
    facts = host(EACH, Chosen((("", "plugins", None), ("", "a.plugin", None))))
    assert {one.name.usual for one in facts.endpoints} == {"a/said", "b/said"}
    assert all(one.name.holes for one in facts.endpoints)


def test_a_class_that_is_written_needs_no_parameter(host):
    body = 'loader_.createUniqueInstance("p::Talks")->configure(shared_from_this(), "fixed");'
    assert made(host(body, Chosen())) == ["fixed/said"]
    assert made(host(body)) == []


@pytest.mark.parametrize("name", ["p/Talks", "other"])
def test_a_name_of_a_description_is_known(host, name):
    facts = host(
        f'loader_.createSharedInstance("{name}")->configure(shared_from_this(), "n");', Chosen(), {"other": "p::Talks"}
    )
    assert made(facts) == ["n/said"]


@pytest.mark.parametrize("name", ["p::Talks", "p/Talks", "Talks"])
def test_the_name_of_a_class_is_without_its_package(host, name):
    body = f'loader_.createSharedInstance("p::Talks")->configure(shared_from_this(), loader_.getName("{name}"));'
    assert made(host(body, Chosen())) == ["Talks/said"]


def test_the_name_of_a_default_is_likely(host):
    body = """
    auto type = declare_parameter("type", std::string("p::Talks"));
    loader_.createSharedInstance(type)->configure(shared_from_this(), loader_.getName(type));
"""
    (end,) = host(body, Chosen((("", "type", None),))).endpoints
    assert (end.name.usual, end.evidence.sure.value) == ("Talks/said", "likely")


def test_a_class_elsewhere_is_not_made_up(host):
    facts = host('loader_.createSharedInstance("far::Away")->configure(shared_from_this(), "n");', Chosen())
    assert made(facts) == []
    assert [(one.type.known, one.made) for one in facts.plugins] == [("far::Away", "")]


@pytest.mark.parametrize(
    "use",
    [
        'loaded_.back()->configure(shared_from_this(), "n");',
        'for (auto & one : loaded_) { one->configure(shared_from_this(), "n"); }',
    ],
)
def test_a_list_gives_what_was_put_in_it(host, use):
    assert made(host('loaded_.push_back(loader_.createSharedInstance("p::Talks"));\n' + use, Chosen())) == ["n/said"]


def test_what_nobody_was_seen_to_call_runs_nevertheless(host):
    facts = host('keep(loader_.createSharedInstance("p::Hears"));', Chosen())
    assert made(facts) == ["heard"]


def test_a_loader_may_be_made_later(host):
    body = (
        'auto loader = std::make_unique<pluginlib::ClassLoader<core::Base>>("core", "core::Base");\n'
        'std::unique_ptr<core::Base> one(loader->createUnmanagedInstance("p::Talks"));\n'
        'one->configure(shared_from_this(), "n");'
    )
    assert made(host(body, Chosen())) == ["n/said"]


def test_class_loader_says_the_base_where_it_loads(host):
    body = (
        'class_loader::ClassLoader loader("libp.so");\n'
        'loader.createInstance<core::Base>("p::Talks")->configure(shared_from_this(), "n");'
    )
    facts = host(body, Chosen())
    assert made(facts) == ["n/said"]
    assert facts.plugins[0].base == "core::Base"


def test_a_program_of_ros1_loads_by_name_too(index_of):
    text = """
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <pluginlib/class_loader.h>
namespace p { class Talks : public Base { public: void initialize(std::string n) {
  ros::NodeHandle nh("~/" + n); nh.advertise<std_msgs::String>("said", 1); } }; }
int main(int argc, char ** argv) { ros::init(argc, argv, "a"); ros::NodeHandle nh("~");
  pluginlib::ClassLoader<Base> loader("pkg", "Base");
  std::string type; nh.param("planner", type, std::string("p/Talks"));
  loader.createInstance(type)->initialize("first"); }
"""
    index = index_of(a_cpp=text)
    (before,) = facts_of_main(index, "pkg/a.cpp")
    assert before.endpoints == ()
    (facts,) = facts_of_main(index, "pkg/a.cpp", chosen=Chosen((("", "~/planner", None),)))
    assert made(facts) == ["~/first/said"]


LAYERS = """
#include <ros/ros.h>
#include <std_msgs/String.h>
#include <pluginlib/class_loader.h>
namespace p { class Talks : public Base { public: void initialize(std::string n) {
  ros::NodeHandle nh("~/" + n); nh.advertise<std_msgs::String>("said", 1); } }; }
int main(int argc, char ** argv) { ros::init(argc, argv, "a"); ros::NodeHandle nh("~");
  pluginlib::ClassLoader<Base> loader("pkg", "Base");
  XmlRpc::XmlRpcValue layers; nh.getParam("layers", layers);
  for (int32_t i = 0; i < layers.size(); ++i) {
    std::string name = static_cast<std::string>(layers[i]["name"]);
    std::string type = static_cast<std::string>(layers[i]["type"]);
    boost::shared_ptr<Base> one = loader.createInstance(type); one->initialize(name); } }
"""


def test_a_list_of_maps_names_classes_in_ros1(index_of):
    index = index_of(a_cpp=LAYERS)
    (before,) = facts_of_main(index, "pkg/a.cpp")
    assert [hole.parameter for one in before.plugins for hole in one.type.holes] == ["~/layers"]
    chosen = Chosen((("", "~/layers", "[{name: x, type: 'p::Talks'}, {name: y, type: 'p::Talks'}]"),))
    (facts,) = facts_of_main(index, "pkg/a.cpp", chosen=chosen)
    assert made(facts) == ["~/x/said", "~/y/said"]


INNER = """
class Inner : public rclcpp::Node { public:
  Inner(const std::string & name) : Node(name), loader_("core", "core::Base") { }
  void start() {
    auto type = declare_parameter("type", std::string("p::Talks"));
    loader_.createSharedInstance(type)->configure(shared_from_this(), "n");
  }
  pluginlib::ClassLoader<core::Base> loader_;
};
class Outer : public rclcpp::Node { public:
  Outer() : Node("outer") { one_ = std::make_shared<Inner>("one"); one_->start(); two_ = std::make_shared<Inner>("two");
    two_->start(); }
  std::shared_ptr<Inner> one_, two_;
};
"""


def test_a_node_that_another_one_makes_loads_by_its_own_parameters(index_of):
    index = index_of(a_cpp=PLUGINS + INNER)
    (one,) = (found for found in node_classes(index) if found[0].what.name == "Outer")
    _, first, second = facts_of_class(index, *one)
    assert [(len(node.plugins), node.plugins[0].type.holes[0].parameter) for node in (first, second)] == [
        (1, "type")
    ] * 2
    chosen = Chosen(((node_key(first), "type", None), (node_key(second), "type", "p::Hears")))
    outer, first, second = facts_of_class(index, *one, chosen=chosen)
    assert [made(node) for node in (outer, first, second)] == [[], ["n/said"], ["heard"]]
