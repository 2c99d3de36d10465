"""Programs survive being kept, under keys that tell what they depend on."""

from __future__ import annotations

import zlib

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslens.model.source import Language, SourceFile
from roslens.source.extract.ir.program import Program
from roslens.source.extract.ir.program_codec import pack, program_keys, unpack
from roslens.source.extract.lowering.python.python_program import program_of_python
from roslens.source.parsed_file import parse_file
from roslens.source.settings import MacroSettings

FILE = SourceFile("a/src/a.cpp", Language.CPP, content_hash="ab" * 20)
NO_MACROS = MacroSettings()


@given(st.one_of(st.binary(max_size=80), st.text("()[]{}:abf=\"'.,%\n +-0123456789", max_size=80).map(str.encode)))
def test_what_is_kept_comes_back(content: bytes):
    for language in (Language.CPP, Language.PYTHON):
        program = parse_file(content, language, MacroSettings()).program()
        assert unpack(pack(program)) == program


@pytest.mark.parametrize("number", [str(2**63), str(2**64), str(-(2**64)), "1" * 4000, "1e999"])
def test_numbers_of_any_size(number: str):
    program = program_of_python(f"queue = {number}\nrospy.init_node('a')\n".encode())
    assert unpack(pack(program)) == program


@pytest.mark.parametrize("lines", [1, 10, 100, 1000])
def test_small_and_large_ones_come_back(lines: int):
    program = program_of_python(b"".join(b"a%d = b(%d)\n" % (n, n) for n in range(lines)))
    assert unpack(pack(program)) == program


@pytest.mark.parametrize("kept", [b"", b"x", b"no", zlib.compress(b"no"), zlib.compress(b"")])
def test_what_is_no_program_is_told(kept: bytes):
    with pytest.raises(msgspec.DecodeError):
        unpack(kept)


def test_it_is_smaller_than_its_source():
    content = b"".join(b"def f%d(x):\n    return g(x, 'topic_%d')\n" % (n, n) for n in range(200))
    assert len(pack(program_of_python(content))) < len(content) / 2


def test_keys_tell_content_language_and_macros_but_no_path():
    def key(file: SourceFile = FILE, macros: MacroSettings = NO_MACROS) -> str:
        return program_keys([file], macros)[file.path]

    other = msgspec.structs.replace
    assert key() == key(other(FILE, path="b/c.cpp"))
    different = [
        key(),
        key(other(FILE, content_hash="cd" * 20)),
        key(other(FILE, language=Language.C)),
        key(macros=MacroSettings(blank=("HOT",))),
    ]
    assert len(set(different)) == 4
    assert program_keys([other(FILE, language=Language.YAML)], MacroSettings()) == {}
    assert isinstance(program_of_python(b""), Program)
