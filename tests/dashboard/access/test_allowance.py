"""How often somebody may do something."""

from roslens.dashboard.access.allowance import MOST_PEERS, Allowance


def test_some_at_once_and_then_one_after_another():
    now = [0.0]
    allowance = Allowance(2, 6.0, lambda: now[0])
    assert [allowance.take("a") for _ in range(3)] == [0, 0, 6.0]
    now[0] = 4.0
    assert allowance.wait("a") == 2.0
    now[0] = 6.0
    assert [allowance.take("a"), allowance.wait("a")] == [0, 6.0]
    now[0] = 1000.0
    assert [allowance.take("a") for _ in range(3)] == [0, 0, 6.0]


def test_each_peer_has_its_own_and_only_so_many_are_remembered():
    allowance = Allowance(1, 6.0, lambda: 0.0)
    for peer in range(MOST_PEERS + 1):
        assert allowance.take(str(peer)) == 0
    assert allowance.wait(str(MOST_PEERS)) == 6.0
    assert allowance.wait("0") == 0
