from roslens.model.qos import Qos, quality_text


def test_qualities_in_words():
    assert quality_text(Qos()) == "qos unknown"
    assert (
        quality_text(Qos("best_effort", "volatile", "keep_all", deadline_s=0.5))
        == "best_effort, keep_all, deadline 0.5 s"
    )
