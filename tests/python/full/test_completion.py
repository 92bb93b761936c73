"""Completion by jedi, which IPython and editors use."""

import os

import pytest

jedi = pytest.importorskip("jedi")


@pytest.mark.parametrize("code, member, other", [
    ("pool.roll(slip=1, spin=100).", "uncoupled", "events"), ("pool.roll(slip=1, spin=100).rolls_after.", "t", "shape"),
    ("pool.roll(slip=[1, 2]).", "events", "uncoupled"), ("pool.but(slip=1).roll().", "slip_length", "events"),
    ("ct.Flow(mu=0.3).orbit(u=1, v=1).", "sample", "plot"), ("ct.stop_time(u=[1, 2], v=1, mu=0.3).", "shape", "is_integer"),
    ("ct.stop_time(u=1, v=1, mu=0.3).", "is_integer", "shape")])
def test_members_are_completed(code, member, other, tmp_path, monkeypatch):
    monkeypatch.setattr(jedi.settings, "cache_directory", str(tmp_path))
    project = jedi.Project(tmp_path, added_sys_path=os.environ["PYTHONPATH"].split(os.pathsep))
    script = jedi.Script("import contensou as ct\npool = ct.Ball.pool()\n" + code, project=project)
    names = [each.name for each in script.complete()]
    assert member in names and other not in names
