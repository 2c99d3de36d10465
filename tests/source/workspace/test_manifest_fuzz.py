"""Mutated manifests: whatever comes in, the reader answers in time and says what is wrong."""

from __future__ import annotations

import os
import random
from collections.abc import Callable, Sequence
from pathlib import Path

import msgspec
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pace import soon

from roslens.source.workspace.elements import read_elements
from roslens.source.workspace.manifest import read_manifest

CASES = int(os.environ.get("ROSLENS_FUZZ_CASES", "3000"))
ENVIRONMENT = {"ROS_VERSION": "2"}
LONGEST_S = 2.0

MutateContent = Callable[[bytes, Sequence[tuple[str, int, int, bytes]]], bytes]


def assert_answers(content: bytes) -> None:
    with soon(LONGEST_S):
        package, failures = read_manifest(content, "src/arm/package.xml", ENVIRONMENT)
    assert package is not None
    assert package.name
    msgspec.json.encode((package, failures))
    lines = content.count(b"\n") + 1
    for failure in failures:
        assert failure.location is not None
        assert failure.location.path == "src/arm/package.xml"
        assert 0 <= failure.location.line <= lines
        assert failure.what
        assert failure.expected


MUTATIONS = st.lists(
    st.tuples(
        st.sampled_from(("delete", "double", "insert", "flip")),
        st.integers(0, 5000),
        st.integers(1, 255),
        st.binary(max_size=20) | st.sampled_from((b"<name>", b"</package>", b"\0", b"&a;", b"]]>", b"\xe4", b"<!--")),
    ),
    min_size=1,
    max_size=6,
)


@given(name=st.sampled_from(("format_1", "format_2", "format_3", "faulty_everything")), mutations=MUTATIONS)
@settings(max_examples=150, deadline=None)
def test_a_mutated_manifest_is_answered(
    manifests: dict[str, bytes],
    mutate: MutateContent,
    name: str,
    mutations: list[tuple[str, int, int, bytes]],
) -> None:
    assert_answers(mutate(manifests[name], mutations))


@given(content=st.binary(max_size=200))
@settings(max_examples=100, deadline=None)
def test_any_bytes_are_answered(content: bytes) -> None:
    assert_answers(content)


@given(name=st.text(st.characters(codec="utf-8", exclude_characters="<&\0\r", exclude_categories=("Cs", "Cc", "Cn"))))
@settings(max_examples=100, deadline=None)
def test_any_name_comes_back(name: str) -> None:
    content = f"<package><name>{name}</name></package>".encode()
    assert not read_elements(content).faults or "]]>" in name
    package, _ = read_manifest(content, "src/arm/package.xml", ENVIRONMENT)
    assert package is not None
    assert "]]>" in name or package.name == (name.strip(" \t\r\n") or "arm")


@pytest.mark.nightly
@pytest.mark.heavy
@pytest.mark.timeout(3600)
def test_many_mutated_manifests_are_answered(
    manifests: dict[str, bytes],
    mutate: MutateContent,
    draw_mutations: Callable[[random.Random], list[tuple[str, int, int, bytes]]],
) -> None:
    seeds = list(manifests.values())
    if folder := os.environ.get("ROSLENS_CORPORA"):
        seeds += [path.read_bytes() for path in sorted(Path(folder).rglob("package.xml"))]
    for case in range(CASES):
        generator = random.Random(case)
        assert_answers(mutate(generator.choice(seeds), draw_mutations(generator)))
