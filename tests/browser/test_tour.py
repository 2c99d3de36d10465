"""The tour of the documentation has a picture of every station, and a station for every picture."""

import re
from pathlib import Path

from tour.screens import screens, stations_of
from tour.stations import STATIONS

TEXT = Path(__file__).parents[2].joinpath("docs/tour.md").read_text()


def test_every_picture_has_its_station_in_its_order():
    assert re.findall(r"\]\(\.\./build/tour/(\w+)\.png\)", TEXT) == [one.name for one in STATIONS], (
        "docs/tour.md and tests/tour/stations.py"
    )


def test_pictures_can_be_taken_of_every_kind_of_page(example_base):
    found = {one.name: one.path for one in screens(example_base)}
    assert {
        "overview", "graph", "computation_of_a_name", "packages", "packages_of_a_name", "files_of_a_name", "findings",
        "findings_by_group", "rules_of_a_name", "metrics_of_a_name", "nodes_of_a_name", "topics_of_a_name",
        "search_by_q",
    } <= found.keys()  # fmt: skip
    assert "*" not in found["topics_of_a_name"]


def test_what_runs_is_looked_at_with_something_selected_in_the_past_and_compared():
    snapshot = {"alerts": [{"entity": "topic:/scan"}], "rows": [{"entity": "host:rover"}]}
    timeline = {"first": 1.0, "last": 9.0, "marks": [{"time": 1.0}, {"time": 4.0}]}
    paths = [one.path for one in stations_of(snapshot, timeline)]
    assert paths == ["/live/?select=topic%3A/scan", "/live/?at=4.0", "/live/compared?from=1.0&to=4.0"]
    assert stations_of({}, {}) == ()
