"""What files are written in."""

from __future__ import annotations

import pytest
from pace import soon

from roslens.model.source import Language, Role
from roslens.source.settings import WorkspaceSettings
from roslens.source.workspace.languages import classify, header_language, language_by_content, language_by_name

SETTINGS = WorkspaceSettings()


@pytest.mark.parametrize(
    ("path", "language"),
    [
        ("p/a.c", Language.C),
        ("p/a.cpp", Language.CPP),
        ("p/a.C", Language.CPP),
        ("p/kernel.cu", Language.CPP),
        ("p/kernel.cuh", Language.CPP),
        ("p/a.CPP", Language.CPP),
        ("p/a.h", Language.CPP),
        ("p/a.H", Language.CPP),
        ("p/a.hxx", Language.CPP),
        ("p/a-inl.ipp", Language.CPP),
        ("p/a.py", Language.PYTHON),
        ("p/a.pyi", Language.PYTHON),
        ("p/package.xml", Language.MANIFEST),
        ("package.xml", Language.MANIFEST),
        ("p/CMakeLists.txt", Language.CMAKE),
        ("p/cmake/a.cmake", Language.CMAKE),
        ("p/launch/a.launch", Language.LAUNCH_XML),
        ("p/a.launch.xml", Language.LAUNCH_XML),
        ("p/a.launch.py", Language.LAUNCH_PYTHON),
        ("p/a.launch.yaml", Language.LAUNCH_YAML),
        ("p/a.launch.yml", Language.LAUNCH_YAML),
        ("p/msg/A.msg", Language.MSG),
        ("p/srv/A.srv", Language.SRV),
        ("p/action/A.action", Language.ACTION),
        ("p/config/a.yaml", Language.YAML),
        ("p/urdf/a.urdf", Language.URDF),
        ("p/urdf/a.urdf.xacro", Language.XACRO),
        ("p/worlds/a.world", Language.XML),
        ("p/README.md", Language.OTHER),
        ("p/setup.cfg", Language.OTHER),
        ("p/LICENSE", Language.OTHER),
        ("p/a.py.in", Language.OTHER),
        ("p/a.xml", None),
        ("p/scripts/run", None),
        ("p/cfg/A.cfg", None),
        ("p/test/a.test", None),
        ("p/launch/a.py", None),
        ("p/test/a_launch.py", None),
        ("p/launch/a.yaml", None),
        ("p/.gitignore", None),
    ],
)
def test_by_name(path: str, language: Language | None) -> None:
    assert language_by_name(path) is language


@pytest.mark.parametrize(
    ("path", "content", "language"),
    [
        ("scripts/run", b"#!/usr/bin/env python3\n", Language.PYTHON),
        ("scripts/run", b"#! /usr/bin/python -u\r\n", Language.PYTHON),
        ("scripts/run", b"#!/bin/sh\npython x\n", Language.OTHER),
        ("scripts/run", b"\x7fELF\0\0#!python", Language.OTHER),
        ("scripts/run", b"", Language.OTHER),
        ("include/Vector", b"// -*- C++ -*-\n", Language.CPP),
        ("cfg/A.cfg", b"#!/usr/bin/env python\n", Language.PYTHON),
        ("cfg/A.cfg", b"[section]\n", Language.OTHER),
        ("launch/a.py", b"import x\n\ndef generate_launch_description():\n  pass\n", Language.LAUNCH_PYTHON),
        ("test/a_launch.py", b"def generate_test_description ( ):\n", Language.LAUNCH_PYTHON),
        ("launch/a.py", b"# def generate_launch_description():\n", Language.PYTHON),
        ("launch/a.py", b"    def generate_launch_description(self):\n", Language.PYTHON),
        ("launch/a.yaml", b"%YAML 1.2\n---\nlaunch:\n- node: {}\n", Language.LAUNCH_YAML),
        ("launch/a.yaml", b"  launch:\n", Language.YAML),
        ("launch/a.yaml", b"launcher: 1\n", Language.YAML),
        ("a.xml", b'\xef\xbb\xbf<?xml version="1.0"?>\n<!-- <robot> -->\n<launch/>', Language.LAUNCH_XML),
        ("a.xml", b"<!DOCTYPE launch>\r\n<launch>", Language.LAUNCH_XML),
        ("a.xml", b'<robot name="x">', Language.URDF),
        ("a.xml", b'<robot xmlns:xacro="http://x" name="x">', Language.XACRO),
        ("a.xml", b"<library/>", Language.XML),
        ("a.xml", b"", Language.XML),
        ("a.xml", b"<!-- open", Language.XML),
        ("a.test", b"<launch/>", Language.LAUNCH_XML),
        ("a.test", b"<other/>", Language.XML),
        ("a.test", b"some words", Language.OTHER),
    ],
)
def test_by_content(path: str, content: bytes, language: Language) -> None:
    assert language_by_content(path, content) is language


def test_headers_are_c_only_among_c_alone() -> None:
    assert header_language(["a.c", "a.h", "README.md"]) is Language.C
    assert header_language(["a.c", "a.cpp", "a.h"]) is Language.CPP
    assert header_language(["a.c", "b.hpp", "a.h"]) is Language.CPP
    assert header_language(["a.h"]) is Language.CPP
    assert header_language([]) is Language.CPP


@pytest.mark.parametrize(
    "content",
    [
        b"\0" * 5000,
        b"\xff\xfe\x00\xd8",
        "ü".encode("latin-1") * 3000,
        b"\xef\xbb\xbf\r\n\r\n",
        b"<!---->" * 500_000,
        b"<" * 3_000_000,
        b"# " * 5_000_000,
        bytes(range(256)) * 40,
    ],
    ids=["zeros", "utf-16", "latin-1", "bom", "comments", "brackets", "10 MB", "binary"],
)
@pytest.mark.parametrize("path", ["a.cpp", "a.xml", "a", "launch/a.py", "launch/a.yaml", "a.test"])
def test_any_content_is_answered(path: str, content: bytes) -> None:
    with soon(20):
        classified = classify(path, content, SETTINGS)
    assert classified.role in (Role.OWN, Role.TEST)
    assert isinstance(classified.language, Language)


def test_name_before_content_and_path_before_content() -> None:
    signed = b"// Generated by a tool. DO NOT EDIT.\n"
    assert classify("p/a.cpp", signed, SETTINGS).role is Role.GENERATED
    assert classify("p/test/a.cpp", signed, SETTINGS).role is Role.TEST
    assert classify("p/a.cpp", signed, WorkspaceSettings(own=("p",))).role is Role.OWN
