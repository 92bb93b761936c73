"""Many starts and films on one machine, without another library."""

from sweeps import are_fits, longest_of_parts, run


def test_multiprocessing(tmp_path):
    longest, fits = run("by_multiprocessing.py", tmp_path)
    assert longest == longest_of_parts() and are_fits(fits)
