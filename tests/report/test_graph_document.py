import json
from pathlib import Path

import jsonschema
import pytest

from roslens.model.errors import DocumentError
from roslens.report.graph.graph_document import graph_schema, read_graph_json, to_graph_json

DOCUMENT = Path(__file__).parents[2] / "docs" / "reference" / "graph.schema.json"


def test_what_is_written_is_read_back(graph):
    assert read_graph_json(to_graph_json((graph,)).encode(), "a.json") == (graph,)


def test_what_is_written_is_what_the_schema_says(graph):
    jsonschema.validate(json.loads(to_graph_json((graph,))), graph_schema())


def test_the_published_schema_is_that_of_the_code():
    assert json.loads(DOCUMENT.read_text("utf-8")) == json.loads(json.dumps(graph_schema()))


@pytest.mark.parametrize("content", [b"", b"[]", b'{"schema": "x/1", "configurations": []}'])
def test_other_files_are_refused(content):
    with pytest.raises(DocumentError, match="a\\.json"):
        read_graph_json(content, "a.json")
