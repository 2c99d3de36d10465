"""The tour of the documentation has a picture of every station, and a station for every picture."""

import re
from pathlib import Path

from tour.stations import STATIONS

TEXT = Path(__file__).parents[2].joinpath("docs/tour.md").read_text()


def test_every_picture_has_its_station_in_its_order():
    assert re.findall(r"\]\(\.\./build/tour/(\w+)\.png\)", TEXT) == [one.name for one in STATIONS], (
        "docs/tour.md and tests/tour/stations.py"
    )
