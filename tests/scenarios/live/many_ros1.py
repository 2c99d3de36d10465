"""Acts as many nodes of ROS 1 in one process: PROGRAM MASTER NODES TOPICS, standard library only.

Each node has an API of its own and publishes TOPICS topics, to which the next one subscribes; what their counters tell
grows by 10 messages a second. A line is written when all are registered; then it answers until it is ended.
"""

import os
import selectors
import sys
import time
import xmlrpc.client
from concurrent.futures import ThreadPoolExecutor
from typing import Any
from xmlrpc.server import SimpleXMLRPCRequestHandler, SimpleXMLRPCServer

TYPES = ("std_msgs/Header", "std_msgs/String", "std_msgs/Float64")
RATE, SIZE = 10.0, 32


class _Handler(SimpleXMLRPCRequestHandler):
    protocol_version = "HTTP/1.1"
    rpc_paths = ()  # any


class Node:
    """One node: its server, and what it answers."""

    def __init__(self, number: int, nodes: int, topics: int) -> None:
        self.name = f"/large/g{number % 10}/n{number}"
        self.number, self.topics = number, topics
        self.before, self.after = (number - 1) % nodes, (number + 1) % nodes
        self.server = SimpleXMLRPCServer(("127.0.0.1", 0), _Handler, logRequests=False, bind_and_activate=True)
        self.uri = f"http://127.0.0.1:{self.server.server_address[1]}/"
        self.all: list[Node] = []
        for answer, name in (
            (lambda _: [1, "", os.getpid()], "getPid"),
            (lambda _: self.statistics(), "getBusStats"),
            (lambda _: self.connections(), "getBusInfo"),
            (lambda *_: [1, "", 0], "publisherUpdate"),
        ):
            self.server.register_function(answer, name)

    def registered(self, master: Any) -> None:
        """Tells the master of what it publishes."""
        for topic in range(self.topics):
            master.registerPublisher(self.name, f"/large/t{self.number}_{topic}", TYPES[topic % 3], self.uri)

    def subscribed(self, master: Any) -> None:
        """Tells the master of what it subscribes to."""
        for topic in range(self.topics):
            master.registerSubscriber(self.name, f"/large/t{self.after}_{topic}", TYPES[topic % 3], self.uri)

    def statistics(self) -> list[Any]:
        """Answers what its connections have carried."""
        count = int(time.monotonic() * RATE) % 2**31
        there = range(self.topics)
        sent = [[f"/large/t{self.number}_{n}", 0, [[n, count * SIZE % 2**31, count, 1]]] for n in there]
        taken = [[f"/large/t{self.after}_{n}", [[100 + n, count * SIZE % 2**31, count, -1, 1]]] for n in there]
        return [1, "", [sent, taken, []]]

    def connections(self) -> list[Any]:
        """Answers which connections it has."""
        reader, writer = self.all[self.before].name, self.all[self.after].uri
        sent = [[n, reader, "o", "TCPROS", f"/large/t{self.number}_{n}", 1] for n in range(self.topics)]
        taken = [[100 + n, writer, "i", "TCPROS", f"/large/t{self.after}_{n}", 1] for n in range(self.topics)]
        return [1, "", sent + taken]


def main(uri: str, count: int, topics: int) -> None:
    """Makes the nodes, registers them and answers whoever asks."""
    nodes = [Node(number, count, topics) for number in range(count)]
    master = xmlrpc.client.ServerProxy(uri)
    pool = ThreadPoolExecutor(2 * count)  # a caller keeps its line open, and each line needs somebody who listens
    ready = selectors.DefaultSelector()
    for node in nodes:
        node.all = nodes
        ready.register(node.server, selectors.EVENT_READ, node)
    for node in nodes:
        node.registered(master)
    for node in nodes:
        pool.submit(node.subscribed, xmlrpc.client.ServerProxy(uri)).result()
    sys.stdout.write("there\n")
    sys.stdout.flush()
    while True:
        for key, _ in ready.select():
            request, address = key.data.server.get_request()
            pool.submit(key.data.server.finish_request, request, address)


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]))
