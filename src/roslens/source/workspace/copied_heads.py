"""Files of libraries that projects copy, recognised by what the comments at their beginning say.

A file that was copied keeps its head, whatever folder it lies in and however it was named there. A head tells a copy
where it has the title of a library, or the name of an author of nothing else that is copied. What a file is merely
derived from, and licences that many choose, tell nothing.
"""

from __future__ import annotations

_HEADS: dict[bytes, tuple[bytes, ...]] = {
    b"Modern": (b"JSON for Modern C++",),
    b"lightweight": (b"This file is part of Eigen, a lightweight C++ template library",),
    b"OpenCV": (b"This file is part of OpenCV project",),
    b"KISS": (b"This file is part of KISS FFT",),
    b"Mark": (b"Mark Borgerding",),  # KISS FFT
    b"Catch": (b" Catch v1.", b" Catch v2.", b" Catch v3."),
    b"doctest.h": (b"doctest.h - the lightest feature-rich C++ single-header testing framework",),
    b"pugixml": (b"pugixml parser - version",),
    b"Lee": (b"Lee Thomason",),  # TinyXML, TinyXML-2
    b"Marcin": (b"Marcin Kalicinski",),  # RapidXml
    b"RapidJSON": (b"support the open source community by making RapidJSON available",),
    b"Baptiste": (b"Baptiste Lepilleur",),  # JsonCpp
    b"Dave": (b"Dave Gamble",),  # cJSON
    b"domain": (b" - public domain deflate", b" - public domain image "),  # miniz; stb_image, stb_image_write
    b"Formatting": (b"Formatting library for C++",),  # {fmt}
    b"dear": (b"dear imgui, v",),
    b"Gabi": (b"Gabi Melman",),  # spdlog
    b"Nyffenegger": (b"Nyffenegger",),  # base64
    b"libb64": (b"is part of the libb64 project",),
    b"Muja": (b"Marius Muja (mariusm@cs.ubc.ca)",),  # FLANN, nanoflann
    b"Angus": (b"Angus Johnson",),  # Clipper
    b"Charles": (b"Charles Karney",),  # GeographicLib
    b"Ceres": (b"Ceres Solver - A fast non-linear least squares minimizer",),
    b"notice": (b"conditions of distribution and use, see copyright notice in zlib.h",),
    b"'zlib'": (b"interface of the 'zlib' general purpose compression library",),
    b"LZ4": (b"LZ4 - Fast LZ compression algorithm",),
    b"Hash": (b"Fast Hash algorithm",),  # xxHash
    b"amalgamation": (b"amalgamation of many separate C source files from SQLite",),
    b"Cameron": (b"Cameron Desrochers",),  # concurrentqueue, readerwriterqueue
    b"Martin": (b"Martin Ankerl", b"Martin Moene"),  # robin_hood; optional-lite, span-lite
    b"Jarryd": (b"Jarryd Beck",),  # cxxopts
    b"Troy": (b"Troy D. Hanson",),  # uthash
    b"Peter": (b"Peter Thorson",),  # WebSocket++
    b"inih": (b"inih -- simple .INI file parser",),
    b"Dorian": (b"Dorian Galvez-Lopez",),  # DBoW2, DLib
    b"Benjamin": (b"Benjamin Peterson",),  # six
    b"Karsten": (b"Karsten Ahnert",),  # Boost.odeint
    b"Arash": (b"Arash Partow",),  # ExprTk
    b"CImg": (b"component of the CImg Library project",),
    b"Simon": (b"Simon Ninon",),  # cpp_redis, tacopie
    b"Kiyoshi": (b"Kiyoshi Matsui",),  # mcpp
    b"Visual": (b"Visual and Computer Graphics Library",),
    b"cDc@seacave": (b"Copyright 2007 cDc@seacave",),  # OpenMVS
    b"SEACAVE": (b"Copyright (c) 2014-2015 SEACAVE",),  # OpenMVS
    b"SISL.": (b"This file is part of SISL.",),
    b"uClibc++": (b"is part of the uClibc++ Library",),
    b"PCAN-Basic": (b"PCAN-Basic Example", b"PCAN-Basic API"),
}
"""Heads of libraries by a word of each: to split a head takes half as long as to look for all of them."""


def library_of(comments: bytes) -> str:
    """Return which library the comments that a file begins with are of, of those that projects copy; else nothing."""
    words = [word for word in comments.split() if word in _HEADS]
    return next((head.decode() for word in words for head in _HEADS[word] if head in comments), "")


def is_copied(comments: bytes) -> bool:
    """Return whether the comments that a file begins with are those of a library that projects copy."""
    return bool(library_of(comments))
