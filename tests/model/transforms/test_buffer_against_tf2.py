"""Look-ups equal those of tf2 itself on made time lines: values, stamps, and the kind of each error."""

import random
from math import cos, sin

import pytest
from tf2_answers import alike, has_tf2, mine, truths

from roslens.model.transforms.transform import Transform, frame_name

FRAMES = ("map", "odom", "base", "laser", "camera", "a/b", "ünïcode", "x y")
SECOND = 10**9
CASES = 300


def rotation(rng):
    axis = [rng.gauss(0, 1) for _ in range(3)]
    length = sum(one * one for one in axis) ** 0.5
    half = rng.uniform(-3, 3) / 2
    return (*(one / length * sin(half) for one in axis), cos(half))


def transform(rng, at):
    child, parent = rng.sample(FRAMES, 2)
    # Mostly a tree, in which each frame has one parent; at times any other.
    if rng.random() < 0.9:
        place = FRAMES.index(child)
        parent = FRAMES[(place - 1) // 2] if place else "world"
    stamp = max(1, at + rng.choice([0, 0, 0, -SECOND, -12 * SECOND, 3 * SECOND, rng.randrange(SECOND)]))
    static = rng.random() < 0.15
    return Transform(parent, child, stamp, tuple(rng.uniform(-5, 5) for _ in range(3)), rotation(rng), static)


def case(seed):
    rng = random.Random(seed)
    at = 100 * SECOND
    transforms = []
    for _ in range(rng.randrange(1, 80)):
        at += rng.choice([0, SECOND // 10, SECOND // 3, SECOND])
        transforms.append(transform(rng, at))
    asked = []
    for _ in range(60):
        target, source = (rng.choice((*FRAMES, "world", "none")) for _ in range(2))
        around = rng.choice(transforms).stamp
        asked.append((target, source, rng.choice([0, 0, around, max(1, around + rng.randrange(-SECOND, SECOND))])))
    return transforms, asked


@pytest.mark.skipif(not has_tf2(), reason="no tf2_py of ROS Noetic beside the system's Python")
def test_look_ups_are_those_of_tf2():
    cases = [case(seed) for seed in range(CASES)]
    kinds = {answer.get("error", "found") for transforms, asked in cases for answer in mine(transforms, asked)}
    assert kinds >= {"found", "LookupException", "ConnectivityException", "ExtrapolationException"}
    differs = [
        (seed, asked, ours, theirs)
        for seed, ((transforms, questions), answers) in enumerate(zip(cases, truths(cases), strict=True))
        for asked, ours, theirs in zip(questions, mine(transforms, questions), answers, strict=True)
        if not alike(ours, theirs)
    ]
    assert not differs, f"{len(differs)} of {sum(len(asked) for _, asked in cases)}: {differs[:5]}"


@pytest.mark.parametrize(("given", "kept"), [("/map", "map"), ("map", "map"), ("//map", "/map"), ("", "")])
def test_one_leading_slash_is_left_out(given, kept):
    assert frame_name(given) == kept
