"""Names of connections can be read and cut again."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.live.system.connection_name import connection_ends, connection_id
from roslens.model.entity import EntityId, EntityKind

NAMES = st.text("ab/>?\\ \n", max_size=8)


def test_a_name_reads_as_the_way_of_the_data():
    assert str(connection_id("/scan", "/laser", "")) == "connection:/laser > /scan > ?"


@given(NAMES, NAMES, NAMES)
def test_every_name_comes_back(topic, publisher, subscriber):
    if topic not in ("", "?"):
        assert connection_ends(connection_id(topic, publisher, subscriber)) == (topic, publisher, subscriber)


def test_another_name_is_refused():
    with pytest.raises(ValueError, match="not a connection"):
        connection_ends(EntityId(EntityKind.CONNECTION, "/scan"))
