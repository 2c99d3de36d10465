"""Runs to store."""

import importlib.util
from pathlib import Path

import pytest

SAMPLE = Path(__file__).parents[1] / "fixtures" / "report" / "sample.py"


@pytest.fixture(scope="session")
def sample():
    spec = importlib.util.spec_from_file_location("report_sample", SAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def write_small(sample):
    """Return a function that writes the small run into a store and returns its number."""

    def write(store, key="key-1", started="2024-05-01T10:00:00+00:00"):
        header = sample.header(key, started)
        with store.writing(header) as writer:
            writer.add("unit-drive", sample.drive())
            writer.add("unit-arm", sample.arm())
            return writer.complete(sample.workspace(), header)

    return write
