"""Refuses to be imported outside the main interpreter. There the extension module would wait for ever."""

from importlib import import_module

for _name in ("_interpreters", "_xxsubinterpreters"):
    try:
        _module = import_module(_name)
    except ImportError:
        continue
    if _module.get_current() != _module.get_main():
        raise ImportError("contensou works only in the main interpreter of Python, not in a sub-interpreter")
    break
