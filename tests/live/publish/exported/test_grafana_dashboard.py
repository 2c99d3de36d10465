import json
import re
import subprocess

import jsonschema
import pytest
import yaml

from roslens.live.publish.exported.grafana_dashboard import grafana_dashboard
from roslens.live.publish.prometheus import prometheus_text
from roslens.live.window.signals import BY_KEY
from roslens.model.entity import EntityId, EntityKind

SHAPE = {
    "type": "object",
    "required": ["title", "uid", "schemaVersion", "panels", "templating", "time"],
    "properties": {
        "uid": {"type": "string", "maxLength": 40},
        "panels": {
            "type": "array",
            "items": {
                "type": "object",
                "required": ["id", "type", "title", "gridPos"],
                "properties": {
                    "id": {"type": "integer"},
                    "type": {"enum": ["row", "stat", "table", "state-timeline", "timeseries"]},
                    "gridPos": {
                        "type": "object",
                        "required": ["x", "y", "w", "h"],
                        "properties": {"x": {"minimum": 0, "maximum": 23}, "w": {"minimum": 1, "maximum": 24}},
                    },
                    "targets": {
                        "type": "array",
                        "items": {"type": "object", "required": ["refId", "expr", "datasource"]},
                    },
                },
            },
        },
    },
}


def dashboard(reference):
    return json.loads(grafana_dashboard(reference)[0])


def expressions(reference):
    return [one["expr"] for panel in dashboard(reference)["panels"] for one in panel.get("targets", ())]


def test_the_dashboard_has_the_shape_that_grafana_reads(rover):
    found = dashboard(rover)
    jsonschema.validate(found, SHAPE)
    ids = [panel["id"] for panel in found["panels"]]
    assert len(ids) == len(set(ids))
    cells = [
        (panel["gridPos"]["x"] + x, panel["gridPos"]["y"] + y)
        for panel in found["panels"]
        for x in range(panel["gridPos"]["w"])
        for y in range(panel["gridPos"]["h"])
    ]
    assert len(cells) == len(set(cells))
    assert all(x < 24 for x, _ in cells)


def test_a_value_is_plotted_with_its_range(rover):
    [scan] = [panel for panel in dashboard(rover)["panels"] if panel["title"].startswith("topic /scan: rate")]
    assert scan["targets"][0]["expr"] == 'roslens_rate_hertz{topic="/scan",publisher=""}'
    defaults = scan["fieldConfig"]["defaults"]
    assert defaults["unit"] == "hertz"
    assert [step["value"] for step in defaults["thresholds"]["steps"]] == [None, 21.25, 28.75]


def test_the_metrics_are_those_that_are_served(rover):
    readings = [
        (EntityId(EntityKind.TOPIC, "/scan"), dict.fromkeys(BY_KEY, 1.0)),
    ]
    served = set(re.findall(r"^(roslens_\w+)\{", prometheus_text(readings, ()), re.MULTILINE)) | {"roslens_state"}
    asked = {name for text in expressions(rover) for name in re.findall(r"roslens_\w+(?=\{)", text)}
    assert asked <= served


def test_what_prometheus_cannot_select_is_told(rover):
    _, left = grafana_dashboard(rover)
    assert len(left) == 1
    assert "re:/scan(?#front)" in left[0]


@pytest.mark.real
def test_promtool_takes_every_expression(rover, promtool, tmp_path):
    rules = [{"record": f"probe:{number}", "expr": text} for number, text in enumerate(expressions(rover))]
    path = tmp_path / "probe.yml"
    path.write_text(yaml.safe_dump({"groups": [{"name": "probe", "rules": rules}]}))
    done = subprocess.run([promtool, "check", "rules", path], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
