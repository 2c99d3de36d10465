"""The options that `watch` and `reference draft --live` share."""

from __future__ import annotations

import argparse

import pytest

from roslens.cli.watch.observers import NAMES, add_observer_arguments, given


@pytest.mark.parametrize(
    ("words", "first"),
    [
        ([], ""),
        (["--tap", "/a", "--ros2"], "--ros2"),
        (["--key-file", "k"], "--key-file"),
        (["--domain", "3"], "--domain"),
    ],
)
def test_the_first_that_was_given(words, first):
    parser = argparse.ArgumentParser()
    add_observer_arguments(parser)
    options = parser.parse_args(words)
    assert set(vars(options)) == set(NAMES)
    assert given(options) == first
