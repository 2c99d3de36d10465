"""Sections of a document: typed values, unknown keys, places."""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum
from pathlib import Path

import pytest

from roslens.judge.documents.document import Section, read_document
from roslens.model.errors import DocumentError

KEYS = {"name": "its name", "limit": "a number", "tags": "texts", "colour": "a choice", "parts": "a list"}
PART_KEYS = {"size": "a number"}


class Colour(str, Enum):
    RED = "red"
    GREEN = "green"


@pytest.fixture
def read(tmp_path: Path) -> Callable[[str], Section]:
    def read(text: str) -> Section:
        path = tmp_path / "m.yaml"
        path.write_text(text, "utf-8")
        return read_document(path, "thing", KEYS, shown="m.yaml")

    return read


def fault(call: Callable[[], object]) -> str:
    with pytest.raises(DocumentError) as caught:
        call()
    return str(caught.value)


@pytest.mark.parametrize("text", ["no", "1.10", "on", "0x1F", "12:30", "'quoted'", "2024-01-01"])
def test_texts_are_what_is_written(read: Callable[[str], Section], text: str):
    assert read(f"name: {text}").text("name") == text.strip("'")


def test_defaults_stand_where_a_key_is_not(read: Callable[[str], Section]):
    section = read("name: x")
    assert section.text("colour", "blue") == "blue"
    assert section.number("limit") is None
    assert section.texts("tags") == ()
    assert section.choice("colour", Colour, Colour.RED) is Colour.RED
    assert section.sections("parts", "part", PART_KEYS) == ()
    assert "name" in section
    assert "limit" not in section


@pytest.mark.parametrize(
    ("text", "number"),
    [("15", 15), ("-1", -1), ("+2.5", 2.5), ("1e3", 1000), (".5", 0.5), ("3.", 3)],
)
def test_numbers(read: Callable[[str], Section], text: str, number: float):
    assert read(f"limit: {text}").number("limit") == number


@pytest.mark.parametrize(
    "text", ["abc", "0x10", "1_000", "12:30", ".inf", ".nan", "true", "[1]", "{a: 1}", "1 2", "'15'"]
)
def test_what_is_no_number_is_refused(read: Callable[[str], Section], text: str):
    section = read(f"limit: {text}")
    assert fault(lambda: section.number("limit")).startswith("m.yaml:1:8: limit is ")


def test_a_number_in_quotes_says_so(read: Callable[[str], Section]):
    section = read("limit: '15'")
    message = "m.yaml:1:8: limit is '15'; expected a number. Remove the quotes"
    assert fault(lambda: section.number("limit")) == message


def test_a_single_text_is_a_list_of_one(read: Callable[[str], Section]):
    assert read("tags: one").texts("tags") == ("one",)
    assert read("tags: [one, two]").texts("tags") == ("one", "two")
    assert read("tags: []").texts("tags") == ()


def test_choices(read: Callable[[str], Section]):
    assert read("colour: green").choice("colour", Colour, Colour.RED) is Colour.GREEN
    section = read("colour: gren")
    message = "m.yaml:1:9: colour is 'gren'; expected one of red, green. Did you mean 'green'?"
    assert fault(lambda: section.choice("colour", Colour, Colour.RED)) == message
    limited = read("colour: red")
    message = fault(lambda: limited.choice("colour", Colour, among=(Colour.GREEN,)))
    assert message == "m.yaml:1:9: colour is 'red'; expected one of green"


def test_a_choice_without_default_is_required(read: Callable[[str], Section]):
    section = read("name: x")
    assert fault(lambda: section.choice("colour", Colour)) == (
        "m.yaml:1:1: a thing without 'colour'; expected the line `colour: …`"
    )


@pytest.mark.parametrize(
    ("text", "call", "message"),
    [
        ("limit: 1", lambda s: s.text("name"), "m.yaml:1:1: a thing without 'name'; expected the line `name: …`"),
        ("name:", lambda s: s.text("name"), "m.yaml:1:1: name has no value; expected a value behind the colon"),
        ("name: [a]", lambda s: s.text("name"), "m.yaml:1:7: name is a list; expected a text"),
        ("name: {a: 1}", lambda s: s.text("name"), "m.yaml:1:7: name is a table; expected a text"),
        ("tags: [a, [b]]", lambda s: s.texts("tags"), "m.yaml:1:11: tags is a list; expected a list of texts"),
        ("tags: [a, ~]", lambda s: s.texts("tags"), "m.yaml:1:11: tags is nothing; expected a list of texts"),
        ("parts: x", lambda s: s.sections("parts", "part", PART_KEYS), "m.yaml:1:8: parts is 'x'; expected a list"),
        ("parts: [x]", lambda s: s.sections("parts", "part", PART_KEYS), "m.yaml:1:9: parts is 'x'; expected a part"),
        (
            "parts:\n  - size: 1\n  - siz: 2\n",
            lambda s: s.sections("parts", "part", PART_KEYS),
            "m.yaml:3:5: unknown key 'siz' of a part; expected one of size. Did you mean 'size'?",
        ),
    ],
)
def test_wrong_values_say_where(
    read: Callable[[str], Section], text: str, call: Callable[[Section], object], message: str
):
    section = read(text)
    assert fault(lambda: call(section)).startswith(message)


def test_an_unknown_key_names_the_valid_ones_and_the_nearest(read: Callable[[str], Section]):
    assert fault(lambda: read("name: x\nlimmit: 3\n")) == (
        "m.yaml:2:1: unknown key 'limmit' of a thing; expected one of name, limit, tags, colour, parts. "
        "Did you mean 'limit'?"
    )


def test_a_fault_of_a_key_that_is_not_there_points_at_its_section(read: Callable[[str], Section]):
    second = read("parts:\n  - size: 1\n  - size: 2\n").sections("parts", "part", PART_KEYS)[1]
    assert second.line() == 3
    assert second.fault("other", "what").where == "m.yaml:3:5"
    assert second.fault("size", "what").where == "m.yaml:3:11"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "m.yaml: the file is empty; expected a thing in YAML"),
        ("- a\n", "m.yaml:1:1: the file holds a list; expected a thing: `key: value` lines with name"),
        ("just text", "m.yaml:1:1: the file holds 'just text'; expected a thing"),
    ],
)
def test_files_that_hold_something_else(read: Callable[[str], Section], text: str, message: str):
    assert fault(lambda: read(text)).startswith(message)


def test_a_missing_file_and_a_folder(tmp_path: Path):
    gone = tmp_path / "gone.yaml"
    assert fault(lambda: read_document(gone, "thing", KEYS)) == (
        f"{gone}: cannot read it: No such file or directory; expected a thing in YAML. Check the path"
    )
    assert "cannot read it: Is a directory" in fault(lambda: read_document(tmp_path, "thing", KEYS))
