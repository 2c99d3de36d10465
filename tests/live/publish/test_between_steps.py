import threading

import pytest

from roslens.live.publish.between_steps import BetweenSteps


@pytest.mark.timed
def test_the_text_is_made_by_the_thread_that_answers():
    makers = []

    def make():
        makers.append(threading.current_thread())
        return f"text {len(makers)}"

    asked, heard = BetweenSteps(make), []
    asked.answer()
    assert makers == []
    asking = [threading.Thread(target=lambda: heard.append(asked.text())) for _ in range(3)]
    for one in asking:
        one.start()
    while any(one.is_alive() for one in asking):
        asked.answer()
    assert len(heard) == 3
    assert set(makers) == {threading.current_thread()}


def test_several_who_ask_at_once_get_one_text():
    made = []
    asked = BetweenSteps(lambda: made.append(1) or "x", patience_s=0.01)
    for _ in range(2):
        with pytest.raises(TimeoutError, match=r"no answer for 0\.01 s"):
            asked.text()
    asked.answer()
    assert made == [1]
