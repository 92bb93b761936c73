"""The READMEs: what they show in Python is what happens, and mypy accepts it and the package, which imports in no circle."""

import ast
import doctest
import os
import re
import subprocess
import sys
from graphlib import TopologicalSorter
from pathlib import Path

import contensou
import pytest

TOP = Path(__file__).parents[2]
README = TOP / "src/python/README.md"


@pytest.mark.parametrize("readme, examples", [(README, 40), (TOP / "README.md", 3)], ids=["tour", "README"])
def test_what_is_shown(readme, examples, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    results = doctest.testfile(str(readme), module_relative=False, optionflags=doctest.ELLIPSIS)
    assert results.attempted >= examples and results.failed == 0


def test_types(tmp_path):
    """The package, strictly and for the oldest Python that setup.py allows; and the tour, with one argument made wrong."""
    code = doctest.script_from_examples(README.read_text()).replace('law="exat"', "law=1")
    (tmp_path / "tour.py").write_text(code)
    (tmp_path / "mypy.ini").write_text("""[mypy]
strict = True
ignore_missing_imports = True
[mypy-tour]
disallow_untyped_defs = False
disallow_untyped_calls = False
""")
    package = Path(contensou.__file__).parent
    oldest = re.search(r'python_requires=">=(.*)"', (TOP / "src/python/setup.py").read_text())[1]
    run = subprocess.run([sys.executable, "-m", "mypy", "--config-file", "mypy.ini", "--python-version", oldest, str(package), "tour.py"],
                         cwd=tmp_path, capture_output=True, text=True, env={**os.environ, "MYPYPATH": str(package.parent)})
    told = [line for line in run.stdout.splitlines() if "error:" in line]
    assert len(told) == 1 and 'No overload variant of "stop_time" matches argument types "int", "int", "float", "int"' in told[0], run.stdout + run.stderr


def test_imports_have_no_circle():
    files = Path(contensou.__file__).parent.glob("*.py")
    imports = {file.stem: {node.module for node in ast.walk(ast.parse(file.read_text()))
                           if isinstance(node, ast.ImportFrom) and node.level == 1 and node.module} for file in files}
    TopologicalSorter(imports).prepare()  # raises CycleError
