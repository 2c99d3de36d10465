"""The tests of the store, on a shared one: what holds of a file holds of a database."""

import importlib.util
import inspect
from itertools import count
from pathlib import Path

import pytest

from roslens.store.runs import Store

_NUMBERS = count()
_OF_FILES = {
    # What is about a file, its folder or SQLite itself.
    "test_a_new_store_is_empty_and_its_folder_marked",
    "test_a_folder_of_another_name_gets_the_store_only",
    "test_a_store_that_cannot_be_changed_can_be_read",
    "test_a_file_that_is_no_database_is_left_alone",
    "test_a_place_where_no_store_can_be",
    "test_runs_share_one_and_the_last_takes_it_along",
}


def _loaded(name):
    path = Path(__file__).parents[1] / f"{name}.py"
    spec = importlib.util.spec_from_file_location(f"shared_{name}", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


_runs, _read, _summary, _configurations = map(
    _loaded, ("test_runs", "test_read", "test_summary", "test_configurations")
)
view = _read.view
write = _configurations.write


def _tests(module):
    for name, test in vars(module).items():
        if not name.startswith("test_") or name in _OF_FILES:
            continue
        source = inspect.getsource(test)
        if "sqlite3" in source or "stat()" in source or ".execute" in source or "write_bytes" in source:
            continue
        marks = [mark for mark in getattr(test, "pytestmark", []) if mark.name == "parametrize"]
        if len(marks) > 1:
            continue
        if not marks:
            yield pytest.param(test, {}, id=name)
            continue
        names, values = marks[0].args[:2]
        names = [one.strip() for one in names.split(",")] if isinstance(names, str) else list(names)
        for number, value in enumerate(values):
            given = dict(zip(names, value if len(names) > 1 else (value,), strict=True))
            yield pytest.param(test, given, id=f"{name}-{number}")


@pytest.fixture
def path(tmp_path):
    return tmp_path / ".roslens" / "store.sqlite"


@pytest.fixture(autouse=True)
def _shared(server, monkeypatch):
    """Have every path be a schema of the database."""
    schemas = {}

    def opened(path, *, wait_s=10.0):
        if path is None or path not in schemas:
            schemas[path] = f"s{next(_NUMBERS)}"
        return Store.open_shared(server.schema(schemas[path]), wait_s=wait_s)

    monkeypatch.setattr(Store, "open", opened)


@pytest.mark.real
@pytest.mark.parametrize(
    ("test", "given"), [one for module in (_runs, _read, _summary, _configurations) for one in _tests(module)]
)
def test_on_a_database(test, given, request):
    names = [name for name in inspect.signature(test).parameters if name not in given]
    test(**given, **{name: request.getfixturevalue(name) for name in names})
