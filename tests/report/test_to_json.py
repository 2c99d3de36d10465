"""The JSON report: what the schema says, in a fixed order, a line per item."""

import io
import json
import tracemalloc
from pathlib import Path

import jsonschema
import pytest

from roslens.model.entity import EntityKind
from roslens.model.finding import Finding, Severity
from roslens.model.quantity import Better, Fold
from roslens.model.result import WorkspaceResult
from roslens.model.source import Language, Role
from roslens.model.tags import parse_tags
from roslens.report.run.to_json import SCHEMA, write_json

DOCUMENT = Path(__file__).parents[2] / "docs" / "reference" / "report.schema.json"
EXPECTED = Path(__file__).parents[1] / "fixtures" / "report" / "small.json"


def written(view, tags=None):
    stream = io.StringIO()
    write_json(view, stream, tags)
    return stream.getvalue()


@pytest.fixture(scope="module")
def schema():
    return json.loads(DOCUMENT.read_text("utf-8"))


def strict(node):
    """Return the schema with no key allowed that it does not name."""
    if isinstance(node, list):
        return [strict(item) for item in node]
    if not isinstance(node, dict):
        return node
    closed = {key: strict(value) for key, value in node.items()}
    if "properties" in closed and "additionalProperties" not in closed:
        closed["additionalProperties"] = False
    return closed


def test_the_small_run_is_written_as_expected(view):
    assert written(view) == EXPECTED.read_text("utf-8")


def test_the_schema_is_a_schema(schema):
    jsonschema.Draft202012Validator.check_schema(schema)
    assert schema["properties"]["schema"]["const"] == SCHEMA


def test_the_report_is_what_the_schema_says(schema, view, view_of, sample):
    validator = jsonschema.Draft202012Validator(strict(schema))
    validator.validate(json.loads(written(view)))
    large = view_of(sample.large(3), WorkspaceResult(rules=sample.RULES), sample.header())
    validator.validate(json.loads(written(large)))
    nothing = json.loads(written(view_of([], WorkspaceResult(), sample.header())))
    validator.validate(nothing)
    assert nothing["packages"] == nothing["measurements"] == []


def test_the_schema_knows_every_word_of_the_model(schema):
    kinds = schema["$defs"]
    assert kinds["kind"]["enum"] == [kind.value for kind in EntityKind]
    assert kinds["severity"]["enum"] == [severity.value for severity in Severity]
    assert kinds["file"]["properties"]["language"]["enum"] == [language.value for language in Language]
    assert kinds["file"]["properties"]["role"]["enum"] == [role.value for role in Role]
    assert kinds["quantity"]["properties"]["better"]["enum"] == [better.value for better in Better]
    assert kinds["quantity"]["properties"]["folds"]["items"]["enum"] == [fold.value for fold in Fold]


def test_the_keys_and_their_order(view):
    report = json.loads(written(view))
    assert list(report)[:8] == [
        "schema",
        "run",
        "packages",
        "files",
        "entities",
        "measurements",
        "findings",
        "failures",
    ]
    judged, other, _cycle = report["findings"]
    assert set(judged) - set(other) == {"model", "quantity", "value", "bound"}
    assert [entity.get("approximate") for entity in report["entities"]] == [None, None, None, None, True]


def test_whole_numbers_are_written_as_integers(view_of, sample):
    arm = sample.arm()
    values = {"a": 3.0, "b": 3, "c": 2.5, "d": 1e300, "e": -0.0, "f": float("nan"), "g": 2**70, "h": float("inf")}
    package = type(arm.entities[0])("package:arm", EntityKind.PACKAGE, "arm", values=values)
    finding = Finding("r", Severity.NOTE, "m", quantity="a", value=3.0, bound=float("inf"), model="m")
    view = view_of([("key", type(arm)(arm.package, (), (package,), (finding,)))], WorkspaceResult(), sample.header())
    text = written(view)
    report = json.loads(text)
    found = {item["quantity"]: item["value"] for item in report["measurements"]}
    assert found == {"a": 3, "b": 3, "c": 2.5, "d": 1e300, "e": 0, "g": 2**70}
    assert '"quantity":"a","value":3}' in text
    assert report["packages"][0]["metrics"]["a"] == 3
    assert '"a":3,"b":3,"c":2.5' in text
    assert report["findings"][0]["value"] == 3
    assert "bound" not in report["findings"][0]


def test_two_runs_differ_in_their_times_only(view_of, sample):
    units = [("unit-drive", sample.drive()), ("unit-arm", sample.arm())]
    one = written(view_of(units, sample.workspace(), sample.header()))
    again = sample.header(started="2030-01-01T00:00:00+00:00", seconds=99.0)
    two = written(view_of(reversed(units), sample.workspace(), again))
    assert one != two
    assert two.replace("2030-01-01", "2024-05-01").replace("T00:00", "T10:00").replace("99.0", "1.5") == one


def test_tags_choose_findings_and_nothing_else(view):
    everything, chosen = json.loads(written(view)), json.loads(written(view, parse_tags("ros or style and not x")))
    assert [finding["rule"] for finding in chosen["findings"]] == ["ros.cyclomatic_complexity", "style.tabs"]
    assert chosen["run"].pop("tags") == "ros or style and not x"
    assert everything["run"].pop("tags") == ""
    del chosen["findings"], everything["findings"]
    assert chosen == everything


def test_names_from_source_are_quoted(view_of, sample):
    arm = sample.arm()
    odd = 'a "quoted" \\ name\n\twith \x00 control and ünïcode ✓ 🤖'
    entity = type(arm.entities[0])(f"function:{odd}", EntityKind.FUNCTION, odd, odd, values={"loc": 1})
    view = view_of([("key", type(arm)(arm.package, (), (entity,)))], WorkspaceResult(), sample.header())
    report = json.loads(written(view))
    assert report["entities"][0]["name"] == odd
    assert report["measurements"][0]["entity"] == f"function:{odd}"


def test_each_item_stands_on_a_line(view):
    lines = written(view).splitlines()
    assert sum(line.startswith('{"rule":') for line in lines) == 3
    assert sum(line.startswith('{"entity":') for line in lines) == 8


def test_a_stream_of_another_encoding_still_gets_utf8(view_of, sample):
    arm = sample.arm()
    package = type(arm.package)("ärm", "ärm", "src/ärm", arm.package.manifest)
    view = view_of([("key", type(arm)(package))], WorkspaceResult(), sample.header())
    raw = io.BytesIO()
    stream = io.TextIOWrapper(raw, encoding="ascii")
    write_json(view, stream)
    stream.flush()
    assert json.loads(raw.getvalue().decode("utf-8"))["packages"][0]["name"] == "ärm"


@pytest.mark.heavy
def test_a_large_report_takes_little_memory(tmp_path, sample, view_of):
    view = view_of(sample.large(100), WorkspaceResult(rules=sample.RULES), sample.header())
    tracemalloc.start()
    with (tmp_path / "report.json").open("w", encoding="utf-8") as stream:
        write_json(view, stream)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert (tmp_path / "report.json").stat().st_size > 50_000_000
    assert peak < 12_000_000
