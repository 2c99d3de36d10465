"""Who is a callback, and of what: names that other files of the package look up."""

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.callbacks import STREAM, callback_around, callbacks_of, function_name
from roslens.source.settings import MacroSettings


def view_of(text, language=Language.CPP):
    return parse_file(text.encode(), language, MacroSettings()).view()


CPP = """
Arm::Arm() {
  a_ = create_subscription<Goal>("a", 1, std::bind(&Arm::on_goal, this, _1));
  b_ = create_service<Open>("b", std::bind(&Arm::on_open, this, _1, _2));
  c_ = create_wall_timer(1s, [this] { tick(); });
  d_ = create_wall_timer(1s, [this] { d_->cancel(); once(); });
  e_ = nh.subscribe("e", 1, &arm::Arm::on_old, this);
}
"""
PYTHON = """
class Arm(Node):
    def __init__(self):
        self.a = self.create_subscription(Goal, "a", self.on_goal, 10)
        self.b = self.create_service(Open, "b", self.on_open)
        self.c = self.create_timer(1.0, lambda: self.tick(3))
        self.d = self.create_timer(1.0, callback=functools.partial(self.tock, 3))
        rospy.Subscriber("e", Goal, on_goal)
"""


def test_callbacks_of_streams_are_named_once_more():
    found = callbacks_of(view_of(CPP))
    assert {one for one in found if not one.startswith(STREAM)} == {
        *("Arm::on_goal", "Arm::on_open", "Arm::tick", "Arm::once", "Arm::on_old")
    }
    assert {one.removeprefix(STREAM) for one in found if one.startswith(STREAM)} == {
        *("Arm::on_goal", "Arm::tick", "Arm::on_old")
    }


def test_partial_and_lambda_hand_over_what_they_call():
    found = callbacks_of(view_of(PYTHON, Language.PYTHON))
    assert {"Arm.on_goal", "Arm.on_open", "Arm.tick", "Arm.tock", "on_goal"} <= set(found)
    assert f"{STREAM}Arm.tock" in found
    assert f"{STREAM}Arm.on_open" not in found


def test_what_a_callback_hands_to_a_thread_is_no_callback():
    code = (
        "Arm::Arm() {{ s_ = rclcpp_action::create_server<A>(this, n, goal, cancel, [this](Handle h) {{ {0} }}); }}\n"
        "void Arm::execute(Handle h) {{}}"
    )
    assert "Arm::execute" in callbacks_of(view_of(code.format("execute(h);")))
    assert "Arm::execute" not in callbacks_of(view_of(code.format("std::thread([this, h] { execute(h); }).detach();")))
    assert "Arm::execute" not in callbacks_of(view_of(code.format("auto run = [this, h] { execute(h); }; start(run);")))


@pytest.mark.parametrize(
    ("text", "of_stream", "expected"),
    [
        ("void Arm::f() { here(); }", False, "Arm::f"),
        ("void Arm::f() { here(); }", True, f"{STREAM}Arm::f"),
        ("void Arm::f() { create_wall_timer(1s, [] { here(); }); }", True, ""),
        ("void Arm::f() { create_service<A>(n, [] { here(); }); }", False, ""),
        ("void Arm::f() { create_service<A>(n, [] { here(); }); }", True, None),
        ("void Arm::f() { std::thread([] { here(); }); }", False, None),
        ("int x = here();", False, None),
    ],
)
def test_what_has_to_be_a_callback_for_a_place_to_run_in_one(text, of_stream, expected):
    view = view_of(text)
    at = view.code.index(b"here")
    assert callback_around(view.node_at(at, at + 4), view, of_stream=of_stream) == expected


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("void a::b::Arm<T>::f() { here(); }", "Arm::f"),
        ("class Arm { void f() { here(); } };", "Arm::f"),
        ("void f() { here(); }", "f"),
        ("Arm::Arm() : a_(1) { here(); }", "Arm::Arm"),
    ],
)
def test_a_function_is_named_by_its_last_two_parts(text, expected):
    view = view_of(text)
    node = view.root.descendant_for_byte_range(view.code.index(b"here"), view.code.index(b"here") + 4)
    while node.type != "function_definition":
        node = node.parent
    assert function_name(node, view) == expected
