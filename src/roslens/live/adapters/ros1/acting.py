"""The process that acts in a ROS 1 system: orders on standard input, replies on standard output."""

from __future__ import annotations

import argparse
import os
import socket
import sys
import threading
from contextlib import suppress

from roslens.live.act.order_line import serve
from roslens.live.act.orders import Orders
from roslens.live.adapters.ros1.__main__ import DEFAULT_MASTER
from roslens.live.adapters.ros1.hand import Ros1Hand
from roslens.live.adapters.ros1.names import observer_name
from roslens.live.adapters.ros1.place import is_local, own_address
from roslens.live.adapters.ros1.publisher_updates import UpdateServer
from roslens.live.adapters.ros1.resolve import Resolver, UnresolvedError
from roslens.live.adapters.ros1.wire.message_form import MessageForms, share_folders
from roslens.live.adapters.ros1.wire.xml_rpc import CallError, split_uri


def main(words: list[str]) -> int:
    """Act until standard input ends; return the exit code."""
    parser = argparse.ArgumentParser(prog="python -m roslens.live.adapters.ros1.acting", description=__doc__)
    parser.add_argument("--master", metavar="URI", default=os.environ.get("ROS_MASTER_URI") or DEFAULT_MASTER)
    options = parser.parse_args(words)
    try:
        host, port = split_uri(options.master)
    except CallError as error:
        parser.error(f"--master: {error}")
    resolver = Resolver()
    towards = host
    with suppress(UnresolvedError):
        towards = resolver.address(host)
    own = own_address(os.environ, towards, port)
    at = ""
    with suppress(UnresolvedError):
        at = resolver.address(own)
    listened = at if is_local(at) else ""
    caller = observer_name(f"hand_{socket.gethostname()}", os.getpid())
    forms = MessageForms(share_folders(os.environ))
    hand = Ros1Hand(options.master, caller, resolver, forms, address=listened, own=own)
    updates = UpdateServer(listened, own, options.master, lambda _topic, _uris: None, hand.answers)
    hand.api = updates.uri
    threading.Thread(target=hand.follow, name="follow", daemon=True).start()
    try:
        serve(0, 1, lambda say: Orders(hand, say))
    finally:
        hand.close()
        updates.close()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
