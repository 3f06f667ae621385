"""Sweeps: arrays, tables, and what reads them."""

import numpy as np
import pytest

import dashpot

pytestmark = pytest.mark.filterwarnings("ignore::dashpot.DashpotWarning")
KEY = "padding.peak-force"


@pytest.fixture(scope="module")
def swept():
    grid = {"padding.maxwell.spring": np.geomspace(5e6, 8e7, 7), "head.velocity": [4.0, 6.0, 8.0]}
    return dashpot.sweep("reference", grid, [KEY])


def test_points_are_those_of_single_runs(swept):
    assert swept[KEY].shape == (7, 3)
    for i, j in [(0, 0), (3, 1), (6, 2)]:
        values = {
            "padding.maxwell.spring": swept.parameters["padding.maxwell.spring"][i],
            "head.velocity": swept.parameters["head.velocity"][j],
        }
        own = dashpot.run("reference", values, "exact")[KEY]
        assert abs(own.value - swept[KEY][i, j]) <= own.error + swept.error(KEY)[i, j]


def test_the_values_are_those_that_were_asked_for(swept):
    wanted = np.geomspace(5e6, 8e7, 7)
    assert (swept.parameters["padding.maxwell.spring"] == wanted).all()


def test_the_reference_is_linear_in_its_speed(swept):
    assert np.allclose(swept[KEY][:, 2], 2.0 * swept[KEY][:, 0], rtol=1e-12)


def test_threads_give_the_same_bits(swept):
    grid = {name: own for name, own in swept.parameters.items()}
    alone = dashpot.sweep("reference", grid, [KEY], threads=1)
    assert (alone[KEY] == swept[KEY]).all() and (alone.error(KEY) == swept.error(KEY)).all()


def test_listed_designs_have_one_axis():
    own = dashpot.sweep("reference", {"head.velocity": "2..9 m/s"}, [KEY], sample=5, seed=3)
    assert own.shape == (5,) and len(own.columns()["head.velocity"]) == 5


def test_unknown_names_are_faults(swept):
    with pytest.raises(dashpot.SceneError, match="head.speeed"):
        dashpot.sweep("reference", {"head.speeed": [1.0, 2.0]})
    with pytest.raises(KeyError, match=KEY):
        swept["nothing"]


def test_xarray(swept):
    pytest.importorskip("xarray")
    data = swept.to_xarray()
    assert data[KEY].dims == ("padding.maxwell.spring", "head.velocity")
    assert data[KEY].attrs["units"] == "N" and (data[KEY].values == swept[KEY]).all()
    assert float(data[KEY].sel({"head.velocity": 6.0})[2]) == swept[KEY][2, 1]


def test_pandas(swept):
    pytest.importorskip("pandas")
    frame = swept.to_pandas()
    assert len(frame) == 21 and (frame[KEY].to_numpy() == swept[KEY].ravel()).all()


@pytest.mark.parametrize("reader", ["pyarrow", "polars", "duckdb"])
def test_arrow_streams_are_read(swept, reader):
    module = pytest.importorskip(reader)
    if reader == "pyarrow":
        found = module.table(swept).column(KEY).to_numpy()
    elif reader == "polars":
        found = module.DataFrame(swept)[KEY].to_numpy()
    else:
        pyarrow = pytest.importorskip("pyarrow")
        own = module.from_arrow(pyarrow.table(swept))
        found = own.project(f'"{KEY}"').fetchnumpy()[KEY]
    assert (np.asarray(found) == swept[KEY].ravel()).all()


@pytest.mark.parametrize("reader", ["pandas", "polars", "duckdb"])
def test_parquet_has_the_same_bits(swept, reader, tmp_path):
    module = pytest.importorskip(reader)
    known = dashpot.sweep_to_parquet("reference", tmp_path / "points", swept.parameters, [KEY])
    file = tmp_path / "points" / known["parquet"][0]
    if reader == "duckdb":
        found = module.sql(f"select * from '{file}'").fetchnumpy()
    else:
        pytest.importorskip("pyarrow")
        found = module.read_parquet(file)
    assert (np.asarray(found[f"{KEY} [N]"]) == swept[KEY].ravel()).all()
    assert (np.asarray(found[f"error of {KEY} [N]"]) == swept.error(KEY).ravel()).all()
    assert known["points"] == 21 and known["measures"][0]["highest"] == swept[KEY].max()
    again = dashpot.sweep_to_parquet("reference", tmp_path / "points", swept.parameters, [KEY])
    assert again == known and "files are there, whole" in again.notes[0]


def test_words_are_swept(tmp_path):
    scene = dashpot.Scene("reference")
    names = {"padding.model": ["valox-pad"]}
    found = dashpot.sweep(scene, {**names, "head.velocity": [4.0, 5.0]}, [KEY])
    assert found.shape == (1, 2) and dashpot._verbs._dashpot.Columns(
        [(name, own.tolist()) for name, own in found.columns().items()]
    )
