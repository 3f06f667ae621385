"""Sweeps on Dask: the bytes of one sweep."""

import numpy as np
import pytest

import dashpot

pytestmark = pytest.mark.filterwarnings("ignore")
KEY = "padding.peak-force"


def test_a_cluster_gives_the_same_bits(tmp_path):
    distributed = pytest.importorskip("distributed")
    from dashpot.distributed import calls, sweep, sweep_to_parquet

    grid = {"padding.maxwell.spring": np.geomspace(5e6, 8e7, 40), "head.velocity": np.linspace(2, 9, 10)}
    whole = dashpot.sweep("reference", grid, [KEY])
    told = []
    with distributed.Client(n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        asked = {"folder": tmp_path / "shards", "shards": 5}
        found = sweep(client, "reference", grid, [KEY], progress=lambda *own: told.append(own), **asked)
        again = sweep(client, "reference", grid, [KEY], **asked)
        files = sweep_to_parquet(client, "reference", grid, [KEY], folder=tmp_path / "points", shards=2)
        jobs = [("rheometer", ("reference:valox-pad",), {"test": test}) for test in ("creep", "relaxation")]
        tested = calls(client, jobs)
    assert told[-1] == (5, 5) and len(told) == 5
    assert tested == [dashpot.call(verb, *operands, **options) for verb, operands, options in jobs]
    assert [own.name for own in files] == ["points-00000001.parquet", "points-00000193.parquet"]
    for own in (found, again):
        assert (own[KEY] == whole[KEY]).all() and (own.error(KEY) == whole.error(KEY)).all()
