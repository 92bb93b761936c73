"""Tests of many starts and many films computed with dask and with MPI: the recipes of src/python/README.md."""

import shutil
import sys
from pathlib import Path

import contensou as ct
import pytest

sys.path.append(str(Path(__file__).parents[1]))
from sweeps import are_fits, longest_of_parts, run


def test_dask(tmp_path):
    pytest.importorskip("dask.array", reason="python3-dask is not installed")
    longest, fits = run("by_dask.py", tmp_path)
    most = ct.stop_time(u=2, v=2, mu=0.3)
    assert 0.98 * most < longest < most and are_fits(fits)


@pytest.mark.parametrize("processes", [1, 4])
def test_mpi(processes, tmp_path, monkeypatch):
    pytest.importorskip("mpi4py", reason="python3-mpi4py is not installed")
    if shutil.which("mpirun") is None:
        pytest.skip("mpirun is not installed")
    for name in ("OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"):  # a container's user is root
        monkeypatch.setenv(name, "1")
    longest, fits = run("by_mpi.py", tmp_path, "mpirun", "--oversubscribe", "-n", str(processes))
    assert longest == longest_of_parts() and are_fits(fits)
