import os

from roslens.live.publish.asked import when_asked
from roslens.model.acting.outgoing import VERSION, Outgoing, encode_outgoing

FRAME = Outgoing(VERSION, 1.0, ())


def reported(stream, publish=None):
    """Return what was published and complained of until the line was closed."""
    reading, writing = os.pipe()
    published, complaints = [], []
    thread = when_asked(reading, publish or published.append, complaints.append)
    os.write(writing, stream)
    os.close(writing)
    thread.join(10)
    assert not thread.is_alive()
    os.close(reading)
    return published, complaints


def test_frames_are_published_until_the_line_is_closed():
    assert reported(encode_outgoing(FRAME) * 3) == ([FRAME] * 3, [])


def test_what_cannot_be_published_is_told_once_in_a_row_and_ends_nothing():
    tried = []

    def publish(frame):
        tried.append(frame)
        if len(tried) != 3:
            raise RuntimeError("the middleware is ill")

    _, complaints = reported(encode_outgoing(FRAME) * 5, publish)
    assert len(tried) == 5
    assert complaints == ["cannot be published: RuntimeError: the middleware is ill"] * 2


def test_garbage_ends_publishing_with_a_reason():
    published, complaints = reported(encode_outgoing(FRAME) + b"\xff" * 10)
    assert published == [FRAME]
    assert complaints[0].startswith("nothing is published any more: a frame of 4,294,967,295 bytes")
