"""The end of the line on which a process with ROS receives what to do: orders in, replies out, until the line ends."""

from __future__ import annotations

import os
from collections.abc import Callable

from roslens.live.act.orders import Orders
from roslens.model.acting.order import Order, OrderError, OrderReader, Reply, encode_order

_PIECE = 65_536


def serve(incoming: int, replies: int, make: Callable[[Callable[[Reply], None]], Orders]) -> None:
    """Carry out what comes on the descriptor ``incoming``, and write to ``replies`` what became of it.

    ``make`` returns what carries out, given what says.
    """

    def say(reply: Reply) -> None:
        body = memoryview(encode_order(reply))
        while body:
            body = body[os.write(replies, body) :]

    orders = make(say)
    reader: OrderReader[Order] = OrderReader(Order)
    try:
        while piece := os.read(incoming, _PIECE):
            for order in reader.feed(piece):
                orders.take(order)
    except (OrderError, BrokenPipeError) as error:
        os.write(2, f"error: {error}\n".encode())
    finally:
        orders.close()
