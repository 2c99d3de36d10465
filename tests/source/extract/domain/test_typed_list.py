from roslens.source.extract.domain.typed_list import TypedList


def test_it_is_a_list_that_knows_its_type():
    found = TypedList([1.0], "double_array")
    assert (found, found.type) == ([1.0], "double_array")
    assert TypedList().type == ""
