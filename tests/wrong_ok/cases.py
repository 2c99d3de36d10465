"""The cases of the gate, by what is wrong."""

from __future__ import annotations

from functools import partial

from wrong_ok.judged import (
    client_without_server,
    exact_value,
    other_domain,
    own_loss_of_a_tap,
    restarted_master,
    second_publisher_of_another_type,
    second_publisher_of_another_type_ros1,
    starved_subscriber,
    starved_subscriber_ros1,
    twins,
)
from wrong_ok.line_cut import cut_line
from wrong_ok.mistakes import Case
from wrong_ok.reacted import clock_jumps, container, crashes, operator_stops, stopped_monitor, stopped_observer

CASES: dict[str, Case] = {
    "two nodes of one name": twins,
    "a subscriber takes every 13th message": starved_subscriber,
    "a subscriber takes every 13th message (ROS 1)": starved_subscriber_ros1,
    "traffic of another domain, beside a participant without ROS": other_domain,
    "a server is killed, its client goes on": client_without_server,
    "an exact value with a margin is right again": exact_value,
    "a tap gets a part of what is sent": own_loss_of_a_tap,
    "a second publisher, of another type": second_publisher_of_another_type,
    "a second publisher, of another type (ROS 1)": second_publisher_of_another_type_ros1,
    "the ROS 1 master is restarted": restarted_master,
    "the line to an agent is cut for 0.5, 2 and 10 s": cut_line,
    "a process of one node is killed": partial(container, nodes=1),
    "a process of two nodes is killed": partial(container, nodes=2),
    "a process of three nodes is killed": partial(container, nodes=3),
    "a node is killed three times": crashes,
    "an operator ends four of five nodes": operator_stops,
    "the observer is stopped for 4 s": stopped_observer,
    "the monitor is stopped for 8 s": stopped_monitor,
    "the wall clock is set 30 s ahead, and back": clock_jumps,
}
OF_ROS1 = frozenset(name for name in CASES if "ROS 1" in name)
