"""What a reference drafted from running nodes reports of their faults: some here, all by `make faults`."""

from __future__ import annotations

import pytest
from drafted.faults import KINDS
from drafted.table import NODES, rows
from wrong_ok.scene import Scene

pytestmark = [pytest.mark.real, pytest.mark.slow]
SOME = ["80 ms late", "killed", "second publisher", "parameter changed", "inactive"]


@pytest.fixture
def scene(tmp_path, python):
    """A robot of its own on this host."""
    found = Scene(tmp_path, python, NODES)
    yield found
    found.close()


@pytest.mark.timeout(300)
def test_a_draft_reports_late_messages_parameters_and_states(scene):
    healthy, *found = rows(scene, 20.0, SOME)
    assert healthy.told == ""
    assert [one.kind for one in found if not one.told or not one.well] == []


@pytest.mark.table
@pytest.mark.timeout(900)
def test_a_draft_reports_every_kind(scene):
    healthy, *found = rows(scene, 60.0, list(KINDS))
    assert healthy.told == ""
    assert [one.kind for one in found if not one.told or not one.well] == []
