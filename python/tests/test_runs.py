"""Runs: the command's numbers, errors with places, warnings with codes."""

import json
import pickle
import threading
import time
import warnings
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import dashpot
from dashpot.network import Network, spring
from dashpot.network import dashpot as damper

pytestmark = pytest.mark.filterwarnings("ignore::dashpot.DashpotWarning")


def command(*arguments, **options):
    return dashpot.call(*arguments, **options)


@pytest.mark.parametrize("method", ["exact", "bdf", "auto"])
def test_a_run_has_the_numbers_of_the_command(method):
    told = command("run", "reference", method=method)["runs"][0]
    report = dashpot.run("reference", method=method)
    assert report.object == told
    assert list(report) == list(told["measures"])
    for key, own in told["measures"].items():
        assert report[key].value == own["value"] and report[key].error == own["error"]


def test_values_are_set_in_si_units_and_as_texts():
    texts = dashpot.run("reference", {"padding.maxwell.spring": "25 MN/m"}, "exact")
    numbers = dashpot.run("reference", {"padding.maxwell.spring": 25e6}, "exact")
    assert texts.object == numbers.object
    assert texts["padding.peak-force"].value > dashpot.run("reference")["padding.peak-force"].value
    third = 1e8 / 3
    scene = dashpot.Scene("reference", {"padding.maxwell.spring": third})
    assert (third, "N/m") in scene.numbers.values()


def test_networks_are_composed():
    network = Network("Head on a padded panel")
    network.mass("head", "10 kg", velocity=10)
    network.mass("panel", "100 kg")
    pad = spring(20e6) + damper("6 kN s/m") + (spring("20 MN/m") | damper(4e3))
    network.connect("padding", "head", "panel", pad, thickness="2 cm")
    network.connect("mount", "panel", "ground", spring("50 MN/m") | damper("10 kN s/m"))
    report = network.run("20 ms", "exact")
    # The number of the doctest of the library, from the closed form of the network.
    assert abs(report["padding.peak-force"].value - 38_359.411_601) < 1e-6


def test_an_undamped_mass_on_a_spring_swings_as_it_must():
    network = Network()
    network.mass("m", 2.0, velocity=3.0)
    network.connect("pad", "m", "ground", spring(800.0))
    report = network.run(0.1, "exact")
    omega = 20.0
    assert abs(report["pad.peak-force"].value - 800.0 * 3.0 / omega) < 1e-9
    times = np.linspace(0.0, 0.1, 77)
    curves = report.curves(["pad.force", "m.position"], times)
    assert np.abs(curves["pad.force"] - 120.0 * np.sin(omega * times)).max() < 1e-9
    assert report.units()["pad.force"] == "N"
    assert set(report.curves()) == {"time", *report.units()}


def test_faults_have_places_and_help():
    text = 'title = "x"\n[nodes]\nhead = { mass = "10 km", velocity = 1 }\n[run]\nduration = 1\n'
    with pytest.raises(dashpot.SceneError) as found:
        dashpot.Scene(text=text)
    fault = found.value.faults[0]
    assert fault["line"] == 3 and "length" in fault["message"]
    assert pickle.loads(pickle.dumps(found.value)).faults == found.value.faults
    with pytest.raises(dashpot.SceneError, match="pading"):
        dashpot.run("reference", {"pading.maxwell.spring": 1e6})
    with pytest.raises(dashpot.SceneError, match="no-such"):
        dashpot.run("no-such.toml")
    with pytest.raises(dashpot.SceneError, match="eksact"):
        dashpot.run("reference", method="eksact")
    with pytest.raises(dashpot.RunError):
        dashpot.run("reference", method="bdf", budget=10)
    with pytest.raises(KeyError, match="padding.peak-force"):
        dashpot.run("reference")["padding.peak-forse"]
    with pytest.raises(dashpot.SceneError, match="end of the run"):
        dashpot.run("reference").curves(times=[0.0, 7.0])
    with pytest.raises(TypeError, match="object"):
        dashpot.Scene({"nodes": {"a": {"mass": object()}}})


def test_warnings_have_codes():
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        report = dashpot.run("reference", method="exact")
    codes = [own.message.code for own in found if own.category is dashpot.DashpotWarning]
    assert codes == report.object["warning_codes"] and codes


def test_scenes_are_pickled_and_do_not_change():
    scene = dashpot.Scene("reference", {"head.velocity": 7.5})
    again = pickle.loads(pickle.dumps(scene))
    assert again.run("exact").object == scene.run("exact").object
    faster = scene.with_values({"head.velocity": 9.0})
    assert faster.numbers["head.velocity"][0] == 9.0
    assert scene.numbers["head.velocity"][0] == 7.5


def test_progress_is_told_and_what_it_raises_ends_the_work():
    def stop(share):
        assert 0.0 <= share <= 1.0
        raise KeyboardInterrupt

    grid = {"head.velocity": np.linspace(1.0, 9.0, 4000), "head.mass": np.linspace(2.0, 9.0, 100)}
    started = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        dashpot.sweep("reference", grid, method="bdf", progress=stop)
    assert time.perf_counter() - started < 60.0


def test_the_interpreter_runs_on_while_a_run_is_solved():
    scene = dashpot.Scene("reference")
    serial = [scene.run("bdf").object["measures"] for _ in range(4)]
    seen = []
    ticking = threading.Event()

    def tick():
        while not ticking.wait(0.001):
            seen.append(time.perf_counter())

    thread = threading.Thread(target=tick)
    thread.start()
    with ThreadPoolExecutor(2) as pool:
        parallel = [own.result() for own in [pool.submit(scene.run, "bdf") for _ in range(4)]]
    ticking.set()
    thread.join()
    assert [own.object["measures"] for own in parallel] == serial
    assert seen


def test_a_notebook_shows_figure_and_measures():
    shown = dashpot.run("reference", method="exact")._repr_html_()
    assert "<svg" in shown and "padding.peak-force" in shown and "warning" in shown
    assert "[nodes]" in dashpot.Scene("reference")._repr_html_()


def test_results_of_verbs_are_those_of_the_command(tmp_path):
    path = tmp_path / "two.toml"
    path.write_text(
        '[models.a]\nzener = { spring = "1 MN/m", maxwell = { spring = "2 MN/m", dashpot = "3 kN s/m" } }\n'
        '[models.b]\nzener = { spring = "1 MN/m", maxwell = { spring = "2.2 MN/m", dashpot = "3 kN s/m" } }\n'
    )
    assert dashpot.compare(f"{path}:a", f"{path}:a").status == 0
    differing = dashpot.compare(f"{path}:a", f"{path}:b")
    assert differing.status == 3 and json.dumps(differing)
    assert dashpot.rheometer(f"{path}:a")
    with pytest.raises(dashpot.SceneError):
        dashpot.compare(f"{path}:a")


NAMED = """
title = "a spring under a name"
[values]
K = "800 N/m"
[nodes]
m = { mass = "2 kg", velocity = "3 m/s" }
[elements]
pad = { between = ["m", "ground"], spring = "K" }
[run]
duration = "0.3 s"
[design]
vary = ["K=100..900 N/m"]
least = "pad.peak-force"
limit = ["pad.peak-deformation<=20 cm"]
"""


def test_named_values_reach_every_verb():
    stiff = dashpot.Scene(text=NAMED, values={"K": 3200.0})
    assert abs(stiff.run("exact")["pad.peak-force"].value - 240.0) < 1e-9
    swept = dashpot.sweep(stiff, {"m.velocity": [3.0]}, ["pad.peak-force"])
    assert abs(swept["pad.peak-force"][0] - 240.0) < 1e-9
    soft = dashpot.Scene(text=NAMED)
    # Similar, and by another factor than a scene to itself.
    assert dashpot.groups(soft, stiff) != dashpot.groups(soft, soft)


def test_sections_of_a_scene_are_heeded():
    found = dashpot.design(dashpot.Scene(text=NAMED))
    # Half of K x^2 is half of m v^2 where the limit on x is reached.
    assert abs(found["parameters"]["K"]["value"] / 450.0 - 1.0) < 1e-4


def test_a_call_may_come_into_a_call():
    inner = []

    def progress(share):
        if not inner:
            inner.append(dashpot.sweep("reference", {"head.velocity": [4.0, 5.0]}).shape)

    grid = {"head.velocity": np.linspace(1.0, 9.0, 300)}
    dashpot.sweep("reference", grid, method="bdf", progress=progress)
    assert inner in ([], [(2,)])
