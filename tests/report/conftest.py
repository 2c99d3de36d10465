"""Runs to report."""

import importlib.util
from pathlib import Path

import pytest

from roslens.store.runs import Store

SAMPLE = Path(__file__).parents[1] / "fixtures" / "report" / "sample.py"


@pytest.fixture(scope="session")
def sample():
    spec = importlib.util.spec_from_file_location("report_sample", SAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def view_of():
    """Return a function that keeps results (by key) in memory and returns the view of the run."""
    stores = []

    def keep(units, workspace, header):
        store = Store.open(None)
        stores.append(store)
        with store.writing(header) as writer:
            for key, result in units:
                writer.add(key, result)
            return store.view(writer.complete(workspace, header))

    yield keep
    for store in stores:
        store.close()


@pytest.fixture
def view(sample, view_of):
    return view_of([("unit-drive", sample.drive()), ("unit-arm", sample.arm())], sample.workspace(), sample.header())


@pytest.fixture
def graph():
    path = SAMPLE.with_name("graph.py")
    spec = importlib.util.spec_from_file_location("report_graph", path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.configuration()
