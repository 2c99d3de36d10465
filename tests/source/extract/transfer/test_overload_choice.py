import pytest

from roslens.source.extract.domain.abstract_value import Handle, NodeBuilder, Obj
from roslens.source.extract.interpreter.vocabulary_index import indexed
from roslens.source.extract.ir.program import Function, Literal, Parameter
from roslens.source.extract.symbolic.text import Text
from roslens.source.extract.symbols.symbol_table import DefinedFunction
from roslens.source.extract.transfer.overload_choice import overload, taking

INDEX = indexed({})
INDEX = indexed({})
HANDLE = Handle(NodeBuilder("main", "a.cpp", 1, "ros1"))


def function(*types, defaults=0, body=()):
    parameters = [
        Parameter(f"p{place}", one, Literal("") if place >= len(types) - defaults else None)
        for place, one in enumerate(types)
    ]
    return DefinedFunction("a.cpp", Function("f", "f", 1, parameters=tuple(parameters), body=body))


BY_TEXT = function("const std::string &", "int", defaults=2)
BY_POINTER = function("Connection *")
BY_HANDLE = function("ros::NodeHandle")


@pytest.mark.parametrize(
    ("argument", "chosen"),
    [
        (Text.of("a"), BY_TEXT),
        (Obj("pkg.Connection"), BY_POINTER),
        (HANDLE, BY_HANDLE),
    ],
)
def test_what_is_known_of_arguments_decides(argument, chosen):
    assert overload(INDEX, [BY_TEXT, BY_POINTER, BY_HANDLE], 1, [argument]) is chosen


@pytest.mark.parametrize(("argument", "type_"), [(1, "int"), (True, "bool"), (1.5, "double"), (Text.of("a"), "char *")])
def test_plain_values_tell_types(argument, type_):
    wanted, other = function(type_), function("Connection *" if type_ == "char *" else "std::string")
    assert overload(INDEX, [other, wanted], 1, [argument]) is wanted


def test_how_many_there_are_comes_first():
    two = function("int", "int")
    assert overload(INDEX, [BY_POINTER, two], 2, [Obj("pkg.Connection"), 1]) is two
    assert taking(INDEX, [BY_TEXT, BY_POINTER], 0) == [BY_TEXT]
    assert overload(INDEX, [], 0) is None
    assert overload(INDEX, [BY_POINTER], 3) is BY_POINTER


def test_overloads_call_each_other(main_of):
    before = """
class R { public:
  void init(std::string ip = "") { pub_ = nh_.advertise<std_msgs::String>("one", 1); init(&connection_); }
  void init(Connection * c) { pub_ = nh_.advertise<std_msgs::String>("two", 1); init(c, 1); }
  void init(Connection * c, int n) { pub_ = nh_.advertise<std_msgs::String>("three", 1); }
  ros::NodeHandle nh_; ros::Publisher pub_; Connection connection_; };
class S : public R { public: using R::init; void init(Connection * c, int n) { R::init(c, n); } };
"""
    assert sorted(str(one.name) for one in main_of("S s; s.init();", before).endpoints) == ["one", "three", "two"]


def test_aliases_of_templates_in_namespaces_are_constructed(main_of):
    before = """
namespace n { template<class T> class F { public:
  F(ros::NodeHandle nh) : nh_(nh) { pub_ = nh_.advertise<std_msgs::String>("f", 1); }
  ros::NodeHandle nh_; ros::Publisher pub_; };
typedef F<int> Whole; }
"""
    assert [str(one.name) for one in main_of("n::Whole whole(nh);", before).endpoints] == ["f"]


def test_callbacks_of_topics_take_one_message_and_those_of_services_two(main_of):
    before = """
class R { public:
  R() { a_ = nh_.subscribe("t", 1, &R::on, this); b_ = nh_.advertiseService("s", &R::on, this); }
  bool on(std_srvs::Empty::Request & q, std_srvs::Empty::Response & r) { return true; }
  void on(const std_msgs::StringConstPtr & m) {}
  ros::NodeHandle nh_; ros::Subscriber a_; ros::ServiceServer b_; };
"""
    assert [str(one.type) for one in main_of("R r;", before).endpoints] == ["std_msgs/String", "std_srvs/Empty"]


SPECIALISED = """
class R { public:
  template<typename T> void make(const std::string & name);
  ros::NodeHandle nh_; ros::Publisher pub_; };
template<> void R::make<bool>(const std::string & name) { pub_ = nh_.advertise<std_msgs::Bool>(name, 1); }
template<> void R::make<int32_t>(const std::string & name) { pub_ = nh_.advertise<std_msgs::Int32>(name, 1); }
template<> void R::make<std::string>(const std::string & name) { pub_ = nh_.advertise<std_msgs::String>(name, 1); }
template<typename T> void made(ros::NodeHandle & nh) { static auto pub = nh.advertise<std_msgs::Empty>("any", 1); }
template<> void made<double>(ros::NodeHandle & nh) { static auto pub = nh.advertise<std_msgs::Float64>("exact", 1); }
"""


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        ('R r; r.make<bool>("a");', [("a", "std_msgs/Bool")]),
        ('R r; r.make<int>("a");', [("a", "std_msgs/Int32")]),
        ('R r; r.make<std::string>("a");', [("a", "std_msgs/String")]),
        ('R r; r.make<bool>("a"); r.make<int>("b");', [("a", "std_msgs/Bool"), ("b", "std_msgs/Int32")]),
        ('R r; r.make<float>("a");', []),
        ("ros::NodeHandle nh; made<double>(nh);", [("exact", "std_msgs/Float64")]),
        ("ros::NodeHandle nh; made<int>(nh);", [("any", "std_msgs/Empty")]),
    ],
)
def test_template_arguments_choose_a_specialisation(main_of, call, expected):
    endpoints = main_of(call, SPECIALISED).endpoints
    assert [(str(one.name), one.type.known) for one in endpoints] == expected
