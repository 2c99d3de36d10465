import msgspec
import pytest

from roslens.source.extract.ir.program import Call, Member
from roslens.source.extract.ir.program_text import program_text
from roslens.source.extract.lowering.cpp.cpp_program import program_of_cpp
from roslens.source.extract.lowering.cpp.cpp_slicing import Level, Relevance, is_filling, is_logging
from roslens.source.syntax.macro.macros import load_macros

MACROS = load_macros()
FILLING = b"  total = total + weight * 2.0;\n" * 5
CALL = 'nh.subscribe<T>("x", 1)'
WHERE = (
    "void f() { @; }",
    "void f() { auto x = @; }",
    "void f() { auto [a, b] = @; }",
    "void f() { A a(@, 1); }",
    "void f() { A a{@}; }",
    "void f() { A a = {@}; }",
    "void f() { a = b = @; }",
    "void f() { a[@] = 1; }",
    "void f() { a -= @; }",
    "void f() { a, @; }",
    "void f() { (void) @; }",
    "void f() { static_cast<void>(@); }",
    "void f() { int(@); }",
    "void f() { !@; }",
    "void f() { g(1 + @ * 2); }",
    "void f() { g(*@, &@); }",
    "void f() { g(@).h(); }",
    "void f() { c ? @ : g(); }",
    "void f() { new A(@); }",
    "void f() { new int(@); }",
    "void f() { delete @; }",
    "void f() { co_await @; }",
    "void f() { co_yield @; }",
    "void f() { co_return @; }",
    "int f() { return @; }",
    "A f() { return {1, @}; }",
    "void f() { throw A(@); }",
    "void f() { if (@) { } }",
    "void f() { if (a) b(); else @; }",
    "void f() { if (a) { } else if (@) { } }",
    "void f() { if (auto x = @) { } }",
    "void f() { if (auto x = @; x) { } }",
    "void f() { if constexpr (a) @; }",
    "void f() { switch (@) { case 1: g(); } }",
    "void f() { switch (a) { default: @; } }",
    "void f() { switch (a) { case 1: { @; break; } } }",
    "void f() { for (auto x = @; x; ) { } }",
    "void f() { for (; @; ) { } }",
    "void f() { for (;; @) { } }",
    "void f() { for (auto x : @) { } }",
    "void f() { while (@) { } }",
    "void f() { do { } while (@); }",
    "void f() { try { @; } catch (...) { } }",
    "void f() { try { } catch (...) { @; } }",
    "void f() { try { } catch (A & a) { g(); } catch (B & b) { @; } }",
    "void f() { label: @; }",
    "void f() { { { @; } } }",
    "void f() { [] { @; }(); }",
    "void f() { g([x = @] { }); }",
    "void f() { struct A { void g() { @; } }; }",
    "void f() {\n#if A\n@;\n#endif\n}",
    "void f() {\n#ifdef A\ng();\n#else\n@;\n#endif\n}",
    'void f() { ROS_INFO("%d", @); }',
    "void f() { RCLCPP_ERROR_STREAM(l, @); }",
    "void f() { EXPECT_TRUE(@); }",
    "void f() { std::cout << @ << std::endl; }",
    'void f() { fmt::format("{}", @); }',
    'void f() { fmt::format("{:03d}", @); }',
    "void f() { BOOST_FOREACH(int x, @) { } }",
    "A::A() : a_(@) { }",
    "A::A() : a_{@, 1} { }",
    "A::A() : Base(@) { }",
    "A::A() try : a_(1) { @; } catch (...) { }",
    "A::A() try : a_(1) { } catch (...) { @; }",
    "void f(A a = @) { }",
    "void f(A a = @);",
    "struct B { void f(A a = @); };",
    "struct B { A a = @; };",
    "struct B { A a{@}; };",
    "struct B { void f() { @; } };",
    "A a = @;",
    "A a(@);",
    "namespace b { namespace { A a = @; } }",
    'extern "C" { void f() { @; } }',
    'extern "C" void f() { @; }',
    "#if A\nvoid f() { @; }\n#endif",
    "template <typename T> void f() { @; }",
    "template <typename T> struct B { template <typename U> void f() { @; } };",
    "TEST_F(A, b) { @; }",
    "operator A() { @; }",
    "B & operator=(const B & b) { @; }",
)


@pytest.mark.parametrize("where", WHERE)
@pytest.mark.parametrize("filling", ["", "  total = total + weight * 2.0;\n" * 5])
def test_an_endpoint_is_found_wherever_it_is_made(where: str, filling: str) -> None:
    source = where.replace("@", CALL).replace("{ }", "{ " + filling + " }").replace("() { ", "() { " + filling)
    program = program_of_cpp(source.encode(), MACROS)
    assert endpoints(program) == where.count("@")


def endpoints(value: object) -> int:
    """Return how many calls of ``subscribe`` are in a program."""
    own = isinstance(value, Call) and isinstance(value.function, Member) and value.function.name == "subscribe"
    if isinstance(value, msgspec.Struct):
        value = tuple(getattr(value, name) for name in value.__struct_fields__)
    return own + sum(map(endpoints, value)) if isinstance(value, tuple) else int(own)


def level(body: bytes) -> Level:
    return Relevance(body, 0, len(body)).level


def test_what_names_an_interface_or_is_short_is_lowered_whole() -> None:
    assert level(b"{ x = y * 2; }") is Level.WHOLE
    assert level(b"{" + FILLING + b"}") is Level.NOTHING
    assert level(b"{" + FILLING + b"  pub_ = node->create_publisher<T>(topic, 1);}") is Level.WHOLE
    assert level(b"{" + FILLING + b'  return "text"; }') is Level.WHOLE


def test_a_test_matters_where_it_names_an_interface() -> None:
    for body, expected in (
        (b"{ auto x = std::make_shared<A>(1); }", Level.NOTHING),
        (b"{ n.subscribe(1); }", Level.WHOLE),
    ):
        assert Relevance(body, 0, len(body), test=True).level is expected
    text = program_text(program_of_cpp(b"TEST(A, b) { f(); } TEST(A, c) { n.advertise<T>(1); }", MACROS))
    assert text == "function TEST(A,b)()\nfunction TEST(A,c)()\n  n->advertise<T>(1)\n"


def test_what_may_lead_to_an_interface_keeps_its_calls() -> None:
    body = b"{" + FILLING + b"  initOutputs();\n  x = std::max(a, b);\n  helper_->run(1);\n  if (a) { b = c(); } }"
    relevance = Relevance(body, 0, len(body))
    assert relevance.level is Level.CALLS

    def place(text: bytes) -> tuple[int, int]:
        return body.index(text), body.index(text) + len(text)

    assert relevance.may_lead(*place(b"initOutputs();"))
    assert relevance.may_lead(*place(b"helper_->run(1);"))
    assert not relevance.may_lead(*place(b"x = std::max(a, b);"))
    assert not relevance.may_lead(*place(b"b = c();"))
    assert relevance.may_hold(*place(b"if (a) { b = c(); }"))
    assert not relevance.may_hold(*place(FILLING))


def test_a_name_that_is_given_a_text_stays() -> None:
    body = b"{" + FILLING + b'  mode = "x";\n  frame_id_ = other;\n  total = other; }'
    relevance = Relevance(body, 0, len(body))
    assert relevance.level is Level.CALLS
    assert relevance.may_lead(body.index(b"mode"), len(body))
    assert relevance.may_lead(body.index(b"frame_id_"), len(body))
    assert not relevance.may_lead(body.rindex(b"total"), len(body))


@pytest.mark.parametrize(
    ("statement", "expected"),
    [
        (b"msg->pose.position.x = y * 2;", True),
        (b"msg.covariance[6 * 5 + 5] += 1;", True),
        (b"header.stamp = other.stamp;", True),
        (b"options.callback_group = group_;", False),
        (b"x = y;", False),
        (b"point.x = nh.param(1);", False),
        (b'point.x = "text";', False),
        (b"point.x == y;", False),
    ],
)
def test_numbers_that_fill_a_message(statement: bytes, expected: bool) -> None:
    assert is_filling(statement, 0, len(statement)) is expected


@pytest.mark.parametrize(
    ("statement", "expected"),
    [
        (b'ROS_WARN_THROTTLE(1.0, "x");', True),
        (b'RCLCPP_INFO(get_logger(), "x");', True),
        (b"EXPECT_EQ(a, b());", True),
        (b"std::cerr << x;", True),
        (b'ROS_INFO("%d", nh.advertise<T>(1).n());', False),
        (b'EXPECT_TRUE(nh.getParam("x", y));', False),
        (b"ROS_REGISTER(x);", False),
        (b"printable(x);", False),
    ],
)
def test_statements_that_only_tell_people_something(statement: bytes, expected: bool) -> None:
    assert is_logging(statement, 0, len(statement)) is expected


@pytest.mark.parametrize(
    "written",
    [
        "get_parameter(a)",
        "nh.getParam(a)",
        "nh.param<int>(a)",
        "ros::param::get(a)",
        "A * a = new A;",
        "a = b ? nullptr : new demo::A<int>(b);",
        "A * a = new (place) A(b);",
        "A * a = new demo::A[3];",
        "future_ = std::async(std::launch::async, [this]() {work();});",
        "std::thread spinner(&A::work, this);",
        "thread_ = boost::thread([this] {work();});",
        "ros::init (a)",
        "node->create_generic_publisher(a)",
        "nh.createWallTimer(a)",
        "loader.createUnmanagedInstance(a)",
        "nh.subscribe(a)",
        "message_filters::Subscriber<A> a",
        "MyPublisher a",
        "std::make_unique<A>(a)",
        "ros::NodeHandle a",
        "WallTimer a",
        "nh.serviceClient<A>(a)",
        "SimpleActionServer<A> a",
        "rclcpp::SensorDataQoS a",
        "tf2_ros::TransformListener a",
        "a.registerCallback(b)",
        "ros::names::resolve_name(a)",
        "a->get_node_base_interface()",
        "executor.add_node(a)",
        "ros::topic::waitForMessage<A>(a)",
        "plugins_[i]->configure(node, names_[i])",
        "layers_[0]->initialize(a)",
        'return std::string("a")',
    ],
)
def test_a_long_function_that_names_an_interface_matters_as_a_whole(written: str) -> None:
    source = b"{" + FILLING + written.encode() + b";\n}"
    assert Relevance(source, 0, len(source)).level is Level.WHOLE


@pytest.mark.parametrize(
    "written",
    [
        "renew x", "reinit(a)", "recreate_publisher", "myparams", "Timers", "a_add_node", "// a new plan of it\n",
        "a = new double[n]", "a = new unsigned char[n]",
    ],
)  # fmt: skip
def test_letters_inside_another_word_name_no_interface(written: str) -> None:
    source = b"{" + FILLING + written.encode() + b";\n}"
    assert Relevance(source, 0, len(source)).level is not Level.WHOLE


def test_members_that_a_function_sets_where_it_is_not_lowered():
    body = b"""{ double x_ = 3; a_ = 1; b_ += 2; if (c_ == 4) d_ = 5; else e_ = 6; this->f = 7; p->g_ = 8; h.i_ = 9;
      m_j = 1; mKay = 2; local = 3; n_ <= 5; o_ != 6; auto & q_ = r; s_ = t_ = 7; w_ >= 2; mission = 3; compute(x); }"""
    found = Relevance(body, 0, len(body))
    assert found.level is not Level.WHOLE
    assert found.sets == ("a_", "b_", "d_", "e_", "f", "local", "mKay", "m_j", "mission", "s_", "t_")


def test_of_what_is_lowered_whole_nothing_is_left_out():
    body = (
        b'{ a_ = 1; pub_ = create_publisher<String>("topic", 1); a_ = compute(3, 4) + compute(5, 6) * compute(7, 8); }'
    )
    assert Relevance(body, 0, len(body)).sets == ()


@pytest.mark.parametrize(
    "line",
    [
        "auto future = client_->async_send_request(request);",
        "auto handle = client_->async_send_goal(goal);",
        "const std::chrono::nanoseconds period = get_nanos_from_secs_parameter(this, name);",
        "params->hz = getRosParam<int>(name, nh);",
    ],
)
def test_declarations_that_send_or_read_a_parameter_may_lead(line: str) -> None:
    text = b"{ " + b"double a = b * 2.0; if (a > 3.0) { a -= 1.0; } " * 4 + line.encode() + b" }"
    found = Relevance(text, 0, len(text))
    assert found.level is Level.CALLS
    start = text.index(line.encode())
    assert found.may_lead(start, start + len(line))


def test_a_main_function_is_lowered_whole() -> None:
    body = b"{ " + b"QApplication app(argc, argv); MainWindow window(argc, argv); window.show(); " * 3 + b"}"
    text = b"int main(int argc, char ** argv) " + body
    start = text.index(b"{")
    assert Relevance(text, start, len(text), head=0).level is Level.WHOLE
    other = b"int domain(int argc, char ** argv) " + body
    assert Relevance(other, other.index(b"{"), len(other), head=0).level is not Level.WHOLE


@pytest.mark.parametrize(
    "body",
    [
        "std::string & r = topic_; r = std::to_string(1);",
        "auto * r = &topic_; *r = std::to_string(1);",
        "auto & r = this->topic_; r += std::to_string(1);",
    ],
)
def test_what_is_set_under_another_name_is_set(body: str):
    source = f"{{ double x = 1.5; {'x = x * x + x / 2.0; ' * 8} {body} }}".encode()
    relevance = Relevance(source, 0, len(source))
    assert relevance.level is not Level.WHOLE
    assert "topic_" in relevance.sets


def test_what_another_name_is_only_read_of_is_not_set():
    source = f"{{ double x = 1.5; {'x = x * x + x / 2.0; ' * 8} const auto & r = topic_; auto * p = &name_; }}".encode()
    relevance = Relevance(source, 0, len(source))
    assert not {"topic_", "name_"} & set(relevance.sets)
