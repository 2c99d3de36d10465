"""Found first on a node's path: installs the hooks of roslens, then runs the sitecustomize that it hides.

It must be read by any Python that a child of the node may start, hence no syntax and no module that an old one lacks.
"""

# mypy: disable-error-code="arg-type, union-attr"
# ruff: noqa: PTH100, PTH113, PTH118, PTH120, PTH123, S102, UP031, UP036

import os
import sys

_HERE = os.path.dirname(os.path.abspath(__file__))

if sys.version_info >= (3, 8):
    try:
        import importlib.util

        _inside = os.path.dirname(_HERE)
        _spec = importlib.util.spec_from_file_location(
            "roslens_inside", os.path.join(_inside, "__init__.py"), submodule_search_locations=[_inside]
        )
        sys.modules["roslens_inside"] = importlib.util.module_from_spec(_spec)
        _spec.loader.exec_module(sys.modules["roslens_inside"])
        importlib.import_module("roslens_inside.hooks").install()
    except Exception as _error:  # noqa: BLE001 - the node must start whatever happens here
        sys.stderr.write("roslens: the traffic of this process is not counted: %s\n" % _error)

for _folder in sys.path:
    _hidden = os.path.join(_folder or ".", "sitecustomize.py")
    if os.path.isfile(_hidden) and os.path.dirname(os.path.abspath(_hidden)) != _HERE:
        with open(_hidden, "rb") as _file:
            _text = _file.read()
        __file__ = _hidden
        exec(compile(_text, _hidden, "exec"))
        break
