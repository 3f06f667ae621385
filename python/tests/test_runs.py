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


def test_what_a_text_says_can_be_composed():
    text = """
[values]
V = "3 m/s"
[models.stack]
series = [{ spring = "900 N/m", name = "top" }, { spring = "1800 N/m" }]
[materials.foam]
parallel = [{ spring = "0.8 MPa" }, { dashpot = "9 kPa s" }]
[nodes]
m = { mass = "2 kg", velocity = "V" }
n = { mass = "1 kg" }
wall = { fixed = true }
[elements]
pad = { between = ["m", "n"], series = [{ model = "stack", name = "core" }] }
rest = { between = ["n", "wall"], material = "foam", thickness = "1 cm", area = "8 cm^2" }
[effects]
separation.pad = { at = "m" }
[loads.ram]
on = "n"
force = { half-sine = { peak = "20 N", duration = "10 ms" } }
[measures]
m = ["hic15", { kind = "severity-index", window = "run" }]
[limits]
m.peak-acceleration = "250 g"
pad.contact-time = { min = "5 ms", from = "us" }
[accuracy]
default = "0.01 %"
[run]
duration = "0.1 s"
samples = 11
"""
    network = Network()
    stack = network.model("stack", spring("900 N/m").named("top") + spring("1800 N/m"))
    foam = network.material("foam", spring("0.8 MPa") | damper("9 kPa s"))
    network.mass("m", "2 kg", velocity=network.value("V", "3 m/s"))
    network.mass("n", "1 kg")
    network.node("wall", fixed=True)
    network.connect("pad", "m", "n", stack.named("core"))
    network.connect("rest", "n", "wall", foam, thickness="1 cm", area="8 cm^2")
    network.effect("separation.pad", at="m")
    network.load("ram", "n", {"half-sine": {"peak": "20 N", "duration": "10 ms"}})
    network.measure("m", "hic15")
    network.measure("m", "severity-index", window="run")
    network.limit("m.peak-acceleration", "250 g")
    network.limit("pad.contact-time", min="5 ms", from_="us")
    network.accuracy["default"] = "0.01 %"
    network.settings |= {"duration": "0.1 s", "samples": 11}
    own, written = network.scene(), dashpot.Scene(text=text)
    assert own.numbers.keys() == written.numbers.keys()
    assert own.run().object == written.run().object
    assert own.run().object["limits"][1]["from"] == "us"
    faster = own.with_values({"V": "6 m/s"}).run()
    assert faster["m.peak-acceleration"].value > 1.5 * own.run()["m.peak-acceleration"].value


def test_names_stay_with_their_models():
    network = Network()
    network.mass("m", 2.0, velocity=3.0)
    half = spring(1600.0).named("half")
    network.connect("pad", "m", "ground", (half + spring(1600.0)).named("whole"))
    scene = network.scene(0.1)
    assert "half.spring" in scene.numbers
    assert scene.with_values({"pad.whole.half.spring": 800.0}).numbers["half.spring"][0] == 800.0
    # Half the stiffness of each.
    assert abs(scene.run("exact")["pad.peak-force"].value - 120.0) < 1e-9
    shifted = (half + half.named("other")).having(thickness="2 cm")
    assert repr(shifted) == (
        "(spring(1600.0).named('half') + spring(1600.0).named('other')).having(thickness='2 cm')"
    )
    with pytest.raises(ValueError, match="'m'"):
        network.mass("m", 3.0)
    with pytest.raises(ValueError, match="'pad'"):
        network.connect("pad", "m", "ground", half)


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


def warned(work):
    """What work returns, and of what it warns: codes and files."""
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        value = work()
    own = [one for one in found if one.category is dashpot.DashpotWarning]
    return value, [one.message.code for one in own], {one.filename for one in own}


def test_warnings_have_codes_and_stand_where_they_are_caused():
    report, codes, files = warned(lambda: dashpot.run("reference", method="exact"))
    assert codes == report.object["warning_codes"] == ["pulls"]
    assert files == {__file__}
    assert warned(lambda: dashpot.call("run", "reference", method="exact"))[1] == ["pulls"]


ODD = """
[nodes]
m = { mass = "2 kg", velocity = "3 m/s" }
[elements]
pad = { between = ["ground", "m"], spring = "800 N/m", thickness = "20 cm" }
[measures]
pad = ["peak-stress"]
[run]
duration = "0.3 s"
"""


def test_what_is_odd_about_a_scene_is_told_once():
    scene, codes, files = warned(lambda: dashpot.Scene(text=ODD))
    assert codes == [code for code, _ in scene.warnings] == ["reversed", "undefined-measure"]
    assert files == {__file__}
    report, codes, _ = warned(scene.run)
    assert codes == ["pulls-from-the-start"]
    assert sorted(code for code, _ in report.warnings) == ["pulls-from-the-start", "reversed"]
    assert [code for code, _ in report.notes] == ["weight-left-out"]
    # Of its own a sweep has the measures that no point has.
    assert set(warned(lambda: dashpot.sweep(scene, {"m.velocity": [1.0, 2.0]}))[1]) == {"sweep"}


SCATTERED = """
[values]
K = "800 ± 80 N/m"
[nodes]
m = { mass = "2 kg", velocity = "3 m/s" }
[elements]
pad = { between = ["m", "ground"], spring = "K", thickness = "20 cm" }
[limits]
pad.peak-force = "130 N"
[run]
duration = "0.3 s"
"""


def test_scatter_and_floor_are_those_of_the_command():
    scene = dashpot.Scene(text=SCATTERED)
    report = scene.run(sample=60, seed=3, floor=True)
    assert report.object == command("run", scene, sample=60, seed=3, floor=True)["runs"][0]
    assert report.object["scatter"]["designs"] == 60
    # No stop of m v^2 / 2 within d takes less than that over d.
    assert abs(report.object["floor"]["measures"]["pad.peak-force"]["value"] - 45.0) < 1e-9
    assert scene.run().object == command("run", scene)["runs"][0]
    assert not {"scatter", "floor"} & scene.run(sample=0).object.keys()


def test_reports_are_pickled_and_have_their_curves():
    scene = dashpot.Scene("reference", {"head.velocity": 7.5})
    report = scene.run("exact", measures=["padding.peak-force"])
    (again, codes, _) = warned(lambda: pickle.loads(pickle.dumps(pickle.loads(pickle.dumps(report)))))
    assert codes == []
    assert again.object == report.object and again.warnings == report.warnings
    assert list(again) == list(report) == ["padding.peak-force"]
    assert (again.method, again.wall) == (report.method, report.wall)
    assert again.scene.numbers == scene.numbers
    ours, theirs = report.curves(), again.curves()
    assert all((ours[name] == theirs[name]).all() for name in ours) and list(ours) == list(theirs)
    with pytest.raises(KeyError, match="padding.peak-force"):
        again["padding.peak-forse"]
    peak = pickle.loads(pickle.dumps(report["padding.peak-force"]))
    for name in ("key", "value", "error", "unit", "time", "window", "note"):
        assert getattr(peak, name) == getattr(report["padding.peak-force"], name)


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


FOAM = """
[nodes]
head = { mass = "5 kg", drop = "1.5 m" }
[elements]
liner = { between = ["head", "ground"], foam = { modulus = "8 MPa", plateau = "0.4 MPa", densification = "1 MPa", exponent = 3.0 }, thickness = "3 cm", area = "60 cm^2" }
[effects]
separation.liner = { at = "head" }
[run]
duration = "40 ms"
"""
CHAIN = {
    "nodes": {f"n{at}": {"mass": 1.0, **({"velocity": 5.0} if at == 0 else {})} for at in range(60)},
    "elements": {
        f"e{at}": {
            "between": [f"n{at}", f"n{at + 1}" if at < 59 else "ground"],
            "parallel": [{"spring": 1e4 * (1 + at)}, {"dashpot": 10.0}],
        }
        for at in range(60)
    },
    "run": {"duration": 0.1},
}


def ended(work):
    """The shares that were told, of work that ends once it has told some."""
    shares = []

    def progress(share):
        shares.append(share)
        if len(shares) > 3:
            raise KeyboardInterrupt

    started = time.perf_counter()
    with pytest.raises(KeyboardInterrupt):
        work(progress)
    assert time.perf_counter() - started < 30.0
    assert shares == sorted(shares) and 0.0 <= shares[0] <= shares[-1] <= 1.0
    return shares


def test_a_search_for_designs_can_be_ended():
    vary = {"liner.thickness": "10..60 mm", "liner.area": "20..100 cm^2"}
    asked = {"vary": vary, "least": "head.peak-acceleration", "sample": 100_000}
    scene = dashpot.Scene(text=FOAM)
    shares = ended(lambda progress: dashpot.design(scene, progress=progress, **asked))
    assert shares[-1] > 0.0


def test_what_is_shaken_can_be_ended():
    scene = dashpot.Scene(CHAIN)
    ended(lambda progress: dashpot.vibrate(scene, drive="ground", points=50_000, progress=progress))


def test_measured_signals_can_be_ended(tmp_path):
    file = tmp_path / "drop.csv"
    rows = [f"{at / 2e4},{np.sin(at / 700)}" for at in range(100_000)]
    file.write_text("\n".join(["time (s),acc (g)", *rows]))
    ended(lambda progress: dashpot.signal(*[file] * 20, cfc=180, progress=progress))


def test_a_run_is_ended_and_its_share_never_falls():
    scene = dashpot.Scene(CHAIN)
    ended(lambda progress: scene.run("bdf", accuracy=1e-9, progress=progress))


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
