import pytest

from roslens.intake.host_header import names_this_machine


@pytest.mark.parametrize(
    "given",
    ["127.0.0.1", "127.0.0.1:80", "[::1]", "[::1]:80", "::1", "localhost", " LOCALHOST:80 ", "robot.", "10.1.2.3"],
)
def test_addresses_and_names_of_this_machine(given):
    assert names_this_machine(given, frozenset({"localhost", "robot"}))


@pytest.mark.parametrize(
    "given", ["", "evil.example", "127.0.0.1.evil.example", "[evil]", "localhost.evil", "robot2", "127.1:"]
)
def test_other_names(given):
    assert not names_this_machine(given, frozenset({"localhost", "robot"}))
