import pytest

from roslens.model.acting.order import MAX_BYTES, VERSION, Order, OrderError, OrderReader, Reply, Verb, encode_order

ORDER = Order(VERSION, "r/1.0", Verb.DO, "publish", "", {"fields": {"data": [True, 1.5, "a"]}})


@pytest.mark.parametrize("size", [1, 7, 1000])
def test_frames_come_through_in_any_pieces(size):
    stream = encode_order(ORDER) * 3
    reader = OrderReader(Order)
    found = [one for at in range(0, len(stream), size) for one in reader.feed(stream[at : at + size])]
    assert found == [ORDER] * 3


@pytest.mark.parametrize(
    "stream",
    [
        b"\xff\xff\xff\xff",
        b"\0\0\0\2\x90\x90",
        encode_order(Reply(VERSION, "a", Verb.DO, True)),
        encode_order(Order(VERSION + 1, "a", Verb.DO)),
    ],
)
def test_what_is_no_order_ends_the_line(stream):
    with pytest.raises(OrderError, match=r"expected|not an order"):
        list(OrderReader(Order).feed(stream))


def test_what_cannot_be_told_is_not_sent():
    with pytest.raises(OrderError, match="bytes"):
        encode_order(Order(VERSION, "a", Verb.DO, "publish", "", {"text": "x" * MAX_BYTES}))
    with pytest.raises(OrderError, match="cannot be sent"):
        encode_order(Order(VERSION, "a", Verb.DO, "publish", "", {"value": object()}))
