import pytest

from roslens.live.system.shown_rows import is_shown
from roslens.live.system.tree import SystemView


@pytest.mark.parametrize(
    ("kind", "name", "worth"),
    [
        ("topic", "/scan", True),
        ("topic", "/rosout", False),
        ("topic", "/parameter_events", False),
        ("topic", "/statistics", False),
        ("topic", "/planner/transition_event", False),
        ("service", "/planner/get_parameters", False),
        ("service", "/planner/set_map", True),
        ("service", "/get_map", True),
        ("process", "base/7", False),
        ("node", "/rosout", True),
        ("host", "base", True),
        ("connection", "/a > /rosout > /b", True),
        ("connection", "/a > /scan > ?", False),
        ("connection", "? > /scan > /b", True),
        ("connection", "/a > /scan > \\?", True),
    ],
)
def test_what_all_nodes_have_is_left_out_unless_it_is_judged(kind, name, worth):
    assert is_shown(SystemView(f"{kind}:{name}", name, kind)) is worth
    assert is_shown(SystemView(f"{kind}:{name}", name, kind, counts={"ok": 1}))
