"""What the reference says of reports holds."""

import io
import json
import re
from pathlib import Path

from roslens.report.run.to_csv import TABLES, write_table
from roslens.report.run.to_json import write_json

PAGE = (Path(__file__).parents[2] / "docs" / "reference" / "report.md").read_text("utf-8")


def keys(text):
    return [key for group in re.findall(r"`([\w, ]+)`", text) for key in group.split(", ")]


def test_the_keys_of_the_json_report(view):
    stream = io.StringIO()
    write_json(view, stream)
    report = json.loads(stream.getvalue())
    reported = dict(re.findall(r"^\| `(\w+)` \| (.*) \|$", PAGE, re.MULTILINE))
    for name, items in report.items():
        if name == "schema":
            continue
        found = {key for item in (items if isinstance(items, list) else [items]) for key in item}
        assert set(keys(reported[name])) == found, name


def test_the_columns_of_the_tables(view):
    reported = dict(re.findall(r"^\| `(\w+)\.csv` \| (.*) \|$", PAGE, re.MULTILINE))
    assert set(reported) == set(TABLES)
    for name, text in reported.items():
        stream = io.StringIO()
        write_table(view, name, stream)
        head = stream.getvalue().splitlines()[0].split(",")
        expected = keys(text)
        assert head[: len(expected)] == expected, name
        assert (len(head) > len(expected)) is ("every quantity" in text), name
