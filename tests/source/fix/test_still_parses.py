import pytest

from roslens.model.source import Language, SourceFile
from roslens.source.fix.still_parses import new_fault
from roslens.source.settings import MacroSettings


@pytest.mark.parametrize(
    ("path", "language", "before", "after", "fault"),
    [
        ("a.cpp", Language.CPP, b"int a;\n", b"int b;\n", ""),
        ("a.cpp", Language.CPP, b"int a;\n", b"int a\n", "line 1"),
        ("a.cpp", Language.CPP, b"int (;\nint a;\n", b"int (;\nint b;\n", ""),
        ("a.py", Language.PYTHON, b"a = 1\n", b"a = (\n", "line"),
        ("package.xml", Language.MANIFEST, b"<package/>", b"<package></package>", ""),
        ("package.xml", Language.MANIFEST, b"<package/>", b"<package>", ""),
        ("a.yaml", Language.LAUNCH_YAML, b"a: 1\n", b"a: [\n", ""),
    ],
)
def test_only_new_faults_count(path, language, before, after, fault):
    found = new_fault(SourceFile(path, language, size=0, content_hash=""), before, after, MacroSettings())
    if (path, after) == ("package.xml", b"<package>"):
        assert found
    else:
        assert found.startswith(fault)
        assert bool(found) == bool(fault)
