"""Names in texts of references lead to what runs; patterns and other words stay text."""

from __future__ import annotations

import re

import pytest

from roslens.dashboard.live.named_entities import linked


@pytest.mark.parametrize(
    ("text", "entities"),
    [
        ("node /lidar is gone or stopped", ["node:/lidar"]),
        ("restart node:/rover/lidar; if that does not help within 15 s, it is given up", ["node:/rover/lidar"]),
        ("(topic /scan is low or host base is high), for 5 s", ["topic:/scan", "host:base"]),
        ("at least 2 of: node /a is gone, node /b.c is gone", ["node:/a", "node:/b.c"]),
        ("topic /scan on base, without /tmp", ["topic:/scan"]),
        ("field status.level of /diagnostics", ["topic:/diagnostics"]),
        ("data over /scan > /map > /cmd_vel", ["topic:/scan", "topic:/map", "topic:/cmd_vel"]),
        ("node /* is gone", []),
        ("topic /sonar/{left,right}", []),
        ("topic /camera_? is low", []),
        ("host * is high", []),
        ("notify (text: the host is slow)", []),
        ("node lidar", []),
    ],
)
def test_whole_names_are_links(text, entities):
    found = linked(text, "/live/")
    assert re.findall(r'href="/live/\?select=([^"]+)"', found) == [one.replace(":", "%3A") for one in entities]
    assert re.sub(r"<[^>]+>", "", found) == text.replace(">", "&gt;")


def test_everything_else_is_escaped_and_without_a_page_nothing_is_a_link():
    hostile = '<img src=x> node /lidar">'
    assert "<img" not in linked(hostile, "/live/")
    assert "<a" not in linked(hostile, "")
    assert "<img" not in linked(hostile, "")
