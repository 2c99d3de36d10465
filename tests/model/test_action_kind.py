import msgspec

from roslens.model.acting.action_kind import ACTION_KINDS, ArgumentType, By, action_kind
from roslens.model.entity import EntityKind


def test_every_kind_is_found_by_a_key_of_its_own():
    keys = [one.key for one in ACTION_KINDS]
    assert len(set(keys)) == len(keys)
    assert [action_kind(key) for key in keys] == list(ACTION_KINDS)
    assert action_kind("reboot") is None


def test_every_kind_and_argument_says_what_it_is():
    for kind in ACTION_KINDS:
        assert kind.summary.endswith(".")
        assert kind.details.endswith("."), kind.key
        names = [one.name for one in kind.arguments]
        assert len(set(names)) == len(names)
        assert all(one.text.endswith(".") for one in kind.arguments), kind.key
        assert "target" not in names, "is said beside the arguments"


def test_defaults_are_among_the_choices_and_required_arguments_have_none():
    for kind in ACTION_KINDS:
        for one in kind.arguments:
            assert not (one.required and one.default is not None), (kind.key, one.name)
            assert (one.type is ArgumentType.CHOICE) <= bool(one.choices)
            if one.choices and one.default is not None:
                reported = (one.default,) if one.type is ArgumentType.CHOICE else one.default
                assert set(reported) <= set(one.choices)
            msgspec.json.encode(one.default)


def test_what_a_host_does_is_done_to_something_on_it():
    for kind in ACTION_KINDS:
        if kind.by is By.HOST:
            assert kind.needs_target
            assert set(kind.targets) <= {EntityKind.NODE, EntityKind.HOST}


def test_defaults_are_filled_in_and_what_is_given_stays():
    kind = action_kind("restart")
    assert kind.filled({"grace": 1.0}) == {
        "grace": 1.0,
        "kill_after": 5.0,
        "whole_process": False,
        "after_orderly_end": False,
    }
    assert kind.argument("grace").default == 5.0
    assert kind.argument("nothing") is None
