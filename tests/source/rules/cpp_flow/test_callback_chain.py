"""From which callback a place is reached, through helpers and lambdas of the file."""

import pytest

from roslens.model.source import Language
from roslens.source.parsed_file import parse_file
from roslens.source.rules.cpp_flow.callback_chain import chain_to
from roslens.source.settings import MacroSettings

CODE = """
Arm::Arm() : Node("arm") {
  a_ = create_wall_timer(1s, std::bind(&Arm::tick, this));
  b_ = create_wall_timer(1s, [this] { deep(); });
  auto kept = [this] { in_kept(); };
  c_ = create_wall_timer(1s, kept);
  std::thread([this] { in_thread(); }).detach();
}
void Arm::tick() {
  helper();
  auto local = [&] { in_local(); };
  local();
  std::for_each(a.begin(), a.end(), [&](auto & one) { in_algorithm(one); });
  other_->theirs();
  recursive();
}
void Arm::helper() { this->deep(); }
void Arm::deep() { in_deep(); }
void Arm::theirs() { in_theirs(); }
void Arm::recursive() { recursive(); in_recursive(); }
void Leg::helper() { in_leg(); }
void free_one() { in_free(); }
void Arm::on_free() { free_one(); }
"""


def chain_of(name):
    view = parse_file(CODE.encode(), Language.CPP, MacroSettings()).view()
    at = CODE.index(name)
    return chain_to(view.node_at(at, at + len(name)), view)


@pytest.mark.parametrize(
    ("name", "callback", "helpers"),
    [
        ("in_deep", "Arm::deep", ()),
        ("in_kept", "", ()),
        ("in_local", "Arm::tick", ("local",)),
        ("in_algorithm", "Arm::tick", ()),
        ("in_recursive", "Arm::tick", ("Arm::recursive",)),
        ("helper();", "Arm::tick", ()),
    ],
)
def test_a_place_is_reached(name, callback, helpers):
    chain = chain_of(name)
    assert chain is not None
    assert (chain.callback, chain.helpers) == (callback, helpers)


def test_what_a_method_of_another_object_does_is_not_followed():
    assert chain_of("in_theirs").callback == "Arm::theirs"


def test_a_helper_of_another_class_is_not_followed():
    assert chain_of("in_leg").callback == "Leg::helper"


def test_a_function_that_is_registered_elsewhere_may_be_the_callback():
    assert chain_of("in_free").callback == "free_one"


def test_a_thread_is_no_callback():
    assert chain_of("in_thread") is None
