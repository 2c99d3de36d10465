import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.model.entity import EntityId, EntityKind


@given(st.sampled_from(EntityKind), st.text(min_size=1))
def test_the_text_form_reads_back(kind: EntityKind, name: str):
    assert EntityId.parse(str(EntityId(kind, name))) == EntityId(kind, name)


@pytest.mark.parametrize("text", ["", "function", "function:", "nonsense:x"])
def test_what_is_no_id_is_refused(text: str):
    with pytest.raises(ValueError, match=r"entity id|EntityKind"):
        EntityId.parse(text)
