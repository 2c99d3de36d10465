import json

import jsonschema

from roslens.live.publish.exported.foxglove_layout import MOST_PLOTS, foxglove_layout

NODE = {
    "anyOf": [
        {"type": "string", "pattern": "^[A-Za-z]+![A-Za-z0-9]+$"},
        {
            "type": "object",
            "required": ["first", "second", "direction", "splitPercentage"],
            "properties": {
                "first": {"$ref": "#/$defs/node"}, "second": {"$ref": "#/$defs/node"},
                "direction": {"enum": ["row", "column"]},
                "splitPercentage": {"exclusiveMinimum": 0, "exclusiveMaximum": 100},
            },
            "additionalProperties": False,
        },
    ]
}  # fmt: skip
SHAPE = {
    "$defs": {"node": NODE},
    "type": "object",
    "required": ["configById", "globalVariables", "userNodes", "playbackConfig", "layout"],
    "properties": {"layout": {"$ref": "#/$defs/node"}, "configById": {"type": "object"}},
}


def named(node):
    return [node] if isinstance(node, str) else [*named(node["first"]), *named(node["second"])]


def test_the_layout_has_the_shape_that_foxglove_reads(rover):
    text, _ = foxglove_layout(rover)
    layout = json.loads(text)
    jsonschema.validate(layout, SHAPE)
    assert sorted(named(layout["layout"])) == sorted(layout["configById"])


def test_values_and_fields_are_plotted_with_their_bounds(rover):
    panels = json.loads(foxglove_layout(rover, "/rated")[0])["configById"]
    plots = {
        panel["title"]: [path["value"] for path in panel["paths"]]
        for name, panel in panels.items()
        if name.startswith("Plot")
    }
    [scan] = [paths for title, paths in plots.items() if title.startswith("topic /scan: rate")]
    assert scan == [
        f'/rated.signals[:]{{constraint=="rover.topic.scan.rate"}}.{field}' for field in ("value", "low", "high")
    ]
    [field] = [paths for title, paths in plots.items() if title.startswith("field ranges[0]")]
    assert field == ["/scan.ranges[0]", "0.1", "30"]


def test_what_is_not_plotted_is_told(rover):
    text, left = foxglove_layout(rover)
    plots = sum(name.startswith("Plot") for name in json.loads(text)["configById"])
    assert plots <= MOST_PLOTS
    assert any("is always there" in line for line in left)
